//! Means and spreads of the columns of arrays.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::archive::{Array, Numbers};

/// Arrays with statistics, each with its number of columns.
const OF: [(&str, usize); 8] = [
    ("size", 3),
    ("mass", 1),
    ("friction", 1),
    ("table_friction", 1),
    ("tool_friction", 1),
    ("pose", 3),
    ("velocity", 3),
    ("change", 3),
];

/// Moments of one column: count, mean, sum of squared deviations, minimum and maximum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Moments {
    count: u64,
    mean: f64,
    squares: f64,
    min: f64,
    max: f64,
}

/// Entry of `statistics.json` for one array, with one number per column.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(super) struct Statistics {
    count: Vec<u64>,
    mean: Vec<f64>,
    std: Vec<f64>,
    min: Vec<f64>,
    max: Vec<f64>,
}

/// Moments by name of the array.
pub(super) type All = BTreeMap<String, Vec<Moments>>;

impl Moments {
    /// Returns the moments of one number.
    fn one(value: f64) -> Self {
        Self { count: 1, mean: value, squares: 0.0, min: value, max: value }
    }

    /// Combines the moments of two sets of numbers (Chan, Golub and LeVeque 1983, "Algorithms for
    /// computing the sample variance").
    fn with(self, other: Self) -> Self {
        let count = self.count + other.count;
        let (apart, share) = (other.mean - self.mean, other.count as f64 / count as f64);
        Self {
            count,
            mean: self.mean + apart * share,
            squares: self.squares + other.squares + apart * apart * share * self.count as f64,
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }
}

/// Returns the moments of the columns of arrays, ignoring NaN.
pub(super) fn moments(arrays: &[Array]) -> All {
    let mut found = All::new();
    for (name, width) in OF {
        let Some(array) = arrays.iter().find(|array| array.name == name) else { continue };
        let Numbers::Floats(numbers) = &array.numbers else { continue };
        let of_column = |column: usize| {
            let values = numbers.iter().skip(column).step_by(width).filter(|value| !value.is_nan());
            values.map(|value| Moments::one(*value)).reduce(Moments::with)
        };
        found.insert(name.to_owned(), (0..width).filter_map(of_column).collect());
    }
    found
}

/// Combines two sets of moments.
pub(super) fn with(mut all: All, more: &All) -> All {
    for (name, moments) in more {
        match all.get_mut(name).filter(|there| there.len() == moments.len()) {
            Some(there) => {
                for (there, more) in there.iter_mut().zip(moments) {
                    *there = there.with(*more);
                }
            }
            None => {
                all.insert(name.clone(), moments.clone());
            }
        }
    }
    all
}

/// Returns the statistics written to `statistics.json`.
pub(super) fn summary(all: &All) -> BTreeMap<&str, Statistics> {
    let statistics = |moments: &Vec<Moments>| Statistics {
        count: moments.iter().map(|one| one.count).collect(),
        mean: moments.iter().map(|one| one.mean).collect(),
        std: moments.iter().map(|one| (one.squares / one.count as f64).sqrt()).collect(),
        min: moments.iter().map(|one| one.min).collect(),
        max: moments.iter().map(|one| one.max).collect(),
    };
    all.iter().map(|(name, moments)| (name.as_str(), statistics(moments))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_the_statistics_of_the_whole() {
        let array = |numbers: &[f64]| {
            let numbers = Numbers::Floats(numbers.to_vec());
            [Array { name: "mass", shape: vec![], numbers }]
        };
        let all = [1.0, 2.5, f64::NAN, 1e3, 1e3 + 1.0, -4.0];
        let parts = with(moments(&array(&all[..2])), &moments(&array(&all[2..])));
        let whole = moments(&array(&all));
        let (parts, whole) = (summary(&parts), summary(&whole));
        let [parts, whole] = [&parts["mass"], &whole["mass"]];
        assert_eq!((parts.count[0], parts.min[0], parts.max[0]), (5, -4.0, 1001.0));
        assert!((parts.mean[0] - 400.1).abs() < 1e-9 && (whole.mean[0] - 400.1).abs() < 1e-9);
        let values = [1.0, 2.5, 1e3, 1e3 + 1.0, -4.0].map(|value: f64| (value - 400.1).powi(2));
        let std = (values.iter().sum::<f64>() / 5.0).sqrt();
        assert!((parts.std[0] - std).abs() < 1e-9 && (whole.std[0] - std).abs() < 1e-9);
    }
}
