//! The cases in which an expression vanishes: by one of its factors, solved for a symbol of the state.

use super::{Case, Found, Search, LONGEST};
use crate::stationarity::closed_form::short;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::{coefficients, factors, irreducible_factors};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{simplify, Expr, Node, Symbol};

/// Powers of sines and cosines are exchanged for so many angles.
const ANGLES: usize = 2;

impl Search<'_, '_> {
    /// The factors by which an expression may vanish on the subset; `None` where it is too large to be factored.
    pub(super) fn vanishing_factors(&self, case: &Case, e: Expr) -> Option<Vec<Expr>> {
        if simplify::length(self.g, e) > LONGEST {
            return None;
        }
        let list = self.split_factors(e)?;
        let list = list.into_iter().filter(|&f| !self.never_zero(case, f));
        let mut open = Vec::new();
        for factor in list {
            // In another of the forms that sin² + cos² = 1 allows it may be a product or a power.
            let length =
                |list: &[Expr]| -> u64 { list.iter().map(|&f| simplify::length(self.g, f)).sum() };
            let forms = self.turned(factor).into_iter();
            let shortest = forms
                .filter(|list| !list.is_empty())
                .min_by_key(|list| length(list));
            let others = shortest.filter(|list| length(list) < length(&[factor]));
            let parts = others.unwrap_or_else(|| vec![factor]);
            open.extend(parts.into_iter().filter(|&f| !self.never_zero(case, f)));
        }
        Some(open)
    }

    /// The factors in which symbols of the state occur.
    pub(super) fn split_factors(&self, e: Expr) -> Option<Vec<Expr>> {
        let list = factors(self.g, e, &self.state)?.into_iter();
        let list = list.flat_map(|(factor, _)| self.irreducible(factor));
        Some(list.collect())
    }

    /// The irreducible factors of a polynomial in two symbols of the state and more that is of degree two and more in each: of
    /// `3 y'⁴ − 4 y'² z'² + z'⁴` the four linear ones would be missed else, and with them that the case is four.
    fn irreducible(&self, factor: Expr) -> Vec<Expr> {
        let g = self.g;
        let occurring = g.symbols_in(&[factor]);
        let state = self.state.iter().filter(|s| occurring.contains(s));
        let degrees: Option<Vec<usize>> = state
            .map(|&s| Some(coefficients(g, factor, s)?.len().saturating_sub(1)))
            .collect();
        let may_split = degrees.is_some_and(|list| list.len() > 1 && list.iter().all(|&n| n > 1));
        let list = may_split.then(|| irreducible_factors(g, factor, &self.state));
        match list.flatten() {
            Some(list) if list.len() > 1 => list.into_iter().map(|(f, _)| f).collect(),
            _ => vec![factor],
        }
    }

    /// The factors of an expression written with powers of the sine, or of the cosine, of each angle that occurs.
    fn turned(&self, e: Expr) -> Vec<Vec<Expr>> {
        let g = self.g;
        let reached = g.reachable(&[e]);
        let occurs = |f: Expr| reached.contains(&f);
        let angles = self.state.iter().map(|&s| g.symbol_expr(s));
        let angles: Vec<Expr> = angles
            .filter(|&angle| occurs(g.sin(angle)) || occurs(g.cos(angle)))
            .take(ANGLES)
            .collect();
        let forms = (1..1_usize << angles.len()).filter_map(|set| {
            let turned = angles.iter().enumerate().filter(|(i, _)| set >> i & 1 == 1);
            let (mut to, mut back) = (Vec::new(), Vec::new());
            for (i, &angle) in turned {
                let name = unused_name(self.cx.system, &format!("turned_{i}"));
                let other = g.symbol(&name, 0);
                to.extend([(g.sin(angle), g.cos(other)), (g.cos(angle), g.sin(other))]);
                back.extend([(g.cos(other), g.sin(angle)), (g.sin(other), g.cos(angle))]);
            }
            let written = g.substitute(e, &to);
            let state = g.symbols_in(&[written]);
            let state: Vec<Symbol> = state
                .into_iter()
                .filter(|s| !g.contains_any(e, &[*s]) || self.state.contains(s))
                .collect();
            let list = factors(g, written, &state)?;
            let list = list.into_iter();
            Some(list.map(|(f, _)| g.substitute(f, &back)).collect())
        });
        forms.collect()
    }

    fn never_zero(&self, case: &Case, factor: Expr) -> bool {
        let (g, negative) = (self.g, self.g.neg(factor));
        let mut known = case.nonzero.iter().chain(&self.motion.poles);
        // Where a root vanishes is the edge of where the motion is defined.
        let is_root = matches!(g.node(factor), Node::Power { exponent, .. } if g.as_integer(*exponent).is_none());
        let has_sign = |e: Expr| known_sign(g, e, &assumptions(self.cx.system)).is_nonzero();
        is_root
            || known.any(|&e| e == factor || e == negative)
            || has_sign(factor)
            || self
                .turned(factor)
                .iter()
                .any(|list| !list.is_empty() && list.iter().all(|&f| has_sign(f)))
    }

    /// The cases in which all of several expressions vanish.
    pub(super) fn require_all(&self, found: &mut Found, case: Case, es: &[Expr]) -> Vec<Case> {
        let mut cases = vec![case];
        for &e in es {
            let before = std::mem::take(&mut cases);
            for case in before {
                match self.on(&case, e) {
                    rest if self.g.is_zero(rest) => cases.push(case),
                    rest => cases.extend(self.require(found, &case, rest)),
                }
            }
        }
        cases
    }

    /// The cases in which an expression, which is not zero on the subset, vanishes: none where it has no factor that can.
    pub(super) fn require(&self, found: &mut Found, case: &Case, e: Expr) -> Vec<Case> {
        let whole = e;
        let e = self.remainder(case, whole);
        self.take_as_regular(e);
        let Some(list) = self.factors_modulo(case, whole, e) else {
            if !case.pending.contains(&e) {
                let mut case = case.clone();
                case.pending.push(e);
                return vec![case];
            }
            let text = format!(
                "{} (a condition is too long to be factored)",
                self.place(case)
            );
            self.leave(found, case, text);
            return Vec::new();
        };
        list.into_iter()
            .flat_map(|factor| self.solved(found, case, factor))
            .collect()
    }

    /// The factors of a remainder modulo the equations that are not solved, or the remainders of the factors where these are shorter:
    /// a product need not stay one.
    fn factors_modulo(&self, case: &Case, whole: Expr, rest: Expr) -> Option<Vec<Expr>> {
        let of_rest = self.vanishing_factors(case, rest);
        if whole == rest {
            return of_rest;
        }
        let of_whole = || -> Option<Vec<Expr>> {
            let mut list = Vec::new();
            for factor in self.vanishing_factors(case, whole)? {
                for e in self.vanishing_factors(case, self.remainder(case, factor))? {
                    if !list.contains(&e) {
                        list.push(e);
                    }
                }
            }
            Some(list)
        };
        let length =
            |list: &Vec<Expr>| -> u64 { list.iter().map(|&e| simplify::length(self.g, e)).sum() };
        let both = [of_rest, of_whole()].into_iter().flatten();
        both.min_by_key(length)
    }

    /// The cases in which a factor vanishes.
    fn solved(&self, found: &mut Found, case: &Case, factor: Expr) -> Vec<Case> {
        if let Some((angle, values)) = self.as_angle(factor) {
            if angle.period.is_none() {
                let (text, symbol) = (self.g.text(factor), self.g.text(angle.symbol));
                let and = self.place(case);
                self.leave(found, case, format!("{text} = 0 at other {symbol}, {and}"));
            }
            let cases = values.into_iter().filter_map(|value| {
                let mut case = self.with(case, angle.symbol, value)?;
                case.angles.push(angle.clone());
                Some(case)
            });
            return cases.collect();
        }
        let Some(case) = &self.taken(found, case, factor) else {
            return Vec::new();
        };
        let forms = self.turned(factor).into_iter();
        let forms = forms.filter_map(|list| <[Expr; 1]>::try_from(list).ok());
        let mut forms = [[factor]].into_iter().chain(forms);
        if let Some(terms) = forms.find_map(|[form]| self.as_sum_of_squares(form)) {
            return self.require_all(found, case.clone(), &terms);
        }
        match self.as_affine(case, factor) {
            Some((symbol, value, slope)) => {
                self.take_as_regular(slope);
                let mut cases = Vec::new();
                let certain = self
                    .vanishing_factors(case, slope)
                    .is_some_and(|f| f.is_empty());
                if !certain {
                    cases.extend(self.require_all(found, case.clone(), &[slope, factor]));
                }
                if let Some(mut off) = self.with(case, symbol, value) {
                    if !certain {
                        off.nonzero
                            .extend(self.vanishing_factors(case, slope).unwrap_or_default());
                    }
                    cases.push(off);
                }
                cases
            }
            None => {
                let cases = self.where_constant(found, case, factor);
                let cases = cases.or_else(|| self.where_implicit(found, case, factor));
                let cases = cases.or_else(|| self.where_root(found, case, factor));
                cases.unwrap_or_else(|| {
                    let text = self.g.text(factor);
                    let and = match self.equations(case).is_empty() {
                        true => String::new(),
                        false => format!(" and {}", self.place(case)),
                    };
                    self.leave(found, case, format!("{text} = 0{and}"));
                    Vec::new()
                })
            }
        }
    }

    /// The case in which a factor is taken apart; `None` where it was with all that is known now. Reduced by equations that are
    /// not solved, what must vanish for it may be the factor again.
    fn taken(&self, found: &mut Found, case: &Case, factor: Expr) -> Option<Case> {
        let known = case.solved.len()
            + case.implicit.len()
            + case.roots.len()
            + case.pending.len()
            + case.nonzero.len();
        if case.taken.contains(&(factor, known)) {
            let text = format!("{} = 0 and {}", self.g.text(factor), self.place(case));
            self.leave(found, case, text);
            return None;
        }
        let mut case = case.clone();
        case.taken.push((factor, known));
        Some(case)
    }

    /// A case with a further equation; `None` where it contradicts what does not vanish.
    pub(super) fn with(&self, case: &Case, symbol: Expr, value: Expr) -> Option<Case> {
        let pair = [(symbol, value)];
        let mut case = case.clone();
        for (_, known) in &mut case.solved {
            *known = short(self.g, self.g.substitute(*known, &pair));
        }
        for root in &mut case.roots {
            root.substitute(self.g, &pair);
        }
        case.solved.push((symbol, value));
        case.stated.push(self.g.sub(symbol, value));
        let nonzero = std::mem::take(&mut case.nonzero);
        for e in nonzero {
            let rest = self.on(&case, e);
            if self.g.is_zero(rest) {
                return None;
            }
            let list = factors(self.g, rest, &self.state).unwrap_or_else(|| vec![(rest, 1)]);
            case.nonzero
                .extend(list.into_iter().map(|(factor, _)| factor));
        }
        self.is_defined(&case).then_some(case)
    }

    /// Whether the motion is smooth somewhere on the subset: no root vanishes, or is one of what is never positive.
    fn is_defined(&self, case: &Case) -> bool {
        self.motion.poles.iter().all(|&pole| {
            let radicand = match self.g.node(pole) {
                Node::Power { base, exponent } if self.g.as_integer(*exponent).is_none() => *base,
                _ => return !self.g.is_zero(self.on(case, pole)),
            };
            let rest = self.on(case, radicand);
            let sign = known_sign(self.g, rest, &assumptions(self.cx.system));
            !self.g.is_zero(rest) && !sign.is_nonpositive()
        })
    }

    /// The terms of a sum none of which can be negative.
    fn as_sum_of_squares(&self, factor: Expr) -> Option<Vec<Expr>> {
        let Node::Sum { constant, terms } = self.g.node(factor) else {
            return None;
        };
        let known = assumptions(self.cx.system);
        let zero = chetaev_symbolic::Rational::from(0);
        let parts: Vec<Expr> = terms.iter().map(|(e, c)| self.g.scale(c, *e)).collect();
        let signs: Vec<_> = parts
            .iter()
            .map(|&e| known_sign(self.g, e, &known))
            .collect();
        let one_sign = signs.iter().all(|sign| sign.is_nonnegative())
            || signs.iter().all(|sign| sign.is_nonpositive());
        (constant == &zero && one_sign).then_some(parts)
    }

    /// A symbol of the state in which a factor is affine, its value where the factor vanishes, and its coefficient. Speeds
    /// come first, and coefficients that cannot vanish before others.
    fn as_affine(&self, case: &Case, factor: Expr) -> Option<(Expr, Expr, Expr)> {
        let g = self.g;
        let occurring = g.symbols_in(&[factor]);
        let mut best: Option<(u8, u64, (Expr, Expr, Expr))> = None;
        for &s in self.state.iter().filter(|s| occurring.contains(s)) {
            let slope = short(g, g.diff(factor, s));
            if g.contains_any(slope, &[s]) || g.is_zero(slope) {
                continue;
            }
            let symbol = g.symbol_expr(s);
            let rest = g.substitute(factor, &[(symbol, g.zero())]);
            let is_speed = self.motion.speeds.contains(&s);
            let certain = self
                .vanishing_factors(case, slope)
                .is_some_and(|f| f.is_empty());
            let rank = u8::from(!certain) * 2 + u8::from(!is_speed);
            let value = short(g, g.neg(g.div(rest, slope)));
            let length = simplify::length(g, value);
            if best
                .as_ref()
                .is_none_or(|(r, l, _)| (rank, length) < (*r, *l))
            {
                best = Some((rank, length, (symbol, value, slope)));
            }
        }
        best.map(|(_, _, found)| found)
    }
}
