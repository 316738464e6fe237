//! Bounding box of a picture's content on the table.

use pushplan::{
    outcome::Trajectory,
    scene::{Annulus, Scene},
    task::{Mark, ShownGoal, ToolMotion},
};

use super::view::Bounds;

/// Margin beyond the scene within which paths count, metres, so that a wild prediction does not
/// shrink the rest to a dot.
const FOLLOW: f64 = 1.0;

/// Content that must be visible.
pub struct Extent<'a> {
    pub scene: &'a Scene,
    pub goals: Vec<ShownGoal>,
    pub reach: Option<Annulus>,
    pub motions: &'a [ToolMotion],
    pub trajectories: Vec<&'a Trajectory>,
}

impl Extent<'_> {
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::empty();
        for object in &self.scene.objects {
            bounds.add_body(&object.shape.footprint(), &object.pose);
        }
        for obstacle in &self.scene.obstacles {
            bounds.add_body(&obstacle.shape().footprint(), &obstacle.pose);
        }
        for region in &self.scene.keep_out {
            bounds.add_body(&region.footprint(), &region.pose);
        }
        for goal in &self.goals {
            if goal.placed {
                bounds.add(goal.centre, 0.0);
            }
            for mark in &goal.marks {
                match mark {
                    Mark::Area(area) => bounds.add_body(&area.shape.footprint(), &area.pose),
                    Mark::Disc { centre, radius } => bounds.add(*centre, *radius),
                    Mark::Headings { swing: Some(swing), .. } => bounds.add(swing.end(), 0.0),
                    _ => {}
                }
            }
        }
        if let Some(Annulus { centre, radii: [near, _] }) = self.reach {
            bounds.add(centre, near);
        }
        self.motions.iter().for_each(|motion| self.add_motion(&mut bounds, motion));
        let near = bounds;
        for frame in self.trajectories.iter().flat_map(|trajectory| &trajectory.frames) {
            for (object, pose) in self.scene.objects.iter().zip(&frame.state.poses) {
                if near.holds(pose.position, FOLLOW) {
                    bounds.add_body(&object.shape.footprint(), pose);
                }
            }
        }
        bounds
    }

    fn add_motion(&self, bounds: &mut Bounds, motion: &ToolMotion) {
        for pose in motion.strokes.iter().flat_map(|stroke| [&stroke.from, &stroke.to]) {
            bounds.add((*pose * motion.tool.grip).position, 0.01);
            for (k, part) in motion.tool.parts().iter().enumerate() {
                bounds.add_body(&part.footprint(), &motion.tool.part_pose(k, pose));
            }
        }
    }
}
