//! Families of scenes and their ranges.

use pushplan::internals::scene::{Ranges, Span, TRAINED_SLIDE, TRAINED_TURN};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::distributions::weighted;
use super::hand::HAND_RADIUS;
use super::tabletop::USUAL_HEIGHT;

/// Family of scenes to sample.
///
/// The three crowds (sparse, sparse line and dense) follow Tekden et al. 2021 ("Object and relation
/// centric representations for push effect prediction", arXiv 2102.02100). They have up to twelve
/// objects, some joined to near neighbours, pushed by a round hand of 10 cm diameter.
///
/// Measured with at least 200 episodes each (episodes per second of CPU time, on a virtual core
/// whose sibling was busy):
///
/// | | episodes / s | frames an episode | objects | joints | objects moved over 1 cm |
/// |---|---|---|---|---|---|
/// | tools | 30 | 24 | 1.5 | 0 | 79 % |
/// | sparse | 13 | 232 | 6.8 | 2 | 99 % |
/// | sparse line | 31 | 93 | 6.8 | 2 | 57 % |
/// | dense | 42 | 52 | 6.8 | 3 | 84 % |
///
/// Scenes that do not come to rest within three seconds are drawn again. This affects 4 to 6 % of
/// the scenes with mixed joints and almost no others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// Tables with one to three objects, sometimes with obstacles, pushed by random tools of
    /// cuboids and occasionally by a round tool.
    #[default]
    Tools,
    /// The tables and tools of [`Preset::Tools`] with pushes as planners make them: one placed push
    /// without rotation of the tool, on objects with uniform support.
    Placed,
    /// Scattered objects. The hand makes seven or eight straight 30 cm strokes, each aimed at an
    /// untouched object.
    Sparse,
    /// Scattered objects. The hand makes one long straight stroke through them.
    SparseLine,
    /// Nearly touching objects in a grid. The hand makes one straight 50 cm stroke into it from one
    /// of its four sides.
    Dense,
    /// Crowds of all three kinds: with tools, the training data of the shipped weights.
    Crowds,
}

/// Families of [`Preset::Crowds`] with their probabilities.
///
/// A sparse episode has four times the frames of a dense one, so the shares of frames are 42, 16
/// and 42 %.
const CROWDS: [(Preset, f64); 3] =
    [(Preset::Sparse, 0.15), (Preset::SparseLine, 0.15), (Preset::Dense, 0.70)];

impl Preset {
    /// Returns the ranges of the family.
    pub fn ranges(self) -> Ranges {
        match self {
            Preset::Tools => tools(),
            Preset::Placed => Ranges { turn: 0.0, pushes: Span::new(1.0, 1.0), ..tools() },
            Preset::Sparse => crowd(Span::new(0.30, 0.30), Span::new(7.0, 8.0)),
            Preset::SparseLine => crowd(Span::new(0.60, 2.0), Span::new(1.0, 1.0)),
            Preset::Dense => crowd(Span::new(0.50, 0.50), Span::new(1.0, 1.0)),
            Preset::Crowds => CROWDS
                .into_iter()
                .map(|(member, _)| member.ranges())
                .reduce(|a, b| a.hull(&b))
                .unwrap_or_else(tools),
        }
    }

    /// Returns `true` if scenes are crowds pushed by the hand, which can be constrained.
    pub fn is_crowd(self) -> bool {
        !matches!(self, Preset::Tools | Preset::Placed)
    }

    /// Draws the family of one episode.
    pub(super) fn member(self, rng: &mut Pcg64) -> Self {
        match self {
            Preset::Crowds => CROWDS[weighted(rng, &CROWDS.map(|(_, share)| share))].0,
            single => single,
        }
    }
}

fn tools() -> Ranges {
    Ranges {
        objects: Span::new(1.0, 3.0),
        mass: Span::new(0.05, 3.0),
        // Above this ratio, touching bodies penetrate each other in the simulator.
        mass_ratio: 10.0,
        friction: Span::new(0.1, 1.8),
        radius: Span::new(0.02, 0.08),
        side: Span::new(0.03, 0.30),
        aspect: 8.0,
        height: Span::new(0.01, 0.15),
        parts: Span::new(1.0, 5.0),
        part_length: Span::new(0.01, 0.50),
        part_width: Span::new(0.006, 0.15),
        part_radius: Span::new(0.002, 0.06),
        speed: Span::new(0.01, 0.3),
        slide: TRAINED_SLIDE,
        turn: TRAINED_TURN,
        travel: Span::new(0.05, 0.30),
        pushes: Span::new(1.0, 3.0),
    }
}

fn crowd(travel: Span, pushes: Span) -> Ranges {
    Ranges {
        objects: Span::new(2.0, 12.0),
        mass: Span::new(0.1, 3.0),
        mass_ratio: 10.0,
        friction: Span::new(0.1, 1.0),
        radius: Span::new(0.04, 0.08),
        side: Span::new(0.06, 0.16),
        aspect: 0.16 / 0.06,
        height: USUAL_HEIGHT,
        parts: Span::new(1.0, 1.0),
        part_length: Span::NOTHING,
        part_width: Span::NOTHING,
        part_radius: Span::new(HAND_RADIUS, HAND_RADIUS),
        speed: Span::new(0.05, 0.25),
        slide: TRAINED_SLIDE,
        turn: TRAINED_TURN,
        travel,
        pushes,
    }
}
