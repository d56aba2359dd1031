//! `model.flat` of a record, read as a model, is the same system.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::mechanics::System;
use chetaev::model::Model;
use chetaev::study::flat::flat;
use chetaev_tests::places::gallery;
use chetaev_tests::studied::loaded;

fn read(text: &str) -> Model {
    let loaded = chetaev::model::load("flat.toml", text, &chetaev::model::NoFiles, &[]);
    let (model, _) = loaded.into_result().expect("a lowered model is a model");
    model
}

/// Everything that the equations of motion follow from, as text without shared parts.
fn content(model: &Model) -> Vec<String> {
    let system = System::from_model(model).expect("a system");
    let g = &system.graph;
    let mut out = vec![g.text(system.lagrangian)];
    out.extend(system.forces.iter().map(|&force| g.text(force)));
    for c in &system.constraints {
        out.push(format!("{}: {}", c.name, g.text(c.stated)));
    }
    for m in &system.masses {
        out.push(format!("{}' = {}", m.name, g.text(m.rate)));
    }
    out.extend(
        system
            .quasi_velocities
            .iter()
            .map(|u| format!("{} = {}", u.name, g.text(u.definition))),
    );
    out.extend(
        system
            .integrals
            .iter()
            .map(|(name, e)| format!("{name} = {}", g.text(*e))),
    );
    out.extend(
        system
            .parameters
            .iter()
            .map(|p| format!("{} = {:?}", p.name, p.value.map(|e| g.text(e)))),
    );
    out
}

#[test]
fn a_lowered_model_is_the_same_system() {
    let mut read_back = 0;
    for path in gallery() {
        let Ok((model, _)) = loaded(&path, &[]).into_result() else {
            continue;
        };
        let system = System::from_model(&model).expect("a system");
        let Some(text) = flat(&model, &system) else {
            continue;
        };
        let (found, expected) = (content(&read(&text)), content(&model));
        let partial = !system.integral_conditions.is_empty() || system.frame.is_some();
        let different = expected.iter().filter(|line| !found.contains(line));
        // Integrals on a part of the states, and fields whose inverse has no formula, are left out.
        let different: Vec<_> = different
            .filter(|line| !(partial && line.contains(" = ")))
            .collect();
        assert!(
            different.is_empty(),
            "{}: {different:#?}\n{text}",
            path.display()
        );
        read_back += 1;
    }
    assert!(read_back > 25, "{read_back}");
}

#[test]
fn a_mass_with_velocities_has_no_lowered_model() {
    let model = read("name = \"v\"\ncoordinates = [\"x\"]\nparameters = { m0 = 1 }\nparticles = { p = { mass = \"m0 + x'^2\", position = [\"x\"] } }\n");
    let system = System::from_model(&model).expect("a system");
    assert_eq!(flat(&model, &system), None);
}
