//! Speeds and times along paths.

use formicar::motion::fastest;
use formicar::path::{CurvePath, Direction, SpeedLimits};
use formicar::{Pose2, Seed, Vehicle, VehicleParameters};

/// A path of lines, arcs and clothoids in both gears.
fn path(seed: u64) -> CurvePath {
    let mut stream = Seed(seed).stream([18, 0]);
    let mut path = CurvePath::new(Pose2::new(1.0, 2.0, stream.range(-3.0, 3.0)));
    let mut curvature = 0.0;
    for _ in 0..3 + stream.below(6) {
        let gear = [Direction::Forward, Direction::Reverse][stream.below(4) / 3];
        let length_m = stream.range(0.05, 6.0);
        match stream.below(3) {
            0 => {
                let next = stream.range(-0.4, 0.4);
                path.push_clothoid([curvature, next], length_m, gear);
                curvature = next;
            }
            1 => path.push(curvature, length_m, gear),
            _ => {
                curvature = [0.0, stream.range(-0.4, 0.4)][stream.below(2)];
                path.push(curvature, length_m, gear);
            }
        }
    }
    path
}

fn limits(seed: u64) -> SpeedLimits {
    let mut stream = Seed(seed).stream([18, 1]);
    SpeedLimits {
        max_speed_mps: stream.range(0.2, 4.0),
        max_lateral_mps2: stream.range(0.2, 3.0),
        max_acceleration_mps2: stream.range(0.1, 2.0),
        max_steer_rate_rad_per_s: (seed % 3 > 0).then(|| stream.range(0.1, 1.0)),
        ..SpeedLimits::default()
    }
}

/// Speed, time and standing time at each sample, and the time of the whole drive.
fn numbers(path: &CurvePath, vehicle: &Vehicle, limits: &SpeedLimits) -> (Vec<[f64; 3]>, f64) {
    let timed = fastest(path, vehicle, limits, 0.1);
    let poses = timed.timed_poses(0.1);
    let poses = poses.iter();
    let poses = poses.map(|p| [p.speed_mps, p.time_s, p.stands_s]).collect();
    (poses, timed.duration_s())
}

/// FNV-1a over the bits of all numbers.
fn hash(numbers: impl IntoIterator<Item = f64>) -> u64 {
    let bytes = numbers.into_iter().flat_map(|x| x.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[test]
fn a_drive_without_obstacles_keeps_the_numbers_on_record() {
    let found: Vec<_> = (0..RECORD.len() as u64)
        .map(|seed| {
            let (poses, travel_time_s) = numbers(&path(seed), &Vehicle::lei2020(), &limits(seed));
            (travel_time_s.to_bits(), hash(poses.into_iter().flatten()))
        })
        .collect();
    assert_eq!(found, RECORD, "{found:#x?}");
}

#[test]
fn a_vehicle_without_a_wheelbase_turns_no_wheels() {
    let vehicle = Vehicle::new(VehicleParameters {
        wheelbase_m: None,
        max_steer_rad: None,
        max_steer_deg: None,
        track_width_m: None,
        min_turning_radius_m: Some(2.0),
        footprint: Some(formicar::vehicle::FootprintSpec::Points(vec![
            [0.0, 0.5],
            [2.0, 0.5],
            [2.0, -0.5],
            [0.0, -0.5],
        ])),
        ..Vehicle::lei2020().parameters().clone()
    })
    .unwrap();
    let (poses, _) = numbers(&path(1), &vehicle, &limits(1));
    assert!(poses.iter().all(|[_, _, stands_s]| *stands_s == 0.0));
}

/// Bits of the travel time, and the hash of all poses.
const RECORD: [(u64, u64); 16] = [
    (0x4040_0741_a53b_ecb9, 0xe83a_8b63_02d5_b2ed),
    (0x4031_13fb_4153_8c5b, 0xe5c0_288d_3c88_0fd9),
    (0x402d_cdf8_e699_2d65, 0x2718_61bc_5a29_b177),
    (0x401b_3b94_3e75_69f4, 0xac2e_c449_ffa1_159c),
    (0x4033_7417_fe83_ecce, 0x3dc5_159c_c282_0e91),
    (0x4031_17e4_9e14_093c, 0x8266_395f_3c87_7051),
    (0x403b_e0fc_b069_e22f, 0x75f8_5a35_96b8_89f9),
    (0x4021_afda_dec8_b851, 0x9186_f9ed_a157_7b45),
    (0x403a_24a2_c4d5_04d6, 0x90cc_b52f_4401_b5ca),
    (0x4028_789f_d61b_91ad, 0xf443_bf31_1b56_e1f2),
    (0x402c_067b_5a5e_c531, 0xb50d_8ed4_35ba_4ce0),
    (0x4031_cdae_bd79_0e25, 0x70f3_a43b_5493_f865),
    (0x4020_4846_c224_885a, 0xba6a_79fc_4387_5faf),
    (0x4049_7feb_bdc1_ec57, 0x2140_ce7d_ec10_f70d),
    (0x403f_6711_fd10_46a6, 0x1429_a8a3_05f4_dc5d),
    (0x3ff6_bae6_ff3a_13f4, 0x967a_06ad_71ee_ce1b),
];
