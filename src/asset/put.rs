//! Conversion of values to the keys of files, the counterpart of `take`.

use serde_json::{Value as Json, json};

use crate::geometry::{Pose, Shape, Vector};

/// Returns a solid as it is written in a file.
pub(super) fn shape(shape: &Shape) -> Json {
    match *shape {
        Shape::Cylinder { radius, height } => {
            json!({"cylinder": {"radius": radius, "height": height}})
        }
        Shape::Cuboid { size } => json!({"cuboid": {"size": size}}),
        Shape::Prism { base, height } => {
            let corners: Vec<_> = base.corners().iter().map(|corner| vector(*corner)).collect();
            json!({"prism": {"corners": corners, "height": height, "centre_of_mass": [0.0, 0.0]}})
        }
    }
}

/// Returns a solid of a compound object with clearance for a blade. Its `origin` is written instead
/// of its centre of mass, because the mass refers to the frame of the compound object.
pub(super) fn drawn(solid: &Shape) -> Json {
    let mut json = shape(solid);
    if let Some(prism) = json.get_mut("prism").and_then(Json::as_object_mut)
        && let Some(origin) = prism.remove("centre_of_mass")
    {
        prism.insert("origin".to_owned(), origin);
    }
    json
}

/// Adds the keys of a pose.
pub(super) fn posed(mut fields: Json, pose: &Pose) -> Json {
    fields["position"] = json!(vector(pose.position));
    fields["yaw_deg"] = json!(degrees(pose.heading));
    fields
}

/// Returns the two components of a vector.
pub(super) fn vector(vector: Vector) -> [f64; 2] {
    [vector.x, vector.y]
}

/// Returns the roundest angle in degrees that converts back to exactly `radians`, so that a plan
/// made from a file is verified bit for bit. An angle that did not come from a file may have no
/// such number; a neighbouring number is returned then.
pub(super) fn degrees(radians: f64) -> f64 {
    let plain = radians.to_degrees();
    // Angles beyond a full turn are reduced to an equivalent one.
    let plain = if plain.abs() > 360.0 { plain % 360.0 } else { plain };
    let round = (plain * 1e9).round() / 1e9;
    let (mut up, mut down) = (plain, plain);
    let mut candidates = vec![round, plain];
    for _ in 0..2 {
        (up, down) = (up.next_up(), down.next_down());
        candidates.extend([up, down]);
    }
    candidates.into_iter().find(|angle| angle.to_radians() == radians).unwrap_or(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_read_back_exactly() {
        for tenth in -3600..=3600 {
            let angle = f64::from(tenth) / 10.0;
            assert_eq!(degrees(angle.to_radians()), angle);
        }
    }
}
