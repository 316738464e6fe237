//! Mesh files.

use std::io::Cursor;
use std::path::Path;

use pushplan::geometry::Vector3;

use super::{Files, Refused};

/// Vertices, in the unit of the file, and triangles as vertex indices.
pub(super) type Triangles = (Vec<Vector3>, Vec<[u32; 3]>);

/// Maximum number of triangles of a mesh.
const MOST: usize = 1_000_000;

/// Reads the triangles of a mesh file.
///
/// # Errors
/// Returns an error if the file cannot be read, has another format, or has too many triangles.
pub fn load(path: &Path) -> Result<Triangles, Refused> {
    let refused = |message: String, advice: &str| Refused { message, advice: advice.to_owned() };
    let bytes = Files::bytes(path)?;
    let end = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let read = match end.as_str() {
        "stl" => stl(bytes),
        "obj" => obj(&bytes),
        "msh" => msh(&bytes),
        "dae" => super::dae::read(&bytes),
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

fn stl(mut bytes: Vec<u8>) -> Result<Triangles, String> {
    // Some programs start binary files with the keyword of text files; the file size decides.
    let count = bytes.get(80..84).and_then(|four| four.try_into().ok()).map(u32::from_le_bytes);
    let binary = count.is_some_and(|count| 84 + 50 * u64::from(count) == bytes.len() as u64);
    if binary {
        bytes[..5].fill(b' ');
    }
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let points = mesh.vertices.iter().map(|vertex| Vector3::from(vertex.0.map(f64::from)));
    let faces = mesh.faces.iter().map(|face| face.vertices.map(|corner| corner as u32));
    Ok((points.collect(), faces.collect()))
}

fn obj(bytes: &[u8]) -> Result<Triangles, String> {
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    // Materials are not needed.
    let none = |_: &Path| Err(tobj::LoadError::GenericFailure);
    let (models, _) = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, none)
        .map_err(|error| error.to_string())?;
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for mesh in models.iter().map(|model| &model.mesh) {
        let first = points.len() as u32;
        points
            .extend(mesh.positions.chunks_exact(3).map(|xyz| Vector3::new(xyz[0], xyz[1], xyz[2])));
        let corners = mesh.indices.chunks_exact(3);
        faces.extend(corners.map(|face| [face[0], face[1], face[2]].map(|corner| first + corner)));
    }
    Ok((points, faces))
}

/// Reads MSH: the numbers of vertices, normals, texture coordinates and triangles, followed by
/// their data.
fn msh(bytes: &[u8]) -> Result<Triangles, String> {
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

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(stl(whole.clone()).map(|(_, faces)| faces.len()), Ok(2));
        for cut in 0..whole.len() {
            let _ = (stl(whole[..cut].to_vec()), msh(&whole[..cut]), obj(&whole[..cut]));
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
