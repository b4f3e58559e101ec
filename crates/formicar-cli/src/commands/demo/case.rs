//! One run of the demo before it is carried out: plain data.

use crate::scene::{self, Blocked, Scene};
use anyhow::Result;
use formicar::geometry::{Point2, Pose2};
use formicar::map::builtin::{BuiltinKind, BuiltinMap};
use formicar::map::{GridFrame, OCCUPIED, OccupancyGrid, UnknownPolicy};
use formicar::planner::{MapRecord, PlannerName};
use formicar::scenario::Request;
use formicar::vehicle::Gears;

/// Search steps after which a run gives up: a second or two. In narrow places a step costs more.
const BUDGET_STEPS: u64 = 200_000;
const BUDGET_STEPS_NARROW: u64 = 100_000;
/// Steps of ants are quick: a second too.
const BUDGET_STEPS_ANTS: u64 = 20_000_000;

/// The chapters of the demo.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Chapter {
    Scenes,
    Narrow,
    Variations,
    Grids,
    Ants,
}

impl Chapter {
    pub(super) const ALL: [Self; 5] = [
        Self::Scenes,
        Self::Narrow,
        Self::Variations,
        Self::Grids,
        Self::Ants,
    ];

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Scenes => "Places of work",
            Self::Narrow => "Narrow places",
            Self::Variations => "Other requests",
            Self::Grids => "Grid problems of papers",
            Self::Ants => "Ants",
        }
    }
}

/// One run: a request on a built-in map, and what is changed about it.
#[derive(Clone, Debug)]
pub(super) struct Case {
    pub(super) chapter: Chapter,
    pub(super) map: &'static BuiltinMap,
    /// The request's name within the map.
    pub(super) request: &'static str,
    pub(super) start: Pose2,
    pub(super) goal: Pose2,
    pub(super) planner: PlannerName,
    pub(super) motion: Gears,
    /// An area closed for the vehicle.
    pub(super) keep_out: &'static [[f64; 2]],
    /// Origin of the map, if not (0, 0, 0); start and goal move with it.
    pub(super) origin: Option<Pose2>,
    /// The point of the run.
    pub(super) about: &'static str,
    /// The request is known to have no path.
    pub(super) is_impossible: bool,
    /// A PNG is written, too.
    pub(super) has_png: bool,
}

impl Case {
    /// A request of a built-in map as it stands.
    pub(super) fn new(chapter: Chapter, map: &str, request: &str) -> Result<Self> {
        let map = BuiltinMap::by_name(map)?;
        let request = map.request(request)?;
        let planner = match map.vehicle {
            "point" => PlannerName::Astar,
            _ => PlannerName::default(),
        };
        Ok(Self {
            chapter,
            map,
            request: request.id,
            start: request.start,
            goal: request.goal,
            planner,
            motion: Gears::default(),
            keep_out: &[],
            origin: None,
            about: map.about,
            is_impossible: false,
            has_png: false,
        })
    }

    /// Its name in files, unique within the demo.
    pub(super) fn id(&self) -> String {
        format!("{}.{}", self.map.name, self.request)
    }

    /// Its name for people.
    pub(super) fn title(&self) -> String {
        format!("{} / {}", self.map.name, self.request)
    }

    /// Map and vehicle, drawn anew.
    pub(super) fn ground(&self) -> Result<Scene> {
        let grid = self.map.grid();
        let mut map = match self.origin {
            Some(origin) => moved(&grid, origin)?,
            None => grid,
        }
        .with_unknown(UnknownPolicy::Occupied);
        let corners: Vec<_> = self
            .keep_out
            .iter()
            .map(|&[x, y]| Point2::new(x, y))
            .collect();
        let mut keep_out = Vec::new();
        if !corners.is_empty() {
            map.fill_polygon(&corners, OCCUPIED);
            keep_out.push(self.keep_out.to_vec());
        }
        Ok(Scene {
            map,
            blocked: Blocked::default(),
            record: MapRecord {
                name: self.map.name.to_owned(),
                unknown: "occupied".to_owned(),
                keep_out,
                ..MapRecord::default()
            },
            vehicle: scene::vehicle(self.map.vehicle)?,
            ends: None,
        })
    }

    fn budget_steps(&self) -> u64 {
        match (self.chapter, self.map.kind) {
            (Chapter::Ants, _) => BUDGET_STEPS_ANTS,
            (_, BuiltinKind::Narrow) => BUDGET_STEPS_NARROW,
            _ => BUDGET_STEPS,
        }
    }

    /// The request.
    pub(super) fn request(&self) -> Request {
        let placed = |pose| self.origin.map_or(pose, |origin| origin.compose(pose));
        Request {
            gears: self.motion,
            budget_steps: Some(self.budget_steps()),
            ..Request::new(placed(self.start), placed(self.goal))
        }
    }

    /// The command that repeats it; none where the map cannot be named.
    pub(super) fn command(&self) -> Option<String> {
        if self.origin.is_some() {
            return None;
        }
        let mut words = vec![format!("formicar plan --map {}", self.map.name)];
        words.push(if self.map.request(self.request).is_ok() {
            format!("--request {}", self.request)
        } else {
            let pose = |p: Pose2| format!("{},{},{:.0}deg", p.x, p.y, p.heading.to_degrees());
            format!("--start {} --goal {}", pose(self.start), pose(self.goal))
        });
        if self.planner != PlannerName::default() {
            words.push(format!("--planner {}", self.planner.name()));
        }
        if self.motion == Gears::Forward {
            words.push("--motion forward".to_owned());
        }
        if !self.keep_out.is_empty() {
            let corner = |[x, y]: &[f64; 2]| format!("{x},{y}");
            let corners: Vec<_> = self.keep_out.iter().map(corner).collect();
            words.push(format!("--keep-out \"{}\"", corners.join(" ")));
        }
        words.push(format!(
            "--budget {} --picture plan.svg",
            self.budget_steps()
        ));
        Some(words.join(" "))
    }
}

fn moved(grid: &OccupancyGrid, origin: Pose2) -> Result<OccupancyGrid> {
    let frame = grid.frame();
    let (n_cols, n_rows) = (frame.n_cols(), frame.n_rows());
    let frame = GridFrame::new(n_cols, n_rows, frame.resolution_m(), origin)?;
    Ok(OccupancyGrid::new(frame, grid.values().to_vec())?)
}
