//! Builds the gallery into the program, so that `chetaev gallery` works from anywhere.

use std::fmt::Write as _;
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery");
    println!("cargo:rerun-if-changed={}", gallery.display());
    let mut code = String::from("static ENTRIES: &[Entry] = &[\n");
    let mut folders: Vec<_> = std::fs::read_dir(&gallery)?
        .filter_map(Result::ok)
        .map(|e| e.path())
        .collect();
    folders.sort();
    for folder in folders.iter().filter(|f| f.join("model.toml").is_file()) {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        writeln!(code, "Entry {{ name: {name:?}, files: &[")?;
        let mut files: Vec<_> = std::fs::read_dir(folder)?
            .filter_map(Result::ok)
            .map(|e| e.path())
            .collect();
        files.sort();
        for file in files
            .iter()
            .filter(|f| f.extension().is_some_and(|e| e == "toml" || e == "md"))
        {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let path = file.canonicalize()?;
            writeln!(
                code,
                "({name:?}, include_str!({:?})),",
                path.display().to_string()
            )?;
        }
        writeln!(code, "] }},")?;
    }
    code.push_str("];\n");
    std::fs::write(
        Path::new(&std::env::var("OUT_DIR")?).join("gallery.rs"),
        code,
    )?;
    Ok(())
}
