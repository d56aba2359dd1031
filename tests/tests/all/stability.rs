//! `chetaev linearize` and `chetaev stability` as a person uses them, and the claims on steady motions in a study.
#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "test code fails where it stands"
)]

use chetaev::study::stability::map::{Asked, Course};
use chetaev::study::stability::Wanted;
use chetaev_tests::places::root;
use chetaev_tests::program::{run, text};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;

fn model(name: &str) -> PathBuf {
    root().join(format!("gallery/{name}/model.toml"))
}

fn json(arguments: &[&str]) -> Value {
    let finished = run(arguments);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    serde_json::from_str(&finished.out).expect("JSON")
}

/// The critical speeds of Meijaard, Papadopoulos, Ruina and Schwab 2007, with more digits than their print has.
#[test]
fn the_bicycle_from_the_command_line() {
    let path = model("whipple-bicycle");
    let found = json(&["stability", text(&path), "--over", "v=0:10", "--json"]);
    let critical: Vec<(&str, f64)> = (found["critical"].as_array().expect("a list").iter())
        .map(|c| {
            (
                c["kind"].as_str().expect("a kind"),
                c["value"].as_f64().expect("a value"),
            )
        })
        .filter(|(kind, _)| *kind != "touching")
        .collect();
    for (kind, expected) in [
        ("pair", 4.292_382_536_341_104),
        ("zero", 6.024_262_015_388_359),
    ] {
        assert!(
            critical
                .iter()
                .any(|(own, value)| *own == kind && (value - expected).abs() < 1e-14),
            "{critical:?}"
        );
    }
    let stable: Vec<&Value> = (found["regions"].as_array().expect("a list").iter())
        .filter(|r| r["stability"] == "asymptotic")
        .collect();
    assert_eq!(stable.len(), 1);
    let printed = run(&["stability", text(&path), "--over", "v=0:10"]);
    assert!(
        printed
            .out
            .contains("4.292382536341104 < v < 6.024262015388359: stable"),
        "{}",
        printed.out
    );
    // The weave speed is a Hopf point. Simulated on the energy of the upright motion there, the amplitude A of the lean has 1/A² = 20.98 t + …; with
    // w' = iω w + c w |w|² and A = 2 |φ| |w| that is −2 Re c/(4 |φ|²), where the eigenvector of unit length has |φ|² = 0.0318 and ω = 3.435.
    let weave = (found["critical"].as_array().expect("a list").iter())
        .find(|c| c["kind"] == "pair")
        .expect("the weave speed");
    let own = weave["first_lyapunov"].as_f64().expect("a coefficient");
    let simulated = -20.98 * 4.0 * 0.0318 / 2.0 / 3.435;
    assert!((own / simulated - 1.0).abs() < 0.02, "{own} {simulated}");
    assert!(printed.out.contains("supercritical"), "{}", printed.out);
    let linear = run(&["linearize", text(&path)]);
    assert!(
        linear.out.contains("z = (phi, delta, phi', delta', thR')"),
        "{}",
        linear.out
    );
}

/// What a study states of the motions that gallery models name.
#[test]
fn claims_on_steady_motions() {
    let claims = [
        (
            "whipple-bicycle",
            "stability.asymptotic",
            "upright",
            "conditional",
            "4.292382536341104 < v < 6.024262015388359",
        ),
        ("whipple-bicycle", "steady.stated", "upright", "proved", ""),
        (
            "chaplygin-sleigh",
            "stability.asymptotic",
            "straight",
            "conditional",
            "ahead > 0",
        ),
        (
            "double-pendulum",
            "stability.spectral",
            "hanging",
            "proved",
            "",
        ),
        (
            "double-pendulum",
            "stability.asymptotic",
            "hanging",
            "refuted",
            "",
        ),
        (
            "double-pendulum",
            "stability.spectral",
            "inverted",
            "refuted",
            "",
        ),
    ];
    for (name, claim, subject, verdict, condition) in claims {
        let path = model(name);
        let out =
            std::env::temp_dir().join(format!("chetaev-stability-{name}-{}", std::process::id()));
        let found = json(&[
            "study",
            text(&path),
            "--claims",
            "stability",
            "--json",
            "--out",
            text(&out),
        ]);
        let _ = std::fs::remove_dir_all(&out);
        let own = (found["verdicts"].as_array().expect("verdicts").iter())
            .find(|v| v["claim"] == claim && v["subject"] == subject)
            .unwrap_or_else(|| panic!("{name}: {claim}#{subject} is missing"));
        assert_eq!(own["verdict"], verdict, "{name}: {own}");
        assert_eq!(
            own["condition"].as_str().unwrap_or_default(),
            condition,
            "{name}: {own}"
        );
    }
}

/// A thin disc rolls upright without falling where ω² > g/(3 r), and spins on the spot where Ω² > 4 g/(5 r) (Routh 1905).
#[test]
fn the_disc_stands_above_its_critical_rates() {
    let path = model("falling-rolling-disc");
    for (about, squared) in [
        ("rolling", 9.81 / (3.0 * 0.3)),
        ("spinning", 4.0 * 9.81 / (5.0 * 0.3)),
    ] {
        let found = json(&[
            "stability",
            text(&path),
            "--about",
            about,
            "--over",
            "spin=0:12",
            "--json",
        ]);
        let regions = found["regions"].as_array().expect("a list");
        let last = regions.last().expect("a region");
        assert_eq!(last["stability"], "spectral");
        let from = last["from"].as_f64().expect("a number");
        assert!(
            (from * from - squared).abs() < 1e-12 * squared,
            "{about}: {from}"
        );
        assert!(regions[..regions.len() - 1]
            .iter()
            .all(|r| r["stability"] == "unstable"));
    }
}

/// What is written for other programs: a file in the format of its end, or a word that there is none.
#[test]
fn linear_equations_for_other_programs() {
    let path = model("whipple-bicycle");
    let folder = std::env::temp_dir().join(format!("chetaev-linear-{}", std::process::id()));
    let begins: [(&str, &[u8]); 4] = [
        ("npz", b"PK"),
        ("mat", &[0, 0, 0, 0, 5, 0, 0, 0, 5, 0, 0, 0]),
        ("py", b"# whipple-bicycle"),
        ("tex", b"\\[ E ="),
    ];
    for (end, begin) in begins {
        let file = folder.join(format!("linear.{end}"));
        let finished = run(&["linearize", text(&path), "--save", text(&file)]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        let content = std::fs::read(&file).expect("a file");
        assert!(content.starts_with(begin), "{end}");
    }
    let refused = run(&["linearize", text(&path), "--save", "linear.doc"]);
    assert_eq!(refused.status, Some(2));
    assert!(
        refused.both().contains(".npz (NumPy)"),
        "{}",
        refused.both()
    );
    let _ = std::fs::remove_dir_all(&folder);
    let few = run(&["linearize", text(&path), "--speeds", "phi'"]);
    assert!(few.both().contains("name 3 speeds"), "{}", few.both());
    // One twice, one times another number, and no function linear in the velocities.
    for choice in ["phi',phi',thR'", "phi',2*phi',thR'", "phi'^2,delta',thR'"] {
        let found = run(&["linearize", text(&path), "--speeds", choice]);
        assert_eq!(found.status, Some(2), "{choice}");
        let said = found.both();
        assert!(
            said.contains("is no choice of independent speeds"),
            "{said}"
        );
    }
}

#[test]
fn slips_are_named() {
    let path = model("whipple-bicycle");
    let cases: [(&[&str], &str); 5] = [
        (&["--over", "v=5:1"], "is no range"),
        (&["--over", "speed=0:1"], "is no parameter of the model"),
        (&["--over", "v"], "is no range"),
        (
            &["--about", "sideways"],
            "names no steady motion `sideways`",
        ),
        (&["--about", "start"], "is not steady"),
    ];
    for (arguments, expected) in cases {
        let all = [&["stability", text(&path)], arguments].concat();
        let finished = run(&all);
        assert_eq!(finished.status, Some(2), "{arguments:?}");
        assert!(
            finished.both().contains(expected),
            "{arguments:?}: {}",
            finished.both()
        );
    }
}

/// Watt's governor: the proved critical value and the one that is followed agree, with the frequency and the first Lyapunov coefficient of the
/// reference (Pontryagin 1962; Sotomayor, Mello and Braga 2007; by harmonic balance of small orbits).
#[test]
fn a_governor_hunts_from_a_hopf_point_on() {
    let path = root().join("gallery/watt-governor/model.toml");
    let range = ["--over", "eps=0.1:1", "--json"];
    let proved = json(&[&["stability", text(&path)], &range[..]].concat());
    let followed = json(&[&["follow", text(&path)], &range[..]].concat());
    let (proved, followed) = (&proved["critical"], &followed["special"]);
    assert_eq!(proved.as_array().unwrap().len(), 1);
    assert_eq!(followed.as_array().unwrap().len(), 1);
    assert_eq!(followed[0]["kind"], "Hopf");
    for own in [&proved[0], &followed[0]] {
        let number = |name: &str| own[name].as_f64().unwrap();
        assert!((number("value") - 0.464_758_001_544_890_03).abs() < 1e-12);
        assert!((number("frequency") - 1.032_795_558_988_644_5).abs() < 1e-12);
        assert!((number("first_lyapunov") + 0.081_153_947_931_242_15).abs() < 1e-10);
    }
    // Below it the motion from the start tends to an orbit, which is found there and attracts.
    let set = ["--set", "eps=0.4", "--orbit", "--json"];
    let orbit = json(&[&["follow", text(&path)], &set[..]].concat());
    assert_eq!(orbit["points"][0]["stability"], "stable");
    assert_eq!(orbit["trivial"][0], "the direction along the orbit");
}

/// Kapitza's pendulum: the exact threshold is a characteristic value of Mathieu's equation (McLachlan 1947), not √(2 g l)/A = 99.0454.
#[test]
fn a_shaken_pendulum_stands_from_a_threshold_on() {
    let path = root().join("gallery/kapitza-pendulum/model.toml");
    let options = [
        "--about",
        "rest",
        "--set",
        "push=0",
        "--orbit",
        "--period",
        "2 pi/Omega",
        "--over",
        "Omega=90:110",
        "--json",
    ];
    let found = json(&[&["follow", text(&path)], &options[..]].concat());
    let special = found["special"].as_array().unwrap();
    assert_eq!(special.len(), 1);
    let at = special[0]["value"].as_f64().unwrap();
    assert!((at - 99.260_834_704_054_84).abs() < 1e-9, "{at}");
}

/// `--sensitivity` writes derivatives: those of a run beside it are near differences.
#[test]
fn sensitivities_are_near_differences() {
    let path = root().join("gallery/chaplygin-sleigh/model.toml");
    let folder = std::env::temp_dir().join(format!("chetaev-sensitivity-{}", std::process::id()));
    let last = |name: &str, set: &str| -> Vec<(String, f64)> {
        let out = folder.join(name);
        let options = [
            "--set",
            set,
            "--t-end",
            "3",
            "--tolerance",
            "1e-13",
            "--sensitivity",
            "a",
        ];
        run(&[
            &["simulate", text(&path), "--out", text(&out)],
            &options[..],
        ]
        .concat());
        let table = std::fs::read_to_string(out.join("sensitivity.csv")).unwrap();
        let mut lines = table.lines();
        let names = lines.next().unwrap().split(',').map(str::to_owned);
        let values = lines.next_back().unwrap().split(',');
        names.zip(values.map(|x| x.parse().unwrap())).collect()
    };
    let (low, middle, high) = (
        last("a", "a=0.24999"),
        last("b", "a=0.25"),
        last("c", "a=0.25001"),
    );
    let at =
        |table: &[(String, f64)], name: &str| table.iter().find(|own| own.0 == name).unwrap().1;
    for name in ["x", "y", "phi", "x'", "phi'"] {
        let difference = (at(&high, name) - at(&low, name)) / 2e-5;
        let derivative = at(&middle, &format!("d {name}/d a"));
        let error = (difference - derivative).abs();
        assert!(
            error < 1e-6 * (1.0 + derivative.abs()),
            "{name}: {difference} {derivative}"
        );
    }
    let _ = std::fs::remove_dir_all(folder);
}

/// The map of the bicycle over speed and trail: at the trail of the benchmark its boundaries are the critical speeds (Meijaard and others 2007).
#[test]
fn a_map_has_the_critical_speeds_as_boundaries() {
    let path = model("whipple-bicycle");
    let picture = std::env::temp_dir().join(format!("chetaev-map-{}.svg", std::process::id()));
    let options = [
        "--over",
        "v=0:10,c=0.02:0.14",
        "--json",
        "--plot",
        text(&picture),
    ];
    let found = json(&[&["stability", text(&path)], &options[..]].concat());
    for (kind, speed) in [
        ("pair", 4.292_382_536_341_104),
        ("zero", 6.024_262_015_388_359),
    ] {
        let curves = found["boundaries"].as_array().unwrap().iter();
        let points = curves.filter(|own| own["kind"] == kind);
        let mut points = points.flat_map(|own| own["points"].as_array().unwrap());
        // The trail 0.08 is a line of the grid.
        let at = |own: &Value, i: usize| own[i].as_f64().unwrap();
        let own = points.find(|own| (at(own, 1) - 0.08).abs() < 1e-12);
        let own = at(own.expect("a place on the line"), 0);
        assert!((own - speed).abs() < 1e-9, "{kind}: {own}");
    }
    assert_eq!(found["growth"].as_array().unwrap().len(), 201);
    // The function that vanishes where the pair passes is a polynomial in both, printed with eight digits.
    let equations = found["equations"].as_array().unwrap().iter();
    let mut weave = equations.filter(|own| own["kind"] == "pair");
    let weave = weave.next().expect("the equation of the weave speed");
    assert_eq!(weave["rounded"], true);
    let function = weave["function"].as_str().unwrap();
    let at = |v: f64| polynomial(function, &[("v", v), ("c", 0.08)]);
    let (value, beside) = (at(4.292_382_536_341_104), at(4.3));
    assert!(
        value.abs() < 1e-3 * beside.abs(),
        "{function}: {value} {beside}"
    );
    let drawn = std::fs::read_to_string(&picture).unwrap();
    assert!(drawn.starts_with("<svg ") && drawn.ends_with("</svg>\n"));
    let _ = std::fs::remove_file(picture);
}

/// The value of `2 v^2 c - 1e-3 c + 5`.
fn polynomial(function: &str, values: &[(&str, f64)]) -> f64 {
    let value = |factor: &str| -> f64 {
        let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
        let known = values.iter().find(|(own, _)| *own == name);
        match known {
            Some((_, value)) => value.powi(power.parse().unwrap()),
            None => factor.parse().unwrap(),
        }
    };
    let terms = function.replace(" - ", " + -");
    let product = |term: &str| term.split(' ').map(value).product::<f64>();
    terms.split(" + ").map(product).sum()
}

/// The figures of the chapter are what the program draws today.
#[test]
fn figures_of_the_chapter_are_those_of_the_program() {
    for (name, command, system, range) in [
        ("bicycle", "stability", "whipple-bicycle", "v=0:10"),
        ("map", "stability", "whipple-bicycle", "v=0:10,c=0.02:0.14"),
        ("governor", "follow", "watt-governor", "eps=0.1:1"),
    ] {
        let path = model(system);
        let shown = root().join(format!("docs/book/stability/{name}.svg"));
        let folder = std::env::temp_dir();
        let drawn = folder.join(format!("chetaev-{name}-{}.svg", std::process::id()));
        let options = ["--over", range, "--plot", text(&drawn)];
        let finished = run(&[&[command, text(&path)], &options[..]].concat());
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        let (now, shown) = (
            std::fs::read_to_string(&drawn),
            std::fs::read_to_string(shown),
        );
        assert_eq!(now.unwrap(), shown.unwrap(), "{name}");
        let _ = std::fs::remove_file(drawn);
    }
}

/// The report of the sleigh has a section on its steady motions, and a figure of their eigenvalues over the speed.
#[test]
fn a_report_has_a_section_on_steady_motions() {
    let path = model("chaplygin-sleigh");
    let folder = std::env::temp_dir().join(format!("chetaev-section-{}", std::process::id()));
    let out = text(&folder);
    let finished = run(&["study", text(&path), "--claims", "stability", "--out", out]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
    let (_, section) = page
        .split_once("Steady motions and stability</h2>")
        .unwrap();
    let section = &section[..section.find("</section>").unwrap()];
    assert!(
        section.contains("Eigenvalues of the motion straight"),
        "{section}"
    );
    assert!(section.contains("data-album=\"0\""), "{section}");
    // The only mode: λ = −m a u/(J + m a²) at u = 1.
    let rate = 1.5 * 0.25 / (0.4 + 1.5 * 0.25 * 0.25);
    assert!(page.contains(&format!("straight: λ = −{rate:.4}")));
    let halved = std::f64::consts::LN_2 / rate;
    assert!(page.contains(&format!("It dies away, by half in {halved:.3}.")));
    let _ = std::fs::remove_dir_all(folder);
}

/// In the root locus of the bicycle a pair comes to the imaginary axis at the speed at which weaving ends.
fn a_locus_crosses_the_axis(data: &Value) {
    let plots = data["plots"].as_array().unwrap();
    let mut planes = plots.iter().filter(|plot| !plot["own"]["plane"].is_null());
    let own = &planes.next().unwrap()["own"];
    assert_eq!(own["name"], "v");
    let numbers = |list: &Value| -> Vec<f64> {
        let list = list.as_array().unwrap().iter();
        list.map(|x| x.as_f64().unwrap()).collect()
    };
    let speeds = numbers(&own["abscissae"]);
    let curves: Vec<Vec<f64>> = own["curves"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| numbers(&c["values"]))
        .collect();
    let step = speeds[1] - speeds[0];
    let crosses = |pair: &[Vec<f64>]| {
        let at = (1..speeds.len())
            .find(|&i| pair[0][i - 1] > 0.0 && pair[0][i] <= 0.0 && pair[1][i] > 1.0);
        at.is_some_and(|i| (speeds[i] - 4.292382536341104).abs() <= step)
    };
    assert_eq!(curves.chunks(2).filter(|pair| crosses(pair)).count(), 1);
}

/// The report of the bicycle has its modes, weave, capsize and castering, and a map over speed and trail, for which the model states a range.
#[test]
fn a_report_plays_modes_and_shows_regions() {
    let path = model("whipple-bicycle");
    let folder = std::env::temp_dir().join(format!("chetaev-modes-{}", std::process::id()));
    let out = text(&folder);
    let options = ["--claims", "steady.stated", "--out", out];
    let finished = run(&[&["study", text(&path)], &options[..]].concat());
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
    let _ = std::fs::remove_dir_all(folder);
    let (_, data) = page.split_once("id=\"data\">").unwrap();
    let data: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    a_locus_crosses_the_axis(&data);
    let modes = data["albums"][0].as_array().unwrap();
    // At 5 m/s (Meijaard and others 2007, table 2).
    let names: Vec<&str> = modes.iter().map(|m| m["name"].as_str().unwrap()).collect();
    let expected = ["−0.3229", "−0.7753 ± 4.4649 i", "−14.0784"];
    assert_eq!(names, expected.map(|l| format!("upright: λ = {l}")));
    for mode in modes {
        let animation = &mode["animation"];
        let frames = animation["times"].as_array().unwrap().len();
        let (strides, elements) = (&animation["strides"], &animation["elements"]);
        for (stride, element) in strides
            .as_array()
            .unwrap()
            .iter()
            .zip(elements.as_array().unwrap())
        {
            let values = element["values"].as_array().unwrap();
            assert_eq!(values.len(), frames * stride.as_u64().unwrap() as usize);
            assert!(values.iter().all(|x| x.is_f64() || x.is_i64()), "{element}");
        }
    }
    let (_, section) = page.split_once("id=\"steady\"").unwrap();
    let section = section.split_once("</section>").unwrap().0;
    for part in [
        "Regions of stability of the motion upright",
        "<polyline",
        "no eigenvalue right of the axis",
    ] {
        assert!(section.contains(part), "{part}");
    }
}

/// A map is the same, bit for bit, for any number of threads.
#[test]
fn a_map_does_not_depend_on_threads() {
    let text = std::fs::read_to_string(model("falling-rolling-disc")).unwrap();
    let loaded = chetaev::model::load("model.toml", &text, &BTreeMap::new(), &[]);
    let loaded = loaded.model.expect("a model");
    let wanted = Wanted {
        about: Some("rolling"),
        over: Some("spin=1:12,r=0.1:0.5"),
        ..Wanted::default()
    };
    let with = |threads: usize| {
        let mut told = Vec::new();
        let tell = &mut |part: f64| told.push(part);
        let course = Course {
            side: 24,
            threads,
            tell,
        };
        let asked = Asked::new(&loaded, &wanted).expect("linear equations");
        assert!(asked.depends_on_both());
        let map = asked.map(course);
        assert!(told.is_sorted() && told.iter().all(|part| (0.0..1.0).contains(part)));
        map
    };
    let (one, many) = (with(1), with(5));
    let bits = |list: &[f64]| list.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&one.growth), bits(&many.growth));
    assert_eq!(one.kinds, many.kinds);
    assert_eq!(one.curves, many.curves);
    // A thin disc rolls upright where spin² > g/(3 r) (Routh 1905).
    assert!(!one.curves.is_empty());
    for &(spin, radius) in one.curves.iter().flat_map(|own| &own.points) {
        assert!(
            (spin * spin - 9.81 / (3.0 * radius)).abs() < 1e-5,
            "{spin} {radius}"
        );
    }
}

/// What is undecided has a witness: two oscillators whose energies have opposite signs swing on as they began, cos 40 and cos 40 √2 after 40 of their
/// times, but for 10⁻⁴ parts by the term of third order, without which the equations are linear themselves and decided.
#[test]
fn what_is_undecided_has_a_witness() {
    let folder = std::env::temp_dir().join(format!("chetaev-witness-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("model.toml");
    let model = r#"
name = "oscillators"
coordinates = ["x", "y"]
[lagrangian]
L = "1/2 (x'^2 - x^2) - 1/2 (y'^2 - 2 y^2) - x^2 y"
[steady.rest]
x = 0
y = 0
"x'" = 0
"y'" = 0
"#;
    // Where the place is guessed, the runs begin beside the motion that was found, not beside the guess.
    let guessed = model.replace("x = 0\ny = 0", "x = { guess = 0.3 }\ny = { guess = 0.2 }");
    let out = text(&folder);
    for model in [model, &guessed] {
        std::fs::write(&path, model).unwrap();
        let options = ["--claims", "stability.nonlinear", "--json", "--out", out];
        let found = json(&[&["study", text(&path)], &options[..]].concat());
        let mut all = found["verdicts"].as_array().unwrap().iter();
        let own = all.find(|v| v["claim"] == "stability.nonlinear").unwrap();
        assert_eq!(own["verdict"], "undecided");
        let detail = own["detail"].as_str().unwrap();
        for part in [
            "a numerical witness: of 8 motions",
            "the farthest is 1.00e-4 away in y",
            "at t = 40.000",
            "1 times as far",
        ] {
            assert!(detail.contains(part), "{detail}");
        }
    }
    let _ = std::fs::remove_dir_all(&folder);
}

/// A model in a folder of its own.
fn scratch(name: &str, model: &str) -> PathBuf {
    let folder = format!("chetaev-stability-{name}-{}", std::process::id());
    let folder = std::env::temp_dir().join(folder);
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("model.toml");
    std::fs::write(&path, model).unwrap();
    path
}

/// `--at` puts in values of controls and of the parameters of families: x'' = −u x rests at 0 with λ² = −u, and of the sleigh on its line, number 1 of
/// its steady motions, λ = −m a u/(J + m a²) with m = 1.5, a = 0.25, J = 0.4.
#[test]
fn values_are_put_in_by_at() {
    let path = scratch(
        "at",
        "name = \"at\"\ncoordinates = [\"x\"]\n[controls]\nu = {}\n[lagrangian]\nT = \"1/2 x'^2\"\n[forces]\nx = \"-u x\"\n[steady.rest]\nx = 0\n\"x'\" = 0\n",
    );
    let eigenvalues = |arguments: &[&str]| -> Vec<(f64, f64)> {
        let found = json(arguments);
        let all = found["eigenvalues"].as_array().unwrap().clone();
        let number = |own: &Value, at: usize| own[at].as_f64().unwrap();
        all.iter()
            .map(|own| (number(own, 0), number(own, 1)))
            .collect()
    };
    for (value, frequency) in [("u=4", 2.0), ("u=9/4", 1.5)] {
        let found = eigenvalues(&["linearize", text(&path), "--at", value, "--json"]);
        let mut parts: Vec<f64> = found.iter().map(|own| own.1).collect();
        parts.sort_by(f64::total_cmp);
        assert_eq!(parts, [-frequency, frequency], "{value}");
        assert!(found.iter().all(|own| own.0 == 0.0), "{value}");
    }
    let found = eigenvalues(&["linearize", text(&path), "--json"]);
    assert_eq!(found, [(0.0, 0.0), (0.0, 0.0)]);
    let _ = std::fs::remove_dir_all(path.parent().unwrap());
    let sleigh = model("chaplygin-sleigh");
    let all = [
        "linearize",
        text(&sleigh),
        "--about",
        "1",
        "--at",
        "u_0=2",
        "--json",
    ];
    let found = eigenvalues(&all);
    let fastest = found.iter().map(|own| own.0).fold(0.0, f64::min);
    assert!((fastest + 0.75 / 0.493_75).abs() < 1e-14, "{found:?}");
    let unknown = run(&["linearize", text(&sleigh), "--about", "1", "--at", "q=2"]);
    assert!(
        unknown.both().contains("`q` is neither a control nor"),
        "{}",
        unknown.both()
    );
}

/// Two oscillators, of which the force reaches one and the output shows the other: both are named by their eigenvalues ± i and ± 2 i.
#[test]
fn modes_that_are_not_reached_or_not_seen_are_named() {
    let path = scratch(
        "modes",
        "name = \"modes\"\ncoordinates = [\"x\", \"y\"]\n[controls]\nu = {}\n[lagrangian]\nL = \"1/2 (x'^2 + y'^2) - 1/2 x^2 - 2 y^2\"\n[forces]\nx = \"u\"\n[steady.rest]\nx = 0\ny = 0\n\"x'\" = 0\n\"y'\" = 0\n",
    );
    let found = run(&["linearize", text(&path), "--outputs", "y"]).out;
    for line in [
        "The inputs reach 2 of 4 dimensions, the outputs show 2",
        "  the modes with the eigenvalues 0.000000+2.000000i are not reached",
        "  the modes with the eigenvalues 0.000000+1.000000i are not seen",
    ] {
        assert!(found.contains(line), "{line}: {found}");
    }
    let found = run(&["linearize", text(&path), "--outputs", "x,y"]).out;
    assert!(!found.contains("not seen"), "{found}");
    let _ = std::fs::remove_dir_all(path.parent().unwrap());
}

/// Coordinates that run on say in which frame the eigenvalues are.
#[test]
fn the_turning_frame_is_said() {
    let top = run(&["linearize", text(&model("heavy-top"))]).out;
    assert!(
        top.contains("Running on uniformly: phi' = 1/2, psi' = 101/20; "),
        "{top}"
    );
    assert!(
        top.contains("in axes that turn otherwise they may be others"),
        "{top}"
    );
    // On a circle the heading runs on uniformly, and the place does not.
    let disc = scratch(
        "circle",
        "name = \"disc\"\ncoordinates = [\"x\", \"y\", \"phi\"]\n[lagrangian]\nT = \"1/2 (x'^2 + y'^2 + phi'^2)\"\n[constraints]\nblade = \"y' cos(phi) = x' sin(phi)\"\n[steady.circle]\nphi = 0\n\"x'\" = 2\n\"phi'\" = 1\n",
    );
    let circle = run(&["linearize", text(&disc)]).out;
    assert!(
        circle.contains("Running on uniformly: phi' = 1; "),
        "{circle}"
    );
    let _ = std::fs::remove_dir_all(disc.parent().unwrap());
    let pendulum = run(&[
        "linearize",
        text(&model("double-pendulum")),
        "--about",
        "hanging",
    ])
    .out;
    assert!(!pendulum.contains("Running on"), "{pendulum}");
}

/// Chaplygin's sleigh from v = −1.2 with ω = 0.7: it turns round and ends at the speed √(v² + (J + m a²) ω²/m), having turned by 5.30843522512963335 (closed
/// form of Chaplygin 1911, and by a Taylor series with 40 digits).
#[test]
fn the_sleigh_turns_round() {
    let path = scratch(
        "sleigh",
        r#"
name = "sleigh"
coordinates = ["x", "y", "phi"]
parameters = { m = 2, J = 0.3, a = 0.25 }
[lagrangian]
T = "1/2 m ((x' - a phi' sin(phi))^2 + (y' + a phi' cos(phi))^2) + 1/2 J phi'^2"
[constraints]
blade = "y' cos(phi) = x' sin(phi)"
[initial]
x = 0
y = 0
phi = 0
"x'" = -1.2
"phi'" = 0.7
[simulation]
t_end = 40
tolerance = 1e-13
"#,
    );
    let folder = path.parent().unwrap();
    let finished = run(&["simulate", text(&path), "--out", text(folder)]);
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let table = std::fs::read_to_string(folder.join("trajectory.csv")).unwrap();
    let names: Vec<&str> = table
        .lines()
        .find(|l| l.starts_with("t,"))
        .unwrap()
        .split(',')
        .collect();
    let last: Vec<f64> = table
        .lines()
        .last()
        .unwrap()
        .split(',')
        .map(|x| x.parse().unwrap())
        .collect();
    let at = |name: &str| last[names.iter().position(|own| *own == name).unwrap()];
    let forward = at("x'") * at("phi").cos() + at("y'") * at("phi").sin();
    assert!((forward - 1.242_628_262_997_426).abs() < 1e-10, "{forward}");
    assert!(
        (at("phi") - 5.308_435_225_129_633).abs() < 1e-9,
        "{}",
        at("phi")
    );
    let _ = std::fs::remove_dir_all(folder);
}

/// The trailer that drives ahead keeps a yaw rate, so that its heading leaves: refuted by the drift along its family.
#[test]
fn a_trailer_drifts_from_its_heading() {
    let path = model("trailer");
    let folder = std::env::temp_dir().join(format!("chetaev-drift-{}", std::process::id()));
    let out = text(&folder);
    let options = ["--claims", "stability.nonlinear", "--json", "--out", out];
    let found = json(&[&["study", text(&path)], &options[..]].concat());
    let _ = std::fs::remove_dir_all(&folder);
    let mut all = found["verdicts"].as_array().unwrap().iter();
    let own = all.find(|v| v["claim"] == "stability.nonlinear").unwrap();
    assert_eq!(own["verdict"], "refuted");
    let detail = own["detail"].as_str().unwrap();
    assert!(detail.contains("drifts along its family"), "{detail}");
}
