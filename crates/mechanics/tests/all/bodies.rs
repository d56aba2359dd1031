//! Models of bodies, joints and contacts against their twins by hand, proved to have the same motion.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::excessive_precision,
    reason = "test code fails where it stands; numbers stand as they were computed"
)]

use chetaev_mechanics::claims::formulation::{derive, equivalence};
use chetaev_mechanics::claims::{Context, Prepared, Registry, CLAIMS};
use chetaev_mechanics::{Prover, System};
use chetaev_model::mechanism::Mechanism;
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
        file: "rattleback",
        stated: "map = { x = \"x + celt_center_z celt_X_z\", y = \"y + celt_center_z celt_Y_z\", ga = \"heading\", al = \"lean\", be = \"pitch\" }\n\
                 parameters = { m = \"celt_mass\", a = \"celt_semiaxes_x\", b = \"celt_semiaxes_y\", c = \"celt_semiaxes_z\", h = \"-celt_center_z\", A = \"celt_inertia_xx\", \
                 B = \"celt_inertia_yy\", Cz = \"celt_inertia_zz\", D = \"celt_inertia_xy\" }",
    },
    Twin {
        file: "whipple-bicycle",
        stated: "parameters = { c = \"b - w\", lam = \"delta_tilt_y\", rR = \"rear_radius\", mR = \"rear_mass\", IRxx = \"rear_inertia_across\", IRyy = \"rear_inertia_along\", \
                 xB = \"frame_center_x\", zB = \"frame_center_z\", mB = \"frame_mass\", IBxx = \"frame_inertia_xx\", IByy = \"frame_inertia_yy\", IBzz = \"frame_inertia_zz\", \
                 IBxz = \"frame_inertia_xz\", xH = \"fork_center_x\", zH = \"fork_center_z\", mH = \"fork_mass\", IHxx = \"fork_inertia_xx\", IHyy = \"fork_inertia_yy\", \
                 IHzz = \"fork_inertia_zz\", IHxz = \"fork_inertia_xz\", rF = \"front_radius\", mF = \"front_mass\", IFxx = \"front_inertia_across\", IFyy = \"front_inertia_along\" }",
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
pub(crate) fn same_motion_with(text: &str, files: &dyn Files) -> Verdict {
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

pub(crate) fn stated(file: &str) -> String {
    Gallery
        .read(&format!("bodies/{file}.toml"))
        .expect("the model file is there")
}

#[test]
fn bodies_have_the_motion_of_their_twins_by_hand() {
    let mut wrong = Vec::new();
    for twin in TWINS {
        let hand = format!(
            "[twin.hand]\nmodel = \"../{}/model.toml\"\n{}\n",
            twin.file, twin.stated
        );
        let verdict = same_motion(&format!("{}\n{hand}", stated(twin.file)));
        if !matches!(verdict, Verdict::Proved(_)) {
            wrong.push(format!("{}: {verdict:#?}", twin.file));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_lowered_text_has_the_motion_of_its_bodies() {
    for file in ["sphere-on-turntable", "chain", "double-pendulum"] {
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

// ---- published numbers

/// A state and accelerations there: twelve systems of bodies, each computed twice by others (Newton and Euler in maximal coordinates, and
/// Lagrange with multipliers, both in arithmetic of 120 digits), beside those that the literature prints.
struct Numbers {
    model: &'static str,
    state: &'static [(&'static str, &'static str)],
    /// Expressions of accelerations.
    expected: &'static [(&'static str, f64)],
    /// Forces of joints and multipliers of contacts, as the balances of Newton and Euler give them.
    reactions: &'static [(&'static str, f64)],
}

const NUMBERS: &[Numbers] = &[
    // A thin disc.
    Numbers {
        model: r#"
bodies.disc = { shape = "disc", mass = 1.5, radius = 0.4, inertia = [0.06, 0.12] }
contacts.rim = { type = "rolling", body = "disc", coordinates = ["x", "y", "phi", "theta", "psi"] }
[define]
middle_x = "disc_p_x"
middle_y = "disc_p_y"
"#,
        state: &[
            ("phi", "0.7"),
            ("theta", "0.35"),
            ("psi", "1.1"),
            ("phi'", "0.8"),
            ("theta'", "-0.5"),
            ("psi'", "4"),
            ("x'", "0.4*4*cos(0.7)"),
            ("y'", "0.4*4*sin(0.7)"),
        ],
        expected: &[
            ("phi''", 4.258_160_733_533_980_23),
            ("theta''", 10.540_995_859_525_951_7),
            ("psi''", -0.833_865_504_090_112_287),
            ("middle_x''", 1.610_039_963_301_596_7),
            ("middle_y''", -1.989_275_349_859_689_9),
        ],
        reactions: &[("R_rim_z", 12.4054034718958294)],
    },
    // The same disc held by a finite constraint, its axle along x and the vertical along y.
    Numbers {
        model: r#"
gravity = { up = "y" }
bodies.disc = { mass = 1.5, inertia = [0.12, 0.06, 0.06] }
joints.free = { child = "disc", type = "free", sequence = "yzx", coordinates = ["a", "b", "c", "phi", "theta", "psi"] }
contacts.rim = { type = "rolling", body = "disc", radius = 0.4, axis = "x" }
"#,
        state: &[
            ("phi", "0.7"),
            ("theta", "0.35"),
            ("psi", "1.1"),
            ("b", "0.4*cos(0.35)"),
            ("phi'", "0.8"),
            ("theta'", "-0.5"),
            ("psi'", "4"),
            ("b'", "0.4*0.5*sin(0.35)"),
            ("c'", "1.186639463252405144882955"),
            ("a'", "1.24513094204712058566784"),
        ],
        expected: &[
            ("phi''", 4.258_160_733_533_980_23),
            ("theta''", 10.540_995_859_525_951_7),
            ("psi''", -0.833_865_504_090_112_287),
            ("c''", 1.610_039_963_301_596_7),
            ("b''", -1.539_731_018_736_113_76),
        ],
        reactions: &[("lambda_rim_touch", 12.4054034718958294)],
    },
    // A sleigh.
    Numbers {
        model: r#"
bodies.sleigh = { mass = 2, inertia = 0.3, center = [0.25, 0, 0] }
joints.plane = { type = "planar", child = "sleigh", coordinates = ["x", "y", "theta"] }
contacts.blade = { type = "blade", body = "sleigh" }
"#,
        state: &[
            ("x", "0.1"),
            ("y", "0.2"),
            ("theta", "0.5"),
            ("x'", "1.2"),
            ("y'", "0.6555629878125486159062154"),
            ("theta'", "0.7"),
        ],
        expected: &[
            ("x''", -0.351_390_227_637_213_373),
            ("y''", 0.898_729_628_479_014_868),
            ("theta''", -1.126_088_116_414_848_54),
        ],
        reactions: &[("lambda_blade", 1.35130573969781825)],
    },
    // A snakeboard with motors.
    Numbers {
        model: r#"
[bodies]
board = { mass = 3, inertia = 0.2 }
rotor = { mass = 1.5, inertia = 0.05 }
front = { mass = 0.5, inertia = 0.01 }
back = { mass = 0.5, inertia = 0.01 }
[joints]
plane = { type = "planar", child = "board", coordinates = ["x", "y", "theta"] }
psi = { parent = "board", child = "rotor", torque = 0.4 }
phi_f = { parent = "board", child = "front", at = [0.3, 0, 0], torque = 0.1 }
phi_b = { parent = "board", child = "back", at = [-0.3, 0, 0], torque = -0.2 }
[contacts]
front = { type = "blade" }
back = { type = "blade" }
"#,
        state: &[
            ("x", "0.1"),
            ("y", "0.2"),
            ("theta", "0.5"),
            ("psi", "0.3"),
            ("phi_f", "0.4"),
            ("phi_b", "-0.5"),
            ("x'", "0.5055044860529683622239998"),
            ("y'", "0.236947291710400633351396"),
            ("theta'", "0.9"),
            ("psi'", "2"),
            ("phi_f'", "0.3"),
            ("phi_b'", "-0.6"),
        ],
        expected: &[
            ("x''", -0.303_472_550_963_412_322),
            ("y''", 0.282_005_892_271_191_606),
            ("theta''", 0.790_130_724_798_851_649),
            ("psi''", 7.209_869_275_201_148_35),
            ("phi_f''", 9.209_869_275_201_148_35),
            ("phi_b''", -20.790_130_724_798_851_6),
        ],
        reactions: &[
            ("lambda_front", 2.13078219295762421),
            ("lambda_back", 0.226516956135468219),
            ("R_psi_x", -0.455208826445118484),
            ("R_psi_y", 0.42300883840678741),
        ],
    },
    // A robot on two driven wheels and a caster: one of the lateral constraints of the driven wheels is redundant.
    Numbers {
        model: r#"
[bodies]
chassis = { mass = 10, inertia = 0.4, center = [0.1, 0, 0] }
left = { shape = "disc", mass = 0.8, radius = 0.1, inertia = [0.002, 0.004] }
right = { shape = "disc", mass = 0.8, radius = 0.1, inertia = [0.002, 0.004] }
fork = {}
caster = { shape = "disc", mass = 0.3, radius = 0.04, inertia = [0.0002, 0.0004] }
[joints]
plane = { type = "planar", child = "chassis", coordinates = ["x", "y", "theta"] }
phi_L = { parent = "chassis", child = "left", axis = "y", at = [0, 0.2, "left_radius"], torque = 0.3 }
phi_R = { parent = "chassis", child = "right", axis = "y", at = [0, -0.2, "right_radius"], torque = -0.1 }
delta = { parent = "chassis", child = "fork", at = [0.3, 0, 0] }
phi_c = { parent = "fork", child = "caster", axis = "y", at = [-0.05, 0, "caster_radius"] }
[contacts]
left = { type = "rolling" }
right = { type = "rolling" }
caster = { type = "rolling" }
"#,
        state: &[
            ("theta", "0.4"),
            ("delta", "0.6"),
            ("x'", "0.3684243976011540331194107"),
            ("y'", "0.1557673369234601966665247"),
            ("theta'", "-0.5"),
            ("phi_L'", "5"),
            ("phi_R'", "3"),
            ("delta'", "-6.493146631889317749330421"),
            ("phi_c'", "6.13594687386540038290598"),
        ],
        expected: &[
            ("x''", 0.177_284_368_139_212_014),
            ("y''", -0.142_186_257_039_109_08),
            ("theta''", -1.369_743_117_557_378_97),
            ("phi_L''", 3.818_684_033_357_102_76),
            ("phi_R''", -1.660_288_436_872_413_1),
            ("delta''", 25.241_316_842_200_926_6),
            ("phi_c''", 53.185_545_506_403_415_6),
        ],
        reactions: &[],
    },
    // A unicycle with a rider.
    Numbers {
        model: r#"
[bodies]
rider = { mass = 5, center = [0, 0, 0.8], inertia = [0.4, 0.35, 0.1] }
wheel = { shape = "disc", mass = 1, radius = 0.25, inertia = [0.03, 0.06] }
[joints]
free = { type = "free", child = "rider", coordinates = ["x", "y", "phi", "theta", "beta"] }
rel = { parent = "rider", child = "wheel", axis = "y", torque = 2 }
[contacts]
rim = { type = "rolling", body = "wheel" }
"#,
        state: &[
            ("phi", "0.3"),
            ("theta", "0.2"),
            ("beta", "0.15"),
            ("rel", "-0.15"),
            ("x'", "0.25*3*cos(0.3)"),
            ("y'", "0.25*3*sin(0.3)"),
            ("phi'", "0.5"),
            ("theta'", "0.3"),
            ("beta'", "-0.4"),
            ("rel'", "3.4"),
        ],
        expected: &[
            ("phi''", 0.112_859_440_038_821_267),
            ("theta''", 1.893_463_560_326_338_32),
            ("beta'' + rel''", 5.955_736_885_365_448_81),
            ("beta''", -0.994_235_530_204_478_227),
        ],
        reactions: &[
            ("R_free_z", 56.2605323517656202),
            ("R_rel_x", -7.42365512172888209),
            ("R_rel_y", 7.20821681239998555),
            ("R_rel_z", -46.56662713437077),
        ],
    },
    // A four-bar with a motor.
    Numbers {
        model: r#"
gravity = { up = "y" }
[bodies]
crank = { mass = 1, inertia = 0.02, center = [0.2, 0, 0] }
coupler = { mass = 2, inertia = 0.2, center = [0.5, 0.1, 0] }
rocker = { mass = 1.5, inertia = 0.1, center = [0.4, 0, 0] }
[joints]
a = { child = "crank", torque = 3 }
b = { parent = "crank", child = "coupler", at = [0.4, 0, 0] }
c = { child = "rocker", at = [1, 0, 0] }
close = { parent = "coupler", child = "rocker", at = [1.1, 0, 0], child_at = [0.8, 0, 0] }
"#,
        state: &[
            ("a", "0.8"),
            ("b", "0.4353629284851087285338919-0.8"),
            ("c", "1.218462413852728026788041"),
            ("a'", "3"),
            ("b'", "-0.6283633651329875358702658-3"),
            ("c'", "0.7582295070457841688604471"),
        ],
        expected: &[
            ("a''", -16.457_732_637_018_960_6),
            ("a'' + b''", 7.489_866_805_842_008_94),
            ("c''", 1.991_680_377_971_895_19),
        ],
        reactions: &[
            ("R_a_x", -6.42722992172141619),
            ("R_a_y", 7.87109865882718848),
            ("R_b_x", -7.53436879480880162),
            ("R_b_y", 1.6455821722169149),
            ("R_c_x", 5.88057266940204708),
            ("R_c_y", 24.3614250283750169),
            ("lambda_close_x", -7.12120895511271419),
            ("lambda_close_y", -9.55779753048011258),
        ],
    },
    // A gyroscope in gimbals.
    Numbers {
        model: r#"
[bodies]
outer = { inertia = [0.02, 0.03, 0.025] }
inner = { inertia = [0.01, 0.012, 0.013] }
rotor = { mass = 1.5, center = [0, 0, 0.03], inertia = [0.004, 0.004, 0.007] }
[joints]
alpha = { child = "outer", torque = 0.1 }
beta = { parent = "outer", child = "inner", axis = "x" }
gamma = { parent = "inner", child = "rotor", torque = 0.02 }
"#,
        state: &[
            ("alpha", "0.3"),
            ("beta", "0.7"),
            ("alpha'", "0.5"),
            ("beta'", "-0.4"),
            ("gamma'", "60"),
        ],
        expected: &[
            ("alpha''", -0.586_803_168_228_049_339),
            ("beta''", 9.692_361_790_756_020_65),
            ("gamma''", 3.177_111_138_388_327_81),
        ],
        reactions: &[
            ("R_alpha_x", 0.0656665114634155397),
            ("R_alpha_y", -0.316432094568587821),
            ("R_alpha_z", 14.4285135458995203),
            ("R_gamma_x", 0.0656665114634155397),
            ("R_gamma_z", 14.4285135458995203),
        ],
    },
    // A pendulum on a support that is moved.
    Numbers {
        model: r#"
frames.pivot = { at = ["0.05 sin(8 t)", 0, "0.02 cos(16 t)"] }
bodies.rod = { mass = 1, inertia = 0.02, center = [0, 0, -0.3] }
joints.theta = { parent = "pivot", child = "rod", axis = "-y" }
"#,
        state: &[("t", "0.3"), ("theta", "0.6"), ("theta'", "1.5")],
        expected: &[("theta''", -9.551_556_961_278_925_13)],
        reactions: &[
            ("R_theta_x", -4.90758788869991982),
            ("R_theta_z", 8.30114232063703634),
        ],
    },
    // A ball whose mass centre is not its middle.
    Numbers {
        model: r#"
bodies.top = { shape = "ball", mass = 0.02, radius = 0.015, center = [0, 0, -0.003], inertia = [0.0000018, 0.0000018, 0.000002] }
joints.free = { type = "free", child = "top", sequence = "zxz", coordinates = ["x", "y", "a", "b", "c"] }
contacts.foot = { type = "rolling", body = "top" }
"#,
        state: &[
            ("a", "0.4"),
            ("b", "0.5"),
            ("c", "0.2"),
            ("a'", "20"),
            ("b'", "1"),
            ("c'", "60"),
            ("x'", "-0.3915808716888104359706938"),
            ("y'", "-0.1818433035633558655668585"),
        ],
        expected: &[
            ("x''", -0.897_046_248_613_968_732),
            ("y''", 2.693_105_699_282_913_48),
            ("a''", 119.336_436_992_915_597),
            ("b''", -763.966_704_688_096_965),
            ("c''", -99.053_929_617_101_479_3),
        ],
        reactions: &[
            ("R_free_z", 0.174276746021467283),
            ("lambda_foot_forward", -0.00288573779622591771),
            ("lambda_foot_side", 0.00402953590627895765),
        ],
    },
    // A rattleback with the numbers of Kane and Levinson.
    Numbers {
        model: r#"
bodies.celt = { shape = "ellipsoid", semiaxes = [0.2, 0.03, 0.02], mass = 1, center = [0, 0, -0.01], inertia = { xx = 0.0002, yy = 0.0016, zz = 0.0017, xy = -0.00002 } }
joints.free = { type = "free", child = "celt", child_at = [0, 0, -0.01], coordinates = ["x", "y", "z", "a", "b", "c"] }
contacts.foot = { type = "rolling", body = "celt" }
"#,
        state: &[
            ("a", "0.4"),
            ("b", "0.1"),
            ("c", "0.05"),
            ("z", "0.012488159752717588"),
            ("a'", "5"),
            ("b'", "0.3"),
            ("c'", "-0.2"),
            ("z'", "-0.016720498038407677"),
            ("x'", "0.1575021292217217399258983"),
            ("y'", "-0.4143801304678856628613288"),
        ],
        expected: &[
            ("x''", 0.761_814_458_681_904_294),
            ("y''", 0.609_602_068_440_184_851),
            ("a''", 25.327_428_042_763_361_3),
            ("b''", -24.500_101_044_259_299_4),
            ("c''", -94.170_659_746_193_322_4),
        ],
        reactions: &[
            ("lambda_foot_touch", 1.53913487601089243),
            ("lambda_foot_forward", 0.761814458681904294),
            ("lambda_foot_side", 0.609602068440184851),
        ],
    },
    // The benchmark bicycle off its upright motion.
    Numbers {
        model: "bicycle",
        state: &[
            ("psi", "0.2"),
            ("phi", "0.15"),
            ("theta", "-0.003739682365294951357606204"),
            ("delta", "0.3"),
            ("psi'", "1.026880491855096942144358"),
            ("phi'", "0.2"),
            ("theta'", "0.001790393961558512352662699"),
            ("delta'", "-0.4"),
            ("thR'", "12.001790393961558512352662699"),
            ("thF'", "10.77918295492418770917693"),
            ("x'", "3.6*cos(0.2)"),
            ("y'", "3.6*sin(0.2)"),
        ],
        expected: &[
            ("psi''", -0.876_070_643_806_820_028),
            ("phi''", -1.708_208_904_388_507_52),
            ("theta''", -0.071_399_455_176_454_418_7),
            ("delta''", 8.393_303_538_463_409_17),
            ("theta'' - thR''", -1.295_254_940_707_104_73),
            ("-thF''", -0.159_818_546_049_562_674),
        ],
        reactions: &[
            ("R_free_z", -610.954882222398448),
            ("lambda_front_tyre_touch", 326.065666559081874),
        ],
    },
];

/// The accelerations of a model at a state, as expressions of accelerations ask for them.
pub(crate) fn accelerations(
    text: &str,
    form: &str,
    state: &[(&str, &str)],
    asked: &[&str],
) -> Vec<f64> {
    let loaded = load("bodies/model.toml", text, &Gallery, &[]);
    let (model, _) = loaded
        .into_result()
        .unwrap_or_else(|problems| panic!("{text}{problems}"));
    let system = System::from_model(&model).unwrap();
    let prepared = Prepared::new(&system).unwrap();
    let registry = Registry::new(&[CLAIMS]);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &registry, Prover::default());
    let derived = derive(&cx, form).unwrap();
    let g = &system.graph;
    let own = derived.in_natural_state(&system, &derived.accelerations);
    let places = system.coordinates.iter().map(|own| own.a);
    let moved: Vec<_> = places.zip(own).collect();
    let object = |name: &str| derived.objects.iter().find(|own| own.name == name);
    let asked: Vec<_> = asked
        .iter()
        .map(|text| match object(text) {
            Some(own) => own.value,
            None => model.expression(text).unwrap(),
        })
        .collect();
    let values = g.substitute_all(&asked, &moved);
    let numbers: std::collections::BTreeMap<String, f64> = state
        .iter()
        .map(|(name, text)| {
            (
                (*name).to_owned(),
                model.constant_value("a state", text).unwrap(),
            )
        })
        .collect();
    let parameters: std::collections::BTreeMap<String, f64> = model
        .parameters
        .iter()
        .map(|own| {
            (
                own.name.clone(),
                model.constant_value("a parameter", &own.name).unwrap(),
            )
        })
        .collect();
    let of = |symbol| {
        let name = g.symbol_text(symbol);
        numbers
            .get(&name)
            .or(parameters.get(&name))
            .copied()
            .or(Some(0.0))
    };
    g.evaluate_f64(&values, &of).unwrap()
}

/// Forms that are derived each by its own rule, the last three from the bodies.
pub(crate) const FORMS: &[&str] = &["routh", "newton-euler", "kane", "gibbs-appell"];

#[test]
fn published_accelerations_come_out_of_the_bodies() {
    let mut wrong = Vec::new();
    for case in NUMBERS {
        let text = match case.model {
            "bicycle" => stated("whipple-bicycle"),
            text => text.to_owned(),
        };
        let asked: Vec<&str> = case.expected.iter().map(|(text, _)| *text).collect();
        let largest = case.expected.iter().map(|(_, x)| x.abs());
        let size = largest.fold(0.0, f64::max);
        let of_forms = FORMS
            .iter()
            .map(|form| accelerations(&text, form, case.state, &asked));
        let mut all: Vec<_> = of_forms
            .flat_map(|found| case.expected.iter().zip(found))
            .collect();
        let named: Vec<&str> = case.reactions.iter().map(|(name, _)| *name).collect();
        let reactions = accelerations(&text, "newton-euler", case.state, &named);
        all.extend(case.reactions.iter().zip(reactions));
        for ((asked, expected), found) in all {
            let error = (found - expected).abs();
            // Not a number is wrong too.
            if !matches!(
                error.partial_cmp(&(1e-11 * size)),
                Some(std::cmp::Ordering::Less)
            ) {
                wrong.push(format!("{asked} = {found}, not {expected}, in\n{text}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

// ---- Newton and Euler, Kane, Gibbs and Appell

/// What is known of the forms that are built from bodies.
fn forms_of_bodies(text: &str) -> Vec<(String, Verdict)> {
    let loaded = load("bodies/model.toml", text, &Gallery, &[]);
    let (model, _) = loaded
        .into_result()
        .unwrap_or_else(|problems| panic!("{text}{problems}"));
    let system = System::from_model(&model).unwrap();
    forms_of_system(&system)
}

fn forms_of_system(system: &System) -> Vec<(String, Verdict)> {
    let prepared = Prepared::new(system).unwrap();
    let registry = Registry::new(&[CLAIMS]);
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(system, terms, selection, &registry, Prover::default());
    FORMS[1..]
        .iter()
        .map(|form| format!("formulation.equivalent#{form}"))
        .map(|id| (id.clone(), cx.finding(&id).verdict.clone()))
        .collect()
}

/// Every model of bodies in the gallery that is no family of sizes of its own.
const ALL: &[&str] = &[
    "ball-in-bowl",
    "chain",
    "chaplygin-sleigh",
    "chaplygin-sphere",
    "differential-drive",
    "double-pendulum",
    "double-wishbone",
    "falling-rolling-disc",
    "four-bar",
    "four-bar-hinges",
    "gyroscope",
    "heavy-top",
    "mecanum",
    "rattleback",
    "roller-racer",
    "slider-crank",
    "snakeboard",
    "sphere-on-turntable",
    "spherical-robot",
    "tippe-top",
    "trailer",
    "unicycle",
    "vertical-rolling-disc",
    "wheel-set",
    "whipple-bicycle",
];

#[test]
fn the_forms_of_bodies_are_the_same_equations() {
    let mut wrong = Vec::new();
    for file in ALL {
        for (id, verdict) in forms_of_bodies(&stated(file)) {
            let is_own = match &verdict {
                Verdict::Proved(proof) => !proof.detail.contains("contracted"),
                _ => false,
            };
            if !is_own {
                wrong.push(format!("{file}: {id}: {verdict:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A body that tumbles on a joint, with springs, a motor, a damper and a particle beside it.
const TUMBLING: &str = r#"
[bodies]
plate = { mass = 2, center = [0.1, 0.2, 0.3], inertia = { xx = 3, yy = 4, zz = 5, xy = 0.1, xz = 0.2, yz = 0.3, at = [0, 0, 0.1], turn = { z = 0.3 } } }
rotor = { shape = "disc", mass = 1, radius = 0.5 }
[joints]
plate = { type = "universal", sequence = "xy" }
rotor = { parent = "plate", at = [0.3, 0, 1], tilt = { x = 0.4 }, torque = "2 - 3 sin(rotor)", spring = 3, damper = 0.2 }
"#;

#[test]
fn springs_motors_and_particles_stand_in_the_balances() {
    let text = format!(
        "{}\n[coordinates]\ns = {{}}\n[particles]\nbead = {{ mass = 0.3, position = [\"s\", \"plate_lean\", \"s^2\"], force = [0, 1, \"-s\"] }}\n[lagrangian]\nV = \"s^2 + plate_pitch^3\"\n",
        TUMBLING
    );
    for (id, verdict) in forms_of_bodies(&text) {
        assert!(matches!(verdict, Verdict::Proved(_)), "{id}: {verdict:#?}");
    }
}

/// Forces at points, in turned axes, between two bodies, and friction of a contact and of a joint.
const LOADED: &str = r#"
parameters = { N = 4 }
[bodies]
sled = { mass = 2, inertia = [0.2, 0.3, 0.4], center = [0.1, 0, 0.05] }
arm = { shape = "rod", mass = 1, length = 0.8, center = [0.4, 0, 0] }
[joints]
plane = { type = "planar", child = "sled", coordinates = ["x", "y", "phi"] }
q = { parent = "sled", child = "arm", axis = "y", friction = { coefficient = 0.1, load = 2, speed = 0.1 } }
[contacts]
foot = { type = "sliding", body = "sled", at = [0.3, 0.1, 0], friction = { viscous = 0.4, coefficient = 0.2, load = "N", speed = 0.1 } }
[forces]
push = { body = "arm", at = [0.8, 0, 0], in = "arm", force = [1, 2, "3 q"], torque = [0.5, 0, 1] }
pull = { body = "arm", at = [0.5, 0, 0.1], to = "ground", to_at = [0, 0, 2], spring = { stiffness = 7, rest = 1.5 }, damper = 0.3 }
tie = { body = "sled", at = [0.2, 0.3, 0], to = "arm", to_at = [0.6, 0, 0], spring = 5, force = 0.2 }
"#;

#[test]
fn forces_at_points_stand_in_the_balances() {
    for (id, verdict) in forms_of_bodies(LOADED) {
        assert!(matches!(verdict, Verdict::Proved(_)), "{id}: {verdict:#?}");
    }
}

/// What hangs by a joint pulls at it: the balances of all bodies tell the same as a sensor, which looks at that part alone.
#[test]
fn a_sensor_measures_the_force_of_the_balances() {
    const STATE: &[(&str, &str)] = &[
        ("x", "0.3"),
        ("y", "-0.2"),
        ("phi", "0.4"),
        ("q", "0.7"),
        ("x'", "0.5"),
        ("y'", "0.1"),
        ("phi'", "-0.9"),
        ("q'", "1.3"),
    ];
    let text = format!("{LOADED}\n[sensors]\npin = {{ type = \"reaction\", of = \"q\" }}\n");
    let all = ["x", "y", "z"];
    let named = |start: &str| all.map(|axis| format!("{start}_{axis}"));
    let measured = [named("pin_force"), named("pin_torque")].concat();
    let balanced = [named("R_q"), named("C_q")].concat();
    let of = |names: &[String]| {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        accelerations(&text, "newton-euler", STATE, &names)
    };
    for ((name, found), expected) in measured.iter().zip(of(&measured)).zip(of(&balanced)) {
        assert!(
            (found - expected).abs() < 1e-10 && expected != 0.0,
            "{name}: {found}, not {expected}"
        );
    }
}

#[test]
fn energies_beside_bodies_have_no_force_on_a_body() {
    let text = format!("{}\n[lagrangian]\nL = \"plate_lean'^2\"\n", TUMBLING);
    let found = forms_of_bodies(&text);
    let (_, own) = &found[0];
    let Verdict::NotApplicable { .. } = own else {
        panic!("{own:#?}");
    };
    assert!(format!("{own:?}").contains("beside its bodies"), "{own:?}");
}

/// The bodies of a system, changed: what is derived from them is another motion than that of the Lagrangian, and is refuted.
#[test]
fn wrong_bodies_are_refuted() {
    type Mutant = (&'static str, fn(&System, &mut Mechanism));
    const MUTANTS: &[Mutant] = &[
        (
            "the gyroscopic term of the axes is dropped",
            |system, all| {
                all.bodies[0].turning = [system.graph.zero(); 3];
            },
        ),
        (
            "the inertia is taken in axes turned about x",
            |system, all| {
                let (g, body) = (&system.graph, &mut all.bodies[0]);
                let turned =
                    |i: usize, j: usize, e| if (i == 0) != (j == 0) { g.neg(e) } else { e };
                let own = body.inertia;
                body.inertia =
                    std::array::from_fn(|i| std::array::from_fn(|j| turned(i, j, own[i][j])));
            },
        ),
        ("Steiner's term has the wrong sign", |system, all| {
            let (g, body) = (&system.graph, &mut all.bodies[0]);
            let moved = g.mul(&[
                body.mass,
                g.number(chetaev_symbolic::Rational::from(1) / chetaev_symbolic::Rational::from(5)),
            ]);
            body.inertia[0][0] = g.add(&[body.inertia[0][0], moved]);
        }),
        ("the weight acts upwards", |system, all| {
            let (g, body) = (&system.graph, &mut all.bodies[1]);
            body.weight = body.weight.map(|e| g.neg(e));
        }),
    ];
    let (model, _) = load("bodies/model.toml", TUMBLING, &Gallery, &[])
        .into_result()
        .unwrap();
    for (name, change) in MUTANTS {
        let mut system = System::from_model(&model).unwrap();
        let mut mechanism = system.mechanism.take().unwrap();
        change(&system, &mut mechanism);
        system.mechanism = Some(mechanism);
        let system = system.for_parameter_values().unwrap();
        let prepared = Prepared::new(&system).unwrap();
        let registry = Registry::new(&[CLAIMS]);
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(&system, terms, selection, &registry, Prover::default());
        let reference = derive(&cx, "routh").unwrap();
        let own = derive(&cx, "newton-euler").unwrap();
        let verdict = equivalence(&cx, &reference, &own);
        assert!(
            matches!(verdict, Verdict::Refuted(_)),
            "{name}: {verdict:#?}"
        );
    }
}
