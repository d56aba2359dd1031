//! `noether.form#NAME`: the first integrals of a form that the model states with unknown constants and functions.

use super::requirements;
use crate::noether::motion::Motion;
use chetaev_integrals::unknowns::{solved, Solution, Solved};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::system::IntegralForm;
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::{Graph, Verdict};

/// `noether.form#NAME`.
#[derive(Clone, Copy, Debug)]
pub struct IntegralOfForm;

impl Claim for IntegralOfForm {
    fn id(&self) -> &'static str {
        "noether.form"
    }

    fn group(&self) -> Group {
        Group::Integrals
    }

    fn title(&self) -> &'static str {
        "The stated form contains a first integral"
    }

    fn explanation(&self) -> &'static str {
        "The model states a form such as a x'^2 + b y'^2 + h(x) with unknown constants and functions. X̄G = 0 is linear in the constants \
         and in the coefficients of the functions, which are looked for among products of powers of their arguments and of the functions \
         of these that occur in the motion. The verdict names a basis of the solutions; each is proved. Where nothing but constants is \
         unknown the claim is refuted if there is none; where a function is unknown others may exist."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let forms = cx.system.integral_forms.iter();
        forms.map(|form| Some(form.name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let mut forms = cx.system.integral_forms.iter();
        let Some(form) = forms.find(|form| Some(&form.name[..]) == subject) else {
            return Verdict::undecided("the model states no such form").into();
        };
        let motion = match Motion::of(cx) {
            Ok(motion) => motion,
            Err(why) => return Verdict::undecided(why).into(),
        };
        match solved(cx, &motion, form) {
            Ok(solved) => finding(&cx.system.graph, form, solved),
            Err(why) => Verdict::undecided(why.to_string()).into(),
        }
    }
}

fn finding(g: &Graph, form: &IntegralForm, solved: Solved) -> Finding {
    let Some(first) = solved.integrals.first() else {
        return none(form, solved.complete).into();
    };
    let mut verdict = first.verdict.clone();
    for other in &solved.integrals[1..] {
        verdict = verdict.and(other.verdict.clone());
    }
    let texts: Vec<String> = solved.integrals.iter().map(|own| values(g, own)).collect();
    let which = if solved.complete {
        "exactly the combinations of these are integrals of this form"
    } else {
        "other functions may give further ones"
    };
    verdict.prefix(&format!("{}; {which}", texts.join("; or ")));
    let formulas = solved.integrals.iter().map(|own| Formula {
        caption: format!("a first integral of the form {}", form.name),
        left: None,
        right: own.integral,
    });
    Finding {
        formulas: formulas.collect(),
        verdict,
    }
}

/// `a = m, b = m, h = k x^2`.
fn values(g: &Graph, solution: &Solution) -> String {
    let each = solution.unknowns.iter();
    let each = each.map(|&(s, e)| format!("{} = {}", g.symbol_text(s), g.text(e)));
    each.collect::<Vec<String>>().join(", ")
}

fn none(form: &IntegralForm, complete: bool) -> Verdict {
    if !complete {
        return Verdict::undecided(
            "no first integral of this form was found with functions that are combinations of products of powers of their arguments and of the functions that occur",
        );
    }
    let size = form.unknowns.len().to_string();
    Verdict::Refuted(Counterexample {
        point: Vec::new(),
        quantity: "independent rates of the terms".into(),
        residual: (size.clone(), size),
        detail: "no choice of the constants makes this form a first integral that is no constant: the rates of its terms are linearly independent".into(),
    })
}
