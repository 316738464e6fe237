//! The command `pushplan-learn`.

use std::process::ExitCode;

// Training allocates many short-lived tensors: a fifth faster than with the system's allocator.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[allow(unsafe_code)] // setting a variable of the environment
fn main() -> ExitCode {
    // candle would split every sum over threads of its own, inside ours: training takes half as
    // long again. It asks this variable, and nothing else here does: every command starts its
    // own threads, see `--threads`.
    // SAFETY: no other thread exists yet that could read the environment.
    unsafe { std::env::set_var("RAYON_NUM_THREADS", "1") };
    pushplan_learn::cli::run(std::env::args_os()).into()
}
