//! From the words on the command line to scenarios that can be asked.

use super::TuneArgs;
use crate::scene;
use crate::scene::ScenarioFile;
use crate::scene::SceneArgs;
use anyhow::{Context, Result, bail};
use formicar::map::builtin::BuiltinMap;
use formicar::scenario::Request;
use formicar_lab::papers::Ground;
use formicar_lab::tuning::Asked;
use std::path::Path;

/// All scenarios that the words name; each name once.
pub(super) fn asked(args: &TuneArgs, words: &[String]) -> Result<Vec<Asked>> {
    let mut all: Vec<Asked> = Vec::new();
    for word in words {
        for (name, place) in places(word)? {
            if all.iter().any(|asked| asked.ground.map == name) {
                bail!("two scenarios are named {name:?}; hint: each once");
            }
            all.push(prepared(args, name, &place)?);
        }
    }
    Ok(all)
}

fn places(word: &str) -> Result<Vec<(String, SceneArgs)>> {
    let path = Path::new(word);
    let is_file = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("json") || e.eq_ignore_ascii_case("csv"));
    if is_file {
        of_file(path)
    } else {
        of_builtin(word)
    }
}

fn of_builtin(word: &str) -> Result<Vec<(String, SceneArgs)>> {
    let map = BuiltinMap::by_name(word).context("hint: a scenario file is .json or .csv")?;
    let place = |id: &str| SceneArgs {
        map: Some(map.name.to_owned()),
        request: Some(id.to_owned()),
        ..SceneArgs::default()
    };
    let requests = map.requests.iter();
    let named = requests.map(|request| (format!("{word}-{}", request.id), place(request.id)));
    Ok(named.collect())
}

fn of_file(path: &Path) -> Result<Vec<(String, SceneArgs)>> {
    let place = |id: Option<String>| SceneArgs {
        scenario: Some(path.to_owned()),
        id,
        ..SceneArgs::default()
    };
    Ok(match ScenarioFile::read(path)? {
        ScenarioFile::Cars(cars) => {
            let ids = cars.rows().into_iter().map(|(id, _)| id);
            ids.map(|id| (id.clone(), place(Some(id)))).collect()
        }
        ScenarioFile::Tpcap(case) => vec![(case.row().0, place(None))],
    })
}

fn prepared(args: &TuneArgs, name: String, place: &SceneArgs) -> Result<Asked> {
    let ground = scene::load(place).with_context(|| name.clone())?;
    let [start, goal] = ground
        .ends
        .with_context(|| format!("{name}: it has no start and goal"))?;
    let whole = Request::new(start, goal);
    let request = Request {
        motion: args.modes.motion.unwrap_or(whole.motion),
        start_heading: args.modes.start_heading.unwrap_or(whole.start_heading),
        goal_heading: args.modes.goal_heading.unwrap_or(whole.goal_heading),
        budget_steps: Some(args.budget),
        ..whole
    };
    let asked = Asked::new(Ground {
        map: name,
        grid: ground.map,
        vehicle: ground.vehicle.vehicle,
        request,
    });
    Ok(asked)
}
