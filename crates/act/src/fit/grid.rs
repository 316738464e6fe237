//! A grid of spread and friction.

use serde::{Deserialize, Serialize};

use pushplan::scene::Span;

/// Evenly spaced values of one number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// From the first to the last value.
    pub span: Span,
    /// How many, at least two.
    pub count: usize,
}

/// All pairs of a spread and a coefficient of friction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Shares of the corners' distance.
    pub spread: Axis,
    /// Coefficients of friction of pusher and object.
    pub friction: Axis,
}

impl Axis {
    /// `count` values over `span`.
    pub fn over(span: Span, count: usize) -> Self {
        Self { span, count: count.max(2) }
    }

    /// The value with this index.
    pub fn at(&self, index: usize) -> f64 {
        self.span.low + self.step() * index as f64
    }

    /// All values, ascending.
    pub fn values(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count).map(|index| self.at(index))
    }

    /// Distance of two values.
    pub fn step(&self) -> f64 {
        (self.span.high - self.span.low) / (self.count - 1) as f64
    }

    /// As many values over what lies around `kept`, a value and its neighbour on either side.
    fn around(&self, kept: &[bool]) -> Self {
        let first = kept.iter().position(|kept| *kept).unwrap_or(0);
        let last = kept.iter().rposition(|kept| *kept).unwrap_or(self.count - 1);
        let (first, last) = (first.saturating_sub(1), (last + 1).min(self.count - 1));
        Self { span: Span::new(self.at(first), self.at(last)), ..*self }
    }
}

impl Grid {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.spread.count * self.friction.count
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Spread and friction of all cells, spread by spread.
    pub fn cells(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let of = |spread| self.friction.values().map(move |friction| [spread, friction]);
        self.spread.values().flat_map(of)
    }

    /// Index of a cell, from those of its spread and friction.
    pub fn index(&self, spread: usize, friction: usize) -> usize {
        spread * self.friction.count + friction
    }

    /// As many cells where those lie for which `kept` says so.
    pub fn around(&self, kept: impl Fn(usize) -> bool) -> Self {
        let spreads: Vec<bool> = (0..self.spread.count)
            .map(|s| (0..self.friction.count).any(|f| kept(self.index(s, f))))
            .collect();
        let frictions: Vec<bool> = (0..self.friction.count)
            .map(|f| (0..self.spread.count).any(|s| kept(self.index(s, f))))
            .collect();
        Self { spread: self.spread.around(&spreads), friction: self.friction.around(&frictions) }
    }
}
