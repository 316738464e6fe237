//! Closed loop: ground truth is inferred or tolerated, for any quality of observation.

use std::path::{Path, PathBuf};

use pushplan::asset::{Faults, ToolLibrary, load_task, load_world};
use pushplan::geometry::Vector;
use pushplan::progress::{NoProgress, Progress};
use pushplan::seeded::generator;
use pushplan::solve::{Effort, Planner};
use pushplan::{
    outcome::Warning,
    scene::{Engine, JointKind, ObservedPose, Physics, Support, Unknowns},
    task::{Noise, Task, ToolMotion, Truth},
};
use pushplan_act::act::{
    ActError, End, Look, Note, RunSettings, Runner, SimulatedWorld, Step, Trace, Why, World,
    WorldError, WorldState, hidden,
};
use pushplan_act::belief::{Belief, BeliefSettings};

pub fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("the shipped tools")
}

fn planner() -> Planner {
    Planner::for_effort(Effort::Draft).expect("its model").build()
}

pub fn shipped(name: &str) -> Task {
    let path = Path::new(crate::ROOT).join(format!("tasks/{name}.yaml"));
    load_task(path, &library()).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Returns every shipped task with unknown properties.
fn tasks_with_unknowns() -> Vec<Task> {
    let paths = super::assets::shipped_tasks();
    let tasks = paths.iter().map(|path| load_task(path, &library()).expect("a task"));
    tasks.filter(|task| task.unknown.any()).collect()
}

fn begun(task: &Task, truth: &Truth) -> Trace {
    let settings = RunSettings { noise: truth.noise, ..RunSettings::default() };
    Trace::new(task.clone(), settings, "draft".into(), Some(truth.clone()))
}

fn run(trace: &mut Trace, world: &mut dyn World) -> Result<(), ActError> {
    let (planner, library) = (planner(), library());
    Runner::new(&planner, &library).run_with(trace, world, &mut |_| Ok(()), &NoProgress)
}

pub fn drawn(task: &Task, seed: u64) -> (Trace, SimulatedWorld) {
    let truth = hidden(task, &library(), seed).expect("its tools are there");
    (begun(task, &truth), SimulatedWorld::new(truth))
}

#[test]
fn every_shipped_task_with_unknowns_is_solved_in_drawn_worlds() {
    let tasks = tasks_with_unknowns();
    assert!(tasks.len() >= 6, "{}", tasks.len());
    for task in tasks {
        for seed in 1..=2 {
            let (mut trace, mut world) = drawn(&task, seed);
            run(&mut trace, &mut world).unwrap_or_else(|error| panic!("{}: {error}", task.name));
            let error = task.goals[0].error(world.state());
            assert_eq!(trace.end, Some(End::Reached), "{} {seed}: off by {error}", task.name);
            assert!(task.goals[0].reached(world.state()), "{} {seed}: off by {error}", task.name);
        }
    }
}

#[test]
fn marked_tasks_need_a_probe() {
    let tasks = tasks_with_unknowns();
    let probing: Vec<&Task> =
        tasks.iter().filter(|task| task.description.contains("exploratory")).collect();
    assert!(probing.len() >= 2);
    for task in probing {
        let probed = (1..=4).any(|seed| {
            let (mut trace, mut world) = drawn(task, seed);
            run(&mut trace, &mut world).expect("it can be run");
            trace.steps.iter().any(|step| step.why == Why::Probe)
        });
        assert!(probed, "{}", task.name);
    }
}

/// Observer that cancels after a number of steps.
struct After(usize, std::sync::atomic::AtomicUsize);

impl Progress for After {
    fn update(&self, done: u64, _: u64) {
        self.1.store(done as usize, std::sync::atomic::Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.1.load(std::sync::atomic::Ordering::Relaxed) >= self.0
    }
}

#[test]
fn a_run_that_is_stopped_goes_on_to_the_same_bits_and_threads_change_nothing() {
    let task = shipped("unknown-slide");
    let (planner, library) = (planner(), library());
    let runner = Runner::new(&planner, &library);
    let json = |trace: &Trace| serde_json::to_string(trace).expect("JSON");
    let whole = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let (mut trace, mut world) = drawn(&task, 1);
            runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress).expect("a run");
            trace
        })
    };
    let trace = whole(1);
    assert!(trace.steps.len() >= 2, "no step is left to resume");
    assert_eq!(json(&trace), json(&whole(3)));

    assert_eq!(json(&interrupted(&runner, &task)), json(&trace));
}

/// Returns a run in the first drawn world, cancelled after one push and resumed from its file.
pub fn interrupted(runner: &Runner, task: &Task) -> Trace {
    let mut kept = String::new();
    let (mut stopped, mut world) = drawn(task, 1);
    let mut keep = |trace: &Trace| -> Result<(), Faults> {
        kept = serde_json::to_string(trace).expect("JSON");
        Ok(())
    };
    let ended = runner.run_with(&mut stopped, &mut world, &mut keep, &After(1, Default::default()));
    assert!(matches!(ended, Err(ActError::Stopped { pushes: 1 })), "{ended:?}");
    // The world is lost with the process; only the file remains.
    let mut again: Trace = serde_json::from_str(&kept).expect("a trace");
    let (_, mut world) = drawn(task, 1);
    runner.run_with(&mut again, &mut world, &mut |_| Ok(()), &NoProgress).expect("the rest");
    again
}

/// World whose observations are corrupted.
struct Spoilt<F: FnMut(usize, &mut Vec<Look>)> {
    world: SimulatedWorld,
    acts: usize,
    spoil: F,
    /// Objects that are never observed at rest.
    unseen: Vec<usize>,
}

impl<F: FnMut(usize, &mut Vec<Look>)> World for Spoilt<F> {
    fn look(&mut self) -> Result<Look, WorldError> {
        let mut look = self.world.look()?;
        if self.acts > 0 {
            self.unseen.iter().for_each(|&k| look.seen[k] = None);
        }
        Ok(look)
    }

    fn act(&mut self, motion: &ToolMotion) -> Result<Vec<Look>, WorldError> {
        let mut looks = self.world.act(motion)?;
        (self.spoil)(self.acts, &mut looks);
        self.acts += 1;
        Ok(looks)
    }

    fn save(&self) -> Option<WorldState> {
        self.world.save()
    }
}

fn spoilt(
    task: &Task,
    unseen: Vec<usize>,
    spoil: impl FnMut(usize, &mut Vec<Look>),
) -> (Result<(), ActError>, Trace) {
    let (mut trace, world) = drawn(task, 1);
    let mut world = Spoilt { world, acts: 0, spoil, unseen };
    (run(&mut trace, &mut world), trace)
}

fn notes(steps: &[Step]) -> Vec<Note> {
    steps.iter().flat_map(|step| step.notes.clone()).collect()
}

#[test]
fn late_rare_swapped_and_wrong_observations_are_tolerated() {
    let task = shipped("hidden-hinge");
    let (ended, trace) = spoilt(&task, Vec::new(), |_, looks| looks.reverse());
    ended.expect("put in order");
    assert_eq!((trace.end, &notes(&trace.steps)[0]), (Some(End::Reached), &Note::OutOfOrder));

    // Without any observation during the motion and at rest, the table is observed again.
    let (ended, trace) = spoilt(&task, Vec::new(), |_, looks| looks.clear());
    ended.expect("looked at again");
    assert_eq!(trace.end, Some(End::Reached));
    assert!(!trace.steps[0].again.is_empty());

    let (ended, trace) = spoilt(&task, Vec::new(), |_, looks| {
        looks.iter_mut().skip(9).for_each(|look| look.seen.swap(0, 1));
    });
    ended.expect("changed back");
    assert_eq!(trace.end, Some(End::Reached));
    assert!(notes(&trace.steps).contains(&Note::Swapped { between: [0, 1] }));

    let far = ObservedPose { position: Vector::new(5.0, 5.0), heading: Some(0.0) };
    let (ended, trace) = spoilt(&task, Vec::new(), |_, looks| looks[3].seen[0] = Some(far));
    ended.expect("left out");
    assert_eq!(trace.end, Some(End::Reached));
    assert!(notes(&trace.steps).contains(&Note::Jumped { object: 0 }));
}

#[test]
fn a_lost_object_is_an_error_only_if_the_goal_is_about_it() {
    let task = shipped("hidden-hinge");
    let hide = |k: usize| {
        move |_: usize, looks: &mut Vec<Look>| {
            looks.iter_mut().for_each(|look| look.seen[k] = None);
        }
    };
    let (ended, trace) = spoilt(&task, vec![1], hide(1));
    ended.expect("the other one is enough");
    assert!(trace.end == Some(End::Reached) && notes(&trace.steps) == [Note::Unseen { object: 1 }]);
    let (ended, _) = spoilt(&task, vec![0], hide(0));
    let error = ended.expect_err("the object is not observed");
    assert_eq!(error.to_string(), "`near` was not observed in 3 observations with the tool lifted");
    let (ended, _) = spoilt(&task, Vec::new(), |_, looks| {
        looks.iter_mut().for_each(|look| look.seen.truncate(1));
    });
    assert!(matches!(ended, Err(ActError::Objects { expected: 2, found: 1 })), "{ended:?}");
}

#[test]
fn samples_keep_what_is_known_and_vary_what_is_not() {
    let mut task = shipped("jointed-pair");
    let tool = task.tools(&library()).expect("tools").remove(0);
    let noise = BeliefSettings::new(Noise::default());
    let about = |unknown| Belief::about(&task.scene, unknown, (tool.clone(), 0.0), noise, 3);
    let stated = Physics::stated(&task.scene);
    assert_eq!(about(Unknowns::NONE).map(), stated);
    assert_eq!(about(Unknowns::NONE).sample(&mut generator(1, 0)), stated);
    let unknown = Unknowns { joints: true, frictions: true, ..Unknowns::NONE };
    let belief = about(unknown);
    let samples: Vec<Physics> = (0..400).map(|k| belief.sample(&mut generator(5, k))).collect();
    assert!(samples.iter().all(|one| one.masses == stated.masses && one.feet == stated.feet));
    // Half of the near pairs are joined, with equal shares of the joint types: see the belief's
    // prior.
    let share = |is: &dyn Fn(&JointKind) -> bool| {
        let count = samples.iter().filter(|one| one.joints.iter().any(|joint| is(&joint.kind)));
        count.count() as f64 / samples.len() as f64
    };
    let fixed = share(&|kind| matches!(kind, JointKind::Fixed));
    let revolute = share(&|kind| matches!(kind, JointKind::Revolute { .. }));
    assert!((share(&|_| true) - 0.5).abs() < 0.1, "{}", share(&|_| true));
    assert!((fixed - 1.0 / 6.0).abs() < 0.07 && (revolute - 1.0 / 6.0).abs() < 0.07);
    let table: Vec<f64> = samples.iter().map(|one| one.table_friction).collect();
    let within = table.iter().filter(|value| (0.5 / 1.5..=0.5 * 1.5).contains(*value)).count();
    assert!((300..=400).contains(&within) && table.iter().any(|value| *value != table[0]));
    task.unknown = unknown;
    assert_ne!(hidden(&task, &library(), 1).unwrap(), hidden(&task, &library(), 2).unwrap());
}

#[test]
fn masses_and_frictions_are_learnt_from_pushes() {
    let task = shipped("unknown-slide");
    let mut stated = task.scene.clone();
    // Half of the stated table friction changes how far objects rotate and slide.
    stated.table_friction = 0.34;
    stated.objects[0].support = Support::Corners;
    let truth =
        Truth { noise: Noise { position: 2e-4, heading: 2e-3 }, ..Truth::stated(&stated, 1) };
    let mut trace = begun(&task, &truth);
    run(&mut trace, &mut SimulatedWorld::new(truth)).expect("a run");
    let [first, last] = [&trace.steps[0], &trace.steps[trace.steps.len() - 1]];
    let width = |step: &Step| step.numbers.spreads[0][1];
    assert!(width(last) <= width(first));
    assert!(last.numbers.spreads[0][0] > 0.8, "{:?}", last.numbers);
}

#[test]
fn solving_a_task_with_unknowns_prints_a_warning() {
    let task = shipped("unknown-slide");
    let solution = planner().solve(&task, &library()).expect("a sound task");
    let guessed = Warning::Guessed { unknown: task.unknown };
    assert!(solution.warnings.contains(&guessed));
    assert!(guessed.to_string().contains("masses, frictions and support"), "{guessed}");
}

const TASK: &str = "
scene:
  objects:
    - {name: a, shape: {cylinder: {radius: 0.04, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.5, 0]}
    - {name: b, shape: {cylinder: {radius: 0.04, height: 0.1}}, mass: 0.4, friction: 0.4, position: [0.5, 0.09]}
unknown: [joints, support]
robot: {reach: {max: 0.7}}
tools: [finger]
goal: {object: a, position: [0.6, 0], tolerance: 0.02}
";

#[test]
fn unknowns_are_read_written_and_their_faults_have_places() {
    let task = Task::parse(TASK, "t.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(task.unknown, Unknowns { joints: true, support: true, ..Unknowns::NONE });
    let again = Task::parse(&task.to_yaml().expect("YAML"), "t.yaml").expect("the same task");
    assert_eq!(again, task);
    let fault = |from: &str, to: &str| {
        Task::parse(&TASK.replace(from, to), "t.yaml").expect_err("a fault").to_string()
    };
    let twice = fault("[joints, support]", "[joints, joints]");
    assert!(twice.contains("t.yaml:6:19") && twice.contains("named twice"), "{twice}");
    let word = fault("support]", "supports]");
    assert!(word.contains("6:19") && word.contains("did you mean `support`"), "{word}");
    let stated = "  joints: [{between: [a, b], kind: fixed}]\nunknown: [joints, support]";
    let both = fault("unknown: [joints, support]", stated);
    assert!(both.contains("t.yaml:6:11") && both.contains("both stated and unknown"), "{both}");
}

#[test]
fn world_files_state_the_ground_truth_and_their_errors_have_locations() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let task = Task::parse(TASK, "t.yaml").expect("a task");
    let load = |text: &str| {
        let path = folder.path().join("w.yaml");
        std::fs::write(&path, text).expect("a file");
        load_world(&path, &task)
    };
    let truth = load(
        "engine: 3d\nnoise: {position: 0.002}\nheadings: false\nseed: 9\ntable_friction: 0.3\n\
         objects:\n  - {name: b, mass: 0.7, support: corners}\n\
         joints:\n  - {between: [a, b], kind: revolute, at: [0.5, 0.045]}\n",
    )
    .unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((truth.engine, truth.seed, truth.headings), (Engine::Spatial, 9, false));
    assert_eq!((truth.scene.objects[1].mass, truth.scene.table_friction), (0.7, 0.3));
    assert_eq!((truth.noise.position, truth.scene.joints.len()), (0.002, 1));
    assert_eq!(load("{}").expect("nothing else").scene, task.scene);
    for (text, place, words) in [
        ("objects: [{name: c, mass: 1}]", "1:18", "no object `c`"),
        ("objects: [{name: a, mass: -1}]", "1:27", "a mass in kg"),
        ("joints: [{between: [a, b], kind: revolute}]", "1:10", "needs `at`"),
        ("joints: [{between: [a, a], kind: fixed}]", "1:10", "closes a loop"),
        ("noise: {position: 1}", "1:19", "1 mm is 0.001"),
        ("nois: {position: 1}", "1:1", "did you mean `noise`"),
    ] {
        let fault = load(text).expect_err(text).to_string();
        assert!(fault.contains(place) && fault.contains(words), "{text}: {fault}");
    }
}

#[test]
fn the_command_runs_resumes_and_reports_its_end() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let run = |more: &[&str]| {
        let fixed = ["run", "tasks/hidden-hinge.yaml", "--world", "2", "--json", "--out", out];
        crate::program::run(&[&fixed, more].concat())
    };
    let output = run(&[]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{error}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!((&json["end"], &json["really_reached"]), (&"reached".into(), &true.into()));
    let file = |name: &str| -> PathBuf { folder.path().join(format!("hidden-hinge.{name}")) };
    assert!(file("run.svg").exists() && file("belief.svg").exists());
    let kept = std::fs::read(file("run.json")).expect("a trace");
    assert_eq!(run(&["--resume"]).status.code(), Some(0));
    assert_eq!(std::fs::read(file("run.json")).expect("a trace"), kept);
    assert_eq!(run(&["--resume", "--seed", "5"]).status.code(), Some(2), "another run");
    std::fs::write(file("run.json"), &kept[..kept.len() / 2]).expect("a torn file");
    assert_eq!(run(&["--resume"]).status.code(), Some(3));
    let nothing = folder.path().join("none.yaml");
    let world = ["run", "tasks/hidden-hinge.yaml", "--world", nothing.to_str().expect("UTF-8")];
    assert_eq!(crate::program::run(&world).status.code(), Some(3));
}
