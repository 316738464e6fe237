//! `pushplan predict` for recordings: errors of each model.

use pushplan::effect::EffectModel;
use pushplan::geometry::Pose;
use pushplan::recording::Recording;
use pushplan::{outcome::Warning, scene::TableFit};
use pushplan_act::judge::{
    Comparison, RecordedErrors, Trial, TrialErrors, assumed, own_spread, recorded_baselines,
};
use pushplan_report::{PoseRow, RECORDED, recorded_document, recordings_document};

use super::{
    error::CliError,
    exit_code, model, output,
    predict::PredictArgs,
    progress::TerminalProgress,
    recordings::{RecordingSet, load_recordings},
    session::Session,
};

/// Evaluates the models on every set of recordings, and on all of them together if there are
/// several.
///
/// # Errors
/// Returns errors of reading recordings and models, and of writing results.
pub fn run(args: &PredictArgs, session: &Session) -> Result<u8, CliError> {
    let mut sets = load_recordings(&args.files)?;
    let fit = args.table.load()?;
    if let Some(fit) = &fit {
        apply(fit, &mut sets, session);
    }
    let all: Vec<&Recording> = sets.iter().flat_map(|set| &set.recordings).collect();
    let models = models(args, &all, fit.as_ref())?;
    warn(&*models[0], &all, session);
    let trials: Vec<Trial> = all.iter().map(|recording| Trial::of_recording(recording)).collect();
    let names: Vec<String> = all.iter().map(|recording| recording.name.clone()).collect();
    let mut groups = Vec::new();
    let mut first = 0;
    for RecordingSet { title, recordings } in &sets {
        groups.push((title.clone(), first..first + recordings.len()));
        first += recordings.len();
    }
    if groups.len() > 1 {
        groups.push((format!("{} recordings", trials.len()), 0..trials.len()));
    }
    let mut reports = Vec::new();
    for (title, range) in groups {
        let following = TerminalProgress::bar(session, &title);
        let (trials, names) = (&trials[range.clone()], names[range].to_vec());
        reports.push(session.compute(|| {
            let errors = TrialErrors::of(title, trials, &models, &following);
            let own_spread = if args.alone { None } else { own_spread(trials, &following) };
            RecordedErrors { names, own_spread, errors }
        }));
        following.finish()?;
        if !args.summary {
            args.form.show_part(session, &recorded_document(&reports))?;
        }
        if let Some(folder) = &args.out {
            let document = recordings_document(&reports);
            output::write(folder, "errors.json", document.to_json().as_bytes())?;
            output::write_figures(folder, document.figures())?;
        }
    }
    if args.poses.wanted() {
        let rows = session.compute(|| poses(&all, &trials, &models));
        args.poses.write(&rows)?;
    }
    let several = reports.len() > 1 || args.summary;
    args.form.show_rest(session, &recordings_document(&reports), several)?;
    Ok(exit_code::DONE)
}

/// Applies `fit` to all recordings; each kind of unfamiliar object is reported once.
fn apply(fit: &TableFit, sets: &mut [RecordingSet], session: &Session) {
    let mut reported: Vec<String> = Vec::new();
    for recording in sets.iter_mut().flat_map(|set| &mut set.recordings) {
        let strange: Vec<String> =
            fit.strange(&recording.scene).into_iter().map(str::to_owned).collect();
        match reported.contains(&strange.join(" ")) || strange.is_empty() {
            true => fit.state(&mut recording.scene),
            false => model::state(fit, &mut recording.scene, session),
        }
        reported.push(strange.join(" "));
    }
}

/// Returns the given model, its variants with other assumptions about joints if there are any, and
/// the models for comparison.
fn models(
    args: &PredictArgs,
    recordings: &[&Recording],
    fit: Option<&TableFit>,
) -> Result<Vec<Box<dyn EffectModel>>, CliError> {
    let asked = args.spec();
    let mut models: Vec<Box<dyn EffectModel>> =
        vec![Box::new(args.out_of_range.fitted(&asked, fit)?)];
    if args.alone {
        return Ok(models);
    }
    if recordings.iter().any(|recording| !recording.scene.joints.is_empty()) {
        for spec in assumed(&asked) {
            models.push(Box::new(args.out_of_range.fitted(&spec, fit)?));
        }
    }
    for spec in recorded_baselines(&asked) {
        models.push(Box::new(model::load(&spec)?));
    }
    Ok(models)
}

/// Warns of recordings outside the model's range, one line for each kind of warning.
fn warn(model: &dyn EffectModel, recordings: &[&Recording], session: &Session) {
    let mut kinds: Vec<(Warning, Vec<&str>)> = Vec::new();
    for recording in recordings {
        let job = Trial::of_recording(recording).job();
        for warning in model.trust(&recording.scene, &job).warnings() {
            match kinds.iter_mut().find(|(known, _)| known.is_like(&warning)) {
                Some((_, names)) if names.last() != Some(&&*recording.name) => {
                    names.push(&recording.name);
                }
                Some(_) => {}
                None => kinds.push((warning, vec![&recording.name])),
            }
        }
    }
    for (warning, names) in kinds {
        let more = match names.len() {
            1 => String::new(),
            count => {
                let all = recordings.len();
                format!(" (and the like in {} more of {all} recordings)", count - 1)
            }
        };
        session.warn(&format!("{}: {warning}{more}", names[0]));
    }
}

/// Returns the recorded and predicted poses of every object at every compared instant.
fn poses(
    recordings: &[&Recording],
    trials: &[Trial],
    models: &[Box<dyn EffectModel>],
) -> Vec<PoseRow> {
    let mut rows = Vec::new();
    for (recording, trial) in recordings.iter().zip(trials) {
        let replay = recording.replay();
        let times: Vec<f64> =
            replay.instants.iter().map(|instant| recording.frames[instant.frame].time).collect();
        let mut add = |by: &str, moments: &[&[Pose]]| {
            for (time, poses) in times.iter().zip(moments) {
                for (object, pose) in recording.scene.objects.iter().zip(*poses) {
                    rows.push(PoseRow {
                        name: recording.name.clone(),
                        by: by.into(),
                        object: object.name.clone(),
                        time: *time,
                        pose: *pose,
                    });
                }
            }
        };
        let truth: Vec<&[Pose]> = trial.truth.iter().map(|moment| &*moment.poses).collect();
        add(RECORDED, &truth);
        for model in models {
            let comparison = Comparison::of(&**model, trial);
            let states: Vec<&[Pose]> =
                comparison.states().into_iter().map(|state| &*state.poses).collect();
            add(&model.spec().to_string(), &states);
        }
    }
    rows
}
