//! The numbers that Python's formulas are recorded over.

use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt};
use trace::{Binary, Graph, Id, Program, Unary};

use super::recorded::Formula;

/// The graph, until the recording ends.
type Open = Arc<Mutex<Option<Graph>>>;

/// A recording of a formula.
#[pyclass(frozen, module = "lgvi._lgvi")]
pub struct NativeRecording {
    open: Open,
    inputs: usize,
}

/// A formula that was recorded.
#[pyclass(frozen, module = "lgvi._lgvi")]
pub struct NativeFormula {
    pub formula: Formula,
    /// With its results.
    graph: Graph,
}

/// A number of a formula that is being recorded: it has no value.
#[pyclass(frozen, module = "lgvi._lgvi")]
pub struct Tracer {
    of: Open,
    id: Id,
}

/// Whether a number is below another one: known only when the formula is evaluated.
#[pyclass(frozen, module = "lgvi._lgvi")]
pub struct Comparison {
    less: [Py<PyAny>; 2],
    /// What holds where the comparison does not.
    negated: bool,
}

#[pymethods]
impl NativeRecording {
    #[new]
    fn new(inputs: usize) -> Self {
        let open = Arc::new(Mutex::new(Some(Graph::new(inputs))));
        Self { open, inputs }
    }

    fn inputs(&self) -> PyResult<Vec<Tracer>> {
        let tracer = |k| {
            with(&self.open, |graph| graph.input(k)).map(|id| Tracer {
                of: self.open.clone(),
                id,
            })
        };
        (0..self.inputs)
            .map(|k| tracer(k).ok_or_else(ended))
            .collect()
    }

    /// Ends it with these results.
    fn end(&self, py: Python<'_>, outputs: Vec<Bound<'_, PyAny>>) -> PyResult<NativeFormula> {
        let mut ids = Vec::with_capacity(outputs.len());
        for output in &outputs {
            let id = match operand(output) {
                Some(Operand::Tracer(of, id)) if Arc::ptr_eq(&of, &self.open) => Some(id),
                Some(Operand::Tracer(..)) => return Err(refuse(py, FOREIGN)),
                Some(Operand::Number(x)) => with(&self.open, |graph| graph.constant(x)),
                None => {
                    let class = output.get_type().name()?;
                    return Err(PyTypeError::new_err(format!(
                        "a result is of type {class}; expected numbers made of the arguments"
                    )));
                }
            };
            ids.push(id.ok_or_else(ended)?);
        }
        let graph = self
            .open
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        let mut graph = graph.ok_or_else(ended)?;
        graph.set_outputs(&ids);
        Ok(NativeFormula::of(graph))
    }
}

impl NativeFormula {
    fn of(graph: Graph) -> Self {
        let program = Program::new(&graph, graph.outputs()).into();
        Self {
            formula: Formula { program },
            graph,
        }
    }
}

#[pymethods]
impl NativeFormula {
    /// How many instructions an evaluation has.
    #[getter]
    fn instructions(&self) -> usize {
        self.formula.program.instructions()
    }

    #[staticmethod]
    fn restore(graph: &str) -> PyResult<Self> {
        let graph = serde_json::from_str(graph);
        let graph = graph.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(Self::of(graph))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let graph = serde_json::to_string(&slf.get().graph);
        let graph = graph.map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok((slf.get_type().getattr("restore")?, (graph,)))
    }
}

fn ended() -> PyErr {
    PyRuntimeError::new_err("the recording has ended")
}

/// What `f` gives for an open recording.
fn with<O>(open: &Open, f: impl FnOnce(&mut Graph) -> O) -> Option<O> {
    open.lock()
        .unwrap_or_else(PoisonError::into_inner)
        .as_mut()
        .map(f)
}

const FOREIGN: &str =
    "a number of another recording is used: take all from the arguments of the function";

/// The exception that a formula does what it may not, with the user's line.
fn refuse(py: Python<'_>, what: &str) -> PyErr {
    let refused = py
        .import("lgvi._tracing")
        .and_then(|module| module.call_method1("refused", (what,)));
    refused.map_or_else(|error| error, PyErr::from_value)
}

enum Operand {
    Tracer(Open, Id),
    Number(f64),
}

/// What may stand beside a tracer: another one, or a single number.
fn operand(x: &Bound<'_, PyAny>) -> Option<Operand> {
    if let Ok(tracer) = x.cast::<Tracer>() {
        let tracer = tracer.get();
        return Some(Operand::Tracer(tracer.of.clone(), tracer.id));
    }
    let is_number = x.is_instance_of::<PyFloat>()
        || x.is_instance_of::<PyInt>()
        || x.is_instance_of::<PyBool>()
        // A number of numpy's, or an array without axes.
        || x.getattr("ndim").and_then(|ndim| ndim.extract()).is_ok_and(|ndim: usize| ndim == 0);
    match is_number {
        true => x.extract().ok().map(Operand::Number),
        false => None,
    }
}

type Made<'py> = PyResult<Bound<'py, PyAny>>;

impl Tracer {
    /// The number that `build` makes.
    fn make<'py>(&self, py: Python<'py>, build: impl FnOnce(&mut Graph) -> Id) -> Made<'py> {
        match with(&self.of, build) {
            Some(id) => {
                let of = self.of.clone();
                Ok(Bound::new(py, Self { of, id })?.into_any())
            }
            None => Err(refuse(py, "a number is used after its recording has ended")),
        }
    }

    fn unary<'py>(&self, py: Python<'py>, op: Unary) -> Made<'py> {
        self.make(py, |graph| graph.unary(op, self.id))
    }

    /// With another operand; `NotImplemented` where it is no number, so that arrays do it for each of theirs.
    fn binary<'py>(
        &self,
        other: &Bound<'py, PyAny>,
        build: impl FnOnce(&mut Graph, Id, Id) -> Id,
    ) -> Made<'py> {
        let py = other.py();
        match operand(other) {
            Some(Operand::Tracer(of, id)) if Arc::ptr_eq(&of, &self.of) => {
                self.make(py, |graph| build(graph, self.id, id))
            }
            Some(Operand::Tracer(..)) => Err(refuse(py, FOREIGN)),
            Some(Operand::Number(x)) => self.make(py, |graph| {
                let id = graph.constant(x);
                build(graph, self.id, id)
            }),
            None => Ok(py.NotImplemented().into_bound(py)),
        }
    }

    fn power<'py>(&self, py: Python<'py>, exponent: i32) -> Made<'py> {
        self.make(py, |graph| {
            let one = graph.constant(1.0);
            let (mut power, mut square, mut rest) = (one, self.id, exponent.unsigned_abs());
            while rest > 0 {
                if rest & 1 == 1 {
                    power = graph.binary(Binary::Mul, power, square);
                }
                rest >>= 1;
                if rest > 0 {
                    square = graph.binary(Binary::Mul, square, square);
                }
            }
            match exponent < 0 {
                true => graph.binary(Binary::Div, one, power),
                false => power,
            }
        })
    }

    fn compared(
        slf: &Bound<'_, Self>,
        other: &Bound<'_, PyAny>,
        (swapped, negated): (bool, bool),
    ) -> PyResult<Py<PyAny>> {
        let py = slf.py();
        if operand(other).is_none() {
            return Ok(py.NotImplemented());
        }
        let (this, that) = (slf.clone().into_any().unbind(), other.clone().unbind());
        let less = if swapped { [that, this] } else { [this, that] };
        Ok(Py::new(py, Comparison { less, negated })?.into_any())
    }
}

// A term without weight is no term: the zeros of a matrix leave nothing behind.

fn is_zero(graph: &Graph, x: Id) -> bool {
    graph.as_constant(x) == Some(0.0)
}

fn sum(graph: &mut Graph, x: Id, y: Id) -> Id {
    match (is_zero(graph, x), is_zero(graph, y)) {
        (_, true) => x,
        (true, _) => y,
        _ => graph.binary(Binary::Add, x, y),
    }
}

fn difference(graph: &mut Graph, x: Id, y: Id) -> Id {
    match (is_zero(graph, x), is_zero(graph, y)) {
        (_, true) => x,
        (true, _) => graph.unary(Unary::Neg, y),
        _ => graph.binary(Binary::Sub, x, y),
    }
}

fn product(graph: &mut Graph, x: Id, y: Id) -> Id {
    match is_zero(graph, x) || is_zero(graph, y) {
        true => graph.constant(0.0),
        false => graph.binary(Binary::Mul, x, y),
    }
}

/// The powers that are products of so many factors at most.
const FACTORS: f64 = 64.0;

/// $\sqrt{1 - x^2}$.
fn cosine_of(graph: &mut Graph, sine: Id) -> Id {
    let one = graph.constant(1.0);
    let square = graph.neg_mul_add([sine, sine, one]);
    graph.unary(Unary::Sqrt, square)
}

/// $(e^x \pm e^{-x}) / 2$.
fn hyperbolic(graph: &mut Graph, op: Binary, x: Id) -> Id {
    let minus = graph.unary(Unary::Neg, x);
    let (up, down) = (graph.unary(Unary::Exp, x), graph.unary(Unary::Exp, minus));
    let (sum, half) = (graph.binary(op, up, down), graph.constant(0.5));
    graph.binary(Binary::Mul, sum, half)
}

#[pymethods]
impl Tracer {
    fn __add__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, sum)
    }
    fn __radd__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, sum)
    }
    fn __sub__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, difference)
    }
    fn __rsub__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, |graph, x, y| difference(graph, y, x))
    }
    fn __mul__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, product)
    }
    fn __rmul__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, product)
    }
    fn __truediv__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, |graph, x, y| graph.binary(Binary::Div, x, y))
    }
    fn __rtruediv__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, |graph, x, y| graph.binary(Binary::Div, y, x))
    }
    fn __mod__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        Err(refuse(other.py(), "% jumps, and has no derivative there"))
    }
    fn __floordiv__<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        Err(refuse(other.py(), "// jumps, and has no derivative there"))
    }
    fn __neg__<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.unary(py, Unary::Neg)
    }
    fn __pos__<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |_| self.id)
    }
    fn __abs__<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |graph| {
            let (zero, minus) = (graph.constant(0.0), graph.unary(Unary::Neg, self.id));
            graph.select([self.id, zero], minus, self.id)
        })
    }
    fn __pow__<'py>(
        &self,
        other: &Bound<'py, PyAny>,
        modulo: Option<Bound<'py, PyAny>>,
    ) -> Made<'py> {
        let py = other.py();
        if modulo.is_some() {
            return Err(refuse(py, "a power has no modulus here"));
        }
        match operand(other) {
            Some(Operand::Number(0.5)) => self.unary(py, Unary::Sqrt),
            Some(Operand::Number(n)) if n.fract() == 0.0 && n.abs() <= FACTORS => {
                self.power(py, n as i32)
            }
            _ => self.binary(other, |graph, x, y| {
                let logarithm = graph.unary(Unary::Ln, x);
                let product = graph.binary(Binary::Mul, y, logarithm);
                graph.unary(Unary::Exp, product)
            }),
        }
    }
    fn __rpow__<'py>(
        &self,
        other: &Bound<'py, PyAny>,
        _modulo: Option<Bound<'py, PyAny>>,
    ) -> Made<'py> {
        self.binary(other, |graph, x, y| {
            let logarithm = graph.unary(Unary::Ln, y);
            let product = graph.binary(Binary::Mul, x, logarithm);
            graph.unary(Unary::Exp, product)
        })
    }

    fn __lt__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        Self::compared(slf, other, (false, false))
    }
    fn __gt__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        Self::compared(slf, other, (true, false))
    }
    fn __le__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        Self::compared(slf, other, (true, true))
    }
    fn __ge__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        Self::compared(slf, other, (false, true))
    }
    fn __eq__(&self, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        Err(refuse(other.py(), "== asks for a value"))
    }
    fn __ne__(&self, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        Err(refuse(other.py(), "!= asks for a value"))
    }
    fn __bool__(&self, py: Python<'_>) -> PyResult<bool> {
        Err(refuse(py, "a branch asks for a value"))
    }
    fn __float__(&self, py: Python<'_>) -> PyResult<f64> {
        Err(refuse(
            py,
            "float() asks for a value: use np.sin and its like, not math.sin; make arrays by np.array([...]), or with dtype=object",
        ))
    }
    fn __int__(&self, py: Python<'_>) -> PyResult<i64> {
        Err(refuse(py, "int() asks for a value"))
    }
    fn __index__(&self, py: Python<'_>) -> PyResult<i64> {
        Err(refuse(py, "an index asks for a value"))
    }
    fn __complex__(&self, py: Python<'_>) -> PyResult<f64> {
        Err(refuse(
            py,
            "complex() asks for a value; numbers are real here",
        ))
    }
    fn __round__(&self, py: Python<'_>) -> PyResult<f64> {
        Err(refuse(py, "round() jumps, and has no derivative there"))
    }
    fn __hash__(&self) -> isize {
        std::ptr::from_ref(self) as isize
    }
    fn __repr__(&self) -> &'static str {
        "<traced number>"
    }

    // What numpy calls on the elements of an array.
    fn sqrt<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.unary(py, Unary::Sqrt)
    }
    fn exp<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.unary(py, Unary::Exp)
    }
    fn log<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.unary(py, Unary::Ln)
    }
    fn sin<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.unary(py, Unary::Sin)
    }
    fn cos<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.unary(py, Unary::Cos)
    }
    fn tan<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |graph| {
            let (sin, cos) = (
                graph.unary(Unary::Sin, self.id),
                graph.unary(Unary::Cos, self.id),
            );
            graph.binary(Binary::Div, sin, cos)
        })
    }
    fn tanh<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.unary(py, Unary::Tanh)
    }
    fn sinh<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |graph| hyperbolic(graph, Binary::Sub, self.id))
    }
    fn cosh<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |graph| hyperbolic(graph, Binary::Add, self.id))
    }
    fn arctan<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |graph| {
            let one = graph.constant(1.0);
            graph.binary(Binary::Atan2, self.id, one)
        })
    }
    fn arcsin<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |graph| {
            let cosine = cosine_of(graph, self.id);
            graph.binary(Binary::Atan2, self.id, cosine)
        })
    }
    fn arccos<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |graph| {
            let sine = cosine_of(graph, self.id);
            graph.binary(Binary::Atan2, sine, self.id)
        })
    }
    fn arctan2<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, |graph, y, x| graph.binary(Binary::Atan2, y, x))
    }
    fn hypot<'py>(&self, other: &Bound<'py, PyAny>) -> Made<'py> {
        self.binary(other, |graph, x, y| {
            let square = graph.binary(Binary::Mul, y, y);
            let sum = graph.mul_add([x, x, square]);
            graph.unary(Unary::Sqrt, sum)
        })
    }
    fn conjugate<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.make(py, |_| self.id)
    }
    fn fabs<'py>(&self, py: Python<'py>) -> Made<'py> {
        self.__abs__(py)
    }
}

#[pymethods]
impl Comparison {
    fn __bool__(&self, py: Python<'_>) -> PyResult<bool> {
        Err(refuse(py, "a branch asks how numbers compare"))
    }

    /// `yes` where it holds, `no` elsewhere; both are computed.
    fn choose<'py>(&self, yes: Bound<'py, PyAny>, no: Bound<'py, PyAny>) -> Made<'py> {
        let py = yes.py();
        let [l, r] = self.less.each_ref().map(|x| x.bind(py).clone());
        let (yes, no) = if self.negated { (no, yes) } else { (yes, no) };
        let operands = [l, r, yes, no];
        let tracer = operands.iter().find_map(|x| x.cast::<Tracer>().ok());
        let Some(tracer) = tracer else {
            return Err(PyTypeError::new_err("a comparison without a traced number"));
        };
        let of = &tracer.get().of;
        let mut ids = Vec::with_capacity(operands.len());
        for x in &operands {
            ids.push(match operand(x) {
                Some(Operand::Tracer(theirs, id)) if Arc::ptr_eq(&theirs, of) => id,
                Some(Operand::Number(x)) => {
                    with(of, |graph| graph.constant(x)).ok_or_else(ended)?
                }
                _ => return Err(refuse(py, "where() takes single numbers of one recording")),
            });
        }
        tracer
            .get()
            .make(py, |graph| graph.select([ids[0], ids[1]], ids[2], ids[3]))
    }
}
