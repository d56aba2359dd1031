//! Where faces meet: what conditions of two faces say together holds there, and not along either of them; and conditions there count where
//! something is said not to follow.

use crate::table::{decided, read_text, studied_text};
use chetaev_model::Style;

/// Scalars on a box, `on: equation` on a face or where two meet.
struct Model<'a> {
    density: &'a str,
    /// Variables of the unit box.
    variables: &'a [&'a str],
    fields: &'a [&'a str],
    data: &'a [&'a str],
    faces: &'a [(&'a str, &'a str)],
    imposed: &'a [&'a str],
    stated: &'a [&'a str],
}

impl Model<'_> {
    fn text(&self) -> String {
        let scalars = |all: &[&str]| -> String {
            all.iter()
                .map(|own| format!("{own} = \"scalar\"\n"))
                .collect()
        };
        let held = self.fields.iter().map(|own| format!("\"{own}\""));
        let held = format!("{{ fixed = [{}] }}", held.collect::<Vec<_>>().join(", "));
        let faces = self
            .variables
            .iter()
            .flat_map(|own| [0, 1].map(|end| format!("{own} = {end}")));
        let faces = faces.map(|face| {
            let own = self.faces.iter().find(|(name, _)| *name == face);
            let own = own.map_or(held.clone(), |(_, density)| format!("\"{density}\""));
            format!("\"{face}\" = {own}\n")
        });
        let equation = |(label, text): (String, &&str)| match text.split_once(": ") {
            Some((on, text)) => format!("{label} = {{ equation = \"{text}\", on = \"{on}\" }}\n"),
            None => format!("{label} = \"{text}\"\n"),
        };
        let labelled = |mark: &str, all: &[&str]| -> Vec<String> {
            (0..all.len()).map(|k| format!("{mark}{k}")).collect()
        };
        let all = [("i", self.imposed), ("s", self.stated)];
        let equations = all.iter().flat_map(|(mark, all)| {
            let own = labelled(mark, all).into_iter().zip(all.iter());
            own.map(equation).collect::<Vec<_>>()
        });
        let quoted = |mark: &str, all: &[&str]| -> String {
            let own = labelled(mark, all).into_iter();
            own.map(|own| format!("\"{own}\""))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let names: Vec<String> = self
            .variables
            .iter()
            .map(|own| format!("\"{own}\""))
            .collect();
        let intervals: Vec<String> = self
            .variables
            .iter()
            .map(|own| format!("{own} = [0, 1]"))
            .collect();
        format!(
            "kind = \"functional\"\nname = \"strata\"\ndensity = \"{}\"\nyields = [{}]\nimposed = [{}]\n[domain]\n\
             coordinates = [{}]\nintervals = {{ {} }}\n[fields]\n{}[data]\n{}[boundary]\n{}[equations]\n{}",
            self.density,
            quoted("s", self.stated),
            quoted("i", self.imposed),
            names.join(", "),
            intervals.join(", "),
            scalars(self.fields),
            scalars(self.data),
            faces.collect::<String>(),
            equations.collect::<String>(),
        )
    }

    fn euler(&self) -> (&'static str, String) {
        let study = studied_text("p4p", &self.text(), &[]);
        let own = decided(&study, "functional.euler");
        (own.word(), own.detail().to_owned())
    }
}

const LOADED: Model<'_> = Model {
    density: "v,i v,i/2 + w,i w,i/2 - p v - q w",
    variables: &["x", "y"],
    fields: &["v", "w"],
    data: &["p", "q"],
    faces: &[],
    imposed: &[],
    stated: &[],
};

const BODY: [&str; 2] = ["v,ii + p = 0", "w,ii + q = 0"];

/// v = w on one face and v = 2 w on another make v and w zero at the corner, and not along the faces: v = 4 x + 3 y − 3 and
/// w = 2 x + 3 y − 3 satisfy both, without loads, and their slopes are not zero there.
#[test]
fn conditions_of_two_faces_are_not_differentiated_along_one() {
    let (v, w) = (
        |x: i64, y: i64| 4 * x + 3 * y - 3,
        |x: i64, y: i64| 2 * x + 3 * y - 3,
    );
    for k in -3..4 {
        assert_eq!(v(0, k), w(0, k));
        assert_eq!(v(k, 1), 2 * w(k, 1));
    }
    assert_eq!((v(0, 1), w(0, 1), w(1, 1) - w(0, 1)), (0, 0, 2));
    let meet = |corner: &str| {
        let stated = [BODY[0], BODY[1], corner];
        Model {
            imposed: &["x = 0: v = w", "y = 1: v = 2 w"],
            stated: &stated,
            ..LOADED
        }
        .euler()
    };
    for slope in ["v,x", "v,y", "w,x", "w,y"] {
        let (word, detail) = meet(&format!("x = 0, y = 1: {slope} = 0"));
        assert_eq!(word, "refuted", "{slope}: {detail}");
    }
    // What both say at the corner, and what each says along its own face.
    for holds in ["v = 0", "w = 0", "v,y = w,y", "v,x = 2 w,x"] {
        let (word, detail) = meet(&format!("x = 0, y = 1: {holds}"));
        assert_eq!(word, "proved", "{holds}: {detail}");
    }
}

/// The same where a coefficient vanishes on the other face only: v = y w on x = 0, and v = x w on y = 1, where u = 0 follows at the corner.
#[test]
fn a_variable_has_the_value_of_a_face_on_that_face_only() {
    let stated = [BODY[0], BODY[1], "x = 0, y = 0: v,y = 0"];
    let (word, detail) = Model {
        imposed: &["x = 0: v = y w", "y = 0: w = 1 + x"],
        stated: &stated,
        ..LOADED
    }
    .euler();
    // v,y = w + y w,y is w = 1 at the corner.
    assert_ne!(word, "proved", "{detail}");
    let stated = [BODY[0], BODY[1], "x = 0, y = 0: v,y = 1"];
    let (word, detail) = Model {
        imposed: &["x = 0: v = y w", "y = 0: w = 1 + x"],
        stated: &stated,
        ..LOADED
    }
    .euler();
    assert_eq!(word, "proved", "{detail}");
}

/// At an edge in space conditions may be differentiated along the edge, and in no other direction.
#[test]
fn what_holds_at_an_edge_is_differentiated_along_it() {
    let meet = |edge: &str, imposed: &[&str]| {
        let stated = [BODY[0], BODY[1], edge];
        let model = Model {
            variables: &["x", "y", "z"],
            imposed,
            stated: &stated,
            ..LOADED
        };
        model.euler()
    };
    let faces = ["x = 0: v = w", "y = 1: v = 2 w"];
    for (edge, word) in [
        ("w,z = 0", "proved"),
        ("w,x = 0", "refuted"),
        ("w,y = 0", "refuted"),
    ] {
        let (found, detail) = meet(&format!("x = 0, y = 1: {edge}"), &faces);
        assert_eq!(found, word, "{edge}: {detail}");
    }
    let (word, detail) = meet("x = 0, y = 1: v,z = 1", &["x = 0, y = 1: v = z"]);
    assert_eq!(word, "proved", "{detail}");
}

/// Natural conditions of two faces and no condition at their corner: the functional has one, w,x = 0, which is not stated.
#[test]
fn a_natural_condition_at_a_corner_is_missed() {
    let (word, detail) = Model {
        density: "-p v - q w + v,x^2 - v,x w,x + v,y^2 + v,y w,x + w,x^2/2 + w,y^2/2",
        faces: &[("x = 0", "v^2/2"), ("y = 1", "-w,x^2/2")],
        stated: &[
            "-q + v,xx - v,xy - w,xx - w,yy = 0",
            "-p - 2 v,xx - 2 v,yy + w,xx - w,xy = 0",
            "x = 0: v,x - v,y - w,x = 0",
            "x = 0: v - 2 v,x + w,x = 0",
            "y = 1: w,xx + w,y = 0",
            "y = 1: 2 v,y + w,x = 0",
        ],
        ..LOADED
    }
    .euler();
    assert_eq!(word, "refuted", "{detail}");
    assert!(detail.contains("meet"), "{detail}");
}

/// ∇u = 0 leaves a constant, which a condition at one corner or edge makes zero. No jet at another place refutes that u vanishes.
#[test]
fn a_condition_at_a_corner_counts_elsewhere() {
    let constant = |variables: &[&str], corner: &str| {
        let is_plane = variables.len() == 2;
        let (density, fields, equations): (_, &[&str], &[&str]) = if is_plane {
            (
                "v u,x + w u,y",
                &["u", "v", "w"],
                &["u,x = 0", "u,y = 0", "v,x + w,y = 0"],
            )
        } else {
            (
                "v u,x + w u,y + s u,z",
                &["u", "v", "w", "s"],
                &["u,x = 0", "u,y = 0", "u,z = 0", "v,x + w,y + s,z = 0"],
            )
        };
        let verdict = |more: &str| {
            let stated = [equations, &[more]].concat();
            Model {
                density,
                variables,
                fields,
                data: &[],
                faces: &[],
                imposed: &[corner],
                stated: &stated,
            }
            .euler()
        };
        let (word, detail) = verdict("u = 0");
        assert_ne!(word, "refuted", "{detail}");
        for on in ["y = 0", "x = 1"] {
            let (word, detail) = verdict(&format!("{on}: u = 0"));
            assert_ne!(word, "refuted", "{on}: {detail}");
        }
    };
    constant(&["x", "y"], "x = 0, y = 0: u = 0");
    constant(&["x", "y", "z"], "x = 0, y = 0: u = 0");
    // Without it any constant is one.
    let stated = ["u,x = 0", "u,y = 0", "v,x + w,y = 0", "u = 0"];
    let (word, detail) = Model {
        density: "v u,x + w u,y",
        fields: &["u", "v", "w"],
        data: &[],
        stated: &stated,
        ..LOADED
    }
    .euler();
    assert_eq!(word, "refuted", "{detail}");
}

/// Where three faces meet two values exclude each other, a value that is imposed there makes another false, and a slope need not vanish: v = 5 + 2 x
/// + 3 y + 4 z without load has the value 5 and the slope 2 there.
#[test]
fn conditions_where_three_faces_meet_are_looked_at() {
    let corner = |imposed: &[&str], stated: &[&str]| {
        let stated: Vec<&str> = std::iter::once("v,ii + p = 0")
            .chain(stated.iter().copied())
            .collect();
        let own = Model {
            density: "v,i v,i/2 - p v",
            variables: &["x", "y", "z"],
            fields: &["v"],
            data: &["p"],
            imposed,
            stated: &stated,
            ..LOADED
        };
        own.euler()
    };
    let at = "x = 0, y = 0, z = 0";
    for own in ["v = 0", "v,x = 0", "v = 5"] {
        let (word, detail) = corner(&[], &[&format!("{at}: {own}")]);
        assert_eq!(word, "refuted", "{own}: {detail}");
    }
    // In any order of the faces.
    let turned = "z = 0, x = 0, y = 0";
    let imposed = format!("{at}: v = 5");
    for (own, expected) in [
        ("v = 4", "refuted"),
        ("v = 5", "proved"),
        ("2 v = 10", "proved"),
    ] {
        let (word, detail) = corner(&[&imposed], &[&format!("{turned}: {own}")]);
        assert_eq!(word, expected, "{own}: {detail}");
    }
    // What is imposed along an edge holds where it ends.
    let edge = "x = 0, y = 0: v = z";
    for (own, expected) in [("v = 0", "proved"), ("v = 1", "refuted")] {
        let (word, detail) = corner(&[edge], &[&format!("{at}: {own}")]);
        assert_eq!(word, expected, "{own}: {detail}");
    }
}

/// Faces that do not meet, a face named twice, and three faces in a plane are mistakes.
#[test]
fn places_that_are_none_are_refused() {
    for (variables, on) in [
        (&["x", "y"][..], "x = 0, x = 1"),
        (&["x", "y"], "x = 0, x = 1, y = 0"),
        (&["x", "y"], "x = 0, x = 0"),
        (&["x"], "x = 0, x = 1"),
    ] {
        let stated = format!("{on}: v = 0");
        let own = Model {
            density: "v,x v,x/2",
            variables,
            fields: &["v"],
            data: &[],
            stated: &[&stated],
            ..LOADED
        };
        let said = read_text("p4p", &own.text(), &[])
            .diagnostics
            .render(Style::Plain);
        assert!(said.contains("no-meeting"), "{on}: {said}");
    }
}
