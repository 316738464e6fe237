//! A collection of tools: those shipped with the program, those of folders, those made in code.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use crate::scene::{BladeTool, Tool};

use super::fault::{Fault, Faults};
use super::folder::files_in;
use super::lever::is_blade_tool;
use super::node::Node;
use super::text::Source;

/// The tools shipped with the program, as file name and text.
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

/// Tools with unique names, sorted by name; those with blades apart from those that push.
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
    tools: Vec<Arc<Tool>>,
    /// They push nothing, so that no task of pushes is offered them.
    blades: Vec<Arc<BladeTool>>,
}

/// What a tool file may be.
enum AnyTool {
    Pushes(Tool),
    Levers(BladeTool),
}

impl AnyTool {
    fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        if is_blade_tool(&Node::parse(Source::yaml(file, text))?) {
            BladeTool::parse(text, file).map(Self::Levers)
        } else {
            Tool::parse(text, file).map(Self::Pushes)
        }
    }

    fn load(path: &Path) -> Result<Self, Faults> {
        let (file, text) = super::read_text(path)?;
        Self::parse(&text, &file)
    }

    fn name(&self) -> &str {
        match self {
            Self::Pushes(tool) => &tool.name,
            Self::Levers(tool) => &tool.name,
        }
    }
}

impl ToolLibrary {
    /// The tools shipped with the program; needs no files.
    ///
    /// # Errors
    /// None in a released program: its tests read every shipped tool.
    pub fn embedded() -> Result<Self, Faults> {
        Self::default().and(SHIPPED.iter().map(|(file, text)| (*file, AnyTool::parse(text, file))))
    }

    /// Every `.yaml` or `.yml` file of the folder `path`.
    ///
    /// # Errors
    /// All faults of all files; a folder that cannot be read or holds no tool; two tools of one
    /// name.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        Self::default().with_folder(path)
    }

    /// These tools and one more.
    ///
    /// # Errors
    /// If the library has a tool of this name already.
    pub fn with(mut self, tool: impl Into<Arc<Tool>>) -> Result<Self, Faults> {
        let tool = tool.into();
        match self.place(&tool.name) {
            Err(place) if self.blade(&tool.name).is_none() => {
                self.tools.insert(place, tool);
                Ok(self)
            }
            _ => Err(taken(&tool.name)),
        }
    }

    /// These tools and one more with a blade.
    ///
    /// # Errors
    /// If the library has a tool of this name already.
    pub fn with_blade(mut self, tool: impl Into<Arc<BladeTool>>) -> Result<Self, Faults> {
        let tool = tool.into();
        match self.blade_place(&tool.name) {
            Err(place) if self.get(&tool.name).is_none() => {
                self.blades.insert(place, tool);
                Ok(self)
            }
            _ => Err(taken(&tool.name)),
        }
    }

    /// These tools and those of every `.yaml` or `.yml` file of the folder `path`.
    ///
    /// # Errors
    /// As [`ToolLibrary::load`]; a file whose tool has the name of one that is here already.
    pub fn with_folder(self, path: impl AsRef<Path>) -> Result<Self, Faults> {
        let path = path.as_ref();
        let files = files_in(path, &["yaml", "yml"])?;
        if files.is_empty() {
            let message = "the folder holds no tool files (*.yaml)";
            let advice = "name the folder with the tools, such as `tools`";
            return Err(Fault::of_file(&path.display().to_string(), message, advice).into());
        }
        let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
        self.and(names.iter().map(String::as_str).zip(files.iter().map(|file| AnyTool::load(file))))
    }

    /// The tool that pushes called `name`.
    pub fn get(&self, name: &str) -> Option<&Arc<Tool>> {
        Some(&self.tools[self.place(name).ok()?])
    }

    /// The tool with a blade called `name`.
    pub fn blade(&self, name: &str) -> Option<&Arc<BladeTool>> {
        Some(&self.blades[self.blade_place(name).ok()?])
    }

    /// All tools with blades, sorted by name.
    pub fn blades(&self) -> &[Arc<BladeTool>] {
        &self.blades
    }

    /// All tools that push, sorted by name.
    pub fn iter(&self) -> std::slice::Iter<'_, Arc<Tool>> {
        self.tools.iter()
    }

    /// Number of tools that push.
    pub fn len(&self) -> usize {
        self.tools.len()
    }

    /// Whether there is no tool that pushes.
    pub fn is_empty(&self) -> bool {
        self.tools.is_empty()
    }

    /// Where the tool called `name` is, or would have to be.
    fn place(&self, name: &str) -> Result<usize, usize> {
        self.tools.binary_search_by(|tool| tool.name.as_str().cmp(name))
    }

    fn blade_place(&self, name: &str) -> Result<usize, usize> {
        self.blades.binary_search_by(|tool| tool.name.as_str().cmp(name))
    }

    /// These tools and those read from files, with all faults of all files.
    fn and<'a>(
        mut self,
        read: impl IntoIterator<Item = (&'a str, Result<AnyTool, Faults>)>,
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
            let name = tool.name().to_owned();
            match (self.place(&name), self.blade_place(&name), tool) {
                (Err(place), Err(_), AnyTool::Pushes(tool)) => {
                    files.insert(name, file);
                    self.tools.insert(place, Arc::new(tool));
                }
                (Err(_), Err(place), AnyTool::Levers(tool)) => {
                    files.insert(name, file);
                    self.blades.insert(place, Arc::new(tool));
                }
                _ => {
                    let first = files.get(&name).copied().unwrap_or("the library");
                    faults.push(Fault::of_file(
                        file,
                        format!("its tool `{name}` is already in {first}"),
                        "rename one of the two",
                    ));
                }
            }
        }
        if faults.is_empty() { Ok(self) } else { Err(Faults(faults)) }
    }
}

fn taken(name: &str) -> Faults {
    let message = "the library already has a tool of this name";
    Fault::of_file(&format!("tool `{name}`"), message, "rename one of the two").into()
}

impl<'a> IntoIterator for &'a ToolLibrary {
    type Item = &'a Arc<Tool>;
    type IntoIter = std::slice::Iter<'a, Arc<Tool>>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
