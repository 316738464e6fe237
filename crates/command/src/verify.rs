//! `pushplan verify`: replays a plan and gives a verdict.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use pushplan::asset::PlanFile;
use pushplan::progress::Until;
use pushplan::scene::Situation;
use pushplan::verify::{Verifier, VerifySettings};
use pushplan_report::{PageView, Recipe, replay_warnings, verdict_document};

use super::{
    error::CliError,
    exit_code,
    form::Form,
    output, page,
    progress::TerminalProgress,
    session::Session,
    solve::{share, time_limit},
    value_enums::{VIEWS, possible_values},
};

/// Estimated duration above which replays are announced, seconds.
const LONG: f64 = 20.0;

/// Verify a plan by nominal and perturbed replays in the 2-D and the 3-D engine
#[derive(Args, Debug)]
#[command(
    after_help = "Exit code 0: the plan passes. It keeps the rules of its task, its nominal \
replays reach the goal in both engines, and so does the required share of its perturbed replays. \
7: only the perturbed replays fail. 5: the plan does not work.

Example:
  pushplan verify plans/pull-back.plan.json --replays 64"
)]
pub struct VerifyArgs {
    /// Plan file, which also contains the task and the tools
    plan: PathBuf,
    /// Minimum number of perturbed replays per engine; up to 64 until the verdict is clear. 3-D
    /// replays are skipped if too few clearly succeed in 2-D
    #[arg(long, value_name = "N", default_value_t = 8,
          value_parser = clap::value_parser!(u32).range(0..=100_000))]
    replays: u32,
    /// Share of the perturbed replays that must reach the goal, 0 to 1 [default: `robustness` of
    /// the task]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    robustness: Option<f64>,
    /// Time limit in seconds, after which the finished replays are reported
    #[arg(long, value_name = "SECONDS", value_parser = time_limit)]
    time_limit: Option<Duration>,
    /// Seed of the perturbations
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Folder for a page that plays the replays, named after the task
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// View on the page
    #[arg(long, value_parser = possible_values(&VIEWS), value_name = "VIEW",
          default_value = "2d", requires = "out")]
    page: PageView,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &VerifyArgs, session: &Session) -> Result<u8, CliError> {
    args.out.as_deref().map(output::prepare).transpose()?;
    let mut file = PlanFile::load(&args.plan)?;
    file.task.robustness = args.robustness.unwrap_or(file.task.robustness);
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
    for warning in replay_warnings(&verdict) {
        session.warn(&warning);
    }
    let mut document = verdict_document(&file, &verdict);
    let written = args.out.as_deref().map(|out| {
        let recipe = Recipe::of_plan_file(&args.plan.display().to_string());
        page::write(out, session, &file, &verdict, (recipe, args.page))
    });
    if let Some(Ok(path)) = &written {
        document.wrote(std::slice::from_ref(path));
    }
    args.form.show(session, &document)?;
    written.transpose()?;
    Ok(match (verdict.passed, verdict.nominal_ok()) {
        (true, _) => exit_code::DONE,
        (false, true) => exit_code::FRAGILE,
        (false, false) => exit_code::FAILED_VERIFICATION,
    })
}
