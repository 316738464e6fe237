//! Grid of support spread and friction.

use serde::{Deserialize, Serialize};

use pushplan::scene::Span;

/// Evenly spaced values of one parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Range from the first to the last value.
    pub span: Span,
    /// Number of values, at least two.
    pub count: usize,
}

/// Pairs of a spread and a friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Support spread as a share of the corners' distance.
    pub spread: Axis,
    /// Friction coefficient between pusher and object.
    pub friction: Axis,
}

impl Axis {
    /// Creates an axis of `count` values over `span`.
    pub fn over(span: Span, count: usize) -> Self {
        Self { span, count: count.max(2) }
    }

    /// Returns the value at an index.
    pub fn at(&self, index: usize) -> f64 {
        self.span.low + self.step() * index as f64
    }

    /// Returns all values, ascending.
    pub fn values(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.count).map(|index| self.at(index))
    }

    /// Returns the distance between adjacent values.
    pub fn step(&self) -> f64 {
        (self.span.high - self.span.low) / (self.count - 1) as f64
    }

    /// Returns an axis with equally many values around the `kept` ones and one neighbour on each
    /// side.
    fn around(&self, kept: &[bool]) -> Self {
        let first = kept.iter().position(|kept| *kept).unwrap_or(0);
        let last = kept.iter().rposition(|kept| *kept).unwrap_or(self.count - 1);
        let (first, last) = (first.saturating_sub(1), (last + 1).min(self.count - 1));
        Self { span: Span::new(self.at(first), self.at(last)), ..*self }
    }
}

impl Grid {
    /// Returns the number of cells.
    pub fn len(&self) -> usize {
        self.spread.count * self.friction.count
    }

    /// Returns `true` if the grid has no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns spread and friction of all cells, spread by spread.
    pub fn cells(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let of = |spread| self.friction.values().map(move |friction| [spread, friction]);
        self.spread.values().flat_map(of)
    }

    /// Returns the index of the cell with these spread and friction indices.
    pub fn index(&self, spread: usize, friction: usize) -> usize {
        spread * self.friction.count + friction
    }

    /// Returns a grid with equally many cells over the region of the `kept` cells.
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
