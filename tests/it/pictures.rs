//! The shipped pictures equal the output of the command.

use std::path::Path;

use tempfile::TempDir;

use crate::program::succeed;

/// Task whose pictures the README shows.
const TASK: &str = "tasks/pull-back-behind-wall";

/// Maximum size of a picture, bytes, because larger ones make the README slow to load.
const LARGEST: usize = 100_000;

#[test]
fn the_shipped_pictures_are_what_solve_writes() {
    let root = Path::new(crate::ROOT);
    let out = TempDir::new().expect("a folder");
    let folder = out.path().display();
    succeed(&format!("solve {TASK}.yaml --animate --quiet --out {folder}"));
    for ending in ["svg", "animated.svg"] {
        let shipped = root.join(format!("{TASK}.{ending}"));
        let name = shipped.file_name().expect("a name");
        let read = |path: &Path| std::fs::read_to_string(path).expect("a picture");
        let written = read(&out.path().join(name));
        assert!(written.len() < LARGEST, "{ending}: {} bytes", written.len());
        assert!(
            read(&shipped) == written,
            "{TASK}.{ending} is old: run `pushplan solve {TASK}.yaml --animate --out tasks` and \
             remove the plan file that it leaves there"
        );
    }
}
