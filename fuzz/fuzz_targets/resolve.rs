//! Any text is a model or gives diagnostics, which can be rendered; there is a model exactly where there is no error.
#![no_main]

use chetaev_model::{load, NoFiles, Style};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let loaded = load("model.toml", text, &NoFiles, &[]);
    let has_model = loaded.model.is_some();
    match loaded.into_result() {
        Ok((_, warnings)) => {
            assert!(has_model);
            let _ = warnings.render(Style::Plain);
        }
        Err(errors) => {
            assert!(!has_model);
            assert!(!errors.render(Style::Plain).is_empty());
        }
    }
});
