//! The campaign file: TOML, with the place of everything in it.

use super::mistake::Text;
use super::scenarios::ScenariosEntry;
use super::seeds::seeds;
use anyhow::Result;
use formicar::planner::PlannerName;
use formicar::vehicle::Gears;
use serde::Deserialize;
use std::str::FromStr;
use toml::{Spanned, Value};

/// The contents of a campaign file; names in it that stand for files are not looked up yet.
#[derive(Clone, Debug)]
pub struct Document {
    /// The file.
    pub text: Text,
    /// The campaign's name.
    pub name: Option<String>,
    /// The seeds, in order.
    pub seeds: Vec<u64>,
    /// Motion modes, in order.
    pub motions: Vec<Gears>,
    /// Search steps after which a run gives up.
    pub budget_steps: Option<u64>,
    /// Time after which a run gives up, milliseconds.
    pub deadline_ms: Option<f64>,
    /// True if the first query of a planner counts.
    pub is_cold: bool,
    /// `own`, presets and vehicle files.
    pub vehicles: Vec<Spanned<String>>,
    /// Sources of scenarios.
    pub scenarios: Vec<ScenariosEntry>,
    /// The planners.
    pub planners: Vec<PlannerEntry>,
}

/// A planner of a campaign file.
#[derive(Clone, Debug)]
pub struct PlannerEntry {
    /// The name it goes by.
    pub name: Spanned<String>,
    /// The built-in planner.
    pub planner: PlannerName,
    /// A configuration file, or parameters in place.
    pub config: Option<Spanned<Value>>,
    /// Single parameters as KEY=VALUE.
    pub set: Vec<Spanned<String>>,
    /// The program that plans in the planner's place, and its arguments.
    pub command: Option<Vec<String>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    name: Option<String>,
    seeds: Option<Spanned<Value>>,
    motion: Option<Spanned<Value>>,
    budget_steps: Option<Spanned<u64>>,
    deadline_ms: Option<Spanned<f64>>,
    #[serde(default)]
    cold: bool,
    #[serde(default)]
    vehicles: Vec<Spanned<String>>,
    #[serde(default)]
    scenarios: Vec<Spanned<ScenariosEntry>>,
    #[serde(default, rename = "planner")]
    planners: Vec<Spanned<RawPlanner>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPlanner {
    name: Option<Spanned<String>>,
    planner: Option<Spanned<String>>,
    command: Option<Spanned<Vec<String>>>,
    config: Option<Spanned<Value>>,
    #[serde(default)]
    set: Vec<Spanned<String>>,
}

impl Document {
    /// Reads a campaign file.
    ///
    /// # Errors
    /// The mistake, with file, line, key, and what is allowed there.
    pub fn read(text: Text) -> Result<Self> {
        let raw: Raw = toml::from_str(&text.text).map_err(|error| text.refused(&error))?;
        if raw.scenarios.is_empty() {
            let what = "no scenarios; expected [[scenarios]] with builtin or file";
            return Err(text.mistake(None, what));
        }
        for entry in &raw.scenarios {
            entry.get_ref().check(entry.span(), &text)?;
        }
        Ok(Self {
            seeds: seeds(raw.seeds.as_ref(), &text)?,
            motions: motions(raw.motion.as_ref(), &text)?,
            budget_steps: positive(raw.budget_steps, &text)?,
            deadline_ms: positive(raw.deadline_ms, &text)?,
            planners: planners(raw.planners, &text)?,
            name: raw.name,
            is_cold: raw.cold,
            vehicles: raw.vehicles,
            scenarios: raw.scenarios.into_iter().map(Spanned::into_inner).collect(),
            text,
        })
    }
}

/// A number above 0.
fn positive<T>(value: Option<Spanned<T>>, text: &Text) -> Result<Option<T>>
where
    T: PartialOrd + Default + Copy + std::fmt::Display,
{
    match value {
        Some(number)
            if number.get_ref().partial_cmp(&T::default()) != Some(std::cmp::Ordering::Greater) =>
        {
            let what = format!("{}; expected a number above 0", number.get_ref());
            Err(text.mistake(Some(number.span()), what))
        }
        other => Ok(other.map(Spanned::into_inner)),
    }
}

/// One motion mode or a list of them; both gears where nothing is said.
fn motions(value: Option<&Spanned<Value>>, text: &Text) -> Result<Vec<Gears>> {
    let Some(value) = value else {
        return Ok(vec![Gears::default()]);
    };
    let expected = "expected \"reverse\" (both gears), \"forward\", or a list of both";
    let words = match value.get_ref() {
        Value::Array(list) => &list[..],
        word => std::slice::from_ref(word),
    };
    let modes: Option<Vec<Gears>> = words.iter().map(motion).collect();
    let Some(modes) = modes.filter(|modes| !modes.is_empty()) else {
        return Err(text.mistake(Some(value.span()), expected));
    };
    let twice = (1..modes.len()).find(|&i| modes[..i].contains(&modes[i]));
    match twice {
        Some(i) => {
            let what = format!("{} stands there twice; {expected}", words[i]);
            Err(text.mistake(Some(value.span()), what))
        }
        None => Ok(modes),
    }
}

fn motion(value: &Value) -> Option<Gears> {
    match value.as_str()? {
        "forward" => Some(Gears::Forward),
        "reverse" => Some(Gears::Both),
        _ => None,
    }
}

/// The planners, each under a name of its own; the default one where there are none.
fn planners(raw: Vec<Spanned<RawPlanner>>, text: &Text) -> Result<Vec<PlannerEntry>> {
    let mut entries: Vec<PlannerEntry> = Vec::new();
    for entry in raw {
        let span = entry.span();
        let raw = entry.into_inner();
        let (name, planner) = match (&raw.planner, &raw.command) {
            (Some(word), None) => {
                let planner = PlannerName::from_str(word.get_ref());
                let planner = planner.map_err(|e| text.mistake(Some(word.span()), e))?;
                (raw.name.unwrap_or_else(|| word.clone()), planner)
            }
            (None, Some(command)) => {
                check_command(command, &raw, text)?;
                let missing = || {
                    text.mistake(
                        Some(command.span()),
                        "a program needs a name; hint: name = \"NAME\"",
                    )
                };
                (raw.name.ok_or_else(missing)?, PlannerName::default())
            }
            _ => {
                let what = "expected either planner = \"NAME\" or command = [\"PROGRAM\", ...]";
                return Err(text.mistake(Some(span), what));
            }
        };
        let is_name = |c: char| c.is_alphanumeric() || "-_.+ ".contains(c);
        if name.get_ref().is_empty() || !name.get_ref().chars().all(is_name) {
            let what = "expected letters, digits and any of - _ . + and space";
            return Err(text.mistake(Some(name.span()), what));
        }
        if entries
            .iter()
            .any(|other| other.name.get_ref() == name.get_ref())
        {
            let what = format!(
                "two planners are named {:?}; hint: name = \"ANOTHER\"",
                name.get_ref()
            );
            return Err(text.mistake(Some(name.span()), what));
        }
        entries.push(PlannerEntry {
            name,
            planner,
            config: raw.config,
            set: raw.set,
            command: raw.command.map(Spanned::into_inner),
        });
    }
    if entries.is_empty() {
        entries.push(PlannerEntry {
            name: Spanned::new(0..0, PlannerName::default().name().to_owned()),
            planner: PlannerName::default(),
            config: None,
            set: Vec::new(),
            command: None,
        });
    }
    Ok(entries)
}

/// Refuses a program without a word, and parameters of ours for it.
fn check_command(command: &Spanned<Vec<String>>, raw: &RawPlanner, text: &Text) -> Result<()> {
    if command.get_ref().first().is_none_or(String::is_empty) {
        let what = "expected the program and its arguments, [\"PROGRAM\", ...]";
        return Err(text.mistake(Some(command.span()), what));
    }
    let of_ours = raw.config.as_ref().map(Spanned::span);
    let of_ours = of_ours.or_else(|| raw.set.first().map(Spanned::span));
    match of_ours {
        Some(span) => {
            let what = "a program has its own parameters; hint: write them into command";
            Err(text.mistake(Some(span), what))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENARIOS: &str = "[[scenarios]]\nbuiltin = [\"narrow\"]\n";

    fn read(text: &str) -> Result<Document> {
        Document::read(Text {
            name: "c.toml".to_owned(),
            text: text.to_owned(),
        })
    }

    #[test]
    fn what_is_left_out_is_the_default() {
        let document = read(SCENARIOS).unwrap();
        assert_eq!(document.seeds, [0]);
        assert_eq!(document.motions, [Gears::Both]);
        assert_eq!(document.planners[0].name.get_ref(), "formicar");
        assert!(document.vehicles.is_empty() && !document.is_cold);
    }

    /// Every text is refused in the words beside it.
    fn assert_told(cases: &[(&str, &str)]) {
        for (text, told) in cases {
            let error = read(&format!("{text}{SCENARIOS}")).unwrap_err().to_string();
            assert!(
                error.starts_with("c.toml, line ") && error.contains(told),
                "{error}"
            );
        }
    }

    #[test]
    fn mistakes_in_planners_name_file_line_key_and_what_is_allowed() {
        assert_told(&[
            (
                "[[planner]]\nplanner = \"rrt\"\n",
                "line 2, planner: no planner is named \"rrt\"; there are formicar, hybrid-astar",
            ),
            (
                "[[planner]]\nname = \"a\"\n",
                "line 1, [[planner]]: expected either planner = \"NAME\" or command",
            ),
            (
                "[[planner]]\nplanner = \"astar\"\nweight = 2\n",
                "line 3, weight: unknown field `weight`, expected one of `name`, `planner`, `command`, `config`, `set`",
            ),
            (
                "[[planner]]\nplanner = \"astar\"\n[[planner]]\nplanner = \"astar\"\n",
                "line 4, planner: two planners are named \"astar\"",
            ),
            (
                "[[planner]]\nplanner = \"astar\"\nname = \"a/b\"\n",
                "line 3, name: expected letters",
            ),
            (
                "[[planner]]\nplanner = \"astar\"\ncommand = [\"x\"]\n",
                "line 1, [[planner]]: expected either planner",
            ),
            (
                "[[planner]]\nname = \"x\"\ncommand = []\n",
                "line 3, command: expected the program and its arguments",
            ),
            (
                "[[planner]]\ncommand = [\"x\"]\n",
                "line 2, command: a program needs a name",
            ),
            (
                "[[planner]]\nname = \"x\"\ncommand = [\"x\"]\nset = [\"a=1\"]\n",
                "line 4, set: a program has its own parameters",
            ),
        ]);
    }

    #[test]
    fn mistakes_name_file_line_key_and_what_is_allowed() {
        let cases = [
            (
                "sedes = 3\n",
                "c.toml, line 1, sedes: unknown field `sedes`, expected one of `name`, `seeds`",
            ),
            (
                "\nbudget_steps = 0\n",
                "line 2, budget_steps: 0; expected a number above 0",
            ),
            (
                "deadline_ms = nan\n",
                "line 1, deadline_ms: NaN; expected a number above 0",
            ),
            (
                "budget_steps = \"much\"\n",
                "line 1, budget_steps: invalid type: string \"much\", expected u64",
            ),
            (
                "cold = 1\n",
                "line 1, cold: invalid type: integer `1`, expected a boolean",
            ),
            (
                "motion = \"back\"\n",
                "line 1, motion: expected \"reverse\" (both gears), \"forward\"",
            ),
            (
                "motion = [\"reverse\", \"reverse\"]\n",
                "line 1, motion: \"reverse\" stands there twice",
            ),
            ("motion = []\n", "a list of both"),
            (
                "vehicles = \"own\"\n",
                "line 1, vehicles: invalid type: string \"own\", expected a list, [\"own\", ...]",
            ),
            (
                "[[scenarios]]\nbuiltin = \"narrow\"\n",
                "line 2, builtin: invalid type: string \"narrow\", expected a list, [\"MAP\", ...]",
            ),
            (
                "[planner]\nplanner = \"astar\"\n",
                "expected a list of tables; hint: [[planner]]",
            ),
            ("seeds = 0\n", "line 1, seeds: expected a count from 1"),
            (
                "[[scenarios]]\nids = [\"a\"]\n",
                "line 1, [[scenarios]]: expected either builtin",
            ),
            (
                "[[scenarios]]\nfile = \"a.csv\"\nresolution_m = -1\n",
                "line 3, resolution_m: -1 m; expected a side above 0",
            ),
            (
                "[[scenarios]]\nfile = \"a.json\"\nlimit = 0\n",
                "line 3, limit: 0; expected 1 or more",
            ),
            ("seeds = \n", "line 1, seeds: "),
        ];
        assert_told(&cases);
        assert!(read("").unwrap_err().to_string().contains("no scenarios"));
    }
}
