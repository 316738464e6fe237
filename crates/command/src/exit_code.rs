//! What the process tells the shell. Scripts rely on these numbers: never change their meaning.

/// Did what was asked.
pub const DONE: u8 = 0;
/// Could not finish for a reason outside the given files: a folder that cannot be written, a full
/// disk, or a defect of pushplan.
pub const UNEXPECTED: u8 = 1;
/// The command line is wrong. Nothing was run.
pub const USAGE: u8 = 2;
/// A given file is missing, unreadable or wrong. Every fault found was printed.
pub const INVALID_FILE: u8 = 3;
/// The search ended and no plan reaches the goal; the nearest one is shown.
pub const NO_PLAN: u8 = 4;
/// Plans reach the goal by prediction, but none of those tried works in simulation.
pub const FAILED_VERIFICATION: u8 = 5;
/// The model should not be trusted with this, and `--outside refuse` was asked for.
pub const REFUSED: u8 = 6;
/// The best plan works as written, but too seldom under small errors.
pub const FRAGILE: u8 = 7;
/// The best plan meets some of several goals only.
pub const PARTIAL: u8 = 8;
/// Stopped by Ctrl-C or a termination signal; what was finished is saved.
pub const INTERRUPTED: u8 = 130;

/// The list for `--help`.
pub const HELP: &str = "\
Exit codes:
    0  done
    1  could not finish (folder not writable, disk full, internal error)
    2  wrong command line
    3  a file is missing or invalid
    4  no plan found
    5  plans were found but failed verification
    6  outside of what the model was trained on, and `--outside refuse` was given
    7  the plan works, but too seldom under small errors of starts and frictions
    8  the plan meets some of several goals only
  130  interrupted; finished work is saved";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_lists_every_code() {
        let listed: Vec<u8> = HELP
            .lines()
            .skip(1)
            .filter_map(|line| line.split_whitespace().next()?.parse().ok())
            .collect();
        let all = [
            DONE,
            UNEXPECTED,
            USAGE,
            INVALID_FILE,
            NO_PLAN,
            FAILED_VERIFICATION,
            REFUSED,
            FRAGILE,
            PARTIAL,
            INTERRUPTED,
        ];
        assert_eq!(listed, all);
        assert_eq!(all, [0, 1, 2, 3, 4, 5, 6, 7, 8, 130]);
    }
}
