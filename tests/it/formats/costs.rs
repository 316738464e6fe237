//! Time and memory of imports, and files that are not read.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::program::{command, run, stderr};

/// Returns a body of boxes in a square lattice of different heights, as MJCF.
fn boxes(count: usize) -> String {
    let geom = |k: usize| {
        let [x, y] = [k % 20, k / 20].map(|step| 0.01 * step as f64 - 0.1);
        let half = 0.02 + 0.0001 * (k * 7 % 11) as f64;
        format!("<geom type='box' size='.004 .004 {half}' pos='{x} {y} {half}' mass='.01'/>\n")
    };
    let geoms: String = (0..count).map(geom).collect();
    format!(
        "<mujoco><worldbody><geom type='plane' size='2 2 .1'/><body name='pile' pos='.5 0 0'>\
         <freejoint/>\n{geoms}</body></worldbody></mujoco>"
    )
}

/// Returns thin boxes side by side, alternately long and short, as OBJ.
fn comb(teeth: usize) -> String {
    let (mut corners, mut faces) = (String::new(), String::new());
    for k in 0..teeth {
        let x = 0.2 * k as f64 / teeth as f64;
        for corner in 0..8 {
            let x = x + 3e-5 * f64::from(corner >> 2);
            let y = if k % 2 == 1 { 0.1 } else { 0.05 } * f64::from(corner >> 1 & 1);
            corners += &format!("v {x} {y} {}\n", 0.05 * f64::from(corner & 1));
        }
        for side in
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        {
            let [a, b, c, d] = side.map(|corner: usize| 8 * k + corner + 1);
            faces += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    corners + &faces
}

fn at(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, text).expect("a file");
    path.to_str().expect("UTF-8").to_owned()
}

#[test]
fn two_hundred_boxes_are_imported_in_seconds() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = at(folder.path(), "boxes.xml", &boxes(200));
    let began = Instant::now();
    let output = run(&["import", &file, "--as", "objects"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).contains("the 200 solids of `pile`"), "{}", stderr(&output));
    // It takes less than a second, and took 39 s when every pair was compared after every merge.
    assert!(began.elapsed() < Duration::from_secs(10), "{:?}", began.elapsed());
}

#[cfg(target_os = "linux")]
#[test]
fn a_mesh_of_thousands_of_pieces_needs_less_than_200_megabytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = at(folder.path(), "comb.obj", &comb(3000));
    let mut child = command(&["import", &file, "--as", "objects", "--density", "700"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command runs");
    let (status, mut peak) = (format!("/proc/{}/status", child.id()), 0);
    while child.try_wait().expect("a process").is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let kilobytes = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let number = kilobytes.and_then(|line| line.split_whitespace().next()?.parse().ok());
        peak = peak.max(number.unwrap_or(0));
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!((1..200_000).contains(&peak), "{peak} kB");
}

#[cfg(unix)]
#[test]
fn pipes_are_refused_without_waiting_for_a_writer() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["mesh.stl", "scene.xml", "task.yaml", "plan.json"] {
        let pipe = folder.path().join(name);
        assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
        let pipe = pipe.to_str().expect("UTF-8");
        let arguments = match name {
            "mesh.stl" | "scene.xml" => vec!["import", pipe, "--as", "objects"],
            _ => vec!["check", pipe],
        };
        let output = run(&arguments);
        assert_eq!(output.status.code(), Some(3), "{name}");
        let text = stderr(&output);
        assert!(text.contains("a pipe or a device") && text.contains("plain file"), "{text}");
    }
}

#[cfg(unix)]
#[test]
fn a_lock_is_not_written_through_a_link() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = at(folder.path(), "precious", "precious\n");
    let sent = folder.path().join("sent");
    fs::create_dir(&sent).expect("a folder");
    std::os::unix::fs::symlink("../precious", sent.join(".pushplan-lock")).expect("a link");
    let sent = sent.to_str().expect("UTF-8");
    let output = run(&["run", "tasks/pull-back.yaml", "--world", "2", "--out", sent]);
    assert_ne!(output.status.code(), Some(0));
    assert!(stderr(&output).contains("remove the link"), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(own).expect("the file"), "precious\n");
}
