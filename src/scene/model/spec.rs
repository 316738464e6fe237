//! Identifiers of effect models: kinds, settings, assumptions and fallbacks.

use std::num::{NonZeroU8, NonZeroU16};

use crate::scene::Engine;

use super::Assumptions;

/// Maximum number of moving objects in a frame that the network reads. With more objects, reading
/// costs more time than the analytic model and does not improve the prediction.
pub const CORRECTED: usize = 5;

/// An effect model as users and tables name it: `prior`, `planar,step=1/120`,
/// `prior,up-to=2|planar,step=1/120`.
///
/// ```text
/// spec = part { "|" part }             a job goes to the first part that accepts it
/// part = kind { "," key "=" value }
/// kind = network | prior | planar | 3d | 3d-upright | still
/// ```
///
/// | key | of | value |
/// | --- | --- | --- |
/// | `weights` | `network` | a weights file instead of the shipped one; in quotes if it holds `,`, `\|` or `"` |
/// | `steps` | `network` | number of propagation steps, instead of the trained number |
/// | `frame` | `network`, `prior` | the tool's travel in a frame, multiples of `10mm` |
/// | `step` | `planar`, `3d` | the engine's time step in seconds, `1/N` |
/// | `joints` | all | assumed joints: `none`, their geometry `guessed`, or every contact `fixed` |
/// | `friction` | all | assumed share of every friction value, `70%` |
/// | `start` | all | assumed error of the start poses, `100um` |
/// | `up-to` | all | maximum number of objects that the tool can set in motion in an accepted job |
///
/// [`std::fmt::Display`] and [`std::str::FromStr`] are inverse except for custom models. A text
/// that is only a path ending in `.safetensors` is short for `network,weights=` and that file.
///
/// ```
/// use pushplan::{ModelSpec, models::ModelKind};
///
/// let spec: ModelSpec = "prior,up-to=2|planar,step=1/120".parse()?;
/// let fallback: ModelSpec = "planar,step=1/120".parse()?;
/// assert_eq!(spec, ModelSpec::from(ModelKind::PRIOR).up_to(2).or(fallback));
/// assert_eq!(spec.to_string(), "prior,up-to=2|planar,step=1/120");
/// let error = "quasi-static".parse::<ModelSpec>().unwrap_err();
/// assert!(error.to_string().contains("use network, prior, planar"));
/// # Ok::<(), pushplan::models::SpecError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ModelSpec {
    first: ModelPart,
    others: Vec<ModelPart>,
}

/// A single model of a [`ModelSpec`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ModelPart {
    /// Kind with its settings.
    pub kind: ModelKind,
    /// Assumptions that replace values of the job.
    pub assumptions: Assumptions,
    /// Maximum number of objects that the tool can set in motion in an accepted job.
    pub up_to: Option<u16>,
}

/// The kinds of effect models with their settings.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ModelKind {
    /// The trained network, which corrects the analytic model.
    Network {
        /// Path of the weights file; `None` for the shipped weights.
        weights: Option<String>,
        /// Number of propagation steps; `None` for the number used in training.
        steps: Option<u8>,
        /// Number of frames predicted as one.
        stride: Stride,
    },
    /// The analytic model: the closed-form solution of every single frame.
    Prior {
        /// Number of frames predicted as one.
        stride: Stride,
    },
    /// A physics engine.
    Simulated {
        /// Engine.
        engine: Engine,
        /// Time steps a second.
        rate: Rate,
    },
    /// A model in which nothing moves.
    Still,
    /// A model from outside of the library, by its word; no text is parsed to one.
    Custom(&'static str),
}

/// Number of frames of a moving tool ([`crate::scene::FRAME_TRAVEL`]) that are predicted as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Stride(pub NonZeroU8);

/// Minimum number of time steps of an engine in a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Rate(pub NonZeroU16);

impl Stride {
    /// Every frame is predicted alone.
    pub const ONE: Self = Self(NonZeroU8::MIN);

    /// Returns the number of frames.
    pub fn frames(self) -> usize {
        usize::from(self.0.get())
    }
}

impl Rate {
    /// The default of both engines.
    ///
    /// A 20 cm push at 0.1 m/s and 1/240 s in the 2-D engine ends 0.06 mm (cylinders) and 0.2 mm
    /// (cuboids, median) from a run with finer steps. The 3-D engine is about 4 mm from another
    /// good engine on boxes.
    pub const DEFAULT: Self = Self(NonZeroU16::MIN.saturating_add(239));

    /// The rate of perturbed replays in 3-D, whose verdict on a plan is a share.
    ///
    /// The verdicts on 43 of 126 perturbed replays near the edge of their tolerances differ from
    /// those at 1/960 s, and on 35 at the default rate, for two thirds of the cost.
    pub const PERTURBED: Self = Self(NonZeroU16::MIN.saturating_add(119));

    /// Returns the length of a step, seconds.
    pub fn step(self) -> f64 {
        1.0 / f64::from(self.0.get())
    }
}

impl ModelKind {
    /// The shipped network.
    pub const NETWORK: Self = Self::Network { weights: None, steps: None, stride: Stride::ONE };
    /// The analytic model.
    pub const PRIOR: Self = Self::Prior { stride: Stride::ONE };
    /// The 2-D engine at its default step.
    pub const PLANAR: Self = Self::Simulated { engine: Engine::Planar, rate: Rate::DEFAULT };
    /// The 3-D engine at its default step.
    pub const SPATIAL: Self = Self::Simulated { engine: Engine::Spatial, rate: Rate::DEFAULT };
    /// The 3-D engine in which nothing tips, at its default step.
    pub const UPRIGHT: Self = Self::Simulated { engine: Engine::Upright, rate: Rate::DEFAULT };
}

impl ModelSpec {
    /// Creates the identifier of a model that accepts every job, without assumptions.
    pub const fn of(kind: ModelKind) -> Self {
        let assumptions = Assumptions { joints: None, friction: None, start: None };
        Self { first: ModelPart { kind, assumptions, up_to: None }, others: Vec::new() }
    }

    /// Returns the first model, to which every job is offered.
    pub fn first(&self) -> &ModelPart {
        &self.first
    }

    /// Returns the fallback models, in order; each gets the jobs that its predecessors do not
    /// accept.
    pub fn others(&self) -> &[ModelPart] {
        &self.others
    }

    /// Returns all models, the first one first.
    pub fn parts(&self) -> impl Iterator<Item = &ModelPart> {
        std::iter::once(&self.first).chain(&self.others)
    }

    /// Adds `other` as fallback for jobs that no part accepts.
    pub fn or(mut self, other: impl Into<ModelSpec>) -> Self {
        let ModelSpec { first, others } = other.into();
        self.others.push(first);
        self.others.extend(others);
        self
    }

    /// Limits all parts to jobs in which the tool can set at most `objects` in motion.
    pub fn up_to(mut self, objects: u16) -> Self {
        self.each(|part| part.up_to = Some(objects));
        self
    }

    /// Sets the assumptions of all parts.
    pub fn assuming(mut self, assumptions: Assumptions) -> Self {
        self.each(|part| part.assumptions = assumptions);
        self
    }

    fn each(&mut self, change: impl Fn(&mut ModelPart)) {
        std::iter::once(&mut self.first).chain(&mut self.others).for_each(change);
    }
}

impl From<ModelPart> for ModelSpec {
    fn from(first: ModelPart) -> Self {
        Self { first, others: Vec::new() }
    }
}

impl From<ModelKind> for ModelSpec {
    fn from(kind: ModelKind) -> Self {
        Self::of(kind)
    }
}
