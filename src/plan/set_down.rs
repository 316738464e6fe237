//! Set-down of the tool before a push.
//!
//! The tool comes down from above. It therefore stands off from the solid that it meets, and from
//! the parts of the same object that overhang it, such as the cup of a goblet.

use crate::geometry::{Footprint, Pose, Vector, travel_to_contact};
use crate::scene::State;

use super::workspace::axes;
use super::{CandidatePush, Infeasible, Placement, STAND_OFF, Start, Workspace};

/// Tolerance for rounding in comparisons of closed forms, metres.
const ROUNDING: f64 = 1e-9;

impl Workspace<'_> {
    /// Returns the placement of the tool at the start of a candidate's push. In a placed push, the
    /// part's leading face meets the object with the given offset, after the stand-off and the
    /// push's room, or farther back if parts of the object overhang the tool there. A chained push
    /// starts at `previous` or at home.
    ///
    /// # Errors
    /// Returns [`Infeasible::NoContact`] or [`Infeasible::OtherPartFirst`]. Reach and collisions
    /// are checked by [`Workspace::margins`].
    pub fn place(
        &self,
        state: &State,
        push: &CandidatePush,
        previous: Option<Vector>,
    ) -> Result<Placement, Infeasible> {
        let room = push.room;
        let Start::Placed { part, offset } = push.start else {
            let start = previous.unwrap_or(self.task.robot.home);
            return Ok(Placement { room, ..Placement::at(start) });
        };
        let (tool, grip_yaw) = (&*self.tools[push.tool], push.grip_yaw);
        let (footprint, at) = self.object(push.object, state);
        let (ahead, left) = axes(push.direction);
        let object = &self.task.scene.objects[push.object];
        let meets = |k: usize| object.meets(self.span_of(&tool.parts()[k]));
        if !meets(part) {
            return Err(Infeasible::NoContact);
        }
        // All poses are computed with the end effector at the world's origin and shifted later.
        let frame = tool.pose(Pose { position: Vector::zeros(), heading: grip_yaw });
        let parts: Vec<(Footprint, Pose)> = (0..tool.parts().len())
            .map(|k| (tool.parts()[k].footprint(), tool.part_pose(k, &frame)))
            .collect();
        let (face, pose) = parts[part];
        let stand_off = STAND_OFF + room;
        let behind = face.bounding_radius() + footprint.bounding_radius() + 2.0 * stand_off;
        let lateral = at.position.dot(&left) - offset;
        let far = left * lateral + ahead * (at.position.dot(&ahead) - behind);
        let from = Pose { position: far, heading: pose.heading };
        let travel = travel_to_contact((&face, &from), ahead, (&footprint, &at))
            .ok_or(Infeasible::NoContact)?;
        let near = far + ahead * (travel - stand_off) - pose.position;
        let back = self.overhang(state, push, (&parts, near), stand_off);
        let placement = Placement { start: near - ahead * back, room, back };
        for (other, (face, pose)) in parts.iter().enumerate() {
            let there = Pose { position: pose.position + placement.start, ..*pose };
            let first = travel_to_contact((face, &there), ahead, (&footprint, &at));
            let sooner = |travel: f64| travel < placement.approach() - ROUNDING;
            if other != part && meets(other) && first.is_some_and(sooner) {
                return Err(Infeasible::OtherPartFirst);
            }
        }
        Ok(placement)
    }

    /// Returns the distance by which the tool must be set down behind the position `near` of the
    /// end effector, so that each of its `parts` stands off from the solids of the pushed object
    /// above it, metres.
    fn overhang(
        &self,
        state: &State,
        push: &CandidatePush,
        (parts, near): (&[(Footprint, Pose)], Vector),
        stand_off: f64,
    ) -> f64 {
        let scene = &self.task.scene;
        if !scene.has_raised(push.object) {
            return 0.0;
        }
        let (ahead, _) = axes(push.direction);
        let tool = &self.tools[push.tool];
        let raised: Vec<usize> = scene.parts_of(scene.thing(push.object)).collect();
        let pairs = parts.iter().zip(tool.parts()).flat_map(|((shape, pose), part)| {
            let top = self.span_of(part)[1];
            let over = raised.iter().filter(move |k| scene.objects[**k].z >= top);
            over.map(move |k| (shape, Pose { position: pose.position + near, ..*pose }, *k))
        });
        let travel = |shape: &Footprint, pose: &Pose, k: usize, back: f64| {
            let (above, at) = self.object(k, state);
            let pose = Pose { position: pose.position - ahead * back, ..*pose };
            travel_to_contact((shape, &pose), ahead, (&above, &at))
        };
        // Each pair that is too close determines the least distance that clears it. Behind that,
        // other pairs may be too close.
        let mut back = 0.0;
        loop {
            let needed = pairs.clone().filter_map(|(shape, pose, k)| {
                travel(shape, &pose, k, back).filter(|travel| *travel < stand_off - ROUNDING)?;
                let (above, at) = self.object(k, state);
                let ahead_of = (pose.position - at.position).dot(&ahead);
                let far = ahead_of + shape.bounding_radius() + above.bounding_radius();
                Some(far + stand_off - travel(shape, &pose, k, far)?)
            });
            let next = needed.fold(back, f64::max);
            if next <= back + ROUNDING {
                return back;
            }
            back = next;
        }
    }
}
