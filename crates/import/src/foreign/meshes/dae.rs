//! DAE (COLLADA 1.4 and 1.5): polygons of the geometries that its scene shows, in metres.
//!
//! Skins, splines and physics are not read. The crates for the format read one placement of each
//! geometry only (`mesh-loader` 0.1), or bring a second XML parser (`dae-parser` 0.11).

use std::collections::HashMap;

use nalgebra::{Matrix4, Point3, Unit, Vector3 as Axis};
use roxmltree::{Document, Node};

use crate::crowd::crowded;
use crate::foreign::xml::{element, elements};

use super::{MOST, Triangles, triangulated};

/// Maximum nesting depth of nodes, safe for the stack and for nodes that contain themselves.
const DEEPEST: usize = 64;

/// Maximum number of placed nodes.
const NODES: usize = 10_000;

/// Elements of a document by their identifiers.
struct Library<'a> {
    by_id: HashMap<&'a str, Node<'a, 'a>>,
    placed: usize,
}

/// Reads the triangles that the scene of a document shows, with z up if `upright`, otherwise with
/// the axes of the file.
pub(super) fn dae(bytes: &[u8], upright: bool) -> Result<Triangles, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())?;
    let text = text.trim_start_matches('\u{feff}');
    if let Some(fault) = crowded(text, "") {
        return Err(fault.message);
    }
    let document = Document::parse(text).map_err(|error| format!("not valid XML: {error}"))?;
    let root = document.root_element();
    let by_id = root.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
    let mut library = Library { by_id, placed: 0 };
    let asset = element(root, "asset");
    let unit = asset.and_then(|asset| element(asset, "unit")?.attribute("meter")?.parse().ok());
    let up = asset.and_then(|asset| element(asset, "up_axis")?.text());
    let base = match up.map_or("Y_UP", str::trim) {
        _ if !upright => Matrix4::identity(),
        "X_UP" => Matrix4::new_rotation(-std::f64::consts::FRAC_PI_2 * Axis::y()),
        "Z_UP" => Matrix4::identity(),
        _ => Matrix4::new_rotation(std::f64::consts::FRAC_PI_2 * Axis::x()),
    };
    let base = base * Matrix4::new_scaling(unit.unwrap_or(1.0));
    let mut found = (Vec::new(), Vec::new());
    let shown = element(root, "scene").and_then(|scene| element(scene, "instance_visual_scene"));
    match shown.and_then(|shown| library.named(shown, "url")) {
        Some(scene) => library.place(scene, &base, 0, &mut found)?,
        None => {
            for geometry in root.descendants().filter(|node| node.has_tag_name("geometry")) {
                library.geometry(geometry, &base, &mut found)?;
            }
        }
    }
    Ok(found)
}

impl<'a> Library<'a> {
    /// Returns the element that an attribute names.
    fn named(&self, node: Node<'a, 'a>, attribute: &str) -> Option<Node<'a, 'a>> {
        self.by_id.get(node.attribute(attribute)?.strip_prefix('#')?).copied()
    }

    /// Adds the geometries of a node and of the nodes below it.
    fn place(
        &mut self,
        node: Node<'a, 'a>,
        above: &Matrix4<f64>,
        depth: usize,
        found: &mut Triangles,
    ) -> Result<(), String> {
        self.placed += 1;
        if depth > DEEPEST || self.placed > NODES {
            return Err("its nodes contain themselves, or are far too many".to_owned());
        }
        let mut pose = *above;
        for child in elements(node) {
            let tag = child.tag_name().name();
            match tag {
                "matrix" | "translate" | "rotate" | "scale" => pose *= transform(child)?,
                "lookat" | "skew" => return Err(format!("<{tag}> is not supported")),
                "instance_geometry" => {
                    if let Some(geometry) = self.named(child, "url") {
                        self.geometry(geometry, &pose, found)?;
                    }
                }
                "instance_controller" => return Err("skins are not supported".to_owned()),
                "node" => self.place(child, &pose, depth + 1, found)?,
                "instance_node" => {
                    if let Some(other) = self.named(child, "url") {
                        self.place(other, &pose, depth + 1, found)?;
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Adds the polygons of a geometry.
    fn geometry(
        &self,
        geometry: Node<'a, 'a>,
        pose: &Matrix4<f64>,
        found: &mut Triangles,
    ) -> Result<(), String> {
        let Some(mesh) = element(geometry, "mesh") else {
            return Err("a geometry that is not a <mesh>".to_owned());
        };
        for group in elements(mesh) {
            let tag = group.tag_name().name();
            if !["triangles", "polylist", "polygons", "tristrips", "trifans"].contains(&tag) {
                continue;
            }
            let mut polygons: Vec<Vec<u32>> = Vec::new();
            let inputs = || elements(group).filter(|input| input.has_tag_name("input"));
            let offset = |input: Node| input.attribute("offset").and_then(|k| k.parse().ok());
            let stride = inputs().filter_map(offset).max().unwrap_or(0) + 1;
            let vertex = inputs().find(|input| input.attribute("semantic") == Some("VERTEX"));
            let own = vertex.and_then(offset).unwrap_or(0);
            let points = vertex.and_then(|vertex| self.points(vertex));
            let points = points.ok_or("a mesh without positions")?;
            let lists = elements(group).filter(|list| list.has_tag_name("p"));
            for list in lists {
                let corners: Vec<u32> =
                    numbers::<u32>(list)?.into_iter().skip(own).step_by(stride).collect();
                match tag {
                    "triangles" => polygons.extend(corners.chunks_exact(3).map(<[u32]>::to_vec)),
                    "polygons" => polygons.push(corners),
                    "polylist" => {
                        let counts =
                            element(group, "vcount").ok_or("a <polylist> without counts")?;
                        let mut rest = &corners[..];
                        for count in numbers::<usize>(counts)? {
                            let split = rest.split_at_checked(count);
                            let (polygon, others) =
                                split.ok_or("a <polylist> that is too short")?;
                            polygons.push(polygon.to_vec());
                            rest = others;
                        }
                    }
                    "trifans" => polygons.extend(
                        corners.windows(2).skip(1).map(|two| vec![corners[0], two[0], two[1]]),
                    ),
                    _ => polygons.extend(corners.windows(3).enumerate().map(|(k, three)| {
                        let odd = k % 2;
                        vec![three[odd], three[1 - odd], three[2]]
                    })),
                }
            }
            if polygons.iter().flatten().any(|corner| *corner as usize >= points.len()) {
                return Err("a corner that does not exist".to_owned());
            }
            let first = found.0.len() as u32;
            let moved =
                |point: &[f64; 3]| pose.transform_point(&Point3::from(*point)).coords.into();
            let placed: Vec<[f64; 3]> = points.iter().map(moved).collect();
            found.0.extend(placed.into_iter().map(pushplan::geometry::Vector3::from));
            let mirrored = pose.determinant() < 0.0;
            for polygon in polygons {
                let mut polygon: Vec<u32> = polygon.iter().map(|corner| first + corner).collect();
                if mirrored {
                    polygon.reverse();
                }
                found.1.extend(triangulated(&found.0, &polygon));
            }
            if found.1.len() > MOST || found.0.len() > 4 * MOST {
                return Err(format!("it has more than {MOST} triangles"));
            }
        }
        Ok(())
    }

    /// Returns the positions that an input names, through its <vertices>.
    fn points(&self, vertex: Node<'a, 'a>) -> Option<Vec<[f64; 3]>> {
        let vertices = self.named(vertex, "source")?;
        let position =
            elements(vertices).find(|input| input.attribute("semantic") == Some("POSITION"))?;
        let source = self.named(position, "source")?;
        let accessor = element(element(source, "technique_common")?, "accessor")?;
        let stride = accessor.attribute("stride").map_or(Some(1), |stride| stride.parse().ok())?;
        let start = accessor.attribute("offset").map_or(Some(0), |start| start.parse().ok())?;
        let array = self.named(accessor, "source").or_else(|| element(source, "float_array"))?;
        let numbers: Vec<f64> = numbers(array).ok()?;
        let rows = numbers.get(start..)?.chunks_exact(std::cmp::max(stride, 3));
        let points: Vec<[f64; 3]> = rows.map(|row| [row[0], row[1], row[2]]).collect();
        points.iter().flatten().all(|number| number.is_finite()).then_some(points)
    }
}

/// Returns the transformation that an element of a node states.
fn transform(node: Node<'_, '_>) -> Result<Matrix4<f64>, String> {
    let numbers: Vec<f64> = numbers(node)?;
    Ok(match (node.tag_name().name(), &numbers[..]) {
        ("matrix", all) if all.len() == 16 => Matrix4::from_row_slice(all),
        ("translate", [x, y, z]) => Matrix4::new_translation(&Axis::new(*x, *y, *z)),
        ("scale", [x, y, z]) => Matrix4::new_nonuniform_scaling(&Axis::new(*x, *y, *z)),
        ("rotate", [x, y, z, angle]) => match Unit::try_new(Axis::new(*x, *y, *z), 1e-12) {
            Some(axis) => Matrix4::from_axis_angle(&axis, angle.to_radians()),
            None => Matrix4::identity(),
        },
        (tag, all) => return Err(format!("<{tag}> has {} numbers", all.len())),
    })
}

/// Returns the numbers in the text of an element.
fn numbers<T: std::str::FromStr>(node: Node<'_, '_>) -> Result<Vec<T>, String> {
    let text = node.text().unwrap_or_default();
    let number = |word: &str| word.parse().map_err(|_| format!("`{word}` is not a number"));
    text.split_whitespace().map(number).collect()
}
