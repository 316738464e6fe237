//! Real pushes of a triangle on known supports, see `assets/real-pushes/README.md`.

use std::path::Path;

use pushplan::asset::recordings_in;
use pushplan::effect::EffectModel;
use pushplan::recording::Recording;
use pushplan::scene::Support;
use pushplan_act::judge::{Comparison, Trial, mean, percentile};

use crate::ROOT;

pub const SUPPORTS: [&str; 5] = ["flat", "inner", "middle", "outer", "skew"];

/// Returns the ten recorded pushes on a support.
pub fn pushes(support: &str) -> Vec<Recording> {
    let folder = Path::new(ROOT).join("tests/it/assets/real-pushes");
    let found = recordings_in(&folder.join(support)).expect("a folder");
    let files = found.into_iter().flat_map(|(_, files)| files);
    files.map(|file| Recording::load(file).expect("a sound recording")).collect()
}

/// Returns mean and median of the final position errors with all plates on `support`, metres.
pub fn errors(model: &dyn EffectModel, pushes: &[Recording], support: &Support) -> (f64, f64) {
    let mut errors: Vec<f64> = pushes
        .iter()
        .map(|push| {
            let mut push = push.clone();
            push.scene.objects[0].support = support.clone();
            let trial = Trial::of_recording(&push);
            Comparison::of(model, &trial).end()[0].position
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    (mean(&errors), percentile(&errors, 50.0))
}
