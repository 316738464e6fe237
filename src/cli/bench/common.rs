//! What every benchmark takes, and how its numbers are shown.

use std::path::Path;
use std::sync::Arc;

use clap::Args;
use serde::Serialize;
use serde_json::json;

use crate::asset::SCHEMA_VERSION;
use crate::cli::{
    action::LibraryArgs,
    error::CliError,
    model::{self, OutsideArgs},
    session::Session,
};
use crate::effect::EffectModel;
use crate::report::{Document, Table};
use crate::scene::{ModelKind, ModelSpec};
use crate::solve::Effort;

use super::keep::write_report;

/// What every benchmark takes.
#[derive(Args, Debug)]
pub struct Common {
    #[arg(long, value_name = "MODEL", help = model::HELP_WITH_EFFORT)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    pub outside: OutsideArgs,
    #[command(flatten)]
    pub library: LibraryArgs,
    #[command(flatten)]
    pub form: Form,
}

impl Common {
    /// The model that is asked for, or else that of the effort.
    pub fn spec(&self, effort: Effort) -> ModelSpec {
        self.model.clone().unwrap_or_else(|| effort.spec())
    }

    /// The model that is asked for, or else the network, used only where it can be trusted.
    ///
    /// # Errors
    /// Those of [`model::load`].
    pub fn load_model(&self) -> Result<Arc<dyn EffectModel>, CliError> {
        self.outside.load(&self.model_or_network())
    }

    /// The model that is asked for, or else the network: where there is no effort.
    pub fn model_or_network(&self) -> ModelSpec {
        self.model.clone().unwrap_or(ModelKind::NETWORK.into())
    }
}

/// How numbers are printed.
#[derive(Args, Debug)]
pub struct Form {
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Print Markdown tables
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
}

impl Form {
    /// Prints a report, and writes its page and rows into a folder, if one is given.
    ///
    /// # Errors
    /// If that cannot be written.
    pub fn show(
        &self,
        session: &Session,
        document: &Document,
        out: Option<&Path>,
    ) -> Result<(), CliError> {
        if let Some(out) = out {
            write_report(out, document)?;
        }
        if self.json {
            let mut report = document.json.clone();
            report["schema_version"] = json!(SCHEMA_VERSION);
            return session.print(&format!("{report:#}\n"));
        }
        session.print(&if self.markdown { document.to_markdown() } else { document.to_text() })
    }

    /// Prints tables behind a head, or `report` under its name.
    pub fn print(
        &self,
        session: &Session,
        name: &str,
        report: &impl Serialize,
        head: &str,
        tables: &[Table],
    ) -> Result<(), CliError> {
        if self.json {
            let report = json!({"schema_version": SCHEMA_VERSION, name: report});
            return session.print(&format!("{report:#}\n"));
        }
        let show = |table: &Table| {
            if self.markdown { table.to_markdown() } else { table.to_text() }
        };
        let tables: Vec<String> = tables.iter().map(show).collect();
        session.print(&format!("{head}{}", tables.join("\n")))
    }
}
