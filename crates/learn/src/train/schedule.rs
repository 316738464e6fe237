//! The learning rate as a pure function of the step.

use std::f64::consts::PI;

use super::Descent;

/// Share of the highest rate at which the schedule ends.
const FLOOR: f64 = 0.005;

/// Linear warm-up, then half a cosine down to `FLOOR` (Loshchilov and Hutter 2017).
pub fn learning_rate(descent: &Descent, step: u64) -> f64 {
    let peak = descent.learning_rate;
    if step < descent.warm_up {
        return peak * (step + 1) as f64 / descent.warm_up as f64;
    }
    let span = descent.steps.saturating_sub(descent.warm_up).max(1) as f64;
    let done = ((step - descent.warm_up) as f64 / span).min(1.0);
    peak * (FLOOR + (1.0 - FLOOR) * 0.5 * (1.0 + (PI * done).cos()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::Settings;

    #[test]
    fn it_rises_then_falls_to_the_floor() {
        let descent = Settings::default().descent();
        let at = |step| learning_rate(&descent, step);
        assert!(at(0) < at(250) && at(250) < at(500));
        assert!((at(500) - descent.learning_rate).abs() < 1e-9);
        assert!((at(descent.steps) - FLOOR * descent.learning_rate).abs() < 1e-12);
    }
}
