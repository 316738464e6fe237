//! Meshes, and files that a file names.

use std::fs;
use std::path::Path;

use pushplan::Vector;
use pushplan::scene::Support;
use pushplan_import::{Reading, Wanted, objects, read};

use super::kinds::Taken;

/// Returns the options of reading without assumptions.
pub(super) fn strict() -> Reading {
    Reading { strict: true, ..Reading::default() }
}

/// Returns the task of a file in a folder of these files, with all notes; or all faults.
pub(super) fn taken_of(files: &[(&str, &[u8])], reading: &Reading, wanted: &Wanted) -> Taken {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, bytes).expect("a file");
    }
    let root = reading.root.as_ref().map(|root| folder.path().join(root));
    let reading = Reading { root, ..reading.clone() };
    let path = folder.path().join(files[0].0);
    let (model, _) = read(&path, &reading).map_err(|faults| faults.to_string())?;
    let made = objects(&model, "f", wanted).map_err(|faults| faults.to_string())?;
    Ok((made.value.task, made.notes.join("\n")))
}

/// Returns a cube with this side as OBJ.
pub(super) fn cube(side: f64) -> Vec<u8> {
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
fn a_mesh_is_a_thing_on_the_table() {
    let made = |unit: Option<f64>, density: Option<f64>, side: f64| {
        let wanted = Wanted { density, ..Wanted::default() };
        taken_of(&[("cube.obj", &cube(side))], &Reading { unit, ..strict() }, &wanted)
    };
    let (task, _) = made(Some(1e-3), Some(700.0), 60.0).expect("a task");
    let object = &task.scene.objects[0];
    assert_eq!(object.name, "cube");
    let area = object.shape.footprint().area();
    assert!((area - 0.0036).abs() < 1e-9 && (object.shape.height() - 0.06).abs() < 1e-9);
    assert!((object.mass - 700.0 * 0.06f64.powi(3)).abs() < 1e-9, "{}", object.mass);
    let fault = made(None, Some(700.0), 60.0).expect_err("60 m");
    assert!(fault.contains("--unit mm makes it 0.060 m"), "{fault}");
    let fault = made(Some(1e-3), None, 60.0).expect_err("no mass");
    assert!(fault.contains("--density 700"), "{fault}");
    let broken = taken_of(&[("cube.stl", b"solid x\nfacet")], &strict(), &Wanted::default());
    assert!(broken.expect_err("a fault").contains("cannot be read as a mesh"));
}

#[test]
fn a_mesh_that_is_not_convex_has_parts() {
    // An L-shaped prism as one closed mesh.
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
    let (task, _) = taken_of(&files, &strict(), &Wanted::default()).expect("a task");
    let object = &task.scene.objects[0];
    assert!((object.mass - 0.216).abs() < 1e-9 && object.support == Support::Even);
    // A fault of an included file has its place in that file.
    let wrong = assets.replace("<asset>", "<compiler eulerseq='q'/><asset>");
    let files = [files[0], ("parts/assets.xml", wrong.as_bytes()), files[2]];
    let fault = taken_of(&files, &strict(), &Wanted::default()).expect_err("a fault");
    assert!(fault.contains("assets.xml:2:11: error: the compiler's eulerseq"), "{fault}");
    // Files above the folder are read only with a root folder.
    let scene = scene.replace("parts/", "../parts/");
    let assets = assets.replace("parts/", "../parts/");
    let files: [(&str, &[u8]); 3] =
        [("scenes/scene.xml", scene.as_bytes()), ("parts/assets.xml", assets.as_bytes()), files[2]];
    let fault = taken_of(&files, &strict(), &Wanted::default()).expect_err("a fault");
    assert!(
        fault.contains("outside the folder of the file") && fault.contains("--root "),
        "{fault}"
    );
    let root = Reading { root: Some("".into()), ..strict() };
    taken_of(&files, &root, &Wanted::default()).expect("the advice was followed");
    let circle = "<mujoco><include file='a.xml'/></mujoco>";
    let circle = taken_of(&[("a.xml", circle.as_bytes())], &strict(), &Wanted::default());
    assert!(circle.expect_err("a fault").contains("include each other"));
}

#[test]
fn bodies_of_other_models_are_attached_at_their_frames() {
    let scene = "<mujoco><asset><model name='m' file='parts/tray.xml'/></asset><worldbody>\
                 <geom type='plane' size='1 1 1'/>\
                 <body name='left' pos='.5 .2 0' euler='0 0 90'><freejoint/>\
                 <attach model='m' body='tray' prefix='a-'/></body>\
                 <frame pos='.5 -.2 0'><attach model='m' body='can' prefix='b-'/></frame>\
                 </worldbody></mujoco>";
    // The attached model has its own mesh folder and angle unit; the can is attached to the tray's
    // stand.
    let tray = "<mujoco model='m'><compiler angle='radian' meshdir='meshes'/><asset>\
                <mesh name='cube' file='cube.obj' scale='.001 .001 .001'/></asset><worldbody>\
                <body name='stand' pos='9 9 0'><body name='tray' pos='.1 0 .03' euler='0 0 1.5708'>\
                <geom type='box' size='.05 .02 .03' mass='.3'/></body>\
                <body name='can' pos='0 .05 .03'><freejoint/><geom type='mesh' mesh='cube'/></body>\
                </body></worldbody></mujoco>";
    let solid = cube(60.0);
    let files: [(&str, &[u8]); 3] = [
        ("scene.xml", scene.as_bytes()),
        ("parts/tray.xml", tray.as_bytes()),
        ("parts/meshes/cube.obj", &solid),
    ];
    let (task, _) = taken_of(&files, &strict(), &Wanted::default()).expect("a task");
    let objects = &task.scene.objects;
    let names: Vec<&str> = objects.iter().map(|one| one.name.as_str()).collect();
    // An object is named after the body that has its solids.
    assert_eq!(names, ["a-tray", "b-can"]);
    let at = |k: usize| objects[k].pose.position;
    assert!((at(0) - Vector::new(0.5, 0.3)).norm() < 1e-6, "{:?}", at(0));
    // The origin of the cube is its corner.
    assert!((at(1) - Vector::new(0.53, -0.12)).norm() < 1e-6, "{:?}", at(1));
    assert!((objects[0].mass - 0.3).abs() < 1e-9 && (objects[1].mass - 0.216).abs() < 1e-9);
    // Faults of the attached file have their places in that file, and are reported only where it is
    // attached.
    let bad = tray.replace("angle='radian'", "eulerseq='q'");
    let wrong = [files[0], ("parts/tray.xml", bad.as_bytes()), files[2]];
    let fault = taken_of(&wrong, &strict(), &Wanted::default()).expect_err("a fault");
    assert!(fault.contains("tray.xml:1:") && fault.contains("eulerseq"), "{fault}");
    for (good, bad, message) in [
        ("body='can'", "body='cup'", "the model `m` has no body `cup`"),
        ("<attach model='m' body='can'", "<attach model='n' body='can'", "there is no model `n`"),
        ("parts/tray.xml", "parts/none.xml", "there is no file"),
    ] {
        let scene = scene.replace(good, bad);
        let files = [("scene.xml", scene.as_bytes()), files[1], files[2]];
        let fault = taken_of(&files, &strict(), &Wanted::default()).expect_err("a fault");
        assert!(fault.contains(message), "{bad}: {fault}");
    }
}

#[test]
fn models_that_attach_each_other_or_far_too_much_are_faults_at_once() {
    let attaching = |file: &str, times: usize| {
        let body = |k| format!("<attach model='m' body='b' prefix='{k}-'/>");
        let bodies: String = (0..times).map(body).collect();
        format!(
            "<mujoco><asset><model name='m' file='{file}'/><model name='n' file='{file}'/></asset><worldbody>\
             <body name='b'><freejoint/><geom size='.05'/>{bodies}</body></worldbody></mujoco>"
        )
    };
    let fault = |files: &[(String, String)]| {
        let files: Vec<(&str, &[u8])> =
            files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect();
        taken_of(&files, &strict(), &Wanted::default()).expect_err("a fault")
    };
    let own = fault(&[("a.xml".into(), attaching("a.xml", 1))]);
    assert!(own.contains("attach each other"), "{own}");
    let two = [("a.xml".into(), attaching("b.xml", 1)), ("b.xml".into(), attaching("a.xml", 1))];
    assert!(fault(&two).contains("attach each other"));
    // There is no cycle, but each file names the next twice: 2^14 files and 4^14 bodies.
    let file = |k: usize| (format!("{k}.xml"), attaching(&format!("{}.xml", k + 1), 4));
    let mut chain: Vec<(String, String)> = (0..14).map(file).collect();
    chain.push(("14.xml".into(), attaching("", 0).replace("file=''", "file='14.xml'")));
    let many = fault(&chain);
    assert!(many.contains("far too many") || many.contains("more than 5000"), "{many}");
}

#[test]
fn damaged_meshes_and_folders_are_faults() {
    assert!(read(Path::new("/nowhere/thing.stl"), &Reading::default()).is_err());
    let flat = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let made = taken_of(&[("flat.obj", flat)], &strict(), &Wanted::default());
    assert!(made.expect_err("a fault").contains("flat"));
}
