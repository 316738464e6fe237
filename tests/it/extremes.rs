//! The extremes: nothing panics, nothing is infinite or thrown, and no wrong answer is silent.

use pushplan::asset::ToolLibrary;
use pushplan::bench::{ExtremesReport, ExtremesSettings, extremes};
use pushplan::effect::EffectModels;
use pushplan::report::extremes_page;

fn measured(threads: usize, settings: &ExtremesSettings) -> ExtremesReport {
    let model = EffectModels::shipped().expect("sound weights");
    let library = ToolLibrary::embedded().expect("sound tools");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| extremes(&model, &library, settings, &mut |_, _| {}))
}

#[test]
fn everything_stays_finite_and_bounded_and_programmes_and_tasks_are_sound() {
    let settings = ExtremesSettings { seed: 11, pushes: 1, ordinary: 11 };
    let report = measured(2, &settings);
    assert!(report.cells.len() > 150, "{} cells", report.cells.len());
    for cell in &report.cells {
        assert!(cell.pushes > 0, "{} {}: no push could be drawn", cell.factor, cell.value);
        assert_eq!(cell.finite, cell.pushes, "{} {}", cell.factor, cell.value);
        assert_eq!(cell.bounded, cell.pushes, "{} {}", cell.factor, cell.value);
    }
    for cell in &report.programmes {
        assert!(cell.sound, "{cell:?}");
    }
    for cell in &report.tasks {
        assert!(cell.sound, "{cell:?}");
    }
    let page = extremes_page(&report, "pushplan bench extremes");
    for cell in &report.cells {
        assert!(page.contains(&cell.factor) && page.contains(&cell.value));
    }
    let text = serde_json::to_string(&report).expect("JSON");
    let read: ExtremesReport = serde_json::from_str(&text).expect("the same type");
    assert_eq!(read, report);
    assert_eq!(measured(1, &settings), report, "another number of threads, other results");
}
