//! New paths that pass an obstacle on the other side than the old one.

use crate::geometry::Point2;

/// True if old and new path pass some obstacle on different sides.
///
/// Obstacles are given by one point inside each component of occupied cells. The loop of the old
/// path, forth, and the new path, back, winds around a point exactly where the two pass it on
/// different sides; straight lines join the ends where they differ. After a replan on the way,
/// give the part of the old path that is still ahead. Cost: path points times obstacles.
///
/// ```
/// use formicar::Point2;
/// use formicar::metrics::flips;
///
/// let path = |y| [[0.0, 0.0], [5.0, y], [9.0, 0.0]].map(|[x, y]| Point2::new(x, y));
/// let pillar = [Point2::new(5.0, 0.0)];
/// assert!(flips(&path(2.0), &path(-2.0), &pillar));
/// assert!(!flips(&path(2.0), &path(1.0), &pillar));
/// ```
pub fn flips(old: &[Point2], new: &[Point2], obstacles: &[Point2]) -> bool {
    let there_and_back: Vec<Point2> = old.iter().chain(new.iter().rev()).copied().collect();
    obstacles
        .iter()
        .any(|&obstacle| winding_number(&there_and_back, obstacle) != 0)
}

/// The winding number of a closed loop around a point, counter-clockwise: upward crossings of the
/// ray to the right less downward ones.
fn winding_number(corners: &[Point2], point: Point2) -> i32 {
    let n = corners.len();
    let crossing = |i: usize| {
        let (a, b) = (corners[i] - point, corners[(i + 1) % n] - point);
        if a.y <= 0.0 && b.y > 0.0 && a.cross(b) > 0.0 {
            1
        } else if a.y > 0.0 && b.y <= 0.0 && a.cross(b) < 0.0 {
            -1
        } else {
            0
        }
    };
    (0..n).map(crossing).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point2> {
        list.iter().map(|&(x, y)| Point2::new(x, y)).collect()
    }

    #[test]
    fn another_side_is_a_flip_another_bend_is_not() {
        let obstacles = points(&[(2.0, 0.0), (6.0, 0.0)]);
        let above = points(&[(0.0, 0.0), (2.0, 1.0), (6.0, 1.0), (8.0, 0.0)]);
        let wider = points(&[(0.0, 0.0), (4.0, 5.0), (8.0, 0.0)]);
        let slalom = points(&[(0.0, 0.0), (2.0, 1.0), (6.0, -1.0), (8.0, 0.0)]);
        assert!(!flips(&above, &above, &obstacles));
        assert!(!flips(&above, &wider, &obstacles));
        assert!(flips(&above, &slalom, &obstacles));
        assert!(!flips(&above, &slalom, &obstacles[..1]));
    }

    #[test]
    fn a_loop_around_an_obstacle_counts_even_where_both_ends_agree() {
        let direct = points(&[(0.0, -1.0), (4.0, -1.0)]);
        let round = points(&[
            (0.0, -1.0),
            (3.0, -1.0),
            (3.0, 1.0),
            (1.0, 1.0),
            (1.0, -1.0),
            (4.0, -1.0),
        ]);
        assert!(flips(&direct, &round, &points(&[(2.0, 0.0)])));
        assert!(!flips(&direct, &round, &points(&[(2.0, 3.0)])));
        assert!(!flips(&[], &[], &points(&[(2.0, 3.0)])));
    }
}
