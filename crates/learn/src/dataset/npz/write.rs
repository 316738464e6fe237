//! Resumable writing of a data set of `.npz` files.

use std::path::{Path, PathBuf};

use pushplan::internals::asset::write_atomic;
use pushplan::internals::progress::{Count, Progress};
use pushplan_bench::store::{Form, Journal, StoreError, digest};
use serde::{Deserialize, Serialize};

use crate::dataset::config::DatasetConfig;
use crate::dataset::error::DatasetError;
use crate::dataset::set::{Sampler, draw};

use super::FORMAT;
use super::archive::npz;
use super::arrays::arrays;
use super::statistics::{All, moments, summary, with};

/// Number of episodes per file: some megabytes, and at most seconds of work lost by an
/// interruption.
pub const A_FILE: u64 = 128;

/// Finished file; one line of `records.jsonl`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Finished {
    index: usize,
    file: String,
    episodes: u64,
    frames: usize,
    bytes: u64,
    digest: String,
    moments: All,
}

/// Makes a data set of `.npz` files in the folder `dir`, or completes an interrupted one.
///
/// Existing files are kept. The files are bit-identical for any number of threads and
/// interruptions. Returns their size in bytes.
///
/// # Errors
/// Returns an error if the configuration requests no data, the folder holds other settings or a
/// changed file, the folder is locked, a file cannot be written, or `progress` cancels.
pub fn generate_npz(
    config: &DatasetConfig,
    dir: &Path,
    progress: &dyn Progress,
) -> Result<u64, DatasetError> {
    config.check()?;
    let files = config.episodes.div_ceil(A_FILE) as usize;
    let (mut all, mut bytes) = (All::new(), 0);
    let mut look = |line: &[u8]| {
        let there: Finished = serde_json::from_slice(line).map_err(|error| error.to_string())?;
        unchanged(&there, dir)?;
        all = with(std::mem::take(&mut all), &there.moments);
        bytes += there.bytes;
        Ok(there.index)
    };
    let manifest = config.manifest_of_files(files, A_FILE);
    let mut journal = Journal::open(dir, manifest, Form::Lines, progress, &mut look)?;
    let most = config.ranges().objects.high as usize;
    let done = (journal.done() as u64 * A_FILE).min(config.episodes);
    let count = Count::new(progress, done as usize, config.episodes as usize);
    for index in journal.done()..files {
        let first = index as u64 * A_FILE;
        let range = first..(first + A_FILE).min(config.episodes);
        let indices: Vec<u64> = range.clone().collect();
        let drawn = draw(config, &indices, &count, progress);
        let episodes = drawn.into_iter().collect::<Result<Vec<_>, _>>()?;
        let most = episodes.iter().map(|one| one.scene.objects.len()).fold(most, usize::max);
        let arrays = arrays(&episodes, most);
        let why = |why: String| StoreError::Record { index, why };
        let data = npz(&arrays).map_err(|error| why(error.to_string()))?;
        let file = format!("episodes-{index:05}.npz");
        write_atomic(dir.join(&file), &data).map_err(StoreError::Write)?;
        let finished = Finished {
            index,
            file,
            episodes: range.end - range.start,
            frames: episodes.iter().map(|episode| episode.frames.len()).sum(),
            bytes: data.len() as u64,
            digest: digest(&data),
            moments: moments(&arrays),
        };
        let line = serde_json::to_vec(&finished).map_err(|error| why(error.to_string()))?;
        journal.append([line.as_slice()])?;
        all = with(all, &finished.moments);
        bytes += finished.bytes;
    }
    let mut text = serde_json::to_vec_pretty(&summary(&all)).unwrap_or_default();
    text.push(b'\n');
    write_atomic(dir.join("README.md"), FORMAT.as_bytes()).map_err(StoreError::Write)?;
    write_atomic(dir.join("statistics.json"), &text).map_err(StoreError::Write)?;
    Ok(bytes)
}

/// Checks that a finished file is unchanged.
fn unchanged(finished: &Finished, dir: &Path) -> Result<(), String> {
    let path: PathBuf = dir.join(&finished.file);
    let there = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    match digest(&there) == finished.digest {
        true => Ok(()),
        false => Err(format!("{} was changed after it was written", path.display())),
    }
}
