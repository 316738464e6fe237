//! One frame: what everything does in it, and the forces that make it so.

use crate::{
    geometry::Vector,
    scene::{FrameStep, State},
};

use super::{
    awake::{Awake, View},
    bodies::Bodies,
    coast::coast,
    forces::FrameForces,
    index::{AwakeIndex, ListIndex},
    march::March,
    motion::Motion,
    pairs::PairId,
    points::{Contact, MARGIN, Scenery, find_contacts},
    prior::Prior,
    tally::Tally,
};

/// Steps that a frame of several objects is solved in. What they do to each other depends on
/// what happens first: of 60 sparse trajectories with fixed joints the mean error of a stroke is
/// 3.4 mm with 1, 1.06 with 4 and 1.07 with 8. One object alone needs no such care.
const PIECES: usize = 4;

/// What a frame begins with, and what the tool does in it.
#[derive(Clone, Copy, Debug)]
pub struct FrameProblem<'a> {
    /// The bodies that matter.
    pub bodies: &'a Bodies,
    /// Where their objects are and how they move.
    pub state: &'a State,
    /// What the tool does.
    pub step: &'a FrameStep,
    /// Unit vector of the tool's motion, the last one while it stands still.
    pub axis: Vector,
}

/// The equations of a frame, and memory to solve them that one frame leaves for the next. The
/// answer depends on the frame alone.
#[derive(Clone, Debug, Default)]
pub struct FrameSolver {
    coasts: Vec<Motion>,
    contacts: Vec<Contact>,
    awake: Awake,
    prior: Prior,
    march: March,
}

/// A solved frame. Only what may do anything but coast enters its equations; all that is public
/// here is about those objects, under their numbers in `bodies`.
#[derive(Clone, Copy, Debug)]
pub struct FrameSolution<'a> {
    /// The objects that are awake, the tool's parts and the obstacles.
    pub bodies: &'a Bodies,
    /// The objects' state as the frame begins.
    pub state: &'a State,
    /// What the tool does.
    pub step: &'a FrameStep,
    /// Unit vector of the tool's motion, the last one while it stands still.
    pub axis: Vector,
    /// What the objects would do if nothing touched or held them.
    pub coasts: &'a [Motion],
    /// What they do.
    pub motions: &'a [Motion],
    /// Where bodies touch or may come to.
    pub contacts: &'a [Contact],
    all: &'a [Motion],
    awake: &'a Awake,
}

/// Two bodies that touch, or come to touch, in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The two.
    pub pair: PairId,
    /// Whether they would overlap if the first of them (see [`super::Pairs::bodies`]) only
    /// coasted, and whether if the second did; one of it at least.
    pub stops: [bool; 2],
    /// How deep they are inside each other as the frame begins, metres; negative before they
    /// touch.
    pub depth: f64,
    /// Unit, into the first.
    pub normal: Vector,
}

impl FrameSolver {
    /// What all frames so far took.
    pub fn tally(&self) -> Tally {
        let mut tally = Tally::default();
        for prior in [&self.prior, &self.march.prior] {
            tally.add(&prior.system.tally);
            tally.add(&prior.velocities.tally);
        }
        tally
    }

    /// What everything does in the frame.
    pub fn solve<'a>(&'a mut self, problem: FrameProblem<'a>) -> FrameSolution<'a> {
        if self.wake(problem) {
            let Self { coasts, contacts, awake, prior, march } = &mut *self;
            let scenery = scenery(problem, awake, coasts);
            match scenery.bodies.objects[..] {
                [_] => prior.solve(scenery, problem.axis, contacts),
                _ => march.run(scenery, contacts, problem.axis, PIECES, &mut prior.motions),
            }
        }
        self.solution(problem)
    }

    /// The same with the forces that, acting over the whole frame, do so.
    pub fn solve_with_forces<'a>(
        &'a mut self,
        problem: FrameProblem<'a>,
    ) -> (FrameSolution<'a>, FrameForces<'a>) {
        self.press(problem, usize::MAX);
        let solution = self.solution(problem);
        let FrameSolution { bodies, state, .. } = solution;
        (solution, FrameForces::new(bodies, state, &self.prior))
    }

    /// The same, without the forces where more than `most` objects are awake.
    pub fn solve_with_forces_of_few<'a>(
        &'a mut self,
        problem: FrameProblem<'a>,
        most: usize,
    ) -> (FrameSolution<'a>, Option<FrameForces<'a>>) {
        let few = self.press(problem, most);
        let solution = self.solution(problem);
        let FrameSolution { bodies, state, .. } = solution;
        (solution, few.then(|| FrameForces::new(bodies, state, &self.prior)))
    }

    /// Finds motions, and forces if at most `most` objects are awake; returns whether so few are.
    fn press(&mut self, problem: FrameProblem, most: usize) -> bool {
        if !self.wake(problem) {
            return true;
        }
        let Self { coasts, contacts, awake, prior, march } = &mut *self;
        let scenery = scenery(problem, awake, coasts);
        let few = scenery.bodies.objects.len() <= most;
        if let [_] = scenery.bodies.objects[..] {
            prior.solve(scenery, problem.axis, contacts);
        } else {
            if few {
                prior.press(scenery, problem.axis, contacts, None);
            }
            march.run(scenery, contacts, problem.axis, PIECES, &mut prior.motions);
        }
        few
    }

    /// Finds how everything coasts, what touches and what is awake, and takes that by itself;
    /// returns whether anything is.
    fn wake(&mut self, FrameProblem { bodies, state, step, .. }: FrameProblem) -> bool {
        let Self { coasts, contacts, awake, prior, .. } = self;
        coasts.clear();
        let objects = bodies.objects.iter().zip(&state.velocities);
        coasts.extend(objects.map(|(body, velocity)| coast(body, velocity, step.duration)));
        find_contacts(Scenery { bodies, state, step, coasts, margin: MARGIN }, contacts);
        awake.find(bodies, contacts, coasts, step);
        prior.motions.clear();
        awake.gather(bodies, state, coasts, contacts)
    }

    fn solution<'a>(&'a self, problem: FrameProblem<'a>) -> FrameSolution<'a> {
        let FrameProblem { bodies, state, step, axis } = problem;
        let View { bodies, state, coasts } = self.awake.view(bodies, state, &self.coasts);
        FrameSolution {
            bodies,
            state,
            step,
            axis,
            coasts,
            motions: &self.prior.motions,
            contacts: &self.contacts,
            all: &self.coasts,
            awake: &self.awake,
        }
    }
}

fn scenery<'a>(problem: FrameProblem<'a>, awake: &'a Awake, coasts: &'a [Motion]) -> Scenery<'a> {
    let View { bodies, state, coasts } = awake.view(problem.bodies, problem.state, coasts);
    Scenery { bodies, state, step: problem.step, coasts, margin: MARGIN }
}

impl FrameSolution<'_> {
    /// Which of the frame's objects an object that is awake is.
    pub fn listed(&self, object: AwakeIndex) -> ListIndex {
        self.awake.listed(object)
    }

    /// Fills `motions` with those of all of the frame's objects, awake or not.
    pub fn fill(&self, motions: &mut Vec<Motion>) {
        motions.clear();
        motions.extend_from_slice(self.all);
        for (object, motion) in self.motions.iter().enumerate() {
            motions[self.listed(AwakeIndex(object)).0] = *motion;
        }
    }

    /// What touches, or comes to.
    pub fn touches(&self) -> impl Iterator<Item = Touch> {
        self.contacts.iter().filter_map(|contact| {
            let stops = contact.sights().map(|sight| {
                sight.is_some_and(|sight| {
                    sight.overlap(&self.coasts[sight.receiver], self.motions) > 0.0
                })
            });
            let Contact { pair, gap, normal, .. } = *contact;
            stops.contains(&true).then_some(Touch { pair, stops, depth: -gap, normal })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        contact::{Pairs, Partner, SceneIndex},
        geometry::Pose,
        scene::{Body, GRAVITY, Object, Part, Physics, Scene, Tool},
    };

    /// A can far off, one that a bar touches and one behind that.
    fn scene() -> Scene {
        let can = |x: f64| {
            Object::cylinder(format!("{x}"), 0.03, 0.1).mass(0.5).friction(0.5).at(x, 0.0, 0.0)
        };
        Scene::new([can(1.0), can(0.03), can(0.0905)])
    }

    fn bodies(scene: &Scene) -> Bodies {
        let bar = Part::cuboid("bar", [0.02, 0.1, 0.1], Pose::new(-0.01, 0.0, 0.0));
        let tool = Tool::new("bar", [bar]).expect("one piece").friction(0.5);
        Bodies::new(scene, &tool, 0.002, &Physics::stated(scene))
    }

    /// Slow, so that friction with the table is nearly all that resists.
    fn step(travel: f64) -> FrameStep {
        FrameStep { from: Pose::default(), to: Pose::new(travel, 0.0, 0.0), duration: 0.5 }
    }

    #[test]
    fn what_sleeps_stays_and_what_is_awake_keeps_its_names() {
        let (scene, step) = (scene(), step(0.005));
        let (bodies, state) = (bodies(&scene), scene.start());
        let mut solver = FrameSolver::default();
        let problem =
            FrameProblem { bodies: &bodies, state: &state, step: &step, axis: Vector::x() };
        let frame = solver.solve(problem);
        assert_eq!(frame.motions.len(), 2);
        assert_eq!([0, 1].map(|k| frame.listed(AwakeIndex(k))), [1, 2].map(ListIndex));
        let mut motions = Vec::new();
        frame.fill(&mut motions);
        assert_eq!(motions[0], Motion::default());
        assert!(motions[1].shift.x > motions[2].shift.x && motions[2].shift.x > 0.004);
        let pairs = Pairs::new(3, 0, 1);
        let touched: Vec<PairId> = frame.touches().map(|touch| touch.pair).collect();
        let id = |object, with| pairs.id(SceneIndex(object), with);
        assert_eq!(touched, [id(1, Body::Part(0)), id(1, Body::Object(2))]);
    }

    #[test]
    fn the_forces_are_those_of_friction_and_leave_the_motions_alone() {
        let (scene, step) = (scene(), step(0.005));
        let (bodies, state) = (bodies(&scene), scene.start());
        let problem =
            FrameProblem { bodies: &bodies, state: &state, step: &step, axis: Vector::x() };
        let mut solver = FrameSolver::default();
        let motions = solver.solve(problem).motions.to_vec();
        let (frame, forces) = solver.solve_with_forces(problem);
        assert_eq!(frame.motions, motions);
        let weight = 0.5 * 0.5 * GRAVITY;
        for (index, contact) in frame.contacts.iter().enumerate() {
            let pushed = if let Partner::Part(_) = contact.with { 2.0 } else { 1.0 };
            let force = forces.normal(index);
            assert!((force / (pushed * weight) - 1.0).abs() < 0.05, "{force} {contact:?}");
            assert!(forces.by_contact(index, contact.object).0.norm() > 0.0);
        }
        let (frame, forces) = solver.solve_with_forces_of_few(problem, 1);
        assert!(frame.motions == motions && forces.is_none());
        assert!(solver.solve_with_forces_of_few(problem, 2).1.is_some());
    }

    #[test]
    fn where_nothing_is_near_everything_coasts() {
        let (scene, step) = (scene(), step(-0.01));
        let bodies = bodies(&scene);
        let mut state = scene.start();
        state.poses[1] = Pose::new(0.5, 0.5, 0.0);
        state.velocities[0].linear = Vector::new(0.1, 0.0);
        let mut solver = FrameSolver::default();
        let problem =
            FrameProblem { bodies: &bodies, state: &state, step: &step, axis: Vector::x() };
        let frame = solver.solve(problem);
        assert!(frame.motions.is_empty() && frame.contacts.is_empty());
        assert_eq!(frame.touches().count(), 0);
        let mut motions = Vec::new();
        frame.fill(&mut motions);
        let coasted = coast(&bodies.objects[0], &state.velocities[0], step.duration);
        assert_eq!(motions, [coasted, Motion::default(), Motion::default()]);
    }
}
