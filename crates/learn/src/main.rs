//! Command `pushplan-learn`.

use std::process::ExitCode;

// Training allocates many short-lived tensors and is a fifth faster than with the system's
// allocator.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

#[allow(unsafe_code)] // setting a variable of the environment
fn main() -> ExitCode {
    // candle would parallelise every sum inside our own threads, which makes training take half as
    // long again. Only candle reads this variable; every command starts its own threads, see
    // `--threads`.
    // SAFETY: no other thread exists yet that could read the environment.
    unsafe { std::env::set_var("RAYON_NUM_THREADS", "1") };
    pushplan_learn::cli::run(std::env::args_os()).into()
}
