//! Crowds and recordings to measure on, picked by options or read from files.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::asset::{self, Faults, Kind, TrajectoryFile};
use crate::bench::{CrowdFamily, CrowdSet};
use crate::cli::error::CliError;
use crate::cli::words::{JOINTS, SOLIDS, words};
use crate::dataset::{JointRule, Solids};
use crate::recording::Recording;

/// Options of scenes of many objects.
#[derive(Args, Debug)]
pub struct CrowdArgs {
    /// Trajectories of each set of sparse or dense scenes
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub count: u32,
    /// Only sets with this many objects
    #[arg(long, value_name = "N")]
    objects: Vec<usize>,
    /// Only sets with these joints
    #[arg(long, value_parser = words(&JOINTS[1..]), value_name = "JOINTS")]
    joints: Option<JointRule>,
    /// Only sets of these solids
    #[arg(long, value_parser = words(&SOLIDS), value_name = "SOLIDS")]
    solids: Option<Solids>,
    /// Measure the model alone on sparse and dense scenes and recordings, without baselines
    #[arg(long)]
    pub no_baselines: bool,
    /// Folder for evaluation.json, written again after every set, and the curves of error by
    /// horizon as SVG
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// What to measure on, read or ready to be drawn.
pub struct Sources {
    pub sets: Vec<CrowdSet>,
    pub recordings: Vec<Recording>,
}

impl Sources {
    /// Reads the files and picks the sets.
    ///
    /// # Errors
    /// All faults of all files; sets of which the options leave none.
    pub fn load(
        families: &[CrowdFamily],
        files: &[PathBuf],
        args: &CrowdArgs,
    ) -> Result<Self, CliError> {
        let sets: Vec<CrowdSet> = families
            .iter()
            .flat_map(|family| CrowdSet::all(*family))
            .filter(|set| args.picks(set))
            .collect();
        if sets.is_empty() && !families.is_empty() {
            return Err(CliError::usage(
                "no set has that many objects",
                "sparse sets have 6, 9 or 12 objects, dense ones 6, 8 or 9",
            ));
        }
        let mut recordings = Vec::new();
        let mut faults = Vec::new();
        for file in files {
            match recording(file) {
                Ok(recording) => recordings.push(recording),
                Err(found) => faults.extend(found.0),
            }
        }
        if faults.is_empty() { Ok(Self { sets, recordings }) } else { Err(Faults(faults).into()) }
    }
}

impl CrowdArgs {
    fn picks(&self, set: &CrowdSet) -> bool {
        let joints = self.joints.is_none_or(|joints| set.joints == joints);
        let solids = self.solids.is_none_or(|solids| set.solids == solids);
        let objects = self.objects.is_empty() || self.objects.contains(&set.objects);
        joints && solids && objects
    }
}

/// A recording, or a trajectory file taken for one.
fn recording(file: &Path) -> Result<Recording, Faults> {
    match asset::check(file, None)? {
        Kind::Trajectory => {
            let file = TrajectoryFile::load(file)?;
            let motion = file.plan.motion(&file.tool);
            let frames = &file.trajectory.frames;
            Ok(Recording::of_frames(&file.task.name, &file.task.scene, &motion, frames))
        }
        _ => Recording::load(file),
    }
}
