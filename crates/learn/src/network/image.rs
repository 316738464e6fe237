//! What sees images as a candle graph, and the autoencoder around it.

use std::collections::BTreeMap;

use candle_core::{CpuStorage, CustomOp1, DType, Device, Layout, Result, Shape, Tensor, Var, bail};
use pushplan::internals::network::{
    Convolution, ImageSizes, Parameters, fresh_bound, image_layout,
};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::network::operations::{floats, with_floats};

/// Values and variables of a graph by name.
type Named = (BTreeMap<String, Tensor>, BTreeMap<String, Var>);

/// Width of the layer between the code and the image that it stands for.
const BETWEEN: usize = 256;

/// Images told in a code from which they can be drawn again.
pub struct Autoencoder {
    sizes: ImageSizes,
    values: BTreeMap<String, Tensor>,
    variables: BTreeMap<String, Var>,
}

impl Autoencoder {
    /// One with the given parameters.
    ///
    /// # Errors
    /// If a parameter is missing or has another shape than [`autoencoder_layout`] says.
    pub fn new(sizes: &ImageSizes, parameters: &Parameters) -> Result<Self> {
        let (values, variables) = variables(&autoencoder_layout(sizes), parameters)?;
        Ok(Self { sizes: *sizes, values, variables })
    }

    /// The variables by name.
    pub fn variables(&self) -> &BTreeMap<String, Var> {
        &self.variables
    }

    /// Of images [B, rows, columns, 1] what is drawn from their codes, as logits of the share of every
    /// pixel that is covered [B, rows x columns].
    ///
    /// # Errors
    /// Those of candle.
    pub fn forward(&self, images: &Tensor) -> Result<Tensor> {
        let get = |name: &str| &self.values[name];
        image_codes(&self.sizes, &self.values, images)?
            .matmul(get("drawn.hidden"))?
            .broadcast_add(get("drawn.hidden_bias"))?
            .relu()?
            .matmul(get("drawn.image"))?
            .broadcast_add(get("drawn.image_bias"))
    }
}

/// Names and shapes of the parameters of an autoencoder: those that see images, and those that draw.
pub fn autoencoder_layout(sizes: &ImageSizes) -> Vec<(&'static str, Vec<usize>)> {
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

/// Random first values from `seed`; biases are zero.
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

/// Every parameter of a layout as a variable.
pub(super) fn variables(
    layout: &[(&'static str, Vec<usize>)],
    parameters: &Parameters,
) -> Result<Named> {
    let (mut tensors, mut variables) = (BTreeMap::new(), BTreeMap::new());
    for (name, shape) in layout {
        let Some(values) = parameters.values.get(*name) else {
            bail!("the parameter {name} is missing")
        };
        let tensor = Tensor::from_slice(values, shape.as_slice(), &Device::Cpu)?;
        let variable = Var::from_tensor(&tensor)?;
        tensors.insert((*name).to_owned(), variable.as_tensor().clone());
        variables.insert((*name).to_owned(), variable);
    }
    Ok((tensors, variables))
}

/// The codes [B, code] of images [B, rows, columns, 1].
pub(super) fn image_codes(
    sizes: &ImageSizes,
    values: &BTreeMap<String, Tensor>,
    images: &Tensor,
) -> Result<Tensor> {
    let batch = images.dim(0)?;
    let mut x = images.to_dtype(DType::F32)?;
    for convolution in sizes.convolutions() {
        let [weights, bias] = convolution.names.map(|name| &values[name]);
        let patches = x.apply_op1(Patches(convolution))?;
        x = patches.matmul(weights)?.broadcast_add(bias)?.relu()?;
    }
    let seen = x.elem_count() / batch.max(1);
    x.reshape((batch, seen))?
        .matmul(&values["image.code"])?
        .broadcast_add(&values["image.code_bias"])?
        .tanh()
}

/// Images side by side to their patches, a row each.
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
