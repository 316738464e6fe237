//! Data sets of arrays: identical bytes for any number of threads and interruptions.

use std::path::Path;
use std::{fs, io::Read};

use pushplan::progress::NoProgress;
use pushplan_learn::dataset::{
    A_FILE, Dataset, DatasetConfig, DatasetError, NPZ_FORMAT, Preset, generate_npz,
};
use tempfile::TempDir;

use crate::until::Until;

/// Returns all files of a folder except the lock, by name.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), path))
        .filter(|(name, _)| !name.starts_with('.'))
        .map(|(name, path)| (name, fs::read(path).unwrap()))
        .collect();
    found.sort();
    found
}

/// Returns the header of an array of doubles, and its numbers.
fn floats(path: &Path, name: &str) -> (String, Vec<f64>) {
    let mut archive = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = String::from_utf8(bytes[10..10 + length].to_vec()).unwrap();
    let numbers = bytes[10 + length..].chunks_exact(8);
    (header, numbers.map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect())
}

#[test]
fn files_are_the_same_for_any_number_of_threads_and_interruptions() {
    let config = DatasetConfig {
        seed: 5,
        episodes: A_FILE + 3,
        preset: Preset::Tools,
        ..Default::default()
    };
    let [whole, stopped] = [(); 2].map(|()| TempDir::new().unwrap());
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let bytes = pool(3).install(|| generate_npz(&config, whole.path(), &NoProgress)).unwrap();
    let stop = Until::new(A_FILE + 1);
    let made = pool(1).install(|| generate_npz(&config, stopped.path(), &stop));
    assert!(matches!(made, Err(DatasetError::Cancelled)), "{made:?}");
    let names = |folder: &TempDir| -> Vec<String> {
        files(folder.path()).into_iter().map(|(name, _)| name).collect()
    };
    assert_eq!(names(&stopped), ["episodes-00000.npz", "manifest.json", "records.jsonl"]);
    let again = pool(2).install(|| generate_npz(&config, stopped.path(), &NoProgress)).unwrap();
    assert!(files(whole.path()) == files(stopped.path()));
    let expected = ["README.md", "episodes-00000.npz", "episodes-00001.npz"];
    assert_eq!(names(&whole)[..3], expected);
    let sizes = files(whole.path())
        .iter()
        .filter(|(name, _)| name.ends_with("npz"))
        .map(|(_, b)| b.len())
        .sum::<usize>();
    assert_eq!([bytes, again], [sizes as u64; 2]);

    // The arrays contain the sampler's episodes.
    let drawn = Dataset::in_memory(&config.split(5, 2), &NoProgress).unwrap();
    let first = whole.path().join("episodes-00000.npz");
    let (header, poses) = floats(&first, "pose");
    let most = config.ranges().objects.high as usize;
    assert!(header.contains("'<f8'") && header.contains(&format!(", {most}, 3, )")), "{header}");
    let mut rows = poses.chunks_exact(3 * most);
    for episode in drawn.episodes() {
        for frame in &episode.frames {
            let row = rows.next().unwrap();
            for (object, pose) in frame.state.poses.iter().enumerate() {
                let here = [pose.position.x, pose.position.y, pose.heading];
                assert_eq!(row[3 * object..3 * object + 3], here);
            }
            assert!(row[3 * frame.state.poses.len()..].iter().all(|number| number.is_nan()));
        }
    }

    // A changed file is detected.
    fs::write(&first, "no zip").unwrap();
    let made = generate_npz(&config, whole.path(), &NoProgress);
    assert!(made.unwrap_err().to_string().contains("is not what was written"));
    let other = DatasetConfig { seed: 6, ..config };
    assert!(generate_npz(&other, stopped.path(), &NoProgress).is_err());
}

#[test]
fn the_page_describes_every_array() {
    let folder = TempDir::new().unwrap();
    let config =
        DatasetConfig { seed: 1, episodes: 2, preset: Preset::Dense, ..Default::default() };
    generate_npz(&config, folder.path(), &NoProgress).unwrap();
    let file = fs::File::open(folder.path().join("episodes-00000.npz")).unwrap();
    let archive = zip::ZipArchive::new(file).unwrap();
    let held: Vec<String> = archive
        .file_names()
        .map(|name| name.unwrap().trim_end_matches(".npy").to_owned())
        .collect();
    let described: Vec<String> = NPZ_FORMAT
        .lines()
        .filter_map(|line| Some(line.strip_prefix("| `")?.split_once('`')?.0.to_owned()))
        .collect();
    let sorted = |mut names: Vec<String>| {
        names.sort();
        names
    };
    assert_eq!(sorted(held), sorted(described));
    let page = fs::read_to_string(folder.path().join("README.md")).unwrap();
    assert_eq!(page, NPZ_FORMAT);
    let statistics = fs::read(folder.path().join("statistics.json")).unwrap();
    let statistics: serde_json::Value = serde_json::from_slice(&statistics).unwrap();
    for line in NPZ_FORMAT.lines().filter(|line| line.contains("| s |")) {
        let name = line.trim_start_matches("| `").split('`').next().unwrap();
        assert!(statistics[name]["mean"].is_array(), "{name}");
    }
}
