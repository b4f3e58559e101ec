//! The cells in the convex hull of an obstacle.

/// The first and the last column of an obstacle in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) first: u32,
    pub(super) last: u32,
}

impl Span {
    pub(super) fn n_cells(self) -> usize {
        (self.last - self.first + 1) as usize
    }
}

/// Row by row the cells whose centers lie in the convex hull of the cell centers of an obstacle,
/// boundary included; the obstacle is given by its spans in consecutive rows.
pub(super) fn hull_spans(spans: &[Span]) -> Vec<Span> {
    let firsts = convex_minorant(spans, |span| i64::from(span.first));
    let lasts = convex_minorant(spans, |span| -i64::from(span.last));
    let both = firsts.into_iter().zip(lasts);
    both.map(|(first, last)| Span {
        first: first as u32,
        last: -last as u32,
    })
    .collect()
}

/// Values of the largest convex function of the row that is nowhere above `value`, rounded up
/// (the lower half of Andrew's monotone chain).
fn convex_minorant(spans: &[Span], value: impl Fn(&Span) -> i64) -> Vec<i64> {
    let mut corners: Vec<(i64, i64)> = Vec::new();
    for (row, span) in spans.iter().enumerate() {
        let corner = (row as i64, value(span));
        while let [.., a, b] = corners[..] {
            if (b.0 - a.0) * (corner.1 - a.1) > (b.1 - a.1) * (corner.0 - a.0) {
                break;
            }
            corners.pop();
        }
        corners.push(corner);
    }
    let mut values: Vec<i64> = corners.first().map(|corner| corner.1).into_iter().collect();
    for edge in corners.windows(2) {
        let (rise, run) = (edge[1].1 - edge[0].1, edge[1].0 - edge[0].0);
        values.extend((1..=run).map(|i| edge[0].1 - (-rise * i).div_euclid(run)));
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn span((first, length): (u32, u32)) -> Span {
        Span {
            first,
            last: first + length,
        }
    }

    #[test]
    fn a_line_between_two_cells_keeps_the_centers_on_it() {
        let spans = [(0, 0), (5, 0), (4, 0)].map(span);
        let hull = hull_spans(&spans);
        assert_eq!(hull, [(0, 0), (2, 3), (4, 0)].map(span));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 3))]

        #[test]
        fn equals_a_test_of_triangles(spans in prop::collection::vec((0_u32..12, 0_u32..4), 1..10)) {
            let spans: Vec<Span> = spans.into_iter().map(span).collect();
            let hull = hull_spans(&spans);
            let cells: Vec<(i64, i64)> = spans
                .iter()
                .zip(0..)
                .flat_map(|(span, row)| [(span.first.into(), row), (span.last.into(), row)])
                .collect();
            let cross = |a: (i64, i64), b: (i64, i64), p: (i64, i64)| {
                (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0)
            };
            // A point of the plane lies in the hull of a set if it lies in that of three of them,
            // or on a segment between two (here for points between the lowest and highest row).
            let between = |a: (i64, i64), b: (i64, i64), p: (i64, i64)| {
                let inside = |a: i64, b: i64, p: i64| a.min(b) <= p && p <= a.max(b);
                cross(a, b, p) == 0 && inside(a.0, b.0, p.0) && inside(a.1, b.1, p.1)
            };
            let in_triangle = |[a, b, c]: [(i64, i64); 3], p| {
                let sides = [cross(a, b, p), cross(b, c, p), cross(c, a, p)];
                let strict = sides.iter().all(|&s| s > 0) || sides.iter().all(|&s| s < 0);
                strict || between(a, b, p) || between(b, c, p) || between(c, a, p)
            };
            for (row, hull) in hull.iter().enumerate() {
                for col in 0..20 {
                    let p = (i64::from(col), row as i64);
                    let expected = cells.iter().any(|&a| {
                        cells.iter().any(|&b| cells.iter().any(|&c| in_triangle([a, b, c], p)))
                    });
                    prop_assert_eq!((hull.first..=hull.last).contains(&col), expected, "{:?}", p);
                }
            }
        }
    }
}
