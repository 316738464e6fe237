//! In which order things are carried, and what is moved aside for whom: best first over who has come where.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::geometry::Vector;
use crate::plan::Workspace;
use crate::scene::Situation;

use super::lattice::Solid;
use super::unit::{Hold, Unit, holds, units};
use super::way::{Stretch, Taken, Ways};

/// Things keep so far from each other, metres, and from a tool that carries another.
const BESIDE: f64 = 0.004;

/// What is moved aside leaves so much room for what it makes way for, metres: objects come to lie off by
/// as much.
const ASIDE: f64 = 0.012;

/// Places aside that are tried for one thing, and how far they are apart, metres.
const ASIDES: usize = 3;
const ASIDE_APART: f64 = 0.08;

/// Places that are looked at for that, nearest first.
const LOOKED_AT: usize = 4000;

/// Where what stands in the way is itself in need of room: how many things deep that is followed.
const DEEP: usize = 3;

/// Cost of standing in the way of another thing, in pushes.
const IN_THE_WAY: f64 = 1.2;

/// Weight of how far what is moved aside comes from its own goal, in pushes a metre.
const ASTRAY: f64 = 1.0;

/// Orders that are looked at: more than a plan of a dozen pushes needs.
const MOST: usize = 120;

/// How densely ways are sampled for what stands beside them, in places.
const SAMPLE: usize = 3;

/// One push that carries a thing straight along.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Index of the object.
    pub object: usize,
    /// Radians from world +x.
    pub direction: f64,
    /// From where, metres.
    pub from: Vector,
    /// Where to, metres.
    pub to: Vector,
    /// Whether that is the goal.
    pub last: bool,
}

/// Things that one grip of a tool carries.
pub struct Carrying {
    units: Vec<Unit>,
    holds: Vec<Vec<Hold>>,
    longest: f64,
    taken: RefCell<HashMap<(usize, usize, usize), Rc<Taken>>>,
    alone: RefCell<HashMap<(usize, usize), Rc<Course>>>,
}

/// How a thing would come to its goal if nothing else could stand in its way.
struct Course {
    cost: f64,
    way: Vec<Stretch>,
}

/// Who has come where.
#[derive(Clone)]
struct Node {
    places: Vec<usize>,
    moves: Vec<(usize, Stretch)>,
    /// Pushes so far.
    cost: f64,
    /// With what is left at least.
    total: f64,
}

impl Carrying {
    /// With this tool and grip yaw (radians) and pushes of at most `longest` metres; `None` where a goal
    /// asks for more than to be carried, or a goal's object finds no way even alone.
    pub fn new(
        workspace: &Workspace,
        situation: &Situation,
        pair: (usize, f64),
        longest: f64,
    ) -> Option<Self> {
        let units = units(workspace, situation)?;
        let holds: Vec<Vec<Hold>> =
            units.iter().map(|unit| holds(workspace, pair, situation, (unit, &units))).collect();
        let (taken, alone) = Default::default();
        let carrying = Self { units, holds, longest, taken, alone };
        let start = carrying.start();
        if std::env::var("CARRY").is_ok() {
            for (k, unit) in carrying.units.iter().enumerate() {
                eprintln!("unit {} places {} spacing {} goal {:?} holds {:?} clear {} alone {}", unit.thing, unit.lattice.count(), unit.lattice.spacing, unit.goal,
                carrying.holds[k].iter().map(|h| (h.direction, h.free.iter().filter(|f| **f).count(), h.free[start[k]])).collect::<Vec<_>>(), unit.clear.iter().filter(|f| **f >= 0.0).count(), carrying.alone(k, start[k]).cost);
            }
        }
        let finds = |&k: &usize| carrying.alone(k, start[k]).cost.is_finite();
        carrying.wanting(&start).iter().all(finds).then_some(carrying)
    }

    /// What is left to do at least, in pushes.
    pub fn least(&self) -> f64 {
        let start = self.start();
        self.wanting(&start).into_iter().map(|k| self.alone(k, start[k]).cost).sum()
    }

    /// The legs of plans of at most `most` pushes, up to `count` of them, cheapest first.
    pub fn legs(&self, most: usize, count: usize) -> Vec<Vec<Leg>> {
        let mut found = Vec::new();
        let start = Node { places: self.start(), moves: Vec::new(), cost: 0.0, total: 0.0 };
        let mut open = vec![start];
        let mut seen: HashMap<Vec<usize>, f64> = HashMap::new();
        for n in 0..MOST {
            // The first of equals, so that the order does not depend on chance.
            let next = (0..open.len()).min_by(|a, b| open[*a].total.total_cmp(&open[*b].total));
            let Some(next) = next else { break };
            let node = open.remove(next);
            let known = seen.entry(node.places.clone()).or_insert(f64::INFINITY);
            if *known <= node.cost {
                continue;
            }
            *known = node.cost;
            if std::env::var("CARRY").is_ok() {
                let at: Vec<_> = node.places.iter().zip(&self.units).map(|(p, u)| (u.lattice.position(*p) - u.lattice.position_of_origin()).map(|v| (v * 1000.0).round()).data.0[0]).collect();
                eprintln!("node {n} cost {:.2} total {:.2} moves {} {at:?}", node.cost, node.total, node.moves.len());
            }
            if self.wanting(&node.places).is_empty() {
                found.push(self.told(&node.moves));
                if found.len() == count {
                    break;
                }
                continue;
            }
            for child in self.children(&node) {
                let known = seen.get(&child.places).is_some_and(|cost| *cost <= child.cost);
                if child.moves.len() <= most && !known {
                    open.push(child);
                }
            }
        }
        found
    }

    fn start(&self) -> Vec<usize> {
        self.units.iter().map(|unit| unit.lattice.nearest(unit.lattice.position_of_origin())).collect()
    }

    /// The things that are not at their goals.
    fn wanting(&self, places: &[usize]) -> Vec<usize> {
        let off = |k: &usize| self.units[*k].goal.is_some_and(|(_, goal)| places[*k] != goal);
        (0..self.units.len()).filter(off).collect()
    }

    /// What may be done next.
    fn children(&self, node: &Node) -> Vec<Node> {
        let mut children = Vec::new();
        let wanting = self.wanting(&node.places);
        for &k in &wanting {
            let Some((_, goal)) = self.units[k].goal else { continue };
            let taken = self.taken_by_others(k, &node.places);
            let ways = self.ways(k, node.places[k], &taken, |place, _| place == goal);
            if ways.cost[goal].is_finite() {
                children.extend(self.child(node, k, goal, &ways));
            }
            let course = self.alone(k, node.places[k]);
            if ways.cost[goal] > course.cost + IN_THE_WAY {
                self.make_room(node, &[(k, &course.way)], DEEP, &mut children);
            }
        }
        children
    }

    /// Moves aside what stands in the ways of the last of `ways`, out of all of them.
    fn make_room(
        &self,
        node: &Node,
        ways: &[(usize, &[Stretch])],
        deep: usize,
        children: &mut Vec<Node>,
    ) {
        let Some(&(k, way)) = ways.last() else { return };
        for other in self.blocking(k, way, &node.places) {
            if ways.iter().any(|(k, _)| *k == other) {
                continue;
            }
            let asides = |found: &Ways| self.asides(other, ways, found, node);
            let taken = self.taken_by_others(other, &node.places);
            let found = self.ways(other, node.places[other], &taken, |_, _| false);
            let free = asides(&found);
            for place in &free {
                children.extend(self.child(node, other, *place, &found));
            }
            if free.is_empty() && deep > 1 {
                let nobody = self.taken(other, &[]);
                let found = self.ways(other, node.places[other], &nobody, |_, _| false);
                for place in asides(&found).into_iter().take(1) {
                    let own = found.to(place);
                    let more: Vec<_> = ways.iter().copied().chain([(other, &own[..])]).collect();
                    self.make_room(node, &more, deep - 1, children);
                }
            }
        }
    }

    /// The best places for a thing beside these ways.
    fn asides(
        &self,
        k: usize,
        ways: &[(usize, &[Stretch])],
        found: &Ways,
        node: &Node,
    ) -> Vec<usize> {
        let unit = &self.units[k];
        let lattice = &unit.lattice;
        let passed: Vec<(Vector, &[Solid])> =
            ways.iter().flat_map(|(other, way)| self.passed(*other, way)).collect();
        let mut order: Vec<(f64, usize)> = (0..lattice.count())
            .filter(|&place| found.cost[place].is_finite() && place != node.places[k])
            .map(|place| {
                let off = unit.goal.map_or(0.0, |(goal, _)| (goal - lattice.position(place)).norm());
                (found.cost[place] + ASTRAY * off, place)
            })
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut taken: Vec<usize> = Vec::new();
        for (_, place) in order.into_iter().take(LOOKED_AT) {
            let at = lattice.position(place);
            let near = |other: &usize| (lattice.position(*other) - at).norm() < ASIDE_APART;
            if taken.iter().any(near) {
                continue;
            }
            let clear = passed.iter().all(|(position, solids)| {
                solids.iter().all(|solid| {
                    let still = solid.at(*position);
                    let clear = |own: &Solid| {
                        !own.meets(solid)
                            || own.gap(at, (&solid.footprint, &still), ASIDE) >= ASIDE
                    };
                    unit.solids.iter().all(clear)
                })
            });
            if clear {
                taken.push(place);
                if taken.len() == ASIDES {
                    break;
                }
            }
        }
        taken
    }

    /// What a thing and the tool behind it pass, sampled: where the thing is, and the solids about that.
    fn passed(&self, k: usize, way: &[Stretch]) -> Vec<(Vector, &[Solid])> {
        let unit = &self.units[k];
        let mut passed = Vec::new();
        for stretch in way {
            let hold = &self.holds[k][stretch.hold];
            let places = places(unit, hold, stretch);
            let last = places.len() - 1;
            for (n, place) in places.into_iter().enumerate() {
                if n % SAMPLE == 0 || n == last {
                    let at = unit.lattice.position(place);
                    passed.push((at, unit.solids.as_slice()));
                    passed.push((at, hold.solids.as_slice()));
                }
            }
        }
        passed
    }

    /// What stands in a way.
    fn blocking(&self, k: usize, way: &[Stretch], places_of: &[usize]) -> Vec<usize> {
        let blocks = |other: &usize| {
            let taken = self.taken_by(k, *other, places_of[*other]);
            way.iter().any(|stretch| {
                let passed = places(&self.units[k], &self.holds[k][stretch.hold], stretch);
                let held = &taken.holds[stretch.hold];
                passed.iter().any(|&place| {
                    held[place] || (place != stretch.from && taken.thing[place])
                })
            })
        };
        (0..self.units.len()).filter(|other| *other != k).filter(blocks).collect()
    }

    /// The node after a thing has come to a place.
    fn child(&self, node: &Node, k: usize, place: usize, ways: &Ways) -> Option<Node> {
        let mut child = node.clone();
        child.places[k] = place;
        child.cost += ways.cost[place];
        child.moves.extend(ways.to(place).into_iter().flat_map(|stretch| self.parted(k, stretch)));
        let mut in_the_way = HashSet::new();
        let mut left = 0.0;
        let wanting = self.wanting(&child.places);
        for &k in &wanting {
            let course = self.alone(k, child.places[k]);
            if !course.cost.is_finite() {
                return None;
            }
            left += course.cost;
            // What wants to go on anyway will be out of the way.
            let blocking = self.blocking(k, &course.way, &child.places);
            in_the_way.extend(blocking.into_iter().filter(|other| !wanting.contains(other)));
        }
        child.total = child.cost + left + IN_THE_WAY * in_the_way.len() as f64;
        Some(child)
    }

    /// A stretch as pushes that are short enough.
    fn parted(&self, k: usize, stretch: Stretch) -> Vec<(usize, Stretch)> {
        let (unit, hold) = (&self.units[k], &self.holds[k][stretch.hold]);
        let passed = places(unit, hold, &stretch);
        let steps = passed.len() - 1;
        let count = (steps as f64 * unit.lattice.spacing / self.longest - 1e-9).ceil().max(1.0) as usize;
        let end = |n: usize| passed[steps * n / count];
        (0..count).map(|n| (k, Stretch { from: end(n), to: end(n + 1), ..stretch })).collect()
    }

    fn alone(&self, k: usize, place: usize) -> Rc<Course> {
        if let Some(known) = self.alone.borrow().get(&(k, place)) {
            return Rc::clone(known);
        }
        let nobody = self.taken(k, &[]);
        let course = match self.units[k].goal {
            Some((_, goal)) => {
                let ways = self.ways(k, place, &nobody, |at, _| at == goal);
                Course { cost: ways.cost[goal], way: ways.to(goal) }
            }
            None => Course { cost: 0.0, way: Vec::new() },
        };
        let course = Rc::new(course);
        self.alone.borrow_mut().insert((k, place), Rc::clone(&course));
        course
    }

    fn ways(
        &self,
        k: usize,
        start: usize,
        taken: &Taken,
        enough: impl FnMut(usize, f64) -> bool,
    ) -> Ways {
        Ways::from((&self.units[k], &self.holds[k]), start, taken, self.longest, enough)
    }

    fn taken_by_others(&self, k: usize, places: &[usize]) -> Taken {
        let others: Vec<(usize, usize)> =
            places.iter().copied().enumerate().filter(|(other, _)| *other != k).collect();
        self.taken(k, &others)
    }

    /// Where a thing cannot be for others at these places.
    fn taken(&self, k: usize, others: &[(usize, usize)]) -> Taken {
        let count = self.units[k].lattice.count();
        let mut all =
            Taken { thing: vec![false; count], holds: vec![vec![false; count]; self.holds[k].len()] };
        let join = |all: &mut [bool], one: &[bool]| {
            all.iter_mut().zip(one).for_each(|(all, one)| *all |= one);
        };
        for &(other, place) in others {
            let taken = self.taken_by(k, other, place);
            join(&mut all.thing, &taken.thing);
            all.holds.iter_mut().zip(&taken.holds).for_each(|(all, one)| join(all, one));
        }
        all
    }

    fn taken_by(&self, k: usize, other: usize, place: usize) -> Rc<Taken> {
        let key = (k, other, place);
        if let Some(known) = self.taken.borrow().get(&key) {
            return Rc::clone(known);
        }
        let (unit, still) = (&self.units[k], &self.units[other]);
        let (lattice, at) = (&unit.lattice, still.lattice.position(place));
        let here = lattice.position_of_origin();
        let stood = place == still.lattice.nearest(still.lattice.position_of_origin());
        let mark = |solids: &[Solid], own: bool| {
            let mut taken = vec![false; lattice.count()];
            for solid in solids {
                for one in &still.solids {
                    if !one.meets(solid) {
                        continue;
                    }
                    let there = one.at(at);
                    let other = (&one.footprint, &there);
                    let apart = match own && stood {
                        // What stands nearer already may slide along.
                        true => BESIDE.min(solid.gap(here, other, BESIDE) - 1e-6),
                        false => BESIDE,
                    };
                    lattice.near(solid, other, BESIDE, |place, gap| taken[place] |= gap < apart);
                }
            }
            taken
        };
        let taken = Rc::new(Taken {
            thing: mark(&unit.solids, true),
            holds: self.holds[k].iter().map(|hold| mark(&hold.solids, false)).collect(),
        });
        self.taken.borrow_mut().insert(key, Rc::clone(&taken));
        taken
    }

    fn told(&self, moves: &[(usize, Stretch)]) -> Vec<Leg> {
        let leg = |&(k, stretch): &(usize, Stretch)| {
            let unit = &self.units[k];
            let arrived = unit.goal.filter(|(_, goal)| *goal == stretch.to);
            Leg {
                object: unit.thing,
                direction: self.holds[k][stretch.hold].direction,
                from: unit.lattice.position(stretch.from),
                to: arrived.map_or(unit.lattice.position(stretch.to), |(goal, _)| goal),
                last: arrived.is_some(),
            }
        };
        moves.iter().map(leg).collect()
    }
}

/// All places of a stretch, both ends included.
fn places(unit: &Unit, hold: &Hold, stretch: &Stretch) -> Vec<usize> {
    let mut places = vec![stretch.from];
    let mut at = stretch.from;
    while at != stretch.to
        && let Some(next) = unit.lattice.next(at, hold.step)
    {
        at = next;
        places.push(at);
    }
    places
}
