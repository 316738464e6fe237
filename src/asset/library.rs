//! Collection of tools: shipped tools, tools from folders and tools built in code.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use crate::scene::Tool;

use super::diagnostic::{Fault, Faults};
use super::folder::files_in;

/// Shipped tools, as file name and text.
const SHIPPED: &[(&str, &str)] = &[
    ("tools/finger.yaml", include_str!("../../tools/finger.yaml")),
    ("tools/fork.yaml", include_str!("../../tools/fork.yaml")),
    ("tools/hook.yaml", include_str!("../../tools/hook.yaml")),
    ("tools/inverse-l.yaml", include_str!("../../tools/inverse-l.yaml")),
    ("tools/l-hook.yaml", include_str!("../../tools/l-hook.yaml")),
    ("tools/paddle.yaml", include_str!("../../tools/paddle.yaml")),
    ("tools/rake.yaml", include_str!("../../tools/rake.yaml")),
    ("tools/scraper.yaml", include_str!("../../tools/scraper.yaml")),
    ("tools/screwdriver.yaml", include_str!("../../tools/screwdriver.yaml")),
    ("tools/spatula.yaml", include_str!("../../tools/spatula.yaml")),
    ("tools/stick.yaml", include_str!("../../tools/stick.yaml")),
    ("tools/t-head.yaml", include_str!("../../tools/t-head.yaml")),
    ("tools/wedge.yaml", include_str!("../../tools/wedge.yaml")),
];

/// Collection of tools with unique names, sorted by name; pushing tools and blade tools are kept
/// apart.
///
/// ```
/// use pushplan::{Part, Pose, Tool, ToolLibrary};
///
/// // 30 cm long, 4 cm wide and 5 cm high, held at its near end.
/// let bar = Part::cuboid("bar", [0.30, 0.04, 0.05], Pose::new(0.15, 0.0, 0.0));
/// let library = ToolLibrary::embedded()?.with(Tool::new("bar", [bar])?)?;
/// assert!(library.get("bar").is_some() && library.get("rake").is_some());
/// # Ok::<(), pushplan::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct ToolLibrary {
    /// Pushing tools.
    tools: Vec<Arc<Tool>>,
    /// Blade tools, for levering only; pushing tasks never use them.
    blades: Vec<Arc<Tool>>,
}

impl ToolLibrary {
    /// Returns the tools shipped with the program; no files are needed.
    ///
    /// # Errors
    /// Never in a released program, because its tests read every shipped tool.
    pub fn embedded() -> Result<Self, Faults> {
        Self::default().and(SHIPPED.iter().map(|(file, text)| (*file, Tool::parse(text, file))))
    }

    /// Reads every `.yaml` or `.yml` file of the folder `path`.
    ///
    /// # Errors
    /// Returns all faults of all files. Also fails if the folder cannot be read or holds no tool,
    /// or if two tools have one name.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        Self::default().with_folder(path)
    }

    /// Adds a tool.
    ///
    /// # Errors
    /// Returns an error if the library already has a tool of this name.
    pub fn with(mut self, tool: impl Into<Arc<Tool>>) -> Result<Self, Faults> {
        let tool = tool.into();
        let name = tool.name.clone();
        if self.insert(tool) {
            return Ok(self);
        }
        let message = "the library already has a tool of this name";
        Err(Fault::of_file(&format!("tool `{name}`"), message, "rename one of the two").into())
    }

    /// Adds the tools of every `.yaml` or `.yml` file of the folder `path`. They replace tools of
    /// the same names.
    ///
    /// # Errors
    /// Returns the errors of [`ToolLibrary::load`].
    pub fn with_folder(self, path: impl AsRef<Path>) -> Result<Self, Faults> {
        let path = path.as_ref();
        let files = files_in(path, &["yaml", "yml"])?;
        if files.is_empty() {
            let message = "the folder holds no tool files (*.yaml)";
            let advice = "name the folder that contains the tools, such as `tools`";
            return Err(Fault::of_file(&path.display().to_string(), message, advice).into());
        }
        let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
        self.and(names.iter().map(String::as_str).zip(files.iter().map(Tool::load)))
    }

    /// Returns the tool called `name`.
    pub fn get(&self, name: &str) -> Option<&Arc<Tool>> {
        [&self.tools, &self.blades]
            .into_iter()
            .find_map(|tools| Some(&tools[place(tools, name).ok()?]))
    }

    /// Returns all blade tools, sorted by name.
    pub fn blades(&self) -> &[Arc<Tool>] {
        &self.blades
    }

    /// Iterates over the pushing tools, sorted by name.
    pub fn iter(&self) -> std::slice::Iter<'_, Arc<Tool>> {
        self.tools.iter()
    }

    /// Returns the number of pushing tools.
    pub fn len(&self) -> usize {
        self.tools.len()
    }

    /// Returns `true` if there is no pushing tool.
    pub fn is_empty(&self) -> bool {
        self.tools.is_empty()
    }

    /// Adds a tool; returns `false` if its name is already taken.
    fn insert(&mut self, tool: Arc<Tool>) -> bool {
        let free = self.get(&tool.name).is_none();
        let tools = if tool.pushes() { &mut self.tools } else { &mut self.blades };
        if let (true, Err(place)) = (free, place(tools, &tool.name)) {
            tools.insert(place, tool);
        }
        free
    }

    /// Adds tools read from files; returns all faults of all files.
    fn and<'a>(
        mut self,
        read: impl IntoIterator<Item = (&'a str, Result<Tool, Faults>)>,
    ) -> Result<Self, Faults> {
        let mut faults = Vec::new();
        let mut files: BTreeMap<String, &str> = BTreeMap::new();
        for (file, tool) in read {
            let tool = match tool {
                Ok(tool) => tool,
                Err(found) => {
                    faults.extend(found.0);
                    continue;
                }
            };
            let name = tool.name.clone();
            if let Some(first) = files.get(&name) {
                let message = format!("its tool `{name}` is already defined in {first}");
                faults.push(Fault::of_file(file, message, "rename one of the two"));
                continue;
            }
            for known in [&mut self.tools, &mut self.blades] {
                known.retain(|known| known.name != name);
            }
            self.insert(Arc::new(tool));
            files.insert(name, file);
        }
        if faults.is_empty() { Ok(self) } else { Err(Faults(faults)) }
    }
}

/// Returns the index of the tool called `name` in `tools`, or its insertion index.
fn place(tools: &[Arc<Tool>], name: &str) -> Result<usize, usize> {
    tools.binary_search_by(|tool| tool.name.as_str().cmp(name))
}

impl<'a> IntoIterator for &'a ToolLibrary {
    type Item = &'a Arc<Tool>;
    type IntoIter = std::slice::Iter<'a, Arc<Tool>>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
