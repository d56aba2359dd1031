//! Models of bodies against twins that were written by hand: energies in coordinates of another choice where there is one, constraints from the geometry, as
//! textbooks do it. Each is proved to have the same motion, and another twin with one slip is refuted.

use chetaev_model::Files;
use chetaev_symbolic::Verdict;

use super::bodies::{same_motion_with, stated};

/// A model of `gallery/bodies`, its twin by hand, what joins both, and a slip in the twin: what is written, and what instead.
struct Twin {
    file: &'static str,
    hand: &'static str,
    joined: &'static str,
    slip: [&'static str; 2],
}

struct Hand(String);

impl Files for Hand {
    fn read(&self, _: &str) -> Result<String, String> {
        Ok(self.0.clone())
    }
}

/// A crank A, a rod B and a slider or rocker, with the angles of all against the ground.
const FOUR_BAR: &str = r#"
coordinates = ["A", "B", "C"]
parameters = ["m1", "m2", "m3", "J1", "J2", "J3", "c1", "c2", "c3", "l1", "l2", "l3", "e", "g"]
[lagrangian]
T = "1/2 (J1 + m1 c1^2) A'^2 + 1/2 J2 B'^2 + 1/2 m2 (l1^2 A'^2 + c2^2 B'^2 + 2 l1 c2 cos(A - B) A' B') + 1/2 (J3 + m3 c3^2) C'^2"
V = "g (m1 c1 sin(A) + m2 (l1 sin(A) + c2 sin(B)) + m3 c3 sin(C))"
[constraints]
across = "l1 cos(A) + l2 cos(B) = e + l3 cos(C)"
upwards = "l1 sin(A) + l2 sin(B) = l3 sin(C)"
"#;

const TWINS: &[Twin] = &[
    Twin {
        file: "four-bar",
        hand: FOUR_BAR,
        joined: r#"
map = { A = "a", B = "a + b", C = "d" }
parameters = { m1 = "crank_mass", m2 = "rod_mass", m3 = "rocker_mass", J1 = "crank_mass crank_length^2/12", J2 = "rod_mass rod_length^2/12", J3 = "rocker_mass rocker_length^2/12", c1 = "crank_length/2", c2 = "rod_length/2", c3 = "rocker_length/2", l1 = "crank_length", l2 = "rod_length", l3 = "rocker_length", e = "d_at_x" }
"#,
        slip: ["+ 2 l1 c2 cos(A - B) A' B'", "- 2 l1 c2 cos(A - B) A' B'"],
    },
    Twin {
        file: "four-bar-hinges",
        hand: FOUR_BAR,
        joined: r#"
map = { A = "a", B = "a + b", C = "d" }
parameters = { m1 = "crank_mass", m2 = "rod_mass", m3 = "rocker_mass", J1 = "crank_inertia", J2 = "rod_inertia", J3 = "rocker_inertia", c1 = "crank_center_x", c2 = "rod_center_x", c3 = "rocker_center_x", l1 = "b_at_x", l2 = "loop_at_x", l3 = "loop_child_at_x", e = "d_at_x" }
"#,
        slip: ["+ m1 c1^2", "- m1 c1^2"],
    },
    Twin {
        file: "slider-crank",
        hand: r#"
coordinates = ["A", "B", "S"]
parameters = ["m1", "m2", "m3", "l1", "l2", "g"]
[lagrangian]
T = "1/6 m1 l1^2 A'^2 + 1/24 m2 l2^2 B'^2 + 1/2 m2 (l1^2 A'^2 + l2^2 B'^2/4 + l1 l2 cos(A - B) A' B') + 1/2 m3 S'^2"
V = "g (m1 l1 sin(A)/2 + m2 (l1 sin(A) + l2 sin(B)/2))"
[constraints]
across = "l1 cos(A) + l2 cos(B) = S"
upwards = "l1 sin(A) + l2 sin(B) = 0"
"#,
        joined: r#"
map = { A = "a", B = "a + b", S = "s" }
parameters = { m1 = "crank_mass", m2 = "rod_mass", m3 = "slider_mass", l1 = "crank_length", l2 = "rod_length" }
"#,
        slip: ["1/24 m2", "1/12 m2"],
    },
    // K. Magnus, Kreisel, 1971, § 9.
    Twin {
        file: "gyroscope",
        hand: r#"
coordinates = ["alpha", "beta", "gamma"]
parameters = ["J", "A", "B", "C", "m", "r", "h", "g"]
[lagrangian]
T = "1/2 J alpha'^2 + 1/2 (A beta'^2 + B alpha'^2 sin(beta)^2 + C alpha'^2 cos(beta)^2) + 1/2 (m r^2/4 + m h^2) (beta'^2 + alpha'^2 sin(beta)^2) + 1/4 m r^2 (gamma' + alpha' cos(beta))^2"
V = "m g h cos(beta)"
"#,
        joined: r#"parameters = { J = "outer_inertia_zz", A = "inner_inertia_xx", B = "inner_inertia_yy", C = "inner_inertia_zz", m = "rotor_mass", r = "rotor_radius", h = "rotor_center_z" }"#,
        slip: ["+ m h^2", "- m h^2"],
    },
    // The angles of all rods against the vertical plane.
    Twin {
        file: "chain",
        hand: r#"
coordinates = ["theta_{i}"]
sizes = { n = 5 }
indices = { i = "1..n" }
[parameters]
"m_{i}" = 1
"l_{i}" = 1
g = 9.81
[lagrangian]
T = "sum(i = 1..n, m_{i} l_{i}^2 theta_{i}'^2/24 + 1/2 m_{i} ((sum(j = 1..i-1, l_{j} theta_{j}' cos(theta_{j})) + 1/2 l_{i} theta_{i}' cos(theta_{i}))^2 + (sum(j = 1..i-1, l_{j} theta_{j}' sin(theta_{j})) + 1/2 l_{i} theta_{i}' sin(theta_{i}))^2))"
V = "-g sum(i = 1..n, m_{i} (sum(j = 1..i-1, l_{j} sin(theta_{j})) + 1/2 l_{i} sin(theta_{i})))"
"#,
        joined: r#"
map = { theta_1 = "hinge_1", theta_2 = "hinge_1 + hinge_2", theta_3 = "hinge_1 + hinge_2 + hinge_3", theta_4 = "hinge_1 + hinge_2 + hinge_3 + hinge_4", theta_5 = "hinge_1 + hinge_2 + hinge_3 + hinge_4 + hinge_5" }
parameters = { m_1 = "rod_1_mass", m_2 = "rod_2_mass", m_3 = "rod_3_mass", m_4 = "rod_4_mass", m_5 = "rod_5_mass", l_1 = "rod_1_length", l_2 = "rod_2_length", l_3 = "rod_3_length", l_4 = "rod_4_length", l_5 = "rod_5_length" }
"#,
        slip: ["^2/24", "^2/12"],
    },
    // P. F. Muir and C. P. Neuman, Kinematic modeling of wheeled mobile robots, 1987: the slip along the axis of each roller vanishes.
    Twin {
        file: "mecanum",
        hand: r#"
coordinates = ["x", "y", "theta", "q_1", "q_2", "q_3", "q_4"]
parameters = ["M", "J", "m_1", "m_2", "m_3", "m_4", "a", "b", "r", "g_1", "g_2", "g_3", "g_4"]
[define]
u = "x' cos(theta) + y' sin(theta)"
v = "y' cos(theta) - x' sin(theta)"
wheel_1 = "m_1 ((u - b theta')^2 + (v + a theta')^2) + m_1 r^2 (theta'^2/4 + q_1'^2/2)"
wheel_2 = "m_2 ((u + b theta')^2 + (v + a theta')^2) + m_2 r^2 (theta'^2/4 + q_2'^2/2)"
wheel_3 = "m_3 ((u - b theta')^2 + (v - a theta')^2) + m_3 r^2 (theta'^2/4 + q_3'^2/2)"
wheel_4 = "m_4 ((u + b theta')^2 + (v - a theta')^2) + m_4 r^2 (theta'^2/4 + q_4'^2/2)"
[lagrangian]
T = "1/2 M (x'^2 + y'^2) + 1/2 J theta'^2 + 1/2 (wheel_1 + wheel_2 + wheel_3 + wheel_4)"
[constraints]
first = "sin(g_1) (u - b theta' - r q_1') + cos(g_1) (v + a theta') = 0"
second = "sin(g_2) (u + b theta' - r q_2') + cos(g_2) (v + a theta') = 0"
third = "sin(g_3) (u - b theta' - r q_3') + cos(g_3) (v - a theta') = 0"
fourth = "sin(g_4) (u + b theta' - r q_4') + cos(g_4) (v - a theta') = 0"
"#,
        joined: r#"parameters = { M = "chassis_mass", J = "chassis_inertia", m_1 = "wheel_1_mass", m_2 = "wheel_2_mass", m_3 = "wheel_3_mass", m_4 = "wheel_4_mass", g_1 = "wheel_1_angle", g_2 = "wheel_2_angle", g_3 = "wheel_3_angle", g_4 = "wheel_4_angle" }"#,
        slip: ["theta'^2/4 + q_1'^2/2", "theta'^2/4 + q_1'^2"],
    },
    // A disc that rolls with heading, lean and pitch (E. J. Routh, 1905), and a rider on its axle.
    Twin {
        file: "unicycle",
        hand: r#"
coordinates = ["x", "y", "phi", "theta", "beta", "pedal"]
parameters = ["M", "m", "r", "h", "I1", "I2", "I3", "g"]
[define]
X = "x + r sin(theta) sin(phi)"
Y = "y - r sin(theta) cos(phi)"
Z = "r cos(theta)"
U = "X + h (sin(beta) cos(phi) + sin(theta) cos(beta) sin(phi))"
W = "Y + h (sin(beta) sin(phi) - sin(theta) cos(beta) cos(phi))"
Q = "Z + h cos(theta) cos(beta)"
wheel = "1/2 m (X'^2 + Y'^2 + Z'^2) + 1/8 m r^2 (theta'^2 + phi'^2 cos(theta)^2) + 1/4 m r^2 (phi' sin(theta) + beta' + pedal')^2"
turning = "I1 (theta' cos(beta) - phi' cos(theta) sin(beta))^2 + I2 (phi' sin(theta) + beta')^2 + I3 (theta' sin(beta) + phi' cos(theta) cos(beta))^2"
[lagrangian]
T = "wheel + 1/2 M (U'^2 + W'^2 + Q'^2) + 1/2 turning"
V = "m g Z + M g Q"
[forces]
pedal = "-20 beta - 5 beta'"
[constraints]
along = "x' cos(phi) + y' sin(phi) = r (beta' + pedal')"
across = "y' cos(phi) = x' sin(phi)"
"#,
        joined: r#"parameters = { M = "rider_mass", m = "wheel_mass", r = "wheel_radius", h = "rider_center_z", I1 = "rider_inertia_xx", I2 = "rider_inertia_yy", I3 = "rider_inertia_zz" }"#,
        slip: ["1/8 m r^2", "1/4 m r^2"],
    },
    // E. J. Routh, Dynamics of a System of Rigid Bodies, Advanced Part, 1905, § 243: a sphere with its mass centre on an axis of symmetry.
    Twin {
        file: "tippe-top",
        hand: r#"
coordinates = ["x", "y", "a", "b", "c"]
parameters = ["m", "R", "h", "P", "S", "g"]
[define]
X = "x + h sin(a) sin(b)"
Y = "y - h cos(a) sin(b)"
Z = "R + h cos(b)"
[lagrangian]
T = "1/2 m (X'^2 + Y'^2 + Z'^2) + 1/2 P (b'^2 + a'^2 sin(b)^2) + 1/2 S (c' + a' cos(b))^2"
V = "m g Z"
[constraints]
first = "x' = R (b' sin(a) - c' cos(a) sin(b))"
second = "y' = -R (b' cos(a) + c' sin(a) sin(b))"
"#,
        joined: r#"parameters = { m = "top_mass", R = "top_radius", h = "top_center_z", P = "A", S = "C" }"#,
        slip: ["1/2 S (c' + a' cos(b))^2", "1/2 S (c' - a' cos(b))^2"],
    },
    // Heading, lean and pitch of the shell, a fork on its axle, and a bob that swings across.
    Twin {
        file: "spherical-robot",
        hand: r#"
coordinates = ["x", "y", "phi", "theta", "psi", "drive", "swing"]
parameters = ["ms", "r", "mf", "F1", "F2", "F3", "mb", "h", "B1", "B2", "B3", "k", "d", "g"]
[define]
P = "psi + drive"
f1 = "theta' cos(P) - phi' cos(theta) sin(P)"
f2 = "phi' sin(theta) + psi' + drive'"
f3 = "theta' sin(P) + phi' cos(theta) cos(P)"
b1 = "f1 + swing'"
b2 = "f2 cos(swing) + f3 sin(swing)"
b3 = "f3 cos(swing) - f2 sin(swing)"
p = "h sin(P) cos(swing)"
q = "-h (cos(theta) sin(swing) + sin(theta) cos(P) cos(swing))"
X = "x + p cos(phi) - q sin(phi)"
Y = "y + p sin(phi) + q cos(phi)"
Z = "h (cos(theta) cos(P) cos(swing) - sin(theta) sin(swing))"
[lagrangian]
T = "1/2 (ms + mf) (x'^2 + y'^2) + 1/3 ms r^2 (phi'^2 + theta'^2 + psi'^2 + 2 phi' psi' sin(theta)) + 1/2 (F1 f1^2 + F2 f2^2 + F3 f3^2) + 1/2 mb (X'^2 + Y'^2 + Z'^2) + 1/2 (B1 b1^2 + B2 b2^2 + B3 b3^2)"
V = "mb g Z + 1/2 k swing^2"
[forces]
drive = "0.5 sin(t)"
swing = "-d swing'"
[constraints]
first = "x' = r (theta' sin(phi) + psi' cos(phi) cos(theta))"
second = "y' = r (psi' sin(phi) cos(theta) - theta' cos(phi))"
"#,
        joined: r#"parameters = { ms = "shell_mass", r = "shell_radius", mf = "fork_mass", F1 = "fork_inertia_xx", F2 = "fork_inertia_yy", F3 = "fork_inertia_zz", mb = "bob_mass", h = "bob_center_z", B1 = "bob_inertia_xx", B2 = "bob_inertia_yy", B3 = "bob_inertia_zz", k = "swing_spring", d = "swing_damper" }"#,
        slip: ["+ 2 phi' psi' sin(theta)", "- 2 phi' psi' sin(theta)"],
    },
    // J. I. Neimark and N. A. Fufaev, Dynamics of Nonholonomic Systems, 1972, ch. II: in axes at rest.
    Twin {
        file: "sphere-on-turntable",
        hand: r#"
coordinates = ["X", "Y", "A", "B", "C"]
parameters = ["m", "r", "Om"]
[define]
w1 = "B' cos(A) - C' sin(A) cos(B)"
w2 = "B' sin(A) + C' cos(A) cos(B)"
w3 = "A' + C' sin(B)"
[lagrangian]
T = "1/2 m (X'^2 + Y'^2) + 1/5 m r^2 (w1^2 + w2^2 + w3^2)"
[constraints]
first = "X' - r w2 = -Om Y"
second = "Y' + r w1 = Om X"
"#,
        joined: r#"
map = { X = "ball_x cos(Om t) - ball_y sin(Om t)", Y = "ball_x sin(Om t) + ball_y cos(Om t)", A = "ball_yaw + Om t", B = "ball_lean", C = "ball_pitch" }
parameters = { m = "ball_mass", r = "ball_radius" }
"#,
        slip: ["1/5 m", "1/3 m"],
    },
    // J. Reimpell, H. Stoll and J. W. Betzler, The Automotive Chassis, 2001: two wishbones, a tie rod, and the strut on the lower one.
    Twin {
        file: "double-wishbone",
        hand: r#"
coordinates = ["heave", "L", "U", "a", "b", "c", "p", "q"]
parameters = ["car_mass", "lower_mass", "lower_inertia", "lower_center_y", "upper_mass", "upper_inertia", "upper_center_y", "hub_mass", "hub_inertia", "hub_center_y", "hub_center_z", "rack_mass", "rod_mass", "rod_inertia", "rod_center_y", "lower_at_y", "lower_at_z", "upper_at_y", "upper_at_z", "ball_at_y", "rack_at_x", "rack_at_y", "top_at_y", "top_child_at_y", "top_child_at_z", "end_at_y", "end_child_at_x", "end_child_at_y", "end_child_at_z", "strut_at_y", "strut_to_at_y", "strut_to_at_z", "k", "strut_rest", "strut_damper", "g"]
[define]
By = "lower_at_y + ball_at_y cos(L)"
Bz = "lower_at_z + ball_at_y sin(L)"
H1 = "hub_center_z sin(c)"
H2 = "hub_center_y cos(b) - (hub_center_z cos(c)) sin(b)"
H3 = "hub_center_y sin(b) + (hub_center_z cos(c)) cos(b)"
H4 = "H1 sin(a) + H2 cos(a)"
Hx = "H1 cos(a) - H2 sin(a)"
Hy = "By + H4 cos(L) - H3 sin(L)"
Hz = "Bz + H4 sin(L) + H3 cos(L)"
K1 = "top_child_at_z sin(c)"
K2 = "top_child_at_y cos(b) - (top_child_at_z cos(c)) sin(b)"
K3 = "top_child_at_y sin(b) + (top_child_at_z cos(c)) cos(b)"
K4 = "K1 sin(a) + K2 cos(a)"
Kx = "K1 cos(a) - K2 sin(a)"
Ky = "By + K4 cos(L) - K3 sin(L)"
Kz = "Bz + K4 sin(L) + K3 cos(L)"
E1 = "end_child_at_x cos(c) + end_child_at_z sin(c)"
E2 = "end_child_at_y cos(b) - (end_child_at_z cos(c) - end_child_at_x sin(c)) sin(b)"
E3 = "end_child_at_y sin(b) + (end_child_at_z cos(c) - end_child_at_x sin(c)) cos(b)"
E4 = "E1 sin(a) + E2 cos(a)"
Ex = "E1 cos(a) - E2 sin(a)"
Ey = "By + E4 cos(L) - E3 sin(L)"
Ez = "Bz + E4 sin(L) + E3 cos(L)"
w1 = "L' + b' cos(a) - c' sin(a) cos(b)"
w2 = "b' sin(a) + c' cos(a) cos(b)"
w3 = "a' + c' sin(b)"
lower_y = "lower_center_y cos(L)"
lower_z = "heave + lower_center_y sin(L)"
upper_y = "upper_center_y cos(U)"
upper_z = "heave + upper_center_y sin(U)"
rod_x = "-rod_center_y sin(q)"
rod_y = "rod_center_y cos(q) cos(p)"
rod_z = "heave + rod_center_y cos(q) sin(p)"
strut_length = "sqrt((lower_at_y + strut_at_y cos(L) - strut_to_at_y)^2 + (lower_at_z + strut_at_y sin(L) - strut_to_at_z)^2)"
[lagrangian]
T = "1/2 (car_mass + rack_mass) heave'^2 + 1/2 lower_mass (lower_y'^2 + lower_z'^2) + 1/2 lower_inertia L'^2 + 1/2 upper_mass (upper_y'^2 + upper_z'^2) + 1/2 upper_inertia U'^2 + 1/2 hub_mass (Hx'^2 + Hy'^2 + (heave' + Hz')^2) + 1/2 hub_inertia (w1^2 + w2^2 + w3^2) + 1/2 rod_mass (rod_x'^2 + rod_y'^2 + rod_z'^2) + 1/2 rod_inertia (p'^2 + q'^2)"
V = "g ((car_mass + rack_mass) heave + lower_mass lower_z + upper_mass upper_z + hub_mass (heave + Hz) + rod_mass rod_z) + 1/2 k (strut_length - strut_rest)^2"
[forces]
rayleigh = "1/2 strut_damper strut_length'^2"
[constraints]
top_x = "Kx = 0"
top_y = "Ky = upper_at_y + top_at_y cos(U)"
top_z = "Kz = upper_at_z + top_at_y sin(U)"
end_x = "Ex = rack_at_x - end_at_y sin(q)"
end_y = "Ey = rack_at_y + end_at_y cos(q) cos(p)"
end_z = "Ez = end_at_y cos(q) sin(p)"
"#,
        joined: r#"map = { heave = "heave", L = "lower", U = "upper", a = "ball_yaw", b = "ball_lean", c = "ball_pitch", p = "rod_lean", q = "rod_yaw" }"#,
        slip: ["w1 = \"L' + b'", "w1 = \"b'"],
    },
    // In axes at rest: the point of the bowl moves with Om k × r (E. J. Routh, 1905, ch. V).
    Twin {
        file: "ball-in-bowl",
        hand: r#"
coordinates = ["X", "Y", "Z", "A", "B", "C"]
parameters = ["m", "r", "R", "Om", "g"]
[define]
w1 = "B' cos(A) - C' sin(A) cos(B)"
w2 = "B' sin(A) + C' cos(A) cos(B)"
w3 = "A' + C' sin(B)"
[lagrangian]
T = "1/2 m (X'^2 + Y'^2 + Z'^2) + 1/5 m r^2 (w1^2 + w2^2 + w3^2)"
V = "m g Z"
[constraints]
touch = "X^2 + Y^2 + Z^2 = (R - r)^2"
first = "(R - r) X' + r (w2 Z - w3 Y) = -R Om Y"
second = "(R - r) Y' + r (w3 X - w1 Z) = R Om X"
"#,
        joined: r#"
map = { X = "x cos(Om t) - y sin(Om t)", Y = "x sin(Om t) + y cos(Om t)", Z = "z", A = "a + Om t", B = "b", C = "c" }
parameters = { m = "ball_mass", r = "ball_radius", R = "R", Om = "Om" }
"#,
        slip: ["1/5 m", "1/3 m"],
    },
];

fn verdict(twin: &Twin, hand: &str) -> Verdict {
    let joined = format!(
        "{}\n[twin.hand]\nmodel = \"hand.toml\"\n{}\n",
        stated(twin.file),
        twin.joined
    );
    same_motion_with(&joined, &Hand(hand.to_owned()))
}

#[test]
fn bodies_have_the_motion_of_what_was_written_by_hand() {
    let mut wrong = Vec::new();
    for twin in TWINS {
        let right = verdict(twin, twin.hand);
        if !matches!(right, Verdict::Proved(_)) {
            wrong.push(format!("{}: {right:#?}", twin.file));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_slip_by_hand_is_refuted() {
    let mut wrong = Vec::new();
    for twin in TWINS {
        let [from, to] = twin.slip;
        assert!(twin.hand.contains(from), "{}: {from}", twin.file);
        let slipped = verdict(twin, &twin.hand.replacen(from, to, 1));
        if !matches!(slipped, Verdict::Refuted(_)) {
            wrong.push(format!("{}: {slipped:#?}", twin.file));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
