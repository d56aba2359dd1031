//! Builds the gallery into the program, so that it can be had from anywhere.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

type Problem = Box<dyn std::error::Error>;

/// The folder of models that cannot be read, which are for tests.
const WRONG: &str = "wrong";

fn main() -> Result<(), Problem> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery");
    println!("cargo:rerun-if-changed={}", gallery.display());
    let mut code = String::from("static ENTRIES: &[Entry] = &[\n");
    for folder in folders(&gallery)? {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        if folder.join("model.toml").is_file() {
            entry(&mut code, &name, &folder)?;
            continue;
        }
        // A group: folders of models that may include each other's files, or models of one file each.
        let members = folders(&folder)?;
        if members.iter().any(|own| own.join("model.toml").is_file()) {
            entry(&mut code, &name, &folder)?;
            for own in members {
                let member = own.file_name().unwrap_or_default().to_string_lossy();
                entry(&mut code, &format!("{name}/{member}"), &own)?;
            }
        } else if name != WRONG {
            for file in texts(&folder)? {
                let member = file.file_stem().unwrap_or_default().to_string_lossy();
                writeln!(code, "Entry {{ name: \"{name}/{member}\", files: &[")?;
                text(&mut code, "model.toml", &file)?;
                writeln!(code, "] }},")?;
            }
        }
    }
    code.push_str("];\n");
    std::fs::write(
        Path::new(&std::env::var("OUT_DIR")?).join("gallery.rs"),
        code,
    )?;
    Ok(())
}

fn folders(parent: &Path) -> Result<Vec<PathBuf>, Problem> {
    let mut found: Vec<PathBuf> = std::fs::read_dir(parent)?
        .filter_map(Result::ok)
        .map(|e| e.path())
        .filter(|path| path.is_dir())
        .collect();
    found.sort();
    Ok(found)
}

fn entry(code: &mut String, name: &str, folder: &Path) -> Result<(), Problem> {
    writeln!(code, "Entry {{ name: {name:?}, files: &[")?;
    for file in texts(folder)? {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        text(code, &name, &file)?;
    }
    writeln!(code, "] }},")?;
    Ok(())
}

/// Models and descriptions of a folder, in the order of their names.
fn texts(folder: &Path) -> Result<Vec<PathBuf>, Problem> {
    let mut files: Vec<_> = std::fs::read_dir(folder)?
        .filter_map(Result::ok)
        .map(|e| e.path())
        .filter(|f| f.extension().is_some_and(|e| e == "toml" || e == "md"))
        .collect();
    files.sort();
    Ok(files)
}

fn text(code: &mut String, name: &str, file: &Path) -> Result<(), Problem> {
    let path = file.canonicalize()?.display().to_string();
    writeln!(code, "({name:?}, include_str!({path:?})),")?;
    Ok(())
}
