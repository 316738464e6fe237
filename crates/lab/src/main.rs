//! The command `pushplan-lab`.

use std::process::ExitCode;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    pushplan_lab::cli::run(std::env::args_os()).into()
}
