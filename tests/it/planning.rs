//! Planning: placement of pushes, results of the search, limits of refinement, and conditions for a
//! verified plan.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use pushplan::effect::Simulated;
use pushplan::geometry::{Pose, Shape, Vector, clearance, travel_to_contact};
use pushplan::plan::{
    Candidate, CandidatePush, Infeasible, Placement, RefineSettings, RefineStatistics, Rollouts,
    STAND_OFF, Search, SearchResult, SearchSettings, Start, Workspace, evaluate, kinds, refine,
};
use pushplan::progress::NoProgress;
use pushplan::sim::Simulator;
use pushplan::{
    scene::{Object, Obstacle, Part, Robot, Scene, Situation, Tool},
    task::{Goal, PushForm, Task},
};

const SETTINGS: SearchSettings = SearchSettings {
    offsets: 5,
    fine_offsets: false,
    beam: 16,
    rollouts: 600,
    kept: 32,
    kinds: 8,
    model_error: 0.0,
};

fn part(name: &str, size: [f64; 3], x: f64, y: f64, heading: f64) -> Part {
    Part::cuboid(name, size, Pose::new(x, y, heading))
}

fn tool(name: &str, parts: Vec<Part>) -> Arc<Tool> {
    Arc::new(Tool::new(name, parts).unwrap())
}

fn stick() -> Arc<Tool> {
    tool("stick", vec![part("rod", [0.4, 0.04, 0.05], 0.25, 0.0, 0.0)])
}

/// Returns a handle along +x (index 0) with a bar to the left at its end (index 1).
fn hook() -> Arc<Tool> {
    tool(
        "hook",
        vec![
            part("handle", [0.44, 0.04, 0.05], 0.22, 0.0, 0.0),
            part("bar", [0.16, 0.04, 0.05], 0.42, 0.10, FRAC_PI_2),
        ],
    )
}

fn can(x: f64, y: f64) -> Object {
    Object::cylinder("can", 0.04, 0.10).at(x, y, 0.0)
}

fn wall(x: f64, y: f64, size: [f64; 3]) -> Obstacle {
    Obstacle::cuboid("wall", size).at(x, y, 0.0).friction(0.4)
}

fn task(object: Object, goal: [f64; 2]) -> Task {
    let robot = Robot { home: Vector::zeros(), ..Robot::reaching(0.05, 0.9).without_body() };
    Task::new("test", Scene::new([object]), robot, Goal::new(0, goal, 0.03))
}

fn workspace<'a>(task: &'a Task, tools: &'a [Arc<Tool>]) -> Workspace<'a> {
    Workspace { task, tools }
}

fn placed(part: usize, offset: f64, direction: f64) -> CandidatePush {
    CandidatePush {
        tool: 0,
        grip_yaw: 0.0,
        object: 0,
        start: Start::Placed { part, offset },
        direction,
        length: 0.15,
        room: 0.0,
    }
}

fn planar() -> Simulated {
    Simulated::new(Simulator::planar())
}

#[test]
fn a_placed_face_stands_five_millimetres_before_the_object() {
    let tools = [stick(), hook()];
    let mut box_ = can(0.5, 0.12);
    box_.shape = Shape::Cuboid { size: [0.06, 0.09, 0.1] };
    box_.pose.heading = 0.4;
    for object in [can(0.5, 0.12), box_] {
        let task = task(object.clone(), [0.3, 0.1]);
        let space = workspace(&task, &tools);
        let state = task.scene.start();
        let (mut met, mut refused) = (0, 0);
        for (index, tool) in tools.iter().enumerate() {
            for yaw in [0.0, FRAC_PI_2, -FRAC_PI_2, 0.3] {
                for direction in [0.0, PI, FRAC_PI_2, -FRAC_PI_2, 0.7] {
                    for part in 0..tool.parts().len() {
                        for offset in [-0.03, 0.0, 0.02] {
                            let push = CandidatePush {
                                tool: index,
                                grip_yaw: yaw,
                                ..placed(part, offset, direction)
                            };
                            let place = space.place(&state, &push, None);
                            let Ok(Placement { start, .. }) = place else {
                                refused += 1;
                                continue;
                            };
                            met += 1;
                            let frame = tool.pose(Pose { position: start, heading: yaw });
                            let ahead = Vector::new(direction.cos(), direction.sin());
                            let left = Vector::new(-ahead.y, ahead.x);
                            let travel = |part: usize| {
                                travel_to_contact(
                                    (
                                        &tool.parts()[part].footprint(),
                                        &tool.part_pose(part, &frame),
                                    ),
                                    ahead,
                                    (&object.shape.footprint(), &object.pose),
                                )
                            };
                            // The named face makes contact first, after exactly the stand-off.
                            assert!((travel(part).unwrap() - STAND_OFF).abs() < 1e-9);
                            for other in 0..tool.parts().len() {
                                assert!(travel(other).is_none_or(|t| t > STAND_OFF - 1e-8));
                            }
                            // The object's centre is `offset` to the left of the face's centre.
                            let face = tool.part_pose(part, &frame).position;
                            let aside = (object.pose.position - face).dot(&left);
                            assert!((aside - offset).abs() < 1e-12);
                        }
                    }
                }
            }
        }
        assert!(met > 60 && refused > 5, "{met} {refused}");
    }
}

#[test]
fn a_hook_reaches_behind_an_object_and_pulls_it_back() {
    let tools = [hook()];
    let task = task(can(0.60, 0.12), [0.45, 0.12]);
    let space = workspace(&task, &tools);
    let state = task.scene.start();
    // The bar (part 1), pulled towards the robot, is behind the can.
    let start = space.place(&state, &placed(1, 0.0, PI), None).unwrap().start;
    let frame = tools[0].pose(Pose { position: start, heading: 0.0 });
    let bar = tools[0].part_pose(1, &frame);
    assert!((bar.position.x - (0.60 + 0.04 + STAND_OFF + 0.02)).abs() < 1e-9);
    for (k, part) in tools[0].parts().iter().enumerate() {
        let object = (&task.scene.objects[0].shape.footprint(), &state.poses[0]);
        assert!(
            clearance((&part.footprint(), &tools[0].part_pose(k, &frame)), object, 1.0) > 0.001
        );
    }
    // The handle is beside the can: its own leading end cannot meet it while pulling.
    let beside = space.place(&state, &placed(0, 0.12, PI), None);
    assert_eq!(beside.unwrap_err(), Infeasible::NoContact);

    let model = planar();
    let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
    let mut search = Search::new(space, rollouts.situation(), SETTINGS);
    let found = search.deepen(&mut rollouts, &NoProgress);
    let best = &found[0];
    assert!(best.score < 0.3, "{best:?}");
    assert_eq!(best.candidate.pushes[0].direction, PI);
}

#[test]
fn reach_obstacles_and_height_limit_a_push() {
    let tools = [stick()];
    let mut task = task(can(0.6, 0.0), [0.8, 0.0]);
    let pair = (0, 0.0);
    let place = |task: &Task| {
        let space = workspace(task, &tools);
        let push = placed(0, 0.0, 0.0);
        let start = space.place(&task.scene.start(), &push, None)?.start;
        space.free_travel(pair, start, 0.0, 0.3)
    };
    // The rod's tip is 0.45 from the grip, so the grip starts at 0.105.
    assert!((place(&task).unwrap() - 0.3).abs() < 1e-12);
    task.robot.reach_max = 0.305;
    assert!((place(&task).unwrap() - 0.2).abs() < 1e-9);
    task.robot.reach_max = 0.1;
    assert_eq!(place(&task).unwrap_err(), Infeasible::Reach);
    task.robot.reach_max = 0.9;
    // The rod stops 5 mm before a wall.
    task.scene.obstacles = vec![wall(0.75, 0.0, [0.02, 0.4, 0.1])];
    let start_tip = 0.6 - 0.04 - STAND_OFF;
    assert!((place(&task).unwrap() - (0.74 - 0.005 - start_tip)).abs() < 1e-9);
    // A wall lower than the tool's underside does not obstruct.
    task.scene.obstacles[0].size[2] = 0.001;
    assert!((place(&task).unwrap() - 0.3).abs() < 1e-12);
    task.scene.obstacles = vec![wall(0.3, 0.0, [0.02, 0.02, 0.1])];
    assert_eq!(place(&task).unwrap_err(), Infeasible::Obstacle);
    task.pushes.lift = 0.2;
    assert_eq!(place(&task).unwrap_err(), Infeasible::NoContact);
}

#[test]
fn sharing_the_beginnings_of_chained_pushes_finds_what_trying_everything_finds() {
    let tools = [hook()];
    let mut task = task(can(0.30, 0.12), [0.2, 0.25]);
    task.pushes.form = PushForm::Chained;
    task.pushes.max_count = 2;
    task.pushes.grip_yaws = vec![0.0, FRAC_PI_2];
    task.robot.reach_min = 0.0;
    let space = workspace(&task, &tools);
    let model = planar();
    let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
    let mut search = Search::new(space, rollouts.situation(), SETTINGS);
    search.deepen(&mut rollouts, &NoProgress);
    let found = search.deepen(&mut rollouts, &NoProgress);
    assert!(rollouts.used() <= 2 * (4 + 16));

    let headings = task.pushes.directions.headings();
    let mut all = Vec::new();
    for &grip_yaw in &task.pushes.grip_yaws {
        for &first in &headings {
            for &second in &headings {
                for stop in 1..=20 {
                    let push = |direction, length| CandidatePush {
                        tool: 0,
                        grip_yaw,
                        object: 0,
                        start: Start::Chained,
                        direction,
                        length,
                        room: 0.0,
                    };
                    let pushes = vec![push(first, 0.2), push(second, 0.01 * stop as f64)];
                    all.push(Candidate { pushes });
                }
            }
        }
    }
    let results = evaluate(&space, &mut rollouts, &all);
    let feasible = results.into_iter().flatten().filter(|e| e.is_feasible());
    let best = feasible.map(|e| e.score).fold(f64::INFINITY, f64::min);
    // In units of the tolerance of 30 mm: half a millimetre.
    assert!((found[0].score - best).abs() < 0.02, "{} {best}", found[0].score);
    assert!(best < 2.0);
}

#[test]
fn a_search_finds_the_same_for_any_number_of_threads_and_within_its_budget() {
    let tools = [stick(), hook()];
    let mut task = task(can(0.5, 0.05), [0.45, 0.2]);
    task.pushes.max_count = 2;
    task.scene.obstacles = vec![wall(0.52, 0.16, [0.08, 0.02, 0.1])];
    let settings = SearchSettings {
        offsets: 3,
        fine_offsets: false,
        beam: 6,
        rollouts: 40,
        kept: 10,
        kinds: 8,
        model_error: 0.0,
    };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let model = planar();
            let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
            let mut search = Search::new(workspace(&task, &tools), rollouts.situation(), settings);
            let first = search.deepen(&mut rollouts, &NoProgress);
            let second = search.deepen(&mut rollouts, &NoProgress);
            assert!(!search.can_deepen());
            let all = first.into_iter().chain(second);
            let list: Vec<(Candidate, f64)> = all.map(|f| (f.candidate, f.score)).collect();
            (list, search.statistics().clone())
        })
    };
    let (one, three) = (run(1), run(3));
    assert_eq!(one, three);
    let (list, statistics) = one;
    assert!(list.len() <= 20 && statistics.beyond_budget > 0);
    // Two levels of 40, and the six states from which the second began, each with six perturbed.
    assert!(statistics.rollouts <= 40 + 6 * (1 + 6) + 40, "{statistics:?}");
    assert!(statistics.best.windows(2).all(|pair| pair[1].1 < pair[0].1));
    let refused: usize = statistics.infeasible.values().sum();
    assert_eq!(
        statistics.considered,
        refused + statistics.repeated + statistics.beyond_budget + 80
    );
}

#[test]
fn a_level_that_ends_early_has_the_same_best_kinds_and_the_same_next_level() {
    let tools = [stick(), hook()];
    let mut task = task(can(0.5, 0.05), [0.4, 0.15]);
    task.pushes.max_count = 2;
    let run = |kinds: usize| {
        let model = planar();
        let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
        let settings = SearchSettings { kinds, kept: 1000, ..SETTINGS };
        let mut search = Search::new(workspace(&task, &tools), rollouts.situation(), settings);
        let first = search.deepen(&mut rollouts, &NoProgress);
        let used = search.statistics().rollouts;
        let second = search.deepen(&mut rollouts, &NoProgress);
        (first, used, second)
    };
    let (early, whole) = (run(8), run(usize::MAX));
    let best = |found: &[SearchResult]| -> Vec<SearchResult> {
        kinds(found, 8).into_iter().map(|k| found[k].clone()).collect()
    };
    assert_eq!(best(&early.0), best(&whole.0));
    assert!(early.1 < whole.1 && early.0.len() < whole.0.len(), "{} {}", early.1, whole.1);
    assert_eq!(best(&early.2), best(&whole.2));
}

#[test]
fn a_push_stands_off_further_by_the_room_that_it_is_given() {
    let tools = [stick()];
    let task = task(can(0.6, 0.0), [0.8, 0.0]);
    let space = workspace(&task, &tools);
    let start = |room| {
        let push = CandidatePush { room, ..placed(0, 0.0, 0.0) };
        space.place(&task.scene.start(), &push, None).unwrap().start.x
    };
    assert!((start(0.0) - start(0.004) - 0.004).abs() < 1e-12);
}

#[test]
fn refinement_never_makes_a_candidate_worse() {
    let tools = [stick(), hook()];
    let model = planar();
    for (k, goal) in [[0.62, 0.16], [0.45, -0.1], [0.42, 0.1], [0.3, 0.3]].into_iter().enumerate() {
        let mut task = task(can(0.5, 0.05), goal);
        task.goals[0].set_tolerance(0.01);
        if k == 3 {
            task.pushes.form = PushForm::Chained;
            task.pushes.max_count = 2;
            task.robot.reach_min = 0.0;
        }
        let space = workspace(&task, &tools);
        let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
        let mut search = Search::new(space, rollouts.situation(), SETTINGS);
        let mut found = Vec::new();
        while search.can_deepen() {
            found = search.deepen(&mut rollouts, &NoProgress);
        }
        let candidates: Vec<Candidate> =
            found.iter().take(6).map(|f| f.candidate.clone()).collect();
        let settings = RefineSettings { rounds: 3, extra: 2, seed: 1, enough: 6, rollouts: 1000 };
        let mut statistics = RefineStatistics::default();
        let refined =
            refine(&space, &mut rollouts, &candidates, settings, &mut statistics, &NoProgress);
        assert!(!refined.is_empty(), "{goal:?}");
        for one in &refined {
            assert!(one.off[1] <= one.off[0]);
            assert!(one.rounds.windows(2).all(|pair| pair[1] <= pair[0]));
            assert!(one.best.is_feasible());
        }
    }
}
