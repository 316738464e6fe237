//! Models of lever-ups: symmetry, validation of a network's file, and inferred lever points.

use std::sync::Arc;

use pushplan::effect::{LeverInputs, LeverNetwork, LeverPrior};
use pushplan::geometry::{Pose, Pose3, Vector};
use pushplan::network::{LeverCard, LeverWeights, Parameters, Statistics, lever_layout};
use pushplan::progress::NoProgress;
use pushplan::sim::LeverSimulator;
use pushplan::{
    scene::{LeverFeatures, LeverScene},
    task::{LeverJob, Place},
};
use pushplan_lab::bench::{
    LeverBaseline, Setting, convergence, drive_report, lever_report, point_report,
};
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverEpisode, LeverPreset};
use pushplan_learn::lever_model::{LeverModel, SimulatedLevers};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

fn episodes(preset: LeverPreset, seed: u64, count: u64) -> LeverDataset {
    let config = LeverConfig { seed, episodes: count, preset };
    LeverDataset::in_memory(&config, &NoProgress).expect("lever-ups")
}

/// Returns random weights, large enough to matter.
fn random(features: LeverFeatures, prior: bool) -> LeverWeights {
    let sizes = LeverInputs::sizes(features, prior, 12);
    let mut rng = Pcg64::seed_from_u64(9);
    let values = lever_layout(&sizes).into_iter().map(|(name, shape)| {
        let count: usize = shape.iter().product();
        (name.to_owned(), (0..count).map(|_| rng.random_range(-0.2f32..0.2)).collect())
    });
    let parameters = Parameters { values: values.collect() };
    let scales =
        |columns: usize| Statistics { mean: vec![0.1; columns], deviation: vec![1.5; columns] };
    let (still, moving) = (scales(sizes.still), scales(sizes.moving));
    let card = LeverCard { features, prior, sizes, still, moving, episodes: 7, steps: 8 };
    LeverWeights { card, parameters }
}

/// Returns the job mirrored at y = 0.
fn mirrored(job: &LeverJob) -> LeverJob {
    let mut scene = LeverScene::clone(&job.scene);
    let plate = &mut scene.plates[job.lever.plate];
    for slab in &mut plate.slabs {
        slab.corners = slab.corners.iter().rev().map(|at| Vector::new(at.x, -at.y)).collect();
    }
    let at = plate.pose;
    plate.pose = Pose::new(at.position.x, -at.position.y, -at.heading);
    for block in &mut scene.blocks {
        let at = block.pose;
        block.pose = Pose::new(at.position.x, -at.position.y, -at.heading);
    }
    let plate = &scene.plates[job.lever.plate];
    let (count, Place { edge, fraction }) = (plate.corners().len(), job.lever.place);
    let mut lever = job.lever;
    // Corner k is now corner n - 1 - k, and edges run the other way.
    lever.place = Place { edge: (2 * count - 2 - edge) % count, fraction: 1.0 - fraction };
    LeverJob { scene: Arc::new(scene), lever }
}

fn mirrored_pose(pose: &Pose3) -> Pose3 {
    let [x, y, z, w] = pose.quaternion();
    let mut position = pose.position;
    position.y = -position.y;
    Pose3::from_quaternion(position, [-x, y, -z, w])
}

/// Returns the job moved on the table.
fn moved(job: &LeverJob, by: Pose) -> LeverJob {
    let mut scene = LeverScene::clone(&job.scene);
    let pose = &mut scene.plates[job.lever.plate].pose;
    *pose = by * *pose;
    scene.blocks.iter_mut().for_each(|block| block.pose = by * block.pose);
    LeverJob { scene: Arc::new(scene), lever: job.lever }
}

#[test]
fn mirrored_and_moved_lever_ups_have_mirrored_and_moved_predictions() {
    let network = |features, prior| {
        LeverNetwork::new(&random(features, prior)).expect("weights that fit their card")
    };
    let models: [(Box<dyn LeverModel>, f64); 4] = [
        (Box::new(LeverPrior::default()), 1e-6),
        // Features are single precision.
        (Box::new(network(LeverFeatures::Shape, true)), 1e-5),
        (Box::new(network(LeverFeatures::Support, false)), 1e-5),
        (Box::new(network(LeverFeatures::ShapeContext, false)), 1e-5),
    ];
    for (model, most) in &models {
        is_symmetric(&**model, LeverPreset::Varied, *most);
    }
    // Boards in drives rattle, which multiplies roundings: the order of contacts with equal gaps
    // changes.
    is_symmetric(&LeverPrior::default(), LeverPreset::Drive, 1e-4);
}

/// Asserts that mirrored and moved lever-ups of a family have mirrored and moved predictions up to
/// `most` metres.
pub fn is_symmetric(model: &dyn LeverModel, preset: LeverPreset, most: f64) {
    let drawn = episodes(preset, 4, 12);
    let jobs: Vec<LeverJob> = drawn.episodes().iter().map(LeverEpisode::job).collect();
    let by = Pose::new(-0.2, 0.4, 2.5);
    let elsewhere = Pose3::upright(by, 0.0);
    let predicted = model.rollout(&jobs);
    let behind = model.rollout(&jobs.iter().map(mirrored).collect::<Vec<_>>());
    let beside = model.rollout(&jobs.iter().map(|job| moved(job, by)).collect::<Vec<_>>());
    for (k, predicted) in predicted.iter().enumerate() {
        let all = predicted.lift.iter().chain([&predicted.rest]);
        let behind = behind[k].lift.iter().chain([&behind[k].rest]);
        let beside = beside[k].lift.iter().chain([&beside[k].rest]);
        for ((pose, behind), beside) in all.zip(behind).zip(beside) {
            for (wanted, found) in [(mirrored_pose(pose), behind), (elsewhere * *pose, beside)] {
                let apart = (wanted.position - found.position).norm();
                let turned = (wanted.rotation * found.rotation.inverse()).imag().norm();
                assert!(
                    apart < most && turned < 10.0 * most,
                    "{}, {k}: {apart} m, {turned} rad",
                    model.name()
                );
            }
        }
    }
}

#[test]
fn the_prior_knows_the_pocket_of_a_drive_and_its_limits() {
    let drawn = episodes(LeverPreset::Drive, 11, 48);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let (prior, still) = (LeverPrior::default(), LeverBaseline::still());
    let coarse = SimulatedLevers { simulator: LeverSimulator::COARSE };
    let report = drive_report(11, drawn.episodes(), &[&prior, &still, &coarse]);
    let lift: Vec<f64> =
        report.rows.iter().map(|row| row.lift.as_ref().expect("errors").mean).collect();
    // The engine's own steps matter more.
    assert!(lift[0] < 0.02 * lift[1] && lift[0] < 1.5 * lift[2], "{lift:?} m");
    assert!(report.rows[0].outside >= 0.95, "{:?}", report.rows[0]);
    let jobs: Vec<LeverJob> = drawn.episodes().iter().map(LeverEpisode::job).collect();
    assert_eq!(prior.rollout(&jobs), pool.install(|| prior.rollout(&jobs)));

    // The analytic model takes blocks only with plates of cuboids, networks take no blocks at all.
    let trust = |job: &LeverJob, model: &dyn LeverModel| model.takes(job);
    assert!(trust(&jobs[0], &prior));
    assert!(!trust(&jobs[0], &LeverNetwork::shipped().expect("sound weights")));
    let mut scene = LeverScene::clone(&jobs[0].scene);
    scene.plates[0].slabs[0].corners[0].x -= 0.01;
    assert!(!trust(&LeverJob { scene: Arc::new(scene), lever: jobs[0].lever }, &prior));
}

#[test]
fn a_networks_file_is_read_back_and_a_damaged_one_refused() {
    let weights = random(LeverFeatures::Shape, true);
    let bytes = weights.to_bytes().expect("bytes");
    assert_eq!(LeverWeights::from_bytes(&bytes).expect("weights"), weights);
    // Damage at several places: the header's length, the card, a weight.
    for at in [0, 40, bytes.len() / 2, bytes.len() - 2] {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x10;
        assert!(LeverWeights::from_bytes(&damaged).is_err(), "byte {at}");
    }
    assert!(LeverWeights::from_bytes(&bytes[..bytes.len() - 4]).is_err());

    // Valid weights whose card names other features.
    let card = LeverCard { features: LeverFeatures::Corners, ..weights.card.clone() };
    assert!(LeverNetwork::new(&LeverWeights { card, ..weights }).is_err());
}

/// Uses other lever-ups than the published results.
#[test]
fn the_shipped_network_is_small_and_better_than_what_it_corrects_and_than_the_prior() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../models/lever.safetensors");
    assert!(std::fs::metadata(file).expect("a file").len() < 150_000);
    let network = LeverNetwork::shipped().expect("sound weights");
    for preset in [LeverPreset::Fixed, LeverPreset::Varied] {
        let drawn = episodes(preset, 12, 240);
        let models: [&dyn LeverModel; 3] = [&network, &LeverNetwork::PRIOR, &LeverPrior::default()];
        let report = lever_report((preset, 12), drawn.episodes(), &models);
        let lift: Vec<f64> =
            report.rows.iter().map(|row| row.lift.as_ref().expect("errors").mean).collect();
        assert!(lift[0] < 0.95 * lift[1] && lift[0] < 0.95 * lift[2], "{preset}: {lift:?} m");
    }
}

#[test]
fn the_prior_is_better_than_nothing_and_the_lever_point_is_found() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let drawn = episodes(LeverPreset::Board, 6, 20);
    let prior = LeverPrior::default();
    let report = lever_report((LeverPreset::Board, 6), drawn.episodes(), &[&prior]);
    let lift = report.rows[0].lift.as_ref().expect("errors").mean;
    assert!(lift < 0.1 * report.motion, "{lift} of {} m", report.motion);

    let points = point_report((LeverPreset::Board, 6), drawn.episodes(), &prior);
    let again = pool.install(|| point_report((LeverPreset::Board, 6), drawn.episodes(), &prior));
    assert_eq!(points, again);

    // A disc has a hundred corners, each of which may touch, so a few cases are enough.
    let drawn = episodes(LeverPreset::Disc, 6, 2);
    let points = point_report((LeverPreset::Disc, 6), drawn.episodes(), &prior);
    for (seen, most) in [(1, 10.0_f64), (3, 4.0), (7, 2.0)] {
        let row = &points.rows[seen - 1];
        assert_eq!(row.seen, seen);
        let angle = row.angle.as_ref().expect("angles").mean.to_degrees();
        assert!(angle < most, "{seen} frames: {angle} degrees");
    }
}

#[test]
fn finer_steps_and_another_start_change_little() {
    for preset in [LeverPreset::Fixed, LeverPreset::Varied, LeverPreset::Drive] {
        let report = convergence(preset, 3, 12);
        let mean = |wanted: Setting| {
            let row = report.rows.iter().find(|row| row.setting == wanted).expect("a row");
            1e3 * row.lift.as_ref().expect("errors").mean
        };
        let (steps, aside) = (mean(Setting::Steps(240)), mean(Setting::Aside));
        assert!(steps <= 0.8, "{preset}: 1/240 s is off by {steps:.2} mm");
        assert!(aside <= 0.6, "{preset}: 0.1 mm aside gives {aside:.2} mm");
        assert_eq!(report.jammed, 0, "{preset}");
    }
}
