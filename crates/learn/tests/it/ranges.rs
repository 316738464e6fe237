//! Ranges of the data: they cover the shipped tasks and the scenes on which the analytic model is
//! measured.

use pushplan::asset::{ToolLibrary, load_task};
use pushplan::effect::PRIOR_RANGES;
use pushplan::geometry::Pose;
use pushplan::{
    scene::{Object, Ranges},
    task::{Job, Push, ToolMotion},
};
use pushplan_learn::dataset::Preset;

use crate::ROOT;

/// Returns the ranges of pushes with tools and of crowds.
fn all() -> Ranges {
    Preset::Tools.ranges().hull(&Preset::Crowds.ranges())
}

#[test]
fn the_priors_ranges_are_those_of_the_scenes_that_it_is_measured_on() {
    assert_eq!(PRIOR_RANGES, all());
}

#[test]
fn shipped_tasks_and_tools_lie_in_the_ranges_that_training_covers() {
    let library = ToolLibrary::embedded().unwrap();
    let files = std::fs::read_dir(format!("{ROOT}/tasks")).unwrap();
    let files = files.map(|entry| entry.unwrap().path());
    for path in files.filter(|path| path.extension().is_some_and(|end| end == "yaml")) {
        let task = load_task(path, &library).unwrap();
        // No data set contains compound objects or joints to the world.
        if task.scene.objects.iter().any(Object::is_part) || !task.scene.mounts.is_empty() {
            continue;
        }
        let jointed = !task.scene.joints.is_empty();
        let ranges = if jointed { all() } else { Preset::Tools.ranges() };
        let start = Pose::default().position;
        let (length, speed) = (task.pushes.length, task.pushes.speed);
        let push = Push { start, direction: 0.0, length, speed };
        for tool in task.tools(&library).unwrap() {
            let motion = ToolMotion::pushes(tool, task.pushes.lift, 0.0, &[push], true);
            let mut warnings = ranges.warnings(&task.scene, &Job::stated(&task.scene, motion));
            if task.name == "glide" {
                // This task slides further than nearly all training pushes by design.
                assert_eq!(warnings.len(), 1);
                warnings.retain(|warning| !warning.to_string().contains("free sliding"));
            }
            // Data sets contain no prisms.
            warnings.retain(|warning| !warning.to_string().contains("corner from a right angle"));
            assert_eq!(warnings, [], "{}", task.name);
        }
    }
}
