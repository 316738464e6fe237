//! One file of a data set.
//!
//! ```text
//! shard = "PUSHPLN3", digest of the configuration u64, number of episodes u64,
//!         episodes, checksum u64 (FNV-1a of everything before it)
//! ```
//! A shard is written under another name and renamed when complete, so a file under the final
//! name is whole, and the checksum at its end tells whether it still is.

use std::{
    fs::{self, File},
    io::Write,
    path::{Path, PathBuf},
};

use super::{
    codec::{Bytes, put_u64, read_episode, write_episode},
    config::DatasetConfig,
    episode::Episode,
    error::DatasetError,
};

/// First bytes of every shard; the last one counts versions of the format and of the sampler.
const MAGIC: &[u8; 8] = b"PUSHPLN3";

/// Bytes before the episodes.
const HEADER: usize = 24;

/// Where shard `number` of a data set in `dir` lies.
pub(super) fn shard_path(dir: &Path, number: u64) -> PathBuf {
    dir.join(format!("shard-{number:05}.bin"))
}

/// Indices of the episodes in shard `number`.
pub(super) fn shard_range(config: &DatasetConfig, number: u64) -> std::ops::Range<u64> {
    let first = number * config.episodes_per_shard;
    first..(first + config.episodes_per_shard).min(config.episodes)
}

/// Writes a shard under its final name, whole or not at all. Gives its checksum.
pub(super) fn write_shard(
    path: &Path,
    config: &DatasetConfig,
    episodes: &[Episode],
) -> Result<u64, DatasetError> {
    let mut bytes = MAGIC.to_vec();
    put_u64(&mut bytes, digest(config));
    put_u64(&mut bytes, episodes.len() as u64);
    episodes.iter().for_each(|episode| write_episode(&mut bytes, episode));
    let sum = checksum(&bytes);
    put_u64(&mut bytes, sum);
    write_whole(path, &bytes)?;
    Ok(sum)
}

/// Reads the checksum of a whole and fitting shard without decoding its episodes.
pub(super) fn verify_shard(
    path: &Path,
    config: &DatasetConfig,
    number: u64,
) -> Result<u64, DatasetError> {
    open(path, config, number).map(|(_, sum)| sum)
}

/// Reads all episodes of a shard.
pub(super) fn read_shard(
    path: &Path,
    config: &DatasetConfig,
    number: u64,
) -> Result<Vec<Episode>, DatasetError> {
    let (bytes, _) = open(path, config, number)?;
    let mut left = Bytes(&bytes[HEADER..bytes.len() - 8]);
    let range = shard_range(config, number);
    let episodes: Option<Vec<Episode>> = range
        .map(|index| read_episode(&mut left).filter(|episode| episode.index == index))
        .collect();
    match episodes {
        Some(episodes) if left.0.is_empty() => Ok(episodes),
        _ => Err(damaged(path, "its episodes cannot be read")),
    }
}

/// Writes a file under another name, has it reach the disk, and renames it.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), DatasetError> {
    let partial = path.with_extension("partial");
    let written = File::create(&partial)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
        .and_then(|()| fs::rename(&partial, path));
    written.map_err(|source| {
        // What is left of it is of no use; failing to remove it changes nothing.
        let _ = fs::remove_file(&partial);
        DatasetError::Io { doing: "write", path: path.to_owned(), source }
    })
}

/// The bytes of a shard that is whole and belongs to `config`, with their checksum.
fn open(path: &Path, config: &DatasetConfig, number: u64) -> Result<(Vec<u8>, u64), DatasetError> {
    let bytes = fs::read(path).map_err(|source| DatasetError::Io {
        doing: "read",
        path: path.to_owned(),
        source,
    })?;
    let Some((body, tail)) = bytes.len().checked_sub(8).map(|at| bytes.split_at(at)) else {
        return Err(damaged(path, "it is too short"));
    };
    if body.len() < HEADER || !body.starts_with(MAGIC) {
        return Err(damaged(path, "it is no shard of this version"));
    }
    let sum = checksum(body);
    if Bytes(tail).u64() != Some(sum) {
        return Err(damaged(path, "its checksum is wrong"));
    }
    let mut header = Bytes(&body[MAGIC.len()..]);
    let range = shard_range(config, number);
    if header.u64() != Some(digest(config)) || header.u64() != Some(range.end - range.start) {
        return Err(damaged(path, "it belongs to other settings"));
    }
    Ok((bytes, sum))
}

fn damaged(path: &Path, why: &'static str) -> DatasetError {
    DatasetError::Damaged { path: path.to_owned(), why }
}

/// Tells the settings that decide a shard's bits from all others.
fn digest(config: &DatasetConfig) -> u64 {
    let numbers = [config.seed, config.episodes, config.episodes_per_shard];
    let mut bytes = format!("{:?} {:?}", config.preset, config.constraints).into_bytes();
    numbers.iter().for_each(|&number| put_u64(&mut bytes, number));
    checksum(&bytes)
}

/// FNV-1a with 64 bits (Fowler, Noll and Vo; RFC 9923): finds damage, not forgery.
pub fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |sum, &byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksum_matches_published_values() {
        assert_eq!(checksum(b""), 0xCBF2_9CE4_8422_2325);
        assert_eq!(checksum(b"a"), 0xAF63_DC4C_8601_EC8C);
        assert_eq!(checksum(b"foobar"), 0x8594_4171_F739_67E8);
    }
}
