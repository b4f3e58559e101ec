//! `builtin_interfaces` and `std_msgs`.

use super::field::messages;

messages! { "builtin_interfaces":
    /// A point in time.
    Time {
        /// Seconds.
        sec: i32,
        /// Nanoseconds on top, below 10⁹.
        nanosec: u32,
    }

    /// A span of time.
    Duration {
        /// Seconds.
        sec: i32,
        /// Nanoseconds on top, below 10⁹.
        nanosec: u32,
    }
}

messages! { "std_msgs":
    /// Time and coordinate frame of a message.
    Header {
        /// Time of the data.
        stamp: Time,
        /// Frame of its coordinates.
        frame_id: String,
    }

    /// A color; components are 0 to 1.
    ColorRGBA {
        /// Red.
        r: f32,
        /// Green.
        g: f32,
        /// Blue.
        b: f32,
        /// Opacity.
        a: f32,
    }
}

impl Time {
    /// The time in seconds.
    pub fn seconds(&self) -> f64 {
        f64::from(self.sec) + 1e-9 * f64::from(self.nanosec)
    }

    /// The time of so many nanoseconds; later ones than 2038 are cut off there.
    pub fn of_nanoseconds(ns: u64) -> Self {
        const SECOND: u64 = 1_000_000_000;
        Self {
            sec: i32::try_from(ns / SECOND).unwrap_or(i32::MAX),
            nanosec: (ns % SECOND) as u32,
        }
    }
}

impl Header {
    /// A header of a frame.
    pub fn new(frame_id: &str, stamp: Time) -> Self {
        Self {
            stamp,
            frame_id: frame_id.to_owned(),
        }
    }
}
