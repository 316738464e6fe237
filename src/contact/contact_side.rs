//! A contact from the view of one of its two bodies.

use crate::geometry::Vector;
use pushplan_kernel::Motion;

use super::{bodies::Partner, points::Contact};

/// A contact from the view of one of its two bodies, the receiver.
#[derive(Clone, Copy, Debug)]
pub struct ContactSide<'a> {
    /// Index of the receiving object.
    pub receiver: usize,
    /// The other body.
    pub sender: Partner,
    /// Unit normal, into the receiver.
    pub normal: Vector,
    /// Vectors from the centres of receiver and sender to the points on them, metres; zero for a
    /// sender with prescribed motion.
    pub arms: [Vector; 2],
    contact: &'a Contact,
}

impl Contact {
    /// Returns the views of both bodies; `None` for a body that cannot move.
    pub fn sides(&self) -> [Option<ContactSide<'_>>; 2] {
        let [arm, other_arm] = [self.arm, self.other_arm];
        let first = ContactSide {
            receiver: self.object,
            sender: self.with,
            normal: self.normal,
            arms: [arm, other_arm],
            contact: self,
        };
        let second = match self.with {
            Partner::Object(receiver) => Some(ContactSide {
                receiver,
                sender: Partner::Object(self.object),
                normal: -self.normal,
                arms: [other_arm, arm],
                contact: self,
            }),
            _ => None,
        };
        [Some(first), second]
    }
}

impl ContactSide<'_> {
    /// Returns the displacement of the sender's point when objects move by `motions`, metres.
    pub fn sent(&self, motions: &[Motion]) -> Vector {
        match self.sender {
            Partner::Object(sender) => motions[sender].at(self.arms[1]),
            _ => self.contact.given,
        }
    }

    /// Returns the overlap of the bodies if the receiver only slides freely while the sender moves
    /// by `motions`, metres.
    pub fn overlap(&self, coast: &Motion, motions: &[Motion]) -> f64 {
        let relative = self.sent(motions) - coast.at(self.arms[0]);
        (relative.dot(&self.normal) - self.contact.gap).max(0.0)
    }
}
