//! Robustness far outside the training ranges: one factor at a time. Each cell is judged against
//! the 2-D engine and by the warnings of the model.
//!
//! A model may be wrong there, but not silently: a cell whose answers are wrong and unflagged, not
//! finite or not bounded is a defect. In addition to rollouts, whole tasks are solved with numbers
//! that no sensible file holds.

mod base;
mod cell;
mod crowded;
mod judged;
mod single;
mod table;
mod tasks;

use std::sync::Arc;

use pushplan::asset::{ToolLibrary, write_atomic};
use pushplan::effect::{EffectModel, EffectModels};
use pushplan::scene::ModelKind;

use base::{Draw, Solid};
use cell::{Cell, Kind};
use judged::{Judged, Verdict, Yardstick};
use tasks::TaskCell;

/// Published cells, and the folder for the tables that `pushplan-lab measure extremes` reads.
const CELLS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/results/extremes.csv");
const TABLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target");

/// Results of all measurements.
struct Extremes {
    model: String,
    seed: u64,
    /// Number of pushes of a cell, except for cells of few long pushes.
    pushes: usize,
    /// Yardsticks of the cells.
    yardsticks: Vec<Yardstick>,
    cells: Vec<(Cell, Judged)>,
    tasks: Vec<TaskCell>,
}

impl Extremes {
    /// Measures a model with `pushes` per cell and `ordinary` pushes of each kind.
    fn measure(
        model: ModelKind,
        threads: usize,
        seed: u64,
        pushes: usize,
        ordinary: usize,
    ) -> Self {
        let model = EffectModels::build(&model.into()).expect("sound weights");
        let model: Arc<dyn EffectModel> = Arc::new(model);
        let library = ToolLibrary::embedded().expect("sound tools");
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            // Ordinary pushes differ from the pushes of the cells.
            let draw = Draw { library: &library, pushes: ordinary, seed: seed ^ 0x0D1D };
            let yardsticks = Kind::ALL.map(|kind| {
                let cases = match kind {
                    Kind::Cylinder => single::ordinary(&draw, Solid::Cylinder),
                    Kind::Cuboid => single::ordinary(&draw, Solid::Cuboid),
                    Kind::Several => crowded::touching(&draw, 3),
                    Kind::Jointed => crowded::row(&draw, 3, crowded::hinge),
                };
                Yardstick::of(&*model, kind, &cases)
            });
            let draw = Draw { library: &library, pushes, seed };
            let cells = single::cells(&draw).into_iter().chain(crowded::cells(&draw));
            let judged = cells.map(|cell| {
                let judged = Judged::of(&*model, &cell, &yardsticks);
                (cell, judged)
            });
            Self {
                model: model.spec().to_string(),
                seed,
                pushes,
                cells: judged.collect(),
                yardsticks: yardsticks.into(),
                tasks: tasks::solved(&model, &library, seed),
            }
        })
    }

    fn defects(&self) -> usize {
        let is = |(_, judged): &&(Cell, Judged)| judged.verdict == Verdict::Defect;
        let cells = self.cells.iter().filter(is).count();
        cells + self.tasks.iter().filter(|cell| !cell.sound).count()
    }
}

#[test]
fn everything_stays_finite_and_bounded_and_tasks_are_sound() {
    let extremes = Extremes::measure(ModelKind::NETWORK, 2, 11, 1, 11);
    assert!(extremes.cells.len() > 150, "{} cells", extremes.cells.len());
    let page = table::page(&extremes);
    for (cell, judged) in &extremes.cells {
        let name = format!("{} {}", cell.factor, cell.value);
        assert!(judged.pushes > 0, "{name}: no push could be drawn");
        assert_eq!(judged.finite, judged.pushes, "{name}");
        assert_eq!(judged.bounded, judged.pushes, "{name}");
        assert!(page.contains(cell.factor) && page.contains(&cell.value), "{name}");
    }
    for cell in &extremes.tasks {
        assert!(cell.sound, "{cell:?}");
    }
    let again = Extremes::measure(ModelKind::NETWORK, 1, 11, 1, 11);
    let judged = |extremes: &Extremes| -> Vec<Judged> {
        extremes.cells.iter().map(|(_, judged)| judged.clone()).collect()
    };
    assert_eq!(judged(&again), judged(&extremes), "another number of threads, other results");
    assert_eq!(again.tasks, extremes.tasks);
    assert_eq!(again.yardsticks, extremes.yardsticks);
}

#[test]
fn the_published_cells_are_those_that_are_measured() {
    let library = ToolLibrary::embedded().expect("sound tools");
    let draw = Draw { library: &library, pushes: 1, seed: 7 };
    let cells: Vec<String> = single::cells(&draw)
        .iter()
        .chain(&crowded::cells(&draw))
        .map(|cell| table::beginning(cell) + ",")
        .collect();
    let published = std::fs::read_to_string(CELLS).expect("the published cells");
    let published: Vec<&str> = published.lines().skip(1).collect();
    assert_eq!(published.len(), cells.len(), "see {CELLS}");
    for (line, cell) in published.iter().zip(&cells) {
        assert!(line.starts_with(cell), "published is {line}, measured {cell}");
    }
}

#[test]
#[ignore = "minutes; measures the published table and writes it"]
fn the_extremes_hide_no_defect() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let extremes = Extremes::measure(ModelKind::NETWORK, threads, 7, 22, 220);
    write_atomic(CELLS, table::csv(&extremes).as_bytes()).expect("the cells are written");
    std::fs::create_dir_all(TABLES).expect("a folder");
    let tables = format!("{TABLES}/extremes.md");
    write_atomic(&tables, table::page(&extremes).as_bytes()).expect("the tables are written");
    assert_eq!(extremes.defects(), 0, "see {CELLS}");
}

#[test]
#[ignore = "minutes"]
fn the_prior_hides_no_defect_either() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let extremes = Extremes::measure(ModelKind::PRIOR, threads, 7, 22, 220);
    assert_eq!(extremes.defects(), 0, "{}", table::page(&extremes));
}
