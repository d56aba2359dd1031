//! The Chaplygin sleigh: every number of the motion comes from the closed form (Chaplygin 1911;
//! Neimark and Fufaev 1972, chapter II).

use chetaev_report::data::*;

const M: f64 = 1.5;
const J: f64 = 0.4;
const A: f64 = 0.25;
const W: f64 = 2.1;

/// Forward speed, yaw rate and heading at a time.
fn closed_form(t: f64) -> (f64, f64, f64) {
    let inertia = J + M * A * A;
    let v = W * (inertia / M).sqrt();
    let k = M * A * v / inertia;
    let heading = W / k * 2.0 * ((k * t) / 2.0).tanh().atan();
    (v * (k * t).tanh(), W / (k * t).cosh(), heading)
}

/// The state at many times; the path of the blade by Simpson's rule.
fn states() -> Vec<[f64; 6]> {
    let h = 0.01;
    let mut rows = vec![[0.0, 0.0, 0.0, 0.0, 0.0, W]];
    let (mut x, mut y) = (0.0, 0.0);
    for i in 0..1200 {
        let t = f64::from(i) * h;
        let velocity = |t: f64| {
            let (v, _, phi) = closed_form(t);
            (v * phi.cos(), v * phi.sin())
        };
        let [a, b, c] = [t, t + h / 2.0, t + h].map(velocity);
        x += h / 6.0 * (a.0 + 4.0 * b.0 + c.0);
        y += h / 6.0 * (a.1 + 4.0 * b.1 + c.1);
        let (_, w, phi) = closed_form(t + h);
        rows.push([x, y, phi, c.0, c.1, w]);
    }
    rows
}

fn series(name: &str, unit: &str, group: SeriesGroup, values: Vec<f64>) -> Series {
    Series {
        name: name.into(),
        label: Some(name.replace('\'', "′").replace("phi", "φ")),
        unit: Some(unit.into()),
        group,
        values,
        ..Series::default()
    }
}

fn trajectory(rows: &[[f64; 6]]) -> Trajectory {
    let column = |i: usize| rows.iter().map(|row| row[i]).collect::<Vec<f64>>();
    let energy = |row: &[f64; 6]| {
        let v = row[3].hypot(row[4]);
        0.5 * M * v * v + 0.5 * (J + M * A * A) * row[5] * row[5]
    };
    let drift = |row: &[f64; 6]| row[4] * row[2].cos() - row[3] * row[2].sin();
    let start = energy(&rows[0]);
    let mut list = vec![
        series("x", "m", SeriesGroup::Coordinates, column(0)),
        series("y", "m", SeriesGroup::Coordinates, column(1)),
        series("phi", "rad", SeriesGroup::Coordinates, column(2)),
        series("x'", "m/s", SeriesGroup::Velocities, column(3)),
        series("y'", "m/s", SeriesGroup::Velocities, column(4)),
        series("phi'", "rad/s", SeriesGroup::Velocities, column(5)),
    ];
    // λ = m (v ω + …) across the blade: the rate of change of the momentum of the mass center.
    let lambda = rows.iter().map(|row| {
        let v = row[3].hypot(row[4]);
        M * v * row[5] * (1.0 - M * A * A / (J + M * A * A))
    });
    list.push(Series {
        label: Some("λ blade".into()),
        description: Some("Reaction of the blade, across it".into()),
        ..series(
            "lambda_blade",
            "N",
            SeriesGroup::Multipliers,
            lambda.collect(),
        )
    });
    list.push(series(
        "energy",
        "J",
        SeriesGroup::Energy,
        rows.iter().map(energy).collect(),
    ));
    for (name, values) in [
        ("blade", rows.iter().map(drift).collect::<Vec<_>>()),
        (
            "energy drift",
            rows.iter().map(|row| energy(row) - start).collect(),
        ),
    ] {
        list.push(Series {
            tolerance: Some(1e-9),
            unit: None,
            ..series(name, "", SeriesGroup::Drifts, values)
        });
    }
    Trajectory {
        times: (0..rows.len()).map(|i| i as f64 * 0.01).collect(),
        time_unit: Some("s".into()),
        series: list,
        conserved: vec![Conserved {
            name: "energy".into(),
            formula: letter("T"),
            origin: Some("the symmetry under shifts of time".into()),
            start,
            drift: Some("energy drift".into()),
            claim: Some("energy.integral".into()),
            ..Conserved::default()
        }],
        stop: Stop {
            reason: "The run reached the end of the time span, t = 12 s.".into(),
            ..Stop::default()
        },
        statistics: vec![
            fact("Method", "Dormand–Prince 8(5,3), dense output of order 7"),
            fact("Steps accepted", "86"),
            fact("Steps rejected", "2"),
            fact("Evaluations", "1058"),
            fact("Relative tolerance", "10⁻¹⁰"),
            fact("Estimated global error", "3.1 × 10⁻¹⁰"),
        ],
        chart_switches: vec![ChartSwitch {
            time: 1.62,
            detail: "From (x′, φ′) to (y′, φ′): the pivot cos φ fell to 0.12.".into(),
        }],
        events: vec![EventMet {
            time: 0.4,
            detail: "event `across`: its function falls through zero".into(),
        }],
        portraits: vec![
            Portrait {
                horizontal: "x".into(),
                vertical: "y".into(),
                title: Some("Path of the blade".into()),
                equal: true,
                ..Portrait::default()
            },
            Portrait {
                horizontal: "phi".into(),
                vertical: "phi'".into(),
                ..Portrait::default()
            },
        ],
        files: vec!["trajectory.csv".into(), "trajectory.npz".into()],
    }
}

fn animation(rows: &[[f64; 6]]) -> Animation {
    let frames: Vec<&[f64; 6]> = rows.iter().step_by(4).collect();
    let over = |place: &dyn Fn(&[f64; 6]) -> Vec<f64>| -> Vec<f64> {
        frames.iter().flat_map(|row| place(row)).collect()
    };
    let at = |row: &[f64; 6], along: f64, across: f64| {
        let (s, c) = row[2].sin_cos();
        [
            row[0] + along * c - across * s,
            row[1] + along * s + across * c,
        ]
    };
    let element = |name: &str, shape: Shape, tint: Tint, values: Vec<f64>| Element {
        name: name.into(),
        shape,
        tint,
        values,
    };
    Animation {
        spatial: false,
        times: (0..frames.len()).map(|i| i as f64 * 0.04).collect(),
        elements: vec![
            element("path of the blade", Shape::Trail, Tint::Blue, over(&|r| at(r, 0.0, 0.0).into())),
            element(
                "sleigh",
                Shape::Polyline {
                    points: 4,
                    closed: true,
                    filled: true,
                },
                Tint::Ink,
                over(&|r| {
                    [(0.55, 0.0), (-0.15, 0.25), (-0.05, 0.0), (-0.15, -0.25)]
                        .iter()
                        .flat_map(|(a, b)| at(r, *a, *b))
                        .collect()
                }),
            ),
            element(
                "blade",
                Shape::Blade,
                Tint::Red,
                over(&|r| vec![r[0], r[1], r[2], 0.22]),
            ),
            element("mass center", Shape::Point, Tint::Amber, over(&|r| at(r, A, 0.0).into())),
        ],
        unit: Some("m".into()),
        description: Some(
            "The sleigh seen from above. The blade cannot slip sideways; the mass center lies ahead of it.".into(),
        ),
        ..Animation::default()
    }
}

pub(crate) fn fact(label: &str, value: &str) -> Fact {
    Fact {
        label: label.into(),
        value: value.into(),
        ..Fact::default()
    }
}

pub(crate) fn formula(text: &str, mathml: &str, latex: &str) -> Formula {
    Formula {
        mathml: Some(mathml.into()),
        text: text.into(),
        latex: Some(latex.into()),
    }
}

fn letter(text: &str) -> Formula {
    formula(text, &format!("<mi>{text}</mi>"), text)
}

const COS: &str = "<mspace width=\"0.1667em\"></mspace><mrow><mi>cos</mi><mo>&#8289;</mo><mspace width=\"0.1667em\"></mspace><mi>φ</mi></mrow>";
const SIN: &str = "<mspace width=\"0.1667em\"></mspace><mrow><mi>sin</mi><mo>&#8289;</mo><mspace width=\"0.1667em\"></mspace><mi>φ</mi></mrow>";
const DX: &str = "<mover accent=\"true\"><mi>x</mi><mo stretchy=\"false\">˙</mo></mover>";
const DY: &str = "<mover accent=\"true\"><mi>y</mi><mo stretchy=\"false\">˙</mo></mover>";
const DPHI: &str = "<mover accent=\"true\"><mi>φ</mi><mo stretchy=\"false\">˙</mo></mover>";
const DDX: &str = "<mover accent=\"true\"><mi>x</mi><mo stretchy=\"false\">¨</mo></mover>";
const DDY: &str = "<mover accent=\"true\"><mi>y</mi><mo stretchy=\"false\">¨</mo></mover>";
const DDPHI: &str = "<mover accent=\"true\"><mi>φ</mi><mo stretchy=\"false\">¨</mo></mover>";

fn lagrangian() -> EquationSection {
    EquationSection {
        id: "lagrangian".into(),
        title: "Lagrangian and constraint".into(),
        explanation: vec![
            "The coordinates x, y are those of the blade’s point of contact; φ is the heading.".into(),
        ],
        equations: vec![
            Equation {
                formula: formula(
                    "L = m (x'^2 + y'^2)/2 + ...",
                    &format!("<mi>L</mi><mo>=</mo><mfrac><mi>m</mi><mn>2</mn></mfrac><mrow><mo>(</mo><msup><mrow><mo>(</mo>{DX}<mo>−</mo><mi>a</mi>{DPHI}{SIN}<mo>)</mo></mrow><mn>2</mn></msup><mo>+</mo><msup><mrow><mo>(</mo>{DY}<mo>+</mo><mi>a</mi>{DPHI}{COS}<mo>)</mo></mrow><mn>2</mn></msup><mo>)</mo></mrow><mo>+</mo><mfrac><mi>J</mi><mn>2</mn></mfrac><msup>{DPHI}<mn>2</mn></msup>"),
                    r"L = \frac{m}{2}\left((\dot x - a\dot\varphi\sin\varphi)^2 + (\dot y + a\dot\varphi\cos\varphi)^2\right) + \frac{J}{2}\dot\varphi^2",
                ),
                ..Equation::default()
            },
            Equation {
                formula: formula(
                    "y' cos(phi) - x' sin(phi) = 0",
                    &format!("{DY}{COS}<mo>−</mo>{DX}{SIN}<mo>=</mo><mn>0</mn>"),
                    r"\dot y\cos\varphi - \dot x\sin\varphi = 0",
                ),
                label: Some("blade".into()),
                caption: Some("Linear, homogeneous and scleronomic.".into()),
                ..Equation::default()
            },
        ],
        ..EquationSection::default()
    }
}

fn routh() -> EquationSection {
    let row = |label: &str, text: &str, mathml: String, latex: &str| Equation {
        formula: formula(text, &mathml, latex),
        label: Some(label.into()),
        ..Equation::default()
    };
    EquationSection {
        id: "routh".into(),
        title: "Equations of motion with multipliers".into(),
        formulation: Some("Routh–Chetaev".into()),
        explanation: vec!["One equation for each coordinate, and the constraint differentiated once.".into()],
        equations: vec![
            row(
                "x",
                "m x'' - m a phi'' sin(phi) - m a phi'^2 cos(phi) = -lambda sin(phi)",
                format!("<mi>m</mi>{DDX}<mo>−</mo><mi>m</mi><mi>a</mi>{DDPHI}{SIN}<mo>−</mo><mi>m</mi><mi>a</mi><msup>{DPHI}<mn>2</mn></msup>{COS}<mo>=</mo><mo>−</mo><mi>λ</mi>{SIN}"),
                r"m\ddot x - m a\ddot\varphi\sin\varphi - m a\dot\varphi^2\cos\varphi = -\lambda\sin\varphi",
            ),
            row(
                "y",
                "m y'' + m a phi'' cos(phi) - m a phi'^2 sin(phi) = lambda cos(phi)",
                format!("<mi>m</mi>{DDY}<mo>+</mo><mi>m</mi><mi>a</mi>{DDPHI}{COS}<mo>−</mo><mi>m</mi><mi>a</mi><msup>{DPHI}<mn>2</mn></msup>{SIN}<mo>=</mo><mi>λ</mi>{COS}"),
                r"m\ddot y + m a\ddot\varphi\cos\varphi - m a\dot\varphi^2\sin\varphi = \lambda\cos\varphi",
            ),
            row(
                "φ",
                "(J + m a^2) phi'' + m a (y'' cos(phi) - x'' sin(phi)) = 0",
                format!("<mrow><mo>(</mo><mi>J</mi><mo>+</mo><mi>m</mi><msup><mi>a</mi><mn>2</mn></msup><mo>)</mo></mrow>{DDPHI}<mo>+</mo><mi>m</mi><mi>a</mi><mrow><mo>(</mo>{DDY}{COS}<mo>−</mo>{DDX}{SIN}<mo>)</mo></mrow><mo>=</mo><mn>0</mn>"),
                r"(J + m a^2)\ddot\varphi + m a(\ddot y\cos\varphi - \ddot x\sin\varphi) = 0",
            ),
            Equation {
                definitions: vec![Definition {
                    formula: formula("v", &format!("<mi>v</mi><mo>=</mo>{DX}{COS}<mo>+</mo>{DY}{SIN}"), "v"),
                    text: Some("the speed along the blade".into()),
                }],
                caption: Some("The reaction in closed form.".into()),
                ..row(
                    "blade",
                    "lambda = J m v phi' / (J + m a^2)",
                    format!("<msub><mi>λ</mi><mtext>blade</mtext></msub><mo>=</mo><mfrac><mrow><mi>J</mi><mi>m</mi><mi>v</mi>{DPHI}</mrow><mrow><mi>J</mi><mo>+</mo><mi>m</mi><msup><mi>a</mi><mn>2</mn></msup></mrow></mfrac>"),
                    r"\lambda_{\text{blade}} = \frac{J m v \dot\varphi}{J + m a^2}",
                )
            },
        ],
        ..EquationSection::default()
    }
}

fn maggi() -> EquationSection {
    EquationSection {
        id: "maggi".into(),
        title: "Equations of motion without multipliers".into(),
        formulation: Some("Maggi".into()),
        claim: Some("formulation.equivalent#maggi".into()),
        equations: vec![
            Equation {
                formula: formula(
                    "m v' = m a phi'^2",
                    &format!("<mi>m</mi><mover accent=\"true\"><mi>v</mi><mo stretchy=\"false\">˙</mo></mover><mo>=</mo><mi>m</mi><mi>a</mi><msup>{DPHI}<mn>2</mn></msup>"),
                    r"m\dot v = m a\dot\varphi^2",
                ),
                ..Equation::default()
            },
            Equation {
                formula: formula(
                    "(J + m a^2) phi'' = -m a v phi'",
                    &format!("<mrow><mo>(</mo><mi>J</mi><mo>+</mo><mi>m</mi><msup><mi>a</mi><mn>2</mn></msup><mo>)</mo></mrow>{DDPHI}<mo>=</mo><mo>−</mo><mi>m</mi><mi>a</mi><mi>v</mi>{DPHI}"),
                    r"(J + m a^2)\ddot\varphi = -m a v\dot\varphi",
                ),
                ..Equation::default()
            },
            Equation {
                label: Some("long".into()),
                caption: Some("An equation wider than any page, to see it scroll.".into()),
                formula: formula(
                    "long",
                    &(0..40).map(|i| format!("<msub><mi>c</mi><mn>{i}</mn></msub>{DDX}<mo>+</mo>")).collect::<String>(),
                    "long",
                ),
                ..Equation::default()
            },
        ],
        ..EquationSection::default()
    }
}

fn claim(id: &str, verdict: Verdict, method: &str, detail: &str) -> Claim {
    let (claim, subject) = match id.split_once('#') {
        Some((claim, subject)) => (claim, Some(subject.to_owned())),
        None => (id, None),
    };
    Claim {
        claim: claim.into(),
        subject,
        verdict,
        method: Some(method.into()),
        detail: detail.into(),
        seconds: Some(0.0042),
        ..Claim::default()
    }
}

fn claims() -> Vec<Claim> {
    use Verdict::*;
    vec![
        Claim {
            on: Some("everywhere".into()),
            ..claim("model.hessian-regular", Proved, "exact", "The determinant of the mass matrix is J m², which is positive.")
        },
        Claim {
            on: Some("everywhere".into()),
            ..claim("model.constraints-independent", Proved, "exact", "The one constraint has rank 1 everywhere.")
        },
        claim("model.constraints-linear", Proved, "structural", "The constraint is linear in the velocities."),
        claim("model.constraints-homogeneous", Proved, "exact", "The constraint is homogeneous of degree 1 in the velocities."),
        Claim {
            counterexample: Some("x = 0, y = 0, φ = 0\nω ∧ dω = dx ∧ dy ∧ dφ ≠ 0, enclosed in [1, 1]".into()),
            samples: Some(1),
            seed: Some(1),
            ..claim("model.constraints-integrable#weak", Refuted, "enclosure", "The constraint cannot be integrated: the sleigh can reach every position.")
        },
        Claim {
            title: Some("Maggi’s equations give the same accelerations as Routh’s".into()),
            error_bound: Some("2^-104".into()),
            on: Some("the constraint manifold, off cos φ = 0".into()),
            samples: Some(3),
            seed: Some(20240607),
            requires: vec!["model.hessian-regular".into(), "model.constraints-independent".into()],
            expected: Some(Proved),
            ..claim("formulation.equivalent#maggi", Proved, "modular", "Both systems were evaluated at random points of three prime fields and agree at all of them.")
        },
        Claim {
            condition: Some("model.constraints-integrable#weak".into()),
            ..claim("formulation.equivalent#vakonomic", NotApplicable, "structural", "The constrained extremum gives other equations unless the constraint is integrable.")
        },
        Claim {
            condition: Some("φ′ (x′ cos φ + y′ sin φ) = 0".into()),
            ..claim("hamilton.stationary", Conditional, "exact", "Hamilton’s action is stationary only on straight runs and on turns on the spot.")
        },
        claim("energy.integral", Proved, "exact", "The energy T is an integral: the constraint is homogeneous and L does not depend on t."),
        Claim {
            samples: Some(1201),
            residual: Some("2.2 × 10⁻¹⁶".into()),
            ..claim("motion.constraint-drift", Numerical, "measured", "The largest drift of the constraint was 2.2 × 10⁻¹⁶, within the tolerance 10⁻⁹.")
        },
        Claim {
            expected: Some(Refuted),
            ..claim("measure.invariant", Undecided, "search", "No smooth invariant measure was found in the family tried before the time ran out (60 s).")
        },
    ]
}

const MODEL: &str = include_str!("model.toml");

pub(crate) fn report() -> Report {
    let rows = states();
    Report {
        tables: Vec::new(),
        maps: Vec::new(),
        comparison: None,
        found: vec![Found {
            subject: "Energy".into(),
            sentences: vec!["conserved; the reaction is λ_{blade}".into()],
            claims: vec!["energy.integral".into()],
        }],
        title: "Chaplygin sleigh".into(),
        subtitle: Some("A rigid body on a plane, carried by a blade and two smooth feet".into()),
        description: vec![
            "A body slides on a horizontal plane. A blade fixed to it lets its point of contact move only along the blade; two smooth feet keep the body level. The mass center lies at the distance a ahead of the blade.".into(),
            "Although the energy is conserved, the sleigh tends to a straight run with the mass center ahead: a nonholonomic system need not preserve volume.".into(),
        ],
        history: vec!["Chaplygin treated the sleigh in 1911 with his reducing multiplier; Carathéodory in 1933 showed that the motion cannot be obtained from viscous friction in the limit he tried.".into()],
        sources: vec![
            Source {
                text: "S. A. Chaplygin, On the theory of motion of nonholonomic systems, 1911.".into(),
                link: None,
            },
            Source {
                text: "J. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, 1972, chapter II.".into(),
                link: Some("https://bookstore.ams.org/mmono-33".into()),
            },
        ],
        facts: vec![
            Fact { symbol: Some("n".into()), ..fact("Coordinates", "3: x, y, φ") },
            Fact { symbol: Some("r".into()), ..fact("Constraints", "1") },
            Fact { symbol: Some("k".into()), ..fact("Independent velocities", "2") },
            fact("Constraints are", "linear, homogeneous, scleronomic"),
            Fact { claim: Some("model.constraints-integrable#weak".into()), ..fact("Kind", "nonholonomic") },
            fact("Forces", "none"),
        ],
        parameters: [("m", "3/2", "kg", "mass"), ("J", "2/5", "kg m²", "moment of inertia about the mass center"), ("a", "1/4", "m", "distance from the blade to the mass center")]
            .map(|(name, value, unit, description)| Parameter {
                name: letter(name),
                value: Some(value.into()),
                unit: Some(unit.into()),
                range: Some("> 0".into()),
                description: Some(description.into()),
                ..Parameter::default()
            })
            .into(),
        assumptions: ["m", "J", "a"]
            .map(|name| Assumption {
                formula: formula(name, &format!("<mi>{name}</mi><mo>&gt;</mo><mn>0</mn>"), name),
                note: None,
            })
            .into(),
        initial: vec![
            InitialValue { name: letter("x"), unit: Some("m".into()), origin: Origin::Default, ..InitialValue::default() },
            InitialValue { name: letter("y"), unit: Some("m".into()), origin: Origin::Default, ..InitialValue::default() },
            InitialValue { name: letter("φ"), unit: Some("rad".into()), ..InitialValue::default() },
            InitialValue { name: formula("phi'", DPHI, "x"), value: W, stated: Some(Formula { text: "W".into(), ..Formula::default() }), unit: Some("rad/s".into()), ..InitialValue::default() },
            InitialValue { name: formula("y'", DY, "x"), unit: Some("m/s".into()), origin: Origin::Projected, ..InitialValue::default() },
        ],
        sections: vec![lagrangian(), routh(), maggi()],
        claims: claims(),
        trajectory: Some(trajectory(&rows)),
        figures: vec![Figure {
            title: "Observed order of the method".into(),
            explanation: vec!["Error at the end of the run against the step: a straight line of slope 8.".into()],
            horizontal: "step".into(),
            horizontal_unit: Some("s".into()),
            abscissae: (0..7).map(|i| 0.4 * 0.5_f64.powi(i)).collect(),
            series: vec![Series {
                name: "error".into(),
                values: (0..7).map(|i| 2e-4 * 0.5_f64.powi(8 * i) + 1e-15).collect(),
                ..Series::default()
            }],
            plane: None,
            logarithmic_horizontal: true,
            logarithmic_vertical: true,
            marks: true,
            claim: Some("motion.constraint-drift".into()),
        }],
        animation: Some(animation(&rows)),
        model: Some(ModelSource {
            files: vec![SourceFile { name: "gallery/chaplygin-sleigh/model.toml".into(), text: MODEL.into() }],
            overrides: vec!["a=0.25".into()],
        }),
        notices: vec![],
        reproducibility: Reproducibility {
            version: "0.1.0".into(),
            seed: Some(20240607),
            command: Some("chetaev study gallery/chaplygin-sleigh/model.toml --set a=0.25".into()),
            details: vec![fact("Schema of study.json", "1")],
        },
    }
}
