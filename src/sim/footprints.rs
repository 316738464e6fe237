//! Colliders of the 2-D engine.

use rapier2d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, MassProperties, Vector as RapierVector,
};

use crate::geometry::{Footprint, Vector};

pub(super) fn collider(footprint: &Footprint, friction: f64) -> ColliderBuilder {
    let shape = match *footprint {
        Footprint::Disc { radius } => ColliderBuilder::ball(radius),
        Footprint::Rectangle { half } => ColliderBuilder::cuboid(half.x, half.y),
        Footprint::Polygon(polygon) => {
            let corners = polygon.corners().iter().copied().map(vector).collect();
            // The hull of three or more corners always exists.
            ColliderBuilder::convex_polyline(corners)
                .unwrap_or_else(|| ColliderBuilder::ball(polygon.inner_radius()))
        }
    };
    shape.friction(friction).friction_combine_rule(CoefficientCombineRule::Average)
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
            collider.mass_properties(MassProperties::new(RapierVector::ZERO, mass, inertia))
        }
        _ => collider.mass(mass),
    }
}

pub(super) fn vector(v: Vector) -> RapierVector {
    RapierVector::new(v.x, v.y)
}
