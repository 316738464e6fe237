//! Drawn pushes and trajectories, measured part by part: stored, resumed and split into shards.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::progress::NoProgress;
use pushplan_bench::store::{Measured, RunManifest, Seconds, Shard, Store};
use pushplan_command::bench::{tools_digest, weights_digest};
use pushplan_command::error::CliError;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;
use serde_json::json;

use crate::bench::{
    CrowdReport, CrowdSet, Evaluated, HeldOut, HeldOutReport, SuiteKind, by_kind, push_baselines,
};
use crate::cli::evaluate::command::EvaluateArgs;
use crate::cli::evaluate::crowds::Crowds;
use crate::report::heldout_document;
use crate::trivial;

/// Name of the suite in manifests.
pub const SUITE: &str = "evaluation";

/// Pushes of a kind, or trajectories of a set.
enum Part<'a> {
    Tools(SuiteKind),
    Crowd(&'a CrowdSet),
}

/// An evaluation on drawn pushes and trajectories.
pub struct Parts<'a> {
    pub args: &'a EvaluateArgs,
    pub kinds: &'a [SuiteKind],
    pub crowds: &'a Crowds<'a>,
}

impl Parts<'_> {
    /// Measures the remaining parts of this shard. Each table is printed, and the folder's files
    /// are written, as soon as its part is done.
    ///
    /// # Errors
    /// Returns an error if a model cannot be read, or the folder has other content or cannot be
    /// written.
    pub fn run(
        &self,
        session: &Session,
    ) -> Result<(Vec<HeldOutReport>, Vec<CrowdReport>), CliError> {
        let kinds = self.kinds.iter().map(|kind| Part::Tools(*kind));
        let parts: Vec<Part> = kinds.chain(self.crowds.sets.iter().map(Part::Crowd)).collect();
        if parts.is_empty() {
            return Ok((Vec::new(), Vec::new()));
        }
        let manifest = self.manifest(&parts)?.with_shard(self.args.shard.unwrap_or(Shard::WHOLE));
        let following = TerminalProgress::bar(session, "parts");
        let mut store: Store<Evaluated> = match &self.args.crowd.out {
            Some(folder) => Store::open(folder, manifest, &following)?,
            None => Store::in_memory(manifest),
        };
        following.finish()?;
        let mut shown = Vec::new();
        for part in store.finished() {
            self.show(&mut shown, part.record.clone(), session)?;
        }
        store.run::<CliError>(&NoProgress, |index| {
            let record = match &parts[index] {
                Part::Tools(kind) => Evaluated::Tools(self.tools(*kind, session)?),
                Part::Crowd(set) => Evaluated::Crowd(self.crowds.set(set, session)?),
            };
            self.show(&mut shown, record.clone(), session)?;
            Ok(Measured { record, seconds: Seconds::new() })
        })?;
        Ok(by_kind(store.finished().iter().map(|part| &part.record)))
    }

    /// Returns the settings that determine the records.
    fn manifest(&self, parts: &[Part]) -> Result<RunManifest, CliError> {
        let EvaluateArgs { pushes, seed, crowd, out_of_range, library, .. } = self.args;
        let library = library.load()?;
        let titles = parts.iter().map(|part| match part {
            Part::Tools(kind) => kind.title().to_owned(),
            Part::Crowd(set) => set.title(),
        });
        let mut settings = json!({
            "parts": titles.collect::<Vec<_>>(),
            "pushes": pushes,
            "trajectories": crowd.count,
            "baselines": !crowd.no_baselines,
            "tools": tools_digest(library.iter())?,
        });
        out_of_range.note(&mut settings);
        let spec = self.crowds.model;
        Ok(RunManifest::new(SUITE, parts.len(), *seed, &spec.to_string())
            .with_weights(weights_digest(spec)?)
            .with_settings(settings))
    }

    /// Returns the errors on pushes of the shipped tools.
    fn tools(&self, kind: SuiteKind, session: &Session) -> Result<HeldOutReport, CliError> {
        let (args, spec) = (self.args, self.crowds.model);
        let library = args.library.load()?;
        let mut models: Vec<Box<dyn EffectModel>> = vec![self.crowds.load(spec)?];
        for other in push_baselines(spec) {
            models.push(Box::new(trivial::load(&other)?));
        }
        let spinner = session.spinner(kind.title());
        let report = session.compute(|| {
            spinner.set_message("simulating");
            let truth = HeldOut::prepare(kind, &library, args.seed, args.pushes as usize);
            spinner.set_message("predicting");
            let models: Vec<&dyn EffectModel> = models.iter().map(|model| &**model).collect();
            truth.report(&models)
        });
        spinner.finish_and_clear();
        Ok(report)
    }

    /// Prints the table of a part and writes the folder's files, including the parts `shown`
    /// before.
    fn show(
        &self,
        shown: &mut Vec<Evaluated>,
        part: Evaluated,
        session: &Session,
    ) -> Result<(), CliError> {
        shown.push(part);
        let (tools, crowds) = by_kind(&*shown);
        match (shown.last(), tools.last()) {
            (Some(Evaluated::Tools(_)), Some(newest)) => {
                self.args.form.show_part(session, &heldout_document(newest))?;
            }
            _ => self.crowds.show_part(&crowds, session)?,
        }
        self.crowds.write(&tools, &crowds)
    }
}
