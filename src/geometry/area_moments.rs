//! Moments of planar areas, which add up over disjoint areas.

use std::ops::Add;

use super::{Footprint, Pose, Vector, centroid};

/// Integrals of 1, r and r r^T over an area. The moments of a body are the sum of the moments of
/// its parts, however the body is divided.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AreaMoments {
    /// Area, square metres.
    pub area: f64,
    /// First moments, cubic metres.
    pub first: Vector,
    /// Second moments xx, xy and yy, m^4.
    pub second: [f64; 3],
}

impl AreaMoments {
    /// Returns the moments of a posed footprint.
    pub fn of(footprint: &Footprint, pose: &Pose) -> Self {
        let area = footprint.area();
        let (middle, [xx, xy, yy]) = match footprint {
            Footprint::Disc { radius } => {
                let square = radius * radius / 4.0;
                (Vector::zeros(), [square, 0.0, square])
            }
            Footprint::Rectangle { half } => {
                (Vector::zeros(), [half.x * half.x / 3.0, 0.0, half.y * half.y / 3.0])
            }
            Footprint::Polygon(polygon) => (centroid(polygon.corners()), polygon.second_moments()),
        };
        // Covariance about the centroid, rotated and moved.
        let (sin, cos) = pose.heading.sin_cos();
        let (xx, xy, yy) =
            (xx - middle.x * middle.x, xy - middle.x * middle.y, yy - middle.y * middle.y);
        let at = pose.point(middle);
        let along = cos * cos * xx - 2.0 * sin * cos * xy + sin * sin * yy;
        let across = sin * sin * xx + 2.0 * sin * cos * xy + cos * cos * yy;
        let mixed = sin * cos * (xx - yy) + (cos * cos - sin * sin) * xy;
        let second = [along + at.x * at.x, mixed + at.x * at.y, across + at.y * at.y];
        Self { area, first: area * at, second: second.map(|mean| area * mean) }
    }

    /// Returns the centroid, metres.
    pub fn centre(&self) -> Vector {
        self.first / self.area
    }

    /// Returns the mean squares and products of the distances from the centroid along `axis` and to
    /// its left: along-along, along-across and across-across, square metres.
    pub fn spread(&self, axis: Vector) -> [f64; 3] {
        let centre = self.centre();
        let [xx, xy, yy] = self.second.map(|sum| sum / self.area);
        let (xx, xy, yy) =
            (xx - centre.x * centre.x, xy - centre.x * centre.y, yy - centre.y * centre.y);
        let (x, y) = (axis.x, axis.y);
        [
            x * x * xx + 2.0 * x * y * xy + y * y * yy,
            x * y * (yy - xx) + (x * x - y * y) * xy,
            y * y * xx - 2.0 * x * y * xy + x * x * yy,
        ]
    }
}

impl Add for AreaMoments {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            first: self.first + other.first,
            second: [0, 1, 2].map(|k| self.second[k] + other.second[k]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: AreaMoments, b: AreaMoments) {
        let numbers = |m: AreaMoments| [&[m.area, m.first.x, m.first.y][..], &m.second].concat();
        for (a, b) in numbers(a).iter().zip(numbers(b)) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn the_halves_of_a_rotated_bar_have_the_moments_of_the_bar() {
        let bar = |x: f64| Footprint::Rectangle { half: Vector::new(x, 0.03) };
        let pose = Pose::new(0.4, -0.2, 0.7);
        let piece = |x: f64| AreaMoments::of(&bar(0.1), &(pose * Pose::new(x, 0.0, 0.0)));
        near(piece(-0.1) + piece(0.1), AreaMoments::of(&bar(0.2), &pose));
    }

    #[test]
    fn the_spread_of_a_bar_is_the_variance_of_a_uniform_distribution() {
        let bar = Footprint::Rectangle { half: Vector::new(0.3, 0.03) };
        let moments = AreaMoments::of(&bar, &Pose::new(1.0, 2.0, 0.5));
        let [along, mixed, across] = moments.spread(Vector::new(0.5f64.cos(), 0.5f64.sin()));
        assert!((along - 0.03).abs() < 1e-12 && mixed.abs() < 1e-12);
        assert!((across - 0.0003).abs() < 1e-12);
    }
}
