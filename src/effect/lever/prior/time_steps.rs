//! Time steps of a lever-up: the rotation in frames, the hold, the retreat, and the motion until
//! rest.

use crate::geometry::{Pose3, Vector3};
use crate::{
    outcome::{Ending, LEVER_FRAMES, LeverTrajectory, LeverWarning, has_slipped},
    scene::{GRAVITY, REST_SPEED},
};

use super::body::Body;
use super::contacts::{self, Contact, ON_BLADE};
use super::settings::PriorSettings;
use super::setup::{BladePose, Setup};
use super::solver::Solver;

/// Distance from the blade below which a plate lies on it, metres.
const NEAR: f64 = 5e-4;

/// Maximum wait for rest after the end, seconds.
const PATIENCE: f64 = 4.0;

/// Duration of slow motion after which the plate rests, seconds.
const STILL: f64 = 0.1;

/// A time stepper with reusable buffers.
#[derive(Clone, Debug, Default)]
pub(super) struct TimeSteps {
    solver: Solver,
    contacts: Vec<Contact>,
}

impl TimeSteps {
    pub fn march(&mut self, setup: &Setup, settings: &PriorSettings) -> LeverTrajectory {
        let mut way = self.begin(setup, settings);
        let (mut lift, mut held) = (Vec::new(), Vec::new());
        let turn = setup.lever.turn_time();
        for k in 1..=LEVER_FRAMES {
            way.go_on_until(turn * k as f64 / LEVER_FRAMES as f64);
            lift.push(setup.pose(&way.body));
            held.push(way.is_held());
        }
        let rests = way.settle(setup.lever.duration());
        let rest = setup.pose(&way.body);
        let mut warnings = Vec::new();
        if has_slipped(&setup.start(), &lift, &held) {
            warnings.push(LeverWarning::Slipped);
        }
        if !rests {
            warnings.push(LeverWarning::Moving);
        }
        LeverTrajectory { lift, held, rest, ending: Ending::of(&rest), warnings }
    }

    /// Returns the poses at these times, until the plate rests without the blade.
    pub fn follow(
        &mut self,
        setup: &Setup,
        settings: &PriorSettings,
        times: impl Iterator<Item = f64>,
    ) -> Vec<Pose3> {
        let mut way = self.begin(setup, settings);
        let (mut poses, mut moved) = (Vec::new(), 0.0);
        for time in times {
            way.go_on_until(time);
            poses.push(setup.pose(&way.body));
            let turning = time <= setup.lever.turn_time();
            if turning || way.is_near_blade() || way.body.fastest(setup.reach) > REST_SPEED {
                moved = time;
            }
            if time - moved >= STILL {
                break;
            }
        }
        poses
    }

    fn begin<'a>(&'a mut self, setup: &'a Setup, settings: &'a PriorSettings) -> Way<'a> {
        self.solver.reset(contacts::count(setup));
        Way {
            marcher: self,
            setup,
            settings,
            body: Body::at(setup.centre),
            time: 0.0,
            last: settings.step,
            blade: setup.blade_at(0.0),
        }
    }
}

/// A lever-up in progress.
struct Way<'a> {
    marcher: &'a mut TimeSteps,
    setup: &'a Setup,
    settings: &'a PriorSettings,
    body: Body,
    time: f64,
    /// Length of the last step, seconds.
    last: f64,
    blade: BladePose,
}

impl Way<'_> {
    fn go_on_until(&mut self, end: f64) {
        while end - self.time > 1e-9 {
            let left = end - self.time;
            // Equal steps, as far as the speed allows.
            let steps = (left / self.longest() - 1e-6).ceil().max(1.0);
            self.step(if steps > 1.0 { left / steps } else { left });
        }
    }

    /// Continues until everything rests and the blade is gone, which is at `end` at the latest.
    /// Returns `true` if the plate came to rest in time.
    fn settle(&mut self, end: f64) -> bool {
        let mut moved = self.time;
        let mut free = false;
        while self.time - moved < STILL || !(free || self.time >= end) {
            self.step(self.longest());
            // A plate at rest off the blade stays there while the blade retreats.
            free = self.time >= self.setup.lever.turn_time() && !self.is_near_blade();
            if self.body.fastest(self.setup.reach) > REST_SPEED {
                moved = self.time;
            }
            if self.time - end > PATIENCE {
                return false;
            }
        }
        true
    }

    /// Returns `true` if the blade may touch the plate in the next step.
    fn is_near_blade(&self) -> bool {
        self.marcher.contacts.first().is_some_and(|contact| contact.id < ON_BLADE)
    }

    /// Returns the maximum length of the next step, seconds.
    fn longest(&self) -> f64 {
        let PriorSettings { step, travel, shortest, inertia, .. } = *self.settings;
        if !inertia {
            return step;
        }
        (travel / self.body.fastest(self.setup.reach)).clamp(shortest.min(step), step)
    }

    fn step(&mut self, step: f64) {
        let Self { marcher, setup, settings, body, .. } = self;
        let next = setup.blade_at(self.time + step);
        if !settings.inertia {
            (body.speed, body.spin) = (Vector3::zeros(), Vector3::zeros());
        }
        contacts::find(setup, body, (&self.blade, &next), step, &mut marcher.contacts);
        body.speed.z -= GRAVITY * step;
        let ratio = step / self.last;
        marcher.solver.solve(
            (&setup.spread, body),
            &marcher.contacts,
            (step, ratio, settings.sweeps),
        );
        body.advance(step);
        self.time += step;
        self.last = step;
        self.blade = next;
    }

    /// Returns `true` if the plate lies on the blade.
    fn is_held(&self) -> bool {
        let contacts = self.marcher.contacts.iter().zip(self.marcher.solver.impulses());
        contacts
            .take_while(|(contact, _)| contact.id < ON_BLADE)
            .any(|(contact, impulse)| impulse[0] > 0.0 || contact.gap <= NEAR)
    }
}
