//! Demand: a minimum number of any objects of a group reach their goals.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};
use crate::scene::{Scene, State};
use crate::task::Goal;

use super::{Check, Demand, End, Kind, MOST_CHOICES, Mark};

/// Maximum number of objects of a group, because all sufficiently large sets of them are listed.
const MOST: usize = 16;

/// A demand that a minimum number of goals of different objects are reached.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Group {
    /// Goals, one for each object, all with the same demands.
    pub members: Vec<Goal>,
    /// Minimum number of reached goals.
    pub at_least: usize,
}

impl Group {
    /// Demands that at least `at_least` members reach their goals; `None` without members.
    pub fn of(members: Vec<Goal>, at_least: usize) -> Option<Goal> {
        let first = members.first()?;
        let goal = Goal { weight: first.weight, ..Goal::of(first.object) };
        Some(goal.with(Demand::Group(Self { members, at_least })))
    }

    /// Returns the score of a member.
    fn member_score(member: &Goal, end: &End) -> f64 {
        member.score_after(end.state, end.lift.filter(|lift| lift.object == member.object))
    }

    /// Returns the farthest from its goal among the nearest members, as many as must reach their
    /// goals.
    fn farthest(&self, end: &End) -> Option<(&Goal, f64)> {
        let score = |member| (member, Self::member_score(member, end));
        let mut ranked: Vec<(&Goal, f64)> = self.members.iter().map(score).collect();
        ranked.sort_by(|a, b| a.1.total_cmp(&b.1));
        ranked.get(self.at_least.clamp(1, self.members.len().max(1)) - 1).copied()
    }

    fn mapped(&self, with: impl Fn(&Goal) -> Goal) -> Demand {
        let members = self.members.iter().map(with).collect();
        Demand::Group(Self { members, ..*self })
    }

    fn kinds(&self) -> impl Iterator<Item = &dyn Kind> {
        self.members.iter().flat_map(|member| &member.demands).map(Demand::kind)
    }
}

impl Kind for Group {
    fn demand(&self) -> Demand {
        Demand::Group(self.clone())
    }

    fn is_met(&self, end: &End) -> bool {
        let met = |member: &&Goal| {
            member.is_met(end.state, end.lift.filter(|lift| lift.object == member.object))
        };
        self.members.iter().filter(met).count() >= self.at_least
    }

    fn words(&self, _: usize, scene: &Scene) -> String {
        let each = self.members.first().map_or_else(String::new, |member| member.words(scene));
        format!("at least {} of them {each}", self.at_least)
    }

    fn off(&self, end: &End) -> Option<Vector> {
        self.farthest(end).filter(|(member, _)| member.has_place()).map(|one| one.0.off(end.state))
    }

    fn turned(&self, end: &End) -> Option<f64> {
        self.farthest(end)?.0.turned(end.state)
    }

    fn tolerance(&self) -> Option<f64> {
        self.members.first().map(Goal::tolerance).filter(|tolerance| tolerance.is_finite())
    }

    fn turn_tolerance(&self) -> Option<f64> {
        self.members.first()?.heading().map(|facing| facing.tolerance)
    }

    fn score(&self, end: &End) -> f64 {
        self.farthest(end).map_or(f64::INFINITY, |(_, score)| score)
    }

    fn position(&self) -> Option<Vector> {
        self.members.first()?.position()
    }

    fn stricter(&self, place: f64, turn: f64) -> Demand {
        self.mapped(|member| member.stricter(place, turn))
    }

    fn shifted(&self, shift: Vector) -> Demand {
        self.mapped(|member| member.shifted(shift))
    }

    fn seen_from(&self, frame: &Pose) -> Demand {
        self.mapped(|member| {
            let demands = member.demands.iter().map(|one| one.kind().seen_from(frame));
            Goal { demands: demands.collect(), ..*member }
        })
    }

    fn relative_to(&self, other: usize) -> Demand {
        self.mapped(|member| member.clone().relative_to(other))
    }

    fn relative(&self) -> Option<usize> {
        self.members.first()?.relative()
    }

    fn movers(&self) -> Vec<usize> {
        self.members.iter().map(|member| member.object).collect()
    }

    fn subject(&self, end: &End) -> usize {
        self.farthest(end).map_or(end.object, |(member, _)| member.object)
    }

    /// Returns all sets of as many members as must reach their goals, the smallest sum of scores
    /// first.
    fn choices(&self, state: &State) -> Vec<Vec<Goal>> {
        let score = |member: &Goal| Self::member_score(member, &End::resting(member.object, state));
        let scores: Vec<f64> = self.members.iter().map(score).collect();
        let chosen = |set: usize| (0..scores.len()).filter(move |k| set >> k & 1 == 1);
        let sets = 0..1usize << scores.len();
        let mut sets: Vec<usize> =
            sets.filter(|set| chosen(*set).count() == self.at_least).collect();
        let sum = |set: usize| chosen(set).map(|k| scores[k].max(1.0)).sum::<f64>();
        sets.sort_by(|a, b| sum(*a).total_cmp(&sum(*b)));
        sets.truncate(MOST_CHOICES);
        sets.into_iter().map(|set| chosen(set).map(|k| self.members[k].clone()).collect()).collect()
    }

    fn is_relation(&self) -> bool {
        true
    }

    fn is_at_rest(&self) -> bool {
        self.kinds().all(|kind| kind.is_at_rest())
    }

    fn falls(&self) -> bool {
        self.kinds().any(|kind| kind.falls())
    }

    fn fault(&self, _: usize, scene: &Scene) -> Option<String> {
        let count = self.members.len();
        if self.at_least == 0 || self.at_least > count || count > MOST {
            return Some(format!(
                "a group has 1 to {MOST} goals and requires at least one and at most all of them"
            ));
        }
        let objects = self.movers();
        let twice = |k: usize| objects[..k].contains(&objects[k]);
        if objects.iter().any(|k| *k >= scene.objects.len()) || (0..count).any(twice) {
            return Some(
                "the goals of a group must be for different objects of the scene".to_owned(),
            );
        }
        let words = |member: &Goal| member.clone().alike(1).words(scene);
        if self.members.iter().any(|member| words(member) != words(&self.members[0])) {
            return Some("the goals of a group must have the same demands".to_owned());
        }
        self.members.iter().find_map(|member| member.fault(scene))
    }

    fn check(&self, _: usize, scene: &Scene) -> Check {
        let of = self.members.iter().map(|member| member.check(scene)).collect();
        Check::AtLeast { count: self.at_least, of }
    }

    fn marks(&self, _: usize, scene: &Scene) -> Vec<Mark> {
        let mut marks = Vec::new();
        for mark in self.members.iter().flat_map(|member| member.shown(scene).marks) {
            if !marks.contains(&mark) {
                marks.push(mark);
            }
        }
        marks
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::Shape;
    use crate::scene::{Object, State};

    use super::*;

    fn scene() -> Scene {
        let at = |name: &str, y: f64| Object::cylinder(name, 0.03, 0.1).at(0.5, y, 0.0);
        Scene::new([at("a", 0.0), at("b", 0.15), at("c", 0.4)])
    }

    /// Two of three cylinders within 10 cm of (0.5, 0).
    fn two_of_three() -> Goal {
        let disc = Shape::Cylinder { radius: 0.1, height: 1.0 };
        let member = |object| Goal::within(object, disc, Pose::new(0.5, 0.0, 0.0));
        Group::of((0..3).map(member).collect(), 2).expect("members")
    }

    #[test]
    fn any_two_satisfy_a_group_and_the_second_nearest_is_its_error() {
        let (goal, start) = (two_of_three(), scene().start());
        assert!(!goal.reached(&start) && goal.fault(&scene()).is_none());
        assert_eq!((goal.movers(), goal.subject(&start)), (vec![0, 1, 2], 1));
        assert!((goal.error(&start) - 0.07).abs() < 1e-9, "{}", goal.error(&start));
        assert!(goal.score(&start) > 1.0);
        for pair in [[0, 1], [0, 2], [1, 2]] {
            let far = |k| if pair.contains(&k) { 0.0 } else { 0.6 };
            let poses = (0..3).map(|k| Pose::new(0.5, far(k), 0.0)).collect();
            let state = State::at_rest(poses);
            assert!(goal.reached(&state) && goal.score(&state) <= 1.0, "{pair:?}");
        }
    }

    #[test]
    fn the_nearest_choice_comes_first() {
        let choices = two_of_three().choices(&scene().start());
        let objects = |choice: &Vec<Goal>| choice.iter().map(|goal| goal.object).collect();
        let objects: Vec<Vec<usize>> = choices.iter().map(objects).collect();
        assert_eq!(objects, [vec![0, 1], vec![0, 2], vec![1, 2]]);
        assert!(choices.iter().flatten().all(|goal| goal.movers().len() == 1));
    }

    #[test]
    fn groups_that_ask_for_too_many_or_for_different_things_are_faults() {
        let member = |object, x| Goal::new(object, [x, 0.0], 0.02);
        let fault = |members, at_least| {
            Group::of(members, at_least).expect("members").fault(&scene()).is_some()
        };
        assert!(!fault(vec![member(0, 0.5), member(1, 0.5)], 2));
        assert!(fault(vec![member(0, 0.5), member(1, 0.5)], 3));
        assert!(fault(vec![member(0, 0.5), member(1, 0.6)], 1));
        assert!(fault(vec![member(0, 0.5), member(0, 0.5)], 1));
    }
}
