//! Timing of an animation: recorded time, scaled, with pauses for the viewer.

use pushplan::outcome::{Frame, Trajectory};

use super::strokes::Made;

/// Pause before the first push, seconds, in which the viewer finds objects and goal and the tool is
/// lowered.
const BEFORE: f64 = 1.1;
/// Pause between two placed pushes, seconds, in which the tool moves over.
const BETWEEN: f64 = 1.1;
/// Pause after rest, seconds, long enough to read the final error.
const AFTER: f64 = 2.6;
/// Duration of lifting or lowering the tool, seconds.
pub const LIFT: f64 = 0.3;
/// Maximum duration of the shown motion, seconds; longer motion is accelerated.
const LONGEST: f64 = 9.0;
/// Available playback rates.
const RATES: [f64; 6] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0];

/// A stroke in animation time, seconds since the start of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Start of the tool's motion.
    pub start: f64,
    /// End of the tool's motion, or, for a settled stroke, the time when everything rests.
    pub end: f64,
    /// Whether the tool is lowered for this stroke.
    pub lowered: bool,
    /// Recorded time at the start of the stroke, seconds.
    recorded: f64,
}

/// Times of a loop.
#[derive(Clone, Debug)]
pub struct Timeline {
    /// Executed strokes.
    pub strokes: Vec<Span>,
    /// Playback rate: recorded seconds per second of the animation.
    pub rate: f64,
    /// Length of the loop, seconds.
    pub total: f64,
}

impl Timeline {
    /// Computes the timeline of a recorded motion.
    pub fn of(made: &[Made], trajectory: &Trajectory) -> Self {
        let frames = &trajectory.frames;
        let recorded = frames.last().map_or(0.0, |frame| frame.time);
        let fits = |rate: &&f64| recorded / **rate <= LONGEST;
        let rate = RATES.iter().find(fits).or(RATES.last()).copied().unwrap_or(1.0);
        let mut strokes: Vec<Span> = Vec::new();
        for index in 0..made.len() {
            let Some(last) = frames.iter().rev().find(|frame| frame.stroke == index) else { break };
            let lowered = index == 0 || made[index - 1].1.settle;
            let pause = if lowered { BETWEEN } else { 0.0 };
            let start = strokes.last().map_or(BEFORE, |before| before.end + pause);
            let recorded = match index.checked_sub(1) {
                None => 0.0,
                Some(before) => {
                    let of_before = |frame: &&Frame| frame.stroke == before;
                    frames.iter().rev().find(of_before).map_or(0.0, |frame| frame.time)
                }
            };
            let end = start + (last.time - recorded) / rate;
            strokes.push(Span { start, end, lowered, recorded });
        }
        let total = strokes.last().map_or(BEFORE, |last| last.end) + AFTER;
        Self { strokes, rate, total }
    }

    /// Describes the playback rate.
    pub fn pace(&self) -> String {
        match self.rate {
            1.0 => "in real time".to_owned(),
            rate => format!("{rate:.0} times as fast"),
        }
    }

    /// Returns the time at which all bodies are at rest.
    pub fn rest(&self) -> f64 {
        self.total - AFTER
    }

    /// Returns the time at which a recorded frame is shown.
    pub fn at(&self, frame: &Frame) -> f64 {
        self.strokes
            .get(frame.stroke)
            .map_or(0.0, |span| span.start + (frame.time - span.recorded) / self.rate)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::picture::strokes;
    use pushplan::geometry::{Pose, Vector};
    use pushplan::{
        scene::{Part, State, Tool},
        task::{Push, ToolMotion},
    };

    /// Returns the timeline of two pushes of a second each, recorded at their ends only.
    fn timeline(placed: bool, speed: f64) -> Timeline {
        let part = Part::cuboid("bar", [0.1, 0.1, 0.05], Pose::default());
        let tool = Tool::new("bar", [part]).unwrap();
        let push = Push { start: Vector::zeros(), direction: 0.0, length: 0.1, speed };
        let motion = ToolMotion::pushes(Arc::new(tool), 0.0, 0.0, &[push, push], placed);
        let seconds = 0.1 / speed;
        let frames = vec![frame(0, 0.0), frame(0, seconds), frame(1, 2.0 * seconds)];
        Timeline::of(
            &strokes::all(&[motion]),
            &Trajectory { frames, ..Trajectory::new(pushplan::scene::ModelKind::PLANAR.into()) },
        )
    }

    #[test]
    fn placed_pushes_leave_time_to_lift_the_tool_and_chained_ones_do_not() {
        let spans = |timeline: Timeline| {
            let spans = timeline.strokes.into_iter();
            spans.map(|span| (span.end - span.start, span.lowered)).collect::<Vec<_>>()
        };
        let (placed, chained) = (timeline(true, 0.1), timeline(false, 0.1));
        assert!((placed.total - chained.total - BETWEEN).abs() < 1e-12);
        assert!((placed.at(&frame(1, 2.0)) - placed.rest()).abs() < 1e-12);
        assert_eq!(spans(placed).iter().filter(|span| span.1).count(), 2);
        assert_eq!(spans(chained).iter().filter(|span| span.1).count(), 1);
    }

    #[test]
    fn long_motions_are_shown_faster_by_a_round_number() {
        assert_eq!(timeline(true, 0.1).rate, 1.0);
        let slow = timeline(true, 0.01);
        assert_eq!(slow.rate, 5.0);
        assert!(slow.total < LONGEST + BEFORE + BETWEEN + AFTER);
    }

    fn frame(stroke: usize, time: f64) -> Frame {
        Frame { time, stroke, tool: Pose::default(), state: State::default(), blade: None }
    }
}
