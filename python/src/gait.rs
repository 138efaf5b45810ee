//! What a stroke of a scene does, the best one, and height functions.

use gait::{
    Chain, Found, GaitError, HeightMaps, Limits, Objective, Report, Search, Told, with_stroke,
};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::attend::attend;
use crate::errors;
use crate::scene::NativeScene;

/// What a stroke does, as JSON.
#[pyfunction]
pub fn gait_report(py: Python<'_>, scene: &NativeScene, strokes: u32) -> PyResult<String> {
    let scene = scene.shared();
    let report = attend(py, None, move |_| Report::of(&scene, strokes))?;
    let report = report.map_err(|error| errors::of_gait(py, &error))?;
    serde_json::to_string(&report).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The names of what a stroke may be best by.
#[pyfunction]
pub fn objectives() -> Vec<&'static str> {
    Objective::ALL.map(Objective::name).to_vec()
}

/// The text of the scene with the best stroke, and what the search tells: its own value, the best, and that of each start.
type Best = (String, f64, f64, Vec<Option<f64>>, usize);

/// The best stroke of a scene.
#[pyfunction]
pub fn best_gait(
    py: Python<'_>,
    scene: &NativeScene,
    objective: &str,
    order: usize,
    limits: [f64; 2],
    starts: u64,
    progress: Option<Py<PyAny>>,
) -> PyResult<Best> {
    let objective =
        Objective::named(objective).ok_or_else(|| PyValueError::new_err("no such objective"))?;
    let [angle, rate] = limits;
    let (scene, text) = (scene.shared(), scene.text().to_owned());
    let search = move |desk: &crate::attend::Desk| -> Result<Best, GaitError> {
        let search = Search::new(&scene, objective, Limits { angle, rate })?;
        let own = search.own(order)?;
        let go_on = || !desk.is_stopped();
        let found =
            search.from_starts(&own, starts, &mut |done| desk.reach(done as f64), &go_on)?;
        let best = Found::best(&found).ok_or(GaitError::NoStroke)?;
        let values = found
            .iter()
            .map(|found| found.as_ref().map(|found| found.value));
        Ok((
            with_stroke(&text, search.chain(), &best.stroke, search.from())?,
            search.value(&own)?,
            best.value,
            values.collect(),
            found.iter().flatten().map(|found| found.evaluations).sum(),
        ))
    };
    attend(py, progress, search)?.map_err(|error| errors::of_gait(py, &error))
}

/// The height functions around the scene's stroke, as arrays.
#[pyfunction]
pub fn height_maps<'py>(py: Python<'py>, scene: &NativeScene) -> PyResult<Bound<'py, PyDict>> {
    let scene = scene.shared();
    let maps = attend(py, None, move |_| -> Result<HeightMaps, GaitError> {
        let chain = Chain::new(&scene)?;
        HeightMaps::of(&chain, &Told::new(&scene.model()?)?)
    })?;
    let maps = maps.map_err(|error| errors::of_gait(py, &error))?;
    let arrays = PyDict::new(py);
    let array = |values: &[f64]| PyArray1::from_slice(py, values);
    arrays.set_item("first", array(&maps.first))?;
    arrays.set_item("second", array(&maps.second))?;
    arrays.set_item("heights", array(&maps.heights.concat()))?;
    arrays.set_item("stroke", array(maps.stroke.as_flattened()))?;
    arrays.set_item("by_area", array(&maps.by_area.0))?;
    arrays.set_item("exact", array(&maps.exact.0))?;
    Ok(arrays)
}
