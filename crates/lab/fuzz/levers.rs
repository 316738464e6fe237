//! Uses that accepted lever files must survive: a search with little physics, a replay, and a round
//! trip through a file.

use std::sync::Arc;

use pushplan::asset::{PlanFile, ToolLibrary};
use pushplan::geometry::Vector;
use pushplan::solve::{LeverSettings, Settings};
use pushplan::verify::{Verifier, VerifySettings};
use pushplan::{Planner, Simulated, Simulator};
use pushplan::{
    scene::{Situation, Tool},
    task::{LeverUp, Place, Plan, Push, PushForm, Task},
};

/// Limits of lever-ups and scenes, beyond which nothing new is found.
const LONGEST: f64 = 6.0;
const CROWD: usize = 20;

pub fn blade(tool: Tool) {
    let text = serde_json::to_string(&tool.to_json()).expect("numbers");
    assert_eq!(Tool::parse(&text, "again.yaml").expect("a readable tool"), tool);
}

pub fn task(task: Task) {
    let text = task.to_yaml().expect("a task that was read");
    let again = Task::parse(&text, "again.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.scene.objects, task.scene.objects);
    if task.levers.is_none() {
        return;
    }
    let library = ToolLibrary::embedded().expect("the shipped tools are sound");
    let bodies = task.scene.objects.len() + task.scene.obstacles.len();
    let small = bodies < CROWD && task.lever_rules().speed > 0.05;
    let levers = LeverSettings {
        simulated: usize::from(small),
        doubts: 0,
        verified_at_once: 1,
        verify_batches: 0,
        replays: 0,
        followed: 0,
    };
    let Ok(tools) = task.blades(&library) else { return };
    if tools.len() > 2 || !small {
        return;
    }
    let settings = Settings { levers, ..Settings::FIRST_LOOK };
    let planner = Planner::builder(Simulated::new(Simulator::planar())).settings(settings).build();
    // Pushes have their own target, and pushing tools cannot lever.
    let blades = tools.iter().map(|tool| tool.name.clone());
    let alone = task.clone().pushing(pushplan::PushRules::none()).with_tools(blades);
    match planner.solve(&alone, &library) {
        Ok(solution) => {
            for ranked in &solution.plans {
                assert!(ranked.outcome.score().is_finite());
            }
        }
        Err(refused) => panic!("a task file that cannot be tried: {refused}"),
    }
}

pub fn plan(file: PlanFile) {
    let pushing = file.plan.push_steps().map(|step| step.push.duration());
    let levering = file.plan.lever_steps().map(|step| step.lever.duration());
    let span: f64 = pushing.chain(levering).sum();
    let small = file.task.scene.objects.len() + file.task.scene.obstacles.len() < CROWD;
    if span < LONGEST && small {
        let verifier = Verifier::new(VerifySettings { replays: 1, seed: 1 });
        let situation = Situation::stated(&file.task.scene);
        let verdict = verifier.verify(&file.task, &situation, &file.tools, &file.plan);
        assert!(verdict.evidence.iter().all(|evidence| evidence.outcome.error().is_finite()));
    }
}

/// Returns plans of shipped tasks, which need not reach the goal.
pub fn plans() -> Vec<(String, Vec<u8>)> {
    let root =
        std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("tasks/levers");
    let library = ToolLibrary::embedded().expect("the shipped tools are sound");
    let plan = |name: &str| {
        let task = Task::load(root.join(format!("{name}.yaml"))).ok()?;
        let mut tools: Vec<Arc<Tool>> = task.blades(&library).ok()?.into_iter().take(1).collect();
        let lever = LeverUp {
            plate: task.goals[0].object,
            place: Place { edge: 1, fraction: 0.5 },
            depth: 0.012,
            pivot: 0.1,
            angle: 1.0,
            speed: 0.1,
            hold: 0.1,
            retreat: 0.05,
        };
        let mut plan = Plan::levering(&tools.first()?.name, lever);
        if task.pushes.max_count > 0 {
            let start = Vector::new(0.3, 0.0);
            let push = Push { start, direction: 0.0, length: 0.2, speed: 0.1 };
            plan = plan.then(Plan::pushing("t-head", 0.0, PushForm::Placed, 0.002, [push]));
            tools.push(Arc::clone(library.get("t-head")?));
        }
        let file = PlanFile::new(task, tools, plan);
        Some((name.to_owned(), serde_json::to_vec(&file).ok()?))
    };
    ["raise-plate", "drive-board", "turn-and-push"].into_iter().filter_map(plan).collect()
}
