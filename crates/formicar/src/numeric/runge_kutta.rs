//! The classical Runge-Kutta method of fourth order.

/// One step of size `h` for `dy/dt = f(y)`; the local error is of order `h^5`.
///
/// ```
/// use formicar::numeric::rk4_step;
///
/// // y' = y from 1, over ten steps to 1.
/// let [y] = (0..10).fold([1.0], |y, _| rk4_step(y, 0.1, |[y]| [y]));
/// assert!((y - 1_f64.exp()).abs() < 1e-5);
/// ```
pub fn rk4_step<const N: usize>(
    y: [f64; N],
    h: f64,
    mut f: impl FnMut([f64; N]) -> [f64; N],
) -> [f64; N] {
    let along = |k: [f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let k1 = f(y);
    let k2 = f(along(k1, h / 2.0));
    let k3 = f(along(k2, h / 2.0));
    let k4 = f(along(k3, h));
    std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_falls_with_the_fourth_power_of_the_step() {
        let error = |n: usize| {
            let h = 1.0 / n as f64;
            let y = (0..n).fold([1.0], |y, _| rk4_step(y, h, |[y]| [y]));
            (y[0] - 1.0_f64.exp()).abs()
        };
        let ratio = error(20) / error(40);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }
}
