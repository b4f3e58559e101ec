//! Power laws through points, fitted on logarithms.

use formicar::geometry::Point2;

/// y in proportion to x ^ exponent, by least squares over the logarithms of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PowerLaw {
    pub(super) exponent: f64,
    /// Share of the variance of log y that it explains.
    pub(super) r_squared: f64,
}

impl PowerLaw {
    /// Through points with both coordinates above 0, three of them at least, not all over one x.
    pub(super) fn through(points: &[Point2]) -> Option<Self> {
        let is_positive = |p: &&Point2| p.x > 0.0 && p.y > 0.0;
        let logs: Vec<[f64; 2]> = points
            .iter()
            .filter(is_positive)
            .map(|p| [p.x.ln(), p.y.ln()])
            .collect();
        if logs.len() < 3 {
            return None;
        }
        let n = logs.len() as f64;
        let mean = |i: usize| logs.iter().map(|p| p[i]).sum::<f64>() / n;
        let means = [mean(0), mean(1)];
        let sum = |i: usize, j: usize| {
            let product = |p: &[f64; 2]| (p[i] - means[i]) * (p[j] - means[j]);
            logs.iter().map(product).sum::<f64>()
        };
        let (xx, xy, yy) = (sum(0, 0), sum(0, 1), sum(1, 1));
        let exponent = xy / xx;
        (xx > 0.0).then(|| Self {
            exponent,
            r_squared: if yy > 0.0 { xy * xy / (xx * yy) } else { 1.0 },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_again() {
        let points = [1.0, 10.0, 50.0, 300.0].map(|x: f64| Point2::new(x, 3.0 * x.powf(1.5)));
        let law = PowerLaw::through(&points).unwrap();
        assert!((law.exponent - 1.5).abs() < 1e-12);
        assert!((law.r_squared - 1.0).abs() < 1e-12);
    }

    #[test]
    fn noise_lowers_the_share_explained_and_too_few_points_have_none() {
        let points = [[1.0, 1.0], [2.0, 8.0], [4.0, 4.0], [8.0, 32.0]];
        let points = points.map(|[x, y]| Point2::new(x, y));
        let law = PowerLaw::through(&points).unwrap();
        // Slope over logarithms to base 2: x 0 1 2 3, y 0 3 2 5.
        assert!((law.exponent - 1.4).abs() < 1e-12, "{law:?}");
        assert!((law.r_squared - 9.8 / 13.0).abs() < 1e-9, "{law:?}");
        assert_eq!(PowerLaw::through(&points[..2]), None);
        assert_eq!(PowerLaw::through(&[points[0]; 3]), None);
    }
}
