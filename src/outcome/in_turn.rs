//! Rollouts of job sequences.

use crate::task::Job;

use super::{Record, Trajectory};

/// Rolls out non-empty sequences of jobs with `run` and returns one trajectory for each sequence.
/// Each job starts from the final state of the previous one.
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
