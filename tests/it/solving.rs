//! The planner from end to end, with the planar engine as effect model.

use std::path::PathBuf;

use pushplan::asset::{ToolLibrary, load_task};
use pushplan::effect::Simulated;
use pushplan::sim::Simulator;
use pushplan::solve::{PlanStatus, Planner, Solution};

fn planner() -> Planner {
    Planner::builder(Simulated::new(Simulator::planar())).build()
}

#[test]
fn every_shipped_task() {
    let library = ToolLibrary::embedded().unwrap();
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tasks");
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let planner = planner();
    for path in paths {
        let task = load_task(&path, &library).unwrap();
        let solution = planner.solve(&task, &library).unwrap();
        println!("{}", row(&task.name, &solution));
        let expected = match task.name.as_str() {
            "too-far" => PlanStatus::NoPlan,
            _ => PlanStatus::Solved,
        };
        assert_eq!(solution.status, expected, "{}", task.name);
    }
}

/// One line of numbers, shown by `cargo test -- solving --nocapture`.
fn row(name: &str, solution: &Solution) -> String {
    let (statistics, best) = (&solution.statistics, &solution.plans[0]);
    let timing = statistics.timing;
    let replayed = best.verdict.as_ref().map(|verdict| {
        let errors: Vec<String> = verdict
            .evidence
            .iter()
            .take(2)
            .map(|evidence| format!("{:.1}", evidence.outcome.error * 1e3))
            .collect();
        format!("planar, 3-D {} mm, robust {:?}", errors.join(", "), verdict.robustness)
    });
    format!(
        "{name}: {:?} in {:.2} s ({:.2} + {:.2} + {:.2}), {} rollouts, {} verified; {} at {:.0} deg, \
         {} pushes, predicted {:.1} -> {:.1} mm; {}",
        solution.status,
        timing.total,
        timing.search,
        timing.refinement,
        timing.verification,
        statistics.rollouts,
        statistics.verified,
        best.plan.tool,
        best.plan.grip_yaw.to_degrees(),
        best.plan.pushes.len(),
        best.refinement.before * 1e3,
        best.outcome.error * 1e3,
        replayed.unwrap_or_default(),
    )
}
