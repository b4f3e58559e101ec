//! Costmap values of ROS navigation.

use super::{GridFrame, MapError, OCCUPIED, OccupancyGrid, UNKNOWN};

const INSCRIBED: u8 = 253;
const LETHAL: u8 = 254;
const NO_INFORMATION: u8 = 255;

impl OccupancyGrid {
    /// A grid from the values of a ROS costmap, row-major, row 0 (bottom) first.
    ///
    /// 0 is free, 1 to 252 become 1 to 98 in proportion, 253 (inscribed) 99, 254 (lethal) 100,
    /// and 255 unknown, as Nav2 publishes costmaps.
    ///
    /// # Errors
    /// As many values as cells are needed.
    pub fn from_costmap_values(frame: GridFrame, costs: &[u8]) -> Result<Self, MapError> {
        Self::new(frame, costs.iter().map(|&cost| value(cost)).collect())
    }
}

fn value(cost: u8) -> i8 {
    match cost {
        0 => 0,
        INSCRIBED => OCCUPIED - 1,
        LETHAL => OCCUPIED,
        NO_INFORMATION => UNKNOWN,
        // 1..=252 to 1..=98; at most 98, so that no value is lost.
        cost => (1 + 97 * (i32::from(cost) - 1) / 251) as i8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose2;

    #[test]
    fn keeps_the_landmarks_and_the_order() {
        let landmarks = [0, 1, 127, 252, 253, 254, 255].map(value);
        assert_eq!(landmarks, [0, 1, 49, 98, 99, 100, -1]);
        assert!((0..254).all(|cost| value(cost) <= value(cost + 1)));
    }

    #[test]
    fn needs_a_value_for_each_cell() {
        let frame = GridFrame::new(2, 1, 1.0, Pose2::default()).unwrap();
        let grid = OccupancyGrid::from_costmap_values(frame, &[254, 255]).unwrap();
        assert_eq!(grid.values(), [100, -1]);
        assert!(OccupancyGrid::from_costmap_values(frame, &[0]).is_err());
    }
}
