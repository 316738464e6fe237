//! Single plates on the table: polygons, the disc, and the outline of a circuit board.

use std::f64::consts::{PI, TAU};

use pushplan::internals::geometry::{Pose, Vector};
use pushplan::internals::{
    scene::{Blade, LeverScene, Plate, Slab},
    task::{LeverUp, Place},
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::super::distributions::{heading, uniform};
use super::preset::DISC_PLACES;

/// Radius of the circle through the corners, and of the disc, metres.
const RADIUS: f64 = 0.10;

/// Free height under plates, metres.
pub(super) const CLEARANCE: f64 = 0.006;

/// Density of plates, kg/m^3 (hard plastic).
pub(super) const DENSITY: f64 = 1200.0;

/// Minimum angle between adjacent corners as seen from the circle's centre, radians. The sides are
/// then at least 3 cm long and have room for a place.
const SHORTEST: f64 = 0.3;

/// Maximum angle between adjacent corners. Polygons become slivers near half a turn, and the
/// circle's centre is outside beyond it.
const LONGEST: f64 = 0.9 * PI;

/// Minimum distance of a levered place from a corner, metres.
const FROM_CORNER: f64 = 0.012;

/// Default friction value of plates.
pub(super) const FRICTION: f64 = 0.4;

/// Friction values of table and blade.
///
/// A steel blade slips under a plate that stays in place. Equal values would make the motion
/// undetermined because table and blade each carry about half of the load.
const TABLE: f64 = 0.6;
const BLADE: f64 = 0.3;

/// Outline of a drive's circuit board without its notches, metres.
const BOARD: [[f64; 2]; 7] = [
    [0.0, 0.0],
    [0.058, 0.0],
    [0.072, 0.012],
    [0.072, 0.070],
    [0.050, 0.096],
    [0.012, 0.096],
    [0.0, 0.086],
];

/// Returns polygon `shape` with the motion of Tekden (2020).
pub(super) fn fixed(shapes: &mut Pcg64, rng: &mut Pcg64, shape: u64) -> (LeverScene, LeverUp) {
    let corners = polygon(shapes, shape);
    let place = any_place(rng, &corners);
    let scene = alone(plate(corners, 0.008, FRICTION), rng);
    (scene, lever(place, 0.015, 0.16, 75.0))
}

/// Returns polygon `shape` with random parameters and a random motion.
pub(super) fn varied(shapes: &mut Pcg64, rng: &mut Pcg64, shape: u64) -> (LeverScene, LeverUp) {
    let corners = polygon(shapes, shape);
    let height = uniform(shapes, 0.004, 0.014);
    let place = any_place(rng, &corners);
    let [own, table, blade] = [(); 3].map(|()| uniform(rng, 0.15, 0.7));
    let mut scene = alone(plate(corners, height, own), rng);
    scene.table_friction = table;
    scene.blade.friction = blade;
    let depth = uniform(rng, 0.008, 0.025);
    let pivot = uniform(rng, 0.10, 0.22);
    (scene, lever(place, depth, pivot, uniform(rng, 30.0, 120.0)))
}

/// Returns the disc with a lever-up at one of its places.
pub(super) fn disc(rng: &mut Pcg64, place: usize) -> (LeverScene, LeverUp) {
    let corner = |k: usize| on_circle(TAU * k as f64 / DISC_PLACES as f64);
    let corners = (0..DISC_PLACES).map(corner).collect();
    let scene = alone(plate(corners, 0.02, FRICTION), rng);
    (scene, lever(Place { edge: place, fraction: 0.5 }, 0.015, 2.0 * RADIUS, 45.0))
}

/// Returns the circuit board's outline with a lever-up at a random place.
pub(super) fn board(rng: &mut Pcg64) -> (LeverScene, LeverUp) {
    let corners: Vec<Vector> = BOARD.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
    let plate = plate(corners, 0.0016, FRICTION);
    let place = any_place(rng, plate.corners());
    let pivot = width(plate.corners(), place.edge);
    (alone(plate, rng), lever(place, 0.012, pivot, 60.0))
}

/// Returns the default lever-up of the only plate, with `angle` in degrees.
pub(super) fn lever(place: Place, depth: f64, pivot: f64, angle: f64) -> LeverUp {
    LeverUp {
        plate: 0,
        place,
        depth,
        pivot,
        angle: angle.to_radians(),
        speed: LeverUp::SPEED,
        hold: LeverUp::HOLD,
        retreat: LeverUp::RETREAT,
    }
}

/// Returns a screwdriver's blade with this friction value.
pub(super) fn screwdriver(friction: f64) -> Blade {
    Blade { length: 0.12, width: 0.006, thickness: 0.002, friction }
}

/// Returns a plate on feet with this outline and height, centred at its centre of mass.
pub(super) fn plate(corners: Vec<Vector>, height: f64, friction: f64) -> Plate {
    let slab = Slab { corners, bottom: 0.0, height };
    let mass = DENSITY * slab.volume();
    Plate {
        name: "plate".to_owned(),
        slabs: vec![slab],
        mass,
        friction,
        clearance: CLEARANCE,
        pose: Pose::default(),
        z: CLEARANCE,
    }
    .balanced()
}

/// Returns a scene with a single plate in random rotation.
pub(super) fn alone(mut plate: Plate, rng: &mut Pcg64) -> LeverScene {
    plate.pose = anywhere(rng);
    LeverScene {
        plates: vec![plate],
        blocks: Vec::new(),
        table_friction: TABLE,
        blade: screwdriver(BLADE),
    }
}

/// Draws a pose in front of the robot.
pub(super) fn anywhere(rng: &mut Pcg64) -> Pose {
    Pose::new(uniform(rng, 0.4, 0.6), uniform(rng, -0.2, 0.2), heading(rng))
}

/// Returns the extent of the outline perpendicular to an edge, metres.
pub(super) fn width(corners: &[Vector], edge: usize) -> f64 {
    let from = corners[edge];
    let along = (corners[(edge + 1) % corners.len()] - from).normalize();
    let inward = Vector::new(-along.y, along.x);
    corners.iter().map(|corner| inward.dot(&(corner - from))).fold(0.0, f64::max)
}

/// Draws a place on an edge of sufficient length.
pub(super) fn any_place(rng: &mut Pcg64, corners: &[Vector]) -> Place {
    loop {
        let edge = rng.random_range(0..corners.len());
        let length = (corners[(edge + 1) % corners.len()] - corners[edge]).norm();
        let margin = FROM_CORNER / length;
        if margin < 0.5 {
            return Place { edge, fraction: uniform(rng, margin, 1.0 - margin) };
        }
    }
}

/// Draws 3 to 10 random corners on the circle; the number cycles with `shape`.
fn polygon(rng: &mut Pcg64, shape: u64) -> Vec<Vector> {
    let count = 3 + (shape % 8) as usize;
    loop {
        // Gaps between random points on a circle are exponential numbers scaled to its
        // circumference.
        let gaps: Vec<f64> = (0..count).map(|_| -(1.0 - rng.random::<f64>()).ln()).collect();
        let scale = (TAU - count as f64 * SHORTEST) / gaps.iter().sum::<f64>();
        let gaps: Vec<f64> = gaps.iter().map(|gap| SHORTEST + scale * gap).collect();
        if gaps.iter().all(|gap| *gap < LONGEST) {
            let mut angle = 0.0;
            let corner = |gap: &f64| {
                angle += gap;
                on_circle(angle)
            };
            return gaps.iter().map(corner).collect();
        }
    }
}

fn on_circle(angle: f64) -> Vector {
    RADIUS * Vector::new(angle.cos(), angle.sin())
}
