//! Whatever the text, reading ends with a model or with a diagnostic, never with a panic.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_model::{load, reload, ModelBuilder, NoFiles, Severity, Style};

const SEEDS: [&str; 5] = [
    include_str!("../../../../gallery/chaplygin-sleigh/model.toml"),
    r#"
coordinates = ["x", "theta_{i}"]
assumptions = ["0 < theta_1 < pi", "m > 0"]
[sizes]
n = 3
[indices]
i = "1..n"
[parameters]
"l_{i}" = { value = "1/i", range = [0, 2] }
m = 0.5e-1
[define]
"p_{i}" = "x + sum(j = 1..i, l_{j} sin(theta_{j}))"
[lagrangian]
T = "1/2 m sum(i = 1..n, p_{i}'^2)"
[constraints]
"axle_{i}" = "theta_{i}' = i x'"
[expect]
stop = { at = 1, reason = "rank" }
"#,
    r#"
[coordinates]
theta = { unit = "rad", description = "θ" }
[parameters]
l = { value = 25, unit = "cm", range = [10, 50] }
g = { value = 9.81, unit = "m/s^2" }
[controls]
u = { value = "sin(3 t)", unit = "1" }
[lagrangian]
L = "l^2 theta'^2/2 + g l cos(θ) + l^2 u'^2"
[forces]
rayleigh = "theta'^2"
[simulation]
t_end = "2 pi sqrt(l/g)"
output = { times = [0, 1] }
[drawing]
view = "space"
[[drawing.element]]
kind = "wheel"
center = ["l", 0, 0]
axis = [0, 0, 1]
radius = "l"
angle = "theta"
"#,
    r#"
coordinates = ["x", "theta_{i}"]
parameters = { m = 1, l = 2, g = 9.81 }
[sizes]
n = 2
[indices]
i = "1..n"
[lagrangian]
V = "x^2"
[particles.cart]
mass = 3
position = ["x"]
[particles."link_{i}"]
mass = "m/i"
position = ["x + sum(j = 1..i, l sin(theta_{j}))", "-sum(j = 1..i, l cos(theta_{j}))"]
force = [0, "-m g/i"]
description = "a link"
"#,
    r#"
[coordinates]
x = "m"
y = "m"
phi = "rad"
[parameters]
R = { value = 2, unit = "m" }
Omega = { value = 1, unit = "1/s" }
[define]
c = "cos(phi)"
twice = "2 u"
[lagrangian]
T = "x'^2 + y'^2 + R^2 phi'^2 + u twice"
[moving_frame]
drift = { x = "Omega y", y = "-Omega x" }
[moving_frame.fields]
u = { x = "c", y = "sin(phi)" }
w = { phi = 1, x = "R t Omega" }
s = { x = "-sin(phi)", y = "c" }
"#,
];

/// xorshift (Marsaglia 2003).
fn next(state: &mut u64) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state as usize
}

/// One random change: a sign deleted, inserted or replaced, a line dropped or doubled, a piece moved.
fn mutate(text: &str, state: &mut u64) -> String {
    const SIGNS: &[char] = &[
        '"', '\'', '[', ']', '{', '}', '=', '.', ',', '#', '(', ')', '+', '*', '^', '/', '-', '<',
        '_', ' ', '\n', 'x', 't', '0', '9', 'θ', '″', '☃',
    ];
    let mut signs: Vec<char> = text.chars().collect();
    let length = signs.len().max(1);
    let at = next(state) % length;
    match next(state) % 7 {
        0 if !signs.is_empty() => drop(signs.remove(at)),
        1 => signs.insert(at.min(signs.len()), SIGNS[next(state) % SIGNS.len()]),
        2 if at < signs.len() => signs[at] = SIGNS[next(state) % SIGNS.len()],
        3 | 4 => {
            let mut lines: Vec<&str> = text.lines().collect();
            let line = next(state) % lines.len().max(1);
            if line < lines.len() {
                if next(state).is_multiple_of(2) {
                    lines.remove(line);
                } else {
                    lines.insert(line, lines[line]);
                }
            }
            return lines.join("\n");
        }
        5 => {
            let end = (at + next(state) % 30).min(signs.len());
            let piece: Vec<char> = signs.drain(at.min(end)..end).collect();
            let to = next(state) % (signs.len() + 1);
            signs.splice(to..to, piece);
        }
        _ => signs.truncate(at),
    }
    signs.into_iter().collect()
}

#[test]
fn a_thousand_mutated_models_give_diagnostics_and_no_panic() {
    let mut state = 0x2545_f491_4f6c_dd1d;
    let mut refused = 0;
    for round in 0..2500 {
        let mut text = SEEDS[round % SEEDS.len()].to_owned();
        for _ in 0..=next(&mut state) % 4 {
            text = mutate(&text, &mut state);
        }
        let loaded = load("model.toml", &text, &NoFiles, &[]);
        let errors = loaded
            .diagnostics
            .list
            .iter()
            .filter(|d| d.severity == Severity::Error)
            .count();
        assert_eq!(loaded.model.is_none(), errors > 0, "{text}");
        for (data, style) in loaded
            .diagnostics
            .to_data()
            .iter()
            .zip([Style::Plain, Style::Ansi].into_iter().cycle())
        {
            assert!(data.at.line >= 1 && data.at.column >= 1);
            assert!(!loaded.diagnostics.render(style).is_empty());
        }
        refused += usize::from(loaded.model.is_none());
    }
    assert!(refused > 800, "the mutations do harm: {refused}");
}

#[test]
fn deep_nesting_is_read_or_refused() {
    let depth = 100_000;
    let nested = format!(
        "coordinates = [\"x\"]\nlagrangian = \"{}x'{}^2\"",
        "(".repeat(depth),
        ")".repeat(depth)
    );
    assert!(load("m", &nested, &NoFiles, &[]).model.is_some());
    let arrays = format!("coordinates = {}{}", "[".repeat(depth), "]".repeat(depth));
    assert!(load("m", &arrays, &NoFiles, &[]).model.is_none());
    let tables = format!("[{}a]", "a.".repeat(20_000));
    assert!(load("m", &tables, &NoFiles, &[]).model.is_none());
}

#[test]
fn long_chains_of_definitions_are_no_obstacle() {
    let mut text = "coordinates = [\"x\"]\n[define]\n".to_owned();
    for i in 0..3000 {
        text += &format!("d_{i} = \"d_{} + x\"\n", i + 1);
    }
    text += "d_3000 = \"x'^2\"\n[lagrangian]\nL = \"d_0\"\n";
    let model = load("m", &text, &NoFiles, &[])
        .model
        .expect("the chain ends");
    let g = &model.graph;
    assert_eq!(
        model.lagrangian,
        g.add(&[
            g.powi(model.jet(0, 1), 2),
            g.mul(&[g.integer(3000), model.jet(0, 0)])
        ])
    );
}

#[test]
fn the_builder_says_the_same_as_the_file() {
    let builder = ModelBuilder::new("pendulum")
        .description("a pendulum")
        .source("Galileo")
        .coordinate("theta", "rad")
        .parameter_with_unit("l", "0.5", "m")
        .parameter_with_unit("g", "9.81", "m/s^2")
        .assumption("l > 0")
        .define("s", "sin(theta)")
        .kinetic("1/2 l^2 theta'^2")
        .potential("-g l cos(theta)")
        .force("theta", "-1/10*l^2*theta'/t")
        .initial("theta'", "1")
        .end("2*pi*sqrt(l/g)")
        .simulation("tolerance", "1e-10")
        .integral("energy", "theta'^2/2 - g/l*cos(theta)")
        .expect("formulation.equivalent#maggi", "proved")
        .draw(
            "segment",
            &[
                ("from", "[0, 0]"),
                ("to", "[\"l*s\", \"-l*cos(theta)\"]"),
                ("color", "blue"),
            ],
        );
    let (model, diagnostics) = builder
        .build()
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    assert!(diagnostics.list.is_empty(), "{diagnostics}");
    let (again, _) = reload(&model.text)
        .into_result()
        .expect("the kept text is the model");
    assert_eq!(model.name, "pendulum");
    assert_eq!(
        again.graph.digest(again.lagrangian),
        model.graph.digest(model.lagrangian)
    );
    assert_eq!(again.drawing.map(|d| d.elements.len()), Some(1));
    let particles = ModelBuilder::new("particles")
        .coordinates(["x", "y"])
        .parameter("m", "2")
        .particle("a", "m", ["x", "2 y"])
        .particle_force("a", ["u", "0"])
        .frame_field("u", &[("x", "1"), ("y", "1")])
        .frame_field("w", &[("y", "x")])
        .frame_drift(&[("x", "t")])
        .build();
    let (particles, _) = particles
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    let g = &particles.graph;
    let u = g.sub(particles.jet(0, 1), particles.time);
    assert_eq!(particles.particles[0].force, [u, g.zero()]);
    assert_eq!(particles.quasi_velocities[0].value, u);
    let wrong = ModelBuilder::new("wrong")
        .coordinates(["x"])
        .lagrangian("x'^2 + y")
        .build();
    assert!(wrong.diagnostics.to_string().contains("unknown name `y`"));
}

#[test]
fn diagnostics_as_data_have_lines_and_columns() {
    let text = "coordinates = [\"θ\"]\nlagrangian = \"θ'^2 + thta\"\n";
    let data = load("model.toml", text, &NoFiles, &[])
        .diagnostics
        .to_data();
    assert_eq!(data.len(), 1);
    assert_eq!(
        (data[0].at.line, data[0].at.column, data[0].at.end_column),
        (2, 22, 26)
    );
    assert_eq!(data[0].at.text, "thta");
    assert_eq!(
        data[0].suggestion.as_ref().map(|s| s.replacement.as_str()),
        Some("theta")
    );
}
