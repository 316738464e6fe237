//! The solids that objects and tool parts are made of, and their planar footprints.

use serde::{Deserialize, Serialize};

use super::{ConvexPolygon, Vector};

/// A solid standing on the table, its axis vertical. Full extents in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// An upright cylinder.
    Cylinder {
        /// Radius, metres.
        radius: f64,
        /// Height, metres.
        height: f64,
    },
    /// A cuboid with its faces along its own axes.
    Cuboid {
        /// Full extents along x, y and z, metres.
        size: [f64; 3],
    },
    /// An upright prism on a convex polygon.
    Prism {
        /// What it covers on the table, metres.
        base: ConvexPolygon,
        /// Height, metres.
        height: f64,
    },
}

impl Shape {
    /// What the solid covers on the table.
    pub fn footprint(&self) -> Footprint {
        match *self {
            Shape::Cylinder { radius, .. } => Footprint::Disc { radius },
            Shape::Cuboid { size } => {
                Footprint::Rectangle { half: Vector::new(size[0] / 2.0, size[1] / 2.0) }
            }
            Shape::Prism { base, .. } => Footprint::Polygon(base),
        }
    }

    /// Vertical extent, metres.
    pub fn height(&self) -> f64 {
        match *self {
            Shape::Cylinder { height, .. } | Shape::Prism { height, .. } => height,
            Shape::Cuboid { size } => size[2],
        }
    }

    /// Whether this is a cylinder, whose heading cannot be seen.
    pub fn is_cylinder(&self) -> bool {
        matches!(self, Shape::Cylinder { .. })
    }
}

/// A convex planar shape about its own origin, the centre of mass of what stands on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Footprint {
    /// A disc.
    Disc {
        /// Radius, metres.
        radius: f64,
    },
    /// A rectangle with its sides along its own axes.
    Rectangle {
        /// Half extents, metres.
        half: Vector,
    },
    /// Any other convex polygon.
    Polygon(ConvexPolygon),
}

impl Footprint {
    /// Area, square metres.
    pub fn area(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => std::f64::consts::PI * radius * radius,
            Footprint::Rectangle { half } => 4.0 * half.x * half.y,
            Footprint::Polygon(polygon) => polygon.area(),
        }
    }

    /// Radius of the smallest circle about the origin that holds the shape, metres.
    pub fn bounding_radius(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => radius,
            Footprint::Rectangle { half } => half.norm(),
            Footprint::Polygon(polygon) => polygon.bounding_radius(),
        }
    }

    /// Radius of the largest circle about the origin inside the shape, metres.
    pub fn inner_radius(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => radius,
            Footprint::Rectangle { half } => half.x.min(half.y),
            Footprint::Polygon(polygon) => polygon.inner_radius(),
        }
    }

    /// Radius of gyration about the vertical through the centre, metres: I = m rho^2.
    ///
    /// That of an even plate; where a polygon's centre of mass is not its centroid, of an even
    /// plate that turns about it.
    pub fn gyration_radius(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => radius / std::f64::consts::SQRT_2,
            Footprint::Rectangle { half } => (half.norm_squared() / 3.0).sqrt(),
            Footprint::Polygon(polygon) => {
                let [xx, _, yy] = polygon.second_moments();
                (xx + yy).sqrt()
            }
        }
    }

    /// Mean distance of the shape's points from its centre, metres.
    ///
    /// With pressure spread evenly this is the ratio of the largest friction torque to the
    /// largest friction force of the support, the length `c` of the ellipsoidal limit surface
    /// (Goyal, Ruina and Papadopoulos 1991; Lynch and Howe 1992).
    pub fn mean_radius(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => 2.0 * radius / 3.0,
            Footprint::Rectangle { half } => {
                let (a, b) = (2.0 * half.x, 2.0 * half.y);
                let d = a.hypot(b);
                (2.0 * d + a * a / b * ((b + d) / a).ln() + b * b / a * ((a + d) / b).ln()) / 12.0
            }
            Footprint::Polygon(polygon) => polygon.mean_radius(),
        }
    }

    /// The same shape grown by `margin` metres on every side (corners stay corners).
    pub fn grown(&self, margin: f64) -> Footprint {
        match *self {
            Footprint::Disc { radius } => Footprint::Disc { radius: radius + margin },
            Footprint::Rectangle { half } => {
                Footprint::Rectangle { half: half + Vector::new(margin, margin) }
            }
            Footprint::Polygon(polygon) => Footprint::Polygon(polygon.grown(margin)),
        }
    }

    /// The same shape smaller by `margin` metres on every side, but by no more than half its
    /// smallest half extent.
    pub fn shrunk(&self, margin: f64) -> Footprint {
        self.grown(-margin.min(0.5 * self.inner_radius()))
    }

    /// How far the shape reaches from its centre along the unit vector `direction`, given in the
    /// shape's own frame: the support function, metres.
    pub fn extent(&self, direction: Vector) -> f64 {
        match *self {
            Footprint::Disc { radius } => radius,
            Footprint::Rectangle { half } => {
                half.x * direction.x.abs() + half.y * direction.y.abs()
            }
            Footprint::Polygon(polygon) => polygon.extent(direction),
        }
    }

    /// Into how many equal turns a full turn falls after each of which the shape looks the same;
    /// `None` for a disc, which always does.
    pub fn symmetry(&self) -> Option<usize> {
        match *self {
            Footprint::Disc { .. } => None,
            Footprint::Rectangle { half } => {
                let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
                let corners = corners.map(|(x, y)| Vector::new(x * half.x, y * half.y));
                // Too thin for a polygon, so not a square.
                Some(ConvexPolygon::new(&corners).map_or(2, |polygon| polygon.symmetry()))
            }
            Footprint::Polygon(polygon) => Some(polygon.symmetry()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_radius_agrees_with_a_fine_sum() {
        let shape = Footprint::Rectangle { half: Vector::new(0.05, 0.02) };
        let n = 1000;
        let sum: f64 = (0..n * n)
            .map(|k| {
                let x = ((k % n) as f64 + 0.5) / n as f64 * 0.1 - 0.05;
                let y = ((k / n) as f64 + 0.5) / n as f64 * 0.04 - 0.02;
                x.hypot(y)
            })
            .sum();
        assert!((shape.mean_radius() - sum / (n * n) as f64).abs() < 1e-7);
    }
}
