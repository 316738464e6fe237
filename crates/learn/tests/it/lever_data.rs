//! Generated lever-ups: ranges, validity of every draw, and bits that depend only on the seed.

use std::fs;

use pushplan::progress::NoProgress;
use pushplan::{outcome::LeverWarning, task::LeverJob};
use pushplan_bench::store::Shard;
use pushplan_learn::dataset::{
    Dataset, DatasetConfig, DatasetError, LEVERS_PER_SHAPE, LeverConfig, LeverDataset,
    LeverEpisode, LeverPreset, generate, lever_job,
};

use crate::program;
use crate::until::Until;

const FAMILIES: [LeverPreset; 6] = [
    LeverPreset::Fixed,
    LeverPreset::Varied,
    LeverPreset::Disc,
    LeverPreset::Board,
    LeverPreset::Drive,
    LeverPreset::Lying,
];

fn config(preset: LeverPreset, episodes: u64) -> LeverConfig {
    LeverConfig { seed: 5, episodes, preset }
}

/// Blocks of a drive have different heights, which a former binary form omitted.
#[test]
fn data_read_equal_the_drawn_data() {
    for preset in FAMILIES {
        let config = config(preset, 8);
        let folder = tempfile::tempdir().expect("a folder");
        generate(&config, Shard::WHOLE, folder.path(), &NoProgress).expect("data");
        let drawn = LeverDataset::in_memory(&config, &NoProgress).expect("lever-ups");
        assert!(LeverDataset::open(folder.path()).expect("data") == drawn, "{preset}");
    }
}

#[test]
fn any_number_of_threads_and_interruptions_gives_the_same_bits() {
    let config = config(LeverPreset::Varied, 300);
    let folder = tempfile::tempdir().expect("a folder");
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    let pool =
        |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool(2).install(|| generate(&config, Shard::WHOLE, &whole, &NoProgress)).expect("data");
    let stopped = pool(1).install(|| generate(&config, Shard::WHOLE, &parts, &Until::new(280)));
    assert!(matches!(stopped, Err(DatasetError::Cancelled)), "{stopped:?}");
    assert!(matches!(LeverDataset::open(&parts), Err(DatasetError::Store(_))));
    pool(1).install(|| generate(&config, Shard::WHOLE, &parts, &NoProgress)).expect("data");
    for file in ["manifest.json", "records.bin"] {
        let [whole, parts] = [&whole, &parts].map(|dir| fs::read(dir.join(file)).expect("a file"));
        assert!(whole == parts, "{file}");
    }
    let read = LeverDataset::open(&whole).expect("data");
    for index in [0, 131, 299] {
        assert_eq!(read.episodes()[index], LeverEpisode::draw(&config, index as u64));
    }
    // Another kind of data is rejected.
    assert!(matches!(Dataset::open(&whole), Err(DatasetError::Foreign { .. })));
    let pushes = DatasetConfig { episodes: 300, seed: 5, ..DatasetConfig::default() };
    assert!(generate(&pushes, Shard::WHOLE, &whole, &NoProgress).is_err());
}

#[test]
fn nothing_asked_for_is_an_error() {
    let config = config(LeverPreset::Fixed, 0);
    assert!(matches!(LeverDataset::in_memory(&config, &NoProgress), Err(DatasetError::Empty(_))));
}

#[test]
fn every_family_plays_without_jams_and_almost_always_comes_to_rest() {
    for preset in FAMILIES {
        let count = if preset == LeverPreset::Disc { 8 } else { 40 };
        let config = config(preset, count);
        let data = LeverDataset::in_memory(&config, &NoProgress).expect("data");
        // A board on the wall of its drive may creep beyond the time limit.
        let restless = data.episodes().iter().filter(|episode| !episode.is_sound()).count();
        assert!(restless <= data.episodes().len() / 20, "{preset}: {restless} never rest");
        for episode in data.episodes() {
            let name = format!("{preset}, episode {}", episode.index);
            let warnings = &episode.trajectory.warnings;
            assert!(!warnings.contains(&LeverWarning::Jammed), "{name}: {warnings:?}");
            let held = &episode.trajectory.held;
            // Under round objects the blade moves some way before contact.
            let soon = if preset == LeverPreset::Lying { held.len() } else { 1 };
            assert!(held[..soon].contains(&true), "{name}: not on the blade at first: {held:?}");
            let rest = episode.trajectory.rest;
            assert!(rest.is_finite() && rest.position.z > -0.001, "{name}: {rest:?}");
            let away = rest.position - episode.scene.plates[0].start().position;
            assert!(away.norm() < 0.6, "{name}: flew {:.2} m", away.norm());
        }
    }
}

#[test]
fn seeds_share_no_shape_and_neighbours_share_theirs() {
    let outline = |seed: u64, index: u64, preset: LeverPreset| {
        let job = lever_job(&LeverConfig { seed, episodes: 1000, preset }, index);
        // Sizes are compared because coordinates are relative to the centre of mass.
        let slabs = &job.scene.plates[0].slabs;
        let size = |slab: &pushplan::scene::Slab| [slab.volume(), slab.height, slab.bottom];
        slabs.iter().map(size).collect::<Vec<_>>()
    };
    for preset in [LeverPreset::Fixed, LeverPreset::Varied, LeverPreset::Drive, LeverPreset::Lying]
    {
        let shapes = |seed: u64| -> Vec<_> {
            (0..40).map(|k| outline(seed, k * LEVERS_PER_SHAPE, preset)).collect()
        };
        let (trained, tested) = (shapes(1), shapes(2));
        for (k, shape) in trained.iter().enumerate() {
            assert!(!tested.contains(shape), "{preset}");
            assert!(!trained[..k].contains(shape), "{preset}: {k}");
            for beside in 1..LEVERS_PER_SHAPE {
                let index = k as u64 * LEVERS_PER_SHAPE + beside;
                assert_eq!(&outline(1, index, preset), shape, "{preset}");
            }
        }
    }
}

#[test]
fn polygons_are_those_of_the_thesis() {
    let mut counts = [0; 11];
    for index in 0..320 {
        let LeverJob { scene, lever } = lever_job(&config(LeverPreset::Fixed, 320), index);
        let corners = scene.plates[0].corners();
        counts[corners.len()] += 1;
        let (from, to) =
            (corners[lever.place.edge], corners[(lever.place.edge + 1) % corners.len()]);
        let along = (to - from).norm() * lever.place.fraction;
        assert!(along > 0.0119 && (to - from).norm() - along > 0.0119, "episode {index}");
        // The circle through any three corners has the stated radius.
        let [a, b, c] = [0, 1, 2].map(|k| corners[k]);
        let area = 0.5 * ((b - a).x * (c - a).y - (b - a).y * (c - a).x);
        let radius = (b - a).norm() * (c - b).norm() * (a - c).norm() / (4.0 * area);
        assert!((radius - 0.1).abs() < 1e-9, "episode {index}: {radius}");
    }
    assert_eq!(counts[3..], [40; 8]);
}

#[test]
fn drives_are_a_floor_four_walls_with_a_notch_and_standoffs_around_a_board() {
    for index in 0..200 {
        let LeverJob { scene, lever } = lever_job(&config(LeverPreset::Drive, 200), index);
        assert_eq!(scene.blocks.len(), 10);
        let board = &scene.plates[0];
        assert!((3..=5).contains(&board.slabs.len()), "{} slabs", board.slabs.len());
        assert!(!board.has_feet() && scene.blade.thickness < board.clearance);
        // The blade lies in the notch from the start until it has rotated.
        let blade = lever.blade(&scene, 0.0);
        for block in &scene.blocks {
            let local = |side: f64, along: f64| {
                let corner = pushplan::geometry::Vector3::new(
                    0.5 * along * scene.blade.length,
                    0.5 * side * scene.blade.width,
                    -0.5 * scene.blade.thickness,
                );
                let point = blade.point(corner);
                let seen = pushplan::geometry::Vector::new(point.x, point.y);
                (block.pose.local_point(seen), point.z - block.z)
            };
            for k in 0..=24 {
                for side in [-1.0, 0.0, 1.0] {
                    let (at, up) = local(side, f64::from(k) / 12.0 - 1.0);
                    let [x, y, z] = block.size;
                    let inside = at.x.abs() < 0.5 * x
                        && at.y.abs() < 0.5 * y
                        && (1e-6..z - 1e-6).contains(&up);
                    assert!(!inside, "episode {index}: the blade is in {}", block.name);
                }
            }
        }
    }
}

#[test]
fn boxes_and_cylinders_look_alike_from_above() {
    let mut kinds = [0, 0];
    for shape in 0..60 {
        let job = lever_job(&config(LeverPreset::Lying, 400), shape * LEVERS_PER_SHAPE);
        let plate = &job.scene.plates[0];
        kinds[usize::from(plate.slabs.len() > 1)] += 1;
        let width = |corners: &[pushplan::geometry::Vector]| {
            corners.iter().map(|corner| corner.y).fold(0.0, f64::max)
        };
        let widest = width(plate.corners());
        assert!(plate.slabs.iter().all(|slab| width(&slab.corners) <= widest + 1e-12));
        assert!((plate.z - 0.006).abs() < 1e-12 && plate.has_feet() == (plate.slabs.len() == 1));
    }
    assert!(kinds[0] > 15 && kinds[1] > 15, "{kinds:?}");
}

/// Tests the export to MuJoCo: a scene of every lever-up, the script that plays them, and our
/// results.
#[test]
fn lever_ups_are_written_as_scenes_with_what_comes_of_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let generate = |preset: &str| {
        let fixed = "generate scenes --episodes 3 --seed 5 --format mjcf --preset";
        let mut command = program::command(&fixed.split(' ').chain([preset]).collect::<Vec<_>>());
        command.current_dir(folder.path()).output().expect("the command runs")
    };
    assert_eq!(generate("dense").status.code(), Some(2));
    assert!(generate("hdd").status.success());
    let read = |name: &str| fs::read_to_string(folder.path().join("scenes").join(name));
    assert_eq!(read("lever.py").expect("a script"), pushplan_export::LEVER_SCRIPT);
    let ours = read("ours.jsonl").expect("lines");
    let set = LeverDataset::in_memory(&config(LeverPreset::Drive, 3), &NoProgress);
    let set = set.expect("lever-ups");
    assert_eq!(ours.lines().count(), 3);
    for (line, episode) in ours.lines().zip(set.episodes()) {
        let line: serde_json::Value = serde_json::from_str(line).expect("JSON");
        let scene = read(line["scene"].as_str().expect("a name")).expect("a scene");
        assert_eq!(scene, pushplan_export::lever_mjcf(&episode.job()));
        // The blade must not fall with the plate in the solver.
        assert!(scene.contains(r#"<body name="blade/0" gravcomp="1""#));
        let (rest, line_rest) = (episode.trajectory.rest, &line["rest"]);
        let [x, y, z, w] = rest.quaternion();
        let at = rest.position;
        for (k, wanted) in [at.x, at.y, at.z, w, x, y, z].into_iter().enumerate() {
            assert_eq!(line_rest[k].as_f64(), Some(wanted));
        }
        assert_eq!(line["lift"].as_array().map(Vec::len), Some(episode.trajectory.lift.len()));
    }
}
