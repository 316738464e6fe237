//! The complete scene picture: title, plot, legend.

use std::fmt;

use crate::svg::{Font, Style, Svg};
use pushplan::geometry::{Pose, Vector};
use pushplan::{
    outcome::Trajectory,
    scene::{Annulus, Engine, Scene},
    task::{Mark, ShownGoal, ToolMotion},
};

use super::{
    bodies,
    extent::Extent,
    joints::{self, Symbol},
    legend::{self, Sample},
    palette, strokes,
    view::View,
};

/// Margins left and right of the plot, pixels; the left one holds the axis numbers.
const LEFT: f64 = 46.0;
const RIGHT: f64 = 16.0;

/// Source of an object's path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Effect model that chose the plan.
    Predicted,
    /// Replay in an engine.
    Simulated(Engine),
    /// Observer.
    Seen,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Source::Predicted => "predicted",
            Source::Seen => "observed",
            Source::Simulated(Engine::Planar) => "simulated in 2-D",
            Source::Simulated(Engine::Spatial) => "simulated in 3-D",
            Source::Simulated(Engine::Upright) => "simulated in 3-D, upright",
        })
    }
}

/// Paths of the objects from one source.
#[derive(Clone, Copy, Debug)]
pub struct Track<'a> {
    /// Source of the trajectory.
    pub source: Source,
    /// Trajectory; a single frame is enough to show the final poses.
    pub trajectory: &'a Trajectory,
}

/// Content of a scene picture. Only the scene is required.
#[derive(Clone, Debug)]
pub struct ScenePicture<'a> {
    /// Title, bold.
    pub title: String,
    /// Lines below the title.
    pub notes: Vec<String>,
    /// Scene with objects at their start, and obstacles.
    pub scene: &'a Scene,
    /// Goals, whose objects are highlighted.
    pub goals: Vec<ShownGoal>,
    /// Annulus within reach of the robot.
    pub reach: Option<Annulus>,
    /// Motions drawn as tool outlines and push arrows.
    pub motions: &'a [ToolMotion],
    /// Paths and ends of the objects; later ones are drawn over earlier ones.
    pub tracks: Vec<Track<'a>>,
}

impl ScenePicture<'_> {
    /// Returns the picture as an SVG document.
    pub fn to_svg(&self) -> String {
        let mut view = View::fit(self.extent().bounds(), Vector::new(LEFT, 0.0));
        let notes: Vec<String> =
            self.notes.iter().flat_map(|note| palette::NOTE.wrap(note, view.size.x)).collect();
        let top = 40.0 + 18.0 * notes.len() as f64;
        view.corner.y = top;
        let entries = self.entries();
        let width = LEFT + view.size.x + RIGHT;
        let below = top + view.size.y + 28.0;
        let height = below + legend::height(&entries, view.size.x) + 10.0;

        let mut svg = Svg::new(width, height, &self.title);
        svg.define(palette::HATCH);
        svg.text(Vector::new(LEFT, 27.0), &self.title, Font::new(16.0, palette::INK).bold());
        for (k, note) in notes.iter().enumerate() {
            let at = Vector::new(LEFT, 46.0 + 18.0 * k as f64);
            svg.text(at, note, palette::NOTE);
        }
        svg.rect(view.corner, view.size, 0.0, palette::PLOT);
        self.plot(&mut svg, &view);
        legend::draw(&mut svg, &entries, Vector::new(LEFT, below), view.size.x);
        svg.finish()
    }

    fn extent(&self) -> Extent<'_> {
        Extent {
            scene: self.scene,
            goals: self.goals.clone(),
            reach: self.reach,
            motions: self.motions,
            trajectories: self.tracks.iter().map(|track| track.trajectory).collect(),
        }
    }

    fn plot(&self, svg: &mut Svg, view: &View) {
        if let Some(reach) = &self.reach {
            svg.open_clipped("table", view.corner, view.size);
            bodies::reach(svg, view, reach);
            svg.close();
        }
        view.grid(svg);
        svg.open_clipped("plot", view.corner, view.size);
        for goal in &self.goals {
            bodies::goal_area(svg, view, goal);
        }
        bodies::fixed(svg, view, self.scene);
        let made = strokes::all(self.motions);
        strokes::tool(svg, view, &made);
        // Objects are drawn over the tool, which often ends where the object started.
        for (k, object) in self.scene.objects.iter().enumerate() {
            bodies::object(svg, view, object, self.is_goal(k));
        }
        let start: Vec<Pose> = self.scene.objects.iter().map(|object| object.pose).collect();
        for joint in joints::between_things(self.scene) {
            joints::joint(svg, view, &self.scene.objects, joint, &start, palette::INK);
        }
        for goal in &self.goals {
            bodies::goal(svg, view, goal);
        }
        for track in &self.tracks {
            self.track(svg, view, track);
        }
        strokes::pushes(svg, view, &made);
        for (_, object) in self.scene.things() {
            bodies::name(svg, view, &object.name, &object.shape, &object.pose);
        }
        bodies::overhead(svg, view, self.scene);
        bodies::names_of_fixed(svg, view, self.scene);
        view.scale_bar(svg);
        svg.close();
    }

    fn track(&self, svg: &mut Svg, view: &View, track: &Track) {
        let Some(last) = track.trajectory.frames.last() else { return };
        let style = style(track.source);
        let mut drawn = vec![false; self.scene.objects.len()];
        for (k, (object, end)) in self.scene.objects.iter().zip(&last.state.poses).enumerate() {
            if !bodies::moved(object, end) {
                continue;
            }
            drawn[k] = true;
            strokes::path(svg, view, track.trajectory, k, style);
            bodies::final_object(svg, view, object, end, style);
            let own = |goal: &&ShownGoal| goal.objects.contains(&k);
            if let Some(goal) = self.goals.iter().find(own) {
                bodies::miss(svg, view, goal, end.position);
            }
        }
        let (objects, ends) = (&self.scene.objects, &last.state.poses);
        for joint in joints::between_things(self.scene) {
            let [first, second] = joint.between;
            let finite = ends[first].is_finite() && ends[second].is_finite();
            if finite && (drawn[first] || drawn[second]) {
                joints::joint(svg, view, objects, joint, ends, colour(track.source));
            }
        }
    }

    fn is_goal(&self, object: usize) -> bool {
        let thing = self.scene.thing(object);
        self.goals.iter().any(|goal| goal.objects.contains(&thing))
    }

    fn entries(&self) -> Vec<(Sample, String)> {
        let mut entries = Vec::new();
        let mut add = |sample, words: String| entries.push((sample, words));
        if !self.goals.is_empty() {
            add(Sample::Area(palette::GOAL_OBJECT), "object to move, at the start".to_owned());
        }
        if (0..self.scene.objects.len()).any(|k| !self.is_goal(k)) {
            add(Sample::Area(palette::OTHER_OBJECT), "other object, at the start".to_owned());
        }
        for (symbol, words) in Symbol::ALL {
            if joints::between_things(self.scene).any(|joint| Symbol::of(joint) == symbol) {
                add(Sample::Joint(symbol), words.to_owned());
            }
        }
        for track in &self.tracks {
            let words = match track.source {
                Source::Predicted => "predicted path and end",
                Source::Seen => "observed",
                Source::Simulated(Engine::Planar) => "simulated, 2-D",
                Source::Simulated(Engine::Spatial) => "simulated, 3-D",
                Source::Simulated(Engine::Upright) => "simulated, 3-D, upright",
            };
            add(Sample::Way(style(track.source)), words.to_owned());
        }
        if let Some(goal) = self.goals.first() {
            let words = goal.marks.iter().map(|mark| match mark {
                Mark::Disc { radius, .. } => format!(", tolerance {:.0} mm", radius * 1e3),
                Mark::Band { from, to, .. } if *from > 0.0 => {
                    format!(", gap of {:.0} to {:.0} mm", from * 1e3, to * 1e3)
                }
                Mark::Band { to, .. } => format!(", gap of at most {:.0} mm", to * 1e3),
                Mark::Headings { tolerance, .. } => {
                    format!(", \u{00b1}{:.0}\u{00b0}", tolerance.to_degrees())
                }
                _ => String::new(),
            });
            let words = format!("goal{}", words.collect::<String>());
            add(Sample::Ring(palette::GOAL_RIM), words);
        }
        if !self.motions.is_empty() {
            let name = strokes::tools(self.motions);
            let look = Style::fill(palette::TOOL_FILL).outlined(palette::TOOL, 1.4);
            let words = format!("{name} before a push");
            add(Sample::Area(look.opacity(palette::TOOL_BEFORE)), words);
            add(Sample::Area(look.opacity(palette::TOOL_AFTER)), format!("{name} after it"));
            add(Sample::Push, "push of the end effector".to_owned());
        }
        bodies::legend_of_fixed(self.scene).for_each(|(sample, words)| add(sample, words));
        if let Some(Annulus { radii: [near, far], .. }) = self.reach {
            let words = format!("reach, {near:.2} to {far:.2} m");
            add(Sample::Ring(palette::REACH_RIM), words);
        }
        entries
    }
}

fn style(source: Source) -> Style {
    let colour = colour(source);
    match source {
        Source::Predicted => Style::stroke(colour, 2.0).dashed("6 4"),
        Source::Seen | Source::Simulated(Engine::Planar) => Style::stroke(colour, 2.0),
        Source::Simulated(Engine::Spatial | Engine::Upright) => {
            Style::stroke(colour, 1.6).dashed("2 3")
        }
    }
}

fn colour(source: Source) -> &'static str {
    match source {
        Source::Predicted => palette::PREDICTED,
        Source::Seen | Source::Simulated(Engine::Planar) => palette::PLANAR,
        Source::Simulated(Engine::Spatial | Engine::Upright) => palette::SPATIAL,
    }
}

#[cfg(test)]
mod tests;
