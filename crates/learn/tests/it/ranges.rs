//! The prior outside of where it was measured: default planning says so.

use pushplan::asset::{ToolLibrary, load_task};
use pushplan::dataset::Preset;
use pushplan::effect::PRIOR_RANGES;
use pushplan::scene::{Quantity, Task, Warning};
use pushplan::solve::{Effort, Planner};

#[test]
fn the_priors_ranges_are_those_of_the_scenes_that_it_is_measured_on() {
    assert_eq!(PRIOR_RANGES, Preset::Mixed.ranges());
}

#[test]
fn a_can_of_twenty_kilograms_is_warned_of_whatever_the_effort() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tasks/pull-back.yaml");
    let mut task = load_task(&path, &library).expect("a shipped task");
    let draft = |task: &Task| {
        let planner = Planner::for_effort(Effort::Draft).expect("a sound library").build();
        let solution = planner.solve(task, &library).expect("a sound task");
        let found = solution.warnings.into_iter().filter_map(|warning| match warning {
            Warning::OutsideRange { quantity, value, .. } => Some((quantity, value)),
            _ => None,
        });
        found.collect::<Vec<_>>()
    };
    assert_eq!(draft(&task), []);
    task.scene.objects[0].mass = 20.0;
    assert_eq!(draft(&task), [(Quantity::Mass, 20.0)]);
}
