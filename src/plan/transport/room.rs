//! Room of a tool and its hand beside other bodies, by the position of the end effector.

use crate::geometry::{Footprint, Grid, Pose, Vector};
use crate::plan::Workspace;
use crate::scene::Situation;

use super::group::Group;
use super::lattice::Solid;
use super::tool_solids::tool_solids;

/// Distance between samples, metres: interpolation at corners is then off by less than a
/// millimetre.
const SPACING: f64 = 0.005;

/// Largest margin that is measured, metres.
const MOST: f64 = 0.02;

/// Clearance between a tool and groups, metres.
pub(super) const BESIDE: f64 = 0.004;

/// Margins of a tool and its hand to some bodies, sampled over positions of the end effector.
pub(super) struct Room {
    grid: Grid,
    margin: Vec<f32>,
}

impl Room {
    fn over(corners: [Vector; 2]) -> Self {
        let sides = (corners[1] - corners[0]) / SPACING;
        let sides = [sides.x, sides.y].map(|side| side.ceil() as usize + 1);
        let grid = Grid::new(corners[0], SPACING, sides);
        Self { margin: vec![MOST as f32; grid.count()], grid }
    }

    /// Computes the room beside everything that no push carries, within a box of positions.
    pub fn beside_fixed(
        workspace: &Workspace,
        pair: (usize, f64),
        (situation, groups): (&Situation, &[Group]),
        corners: [Vector; 2],
    ) -> Self {
        let (scene, state) = (&*situation.scene, &situation.start);
        let mut own = Self::over(corners);
        for (solid, mover) in tool_solids(workspace, pair) {
            for fixed in scene.fixed(mover, solid.span) {
                own.add(&solid, (&fixed.footprint, &fixed.pose), solid.apart);
            }
            for (k, object) in scene.objects.iter().enumerate() {
                let carried = groups.iter().any(|group| group.thing == scene.thing(k));
                if !carried && object.meets(solid.span) {
                    let still = (&object.shape.footprint(), &state.poses[k]);
                    own.add(&solid, still, solid.apart);
                }
            }
        }
        own
    }

    /// Computes the room beside a group at its start.
    pub fn beside(workspace: &Workspace, pair: (usize, f64), group: &Group) -> Self {
        let solids: Vec<Solid> = tool_solids(workspace, pair).map(|(solid, _)| solid).collect();
        let wide = |solids: &[Solid]| {
            let far = |one: &Solid| one.pose.position.norm() + one.footprint.bounding_radius();
            solids.iter().map(far).fold(0.0, f64::max)
        };
        let reach = Vector::repeat(wide(&solids) + wide(&group.solids) + BESIDE + MOST);
        let at = group.lattice.origin;
        let mut own = Self::over([at - reach, at + reach]);
        for solid in &solids {
            for other in group.solids.iter().filter(|other| other.meets(solid)) {
                own.add(solid, (&other.footprint, &other.at(at)), BESIDE);
            }
        }
        own
    }

    fn add(&mut self, solid: &Solid, still: (&Footprint, &Pose), apart: f64) {
        let margin = &mut self.margin;
        solid.near(&self.grid, still, apart + MOST, |place, gap| {
            margin[place] = margin[place].min((gap - apart) as f32);
        });
    }

    /// Returns `true` if the tool has room at a position of the end effector.
    pub fn is_free(&self, position: Vector) -> bool {
        self.grid.interpolated(&self.margin, position).is_none_or(|margin| margin >= 0.0)
    }

    /// Returns the corners of the sampled box, metres.
    pub fn corners(&self) -> [Vector; 2] {
        [self.grid.position(0), self.grid.position(self.grid.count() - 1)]
    }
}
