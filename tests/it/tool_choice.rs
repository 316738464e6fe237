//! The reference tool benchmark: shared beginnings change nothing, the shipped goals can be made
//! again, and what is chosen is what is scored.

use std::process::Command;
use std::sync::{Arc, OnceLock};

use pushplan::bench::{
    GoalSet, Layout, Method, ReferenceSetup, StartGoals, ToolBench, ToolRecord, single_pushes,
};
use pushplan::effect::{EffectModel, EffectModels, Simulated};
use pushplan::geometry::Vector;
use pushplan::plan::{Rollouts, SequenceTree, evaluate};
use pushplan::scene::{Situation, Task};
use pushplan::sim::Simulator;

/// A start with goals that need corners and edges.
const START: usize = 9;

/// Two steps of a frame.
const STEPS: usize = 40;

fn setup() -> (ReferenceSetup, Task) {
    let setup = ReferenceSetup::new(Layout::Scattered);
    let task = setup.task(setup.starts[START], Vector::new(0.5, 0.3));
    (setup, task)
}

#[test]
fn shared_beginnings_change_no_bit_of_a_prediction() {
    let (setup, task) = setup();
    let model = EffectModels::shipped().expect("the shipped weights");
    let workspace = setup.workspace(&task);
    let grips = setup.grips(&setup.free_poses(setup.starts[START])[..2]);
    let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
    let shared = SequenceTree::roll(&workspace, &mut rollouts, &grips, STEPS);
    assert_eq!(rollouts.used(), 2 * (4 + 16 + 64));
    let whole = SequenceTree::roll_whole(&workspace, &mut rollouts, &grips, STEPS);
    let moved = shared.ends().filter(|(_, end)| end.position != setup.starts[START]).count();
    assert!(moved > 10, "only {moved} sequences move the cylinder at all");
    for ((a, at), (b, there)) in shared.ends().zip(whole.ends()) {
        assert_eq!((a, at), (b, there));
    }
    assert!(shared == whole, "the ends agree, but not every stop");
}

#[test]
fn the_planar_engine_forgets_little_at_a_shared_beginning() {
    let (setup, task) = setup();
    let planar = Simulated::new(Simulator::planar());
    let workspace = setup.workspace(&task);
    let grips = setup.grips(&setup.free_poses(setup.starts[START])[..2]);
    let mut rollouts = Rollouts::new(&planar, Situation::stated(&task.scene));
    let shared = SequenceTree::roll(&workspace, &mut rollouts, &grips, STEPS);
    let whole = SequenceTree::roll_whole(&workspace, &mut rollouts, &grips, STEPS);
    let apart: Vec<f64> = shared
        .ends()
        .zip(whole.ends())
        .map(|((_, a), (_, b))| (a.position - b.position).norm())
        .collect();
    let mean = apart.iter().sum::<f64>() / apart.len() as f64;
    assert!(mean < 1e-4, "{mean} m on average");
}

#[test]
fn the_best_stops_are_where_they_are_said_to_be() {
    let (setup, task) = setup();
    let planar = Simulated::new(Simulator::planar());
    let workspace = setup.workspace(&task);
    let poses = setup.free_poses(setup.starts[START]);
    let grips = setup.grips(&poses);
    let mut rollouts = Rollouts::new(&planar, Situation::stated(&task.scene));
    let tree = SequenceTree::roll_whole(&workspace, &mut rollouts, &grips, STEPS);
    let found = tree.best(&task.goal, 12, |_| true);
    assert_eq!(found.len(), 12);
    assert!(found.is_sorted_by(|a, b| a.score <= b.score));
    let candidates: Vec<_> = found.iter().map(|one| one.candidate.clone()).collect();
    let mut early = 0;
    for (one, made) in found.iter().zip(evaluate(&workspace, &mut rollouts, &candidates)) {
        let made = made.expect("a chained sequence can always be made");
        let said = one.score * task.goal.tolerance;
        let done = task.goal.error(&made.outcome);
        // Gliding on is estimated as free, and half a frame by a straight line.
        assert!((said - done).abs() < 1.5e-3, "{said} against {done}");
        early += usize::from(one.candidate.pushes.iter().any(|push| push.length < 0.199));
    }
    assert!(early > 0, "none of the best stops early");
    // No other stop is better: whole sequences are a coarse check of that.
    let ends = tree.ends().map(|(_, end)| (end.position - task.goal.position).norm());
    let nearest = ends.fold(f64::INFINITY, f64::min);
    assert!(found[0].score * task.goal.tolerance <= nearest);
    let only = tree.best(&task.goal, usize::MAX, |grip| grip == grips[0]);
    assert!(only.iter().all(|one| (one.candidate.tool, one.candidate.grip_yaw) == grips[0]));
}

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
    // Grown parts end 0.065 m beside the handle's axis, the cylinder begins 0.05 m before its
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
    // The goal is where a sequence ends, so trying all of them finds it, to its rounding.
    assert!(oracle.planar.error < 2e-6, "{oracle:?}");
    assert!(of(Method::First, None).planar.error < 0.02);
    assert!(of(Method::Verified, None).spatial.error <= of(Method::Placed, None).spatial.error);
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

/// The last task of the start.
fn measure(threads: usize) -> ToolRecord {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let setup = ReferenceSetup::new(Layout::Scattered);
    let goals = GoalSet::shipped(Layout::Scattered).expect("a sound file");
    let index = goals.starts[..=START].iter().map(|start| start.goals.len()).sum::<usize>() - 1;
    let model: Arc<dyn EffectModel> = EffectModels::shipped().expect("weights");
    let mut bench = ToolBench::new(setup, goals, &model, 7);
    pool.install(|| bench.measure(index)).expect("a task").record
}

#[test]
fn single_pushes_are_solved_where_they_can_be_whatever_the_number_of_threads() {
    let model: Arc<dyn EffectModel> = EffectModels::shipped().expect("the shipped weights");
    let pushed = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| single_pushes(&model, 7, 2000))
    };
    let report = pushed(2);
    assert_eq!(report, pushed(1));
    // A square of 4 m against a circle of 35 cm, and of 10 cm.
    assert!((20..80).contains(&report.near), "{report:?}");
    assert!((1..12).contains(&report.nothing), "{report:?}");
    assert!(report.solvable >= report.nothing && report.solvable < report.near, "{report:?}");
    assert_eq!(report.solvable - report.missed, report.planar, "{report:?}");
    assert!(report.missed <= 1, "{report:?}");
}

#[test]
fn a_part_of_the_benchmark_is_kept_and_shown_again() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let run = |args: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_pushplan")).args(args).output();
        let output = output.expect("the command starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let json = run(&["bench", "tools", "--shard", "118/118", "--out", out, "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON alone");
    assert_eq!(json["run"]["suite"], "tools");
    assert_eq!(json["tasks"].as_array().map(Vec::len), Some(1));
    assert!(json["tasks"][0]["seconds"]["first"].as_f64() > Some(0.0), "{json}");
    assert_eq!(json["summary"].as_array().map(Vec::len), Some(8 * 8));
    let text = run(&["bench", "report", out]);
    assert!(text.contains("1 tasks on the grid layout, brdpn-128"), "{text}");
    assert!(text.contains("stick -90, first choice"), "{text}");
    let rows = std::fs::read_to_string(folder.path().join("tasks.csv")).expect("rows");
    assert_eq!(rows.lines().count(), 1 + 8 * 8, "{rows}");
    let page = std::fs::read_to_string(folder.path().join("report.html")).expect("a page");
    assert!(page.contains("</svg>"));
}
