//! Exact joints: joint errors from a network's corrections are projected out after every frame.
//!
//! Members of a fixed group get the nearest rigid motion. Groups are then moved relative to each
//! other until every revolute and prismatic joint, and every limit, is satisfied. The motion is the
//! smallest one, weighted by masses and moments of inertia, so that momentum is conserved (the
//! projection of position based dynamics, Müller et al. 2007, doi:10.1016/j.jvcir.2007.01.005, for
//! all joints at once).

use nalgebra::{DMatrix, DVector};

use crate::{
    geometry::{Pose, Vector, cross, perpendicular, wrap_angle},
    scene::{JOINT_ARM, JointKind, Separation, Span, State},
};

use super::{
    bodies::{Bodies, Jointed, Mounted},
    index::GroupIndex,
};

/// Maximum number of Newton steps, and the error at which they end, metres.
const STEPS: usize = 8;
const HELD: f64 = 1e-10;

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

/// Projects poses and velocities of jointed objects onto their joints, in every mechanism with an
/// object that `moved`.
pub fn project_joints(bodies: &Bodies, state: &mut State, moved: impl Fn(usize) -> bool) {
    if bodies.joints.is_empty() && bodies.mounts.is_empty() {
        return;
    }
    let mut touched = vec![false; bodies.objects.len()];
    for (object, &mechanism) in bodies.mechanisms.iter().enumerate() {
        touched[mechanism] |= moved(object);
    }
    let wanted = |joint: &Jointed| {
        // A guessed axis does not justify moving anything.
        !joint.guessed && touched[bodies.mechanisms[joint.between[0]]]
    };
    let own = bodies.joints.iter().filter(|joint| wanted(joint));
    let mounts = bodies.mounts.iter().filter(|mount| touched[bodies.mechanisms[mount.object]]);
    let joints: Vec<Held> = own
        .map(|joint| Held::between(bodies, joint))
        .chain(mounts.map(|mount| Held::to_world(bodies, mount)))
        .collect();
    if joints.is_empty() {
        return;
    }
    let members = bodies.groups.members.iter();
    let mut groups: Vec<Group> = members.map(|members| gather(bodies, state, members)).collect();
    groups.push(Group::WORLD);
    let places = place(bodies);
    let mut limited = vec![false; joints.len()];
    for _ in 0..STEPS {
        let rows = rows(&joints, &places, &groups, &mut limited);
        let missing = rows.iter().map(|row| row.missing.abs()).fold(0.0, f64::max);
        if missing < HELD {
            break;
        }
        for (row, share) in rows.iter().zip(&solve(&rows, &groups, |row| row.missing)) {
            row.each_side(&mut groups, |group, shift, turn| {
                group.pose.position += shift * (share * group.lightness);
                group.pose.heading += turn * share * group.ease;
            });
        }
    }
    let rows = rows(&joints, &places, &groups, &mut limited);
    let speed = |row: &Row| {
        let [a, b] = row.between.map(|group| &groups[group.0]);
        let of = |group: &Group, turn: f64| row.shift.dot(&group.velocity) + turn * group.spin;
        of(a, row.turns[0]) - of(b, row.turns[1])
    };
    let shares = solve(&rows, &groups, speed);
    for (row, share) in rows.iter().zip(&shares) {
        row.each_side(&mut groups, |group, shift, turn| {
            group.velocity += shift * (share * group.lightness);
            group.spin += turn * share * group.ease;
        });
    }
    for (object, &group) in bodies.groups.of.iter().enumerate() {
        if !joints.iter().any(|joint| joint.objects.contains(&Some(object))) {
            continue;
        }
        let Group { pose, velocity, spin, .. } = groups[group.0];
        let held = pose * places[object];
        // Full rotations are counted, so a heading changes by the difference only.
        let turn = wrap_angle(held.heading - state.poses[object].heading);
        let heading = state.poses[object].heading + turn;
        state.poses[object] = Pose { position: held.position, heading };
        let arm = held.position - pose.position;
        state.velocities[object].linear = velocity + spin * perpendicular(arm);
        state.velocities[object].angular = spin;
    }
}

impl Group {
    /// The immovable world; its index follows all groups.
    const WORLD: Self = Self {
        pose: Pose { position: Vector::new(0.0, 0.0), heading: 0.0 },
        velocity: Vector::new(0.0, 0.0),
        spin: 0.0,
        lightness: 0.0,
        ease: 0.0,
    };
}

/// A joint to satisfy between two groups, of which one may be the world.
struct Held<'a> {
    between: [GroupIndex; 2],
    /// Objects of the joint; `None` for the world.
    objects: [Option<usize>; 2],
    /// The joint's frame relative to each object, or in the world.
    frames: &'a [Pose; 2],
    kind: JointKind,
    limits: Option<Span>,
}

impl<'a> Held<'a> {
    /// Creates the joint of two objects.
    fn between(bodies: &Bodies, joint: &'a Jointed) -> Self {
        let Jointed { frames, kind, limits, .. } = joint;
        let between = joint.between.map(|object| bodies.groups.of[object]);
        Self { between, objects: joint.between.map(Some), frames, kind: *kind, limits: *limits }
    }

    /// Creates the joint of an object and the world, whose index follows all groups.
    fn to_world(bodies: &Bodies, mount: &'a Mounted) -> Self {
        let Mounted { frames, kind, limits, object } = mount;
        let between = [GroupIndex(bodies.groups.members.len()), bodies.groups.of[*object]];
        Self { between, objects: [None, Some(*object)], frames, kind: *kind, limits: *limits }
    }

    /// Returns the relative pose of the joint's sides, with the objects at these places in their
    /// groups.
    fn separation(&self, groups: &[Group], places: &[Pose]) -> Separation {
        let end = |side: usize| match self.objects[side] {
            Some(object) => groups[self.between[side].0].pose * places[object],
            None => Pose::default(),
        };
        Separation::of(self.frames, [end(0), end(1)])
    }
}

/// Returns every object's pose in the frame of its group's centre of mass.
fn place(bodies: &Bodies) -> Vec<Pose> {
    let mut places = bodies.groups.places.clone();
    for members in &bodies.groups.members {
        let centre = centre(bodies, members, |k| bodies.groups.places[k].position);
        members.iter().for_each(|&k| places[k].position -= centre);
    }
    places
}

/// Returns the mean of a vector over `members`, weighted by mass.
fn centre(bodies: &Bodies, members: &[usize], of: impl Fn(usize) -> Vector) -> Vector {
    let mass: f64 = members.iter().map(|&k| bodies.objects[k].mass).sum();
    members.iter().map(|&k| of(k) * bodies.objects[k].mass).sum::<Vector>() / mass
}

/// Returns the rigid motion of a group nearest to its members' motions.
fn gather(bodies: &Bodies, state: &State, members: &[usize]) -> Group {
    let own = |k: usize| {
        let body = &bodies.objects[k];
        body.mass * body.support * body.support / body.spin
    };
    let position = centre(bodies, members, |k| state.poses[k].position);
    let velocity = centre(bodies, members, |k| state.velocities[k].linear);
    let places = &bodies.groups.places;
    let middle = centre(bodies, members, |k| places[k].position);
    let (mut inertia, mut spin) = (0.0, 0.0);
    for &k in members {
        let mass = bodies.objects[k].mass;
        let arm = state.poses[k].position - position;
        inertia += mass * (places[k].position - middle).norm_squared() + own(k);
        spin += mass * cross(arm, state.velocities[k].linear - velocity)
            + own(k) * state.velocities[k].angular;
    }
    // Two steps bring the best heading from the first member's to rounding.
    let mut base = state.poses[members[0]].heading;
    for _ in 0..STEPS {
        let mut turn = 0.0;
        for &k in members {
            let wanted = Pose::new(0.0, 0.0, base).vector(places[k].position - middle);
            let arm = state.poses[k].position - position;
            let off = wrap_angle(state.poses[k].heading - base - places[k].heading);
            turn += bodies.objects[k].mass * cross(wanted, arm) + own(k) * off;
        }
        base += turn / inertia;
        if (turn / inertia).abs() < HELD {
            break;
        }
    }
    let mass: f64 = members.iter().map(|&k| bodies.objects[k].mass).sum();
    Group {
        pose: Pose { position, heading: base },
        velocity,
        spin: spin / inertia,
        lightness: 1.0 / mass,
        ease: 1.0 / inertia,
    }
}

/// A scalar equation for the displacement of the second group relative to the first.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Groups of the equation.
    between: [GroupIndex; 2],
    /// Direction of displacement; zero for a rotation.
    shift: Vector,
    /// Contribution of a rotation of either group, metres per radian.
    turns: [f64; 2],
    /// Residual, metres.
    missing: f64,
}

impl Row {
    fn of_shift(
        between: [GroupIndex; 2],
        arms: [Vector; 2],
        direction: Vector,
        missing: f64,
    ) -> Self {
        let turns = arms.map(|arm| cross(arm, direction));
        Self { between, shift: direction, turns, missing }
    }

    fn of_turn(between: [GroupIndex; 2], missing: f64) -> Self {
        Self {
            between,
            shift: Vector::zeros(),
            turns: [JOINT_ARM; 2],
            missing: missing * JOINT_ARM,
        }
    }

    /// Calls `act` to move both groups relative to each other along this row.
    fn each_side(&self, groups: &mut [Group], mut act: impl FnMut(&mut Group, Vector, f64)) {
        let [a, b] = self.between;
        act(&mut groups[a.0], -self.shift, -self.turns[0]);
        act(&mut groups[b.0], self.shift, self.turns[1]);
    }

    /// Returns the row's entries for `group`: signed displacement and rotation.
    fn side(&self, group: GroupIndex) -> Option<(Vector, f64)> {
        if group == self.between[0] {
            Some((-self.shift, -self.turns[0]))
        } else if group == self.between[1] {
            Some((self.shift, self.turns[1]))
        } else {
            None
        }
    }
}

/// Returns the rows of all joints between different groups. A limit has one once it is exceeded.
fn rows(joints: &[Held], places: &[Pose], groups: &[Group], limited: &mut [bool]) -> Vec<Row> {
    let mut rows = Vec::with_capacity(3 * joints.len());
    for (joint, limited) in joints.iter().zip(limited) {
        let between = joint.between;
        if between[0] == between[1] {
            continue;
        }
        let separation = joint.separation(groups, places);
        let (on, apart) = (separation.ends, separation.apart());
        let turned = separation.turned(&joint.kind);
        let arms = between.map(|group| on[1].position - groups[group.0].pose.position);
        let mut beyond = |value: f64| {
            let held = joint.limits.map(|limits| value.clamp(limits.low, limits.high) - value);
            *limited |= held.is_some_and(|held| held != 0.0);
            held.filter(|_| *limited)
        };
        match joint.kind {
            JointKind::Fixed => {}
            JointKind::Revolute { .. } => {
                rows.push(Row::of_shift(between, arms, Vector::x(), -apart.x));
                rows.push(Row::of_shift(between, arms, Vector::y(), -apart.y));
                rows.extend(beyond(turned).map(|held| Row::of_turn(between, held)));
            }
            JointKind::Prismatic { .. } => {
                let slide = on[0].vector(Vector::x());
                let across = perpendicular(slide);
                rows.push(Row::of_shift(between, arms, across, -apart.dot(&across)));
                rows.push(Row::of_turn(between, -turned));
                let slid = apart.dot(&slide);
                let held = beyond(slid);
                rows.extend(held.map(|held| Row::of_shift(between, arms, slide, held)));
            }
        }
    }
    rows
}

/// Returns the impulses along the rows that together remove the residuals.
fn solve(rows: &[Row], groups: &[Group], missing: impl Fn(&Row) -> f64) -> DVector<f64> {
    let count = rows.len();
    let mut coupling = DMatrix::zeros(count, count);
    for (p, first) in rows.iter().enumerate() {
        for (q, second) in rows.iter().enumerate() {
            for group in first.between {
                let (Some((s, t)), Some((u, v))) = (first.side(group), second.side(group)) else {
                    continue;
                };
                let Group { lightness, ease, .. } = groups[group.0];
                coupling[(p, q)] += s.dot(&u) * lightness + t * v * ease;
            }
        }
        // Rows of a forest of joints are independent except for duplicate limits.
        coupling[(p, p)] *= 1.0 + 1e-9;
    }
    let missing = DVector::from_iterator(count, rows.iter().map(missing));
    match coupling.cholesky() {
        Some(factor) => factor.solve(&missing),
        None => DVector::zeros(count),
    }
}
