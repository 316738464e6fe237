//! One frame of many rollouts side by side: solved, corrected by the network, applied.

use crate::{
    contact::{Frame, FrameProblem, FrameSolver, ListIndex, Motion, Tally, Touch},
    graph::{Batch, Correction},
    outcome::Spread,
};

/// Corrects the prior of every node of a batch: fills the vector with one entry per node.
pub type Corrector<'a> = dyn FnMut(&Batch, &mut Vec<Correction>) + 'a;

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
    /// What the frame adds to the error that is expected at the end, of corrected objects.
    pub doubts: &'a [(ListIndex, Spread)],
}

/// Steps many walks by a frame at a time, on memory that it keeps from one step to the next.
#[derive(Clone, Debug)]
pub struct Stepper {
    most: usize,
    solver: FrameSolver,
    batch: Batch,
    corrections: Vec<Correction>,
    /// Of every walk.
    frames: Vec<Frame>,
    steps: Vec<Step>,
}

/// What a walk does in a frame.
#[derive(Clone, Debug, Default)]
struct Step {
    /// Whether it has one.
    walking: bool,
    motions: Vec<Motion>,
    touches: Vec<Touch>,
    doubts: Vec<(ListIndex, Spread)>,
    awake: usize,
    relations: usize,
}

impl Stepper {
    /// A stepper that corrects frames in which at most `most` objects are awake.
    pub fn correcting(most: usize) -> Self {
        Self {
            most,
            solver: FrameSolver::default(),
            batch: Batch::default(),
            corrections: Vec::new(),
            frames: Vec::new(),
            steps: Vec::new(),
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
        correct: Option<&mut (impl FnMut(&Batch, &mut Vec<Correction>) + ?Sized)>,
    ) -> bool {
        let Self { most, solver, batch, corrections, frames, steps } = self;
        batch.clear();
        if steps.len() < walks.len() {
            frames.resize_with(walks.len(), Frame::default);
            steps.resize_with(walks.len(), Step::default);
        }
        let problems: Vec<_> = walks.iter_mut().map(W::next).collect();
        solver.begin(&problems, frames);
        let most = if correct.is_some() { *most } else { 0 };
        let all = problems.iter().zip(frames).zip(&mut *steps);
        for (graph, ((problem, frame), step)) in all.enumerate() {
            step.walking = problem.is_some();
            let Some(problem) = *problem else { continue };
            let relations = batch.relation_count();
            let (frame, forces) = solver.finish(problem, frame, most);
            // It has not learnt of joints to the world.
            let learnt = correct.is_some() && frame.bodies.mounts.is_empty();
            if let Some(forces) = forces.filter(|_| learnt) {
                batch.add(graph as u32, &frame, &forces);
            }
            frame.fill(&mut step.motions);
            step.touches.clear();
            step.doubts.clear();
            step.touches.extend(frame.touches());
            step.awake = frame.motions.len();
            step.relations = batch.relation_count() - relations;
        }
        if problems.iter().all(Option::is_none) {
            return false;
        }
        if let Some(correct) = correct {
            correct(batch, corrections);
            apply(batch, corrections, steps);
        }
        for (walk, step) in walks.iter_mut().zip(steps).filter(|(_, step)| step.walking) {
            let Step { awake, relations, ref touches, ref doubts, .. } = *step;
            walk.note(Found { awake, relations, touches, doubts });
            walk.advance(&step.motions);
        }
        true
    }
}

/// Puts the corrected motion of every node in its graph's list.
fn apply(batch: &Batch, corrections: &[Correction], steps: &mut [Step]) {
    for (node, correction) in batch.nodes.iter().zip(corrections) {
        let mut output = node.prior;
        for (value, change) in output.iter_mut().zip(&correction.output) {
            *value += change;
        }
        let step = &mut steps[node.graph as usize];
        step.motions[node.object.0] = node.decode(&output);
        step.doubts.extend(correction.doubt.map(|doubt| (node.object, node.decode_doubt(doubt))));
    }
}
