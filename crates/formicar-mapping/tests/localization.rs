//! A robot in the map of an earlier drive.

use crate::drives::{drive, mapped};
use formicar_mapping::front_end::Quality;
use formicar_mapping::simulate::ReverseSign;
use formicar_mapping::{LaserScan, LocalizationMap, Localizer, MappingConfig};

#[test]
fn a_robot_is_found_from_four_scans_and_tracked() {
    let log = drive(120, ReverseSign::Right);
    let (mapper, built) = mapped(&log, MappingConfig::default());
    let map = LocalizationMap::new(&built.field);
    let mut localizer = Localizer::new(map, mapper.config(), None).unwrap();
    for (i, mapped_pose) in built.trajectory.iter().enumerate().skip(20) {
        let motion = if i > 20 { log.motion(i) } else { None };
        let found = localizer.add(&log.scans[i], motion);
        if i < 23 {
            assert_eq!(found.quality, Quality::Lost, "four scans are needed");
            continue;
        }

        let error = found.pose.position().distance(mapped_pose.position());
        assert!(
            error < 0.1 && found.quality != Quality::Lost,
            "{i}: {error} {found:?}"
        );
        assert!(found.covariance.xx > 0.0 && found.covariance.xx < 0.1);
    }
    let blank = LaserScan {
        ranges_m: vec![2.0; 180],
        ..log.scans[0].clone()
    };
    assert_eq!(localizer.add(&blank, None).quality, Quality::Degenerate);
}

#[test]
fn an_occupancy_grid_serves_as_a_map() {
    let log = drive(100, ReverseSign::Right);
    let (mapper, built) = mapped(&log, MappingConfig::default());
    let map = LocalizationMap::of_grid(&built.grid, mapper.config());
    let start = built.trajectory[10];
    let mut localizer = Localizer::new(map, mapper.config(), Some(start)).unwrap();
    for (i, mapped_pose) in built.trajectory.iter().enumerate().skip(11) {
        let found = localizer.add(&log.scans[i], log.motion(i));
        let error = found.pose.position().distance(mapped_pose.position());
        assert!(
            error < 0.15 && found.quality != Quality::Lost,
            "{i}: {error} {found:?}"
        );
    }
}
