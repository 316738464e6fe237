//! What accepted files of levering must survive: a search without physics, one coarse lever-up, a
//! replay, and being written and read again.

use std::sync::Arc;

use pushplan::asset::{LeverPlanFile, ToolLibrary};
use pushplan::effect::{LeverModel, LeverTrust};
use pushplan::geometry::Vector;
use pushplan::scene::{
    Ending, FollowUp, LEVER_FRAMES, LeverJob, LeverPlan, LeverTrajectory, LeverUp, Place, Plan,
    Push, PushForm, Task, Tool,
};
use pushplan::solve::lever::{LeverPlanner, LeverSettings};
use pushplan::verify::{LeverVerifier, VerifySettings};

/// Longer lever-ups and larger scenes show nothing new.
const LONGEST: f64 = 6.0;
const CROWD: usize = 20;

pub fn blade(tool: Tool) {
    let text = serde_json::to_string(&tool.to_json()).expect("numbers");
    assert_eq!(Tool::parse(&text, "again.yaml").expect("what was read"), tool);
}

pub fn task(task: Task) {
    let text = task.to_yaml().expect("a task that was read");
    let again = Task::parse(&text, "again.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.scene.objects, task.scene.objects);
    let library = ToolLibrary::embedded().expect("the shipped tools are sound");
    let bodies = task.scene.objects.len() + task.scene.obstacles.len();
    let small = bodies < CROWD && task.lever_rules().speed > 0.05;
    let settings = LeverSettings {
        simulated: usize::from(small),
        doubts: 0,
        verified_at_once: 1,
        verify_batches: 0,
        disturbed: 0,
        followed: 0,
    };
    if task.levers.is_none() {
        return;
    }
    let Ok(tools) = task.blades(&library) else { return };
    if tools.len() > 2 {
        return;
    }
    let planner = LeverPlanner::new(Still, Default::default()).with_settings(settings);
    match planner.solve(&task, &library) {
        Ok(solution) => {
            for ranked in &solution.plans {
                assert!(ranked.merit.is_finite() && ranked.predicted.score.is_finite());
                assert!(ranked.predicted.raised.is_finite(), "{:?}", ranked.predicted);
            }
        }
        Err(refused) => panic!("a task file that cannot be tried: {refused}"),
    }
}

pub fn plan(file: LeverPlanFile) {
    let lever = &file.plan.lever;
    let small = file.task.scene.objects.len() + file.task.scene.obstacles.len() < CROWD;
    let pushed = file.plan.follow_up.as_ref().map_or(0.0, |then| {
        then.plan.pushes.iter().map(|push| push.length / push.speed).sum::<f64>()
    });
    if lever.speed > 0.0 && lever.duration() + pushed < LONGEST && small {
        let verifier = LeverVerifier::new(VerifySettings { disturbed: 1, seed: 1 });
        let verdict = verifier.verify(&file.task, &file.tool, &file.plan);
        assert!(verdict.evidence.iter().all(|evidence| evidence.outcome.score.is_finite()));
    }
}

/// Nothing moves.
struct Still;

impl LeverModel for Still {
    fn name(&self) -> String {
        "still".into()
    }

    fn trust(&self, _: &LeverJob) -> LeverTrust {
        LeverTrust::Mine { p95: None }
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        let still = |job: &LeverJob| {
            let start = job.scene.plates[job.lever.plate].start();
            LeverTrajectory {
                lift: vec![start; LEVER_FRAMES],
                held: vec![false; LEVER_FRAMES],
                rest: start,
                ending: Ending::Back,
                warnings: Vec::new(),
            }
        };
        jobs.iter().map(still).collect()
    }
}

/// Plans of shipped tasks, which need not lead anywhere.
pub fn plans() -> Vec<(String, Vec<u8>)> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tasks/levers");
    let library = ToolLibrary::embedded().expect("the shipped tools are sound");
    let plan = |name: &str| {
        let task = Task::load(root.join(format!("{name}.yaml"))).ok()?;
        let tool = Arc::clone(task.blades(&library).ok()?.first()?);
        let lever = LeverUp {
            plate: task.goal.object,
            place: Place { edge: 1, fraction: 0.5 },
            depth: 0.012,
            pivot: 0.1,
            angle: 1.0,
            speed: 0.1,
            hold: 0.1,
            retreat: 0.05,
        };
        let pusher = || library.get("t-head").map(Arc::clone);
        let follow_up =
            Some(()).filter(|()| task.pushes.max_count > 0).and_then(|()| pusher()).map(then);
        let plan = LeverPlan { tool: tool.name.clone(), lever, follow_up };
        let file = LeverPlanFile { task, tool, plan, model: None, predicted: None, verdict: None };
        Some((name.to_owned(), serde_json::to_vec(&file).ok()?))
    };
    ["raise-plate", "drive-board", "turn-and-push"].into_iter().filter_map(plan).collect()
}

/// A push across the table.
fn then(tool: Arc<Tool>) -> FollowUp {
    let push = Push { start: Vector::new(0.3, 0.0), direction: 0.0, length: 0.2, speed: 0.1 };
    let plan = Plan {
        tool: tool.name.clone(),
        grip_yaw: 0.0,
        form: PushForm::Placed,
        lift: 0.002,
        pushes: vec![push],
    };
    FollowUp { tool, plan }
}
