//! Help with grouped commands.

use std::fmt::Write;

use clap::Command;

/// Titles, and the commands of each group.
pub type Groups = &'static [(&'static str, &'static [&'static str])];

/// Returns `command` with a help that lists its subcommands in `groups`. Commands that are not part
/// of the build are omitted, and ungrouped commands are last.
pub fn grouped(command: Command, groups: Groups) -> Command {
    let listed: Vec<(String, String)> = command
        .get_subcommands()
        .filter(|one| !one.is_hide_set())
        .map(|one| {
            (
                one.get_name().to_owned(),
                one.get_about().map(ToString::to_string).unwrap_or_default(),
            )
        })
        .collect();
    let widest = listed.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    let mut text = String::new();
    let mut section = |title: &str, names: &[&str]| {
        let found: Vec<_> =
            names.iter().filter_map(|name| listed.iter().find(|(one, _)| one == name)).collect();
        if !found.is_empty() {
            let _ = writeln!(text, "{title}:");
            for (name, about) in found {
                let _ = writeln!(text, "  {name:widest$}  {about}");
            }
            text.push('\n');
        }
    };
    groups.iter().for_each(|(title, names)| section(title, names));
    let named = |name: &str| groups.iter().any(|(_, names)| names.contains(&name));
    let others: Vec<&str> =
        listed.iter().map(|(name, _)| name.as_str()).filter(|name| !named(name)).collect();
    section("Others", &others);
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{text}Options:\n{{options}}\
         {{after-help}}"
    ))
}
