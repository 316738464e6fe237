//! Unobservable properties of a scene: supports of objects and contact heights of tools.

use std::f64::consts::TAU;

use pushplan::internals::geometry::{Footprint, Shape, Vector};
use pushplan::internals::scene::{Ranges, Scene, Span, Support, carries};
use rand::Rng;
use rand_pcg::Pcg64;

use super::distributions::{log_uniform, uniform, weighted};

/// Probabilities of uniform support, of a spread support (see [`SPREAD`]), and of three support
/// points.
const SUPPORTS: [f64; 3] = [0.35, 0.40, 0.25];

/// Radius of spread supports relative to the corners' distance.
const SPREAD: Span = Span::new(0.4, 1.0);

/// Minimum share of the weight on one of three points; with less, objects tip at every contact.
const LEAST_LOAD: f64 = 0.1;

/// Draws the support of every object of `scene`.
pub(super) fn draw_supports(rng: &mut Pcg64, scene: &mut Scene) {
    for object in &mut scene.objects {
        object.support = match weighted(rng, &SUPPORTS) {
            0 => Support::Even,
            1 => Support::Spread(uniform(rng, SPREAD.low, SPREAD.high)),
            _ => three_points(rng, &object.shape.footprint()),
        };
    }
}

/// Draws new heights within the ranges for half of the objects of `scene`, so that plates and cans
/// occur.
pub(super) fn draw_heights(rng: &mut Pcg64, ranges: &Ranges, scene: &mut Scene) {
    for object in &mut scene.objects {
        let drawn = log_uniform(rng, ranges.height);
        if rng.random::<bool>() {
            match &mut object.shape {
                Shape::Cylinder { height, .. } | Shape::Prism { height, .. } => *height = drawn,
                Shape::Cuboid { size } => size[2] = drawn,
            }
        }
    }
}

/// Draws the contact height of the tool as a share of the mean height of faces.
pub(super) fn push_height(rng: &mut Pcg64) -> f64 {
    uniform(rng, 0.0, 1.0)
}

/// Draws three points that carry the object, each with sufficient load.
fn three_points(rng: &mut Pcg64, footprint: &Footprint) -> Support {
    loop {
        let points = [(); 3].map(|()| {
            let (sin, cos) = uniform(rng, 0.0, TAU).sin_cos();
            let far = uniform(rng, 0.3, 0.95);
            match *footprint {
                Footprint::Disc { radius } => far * radius * Vector::new(cos, sin),
                Footprint::Rectangle { half } => {
                    // The point is on a scaled rectangle of equal shape.
                    far * Vector::new(cos * half.x, sin * half.y) / cos.abs().max(sin.abs())
                }
                Footprint::Polygon(polygon) => {
                    let corners = polygon.corners();
                    let k = rng.random_range(0..corners.len());
                    let (from, to) = (corners[k], corners[(k + 1) % corners.len()]);
                    far * (from + uniform(rng, 0.0, 1.0) * (to - from))
                }
            }
        });
        let bears = carries(&points).is_some_and(|loads| loads.iter().all(|l| *l > LEAST_LOAD));
        if bears {
            return Support::Points(points.to_vec());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::internals::scene::Object;
    use pushplan::internals::seeded::generator;

    #[test]
    fn every_support_carries_its_object() {
        let shapes = [
            Shape::Cylinder { radius: 0.03, height: 0.1 },
            Shape::Cuboid { size: [0.2, 0.04, 0.05] },
        ];
        let mut scene = Scene::new(shapes.map(|shape| Object::new("one", shape)));
        let mut seen = [0; 3];
        for index in 0..200 {
            let mut rng = generator(1, index);
            draw_supports(&mut rng, &mut scene);
            for object in &scene.objects {
                let feet = object.feet();
                let centre: Vector = feet.each().map(|(at, load)| load * at).sum();
                assert!(centre.norm() < 1e-9, "{:?}", object.support);
                seen[match object.support {
                    Support::Even => 0,
                    Support::Corners | Support::Spread(_) => 1,
                    Support::Points(_) => 2,
                }] += 1;
            }
        }
        assert!(seen.iter().all(|count| *count > 60), "{seen:?}");
    }
}
