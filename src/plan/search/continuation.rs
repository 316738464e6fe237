//! Nodes of the next level of a search.

use crate::outcome::Record;
use crate::plan::Rollouts;
use crate::plan::beam::{Stop, choose};
use crate::plan::enumerate::Extension;
use crate::plan::node::Node;
use crate::plan::uncertainty::room;
use crate::scene::State;
use crate::task::{Job, Push};

use super::Search;

impl Search<'_> {
    /// Returns the nodes of the next level: the chosen stops, rolled out exactly if they are early.
    pub(super) fn continue_from(
        &self,
        rollouts: &mut Rollouts,
        list: &[Extension],
        offers: Vec<Stop>,
    ) -> Vec<Node> {
        // A tree of chained pushes is small and its branches share their beginnings. It is kept
        // whole while the budget allows.
        let ways = self.workspace.task.pushes.directions.headings().len();
        let whole = !self.workspace.is_placed() && offers.len() * ways <= self.settings.rollouts;
        let chosen = choose(offers, if whole { None } else { Some(self.settings.beam) });
        let shorter = |stop: &Stop| Extension {
            push: Push { length: stop.length, ..list[stop.extension].push },
            ..list[stop.extension].clone()
        };
        let jobs: Vec<_> = chosen
            .iter()
            .filter(|stop| stop.known.is_none())
            .map(|stop| self.job(&shorter(stop)))
            .collect();
        let mut outcomes = rollouts.run(&jobs, Record::Outcome).into_iter();
        let mut nodes = Vec::with_capacity(chosen.len());
        for stop in chosen {
            let extension = shorter(&stop);
            let state = match stop.known {
                Some(state) => Some(state),
                None => outcomes
                    .next()
                    .and_then(|trajectory| trajectory.frames.into_iter().next_back())
                    .map(|frame| frame.state),
            };
            if let Some(state) = state.filter(State::is_finite) {
                nodes.push((
                    extension.clone(),
                    Node {
                        candidate: Some(self.candidate(&extension, stop.length)),
                        state,
                        end: Some(extension.push.end()),
                        others: Vec::new(),
                        room: 0.0,
                    },
                ));
            }
        }
        self.with_room(rollouts, nodes)
    }

    /// Returns the nodes, each with the object's position uncertainty after its extension.
    fn with_room(&self, rollouts: &mut Rollouts, nodes: Vec<(Extension, Node)>) -> Vec<Node> {
        // A chained push starts at the end of the previous one, wherever the object is.
        if !self.workspace.is_placed() {
            return nodes.into_iter().map(|(_, node)| node).collect();
        }
        let jobs: Vec<Job> = nodes
            .iter()
            .flat_map(|(extension, _)| {
                let others = &self.nodes[extension.node].others;
                self.spread.jobs(&self.motion(extension), others)
            })
            .collect();
        let mut ends = rollouts.run(&jobs, Record::Outcome).into_iter();
        let scene = &self.situation.scene;
        let finish = |(extension, mut node): (Extension, Node)| {
            let count = self.nodes[extension.node].others.len();
            node.others = ends.by_ref().take(count).map(|end| end.outcome().clone()).collect();
            let error = self.settings.model_error;
            let movers = self.field.movers(&node.state).into_iter();
            let rooms = movers.map(|k| room(scene, k, &node.state, &node.others, error));
            node.room = rooms.fold(0.0, f64::max);
            node
        };
        nodes.into_iter().map(finish).collect()
    }
}
