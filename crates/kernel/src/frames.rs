//! Frames side by side, from their contacts to motions.

use nalgebra::{SVector, Vector3};
use pulp::{Simd, WithSimd};

use crate::{
    SingleBodyFrame, Vector,
    forces::{self, MOST, Pressing},
    lanes::{Lanes, Which, dot, left_of, minus, norm},
    motion::Motion,
    object::{Inverse, Moves, Object},
    settings::{HALF, JOINT_ARM, Quantity, SETTLED, UPDATES, WHOLE},
    solution::SingleBodySolution,
    stats::SolverStats,
    touching::{Follows, Look, Touching},
};

/// Frames in lanes, with their initial states.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frames<'a, const N: usize> {
    present: Which<N>,
    object: Object<'a, N>,
    contacts: [Touching<N>; MOST],
}

impl<'a, const N: usize> Frames<'a, N> {
    /// Sets frame `k`.
    #[inline(always)]
    pub fn set(&mut self, k: usize, frame: &SingleBodyFrame<'a>) {
        let object = &mut self.object;
        self.present.set(k, true);
        object.feet[k] = Some(frame.feet);
        set(&mut object.place, k, frame.position);
        if !frame.feet.round {
            set(&mut object.axis, k, frame.axis);
        }
        for (lanes, value) in [
            (&mut object.mass, frame.mass),
            (&mut object.load, frame.load),
            (&mut object.lean, frame.lean),
            (&mut object.support, frame.support),
            (&mut object.spin, frame.spin),
            (&mut object.duration, frame.duration),
            (&mut object.reach, frame.reach),
        ] {
            lanes.0[k] = value;
        }
        set(&mut object.coast, k, frame.coast);
        set(&mut object.velocity, k, frame.velocity);
        if let Some(radius) = frame.radius {
            object.radius.0[k] = radius;
            object.round.set(k, true);
        }
        for (touching, contact) in self.contacts.iter_mut().zip(frame.contacts()) {
            touching.present.set(k, true);
            set(&mut touching.normal, k, contact.normal);
            set(&mut touching.arm, k, contact.arm);
            set(&mut touching.given, k, contact.given);
            touching.gap.0[k] = contact.gap;
            touching.friction.0[k] = contact.friction;
            touching.given_turn.0[k] = contact.given_turn;
            if let Some(radius) = contact.radius {
                touching.radius.0[k] = radius;
                touching.round.set(k, true);
            }
            match contact.follows {
                Follows::Nothing => {}
                Follows::First => touching.first.set(k, true),
                Follows::Second => touching.second.set(k, true),
                Follows::Both => touching.both.set(k, true),
                Follows::Between(p, q) => {
                    touching.between.set(k, true);
                    set(&mut touching.points[0], k, p);
                    set(&mut touching.points[1], k, q);
                }
            }
        }
    }

    /// Solves all frames in vectors of a kind. An entry is `None` if the contact forces were not
    /// found.
    pub fn by(&self, simd: impl Simd, tally: &mut SolverStats) -> [Option<SingleBodySolution>; N] {
        simd.vectorize(Solving { frames: self, tally })
    }

    /// Returns the displacements, the contact forces, and the frames in which these were found.
    #[inline(always)]
    fn displace(&self, tally: &mut SolverStats) -> (Moves<N>, [Pressing<N>; MOST], Which<N>) {
        let Self { present, object, contacts } = self;
        let mut moves = Moves::begin(object);
        let mut pressing = [Pressing::default(); MOST];
        for (pressing, touching) in pressing.iter_mut().zip(contacts) {
            pressing.present = touching.present;
            pressing.friction = touching.friction;
        }
        let (mut ended, mut presses) = (moves, pressing);
        let (mut left, mut found) = (*present, *present);
        for update in 0..UPDATES {
            let look = Look::new(object, &moves, HALF);
            if update > 0 {
                moves.weigh(object, Quantity::Displacement, &look.turn, left, tally);
            }
            for (pressing, touching) in pressing.iter_mut().zip(contacts) {
                if touching.present.any() {
                    let met = touching.at(object, &look);
                    pressing.to = met.rows();
                    pressing.target = touching.target(object, &moves, &met);
                }
            }
            let settled = self.settle(&mut moves, &mut pressing, left, tally);
            found = found & (settled.found | !left);
            left = left & found;
            let ends = match update {
                0 => Which::NONE,
                _ if update + 1 == UPDATES => left,
                _ => left & !settled.changed,
            };
            if ends.any() {
                ended.take(ends, &moves);
                for (presses, pressing) in presses.iter_mut().zip(&pressing) {
                    presses.take(ends, pressing);
                }
                left = left & !ends;
            }
            if !left.any() {
                break;
            }
        }
        (ended, presses, found)
    }

    /// Returns the velocities at the frame's end, times its duration, from the displacements and
    /// their forces in the frames `found`. Contacts that have closed stay closed.
    #[inline(always)]
    fn release(
        &self,
        ended: &Moves<N>,
        pressed: &[Pressing<N>; MOST],
        found: &mut Which<N>,
        tally: &mut SolverStats,
    ) -> Moves<N> {
        let Self { object, contacts, .. } = self;
        let (mut moves, mut pressing) = (*ended, *pressed);
        let look = Look::new(object, ended, WHOLE);
        moves.turn_to_another();
        moves.weigh(object, Quantity::Velocity, &look.turn, *found, tally);
        for (pressing, touching) in pressing.iter_mut().zip(contacts) {
            pressing.keep(pressing.presses());
            if pressing.present.any() {
                let met = touching.at(object, &look);
                pressing.to = met.rows();
                let given = touching.given;
                pressing.target = [dot(given, met.normal), dot(given, left_of(met.normal))];
            }
            tally.constraints += (pressing.present & *found).count();
        }
        let (mut end, mut left) = (moves, *found);
        for update in 0..UPDATES {
            if update > 0 {
                moves.weigh(object, Quantity::Velocity, &look.turn, left, tally);
            }
            let settled = self.settle(&mut moves, &mut pressing, left, tally);
            *found = *found & (settled.found | !left);
            left = left & *found;
            let ends = if update + 1 == UPDATES { left } else { left & !settled.changed };
            if ends.any() {
                end.take(ends, &moves);
                left = left & !ends;
            }
            if !left.any() {
                break;
            }
        }
        end
    }

    /// Solves for forces and twists at fixed weights.
    #[inline(always)]
    fn settle(
        &self,
        moves: &mut Moves<N>,
        pressing: &mut [Pressing<N>; MOST],
        of: Which<N>,
        tally: &mut SolverStats,
    ) -> Settled<N> {
        tally.updates += of.count();
        let before = moves.twist;
        let found = forces::solve(moves, pressing, of, tally);
        let [x, y, turn] = minus(moves.twist, before);
        let change = norm([x, y]).max(turn.abs() * Lanes::all(JOINT_ARM));
        Settled { found, changed: Lanes::all(SETTLED).below(change) }
    }
}

/// Outcome of an update.
struct Settled<const N: usize> {
    /// Frames in which forces were found.
    found: Which<N>,
    /// Frames in which the motion has changed by more than the tolerance that ends the updates.
    changed: Which<N>,
}

/// Sets a vector of frame `k`.
#[inline(always)]
fn set<const K: usize, const N: usize>(
    lanes: &mut [Lanes<N>; K],
    k: usize,
    vector: SVector<f64, K>,
) {
    for row in 0..K {
        lanes[row].0[k] = vector[row];
    }
}

/// Frames that are solved in the processor's widest vectors.
struct Solving<'a, 'b, const N: usize> {
    frames: &'b Frames<'a, N>,
    tally: &'b mut SolverStats,
}

impl<const N: usize> WithSimd for Solving<'_, '_, N> {
    type Output = [Option<SingleBodySolution>; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self { frames, tally } = self;
        let Frames { present, object, contacts } = frames;
        tally.systems += 2 * present.count();
        for k in 0..N {
            if let Some(feet) = object.feet[k] {
                tally.weigh(feet.count);
            }
        }
        for contact in contacts {
            tally.constraints += contact.present.count();
        }
        let (ended, presses, mut found) = frames.displace(tally);
        let end = frames.release(&ended, &presses, &mut found, tally);
        let mut solutions = [None; N];
        for (k, place) in solutions.iter_mut().enumerate().filter(|&(k, _)| found.has(k)) {
            let mut solution = SingleBodySolution::default();
            let duration = object.duration.0[k];
            let at =
                |lanes: &[Lanes<N>; 3]| Vector3::new(lanes[0].0[k], lanes[1].0[k], lanes[2].0[k]);
            if at(&ended.pressed) != Vector3::zeros() {
                let (twist, end, arm) = (at(&ended.twist), at(&end.twist), Vector::zeros());
                solution.motion = Some(Motion {
                    shift: twist.xy() + arm,
                    turn: twist.z,
                    velocity: shift(&end, arm) / duration,
                    spin: end.z / duration,
                });
            }
            for (c, contact) in presses.iter().enumerate() {
                let [normal, tangent] = [0, 1].map(|row| contact.force[row].0[k]);
                solution.normal[c] = normal;
                solution.pressed[c] = at(&contact.to[0]) * normal + at(&contact.to[1]) * tangent;
            }
            solution.inverse = Inverse(ended.inverse.0.map(|lanes| Lanes([lanes.0[k]])));
            let rows = presses.iter().map(|contact| contact.rows(k)).sum();
            solution.effort = [ended.updates.0[k] as u32, rows, end.updates.0[k] as u32];
            *place = Some(solution);
        }
        solutions
    }
}

/// Returns the displacement of a point `arm` metres from the centre, to first order, metres.
#[inline(always)]
fn shift(twist: &Vector3<f64>, arm: Vector) -> Vector {
    Vector::new(twist.x, twist.y) + twist.z * Vector::new(-arm.y, arm.x)
}
