//! The equations of one frame: what contacts and joints ask of rigid groups that rub on the
//! table, and their solution.
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
//! reweighted least squares). Forces follow from accelerated projected Jacobi steps, each body's
//! mass split among its constraints (Tonge, Benevolenski and Voroshilov 2012,
//! doi:10.1145/2185520.2185601; Nesterov 1983), which unlike Gauss-Seidel do not depend on the
//! order of anything.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2, Vector3};

use crate::scene::{DisjointSets, JOINT_ARM, State};

use super::{
    active::{ActiveSet, Equations},
    bodies::Bodies,
    constraint::{Constraint, GIVE, Tie},
    index::GroupIndex,
    motion::Motion,
    unknown::{Quantity, Unknown},
};

/// Iterations between two updates of the weights A, and the most of these updates.
const ITERATIONS: usize = 10;
const UPDATES: usize = 8;

/// A change of a whole round of iterations below this ends them, metres.
const SETTLED: f64 = 1e-5;

/// Unknowns and rows of one frame.
#[derive(Clone, Debug, Default)]
pub(super) struct System {
    pub unknowns: Vec<Unknown>,
    pub quantity: Quantity,
    /// Contacts and limits, met by iteration.
    pub constraints: Vec<Constraint>,
    /// Joints, eliminated: whatever the contacts do, these hold.
    pub ties: Vec<Tie>,
    /// (J A^-1 J^T)^-1 of all ties.
    tied: DMatrix<f64>,
    asked: DVector<f64>,
    /// Which groups hang together by ties: the number of the mechanism of each.
    mechanism: Vec<usize>,
    sets: DisjointSets,
    active: Vec<f64>,
    /// The constraints of the last frame, and whether this one follows it.
    last: Vec<Constraint>,
    follows: bool,
    before: Vec<Vector3<f64>>,
    exact: ActiveSet,
}

impl System {
    /// The groups of `bodies`, without contacts and joints yet. They begin as they ended the last
    /// time if the equations are those of a frame that `follows` it, else coasting; `reach` is
    /// how far they are then first assumed to move (metres). All that only decides where the
    /// iteration begins.
    pub fn begin(
        &mut self,
        bodies: &Bodies,
        state: &State,
        coasts: &[Motion],
        duration: f64,
        reach: f64,
        follows: bool,
    ) {
        std::mem::swap(&mut self.constraints, &mut self.last);
        self.follows = follows;
        self.constraints.clear();
        self.ties.clear();
        self.unknowns.resize_with(bodies.groups.members.len(), Unknown::default);
        let of = (self.quantity, duration);
        for (unknown, members) in self.unknowns.iter_mut().zip(&bodies.groups.members) {
            unknown.place(members, state);
            if !follows {
                unknown.forget();
            }
            unknown.pull((bodies, members), state, of, coasts);
            unknown.weigh((bodies, members), state, of, (!follows).then_some(reach));
            if !follows {
                unknown.twist = unknown.free;
            }
        }
    }

    /// Lets constraint `index` begin with the force of the last frame's constraint `last`.
    pub fn warm(&mut self, index: usize, last: usize) {
        let (constraint, last) = (&mut self.constraints[index], &self.last[last]);
        constraint.force = last.force;
        constraint.own = last.own;
    }

    /// The same groups, contacts and joints as in `other`, which has been solved, but for another
    /// quantity; it begins where that has ended.
    pub fn continue_from(
        &mut self,
        other: &System,
        bodies: &Bodies,
        state: &State,
        coasts: &[Motion],
        duration: f64,
    ) {
        self.unknowns.clone_from(&other.unknowns);
        self.constraints.clone_from(&other.constraints);
        self.ties.clone_from(&other.ties);
        let of = (self.quantity, duration);
        for (unknown, members) in self.unknowns.iter_mut().zip(&bodies.groups.members) {
            unknown.pull((bodies, members), state, of, coasts);
        }
        self.weigh(bodies, state, duration);
    }

    /// Solves for forces and twists. `turn` may turn rows and move targets after each update of
    /// the weights, as it follows from how everything moves.
    pub fn solve(
        &mut self,
        bodies: &Bodies,
        state: &State,
        duration: f64,
        mut turn: impl FnMut(&mut [Constraint], &mut [Tie], &mut [Unknown]),
    ) {
        self.find_mechanisms();
        for update in 0..UPDATES {
            if update > 0 {
                self.weigh(bodies, state, duration);
            }
            turn(&mut self.constraints, &mut self.ties, &mut self.unknowns);
            self.before.clear();
            self.before.extend(self.unknowns.iter().map(|unknown| unknown.twist));
            self.iterate();
            let changed = self.unknowns.iter().zip(&self.before).any(|(now, before)| {
                let change = now.twist - before;
                change.xy().norm().max(change.z.abs() * JOINT_ARM) > SETTLED
            });
            if !changed && (update > 0 || self.follows) {
                return;
            }
        }
    }

    fn weigh(&mut self, bodies: &Bodies, state: &State, duration: f64) {
        let of = (self.quantity, duration);
        for (unknown, members) in self.unknowns.iter_mut().zip(&bodies.groups.members) {
            unknown.weigh((bodies, members), state, of, None);
        }
    }

    /// The forces at fixed weights.
    fn iterate(&mut self) {
        self.tie();
        for k in 0..self.constraints.len() {
            let (own, alone) = self.compliance(&self.constraints[k]);
            let constraint = &mut self.constraints[k];
            let before = (constraint.own[0] + constraint.own[1]).trace();
            // Softer weights need less force for the same motion.
            constraint.force *= before / (own[0] + own[1]).trace();
            constraint.trial = constraint.force;
            constraint.own = own;
            constraint.give = 0.5 * GIVE * alone;
        }
        // The answer of a single one is exact as it is.
        if self.constraints.len() < 2 || !self.settle_contacts() {
            self.approach();
        }
        self.constraints.iter_mut().for_each(|c| c.trial = c.force);
        self.spread();
    }

    /// Finds the forces exactly; whether that went well.
    fn settle_contacts(&mut self) -> bool {
        let mut active = std::mem::take(&mut self.exact);
        let found = self.find_active(&mut active);
        self.exact = active;
        for c in &mut self.constraints {
            if found {
                c.force = c.trial;
            } else {
                c.trial = c.force;
            }
        }
        found
    }

    fn find_active(&mut self, active: &mut ActiveSet) -> bool {
        self.spread();
        self.read();
        active.begin(&self.constraints);
        self.constraints.iter_mut().for_each(|c| c.trial = Vector2::zeros());
        self.spread();
        self.read();
        active.set_free(&self.constraints);
        for _ in ActiveSet::rounds() {
            let Self { unknowns, constraints, ties, tied, .. } = self;
            let equations = Equations { unknowns, ties, tied };
            if active.solve(&equations, constraints).is_none() {
                return false;
            }
            self.spread();
            self.read();
            if active.agrees(&self.constraints) {
                return true;
            }
        }
        false
    }

    fn read(&mut self) {
        let Self { unknowns, constraints, .. } = self;
        constraints.iter_mut().for_each(|c| c.read(unknowns));
    }

    /// Accelerated projected Jacobi steps from the forces as they are.
    fn approach(&mut self) {
        let mut momentum = 1.0f64;
        for _ in 0..ITERATIONS {
            self.spread();
            let Self { unknowns, constraints, mechanism, active, .. } = self;
            active.fill(0.0);
            for constraint in constraints.iter_mut() {
                constraint.read(unknowns);
                if constraint.presses(&constraint.trial) || constraint.asks() {
                    let first = mechanism[constraint.a.0];
                    active[first] += 1.0;
                    match constraint.b.map(|b| mechanism[b.0]) {
                        Some(second) if second != first => active[second] += 1.0,
                        _ => {}
                    }
                }
            }
            let previous = momentum;
            momentum = 0.5 * (1.0 + (1.0 + 4.0 * momentum * momentum).sqrt());
            let carry = (previous - 1.0) / momentum;
            let (mut against, mut largest) = (0.0, 0.0f64);
            for constraint in constraints.iter_mut() {
                let mut k = constraint.own[0] * active[mechanism[constraint.a.0]].max(1.0);
                if let Some(b) = constraint.b {
                    k += constraint.own[1] * active[mechanism[b.0]].max(1.0);
                }
                let force = constraint.answer(&k);
                let change = force - constraint.force;
                let moved = k * change;
                against += (constraint.trial - force).dot(&moved);
                largest = largest.max(moved.amax());
                constraint.trial = force + carry * change;
                constraint.force = force;
            }
            // Momentum that points away from the answer is dropped (O'Donoghue and Candes
            // 2015, doi:10.1007/s10208-013-9150-3).
            if against > 0.0 {
                momentum = 1.0;
                constraints.iter_mut().for_each(|c| c.trial = c.force);
            }
            // The answer of a single one is exact.
            if largest < 0.5 * SETTLED || constraints.len() < 2 {
                break;
            }
        }
    }

    /// Numbers the mechanisms: groups that ties connect.
    fn find_mechanisms(&mut self) {
        self.sets.reset(self.unknowns.len());
        for tie in &self.ties {
            self.sets.join([tie.a.0, tie.b.0]);
        }
        self.mechanism.clear();
        self.mechanism.extend_from_slice(self.sets.names());
        self.active.resize(self.unknowns.len(), 0.0);
    }

    /// Prepares the elimination of all ties at the present weights.
    fn tie(&mut self) {
        let count = self.ties.len();
        if count == 0 {
            return;
        }
        let mut whole = DMatrix::zeros(2 * count, 2 * count);
        for (p, first) in self.ties.iter().enumerate() {
            for (q, second) in self.ties.iter().enumerate().take(p + 1) {
                for group in [first.a, first.b] {
                    let (Some(j), Some(k)) = (first.side(group), second.side(group)) else {
                        continue;
                    };
                    let inverse = &self.unknowns[group.0].inverse;
                    for (r, j) in j.iter().enumerate() {
                        for (s, k) in k.iter().enumerate() {
                            let value = j.dot(&(inverse * k));
                            whole[(2 * p + r, 2 * q + s)] += value;
                            if p != q {
                                whole[(2 * q + s, 2 * p + r)] += value;
                            }
                        }
                    }
                }
            }
        }
        for k in 0..2 * count {
            whole[(k, k)] *= 1.0 + 1e-9;
        }
        // Joints form no loops, so their equations are independent and this always succeeds;
        // were they not, going without them is what a reader would see.
        self.tied = match whole.cholesky() {
            Some(factor) => factor.inverse(),
            None => DMatrix::zeros(2 * count, 2 * count),
        };
    }

    /// J M J^T of either side of a constraint, M being A^-1 with the ties eliminated; all of it
    /// on the first side where both belong to one mechanism. Then the trace without ties.
    fn compliance(&self, constraint: &Constraint) -> ([Matrix2<f64>; 2], f64) {
        let own = |group: GroupIndex, j: &[Vector3<f64>; 2]| {
            let [p, q] = j.map(|j| self.unknowns[group.0].inverse * j);
            Matrix2::new(j[0].dot(&p), j[0].dot(&q), j[1].dot(&p), j[1].dot(&q))
        };
        let mut sides = [own(constraint.a, &constraint.to), Matrix2::zeros()];
        if let Some(b) = constraint.b {
            sides[1] = own(b, &constraint.from);
        }
        let alone = sides[0].trace() + sides[1].trace();
        if self.ties.is_empty() {
            return (sides, alone);
        }
        let first = self.through_ties(constraint.a, &constraint.to);
        let Some(b) = constraint.b else {
            return ([sides[0] - self.taken(&first), Matrix2::zeros()], alone);
        };
        let mut second = self.through_ties(b, &constraint.from);
        if self.mechanism[constraint.a.0] != self.mechanism[b.0] {
            return ([sides[0] - self.taken(&first), sides[1] - self.taken(&second)], alone);
        }
        second.iter_mut().for_each(|(_, w)| *w = -*w);
        let both = [first, second].concat();
        ([sides[0] + sides[1] - self.taken(&both), Matrix2::zeros()], alone)
    }

    /// How the ties of `group` feel the rows `j` of a constraint on it.
    fn through_ties(&self, group: GroupIndex, j: &[Vector3<f64>; 2]) -> Vec<(usize, Matrix2<f64>)> {
        let [p, q] = j.map(|j| self.unknowns[group.0].inverse * j);
        let felt = self.ties.iter().enumerate().filter_map(|(k, tie)| {
            let side = tie.side(group)?;
            let felt =
                Matrix2::new(side[0].dot(&p), side[0].dot(&q), side[1].dot(&p), side[1].dot(&q));
            Some((k, felt))
        });
        felt.collect()
    }

    /// What the ties take from the compliance of a constraint that they feel like this.
    fn taken(&self, felt: &[(usize, Matrix2<f64>)]) -> Matrix2<f64> {
        let mut taken = Matrix2::zeros();
        for (k, left) in felt {
            for (l, right) in felt {
                let between = self.tied.fixed_view::<2, 2>(2 * k, 2 * l);
                taken += left.transpose() * between * right;
            }
        }
        taken
    }

    /// Twists from trial forces, the ties met.
    fn spread(&mut self) {
        let Self { unknowns, constraints, ties, tied, asked, .. } = self;
        for unknown in unknowns.iter_mut() {
            unknown.pressed = Vector3::zeros();
        }
        for c in constraints.iter() {
            unknowns[c.a.0].pressed += c.to[0] * c.trial.x + c.to[1] * c.trial.y;
            if let Some(b) = c.b {
                unknowns[b.0].pressed -= c.from[0] * c.trial.x + c.from[1] * c.trial.y;
            }
        }
        let settle = |unknowns: &mut [Unknown]| {
            for unknown in unknowns {
                unknown.twist = unknown.free + unknown.inverse * unknown.pressed;
            }
        };
        settle(unknowns);
        if ties.is_empty() {
            return;
        }
        if asked.len() != 2 * ties.len() {
            *asked = DVector::zeros(2 * ties.len());
        }
        for (k, tie) in ties.iter().enumerate() {
            let left = Vector2::from(tie.target) - tie.values(unknowns);
            (asked[2 * k], asked[2 * k + 1]) = (left.x, left.y);
        }
        for (k, tie) in ties.iter_mut().enumerate() {
            let force = |row: usize| tied.column(row).dot(asked);
            tie.force = Vector2::new(force(2 * k), force(2 * k + 1));
            unknowns[tie.b.0].pressed += tie.to[0] * tie.force.x + tie.to[1] * tie.force.y;
            unknowns[tie.a.0].pressed -= tie.from[0] * tie.force.x + tie.from[1] * tie.force.y;
        }
        settle(unknowns);
    }
}
