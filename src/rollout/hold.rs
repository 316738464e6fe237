//! Joints hold exactly: what a network's corrections leave of their errors is projected out
//! after every frame.
//!
//! Members of a fixed group get the rigid motion nearest to theirs; groups are then moved
//! against each other until every revolute and prismatic joint, and every limit, is met. All
//! moves are weighted by masses and moments of inertia, so that momentum is kept (position
//! based dynamics, Müller et al. 2007, doi:10.1016/j.jvcir.2007.01.005).

use nalgebra::{Matrix2, Vector2};

use crate::{
    geometry::{Pose, Vector, cross, perpendicular, wrap_angle},
    graph::{Bodies, Jointed},
    scene::{JointKind, State},
};

/// Sweeps over all joints, and the error at which they end, metres.
const SWEEPS: usize = 24;
const HELD: f64 = 1e-7;

/// What turns an angle's error into metres.
const ARM: f64 = 0.05;

/// A rigid group: pose and velocity of its centre of mass.
#[derive(Clone, Copy, Debug)]
struct Group {
    pose: Pose,
    velocity: Vector,
    spin: f64,
    /// 1 / mass, 1/kg.
    lightness: f64,
    /// 1 / moment of inertia, 1/(kg m^2).
    ease: f64,
}

/// Brings poses and velocities of jointed objects to what their joints allow.
pub fn hold(bodies: &Bodies, state: &mut State) {
    // A guessed axis is no reason to move anything.
    let joints: Vec<&Jointed> = bodies.joints.iter().filter(|joint| !joint.guessed).collect();
    if joints.is_empty() {
        return;
    }
    let mut groups: Vec<Group> =
        (0..bodies.groups.members.len()).map(|index| gather(bodies, state, index)).collect();
    // Where every object sits in its group.
    let places: Vec<Pose> = place(bodies);
    for sweep in 0..SWEEPS {
        let mut error: f64 = 0.0;
        let count = joints.len();
        for k in 0..count {
            // There and back again, so that no end of a chain is preferred.
            let joint = joints[if sweep % 2 == 0 { k } else { count - 1 - k }];
            error = error.max(meet(bodies, joint, &places, &mut groups));
        }
        if error < HELD {
            break;
        }
    }
    for _ in 0..SWEEPS / 4 {
        let mut error: f64 = 0.0;
        for joint in &joints {
            error = error.max(calm(bodies, joint, &places, &mut groups));
        }
        if error < HELD {
            break;
        }
    }
    for (object, &group) in bodies.groups.of.iter().enumerate() {
        let alone = bodies.groups.members[group].len() == 1;
        if alone && !joints.iter().any(|joint| joint.between.contains(&object)) {
            continue;
        }
        let Group { pose, velocity, spin, .. } = groups[group];
        let held = pose * places[object];
        // Turns are counted, so a heading changes by the difference only.
        let turn = wrap_angle(held.heading - state.poses[object].heading);
        let heading = state.poses[object].heading + turn;
        state.poses[object] = Pose { position: held.position, heading };
        let arm = held.position - pose.position;
        state.velocities[object].linear = velocity + spin * perpendicular(arm);
        state.velocities[object].angular = spin;
    }
}

/// Every object's pose in the frame of its group's centre of mass.
fn place(bodies: &Bodies) -> Vec<Pose> {
    let mut places = bodies.groups.places.clone();
    for members in &bodies.groups.members {
        let centre = centre(bodies, members, |k| bodies.groups.places[k].position);
        members.iter().for_each(|&k| places[k].position -= centre);
    }
    places
}

/// Mean of a vector over `members`, weighted by mass.
fn centre(bodies: &Bodies, members: &[usize], of: impl Fn(usize) -> Vector) -> Vector {
    let mass: f64 = members.iter().map(|&k| bodies.objects[k].mass).sum();
    members.iter().map(|&k| of(k) * bodies.objects[k].mass).sum::<Vector>() / mass
}

/// The rigid motion of group `index` nearest to its members'.
fn gather(bodies: &Bodies, state: &State, index: usize) -> Group {
    let members = &bodies.groups.members[index];
    let own = |k: usize| {
        let body = &bodies.objects[k];
        body.mass * body.support * body.support / body.spin
    };
    let position = centre(bodies, members, |k| state.poses[k].position);
    let velocity = centre(bodies, members, |k| state.velocities[k].linear);
    let places = &bodies.groups.places;
    let middle = centre(bodies, members, |k| places[k].position);
    let base = state.poses[members[0]].heading;
    let (mut inertia, mut turn, mut spin) = (0.0, 0.0, 0.0);
    for &k in members {
        let mass = bodies.objects[k].mass;
        let wanted = Pose::new(0.0, 0.0, base).vector(places[k].position - middle);
        let arm = state.poses[k].position - position;
        let off = wrap_angle(state.poses[k].heading - base - places[k].heading);
        inertia += mass * wanted.norm_squared() + own(k);
        turn += mass * cross(wanted, arm) + own(k) * off;
        spin += mass * cross(arm, state.velocities[k].linear - velocity)
            + own(k) * state.velocities[k].angular;
    }
    let mass: f64 = members.iter().map(|&k| bodies.objects[k].mass).sum();
    Group {
        pose: Pose { position, heading: base + turn / inertia },
        velocity,
        spin: spin / inertia,
        lightness: 1.0 / mass,
        ease: 1.0 / inertia,
    }
}

/// Where the joint's frame lies on either object now.
fn frames(bodies: &Bodies, joint: &Jointed, places: &[Pose], groups: &[Group]) -> [Pose; 2] {
    [0, 1].map(|end| {
        let object = joint.between[end];
        groups[bodies.groups.of[object]].pose * places[object] * joint.frames[end]
    })
}

/// What a joint asks of its second body against the first: two directions of displacement at
/// the second's frame (or a turn), each with what is missing, metres.
fn asked(joint: &Jointed, on: &[Pose; 2]) -> [Option<(Ask, f64)>; 3] {
    let apart = on[1].position - on[0].position;
    let turned = wrap_angle(on[1].heading - on[0].heading);
    let beyond = |value: f64| {
        joint.limits.map_or(0.0, |limits| value.clamp(limits.low, limits.high) - value)
    };
    match joint.kind {
        JointKind::Fixed => [None; 3],
        JointKind::Revolute { .. } => [
            Some((Ask::Shift(Vector::x()), -apart.x)),
            Some((Ask::Shift(Vector::y()), -apart.y)),
            Some((Ask::Turn, beyond(turned) * ARM)).filter(|ask| ask.1 != 0.0),
        ],
        JointKind::Prismatic { .. } => {
            let slide = on[0].vector(Vector::x());
            let across = perpendicular(slide);
            [
                Some((Ask::Shift(across), -apart.dot(&across))),
                Some((Ask::Turn, -turned * ARM)),
                Some((Ask::Shift(slide), beyond(apart.dot(&slide)))).filter(|ask| ask.1 != 0.0),
            ]
        }
    }
}

#[derive(Clone, Copy, Debug)]
enum Ask {
    Shift(Vector),
    Turn,
}

/// The displacement along an ask per unit of a group's shift and turn.
fn row(ask: Ask, arm: Vector) -> (Vector, f64) {
    match ask {
        Ask::Shift(direction) => (direction, cross(arm, direction)),
        Ask::Turn => (Vector::zeros(), ARM),
    }
}

/// Moves two groups until their joint is met to first order; returns the error there was,
/// metres.
fn meet(bodies: &Bodies, joint: &Jointed, places: &[Pose], groups: &mut [Group]) -> f64 {
    let [a, b] = joint.between.map(|object| bodies.groups.of[object]);
    if a == b {
        return 0.0;
    }
    let on = frames(bodies, joint, places, groups);
    let at = on[1].position;
    let arms = [at - groups[a].pose.position, at - groups[b].pose.position];
    let [first, second, limit] = asked(joint, &on);
    let mut error: f64 = 0.0;
    let mut apply = |asks: [Option<(Ask, f64)>; 2], groups: &mut [Group]| {
        let missing = asks.map(|ask| ask.map_or(0.0, |(_, missing)| missing));
        error = error.max(missing[0].abs()).max(missing[1].abs());
        let shares = solve(asks.map(|ask| ask.map(|(ask, _)| ask)), arms, [a, b], groups, missing);
        for (ask, share) in asks.iter().zip(shares) {
            let Some((ask, _)) = ask else { continue };
            for (index, arm, sign) in [(b, arms[1], 1.0), (a, arms[0], -1.0)] {
                let (shift, turn) = row(*ask, arm);
                let group = &mut groups[index];
                group.pose.position += shift * (sign * share * group.lightness);
                group.pose.heading += turn * sign * share * group.ease;
            }
        }
    };
    apply([first, second], groups);
    if limit.is_some() {
        apply([limit, None], groups);
    }
    error
}

/// Takes the velocities out of a joint's held directions; returns the speed there was, m/s.
fn calm(bodies: &Bodies, joint: &Jointed, places: &[Pose], groups: &mut [Group]) -> f64 {
    let [a, b] = joint.between.map(|object| bodies.groups.of[object]);
    if a == b {
        return 0.0;
    }
    let on = frames(bodies, joint, places, groups);
    let at = on[1].position;
    let arms = [at - groups[a].pose.position, at - groups[b].pose.position];
    let [first, second, _] = asked(joint, &on);
    let asks = [first, second].map(|ask| ask.map(|(ask, _)| ask));
    let missing = asks.map(|ask| {
        ask.map_or(0.0, |ask| {
            let speed = |index: usize, arm| {
                let (shift, turn) = row(ask, arm);
                shift.dot(&groups[index].velocity) + turn * groups[index].spin
            };
            speed(a, arms[0]) - speed(b, arms[1])
        })
    });
    let shares = solve(asks, arms, [a, b], groups, missing);
    for (ask, share) in asks.iter().zip(shares) {
        let Some(ask) = ask else { continue };
        for (index, arm, sign) in [(b, arms[1], 1.0), (a, arms[0], -1.0)] {
            let (shift, turn) = row(*ask, arm);
            let group = &mut groups[index];
            group.velocity += shift * (sign * share * group.lightness);
            group.spin += turn * sign * share * group.ease;
        }
    }
    missing[0].abs().max(missing[1].abs())
}

/// The impulses along one or two asks that make up for what is `missing`.
fn solve(
    asks: [Option<Ask>; 2],
    arms: [Vector; 2],
    [a, b]: [usize; 2],
    groups: &[Group],
    missing: [f64; 2],
) -> [f64; 2] {
    let coupling = |p: Ask, q: Ask| {
        let own = |index: usize, arm| {
            let ((s, t), (u, v)) = (row(p, arm), row(q, arm));
            s.dot(&u) * groups[index].lightness + t * v * groups[index].ease
        };
        own(a, arms[0]) + own(b, arms[1])
    };
    match asks {
        [Some(p), Some(q)] => {
            let cross = coupling(p, q);
            let k = Matrix2::new(coupling(p, p), cross, cross, coupling(q, q));
            let found = k.try_inverse().unwrap_or_else(Matrix2::zeros) * Vector2::from(missing);
            [found.x, found.y]
        }
        [Some(p), None] => [missing[0] / coupling(p, p), 0.0],
        _ => [0.0, 0.0],
    }
}
