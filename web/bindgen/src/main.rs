//! `chetaev-bindgen MODULE FOLDER`: the glue of a module for a worker of a page, and the module without what only the glue needed, packed.

use lzma_rust2::{CheckType, XzOptions, XzWriter};
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let mut words = std::env::args().skip(1);
    let (Some(module), Some(folder)) = (words.next(), words.next()) else {
        eprintln!("usage: chetaev-bindgen MODULE FOLDER");
        return ExitCode::from(2);
    };
    match glued(&module, Path::new(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem:?}");
            ExitCode::FAILURE
        }
    }
}

fn glued(module: &str, folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name("chetaev");
    bindgen.remove_name_section(true).remove_producers_section(true);
    bindgen.typescript(true);
    bindgen.web(true).and_then(|own| own.generate(folder))?;
    let module = std::fs::read(folder.join("chetaev_bg.wasm"))?;
    std::fs::write(folder.join("chetaev_bg.wasm.xz"), packed(&module)?)?;
    Ok(())
}

/// Bytes that whoever unpacks it has to remember.
const MEMORY: u32 = 1 << 24;

/// A module is a third smaller by LZMA2 than by what browsers unpack themselves. Its page unpacks it by xz-embedded, which knows this checksum.
fn packed(module: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut options = XzOptions::with_preset(9);
    options.set_check_sum_type(CheckType::Crc32);
    options.lzma_options.dict_size = MEMORY;
    let mut writer = XzWriter::new(Vec::new(), options)?;
    writer.write_all(module)?;
    writer.finish()
}
