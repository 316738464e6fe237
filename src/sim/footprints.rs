//! Colliders of the planar engine.

use rapier2d::prelude::{
    CoefficientCombineRule, ColliderBuilder, MassProperties, Real, Vector as RapierVector,
};

use crate::geometry::{Footprint, Vector};

pub(super) fn collider(footprint: &Footprint, friction: f64) -> ColliderBuilder {
    let shape = match *footprint {
        Footprint::Disc { radius } => ColliderBuilder::ball(radius as Real),
        Footprint::Rectangle { half } => ColliderBuilder::cuboid(half.x as Real, half.y as Real),
        Footprint::Polygon(polygon) => {
            let corners = polygon.corners().iter().copied().map(vector).collect();
            // The hull of three or more corners always exists.
            ColliderBuilder::convex_polyline(corners)
                .unwrap_or_else(|| ColliderBuilder::ball(polygon.inner_radius() as Real))
        }
    };
    shape.friction(friction as Real).friction_combine_rule(CoefficientCombineRule::Average)
}

/// Sets the mass (kg) of the collider, about the footprint's origin.
pub(super) fn weighing(
    collider: ColliderBuilder,
    footprint: &Footprint,
    mass: f64,
) -> ColliderBuilder {
    match footprint {
        Footprint::Polygon(_) => {
            let inertia = mass * footprint.gyration_radius().powi(2);
            let (mass, inertia) = (mass as Real, inertia as Real);
            collider.mass_properties(MassProperties::new(RapierVector::ZERO, mass, inertia))
        }
        _ => collider.mass(mass as Real),
    }
}

pub(super) fn vector(v: Vector) -> RapierVector {
    RapierVector::new(v.x as Real, v.y as Real)
}
