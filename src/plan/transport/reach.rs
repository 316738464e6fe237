//! Reach of one grip of a tool that carries groups, with everything else at rest.

use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

use crate::geometry::Vector;
use crate::plan::Workspace;
use crate::scene::Situation;

use super::group::{Group, Hold, groups, holds};
use super::lattice::Solid;
use super::path::{PathSegment, Paths, Taken};

/// Clearance between groups, and to a tool that carries another, metres.
const BESIDE: f64 = 0.004;

/// Distance between samples of paths in the search for obstructions, in places.
const SAMPLE: usize = 3;

/// Push that carries a group straight along.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Index of the object.
    pub object: usize,
    /// Direction, radians from world +x.
    pub direction: f64,
    /// Start, metres.
    pub from: Vector,
    /// End, metres.
    pub to: Vector,
    /// Whether the end is the goal.
    pub last: bool,
}

/// Groups that can be carried, with any tool.
pub struct Groups(Vec<Group>);

impl Groups {
    /// Returns the groups of a situation; `None` if a goal requires more than a change of position.
    pub fn of(workspace: &Workspace, situation: &Situation) -> Option<Self> {
        groups(workspace, situation).map(Self)
    }
}

/// Transport of groups by one grip of a tool.
pub struct Transport<'a> {
    workspace: Workspace<'a>,
    situation: &'a Situation,
    pair: (usize, f64),
    pub(super) groups: &'a [Group],
    /// Holds of every group, computed on demand.
    holds: Vec<OnceCell<Vec<Hold>>>,
    longest: f64,
    marks: RefCell<HashMap<(usize, usize, usize), Rc<Marks>>>,
    alone: RefCell<HashMap<(usize, usize), Rc<Course>>>,
}

/// Places that another group blocks for a group and for the tool behind it, sorted.
struct Marks {
    thing: Vec<usize>,
    holds: Vec<Vec<usize>>,
}

/// Path of a group to its goal without obstructions.
pub(super) struct Course {
    pub cost: f64,
    pub way: Vec<PathSegment>,
    pub pushes: usize,
}

impl<'a> Transport<'a> {
    /// Creates the transport with this tool and grip yaw (radians) and pushes of at most `longest`
    /// metres. Returns `None` if a goal's object has no path even without other objects.
    pub fn new(
        workspace: Workspace<'a>,
        situation: &'a Situation,
        Groups(groups): &'a Groups,
        pair: (usize, f64),
        longest: f64,
    ) -> Option<Self> {
        let (marks, alone) = Default::default();
        let holds = groups.iter().map(|_| OnceCell::new()).collect();
        let carrying = Self { workspace, situation, pair, groups, holds, longest, marks, alone };
        let start = carrying.start();
        let finds = |&k: &usize| carrying.alone(k, start[k]).cost.is_finite();
        carrying.wanting(&start).iter().all(finds).then_some(carrying)
    }

    /// Returns a lower bound of the remaining cost, in pushes.
    pub fn least(&self) -> f64 {
        let start = self.start();
        self.wanting(&start).into_iter().map(|k| self.alone(k, start[k]).cost).sum()
    }

    /// Returns the places at the start.
    pub(super) fn start(&self) -> Vec<usize> {
        self.groups.iter().map(|group| group.lattice.nearest(group.lattice.origin)).collect()
    }

    /// Returns the holds of a group.
    pub(super) fn holds(&self, k: usize) -> &[Hold] {
        let group = &self.groups[k];
        self.holds[k]
            .get_or_init(|| holds(&self.workspace, self.pair, self.situation, (group, self.groups)))
    }

    /// Returns the groups that are not at their goals.
    pub(super) fn wanting(&self, places: &[usize]) -> Vec<usize> {
        let off = |k: &usize| self.groups[*k].goal.is_some_and(|(_, goal)| places[*k] != goal);
        (0..self.groups.len()).filter(off).collect()
    }

    /// Returns samples of the path of a group and the tool behind it: positions of the group with
    /// the solids around them.
    pub(super) fn passed(&self, k: usize, way: &[PathSegment]) -> Vec<(Vector, &[Solid])> {
        let group = &self.groups[k];
        let mut passed = Vec::new();
        for stretch in way {
            let hold = &self.holds(k)[stretch.hold];
            let places = places(group, hold, stretch);
            let last = places.len() - 1;
            for (n, place) in places.into_iter().enumerate() {
                if n % SAMPLE == 0 || n == last {
                    let at = group.lattice.position(place);
                    passed.push((at, group.solids.as_slice()));
                    passed.push((at, hold.solids.as_slice()));
                }
            }
        }
        passed
    }

    /// Returns the obstructions of a path.
    pub(super) fn blocking(
        &self,
        k: usize,
        way: &[PathSegment],
        places_of: &[usize],
    ) -> Vec<usize> {
        let blocks = |other: &usize| {
            let marks = self.marks(k, *other, places_of[*other]);
            way.iter().any(|stretch| {
                let passed = places(&self.groups[k], &self.holds(k)[stretch.hold], stretch);
                let held = &marks.holds[stretch.hold];
                passed.iter().any(|place| {
                    held.binary_search(place).is_ok()
                        || (*place != stretch.from && marks.thing.binary_search(place).is_ok())
                })
            })
        };
        (0..self.groups.len()).filter(|other| *other != k).filter(blocks).collect()
    }

    /// Splits a segment into pushes that are short enough.
    pub(super) fn parted(&self, k: usize, stretch: PathSegment) -> Vec<(usize, PathSegment)> {
        let (group, hold) = (&self.groups[k], &self.holds(k)[stretch.hold]);
        let passed = places(group, hold, &stretch);
        let steps = passed.len() - 1;
        let count =
            (steps as f64 * group.lattice.spacing / self.longest - 1e-9).ceil().max(1.0) as usize;
        let end = |n: usize| passed[steps * n / count];
        (0..count).map(|n| (k, PathSegment { from: end(n), to: end(n + 1), ..stretch })).collect()
    }

    /// Returns the path of a group to its goal without other movable objects.
    pub(super) fn alone(&self, k: usize, place: usize) -> Rc<Course> {
        if let Some(known) = self.alone.borrow().get(&(k, place)) {
            return Rc::clone(known);
        }
        let occupied = self.taken(k, &[]);
        let course = match self.groups[k].goal {
            Some((_, goal)) => {
                let ways = self.ways(k, place, &occupied, |at, _| at == goal);
                let way = ways.to(goal);
                let pushes = way.iter().map(|stretch| self.parted(k, *stretch).len()).sum();
                Course { cost: ways.cost[goal], way, pushes }
            }
            None => Course { cost: 0.0, way: Vec::new(), pushes: 0 },
        };
        let course = Rc::new(course);
        self.alone.borrow_mut().insert((k, place), Rc::clone(&course));
        course
    }

    /// Returns the paths of a group from a place.
    pub(super) fn ways(
        &self,
        k: usize,
        start: usize,
        taken: &Taken,
        enough: impl FnMut(usize, f64) -> bool,
    ) -> Paths {
        Paths::from((&self.groups[k], self.holds(k)), start, taken, self.longest, enough)
    }

    /// Returns the places that all other groups block for a group.
    pub(super) fn taken_by_others(&self, k: usize, places: &[usize]) -> Taken {
        let others: Vec<(usize, usize)> =
            places.iter().copied().enumerate().filter(|(other, _)| *other != k).collect();
        self.taken(k, &others)
    }

    /// Returns the places that other groups at these places block for a group.
    pub(super) fn taken(&self, k: usize, others: &[(usize, usize)]) -> Taken {
        let count = self.groups[k].lattice.count();
        let mut all = Taken {
            thing: vec![false; count],
            holds: vec![vec![false; count]; self.holds(k).len()],
        };
        for &(other, place) in others {
            let marks = self.marks(k, other, place);
            marks.thing.iter().for_each(|place| all.thing[*place] = true);
            for (all, marks) in all.holds.iter_mut().zip(&marks.holds) {
                marks.iter().for_each(|place| all[*place] = true);
            }
        }
        all
    }

    /// Returns the places that one other group blocks.
    fn marks(&self, k: usize, other: usize, place: usize) -> Rc<Marks> {
        let key = (k, other, place);
        if let Some(known) = self.marks.borrow().get(&key) {
            return Rc::clone(known);
        }
        let (group, still) = (&self.groups[k], &self.groups[other]);
        let (lattice, at) = (&group.lattice, still.lattice.position(place));
        let here = lattice.origin;
        let stood = place == still.lattice.nearest(still.lattice.origin);
        let mark = |solids: &[Solid], own: bool| {
            let mut marked = Vec::new();
            for solid in solids {
                for one in still.solids.iter().filter(|one| one.meets(solid)) {
                    let there = one.at(at);
                    let other = (&one.footprint, &there);
                    let apart = match own && stood {
                        // A group that starts nearer may slide along.
                        true => BESIDE.min(solid.gap(here, other, BESIDE) - 1e-6),
                        false => BESIDE,
                    };
                    solid.near(lattice, other, BESIDE, |place, gap| {
                        if gap < apart {
                            marked.push(place);
                        }
                    });
                }
            }
            marked.sort_unstable();
            marked.dedup();
            marked
        };
        let marks = Rc::new(Marks {
            thing: mark(&group.solids, true),
            holds: self.holds(k).iter().map(|hold| mark(&hold.solids, false)).collect(),
        });
        self.marks.borrow_mut().insert(key, Rc::clone(&marks));
        marks
    }
}

/// Returns all places of a segment, both ends included.
fn places(group: &Group, hold: &Hold, stretch: &PathSegment) -> Vec<usize> {
    let mut places = vec![stretch.from];
    let mut at = stretch.from;
    while at != stretch.to
        && let Some(next) = group.lattice.next(at, hold.step)
    {
        at = next;
        places.push(at);
    }
    places
}
