//! Values of a parameter at which stability changes.

use crate::about::{about, closed_form, About};
use crate::admissible_values::AdmissibleValues;
use crate::decision::place_exactly;
use crate::evidence::motions;
use crate::hurwitz::{Boundary, Crossing, Ranges, Region};
use crate::isolation::Root;
use crate::question::{parameter_of_motion, Place};
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Symbol, Verdict};
use dashu_ratio::RBig;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// `stability.critical#p`: the values of p at which the stability of a motion that contains it changes.
#[derive(Clone, Copy, Debug)]
pub struct Critical;

impl Claim for Critical {
    fn id(&self) -> &'static str {
        "stability.critical"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "The values of the parameter at which the stability of steady motions changes are enclosed, all of them"
    }

    fn explanation(&self) -> &'static str {
        include_str!("critical.md")
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        parameters(cx).into_keys().map(Some).collect()
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        Vec::new()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let all = parameters(cx);
        let Some(names) = subject.and_then(|own| all.get(own)) else {
            return Verdict::undecided("no steady motion contains this parameter").into();
        };
        let said: Option<Vec<String>> = names.iter().map(|name| changes(cx, name)).collect();
        match said {
            Some(said) => Verdict::Proved(Proof::exact("for all values of the parameter, the others as stated", said.join("; "))).into(),
            None => Verdict::undecided("a motion is not steady for all values of the parameter, or the boundaries were not enclosed").into(),
        }
    }
}

/// The parameters of motions, each with the names of the motions that contain it.
fn parameters(cx: &Context<'_>) -> BTreeMap<String, Vec<String>> {
    let g = &cx.system.graph;
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let named: Vec<String> = motions(cx).into_iter().flatten().collect();
    for (motion, name) in cx.system.steady.iter().zip(named) {
        if let Some(symbol) = parameter_of_motion(cx.system, motion) {
            found.entry(g.symbol_text(symbol)).or_default().push(name);
        }
    }
    found
}

/// Where the stability of a motion changes, and how.
fn changes(cx: &Context<'_>, name: &str) -> Option<String> {
    let about = about(cx, Some(name))?.ok()?;
    let (g, question) = (about.graph(), &about.question);
    let symbol = question.over?;
    let admitted = AdmissibleValues::new(cx.system, &about.expansion.found, symbol);
    let ends = admitted.ends(g)?;
    let bound = question.bound(g)?;
    let over = Over {
        cx,
        about: &about,
        symbol,
        ranges: question.ranges(g, &-bound.clone(), &bound)?,
        functions: question.boundary_functions(g),
        admitted,
        ends,
    };
    let parameter = g.symbol_text(symbol);
    let mut listed = Vec::new();
    let mut open = Vec::new();
    let mut without_change = Vec::new();
    let is_admitted = |own: &&Boundary| {
        let found = over.admitted.contains_root(g, &own.root, &over.functions);
        found != Some(false)
    };
    for boundary in over.ranges.boundaries.iter().filter(is_admitted) {
        match over.change(boundary) {
            Change::Is(how) => listed.push(format!("{} ({how})", over.place(boundary))),
            Change::Perhaps(sides) => open.push((sides, over.place(boundary))),
            Change::Without(how) => {
                without_change.push(format!("{how} at {}", over.place(boundary)));
            }
            Change::None => {}
        }
    }
    listed.extend(over.across_gaps());
    let mut said = match listed.as_slice() {
        [] if over.admitted.functions().is_empty() => {
            format!("the spectral stability of {name} is the same for all {parameter}")
        }
        [] => format!(
            "the spectral stability of {name} is the same for all {parameter} that are assumed"
        ),
        list => format!(
            "the spectral stability of {name} changes at {}",
            list.join(", at ")
        ),
    };
    if !without_change.is_empty() {
        let _ = write!(
            said,
            "; without a change of stability {}",
            without_change.join(", ")
        );
    }
    for (sides, what) in [
        ("on both sides", "; on both sides of "),
        ("below", "; below "),
        ("above", "; above "),
    ] {
        let of = open.iter().filter(|own| own.0 == sides);
        let of: Vec<&str> = of.map(|own| own.1.as_str()).collect();
        if !of.is_empty() {
            let _ = write!(
                said,
                "{what}{} it is the same, and of that value alone nothing is said",
                of.join(" and of ")
            );
        }
    }
    Some(said)
}

/// A motion over all values of its parameter.
struct Over<'a, 'c> {
    cx: &'a Context<'c>,
    about: &'a About<'c>,
    symbol: Symbol,
    ranges: Ranges,
    /// At whose zeros the boundaries lie.
    functions: Vec<Expr>,
    /// Which values of the parameter are.
    admitted: AdmissibleValues,
    /// Where something that is assumed begins or ceases to hold.
    ends: Vec<Root>,
}

/// What is known of a boundary.
enum Change {
    /// The stability changes there, and how.
    Is(String),
    /// Something happens, and the stability is the same there and on both sides.
    Without(String),
    /// It may be another at that value alone, beside these.
    Perhaps(&'static str),
    /// It is the same there and on both sides.
    None,
}

impl Over<'_, '_> {
    fn change(&self, boundary: &Boundary) -> Change {
        let place = |own: &Region| self.about.question.place_in(own);
        let (root, regions) = (&boundary.root, &self.ranges.regions);
        let before = regions.iter().rfind(|r| r.high <= root.low);
        let before = before.filter(|own| self.is_admitted_below(&own.low, &root.low));
        let after = regions.iter().find(|r| r.low >= root.high);
        let after = after.filter(|own| self.is_admitted_above(&root.high, &own.high));
        let (before, after) = (before.map(place), after.map(place));
        let how = how(boundary.crossing);
        // What ends, or is left out, has values on one side.
        let (beside, sides) = match (before, after) {
            (Some(a), Some(b)) if a != b => {
                return Change::Is(format!("{how}{}", towards(before, after)));
            }
            (Some(beside), Some(_)) => (beside, "on both sides"),
            (Some(beside), None) => (beside, "below"),
            (None, Some(beside)) => (beside, "above"),
            (None, None) => return Change::None,
        };
        let same = |said: String| match boundary.crossing {
            Crossing::Touching => Change::None,
            // Nothing passes where there is no other side.
            _ if before.is_none() || after.is_none() => Change::None,
            _ => Change::Without(format!("{how}, {said}")),
        };
        let is_unstable =
            beside == Place::Right && self.about.question.is_unstable_at(self.about.graph(), root);
        if is_unstable {
            return same("unstable on both sides and there,".into());
        }
        // What is unstable on both sides may stand on the axis between, as a body at rest that no spin makes stable.
        let is_smooth = !self.admitted.has_corner(self.about.graph(), root);
        let exact = self.exact(boundary).filter(|_| is_smooth);
        let there = exact.and_then(|at| place_exactly(self.cx, self.about, (self.symbol, at)));
        match there {
            Some(there) if there == beside => {
                same(format!("{} on both sides and there,", word(beside)))
            }
            None => Change::Perhaps(sides),
            Some(Place::NotLeft) if beside != Place::Left => Change::Perhaps(sides),
            Some(there) => Change::Is(format!(
                "{} there alone, {} {sides}",
                word(there),
                word(beside)
            )),
        }
    }

    /// Where values are left out, and the stability is another one beyond them.
    fn across_gaps(&self) -> Vec<String> {
        let g = self.about.graph();
        let boundaries = self.ranges.boundaries.iter().map(|own| &own.root);
        let mut cuts: Vec<&Root> = boundaries.chain(&self.ends).collect();
        cuts.sort_by(|a, b| a.low.cmp(&b.low));
        let regions = &self.ranges.regions;
        let (Some(first), Some(last)) = (regions.first(), regions.last()) else {
            return Vec::new();
        };
        let lows = std::iter::once(&first.low).chain(cuts.iter().map(|own| &own.high));
        let highs = cuts.iter().map(|own| &own.low).chain([&last.high]);
        let mut found = Vec::new();
        // What is the case below, and where it ends.
        let mut below: Option<(Place, usize)> = None;
        for (at, (low, high)) in lows.zip(highs).enumerate().filter(|(_, (a, b))| a < b) {
            let sample = (low + high) / RBig::from(2);
            let region = regions.iter().find(|r| r.low <= sample && sample <= r.high);
            let Some(region) = region.filter(|_| self.is_admitted(sample.clone())) else {
                continue;
            };
            let place = self.about.question.place_in(region);
            if let Some((before, end)) = below.filter(|own| own.0 != place) {
                let one = cuts.get(end).filter(|_| end + 1 == at);
                let contains = |root: &&&Root| {
                    let found = self.admitted.contains_root(g, root, &self.functions);
                    found != Some(false) && !self.admitted.has_corner(g, root)
                };
                // What happens at a value that is admitted was said of it.
                if one.filter(contains).is_none() {
                    let name = g.symbol_text(self.symbol);
                    let from = cuts.get(end).map(|own| own.place_of(&name));
                    found.push(format!(
                        "{}, beyond which it is {}, {} before: between them values are left out",
                        from.unwrap_or_default(),
                        word(place),
                        word(before)
                    ));
                }
            }
            below = Some((place, at));
        }
        found
    }

    /// Whether values next to the upper end of an interval are admitted.
    fn is_admitted_below(&self, low: &RBig, at: &RBig) -> bool {
        let ends = self.ends.iter().map(|own| &own.high);
        let from = ends.filter(|end| *end < at).fold(low, Ord::max);
        self.is_admitted((from + at) / RBig::from(2))
    }

    /// Whether values next to the lower end of an interval are admitted.
    fn is_admitted_above(&self, at: &RBig, high: &RBig) -> bool {
        let ends = self.ends.iter().map(|own| &own.low);
        let to = ends.filter(|end| *end > at).fold(high, Ord::min);
        self.is_admitted((at + to) / RBig::from(2))
    }

    fn is_admitted(&self, at: RBig) -> bool {
        self.admitted.contains(self.about.graph(), &at) != Some(false)
    }

    /// The value in closed form.
    fn exact(&self, boundary: &Boundary) -> Option<Expr> {
        closed_form(
            self.about.graph(),
            (self.symbol, &boundary.root),
            &self.functions,
        )
    }

    /// The value, in closed form where it has one, and its enclosure.
    fn place(&self, boundary: &Boundary) -> String {
        let g = self.about.graph();
        let (name, root) = (g.symbol_text(self.symbol), &boundary.root);
        match self.exact(boundary).filter(|_| root.low != root.high) {
            Some(exact) => root.place_of(&format!("{name} = {}", g.text(exact))),
            None => root.place_of(&name),
        }
    }
}

/// Where the eigenvalues lie, in a word.
fn word(place: Place) -> &'static str {
    match place {
        Place::Left => "asymptotically stable",
        Place::OnAxis => "with all eigenvalues on the axis or left of it",
        Place::Right => "unstable",
        Place::NotLeft => "not asymptotically stable",
    }
}

/// What happens at a boundary, in words.
fn how(crossing: Crossing) -> &'static str {
    match crossing {
        Crossing::Zero => "an eigenvalue passes through zero",
        Crossing::ZeroTouching => "an eigenvalue is zero",
        Crossing::Pair => "a pair passes the imaginary axis",
        Crossing::Pairs => "several pairs are on the imaginary axis at once",
        Crossing::Infinity => "an eigenvalue goes to infinity",
        Crossing::Singular => "the mass matrix is singular",
        Crossing::Collision => "two imaginary pairs meet",
        Crossing::Touching => "two eigenvalues are opposite",
    }
}

/// What the motion becomes with a growing parameter.
fn towards(before: Option<Place>, after: Option<Place>) -> &'static str {
    match (before, after) {
        (Some(a), Some(b)) if a == b => "",
        (_, Some(Place::Right)) => ", unstable above",
        (Some(Place::Right), _) => ", unstable below",
        _ => "",
    }
}
