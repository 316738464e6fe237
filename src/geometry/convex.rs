//! Convex hulls and convex parts of meshes, by parry.

use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::transformation::try_convex_hull;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

/// Number of voxels along the longest side of the decomposed mesh.
const VOXELS: u32 = 48;

/// Maximum number of parts.
const MOST: u32 = 24;

/// Concavity below which a part is not divided further, relative to the whole.
const CONCAVITY: f64 = 0.02;

/// Corners, metres, and triangles as indices of corners.
type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Returns the convex hull of points, metres; `None` if they lie in a plane.
pub fn convex_hull(points: &[[f64; 3]]) -> Option<Mesh> {
    let points: Vec<ParryVector> = points.iter().copied().map(ParryVector::from).collect();
    let (corners, faces) = try_convex_hull(&points).ok()?;
    Some((corners.into_iter().map(|corner| corner.to_array()).collect(), faces))
}

/// Decomposes a closed mesh into nearly convex parts, metres (Mamou 2016, "Volumetric hierarchical
/// approximate convex decomposition"). Returns the points of each part. Faces with indices beyond
/// the points are ignored.
pub fn convex_parts(points: &[[f64; 3]], faces: &[[u32; 3]]) -> Vec<Vec<[f64; 3]>> {
    let known = |face: &&[u32; 3]| face.iter().all(|corner| (*corner as usize) < points.len());
    let faces: Vec<[u32; 3]> = faces.iter().filter(known).copied().collect();
    let points: Vec<ParryVector> = points.iter().copied().map(ParryVector::from).collect();
    if faces.is_empty() {
        return Vec::new();
    }
    let parameters = VHACDParameters {
        resolution: VOXELS,
        max_convex_hulls: MOST,
        concavity: CONCAVITY,
        ..VHACDParameters::default()
    };
    let parts = VHACD::decompose(&parameters, &points, &faces, true);
    let found = parts.compute_primitive_intersections(&points, &faces);
    let found = found.into_iter().filter(|part| part.len() > 3);
    found.map(|part| part.into_iter().map(|point| point.to_array()).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_has_the_corners_of_a_cube_and_none_of_a_plane() {
        let corner = |k: u32| [k & 1, k >> 1 & 1, k >> 2].map(f64::from);
        let mut points: Vec<[f64; 3]> = (0..8).map(corner).collect();
        points.push([0.5; 3]);
        let (corners, faces) = convex_hull(&points).expect("a hull");
        assert_eq!((corners.len(), faces.len()), (8, 12));
        assert!(convex_hull(&points[..2]).is_none());
        assert!(convex_parts(&points, &[[0, 1, 99]]).is_empty());
    }
}
