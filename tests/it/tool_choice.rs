//! The reference tool benchmark: the shipped goals are reproducible, and the scores match the
//! chosen tools.

use std::sync::{Arc, OnceLock};

use pushplan::effect::EffectModels;
use pushplan::geometry::Vector;
use pushplan::scene::ModelKind;
use pushplan::solve::{Effort, Planner};
use pushplan_bench::{
    GoalSet, Layout, Method, ReferenceSetup, StartGoals, ToolBench, ToolForm, ToolRecord,
};

use crate::program::succeed;

/// Start with goals that need corners and edges.
const START: usize = 9;

#[test]
fn the_shipped_goals_of_a_start_are_made_again() {
    for layout in Layout::ALL {
        let setup = ReferenceSetup::new(layout);
        let shipped = GoalSet::shipped(layout).expect("a sound file");
        assert_eq!(shipped.starts.len(), 24);
        let starts: Vec<Vector> =
            shipped.starts.iter().map(|start| Vector::from(start.start)).collect();
        for (a, b) in starts.iter().zip(&setup.starts) {
            assert!((a - b).norm() < 1e-6, "{layout:?}: {a} is not {b}");
        }
        for start in &shipped.starts {
            for (k, goal) in start.goals.iter().enumerate() {
                let at = Vector::from(goal.at);
                let others = start.goals[..k].iter().map(|other| Vector::from(other.at));
                let near = others.chain([Vector::from(start.start)]);
                assert!(near.into_iter().all(|other| (other - at).norm() > 0.05 - 2e-6));
            }
        }
        let made = StartGoals::make(&setup, setup.starts[START]);
        let shipped = &shipped.starts[START];
        assert_eq!(made.goals.len(), shipped.goals.len(), "{layout:?}");
        assert!(!made.goals.is_empty());
        for (made, shipped) in made.goals.iter().zip(&shipped.goals) {
            assert_eq!((&made.pose, &made.pushes), (&shipped.pose, &shipped.pushes));
            let apart = (Vector::from(made.at) - Vector::from(shipped.at)).norm();
            assert!(apart < 3e-6, "{layout:?}: {made:?} was {shipped:?}");
        }
    }
}

#[test]
fn a_tool_pose_is_skipped_where_the_cylinder_is_in_its_way() {
    let setup = ReferenceSetup::new(Layout::Grid);
    let names = |x: f64, y: f64| -> Vec<&str> {
        let free = setup.free_poses(Vector::new(x, y));
        free.into_iter().map(|pose| setup.poses[pose].name.as_str()).collect()
    };
    let all: Vec<&str> = setup.poses.iter().map(|pose| pose.name.as_str()).collect();
    assert_eq!(
        all,
        ["stick 0", "stick -90", "stick 90", "l 0", "l -90", "inverse-l 0", "inverse-l 90"]
    );
    assert_eq!(names(0.725, 0.5), all);
    // Grown parts end 0.065 m beside the handle's axis, and the cylinder begins 0.05 m before its
    // centre: 0.114 m aside is too near, 0.116 m is not.
    for (y, kept) in [(0.114, false), (0.116, true)] {
        assert_eq!(names(0.25, y).contains(&"stick 0"), kept, "{y}");
    }
    // In the corner of the L, but beside the inverse one.
    let corner = names(0.5, 0.12);
    assert!(!corner.contains(&"l 0") && corner.contains(&"inverse-l 0"), "{corner:?}");
}

#[test]
fn methods_are_ordered_as_they_must_be_and_no_thread_count_changes_them() {
    let record = measured(2);
    assert_eq!(*record, measure(1));
    let of = |method: Method, pose: Option<usize>| {
        let mut trials = record.trials.iter();
        trials.find(|trial| trial.method == method && trial.pose == pose).expect("a trial")
    };
    let nothing = of(Method::Nothing, None);
    let oracle = of(Method::Oracle, None);
    assert!(nothing.planar.error > 0.05 && nothing.pushes == 0 && nothing.travel == 0.0);
    // The goal is the end of a sequence, so trying all sequences finds it, up to rounding.
    assert!(oracle.planar.error < 2e-6, "{oracle:?}");
    assert!(of(Method::First, None).planar.error < 0.02);
    let planned = of(Method::Planned, None);
    assert!(planned.spatial.sound && planned.spatial.error <= 0.05, "{planned:?}");
    assert!(planned.attempts.is_some_and(|attempts| attempts > 0));
    for pose in 0..7 {
        let (alone, nothing) = (of(Method::Oracle, Some(pose)), of(Method::Nothing, Some(pose)));
        assert!(alone.planar.error >= oracle.planar.error);
        assert!(alone.planar.error <= nothing.planar.error);
        assert!(alone.taken.is_none_or(|taken| taken == pose), "{alone:?}");
    }
}

fn measured(threads: usize) -> &'static ToolRecord {
    static RECORD: OnceLock<ToolRecord> = OnceLock::new();
    RECORD.get_or_init(|| measure(threads))
}

/// Measures the last task of the start.
fn measure(threads: usize) -> ToolRecord {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let setup = ReferenceSetup::new(Layout::Scattered);
    let goals = GoalSet::shipped(Layout::Scattered).expect("a sound file");
    let index = goals.starts[..=START].iter().map(|start| start.goals.len()).sum::<usize>() - 1;
    let model = EffectModels::build(&ModelKind::NETWORK.into()).expect("weights");
    let planner = Planner::for_effort(Effort::Draft).expect("weights").build();
    let mut bench = ToolBench::new(setup, goals, Arc::new(model), planner, 7);
    pool.install(|| bench.measure(index)).expect("a task").record
}

#[test]
fn every_single_goal_is_the_end_of_some_push_whatever_the_number_of_threads() {
    let setup = ReferenceSetup::new(Layout::Grid).with_form(ToolForm::Single);
    let drawn = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| GoalSet::single(&setup, 7, 40))
    };
    let goals = drawn(2);
    assert_eq!(goals, drawn(1));
    assert_eq!(goals.len(), 40);
    for start in &goals.starts {
        let [goal] = &start.goals[..] else { panic!("{start:?}") };
        let away = (Vector::from(goal.at) - Vector::from(start.start)).norm();
        // Further than the coarse threshold, and no further than the travel and a short glide.
        assert!((0.10..0.21).contains(&away), "{start:?}");
        assert!(setup.pose(&goal.pose).is_some(), "{goal:?}");
    }
    let others = GoalSet::single(&setup, 8, 40);
    assert!(goals.starts.iter().zip(&others.starts).all(|(one, other)| one != other));

    let model = EffectModels::build(&ModelKind::NETWORK.into()).expect("the shipped weights");
    let planner = Planner::for_effort(Effort::Draft).expect("weights").build();
    let mut bench = ToolBench::new(setup, goals, Arc::new(model), planner, 7);
    let mut unreachable = 0;
    for index in 0..2 {
        let record = bench.measure(index).expect("a task").record;
        let of = |method: Method, pose: Option<usize>| {
            let mut trials = record.trials.iter();
            trials.find(|trial| trial.method == method && trial.pose == pose).expect("a trial")
        };
        // The witness is among the executed pushes, up to the rounding of the goal.
        assert!(of(Method::Oracle, None).planar.error < 2e-6, "{record:?}");
        assert!(of(Method::Nothing, None).planar.error > 0.10, "{record:?}");
        assert!(record.trials.iter().all(|trial| trial.pushes <= 1), "{record:?}");
        unreachable +=
            (0..7).filter(|&pose| of(Method::Oracle, Some(pose)).planar.error > 0.05).count();
    }
    assert!((1..14).contains(&unreachable), "no difference between tools: {unreachable}");
}

#[test]
fn some_goals_are_spread_over_the_starts() {
    let goals = GoalSet::shipped(Layout::Grid).expect("a sound file");
    let all = goals.len();
    for count in [1, 16, 24, all - 1, all, all + 1] {
        let some = goals.clone().evenly(count);
        assert_eq!(some.len(), count.min(all));
        let each = some.starts.iter().zip(&goals.starts);
        assert!(each.clone().all(|(few, all)| few.start == all.start));
        assert!(
            each.flat_map(|(few, all)| few.goals.iter().map(move |goal| (goal, all)))
                .all(|(goal, all)| all.goals.contains(goal))
        );
    }
    let met = |goals: GoalSet| goals.starts.iter().filter(|one| !one.goals.is_empty()).count();
    assert!(met(goals.evenly(16)) >= 12);
}

#[test]
fn a_part_of_the_benchmark_is_kept_and_shown_again() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let run = |line: &str| String::from_utf8(succeed(line).stdout).expect("UTF-8");
    let json = run(&format!("bench tools --effort draft --shard 16/16 --out {out} --json"));
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON alone");
    assert_eq!(json["run"]["suite"], "tools");
    assert_eq!(json["tasks"].as_array().map(Vec::len), Some(1));
    assert!(json["tasks"][0]["seconds"]["first"].as_f64() > Some(0.0), "{json}");
    assert_eq!(json["summary"].as_array().map(Vec::len), Some(6 * 8));
    let text = run(&format!("bench report {out}"));
    assert!(text.contains("1 tasks on the grid layout, network"), "{text}");
    assert!(text.contains("stick -90, first choice"), "{text}");
    let rows = std::fs::read_to_string(folder.path().join("tasks.csv")).expect("rows");
    assert_eq!(rows.lines().count(), 1 + 6 * 8, "{rows}");
    let page = std::fs::read_to_string(folder.path().join("report.html")).expect("a page");
    assert!(page.contains("</svg>"));
}
