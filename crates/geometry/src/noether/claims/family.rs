//! `noether.family`: the families searched, and the dimension found.

use super::controls::for_laws;
use super::requirements;
use crate::integrability::components::components;
use crate::integrability::on_its_own;
use crate::noether::found::{found, Found, Searched};
use crate::noether::search::Integral;
use crate::noether::special::{is_stated, Looked, Special, Tie};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::words::counted;
use chetaev_symbolic::verdict::{Evidence, Method, Proof};
use chetaev_symbolic::{Expr, Verdict};

/// `noether.family`.
#[derive(Clone, Copy, Debug)]
pub struct FamilySearched;

/// The claim that searches.
pub const ID: &str = "noether.family";

/// How the parts of a detail begin that name a family that was searched to its end.
pub(crate) const EXHAUSTED: &str = "exhausted: ";

/// The bound that a proof needs, as log2.
const PROOF_LOG2: f64 = -100.0;

impl Claim for FamilySearched {
    fn id(&self) -> &'static str {
        ID
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "First integrals in families chosen for the system: all of them"
    }

    fn explanation(&self) -> &'static str {
        "First integrals G(t, q, v) are searched as combinations of the functions of a family: products of velocities, dependent \
         ones and quasi-velocities too, with functions of the coordinates and the time that occur in the model (sines and cosines of its \
         angles, its roots and exponentials, powers of coordinates, time and masses with a law of their own, logarithms of masses that vary, roots of the factors of the determinant of \
         the mass matrix; in a family of its own sines and cosines of multiples of polar angles that occur nowhere; for curvilinear coordinates polynomials in the \
         momenta and the energy, in which moments of momentum and the integrals of separable systems are short; products of any powers of \
         velocities, functions and Darboux polynomials P, for which X̄P = K P, whose exponents are solved for, and the arguments of complex ones; functions of first and second degree times exponentials, sines and cosines of the time, whose exponents are \
         eigenvalues of the motion on them). The \
         family is as large as the budget allows and is stated; terms of a higher degree in the velocities than two are in it where the \
         model asks for them by [search] degree. X̄G = 0 on the constraint manifold is a linear system for the \
         coefficients; it is solved at random points of prime fields with random parameters, the coefficients are lifted to functions of \
         the parameters, and every integral is then proved. The dimension counts neither constants nor what vanishes on the \
         constraints. That there are no more is certain except for the stated probability. An integral outside \
         of the family may exist: the claim never says that a system has none."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        match &*found(cx) {
            Ok(found) => together(cx, found),
            Err(why) => on_components(cx).unwrap_or_else(|| {
                Verdict::undecided(format!("the search was not made: {why}")).into()
            }),
        }
    }
}

/// The search on all components at once; where it leaves something open, on each by itself.
fn together(cx: &Context<'_>, found: &Found) -> Finding {
    let verdict = verdict(cx, found);
    if matches!(verdict, Verdict::Undecided { .. }) {
        if let Some(finding) = on_components(cx) {
            return finding;
        }
    }
    let formula = |(j, integral): (usize, &Integral)| Formula {
        caption: match &integral.name {
            Some(name) => format!("first integral {}, {name}", j + 1),
            None => format!("first integral {}", j + 1),
        },
        left: None,
        right: integral.shown,
    };
    Finding {
        verdict,
        formulas: found.integrals.iter().enumerate().map(formula).collect(),
    }
}

/// The search on each component of constraints that are products, or functions of simpler ones; `None` where there are none, or one of the
/// searches is not made or not complete.
fn on_components(cx: &Context<'_>) -> Option<Finding> {
    let g = &cx.system.graph;
    let (mut formulas, mut sentences, mut proofs) = (Vec::new(), Vec::new(), Vec::new());
    let mut exhausted = String::new();
    for component in components(cx) {
        let (found, told) = on_its_own(cx, &component.system, |own| {
            let found = found(own);
            let told = found.as_ref().as_ref().ok().map(|found| {
                let words = (sentence(own, found), families(own, found));
                (verdict(own, found), words)
            });
            (found.clone(), told)
        })?;
        let (Ok(found), Some((Verdict::Proved(proof), (sentence, searched)))) = (&*found, told)
        else {
            return None;
        };
        let place = match component.condition {
            Some(condition) => format!("on the component {condition}"),
            None => component.sentence,
        };
        let own = found
            .integrals
            .iter()
            .map(|integral| g.text(integral.shown));
        let own = own.collect::<Vec<String>>().join(", ");
        let own = if own.is_empty() {
            "none".to_owned()
        } else {
            own
        };
        sentences.push(format!(
            "{place} the first integrals are functions of: {own}; {sentence}"
        ));
        exhausted.push_str(&searched);
        formulas.extend(found.integrals.iter().map(|integral| Formula {
            caption: format!("a first integral {place}"),
            left: None,
            right: integral.shown,
        }));
        proofs.push(proof);
    }
    let bounds = proofs.iter().filter_map(|proof| proof.error_bound_log2);
    let bound = bounds.fold(f64::NEG_INFINITY, f64::max);
    let samples = proofs.iter().map(|proof| proof.samples).min()?;
    Some(Finding {
        verdict: Verdict::Proved(Proof {
            method: Method::Modular,
            error_bound_log2: Some(bound + (proofs.len() as f64).log2()),
            samples,
            seed: Some(cx.prover.seed),
            ..Proof::exact(
                "on each component by itself",
                format!("{}{exhausted}", sentences.join("; ")),
            )
        }),
        formulas,
    })
}

fn verdict(cx: &Context<'_>, found: &Found) -> Verdict {
    let sentence = sentence(cx, found);
    let bounds = found.families.iter().map(|f| f.error_bound_log2);
    let bound = bounds.map(f64::exp2).sum::<f64>().log2().ceil();
    let samples = found.families.iter().map(|f| f.draws).min().unwrap_or(0);
    let families = families(cx, found);
    if found.open > 0 {
        return Verdict::undecided(format!("{sentence}{families}"));
    }
    let rest = format!(
        "each integral is proved by itself, and a dimension is larger with probability below 2^{bound:.0} only"
    );
    if bound > PROOF_LOG2 {
        return Verdict::Numerical(Evidence {
            samples,
            region: "random points of prime fields".into(),
            digits: 18,
            residual: 0.0,
            seed: Some(cx.prover.seed),
            why_no_proof: format!(
                "{sentence}; {rest}, which is more than a proof allows{families}"
            ),
        });
    }
    let proof = Proof {
        method: Method::Modular,
        error_bound_log2: Some(bound),
        samples: samples.max(1),
        seed: Some(cx.prover.seed),
        ..Proof::exact(
            "for general values of the parameters",
            format!("{rest}{families}"),
        )
    };
    Verdict::Proved(proof).prefixed(&sentence)
}

/// What was found, in general and at special values.
fn sentence(cx: &Context<'_>, found: &Found) -> String {
    let many = match found.integrals.len() {
        0 => "no first integral was found".to_owned(),
        count => counted(
            count,
            "functionally independent first integral",
            "functionally independent first integrals",
        ),
    };
    let open = match found.open {
        0 => String::new(),
        open => format!(
            "; {} seen whose coefficients were not found",
            counted(open, "more was", "more were")
        ),
    };
    let shown: Vec<Expr> = found.integrals.iter().map(|i| i.shown).collect();
    let energy = match (found.energy_depends, found.integrals.len()) {
        (false, _) => "",
        (true, 1) => "; the energy is a function of it",
        (true, _) => "; the energy is a function of these",
    };
    let controls = for_laws(cx, &shown).map_or(String::new(), |said| format!("; {said}"));
    let shared = match components(cx).len() > 1 {
        true => "; these are kept on all components of the constraints, on one of which by itself there may be more",
        false => "",
    };
    format!(
        "{many} in the families searched, of which those of polynomials are larger with a larger time budget{}{energy}{open}{shared}{controls}{}",
        dependent(cx, found),
        at_special_values(cx, found)
    )
}

/// The families that were exhausted, each a part of the detail that begins with [`EXHAUSTED`], so that it can be shown in a line of its own.
fn families(cx: &Context<'_>, found: &Found) -> String {
    let mut families: Vec<String> = found.families.iter().map(exhausted).collect();
    families.extend(found.momenta.iter().map(|momenta| {
        format!(
            "generalized momenta whose fields have components made of {} functions of the place, coefficients of weight up to {}: dimension {}",
            momenta.functions.len(),
            momenta.weight,
            momenta.dimension
        )
    }));
    if !found.powers.is_empty() {
        let g = &cx.system.graph;
        let bases: Vec<String> = found.powers.iter().map(|&e| g.text(e)).collect();
        let exponents: Vec<String> = found.exponents.iter().map(|&e| g.text(e)).collect();
        families.push(format!(
            "products of any powers of {}, times exponentials of combinations of {}",
            bases.join(", "),
            exponents.join(", ")
        ));
    }
    families.extend(found.darboux.clone());
    let functions = match found.exponentials {
        0 => None,
        1 => Some("linear functions"),
        _ => Some("functions up to second degree"),
    };
    families.extend(functions.map(|functions| format!(
        "{functions} of velocities and coordinates times exponentials of the time, where these functions are mapped into themselves by the motion, with eigenvalues of equations of degree one or two that are seen to be real, or as quadratic forms of two or four functions that belong to others"
    )));
    families.extend(families_at_special_values(cx, found));
    let each = families.into_iter();
    each.map(|family| format!("; {EXHAUSTED}{family}"))
        .collect()
}

/// What there is more of at special values of parameters.
fn at_special_values(cx: &Context<'_>, found: &Found) -> String {
    let special = &found.special;
    if special.looked == Looked::Nothing {
        return String::new();
    }
    let is_open = special.looked == Looked::Not && special.critical.parameters.is_empty();
    if is_open {
        return "; special values of parameters were not looked at".to_owned();
    }
    let more: Vec<String> = special.found.iter().map(|s| self::special(cx, s)).collect();
    let missed: Vec<String> = special.missed.iter().map(|tie| place(cx, tie)).collect();
    let not_looked = match missed.is_empty() {
        true => String::new(),
        false => format!(
            "; not looked at, as no points were found for it there, is where {}: a model that states the values without these parameters is searched there",
            missed.join(" or where ")
        ),
    };
    match (more.is_empty(), missed.is_empty()) {
        (true, true) => "; no more were found at special values of parameters".to_owned(),
        (true, false) => {
            format!("; no more were found at other special values of parameters{not_looked}")
        }
        (false, _) => format!(
            "; there are further or simpler ones {}{not_looked}",
            more.join("; ")
        ),
    }
}

/// The families that were exhausted at special values of parameters, and at which.
fn families_at_special_values(cx: &Context<'_>, found: &Found) -> Vec<String> {
    let special = &found.special;
    let places = match &special.looked {
        Looked::Nothing | Looked::Not => None,
        Looked::All => Some("where parameters are equal or zero or as stated".to_owned()),
        Looked::Some { ties, others } => {
            let ties = ties.iter().map(|tie| equations(cx, tie));
            let mut left_out = special
                .missed
                .iter()
                .chain(special.put_in.iter().map(|own| &own.tie));
            let stated = match left_out.any(|tie| matches!(tie, Tie::Values(_))) {
                true => None,
                false => Some("as stated".to_owned()),
            };
            let all: Vec<String> = ties.chain(stated).collect();
            let only = match others {
                true => ", and not at other equalities or zeros",
                false => "",
            };
            (!all.is_empty()).then(|| format!("where parameters are so{only}: {}", all.join("; ")))
        }
    };
    let simple = places.map(|places| format!("{places}, {}", special.families.join(", ")));
    let own = special.put_in.iter().map(|own| {
        let families = own.families.join(", ");
        format!("where {}, {families}", equations(cx, &own.tie))
    });
    let critical = at_critical_values(cx, found);
    simple.into_iter().chain(own).chain(critical).collect()
}

/// The values of one parameter that were searched rather than stated.
fn at_critical_values(cx: &Context<'_>, found: &Found) -> Option<String> {
    let looked = &found.special.critical;
    let names: Vec<&str> = looked
        .parameters
        .iter()
        .map(|&s| cx.system.graph.symbol_name(s))
        .collect();
    let critical = match &names[..] {
        [] => return None,
        [one] => format!("where {one} is a simple rational number"),
        all => format!(
            "where one of {} is a simple rational multiple of a product of powers of others or a sum of two of these",
            all.join(", ")
        ),
    };
    let equal = match looked.equal {
        true => ", or so where two others are equal",
        false => "",
    };
    Some(format!("{critical}{equal}, {}", looked.words))
}

/// What was found beside the independent ones, in words.
fn dependent(cx: &Context<'_>, found: &Found) -> String {
    let (products, others) = (found.dependent.second_degree, found.dependent.others);
    let named = products_named(&found.dependent.products);
    let constraints = match cx.system.fixed_functions().is_empty() {
        true => "",
        false => " and of what the constraints fix",
    };
    // Of the second degree: sums of products of two, and of these themselves.
    let (second, several) = match found.integrals.len() {
        1 => ("of second degree in it", "functions of it"),
        _ => ("of second degree in these", "functions of these"),
    };
    let second = format!("{second}{constraints}{named}");
    let are = |count: usize| match count {
        1 => "one more is".to_owned(),
        _ => format!("{count} more are"),
    };
    match (products, others) {
        (0, 0) => String::new(),
        (products, 0) => format!("; {} {second}", are(products)),
        (0, 1) => format!(
            "; {} a {}{constraints}",
            are(1),
            &several.replacen("functions", "function", 1)
        ),
        (0, others) => format!("; {} {several}{constraints}", are(others)),
        (products, 1) => format!(
            "; {} {second}; one is another {}{constraints}",
            are(products),
            &several.replacen("functions", "function", 1)
        ),
        (products, others) => format!(
            "; {} {second}; {others} are other {several}{constraints}",
            are(products)
        ),
    }
}

/// Which products of two integrals are among those of second degree, by the numbers of `noether.integral`.
fn products_named(products: &[(usize, usize)]) -> String {
    let named = products.iter().map(|&(i, j)| match i == j {
        true => format!("G{}^2", i + 1),
        false => format!("G{} G{}", i + 1, j + 1),
    });
    match named.collect::<Vec<String>>() {
        all if all.is_empty() => String::new(),
        all => format!(" (products: {})", all.join(", ")),
    }
}

/// Special values of parameters with what they add, in words.
fn special(cx: &Context<'_>, special: &Special) -> String {
    let g = &cx.system.graph;
    let integrals: Vec<String> = special.integrals.iter().map(|&e| g.text(e)).collect();
    let here = match is_stated(cx, &special.tie) {
        true => ", as the model states",
        false => "",
    };
    format!(
        "where {}{here}: {}",
        equations(cx, &special.tie),
        integrals.join(", ")
    )
}

/// Special values in words.
fn place(cx: &Context<'_>, tie: &Tie) -> String {
    let as_stated = match tie {
        Tie::Values(_) => ", as the model states",
        _ => "",
    };
    format!("{}{as_stated}", equations(cx, tie))
}

/// `a = b, c = 0`.
fn equations(cx: &Context<'_>, tie: &Tie) -> String {
    let g = &cx.system.graph;
    let pairs = tie.pairs(g).into_iter();
    let texts = pairs.map(|(a, b)| format!("{} = {}", g.text(a), g.text(b)));
    texts.collect::<Vec<String>>().join(", ")
}

fn exhausted(searched: &Searched) -> String {
    let relations = match searched.relations {
        0 => String::new(),
        relations => format!(", {relations} of them combinations of others"),
    };
    format!(
        "{} ({} functions{relations}): dimension {}",
        searched.family.words,
        searched.family.members.len() - 1,
        searched.dimension
    )
}
