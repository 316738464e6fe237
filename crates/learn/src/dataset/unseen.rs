//! What nobody sees from above: what objects stand on, and how high tools press.

use std::f64::consts::TAU;

use pushplan::internals::geometry::{Footprint, Shape, Vector};
use pushplan::internals::scene::{Ranges, Scene, Span, Support, carries};
use rand::Rng;
use rand_pcg::Pcg64;

use super::chance::{log_uniform, uniform, weighted};

/// How often an object rests evenly; somewhere between there and its corners or a bit further in;
/// on three points.
const SUPPORTS: [f64; 3] = [0.35, 0.40, 0.25];

/// Where the points of spread supports lie, as a share of the corners' distance.
const SPREAD: Span = Span::new(0.4, 1.0);

/// Smallest share of the weight on one of three points: with less, objects tip at every touch.
const LEAST_LOAD: f64 = 0.1;

/// Stands every object of `scene` on something.
pub(super) fn draw_supports(rng: &mut Pcg64, scene: &mut Scene) {
    for object in &mut scene.objects {
        object.support = match weighted(rng, &SUPPORTS) {
            0 => Support::Even,
            1 => Support::Spread(uniform(rng, SPREAD.low, SPREAD.high)),
            _ => three_points(rng, &object.shape.footprint()),
        };
    }
}

/// Gives half of the objects of `scene` any height within the ranges: plates as well as cans.
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

/// A share of the mean height of faces at which the tool presses.
pub(super) fn push_height(rng: &mut Pcg64) -> f64 {
    uniform(rng, 0.0, 1.0)
}

/// Three points that carry the object, none of them next to nothing.
fn three_points(rng: &mut Pcg64, footprint: &Footprint) -> Support {
    loop {
        let points = [(); 3].map(|()| {
            let (sin, cos) = uniform(rng, 0.0, TAU).sin_cos();
            let far = uniform(rng, 0.3, 0.95);
            match *footprint {
                Footprint::Disc { radius } => far * radius * Vector::new(cos, sin),
                Footprint::Rectangle { half } => {
                    // On a smaller rectangle of the same shape.
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
