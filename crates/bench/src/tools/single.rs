//! Goals of single pushes: end positions of random pushes from random starts in the 2-D engine.
//!
//! The cylinder stands anywhere in 3 m^2 in front of the robot (1.5 m deep, 2 m wide). A random
//! push with a random tool pose is drawn together with the start, until the tool sweeps over the
//! start and moves the cylinder by more than 10 cm. Every goal is therefore within reach of at
//! least one tool pose, and no task is solved without a push. The drawn push is a witness: no
//! method of the benchmark receives it.

use rand::Rng;
use rayon::prelude::*;

use pushplan::{
    geometry::{Pose, Vector, clearance},
    scene::Engine,
    seeded::generator,
    task::{Push, PushForm, Task},
};

use super::{
    execute::{Action, play},
    goals::{GOALS_VERSION, GoalMade, GoalSet, StartGoals, rounded, spelled},
    setup::{COARSE, ReferenceSetup, SPEED, STEPS, TRAVEL},
};

/// Depth and width of the area of starts, metres.
const DEPTH: f64 = 1.5;
const WIDTH: f64 = 2.0;

/// Spacing of the tool positions that are compared with a start, metres; a fraction of the
/// cylinder's radius.
const SPACING: f64 = 0.01;

/// Salt that separates these draws from other uses of a seed.
const SALT: u64 = 0x0051;

/// Returns the goals of `tasks` single pushes, each with its own start, in parallel on the current
/// rayon pool. Equal seeds give equal goals.
pub(super) fn single_goals(setup: &ReferenceSetup, seed: u64, tasks: usize) -> GoalSet {
    let starts = (0..tasks).into_par_iter().map(|index| drawn(setup, seed, index)).collect();
    let words = "pushplan bench tools --form single";
    GoalSet {
        version: GOALS_VERSION,
        made_by: format!("{words} --seed {seed} --tasks {tasks} --make-goals"),
        starts,
    }
}

/// Draws starts and pushes until one moves the cylinder far enough. A few pushes in a hundred sweep
/// over their start, and most of them do, so the loop ends.
fn drawn(setup: &ReferenceSetup, seed: u64, index: usize) -> StartGoals {
    let mut random = generator(seed ^ SALT, index as u64);
    loop {
        let x = random.random_range(0.0..DEPTH);
        let start = rounded(Vector::new(x, random.random_range(-WIDTH / 2.0..WIDTH / 2.0)));
        let at = Vector::from(start);
        let task = setup.task(at, at);
        let ways = task.pushes.directions.headings();
        let pose = random.random_range(0..setup.poses.len());
        let direction = ways[random.random_range(0..ways.len())];
        let steps = random.random_range(1..=STEPS);
        let length = TRAVEL * steps as f64 / STEPS as f64;
        let tool = (pose, direction, length - COARSE);
        if !sweeps(setup, &task, tool) || !setup.free_poses(at).contains(&pose) {
            continue;
        }
        let push = Push { start: task.robot.home, direction, length, speed: SPEED };
        let action = Action { pose, form: PushForm::Chained, pushes: vec![push] };
        let landing = play(setup, &task, Engine::Planar, &action);
        if landing.sound && (landing.at - at).norm() > COARSE {
            let (pose, pushes) = (setup.poses[pose].name.clone(), spelled(&action));
            let goal = GoalMade { at: rounded(landing.at), pose, pushes };
            return StartGoals { start, goals: vec![goal] };
        }
    }
}

/// Returns `true` if a tool pose overlaps the cylinder within some travel (metres) from home in a
/// direction.
fn sweeps(
    setup: &ReferenceSetup,
    task: &Task,
    (pose, direction, travel): (usize, f64, f64),
) -> bool {
    let (tool, cylinder) = (&setup.poses[pose], &task.scene.objects[0]);
    let still = (&cylinder.shape.footprint(), &cylinder.pose);
    let way = Vector::new(direction.cos(), direction.sin());
    let overlaps = |moved: f64| {
        let position = task.robot.home + way * moved;
        let frame = tool.pose(Pose { position, heading: 0.0 });
        (0..tool.parts().len()).any(|k| {
            let part = tool.parts()[k].footprint();
            clearance((&part, &tool.part_pose(k, &frame)), still, SPACING) <= 0.0
        })
    };
    travel > 0.0 && (0..=(travel / SPACING) as usize).any(|k| overlaps(k as f64 * SPACING))
}
