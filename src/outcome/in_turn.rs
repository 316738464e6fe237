//! Rollouts of several jobs one after another.

use crate::task::Job;

use super::{Record, Trajectory};

/// Rolls out sequences of jobs, none of them empty, with `run`, as one trajectory each: of every sequence a job begins as the one
/// before has left everything.
pub fn in_turn(
    sequences: &[Vec<Job>],
    record: Record,
    mut run: impl FnMut(&[Job]) -> Vec<Trajectory>,
) -> Vec<Trajectory> {
    let longest = sequences.iter().map(Vec::len).max().unwrap_or(0);
    let mut made: Vec<Option<Trajectory>> = vec![None; sequences.len()];
    for turn in 0..longest {
        let (indices, jobs): (Vec<usize>, Vec<Job>) = (0..sequences.len())
            .filter_map(|k| {
                let job = sequences[k].get(turn)?.clone();
                let start = made[k].as_ref().map(|before| before.outcome().clone());
                Some((k, Job { start: start.unwrap_or(job.start), ..job }))
            })
            .unzip();
        for (k, next) in indices.into_iter().zip(run(&jobs)) {
            made[k] = Some(match made[k].take() {
                None => next,
                Some(before) => {
                    let strokes = |job: &Job| job.motion.slide().strokes.len();
                    before.then(next, record, sequences[k][..turn].iter().map(strokes).sum())
                }
            });
        }
    }
    made.into_iter().flatten().collect()
}
