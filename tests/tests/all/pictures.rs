//! `chetaev plot` and `chetaev film`: files of the motion, and one description of the picture for all of them.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{ok, run, text};
use serde_json::Value;

const SLEIGH: &str = "gallery/chaplygin-sleigh/model.toml";

/// The picture of a model and that of its `scene.json` are one; its fields are those of the documentation.
#[test]
fn a_scene_is_drawn_as_its_model_is() {
    let folder = scratch("pictures");
    let at = |name: &str| folder.join(name);
    let (scene, first, second) = (at("scene.json"), at("a.svg"), at("b.svg"));
    ok(&["plot", SLEIGH, "--out", text(&scene)]);
    ok(&["plot", SLEIGH, "--ghosts", "3", "--out", text(&first)]);
    ok(&[
        "plot",
        text(&scene),
        "--ghosts",
        "3",
        "--out",
        text(&second),
    ]);
    let read = |path| std::fs::read_to_string(path).expect("a picture");
    let drawn = read(&first);
    assert!(drawn.starts_with("<svg ") && !drawn.contains("NaN"));
    assert!(drawn == read(&second), "the same picture");
    let record: Value = serde_json::from_str(&read(&scene)).expect("JSON");
    let page = std::fs::read_to_string(root().join("docs/scene-json.md")).expect("the page");
    for field in record.as_object().expect("fields").keys() {
        assert!(page.contains(&format!("| `{field}` |")), "{field}");
    }
    ok(&["plot", text(&scene), "--out", text(&at("a.png"))]);
    let png = std::fs::read(at("a.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG"));
    let film = at("a.gif");
    ok(&[
        "film",
        text(&scene),
        "--seconds",
        "1",
        "--width",
        "120",
        "--out",
        text(&film),
    ]);
    assert!(std::fs::read(film).expect("a film").starts_with(b"GIF89a"));
}

/// A model without `[drawing]` has a picture all the same: of its points, else of its phase portrait.
#[test]
fn models_without_a_drawing_have_one() {
    let folder = scratch("pictures-by-themselves");
    let (model, scene) = (folder.join("model.toml"), folder.join("scene.json"));
    let of = |coordinates: &str, rest: &str| -> Value {
        let written = format!("coordinates = [{coordinates}]\n{rest}[simulation]\nt_end = 1\n");
        std::fs::write(&model, written).expect("a scratch file");
        ok(&["plot", text(&model), "--out", text(&scene)]);
        let read = std::fs::read_to_string(&scene).expect("a scene");
        serde_json::from_str(&read).expect("JSON")
    };
    let plane = of(
        "\"x_1\", \"y_1\"",
        "lagrangian = \"(x_1'^2 + y_1'^2)/2\"\n[initial]\n\"x_1'\" = 2\n",
    );
    let point = &plane["elements"][1];
    assert_eq!(point["name"], "1");
    let values = point["values"].as_array().expect("numbers");
    // x = 2 t, y = 0 at the end t = 1.
    let end: Vec<f64> = values[values.len() - 2..]
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    assert!(
        (end[0] - 2.0).abs() < 1e-9 && end[1].abs() < 1e-12,
        "{end:?}"
    );
    let space = of(
        "\"x\", \"y\", \"z\"",
        "lagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[initial]\n\"z'\" = 1\n",
    );
    assert_eq!(space["spatial"], true);
    let angle = of(
        "\"theta\"",
        "lagrangian = \"theta'^2/2 + cos(theta)\"\n[initial]\ntheta = 1\n",
    );
    let portrait = angle["description"].as_str().expect("words");
    assert!(portrait.contains("phase portrait"), "{portrait}");
}

#[test]
fn what_is_no_picture_is_refused() {
    let folder = scratch("pictures-refused");
    let scene = folder.join("scene.json");
    std::fs::write(&scene, "{\"schema\": \"chetaev-scene-9\"}").expect("a scratch file");
    let cases: [(&[&str], &str); 4] = [
        (&["plot", SLEIGH, "--out", "a.jpg"], ".svg or .png"),
        (&["film", SLEIGH, "--out", "a.mp4"], "as .gif"),
        (&["plot", text(&scene)], "chetaev-scene-9"),
        (
            &["plot", SLEIGH, "--width", "0", "--out", "a.svg"],
            "from 1 to",
        ),
    ];
    for (arguments, words) in cases {
        let finished = run(arguments);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(finished.both().contains(words), "{}", finished.both());
    }
}
