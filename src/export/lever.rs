//! A lever-up as a scene of MuJoCo (MJCF), the motion of the blade included.
//!
//! Plates are bodies of meshes and boxes on the same feet as in our engine; the table is a cuboid and
//! the blade a heavy free body without weight whose pose *and* velocity the script sets before every step: a
//! `mocap` body has no velocity. Friction is the mean of the two values, pair by pair.

use crate::geometry::{Pose3, Vector, Vector3};
use crate::scene::{GRAVITY, LEVER_FRAMES, LeverJob, Plate, Slab};

use super::xml::{Xml, numbers};

/// Plays scenes that [`lever_mjcf()`] wrote and says where the plates come to.
pub const LEVER_SCRIPT: &str = pushplan_page::LEVER;

/// Of a step, seconds. What slides in MuJoCo is pushed off a little, less in finer and harder steps: with
/// twice this and softer contacts plates slide 3 mm where they hardly do in ours, with this 1.5 mm.
const STEP: f64 = 2.5e-4;

/// How contacts give way. On the pairs themselves: defaults of geometries do not reach them.
const CONTACT: [(&str, &str); 3] =
    [("condim", "3"), ("solref", "0.002 1"), ("solimp", "0.9 0.95 0.001")];

/// How much harder friction is than the load.
const FRICTION_HARDNESS: f64 = 10.0;

/// So heavy that nothing moves it, kg.
const BLADE_MASS: f64 = 1e4;

/// Largest radius of a plate's feet, metres.
const FOOT: f64 = 1e-3;

/// A solid that plates can meet, and its friction value.
type Meets = (String, f64);

/// The scene of a job, as MJCF. Names are `plate/NAME`, `block/NAME`, `blade` and `table`; what the
/// blade does stands under `custom`.
pub fn lever_mjcf(job: &LeverJob) -> String {
    let LeverJob { scene, lever } = job;
    let mut xml = Xml::default();
    xml.open("mujoco", &[("model", "lever-up".into())]);
    xml.leaf("compiler", &[("angle", "radian".into()), ("autolimits", "true".into())]);
    let option = [
        ("timestep", numbers(&[STEP])),
        ("gravity", numbers(&[0.0, 0.0, -GRAVITY])),
        ("cone", "elliptic".into()),
        ("impratio", numbers(&[FRICTION_HARDNESS])),
    ];
    xml.open("option", &option);
    xml.leaf("flag", &[("multiccd", "enable".into())]);
    xml.close();
    xml.open("default", &[]);
    xml.comment("Only the pairs at the end touch.");
    xml.leaf("geom", &[("contype", "0".into()), ("conaffinity", "0".into())]);
    xml.leaf("pair", &CONTACT.map(|(key, value)| (key, value.to_owned())));
    xml.close();
    xml.open("custom", &[]);
    let frame = lever.frame(scene);
    let [x, y, z, w] = frame.quaternion();
    let at = frame.position;
    numeric(&mut xml, "frame", &[at.x, at.y, at.z, w, x, y, z]);
    let blade = &scene.blade;
    numeric(&mut xml, "blade", &[blade.length, blade.thickness]);
    let motion = [
        lever.depth,
        lever.pivot,
        lever.angle,
        lever.turn_time(),
        lever.hold,
        lever.retreat,
        lever.speed,
        LEVER_FRAMES as f64,
    ];
    numeric(&mut xml, "lever", &motion);
    numeric(&mut xml, &format!("levered plate/{}", scene.plates[lever.plate].name), &[1.0]);
    xml.close();
    meshes(&mut xml, &scene.plates);
    xml.open("worldbody", &[]);
    let mut others: Vec<Meets> = vec![("table".to_owned(), scene.table_friction)];
    let lying = Pose3 { position: Vector3::new(0.0, 0.0, -0.25), ..Pose3::default() };
    cuboid(&mut xml, "table", [4.0, 4.0, 0.5], &lying);
    for block in &scene.blocks {
        let name = format!("block/{}", block.name);
        let middle = Pose3::upright(block.pose, block.z + 0.5 * block.size[2]);
        cuboid(&mut xml, &name, block.size, &middle);
        others.push((name, block.friction));
    }
    let mut plates: Vec<Vec<Meets>> = Vec::new();
    for plate in &scene.plates {
        plates.push(body(&mut xml, plate));
    }
    let start = lever.blade(scene, 0.0);
    // Without gravity: the solver would see blade and plate fall together, and let the plate creep down
    // the blade at some millimetres a second.
    let mut attributes = vec![("name", "blade".to_owned()), ("gravcomp", "1".to_owned())];
    attributes.extend(placed(&start));
    xml.open("body", &attributes);
    xml.leaf("freejoint", &[]);
    let inertia = numbers(&[BLADE_MASS; 3]);
    let mass = numbers(&[BLADE_MASS]);
    xml.leaf("inertial", &[("pos", "0 0 0".into()), ("mass", mass), ("diaginertia", inertia)]);
    let size = [blade.length, blade.width, blade.thickness];
    cuboid(&mut xml, "blade", size, &Pose3::default());
    others.push(("blade".to_owned(), blade.friction));
    xml.close();
    xml.close();
    xml.open("contact", &[]);
    for (k, solids) in plates.iter().enumerate() {
        for one in solids {
            for other in others.iter().chain(plates[k + 1..].iter().flatten()) {
                pair(&mut xml, one, other);
            }
        }
    }
    xml.finish()
}

fn pair(xml: &mut Xml, (a, one): &Meets, (b, other): &Meets) {
    let mean = 0.5 * (one + other);
    let friction = numbers(&[mean, mean]);
    xml.leaf("pair", &[("geom1", a.clone()), ("geom2", b.clone()), ("friction", friction)]);
}

/// The outlines of slabs that are no rectangles.
fn meshes(xml: &mut Xml, plates: &[Plate]) {
    xml.open("asset", &[]);
    for plate in plates {
        for (k, slab) in plate.slabs.iter().enumerate() {
            let ring = |z: f64| slab.corners.iter().flat_map(move |corner| [corner.x, corner.y, z]);
            let vertices: Vec<f64> =
                ring(slab.bottom).chain(ring(slab.bottom + slab.height)).collect();
            xml.leaf("mesh", &[("name", slab_name(plate, k)), ("vertex", numbers(&vertices))]);
        }
    }
    xml.close();
}

/// A plate; its solids.
fn body(xml: &mut Xml, plate: &Plate) -> Vec<Meets> {
    let name = format!("plate/{}", plate.name);
    let mut attributes = vec![("name", name.clone())];
    attributes.extend(placed(&plate.start()));
    xml.open("body", &attributes);
    xml.leaf("freejoint", &[]);
    let weight = plate.weight();
    let [x, y, z] = weight.centre.into();
    let attributes = [
        ("pos", numbers(&[x, y, z])),
        ("mass", numbers(&[weight.mass])),
        ("fullinertia", numbers(&weight.inertia)),
    ];
    xml.leaf("inertial", &attributes);
    let mut solids = Vec::new();
    for (k, slab) in plate.slabs.iter().enumerate() {
        let name = slab_name(plate, k);
        let Slab { corners, bottom, height } = slab;
        // MuJoCo's boxes meet on more points than its meshes.
        if let Some((middle, size)) = upright_rectangle(corners) {
            let position = Vector3::new(middle.x, middle.y, bottom + 0.5 * height);
            let pose = Pose3 { position, ..Pose3::default() };
            cuboid(xml, &name, [size[0], size[1], *height], &pose);
        } else {
            let mesh = [
                ("name", name.clone()),
                ("type", "mesh".into()),
                ("mesh", name.clone()),
                ("mass", "0".into()),
            ];
            xml.leaf("geom", &mesh);
        }
        solids.push((name, plate.friction));
    }
    let height = if plate.has_feet() { plate.z } else { 0.0 };
    let radius = FOOT.min(0.5 * height);
    for (k, corner) in plate.corners().iter().enumerate().filter(|_| height > 0.0) {
        let name = format!("plate/{}/foot-{}", plate.name, k + 1);
        let foot = [
            ("name", name.clone()),
            ("type", "sphere".into()),
            ("size", numbers(&[radius])),
            ("mass", "0".into()),
            ("pos", numbers(&[corner.x, corner.y, radius - height])),
        ];
        xml.leaf("geom", &foot);
        solids.push((name, plate.friction));
    }
    xml.close();
    solids
}

/// Middle and extents of a rectangle along the axes.
fn upright_rectangle(corners: &[Vector]) -> Option<(Vector, [f64; 2])> {
    let [a, b, c, d] = *corners else { return None };
    let along = |one: f64, other: f64| (one - other).abs() < 1e-12;
    let is_upright = along(a.y, b.y) && along(b.x, c.x) && along(c.y, d.y) && along(d.x, a.x);
    is_upright.then(|| (0.5 * (a + c), [b.x - a.x, d.y - a.y]))
}

fn slab_name(plate: &Plate, index: usize) -> String {
    format!("plate/{}/slab-{}", plate.name, index + 1)
}

fn cuboid(xml: &mut Xml, name: &str, size: [f64; 3], pose: &Pose3) {
    let mut attributes = vec![
        ("name", name.to_owned()),
        ("type", "box".into()),
        ("size", numbers(&size.map(|extent| 0.5 * extent))),
        ("mass", "0".into()),
    ];
    attributes.extend(placed(pose));
    xml.leaf("geom", &attributes);
}

fn placed(pose: &Pose3) -> [(&'static str, String); 2] {
    let [x, y, z, w] = pose.quaternion();
    [("pos", numbers(pose.position.as_slice())), ("quat", numbers(&[w, x, y, z]))]
}

fn numeric(xml: &mut Xml, name: &str, values: &[f64]) {
    xml.leaf("numeric", &[("name", name.into()), ("data", numbers(values))]);
}
