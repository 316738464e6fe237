//! Shapes of objects and tool parts, and their planar footprints.

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
        /// Footprint on the table, metres.
        base: ConvexPolygon,
        /// Height, metres.
        height: f64,
    },
}

impl Shape {
    /// Returns the area that the solid covers on the table.
    pub fn footprint(&self) -> Footprint {
        match *self {
            Shape::Cylinder { radius, .. } => Footprint::Disc { radius },
            Shape::Cuboid { size } => {
                Footprint::Rectangle { half: Vector::new(size[0] / 2.0, size[1] / 2.0) }
            }
            Shape::Prism { base, .. } => Footprint::Polygon(base),
        }
    }

    /// Returns the vertical extent, metres.
    pub fn height(&self) -> f64 {
        match *self {
            Shape::Cylinder { height, .. } | Shape::Prism { height, .. } => height,
            Shape::Cuboid { size } => size[2],
        }
    }

    /// Returns `true` for a cylinder, whose heading is not observable.
    pub fn is_cylinder(&self) -> bool {
        matches!(self, Shape::Cylinder { .. })
    }
}

/// A convex planar shape about its own origin, the centre of mass of the body above it.
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
    /// Returns the area, square metres.
    pub fn area(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => std::f64::consts::PI * radius * radius,
            Footprint::Rectangle { half } => 4.0 * half.x * half.y,
            Footprint::Polygon(polygon) => polygon.area(),
        }
    }

    /// Returns the radius of the smallest circle about the origin that contains the shape, metres.
    pub fn bounding_radius(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => radius,
            Footprint::Rectangle { half } => half.norm(),
            Footprint::Polygon(polygon) => polygon.bounding_radius(),
        }
    }

    /// Returns the radius of the largest circle about the origin inside the shape, metres.
    pub fn inner_radius(&self) -> f64 {
        match *self {
            Footprint::Disc { radius } => radius,
            Footprint::Rectangle { half } => half.x.min(half.y),
            Footprint::Polygon(polygon) => polygon.inner_radius(),
        }
    }

    /// Returns the radius of gyration about the vertical through the centre, metres: I = m rho^2.
    ///
    /// Mass is spread evenly over the area. If a polygon's centre of mass is not its centroid, the
    /// radius is taken about the centre of mass.
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

    /// Returns the mean distance of the shape's points from its centre, metres.
    ///
    /// This is the length `c` of the ellipsoidal limit surface under uniform pressure: the ratio of
    /// the maximum friction torque to the maximum friction force of the support (Goyal, Ruina and
    /// Papadopoulos 1991; Lynch and Howe 1992).
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

    /// Returns the shape grown by `margin` metres on every side; corners are not rounded.
    pub fn grown(&self, margin: f64) -> Footprint {
        match *self {
            Footprint::Disc { radius } => Footprint::Disc { radius: radius + margin },
            Footprint::Rectangle { half } => {
                Footprint::Rectangle { half: half + Vector::new(margin, margin) }
            }
            Footprint::Polygon(polygon) => Footprint::Polygon(polygon.grown(margin)),
        }
    }

    /// Returns the shape shrunk by `margin` metres on every side, but at most by half its smallest
    /// half extent.
    pub fn shrunk(&self, margin: f64) -> Footprint {
        self.grown(-margin.min(0.5 * self.inner_radius()))
    }

    /// Returns the extent from the centre along the unit vector `direction` in the shape's own
    /// frame, metres (the support function).
    pub fn extent(&self, direction: Vector) -> f64 {
        match *self {
            Footprint::Disc { radius } => radius,
            Footprint::Rectangle { half } => {
                half.x * direction.x.abs() + half.y * direction.y.abs()
            }
            Footprint::Polygon(polygon) => polygon.extent(direction),
        }
    }

    /// Returns the order of rotational symmetry about the origin; `None` for a disc, which has
    /// every order.
    pub fn symmetry(&self) -> Option<usize> {
        match *self {
            Footprint::Disc { .. } => None,
            Footprint::Rectangle { half } => {
                let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
                let corners = corners.map(|(x, y)| Vector::new(x * half.x, y * half.y));
                // A rectangle too thin for a polygon is not a square.
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
