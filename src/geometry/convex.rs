//! Convex hulls and convex parts of meshes, by parry.

use parry3d_f64::math::Vector as ParryVector;
use parry3d_f64::transformation::try_convex_hull;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

use super::part_points::Triangles;

/// Number of voxels along the longest side of the decomposed mesh.
const VOXELS: u32 = 48;

/// Maximum number of parts.
const MOST: u32 = 24;

/// Concavity below which a part is not divided further, relative to the whole.
const CONCAVITY: f64 = 0.02;

/// Number of cuts of triangles by voxels up to which all of them are kept, with some hundred bytes
/// each.
const MOST_CUTS: f64 = 2e5;

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
    let triangles = Triangles { points: &points, faces: &faces };
    let found = match triangles.cuts(VOXELS) <= MOST_CUTS {
        true => {
            let parts = VHACD::decompose(&parameters, &points, &faces, true);
            parts.compute_primitive_intersections(&points, &faces)
        }
        false => triangles.cut(&VHACD::decompose(&parameters, &points, &faces, false)),
    };
    let found = found.into_iter().filter(|part| part.len() > 3);
    found.map(|part| part.into_iter().map(|point| point.to_array()).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Creates the boxes of an L, each side cut into strips.
    fn ell(strips: u32) -> Mesh {
        let (mut points, mut faces) = (Vec::new(), Vec::new());
        let mut cuboid = |low: [f64; 3], size: [f64; 3]| {
            let first = points.len() as u32;
            points.extend((0..8).map(|k: u32| {
                [0, 1, 2].map(|axis| low[axis] + size[axis] * f64::from(k >> axis & 1))
            }));
            let sides = [
                [0, 2, 3, 1],
                [4, 5, 7, 6],
                [0, 1, 5, 4],
                [2, 6, 7, 3],
                [0, 4, 6, 2],
                [1, 3, 7, 5],
            ];
            faces.extend(sides.iter().flat_map(|[a, b, c, d]| {
                [[*a, *b, *c], [*a, *c, *d]].map(|face| face.map(|corner: u32| first + corner))
            }));
        };
        for k in 0..strips {
            let (wide, count) = (0.1 / f64::from(strips), f64::from(k));
            cuboid([wide * count, 0.0, 0.0], [wide, 0.02, 0.05]);
            cuboid([0.0, wide * count, 0.0], [0.02, wide, 0.05]);
        }
        (points, faces)
    }

    #[test]
    fn parts_of_a_mesh_with_many_cuts_have_the_same_hulls() {
        let (points, faces) = ell(11);
        let vectors: Vec<ParryVector> = points.iter().copied().map(ParryVector::from).collect();
        let triangles = Triangles { points: &vectors, faces: &faces };
        assert!(triangles.cuts(VOXELS) < MOST_CUTS);
        let parameters = VHACDParameters { resolution: VOXELS, ..VHACDParameters::default() };
        let parts = VHACD::decompose(&parameters, &vectors, &faces, true);
        let exact = parts.compute_primitive_intersections(&vectors, &faces);
        let cut = triangles.cut(&parts);
        assert_eq!(exact.len(), cut.len());
        let ends = |part: &[ParryVector]| {
            let low = part.iter().copied().fold(part[0], ParryVector::min);
            (low, part.iter().copied().fold(part[0], ParryVector::max))
        };
        for (exact, cut) in exact.iter().zip(&cut).filter(|(exact, _)| !exact.is_empty()) {
            let (a, b) = (ends(exact), ends(cut));
            assert!((a.0 - b.0).length() + (a.1 - b.1).length() < 1e-9, "{a:?} {b:?}");
        }
        let (points, faces) = ell(3000);
        let parts = convex_parts(&points, &faces);
        assert!((2..=MOST as usize).contains(&parts.len()), "{} parts", parts.len());
        assert!(parts.iter().map(Vec::len).sum::<usize>() < 500_000);
    }

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
