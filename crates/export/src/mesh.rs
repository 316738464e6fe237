//! Prisms as meshes, because MJCF has no primitive for them.

use pushplan::geometry::{ConvexPolygon, Shape};

use super::xml::{Xml, numbers};

/// Returns `true` if any of the named solids is a prism.
pub(super) fn are_among(solids: &[(String, Shape)]) -> bool {
    solids.iter().any(|(_, shape)| matches!(shape, Shape::Prism { .. }))
}

/// Writes the meshes of the prisms among the named solids; a solid refers to its mesh by its name.
pub(super) fn meshes(xml: &mut Xml, solids: &[(String, Shape)]) {
    if !are_among(solids) {
        return;
    }
    xml.open("asset", &[]);
    for (name, shape) in solids {
        let Shape::Prism { base, height } = shape else { continue };
        let ring = |z: f64| base.corners().iter().flat_map(move |corner| [corner.x, corner.y, z]);
        let vertices: Vec<f64> = ring(-height / 2.0).chain(ring(height / 2.0)).collect();
        xml.leaf("mesh", &[("name", name.clone()), ("vertex", numbers(&vertices))]);
    }
    xml.close();
}

/// Writes mass and moments of inertia of a prism whose middle is `rise` metres above the body's
/// origin. MuJoCo would use the centroid of the mesh as the centre of mass.
pub(super) fn inertial(xml: &mut Xml, base: &ConvexPolygon, height: f64, rise: f64, mass: f64) {
    let ([xx, xy, yy], zz) = (base.second_moments(), height * height / 12.0);
    let inertia = [yy + zz, xx + zz, xx + yy, -xy, 0.0, 0.0].map(|moment| mass * moment);
    let attributes = [
        ("pos", numbers(&[0.0, 0.0, rise])),
        ("mass", numbers(&[mass])),
        ("fullinertia", numbers(&inertia)),
    ];
    xml.leaf("inertial", &attributes);
}
