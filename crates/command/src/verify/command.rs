//! Arguments of `verify`, our own replays and the report.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde_json::json;

use pushplan::asset::{Faults, PlanFile};
use pushplan::outcome::Verdict;
use pushplan::progress::{Progress, Until};
use pushplan::scene::Situation;
use pushplan::verify::{Verifier, VerifySettings};
use pushplan_report::{
    Document, Judged, PageView, Recipe, SecondOpinion, replay_warnings, verdict_document,
};

use super::super::{
    error::CliError,
    exit_code,
    form::Form,
    interrupt, output, page,
    progress::TerminalProgress,
    session::Session,
    solve::{share, time_limit},
    value_enums::{JUDGES, Judge, VIEWS, possible_values},
};
use super::mujoco::second_opinion;
use super::python::Python;

/// Estimated duration above which replays are announced, seconds.
const LONG: f64 = 20.0;

/// Verify plans by nominal and perturbed replays in the 2-D and the 3-D engine, or in MuJoCo
#[derive(Args, Debug)]
#[command(
    after_help = "Exit code 0: every plan passes. It keeps the rules of its task, its nominal \
replays reach the goal in both engines, and so does the required share of its perturbed replays. \
7: only perturbed replays fail. 5: a plan does not work.

With --engine mujoco, MuJoCo also plays the exported plan, and its verdict gives the exit code. 0: \
every plan keeps the rules of its task and reaches the goal in MuJoCo. 5: a plan does not. Text, \
JSON (second_opinion) and page show both verdicts. It needs Python 3.11 with `pip install mujoco`: \
`python3`, or the Python that the environment variable PUSHPLAN_PYTHON names.

Examples:
  pushplan verify plans/pull-back.plan.json --replays 64
  pushplan verify plans/pull-back.plan.json --engine mujoco --out plans"
)]
pub struct VerifyArgs {
    /// Plan files, which also contain the task and the tools
    #[arg(required = true, value_name = "PLAN")]
    plans: Vec<PathBuf>,
    /// Physics whose verdict gives the exit code
    #[arg(long, value_parser = possible_values(&JUDGES), value_name = "ENGINE",
          default_value = "built-in")]
    engine: Judge,
    /// Minimum number of perturbed replays per engine; up to 64 until the verdict is clear. 3-D
    /// replays are skipped if too few clearly succeed in 2-D
    #[arg(long, value_name = "N", default_value_t = 8,
          value_parser = clap::value_parser!(u32).range(0..=100_000))]
    replays: u32,
    /// Share of the perturbed replays that must reach the goal, 0 to 1 [default: `robustness` of
    /// the task]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    robustness: Option<f64>,
    /// Time limit in seconds for each plan and engine, after which the finished replays are
    /// reported
    #[arg(long, value_name = "SECONDS", value_parser = time_limit)]
    time_limit: Option<Duration>,
    /// Seed of the perturbations
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Folder for pages that play the replays, named after the tasks
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// View on the page
    #[arg(long, value_parser = possible_values(&VIEWS), value_name = "VIEW",
          default_value = "2d", requires = "out")]
    page: PageView,
    #[command(flatten)]
    form: Form,
}

/// Plan with the verdict of our engines.
struct Replayed<'a> {
    path: &'a Path,
    file: &'a PlanFile,
    verdict: Verdict,
}

pub fn run(args: &VerifyArgs, session: &Session) -> Result<u8, CliError> {
    args.out.as_deref().map(output::prepare).transpose()?;
    let mut files = opened(args)?;
    let python = match args.engine {
        Judge::BuiltIn => None,
        Judge::Mujoco => Some(Python::with_mujoco()?),
    };
    interrupt::watch();
    let mut replayed = Vec::new();
    for (path, file) in &mut files {
        file.task.robustness = args.robustness.unwrap_or(file.task.robustness);
        replayed.push(Replayed { path, file, verdict: verified(args, session, file)? });
    }
    let seconds = match &python {
        Some(python) => opinions(args, session, python, &replayed)?,
        None => vec![None; replayed.len()],
    };
    let (mut code, mut documents, mut failed) = (exit_code::DONE, Vec::new(), None);
    for (one, second) in replayed.iter().zip(&seconds) {
        let judged = Judged { verdict: &one.verdict, second: second.as_ref() };
        let mut document = verdict_document(one.file, judged);
        match written(args, session, one, judged) {
            Ok(pages) if pages.is_empty() => (),
            Ok(pages) => document.wrote(&pages),
            Err(error) => failed = failed.or(Some(error)),
        }
        documents.push(document);
        code = worse(code, code_of(judged));
    }
    show(args, session, &documents)?;
    failed.map_or(Ok(interrupt::code(code)), Err)
}

/// Reads the plans, with the faults of all files.
fn opened(args: &VerifyArgs) -> Result<Vec<(&Path, PlanFile)>, CliError> {
    let (mut files, mut faults) = (Vec::new(), Vec::new());
    for path in &args.plans {
        match PlanFile::load(path) {
            Ok(file) => files.push((path.as_path(), file)),
            Err(found) => faults.extend(found.0),
        }
    }
    if !faults.is_empty() {
        return Err(Faults(faults).into());
    }
    let names: Vec<String> = files.iter().map(|(_, file)| page::name(file)).collect();
    let twice = names.iter().enumerate().find(|(k, name)| names[..*k].contains(name));
    match twice {
        Some((_, name)) if args.out.is_some() => Err(CliError::usage(
            format!("the pages of two plans would be written to {name}"),
            "verify them one after another with different folders",
        )),
        _ => Ok(files),
    }
}

/// Replays a plan in our engines.
fn verified(args: &VerifyArgs, session: &Session, file: &PlanFile) -> Result<Verdict, CliError> {
    let settings = VerifySettings { replays: args.replays as usize, seed: args.seed };
    let situation = Situation::stated(&file.task.scene);
    let following = TerminalProgress::spinner(session, "replaying");
    let until = Until::new(&following, args.time_limit);
    let verifier =
        Verifier::new(settings).with_progress(&until).until_clear().moving(file.joints.as_ref());
    let seconds = verifier.seconds(&file.task.scene, &file.plan) / session.threads() as f64;
    if seconds > LONG {
        session.warn(&format!(
            "replaying this plan takes about {seconds:.0} s; stop it with Ctrl-C or \
             `--time-limit`, or shorten it with `--replays 0`"
        ));
    }
    let verdict =
        session.compute(|| verifier.verify(&file.task, &situation, &file.tools, &file.plan));
    following.finish()?;
    session.warn_each(&replay_warnings(&verdict));
    Ok(verdict)
}

/// Replays the plans in MuJoCo, several at the same time.
fn opinions(
    args: &VerifyArgs,
    session: &Session,
    python: &Python,
    replayed: &[Replayed],
) -> Result<Vec<Option<SecondOpinion>>, CliError> {
    let following = TerminalProgress::spinner(session, "replaying in MuJoCo");
    let found: Result<Vec<_>, CliError> = session.compute(|| {
        let each = replayed.par_iter().map(|Replayed { path, file, verdict }| {
            let until = Until::new(&following, args.time_limit);
            let name = path.display().to_string();
            second_opinion(python, (&name, file), verdict, &|| until.cancelled()).map(Some)
        });
        each.collect()
    });
    following.finish()?;
    found
}

/// Writes the page of a plan if there is a folder for it, and returns its path.
fn written(
    args: &VerifyArgs,
    session: &Session,
    one: &Replayed,
    judged: Judged,
) -> Result<Vec<PathBuf>, CliError> {
    let Some(out) = args.out.as_deref() else { return Ok(Vec::new()) };
    let recipe = Recipe::of_plan_file(&one.path.display().to_string());
    page::write(out, session, one.file, judged, (recipe, args.page)).map(|path| vec![path])
}

/// Prints the report of a plan, or the reports of several plans one after another.
fn show(args: &VerifyArgs, session: &Session, documents: &[Document]) -> Result<(), CliError> {
    if let [document] = documents {
        return args.form.show(session, document);
    }
    for document in documents {
        args.form.show_part(session, document)?;
    }
    let plans: Vec<_> = documents.iter().map(|document| &document.json).collect();
    let whole = Document { json: json!({"plans": plans}), ..Document::default() };
    args.form.show_rest(session, &whole, false)
}

/// Returns the exit code of a plan.
fn code_of(Judged { verdict, second }: Judged) -> u8 {
    match (second.map(|second| second.passed), verdict.passed, verdict.nominal_ok()) {
        (Some(true), ..) | (None, true, _) => exit_code::DONE,
        (None, false, true) => exit_code::FRAGILE,
        _ => exit_code::FAILED_VERIFICATION,
    }
}

/// Returns the worse of two exit codes.
fn worse(one: u8, other: u8) -> u8 {
    let order = [exit_code::DONE, exit_code::FRAGILE, exit_code::FAILED_VERIFICATION];
    let rank = |code: &u8| order.iter().position(|known| known == code);
    [one, other].into_iter().max_by_key(rank).unwrap_or(one)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_plan_gives_the_exit_code() {
        for (one, other, both) in [(0, 0, 0), (0, 7, 7), (7, 0, 7), (5, 7, 5), (7, 5, 5), (0, 5, 5)]
        {
            assert_eq!(worse(one, other), both);
        }
    }
}
