//! Values of Python as documents, and documents as values of Python.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Number, Value};

/// Makes an exception of a message.
pub(crate) type Refuse = fn(String) -> PyErr;

/// How deep a value may be nested.
const MAX_DEPTH: usize = 16;

/// A value as JSON: `None`, booleans, numbers, strings, mappings, sequences, and what has a
/// `tolist`, as the arrays and scalars of `NumPy` have. `name` is what messages
/// call it, and `refuse` makes the exception for a number that is not finite.
pub(crate) fn to_json(value: &Bound<'_, PyAny>, name: &str, refuse: Refuse) -> PyResult<Value> {
    nested(value, name, (MAX_DEPTH, refuse))
}

type How = (usize, Refuse);

fn nested(value: &Bound<'_, PyAny>, name: &str, how: How) -> PyResult<Value> {
    let (depth, refuse) = how;
    if depth == 0 {
        return Err(refuse(format!("{name} is nested too deep")));
    }
    if value.is_none() {
        return Ok(Value::Null);
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Value::Bool(flag.is_true()));
    }
    if value.is_instance_of::<PyInt>() {
        return integer(value, name, refuse);
    }
    if value.is_instance_of::<PyFloat>() {
        return number(value.extract()?, name, refuse);
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_str()?.to_owned()));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        return mapping(dict, name, (depth - 1, refuse));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        return sequence(value, name, (depth - 1, refuse));
    }
    if value.hasattr("tolist")? {
        return nested(&value.call_method0("tolist")?, name, (depth - 1, refuse));
    }
    if let Ok(real) = value.extract::<f64>() {
        return number(real, name, refuse);
    }
    let kind = value.get_type().qualname()?;
    Err(PyTypeError::new_err(format!(
        "{name} is of type {kind}; expected numbers, strings, lists, arrays or dicts"
    )))
}

fn integer(value: &Bound<'_, PyAny>, name: &str, refuse: Refuse) -> PyResult<Value> {
    if let Ok(whole) = value.extract::<i64>() {
        return Ok(Value::from(whole));
    }
    match value.extract::<u64>() {
        Ok(whole) => Ok(Value::from(whole)),
        Err(_) => number(value.extract()?, name, refuse),
    }
}

fn number(value: f64, name: &str, refuse: Refuse) -> PyResult<Value> {
    let finite = Number::from_f64(value).map(Value::Number);
    finite.ok_or_else(|| refuse(format!("{name} is not finite: {value}")))
}

fn mapping(dict: &Bound<'_, PyDict>, name: &str, how: How) -> PyResult<Value> {
    let mut members = Map::new();
    for (key, value) in dict {
        let key: String = key
            .extract()
            .map_err(|_| PyTypeError::new_err(format!("{name}: the key {key} is no string")))?;
        let value = nested(&value, &key, how)?;
        members.insert(key, value);
    }
    Ok(Value::Object(members))
}

fn sequence(value: &Bound<'_, PyAny>, name: &str, how: How) -> PyResult<Value> {
    let items = value.try_iter()?;
    let items = items.map(|item| nested(&item?, name, how));
    Ok(Value::Array(items.collect::<PyResult<_>>()?))
}

/// A document as dicts, lists, numbers and strings.
pub(crate) fn to_python<'py>(
    py: Python<'py>,
    document: &impl Serialize,
) -> PyResult<Bound<'py, PyAny>> {
    let value = serde_json::to_value(document).map_err(broken)?;
    from_json(py, &value)
}

/// JSON as dicts, lists, numbers and strings.
pub(crate) fn from_json<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_u64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (None, Some(whole)) => whole.into_pyobject(py)?.into_any(),
            (None, None) => PyFloat::new(py, number.as_f64().unwrap_or(f64::NAN)).into_any(),
        },
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|item| from_json(py, item));
            PyList::new(py, items.collect::<PyResult<Vec<_>>>()?)?.into_any()
        }
        Value::Object(members) => {
            let dict = PyDict::new(py);
            for (key, value) in members {
                dict.set_item(key, from_json(py, value)?)?;
            }
            dict.into_any()
        }
    })
}

/// A document of Python as a type of the library; of several keys that which is wrong is named.
pub(crate) fn document<T: DeserializeOwned>(
    value: Value,
    name: &str,
    refuse: Refuse,
) -> PyResult<T> {
    let error = match serde_json::from_value(value.clone()) {
        Ok(document) => return Ok(document),
        Err(error) => error,
    };
    let Value::Object(members) = value else {
        return Err(refuse(format!("{name}: {error}")));
    };
    let alone = |(key, value): (String, Value)| {
        let one = Value::Object(Map::from_iter([(key.clone(), value.clone())]));
        let told = serde_json::from_value::<T>(one).err()?.to_string();
        let is_cause = told == error.to_string();
        is_cause.then(|| format!("{key} = {}: {told}", shortened(&value)))
    };
    let named = members.into_iter().find_map(alone);
    Err(refuse(named.unwrap_or_else(|| format!("{name}: {error}"))))
}

/// As much of a value as a message should repeat.
fn shortened(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= 60 {
        return text;
    }
    let beginning: String = text.chars().take(57).collect();
    format!("{beginning}...")
}

/// An error that no input should be able to cause.
pub(crate) fn broken(error: impl std::fmt::Display) -> PyErr {
    pyo3::exceptions::PyRuntimeError::new_err(error.to_string())
}
