//! Architecture rules: permitted imports, required file headers, maximum file length.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use crate::ROOT;

mod cycles;
mod plain_files;
pub mod reading;

use reading::{code_of, imports, names, sources};

/// Modules of a crate in order, each with the modules it may import, all of which stand before it.
/// An import that is not listed is not allowed, and an unused entry must be removed.
type Rooms = &'static [(&'static str, &'static str)];

/// Folder of a crate, prefix of its modules in [`DOORS`], and its modules; a crate without modules
/// counts as a module itself.
const HOUSES: [(&str, &str, Rooms); 12] = [
    ("src", "", &ROOMS),
    // Below the core, on which it does not depend.
    ("crates/kernel/src", "kernel", &[]),
    (
        "crates/act/src",
        "act/",
        &[
            ("judge", ""),
            ("fit", "judge"),
            ("regulator", ""),
            ("belief", "regulator"),
            ("act", "judge fit belief"),
        ],
    ),
    ("crates/arm/src", "arm", &[]),
    ("crates/bench/src", "bench", &[]),
    ("crates/design/src", "design", &[]),
    ("crates/report/src", "report", &[]),
    ("crates/import/src", "import", &[]),
    ("crates/export/src", "export", &[]),
    ("crates/command/src", "command", &[]),
    (
        "crates/learn/src",
        "learn/",
        &[
            ("dataset", ""),
            ("network", ""),
            ("judge", ""),
            ("lever_model", ""),
            ("train", "dataset network judge lever_model"),
            ("report", "train"),
            ("cli", "dataset train report"),
        ],
    ),
    (
        "crates/lab/src",
        "lab/",
        &[
            ("image", ""),
            ("parts", ""),
            ("trivial", ""),
            ("bench", "image parts trivial"),
            ("report", "bench"),
            ("published", "bench"),
            ("cli", "image parts trivial bench report published"),
        ],
    ),
];

const ROOMS: [(&str, &str); 15] = [
    ("geometry", ""),
    ("scene", "geometry"),
    ("task", "geometry scene"),
    ("outcome", "geometry scene task"),
    ("recording", "geometry scene task outcome"),
    ("asset", "geometry scene task outcome recording"),
    ("sim", "geometry scene task outcome"),
    ("contact", "geometry scene task"),
    ("graph", "geometry scene task contact"),
    ("network", "scene outcome graph"),
    ("rollout", "geometry scene task outcome contact graph"),
    ("effect", "geometry scene task outcome sim graph network rollout"),
    ("plan", "geometry scene task outcome effect"),
    // Without `plan`, because the check shares no code with the search.
    ("verify", "geometry scene task outcome sim"),
    ("solve", "geometry scene task outcome asset sim effect plan verify"),
];

/// Extra crates on top of the core, each with the extras and the modules of the core it may import.
/// Extras stand before their importers, so no extra imports the command.
const EXTRAS: [(&str, &str, &str); 8] = [
    ("import", "", "geometry scene task asset"),
    ("arm", "import", "geometry scene task asset"),
    ("export", "arm", "geometry scene task outcome asset"),
    (
        "act",
        "",
        "geometry scene task outcome recording asset sim graph network rollout effect solve",
    ),
    ("bench", "act", "geometry scene task outcome asset sim effect solve"),
    ("design", "", "geometry scene task asset effect plan solve"),
    (
        "report",
        "act bench design",
        "geometry scene task outcome recording asset contact plan solve",
    ),
    (
        "command",
        "act arm bench design report export import",
        "geometry scene task outcome recording asset sim network effect verify solve",
    ),
];

/// Crates that only the given modules may name, so that each can be replaced without changes
/// elsewhere.
const DOORS: [(&str, &str); 31] = [
    ("parry2d_f64", "geometry"),
    ("parry3d_f64", "geometry arm"),
    ("pushplan_models", "effect act/belief"),
    ("pushplan_kernel", "geometry scene contact"),
    ("pushplan_page", "report export"),
    ("pushplan_three", "report"),
    ("pushplan_learn", "lab/bench lab/cli lab/image lab/parts"),
    ("pushplan_lab", ""),
    ("serde_yaml", "asset"),
    ("rapier2d_f64", "sim"),
    ("rapier3d_f64", "sim"),
    ("nalgebra", "geometry arm kernel contact act/fit act/belief plan import lab/bench"),
    ("roxmltree", "arm import"),
    ("earcut", "import"),
    ("unicode_ident", "asset"),
    ("mcap", "export"),
    ("zip", "learn/dataset"),
    ("candle_core", "learn/network learn/train lab/image lab/parts"),
    ("safetensors", "network learn/train"),
    ("gemm", "learn/train"),
    ("gemm_common", "network"),
    ("gemm_f32", "network"),
    ("pulp", "network kernel"),
    ("clarabel", "plan"),
    (
        "rand",
        "network effect act/judge act/regulator act/belief plan verify design act/act bench lab/bench lab/image lab/parts learn/dataset learn/train",
    ),
    (
        "rand_pcg",
        "network effect act/judge act/regulator act/belief plan verify lab/bench lab/image lab/parts learn/dataset learn/train",
    ),
    ("postcard", "learn/dataset"),
    ("clap", "command learn/cli lab/cli"),
    ("clap_complete", "command"),
    ("indicatif", "command"),
    ("signal_hook", "command"),
];

/// Folders of Rust files.
const ROOTS: [&str; 4] = ["src", "tests", "examples", "crates"];

/// Maximum number of lines of a file; exceptions must be listed below with the reason.
const LONGEST: usize = 400;
const LONG_FILES: [(&str, &str); 0] = [];

#[test]
fn rooms_import_only_from_rooms_before_them() {
    for (_, _, rooms) in HOUSES {
        let order = |name: &str| rooms.iter().position(|(room, _)| *room == name);
        for (place, (room, allowed)) in rooms.iter().enumerate() {
            for other in allowed.split_whitespace() {
                let before = order(other).is_some_and(|other| other < place);
                assert!(before, "{room} may not import {other}, which does not stand before it");
            }
        }
    }
}

#[test]
fn rooms_import_only_the_modules_of_their_row() {
    let mut wrong = Vec::new();
    for (folder, _, rooms) in HOUSES {
        let mut used = HashSet::new();
        for (path, text) in sources(folder) {
            let Some(room) = room_of(&path).filter(|_| !rooms.is_empty()) else { continue };
            let Some((_, allowed)) = rooms.iter().find(|(name, _)| *name == room) else {
                wrong.push(format!("{}: the room {room} is not listed", path.display()));
                continue;
            };
            let listed = |other: &String| rooms.iter().any(|(name, _)| name == other);
            let others = imports(&text, "crate::").into_iter().filter(listed);
            for other in others.filter(|other| *other != room) {
                if !allowed.split(' ').any(|name| name == other) {
                    wrong.push(format!("{}: {room} imports {other}", path.display()));
                }
                used.insert((room.clone(), other));
            }
        }
        for (room, allowed) in rooms {
            for other in allowed.split_whitespace() {
                if !used.contains(&((*room).to_owned(), other.to_owned())) {
                    wrong.push(format!("{room} does not import {other} any more: strike it"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn extras_import_only_the_modules_of_their_row() {
    let mut wrong = Vec::new();
    for (place, (name, crates, rooms)) in EXTRAS.iter().enumerate() {
        let texts = sources(&format!("crates/{name}/src"));
        let code: String = texts.iter().map(|(_, text)| code_of(text)).collect();
        let others: Vec<&str> = EXTRAS.iter().map(|(other, ..)| *other).collect();
        for (at, other) in others.iter().enumerate().filter(|(_, other)| *other != name) {
            let used = names(&code, &format!("pushplan_{other}"));
            let listed = crates.split_whitespace().any(|listed| listed == *other);
            if used != listed {
                wrong.push(format!("{name} imports {other}: {used}, but listed: {listed}"));
            }
            assert!(!listed || at < place, "{name} may not import {other}, which stands after it");
        }
        let used: HashSet<String> = imports(&code, "pushplan::").into_iter().collect();
        for (room, _) in ROOMS {
            let (used, listed) =
                (used.contains(room), rooms.split_whitespace().any(|listed| listed == room));
            if used != listed {
                wrong.push(format!("{name} imports {room} of the core: {used}, listed: {listed}"));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn only_the_making_of_random_tasks_goes_around_the_planner() {
    for (path, text) in ["crates/bench/src", "crates/lab/src"].into_iter().flat_map(sources) {
        let excused = path.starts_with("crates/lab/src/bench/random");
        let imported = [imports(&text, "pushplan::"), imports(&text, "internals::")].concat();
        let goes_around = imported.iter().any(|other| other == "plan");
        assert!(excused || !goes_around, "{}: benchmarks measure the planner", path.display());
    }
}

#[test]
fn crates_are_named_behind_their_doors_only() {
    let mut wrong = Vec::new();
    let mut used = HashSet::new();
    for (folder, house, _) in HOUSES {
        for (path, text) in sources(folder) {
            let Some(room) = room_of(&path).map(|room| format!("{house}{room}")) else { continue };
            let code = code_of(&text);
            for (name, allowed) in DOORS.iter().filter(|(name, _)| names(&code, name)) {
                if !allowed.split(' ').any(|name| name == room) {
                    wrong.push(format!("{} names {name}", path.display()));
                }
                used.insert((*name, room.clone()));
            }
        }
    }
    for (name, allowed) in DOORS {
        let unused = |room: &&str| !used.contains(&(name, (*room).to_owned()));
        for room in allowed.split_whitespace().filter(unused) {
            wrong.push(format!("{room} does not name {name} any more: strike it"));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Files outside modules also count: examples, tests and Cargo manifests.
#[test]
fn crates_do_not_know_what_is_above_them() {
    let extras: Vec<&str> = EXTRAS.iter().map(|(name, ..)| *name).collect();
    let makers = &["learn", "lab"][..];
    let all = [&extras[..], makers].concat();
    let crates = extras.iter().map(|name| (vec![format!("crates/{name}")], makers));
    let core = (vec!["src".to_owned()], &all[..]);
    let outside = (vec!["tests".to_owned(), "examples".to_owned()], makers);
    let others = [("learn", &["lab"][..]), ("python", makers), ("browser", makers)]
        .map(|(name, unknown)| (vec![format!("crates/{name}")], unknown));
    for (folders, unknown) in crates.chain([core, outside]).chain(others) {
        for folder in &folders {
            let manifest = Path::new(ROOT).join(folder.trim_end_matches("src")).join("Cargo.toml");
            let cargo = fs::read_to_string(manifest).unwrap_or_default();
            for name in unknown {
                // Only dependencies count, because profiles may name packages in their own way.
                let known = cargo.contains(&format!("\npushplan-{name} = {{ path"));
                assert!(!known, "the manifest of {folder} names {name}");
                for (path, text) in sources(folder) {
                    let named = names(&code_of(&text), &format!("pushplan_{name}"));
                    assert!(!named, "{} names pushplan_{name}", path.display());
                }
            }
        }
    }
}

#[test]
fn imports_are_found_however_they_are_written() {
    let text = "use crate::{\n    geometry::{Pose, Vector},\n    scene::Job, // crate::plan\n};\n\
                fn f() -> crate::sim::Simulator {}\npub(crate) use crate::{asset};";
    assert_eq!(imports(text, "crate::"), ["geometry", "scene", "sim", "asset"]);
    let code = "use rand::Rng; use my_rapier2d::X;";
    assert!(names(code, "rand") && !names(code, "rapier2d") && !names(code, "rand_pcg"));
}

#[test]
fn the_documentation_lists_the_rooms_in_their_order() {
    let text = include_str!("../../src/internals.rs");
    let paragraphs: Vec<String> =
        text.split("//!\n").map(|part| part.replace("//!", "").replace('\n', " ")).collect();
    let order = ROOMS.map(|(room, _)| room).join(", ");
    let listed = |part: &String| part.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(paragraphs.iter().any(|part| listed(part).starts_with(&order)), "{order}");
}

#[test]
fn every_file_states_its_kind() {
    for (path, text) in ROOTS.into_iter().flat_map(sources) {
        assert!(text.starts_with("//! "), "{} does not begin with `//! `", path.display());
    }
}

#[test]
fn files_stay_short() {
    for (path, text) in ROOTS.into_iter().flat_map(sources) {
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
    for (path, text) in HOUSES.into_iter().flat_map(|(folder, ..)| sources(folder)) {
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

/// Returns the module of a file: a crate without modules is one itself. Otherwise `src/plan/qp.rs`
/// is in the module `plan`, and a file with the name of a module is that module. `src/lib.rs` and
/// `src/main.rs` are in none.
fn room_of(path: &Path) -> Option<String> {
    let (folder, _, rooms) = HOUSES.iter().find(|(folder, ..)| path.starts_with(folder))?;
    if rooms.is_empty() {
        return Some(String::new());
    }
    let mut parts = path.strip_prefix(folder).ok()?.components();
    let first = Path::new(parts.next()?.as_os_str()).file_stem()?.to_str()?.to_owned();
    let listed = rooms.iter().any(|(room, _)| *room == first);
    (listed || parts.next().is_some()).then_some(first)
}
