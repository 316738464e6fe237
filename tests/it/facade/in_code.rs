//! Tasks, plan files and runs made in code, with public names only.

use pushplan::files::PlanFile;
use pushplan::scenes::{PairFriction, Surface};
use pushplan::{
    Effort, Goal, Object, Obstacle, Plan, PlanStatus, Planner, Pose, Push, PushForm, Robot, Scene,
    SolveError, Task, ToolLibrary, Warning,
};
use pushplan_act::{End, Look, Runner, SimulatedWorld, World, hidden};

fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("tools")
}

fn drafts() -> Planner {
    Planner::for_effort(Effort::Draft).expect("its model").build()
}

fn pulled() -> Task {
    let can = Object::cylinder("can", 0.05, 0.10).mass(0.4).at(0.62, 0.10, 0.0);
    let wall = Obstacle::cuboid("wall", [0.03, 0.10, 0.12]).at(0.36, 0.20, 0.0);
    let scene = Scene::new([can]).with_obstacle(wall);
    Task::new("pulled", scene, Robot::reaching(0.1, 0.7), Goal::new(0, [0.45, 0.10], 0.02))
}

#[test]
fn a_bad_task_states_all_its_faults_with_their_keys() {
    let mut task = pulled();
    task.scene.objects[0].mass = -1.0;
    task.scene.objects[0].friction = f64::NAN;
    task.scene.obstacles[0].size[1] = 0.0;
    task.robot.reach_max = f64::INFINITY;
    task.pushes.speed = 0.0;
    task.pushes.grip_yaws.clear();
    task.robustness = 2.0;
    task.goals[0].set_tolerance(0.0);
    let error = drafts().solve(&task, &library()).expect_err("faults");
    let SolveError::BadTask { faults, .. } = &error else { panic!("{error}") };
    let keys: Vec<&str> = faults.iter().map(|fault| fault.key.as_str()).collect();
    let wanted = [
        "scene.objects[0].mass",
        "scene.objects[0].friction",
        "scene.obstacles[0]",
        "robot.reach.max",
        "robustness",
        "pushes.speed",
        "pushes.grip_yaws_deg",
        "goal",
    ];
    assert_eq!(keys, wanted, "{error}");
    let text = error.to_string();
    assert_eq!(text.lines().count(), wanted.len(), "{text}");
    let line = "task `pulled`: pushes.speed: the speed of a push is 0, but must be a positive";
    assert!(text.contains(line), "{text}");
}

#[test]
fn faults_of_goals_and_pairs_name_their_place() {
    let task = pulled().and(Goal::new(3, [0.5, 0.0], 0.02));
    let mut task = Task { goals: [task.goals.clone(), task.goals].concat(), ..pulled() };
    task.scene.frictions.push(PairFriction {
        object: 0,
        with: Surface::Object(0),
        coefficient: 0.3,
    });
    let error = drafts().solve(&task, &library()).expect_err("faults").to_string();
    for line in [
        "scene.frictions[0]: the friction of object 0",
        "goal[1]: the goal names object 3, which does not exist",
        "goal[2]: object 0 has two goals",
    ] {
        assert!(error.contains(line), "{line}: {error}");
    }
}

#[test]
fn objects_and_obstacles_are_placed_alike() {
    let object = Object::cuboid("box", [0.1, 0.2, 0.3]).at(0.4, -0.1, 0.5);
    let obstacle = Obstacle::cuboid("box", [0.1, 0.2, 0.3]).at(0.4, -0.1, 0.5);
    assert_eq!(object.pose, Pose::new(0.4, -0.1, 0.5));
    assert_eq!(object.pose, obstacle.pose);
}

#[test]
fn a_plan_is_saved_read_and_verified_without_hidden_names() {
    let (planner, task) = (drafts(), pulled());
    let solution = planner.solve(&task, &library()).expect("a task");
    assert_eq!(solution.status, PlanStatus::Solved);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("pulled.plan.json");
    let best = solution.best().expect("a plan");
    best.to_file(&task).write(&path).expect("a file");
    let file = PlanFile::load(&path).expect("a plan");
    assert_eq!(file.predicted.as_ref(), Some(&best.outcome));
    assert!(planner.verify(&file).expect("a verdict").passed);
    // The plan pushes the can away from another goal.
    let elsewhere = Goal::new(0, [0.62, -0.2], 0.02);
    let other = PlanFile { task: Task { goals: vec![elsewhere], ..task.clone() }, ..file.clone() };
    assert!(!planner.verify(&other).expect("a verdict").passed);
    // A plan that names another tool, and a task with a fault, are errors.
    let push = Push { start: [0.5, 0.0].into(), direction: 0.0, length: 0.1, speed: 0.1 };
    let plan = Plan::pushing("spoon", 0.0, PushForm::Placed, 0.002, [push]);
    let error = planner.verify(&PlanFile { plan, ..file.clone() }).expect_err("no such tool");
    assert!(error.to_string().contains("not given: spoon"), "{error}");
    let mut bad = file;
    bad.task.pushes.length = f64::NAN;
    let error = planner.verify(&bad).expect_err("a fault").to_string();
    assert!(error.contains("pushes.length: the length of a push is NaN"), "{error}");
}

#[test]
fn doubts_before_a_search_are_warnings_of_its_solution() {
    let heavy = Object::cuboid("slab", [0.1, 0.1, 0.1]).mass(80.0).at(0.55, 0.0, 0.0);
    let goal = Goal::new(0, [0.65, 0.0], 0.02);
    let task = Task::new("heavy", Scene::new([heavy]), Robot::reaching(0.1, 0.9), goal);
    let (planner, library) = (drafts(), library());
    let doubts = planner.doubts(&task, &library).expect("a task");
    assert!(!doubts.is_empty(), "80 kg are outside the range of training");
    let solution = planner.solve(&task, &library).expect("a task");
    let known = |doubt: &Warning| solution.warnings.iter().any(|one| one.is_like(doubt));
    assert!(doubts.iter().all(known), "{doubts:?}: {:?}", solution.warnings);
    assert_eq!(planner.doubts(&pulled(), &library).expect("a task"), []);
}

#[test]
fn a_run_needs_a_task_and_a_world_only() {
    let (planner, library) = (drafts(), library());
    let task = Task::example("pull-back").expect("a task");
    let mut world = SimulatedWorld::new(hidden(&task, &library, 1).expect("a world"));
    let trace = Runner::new(&planner, &library).run(&task, &mut world).expect("a run");
    assert_eq!(trace.end, Some(End::Reached));
    let Look { seen, .. } = world.look().expect("an observation");
    assert_eq!(seen.len(), task.scene.objects.len());
    assert!(task.reached(world.state()));
}
