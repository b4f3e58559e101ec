//! Pictures of answers.

use crate::scene::Scene;
use anyhow::Result;
use formicar::collision::ObstacleMap;
use formicar::planner::{Answer, Outcome};
use formicar::render::{AnswerPicture, Layout, Picture, answer_picture};

/// The formats of pictures.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PictureKind {
    Svg,
    Png,
}

/// File extensions and their formats.
pub(crate) const KINDS: [(&str, PictureKind); 2] =
    [("svg", PictureKind::Svg), ("png", PictureKind::Png)];

/// Width of a PNG, pixels.
pub(crate) const PNG_WIDTH_PX: u32 = 1600;

/// The picture of an answer, with or without a path.
pub(crate) fn of(
    scene: &Scene,
    obstacles: &ObstacleMap,
    answer: &Answer,
    outcome: &Outcome,
    layout: Layout,
) -> Picture {
    let vehicle = &scene.vehicle.vehicle;
    let report = outcome.judged().map(|(_, report)| report);
    let picture = AnswerPicture {
        map: &scene.map,
        vehicle,
        answer,
        outcome,
        contact: report.map(|report| obstacles.contact(vehicle, report.tightest)),
    };
    answer_picture(&picture, layout)
}

/// The bytes of a picture.
pub(crate) fn encode(picture: &Picture, kind: PictureKind) -> Result<Vec<u8>> {
    Ok(match kind {
        PictureKind::Svg => picture.to_svg().into_bytes(),
        PictureKind::Png => picture.to_png(PNG_WIDTH_PX)?,
    })
}
