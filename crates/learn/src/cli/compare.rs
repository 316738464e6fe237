//! `pushplan-learn compare`: errors of a model on a data set, relative to the analytic model.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::scene::ModelSpec;
use pushplan_command::error::CliError;
use pushplan_command::exit_code;
use pushplan_command::form::Form;
use pushplan_command::model::{self, OutOfRangeArgs};
use pushplan_command::session::Session;
use pushplan_report::Align::{Left, Right};
use pushplan_report::{Document, NONE, Section, Table, fine_millimetres};
use serde_json::json;

use crate::compare::{Compared, compared};
use crate::dataset::Dataset;

use super::train::data;

/// Compare an effect model with the analytic model on data of any engine
#[derive(Args, Debug)]
#[command(
    after_help = "Errors are final positions, means over objects that move more than 1 cm. A \
ratio below 1 is better than the analytic model. Use data of a seed that no training used.

Example:
  pushplan-learn generate data/judge --preset placed --truth mujoco --episodes 420 --seed 23
  pushplan-learn compare data/judge"
)]
pub struct CompareArgs {
    /// Folder of data from `generate`
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelSpec,
    #[command(flatten)]
    out_of_range: OutOfRangeArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &CompareArgs, session: &Session) -> Result<u8, CliError> {
    let model = args.out_of_range.load(&args.model)?;
    let set = data(session, "data", |_| Dataset::open(&args.folder))?;
    let rows = session.compute(|| compared(&*model, &set));
    args.form.show(session, &document(&args.model.to_string(), &rows))?;
    Ok(exit_code::DONE)
}

fn document(model: &str, rows: &[Compared]) -> Document {
    let number = |value: Option<f64>| value.map_or(NONE.to_owned(), |value| format!("{value:.2}"));
    let table = Table::of(
        rows,
        &[
            ("pushes", Left, &|row| row.kind.to_owned()),
            ("number", Right, &|row| row.pushes.to_string()),
            ("prior", Right, &|row| fine_millimetres(row.prior)),
            (model, Right, &|row| fine_millimetres(row.model)),
            ("ratio", Right, &|row| format!("{:.3} ± {:.3}", row.ratio(), row.ratio_error)),
            ("rank", Right, &|row| number(row.rank)),
            ("within 90 %", Right, &|row| number(row.within_90)),
        ],
    );
    Document {
        title: format!("{model} against the analytic model"),
        sections: vec![Section { table, ..Section::default() }],
        json: json!({"model": model, "kinds": rows}),
        ..Document::default()
    }
}
