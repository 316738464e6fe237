//! `pushplan fit`: support and friction of objects, from recorded pushes.

use std::path::PathBuf;

use clap::Args;

use pushplan::effect::{EffectModels, Network};
use pushplan::recording::Recording;
use pushplan::scene::ModelSpec;
use pushplan_act::fit::{Basis, FitSettings, HeadSettings, NoiseLaw, fit, learn};
use pushplan_act::judge::Trial;
use pushplan_report::{fit_document, table_fit_section};

use super::{
    error::CliError, exit_code, form::Form, model, output, progress::TerminalProgress,
    recordings::load_recordings, session::Session,
};

/// Fit the support of objects and their friction with the pusher to recorded pushes
#[derive(Args, Debug)]
#[command(
    after_help = "Fits two parameters to all recordings together: the spread of the support and \
the friction coefficient between pusher and objects. The spread is the distance of the support \
points from the centre, relative to the corners' distance or the radius. Give recordings of \
one object or of similar objects, one push each; fifty pushes of 1 cm are enough. The fit compares \
final poses and assumes errors with Student's t distribution. The analytic model `prior` is for \
slow pushes, up to 0.02 m/s; for faster pushes use --model planar.

With --save-fit, the network also learns the remaining error from the same recordings, which needs \
about twenty pushes. The option `--fit FILE` of solve and predict reads the file.

Examples:
  pushplan fit pushes/ --out plans
  pushplan fit pushes/ --save-fit table.fit.json
  pushplan fit --model planar push-1.recording.json push-2.recording.json"
)]
pub struct FitArgs {
    /// Recordings, or folders of recordings
    #[arg(required = true, value_name = "RECORDINGS")]
    recordings: Vec<PathBuf>,
    #[arg(long, value_name = "MODEL", default_value = "prior", help = model::HELP)]
    model: ModelSpec,
    /// Scale of the error that no model can avoid, metres; for rotations, at the radius of gyration
    /// [default: fitted]
    #[arg(long, value_name = "METRES", value_parser = noise)]
    noise: Option<f64>,
    /// Assume normally distributed errors, without outliers
    #[arg(long)]
    gaussian: bool,
    /// Also train the network on the recordings, and write the whole fit to this file
    #[arg(long, value_name = "FILE")]
    save_fit: Option<PathBuf>,
    /// Folder for fit.json and posterior.svg
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    form: Form,
}

fn noise(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected metres; 1 mm is 0.001".to_owned())?;
    let sound = (1e-6..=1.0).contains(&value);
    sound.then_some(value).ok_or_else(|| "must be from 0.000001 to 1; 1 mm is 0.001".to_owned())
}

pub fn run(args: &FitArgs, session: &Session) -> Result<u8, CliError> {
    let sets = load_recordings(&args.recordings)?;
    let recordings: Vec<&Recording> = sets.iter().flat_map(|set| &set.recordings).collect();
    let model = model::load(&args.model)?;
    if let Some(folder) = &args.out {
        output::prepare(folder)?;
    }
    let trials: Vec<Trial> =
        recordings.iter().map(|recording| Trial::of_recording(recording)).collect();
    let law = if args.gaussian { NoiseLaw::Gaussian } else { NoiseLaw::Student };
    let settings = FitSettings { law, noise: args.noise, ..FitSettings::default() };
    let following = TerminalProgress::bar(session, "fitting");
    let found = session.compute(|| fit(&model, &trials, &settings, &following));
    following.finish()?;
    let Some(found) = found else {
        let advice =
            "record pushes in which the pusher moves an object by at least a few millimetres";
        return Err(CliError::usage("no object moves in these recordings", advice));
    };
    let mut objects: Vec<&str> = recordings
        .iter()
        .flat_map(|recording| recording.scene.objects.iter().map(|object| object.name.as_str()))
        .collect();
    objects.sort_unstable();
    objects.dedup();
    let mut document = fit_document(&found, &objects);
    if let Some(folder) = &args.out {
        output::write(folder, "fit.json", document.to_json().as_bytes())?;
        output::write_figures(folder, document.figures())?;
    }
    if let Some(file) = &args.save_fit {
        let weights = EffectModels::weights().map_err(CliError::from)?;
        let network = Network::new(weights);
        let settings = HeadSettings { law, ..HeadSettings::default() };
        let learnt = session.compute(|| learn(&network, &trials, &Basis::from(&found), &settings));
        let learnt =
            learnt.map_err(|error| CliError::unexpected("cannot identify the weights", &error))?;
        document.sections.push(table_fit_section(&learnt));
        learnt.write(file).map_err(CliError::Output)?;
        document.wrote(std::slice::from_ref(file));
    }
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}
