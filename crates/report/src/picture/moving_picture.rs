//! Animation of tool and objects along a recorded trajectory, in an endless loop.
//!
//! The animated SVG is self-contained and plays as an image (READMEs on the usual forges, chat,
//! slides). Viewers without animation show the end of the motion.

use crate::keyframes::{Key, short};
use crate::number::millimetres;
use crate::svg::{Font, Style};
use pushplan::geometry::{Pose, Vector};
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::Object,
    task::{Mark, Task, ToolMotion},
};

use super::{
    bodies,
    captions::Captions,
    extent::Extent,
    joints::{self, Symbol},
    legend::{self, Sample},
    moving_tool, palette,
    scene_picture::Source,
    stage::{SEEN, Stage, clockwise, shift, turn},
    strokes,
    timeline::Timeline,
    view::View,
};

/// Margin next to the plot, pixels.
const BESIDE: f64 = 16.0;
/// Height of the strip between plot and legend for progress bar and caption, pixels.
const STRIP: f64 = 42.0;

/// Content of an animation.
#[derive(Clone, Debug)]
pub struct MovingPicture<'a> {
    /// Title, bold.
    pub title: String,
    /// Short description of the pushes.
    pub plan: String,
    /// Source of the trajectory.
    pub source: Source,
    /// Task with objects, obstacles, goals and the end effector's reach.
    pub task: &'a Task,
    /// Motions of the tools.
    pub motions: &'a [ToolMotion],
    /// Trajectory to animate.
    pub trajectory: &'a Trajectory,
}

impl MovingPicture<'_> {
    /// Returns the animation as an SVG document.
    pub fn to_svg(&self) -> String {
        let timeline = Timeline::of(&strokes::all(self.motions), self.trajectory);
        let mut view = View::fit(self.extent().bounds(), Vector::new(BESIDE, 0.0));
        let note = format!("{}; {}, {}", self.plan, self.source, timeline.pace());
        let notes = palette::NOTE.wrap(&note, view.size.x);
        view.corner.y = 40.0 + 18.0 * notes.len() as f64;
        let entries = self.entries();
        let (below, wide) = (view.corner.y + view.size.y, view.size.x);
        let height = below + STRIP + legend::height(&entries, wide) + 10.0;

        let size = Vector::new(wide + 2.0 * BESIDE, height);
        let mut stage = Stage::new(size, &self.title, view, timeline);
        let at = |y: f64| Vector::new(BESIDE, y);
        stage.svg.define(palette::HATCH);
        stage.svg.text(at(27.0), &self.title, Font::new(16.0, palette::INK).bold());
        for (k, note) in notes.iter().enumerate() {
            stage.svg.text(at(46.0 + 18.0 * k as f64), note, palette::NOTE);
        }
        stage.svg.rect(view.corner, view.size, 0.0, palette::PLOT);
        stage.svg.open_clipped("plot", view.corner, view.size);
        self.plot(&mut stage);
        stage.svg.close();
        let captions = self.captions();
        captions.progress(&mut stage);
        captions.captions(&mut stage, at(below + 28.0));
        legend::draw(&mut stage.svg, &entries, at(below + STRIP), wide);
        stage.finish()
    }

    fn plot(&self, stage: &mut Stage) {
        let view = stage.view;
        bodies::reach(&mut stage.svg, &view, &self.task.annulus());
        view.grid_lines(&mut stage.svg);
        for goal in &self.task.shown_goals() {
            bodies::goal_area(&mut stage.svg, &view, goal);
        }
        bodies::fixed(&mut stage.svg, &view, &self.task.scene);
        bodies::names_of_fixed(&mut stage.svg, &view, &self.task.scene);
        let ends = self.ends();
        for (k, object) in self.task.scene.objects.iter().enumerate() {
            if bodies::moved(object, &ends[k]) {
                stage.svg.open_faded(palette::START);
                bodies::object(&mut stage.svg, &view, object, self.is_goal(k));
                stage.svg.close();
                self.way(stage, k);
            }
        }
        stage.open_layer();
        for (k, object) in self.task.scene.objects.iter().enumerate() {
            self.animate(stage, k);
            self.open_object(stage, k, &ends[k]);
            let own = Object { pose: Pose::default(), ..object.clone() };
            bodies::object(&mut stage.svg, &view.centred(), &own, self.is_goal(k));
            stage.close(2);
        }
        self.joints(stage, &ends);
        stage.close(1);
        bodies::overhead(&mut stage.svg, &view, &self.task.scene);
        for goal in &self.task.shown_goals() {
            bodies::goal(&mut stage.svg, &view, goal);
        }
        self.captions().reached(stage);
        stage.open_layer();
        moving_tool::tools(stage, &strokes::all(self.motions));
        for (k, object) in self.task.scene.things() {
            stage.svg.open_moved(&format!("o{k}"), view.map(ends[k].position), 0.0);
            let upright = Pose { position: Vector::zeros(), heading: object.pose.heading };
            let centred = view.centred();
            bodies::name(&mut stage.svg, &centred, &object.name, &object.shape, &upright);
            stage.close(1);
        }
        stage.close(1);
        moving_tool::arrows(stage, &strokes::all(self.motions));
        view.scale_bar(&mut stage.svg);
    }

    /// Draws the path of object `k`, progressively with its motion.
    fn way(&self, stage: &mut Stage, k: usize) {
        let place = |frame: &Frame| stage.view.map(frame.state.poses[k].position);
        let points: Vec<Vector> = self.frames().map(place).collect();
        let mut length = 0.0;
        let mut travelled = vec![0.0];
        for pair in points.windows(2) {
            length += (pair[1] - pair[0]).norm();
            travelled.push(length);
        }
        if length < 1.0 {
            return;
        }
        let class = format!("w{k}");
        let keys = self.keys(&stage.timeline, |index, _| [1.0 - travelled[index] / length]);
        stage.loops.animate(&class, &keys, [SEEN / length], |[left]| {
            format!("stroke-dashoffset:{}", short(left, 4))
        });
        let style = if self.is_goal(k) { palette::GOAL_WAY } else { palette::OTHER_WAY };
        stage.svg.drawn_line(&class, &points, style);
    }

    /// Animates the classes of object `k`: `o` for translation, `r` for rotation.
    fn animate(&self, stage: &mut Stage, k: usize) {
        let view = stage.view;
        let keys = self.keys(&stage.timeline, |_, frame| {
            let at = view.map(frame.state.poses[k].position);
            [at.x, at.y]
        });
        stage.loops.animate(&format!("o{k}"), &keys, [SEEN; 2], shift);
        if !self.task.scene.objects[k].shape.is_cylinder() {
            let keys = self.keys(&stage.timeline, |_, frame| [clockwise(&frame.state.poses[k])]);
            stage.loops.animate(&format!("r{k}"), &keys, [SEEN], turn);
        }
    }

    /// Opens two groups that translate and rotate with object `k`.
    fn open_object(&self, stage: &mut Stage, k: usize, end: &Pose) {
        let cylinder = self.task.scene.objects[k].shape.is_cylinder();
        let turned = if cylinder { 0.0 } else { clockwise(end) };
        let place = stage.view.map(end.position);
        stage.svg.open_moved(&format!("o{k}"), place, 0.0);
        stage.svg.open_moved(&format!("r{k}"), Vector::zeros(), turned);
    }

    /// Draws every joint with the motion of its first object, in whose frame it is defined.
    fn joints(&self, stage: &mut Stage, ends: &[Pose]) {
        let objects = &self.task.scene.objects;
        for joint in joints::between_things(&self.task.scene) {
            let first = joint.between[0];
            let own = objects[first].pose.inverse();
            let poses: Vec<Pose> = objects.iter().map(|object| own * object.pose).collect();
            self.open_object(stage, first, &ends[first]);
            let centred = stage.view.centred();
            joints::joint(&mut stage.svg, &centred, objects, joint, &poses, palette::INK);
            stage.close(2);
        }
    }

    /// Returns `true` if an object or its whole has a goal.
    fn is_goal(&self, k: usize) -> bool {
        self.task.has_goal(self.task.scene.thing(k))
    }

    fn captions(&self) -> Captions<'_> {
        let Self { task, motions, trajectory, .. } = *self;
        Captions { task, strokes: strokes::all(motions), trajectory }
    }

    /// Returns the frames that can be drawn.
    fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.trajectory.frames.iter().filter(|frame| frame.state.is_finite())
    }

    /// Returns the final poses of the objects.
    fn ends(&self) -> Vec<Pose> {
        let start = || self.task.scene.objects.iter().map(|object| object.pose).collect();
        self.frames().last().map_or_else(start, |frame| frame.state.poses.clone())
    }

    /// Returns a keyframe of `value` for every frame; while the tool is lifted, both ends of the
    /// pause have a keyframe.
    fn keys<const N: usize>(
        &self,
        timeline: &Timeline,
        value: impl Fn(usize, &Frame) -> [f64; N],
    ) -> Vec<Key<N>> {
        let mut keys: Vec<Key<N>> = Vec::new();
        let mut stroke = 0;
        for (index, frame) in self.frames().enumerate() {
            if frame.stroke != stroke {
                stroke = frame.stroke;
                let start = timeline.strokes.get(stroke).map(|span| span.start);
                keys.extend(start.zip(keys.last().copied()).map(|(at, key)| Key { at, ..key }));
            }
            keys.push(Key { at: timeline.at(frame), value: value(index, frame) });
        }
        keys
    }

    fn extent(&self) -> Extent<'_> {
        Extent {
            scene: &self.task.scene,
            goals: self.task.shown_goals(),
            reach: Some(self.task.annulus()),
            motions: self.motions,
            trajectories: vec![self.trajectory],
        }
    }

    fn entries(&self) -> Vec<(Sample, String)> {
        let goals = self.task.shown_goals();
        let tolerance = match goals.first().map(|goal| &goal.marks[..]) {
            Some([Mark::Disc { radius, .. }, ..]) => {
                format!("goal, tolerance {}", millimetres(*radius))
            }
            _ => "goal".to_owned(),
        };
        let tool = Style::fill(palette::TOOL_FILL).outlined(palette::TOOL, 1.4);
        let mut entries = vec![(Sample::Area(palette::GOAL_OBJECT), "object to move".to_owned())];
        if (0..self.task.scene.objects.len()).any(|k| !self.is_goal(k)) {
            entries.push((Sample::Area(palette::OTHER_OBJECT), "other object".to_owned()));
        }
        entries.push((Sample::Ring(palette::GOAL_RIM), tolerance));
        entries.push((Sample::Area(tool), strokes::tools(self.motions)));
        for (symbol, words) in Symbol::ALL {
            if joints::between_things(&self.task.scene).any(|joint| Symbol::of(joint) == symbol) {
                entries.push((Sample::Joint(symbol), words.to_owned()));
            }
        }
        let reach = "reach of the end effector".to_owned();
        entries.push((Sample::Ring(palette::REACH_RIM), reach));
        let scene = &self.task.scene;
        entries.extend(bodies::legend_of_fixed(scene).filter(|(_, words)| words != "obstacle"));
        entries
    }
}

#[cfg(test)]
mod tests;
