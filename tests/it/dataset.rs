//! Sampled data: what it covers, that every draw is sound, and that its bits depend on the
//! seed alone.

use pushplan::{
    dataset::{Dataset, DatasetConfig, Episode, Unwatched},
    geometry::{Footprint, Pose, clearance},
};

fn drawn(episodes: u64) -> Dataset {
    let config = DatasetConfig { seed: 11, episodes, ..DatasetConfig::default() };
    Dataset::in_memory(&config, &Unwatched).expect("nothing stops it")
}

/// Indices of the frames at which the tool is set down: the start, and the first frame after
/// each settled stroke, with the tool's pose there.
fn set_downs(episode: &Episode) -> Vec<(usize, Pose)> {
    let strokes = &episode.motion.strokes;
    let mut found = vec![(0, strokes[0].from)];
    for k in 1..strokes.len() {
        if strokes[k - 1].settle {
            let rest = episode.frames.iter().rposition(|f| f.stroke == k - 1).expect("recorded");
            found.push((rest, strokes[k].from));
        }
    }
    found
}

#[test]
fn the_tool_is_set_down_free_of_everything_and_nothing_overlaps_at_the_start() {
    for episode in drawn(400).episodes() {
        let Episode { scene, motion, frames, .. } = episode;
        for (frame, tool) in set_downs(episode) {
            let objects = scene
                .objects
                .iter()
                .zip(&frames[frame].state.poses)
                .map(|(object, pose)| (object.shape.footprint(), *pose));
            let obstacles = scene.obstacles.iter().map(|o| (o.shape().footprint(), o.pose));
            for (footprint, pose) in objects.chain(obstacles) {
                for (index, part) in motion.tool.parts.iter().enumerate() {
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
            let last = episode.frames.iter().rposition(|f| f.stroke == k).expect("recorded");
            let before = match k {
                0 => 0,
                _ => episode.frames.iter().rposition(|f| f.stroke == k - 1).expect("recorded"),
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
    let config = DatasetConfig { seed: 12, episodes: 2000, ..DatasetConfig::default() };
    let ranges = config.ranges();
    let data = Dataset::in_memory(&config, &Unwatched).expect("nothing stops it");
    for episode in data.episodes() {
        let Episode { scene, motion, frames, .. } = episode;
        let outside = ranges.warnings(scene, motion);
        assert!(outside.is_empty(), "episode {}: {outside:?}", episode.index);
        assert!(ranges.pushes.contains(motion.strokes.len() as f64));
        for stroke in &motion.strokes {
            // Strokes cut short before an obstacle may be shorter than the range.
            assert!(stroke.travel() < ranges.travel.high + 1e-9 && stroke.travel() > 0.015);
        }
        let last = &frames[frames.len() - 1].state;
        assert!(last.is_finite() && scene.is_resting(last), "episode {}", episode.index);
    }
}

#[test]
fn one_and_two_threads_draw_the_same_bits() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| drawn(60))
    };
    let (one, two) = (with(1), with(2));
    for (a, b) in one.episodes().iter().zip(two.episodes()) {
        assert_eq!(a, b, "episode {}", a.index);
    }
    assert_eq!(one, two);
}
