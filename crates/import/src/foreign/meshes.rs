//! Mesh files: STL, OBJ, DAE and MuJoCo's MSH.
//!
//! STL and OBJ are read directly: the crates for them (`stl_io` 0.11, `tobj` 4.0) read the first
//! solid of a file only, refuse dialects that other programs read, and cut concave faces as a fan.

mod dae;
mod msh;
mod obj;
mod stl;

use std::path::Path;

use earcut::Earcut;
use earcut::utils3d::project3d_to_2d;

use pushplan::geometry::Vector3;

use super::{Files, Refused};

/// Vertices, in the unit of the file, and triangles as vertex indices.
pub(super) type Triangles = (Vec<Vector3>, Vec<[u32; 3]>);

/// Maximum number of triangles of a mesh.
const MOST: usize = 1_000_000;

/// Reads the triangles of a mesh file that another file names. The upward axis that a DAE file
/// states is ignored, as by RViz and Pinocchio.
///
/// # Errors
/// Returns an error if the file cannot be read, has another format, or has too many triangles.
pub fn load(path: &Path) -> Result<Triangles, Refused> {
    triangles(path, false)
}

/// Reads the triangles of a mesh file, rotated so that its upward axis is z.
///
/// # Errors
/// Returns an error if the file cannot be read, has another format, or has too many triangles.
pub(crate) fn load_upright(path: &Path) -> Result<Triangles, Refused> {
    triangles(path, true)
}

fn triangles(path: &Path, upright: bool) -> Result<Triangles, Refused> {
    let refused = |message: String, advice: &str| Refused { message, advice: advice.to_owned() };
    let bytes = Files::bytes(path)?;
    let end = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let read = match end.as_str() {
        "stl" => stl::stl(&bytes),
        "obj" => obj::obj(&bytes),
        "dae" => dae::dae(&bytes, upright),
        "msh" => msh::msh(&bytes),
        _ => {
            let message = format!("meshes with the extension .{end} are not supported");
            return Err(refused(message, "convert it to STL, OBJ or DAE (MeshLab, trimesh)"));
        }
    };
    match read {
        Ok((points, _)) if points.len() < 4 => {
            let message = format!("{} has fewer than four corners", path.display());
            Err(refused(message, "is this the right file?"))
        }
        Ok((_, faces)) if faces.len() > MOST => {
            let message = format!("{} has {} triangles", path.display(), faces.len());
            Err(refused(message, "make the mesh coarser; the limit is a million triangles"))
        }
        Ok(raw) => Ok(raw),
        Err(why) => {
            let message = format!("{} cannot be read as a mesh: {why}", path.display());
            Err(refused(message, "export it again (MeshLab, trimesh)"))
        }
    }
}

/// Returns triangles of a polygon, which need not be convex.
fn triangulated(points: &[Vector3], polygon: &[u32]) -> Vec<[u32; 3]> {
    if let [a, b, c] = *polygon {
        return vec![[a, b, c]];
    }
    let corners: Vec<[f64; 3]> = polygon.iter().map(|k| points[*k as usize].into()).collect();
    let (mut flat, mut found) = (Vec::new(), Vec::<usize>::new());
    if corners.len() < 3 || !project3d_to_2d(&corners, corners.len(), &mut flat) {
        return Vec::new();
    }
    Earcut::new().earcut(flat.iter().copied(), &[], &mut found);
    let outwards = |three: &[usize]| {
        let [a, b, c] = [flat[three[0]], flat[three[1]], flat[three[2]]];
        (b[0] - a[0]) * (c[1] - a[1]) >= (b[1] - a[1]) * (c[0] - a[0])
    };
    let face = |three: &[usize]| match outwards(three) {
        true => [three[0], three[1], three[2]],
        false => [three[0], three[2], three[1]],
    };
    found.chunks_exact(3).map(face).map(|face| face.map(|corner| polygon[corner])).collect()
}

#[cfg(test)]
mod tests {
    use super::{msh::msh, obj::obj, stl::stl};

    #[test]
    fn damaged_files_are_faults_and_no_panics() {
        let whole = {
            let mut bytes = b"solid, but binary".to_vec();
            bytes.resize(80, 0);
            bytes.extend(2u32.to_le_bytes());
            for k in 0..24u8 {
                bytes.extend(f32::from(k).to_le_bytes());
                if k % 12 == 11 {
                    bytes.extend([0, 0]);
                }
            }
            bytes
        };
        assert_eq!(stl(&whole).map(|(_, faces)| faces.len()), Ok(2));
        for cut in 0..whole.len() {
            let cut = &whole[..cut];
            let _ = (stl(cut), msh(cut), obj(cut), super::dae::dae(cut, true));
        }
        for text in [
            "f 1 2 3",
            "v 1 2\nf 1 1 1",
            "v 0 0 0\nf 1 2 99",
            "v x 0 0",
            "f -9 -8 -7",
            "v 0 0 0\nf 1",
        ] {
            let read = obj(text.as_bytes());
            assert!(read.is_err() || read.is_ok_and(|(points, _)| points.len() < 4), "{text}");
        }
        assert!(msh(&[255; 64]).is_err());
    }
}
