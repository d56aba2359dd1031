//! Noether's theorem for fields: the integrals J, L and M, against references computed by others (S-F14, S-F15), and refutations with the
//! defect where a hypothesis fails.

use crate::table::loaded_text;
use chetaev_functionals::claims::noether::current;
use chetaev_functionals::functional::{Functional, Interval, Side};
use chetaev_functionals::integral::{over_box, over_face};
use chetaev_functionals::notation::parse;
use chetaev_functionals::study;
use chetaev_functionals::variation::variation;
use chetaev_symbolic::Expr;
use std::collections::BTreeMap;

fn text(name: &str) -> String {
    let path = format!(
        "{}/../../gallery/fields/{name}/model.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read_to_string(path).unwrap()
}

fn expression(f: &Functional, written: &str) -> Expr {
    let node = parse(written, &f.scope, &mut Vec::new()).unwrap();
    f.scope.value(&node, &BTreeMap::new())
}

/// The field of S-F14 on the rectangle 0 < x_1 < 1, 0 < x_2 < 2, with the body force that balances it.
struct Field<'f> {
    functional: &'f Functional,
    pairs: Vec<(Expr, Expr)>,
    intervals: [Interval; 2],
}

impl<'f> Field<'f> {
    fn of(functional: &'f Functional) -> Field<'f> {
        let (space, g) = (&*functional.space, &functional.space.graph);
        let of = |(name, value): (&str, &str)| {
            let component = space.component_named(name)?;
            Some((space.jet(component, &[]), expression(functional, value)))
        };
        let mut pairs: Vec<(Expr, Expr)> = [
            ("u_1", "x_1^2 x_2 - x_2"),
            ("u_2", "x_1^2/2 + x_1 x_2^2"),
            ("F_1", "-14 x_2"),
            ("F_2", "-14 x_1 - 1"),
        ]
        .into_iter()
        .filter_map(of)
        .collect();
        for (name, value) in [("lambda", "2"), ("mu", "1")] {
            pairs.push((expression(functional, name), expression(functional, value)));
        }
        let intervals = [(0, 1), (1, 2)].map(|(axis, upper)| Interval {
            axis,
            lower: g.zero(),
            upper: g.integer(upper),
        });
        Field {
            functional,
            pairs,
            intervals,
        }
    }

    fn put(&self, e: Expr) -> Expr {
        self.functional.space.put(e, &self.pairs)
    }

    /// The integral of a current over the edge, outwards.
    fn around(&self, symmetry: &str) -> String {
        let (space, g) = (&*self.functional.space, &self.functional.space.graph);
        let flux = current(self.functional, symmetry).unwrap().flux;
        let mut terms = Vec::new();
        for (axis, own) in flux.iter().enumerate() {
            for is_upper in [false, true] {
                let Interval { lower, upper, .. } = self.intervals[axis];
                let at = if is_upper { upper } else { lower };
                let side = Side::Flat { axis, is_upper, at };
                let value = over_face(space, self.put(*own), &side, &self.intervals).unwrap();
                terms.push(if is_upper { value } else { g.neg(value) });
            }
        }
        g.text(g.add(&terms))
    }

    /// The integral over the rectangle.
    fn inside(&self, e: Expr) -> String {
        let (space, g) = (&*self.functional.space, &self.functional.space.graph);
        g.text(over_box(space, self.put(e), &self.intervals).unwrap())
    }
}

/// The symmetries of the plane with the integrals of S-F14: J_1, J_2, M and L.
const INTEGRALS: [(&str, &str); 4] = [
    ("translation-x_1", "-69"),
    ("translation-x_2", "-2"),
    ("scaling", "-49"),
    ("rotation-x_1-x_2", "49"),
];

#[test]
fn the_integrals_j_l_and_m_of_a_plane_field_are_those_of_the_reference() {
    // S-F14: Eshelby 1951, Rice 1968, Knowles and Sternberg 1972.
    let f = loaded_text("p4p", &text("elastic-plane"), &[]).functional;
    let field = Field::of(&f);
    for (symmetry, value) in INTEGRALS {
        assert_eq!(field.around(symmetry), value, "{symmetry}");
    }
}

/// S-F14: what a current takes through the edge is what the body force leaves of it inside.
#[test]
fn the_defects_of_a_body_force_are_those_of_the_reference() {
    let f = loaded_text("p4p", &pulled(), &[]).functional;
    let field = Field::of(&f);
    for (_, euler) in variation(&f).unwrap().euler {
        assert!(f.space.vanish(&[field.put(euler)]));
    }
    let defects = [
        "F_i u_i,1",
        "F_i u_i,2",
        "x_1 F_i u_i,1 + x_2 F_i u_i,2",
        "F_i (x_1 u_i,2 - x_2 u_i,1) - (u_1 F_2 - u_2 F_1)",
    ];
    for ((symmetry, value), defect) in INTEGRALS.into_iter().zip(defects) {
        assert_eq!(field.inside(expression(&f, defect)), value, "{symmetry}");
    }
}

/// The current of the density with the body force in it, as it is printed with its defect: −F_i,k u_i for translations, of which the integrals
/// are 14 ∫ u_2 = 70/3 and 14 ∫ u_1 = −56/3 here.
#[test]
fn a_defect_that_is_shown_is_what_goes_through_the_edge() {
    let study = study(loaded_text("p4p", &pulled(), &[]), &|_| true, &|| 0.0);
    let field = Field::of(&study.problem.functional);
    let by_hand = [Some("70/3"), Some("-56/3"), None, None];
    for ((symmetry, _), by_hand) in INTEGRALS.into_iter().zip(by_hand) {
        let mut all = study.verdicts.iter();
        let found = all.find(|d| d.subject.as_deref() == Some(symmetry));
        let mut formulas = found.unwrap().finding.formulas.iter();
        let defect = formulas.find(|f| f.caption.contains("defect")).unwrap();
        let inside = field.inside(defect.value);
        assert_eq!(inside, field.around(symmetry), "{symmetry}");
        assert!(by_hand.is_none_or(|own| inside == own), "{inside}");
    }
}

#[test]
fn the_integral_around_the_tip_of_a_crack_is_the_energy_release_rate() {
    // S-F15: w = (2K/μ) √(r/2π) sin(θ/2), J = K²/(2μ).
    let f = loaded_text("p4p", &text("crack"), &[]).functional;
    let (space, g) = (&*f.space, &f.space.graph);
    let flux = current(&f, "translation-x").unwrap().flux;
    let (mu, k) = (80.0, 3.0);
    let slopes = |r: f64, angle: f64| {
        let c = k / mu / (2.0 * std::f64::consts::PI * r).sqrt();
        (-c * (angle / 2.0).sin(), c * (angle / 2.0).cos())
    };
    for r in [0.5, 2.0] {
        let count = 2000;
        let mut sum = 0.0;
        for i in 0..count {
            let angle = -std::f64::consts::PI
                + 2.0 * std::f64::consts::PI * (f64::from(i) + 0.5) / f64::from(count);
            let (wx, wy) = slopes(r, angle);
            let values = g
                .evaluate_f64(&flux, &|symbol| match space.as_jet(symbol) {
                    Some(jet) => Some(if jet.by == [0] { wx } else { wy }),
                    None => Some(mu),
                })
                .unwrap();
            let step = 2.0 * std::f64::consts::PI * r / f64::from(count);
            sum += (values[0] * angle.cos() + values[1] * angle.sin()) * step;
        }
        assert!((sum - 0.05625).abs() < 1e-9, "{sum}");
    }
}

/// The verdict on a symmetry, with the formulas shown.
fn verdict(text: &str, symmetry: &str) -> (String, String, Vec<String>) {
    let problem = loaded_text("p4p", text, &[]);
    let study = study(problem, &|id| id == "functional.noether", &|| 0.0);
    let found = study
        .verdicts
        .iter()
        .find(|d| d.claim == "functional.noether" && d.subject.as_deref() == Some(symmetry));
    let finding = &found.unwrap_or_else(|| panic!("no {symmetry}")).finding;
    let g = &study.problem.functional.space.graph;
    let formulas = finding
        .formulas
        .iter()
        .map(|f| format!("{}: {}", f.caption, g.text(f.value)));
    (
        finding.verdict.word().to_owned(),
        finding.verdict.detail().to_owned(),
        formulas.collect(),
    )
}

/// The words for translation, rotation and scaling; a refuted one shows its defect.
fn words(text: &str, wanted: [&str; 3]) {
    let all = ["translation-x_1", "rotation-x_1-x_2", "scaling"];
    for (symmetry, word) in all.into_iter().zip(wanted) {
        let (own, detail, formulas) = verdict(text, symmetry);
        assert_eq!(own, word, "{symmetry}: {detail}");
        let has_defect = formulas.iter().any(|f| f.contains("defect"));
        assert_eq!(has_defect, word == "refuted", "{symmetry}: {formulas:?}");
    }
}

fn plane_with(from: &str, to: &str) -> String {
    let plane = text("elastic-plane");
    assert!(plane.contains(from));
    plane.replace(from, to)
}

/// With a body force.
fn pulled() -> String {
    let force = plane_with(
        "(u_i,j + u_j,i)\"\nyields",
        "(u_i,j + u_j,i) - F_k u_k\"\nyields",
    );
    force.replace("[fields]", "[data]\nF = \"vector\"\n[fields]")
}

#[test]
fn a_body_force_leaves_none_of_the_currents() {
    words(&pulled(), ["refuted"; 3]);
}

#[test]
fn a_body_that_is_not_homogeneous_has_no_current_of_translations() {
    let graded = plane_with("lambda/2 u_i,i", "lambda x_1/2 u_i,i");
    words(&graded, ["refuted"; 3]);
}

#[test]
fn a_fibre_takes_the_current_of_rotations() {
    let fibre = plane_with("lambda/2 u_i,i u_j,j", "lambda/2 u_1,1^2");
    words(&fibre, ["proved", "refuted", "proved"]);
}

#[test]
fn an_energy_that_is_not_homogeneous_in_the_gradient_takes_that_of_scalings() {
    let mixed = text("crack").replace("mu/2 w,i w,i", "mu/2 w,i w,i + mu/4 (w,i w,i)^2");
    for (symmetry, wanted) in [
        ("translation-x", "proved"),
        ("rotation-x-y", "proved"),
        ("scaling", "refuted"),
    ] {
        let (word, detail, _) = verdict(&mixed, symmetry);
        assert_eq!(word, wanted, "{symmetry}: {detail}");
    }
}

#[test]
fn the_exponent_of_a_scaling_follows_from_the_degree() {
    // A gradient to the power p in n dimensions: exponent (p − n)/p.
    let crack = text("crack");
    for (density, exponent) in [
        ("mu/2 w,i w,i", "0"),
        ("mu/4 (w,i w,i)^2", "1/2"),
        ("mu/6 (w,i w,i)^3", "2/3"),
    ] {
        let text = crack.replace("mu/2 w,i w,i", density);
        let (word, detail, _) = verdict(&text, "scaling");
        assert_eq!(word, "proved", "{density}: {detail}");
        assert!(
            detail.contains(&format!("w with the exponent {exponent}")),
            "{detail}"
        );
    }
}

#[test]
fn energy_is_the_current_of_time() {
    let text = std::fs::read_to_string(format!(
        "{}/../../gallery/fields/string/model.toml",
        env!("CARGO_MANIFEST_DIR")
    ))
    .unwrap();
    let text = text.replacen("yields", "symmetries = [\"translations\"]\nyields", 1);
    let (word, detail, formulas) = verdict(&text, "translation-t");
    assert_eq!(word, "proved", "{detail}");
    assert!(
        formulas
            .iter()
            .any(|f| f.starts_with("the current along t")),
        "{formulas:?}"
    );
}

/// A density of two fields in d dimensions, without boundary terms.
fn two_fields(density: &str, d: u8) -> String {
    format!(
        r#"
kind = "functional"
name = "two"
density = "{density}"
symmetries = ["translations", "scaling"]
[sizes]
d = {d}
[domain]
coordinates = "x_i"
boundary = ["S"]
[fields]
u = "scalar"
v = "scalar"
w = "vector"
[parameters]
p = {{ description = "a degree" }}
[boundary]
S = "0"
"#
    )
}

#[test]
fn the_exponents_of_several_fields_are_solved_for() {
    // a + b = 2 − d for a product of gradients; 2(a − 1) = −d for a square; u v needs a + b = −d.
    let wanted = [
        (
            "u,i v,i",
            3,
            "u with the exponent -1/2, v with the exponent -1/2,",
        ),
        (
            "u,i v,i",
            3,
            "as well with any multiple of a change of u by -1, v by 1",
        ),
        (
            "u,i v,i",
            1,
            "u with the exponent 1/2, v with the exponent 1/2,",
        ),
        (
            "u,i v,i + u,i u,i",
            3,
            "u with the exponent -1/2, v with the exponent -1/2,",
        ),
        // 2a − 2 = −3 and a + 3b − 4 = −3: b = 1/2.
        (
            "u,i u,i + u,i v,i v,j v,j",
            3,
            "u with the exponent -1/2, v with the exponent 1/2,",
        ),
        // a = −3/2 from u², then a + b − 1 = −3.
        (
            "u^2 + u w_i,i + v,i v,i",
            3,
            "u with the exponent -3/2, v with the exponent -1/2, w with the exponent -1/2)",
        ),
        // The degree is a parameter: 2p (a − 1) = −3.
        ("(u,i u,i)^p + v^2 + w_i w_i", 3, "u with the exponent "),
        // Only different exponents of the components: 1/2 and 3/4 in one dimension do not exist for a vector in the plane otherwise.
        (
            "w_1,1^2 + w_2,2^4 + u^2 + v^2",
            2,
            "w_1 with the exponent 0, w_2 with the exponent 1/2",
        ),
    ];
    for (density, d, words) in wanted {
        let (word, detail, _) = verdict(&two_fields(density, d), "scaling");
        assert_eq!(word, "proved", "{density}: {detail}");
        assert!(detail.contains(words), "{density}: {detail}");
    }
}

#[test]
fn where_no_exponents_exist_the_scaling_is_refuted() {
    for density in [
        "u,i v,i + u^2 v^2 + u v",
        "u,i u,i + v,i v,i + u v + u^3",
        "u,i v,i + x_1 u,i v,i",
    ] {
        let (word, detail, formulas) = verdict(&two_fields(density, 3), "scaling");
        assert_eq!(word, "refuted", "{density}: {detail}");
        assert!(
            detail.contains("there are no exponents for which the defect vanishes"),
            "{detail}"
        );
        assert!(
            formulas.iter().any(|f| f.contains("defect")),
            "{formulas:?}"
        );
    }
}

#[test]
fn a_defect_that_is_a_divergence_leaves_a_current() {
    // ½ u'² + x u' = ½ u'² − u + (x u)': of the translation u' is left, a divergence; with v explicit it is none.
    for (density, word) in [
        ("1/2 u,1^2 + x_1 u,1", "proved"),
        ("1/2 u,1^2 + x_1^2 u", "refuted"),
        ("1/2 u,1^2 + x_1 u,1 v + 1/2 v^2", "refuted"),
        ("1/2 u,1^2 + x_1 (u v,1 + v u,1)", "proved"),
    ] {
        let (own, detail, _) = verdict(&two_fields(density, 1), "translation-x_1");
        assert_eq!(own, word, "{density}: {detail}");
    }
}

/// (r² u,i),i = 0 is a product with r, and is decided where r does not vanish: 1/2 r² u,i u,i is the same nowhere else.
#[test]
fn a_coefficient_that_is_given_is_no_obstacle() {
    let text = "kind = \"functional\"\nname = \"r\"\ndensity = \"1/2 r^2 u,i u,i\"\nsymmetries = [\"translations\", \"rotations\"]\n\
        [domain]\ncoordinates = [\"x\", \"y\"]\nboundary = [\"S\"]\n[fields]\nu = \"scalar\"\n[data]\nr = \"scalar\"\n[boundary]\nS = \"0\"\n";
    let study = study(loaded_text("p4p", text, &[]), &|_| true, &|| 0.0);
    let own = study
        .verdicts
        .iter()
        .filter(|d| d.claim == "functional.noether");
    let words: Vec<&str> = own.map(|d| d.finding.verdict.word()).collect();
    assert_eq!(words, ["refuted"; 3]);
}

/// With the density ½ u,x² + ½ u,y² + x u,y, whose last term changes by u,y = (u),y as x moves, Noether's current along x has the divergence u,y
/// for solutions of u,xx + u,yy = 0: the one that is shown has none.
#[test]
fn a_current_that_is_shown_of_a_symmetry_up_to_a_divergence_is_conserved() {
    let model = |density: &str, time: &str| {
        format!(
            "kind = \"functional\"\nname = \"n\"\ndensity = \"{density}\"\nsymmetries = [\"translations\", \"rotations\", \"scaling\"]\n[domain]\n\
             coordinates = [\"x\", \"y\"]\n{time}boundary = [\"S\"]\n[fields]\nu = \"scalar\"\n[boundary]\nS = \"0\"\n"
        )
    };
    let plane = ["translation-x", "translation-y", "rotation-x-y", "scaling"];
    let wave = ["translation-x", "translation-t", "rotation-x-y"];
    for (density, time, symmetries) in [
        ("1/2 u,x^2 + 1/2 u,y^2 + x u,y", "", &plane[..]),
        ("1/2 u,x^2 + 1/2 u,y^2 + x u^2 u,y + x", "", &plane[..3]),
        (
            "1/2 u,t^2 - 1/2 u,x^2 - 1/2 u,y^2 + t u u,x + x u u,t",
            "time = \"t\"\n",
            &wave[..2],
        ),
    ] {
        let problem = loaded_text("p4p", &model(density, time), &[]);
        let study = study(problem, &|id| id == "functional.noether", &|| 0.0);
        let functional = &study.problem.functional;
        let space = &*functional.space;
        let g = &space.graph;
        let euler = variation(functional).unwrap().euler;
        let u = space.component_named("u").unwrap();
        for symmetry in symmetries {
            let own = study.verdicts.iter();
            let mut own = own.filter(|d| d.subject.as_deref() == Some(symmetry));
            let finding = &own.next().unwrap().finding;
            let detail = finding.verdict.detail();
            assert_eq!(
                finding.verdict.word(),
                "proved",
                "{density}, {symmetry}: {detail}"
            );
            let axes = space.coordinates.iter().enumerate();
            let terms = axes.filter_map(|(axis, c)| {
                let caption = format!("the current along {}", c.name);
                let along = finding.formulas.iter().find(|f| f.caption == caption)?;
                Some(space.total(along.value, axis))
            });
            let divergence = g.add(&terms.collect::<Vec<_>>());
            // Solutions: u,xx is what its Euler equation says.
            let xx = space.jet(u, &[0, 0]);
            let rest = space.put(euler[0].1, &[(xx, g.zero())]);
            let slope = g.sub(space.put(euler[0].1, &[(xx, g.one())]), rest);
            let on_solutions = space.put(divergence, &[(xx, g.neg(g.div(rest, slope)))]);
            assert!(
                space.vanish(&[on_solutions]),
                "{density}, {symmetry}: {}",
                g.text(on_solutions)
            );
        }
    }
    // Of a function that is no polynomial no such K is found.
    let (word, detail, _) = verdict(
        &model("1/2 u,x^2 + 1/2 u,y^2 + x cos(u) u,y", ""),
        "translation-x",
    );
    assert_eq!(word, "undecided", "{detail}");
    let (_, detail, formulas) =
        verdict(&model("1/2 u,x^2 + 1/2 u,y^2 + x u,y", ""), "translation-x");
    assert!(detail.contains("up to the divergence of a K"), "{detail}");
    assert!(
        formulas
            .iter()
            .any(|f| f.starts_with("K, ") && f.ends_with("along y: u")),
        "{formulas:?}"
    );
}
