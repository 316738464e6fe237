//! Files that an arm names, and tools that its mount cannot hold.

use std::fs;
use std::process::Command;

use crate::program::{run, stderr};

use super::{URDF, at, folder, write};

#[test]
fn meshes_of_an_arm_are_in_its_folder_or_in_one_that_the_user_allows() {
    let folder = folder("{urdf: arm/six.urdf, flange: tool0, tool_mount: {length: 0.1}}");
    let folder = folder.path();
    for inner in ["arm", "outside"] {
        fs::create_dir(folder.join(inner)).expect("a folder");
    }
    let corner = |k: usize| [k & 1, k >> 1 & 1, k >> 2].map(|bit| 0.04 * bit as f64 - 0.02);
    let corners = (0..8).map(corner).map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let mesh = corners.collect::<String>() + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\n";
    for place in ["arm/own.obj", "outside/secret.obj"] {
        write(folder, place, &mesh);
    }
    let secret = at(folder, "outside/secret.obj");
    let check = |mesh: &str, options: &[&str]| {
        let mesh = format!("<mesh filename=\"{mesh}\"/>");
        write(folder, "arm/six.urdf", &URDF.replacen("<sphere radius=\"0.04\"/>", &mesh, 1));
        run(&[&["check", &at(folder, "push.yaml")][..], options].concat())
    };
    assert_eq!(check("own.obj", &[]).status.code(), Some(0));
    for outside in ["../outside/secret.obj", &secret, &format!("file://{secret}")] {
        let output = check(outside, &[]);
        assert_eq!(output.status.code(), Some(3), "{outside}");
        let text = stderr(&output);
        assert!(text.contains("outside the folder of the file") && !text.contains("\\u"), "{text}");
        let (_, advice) = text.split_once("--root ").expect("a remedy");
        let root = advice.split(" allows").next().expect("a folder");
        assert_eq!(check(outside, &["--root", root]).status.code(), Some(0), "{outside}");
        assert_eq!(check(outside, &["--root", &at(folder, "arm")]).status.code(), Some(3));
    }
    // A pipe is refused, not waited for.
    let pipe = at(folder, "arm/pipe.obj");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    let output = check("pipe.obj", &[]);
    assert!(stderr(&output).contains("it is a pipe or a device"), "{}", stderr(&output));
}

#[test]
fn a_missing_urdf_is_one_line_with_a_remedy() {
    let folder = folder("{urdf: none.urdf, flange: tool0}");
    let output = run(&["check", &at(folder.path(), "push.yaml")]);
    assert_eq!(output.status.code(), Some(3));
    let text = stderr(&output);
    assert!(
        text.contains("none.urdf: cannot read the file") && text.contains("  help: "),
        "{text}"
    );
    assert!(!text.contains("\\u000a") && text.lines().count() == 2, "{text}");
}

#[test]
fn a_tool_higher_than_its_mount_is_refused() {
    let folder = folder("{urdf: six.urdf, flange: tool0, tool_mount: {length: LENGTH}}");
    let path = at(folder.path(), "push.yaml");
    let text = fs::read_to_string(&path).expect("a file");
    for (length, tools, message) in [
        ("0.06", "[stick, paddle]", None),
        ("0.04", "[stick, paddle]", Some("push.yaml:5:9: error: `stick` is 0.050 m high")),
        ("0.04", "all", Some("higher than `tool_mount` is long")),
    ] {
        let task = text.replace("LENGTH", length).replace("[stick, paddle]", tools);
        write(folder.path(), "push.yaml", &task);
        let command = if tools == "all" { "solve" } else { "check" };
        let output = run(&[command, &path]);
        let found = stderr(&output);
        assert_eq!(output.status.code(), Some(if message.is_some() { 3 } else { 0 }), "{found}");
        assert!(message.is_none_or(|message| found.contains(message)), "{found}");
    }
}
