//! Kinds of shapes that were read wrongly or refused: each with several variants.

use std::f64::consts::PI;

use pushplan_import::{Wanted, parse, tool};

use super::{extents, mjcf, taken};

#[test]
fn meshes_are_moved_and_turned_before_they_are_scaled() {
    let part = |mesh: &str| {
        mjcf("<body name='p' pos='.5 .1 0'><freejoint/><geom type='mesh' mesh='m' mass='.3'/></body>")
            .replace("<mujoco>", &format!("<mujoco><asset><mesh name='m' {mesh}/></asset>"))
    };
    let block = |[x, y]: [i32; 2], [a, b, c]: [i32; 3]| {
        let corner =
            |k: i32| format!("{} {} {}", x + a * (k & 1), y + b * (k >> 1 & 1), c * (k >> 2));
        (0..8).map(corner).collect::<Vec<_>>().join(" ")
    };
    let half = "0.7071067811865476";
    let moved =
        format!("scale='.0254 .0254 .0254' refpos='10 4 0' vertex='{}'", block([10, 4], [3, 2, 2]));
    let (task, _) = taken(&part(&moved)).expect("a task");
    assert_eq!(extents(&task, 0), [762, 508, 508, 5381, 1254]);
    let turned = format!(
        "scale='.03 .06 .04' refquat='{half} 0 0 {half}' vertex='{}'",
        block([0, 0], [3, 1, 1])
    );
    let (task, _) = taken(&part(&turned)).expect("a task");
    assert_eq!(extents(&task, 0)[..3], [300, 1800, 400]);
    let mirrored = format!("scale='-.03 .06 .04' vertex='{}'", block([0, 0], [3, 1, 1]));
    let (task, _) = taken(&part(&mirrored)).expect("a task");
    assert_eq!(extents(&task, 0)[..3], [900, 600, 400]);
    assert!((task.scene.objects[0].mass - 0.3).abs() < 1e-9);
}

#[test]
fn spheres_at_corners_are_contact_points() {
    let ball = |x: f64, y: f64, z: f64| {
        format!(
            "<collision><origin xyz='{x} {y} {z}'/><geometry><sphere radius='1e-7'/></geometry></collision>"
        )
    };
    let corners: String = (0..8)
        .map(|k| ball([-0.05, 0.05][k & 1], [-0.04, 0.04][k >> 1 & 1], [0.0, 0.06][k >> 2]))
        .collect();
    let link = |more: &str| {
        format!(
            "<robot name='r'><link name='a'><inertial><origin xyz='0 0 .03'/><mass value='.5'/></inertial>\
             <collision><origin xyz='0 0 .03'/><geometry><box size='.1 .08 .06'/></geometry></collision>{more}</link></robot>"
        )
    };
    let (task, notes) = taken(&link(&corners)).expect("a task");
    assert_eq!(
        (task.scene.objects.len(), extents(&task, 0)[..3].to_vec()),
        (1, vec![1000, 800, 600])
    );
    assert!(notes.contains("4 spheres are contact points"), "{notes}");
    let (task, _) = taken(&link(&(corners + &ball(0.0, 0.0, 0.03)))).expect("a task");
    assert_eq!(task.scene.objects.len(), 1);
    // A large sphere on top is a solid of its own.
    let knob =
        "<collision><origin xyz='0 0 .07'/><geometry><sphere radius='.02'/></geometry></collision>";
    assert_eq!(taken(&link(knob)).expect("a task").0.scene.objects.len(), 2);
}

#[test]
fn outlines_with_small_bevels_and_thin_walls_are_prisms() {
    let prism = |corners: &[[f64; 2]]| {
        let ring = |z: f64| corners.iter().map(move |[x, y]| format!("{x} {y} {z}"));
        let vertices: Vec<String> = ring(0.0).chain(ring(0.04)).collect();
        mjcf(
            "<body name='p' pos='.5 0 0'><freejoint/><geom type='mesh' mesh='m' mass='.1'/></body>",
        )
        .replace(
            "<mujoco>",
            &format!("<mujoco><asset><mesh name='m' vertex='{}'/></asset>", vertices.join(" ")),
        )
    };
    for bevel in [1e-4, 5e-4, 9e-4, 2e-3] {
        let (x, y) = (0.04, 0.03);
        let corners = [
            [x - bevel, 0.0],
            [x, bevel],
            [x, y - bevel],
            [x - bevel, y],
            [bevel, y],
            [0.0, y - bevel],
            [0.0, bevel],
            [bevel, 0.0],
        ];
        let text = prism(&corners);
        let (task, _) = taken(&text).unwrap_or_else(|faults| panic!("{bevel}: {faults}"));
        let area = task.scene.objects[0].shape.footprint().area();
        assert!((area - (x * y - 2.0 * bevel * bevel)).abs() < 2e-6, "{bevel}: {area}");
        let (model, _) = parse(&text, "f").expect("a model");
        tool(&model, "f", &Wanted::default()).unwrap_or_else(|faults| panic!("{bevel}: {faults}"));
    }
    for thin in [9e-4, 4e-4] {
        let wall = [[0.0, 0.0], [0.08, 0.0], [0.08, thin], [0.0, thin]];
        let (task, _) = taken(&prism(&wall)).expect("a task");
        let [x, y, ..] = extents(&task, 0);
        assert!((795..=805).contains(&x) && (4..=13).contains(&y), "{x} {y}");
    }
}

#[test]
fn a_tool_of_a_mesh_has_the_note_on_its_outline() {
    let leaf: String = (0..16)
        .flat_map(|k| {
            let angle = PI * f64::from(k) / 8.0;
            let [x, y] = [0.1 * angle.cos(), 0.01 * angle.sin()];
            [format!("{x} {y} 0"), format!("{x} {y} .012")]
        })
        .collect::<Vec<_>>()
        .join(" ");
    let text = format!(
        "<mujoco><asset><mesh name='m' vertex='{leaf}'/></asset><worldbody><body name='leaf'><geom type='mesh' mesh='m'/></body></worldbody></mujoco>"
    );
    let (model, _) = parse(&text, "f").expect("a model");
    let made = tool(&model, "f", &Wanted::default()).expect("a tool");
    assert!(
        made.notes.iter().any(|note| note.contains("sides deviate by up to 6.")),
        "{:?}",
        made.notes
    );
}
