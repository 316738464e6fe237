//! The table of contents of a data set on disk, `manifest.json`.

use std::{fs, path::Path};

use serde::{Deserialize, Serialize};

use crate::scene::Ranges;

use super::{config::DatasetConfig, error::DatasetError, shard::write_whole};

/// Name of the file.
pub(super) const MANIFEST: &str = "manifest.json";

/// Version of the manifest's layout.
const SCHEMA_VERSION: u32 = 1;

/// What a folder of shards holds. Written before the first shard and after every one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Version of this layout.
    pub schema_version: u32,
    /// Version of the program that began it.
    pub program: String,
    /// Everything that decides the bits.
    pub config: DatasetConfig,
    /// What the data cover.
    pub ranges: Ranges,
    /// Finished shards, in order.
    pub shards: Vec<ShardEntry>,
}

/// One finished shard.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShardEntry {
    /// File name.
    pub file: String,
    /// Number of episodes.
    pub episodes: u64,
    /// Size, bytes.
    pub bytes: u64,
    /// FNV-1a checksum, hexadecimal.
    pub checksum: String,
}

impl Manifest {
    pub(super) fn new(config: &DatasetConfig) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            program: format!("pushplan {}", env!("CARGO_PKG_VERSION")),
            config: config.clone(),
            ranges: config.ranges(),
            shards: Vec::new(),
        }
    }

    /// Reads the manifest of a folder; nothing if there is none.
    ///
    /// # Errors
    /// If it cannot be read or is not one of ours.
    pub fn load(dir: &Path) -> Result<Option<Self>, DatasetError> {
        let path = dir.join(MANIFEST);
        let text = match fs::read(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(DatasetError::Io { doing: "read", path, source }),
        };
        let manifest: Self = serde_json::from_slice(&text)
            .map_err(|source| DatasetError::Manifest { path: path.clone(), source })?;
        if manifest.schema_version != SCHEMA_VERSION {
            return Err(DatasetError::Damaged { path, why: "it is of another version" });
        }
        manifest.config.check()?;
        Ok(Some(manifest))
    }

    pub(super) fn save(&self, dir: &Path) -> Result<(), DatasetError> {
        let path = dir.join(MANIFEST);
        let mut text = serde_json::to_vec_pretty(self)
            .map_err(|source| DatasetError::Manifest { path: path.clone(), source })?;
        text.push(b'\n');
        write_whole(&path, &text)
    }
}
