//! A tool: cuboid parts joined into one rigid piece, held by the end effector at its grip.

use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::{Pose, Shape, clearance};

use super::outline::{Piece, pieces};
use super::planar::planar_only;
use super::{Blade, DisjointSets, Part};

/// Parts whose gap is at most this are joined rigidly, metres.
///
/// Wide enough for the rounding of sizes written in whole millimetres and turned by degrees.
pub const JOIN_GAP: f64 = 1e-4;

/// Turns by so much are taken for straight, radians: an arc is then 0.2 % longer than its chord.
const EVEN_TURN: f64 = 0.2;

/// A rigid assembly of solids, moved by the end effector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Stated")]
pub struct Tool {
    /// Unique within a library.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Pose of the end effector in the tool frame.
    pub grip: Pose,
    /// Friction value.
    pub friction: f64,
    parts: Vec<Part>,
    /// Follows from the parts, so neither can be changed alone.
    #[serde(skip_serializing)]
    outline: Vec<Piece>,
    joints: Vec<[usize; 2]>,
    /// A tool with a blade has no parts.
    #[serde(with = "planar_only", skip_serializing_if = "Option::is_none")]
    blade: Option<Blade>,
}

/// A tool as it is written down: its outline follows from its parts.
#[derive(Deserialize)]
struct Stated {
    name: String,
    description: String,
    grip: Pose,
    friction: f64,
    parts: Vec<Part>,
    joints: Vec<[usize; 2]>,
    #[serde(with = "planar_only", default)]
    blade: Option<Blade>,
}

impl From<Stated> for Tool {
    fn from(stated: Stated) -> Self {
        let Stated { name, description, grip, friction, parts, joints, blade } = stated;
        Self { description, grip, friction, blade, ..Self::assembled(name, parts, joints) }
    }
}

/// Why parts do not make a tool.
#[derive(Clone, Error, PartialEq)]
pub enum ToolError {
    /// No parts at all.
    #[error("a tool needs at least one part")]
    NoParts,
    /// The parts fall into several pieces.
    #[error("the parts form {} separate pieces: {}", pieces.len(), list(pieces))]
    Apart {
        /// Names of the parts, piece by piece.
        pieces: Vec<Vec<String>>,
    },
}

/// The text of [`Display`](fmt::Display), so that it reads well when it leaves `main`.
impl fmt::Debug for ToolError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

fn list(pieces: &[Vec<String>]) -> String {
    let pieces: Vec<String> = pieces.iter().map(|piece| piece.join(" + ")).collect();
    pieces.join(" | ")
}

impl Tool {
    /// Friction value of most shipped tools: painted wood or plastic.
    pub const FRICTION: f64 = 0.4;

    /// A tool of `parts`, those that touch joined into one rigid piece, held at the origin of its
    /// frame, with friction value [`Tool::FRICTION`].
    ///
    /// ```
    /// use pushplan::{Part, Pose, Tool};
    ///
    /// // A 30 cm handle along x with a bar across its end, held 2 cm behind the handle.
    /// let handle = Part::cuboid("handle", [0.30, 0.03, 0.05], Pose::new(0.15, 0.0, 0.0));
    /// let bar = Part::cuboid("bar", [0.04, 0.16, 0.05], Pose::new(0.32, 0.0, 0.0));
    /// let rake = Tool::new("rake", [handle, bar])?.held_at(Pose::new(-0.02, 0.0, 0.0));
    /// assert_eq!(rake.joints(), [[0, 1]]);
    /// # Ok::<(), pushplan::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ToolError`] if there are no parts or they form several pieces.
    pub fn new(
        name: impl Into<String>,
        parts: impl IntoIterator<Item = Part>,
    ) -> Result<Self, ToolError> {
        Self::joined(name, parts, &[])
    }

    /// [`Tool::new`] with these pairs of parts, by index, joined even if they do not touch.
    ///
    /// # Errors
    /// [`ToolError`] if there are no parts or they form several pieces.
    pub fn joined(
        name: impl Into<String>,
        parts: impl IntoIterator<Item = Part>,
        by_hand: &[[usize; 2]],
    ) -> Result<Self, ToolError> {
        let parts: Vec<Part> = parts.into_iter().collect();
        if parts.is_empty() {
            return Err(ToolError::NoParts);
        }
        let mut joints = Vec::new();
        for a in 0..parts.len() {
            for b in a + 1..parts.len() {
                let said = by_hand.iter().any(|pair| *pair == [a, b] || *pair == [b, a]);
                // Not by contact points: two bars that cross have no corner in each other.
                let gap = clearance(
                    (&parts[a].footprint(), &parts[a].pose),
                    (&parts[b].footprint(), &parts[b].pose),
                    2.0 * JOIN_GAP,
                );
                if said || gap <= JOIN_GAP {
                    joints.push([a, b]);
                }
            }
        }
        let mut piece = DisjointSets::of(parts.len(), joints.iter().copied());
        let piece = piece.names();
        if piece.iter().any(|&p| p != 0) {
            let mut pieces: Vec<Vec<String>> = vec![Vec::new(); parts.len()];
            for (part, &p) in parts.iter().zip(piece) {
                pieces[p].push(part.name.clone());
            }
            pieces.retain(|p| !p.is_empty());
            return Err(ToolError::Apart { pieces });
        }
        Ok(Self::assembled(name, parts, joints))
    }

    /// [`Tool::new`] of parts that are known to make one piece by these joints.
    pub fn assembled(name: impl Into<String>, parts: Vec<Part>, joints: Vec<[usize; 2]>) -> Self {
        Self {
            name: name.into(),
            description: String::new(),
            grip: Pose::default(),
            friction: Self::FRICTION,
            outline: pieces(&parts),
            parts,
            joints,
            blade: None,
        }
    }

    /// A tool that levers and does not push: a blade, held at the end of its shaft.
    ///
    /// ```
    /// use pushplan::{Blade, Tool};
    ///
    /// let blade = Blade { length: 0.12, width: 0.006, thickness: 0.002, friction: Tool::FRICTION };
    /// let screwdriver = Tool::with_blade("my-screwdriver", blade);
    /// assert!(screwdriver.blade().is_some() && screwdriver.parts().is_empty());
    /// ```
    pub fn with_blade(name: impl Into<String>, blade: Blade) -> Self {
        let (friction, blade) = (blade.friction, Some(blade));
        Self { friction, blade, ..Self::assembled(name, Vec::new(), Vec::new()) }
    }

    /// What goes under an edge, of a tool that levers.
    pub fn blade(&self) -> Option<Blade> {
        self.blade.map(|blade| Blade { friction: self.friction, ..blade })
    }

    /// Whether it has parts to push with.
    pub fn pushes(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The parts as written; of a tool with a blade none.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The same without the seams between flush parts: what bodies touch.
    pub fn outline(&self) -> &[Piece] {
        &self.outline
    }

    /// Pairs of parts joined by a fixed joint; together they make one rigid piece.
    pub fn joints(&self) -> &[[usize; 2]] {
        &self.joints
    }

    /// The tool made of other parts, those that touch joined.
    ///
    /// # Errors
    /// [`ToolError`] if there are none or they form several pieces.
    pub fn with_parts(self, parts: impl IntoIterator<Item = Part>) -> Result<Self, ToolError> {
        let Self { name, description, grip, friction, .. } = self;
        Ok(Self { description, grip, friction, ..Self::new(name, parts)? })
    }

    /// The tool held with the end effector at `grip`, a pose in the tool frame.
    pub fn held_at(self, grip: Pose) -> Self {
        Self { grip, ..self }
    }

    /// The tool under another name.
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// The tool with another friction value.
    pub fn friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// The tool with one line about it for people.
    pub fn described(self, description: impl Into<String>) -> Self {
        Self { description: description.into(), ..self }
    }

    /// Pose of the tool frame in the world when the end effector is at `end_effector`.
    pub fn pose(&self, end_effector: Pose) -> Pose {
        end_effector * self.grip.inverse()
    }

    /// The farthest that anything of its outline goes while its frame moves evenly between two poses,
    /// metres, or a little more. Where it does not turn, that is the way of its frame.
    pub fn travel(&self, from: &Pose, to: &Pose) -> f64 {
        let way = to.position - from.position;
        let turn = (to.heading - from.heading).abs();
        if turn == 0.0 || self.outline.is_empty() {
            return way.norm();
        }
        let pieces = (turn / EVEN_TURN).ceil();
        let of = |piece: &Piece| {
            let at = |k: f64| from.towards(to, k / pieces).point(piece.pose.position);
            let centre: f64 =
                (0..pieces as usize).map(|k| (at(k as f64 + 1.0) - at(k as f64)).norm()).sum();
            match piece.shape {
                // A round piece that turns about its middle moves nothing.
                Shape::Cylinder { .. } => centre,
                _ => centre + turn * piece.footprint().bounding_radius(),
            }
        };
        self.outline.iter().map(of).fold(0.0, f64::max)
    }

    /// Pose of part `index` in the world when the tool frame is at `tool`.
    pub fn part_pose(&self, index: usize, tool: &Pose) -> Pose {
        *tool * self.parts[index].pose
    }
}
