//! Data sets on disk: shards and their manifest, made so that an interruption loses little.

use std::{
    fs,
    path::Path,
    sync::atomic::{AtomicU64, Ordering},
};

use super::{
    config::DatasetConfig,
    error::DatasetError,
    manifest::{MANIFEST, Manifest, ShardEntry},
    shard::{read_shard, shard_path, shard_range, verify_shard, write_shard},
    store::{Dataset, draw_range},
    watch::Watch,
};

/// Makes a data set in the folder `dir`, or finishes one that was interrupted: shards that are
/// there and whole are kept, damaged ones are made again with a note. The files are the same
/// bits for any number of threads and interruptions.
///
/// # Errors
/// If the configuration asks for nothing, the folder holds a data set of other settings, a file
/// cannot be written, or `watch` says to stop. Finished shards are kept in every case, and no
/// unfinished file stands under a final name.
pub fn generate(
    config: &DatasetConfig,
    dir: &Path,
    watch: &dyn Watch,
) -> Result<Manifest, DatasetError> {
    config.check()?;
    fs::create_dir_all(dir).map_err(|source| DatasetError::Io {
        doing: "create",
        path: dir.to_owned(),
        source,
    })?;
    if let Some(there) = Manifest::load(dir)?
        && there.config != *config
    {
        return Err(DatasetError::OtherSettings { path: dir.join(MANIFEST) });
    }
    let mut manifest = Manifest::new(config);
    let done = AtomicU64::new(0);
    for number in 0..config.shards() {
        let path = shard_path(dir, number);
        let range = shard_range(config, number);
        let count = range.end - range.start;
        let checksum = match verify_shard(&path, config, number) {
            Ok(checksum) => {
                let done = done.fetch_add(count, Ordering::Relaxed) + count;
                watch.progress(done, config.episodes);
                checksum
            }
            Err(error) => {
                if let DatasetError::Damaged { .. } = error {
                    watch.note(&format!("{error}; making it again"));
                }
                let episodes = draw_range(config, range, &done, watch)?;
                write_shard(&path, config, &episodes)?
            }
        };
        let bytes = fs::metadata(&path)
            .map_err(|source| DatasetError::Io { doing: "read", path: path.clone(), source })?
            .len();
        manifest.shards.push(ShardEntry {
            file: path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            episodes: count,
            bytes,
            checksum: format!("{checksum:016x}"),
        });
        manifest.save(dir)?;
    }
    Ok(manifest)
}

impl Dataset {
    /// Reads a finished data set from a folder.
    ///
    /// # Errors
    /// If there is none, it is unfinished, or a file is damaged.
    pub fn open(dir: &Path) -> Result<Self, DatasetError> {
        let Some(manifest) = Manifest::load(dir)? else {
            return Err(DatasetError::Missing { path: dir.to_owned() });
        };
        let config = manifest.config;
        let (there, wanted) = (manifest.shards.len() as u64, config.shards());
        if there < wanted {
            return Err(DatasetError::Unfinished { path: dir.to_owned(), there, wanted });
        }
        let mut episodes = Vec::new();
        for number in 0..wanted {
            episodes.extend(read_shard(&shard_path(dir, number), &config, number)?);
        }
        Ok(Self::from_parts(config, episodes))
    }
}
