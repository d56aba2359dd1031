//! Models of bodies, joints and contacts against their twins by hand, proved to have the same motion.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use chetaev_mechanics::claims::{Context, Prepared, Registry, CLAIMS};
use chetaev_mechanics::{Prover, System};
use chetaev_model::{load, lowered, Files};
use chetaev_symbolic::Verdict;
use std::path::Path;

/// Model files of the gallery.
struct Gallery;

impl Files for Gallery {
    fn read(&self, path: &str) -> Result<String, String> {
        let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery");
        std::fs::read_to_string(gallery.join(path)).map_err(|problem| problem.to_string())
    }
}

/// A model of `gallery/bodies`, and what its twin by hand is called there.
struct Twin {
    file: &'static str,
    /// `model`, `map` and `parameters` of the twin.
    stated: &'static str,
}

const TWINS: &[Twin] = &[
    Twin {
        file: "falling-rolling-disc",
        stated: "parameters = { m = \"disc_mass\", r = \"disc_radius\" }",
    },
    Twin {
        file: "chaplygin-sleigh",
        stated: "parameters = { m = \"sleigh_mass\", J = \"sleigh_inertia\", a = \"sleigh_center_x\" }",
    },
    Twin {
        file: "snakeboard",
        stated: "parameters = { m = \"board_mass\" }",
    },
    Twin {
        file: "roller-racer",
        stated: "parameters = { m = \"rear_mass\", J1 = \"rear_inertia\", J2 = \"front_inertia\" }",
    },
    Twin {
        file: "trailer",
        stated: "map = { theta_0 = \"theta\", theta_1 = \"theta + hitch_1\", theta_2 = \"theta + hitch_1 + hitch_2\", theta_3 = \"theta + hitch_1 + hitch_2 + hitch_3\" }\n\
                 parameters = { m = \"car_mass\", J = \"car_inertia\", M_1 = \"trailer_1_mass\", M_2 = \"trailer_2_mass\", M_3 = \"trailer_3_mass\", J_1 = \"trailer_1_inertia\", \
                 J_2 = \"trailer_2_inertia\", J_3 = \"trailer_3_inertia\", d_1 = \"hitch_1_child_at_x\", d_2 = \"hitch_2_child_at_x\", d_3 = \"hitch_3_child_at_x\" }",
    },
    Twin {
        file: "chaplygin-sphere",
        stated: "parameters = { m = \"ball_mass\", r = \"ball_radius\", I1 = \"ball_inertia_xx\", I2 = \"ball_inertia_yy\", I3 = \"ball_inertia_zz\" }",
    },
    Twin {
        file: "heavy-top",
        stated: "parameters = { mgl = \"top_mass g top_center_z\" }",
    },
    Twin {
        file: "vertical-rolling-disc",
        stated: "parameters = { m = \"disc_mass\", R = \"disc_radius\", I = \"disc_inertia_along\", J = \"disc_inertia_across\" }",
    },
];

/// One model file.
struct Plain(String);

impl Files for Plain {
    fn read(&self, _: &str) -> Result<String, String> {
        Ok(self.0.clone())
    }
}

fn same_motion(text: &str) -> Verdict {
    same_motion_with(text, &Gallery)
}

/// What is known of the twin `hand` of a model.
fn same_motion_with(text: &str, files: &dyn Files) -> Verdict {
    let loaded = load("bodies/model.toml", text, files, &[]);
    let (model, _) = loaded
        .into_result()
        .unwrap_or_else(|problems| panic!("{text}{problems}"));
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    let registry = Registry::new(&[CLAIMS]);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &registry, Prover::default());
    cx.finding("model.same-motion#hand").verdict.clone()
}

fn stated(file: &str) -> String {
    Gallery
        .read(&format!("bodies/{file}.toml"))
        .expect("the model file is there")
}

#[test]
fn bodies_have_the_motion_of_their_twins_by_hand() {
    for twin in TWINS {
        let hand = format!(
            "[twin.hand]\nmodel = \"../{}/model.toml\"\n{}\n",
            twin.file, twin.stated
        );
        let verdict = same_motion(&format!("{}\n{hand}", stated(twin.file)));
        assert!(
            matches!(verdict, Verdict::Proved(_)),
            "{}: {verdict:#?}",
            twin.file
        );
    }
}

#[test]
fn a_lowered_text_has_the_motion_of_its_bodies() {
    for file in [
        "four-bar",
        "sphere-on-turntable",
        "chain",
        "double-pendulum",
    ] {
        let text = stated(file);
        let plain = lowered("bodies/plain.toml", &text, &Gallery, &[]).unwrap();
        let gallery = Plain(plain);
        let beside = format!("{text}\n[twin.hand]\nmodel = \"plain.toml\"\n");
        let verdict = same_motion_with(&beside, &gallery);
        assert!(
            matches!(verdict, Verdict::Proved(_)),
            "{file}: {verdict:#?}"
        );
    }
}

#[test]
fn another_inertia_is_another_motion() {
    let hand = "[twin.hand]\nmodel = \"../falling-rolling-disc/model.toml\"\nparameters = { m = \"disc_mass\", r = \"disc_radius\" }\n";
    let ring = stated("falling-rolling-disc").replace("\"disc\", mass", "\"ring\", mass");
    let verdict = same_motion(&format!("{ring}\n{hand}"));
    assert!(matches!(verdict, Verdict::Refuted(_)), "{verdict:#?}");
}
