//! The stub of the native part of the Python package, read from the built library: what type checkers and editors know of it.

use pyo3_introspection::{introspect_cdylib, module_stub_files};
use std::fmt::{Display, Formatter};
use std::path::Path;

/// The module that is described.
const MODULE: &str = "chetaev_native";
/// What the file begins with.
const HEAD: &str = "\
# Generated from the native part by `cargo xtask python --stub`. What stands here is changed in crates/python.
";

/// Why there is no stub.
#[derive(Debug)]
pub(crate) enum NoStub {
    /// The library cannot be read, or describes no module.
    Undescribed(String),
    /// It describes more than the one module that it is.
    SeveralFiles,
}

impl Display for NoStub {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            NoStub::Undescribed(why) => write!(f, "the library describes no module: {why}"),
            NoStub::SeveralFiles => {
                f.write_str("the native part is one module, and has a stub of one file")
            }
        }
    }
}

impl std::error::Error for NoStub {}

/// The text of `chetaev_native.pyi`: classes and functions by their names, with their documentation.
///
/// # Errors
/// [`NoStub`].
pub(crate) fn stub(library: &Path) -> Result<String, NoStub> {
    let described = introspect_cdylib(library, MODULE)
        .map_err(|problem| NoStub::Undescribed(format!("{problem:#}")))?;
    let mut files = module_stub_files(&described).into_values();
    match (files.next(), files.next()) {
        (Some(text), None) => Ok(format!("{HEAD}\n{text}")),
        _ => Err(NoStub::SeveralFiles),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// This program is no module of Python.
    #[test]
    fn a_library_that_describes_nothing_has_no_stub() {
        let own = std::env::current_exe().unwrap();
        let said = stub(&own).unwrap_err().to_string();
        assert!(said.contains("No module named chetaev_native"), "{said}");
        let said = stub(Path::new("no such library")).unwrap_err().to_string();
        assert!(said.contains("describes no module"), "{said}");
    }
}
