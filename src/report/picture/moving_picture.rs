//! A picture that moves: tool and objects along a recorded trajectory, in an endless loop.
//!
//! An animated SVG that needs nothing but itself and moves where an image may (READMEs on the
//! usual forges, chat, slides). Where nothing moves it shows the end of the motion.

use crate::geometry::{Pose, Vector};
use crate::report::keyframes::{Key, Keyframes, short};
use crate::report::number::millimetres;
use crate::report::svg::{Font, Style, Svg};
use crate::scene::{Frame, Goal, Object, Robot, Scene, ToolMotion, Trajectory};

use super::{
    bodies,
    extent::Extent,
    joints::{self, Symbol},
    legend::{self, Sample},
    palette, strokes,
    timeline::{LIFT, Timeline},
    view::View,
};

/// Pixels beside the plot.
const BESIDE: f64 = 16.0;
/// Pixels between plot and legend: the progress bar and the line that says what happens.
const STRIP: f64 = 42.0;
/// Fading in and out at both ends of the loop, seconds.
const FADE: f64 = 0.35;
/// How much larger a tool looks that is lifted towards the viewer.
const LIFTED: f64 = 1.05;
/// The eye sees no less, pixels and degrees.
const SEEN: f64 = 0.2;

const CAPTION: Font = Font::new(14.0, palette::INK).bold();

/// What to animate.
#[derive(Clone, Debug)]
pub struct MovingPicture<'a> {
    /// First line, bold.
    pub title: String,
    /// Lines below it.
    pub notes: Vec<String>,
    /// Objects at their start, obstacles.
    pub scene: &'a Scene,
    /// Where which object must come.
    pub goal: &'a Goal,
    /// Reach of the end effector.
    pub robot: &'a Robot,
    /// What the tool does.
    pub motion: &'a ToolMotion,
    /// What happens, frame by frame.
    pub trajectory: &'a Trajectory,
}

impl MovingPicture<'_> {
    /// The picture as an SVG document.
    pub fn to_svg(&self) -> String {
        let timeline = Timeline::of(self.motion, self.trajectory);
        let mut view = View::fit(self.extent().bounds(), Vector::new(BESIDE, 0.0));
        let mut notes = self.notes.clone();
        notes.push(shown_as(timeline.rate));
        let notes: Vec<String> =
            notes.iter().flat_map(|note| palette::NOTE.wrap(note, view.size.x)).collect();
        view.corner.y = 40.0 + 18.0 * notes.len() as f64;
        let entries = self.entries();
        let below = view.corner.y + view.size.y;
        let height = below + STRIP + legend::height(&entries, view.size.x) + 10.0;

        let mut svg = Svg::new(view.size.x + 2.0 * BESIDE, height, &self.title);
        svg.define(palette::HATCH);
        let at = |y: f64| Vector::new(BESIDE, y);
        svg.text(at(27.0), &self.title, Font::new(16.0, palette::INK).bold());
        for (k, note) in notes.iter().enumerate() {
            svg.text(at(46.0 + 18.0 * k as f64), note, palette::NOTE);
        }
        svg.rect(view.corner, view.size, 0.0, palette::PLOT);
        let mut loops = Keyframes::new(timeline.total);
        svg.open_clipped("plot", view.corner, view.size);
        self.plot(&mut svg, &mut loops, &view, &timeline);
        svg.close();
        self.progress(&mut svg, &mut loops, &view, &timeline);
        self.captions(&mut svg, &mut loops, at(below + 28.0), &timeline);
        legend::draw(&mut svg, &entries, at(below + STRIP), view.size.x);
        svg.style(&loops.finish());
        svg.finish()
    }

    fn plot(&self, svg: &mut Svg, loops: &mut Keyframes, view: &View, timeline: &Timeline) {
        bodies::reach(svg, view, self.robot);
        view.grid_lines(svg);
        bodies::goal_area(svg, view, self.goal);
        for obstacle in &self.scene.obstacles {
            bodies::obstacle(svg, view, obstacle);
            bodies::name(svg, view, &obstacle.name, &obstacle.shape(), &obstacle.pose);
        }
        let moved: Vec<bool> = self.scene.objects.iter().zip(self.ends()).map(|(object, end)| {
            bodies::moved(object, &end)
        }).collect();
        for (k, object) in self.scene.objects.iter().enumerate().filter(|(k, _)| moved[*k]) {
            svg.open_faded(0.3);
            bodies::object(svg, view, object, k == self.goal.object);
            svg.close();
            self.way(svg, loops, view, timeline, k);
        }
        loops.animate("layer", &fade(timeline), [0.01], opacity);
        svg.open_shown("layer", 1.0);
        for (k, object) in self.scene.objects.iter().enumerate() {
            self.move_object(loops, view, timeline, k);
            self.open_object(svg, view, k);
            let own = Object { pose: Pose::default(), ..object.clone() };
            bodies::object(svg, &view.centred(), &own, k == self.goal.object);
            svg.close();
            svg.close();
        }
        self.joints(svg, view);
        svg.close();
        bodies::goal(svg, view, self.goal);
        self.reached(svg, loops, view, timeline);
        svg.open_shown("layer", 1.0);
        self.tool(svg, loops, view, timeline);
        for (k, object) in self.scene.objects.iter().enumerate() {
            let end = self.ends()[k];
            svg.open_moved(&format!("o{k}"), view.map(end.position), 0.0);
            let upright = Pose { position: Vector::zeros(), heading: object.pose.heading };
            bodies::name(svg, &view.centred(), &object.name, &object.shape, &upright);
            svg.close();
        }
        svg.close();
        self.arrows(svg, loops, view, timeline);
        view.scale_bar(svg);
    }

    /// The way of object `k`, drawn as it goes.
    fn way(
        &self,
        svg: &mut Svg,
        loops: &mut Keyframes,
        view: &View,
        timeline: &Timeline,
        k: usize,
    ) {
        let points: Vec<Vector> =
            self.frames().map(|frame| view.map(frame.state.poses[k].position)).collect();
        let mut gone = 0.0;
        let travelled: Vec<f64> = std::iter::once(0.0)
            .chain(points.windows(2).map(|pair| {
                gone += (pair[1] - pair[0]).norm();
                gone
            }))
            .collect();
        if gone < 1.0 {
            return;
        }
        let keys = self.keys(timeline, |index, _| [1.0 - travelled[index] / gone]);
        loops.animate(&format!("w{k}"), &keys, [SEEN / gone], |[left]| {
            format!("stroke-dashoffset:{}", short(left, 4))
        });
        let style = if k == self.goal.object { palette::GOAL_WAY } else { palette::OTHER_WAY };
        svg.drawn_line(&format!("w{k}"), &points, style);
    }

    fn move_object(&self, loops: &mut Keyframes, view: &View, timeline: &Timeline, k: usize) {
        let keys = self.keys(timeline, |_, frame| {
            let at = view.map(frame.state.poses[k].position);
            [at.x, at.y]
        });
        loops.animate(&format!("o{k}"), &keys, [SEEN; 2], shift);
        if !self.scene.objects[k].shape.is_cylinder() {
            let keys = self.keys(timeline, |_, frame| [clockwise(&frame.state.poses[k])]);
            loops.animate(&format!("r{k}"), &keys, [SEEN], turn);
        }
    }

    /// Opens two groups that move and turn with object `k`.
    fn open_object(&self, svg: &mut Svg, view: &View, k: usize) {
        let end = self.ends()[k];
        svg.open_moved(&format!("o{k}"), view.map(end.position), 0.0);
        let cylinder = self.scene.objects[k].shape.is_cylinder();
        svg.open_moved(&format!("r{k}"), Vector::zeros(), if cylinder { 0.0 } else { clockwise(&end) });
    }

    /// Every joint moves with its first object, in whose frame it is given.
    fn joints(&self, svg: &mut Svg, view: &View) {
        for joint in &self.scene.joints {
            let first = joint.between[0];
            let own = self.scene.objects[first].pose.inverse();
            let poses: Vec<Pose> =
                self.scene.objects.iter().map(|object| own * object.pose).collect();
            self.open_object(svg, view, first);
            joints::joint(svg, &view.centred(), &self.scene.objects, joint, &poses, palette::INK);
            svg.close();
            svg.close();
        }
    }

    fn tool(&self, svg: &mut Svg, loops: &mut Keyframes, view: &View, timeline: &Timeline) {
        let tool = &self.motion.tool;
        let Some(last) = timeline.strokes.last() else { return };
        let mut poses: Vec<(f64, Pose)> = Vec::new();
        let mut lift = vec![Key { at: 0.0, value: [0.0, LIFTED] }];
        for (span, stroke) in timeline.strokes.iter().zip(&self.motion.strokes) {
            if span.lowered {
                if let Some(&(before, pose)) = poses.last() {
                    let up = [palette::TOOL_LIFTED, LIFTED];
                    lift.push(Key { at: before, value: [1.0, 1.0] });
                    lift.push(Key { at: before + LIFT, value: up });
                    lift.push(Key { at: span.start - LIFT, value: up });
                    poses.push((before + LIFT, pose));
                    poses.push((span.start - LIFT, stroke.from));
                } else {
                    lift.push(Key { at: span.start - LIFT, value: [0.0, LIFTED] });
                }
                lift.push(Key { at: span.start, value: [1.0, 1.0] });
            }
            let stop = span.start + stroke.duration / timeline.rate;
            poses.push((span.start, stroke.from));
            poses.push((stop.min(span.end), stroke.to));
            poses.push((span.end, stroke.to));
        }
        lift.push(Key { at: last.end, value: [1.0, 1.0] });
        lift.push(Key { at: last.end + LIFT, value: [palette::TOOL_LIFTED, LIFTED] });

        let grips = poses.iter().map(|(at, pose)| (*at, *pose * tool.grip));
        let (mut shifts, mut turns) = (Vec::new(), Vec::new());
        let mut end = Pose::default();
        for (at, grip) in grips {
            let place = view.map(grip.position);
            shifts.push(Key { at, value: [place.x, place.y] });
            turns.push(Key { at, value: [clockwise(&grip)] });
            end = grip;
        }
        loops.animate("tool", &shifts, [SEEN; 2], shift);
        loops.animate("yaw", &turns, [SEEN], turn);
        loops.animate("lift", &lift, [0.01, 0.001], |[shown, size]| {
            format!("opacity:{};transform:scale({})", short(shown, 2), short(size, 3))
        });
        svg.open_moved("tool", view.map(end.position), 0.0);
        svg.open_moved("yaw", Vector::zeros(), clockwise(&end));
        svg.open_shown("lift", palette::TOOL_LIFTED);
        let own = tool.grip.inverse();
        strokes::silhouette(svg, &view.centred(), tool, &own, palette::TOOL_AT_WORK);
        strokes::hold(svg, &view.centred(), tool, &own);
        (0..3).for_each(|_| svg.close());
    }

    /// Each push's arrow while it is made.
    fn arrows(&self, svg: &mut Svg, loops: &mut Keyframes, view: &View, timeline: &Timeline) {
        for (k, span) in timeline.strokes.iter().enumerate() {
            let class = format!("a{k}");
            let keys = shown_between(span.start - LIFT, span.end, timeline.total);
            loops.animate(&class, &keys, [0.01], opacity);
            svg.open_shown(&class, 0.0);
            strokes::arrow(svg, view, self.motion, k);
            svg.close();
        }
    }

    /// A ring that runs away from the goal when it is reached.
    fn reached(&self, svg: &mut Svg, loops: &mut Keyframes, view: &View, timeline: &Timeline) {
        if !self.good() {
            return;
        }
        let rest = timeline.rest();
        let key = |at: f64, size: f64, shown: f64| Key { at, value: [size, shown] };
        let keys = [
            key(0.0, 1.0, 0.0),
            key(rest, 1.0, 0.0),
            key(rest + 0.05, 1.0, 0.9),
            key(rest + 0.9, 3.0, 0.0),
            key(timeline.total, 3.0, 0.0),
        ];
        loops.animate("ring", &keys, [0.01; 2], |[size, shown]| {
            format!("transform:scale({});opacity:{}", short(size, 2), short(shown, 2))
        });
        svg.open_moved("goal", view.map(self.goal.position), 0.0);
        svg.open_shown("ring", 0.0);
        let radius = view.length(self.goal.tolerance).max(14.0);
        svg.circle(Vector::zeros(), radius, Style::stroke(palette::GOOD, 2.5));
        svg.close();
        svg.close();
    }

    /// How much of the motion is over, below the plot.
    fn progress(&self, svg: &mut Svg, loops: &mut Keyframes, view: &View, timeline: &Timeline) {
        let corner = view.corner + Vector::new(0.0, view.size.y);
        let size = Vector::new(view.size.x, 4.0);
        svg.rect(corner, size, 0.0, Style::fill("#e9ecef"));
        let keys = [(0.0, 0.0), (timeline.rest(), 1.0), (timeline.total, 1.0)];
        let keys = keys.map(|(at, share)| Key { at, value: [share] });
        loops.animate("bar", &keys, [1e-4], |[share]| format!("transform:scaleX({})", short(share, 3)));
        svg.open_moved("place", corner, 0.0);
        svg.open_moved("bar", Vector::zeros(), 0.0);
        svg.rect(Vector::zeros(), size, 0.0, Style::fill(palette::SPATIAL));
        svg.close();
        svg.close();
    }

    /// What happens now.
    fn captions(&self, svg: &mut Svg, loops: &mut Keyframes, at: Vector, timeline: &Timeline) {
        let name = self.scene.objects.get(self.goal.object).map_or("object", |object| &object.name);
        let goal = millimetres(self.goal.tolerance);
        let mut captions = vec![(0.0, format!("{name} must come within {goal} of the goal"))];
        let count = self.motion.strokes.len();
        for (k, (span, stroke)) in timeline.strokes.iter().zip(&self.motion.strokes).enumerate() {
            let (length, speed) = (stroke.travel(), stroke.travel() / stroke.duration);
            let words = format!("push {} of {count}: {} at {speed:.2} m/s", k + 1, millimetres(length));
            captions.push((span.start - LIFT, words));
        }
        let ends: Vec<f64> = captions.iter().skip(1).map(|caption| caption.0).collect();
        for (k, (since, words)) in captions.iter().enumerate() {
            let until = ends.get(k).copied().unwrap_or(timeline.rest());
            let class = format!("c{k}");
            loops.animate(&class, &shown_between(*since, until, timeline.total), [0.01], opacity);
            svg.open_shown(&class, 0.0);
            svg.text(at, words, CAPTION);
            svg.close();
        }
        let keys = shown_between(timeline.rest(), timeline.total, timeline.total);
        loops.animate("end", &keys, [0.01], opacity);
        svg.open_shown("end", 1.0);
        self.ending(svg, at);
        svg.close();
    }

    fn ending(&self, svg: &mut Svg, at: Vector) {
        let Some(last) = self.trajectory.frames.last() else { return };
        let error = millimetres(self.goal.error(&last.state));
        let good = self.good();
        let colour = if good { palette::GOOD } else { palette::BAD };
        let centre = at + Vector::new(8.0, -5.0);
        svg.circle(centre, 8.0, Style::fill(colour));
        let mark: &[[f64; 2]] = match good {
            true => &[[-3.6, 0.2], [-1.2, 2.8], [3.8, -2.6]],
            false => &[[-3.0, -3.0], [3.0, 3.0], [0.0, 0.0], [-3.0, 3.0], [3.0, -3.0]],
        };
        let mark: Vec<Vector> = mark.iter().map(|[x, y]| centre + Vector::new(*x, *y)).collect();
        svg.polyline(&mark, Style::stroke("#ffffff", 2.0));
        let allowed = millimetres(self.goal.tolerance);
        let words = match good {
            true => format!("reached: at rest {error} from the goal"),
            false => format!("missed: {error} from the goal, allowed are {allowed}"),
        };
        svg.text(at + Vector::new(24.0, 0.0), &words, Font { colour, ..CAPTION });
    }

    fn good(&self) -> bool {
        let Some(last) = self.trajectory.frames.last() else { return false };
        let sound = self.trajectory.warnings.iter().all(|warning| !warning.forbids_success());
        sound && self.goal.reached(&last.state)
    }

    /// The frames that can be drawn.
    fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.trajectory.frames.iter().filter(|frame| frame.state.is_finite())
    }

    /// Where the objects end.
    fn ends(&self) -> Vec<Pose> {
        let start = || self.scene.objects.iter().map(|object| object.pose).collect();
        self.frames().last().map_or_else(start, |frame| frame.state.poses.clone())
    }

    /// A value of every frame; what stands still while the tool is lifted is said at both ends.
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
            scene: self.scene,
            goal: Some(self.goal),
            robot: Some(self.robot),
            motion: Some(self.motion),
            trajectories: vec![self.trajectory],
        }
    }

    fn entries(&self) -> Vec<(Sample, String)> {
        let tolerance = format!("goal, tolerance {}", millimetres(self.goal.tolerance));
        let tool = Style::fill(palette::TOOL_FILL).outlined(palette::TOOL, 1.4);
        let mut entries = vec![
            (Sample::Area(palette::GOAL_OBJECT), "object to move".to_owned()),
            (Sample::Ring(palette::GOAL_RIM), tolerance),
            (Sample::Area(tool), self.motion.tool.name.clone()),
        ];
        for (symbol, words) in Symbol::ALL {
            if self.scene.joints.iter().any(|joint| Symbol::of(joint) == symbol) {
                entries.push((Sample::Joint(symbol), words.to_owned()));
            }
        }
        let reach = "reach of the end effector".to_owned();
        entries.push((Sample::Ring(palette::REACH_RIM), reach));
        entries
    }
}

/// How fast the motion is shown.
fn shown_as(rate: f64) -> String {
    match rate {
        1.0 => "in real time".to_owned(),
        rate => format!("{rate:.0} times as fast as in reality"),
    }
}

fn shift([x, y]: [f64; 2]) -> String {
    format!("transform:translate({}px,{}px)", short(x, 1), short(y, 1))
}

fn turn([degrees]: [f64; 1]) -> String {
    format!("transform:rotate({}deg)", short(degrees, 1))
}

fn opacity([shown]: [f64; 1]) -> String {
    format!("opacity:{}", short(shown, 2))
}

/// Degrees clockwise on the page, whose y points down.
fn clockwise(pose: &Pose) -> f64 {
    -pose.heading.to_degrees()
}

/// In at the start of the loop and out at its end.
fn fade(timeline: &Timeline) -> [Key<1>; 4] {
    let total = timeline.total;
    [(0.0, 0.0), (FADE, 1.0), (total - FADE, 1.0), (total, 0.0)]
        .map(|(at, shown)| Key { at, value: [shown] })
}

/// Seen from `since` to `until`, with soft edges inside.
fn shown_between(since: f64, until: f64, total: f64) -> [Key<1>; 6] {
    let edge = 0.15;
    [
        (0.0, 0.0),
        (since, 0.0),
        (since + edge, 1.0),
        (until - edge, 1.0),
        (until, 0.0),
        (total, 0.0),
    ]
    .map(|(at, shown)| Key { at, value: [shown] })
}
