//! Belief over the pushes of a run, or over the observations of a recording.

use pushplan::scene::Physics;
use pushplan_act::act::Trace;
use pushplan_act::belief::{Belief, JointType, Numbers};

use super::data::{Believed, Joined};

/// Returns the names of the joint types, and the type probabilities of every pair.
pub fn joints(trace: &Trace) -> (Vec<String>, Vec<Joined>) {
    let objects = &trace.task.scene.objects;
    let types = JointType::ALL.iter().map(ToString::to_string).collect();
    let really = |[a, b]: [usize; 2]| {
        let mut known = trace.truth.as_ref()?.scene.joints.iter();
        let joint = known.find(|joint| joint.between == [a, b] || joint.between == [b, a]);
        JointType::ALL.iter().position(|kind| *kind == JointType::of(joint))
    };
    let joined = |(p, [a, b]): (usize, [usize; 2])| {
        let all =
            std::iter::once(&trace.prior).chain(trace.steps.iter().map(|step| &step.probabilities));
        let shares = all.filter_map(|pairs| Some(pairs.get(p)?.map(thousandths)));
        Some(Joined {
            name: format!("{} and {}", objects.get(a)?.name, objects.get(b)?.name),
            shares: shares.collect(),
            really: really([a, b]),
        })
    };
    (types, trace.pairs.iter().copied().enumerate().filter_map(joined).collect())
}

/// Returns the masses and friction values that the task declares unknown.
pub fn numbers(trace: &Trace) -> Vec<Believed> {
    let unknown = trace.task.unknown;
    let truth = trace.truth.as_ref().map(|truth| Physics::stated(&truth.scene));
    let mut found = Vec::new();
    let mut add = |name: String,
                   unit,
                   of: &dyn Fn(&Numbers) -> Option<[f64; 2]>,
                   real: &dyn Fn(&Physics) -> Option<f64>| {
        let all = std::iter::once(&trace.prior_numbers)
            .chain(trace.steps.iter().map(|step| &step.numbers));
        let values = all.filter_map(|numbers| Some(of(numbers)?.map(thousandths)));
        let really = truth.as_ref().and_then(real).map(thousandths);
        found.push(Believed { name, unit, values: values.collect(), really });
    };
    for (k, object) in trace.task.scene.things() {
        if unknown.masses {
            let of = |numbers: &Numbers| numbers.masses.get(k).copied();
            let real = |truth: &Physics| Some(trace.task.scene.mass_in(truth, k));
            add(format!("mass of {}", object.name), " kg", &of, &real);
        }
        if unknown.frictions {
            let of = |numbers: &Numbers| numbers.frictions.get(k).copied();
            let real = |truth: &Physics| truth.frictions.get(k).copied();
            add(format!("friction value of {}", object.name), "", &of, &real);
        }
    }
    if unknown.frictions {
        let of = |numbers: &Numbers| Some(numbers.table_friction);
        add("friction value of the table".to_owned(), "", &of, &|truth| Some(truth.table_friction));
    }
    found
}

/// Returns the belief about the objects called `names` over time: observation counts, names of the
/// joint types, and the type probabilities of every pair. `before` holds the initial probabilities.
/// Observations without a change are left out.
pub fn over_time(
    belief: &Belief,
    before: &[[f64; 4]],
    names: &[&str],
) -> (Vec<usize>, Vec<String>, Vec<Joined>) {
    let rounded = |pairs: &[[f64; 4]]| -> Vec<[i64; 4]> {
        pairs.iter().map(|shares| shares.map(thousandths)).collect()
    };
    let mut steps = vec![(0, rounded(before))];
    for step in belief.history() {
        let shares = rounded(&step.probabilities);
        if steps.last().is_none_or(|(_, last)| *last != shares) {
            steps.push((step.observations, shares));
        }
    }
    let joined = |(p, [a, b]): (usize, [usize; 2])| Joined {
        name: format!("{} and {}", names[a], names[b]),
        shares: steps.iter().map(|(_, pairs)| pairs[p]).collect(),
        really: None,
    };
    let types = JointType::ALL.iter().map(ToString::to_string).collect();
    let pairs = belief.pairs().enumerate().map(joined).collect();
    (steps.iter().map(|(observations, _)| *observations).collect(), types, pairs)
}

fn thousandths(value: f64) -> i64 {
    (1e3 * value).round() as i64
}
