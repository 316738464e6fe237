//! The graph of a moment, for people and programs that look at it: every object, every part of the
//! tool and every obstacle as a node, and what relates them.
//!
//! What the network computes on is a cheaper form of the same: the parts of a tool share one row, as
//! the fixed joints between them make each say the same, see [`pushplan::graph::Given`]. A test holds the two
//! together.

use serde::Serialize;

use pushplan::contact::{Bodies, FrameProblem, FrameSolver, Partner};
use pushplan::geometry::{Footprint, Pose, Vector, clearance};
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::{JointKind, Scene},
    task::{COAST_FRAME, FrameStep, Job, ToolMotion},
};

/// A graph at one moment of a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Graph {
    /// Objects in the order of the scene, then the tool's parts, then obstacles.
    pub nodes: Vec<GraphNode>,
    /// Contacts that are or may come to be, and joints; each once for either direction, but for
    /// bodies whose motion is given, which nothing moves.
    pub relations: Vec<GraphRelation>,
}

/// What a node stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NodeKind {
    /// An object, whose motion is predicted.
    Object,
    /// A part of the tool, moved by the end effector.
    Part,
    /// An obstacle, which never moves.
    Obstacle,
}

/// A body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GraphNode {
    /// As the files name it; parts as `TOOL/PART`.
    pub name: String,
    /// What it is.
    pub kind: NodeKind,
    /// Where it is as the frame begins: metres, radians.
    pub pose: Pose,
    /// Its length along its own x and y, metres.
    pub size: [f64; 2],
    /// How far it moves during the frame, metres: predicted, or of parts as prescribed.
    pub shift: Vector,
    /// How far it turns during the frame, radians.
    pub turn: f64,
}

/// What relates two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RelationName {
    /// They touch, or may come to in this frame.
    Contact,
    /// They move as one: joined objects, and the parts of a tool.
    Fixed,
    /// One turns about a point of the other.
    Revolute,
    /// One slides along a line of the other.
    Prismatic,
}

/// A relation as its receiver sees it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GraphRelation {
    /// Index of the node that hears.
    pub receiver: usize,
    /// Index of the node that speaks.
    pub sender: usize,
    /// What relates them.
    pub kind: RelationName,
    /// Where, world, metres.
    pub at: Vector,
}

impl Graph {
    /// The graph between frames `index` and `index + 1` of what a model says that `job` does; `None`
    /// past the last one, and for lever-ups.
    pub fn at(scene: &Scene, job: &Job, trajectory: &Trajectory, index: usize) -> Option<Self> {
        let motion = (!job.in_space()).then(|| job.motion.slide())?;
        let [before, after] = [trajectory.frames.get(index)?, trajectory.frames.get(index + 1)?];
        let step = step(motion, before, after)?;
        let bodies = Bodies::new(scene, &motion.tool, motion.lift, &job.physics);
        let axis = motion.strokes[after.stroke].direction().unwrap_or_else(Vector::x);
        let nodes = nodes(scene, motion, (before, after), &step);
        let relations = relations(
            &nodes,
            scene,
            motion,
            FrameProblem { bodies: &bodies, state: &before.state, step: &step, axis },
        );
        Some(Self { nodes, relations })
    }
}

/// What the tool does between two frames; its way to where it is set down again is left out.
fn step(motion: &ToolMotion, before: &Frame, after: &Frame) -> Option<FrameStep> {
    let stroke = motion.strokes.get(after.stroke)?;
    let first = before.stroke != after.stroke || before.time == 0.0;
    let from = if first { stroke.from } else { before.tool };
    let duration = after.time - before.time;
    let duration = if duration > 0.0 { duration } else { COAST_FRAME };
    Some(FrameStep { from, to: after.tool, duration })
}

fn nodes(
    scene: &Scene,
    motion: &ToolMotion,
    (before, after): (&Frame, &Frame),
    step: &FrameStep,
) -> Vec<GraphNode> {
    let node = |name, kind, footprint: &Footprint, [pose, next]: [Pose; 2]| GraphNode {
        name,
        kind,
        pose,
        size: [Vector::x(), Vector::y()]
            .map(|axis| footprint.extent(axis) + footprint.extent(-axis)),
        shift: next.position - pose.position,
        turn: next.heading - pose.heading,
    };
    let objects = scene.objects.iter().enumerate().map(|(k, object)| {
        let poses = [before, after].map(|frame| frame.state.poses[k]);
        node(object.name.clone(), NodeKind::Object, &object.shape.footprint(), poses)
    });
    let parts = motion.tool.parts().iter().map(|part| {
        let poses = [step.from, step.to].map(|tool| tool * part.pose);
        let name = format!("{}/{}", motion.tool.name, part.name);
        node(name, NodeKind::Part, &part.footprint(), poses)
    });
    let obstacles = scene.obstacles.iter().map(|obstacle| {
        let footprint = obstacle.shape().footprint();
        node(obstacle.name.clone(), NodeKind::Obstacle, &footprint, [obstacle.pose; 2])
    });
    objects.chain(parts).chain(obstacles).collect()
}

fn relations(
    nodes: &[GraphNode],
    scene: &Scene,
    motion: &ToolMotion,
    problem: FrameProblem<'_>,
) -> Vec<GraphRelation> {
    let (objects, parts) = (scene.objects.len(), motion.tool.parts());
    let state = problem.state;
    let mut solver = FrameSolver::default();
    let (frame, _) = solver.solve_with_forces(problem);
    let own = |awake: usize| frame.bodies.objects[awake].index.0;
    let mut relations = Vec::new();
    for sight in frame.contacts.iter().flat_map(|contact| contact.sights()).flatten() {
        let receiver = own(sight.receiver);
        let at = state.poses[receiver].position + sight.arms[0];
        let sender = match sight.sender {
            Partner::Object(other) => own(other),
            Partner::Obstacle(k) => objects + parts.len() + frame.bodies.obstacles[k].index,
            Partner::Part(_) => {
                objects + touched(&nodes[objects..objects + parts.len()], motion, at)
            }
        };
        relations.push(GraphRelation { receiver, sender, kind: RelationName::Contact, at });
    }
    for joint in &frame.bodies.joints {
        let kind = match joint.kind {
            JointKind::Fixed => RelationName::Fixed,
            JointKind::Revolute { .. } => RelationName::Revolute,
            JointKind::Prismatic { .. } => RelationName::Prismatic,
        };
        let [a, b] = joint.between.map(own);
        let at = (state.poses[a].position + state.poses[b].position) / 2.0;
        for (receiver, sender) in [(a, b), (b, a)] {
            relations.push(GraphRelation { receiver, sender, kind, at });
        }
    }
    for joint in motion.tool.joints() {
        let [a, b] = joint.map(|part| objects + part);
        let at = (nodes[a].pose.position + nodes[b].pose.position) / 2.0;
        for (receiver, sender) in [(a, b), (b, a)] {
            let kind = RelationName::Fixed;
            relations.push(GraphRelation { receiver, sender, kind, at });
        }
    }
    relations
}

/// Which of the tool's `parts` is touched there: contacts are found on its outline, in which flush
/// parts are one.
fn touched(parts: &[GraphNode], motion: &ToolMotion, at: Vector) -> usize {
    /// As small as a point, metres.
    const POINT: Footprint = Footprint::Disc { radius: 1e-6 };
    /// Farther than any gap that counts, metres.
    const FAR: f64 = 1.0;
    let here = Pose { position: at, heading: 0.0 };
    let gap = |part: usize| {
        let footprint = motion.tool.parts()[part].footprint();
        clearance((&POINT, &here), (&footprint, &parts[part].pose), FAR)
    };
    (0..parts.len()).min_by(|a, b| gap(*a).total_cmp(&gap(*b))).unwrap_or(0)
}
