//! `pushplan evaluate`: errors of effect models on pushes that none was trained on.

use clap::{Args, ValueEnum};
use serde_json::json;

use crate::asset::SCHEMA_VERSION;
use crate::bench::{HeldOut, HeldOutReport, SuiteKind};
use crate::effect::EffectModel;
use crate::report::{group_table, heldout_line, heldout_table};

use super::{
    action::LibraryArgs,
    error::CliError,
    exit_code,
    model::{self, ModelName},
    session::Session,
};

/// Measure prediction errors on held-out pushes, beside trivial predictors
#[derive(Args, Debug)]
#[command(after_help = "Example:
  pushplan evaluate --on single --pushes 2000")]
pub struct EvaluateArgs {
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelName,
    /// Which pushes; by default all kinds
    #[arg(long, value_enum, value_name = "KIND")]
    on: Vec<SuiteName>,
    /// Pushes of each kind
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pushes: u32,
    /// Seed of the pushes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    #[command(flatten)]
    library: LibraryArgs,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Print Markdown tables
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SuiteName {
    /// One object, 20 cm at 0.1 m/s
    Single,
    /// One object, 20 cm at 0.03 to 0.3 m/s
    SingleAnySpeed,
    /// Two or three touching objects
    Touching,
}

impl From<SuiteName> for SuiteKind {
    fn from(name: SuiteName) -> Self {
        match name {
            SuiteName::Single => SuiteKind::Single,
            SuiteName::SingleAnySpeed => SuiteKind::SingleAnySpeed,
            SuiteName::Touching => SuiteKind::Touching,
        }
    }
}

pub fn run(args: &EvaluateArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.library.load()?;
    let kinds: Vec<SuiteKind> = match args.on.as_slice() {
        [] => SuiteKind::ALL.to_vec(),
        named => named.iter().map(|name| SuiteKind::from(*name)).collect(),
    };
    let baselines = ModelName::BASELINES.into_iter().filter(|name| *name != args.model);
    let models = std::iter::once(args.model.clone())
        .chain(baselines)
        .map(|name| name.load())
        .collect::<Result<Vec<_>, CliError>>()?;
    let mut reports = Vec::new();
    for kind in kinds {
        let spinner = session.spinner(kind.title());
        let report = session.compute(|| {
            spinner.set_message("simulating");
            let truth = HeldOut::prepare(kind, &library, args.seed, args.pushes as usize);
            spinner.set_message("predicting");
            let models: Vec<&dyn EffectModel> = models.iter().map(|model| &**model).collect();
            truth.report(&models)
        });
        spinner.finish_and_clear();
        if !args.json {
            // Each as soon as it is there: the next one may take minutes.
            session.print(&text(&report, args.markdown))?;
        }
        reports.push(report);
    }
    if args.json {
        let report = json!({"schema_version": SCHEMA_VERSION, "suites": reports});
        session.print(&format!("{report:#}\n"))?;
    }
    Ok(exit_code::DONE)
}

fn text(report: &HeldOutReport, markdown: bool) -> String {
    let show = |table: crate::report::Table| {
        if markdown { table.to_markdown() } else { table.to_text() }
    };
    let mut text = format!("{}\n\n{}\n", heldout_line(report), show(heldout_table(report)));
    // The planar spread comes first, then the models in their order.
    for model in report.models.iter().skip(1).take(1) {
        text += &format!("{} by shape and number of objects\n\n", model.model);
        text += &show(group_table(model));
        text.push('\n');
    }
    text
}
