//! A command that is interrupted and goes on.

use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

/// Runs a resumable command once whole and once with an interruption, and compares the files.
pub fn goes_on_after_an_interruption(command: &str, options: &str) {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (whole, broken) = (path("whole"), path("broken"));
    let arguments = |dir: &str| -> Vec<String> {
        [command, dir].into_iter().chain(options.split(' ')).map(str::to_owned).collect()
    };
    let run = |dir: &str| {
        let arguments = arguments(dir);
        let output = Command::new(crate::PROGRAM).args(arguments).output();
        let output = output.expect("the command runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    run(&whole);

    // As long jobs are run; a hangup that is ignored must not cost the other signals.
    let mut child = Command::new("nohup")
        .arg(crate::PROGRAM)
        .args(arguments(&broken))
        .stdin(std::process::Stdio::null())
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("the command starts");
    // After the first files, so that there is something to keep.
    let begun = std::time::Instant::now();
    while std::fs::read_dir(&broken).map_or(0, Iterator::count) < 2
        && child.try_wait().expect("a child").is_none()
    {
        assert!(begun.elapsed().as_secs() < 60, "no file after a minute");
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("a signal is sent");
    let code = child.wait().expect("the command ends").code();
    // On a fast machine it may be done before the signal comes.
    assert!(code == Some(130) || code == Some(0), "exit code {code:?}");

    run(&broken);
    let read = |dir: &str| -> Vec<(String, Vec<u8>)> {
        let entries = std::fs::read_dir(dir).expect("a folder");
        let names = entries.map(|entry| entry.expect("an entry").file_name());
        let names = names.map(|name| name.into_string().expect("UTF-8"));
        // Metrics hold wall times, which no two runs share.
        let names = names.filter(|name| name != "metrics.jsonl");
        let mut read: Vec<_> = names
            .map(|name| (name.clone(), std::fs::read(Path::new(dir).join(name)).expect("a file")))
            .collect();
        read.sort();
        read
    };
    assert!(read(&broken) == read(&whole), "the resumed files differ");
}
