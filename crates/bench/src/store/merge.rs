//! Merging of the shards of a run.

use std::path::{Path, PathBuf};
use std::{collections::BTreeMap, fs};

use serde::Deserialize;

use pushplan::asset::write_atomic;

use super::error::StoreError;
use super::form::Form;
use super::journal::{Look, read_records};
use super::manifest::RunManifest;
use super::shard::Shard;
use super::times::{TIMES, read_times};

/// Folders of one run, each with another shard.
#[derive(Default)]
pub(super) struct Family {
    whole: Option<RunManifest>,
    folders: BTreeMap<Shard, PathBuf>,
}

impl Family {
    /// Adds a folder and returns its shard.
    ///
    /// # Errors
    /// Returns an error if the folder belongs to a different run, or repeats a shard.
    pub fn add(&mut self, dir: &Path, manifest: &RunManifest) -> Result<Shard, StoreError> {
        let shard = manifest.shard.unwrap_or(Shard::WHOLE);
        let merged = RunManifest { shard: None, ..manifest.clone() };
        let first = self.whole.get_or_insert_with(|| merged.clone());
        let of = self.folders.keys().next().map_or(shard.of(), |shard| shard.of());
        if merged != *first || shard.of() != of {
            let mut differences = merged.differences(first);
            if shard.of() != of {
                differences.push(format!(
                    "it is split into {} shards, but the first folder into {of}",
                    shard.of()
                ));
            }
            return Err(StoreError::OtherRun { path: dir.to_owned(), differences });
        }
        match self.folders.insert(shard, dir.to_owned()) {
            Some(first) => Err(StoreError::DuplicateShard { shard, first, second: dir.to_owned() }),
            None => Ok(shard),
        }
    }

    /// Returns the number of shards of the run; `None` without any folder.
    pub fn of(&self) -> Option<usize> {
        self.folders.keys().next().map(|shard| shard.of())
    }
}

/// Merges finished shards, in any order, into a run in the folder `out`, with the manifest and
/// records of an unsplit run. `look` receives each record, shard by shard, and returns its index.
///
/// During the merge all records are in memory, as for readers of the merged run.
///
/// # Errors
/// Returns an error if a shard is missing, unfinished, damaged, duplicated or of another run, or if
/// `out` already holds a run. Nothing is written then.
pub fn merge_runs(
    out: &Path,
    shards: &[PathBuf],
    form: Form,
    look: &mut Look,
) -> Result<RunManifest, StoreError> {
    if RunManifest::load(out)?.is_some() {
        return Err(StoreError::Occupied { path: out.to_owned() });
    }
    let mut family = Family::default();
    let (mut records, mut times) = (BTreeMap::new(), BTreeMap::new());
    for dir in shards {
        let manifest = RunManifest::expect(dir)?;
        family.add(dir, &manifest)?;
        let held = read_records(dir, &manifest, form, &mut |record| {
            let index = look(record)?;
            records.insert(index, form.frame(record));
            Ok(index)
        })?;
        let (done, total) = (held.count, manifest.indices().len());
        if done < total {
            return Err(StoreError::Unfinished { path: dir.clone(), done, total });
        }
        times.extend(read_times(dir)?.into_iter().map(|(times, line)| (times.index, line)));
    }
    let of = family.of().unwrap_or_default();
    let given = |number: &usize| family.folders.keys().any(|shard| shard.number() == *number);
    let missing: Vec<usize> = (1..=of).filter(|number| !given(number)).collect();
    if !missing.is_empty() {
        return Err(StoreError::MissingShards { of, missing });
    }
    let whole = family.whole.ok_or(StoreError::NothingToMerge)?;
    fs::create_dir_all(out).map_err(StoreError::io("create", out))?;
    let write = |name: &str, bytes: Vec<u8>| {
        write_atomic(out.join(name), &bytes).map_err(StoreError::Write)
    };
    // Runs in frames have no times.
    if form == Form::Lines {
        write(TIMES, times.into_values().collect::<String>().into_bytes())?;
    }
    write(form.file(), records.into_values().collect::<Vec<_>>().concat())?;
    // The manifest is written last, so that a folder with a manifest holds a whole run.
    whole.save(out)?;
    Ok(whole)
}

/// Line of records, regardless of the record type.
#[derive(Deserialize)]
struct Line {
    index: usize,
}

/// Returns the index of a line of records, see [`merge_runs`].
///
/// # Errors
/// Returns an error if the line has no index.
pub fn line_index(line: &[u8]) -> Result<usize, String> {
    let line: Line = serde_json::from_slice(line).map_err(|error| error.to_string())?;
    Ok(line.index)
}
