//! Reading of mesh files as points.

use std::path::Path;

use nalgebra::Point3;
use pushplan::geometry::Vector3;

use crate::foreign::{self, Refused};

/// Vertices, in the unit of the file, and triangles as vertex indices.
type Triangles = (Vec<Point3<f64>>, Vec<[u32; 3]>);

/// Reads the triangles of a mesh file that another file names.
pub(crate) fn load(path: &Path) -> Result<Triangles, Refused> {
    foreign::load(path).map(points)
}

/// Reads the triangles of a mesh file with z up.
pub(crate) fn load_upright(path: &Path) -> Result<Triangles, Refused> {
    foreign::load_upright(path).map(points)
}

fn points((corners, faces): (Vec<Vector3>, Vec<[u32; 3]>)) -> Triangles {
    (corners.into_iter().map(Point3::from).collect(), faces)
}
