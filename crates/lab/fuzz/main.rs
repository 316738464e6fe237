//! Fuzzes the readers of user files, and what a file that was read must survive.
//!
//! Every case is a function of the target, the seed and its number, so it can be run again; no
//! toolchain but stable Rust is needed. See `crates/lab/fuzz/README.md`.

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
use std::time::{Duration, Instant};

use clap::Parser;

use corpus::Corpus;
use random::Random;
use targets::Target;

/// A case that takes longer than this is a failure: something is done without a bound.
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
    /// Where failing files are written
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
    let mut failures = 0;
    for target in targets {
        failures += fuzz(target, &arguments);
    }
    if failures == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Runs the corpus of a target and then mutations of it; the number of failures.
fn fuzz(target: Target, arguments: &Arguments) -> u64 {
    let corpus = Corpus::of(target);
    let (mut accepted, mut failures) = (0u64, 0);
    let mut slowest = (Duration::ZERO, String::new());
    let began = Instant::now();
    let seeds = corpus.files.iter().map(|(name, bytes)| (name.clone(), bytes.clone()));
    let mutations = (arguments.from..arguments.from + arguments.count).map(|index| {
        let mut random = Random::new(target, arguments.seed, index);
        (format!("{index}"), corpus.mutated(target, &mut random))
    });
    for (name, input) in seeds.chain(mutations) {
        if let Some(path) = &arguments.current {
            std::fs::write(path, &input).expect("the file for the current case");
        }
        let since = Instant::now();
        let outcome = quietly(|| target.run(&input));
        let took = since.elapsed();
        if took > slowest.0 {
            slowest = (took, name.clone());
        }
        let why = match outcome {
            Ok(true) if took <= LONGEST => {
                accepted += 1;
                continue;
            }
            Ok(_) if took > LONGEST => format!("took {:.1} s", took.as_secs_f64()),
            Ok(_) => continue,
            Err(why) => why,
        };
        failures += 1;
        let place = save(target, &name, &input, arguments);
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

/// What `run` returns, or the message of its panic.
fn quietly(run: impl FnOnce() -> bool) -> Result<bool, String> {
    let hook = panic::take_hook();
    let place = std::sync::Arc::new(std::sync::Mutex::new(String::new()));
    let noted = std::sync::Arc::clone(&place);
    panic::set_hook(Box::new(move |info| {
        if let Ok(mut place) = noted.lock() {
            *place = info.to_string();
        }
    }));
    let outcome = panic::catch_unwind(AssertUnwindSafe(run));
    panic::set_hook(hook);
    outcome.map_err(|_| place.lock().map(|text| text.clone()).unwrap_or_default())
}

/// Keeps a failing file, and says where.
fn save(target: Target, name: &str, input: &[u8], arguments: &Arguments) -> String {
    let name: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let file = format!("{}-{}-{name}{}", target.name(), arguments.seed, target.ending());
    let path = arguments.found.join(file);
    let written = std::fs::create_dir_all(&arguments.found)
        .and_then(|()| std::fs::write(&path, input))
        .map(|()| format!("kept in {}", path.display()));
    written.unwrap_or_else(|error| format!("cannot be kept: {error}"))
}
