//! Steps chosen by their progress.

use crate::map::STEPS;

/// The scalar product of each of [`STEPS`] with a vector.
fn progress(to_goal: (i64, i64)) -> [i64; 8] {
    STEPS.map(|(dx, dy)| i64::from(dx) * to_goal.0 + i64::from(dy) * to_goal.1)
}

/// The steps that meet a condition on their place and their progress, a bit each.
pub(super) fn class(to_goal: (i64, i64), belongs: impl Fn(usize, i64) -> bool) -> u8 {
    let progress = progress(to_goal);
    (0..8)
        .filter(|&step| belongs(step, progress[step]))
        .fold(0, |class, step| class | 1 << step)
}
