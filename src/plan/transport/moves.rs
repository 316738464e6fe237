//! Straight pushes of groups on the grid. A group that is pushed against others carries them along.

use crate::geometry::Vector;

use super::distance::SHORTEST;
use super::group::{Group, Hold};
use super::lattice::Shift;
use super::reach::Transport;
use super::travel::Flood;

/// Maximum number of groups that one push carries.
pub(super) const MOVERS: usize = 4;

/// Distance between the stops of a push through open space, metres: about the width of an object.
const STRIDE: f64 = 0.08;

/// Length of an open interval below which only its middle is a stop, metres.
const OPENING: f64 = 0.1;

/// Push of a group with everything that it carries along.
#[derive(Clone, Copy)]
pub(super) struct Move {
    /// Index of the group.
    pub group: usize,
    /// Index of the hold behind it.
    pub hold: usize,
    /// Length, in steps of the grid.
    pub steps: i16,
    /// Groups at the end.
    pub train: Train,
}

/// Groups that move during a push, the pushed one first, each with its displacement.
#[derive(Clone, Copy)]
pub(super) struct Train {
    movers: [(u16, Shift); MOVERS],
    count: u8,
    /// Number of contacts that may rotate the group in front.
    pub loose: u8,
}

impl Train {
    fn of(group: usize, at: Shift) -> Self {
        Self { movers: [(group as u16, at); MOVERS], count: 1, loose: 0 }
    }

    /// Returns the groups and their displacements.
    pub fn movers(&self) -> impl Iterator<Item = (usize, Shift)> + use<'_> {
        self.movers[..usize::from(self.count)].iter().map(|(k, at)| (usize::from(*k), *at))
    }

    /// Returns the displacement of a group, if it moves.
    fn at(&self, group: usize) -> Option<Shift> {
        self.movers().find(|(k, _)| *k == group).map(|(_, at)| at)
    }

    fn add(&mut self, group: usize, at: Shift) {
        self.movers[usize::from(self.count)] = (group as u16, at);
        self.count += 1;
    }
}

/// Returns the pushes of a group that carry at most `movers` groups: for every direction those
/// of the first hold that is free, and longer ones of the next. A tool that stays down must
/// reach the hold.
pub(super) fn moves(
    transport: &Transport,
    k: usize,
    shifts: &[Shift],
    movers: usize,
    flood: Option<&Flood>,
) -> Vec<Move> {
    let mut moves: Vec<Move> = Vec::new();
    for step in &transport.steps {
        let mut farthest = 0;
        for (h, hold) in transport.held(k).holds.iter().enumerate() {
            let reached = || {
                let at = transport.groups[k].position(shifts[k]) + hold.effector;
                transport.travel(flood, at).is_some()
            };
            if hold.step == *step && reached() {
                let stops = stops(transport, k, (h, hold), shifts, movers);
                let farther = stops.into_iter().filter(|one| one.steps > farthest);
                moves.extend(farther);
                farthest = moves.last().map_or(0, |last| last.steps).max(farthest);
            }
        }
    }
    moves
}

/// Returns the stops of a push, shortest first.
fn stops(
    transport: &Transport,
    k: usize,
    (h, hold): (usize, &Hold),
    shifts: &[Shift],
    movers: usize,
) -> Vec<Move> {
    let step = hold.step.map(|s| s as i16);
    let mut train = Train::of(k, shifts[k]);
    if !holds_at(transport, k, h, &train, shifts) {
        return Vec::new();
    }
    let mut trains = vec![train];
    while advance(transport, step, &mut train, shifts)
        && usize::from(train.count) <= movers
        && holds_at(transport, k, h, &train, shifts)
    {
        trains.push(train);
    }
    let spacing = transport.groups[k].lattice.spacing;
    let [shortest, stride, opening] =
        [SHORTEST, STRIDE, OPENING].map(|length| (length / spacing).ceil() as usize);
    let mut stops: Vec<usize> = Vec::new();
    let mut first = shortest;
    while first < trains.len() {
        let open = openness(transport, &trains[first]);
        let same = |one: &&Train| openness(transport, one) == open;
        let count = trains[first..].iter().take_while(same).count();
        match count <= opening {
            true => stops.push(first + count / 2),
            false => {
                stops.extend((2..count - 1).step_by(stride).map(|n| first + n));
                stops.push(first + count - 1);
            }
        }
        first += count;
    }
    let goal =
        |train: &Train| train.movers().any(|(k, at)| transport.groups[k].goal_shift == Some(at));
    stops.extend((shortest..trains.len()).filter(|n| goal(&trains[*n])));
    stops.sort_unstable();
    stops.dedup();
    let made = |n: usize| Move { group: k, hold: h, steps: n as i16, train: trains[n] };
    stops.into_iter().map(made).collect()
}

/// Returns the group that a push moves, and the hold behind it.
pub(super) fn pushing<'t>(transport: &'t Transport, one: &Move) -> (&'t Group, &'t Hold) {
    (&transport.groups[one.group], &transport.held(one.group).holds[one.hold])
}

/// Returns the position of the end effector after a push.
pub(super) fn tool_after(transport: &Transport, one: &Move) -> Vector {
    let (group, hold) = pushing(transport, one);
    let at = one.train.movers[0].1;
    group.position(at) + hold.effector + hold.ahead() * hold.approach
}

/// Returns the groups after the first `steps` steps of a push.
pub(super) fn train_after(
    transport: &Transport,
    one: &Move,
    steps: i16,
    shifts: &[Shift],
) -> Train {
    let step = transport.held(one.group).holds[one.hold].step.map(|s| s as i16);
    let mut train = Train::of(one.group, shifts[one.group]);
    for _ in 0..steps {
        advance(transport, step, &mut train, shifts);
    }
    train
}

/// Returns `true` if the tool can be behind the pushed group.
fn holds_at(transport: &Transport, k: usize, h: usize, train: &Train, shifts: &[Shift]) -> bool {
    let at = train.movers[0].1;
    let beside = |other: usize| {
        let there = train.at(other).unwrap_or(shifts[other]);
        other != k && transport.beside_tool((k, h), other).meet(at, there)
    };
    transport.groups[k].place(at).is_some_and(|place| transport.held(k).free[place] >> h & 1 == 1)
        && !(0..transport.groups.len()).any(beside)
}

/// Moves all groups of the train by one step; returns `false` if a fixed body is in the way.
fn advance(transport: &Transport, step: Shift, train: &mut Train, shifts: &[Shift]) -> bool {
    let mut next = 0;
    while next < usize::from(train.count) {
        let (mover, at) = &mut train.movers[next];
        *at = [at[0] + step[0], at[1] + step[1]];
        let (mover, at) = (usize::from(*mover), *at);
        if !transport.groups[mover].is_clear(at) {
            return false;
        }
        for (other, &there) in shifts.iter().enumerate() {
            if train.at(other).is_some() || !transport.beside((mover, other)).meet(at, there) {
                continue;
            }
            if usize::from(train.count) == MOVERS {
                return false;
            }
            train.add(other, there);
            let groups = (&transport.groups[mover], &transport.groups[other]);
            train.loose += u8::from(!is_behind_centre(groups, (at, there), step));
        }
        next += 1;
    }
    true
}

/// Returns a number that changes where passages open or close beside the train.
fn openness(transport: &Transport, train: &Train) -> u64 {
    train.movers().fold(u64::from(train.count), |all, (k, at)| {
        let own =
            transport.groups[k].place(at).map_or(0, |place| transport.held(k).openings[place]);
        all.wrapping_mul(1_000_003).wrapping_add(u64::from(own))
    })
}

/// Returns `true` if a group pushes another one within the width of their contact, so that neither
/// rotates.
fn is_behind_centre(
    (mover, other): (&Group, &Group),
    (at, there): (Shift, Shift),
    step: Shift,
) -> bool {
    let across = usize::from(step[0] != 0);
    let base = |group: &Group, at: Shift| {
        group.lattice.origin[across] + f64::from(at[across]) * group.lattice.spacing
    };
    let (own, its) = (base(mover, at), base(other, there));
    let low = (own + mover.widths[across][0]).max(its + other.widths[across][0]);
    let high = (own + mover.widths[across][1]).min(its + other.widths[across][1]);
    (low..=high).contains(&(its + other.centre[across]))
}
