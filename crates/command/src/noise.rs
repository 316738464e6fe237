//! Accuracy of recorded poses.

use clap::Args;

use pushplan::task::Noise;
use pushplan_report::Setting;

/// Default errors, metres and radians.
const USUAL: (f64, f64) = (1e-3, 0.01);

/// Errors of recorded poses.
#[derive(Args, Clone, Copy, Debug)]
pub struct NoiseArgs {
    /// Standard deviation of recorded positions, metres
    #[arg(long, value_name = "METRES", default_value_t = USUAL.0, value_parser = deviation)]
    noise: f64,
    /// Standard deviation of recorded headings, radians
    #[arg(long, value_name = "RADIANS", default_value_t = USUAL.1, value_parser = deviation)]
    heading_noise: f64,
}

impl NoiseArgs {
    /// Returns the noise.
    pub fn noise(self) -> Noise {
        Noise { position: self.noise, heading: self.heading_noise }
    }

    /// Returns the non-default settings.
    pub fn settings(self) -> Vec<Setting> {
        let setting = |option, keyword, value: f64, usual: f64| {
            let value = value.to_string();
            let setting = Setting { option, keyword: Some(keyword), value };
            (setting.value != usual.to_string()).then_some(setting)
        };
        let position = setting("--noise", "noise", self.noise, USUAL.0);
        let heading = setting("--heading-noise", "heading_noise", self.heading_noise, USUAL.1);
        position.into_iter().chain(heading).collect()
    }
}

fn deviation(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number; 1 mm is 0.001".to_owned())?;
    let sound = (0.0..=0.5).contains(&value);
    sound.then_some(value).ok_or_else(|| "must be from 0 to 0.5".to_owned())
}
