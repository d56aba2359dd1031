//! Two functionals beside each other: special values reach derivatives, and what is imposed or given on the boundary belongs to both.

use crate::half_known::studied;
use crate::table::decided;

/// A functional on 0 < x < 1.
#[derive(Clone, Copy)]
struct Text<'a> {
    density: &'a str,
    fields: &'a [&'a str],
    ends: [&'a str; 2],
    imposed: &'a str,
    equations: &'a str,
    more: &'a str,
}

const FREE: &str = "\"0\"";

impl<'a> Text<'a> {
    fn of(density: &'a str, fields: &'a [&'a str]) -> Text<'a> {
        Text {
            density,
            fields,
            ends: [FREE; 2],
            imposed: "",
            equations: "",
            more: "",
        }
    }

    fn written(&self, name: &str) -> String {
        let fields: Vec<String> = self
            .fields
            .iter()
            .map(|f| format!("{f} = \"scalar\"\n"))
            .collect();
        format!(
            "kind = \"functional\"\nname = \"{name}\"\ndensity = \"{}\"\nimposed = [{}]\n[domain]\ncoordinates = [\"x\"]\nintervals = {{ x = [0, 1] }}\n\
             [data]\nf = \"scalar\"\n[fields]\n{}[boundary]\n\"x = 0\" = {}\n\"x = 1\" = {}\n[equations]\n{}\n{}",
            self.density,
            self.imposed,
            fields.concat(),
            self.ends[0],
            self.ends[1],
            self.equations,
            self.more
        )
    }
}

#[track_caller]
fn related(claim: &str, own: Text<'_>, other: Text<'_>, (word, part): (&str, &str)) {
    let study = studied(&own.written("own"), &other.written("other"));
    let verdict = decided(&study, claim);
    assert_eq!(verdict.word(), word, "{}", verdict.detail());
    assert!(verdict.detail().contains(part), "{}", verdict.detail());
}

#[track_caller]
fn becomes(at: &str, own: Text<'_>, other: Text<'_>, expected: (&str, &str)) {
    let more = format!("[degenerations.it]\nbecomes = \"other.toml\"\nat = {{ {at} }}\n");
    let own = Text { more: &more, ..own };
    related("functional.degeneration", own, other, expected);
}

#[track_caller]
fn descends(imposing: &str, own: Text<'_>, other: Text<'_>, expected: (&str, &str)) {
    let more = format!("[descent]\nfrom = \"other.toml\"\nimposing = [{imposing}]\n");
    let own = Text { more: &more, ..own };
    related("functional.descent", own, other, expected);
}

#[test]
fn what_stands_for_a_field_stands_in_its_derivatives() {
    let own = Text::of("1/2 s,x^2 + s u + u,x^2", &["s", "u"]);
    let of_u = |density| Text::of(density, &["u"]);
    becomes("s = \"0\"", own, of_u("u,x^2"), ("proved", ""));
    let wrong = Text::of("1/2 s,x^2 + u,x^2", &["s", "u"]);
    becomes("s = \"0\"", own, wrong, ("refuted", ""));
    becomes("s = \"u\"", own, of_u("3/2 u,x^2 + u^2"), ("proved", ""));
    let second = Text::of("1/2 s,xx^2 + u,x^2", &["s", "u"]);
    becomes(
        "s = \"x u\"",
        second,
        of_u("1/2 (2 u,x + x u,xx)^2 + u,x^2"),
        ("proved", ""),
    );
}

/// Timoshenko's beam without shear is Euler's and Bernoulli's: where the angle is given, the slope is.
#[test]
fn what_is_given_of_a_field_is_given_of_what_stands_for_it() {
    let beam = Text::of("1/2 psi,x^2 + 1/2 (w,x + psi)^2 - f w", &["w", "psi"]);
    let slender = Text::of("1/2 w,xx^2 - f w", &["w"]);
    let at = "psi = \"-w,x\"";
    becomes(at, beam, slender, ("proved", ""));
    let clamped = Text {
        ends: ["{ fixed = [\"w\", \"psi\"] }", FREE],
        ..beam
    };
    let held = |ends| Text { ends, ..slender };
    becomes(
        at,
        clamped,
        held(["{ fixed = [\"w\", \"w,n\"] }", FREE]),
        ("proved", ""),
    );
    becomes(
        at,
        clamped,
        held(["{ fixed = [\"w\"] }", FREE]),
        ("refuted", "is given in own, and not in other"),
    );
    let supported = Text {
        ends: ["{ fixed = [\"w\"] }", FREE],
        ..beam
    };
    becomes(
        at,
        supported,
        held(["{ fixed = [\"w\", \"w,n\"] }", FREE]),
        ("refuted", "is given in other, and not in own"),
    );
}

#[test]
fn what_is_imposed_on_one_is_imposed_on_the_other() {
    let free = Text::of("1/2 u,x^2 + 1/2 v,x^2 - f u", &["u", "v"]);
    let stiff = Text {
        imposed: "\"q\"",
        equations: "q = \"v,x = 0\"",
        ..Text::of("1/2 u,x^2 - f u", &["u", "v"])
    };
    let all = Text {
        imposed: "\"q\"",
        equations: "q = \"v,x = 0\"",
        ..free
    };
    becomes("", all, stiff, ("proved", "modulo (q)"));
    becomes("", free, stiff, ("refuted", "(q) is imposed in other"));
    let unheld = Text::of("1/2 u,x^2 - f u", &["u", "v"]);
    becomes("", all, unheld, ("refuted", "(q) is imposed in own"));
    // What determines a field that is not there any more is no other variation.
    let two = Text {
        imposed: "\"h\"",
        equations: "h = \"s = u,x\"",
        ..Text::of("s u,x - 1/2 s^2", &["s", "u"])
    };
    becomes(
        "",
        two,
        Text::of("1/2 u,x^2", &["u"]),
        ("proved", "modulo (h)"),
    );
    // The same in other words.
    let twice = Text {
        equations: "q = \"2 v,x = 0\"",
        ..stiff
    };
    becomes("", all, twice, ("proved", "modulo (q)"));
}

#[test]
fn what_is_imposed_on_the_way_down_is_imposed_below() {
    let q = "q = { equation = \"u,xx + f = 0\" }";
    let up = Text {
        equations: q,
        ..Text::of("1/2 u,x^2 - f u", &["u"])
    };
    descends("\"q\"", up, up, ("refuted", "(q) is imposed in other"));
    let below = Text {
        imposed: "\"q\"",
        ..up
    };
    descends("\"q\"", below, up, ("proved", ""));
    // From Hu and Washizu to Hellinger and Reissner by the law of the material: e = s.
    let three = Text {
        equations: "m = \"s - e = 0\"",
        ..Text::of("1/2 e^2 - s (e - u,x) - f u", &["u", "e", "s"])
    };
    let two = Text::of("s u,x - 1/2 s^2 - f u", &["u", "s"]);
    descends("\"m\"", two, three, ("proved", ""));
    let given = ["{ fixed = [\"u\"] }", FREE];
    descends(
        "\"m\"",
        two,
        Text {
            ends: given,
            ..three
        },
        ("refuted", "is given in other, and not in own"),
    );
    descends(
        "\"m\"",
        Text { ends: given, ..two },
        Text {
            ends: given,
            ..three
        },
        ("proved", ""),
    );
}

/// From Timoshenko's beam to that of Euler and Bernoulli: with the angle the slope is given.
#[test]
fn what_is_given_of_an_eliminated_field_is_given_below() {
    let above = Text {
        ends: ["{ fixed = [\"w\", \"psi\"] }", FREE],
        equations: "k = \"psi = -w,x\"",
        ..Text::of("1/2 psi,x^2 + 1/2 (w,x + psi)^2 - f w", &["w", "psi"])
    };
    let below = |ends| Text {
        ends,
        ..Text::of("1/2 w,xx^2 - f w", &["w"])
    };
    let clamped = ["{ fixed = [\"w\", \"w,n\"] }", FREE];
    descends("\"k\"", below(clamped), above, ("proved", ""));
    let supported = ["{ fixed = [\"w\"] }", FREE];
    descends(
        "\"k\"",
        below(supported),
        above,
        (
            "refuted",
            "the normal derivative of w on x = 0 is given in other",
        ),
    );
}

/// What is imposed at one end says nothing of the other: u = 0 at x = 0, and a pull at x = 1, which is there below too.
#[test]
fn what_is_imposed_at_one_end_stays_there() {
    let above = Text {
        ends: [FREE, "\"-2 u\""],
        equations: "h = { equation = \"u = 0\", on = \"x = 0\" }",
        ..Text::of("1/2 u,x^2 - f u", &["u"])
    };
    let below = |pull| Text {
        imposed: "\"h\"",
        ends: [FREE, pull],
        ..above
    };
    descends("\"h\"", below("\"-2 u\""), above, ("proved", ""));
    descends("\"h\"", below("\"0\""), above, ("refuted", "x = 1"));
}

/// Values that are imposed are compared, and so is a slope.
#[test]
fn values_that_are_imposed_belong_to_the_functional() {
    let at = |value: &'static str| Text {
        imposed: "\"h\"",
        ends: ["{ fixed = [\"u\"] }", FREE],
        equations: value,
        ..Text::of("1/2 u,x^2 - f u", &["u"])
    };
    let (one, two) = (
        "h = { equation = \"u = 1\", on = \"x = 0\" }",
        "h = { equation = \"u = 2\", on = \"x = 0\" }",
    );
    becomes("", at(one), at(one), ("proved", ""));
    becomes("", at(two), at(one), ("refuted", "(h) is imposed in"));
    let beam = |ends, equations, imposed| Text {
        ends,
        equations,
        imposed,
        ..Text::of("1/2 w,xx^2 - f w", &["w"])
    };
    let slope = "h = { equation = \"w,x = 0\", on = \"x = 0\" }";
    let supported = beam(["{ fixed = [\"w\"] }", FREE], slope, "");
    let clamped = beam(["{ fixed = [\"w\", \"w,n\"] }", FREE], slope, "\"h\"");
    descends("\"h\"", clamped, supported, ("proved", ""));
}

/// Two functionals that add up to zero inside do so as wholes only where the ends do, too.
#[test]
fn boundary_terms_are_compared_without_a_stated_flux() {
    let dual = |density: &'static str, other: &'static str, ends: [&'static str; 2]| {
        let own = Text {
            ends,
            more: "[duality]\nwith = \"other.toml\"\n",
            ..Text::of(density, &["u", "v"])
        };
        let other = Text {
            ends,
            ..Text::of(other, &["u", "v"])
        };
        let study = studied(&own.written("own"), &other.written("other"));
        let own = decided(&study, "functional.duality");
        (own.word(), own.detail().to_owned())
    };
    // The sum is 14 u(0).
    let (word, detail) = dual("u + u,x - u,x", "-u", ["\"7 u\"", FREE]);
    assert_eq!(word, "refuted", "{detail}");
    let (word, detail) = dual("u", "-u", [FREE, FREE]);
    assert_eq!(word, "proved", "{detail}");
    // (u v)' is u v at the ends, which −u v/2 and u v/2 in both functionals cancel.
    let parts = ["u,x v", "u v,x"];
    let (word, detail) = dual(parts[0], parts[1], ["\"u v/2\"", "\"-u v/2\""]);
    assert_eq!(word, "proved", "{detail}");
    let (word, detail) = dual(parts[0], parts[1], [FREE, FREE]);
    assert_eq!(word, "refuted", "{detail}");
    // A function of no polynomial form: its flux is not found.
    let (word, detail) = dual("u,x cos(u)", "0 u", [FREE, FREE]);
    assert_ne!(word, "proved", "{detail}");
}

/// Boundary densities of which the sum is a divergence along a face leave something at its ends only: (y (1 − y) u),y on x = 0 has the integral
/// zero, so that the functionals do add up to zero, while y u on x = 0 has not.
#[test]
fn divergences_along_a_face_are_not_refuted() {
    let dual = |end: &str| {
        let of = |name: &str, density: &str, end: &str, more: &str| {
            format!(
                "kind = \"functional\"\nname = \"{name}\"\ndensity = \"{density}\"\n[domain]\ncoordinates = [\"x\", \"y\"]\n\
                 intervals = {{ x = [0, 1], y = [0, 1] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = \"{end}\"\n\
                 \"x = 1\" = \"0\"\n\"y = 0\" = \"0\"\n\"y = 1\" = \"0\"\n{more}"
            )
        };
        let own = of(
            "own",
            "u",
            end,
            "[duality]\nwith = \"other.toml\"\nflux = \"0 u,i\"\n",
        );
        let study = studied(&own, &of("other", "-u", "0", ""));
        let own = decided(&study, "functional.duality");
        (own.word(), own.detail().to_owned())
    };
    let (word, detail) = dual("y (1 - y) u,y + (1 - 2 y) u");
    assert_ne!(word, "refuted", "{detail}");
    for end in ["y u", "y (1 - y) u,y", "u,x", "u,y^2"] {
        let (word, detail) = dual(end);
        assert_eq!(word, "refuted", "{end}: {detail}");
    }
}

/// The boundary has no pieces at the ends of the time: ∫∫ u u,t is the integral of u²/2 at the last time less that at the first.
#[test]
fn what_goes_through_the_ends_of_the_time_is_a_condition() {
    let of = |name: &str, density: &str, more: &str| {
        format!(
            "kind = \"functional\"\nname = \"{name}\"\ndensity = \"{density}\"\n[domain]\ncoordinates = [\"x\"]\ntime = \"t\"\n\
             intervals = {{ x = [0, 1] }}\n[fields]\nu = \"scalar\"\n[boundary]\n\"x = 0\" = \"0\"\n\"x = 1\" = \"0\"\n{more}"
        )
    };
    let dual = |density: &str, other: &str| {
        let own = of("own", density, "[duality]\nwith = \"other.toml\"\n");
        let study = studied(&own, &of("other", other, ""));
        decided(&study, "functional.duality").word().to_owned()
    };
    assert_eq!(dual("u u,t", "0 u"), "conditional");
    assert_eq!(dual("u u,t", "-u u,t"), "proved");
}

/// The other functional imposes an equation modulo which the sum is a divergence: where a parameter may vanish it says nothing then, and one that
/// is not solved refutes nothing.
#[test]
fn what_the_other_functional_imposes_is_used_as_far_as_it_says_something() {
    let domain = "[domain]\ncoordinates = [\"x\"]\nintervals = { x = [0, 1] }\n[fields]\nu = \"scalar\"\nv = \"scalar\"\n[data]\nq = \"scalar\"\n\
                  [parameters]\nE = {}\n";
    let one = format!(
        "kind = \"functional\"\nname = \"one\"\ndensity = \"u,x v,x - q v\"\n{domain}[boundary]\n\"x = 0\" = \"u,x v\"\n\"x = 1\" = \"-u,x v\"\n\
         [duality]\nwith = \"other.toml\"\nflux = \"u,x v\"\n"
    );
    for (imposed, word, said) in [
        ("u,xx + q = 0", "proved", "modulo (m)"),
        ("E u,xx + E q = 0", "proved", "modulo (m) where E ≠ 0"),
        ("exp(u,xx + q) = 1", "undecided", "(m)"),
        ("u,xx + 2 q = 0", "refuted", ""),
    ] {
        let other = format!(
            "kind = \"functional\"\nname = \"other\"\ndensity = \"0 u\"\nimposed = [\"m\"]\n{domain}[boundary]\n\"x = 0\" = \"0\"\n\
             \"x = 1\" = \"0\"\n[equations]\nm = \"{imposed}\"\n"
        );
        let study = studied(&one, &other);
        let verdict = decided(&study, "functional.duality");
        assert_eq!(verdict.word(), word, "{imposed}: {}", verdict.detail());
        assert!(
            verdict.detail().contains(said),
            "{imposed}: {}",
            verdict.detail()
        );
    }
}

/// Two functionals whose densities add up to (s u)' are dual with any flux s u + c: a constant goes in at one end and out at the other.
#[test]
fn a_constant_in_a_flux_is_none() {
    let flux = |flux: &str, ends: [&str; 2], expected: (&str, &str)| {
        let more = format!("[duality]\nwith = \"other.toml\"\nflux = \"{flux}\"\n");
        let own = Text {
            ends,
            more: &more,
            ..Text::of("1/2 s^2 + s u,x", &["s", "u"])
        };
        let other = Text {
            ends: ["\"s u\"", "\"-s u\""],
            ..Text::of("-1/2 s^2 + s,x u", &["s", "u"])
        };
        related("functional.duality", own, other, expected);
    };
    for constant in ["", " + 1", " - 3/2 pi", " + 2 - 2"] {
        flux(
            &format!("s u{constant}"),
            [FREE; 2],
            ("proved", "to zero identically"),
        );
    }
    // What has a divergence is no constant.
    flux("s u + x", [FREE; 2], ("refuted", "not the divergence"));
    // Both functionals add up to 1.
    flux("s u + 1", ["\"1\"", FREE], ("undecided", ""));
}
