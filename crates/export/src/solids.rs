//! MJCF of objects with six degrees of freedom: solids, feet, joints, and the friction of pairs.

use pushplan::geometry::{Pose3, Vector, Vector3};
use pushplan::scene::{Body, Obstacle, Physics, Plate, Scene, Slab, Surface, stands_on};

use super::forest::Node;
use super::hinges;
use super::space::{cuboid, placed};
use super::xml::{Xml, numbers};

/// Largest radius of an object's feet, metres.
const FOOT: f64 = 1e-3;

/// Clearance of the solids of objects on stated points above the table, metres.
const CLEAR: f64 = 5e-4;

/// Colliding solid: its name, its friction value, and its body in the scene, `None` for the table.
pub(super) type Meets = (String, f64, Option<Body>);

/// Scene on the table.
pub(super) struct Stage<'a> {
    pub plates: Vec<Plate>,
    pub obstacles: &'a [Obstacle],
    pub table_friction: f64,
    /// Source scene with its physics; `None` for a lever-up of a data set.
    pub scene: Option<(&'a Scene, Physics)>,
}

impl Stage<'_> {
    /// Returns `true` if two objects are one rigid body.
    pub fn is_rigid(&self, one: usize, other: usize) -> bool {
        let of = self.scene.as_ref().map(|(_, physics)| physics.rigid_groups().of);
        of.is_some_and(|of| of[one] == of[other])
    }

    /// Returns the object index of a plate's solid in the scene.
    fn solid(&self, plate: usize, slab: usize) -> usize {
        let scene = self.scene.as_ref().map(|(scene, _)| scene).filter(|_| slab > 0);
        scene.and_then(|scene| scene.parts_of(plate).nth(slab - 1)).unwrap_or(plate)
    }

    /// Returns the coefficient of friction of a pair.
    pub fn friction(&self, (_, one, a): &Meets, (_, other, b): &Meets) -> f64 {
        let surface = match b {
            None => Surface::Table,
            Some(Body::Object(k)) => Surface::Object(*k),
            Some(Body::Obstacle(k)) => Surface::Obstacle(*k),
            Some(Body::Part(_)) => Surface::Tool,
        };
        match (&self.scene, a) {
            (Some((_, physics)), Some(Body::Object(own))) => {
                physics.friction(*own, surface, *other)
            }
            _ => 0.5 * (one + other),
        }
    }
}

/// Writes an object and everything attached to it; `found` collects their solids.
pub(super) fn body(
    xml: &mut Xml,
    stage: &Stage,
    (k, node): (usize, Option<&Node>),
    found: &mut [Vec<Meets>],
) {
    let hung = |xml: &mut Xml, found: &mut [Vec<Meets>]| {
        for child in node.map(|node| &node.children).into_iter().flatten() {
            body(xml, stage, (child.object, Some(child)), found);
        }
    };
    // A part is a solid of the body that is being written.
    let Some(plate) = stage.plates.get(k) else { return hung(xml, found) };
    let mut attributes = vec![("name", format!("plate/{}", plate.name))];
    let scene = stage.scene.as_ref().map(|(scene, _)| *scene);
    let parent = node.and_then(|node| node.parent);
    let start = match (parent, scene) {
        (Some((parent, _)), Some(scene)) => {
            stage.plates[scene.thing(parent)].start().inverse() * plate.start()
        }
        _ => plate.start(),
    };
    attributes.extend(placed(&start));
    xml.open("body", &attributes);
    let mount = scene.and_then(|scene| Some((scene, scene.mount(k)?)));
    match (parent, scene, mount) {
        (Some((_, link)), Some(scene), _) => hinges::joint(xml, scene, k, link),
        (None, _, Some((scene, mount))) => hinges::mount(xml, scene, mount),
        _ => xml.leaf("freejoint", &[]),
    }
    found[k] = solids(xml, stage, k);
    hung(xml, found);
    xml.close();
}

/// Writes the solids and feet of an object, with its mass.
fn solids(xml: &mut Xml, stage: &Stage, k: usize) -> Vec<Meets> {
    let plate = &stage.plates[k];
    let own = stage.scene.as_ref();
    let masses = own.map(|(_, physics)| &physics.masses);
    let weight = match masses {
        Some(masses) => {
            let own = (0..plate.slabs.len()).map(|slab| masses[stage.solid(k, slab)]);
            plate.weight_of(&own.collect::<Vec<_>>())
        }
        None => plate.weight(),
    };
    let [x, y, z] = weight.centre.into();
    let attributes = [
        ("pos", numbers(&[x, y, z])),
        ("mass", numbers(&[weight.mass])),
        ("fullinertia", numbers(&weight.inertia)),
    ];
    xml.leaf("inertial", &attributes);
    let height = if plate.has_feet() { plate.z } else { 0.0 };
    let corners = || (height > 0.0).then(|| plate.corners().to_vec());
    let feet = own.map_or_else(corners, |(scene, physics)| stands_on(scene, k, physics));
    let mut solids = Vec::new();
    for (s, slab) in plate.slabs.iter().enumerate() {
        let name = slab_name(plate, s);
        let Slab { corners, bottom, height: thick } = slab;
        let lifted = if height == 0.0 && *bottom == 0.0 && feet.is_some() { CLEAR } else { 0.0 };
        // Boxes have more contact points in MuJoCo than meshes.
        if let Some((middle, size)) = upright_rectangle(corners) {
            let position = Vector3::new(middle.x, middle.y, bottom + 0.5 * (thick + lifted));
            let pose = Pose3 { position, ..Pose3::default() };
            cuboid(xml, &name, [size[0], size[1], thick - lifted], &pose);
        } else {
            let mesh = [
                ("name", name.clone()),
                ("type", "mesh".into()),
                ("mesh", name.clone()),
                ("mass", "0".into()),
                ("pos", numbers(&[0.0, 0.0, lifted])),
            ];
            xml.leaf("geom", if lifted > 0.0 { &mesh } else { &mesh[..4] });
        }
        let solid = stage.solid(k, s);
        let friction = own.map_or(plate.friction, |(_, physics)| physics.frictions[solid]);
        solids.push((name, friction, Some(Body::Object(solid))));
    }
    let radius = if height > 0.0 { FOOT.min(0.5 * height) } else { FOOT };
    for (f, at) in feet.into_iter().flatten().enumerate() {
        let name = format!("plate/{}/foot-{}", plate.name, f + 1);
        let foot = [
            ("name", name.clone()),
            ("type", "sphere".into()),
            ("size", numbers(&[radius])),
            ("mass", "0".into()),
            ("pos", numbers(&[at.x, at.y, radius - height])),
        ];
        xml.leaf("geom", &foot);
        solids.push((name, plate.friction, Some(Body::Object(k))));
    }
    solids
}

/// Returns the middle and the extents of an axis-aligned rectangle; `None` for other polygons.
fn upright_rectangle(corners: &[Vector]) -> Option<(Vector, [f64; 2])> {
    let [a, b, c, d] = *corners else { return None };
    let along = |one: f64, other: f64| (one - other).abs() < 1e-12;
    let is_upright = along(a.y, b.y) && along(b.x, c.x) && along(c.y, d.y) && along(d.x, a.x);
    is_upright.then(|| (0.5 * (a + c), [b.x - a.x, d.y - a.y]))
}

pub(super) fn slab_name(plate: &Plate, index: usize) -> String {
    format!("plate/{}/slab-{}", plate.name, index + 1)
}
