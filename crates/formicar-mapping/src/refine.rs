//! Refinement: one map of all scans, to which each scan is matched again, in turns.

use crate::config::MappingConfig;
use crate::front_end::Node;
use crate::matching::{Prior, align};
use crate::matrix::Sym3;
use crate::sdf::SdfMap;
use formicar::Pose2;

/// Standard deviation with which a scan is held at its pose, meters and radians.
const HELD: (f64, f64) = (0.1, 0.1);

/// One map of all scans at poses.
pub fn whole_map(nodes: &[Node], poses: &[Pose2], config: &MappingConfig) -> SdfMap {
    let mut map = SdfMap::new(config.resolution_m, config.truncation_m());
    for (node, &pose) in nodes.iter().zip(poses) {
        config.insertion.insert(&mut map, &node.sweep, pose);
    }
    map
}

/// A round: the poses at which the scans fit the map of all of them.
pub fn refined(
    map: &SdfMap,
    nodes: &[Node],
    poses: &[Pose2],
    config: &MappingConfig,
) -> Vec<Pose2> {
    let hold = Sym3::diagonal(HELD.0.powi(-2), HELD.0.powi(-2), HELD.1.powi(-2));
    let pairs = nodes.iter().zip(poses);
    pairs
        .map(|(node, &pose)| {
            let hits = config.hits(&node.sweep);
            let prior = Prior {
                pose,
                information: hold,
            };
            align(map, &hits, pose, Some(&prior), &config.align).pose
        })
        .collect()
}
