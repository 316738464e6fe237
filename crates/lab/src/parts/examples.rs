//! Recorded lever-ups, and their steps as training examples.

use pushplan::internals::geometry::{Pose3, Turn3, Vector3};
use pushplan::internals::network::Forward;
use pushplan::internals::outcome::Frame;
use pushplan::internals::seeded::generator;
use pushplan_learn::dataset::LeverEpisode;
use rand::Rng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::{LeverCourse, LeverParts, PartGraphs, PartState, Walk, Walker};

/// Number of steps at rest that also become examples.
const AT_REST: usize = 3;

/// Range of the perturbation of a true state: displacement of the centre of mass, metres.
const NOISE: [f64; 2] = [2e-5, 1e-3];

/// Rotation of a perturbation per displacement, radians per metre.
const TURNS: f64 = 25.0;

/// Error above which a rollout is reset to the ground truth, metres, because a single step cannot
/// correct it.
const LOST: f64 = 8e-3;

/// Number of rollouts that share the matrix products of a step.
const AT_ONCE: usize = 32;

/// A lever-up as simulated by the engine.
struct Track {
    course: LeverCourse,
    /// Centre of mass and rotation when each step begins.
    truth: Vec<(Vector3, Turn3)>,
}

/// The steps that examples are drawn from.
pub(super) struct Examples {
    tracks: Vec<Track>,
    /// Track and step.
    places: Vec<(usize, usize)>,
    /// States of rollouts when each step began; empty before the first rollout.
    visited: Vec<Vec<PartState>>,
}

/// Graphs with targets.
pub(super) struct Drawn {
    pub graphs: PartGraphs,
    /// Target of every graph, [B, 6].
    pub wanted: Vec<f32>,
}

impl Examples {
    /// Returns the steps of those `episodes` that have only cuboid bodies and came to rest without
    /// a jam. These episodes are simulated again.
    pub fn new(episodes: &[LeverEpisode], prior: bool) -> Self {
        let sound: Vec<&LeverEpisode> = episodes.iter().filter(|e| e.is_sound()).collect();
        let tracks: Vec<Track> =
            sound.par_iter().filter_map(|episode| Track::new(episode, prior)).collect();
        let steps = |(k, track): (usize, &Track)| (0..track.truth.len() - 1).map(move |s| (k, s));
        let places = tracks.iter().enumerate().flat_map(steps).collect();
        Self { tracks, places, visited: Vec::new() }
    }

    /// Number of lever-ups.
    pub fn count(&self) -> usize {
        self.tracks.len()
    }

    /// Rolls the network out on every lever-up to collect start states of examples.
    pub fn visit(&mut self, forward: &Forward) {
        let visited = self.tracks.par_chunks(AT_ONCE).flat_map_iter(|some| roll(some, forward));
        self.visited = visited.collect();
    }

    /// Returns `count` examples, which depend on seed, step and part alone.
    pub fn draw(&self, (seed, step, part): (u64, u64, u64), count: usize) -> Drawn {
        let mut rng = generator(seed, 2 * step + part);
        let mut drawn = Drawn { graphs: PartGraphs::default(), wanted: Vec::new() };
        for _ in 0..count {
            let (k, step) = self.places[rng.random_range(0..self.places.len())];
            let Track { course, truth } = &self.tracks[k];
            let state = match self.visited.get(k) {
                Some(states) if rng.random_bool(0.5) => states[step],
                _ => perturbed(truth, step, &mut rng),
            };
            course.describe(&state, step, &mut drawn.graphs);
            drawn.wanted.extend(course.wanted(&state, step, truth[step + 1]));
        }
        drawn
    }
}

impl Track {
    fn new(episode: &LeverEpisode, prior: bool) -> Option<Self> {
        let job = episode.job();
        let course = LeverCourse::new(&job, prior.then_some(&LeverParts::PRIOR))?;
        let motion = episode.motion();
        let end = motion.last()?.0.time;
        let plate = job.lever.plate;
        let mut truth = vec![course.see(&job.scene.plates[plate].start())];
        let (mut k, mut at_rest) = (1, 0);
        while at_rest < AT_REST {
            truth.push(course.see(&pose_at(&motion, plate, course.time(k))));
            at_rest += usize::from(course.time(k) >= end);
            k += 1;
        }
        Some(Self { course, truth })
    }
}

/// Interpolates the pose at a time between frames.
fn pose_at(frames: &[(Frame, f64)], plate: usize, time: f64) -> Pose3 {
    let after = frames.partition_point(|(frame, _)| frame.time < time).min(frames.len() - 1);
    let (a, b) = (&frames[after.saturating_sub(1)].0, &frames[after].0);
    let share = ((time - a.time) / (b.time - a.time).max(1e-12)).clamp(0.0, 1.0);
    let of =
        |frame: &Frame| frame.state.space.as_ref().map_or_else(Pose3::default, |all| all[plate]);
    let (from, to) = (of(a), of(b));
    let spin = (to.rotation * from.rotation.inverse()).scaled_axis() * share;
    Pose3 {
        position: from.position + (to.position - from.position) * share,
        rotation: Turn3::from_scaled_axis(spin) * from.rotation,
    }
}

/// Returns the states of rollouts when each step begins.
fn roll(tracks: &[Track], forward: &Forward) -> Vec<Vec<PartState>> {
    let mut walks: Vec<Walk<'_>> = tracks.iter().map(|track| Walk::new(&track.course)).collect();
    let mut states: Vec<Vec<PartState>> = walks.iter().map(|walk| vec![walk.state]).collect();
    let mut walker = Walker::new(forward);
    while walker.step(&mut walks) {
        for ((walk, track), states) in walks.iter_mut().zip(tracks).zip(&mut states) {
            let Some(truth) = track.truth.get(walk.step) else { continue };
            if walk.state.apart(*truth) > LOST {
                walk.state = exactly(&track.truth, walk.step);
            }
            if states.len() == walk.step {
                states.push(walk.state);
            }
        }
    }
    // If a rollout comes to rest too early, the ground truth replaces its missing states.
    for (states, track) in states.iter_mut().zip(tracks) {
        while states.len() < track.truth.len() {
            states.push(exactly(&track.truth, states.len()));
        }
    }
    states
}

/// Returns the true state when a step begins.
fn exactly(truth: &[(Vector3, Turn3)], step: usize) -> PartState {
    let before = PartState::at(truth[step.saturating_sub(1)]);
    if step == 0 { before } else { before.then(truth[step]) }
}

/// Returns the true state with its present and previous poses perturbed.
fn perturbed(truth: &[(Vector3, Turn3)], step: usize, rng: &mut Pcg64) -> PartState {
    let [least, most] = NOISE;
    let size = least * (most / least).powf(rng.random::<f64>());
    let mut aside = |(centre, turn): (Vector3, Turn3)| {
        let mut vector = |unit: f64| Vector3::from_fn(|_, _| unit * rng.random_range(-1.0..1.0));
        (centre + vector(size), Turn3::from_scaled_axis(vector(size * TURNS)) * turn)
    };
    if step == 0 {
        return PartState::at(aside(truth[0]));
    }
    PartState::at(aside(truth[step - 1])).then(aside(truth[step]))
}
