//! Kinds of foreign files: each is read, or refused with advice that works when followed.

use pushplan::{Shape, Vector};
use pushplan::{
    scene::{JointKind, Tool},
    task::Task,
};
use pushplan_import::{Wanted, objects, parse, tool};

pub(super) type Taken = Result<(Task, String), String>;

/// Returns the task of a text with all notes, or all faults, if nothing is assumed.
fn taken(text: &str, wanted: &Wanted) -> Taken {
    let (mut model, _) = parse(text, "f").map_err(|faults| faults.to_string())?;
    model.strict = true;
    let made = objects(&model, "f", wanted).map_err(|faults| faults.to_string())?;
    Ok((made.value.task, made.notes.join("\n")))
}

fn all() -> Wanted {
    Wanted::default()
}

fn body(name: &str) -> Wanted {
    Wanted { bodies: vec![name.into()], ..all() }
}

fn free(name: &str) -> Wanted {
    Wanted { free: vec![name.into()], ..all() }
}

/// Returns a link of 0.5 kg and 10 x 8 x 6 cm that also contains `more`.
fn link(name: &str, more: &str) -> String {
    format!(
        "<link name='{name}'><inertial><mass value='0.5'/></inertial><collision><geometry>\
         <box size='0.1 0.08 0.06'/></geometry>{more}</collision></link>"
    )
}

fn urdf(inner: &str) -> String {
    format!("<robot name='r' xmlns:drake='http://drake.mit.edu'>{inner}</robot>")
}

fn mjcf(bodies: &str) -> String {
    format!("<mujoco><worldbody><geom type='plane' size='1 1 1'/>{bodies}</worldbody></mujoco>")
}

#[test]
fn irrelevant_elements_are_not_checked() {
    let joint = "<link name='world'/><joint name='j' type='floating'><parent link='world'/>\
                 <child link='a'/><origin xyz='0.5 0 0.03'/><axis xyz='0 0 0'/></joint>";
    let (task, _) = taken(&urdf(&(link("a", "") + joint)), &all()).expect("a task");
    assert_eq!(task.scene.objects[0].pose.position, Vector::new(0.5, 0.0));
    let (_, notes) = taken(&urdf(&(link("a", "") + "<drake:joint/>")), &all()).expect("a task");
    assert!(notes.contains("<joint> is an extension of another program and is ignored"), "{notes}");
}

#[test]
fn friction_is_found_wherever_simulators_look() {
    let friction = |inner: &str, more: &str| {
        let (task, notes) = taken(&urdf(&(link("a", more) + inner)), &all()).expect("a task");
        (task.scene.objects[0].friction, notes)
    };
    let gazebo = |inner: &str| friction(&format!("<gazebo reference='a'>{inner}</gazebo>"), "").0;
    assert_eq!(gazebo("<mu1 value='0.3'/>"), 0.3);
    assert_eq!(gazebo("<mu1>0.3</mu1>"), 0.3);
    let nested =
        "<collision><surface><friction><ode><mu>0.3</mu></ode></friction></surface></collision>";
    assert_eq!(gazebo(nested), 0.3);
    let drake = "<drake:proximity_properties><drake:mu_static value='0.9'/>\
                 <drake:mu_dynamic value='0.8'/></drake:proximity_properties>";
    let (value, notes) = friction("", drake);
    assert!(value == 0.8 && notes.contains("the dynamic one is used"), "{notes}");
    let wrong = urdf(&(link("a", "") + "<gazebo reference='a'><mu1>x</mu1></gazebo>"));
    assert!(taken(&wrong, &all()).expect_err("a fault").contains("not a number"));
}

#[test]
fn unsupported_motions_are_errors_or_notes() {
    let slide = |more: &str, limits: &str, kind: &str| {
        let joint = format!(
            "<joint name='j' type='{kind}'><parent link='a'/><child link='b'/>\
             <origin xyz='0.15 0 0'/><axis xyz='0 0 1'/><limit {limits}/>{more}</joint>"
        );
        urdf(&(link("a", "") + &link("b", "") + &joint))
    };
    let mimic = slide("<mimic joint='k'/>", "lower='-1' upper='1'", "revolute");
    let fault = taken(&mimic, &all()).expect_err("a fault");
    assert!(fault.contains("follows `k` (<mimic>)") && fault.contains("remove <mimic>"));
    taken(&mimic.replace("<mimic joint='k'/>", ""), &all()).expect("the advice was followed");
    let limits = |low: &str, high: &str| {
        let text = slide("", &format!("lower='{low}' upper='{high}'"), "revolute");
        let (task, notes) = taken(&text, &all()).expect("a task");
        let JointKind::Revolute { limits, .. } = task.scene.joints[0].kind else { panic!() };
        (limits.map(|span| [span.low, span.high].map(|end| end.to_degrees().round())), notes)
    };
    let (any, notes) = limits("-7", "7");
    assert!(any.is_none() && notes.contains("may rotate by more than 360 degrees"), "{notes}");
    assert_eq!(limits("-1", "1").0, Some([-57.0, 57.0]));
    let (wide, notes) = limits("0", "3.1416");
    assert!(wide == Some([0.0, 180.0]) && !notes.contains("may rotate by"), "{notes}");
    let (wider, notes) = limits("-3.1", "3.1");
    assert!(wider == Some([-170.0, 170.0]) && notes.contains("-177.6 to 177.6"), "{notes}");
    let rolls = link("a", "")
        .replace("<inertial>", "<contact><rolling_friction value='0.1'/></contact><inertial>");
    assert!(
        taken(&urdf(&rolls), &all())
            .expect("a task")
            .1
            .contains("`value` of this rolling_friction is ignored")
    );
    let light =
        link("a", "") + "<gazebo reference='a'><turnGravityOff>true</turnGravityOff></gazebo>";
    assert!(
        taken(&urdf(&light), &all())
            .expect_err("a fault")
            .contains("does not have its full weight")
    );
}

#[test]
fn only_what_was_chosen_may_refuse() {
    let text = mjcf(
        "<body name='block' pos='.5 .1 .03'><freejoint/><geom type='box' size='.05 .04 .03'/></body>
         <body name='upper' pos='0 0 .5'><joint axis='0 1 0' stiffness='3'/><geom type='capsule' size='.03 .2'/>
         <body name='lower' pos='0 0 .4'><joint axis='0 1 0'/><geom type='capsule' size='.03 .2' x='1'/></body></body>
         <body name='post'><geom type='hfield' size='.05 .04 .03'/></body>",
    )
    .replace("</mujoco>", "<contact><exclude body1='upper' body2='lower'/></contact></mujoco>");
    let fault = taken(&text, &all()).expect_err("faults");
    assert!(
        fault.contains("stiffness=\"3\" of this joint")
            && fault.contains("select bodies with --body")
    );
    let (task, notes) = taken(&text, &body("block")).expect("the advice was followed");
    assert_eq!(task.scene.objects.len(), 1);
    for note in [
        "omitted, with all bodies attached to them: upper",
        "stiffness=\"3\" of this joint is not supported, and 1 more",
        "`post` contains an element",
    ] {
        assert!(notes.contains(note), "{notes}");
    }
}

#[test]
fn a_body_of_several_solids_is_one_object_with_its_mass_where_it_should_be() {
    let nut = mjcf(
        "<body name='nut' pos='.5 0 .01'><freejoint/>
         <inertial mass='0.3' pos='0.03 0 0' diaginertia='1e-4 1e-4 1e-4'/>
         <geom type='box' size='.02 .04 .01'/>
         <geom type='box' size='.03 .015 .01' pos='.045 0 0'/></body>",
    );
    let (task, notes) = taken(&nut, &all()).expect("a task");
    let scene = &task.scene;
    assert_eq!((scene.things().count(), scene.objects.len()), (1, 2));
    assert!(
        (scene.mass(0) - 0.3).abs() < 1e-9 && notes.contains("divided among its solids by volume")
    );
    let centre: Vector =
        scene.objects.iter().map(|solid| solid.mass * solid.pose.position).sum::<Vector>() / 0.3;
    assert!((centre - Vector::new(0.53, 0.0)).norm() < 1e-5, "{centre}");
    // The larger of two frictions applies to all solids.
    let rough = nut.replace("<geom type='box'", "<geom type='box' friction='.5'");
    let (task, _) = taken(&rough, &all()).expect("a task");
    assert_eq!([0, 1].map(|solid| task.scene.support_friction(solid)), [1.0, 1.0]);
    let again = Task::parse(&task.to_yaml().expect("YAML"), "f").expect("a task");
    assert_eq!(again.scene, task.scene);
    // Many convex pieces of a disc are merged to the disc.
    let slices: String = (0..24)
        .map(|k| {
            format!("<geom type='box' size='.06 .008 .02' euler='0 0 {}'/>", 7.5 * f64::from(k))
        })
        .collect();
    let plate = mjcf(&format!("<body name='plate' pos='.5 0 .02'><freejoint/>{slices}</body>"));
    let (task, notes) = taken(&plate, &all()).expect("a task");
    let Shape::Cylinder { radius, .. } = task.scene.objects[0].shape else { panic!("{notes}") };
    assert!(task.scene.objects.len() == 1 && (radius - 0.06).abs() < 1e-3, "{radius}");
}

#[test]
fn bodies_stand_freely_on_request_and_are_set_down() {
    let held = "<mujoco><worldbody><body><body name='object'>\
                <geom type='box' size='.05 .04 .03' density='100'/></body></body></worldbody></mujoco>";
    let fault = taken(held, &all()).expect_err("a fault");
    assert!(fault.contains("--free object makes it free"), "{fault}");
    let (task, _) = taken(held, &free("object")).expect("the advice was followed");
    assert!((task.scene.objects[0].mass - 0.048).abs() < 1e-12);
    let fault = taken(held, &body("object")).expect_err("a fault");
    assert!(fault.contains("--free object"), "{fault}");
    assert!(
        taken(held, &free("cup")).expect_err("a fault").contains("bodies with solids are object")
    );
    let above = |z: &str| {
        mjcf(&format!(
            "<body name='b' pos='0.5 0 {z}'><freejoint/><geom type='box' size='.05 .05 .05'/></body>"
        ))
    };
    let (_, notes) = taken(&above("0.12"), &all()).expect("a task");
    assert!(notes.contains("`b` is 70 mm above the table"), "{notes}");
    let (_, notes) = taken(&above("0.03"), &all()).expect("a task");
    assert!(notes.contains("`b` is 20 mm below the surface of the table"), "{notes}");
    assert!(
        taken(&above("0.4"), &all()).expect_err("a fault").contains("350.0 mm above this plane")
    );
    let planar = "<body name='t' pos='.5 0 .02'><joint type='slide' axis='1 0 0'/>\
                  <joint type='slide' axis='0 1 0'/><joint/><geom type='box' size='.05 .05 .02'/></body>";
    let (task, notes) = taken(&mjcf(planar), &all()).expect("a task");
    assert!(
        task.scene.mounts.is_empty() && notes.contains("is imported as a free object"),
        "{notes}"
    );
}

#[test]
fn doors_and_drawers_are_joined_to_the_world() {
    let text = mjcf(
        "<body name='door' pos='.6 .2 .1'><joint range='-90 0'/><geom type='box' size='.1 .01 .1' pos='.1 0 0'/></body>
         <body name='drawer' pos='.5 -.3 .05'><joint type='slide' axis='-1 0 0' range='0 .2'/>
         <geom type='box' size='.1 .08 .05'/></body>",
    );
    let (task, _) = taken(&text, &all()).expect("a task");
    let [hinge, slide] = &task.scene.mounts[..] else { panic!("{:?}", task.scene.mounts) };
    let JointKind::Revolute { at, limits: Some(limits) } = hinge.kind else { panic!() };
    assert!(
        (at - Vector::new(0.6, 0.2)).norm() < 1e-12
            && (limits.low.to_degrees() + 90.0).abs() < 1e-9
    );
    let JointKind::Prismatic { axis, limits: Some(limits) } = slide.kind else { panic!() };
    assert!((axis + Vector::x()).norm() < 1e-12 && (limits.high - 0.2).abs() < 1e-12);
}

#[test]
fn a_centre_of_mass_outside_is_reported_and_one_off_an_axis_makes_a_prism() {
    let text = urdf(&link("a", "").replace("<inertial>", "<inertial><origin xyz='0.2 0 0'/>"));
    let fault = taken(&text, &all()).expect_err("a fault");
    assert!(fault.contains("200.0 mm from the middle, outside its outline"), "{fault}");
    taken(&text.replace("0.2 0 0'", "0.02 0 0'"), &all()).expect("the advice was followed");
    let can = mjcf(
        "<body name='can' pos='.5 0 .05'><freejoint/>\
         <inertial mass='.4' pos='.01 0 0' diaginertia='1e-4 1e-4 1e-4'/>\
         <geom type='cylinder' size='.04 .05'/></body>",
    );
    let (task, notes) = taken(&can, &all()).expect("a task");
    let object = &task.scene.objects[0];
    assert!((object.pose.position - Vector::new(0.51, 0.0)).norm() < 1e-9);
    assert!(object.shape.footprint().area() / (std::f64::consts::PI * 0.0016) - 1.0 < 1e-9);
    assert!(notes.contains("10.0 mm off its axis"), "{notes}");
}

#[test]
fn solids_without_mass_weigh_by_their_density() {
    let text = urdf(&link("a", "").replace("'0.5'", "'0'"));
    let fault = taken(&text, &all()).expect_err("a fault");
    assert!(fault.contains("`a` has no mass") && fault.contains("--density 700"), "{fault}");
    let wood = Wanted { density: Some(700.0), ..all() };
    let (task, _) = taken(&text, &wood).expect("the advice was followed");
    assert!((task.scene.objects[0].mass - 0.336).abs() < 1e-12);
    // Masses of parts below a task's minimum are raised, and the total mass is kept.
    let thin = mjcf(
        "<body name='t' pos='.5 0 .02'><freejoint/><geom type='box' size='.04 .04 .02'/>\
         <geom type='box' size='.002 .02 .02' pos='.042 0 0' density='1'/></body>",
    );
    let (task, _) = taken(&thin, &all()).expect("a task");
    assert!((task.scene.mass(0) - 0.2560064).abs() < 1e-6 && task.scene.objects[1].mass > 1e-3);
    let light = thin.replace(" density='1'", "").replace("'/>", "' density='5'/>");
    let (task, _) = taken(&light, &all()).expect("a task");
    assert!((task.scene.mass(0) - 0.0013).abs() < 1e-4, "{}", task.scene.mass(0));
}

#[test]
fn hollow_solids_weigh_by_their_surface() {
    let hollow = |geom: &str| {
        let text = mjcf(&format!(
            "<body name='b' pos='.5 0 .05'><freejoint/><geom {geom} shellinertia='true'/></body>"
        ));
        let (task, notes) = taken(&text, &all()).expect("a task");
        assert!(notes.contains("it is hollow"), "{notes}");
        task.scene.objects[0].mass
    };
    // Reference value from MuJoCo for 5 kg/m^2.
    assert!((hollow("type='box' size='.05 .04 .05' density='5'") - 0.26).abs() < 1e-9);
    let can = 5.0 * std::f64::consts::TAU * 0.04 * 0.14;
    assert!((hollow("type='cylinder' size='.04 .05' density='5'") - can).abs() < 1e-9);
    assert_eq!(hollow("type='box' size='.05 .04 .05' mass='.3'"), 0.3);
}

#[test]
fn masses_follow_from_the_groups_that_count() {
    let text = mjcf(
        "<body name='b' pos='.5 0 .05'><freejoint/><geom type='box' size='.05 .05 .05' group='4'/>\
         <geom type='box' size='.05 .05 .05' contype='0' conaffinity='0' group='1'/></body>",
    );
    let mass = |text: &str| taken(text, &all()).expect("a task").0.scene.objects[0].mass;
    assert!((mass(&text) - 2.0).abs() < 1e-12);
    let groups = text.replace("<worldbody>", "<compiler inertiagrouprange='4 5'/><worldbody>");
    assert!((mass(&groups) - 1.0).abs() < 1e-12);
}

#[test]
fn a_tool_of_many_touching_parts_is_written_and_read() {
    let geoms: String = (0..28)
        .map(|k| {
            let [x, y] = [0.02 * f64::from(k / 2), 0.02 * f64::from(k % 2)];
            format!("<geom type='box' size='.01 .01 .01' pos='{x:.2} {y:.2} 0'/>")
        })
        .collect();
    let text = format!("<mujoco><worldbody><body name='g'>{geoms}</body></worldbody></mujoco>");
    let (model, ..) = parse(&text, "f").expect("a model");
    let made = tool(&model, "f", &all()).expect("a tool").value;
    let again = Tool::parse(&made.to_json().to_string(), "f").expect("a tool");
    assert_eq!((again.parts(), again.joints()), (made.parts(), made.joints()));
}
