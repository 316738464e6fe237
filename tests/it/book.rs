//! The book is consistent with the program: its links are valid, its commands are accepted, its
//! files load, and its tables of keys match the schemas.

use std::fs;
use std::path::{Path, PathBuf};

use pushplan::{Task, Tool};
use serde_json::Value as Json;
use serde_yaml::Value as Yaml;

use crate::ROOT;
use crate::pages::blocks;
use crate::program::{run, stderr};

/// Command that regenerates the tables of keys.
const UPDATE: &str = "PUSHPLAN_BOOK=write cargo test --release --test it -- book";

/// Page with its path below `book/src`.
type Page = (String, String);

#[test]
fn every_page_is_in_the_summary_and_every_link_leads_somewhere() {
    let summary = read("SUMMARY.md");
    let listed: Vec<String> = links(&summary).into_iter().map(|(to, _)| to).collect();
    let mut there: Vec<String> = fs::read_dir(source())
        .expect("the book")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".md") && name != "SUMMARY.md")
        .collect();
    there.sort();
    let mut pages: Vec<&String> = listed.iter().filter(|path| !path.contains('/')).collect();
    pages.sort();
    assert_eq!(there.iter().collect::<Vec<_>>(), pages, "other pages than the summary's");

    let mut wrong = Vec::new();
    for (path, text) in pages_of(&listed) {
        for (to, anchor) in links(&text) {
            let folder = Path::new(&path).parent().expect("a folder");
            let target = if to.is_empty() { PathBuf::from(&path) } else { folder.join(&to) };
            let name = plain(&target);
            let is_page = name.ends_with(".md");
            // A page outside of the book would become a broken link in its HTML.
            if !source().join(&name).exists() || is_page && !listed.contains(&name) {
                wrong.push(format!("{path}: {to}"));
            } else if is_page && !anchor.is_empty() && !headings(&read(&name)).contains(&anchor) {
                wrong.push(format!("{path}: {to}#{anchor}"));
            }
        }
        for file in text.split("{{#include ").skip(1).filter_map(|rest| rest.split("}}").next()) {
            let file = file.split(':').next().unwrap_or(file);
            if !source().join(file).exists() {
                wrong.push(format!("{path}: includes {file}"));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Commands of programs are checked in `pages`; scripts must exist in the repository.
#[test]
fn its_commands_are_known() {
    for (path, text) in own_pages() {
        for block in blocks(&text, "sh") {
            for line in block.replace("\\\n", " ").lines().map(str::trim) {
                let mut words = line.split(' ').skip_while(|word| word.contains('='));
                let program = words.next().unwrap_or_default();
                let known = ["pip", "pushplan", "pushplan-learn", "pushplan-lab"];
                let known = known.contains(&program) || Path::new(ROOT).join(program).is_file();
                // For Python, only modules of the package count.
                let mut module =
                    || words.nth(1).is_some_and(|module| module.starts_with("pushplan."));
                let known = known || program == "python" && module();
                assert!(known, "{path}: {line}");
            }
        }
    }
}

#[test]
fn its_files_are_right() {
    let (mut tasks, mut tools, mut worlds, mut levers) = (0, 0, 0, 0);
    for (path, text) in own_pages() {
        for block in blocks(&text, "yaml") {
            let keys: Yaml = serde_yaml::from_str(&block).expect("YAML");
            if keys.get("levers").is_some() {
                Task::parse(&block, &path).unwrap_or_else(|faults| panic!("{faults}"));
                levers += 1;
            } else if keys.get("blade").is_some() {
                Tool::parse(&block, &path).unwrap_or_else(|faults| panic!("{faults}"));
                levers += 1;
            } else if keys.get("goal").is_some() {
                Task::parse(&block, &path).unwrap_or_else(|faults| panic!("{faults}"));
                tasks += 1;
            } else if keys.get("parts").is_some() {
                Tool::parse(&block, &path).unwrap_or_else(|faults| panic!("{faults}"));
                tools += 1;
            } else {
                // A world is checked with the task on the same page.
                let task = blocks(&text, "yaml").remove(0);
                let folder = tempfile::tempdir().expect("a folder");
                let [world, task] =
                    [("world.yaml", &block), ("task.yaml", &task)].map(|(name, text)| {
                        let file = folder.path().join(name);
                        fs::write(&file, text).expect("a file");
                        file
                    });
                let [world, task, out] =
                    [&world, &task, folder.path()].map(|path| path.to_str().expect("UTF-8"));
                let output =
                    run(&["run", "--max-pushes", "1", "--world", world, task, "--out", out]);
                let error = stderr(&output);
                assert!(matches!(output.status.code(), Some(0 | 4 | 5)), "{path}: {error}");
                worlds += 1;
            }
        }
    }
    assert!(tasks >= 3 && tools >= 2 && worlds >= 1, "{tasks} {tools} {worlds}");
    assert_eq!(levers, 2, "a task of levering and a tool with a blade");
}

#[test]
fn its_tables_of_keys_are_those_of_the_schemas() {
    let write = std::env::var_os("PUSHPLAN_BOOK").is_some();
    for (kind, page) in [
        ("task", "tasks.md"),
        ("tool", "tools.md"),
        ("world", "closed-loop.md"),
        ("recording", "recordings.md"),
    ] {
        let output = run(&["check", "--schema", kind]);
        let schema: Json = serde_json::from_slice(&output.stdout).expect("JSON");
        let mut table = "| key | meaning |\n| --- | --- |\n".to_owned();
        rows(&schema, "", &mut table);
        let text = read(page);
        let begin = format!("<!-- keys {kind} -->\n");
        let (before, rest) = text.split_once(&begin).expect("a place for the keys");
        let (shown, after) = rest.split_once("<!-- end -->").expect("its end");
        let wanted = format!("\n{table}\n");
        if write && shown != wanted {
            let text = format!("{before}{begin}{wanted}<!-- end -->{after}");
            fs::write(source().join(page), text).expect("a page");
        } else {
            assert!(shown == wanted, "the keys of {page} are others by now: {UPDATE}");
        }
    }
}

/// Adds the keys of a schema and of its nested schemas, one row each.
fn rows(schema: &Json, above: &str, table: &mut String) {
    for alternative in schema["anyOf"].as_array().into_iter().flatten() {
        rows(alternative, above, table);
    }
    let Some(keys) = schema["properties"].as_object() else { return };
    let required = |key: &str| {
        schema["required"].as_array().is_some_and(|list| list.iter().any(|name| name == key))
    };
    for (key, value) in keys {
        let star = if required(key) { "\\*" } else { "" };
        let meaning = value["description"].as_str().unwrap_or_default().replace('|', "\\|");
        let meaning = meaning.split_whitespace().collect::<Vec<_>>().join(" ");
        let path = format!("{above}{key}");
        // If several alternatives have the same key, the first describes it.
        if table.contains(&format!("\n| `{path}`")) {
            continue;
        }
        table.push_str(&format!("| `{path}`{star} | {meaning} |\n"));
        rows(value, &format!("{path}."), table);
        rows(&value["items"], &format!("{path}[]."), table);
    }
}

#[test]
fn headings_become_anchors_as_browsers_know_them() {
    let page = "# Which it `is`, and (not)\n\n```sh\n# no heading\n```\n## A-b: c\n## A-b: c\n";
    assert_eq!(headings(page), ["which-it-is-and-not", "a-b-c", "a-b-c-1"]);
    assert_eq!(links("[a](b.md#c) ![d](e.svg) [f](https://g) `[x](y)`").len(), 2);
}

/// Returns the book's own pages; pages of measured results have separate tests.
fn own_pages() -> Vec<Page> {
    let listed: Vec<String> = links(&read("SUMMARY.md")).into_iter().map(|(to, _)| to).collect();
    let own = listed.into_iter().filter(|path| !path.contains('/')).collect::<Vec<_>>();
    pages_of(&own)
}

fn pages_of(paths: &[String]) -> Vec<Page> {
    paths.iter().map(|path| (path.clone(), read(path))).collect()
}

fn source() -> PathBuf {
    Path::new(ROOT).join("book/src")
}

fn read(path: &str) -> String {
    fs::read_to_string(source().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Returns the links within the book, with their anchors, outside of code.
fn links(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut code = false;
    for line in text.lines() {
        if line.starts_with("```") {
            code = !code;
        }
        // Text between single backquotes is code.
        let words: String = line.split('`').step_by(2).collect::<Vec<_>>().join("code");
        let targets = words.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        for target in targets.filter(|target| !code && !target.contains("://")) {
            let (to, anchor) = target.split_once('#').unwrap_or((target, ""));
            found.push((to.to_owned(), anchor.to_owned()));
        }
    }
    found
}

/// Returns the anchors of a page's headings.
fn headings(text: &str) -> Vec<String> {
    let (mut found, mut code) = (Vec::<String>::new(), false);
    for line in text.lines() {
        code ^= line.starts_with("```");
        let Some(title) = line.strip_prefix('#').filter(|_| !code) else { continue };
        let title = title.trim_start_matches('#').trim().to_lowercase();
        let kept = title.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        let anchor: String = kept.map(|c| if c == ' ' { '-' } else { c }).collect();
        let again = found.iter().filter(|other| **other == anchor).count();
        found.push(if again == 0 { anchor } else { format!("{anchor}-{again}") });
    }
    found
}

/// Normalises a path: no `..`, and forward slashes.
fn plain(path: &Path) -> String {
    let mut parts: Vec<String> = Vec::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => {
                parts.pop();
            }
            part => parts.push(part.as_os_str().to_string_lossy().into_owned()),
        }
    }
    parts.join("/")
}
