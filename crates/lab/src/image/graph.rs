//! The convolutions of images as a candle graph, and the autoencoder around it.

use std::collections::BTreeMap;

use candle_core::{CpuStorage, CustomOp1, DType, Layout, Result, Shape, Tensor, Var};
use pushplan::internals::network::{self, LeverSizes, Parameters};
use pushplan_learn::network::{LeverGraph, floats, variables, with_floats};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::{Convolution, ImageSizes, fresh_bound, image_layout};

/// Width of the layer between the code and the reconstructed image.
const BETWEEN: usize = 256;

/// An encoder of images and a decoder that draws them from their codes.
pub struct Autoencoder {
    sizes: ImageSizes,
    variables: BTreeMap<String, Var>,
}

impl Autoencoder {
    /// Creates an autoencoder with the given parameters.
    ///
    /// # Errors
    /// Returns an error if a parameter is missing or has another shape than in
    /// [`autoencoder_layout`].
    pub fn new(sizes: &ImageSizes, parameters: &Parameters) -> Result<Self> {
        Ok(Self { sizes: *sizes, variables: variables(autoencoder_layout(sizes), parameters)? })
    }

    /// Returns the variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Reconstructs images [B, rows, columns, 1] from their codes, as logits of the covered share
    /// of every pixel [B, rows x columns].
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn forward(&self, images: &Tensor) -> Result<Tensor> {
        let get = |name: &str| self.variables[name].as_tensor();
        image_codes(&self.sizes, get, images)?
            .matmul(get("drawn.hidden"))?
            .broadcast_add(get("drawn.hidden_bias"))?
            .relu()?
            .matmul(get("drawn.image"))?
            .broadcast_add(get("drawn.image_bias"))
    }
}

/// Returns names and shapes of the parameters of an autoencoder: encoder, then decoder.
pub fn autoencoder_layout(sizes: &ImageSizes) -> network::Layout {
    let pixels = sizes.rows * sizes.columns;
    let mut layout = image_layout(sizes);
    layout.extend([
        ("drawn.hidden", vec![sizes.code, BETWEEN]),
        ("drawn.hidden_bias", vec![BETWEEN]),
        ("drawn.image", vec![BETWEEN, pixels]),
        ("drawn.image_bias", vec![pixels]),
    ]);
    layout
}

/// Returns random initial values from `seed`; biases are zero.
pub fn fresh_autoencoder(sizes: &ImageSizes, seed: u64) -> Parameters {
    let mut random = Pcg64::seed_from_u64(seed);
    let values = autoencoder_layout(sizes).into_iter().map(|(name, shape)| {
        let bound = fresh_bound(name, &shape);
        let zero = shape.len() == 1;
        let value = |_| if zero { 0.0 } else { random.random_range(-bound..bound) };
        (name.to_owned(), (0..shape.iter().product()).map(value).collect())
    });
    Parameters { values: values.collect() }
}

/// A memory and its image encoder, with their variables.
pub struct ImageGraph {
    sizes: ImageSizes,
    memory: LeverGraph,
    /// Parameters of the encoder, and from the code to the gates.
    values: BTreeMap<String, Tensor>,
    variables: BTreeMap<String, Var>,
}

impl ImageGraph {
    /// Creates networks of these sizes with the given parameters. The encoder is trained too unless
    /// `sees_as_it_is`.
    ///
    /// # Errors
    /// Returns an error if a parameter is missing or has another shape than in its layout.
    pub fn new(
        sizes: (&LeverSizes, &ImageSizes),
        parameters: &Parameters,
        sees_as_it_is: bool,
    ) -> Result<Self> {
        let (of_memory, image) = sizes;
        let memory = LeverGraph::new(of_memory, parameters)?;
        let mut seen = image_layout(image);
        seen.push(("gates.image", vec![image.code, 4 * of_memory.width]));
        let mut variables = variables(seen, parameters)?;
        let values = variables.iter().map(|(name, variable)| {
            let fixed = sees_as_it_is && name.starts_with("image");
            let value =
                if fixed { variable.as_detached_tensor() } else { variable.as_tensor().clone() };
            (name.clone(), value)
        });
        let values = values.collect();
        variables.retain(|name, _| !(sees_as_it_is && name.starts_with("image")));
        variables.extend(memory.variables().clone());
        Ok(Self { sizes: *image, memory, values, variables })
    }

    /// Returns the variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Returns the memory.
    pub fn memory(&self) -> &LeverGraph {
        &self.memory
    }

    /// Returns the contribution of images [B, rows, columns, 1] to the gates: [B, 4 H].
    ///
    /// # Errors
    /// Returns errors of candle.
    pub fn contribution(&self, images: &Tensor) -> Result<Tensor> {
        image_codes(&self.sizes, |name| &self.values[name], images)?
            .matmul(&self.values["gates.image"])
    }
}

/// Returns the codes [B, code] of images [B, rows, columns, 1].
fn image_codes<'a>(
    sizes: &ImageSizes,
    get: impl Fn(&str) -> &'a Tensor,
    images: &Tensor,
) -> Result<Tensor> {
    let batch = images.dim(0)?;
    let mut x = images.to_dtype(DType::F32)?;
    for convolution in sizes.convolutions() {
        let [weights, bias] = convolution.names.map(&get);
        let patches = x.apply_op1(Patches(convolution))?;
        x = patches.matmul(weights)?.broadcast_add(bias)?.relu()?;
    }
    let seen = x.elem_count() / batch.max(1);
    x.reshape((batch, seen))?
        .matmul(get("image.code"))?
        .broadcast_add(get("image.code_bias"))?
        .tanh()
}

/// Operation from images side by side to their patches, one per row.
struct Patches(Convolution);

impl CustomOp1 for Patches {
    fn name(&self) -> &'static str {
        "patches"
    }

    fn cpu_fwd(&self, x: &CpuStorage, layout: &Layout) -> Result<(CpuStorage, Shape)> {
        let patches = self.0.patches(floats(x, layout)?);
        let rows = patches.len() / self.0.patch();
        Ok((CpuStorage::F32(patches), (rows, self.0.patch()).into()))
    }

    fn bwd(&self, x: &Tensor, _: &Tensor, gradient: &Tensor) -> Result<Option<Tensor>> {
        with_floats(gradient, |gradient| {
            let of_x = self.0.patches_gradient(gradient);
            Tensor::from_vec(of_x, x.shape(), x.device()).map(Some)
        })
    }
}
