//! Errors of logs, parameters and sessions: thing, value, limit, hint.

use thiserror::Error;

/// The reason why a log, a parameter or a session cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MappingError {
    /// A scan with an impossible number of beams.
    #[error("a scan has {n_beams} beams; it must have 1 to 100000")]
    BeamCount {
        /// The number of beams.
        n_beams: usize,
    },
    /// A scan whose beams cannot be placed.
    #[error(
        "a scan of {n_beams} beams from {first_angle_rad} rad in steps of {angle_step_rad} rad; \
         the step must be above 0 and at most 0.785, the whole at most a turn, all finite"
    )]
    ScanGeometry {
        /// Direction of the first beam.
        first_angle_rad: f64,
        /// Angle from beam to beam.
        angle_step_rad: f64,
        /// Number of beams.
        n_beams: usize,
    },
    /// Limits of ranges that contradict each other.
    #[error(
        "ranges from {min_m} m to {max_m} m, no return from {no_return_m} m on; they must be \
         0 <= least < greatest <= 10000, and the code above the least"
    )]
    RangeLimits {
        /// Least range.
        min_m: f64,
        /// Greatest range.
        max_m: f64,
        /// First range that means "no return".
        no_return_m: f64,
    },
    /// A line of a log that cannot be read.
    #[error("line {line}: {problem}")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// The problem, with the value and the limit.
        problem: String,
    },
    /// A log without scans.
    #[error(
        "the log has {n_lines} lines and no laser scan; hint: FLASER, ROBOTLASER1 and RAWLASER1 \
         lines of CARMEN are read"
    )]
    NoScans {
        /// Number of lines.
        n_lines: usize,
    },
    /// Beams that change within a log.
    #[error(
        "scan {scan} has {n_beams} beams, the scans before it have {expected}; hint: a log holds \
         the scans of one sensor"
    )]
    BeamsChange {
        /// Index of the scan.
        scan: usize,
        /// Its number of beams.
        n_beams: usize,
        /// The number of beams before.
        expected: usize,
    },
    /// Time that runs back.
    #[error(
        "scan {scan} at {time_s} s is {back_s} s earlier than the scan before it; at most 10 s are \
         sorted out; hint: join logs in the order of their times"
    )]
    TimeRunsBack {
        /// Index of the scan.
        scan: usize,
        /// Its time.
        time_s: f64,
        /// How much earlier it is.
        back_s: f64,
    },
    /// Odometry that no robot drives.
    #[error(
        "the odometry jumps {jump_m:.1} m before scan {scan}; at most {limit_m} m are believed; \
         hint: leave the odometry out (--no-odometry), or cut the log there"
    )]
    OdometryJumps {
        /// Index of the scan.
        scan: usize,
        /// Length of the jump.
        jump_m: f64,
        /// The largest that is believed.
        limit_m: f64,
    },
    /// A compressed file that is damaged or grows too large.
    #[error("the compressed log cannot be unpacked: {reason}")]
    Unpack {
        /// The reason.
        reason: String,
    },
    /// A parameter outside its range.
    #[error("{key} = {value}; it must be {range}")]
    Parameter {
        /// Name of the parameter, dotted.
        key: String,
        /// Its value.
        value: f64,
        /// Its range.
        range: String,
    },
    /// A session that cannot be read.
    #[error("the session cannot be read: {reason}")]
    Session {
        /// The reason, with value and limit.
        reason: String,
    },
    /// A log that does not go with a map or a session.
    #[error("{thing}: {value}; {limit}; hint: {hint}")]
    Mismatch {
        /// The thing that does not fit.
        thing: String,
        /// Its value.
        value: String,
        /// The limit.
        limit: String,
        /// A hint.
        hint: String,
    },
    /// A log that begins somewhere else than in the map.
    #[error(
        "the first {n_scans} scans of the log are found nowhere in the map; hint: --start X,Y,H \
         says where the drive begins, or the log belongs to another map"
    )]
    NotInMap {
        /// Number of scans that were searched.
        n_scans: usize,
    },
    /// A map larger than can be kept.
    #[error(
        "the map would be {width_m:.0} x {height_m:.0} m at {resolution_m} m per cell; at most \
         {limit} cells are kept; hint: a coarser resolution, or a smaller greatest range"
    )]
    MapTooLarge {
        /// Width.
        width_m: f64,
        /// Height.
        height_m: f64,
        /// Side of a cell.
        resolution_m: f64,
        /// The most cells.
        limit: usize,
    },
}
