//! Lessons on disk: runs with lessons as records, see [`pushplan_bench::store`].

use std::path::Path;
use std::sync::Arc;

use pushplan::internals::effect::{Network, Prior};
use pushplan::internals::progress::{Count, Progress};
use pushplan_bench::store::{Form, Journal, RunManifest, StoreError, read_records};
use rayon::prelude::*;

use super::error::DatasetError;
use super::lesson::Lesson;

/// Suite name of a folder of lessons.
const SUITE: &str = "lessons";

/// Number of lessons drawn in parallel before they are stored. A crash loses at most these, about
/// ten seconds of work.
const AT_ONCE: u64 = 32;

/// Version of the lessons; other versions yield other lessons for equal seeds.
const VERSION: u64 = 2;

/// Makes `count` lessons under `seed` in the folder `dir`, or completes interrupted ones, and reads
/// them.
///
/// The result is bit-identical for any number of threads and interruptions. `digest` is the digest
/// of the propagation network's weights.
///
/// # Errors
/// Returns an error if `count` is zero, the folder holds other lessons or is locked, a file cannot
/// be written, or `progress` cancels. Finished lessons are always kept.
pub fn lessons(
    (seed, count): (u64, u64),
    (network, digest): (&Arc<Network>, String),
    dir: &Path,
    progress: &dyn Progress,
) -> Result<Vec<Lesson>, DatasetError> {
    if count == 0 {
        return Err(DatasetError::Empty("lessons"));
    }
    let manifest = RunManifest::new(SUITE, count as usize, seed, "prior")
        .with_weights(Some(digest))
        .with_settings(VERSION.into());
    let mut all = Vec::new();
    let mut journal =
        Journal::open(dir, manifest.clone(), Form::Frames, progress, &mut |record| {
            Ok(decode(record)?.index as usize)
        })?;
    let model = Prior::default();
    let finished = Count::new(progress, journal.done(), count as usize);
    while (journal.done() as u64) < count {
        let first = journal.done() as u64;
        let range = first..(first + AT_ONCE).min(count);
        let drawn: Vec<Option<Lesson>> = range
            .clone()
            .into_par_iter()
            .map(|index| {
                if progress.cancelled() {
                    return None;
                }
                let lesson = Lesson::draw(seed, index, network, &model);
                finished.one();
                Some(lesson)
            })
            .collect();
        let whole = drawn.iter().map_while(Option::as_ref);
        let records: Vec<Vec<u8>> = whole.map(encode).collect::<Result<_, _>>()?;
        journal.append(records.iter().map(Vec::as_slice))?;
        if (journal.done() as u64) < range.end {
            return Err(DatasetError::Cancelled);
        }
    }
    drop(journal);
    read_records(dir, &manifest, Form::Frames, &mut |record| {
        let lesson = decode(record)?;
        let index = lesson.index as usize;
        all.push(lesson);
        Ok(index)
    })?;
    Ok(all)
}

fn encode(lesson: &Lesson) -> Result<Vec<u8>, StoreError> {
    postcard::to_allocvec(lesson).map_err(|error| StoreError::Record {
        index: lesson.index as usize,
        why: error.to_string(),
    })
}

fn decode(record: &[u8]) -> Result<Lesson, String> {
    postcard::from_bytes(record).map_err(|error| error.to_string())
}
