//! Observed or predicted trajectories: states frame by frame, contacts and warnings.

use crate::scene::Body;
use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, clearance};

use super::Warning;
use crate::scene::planar_only;
use crate::scene::{ModelSpec, Part, Scene, State, Tool};
use crate::task::{Job, Lift};

/// Recorded instant of a trajectory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Time since the start of the motion, seconds.
    pub time: f64,
    /// Index of the stroke that this instant ends or belongs to.
    pub stroke: usize,
    /// Pose of the tool frame.
    pub tool: Pose,
    /// State of all objects.
    pub state: State,
    /// Pose of the middle of the blade during a lever-up; `tool` is then its projection from above.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub blade: Option<Pose3>,
}

/// First contact of two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Index of the frame at whose end the bodies are in contact.
    pub frame: usize,
    /// Index of the touched object.
    pub object: usize,
    /// Body in contact with the object. A part of a tool is given by its index among
    /// [`Tool::parts`].
    pub with: Body,
}

/// Force of the tool on objects, newtons.
///
/// Computed from the contact impulses of an engine, and accurate to within a factor of two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Force {
    /// Largest force in a single time step: mostly the force of the first impact.
    pub peak: f64,
    /// Largest force sustained for three consecutive time steps.
    pub lasting: f64,
}

/// Expected error of the predicted final pose of an object, on average.
///
/// Errors have long tails, approximately exponential: see [`Self::within_90`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Mean position error, metres.
    pub position: f64,
    /// Mean heading error, radians.
    pub heading: f64,
}

impl Spread {
    /// Expected error from which a prediction is doubtful, metres: the 90th percentile for similar
    /// pushes. Three times the usual value.
    pub const DOUBTFUL: f64 = 0.02;

    /// Returns the 90 % quantile of an exponential distribution of errors: ln 10 times the mean.
    pub fn within_90(&self) -> Self {
        let factor = std::f64::consts::LN_10;
        Self { position: factor * self.position, heading: factor * self.heading }
    }
}

impl std::ops::AddAssign for Spread {
    fn add_assign(&mut self, other: Self) {
        self.position += other.position;
        self.heading += other.heading;
    }
}

/// Effect of a tool motion.
///
/// `frames` begins with the start state and ends at rest, or with a warning when the time limit for
/// settling is reached. With [`Record::Outcome`] it holds only the last frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    /// Model that computed the trajectory; among several models, the one that received this job.
    pub by: ModelSpec,
    /// Recorded frames, in order of time.
    pub frames: Vec<Frame>,
    /// First contacts, in order of time; empty with [`Record::Outcome`].
    pub contacts: Vec<Contact>,
    /// Warnings about the reliability of this trajectory.
    pub warnings: Vec<Warning>,
    /// Force of the tool on objects; `None` if the model does not compute it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<Force>,
    /// Expected error of the final pose of every object, in the order of the scene; empty if the
    /// model does not estimate it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spreads: Vec<Spread>,
    /// Result of each lever-up, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lifts: Vec<Lift>,
}

impl Trajectory {
    /// Creates an empty trajectory computed `by` this model.
    pub fn new(by: ModelSpec) -> Self {
        Self {
            by,
            frames: Vec::new(),
            contacts: Vec::new(),
            warnings: Vec::new(),
            force: None,
            spreads: Vec::new(),
            lifts: Vec::new(),
        }
    }

    /// Creates a trajectory without motion: `state` alone, with the tool at `tool`.
    pub fn standing(by: ModelSpec, tool: Pose, state: State) -> Self {
        let frame = Frame { time: 0.0, stroke: 0, tool, state, blade: None };
        Self { frames: vec![frame], ..Self::new(by) }
    }

    /// Returns the trajectory of a model that does not support the motion of `job`: everything
    /// stays in place.
    pub fn declined(by: &ModelSpec, job: &Job) -> Self {
        let mut declined = Self::standing(by.clone(), Pose::default(), job.start.clone());
        declined.warnings.push(Warning::Declined { model: by.clone() });
        declined
    }

    /// Appends the trajectory `next`, which starts where this one ends, after the given number of
    /// strokes.
    #[must_use]
    pub(super) fn then(mut self, next: Self, record: Record, strokes: usize) -> Self {
        let began = self.frames.last().map_or(0.0, |frame| frame.time);
        // The first frame of `next` repeats the last one of `self`.
        let known = match record {
            Record::Frames => 1,
            Record::Outcome => 0,
        };
        let before = self.frames.len().saturating_sub(1);
        if record == Record::Outcome {
            self.frames.clear();
        }
        self.frames.extend(next.frames.into_iter().skip(known).map(|mut frame| {
            frame.time += began;
            frame.stroke += strokes;
            frame
        }));
        for mut contact in next.contacts {
            contact.frame += before;
            let same =
                |known: &Contact| (known.object, known.with) == (contact.object, contact.with);
            if !self.contacts.iter().any(same) {
                self.contacts.push(contact);
            }
        }
        for mut warning in next.warnings {
            if let Warning::SetDownOn { stroke, .. } = &mut warning {
                *stroke += strokes;
            }
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        }
        self.force = match (self.force, next.force) {
            (Some(a), Some(b)) => {
                Some(Force { peak: a.peak.max(b.peak), lasting: a.lasting.max(b.lasting) })
            }
            (a, b) => a.or(b),
        };
        match self.spreads.is_empty() {
            true => self.spreads = next.spreads,
            // Errors of consecutive motions add up.
            false => self.spreads.iter_mut().zip(next.spreads).for_each(|(a, b)| *a += b),
        }
        self.lifts.extend(next.lifts);
        self
    }

    /// Replaces outline pieces in the contacts by the nearest parts of `tool`, because flush parts
    /// are merged in the outline.
    pub fn resolve_parts(&mut self, scene: &Scene, tool: &Tool) {
        let mut resolved: Vec<Contact> = Vec::with_capacity(self.contacts.len());
        for mut contact in std::mem::take(&mut self.contacts) {
            let at = contact.frame.min(self.frames.len().saturating_sub(1));
            if let (Body::Part(_), Some(frame)) = (contact.with, self.frames.get(at)) {
                let own = scene.objects[contact.object].shape.footprint();
                let own = (&own, &frame.state.poses[contact.object]);
                let apart = |part: &Part| {
                    let pose = frame.tool * part.pose;
                    clearance(own, (&part.footprint(), &pose), f64::MAX)
                };
                let gaps = tool.parts().iter().map(apart).enumerate();
                let nearest = gaps.min_by(|a, b| a.1.total_cmp(&b.1));
                contact.with = Body::Part(nearest.map_or(0, |(part, _)| part));
            }
            let same =
                |known: &Contact| known.object == contact.object && known.with == contact.with;
            if !resolved.iter().any(same) {
                resolved.push(contact);
            }
        }
        self.contacts = resolved;
    }

    /// Returns the last recorded state.
    ///
    /// # Panics
    /// Never for a trajectory returned by an effect model, which has at least one frame.
    pub fn outcome(&self) -> &State {
        &self.frames[self.frames.len() - 1].state
    }
}

/// Extent of a rollout's recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Record {
    /// Only the last frame.
    Outcome,
    /// Every frame and the first contacts.
    Frames,
}
