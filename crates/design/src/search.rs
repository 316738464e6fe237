//! Search over tools: evenly sampled candidates first, then variations of the best ones.
//!
//! The search is a seeded evolution in generations without gradients, because a tool's score jumps
//! with every contact change. Every tool has its own random generator, and generations are compared
//! in sampling order. Results are therefore the same for any number of threads.

use rand::Rng;
use rayon::prelude::*;

use pushplan::progress::Count;
use pushplan::seeded::generator;

use super::DesignSettings;
use super::assembly::{Assembly, NUMBERS};
use super::form::Form;
use super::screening::{Look, Looking};
use super::trace::traced;

/// Number of variations screened together.
const GENERATION: usize = 40;

/// Number of best tools that are varied, and its maximum for one form.
const PARENTS: usize = 12;
const OF_A_FORM: usize = 5;

/// Variation of parameters in the first generation and in the last.
const SPREAD: [f64; 2] = [0.4, 0.06];

/// Probabilities that a variation takes an arbitrary form, and the next simpler form.
const REFORMED: f64 = 0.1;
const SIMPLER: f64 = 0.15;

/// Parameter distance below which two tools of one form count as alike.
const ALIKE: f64 = 0.05;

/// Screened tool.
#[derive(Clone)]
pub(super) struct Seen {
    pub assembly: Assembly,
    pub look: Look,
}

/// Screens tools and returns all of them, best first.
pub(super) fn search(looking: &Looking, settings: &DesignSettings, seed: u64) -> Vec<Seen> {
    let forms = Form::up_to(settings.parts.max(1));
    let count = Count::new(looking.progress, 0, settings.candidates);
    let mut first = traced(looking.task, &looking.field, settings.parts);
    first.truncate(settings.traced);
    first.extend(drawn_evenly(&forms, settings.drawn, seed));
    first.truncate(settings.candidates);
    let mut seen = look_at(looking, &first, &count);
    seen.sort_by(|a, b| a.look.compare(&b.look));
    // The count includes assemblies that make no tool.
    let mut made = first.len();
    while made < settings.candidates && !looking.progress.cancelled() {
        let parents = kept(&seen, PARENTS, OF_A_FORM);
        let done = (made - first.len()) as f64 / (settings.candidates - first.len()) as f64;
        let spread = SPREAD[0] * (SPREAD[1] / SPREAD[0]).powf(done);
        let many = GENERATION.min(settings.candidates - made);
        let children: Vec<Assembly> = (made..made + many)
            .map(|index| {
                let mut random = generator(seed, index as u64);
                // The minimum of two draws favours better parents.
                let one = random.random_range(0..parents.len().max(1));
                let one = one.min(random.random_range(0..parents.len().max(1)));
                let mut child = match parents.get(one) {
                    Some(parent) => parent.assembly.varied(&mut random, spread),
                    None => Assembly { form: forms[0], numbers: [0.5; NUMBERS] },
                };
                if random.random_bool(REFORMED) {
                    child.form = forms[random.random_range(0..forms.len())];
                } else if random.random_bool(SIMPLER) {
                    child.form = child.form.simpler().unwrap_or(child.form);
                }
                child
            })
            .collect();
        made += many;
        seen.extend(look_at(looking, &children, &count));
        // The sort is stable: of equals the earlier one comes first.
        seen.sort_by(|a, b| a.look.compare(&b.look));
    }
    seen
}

/// Returns the best of sorted tools that are not alike: up to `most`, and up to `of_a_form` of each
/// form.
pub(super) fn kept(seen: &[Seen], most: usize, of_a_form: usize) -> Vec<&Seen> {
    let mut kept: Vec<&Seen> = Vec::new();
    for one in seen {
        if kept.len() == most {
            break;
        }
        let same = kept.iter().filter(|other| other.assembly.form == one.assembly.form);
        let alike = |other: &&&Seen| one.assembly.distance(&other.assembly) <= ALIKE;
        if same.clone().count() < of_a_form && !same.clone().any(|other| alike(&other)) {
            kept.push(one);
        }
    }
    kept
}

fn look_at(looking: &Looking, assemblies: &[Assembly], count: &Count) -> Vec<Seen> {
    let look = |assembly: &Assembly| {
        let tool = assembly.tool("tool").filter(|_| !looking.progress.cancelled())?;
        let look = looking.at(tool);
        count.one();
        Some(Seen { assembly: assembly.clone(), look })
    };
    assemblies.par_iter().filter_map(look).collect()
}

/// Samples the forms in turn, with evenly distributed parameters: multiples of powers of a
/// generalised golden ratio, from a seeded start (Roberts 2018, "The unreasonable effectiveness of
/// quasirandom sequences").
fn drawn_evenly(forms: &[Form], count: usize, seed: u64) -> Vec<Assembly> {
    let golden = (0..64).fold(1.5f64, |x, _| (1.0 + x).powf(1.0 / (NUMBERS as f64 + 1.0)));
    let mut random = generator(seed, u64::MAX);
    let starts: Vec<[f64; NUMBERS]> =
        forms.iter().map(|_| std::array::from_fn(|_| random.random())).collect();
    let drawn = |k: usize| {
        let (form, turn) = (k % forms.len(), (k / forms.len()) as f64);
        let number = |j: usize| (starts[form][j] + turn * golden.powi(-(j as i32) - 1)).fract();
        Assembly { form: forms[form], numbers: std::array::from_fn(number) }
    };
    (0..count).map(drawn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_tools_are_spread_over_forms_and_numbers() {
        let forms = Form::up_to(3);
        let drawn = drawn_evenly(&forms, 40 * forms.len(), 7);
        for form in &forms {
            let own: Vec<_> = drawn.iter().filter(|one| one.form == *form).collect();
            assert_eq!(own.len(), 40);
            for number in 0..NUMBERS {
                let below = own.iter().filter(|one| one.numbers[number] < 0.5).count();
                assert!((12..=28).contains(&below), "{form:?} {number}: {below} of 40");
            }
        }
    }

    #[test]
    fn the_best_are_kept_that_are_not_alike() {
        let form = Form::up_to(1)[0];
        let seen = |number: f64| Seen {
            assembly: Assembly { form, numbers: [number; NUMBERS] },
            look: Look { misses: 0.0, pushes: 1, pieces: 1, parts: 1, size: number, rollouts: 0 },
        };
        let all = [0.1, 0.12, 0.3, 0.5, 0.7].map(seen);
        let sizes = |most, of_a_form| -> Vec<f64> {
            kept(&all, most, of_a_form).iter().map(|one| one.look.size).collect()
        };
        assert_eq!(sizes(3, 9), [0.1, 0.3, 0.5]);
        assert_eq!(sizes(3, 2), [0.1, 0.3]);
    }
}
