//! `sensor_msgs`.

use super::common::Header;
use super::field::messages;

messages! { "sensor_msgs":
    /// One sweep of a planar laser scanner.
    LaserScan {
        /// Time of the first beam, and the frame of the sensor.
        header: Header,
        /// Direction of the first beam, radians.
        angle_min: f32,
        /// Direction of the last beam, radians.
        angle_max: f32,
        /// Angle from beam to beam, radians; below 0 clockwise.
        angle_increment: f32,
        /// Time from beam to beam, seconds.
        time_increment: f32,
        /// Time from scan to scan, seconds.
        scan_time: f32,
        /// Least range, meters.
        range_min: f32,
        /// Greatest range, meters.
        range_max: f32,
        /// Ranges, meters; those out of the limits are no measurements.
        ranges: Vec<f32>,
        /// Intensities, or nothing.
        intensities: Vec<f32>,
    }

    /// An image as the bytes of a file.
    CompressedImage {
        /// Time and frame.
        header: Header,
        /// Format of the bytes.
        format: String,
        /// The bytes.
        data: Vec<u8>,
    }
}
