//! URDF elements shared by all its readers: origins, shapes, axes and limits of joints.

use roxmltree::Node;

use pushplan::geometry::Vector3;

use crate::model::Outline;
use crate::turns;

use super::xml::{Flaw, element, elements, limits, number, numbers};

/// Pose stated by an `origin` element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Origin {
    /// Position, metres.
    pub xyz: [f64; 3],
    /// Roll, pitch and yaw about the fixed axes x, y and z, radians.
    pub rpy: [f64; 3],
}

/// Shape of a collision element.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// Solid about its centre; unknown elements are kept by name.
    Solid(Outline),
    /// Mesh file.
    Mesh {
        /// Name of the file.
        file: String,
        /// Scale along each axis.
        scale: [f64; 3],
    },
}

/// Reads the `origin` of an element; returns the default if there is none.
///
/// # Errors
/// Returns an error for invalid numbers, or for a wrong count of numbers.
pub fn origin<'a>(node: Node<'a, 'a>) -> Result<Origin, Flaw> {
    let Some(origin) = element(node, "origin") else { return Ok(Origin::default()) };
    let three = |name: &str| origin.attribute_node(name).map_or(Ok([0.0; 3]), numbers::<3>);
    let rpy = match origin.attribute_node("quat_xyzw").map(numbers::<4>).transpose()? {
        Some([x, y, z, w]) => {
            let turn = turns::quaternion([w, x, y, z]).map(|turn| turn.euler_angles());
            let (roll, pitch, yaw) = turn.ok_or_else(|| {
                Flaw::of(origin, "`quat_xyzw` has length zero", "write `0 0 0 1` for no rotation")
            })?;
            [roll, pitch, yaw]
        }
        None => three("rpy")?,
    };
    Ok(Origin { xyz: three("xyz")?, rpy })
}

/// Reads the shape of a collision element.
///
/// # Errors
/// Returns an error if the shape or one of its sizes is missing.
pub fn geometry<'a>(collision: Node<'a, 'a>) -> Result<Geometry, Flaw> {
    let shape = element(collision, "geometry").and_then(|geometry| elements(geometry).next());
    let missing = || Flaw::of(collision, "this collision has no geometry", "add <geometry>");
    let shape = shape.ok_or_else(missing)?;
    let tag = shape.tag_name().name();
    let need = |name: &str| {
        let missing =
            || Flaw::of(shape, format!("this {tag} has no `{name}`"), format!("add `{name}`"));
        shape.attribute_node(name).ok_or_else(missing)
    };
    let round = || {
        let (radius, length) = (need("radius")?, need("length")?);
        let half = number(length)? / 2.0;
        Ok((number(radius)?, half))
    };
    Ok(match tag {
        "box" => {
            Geometry::Solid(Outline::Box(numbers::<3>(need("size")?)?.map(|extent| extent / 2.0)))
        }
        "cylinder" => {
            let (radius, half) = round()?;
            Geometry::Solid(Outline::Cylinder { radius, half })
        }
        "sphere" => Geometry::Solid(Outline::Sphere(number(need("radius")?)?)),
        "capsule" => {
            let (radius, half) = round()?;
            Geometry::Solid(Outline::Capsule { radius, half })
        }
        "mesh" => {
            let file = need("filename")?.value().to_owned();
            let scale = shape.attribute_node("scale").map_or(Ok([1.0; 3]), numbers::<3>)?;
            Geometry::Mesh { file, scale }
        }
        tag => Geometry::Solid(Outline::Other(tag.to_owned())),
    })
}

/// Reads the axis of a joint in its own frame, a unit vector; the default is x.
///
/// # Errors
/// Returns an error if the axis has length zero.
pub fn axis<'a>(joint: Node<'a, 'a>) -> Result<Vector3, Flaw> {
    let stated = element(joint, "axis").and_then(|axis| axis.attribute_node("xyz"));
    let axis = Vector3::from(stated.map_or(Ok([1.0, 0.0, 0.0]), numbers::<3>)?);
    axis.try_normalize(1e-12).ok_or_else(|| {
        Flaw::of(joint, "the axis of this joint has length zero", "write an axis such as `0 0 1`")
    })
}

/// Reads a number of the `limit` of a joint, if stated; infinity means that there is none.
///
/// # Errors
/// Returns an error if the value is not a single number.
pub fn limit<'a>(joint: Node<'a, 'a>, name: &str) -> Result<Option<f64>, Flaw> {
    let stated = element(joint, "limit").and_then(|limit| limit.attribute_node(name));
    stated.map(|stated| limits::<1>(stated).map(|[limit]| limit)).transpose()
}

/// Returns the name of the link at an end of a joint, `parent` or `child`; empty if it is missing.
pub fn end<'a>(joint: Node<'a, 'a>, side: &str) -> &'a str {
    element(joint, side).and_then(|node| node.attribute("link")).unwrap_or_default()
}
