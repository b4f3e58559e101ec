//! Parsers for the values of flags: poses, angles, polygons, words.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use formicar::geometry::{Point2, Pose2};
use formicar::path::Spacing;
use formicar::scenario::{GoalTolerance, ViaPoint};
use formicar::tracking::StartOffset;
use serde::de::DeserializeOwned;
use std::ops::RangeInclusive;

/// A finite number.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let value: f64 = text
        .trim()
        .parse()
        .map_err(|_| format!("{text:?} is not a number"))?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(format!("{text:?} is not finite"))
    }
}

/// An angle in radians, or in degrees with `deg` behind it.
fn angle(text: &str) -> Result<f64, String> {
    match text.trim().strip_suffix("deg") {
        Some(degrees) => number(degrees).map(f64::to_radians),
        None => number(text),
    }
}

/// The numbers of a list, of which there must be some number.
fn list<'a>(
    text: &'a str,
    n: RangeInclusive<usize>,
    expected: &str,
) -> Result<Vec<&'a str>, String> {
    let parts: Vec<&str> = text.split(',').collect();
    if n.contains(&parts.len()) {
        return Ok(parts);
    }
    Err(format!("{} numbers; expected {expected}", parts.len()))
}

/// `X,Y,H`: meters, meters, radians (or `90deg`).
pub(crate) fn pose(text: &str) -> Result<Pose2, String> {
    let expected = "X,Y,HEADING in meters and radians, for instance 2,3,90deg";
    let parts = list(text, 3..=3, expected)?;
    Ok(Pose2::new(
        number(parts[0])?,
        number(parts[1])?,
        angle(parts[2])?,
    ))
}

/// `X,Y`, meters.
pub(crate) fn point(text: &str) -> Result<Point2, String> {
    let Some((x, y)) = text.split_once(',') else {
        return Err("expected X,Y in meters, for instance 2,3.5".to_owned());
    };
    Ok(Point2::new(number(x)?, number(y)?))
}

/// `X,Y[,H]`: meters, meters, radians (or `90deg`).
pub(crate) fn via(text: &str) -> Result<ViaPoint, String> {
    let expected = "X,Y or X,Y,HEADING in meters and radians, for instance 2,3,90deg";
    let parts = list(text, 2..=3, expected)?;
    let via = ViaPoint::new(Point2::new(number(parts[0])?, number(parts[1])?));
    Ok(match parts.get(2) {
        Some(heading) => via.with_heading(angle(heading)?),
        None => via,
    })
}

/// A rate of turn above 0, radians per second (or `30deg`).
pub(crate) fn turn_rate(text: &str) -> Result<f64, String> {
    above_0(angle(text)?)
}

/// `LEFT[,TURN[,AHEAD]]`: meters, radians (or `5deg`), meters.
pub(crate) fn start_offset(text: &str) -> Result<StartOffset, String> {
    let expected = "LEFT[,TURN[,AHEAD]] in meters and radians, for instance 0.2,5deg";
    let parts = list(text, 1..=3, expected)?;
    let part = |i: usize| parts.get(i).copied().unwrap_or("0");
    Ok(StartOffset {
        lateral_m: number(part(0))?,
        heading_rad: angle(part(1))?,
        along_m: number(part(2))?,
    })
}

/// A limit of search steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Budget {
    None,
    Steps(u64),
}

/// A number of steps, or `none`.
pub(crate) fn budget(text: &str) -> Result<Budget, String> {
    if text == "none" {
        return Ok(Budget::None);
    }
    let steps = text.parse().map(Budget::Steps);
    steps.map_err(|_| format!("{text:?} is no number of steps; hint: 200000, or none for no limit"))
}

/// `M[,RAD]`: the most meters and radians (or `10deg`) between two poses.
pub(crate) fn spacing(text: &str) -> Result<Spacing, String> {
    let expected = "M or M,RAD: meters and radians, for instance 0.05,5deg";
    let parts = list(text, 1..=2, expected)?;
    let usual = Spacing::default();
    let spacing = Spacing {
        max_m: number(parts[0])?,
        max_turn_rad: parts
            .get(1)
            .map_or(Ok(usual.max_turn_rad), |turn| angle(turn))?,
    };
    spacing
        .check()
        .map_err(|error| format!("{error}; hint: 0.05 or 0.05,5deg"))?;
    Ok(spacing)
}

/// `M,RAD`, both above 0.
pub(crate) fn goal_tolerance(text: &str) -> Result<GoalTolerance, String> {
    let Some((xy, yaw)) = text.split_once(',') else {
        return Err("expected M,RAD: meters and radians, for instance 0.1,5deg".to_owned());
    };
    let tolerance = GoalTolerance {
        xy_m: number(xy)?,
        yaw_rad: angle(yaw)?,
    };
    if tolerance.xy_m > 0.0 && tolerance.yaw_rad > 0.0 {
        Ok(tolerance)
    } else {
        Err("both must be above 0".to_owned())
    }
}

/// `"x,y x,y x,y"` or `[[x, y], ...]`: at least three corners, in meters.
pub(crate) fn polygon(text: &str) -> Result<Vec<Point2>, String> {
    let points: Vec<Point2> = if text.trim_start().starts_with('[') {
        let pairs: Vec<[f64; 2]> =
            serde_json::from_str(text).map_err(|e| format!("{e}; expected [[x, y], ...]"))?;
        pairs.into_iter().map(|[x, y]| Point2::new(x, y)).collect()
    } else {
        let corner = |pair: &str| {
            let (x, y) = pair
                .split_once(',')
                .ok_or_else(|| format!("{pair:?} is not x,y"))?;
            Ok(Point2::new(number(x)?, number(y)?))
        };
        text.split_whitespace()
            .map(corner)
            .collect::<Result<_, String>>()?
    };
    if points.len() < 3 {
        return Err(format!(
            "{} corners; a polygon has at least 3, for instance \"0,0 2,0 2,1\"",
            points.len()
        ));
    }
    Ok(points)
}

/// A time above 0, in milliseconds: `5s`, `800ms`, or a bare number of milliseconds.
pub(crate) fn milliseconds(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let (digits, ms_per_unit) = if let Some(digits) = text.strip_suffix("ms") {
        (digits, 1.0)
    } else if let Some(digits) = text.strip_suffix('s') {
        (digits, 1e3)
    } else {
        (text, 1.0)
    };
    let value = number(digits).map_err(|e| format!("{e}; expected a time as 800ms or 5s"))?;
    above_0(value * ms_per_unit)
}

/// A finite number above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    above_0(number(text)?)
}

fn above_0(value: f64) -> Result<f64, String> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err("it must be above 0 and finite".to_owned())
    }
}

/// A finite number, at least 0.
pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value >= 0.0 {
        Ok(value)
    } else {
        Err("it must be at least 0".to_owned())
    }
}

/// A word of an enum of the library, spelled as in files.
pub(crate) fn word<T>(words: &'static [&'static str]) -> impl TypedValueParser<Value = T>
where
    T: DeserializeOwned + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(words).try_map(|word| serde_json::from_value::<T>(word.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::scenario::GoalHeading;

    #[test]
    fn reads_poses_in_radians_and_degrees() {
        assert_eq!(pose("-2,3.5,-1").unwrap(), Pose2::new(-2.0, 3.5, -1.0));
        let up = pose("0, 0, 90deg").unwrap();
        assert_eq!(up.heading, std::f64::consts::FRAC_PI_2);
    }

    #[test]
    fn refuses_malformed_poses() {
        for bad in [
            "", "1,2", "1,2,3,4", "a,2,3", "nan,0,0", "1,inf,0", "1,2,deg",
        ] {
            assert!(pose(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn reads_offsets_of_one_to_three_numbers() {
        let all = start_offset("-0.2,90deg,1").unwrap();
        assert_eq!((all.lateral_m, all.along_m), (-0.2, 1.0));
        assert_eq!(all.heading_rad, std::f64::consts::FRAC_PI_2);
        let left = start_offset("0.5").unwrap();
        assert_eq!(
            (left.lateral_m, left.heading_rad, left.along_m),
            (0.5, 0.0, 0.0)
        );
        for bad in ["", "1,2,3,4", "a", "1,nan"] {
            assert!(start_offset(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn reads_polygons_in_both_ways() {
        let plain = polygon("0,0 2,0 2,-1").unwrap();
        assert_eq!(plain, polygon("[[0, 0], [2, 0], [2, -1]]").unwrap());
        for bad in [
            "0,0 1,1",
            "0,0 1 2,2",
            "[[0,0],[1,1]]",
            "[[0]]",
            "0,0 1,1 2,nan",
        ] {
            assert!(polygon(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn reads_times_in_seconds_and_milliseconds() {
        for (text, expected) in [
            ("800", 800.0),
            ("800ms", 800.0),
            ("5s", 5e3),
            ("0.5 s", 500.0),
        ] {
            assert_eq!(milliseconds(text), Ok(expected), "{text}");
        }
        for bad in ["", "s", "5 min", "-1s", "0ms", "inf", "1e308s"] {
            assert!(milliseconds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn words_are_those_of_files() {
        let parser = word::<GoalHeading>(&["exact", "bidirectional", "any"]);
        let command = clap::Command::new("test").arg(clap::Arg::new("w").value_parser(parser));
        let matches = command.try_get_matches_from(["test", "any"]).unwrap();
        assert_eq!(matches.get_one::<GoalHeading>("w"), Some(&GoalHeading::Any));
    }
}
