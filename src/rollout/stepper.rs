//! A frame of many rollouts side by side: solution, graph, integration.

use std::ops::Range;

use crate::{
    contact::{Frame, FrameProblem, FrameSolver, Motion, SolverStats, Touch},
    graph::{Batch, Corrections, Node},
};

/// A correction of every node of a batch.
pub type Corrector<'a> = dyn FnMut(&Batch, &mut Corrections) + 'a;

/// A simulation that advances frame by frame.
pub trait Walk {
    /// Returns the next frame to compute, and whether the network may read it; `None` at the end.
    fn next(&mut self) -> Option<(FrameProblem<'_>, bool)>;

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
    /// Number of relations of the frame's graph; zero for a frame that is not read.
    pub relations: usize,
    /// Nodes of the frame's graph; none for a frame that is not read.
    pub nodes: &'a [Node],
    /// Index of the first node in the batch.
    pub first: usize,
    /// Contacts that are closed or close in the frame.
    pub touches: &'a [Touch],
}

/// Advances many walks by one frame at a time, on memory that it keeps from one step to the next.
#[derive(Clone, Debug)]
pub struct Stepper {
    most: usize,
    solver: FrameSolver,
    /// Graphs of all frames read since [`Stepper::begin`].
    batch: Batch,
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
    awake: usize,
    relations: usize,
    nodes: Range<usize>,
}

impl Stepper {
    /// Creates a stepper that reads frames with at most `most` awake objects.
    pub fn reading(most: usize) -> Self {
        Self {
            most,
            solver: FrameSolver::default(),
            batch: Batch::default(),
            frames: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// Returns the solver statistics of all frames so far.
    pub fn tally(&self) -> SolverStats {
        self.solver.tally()
    }

    /// Forgets the graphs read so far.
    pub fn begin(&mut self) {
        self.batch.clear();
    }

    /// Returns the graphs read since [`Stepper::begin`]; the number of a graph is the index of its
    /// walk.
    pub fn batch(&self) -> &Batch {
        &self.batch
    }

    /// Advances every walk that has a frame left. Returns `true` if any walk had a frame.
    ///
    /// Walks do not influence each other. Graphs are built only if `read`.
    pub fn step<W: Walk>(&mut self, walks: &mut [W], read: bool) -> bool {
        let Self { most, solver, batch, frames, steps } = self;
        if steps.len() < walks.len() {
            frames.resize_with(walks.len(), Frame::default);
            steps.resize_with(walks.len(), Step::default);
        }
        let (problems, reads): (Vec<_>, Vec<_>) = walks
            .iter_mut()
            .map(|walk| match walk.next() {
                Some((problem, reads)) => (Some(problem), read && reads),
                None => (None, false),
            })
            .unzip();
        solver.begin(&problems, frames);
        let all = problems.iter().zip(reads).zip(frames).zip(&mut *steps);
        for (graph, (((problem, read), frame), step)) in all.enumerate() {
            step.walking = problem.is_some();
            let Some(problem) = *problem else { continue };
            let (relations, first) = (batch.relation_count(), batch.node_count());
            let (frame, forces) = solver.finish(problem, frame, if read { *most } else { 0 });
            // The network was not trained with joints to the world.
            let known = read && frame.bodies.mounts.is_empty();
            if let Some(forces) = forces.filter(|_| known) {
                batch.add(graph as u32, &frame, &forces);
            }
            frame.fill(&mut step.motions);
            step.touches.clear();
            step.touches.extend(frame.touches());
            step.awake = frame.motions.len();
            step.relations = batch.relation_count() - relations;
            step.nodes = first..batch.node_count();
        }
        if problems.iter().all(Option::is_none) {
            return false;
        }
        for (walk, step) in walks.iter_mut().zip(steps).filter(|(_, step)| step.walking) {
            let Step { awake, relations, ref touches, ref nodes, .. } = *step;
            let (first, nodes) = (nodes.start, &batch.nodes[nodes.clone()]);
            walk.note(Found { awake, relations, nodes, first, touches });
            walk.advance(&step.motions);
        }
        true
    }
}
