//! Merging the shards of a run into one.

use std::path::{Path, PathBuf};
use std::{collections::BTreeMap, fs};

use serde::Deserialize;

use crate::asset::write_atomic;

use super::error::StoreError;
use super::form::Form;
use super::journal::read_records;
use super::manifest::RunManifest;
use super::shard::Shard;
use super::times::{TIMES, read_times};

/// The index of a line of records, whatever the record.
#[derive(Deserialize)]
struct Index {
    index: usize,
}

/// Merges finished shards, given in any order, into a run in the folder `out`: the same
/// `manifest.json` and `records.jsonl` as measuring all tasks in one run would have left there.
///
/// # Errors
/// If a shard is missing, unfinished, damaged, there twice or of another run, or `out` holds a
/// run already. Nothing is written then.
pub fn merge_runs(out: &Path, shards: &[PathBuf]) -> Result<RunManifest, StoreError> {
    if RunManifest::load(out)?.is_some() {
        return Err(StoreError::Occupied { path: out.to_owned() });
    }
    let mut whole: Option<RunManifest> = None;
    let mut folders: BTreeMap<Shard, &PathBuf> = BTreeMap::new();
    let (mut records, mut times) = (BTreeMap::new(), BTreeMap::new());
    for dir in shards {
        let manifest = RunManifest::expect(dir)?;
        let shard = manifest.shard.unwrap_or(Shard::WHOLE);
        let merged = RunManifest { shard: None, ..manifest.clone() };
        let first = whole.get_or_insert_with(|| merged.clone());
        let of = folders.keys().next().map_or(shard.of(), |shard| shard.of());
        if merged != *first || shard.of() != of {
            let mut differences = merged.differences(first);
            if shard.of() != of {
                differences
                    .push(format!("it is one of {} shards, the first one of {of}", shard.of()));
            }
            return Err(StoreError::OtherRun { path: dir.clone(), differences });
        }
        if let Some(other) = folders.insert(shard, dir) {
            let (first, second) = (other.clone(), dir.clone());
            return Err(StoreError::DuplicateShard { shard, first, second });
        }
        let held = read_records(dir, &manifest, Form::Lines, &mut |line| {
            let Index { index } =
                serde_json::from_slice(line).map_err(|error| error.to_string())?;
            records.insert(index, String::from_utf8_lossy(&Form::Lines.frame(line)).into_owned());
            Ok(index)
        })?;
        let (done, total) = (held.count, manifest.indices().len());
        if done < total {
            return Err(StoreError::Unfinished { path: dir.clone(), done, total });
        }
        times.extend(read_times(dir)?.into_iter().map(|(times, line)| (times.index, line)));
    }
    let whole = whole.ok_or(StoreError::NothingToMerge)?;
    let of = folders.keys().next().map_or(0, |shard| shard.of());
    let given = |number: &usize| folders.keys().any(|shard| shard.number() == *number);
    let missing: Vec<usize> = (1..=of).filter(|number| !given(number)).collect();
    if !missing.is_empty() {
        return Err(StoreError::MissingShards { of, missing });
    }
    fs::create_dir_all(out).map_err(StoreError::io("create", out))?;
    for (name, lines) in [(TIMES, times), (Form::Lines.file(), records)] {
        let text: String = lines.into_values().collect();
        write_atomic(out.join(name), text.as_bytes()).map_err(StoreError::Write)?;
    }
    // Last, so that a folder with a manifest is a whole run.
    whole.save(out)?;
    Ok(whole)
}
