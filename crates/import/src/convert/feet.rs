//! Small spheres under a solid, which represent its support points.

use pushplan::geometry::{Footprint, Vector};
use pushplan::scene::Support;

/// Distance below which two points coincide, metres.
const SAME: f64 = 1e-6;

/// Maximum number of support points in a task file.
const MOST: usize = 8;

/// Returns the support model of an object with this footprint that rests on `points`, metres in its
/// own frame; `None` if there are too many points to state.
pub(super) fn support(points: &[Vector], footprint: &Footprint) -> Option<Support> {
    let like = |support: &Support| {
        let feet = support.feet(footprint);
        let near = |foot: Vector| points.iter().any(|point| (point - foot).norm() <= SAME);
        feet.count == points.len() && feet.each().all(|(foot, _)| near(foot))
    };
    match points {
        [] => Some(Support::Even),
        _ if like(&Support::Even) => Some(Support::Even),
        _ if like(&Support::Corners) => Some(Support::Corners),
        _ if (3..=MOST).contains(&points.len()) => Some(Support::Points(points.to_vec())),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_stand_for_a_word_become_it() {
        let footprint = Footprint::Rectangle { half: Vector::new(0.04, 0.03) };
        for word in [Support::Even, Support::Corners] {
            let points: Vec<Vector> =
                word.feet(&footprint).each().map(|(point, _)| point).collect();
            assert_eq!(support(&points, &footprint), Some(word));
        }
        let three = [[0.02, 0.0], [-0.01, 0.02], [-0.01, -0.02]].map(Vector::from);
        assert_eq!(support(&three, &footprint), Some(Support::Points(three.to_vec())));
        assert_eq!(support(&three[..2], &footprint), None);
        let many: Vec<Vector> = (0..9).map(|k| Vector::new(0.001 * f64::from(k), 0.0)).collect();
        assert_eq!(support(&many, &footprint), None);
    }
}
