//! Pruning of unreachable bodies and skipping of contact-free frames leave all predictions
//! bit-identical.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use pushplan::progress::NoProgress;
use pushplan::{
    effect::EffectModels,
    geometry::{Pose, Shape, Vector},
    graph::{Batch, Correction, Corrections},
    network::{Buffers, Forward, PredictorWeights},
    outcome::Record,
    rollout::{Corrector, RollSettings, Roller, Work},
    scene::{ModelKind, Object, Obstacle, Part, Physics, Scene, Tool, Velocity},
    task::{Job, Stroke, ToolMotion},
};
use pushplan_learn::dataset::{Dataset, DatasetConfig, Preset};

/// Rolls out with and without pruning and requires bit-identical trajectories.
///
/// Jobs run one at a time: in a batch, a matrix product rounds a row depending on the other rows,
/// which change with the skipped frames.
fn compare(forward: &Forward, scene: &Scene, job: &Job, stride: usize) -> (Work, Work) {
    let run = |pruned, record| {
        let settings = RollSettings { stride, pruned, ..RollSettings::default() };
        let mut roller = Roller::new(ModelKind::NETWORK.into(), settings);
        let mut buffers = Buffers::default();
        let rolled = roller.roll(
            scene,
            std::slice::from_ref(job),
            record,
            Some(&mut |batch, corrections| {
                forward.run(batch, &mut buffers, corrections);
            }),
        );
        (rolled, *roller.work())
    };
    let (pruned, work) = run(true, Record::Frames);
    let (whole, all) = run(false, Record::Frames);
    assert_eq!(pruned[0].frames.len(), whole[0].frames.len());
    for (k, (p, q)) in pruned[0].frames.iter().zip(&whole[0].frames).enumerate() {
        assert_eq!(p, q, "frame {k}");
    }
    assert_eq!(pruned, whole);
    let (ends, _) = run(true, Record::Outcome);
    assert_eq!(ends[0].outcome(), pruned[0].outcome());
    assert_eq!((work.graphs, work.nodes, work.relations), (all.graphs, all.nodes, all.relations));
    assert_eq!(work.moving, all.moving);
    (work, all)
}

fn shipped() -> PredictorWeights {
    EffectModels::weights().expect("the shipped weights")
}

/// Returns weights with excessive corrections, because the test must not depend on a good network.
fn wild() -> PredictorWeights {
    let mut weights = shipped();
    for name in ["motion.even", "motion.odd"] {
        let values = weights.parameters.values.get_mut(name).expect("the last layer");
        values.iter_mut().for_each(|value| *value *= 5.0);
    }
    weights
}

#[test]
fn crowds_pushed_again_and_again() {
    for (preset, seed) in [(Preset::Sparse, 5), (Preset::Dense, 6), (Preset::Tools, 7)] {
        let config = DatasetConfig { seed, preset, episodes: 12, ..DatasetConfig::default() };
        let data = Dataset::in_memory(&config, &NoProgress).expect("data");
        for weights in [shipped(), wild()] {
            let forward = Forward::new(&weights);
            for episode in data.episodes() {
                let scene = &episode.scene;
                // One job begins at the start and one during the motion.
                let middle = &episode.frames[episode.frames.len() / 3];
                for frame in [&episode.frames[0], middle] {
                    let job = Job {
                        start: frame.state.clone(),
                        ..Job::stated(scene, episode.motion.clone())
                    };
                    compare(&forward, scene, &job, 1);
                }
            }
        }
    }
}

/// Returns a table with a few objects near the tool's path, some touching, jointed or moving, and
/// others far away. Some tools have overhanging parts.
fn random_job(rng: &mut Pcg64) -> (Scene, Job) {
    let mut objects: Vec<Object> = Vec::new();
    let mut scene = Scene::new([]).on_table(rng.random_range(0.2..0.8));
    while objects.len() < 9 {
        let spread = if objects.len() < 6 { 0.45 } else { 1.5 };
        let cylinder = rng.random_bool(0.5);
        let (a, b): (f64, f64) = (rng.random_range(0.02..0.05), rng.random_range(0.02..0.05));
        let shape = if cylinder {
            Shape::Cylinder { radius: a, height: 0.1 }
        } else {
            Shape::Cuboid { size: [2.0 * a, 2.0 * b, rng.random_range(0.03..0.1)] }
        };
        let radius = shape.footprint().bounding_radius();
        let pose = Pose::new(
            rng.random_range(-spread..spread),
            rng.random_range(-spread..spread),
            rng.random_range(-3.0..3.0),
        );
        let free = objects.iter().all(|other| {
            let apart = (other.pose.position - pose.position).norm();
            apart > other.shape.footprint().bounding_radius() + radius
        });
        if free {
            let name = format!("o{}", objects.len());
            let (mass, friction) = (rng.random_range(0.1..1.0), rng.random_range(0.1..0.8));
            objects.push(Object { mass, friction, pose, ..Object::new(name, shape) });
        }
    }
    scene.objects = objects;
    if rng.random_bool(0.5) {
        // Nearly touching objects are joined, and a large tolerance yields chains.
        scene.joints = Physics::stated(&scene).with_contacts_fixed(&scene).joints;
        let kinds = [
            pushplan::scene::JointKind::Fixed,
            pushplan::scene::JointKind::Prismatic { axis: Vector::y(), limits: None },
        ];
        for between in [[0, 1], [1, 2], [6, 7]] {
            let middle = 0.5
                * (scene.objects[between[0]].pose.position
                    + scene.objects[between[1]].pose.position);
            let kind = match rng.random_range(0..3) {
                2 => pushplan::scene::JointKind::Revolute { at: middle, limits: None },
                other => kinds[other],
            };
            scene.joints.retain(|joint| joint.between != between);
            scene.joints.push(pushplan::scene::Joint::new(between, kind));
        }
    }
    for k in 0..rng.random_range(0..3) {
        scene.obstacles.push(Obstacle {
            name: format!("w{k}"),
            size: [0.02, 0.4, 0.1],
            pose: Pose::new(
                rng.random_range(-0.6..0.6),
                rng.random_range(-0.6..0.6),
                rng.random_range(-3.0..3.0),
            ),
            z: 0.0,
            friction: 0.4,
        });
    }
    let parts = vec![
        Part::cuboid("bar", [0.04, 0.16, 0.05], Pose::default()),
        Part::cuboid("side", [0.06, 0.03, 0.05], Pose::new(0.05, -0.065, 0.0)),
        Part::cuboid("handle", [0.3, 0.03, 0.05], Pose::new(-0.17, 0.0, 0.0)),
    ];
    let tool = Arc::new(Tool::new("t", parts).expect("one piece").friction(0.6));
    let placed = rng.random_bool(0.5);
    let yaw = if rng.random_bool(0.5) { 0.0 } else { rng.random_range(-3.0..3.0) };
    let mut from = Pose::new(rng.random_range(-0.5..0.5), rng.random_range(-0.5..0.5), yaw);
    let mut strokes = Vec::new();
    for k in 0..3 {
        let (direction, length): (f64, f64) =
            (rng.random_range(-3.0..3.0), rng.random_range(0.05..0.4));
        let turn = if rng.random_bool(0.15) { 0.5 } else { 0.0 };
        let to = from.position + length * Vector::new(direction.cos(), direction.sin());
        let to = Pose { position: to, heading: from.heading + turn };
        let speed = rng.random_range(0.03..0.6);
        strokes.push(Stroke { from, to, duration: length / speed, settle: placed || k == 2 });
        from = if placed {
            Pose::new(rng.random_range(-0.5..0.5), rng.random_range(-0.5..0.5), yaw)
        } else {
            to
        };
    }
    let lift = if rng.random_bool(0.3) { 0.06 } else { 0.002 };
    let mut start = scene.start();
    if rng.random_bool(0.4) {
        for velocity in start.velocities.iter_mut().skip(rng.random_range(0..8)).take(2) {
            let linear = Vector::new(rng.random_range(-0.6..0.6), rng.random_range(-0.6..0.6));
            *velocity = Velocity { linear, angular: rng.random_range(-4.0..4.0) };
        }
    }
    let job = Job { start, ..Job::stated(&scene, ToolMotion { tool, lift, strokes }) };
    (scene, job)
}

#[test]
fn random_tables_chained_and_placed_jointed_and_moving() {
    let mut rng = Pcg64::seed_from_u64(3);
    let networks = [shipped(), wild()].map(|weights| Forward::new(&weights));
    let (mut some, mut every) = (Work::default(), Work::default());
    for round in 0..300 {
        let (scene, job) = random_job(&mut rng);
        let (work, all) = compare(&networks[round % 2], &scene, &job, 1 + round % 3);
        some.add(&work);
        every.add(&all);
    }
    // A substantial part must have been left out, otherwise the test is meaningless.
    assert!(some.skipped * 4 > some.moving, "{some:?}");
    assert!(some.listed * 3 < some.lists * 9 * 2, "{some:?}");
    assert!(some.graphs > 3000 && every.skipped == 0, "{some:?} {every:?}");
}

#[test]
fn every_job_of_a_batch_has_its_own_tool_and_physics() {
    let mut rng = Pcg64::seed_from_u64(8);
    let (mut tools, mut physics) = (0, 0);
    for _ in 0..20 {
        let (scene, plain) = random_job(&mut rng);
        let mut slippery = plain.clone();
        let frictions = &mut Arc::make_mut(&mut slippery.physics).frictions;
        frictions.iter_mut().for_each(|friction| *friction *= 0.3);
        let tool = Tool::clone(&plain.motion.slide().tool);
        let handle = tool.parts()[0].clone();
        let tool = tool.with_parts([handle]).expect("one piece");
        let mut short = plain.clone();
        short.motion.slide_mut().tool = Arc::new(tool);
        let jobs = [plain.clone(), short, slippery.clone(), plain, slippery];
        let roll = |jobs: &[Job]| {
            Roller::new(ModelKind::PRIOR.into(), RollSettings::default()).roll(
                &scene,
                jobs,
                Record::Frames,
                None,
            )
        };
        // Without a network, batching does not affect rounding.
        let together = roll(&jobs);
        for (job, trajectory) in jobs.iter().zip(&together) {
            assert_eq!(&roll(std::slice::from_ref(job))[0], trajectory);
        }
        tools += usize::from(together[0] != together[1]);
        physics += usize::from(together[0] != together[2]);
    }
    assert!(tools > 3 && physics > 3, "{tools} {physics}");
}

/// Tests candidates of a search, for which frames of one object are solved together.
#[test]
fn candidates_end_alike_in_any_order_and_number() {
    let mut rng = Pcg64::seed_from_u64(10);
    let mut moved = 0;
    for _ in 0..20 {
        let (mut scene, plain) = random_job(&mut rng);
        scene.objects.truncate(1);
        scene.joints.clear();
        let middle = scene.objects[0].pose.position;
        let candidates = (0..13).map(|_| {
            let mut motion = plain.motion.slide().clone();
            let reach = scene.objects[0].shape.footprint().bounding_radius() + 0.1;
            let way = Pose::new(0.0, 0.0, rng.random_range(-3.1..3.1)).vector(Vector::x());
            let aside =
                0.03 * Vector::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
            let heading = rng.random_range(-3.1..3.1);
            let at = |travel: f64| Pose { position: middle + aside + travel * way, heading };
            let settle = true;
            motion.strokes = vec![Stroke { from: at(-reach), to: at(0.03), duration: 1.0, settle }];
            Job::stated(&scene, motion)
        });
        let jobs: Vec<Job> = candidates.collect();
        let roll = |jobs: &[Job]| {
            let mut roller = Roller::new(ModelKind::PRIOR.into(), RollSettings::default());
            let rolled = roller.roll(&scene, jobs, Record::Frames, None);
            (rolled, *roller.work(), roller.tally())
        };
        let (together, work, tally) = roll(&jobs);
        for few in 1..6 {
            let apart: Vec<_> = jobs.chunks(few).flat_map(|jobs| roll(jobs).0).collect();
            assert_eq!(apart, together, "{few} at a time");
        }
        let backwards: Vec<Job> = jobs.iter().rev().cloned().collect();
        let (mut turned, same_work, same_tally) = roll(&backwards);
        turned.reverse();
        assert_eq!((turned, same_work, same_tally), (together.clone(), work, tally));
        let ends = |k: usize| together[k].frames.last().expect("an end").state.poses[0];
        moved += (0..13).filter(|&k| ends(k) != scene.objects[0].pose).count();
    }
    assert!(moved > 100, "{moved}");
}

#[test]
fn a_rollout_without_a_network_is_that_of_one_that_corrects_nothing() {
    let mut rng = Pcg64::seed_from_u64(9);
    let mut contacts = 0;
    for _ in 0..20 {
        let (scene, job) = random_job(&mut rng);
        let jobs = std::slice::from_ref(&job);
        let nothing = &mut |batch: &Batch, corrections: &mut Corrections| {
            corrections.nodes.resize(batch.node_count(), Correction::default());
        };
        let roll = |correct: Option<&mut Corrector<'_>>| {
            Roller::new(ModelKind::PRIOR.into(), RollSettings::default())
                .roll(&scene, jobs, Record::Frames, correct)
                .remove(0)
        };
        let (without, with) = (roll(None), roll(Some(nothing)));
        assert_eq!(without.contacts, with.contacts);
        contacts += with.contacts.len();
        assert_eq!(without.frames, with.frames);
    }
    assert!(contacts > 20, "{contacts}");
}
