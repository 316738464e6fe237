//! Kinds of files that were read wrongly or refused: each with several variants.

mod shapes;

use std::f64::consts::PI;

use pushplan::scene::JointKind;
use pushplan::task::Task;
use pushplan_import::{Reading, Wanted, objects, parse, read};

use super::kinds::Taken;
use super::meshes::{strict, taken_of};

fn taken_with(text: &str, wanted: &Wanted) -> Taken {
    let (model, _) = parse(text, "f").map_err(|faults| faults.to_string())?;
    let made = objects(&model, "f", wanted).map_err(|faults| faults.to_string())?;
    Ok((made.value.task, made.notes.join("\n")))
}

fn taken(text: &str) -> Taken {
    taken_with(text, &Wanted::default())
}

/// Returns the task of a text with all notes, or all faults, if nothing is assumed.
fn strictly(text: &str) -> Taken {
    let (mut model, _) = parse(text, "f").map_err(|faults| faults.to_string())?;
    model.strict = true;
    let made = objects(&model, "f", &Wanted::default()).map_err(|faults| faults.to_string())?;
    Ok((made.value.task, made.notes.join("\n")))
}

fn named(names: &[&str]) -> Wanted {
    let bodies = names.iter().map(|name| (*name).to_owned()).collect();
    Wanted { bodies, ..Wanted::default() }
}

fn mjcf(bodies: &str) -> String {
    format!("<mujoco><worldbody><geom type='plane' size='2 2 .1'/>{bodies}</worldbody></mujoco>")
}

/// Returns sides of the bounding box of an object on the table, its height and its position, in
/// tenths of millimetres.
fn extents(task: &Task, object: usize) -> [i64; 5] {
    let object = &task.scene.objects[object];
    let reach = |angle: f64| {
        let local = angle - object.pose.heading;
        object.shape.footprint().extent(pushplan::Vector::new(local.cos(), local.sin()))
    };
    let sides = [reach(0.0) + reach(PI), reach(PI / 2.0) + reach(-PI / 2.0)];
    let at = object.pose.position;
    [sides[0], sides[1], object.shape.height(), at.x, at.y].map(|x| (1e4 * x).round() as i64)
}

#[test]
fn losses_and_rotors_of_joints_are_noted_with_their_effect() {
    let slide = |joint: &str, default: &str| {
        let body = format!(
            "<body name='d' pos='.5 0 .04'><joint {joint}/><geom type='box' size='.05 .04 .04'/></body>"
        );
        mjcf(&body).replace("<mujoco>", &format!("<mujoco>{default}"))
    };
    let rail = "type='slide' axis='1 0 0' range='0 .2'";
    let class = "<default><default class='rail'><joint armature='20'/></default></default>";
    for text in [
        slide(&format!("{rail} armature='20'"), ""),
        slide("armature='20'", ""),
        slide(&format!("{rail} class='rail'"), class),
        slide(rail, "<default><joint armature='20'/></default>"),
    ] {
        let (_, notes) = taken(&text).expect("a task");
        let first = notes.lines().next().expect("a note");
        assert!(first.contains("`armature`") && first.contains("inertia"), "{notes}");
    }
    let (_, notes) =
        taken(&slide(&format!("{rail} armature='0' damping='0'"), "")).expect("a task");
    assert!(!notes.contains("armature") && !notes.contains("damping"), "{notes}");
}

#[test]
fn limits_that_stand_for_none_are_none() {
    let plate = |kind: &str, limit: &str| {
        format!(
            "<robot name='r'><link name='world'/><link name='p'><inertial><mass value='.6'/></inertial>\
             <collision><geometry><box size='.2 .06 .04'/></geometry></collision></link>\
             <joint name='j' type='{kind}'><parent link='world'/><child link='p'/><origin xyz='.5 0 .02'/>\
             <axis xyz='0 0 1'/><limit {limit} effort='1' velocity='1'/></joint></robot>"
        )
        .replace("type='prismatic'", "type='prismatic' ")
        .replace(if kind == "prismatic" { "'0 0 1'" } else { "" }, if kind == "prismatic" { "'1 0 0'" } else { "" })
    };
    for kind in ["revolute", "prismatic"] {
        for (low, high) in [
            ("-inf", "inf"),
            ("-1e16", "1e16"),
            ("-999999", "999999"),
            ("-Infinity", "+inf"),
            ("-1e400", "1e400"),
        ] {
            let text = plate(kind, &format!("lower='{low}' upper='{high}'"));
            let (task, notes) =
                taken(&text).unwrap_or_else(|faults| panic!("{kind} {low}: {faults}"));
            assert!(
                task.scene.mounts[0].kind.limits().is_none() && notes.contains("without limits"),
                "{notes}"
            );
        }
    }
    let limits = |kind: &str, limit: &str| {
        let (task, notes) = taken(&plate(kind, limit)).expect("a task");
        let span = task.scene.mounts[0].kind.limits().expect("limits");
        ([span.low, span.high].map(|end| (1e3 * end).round()), notes)
    };
    assert_eq!(limits("prismatic", "lower='0' upper='1e16'").0, [0.0, 10_000.0]);
    assert_eq!(limits("prismatic", "lower='-inf' upper='.2'").0, [-10_000.0, 200.0]);
    // One side stays limited, at most 340 degrees away.
    let (kept, notes) = limits("revolute", "lower='0' upper='inf'");
    assert!(kept[0] == 0.0 && kept[1] > 5000.0 && notes.contains("inf degrees"), "{notes}");
    let (task, _) = taken(&plate("continuous", "lower='-999999' upper='x'")).expect("not read");
    assert!(matches!(task.scene.mounts[0].kind, JointKind::Revolute { limits: None, .. }));
    assert!(taken(&plate("revolute", "lower='nan' upper='1'")).is_err());
    let slide = "<body name='d' pos='.5 0 .04'><joint type='slide' axis='1 0 0' range='-inf inf'/>\
                 <geom type='box' size='.05 .04 .04'/></body>";
    assert!(taken(&mjcf(slide)).expect("a task").0.scene.mounts[0].kind.limits().is_none());
}

#[test]
fn equality_constraints_act_on_the_bodies_that_they_name_while_they_are_active() {
    let scene = |section: &str| {
        let body = |name: &str, y: &str| {
            format!(
                "<body name='{name}' pos='.5 {y} .02'><freejoint/><geom type='box' size='.06 .03 .02' mass='.3'/></body>"
            )
        };
        let door = "<body name='door' pos='.9 0 .1'><joint name='hinge' range='-90 0'/><geom type='box' size='.1 .01 .1'/></body>";
        mjcf(&(body("plank", "0") + &body("leg", ".3") + &body("far", "-.3") + door))
            .replace("</mujoco>", &format!("{section}</mujoco>"))
    };
    let usual = taken(&scene("")).expect("a task").0.scene.things().count();
    for (inactive, before) in [
        ("<equality><weld active='false' body1='plank' body2='leg'/></equality>", ""),
        ("<equality><joint active='false' joint1='hinge'/></equality>", ""),
        (
            "<equality><weld body1='plank' body2='leg'/></equality>",
            "<default><equality active='false'/></default>",
        ),
        (
            "<equality><connect body1='plank' body2='leg' anchor='0 0 0'/></equality>",
            "<option><flag equality='disable'/></option>",
        ),
    ] {
        let text = scene(inactive).replace("<mujoco>", &format!("<mujoco>{before}"));
        let (task, notes) = strictly(&text).expect("a task");
        let count = task.scene.things().count();
        assert!(
            count == usual && !notes.contains("weld") && !notes.contains("<connect>"),
            "{notes}"
        );
    }
    // An active weld fixes the two to each other, or one to the world.
    let weld = scene("<equality><weld body1='leg' body2='plank'/></equality>");
    for wanted in [Wanted::default(), named(&["plank", "leg"])] {
        let (task, _) = taken_with(&weld, &wanted).expect("a task");
        assert!((task.scene.mass(0) - 0.6).abs() < 1e-9, "{}", task.scene.mass(0));
    }
    let held = scene("<equality><weld body1='leg'/></equality>");
    assert_eq!(taken(&held).expect("a task").0.scene.things().count(), usual - 1);
    // Others are faults for the bodies that they name alone.
    for section in [
        "<connect body1='plank' body2='leg' anchor='0 0 0'/>",
        "<weld body1='plank' body2='leg' relpose='1 0 0 1 0 0 0'/>",
    ] {
        let text = scene(&format!("<equality>{section}</equality>"));
        let fault = taken_with(&text, &named(&["plank"])).expect_err("a fault");
        assert!(fault.contains("acts on `plank`"), "{fault}");
        let (_, notes) = taken_with(&text, &named(&["far"])).expect("a task");
        assert!(notes.contains("is ignored"), "{notes}");
    }
    let joint = scene("<equality><joint joint1='hinge'/></equality>");
    assert!(taken_with(&joint, &named(&["door"])).expect_err("a fault").contains("acts on `door`"));
    assert!(taken_with(&joint, &named(&["plank"])).is_ok());
}

#[test]
fn drawers_that_hang_are_lowered_over_what_they_pass() {
    let drawer = |name: &str, z: f64| {
        format!(
            "<body name='{name}' pos='0 0 {z}'><joint type='slide' axis='-1 0 0' range='0 .15'/>\
             <geom type='box' pos='.1 0 0' size='.09 .14 .08' mass='1'/></body>"
        )
    };
    let chest = |drawers: &str| {
        mjcf(&format!(
            "<body name='chest' pos='.6 0 0'><geom type='box' pos='.21 0 .3' size='.01 .15 .3'/>\
             <geom type='box' pos='.1 0 .01' size='.1 .15 .01'/>{drawers}</body>"
        ))
    };
    let of_chest =
        |task: &Task| task.scene.obstacles.iter().filter(|one| one.name.contains("chest")).count();
    let both = chest(&(drawer("lower", 0.12) + &drawer("upper", 0.45)));
    let fault = taken(&both).expect_err("a fault");
    assert!(fault.contains("--body upper, or --body lower"), "{fault}");
    for name in ["lower", "upper"] {
        let (task, _) = taken_with(&both, &named(&[name])).expect("the advice was followed");
        // The bottom is left out, and the back stays.
        assert_eq!((task.scene.mounts.len(), of_chest(&task)), (1, 1));
    }
    let (task, notes) = taken(&chest(&drawer("d", 0.12))).expect("a task");
    assert!(of_chest(&task) == 1 && notes.contains("passes above it"), "{notes}");
    // A cabinet that stands freely, and the same one fixed.
    let cabinet = "<robot name='c'><link name='base'>\
        <collision><origin xyz='.15 0 .01'/><geometry><box size='.3 .3 .02'/></geometry></collision>\
        <collision><origin xyz='.15 .14 .1'/><geometry><box size='.3 .02 .16'/></geometry></collision>\
        <collision><origin xyz='.15 -.14 .1'/><geometry><box size='.3 .02 .16'/></geometry></collision></link>\
        <link name='drawer'><collision><origin xyz='.1 0 .1'/><geometry><box size='.2 .2 .12'/></geometry></collision></link>\
        <joint name='j' type='prismatic'><parent link='base'/><child link='drawer'/><axis xyz='-1 0 0'/><limit lower='0' upper='.18'/></joint></robot>";
    let (task, notes) = taken(cabinet).expect("a task");
    assert!(notes.contains("left out, because others pass above"), "{notes}");
    assert_eq!(
        (
            task.scene.things().count(),
            task.scene.joints.iter().filter(|j| j.kind != JointKind::Fixed).count()
        ),
        (2, 1)
    );
    assert!(
        (task.scene.mass(0) - 1000.0 * (0.3 * 0.3 * 0.02 + 2.0 * 0.3 * 0.02 * 0.16)).abs() < 1e-6
    );
    let fixed = Wanted { fixed: true, ..Wanted::default() };
    let (task, _) = taken_with(cabinet, &fixed).expect("a task");
    assert_eq!(
        (task.scene.things().count(), task.scene.mounts.len(), task.scene.obstacles.len()),
        // The two sides, and the robot's base.
        (1, 1, 3)
    );
    let alone = "<robot name='r'><link name='a'><collision><geometry><box size='.1 .1 .1'/></geometry></collision></link></robot>";
    assert!(taken_with(alone, &fixed).expect_err("a fault").contains("remove --fixed"));
}

#[test]
fn what_messages_advise_is_assumed_unless_nothing_may_be() {
    let cube = super::meshes::cube(60.0);
    // Unit and density.
    let (task, notes) =
        taken_of(&[("cube.obj", &cube)], &Reading::default(), &Wanted::default()).expect("a task");
    assert!(
        notes.contains("it is taken for mm, 0.060 m") && notes.contains("`cube` 0.216 kg"),
        "{notes}"
    );
    assert!((task.scene.objects[0].mass - 0.216).abs() < 1e-9 && task.unknown.masses);
    assert!(task.to_yaml().expect("YAML").contains("masses"));
    assert!(
        taken_of(&[("cube.obj", &cube)], &strict(), &Wanted::default())
            .expect_err("a fault")
            .contains("--unit mm")
    );
    // A density that was given is known.
    let given = Wanted { density: Some(700.0), ..Wanted::default() };
    assert!(
        !taken_of(&[("cube.obj", &cube)], &Reading::default(), &given)
            .expect("a task")
            .0
            .unknown
            .masses
    );
    // The only body of a library, in any nesting; of several bodies, none is chosen.
    let body = "<body name='object'><geom type='box' size='.05 .04 .03'/></body>";
    let library = |inner: &str| format!("<mujoco><worldbody>{inner}</worldbody></mujoco>");
    for text in [library(body), library(&format!("<body><body>{body}</body></body>"))] {
        let (task, notes) = taken(&text).expect("a task");
        assert!(
            task.scene.objects[0].name == "object" && notes.contains("taken for a free object"),
            "{notes}"
        );
        assert!(strictly(&text).expect_err("a fault").contains("--free"));
    }
    let two = library(&format!("{body}{}", body.replace("object", "other")));
    assert!(taken(&two).expect_err("a fault").contains("--free object"));
    // A robot beside an object is left out.
    let scene = mjcf(
        "<body name='box' pos='.5 0 .05'><freejoint/><geom type='box' size='.05 .05 .05'/></body>\
         <body name='arm' pos='-.5 0 0'><joint name='j' axis='0 1 0' stiffness='3'/><geom type='capsule' size='.03 .2'/></body>",
    )
    .replace("</mujoco>", "<actuator><motor joint='j'/></actuator></mujoco>");
    let (task, notes) = taken(&scene).expect("a task");
    assert!(
        task.scene.objects.len() == 1
            && notes.lines().next().is_some_and(|line| line.contains("`arm` is left out")),
        "{notes}"
    );
    assert!(strictly(&scene).is_err());
    // Shapes that are only drawn stand for a file without collision.
    let drawn = "<robot name='r'><link name='a'><inertial><mass value='.5'/></inertial><visual><geometry><box size='.1 .08 .06'/></geometry></visual></link></robot>";
    assert!(taken(drawn).expect("a task").1.contains("visual shapes do"));
    assert!(strictly(drawn).is_err());
}

#[test]
fn notes_are_few_and_those_with_a_strong_effect_come_first() {
    let geom = |k: usize| {
        format!("<geom type='box' size='.02 .02 .02' pos='{} 0 0' margin='.001'/>", 0.03 * k as f64)
    };
    let geoms: String = (0..6).map(geom).collect();
    let text = mjcf(&format!(
        "<body name='b' pos='.5 0 .02'><freejoint/>{geoms}</body>\
         <body name='d' pos='.5 .4 .04'><joint type='slide' axis='1 0 0' armature='3' damping='1'/><geom type='box' size='.05 .04 .04'/></body>"
    ));
    let (_, notes) = taken(&text).expect("a task");
    let at = |word: &str| {
        notes
            .lines()
            .position(|line| line.contains(word))
            .unwrap_or_else(|| panic!("{word}: {notes}"))
    };
    assert!(at("`armature`") < at("`damping`") && at("`damping`") < at("`margin`"));
    assert!(
        notes.matches("`margin`").count() == 1 && notes.contains("(also at 5 other places)"),
        "{notes}"
    );
}

#[test]
fn replicated_bodies_have_poses_and_names_of_their_own() {
    let text = mjcf(
        "<replicate count='11' offset='0 .05 0' euler='0 0 10' sep='-'><body name='b' pos='.5 0 .02'><freejoint/>\
         <geom name='g' type='box' size='.01 .01 .02'/></body></replicate>",
    );
    let (task, _) = taken(&text).expect("a task");
    let names: Vec<&str> = task.scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!((names.len(), names[0], names[10]), (11, "b-00", "b-10"));
    // Each copy is placed in the frame of the copy before it.
    let [x, y] = [0.5 * 10f64.to_radians().cos(), 0.05 + 0.5 * 10f64.to_radians().sin()];
    assert!((task.scene.objects[1].pose.position - pushplan::Vector::new(x, y)).norm() < 1e-9);
    for count in ["-1", "x", "6000"] {
        assert!(taken(&text.replace("'11'", &format!("'{count}'"))).is_err(), "{count}");
    }
    let nested = "<replicate count='100'>".repeat(6) + &"</replicate>".repeat(6);
    assert!(taken(&mjcf(&nested)).expect_err("a fault").contains("more than 5000 copies"));
}

#[test]
fn unreadable_files_are_faults() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [
        ("a.dae", "<COLLADA/>"),
        ("b.dae", "x"),
        ("c.obj", "v 1 2"),
        ("d.obj", "v 0 0 0\nf 1 2 9"),
        ("e.stl", "solid x\n facet\n outer loop\n vertex 1 2 z"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file");
        let fault = read(&path, &Reading::default()).expect_err(name).to_string();
        assert!(fault.contains("help:"), "{fault}");
    }
}
