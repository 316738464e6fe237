//! Relations: a contact point or a joint from the view of the receiver, one of its two bodies.

use crate::{
    contact::{Bodies, Contact, ContactSide, FrameForces, FrameSolution, PairId, Partner},
    geometry::{Vector, perpendicular},
    scene::JointKind,
};

/// Kind of a relation between two bodies.
#[derive(Clone, Copy, Debug)]
pub(super) enum RelationKind {
    /// A contact that is closed or may close.
    Contact {
        /// Unit normal, into the receiver.
        normal: Vector,
        gap: f64,
        /// Coefficient of friction.
        friction: f64,
        /// Overlap of the bodies if the receiver only slid freely, metres.
        overlap: f64,
        /// Share of the frame that remains after the gap has closed.
        remaining: f64,
        /// Remaining gap in the analytic model, metres.
        left: f64,
        /// Displacement of the sender's point along the receiver's surface in the analytic model,
        /// metres.
        slip: f64,
        /// Normal force over mu m g, the table friction of the receiver.
        load: f64,
    },
    /// A joint between the bodies.
    Joint {
        kind: JointKind,
        /// Current sliding direction of a prismatic joint; its sign has no meaning.
        axis: Vector,
        /// Remaining rotation (radians) or slide (metres) down and up to the limits, from the first
        /// object's view; infinite without limits.
        room: (f64, f64),
    },
}

/// A relation from the view of its receiver. World axes, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relation {
    pub pair: PairId,
    /// Index of the receiver among the awake objects; the sender is numbered likewise.
    pub receiver: usize,
    pub sender: Partner,
    /// Vector from the receiver's centre to the contact point or joint.
    pub arm: Vector,
    /// Vector from the sender's centre to its contact point or to the joint; zero for a sender with
    /// prescribed motion.
    pub sender_arm: Vector,
    /// Natural logarithm of the sender's mass over the receiver's; zero for a sender with
    /// prescribed motion.
    pub mass_ratio: f64,
    /// Length c of the sender; zero for a sender with prescribed motion.
    pub sender_support: f64,
    /// Displacement of the sender's point in the analytic model relative to the freely sliding
    /// receiver.
    pub relative: Vector,
    /// Motion of the receiver under this relation's force alone: displacement and rotation.
    pub answer: (Vector, f64),
    pub kind: RelationKind,
}

/// Adds the relations of a contact: into its object, and into the other body if that can move.
pub(super) fn add_contact(
    frame: &FrameSolution,
    forces: &FrameForces,
    index: usize,
    contact: &Contact,
    relations: &mut Vec<Relation>,
) {
    let FrameSolution { bodies, coasts, motions, .. } = *frame;
    for side in contact.sides().into_iter().flatten() {
        let ContactSide { receiver, sender, normal, arms, .. } = side;
        let sent = side.sent(motions);
        let relative = sent - coasts[receiver].at(arms[0]);
        let closing = relative.dot(&normal);
        let gap = contact.gap;
        let ends = sent - motions[receiver].at(arms[0]);
        let weight = bodies.objects[receiver].mass * bodies.objects[receiver].deceleration;
        let kind = RelationKind::Contact {
            normal,
            gap,
            friction: contact.friction,
            overlap: side.overlap(&coasts[receiver], motions),
            remaining: if closing > gap.max(0.0) { 1.0 - gap.max(0.0) / closing } else { 0.0 },
            left: gap - ends.dot(&normal),
            slip: ends.dot(&perpendicular(normal)),
            load: forces.normal(index) / weight,
        };
        let answer = forces.by_contact(index, receiver);
        let ends = (receiver, sender);
        relations.push(relation(bodies, ends, arms, relative, answer, kind));
    }
}

/// Adds the two relations of joint `index`.
pub(super) fn add_joint(
    frame: &FrameSolution,
    forces: &FrameForces,
    index: usize,
    relations: &mut Vec<Relation>,
) {
    let FrameSolution { bodies, state, coasts, motions, .. } = *frame;
    let joint = &bodies.joints[index];
    let poses = joint.between.map(|object| state.poses[object]);
    let separation = joint.separation(&state.poses);
    let [on_first, on_second] = separation.ends;
    let axis = on_first.vector(Vector::x());
    let at = match joint.kind {
        JointKind::Revolute { .. } => (on_first.position + on_second.position) / 2.0,
        _ => (poses[0].position + poses[1].position) / 2.0,
    };
    let now = match joint.kind {
        JointKind::Prismatic { .. } => separation.seen().x,
        _ => separation.turned(&joint.kind),
    };
    let room = joint
        .limits
        .map_or((f64::INFINITY, f64::INFINITY), |limits| (now - limits.low, limits.high - now));
    let kind = RelationKind::Joint { kind: joint.kind, axis, room };
    for [to, from] in [[0, 1], [1, 0]] {
        let (receiver, sender) = (joint.between[to], joint.between[from]);
        let arms = [at - poses[to].position, at - poses[from].position];
        let relative = motions[sender].at(arms[1]) - coasts[receiver].at(arms[0]);
        let answer = forces.by_joint(index, receiver);
        let ends = (receiver, Partner::Object(sender));
        relations.push(relation(bodies, ends, arms, relative, answer, kind));
    }
}

fn relation(
    bodies: &Bodies,
    (receiver, sender): (usize, Partner),
    [arm, sender_arm]: [Vector; 2],
    relative: Vector,
    answer: (Vector, f64),
    kind: RelationKind,
) -> Relation {
    let (mass_ratio, sender_support) = match sender {
        Partner::Object(sender) => {
            let (to, from) = (&bodies.objects[receiver], &bodies.objects[sender]);
            ((from.mass / to.mass).ln(), from.support)
        }
        _ => (0.0, 0.0),
    };
    Relation {
        pair: bodies.pair(receiver, sender),
        receiver,
        sender,
        arm,
        sender_arm,
        mass_ratio,
        sender_support,
        relative,
        answer,
        kind,
    }
}
