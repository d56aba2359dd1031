//! `chetaev plot` and `chetaev film`: the motion as a picture.

use super::{error, options, refuse, with_hooks};
use crate::arguments::{Film, ModelArguments, MotionArguments, Plot};
use crate::{files, terminal, DONE, INPUT};
use chetaev::study::picture::{self, PictureError, Scene, View};
use chetaev::study::{study, ClaimSelection, StudyOptions};
use std::path::{Path, PathBuf};

pub(crate) fn run(arguments: &Plot) -> u8 {
    let scene = match scene(&arguments.model, &arguments.motion) {
        Ok(scene) => scene,
        Err(status) => return status,
    };
    let view = View {
        width: arguments.width,
        height: arguments.height,
        time: arguments.at,
        ghosts: arguments.ghosts as usize,
    };
    let path = place(arguments.out.as_ref(), &arguments.model, "picture.svg");
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    let content = match ending {
        "svg" => picture::svg(&scene, &view).map(String::into_bytes),
        "png" => picture::png(&scene, &view),
        "json" => Ok(picture::to_json(&scene).into_bytes()),
        _ => {
            error(format!(
                "--out {}: a picture is written as .svg or .png, its description as .json",
                path.display()
            ));
            return INPUT;
        }
    };
    finish(&path, content)
}

pub(crate) fn film(arguments: &Film) -> u8 {
    let path = place(arguments.out.as_ref(), &arguments.model, "film.gif");
    if path.extension().and_then(|e| e.to_str()) != Some("gif") {
        error(format!(
            "--out {}: a film is written as .gif; the page of `chetaev study` records others",
            path.display()
        ));
        return INPUT;
    }
    let scene = match scene(&arguments.model, &arguments.motion) {
        Ok(scene) => scene,
        Err(status) => return status,
    };
    let view = View {
        width: arguments.width,
        height: arguments.height,
        ..View::default()
    };
    let length = match (scene.times.first(), scene.times.last()) {
        (Some(first), Some(last)) => (last - first).abs().clamp(2.0, 20.0),
        _ => 2.0,
    };
    finish(
        &path,
        picture::gif(&scene, &view, arguments.seconds.unwrap_or(length)),
    )
}

/// The file that was asked for, or one beside the other files of the model.
fn place(out: Option<&PathBuf>, model: &ModelArguments, name: &str) -> PathBuf {
    out.cloned()
        .unwrap_or_else(|| files::default_folder(&model.model).join(name))
}

fn finish(path: &Path, content: Result<Vec<u8>, PictureError>) -> u8 {
    let written = content
        .map_err(|problem| problem.to_string())
        .and_then(|content| files::write(path, &content));
    match written {
        Ok(()) => {
            terminal::out(&format!("wrote {}\n", path.display()));
            DONE
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

/// The scene of a `scene.json`, or of the motion of a model; else the exit status, where the reason was said.
fn scene(model: &ModelArguments, motion: &MotionArguments) -> Result<Scene, u8> {
    if model.model.extension().is_some_and(|e| e == "json") {
        let read = std::fs::read_to_string(&model.model).map_err(|problem| problem.to_string());
        let read = read.and_then(|text| picture::from_json(&text).map_err(|p| p.to_string()));
        return read.map_err(|problem| {
            error(format!("{}: {problem}", model.model.display()));
            INPUT
        });
    }
    let read = files::model(model).ok_or(INPUT)?;
    let asked = options(motion, &read.model).ok_or(INPUT)?;
    let options = StudyOptions {
        claims: ClaimSelection {
            words: vec!["motion.constraint-drift".into()],
        },
        ..asked
    };
    let found = with_hooks(|hooks| study(read.model.clone(), options, hooks))
        .map_err(|problem| refuse(&problem, motion, &read))?;
    picture::scene(&found).ok_or_else(|| {
        error(if found.notices.is_empty() {
            "no motion was computed, so that there is nothing to draw".to_owned()
        } else {
            found.notices.join("\n")
        });
        INPUT
    })
}
