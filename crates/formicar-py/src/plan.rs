//! The answer to a query: a path with its certificate, or the reason why there is none.

use crate::errors::{self, Outcome};
use crate::grid::Grid;
use crate::observe::Improvement;
use crate::values;
use crate::vehicle::Car;
use formicar::collision::ObstacleMap;
use formicar::map::{Cell, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::path::{CurvePath, Spacing};
use formicar::planner::{
    Answer, AnswerContext, AnswerStatus, MapRecord, PathDocument, PlannerConfig, RequestDocument,
    Stages, Timing,
};
use formicar::progress::{AntFrame, AntFrames, Traffic};
use formicar::render::{
    AnswerPicture, ColonyPicture, Layout, PlanPicture, answer_picture, colony_picture,
    plan_picture_in,
};
use formicar::scenario::Request;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// The query behind an answer.
pub(crate) struct Asked {
    pub(crate) obstacles: Arc<ObstacleMap>,
    pub(crate) map: Arc<OccupancyGrid>,
    pub(crate) record: MapRecord,
    pub(crate) car: Car,
    pub(crate) config: PlannerConfig,
    pub(crate) request: Request,
    pub(crate) seed: Seed,
    pub(crate) timing: Timing,
}

/// Cells on which a colony or a search over cells has gone.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
struct Trails {
    cells: Vec<[u32; 2]>,
    nodes: Vec<[u32; 2]>,
}

/// The answer to a query.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct Plan {
    /// The outcome as it came; none of an answer that was read.
    live: Option<(Asked, formicar::Outcome)>,
    /// The document; written once it is asked for, since its poses take time.
    answer: OnceLock<Answer>,
    map: Arc<OccupancyGrid>,
    car: Car,
    improvements: Vec<Improvement>,
    trails: Trails,
    pheromone: Option<Vec<f32>>,
    frames: Vec<AntFrame>,
}

impl Plan {
    pub(crate) fn new(
        asked: Asked,
        outcome: formicar::Outcome,
        improvements: Vec<Improvement>,
        frames: Option<AntFrames>,
    ) -> Self {
        let stages = outcome.stages();
        let pair = |cell: &Cell| [cell.col, cell.row];
        let cells = stages.grid_path.iter().flat_map(|path| &path.cells);
        let colony = stages.colony.as_ref();
        Self {
            answer: OnceLock::new(),
            map: asked.map.clone(),
            car: asked.car.clone(),
            improvements,
            trails: Trails {
                cells: cells.map(pair).collect(),
                nodes: stages.nodes.iter().map(pair).collect(),
            },
            pheromone: colony.map(|run| run.pheromone.clone()),
            frames: frames.map_or_else(Vec::new, |frames| frames.frames().to_vec()),
            live: Some((asked, outcome)),
        }
    }

    /// The document of the answer.
    pub(crate) fn answer(&self) -> &Answer {
        self.answer.get_or_init(|| match &self.live {
            Some((asked, outcome)) => asked.answer(outcome),
            None => unreachable!("an answer that was read is there from the beginning"),
        })
    }

    /// The path, exactly.
    pub(crate) fn path(&self) -> PyResult<CurvePath> {
        let path = match &self.live {
            Some((_, formicar::Outcome::Found(plan))) => Some(plan.path.clone()),
            Some(_) => None,
            None => self
                .answer()
                .path
                .as_ref()
                .and_then(PathDocument::curve_path),
        };
        path.ok_or_else(|| errors::path(format!("the plan has no path: {}", self.status())))
    }

    pub(crate) fn request(&self) -> Option<Request> {
        if let Some((asked, _)) = &self.live {
            return Some(asked.request.clone());
        }
        let document = self.answer().provenance.request.as_ref()?;
        document.onto(&RequestDocument::default()).ok()
    }

    fn stages(&self) -> Option<&Stages> {
        self.live.as_ref().map(|(_, outcome)| outcome.stages())
    }
}

impl Asked {
    fn answer(&self, outcome: &formicar::Outcome) -> Answer {
        let (vehicle, config) = (self.car.vehicle.clone(), self.config.clone());
        let planner = formicar::Planner::on(self.obstacles.clone(), vehicle, config)
            .expect("the configuration was checked when the planner was made");
        let context = AnswerContext {
            planner: &planner,
            map: self.record.clone(),
            vehicle_name: &self.car.name,
            spacing: Spacing::default(),
        };
        let result = Ok(outcome.clone());
        context.answer(Some(&self.request), self.seed, &result, self.timing)
    }
}

#[pymethods]
impl Plan {
    #[getter]
    fn found(&self) -> bool {
        match &self.live {
            Some((_, outcome)) => matches!(outcome, formicar::Outcome::Found(_)),
            None => self.answer().status == AnswerStatus::Found,
        }
    }

    #[getter]
    fn status(&self) -> &'static str {
        match &self.live {
            Some((_, outcome)) => outcome.status().name(),
            None => self.answer().status.name(),
        }
    }

    #[getter]
    fn reason(&self) -> Option<&str> {
        match &self.live {
            Some((_, formicar::Outcome::NotFound(failure))) => Some(&failure.reason),
            Some(_) => None,
            None => self.answer().reason.as_deref(),
        }
    }

    #[getter]
    fn length_m(&self) -> Option<f64> {
        match &self.live {
            Some((_, formicar::Outcome::Found(plan))) => Some(plan.metrics.length_m),
            Some(_) => None,
            None => self
                .answer()
                .metrics
                .as_ref()
                .map(|metrics| metrics.length_m),
        }
    }

    #[getter]
    fn min_clearance_m(&self) -> Option<f64> {
        match &self.live {
            Some((_, formicar::Outcome::Found(plan))) => Some(plan.certificate.min_clearance_m),
            Some(_) => None,
            None => self
                .answer()
                .metrics
                .as_ref()
                .map(|metrics| metrics.min_clearance_m),
        }
    }

    #[getter]
    fn seed(&self) -> u64 {
        match &self.live {
            Some((asked, _)) => asked.seed.0,
            None => self.answer().seed,
        }
    }

    #[getter]
    fn n_steps(&self) -> Option<u64> {
        self.live.as_ref().map(|(_, outcome)| outcome.n_steps())
    }

    #[getter]
    fn planner_name(&self) -> &str {
        match &self.live {
            Some((asked, _)) => asked.config.planner().name(),
            None => &self.answer().planner,
        }
    }

    /// Times in seconds: of the map's preparation, the first path, the query, and all.
    #[getter]
    fn timing<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::to_python(
            py,
            &match &self.live {
                Some((asked, _)) => asked.timing,
                None => self.answer().timing,
            },
        )
    }

    /// A member of the answer document by name.
    fn member<'py>(&self, name: &str, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let answer = py.detach(|| self.answer());
        match name {
            "certificate" => values::to_python(py, &answer.certificate),
            "metrics" => values::to_python(py, &answer.metrics),
            "explanation" => values::to_python(py, &answer.explanation),
            "colony" => values::to_python(py, &answer.colony),
            "segments" => values::to_python(py, &answer.path.as_ref().map(|p| &p.segments)),
            "provenance" => values::to_python(py, &answer.provenance),
            "cut_by" => values::to_python(py, &answer.cut_by),
            "code" => values::to_python(py, &answer.code),
            _ => values::to_python(py, answer),
        }
    }

    /// The sampled poses, a list for each column.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let poses = py.detach(|| self.answer().path.as_ref().map_or(&[][..], |p| &p.poses));
        let columns = PyDict::new(py);
        let column = |of: &dyn Fn(&formicar::planner::PoseRecord) -> f64| {
            poses.iter().map(of).collect::<Vec<_>>().into_pyarray(py)
        };
        columns.set_item("x", column(&|p| p.x))?;
        columns.set_item("y", column(&|p| p.y))?;
        columns.set_item("heading", column(&|p| p.heading))?;
        columns.set_item("s", column(&|p| p.s))?;
        columns.set_item("direction", column(&|p| p.direction.sign()))?;
        columns.set_item("curvature", column(&|p| p.curvature))?;
        columns.set_item("steer", column(&|p| p.steer.unwrap_or(f64::NAN)))?;
        columns.set_item("clearance", column(&|p| p.clearance))?;
        if poses.first().is_some_and(|pose| pose.time.is_some()) {
            columns.set_item("speed", column(&|p| p.speed.unwrap_or(f64::NAN)))?;
            columns.set_item("time", column(&|p| p.time.unwrap_or(f64::NAN)))?;
        }
        Ok(columns)
    }

    /// Certified paths over the query: time, steps and length of each.
    fn improvements(&self) -> Vec<(f64, u64, f64)> {
        let all = self.improvements.iter();
        all.map(|path| (path.at_s, path.n_steps, path.length_m))
            .collect()
    }

    /// Columns and rows of the cells that a search over cells has found.
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        pairs(&self.trails.cells, py)
    }

    /// Columns and rows of those where its polyline turns.
    fn nodes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        pairs(&self.trails.nodes, py)
    }

    /// Pheromone at the end of a colony's run, row 0 at the bottom.
    fn pheromone<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f32>>>> {
        let values = self.pheromone.as_ref();
        values.map(|values| self.by_cell(values, py)).transpose()
    }

    /// The kept iterations of a colony.
    fn ants<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let frames = self.frames.iter().map(|frame| {
            let members = PyDict::new(py);
            members.set_item("record", values::to_python(py, &frame.record)?)?;
            members.set_item("arrived", traffic(&frame.arrived, py)?)?;
            members.set_item("lost", traffic(&frame.lost, py)?)?;
            let best = frame.best.iter().flat_map(|path| &path.cells);
            let best: Vec<_> = best.map(|cell| [cell.col, cell.row]).collect();
            members.set_item("best", pairs(&best, py)?)?;
            members.set_item("pheromone", self.by_cell(&frame.pheromone, py)?)?;
            Ok(members)
        });
        PyList::new(py, frames.collect::<PyResult<Vec<_>>>()?)
    }

    /// The answer as JSON, as the command line writes it.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| serde_json::to_string(self.answer()).map_err(values::broken))
    }

    /// The poses as CSV, as the command line writes them.
    fn to_csv(&self, py: Python<'_>) -> PyResult<String> {
        let answer = py.detach(|| self.answer());
        let path = answer.path.as_ref();
        let path =
            path.ok_or_else(|| errors::path(format!("the plan has no path: {}", self.status())))?;
        Ok(path.poses_csv())
    }

    /// The picture that the command line draws.
    fn svg(&self, is_small: bool, py: Python<'_>) -> String {
        let layout = if is_small {
            Layout::Phone
        } else {
            Layout::Page
        };
        py.detach(|| self.picture(layout))
    }

    /// The picture of a colony's run; none of other planners, and of a plan that was read.
    fn ants_svg(&self, py: Python<'_>) -> Option<String> {
        let stages = self.stages()?;
        stages.colony.as_ref()?;
        Some(py.detach(|| self.colony_picture(stages)))
    }

    fn grid(&self, py: Python<'_>) -> PyResult<Py<Grid>> {
        let record = self.answer().provenance.map.clone();
        Py::new(py, Grid::new((*self.map).clone(), record))
    }

    fn car(&self, py: Python<'_>) -> PyResult<Py<Car>> {
        Py::new(py, self.car.clone())
    }

    /// Start and goal; of several goals that which was reached.
    #[getter]
    fn ends(&self) -> [(f64, f64, f64); 2] {
        let ends = self.answer().ends();
        ends.map(|pose| (pose.x, pose.y, pose.heading))
    }

    /// True where two plans are the same but for the times that they took.
    fn same_as(&self, other: &Self, py: Python<'_>) -> bool {
        py.detach(|| {
            let (one, other_one) = (self.timeless(), other.timeless());
            let steps = |plan: &Self| {
                let all = plan.improvements.iter();
                all.map(|path| (path.n_steps, path.length_m))
                    .collect::<Vec<_>>()
            };
            one == other_one && self.trails == other.trails && steps(self) == steps(other)
        })
    }

    /// Everything but pictures of ants, as bytes and handles.
    fn state(&self, py: Python<'_>) -> PyResult<State> {
        let whole = Whole {
            answer: self.answer().clone(),
            improvements: self.improvements.clone(),
            trails: self.trails.clone(),
        };
        let text = serde_json::to_string(&whole).map_err(values::broken)?;
        Ok((text, self.grid(py)?, self.car(py)?, self.pheromone.clone()))
    }

    /// The plan of such a state.
    #[staticmethod]
    fn of_state(text: &str, grid: &Grid, car: &Car, pheromone: Option<Vec<f32>>) -> Outcome<Self> {
        let whole: Whole = serde_json::from_str(text).map_err(errors::path)?;
        Ok(Self {
            live: None,
            answer: OnceLock::from(whole.answer),
            map: grid.map.clone(),
            car: car.clone(),
            improvements: whole.improvements,
            trails: whole.trails,
            pheromone,
            frames: Vec::new(),
        })
    }

    /// Writes answer, poses or picture into a file, by its ending.
    fn save(&self, path: PathBuf, py: Python<'_>) -> PyResult<()> {
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        let bytes = match ending.to_str() {
            Some("json") => self.to_json(py)? + "\n",
            Some("csv") => self.to_csv(py)?,
            Some("svg") => self.svg(false, py),
            _ => {
                return Err(errors::path(format!(
                    "{}: expected a name that ends in .json, .csv or .svg",
                    path.display()
                )));
            }
        };
        formicar::map::format::write_atomically(&path, bytes.as_bytes()).map_err(errors::path)
    }
}

/// Answer and course as JSON, map, vehicle, and pheromone.
type State = (String, Py<Grid>, Py<Car>, Option<Vec<f32>>);

/// A plan as it is written for other processes.
#[derive(serde::Serialize, serde::Deserialize)]
struct Whole {
    answer: Answer,
    improvements: Vec<Improvement>,
    trails: Trails,
}

impl Plan {
    fn timeless(&self) -> Answer {
        let mut answer = self.answer().clone();
        answer.timing = Timing::default();
        answer
    }

    fn picture(&self, layout: Layout) -> String {
        let (answer, vehicle) = (self.answer(), &self.car.vehicle);
        if let Some((asked, outcome)) = &self.live {
            let report = outcome.judged().map(|(_, report)| report);
            let picture = AnswerPicture {
                map: &self.map,
                vehicle,
                answer,
                outcome,
                contact: report.map(|report| asked.obstacles.contact(vehicle, report.tightest)),
            };
            return answer_picture(&picture, layout).to_svg();
        }
        let [start, goal] = answer.ends();
        let path = self.path().ok();
        let certificate = answer.certificate.as_ref();
        let picture = PlanPicture {
            path: path.as_ref(),
            failure: answer.explanation.as_ref(),
            tightest: certificate.map(|c| (c.tightest.position(), c.min_clearance_m)),
            title: &answer.title(),
            caption: answer.reason.as_deref().unwrap_or_default(),
            ..PlanPicture::new(&self.map, vehicle, start, goal)
        };
        plan_picture_in(&picture, layout).to_svg()
    }

    fn colony_picture(&self, stages: &Stages) -> String {
        let answer = self.answer();
        let [start, goal] = answer.ends();
        let path = self.path().ok();
        let picture = ColonyPicture {
            map: &self.map,
            vehicle: &self.car.vehicle,
            start,
            goal,
            stages,
            frames: &self.frames,
            path: path.as_ref(),
            title: &answer.title(),
            caption: answer.reason.as_deref().unwrap_or(&answer.planner),
        };
        colony_picture(&picture).to_svg()
    }

    fn by_cell<'py>(&self, values: &[f32], py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let frame = self.map.frame();
        let shape = (frame.n_rows(), frame.n_cols());
        let array = Array2::from_shape_vec(shape, values.to_vec()).map_err(values::broken)?;
        Ok(array.into_pyarray(py))
    }
}

/// Cells as an array of two columns.
fn pairs<'py>(cells: &[[u32; 2]], py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let flat: Vec<u32> = cells.iter().flatten().copied().collect();
    let array = Array2::from_shape_vec((cells.len(), 2), flat).map_err(values::broken)?;
    Ok(array.into_pyarray(py))
}

/// Passages between cells as an array of five columns: both cells, and their number.
fn traffic<'py>(all: &[Traffic], py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let row = |one: &Traffic| {
        let [from, to] = one.cells;
        [from.col, from.row, to.col, to.row, one.n_passed]
    };
    let flat: Vec<u32> = all.iter().flat_map(row).collect();
    let array = Array2::from_shape_vec((all.len(), 5), flat).map_err(values::broken)?;
    Ok(array.into_pyarray(py))
}
