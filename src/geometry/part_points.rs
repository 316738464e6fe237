//! Points of the convex parts of a mesh: its triangles, cut at the voxels of each part.
//!
//! A mesh of many large triangles has millions of such cuts. They are reduced to their convex hull
//! on the way, so that the memory stays bounded.

use std::collections::HashMap;

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{IVector, Vector};
use parry3d_f64::transformation::try_convex_hull;
use parry3d_f64::transformation::vhacd::VHACD;

/// Number of points of a part above which they are reduced to their hull.
const MOST_POINTS: usize = 20_000;

/// Triangles of a mesh, with the size of its voxels.
pub(super) struct Triangles<'a> {
    /// Corners, metres.
    pub points: &'a [Vector],
    /// Triangles as indices of corners.
    pub faces: &'a [[u32; 3]],
}

impl Triangles<'_> {
    fn corners(&self, face: &[u32; 3]) -> [Vector; 3] {
        face.map(|corner| self.points[corner as usize])
    }

    /// Returns the approximate number of pairs of a triangle and a voxel in its bounding box, with
    /// `resolution` voxels along the longest side of the mesh.
    pub fn cuts(&self, resolution: u32) -> f64 {
        let corners = || self.faces.iter().flat_map(|face| self.corners(face));
        let low = corners().fold(Vector::splat(f64::INFINITY), Vector::min);
        let high = corners().fold(Vector::splat(f64::NEG_INFINITY), Vector::max);
        let scale = (high - low).max_element() / f64::from(resolution);
        let boxed = |face: &[u32; 3]| {
            let [a, b, c] = self.corners(face);
            let extent = (a.max(b).max(c) - a.min(b).min(c)) / scale + Vector::ONE;
            extent.x * extent.y * extent.z
        };
        self.faces.iter().map(boxed).sum()
    }

    /// Returns the points of each part. Parts with many points are reduced to their hulls.
    pub fn cut(&self, parts: &VHACD) -> Vec<Vec<Vector>> {
        let sets = parts.voxel_parts();
        let Some(first) = sets.first() else { return Vec::new() };
        let (origin, scale) = (first.origin, first.scale);
        let owners: HashMap<IVector, usize> = sets
            .iter()
            .enumerate()
            .flat_map(|(part, set)| set.voxels().iter().map(move |voxel| (part, voxel)))
            .filter(|(_, voxel)| voxel.is_on_surface)
            .map(|(part, voxel)| (voxel.coords, part))
            .collect();
        let mut found = vec![Reduced { points: Vec::new(), limit: MOST_POINTS }; sets.len()];
        let (mut polygon, mut workspace) = (Vec::new(), Vec::new());
        for face in self.faces {
            let corners = self.corners(face);
            let [a, b, c] = corners.map(|corner| ((corner - origin) / scale).round().as_i64vec3());
            let (low, high) = (a.min(b).min(c) - 1, a.max(b).max(c) + 1);
            for coords in cells(low, high) {
                let Some(&part) = owners.get(&coords) else { continue };
                let middle = origin + coords.as_dvec3() * scale;
                let voxel = Aabb::from_half_extents(middle, Vector::splat(scale / 2.0));
                polygon.clear();
                workspace.clear();
                polygon.extend_from_slice(&corners);
                voxel.clip_polygon_with_workspace(&mut polygon, &mut workspace);
                if polygon.len() > 2 {
                    found[part].add(&polygon);
                }
            }
        }
        found.into_iter().map(|part| part.points).collect()
    }
}

/// Points that are reduced to their hull when there are too many.
#[derive(Clone)]
struct Reduced {
    points: Vec<Vector>,
    limit: usize,
}

impl Reduced {
    fn add(&mut self, points: &[Vector]) {
        self.points.extend_from_slice(points);
        if self.points.len() < self.limit {
            return;
        }
        // Points in a plane have no hull, and others may lie on it in large numbers.
        if let Ok((hull, _)) = try_convex_hull(&self.points) {
            self.points = hull;
        }
        self.limit = MOST_POINTS.max(2 * self.points.len());
    }
}

/// Returns the cells of a box, both ends included.
fn cells(low: IVector, high: IVector) -> impl Iterator<Item = IVector> {
    (low.x..=high.x).flat_map(move |x| {
        (low.y..=high.y).flat_map(move |y| (low.z..=high.z).map(move |z| IVector::new(x, y, z)))
    })
}
