//! What pages of the repository show.

/// Every command of the pages, without the program's name. With `--help` behind it a command line is
/// read up to there.
pub fn commands() -> Vec<String> {
    let pages = [
        include_str!("../../README.md"),
        include_str!("../../models/results.md"),
        include_str!("../../models/brdpn.md"),
        include_str!("../../models/regulator.md"),
        include_str!("../../models/lever.md"),
        include_str!("../../models/diary.md"),
    ];
    let mut commands = Vec::new();
    for block in pages.iter().flat_map(|page| blocks(page, "sh")) {
        let lines = block.replace("\\\n", " ");
        for command in lines.lines().filter_map(|line| line.strip_prefix("pushplan ")) {
            let command = command.split(" #").next().unwrap_or(command);
            let command = command.split(" && ").next().unwrap_or(command);
            commands.push(command.to_owned());
        }
    }
    commands
}

/// Whether a command needs a build with training.
pub fn trains(command: &str) -> bool {
    command.starts_with("train")
}

/// The contents of a page's code blocks in `language`.
pub fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    page.split(&fence)
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .map(str::to_owned)
        .collect()
}
