//! Recipes to repeat a page's replays: a command line and a Python script.

use std::path::Path;

use serde::{Deserialize, Serialize};

use pushplan::{
    scene::{ModelSpec, Span},
    task::{Plan, Push, PushForm},
};

/// Source of a task.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TaskSource {
    /// File, with its path as shown to users.
    File(String),
    /// Example, one of the shipped tasks.
    Example(String),
}

impl TaskSource {
    /// Returns the source for the file at `path`.
    pub fn of(path: impl AsRef<Path>) -> Self {
        Self::File(path.as_ref().display().to_string())
    }

    /// Returns the command-line arguments that name the source.
    fn words(&self) -> Vec<String> {
        match self {
            Self::File(path) => vec![quoted(path)],
            Self::Example(name) => vec!["--example".to_owned(), quoted(name)],
        }
    }
}

impl Default for TaskSource {
    fn default() -> Self {
        Self::File(String::new())
    }
}

/// Files and model from which a page was made, as shown to users.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// Source of the task.
    pub task: TaskSource,
    /// Folder of tools that replaces the shipped ones.
    pub tools: Option<String>,
    /// Folder of additional tools.
    pub more_tools: Option<String>,
    /// Model of the prediction, if it must be named.
    pub model: Option<ModelSpec>,
}

/// Setting of a run.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Command-line option.
    pub option: &'static str,
    /// Keyword argument in Python, if there is one.
    pub keyword: Option<&'static str>,
    /// Value of the setting.
    pub value: String,
}

impl Setting {
    /// Formats the Python keyword argument; `None` if Python does not support the setting.
    fn given(&self) -> Option<String> {
        let value = match self.value.parse::<f64>() {
            Ok(_) => self.value.clone(),
            Err(_) => literal(&self.value),
        };
        Some(format!("{}={value}", self.keyword?))
    }
}

/// Instructions to repeat replays.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Recipe {
    /// Shell command; empty if there is none.
    pub command: String,
    /// Python script with the package `pushplan`; empty if there is none.
    pub python: String,
}

impl Origin {
    /// Returns the recipe of a plan: `pushplan predict` for its pushes, and a script that replays
    /// them in both engines.
    ///
    /// If the plan has no pushes, the recipe solves the task instead.
    pub fn plan(&self, plan: &Plan) -> Recipe {
        Recipe { command: self.command(plan), python: self.script(plan) }
    }

    /// Returns the recipe of a run in `world`, a file or a number. `settings` are the non-default
    /// settings.
    pub fn run(&self, world: &str, settings: &[Setting]) -> Recipe {
        let mut words = ["pushplan", "run"].map(str::to_owned).to_vec();
        words.extend(self.task.words());
        words.extend(["--world".to_owned(), quoted(world)]);
        words.extend(self.options());
        for setting in settings {
            words.extend([setting.option.to_owned(), quoted(&setting.value)]);
        }
        // Python accepts a world object or a number.
        let (mut lines, tools) = self.loads();
        let mut given = vec!["task".to_owned(), world.to_owned()];
        given.extend(tools.map(str::to_owned));
        given.extend(
            self.model.as_ref().map(|model| format!("model={}", literal(&model.to_string()))),
        );
        let keywords: Option<Vec<String>> = settings.iter().map(Setting::given).collect();
        let python = match (world.parse::<u64>(), keywords) {
            (Ok(_), Some(keywords)) => {
                given.extend(keywords);
                lines.push(format!("print(pushplan.run({}))", given.join(", ")));
                lines.join("\n")
            }
            _ => String::new(),
        };
        Recipe { command: words.join(" "), python }
    }

    fn command(&self, plan: &Plan) -> String {
        let found = !has_one_grip(plan);
        let verb = if found { "solve" } else { "predict" };
        let mut words = ["pushplan", verb].map(str::to_owned).to_vec();
        words.extend(self.task.words());
        words.extend(self.options());
        if found {
            return words.join(" ");
        }
        words.extend(["--tool".to_owned(), quoted(plan.tool())]);
        words.extend(["--grip-yaw-deg".to_owned(), plan.grip_yaw().to_degrees().to_string()]);
        for (k, push) in plan.pushes().iter().enumerate() {
            let start = match goes_on(plan, k) {
                true => String::new(),
                false => format!("start={},{} ", push.start.x, push.start.y),
            };
            let (direction, length, speed) = (push.direction.to_degrees(), push.length, push.speed);
            let push = format!("{start}direction_deg={direction} length={length} speed={speed}");
            words.extend(["--push".to_owned(), quoted(&push)]);
        }
        words.join(" ")
    }

    fn options(&self) -> Vec<String> {
        let model = self.model.as_ref().map(ToString::to_string);
        let given =
            [("--model", &model), ("--tools", &self.tools), ("--more-tools", &self.more_tools)];
        let given = given.into_iter().filter_map(|(name, value)| Some((name, value.as_ref()?)));
        given.flat_map(|(name, value)| [name.to_owned(), quoted(value)]).collect()
    }

    fn script(&self, plan: &Plan) -> String {
        let (mut lines, tools) = self.loads();
        let tools = tools.map_or(String::new(), |tools| format!(", {tools}"));
        let model = self.model.as_ref().map(|model| literal(&model.to_string()));
        if !has_one_grip(plan) {
            let model = model.map_or(String::new(), |model| format!(", model={model}"));
            lines.push(format!("print(pushplan.solve(task{tools}{model}))"));
            return lines.join("\n");
        }
        lines.push("pushes = [".to_owned());
        let pushes = plan.pushes();
        let pushes = pushes.iter().enumerate();
        lines.extend(
            pushes.map(|(k, push)| format!("    {},", python_push(push, goes_on(plan, k)))),
        );
        lines.push("]".to_owned());
        lines.push(format!(
            "plan = pushplan.Plan.of(task, {}, pushes, grip_yaw={}{})",
            literal(plan.tool()),
            plan.grip_yaw(),
            tools.replace("tools", "tools=tools")
        ));
        let model = model.map_or(String::new(), |model| format!(", {model}"));
        lines.push(format!("predicted = pushplan.predict(plan{model})"));
        lines.push("print(f\"predicted error: {1000 * predicted.error:.1f} mm\")".to_owned());
        lines.push("print(pushplan.verify(plan))".to_owned());
        lines.join("\n")
    }

    /// Returns the lines that load tools and task, and the name of the tools if they are not the
    /// shipped ones.
    fn loads(&self) -> (Vec<String>, Option<&'static str>) {
        let mut lines = vec!["import pushplan".to_owned(), String::new()];
        let shipped = "pushplan.ToolLibrary.shipped()".to_owned();
        let own = |folder: &String| format!("pushplan.ToolLibrary.load({})", literal(folder));
        let mut tools = self.tools.as_ref().map(own);
        if let Some(folder) = &self.more_tools {
            let known = tools.unwrap_or(shipped);
            tools = Some(format!("{known}.with_folder({})", literal(folder)));
        }
        let (reads, name) = match &self.task {
            TaskSource::File(path) => ("load", literal(path)),
            TaskSource::Example(name) => ("example", literal(name)),
        };
        lines.extend(tools.as_ref().map(|tools| format!("tools = {tools}")));
        let with = tools.as_ref().map_or("", |_| ", tools");
        lines.push(format!("task = pushplan.Task.{reads}({name}{with})"));
        (lines, tools.map(|_| "tools"))
    }
}

impl Recipe {
    /// Returns the recipe for the replays of a plan file.
    pub fn of_plan_file(path: &str) -> Self {
        let load = format!("plan = pushplan.Plan.load({})", literal(path));
        Self {
            command: format!("pushplan verify {}", quoted(path)),
            python: ["import pushplan", "", &load, "print(pushplan.verify(plan))"].join("\n"),
        }
    }

    /// Returns the recipe for the belief of a recording. `settings` are the non-default settings;
    /// `ranges` are the candidate mass ranges, kg.
    pub fn of_recording(path: &str, settings: &[Setting], ranges: &[Span]) -> Self {
        let mut words = ["pushplan", "infer", &quoted(path)].map(str::to_owned).to_vec();
        for setting in settings {
            words.extend([setting.option.to_owned(), quoted(&setting.value)]);
        }
        let mut keywords: Option<Vec<String>> = settings.iter().map(Setting::given).collect();
        if !ranges.is_empty() {
            words.push("--mass-ranges".to_owned());
            words.extend(ranges.iter().map(|range| format!("{}-{}", range.low, range.high)));
            let pairs = ranges.iter().map(|range| format!("({}, {})", range.low, range.high));
            let pairs = pairs.collect::<Vec<_>>().join(", ");
            keywords.iter_mut().for_each(|all| all.push(format!("mass_ranges=[{pairs}]")));
        }
        let load = format!("recording = pushplan.Recording.load({})", literal(path));
        let python = keywords.map_or(String::new(), |keywords| {
            let given = ["recording".to_owned()].into_iter().chain(keywords).collect::<Vec<_>>();
            let infer = format!("print(pushplan.infer({}))", given.join(", "));
            ["import pushplan", "", &load, &infer].join("\n")
        });
        Self { command: words.join(" "), python }
    }
}

/// Returns `true` if the plan consists of pushes with one tool and one grip; no command repeats
/// plans with several tools.
fn has_one_grip(plan: &Plan) -> bool {
    let yaw = plan.grip_yaw();
    let turned = plan.push_steps().any(|step| step.grip_yaw != yaw);
    !plan.levers() && plan.tools().len() == 1 && !turned
}

/// Returns `true` if a push continues exactly from the end of the push before it.
fn goes_on(plan: &Plan, push: usize) -> bool {
    plan.form() == PushForm::Chained && push > 0
}

fn python_push(push: &Push, goes_on: bool) -> String {
    let start = match goes_on {
        true => "None".to_owned(),
        false => format!("({}, {})", push.start.x, push.start.y),
    };
    let Push { direction, length, speed, .. } = push;
    format!("pushplan.Push({start}, {direction}, length={length}, speed={speed})")
}

/// Formats a text as a Python literal; JSON string syntax is valid Python.
fn literal(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Quotes a word for a POSIX shell.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests;
