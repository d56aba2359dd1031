//! What a user states: the model file, its diagnostics and units, and a builder with the same content.
