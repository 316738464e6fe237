//! `pushplan predict`: one action's effect, predicted beside simulated.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use serde_json::json;

use crate::asset::SCHEMA_VERSION;
use crate::effect::EffectModel;
use crate::report::{
    Align, NONE, Table, degrees, goal_line, millimetres, plan_line, point, push_table, seconds,
};
use crate::scene::{Job, ModelSpec, Record, State, Task, Trajectory, Warning};

use super::{
    action::{ActionArgs, LibraryArgs},
    error::CliError,
    exit_code,
    model::{self, OutsideArgs},
    push_argument::FORMS,
    session::Session,
};

/// Objects that move less than this are left out of the table, metres.
const STILL: f64 = 1e-4;

/// Predict what pushes do: the network beside both simulations
#[derive(Args, Debug)]
#[command(after_help = FORMS, after_long_help = FORMS)]
pub struct PredictArgs {
    /// The task whose scene is pushed
    task: PathBuf,
    #[command(flatten)]
    action: ActionArgs,
    #[command(flatten)]
    library: LibraryArgs,
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelSpec,
    #[command(flatten)]
    outside: OutsideArgs,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

struct Effect {
    trajectory: Trajectory,
    seconds: f64,
}

pub fn run(args: &PredictArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.library.load()?;
    let task = Task::load(&args.task)?;
    let (plan, tool) = args.action.plan(&task, &library, session)?;
    let motion = plan.motion(&tool);
    let mut effects = Vec::new();
    let job = Job::stated(&task.scene, motion.clone());
    let simulated = model::SIMULATED.map(ModelSpec::of);
    let simulated = simulated.into_iter().filter(|spec| *spec != args.model);
    for spec in std::iter::once(args.model.clone()).chain(simulated) {
        let model = args.outside.load(&spec)?;
        let before = model.trust(&task.scene, &job).warnings();
        let jobs = [job.clone()];
        let (found, seconds) = session.compute(|| {
            let start = Instant::now();
            let found = model.rollout(&task.scene, &jobs, Record::Outcome);
            (found, start.elapsed().as_secs_f64())
        });
        for trajectory in found {
            let by = &trajectory.by;
            for warning in &before {
                session.warn(&format!("{by}: {warning}"));
            }
            if trajectory.warnings.contains(&Warning::Refused) {
                let message = format!("{by} gives no prediction for this action");
                return Err(CliError::Refused(message));
            }
            effects.push(Effect { trajectory, seconds });
        }
    }
    for effect in &effects {
        for warning in &effect.trajectory.warnings {
            session.warn(&format!("{}: {warning}", effect.trajectory.by));
        }
    }
    if args.json {
        let effects: Vec<_> = effects
            .iter()
            .map(|effect| {
                let end = effect.trajectory.outcome();
                json!({
                    "model": effect.trajectory.by,
                    "state": end,
                    "goal_error": task.goal.error(end),
                    "warnings": effect.trajectory.warnings,
                    "seconds": effect.seconds,
                })
            })
            .collect();
        let objects: Vec<&str> = task.scene.objects.iter().map(|o| o.name.as_str()).collect();
        let report = json!({
            "schema_version": SCHEMA_VERSION, "task": task.name, "plan": plan,
            "objects": objects, "effects": effects,
        });
        session.print(&format!("{report:#}\n"))?;
    } else {
        let (line, pushes) = (plan_line(&plan), push_table(&plan).to_text());
        let effects = effect_table(&task, &effects).to_text();
        session.print(&format!("{line}\n{pushes}\n{effects}\ngoal: {}\n", goal_line(&task)))?;
    }
    Ok(exit_code::DONE)
}

fn effect_table(task: &Task, effects: &[Effect]) -> Table {
    let mut table = Table::new([
        ("object", Align::Left),
        ("model", Align::Left),
        ("final position", Align::Left),
        ("moved", Align::Right),
        ("turned", Align::Right),
        ("goal error", Align::Right),
        ("computed in", Align::Right),
    ]);
    let start = task.scene.start();
    let moved =
        |state: &State, k: usize| (state.poses[k].position - start.poses[k].position).norm();
    for (k, object) in task.scene.objects.iter().enumerate() {
        let is_goal = task.goal.object == k;
        let still = effects.iter().all(|effect| moved(effect.trajectory.outcome(), k) < STILL);
        if still && !is_goal {
            continue;
        }
        for effect in effects {
            let end = effect.trajectory.outcome();
            let turned = end.poses[k].heading - start.poses[k].heading;
            let cylinder = object.shape.is_cylinder();
            table.row([
                object.name.clone(),
                effect.trajectory.by.to_string(),
                point(end.poses[k].position),
                millimetres(moved(end, k)),
                if cylinder { NONE.to_owned() } else { degrees(turned) },
                if is_goal { millimetres(task.goal.error(end)) } else { String::new() },
                seconds(effect.seconds),
            ]);
        }
    }
    table
}
