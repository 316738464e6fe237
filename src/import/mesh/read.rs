//! Meshes of files as points.

use std::path::Path;

use nalgebra::Point3;

use crate::asset::foreign::{self, Refused};

/// Corners, in the unit of the file, and triangles of a mesh file.
pub(in crate::import) fn load(path: &Path) -> Result<(Vec<Point3<f64>>, Vec<[u32; 3]>), Refused> {
    let (corners, faces) = foreign::load(path)?;
    Ok((corners.into_iter().map(Point3::from).collect(), faces))
}
