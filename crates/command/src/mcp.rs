//! `pushplan mcp`: the server for agents, which the Python package contains.

use std::ffi::OsString;

use clap::Args;

use super::error::CliError;

/// Serve the planner to agents by the Model Context Protocol; needs the Python package
#[derive(Args, Debug)]
pub struct McpArgs {
    /// Options of the server, listed by `pushplan mcp --help` of the Python package
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTION")]
    options: Vec<OsString>,
}

/// Returns the error of a command without Python. The entry point of the Python package starts the
/// server itself, because the protocol's SDK is a Python package.
pub fn run(_: &McpArgs) -> Result<u8, CliError> {
    Err(CliError::usage(
        "`mcp` is not part of this program, but of the Python package",
        "`pip install 'pushplan[mcp]'`, and use its command `pushplan`",
    ))
}
