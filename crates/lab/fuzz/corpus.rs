//! Seeds of mutations: shipped files, files derived from them, and `crates/lab/fuzz/corpus`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pushplan::asset::{PlanFile, ToolLibrary, TrajectoryFile};
use pushplan::effect::{EffectModel, EffectModels, Prior};
use pushplan::geometry::Vector;
use pushplan::network::{Config, Parameters, PredictorWeights};
use pushplan::{
    outcome::{Outcome, Record},
    task::{Job, Plan, Push, Task},
};
use serde_json::Value as Json;

use crate::bytes::damaged;
use crate::levers;
use crate::markup::spoiled;
use crate::random::Random;
use crate::targets::Target;
use crate::tree::Tree;

/// Seed files of a target, by name.
pub struct Corpus {
    pub files: Vec<(String, Vec<u8>)>,
}

impl Corpus {
    /// Returns all files of a target.
    pub fn of(target: Target) -> Self {
        let mut files = match target {
            Target::Tool => folder("tools"),
            Target::Task => folder("tasks"),
            Target::Plan => made(plan),
            Target::Trajectory => made(trajectory),
            Target::Blade => folder("tools"),
            Target::LeverTask => folder("tasks/levers"),
            Target::LeverPlan => levers::plans(),
            // Stored in `corpus`.
            Target::Recording => Vec::new(),
            Target::Weights => vec![("small".into(), weights())],
            Target::Foreign => folder("tests/cmd/import.in"),
        };
        files.extend(folder(&format!("crates/lab/fuzz/corpus/{}", target.name())));
        Self { files }
    }

    /// Returns a mutation of a random file.
    pub fn mutated(&self, target: Target, random: &mut Random) -> Vec<u8> {
        let (_, bytes) = random.pick(&self.files);
        let (_, other) = random.pick(&self.files);
        if target == Target::Weights {
            return if random.once_in(3) {
                damaged(bytes, other, random)
            } else {
                header(bytes, random)
            };
        }
        if random.once_in(3) {
            return damaged(bytes, other, random);
        }
        if target == Target::Foreign {
            return spoiled(bytes, random);
        }
        let text = String::from_utf8_lossy(bytes);
        // JSON is YAML, but the YAML parser is slow on very long files.
        let parsed = match serde_json::from_str::<Json>(&text) {
            Ok(value) => Some(value),
            Err(_) => serde_yaml::from_str::<Json>(&text).ok(),
        };
        match parsed {
            Some(value) => {
                let mut tree = Tree::of(&value);
                tree.spoil(random);
                tree.write().into_bytes()
            }
            None => damaged(bytes, other, random),
        }
    }
}

/// Returns a weights file with a mutated header, sometimes with values that are not finite.
fn header(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let Some((length, rest)) = bytes.split_first_chunk::<8>() else { return bytes.to_vec() };
    let length = usize::try_from(u64::from_le_bytes(*length)).unwrap_or(usize::MAX).min(rest.len());
    let (header, values) = rest.split_at(length);
    let mut values = values.to_vec();
    if random.once_in(4) && values.len() >= 4 {
        let at = 4 * random.below(values.len() / 4);
        let value = *random.pick(&[f32::NAN, f32::INFINITY, f32::MAX, 1e-40, 0.0]);
        values[at..at + 4].copy_from_slice(&value.to_le_bytes());
    }
    let Ok(mut parsed) = serde_json::from_slice::<Json>(header) else { return bytes.to_vec() };
    // The card is a text within the text.
    let card = parsed.pointer("/__metadata__/pushplan").and_then(Json::as_str);
    let card = card.and_then(|card| serde_json::from_str::<Json>(card).ok());
    if let Some(card) = card.filter(|_| random.once_in(2)) {
        let mut tree = Tree::of(&card);
        tree.spoil(random);
        parsed["__metadata__"]["pushplan"] = Json::String(tree.write());
    }
    let mut tree = Tree::of(&parsed);
    if random.once_in(2) {
        tree.spoil(random);
    }
    let header = tree.write().into_bytes();
    [&(header.len() as u64).to_le_bytes()[..], &header, &values].concat()
}

/// Returns every file of a folder of the repository, in order; none if there is no such folder.
fn folder(name: &str) -> Vec<(String, Vec<u8>)> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let Ok(entries) = std::fs::read_dir(root.join(name)) else { return Vec::new() };
    let mut paths: Vec<PathBuf> =
        entries.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect();
    // Pictures and sources are next to some of them.
    let is_data = |path: &PathBuf| {
        path.extension().is_some_and(|end| {
            ["yaml", "json", "safetensors", "xml", "urdf"].iter().any(|e| end == *e)
        })
    };
    paths.retain(|path| path.is_file() && is_data(path));
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.strip_prefix(root).unwrap_or(&path).display().to_string();
        Some((name, std::fs::read(path).ok()?))
    };
    paths.into_iter().filter_map(read).collect()
}

/// Returns the files that `make` derives from some shipped tasks.
fn made(make: fn(&Sample) -> String) -> Vec<(String, Vec<u8>)> {
    ["pull-back", "keep-heading", "hinged-train", "around-corner"]
        .into_iter()
        .filter_map(|name| Some((name.to_owned(), make(&sample(name)?).into_bytes())))
        .collect()
}

/// A shipped task with a plan of two pushes, which need not reach the goal.
struct Sample {
    plan: PlanFile,
    trajectory: pushplan::outcome::Trajectory,
}

fn sample(name: &str) -> Option<Sample> {
    let library = ToolLibrary::embedded().ok()?;
    let path =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join(format!("tasks/{name}.yaml"));
    let task = Task::load(path).ok()?;
    let tool = Arc::clone(task.tools(&library).ok()?.first()?);
    let at = task.scene.objects[task.goals[0].object].pose.position;
    let push = |start, direction| Push { start, direction, length: 0.1, speed: 0.1 };
    let (yaw, rules) = (0.0, &task.pushes);
    let pushes = vec![push(at - Vector::new(0.5, 0.0), 0.0), push(at - Vector::new(0.4, 0.0), 0.3)];
    let plan = Plan::pushing(&tool.name, yaw, rules.form, rules.lift, pushes);
    let motion = plan.motion(&tool);
    let job = Job::stated(&task.scene, motion);
    let trajectory = Prior::default().rollout(&task.scene, &[job], Record::Frames).pop()?;
    let predicted = Some(Outcome::judge(&task.scene, &task, &trajectory));
    let model = Some(trajectory.by.clone());
    let plan = PlanFile { model, predicted, ..PlanFile::new(task, vec![tool], plan) };
    Some(Sample { plan, trajectory })
}

fn plan(sample: &Sample) -> String {
    serde_json::to_string(&sample.plan).unwrap_or_default()
}

fn trajectory(sample: &Sample) -> String {
    let mut trajectory = sample.trajectory.clone();
    // A few frames are sufficient and faster to read.
    trajectory.frames.truncate(6);
    trajectory.contacts.retain(|contact| contact.frame < 6);
    let PlanFile { task, tools, plan, .. } = sample.plan.clone();
    serde_json::to_string(&TrajectoryFile { task, tools, plan, trajectory }).unwrap_or_default()
}

/// Returns the shipped card with a network of four units.
fn weights() -> Vec<u8> {
    let shipped = EffectModels::weights().expect("the shipped weights are sound");
    let config = Config { width: 4, steps: 1 };
    let parameters = Parameters::fresh(&config, 1);
    let card = pushplan::network::PredictorCard { config, ..shipped.card };
    PredictorWeights { card, parameters }.to_bytes().expect("a small network")
}
