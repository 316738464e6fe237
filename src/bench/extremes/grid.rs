//! The whole grid, measured.

use std::sync::Arc;

use crate::{asset::ToolLibrary, effect::EffectModel};

use super::{
    base::{Draw, Solid},
    cell::Cell,
    crowded,
    judge::{judge, yardstick},
    programmes::programmes,
    report::{ExtremeKind, ExtremesReport},
    single, tasks,
};

/// How much to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExtremesSettings {
    /// Seed of the pushes.
    pub seed: u64,
    /// Pushes a cell.
    pub pushes: usize,
    /// Ordinary pushes of each kind.
    pub ordinary: usize,
}

/// Measures `model` at the extremes, on all threads of the current rayon pool; the result is the
/// same for any number of them. `library` holds the tools that push. `progress` is told the
/// cells done and all of them.
pub fn extremes(
    model: &Arc<dyn EffectModel>,
    library: &ToolLibrary,
    settings: &ExtremesSettings,
    progress: &mut dyn FnMut(usize, usize),
) -> ExtremesReport {
    let ExtremesSettings { seed, pushes, ordinary } = *settings;
    let draw = Draw { library, pushes, seed };
    let cells: Vec<Cell> = single::cells(&draw).into_iter().chain(crowded::cells(&draw)).collect();
    let total = ExtremeKind::ALL.len() + cells.len() + tasks::COUNT;
    let mut done = 0;
    let mut tick = || {
        progress(done, total);
        done += 1;
    };

    // Other pushes than those of the cells.
    let draw = Draw { library, pushes: ordinary, seed: seed ^ 0x0D1D };
    let mut yardsticks = Vec::new();
    for kind in ExtremeKind::ALL {
        tick();
        let cases = match kind {
            ExtremeKind::Cylinder => single::ordinary(&draw, Solid::Cylinder),
            ExtremeKind::Cuboid => single::ordinary(&draw, Solid::Cuboid),
            ExtremeKind::Several => crowded::touching(&draw, 3),
            ExtremeKind::Jointed => crowded::row(&draw, 3, crowded::hinge),
        };
        yardsticks.extend(yardstick(&**model, kind, &cases));
    }
    let p95 = |kind: ExtremeKind| {
        let of_kind = yardsticks.iter().find(|stick| stick.kind == kind);
        of_kind.map_or(0.0, |stick| stick.error.p95)
    };
    let cells = cells
        .iter()
        .map(|cell| {
            tick();
            judge(&**model, cell, p95(cell.kind))
        })
        .collect();
    let tasks = (0..tasks::COUNT)
        .map(|index| {
            tick();
            tasks::solve(model, library, seed, index)
        })
        .collect();
    ExtremesReport {
        model: model.name().to_owned(),
        seed,
        pushes,
        yardsticks,
        cells,
        programmes: programmes(),
        tasks,
    }
}
