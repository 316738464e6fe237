//! Python with MuJoCo: the one named by `PUSHPLAN_PYTHON`, otherwise `python3`. Without the package
//! `mujoco`, tests that need it report this and check nothing; a named Python must have it.

use std::env;
use std::process::Command;

/// Returns a Python that has MuJoCo.
pub fn python() -> Option<String> {
    let named = env::var("PUSHPLAN_PYTHON").ok();
    let python = named.clone().unwrap_or_else(|| "python3".to_owned());
    let found = Command::new(&python).args(["-c", "import mujoco"]).output();
    if found.is_ok_and(|output| output.status.success()) {
        return Some(python);
    }
    assert!(named.is_none(), "{python} cannot import mujoco");
    eprintln!("skipped: python3 cannot import mujoco (pip install mujoco)");
    None
}
