//! The schema that records follow.

use crate::places::root;
use boon::{Compiler, SchemaIndex, Schemas};
use serde_json::Value;

const LOCATION: &str = "study.schema.json";

/// The schema of `study.json`, compiled.
pub struct Schema {
    schemas: Schemas,
    index: SchemaIndex,
}

impl Schema {
    /// Reads it from the repository.
    ///
    /// # Panics
    /// When it is no schema.
    pub fn read() -> Schema {
        let mut schemas = Schemas::new();
        let mut compiler = Compiler::new();
        compiler
            .add_resource(LOCATION, schema())
            .expect("a resource");
        let index = compiler
            .compile(LOCATION, &mut schemas)
            .unwrap_or_else(|e| panic!("the schema is no schema: {e:#}"));
        Schema { schemas, index }
    }

    /// Why a document does not follow the schema.
    pub fn problem(&self, document: &Value) -> Option<String> {
        let result = self.schemas.validate(document, self.index);
        result.err().map(|e| format!("{e:#}"))
    }
}

/// The schema as data.
///
/// # Panics
/// When it cannot be read or is no JSON.
pub fn schema() -> Value {
    let path = root().join("crates/study/schema/study.schema.json");
    let text = std::fs::read_to_string(path).expect("the schema is in the repository");
    serde_json::from_str(&text).expect("the schema is JSON")
}
