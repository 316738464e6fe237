//! Real pushes, see `recorded_pushes.rs`: with the true support model predictions match the
//! recordings, and the pushes identify the support.

use pushplan::effect::{EffectModel, Prior, Simulated};
use pushplan::progress::NoProgress;
use pushplan::scene::Support;
use pushplan::sim::Simulator;
use pushplan_act::fit::{FitSettings, fit};
use pushplan_act::judge::Trial;

use crate::recorded_pushes::{SUPPORTS, errors, pushes};

#[test]
fn a_model_is_accurate_with_the_true_support_and_not_better_with_another() {
    let sets = SUPPORTS.map(pushes);
    let supports: Vec<Support> =
        sets.iter().map(|pushes| pushes[0].scene.objects[0].support.clone()).collect();
    let models: [Box<dyn EffectModel>; 2] =
        [Box::new(Prior::default()), Box::new(Simulated::new(Simulator::planar()))];
    for model in models {
        for (name, (pushes, truth)) in SUPPORTS.iter().zip(sets.iter().zip(&supports)) {
            let (mean, median) = errors(&*model, pushes, truth);
            assert!(mean < 2.0e-3 && median < 1.5e-3, "{} {name}: {mean} {median}", model.spec());
            // The true support of a flat plate is unknown.
            for other in supports.iter().filter(|other| *name != "flat" && *other != truth) {
                let identified = errors(&*model, pushes, other).0;
                assert!(
                    mean < 1.05 * identified,
                    "{} {name}: {mean}, {other:?}: {identified}",
                    model.spec()
                );
            }
        }
    }
}

/// The three inner points are at 0.4 of the corners' distance from the centre of mass, the outer
/// ones at 0.8.
#[test]
fn ten_pushes_locate_the_support_of_the_plate() {
    for (name, spread) in [("inner", 0.4), ("outer", 0.8)] {
        let trials: Vec<Trial> = pushes(name).iter().map(Trial::of_recording).collect();
        let found = fit(&Prior::default(), &trials, &FitSettings::default(), &NoProgress);
        let found = found.expect("the plate moves");
        let off = (found.spread.mean - spread).abs();
        assert!(found.spread.identified && off < 0.08, "{name}: {:?}", found.spread);
        assert!(found.best.mean < found.even.mean, "{name}: {:?} {:?}", found.best, found.even);
    }
}
