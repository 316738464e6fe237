//! Random objects on a table, separate or near each other.

use std::f64::consts::FRAC_PI_2;

use pushplan::internals::geometry::{
    ConvexPolygon, Footprint, Pose, Shape, Vector, perpendicular, travel_to_contact,
};
use pushplan::internals::scene::{Object, Ranges, Scene, Span, TRAINED_SLANT, slant};
use rand::Rng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::distributions::{heading, log_uniform, uniform};

/// Range of the heights of objects in most data sets, metres.
pub(super) const USUAL_HEIGHT: Span = Span::new(0.05, 0.15);

/// Range of the gaps between neighbours that do not touch, metres.
const GAP: Span = Span::new(1e-3, 0.06);

/// Probability of friction values above 1, if the range includes them.
const STICKY: f64 = 0.15;

/// Aspect ratio above which a cuboid is long, and share of long cuboids if the range includes them.
const LONG: (f64, f64) = (3.0, 0.2);

/// Kinds of solids among the random objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solids {
    /// Cylinders and cuboids with equal probability.
    Any,
    /// Cylinders only.
    Cylinders,
    /// Cuboids only.
    Cuboids,
}

/// Parameters of a random group of objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crowd {
    /// Number of objects.
    pub count: usize,
    /// Kinds of solids.
    pub solids: Solids,
    /// Probability that a further object touches (0 to 1 mm) the earlier ones.
    pub touching: f64,
    /// Share of objects that are convex prisms instead.
    pub polygons: f64,
}

/// Draws a random scene: the objects of `crowd` around the origin, without obstacles.
pub fn random_scene(rng: &mut Pcg64, ranges: &Ranges, crowd: Crowd) -> Scene {
    let friction = |rng: &mut Pcg64| random_friction(rng, ranges);
    let (middle, masses) = mass_span(rng, ranges);
    let mut scene = Scene::new([]).on_table(friction(rng));
    for index in 0..crowd.count {
        let shape = if crowd.polygons > 0.0 && rng.random_bool(crowd.polygons) {
            random_prism(rng, ranges)
        } else {
            random_shape(rng, ranges, crowd.solids)
        };
        let pose = if index == 0 {
            Pose::new(0.0, 0.0, heading(rng))
        } else {
            beside(rng, &scene.objects, shape.footprint(), crowd.touching)
        };
        scene.objects.push(Object {
            mass: if index == 0 { middle } else { log_uniform(rng, masses) },
            friction: friction(rng),
            pose,
            ..Object::new(format!("object-{}", index + 1), shape)
        });
    }
    scene
}

/// Draws a friction value within the ranges, above 1 in a few cases.
pub(super) fn random_friction(rng: &mut Pcg64, ranges: &Ranges) -> f64 {
    let Span { low, high } = ranges.friction;
    match high > 1.0 && rng.random_bool(STICKY) {
        true => uniform(rng, 1.0, high),
        false => uniform(rng, low, high.min(1.0)),
    }
}

/// Moves the scene by a random rotation and translation.
pub fn anywhere(rng: &mut Pcg64, mut scene: Scene) -> Scene {
    let motion = Pose::new(uniform(rng, -0.5, 1.2), uniform(rng, -0.5, 1.2), heading(rng));
    for object in &mut scene.objects {
        object.pose = motion * object.pose;
    }
    scene
}

/// Draws a reference mass and the range of the other masses in its scene, kg.
pub(super) fn mass_span(rng: &mut Pcg64, ranges: &Ranges) -> (f64, Span) {
    let middle = log_uniform(rng, ranges.mass);
    // The ends of the range differ from the reference by the square root of the maximum ratio, so
    // no two masses differ by more than that ratio.
    let reach = ranges.mass_ratio.sqrt();
    let (low, high) = (middle / reach, middle * reach);
    (middle, Span::new(low.max(ranges.mass.low), high.min(ranges.mass.high)))
}

/// Draws a solid within the ranges.
pub(super) fn random_shape(rng: &mut Pcg64, ranges: &Ranges, solids: Solids) -> Shape {
    let height = uniform(rng, USUAL_HEIGHT.low, USUAL_HEIGHT.high);
    let cylinder = match solids {
        Solids::Any => rng.random::<bool>(),
        Solids::Cylinders => true,
        Solids::Cuboids => false,
    };
    if cylinder {
        return Shape::Cylinder {
            radius: uniform(rng, ranges.radius.low, ranges.radius.high),
            height,
        };
    }
    let (long, share) = LONG;
    if ranges.aspect > long && rng.random_bool(share) {
        let x = uniform(rng, 0.5 * ranges.side.high, ranges.side.high);
        let y = (x / uniform(rng, long, ranges.aspect)).max(ranges.side.low);
        return Shape::Cuboid { size: [x, y, height] };
    }
    let x = log_uniform(rng, ranges.side);
    let others = Span::new(
        (x / ranges.aspect).max(ranges.side.low),
        (x * ranges.aspect).min(ranges.side.high),
    );
    Shape::Cuboid { size: [x, log_uniform(rng, others), height] }
}

/// Draws an upright prism whose base has three to six corners on an ellipse.
fn random_prism(rng: &mut Pcg64, ranges: &Ranges) -> Shape {
    let height = uniform(rng, USUAL_HEIGHT.low, USUAL_HEIGHT.high);
    loop {
        let size = log_uniform(rng, ranges.side);
        let width = (uniform(rng, 0.4, 1.0) * size).max(ranges.side.low);
        let mut angles: Vec<f64> = (0..rng.random_range(3..=6)).map(|_| heading(rng)).collect();
        angles.sort_by(f64::total_cmp);
        let corner = |angle: &f64| Vector::new(size * angle.cos(), width * angle.sin()) / 2.0;
        let corners: Vec<Vector> = angles.iter().map(corner).collect();
        // Thin prisms are rejected, because they are rare on tables and difficult for engines.
        let Ok(base) = ConvexPolygon::new(&corners) else { continue };
        let across = |axis: Vector| base.extent(axis) + base.extent(-axis);
        let [x, y] = [Vector::x(), Vector::y()].map(across);
        let within = |side: f64| (ranges.side.low..=ranges.side.high).contains(&side);
        let stout = x.max(y) <= ranges.aspect * x.min(y);
        let thick = base.inner_radius() > ranges.side.low / 4.0;
        if within(x) && within(y) && stout && thick && slant(&base) <= TRAINED_SLANT {
            return Shape::Prism { base, height };
        }
    }
}

/// Draws a pose beside one of `objects`: the new object moves in a straight line until it is near
/// them.
fn beside(rng: &mut Pcg64, objects: &[Object], footprint: Footprint, touching: f64) -> Pose {
    let anchor = &objects[rng.random_range(0..objects.len())];
    let around = anchor.shape.footprint();
    let rectangles = matches!(around, Footprint::Rectangle { .. })
        && matches!(footprint, Footprint::Rectangle { .. });
    let flush = rectangles && rng.random::<bool>();
    let quarter = |rng: &mut Pcg64| FRAC_PI_2 * f64::from(rng.random_range(0..4u8));
    let (side, turn) = if flush {
        (anchor.pose.heading + quarter(rng), anchor.pose.heading + quarter(rng))
    } else {
        (heading(rng), heading(rng))
    };
    let away = Vector::new(side.cos(), side.sin());
    let reach = around.bounding_radius() + footprint.bounding_radius();
    let wide = around.extent(anchor.pose.local_vector(perpendicular(away)))
        + footprint.extent(Pose::new(0.0, 0.0, turn).local_vector(perpendicular(away)));
    let aside = perpendicular(away) * uniform(rng, -0.7, 0.7) * wide;
    // The object starts beyond all others and moves straight towards them until the first contact.
    let mut pose =
        Pose { position: anchor.pose.position + away * (reach + 1.0) + aside, heading: turn };
    let travels = objects.iter().filter_map(|object| {
        let still = (&object.shape.footprint(), &object.pose);
        travel_to_contact((&footprint, &pose), -away, still)
    });
    let travel = travels.reduce(f64::min).unwrap_or(1.0);
    let gap = match (rng.random_bool(touching), rng.random::<bool>()) {
        (true, true) => 0.0,
        (true, false) => uniform(rng, 0.0, 1e-3),
        (false, _) => log_uniform(rng, GAP),
    };
    pose.position -= away * (travel - gap);
    pose
}
