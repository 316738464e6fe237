//! Comparison of lever-ups in MuJoCo and our engine by medians, because slips and falls are
//! sensitive.
//!
//! These tests need a Python with the package `mujoco`, like the tests of plans.

use std::fs;
use std::process::Command;

use pushplan::geometry::{Pose3, Vector3};
use pushplan::sim::LeverSimulator;
use pushplan_export::{LEVER_SCRIPT, lever_mjcf};
use pushplan_learn::dataset::{LEVERS_PER_SHAPE, LeverConfig, LeverPreset, lever_job};
use serde_json::Value as Json;

use crate::mujoco_python::python;

/// Number of lever-ups of each family.
const CASES: u64 = 24;

/// Maximum median distance and angle at the end of the rotation, metres and degrees, and distance
/// at rest, metres.
const MARKS: [f64; 3] = [0.004, 2.5, 0.005];

#[test]
fn lever_ups_end_where_they_do_in_mujoco() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let script = folder.path().join("lever.py");
    fs::write(&script, LEVER_SCRIPT).expect("written");
    for preset in [LeverPreset::Fixed, LeverPreset::Varied, LeverPreset::Drive] {
        let (mut ours, mut scenes) = (Vec::new(), Vec::new());
        let config = LeverConfig { seed: 1, episodes: 1000, preset };
        for k in 0..CASES {
            let job = lever_job(&config, k * LEVERS_PER_SHAPE + 1);
            let path = folder.path().join(format!("{preset}-{k:02}.xml"));
            fs::write(&path, lever_mjcf(&job)).expect("written");
            scenes.push(path);
            ours.push(LeverSimulator::FINE.run(&job));
        }
        let output =
            Command::new(&python).arg(&script).args(&scenes).output().expect("Python runs");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let theirs: Vec<Json> =
            text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        assert_eq!(theirs.len(), ours.len());
        let mut found = [Vec::new(), Vec::new(), Vec::new()];
        for (ours, theirs) in ours.iter().zip(&theirs) {
            let lift = theirs["lift"].as_array().expect("poses");
            let (here, there) = (ours.lift.last().expect("frames"), pose(&lift[lift.len() - 1]));
            found[0].push((here.position - there.position).norm());
            found[1].push(here.angle_to(&there).to_degrees());
            found[2].push((ours.rest.position - pose(&theirs["rest"]).position).norm());
        }
        let found = found.map(|mut list| {
            list.sort_by(f64::total_cmp);
            list[list.len() / 2]
        });
        let within = MARKS.iter().zip(found).all(|(most, found)| found <= *most);
        assert!(within, "{preset}: {found:?} m, degrees, m; at most {MARKS:?}");
    }
}

/// Parses x, y, z and the quaternion w, x, y, z.
fn pose(value: &Json) -> Pose3 {
    let number = |k: usize| value[k].as_f64().expect("a number");
    let position = Vector3::new(number(0), number(1), number(2));
    Pose3::from_quaternion(position, [number(4), number(5), number(6), number(3)])
}
