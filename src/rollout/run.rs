//! The rollout of a single job.

use crate::{
    contact::{Bodies, FrameProblem, Motion, Movable, Touch},
    geometry::{Pose, Vector},
    outcome::{Contact, Frame, ObjectRules, Record, Trajectory, Warning},
    scene::{Body, ModelSpec, REST_SPEED, Region, Scene, State, Velocity},
    task::{COAST_FRAME, FrameStep, Job, MAX_COAST_FRAMES, Stroke},
};

use super::{
    correction::Reading,
    doubt::{Depths, loosest_joint},
    integrate::integrate,
    pressing::Pressing,
    reach::{Course, Listed, Reach},
    reads::Reads,
    settings::RollSettings,
    stepper::{Found, Walk},
    work::Work,
};

/// Memory of one job, reused for the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    subset: Listed,
    reach: Reach,
    /// State of the listed objects, in the numbering of `subset`.
    state: State,
    before: State,
}

/// A job in progress.
pub(super) struct Run<'a> {
    scene: &'a Scene,
    rules: ObjectRules<'a>,
    job: &'a Job,
    /// Bodies of the whole scene.
    whole: &'a Bodies,
    memory: &'a mut Memory,
    settings: RollSettings,
    record: Record,
    /// State of all objects. Listed objects are up to date whenever a frame is complete.
    state: State,
    /// Whether the next frame needs a new list.
    stale: bool,
    /// Whether the last frame had no graph, so that looking ahead pays off.
    idle: bool,
    /// First frame of the stroke in which the tool comes near a body, provided that nothing moves
    /// before; `None` if not yet computed.
    apart_until: Option<usize>,
    stroke: usize,
    /// Number of completed frames of the stroke, including frames at rest.
    frame: usize,
    time: f64,
    axis: Vector,
    /// The frame to compute next; `None` at the end of the job.
    step: Option<FrameStep>,
    /// Number of the stroke's frames that the step covers.
    span: usize,
    /// Deepest overlaps during the rollout.
    depths: Depths,
    /// Whether an object is blocked: only the last frame is kept from then on.
    blocked: bool,
    pressing: Pressing,
    pub work: Work,
    reads: Reads,
    trajectory: Trajectory,
}

impl<'a> Run<'a> {
    pub fn new(
        scene: &'a Scene,
        job: &'a Job,
        whole: &'a Bodies,
        memory: &'a mut Memory,
        settings: RollSettings,
        record: Record,
        by: &ModelSpec,
    ) -> Self {
        let mut run = Self {
            scene,
            rules: ObjectRules::of(scene).apart(Region::MARGIN).starting(&job.start),
            job,
            whole,
            memory,
            settings,
            record,
            state: job.start.clone(),
            stale: true,
            idle: true,
            apart_until: None,
            stroke: 0,
            frame: 0,
            time: 0.0,
            axis: Vector::x(),
            step: None,
            span: 1,
            depths: Depths::default(),
            blocked: false,
            pressing: Pressing::default(),
            work: Work { rollouts: 1, ..Work::default() },
            reads: Reads::new(scene.objects.len()),
            trajectory: Trajectory::new(by.clone()),
        };
        if record == Record::Frames {
            let first = job.motion.slide().strokes.first();
            run.keep_frame(first.map(|stroke| stroke.from).unwrap_or_default());
        }
        run
    }

    /// Advances to the tool's next frame that can change anything.
    fn next_step(&mut self) {
        self.step = None;
        while let Some(stroke) = self.job.motion.slide().strokes.get(self.stroke) {
            let moving = stroke.frames();
            if self.frame < moving {
                self.axis = stroke.direction().unwrap_or(self.axis);
                self.span = self.settings.stride.clamp(1, moving - self.frame);
                let step = stroke.frames_from(self.frame, self.span);
                self.look(stroke, step.duration);
                if self.frame == 0 {
                    self.set_down();
                }
                self.work.moving += 1;
                if self.idle && self.settings.pruned && self.is_still() && self.is_apart(stroke) {
                    self.work.skipped += 1;
                    self.pass(&step);
                    continue;
                }
                self.step = Some(step);
                return;
            }
            self.span = 1;
            if stroke.settle && !self.is_resting() {
                if self.frame < moving + MAX_COAST_FRAMES {
                    let duration = COAST_FRAME;
                    self.look(stroke, duration);
                    self.step = Some(FrameStep { from: stroke.to, to: stroke.to, duration });
                    self.work.coasting += 1;
                    return;
                }
                let waited = MAX_COAST_FRAMES as f64 * COAST_FRAME;
                self.trajectory.warnings.push(Warning::NotAtRest { waited });
            }
            self.stroke += 1;
            self.frame = 0;
            self.stale = true;
        }
    }

    /// Ensures that the list contains everything that the coming frame of `stroke` can relate.
    fn look(&mut self, stroke: &Stroke, duration: f64) {
        let Memory { subset, reach, state, .. } = &mut *self.memory;
        if self.settings.pruned {
            if !self.stale && reach.holds(&subset.bodies, state, duration) {
                return;
            }
            let course = Course { stroke, frame: self.frame, stride: self.settings.stride };
            reach.list(self.whole, &self.state, course, duration, subset);
        } else {
            if self.stroke > 0 || self.frame > 0 {
                return;
            }
            subset.list_all(self.whole);
            subset.gather(self.whole);
        }
        self.stale = false;
        self.apart_until = None;
        self.work.lists += 1;
        self.work.listed += subset.objects.len() as u64;
        subset.gather_state(&self.state, state);
    }

    /// Adds a warning for every object on which the tool is set down at the start of the stroke.
    fn set_down(&mut self) {
        let motion = self.job.motion.slide();
        let before = self.stroke.checked_sub(1).map(|before| &motion.strokes[before]);
        if before.is_some_and(|before| !before.settle) {
            return;
        }
        for object in motion.set_down_on(self.scene, &self.state, self.stroke) {
            let object = self.scene.thing_name(object).to_owned();
            let stroke = self.stroke;
            self.trajectory.warnings.push(Warning::SetDownOn { object, stroke });
        }
    }

    /// Adds warnings for violations that cannot occur on a real table.
    fn doubt(&mut self) {
        let Some(stroke) = self.job.motion.slide().strokes.last() else { return };
        let moved = |k: usize| self.state.poses[k] != self.job.start.poses[k];
        let name = |body: Body| match body {
            Body::Object(k) => self.scene.thing_name(k).to_owned(),
            Body::Obstacle(k) => self.scene.obstacles[k].name.clone(),
            Body::Part(k) => {
                let tool = &self.job.motion.slide().tool;
                format!("{}/{}", tool.name, tool.outline()[k].name)
            }
        };
        self.depths.note_all(self.whole, &self.state, &stroke.to, moved);
        let jam = self.depths.jam.map(|(object, with, depth)| Warning::Jammed {
            object: name(Body::Object(object)),
            against: name(with),
            depth,
        });
        let overlap = self.depths.sunk().map(|(object, with, depth)| Warning::Overlap {
            between: [name(Body::Object(object)), name(with)],
            depth,
        });
        let loose = loosest_joint(self.whole, &self.state, moved);
        let loose = loose.filter(|([a, b], _)| self.scene.thing(*a) != self.scene.thing(*b));
        let loose = loose.map(|(between, distance)| Warning::LooseJoint {
            between: between.map(|k| name(Body::Object(k))),
            distance,
        });
        let pressed = self.pressing.found.map(|(object, between)| Warning::Pressed {
            object: name(Body::Object(object)),
            between: between.map(name),
        });
        self.trajectory.warnings.extend(pressed);
        self.trajectory.warnings.extend(jam);
        self.trajectory.warnings.extend(overlap);
        self.trajectory.warnings.extend(loose);
    }

    /// Returns `true` if nothing moves.
    fn is_still(&self) -> bool {
        self.memory.state.velocities.iter().all(|v| *v == Velocity::default())
    }

    /// Returns `true` if everything is slow enough to count as resting, see
    /// [`crate::scene::Scene::is_resting`]; unlisted objects do not move.
    fn is_resting(&self) -> bool {
        let slow = |(body, v): (&Movable, &Velocity)| {
            v.linear.norm() < REST_SPEED && v.angular.abs() * body.radius < REST_SPEED
        };
        let Memory { subset, state, .. } = &*self.memory;
        subset.bodies.objects.iter().zip(&state.velocities).all(slow)
    }

    /// Returns `true` if the tool is still out of reach in the coming frame, provided that nothing
    /// moves.
    fn is_apart(&mut self, stroke: &Stroke) -> bool {
        let Memory { subset, reach, state, .. } = &*self.memory;
        let first = || reach.first_contact(subset, state, stroke, self.frame);
        // Computed once, because nothing moves before the first contact.
        let until = *self.apart_until.get_or_insert_with(first);
        self.frame < until
    }

    /// Skips the frame of `step`, in which nothing moves.
    fn pass(&mut self, step: &FrameStep) {
        self.memory.before.clone_from(&self.memory.state);
        self.end_frame(step);
    }

    /// Completes the frame of `step` and records it.
    fn end_frame(&mut self, step: &FrameStep) {
        self.frame += self.span;
        if self.record == Record::Frames && self.span > 1 && !self.blocked {
            self.keep_between(step);
        }
        self.time += step.duration;
        if !self.blocked
            && let Some(warning) = self.rules.broken(&self.state)
        {
            self.trajectory.warnings.push(warning);
            self.blocked = true;
        }
        if self.record == Record::Frames && !self.blocked {
            self.keep_frame(step.to);
        }
    }

    /// Records the frames covered by a longer step, with objects on straight paths.
    fn keep_between(&mut self, step: &FrameStep) {
        let began = self.time;
        for k in 1..=self.span {
            let share = k as f64 / self.span as f64;
            let Memory { subset, state, before, .. } = &*self.memory;
            for (own, object) in subset.objects.iter().enumerate() {
                let (from, to) = (before.poses[own], state.poses[own]);
                // The last frame has the exact poses.
                self.state.poses[object.0] =
                    if k < self.span { from.towards(&to, share) } else { to };
            }
            if k < self.span {
                self.time = began + share * step.duration;
                self.keep_frame(step.from.towards(&step.to, share));
            }
        }
        self.time = began;
    }

    fn keep_frame(&mut self, tool: Pose) {
        self.trajectory.frames.push(Frame {
            blade: None,
            time: self.time,
            stroke: self.stroke,
            tool,
            state: self.state.clone(),
        });
    }

    /// Records a contact.
    fn touch(&mut self, touch: &Touch) {
        let (first, with) = self.whole.pairs.bodies(touch.pair);
        if let Some(step) = &self.step {
            let travel = step.to.position - step.from.position;
            self.pressing.touch(first.0, with, touch.depth, touch.normal, travel);
        }
        let other = |second| (second, Body::Object(first.0));
        let second = if let Body::Object(second) = with { Some(other(second)) } else { None };
        for ((object, with), stops) in
            [Some((first.0, with)), second].into_iter().flatten().zip(touch.stops)
        {
            if stops {
                self.meet(object, with, touch.depth);
            }
        }
    }

    /// Records that `object` meets another body.
    fn meet(&mut self, object: usize, with: Body, depth: f64) {
        // Objects that the tool is set down on, or that overlap at the start, are no fault of the
        // model.
        if self.frame > 0 && self.depths.note(object, with, depth) {
            // The overlap was already this deep at the end of the last frame.
            if self.trajectory.frames.len() > 1 {
                self.trajectory.frames.pop();
            }
            self.blocked = true;
        }
        if self.record != Record::Frames {
            return;
        }
        let known = self.trajectory.contacts.iter().any(|c| c.object == object && c.with == with);
        if !known {
            let frame = self.trajectory.frames.len();
            self.trajectory.contacts.push(Contact { frame, object, with });
        }
    }

    /// Completes the job and returns its analytic trajectory.
    pub fn finish(mut self) -> Reading {
        self.doubt();
        let motion = self.job.motion.slide();
        if self.trajectory.frames.is_empty() || self.blocked {
            self.stroke = motion.strokes.len().saturating_sub(1);
            self.keep_frame(motion.strokes.last().map(|stroke| stroke.to).unwrap_or_default());
        }
        self.trajectory.resolve_parts(self.scene, &motion.tool);
        Reading { trajectory: self.trajectory, reads: self.reads.all }
    }
}

impl Walk for Run<'_> {
    fn next(&mut self) -> Option<(FrameProblem<'_>, bool)> {
        self.next_step();
        let Memory { subset, state, .. } = &*self.memory;
        let step = self.step.as_ref()?;
        let problem = FrameProblem { bodies: &subset.bodies, state, step, axis: self.axis };
        Some((problem, self.reads.next))
    }

    fn note(&mut self, found: Found<'_>) {
        self.idle = found.awake == 0;
        if !self.idle {
            self.apart_until = None;
        }
        self.work.graphs += u64::from(!self.idle);
        self.work.nodes += found.awake as u64;
        self.work.relations += found.relations as u64;
        self.reads.note(&found, &self.memory.subset.objects);
        found.touches.iter().for_each(|touch| self.touch(touch));
    }

    /// Applies the frame's motions. A state that is not finite ends the job at the last finite one,
    /// with a warning.
    fn advance(&mut self, motions: &[Motion]) {
        let Some(step) = self.step else { return };
        self.pressing.begin();
        let Memory { subset, state, before, .. } = &mut *self.memory;
        before.clone_from(state);
        integrate(&subset.bodies, state, motions, &step);
        if !state.is_finite() {
            std::mem::swap(state, before);
            self.trajectory.warnings.push(Warning::NotFinite);
            self.stroke = self.job.motion.slide().strokes.len();
            return;
        }
        subset.return_state(state, &mut self.state);
        let before = self.trajectory.frames.len().saturating_sub(1);
        self.end_frame(&step);
        let after = self.trajectory.frames.len().saturating_sub(1);
        self.reads.advance(motions, &self.memory.subset.bodies, [before, after], self.axis);
    }
}
