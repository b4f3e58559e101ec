//! From a campaign file to runs.

use super::Files;
use crate::{files, scene, settings};
use anyhow::{Result, anyhow};
use formicar::planner::PlannerName;
use formicar_lab::campaign::{
    CampaignSpec, Document, PlannerEntry, ScenariosEntry, TaskSource, Text, check_names, spread,
    tasks_of,
};
use formicar_lab::run::{Contender, Limits, OWN_VEHICLE, Place, RivalCommand, Task, VehicleChoice};
use formicar_lab::tuning::is_as_tuned;
use std::ops::Range;
use std::path::Path;
use toml::{Spanned, Table, Value};

/// The runs of a campaign file; names of files in it are relative to its folder.
pub(super) fn read(path: &Path) -> Result<CampaignSpec> {
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
        tasks.extend(scenarios(entry, &document.text, folder, &contenders)?);
    }
    check_names(&tasks).map_err(|error| document.text.mistake(None, error))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let limits = |&motion| Limits {
        motion: Some(motion),
        budget_steps: document.budget_steps,
        deadline_ms: document.deadline_ms,
        is_cold: document.is_cold,
    };
    Ok(CampaignSpec {
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

/// A vehicle by the word for it: `own`, a preset, or a file of a folder.
fn vehicle(word: &str, folder: &Path) -> Result<Option<VehicleChoice>> {
    if word == OWN_VEHICLE {
        return Ok(None);
    }
    let is_file = [".toml", ".json"].iter().any(|end| word.ends_with(end));
    let source = if is_file {
        folder.join(word).display().to_string()
    } else {
        word.to_owned()
    };
    scene::vehicle(&source)?;
    Ok(Some(VehicleChoice {
        name: word.to_owned(),
        source,
    }))
}

/// The planners of ours.
fn planners(contenders: &[Contender]) -> Vec<PlannerName> {
    let ours = contenders.iter().filter(|c| c.rival.is_none());
    ours.map(|c| c.planner).collect()
}

/// The scenarios of one source: those of some ids, and of these at most so many.
fn scenarios(
    entry: &ScenariosEntry,
    text: &Text,
    folder: &Path,
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
        let source = TaskSource {
            word: &word,
            limit: None,
            resolution_m: entry.resolution_m.as_ref().map(|side| *side.get_ref()),
        };
        let found = tasks_of(&source, &planners(contenders), &Files);
        tasks.extend(found.map_err(|e| text.mistake(Some(span), format!("{e:#}")))?);
    }
    if let Some(ids) = &entry.ids {
        tasks = only(&tasks, ids, text)?;
    }
    let limit = entry.limit.as_ref().map(|limit| *limit.get_ref());
    let kept = spread(tasks.len(), limit);
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
            rival: Some(RivalCommand {
                words: words.clone(),
                folder: folder.to_owned(),
            }),
            ..Contender::built_in(entry.planner)
        });
    }
    let base = config(entry.config.as_ref(), text, folder)?;
    let mut tuned = tuned(entry, &base, folder)?;
    let mut config = checked(&base, &[], entry, text)?;
    for set in &entry.set {
        let key = set.get_ref().split('=').next().unwrap_or_default().trim();
        tuned.retain(|tuned| tuned != key);
        let merged = settings::merge(config, "", &[set.get_ref().clone()], None);
        config = merged.map_err(|e| text.mistake(Some(set.span()), plain(&format!("{e:#}"))))?;
    }
    Ok(Contender {
        name: entry.name.get_ref().clone(),
        config,
        tuned,
        ..Contender::built_in(entry.planner)
    })
}

/// Keys of a configuration file that are as a tuning of the planner has found them.
fn tuned(entry: &PlannerEntry, config: &Table, folder: &Path) -> Result<Vec<String>> {
    let Some(Value::String(file)) = entry.config.as_ref().map(Spanned::get_ref) else {
        return Ok(Vec::new());
    };
    let is_of_planner = config.get("planner").and_then(Value::as_str) == Some(entry.planner.name());
    if !is_of_planner || !is_as_tuned(&files::read_text(&folder.join(file))?) {
        return Ok(Vec::new());
    }
    let keys = settings::keys_of(config, "").into_iter();
    Ok(keys.filter(|key| key != "planner").collect())
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
fn checked(base: &Table, sets: &[String], entry: &PlannerEntry, text: &Text) -> Result<Table> {
    let keys = settings::keys_of(base, "");
    let merged = settings::merge(base.clone(), "config", sets, Some(entry.planner));
    merged.map_err(|error| {
        let what = format!("{error:#}");
        let Some(config) = &entry.config else {
            return anyhow!("{what}");
        };
        if let Some((key, what)) = mistyped(base, entry.planner) {
            let span = place(&key, config, text);
            return text.mistake(Some(span), format!("{key}: {what}"));
        }
        let last = |key: &String| key.rsplit('.').next().unwrap_or_default().to_owned();
        let named = keys.iter().find(|key| what.contains(&last(key)));
        let span = named.map_or(config.span(), |key| place(key, config, text));
        text.mistake(Some(span), what)
    })
}

/// The key whose value is of a wrong type, and what is wrong with it.
fn mistyped(base: &Table, planner: PlannerName) -> Option<(String, String)> {
    let mut table = base.clone();
    table.insert("planner".to_owned(), planner.name().into());
    let error = settings::typed(&table).err()?.to_string();
    // The error names the section alone: it is that of the key without which there is another one.
    let is_it = |key: &String| {
        let mut rest = table.clone();
        remove(&mut rest, key);
        settings::typed(&rest).map_or_else(|other| other.to_string() != error, |_| true)
    };
    let key = settings::keys_of(base, "").into_iter().find(is_it)?;
    let section = key.split('.').next().unwrap_or_default();
    let what = error.strip_prefix(&format!("{section}: "));
    Some((key, plain(what.unwrap_or(&error))))
}

fn remove(table: &mut Table, key: &str) {
    match key.split_once('.') {
        None => drop(table.remove(key)),
        Some((section, rest)) => {
            if let Some(inner) = table.get_mut(section).and_then(Value::as_table_mut) {
                remove(inner, rest);
            }
        }
    }
}

/// What is expected in words of TOML rather than of Rust.
fn plain(what: &str) -> String {
    let words = what.split_once("expected struct ");
    let what = match words {
        Some((before, name)) => {
            let rest = name.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_');
            format!("{before}expected a table{rest}")
        }
        None => what.to_owned(),
    };
    // JSON has no word for numbers that are not finite.
    what.replace("invalid type: null", "nan or inf")
        .replace("expected f64", "expected a finite number")
        .replace("expected u32", "expected a whole number from 0 on")
        .replace("expected u64", "expected a whole number from 0 on")
        .replace("expected usize", "expected a whole number from 0 on")
}

/// Where a dotted key stands, from the beginning of its table on; the table where it is not found,
/// and the name of the file where that holds it.
fn place(key: &str, config: &Spanned<Value>, text: &Text) -> Range<usize> {
    if config.get_ref().is_str() {
        return config.span();
    }
    let (section, last) = key.rsplit_once('.').unwrap_or(("", key));
    let begin = config.span().start;
    let rest = text.text.get(begin..).unwrap_or_default();
    let table = rest.find(&format!("config.{section}]")).unwrap_or_default();
    let found = rest[table..].find(last).map(|at| begin + table + at);
    found.map_or(config.span(), |at| at..at + last.len())
}
