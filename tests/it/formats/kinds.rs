//! Files of kinds that others have: each is read, or refused with advice that helps when it is followed.

use std::fs;
use std::path::Path;

use pushplan::import::{Reading, Wanted, objects, parse, read, tool};
use pushplan::scene::{JointKind, Support, Task, Tool};
use pushplan::{Shape, Vector};

type Taken = Result<(Task, String), String>;

/// The task of a text, and all notes; or all faults.
fn taken(text: &str, wanted: &Wanted) -> Taken {
    let (model, _, mut notes) = parse(text, "f").map_err(|faults| faults.to_string())?;
    let made = objects(&model, "f", wanted).map_err(|faults| faults.to_string())?;
    notes.extend(made.notes);
    Ok((made.value.task, notes.join("\n")))
}

/// The same of a file in a folder of these files.
fn taken_of(files: &[(&str, &[u8])], reading: &Reading, wanted: &Wanted) -> Taken {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, bytes).expect("a file");
    }
    let root = reading.root.as_ref().map(|root| folder.path().join(root));
    let reading = Reading { root, ..reading.clone() };
    let path = folder.path().join(files[0].0);
    let (model, _, mut notes) = read(&path, &reading).map_err(|faults| faults.to_string())?;
    let made = objects(&model, "f", wanted).map_err(|faults| faults.to_string())?;
    notes.extend(made.notes);
    Ok((made.value.task, notes.join("\n")))
}

fn all() -> Wanted {
    Wanted::default()
}

fn body(name: &str) -> Wanted {
    Wanted { bodies: vec![name.into()], ..Wanted::default() }
}

fn free(name: &str) -> Wanted {
    Wanted { free: vec![name.into()], ..Wanted::default() }
}

/// A link of 0.5 kg and 10 x 8 x 6 cm, with more in it.
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

/// A cube with this side as OBJ.
fn cube(side: f64) -> Vec<u8> {
    let mut text = String::new();
    for k in 0..8 {
        let [x, y, z] = [k & 1, k >> 1 & 1, k >> 2].map(|bit| side * f64::from(bit));
        text += &format!("v {x} {y} {z}\n");
    }
    for face in ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"] {
        text += &format!("f {face}\n");
    }
    text.into_bytes()
}

#[test]
fn what_means_nothing_is_not_judged() {
    let joint = "<link name='world'/><joint name='j' type='floating'><parent link='world'/>\
                 <child link='a'/><origin xyz='0.5 0 0.03'/><axis xyz='0 0 0'/></joint>";
    let (task, _) = taken(&urdf(&(link("a", "") + joint)), &all()).expect("a task");
    assert_eq!(task.scene.objects[0].pose.position, Vector::new(0.5, 0.0));
    let (_, notes) = taken(&urdf(&(link("a", "") + "<drake:joint/>")), &all()).expect("a task");
    assert!(notes.contains("<joint> of another program is left out"), "{notes}");
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
    assert!(value == 0.8 && notes.contains("that of sliding is taken"), "{notes}");
    let wrong = urdf(&(link("a", "") + "<gazebo reference='a'><mu1>x</mu1></gazebo>"));
    assert!(taken(&wrong, &all()).expect_err("a fault").contains("not a number"));
}

#[test]
fn what_moves_otherwise_is_a_fault_or_a_note() {
    let slide = |more: &str, limits: &str, kind: &str| {
        let joint = format!(
            "<joint name='j' type='{kind}'><parent link='a'/><child link='b'/>\
             <origin xyz='0.15 0 0'/><axis xyz='0 0 1'/><limit {limits}/>{more}</joint>"
        );
        urdf(&(link("a", "") + &link("b", "") + &joint))
    };
    let mimic = slide("<mimic joint='k'/>", "lower='-1' upper='1'", "revolute");
    let fault = taken(&mimic, &all()).expect_err("a fault");
    assert!(fault.contains("follows `k` (<mimic>)") && fault.contains("take <mimic> out"));
    taken(&mimic.replace("<mimic joint='k'/>", ""), &all()).expect("as the advice says");
    let limits = |low: &str, high: &str| {
        let text = slide("", &format!("lower='{low}' upper='{high}'"), "revolute");
        let (task, notes) = taken(&text, &all()).expect("a task");
        let JointKind::Revolute { limits, .. } = task.scene.joints[0].kind else { panic!() };
        (limits.map(|span| [span.low, span.high].map(|end| end.to_degrees().round())), notes)
    };
    let (any, notes) = limits("-7", "7");
    assert!(any.is_none() && notes.contains("may turn by more than a turn"), "{notes}");
    assert_eq!(limits("-1", "1").0, Some([-57.0, 57.0]));
    let (wide, notes) = limits("0", "3.1416");
    assert!(wide == Some([0.0, 170.0]) && notes.contains("0 to 180 degrees"), "{notes}");
    let rolls = link("a", "")
        .replace("<inertial>", "<contact><rolling_friction value='0.1'/></contact><inertial>");
    assert!(
        taken(&urdf(&rolls), &all()).expect("a task").1.contains("<rolling_friction> is left out")
    );
    let light =
        link("a", "") + "<gazebo reference='a'><turnGravityOff>true</turnGravityOff></gazebo>";
    assert!(taken(&urdf(&light), &all()).expect_err("a fault").contains("does not weigh"));
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
        fault.contains("has a spring") && fault.contains("name those that are meant with --body")
    );
    let (task, notes) = taken(&text, &body("block")).expect("as the advice says");
    assert_eq!(task.scene.objects.len(), 1);
    for said in [
        "left out, with all that hangs on them: upper",
        "has a spring, and 1 other faults",
        "`post` is passed over",
    ] {
        assert!(notes.contains(said), "{notes}");
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
        (scene.mass(0) - 0.3).abs() < 1e-9 && notes.contains("split over its solids by volume")
    );
    let centre: Vector =
        scene.objects.iter().map(|solid| solid.mass * solid.pose.position).sum::<Vector>() / 0.3;
    assert!((centre - Vector::new(0.53, 0.0)).norm() < 1e-5, "{centre}");
    // Many convex pieces of a disc are that disc.
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
fn bodies_stand_freely_where_somebody_says_so_and_are_set_down() {
    let held = "<mujoco><worldbody><body><body name='object'>\
                <geom type='box' size='.05 .04 .03' density='100'/></body></body></worldbody></mujoco>";
    let fault = taken(held, &all()).expect_err("a fault");
    assert!(fault.contains("--free object lets it stand freely"), "{fault}");
    let (task, _) = taken(held, &free("object")).expect("as the advice says");
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
    assert!(notes.contains("`b` is 20 mm inside the table"), "{notes}");
    assert!(
        taken(&above("0.4"), &all()).expect_err("a fault").contains("350.0 mm above this plane")
    );
    let planar = "<body name='t' pos='.5 0 .02'><joint type='slide' axis='1 0 0'/>\
                  <joint type='slide' axis='0 1 0'/><joint/><geom type='box' size='.05 .05 .02'/></body>";
    let (task, notes) = taken(&mjcf(planar), &all()).expect("a task");
    assert!(task.scene.mounts.is_empty() && notes.contains("stands there freely"), "{notes}");
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
fn a_mesh_is_a_thing_on_the_table() {
    let made = |unit: f64, density: Option<f64>, side: f64| {
        let reading = Reading { unit, ..Reading::default() };
        taken_of(&[("cube.obj", &cube(side))], &reading, &Wanted { density, ..Wanted::default() })
    };
    let (task, _) = made(1e-3, Some(700.0), 60.0).expect("a task");
    let object = &task.scene.objects[0];
    assert_eq!(object.name, "cube");
    let area = object.shape.footprint().area();
    assert!((area - 0.0036).abs() < 1e-9 && (object.shape.height() - 0.06).abs() < 1e-9);
    assert!((object.mass - 700.0 * 0.06f64.powi(3)).abs() < 1e-9, "{}", object.mass);
    let fault = made(1.0, Some(700.0), 60.0).expect_err("60 m");
    assert!(fault.contains("--unit mm makes it 0.060 m"), "{fault}");
    let fault = made(1e-3, None, 60.0).expect_err("no mass");
    assert!(fault.contains("--density 700"), "{fault}");
    let broken = taken_of(&[("cube.stl", b"solid x\nfacet")], &Reading::default(), &all());
    assert!(broken.expect_err("a fault").contains("cannot be read as a mesh"));
}

#[test]
fn a_mesh_that_is_not_convex_has_parts() {
    // An ell: two cubes' worth of a U, as one closed mesh.
    let outline = [[0, 0], [9, 0], [9, 3], [3, 3], [3, 9], [0, 9]];
    let mut text = String::new();
    for z in [0.0, 0.03] {
        for [x, y] in outline {
            text += &format!("v {} {} {z}\n", 0.01 * f64::from(x), 0.01 * f64::from(y));
        }
    }
    for k in 0..6 {
        let next = (k + 1) % 6;
        text += &format!("f {} {} {} {}\n", k + 1, next + 1, next + 7, k + 7);
    }
    text += "f 4 3 2 1\nf 6 5 4 1\nf 7 8 9 10\nf 7 10 11 12\n";
    let wanted = Wanted { density: Some(1000.0), ..Wanted::default() };
    let (task, notes) =
        taken_of(&[("ell.obj", text.as_bytes())], &Reading::default(), &wanted).expect("a task");
    let scene = &task.scene;
    assert!(scene.objects.len() >= 2 && scene.things().count() == 1, "{notes}");
    assert!((scene.mass(0) - 0.135).abs() < 1e-6, "{}", scene.mass(0));
    let area: f64 = scene.objects.iter().map(|solid| solid.shape.footprint().area()).sum();
    assert!((0.0044..0.0056).contains(&area), "{area}, where the hull has 0.0063\n{notes}");
}

#[test]
fn meshes_and_includes_lie_beside_the_file_or_below_what_is_named() {
    let scene = "<mujoco><include file='parts/assets.xml'/><worldbody><geom type='plane' size='1 1 1'/>\
                 <body name='c' pos='.5 0 0'><freejoint/><geom type='mesh' mesh='cube'/></body>\
                 </worldbody></mujoco>";
    let assets = "<mujocoinclude>\n<asset>\n<mesh name='cube' file='parts/cube.obj' scale='.001 .001 .001'/>\
                  </asset></mujocoinclude>";
    let solid = cube(60.0);
    let files: [(&str, &[u8]); 3] = [
        ("scene.xml", scene.as_bytes()),
        ("parts/assets.xml", assets.as_bytes()),
        ("parts/cube.obj", &solid),
    ];
    let (task, _) = taken_of(&files, &Reading::default(), &all()).expect("a task");
    let object = &task.scene.objects[0];
    assert!((object.mass - 0.216).abs() < 1e-9 && object.support == Support::Even);
    // A fault of an included file has its place in that.
    let wrong = assets.replace("<asset>", "<compiler eulerseq='q'/><asset>");
    let files = [files[0], ("parts/assets.xml", wrong.as_bytes()), files[2]];
    let fault = taken_of(&files, &Reading::default(), &all()).expect_err("a fault");
    assert!(fault.contains("assets.xml:2:11: error: the compiler's eulerseq"), "{fault}");
    // Above it only where somebody says so.
    let scene = scene.replace("parts/", "../parts/");
    let assets = assets.replace("parts/", "../parts/");
    let files: [(&str, &[u8]); 3] =
        [("scenes/scene.xml", scene.as_bytes()), ("parts/assets.xml", assets.as_bytes()), files[2]];
    let fault = taken_of(&files, &Reading::default(), &all()).expect_err("a fault");
    assert!(
        fault.contains("outside of the file's own folder") && fault.contains("--root "),
        "{fault}"
    );
    let root = Reading { root: Some("".into()), ..Reading::default() };
    taken_of(&files, &root, &all()).expect("as the advice says");
    let circle = "<mujoco><include file='a.xml'/></mujoco>";
    let circle = taken_of(&[("a.xml", circle.as_bytes())], &Reading::default(), &all());
    assert!(circle.expect_err("a fault").contains("include each other"));
}

#[test]
fn a_centre_of_mass_outside_is_told_and_one_off_an_axis_makes_a_prism() {
    let text = urdf(&link("a", "").replace("<inertial>", "<inertial><origin xyz='0.2 0 0'/>"));
    let fault = taken(&text, &all()).expect_err("a fault");
    assert!(fault.contains("200.0 mm off the middle, outside of what it covers"), "{fault}");
    taken(&text.replace("0.2 0 0'", "0.02 0 0'"), &all()).expect("as the advice says");
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
fn what_weighs_nothing_weighs_what_it_is_made_of() {
    let text = urdf(&link("a", "").replace("'0.5'", "'0'"));
    let fault = taken(&text, &all()).expect_err("a fault");
    assert!(fault.contains("`a` has no mass") && fault.contains("--density 700"), "{fault}");
    let wood = Wanted { density: Some(700.0), ..all() };
    let (task, _) = taken(&text, &wood).expect("as the advice says");
    assert!((task.scene.objects[0].mass - 0.336).abs() < 1e-12);
    // Parts that are lighter than a task can say weigh more, and the whole as much as before.
    let thin = mjcf(
        "<body name='t' pos='.5 0 .02'><freejoint/><geom type='box' size='.04 .04 .02'/>\
         <geom type='box' size='.002 .02 .02' pos='.042 0 0' density='1'/></body>",
    );
    let (task, _) = taken(&thin, &all()).expect("a task");
    assert!((task.scene.mass(0) - 0.2560032).abs() < 1e-6 && task.scene.objects[1].mass > 1e-3);
    let light = thin.replace("density='1'", "").replace("/>", " density='5'/>");
    let (task, _) = taken(&light, &all()).expect("a task");
    assert!((task.scene.mass(0) - 0.0013).abs() < 1e-4, "{}", task.scene.mass(0));
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

#[test]
fn damaged_meshes_and_folders_are_faults() {
    assert!(read(Path::new("/nowhere/thing.stl"), &Reading::default()).is_err());
    let flat = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let made = taken_of(&[("flat.obj", flat)], &Reading::default(), &all());
    assert!(made.expect_err("a fault").contains("flat"));
}
