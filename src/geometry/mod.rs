//! Planar geometry: poses, footprints, closest points, clearances and swept areas.
//!
//! Everything except 3-D poses and solids lies in the plane of the table, in metres and radians.
//! This module is independent of tools, tasks and physics; the vertical extent of a body is only a
//! height.

mod area_moments;
mod cast;
mod clearance;
mod contact;
mod convex;
mod cuboids;
mod flat;
mod grid;
mod outline;
mod part_points;
mod planar_hull;
mod polygon;
mod pose;
mod rim;
mod shape;
mod solid;
mod spatial;
mod sunk;
mod support_edge;
mod vector;

pub use area_moments::AreaMoments;
pub use cast::travel_to_contact;
pub use clearance::{clearance, swept_clearance};
pub use pushplan_kernel::{Follows, Turn};

pub use contact::{ContactPoint, Placed, contact_points, contact_points_of, far_apart};
pub use convex::{convex_hull, convex_parts};
pub use cuboids::{Box3, BoxContact};
pub use grid::{Frontier, Grid};
pub use outline::{Extent, OutlinePiece, outline};
pub use planar_hull::planar_hull;
pub use polygon::{ConvexPolygon, MAX_CORNERS, PolygonError, centroid};
pub use pose::{Pose, cross, perpendicular, wrap_angle};
pub use rim::Rim;
pub use shape::{Footprint, Shape};
pub use solid::{Solid, area_of, common_area, without};
pub use spatial::{Matrix3, Pose3, Turn3, Vector3};
pub use support_edge::{SupportEdge, support_edge};
pub use vector::{Vector, distance_to_origin};
