//! MSH, MuJoCo's own format of meshes: an array of numbers.

use pushplan::geometry::Vector3;

use super::Triangles;

/// Reads MSH: the numbers of vertices, normals, texture coordinates and triangles, followed by
/// their data.
pub(super) fn msh(bytes: &[u8]) -> Result<Triangles, String> {
    let word = |k: usize| {
        let four = bytes.get(4 * k..4 * k + 4)?;
        Some([four[0], four[1], four[2], four[3]])
    };
    let count = |k: usize| {
        let count = word(k).map(i32::from_le_bytes)?;
        usize::try_from(count).ok().filter(|count| *count <= bytes.len())
    };
    let counts = [count(0), count(1), count(2), count(3)];
    let [Some(corners), Some(normals), Some(textures), Some(triangles)] = counts else {
        return Err("its counts are not valid".to_owned());
    };
    let first_face = 4 + 3 * corners + 3 * normals + 2 * textures;
    if 4 * (first_face + 3 * triangles) != bytes.len() {
        return Err("its length does not match its counts".to_owned());
    }
    let number = |k: usize| f64::from(word(k).map_or(0.0, f32::from_le_bytes));
    let index = |k: usize| word(k).map_or(0, u32::from_le_bytes);
    let points =
        (0..corners).map(|k| Vector3::from([0, 1, 2].map(|axis| number(4 + 3 * k + axis))));
    let faces = (0..triangles).map(|k| [0, 1, 2].map(|corner| index(first_face + 3 * k + corner)));
    Ok((points.collect(), faces.collect()))
}
