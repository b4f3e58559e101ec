//! The report of a map: how good it is, as values, as a page, and as a picture.

use crate::evaluate::{HeldOut, RelationErrors, TrajectoryError};
use crate::front_end::Quality;
use crate::loops::{LoopRecord, Verdict};
use crate::mapper::{BuiltMap, Mapper};
use crate::scan::RangeCounts;
use formicar::Point2;
use formicar::map::{FREE, OCCUPIED};
use formicar::render::{Dash, Element, LineStyle, Markup, Picture, Scene, html_page, palette};
use serde::Serialize;
use std::collections::BTreeMap;

/// How good a map is.
#[derive(Clone, Debug, Serialize)]
pub struct MapReport {
    /// Name and version of this document.
    pub schema: &'static str,
    /// Names of the logs.
    pub logs: Vec<String>,
    /// Scans of the logs that took part.
    pub n_scans: usize,
    /// Key scans.
    pub n_key_scans: usize,
    /// Scans by the way they were matched.
    pub matched: BTreeMap<&'static str, usize>,
    /// Indices of the scans that were lost or told nothing.
    pub bad_scans: Vec<usize>,
    /// Ranges by kind.
    pub ranges: RangeCounts,
    /// First range that means "no return", meters, where the log has such a code.
    pub no_return_m: Option<f64>,
    /// Scales of the odometry's noise that the log showed: translation and heading.
    pub odometry_scales: (f64, f64),
    /// Angle from the odometry's driving direction to that of the sensor, radians.
    pub sideways_rad: f64,
    /// Times that the scans contradicted the odometry.
    pub n_odometry_contradicted: usize,
    /// Loops accepted.
    pub n_loops: usize,
    /// Loops refused, by reason.
    pub refused: BTreeMap<String, usize>,
    /// Every loop that was looked at.
    pub loops: Vec<LoopRecord>,
    /// Cells of the map: free, occupied, unknown.
    pub cells: (usize, usize, usize),
    /// Largest memory of maps and scans, bytes.
    pub memory_bytes: usize,
    /// Times by name, seconds.
    pub times_s: Vec<(String, f64)>,
    /// Errors against the log's reference poses, where it has them.
    pub errors: Vec<(String, RelationErrors)>,
    /// The absolute trajectory error against the reference.
    pub trajectory_error: Option<TrajectoryError>,
    /// Beams that the map was not built from.
    pub held_out: Option<HeldOut>,
}

impl MapReport {
    /// The report of a map without evaluation, which the caller adds.
    pub fn new(mapper: &Mapper, built: &BuiltMap) -> Self {
        let mut matched = BTreeMap::new();
        let mut bad_scans = Vec::new();
        for (i, place) in mapper.places().iter().enumerate() {
            *matched
                .entry(crate::trajectory::quality_word(place.quality))
                .or_insert(0) += 1;
            if matches!(place.quality, Quality::Lost | Quality::Degenerate) {
                bad_scans.push(i);
            }
        }
        let mut refused = BTreeMap::new();
        for record in &built.loops {
            if record.verdict != Verdict::Accepted {
                let reason = match record.verdict {
                    Verdict::Unsupported { .. } => "too few neighboring loops agree".to_owned(),
                    Verdict::Contradicted { .. } => "neighboring loops contradict".to_owned(),
                    other => other.words(),
                };
                *refused.entry(reason).or_insert(0) += 1;
            }
        }
        let values = built.grid.values();
        let count = |wanted: i8| values.iter().filter(|value| **value == wanted).count();
        let (n_free, n_occupied) = (count(FREE), count(OCCUPIED));
        Self {
            schema: "formicar/map-report/1",
            logs: Vec::new(),
            n_scans: mapper.places().len(),
            n_key_scans: mapper.nodes().len(),
            matched,
            bad_scans,
            ranges: *mapper.range_counts(),
            no_return_m: mapper.policy().no_return_m,
            odometry_scales: mapper.front_end().noise_scales(),
            sideways_rad: mapper.front_end().sideways_rad(),
            n_odometry_contradicted: mapper.front_end().n_contradicted(),
            n_loops: built.loops.len() - refused.values().sum::<usize>(),
            refused,
            loops: built.loops.clone(),
            cells: (n_free, n_occupied, values.len() - n_free - n_occupied),
            memory_bytes: built.memory_bytes,
            times_s: Vec::new(),
            errors: Vec::new(),
            trajectory_error: None,
            held_out: None,
        }
    }

    /// The facts in words: name and value.
    pub fn facts(&self) -> Vec<(String, String)> {
        let mut facts: Vec<(String, String)> = Vec::new();
        let mut fact = |name: &str, value: String| facts.push((name.to_owned(), value));
        fact(
            "scans",
            format!("{}, {} of them key scans", self.n_scans, self.n_key_scans),
        );
        let words = self.matched.iter().map(|(word, n)| format!("{n} {word}"));
        fact("matched", words.collect::<Vec<_>>().join(", "));
        if !self.bad_scans.is_empty() {
            fact("lost or degenerate scans", list(&self.bad_scans));
        }
        fact("ranges", self.range_words());
        fact(
            "odometry",
            format!(
                "noise {:.2} (translation) and {:.2} (heading) of the default, turned {:.2} deg \
                 from the sensor, contradicted by {} scans",
                self.odometry_scales.0,
                self.odometry_scales.1,
                self.sideways_rad.to_degrees(),
                self.n_odometry_contradicted
            ),
        );
        let refused: Vec<String> = self
            .refused
            .iter()
            .map(|(why, n)| format!("{n}: {why}"))
            .collect();
        let refused = if refused.is_empty() {
            String::new()
        } else {
            format!("; refused {}", refused.join(", "))
        };
        fact("loops", format!("{} accepted{refused}", self.n_loops));
        let (free, occupied, unknown) = self.cells;
        fact(
            "cells",
            format!("{free} free, {occupied} occupied, {unknown} unknown"),
        );
        fact(
            "memory",
            format!("{:.1} MB", self.memory_bytes as f64 / 1e6),
        );
        for (name, seconds) in &self.times_s {
            fact(name, format!("{seconds:.2} s"));
        }
        self.evaluation_facts(&mut facts);
        facts
    }

    fn evaluation_facts(&self, facts: &mut Vec<(String, String)>) {
        for (name, e) in &self.errors {
            let value = format!(
                "{:.4} ± {:.4} m, {:.3} ± {:.3} deg, at most {:.2} m ({} relations)",
                e.mean_m, e.std_m, e.mean_deg, e.std_deg, e.max_m, e.n
            );
            facts.push((name.clone(), value));
        }
        if let Some(e) = &self.trajectory_error {
            let value = format!("{:.3} m rms, at most {:.2} m", e.rmse_m, e.max_m);
            facts.push(("trajectory error".to_owned(), value));
        }
        if let Some(h) = &self.held_out {
            let value = format!(
                "{} scans ({} unmatched), {} beams: leaks {:.2} %, early {:.2} %, ends in free \
                 ground {:.2} %",
                h.n_scans,
                h.n_unmatched,
                h.n_beams,
                100.0 * h.leaks(),
                100.0 * h.early(),
                100.0 * h.free_ends()
            );
            facts.push(("held-out beams".to_owned(), value));
        }
    }

    fn range_words(&self) -> String {
        let n_all = self.ranges.n_all().max(1) as f64;
        let named = self.ranges.named();
        let shares = named.iter().filter(|(_, n)| *n > 0);
        let shares = shares.map(|(name, n)| format!("{:.2} % {name}", 100.0 * *n as f64 / n_all));
        let code = self.no_return_m.map_or(String::new(), |code| {
            format!("; no return from {code:.2} m on")
        });
        format!("{}{code}", shares.collect::<Vec<_>>().join(", "))
    }

    /// A page with the picture of the map, the facts, and every loop that was looked at.
    pub fn to_html(&self, picture: &Picture) -> String {
        html_page("Map report", STYLE, |page| {
            page.words(
                &Element::new("h1"),
                &format!("Map of {}", self.logs.join(", ")),
            );
            page.raw(&picture.to_svg());
            page.words(&Element::new("h2"), "How good it is");
            let facts = self.facts();
            let rows = facts
                .iter()
                .map(|(name, value)| vec![name.clone(), value.clone()]);
            table(page, &[], rows);
            page.words(&Element::new("h2"), "Loops");
            page.words(&Element::new("p"), LOOP_WORDS);
            let rows = self.loops.iter().map(|record| {
                vec![
                    record.from.to_string(),
                    record.to.to_string(),
                    format!("{:?}", record.stage).to_lowercase(),
                    format!("{:.2}", record.score),
                    format!("{:.2}", record.seen_share),
                    format!("{:.3}", record.eigen_ratio),
                    record.verdict.words(),
                ]
            });
            table(
                page,
                &["from", "to", "stage", "score", "seen", "ratio", "verdict"],
                rows,
            );
        })
    }
}

const LOOP_WORDS: &str = "Each row is a place that was compared with an earlier one: key scans, mean \
    score of the hits (1 is on the surface), share of hits on seen ground, least over greatest \
    information on the translation (near 0 in a corridor), and the verdict.";

const STYLE: &str =
    "body { font: 15px/1.5 sans-serif; max-width: 76rem; margin: 2rem auto; padding: 0 1rem }
svg { max-width: 100%; height: auto }
table { border-collapse: collapse }
td, th { padding: 0.2rem 0.8rem 0.2rem 0; text-align: left; vertical-align: top }
tr + tr td { border-top: 1px solid #8884 }
";

fn table(page: &mut Markup, head: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    page.within(&Element::new("table"), |table| {
        if !head.is_empty() {
            table.within(&Element::new("tr"), |row| {
                for cell in head {
                    row.words(&Element::new("th"), cell);
                }
            });
        }
        for cells in rows {
            table.within(&Element::new("tr"), |row| {
                for cell in &cells {
                    row.words(&Element::new("td"), cell);
                }
            });
            table.end_line();
        }
    });
    page.end_line();
}

/// The first of many numbers.
fn list(numbers: &[usize]) -> String {
    const SHOWN: usize = 40;
    let shown: Vec<String> = numbers
        .iter()
        .take(SHOWN)
        .map(ToString::to_string)
        .collect();
    let rest = numbers.len().saturating_sub(SHOWN);
    if rest == 0 {
        shown.join(", ")
    } else {
        format!("{}, and {rest} more", shown.join(", "))
    }
}

/// The map with its trajectory and the accepted loops.
pub fn map_picture(built: &BuiltMap, title: &str) -> Picture {
    let mut scene = Scene::new(&built.grid);
    let line = |label: &str, color, width_px| LineStyle {
        label: label.to_owned(),
        color,
        width_px,
        dash: Dash::Solid,
    };
    let accepted = built
        .loops
        .iter()
        .filter(|r| r.verdict == Verdict::Accepted);
    for (i, record) in accepted.enumerate() {
        let ends = [record.from, record.to].map(|node| built.node_poses[node].position());
        let label = if i == 0 { "loop" } else { "" };
        scene.polyline(&ends, &line(label, palette::GOAL, 0.6));
    }
    let path: Vec<Point2> = built
        .trajectory
        .iter()
        .map(|pose| pose.position())
        .collect();
    scene.polyline(&path, &line("trajectory", palette::FORWARD, 1.2));
    Picture {
        title: title.to_owned(),
        scene: Some(scene),
        ..Picture::default()
    }
}
