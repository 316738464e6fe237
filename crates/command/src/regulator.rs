//! Choice of the belief regulator.

use std::path::Path;

use clap::Args;

use pushplan::plain_file;
use pushplan_act::belief::BeliefRegulator;
use pushplan_act::regulator::RegulatorWeights;
use pushplan_bench::store::digest;
use pushplan_report::Setting;

use super::error::CliError;

/// Name of the option to use no regulator.
const NONE: &str = "none";

/// Belief regulator.
#[derive(Args, Debug)]
pub struct RegulatorArgs {
    /// Weights of the belief regulator, which corrects the hypothesis filter; `none` for the filter
    /// alone [default: the shipped weights]
    #[arg(long, value_name = "FILE")]
    regulator: Option<String>,
}

impl RegulatorArgs {
    /// Returns the regulator as a setting, if it is not the default.
    pub fn setting(&self) -> Option<Setting> {
        let value = self.regulator.clone()?;
        Some(Setting { option: "--regulator", keyword: None, value })
    }

    /// Loads the regulator with a digest of its weights; returns `None` for the filter without a
    /// regulator.
    ///
    /// # Errors
    /// Returns an error if the weights cannot be read.
    pub fn load(&self) -> Result<Option<(BeliefRegulator, String)>, CliError> {
        let weights = match self.regulator.as_deref() {
            Some(NONE) => return Ok(None),
            Some(path) => plain_file::read(Path::new(path))
                .map_err(Into::into)
                .and_then(|bytes| RegulatorWeights::from_bytes(&bytes))
                .map_err(|error| CliError::File(format!("{path}: {error}")))?,
            None => BeliefRegulator::shipped_weights()
                .map_err(|error| CliError::unexpected("cannot read the shipped weights", &error))?,
        };
        let file = |error: &dyn std::error::Error| CliError::File(error.to_string());
        let bytes = weights.to_bytes().map_err(|error| file(&error))?;
        let regulator =
            BeliefRegulator::on_shipped_network(&weights).map_err(|error| file(&error))?;
        Ok(Some((regulator, digest(&bytes))))
    }
}
