//! Runs of tasks, measured sequentially or in parallel: finished tasks, remaining tasks, and
//! immediate saving of results.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use serde::{Deserialize, Serialize, de::DeserializeOwned};

use pushplan::progress::Progress;

use super::error::StoreError;
use super::form::Form;
use super::journal::{Journal, read_records};
use super::manifest::RunManifest;
use super::times::{Seconds, Times, TimesLine, read_times};

/// Measurement of one task.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured<R> {
    /// Result, which is reproducible.
    pub record: R,
    /// Duration, which is not reproducible.
    pub seconds: Seconds,
}

/// Finished task.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished<R> {
    /// Index of the task in the suite.
    pub index: usize,
    /// Result of the task.
    pub record: R,
    /// Duration, if known.
    pub seconds: Seconds,
}

/// Line of the record file.
#[derive(Serialize, Deserialize)]
struct RecordLine<R> {
    index: usize,
    record: R,
}

/// Records of a run, in a folder or only in memory.
#[derive(Debug)]
pub struct Store<R> {
    manifest: RunManifest,
    files: Option<(Journal, Times)>,
    finished: Vec<Finished<R>>,
}

impl<R: Serialize + DeserializeOwned> Store<R> {
    /// Returns a run that is not saved.
    pub fn in_memory(manifest: RunManifest) -> Self {
        Self { manifest, files: None, finished: Vec::new() }
    }

    /// Creates a run in the folder `dir`, or resumes the existing one. A torn last line is dropped
    /// with a note to `progress`, and its task is measured again.
    ///
    /// # Errors
    /// Returns the errors of [`Journal::open`].
    pub fn open(
        dir: &Path,
        manifest: RunManifest,
        progress: &dyn Progress,
    ) -> Result<Self, StoreError> {
        let mut records = Vec::new();
        let journal = {
            let look = &mut reading(&mut records);
            Journal::open(dir, manifest.clone(), Form::Lines, progress, look)?
        };
        let indices: Vec<usize> = manifest.indices().take(records.len()).collect();
        let times = read_times(dir)?;
        let times = times.into_iter().filter(|(times, _)| indices.contains(&times.index));
        let (times, kept): (Vec<TimesLine>, Vec<String>) = times.unzip();
        let files = Some((journal, Times::open(dir, &kept)?));
        let finished = join(&manifest, records, times);
        Ok(Self { manifest, files, finished })
    }

    /// Reads a run, finished or not, for reports, without writing.
    ///
    /// # Errors
    /// Returns an error if the folder holds no run or a damaged one.
    pub fn load(dir: &Path) -> Result<Self, StoreError> {
        let manifest = RunManifest::expect(dir)?;
        let mut records = Vec::new();
        read_records(dir, &manifest, Form::Lines, &mut reading(&mut records))?;
        let times = read_times(dir)?.into_iter().map(|(times, _)| times).collect();
        let finished = join(&manifest, records, times);
        Ok(Self { manifest, files: None, finished })
    }

    /// Measures the remaining tasks, in order, and saves each result immediately. `measure`
    /// receives the task's index.
    ///
    /// # Errors
    /// Returns the first error of `measure`, an error of saving, or a cancellation by `progress`,
    /// which is polled before every task. Finished tasks are saved in all cases.
    pub fn run<E: From<StoreError>>(
        &mut self,
        progress: &dyn Progress,
        mut measure: impl FnMut(usize) -> Result<Measured<R>, E>,
    ) -> Result<(), E> {
        let left: Vec<usize> = self.manifest.indices().skip(self.finished.len()).collect();
        let total = self.manifest.indices().len();
        let report = |done: usize| progress.update(done as u64, total as u64);
        report(self.finished.len());
        for index in left {
            if progress.cancelled() {
                let done = self.finished.len();
                return Err(StoreError::Cancelled { done, total }.into());
            }
            let measured = measure(index)?;
            self.keep(index, measured)?;
            report(self.finished.len());
        }
        Ok(())
    }

    /// Measures the remaining tasks on `threads` threads, for tasks that do not use all cores by
    /// themselves. Results are saved in order, each as soon as all earlier ones are available.
    ///
    /// # Errors
    /// Returns an error of saving, or a cancellation by `progress`, which is polled before every task.
    /// Running tasks are then completed and saved.
    pub fn run_side_by_side(
        &mut self,
        progress: &dyn Progress,
        threads: usize,
        measure: impl Fn(usize) -> Measured<R> + Sync,
    ) -> Result<(), StoreError>
    where
        R: Send,
    {
        let left: Vec<usize> = self.manifest.indices().skip(self.finished.len()).collect();
        let total = self.manifest.indices().len();
        progress.update(self.finished.len() as u64, total as u64);
        let next = AtomicUsize::new(0);
        let (sender, receiver) = mpsc::channel();
        thread::scope(|scope| {
            // The receiver is dropped when this closure returns, early or not, which stops the
            // other threads.
            let receiver = receiver;
            for _ in 0..threads.clamp(1, left.len().max(1)) {
                let (sender, next, left, measure) = (sender.clone(), &next, &left, &measure);
                scope.spawn(move || {
                    while !progress.cancelled() {
                        let k = next.fetch_add(1, Ordering::Relaxed);
                        let Some(index) = left.get(k) else { return };
                        if sender.send((k, measure(*index))).is_err() {
                            return;
                        }
                    }
                });
            }
            drop(sender);
            let mut waiting = BTreeMap::new();
            for (kept, index) in left.iter().enumerate() {
                let measured = loop {
                    if let Some(measured) = waiting.remove(&kept) {
                        break measured;
                    }
                    let Ok((k, measured)) = receiver.recv() else {
                        let done = self.finished.len();
                        return Err(StoreError::Cancelled { done, total });
                    };
                    waiting.insert(k, measured);
                };
                self.keep(*index, measured)?;
                progress.update(self.finished.len() as u64, total as u64);
            }
            Ok(())
        })
    }

    /// Returns the manifest of the run.
    pub fn manifest(&self) -> &RunManifest {
        &self.manifest
    }

    /// Returns the finished tasks, in order.
    pub fn finished(&self) -> &[Finished<R>] {
        &self.finished
    }

    /// Returns the manifest and the finished tasks; releases the folder.
    pub fn into_parts(self) -> (RunManifest, Vec<Finished<R>>) {
        (self.manifest, self.finished)
    }

    /// Returns `true` if all tasks are finished.
    pub fn is_complete(&self) -> bool {
        self.finished.len() == self.manifest.indices().len()
    }

    /// Saves a record and keeps its deserialized form, so that a report does not depend on
    /// interruptions.
    fn keep(&mut self, index: usize, measured: Measured<R>) -> Result<(), StoreError> {
        let unkept =
            |error: serde_json::Error| StoreError::Record { index, why: error.to_string() };
        let Measured { record, seconds } = measured;
        let line = serde_json::to_vec(&RecordLine { index, record }).map_err(unkept)?;
        let read: RecordLine<R> = serde_json::from_slice(&line).map_err(unkept)?;
        let times = TimesLine { index, seconds };
        if let Some((journal, file)) = &mut self.files {
            // Times are written first, so that every record has times.
            file.append(&serde_json::to_string(&times).map_err(unkept)?)?;
            journal.append([line.as_slice()])?;
        }
        self.finished.push(Finished { index, record: read.record, seconds: times.seconds });
        Ok(())
    }
}

/// Returns a callback that appends each parsed line to `records`.
fn reading<R: DeserializeOwned>(
    records: &mut Vec<R>,
) -> impl FnMut(&[u8]) -> Result<usize, String> {
    |line| {
        let read: RecordLine<R> =
            serde_json::from_slice(line).map_err(|error| error.to_string())?;
        records.push(read.record);
        Ok(read.index)
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
