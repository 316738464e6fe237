//! `pushplan export`: plans for other programs.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::json;

use crate::asset::{Faults, PlanFile, SCHEMA_VERSION};
use crate::export::{REPLAY_SCRIPT, mjcf};

use super::{error::CliError, exit_code, output, session::Session};

/// Write plans for other programs: a second opinion from an engine that is not ours
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan export plans/pull-back.plan.json --out mjcf
  pip install mujoco && python3 mjcf/replay.py mjcf/pull-back.xml

Writes <out>/<plan>.xml, a scene of MuJoCo with the plan's pushes and goal in it, and
<out>/replay.py, which plays such scenes and says for each whether the plan works there.")]
pub struct ExportArgs {
    /// Plan files; each holds the task and the tool as well
    #[arg(required = true, value_name = "PLAN")]
    plans: Vec<PathBuf>,
    /// For which program
    #[arg(long, value_enum, default_value_t = Format::Mjcf)]
    format: Format,
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = output::FOLDER)]
    out: PathBuf,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// MuJoCo
    Mjcf,
}

pub fn run(args: &ExportArgs, session: &Session) -> Result<u8, CliError> {
    let Format::Mjcf = args.format;
    let (mut scenes, mut faults) = (Vec::new(), Vec::new());
    for path in &args.plans {
        match PlanFile::load(path) {
            Ok(file) => scenes.push((scene_name(path), scene(path, &file)?)),
            Err(found) => faults.extend(found.0),
        }
    }
    if !faults.is_empty() {
        return Err(Faults(faults).into());
    }
    for (index, (name, _)) in scenes.iter().enumerate() {
        if scenes[..index].iter().any(|(other, _)| other == name) {
            return Err(CliError::usage(
                format!("two plans would be written to {name}"),
                "export them to different folders",
            ));
        }
    }
    output::prepare(&args.out)?;
    let mut written = Vec::new();
    for (name, text) in &scenes {
        written.push(output::write(&args.out, name, text.as_bytes())?);
    }
    written.push(output::write(&args.out, "replay.py", REPLAY_SCRIPT.as_bytes())?);
    if args.json {
        let report = json!({"schema_version": SCHEMA_VERSION, "files": written});
        session.print(&format!("{report:#}\n"))?;
    } else {
        let lines: Vec<String> =
            written.iter().map(|path| format!("wrote {}\n", path.display())).collect();
        session.print(&lines.concat())?;
    }
    Ok(exit_code::DONE)
}

fn scene(path: &Path, file: &PlanFile) -> Result<String, CliError> {
    mjcf(file).map_err(|error| CliError::File(format!("{}: {error}", path.display())))
}

/// `a/b.plan.json` becomes `b.xml`.
fn scene_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.strip_suffix(".json").unwrap_or(&name);
    format!("{}.xml", stem.strip_suffix(".plan").unwrap_or(stem))
}
