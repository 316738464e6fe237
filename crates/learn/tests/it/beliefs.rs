//! Joints are estimated from the motion of objects in random crowds.

use pushplan::recording::Recording;
use pushplan_act::belief::JointType;
use pushplan_learn::dataset::{Constraints, DatasetConfig, Episode, JointRule, Preset, Solids};

use crate::believing::{EXACT, believed};

/// Returns the number of moved near pairs with correct type, and their total number. The seed
/// differs from the seeds used for tuning the filter.
fn distinguished(preset: Preset, count: u64, solids: Solids, headings: bool) -> (usize, usize) {
    let constraints = Constraints::test(9, JointRule::Mixed, solids);
    let config =
        DatasetConfig { seed: 7, episodes: count, preset, constraints, ..DatasetConfig::default() };
    let (mut right, mut all) = (0, 0);
    for index in 0..count {
        let Episode { scene, motion, frames, .. } = Episode::of_crowd(&config, index);
        let mut recording = Recording::of_frames("drawn", &scene, &motion, &frames);
        recording.headings.fill(headings);
        let belief = believed(&recording, EXACT, index);
        let joints = belief.map().joints;
        let moved = |k: usize| {
            let start = scene.objects[k].pose.position;
            recording.frames.iter().any(|f| (f.poses[k].position - start).norm() > 0.01)
        };
        for between in belief.pairs().filter(|pair| pair.iter().any(|k| moved(*k))) {
            let truth = scene.joints.iter().find(|joint| {
                let [a, b] = joint.between;
                [a.min(b), a.max(b)] == between
            });
            let found = joints.iter().find(|joint| joint.between == between);
            right += usize::from(JointType::of(found) == JointType::of(truth));
            all += 1;
        }
    }
    println!("{preset:?}, {solids:?}: {right} of {all}");
    (right, all)
}

#[test]
fn near_pairs_that_moved_are_distinguished_in_crowds() {
    for (preset, count, least) in [(Preset::Sparse, 4, 0.93), (Preset::Dense, 8, 0.85)] {
        let (right, all) = distinguished(preset, count, Solids::Any, true);
        assert!(f64::from(right as u32) >= least * all as f64, "{preset:?}: {right} of {all}");
    }
}

#[test]
fn many_are_distinguished_in_crowds_of_cylinders_without_headings() {
    for (preset, count, least) in [(Preset::Sparse, 8, 0.85), (Preset::Dense, 8, 0.75)] {
        let (right, all) = distinguished(preset, count, Solids::Cylinders, false);
        assert!(f64::from(right as u32) >= least * all as f64, "{preset:?}: {right} of {all}");
    }
}
