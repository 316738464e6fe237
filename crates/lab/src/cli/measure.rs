//! `pushplan-lab measure`: published tables again, and their age.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use pushplan::internals::solve::Effort;
use pushplan_command::error::CliError;
use pushplan_command::session::Session;
use pushplan_command::{interrupt, output};
use pushplan_report::Align::{Left, Right};
use pushplan_report::Table;

use crate::bench::Answers;
use crate::published::{self, Fingerprint, Published, tables};

/// Measure published tables again, or list those that are stale
#[derive(Args, Debug)]
#[command(
    after_help = "Runs in the root of the repository; without names measures every stale table. A
table is stale if the weights or the answers to 20 fixed tasks and pushes differ from those that
it was measured with. Run the same command again to resume.

Examples:
  pushplan-lab measure --list
  pushplan-lab measure real-pushes cost
  pushplan-lab measure --limit 60"
)]
pub struct MeasureArgs {
    /// Names of tables [default: all that are stale]
    #[arg(value_name = "NAME", conflicts_with_all = ["list", "check"])]
    names: Vec<String>,
    /// List all tables with their estimated processor time and their age
    #[arg(long, conflicts_with = "check")]
    list: bool,
    /// Mark stale tables on their pages
    #[arg(long)]
    check: bool,
    /// Start no table that would exceed this many minutes, as estimated on one core
    #[arg(long, value_name = "MINUTES", default_value_t = 150)]
    limit: u16,
    /// Folder of the pages
    #[arg(long, value_name = "DIR", default_value = "crates/lab/results")]
    pages: PathBuf,
    /// Folder of the weights
    #[arg(long, value_name = "DIR", default_value = "crates/models")]
    weights: PathBuf,
}

pub fn run(args: &MeasureArgs, session: &Session) -> Result<(), CliError> {
    let chosen = args.chosen()?;
    let answers = session.compute(|| Answers::of(Effort::Draft.settings()));
    let answers = answers.map_err(|error| CliError::unexpected("cannot answer", &error))?;
    let now = Fingerprint::of(&args.weights, &answers)
        .map_err(|error| missing(&args.weights, &error.to_string()))?;
    if args.list {
        return session.print(&args.listed(&now)?);
    }
    if args.check {
        return args.mark(session, &now);
    }
    args.measure(session, &chosen, &now)
}

/// Refuses a folder that is not there.
fn missing(folder: &Path, why: &str) -> CliError {
    let message = format!("{}: {why}", folder.display());
    CliError::usage(message, "run it in the root of the repository")
}

impl MeasureArgs {
    /// Returns the named tables, all without names.
    fn chosen(&self) -> Result<Vec<&'static Published>, CliError> {
        let unknown = self.names.iter().find(|name| tables().all(|table| table.name != **name));
        if let Some(name) = unknown {
            let message = format!("there is no published table `{name}`");
            return Err(CliError::usage(message, "`pushplan-lab measure --list` lists them"));
        }
        let named = |table: &&Published| self.names.iter().any(|name| name == table.name);
        Ok(tables().filter(|table| self.names.is_empty() || named(table)).collect())
    }

    fn page(&self, table: &Published) -> Result<String, CliError> {
        let path = self.pages.join(table.page);
        fs::read_to_string(&path).map_err(|error| missing(&path, &error.to_string()))
    }

    /// Returns the reason to call a table stale.
    fn stale(&self, table: &Published, now: &Fingerprint) -> Result<Option<String>, CliError> {
        let place = published::place(&self.page(table)?, table.name);
        let place = place.ok_or_else(|| no_place(table))?;
        Ok(place.judge(table, now))
    }

    /// Returns all tables with estimates and age.
    fn listed(&self, now: &Fingerprint) -> Result<String, CliError> {
        let rows = tables().map(|table| Ok((table, self.stale(table, now)?)));
        let rows = rows.collect::<Result<Vec<_>, CliError>>()?;
        let minutes = |stale: bool| -> u32 {
            let counted = rows.iter().filter(|(_, why)| !stale || why.is_some());
            counted.map(|(table, _)| u32::from(table.minutes)).sum()
        };
        let (all, left) = (minutes(false), minutes(true));
        let stale = rows.iter().filter(|(_, why)| why.is_some()).count();
        let summary = format!(
            "\n{} tables, {:.1} h of processor time; {stale} stale, {:.1} h\n",
            rows.len(),
            f64::from(all) / 60.0,
            f64::from(left) / 60.0
        );
        let table = Table::of(
            &rows,
            &[
                ("table", Left, &|(table, _)| table.name.to_owned()),
                ("page", Left, &|(table, _)| table.page.to_owned()),
                ("minutes", Right, &|(table, _)| table.minutes.to_string()),
                ("n", Right, &|(table, _)| table.count.to_string()),
                ("of", Left, &|(table, _)| table.unit.to_owned()),
                ("stale", Left, &|(_, why)| why.clone().unwrap_or_default()),
            ],
        );
        Ok(table.to_text() + &summary)
    }

    /// Writes the marks that tables deserve today.
    fn mark(&self, session: &Session, now: &Fingerprint) -> Result<(), CliError> {
        let (mut changed, mut stale) = (0, 0);
        for table in tables() {
            let page = self.page(table)?;
            let marked = published::marked(&page, table, now).ok_or_else(|| no_place(table))?;
            stale += usize::from(self.stale(table, now)?.is_some());
            if marked != page {
                output::write(&self.pages, table.page, marked.as_bytes())?;
                session.print(&format!("{}: mark changed\n", table.name))?;
                changed += 1;
            }
        }
        session.print(&format!("{stale} stale tables; {changed} marks changed\n"))
    }

    /// Measures tables and writes them to their pages, as many as the limit allows.
    fn measure(
        &self,
        session: &Session,
        chosen: &[&'static Published],
        now: &Fingerprint,
    ) -> Result<(), CliError> {
        interrupt::watch();
        let began = Instant::now();
        let (mut measured, mut left, mut failed) = (0, 0, 0);
        for table in chosen {
            if self.names.is_empty() && self.stale(table, now)?.is_none() {
                continue;
            }
            let minutes = began.elapsed().as_secs_f64() / 60.0 + f64::from(table.minutes);
            if measured > 0 && minutes > f64::from(self.limit) {
                left += 1;
                continue;
            }
            session.message(&format!("{}: {}", table.name, table.command));
            let place = published::run(table, Path::new("."), now);
            if interrupt::requested() {
                let message = "interrupted; run the same command again to resume";
                return Err(CliError::Interrupted(message.to_owned()));
            }
            match place {
                Ok(place) => {
                    let page = published::recorded(&self.page(table)?, table.name, &place);
                    let page = page.ok_or_else(|| no_place(table))?;
                    output::write(&self.pages, table.page, page.as_bytes())?;
                    measured += 1;
                }
                Err(error) => {
                    session.warn(&format!("{}: {error}", table.name));
                    failed += 1;
                }
            }
        }
        session.print(&format!("{measured} tables measured, {left} left for the next run\n"))?;
        match failed {
            0 => Ok(()),
            _ => Err(CliError::Unexpected(format!("{failed} tables could not be measured"))),
        }
    }
}

/// Refuses a page that lacks the comments of a table.
fn no_place(table: &Published) -> CliError {
    let message = format!("{} has no place for the table `{}`", table.page, table.name);
    CliError::usage(message, format!("add `<!-- table {} -->` and `<!-- end -->`", table.name))
}
