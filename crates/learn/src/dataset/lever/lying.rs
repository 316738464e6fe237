//! Boxes and lying cylinders, which are equal rectangles from above and differ only in depth.

use pushplan::internals::geometry::{Pose, Vector};
use pushplan::internals::{
    scene::{LeverScene, Plate, Slab},
    task::{LeverUp, Place},
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::super::distributions::uniform;
use super::plates::{CLEARANCE, DENSITY, FRICTION, alone, lever, plate};

/// Half the number of sides of the prism that represents a lying cylinder.
const SIDES: usize = 10;

/// Angle between adjacent sides, radians.
const STEP: f64 = std::f64::consts::PI / SIDES as f64;

/// Draws a box or a cylinder of equal extents, levered at a long side near its middle.
pub(super) fn lying(shapes: &mut Pcg64, rng: &mut Pcg64) -> (LeverScene, LeverUp) {
    let radius = uniform(shapes, 0.025, 0.045);
    let length = uniform(shapes, 0.10, 0.18);
    let plate = if shapes.random() {
        let half_width = radius * (0.5 * STEP).cos();
        plate(rectangle(length, half_width), 2.0 * radius - CLEARANCE, FRICTION)
    } else {
        cylinder(length, radius, FRICTION)
    };
    let edge = 2 * rng.random_range(0..2);
    let place = Place { edge, fraction: uniform(rng, 0.3, 0.7) };
    // The blade has 8.7 mm of space under the narrowest cylinder.
    (alone(plate, rng), lever(place, 0.008, 2.0 * radius, 60.0))
}

/// Returns a cylinder that lies along x.
///
/// The blade goes under its widest layer. Its frame is as high as the frame of a box on feet.
fn cylinder(length: f64, radius: f64, friction: f64) -> Plate {
    // The corners of the prism lie on the circle, at half steps from its lowest point.
    let at = |k: usize| {
        let (sin, cos) = (STEP * (k as f64 + 0.5)).sin_cos();
        (radius * sin, -radius * cos)
    };
    // The prism stands on its lowest side, below which the circle extends.
    let ground = at(0).1;
    let layers = (0..SIDES - 1).map(|k| {
        let ((narrow, low), (wide, high)) = (at(k), at(k + 1));
        Slab {
            corners: rectangle(length, narrow.min(wide)),
            bottom: low - ground - CLEARANCE,
            height: high - low,
        }
    });
    let mut slabs: Vec<Slab> = layers.collect();
    slabs.swap(0, SIDES / 2 - 1);
    let volume = std::f64::consts::PI * radius * radius * length;
    Plate {
        name: "cylinder".to_owned(),
        slabs,
        mass: DENSITY * volume,
        friction,
        // Slightly less than the true height because the cylinder has no feet.
        clearance: CLEARANCE - 1e-3,
        pose: Pose::default(),
        z: CLEARANCE,
    }
}

fn rectangle(length: f64, half_width: f64) -> Vec<Vector> {
    let (x, y) = (0.5 * length, half_width);
    [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector::new(x, y)).to_vec()
}
