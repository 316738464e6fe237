//! Verdict of another physics engine on a plan, shown beside our own.

use serde::{Deserialize, Serialize};

use pushplan::outcome::Verdict;

use super::number::{degrees, millimetres};

/// Verdict on a plan, with the verdict of another engine if it was asked.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'a> {
    /// Verdict of our own engines.
    pub verdict: &'a Verdict,
    /// Verdict of another engine.
    pub second: Option<&'a SecondOpinion>,
}

impl<'a> From<&'a Verdict> for Judged<'a> {
    fn from(verdict: &'a Verdict) -> Self {
        Self { verdict, second: None }
    }
}

/// Verdict of another physics engine, which shares no code with ours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SecondOpinion {
    /// Name and version of the engine.
    pub engine: String,
    /// Whether the plan keeps the rules of its task and its replay works.
    pub passed: bool,
    /// Reason why the replay does not work.
    pub failure: Option<String>,
    /// Position error of the first goal, metres, if the replay ended.
    pub error: Option<f64>,
    /// Heading error of the first goal, radians, if it has a heading.
    pub heading_error: Option<f64>,
    /// Distance between the ends of this replay and of our nominal 3-D replay, metres.
    pub difference: Option<f64>,
    /// Replays with different time steps; the last one decides.
    pub runs: Vec<TimedReplay>,
}

/// Replay with one time step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimedReplay {
    /// Time step, seconds.
    pub timestep: f64,
    /// Reason why the replay does not work.
    pub failure: Option<String>,
}

impl SecondOpinion {
    /// Formats the verdict and its reason in a sentence.
    pub fn line(&self) -> String {
        let found = match &self.failure {
            None if self.passed => "passed: reaches the goal".to_owned(),
            None => "failed: reaches the goal, but breaks a rule of the task".to_owned(),
            Some(failure) => format!("failed: {failure}{}", self.errors()),
        };
        let apart = self.difference.filter(|_| self.failure.is_none()).map(millimetres);
        let apart = apart.map(|apart| format!(", {apart} from the end in 3-D"));
        format!("{} {found}{}{}", self.engine, apart.unwrap_or_default(), self.steps())
    }

    /// Formats the errors of a missed goal.
    fn errors(&self) -> String {
        let by = [self.error.map(millimetres), self.heading_error.map(degrees)];
        let by: Vec<String> = by.into_iter().flatten().collect();
        if by.is_empty() { String::new() } else { format!(" (error {})", by.join(" and ")) }
    }

    /// Formats the time steps if their replays differ.
    fn steps(&self) -> String {
        if self.runs.iter().all(|run| run.failure == self.failure) {
            return String::new();
        }
        let each = self.runs.iter().map(|run| {
            let found = run.failure.as_deref().unwrap_or("reaches the goal");
            format!("{found} at {} ms", 1e3 * run.timestep)
        });
        format!("; results differ with the time step: {}", each.collect::<Vec<_>>().join(", "))
    }
}

#[cfg(test)]
mod tests;
