//! Manifest of a run, `manifest.json`: all settings that determine the bytes of its records.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use pushplan::asset::write_atomic;
use pushplan::plain_file;

use super::error::StoreError;
use super::shard::Shard;

/// Name of the file.
pub(super) const MANIFEST: &str = "manifest.json";

/// Version of the folder's layout.
const FORMAT_VERSION: u32 = 1;

/// Manifest of a folder of records. Runs with equal manifests have equal records.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunManifest {
    /// Version of the folder's layout.
    pub format_version: u32,
    /// Version of the program, because plans may differ between versions.
    pub program: String,
    /// Kind of job, such as the name of a benchmark, which determines the content of the records.
    pub suite: String,
    /// Number of tasks of all shards together, one record each.
    pub tasks: usize,
    /// Seed of the tasks.
    pub seed: u64,
    /// Name of the effect model.
    pub model: String,
    /// Digest of the weights, for a network.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weights: Option<String>,
    /// Other settings that determine the records, such as budgets and a digest of the tools.
    pub settings: Json,
    /// Shard; `None` for a whole run, whether merged or made at once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<Shard>,
}

impl RunManifest {
    /// Returns the manifest of a whole run of `tasks` tasks of a suite, with the named model and
    /// without settings.
    pub fn new(suite: &str, tasks: usize, seed: u64, model: &str) -> Self {
        Self {
            format_version: FORMAT_VERSION,
            program: format!("pushplan {}", env!("CARGO_PKG_VERSION")),
            suite: suite.to_owned(),
            tasks,
            seed,
            model: model.to_owned(),
            weights: None,
            settings: Json::Null,
            shard: None,
        }
    }

    /// Returns this manifest with the digest of a network's weights.
    pub fn with_weights(self, digest: Option<String>) -> Self {
        Self { weights: digest, ..self }
    }

    /// Returns this manifest with settings.
    pub fn with_settings(self, settings: Json) -> Self {
        Self { settings, ..self }
    }

    /// Returns this manifest for one shard; the only shard of one is the whole run.
    pub fn with_shard(self, shard: Shard) -> Self {
        Self { shard: (shard != Shard::WHOLE).then_some(shard), ..self }
    }

    /// Returns the indices of the tasks to measure, ascending.
    pub fn indices(&self) -> impl ExactSizeIterator<Item = usize> + Clone {
        self.shard.unwrap_or(Shard::WHOLE).indices(self.tasks)
    }

    /// Reads the manifest of a folder that must hold a run.
    ///
    /// # Errors
    /// Returns [`StoreError::Missing`] if there is none, and the errors of [`RunManifest::load`].
    pub fn expect(dir: &Path) -> Result<Self, StoreError> {
        Self::load(dir)?.ok_or_else(|| StoreError::Missing { path: dir.to_owned() })
    }

    /// Reads the manifest of a folder; returns `None` if there is none.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read or is not a valid manifest.
    pub fn load(dir: &Path) -> Result<Option<Self>, StoreError> {
        let path = dir.join(MANIFEST);
        let text = match plain_file::read(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(StoreError::io("read", &path)(error)),
        };
        let manifest: Self = serde_json::from_slice(&text)
            .map_err(|source| StoreError::Manifest { path: path.clone(), source })?;
        if manifest.format_version != FORMAT_VERSION {
            let why = format!(
                "the format version is {}, but this program reads {FORMAT_VERSION}",
                manifest.format_version
            );
            return Err(StoreError::Damaged { path, record: 1, why });
        }
        Ok(Some(manifest))
    }

    pub(super) fn save(&self, dir: &Path) -> Result<(), StoreError> {
        let path = dir.join(MANIFEST);
        let mut text = serde_json::to_vec_pretty(self)
            .map_err(|source| StoreError::Manifest { path: path.clone(), source })?;
        text.push(b'\n');
        write_atomic(&path, &text).map_err(StoreError::Write)
    }

    /// Returns the differences from the wanted manifest, a line each.
    pub(super) fn differences(&self, wanted: &Self) -> Vec<String> {
        let (there, wanted) = (self.leaves(), wanted.leaves());
        let keys: std::collections::BTreeSet<&String> = there.keys().chain(wanted.keys()).collect();
        let show = |leaf: Option<&String>| leaf.map_or("unset".to_owned(), String::clone);
        keys.into_iter()
            .filter(|key| there.get(*key) != wanted.get(*key))
            .map(|key| {
                let (there, wanted) = (show(there.get(key)), show(wanted.get(key)));
                format!("{key} is {there} in the folder, but {wanted} was requested")
            })
            .collect()
    }

    /// Returns all leaf values by path.
    fn leaves(&self) -> BTreeMap<String, String> {
        fn collect(path: &str, value: &Json, leaves: &mut BTreeMap<String, String>) {
            let below = |key: &str| match path {
                "" => key.to_owned(),
                path => format!("{path}.{key}"),
            };
            match value {
                Json::Object(map) if path == "shard" => {
                    let number = |key| map.get(key).map(Json::to_string).unwrap_or_default();
                    leaves
                        .insert(path.to_owned(), format!("{}/{}", number("number"), number("of")));
                }
                Json::Object(map) => {
                    map.iter().for_each(|(key, value)| collect(&below(key), value, leaves));
                }
                value => {
                    leaves.insert(path.to_owned(), value.to_string());
                }
            }
        }
        let mut leaves = BTreeMap::new();
        // A manifest consists of strings, numbers and a JSON value, so serialization cannot fail.
        collect("", &serde_json::to_value(self).unwrap_or_default(), &mut leaves);
        leaves
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn differences_are_named_one_by_one() {
        let there = RunManifest::new("random", 10, 7, "network")
            .with_weights(Some("00ff".into()))
            .with_settings(json!({"effort": {"beam": 24}, "kinds": ["pull", "reach"]}));
        let mut wanted = there.clone().with_shard("2/3".parse().expect("a shard"));
        wanted.seed = 8;
        wanted.weights = None;
        wanted.settings["effort"]["beam"] = 64.into();
        assert_eq!(
            there.differences(&wanted),
            [
                "seed is 7 in the folder, but 8 was requested",
                "settings.effort.beam is 24 in the folder, but 64 was requested",
                "shard is unset in the folder, but 2/3 was requested",
                "weights is \"00ff\" in the folder, but unset was requested",
            ]
        );
        assert!(there.differences(&there.clone()).is_empty());
    }
}
