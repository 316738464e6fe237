//! What codes images without knowing of levers: an autoencoder, trained before the network itself.

use std::fs;
use std::path::Path;

use pushplan::internals::asset::write_atomic;
use pushplan::internals::network::{ImageSizes, Parameters};
use pushplan::internals::watch::Watch;

use crate::network::{Autoencoder, fresh_autoencoder};
use crate::train::gradients::gradients_of;
use crate::train::{AdamW, TrainError};

use super::batch::{Example, images};
use super::checkpoint::CodeCheckpoint;
use super::replicas::gradients;
use super::settings::LeverSettings;

/// Images are drawn under another seed than lever-ups.
const IMAGES: u64 = 0x494d_4147;

/// Parameters with the code of an autoencoder of the images of `examples`, trained for as many steps as
/// the network itself; goes on from its own checkpoint in `folder`. `None` if `watch` said to stop.
pub(super) fn code(
    settings: &LeverSettings,
    sizes: &ImageSizes,
    examples: &[Example],
    folder: &Path,
    watch: &dyn Watch,
) -> Result<Option<Parameters>, TrainError> {
    let path = folder.join("code.safetensors");
    let mut run = open(settings, sizes, &path)?;
    let steps = settings.descent.steps;
    let (mut count, mut losses) = (0.0, 0.0);
    while run.optimiser.step < steps {
        let step = run.optimiser.step;
        if step.is_multiple_of(super::trainer::LOOK) && watch.cancelled() {
            save(&run, &path)?;
            return Ok(None);
        }
        let weights = &run.optimiser.weights;
        let draw = (settings.seed ^ IMAGES, step);
        let (loss, gradient) = gradients(draw, examples, settings.batch, |part| {
            let network = Autoencoder::new(sizes, weights)?;
            let seen = images(part, sizes)?;
            let x = network.forward(&seen)?;
            let wanted = seen.reshape(x.shape())?;
            // The cross entropy of every pixel: log(1 + exp x) - x y, without overflow.
            let soft = (x.relu()? + (x.abs()?.neg()?.exp()? + 1.0)?.log()?)?;
            gradients_of(&(soft - (x * wanted)?)?.mean_all()?, network.variables())
        })?;
        let norm = run.optimiser.update(&settings.descent, &gradient);
        if !loss.is_finite() || !norm.is_finite() {
            return Err(TrainError::NotFinite(step));
        }
        (count, losses) = (count + 1.0, losses + loss);
        let step = run.optimiser.step;
        watch.progress(step, steps);
        if step.is_multiple_of(settings.evaluate_every) || step == steps {
            save(&run, &path)?;
            watch.line(&format!("autoencoder, step {step:>6}  loss {:.4}", losses / count));
            (count, losses) = (0.0, 0.0);
        }
    }
    Ok(Some(run.optimiser.average))
}

/// Starts from scratch, or from the checkpoint at `path`.
fn open(
    settings: &LeverSettings,
    sizes: &ImageSizes,
    path: &Path,
) -> Result<CodeCheckpoint, TrainError> {
    match fs::read(path) {
        Ok(bytes) => CodeCheckpoint::from_bytes(&bytes, settings)
            .map_err(|error| TrainError::Checkpoint(path.to_owned(), error)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(CodeCheckpoint {
            settings: settings.clone(),
            optimiser: AdamW::new(fresh_autoencoder(sizes, settings.seed)),
        }),
        Err(error) => Err(TrainError::File(path.to_owned(), error)),
    }
}

fn save(run: &CodeCheckpoint, path: &Path) -> Result<(), TrainError> {
    let bytes = run.to_bytes().map_err(|e| TrainError::Checkpoint(path.to_owned(), e))?;
    Ok(write_atomic(path, &bytes)?)
}
