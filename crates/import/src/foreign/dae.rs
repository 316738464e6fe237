//! COLLADA meshes (DAE): triangles of the visual scene in metres.
//!
//! The axis that the file calls up is ignored, as RViz and Pinocchio do. Skins, morphs and
//! materials are ignored; polygons are cut into fans.

use std::collections::HashMap;

use nalgebra::{Matrix4, Rotation3, Unit, Vector4};
use roxmltree::{Document, Node, ParsingOptions};

use pushplan::geometry::Vector3;

use super::meshes::Triangles;
use super::xml::{element, elements};

/// Maximum depth of nested nodes.
const DEEPEST: usize = 64;

/// Maximum number of triangles of a scene, which may show a geometry more than once.
const MOST: usize = 1_000_001;

/// Reads the triangles of a COLLADA file.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
    let document =
        Document::parse_with_options(text, options).map_err(|error| error.to_string())?;
    let root = document.root_element();
    let ids = root.descendants().filter_map(|node| Some((node.attribute("id")?, node)));
    let mut file = File { ids: ids.collect(), found: (Vec::new(), Vec::new()) };
    let unit = element(root, "asset").and_then(|asset| element(asset, "unit"));
    let unit = unit.and_then(|unit| unit.attribute("meter")).map_or(Ok(1.0), str::parse::<f64>);
    let unit = unit.ok().filter(|unit| unit.is_finite() && *unit > 0.0);
    let unit = unit.ok_or("its <unit> has no valid `meter`")?;
    let shown = element(root, "scene").and_then(|scene| element(scene, "instance_visual_scene"));
    let scale = Matrix4::new_scaling(unit);
    match shown.map(|shown| file.named(shown.attribute("url"))).transpose()? {
        Some(scene) => file.node(scene, &scale, 0)?,
        None => {
            for geometry in root.descendants().filter(|node| node.has_tag_name("geometry")) {
                file.geometry(geometry, &scale)?;
            }
        }
    }
    Ok(file.found)
}

/// Document with its elements by id, and the triangles found so far.
struct File<'a> {
    ids: HashMap<&'a str, Node<'a, 'a>>,
    found: Triangles,
}

impl<'a> File<'a> {
    /// Returns the element to which a reference such as `#mesh` points.
    fn named(&self, reference: Option<&str>) -> Result<Node<'a, 'a>, String> {
        let name = reference.unwrap_or_default().trim_start_matches('#');
        self.ids.get(name).copied().ok_or_else(|| format!("there is no element with id `{name}`"))
    }

    fn node(
        &mut self,
        node: Node<'a, 'a>,
        pose: &Matrix4<f64>,
        depth: usize,
    ) -> Result<(), String> {
        if depth > DEEPEST {
            return Err("its nodes are nested too deeply".to_owned());
        }
        let mut pose = *pose;
        for child in elements(node) {
            match child.tag_name().name() {
                "matrix" => pose *= Matrix4::from_row_slice(&some::<16>(child)?),
                "translate" => pose *= Matrix4::new_translation(&some::<3>(child)?.into()),
                "scale" => pose *= Matrix4::new_nonuniform_scaling(&some::<3>(child)?.into()),
                "rotate" => {
                    let [x, y, z, degrees] = some::<4>(child)?;
                    let axis = Unit::try_new(Vector3::new(x, y, z), 1e-12);
                    let axis = axis.ok_or("a <rotate> has an axis of length zero")?;
                    let angle = degrees.to_radians();
                    pose *= Rotation3::from_axis_angle(&axis, angle).to_homogeneous();
                }
                "node" => self.node(child, &pose, depth + 1)?,
                "instance_node" => {
                    self.node(self.named(child.attribute("url"))?, &pose, depth + 1)?;
                }
                "instance_geometry" => {
                    self.geometry(self.named(child.attribute("url"))?, &pose)?;
                }
                _ => (),
            }
        }
        Ok(())
    }

    fn geometry(&mut self, geometry: Node<'a, 'a>, pose: &Matrix4<f64>) -> Result<(), String> {
        let Some(mesh) = element(geometry, "mesh") else { return Ok(()) };
        for faces in elements(mesh) {
            let kind = faces.tag_name().name();
            if !["triangles", "polylist", "polygons", "trifans", "tristrips"].contains(&kind) {
                continue;
            }
            let offset = |node: Node| node.attribute("offset").unwrap_or("0").parse::<usize>();
            let inputs = || elements(faces).filter(|node| node.has_tag_name("input"));
            let mut stride = 1;
            for input in inputs() {
                stride = stride.max(1 + offset(input).map_err(|error| error.to_string())?.min(99));
            }
            let corners = inputs().find(|input| input.attribute("semantic") == Some("VERTEX"));
            let corners = corners.ok_or("its faces have no input VERTEX")?;
            let first = self.found.0.len();
            let places = self.places(corners.attribute("source"))?;
            let moved = |at: &Vector3| (pose * Vector4::new(at.x, at.y, at.z, 1.0)).xyz();
            self.found.0.extend(places.iter().map(moved));
            let at = offset(corners).unwrap_or(0);
            let sizes = match element(faces, "vcount") {
                Some(sizes) => Some(list::<usize>(sizes)?),
                None => None,
            };
            for row in elements(faces).filter(|node| node.has_tag_name("p")) {
                let row = list::<usize>(row)?;
                let row: Vec<usize> = row.chunks_exact(stride).map(|corner| corner[at]).collect();
                if row.iter().any(|corner| *corner >= places.len()) {
                    return Err("a face names a corner that does not exist".to_owned());
                }
                let mut left = &row[..];
                let whole = [row.len()];
                let each = vec![3; row.len() / 3];
                let sizes = match kind {
                    "triangles" => &each,
                    "polylist" => sizes.as_deref().unwrap_or(&each),
                    _ => &whole[..],
                };
                for size in sizes {
                    let (face, rest) = left.split_at_checked(*size).ok_or("<p> is too short")?;
                    left = rest;
                    for k in 2..face.len() {
                        let around = if kind == "tristrips" { k - 2 } else { 0 };
                        let triangle = [face[around], face[k - 1], face[k]];
                        self.found.1.push(triangle.map(|corner| (first + corner) as u32));
                    }
                }
                if self.found.1.len() > MOST {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// Returns the corners of a `vertices` element.
    fn places(&self, vertices: Option<&str>) -> Result<Vec<Vector3>, String> {
        let vertices = self.named(vertices)?;
        let input =
            elements(vertices).find(|input| input.attribute("semantic") == Some("POSITION"));
        let source = self.named(input.and_then(|input| input.attribute("source")))?;
        let numbers = element(source, "float_array").ok_or("a source has no <float_array>")?;
        let numbers = list::<f64>(numbers)?;
        let accessor = source.descendants().find(|node| node.has_tag_name("accessor"));
        let stride = accessor.and_then(|accessor| accessor.attribute("stride")?.parse().ok());
        let stride: usize = stride.unwrap_or(3).max(3);
        Ok(numbers.chunks_exact(stride).map(|at| Vector3::new(at[0], at[1], at[2])).collect())
    }
}

/// Returns all numbers of an element.
fn list<T: std::str::FromStr>(node: Node) -> Result<Vec<T>, String> {
    let word = |word: &str| word.parse::<T>().map_err(|_| format!("`{word}` is not a number"));
    node.text().unwrap_or_default().split_whitespace().map(word).collect()
}

/// Returns the `N` numbers of an element.
fn some<const N: usize>(node: Node) -> Result<[f64; N], String> {
    let name = node.tag_name().name();
    list(node)?.try_into().map_err(|_| format!("a <{name}> must have {N} numbers"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = r##"<COLLADA><asset><unit meter="0.001"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="12">0 0 0 10 0 0 10 10 0 0 10 0</float_array>
<technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="NORMAL" source="#s" offset="1"/><vcount>4</vcount><p>0 0 1 0 2 0 3 0</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w">
<node><translate>0 0 5</translate><rotate>0 0 1 90</rotate><instance_geometry url="#g"/></node>
<node><scale>2 1 1</scale><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>"##;

    #[test]
    fn scenes_are_read_in_metres_with_all_their_instances() {
        let (points, faces) = read(FILE.as_bytes()).expect("a scene");
        assert_eq!((points.len(), faces.len()), (8, 4));
        assert!((points[1] - Vector3::new(0.0, 0.01, 0.005)).norm() < 1e-12, "{points:?}");
        assert!((points[6] - Vector3::new(0.02, 0.01, 0.0)).norm() < 1e-12, "{points:?}");
        assert_eq!(faces[3], [4, 6, 7]);
        for cut in 0..FILE.len() {
            let _ = read(&FILE.as_bytes()[..cut]);
        }
        for (good, bad) in
            [("3 0<", "9 0<"), ("url=\"#g", "url=\"#n"), ("<vcount>4", "<vcount>9"), ("5<", "<")]
        {
            assert!(read(FILE.replace(good, bad).as_bytes()).is_err(), "{bad}");
        }
    }
}
