//! The learning rate as a pure function of the step.

use std::f64::consts::PI;

use super::Settings;

/// Share of the highest rate at which the schedule ends.
const FLOOR: f64 = 0.005;

/// Linear warm-up, then half a cosine down to `FLOOR` (Loshchilov and Hutter 2017).
pub fn learning_rate(settings: &Settings, step: u64) -> f64 {
    let peak = settings.learning_rate;
    if step < settings.warm_up {
        return peak * (step + 1) as f64 / settings.warm_up as f64;
    }
    let span = settings.steps.saturating_sub(settings.warm_up).max(1) as f64;
    let done = ((step - settings.warm_up) as f64 / span).min(1.0);
    peak * (FLOOR + (1.0 - FLOOR) * 0.5 * (1.0 + (PI * done).cos()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rises_then_falls_to_the_floor() {
        let settings = Settings::default();
        let at = |step| learning_rate(&settings, step);
        assert!(at(0) < at(250) && at(250) < at(500));
        assert!((at(500) - settings.learning_rate).abs() < 1e-9);
        assert!((at(settings.steps) - FLOOR * settings.learning_rate).abs() < 1e-12);
    }
}
