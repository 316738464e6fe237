//! The steps in which a lever-up is predicted.

use pushplan::internals::{outcome::LEVER_FRAMES, task::LeverUp};

/// Longest step, seconds. In it a blade moves 5 mm, and what falls from rest 12 mm.
const LONGEST: f64 = 0.05;

/// So long after blade and body part a body that does not come to rest is left where it is, seconds.
const PATIENCE: f64 = 1.0;

/// Times of the steps of a lever-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LeverClock {
    /// Steps of a frame of the turn.
    pub a_frame: usize,
    turn: f64,
    end: f64,
}

impl LeverClock {
    /// That of a lever-up.
    pub fn new(lever: &LeverUp) -> Self {
        let turn = lever.turn_time();
        let frame = turn / LEVER_FRAMES as f64;
        let a_frame = (frame / LONGEST - 1e-9).ceil().clamp(1.0, 1e4) as usize;
        Self { a_frame, turn, end: lever.duration() + PATIENCE }
    }

    /// Steps of the turn.
    pub fn turning(&self) -> usize {
        LEVER_FRAMES * self.a_frame
    }

    /// When step `k` begins, seconds; step `k - 1` ends then.
    pub fn time(&self, k: usize) -> f64 {
        let turning = self.turning();
        match k.checked_sub(turning) {
            None => self.turn * k as f64 / turning as f64,
            Some(after) => self.turn + LONGEST * after as f64,
        }
    }

    /// When the last steps begin, seconds.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Whether step `k` comes too late.
    pub fn is_over(&self, k: usize) -> bool {
        self.time(k) > self.end
    }
}
