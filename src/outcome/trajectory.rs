//! What happened, or was predicted to happen: states frame by frame, contacts and warnings.

use crate::scene::Body;
use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, clearance};

use super::Warning;
use crate::scene::planar_only;
use crate::scene::{ModelSpec, Part, Scene, State, Tool};
use crate::task::{Job, Lift};

/// One recorded instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Since the start of the motion, seconds.
    pub time: f64,
    /// Index of the stroke that this instant ends or belongs to.
    pub stroke: usize,
    /// Pose of the tool frame.
    pub tool: Pose,
    /// Every object.
    pub state: State,
    /// The middle of the blade while something is levered; `tool` is then what is seen of it from
    /// above.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub blade: Option<Pose3>,
}

/// The first frame in which two bodies touched.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Index of the frame that ends with the contact made.
    pub frame: usize,
    /// The object that is touched.
    pub object: usize,
    /// What it touches; of a tool the part, by its number among [`Tool::parts`].
    pub with: Body,
}

/// How hard the tool presses against objects, newtons.
///
/// Read from the impulses of an engine's contacts, and right to within a factor of two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Force {
    /// The largest force in a single time step: mostly that of a first touch.
    pub peak: f64,
    /// The largest force that lasted for three time steps in a row.
    pub lasting: f64,
}

/// How far from the truth a prediction of an object's end is expected to be, on average.
///
/// Errors have long tails, about those of an exponential distribution: see [`Self::within_90`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Of its position, metres.
    pub position: f64,
    /// Of its heading, radians.
    pub heading: f64,
}

impl Spread {
    /// What 90 % of errors stay within, where they are exponential: ln 10 times the mean.
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

/// The effect of a tool motion.
///
/// `frames` begins with the start and ends at rest (or when waiting was given up, with a
/// warning). When only the outcome was asked for it holds the last frame alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    /// The model that computed it; where several share the work, the one that had this job.
    pub by: ModelSpec,
    /// In order of time.
    pub frames: Vec<Frame>,
    /// First contacts, in order of time; empty when only the outcome was asked for.
    pub contacts: Vec<Contact>,
    /// What the reader should know about how far to trust this.
    pub warnings: Vec<Warning>,
    /// How hard the tool pressed; `None` where the model does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<Force>,
    /// How far off the end of every object is expected to be, in the order of the scene; empty where
    /// the model does not say.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spreads: Vec<Spread>,
    /// What each lever-up has come to, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lifts: Vec<Lift>,
}

impl Trajectory {
    /// Nothing yet, computed `by` this model.
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

    /// `state` alone, the tool at `tool`, where nothing is done.
    pub fn standing(by: ModelSpec, tool: Pose, state: State) -> Self {
        let frame = Frame { time: 0.0, stroke: 0, tool, state, blade: None };
        Self { frames: vec![frame], ..Self::new(by) }
    }

    /// Returns the answer of a model that does not know the motion of `job`: everything stays where it is.
    pub fn declined(by: &ModelSpec, job: &Job) -> Self {
        let mut declined = Self::standing(by.clone(), Pose::default(), job.start.clone());
        declined.warnings.push(Warning::Declined { model: by.clone() });
        declined
    }

    /// This and what came after it, which began as this ended; `strokes` were made before.
    #[must_use]
    pub(super) fn then(mut self, next: Self, record: Record, strokes: usize) -> Self {
        let began = self.frames.last().map_or(0.0, |frame| frame.time);
        // How it began is how this ended.
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
        self.contacts.extend(next.contacts.into_iter().map(|mut contact| {
            contact.frame += before;
            contact
        }));
        for warning in next.warnings {
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
            // Errors of one motion go on into the next.
            false => self.spreads.iter_mut().zip(next.spreads).for_each(|(a, b)| *a += b),
        }
        self.lifts.extend(next.lifts);
        self
    }

    /// Says which parts of `tool` its contacts are with, where they were noted with pieces of its outline,
    /// in which flush parts are one: the part that is nearest then.
    pub fn tell_parts(&mut self, scene: &Scene, tool: &Tool) {
        let mut told: Vec<Contact> = Vec::with_capacity(self.contacts.len());
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
            if !told.iter().any(same) {
                told.push(contact);
            }
        }
        self.contacts = told;
    }

    /// The last recorded state.
    ///
    /// # Panics
    /// Never for a trajectory that an effect model returned: those have at least one frame.
    pub fn outcome(&self) -> &State {
        &self.frames[self.frames.len() - 1].state
    }
}

/// How much of a rollout is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Record {
    /// Only the last frame.
    Outcome,
    /// Every frame and the first contacts.
    Frames,
}
