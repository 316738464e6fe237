//! A contact as one of its two bodies sees it.

use crate::geometry::Vector;
use pushplan_kernel::Motion;

use super::{bodies::Partner, points::Contact};

/// A contact as one of its two bodies, the receiver, sees it.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// The object that sees it.
    pub receiver: usize,
    /// The other body.
    pub sender: Partner,
    /// Unit, into the receiver.
    pub normal: Vector,
    /// From the centres of receiver and sender to the points on them, metres; zero for a sender
    /// whose motion is given.
    pub arms: [Vector; 2],
    contact: &'a Contact,
}

impl Contact {
    /// Both sights of the contact: of its object, and of the other one if that can move.
    pub fn sights(&self) -> [Option<Sight<'_>>; 2] {
        let [arm, other_arm] = [self.arm, self.other_arm];
        let first = Sight {
            receiver: self.object,
            sender: self.with,
            normal: self.normal,
            arms: [arm, other_arm],
            contact: self,
        };
        let second = match self.with {
            Partner::Object(receiver) => Some(Sight {
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

impl Sight<'_> {
    /// Displacement of the sender's point when objects move as in `motions`, metres.
    pub fn sent(&self, motions: &[Motion]) -> Vector {
        match self.sender {
            Partner::Object(sender) => motions[sender].at(self.arms[1]),
            _ => self.contact.given,
        }
    }

    /// How far the bodies would overlap if the receiver only coasted while the sender moves as
    /// in `motions`, metres.
    pub fn overlap(&self, coast: &Motion, motions: &[Motion]) -> f64 {
        let relative = self.sent(motions) - coast.at(self.arms[0]);
        (relative.dot(&self.normal) - self.contact.gap).max(0.0)
    }
}
