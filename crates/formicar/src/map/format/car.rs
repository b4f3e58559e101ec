//! Car scenario files: pose pairs for vehicles on maps, as JSON.

use super::files::{MAX_TEXT_BYTES, read_bytes, text};
use super::{FormatError, FormatProblem, Place};
use crate::geometry::{MAX_STATED_HEADING_RAD, Pose2};
use crate::vehicle::{Vehicle, VehicleParameters};
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// One question of a car scenario file.
#[derive(Clone, Debug, PartialEq)]
pub struct CarScenario {
    /// Its name, unique in its file.
    pub id: String,
    /// The map, found from the folder that the scenario file lies in.
    pub map: PathBuf,
    /// Rear-axle pose at the beginning.
    pub start: Pose2,
    /// Rear-axle pose at the end.
    pub goal: Pose2,
    /// The vehicle; its measures have been checked.
    pub vehicle: VehicleParameters,
}

/// Reads a car scenario file.
///
/// # Errors
/// A file that cannot be read, and whatever [`parse_car_scenarios`] refuses.
pub fn read_car_scenarios(path: &Path) -> Result<Vec<CarScenario>, FormatError> {
    let bytes = read_bytes(path, MAX_TEXT_BYTES)?;
    text(&bytes, "car scenarios as JSON")
        .and_then(|json| parse_car_scenarios(json, &path.with_file_name("")))
        .map_err(|e| e.in_file(path))
}

#[derive(serde::Deserialize)]
struct CarFile {
    version: u64,
    scenarios: Vec<Entry>,
}

#[derive(serde::Deserialize)]
struct Entry {
    id: String,
    map: PathBuf,
    start: [f64; 3],
    goal: [f64; 3],
    vehicle: Map<String, Value>,
}

/// Reads the JSON of a car scenario file whose maps are named relative to `folder`.
///
/// # Errors
/// No JSON of this form, a version other than 1, an id that stands twice, or an impossible
/// vehicle: besides [`Vehicle::new`]'s rules, `length` must be wheelbase and overhangs together
/// and `reference` the rear axle.
pub fn parse_car_scenarios(json: &str, folder: &Path) -> Result<Vec<CarScenario>, FormatError> {
    let file: CarFile = serde_json::from_str(json).map_err(at_line)?;
    if file.version != 1 {
        return Err(FormatProblem::bad_value("version", file.version, "1").into());
    }
    let mut ids: Vec<&str> = file.scenarios.iter().map(|s| s.id.as_str()).collect();
    ids.sort_unstable();
    if let Some(pair) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(FormatProblem::bad_value("a scenario's id", pair[0], "unique").into());
    }
    file.scenarios
        .into_iter()
        .map(|entry| scenario(entry, folder))
        .collect()
}

fn scenario(entry: Entry, folder: &Path) -> Result<CarScenario, FormatError> {
    let pose = |[x, y, heading]: [f64; 3]| Pose2::new(x, y, heading);
    let id = entry.id;
    let checked = check_headings([entry.start, entry.goal]).and_then(|()| vehicle(entry.vehicle));
    match checked {
        Ok(vehicle) => Ok(CarScenario {
            map: folder.join(entry.map),
            start: pose(entry.start),
            goal: pose(entry.goal),
            vehicle,
            id,
        }),
        Err(problem) => {
            let problem = Box::new(problem);
            Err(FormatProblem::Scenario { id, problem }.into())
        }
    }
}

/// Refuses headings beyond a turn, which are in degrees.
fn check_headings(poses: [[f64; 3]; 2]) -> Result<(), FormatProblem> {
    for ([_, _, heading], thing) in poses.into_iter().zip(["start heading", "goal heading"]) {
        if heading.abs() > MAX_STATED_HEADING_RAD {
            let radians = heading.to_radians();
            let expected =
                format!("in radians, within a turn; hint: {heading} degrees are {radians:.4}");
            return Err(FormatProblem::bad_value(thing, heading, expected));
        }
    }
    Ok(())
}

fn vehicle(mut measures: Map<String, Value>) -> Result<VehicleParameters, FormatProblem> {
    let length = measures.remove("length");
    let reference = measures.remove("reference");
    if let Some(reference) = reference.filter(|r| r != "rear_axle") {
        let thing = "the vehicle's reference";
        return Err(FormatProblem::bad_value(thing, reference, "\"rear_axle\""));
    }
    let parameters: VehicleParameters =
        serde_json::from_value(Value::Object(measures)).map_err(FormatProblem::Json)?;
    if let Some(length) = length {
        check_length(&length, &parameters)?;
    }
    Vehicle::new(parameters.clone()).map_err(FormatProblem::Vehicle)?;
    Ok(parameters)
}

fn check_length(length: &Value, p: &VehicleParameters) -> Result<(), FormatProblem> {
    let (Some(wheelbase), Some(front), Some(rear)) =
        (p.wheelbase_m, p.front_overhang_m, p.rear_overhang_m)
    else {
        let thing = "what the vehicle's length is made of";
        let hint = "give wheelbase, front_overhang and rear_overhang, or leave length out";
        return Err(FormatProblem::Missing { thing, hint });
    };
    let sum = wheelbase + front + rear;
    match length.as_f64() {
        Some(length) if (length - sum).abs() <= 1e-6 * sum.abs() => Ok(()),
        _ => Err(FormatProblem::bad_value(
            "the vehicle's length",
            length,
            format!("{sum} m, its wheelbase and overhangs together"),
        )),
    }
}

fn at_line(error: serde_json::Error) -> FormatError {
    let line = error.line();
    let error = FormatError::from(FormatProblem::Json(error));
    if line == 0 {
        error
    } else {
        error.at(Place::Line(line))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAR: &str = r#""wheelbase": 2, "max_steer_deg": 40, "r_min": 2.38350718518842,
        "width": 1, "rear_overhang": 0.5, "front_overhang": 0.5"#;

    fn file(vehicle: &str) -> String {
        format!(
            r#"{{"version": 1, "scenarios": [{{"id": "a", "map": "m.yaml",
            "start": [1, 2, 0.5], "goal": [3, 4, -1], "vehicle": {{{vehicle}}}}}]}}"#
        )
    }

    fn message(json: &str) -> String {
        parse_car_scenarios(json, Path::new(""))
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn reads_both_kinds_of_vehicle() {
        let json = file(&format!(r#"{CAR}, "length": 3, "reference": "rear_axle""#));
        let scenarios = parse_car_scenarios(&json, Path::new("data")).unwrap();
        assert_eq!(scenarios[0].map, Path::new("data/m.yaml"));
        assert_eq!(scenarios[0].goal, Pose2::new(3.0, 4.0, -1.0));
        let shape =
            r#""footprint": [[1, 0.5], [-1, 0.5], [-1, -0.5], [1, -0.5]], "min_turning_radius": 2"#;
        assert!(parse_car_scenarios(&file(shape), Path::new("")).is_ok());
    }

    #[test]
    fn says_what_is_wrong() {
        assert!(
            message(&file(&format!(r#"{CAR}, "length": 4"#)))
                .contains("length is 4; it must be 3 m")
        );
        let front = format!(r#"{CAR}, "reference": "front_axle""#);
        assert!(message(&file(&front)).contains("rear_axle"));
        assert!(message(&file(r#""wheels": 3"#)).contains("wheels"));
        assert!(
            message(&file(r#""wheelbase": -2"#))
                .contains(r#"scenario "a": vehicle wheelbase_m = -2"#)
        );
        assert!(message(r#"{"version": 2, "scenarios": []}"#).contains("version is 2"));
        assert!(message("{\n\"version\": 1,\n").contains("line 3"));
        assert!(message(r#"{"version": 1}"#).contains("scenarios"));
        let twice = file(CAR).replace("}}]}", "}}, ");
        let twice = format!("{twice}{}", file(CAR).split_once('[').unwrap().1);
        assert!(message(&twice).contains("unique"), "{}", message(&twice));
    }
}
