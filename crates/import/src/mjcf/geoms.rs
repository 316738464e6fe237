//! Geoms, each of which becomes one solid.

use std::collections::HashSet;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::Language;
use crate::model::{Material, Outline, Solid, Weight};
use crate::turns;
use crate::xml::Source;

use super::attach::Models;
use super::compiler::Compiler;
use super::defaults::{Defaults, Lookup};
use super::meshes::Meshes;

/// Density of a geom that states neither mass nor density, kg/m^3: MuJoCo's default, water.
const DENSITY: f64 = 1000.0;

/// Friction value of a geom that states none: MuJoCo's default.
const FRICTION: f64 = 1.0;

/// Context needed to read a geom's element.
pub(super) struct Context<'a> {
    pub compiler: Compiler,
    pub defaults: Defaults<'a>,
    /// Meshes that geoms name.
    pub meshes: Meshes<'a>,
    /// Models that the file attaches.
    pub models: Models,
    /// Names of geoms in explicit contact pairs.
    pub paired: HashSet<&'a str>,
    /// Whether equality constraints are enabled.
    pub equality: bool,
}

impl<'a> Context<'a> {
    /// Returns the pose of an element in its parent's frame; `None` with a fault if it is invalid.
    pub fn pose(&self, source: &mut Source<'a>, element: Lookup<'a, '_>) -> Option<Isometry3<f64>> {
        let position = match self.defaults.find(element, "pos") {
            Some(position) => source.numbers::<3>(position)?,
            None => [0.0; 3],
        };
        let turn = self.compiler.turn(source, &self.defaults, element)?;
        Some(Isometry3::from_parts(Translation3::from(position), turn))
    }

    /// Returns the solid of a geom whose parent has the pose `parent`; `None` with faults if it has
    /// none.
    pub fn solid(
        &self,
        source: &mut Source<'a>,
        element: Lookup<'a, '_>,
        parent: &Isometry3<f64>,
    ) -> Option<Solid> {
        let node = element.node;
        let find = |name: &str| self.defaults.find(element, name);
        source.judge(Language::Mjcf, "geom", node, find);
        self.defaults.check(source, node, "class");
        let kind = find("type").map_or("sphere", |kind| kind.value());
        let sizes = match find("size") {
            Some(sizes) => source.list(sizes)?,
            None => Vec::new(),
        };
        let mut pose = self.pose(source, element)?;
        let mut halves = sizes.clone();
        if let Some(ends) = find("fromto") {
            let [a, b, c, d, e, f] = source.numbers(ends)?;
            let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
            // MuJoCo's z axis points from the second point to the first.
            let along = from - to;
            let turn = turns::z_axis(along.into()).unwrap_or_else(UnitQuaternion::identity);
            pose = Isometry3::from_parts(Translation3::from((from + to) / 2.0), turn);
            let width = sizes.first().copied().unwrap_or_default();
            halves = match kind {
                "box" => vec![width, width, along.norm() / 2.0],
                "ellipsoid" => vec![width, width, along.norm() / 2.0],
                _ => vec![width, along.norm() / 2.0],
            };
        }
        // A primitive with a mesh is fitted to it.
        let fitted = find("mesh").filter(|_| !["mesh", "sdf"].contains(&kind));
        if let Some(named) = fitted {
            let scale = match find("fitscale") {
                Some(scale) => source.number(scale)?,
                None => 1.0,
            };
            let (own, sizes) = self.meshes.fitted(source, self, named, kind)?;
            pose *= own;
            halves = sizes.into_iter().map(|size| scale * size).collect();
        }
        let outline = self.outline(source, element, kind, &halves)?;
        let flag = |source: &mut Source<'a>, name: &str| match find(name) {
            Some(bits) => source.number(bits),
            None => Some(1.0),
        };
        let (kinds, with) = (flag(source, "contype")?, flag(source, "conaffinity")?);
        let name = node.attribute("name").unwrap_or_default();
        if [(1.0, 1.0), (0.0, 0.0)].iter().all(|usual| *usual != (kinds, with)) {
            let place = source.place(node);
            let note = "`contype` and `conaffinity` are ignored: all bodies collide";
            source.ledger.note(place, note);
        }
        let touches = kinds != 0.0 || with != 0.0 || self.paired.contains(name);
        Some(Solid {
            name: name.to_owned(),
            place: source.place(node),
            pose: parent * pose,
            material: self.material(source, element, &outline)?,
            outline,
            touches,
        })
    }

    fn material(
        &self,
        source: &mut Source<'a>,
        element: Lookup<'a, '_>,
        outline: &Outline,
    ) -> Option<Material> {
        let find = |name: &str| self.defaults.find(element, name);
        let group = match find("group") {
            Some(group) => source.number(group)?,
            None => 0.0,
        };
        let [first, last] = self.compiler.groups;
        let hollow = find("shellinertia").filter(|shell| shell.value() == "true");
        let weight = match (find("mass"), find("density")) {
            _ if group < first || group > last => Weight::Mass(0.0),
            (Some(mass), _) => Weight::Mass(source.number(mass)?),
            (None, Some(density)) => Weight::Density(source.number(density)?),
            (None, None) => Weight::Density(DENSITY),
        };
        // The mass of a shell follows from its surface area.
        let is_shell =
            hollow.is_some() || matches!(outline, Outline::Mesh(mesh) if mesh.volume == 0.0);
        let weight = match weight {
            Weight::Density(density) if is_shell => Weight::Surface(density),
            weight => weight,
        };
        let friction = match find("friction") {
            Some(values) => source.list(values)?.first().copied().unwrap_or(FRICTION),
            None => FRICTION,
        };
        let rank = match find("priority") {
            Some(rank) => source.number(rank)? as i64,
            None => 0,
        };
        let color = match find("rgba") {
            Some(rgba) => source.numbers(rgba).map(|[red, green, blue, _]: [f64; 4]| {
                [red, green, blue].map(|share| share.clamp(0.0, 1.0))
            }),
            None => None,
        };
        Some(Material { weight, friction: Some(friction), rank, color })
    }

    fn outline(
        &self,
        source: &mut Source<'a>,
        element: Lookup<'a, '_>,
        kind: &str,
        sizes: &[f64],
    ) -> Option<Outline> {
        let node = element.node;
        Some(match (kind, sizes) {
            ("box", [x, y, z]) => Outline::Box([*x, *y, *z]),
            ("cylinder", [radius, half] | [radius, half, _]) => {
                Outline::Cylinder { radius: *radius, half: *half }
            }
            ("sphere", [radius, ..]) => Outline::Sphere(*radius),
            ("plane", [x, y, ..]) => Outline::Plane([*x, *y]),
            ("mesh", _) => {
                let Some(named) = self.defaults.find(element, "mesh") else {
                    source.fault(node, "this geom has the type mesh but no `mesh`", "add `mesh`");
                    return None;
                };
                self.meshes.outline(source, self, named)?
            }
            ("capsule", [radius, half] | [radius, half, _]) => {
                Outline::Capsule { radius: *radius, half: *half }
            }
            ("ellipsoid", [x, y, z]) => Outline::Ellipsoid([*x, *y, *z]),
            ("box" | "cylinder" | "sphere" | "plane" | "capsule" | "ellipsoid", _) => {
                let message = format!("this {kind} has {} sizes", sizes.len());
                let advice = "a box has three half extents, a cylinder radius and half its length";
                source.fault(node, message, advice);
                return None;
            }
            ("hfield" | "sdf", _) => Outline::Other(format!("a {kind}")),
            _ => {
                let message = format!("`{kind}` is not a geom type");
                source.fault(node, message, "write box, cylinder or mesh");
                return None;
            }
        })
    }
}
