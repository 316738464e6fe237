//! How the tool moves: pushes as planned, strokes as executed, frames as recorded.

use crate::scene::FRAME_TRAVEL;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Vector, clearance, contact_points};

use super::LeverUp;
use crate::scene::{Object, Part, Scene, State, TOUCHING, Tool};

/// How far a tool goes back before it is lifted, metres: off what it pressed against, which would be
/// taken along where it sticks. As far as it comes before it touches.
pub const RETREAT: f64 = 0.005;

/// How far the tips of a usual tool are from its frame, metres: what travels when it turns.
const TIPS: f64 = 0.1;

/// Duration of a frame while the tool stands still and objects come to rest, seconds.
pub const COAST_FRAME: f64 = 0.050;

/// Give up waiting for rest after this many coasting frames (3 s).
pub const MAX_COAST_FRAMES: usize = 60;

/// One straight push of the end effector, world frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Push {
    /// End-effector position at the start, metres.
    pub start: Vector,
    /// Heading of the motion, radians from world +x.
    pub direction: f64,
    /// Travel, metres.
    pub length: f64,
    /// Speed, m/s.
    pub speed: f64,
}

impl Push {
    /// Longest duration of a push that is replayed, seconds: the slowest and longest one that a task file
    /// allows takes 300.
    pub const LONGEST: f64 = 301.0;

    /// Duration, seconds.
    pub fn duration(&self) -> f64 {
        self.length / self.speed
    }

    /// Unit vector of the motion.
    pub fn heading(&self) -> Vector {
        Vector::new(self.direction.cos(), self.direction.sin())
    }

    /// End-effector position at the end, metres.
    pub fn end(&self) -> Vector {
        self.start + self.heading() * self.length
    }
}

/// One straight piece of a tool motion at constant speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Pose of the tool frame at the start.
    pub from: Pose,
    /// Pose of the tool frame at the end.
    pub to: Pose,
    /// Duration, seconds.
    pub duration: f64,
    /// Whether the tool then stands still until everything rests. The next stroke of a
    /// settled one may begin anywhere (the tool is lifted and set down); otherwise it begins
    /// where this one ends.
    pub settle: bool,
}

impl Stroke {
    /// A push with `tool`, held at `grip_yaw` (radians).
    pub fn push(tool: &Tool, grip_yaw: f64, push: &Push, settle: bool) -> Self {
        let pose = |position| tool.pose(Pose { position, heading: grip_yaw });
        Self { from: pose(push.start), to: pose(push.end()), duration: push.duration(), settle }
    }

    /// Travel of the tool frame, metres.
    pub fn travel(&self) -> f64 {
        (self.to.position - self.from.position).norm()
    }

    /// Unit vector of the travel, if there is any.
    pub fn direction(&self) -> Option<Vector> {
        let travel = self.to.position - self.from.position;
        let length = travel.norm();
        (length > 1e-9).then(|| travel / length)
    }

    /// Number of equal frames that the stroke is cut into: by the travel of the frame, and of the
    /// tips around it where the tool turns.
    pub fn frames(&self) -> usize {
        let turn = (self.to.heading - self.from.heading).abs();
        let travel = self.travel() + TIPS * turn;
        // The small part keeps 0.2 / 0.01 at twenty frames however it is rounded.
        ((travel / FRAME_TRAVEL - 1e-6).ceil() as usize).max(1)
    }

    /// Frame `index` of the stroke.
    pub fn frame(&self, index: usize) -> FrameStep {
        self.frames_from(index, 1)
    }

    /// `count` frames of the stroke as one, beginning with frame `index`.
    pub fn frames_from(&self, index: usize, count: usize) -> FrameStep {
        let n = self.frames() as f64;
        FrameStep {
            from: self.from.towards(&self.to, index as f64 / n),
            to: self.from.towards(&self.to, (index + count) as f64 / n),
            duration: self.duration / n * count as f64,
        }
    }
}

/// The tool's motion during one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameStep {
    /// Pose of the tool frame at the start of the frame.
    pub from: Pose,
    /// Pose of the tool frame at the end of the frame.
    pub to: Pose,
    /// Duration, seconds.
    pub duration: f64,
}

/// A tool and its strokes, one after another.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolMotion {
    /// The tool that moves.
    pub tool: Arc<Tool>,
    /// Height of the parts' underside above the table, metres.
    pub lift: f64,
    /// In order of time.
    pub strokes: Vec<Stroke>,
}

/// What a tool does in one go: it slides over the table, or it levers.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Strokes in the plane.
    Slide(ToolMotion),
    /// A lever-up.
    Lever(LeverMotion),
}

/// A lever-up with its tool.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverMotion {
    /// The tool with the blade, which makes no strokes.
    hand: ToolMotion,
    /// What the blade does.
    pub lever: LeverUp,
    /// Where the object is expected, if not where the scene has it.
    pub expected: Option<Pose>,
}

impl LeverMotion {
    /// A lever-up with `tool`, of an object that is expected there rather than where the scene has
    /// it.
    pub fn new(tool: Arc<Tool>, lever: LeverUp, expected: Option<Pose>) -> Self {
        Self { hand: ToolMotion { tool, lift: 0.0, strokes: Vec::new() }, lever, expected }
    }

    /// The tool.
    pub fn tool(&self) -> &Arc<Tool> {
        &self.hand.tool
    }
}

impl Motion {
    /// What of it happens in the plane: of a lever-up the tool and no strokes.
    pub fn slide(&self) -> &ToolMotion {
        match self {
            Motion::Slide(motion) => motion,
            Motion::Lever(motion) => &motion.hand,
        }
    }

    /// The same, to be changed.
    pub fn slide_mut(&mut self) -> &mut ToolMotion {
        match self {
            Motion::Slide(motion) => motion,
            Motion::Lever(motion) => &mut motion.hand,
        }
    }

    /// The tool that moves.
    pub fn tool(&self) -> &Arc<Tool> {
        &self.slide().tool
    }

    /// Whether what it levers is in `scene`, and its tool has a blade; of strokes nothing is asked.
    pub fn fits(&self, scene: &Scene) -> bool {
        let Motion::Lever(motion) = self else { return true };
        motion.lever.place.edge < scene.edges(motion.lever.plate) && motion.tool().blade().is_some()
    }

    /// Whether it leaves the plane.
    pub fn is_lever(&self) -> bool {
        matches!(self, Motion::Lever(_))
    }
}

impl From<ToolMotion> for Motion {
    fn from(motion: ToolMotion) -> Self {
        Motion::Slide(motion)
    }
}

impl ToolMotion {
    /// The strokes of straight pushes with a constant grip yaw (radians): `placed` pushes
    /// settle after each, `chained` ones only after the last.
    pub fn pushes(
        tool: Arc<Tool>,
        lift: f64,
        grip_yaw: f64,
        pushes: &[Push],
        placed: bool,
    ) -> Self {
        let last = pushes.len().saturating_sub(1);
        let stroke = |(k, push)| Stroke::push(&tool, grip_yaw, push, placed || k == last);
        let strokes = pushes.iter().enumerate().map(stroke).collect();
        Self { tool, lift, strokes }
    }

    /// The stroke under way `time` seconds after the first one began, and the pose of the tool
    /// frame then, if only the last one waits for rest; `None` for a motion without strokes.
    pub fn at(&self, time: f64) -> Option<(usize, Pose)> {
        let (mut begun, last) = (0.0, self.strokes.len().checked_sub(1)?);
        for (k, stroke) in self.strokes.iter().enumerate() {
            if k == last || time < begun + stroke.duration {
                let share = ((time - begun) / stroke.duration).clamp(0.0, 1.0);
                return Some((k, stroke.from.towards(&stroke.to, share)));
            }
            begun += stroke.duration;
        }
        None
    }

    /// How the tool goes back after stroke `index` before it is lifted: the way it came, by [`RETREAT`],
    /// or all of it where something is above it, or a part of an object may be, as it was set down at the
    /// start; `None` where it is not lifted.
    pub fn retreat(&self, scene: &Scene, index: usize) -> Option<Stroke> {
        let stroke = self.strokes.get(index).filter(|stroke| stroke.settle)?;
        let travel = stroke.travel();
        let below = |shape: &Footprint, pose: &Pose, top: f64| {
            // Where objects are by now is not known here.
            let hangs = |object: &Object| object.is_raised() && object.z >= top;
            scene.objects.iter().any(hangs)
                || scene.above(top).any(|above| {
                    clearance((shape, pose), (&above.footprint, &above.pose), RETREAT) < RETREAT
                })
        };
        let is_below = |part: &Part| {
            let top = self.lift + part.shape.height();
            below(&part.footprint(), &(stroke.to * part.pose), top)
        };
        let handle = self.tool.handle().is_some_and(|(shape, pose, height)| {
            below(&shape, &(stroke.to * pose), self.lift + height)
        });
        let back = match handle || self.tool.parts().iter().any(is_below) {
            true => travel,
            false => travel.min(RETREAT),
        };
        let share = back / travel;
        (share > 0.0).then(|| Stroke {
            from: stroke.to,
            to: stroke.to.towards(&stroke.from, share),
            duration: stroke.duration * share,
            settle: true,
        })
    }

    /// The objects that the tool is set down on at the start of stroke `index`: some part is then
    /// deeper than [`TOUCHING`] inside each of them.
    pub fn set_down_on<'a>(
        &'a self,
        scene: &'a Scene,
        state: &'a State,
        index: usize,
    ) -> impl Iterator<Item = usize> + 'a {
        let tool = self.strokes[index].from;
        let stands_on = move |&object: &usize| {
            let shape = &scene.objects[object].shape;
            let own = (&shape.footprint(), &state.poses[object]);
            let overlaps = |part: &Part| {
                let part = (&part.footprint(), &(tool * part.pose));
                contact_points(own, part, -TOUCHING).1 > 0
            };
            !scene.has_left(object, state)
                && self.lift < scene.objects[object].top()
                && self.tool.parts().iter().any(overlaps)
        };
        (0..scene.objects.len()).filter(stands_on)
    }
}
