//! Models to begin with: templates, models made of robot descriptions, copies of the gallery.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{gallery, scratch};
use chetaev_tests::program::{ok, run, run_in, text};

#[test]
fn a_robot_description_becomes_a_model() {
    let folder = scratch("import");
    let urdf = "<robot name=\"arm\">\n<link name=\"world\"/>\n<link name=\"arm\"><visual/><inertial><origin xyz=\"0 0 -0.5\"/><mass value=\"2\"/>\
                <inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n\
                <joint name=\"q\" type=\"continuous\"><parent link=\"world\"/><child link=\"arm\"/><axis xyz=\"0 1 0\"/></joint>\n</robot>\n";
    std::fs::write(folder.join("arm.urdf"), urdf).expect("a scratch file");
    let finished = run_in(&folder, &["import", "arm.urdf", "--out", "arm/model.toml"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    assert!(
        finished.err.contains("arm.urdf:3: <visual>"),
        "{}",
        finished.err
    );
    let checked = run_in(&folder, &["check", "arm/model.toml"]);
    assert_eq!(
        (checked.status, checked.err.as_str()),
        (Some(0), ""),
        "{}",
        checked.both()
    );
    let again = run_in(&folder, &["import", "arm.urdf", "--out", "arm/model.toml"]);
    assert_eq!(
        again.status,
        Some(2),
        "an existing model is not overwritten"
    );
    std::fs::write(folder.join("page.xml"), "<html/>").expect("a scratch file");
    for path in ["page.xml", "missing.urdf", "."] {
        let refused = run_in(&folder, &["import", path]);
        assert_eq!(refused.status, Some(2), "{}", refused.both());
        assert!(
            !refused.panicked() && refused.err.starts_with("error: "),
            "{}",
            refused.both()
        );
    }
}

#[test]
fn a_new_model_studies_at_once() {
    let folder = scratch("new");
    let finished = run_in(&folder, &["new", "my-robot"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let template = std::fs::read_to_string(folder.join("my-robot/model.toml")).expect("a model");
    assert!(
        template.contains("name = \"my-robot\"")
            && template.lines().filter(|l| l.starts_with('#')).count() > 5
    );
    let finished = run_in(&folder, &["check", "my-robot/model.toml"]);
    assert_eq!(
        (finished.status, finished.err.as_str()),
        (Some(0), ""),
        "{}",
        finished.both()
    );
    let finished = run_in(&folder, &["study", "my-robot/model.toml"]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    assert!(folder.join("out/my-robot/report.html").is_file());
    let again = run_in(&folder, &["new", "my-robot"]);
    assert_eq!(
        again.status,
        Some(2),
        "an existing model is not overwritten"
    );
    assert_eq!(
        std::fs::read_to_string(folder.join("my-robot/model.toml")).expect("the model"),
        template
    );
}

#[test]
fn new_models_of_bodies_and_of_functionals_study_at_once() {
    let folder = scratch("new-kinds");
    for kind in ["bodies", "functional"] {
        let made = run_in(&folder, &["new", kind, "--from", kind]);
        assert_eq!(made.status, Some(0), "{}", made.both());
        let model = format!("{kind}/model.toml");
        let command = if kind == "functional" {
            "study"
        } else {
            "check"
        };
        let finished = run_in(&folder, &[command, &model]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        assert!(finished.err.is_empty(), "{}", finished.both());
    }
}

#[test]
fn names_with_special_letters_make_a_right_template() {
    let folder = scratch("new-names");
    for name in ["Röllchen 2", "a\"b", "back\\slash"] {
        let finished = run_in(&folder, &["new", name]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        let path = folder.join(name).join("model.toml");
        let finished = run_in(&folder, &["check", text(&path)]);
        assert_eq!(finished.status, Some(0), "{name}: {}", finished.both());
    }
}

#[test]
fn the_gallery_is_in_the_program() {
    let listed = ok(&["gallery", "list"]).out;
    assert_eq!(ok(&["gallery"]).out, listed);
    let folder = scratch("gallery-copy");
    for path in gallery() {
        let source = path.parent().expect("a folder");
        let name = source.file_name().and_then(|n| n.to_str()).expect("a name");
        assert!(
            listed
                .lines()
                .any(|l| l.split_whitespace().next() == Some(name)),
            "{name} is not listed"
        );
        let described = ok(&["gallery", "describe", name]).out;
        assert_eq!(
            described.trim(),
            std::fs::read_to_string(source.join("README.md"))
                .expect("a README")
                .trim()
        );
        assert_eq!(run_in(&folder, &["gallery", "copy", name]).status, Some(0));
        for entry in std::fs::read_dir(source).expect("the folder") {
            let original = entry.expect("an entry").path();
            let copy = folder
                .join(name)
                .join(original.file_name().expect("a name"));
            assert_eq!(
                std::fs::read(&copy).ok(),
                std::fs::read(&original).ok(),
                "{}",
                copy.display()
            );
        }
    }
    // What a functional of a group names is copied with it; a model of bodies stands alone.
    for (name, model) in [
        ("elasticity/p3p1", "p3p1/p3p1/model.toml"),
        ("fields/plate", "plate/model.toml"),
        ("bodies/four-bar", "four-bar/model.toml"),
    ] {
        let copied = run_in(&folder, &["gallery", "copy", name]);
        assert!(copied.out.contains(model), "{}", copied.both());
        let checked = run_in(&folder, &["check", model]);
        assert_eq!(checked.status, Some(0), "{name}: {}", checked.both());
    }
    let copied = run_in(
        &folder,
        &[
            "study",
            "trailer/model-8.toml",
            "--t-end",
            "1",
            "--claims",
            "motion.constraint-drift",
        ],
    );
    assert_eq!(copied.status, Some(0), "{}", copied.both());
    assert_eq!(
        run_in(&folder, &["gallery", "copy", "trailer"]).status,
        Some(2),
        "nothing is overwritten"
    );
    let unknown = run(&["gallery", "describe", "perpetuum-mobile"]);
    assert_eq!(unknown.status, Some(2));
    assert!(unknown.err.contains("chaplygin-sleigh"), "{}", unknown.err);
}

/// A copy of a gallery model links to nothing that was not copied.
#[test]
fn descriptions_of_the_gallery_have_no_dead_links() {
    for path in gallery() {
        let folder = path.parent().expect("a folder");
        let readme = std::fs::read_to_string(folder.join("README.md")).expect("a README");
        for target in readme
            .split("](")
            .skip(1)
            .filter_map(|r| r.split(')').next())
        {
            let is_beside = !target.contains("..") && folder.join(target).is_file();
            assert!(
                target.starts_with("https://") || is_beside,
                "{}: {target}",
                folder.display()
            );
        }
        assert!(!readme.contains("references.bib"), "{}", folder.display());
    }
}
