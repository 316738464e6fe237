//! The planner from end to end, with the 2-D engine as effect model.

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use pushplan::asset::{ToolLibrary, load_task};
use pushplan::effect::{EffectModel, Job, Quantiles, Simulated, Trust};
use pushplan::geometry::Vector;
use pushplan::progress::Progress;
use pushplan::sim::Simulator;
use pushplan::solve::{Effort, PlanStatus, Planner, Settings, Solution};
use pushplan::{
    outcome::{Frame, Record, Trajectory},
    scene::{Engine, Joint, JointKind, ModelKind, ModelSpec, Scene, Situation},
    task::{Task, ToolChoice},
};

fn planner() -> Planner {
    Planner::builder(Simulated::new(Simulator::planar())).build()
}

/// Trust of a model that claims to be exact.
const EXACT: Trust =
    Trust::Mine { error: Some(Quantiles { median: 0.0, p95: 0.0 }), warnings: Vec::new() };

static WISHFUL: ModelSpec = ModelSpec::of(ModelKind::Custom("wishful"));

/// Model that predicts the goal for every object after any push.
struct Wishful(Vector);

impl EffectModel for Wishful {
    fn spec(&self) -> &ModelSpec {
        &WISHFUL
    }

    fn trust(&self, _: &Scene, _: &Job) -> Trust {
        EXACT
    }

    fn rollout(&self, _: &Scene, jobs: &[Job], _: Record) -> Vec<Trajectory> {
        let landed = |job: &Job| {
            let mut state = job.start.clone();
            state.poses.iter_mut().for_each(|pose| pose.position = self.0);
            let tool = job.motion.slide().strokes[0].to;
            Trajectory {
                frames: vec![Frame { time: 1.0, stroke: 0, tool, state, blade: None }],
                ..Trajectory::new(WISHFUL.clone())
            }
        };
        jobs.iter().map(landed).collect()
    }
}

/// 2-D engine that predicts the end of every push next to its true end.
struct Beside(Simulated, Vector);

impl EffectModel for Beside {
    fn spec(&self) -> &ModelSpec {
        self.0.spec()
    }

    fn trust(&self, _: &Scene, _: &Job) -> Trust {
        EXACT
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        let mut played = self.0.rollout(scene, jobs, record);
        for frame in played.iter_mut().flat_map(|trajectory| &mut trajectory.frames) {
            frame.state.poses.iter_mut().for_each(|pose| pose.position += self.1);
        }
        played
    }
}

fn shipped(name: &str) -> (Task, ToolLibrary) {
    let library = ToolLibrary::embedded().unwrap();
    let folder = PathBuf::from(crate::ROOT).join("tasks");
    (load_task(folder.join(name), &library).unwrap(), library)
}

#[test]
fn a_plan_that_ends_beside_the_goal_in_3d_is_aimed_as_far_on_the_other_side() {
    let (task, library) = shipped("pull-back.yaml");
    let off = Vector::new(0.02, 0.025);
    assert!(off.norm() > task.goals[0].tolerance(), "the first plans must fail");
    let model = Beside(Simulated::new(Simulator::planar()), off);
    let solution = Planner::builder(model).build().solve(&task, &library).unwrap();
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().unwrap();
    let aim = best.refinement.aimed_at.expect("an aim next to the goal");
    // The two engines differ by millimetres in addition to the error of the model.
    assert!((aim - task.goals[0].position().unwrap() - off).norm() < 0.01, "{aim:?}");
    let verdict = best.verdict.as_ref().unwrap();
    assert!(Engine::ALL.iter().all(|e| verdict.nominal(*e).is_some_and(|e| e.outcome.reached)));
}

#[test]
fn the_network_makes_every_rollout_of_a_solution() {
    let (task, library) = shipped("pull-back.yaml");
    for effort in [Effort::Draft, Effort::Standard] {
        let planner = Planner::for_effort(effort).unwrap().build();
        let solution = planner.solve(&task, &library).unwrap();
        let first = |spec: &ModelSpec| spec.first().kind.clone();
        assert_eq!(first(&solution.model), ModelKind::NETWORK);
        let made = solution.plans.iter().filter(|ranked| !ranked.plan.is_empty());
        assert!(made.map(|ranked| first(&ranked.predicted.by)).all(|by| by == ModelKind::NETWORK));
    }
}

#[test]
fn plans_that_only_work_in_the_model_fail_verification() {
    let (task, library) = shipped("pull-back.yaml");
    // A single plan is verified, because some of many wishful predictions come true.
    let settings = Settings::FIRST_LOOK;
    let planner =
        Planner::builder(Wishful(task.goals[0].position().unwrap())).settings(settings).build();
    let solution = planner.solve(&task, &library).unwrap();
    assert_eq!(solution.status, PlanStatus::FailedVerification);
    let best = solution.best().unwrap();
    let verdict = best.verdict.as_ref().unwrap();
    assert!(!verdict.passed && best.outcome.reached && best.outcome.error() == 0.0);
    assert!(verdict.evidence.iter().all(|evidence| !evidence.outcome.reached));
    assert!(verdict.evidence.len() == 2 && verdict.robustness.is_none());
}

#[test]
fn without_a_way_to_the_goal_there_is_no_plan_but_a_nearest_one() {
    // The hook cannot pull the can that far past the wall in one push.
    let (mut task, library) = shipped("pull-back-behind-wall.yaml");
    task.goals[0].set_position(Vector::new(0.5, -0.1));
    task.pushes.max_count = 1;
    let solution = planner().solve(&task, &library).unwrap();
    assert_eq!(solution.status, PlanStatus::NoPlan);
    let before = task.goals[0].error(&task.scene.start());
    assert!(solution.best().unwrap().outcome.error() < before - 0.05);
    assert!(solution.plans.iter().all(|plan| plan.verdict.is_none()));
    let errors = solution.plans.windows(2);
    assert!(errors.into_iter().all(|p| p[0].outcome.error() <= p[1].outcome.error() + 1e-3));
}

#[test]
fn a_goal_that_is_met_already_needs_no_push() {
    let (mut task, library) = shipped("pull-back.yaml");
    let start = task.scene.objects[task.goals[0].object].pose.position;
    task.goals[0].set_position(start);
    let solution = planner().solve(&task, &library).unwrap();
    assert_eq!(solution.status, PlanStatus::Solved);
    let best = solution.best().unwrap();
    assert!(best.plan.is_empty() && best.verdict.as_ref().unwrap().passed);
    assert_eq!(best.verdict.as_ref().unwrap().robustness, Some(1.0));
}

#[test]
fn any_number_of_threads_gives_the_same_plans() {
    for name in ["cluster-neighbour.yaml", "pull-back-twice.yaml", "reference-chain.yaml"] {
        let (task, library) = shipped(name);
        let solve = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let planner =
                Planner::builder(Simulated::new(Simulator::planar())).effort(Effort::Draft).build();
            let mut solution = pool.install(|| planner.solve(&task, &library).unwrap());
            solution.statistics.timing = Default::default();
            solution
        };
        let (one, three) = (solve(1), solve(3));
        assert_eq!(one.status, three.status);
        assert_eq!(one.statistics, three.statistics);
        for (a, b) in one.plans.iter().zip(&three.plans) {
            assert_eq!(a.plan, b.plan, "{name}");
            assert_eq!(a.verdict, b.verdict, "{name}");
            assert_eq!(a.predicted, b.predicted, "{name}");
        }
    }
}

#[test]
fn tasks_made_in_code_are_refused_when_they_make_no_sense() {
    let (task, library) = shipped("pull-back.yaml");
    let spoil: [fn(&mut Task); 11] = [
        |task| task.goals[0].set_tolerance(f64::NAN),
        |task| task.goals[0].set_position(Vector::new(f64::INFINITY, 0.0)),
        |task| task.goals[0].object = 99,
        |task| task.pushes.length = 0.0,
        |task| task.pushes.speed = -1.0,
        |task| task.pushes.grip_yaws.clear(),
        |task| task.robot.reach_max = f64::NAN,
        |task| task.scene.objects[0].mass = 0.0,
        |task| task.tools = ToolChoice::Named(vec!["nonesuch".into()]),
        |task| task.scene.joints.push(Joint::new([0, 7], JointKind::Fixed)),
        |task| task.scene.joints.push(Joint::new([0, 0], JointKind::Fixed)),
    ];
    for (k, spoil) in spoil.into_iter().enumerate() {
        let mut task = task.clone();
        spoil(&mut task);
        assert!(planner().solve(&task, &library).is_err(), "fault {k}");
    }
    assert!(planner().solve(&task, &ToolLibrary::default()).is_err());
    let recorder = Recorder::default();
    assert!(planner().solve_with(&task, &library, &recorder).is_ok());
    let stages = recorder.stages.into_inner().unwrap();
    for stage in ["search", "refine", "verify"] {
        assert!(stages.contains(&format!("push: {stage}, plans of 1 push")), "{stages:?}");
    }
    // Reports on the best plan so far: each contains more information, and nothing is reported
    // twice.
    let answers = recorder.answers.into_inner().unwrap();
    let known: Vec<&str> = answers.iter().map(|one| one.split_once(": ").unwrap().1).collect();
    let all = ["the search predicts success", "success is predicted after refinement", "passes"];
    assert_eq!(known, all, "{answers:?}");
    assert!(answers.iter().all(|one| one.contains(", 1 push: ")), "{answers:?}");
}

/// Recorder of a planner's progress reports.
#[derive(Default)]
struct Recorder {
    stages: Mutex<Vec<String>>,
    answers: Mutex<Vec<String>>,
}

impl Progress for Recorder {
    fn stage(&self, what: &str) {
        self.stages.lock().unwrap().push(what.to_owned());
    }

    fn so_far(&self, answer: &str) {
        self.answers.lock().unwrap().push(answer.to_owned());
    }

    fn update(&self, done: u64, total: u64) {
        assert!(done <= total, "{done} of {total}");
    }
}

#[test]
fn every_shipped_task_ends_as_described() {
    let library = ToolLibrary::embedded().unwrap();
    let planner = planner();
    for path in crate::assets::shipped_tasks() {
        let task = load_task(&path, &library).unwrap();
        let solution = planner.solve(&task, &library).unwrap();
        println!("{}", row(&task.name, &solution));
        let expected = match task.description.contains("no solution") {
            true => PlanStatus::NoPlan,
            false => PlanStatus::Solved,
        };
        assert_eq!(solution.status, expected, "{}", task.name);
    }
}

/// Returns one line of numbers, shown by `cargo test -- solving --nocapture`.
fn row(name: &str, solution: &Solution) -> String {
    let (statistics, best) = (&solution.statistics, &solution.plans[0]);
    let timing = statistics.timing;
    let replayed = best.verdict.as_ref().map(|verdict| {
        let errors: Vec<String> = verdict
            .evidence
            .iter()
            .take(2)
            .map(|evidence| format!("{:.1}", evidence.outcome.error() * 1e3))
            .collect();
        format!("planar, 3-D {} mm, robust {:?}", errors.join(", "), verdict.robustness)
    });
    format!(
        "{name}: {:?} in {:.2} s ({:.2} + {:.2} + {:.2}), {} rollouts, {} verified; {} at {:.0} deg, \
         {} pushes, predicted {:.1} -> {:.1} mm; {}",
        solution.status,
        timing.total,
        timing.search,
        timing.refinement,
        timing.verification,
        statistics.rollouts,
        statistics.verified,
        best.plan.tool(),
        best.plan.grip_yaw().to_degrees(),
        best.plan.pushes().len(),
        best.refinement.before * 1e3,
        best.outcome.error() * 1e3,
        replayed.unwrap_or_default(),
    )
}

#[test]
fn among_tools_that_do_as_well_the_one_that_costs_less_is_taken_or_the_simpler() {
    // Each of these tools brings a free can to a place ahead of it.
    let text = "
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.10}}, mass: 0.3, friction: 0.4, position: [0.6, 0.0]}
robot: {reach: {min: 0.3, max: 0.9}}
tools: [NAMES]
goal: {object: can, position: [0.75, 0.0], tolerance: 0.02}
";
    let library = ToolLibrary::embedded().unwrap();
    for (names, wanted) in [
        ("fork, l-hook, stick", "stick"),
        ("stick, l-hook, fork", "stick"),
        ("l-hook, fork, stick", "stick"),
        // Lower cost takes precedence over simplicity.
        ("{name: stick, cost: 2}, {name: fork, cost: 3}, {name: l-hook, cost: 1}", "l-hook"),
        ("{name: stick, cost: 0.002}, {name: l-hook, cost: 0.001}", "l-hook"),
        ("{name: stick, cost: 2}, {name: l-hook, cost: 2}", "stick"),
        ("{name: stick, cost: 2}", "stick"),
    ] {
        let task = Task::parse(&text.replace("NAMES", names), "can.yaml").unwrap();
        assert_eq!(Task::parse(&task.to_yaml().unwrap(), "can.yaml").unwrap(), task);
        let solution = planner().solve(&task, &library).unwrap();
        let tool = &solution.plans[0].tool().name;
        assert_eq!((solution.status, tool.as_str()), (PlanStatus::Solved, wanted), "{names}");
    }
}

#[test]
fn where_plans_depend_on_what_objects_rest_on_one_is_made_that_does_not() {
    // The underside of a box decides more about its rotation than the push at its corner.
    let text = "
scene:
  table: {friction: 0.5}
  objects:
    - {name: box, shape: {cuboid: {size: [0.052, 0.078, 0.073]}}, mass: 0.94, friction: 0.53, position: [0.52, 0.02]}
robot: {reach: {min: 0.1, max: 0.9}, home: [0.1, 0.0], hand: {radius: 0.05}}
tools: all
pushes: {max_count: 1, grip_yaws_deg: [0, 90, -90]}
goal: {object: box, heading_deg: 54.8, heading_tolerance_deg: 5, symmetric: false}
";
    let task = Task::parse(text, "box.yaml").unwrap();
    let library = ToolLibrary::embedded().unwrap();
    let planner = Planner::for_effort(Effort::Standard).unwrap().build();
    let solution = planner.solve(&task, &library).unwrap();
    let best = &solution.plans[0];
    let robustness = best.verdict.as_ref().and_then(|verdict| verdict.robustness);
    assert_eq!(solution.status, PlanStatus::Solved, "{robustness:?}");
    assert!(robustness >= Some(0.9), "{robustness:?}");
    assert!(best.works_on_all_supports(&task, &Situation::stated(&task.scene)));
}

/// Observer that cancels after a number of questions.
struct After {
    asked: AtomicUsize,
    most: usize,
}

impl Progress for After {
    fn cancelled(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.most
    }
}

#[test]
fn a_stopped_verification_is_not_called_solved() {
    // A draft's first replays of a plan for this task succeed, and later ones fail.
    let (task, library) =
        (Task::example("unknown-slide").unwrap(), ToolLibrary::embedded().unwrap());
    let planner = Planner::for_effort(Effort::Draft).unwrap().build();
    let stopped = |most| {
        let progress = After { asked: AtomicUsize::new(0), most };
        let solution = planner.solve_with(&task, &library, &progress).unwrap();
        (solution, progress.asked.into_inner())
    };
    let (whole, asked) = stopped(usize::MAX);
    assert_eq!(whole.status, PlanStatus::Solved);
    let mut unclear = 0;
    for cut in 1..32 {
        let (solution, _) = stopped(asked * cut / 32);
        let Some(best) = solution.best() else { continue };
        let passes = planner.verify(&best.to_file(&task)).unwrap().passed;
        assert!(passes || solution.status != PlanStatus::Solved, "cut {cut} of 32");
        unclear += usize::from(solution.status == PlanStatus::Fragile);
    }
    assert!(unclear > 0, "no cut fell into a verification");
}
