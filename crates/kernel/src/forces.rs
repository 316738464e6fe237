//! The forces of at most two contacts at fixed weights, several frames side by side.

use crate::{
    lanes::{Lanes, Pair, Triple, Which, dot, minus, plus, times},
    object::{Inverse, Moves},
    settings::{GIVE, MIN_COMPLIANCE, OPEN, ROUNDS, TOGETHER},
    stats::SolverStats,
};

/// Maximum number of contacts of a frame.
pub const MOST: usize = 2;

/// A contact as equations.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pressing<const N: usize> {
    /// Frames that have the contact.
    pub present: Which<N>,
    pub to: [Triple<N>; 2],
    pub target: Pair<N>,
    pub friction: Lanes<N>,
    /// Frames in which the contact sticks, frames in which it slides, and the edge of the friction
    /// cone on which it slides.
    sticks: Which<N>,
    slides: Which<N>,
    edge: Lanes<N>,
    pub force: Pair<N>,
    trial: Pair<N>,
    value: Pair<N>,
    moved: [Triple<N>; 2],
    /// Compliances nn, nt, tn and tt.
    own: [Lanes<N>; 4],
    give: Lanes<N>,
}

/// State and force of a contact if nothing else changes.
#[derive(Clone, Copy)]
struct Response<const N: usize> {
    sticks: Which<N>,
    slides: Which<N>,
    edge: Lanes<N>,
    force: Pair<N>,
}

/// An equation of a contact that presses, in the frames where it does.
#[derive(Clone, Copy, Default)]
struct Row<const N: usize> {
    holds: Which<N>,
    press: Triple<N>,
    moved: Triple<N>,
    give: Lanes<N>,
    target: Lanes<N>,
}

/// Computes forces and twists in the frames `of`, starting from the last states of the contacts.
/// Returns the frames in which a consistent set was found.
#[inline(always)]
pub(crate) fn solve<const N: usize>(
    moves: &mut Moves<N>,
    contacts: &mut [Pressing<N>; MOST],
    mut of: Which<N>,
    tally: &mut SolverStats,
) -> Which<N> {
    let mut left = [[Lanes::ZERO; 2]; MOST];
    for (c, left) in contacts.iter_mut().zip(&mut left) {
        c.weigh(&moves.inverse);
        c.value = apply(&c.to, moves.free);
        *left = minus(c.target, c.value);
    }
    let mut found = Which::NONE;
    for round in 0..ROUNDS {
        count(contacts, of & !found, tally);
        let [first, second] = [0, 1].map(|c| contacts[c].equations());
        let (trial, solved) = match (first, second) {
            (0, 0) => ([[Lanes::ZERO; 2]; MOST], Which::ALL),
            (1, 0) => eliminated::<1, 0, 1, N>(contacts, &left),
            (0, 1) => eliminated::<0, 1, 1, N>(contacts, &left),
            (1, 1) => eliminated::<1, 1, 2, N>(contacts, &left),
            (2, 0) => eliminated::<2, 0, 2, N>(contacts, &left),
            (0, 2) => eliminated::<0, 2, 2, N>(contacts, &left),
            (1, 2) => eliminated::<1, 2, 3, N>(contacts, &left),
            (2, 1) => eliminated::<2, 1, 3, N>(contacts, &left),
            _ => eliminated::<2, 2, 4, N>(contacts, &left),
        };
        of = of & solved;
        moves.pressed = [Lanes::ZERO; 3];
        for c in 0..MOST {
            contacts[c].trial = trial[c];
            let [normal, tangent] = trial[c];
            let pressed = plus(times(contacts[c].to[0], normal), times(contacts[c].to[1], tangent));
            moves.pressed = plus(moves.pressed, pressed);
        }
        moves.settle();
        found = agreed(moves, contacts, round);
        if !(of & !found).any() {
            break;
        }
    }
    for contact in contacts {
        contact.force = contact.trial;
    }
    of & found
}

/// Returns the frames in which the state of every contact is consistent with its trial force. In
/// other frames all contacts change to the state of their response, in later rounds only the
/// contact with the largest error. A further round in a consistent frame finds the same forces.
#[inline(always)]
fn agreed<const N: usize>(
    moves: &Moves<N>,
    contacts: &mut [Pressing<N>; MOST],
    round: usize,
) -> Which<N> {
    let mut others = [Which::NONE; MOST];
    let mut off = [Lanes::ZERO; MOST];
    for c in 0..MOST {
        let contact = &mut contacts[c];
        if contact.present.any() {
            contact.value = apply(&contact.to, moves.twist);
            let response = contact.respond();
            others[c] = contact.present & !contact.does(&response);
            if round < TOGETHER {
                contact.follow(others[c], &response);
            } else {
                off[c] = contact.off(response.force);
            }
        }
    }
    if round >= TOGETHER {
        let second = others[1] & (!others[0] | off[0].below(off[1]));
        let worst = [others[0] & !second, second];
        for c in 0..MOST {
            let response = contacts[c].respond();
            contacts[c].follow(worst[c], &response);
        }
    }
    !(others[0] | others[1])
}

impl<const N: usize> Pressing<N> {
    /// Computes the motion due to the contact's forces from the present weights.
    #[inline(always)]
    fn weigh(&mut self, inverse: &Inverse<N>) {
        let (n, t) = (inverse.by(self.to[0]), inverse.by(self.to[1]));
        self.moved = [n, t];
        let none = Lanes::ZERO;
        let [a, b] = self.to;
        self.own = [dot(a, n) + none, dot(a, t) + none, dot(b, n) + none, dot(b, t) + none];
        self.give = Lanes::all(0.5 * GIVE) * (self.own[0] + self.own[3]);
    }

    /// Returns the compliance added to a normal force that slides and wedges.
    #[inline(always)]
    fn wedge(&self) -> Lanes<N> {
        let knn = self.own[0] + self.give;
        let wedge = Lanes::all(MIN_COMPLIANCE) * knn - (knn + self.edge * self.own[1]);
        wedge.max(Lanes::ZERO)
    }

    /// Returns the frames in which the force moves the object by more than rounding.
    #[inline(always)]
    pub fn presses(&self) -> Which<N> {
        Lanes::all(OPEN).below(self.trial[0] * self.own[0])
    }

    /// Returns the number of equations in frame `k`.
    #[inline(always)]
    pub fn rows(&self, k: usize) -> u32 {
        2 * u32::from(self.sticks.has(k)) + u32::from(self.slides.has(k))
    }

    /// Restricts the contact to the frames `of`.
    #[inline(always)]
    pub fn keep(&mut self, of: Which<N>) {
        self.present = self.present & of;
        self.sticks = self.sticks & of;
        self.slides = self.slides & of;
    }

    /// Returns the largest number of equations in any frame.
    #[inline(always)]
    fn equations(&self) -> usize {
        match (self.sticks.any(), self.slides.any()) {
            (true, _) => 2,
            (false, slides) => usize::from(slides),
        }
    }

    /// Returns equation `k` of `many`.
    #[inline(always)]
    fn row(&self, k: usize, many: usize, left: &Pair<N>) -> Row<N> {
        let (moved, target) = (self.moved[k], left[k]);
        let mut row = Row { holds: self.sticks, press: self.to[k], moved, give: self.give, target };
        if k == 0 && (many == 1 || self.slides.any()) {
            row.holds = self.sticks | self.slides;
            let press = plus(row.press, times(self.to[1], self.edge));
            row.press = self.slides.pick_each(press, row.press);
            row.give = self.slides.pick(row.give + self.wedge(), row.give);
        }
        row
    }

    /// Returns the force of the contact from the unknowns of its equations.
    #[inline(always)]
    fn by(&self, normal: Lanes<N>, tangent: Lanes<N>) -> Pair<N> {
        let zero = Lanes::ZERO;
        let normal = (self.sticks | self.slides).pick(normal, zero);
        [normal, self.sticks.pick(tangent, self.slides.pick(self.edge * normal, zero))]
    }

    /// Computes the response of the contact if nothing else changes.
    #[inline(always)]
    fn respond(&self) -> Response<N> {
        let (trial, give, zero) = (self.trial, self.give, Lanes::ZERO);
        let left = minus(minus(self.target, self.value), times(trial, give));
        let (knn, ktt, knt) = (self.own[0] + give, self.own[3] + give, self.own[1]);
        let det = knn * ktt - knt * knt;
        let step = [(ktt * left[0] - knt * left[1]) / det, (knn * left[1] - knt * left[0]) / det];
        let stick = plus(trial, step);
        let cone = stick[1].abs().within(self.friction * stick[0]);
        let sticks = self.present & zero.within(stick[0]) & cone;
        // Sliding: on the edge of the cone beyond which the sticking force lies.
        let edge = self.friction * stick[1].sign();
        let compliance = (knn + edge * knt).max(Lanes::all(MIN_COMPLIANCE) * knn);
        let normal = (left[0] + knn * trial[0] + knt * trial[1]) / compliance;
        let slides = self.present & !sticks & zero.below(normal);
        let slid = [slides.pick(normal, zero), slides.pick(edge * normal, zero)];
        Response { sticks, slides, edge, force: sticks.pick_each(stick, slid) }
    }

    /// Returns the frames in which the contact's state is that response.
    #[inline(always)]
    fn does(&self, Response { sticks, slides, edge, .. }: &Response<N>) -> Which<N> {
        let slides = self.slides.either(*slides & edge.equals(self.edge), !(*sticks | *slides));
        self.sticks.either(*sticks, slides)
    }

    /// Changes the contact's state to the response in the frames `of`.
    #[inline(always)]
    fn follow(&mut self, of: Which<N>, response: &Response<N>) {
        self.sticks = of.either(response.sticks, self.sticks);
        self.slides = of.either(response.slides, self.slides);
        self.edge = of.pick(response.edge, self.edge);
    }

    /// Returns the distance between its trial force and another force, metres.
    #[inline(always)]
    fn off(&self, force: Pair<N>) -> Lanes<N> {
        let [x, y] = minus(force, self.trial);
        let [nn, nt, tn, tt] = self.own;
        (nn * x + nt * y).abs().max((tn * x + tt * y).abs())
    }

    /// Copies the state of `other` in the frames `of`.
    #[inline(always)]
    pub fn take(&mut self, of: Which<N>, other: &Self) {
        self.present = of.either(other.present, self.present);
        self.friction = other.friction;
        for row in 0..2 {
            self.to[row] = of.pick_each(other.to[row], self.to[row]);
        }
        self.force = of.pick_each(other.force, self.force);
        self.trial = of.pick_each(other.trial, self.trial);
        self.own[0] = of.pick(other.own[0], self.own[0]);
        self.sticks = of.either(other.sticks, self.sticks);
        self.slides = of.either(other.slides, self.slides);
        self.edge = of.pick(other.edge, self.edge);
    }
}

/// Returns J twist.
#[inline(always)]
fn apply<const N: usize>(to: &[Triple<N>; 2], twist: Triple<N>) -> Pair<N> {
    [dot(to[0], twist), dot(to[1], twist)]
}

#[inline(always)]
fn count<const N: usize>(contacts: &[Pressing<N>; MOST], of: Which<N>, tally: &mut SolverStats) {
    for k in 0..N {
        if of.has(k) {
            tally.rounds += 1;
            tally.solve(contacts.iter().map(|contact| contact.rows(k) as usize).sum());
        }
    }
}

/// Solves for the forces of contacts by elimination with pivots, and returns the frames with a
/// solution. The first contact has A equations, the second B, both together M. An equation that
/// does not hold in a frame sets its unknown to zero there. Subtracting zeros keeps the bits of the
/// other unknowns.
#[inline(always)]
fn eliminated<const A: usize, const B: usize, const M: usize, const N: usize>(
    contacts: &[Pressing<N>; MOST],
    left: &[Pair<N>; MOST],
) -> ([Pair<N>; MOST], Which<N>) {
    let (zero, one) = (Lanes::ZERO, Lanes::all(1.0));
    let mut rows = [Row::default(); M];
    for (k, row) in rows.iter_mut().enumerate() {
        *row = match k < A {
            true => contacts[0].row(k, A, &left[0]),
            false => contacts[1].row(k - A, B, &left[1]),
        };
    }
    let mut matrix = [[zero; M]; M];
    let mut target = [zero; M];
    for k in 0..M {
        let row = &rows[k];
        for j in 0..M {
            matrix[k][j] = dot(row.moved, rows[j].press);
        }
        matrix[k][k] += row.give;
        target[k] = row.target;
        // With a single frame all equations hold.
        if N > 1 {
            for j in 0..M {
                let other = if j == k { one } else { zero };
                matrix[k][j] = (row.holds & rows[j].holds).pick(matrix[k][j], other);
            }
            target[k] = row.holds.pick(target[k], zero);
        }
    }
    for k in 0..M {
        let mut best = matrix[k][k].abs();
        let mut pivots = [Which::NONE; M];
        for row in k + 1..M {
            let size = matrix[row][k].abs();
            let larger = best.below(size);
            best = larger.pick(size, best);
            for pivot in &mut pivots[k + 1..row] {
                *pivot = *pivot & !larger;
            }
            pivots[row] = larger;
        }
        for row in k + 1..M {
            let pivot = pivots[row];
            if pivot.any() {
                let (above, below) = (matrix[k], matrix[row]);
                matrix[k] = pivot.pick_each(below, above);
                matrix[row] = pivot.pick_each(above, below);
                let (above, below) = (target[k], target[row]);
                target[k] = pivot.pick(below, above);
                target[row] = pivot.pick(above, below);
            }
        }
        let inverse = one / matrix[k][k];
        for row in k + 1..M {
            let share = matrix[row][k] * inverse;
            let first = matrix[k];
            // Entries before the pivot are not read again.
            for (entry, above) in matrix[row].iter_mut().zip(first) {
                *entry = *entry - share * above;
            }
            target[row] = target[row] - share * target[k];
        }
    }
    let mut found = [zero; M];
    let mut solved = Which::ALL;
    for k in (0..M).rev() {
        let mut known = zero;
        for j in k + 1..M {
            known += matrix[k][j] * found[j];
        }
        found[k] = (target[k] - known) / matrix[k][k];
        solved = solved & (found[k].abs().below(Lanes::all(f64::INFINITY)) | !rows[k].holds);
    }
    let mut trial = [[zero; 2]; MOST];
    if A > 0 {
        trial[0] = contacts[0].by(found[0], if A > 1 { found[1] } else { zero });
    }
    if B > 0 {
        trial[1] = contacts[1].by(found[A], if B > 1 { found[A + 1] } else { zero });
    }
    (trial, solved)
}
