//! Commands on the pages of the repository.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::program::name;
use crate::{PROGRAM, ROOT};

/// Returns every command on the pages that runs the program under test, with its page.
fn commands() -> Vec<(String, String)> {
    let (mut commands, program) = (Vec::new(), format!("{} ", name()));
    for folder in ["", ".github", "book/src", "crates/models", "crates/lab/results"] {
        for file in fs::read_dir(Path::new(ROOT).join(folder)).expect("a folder of pages") {
            let path = file.expect("a file").path();
            if path.extension().is_none_or(|end| end != "md") {
                continue;
            }
            let page = path.display().to_string();
            for block in blocks(&fs::read_to_string(path).expect("a page"), "sh") {
                let lines = block.replace("\\\n", " ");
                let lines = lines.lines().filter_map(|line| line.trim().strip_prefix(&program));
                for line in lines.filter_map(|line| line.split(" #").next()?.split(" && ").next()) {
                    commands.push((page.clone(), line.to_owned()));
                }
            }
        }
    }
    commands
}

/// Checks that command lines are parsed up to an added `--help`, and that the files they name
/// exist.
pub fn are_taken(least: usize) {
    let commands = commands();
    for (page, line) in &commands {
        let output = Command::new("sh")
            .args(["-c", &format!("\"$PROGRAM\" {line} --help")])
            .env("PROGRAM", PROGRAM)
            .current_dir(ROOT)
            .output()
            .expect("a shell");
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{page}: {line}: {error}");
        for file in line.split(' ').filter(|word| word.starts_with("tasks/")) {
            let there = file.contains('*') || Path::new(ROOT).join(file).exists();
            assert!(there, "{page}: {file}");
        }
    }
    assert!(commands.len() >= least, "{} commands", commands.len());
}

/// Returns the contents of a page's code blocks in `language`.
pub fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    let rest = page.split(&fence).skip(1);
    rest.filter_map(|rest| rest.split("```").next()).map(str::to_owned).collect()
}
