//! Maps of simulated drives: exact, the same every time, and honest about bad scans.

use crate::drives::{drive, first, mapped};
use formicar::Pose2;
use formicar::map::{FREE, OCCUPIED};
use formicar_mapping::evaluate::{neighbor_pairs, relation_errors, trajectory_error};
use formicar_mapping::front_end::Quality;
use formicar_mapping::simulate::{Office, ReverseSign};
use formicar_mapping::{Go, Mapper, MappingConfig, MappingError};

#[test]
fn a_drive_is_mapped_to_centimeters() {
    let log = drive(250, ReverseSign::Right);
    let truth = log.reference.clone().unwrap();
    let (mapper, built) = mapped(&log, MappingConfig::default());
    assert_eq!(built.trajectory.len(), truth.len());
    let errors = relation_errors(&built.trajectory, &truth, &neighbor_pairs(truth.len()));
    assert!(
        errors.mean_m < 0.015 && errors.mean_deg < 0.15,
        "{errors:?}"
    );
    let whole = trajectory_error(&built.trajectory, &truth);
    assert!(whole.rmse_m < 0.15, "{whole:?}");
    assert!(
        mapper
            .places()
            .iter()
            .all(|place| place.quality != Quality::Lost)
    );
    let frame = built.grid.frame();
    let of = |value: i8| built.grid.values().iter().filter(|v| **v == value).count();
    assert!(of(FREE) > 10_000 && of(OCCUPIED) > 1_000);
    for (i, value) in built.grid.values().iter().enumerate() {
        let point = truth[0].transform(frame.center(frame.cell(i)));
        assert!(
            *value != FREE || Office::contains(point),
            "free ground at {point:?}"
        );
    }
}

#[test]
fn the_same_log_gives_the_same_bits_and_a_session_goes_on() {
    let log = drive(90, ReverseSign::Right);
    let (whole, built) = mapped(&log, MappingConfig::default());
    let mut part = Mapper::new(MappingConfig::default()).unwrap();
    part.resolve_ranges(&log);
    let stop = |p| match p {
        formicar_mapping::Progress::Scans(47, _) => Go::Stop,
        _ => Go::On,
    };
    assert_eq!(part.add_log(&log, |_| true, stop).unwrap(), Go::Stop);
    let bytes = part.to_session().unwrap();
    assert_eq!(bytes, part.to_session().unwrap());
    let mut again = Mapper::from_session(&bytes).unwrap();
    assert_eq!(again, part);
    again.add_log(&log, |_| true, |_| Go::On).unwrap();
    assert_eq!(again, whole);
    let rebuilt = again.finish(|_| Go::On).unwrap();
    assert_eq!(rebuilt.grid, built.grid);
    assert_eq!(rebuilt.trajectory, built.trajectory);
}

#[test]
fn a_rigid_motion_of_the_odometry_frame_changes_nothing_to_a_millimeter() {
    let log = drive(60, ReverseSign::Right);
    let by = Pose2::new(31.0, -7.0, 2.1);
    let mut moved = log.clone();
    moved.odometry = log
        .odometry
        .as_ref()
        .map(|o| o.iter().map(|&p| by.compose(p)).collect());
    let (_, a) = mapped(&log, MappingConfig::default());
    let (_, b) = mapped(&moved, MappingConfig::default());
    for (a, b) in a.trajectory.iter().zip(&b.trajectory) {
        assert!(a.position().distance(b.position()) < 1e-3, "{a:?} {b:?}");
    }
}

#[test]
fn odometry_with_the_wrong_sign_in_reverse_is_found_out() {
    let (wrong, right) = (
        drive(330, ReverseSign::Wrong),
        drive(330, ReverseSign::Right),
    );
    let n_wrong = (1..330)
        .filter(|&i| (wrong.motion(i).unwrap().x - right.motion(i).unwrap().x).abs() > 0.1)
        .count();
    assert!(n_wrong > 5, "the drive reverses {n_wrong} times");
    let truth = wrong.reference.clone().unwrap();
    let (mapper, built) = mapped(&wrong, MappingConfig::default());
    let is_off =
        |&pair: &(usize, usize)| relation_errors(&built.trajectory, &truth, &[pair]).max_m > 0.15;
    let off: Vec<_> = neighbor_pairs(truth.len())
        .into_iter()
        .filter(is_off)
        .collect();
    assert!(4 * off.len() <= n_wrong, "{off:?} of {n_wrong}");
    let n_found = mapper.front_end().n_contradicted();
    assert!(n_found >= n_wrong / 2, "{n_found} of {n_wrong}");
}

#[test]
fn scans_that_tell_nothing_change_nothing_and_are_reported() {
    let log = drive(40, ReverseSign::Right);
    let (_, clean) = mapped(&log, MappingConfig::default());
    let mut mapper = Mapper::new(MappingConfig::default()).unwrap();
    mapper.resolve_ranges(&log);
    let blanks = [vec![3.0; 180], vec![81.91; 180], {
        let mut one = vec![0.0; 180];
        one[90] = 2.0;
        one
    }];
    for (i, scan) in log.scans.iter().enumerate() {
        mapper.add(scan, log.motion(i)).unwrap();
        for ranges_m in blanks.iter().filter(|_| i == 20) {
            let blank = formicar_mapping::LaserScan {
                ranges_m: ranges_m.clone(),
                ..scan.clone()
            };
            mapper.add(&blank, Some(Pose2::default())).unwrap();
        }
    }
    let degenerate = mapper
        .places()
        .iter()
        .filter(|p| p.quality == Quality::Degenerate);
    assert_eq!(degenerate.count(), 3);
    let built = mapper.finish(|_| Go::On).unwrap();
    assert_eq!(built.grid, clean.grid);
}

#[test]
fn beams_that_change_number_and_empty_mappers_are_refused() {
    let log = drive(3, ReverseSign::Right);
    let mut mapper = Mapper::new(MappingConfig::default()).unwrap();
    let nothing = mapper.finish(|_| Go::On).unwrap_err();
    assert!(matches!(nothing, MappingError::NoScans { .. }));
    mapper.add(&log.scans[0], None).unwrap();
    let mut other = log.scans[1].clone();
    other.ranges_m.pop();
    let error = mapper.add(&other, None).unwrap_err();
    assert!(error.to_string().contains("179 beams"), "{error}");
}

#[test]
fn a_second_drive_continues_the_map() {
    let log = drive(120, ReverseSign::Right);
    let truth = log.reference.clone().unwrap();
    let (mut mapper, built) = mapped(&first(&log, 70), MappingConfig::default());
    let start = truth[0].relative(truth[70]);
    mapper.start_drive(start, &built);
    for i in 70..120 {
        let motion = if i > 70 { log.motion(i) } else { None };
        mapper.add(&log.scans[i], motion).unwrap();
    }
    let both = mapper.finish(|_| Go::On).unwrap();
    assert_eq!(both.trajectory.len(), 120);
    let error = trajectory_error(&both.trajectory, &truth);
    assert!(error.rmse_m < 0.15, "{error:?}");
}
