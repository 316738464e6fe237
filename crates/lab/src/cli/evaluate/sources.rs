//! Selection of crowds by options.

use std::path::PathBuf;

use clap::Args;
use pushplan_command::error::CliError;
use pushplan_command::value_enums::possible_values;
use pushplan_learn::cli::value_enums::{JOINTS, SOLIDS};
use pushplan_learn::dataset::{JointRule, Solids};

use crate::bench::{CrowdFamily, CrowdSet};

/// Options of scenes of many objects.
#[derive(Args, Debug)]
pub struct CrowdArgs {
    /// Number of trajectories of each set of sparse or dense scenes
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub count: u32,
    /// Restrict to sets with this many objects
    #[arg(long, value_name = "N")]
    objects: Vec<usize>,
    /// Restrict to sets with these joints
    #[arg(long, num_args = 1.., value_parser = possible_values(&JOINTS[1..]),
          value_name = "JOINTS")]
    joints: Vec<JointRule>,
    /// Restrict to sets of these solids
    #[arg(long, value_parser = possible_values(&SOLIDS), value_name = "SOLIDS")]
    solids: Option<Solids>,
    /// Measure only the model on sparse and dense scenes, without baselines
    #[arg(long)]
    pub no_baselines: bool,
    /// Print only one table for sparse and dense scenes, with a row for each set
    #[arg(long)]
    pub summary: bool,
    /// Folder for finished parts, evaluation.json (updated after each part) and curves of the
    /// errors by horizon (SVG)
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl CrowdArgs {
    /// Returns the selected sets.
    ///
    /// # Errors
    /// Returns an error if the options leave none of them.
    pub fn sets(&self, families: &[CrowdFamily]) -> Result<Vec<CrowdSet>, CliError> {
        let all = families.iter().flat_map(|family| CrowdSet::all(*family));
        let sets: Vec<CrowdSet> = all.filter(|set| self.picks(set)).collect();
        match sets.is_empty() && !families.is_empty() {
            true => Err(CliError::usage(
                "no set has this number of objects",
                "sparse sets have 6, 9 or 12 objects, dense sets 6, 8 or 9",
            )),
            false => Ok(sets),
        }
    }

    fn picks(&self, set: &CrowdSet) -> bool {
        let joints = self.joints.is_empty() || self.joints.contains(&set.joints);
        let solids = self.solids.is_none_or(|solids| set.solids == solids);
        let objects = self.objects.is_empty() || self.objects.contains(&set.objects);
        joints && solids && objects
    }
}
