//! Images of a plate from above, seen from the lever point.

use pushplan::internals::effect::{LeverView, lever_features};
use pushplan::internals::geometry::Vector;
use pushplan::internals::{
    scene::{LeverFeatures, Slab},
    task::LeverJob,
};

use super::ImageFeatures;

/// Extents of a pixel inwards and along the levered edge, metres. They are equal for all plates, so
/// that large plates look large. The image holds every polygon with its corners on a circle of 10
/// cm.
const PIXEL: [f64; 2] = [0.0035, 0.005];

/// Extent of the image to the right of the lever point, metres: less than to the left, where the
/// centre of mass is.
const RIGHT: f64 = 0.13;

/// Number of lines on which the cover of a row's pixels is measured.
const LINES: usize = 4;

/// Height above the table at which a depth image has the value 1, metres.
const HIGH: f64 = 0.05;

/// Returns the image of a job's plate as seen in `view`, row by row inwards from the levered edge,
/// columns from the right.
///
/// A pixel of a mask is its covered share, a pixel of a depth image the height above the table. The
/// image of a shape context is the context itself, rings by wedges.
pub fn lever_image(features: ImageFeatures, job: &LeverJob, view: &LeverView) -> Vec<f32> {
    let plate = &job.scene.plates[job.lever.plate];
    match features {
        ImageFeatures::ContextImage => lever_features(LeverFeatures::ShapeContext, job, view),
        ImageFeatures::Image | ImageFeatures::ImageCode => drawn(job, view, |_| 1.0),
        ImageFeatures::Depth => {
            drawn(job, view, |slab| ((plate.z + slab.bottom + slab.height) / HIGH) as f32)
        }
    }
}

/// Returns for every pixel the maximum over slabs of cover times `value`, so that overlaps of parts
/// are invisible in a mask.
fn drawn(job: &LeverJob, view: &LeverView, value: impl Fn(&Slab) -> f32) -> Vec<f32> {
    let [rows, columns] = ImageFeatures::PIXELS;
    let mut image = vec![0.0f32; rows * columns];
    for slab in &job.scene.plates[job.lever.plate].slabs {
        let corners: Vec<Vector> = slab.corners.iter().map(|at| view.point(job, *at)).collect();
        let value = value(slab);
        for (row, pixels) in image.chunks_exact_mut(columns).enumerate() {
            let mut cover = vec![0.0; columns];
            for line in 0..LINES {
                let x = (row as f64 + (line as f64 + 0.5) / LINES as f64) * PIXEL[0];
                if let Some(span) = span(&corners, x) {
                    add(&mut cover, span);
                }
            }
            for (pixel, cover) in pixels.iter_mut().zip(cover) {
                *pixel = pixel.max(cover as f32 / LINES as f32 * value);
            }
        }
    }
    image
}

/// Returns where the line at `x` enters and leaves a convex outline.
fn span(corners: &[Vector], x: f64) -> Option<[f64; 2]> {
    let mut span: Option<[f64; 2]> = None;
    for (k, a) in corners.iter().enumerate() {
        let b = corners[(k + 1) % corners.len()];
        if (a.x <= x) != (b.x <= x) {
            let y = a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
            let [least, most] = span.unwrap_or([y, y]);
            span = Some([least.min(y), most.max(y)]);
        }
    }
    span
}

/// Adds the share of every pixel of a row that lies within the span.
fn add(row: &mut [f64], span: [f64; 2]) {
    let last = row.len() as f64;
    let [from, to] = span.map(|y| ((y + RIGHT) / PIXEL[1]).clamp(0.0, last));
    for (k, pixel) in row.iter_mut().enumerate().take(to.ceil() as usize).skip(from as usize) {
        *pixel += (to.min(k as f64 + 1.0) - from.max(k as f64)).max(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cover_of_pixels_adds_up_to_the_area() {
        let corners: Vec<Vector> = [[0.0, -0.031], [0.051, -0.011], [0.091, 0.033], [0.0, 0.06]]
            .map(|[x, y]| Vector::new(x, y))
            .to_vec();
        let mut area = 0.0;
        for row in 0..ImageFeatures::PIXELS[0] {
            let mut cover = vec![0.0; ImageFeatures::PIXELS[1]];
            for line in 0..LINES {
                let x = (row as f64 + (line as f64 + 0.5) / LINES as f64) * PIXEL[0];
                span(&corners, x).into_iter().for_each(|span| add(&mut cover, span));
            }
            area += cover.iter().sum::<f64>() / LINES as f64 * PIXEL[0] * PIXEL[1];
        }
        let doubled = |k: usize| {
            let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
            a.x * b.y - a.y * b.x
        };
        let wanted = 0.5 * (0..corners.len()).map(doubled).sum::<f64>();
        assert!((area / wanted - 1.0).abs() < 1e-2, "{area} {wanted}");
    }
}
