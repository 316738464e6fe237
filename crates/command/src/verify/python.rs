//! Python with MuJoCo, and scripts that it runs in a temporary folder.

use std::env;
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{self, Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::Duration;

use pushplan::plain_file;
use tempfile::TempDir;

use super::super::error::CliError;

/// Environment variable that names the Python.
const VARIABLE: &str = "PUSHPLAN_PYTHON";

/// Python on the search path.
const DEFAULT: &str = "python3";

/// Period of the check whether a script has ended or must stop.
const POLL: Duration = Duration::from_millis(10);

/// Python that can import MuJoCo.
#[derive(Debug)]
pub struct Python {
    program: OsString,
}

/// Texts that a script has written.
#[derive(Debug)]
pub struct Written {
    /// Standard output.
    pub output: String,
    /// Last line of the standard error.
    pub complaint: String,
}

impl Python {
    /// Finds the Python that `PUSHPLAN_PYTHON` names, otherwise `python3`.
    ///
    /// # Errors
    /// Returns [`CliError::Usage`] if there is none, or if it cannot import MuJoCo.
    pub fn with_mujoco() -> Result<Self, CliError> {
        let named = env::var_os(VARIABLE).filter(|named| !named.is_empty());
        let shown = named.clone().unwrap_or_else(|| DEFAULT.into());
        let python = Self { program: absolute(shown.clone()) };
        let shown = shown.display();
        let elsewhere = format!("or name a Python that has it in {VARIABLE}");
        let probe = Scripts::with("probe.py", "import mujoco\n")?;
        match python.run(&probe, &[], &|| false) {
            Ok((status, _)) if status.success() => Ok(python),
            Ok((_, Written { complaint, .. })) => Err(CliError::usage(
                format!("`{shown}` cannot import mujoco: {complaint}"),
                format!("run `{shown} -m pip install mujoco`, {elsewhere}"),
            )),
            Err(error) => Err(CliError::usage(
                format!("cannot start `{shown}`: {error}"),
                format!("install Python 3.11 and run `pip install mujoco`, {elsewhere}"),
            )),
        }
    }

    /// Runs a script with these arguments in its folder. `stops` is polled, and ends the script.
    ///
    /// # Errors
    /// Returns an error if Python cannot be started or its output cannot be read.
    pub fn run(
        &self,
        scripts: &Scripts,
        arguments: &[&str],
        stops: &dyn Fn() -> bool,
    ) -> io::Result<(ExitStatus, Written)> {
        let at = |name: &str| scripts.folder.path().join(name);
        let [output, errors] = ["stdout.txt", "stderr.txt"].map(at);
        let child = Command::new(&self.program)
            .arg(&scripts.script)
            .args(arguments)
            // MuJoCo writes its log into the current folder.
            .current_dir(scripts.folder.path())
            .stdin(Stdio::null())
            .stdout(created(&output)?)
            .stderr(created(&errors)?)
            .spawn()?;
        let status = wait(child, stops)?;
        let text =
            |path: &Path| plain_file::read(path).map(|b| String::from_utf8_lossy(&b).into_owned());
        let complaint = text(&errors)?.trim_end().lines().last().unwrap_or_default().to_owned();
        Ok((status, Written { output: text(&output)?, complaint }))
    }
}

/// Creates an empty file of the temporary folder.
fn created(path: &Path) -> io::Result<File> {
    plain_file::open_to_write(path, OpenOptions::new().write(true).create(true).truncate(true))
}

/// Temporary folder with a script, removed when dropped.
#[derive(Debug)]
pub struct Scripts {
    folder: TempDir,
    script: PathBuf,
}

impl Scripts {
    /// Creates a folder with a script of this name.
    ///
    /// # Errors
    /// Returns [`CliError::Unexpected`] if it cannot be written.
    pub fn with(name: &str, text: &str) -> Result<Self, CliError> {
        let folder = TempDir::new().map_err(|error| unwritable(&error))?;
        let scripts = Self { script: folder.path().join(name), folder };
        scripts.add(name, text)?;
        Ok(scripts)
    }

    /// Adds a file to the folder.
    ///
    /// # Errors
    /// Returns [`CliError::Unexpected`] if it cannot be written.
    pub fn add(&self, name: &str, text: &str) -> Result<(), CliError> {
        fs::write(self.folder.path().join(name), text).map_err(|error| unwritable(&error))
    }
}

fn unwritable(error: &io::Error) -> CliError {
    CliError::unexpected("cannot write a temporary folder", error)
}

/// Waits for the end of a process, and kills it if it must stop.
fn wait(mut child: Child, stops: &dyn Fn() -> bool) -> io::Result<ExitStatus> {
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(status);
        }
        if stops() {
            // The process may have ended meanwhile.
            let _ = child.kill();
            return child.wait();
        }
        thread::sleep(POLL);
    }
}

/// Returns a program path that is valid in every folder. Links stay, because a virtual environment
/// is found by them; a bare name is searched on the path.
fn absolute(program: OsString) -> OsString {
    let path = Path::new(&program);
    match path.components().count() {
        0 | 1 => program,
        _ => path::absolute(path).map_or(program.clone(), PathBuf::into_os_string),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_become_absolute_and_names_stay() {
        assert_eq!(absolute("python3".into()), "python3");
        let path = absolute("venv/bin/python".into());
        assert!(Path::new(&path).is_absolute() && Path::new(&path).ends_with("venv/bin/python"));
    }
}
