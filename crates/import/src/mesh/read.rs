//! Reading of mesh files as points.

use std::path::Path;

use nalgebra::Point3;

use crate::foreign::{self, Refused};

/// Vertices, in the unit of the file, and triangles as vertex indices.
type Triangles = (Vec<Point3<f64>>, Vec<[u32; 3]>);

/// Reads the triangles of a mesh file.
pub(crate) fn load(path: &Path) -> Result<Triangles, Refused> {
    let (corners, faces) = foreign::load(path)?;
    Ok((corners.into_iter().map(Point3::from).collect(), faces))
}
