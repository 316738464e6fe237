//! A tool: cuboid parts joined into one rigid piece, held by the end effector at its grip.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::{Footprint, Pose, Shape, clearance};

use super::DisjointSets;

/// Parts whose gap is at most this are joined rigidly, metres.
///
/// Wide enough for the rounding of sizes written in whole millimetres and turned by degrees.
pub const JOIN_GAP: f64 = 1e-4;

/// One solid of a tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Unique within the tool.
    pub name: String,
    /// Its solid, upright: a cuboid, or a cylinder for a round finger or hand.
    pub shape: Shape,
    /// Pose of the centre in the tool frame.
    pub pose: Pose,
}

impl Part {
    /// A cuboid of these full extents (metres).
    pub fn cuboid(name: impl Into<String>, size: [f64; 3], pose: Pose) -> Self {
        Self { name: name.into(), shape: Shape::Cuboid { size }, pose }
    }

    /// What it covers on the table.
    pub fn footprint(&self) -> Footprint {
        self.shape.footprint()
    }
}

/// A rigid assembly of solids, moved by the end effector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tool {
    /// Unique within a library.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Pose of the end effector in the tool frame.
    pub grip: Pose,
    /// Friction value.
    pub friction: f64,
    /// At least one.
    pub parts: Vec<Part>,
    /// Pairs of parts joined by a fixed joint; together they make one rigid piece.
    pub joints: Vec<[usize; 2]>,
}

/// Why parts do not make a tool.
#[derive(Clone, Debug, Error, PartialEq)]
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

fn list(pieces: &[Vec<String>]) -> String {
    let pieces: Vec<String> = pieces.iter().map(|piece| piece.join(" + ")).collect();
    pieces.join(" | ")
}

impl Tool {
    /// Joins the parts that touch, and the pairs in `by_hand`, and checks that one piece results.
    ///
    /// # Errors
    /// [`ToolError`] if there are no parts or they form several pieces.
    pub fn assemble(
        name: String,
        description: String,
        grip: Pose,
        friction: f64,
        parts: Vec<Part>,
        by_hand: &[[usize; 2]],
    ) -> Result<Self, ToolError> {
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
        Ok(Self { name, description, grip, friction, parts, joints })
    }

    /// Pose of the tool frame in the world when the end effector is at `end_effector`.
    pub fn pose(&self, end_effector: Pose) -> Pose {
        end_effector * self.grip.inverse()
    }

    /// Pose of part `index` in the world when the tool frame is at `tool`.
    pub fn part_pose(&self, index: usize, tool: &Pose) -> Pose {
        *tool * self.parts[index].pose
    }
}
