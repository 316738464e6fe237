//! Sampled data: ranges, validity of every draw, and bits that depend only on the seed.

use std::{
    fs,
    path::Path,
    sync::{
        Arc, Mutex,
        atomic::{AtomicU64, Ordering},
    },
};

use pushplan::progress::{NoProgress, Progress};
use pushplan::{
    asset::ToolLibrary,
    geometry::{Footprint, Pose, clearance},
    outcome::Warning,
    scene::Quantity,
    task::{Job, ToolMotion},
};
use pushplan_bench::store::{FolderLock, RunManifest, Shard, Store, StoreError};
use pushplan_learn::dataset::{
    Dataset, DatasetConfig, DatasetError, Episode, generate, is_shipped,
};

fn drawn(episodes: u64) -> Dataset {
    let config = DatasetConfig { seed: 11, episodes, ..DatasetConfig::default() };
    Dataset::in_memory(&config, &NoProgress).unwrap()
}

/// Returns the frames at which the tool is set down, with the tool's pose there. These are the
/// start and the first frame after each settled stroke.
fn set_downs(episode: &Episode) -> Vec<(usize, Pose)> {
    let strokes = &episode.motion.strokes;
    let mut found = vec![(0, strokes[0].from)];
    for k in 1..strokes.len() {
        if strokes[k - 1].settle {
            let rest = episode.frames.iter().rposition(|f| f.stroke == k - 1).unwrap();
            found.push((rest, strokes[k].from));
        }
    }
    found
}

#[test]
fn the_tool_is_set_down_free_of_everything_and_nothing_overlaps_at_the_start() {
    for episode in drawn(150).episodes() {
        let Episode { scene, motion, frames, .. } = episode;
        for (frame, tool) in set_downs(episode) {
            let objects = scene
                .objects
                .iter()
                .zip(&frames[frame].state.poses)
                .map(|(object, pose)| (object.shape.footprint(), *pose));
            let obstacles = scene.obstacles.iter().map(|o| (o.shape().footprint(), o.pose));
            for (footprint, pose) in objects.chain(obstacles) {
                for (index, part) in motion.tool.parts().iter().enumerate() {
                    let placed = motion.tool.part_pose(index, &tool);
                    let gap = clearance((&part.footprint(), &placed), (&footprint, &pose), 0.01);
                    assert!(gap > 0.0, "episode {}", episode.index);
                }
            }
        }
        let bodies: Vec<(Footprint, Pose)> = scene
            .objects
            .iter()
            .map(|o| (o.shape.footprint().grown(-1e-6), o.pose))
            .chain(scene.obstacles.iter().map(|o| (o.shape().footprint(), o.pose)))
            .collect();
        for (k, a) in bodies.iter().enumerate() {
            for b in &bodies[k + 1..] {
                assert!(clearance((&a.0, &a.1), (&b.0, &b.1), 0.01) > 0.0, "{}", episode.index);
            }
        }
    }
}

#[test]
fn most_strokes_move_something() {
    let data = drawn(400);
    let (mut strokes, mut moving) = (0, 0);
    for episode in data.episodes() {
        for k in 0..episode.motion.strokes.len() {
            let last = episode.frames.iter().rposition(|f| f.stroke == k).unwrap();
            let before = match k {
                0 => 0,
                _ => episode.frames.iter().rposition(|f| f.stroke == k - 1).unwrap(),
            };
            let (a, b) = (&episode.frames[before].state, &episode.frames[last].state);
            strokes += 1;
            moving += usize::from(
                a.poses.iter().zip(&b.poses).any(|(a, b)| (a.position - b.position).norm() > 1e-4),
            );
        }
    }
    assert!(moving as f64 > 0.9 * strokes as f64, "{moving} of {strokes}");
}

#[test]
fn every_draw_is_finite_at_rest_and_within_the_stated_ranges() {
    let config = DatasetConfig { seed: 12, episodes: 600, ..DatasetConfig::default() };
    let ranges = config.ranges();
    let data = Dataset::in_memory(&config, &NoProgress).unwrap();
    let mut far = 0;
    for episode in data.episodes() {
        let Episode { scene, motion, frames, .. } = episode;
        let mut outside = ranges.warnings(scene, &Job::stated(scene, motion.clone()));
        // The stated slide covers nearly all draws, see `TRAINED_SLIDE`.
        outside.retain(|warning| match warning {
            Warning::OutsideRange { quantity: Quantity::Slide, .. } => {
                far += 1;
                false
            }
            _ => true,
        });
        assert!(outside.is_empty(), "episode {}: {outside:?}", episode.index);
        assert!(!is_shipped(&motion.tool), "episode {}", episode.index);
        assert!(ranges.pushes.contains(motion.strokes.len() as f64));
        for stroke in &motion.strokes {
            // Strokes shortened before an obstacle may be shorter than the range.
            assert!(stroke.travel() < ranges.travel.high + 1e-9 && stroke.travel() > 0.015);
        }
        let last = &frames[frames.len() - 1].state;
        assert!(last.is_finite() && scene.is_resting(last), "episode {}", episode.index);
    }
    assert!(far * 100 < data.episodes().len(), "{far} draws slide farther than stated");
}

#[test]
fn one_and_two_threads_draw_the_same_bits() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawn(60))
    };
    let (one, two) = (with(1), with(2));
    for (a, b) in one.episodes().iter().zip(two.episodes()) {
        assert_eq!(a, b, "episode {}", a.index);
    }
    assert_eq!(one, two);
}

/// Cancels after some episodes and records the notes.
#[derive(Default)]
struct Script {
    stop_after: Option<u64>,
    seen: AtomicU64,
    notes: Mutex<Vec<String>>,
}

impl Progress for Script {
    fn update(&self, _: u64, _: u64) {
        self.seen.fetch_add(1, Ordering::SeqCst);
    }

    fn note(&self, message: &str) {
        self.notes.lock().unwrap().push(message.to_owned());
    }

    fn cancelled(&self) -> bool {
        self.stop_after.is_some_and(|limit| self.seen.load(Ordering::SeqCst) >= limit)
    }
}

fn small() -> DatasetConfig {
    DatasetConfig { seed: 3, episodes: 44, ..DatasetConfig::default() }
}

/// Returns every file of a folder by name, with its bytes.
fn files(dir: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found: Vec<_> = fs::read_dir(dir)
        .unwrap()
        .map(|entry| entry.unwrap())
        .map(|e| (e.file_name().to_string_lossy().into_owned(), fs::read(e.path()).unwrap()))
        .collect();
    found.sort();
    found
}

/// Configuration large enough for two rounds of storing.
fn large() -> DatasetConfig {
    DatasetConfig { episodes: 100, ..small() }
}

#[test]
fn an_interrupted_generation_goes_on_to_the_same_files_and_reads_back_what_memory_holds() {
    let (whole, broken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (count, bytes) = generate(&large(), Shard::WHOLE, whole.path(), &NoProgress).unwrap();
    assert_eq!(count, 100);
    let names: Vec<String> = files(whole.path()).into_iter().map(|f| f.0).collect();
    assert_eq!(names, ["manifest.json", "records.bin"]);
    assert_eq!(fs::metadata(whole.path().join("records.bin")).unwrap().len(), bytes);

    let script = Script { stop_after: Some(80), ..Script::default() };
    let stopped = generate(&large(), Shard::WHOLE, broken.path(), &script);
    assert!(matches!(stopped, Err(DatasetError::Cancelled)), "{stopped:?}");
    match Dataset::open(broken.path()) {
        Err(DatasetError::Store(StoreError::Unfinished { done, total, .. })) => {
            assert!((64..100).contains(&done) && total == 100, "{done} of {total}");
        }
        opened => panic!("{opened:?}"),
    }

    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| generate(&large(), Shard::WHOLE, broken.path(), &NoProgress)).unwrap();
    assert!(files(whole.path()) == files(broken.path()), "the files differ");
    let (read, made) =
        (Dataset::open(whole.path()).unwrap(), Dataset::in_memory(&large(), &NoProgress).unwrap());
    assert_eq!(read, made);
}

#[test]
fn records_after_a_damaged_or_cut_record_are_regenerated_with_a_note() {
    let dir = tempfile::tempdir().unwrap();
    generate(&small(), Shard::WHOLE, dir.path(), &NoProgress).unwrap();
    let before = files(dir.path());
    let path = dir.path().join("records.bin");
    let sound = fs::read(&path).unwrap();
    let mut flipped = sound.clone();
    flipped[sound.len() / 2] ^= 4;
    for damaged in [flipped, sound[..sound.len() - 777].to_vec(), sound[..3].to_vec()] {
        fs::write(&path, &damaged).unwrap();
        let opened = Dataset::open(dir.path());
        let unfinished = matches!(opened, Err(DatasetError::Store(StoreError::Unfinished { .. })));
        assert!(unfinished, "{opened:?}");
        let script = Script::default();
        generate(&small(), Shard::WHOLE, dir.path(), &script).unwrap();
        let notes = script.notes.into_inner().unwrap();
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].contains("records.bin is incomplete after record "), "{notes:?}");
        assert!(files(dir.path()) == before, "the files differ");
    }
}

#[test]
fn other_settings_a_second_writer_an_empty_order_and_a_blocked_path_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let one = DatasetConfig { episodes: 2, ..small() };
    generate(&one, Shard::WHOLE, dir.path(), &NoProgress).unwrap();
    match generate(&small(), Shard::WHOLE, dir.path(), &NoProgress) {
        Err(DatasetError::Store(StoreError::OtherRun { differences, .. })) => {
            assert_eq!(differences, ["tasks is 2 in the folder, but 44 was requested"]);
        }
        other => panic!("{other:?}"),
    }
    let lock = FolderLock::take(dir.path(), &NoProgress).unwrap();
    let busy = generate(&one, Shard::WHOLE, dir.path(), &NoProgress);
    assert!(matches!(busy, Err(DatasetError::Store(StoreError::Busy { .. }))), "{busy:?}");
    drop(lock);
    generate(&one, Shard::WHOLE, dir.path(), &NoProgress).unwrap();
    let nothing = {
        let none = DatasetConfig { episodes: 0, ..small() };
        generate(&none, Shard::WHOLE, dir.path(), &NoProgress)
    };
    assert!(matches!(nothing, Err(DatasetError::Empty("episodes"))), "{nothing:?}");
    let blocked = generate(&one, Shard::WHOLE, &dir.path().join("manifest.json"), &NoProgress);
    assert!(matches!(blocked, Err(DatasetError::Store(StoreError::Io { .. }))), "{blocked:?}");
    let nowhere = Dataset::open(&dir.path().join("nowhere"));
    assert!(matches!(nowhere, Err(DatasetError::Store(StoreError::Missing { .. }))), "{nowhere:?}");
}

#[test]
fn a_benchmark_is_not_data() {
    let dir = tempfile::tempdir().unwrap();
    let manifest = RunManifest::new("random", 3, 1, "planar");
    drop(Store::<f64>::open(dir.path(), manifest, &NoProgress).unwrap());
    let opened = Dataset::open(dir.path());
    assert!(matches!(opened, Err(DatasetError::Foreign { .. })), "{opened:?}");
}

#[test]
fn the_shipped_tools_are_recognised_and_within_the_trained_ranges() {
    let config = DatasetConfig::default();
    let scene = pushplan::scene::Scene::new([]);
    let library = ToolLibrary::embedded().unwrap();
    assert!(library.len() >= 10);
    for tool in &library {
        assert!(is_shipped(tool), "{}", tool.name);
        let motion = ToolMotion { tool: Arc::clone(tool), lift: 0.002, strokes: Vec::new() };
        let outside: Vec<String> = config
            .ranges()
            .warnings(&scene, &Job::stated(&scene, motion))
            .iter()
            .map(ToString::to_string)
            .filter(|warning| !warning.starts_with("scene"))
            .collect();
        assert!(outside.is_empty(), "{outside:?}");
    }
}
