//! The corners of meshes that URDF files name: STL, binary or text, and OBJ.

use std::fs;
use std::path::{Path, PathBuf};

use crate::geometry::Vector3;

use super::build::Wrong;

/// Largest mesh file that is read, bytes.
const MAX_BYTES: u64 = 1 << 28;

/// Header of a binary STL, and each of its triangles, bytes.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// The corners of a mesh that the URDF file at `urdf` names, in the mesh's own units.
pub(super) fn corners(urdf: &Path, name: &str) -> Result<Vec<Vector3>, Wrong> {
    let advice = "put it where the URDF says, or write boxes and cylinders instead of meshes";
    let Some(path) = found(urdf, name) else {
        return Err((format!("there is no mesh `{name}`"), advice.into()));
    };
    let shown = path.display();
    let size = fs::metadata(&path).map_or(0, |data| data.len());
    if size > MAX_BYTES {
        return Err((format!("the mesh {shown} has {size} bytes"), "make it coarser".into()));
    }
    let bytes = fs::read(&path).map_err(|error| (format!("{shown}: {error}"), advice.into()))?;
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let corners = match &*ending {
        "stl" => binary(&bytes).or_else(|| text(&bytes, "vertex")),
        "obj" => text(&bytes, "v"),
        other => {
            let message = format!("meshes like {shown} ({other}) are not read");
            return Err((message, "convert its collision meshes to STL".into()));
        }
    };
    let sound = |corners: &Vec<Vector3>| {
        !corners.is_empty()
            && corners.iter().flat_map(|corner| corner.iter()).all(|v| v.abs() < 1e5)
    };
    let damaged = || (format!("the mesh {shown} is damaged"), "export it again".to_owned());
    corners.filter(sound).ok_or_else(damaged)
}

/// Where a mesh is: `package://` is looked for in every folder above the URDF.
fn found(urdf: &Path, name: &str) -> Option<PathBuf> {
    let name = name.strip_prefix("file://").unwrap_or(name);
    let folder = urdf.parent()?;
    let Some(inside) = name.strip_prefix("package://") else {
        return Some(folder.join(name)).filter(|path| path.is_file());
    };
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
    let without = inside.split_once('/').map(|(_, rest)| rest);
    folder.ancestors().find_map(|above| {
        let tries = std::iter::once(inside).chain(without);
        tries.map(|inside| above.join(inside)).find(|path| path.is_file())
    })
}

fn binary(bytes: &[u8]) -> Option<Vec<Vector3>> {
    let count: [u8; 4] = bytes.get(80..HEADER)?.try_into().ok()?;
    let count = u32::from_le_bytes(count) as usize;
    if bytes.len() != HEADER.checked_add(count.checked_mul(TRIANGLE)?)? {
        return None;
    }
    let number = |at: &[u8]| f64::from(f32::from_le_bytes([at[0], at[1], at[2], at[3]]));
    let triangles = bytes[HEADER..].chunks_exact(TRIANGLE);
    let corner = |at: &[u8]| Vector3::new(number(at), number(&at[4..]), number(&at[8..]));
    // After the normal.
    Some(triangles.flat_map(|t| [&t[12..], &t[24..], &t[36..]].map(corner)).collect())
}

/// Lines that begin with a word and go on with three numbers.
fn text(bytes: &[u8], word: &str) -> Option<Vec<Vector3>> {
    let text = std::str::from_utf8(bytes).ok()?;
    let mut found = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        if words.next() == Some(word) {
            let mut number = || words.next()?.parse::<f64>().ok();
            found.push(Vector3::new(number()?, number()?, number()?));
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_read_from_both_kinds_of_stl_and_damage_is_seen() {
        let mut bytes = vec![0; HEADER + TRIANGLE];
        bytes[80] = 1;
        bytes[HEADER + 12..HEADER + 16].copy_from_slice(&1.5f32.to_le_bytes());
        let corners = binary(&bytes).expect("a triangle");
        assert_eq!((corners.len(), corners[0].x), (3, 1.5));
        assert!(binary(&bytes[..100]).is_none() && binary(&[]).is_none());
        let written = b"solid a\n facet\n vertex 1 2 3.5\n vertex 0 0 0\n";
        assert_eq!(text(written, "vertex").expect("corners")[0].z, 3.5);
        assert!(text(b"vertex 1 2 x", "vertex").is_none());
    }
}
