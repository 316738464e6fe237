//! Frames in lanes against the same frames one by one and against the general equations, to the
//! bit.

use pushplan_kernel::{MANY, Motion, SingleBodySolution, SolverStats};

use super::{Waiting, is_single_body, solve_each, solve_together};

use crate::{
    contact::{
        bodies::Bodies,
        constraint::Status,
        frame::{Frame, FrameProblem},
        prior::Prior,
    },
    geometry::{Pose, Shape, Vector},
    scene::{Object, Obstacle, Part, Physics, Scene, State, Tool, Velocity},
    task::FrameStep,
};

/// Pseudo-random numbers from -1 to 1.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        let Self(seed) = self;
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self, size: f64) -> Vector {
        size * Vector::new(self.next(), self.next())
    }
}

/// A frame with an object near a tool, and every fourth time between the tool and a wall.
struct Drawn {
    bodies: Bodies,
    state: State,
    step: FrameStep,
}

impl Drawn {
    fn new(seed: u64) -> Self {
        let noise = &mut Noise(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        let size = 0.025 + 0.01 * noise.next();
        let object = match seed % 3 {
            0 => Object::cylinder("object", size, 0.1),
            _ => Object::cuboid("object", [2.0 * size, 1.5 * size, 0.1]),
        };
        let turn = if seed.is_multiple_of(5) { 0.0 } else { 0.3 * noise.next() };
        let friction = if seed.is_multiple_of(7) { 0.0 } else { 0.4 + 0.3 * noise.next() };
        let object = object.mass(0.6 + 0.5 * noise.next()).friction(friction).at(0.0, 0.0, turn);
        let mut scene = Scene::new([object]);
        if seed.is_multiple_of(4) {
            scene.obstacles.push(Obstacle {
                name: "wall".into(),
                size: [0.02, 0.3, 0.1],
                pose: Pose::new(0.012 + size + 0.002 * noise.next(), 0.0, 0.0),
                z: 0.0,
                friction: 0.5,
            });
        }
        let pose = Pose::default();
        let part = match seed % 2 {
            0 => Part::cuboid("bar", [0.02, 0.12, 0.1], pose),
            _ => Part {
                name: "finger".into(),
                shape: Shape::Cylinder { radius: 0.01, height: 0.1 },
                pose,
            },
        };
        let tool = Tool::new("tool", [part]).expect("one piece").friction(0.4);
        let bodies = Bodies::new(&scene, &tool, 0.002, &Physics::stated(&scene));
        let mut state = scene.start();
        if !seed.is_multiple_of(6) {
            let linear = noise.vector(0.1);
            state.velocities[0] = Velocity { linear, angular: 2.0 * noise.next() };
        }
        let from = Pose::new(-size - 0.013 + 0.004 * noise.next(), 0.02 * noise.next(), 0.0);
        let to = from.position + Vector::new(0.006, 0.0) + noise.vector(0.006);
        let heading = if seed % 3 == 1 { 0.1 * noise.next() } else { 0.0 };
        let duration = 0.06 + 0.05 * noise.next();
        Self {
            bodies,
            state,
            step: FrameStep { from, to: Pose { position: to, heading }, duration },
        }
    }

    fn problem(&self) -> FrameProblem<'_> {
        let Self { bodies, state, step } = self;
        FrameProblem { bodies, state, step, axis: Vector::x() }
    }
}

/// Returns all bits of a frame's solution.
fn bits(solution: &SingleBodySolution) -> Vec<u64> {
    let SingleBodySolution { motion, normal, pressed, effort, .. } = solution;
    let motion = motion.iter().flat_map(|motion| {
        let Motion { shift, turn, velocity, spin } = *motion;
        [shift.x, shift.y, turn, velocity.x, velocity.y, spin]
    });
    let pressed = pressed.iter().flat_map(|pressed| [pressed.x, pressed.y, pressed.z]);
    let inverse = solution.inverse();
    let effort = effort.iter().map(|&count| f64::from(count));
    let all = motion.chain(*normal).chain(pressed).chain(inverse).chain(effort);
    all.map(f64::to_bits).collect()
}

/// Returns the frames of these seeds that have a single object in contact.
fn woken(drawn: &[Drawn]) -> (Vec<Option<FrameProblem<'_>>>, Vec<Frame>) {
    drawn
        .iter()
        .filter_map(|drawn| {
            let (problem, mut frame) = (drawn.problem(), Frame::default());
            let single =
                frame.wake(problem) && is_single_body(&frame.scenery(problem), &frame.contacts);
            single.then_some((Some(problem), frame))
        })
        .unzip()
}

fn solved(
    together: usize,
    problems: &[Option<FrameProblem>],
    frames: &mut [Frame],
    order: &[usize],
) -> (Vec<Option<Vec<u64>>>, SolverStats) {
    let mut tally = SolverStats::default();
    let waiting = order.iter().map(|&place| Waiting { contacts: 0, effort: [0; 3], place });
    let waiting: Vec<Waiting> = waiting.collect();
    for waiting in waiting.chunks(together) {
        solve_together(problems, frames, waiting, &mut tally);
    }
    (frames.iter().map(|frame| frame.single.as_ref().map(bits)).collect(), tally)
}

#[test]
fn a_frame_is_the_same_bits_beside_any_others() {
    let drawn: Vec<Drawn> = (0..400).map(Drawn::new).collect();
    let (problems, mut frames) = woken(&drawn);
    let order: Vec<usize> = (0..frames.len()).collect();
    let (alone, took) = solved(1, &problems, &mut frames, &order);
    assert!(alone.len() > 300, "{} frames", alone.len());
    // Every frame is combined with others that have another number of contacts, and some lanes stay
    // empty.
    let steps = [1, 7, 11].map(|step| {
        let place = |k: usize| k * step % order.len();
        assert!(step == 1 || !order.len().is_multiple_of(step), "all are there");
        (0..order.len()).map(place).collect::<Vec<_>>()
    });
    for order in &steps {
        for together in [
            solved(2, &problems, &mut frames, order),
            solved(MANY / 2, &problems, &mut frames, order),
            solved(MANY, &problems, &mut frames, order),
        ] {
            for (k, (one, other)) in alone.iter().zip(&together.0).enumerate() {
                assert_eq!(one, other, "frame {k}");
            }
            assert_eq!(took, together.1);
        }
    }
    let mut tally = SolverStats::default();
    for few in 1..=2 * MANY + 3 {
        let mut waiting: Vec<Waiting> =
            (0..few).map(|k| Waiting { contacts: k % 2, effort: [0; 3], place: 5 * k }).collect();
        waiting.sort_unstable();
        solve_each(&problems, &mut frames, &waiting, &mut tally);
        for Waiting { place, .. } in waiting {
            assert_eq!(frames[place].single.as_ref().map(bits), alone[place]);
        }
    }
}

#[test]
fn a_frame_is_that_of_the_general_equations_to_the_bit() {
    let drawn: Vec<Drawn> = (0..400).map(Drawn::new).collect();
    let (problems, mut frames) = woken(&drawn);
    let order: Vec<usize> = (0..frames.len()).collect();
    let (_, tally) = solved(MANY / 2, &problems, &mut frames, &order);
    let (mut held, mut coasting, mut sticking, mut sliding, mut open, mut lost) =
        (0, 0, 0, 0, 0, 0);
    let mut prior = Prior::default();
    for (frame, problem) in frames.iter().zip(problems.iter().flatten()) {
        let scenery = frame.scenery(*problem);
        prior.solve(scenery, problem.axis, &frame.contacts);
        let Some(single) = &frame.single else {
            lost += 1;
            continue;
        };
        let motion = single.motion.unwrap_or(scenery.coasts[0]);
        assert_eq!(format!("{motion:?}"), format!("{:?}", prior.motions[0]));
        *if single.motion.is_some() { &mut held } else { &mut coasting } += 1;
        for (k, constraint) in prior.system.constraints.iter().enumerate() {
            let force = constraint.force;
            assert_eq!(single.normal[k].to_bits(), force.x.to_bits());
            let pressed = constraint.to[0] * force.x + constraint.to[1] * force.y;
            assert_eq!(single.pressed[k], pressed);
            let unknown = &prior.system.unknowns[0];
            assert_eq!(single.moved(&pressed), unknown.inverse * pressed);
            *match constraint.status {
                Status::Open => &mut open,
                Status::Sticks => &mut sticking,
                Status::Slides(_) => &mut sliding,
            } += 1;
        }
    }
    if lost == 0 {
        let mut general = prior.system.tally;
        general.add(&prior.velocities.tally);
        assert_eq!(tally, general);
    }
    let counts = [held, coasting, sticking, sliding, open];
    assert!(counts.iter().all(|&count| count > 20) && lost < 20, "{counts:?}, {lost} lost");
}
