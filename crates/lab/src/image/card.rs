//! Metadata of the weights of a network with image input.

use pushplan::internals::network::{
    Card, LEVER_POSE, Layout, LeverCard, LeverSizes, Parameters, Weights, WeightsError,
    check_widths, fresh_lever_values, lever_layout,
};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::{ImageFeatures, ImageSizes, fresh_bound, image_layout};

/// Length of the code that describes an image.
pub const CODE: usize = 32;

/// The weights of a network that sees images.
pub type ImageWeights = Weights<ImageCard>;

/// Metadata of the weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageCard {
    /// Images that the network sees.
    pub features: ImageFeatures,
    /// Extents of the image.
    pub image: ImageSizes,
    /// Metadata of the recurrent memory, which has no features of the shape.
    pub memory: LeverCard,
}

impl Card for ImageCard {
    const KEY: &'static str = "pushplan-lever-image";
    const FORMAT: u32 = 1;

    fn check(&self) -> Result<(), WeightsError> {
        self.memory.check()?;
        let ImageSizes { rows, columns, code } = self.image;
        check_widths(code, &[rows, columns])?;
        if rows.max(columns) > ImageSizes::MOST {
            return Err(WeightsError::Size { width: self.memory.sizes.width, steps: 1 });
        }
        Ok(())
    }

    fn layout(&self) -> Layout {
        layout(&self.memory.sizes, &self.image)
    }
}

/// Returns names and shapes of all parameters: of the memory, of the convolutions, and from the
/// code to the gates.
fn layout(sizes: &LeverSizes, image: &ImageSizes) -> Layout {
    let mut layout = lever_layout(&LeverSizes { feedback: false, ..*sizes });
    layout.extend(image_layout(image));
    layout.push(("gates.image", vec![image.code, 4 * sizes.width]));
    if sizes.feedback {
        layout.push(("gates.pose", vec![LEVER_POSE, 4 * sizes.width]));
    }
    layout
}

/// Returns random initial values from `seed`, as
/// [`fresh_lever`](pushplan::internals::network::fresh_lever) does; biases are zero.
pub fn fresh_image(sizes: &LeverSizes, image: &ImageSizes, seed: u64) -> Parameters {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut values = |(name, shape): (&'static str, Vec<usize>)| {
        let values = if name.starts_with("image") && shape.len() > 1 {
            let bound = fresh_bound(name, &shape);
            let count = shape.iter().product();
            (0..count).map(|_| random.random_range(-bound..bound)).collect()
        } else {
            fresh_lever_values(name, &shape, sizes.width, &mut random)
        };
        (name.to_owned(), values)
    };
    Parameters { values: layout(sizes, image).into_iter().map(&mut values).collect() }
}
