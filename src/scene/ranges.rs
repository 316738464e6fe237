//! The ranges of physical quantities for which a model was trained or measured, so that a rollout
//! outside them can be reported.

use super::Span;
use serde::{Deserialize, Serialize};

use crate::geometry::{ConvexPolygon, Vector};

/// Sliding distance of an object released at the speed of the push in nearly all training pushes,
/// metres (all but 11 of 2000: the fastest pushes on the smoothest tables are rare).
///
/// Beyond it, errors exceed three times the errors of ordinary pushes
/// (`crates/lab/results/extremes.md`, corners).
pub const TRAINED_SLIDE: f64 = 0.020;

/// Maximum rotation of the tool in training for each metre of travel, rad/m: a blade that rotates
/// about one of its tips while it pushes.
pub const TRAINED_TURN: f64 = 20.0;

/// Maximum deviation of a corner from a right angle, radians: training draws corners of any angle,
/// down to about five degrees.
pub const TRAINED_SLANT: f64 = 1.5;

/// Maximum distance of a centre of mass from the centroid, metres; in data sets they coincide.
pub const TRAINED_IMBALANCE: f64 = 1e-3;

/// Ranges of the scenes and motions of a data set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ranges {
    /// Number of movable objects.
    pub objects: Span,
    /// Mass of an object, kg.
    pub mass: Span,
    /// Largest ratio of two masses in one scene.
    pub mass_ratio: f64,
    /// Friction values of objects, tools and the table.
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
    /// Sliding distance v^2 / (2 mu g) of an object released at the speed of the push, metres.
    pub slide: f64,
    /// Rotation of the tool for each metre of travel, rad/m.
    pub turn: f64,
    /// Travel of a push, metres.
    pub travel: Span,
    /// Number of consecutive pushes.
    pub pushes: Span,
}

impl Ranges {
    /// Returns the smallest ranges that contain both.
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

    /// Returns the first invalid bound with the name of its range: not finite, or on the wrong side
    /// of the other bound.
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
}

/// Returns the largest deviation of a corner from a right angle, radians.
pub fn slant(base: &ConvexPolygon) -> f64 {
    let normals: Vec<Vector> = base.faces().map(|(_, normal)| normal).collect();
    let next = normals.iter().cycle().skip(1);
    normals.iter().zip(next).map(|(a, b)| a.dot(b).abs().asin()).fold(0.0, f64::max)
}
