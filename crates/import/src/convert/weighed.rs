//! Masses and centres of mass of bodies and solids.

use std::f64::consts::PI;

use nalgebra::{Point3, Vector3};

use crate::diagnostic::Ledger;
use crate::model::{Body, Model, Outline, Solid, Weight};
use pushplan::geometry::Vector;

use super::upright::volume;

/// Mass below which a body counts as massless, kg.
pub(super) const NOTHING: f64 = 1e-9;

/// Mass (kg), centre of mass in the world (metres) and moment of inertia about the vertical through
/// it (kg m^2). The centre is `None` if it is the middle of the only solid.
pub(super) type Weighed = (f64, Option<Point3<f64>>, Option<f64>);

/// Returns the centroid of a homogeneous solid in the world, metres.
pub(super) fn middle(solid: &Solid) -> Point3<f64> {
    match &solid.outline {
        Outline::Mesh(mesh) => solid.pose * mesh.middle,
        _ => Point3::from(solid.pose.translation.vector),
    }
}

/// Returns mass, centre of mass and moment of inertia of a body; `density` (kg/m^3) applies if it
/// states no mass.
pub(super) fn of_body(body: &Body, density: Option<f64>, ledger: &mut Ledger) -> Option<Weighed> {
    // Some files state a mass of zero to mean that it is unknown.
    let known = |mass: &f64| *mass > NOTHING || density.is_none();
    if let Some((mass, centre, moment)) = body.inertial.filter(|(mass, ..)| known(mass)) {
        return Some((mass, Some(centre), moment));
    }
    if let (Some((volume, centre)), Some(density)) = (body.weighs, density) {
        return Some((density * volume, Some(centre), None));
    }
    let mut parts = Vec::new();
    // The mass is also unknown if every solid states zero.
    let nothing = |solid: &Solid| solid.material.weight == Weight::Mass(0.0);
    let unknown = density.is_some() && body.solids.iter().all(nothing);
    for solid in &body.solids {
        if solid.material.weight == Weight::OfBody && density.is_none() {
            let message = format!("`{}` states no mass", body.name);
            let advice = "give its density, such as --density 700 (kg/m^3, wood), or add \
                          <inertial> with its <mass>";
            ledger.fault(body.place, message, advice);
            return None;
        }
        let mass = match unknown && solid.touches {
            true => density.zip(volume(solid)).map_or(0.0, |(density, volume)| density * volume),
            false => of_solid(solid, density, ledger)?,
        };
        parts.push((mass, solid));
    }
    let mass: f64 = parts.iter().map(|(mass, _)| mass).sum();
    let heavy: Vec<_> = parts.iter().filter(|(mass, _)| *mass > 0.0).collect();
    match heavy[..] {
        [] => Some((mass, None, None)),
        // A single solid has its centre of mass in its own middle, which is also known for prisms.
        [(_, solid)] if !matches!(solid.outline, Outline::Mesh(_)) => Some((mass, None, None)),
        _ => {
            let moment = heavy.iter().map(|(mass, solid)| *mass * middle(solid).coords);
            Some((mass, Some(Point3::from(moment.sum::<Vector3<f64>>() / mass)), None))
        }
    }
}

/// Returns mass, centre of mass and moment of inertia of bodies that are fixed to each other.
pub(super) fn together(
    model: &Model,
    bodies: &[usize],
    density: Option<f64>,
    ledger: &mut Ledger,
) -> Option<Weighed> {
    let mut weighed = Vec::new();
    for body in bodies.iter().map(|body| &model.bodies[*body]) {
        let (mass, centre, moment) = of_body(body, density, ledger)?;
        if mass > NOTHING {
            let heavy = body.solids.iter().find(|solid| {
                !matches!(solid.material.weight, Weight::Mass(0.0) | Weight::Density(0.0))
            });
            let own = heavy.map_or(Point3::from(body.pose.translation.vector), middle);
            weighed.push((mass, centre, own, moment));
        }
    }
    match weighed[..] {
        [] => Some((0.0, None, None)),
        [(mass, centre, _, moment)] => Some((mass, centre, moment)),
        _ => {
            let mass: f64 = weighed.iter().map(|(mass, ..)| mass).sum();
            let parts =
                weighed.iter().map(|(mass, centre, own, _)| centre.unwrap_or(*own).coords * *mass);
            Some((mass, Some(Point3::from(parts.sum::<Vector3<f64>>() / mass)), None))
        }
    }
}

/// Returns the mass of a solid, kg.
pub(super) fn of_solid(solid: &Solid, density: Option<f64>, ledger: &mut Ledger) -> Option<f64> {
    let (density, size, what) = match (solid.material.weight, density) {
        (Weight::Mass(mass), _) => return Some(mass),
        (Weight::OfBody, None) => return Some(0.0),
        (Weight::Density(density), _) | (Weight::OfBody, Some(density)) => {
            (density, volume(solid), "volume")
        }
        (Weight::Surface(density), _) => (density, surface(solid), "surface"),
    };
    if density == 0.0 {
        return Some(0.0);
    }
    if size.is_none() {
        let why = match &solid.outline {
            Outline::Other(what) => format!(": it is {what}"),
            _ => String::new(),
        };
        let message = format!(
            "the mass of this solid is computed from a density, but its {what} is not known{why}"
        );
        ledger.fault(solid.place, message, "state `mass`, or add <inertial> to its body");
    }
    size.map(|size| density * size)
}

/// Returns the surface area of a solid, m^2; `None` if it is unknown.
fn surface(solid: &Solid) -> Option<f64> {
    match &solid.outline {
        Outline::Box([x, y, z]) => Some(8.0 * (x * y + y * z + z * x)),
        Outline::Cylinder { radius, half } => Some(2.0 * PI * radius * (2.0 * half + radius)),
        Outline::Sphere(radius) => Some(4.0 * PI * radius * radius),
        Outline::Capsule { radius, half } => Some(4.0 * PI * radius * (half + radius)),
        Outline::Mesh(mesh) => Some(mesh.surface),
        Outline::Plane(_) => Some(0.0),
        Outline::Ellipsoid(_) | Outline::Other(_) => None,
    }
}

/// Adjusts masses (kg) of solids at `places` (metres) so that their common centre approaches
/// `centre`. Returns the remaining distance, metres.
pub(super) fn balanced(masses: &mut [f64], places: &[Vector], centre: Vector) -> f64 {
    let sum: f64 = masses.iter().sum();
    let common = |masses: &[f64]| {
        let moment = masses.iter().zip(places).map(|(mass, place)| *mass * *place);
        moment.sum::<Vector>() / sum
    };
    // Negative masses are clamped to zero, and the step is repeated.
    for _ in 0..20 {
        let now = common(masses);
        let off = centre - now;
        if off.norm() < 1e-6 {
            break;
        }
        let mut spread = nalgebra::Matrix2::zeros();
        for (mass, place) in masses.iter().zip(places) {
            let from = place - now;
            spread += *mass / sum * from * from.transpose();
        }
        let Ok(inverse) = spread.pseudo_inverse(1e-9) else { break };
        let tilt = inverse * off;
        for (mass, place) in masses.iter_mut().zip(places) {
            *mass *= (1.0 + tilt.dot(&(place - now))).max(0.05);
        }
        let share = sum / masses.iter().sum::<f64>();
        masses.iter_mut().for_each(|mass| *mass *= share);
    }
    (centre - common(masses)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masses_are_shifted_until_the_centre_is_where_it_should_be() {
        let places = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]].map(Vector::from);
        let mut masses = [1.0; 3];
        let left = balanced(&mut masses, &places, Vector::new(0.05, 0.02));
        assert!(left < 1e-6 && (masses.iter().sum::<f64>() - 3.0).abs() < 1e-12);
        assert!((masses[1] - 1.5).abs() < 1e-4 && (masses[2] - 0.6).abs() < 1e-4, "{masses:?}");
        let beyond = balanced(&mut [1.0; 3], &places, Vector::new(0.2, 0.0));
        assert!((0.1..0.2).contains(&beyond), "{beyond}");
    }
}
