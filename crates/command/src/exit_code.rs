//! Exit codes of the process. Scripts rely on these numbers, so their meaning must never change.

/// Success.
pub const DONE: u8 = 0;
/// Failure for a reason outside the given files: a folder that cannot be written, a full disk, or a
/// defect of pushplan.
pub const UNEXPECTED: u8 = 1;
/// Invalid command line; nothing was run.
pub const USAGE: u8 = 2;
/// Missing, unreadable or invalid file; every fault found was printed.
pub const INVALID_FILE: u8 = 3;
/// Search without a plan that reaches the goal; the nearest plan is shown.
pub const NO_PLAN: u8 = 4;
/// Plans that reach the goal by prediction, but fail verification.
pub const FAILED_VERIFICATION: u8 = 5;
/// Request outside the model's range, with `--out-of-range refuse`.
pub const REFUSED: u8 = 6;
/// Best plan that works as written, but too seldom under perturbations.
pub const FRAGILE: u8 = 7;
/// Best plan that meets only some of several goals.
pub const PARTIAL: u8 = 8;
/// Run that was stopped because an object broke a rule of the task.
pub const RULE_BROKEN: u8 = 9;
/// Interruption by Ctrl-C or a termination signal; finished work is saved.
pub const INTERRUPTED: u8 = 130;

/// List of exit codes for `--help`.
pub const HELP: &str = "\
Exit codes:
    0  done
    1  could not finish (folder not writable, disk full, internal error)
    2  invalid command line
    3  a file is missing or invalid
    4  no plan found
    5  plans were found but failed verification
    6  request outside the model's range, with `--out-of-range refuse`
    7  fragile plan: it works as planned, but too few perturbed replays reach the goal
    8  partial plan: it meets only some of several goals
    9  run stopped: an object was observed to break a rule of the task
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
            RULE_BROKEN,
            INTERRUPTED,
        ];
        assert_eq!(listed, all);
        assert_eq!(all, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 130]);
    }
}
