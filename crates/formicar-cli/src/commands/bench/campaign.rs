//! From a campaign file to runs.

use super::runs::{Runs, planners, vehicle};
use super::suite::{self, Source};
use crate::{files, settings};
use anyhow::{Result, anyhow};
use formicar_lab::campaign::{
    Contender, Document, Limits, Place, PlannerEntry, RivalCommand, ScenariosEntry, Task, Text,
    VehicleChoice,
};
use std::ops::Range;
use std::path::Path;
use toml::{Spanned, Table, Value};

/// The runs of a campaign file; names of files in it are relative to its folder.
pub(crate) fn read(path: &Path) -> Result<Runs> {
    let document = Document::read(Text {
        name: path.display().to_string(),
        text: files::read_text(path)?,
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let contenders = document.planners.iter();
    let contenders = contenders
        .map(|entry| contender(entry, &document.text, folder))
        .collect::<Result<Vec<_>>>()?;
    let mut tasks = Vec::new();
    for entry in &document.scenarios {
        tasks.extend(scenarios(entry, (&document.text, folder), &contenders)?);
    }
    suite::check_names(&tasks).map_err(|error| document.text.mistake(None, error))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let limits = |&motion| Limits {
        motion: Some(motion),
        budget_steps: document.budget_steps,
        deadline_ms: document.deadline_ms,
        is_cold: document.is_cold,
    };
    Ok(Runs {
        name: document.name.clone().unwrap_or_else(|| stem.into_owned()),
        text: document.text.text.clone(),
        tasks,
        vehicles: vehicles(&document, folder)?,
        limits: document.motions.iter().map(limits).collect(),
        contenders,
        seeds: document.seeds,
    })
}

fn vehicles(document: &Document, folder: &Path) -> Result<Vec<Option<VehicleChoice>>> {
    if document.vehicles.is_empty() {
        return Ok(vec![None]);
    }
    let vehicles = document.vehicles.iter().map(|word| {
        let hint = "; `own` is each scenario's own";
        let found = vehicle(word.get_ref(), folder);
        found.map_err(|e| {
            document
                .text
                .mistake(Some(word.span()), format!("{e:#}{hint}"))
        })
    });
    vehicles.collect()
}

/// The scenarios of one source: those of some ids, and of these at most so many.
fn scenarios(
    entry: &ScenariosEntry,
    (text, folder): (&Text, &Path),
    contenders: &[Contender],
) -> Result<Vec<Task>> {
    let mut words: Vec<(String, Range<usize>)> = Vec::new();
    for name in &entry.builtin {
        words.push((name.get_ref().clone(), name.span()));
    }
    if let Some(file) = &entry.file {
        let path = folder.join(file.get_ref());
        words.push((path.display().to_string(), file.span()));
    }
    let mut tasks = Vec::new();
    for (word, span) in words {
        let source = Source {
            word: &word,
            limit: None,
            resolution_m: entry.resolution_m.as_ref().map(|side| *side.get_ref()),
        };
        let found = suite::tasks_of(&source, &planners(contenders));
        tasks.extend(found.map_err(|e| text.mistake(Some(span), format!("{e:#}")))?);
    }
    if let Some(ids) = &entry.ids {
        tasks = only(&tasks, ids, text)?;
    }
    let limit = entry.limit.as_ref().map(|limit| *limit.get_ref());
    let kept = suite::spread(tasks.len(), limit);
    Ok(kept.map(|i| tasks[i].clone()).collect())
}

/// The scenarios of some ids, in the order of these.
fn only(tasks: &[Task], ids: &[Spanned<String>], text: &Text) -> Result<Vec<Task>> {
    let mut kept = Vec::new();
    for id in ids {
        let is_it = |task: &&Task| id_of(task) == id.get_ref();
        let before = kept.len();
        kept.extend(tasks.iter().filter(is_it).cloned());
        if kept.len() == before {
            let known: Vec<&str> = tasks.iter().map(id_of).collect();
            let what = format!(
                "no scenario has the id {:?}; there are {}",
                id.get_ref(),
                known.join(", ")
            );
            return Err(text.mistake(Some(id.span()), what));
        }
    }
    Ok(kept)
}

fn id_of(task: &Task) -> &str {
    match &task.place {
        Place::Builtin { request, .. } => request,
        Place::File { id: Some(id), .. } => id,
        _ => &task.scenario,
    }
}

/// A planner with its parameters.
fn contender(entry: &PlannerEntry, text: &Text, folder: &Path) -> Result<Contender> {
    if let Some(words) = &entry.command {
        return Ok(Contender {
            name: entry.name.get_ref().clone(),
            planner: entry.planner,
            config: Table::new(),
            rival: Some(RivalCommand {
                words: words.clone(),
                folder: folder.to_owned(),
            }),
        });
    }
    let base = config(entry.config.as_ref(), text, folder)?;
    let mut config = checked(base, &[], entry, text)?;
    for set in &entry.set {
        let merged = settings::merge((config, ""), &[set.get_ref().clone()], None);
        config = merged.map_err(|e| text.mistake(Some(set.span()), format!("{e:#}")))?;
    }
    Ok(Contender {
        name: entry.name.get_ref().clone(),
        planner: entry.planner,
        config,
        rival: None,
    })
}

/// What `config` names or holds.
fn config(config: Option<&Spanned<Value>>, text: &Text, folder: &Path) -> Result<Table> {
    let Some(config) = config else {
        return Ok(Table::new());
    };
    match config.get_ref() {
        Value::String(file) => settings::read(&folder.join(file))
            .map_err(|e| text.mistake(Some(config.span()), format!("{e:#}"))),
        Value::Table(table) => match settings::unknown(table) {
            Some((key, error)) => Err(text.mistake(Some(place(&key, config, text)), error)),
            None => Ok(table.clone()),
        },
        _ => Err(text.mistake(
            Some(config.span()),
            "expected a configuration file, or a table of planner parameters",
        )),
    }
}

/// The parameters with the planner's name; what is wrong with one is told at its line.
fn checked(base: Table, sets: &[String], entry: &PlannerEntry, text: &Text) -> Result<Table> {
    let keys = settings::keys_of(&base, "");
    let merged = settings::merge((base, "config"), sets, Some(entry.planner));
    merged.map_err(|error| {
        let what = format!("{error:#}");
        let Some(config) = &entry.config else {
            return anyhow!("{what}");
        };
        let last = |key: &String| key.rsplit('.').next().unwrap_or_default().to_owned();
        let named = keys.iter().find(|key| what.contains(&last(key)));
        let span = named.map_or(config.span(), |key| place(key, config, text));
        text.mistake(Some(span), what)
    })
}

/// Where a dotted key stands, from the beginning of its table on; the table where it is not found.
fn place(key: &str, config: &Spanned<Value>, text: &Text) -> Range<usize> {
    let last = key.rsplit('.').next().unwrap_or_default();
    let begin = config.span().start;
    let found = text.text.get(begin..).and_then(|rest| rest.find(last));
    found.map_or(config.span(), |at| begin + at..begin + at + last.len())
}
