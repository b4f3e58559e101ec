//! Logs of real robots, where they are at hand.

use crate::drives::{first, mapped};
use formicar_mapping::MappingConfig;
use formicar_mapping::evaluate::{neighbor_pairs, relation_errors};
use formicar_mapping::front_end::Quality;
use formicar_mapping::log::carmen::parse_carmen;
use std::path::Path;

#[test]
fn the_first_scans_of_the_intel_lab_agree_with_gmapping() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = path.join("../../../shared/data/lidar/intel-corrected.log.gz");
    let Ok(bytes) = std::fs::read(&path) else {
        println!("skipped: {} is not there", path.display());
        return;
    };
    let log = parse_carmen(&bytes).unwrap();
    assert_eq!((log.scans.len(), log.scans[0].ranges_m.len()), (910, 180));
    let log = first(&log, 150);
    let reference = log.reference.clone().unwrap();
    let (mapper, built) = mapped(&log, MappingConfig::default());
    let errors = relation_errors(&built.trajectory, &reference, &neighbor_pairs(150));
    assert!(errors.mean_m < 0.04 && errors.mean_deg < 0.6, "{errors:?}");
    assert!(
        mapper
            .places()
            .iter()
            .all(|place| place.quality != Quality::Lost)
    );
}
