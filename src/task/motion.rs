//! Motions of the tool: planned pushes, executed strokes and recorded frames.

use crate::scene::FRAME_TRAVEL;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Vector, clearance, contact_points};

use super::LeverUp;
use crate::scene::{Object, Part, Scene, State, TOUCHING, Tool};

/// Distance by which a tool moves back before it is lifted, metres. Without it the tool would take
/// along an object that sticks to it. The tool is set down at the same distance before contact.
pub const RETREAT: f64 = 0.005;

/// Distance of the tips of a typical tool from its frame, metres; it converts rotations to travel.
const TIPS: f64 = 0.1;

/// Duration of a frame while the tool stands still and objects settle, seconds.
pub const COAST_FRAME: f64 = 0.050;

/// Maximum number of coasting frames while objects settle (3 s).
pub const MAX_COAST_FRAMES: usize = 60;

/// A straight push of the end effector, world frame.
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
    /// Maximum duration of a replayed push, seconds; the slowest and longest push that a task file
    /// allows takes 300.
    pub const LONGEST: f64 = 301.0;

    /// Returns the duration, seconds.
    pub fn duration(&self) -> f64 {
        self.length / self.speed
    }

    /// Returns the unit vector of the motion.
    pub fn heading(&self) -> Vector {
        Vector::new(self.direction.cos(), self.direction.sin())
    }

    /// Returns the end-effector position at the end, metres.
    pub fn end(&self) -> Vector {
        self.start + self.heading() * self.length
    }
}

/// A straight piece of a tool motion at constant speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Pose of the tool frame at the start.
    pub from: Pose,
    /// Pose of the tool frame at the end.
    pub to: Pose,
    /// Duration, seconds.
    pub duration: f64,
    /// Whether the tool then stands still until everything rests. The next stroke may then begin
    /// anywhere (the tool is lifted and set down); otherwise it begins at the end of this one.
    pub settle: bool,
}

impl Stroke {
    /// Creates a push with `tool`, held at `grip_yaw` (radians).
    pub fn push(tool: &Tool, grip_yaw: f64, push: &Push, settle: bool) -> Self {
        let pose = |position| tool.pose(Pose { position, heading: grip_yaw });
        Self { from: pose(push.start), to: pose(push.end()), duration: push.duration(), settle }
    }

    /// Returns the travel of the tool frame, metres.
    pub fn travel(&self) -> f64 {
        (self.to.position - self.from.position).norm()
    }

    /// Returns the unit vector of the travel, if there is any.
    pub fn direction(&self) -> Option<Vector> {
        let travel = self.to.position - self.from.position;
        let length = travel.norm();
        (length > 1e-9).then(|| travel / length)
    }

    /// Returns the number of equal frames of the stroke, from the travel of the tool frame and, if
    /// the tool rotates, of the tips around it.
    pub fn frames(&self) -> usize {
        let turn = (self.to.heading - self.from.heading).abs();
        let travel = self.travel() + TIPS * turn;
        // The small offset gives 0.2 / 0.01 twenty frames under any rounding.
        ((travel / FRAME_TRAVEL - 1e-6).ceil() as usize).max(1)
    }

    /// Returns frame `index` of the stroke.
    pub fn frame(&self, index: usize) -> FrameStep {
        self.frames_from(index, 1)
    }

    /// Returns `count` frames of the stroke as one, beginning with frame `index`.
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

/// A tool and its consecutive strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolMotion {
    /// Tool.
    pub tool: Arc<Tool>,
    /// Height of the parts' underside above the table, metres.
    pub lift: f64,
    /// Strokes in order of time.
    pub strokes: Vec<Stroke>,
}

/// An uninterrupted motion of a tool: it slides over the table, or it levers.
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
    /// The tool with the blade, without strokes.
    hand: ToolMotion,
    /// Motion of the blade.
    pub lever: LeverUp,
    /// Expected pose of the object; `None` for its pose in the scene.
    pub expected: Option<Pose>,
}

impl LeverMotion {
    /// Creates a lever-up with `tool`. `expected` replaces the pose of the object in the scene.
    pub fn new(tool: Arc<Tool>, lever: LeverUp, expected: Option<Pose>) -> Self {
        Self { hand: ToolMotion { tool, lift: 0.0, strokes: Vec::new() }, lever, expected }
    }

    /// Returns the tool.
    pub fn tool(&self) -> &Arc<Tool> {
        &self.hand.tool
    }
}

impl Motion {
    /// Returns the planar motion; for a lever-up the tool without strokes.
    pub fn slide(&self) -> &ToolMotion {
        match self {
            Motion::Slide(motion) => motion,
            Motion::Lever(motion) => &motion.hand,
        }
    }

    /// Returns the planar motion mutably.
    pub fn slide_mut(&mut self) -> &mut ToolMotion {
        match self {
            Motion::Slide(motion) => motion,
            Motion::Lever(motion) => &mut motion.hand,
        }
    }

    /// Returns the tool.
    pub fn tool(&self) -> &Arc<Tool> {
        &self.slide().tool
    }

    /// Returns `true` if the levered edge exists in `scene` and the tool has a blade; strokes
    /// always fit.
    pub fn fits(&self, scene: &Scene) -> bool {
        let Motion::Lever(motion) = self else { return true };
        motion.lever.place.edge < scene.edges(motion.lever.plate) && motion.tool().blade().is_some()
    }

    /// Returns `true` if it leaves the plane.
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
    /// Creates the strokes of straight pushes with a constant grip yaw (radians). `placed` pushes
    /// settle after each, chained ones only after the last.
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

    /// Returns the stroke in progress `time` seconds after the first one began, and the pose of the
    /// tool frame then. Only the last stroke may wait for rest. Returns `None` for a motion without
    /// strokes.
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

    /// Returns the motion back along stroke `index` before the tool is lifted, by [`RETREAT`]. The
    /// whole stroke is reversed if an obstacle is above the tool or a part of an object may be,
    /// because the tool was set down at the start. Returns `None` if the tool is not lifted.
    pub fn retreat(&self, scene: &Scene, index: usize) -> Option<Stroke> {
        let stroke = self.strokes.get(index).filter(|stroke| stroke.settle)?;
        let travel = stroke.travel();
        let below = |shape: &Footprint, pose: &Pose, top: f64| {
            // The present poses of the objects are not known here.
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

    /// Returns the objects on which the tool is set down at the start of stroke `index`: some part
    /// is then deeper than [`TOUCHING`] inside each of them.
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
