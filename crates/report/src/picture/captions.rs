//! Captions of an animation: the current action, the progress, and the outcome.

use crate::keyframes::{Key, short};
use crate::number::millimetres;
use crate::svg::{Font, Style, Svg};
use pushplan::geometry::Vector;
use pushplan::{
    outcome::{Outcome, Trajectory},
    task::{Goal, Task},
};

use super::{palette, stage::Stage, strokes::Made, timeline::LIFT};

const CAPTION: Font = Font::new(14.0, palette::INK).bold();

/// Content of the captions.
pub struct Captions<'a> {
    pub task: &'a Task,
    pub strokes: Vec<Made<'a>>,
    pub trajectory: &'a Trajectory,
}

impl Captions<'_> {
    /// Draws the progress bar along the lower edge of the plot.
    pub fn progress(&self, stage: &mut Stage) {
        let corner = stage.view.corner + Vector::new(0.0, stage.view.size.y);
        let size = Vector::new(stage.view.size.x, 4.0);
        stage.svg.rect(corner, size, 0.0, palette::PROGRESS_BED);
        let (rest, total) = (stage.timeline.rest(), stage.timeline.total);
        let keys = [(0.0, 0.0), (rest, 1.0), (total, 1.0)];
        let keys = keys.map(|(at, share)| Key { at, value: [share] });
        let scale = |[share]: [f64; 1]| format!("transform:scaleX({})", short(share, 3));
        stage.loops.animate("bar", &keys, [1e-4], scale);
        stage.svg.open_moved("place", corner, 0.0);
        stage.svg.open_moved("bar", Vector::zeros(), 0.0);
        stage.svg.rect(Vector::zeros(), size, 0.0, palette::PROGRESS);
        stage.close(2);
    }

    /// Writes captions of the current action, starting at `at`; a still picture shows the last
    /// caption.
    pub fn captions(&self, stage: &mut Stage, at: Vector) {
        let rest = stage.timeline.rest();
        let goal = self.goal();
        let name = self.task.scene.objects.get(goal.object).map_or("object", |one| &one.name);
        let wanted = match self.is_placed() {
            true => {
                format!("{name} must come within {} of the goal", millimetres(goal.tolerance()))
            }
            false => goal.line(&self.task.scene),
        };
        let mut captions = vec![(0.0, wanted)];
        let count = self.strokes.len();
        let one = self.strokes.windows(2).all(|pair| pair[0].0.name == pair[1].0.name);
        let spans = stage.timeline.strokes.iter();
        for (k, (span, (tool, stroke))) in spans.zip(&self.strokes).enumerate() {
            let with = if one { String::new() } else { format!(" with the {}", tool.name) };
            let speed = stroke.travel() / stroke.duration;
            let travel = millimetres(stroke.travel());
            let words = format!("push {} of {count}{with}: {travel} at {speed:.2} m/s", k + 1);
            captions.push((span.start - LIFT, words));
        }
        for (k, (since, words)) in captions.iter().enumerate() {
            let until = captions.get(k + 1).map_or(rest, |next| next.0);
            stage.open_between(&format!("c{k}"), *since, until, false);
            stage.svg.text(at, words, CAPTION);
            stage.close(1);
        }
        stage.open_between("end", rest, stage.timeline.total, true);
        self.ending(&mut stage.svg, at);
        stage.close(1);
    }

    /// Draws a ring that expands from the goal when it is reached.
    pub fn reached(&self, stage: &mut Stage) {
        if !self.is_reached() {
            return;
        }
        let (rest, total) = (stage.timeline.rest(), stage.timeline.total);
        let keys = [
            (0.0, 1.0, 0.0),
            (rest, 1.0, 0.0),
            (rest + 0.05, 1.0, 0.9),
            (rest + 0.9, 3.0, 0.0),
            (total, 3.0, 0.0),
        ];
        let keys = keys.map(|(at, size, shown)| Key { at, value: [size, shown] });
        stage.loops.animate("ring", &keys, [0.01; 2], |[size, shown]| {
            format!("transform:scale({});opacity:{}", short(size, 2), short(shown, 2))
        });
        let end = self.trajectory.outcome().poses.get(self.goal().object).map(|pose| pose.position);
        let (place, radius) = match (self.is_placed(), end) {
            (false, Some(end)) => (end, 14.0),
            _ => {
                let radius = stage.view.length(self.goal().tolerance()).max(14.0);
                (self.goal().place(&self.task.scene.start()), radius)
            }
        };
        let place = stage.view.map(place);
        stage.svg.open_moved("goal", place, 0.0);
        stage.svg.open_shown("ring", 0.0);
        stage.svg.circle(Vector::zeros(), radius, Style::stroke(palette::GOOD, 2.5));
        stage.close(2);
    }

    /// Writes the outcome behind a tick or a cross.
    fn ending(&self, svg: &mut Svg, at: Vector) {
        let Some(last) = self.trajectory.frames.last() else { return };
        let (error, allowed) = match self.is_placed() {
            true => {
                let error = millimetres(self.goal().error(&last.state));
                let allowed = millimetres(self.goal().tolerance());
                (format!(": final error {error}"), format!(", allowed {allowed}"))
            }
            false => (String::new(), String::new()),
        };
        let (colour, words, mark): (_, _, &[[f64; 2]]) = if self.is_reached() {
            let tick = &[[-3.6, 0.2], [-1.2, 2.8], [3.8, -2.6]];
            (palette::GOOD, format!("reached{error}"), tick)
        } else {
            let cross = &[[-3.0, -3.0], [3.0, 3.0], [0.0, 0.0], [-3.0, 3.0], [3.0, -3.0]];
            let words = format!("missed{error}{allowed}");
            (palette::BAD, words, cross)
        };
        let centre = at + Vector::new(8.0, -5.0);
        svg.circle(centre, 8.0, Style::fill(colour));
        let mark: Vec<Vector> = mark.iter().map(|[x, y]| centre + Vector::new(*x, *y)).collect();
        svg.polyline(&mark, Style::stroke("#ffffff", 2.0));
        svg.text(at + Vector::new(24.0, 0.0), &words, Font { colour, ..CAPTION });
    }

    /// Returns the first goal.
    fn goal(&self) -> &Goal {
        &self.task.goals[0]
    }

    /// Returns `true` if the first goal is a position with a tolerance.
    fn is_placed(&self) -> bool {
        self.goal().position().is_some() && self.goal().tolerance().is_finite()
    }

    fn is_reached(&self) -> bool {
        !self.trajectory.frames.is_empty()
            && Outcome::judge(&self.task.scene, self.task, self.trajectory).reached
    }
}
