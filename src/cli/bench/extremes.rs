//! `pushplan bench extremes`: errors and warnings far outside what was trained on.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::asset::SCHEMA_VERSION;
use crate::bench::{ExtremesSettings, extremes};
use crate::cli::{error::CliError, output, session::Session};
use crate::report::{
    EXTREMES_RULE, extreme_task_table, extremes_line, extremes_page, extremes_table,
    programme_table, yardstick_table,
};

use super::common::Common;

/// Extreme sizes, masses, frictions, speeds, crowds, joints, numbers: wrong, and warned of?
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  pushplan bench extremes --out models")]
pub struct ExtremesArgs {
    #[command(flatten)]
    common: Common,
    /// Pushes a cell; few where one takes minutes of simulated time
    #[arg(long, value_name = "N", default_value_t = 22,
          value_parser = clap::value_parser!(u16).range(1..=10_000))]
    pushes: u16,
    /// Ordinary pushes of each kind, which the extreme ones are measured by
    #[arg(long, value_name = "N", default_value_t = 220,
          value_parser = clap::value_parser!(u16).range(1..=10_000))]
    ordinary: u16,
    /// Seed of the pushes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Write extremes.md and extremes.json into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub fn run(args: &ExtremesArgs, session: &Session) -> Result<(), CliError> {
    if let Some(folder) = &args.out {
        output::prepare(folder)?;
    }
    let library = args.common.library.load()?;
    let model = args.common.model_or_network().load()?;
    let settings = ExtremesSettings {
        seed: args.seed,
        pushes: usize::from(args.pushes),
        ordinary: usize::from(args.ordinary),
    };
    let bar = session.bar("cells");
    let report = session.compute(|| {
        extremes(&model, &library, &settings, &mut |done, total| {
            bar.set_length(total as u64);
            bar.set_position(done as u64);
        })
    });
    bar.finish_and_clear();
    if let Some(folder) = &args.out {
        let page = extremes_page(&report, &args.command());
        output::write(folder, "extremes.md", page.as_bytes())?;
        let json = json!({"schema_version": SCHEMA_VERSION, "extremes": report});
        output::write(folder, "extremes.json", format!("{json:#}\n").as_bytes())?;
    }
    let head = format!("{}\n\n{EXTREMES_RULE}\n", extremes_line(&report));
    let tables = [
        yardstick_table(&report.yardsticks),
        extremes_table(&report.cells),
        programme_table(&report.programmes),
        extreme_task_table(&report.tasks),
    ];
    args.common.form.print(session, "extremes", &report, &head, &tables)
}

impl ExtremesArgs {
    /// The command line that makes the same page.
    fn command(&self) -> String {
        let Self { pushes, ordinary, seed, .. } = self;
        format!("pushplan bench extremes --pushes {pushes} --ordinary {ordinary} --seed {seed}")
    }
}
