//! Values put back into the keys of files, the counterpart of `take`.

use serde_json::{Value as Json, json};

use crate::geometry::{Pose, Shape, Vector};

/// Returns a solid as in a file.
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

/// A solid of an object with room for a blade: its mass lies where its solids do, about the frame of all.
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

/// Returns the two numbers of a vector.
pub(super) fn vector(vector: Vector) -> [f64; 2] {
    [vector.x, vector.y]
}

/// The angle in degrees that reads back as exactly `radians`: the roundest such number, so
/// that a plan made from a file is verified with the same bits. An angle that came from no
/// file may have none; it then reads back as a neighbouring number.
pub(super) fn degrees(radians: f64) -> f64 {
    let plain = radians.to_degrees();
    // A full turn and more looks the same.
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
