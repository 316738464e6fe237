//! One frame of many rollouts side by side: solved, corrected by the network, applied.

use crate::{
    contact::{FrameProblem, FrameSolver, Motion, Tally, Touch},
    graph::Batch,
};

/// Corrects the prior of every node of a batch: fills the vector with one entry per node, in
/// output units (see [`crate::graph::Node::encode`]).
pub type Corrector<'a> = dyn FnMut(&Batch, &mut Vec<[f64; 6]>) + 'a;

/// What goes on frame by frame.
pub trait Walk {
    /// The frame to compute now; `None` when there is none any more.
    fn next(&mut self) -> Option<FrameProblem<'_>>;

    /// Takes note of what the equations of the frame found, before anything moves.
    fn note(&mut self, _found: Found<'_>) {}

    /// Goes on by the frame, every object by its one of `motions`.
    fn advance(&mut self, motions: &[Motion]);
}

/// What the equations of a frame found.
#[derive(Clone, Copy, Debug)]
pub struct Found<'a> {
    /// How many objects are awake.
    pub awake: usize,
    /// Relations of the frame's graph; none where nothing corrects the prior.
    pub relations: usize,
    /// What touches, or comes to.
    pub touches: &'a [Touch],
}

/// Steps many walks by a frame at a time, on memory that it keeps from one step to the next.
#[derive(Clone, Debug)]
pub struct Stepper {
    most: usize,
    solver: FrameSolver,
    batch: Batch,
    corrections: Vec<[f64; 6]>,
    touches: Vec<Touch>,
    /// Of every walk.
    motions: Vec<Vec<Motion>>,
    walking: Vec<bool>,
}

impl Stepper {
    /// A stepper that corrects frames in which at most `most` objects are awake.
    pub fn correcting(most: usize) -> Self {
        Self {
            most,
            solver: FrameSolver::default(),
            batch: Batch::default(),
            corrections: Vec::new(),
            touches: Vec::new(),
            motions: Vec::new(),
            walking: Vec::new(),
        }
    }

    /// What the equations of all frames so far took.
    pub fn tally(&self) -> Tally {
        self.solver.tally()
    }

    /// Takes every walk that has a frame left on by that frame, all graphs in one batch; returns
    /// whether any had.
    ///
    /// Walks do not influence each other; they only share the network's batch. Without anything
    /// to `correct` the prior no graphs are built.
    pub fn step<W: Walk>(
        &mut self,
        walks: &mut [W],
        correct: Option<&mut (impl FnMut(&Batch, &mut Vec<[f64; 6]>) + ?Sized)>,
    ) -> bool {
        let Self { most, solver, batch, corrections, touches, motions, walking } = self;
        batch.clear();
        walking.clear();
        if motions.len() < walks.len() {
            motions.resize_with(walks.len(), Vec::new);
        }
        for ((graph, walk), motions) in walks.iter_mut().enumerate().zip(&mut *motions) {
            let Some(problem) = walk.next() else {
                walking.push(false);
                continue;
            };
            walking.push(true);
            let relations = batch.relation_count();
            let frame = if correct.is_some() {
                let (frame, forces) = solver.solve_with_forces_of_few(problem, *most);
                if let Some(forces) = forces {
                    batch.add(graph as u32, &frame, &forces);
                }
                frame
            } else {
                solver.solve(problem)
            };
            frame.fill(motions);
            touches.clear();
            touches.extend(frame.touches());
            let awake = frame.motions.len();
            let relations = batch.relation_count() - relations;
            walk.note(Found { awake, relations, touches });
        }
        if !walking.contains(&true) {
            return false;
        }
        if let Some(correct) = correct {
            correct(batch, corrections);
            apply(batch, corrections, motions);
        }
        let walks = walks.iter_mut().zip(motions).zip(walking);
        for ((walk, motions), _) in walks.filter(|(_, walking)| **walking) {
            walk.advance(motions);
        }
        true
    }
}

/// Puts the corrected motion of every node in its graph's list.
fn apply(batch: &Batch, corrections: &[[f64; 6]], motions: &mut [Vec<Motion>]) {
    for (node, correction) in batch.nodes.iter().zip(corrections) {
        let mut output = node.prior;
        for (value, change) in output.iter_mut().zip(correction) {
            *value += change;
        }
        motions[node.graph as usize][node.object.0] = node.decode(&output);
    }
}
