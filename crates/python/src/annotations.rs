//! Objects of Python with the annotations of the stub that PyO3 cannot know: functions, mappings, and arrays of NumPy. The names of arrays of fixed
//! numbers of axes are those of `python/chetaev/shapes.py`.
//!
//! Annotations of lists, for which PyO3 writes all that would do, stand in the signatures themselves.

use numpy::{PyArray1, PyArray2};
use pyo3::inspect::{PyStaticConstant, PyStaticExpr};
use pyo3::prelude::*;
use pyo3::{type_hint_identifier, type_hint_subscript, type_hint_union};
use std::convert::Infallible;
use std::ops::Deref;

/// An argument: any object, which the work itself examines.
macro_rules! argument {
    ($(#[$doc:meta])* $name:ident: $annotation:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub(crate) struct $name<'a, 'py>(Borrowed<'a, 'py, PyAny>);

        impl<'a, 'py> FromPyObject<'a, 'py> for $name<'a, 'py> {
            type Error = Infallible;
            const INPUT_TYPE: PyStaticExpr = $annotation;

            fn extract(own: Borrowed<'a, 'py, PyAny>) -> Result<Self, Infallible> {
                Ok($name(own))
            }
        }

        impl<'py> Deref for $name<'_, 'py> {
            type Target = Bound<'py, PyAny>;

            fn deref(&self) -> &Bound<'py, PyAny> {
                &self.0
            }
        }
    };
}

/// A value that is given back.
macro_rules! value {
    ($(#[$doc:meta])* $name:ident($object:ty): $annotation:expr) => {
        $(#[$doc])*
        pub(crate) struct $name<'py>(pub(crate) Bound<'py, $object>);

        impl<'py> IntoPyObject<'py> for $name<'py> {
            type Target = $object;
            type Output = Bound<'py, $object>;
            type Error = Infallible;
            const OUTPUT_TYPE: PyStaticExpr = $annotation;

            fn into_pyobject(self, _: Python<'py>) -> Result<Self::Output, Infallible> {
                Ok(self.0)
            }
        }
    };
}

argument! {
    /// What long work tells: what is being done, and which part of it is done, in [0, 1] or `None`.
    Tell: type_hint_subscript!(FUNCTION, PyStaticExpr::List { elts: &[TEXT, type_hint_union!(FLOAT, NONE)] }, NONE)
}
argument! {
    /// The checksum of a file by its name; `None` where there is no such file.
    Checksum: type_hint_subscript!(FUNCTION, PyStaticExpr::List { elts: &[TEXT] }, type_hint_union!(TEXT, NONE))
}
argument! {
    /// Options by their names.
    Keywords: type_hint_subscript!(MAPPING, TEXT, type_hint_identifier!("builtins", "object"))
}
argument! {
    /// What NumPy makes an array of.
    ArrayLike: type_hint_identifier!("numpy.typing", "ArrayLike")
}
argument! {
    /// An array of doubles into which values are written.
    Target: ARRAY_OF_DOUBLES
}

value! {
    /// An array of doubles with any number of axes.
    Doubles(PyAny): ARRAY_OF_DOUBLES
}
value! {
    /// An array of doubles, or of integers.
    Column(PyAny): type_hint_subscript!(ARRAY, type_hint_identifier!("typing", "Any"))
}
value! {
    /// Doubles.
    Vector(PyArray1<f64>): type_hint_identifier!("chetaev.shapes", "Vector")
}
value! {
    /// Rows of doubles.
    Matrix(PyArray2<f64>): type_hint_identifier!("chetaev.shapes", "Matrix")
}
value! {
    /// Integers that are not negative.
    Numbers(PyArray1<u64>): type_hint_identifier!("chetaev.shapes", "Numbers")
}

const NONE: PyStaticExpr = PyStaticExpr::Constant {
    value: PyStaticConstant::None,
};
const TEXT: PyStaticExpr = type_hint_identifier!("builtins", "str");
const FLOAT: PyStaticExpr = type_hint_identifier!("builtins", "float");
const FUNCTION: PyStaticExpr = type_hint_identifier!("collections.abc", "Callable");
const MAPPING: PyStaticExpr = type_hint_identifier!("collections.abc", "Mapping");
const ARRAY: PyStaticExpr = type_hint_identifier!("numpy.typing", "NDArray");
const ARRAY_OF_DOUBLES: PyStaticExpr =
    type_hint_subscript!(ARRAY, type_hint_identifier!("numpy", "float64"));
