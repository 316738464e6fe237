//! What an effect model is: its kind, its settings, what it is told, and which model takes over.

use std::num::{NonZeroU8, NonZeroU16};

use crate::scene::Engine;

use super::Assumptions;

/// An effect model as a user or a table names it: `prior`, `planar,step=1/120`,
/// `prior,up-to=2|planar,step=1/120`.
///
/// ```text
/// spec = part { "|" part }             a job goes to the first part that takes it
/// part = kind { "," key "=" value }
/// kind = network | prior | planar | 3d | 3d-upright | still
/// ```
///
/// | key | of | value |
/// | --- | --- | --- |
/// | `weights` | `network` | a weights file instead of the shipped one; in quotes if it holds `,`, `\|` or `"` |
/// | `steps` | `network` | propagation steps, whatever it was trained with |
/// | `frame` | `network`, `prior` | the tool's travel in a frame, multiples of `10mm` |
/// | `step` | `planar`, `3d` | the engine's time step in seconds, `1/N` |
/// | `joints` | all | told that there are `none`, that their geometry is `guessed`, or that whatever touches is `fixed` |
/// | `friction` | all | told this share of every friction value, `70%` |
/// | `start` | all | told a start off by this much, `100um` |
/// | `up-to` | all | takes no job in which the tool can set more objects in motion |
///
/// [`std::fmt::Display`] and [`std::str::FromStr`] are inverse except for custom models. A text that is only a path ending
/// in `.safetensors` is short for `network,weights=` that file.
///
/// ```
/// use pushplan::scene::{ModelKind, ModelSpec};
///
/// let spec: ModelSpec = "prior,up-to=2|planar,step=1/120".parse()?;
/// assert_eq!(spec, ModelSpec::from(ModelKind::PRIOR).up_to(2).or("planar,step=1/120".parse::<ModelSpec>()?));
/// assert_eq!(spec.to_string(), "prior,up-to=2|planar,step=1/120");
/// let error = "quasi-static".parse::<ModelSpec>().unwrap_err();
/// assert!(error.to_string().contains("use network, prior, planar"));
/// # Ok::<(), pushplan::scene::SpecError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ModelSpec {
    first: ModelPart,
    others: Vec<ModelPart>,
}

/// One model of a [`ModelSpec`].
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ModelPart {
    /// What it is.
    pub kind: ModelKind,
    /// What it is told that the job does not say.
    pub assumptions: Assumptions,
    /// It takes no job in which the tool can set more objects in motion than this.
    pub up_to: Option<u16>,
}

/// The kinds of effect models with their settings.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ModelKind {
    /// The trained network, which corrects the prior.
    Network {
        /// Path of the weights file; the shipped weights if not given.
        weights: Option<String>,
        /// Propagation steps; as many as it was trained with if not given.
        steps: Option<u8>,
        /// Frames predicted as one.
        stride: Stride,
    },
    /// The closed-form solution of every frame alone.
    Prior {
        /// Frames predicted as one.
        stride: Stride,
    },
    /// A physics engine.
    Simulated {
        /// Which.
        engine: Engine,
        /// How finely it steps.
        rate: Rate,
    },
    /// Nothing moves.
    Still,
    /// A model from outside of the library, by the word that stands for it; no text is read as one.
    Custom(&'static str),
}

/// Frames of a moving tool ([`crate::scene::FRAME_TRAVEL`]) that are predicted as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Stride(pub NonZeroU8);

/// Time steps of an engine in a second, at least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Rate(pub NonZeroU16);

impl Stride {
    /// Every frame by itself.
    pub const ONE: Self = Self(NonZeroU8::MIN);

    /// As a number of frames.
    pub fn frames(self) -> usize {
        usize::from(self.0.get())
    }
}

impl Rate {
    /// Both engines' own.
    ///
    /// At 1/240 s a 20 cm push at 0.1 m/s in the planar engine ends 0.06 mm (cylinders) and 0.2 mm
    /// (cuboids, median) from its own fine run; the 3-D engine is about 4 mm from another good
    /// engine on boxes.
    pub const DEFAULT: Self = Self(NonZeroU16::MIN.saturating_add(239));

    /// Length of a step, seconds.
    pub fn step(self) -> f64 {
        1.0 / f64::from(self.0.get())
    }
}

impl ModelKind {
    /// The shipped network.
    pub const NETWORK: Self = Self::Network { weights: None, steps: None, stride: Stride::ONE };
    /// The prior.
    pub const PRIOR: Self = Self::Prior { stride: Stride::ONE };
    /// The planar engine.
    pub const PLANAR: Self = Self::Simulated { engine: Engine::Planar, rate: Rate::DEFAULT };
    /// The 3-D engine.
    pub const SPATIAL: Self = Self::Simulated { engine: Engine::Spatial, rate: Rate::DEFAULT };
    /// The 3-D engine in which nothing tips, at its default step.
    pub const UPRIGHT: Self = Self::Simulated { engine: Engine::Upright, rate: Rate::DEFAULT };
}

impl ModelSpec {
    /// A model of this kind for every job, told nothing but the job.
    pub const fn of(kind: ModelKind) -> Self {
        let assumptions = Assumptions { joints: None, friction: None, start: None };
        Self { first: ModelPart { kind, assumptions, up_to: None }, others: Vec::new() }
    }

    /// The model that is asked first.
    pub fn first(&self) -> &ModelPart {
        &self.first
    }

    /// Those that are asked in turn where it takes no job.
    pub fn others(&self) -> &[ModelPart] {
        &self.others
    }

    /// All of them.
    pub fn parts(&self) -> impl Iterator<Item = &ModelPart> {
        std::iter::once(&self.first).chain(&self.others)
    }

    /// The same, and what none of its parts takes goes to `other`.
    pub fn or(mut self, other: impl Into<ModelSpec>) -> Self {
        let ModelSpec { first, others } = other.into();
        self.others.push(first);
        self.others.extend(others);
        self
    }

    /// The same for jobs in which the tool can set at most `objects` in motion.
    pub fn up_to(mut self, objects: u16) -> Self {
        self.each(|part| part.up_to = Some(objects));
        self
    }

    /// The same, told `assumptions`.
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
