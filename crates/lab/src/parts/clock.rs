//! The time steps of a predicted lever-up.

use pushplan::internals::{outcome::LEVER_FRAMES, task::LeverUp};

/// Longest step, seconds. A blade moves 5 mm in it, and a body falls 12 mm from rest.
const LONGEST: f64 = 0.05;

/// Time after blade and body part at which the prediction of a body that does not come to rest
/// ends, seconds.
const PATIENCE: f64 = 1.0;

/// Times of the steps of a lever-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LeverClock {
    /// Number of steps of a frame of the rotation.
    pub a_frame: usize,
    turn: f64,
    end: f64,
}

impl LeverClock {
    /// Returns the clock of a lever-up.
    pub fn new(lever: &LeverUp) -> Self {
        let turn = lever.turn_time();
        let frame = turn / LEVER_FRAMES as f64;
        let a_frame = (frame / LONGEST - 1e-9).ceil().clamp(1.0, 1e4) as usize;
        Self { a_frame, turn, end: lever.duration() + PATIENCE }
    }

    /// Returns the number of steps of the rotation.
    pub fn turning(&self) -> usize {
        LEVER_FRAMES * self.a_frame
    }

    /// Returns the time at which step `k` begins and step `k - 1` ends, seconds.
    pub fn time(&self, k: usize) -> f64 {
        let turning = self.turning();
        match k.checked_sub(turning) {
            None => self.turn * k as f64 / turning as f64,
            Some(after) => self.turn + LONGEST * after as f64,
        }
    }

    /// Returns the time at which the last steps begin, seconds.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Returns `true` if step `k` begins after the end.
    pub fn is_over(&self, k: usize) -> bool {
        self.time(k) > self.end
    }
}
