//! Scattered and dense crowds: contents, validity of every draw, joints and constraints.

use pushplan::progress::NoProgress;
use pushplan::{
    geometry::{Footprint, Pose, Shape, clearance, contact_points},
    outcome::{Record, Trajectory},
    scene::{JOINABLE, JointKind},
    sim::Simulator,
    task::Job,
};
use pushplan_bench::store::{Shard, StoreError};
use pushplan_learn::dataset::{
    Constraints, Dataset, DatasetConfig, DatasetError, Episode, HAND_RADIUS, JointRule, Preset,
    Solids, TEST_SPEED, generate,
};

const CROWDS: [Preset; 3] = [Preset::Sparse, Preset::SparseLine, Preset::Dense];

fn config(preset: Preset, episodes: u64) -> DatasetConfig {
    DatasetConfig { seed: 21, episodes, preset, ..DatasetConfig::default() }
}

fn drawn(config: &DatasetConfig) -> Vec<Episode> {
    Dataset::in_memory(config, &NoProgress).unwrap().episodes().to_vec()
}

fn test_set(preset: Preset, objects: usize, joints: JointRule, solids: Solids) -> DatasetConfig {
    let constraints = Constraints::test(objects, joints, solids);
    DatasetConfig { constraints, ..config(preset, 12) }
}

fn bodies(episode: &Episode) -> Vec<(Footprint, Pose)> {
    episode.scene.objects.iter().map(|o| (o.shape.footprint(), o.pose)).collect()
}

#[test]
fn every_draw_is_within_the_stated_ranges_finite_and_at_rest() {
    for preset in CROWDS.into_iter().chain([Preset::Tools]) {
        let config = config(preset, 30);
        let ranges = config.ranges();
        for Episode { index, scene, motion, frames } in drawn(&config) {
            let outside = ranges.warnings(&scene, &Job::stated(&scene, motion.clone()));
            assert!(outside.is_empty(), "{preset:?} {index}: {outside:?}");
            assert!(ranges.pushes.contains(motion.strokes.len() as f64), "{preset:?} {index}");
            let last = &frames[frames.len() - 1].state;
            assert!(last.is_finite() && scene.is_resting(last), "{preset:?} {index}");
            if preset != Preset::Tools {
                assert_eq!(motion.tool.parts().len(), 1);
                let Shape::Cylinder { radius, .. } = motion.tool.parts()[0].shape else {
                    panic!("the hand is round")
                };
                assert_eq!(radius, HAND_RADIUS);
                for stroke in &motion.strokes {
                    assert!(stroke.settle && ranges.travel.contains(stroke.travel()));
                }
            }
        }
    }
}

#[test]
fn nothing_overlaps_at_the_start_and_the_hand_is_set_down_free() {
    for preset in CROWDS {
        for episode in drawn(&config(preset, 40)) {
            let all = bodies(&episode);
            for (k, a) in all.iter().enumerate() {
                let shrunk = a.0.grown(-1e-6);
                for b in &all[k + 1..] {
                    let gap = clearance((&shrunk, &a.1), (&b.0, &b.1), 0.01);
                    assert!(gap > 0.0, "{preset:?} {}", episode.index);
                }
            }
            let hand = Footprint::Disc { radius: HAND_RADIUS };
            for (number, stroke) in episode.motion.strokes.iter().enumerate() {
                let before = match number {
                    0 => 0,
                    _ => episode.frames.iter().rposition(|f| f.stroke == number - 1).unwrap(),
                };
                for ((footprint, _), pose) in all.iter().zip(&episode.frames[before].state.poses) {
                    let gap = clearance((&hand, &stroke.from), (footprint, pose), 0.01);
                    assert!(gap > 0.0, "{preset:?} {}", episode.index);
                }
            }
        }
    }
}

#[test]
fn strokes_played_one_by_one_are_what_the_simulator_plays_at_once() {
    for preset in CROWDS {
        for Episode { index, scene, motion, frames } in drawn(&config(preset, 3)) {
            let job = Job::stated(&scene, motion);
            let Trajectory { frames: whole, warnings, .. } =
                Simulator::planar().run(&scene, &job, Record::Frames);
            assert!(warnings.is_empty(), "{preset:?} {index}");
            assert_eq!(frames.len(), whole.len(), "{preset:?} {index}");
            for (k, (ours, theirs)) in frames.iter().zip(&whole).enumerate() {
                assert_eq!(ours, theirs, "{preset:?} {index}, frame {k}");
            }
        }
    }
}

#[test]
fn joints_are_a_forest_of_near_neighbours() {
    let mut kinds = [0; 3];
    let mut limited = 0;
    for preset in CROWDS {
        // Scenes vary between blocks of the curriculum; a few of each are drawn.
        for seed in 0..12 {
            for episode in drawn(&DatasetConfig { seed, ..config(preset, 4) }) {
                let all = bodies(&episode);
                let mut group: Vec<usize> = (0..all.len()).collect();
                for joint in &episode.scene.joints {
                    let [a, b] = joint.between;
                    let near =
                        contact_points((&all[a].0, &all[a].1), (&all[b].0, &all[b].1), JOINABLE);
                    assert!(near.1 > 0, "{preset:?} {}", episode.index);
                    let (kept, gone) = (group[a], group[b]);
                    assert_ne!(kept, gone, "a loop in {preset:?} {}", episode.index);
                    group.iter_mut().filter(|g| **g == gone).for_each(|g| *g = kept);
                    let limits = match joint.kind {
                        JointKind::Fixed => None,
                        JointKind::Revolute { limits, .. } => limits,
                        JointKind::Prismatic { axis, limits } => {
                            assert!((axis.norm() - 1.0).abs() < 1e-9);
                            limits
                        }
                    };
                    assert!(limits.is_none_or(|l| l.low < 0.0 && l.high > 0.0));
                    limited += usize::from(limits.is_some());
                    kinds[kind(&joint.kind)] += 1;
                }
            }
        }
    }
    assert!(kinds.iter().all(|&count| count > 10) && limited > 5, "{kinds:?}, {limited} limited");
}

fn kind(kind: &JointKind) -> usize {
    match kind {
        JointKind::Fixed => 0,
        JointKind::Revolute { .. } => 1,
        JointKind::Prismatic { .. } => 2,
    }
}

#[test]
fn test_sets_satisfy_their_constraints() {
    for (preset, counts) in [(Preset::Sparse, [6, 12]), (Preset::Dense, [6, 9])] {
        for count in counts {
            for rule in [JointRule::None, JointRule::Fixed, JointRule::Mixed] {
                let solids = if count == 6 { Solids::Cylinders } else { Solids::Any };
                let set = drawn(&test_set(preset, count, rule, solids));
                let mut kinds = [0; 3];
                let mut cuboids = 0;
                for Episode { scene, motion, .. } in &set {
                    assert_eq!(scene.objects.len(), count);
                    cuboids += scene.objects.iter().filter(|o| !o.shape.is_cylinder()).count();
                    scene.joints.iter().for_each(|joint| kinds[kind(&joint.kind)] += 1);
                    for stroke in &motion.strokes {
                        let speed = stroke.travel() / stroke.duration;
                        assert!((speed - TEST_SPEED).abs() < 1e-9);
                    }
                }
                let what = format!("{preset:?} {count} {rule:?}: {kinds:?}, {cuboids} cuboids");
                assert_eq!(cuboids > 0, solids == Solids::Any, "{what}");
                assert_eq!(kinds[0] > 0, rule != JointRule::None, "{what}");
                assert_eq!(kinds[1] > 0 && kinds[2] > 0, rule == JointRule::Mixed, "{what}");
                assert!(rule != JointRule::Fixed || kinds[1] + kinds[2] == 0, "{what}");
            }
        }
    }
}

#[test]
fn impossible_constraints_are_refused() {
    let refused = |config: DatasetConfig| {
        let error = Dataset::in_memory(&config, &NoProgress).unwrap_err();
        assert!(matches!(error, DatasetError::Constraint(_)), "{error}");
        error.to_string()
    };
    let with = |preset, objects, speed| DatasetConfig {
        constraints: Constraints { objects, speed, ..Constraints::default() },
        ..config(preset, 1)
    };
    assert!(refused(with(Preset::Dense, Some(13), None)).contains("2 to 12"));
    assert!(refused(with(Preset::Sparse, None, Some(f64::NAN))).contains("0.05 to 0.25"));
    assert!(refused(with(Preset::Tools, Some(2), None)).contains("sparse"));
    assert!(refused(with(Preset::Tools, None, Some(0.21))).contains("sparse"));
}

#[test]
fn a_sparse_episode_touches_at_least_three_objects_on_average() {
    let set = drawn(&test_set(Preset::Sparse, 9, JointRule::Mixed, Solids::Any));
    let hand = Footprint::Disc { radius: HAND_RADIUS };
    let touched: usize = set
        .iter()
        .flat_map(|episode| bodies(episode).into_iter().enumerate().map(move |b| (episode, b)))
        .filter(|(episode, (index, (footprint, _)))| {
            episode.frames.iter().any(|frame| {
                let pose = &frame.state.poses[*index];
                clearance((&hand, &frame.tool), (footprint, pose), 0.01) < 5e-4
            })
        })
        .count();
    assert!(touched >= 3 * set.len(), "{touched} in {} episodes", set.len());
}

#[test]
fn one_and_two_threads_draw_the_same_bits() {
    for preset in [Preset::Sparse, Preset::Dense] {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| drawn(&config(preset, 8)))
        };
        for (a, b) in with(1).iter().zip(&with(2)) {
            assert_eq!(a, b, "{preset:?} {}", a.index);
        }
    }
}

#[test]
fn files_give_back_joints_and_round_parts_and_belong_to_their_constraints() {
    let dir = tempfile::tempdir().unwrap();
    let set = test_set(Preset::Dense, 9, JointRule::Mixed, Solids::Any);
    generate(&set, Shard::WHOLE, dir.path(), &NoProgress).unwrap();
    let read = Dataset::open(dir.path()).unwrap();
    assert_eq!(read, Dataset::in_memory(&set, &NoProgress).unwrap());
    assert!(read.episodes().iter().any(|e| !e.scene.joints.is_empty()));
    let other = test_set(Preset::Dense, 9, JointRule::Fixed, Solids::Any);
    let refused = generate(&other, Shard::WHOLE, dir.path(), &NoProgress);
    assert!(
        matches!(refused, Err(DatasetError::Store(StoreError::OtherRun { .. }))),
        "{refused:?}"
    );
}
