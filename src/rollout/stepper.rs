//! A frame of many rollouts side by side: solution, correction by the network, integration.

use crate::{
    contact::{Frame, FrameProblem, FrameSolver, ListIndex, Motion, SolverStats, Touch},
    graph::{Batch, Correction},
    outcome::Spread,
};

/// A correction of every node of a batch: fills the vector with one entry per node.
pub type Corrector<'a> = dyn FnMut(&Batch, &mut Vec<Correction>) + 'a;

/// A simulation that advances frame by frame.
pub trait Walk {
    /// Returns the next frame to compute; `None` at the end.
    fn next(&mut self) -> Option<FrameProblem<'_>>;

    /// Receives the solution of the frame's equations before anything moves.
    fn note(&mut self, _found: Found<'_>) {}

    /// Advances by the frame; `motions` has one entry for every object.
    fn advance(&mut self, motions: &[Motion]);
}

/// Solution of the equations of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Found<'a> {
    /// Number of awake objects.
    pub awake: usize,
    /// Number of relations of the frame's graph; zero without correction.
    pub relations: usize,
    /// Contacts that are closed or close in the frame.
    pub touches: &'a [Touch],
    /// Contributions of the frame to the expected final error, for corrected objects.
    pub doubts: &'a [(ListIndex, Spread)],
}

/// Advances many walks by one frame at a time, on memory that it keeps from one step to the next.
#[derive(Clone, Debug)]
pub struct Stepper {
    most: usize,
    solver: FrameSolver,
    batch: Batch,
    corrections: Vec<Correction>,
    /// Frame of every walk.
    frames: Vec<Frame>,
    steps: Vec<Step>,
}

/// The step of a walk in a frame.
#[derive(Clone, Debug, Default)]
struct Step {
    /// Whether the walk has a frame.
    walking: bool,
    motions: Vec<Motion>,
    touches: Vec<Touch>,
    doubts: Vec<(ListIndex, Spread)>,
    awake: usize,
    relations: usize,
}

impl Stepper {
    /// Creates a stepper that corrects frames with at most `most` awake objects.
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

    /// Returns the solver statistics of all frames so far.
    pub fn tally(&self) -> SolverStats {
        self.solver.tally()
    }

    /// Advances every walk that has a frame left, with all graphs in one batch. Returns `true` if
    /// any walk had a frame.
    ///
    /// Walks do not influence each other; they only share the network's batch. Without `correct` no
    /// graphs are built.
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
            // The network was not trained with joints to the world.
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

/// Writes the corrected motion of every node into the list of its graph.
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
