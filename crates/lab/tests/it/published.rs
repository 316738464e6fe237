//! Published tables: each has a place, and pages state which of them are stale.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use pushplan::solve::Effort;
use pushplan_lab::bench::Answers;
use pushplan_lab::published::{
    Age, Fingerprint, Input, Place, Published, marked, place, recorded, select, tables,
};

use crate::ROOT;

/// Pieces of a run, minutes, and the whole, hours of processor time.
const PIECE: u16 = 150;
const WHOLE: u32 = 12;

fn pages() -> PathBuf {
    Path::new(ROOT).join("crates/lab/results")
}

fn page(table: &Published) -> String {
    fs::read_to_string(pages().join(table.page)).expect(table.page)
}

fn weights() -> PathBuf {
    Path::new(ROOT).join("crates/models")
}

/// Answers of the program as it is, which take seconds.
fn answers() -> &'static Answers {
    static ANSWERS: OnceLock<Answers> = OnceLock::new();
    ANSWERS.get_or_init(|| Answers::of(Effort::Draft.settings()).unwrap())
}

#[test]
fn every_table_has_one_place_and_every_place_a_table() {
    let mut names = HashSet::new();
    for table in tables() {
        assert!(names.insert(table.name), "{} is listed twice", table.name);
        assert!(place(&page(table), table.name).is_some(), "{} has no place", table.name);
        assert!(table.minutes <= PIECE, "{} exceeds a piece", table.name);
    }
    for entry in fs::read_dir(pages()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "md") {
            let text = fs::read_to_string(&path).unwrap();
            for name in text.split("<!-- table ").skip(1).filter_map(|rest| rest.split(' ').next())
            {
                assert!(names.contains(name), "{}: no table `{name}`", path.display());
            }
        }
    }
    let minutes: u32 = tables().map(|table| u32::from(table.minutes)).sum();
    assert!(minutes <= 60 * WHOLE, "{minutes} minutes of processor time");
}

#[test]
fn pages_state_which_tables_are_stale() {
    let now = Fingerprint::of(&weights(), answers()).unwrap();
    for table in tables() {
        let page = page(table);
        assert!(
            marked(&page, table, &now).unwrap() == page,
            "{}: the mark of the table `{}` is wrong: run `pushplan-lab measure --check`",
            table.page,
            table.name
        );
    }
}

/// Names of the tables that are stale after all were measured with `before`.
fn stale(before: &Fingerprint, now: &Fingerprint) -> HashSet<&'static str> {
    let age = || Age {
        commit: "0123abcd".into(),
        date: "2026-11-28".into(),
        minutes: "1.0".into(),
        machine: "a processor, 2 cores".into(),
    };
    let is_stale = |table: &&Published| {
        let fresh = Place::fresh(table, "|a|\n|---|\n|1|\n".into(), &age(), before);
        let measured = recorded(&page(table), table.name, &fresh).unwrap();
        let today = marked(&measured, table, now).unwrap();
        let read = place(&today, table.name).unwrap();
        assert_eq!(Place { stale: None, ..read.clone() }, fresh, "{}", table.name);
        read.stale.is_some()
    };
    tables().filter(is_stale).map(|table| table.name).collect()
}

fn depending_on(inputs: &[Input]) -> HashSet<&'static str> {
    let depends = |table: &&Published| table.inputs.iter().any(|input| inputs.contains(input));
    tables().filter(depends).map(|table| table.name).collect()
}

#[test]
fn other_weights_and_other_verification_mark_the_tables_that_depend_on_them() {
    let before = Fingerprint::of(&weights(), answers()).unwrap();
    assert!(stale(&before, &before).is_empty());

    let folder = tempfile::TempDir::new().unwrap();
    for (file, input) in [
        ("brdpn.safetensors", Input::Network),
        ("regulator.safetensors", Input::Regulator),
        ("lever.safetensors", Input::Lever),
    ] {
        for name in ["brdpn.safetensors", "regulator.safetensors", "lever.safetensors"] {
            fs::copy(weights().join(name), folder.path().join(name)).unwrap();
        }
        let mut bytes = fs::read(folder.path().join(file)).unwrap();
        *bytes.last_mut().unwrap() ^= 1;
        fs::write(folder.path().join(file), bytes).unwrap();
        let now = Fingerprint::of(folder.path(), answers()).unwrap();
        assert_eq!(stale(&before, &now), depending_on(&[input]), "{file}");
    }

    let draft = Effort::Draft.settings();
    let stricter = Answers::of(draft.replaying(draft.replays + 1)).unwrap();
    let now = Fingerprint::of(&weights(), &stricter).unwrap();
    assert_eq!(stale(&before, &now), depending_on(&[Input::Plans, Input::LeverUps]));
    let kept = ["prediction", "real-pushes", "masses", "cost"];
    assert!(kept.iter().all(|name| !stale(&before, &now).contains(name)));
}

#[test]
fn parts_of_an_output_are_selected_with_units_in_the_header() {
    let output = "## a run: 2 tasks\n\nFirst:\n\n| model | mean | mean | note |\n| --- | --: | --: | --- |\n\
                  | one | 1.5 mm | 3 \u{b5}s | a\\|b |\n| two | 2.0 mm | 1 ms | |\n\nLast:\n\n| x |\n| - |\n| 1 |\n";
    let picked = select(output, &[("First", &["model", "mean#1", "mean"], &["| two |"])]).unwrap();
    assert_eq!(picked, "|model|mean|mean|\n|---|--:|--:|\n|two|1 ms|2.0 mm|\n");
    let both = select(output, &[("First", &["mean", "mean#1", "note"], &[]), ("Last", &[], &[])]);
    let table = "|mean, mm|mean|note|\n|--:|--:|---|\n|1.5|3 \u{b5}s|a\\|b|\n|2.0|1 ms||\n";
    assert_eq!(both.unwrap(), format!("First:\n\n{table}\nLast:\n\n|x|\n|---|\n|1|\n"));
    let long = output.replace("First", &"First ".repeat(20));
    let wrapped = select(&long, &[("First", &["note"], &[]), ("Last", &[], &[])]).unwrap();
    assert!(wrapped.starts_with(&format!("{}\nFirst", ["First"; 16].join(" "))), "{wrapped}");
    let plain = "one: 3 of 5\ntwo: 4 of 5\n7 of 10 solved\n";
    assert_eq!(select(plain, &[("", &[], &["solved"])]).unwrap(), "```text\n7 of 10 solved\n```\n");
    for (pick, fault) in [
        (("Third", &[][..], &[][..]), "no table `Third`"),
        (("First", &["p95"], &[]), "no column `p95` in `First`"),
        (("First", &[], &["three"]), "no row with [\"three\"] in `First`"),
    ] {
        assert_eq!(select(output, &[pick]).unwrap_err(), fault);
    }
}
