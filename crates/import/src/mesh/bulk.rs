//! Mesh, with its volume, surface area and centre of mass.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3};

use pushplan::geometry::convex_hull;
use pushplan::scene::DisjointSets;

/// Mesh in the frame of its solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Vertices, metres.
    pub points: Vec<Point3<f64>>,
    /// Triangles as vertex indices, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
    /// Volume, cubic metres.
    pub volume: f64,
    /// Surface area, square metres.
    pub surface: f64,
    /// Centre of mass, metres.
    pub middle: Point3<f64>,
}

/// Method of computing the volume of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// Sum of the unsigned volumes of the tetrahedra between each triangle and the centre: MuJoCo's
    /// `legacy`.
    Unsigned,
    /// Enclosed volume.
    Enclosed,
    /// Volume of the convex hull.
    Hull,
    /// Zero volume; the mass is proportional to the surface area.
    Shell,
}

/// Volume, surface area and centre of mass.
type Bulk = (f64, f64, Point3<f64>);

impl Mesh {
    /// Creates a mesh from vertices and triangles; without triangles, it is the convex hull of the
    /// vertices. Returns `None` if the mesh is flat or a number is invalid.
    pub fn new(points: Vec<Point3<f64>>, faces: Vec<[u32; 3]>, counted: Counted) -> Option<Self> {
        let finite = |point: &Point3<f64>| point.iter().all(|number| number.abs() < 1e9);
        if !points.iter().all(finite) {
            return None;
        }
        let known = |face: &[u32; 3]| face.iter().all(|corner| (*corner as usize) < points.len());
        let faces: Vec<[u32; 3]> = faces.into_iter().filter(known).collect();
        let hull = || hull(&points);
        let (volume, surface, middle) = if faces.is_empty() || counted == Counted::Hull {
            let (corners, faces) = hull()?;
            bulk(&corners, &faces, Counted::Enclosed)
        } else {
            bulk(&points, &faces, counted)
        };
        let sound = volume.is_finite() && middle.iter().all(|number| number.is_finite());
        (sound && (volume > 0.0 || surface > 0.0)).then_some(Self {
            points,
            faces,
            volume,
            surface,
            middle,
        })
    }

    /// Returns the volume of the convex hull, cubic metres; zero if it is flat.
    pub fn hull_volume(&self) -> f64 {
        hull(&self.points)
            .map_or(0.0, |(corners, faces)| bulk(&corners, &faces, Counted::Enclosed).0)
    }

    /// Returns the box of equal inertia: its pose, and its half extents in ascending order, metres.
    pub fn inertia_box(&self) -> (Isometry3<f64>, [f64; 3]) {
        let hull = if self.faces.is_empty() { hull(&self.points) } else { None };
        let (points, faces) =
            hull.as_ref().map_or((&self.points, &self.faces), |(points, faces)| (points, faces));
        // Second moments about the centre of mass, of the tetrahedra over all triangles.
        let (mut moments, mut volume) = (Matrix3::zeros(), 0.0);
        for face in faces {
            let [a, b, c] = face.map(|corner| points[corner as usize] - self.middle);
            let held = a.dot(&b.cross(&c)) / 6.0;
            let sum = a + b + c;
            let squares =
                [a, b, c, sum].map(|side| side * side.transpose()).iter().sum::<Matrix3<f64>>();
            moments += held / 20.0 * squares;
            volume += held;
        }
        let axes = (moments / volume).symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| axes.eigenvalues[*a].total_cmp(&axes.eigenvalues[*b]));
        let half = order.map(|k| (3.0 * axes.eigenvalues[k].max(0.0)).sqrt());
        let [x, y] = [order[0], order[1]].map(|k| axes.eigenvectors.column(k).into_owned());
        let turn = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
        (Isometry3::from_parts(self.middle.into(), turn.into()), half)
    }

    /// Returns the pieces that share no corner, each with its own vertices, in order of their first
    /// vertices.
    pub fn pieces(points: &[Point3<f64>], faces: &[[u32; 3]]) -> Vec<Faces> {
        let number = merged(points);
        let sides = faces.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c]]);
        let pairs = sides.map(|pair| pair.map(|corner| number[corner as usize]));
        let mut sets = DisjointSets::of(points.len(), pairs);
        let names = sets.names();
        let mut found: BTreeMap<usize, (HashMap<u32, u32>, Faces)> = BTreeMap::new();
        for face in faces {
            let piece = found.entry(names[number[face[0] as usize]]).or_default();
            let (own, (corners, sides)) = piece;
            sides.push(face.map(|corner| {
                *own.entry(corner).or_insert_with(|| {
                    corners.push(points[corner as usize]);
                    corners.len() as u32 - 1
                })
            }));
        }
        found.into_values().map(|(_, piece)| piece).collect()
    }

    /// Returns `true` if every edge of a triangle is shared with exactly one other triangle, in the
    /// opposite direction.
    pub fn is_closed(&self) -> bool {
        let number = merged(&self.points);
        let mut sides: HashMap<[usize; 2], i32> = HashMap::new();
        for face in &self.faces {
            let [a, b, c] = face.map(|corner| number[corner as usize]);
            if a == b || b == c || c == a {
                continue;
            }
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *sides.entry([from.min(to), from.max(to)]).or_default() +=
                    if from < to { 1 } else { -1 };
            }
        }
        !self.faces.is_empty() && sides.values().all(|sum| *sum == 0)
    }
}

/// Vertices, and triangles as vertex indices.
pub type Faces = (Vec<Point3<f64>>, Vec<[u32; 3]>);

/// Returns for every vertex the index of the first one at its place, up to 0.1 micrometres.
fn merged(points: &[Point3<f64>]) -> Vec<usize> {
    let mut first = HashMap::new();
    let place =
        |point: &Point3<f64>| <[i64; 3]>::from(point.coords.map(|x| (x * 1e7).round() as i64));
    points.iter().enumerate().map(|(k, point)| *first.entry(place(point)).or_insert(k)).collect()
}

fn hull(points: &[Point3<f64>]) -> Option<Faces> {
    let plain: Vec<[f64; 3]> = points.iter().map(|point| point.coords.into()).collect();
    let (corners, faces) = convex_hull(&plain)?;
    Some((corners.into_iter().map(Point3::from).collect(), faces))
}

/// Computes volume, surface area and centre of mass from tetrahedra between the triangles and the
/// centroid of the surface.
fn bulk(points: &[Point3<f64>], faces: &[[u32; 3]], counted: Counted) -> Bulk {
    let triangles = || faces.iter().map(|face| face.map(|corner| points[corner as usize].coords));
    let (mut surface, mut weighted) = (0.0, nalgebra::Vector3::zeros());
    for [a, b, c] in triangles() {
        let area = (b - a).cross(&(c - a)).norm() / 2.0;
        surface += area;
        weighted += area * (a + b + c) / 3.0;
    }
    let origin = weighted / surface;
    if counted == Counted::Shell {
        return (0.0, surface, origin.into());
    }
    let held = |origin: nalgebra::Vector3<f64>| {
        let (mut volume, mut moment) = (0.0, nalgebra::Vector3::zeros());
        for [a, b, c] in triangles() {
            let signed = (a - origin).dot(&(b - origin).cross(&(c - origin))) / 6.0;
            let held = if counted == Counted::Unsigned { signed.abs() } else { signed };
            volume += held;
            moment += held * (a + b + c + origin) / 4.0;
        }
        (volume, moment / volume)
    };
    let (volume, middle) = held(origin);
    // MuJoCo moves a mesh to its centre of mass and computes the volume again from there.
    let volume = if counted == Counted::Unsigned { held(middle).0 } else { volume };
    // A mesh turned inside out encloses the same volume.
    (volume.abs(), surface, middle.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> (Vec<Point3<f64>>, Vec<[u32; 3]>) {
        let corner = |k: u32| Point3::from([k & 1, k >> 1 & 1, k >> 2].map(f64::from));
        let sides =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
        ((0..8).map(corner).collect(), faces.collect())
    }

    #[test]
    fn a_cube_holds_a_cube_however_it_is_counted() {
        let (points, faces) = cube();
        for counted in [Counted::Unsigned, Counted::Enclosed, Counted::Hull] {
            let mesh = Mesh::new(points.clone(), faces.clone(), counted).expect("a mesh");
            assert!((mesh.volume - 1.0).abs() < 1e-12 && mesh.is_closed(), "{counted:?}");
            assert!((mesh.middle - Point3::new(0.5, 0.5, 0.5)).norm() < 1e-12);
        }
        let shell = Mesh::new(points.clone(), faces.clone(), Counted::Shell).expect("a mesh");
        assert_eq!((shell.volume, shell.surface), (0.0, 6.0));
        let open = Mesh::new(points.clone(), faces[1..].to_vec(), Counted::Unsigned);
        assert!(!open.expect("a mesh").is_closed());
        assert!(Mesh::new(points[..3].to_vec(), Vec::new(), Counted::Hull).is_none());
        assert!(
            Mesh::new(vec![Point3::new(f64::NAN, 0.0, 0.0); 4], faces, Counted::Shell).is_none()
        );
    }
}
