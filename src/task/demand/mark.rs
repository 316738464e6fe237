//! Marks of goals in drawings as plain data, so that exporters can draw them without the kinds of
//! demands.

use crate::geometry::Vector;

use super::Area;

/// A mark on the table, in world coordinates, metres and radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A disc in which a centre must lie.
    Disc {
        /// The wanted position.
        centre: Vector,
        /// The tolerance.
        radius: f64,
    },
    /// An area in which a centre must lie.
    Area(Area),
    /// An area that a centre must leave.
    Outside(Area),
    /// An outline that must be covered: convex polygons.
    Outline {
        /// The wanted position.
        centre: Vector,
        /// The polygons.
        pieces: Vec<Vec<Vector>>,
    },
    /// Headings about the wanted position.
    Headings {
        /// The wanted heading.
        heading: f64,
        /// The largest rotation from it.
        tolerance: f64,
        /// The middle of the headings within a joint's limits.
        limit_middle: Option<f64>,
        /// The number of equivalent headings.
        symmetry: usize,
        /// The way about a hinge, if one holds the object.
        swing: Option<Swing>,
    },
    /// A distance that must come within limits.
    Distance([Vector; 2]),
    /// Distances from another body within which an outline must come.
    Band {
        /// The other body: corners of convex polygons.
        pieces: Vec<Vec<Vector>>,
        /// Smallest distance.
        from: f64,
        /// Largest distance.
        to: f64,
    },
    /// A part of an edge of the table that must be crossed.
    Edge([Vector; 2]),
    /// A height above the table that an edge must reach.
    Height(f64),
}

/// The way of a hinged object's far end: an arc about the hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Position of the hinge, metres.
    pub hinge: Vector,
    /// Distance of the object's farthest corner from the hinge, metres.
    pub radius: f64,
    /// Angle of the object at the start, seen from the hinge, radians.
    pub from: f64,
    /// Wanted angle, radians; less than `from` for a clockwise way.
    pub to: f64,
}

impl Swing {
    /// Returns the wanted position of the far end, metres.
    pub fn end(&self) -> Vector {
        self.hinge + self.radius * Vector::new(self.to.cos(), self.to.sin())
    }
}

/// The marks of a goal.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownGoal {
    /// Indices of the objects that the goal may move, its own first.
    pub objects: Vec<usize>,
    /// Centre of the marks: a wanted position, or the position of the object at the start, metres.
    pub centre: Vector,
    /// Whether the centre is a wanted position.
    pub placed: bool,
    /// The marks.
    pub marks: Vec<Mark>,
}

impl Mark {
    /// Returns the position, metres, that a centre at `point` has missed.
    pub fn missed(&self, point: Vector) -> Option<Vector> {
        match self {
            Self::Disc { centre, radius } if (point - centre).norm() > *radius => Some(*centre),
            Self::Area(area) if !area.holds(point) => Some(area.nearest(point)),
            _ => None,
        }
    }
}
