//! One run of the demo: plan, draw, and keep what the table and the page show.

use super::case::Case;
use crate::ants::{self, AntsKind};
use crate::picture::{self, PictureKind};
use crate::session::{Answered, Session};
use anyhow::{Context, Result};
use formicar::map::builtin::BuiltinKind;
use formicar::numeric::Seed;
use formicar::planner::{Answer, PlannerConfig};
use formicar::progress::AntFrames;
use formicar::render::{Layout, Picture};
use std::time::Instant;

/// The folder of pictures and answers beside the page.
pub(super) const RUNS_FOLDER: &str = "runs";

/// The seed of every run.
const SEED: Seed = Seed(0);

/// A run that has ended, with or without a path.
#[derive(Debug)]
pub(super) struct Done<'a> {
    pub(super) case: &'a Case,
    pub(super) answer: Answer,
    pub(super) n_steps: u64,
    /// Largest curvature that the vehicle can drive; infinite for a point.
    pub(super) max_curvature_per_m: f64,
    pub(super) picture: Picture,
    /// The same for narrow screens.
    pub(super) phone: Picture,
    png: Option<Vec<u8>>,
    /// A film of its ants, where ants walked on a map small enough to watch them.
    film: Option<Vec<u8>>,
}

/// Carries out a run. An end without a path is no error.
pub(super) fn run(case: &Case) -> Result<Done<'_>> {
    let begun = Instant::now();
    let config = PlannerConfig::of(case.planner);
    let mut session = Session::new(case.ground()?, config, begun)?;
    if case.planner.colony().is_some() && case.map.kind == BuiltinKind::GridProblem {
        session.keep_ants();
    }
    let Answered { answer, result, .. } = session.plan(Ok(case.request()), SEED);
    let outcome = result.with_context(|| case.id())?;
    let (ground, obstacles) = (&session.scene, &session.obstacles);
    let drawn = |layout| {
        let mut picture = picture::of(ground, obstacles, &answer, &outcome, layout);
        picture.title = format!("{}: {}", case.title(), status(&answer));
        picture
    };
    let (picture, phone) = (drawn(Layout::Page), drawn(Layout::Phone));
    let kept = session.ants.as_ref().map(AntFrames::frames);
    let film = kept
        .filter(|frames| !frames.is_empty())
        .map(|frames| ants::encode(ground, &answer, &outcome, frames, AntsKind::Gif));
    let png = case
        .has_png
        .then(|| picture::encode(&picture, PictureKind::Png));
    Ok(Done {
        case,
        n_steps: outcome.n_steps(),
        max_curvature_per_m: ground.vehicle.vehicle.max_curvature_per_m(),
        png: png.transpose()?,
        film: film.transpose()?,
        picture,
        phone,
        answer,
    })
}

/// The status in words.
pub(super) fn status(answer: &Answer) -> String {
    answer.status.name().replace('_', " ")
}

impl Done<'_> {
    /// Tells if there is a certified path.
    pub(super) fn is_found(&self) -> bool {
        self.answer.path.is_some()
    }

    /// Tells if there is a film of its ants.
    pub(super) fn has_film(&self) -> bool {
        self.film.is_some()
    }

    /// Its files by extension.
    pub(super) fn files(&self) -> Result<Vec<(&'static str, Vec<u8>)>> {
        let mut json = serde_json::to_vec(&self.answer)?;
        json.push(b'\n');
        let mut files = vec![
            ("svg", picture::encode(&self.picture, PictureKind::Svg)?),
            ("phone.svg", picture::encode(&self.phone, PictureKind::Svg)?),
            ("json", json),
        ];
        files.extend(self.png.clone().map(|png| ("png", png)));
        files.extend(self.film.clone().map(|film| ("gif", film)));
        Ok(files)
    }
}
