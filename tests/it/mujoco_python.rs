//! What runs MuJoCo: the Python that `PUSHPLAN_PYTHON` names, or else `python3`. Without the package
//! `mujoco` tests that need it say so and check nothing; one that is named must have it.

use std::env;
use std::process::Command;

/// A Python that has MuJoCo.
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
