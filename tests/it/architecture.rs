//! The house keeps its order: who may import whom, what a file begins with, how long it grows.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms in order; a module imports only from rooms before its own.
const ROOMS: [&str; 17] = [
    "geometry", "scene", "asset", "sim", "contact", "graph", "network", "rollout", "effect", "plan",
    "verify", "solve", "dataset", "train", "bench", "report", "cli",
];

/// Imports that the order would allow and the design forbids, with the reason.
const FORBIDDEN: [(&str, &str, &str); 1] =
    [("verify", "plan", "the check must not share code with what it checks")];

/// Longer files must be listed here with the reason.
const LONGEST: usize = 400;
const LONG_FILES: [(&str, &str); 0] = [];

#[test]
fn rooms_import_only_from_rooms_before_them() {
    let mut wrong = Vec::new();
    for (path, text) in sources("src") {
        let Some(room) = room_of(&path) else { continue };
        for (number, used) in imports(&text) {
            let order = |name: &str| ROOMS.iter().position(|room| *room == name);
            let place = format!("{}:{number}", path.display());
            match (order(&room), order(&used)) {
                (Some(own), Some(other)) if other > own => {
                    wrong.push(format!("{place}: {room} imports {used}, which comes after it"));
                }
                (None, _) => wrong.push(format!("{place}: the room {room} is not in the order")),
                _ => {}
            }
            for (from, to, reason) in FORBIDDEN {
                if room == from && used == to {
                    wrong.push(format!("{place}: {from} imports {to}: {reason}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_file_says_what_it_is() {
    for (path, text) in ["src", "tests", "benches", "fuzz"].into_iter().flat_map(sources) {
        assert!(text.starts_with("//! "), "{} does not begin with `//! `", path.display());
    }
}

#[test]
fn files_stay_short() {
    for (path, text) in ["src", "tests", "benches", "fuzz"].into_iter().flat_map(sources) {
        let excused = LONG_FILES.iter().any(|(name, _)| path == Path::new(name));
        let lines = text.lines().count();
        assert!(
            excused || lines <= LONGEST,
            "{} has {lines} lines: split it by subject, or list it with a reason",
            path.display()
        );
    }
}

#[test]
fn folders_begin_with_a_table_of_contents() {
    for (path, text) in sources("src") {
        if path.ends_with("mod.rs") {
            let logic = text.lines().position(|line| {
                let line = line.trim_start();
                [
                    "fn ",
                    "pub fn ",
                    "struct ",
                    "pub struct ",
                    "impl ",
                    "enum ",
                    "pub enum ",
                    "static ",
                ]
                .iter()
                .any(|start| line.starts_with(start))
            });
            assert_eq!(logic, None, "{} holds logic", path.display());
            assert!(!text.contains("::*;"), "{} re-exports by a glob", path.display());
        }
    }
}

#[test]
fn the_engines_and_the_yaml_crate_stay_behind_their_doors() {
    let doors: [(&str, &[&str]); 4] = [
        ("serde_yaml", &["asset"]),
        ("rapier2d", &["sim"]),
        ("rapier3d", &["sim"]),
        ("clarabel", &["plan"]),
    ];
    for (path, text) in sources("src") {
        let Some(room) = room_of(&path) else { continue };
        for (name, allowed) in doors {
            let used = text.lines().any(|line| {
                let code = line.split("//").next().unwrap_or_default();
                code.contains(&format!("{name}::")) || code.contains(&format!("{name}_f64::"))
            });
            assert!(!used || allowed.contains(&room.as_str()), "{} names {name}", path.display());
        }
    }
}

/// Room names after `crate::` in the code of a file (not in comments), with their lines. A test
/// module counts too: it would tie the rooms just as well.
fn imports(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        for after in code.split("crate::").skip(1) {
            // `crate::{a::b, c}` names several rooms.
            let names: Vec<&str> = match after.strip_prefix('{') {
                Some(list) => list.split(',').collect(),
                None => vec![after],
            };
            for name in names {
                let end = |c: char| !(c.is_alphanumeric() || c == '_');
                let name = name.trim().split(end).next().unwrap_or_default();
                if ROOMS.contains(&name) {
                    found.push((number + 1, name.to_owned()));
                }
            }
        }
    }
    found
}

/// `src/plan/qp.rs` is in the room `plan`; `src/lib.rs` and `src/main.rs` are in none.
fn room_of(path: &Path) -> Option<String> {
    let mut parts = path.strip_prefix("src").ok()?.components();
    let first = parts.next()?.as_os_str().to_str()?.to_owned();
    parts.next().map(|_| first)
}

/// Every Rust file under `folder`, with its path relative to the repository.
fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    let mut folders = vec![root.join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the repository") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                let path = path.strip_prefix(root).expect("inside the repository").to_path_buf();
                found.push((path, text));
            }
        }
    }
    assert!(!found.is_empty());
    found.sort();
    found
}
