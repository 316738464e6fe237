//! The command `pushplan-lab`.

use std::process::ExitCode;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[allow(unsafe_code)] // setting a variable of the environment
fn main() -> ExitCode {
    // As in `pushplan-learn`: candle must not split sums over threads of its own, inside ours.
    // SAFETY: no other thread exists yet that could read the environment.
    unsafe { std::env::set_var("RAYON_NUM_THREADS", "1") };
    pushplan_lab::cli::run(std::env::args_os()).into()
}
