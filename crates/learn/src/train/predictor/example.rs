//! Single frames of episodes as training examples, with disturbed inputs.

use pushplan::internals::contact::{Bodies, FrameProblem, FrameSolver, ListIndex, Motion, hold};
use pushplan::internals::geometry::{Pose, Vector};
use pushplan::internals::graph::{Batch, Correction, Node};
use pushplan::internals::network::{Buffers, Forward};
use pushplan::internals::rollout::{Stepper, Walk, integrate};
use pushplan::internals::{
    scene::{Physics, State, Support},
    task::{COAST_FRAME, FrameStep},
};
use rand::Rng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::dataset::Episode;

/// How input states are disturbed (Sanchez-Gonzalez et al. 2020, "random-walk noise").
///
/// The target is the correction that the prior needs at the true state. What a disturbance
/// changes, the prior answers: asking the network to find back instead asks for what nobody can
/// know, the side to which a state is off, and buries what it can learn. At 3000 steps this
/// leaves a median error of 0.35 mm for one object, finding back 0.43.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Largest shift drawn, metres. The size of a scene's disturbance is drawn log-uniformly
    /// from `Noise::SMALLEST` of this to all of it, so that precision near the truth and
    /// recovery from afar are both trained.
    pub shift: f64,
    /// Radians of turn per metre of shift.
    pub turn_per_metre: f64,
    /// Share of examples left undisturbed.
    pub clean: f64,
    /// Largest number of frames that the network's own rollout leads up to an example; 0 for
    /// none.
    pub lead: usize,
    /// How that number is drawn.
    #[serde(default)]
    pub exposure: Exposure,
    /// Share of examples in which the network is not told what objects rest on, and the prior takes
    /// them to rest evenly: planning often knows no better.
    #[serde(default)]
    pub unknown_supports: f64,
}

/// How the network meets states of its own making in training. No gradient flows from a frame
/// into the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Exposure {
    /// Any number of frames up to `lead`, each equally often, from the start of training on:
    /// the "pushforward" of Brandstetter, Worrall and Welling (2022).
    #[default]
    Pushforward,
    /// Scheduled sampling (Bengio, Vinyals, Jaitly and Shazeer 2015; Tekden 2020, 8.1.2): each
    /// of the last `lead` frames is the network's own, given the later ones are, with a
    /// probability that rises evenly from zero to one over the run.
    Scheduled,
    /// A loss over several steps: every start is followed for `lead` frames of its own, and
    /// every one of them is an example. As many examples a step, from fewer starts.
    MultiStep,
}

impl Noise {
    const SMALLEST: f64 = 0.02;
}

impl Default for Noise {
    fn default() -> Self {
        Self {
            shift: 3e-4,
            turn_per_metre: 20.0,
            clean: 0.2,
            lead: 0,
            exposure: Exposure::Pushforward,
            unknown_supports: 0.15,
        }
    }
}

/// An example: its episode and the frame before the transition.
struct Place<'a> {
    episode: &'a Episode,
    frame: u32,
    wanted: Box<[Wanted]>,
}

/// The correction that the prior of an object needs, in output units.
struct Wanted {
    object: ListIndex,
    correction: [f32; 6],
}

/// All usable transitions of several sets of episodes.
pub struct Examples<'a> {
    sets: Vec<Places<'a>>,
}

/// Those of one set.
struct Places<'a> {
    places: Vec<Place<'a>>,
    /// How often an example is of this set, against others.
    weight: f64,
}

/// A batch with the corrections wanted, row-major [N, 6], and the loss weights.
#[derive(Default)]
pub(super) struct Supervised {
    pub batch: Batch,
    pub target: Vec<f32>,
    pub weight: Vec<f32>,
}

impl<'a> Examples<'a> {
    /// Finds every transition in which the network has something to decide, of sets with the weights
    /// by which they are drawn from.
    pub fn new(sets: impl IntoIterator<Item = (&'a [Episode], f64)>) -> Self {
        let places = |(episodes, weight): (&'a [Episode], f64)| Places {
            places: episodes.par_iter().flat_map_iter(places).collect(),
            weight,
        };
        let sets = sets.into_iter().map(places).filter(|set| !set.places.is_empty()).collect();
        Self { sets }
    }

    /// Number of examples.
    pub fn count(&self) -> usize {
        self.sets.iter().map(|set| set.places.len()).sum()
    }

    /// Any example, all of a set equally likely.
    fn any(&self, random: &mut Pcg64) -> &Place<'a> {
        let whole: f64 = self.sets.iter().map(|set| set.weight).sum();
        // With a single set nothing is drawn that was not drawn for it alone.
        let mut left = if self.sets.len() > 1 { random.random::<f64>() * whole } else { 0.0 };
        let chosen = self.sets.iter().position(|set| {
            left -= set.weight;
            left < 0.0
        });
        let set = &self.sets[chosen.unwrap_or(self.sets.len() - 1)];
        &set.places[random.random_range(0..set.places.len())]
    }

    /// `count` examples drawn with the random numbers of (`seed`, `step`, `part`), `progress`
    /// (0 to 1) of the way through the run.
    pub(super) fn draw(
        &self,
        noise: &Noise,
        (seed, step, part): (u64, u64, u64),
        progress: f64,
        count: usize,
        forward: Option<&Forward>,
    ) -> Supervised {
        let mut random = Pcg64::new(
            (u128::from(seed) << 64) | u128::from(step),
            0xa02b_dbf7_bb3c_00a7_u128 ^ (u128::from(part) << 8),
        );
        let multiple = match (noise.exposure, forward) {
            (Exposure::MultiStep, Some(_)) => noise.lead + 1,
            _ => 1,
        };
        let mut starts: Vec<Start<'_>> = (0..count.div_ceil(multiple))
            .map(|_| {
                let place = self.any(&mut random);
                let (episode, frame) = (place.episode, place.frame as usize);
                let wanted = match (forward, noise.exposure) {
                    (None, _) => 0,
                    (_, Exposure::Pushforward) => random.random_range(0..=noise.lead),
                    (_, Exposure::Scheduled) => {
                        (0..noise.lead).take_while(|_| random.random_bool(progress)).count()
                    }
                    (_, Exposure::MultiStep) => noise.lead,
                };
                let lead = wanted.min(frame);
                let mut state = episode.frames[frame - lead].state.clone();
                let unknown = noise.unknown_supports > 0.0
                    && random.random_bool(noise.unknown_supports)
                    && episode.scene.objects.iter().any(|o| o.support != Support::Even);
                let bodies = if unknown { guessed(episode) } else { bodies(episode) };
                if !random.random_bool(noise.clean) {
                    disturb(&mut state, noise, &mut random);
                    hold(&bodies, &mut state, |_| true);
                }
                // Of a guess the prior needs another correction than of the truth.
                let wanted = (!unknown).then_some(&*place.wanted);
                let at = frame - lead;
                let transition = Transition::of(episode, at);
                Start { episode, bodies, frame, wanted, at, transition, state }
            })
            .collect();
        let mut drawn = Supervised::default();
        let mut memory = Memory::default();
        if let Some(forward) = forward {
            let (mut stepper, mut buffers) = (Stepper::correcting(usize::MAX), Buffers::default());
            let mut correct = |batch: &Batch, corrections: &mut Vec<Correction>| {
                forward.run(batch, &mut buffers, corrections);
            };
            while starts.iter().any(|start| start.at < start.frame) {
                if multiple > 1 {
                    for start in starts.iter().filter(|start| start.at < start.frame) {
                        drawn.add(start, &mut memory);
                    }
                }
                stepper.step(&mut starts, Some(&mut correct));
            }
        }
        for start in &starts {
            drawn.add(start, &mut memory);
        }
        drawn
    }
}

/// The usable transitions of an episode.
fn places(episode: &Episode) -> impl Iterator<Item = Place<'_>> {
    let bodies = bodies(episode);
    let mut memory = Memory::default();
    (0..episode.frames.len() - 1).filter_map(move |frame| {
        let wanted = wanted(episode, &bodies, frame, &mut memory);
        let place = |wanted| Place { episode, frame: frame as u32, wanted };
        (!wanted.is_empty()).then(|| place(wanted.into()))
    })
}

/// An example on its way from the state it was drawn at to the frame it is taken at.
struct Start<'a> {
    episode: &'a Episode,
    bodies: Bodies,
    /// The frame before the transition to learn.
    frame: usize,
    /// The corrections wanted there, if they are known.
    wanted: Option<&'a [Wanted]>,
    /// The frame that `state` belongs to, and what the tool does from there.
    at: usize,
    transition: Transition,
    state: State,
}

/// With the network, up to the frame of the example.
impl Walk for Start<'_> {
    fn next(&mut self) -> Option<FrameProblem<'_>> {
        (self.at < self.frame).then(|| self.transition.problem(&self.bodies, &self.state))
    }

    fn advance(&mut self, motions: &[Motion]) {
        integrate(&self.bodies, &mut self.state, motions, &self.transition.step);
        self.at += 1;
        self.transition = Transition::of(self.episode, self.at);
    }
}

/// Memory that building graphs reuses.
#[derive(Default)]
struct Memory {
    solver: FrameSolver,
    batch: Batch,
}

/// The corrections that the prior needs from frame `frame` to the next, at the true state.
fn wanted(
    episode: &Episode,
    bodies: &Bodies,
    frame: usize,
    Memory { solver, batch }: &mut Memory,
) -> Vec<Wanted> {
    batch.clear();
    let [state, next] = [0, 1].map(|k| &episode.frames[frame + k].state);
    let transition = Transition::of(episode, frame);
    let (solved, forces) = solver.solve_with_forces(transition.problem(bodies, state));
    batch.add(0, &solved, &forces);
    let correction = |node: &Node| {
        let k = node.object.0;
        let truth = node.encode(&Motion {
            shift: next.poses[k].position - state.poses[k].position,
            turn: next.poses[k].heading - state.poses[k].heading,
            velocity: next.velocities[k].linear,
            spin: next.velocities[k].angular,
        });
        let correction = std::array::from_fn(|n| (truth[n] - node.prior[n]) as f32);
        Wanted { object: node.object, correction }
    };
    batch.nodes.iter().map(correction).collect()
}

impl Supervised {
    fn add(&mut self, start: &Start<'_>, memory: &mut Memory) {
        let Start { episode, bodies, at, state, .. } = start;
        let fresh;
        let wanted = match start.wanted.filter(|_| start.at == start.frame) {
            Some(wanted) => wanted,
            None => {
                fresh = wanted(episode, bodies, *at, memory);
                &fresh
            }
        };
        let first = self.batch.node_count();
        let (frame, forces) =
            memory.solver.solve_with_forces(start.transition.problem(bodies, state));
        self.batch.add(0, &frame, &forces);
        for node in &self.batch.nodes[first..] {
            // What nothing can touch at the true state moves as its prior says, exactly.
            let known = wanted.iter().find(|wanted| wanted.object == node.object);
            self.target.extend(known.map_or([0.0; 6], |wanted| wanted.correction));
            let cylinder = episode.scene.objects[node.object.0].shape.is_cylinder();
            self.weight.extend(super::loss::weights(cylinder));
        }
    }
}

/// The bodies of an episode.
fn bodies(episode: &Episode) -> Bodies {
    let physics = Physics::stated(&episode.scene);
    Bodies::new(&episode.scene, &episode.motion.tool, episode.motion.lift, &physics)
}

/// The same where nobody knows what objects rest on.
fn guessed(episode: &Episode) -> Bodies {
    let mut physics = Physics::stated(&episode.scene);
    physics.support_all(&episode.scene, &Support::Even);
    physics.supports_known = false;
    Bodies::new(&episode.scene, &episode.motion.tool, episode.motion.lift, &physics)
}

/// The tool's motion between a frame and the next, and the unit vector of its stroke.
struct Transition {
    step: FrameStep,
    axis: Vector,
}

impl Transition {
    /// From frame `index` of an episode to the next.
    fn of(episode: &Episode, index: usize) -> Self {
        let frames = &episode.frames;
        let stroke_index = frames[index + 1].stroke;
        let stroke = &episode.motion.strokes[stroke_index];
        // Frames of this stroke before the next one: the start belongs to none.
        let done = frames[1..=index].iter().rev().take_while(|f| f.stroke == stroke_index).count();
        let axis = stroke.direction().unwrap_or_else(Vector::x);
        let step = if done < stroke.frames() {
            stroke.frame(done)
        } else {
            FrameStep { from: stroke.to, to: stroke.to, duration: COAST_FRAME }
        };
        Self { step, axis }
    }

    fn problem<'a>(&'a self, bodies: &'a Bodies, state: &'a State) -> FrameProblem<'a> {
        FrameProblem { bodies, state, step: &self.step, axis: self.axis }
    }
}

fn disturb(state: &mut State, noise: &Noise, random: &mut Pcg64) {
    let size = noise.shift * Noise::SMALLEST.powf(random.random::<f64>());
    for (pose, velocity) in state.poses.iter_mut().zip(&mut state.velocities) {
        let mut draw = |scale: f64| random.random_range(-scale..=scale);
        *pose = Pose {
            position: pose.position + Vector::new(draw(size), draw(size)),
            heading: pose.heading + draw(size * noise.turn_per_metre),
        };
        // Objects at rest stay at rest; moving ones get a few per cent.
        let share = size / noise.shift * 0.1;
        let speed = velocity.linear.norm();
        velocity.linear += Vector::new(draw(share * speed), draw(share * speed));
        velocity.angular *= 1.0 + draw(share);
    }
}
