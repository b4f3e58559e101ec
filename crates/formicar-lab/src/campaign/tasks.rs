//! From words for scenarios to tasks. Everything wrong with them is found here, before anything is
//! started.

use crate::run::{BARN_RESOLUTION_M, BarnWorlds, Place, Sources, Task};
use anyhow::{Context, Result, anyhow, bail};
use formicar::map::builtin::{self, BuiltinKind, BuiltinMap};
use formicar::map::format::{
    MovingAiScenario, ReadOptions, read_car_scenarios, read_map, read_movingai_scenarios,
};
use formicar::planner::PlannerName;
use std::collections::BTreeSet;
use std::path::Path;

/// A word for scenarios, with its options.
#[derive(Clone, Copy, Debug)]
pub struct TaskSource<'a> {
    /// A file, a built-in map or a set of them.
    pub word: &'a str,
    /// Lines of a .scen file or worlds of BARN that are taken; all where there is none.
    pub limit: Option<u32>,
    /// Side of a cell, where the file leaves that open.
    pub resolution_m: Option<f64>,
}

/// Refuses scenarios whose names cannot name files, or are not unique.
///
/// # Errors
/// The first such name.
pub fn check_names(tasks: &[Task]) -> Result<()> {
    let mut names = BTreeSet::new();
    for task in tasks {
        let name = &task.scenario;
        if name.is_empty() || name.contains(|c: char| c == '/' || c == '\\' || c.is_control()) {
            bail!("scenario {name:?} cannot name a file; hint: an id without slashes");
        }
        if !names.insert(name) {
            bail!("two scenarios are named {name:?}; hint: a table of their own for each");
        }
    }
    Ok(())
}

/// The scenarios of a source, for planners of ours.
///
/// # Errors
/// A word that names none, and files that cannot be read.
pub fn tasks_of(
    source: &TaskSource,
    planners: &[PlannerName],
    sources: &dyn Sources,
) -> Result<Vec<Task>> {
    let TaskSource { word, limit, .. } = *source;
    let path = Path::new(word);
    let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    match extension.as_deref().and_then(std::ffi::OsStr::to_str) {
        Some("scen") => match planners.iter().find(|planner| drives(**planner)) {
            Some(planner) => bail!(
                "{word}: {} plans for cars, and MovingAI scenarios are for points; hint: \
                 --planners astar,dijkstra",
                planner.name()
            ),
            None => of_movingai(path, limit),
        },
        Some("json") => match BarnWorlds::read(path)? {
            Some(worlds) => of_barn(path, &worlds, source),
            None => of_file(path, source.resolution_m, sources),
        },
        Some("csv") => of_file(path, source.resolution_m, sources),
        _ => of_builtin(word),
    }
}

/// True if a planner plans for cars alone.
fn drives(planner: PlannerName) -> bool {
    matches!(planner, PlannerName::Formicar | PlannerName::HybridAstar)
}

fn of_builtin(word: &str) -> Result<Vec<Task>> {
    let maps: Vec<&BuiltinMap> = match word {
        "builtin" => builtin::all().iter().collect(),
        "narrow" => {
            let narrow = |map: &&BuiltinMap| map.kind == BuiltinKind::Narrow;
            builtin::all().iter().filter(narrow).collect()
        }
        name => {
            let hint = "hint: a scenario file is .json, .csv or .scen; `narrow` and `builtin` are \
                        sets of maps";
            vec![BuiltinMap::by_name(name).map_err(|e| anyhow!("{e}; {hint}"))?]
        }
    };
    let task = |map: &BuiltinMap, request: &str| Task {
        scenario: format!("{}-{request}", map.name),
        source: map.name.to_owned(),
        place: Place::Builtin {
            map: map.name.to_owned(),
            request: request.to_owned(),
        },
    };
    let tasks = maps.iter().flat_map(|map| {
        let requests = map.requests.iter();
        requests.map(move |request| task(map, request.id))
    });
    Ok(tasks.collect())
}

/// Worlds of BARN, at most as many as wanted.
fn of_barn(path: &Path, worlds: &BarnWorlds, source: &TaskSource) -> Result<Vec<Task>> {
    let name = stem(path)?;
    let resolution_m = source.resolution_m.unwrap_or(BARN_RESOLUTION_M);
    let ids: Vec<u32> = worlds.ids().collect();
    let taken = spread(ids.len(), source.limit).map(|i| ids[i]);
    let task = |world: u32| {
        // A world that gives no map is found now rather than once per run.
        worlds.grid(world, resolution_m)?;
        Ok(Task {
            scenario: format!("{name}-{world:03}"),
            source: name.clone(),
            place: Place::Barn {
                path: path.to_owned(),
                world,
                resolution_m,
            },
        })
    };
    taken.map(task).collect()
}

fn of_file(path: &Path, resolution_m: Option<f64>, sources: &dyn Sources) -> Result<Vec<Task>> {
    let name = stem(path)?;
    let task = |scenario: String, id: Option<String>| Task {
        scenario,
        source: name.clone(),
        place: Place::File {
            path: path.to_owned(),
            id,
            resolution_m,
        },
    };
    let is_tpcap = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
    let tasks: Vec<Task> = if is_tpcap {
        vec![task(name.clone(), None)]
    } else {
        let ids = read_car_scenarios(path)?.into_iter().map(|s| s.id);
        ids.map(|id| task(id.clone(), Some(id))).collect()
    };
    if tasks.is_empty() {
        bail!("{}: it holds no scenarios", path.display());
    }
    for task in &tasks {
        // A map that cannot be read is found now rather than once per run.
        sources.load(task, None)?;
    }
    Ok(tasks)
}

fn of_movingai(path: &Path, limit: Option<u32>) -> Result<Vec<Task>> {
    let lines = read_movingai_scenarios(path)?;
    if lines.is_empty() {
        bail!("{}: it holds no scenarios", path.display());
    }
    // Both `x.map.scen` and `x.scen` lie beside `x.map`.
    let map = path.with_extension("");
    let map = if map.extension().is_some_and(|e| e == "map") {
        map
    } else {
        path.with_extension("map")
    };
    let source = stem(&map)?;
    let grid = read_map(&map, &ReadOptions::default())?;
    let (n_cols, n_rows) = (grid.frame().n_cols(), grid.frame().n_rows());
    if let Some(line) = lines
        .iter()
        .find(|line| (line.n_cols, line.n_rows) != (n_cols, n_rows))
    {
        bail!(
            "{}: it is for a map of {} x {} cells, {} has {n_cols} x {n_rows}",
            path.display(),
            line.n_cols,
            line.n_rows,
            map.display()
        );
    }
    let task = |i: usize| task_of_line(&source, &map, i, &lines[i]);
    Ok(spread(lines.len(), limit).map(task).collect())
}

fn task_of_line(source: &str, map: &Path, i: usize, line: &MovingAiScenario) -> Task {
    Task {
        scenario: format!("{source}-{:05}", i + 1),
        source: source.to_owned(),
        place: Place::Cells {
            map: map.to_owned(),
            start: [line.start.col, line.start.row],
            goal: [line.goal.col, line.goal.row],
            optimal_length_cells: line.optimal_length_cells,
        },
    }
}

impl<'a> TaskSource<'a> {
    /// A word alone.
    pub fn of(word: &'a str) -> Self {
        Self {
            word,
            limit: None,
            resolution_m: None,
        }
    }
}

/// At most `limit` of `n` indices, evenly spread from the first to the last.
pub fn spread(n: usize, limit: Option<u32>) -> impl Iterator<Item = usize> {
    let n_taken = limit.map_or(n, |limit| n.min(limit as usize));
    (0..n_taken).map(move |i| i * n.saturating_sub(1) / n_taken.saturating_sub(1).max(1))
}

fn stem(path: &Path) -> Result<String> {
    let stem = path.file_stem().and_then(|stem| stem.to_str());
    let stem = stem.with_context(|| format!("{}: a name in UTF-8 is needed", path.display()))?;
    Ok(stem.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::BuiltinSources;

    #[test]
    fn spreads_from_first_to_last() {
        let taken = |n, limit| spread(n, limit).collect::<Vec<_>>();
        assert_eq!(taken(4, None), [0, 1, 2, 3]);
        assert_eq!(taken(4, Some(9)), [0, 1, 2, 3]);
        assert_eq!(taken(101, Some(5)), [0, 25, 50, 75, 100]);
        assert_eq!(taken(7, Some(1)), [0]);
        assert_eq!(taken(1, Some(1)), [0]);
    }

    fn named(word: &str) -> Result<Vec<Task>> {
        tasks_of(
            &TaskSource::of(word),
            &[PlannerName::Astar],
            &BuiltinSources,
        )
    }

    #[test]
    fn names_sets_of_maps() {
        let names = |word: &str| {
            let tasks = named(word).unwrap().into_iter();
            tasks.map(|t| t.scenario).collect::<Vec<_>>()
        };
        assert_eq!(names("narrow-junction").len(), 2);
        assert!(names("narrow").contains(&"slalom-poles-slalom".to_owned()));
        assert!(names("builtin").len() > names("narrow").len());
    }

    #[test]
    fn refuses_a_scenario_named_twice() {
        let tasks = ["narrow", "narrow-junction"].map(|word| named(word).unwrap());
        let error = check_names(&tasks.concat()).unwrap_err();
        assert!(error.to_string().contains("narrow-junction-quarter-turn"));
    }
}
