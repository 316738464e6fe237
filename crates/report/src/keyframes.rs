//! Values over time as CSS keyframes of an endless loop.
//!
//! CSS is used instead of a script because forges show an SVG as an image, where scripts do not
//! run. Viewers who prefer reduced motion get the still picture.

use std::fmt::Write;

/// A keyframe, with linear interpolation between two keys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key<const N: usize> {
    /// Time since the start of the loop, seconds.
    pub at: f64,
    /// Values from which the animated property is written.
    pub value: [f64; N],
}

/// Animations of one document.
#[derive(Clone, Debug)]
pub struct Keyframes {
    /// Length of the loop, seconds.
    seconds: f64,
    css: String,
}

impl Keyframes {
    /// Returns an empty set of animations for a loop of `seconds`.
    pub fn new(seconds: f64) -> Self {
        Self { seconds, css: String::new() }
    }

    /// Animates all elements of `class` through `keys`, which are in order of time. `declare`
    /// formats a value as a CSS declaration. Keys within `tolerance` of linear interpolation, per
    /// number, are left out. Constant values are not animated.
    pub fn animate<const N: usize>(
        &mut self,
        class: &str,
        keys: &[Key<N>],
        tolerance: [f64; N],
        declare: impl Fn([f64; N]) -> String,
    ) {
        let kept = thinned(keys, tolerance);
        let (Some(first), Some(last)) = (kept.first(), kept.last()) else { return };
        if kept.iter().all(|key| deviation(&key.value, &first.value, tolerance) <= 1.0) {
            return;
        }
        let seconds = short(self.seconds, 2);
        let _ = write!(self.css, ".{class}{{animation:{class} {seconds}s linear infinite}}");
        let _ = write!(self.css, "@keyframes {class}{{");
        let mut key = |share: f64, value: [f64; N]| {
            let _ = write!(self.css, "{}%{{{}}}", short(100.0 * share, 2), declare(value));
        };
        // A browser fills a gap at either end with the value of the still picture.
        if first.at > 0.0 {
            key(0.0, first.value);
        }
        kept.iter().for_each(|kept| key((kept.at / self.seconds).clamp(0.0, 1.0), kept.value));
        if last.at < self.seconds {
            key(1.0, last.value);
        }
        self.css.push_str("}\n");
    }

    /// Returns the style sheet.
    pub fn finish(self) -> String {
        format!(
            "{}@media (prefers-reduced-motion:reduce){{*{{animation:none!important}}}}",
            self.css
        )
    }
}

/// Formats a number with at most `digits` decimals and without trailing zeros; 0 if it is not
/// finite.
pub fn short(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "0".to_owned();
    }
    let text = format!("{value:.digits$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Simplifies `keys` by bisection so that linear interpolation stays within `tolerance` of all keys
/// (Ramer 1972, doi:10.1016/S0146-664X(72)80017-0, with the deviation at equal times).
fn thinned<const N: usize>(keys: &[Key<N>], tolerance: [f64; N]) -> Vec<Key<N>> {
    let mut keep = vec![false; keys.len()];
    let mut open = Vec::new();
    if let Some(last) = keys.len().checked_sub(1) {
        (keep[0], keep[last]) = (true, true);
        open.push((0, last));
    }
    while let Some((first, last)) = open.pop() {
        let (a, b) = (keys[first], keys[last]);
        let furthest = (first + 1..last)
            .map(|k| {
                let share = (keys[k].at - a.at) / (b.at - a.at).max(f64::MIN_POSITIVE);
                let even = std::array::from_fn(|n| a.value[n] + share * (b.value[n] - a.value[n]));
                (deviation(&keys[k].value, &even, tolerance), k)
            })
            .max_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((_, k)) = furthest.filter(|(deviation, _)| *deviation > 1.0) {
            keep[k] = true;
            open.extend([(first, k), (k, last)]);
        }
    }
    keys.iter().zip(keep).filter(|(_, keep)| *keep).map(|(key, _)| *key).collect()
}

/// Returns the largest difference of two values, in units of the tolerance.
fn deviation<const N: usize>(a: &[f64; N], b: &[f64; N], tolerance: [f64; N]) -> f64 {
    (0..N).map(|n| (a[n] - b[n]).abs() / tolerance[n]).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn css(keys: &[(f64, f64)]) -> String {
        let keys: Vec<Key<1>> = keys.iter().map(|&(at, v)| Key { at, value: [v] }).collect();
        let mut sheet = Keyframes::new(4.0);
        sheet.animate("a", &keys, [0.1], |[v]| format!("opacity:{}", short(v, 2)));
        sheet.finish().lines().next().unwrap_or_default().to_owned()
    }

    #[test]
    fn only_keys_that_bend_are_written() {
        insta::assert_snapshot!(
            css(&[(1.0, 0.0), (1.5, 0.52), (2.0, 1.0), (3.0, 1.0)]),
            @".a{animation:a 4s linear infinite}@keyframes a{0%{opacity:0}25%{opacity:0}50%{opacity:1}75%{opacity:1}100%{opacity:1}}"
        );
    }

    #[test]
    fn constant_and_non_finite_values_leave_a_valid_sheet() {
        assert!(!css(&[(0.0, 1.0), (2.0, 1.05), (4.0, 1.0)]).contains("keyframes"));
        assert!(!css(&[]).contains("keyframes"));
        assert!(!css(&[(0.0, 0.0), (2.0, f64::NAN), (4.0, 1.0)]).contains("NaN"));
    }

    #[test]
    fn a_reader_who_asked_for_less_motion_gets_none() {
        assert!(Keyframes::new(1.0).finish().contains("prefers-reduced-motion"));
    }
}
