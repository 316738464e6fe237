//! How to make a page's replays again: a command line, and a script in Python.

use std::path::Path;

use serde::{Deserialize, Serialize};

use pushplan::{
    scene::{Models, Span},
    task::{Plan, Push, PushForm},
};

/// Where a task was read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TaskSource {
    /// A file, as people name it.
    File(String),
    /// One of the shipped tasks.
    Example(String),
}

impl TaskSource {
    /// The file at `path`.
    pub fn of(path: impl AsRef<Path>) -> Self {
        Self::File(path.as_ref().display().to_string())
    }

    /// The words of a command line that name it.
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

/// Files and models that a page was made from, as people name them.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// The task.
    pub task: TaskSource,
    /// Folder of the tools that were chosen from instead of the shipped ones.
    pub tools: Option<String>,
    /// Folder of further tools.
    pub more_tools: Option<String>,
    /// The models that predicted, where they must be named.
    pub model: Option<Models>,
}

/// A setting of a run.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The option of the command.
    pub option: &'static str,
    /// The keyword in Python, if there is one.
    pub keyword: Option<&'static str>,
    /// What it is set to.
    pub value: String,
}

impl Setting {
    /// The keyword and its value; `None` where Python cannot set it.
    fn given(&self) -> Option<String> {
        let value = match self.value.parse::<f64>() {
            Ok(_) => self.value.clone(),
            Err(_) => literal(&self.value),
        };
        Some(format!("{}={value}", self.keyword?))
    }
}

/// How the replays are made again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Recipe {
    /// For a shell; empty where it cannot do the same.
    pub command: String,
    /// For Python with the package `pushplan`; empty where it cannot do the same.
    pub python: String,
}

impl Origin {
    /// Of a plan: `pushplan predict` of its pushes, and a script that replays them in both engines.
    ///
    /// A plan without pushes has none to predict, and the task is solved instead.
    pub fn plan(&self, plan: &Plan) -> Recipe {
        Recipe { command: self.command(plan), python: self.script(plan) }
    }

    /// Of a run in a world, which is a file or a number; `settings` are those that were not as
    /// usual.
    pub fn run(&self, world: &str, settings: &[Setting]) -> Recipe {
        let mut words = ["pushplan", "run"].map(str::to_owned).to_vec();
        words.extend(self.task.words());
        words.extend(["--world".to_owned(), quoted(world)]);
        words.extend(self.options());
        for setting in settings {
            words.extend([setting.option.to_owned(), quoted(&setting.value)]);
        }
        // Python takes a world of its own or a number.
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
        lines.push("print(f\"predicted to end {1000 * predicted.error:.1f} mm off\")".to_owned());
        lines.push("print(pushplan.verify(plan))".to_owned());
        lines.join("\n")
    }

    /// The lines that load tools and task, and the name of the tools where they are not the shipped
    /// ones.
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
    /// Of the replays of a plan file.
    pub fn of_plan_file(path: &str) -> Self {
        let load = format!("plan = pushplan.Plan.load({})", literal(path));
        Self {
            command: format!("pushplan verify {}", quoted(path)),
            python: ["import pushplan", "", &load, "print(pushplan.verify(plan))"].join("\n"),
        }
    }

    /// Of what is believed of a recording; `settings` are those that were not as usual, `ranges` those
    /// that masses may be in, kg.
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

/// Whether a plan is pushes of one tool, held in one way: what several tools do in turn has no command of its
/// own.
fn has_one_grip(plan: &Plan) -> bool {
    let yaw = plan.grip_yaw();
    let turned = plan.push_steps().any(|step| step.grip_yaw != yaw);
    !plan.levers() && plan.tools().len() == 1 && !turned
}

/// Whether a push of a plan goes on where the one before it ended, to the last digit.
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

/// A text as Python reads it: JSON's way to write one is Python's, too.
fn literal(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// A word quoted for a POSIX shell.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests;
