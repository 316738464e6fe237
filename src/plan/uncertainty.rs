//! Uncertainty of an object's pose at the start of a later push.
//!
//! A small error of an object's pose at the start grows during a push, because boxes rotate and
//! cans roll along a face. The states from which the search continues are therefore also rolled out
//! with small errors. The next push leaves room for the spread of the object's final poses.

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

/// Number of rollouts with errors for every state. The largest of six errors is about the 85th
/// percentile.
const DRAWS: usize = 6;

/// Largest shift of an object's observed position along each axis, metres.
const SHIFT: f64 = 1e-3;

/// Largest rotation of an object's observed pose, radians.
const TURN: f64 = std::f64::consts::PI / 180.0;

/// Largest relative error of every friction value.
const FRICTION: f64 = 0.1;

/// Maximum room of a push, metres: a longer approach costs reach and time.
const MOST: f64 = 0.03;

/// Random errors of the believed situation, drawn once for a whole search.
#[derive(Clone, Debug)]
pub struct Uncertainty {
    physics: Vec<Arc<Physics>>,
    /// Relative changes of the tools' friction.
    tools: Vec<f64>,
    /// Alternative start states.
    starts: Vec<State>,
}

impl Uncertainty {
    /// Draws errors around a situation.
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
                // Jointed objects are only shifted, because different rotations would violate their
                // joints.
                let alone = (0..groups.len()).filter(|&k| groups[k] == first).count() == 1;
                // An object joined to the world stays where its joint holds it.
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

    /// Returns the alternative start states.
    pub fn starts(&self) -> &[State] {
        &self.starts
    }

    /// Returns the worst score of a candidate over all draws.
    pub fn worst(&self, workspace: &Workspace, rollouts: &mut Rollouts, one: &Evaluation) -> f64 {
        let motions = one.motions(workspace);
        let each: Vec<Vec<Job>> =
            motions.iter().map(|motion| self.jobs(motion, &self.starts)).collect();
        let of = |draw: usize| each.iter().map(|jobs| jobs[draw].clone()).collect();
        let sequences: Vec<Vec<Job>> = (0..self.starts.len()).map(of).collect();
        let ends = rollouts.in_turn(&sequences, Record::Outcome);
        ends.iter().map(|end| final_score(workspace.task, end)).fold(one.score, f64::max)
    }

    /// Returns the jobs of `motion` from each of `states`, which belong to the draws in order.
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

/// Returns the room for object `index`, metres. Its pose in `state` is predicted with an occasional
/// error of `error` metres, and errors at the start lead to `others`.
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
    // A NaN results in the maximum room.
    (error + spread).min(MOST)
}
