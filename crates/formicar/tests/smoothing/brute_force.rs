//! The choice of 2-turnings against trying all of them.

use super::{Place, free_request, open};
use formicar::collision::{Body, Drive};
use formicar::geometry::{Arc, Point2, Pose2, angle_difference};
use formicar::map::Cell;
use formicar::map::generate::{ScatterParameters, scattered_obstacles};
use formicar::numeric::Seed;
use formicar::smoothing::{Rounding, Smoothed, SmoothingConfig, TwoTurning, smooth};
use formicar::validation::judge;
use formicar::vehicle::Vehicle;
use proptest::prelude::*;

fn center(cell: Cell, resolution_m: f64) -> Point2 {
    Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5) * resolution_m
}

/// The least sum of deviations over members that leave each other room.
fn least_deviations(turns: &[f64], lengths: &[f64], radius_m: f64, n_members: u32) -> Option<f64> {
    fn from_corner(families: &[Vec<TwoTurning>], lengths: &[f64], taken_m: f64) -> Option<f64> {
        let Some((family, rest)) = families.split_first() else {
            return Some(0.0);
        };
        let fits = |t: &&TwoTurning| taken_m + t.before_m <= lengths[0] && t.after_m <= lengths[1];
        let sums = family.iter().filter(fits).filter_map(|t| {
            let others = from_corner(rest, &lengths[1..], t.after_m)?;
            Some(t.deviation_m() + others)
        });
        sums.min_by(f64::total_cmp)
    }
    let family = |&turn: &f64| TwoTurning::family(turn, radius_m, n_members);
    let families: Vec<_> = turns.iter().map(family).collect();
    from_corner(&families, lengths, 0.0)
}

proptest! {
    /// On open ground nothing but neighbors limits the turns: the choice is the best joint one.
    #[test]
    fn neighbors_share_segments_as_well_as_they_can(
        steps in prop::collection::vec((-7_i32..=7, -7_i32..=7), 2..5),
        n_members in 1_u32..5,
    ) {
        let mut cells = vec![Cell::new(60, 60)];
        for (dx, dy) in steps {
            let last = cells[cells.len() - 1];
            cells.push(Cell::new(last.col.saturating_add_signed(dx), last.row.saturating_add_signed(dy)));
        }
        let place = Place::new(&open(120, 120), Vehicle::warehouse_amr());
        let request = free_request(&place, cells[0], cells[cells.len() - 1]);
        let config = SmoothingConfig { n_members, ..SmoothingConfig::lei2020() };
        let points: Vec<Point2> = cells.iter().map(|&c| center(c, 0.5)).collect();
        prop_assume!(points.windows(2).all(|w| w[0] != w[1]));
        let heading = |w: &[Point2]| (w[1] - w[0]).angle();
        let turns: Vec<f64> = points
            .windows(3)
            .map(|w| angle_difference(heading(&w[1..]), heading(&w[..2])))
            .collect();
        let is_corner = |turn: &f64| (0.01..3.1).contains(&turn.abs());
        prop_assume!(turns.iter().all(is_corner));

        let lengths: Vec<f64> = points.windows(2).map(|w| w[0].distance(w[1])).collect();
        let radius_m = place.vehicle.min_turning_radius_m();
        let expected = least_deviations(&turns, &lengths, radius_m, n_members);
        match smooth(&place.ground(), &config, &request, &cells) {
            Ok(smoothed) => {
                let deviation_m = |rounding: Rounding| match rounding {
                    Rounding::TwoTurning(turning) => turning.deviation_m(),
                    _ => f64::NAN,
                };
                let sum: f64 = smoothed.corners.iter().map(|c| deviation_m(c.rounding)).sum();
                prop_assert!((sum - expected.unwrap()).abs() < 1e-9, "{sum} {expected:?}");
                let report = judge(&place.obstacles, &place.vehicle, &request, &smoothed.path);
                prop_assert!(report.valid);
            }
            Err(error) => prop_assert!(expected.is_none(), "{error}, but {expected:?}"),
        }
    }

    /// At one corner among obstacles the nearest member that can be driven is chosen.
    #[test]
    fn the_nearest_free_member_is_chosen(seed in 0_u64..1000, picks in prop::array::uniform3(0_usize..2500)) {
        let parameters = ScatterParameters {
            n_cols: 50,
            n_rows: 50,
            resolution_m: 0.1,
            density: 0.01,
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&parameters, Seed(seed)).unwrap();
        let place = Place::new(&map, Vehicle::f1tenth());
        let cells = picks.map(|i| Cell::new((i % 50) as u32, (i / 50) as u32));
        let [a, b, c] = cells.map(|cell| center(cell, 0.1));
        prop_assume!(a.distance(b) > 1.0 && b.distance(c) > 1.0);
        let request = free_request(&place, cells[0], cells[2]);
        let config = SmoothingConfig::lei2020();
        let expected = nearest_free(&place, [a, b, c], config.n_members);
        match smooth(&place.ground(), &config, &request, &cells) {
            Ok(Smoothed { corners, .. }) => {
                let Rounding::TwoTurning(turning) = corners[0].rounding else {
                    panic!("a straight polyline has no corner")
                };
                prop_assert!((turning.deviation_m() - expected.unwrap()).abs() < 1e-12);
            }
            Err(error) => prop_assert!(expected.is_none(), "{error}, but {expected:?}"),
        }
    }
}

/// The least deviation of a member at a corner that can be driven with the straight ways to and
/// from it, by trying all.
fn nearest_free(place: &Place, [a, b, c]: [Point2; 3], n_members: u32) -> Option<f64> {
    let body = Body::new(&place.vehicle);
    let is_free = |start: Pose2, arc: Arc| {
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        place.obstacles.is_free(&body, &drive)
    };
    let (before, after) = ((b - a).angle(), (c - b).angle());
    let turn = angle_difference(after, before);
    let family = TwoTurning::family(turn, place.vehicle.min_turning_radius_m(), n_members);
    let drivable = family.into_iter().filter(|t| {
        let (way_in, way_out) = (a.distance(b) - t.before_m, b.distance(c) - t.after_m);
        let mut pose = Pose2::at(a, before);
        let [first, last] = t.arcs();
        let pieces = [Arc::new(0.0, way_in), first, last, Arc::new(0.0, way_out)];
        way_in >= 0.0
            && way_out >= 0.0
            && pieces.into_iter().all(|arc| {
                let start = pose;
                pose = arc.end_from(pose);
                is_free(start, arc)
            })
    });
    drivable.map(|t| t.deviation_m()).min_by(f64::total_cmp)
}
