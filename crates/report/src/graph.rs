//! The interaction graph at one instant, for inspection: objects, tool parts and obstacles are
//! nodes, linked by their relations.
//!
//! The network uses a cheaper form, [`pushplan::graph::PrescribedNode`]: the parts of a tool share one row
//! because the fixed joints between them give all parts the same message. A test compares both
//! forms.

use serde::Serialize;

use pushplan::contact::{Bodies, FrameProblem, FrameSolver, Partner};
use pushplan::geometry::{Footprint, Pose, Vector, clearance};
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::{JointKind, Scene},
    task::{COAST_FRAME, FrameStep, Job, ToolMotion},
};

/// Interaction graph at one instant of a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Graph {
    /// Nodes: objects in the order of the scene, then the tool's parts, then obstacles.
    pub nodes: Vec<GraphNode>,
    /// Existing and possible contacts, and joints. Each appears once per direction, except that
    /// bodies with prescribed motion are no receivers.
    pub relations: Vec<GraphRelation>,
}

/// Kind of body that a node represents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NodeKind {
    /// Object, whose motion is predicted.
    Object,
    /// Tool part, moved by the end effector.
    Part,
    /// Obstacle, which never moves.
    Obstacle,
}

/// Node of the graph: a body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GraphNode {
    /// Name in the files; for parts `TOOL/PART`.
    pub name: String,
    /// Kind of body.
    pub kind: NodeKind,
    /// Pose at the start of the frame: metres, radians.
    pub pose: Pose,
    /// Extents along the body's own x and y, metres.
    pub size: [f64; 2],
    /// Translation during the frame, metres: predicted, or prescribed for tool parts.
    pub shift: Vector,
    /// Rotation during the frame, radians.
    pub turn: f64,
}

/// Type of a relation between two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RelationName {
    /// Contact, present or possible in this frame.
    Contact,
    /// Fixed joint, or rigid connection of the parts of a tool.
    Fixed,
    /// Revolute joint, with a rotation about a common point.
    Revolute,
    /// Prismatic joint, with a translation along a common line.
    Prismatic,
}

/// Directed relation, from sender to receiver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GraphRelation {
    /// Index of the node that receives the message.
    pub receiver: usize,
    /// Index of the node that sends the message.
    pub sender: usize,
    /// Type of the relation.
    pub kind: RelationName,
    /// Position of the relation in the world frame, metres.
    pub at: Vector,
}

impl Graph {
    /// Returns the graph between frames `index` and `index + 1` of the trajectory predicted for
    /// `job`. Returns `None` past the last frame, and for lever-ups.
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

/// Returns the tool motion between two frames, without the travel to the start of the next stroke.
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
    for side in frame.contacts.iter().flat_map(|contact| contact.sides()).flatten() {
        let receiver = own(side.receiver);
        let at = state.poses[receiver].position + side.arms[0];
        let sender = match side.sender {
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

/// Returns the index of the tool part touched at `at`. Contacts are found on the outline of the
/// tool, in which flush parts are one.
fn touched(parts: &[GraphNode], motion: &ToolMotion, at: Vector) -> usize {
    /// Radius of a disc that stands for a point, metres.
    const POINT: Footprint = Footprint::Disc { radius: 1e-6 };
    /// Search range for gaps, larger than any relevant gap, metres.
    const FAR: f64 = 1.0;
    let here = Pose { position: at, heading: 0.0 };
    let gap = |part: usize| {
        let footprint = motion.tool.parts()[part].footprint();
        clearance((&POINT, &here), (&footprint, &parts[part].pose), FAR)
    };
    (0..parts.len()).min_by(|a, b| gap(*a).total_cmp(&gap(*b))).unwrap_or(0)
}
