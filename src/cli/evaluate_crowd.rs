//! The part of `pushplan evaluate` that measures on crowds and recordings.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::json;

use crate::asset::{self, Kind, SCHEMA_VERSION, TrajectoryFile};
use crate::bench::{CrowdFamily, CrowdReport, CrowdSet};
use crate::dataset::{JointRule, Solids};
use crate::effect::EffectModel;
use crate::judge::Trial;
use crate::recording::Recording;
use crate::report::{CROWD_LEGEND, crowd_chart, crowd_line, crowd_summary, crowd_table};
use crate::scene::{Assumptions, Job, JointBelief, ModelKind, ModelSpec};

use super::{
    error::CliError,
    evaluate::Shown,
    model::{self, OutsideArgs},
    output,
    session::Session,
};

/// Percentages of the true friction that the simulator is told, beside the truth.
const FRICTION: [u16; 2] = [70, 130];

/// Micrometres by which the start that the simulator is told is off: the truth's own spread.
const START: u16 = 100;

/// What stands beside the model.
const BASELINES: [ModelKind; 4] =
    [ModelKind::PRIOR, ModelKind::Projection, ModelKind::Follow, ModelKind::Still];

/// Options of scenes of many objects.
#[derive(Args, Debug)]
pub struct CrowdArgs {
    /// Trajectories of each set of sparse or dense scenes
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    count: u32,
    /// Only sets with this many objects
    #[arg(long, value_name = "N")]
    objects: Vec<usize>,
    /// Only sets with these joints
    #[arg(long, value_enum, value_name = "JOINTS")]
    joints: Option<Joints>,
    /// Only sets of these solids
    #[arg(long, value_enum, value_name = "SOLIDS")]
    solids: Option<SolidsName>,
    /// Measure the model alone on sparse and dense scenes and recordings, without baselines
    #[arg(long)]
    no_baselines: bool,
    /// Folder for evaluation.json, written anew after every set, and the curves of error by
    /// horizon as SVG
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Joints {
    /// Some neighbours joined rigidly
    Fixed,
    /// Some neighbours joined by joints of all kinds
    Mixed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SolidsName {
    /// Cylinders alone
    Cylinders,
    /// Cylinders and cuboids
    Any,
}

/// What to measure on, read or ready to be drawn.
pub struct Sources {
    sets: Vec<CrowdSet>,
    recordings: Vec<Recording>,
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
        if faults.is_empty() {
            Ok(Self { sets, recordings })
        } else {
            Err(asset::Faults(faults).into())
        }
    }
}

impl CrowdArgs {
    fn picks(&self, set: &CrowdSet) -> bool {
        let joints = self.joints.is_none_or(|joints| match joints {
            Joints::Fixed => set.joints == JointRule::Fixed,
            Joints::Mixed => set.joints == JointRule::Mixed,
        });
        let solids = self.solids.is_none_or(|solids| match solids {
            SolidsName::Cylinders => set.solids == Solids::Cylinders,
            SolidsName::Any => set.solids == Solids::Any,
        });
        let objects = self.objects.is_empty() || self.objects.contains(&set.objects);
        joints && solids && objects
    }
}

/// A recording, or a trajectory file taken for one.
fn recording(file: &Path) -> Result<Recording, asset::Faults> {
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

/// Measures set by set; tables are printed and the folder's files written as each is done.
///
/// # Errors
/// A model that cannot be read; results that cannot be written.
pub fn run(
    sources: &Sources,
    asked: (&ModelSpec, OutsideArgs),
    seed: u64,
    args: &CrowdArgs,
    shown: Shown,
    session: &Session,
) -> Result<Vec<CrowdReport>, CliError> {
    let mut reports = Vec::new();
    if sources.sets.is_empty() && sources.recordings.is_empty() {
        return Ok(reports);
    }
    if let Some(folder) = &args.out {
        output::prepare(folder)?;
    }
    let drawn = models(asked, false, args.no_baselines)?;
    if !shown.json {
        session.print(&format!("{CROWD_LEGEND}\n\n"))?;
    }
    for set in &sources.sets {
        let count = args.count as usize;
        let bar = session.bar(&set.title());
        bar.set_length((count * (1 + drawn.len())) as u64);
        let tick = || bar.inc(1);
        let report = session.compute(|| {
            let trials = set.draw(seed, count, &tick);
            CrowdReport::of_set(set, seed, &trials, &drawn, &tick)
        });
        bar.finish_and_clear();
        reports.push(report);
        show_last(&reports, args, shown, session)?;
    }
    if !sources.recordings.is_empty() {
        recordings(sources, asked, args, shown, session, &mut reports)?;
    }
    if reports.len() > 1 && !shown.json {
        let head = format!("{}, share of the mean true motion\n\n", reports[0].models[0].model);
        session.print(&format!("{head}{}", shown.table(&crowd_summary(&reports))))?;
    }
    Ok(reports)
}

/// Every recording by itself, and all together where there are several.
fn recordings(
    sources: &Sources,
    asked: (&ModelSpec, OutsideArgs),
    args: &CrowdArgs,
    shown: Shown,
    session: &Session,
    reports: &mut Vec<CrowdReport>,
) -> Result<(), CliError> {
    let models = models(asked, true, args.no_baselines)?;
    warn(sources, &*models[0], session);
    let names = sources.recordings.iter().map(|recording| recording.name.clone());
    let trials: Vec<Trial> = sources.recordings.iter().map(Trial::of_recording).collect();
    let mut groups: Vec<(String, &[Trial])> = names.zip(trials.chunks(1)).collect();
    if trials.len() > 1 {
        groups.push((format!("{} recordings", trials.len()), &trials));
    }
    for (title, trials) in groups {
        let bar = session.bar(&title);
        bar.set_length((trials.len() * models.len()) as u64);
        let report =
            session.compute(|| CrowdReport::of_recordings(title, trials, &models, &|| bar.inc(1)));
        bar.finish_and_clear();
        reports.push(report);
        show_last(reports, args, shown, session)?;
    }
    Ok(())
}

/// Says which recordings the model was not made for.
fn warn(sources: &Sources, model: &dyn EffectModel, session: &Session) {
    for recording in &sources.recordings {
        let job = Job::stated(&recording.scene, recording.replay().motion);
        for warning in model.trust(&recording.scene, &job).warnings() {
            session.warn(&format!("{}: {warning}", recording.name));
        }
    }
}

/// Prints the newest report and writes the folder's files.
fn show_last(
    reports: &[CrowdReport],
    args: &CrowdArgs,
    shown: Shown,
    session: &Session,
) -> Result<(), CliError> {
    let Some(last) = reports.last() else { return Ok(()) };
    if !shown.json {
        let table = shown.table(&crowd_table(last));
        session.print(&format!("{}\n\n{table}\n", crowd_line(last)))?;
    }
    if let Some(folder) = &args.out {
        let json = json!({"schema_version": SCHEMA_VERSION, "crowds": reports});
        output::write(folder, "evaluation.json", format!("{json:#}\n").as_bytes())?;
        if let Some(chart) = crowd_chart(last.family, reports) {
            let name = format!("error-by-horizon-{}.svg", last.family.title());
            output::write(folder, &name, chart.to_svg().as_bytes())?;
        }
    }
    Ok(())
}

/// The model that is asked for, the same under other assumptions about joints, and what stands
/// beside it. Of recordings the planar engine is no truth, so it is there as itself too.
fn models(
    (spec, outside): (&ModelSpec, OutsideArgs),
    recorded: bool,
    alone: bool,
) -> Result<Vec<Box<dyn EffectModel>>, CliError> {
    let mut models: Vec<Box<dyn EffectModel>> = vec![Box::new(outside.load(spec)?)];
    if alone {
        return Ok(models);
    }
    let told = Assumptions::default();
    for joints in [JointBelief::Guessed, JointBelief::None, JointBelief::Fixed] {
        let assumed = spec.clone().assuming(Assumptions { joints: Some(joints), ..told });
        models.push(Box::new(outside.load(&assumed)?));
    }
    let mut others: Vec<ModelSpec> = BASELINES.into_iter().map(ModelSpec::of).collect();
    let planar = ModelSpec::of(ModelKind::PLANAR);
    if recorded {
        others.push(planar.clone());
    }
    others.retain(|other| other != spec);
    let friction = FRICTION.map(|percent| Assumptions { friction: Some(percent), ..told });
    let start = Assumptions { start: Some(START), ..told };
    others.extend(friction.into_iter().chain([start]).map(|told| planar.clone().assuming(told)));
    for other in &others {
        models.push(Box::new(model::load(other)?));
    }
    Ok(models)
}
