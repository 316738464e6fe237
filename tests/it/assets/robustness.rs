//! No text, however damaged, makes a reader panic; every refusal has an explanation.

use std::time::{Duration, Instant};

use proptest::prelude::*;
use pushplan::asset::{Faults, PlanFile, TrajectoryFile};
use pushplan::recording::Recording;
use pushplan::{scene::Tool, task::Task};

use super::recordings;
use super::saved::{plan_file, trajectory_file};
use super::snippets::SNIPPETS;

const TOOL: &str = include_str!("../../../tools/l-hook.yaml");
const TASKS: [&str; 3] = [
    include_str!("../../../tasks/pull-back-behind-wall.yaml"),
    include_str!("../../../tasks/keep-heading.yaml"),
    include_str!("../../../tasks/reference-chain.yaml"),
];

/// Reads `text` in every way and checks the messages.
fn read(text: &str) {
    explained(Tool::parse(text, "t"));
    explained(Task::parse(text, "t"));
    explained(PlanFile::parse(text, "t"));
    explained(TrajectoryFile::parse(text, "t"));
    explained(Recording::parse(text, "t"));
    explained(Recording::parse(text, "t.json"));
}

fn explained<T>(read: Result<T, Faults>) {
    if let Err(faults) = read {
        assert!(!faults.0.is_empty());
        assert!(faults.0.iter().all(|fault| !fault.message.is_empty()));
    }
}

/// Replaces `length` characters of `text` from the relative position `start` with `new`.
fn spoiled(text: &str, start: f64, length: usize, new: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let start = (start * letters.len() as f64) as usize;
    let end = (start + length).min(letters.len());
    letters[..start]
        .iter()
        .copied()
        .chain(new.chars())
        .chain(letters[end..].iter().copied())
        .collect()
}

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        read(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_soup_of_yaml_is_read_or_refused(parts in prop::collection::vec(0..SNIPPETS.len(), 0..30)) {
        read(&parts.into_iter().map(|k| SNIPPETS[k]).collect::<String>());
    }

    #[test]
    fn spoiled_user_files_are_read_or_refused(
        file in 0..4usize, start in 0.0..1.0, length in 0..12usize, snippet in 0..SNIPPETS.len(),
    ) {
        let text = if file < 3 { TASKS[file] } else { TOOL };
        let text = spoiled(text, start, length, SNIPPETS[snippet]);
        if file < 3 { explained(Task::parse(&text, "t")) } else { explained(Tool::parse(&text, "t")) }
    }

    #[test]
    fn spoiled_recordings_are_read_or_refused(
        yaml in any::<bool>(), start in 0.0..1.0, length in 0..12usize, snippet in 0..SNIPPETS.len(),
    ) {
        let (text, file) = if yaml { (recordings::SOUND, "t") } else { (recordings::PUSH, "t.json") };
        let read = Recording::parse(&spoiled(text, start, length, SNIPPETS[snippet]), file);
        // An accepted recording can also be replayed.
        explained(read.map(|recording| recording.replay()));
    }

    #[test]
    fn spoiled_saved_files_are_read_or_refused(
        start in 0.0..1.0, length in 0..12usize, snippet in 0..SNIPPETS.len(),
    ) {
        let plan = serde_json::to_string(&plan_file("pull-back.yaml")).unwrap();
        explained(PlanFile::parse(&spoiled(&plan, start, length, SNIPPETS[snippet]), "t"));
        let motion = serde_json::to_string(&trajectory_file("narrow-gap.yaml")).unwrap();
        explained(TrajectoryFile::parse(&spoiled(&motion, start, length, SNIPPETS[snippet]), "t"));
    }
}

#[test]
fn deep_nesting_is_refused_at_once_with_its_place() {
    let closed = |open: &str, close: &str, count: usize| open.repeat(count) + &close.repeat(count);
    let shallow = "- {a: [1, 'x']}\n".repeat(3000);
    let texts = [
        ("brackets", closed("[", "]", 100_000), (1, 33)),
        ("open brackets", "[".repeat(200_000), (1, 33)),
        ("maps", closed("{a: ", "}", 20_000), (1, 129)),
        ("open maps", "{a: ".repeat(60_000), (1, 129)),
        ("keys", closed("{? ", "}", 50_000), (1, 97)),
        ("dashes", "- ".repeat(100_000), (1, 65)),
        ("question marks", "? ".repeat(100_000), (1, 65)),
        ("behind a tag", format!("[!t x, {}", "{a: ".repeat(60_000)), (1, 2)),
        ("behind a wrong float", format!("[!!float x, {}", "{a: ".repeat(60_000)), (1, 2)),
        ("in a second document", format!("a: 1\n---\n{}", "{a: ".repeat(60_000)), (2, 1)),
        ("behind much that is shallow", shallow + "- " + &"{a: ".repeat(50_000), (3001, 127)),
        ("behind an error", format!("a: ]\n{}", "{a: ".repeat(60_000)), (1, 4)),
    ];
    for (what, text, place) in texts {
        let begun = Instant::now();
        for file in ["t.yaml", "t.json"] {
            let faults = Recording::parse(&text, file).unwrap_err();
            assert_eq!(faults.0.len(), 1, "{what}: {faults}");
            if file == "t.yaml" {
                let found = faults.0[0].place.map(|place| (place.line, place.column));
                assert_eq!(found, Some(place), "{what}: {faults}");
            }
            assert!(faults.to_string().contains("help:"), "{what}: {faults}");
        }
        // Without the check some of these take minutes; with it, some hundredths of a second.
        assert!(begun.elapsed() < Duration::from_secs(10), "{what}: {:?}", begun.elapsed());
    }
    let faults = Tool::parse(&"[".repeat(100_000), "t").unwrap_err();
    assert_eq!(
        faults.to_string(),
        "t:1:33: error: lists and maps are nested too deeply: more than 32 levels\n  help: look for \
         brackets that are never closed, or check whether this is the right file"
    );
    let faults = PlanFile::parse(&closed("[", "]", 100_000), "t").unwrap_err();
    assert!(faults.to_string().starts_with("t:1:33: error: lists and maps"), "{faults}");
}

#[test]
fn alias_bombs_are_refused() {
    let mut bomb = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x]\n");
    for k in 1..12 {
        let aliases = vec![format!("*a{}", k - 1); 9].join(", ");
        bomb.push_str(&format!("a{k}: &a{k} [{aliases}]\n"));
    }
    let faults = Task::parse(&bomb, "t").unwrap_err();
    assert!(faults.to_string().contains("not valid YAML"), "{faults}");
}
