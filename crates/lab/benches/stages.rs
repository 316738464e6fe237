//! Times of every stage, one thread each: `cargo bench -p pushplan-lab --bench stages`. The numbers
//! are explained in `crates/lab/benches/README.md`.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use pushplan::asset::ToolLibrary;
use pushplan::contact::{Bodies, Frame, FrameProblem, FrameSolver};
use pushplan::effect::{EffectModel, EffectModels, Network, Prior, Simulated};
use pushplan::graph::{Batch, Corrections};
use pushplan::network::{Buffers, Forward};
use pushplan::plan::{
    QpProblem, QpSolver, RefineSettings, RefineStatistics, Rollouts, Search, SearchSettings,
    Workspace, refine,
};
use pushplan::progress::NoProgress;
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{ModelKind, Physics, Situation, State},
    task::{FrameStep, Job, Task},
};
use pushplan_lab::bench::{Case, Suite, SuiteKind, crowd_cases, random_task};

/// Number of candidates that a search predicts together.
const BATCH: usize = 64;

/// Seed of scenes and pushes, as in the published numbers.
const SEED: u64 = 7;

/// A frame with an object near the tool: bodies, state, step and axis.
type Near = (Bodies, State, FrameStep, pushplan::geometry::Vector);

fn library() -> ToolLibrary {
    ToolLibrary::embedded().expect("the shipped tools are sound")
}

/// Returns one object or three that touch and a shipped tool, or ten objects and the hand.
fn cases() -> [(&'static str, Vec<Case>); 3] {
    let single = Suite::draw(SuiteKind::Single, &library(), SEED, 11).cases;
    let mut touching = Suite::draw(SuiteKind::Touching, &library(), SEED, 22).cases;
    touching.retain(|case| case.scene.objects.len() == 3);
    [("one object", single), ("three objects", touching), ("ten objects", crowd_cases(10, SEED, 6))]
}

/// Returns the frames of the cases that have a graph, from trajectories of the 2-D engine.
fn frames(cases: &[Case]) -> Vec<Near> {
    let mut solver = FrameSolver::default();
    let mut near = Vec::new();
    for Case { scene, motion } in cases {
        let bodies = Bodies::new(scene, &motion.tool, motion.lift, &Physics::stated(scene));
        let truth =
            Simulator::planar().run(scene, &Job::stated(scene, motion.clone()), Record::Frames);
        let stroke = &motion.strokes[0];
        let axis = (stroke.to.position - stroke.from.position).normalize();
        for index in 0..stroke.frames().min(truth.frames.len()) {
            let (state, step) = (truth.frames[index].state.clone(), stroke.frame(index));
            let problem = FrameProblem { bodies: &bodies, state: &state, step: &step, axis };
            if !solver.solve(problem).motions.is_empty() {
                near.push((bodies.clone(), state, step, axis));
            }
        }
    }
    near
}

fn fill(solver: &mut FrameSolver, batch: &mut Batch, frames: &[Near]) {
    batch.clear();
    for (k, (bodies, state, step, axis)) in frames.iter().cycle().take(BATCH).enumerate() {
        let (frame, forces) =
            solver.solve_with_forces(FrameProblem { bodies, state, step, axis: *axis });
        batch.add(k as u32, &frame, &forces);
    }
}

/// Motions of all bodies in a frame, without forces and features: one after another, and with a
/// single object side by side as in a search.
fn frame(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("64 frames");
    group.throughput(Throughput::Elements(BATCH as u64));
    for (name, cases) in cases() {
        let (mut solver, frames) = (FrameSolver::default(), frames(&cases));
        group.bench_function(name, |b| {
            b.iter(|| {
                for (bodies, state, step, axis) in black_box(&frames).iter().cycle().take(BATCH) {
                    black_box(solver.solve(FrameProblem { bodies, state, step, axis: *axis }));
                }
            });
        });
        let problems: Vec<_> = (frames.iter().cycle().take(BATCH))
            .map(|(bodies, state, step, axis)| {
                Some(FrameProblem { bodies, state, step, axis: *axis })
            })
            .collect();
        let mut memory = vec![Frame::default(); BATCH];
        group.bench_function(format!("{name}, side by side"), |b| {
            b.iter(|| {
                solver.begin(black_box(&problems), &mut memory);
                for (problem, frame) in problems.iter().flatten().zip(&mut memory) {
                    black_box(solver.finish(*problem, frame, 0));
                }
            });
        });
    }
    group.finish();
}

/// Contacts, analytic model and features; then the network on the batch.
fn graph_and_network(criterion: &mut Criterion) {
    let forward = Forward::new(&EffectModels::weights().expect("the shipped weights are sound"));
    let mut group = criterion.benchmark_group("graph of 64 candidate-steps");
    group.throughput(Throughput::Elements(BATCH as u64));
    for (name, cases) in cases() {
        let frames = frames(&cases);
        let (mut solver, mut batch) = (FrameSolver::default(), Batch::default());
        group.bench_function(name, |b| {
            b.iter(|| fill(&mut solver, &mut batch, black_box(&frames)));
        });
    }
    group.finish();
    let mut group = criterion.benchmark_group("network on 64 candidate-steps");
    group.throughput(Throughput::Elements(BATCH as u64));
    for (name, cases) in cases() {
        let mut batch = Batch::default();
        fill(&mut FrameSolver::default(), &mut batch, &frames(&cases));
        let (mut buffers, mut corrections) = (Buffers::default(), Corrections::default());
        group.bench_function(name, |b| {
            b.iter(|| forward.run(black_box(&batch), &mut buffers, &mut corrections));
        });
    }
    group.finish();
}

/// Whole pushes: a batch of the network and of its analytic model, one at a time in the engines.
fn rollouts(criterion: &mut Criterion) {
    let weights = EffectModels::weights().expect("the shipped weights are sound");
    let models: [(Box<dyn EffectModel>, usize); 4] = [
        (Box::new(Network::new(weights)), BATCH),
        (Box::new(Prior::default()), BATCH),
        (Box::new(Simulated::new(Simulator::planar())), 1),
        (Box::new(Simulated::new(Simulator::spatial())), 1),
    ];
    for (name, cases) in cases() {
        let mut group = criterion.benchmark_group(format!("a push on {name}"));
        for (model, batch) in &models {
            group.throughput(Throughput::Elements((cases.len() * batch) as u64));
            let work: Vec<(&Case, Vec<Job>)> = cases
                .iter()
                .map(|case| {
                    let motion = case.motion.clone();
                    let job = Job::stated(&case.scene, motion);
                    (case, vec![job; *batch])
                })
                .collect();
            group.bench_function(format!("{}, {batch} at a time", model.spec()), |b| {
                b.iter(|| {
                    for (case, jobs) in &work {
                        black_box(model.rollout(&case.scene, jobs, Record::Outcome));
                    }
                });
            });
        }
        group.finish();
    }
}

/// The search of 500 one-push candidates, and the refinement of the eight best.
fn planning(criterion: &mut Criterion) {
    let model =
        EffectModels::build(&ModelKind::NETWORK.into()).expect("the shipped weights are sound");
    let library = library();
    let task: Task = random_task(&library, SEED, 0);
    let tools = task.tools(&library).expect("its tools are shipped");
    let workspace = Workspace { task: &task, tools: &tools };
    let settings = SearchSettings {
        offsets: 5,
        fine_offsets: false,
        beam: 1,
        rollouts: 500,
        kept: 8,
        kinds: 8,
        model_error: 0.0,
    };
    let search = || {
        let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
        Search::new(workspace, rollouts.situation(), settings).deepen(&mut rollouts, &NoProgress)
    };
    criterion.bench_function("search of 500 pushes", |b| b.iter(search));

    let best: Vec<_> = search().into_iter().map(|found| found.candidate).collect();
    let settings = RefineSettings {
        rounds: 4,
        extra: 2,
        seed: SEED,
        enough: best.len(),
        rollouts: usize::MAX,
    };
    criterion.bench_function("refinement of 8 pushes", |b| {
        b.iter(|| {
            let mut rollouts = Rollouts::new(&model, Situation::stated(&task.scene));
            let mut statistics = RefineStatistics::default();
            refine(&workspace, &mut rollouts, &best, settings, &mut statistics, &NoProgress)
        });
    });
}

/// A quadratic programme of the size for a push, by a reused solver.
fn programme(criterion: &mut Criterion) {
    let n = 3;
    let unit = |i: usize, sign: f64| (0..n).map(|j| if i == j { sign } else { 0.0 }).collect();
    let rows: Vec<Vec<f64>> = (0..n).flat_map(|i| [unit(i, 1.0), unit(i, -1.0)]).collect();
    let problem = QpProblem {
        p: vec![vec![2.0, 0.5, 0.1], vec![0.5, 1.0, 0.2], vec![0.1, 0.2, 0.5]],
        q: vec![-1.0, 3.0, 0.3],
        b: vec![2.0; rows.len()],
        a: rows,
    };
    let mut solver = QpSolver::default();
    criterion.bench_function("quadratic programme of one push", |b| {
        b.iter_batched(|| problem.clone(), |problem| solver.solve(&problem), BatchSize::SmallInput);
    });
}

/// Uses one thread, so that numbers of different machines and days are comparable, and seconds per
/// stage, so that all finish within a minute.
fn settings() -> Criterion {
    // If the pool existed already, its threads would only make the numbers worse.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
}

criterion_group! {
    name = stages;
    config = settings();
    targets = frame, graph_and_network, rollouts, planning, programme
}
criterion_main!(stages);
