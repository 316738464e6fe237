//! `pushplan infer`: joints between objects, from recorded pushes.

use std::path::PathBuf;

use clap::Args;

use pushplan::progress::Count;
use pushplan::recording::Recording;
use pushplan::scene::{ModelSpec, Span};
use pushplan_act::belief::{Belief, BeliefSettings};
use pushplan_report::{PageView, Recipe, Setting, belief_document, recording_page};

use super::{
    error::CliError,
    exit_code,
    form::Form,
    interrupt, model,
    noise::NoiseArgs,
    output,
    progress::TerminalProgress,
    recordings::load_recordings,
    regulator::RegulatorArgs,
    session::Session,
    value_enums::{VIEWS, possible_values},
};

/// Default model for the rollouts of hypotheses.
const MODEL: &str = "prior";

/// Infer the joints between objects from a recording
#[derive(Args, Debug)]
#[command(
    after_help = "Considers every two objects within 3 cm of each other at the start. Infers \
whether they are free, fixed to each other, revolute (rotation about a point) or prismatic \
(sliding along a line). Reports the probability of each, and the point or line. Joints stated in \
the recording are ignored. Five recorded instants are evaluated together. Masses, frictions and \
other stated values of the scene are assumed to be true, but have little effect.

Missing headings are estimated. If objects are pushed one by one, nearly as many joints are found \
as with headings. In a dense crowd, about a fifth of the pairs are wrong.

Masses are inferred only for objects that another object touched. Unless forces are measured, \
motion shows only mass ratios, which limit the range of each mass (--mass-ranges).

Examples:
  pushplan infer pushes.recording.json
  pushplan infer pushes.recording.json --noise 0.003 --heading-noise 0.03 --out plans
  pushplan infer pushes.recording.json --mass-ranges 0.2-0.5 1-2 8-10"
)]
pub struct InferArgs {
    /// Recording or trajectory file
    #[arg(value_name = "FILE")]
    recording: PathBuf,
    /// Effect model for the rollouts of hypotheses
    #[arg(long, value_name = "MODEL", default_value = MODEL)]
    model: ModelSpec,
    #[command(flatten)]
    noise: NoiseArgs,
    /// Mass ranges in kg, lightest first: also infer the range of every mass. Masses stated in the
    /// recording are then ignored
    #[arg(long, value_name = "LOW-HIGH", num_args = 2.., value_parser = mass_range)]
    mass_ranges: Vec<Span>,
    /// Folder for belief.json, belief.svg and belief.html, a page that plays the observations
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// View on the page
    #[arg(long, value_parser = possible_values(&VIEWS), value_name = "VIEW", default_value = "2d")]
    page: PageView,
    #[command(flatten)]
    regulator: RegulatorArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &InferArgs, session: &Session) -> Result<u8, CliError> {
    let sets = load_recordings(std::slice::from_ref(&args.recording))?;
    let recordings: Vec<&Recording> = sets.iter().flat_map(|set| &set.recordings).collect();
    let [recording] = recordings[..] else {
        let advice = "name one of them, because a belief covers a single table";
        return Err(CliError::usage("this folder contains several recordings", advice));
    };
    let model = model::load(&args.model)?;
    if let Some(folder) = &args.out {
        output::prepare(folder)?;
    }
    let noise = args.noise.noise();
    let (tool, lift) = (recording.tool.clone(), recording.lift);
    let mut belief = Belief::new(&recording.scene, tool, lift, BeliefSettings::new(noise))
        .moving(&recording.velocities)
        .with_mass_ranges(&args.mass_ranges);
    if let Some((regulator, _)) = args.regulator.load()? {
        belief = belief.regulated(regulator);
    }
    let before = belief.probabilities();
    let following = TerminalProgress::bar(session, "inferring");
    let observations = recording.observations();
    let count = Count::new(&following, 0, observations.len());
    interrupt::watch();
    session.compute(|| {
        for observation in observations.into_iter().take_while(|_| !interrupt::requested()) {
            belief.update(&model, observation);
            count.one();
        }
        belief.finish(&model);
    });
    following.finish()?;
    let names: Vec<&str> =
        recording.scene.objects.iter().map(|object| object.name.as_str()).collect();
    let document = belief_document(&recording.name, &belief, &names, &args.mass_ranges);
    if let Some(folder) = &args.out {
        output::write(folder, "belief.json", document.to_json().as_bytes())?;
        output::write_figures(folder, document.figures())?;
        let page =
            recording_page(recording, (&before, &belief), &document, recipe(args), args.page);
        output::write(folder, "belief.html", page.as_bytes())?;
    }
    args.form.show(session, &document)?;
    Ok(interrupt::code(exit_code::DONE))
}

/// Returns the recipe that repeats the inference, with the non-default settings.
fn recipe(args: &InferArgs) -> Recipe {
    let mut settings = Vec::new();
    let value = args.model.to_string();
    if value != MODEL {
        settings.push(Setting { option: "--model", keyword: Some("model"), value });
    }
    settings.extend(args.noise.settings());
    settings.extend(args.regulator.setting());
    Recipe::of_recording(&args.recording.display().to_string(), &settings, &args.mass_ranges)
}

fn mass_range(text: &str) -> Result<Span, String> {
    let range = text.split_once('-').and_then(|(low, high)| {
        Some(Span::new(low.trim().parse().ok()?, high.trim().parse().ok()?))
    });
    let range = range.ok_or_else(|| "expected LOW-HIGH; 200 to 500 g is 0.2-0.5".to_owned())?;
    let sound = 1e-3 <= range.low && range.low < range.high && range.high <= 1e3;
    sound
        .then_some(range)
        .ok_or_else(|| "must be from low to high, within 0.001 kg to 1000 kg".to_owned())
}
