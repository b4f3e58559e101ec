//! Rectangles strewn at random: stress tests by density.

use super::{GenerateError, ScatterParameters};
use crate::map::sketch::frame_at_origin;
use crate::map::{FREE, OCCUPIED, OccupancyGrid};
use crate::numeric::{RandomStream, Seed};
use std::ops::Range;

/// A field of random rectangles that take the wanted share of the cells.
///
/// Nothing promises that two free cells are connected, the more so as the density grows.
///
/// # Errors
/// Parameters out of range, or more cells than a map may have.
///
/// ```
/// use formicar::Seed;
/// use formicar::map::generate::{ScatterParameters, scattered_obstacles};
///
/// let parameters = ScatterParameters { density: 0.1, ..ScatterParameters::default() };
/// let map = scattered_obstacles(&parameters, Seed(3))?;
/// assert_eq!(map.values(), scattered_obstacles(&parameters, Seed(3))?.values());
/// # Ok::<(), formicar::map::generate::GenerateError>(())
/// ```
pub fn scattered_obstacles(
    parameters: &ScatterParameters,
    seed: Seed,
) -> Result<OccupancyGrid, GenerateError> {
    parameters.check()?;
    let (n_cols, n_rows) = (parameters.n_cols, parameters.n_rows);
    let frame = frame_at_origin(n_cols, n_rows, parameters.resolution_m)?;
    let mut values = vec![FREE; frame.n_cells()];
    let mut random = seed.stream([0, 0]);
    let mut n_missing = (parameters.density * frame.n_cells() as f64).round() as usize;
    while n_missing > 0 {
        let mut side = || 1 + random.below(parameters.max_obstacle_cells);
        let (width, height) = (side(), side());
        // Obstacles may stick out on every side, so that borders are as dense as the middle.
        let cols = span(&mut random, width, n_cols);
        for row in span(&mut random, height, n_rows) {
            let cells = &mut values[row * n_cols..][cols.clone()];
            let n_new = cells.iter().filter(|&&v| v == FREE).count();
            cells.fill(OCCUPIED);
            n_missing = n_missing.saturating_sub(n_new);
        }
    }
    Ok(OccupancyGrid::new(frame, values)?)
}

/// Random places in `0..n` that a stretch of `length` covers, at least one.
fn span(random: &mut RandomStream, length: usize, n: usize) -> Range<usize> {
    let end = 1 + random.below(n + length - 1);
    end.saturating_sub(length)..end.min(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_the_wanted_share_of_cells() {
        for (density, max_obstacle_cells) in [(0.0, 1), (0.1, 4), (0.5, 1), (0.8, 9)] {
            let parameters = ScatterParameters {
                density,
                max_obstacle_cells,
                ..ScatterParameters::default()
            };
            let map = scattered_obstacles(&parameters, Seed(1)).unwrap();
            let share = map.lethal_cells().count() as f64 / 40_000.0;
            assert!((0.0..0.003).contains(&(share - density)), "{share}");
            assert_eq!(map, scattered_obstacles(&parameters, Seed(1)).unwrap());
        }
    }

    #[test]
    fn refuses_bad_parameters() {
        let with = |change: fn(&mut ScatterParameters)| {
            let mut parameters = ScatterParameters::default();
            change(&mut parameters);
            scattered_obstacles(&parameters, Seed(0)).is_err()
        };
        assert!(with(|p| p.density = f64::NAN));
        assert!(with(|p| p.density = 0.9));
        assert!(with(|p| p.max_obstacle_cells = 0));
        assert!(with(|p| p.n_cols = 0));
        assert!(with(|p| p.n_rows = usize::MAX));
    }
}
