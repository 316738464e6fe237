//! Commands that are interrupted and resumed.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::program::succeed;

/// Runs a resumable command once without and once with an interruption, and compares the files.
pub fn goes_on_after_an_interruption(command: &str, options: &str) {
    let folder = TempDir::new().expect("a folder");
    let [whole, broken] = ["whole", "broken"].map(|name| folder.path().join(name));
    let line = |dir: &Path| format!("{command} {} {options}", dir.display());
    succeed(&line(&whole));
    // After the first files, so that the resumed run has something to reuse.
    interrupted(&line(&broken), || fs::read_dir(&broken).map_or(0, Iterator::count) > 1);
    succeed(&line(&broken));
    let read = |dir: &Path| -> Vec<(String, Vec<u8>)> {
        let entries = fs::read_dir(dir).expect("a folder");
        let files = entries.map(|entry| entry.expect("an entry"));
        // Data that a run makes for itself are in separate folders.
        let files = files.filter(|entry| entry.path().is_file());
        let names = files.map(|entry| entry.file_name().into_string().expect("UTF-8"));
        // Metrics hold wall-clock times, which differ between runs.
        let names = names.filter(|name| name != "metrics.jsonl");
        let file = |name: String| (name.clone(), fs::read(dir.join(name)).expect("a file"));
        let mut read: Vec<_> = names.map(file).collect();
        read.sort();
        read
    };
    assert!(read(&broken) == read(&whole), "the resumed files differ");
}

/// Runs a command under `nohup`, as long jobs are run, until `until` holds, and interrupts it.
/// Ignoring the hangup signal must not disable the other signals.
pub fn interrupted(line: &str, until: impl Fn() -> bool) -> Output {
    let mut child = Command::new("nohup")
        .arg(crate::PROGRAM)
        .args(line.split_whitespace())
        .current_dir(crate::ROOT)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let begun = Instant::now();
    while !until() && child.try_wait().expect("a child").is_none() {
        assert!(begun.elapsed().as_secs() < 60, "nothing after a minute");
        std::thread::sleep(Duration::from_millis(1));
    }
    let id = child.id().to_string();
    interrupt(&id);
    let output = child.wait_with_output().expect("the command ends");
    // On a fast machine the command may finish before the signal arrives.
    assert!(matches!(output.status.code(), Some(130 | 0)), "{output:?}");
    output
}

/// Sends Ctrl-C to a process. The shell does it, because a bare Debian has no program `kill`.
pub fn interrupt(id: &str) {
    let sent = Command::new("sh").args(["-c", &format!("kill -INT {id}")]).status();
    assert!(sent.is_ok_and(|status| status.success()), "no signal to {id}");
}
