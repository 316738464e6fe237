//! A run: what is finished, what is left, and keeping each task as it is done.

use std::collections::{BTreeMap, HashMap};
use std::{fs, path::Path};

use serde::{Serialize, de::DeserializeOwned};

use crate::dataset::Watch;

use super::{
    error::StoreError,
    files::{Files, RecordLine, TimesLine, line, read_records, read_times},
    manifest::RunManifest,
};

/// Wall times of a task by what they were spent on, seconds.
pub type Seconds = BTreeMap<String, f64>;

/// What measuring a task gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured<R> {
    /// The result, the same every time.
    pub record: R,
    /// How long it took, never the same.
    pub seconds: Seconds,
}

/// A finished task.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished<R> {
    /// Index of the task in the suite.
    pub index: usize,
    /// Its result.
    pub record: R,
    /// How long it took, where that is known.
    pub seconds: Seconds,
}

/// The records of a benchmark, in a folder or only in memory.
#[derive(Debug)]
pub struct Store<R> {
    manifest: RunManifest,
    files: Option<Files>,
    finished: Vec<Finished<R>>,
}

impl<R: Serialize + DeserializeOwned> Store<R> {
    /// A run that is kept nowhere.
    pub fn in_memory(manifest: RunManifest) -> Self {
        Self { manifest, files: None, finished: Vec::new() }
    }

    /// Begins a run in the folder `dir`, or goes on with the one that is there. A torn last line
    /// is dropped with a note to `watch`, and its task is measured again.
    ///
    /// # Errors
    /// If the folder holds a run with another manifest (the error says what differs) or a damaged
    /// one, another process writes to it, or it cannot be written.
    pub fn open(dir: &Path, manifest: RunManifest, watch: &dyn Watch) -> Result<Self, StoreError> {
        fs::create_dir_all(dir).map_err(|source| StoreError::Io {
            doing: "create",
            path: dir.to_owned(),
            source,
        })?;
        match RunManifest::load(dir)? {
            Some(there) if there != manifest => {
                let differences = there.differences(&manifest);
                return Err(StoreError::OtherRun { path: dir.to_owned(), differences });
            }
            Some(_) => {}
            None if dir.join(super::files::RECORDS).exists() => {
                return Err(StoreError::Stray { path: dir.to_owned() });
            }
            None => manifest.save(dir)?,
        }
        let (lines, records) = read_records(dir, &manifest)?;
        if lines.torn {
            watch.note(&format!(
                "the last record in {} is not whole; its task is measured again",
                dir.display()
            ));
        }
        let indices: Vec<usize> = manifest.indices().take(records.len()).collect();
        let times = read_times(dir)?;
        let times = times.into_iter().filter(|(times, _)| indices.contains(&times.index));
        let (times, kept): (Vec<TimesLine>, Vec<String>) = times.unzip();
        let files = Files::open(dir, &lines, &kept)?;
        let finished = join(&manifest, records, times);
        Ok(Self { manifest, files: Some(files), finished })
    }

    /// Reads a run, finished or not, for reports. Writes nothing.
    ///
    /// # Errors
    /// If the folder holds none or a damaged one.
    pub fn load(dir: &Path) -> Result<Self, StoreError> {
        let manifest = RunManifest::load(dir)?;
        let manifest = manifest.ok_or_else(|| StoreError::Missing { path: dir.to_owned() })?;
        let (_, records) = read_records(dir, &manifest)?;
        let times = read_times(dir)?.into_iter().map(|(times, _)| times).collect();
        let finished = join(&manifest, records, times);
        Ok(Self { manifest, files: None, finished })
    }

    /// Measures every task that is left, in order, and keeps each result as soon as it is there.
    /// `measure` gets the task's index.
    ///
    /// # Errors
    /// The first error of `measure`; a result that cannot be kept; or that `watch`, asked before
    /// every task, says to stop. What was finished is kept in every case.
    pub fn run<E: From<StoreError>>(
        &mut self,
        watch: &dyn Watch,
        mut measure: impl FnMut(usize) -> Result<Measured<R>, E>,
    ) -> Result<(), E> {
        let left: Vec<usize> = self.manifest.indices().skip(self.finished.len()).collect();
        let total = self.manifest.indices().len();
        let tell = |done: usize| watch.progress(done as u64, total as u64);
        tell(self.finished.len());
        for index in left {
            if watch.cancelled() {
                let done = self.finished.len();
                return Err(StoreError::Cancelled { done, total }.into());
            }
            let measured = measure(index)?;
            self.keep(index, measured)?;
            tell(self.finished.len());
        }
        Ok(())
    }

    /// What is measured.
    pub fn manifest(&self) -> &RunManifest {
        &self.manifest
    }

    /// The finished tasks, in order.
    pub fn finished(&self) -> &[Finished<R>] {
        &self.finished
    }

    /// What is measured and the finished tasks; gives the folder free.
    pub fn into_parts(self) -> (RunManifest, Vec<Finished<R>>) {
        (self.manifest, self.finished)
    }

    /// Whether nothing is left to measure.
    pub fn is_complete(&self) -> bool {
        self.finished.len() == self.manifest.indices().len()
    }

    /// Keeps a record as it will be read again, so that a report is the same whether or not the
    /// run was interrupted.
    fn keep(&mut self, index: usize, measured: Measured<R>) -> Result<(), StoreError> {
        let unkept = |source| StoreError::Record { index, source };
        let Measured { record, seconds } = measured;
        let text = line(&RecordLine { index, record }).map_err(unkept)?;
        let read: RecordLine<R> = serde_json::from_str(&text).map_err(unkept)?;
        let times = TimesLine { index, seconds };
        if let Some(files) = &mut self.files {
            files.append(&text, &line(&times).map_err(unkept)?)?;
        }
        self.finished.push(Finished { index, record: read.record, seconds: times.seconds });
        Ok(())
    }
}

fn join<R>(manifest: &RunManifest, records: Vec<R>, times: Vec<TimesLine>) -> Vec<Finished<R>> {
    let mut times: HashMap<usize, Seconds> =
        times.into_iter().map(|times| (times.index, times.seconds)).collect();
    let finished = manifest.indices().zip(records).map(|(index, record)| Finished {
        index,
        record,
        seconds: times.remove(&index).unwrap_or_default(),
    });
    finished.collect()
}
