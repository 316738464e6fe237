//! Demand: an object points along a heading.
//!
//! Headings at which the object looks the same are equivalent. If a joint with limits holds the
//! object, the rotation is measured within the limits, possibly along the longer way.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector, wrap_angle};
use crate::scene::{Scene, Span};

use super::check::name;
use super::words::degrees;
use super::{Check, Demand, End, Kind, Mark, Quantity, less};

/// A heading of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Facing {
    /// Wanted heading, radians.
    pub heading: f64,
    /// Maximum rotation from it, radians.
    pub tolerance: f64,
    /// Middle of the headings within a joint's limits, radians; headings are unwrapped to the
    /// nearest one to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit_middle: Option<f64>,
    /// Number of equivalent headings in a full turn; 1 if only the heading itself counts.
    pub symmetry: usize,
    /// Index of the object in whose frame the heading is; `None` for the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative: Option<usize>,
}

impl Facing {
    /// Creates a demand on a heading with a tolerance, radians.
    pub fn new(heading: f64, tolerance: f64) -> Self {
        Self { heading, tolerance, limit_middle: None, symmetry: 1, relative: None }
    }

    /// Reduces a rotation to the nearest equivalent heading, radians.
    pub fn least_turn(&self, turn: f64) -> f64 {
        let alike = self.symmetry as f64;
        wrap_angle(turn * alike) / alike
    }

    /// Applies the limits of the joint that holds `object` in `scene`, to the world or to the
    /// object to which the heading is relative.
    pub(in crate::task) fn limit(&mut self, object: usize, scene: &Scene) {
        let middle = |span: Span| 0.5 * (span.low + span.high);
        let start = |object: usize| scene.objects.get(object).map(|object| object.pose.heading);
        let of = |object: usize| start(object).unwrap_or_default();
        let middle = match self.relative {
            None => {
                let mount = scene.mounts.iter().find(|mount| mount.object == object);
                let turns = mount.and_then(|mount| mount.kind.turns());
                turns.map(|span| of(object) + middle(span))
            }
            Some(other) => scene.joints.iter().find_map(|joint| {
                // Joints measure the rotation of the second object against the first.
                let sign = match joint.between {
                    [first, second] if [first, second] == [other, object] => 1.0,
                    [first, second] if [first, second] == [object, other] => -1.0,
                    _ => return None,
                };
                let start = of(object) - of(other);
                Some(start + sign * middle(joint.kind.turns()?))
            }),
        };
        let Some(middle) = middle else { return };
        let off = self.heading - middle;
        if off.abs() > PI {
            self.heading = middle + wrap_angle(off);
        }
        self.limit_middle = Some(middle);
    }

    pub(super) fn in_frame(&self, frame: &Pose) -> Self {
        Self {
            heading: frame.heading + self.heading,
            limit_middle: self.limit_middle.map(|middle| frame.heading + middle),
            relative: None,
            ..self.clone()
        }
    }
}

impl Kind for Facing {
    fn demand(&self) -> Demand {
        Demand::Heading(self.clone())
    }

    fn is_met(&self, end: &End) -> bool {
        self.turned(end).is_some_and(|turn| turn.abs() <= self.tolerance)
    }

    fn words(&self, object: usize, scene: &Scene) -> String {
        let alike = match self.symmetry {
            1 => String::new(),
            alike => format!(", or any of {alike} equivalent headings"),
        };
        let start = scene.start();
        let by = self.limit_middle.and_then(|_| self.turned(&End::resting(object, &start)));
        let by = by.map_or(String::new(), |turn| format!(", a rotation by {}", degrees(-turn)));
        let [heading, within] = [self.heading, self.tolerance].map(degrees);
        format!("heading {heading} \u{00b1} {within}{alike}{by}")
    }

    fn turned(&self, end: &End) -> Option<f64> {
        let frame = self.relative.and_then(|other| end.state.poses.get(other));
        let own = frame.map_or_else(|| self.clone(), |frame| self.in_frame(frame));
        let turn = own.least_turn(end.pose().heading - own.heading);
        let Some(middle) = own.limit_middle else { return Some(turn) };
        // The rotation within the limits.
        let from_middle = own.heading + turn - middle;
        Some(turn + (wrap_angle(from_middle) - from_middle))
    }

    fn facing(&self) -> Option<&Facing> {
        Some(self)
    }

    fn stricter(&self, _: f64, turn: f64) -> Demand {
        Demand::Heading(Self { tolerance: less(self.tolerance, turn), ..self.clone() })
    }

    fn aimed(&self, aim: &Demand, _: Vector, turn: f64) -> Demand {
        let last = aim.kind().facing().map_or(self.heading, |last| last.heading);
        Demand::Heading(Self { heading: last - turn, ..self.clone() })
    }

    fn seen_from(&self, frame: &Pose) -> Demand {
        Demand::Heading(self.in_frame(frame))
    }

    fn relative_to(&self, other: usize) -> Demand {
        Demand::Heading(Self { relative: Some(other), ..self.clone() })
    }

    fn relative(&self) -> Option<usize> {
        self.relative
    }

    fn fault(&self, _: usize, _: &Scene) -> Option<String> {
        let sound = self.symmetry > 0
            && self.heading.is_finite()
            && self.limit_middle.is_none_or(f64::is_finite)
            && self.tolerance.is_finite()
            && self.tolerance > 0.0;
        (!sound).then(|| "the goal must be finite and its heading tolerance positive".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let quantity = Quantity::Turn {
            object: name(object, scene),
            frame: self.relative.map(|other| name(other, scene)),
            heading: self.heading,
            symmetry: self.symmetry,
            middle: self.limit_middle,
        };
        Check::up_to(quantity, self.tolerance)
    }

    fn marks(&self, object: usize, scene: &Scene) -> Vec<Mark> {
        let Self { heading, tolerance, limit_middle, symmetry, .. } = *self;
        let swing = self.swing(object, scene);
        vec![Mark::Headings { heading, tolerance, limit_middle, symmetry, swing }]
    }
}
