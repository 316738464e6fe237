//! A collection of tools: those shipped with the program, or those of a folder.

use std::path::Path;
use std::sync::Arc;

use crate::scene::Tool;

use super::fault::{Fault, Faults};

/// The tools shipped with the program, as file name and text.
const SHIPPED: &[(&str, &str)] = &[
    ("tools/finger.yaml", include_str!("../../tools/finger.yaml")),
    ("tools/fork.yaml", include_str!("../../tools/fork.yaml")),
    ("tools/hook.yaml", include_str!("../../tools/hook.yaml")),
    ("tools/inverse-l.yaml", include_str!("../../tools/inverse-l.yaml")),
    ("tools/l-hook.yaml", include_str!("../../tools/l-hook.yaml")),
    ("tools/paddle.yaml", include_str!("../../tools/paddle.yaml")),
    ("tools/rake.yaml", include_str!("../../tools/rake.yaml")),
    ("tools/spatula.yaml", include_str!("../../tools/spatula.yaml")),
    ("tools/stick.yaml", include_str!("../../tools/stick.yaml")),
    ("tools/t-head.yaml", include_str!("../../tools/t-head.yaml")),
    ("tools/wedge.yaml", include_str!("../../tools/wedge.yaml")),
];

/// Tools with unique names, sorted by name.
#[derive(Clone, Debug, Default)]
pub struct ToolLibrary {
    tools: Vec<Arc<Tool>>,
}

impl ToolLibrary {
    /// The tools shipped with the program; needs no files.
    ///
    /// # Errors
    /// None in a released program: its tests read every shipped tool.
    pub fn embedded() -> Result<Self, Faults> {
        Self::collect(SHIPPED.iter().map(|(file, text)| (*file, Tool::parse(text, file))))
    }

    /// Every `.yaml` or `.yml` file of the folder `path`.
    ///
    /// # Errors
    /// All faults of all files; a folder that cannot be read or holds no tool.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let path = path.as_ref();
        let listing = |error: std::io::Error| Fault::io(path, "read the folder", &error);
        let mut files = Vec::new();
        for entry in std::fs::read_dir(path).map_err(listing)? {
            let file = entry.map_err(listing)?.path();
            if file.extension().is_some_and(|end| end == "yaml" || end == "yml") {
                files.push(file);
            }
        }
        files.sort();
        if files.is_empty() {
            let message = "the folder holds no tool files (*.yaml)";
            let advice = "name the folder with the tools, such as `tools`";
            return Err(Fault::of_file(&path.display().to_string(), message, advice).into());
        }
        let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
        Self::collect(names.iter().map(String::as_str).zip(files.iter().map(Tool::load)))
    }

    /// A library of these tools; of several with one name only the first is kept.
    pub fn from_tools(tools: impl IntoIterator<Item = Tool>) -> Self {
        let mut tools: Vec<Arc<Tool>> = tools.into_iter().map(Arc::new).collect();
        tools.sort_by(|a, b| a.name.cmp(&b.name));
        tools.dedup_by(|later, first| later.name == first.name);
        Self { tools }
    }

    /// The tool called `name`.
    pub fn get(&self, name: &str) -> Option<&Arc<Tool>> {
        let index = self.tools.binary_search_by(|tool| tool.name.as_str().cmp(name)).ok()?;
        Some(&self.tools[index])
    }

    /// All tools, sorted by name.
    pub fn iter(&self) -> std::slice::Iter<'_, Arc<Tool>> {
        self.tools.iter()
    }

    /// Number of tools.
    pub fn len(&self) -> usize {
        self.tools.len()
    }

    /// Whether there is no tool.
    pub fn is_empty(&self) -> bool {
        self.tools.is_empty()
    }

    fn collect<'a>(
        read: impl IntoIterator<Item = (&'a str, Result<Tool, Faults>)>,
    ) -> Result<Self, Faults> {
        let mut faults = Vec::new();
        let mut tools: Vec<(&str, Tool)> = Vec::new();
        for (file, tool) in read {
            match tool {
                Ok(tool) => match tools.iter().find(|(_, known)| known.name == tool.name) {
                    Some((first, _)) => faults.push(Fault::of_file(
                        file,
                        format!("its tool `{}` is already in {first}", tool.name),
                        "rename one of the two",
                    )),
                    None => tools.push((file, tool)),
                },
                Err(found) => faults.extend(found.0),
            }
        }
        if !faults.is_empty() {
            return Err(Faults(faults));
        }
        Ok(Self::from_tools(tools.into_iter().map(|(_, tool)| tool)))
    }
}

impl<'a> IntoIterator for &'a ToolLibrary {
    type Item = &'a Arc<Tool>;
    type IntoIter = std::slice::Iter<'a, Arc<Tool>>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
