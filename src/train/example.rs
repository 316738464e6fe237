//! Single frames of episodes as training examples, with disturbed inputs.

use rand::Rng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use crate::{
    brdpn::{Engine, Workspace},
    dataset::Episode,
    geometry::{Pose, Vector},
    graph::{Batch, Bodies, Motion, add_graph},
    rollout::integrate,
    scene::{COAST_FRAME, FrameStep, State},
};

/// How input states are disturbed. The target stays the true next state, so the network also
/// learns to find back (Sanchez-Gonzalez et al. 2020, "random-walk noise").
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Largest shift drawn, metres. The size of a scene's disturbance is drawn log-uniformly
    /// from [`Noise::SMALLEST`] of this to all of it, so that precision near the truth and
    /// recovery from afar are both trained.
    pub shift: f64,
    /// Radians of turn per metre of shift.
    pub turn_per_metre: f64,
    /// Share of examples left undisturbed.
    pub clean: f64,
    /// Largest number of frames that the network's own rollout leads up to an example
    /// (the "pushforward" of Brandstetter, Worrall and Welling 2022); 0 for none.
    pub lead: usize,
}

impl Noise {
    const SMALLEST: f64 = 0.02;
}

impl Default for Noise {
    fn default() -> Self {
        Self { shift: 2e-3, turn_per_metre: 20.0, clean: 0.2, lead: 0 }
    }
}

/// Where an example is: episode and the frame before the transition.
type Place = (u32, u32);

/// All usable transitions of a set of episodes.
pub struct Examples<'a> {
    episodes: &'a [Episode],
    places: Vec<Place>,
}

/// A batch with the corrections wanted, row-major [N, 6], and the loss weights.
#[derive(Default)]
pub(super) struct Supervised {
    pub batch: Batch,
    pub target: Vec<f32>,
    pub weight: Vec<f32>,
}

impl<'a> Examples<'a> {
    /// Finds every transition in which the network has something to decide.
    pub fn new(episodes: &'a [Episode]) -> Self {
        use rayon::prelude::*;
        let places = episodes
            .par_iter()
            .enumerate()
            .flat_map_iter(|(e, episode)| {
                let bodies = bodies(episode);
                let mut batch = Batch::default();
                let mut motions = Vec::new();
                (0..episode.frames.len() - 1).filter_map(move |k| {
                    batch.clear();
                    let (step, axis) = transition(episode, k);
                    let state = &episode.frames[k].state;
                    add_graph(&bodies, state, &step, axis, 0, &mut batch, &mut motions);
                    (batch.node_count() > 0).then_some((e as u32, k as u32))
                })
            })
            .collect();
        Self { episodes, places }
    }

    /// Number of examples.
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// `count` examples drawn with the random numbers of (`seed`, `step`, `part`).
    pub(super) fn draw(
        &self,
        noise: &Noise,
        (seed, step, part): (u64, u64, u64),
        count: usize,
        engine: Option<&Engine>,
    ) -> Supervised {
        let mut random = Pcg64::new(
            (u128::from(seed) << 64) | u128::from(step),
            0xa02b_dbf7_bb3c_00a7_u128 ^ (u128::from(part) << 8),
        );
        let mut drawn = Supervised::default();
        let mut led = Lead::default();
        for _ in 0..count {
            let (e, frame) = self.places[random.random_range(0..self.places.len())];
            let episode = &self.episodes[e as usize];
            let frame = frame as usize;
            let lead = if noise.lead > 0 && engine.is_some() {
                random.random_range(0..=noise.lead).min(frame)
            } else {
                0
            };
            let bodies = bodies(episode);
            let mut state = episode.frames[frame - lead].state.clone();
            if !random.random_bool(noise.clean) {
                disturb(&mut state, noise, &mut random);
            }
            if let Some(engine) = engine {
                for k in frame - lead..frame {
                    led.advance(episode, &bodies, &mut state, k, engine);
                }
            }
            drawn.add(episode, &bodies, &state, frame, &mut led.motions);
        }
        drawn
    }
}

impl Supervised {
    fn add(
        &mut self,
        episode: &Episode,
        bodies: &Bodies,
        state: &State,
        frame: usize,
        motions: &mut Vec<Motion>,
    ) {
        let first = self.batch.node_count();
        let (step, axis) = transition(episode, frame);
        add_graph(bodies, state, &step, axis, 0, &mut self.batch, motions);
        let next = &episode.frames[frame + 1].state;
        for node in &self.batch.nodes[first..] {
            let k = node.object as usize;
            let truth = node.encode(&Motion {
                shift: next.poses[k].position - state.poses[k].position,
                turn: next.poses[k].heading - state.poses[k].heading,
                velocity: next.velocities[k].linear,
                spin: next.velocities[k].angular,
            });
            self.target
                .extend(truth.iter().zip(&node.prior).map(|(truth, prior)| (truth - prior) as f32));
            let cylinder = episode.scene.objects[k].shape.is_cylinder();
            self.weight.extend(super::loss::weights(cylinder));
        }
    }
}

/// Buffers for leading up to an example by the network's own rollout.
#[derive(Default)]
struct Lead {
    batch: Batch,
    motions: Vec<Motion>,
    corrections: Vec<[f64; 6]>,
    workspace: Workspace,
}

impl Lead {
    fn advance(
        &mut self,
        episode: &Episode,
        bodies: &Bodies,
        state: &mut State,
        frame: usize,
        engine: &Engine,
    ) {
        self.batch.clear();
        let (step, axis) = transition(episode, frame);
        add_graph(bodies, state, &step, axis, 0, &mut self.batch, &mut self.motions);
        engine.forward(&self.batch, &mut self.workspace, &mut self.corrections);
        for (node, correction) in self.batch.nodes.iter().zip(&self.corrections) {
            let mut output = node.prior;
            output.iter_mut().zip(correction).for_each(|(value, change)| *value += change);
            self.motions[node.object as usize] = node.decode(&output);
        }
        integrate(bodies, state, &self.motions, &step);
    }
}

fn bodies(episode: &Episode) -> Bodies {
    Bodies::new(&episode.scene, &episode.motion.tool, episode.motion.lift, None)
}

/// The tool's motion between frame `index` and the next, and the unit vector of its stroke.
fn transition(episode: &Episode, index: usize) -> (FrameStep, Vector) {
    let frames = &episode.frames;
    let stroke_index = frames[index + 1].stroke;
    let stroke = &episode.motion.strokes[stroke_index];
    // Frames of this stroke before the next one: the start belongs to none.
    let done = frames[1..=index].iter().rev().take_while(|f| f.stroke == stroke_index).count();
    let travel = stroke.to.position - stroke.from.position;
    let axis = if travel.norm() > 1e-9 { travel.normalize() } else { Vector::x() };
    let step = if done < stroke.frames() {
        stroke.frame(done)
    } else {
        FrameStep { from: stroke.to, to: stroke.to, duration: COAST_FRAME }
    };
    (step, axis)
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
