//! Values over time, written as CSS keyframes of one endless loop.
//!
//! CSS and not a script: a forge shows an SVG as an image, where no script runs, and a viewer who
//! asked for less motion gets the still picture.

use std::fmt::Write;

/// A value at a time, seconds since the start of the loop; between two keys it changes evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key<const N: usize> {
    /// Seconds since the start of the loop.
    pub at: f64,
    /// The numbers that the animated property is written from.
    pub value: [f64; N],
}

/// All animations of one document.
#[derive(Clone, Debug)]
pub struct Keyframes {
    /// Length of the loop, seconds.
    seconds: f64,
    css: String,
}

impl Keyframes {
    /// No animation yet, in a loop of `seconds`.
    pub fn new(seconds: f64) -> Self {
        Self { seconds, css: String::new() }
    }

    /// Moves everything of `class` through `keys`, in order of time; `declare` writes a value as a
    /// CSS declaration. Keys that the eye cannot tell from an even change, within `tolerance` in
    /// each number, are left out; what never changes is not animated.
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
        // A browser fills what is missing at both ends with the still picture's value.
        if first.at > 0.0 {
            key(0.0, first.value);
        }
        kept.iter().for_each(|kept| key((kept.at / self.seconds).clamp(0.0, 1.0), kept.value));
        if last.at < self.seconds {
            key(1.0, last.value);
        }
        self.css.push_str("}\n");
    }

    /// The style sheet.
    pub fn finish(self) -> String {
        format!(
            "{}@media (prefers-reduced-motion:reduce){{*{{animation:none!important}}}}",
            self.css
        )
    }
}

/// A number with at most `digits` decimals and no trailing zeros; 0 for what is not finite.
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

/// The fewest keys of a bisection whose straight pieces stay within `tolerance` of all keys
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

/// The largest difference of two values in units of the tolerance.
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
    fn what_stays_as_it_is_and_what_is_not_finite_leave_a_valid_sheet() {
        assert!(!css(&[(0.0, 1.0), (2.0, 1.05), (4.0, 1.0)]).contains("keyframes"));
        assert!(!css(&[]).contains("keyframes"));
        assert!(!css(&[(0.0, 0.0), (2.0, f64::NAN), (4.0, 1.0)]).contains("NaN"));
    }

    #[test]
    fn a_reader_who_asked_for_less_motion_gets_none() {
        assert!(Keyframes::new(1.0).finish().contains("prefers-reduced-motion"));
    }
}
