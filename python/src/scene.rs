//! A scene with the files that it was read of.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use articulated_fluid::scene::{self, Scene, SceneError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use urdf::{Base, Options, ShapeFrom};

use crate::attend::attend;
use crate::errors;
use crate::replace::replace;
use crate::run::{Arguments, Wanted, page, run};

const FISH: &str = include_str!("../../scenes/fish-chain.toml");

/// The text of a scene and of the tables that it names, by their paths.
type Files = BTreeMap<PathBuf, Arc<[u8]>>;

/// What `lgvi.Scene` holds.
#[pyclass(frozen, name = "NativeScene")]
pub struct NativeScene {
    file: PathBuf,
    files: Files,
    scene: Arc<Scene>,
}

impl NativeScene {
    pub fn shared(&self) -> Arc<Scene> {
        self.scene.clone()
    }

    /// Reads a scene from these files, and from the disk what is not among them; keeps all that was read.
    fn read(py: Python<'_>, file: PathBuf, given: Files) -> PyResult<Self> {
        let files = RefCell::new(Files::new());
        let reads = |path: &Path| -> io::Result<Vec<u8>> {
            let bytes = match given.get(path) {
                Some(bytes) => bytes.clone(),
                None => scene::read_bounded(path)?.into(),
            };
            files.borrow_mut().insert(path.to_owned(), bytes.clone());
            Ok(bytes.to_vec())
        };
        let scene = Scene::load_by(&file, &reads);
        let scene = Arc::new(scene.map_err(|error: SceneError| errors::of_scene(py, &error))?);
        let files = files.into_inner();
        Ok(Self { file, files, scene })
    }

    pub fn text(&self) -> &str {
        // The scene was read of it.
        let text = self.files.get(&self.file);
        text.and_then(|bytes| str::from_utf8(bytes).ok())
            .unwrap_or_default()
    }
}

/// The error that an argument is none of those expected.
fn unknown(name: &str, given: &str, expected: &str) -> PyErr {
    PyValueError::new_err(format!("{name} is {given:?}; expected {expected}"))
}

#[pymethods]
impl NativeScene {
    #[staticmethod]
    fn load(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        Self::read(py, file, Files::new())
    }

    #[staticmethod]
    fn parse(py: Python<'_>, text: &str, file: PathBuf) -> PyResult<Self> {
        let files = Files::from([(file.clone(), text.as_bytes().into())]);
        Self::read(py, file, files)
    }

    #[staticmethod]
    fn example(py: Python<'_>) -> PyResult<Self> {
        Self::parse(py, FISH, "fish-chain.toml".into())
    }

    /// The scene of a robot, and what of the robot is not in it.
    #[staticmethod]
    fn from_urdf(
        py: Python<'_>,
        file: PathBuf,
        density: f64,
        base: Option<&str>,
        shape_from: &str,
    ) -> PyResult<(Self, Vec<String>)> {
        let options = Options {
            density,
            base: match base {
                None => None,
                Some("free") => Some(Base::Free),
                Some("world") => Some(Base::World),
                Some(other) => return Err(unknown("base", other, "\"free\", \"world\" or None")),
            },
            shape_from: match shape_from {
                "collision" => ShapeFrom::Collision,
                "inertia" => ShapeFrom::Inertia,
                other => {
                    let expected = "\"collision\" or \"inertia\"";
                    return Err(unknown("shape_from", other, expected));
                }
            },
        };
        let imported = urdf::load(&file, &options);
        let imported = imported.map_err(|error| errors::of_robot(py, &file, &error))?;
        let scene = Self::parse(py, &imported.text, file.with_extension("toml"))?;
        let notes = imported.notes.iter().map(ToString::to_string).collect();
        Ok((scene, notes))
    }

    /// From what [`state`](Self::state) gives.
    #[staticmethod]
    fn restore(py: Python<'_>, file: PathBuf, files: BTreeMap<PathBuf, Vec<u8>>) -> PyResult<Self> {
        let files = files.into_iter().map(|(path, bytes)| (path, bytes.into()));
        Self::read(py, file, files.collect())
    }

    /// The path, and the bytes of all files by their paths.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<(PathBuf, Bound<'py, PyDict>)> {
        let files = PyDict::new(py);
        for (path, bytes) in &self.files {
            files.set_item(path, PyBytes::new(py, bytes))?;
        }
        Ok((self.file.clone(), files))
    }

    fn replace(&self, py: Python<'_>, changes: &Bound<'_, PyDict>) -> PyResult<Self> {
        let text = replace(self.text(), changes)?;
        let mut files = self.files.clone();
        files.insert(self.file.clone(), text.as_bytes().into());
        Self::read(py, self.file.clone(), files)
    }

    fn simulate<'py>(
        &self,
        py: Python<'py>,
        arguments: Arguments,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (scene, wanted) = (self.shared(), Wanted::new(arguments)?);
        let outcome = attend(py, progress, move |desk| run(&scene, &wanted, desk))?;
        match outcome.map_err(|error| errors::of_run(py, &error))? {
            Some(trajectory) => trajectory.into_dict(py),
            None => Err(PyValueError::new_err("the run was stopped")),
        }
    }

    /// A page with a moving picture of a run.
    fn page(&self, py: Python<'_>, arguments: Arguments) -> PyResult<String> {
        let (scene, wanted) = (self.shared(), Wanted::new(arguments)?);
        let work = move |desk: &_| page(&scene, &wanted, desk);
        match attend(py, None, work)?.map_err(|error| errors::of_run(py, &error))? {
            Some(page) => Ok(page),
            None => Err(PyValueError::new_err("the run was stopped")),
        }
    }

    #[getter]
    fn file(&self) -> PathBuf {
        self.file.clone()
    }

    #[getter(text)]
    fn text_of_scene(&self) -> &str {
        self.text()
    }

    #[getter]
    fn title(&self) -> Option<&str> {
        self.scene.title.as_deref()
    }

    #[getter]
    fn bodies(&self) -> Vec<&str> {
        self.scene
            .bodies
            .iter()
            .map(|body| &body.name[..])
            .collect()
    }

    #[getter]
    fn joints(&self) -> Vec<&str> {
        let mount = self.scene.mount.iter().map(|mount| &mount.name[..]);
        let joints = self.scene.joints.iter().map(|joint| &joint.name[..]);
        mount.chain(joints).collect()
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.scene.notes.iter().map(ToString::to_string).collect()
    }

    /// The documentation of all keys of a scene file.
    #[staticmethod]
    fn keys() -> String {
        scene::reference()
    }
}
