//! The ranges of physical quantities for which a model was trained or measured, so that a job
//! outside them can be named.

use serde::{Deserialize, Serialize};

use crate::geometry::{ConvexPolygon, Shape, Vector, centroid};

use super::{GRAVITY, Job, Quantity, Scene, Stroke, Warning};

/// Values within this relative distance of a bound still count as inside: the speed of a recorded
/// push is known no better, and no model changes within one per cent.
const SLACK: f64 = 1e-2;

/// How far an object released at the speed of the push slides on in nearly all training pushes
/// (all but 11 of 2000: the fastest ones on the smoothest tables are rare), metres. Beyond it errors exceed
/// three times those of ordinary pushes (`crates/lab/results/extremes.md`, corners).
pub const TRAINED_SLIDE: f64 = 0.020;

/// Most that the tool turns in training for each metre of travel, rad/m: a blade that turns about one
/// of its tips while it pushes.
pub const TRAINED_TURN: f64 = 20.0;

/// How far a corner may be from a right angle, radians: training draws corners of any angle, down to
/// about five degrees.
pub const TRAINED_SLANT: f64 = 1.5;

/// How far a centre of mass may be from the centroid, metres: in data sets they are one.
pub const TRAINED_IMBALANCE: f64 = 1e-3;

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
}

impl Span {
    /// The empty interval; its ends are finite, so that it can be written down.
    pub const NOTHING: Self = Self { low: f64::MAX, high: f64::MIN };

    /// The interval from `low` to `high`.
    pub const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// How much there is between its ends.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }

    /// The smallest interval that contains both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether `value` lies inside, up to rounding.
    pub fn contains(&self, value: f64) -> bool {
        value >= self.low * (1.0 - SLACK) && value <= self.high * (1.0 + SLACK)
    }
}

/// What the scenes and motions of a data set cover.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ranges {
    /// Number of movable objects.
    pub objects: Span,
    /// Mass of an object, kg.
    pub mass: Span,
    /// Largest ratio of two masses in one scene.
    pub mass_ratio: f64,
    /// Friction values of objects, tools and the table alike.
    pub friction: Span,
    /// Radius of a cylinder, metres.
    pub radius: Span,
    /// Horizontal side of a cuboid object, metres.
    pub side: Span,
    /// Largest ratio of a cuboid object's horizontal sides.
    pub aspect: f64,
    /// Vertical extent of an object, metres.
    pub height: Span,
    /// Number of parts of a tool.
    pub parts: Span,
    /// Longer horizontal side of a tool part, metres.
    pub part_length: Span,
    /// Shorter horizontal side of a tool part, metres.
    pub part_width: Span,
    /// Radius of a round tool part, metres.
    pub part_radius: Span,
    /// Speed of a push, m/s.
    pub speed: Span,
    /// Distance v^2 / (2 mu g) that an object released at the speed of the push slides on,
    /// metres.
    pub slide: f64,
    /// Turn of the tool for each metre of travel, rad/m.
    pub turn: f64,
    /// Travel of a push, metres.
    pub travel: Span,
    /// Number of pushes one after another.
    pub pushes: Span,
}

impl Ranges {
    /// The smallest ranges that cover both.
    pub fn hull(&self, other: &Self) -> Self {
        Self {
            objects: self.objects.hull(other.objects),
            mass: self.mass.hull(other.mass),
            mass_ratio: self.mass_ratio.max(other.mass_ratio),
            friction: self.friction.hull(other.friction),
            radius: self.radius.hull(other.radius),
            side: self.side.hull(other.side),
            aspect: self.aspect.max(other.aspect),
            height: self.height.hull(other.height),
            parts: self.parts.hull(other.parts),
            part_length: self.part_length.hull(other.part_length),
            part_width: self.part_width.hull(other.part_width),
            part_radius: self.part_radius.hull(other.part_radius),
            speed: self.speed.hull(other.speed),
            slide: self.slide.max(other.slide),
            turn: self.turn.max(other.turn),
            travel: self.travel.hull(other.travel),
            pushes: self.pushes.hull(other.pushes),
        }
    }

    /// The first bound, by the name of its range, that no data set can have: not finite, or on the
    /// wrong side of the other one.
    pub fn unsound(&self) -> Option<(&'static str, f64)> {
        let Self { objects, mass, friction, radius, side, height, parts, .. } = self;
        let Self { part_length, part_width, part_radius, speed, travel, pushes, .. } = self;
        let most = |value: f64| Span::new(0.0, value);
        let spans = [
            ("objects", *objects),
            ("mass", *mass),
            ("mass_ratio", most(self.mass_ratio)),
            ("friction", *friction),
            ("radius", *radius),
            ("side", *side),
            ("aspect", most(self.aspect)),
            ("height", *height),
            ("parts", *parts),
            ("part_length", *part_length),
            ("part_width", *part_width),
            ("part_radius", *part_radius),
            ("speed", *speed),
            ("slide", most(self.slide)),
            ("turn", most(self.turn)),
            ("travel", *travel),
            ("pushes", *pushes),
        ];
        let sound = |span: Span| {
            let ends = span.low.is_finite() && span.high.is_finite();
            span == Span::NOTHING || (ends && 0.0 <= span.low && span.low <= span.high)
        };
        spans.into_iter().find(|(_, span)| !sound(*span)).map(|(name, span)| (name, span.low))
    }

    /// A warning for every quantity of the job that lies outside; travel and the number of pushes
    /// are left out, because a rollout is made of frames that look the same however many there
    /// are. Masses and frictions are those that the job's physics says.
    pub fn warnings(&self, scene: &Scene, job: &Job) -> Vec<Warning> {
        let all: Vec<usize> = (0..scene.objects.len()).collect();
        self.warnings_among(scene, job, &all)
    }

    /// [`Ranges::warnings`] with a look at these objects alone, indices in order.
    pub fn warnings_among(&self, scene: &Scene, job: &Job, objects: &[usize]) -> Vec<Warning> {
        let Job { motion, physics, .. } = job;
        let mut found = Vec::new();
        let mut check = |of: &dyn Fn() -> String, quantity: Quantity, value: f64, span: Span| {
            if !span.contains(value) {
                found.push(Warning::OutsideRange {
                    of: of(),
                    quantity,
                    // Files hold no infinite numbers.
                    value: value.min(f64::MAX),
                    low: span.low,
                    high: span.high,
                });
            }
        };
        let (whole, push) = (|| "scene".to_owned(), || "push".to_owned());
        // A thing of several solids weighs and counts once.
        let things: Vec<usize> =
            objects.iter().copied().filter(|&k| !scene.objects[k].is_part()).collect();
        if !things.is_empty() {
            check(&whole, Quantity::Objects, things.len() as f64, self.objects);
        }
        check(&|| "table".to_owned(), Quantity::Friction, physics.table_friction, self.friction);
        for &index in objects {
            let name = || scene.objects[index].name.clone();
            if !scene.objects[index].is_part() {
                check(&name, Quantity::Mass, scene.mass_in(physics, index), self.mass);
            }
            check(&name, Quantity::Friction, physics.frictions[index], self.friction);
            let shape = &scene.objects[index].shape;
            check(&name, Quantity::Height, shape.height(), self.height);
            match *shape {
                Shape::Cylinder { radius, .. } => {
                    check(&name, Quantity::Radius, radius, self.radius);
                }
                Shape::Cuboid { size: [x, y, _] } => {
                    check(&name, Quantity::SizeX, x, self.side);
                    check(&name, Quantity::SizeY, y, self.side);
                    let aspect = x.max(y) / x.min(y);
                    check(&name, Quantity::SideRatio, aspect, Span::new(1.0, self.aspect));
                }
                Shape::Prism { base, .. } => {
                    check(&name, Quantity::Slant, slant(&base), Span::new(0.0, TRAINED_SLANT));
                    let off = centroid(base.corners()).norm();
                    check(&name, Quantity::Imbalance, off, Span::new(0.0, TRAINED_IMBALANCE));
                    let across = |axis: Vector| base.extent(axis) + base.extent(-axis);
                    let [x, y] = [Vector::x(), Vector::y()].map(across);
                    check(&name, Quantity::SizeX, x, self.side);
                    check(&name, Quantity::SizeY, y, self.side);
                    let aspect = x.max(y) / x.min(y);
                    check(&name, Quantity::SideRatio, aspect, Span::new(1.0, self.aspect));
                }
            }
        }
        for pair in physics.pairs.iter().filter(|pair| objects.contains(&pair.object)) {
            let of = || format!("a pair of {}", scene.objects[pair.object].name);
            check(&of, Quantity::Friction, pair.coefficient, self.friction);
        }
        let masses = things.iter().map(|&thing| scene.mass_in(physics, thing));
        let heaviest = masses.clone().fold(0.0, f64::max);
        let lightest = masses.fold(f64::INFINITY, f64::min);
        if lightest > 0.0 && lightest.is_finite() {
            let ratio = heaviest / lightest;
            check(&whole, Quantity::MassRatio, ratio, Span::new(1.0, self.mass_ratio));
        }
        let tool = &motion.slide().tool;
        let name = || tool.name.clone();
        check(&name, Quantity::Friction, tool.friction, self.friction);
        check(&name, Quantity::Parts, tool.parts().len() as f64, self.parts);
        for part in tool.parts() {
            let of = || format!("{}/{}", tool.name, part.name);
            match part.shape {
                Shape::Cuboid { size: [x, y, _] } => {
                    check(&of, Quantity::Length, x.max(y), self.part_length);
                    check(&of, Quantity::Width, x.min(y), self.part_width);
                }
                Shape::Cylinder { radius, .. } => {
                    check(&of, Quantity::Radius, radius, self.part_radius);
                }
                Shape::Prism { base, .. } => {
                    check(&of, Quantity::Slant, slant(&base), Span::new(0.0, TRAINED_SLANT));
                    let across = |axis: Vector| base.extent(axis) + base.extent(-axis);
                    let [x, y] = [Vector::x(), Vector::y()].map(across);
                    check(&of, Quantity::Length, x.max(y), self.part_length);
                    check(&of, Quantity::Width, x.min(y), self.part_width);
                }
            }
        }
        let moving = || motion.slide().strokes.iter().filter(|stroke| stroke.duration > 0.0);
        let speed = |stroke: &Stroke| stroke.travel() / stroke.duration;
        if let Some(speed) = moving().map(speed).find(|speed| !self.speed.contains(*speed)) {
            check(&push, Quantity::Speed, speed, self.speed);
        }
        let fastest = moving().map(speed).fold(0.0, f64::max);
        let smoothest = objects.iter().map(|&index| physics.support_friction(index));
        let smoothest = smoothest.fold(f64::INFINITY, f64::min);
        if fastest > 0.0 {
            let slide = fastest * fastest / (2.0 * smoothest * GRAVITY);
            check(&push, Quantity::Slide, slide, Span::new(0.0, self.slide));
        }
        let turn = motion.slide().strokes.iter().map(turn_per_travel).fold(0.0, f64::max);
        check(&push, Quantity::Turn, turn, Span::new(0.0, self.turn));
        found
    }
}

/// How far the corner farthest from it is from a right angle, radians.
pub fn slant(base: &ConvexPolygon) -> f64 {
    let normals: Vec<Vector> = base.faces().map(|(_, normal)| normal).collect();
    let next = normals.iter().cycle().skip(1);
    normals.iter().zip(next).map(|(a, b)| a.dot(b).abs().asin()).fold(0.0, f64::max)
}

/// Radians per metre; infinite for a turn on the spot.
fn turn_per_travel(stroke: &Stroke) -> f64 {
    let turn = (stroke.to.heading - stroke.from.heading).abs();
    if turn > 0.0 { turn / stroke.travel() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_reached_by_division_or_measured_counts_as_inside() {
        let speed = Span::new(0.03, 0.3);
        assert!(speed.contains(0.2 / (0.2 / 0.3)) && speed.contains(0.1 / (0.1 / 0.03)));
        assert!(speed.contains(f64::from(0.03f32)) && speed.contains(0.029_98));
        assert!(!speed.contains(0.31) && !speed.contains(f64::NAN));
    }
}
