//! Recordings: examples of the documentation are readable, written files round-trip, replays
//! reproduce the recording, and every fault is reported with its place.

use std::path::Path;
use std::process::Command;

use pushplan::asset::{Kind, RECORDING_FORMAT, check};
use pushplan::effect::{EffectModel, Job, Simulated};
use pushplan::geometry::Vector;
use pushplan::recording::Recording;
use pushplan::sim::Simulator;
use pushplan::{
    outcome::{Record, Trajectory},
    scene::{JointKind, Object, Scene, Surface},
    task::{Push, ToolMotion},
};

use crate::fixtures::hand;

/// Valid recording, modified by the tests.
pub const SOUND: &str = "\
schema_version: 1
kind: recording
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.05, height: 0.1}}}
    - {name: box, shape: {cuboid: {size: [0.1, 0.08, 0.06]}}, mass: 0.7, yaw_deg: 10}
pusher: {cylinder: {radius: 0.05, height: 0.1}}
times: [5.0, 5.1, 5.2, 5.3]
frames:
  - {pusher: [0.00, 0], objects: [[0.20, 0], [0.5, 0.1, 10]]}
  - {pusher: [0.05, 0], objects: [[0.20, 0], [0.5, 0.1, 10]]}
  - {pusher: [0.10, 0], objects: [[0.20, 0], [0.5, 0.1, 10]]}
  - {pusher: [0.15, 0], objects: [[0.25, 0], [0.5, 0.1, 10]]}
";

/// Recording written by the documentation's Python code.
pub const PUSH: &str = include_str!("push.recording.json");

fn parse(text: &str) -> Result<Recording, String> {
    Recording::parse(text, "r.yaml").map_err(|faults| faults.to_string())
}

/// Returns the block of `language` in the documentation of the format.
fn block(language: &str) -> &str {
    let start = format!("```{language}\n");
    let text = RECORDING_FORMAT.split(&start).nth(1).expect("a block");
    text.split("```").next().expect("its end")
}

#[test]
fn examples_of_the_documentation_are_readable() {
    let example = Recording::parse(block("json"), "r.json").expect("the example is sound");
    assert_eq!((example.scene.objects.len(), example.scene.joints.len()), (2, 1));
    assert_eq!(example.scene.objects[0].mass, 0.5);
    assert_eq!(example.headings, [false, true]);

    // The stored file is used if Python is not available.
    let folder = tempfile::tempdir().expect("a folder");
    let python =
        Command::new("python3").args(["-c", block("python")]).current_dir(&folder).status();
    let path = match python {
        Ok(status) => {
            assert!(status.success());
            folder.path().join("push.recording.json")
        }
        Err(_) => Path::new(crate::ROOT).join("tests/it/assets/push.recording.json"),
    };
    assert!(block("python").lines().count() <= 10);
    assert_eq!(check(&path, None), Ok(Kind::Recording));
    let recording = Recording::load(&path).expect("the written file is sound");
    assert_eq!((recording.name.as_str(), recording.frames.len()), ("push", 31));
    assert!(off(&recording, &replayed(&recording)) < 2e-3);
}

#[test]
fn a_simulation_written_as_a_recording_reads_back_and_replays_to_itself() {
    let scene = Scene::new([
        Object::cylinder("a", 0.05, 0.1).at(0.15, 0.0, 0.0),
        Object::cuboid("b", [0.08, 0.12, 0.05]).at(0.25, 0.02, 0.4),
    ])
    .with_joint([0, 1], JointKind::Fixed);
    let push =
        |x, y, direction| Push { start: Vector::new(x, y), direction, length: 0.2, speed: 0.1 };
    let pushes = [push(0.0, 0.01, 0.0), push(0.6, 0.2, -2.5)];
    let motion = ToolMotion::pushes(hand(), 0.002, 0.0, &pushes, true);
    let simulated =
        Simulator::planar().run(&scene, &Job::stated(&scene, motion.clone()), Record::Frames);

    let recording = Recording::of_frames("two-pushes", &scene, &motion, &simulated.frames);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("two-pushes.recording.json");
    recording.write(&path).expect("a writable folder");
    let read = Recording::load(&path).expect("the written file is readable");
    assert_eq!(read.scene, scene);
    assert_eq!(read.tool.parts(), recording.tool.parts());
    assert_eq!(read.frames.len(), recording.frames.len());
    for (ours, theirs) in recording.frames.iter().zip(&read.frames) {
        assert!((ours.time - theirs.time).abs() < 1e-9 && ours.lifted == theirs.lifted);
        for (a, b) in ours.poses.iter().zip(&theirs.poses) {
            assert!(
                (a.position - b.position).norm() < 1e-12 && (a.heading - b.heading).abs() < 1e-9
            );
        }
    }
    assert_eq!(read.frames.iter().filter(|frame| frame.lifted).count(), 1);
    assert!(off(&read, &replayed(&read)) < 1e-4);
}

#[test]
fn objects_linked_across_a_gap_by_no_stated_joint_do_not_move_at_the_start() {
    let can = |name: &str, x| Object::cylinder(name, 0.05, 0.1).at(x, 0.0, 0.0);
    for (gap, sound) in [(0.02, true), (0.2, false)] {
        let scene = Scene::new([can("a", 0.105), can("b", 0.205 + gap)])
            .with_joint([0, 1], JointKind::Fixed);
        let push = Push { start: Vector::zeros(), direction: 0.0, length: 0.2, speed: 0.2 };
        let motion = ToolMotion::pushes(hand(), 0.002, 0.0, &[push], true);
        let job = Job::stated(&scene, motion.clone());
        let frames = Simulator::planar().run(&scene, &job, Record::Frames).frames;
        let mut recording = Recording::of_frames("gap", &scene, &motion, &frames);
        recording.scene.joints.clear();
        let moving = recording.moving_at_the_start();
        assert_eq!(moving.is_empty(), sound, "{gap}: {moving:?}");
        assert!(moving.iter().all(|moving| moving.object == 1), "{moving:?}");
    }
}

#[test]
fn frictions_of_pairs_are_read_and_written() {
    let text = SOUND.replace(
        "yaw_deg: 10}",
        "yaw_deg: 10}\n  frictions:\n    - {between: [can, tool], coefficient: 0.02}\n    - \
         {between: [table, box], coefficient: 0.1}\n    - {between: [can, box], coefficient: 0}",
    );
    let read = parse(&text).expect("sound");
    let pairs: Vec<_> = read.scene.frictions.iter().map(|p| (p.object, p.with)).collect();
    assert_eq!(pairs, [(0, Surface::Tool), (1, Surface::Table), (0, Surface::Object(1))]);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("r.json");
    read.write(&path).expect("a writable folder");
    let again = Recording::load(&path).expect("the written file is readable");
    assert_eq!(again.scene.frictions, read.scene.frictions);
}

#[test]
fn slow_frames_are_joined_and_fast_ones_cut() {
    let recording = |step: f64| {
        let frames: Vec<String> = (0..=20)
            .map(|k| format!("{{pusher: [{}, 0.5], objects: [[0.0, 0.0]]}}", step * f64::from(k)))
            .collect();
        let text = format!(
            "schema_version: 1\nkind: recording\nframe_time: 0.02\n\
             pusher: {{cylinder: {{radius: 0.02, height: 0.1}}}}\n\
             scene: {{objects: [{{name: can, shape: {{cylinder: {{radius: 0.05, height: 0.1}}}}}}]}}\n\
             frames: [{}]\n",
            frames.join(", ")
        );
        parse(&text).expect("a sound recording").replay()
    };
    let slow = recording(0.002);
    assert_eq!(slow.motion.strokes.len(), 4, "five frames of 2 mm make a stroke");
    assert!(slow.instants.iter().map(|instant| instant.frame).eq([5, 10, 15, 20]));
    let fast = recording(0.05);
    assert_eq!(fast.motion.strokes.len(), 20);
    assert!(fast.motion.strokes.iter().all(|stroke| stroke.frames() == 5));
    let standing = recording(0.0);
    assert_eq!(standing.motion.strokes.len(), 10, "0.4 s in frames of 40 ms");
    assert!(standing.motion.strokes.iter().all(|stroke| stroke.from == stroke.to));
}

#[test]
fn every_error_has_its_location() {
    parse(SOUND).expect("the unspoiled recording is sound");
    let spoiled: &[(&str, &str, &str)] = &[
        ("pusher: [0.05, 0]", "pusher: [.nan, 0]", "r.yaml:11:15: error: expected a finite number"),
        (
            "[[0.20, 0], [0.5, 0.1, 10]]}\n  - {pusher: [0.10",
            "[[0.20, 0]]}\n  - {pusher: [0.10",
            "r.yaml:11:34: error: frame 1: expected 2 poses, found 1",
        ),
        (
            "[0.25, 0], [0.5, 0.1, 10]",
            "[0.25, 0], [0.5, 0.1]",
            "r.yaml:13:46: error: frame 3 has no heading, but frame 0 has one",
        ),
        (
            "[0.25, 0], [0.5, 0.1, 10]",
            "[0.45, 0], [0.5, 0.1, 10]",
            "r.yaml:13:35: error: `can` moves 25 cm between frames 2 and 3",
        ),
        (
            "[0.25, 0], [0.5, 0.1, 10]",
            "[0.25, 0], [0.5, 0.1, 190]",
            "r.yaml:13:46: error: `box` rotates by 180 degrees between frames 2 and 3",
        ),
        (
            "pusher: [0.15, 0]",
            "pusher: [0.55, -0.2]",
            "r.yaml:13:14: error: the pusher moves 49 cm between frames 2 and 3",
        ),
        ("5.2, 5.3]", "5.2, 5.2]", "r.yaml:8:24: error: frame 3 is at 5.2 s, which is not after"),
        ("5.2, 5.3]", "5.2]", "r.yaml:8:8: error: 3 times for 4 frames"),
        ("5.2, 5.3]", "5.2, 5.9]", "error: frames are missing between frames 2 and 3"),
        ("times: [5.0, 5.1, 5.2, 5.3]\n", "", "error: neither `frame_time` nor `times` is given"),
        ("frames:\n", "frame_time: 0.1\nframes:\n", "error: both `frame_time` and `times`"),
        (
            "pusher: [0.00, 0]",
            "pusher: [0.17, 0]",
            "r.yaml:10:14: error: in frame 0 the pusher overlaps `can`",
        ),
        (
            "[0.5, 0.1, 10]]}\n  - {pusher: [0.05",
            "[0.21, 0.05, 10]]}\n  - {pusher: [0.05",
            "r.yaml:10:46: error: `box` overlaps `can`",
        ),
        (
            "[0.5, 0.1, 10]]}\n  - {pusher: [0.10",
            "[0.52, 0.1, 10]]}\n  - {pusher: [0.10",
            "r.yaml:11:46: error: the recording starts in motion: `box` moves by 20.0 mm",
        ),
        (
            "yaw_deg: 10}",
            "yaw_deg: 10}\n  frictions:\n    - {between: [can, bax], coefficient: 0.02}",
            "r.yaml:8:23: error: no body is called `bax`",
        ),
        (
            "yaw_deg: 10}",
            "yaw_deg: 10}\n  frictions:\n    - {between: [tool, table], coefficient: 0.02}",
            "r.yaml:8:17: error: neither of the two bodies is an object",
        ),
        (
            "yaw_deg: 10}",
            "yaw_deg: 10}\n  frictions:\n    - {between: [table, can], coefficient: 0.02}",
            "r.yaml:8:44: error: a coefficient of 0.02 between an object and the table",
        ),
        (
            "yaw_deg: 10}",
            "position: [0.6, 0.1]}",
            "r.yaml:6:84: error: `position` differs from the object's position in the first frame",
        ),
        (
            "radius: 0.05, height: 0.1}}}\n",
            "radius: 5, height: 10}}}\n",
            "r.yaml:5:46: error: an object 10 m wide: is this in centimetres?",
        ),
        (
            "radius: 0.05, height: 0.1}}}\n",
            "radius: 50, height: 100}}}\n",
            "r.yaml:5:46: error: an object 100 m wide: is this in millimetres?",
        ),
        (
            "[0.25, 0], [0.5, 0.1, 10]",
            "[25, 0], [50, 10, 10]",
            "r.yaml:13:45: error: a position 50 m from the origin: is this in centimetres?",
        ),
        (
            "[0.25, 0], [0.5, 0.1, 10]",
            "[250, 0], [350, 100, 10]",
            "r.yaml:13:46: error: a position 350 m from the origin: is this in millimetres?",
        ),
        ("pusher: {cylinder", "pusher: {cilinder", "r.yaml:7:10: error: unknown key `cilinder`"),
        (
            "pusher: {cylinder: {radius: 0.05, height: 0.1}}",
            "pusher: {lift: 0.01}",
            "r.yaml:7:9: error: a pusher has exactly one solid",
        ),
    ];
    let mut missed = String::new();
    for (old, new, expected) in spoiled {
        assert!(SOUND.contains(old), "{old}");
        let found = parse(&SOUND.replacen(old, new, 1)).expect_err(expected);
        if !found.contains(expected) {
            missed += &format!("{expected}\nfound:\n{found}\n\n");
        }
    }
    assert!(missed.is_empty(), "\n{missed}");
    // A width of 30 may be both; the positions decide.
    let small = SOUND.replacen("radius: 0.05, height: 0.1}}}\n", "radius: 15, height: 10}}}\n", 1);
    for (at, unit) in
        [("[25, 0], [50, 10, 10]", "centimetres"), ("[250, 0], [350, 100, 10]", "millimetres")]
    {
        let found = parse(&small.replace("[0.25, 0], [0.5, 0.1, 10]", at)).expect_err(unit);
        assert!(found.contains(&format!("an object 30 m wide: is this in {unit}?")), "{found}");
    }
    // A declared jump of the pusher is not a fault.
    let lifted = SOUND.replace("pusher: [0.15, 0]", "lifted: true, pusher: [0.55, -0.2]");
    assert!(parse(&lifted.replace("[0.25, 0]", "[0.20, 0]")).is_ok());
    let json = "{\"frames\": [{\"pusher\": [NaN, 0.0]}]}";
    let found = Recording::parse(json, "r.json").expect_err("NaN is no JSON").to_string();
    assert!(found.contains("JSON has no NaN"), "{found}");
}

/// Replays the recorded pusher in the 2-D engine.
fn replayed(recording: &Recording) -> Trajectory {
    let motion = recording.replay().motion;
    let job = Job { start: recording.start(), ..Job::stated(&recording.scene, motion) };
    let model = Simulated::new(Simulator::planar());
    model.rollout(&recording.scene, &[job], Record::Frames).remove(0)
}

/// Returns the largest distance of any object from its recorded position at the end of a stroke,
/// metres.
fn off(recording: &Recording, trajectory: &Trajectory) -> f64 {
    let replay = recording.replay();
    let mut largest: f64 = 0.0;
    for instant in replay.instants.iter().filter(|instant| !instant.settled) {
        let of_stroke = trajectory.frames.iter().skip(1).filter(|f| f.stroke == instant.stroke);
        let frames = replay.motion.strokes[instant.stroke].frames();
        let predicted = of_stroke.take(frames).last().expect("every stroke has frames");
        let truth = &recording.frames[instant.frame].poses;
        for (a, b) in predicted.state.poses.iter().zip(truth) {
            largest = largest.max((a.position - b.position).norm());
        }
    }
    largest
}

/// A pusher that rotates about the middle of its frame does not translate, but its ends move.
#[test]
fn frames_of_a_turning_pusher_are_cut_by_the_travel_of_its_tips() {
    let text = "
schema_version: 1
kind: recording
scene: {objects: [{name: can, shape: {cylinder: {radius: 0.02, height: 0.1}}}]}
pusher: {tool: {name: bar, friction: 0.3, grip: {position: [0, 0]}, parts: [{name: bar, size: [0.02, 0.20, 0.05], position: [0, 0]}]}}
times: [0, 1, 2]
frames:
  - {pusher: [0, 0, 0], objects: [[0.10, 0.05]]}
  - {pusher: [0, 0, -20]}
  - {pusher: [0, 0, -40], objects: [[0.11, 0.05]]}
";
    let recording = parse(text).expect("a sound recording");
    assert!(!recording.frames[1].seen && recording.frames[2].seen);
    let replay = recording.replay();
    // 10 cm times 0.7 radians, and slightly more for the corners.
    assert!((7..=9).contains(&replay.motion.strokes.len()), "{}", replay.motion.strokes.len());
    // Comparison is possible only in frames that contain the can.
    let instants: Vec<usize> = replay.instants.iter().map(|instant| instant.frame).collect();
    assert_eq!(instants, [2]);
    let last = replay.motion.strokes.last().expect("it moves");
    assert_eq!(last.to, recording.frames[2].tool);
    let missing = parse(&text.replace(", objects: [[0.11, 0.05]]", "")).expect_err("a fault");
    assert!(missing.to_string().contains("the last frame does not state"), "{missing}");
}

#[test]
fn motion_faster_than_the_stated_velocity_is_refused() {
    let refused = |velocity: &str| {
        let text = SOUND.replace("yaw_deg: 10}", &format!("yaw_deg: 10{velocity}}}"));
        let sliding = text.replace(
            "[0.5, 0.1, 10]]}\n  - {pusher: [0.10",
            "[0.54, 0.1, 10]]}\n  - {pusher: [0.10",
        );
        assert_ne!(text, sliding);
        Recording::parse(&sliding, "r.yaml").err().map(|faults| faults.to_string())
    };
    assert!(refused("").expect("a fault").contains("the recording starts in motion: `box`"));
    assert!(refused(", velocity: [0.05, 0]").expect("a fault").contains("`velocity`"));
    assert_eq!(refused(", velocity: [0.4, 0]"), None);
    let fault = refused(", velocity: [400, 0]").expect("a fault");
    assert!(
        fault.contains("expected a speed in m/s") && fault.contains("50 mm/s is 0.05"),
        "{fault}"
    );
    let fault = refused(", velocity: [0.4, 0], spin: 3").expect("a fault");
    assert!(fault.contains("unknown key `spin`"), "{fault}");
}
