//! Crowds and recordings to measure on, picked by options or read from files.

use std::path::PathBuf;

use clap::Args;

use crate::bench::{CrowdFamily, CrowdSet, JointMethod};
use crate::cli::words::{ASKED_JOINTS, AskedJoints};
use pushplan::cli::error::CliError;
use pushplan::cli::noise::NoiseArgs;
use pushplan::cli::recordings::{RecordingSet, load_recordings};
use pushplan::cli::regulator::RegulatorArgs;
use pushplan::cli::words::words;
use pushplan::internals::scene::Noise;
use pushplan_learn::cli::words::SOLIDS;
use pushplan_learn::dataset::{JointRule, Solids};

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
    /// Only sets with these joints; of recordings, what is told of the joints while the rest of the way
    /// is predicted from first contact on
    #[arg(long, num_args = 1.., value_parser = words(&ASKED_JOINTS), value_name = "JOINTS")]
    joints: Vec<AskedJoints>,
    #[command(flatten)]
    noise: NoiseArgs,
    #[command(flatten)]
    pub regulator: RegulatorArgs,
    /// Only sets of these solids
    #[arg(long, value_parser = words(&SOLIDS), value_name = "SOLIDS")]
    solids: Option<Solids>,
    /// Measure the model alone on sparse and dense scenes and recordings, without baselines
    #[arg(long)]
    pub no_baselines: bool,
    /// Of sparse and dense scenes and recordings print only one table, a row for each set
    #[arg(long)]
    pub summary: bool,
    /// Folder that keeps every finished part, evaluation.json, written again after each, and the
    /// curves of error by horizon as SVG
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// What to measure on, read or ready to be drawn.
pub struct Sources {
    pub sets: Vec<CrowdSet>,
    pub recordings: Vec<RecordingSet>,
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
        Ok(Self { sets, recordings: load_recordings(files)? })
    }
}

impl CrowdArgs {
    /// Errors of recorded poses, for beliefs.
    pub fn noise(&self) -> Noise {
        self.noise.noise()
    }

    /// What is told of the joints of recordings.
    pub fn told(&self) -> Vec<JointMethod> {
        let asked: Vec<JointMethod> = self.joints.iter().filter_map(|asked| asked.told()).collect();
        JointMethod::ALL.into_iter().filter(|method| asked.contains(method)).collect()
    }

    fn picks(&self, set: &CrowdSet) -> bool {
        let rules: Vec<JointRule> = self.joints.iter().filter_map(|asked| asked.rule()).collect();
        let joints = rules.is_empty() || rules.contains(&set.joints);
        let solids = self.solids.is_none_or(|solids| set.solids == solids);
        let objects = self.objects.is_empty() || self.objects.contains(&set.objects);
        joints && solids && objects
    }
}
