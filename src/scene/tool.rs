//! Tools: solids joined into one rigid piece, held by the end effector at its grip.

use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::{Pose, Shape, clearance};

use super::outline::{Piece, pieces};
use super::serde_planar::planar_only;
use super::{Blade, DisjointSets, Part};

/// Largest gap of parts that are joined rigidly, metres.
///
/// Larger than the rounding of sizes in whole millimetres and of rotations in degrees.
pub const JOIN_GAP: f64 = 1e-4;

/// Largest rotation in a straight segment, radians: the arc is 0.2 % longer than its chord.
const EVEN_TURN: f64 = 0.2;

/// A rigid assembly of solids, moved by the end effector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Stated")]
pub struct Tool {
    /// Name, unique within a library.
    pub name: String,
    /// Description of one line.
    pub description: String,
    /// Pose of the end effector in the tool frame.
    pub grip: Pose,
    /// Friction value.
    pub friction: f64,
    parts: Vec<Part>,
    /// Outline; it follows from the parts, so neither can be changed alone.
    #[serde(skip_serializing)]
    outline: Vec<Piece>,
    joints: Vec<[usize; 2]>,
    /// Blade; a tool with a blade has no parts.
    #[serde(with = "planar_only", skip_serializing_if = "Option::is_none")]
    blade: Option<Blade>,
}

/// The serialised form of a tool, without its outline, which follows from its parts.
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

/// The reason why parts do not form a tool.
#[derive(Clone, Error, PartialEq)]
pub enum ToolError {
    /// No parts at all.
    #[error("a tool needs at least one part")]
    NoParts,
    /// The parts form several separate pieces.
    #[error("the parts form {} separate pieces: {}", pieces.len(), list(pieces))]
    Apart {
        /// Names of the parts, piece by piece.
        pieces: Vec<Vec<String>>,
    },
}

/// Prints the text of [`Display`](fmt::Display), so that the error is readable when `main` returns
/// it.
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

    /// Creates a tool of `parts`, held at the origin of its frame, with friction value
    /// [`Tool::FRICTION`]. Parts that touch are joined rigidly.
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

    /// Creates a tool as [`Tool::new`] with these pairs of parts, by index, also joined if they do
    /// not touch.
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
                let stated = by_hand.iter().any(|pair| *pair == [a, b] || *pair == [b, a]);
                // Contact points do not suffice: two crossing bars have no corner inside each
                // other.
                let gap = clearance(
                    (&parts[a].footprint(), &parts[a].pose),
                    (&parts[b].footprint(), &parts[b].pose),
                    2.0 * JOIN_GAP,
                );
                if stated || gap <= JOIN_GAP {
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

    /// Creates a tool as [`Tool::new`] from parts that are known to form one piece by these joints.
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

    /// Creates a tool that levers and does not push: a blade, held at the end of its shaft.
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

    /// Returns the blade of a tool that levers.
    pub fn blade(&self) -> Option<Blade> {
        self.blade.map(|blade| Blade { friction: self.friction, ..blade })
    }

    /// Returns `true` if it has parts to push with.
    pub fn pushes(&self) -> bool {
        !self.parts.is_empty()
    }

    /// Returns the parts as written; a tool with a blade has none.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Returns the height of the highest part, metres; 0 for a tool with a blade.
    pub fn height(&self) -> f64 {
        self.parts.iter().map(|part| part.shape.height()).fold(0.0, f64::max)
    }

    /// Returns the solids that bodies touch: the parts without the seams between flush ones.
    pub fn outline(&self) -> &[Piece] {
        &self.outline
    }

    /// Returns the pairs of parts joined by fixed joints; together they form one rigid piece.
    pub fn joints(&self) -> &[[usize; 2]] {
        &self.joints
    }

    /// Replaces the parts; parts that touch are joined.
    ///
    /// # Errors
    /// [`ToolError`] if there are no parts or they form several pieces.
    pub fn with_parts(self, parts: impl IntoIterator<Item = Part>) -> Result<Self, ToolError> {
        let Self { name, description, grip, friction, .. } = self;
        Ok(Self { description, grip, friction, ..Self::new(name, parts)? })
    }

    /// Sets the grip, the pose of the end effector in the tool frame.
    pub fn held_at(self, grip: Pose) -> Self {
        Self { grip, ..self }
    }

    /// Sets the name.
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// Sets the friction value.
    pub fn friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// Sets the description, one line.
    pub fn described(self, description: impl Into<String>) -> Self {
        Self { description: description.into(), ..self }
    }

    /// Returns the pose of the tool frame in the world when the end effector is at `end_effector`.
    pub fn pose(&self, end_effector: Pose) -> Pose {
        end_effector * self.grip.inverse()
    }

    /// Returns an upper bound of the travel of any outline point while the frame moves evenly
    /// between two poses, metres. Without rotation this is the travel of the frame.
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
                // A round piece that rotates about its centre moves nothing.
                Shape::Cylinder { .. } => centre,
                _ => centre + turn * piece.footprint().bounding_radius(),
            }
        };
        self.outline.iter().map(of).fold(0.0, f64::max)
    }

    /// Returns the pose of part `index` in the world when the tool frame is at `tool`.
    pub fn part_pose(&self, index: usize, tool: &Pose) -> Pose {
        *tool * self.parts[index].pose
    }
}
