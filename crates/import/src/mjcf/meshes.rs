//! Meshes that geoms name: from files, or with vertices in the file itself.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion};
use roxmltree::{Attribute, Node};

use crate::foreign::Files;
use crate::mesh::{Counted, Mesh, load};
use crate::model::Outline;
use crate::turns;
use crate::xml::Source;

use super::defaults::Lookup;
use super::geoms::Context;

/// Elements `mesh` by name, and a cache of the meshes already read.
pub(super) struct Meshes<'a> {
    files: &'a Files,
    stated: HashMap<String, Node<'a, 'a>>,
    read: RefCell<HashMap<String, Option<Outline>>>,
}

impl<'a> Meshes<'a> {
    /// Creates an empty collection; mesh files are looked up in `files`.
    pub fn of(files: &'a Files) -> Self {
        Self { files, stated: HashMap::new(), read: RefCell::default() }
    }

    /// Adds a mesh element.
    pub fn add(&mut self, name: &str, mesh: Node<'a, 'a>) {
        self.stated.insert(name.to_owned(), mesh);
    }

    /// Returns the outline of the mesh with this name; `None` with a fault if there is none.
    pub fn outline(
        &self,
        source: &mut Source<'a>,
        context: &Context<'a>,
        named: Attribute<'a, 'a>,
    ) -> Option<Outline> {
        let Some(mesh) = self.stated.get(named.value()).copied() else {
            let message = format!("there is no mesh `{}`", named.value());
            source.fault_of(named, message, "name one of those under <asset>");
            return None;
        };
        if let Some(known) = self.read.borrow().get(named.value()) {
            return known.clone();
        }
        let found = self.shape(source, context, mesh);
        self.read.borrow_mut().insert(named.value().to_owned(), found.clone());
        found
    }

    fn shape(
        &self,
        source: &mut Source<'a>,
        context: &Context<'a>,
        mesh: Node<'a, 'a>,
    ) -> Option<Outline> {
        let element = Lookup { node: mesh, class: None };
        let find = |name: &str| context.defaults.find(element, name);
        if find("builtin").is_some() {
            return Some(Outline::Other("a mesh that MuJoCo makes itself".to_owned()));
        }
        let counted = match find("inertia").map(|inertia| inertia.value()) {
            Some("convex") => Counted::Hull,
            Some("exact") => Counted::Enclosed,
            Some("shell") => Counted::Shell,
            None if context.compiler.exact => Counted::Enclosed,
            _ => Counted::Unsigned,
        };
        let scale = match find("scale") {
            Some(scale) => source.numbers::<3>(scale)?,
            None => [1.0; 3],
        };
        let moved = match find("refpos") {
            Some(position) => source.numbers::<3>(position)?,
            None => [0.0; 3],
        };
        let turn = match find("refquat") {
            Some(quaternion) => turns::quaternion(source.numbers(quaternion)?)?,
            None => UnitQuaternion::identity(),
        };
        let (points, mut faces) = match (find("vertex"), find("file")) {
            (Some(vertices), _) => {
                let numbers = source.list(vertices)?;
                if numbers.len() < 12 || !numbers.len().is_multiple_of(3) {
                    let count = numbers.len();
                    let message = format!("a mesh has 4 vertices or more, not {count} numbers");
                    source.fault_of(vertices, message, "write x, y and z of each");
                    return None;
                }
                let corners = match find("face") {
                    Some(faces) => source.list(faces)?,
                    None => Vec::new(),
                };
                let corner = |three: &[f64]| [0, 1, 2].map(|k| three[k] as u32);
                let points = numbers.chunks_exact(3).map(|xyz| Point3::new(xyz[0], xyz[1], xyz[2]));
                (points.collect(), corners.chunks_exact(3).map(corner).collect::<Vec<[u32; 3]>>())
            }
            (None, Some(file)) => {
                let stripped = Path::new(file.value()).file_name().unwrap_or_default();
                let name = match context.compiler.strip {
                    true => stripped.to_string_lossy().into_owned(),
                    false => file.value().to_owned(),
                };
                let path = self.files.find(&context.compiler.meshes, &name);
                match path.and_then(|path| load(&path)) {
                    Ok(raw) => raw,
                    Err(refused) => {
                        let what = format!("{} ({})", refused.message, refused.advice);
                        return Some(Outline::Other(format!("a mesh that cannot be read: {what}")));
                    }
                }
            }
            (None, None) => return Some(Outline::Other("a mesh without vertices".to_owned())),
        };
        // Mirroring turns a mesh inside out.
        if scale.iter().product::<f64>() < 0.0 {
            faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        let frame = Isometry3::from_parts(Translation3::from(moved), turn);
        let point = |point: Point3<f64>| {
            let [x, y, z] = [0, 1, 2].map(|axis| point[axis] * scale[axis]);
            frame.inverse_transform_point(&Point3::new(x, y, z))
        };
        let points: Vec<Point3<f64>> = points.into_iter().map(point).collect();
        match Mesh::new(points, faces, counted) {
            Some(mesh) => Some(Outline::Mesh(Arc::new(mesh))),
            None => {
                Some(Outline::Other("a mesh that is flat, or whose numbers are none".to_owned()))
            }
        }
    }
}
