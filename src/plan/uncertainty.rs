//! Uncertainty of where an object is when a later push begins.
//!
//! An object that is a little off at the start is off by more after a push: boxes turn, cans roll
//! along a face. So the states that the search continues from are rolled out with small errors as
//! well, and the next push is placed with room for the spread of where the object ends.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::effect::Job;
use crate::geometry::{Pose, Vector, wrap_angle};
use crate::{
    outcome::Record,
    scene::{Physics, Scene, Situation, State, Tool},
    task::ToolMotion,
};

use super::score::final_score;
use super::{Evaluation, Rollouts, Workspace};

/// Rollouts with errors for every state. The largest of six is about the 85th percentile.
const DRAWS: usize = 6;

/// Errors, apart from those of supports and of the push's height, of where objects are seen, metres
/// and radians, and of every friction value, relative.
const SHIFT: f64 = 1e-3;
const TURN: f64 = std::f64::consts::PI / 180.0;
const FRICTION: f64 = 0.1;

/// The most room that a push gets, metres: a longer approach costs reach and time.
const MOST: f64 = 0.03;

/// Possible differences from what is believed: the same draws for a whole search.
#[derive(Clone, Debug)]
pub struct Uncertainty {
    physics: Vec<Arc<Physics>>,
    /// Relative changes of the tools' friction.
    tools: Vec<f64>,
    /// States instead of that at the start.
    starts: Vec<State>,
}

impl Uncertainty {
    /// Draws around a situation.
    pub fn around(situation: &Situation) -> Self {
        let mut random = Pcg64::seed_from_u64(0x5_9EAD);
        let mut within = |range: f64| random.random_range(-range..=range);
        let (mut physics, mut tools, mut starts) = (Vec::new(), Vec::new(), Vec::new());
        let groups = situation.physics.groups(|_| true);
        for draw in 0..DRAWS {
            let mut drawn = (*situation.physics).clone();
            drawn.doubt_supports(&situation.scene, draw);
            let mut change = |friction: &mut f64| *friction *= 1.0 + within(FRICTION);
            drawn.frictions.iter_mut().for_each(&mut change);
            change(&mut drawn.table_friction);
            drawn.pairs.iter_mut().for_each(|pair| change(&mut pair.coefficient));
            tools.push(1.0 + within(FRICTION));
            drawn.push_height = Some(0.5 + within(0.5));
            let mut start = situation.start.clone();
            for first in 0..groups.len() {
                let (shift, turn) = (Vector::new(within(SHIFT), within(SHIFT)), within(TURN));
                // Joined objects are only shifted: turned apart, their joints would break.
                let alone = (0..groups.len()).filter(|&k| groups[k] == first).count() == 1;
                // What is joined to the world stands where its joint lets it.
                let free = |k: &usize| situation.scene.mount(*k).is_none();
                for k in (0..groups.len()).filter(|&k| groups[k] == first).filter(free) {
                    let turn = if alone { turn } else { 0.0 };
                    let pose = start.poses[k];
                    start.poses[k] =
                        Pose { position: pose.position + shift, heading: pose.heading + turn };
                }
            }
            physics.push(Arc::new(drawn));
            starts.push(start);
        }
        Self { physics, tools, starts }
    }

    /// The states at the start.
    pub fn starts(&self) -> &[State] {
        &self.starts
    }

    /// Score of a candidate in the draw in which it ends farthest from the goal.
    pub fn worst(&self, workspace: &Workspace, rollouts: &mut Rollouts, one: &Evaluation) -> f64 {
        let motions = one.motions(workspace);
        let each: Vec<Vec<Job>> =
            motions.iter().map(|motion| self.jobs(motion, &self.starts)).collect();
        let of = |draw: usize| each.iter().map(|jobs| jobs[draw].clone()).collect();
        let sequences: Vec<Vec<Job>> = (0..self.starts.len()).map(of).collect();
        let ends = rollouts.in_turn(&sequences, Record::Outcome);
        ends.iter().map(|end| final_score(workspace.task, end)).fold(one.score, f64::max)
    }

    /// `motion` from each of `states`, which come from the draws in order.
    pub fn jobs(&self, motion: &ToolMotion, states: &[State]) -> Vec<Job> {
        let draws = states.iter().zip(self.physics.iter().zip(&self.tools));
        draws
            .map(|(start, (physics, friction))| {
                let tool = &*motion.tool;
                let rubbing = tool.friction * friction;
                let tool = Tool::clone(tool).friction(rubbing);
                let motion = ToolMotion { tool: Arc::new(tool), ..motion.clone() };
                Job { start: start.clone(), motion: motion.into(), physics: Arc::clone(physics) }
            })
            .collect()
    }
}

/// Room for object `index`, metres, predicted in `state` by a model that is off by `error` metres
/// at times, where errors at the start lead to `others`.
pub(super) fn room(
    scene: &Scene,
    index: usize,
    state: &State,
    others: &[State],
    error: f64,
) -> f64 {
    let radius = scene.objects[index].shape.footprint().mean_radius();
    let off = |other: &State| {
        let (a, b) = (state.poses[index], other.poses[index]);
        (a.position - b.position).norm() + radius * wrap_angle(a.heading - b.heading).abs()
    };
    let spread = others.iter().map(off).fold(0.0, f64::max);
    // NaN leaves all the room there can be.
    (error + spread).min(MOST)
}
