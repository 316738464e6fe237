//! `pushplan evaluate`: errors of effect models on pushes that none was trained on, and on the
//! user's own recordings.

use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;

use clap::Args;
use serde_json::json;

use crate::asset::SCHEMA_VERSION;
use crate::bench::{CrowdFamily, HeldOut, HeldOutReport, SuiteKind};
use crate::effect::EffectModel;
use crate::report::{Table, group_table, heldout_line, heldout_table};
use crate::scene::ModelSpec;

use super::{
    action::LibraryArgs,
    error::CliError,
    evaluate_crowd::{self, CrowdArgs},
    exit_code,
    model::{self, OutsideArgs},
    session::Session,
};

/// Measure prediction errors on held-out pushes, crowds and your own recordings
#[derive(Args, Debug)]
#[command(after_help = "What to measure on, any of:
  tools          all pushes of a shipped tool: single, single-any-speed, touching (default)
  sparse, dense  scenes of 6 to 12 objects, some joined, pushed by a round hand
  sparse-line    the same with one long stroke
  all            sparse and dense
  FILE           your own recordings (`pushplan schema recording`), or trajectory files

Examples:
  pushplan evaluate --on single --pushes 2000
  pushplan evaluate --on dense --objects 9 --count 50 --out plans
  pushplan evaluate runs/full/best.safetensors --on push.recording.json")]
pub struct EvaluateArgs {
    /// The model, the same as --model
    #[arg(value_name = "MODEL", conflicts_with = "model")]
    positional: Option<ModelSpec>,
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelSpec,
    #[command(flatten)]
    outside: OutsideArgs,
    /// What to measure on, see below; several may be given
    #[arg(long, value_name = "WHAT", num_args = 1..)]
    on: Vec<On>,
    /// Pushes of each kind of tool pushes
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pushes: u32,
    /// Seed of the pushes and scenes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    #[command(flatten)]
    crowd: CrowdArgs,
    #[command(flatten)]
    library: LibraryArgs,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Print Markdown tables
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
}

/// One thing to measure on.
#[derive(Clone, Debug, PartialEq, Eq)]
enum On {
    Tools(Vec<SuiteKind>),
    Crowds(Vec<CrowdFamily>),
    File(PathBuf),
}

impl FromStr for On {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        use CrowdFamily::{Dense, Sparse, SparseLine};
        Ok(match text {
            "tools" => On::Tools(SuiteKind::ALL.to_vec()),
            "single" => On::Tools(vec![SuiteKind::Single]),
            "single-any-speed" => On::Tools(vec![SuiteKind::SingleAnySpeed]),
            "touching" => On::Tools(vec![SuiteKind::Touching]),
            "sparse" => On::Crowds(vec![Sparse]),
            "sparse-line" => On::Crowds(vec![SparseLine]),
            "dense" => On::Crowds(vec![Dense]),
            "all" => On::Crowds(vec![Sparse, Dense]),
            file if file.ends_with(".safetensors") => {
                return Err("these are weights; name them before --on, or behind --model".into());
            }
            file if file.contains(['.', '/']) => On::File(PathBuf::from(file)),
            _ => {
                return Err("use tools, single, single-any-speed, touching, sparse, sparse-line, \
                            dense, all, or a recording's file"
                    .into());
            }
        })
    }
}

/// How results are shown.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    /// JSON at the end instead of tables.
    pub json: bool,
    /// Markdown tables.
    pub markdown: bool,
}

impl Shown {
    /// A table as text or Markdown.
    pub fn table(self, table: &Table) -> String {
        if self.markdown { table.to_markdown() } else { table.to_text() }
    }
}

pub fn run(args: &EvaluateArgs, session: &Session) -> Result<u8, CliError> {
    let spec = args.positional.as_ref().unwrap_or(&args.model);
    let shown = Shown { json: args.json, markdown: args.markdown };
    let mut suites = Vec::new();
    let mut families = Vec::new();
    let mut files = Vec::new();
    for on in &args.on {
        match on {
            On::Tools(kinds) => suites.extend(kinds),
            On::Crowds(named) => families.extend(named),
            On::File(path) => files.push(path.clone()),
        }
    }
    if args.on.is_empty() {
        suites = SuiteKind::ALL.to_vec();
    }
    let sources = evaluate_crowd::Sources::load(&families, &files, &args.crowd)?;
    let suites = tools(args, spec, &suites, shown, session)?;
    let crowds = evaluate_crowd::run(
        &sources,
        (spec, args.outside),
        args.seed,
        &args.crowd,
        shown,
        session,
    )?;
    if args.json {
        let mut report = json!({"schema_version": SCHEMA_VERSION});
        if !suites.is_empty() {
            report["suites"] = json!(suites);
        }
        if !crowds.is_empty() {
            report["crowds"] = json!(crowds);
        }
        session.print(&format!("{report:#}\n"))?;
    }
    Ok(exit_code::DONE)
}

/// Errors on pushes of the shipped tools.
fn tools(
    args: &EvaluateArgs,
    spec: &ModelSpec,
    kinds: &[SuiteKind],
    shown: Shown,
    session: &Session,
) -> Result<Vec<HeldOutReport>, CliError> {
    if kinds.is_empty() {
        return Ok(Vec::new());
    }
    let library = args.library.load()?;
    let mut models = vec![args.outside.load(spec)?];
    for other in model::BASELINES.map(ModelSpec::of).iter().filter(|other| *other != spec) {
        models.push(Arc::new(model::load(other)?));
    }
    let mut reports = Vec::new();
    for kind in kinds {
        let spinner = session.spinner(kind.title());
        let report = session.compute(|| {
            spinner.set_message("simulating");
            let truth = HeldOut::prepare(*kind, &library, args.seed, args.pushes as usize);
            spinner.set_message("predicting");
            let models: Vec<&dyn EffectModel> = models.iter().map(|model| &**model).collect();
            truth.report(&models)
        });
        spinner.finish_and_clear();
        if !shown.json {
            // Each as soon as it is there: the next one may take minutes.
            session.print(&text(&report, shown))?;
        }
        reports.push(report);
    }
    Ok(reports)
}

fn text(report: &HeldOutReport, shown: Shown) -> String {
    let table = shown.table(&heldout_table(report));
    let mut text = format!("{}\n\n{table}\n", heldout_line(report));
    // The planar spread comes first, then the models in their order.
    for model in report.models.iter().skip(1).take(1) {
        text += &format!("{} by shape and number of objects\n\n", model.model);
        text += &shown.table(&group_table(model));
        text.push('\n');
    }
    text
}
