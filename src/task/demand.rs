//! Demands on the final pose of an object: one file per kind, dispatched here.
//!
//! Each kind implements [`Kind`]: the offset and rotation that refinement removes, the score that
//! the search minimises, stricter and shifted copies, words and marks for reports. A new kind needs
//! a file here, a variant of [`Demand`] with its arm, and its keys: a file and a line in
//! `asset/task/goals`.

mod area;
mod check;
mod coverage;
mod fall;
mod flipped;
mod gap;
mod group;
mod heading;
mod mark;
mod out_of;
mod outside;
mod place;
mod raised;
mod swing;
mod words;

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};
use crate::scene::{Body, Scene, State};

use super::Goal;

pub use area::{Area, InArea};
pub use check::{Check, Quantity};
pub use coverage::Coverage;
pub use fall::{Edge, Fall};
pub use flipped::{Ending, Flipped};
pub use gap::Gap;
pub use group::Group;
pub use heading::Facing;
pub use mark::{Mark, ShownGoal, Swing};
pub use out_of::OutOfArea;
pub use outside::Outside;
pub use place::AtPlace;
pub use raised::{Lift, Raised};

/// Maximum number of choices among objects; each is searched as a separate task.
pub(super) const MOST_CHOICES: usize = 12;

/// A demand on the final state of a goal's object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Demand {
    /// Centre near a point.
    Place(AtPlace),
    /// Centre in an area.
    Area(Box<InArea>),
    /// Centre outside of an area.
    OutOf(Box<OutOfArea>),
    /// Heading; also the angle of a joint.
    Heading(Facing),
    /// Gap to another object or an obstacle.
    Gap(Box<Gap>),
    /// Number of objects of a group that reach their goals.
    Group(Group),
    /// Covered share of its own outline at a pose.
    Coverage(Box<Coverage>),
    /// Fall off the table.
    Fall(Box<Fall>),
    /// Centre outside of an obstacle, seen from above.
    Outside(Outside),
    /// Edge lifted by a blade.
    Raised(Raised),
    /// Upside down, or on its underside.
    Flipped(Flipped),
}

/// The final state by which a demand on an object is judged.
#[derive(Clone, Copy, Debug)]
pub struct End<'a> {
    /// Index of the goal's object into [`Scene::objects`].
    pub object: usize,
    /// Poses at rest, in the plane or 3-D.
    pub state: &'a State,
    /// Last lift of the object, if a blade lifted it.
    pub lift: Option<Lift>,
}

impl<'a> End<'a> {
    /// Creates the final state of an object that no blade has lifted.
    pub fn resting(object: usize, state: &'a State) -> Self {
        Self { object, state, lift: None }
    }

    /// Returns the pose of the object, seen from above.
    pub fn pose(&self) -> &Pose {
        &self.state.poses[self.object]
    }
}

/// Interface of all kinds of demands. The default methods suit a kind that demands neither a
/// position nor a heading, and that search cannot approach.
pub trait Kind {
    /// Converts back to a [`Demand`].
    fn demand(&self) -> Demand;

    /// Returns `true` if the demand is satisfied.
    fn is_met(&self, end: &End) -> bool;

    /// Returns a phrase for reports, without the name of the object.
    fn words(&self, object: usize, scene: &Scene) -> String;

    /// Returns the offset of the object from the nearest wanted position, metres in world axes, or
    /// `None` without a demand on the position.
    fn off(&self, _end: &End) -> Option<Vector> {
        None
    }

    /// Returns the rotation of the object from the wanted heading, radians to the left, or `None`
    /// without a demand on the heading.
    fn turned(&self, _end: &End) -> Option<f64> {
        None
    }

    /// Returns the largest allowed [offset](Self::off), metres.
    fn tolerance(&self) -> Option<f64> {
        None
    }

    /// Returns the largest allowed [rotation](Self::turned), radians.
    fn turn_tolerance(&self) -> Option<f64> {
        self.facing().map(|facing| facing.tolerance)
    }

    /// Returns the error in units of the tolerance: at most 1 if the demand is satisfied.
    fn score(&self, end: &End) -> f64 {
        let place = self.off(end).zip(self.tolerance()).map(|(off, within)| off.norm() / within);
        let turn = self.turned(end).zip(self.turn_tolerance());
        let turn = turn.map(|(turn, within)| turn.abs() / within);
        let worst = place.into_iter().chain(turn).reduce(f64::max);
        worst.unwrap_or(if self.is_met(end) { 0.0 } else { 2.0 })
    }

    /// Returns the wanted position if it is a point of the demand's own frame or the centre of an
    /// area, metres.
    fn position(&self) -> Option<Vector> {
        None
    }

    /// Returns the demanded heading, if any.
    fn facing(&self) -> Option<&Facing> {
        None
    }

    /// Returns the covered share of the wanted outline, if one is demanded.
    fn covered(&self, _end: &End) -> Option<f64> {
        None
    }

    /// Returns the share of the wanted outline that must be covered, if one is demanded.
    fn share(&self) -> Option<f64> {
        None
    }

    /// Returns a demand that is harder by these margins, metres and radians; at least half of each
    /// tolerance remains.
    fn stricter(&self, _place: f64, _turn: f64) -> Demand {
        self.demand()
    }

    /// Returns the demand moved by a shift, metres in its own frame.
    fn shifted(&self, _shift: Vector) -> Demand {
        self.demand()
    }

    /// Returns the next target of refinement after a plan with the target `aim` has missed this
    /// demand by `shift`, metres in its own frame, and `turn`, radians.
    fn aimed(&self, aim: &Demand, shift: Vector, _turn: f64) -> Demand {
        self.shifted(aim.kind().anchor() - self.anchor() - shift)
    }

    /// Returns the point that [shifts](Self::shifted) move, metres in the demand's own frame.
    fn anchor(&self) -> Vector {
        Vector::zeros()
    }

    /// Returns the demand in the frame in which `frame` is given.
    fn seen_from(&self, _frame: &Pose) -> Demand {
        self.demand()
    }

    /// Returns the demand with its position and heading in the frame of object `other`.
    fn relative_to(&self, _other: usize) -> Demand {
        self.demand()
    }

    /// Returns the object in whose frame it is; `None` for the world.
    fn relative(&self) -> Option<usize> {
        None
    }

    /// Returns the objects of which some must be moved to satisfy it; empty if only the goal's
    /// object must move.
    fn movers(&self) -> Vec<usize> {
        Vec::new()
    }

    /// Returns the object to which its errors refer.
    fn subject(&self, end: &End) -> usize {
        end.object
    }

    /// Returns sets of goals without choices, the nearest first; the demand is satisfied if all
    /// goals of one set are. Search pursues the sets in order. Empty if the demand itself is
    /// searched.
    fn choices(&self, _state: &State) -> Vec<Vec<Goal>> {
        Vec::new()
    }

    /// Returns the other body of a relation.
    fn to(&self) -> Option<Body> {
        None
    }

    /// Returns `true` if it relates the object to another body, so that no single position is
    /// wanted.
    fn is_relation(&self) -> bool {
        false
    }

    /// Returns `true` if it is judged after everything has settled.
    fn is_at_rest(&self) -> bool {
        true
    }

    /// Returns `true` if the object leaves the table.
    fn falls(&self) -> bool {
        false
    }

    /// Returns the reason why no plan can be judged by it, if any.
    fn fault(&self, _object: usize, _scene: &Scene) -> Option<String> {
        None
    }

    /// Returns the check that judges exported scenes.
    fn check(&self, object: usize, scene: &Scene) -> Check;

    /// Returns marks for drawings, in world coordinates with every object at its start.
    fn marks(&self, _object: usize, _scene: &Scene) -> Vec<Mark> {
        Vec::new()
    }
}

impl Demand {
    /// Returns the kind behind its interface.
    pub fn kind(&self) -> &dyn Kind {
        match self {
            Self::Place(kind) => kind,
            Self::Area(kind) => &**kind,
            Self::OutOf(kind) => &**kind,
            Self::Heading(kind) => kind,
            Self::Gap(kind) => &**kind,
            Self::Group(kind) => kind,
            Self::Coverage(kind) => &**kind,
            Self::Fall(kind) => &**kind,
            Self::Outside(kind) => kind,
            Self::Raised(kind) => kind,
            Self::Flipped(kind) => kind,
        }
    }

    /// Returns `true` if it demands a position or a heading.
    pub fn is_pose(&self) -> bool {
        self.kind().tolerance().is_some() || self.kind().facing().is_some()
    }

    /// Returns the demanded heading mutably.
    pub fn facing_mut(&mut self) -> Option<&mut Facing> {
        match self {
            Self::Heading(facing) => Some(facing),
            Self::Coverage(coverage) => coverage.facing.as_mut(),
            _ => None,
        }
    }

    /// Returns the demand in world coordinates, with objects as in `state`.
    pub fn in_world(&self, state: &State) -> Self {
        let frame = self.kind().relative().and_then(|other| state.poses.get(other));
        frame.map_or_else(|| self.clone(), |frame| self.kind().seen_from(frame))
    }

    /// Returns [`Kind::off`] along the axes of the demand's own frame, metres.
    pub fn off_as_seen(&self, end: &End) -> Option<Vector> {
        let off = self.kind().off(end)?;
        let frame = self.kind().relative().and_then(|other| end.state.poses.get(other));
        Some(frame.map_or(off, |frame| frame.local_vector(off)))
    }
}

/// Returns a tolerance reduced by a margin, but at least half of it.
fn less(tolerance: f64, by: f64) -> f64 {
    (tolerance - by).max(0.5 * tolerance)
}

/// Serialisation of a length that may be infinite; JSON has no infinite numbers.
mod anywhere {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(tolerance: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        tolerance.is_finite().then_some(*tolerance).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}
