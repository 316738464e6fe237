//! Import of files that other programs could have written.

use insta::assert_snapshot;
use pushplan::{Shape, Vector};
use pushplan::{
    scene::{JointKind, Surface},
    task::Task,
};
use pushplan_import::{Model, Wanted, objects, parse, tool};

const KITCHEN: &str = include_str!("../../cmd/import.in/kitchen.xml");

fn scene(text: &str, wanted: &Wanted) -> Task {
    let (model, ..) = parse(text, "scene.xml").unwrap_or_else(|faults| panic!("{faults}"));
    let made = objects(&model, "scene.xml", wanted);
    made.unwrap_or_else(|faults| panic!("{faults}")).value.task
}

/// Returns all faults of a text.
fn faults(text: &str, as_tool: bool) -> String {
    let wanted = Wanted::default();
    let strict = |(model, _)| Model { strict: true, ..model };
    let found = parse(text, "f.xml").map(strict).and_then(|model| match as_tool {
        true => tool(&model, "f.xml", &wanted).map(|_| ()),
        false => objects(&model, "f.xml", &wanted).map(|_| ()),
    });
    found.expect_err("faults").to_string()
}

fn mjcf(bodies: &str) -> String {
    format!("<mujoco><worldbody><geom type='plane' size='1 1 1'/>{bodies}</worldbody></mujoco>")
}

#[test]
fn a_scene_of_mujoco_becomes_a_task() {
    let task = scene(KITCHEN, &Wanted::default());
    assert_snapshot!(task.to_yaml().unwrap());
    // 2000 kg/m^3 and 6 x 4 x 10 cm, resting on its second-largest face.
    let lying = &task.scene.objects[1];
    assert!((lying.mass - 0.48).abs() < 1e-12 && (lying.shape.height() - 0.06).abs() < 1e-12);
    // The maximum of 0.6 and 0.6 equals their mean; the maximum of 0.3 and 0.6 does not.
    let pair = |name: &str| {
        let object = task.scene.objects.iter().position(|object| object.name == name);
        task.scene
            .frictions
            .iter()
            .find(|pair| Some(pair.object) == object && pair.with == Surface::Table)
    };
    assert!(pair("can").is_none());
    assert_eq!(pair("lying-box").map(|pair| pair.coefficient), Some(0.6));
    let JointKind::Revolute { at, limits: Some(limits) } = task.scene.joints[0].kind else {
        panic!("{:?}", task.scene.joints)
    };
    assert!((at - Vector::new(0.32, -0.2)).norm() < 1e-12);
    let [low, high] = [limits.low, limits.high].map(f64::to_degrees);
    assert!((low + 60.0).abs() < 1e-9 && (high - 30.0).abs() < 1e-9, "turned by its axis");
}

#[test]
fn chosen_bodies_are_imported_and_everything_can_be_shifted() {
    let wanted = Wanted {
        bodies: vec!["can".into(), "lying box".into()],
        shift: Vector::new(0.1, -0.2),
        ..Wanted::default()
    };
    let scene = scene(KITCHEN, &wanted).scene;
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["can", "lying-box"]);
    assert!((scene.objects[0].pose.position - Vector::new(0.5, -0.1)).norm() < 1e-12);
    assert!((scene.obstacles[0].pose.position - Vector::new(0.9, -0.2)).norm() < 1e-12);
}

#[test]
fn a_robot_of_fixed_links_becomes_a_tool() {
    let text = include_str!("../../cmd/import.in/hook.urdf");
    let (model, ..) = parse(text, "hook.urdf").unwrap();
    let made = tool(&model, "hook.urdf", &Wanted::default());
    // Gazebo's friction applies only to the handle.
    let text = made.expect_err("two frictions").to_string();
    assert!(
        text.contains("hook.urdf:10:5: error: parts have different frictions, 0.4 and 0.5"),
        "{text}"
    );
    let wanted = Wanted { friction: 0.4, name: Some("my-hook".into()), ..Wanted::default() };
    assert_snapshot!(tool(&model, "hook.urdf", &wanted).unwrap().value.to_yaml().unwrap());
}

#[test]
fn a_centre_of_mass_off_the_middle_makes_a_box_a_prism_about_it() {
    let body = "<body name='b' pos='0.5 0 0.03'><freejoint/>
        <inertial pos='0.01 0 0' mass='0.4' diaginertia='1e-3 1e-3 1e-3'/>
        <geom type='box' size='0.04 0.03 0.03'/></body>";
    let object = &scene(&mjcf(body), &Wanted::default()).scene.objects[0];
    let Shape::Prism { base, .. } = object.shape else { panic!("{object:?}") };
    assert!((object.pose.position - Vector::new(0.51, 0.0)).norm() < 1e-12);
    assert!((base.extent(Vector::x()) - 0.03).abs() < 1e-12);
    assert!((base.extent(-Vector::x()) - 0.05).abs() < 1e-12);
}

#[test]
fn several_solids_of_a_body_are_parts_of_one_object() {
    let body = "<body name='t' pos='0.5 0 0.03'><freejoint/>
        <geom name='bar' type='box' size='0.04 0.01 0.03'/>
        <geom name='stem' type='box' size='0.01 0.04 0.03' pos='0 0.05 0'/></body>";
    let scene = scene(&mjcf(body), &Wanted::default()).scene;
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!((names, scene.joints[0].kind), (vec!["t", "t/1"], JointKind::Fixed));
    assert!((scene.objects[0].mass - 8.0 * 0.04 * 0.01 * 0.03 * 1000.0).abs() < 1e-12);
}

#[test]
fn unsupported_elements_are_errors_with_location() {
    let text = include_str!("../../cmd/import.in/bad.xml");
    assert_snapshot!(faults(text, false));
}

#[test]
fn each_unsupported_element_is_refused() {
    let free = |inside: &str| {
        mjcf(&format!("<body name='b' pos='0.5 0 0.05'><freejoint/>{inside}</body>"))
    };
    let box_ = "<geom type='box' size='.05 .05 .05'/>";
    for (text, expected) in [
        (free("<geom type='capsule' size='.05 .05'/>"), "is a capsule"),
        (free("<geom type='sphere' size='.05'/>"), "`b` is a sphere, which rolls"),
        (free("<site/>"), "`b` has no solid that collides"),
        (free("<geom type='cylinder' size='.05 .05' euler='90 0 0'/>"), "`b` lies on its side"),
        (free("<geom type='box' size='.05 .05 .05' euler='10 0 0'/>"), "`b` is tilted"),
        (free("<geom type='box' size='.05 .05 .05' class='x'/>"), "there is no class `x`"),
        (free("<geom type='box' size='.05 .05'/>"), "has 2 sizes"),
        (free("<geom type='box' size='.05 .05 nan'/>"), "not a number"),
        (free(&format!("{box_}<composite/>")), "<composite> is not supported"),
        (
            free(&format!("{box_}<body><joint type='ball'/>{box_}</body>")),
            "is attached to another body by a ball joint",
        ),
        (
            free(&format!("{box_}<body><joint axis='1 0 0'/>{box_}</body>")),
            "is attached to another body by a hinge",
        ),
        (
            free(&format!("{box_}<body pos='.2 0 0'><joint stiffness='1'/>{box_}</body>")),
            "stiffness=\"1\" of this joint is not supported",
        ),
        (mjcf(&format!("<body name='arm'><joint axis='1 0 0'/>{box_}</body>")), "`arm` is attached to the world by a hinge"),
        (mjcf("<body name='can'/>"), "no body of the file moves freely"),
        (
            free(box_).replace("</worldbody>", "<body name='c' pos='0.5 0.3 0.4'><freejoint/><geom type='box' size='.1 .1 .1'/></body></worldbody>"),
            "`c` is 300.0 mm above the underside of the lowest object",
        ),
        (free(box_).replace("0.5 0 0.05", "0.5 0 0.4"), "350.0 mm above this plane"),
        (free(box_).replace("<worldbody>", "<option gravity='0 0 -1.6'/><worldbody>"), "gravity is 0 0 -1.6"),
        (free(box_).replace("<worldbody>", "<compiler eulerseq='xyzx'/><worldbody>"), "eulerseq=\"xyzx\" is not supported"),
        (free(box_).replace("</worldbody>", "</worldbody><equality><weld/></equality>"), "<weld> is not supported"),
        (free(&box_.replace("/>", " mass='0'/>")), "`b` has no mass"),
        (free(&box_.replace("/>", " mass='1e7'/>")), "as a task: expected a mass in kg"),
        ("<robot name='r'><link name='a'><visual/></link></robot>".into(), "has no geometry"),
        ("<robot name='r'><link name='a'><collision><geometry><box size='1 2'/></geometry></collision></link></robot>".into(), "has 2 numbers instead of 3"),
        ("<robot><link name='a'/><link name='a'/></robot>".into(), "two links are called `a`"),
        ("<robot><link name='a'/><link name='b'/><joint type='fixed'><parent link='a'/><child link='b'/></joint><joint type='fixed'><parent link='b'/><child link='a'/></joint></robot>".into(), "form a loop"),
        (mjcf(&format!("{}{}", "<body>".repeat(20_000), "</body>".repeat(20_000))), "more than 200 levels of bodies"),
        ("<sdf/>".into(), "<sdf> is neither"),
        ("<mujoco".into(), "this is not valid XML"),
    ] {
        let found = faults(&text, false);
        assert!(found.contains(expected), "{text}\n{found}\nnot: {expected}");
    }
}

#[test]
fn a_hand_of_an_arm_becomes_a_tool() {
    let box_ = "<geom type='box' size='.05 .05 .05'/>";
    let arm = |hand: &str| {
        let link = format!("<joint axis='0 1 0' stiffness='9'/>{box_}{hand}");
        mjcf(&format!(
            "<body name='base'>{box_}<body name='link' pos='0 0 .4'>{link}</body></body>"
        ))
    };
    let hand = |name: &str| {
        let palm = "<geom type='box' size='.02 .06 .03'/>";
        format!("<body name='{name}' pos='.1 0 -.2'>{palm}<body name='eef'/></body>")
    };
    let taken = |text: &str, bodies: &[&str]| {
        let bodies = bodies.iter().map(|name| (*name).to_owned()).collect();
        let (model, ..) = parse(text, "f.xml").expect("a model");
        tool(&model, "f.xml", &Wanted { bodies, ..Wanted::default() })
    };
    // A body called `tool` is the tool, at any place in the tree; other bodies must be named.
    for (name, bodies) in [("tool", &[][..]), ("palm", &["palm"])] {
        let made = taken(&arm(&hand(name)), bodies).unwrap_or_else(|faults| panic!("{faults}"));
        let [part] = made.value.parts() else { panic!("{:?}", made.value) };
        assert_eq!(part.shape, Shape::Cuboid { size: [0.04, 0.12, 0.06] });
        assert_eq!(part.pose.position, Vector::zeros());
    }
    for (bodies, expected) in [
        (&[][..], "`link` moves relative to the tool, by a hinge"),
        (&["eef"], "no solid of `eef` collides"),
        (&["hand"], "select one with --body: base, link, palm"),
    ] {
        let found = taken(&arm(&hand("palm")), bodies).expect_err("faults").to_string();
        assert!(found.contains(expected), "{found}");
    }
}

#[test]
fn tools_that_are_no_tools_are_refused() {
    let box_ = "<geom type='box' size='.05 .05 .05'/>";
    for (text, expected) in [
        (
            mjcf(&format!("<body name='a'>{box_}</body><body name='b'>{box_}</body>")),
            "there are 2 bodies, but a tool is a single one",
        ),
        (
            mjcf(&format!("<body name='a'>{box_}<body name='jaw'><joint/>{box_}</body></body>")),
            "`jaw` moves relative to the tool, by a hinge",
        ),
        (
            mjcf(&format!(
                "<body name='a'>{box_}<geom type='box' size='.05 .05 .05' pos='0 0 .02'/></body>"
            )),
            "begins 20.0 mm above the lowest part",
        ),
        (mjcf("<body name='a'/>"), "no body of the file has a solid that collides"),
    ] {
        let found = faults(&text, true);
        assert!(found.contains(expected), "{text}\n{found}");
    }
}
