//! `pushplan-lab rest-of-way`: remaining motion of recordings, predicted from first contact on
//! under different assumptions about their joints.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::effect::EffectModel;
use pushplan::internals::progress::Count;
use pushplan::internals::recording::Recording;
use pushplan::internals::scene::ModelSpec;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::model;
use pushplan_command::model::OutOfRangeArgs;
use pushplan_command::noise::NoiseArgs;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::recordings::load_recordings;
use pushplan_command::regulator::RegulatorArgs;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;

use crate::bench::{Asked, BeliefRecord, JointMethod, belief_steps, follow};
use crate::report::recorded_joints_document;

use super::value_enums::JOINT_METHODS;

/// Predict the rest of recordings under different beliefs about their joints
#[derive(Args, Debug)]
pub struct RestOfWayArgs {
    /// Recordings, trajectories and folders of them
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// What the model is told about the joints from first contact on
    #[arg(long, required = true, num_args = 1.., value_parser = possible_values(&JOINT_METHODS), value_name = "HOW")]
    joints: Vec<JointMethod>,
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT, help = model::HELP)]
    model: ModelSpec,
    #[command(flatten)]
    out_of_range: OutOfRangeArgs,
    #[command(flatten)]
    noise: NoiseArgs,
    #[command(flatten)]
    regulator: RegulatorArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &RestOfWayArgs, session: &Session) -> Result<(), CliError> {
    let sets = load_recordings(&args.files)?;
    let recordings: Vec<&Recording> = sets.iter().flat_map(|set| &set.recordings).collect();
    let asked = |method: &JointMethod| args.joints.contains(method);
    let methods: Vec<JointMethod> = JointMethod::ALL.into_iter().filter(asked).collect();
    let model = args.out_of_range.load(&args.model)?;
    let regulator = match methods.contains(&JointMethod::Regulator) {
        true => args.regulator.load()?.map(|(regulator, _)| regulator),
        false => None,
    };
    let following = TerminalProgress::bar(session, "inferring");
    let count = Count::new(&following, 0, recordings.len());
    let records: Vec<BeliefRecord> = session.compute(|| {
        let of = |recording: &&Recording| {
            let observations = recording.observations();
            let seen = (&recording.scene, &observations[..], args.noise.noise());
            let by = (&model as &dyn EffectModel, regulator.as_ref(), true);
            let (record, _) = follow(recording, seen, by, Asked::AfterContact, 0);
            count.one();
            record
        };
        recordings.iter().map(of).collect()
    });
    following.finish()?;
    let steps = belief_steps(&records.iter().collect::<Vec<_>>());
    let spec = model.spec().to_string();
    args.form.show(session, &recorded_joints_document(&spec, recordings.len(), &steps, &methods))
}
