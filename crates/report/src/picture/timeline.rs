//! When what happens in a moving picture: recorded time stretched, with pauses for the eye.

use pushplan::outcome::{Frame, Trajectory};

use super::strokes::Made;

/// Before the first push, seconds: objects and goal are found, then the tool comes down.
const BEFORE: f64 = 1.1;
/// Between two placed pushes, seconds: the tool goes up, over, and down.
const BETWEEN: f64 = 1.1;
/// After everything rests, seconds: long enough to read how near it ended.
const AFTER: f64 = 2.6;
/// The tool going up or down, seconds.
pub const LIFT: f64 = 0.3;
/// Motion longer than this, seconds, is shown faster: nobody watches a README for a minute.
const LONGEST: f64 = 9.0;
/// How much faster.
const RATES: [f64; 6] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0];

/// One stroke in the picture's time, seconds since the start of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The tool starts to move.
    pub start: f64,
    /// The tool stands where the stroke ends, and everything rests if it is a settled one.
    pub end: f64,
    /// Whether the tool comes down for it.
    pub lowered: bool,
    /// Recorded time at its start, seconds.
    recorded: f64,
}

/// The times of a loop.
#[derive(Clone, Debug)]
pub struct Timeline {
    /// The strokes that were carried out.
    pub strokes: Vec<Span>,
    /// Recorded seconds in a second of the picture.
    pub rate: f64,
    /// Length of the loop, seconds.
    pub total: f64,
}

impl Timeline {
    /// The times of a recorded motion.
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

    /// How fast the motion is shown, in words.
    pub fn pace(&self) -> String {
        match self.rate {
            1.0 => "in real time".to_owned(),
            rate => format!("{rate:.0} times as fast"),
        }
    }

    /// When everything has come to rest.
    pub fn rest(&self) -> f64 {
        self.total - AFTER
    }

    /// When a recorded frame is shown.
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

    /// Two pushes of a second each, recorded at their ends alone.
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
