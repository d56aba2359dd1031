//! A motion in question with what is derived of it once, and what a statement on it is.

use crate::admissible_values::not_real;
use crate::bundle::{bundles, Bundle};
use crate::expansion::Expansion;
use crate::hurwitz::{Boundary, Crossing};
use crate::integrals::Jet;
use crate::isolation::Root;
use crate::problem::LinearizationError;
use crate::question::{general_parameters, parameter_of_motion, values_but, Place, Question};
use crate::real_roots::sign_of;
use crate::steady::closed;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::SteadyMotion;
use chetaev_symbolic::factors::{coefficients, irreducible_factors};
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_int::ops::BitTest;
use dashu_ratio::RBig;
use std::any::{Any, TypeId};
use std::cell::{OnceCell, RefCell};
use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;
use std::sync::{Mutex, PoisonError};

/// What is known of a statement at a value of the parameter, or throughout an interval.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Said {
    /// It holds, and why.
    Holds(String),
    /// It fails.
    Fails,
    /// It was not decided, and why.
    Open(String),
}

/// The questions that several claims ask, by the name of the motion and the values of parameters.
#[derive(Default)]
struct Questions(Mutex<BTreeMap<Asked, Question>>);

type Asked = (String, Vec<(Expr, Expr)>);

/// A motion with its linear equations.
pub(crate) struct About<'a> {
    pub(crate) expansion: Expansion<'a>,
    pub(crate) question: Question,
    bundles: OnceCell<Vec<Bundle>>,
    integrals: OnceCell<Vec<Jet>>,
    transported: OnceCell<Vec<Jet>>,
    /// Those for general values of a parameter, at this value of it.
    pub(crate) inherited: Vec<Bundle>,
    /// What theorems need, each by its type.
    known: RefCell<HashMap<TypeId, Rc<dyn Any>>>,
}

impl<'a> About<'a> {
    pub(crate) fn new(
        cx: &Context<'a>,
        motion: &'a SteadyMotion,
        values: &[(Expr, Expr)],
        over: Option<Symbol>,
    ) -> Result<About<'a>, LinearizationError> {
        let expansion = Expansion::new(cx.system, cx.terms, cx.selection, motion, values)?;
        let known = cx.shared(|_| Questions::default());
        let place = (motion.name.clone(), values.to_vec());
        let mut known = known.0.lock().unwrap_or_else(PoisonError::into_inner);
        let question = known
            .entry(place)
            .or_insert_with(|| Question::about(&expansion, over));
        Ok(About {
            question: question.clone(),
            expansion,
            bundles: OnceCell::new(),
            integrals: OnceCell::new(),
            transported: OnceCell::new(),
            inherited: Vec::new(),
            known: RefCell::default(),
        })
    }

    pub(crate) fn graph(&self) -> &Graph {
        &self.expansion.system.graph
    }

    /// The parameters without a value on which the linear equations depend.
    pub(crate) fn general_parameters(&self) -> Vec<String> {
        let linear = &self.question.linear;
        let entries = [linear.left.concat(), linear.right.concat()].concat();
        general_parameters(self.expansion.system, &entries)
    }

    /// Combinations of integrals that are known in finite terms, those for general values of a parameter among them.
    pub(crate) fn finite_bundles(&self, known: &[Jet]) -> Vec<Bundle> {
        let mut found = bundles(self.graph(), known, self.expansion.variables().len());
        let mut inherited = self.inherited.iter();
        let is_known = inherited.all(|own| own.weights.len() == known.len());
        if is_known {
            found.extend(self.inherited.iter().cloned());
        }
        found
    }

    /// The combinations of integrals that are known in finite terms at a value of the parameter that was left in.
    pub(crate) fn bundles_at(&self, (symbol, at): (Symbol, Expr)) -> Vec<Bundle> {
        let g = self.graph();
        let known = self.integrals();
        let found = bundles(g, known, self.expansion.variables().len());
        let value = (g.symbol_expr(symbol), at);
        let is_finite =
            |e: &Expr| sign_of(g, g.substitute(*e, &[value])).is_some_and(|s| s != Ordering::Equal);
        let of_known = found
            .iter()
            .filter(|own| own.weights.len() == known.len() && own.nonzero.iter().all(is_finite));
        of_known.map(|own| own.at(g, value)).collect()
    }

    /// What a theorem needs, made when it is first asked for.
    pub(crate) fn once<T: 'static>(&self, make: impl FnOnce() -> T) -> Rc<T> {
        let place = TypeId::of::<T>();
        let known = self.known.borrow().get(&place).cloned();
        if let Some(Ok(found)) = known.map(Rc::downcast::<T>) {
            return found;
        }
        let made = Rc::new(make());
        self.known.borrow_mut().insert(place, made.clone());
        made
    }

    /// Integrals that are known in finite terms, and functions that fall.
    pub(crate) fn integrals(&self) -> &[Jet] {
        self.integrals.get_or_init(|| self.expansion.integrals())
    }

    /// Integrals of transport.
    pub(crate) fn transported(&self) -> &[Jet] {
        self.transported
            .get_or_init(|| self.expansion.transported())
    }

    /// Combinations of integrals that may be Lyapunov functions.
    pub(crate) fn bundles(&self) -> &[Bundle] {
        self.bundles.get_or_init(|| {
            let (g, n) = (self.graph(), self.expansion.variables().len());
            let (known, transported) = (self.integrals(), self.transported());
            let mut found = bundles(g, known, n);
            if !transported.is_empty() {
                found.extend(bundles(g, &[transported, known].concat(), n));
            }
            found
        })
    }
}

/// The motion that is the subject of a claim: for all values of its parameter where it is steady for all of them, else for the stated values.
pub(crate) fn about<'a>(
    cx: &Context<'a>,
    subject: Option<&str>,
) -> Option<Result<About<'a>, LinearizationError>> {
    let system = cx.system;
    let mut stated = system.steady.iter();
    let motion = stated.find(|s| Some(s.name.as_str()) == subject)?;
    let of = |over| About::new(cx, motion, &values_but(system, over), over);
    if let Some(problem) = is_not_real(cx, motion) {
        return Some(Err(problem));
    }
    let general = parameter_of_motion(system, motion).map(|symbol| of(Some(symbol)));
    Some(match general {
        Some(Ok(found)) => Ok(found),
        _ => of(None),
    })
}

/// What is said where what the motion states is not real at the values of the parameters that the model states.
fn is_not_real(cx: &Context<'_>, motion: &SteadyMotion) -> Option<LinearizationError> {
    let g = &cx.system.graph;
    let stated = motion.positions.iter().chain(&motion.velocities);
    let stated: Vec<Expr> = stated.flatten().copied().collect();
    let stated = g.substitute_all(&stated, &values_but(cx.system, None));
    not_real(g, &stated).map(|value| LinearizationError::NotReal {
        motion: motion.name.clone(),
        value: g.text(value),
    })
}

/// The zero in an enclosure in closed form, where it is rational or one of these functions has a factor of second degree that vanishes there.
pub(crate) fn closed_form(
    g: &Graph,
    (symbol, root): (Symbol, &Root),
    functions: &[Expr],
) -> Option<Expr> {
    if root.low == root.high {
        return Some(g.number(root.low.clone()));
    }
    let precision = Precision::new(BITS);
    let is_inside = |e: &Expr| {
        let found = g.enclose(&[*e], &precision, &|_| None).ok();
        found.is_some_and(|found| {
            let [low, high] = [&root.low, &root.high].map(|end| precision.rational(end));
            let above = |a: &Ball, b: &Ball| {
                let change = precision.sub(a, b).ok();
                change.and_then(|own| own.sign()) == Some(Ordering::Greater)
            };
            above(&found[0], &low) && above(&high, &found[0])
        })
    };
    let of = |&e: &Expr| -> Option<Expr> {
        let parts = irreducible_factors(g, e, &[symbol])?;
        let mut zeros = parts.into_iter().filter_map(|(part, _)| {
            let list = coefficients(g, part, symbol)?;
            let &[c, b, a] = list.as_slice() else {
                return None;
            };
            let discriminant = g.sub(g.powi(b, 2), g.mul(&[g.integer(4), a, c]));
            let is_small = g.as_number(closed(g, discriminant)).is_some_and(|own| {
                own.numerator().bit_len() + own.denominator().bit_len() <= LARGEST
            });
            if !is_small {
                return None;
            }
            let zero = |sign: i64| {
                let above = g.sub(g.mul(&[g.integer(sign), g.sqrt(discriminant)]), b);
                closed(g, g.div(above, g.mul(&[g.integer(2), a])))
            };
            [1, -1].map(zero).into_iter().find(is_inside)
        });
        zeros.next()
    };
    functions.iter().find_map(of)
}

/// Bits of a discriminant with whose root is computed: with larger ones exact linear algebra takes long.
const LARGEST: usize = 256;

/// Digits of borders that are the same in double precision.
pub(crate) const DIGITS: usize = 60;

/// Bits of the enclosures of zeros in closed form.
pub(crate) const BITS: usize = 256;

/// A statement on the stability of a motion.
pub(crate) trait Statement {
    /// The id of the claim.
    fn id(&self) -> &'static str;

    /// What is stated, in a line.
    fn title(&self) -> &'static str;

    /// How it is decided.
    fn explanation(&self) -> &'static str;

    /// What is known of it where the eigenvalues lie so, at a value of the parameter or throughout an interval about it in which no function of
    /// [`further`](Statement::further) vanishes.
    fn said(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Said;

    /// Further functions of the parameter at whose zeros the answer may change.
    fn further(&self, _: &About<'_>) -> Vec<Expr> {
        Vec::new()
    }

    /// Whether runs beside the motion are a witness where it is undecided.
    fn is_witnessed(&self) -> bool {
        false
    }

    /// Whether it holds at a value between two intervals, given whether it holds on one side of that value, and what becomes of the eigenvalues
    /// there: nothing where that value only ends what is admitted.
    fn at_border(&self, _holds_beside: bool, _crossing: Option<Crossing>) -> Option<bool> {
        None
    }

    /// What is known of it at such a value, beyond what is known beside it.
    fn at_boundary(&self, _: &About<'_>, _: &Boundary) -> Option<Said> {
        None
    }

    /// Whether it is asked at such a value where that is known exactly and is not rational.
    fn looks_at_boundaries(&self) -> bool {
        false
    }

    /// Whether integrals that are known for general values of the parameter are asked for at single ones.
    fn uses_integrals(&self) -> bool {
        false
    }

    /// What contradicts it, at a value of the parameter.
    fn counterexample(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Counterexample;
}
