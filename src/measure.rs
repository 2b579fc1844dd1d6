//! How far two pictures are apart.

use serde::{Deserialize, Serialize};
use slowlight_compiler::eval::native::Pixel;

/// A pixel where two pictures differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Its place in the picture.
    pub place: (u32, u32),
    /// The ink of the one.
    pub is: u8,
    /// The ink of the other.
    pub should: u8,
}

/// Where two pictures of the same window differ, in their order.
pub fn differences(
    places: impl Iterator<Item = (u32, u32)>,
    is: &[u8],
    should: &[Pixel],
) -> Vec<Difference> {
    let pairs = places.zip(is.iter().zip(should));
    pairs
        .filter(|(_, (is, should))| **is != should.ink)
        .map(|(place, (is, should))| Difference {
            place,
            is: *is,
            should: should.ink,
        })
        .collect()
}

/// The root of the mean square of the shades' differences.
pub fn rmse(a: &[Pixel], b: &[Pixel]) -> f64 {
    let square = |(a, b): (&Pixel, &Pixel)| {
        let gap = a.shade - b.shade;
        gap * gap
    };
    let count = a.len().min(b.len()).max(1);
    let sum: f64 = a.iter().zip(b).map(square).sum();
    (sum / count as f64).sqrt()
}

/// Peak signal to noise ratio in dB, the peak being 1; none where there is no noise.
pub fn psnr(rmse: f64) -> Option<f64> {
    (rmse > 0.0).then(|| -20.0 * rmse.log10())
}

/// How far a machine's picture is from the native one of the same pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Pixels counted.
    pub count: u64,
    /// Before the dither: the root of the mean square of the shades' differences.
    pub rmse: f64,
    /// Peak signal to noise in dB; none where the shades are equal.
    pub psnr: Option<f64>,
    /// The greatest difference of two shades.
    pub max: f64,
    /// What 99 of 100 pixels' differences are within.
    pub p99: f64,
    /// After the dither: pixels with another ink.
    pub pixels: u64,
    /// How many there would be if every dither were one by chance: the mean difference of
    /// shades times the steps between inks, a pixel.
    pub expected: f64,
    /// The root of the mean square of what is left of the inks' differences as seen from
    /// afar: both pictures under a Gaussian of [`SIGMA`].
    pub low_pass: f64,
}

/// The width (standard deviation) of the Gaussian that inks are seen through, in pixels.
pub const SIGMA: f64 = 3.0;

/// Errors of a machine's inks and model's shades, so many columns wide.
pub fn errors(
    width: u32,
    inks: &[u8],
    shades: &[Pixel],
    native: &[Pixel],
    levels: usize,
) -> Errors {
    let count = native.len().max(1);
    let mut gaps: Vec<f64> = (shades.iter().zip(native))
        .map(|(a, b)| (a.shade - b.shade).abs())
        .collect();
    let mean = gaps.iter().sum::<f64>() / count as f64;
    gaps.sort_by(f64::total_cmp);
    let rmse = rmse(shades, native);
    let steps = levels.saturating_sub(1).max(1) as f64;
    let apart: Vec<f64> = (inks.iter().zip(native))
        .map(|(ink, pixel)| (f64::from(*ink) - f64::from(pixel.ink)) / steps)
        .collect();
    let seen = blurred(&apart, width as usize);
    Errors {
        count: native.len() as u64,
        rmse,
        psnr: psnr(rmse),
        max: gaps.last().copied().unwrap_or(0.0),
        // Of 100 pixels the second largest, so that one is above.
        p99: gaps
            .get((count * 99).div_ceil(100) - 1)
            .copied()
            .unwrap_or(0.0),
        pixels: inks
            .iter()
            .zip(native)
            .filter(|(ink, pixel)| **ink != pixel.ink)
            .count() as u64,
        expected: mean * steps * native.len() as f64,
        low_pass: (seen.iter().map(|v| v * v).sum::<f64>() / count as f64).sqrt(),
    }
}

/// A picture under a Gaussian of [`SIGMA`] pixels. What would be beyond its border weighs
/// nothing, and the rest so much more.
fn blurred(values: &[f64], width: usize) -> Vec<f64> {
    let reach = (3.0 * SIGMA).ceil() as isize;
    let kernel: Vec<f64> = (-reach..=reach)
        .map(|k| (-((k * k) as f64) / (2.0 * SIGMA * SIGMA)).exp())
        .collect();
    let width = width.max(1);
    let height = values.len() / width;
    let along = |values: &[f64], step: usize, at: usize, place: usize, long: usize| {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (k, w) in (-reach..=reach).zip(&kernel) {
            let there = place as isize + k;
            if (0..long as isize).contains(&there) {
                sum += w * values[at.wrapping_add_signed(k * step as isize)];
                weight += w;
            }
        }
        sum / weight
    };
    let places = 0..height * width;
    let across: Vec<f64> = places
        .clone()
        .map(|at| along(values, 1, at, at % width, width))
        .collect();
    places
        .map(|at| along(&across, width, at, at / width, height))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(ink: u8, shade: f64) -> Pixel {
        Pixel { ink, shade }
    }

    #[test]
    fn differences_keep_their_places() {
        let places = [(4, 2), (5, 2), (4, 3)].into_iter();
        let should = [pixel(0, 0.0), pixel(1, 1.0), pixel(1, 1.0)];
        let found = differences(places, &[0, 0, 1], &should);
        let expected = Difference {
            place: (5, 2),
            is: 0,
            should: 1,
        };
        assert_eq!(found, [expected]);
    }

    #[test]
    fn an_even_difference_is_seen_whole_and_an_alternating_one_hardly() {
        let native = vec![pixel(0, 0.25); 40 * 30];
        let shades = vec![pixel(0, 0.5); 40 * 30];
        let even = errors(40, &vec![1; 1200], &shades, &native, 3);
        assert!((even.low_pass - 0.5).abs() < 1e-12, "{even:?}");
        assert_eq!(
            (even.pixels, even.max, even.p99, even.rmse),
            (1200, 0.25, 0.25, 0.25)
        );
        assert!((even.expected - 600.0).abs() < 1e-9);
        let chess: Vec<u8> = (0..1200).map(|k| ((k % 40 + k / 40) % 2) as u8).collect();
        let white: Vec<Pixel> = chess.iter().map(|ink| pixel(1 - ink, 0.5)).collect();
        let seen = errors(40, &chess, &white, &white, 2);
        assert_eq!((seen.pixels, seen.rmse), (1200, 0.0));
        assert!(seen.low_pass < 0.1, "{seen:?}");
    }

    #[test]
    fn one_pixel_of_a_hundred_is_beyond_the_percentile() {
        let native = vec![pixel(0, 0.0); 100];
        let mut shades = native.clone();
        shades[17].shade = 1.0;
        let found = errors(10, &[0; 100], &shades, &native, 2);
        assert_eq!((found.max, found.p99), (1.0, 0.0));
    }

    #[test]
    fn noise_is_measured_over_shades() {
        let a = [pixel(0, 0.0), pixel(1, 1.0)];
        let b = [pixel(1, 0.1), pixel(1, 1.0)];
        assert!((rmse(&a, &b) - (0.01f64 / 2.0).sqrt()).abs() < 1e-15);
        assert_eq!(psnr(rmse(&a, &a)), None);
        assert!((psnr(0.1).unwrap_or(0.0) - 20.0).abs() < 1e-12);
    }
}
