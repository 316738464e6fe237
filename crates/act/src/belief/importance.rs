//! Weighing of particles and masses with the observations of a whole push.

use std::sync::Arc;

use pushplan::{
    effect::EffectModel,
    outcome::{Record, Trajectory},
    scene::{Physics, State},
    task::{Job, Observation, Stroke, ToolMotion},
};

use super::{
    density::log_sum,
    filter::Belief,
    joints::{carried, likeliest},
    masses::Replay,
    rolled::Rolled,
    state_filter::{ARM, StateFilter},
};

/// Maximum number of observations per rollout.
const LONGEST: usize = 40;

/// Number of evaluated instants of a push, including the last. Further instants are redundant
/// because the model's error grows almost linearly.
const INSTANTS: usize = 3;

/// Standard deviation of a rollout: metres, and share of the motion.
const ASTRAY: [f64; 2] = [4e-4, 0.03];

/// Exponent of the likelihoods, because the model's errors are correlated over all objects and
/// instants of a push.
const TEMPERING: f64 = 0.5;

/// Additional exponent for masses, whose evidence comes from a few instants and affects all later
/// ones.
///
/// Best calibrated on 300 pushes of seed 5, `pushplan-lab masses`.
const OF_MASSES: f64 = 0.6;

/// Number of initial states for weighing masses.
///
/// Measured for seed 5 and true poses. With 16 states and masses anywhere in their ranges, 66 % of
/// the masses are correct, and 61 % with one state and masses in the middle. There is no
/// improvement with 24 states.
const STARTS: usize = 16;

/// Observations since the tool was set down.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    /// Estimated poses at that time.
    before: StateFilter,
    seen: Vec<Observation>,
}

impl Belief {
    /// Adds a window; parameters are weighed once the tool is lifted.
    pub(super) fn weigh_numbers(&mut self, model: &dyn EffectModel, window: &[Observation]) {
        if self.particles.is_empty() && self.masses.is_none() {
            return;
        }
        let before = || Stretch { before: self.track.clone(), seen: Vec::new() };
        let mut stretch = self.stretch.take().unwrap_or_else(before);
        stretch.seen.extend_from_slice(window);
        let lifted = |seen: &Observation| seen.strokes.last().is_some_and(|last| last.settle);
        if stretch.seen.len() < LONGEST && !stretch.seen.last().is_some_and(lifted) {
            self.stretch = Some(stretch);
            return;
        }
        self.weigh_stretch(model, &stretch);
    }

    /// Processes all pending observations, including observations of an unfinished push.
    pub fn finish(&mut self, model: &dyn EffectModel) {
        self.settle(model);
        if let Some(stretch) = self.stretch.take() {
            self.weigh_stretch(model, &stretch);
        }
    }

    fn weigh_stretch(&mut self, model: &dyn EffectModel, stretch: &Stretch) {
        let Stretch { before, seen } = stretch;
        let start = &before.state;
        // The current joint estimates are used, at the initial poses of the push.
        let mut physics = likeliest(&self.scene, &self.regulated_pairs(), start);
        physics.joints.extend(carried(&self.known, &self.scene, start));
        let strokes: Vec<Stroke> = seen.iter().flat_map(|seen| seen.strokes.clone()).collect();
        let motion = ToolMotion { tool: Arc::clone(&self.tool), lift: self.lift, strokes };
        let scene = self.scene_at(start);
        let job = |physics| Job {
            start: start.clone(),
            motion: motion.clone().into(),
            physics: Arc::new(physics),
        };
        let roll = |each: Vec<Physics>| {
            let jobs: Vec<Job> = each.into_iter().map(job).collect();
            model.rollout(&scene, &jobs, Record::Frames)
        };
        let score = |trajectory: &Trajectory| {
            likelihood(before, &Rolled::new(trajectory, seen, start), seen)
        };
        if !self.particles.is_empty() {
            let physics = match &self.masses {
                Some(masses) => masses.likeliest(physics.clone()),
                None => physics.clone(),
            };
            let rolled = roll(self.particles.each(&self.scene, &physics));
            self.particles.weigh(&rolled.iter().map(score).collect::<Vec<_>>());
        }
        if let Some(mut masses) = self.masses.take() {
            let physics = self.particles.mean(&self.scene, physics);
            let starts = before.starts(&self.scene, STARTS);
            let from = |starts: &[State], physics: Vec<Physics>| -> Vec<Job> {
                let both = starts.iter().zip(physics);
                both.map(|(start, physics)| Job { start: start.clone(), ..job(physics) }).collect()
            };
            let play = |physics: Physics| {
                let jobs = from(&starts, vec![physics; starts.len()]);
                model.rollout(&scene, &jobs, Record::Frames)
            };
            let score = |each: Vec<Vec<Physics>>| -> Vec<f64> {
                let played = each.first().map_or(1, Vec::len);
                let jobs: Vec<Job> =
                    each.into_iter().flat_map(|physics| from(&starts, physics)).collect();
                let rolled = model.rollout(&scene, &jobs, Record::Frames);
                let log = |(trajectory, job): (&Trajectory, &Job)| {
                    likelihood(before, &Rolled::new(trajectory, seen, &job.start), seen)
                };
                let logs: Vec<f64> = rolled.iter().zip(&jobs).map(log).collect();
                // Likelihood averaged over the initial states.
                let mean = |logs: &[f64]| log_sum(logs.iter().copied().filter(|log| !log.is_nan()));
                logs.chunks(played).map(|logs| OF_MASSES * mean(logs)).collect()
            };
            let replay = Replay { starts: starts.len(), play: &play, score: &score };
            masses.weigh(&physics, &replay);
            self.masses = Some(masses);
        }
    }
}

/// Returns the log-density of the observations given a rollout.
fn likelihood(before: &StateFilter, rolled: &Rolled, seen: &[Observation]) -> f64 {
    let mut log = 0.0;
    for instant in 1..=INSTANTS.min(seen.len()) {
        let k = seen.len() * instant / INSTANTS.min(seen.len()) - 1;
        let (state, now) = (&rolled.states[k], &seen[k]);
        for object in 0..state.poses.len() {
            log += of_object(before, object, state, now);
        }
    }
    TEMPERING * log
}

fn of_object(before: &StateFilter, object: usize, state: &State, now: &Observation) -> f64 {
    let (start, rolled) = (&before.state.poses[object], &state.poses[object]);
    let Some((pose, variance)) = before.sight(now.seen[object], rolled) else { return 0.0 };
    let motion =
        (rolled.position - start.position).norm().max((pose.position - start.position).norm());
    let model = (ASTRAY[0] + ASTRAY[1] * motion).powi(2);
    let [place, turn] = [
        model + variance[0] + before.variance[object][0],
        model / (ARM * ARM) + variance[1] + before.variance[object][1],
    ];
    let square = (pose.position - rolled.position).norm_squared() / place
        + (pose.heading - rolled.heading).powi(2) / turn;
    // Student's t distribution in three dimensions with four degrees of freedom. Resting objects
    // have equal variances under all particles.
    -place.ln() - 0.5 * turn.ln() - 3.5 * (square / 4.0).ln_1p()
}
