//! Any text is a record or an error; what is one can be written again.
#![no_main]

use chetaev_study::verify::read;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(record) = read(text) {
        let _ = format!("{record:?}");
    }
});
