//! Uses that an accepted file must survive.
//!
//! They are a rollout of the analytic model, a small search, a picture, and a round trip through a
//! file. Scenes and motions that are long or large but sound are left out, because they cost time
//! without showing anything new.

use std::path::Path;
use std::sync::Arc;

use pushplan::asset::{Faults, PlanFile, ToolLibrary, TrajectoryFile};
use pushplan::effect::{EffectModel, Network, Prior};
use pushplan::geometry::Vector;
use pushplan::network::PredictorWeights;
use pushplan::recording::Recording;
use pushplan::solve::{Planner, Settings};
use pushplan::{
    outcome::{Record, Trajectory, Warning},
    scene::{ModelKind, Object, Scene, Tool},
    task::{Job, Plan, Push, Task, ToolMotion},
};
use pushplan_report::{ScenePicture, Source, Track};

/// Number of frames above which a motion is not rolled out.
const LONGEST: usize = 400;

/// Number of objects above which a scene is not searched.
const CROWD: usize = 6;

pub fn tool(tool: Tool) {
    if !tool.pushes() {
        return;
    }
    let can = Object::cylinder("can", 0.04, 0.1).at(0.5, 0.05, 0.0);
    let scene = Scene::new([can]);
    let push = Push { start: Vector::zeros(), direction: 0.1, length: 0.1, speed: 0.1 };
    let motion = ToolMotion::pushes(Arc::new(tool), 0.002, 0.3, &[push], true);
    let rolled = rollout(&Prior::default(), &scene, &motion);
    picture(&scene, Some(&motion), rolled.as_ref());
}

pub fn task(task: Task) {
    if task.levers.is_some() {
        return;
    }
    let library = ToolLibrary::embedded().expect("the shipped tools are sound");
    let Ok(tools) = task.tools(&library) else { return };
    let at = task.scene.objects[task.goals[0].object].pose.position;
    let start = at - Vector::new(0.4, 0.0);
    let rules = &task.pushes;
    let push = Push { start, direction: 0.0, length: rules.length, speed: rules.speed };
    let motion = ToolMotion::pushes(Arc::clone(&tools[0]), rules.lift, 0.0, &[push], true);
    let rolled = rollout(&Prior::default(), &task.scene, &motion);
    picture(&task.scene, Some(&motion), rolled.as_ref());
    let frames = motion.strokes[0].frames() * rules.max_count;
    if task.scene.objects.len() > CROWD || frames > LONGEST {
        return;
    }
    let budgets = Settings {
        offsets: 1,
        beam: 1,
        search_rollouts: 12,
        refined: 1,
        refine_rounds: 1,
        refine_extra: 1,
        // The simulator has its own tests; here it would take all the time.
        verified_at_once: 1,
        verify_batches: 0,
        replays: 0,
        ..Settings::FIRST_LOOK
    };
    let planner = Planner::builder(Prior::default()).settings(budgets).build();
    match planner.solve(&task, &library) {
        Ok(solution) => {
            for plan in &solution.plans {
                assert!(plan.outcome.state.is_finite() && plan.outcome.error().is_finite());
                let (task, tools) = (task.clone(), plan.tools.clone());
                let predicted = Some(plan.outcome.clone());
                let plan = plan.plan.clone();
                let file = PlanFile { predicted, ..PlanFile::new(task, tools, plan) };
                written(|path| file.write(path), |path| PlanFile::load(path), &file);
            }
        }
        Err(refused) => panic!("a task file that cannot be tried: {refused}"),
    }
}

/// Returns the tool of a 2-D plan; 3-D plans have their own target.
fn flat<'a>(task: &Task, plan: &Plan, tools: &'a [Arc<Tool>]) -> Option<&'a Arc<Tool>> {
    tools.first().filter(|_| !task.in_space() && !plan.levers())
}

pub fn plan(file: PlanFile) {
    let Some(tool) = flat(&file.task, &file.plan, &file.tools) else { return };
    let motion = file.plan.motion(tool);
    let rolled = rollout(&Prior::default(), &file.task.scene, &motion);
    picture(&file.task.scene, Some(&motion), rolled.as_ref());
    written(|path| file.write(path), |path| PlanFile::load(path), &file);
}

pub fn trajectory(file: TrajectoryFile) {
    let Some(tool) = flat(&file.task, &file.plan, &file.tools) else { return };
    let motion = file.plan.motion(tool);
    picture(&file.task.scene, Some(&motion), Some(&file.trajectory));
    written(|path| file.write(path), |path| TrajectoryFile::load(path), &file);
}

pub fn recording(recording: Recording) {
    let replay = recording.replay();
    let rolled = rollout(&Prior::default(), &recording.scene, &replay.motion);
    picture(&recording.scene, Some(&replay.motion), rolled.as_ref());
    let folder = tempfile::tempdir().expect("a folder for a moment");
    let path = folder.path().join("fuzz.recording.json");
    // Angles are converted to degrees, so only the number of frames is exact.
    recording.write(&path).unwrap_or_else(|faults| panic!("cannot be written:\n{faults}"));
    let read = Recording::load(&path).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(read.frames.len(), recording.frames.len());
}

pub fn weights(weights: PredictorWeights) {
    if weights.card.config.width > 512 {
        return;
    }
    let model = Network::new(weights);
    let scene = Scene::new([Object::cuboid("box", [0.08, 0.1, 0.1]).at(0.60, 0.02, 0.2)]);
    let library = ToolLibrary::embedded().expect("the shipped tools are sound");
    let stick = library.get("stick").expect("a shipped tool");
    let push = Push { start: Vector::new(-0.1, 0.0), direction: 0.0, length: 0.1, speed: 0.1 };
    let motion = ToolMotion::pushes(Arc::clone(stick), 0.002, 0.0, &[push], true);
    let warnings = model.trust(&scene, &Job::stated(&scene, motion.clone())).warnings();
    assert!(warnings.iter().all(|warning| !warning.to_string().is_empty()));
    rollout(&model, &scene, &motion);
}

/// Rolls out motions of moderate length; every frame must be finite, unless a warning states
/// otherwise.
fn rollout(model: &dyn EffectModel, scene: &Scene, motion: &ToolMotion) -> Option<Trajectory> {
    let frames: usize = motion.strokes.iter().map(|stroke| stroke.frames()).sum();
    if frames > LONGEST || frames * scene.objects.len() > 4 * LONGEST {
        return None;
    }
    let job = Job::stated(scene, motion.clone());
    let trajectory = model.rollout(scene, &[job], Record::Frames).pop().expect("one a job");
    assert!(trajectory.frames.iter().all(|frame| frame.state.is_finite()), "not finite");
    assert!(
        !trajectory.warnings.contains(&Warning::NotFinite)
            || *model.spec() != ModelKind::PRIOR.into(),
        "the prior left the finite numbers"
    );
    Some(trajectory)
}

/// Draws everything; every number of a picture must be defined.
fn picture(scene: &Scene, motion: Option<&ToolMotion>, trajectory: Option<&Trajectory>) {
    let track = |trajectory| Track { source: Source::Predicted, trajectory };
    let picture = ScenePicture {
        title: "fuzz".into(),
        notes: Vec::new(),
        scene,
        goals: Vec::new(),
        reach: None,
        motions: motion.map(std::slice::from_ref).unwrap_or_default(),
        tracks: trajectory.map(track).into_iter().collect(),
    };
    let svg = picture.to_svg();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    for bad in ["\"NaN", "\"inf", "\"-inf", " NaN", " inf", ",NaN", ",inf"] {
        assert!(!svg.contains(bad), "{bad} in the picture");
    }
}

/// Writes a file into an empty folder and reads it back; the folder must hold nothing else.
fn written<T: PartialEq>(
    write: impl Fn(&Path) -> Result<(), Faults>,
    read: impl Fn(&Path) -> Result<T, Faults>,
    original: &T,
) {
    let folder = tempfile::tempdir().expect("a folder for a moment");
    let path = folder.path().join("fuzz.json");
    write(&path).unwrap_or_else(|faults| panic!("cannot be written:\n{faults}"));
    let again = read(&path).unwrap_or_else(|faults| panic!("cannot be read again:\n{faults}"));
    assert!(again == *original, "written and read again it is another one");
    let left = std::fs::read_dir(folder.path()).expect("the folder").count();
    assert_eq!(left, 1, "something was left next to the file");
}
