//! Candidates: pushes described relative to the pushed object, each with its tool and grip.
//!
//! A placed push is described by the quantities that determine its effect: the part of the tool
//! whose leading face makes contact, the direction, the lateral offset and the length. The start of
//! the end effector follows from the object's pose at that moment (see
//! [`super::Workspace::place`]).

use serde::{Deserialize, Serialize};

/// Start of a candidate's push.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// Just before the object, so that the leading face of a part meets it.
    Placed {
        /// Index of the part in the tool.
        part: usize,
        /// Signed lateral distance of the object's centre from the centre line of the
        /// contacting face, left of the direction positive, metres.
        offset: f64,
    },
    /// Robot's home, or the end of the last push.
    Chained,
}

/// Push of a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CandidatePush {
    /// Index of the tool among the offered ones.
    pub tool: usize,
    /// Rotation of the end effector relative to world +x, radians.
    pub grip_yaw: f64,
    /// Index of the object pushed by a placed push.
    pub object: usize,
    /// Start of the push.
    pub start: Start,
    /// Heading of the motion, radians from world +x.
    pub direction: f64,
    /// Travel, metres.
    pub length: f64,
    /// Position uncertainty of the object at the start of the push, metres. The tool is set down
    /// this much farther away; zero for the first push.
    pub room: f64,
}

impl CandidatePush {
    /// Returns the tool and grip yaw.
    pub fn grip(&self) -> (usize, f64) {
        (self.tool, self.grip_yaw)
    }
}

/// Sequence of pushes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// Pushes in order.
    pub pushes: Vec<CandidatePush>,
}

impl Candidate {
    /// Returns the candidate with one more push.
    pub fn then(&self, push: CandidatePush) -> Self {
        let mut next = self.clone();
        next.pushes.push(push);
        next
    }

    /// Returns the tool and grip yaw of the first push, if any.
    pub fn grip(&self) -> Option<(usize, f64)> {
        self.pushes.first().map(CandidatePush::grip)
    }

    /// Returns `true` if all pushes use one tool and one grip yaw.
    pub fn has_one_grip(&self) -> bool {
        self.pushes.windows(2).all(|pair| pair[0].grip() == pair[1].grip())
    }

    /// Returns the number of tool changes.
    pub fn tool_changes(&self) -> usize {
        self.pushes.windows(2).filter(|pair| pair[0].tool != pair[1].tool).count()
    }

    /// Returns `true` if both push the same objects with the same tools, grip yaws, faces and
    /// directions. They then differ only in offsets and lengths, which refinement changes anyway.
    pub fn is_variant_of(&self, other: &Self) -> bool {
        let face = |push: &CandidatePush| match push.start {
            Start::Placed { part, .. } => Some(part),
            Start::Chained => None,
        };
        let alike = |a: &CandidatePush, b: &CandidatePush| {
            a.grip() == b.grip()
                && (a.object, a.direction, face(a)) == (b.object, b.direction, face(b))
        };
        self.pushes.len() == other.pushes.len()
            && self.pushes.iter().zip(&other.pushes).all(|(a, b)| alike(a, b))
    }
}
