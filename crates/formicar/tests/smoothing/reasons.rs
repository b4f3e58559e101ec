//! What is refused, and what is said then.

use super::{Place, free_request, open};
use formicar::map::{Cell, OccupancyGrid};
use formicar::smoothing::{CornerProblem, SmoothingConfig, SmoothingError, smooth};
use formicar::vehicle::Vehicle;

fn refusal(place: &Place, config: &SmoothingConfig, cells: &[(u32, u32)]) -> SmoothingError {
    let cells: Vec<Cell> = cells
        .iter()
        .map(|&(col, row)| Cell::new(col, row))
        .collect();
    let request = free_request(place, cells[0], cells[cells.len() - 1]);
    smooth(&place.ground(), config, &request, &cells).unwrap_err()
}

#[test]
fn refusals_name_corner_and_reason() {
    let place = Place::new(&open(60, 60), Vehicle::lei2020());
    let config = SmoothingConfig::lei2020();
    let problem = |cells: &[(u32, u32)]| match refusal(&place, &config, cells) {
        SmoothingError::Corner {
            number, problem, ..
        } => (number, problem),
        other => panic!("{other}"),
    };
    let (number, short) = problem(&[(10, 10), (30, 10), (30, 30), (33, 30), (33, 33)]);
    assert!(matches!(short, CornerProblem::TooShort { has_m, .. } if has_m == 1.5));
    assert_eq!(number, 3);
    // Each turn alone would have room.
    let (number, crowded) = problem(&[(10, 10), (17, 10), (17, 16), (24, 16)]);
    let CornerProblem::Crowded { needs_m, has_m } = crowded else {
        panic!("{crowded}")
    };
    assert!(number == 2 && needs_m > has_m && has_m > 0.0);
    let (_, back) = problem(&[(10, 10), (30, 10), (12, 10)]);
    assert_eq!(back, CornerProblem::TurnsBack);
    let text = refusal(&place, &config, &[(10, 10), (13, 10), (13, 13)]).to_string();
    assert!(
        text.starts_with("corner 1 at (6.75, 5.25) m turns by 90 deg: 2-turning needs"),
        "{text}"
    );
    assert!(text.ends_with("which has 1.500 m"), "{text}");
}

#[test]
fn refusals_tell_the_straight_from_the_turn() {
    let rows = [
        "##########",
        "##########",
        "######...#",
        "######...#",
        "######...#",
        "######...#",
        "######...#",
        ".........#",
        ".........#",
        ".........#",
        "##########",
    ];
    let map = OccupancyGrid::from_rows(&rows, 0.5).unwrap();
    let place = Place::new(&map, Vehicle::lei2020());
    let config = SmoothingConfig::lei2020();
    let error = refusal(&place, &config, &[(1, 2), (7, 2), (7, 8)]);
    let SmoothingError::Corner { problem, .. } = &error else {
        panic!("{error}")
    };
    assert!(
        matches!(problem, CornerProblem::Touches { depth_m } if *depth_m > 0.05),
        "{error}"
    );
    let error = refusal(&place, &SmoothingConfig::default(), &[(1, 2), (1, 9)]);
    let text = error.to_string();
    assert!(
        text.contains("straight") && text.ends_with("and no curve past it is free"),
        "{text}"
    );
}

#[test]
fn bad_questions_are_refused_with_their_range() {
    let place = Place::new(&open(20, 20), Vehicle::warehouse_amr());
    let request = free_request(&place, Cell::new(3, 3), Cell::new(9, 3));
    let bad: [fn(&mut SmoothingConfig); 5] = [
        |c| c.n_members = 0,
        |c| c.station_radii = f64::NAN,
        |c| c.reach_radii = -1.0,
        |c| c.reverse_penalty = 0.5,
        |c| c.direction_switching_cost = f64::INFINITY,
    ];
    for spoil in bad {
        let mut config = SmoothingConfig::default();
        spoil(&mut config);
        let error = smooth(&place.ground(), &config, &request, &[Cell::new(3, 3)]).unwrap_err();
        assert!(error.to_string().contains("it must be in"), "{error}");
    }
    let none = smooth(&place.ground(), &SmoothingConfig::default(), &request, &[]);
    assert_eq!(none.unwrap_err(), SmoothingError::NoNodes);
}
