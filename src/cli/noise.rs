//! How exactly things are seen.

use clap::Args;

use crate::scene::Noise;

/// Errors of recorded poses.
#[derive(Args, Clone, Copy, Debug)]
pub struct NoiseArgs {
    /// Standard deviation of recorded positions, metres
    #[arg(long, value_name = "METRES", default_value_t = 1e-3, value_parser = deviation)]
    noise: f64,
    /// Standard deviation of recorded headings, radians
    #[arg(long, value_name = "RADIANS", default_value_t = 0.01, value_parser = deviation)]
    heading_noise: f64,
}

impl NoiseArgs {
    /// The noise.
    pub fn noise(self) -> Noise {
        Noise { position: self.noise, heading: self.heading_noise }
    }
}

fn deviation(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "1 mm is 0.001".to_owned())?;
    let sound = (0.0..=0.5).contains(&value);
    sound.then_some(value).ok_or_else(|| "it must be 0 to 0.5".to_owned())
}
