//! The equations of one frame and their solution: contacts and joints between rigid groups with
//! table friction.
//!
//! Implicit time stepping (Moreau 1988; Stewart and Trinkle 1996, doi:10.1002/(SICI)1097-0207
//! (19960815)39:15<2673::AID-NME972>3.0.CO;2-I) over a whole frame: with the resistance A of
//! every group (see [`super::unknown`]),
//!
//! ```text
//! A (xi - free) = J^T f
//! ```
//!
//! with contacts (f_n >= 0, no overlap) and Coulomb friction (|f_t| <= mu f_n); joints are
//! eliminated. A depends on the length of xi, which is taken from the last iterate (iteratively
//! reweighted least squares). At fixed weights [`super::active_set`] computes the forces.

use nalgebra::Vector3;
use pushplan_kernel::{
    SolverStats,
    settings::{Quantity, SETTLED, UPDATES},
};

use crate::scene::JOINT_ARM;

use super::{
    active_set::ActiveSet,
    constraint::{Constraint, Tie},
    eliminated::Eliminated,
    iterative::IterativeSolver,
    points::Scenery,
    unknown::Unknown,
    warm_start::WarmStart,
};

/// Tolerance in place of [`SETTLED`] for displacements of more than [`FEW`] groups, which saves a
/// seventh of the time. Over 4800 sparse and dense trajectories the mean errors of scenes with
/// fixed joints that touch grow by 0.03 to 0.09 mm, and all other errors by no more than chance.
/// This tolerance would make errors 3 % larger for few objects, and a quarter larger for
/// velocities.
const SETTLED_IN_A_CROWD: f64 = 5e-5;
const FEW: usize = 3;

/// Tolerance in place of [`SETTLED`] for the velocities of more than [`FEW`] groups with joints,
/// which saves an eighth of the time. Over 800 trajectories of nine objects with mixed joints, no
/// error exceeds the error with 1e-5 by more than chance. In dense scenes of six objects, the mean
/// errors are 7 and 2 % larger than with 1e-5, and 3 and 1 % larger than with 1e-7. Without joints
/// they would be a tenth larger.
const SETTLED_IN_JOINTS: f64 = 5e-5;

/// Unknowns and constraints of one frame.
#[derive(Clone, Debug, Default)]
pub(super) struct System {
    pub unknowns: Vec<Unknown>,
    pub quantity: Quantity,
    /// Contacts and joint limits.
    pub constraints: Vec<Constraint>,
    /// Joints, which hold whatever the contacts do.
    pub ties: Vec<Tie>,
    /// Constraints of the last frame, and whether this frame follows it.
    last: Vec<Constraint>,
    follows: bool,
    before: Vec<Vector3<f64>>,
    active_set: ActiveSet,
    iterative: IterativeSolver,
    joints: Eliminated,
    /// Statistics of all systems so far.
    pub tally: SolverStats,
}

impl System {
    /// Sets up the groups of `bodies`, without contacts and joints.
    ///
    /// The initial motion is the present one, plus the gains of the last frame if this frame
    /// follows it. Otherwise groups at rest slide freely, with an assumed displacement of `reach`
    /// metres. These values only affect the start of the iteration. A single group begins at rest,
    /// because its load then has time to follow the contact forces: over 700 pushes of one object
    /// the median error is 0.61 mm, against 0.69 mm otherwise. For several objects it is not
    /// larger.
    pub fn begin(&mut self, scenery: Scenery, reach: f64, starts: Option<&[WarmStart]>) {
        std::mem::swap(&mut self.constraints, &mut self.last);
        let follows = starts.is_some();
        self.follows = follows;
        self.constraints.clear();
        self.ties.clear();
        let Self { unknowns, quantity, tally, .. } = self;
        let bodies = scenery.bodies;
        unknowns.resize_with(bodies.groups.members.len(), Unknown::default);
        let several = unknowns.len() > 1;
        for (unknown, members) in unknowns.iter_mut().zip(&bodies.groups.members) {
            unknown.place(members, scenery);
            // A single group is in contact, otherwise the frame would not be solved.
            unknown.held |= !several;
        }
        for joint in &bodies.joints {
            for object in joint.between {
                unknowns[bodies.groups.of[object].0].held = true;
            }
        }
        for mount in &bodies.mounts {
            unknowns[bodies.groups.of[mount.object].0].held = true;
        }
        for (k, (unknown, members)) in unknowns.iter_mut().zip(&bodies.groups.members).enumerate() {
            if follows && unknown.coasts() {
                unknown.coast(members[0], scenery, *quantity);
                continue;
            }
            unknown.twist = unknown.as_it_began(members, scenery);
            let goes_on = match starts {
                Some(starts) => {
                    unknown.twist += starts[k].moved;
                    true
                }
                None => {
                    unknown.forget();
                    several && unknown.twist != Vector3::zeros()
                }
            };
            let reach = (!goes_on).then_some(reach);
            unknown.weigh(members, scenery, *quantity, reach, tally);
            if !goes_on {
                unknown.twist = unknown.free;
            }
        }
    }

    /// Warm start: initialises constraint `index` with the force of the last frame's constraint
    /// `last`.
    pub fn warm(&mut self, index: usize, last: usize) {
        let (constraint, last) = (&mut self.constraints[index], &self.last[last]);
        constraint.force = last.force;
        constraint.status = last.status;
    }

    /// Copies groups, joints, limits and pressing contacts of the solved system `other`, for
    /// another quantity. The initial motion is the solution of `other`, plus the gain from there in
    /// the last frame if `other` followed one.
    pub fn continue_from(&mut self, other: &System, starts: &[WarmStart], scenery: Scenery) {
        self.follows = true;
        self.unknowns.clone_from(&other.unknowns);
        self.constraints.clear();
        self.constraints.extend(other.constraints.iter().filter(|c| c.presses() || c.is_limit()));
        self.ties.clone_from(&other.ties);
        self.unknowns.iter_mut().for_each(Unknown::turn_to_another);
        if other.follows {
            for (unknown, gain) in self.unknowns.iter_mut().zip(starts) {
                unknown.twist += gain.ended;
            }
        }
        self.weigh(scenery);
    }

    /// Solves for forces and twists. `turn` may rotate rows and move targets after each update of
    /// the weights, according to the motions.
    pub fn solve(
        &mut self,
        scenery: Scenery,
        mut turn: impl FnMut(&mut [Constraint], &mut [Tie], &mut [Unknown]),
    ) {
        self.tally.systems += 1;
        self.tally.constraints += self.constraints.len() as u64;
        self.joints.hang(self.unknowns.len(), &self.ties);
        let settled = match self.quantity {
            _ if self.unknowns.len() <= FEW => SETTLED,
            Quantity::Displacement => SETTLED_IN_A_CROWD,
            Quantity::Velocity if self.ties.is_empty() => SETTLED,
            Quantity::Velocity => SETTLED_IN_JOINTS,
        };
        // After an update without a valid set of contacts, later ones rarely find one. With nine to
        // twelve objects in joints, this saves a sixth of all sets.
        let mut found = true;
        for update in 0..UPDATES {
            if update > 0 {
                self.weigh(scenery);
            }
            turn(&mut self.constraints, &mut self.ties, &mut self.unknowns);
            self.before.clear();
            self.before.extend(self.unknowns.iter().map(|unknown| unknown.twist));
            self.tally.updates += 1;
            self.answer();
            found = found && self.search();
            if !found {
                self.iterate();
            }
            let changed = self.unknowns.iter().zip(&self.before).any(|(now, before)| {
                let change = now.twist - before;
                change.xy().norm().max(change.z.abs() * JOINT_ARM) > settled
            });
            if !changed && (update > 0 || self.follows) {
                return;
            }
        }
    }

    fn weigh(&mut self, scenery: Scenery) {
        let Self { unknowns, quantity, tally, .. } = self;
        for (unknown, members) in unknowns.iter_mut().zip(&scenery.bodies.groups.members) {
            match unknown.coasts() {
                true => unknown.coast(members[0], scenery, *quantity),
                false => unknown.weigh(members, scenery, *quantity, None, tally),
            }
        }
    }

    /// Computes the response of joints and constraints at the present weights.
    fn answer(&mut self) {
        let Self { unknowns, constraints, ties, joints, .. } = self;
        joints.prepare(unknowns, ties);
        constraints.iter_mut().for_each(|constraint| constraint.weighed = false);
    }

    /// Computes forces and twists at fixed weights by the active-set method; returns `true` on
    /// success.
    fn search(&mut self) -> bool {
        let Self { unknowns, constraints, ties, active_set, joints, tally, .. } = self;
        active_set.solve(unknowns, constraints, ties, joints, tally)
    }

    /// Computes forces and twists at fixed weights iteratively.
    fn iterate(&mut self) {
        let Self { unknowns, constraints, ties, iterative, joints, tally, .. } = self;
        tally.approached += 1;
        constraints.iter_mut().for_each(|constraint| joints.weigh(constraint, unknowns));
        iterative.run(unknowns, constraints, ties, joints);
    }
}
