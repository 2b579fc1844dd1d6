//! How far two pictures are apart.

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
    fn noise_is_measured_over_shades() {
        let a = [pixel(0, 0.0), pixel(1, 1.0)];
        let b = [pixel(1, 0.1), pixel(1, 1.0)];
        assert!((rmse(&a, &b) - (0.01f64 / 2.0).sqrt()).abs() < 1e-15);
        assert_eq!(psnr(rmse(&a, &a)), None);
        assert!((psnr(0.1).unwrap_or(0.0) - 20.0).abs() < 1e-12);
    }
}
