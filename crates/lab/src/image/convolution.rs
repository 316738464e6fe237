//! Compression of images into a few numbers: convolutions and a dense layer.
//!
//! ```text
//! x_{l+1} = relu(patches(x_l) W_l + b_l)      code = tanh(x_L W + b)
//! ```
//!
//! Every convolution halves rows and columns until both are at most four. An image is [rows,
//! columns, channels]. `patches` has a row for every second pixel of every second row: all channels
//! of the 3 x 3 pixels around it, zero beyond the image.

use pushplan::internals::network::{Layout, Parameters, matrix_product};
use serde::{Deserialize, Serialize};

/// Largest side of an image that is not halved further.
const SMALL: usize = 4;

/// Side of a patch, pixels.
const SIDE: usize = 3;

/// Channels of convolutions, from the last one backwards.
const CHANNELS: [usize; 4] = [32, 32, 16, 8];

/// Names of weights and biases of convolutions, from the first one on.
const NAMES: [[&str; 2]; 4] = [
    ["image.first", "image.first_bias"],
    ["image.second", "image.second_bias"],
    ["image.third", "image.third_bias"],
    ["image.fourth", "image.fourth_bias"],
];

/// Extents of an image of one channel, and the length of its code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ImageSizes {
    /// Rows, at most 64.
    pub rows: usize,
    /// Columns, at most 64.
    pub columns: usize,
    /// Length of the code.
    pub code: usize,
}

/// A convolution and the extents of its input.
#[derive(Clone, Copy, Debug)]
pub struct Convolution {
    /// Names of its weights and its bias.
    pub names: [&'static str; 2],
    /// Rows of its input.
    pub rows: usize,
    /// Columns of its input.
    pub columns: usize,
    /// Channels of its input.
    pub channels: usize,
    /// Channels of its output.
    pub made: usize,
}

impl ImageSizes {
    /// Maximum number of rows and of columns.
    pub const MOST: usize = SMALL << NAMES.len();

    /// Returns the convolutions of an image, from the first one on.
    pub fn convolutions(&self) -> Vec<Convolution> {
        let (mut rows, mut columns) = (self.rows, self.columns);
        let mut sides = Vec::new();
        while rows.max(columns) > SMALL {
            sides.push((rows, columns));
            (rows, columns) = (rows.div_ceil(2), columns.div_ceil(2));
        }
        let count = sides.len();
        let made = |layer: usize| CHANNELS[count - 1 - layer];
        let convolution = |(layer, (rows, columns))| Convolution {
            names: NAMES[layer],
            rows,
            columns,
            channels: if layer == 0 { 1 } else { made(layer - 1) },
            made: made(layer),
        };
        sides.into_iter().enumerate().map(convolution).collect()
    }
}

impl Convolution {
    /// Returns rows and columns of its output.
    pub fn halved(&self) -> [usize; 2] {
        [self.rows.div_ceil(2), self.columns.div_ceil(2)]
    }

    /// Returns the length of a patch.
    pub fn patch(&self) -> usize {
        SIDE * SIDE * self.channels
    }

    /// Returns the patches of `x`, images side by side.
    pub fn patches(&self, x: &[f32]) -> Vec<f32> {
        let [rows, columns] = self.halved();
        let count = x.len() / (self.rows * self.columns * self.channels);
        let mut patches = vec![0.0; count * rows * columns * self.patch()];
        self.pairs(count, |inside, patch, length| {
            patches[patch..][..length].copy_from_slice(&x[inside..][..length]);
        });
        patches
    }

    /// Returns the gradient with respect to the images, given the gradient with respect to their
    /// patches.
    pub fn patches_gradient(&self, of_patches: &[f32]) -> Vec<f32> {
        let [rows, columns] = self.halved();
        let count = of_patches.len() / (rows * columns * self.patch());
        let mut of_x = vec![0.0; count * self.rows * self.columns * self.channels];
        self.pairs(count, |inside, patch, length| {
            let gradients = &of_patches[patch..][..length];
            of_x[inside..][..length].iter_mut().zip(gradients).for_each(|(x, g)| *x += g);
        });
        of_x
    }

    /// Calls `with` for every run of numbers that image and patches share: its positions in both,
    /// and its length.
    #[inline(always)]
    fn pairs(&self, count: usize, mut with: impl FnMut(usize, usize, usize)) {
        let [rows, columns] = self.halved();
        let row_of_patch = SIDE * self.channels;
        for image in 0..count {
            for row in 0..rows {
                for column in 0..columns {
                    let patch = ((image * rows + row) * columns + column) * self.patch();
                    // The pixels of a row are adjacent; those beyond the image are left out.
                    let first = (2 * column).saturating_sub(1);
                    let beyond = (2 * column + 2).min(self.columns);
                    let skipped = first + 1 - 2 * column;
                    for side in 0..SIDE {
                        let Some(from) = (2 * row + side).checked_sub(1) else { continue };
                        if from >= self.rows {
                            continue;
                        }
                        let inside = (image * self.rows + from) * self.columns + first;
                        with(
                            inside * self.channels,
                            patch + side * row_of_patch + skipped * self.channels,
                            (beyond - first) * self.channels,
                        );
                    }
                }
            }
        }
    }
}

/// Returns names and shapes of the parameters of these images.
pub fn image_layout(sizes: &ImageSizes) -> Layout {
    let convolutions = sizes.convolutions();
    let mut layout = Vec::new();
    for convolution in &convolutions {
        let [weights, bias] = convolution.names;
        layout.push((weights, vec![convolution.patch(), convolution.made]));
        layout.push((bias, vec![convolution.made]));
    }
    let seen = convolutions.last().map_or(sizes.rows * sizes.columns, |last| {
        let [rows, columns] = last.halved();
        rows * columns * last.made
    });
    layout.push(("image.code", vec![seen, sizes.code]));
    layout.push(("image.code_bias", vec![sizes.code]));
    layout
}

/// Returns the bound of the uniform distribution around zero from which a parameter is initialised.
/// The variance is 1 / fan-in, and twice as much before a rectifier of images.
pub fn fresh_bound(name: &str, shape: &[usize]) -> f32 {
    let rectified = NAMES.iter().any(|[weights, _]| *weights == name);
    (if rectified { 6.0 } else { 3.0 } / shape[0].max(1) as f32).sqrt()
}

/// Computes the code of an image, row by row, before the last tanh.
///
/// # Panics
/// Panics if a parameter is missing.
pub fn image_code(sizes: &ImageSizes, parameters: &Parameters, image: &[f32]) -> Vec<f32> {
    let get = |name: &str| &parameters.values[name];
    let layer = |x: &[f32], columns: usize, weights: &[f32], bias: &[f32]| {
        let (rows, made) = (x.len() / columns, bias.len());
        let mut into = vec![0.0; rows * made];
        matrix_product(x, weights, rows, columns, made, &mut into);
        for row in into.chunks_exact_mut(made) {
            row.iter_mut().zip(bias).for_each(|(value, bias)| *value += bias);
        }
        into
    };
    let mut x = image.to_vec();
    for convolution in sizes.convolutions() {
        let [weights, bias] = convolution.names;
        let patches = convolution.patches(&x);
        x = layer(&patches, convolution.patch(), get(weights), get(bias));
        x.iter_mut().for_each(|value| *value = value.max(0.0));
    }
    layer(&x, x.len(), get("image.code"), get("image.code_bias"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_are_the_pixels_around_every_second_one() {
        let all = ImageSizes { rows: 5, columns: 6, code: 1 }.convolutions();
        assert_eq!(all.len(), 1);
        let convolution = Convolution { channels: 2, ..all[0] };
        let value = |row: usize, column: usize, channel: usize| {
            (1 + 2 * (row * 6 + column) + channel) as f32
        };
        let one: Vec<f32> = (0..60).map(|k| (k + 1) as f32).collect();
        let patches = convolution.patches(&[one.clone(), one].concat());
        assert_eq!(patches.len(), 2 * 3 * 3 * 18);
        for (k, found) in patches.iter().enumerate() {
            let (channel, column, row) = (k % 2, k / 2 % 3, k / 6 % 3);
            let (column, row) = (k / 18 % 3 * 2 + column, k / 54 % 3 * 2 + row);
            let inside = (1..=5).contains(&row) && (1..=6).contains(&column);
            let wanted = if inside { value(row - 1, column - 1, channel) } else { 0.0 };
            assert_eq!(*found, wanted, "{k}");
        }
    }

    #[test]
    fn images_are_halved_until_they_are_small() {
        let sides = |rows, columns| {
            let convolutions = ImageSizes { rows, columns, code: 1 }.convolutions();
            convolutions.iter().map(|c| (c.halved(), c.channels, c.made)).collect::<Vec<_>>()
        };
        assert_eq!(
            sides(64, 64),
            [([32, 32], 1, 8), ([16, 16], 8, 16), ([8, 8], 16, 32), ([4, 4], 32, 32)]
        );
        assert_eq!(sides(10, 11), [([5, 6], 1, 32), ([3, 3], 32, 32)]);
        assert_eq!(sides(ImageSizes::MOST, 1).len(), NAMES.len());
    }
}
