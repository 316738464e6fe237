//! Fuzzer of the readers of user files, and of the uses of accepted files.
//!
//! Every case is a function of the target, the seed and its number, so it can be repeated. Stable
//! Rust is the only toolchain needed. See `crates/lab/fuzz/README.md`.

mod bytes;
mod corpus;
mod levers;
mod markup;
mod random;
mod snippets;
mod survive;
mod targets;
mod tree;

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use clap::Parser;

use corpus::Corpus;
use random::Random;
use targets::Target;

/// Maximum duration of a case; a longer one is a failure because its work is unbounded.
const LONGEST: Duration = Duration::from_secs(60);

/// Mutate user files and see that nothing panics, hangs, or is refused without a reason
#[derive(Parser)]
#[command(name = "fuzz")]
struct Arguments {
    /// Cases for each target
    #[arg(long, default_value_t = 2000)]
    count: u64,
    /// Number of the first case
    #[arg(long, default_value_t = 0)]
    from: u64,
    /// Seed of the mutations
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only these targets
    #[arg(long, value_enum)]
    target: Vec<Target>,
    /// Write every case to this file before it runs: for one that ends the process
    #[arg(long, value_name = "FILE")]
    current: Option<PathBuf>,
    /// Folder for failing files
    #[arg(long, value_name = "DIR", default_value = "crates/lab/fuzz/found")]
    found: PathBuf,
}

fn main() -> ExitCode {
    pushplan_arm::install();
    let arguments = Arguments::parse();
    let targets = match arguments.target.is_empty() {
        true => Target::ALL.to_vec(),
        false => arguments.target.clone(),
    };
    keep_panics();
    let mut failures = 0;
    for target in targets {
        failures += fuzz(target, &arguments);
    }
    if failures == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// A case of a target.
struct Case {
    name: String,
    input: Vec<u8>,
}

/// The result of a case.
struct Tried {
    took: Duration,
    /// `true` if the file was accepted, or the message of the panic.
    outcome: Result<bool, String>,
}

impl Tried {
    /// Runs a case; after a panic the message is the last one of any thread.
    fn of(target: Target, case: &Case) -> Self {
        let since = Instant::now();
        let outcome = panic::catch_unwind(AssertUnwindSafe(|| target.run(&case.input)))
            .map_err(|_| LAST_PANIC.lock().map(|text| text.clone()).unwrap_or_default());
        Self { took: since.elapsed(), outcome }
    }

    /// Returns the reason of a failure, if any.
    fn failure(&self) -> Option<String> {
        match &self.outcome {
            Err(why) => Some(why.clone()),
            Ok(_) if self.took > LONGEST => Some(format!("took {:.1} s", self.took.as_secs_f64())),
            Ok(_) => None,
        }
    }
}

/// Runs the corpus of a target and then mutations of it, on all processors, and returns the number
/// of failures. A case that fails beside others is run again alone, so that its message and its
/// time are its own.
fn fuzz(target: Target, arguments: &Arguments) -> u64 {
    let corpus = Corpus::of(target);
    let began = Instant::now();
    let case = |index: usize| match corpus.files.get(index) {
        Some((name, bytes)) => Case { name: name.clone(), input: bytes.clone() },
        None => {
            let number = arguments.from + (index - corpus.files.len()) as u64;
            let mut random = Random::new(target, arguments.seed, number);
            Case { name: number.to_string(), input: corpus.mutated(target, &mut random) }
        }
    };
    let count = corpus.files.len() + arguments.count as usize;
    let tried = Mutex::new((0..count).map(|_| None).collect::<Vec<Option<Tried>>>());
    let next = AtomicUsize::new(0);
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            let case = case(index);
            if let Some(path) = &arguments.current {
                std::fs::write(path, &case.input).expect("the file for the current case");
            }
            let found = Tried::of(target, &case);
            tried.lock().expect("no panic while it is held")[index] = Some(found);
        }
    };
    // One at a time if the process may end in a case, because only one case is written.
    let threads = if arguments.current.is_some() { 1 } else { rayon::current_num_threads() };
    std::thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
    let tried = tried.into_inner().expect("no panic while it was held");

    let (mut accepted, mut failures) = (0u64, 0);
    let mut slowest = (Duration::ZERO, String::new());
    for (index, tried) in tried.into_iter().enumerate() {
        let Some(tried) = tried else { continue };
        if tried.took > slowest.0 {
            slowest = (tried.took, case(index).name);
        }
        accepted += u64::from(tried.outcome == Ok(true));
        let Some(first) = tried.failure() else { continue };
        let case = case(index);
        let Some(why) = Tried::of(target, &case).failure().or(tried.outcome.err().and(Some(first)))
        else {
            continue;
        };
        failures += 1;
        let place = save(target, &case.name, &case.input, arguments);
        let name = &case.name;
        eprintln!("{} case {name} of seed {}: {why}\n  {place}", target.name(), arguments.seed);
    }
    println!(
        "{:10} {:5} files of the corpus, {:6} mutations, {accepted:6} accepted, {failures} \
         failures; {:.1} s, slowest {:.2} s (case {})",
        target.name(),
        corpus.files.len(),
        arguments.count,
        began.elapsed().as_secs_f64(),
        slowest.0.as_secs_f64(),
        slowest.1,
    );
    failures
}

/// Message of the last panic of any thread.
static LAST_PANIC: Mutex<String> = Mutex::new(String::new());

/// Stores messages of panics instead of printing them.
fn keep_panics() {
    panic::set_hook(Box::new(|info| {
        if let Ok(mut last) = LAST_PANIC.lock() {
            *last = info.to_string();
        }
    }));
}

/// Stores a failing file, and returns its place.
fn save(target: Target, name: &str, input: &[u8], arguments: &Arguments) -> String {
    let name: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let file = format!("{}-{}-{name}{}", target.name(), arguments.seed, target.ending());
    let path = arguments.found.join(file);
    let written = std::fs::create_dir_all(&arguments.found)
        .and_then(|()| std::fs::write(&path, input))
        .map(|()| format!("kept in {}", path.display()));
    written.unwrap_or_else(|error| format!("cannot be kept: {error}"))
}
