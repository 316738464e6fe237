//! Episodes with tools: one to three objects, sometimes obstacles, one to three pushes.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use pushplan::internals::geometry::{Pose, Shape, Vector};
use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    outcome::{Frame, Record, Trajectory},
    scene::{Part, Ranges, Scene, Span, State, Tool},
    task::{Job, Stroke, ToolMotion},
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::aim::{Aim, aimed_stroke, random_direction, random_heading, tool_travel};
use super::assembly::random_tool;
use super::distributions::{heading, log_uniform, uniform, weighted};
use super::error::DatasetError;
use super::jam::{crosses_obstacle, shortened_before_jam};
use super::mujoco;
use super::novelty::is_shipped;
use super::obstacle::place_obstacle;
use super::preset::Preset;
use super::tabletop::{Crowd, Solids, anywhere, random_friction, random_scene};
use super::truth::Truth;
use super::unseen::{draw_heights, draw_supports, push_height};

/// Probabilities of one, two and three objects.
const OBJECT_COUNTS: [f64; 3] = [0.55, 0.30, 0.15];

/// Probabilities of one, two and three pushes.
const PUSH_COUNTS: [f64; 3] = [0.70, 0.20, 0.10];

/// Share of objects that are convex prisms.
const POLYGONS: f64 = 0.2;

/// Share of scenes with obstacles, for ground truth from both of our engines, from one of them, and
/// from MuJoCo.
const OBSTACLES: [f64; 3] = [0.2, 0.0, 0.35];

/// Share of tools that are a single round part, such as a finger or hand.
const ROUND: f64 = 0.12;

/// Height of the tool's underside above the table, metres.
const LIFT: f64 = 0.002;

/// Share of episodes with ground truth from the 3-D engine, in which the height of contact on faces
/// is not stated.
const SPATIAL: f64 = 0.8;

/// Share of pushes at a tenth to a third of the usual speeds. Their simulation takes as long as all
/// other pushes together.
const SLOW: f64 = 0.1;

/// Share of strokes in which the tool rotates while moving.
const TURNING: f64 = 0.15;

/// Maximum rotation of half of these strokes, rad/m: 34 degrees in 20 cm.
const USUAL_TURN: f64 = 3.0;

/// Maximum rotation of a tool in a stroke, radians.
const MOST_TURN: f64 = 1.2;

/// Range of speeds for MuJoCo, m/s.
///
/// Slower pushes take minutes to simulate. At higher speeds, objects with many support points
/// become unstable.
const MUJOCO_SPEED: Span = Span::new(0.04, 0.2);

/// Maximum number of attempts to aim a push.
const TRIES: usize = 30;

/// Minimum length of a shortened stroke, metres.
const SHORTEST: f64 = 0.02;

/// Draws a scene with one to three pushes; `None` if no push could be aimed or an object did not
/// come to rest.
///
/// # Errors
/// Returns [`DatasetError::Player`](super::DatasetError::Player) if MuJoCo is required and
/// unavailable.
pub(super) fn pushed_by_tool(
    rng: &mut Pcg64,
    ranges: &Ranges,
    preset: Preset,
    truth: Truth,
) -> Result<Option<(Scene, ToolMotion, Vec<Frame>)>, DatasetError> {
    let drawn = planned(rng, ranges, preset, truth);
    let Some((mut scene, motion, planar)) = drawn else { return Ok(None) };
    let spatial = match truth {
        Truth::Both => rng.random_bool(SPATIAL),
        Truth::Planar => false,
        Truth::Spatial | Truth::Mujoco => true,
    };
    if !spatial {
        return Ok(planar.warnings.is_empty().then_some((scene, motion, planar.frames)));
    }
    scene.push_height = None;
    if truth == Truth::Mujoco {
        let frames = mujoco::play(&scene, &motion)?;
        return Ok(frames.map(|frames| (scene, motion, frames)));
    }
    let job = Job::stated(&scene, motion.clone());
    let play = Simulator::spatial().run(&scene, &job, Record::Frames);
    Ok(play.warnings.is_empty().then_some((scene, motion, play.frames)))
}

/// Draws a scene with one to three pushes, aimed by the faster 2-D engine, and returns its
/// trajectory.
fn planned(
    rng: &mut Pcg64,
    ranges: &Ranges,
    preset: Preset,
    truth: Truth,
) -> Option<(Scene, ToolMotion, Trajectory)> {
    let as_planned = preset == Preset::Placed;
    let mut ranges = ranges.clone();
    if truth == Truth::Mujoco {
        ranges.speed.low = MUJOCO_SPEED.low;
        if !as_planned {
            ranges.speed.high = MUJOCO_SPEED.high;
        }
    }
    let ranges = &ranges;
    let crowd = Crowd {
        count: 1 + weighted(rng, &OBJECT_COUNTS),
        solids: Solids::Any,
        touching: 0.45,
        polygons: POLYGONS,
    };
    let scene = random_scene(rng, ranges, crowd);
    let mut scene = anywhere(rng, scene);
    if !as_planned {
        draw_supports(rng, &mut scene);
    }
    draw_heights(rng, ranges, &mut scene);
    scene.push_height = Some(push_height(rng));
    let tool = Arc::new(new_tool(rng, ranges));
    let count = if as_planned { 1 } else { 1 + weighted(rng, &PUSH_COUNTS) };
    let placed = rng.random::<bool>();

    let mut motion = ToolMotion { tool, lift: LIFT, strokes: Vec::new() };
    let mut play = aimed_first(rng, ranges, &scene, &motion)
        .map(|stroke| motion.strokes.push(stroke))
        .map(|()| simulate(&scene, &motion))?;
    let [both, ours, theirs] = OBSTACLES;
    let obstacles = match truth {
        Truth::Both => both,
        Truth::Planar | Truth::Spatial => ours,
        Truth::Mujoco => theirs,
    };
    if rng.random_bool(obstacles) {
        for _ in 0..rng.random_range(1..=2) {
            if let Some(obstacle) = place_obstacle(rng, &scene, &motion, &play.frames) {
                scene.obstacles.push(obstacle);
            }
        }
        play = cut_short(&scene, &mut motion)?;
    }
    while motion.strokes.len() < count {
        let next = if placed {
            aimed_next(rng, ranges, &scene, &motion, play.outcome())
        } else {
            continued(rng, ranges, &scene, &motion, &play)
        };
        let Some(next) = next else { break };
        let mut longer = motion.clone();
        if let Some(last) = longer.strokes.last_mut() {
            last.settle = placed;
        }
        longer.strokes.push(next);
        let Some(trajectory) = cut_short(&scene, &mut longer) else { break };
        (motion, play) = (longer, trajectory);
    }
    Some((scene, motion, play))
}

fn simulate(scene: &Scene, motion: &ToolMotion) -> Trajectory {
    Simulator::planar().run(scene, &Job::stated(scene, motion.clone()), Record::Frames)
}

/// Simulates the motion, with its last stroke ended before the tool squeezes an object against an
/// obstacle.
///
/// Neither engine has a valid solution for such a jam. Returns `None` if the remaining stroke is
/// too short.
fn cut_short(scene: &Scene, motion: &mut ToolMotion) -> Option<Trajectory> {
    let trajectory = simulate(scene, motion);
    if scene.obstacles.is_empty() {
        return Some(trajectory);
    }
    let Some(shorter) = shortened_before_jam(scene, motion, &trajectory.frames) else {
        return Some(trajectory);
    };
    if shorter.travel() < SHORTEST {
        return None;
    }
    *motion.strokes.last_mut()? = shorter;
    Some(simulate(scene, motion))
}

/// Draws a random tool that differs from all shipped ones.
fn new_tool(rng: &mut Pcg64, ranges: &Ranges) -> Tool {
    if rng.random_bool(ROUND) {
        return round_tool(rng, ranges);
    }
    loop {
        let tool = random_tool(rng, ranges);
        if !is_shipped(&tool) {
            return tool;
        }
    }
}

fn round_tool(rng: &mut Pcg64, ranges: &Ranges) -> Tool {
    let shape = Shape::Cylinder {
        radius: log_uniform(rng, ranges.part_radius),
        height: uniform(rng, 0.01, 0.06),
    };
    let pose = Pose::new(uniform(rng, -0.05, 0.20), 0.0, 0.0);
    let parts = vec![Part { name: "part-1".to_owned(), shape, pose }];
    Tool::assembled("finger", parts, Vec::new())
        .described("A single round part.")
        .friction(random_friction(rng, ranges))
}

fn speed_travel(rng: &mut Pcg64, ranges: &Ranges) -> (f64, f64) {
    let Span { low, high } = ranges.speed;
    // MuJoCo episodes, which are few, have no slow pushes.
    let usual = Span::new((3.0 * low).min(MUJOCO_SPEED.low), high);
    let span =
        if low < usual.low && rng.random_bool(SLOW) { Span::new(low, 3.0 * low) } else { usual };
    (log_uniform(rng, span), uniform(rng, ranges.travel.low, ranges.travel.high))
}

/// Draws the gap between tool and object at the start of a placed push, metres. Half of the gaps
/// are near the planner's 5 mm.
fn stand_off(rng: &mut Pcg64) -> f64 {
    if rng.random::<bool>() { uniform(rng, 0.004, 0.006) } else { uniform(rng, 2e-4, 0.02) }
}

/// Draws the first push, which determines the heading of the tool.
fn aimed_first(
    rng: &mut Pcg64,
    ranges: &Ranges,
    scene: &Scene,
    motion: &ToolMotion,
) -> Option<Stroke> {
    let state = scene.start();
    (0..TRIES).find_map(|_| {
        let direction = random_direction(rng, &scene.objects, &state);
        let heading = random_heading(rng, direction);
        let (speed, travel) = speed_travel(rng, ranges);
        let gap =
            if rng.random_bool(0.85) { stand_off(rng) } else { uniform(rng, 0.02, 0.6 * travel) };
        let aim = Aim { direction, heading, gap, travel, speed };
        let stroke = aimed_stroke(rng, &motion.tool, scene, &state, &aim)?;
        Some(turning(rng, ranges, stroke))
    })
}

/// Returns the stroke, in some cases with a rotation of the tool.
fn turning(rng: &mut Pcg64, ranges: &Ranges, mut stroke: Stroke) -> Stroke {
    let most = if rng.random::<bool>() { USUAL_TURN.min(ranges.turn) } else { ranges.turn };
    let rate = uniform(rng, -most, most);
    if rng.random_bool(TURNING) {
        stroke.to.heading += (rate * stroke.travel()).clamp(-MOST_TURN, MOST_TURN);
    }
    stroke
}

/// Draws a further placed push, aimed at the objects at rest.
fn aimed_next(
    rng: &mut Pcg64,
    ranges: &Ranges,
    scene: &Scene,
    motion: &ToolMotion,
    state: &State,
) -> Option<Stroke> {
    let heading = motion.strokes.last()?.to.heading;
    (0..TRIES).find_map(|_| {
        let direction = if rng.random_bool(0.65) {
            heading + FRAC_PI_2 * f64::from(rng.random_range(0..4u8))
        } else {
            random_direction(rng, &scene.objects, state)
        };
        let (speed, travel) = speed_travel(rng, ranges);
        let aim = Aim { direction, heading, gap: stand_off(rng), travel, speed };
        aimed_stroke(rng, &motion.tool, scene, state, &aim)
            .map(|stroke| turning(rng, ranges, stroke))
            .filter(|stroke| !crosses_obstacle(scene, &motion.tool, stroke))
    })
}

/// Draws a further chained push from the current tool pose, preferably towards an object.
fn continued(
    rng: &mut Pcg64,
    ranges: &Ranges,
    scene: &Scene,
    motion: &ToolMotion,
    play: &Trajectory,
) -> Option<Stroke> {
    let last = motion.strokes.last()?;
    let before = (last.to.position - last.from.position).normalize();
    let mut found = None;
    for _ in 0..TRIES {
        let turn = match weighted(rng, &[0.5, 0.15, 0.35]) {
            0 => FRAC_PI_2 * if rng.random::<bool>() { 1.0 } else { -1.0 },
            1 => std::f64::consts::PI,
            _ => heading(rng),
        };
        let along: Vector = Pose::new(0.0, 0.0, turn).vector(before);
        let (speed, travel) = speed_travel(rng, ranges);
        let stroke = Stroke {
            from: last.to,
            to: Pose { position: last.to.position + along * travel, ..last.to },
            duration: travel / speed,
            settle: true,
        };
        if crosses_obstacle(scene, &motion.tool, &stroke) {
            continue;
        }
        let meets = scene.objects.iter().zip(&play.outcome().poses).any(|(object, pose)| {
            let other = (&object.shape.footprint(), pose);
            tool_travel(&motion.tool, &last.to, along, other).is_some_and(|t| t < 0.8 * travel)
        });
        found = Some(stroke);
        if meets {
            break;
        }
    }
    found
}
