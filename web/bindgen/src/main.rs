//! `chetaev-bindgen MODULE FOLDER`: the glue of a module for a worker of a page, and the module without what only the glue needed.

use std::process::ExitCode;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let mut words = std::env::args().skip(1);
    let (Some(module), Some(folder)) = (words.next(), words.next()) else {
        eprintln!("usage: chetaev-bindgen MODULE FOLDER");
        return ExitCode::from(2);
    };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name("chetaev");
    bindgen.remove_name_section(true).remove_producers_section(true);
    bindgen.typescript(true);
    let made = bindgen.web(true).and_then(|own| own.generate(folder));
    match made {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem:?}");
            ExitCode::FAILURE
        }
    }
}
