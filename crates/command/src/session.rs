//! Shared state of subcommands: output, progress and threads.

use std::fmt;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use rayon::{ThreadPool, ThreadPoolBuilder};

use pushplan::asset::printable;
use pushplan::outcome::SHOWN_WARNINGS;

use super::error::CliError;

/// Options of every subcommand.
#[derive(Args, Clone, Debug)]
pub struct GlobalArgs {
    /// Number of worker threads; 0 means one per core of the machine, the container or the Slurm
    /// task (--cpus-per-task). Results do not depend on it
    #[arg(long, global = true, value_name = "N", default_value_t = 0,
          value_parser = clap::value_parser!(u16).range(0..=1024))]
    pub threads: u16,
    /// Suppress progress and warnings on stderr
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Show all warnings instead of the three most useful ones
    #[arg(long, global = true)]
    pub all_warnings: bool,
    /// Folder in or below which the files named by MJCF and URDF files must be [default: the folder
    /// of the file]
    #[arg(long, global = true, value_name = "FOLDER")]
    pub root: Option<PathBuf>,
}

/// Templates of a stage without and with counted units.
const STAGE: &str = "{spinner} {prefix}, {elapsed} {msg}";
const COUNTED: &str = "{spinner} {prefix}, {elapsed} {msg}, {pos}/{len}";

/// Delay before progress is shown. A first plan is often found within this time, and a user does
/// not notice a delay below a tenth of a second.
const SHOW_AFTER: Duration = Duration::from_millis(50);

/// Interval in which shown progress is drawn again.
const TICK: Duration = Duration::from_millis(200);

/// Session of one command, with its thread pool.
#[derive(Debug)]
pub struct Session {
    pool: ThreadPool,
    quiet: bool,
    all_warnings: bool,
    root: Option<PathBuf>,
}

impl Session {
    /// Starts the threads, and allows arms to use files in the root folder.
    ///
    /// # Errors
    /// Returns [`CliError::Unexpected`] if the system refuses that many threads.
    pub fn start(args: &GlobalArgs) -> Result<Self, CliError> {
        let threads = match args.threads {
            0 => {
                // This number respects affinity and control groups, which Slurm does not
                // necessarily use.
                let cores = std::thread::available_parallelism().map_or(1, usize::from);
                allocated(cores, std::env::var("SLURM_CPUS_PER_TASK").ok().as_deref())
            }
            threads => usize::from(threads),
        };
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|error| CliError::unexpected("cannot start the threads", &error))?;
        if let Some(root) = &args.root {
            pushplan_arm::allow_files_in(root);
        }
        let GlobalArgs { quiet, all_warnings, .. } = *args;
        Ok(Self { pool, quiet, all_warnings, root: args.root.clone() })
    }

    /// Returns the folder that must contain all files named by a file, if the user gives one.
    pub fn root(&self) -> Option<&Path> {
        self.root.as_deref()
    }

    /// Returns the number of threads.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Runs `work` on the session's threads.
    pub fn compute<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.pool.install(work)
    }

    /// Runs `work` on a pool of one thread, whose processor time then covers all of the work.
    pub fn compute_alone<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match ThreadPoolBuilder::new().num_threads(1).build() {
            Ok(alone) => alone.install(work),
            // Only the measured times are affected.
            Err(_) => self.compute(work),
        }
    }

    /// Writes results to stdout with control characters escaped, because names and descriptions
    /// come from untrusted files. JSON is not affected.
    ///
    /// # Errors
    /// Returns [`CliError::Closed`] if the reader has closed the output, and
    /// [`CliError::Unexpected`] for other errors.
    pub fn print(&self, text: &str) -> Result<(), CliError> {
        let mut out = std::io::stdout().lock();
        out.write_all(shown(text).as_bytes())
            .and_then(|()| out.flush())
            .map_err(|error| CliError::output(&error))
    }

    /// Writes a warning to stderr.
    pub fn warn(&self, text: &str) {
        self.message(&format!("warning: {text}"));
    }

    /// Writes warnings to stderr, most useful first; at most three unless the user asks for all.
    pub fn warn_each(&self, lines: &[String]) {
        let shown = if self.all_warnings { lines.len() } else { SHOWN_WARNINGS };
        lines.iter().take(shown).for_each(|line| self.warn(line));
        if let Some(more) = lines.len().checked_sub(shown).filter(|more| *more > 0) {
            self.message(&format!("{more} more warnings; --all-warnings shows them"));
        }
    }

    /// Writes a line to stderr, separate from the results.
    pub fn message(&self, text: &str) {
        if !self.quiet {
            // A failure is ignored because there is no other channel to report it.
            let _ = writeln!(std::io::stderr(), "{}", shown(text));
        }
    }

    /// Returns a bar for long work in many equal units, visible only if stderr is a terminal.
    pub fn bar(&self, what: &str) -> ProgressBar {
        if self.quiet || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::new(0);
        let bar_style = style("{prefix} [{bar:30}] {pos}/{len}, {elapsed}{left} {msg}");
        bar.set_style(bar_style.with_key("left", left));
        bar.set_prefix(what.to_owned());
        bar
    }

    /// Returns a spinner for work of unknown length, shown after a delay and only if stderr is a
    /// terminal.
    pub fn spinner(&self, what: &str) -> ProgressBar {
        self.spinning(what, STAGE)
    }

    /// Returns a spinner for work in stages, each of a number of units.
    pub fn staged(&self, what: &str) -> ProgressBar {
        self.spinning(what, STAGE)
    }

    fn spinning(&self, what: &str, template: &str) -> ProgressBar {
        let bar = ProgressBar::hidden();
        if !self.quiet && std::io::stderr().is_terminal() {
            bar.set_prefix(what.to_owned());
            bar.set_style(style(template));
            let later = bar.clone();
            std::thread::spawn(move || {
                std::thread::sleep(SHOW_AFTER);
                if !later.is_finished() {
                    later.set_draw_target(ProgressDrawTarget::stderr());
                    later.enable_steady_tick(TICK);
                }
            });
        }
        bar
    }
}

/// Sets the number of units of a bar, which is then drawn regularly, also before the first unit is
/// finished.
pub fn size(bar: &ProgressBar, total: u64) {
    if bar.length() != Some(total) {
        bar.set_length(total);
        bar.enable_steady_tick(TICK);
    }
}

/// Writes the estimated remaining time, unless no unit is finished yet.
fn left(state: &ProgressState, out: &mut dyn fmt::Write) {
    if state.pos() > 0 {
        // A failure only leaves the time out.
        let _ = write!(out, ", {:#} left", HumanDuration(state.eta()));
    }
}

/// Shows the number of units of a stage, or none if they are not counted.
pub fn count(bar: &ProgressBar, counted: bool) {
    bar.set_style(style(if counted { COUNTED } else { STAGE }));
}

/// Returns `cores`, limited to the number that Slurm has allotted to the task, if any.
fn allocated(cores: usize, slurm: Option<&str>) -> usize {
    match slurm.and_then(|text| text.trim().parse().ok()) {
        Some(allotted @ 1..) => cores.min(allotted),
        _ => cores,
    }
}

/// Returns `text` without control characters, line by line.
pub fn shown(text: &str) -> String {
    text.split('\n').map(printable).collect::<Vec<_>>().join("\n")
}

fn style(template: &str) -> ProgressStyle {
    // Only an invalid template above can fail, and the default bar is then used.
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_follow_the_allocation() {
        for (slurm, threads) in
            [(None, 8), (Some("3"), 3), (Some("64"), 8), (Some("0"), 8), (Some("all"), 8)]
        {
            assert_eq!(allocated(8, slurm), threads, "{slurm:?}");
        }
    }
}
