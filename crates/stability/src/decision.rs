//! One statement on a motion, decided at the values of the parameters that the model states, or for all values of the one parameter that occurs
//! in the motion only.

use crate::about::{about, closed_form, About, Said, Statement, BITS, DIGITS};
use crate::admissible_values::AdmissibleValues;
use crate::characteristic::{LARGEST as VARIABLES, LARGEST_IN_NUMBERS};
use crate::hurwitz::{Boundary, Crossing, Ranges};
use crate::isolation::{joined, without_power, Root};
use crate::parameter_values::{for_which, of_general};
use crate::question::{bound_of, values_at, values_but, Place};
use crate::real_roots::{decimal, overlap, zeros_of_factors, Zero, FINE, USUAL};
use crate::witness::RunsBeside;
use chetaev_mechanics::claims::Context;
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::verdict::{Counterexample, PointValue, Proof};
use chetaev_symbolic::{Expr, Symbol, Verdict};
use dashu_int::IBig;
use dashu_ratio::RBig;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// The verdict on a statement; what is undecided has a witness, where the context brings one.
pub(crate) fn verdict(
    cx: &Context<'_>,
    subject: Option<&str>,
    statement: &dyn Statement,
) -> Verdict {
    let found = decided(cx, subject, statement);
    let is_open = matches!(found, Verdict::Undecided { .. });
    let witness = cx.extension::<RunsBeside>();
    let Some(witness) = witness.filter(|_| is_open && statement.is_witnessed()) else {
        return found;
    };
    let mut stated = cx.system.steady.iter();
    let motion = stated.find(|own| Some(own.name.as_str()) == subject);
    match motion.and_then(|own| (witness.0)(cx.system, cx.terms, cx.selection, own)) {
        Some(said) => Verdict::undecided(format!("{}; {said}", found.detail())),
        None => found,
    }
}

fn decided(cx: &Context<'_>, subject: Option<&str>, statement: &dyn Statement) -> Verdict {
    let about = match about(cx, subject) {
        Some(Ok(about)) => about,
        Some(Err(problem)) => return Verdict::undecided(problem.to_string()),
        None => return Verdict::undecided("the model names no such steady motion"),
    };
    if about.question.polynomial.is_none() {
        return match about.question.over {
            Some(symbol) => instead(cx, &about, statement, symbol),
            None => Verdict::undecided(format!(
                "the system has {} variables, and an exact characteristic polynomial is made of at most {VARIABLES}, of rational numbers of at most {LARGEST_IN_NUMBERS}",
                about.question.linear.variables.len()
            )),
        };
    }
    match about.question.over {
        Some(symbol) => match Pieces::new(cx, &about, statement, symbol) {
            Some(pieces) => pieces.verdict(&about, statement),
            None => instead(cx, &about, statement, symbol),
        },
        None => at_values(&about, statement),
    }
}

/// What is said where the boundaries in the parameter of the motion were not enclosed, as where it stands under a root: the statement at the values
/// that the model states.
fn instead(
    cx: &Context<'_>,
    about: &About<'_>,
    statement: &dyn Statement,
    symbol: Symbol,
) -> Verdict {
    let (system, motion) = (about.expansion.system, about.expansion.motion);
    let there = About::new(cx, motion, &values_but(system, None), None);
    let found = there.map(|there| at_values(&there, statement));
    let name = about.graph().symbol_text(symbol);
    let beyond = format!("nothing is said of other values of {name}, since the boundaries of stability in it were not enclosed");
    match found {
        Ok(Verdict::Proved(proof)) => Verdict::Proved(Proof::exact(
            format!(
                "for the values of the parameters that are stated, {}",
                stated_value(about, symbol)
            ),
            format!(
                "for {}: {}; {beyond}",
                stated_value(about, symbol),
                proof.detail
            ),
        )),
        Ok(Verdict::Refuted(own)) => Verdict::Refuted(Counterexample {
            detail: format!(
                "{} for {}; {beyond}",
                own.detail,
                stated_value(about, symbol)
            ),
            ..own
        }),
        Ok(found) if !matches!(found, Verdict::Undecided { .. }) => found,
        _ => Verdict::undecided(format!(
            "the boundaries of stability in {name} were not enclosed"
        )),
    }
}

/// `p = 2`, as the model states it.
fn stated_value(about: &About<'_>, symbol: Symbol) -> String {
    let g = about.graph();
    let own = g.symbol_expr(symbol);
    let value = g.substitute(own, &about.expansion.system.parameter_values());
    format!("{} = {}", g.text(own), g.text(value))
}

/// What the eigenvalues do at a value of the parameter; `None` where that was not decided, or there is no such motion.
pub(crate) fn place_exactly(
    cx: &Context<'_>,
    about: &About<'_>,
    (symbol, at): (Symbol, Expr),
) -> Option<Place> {
    let (system, motion) = (about.expansion.system, about.expansion.motion);
    let there = About::new(cx, motion, &values_at(system, symbol, at), None).ok()?;
    there.question.place_at(there.graph(), None)
}

/// Whether what the motion states has finite values for these values of the parameters.
fn exists(about: &About<'_>, values: &[(Expr, Expr)]) -> bool {
    let (g, motion) = (about.graph(), about.expansion.motion);
    let stated = motion.positions.iter().chain(&motion.velocities);
    let stated: Vec<Expr> = stated.filter_map(|value| *value).collect();
    let stated = g.substitute_all(&stated, values);
    let is_known = g.symbols_in(&stated).is_empty();
    !is_known || g.enclose(&stated, &Precision::new(128), &|_| None).is_ok()
}

/// Fractions are written with at most so many characters.
const LONGEST: usize = 24;

/// A number that is written in full by at most so many digits behind the point.
fn terminating(at: &RBig) -> Option<String> {
    let shift = RBig::from(IBig::from(10).pow(DIGITS));
    let scaled = at * shift;
    let digits = scaled.is_int().then(|| scaled.numerator().to_string())?;
    let (sign, digits) = match digits.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", digits.as_str()),
    };
    let digits = format!("{digits:0>width$}", width = DIGITS + 1);
    let (whole, rest) = digits.split_at(digits.len() - DIGITS);
    let written = format!("{sign}{whole}.{rest}");
    Some(written.trim_end_matches('0').trim_end_matches('.').into())
}

/// What is said where the model states a value for every parameter.
fn at_values(about: &About<'_>, statement: &dyn Statement) -> Verdict {
    let Some(place) = about.question.place_at(about.graph(), None) else {
        return Verdict::undecided(if about.question.is_mass_singular() {
            "the mass matrix is singular at the motion: the equations determine no accelerations there"
        } else {
            "the signs of Hurwitz's determinants were not decided"
        });
    };
    // Where no sign depends on a parameter without a value the eigenvalues lie so for all values; multiplicities and ranks are those of general ones.
    let general = match place {
        Place::Left | Place::Right => Vec::new(),
        Place::OnAxis | Place::NotLeft => about.general_parameters(),
    };
    let limited = |detail: String| of_general(detail, &general);
    match statement.said(about, place, None) {
        Said::Holds(why) => Verdict::Proved(Proof::exact(for_which(&general), limited(why))),
        Said::Open(why) => Verdict::undecided(why),
        Said::Fails => {
            let found = statement.counterexample(about, place, None);
            Verdict::Refuted(Counterexample {
                point: stated_values(about),
                detail: limited(found.detail),
                ..found
            })
        }
    }
}

/// The parameters with the values that the model states, exact where they are rational.
fn stated_values(about: &About<'_>) -> Vec<PointValue> {
    let (system, g) = (about.expansion.system, about.graph());
    let value = |(symbol, value): &(Expr, Expr)| {
        let exact = g.as_number(*value).cloned();
        let enclosure = match exact {
            Some(_) => None,
            None => {
                let ball = g
                    .enclose(&[*value], &Precision::new(128), &|_| None)
                    .ok()?
                    .pop()?;
                Some(ball.to_decimal_interval(20))
            }
        };
        Some(PointValue {
            name: g.text(*symbol),
            exact,
            enclosure,
        })
    };
    system.parameter_values().iter().filter_map(value).collect()
}

/// An open interval of the parameter.
struct Piece {
    low: RBig,
    high: RBig,
    sample: RBig,
    place: Place,
    said: Said,
}

/// A value of the parameter between two intervals.
struct Border {
    root: Root,
    /// Whether the statement holds there; `None` where that was not decided.
    holds: Option<bool>,
    /// Why it holds, where that does not follow from what is beside it.
    why: Option<String>,
    /// The value in closed form, as it is written.
    exact: Option<String>,
    /// There is no such motion, so that nothing fails.
    is_absent: bool,
    /// The model may not be smooth there, and nothing is said.
    is_corner: bool,
}

impl Border {
    fn know(&mut self, said: Option<Said>) {
        match said {
            Some(Said::Holds(why)) => (self.holds, self.why) = (Some(true), Some(why)),
            Some(Said::Fails) => self.holds = Some(false),
            Some(Said::Open(_)) | None => {}
        }
    }

    /// Where it is.
    fn place(&self, name: &str) -> String {
        self.root.place_of(name)
    }
}

/// All values of the parameter in parts.
struct Pieces {
    name: String,
    bound: RBig,
    pieces: Vec<Piece>,
    borders: Vec<Border>,
}

impl Pieces {
    fn new(
        cx: &Context<'_>,
        about: &About<'_>,
        statement: &dyn Statement,
        symbol: Symbol,
    ) -> Option<Pieces> {
        let (g, question) = (about.graph(), &about.question);
        let further = statement.further(about);
        let further: Vec<Expr> = further
            .into_iter()
            .filter(|&e| g.as_number(e).is_none() && !g.symbols_in(&[e]).is_empty())
            .collect();
        let admitted =
            AdmissibleValues::new(about.expansion.system, &about.expansion.found, symbol);
        let cutting = [further.clone(), admitted.functions()].concat();
        let mut bound = question.bound(g)?;
        if !cutting.is_empty() {
            bound = bound.max(bound_of(g, &cutting, symbol)?);
        }
        let low = -bound.clone();
        let enclosed = |halvings: usize| {
            let ranges = question.ranges_within(g, (&low, &bound), halvings)?;
            let mut cuts = Vec::new();
            for &e in &cutting {
                cuts.extend(zeros_of_factors(g, e, symbol, (&low, &bound), halvings)?);
            }
            Some((ranges, cuts))
        };
        let are_apart = |(ranges, cuts): &(Ranges, Vec<Zero>)| {
            ranges.are_apart && !overlap(&[ranges.zeros.clone(), cuts.clone()].concat())
        };
        let usual = enclosed(USUAL)?;
        let (ranges, cuts) = if are_apart(&usual) {
            usual
        } else {
            enclosed(FINE)?
        };
        let cuts = cuts.into_iter().map(|own| own.root).collect();
        let mut own = Pieces {
            name: g.symbol_text(symbol),
            bound,
            pieces: Vec::new(),
            borders: Vec::new(),
        };
        let functions = [question.boundary_functions(g), further].concat();
        own.cut(about, statement, &ranges, (cuts, &admitted, &functions))?;
        for border in &mut own.borders {
            border.is_corner = admitted.has_corner(g, &border.root);
        }
        own.decide_borders(cx, about, statement, (symbol, &ranges, &functions));
        Some(own)
    }

    /// The intervals between all boundaries, of those that are admitted. A cut inside of an enclosure of a boundary belongs to it. `None` where
    /// it was not decided what is admitted.
    fn cut(
        &mut self,
        about: &About<'_>,
        statement: &dyn Statement,
        ranges: &Ranges,
        (mut cuts, admitted, functions): (Vec<Root>, &AdmissibleValues, &[Expr]),
    ) -> Option<()> {
        let g = about.graph();
        cuts.extend(ranges.boundaries.iter().map(|b| b.root.clone()));
        let mut roots = joined(cuts);
        let low = -self.bound.clone();
        let lows = std::iter::once(&low).chain(roots.iter().map(|r| &r.high));
        let highs = roots.iter().map(|r| &r.low).chain([&self.bound]);
        for (a, b) in lows.zip(highs).filter(|(a, b)| a < b) {
            let sample = (a + b) / RBig::from(2);
            let around = ranges.regions.iter();
            let region = around.clone().find(|r| r.low <= *a && *b <= r.high);
            let Some(place) = region.map(|r| about.question.place_in(r)) else {
                continue;
            };
            if !admitted.contains(g, &sample)? {
                continue;
            }
            self.pieces.push(Piece {
                low: a.clone(),
                high: b.clone(),
                said: statement.said(about, place, Some(&sample)),
                sample,
                place,
            });
        }
        let border = |root| Border {
            root,
            holds: None,
            why: None,
            exact: None,
            is_absent: false,
            is_corner: false,
        };
        roots.retain(|root| admitted.contains_root(g, root, functions) != Some(false));
        self.borders = roots.into_iter().map(border).collect();
        Some(())
    }

    /// What holds where a determinant vanishes follows from the statement, or is decided at the value where that is known exactly.
    fn decide_borders(
        &mut self,
        cx: &Context<'_>,
        about: &About<'_>,
        statement: &dyn Statement,
        (symbol, ranges, functions): (Symbol, &Ranges, &[Expr]),
    ) {
        let (motion, system) = (about.expansion.motion, about.expansion.system);
        let exactly = |at: Expr| -> Option<Said> {
            let values = values_at(system, symbol, at);
            let mut there = About::new(cx, motion, &values, None).ok()?;
            if statement.uses_integrals() {
                there.inherited = about.bundles_at((symbol, at));
            }
            let place = there.question.place_at(there.graph(), None)?;
            Some(statement.said(&there, place, None))
        };
        for border in &mut self.borders {
            let root = &border.root.clone();
            let exact = closed_form(about.graph(), (symbol, root), functions);
            border.exact = exact.map(|at| about.graph().text(at));
            if exact.is_some_and(|at| !exists(about, &values_at(system, symbol, at))) {
                (border.holds, border.is_absent) = (Some(true), true);
                continue;
            }
            let of_spectrum = ranges.boundaries.iter().find(|own| own.root == *root);
            let boundary = of_spectrum.cloned().unwrap_or_else(|| Boundary {
                root: root.clone(),
                // All eigenvalues are as they are beside it.
                crossing: Crossing::Touching,
            });
            if border.is_corner {
                continue;
            }
            border.know(statement.at_boundary(about, &boundary));
            if border.holds.is_some() {
                continue;
            }
            let holds = |piece: &Piece| {
                (piece.high == root.low || piece.low == root.high)
                    && matches!(piece.said, Said::Holds(_))
            };
            let meets = |own: &&crate::hurwitz::Boundary| {
                own.root.low <= root.high && root.low <= own.root.high
            };
            let own: Vec<Crossing> = ranges
                .boundaries
                .iter()
                .filter(meets)
                .map(|own| own.crossing)
                .collect();
            let crossing = match own[..] {
                [] => None,
                [one] => Some(one),
                _ => Some(Crossing::Touching),
            };
            let is_finite =
                !own.contains(&Crossing::Infinity) && !own.contains(&Crossing::Singular);
            let beside = is_finite && self.pieces.iter().any(holds);
            border.holds = statement.at_border(beside, crossing);
            let is_rational = root.low == root.high;
            if border.holds.is_none() && (is_rational || statement.looks_at_boundaries()) {
                border.know(exact.and_then(exactly));
            }
        }
    }

    fn verdict(&self, about: &About<'_>, statement: &dyn Statement) -> Verdict {
        let reasons: BTreeSet<&str> = self
            .pieces
            .iter()
            .filter_map(|piece| match &piece.said {
                Said::Holds(why) => Some(why.as_str()),
                _ => None,
            })
            .collect();
        let of_borders = self.borders.iter().filter_map(|own| {
            let why = own.why.as_deref().filter(|why| !reasons.contains(why));
            why.map(|why| format!("at {}: {why}", own.place(&self.name)))
        });
        let own: Vec<String> = of_borders.collect();
        let reasons: Vec<&str> = reasons
            .into_iter()
            .chain(own.iter().map(String::as_str))
            .collect();
        let open = self.pieces.iter().find_map(|piece| match &piece.said {
            Said::Open(why) => Some(why),
            _ => None,
        });
        let condition = self.condition();
        if let Some(why) = open {
            let mut known = String::new();
            if !condition.is_empty() {
                known = format!("true for {condition}; ");
            }
            let failing = self.intervals(|said| *said == Said::Fails);
            if !failing.is_empty() {
                known = format!("{known}false for {failing}; ");
            }
            let mut open = self.intervals(|said| matches!(said, Said::Open(_)));
            for border in self.borders.iter().filter(|b| b.holds.is_none()) {
                let _ = write!(open, " and at {}", border.place(&self.name));
            }
            return Verdict::undecided(format!("{known}not decided for {open}: {why}"));
        }
        let counterexample = self.failing(about).map(|(piece, at)| {
            let own = statement.counterexample(about, piece.place, Some(&at));
            Counterexample {
                point: vec![PointValue {
                    name: self.name.clone(),
                    exact: Some(at.clone()),
                    enclosure: None,
                }],
                detail: self.placed(own.detail, &at),
                ..own
            }
        });
        let alone = self.borders.iter().filter(|b| b.holds.is_none());
        let alone: Vec<String> = alone.map(|b| b.place(&self.name)).collect();
        if condition.is_empty() && counterexample.is_some() && !alone.is_empty() {
            let failing = self.intervals(|said| *said == Said::Fails);
            return match counterexample {
                Some(own) => Verdict::Refuted(Counterexample {
                    detail: format!(
                        "{}; false for {failing}, and not decided at {}",
                        own.detail,
                        alone.join(", ")
                    ),
                    ..own
                }),
                None => Verdict::undecided(format!("not decided at {}", alone.join(", "))),
            };
        }
        let is_everywhere = self.borders.iter().all(|b| b.holds == Some(true));
        match (condition.is_empty(), counterexample) {
            (true, Some(own)) => Verdict::Refuted(own),
            (true, None) => Verdict::undecided("no interval is left between the boundaries"),
            (false, None) if is_everywhere => Verdict::Proved(Proof::exact(
                "at the steady motion, for all values for which it and the equations are defined",
                reasons.join("; "),
            )),
            (false, counterexample) => Verdict::Conditional {
                condition,
                proof: Proof::exact(
                    "at the steady motion",
                    format!("{}{}", reasons.join("; "), self.enclosures()),
                ),
                counterexample,
            },
        }
    }

    /// What is said of one value, which for others may be another reason.
    fn placed(&self, detail: String, at: &RBig) -> String {
        let mut failing = self.pieces.iter().filter(|own| own.said == Said::Fails);
        let first = failing.next().map(|own| own.place);
        if failing.all(|own| Some(own.place) == first) {
            detail
        } else {
            format!("at {} = {}: {detail}", self.name, decimal(at))
        }
    }

    /// Where the statement holds, in words: `4.29 < v < 6.02 or v > 8`.
    fn condition(&self) -> String {
        let mut parts: Vec<String> = Vec::new();
        let mut from: Option<(&RBig, bool)> = None;
        for (at, piece) in self.pieces.iter().enumerate() {
            if !matches!(piece.said, Said::Holds(_)) {
                continue;
            }
            let is_in = |end: &RBig| {
                let mut own = self.borders.iter();
                own.any(|b| (b.root.low == *end || b.root.high == *end) && b.holds == Some(true))
            };
            let start = *from.get_or_insert((&piece.low, is_in(&piece.low)));
            let next = self.pieces.get(at + 1);
            let goes_on =
                next.is_some_and(|next| is_in(&piece.high) && matches!(next.said, Said::Holds(_)));
            if !goes_on {
                parts.push(self.interval(start, (&piece.high, is_in(&piece.high))));
                from = None;
            }
        }
        let alone = self.borders.iter().filter(|b| {
            let touches = |piece: &Piece| piece.high == b.root.low || piece.low == b.root.high;
            let mut beside = self.pieces.iter().filter(|piece| touches(piece));
            b.holds == Some(true)
                && !b.is_absent
                && beside.all(|piece| !matches!(piece.said, Said::Holds(_)))
        });
        let alone = alone.map(|b| match &b.exact {
            _ if b.root.low == b.root.high => {
                format!("{} = {}", self.name, self.decimal(&b.root.low))
            }
            Some(exact) => format!("{} = {exact}", self.name),
            None => b.place(&self.name),
        });
        parts.extend(alone);
        parts.join(" or ")
    }

    /// `4.29 < v <= 6.02`, each end with whether it belongs to the interval.
    fn interval(&self, (low, is_low): (&RBig, bool), (high, is_high): (&RBig, bool)) -> String {
        let name = &self.name;
        let sign =
            |strict: &'static str, weak: &'static str, is_in| if is_in { weak } else { strict };
        let (from, to) = (*low != -self.bound.clone(), *high != self.bound);
        let (less, upper) = (sign("<", "<=", is_low), sign("<", "<=", is_high));
        match (from, to) {
            (true, true) => format!(
                "{} {less} {name} {upper} {}",
                self.decimal(low),
                self.decimal(high)
            ),
            (true, false) => format!("{name} {} {}", sign(">", ">=", is_low), self.decimal(low)),
            (false, true) => format!("{name} {upper} {}", self.decimal(high)),
            (false, false) => format!("{name} is any number"),
        }
    }

    /// A value as a person reads it: as it is where it is known, else with as many digits as tell it from other borders.
    fn decimal(&self, at: &RBig) -> String {
        let is_exact = |b: &&Border| b.root.low == *at && b.root.high == *at;
        if self.borders.iter().any(|b| is_exact(&b)) {
            let fraction = || Some(at.to_string()).filter(|text| text.len() <= LONGEST);
            if let Some(text) = terminating(at).or_else(fraction) {
                return text;
            }
        }
        let own = decimal(at);
        let is_same = |b: &&Border| [&b.root.low, &b.root.high].map(decimal).contains(&own);
        if self.borders.iter().filter(is_same).count() < 2 {
            return own;
        }
        terminating(at).unwrap_or_else(|| {
            let ball = Precision::new(BITS).rational(at);
            without_power(&ball.to_decimal_interval(DIGITS).0)
        })
    }

    /// An interval in which the statement fails, and a value there: the one that the model states where it is among them.
    fn failing(&self, about: &About<'_>) -> Option<(&Piece, RBig)> {
        let mut values = stated_values(about).into_iter();
        let stated = values.find(|value| value.name == self.name);
        let stated = stated.and_then(|value| value.exact);
        let mut failing = self.pieces.iter().filter(|p| p.said == Said::Fails);
        let own = stated.and_then(|at| {
            // Beyond the bound nothing changes any more.
            let (first, last) = (-self.bound.clone(), &self.bound);
            let holds_at =
                |p: &&Piece| (p.low < at || p.low == first) && (at < p.high || p.high == *last);
            let piece = failing.clone().find(holds_at)?;
            Some((piece, at))
        });
        own.or_else(|| failing.next().map(|piece| (piece, piece.sample.clone())))
    }

    /// The intervals of which something is known.
    fn intervals(&self, is_so: impl Fn(&Said) -> bool) -> String {
        let own = self.pieces.iter().filter(|piece| is_so(&piece.said));
        let own = own.map(|p| self.interval((&p.low, false), (&p.high, false)));
        own.collect::<Vec<_>>().join(" or ")
    }

    /// Every border with its enclosure, and those at which the statement was not decided.
    fn enclosures(&self) -> String {
        let name = &self.name;
        let text = |border: &Border| border.place(name);
        let all: Vec<String> = self.borders.iter().map(text).collect();
        let open: Vec<String> = self
            .borders
            .iter()
            .filter(|b| b.holds.is_none())
            .map(text)
            .collect();
        let all = match all.as_slice() {
            [] => String::new(),
            all => format!("; the borders are {}", all.join(", ")),
        };
        match open.as_slice() {
            [] => all,
            open => format!("{all}; nothing is said at {}", open.join(", ")),
        }
    }
}
