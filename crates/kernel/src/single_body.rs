//! Frames of one object as numbers, and the choice of the vectors that solve them.

use std::sync::OnceLock;

use nalgebra::Vector3;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

use crate::{
    Vector, feet::Feet, forces::MOST, frames::Frames, solution::SingleBodySolution,
    stats::SolverStats, touching::Follows,
};

/// Number of frames side by side. An AVX2 vector holds as many numbers. With eight frames, which
/// wait more often, a push takes 5 to 17 % longer.
const LANES: usize = 4;

/// Number of frames side by side where vectors hold as many, as with AVX-512: a push takes a sixth
/// less time than with four.
const WIDE: usize = 8;

/// Maximum number of frames that are solved together, see [`batch`].
pub const MANY: usize = WIDE;

/// Number of frames below which solving one by one takes less time.
const FEW: usize = 3;

/// A frame of one object in at most [`MOST`] contacts. World axes, SI units.
#[derive(Clone, Copy, Debug)]
pub struct SingleBodyFrame<'a> {
    /// Points that the object stands on.
    pub feet: &'a Feet,
    /// Centre as the frame begins.
    pub position: Vector,
    /// Unit vector along the object's own x axis; ignored for round objects.
    pub axis: Vector,
    /// Mass, kg.
    pub mass: f64,
    /// Largest friction of the table, N.
    pub load: f64,
    /// Largest distance by which the load leans, metres.
    pub lean: f64,
    /// Mean distance c of the support's points from the centre, metres.
    pub support: f64,
    /// (c / rho)^2, the ratio of the rotational friction deceleration (in c omega) to the
    /// translational.
    pub spin: f64,
    /// Duration of the frame, seconds.
    pub duration: f64,
    /// Distance that the object is first assumed to move, metres.
    pub reach: f64,
    /// Shift and rotation of the object if it coasts.
    pub coast: Vector3<f64>,
    /// Linear and angular velocity as the frame begins.
    pub velocity: Vector3<f64>,
    /// Radius, if the object is a disc.
    pub radius: Option<f64>,
    /// Contacts of the object; `None` for absent ones.
    pub contacts: [Option<SingleBodyContact>; MOST],
}

/// A contact with a body whose motion is given. World axes, metres, at the start of the frame.
#[derive(Clone, Copy, Debug)]
pub struct SingleBodyContact {
    /// Unit vector into the object.
    pub normal: Vector,
    /// Vector from the object's centre to the point on it.
    pub arm: Vector,
    /// Displacement of the point on the other body.
    pub given: Vector,
    /// Rotation of the other body, radians.
    pub given_turn: f64,
    /// Distance between the bodies.
    pub gap: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Radius of the other body, if it is a disc.
    pub radius: Option<f64>,
    /// Feature that the normal turns with.
    pub follows: Follows,
}

impl SingleBodyFrame<'_> {
    #[inline(always)]
    pub(crate) fn contacts(&self) -> impl Iterator<Item = &SingleBodyContact> {
        self.contacts.iter().flatten()
    }
}

/// The vectors of this processor that code is compiled for. Not every number of frames is compiled
/// for each, because a pair of both takes ten seconds to compile: eight frames only for AVX-512,
/// fewer for AVX2, one for neither.
#[derive(Clone, Copy)]
enum Vectors {
    /// The baseline of the processor's architecture.
    Any,
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    Four(V3),
    /// AVX-512, with AVX2 for fewer frames than it holds.
    #[cfg(target_arch = "x86_64")]
    Eight(V4, V3),
}

impl Vectors {
    fn of_processor() -> Self {
        static FOUND: OnceLock<Vectors> = OnceLock::new();
        *FOUND.get_or_init(|| {
            #[cfg(target_arch = "x86_64")]
            {
                match (V4::try_new(), V3::try_new()) {
                    (Some(wide), Some(narrow)) => return Self::Eight(wide, narrow),
                    (_, Some(narrow)) => return Self::Four(narrow),
                    _ => {}
                }
            }
            Self::Any
        })
    }
}

/// Returns the number of frames to solve together when `waiting` frames wait.
pub fn batch(waiting: usize) -> usize {
    match (waiting, Vectors::of_processor()) {
        (0..FEW, _) => 1,
        #[cfg(target_arch = "x86_64")]
        (_, Vectors::Eight(..)) if waiting > LANES => WIDE,
        _ => LANES,
    }
}

/// Solves frames side by side. Leaves `None` where there is no frame and where the forces were not
/// found. Frames beyond the number of `solutions` are not solved.
///
/// The bits of a solution do not depend on the frames beside it.
pub fn solve(
    frames: &[Option<SingleBodyFrame>],
    solutions: &mut [Option<SingleBodySolution>],
    tally: &mut SolverStats,
) {
    let count = frames.len().min(solutions.len());
    let (frames, solutions) = (&frames[..count], &mut solutions[..count]);
    match Vectors::of_processor() {
        #[cfg(target_arch = "x86_64")]
        Vectors::Eight(wide, _) if count > LANES => {
            in_lanes::<WIDE>(frames, solutions, tally, |frames, tally| frames.by(wide, tally))
        }
        #[cfg(target_arch = "x86_64")]
        Vectors::Eight(_, narrow) | Vectors::Four(narrow) => match count {
            0..=1 => {
                in_lanes::<1>(frames, solutions, tally, |frames, tally| frames.by(narrow, tally))
            }
            _ => in_lanes::<LANES>(frames, solutions, tally, |frames, tally| {
                frames.by(narrow, tally)
            }),
        },
        Vectors::Any => match count {
            #[cfg(not(target_arch = "x86_64"))]
            2.. => in_lanes::<LANES>(frames, solutions, tally, |frames, tally| {
                frames.by(pulp::Scalar::new(), tally)
            }),
            _ => in_lanes::<1>(frames, solutions, tally, |frames, tally| {
                frames.by(pulp::Scalar::new(), tally)
            }),
        },
    }
}

/// Solves N frames at a time by `solve`.
fn in_lanes<const N: usize>(
    frames: &[Option<SingleBodyFrame>],
    solutions: &mut [Option<SingleBodySolution>],
    tally: &mut SolverStats,
    solve: impl Fn(&Frames<N>, &mut SolverStats) -> [Option<SingleBodySolution>; N],
) {
    for (frames, solutions) in frames.chunks(N).zip(solutions.chunks_mut(N)) {
        let mut lanes = Frames::<N>::default();
        for (k, frame) in frames.iter().enumerate() {
            if let Some(frame) = frame {
                lanes.set(k, frame);
            }
        }
        for (place, solution) in solutions.iter_mut().zip(solve(&lanes, tally)) {
            *place = solution;
        }
    }
}
