//! What was asked of a steady motion, in words and columns for a terminal.

use super::decimal::{decimal_polynomial, notation, value};
use super::{named_parts, Eigenvalues, Mode, Numbers, Stability};
use crate::decimals::Decimals;
use chetaev_mechanics::system::Parameter;
use chetaev_stability::characteristic::{LARGEST, LARGEST_IN_NUMBERS};
use chetaev_stability::eigenvalues::{unreached, Unreached};
use chetaev_stability::hurwitz::{Boundary, Crossing};
use chetaev_stability::multiplicity::defects;
use chetaev_stability::question::Place;
use chetaev_stability::real_roots::decimal;
use chetaev_stability::spectrum::expression;
use chetaev_symbolic::{Expr, Graph};
use std::fmt::Write as _;

impl Stability {
    /// Linear equations, polynomial and eigenvalues as text.
    pub fn linear_text(&self) -> String {
        let g = self.graph();
        let linear = &self.question.linear;
        let mut text = self.heading();
        let _ = writeln!(
            text,
            "\nE z' = F z with z = ({}), deviations from the motion:\n",
            linear.names.join(", ")
        );
        for (name, rows) in [("E", &linear.left), ("F", &linear.right)] {
            text.push_str(&matrix(g, name, rows));
        }
        for (name, slopes) in &linear.dependent {
            let terms = linear
                .names
                .iter()
                .zip(slopes)
                .filter(|(_, e)| !g.is_zero(**e));
            let terms: Vec<String> = terms
                .map(|(own, e)| format!("({}) {own}", notation(g, *e)))
                .collect();
            let sum = if terms.is_empty() {
                "0".into()
            } else {
                terms.join(" + ")
            };
            let _ = writeln!(
                text,
                "\nThe finite constraints give the deviation of {name}: {sum}"
            );
        }
        text.push_str(&self.space_text());
        text.push_str(&self.all_text());
        text.push_str(&self.parts_text());
        text.push_str(&self.polynomial_text());
        text.push_str(&self.modes_text());
        text
    }

    /// A, B, C, D as text, with what inputs reach and outputs show, and the transfer functions.
    fn space_text(&self) -> String {
        let (g, space) = (self.graph(), &self.space);
        let mut text = String::from("\nz' = A z + B u, y = C z + D u");
        let _ = writeln!(
            text,
            " with u = ({}), y = ({}):\n",
            space.inputs.join(", "),
            space.outputs.join(", ")
        );
        text.push_str(&matrix(g, "A", &space.a));
        if space.inputs.is_empty() && space.outputs == space.states {
            return text;
        }
        for (name, rows) in [("B", &space.b), ("C", &space.c), ("D", &space.d)] {
            if rows.iter().any(|row| !row.is_empty()) {
                text.push_str(&matrix(g, name, rows));
            }
        }
        let n = space.states.len();
        let (reached, seen) = space.ranks(g);
        if !space.inputs.is_empty() {
            let _ = writeln!(
                text,
                "\nThe inputs reach {reached} of {n} dimensions, the outputs show {seen}"
            );
        }
        if space.inputs.is_empty() && seen < n {
            let _ = writeln!(text, "\nThe outputs show {seen} of {n} dimensions");
        }
        let [a, b, c] = [&space.a, &space.b, &space.c].map(|own| self.numbers(own, self.stated()));
        if !space.inputs.is_empty() && reached < n {
            text.push_str(&unreached_text(&a, &b, "reached"));
        }
        if seen < n {
            // What outputs do not show, inputs do not reach in the transposed equations (Kalman 1960).
            let (a, c) = (transposed(&a, n), transposed(&c, n));
            text.push_str(&unreached_text(&a, &c, "seen"));
        }
        for (output, row) in space
            .outputs
            .iter()
            .zip(space.transfer(g).unwrap_or_default())
        {
            for (input, e) in space.controls().iter().zip(row) {
                let _ = writeln!(text, "  {}/{input} = {}", as_factor(output), shown(g, e));
            }
        }
        text
    }

    /// The equations in all variables.
    fn all_text(&self) -> String {
        let Some(all) = &self.all else {
            return String::new();
        };
        let (g, space) = (self.graph(), &all.space);
        let mut text = format!(
            "\nIn all variables E z' = A z + B u, y = C z + D u with z = ({}), u = ({}), y = ({}); the finite eigenvalues are those below{}:\n\n",
            space.states.join(", "),
            space.inputs.join(", "),
            space.outputs.join(", "),
            match all.zeros {
                Some(0) => String::new(),
                Some(1) => " and a zero of the ignorable coordinates".into(),
                Some(count) => format!(" and {count} zeros of the ignorable coordinates"),
                None => " and those of the ignorable coordinates".into(),
            }
        );
        text.push_str(&matrix(g, "E", &all.left));
        text.push_str(&matrix(g, "A", &space.a));
        for (name, rows) in [("B", &space.b), ("C", &space.c), ("D", &space.d)] {
            let is_written = name != "C" || space.outputs != space.states;
            if is_written && rows.iter().any(|row| !row.is_empty()) {
                text.push_str(&matrix(g, name, rows));
            }
        }
        text
    }

    /// The parts of second order that do not vanish.
    fn parts_text(&self) -> String {
        let Some(parts) = &self.parts else {
            return String::new();
        };
        let g = self.graph();
        let mut text = format!(
            "\nM q'' + (D + G) q' + (K + N) q = 0 with q = ({}); mass, damping, gyroscopic, stiffness, circulatory:\n\n",
            parts.names.join(", ")
        );
        for (name, rows) in named_parts(parts) {
            if rows.iter().flatten().any(|&e| !g.is_zero(e)) {
                text.push_str(&matrix(g, name, rows));
            }
        }
        text
    }

    /// Eigenvalues, each with its mode, and the chains of those on the axis that are not semisimple.
    fn modes_text(&self) -> String {
        let mut text = self.eigenvalues_text();
        let list = defects(self.graph(), &self.question, None).unwrap_or_default();
        for own in &list {
            let what = if own.factor.is_some() {
                "an imaginary pair"
            } else {
                "zero"
            };
            let _ = writeln!(
                text,
                "A Jordan block: {what} has multiplicity {} and {} eigenvectors",
                own.multiplicity, own.chains
            );
        }
        let modes = self.modes();
        text.push_str(&blocks(&modes, list.is_empty()));
        if !modes.is_empty() {
            let _ = writeln!(text, "\nModes ({}):", self.question.linear.names.join(", "));
        }
        let decimals = decimals_of(&modes);
        for Mode {
            eigenvalue, vector, ..
        } in modes
        {
            let (eigenvalue, vector) = (decimals.complex(eigenvalue), complex(&vector));
            let _ = writeln!(text, "  {eigenvalue}: ({})", vector.join(", "));
        }
        text
    }

    fn heading(&self) -> String {
        let linear = &self.question.linear;
        let mut text = format!(
            "{}, steady motion `{}`\n",
            self.system.name, self.motion.name
        );
        if !linear.ignorable.is_empty() {
            let _ = writeln!(
                text,
                "Ignorable, nothing depends on them: {}",
                linear.ignorable.join(", ")
            );
        }
        text.push_str(&self.along_text());
        text.push_str(&self.running_text());
        if linear.family > 0 {
            let _ = writeln!(
                text,
                "The motion belongs to a family of steady motions of dimension {}, proved",
                linear.family
            );
        }
        if let Some(why) = self.numbers {
            let _ = writeln!(text, "{}", self.of_numbers(why));
        }
        for (name, definition) in &linear.speeds {
            let written = notation(self.graph(), *definition);
            if *name != written {
                let _ = writeln!(text, "{name} = {written}");
            }
        }
        text
    }

    /// The values along the motion, but the rates of what runs on.
    fn along_text(&self) -> String {
        let g = self.graph();
        let runs = |name: &str| self.running.iter().any(|own| format!("{}'", own.0) == name);
        let is_velocity = |name: &str| name.ends_with('\'');
        let is_named = |own: &&(String, Expr)| {
            if g.is_zero(own.1) {
                !is_velocity(&own.0) && self.along.len() <= MOST_ZEROS
            } else {
                !runs(&own.0)
            }
        };
        let named: Vec<String> = self
            .along
            .iter()
            .filter(is_named)
            .map(|(name, e)| format!("{name} = {}", shown(g, *e)))
            .collect();
        let others = if self.along.len() <= MOST_ZEROS {
            "velocities that are not named are 0"
        } else {
            "positions and velocities that are not named are 0"
        };
        if named.is_empty() {
            String::new()
        } else {
            format!("At {}; {others}\n", named.join(", "))
        }
    }

    /// In which frame the deviations are measured, where coordinates run on.
    fn running_text(&self) -> String {
        let g = self.graph();
        let rate = |(name, e): &(String, Expr)| format!("{name}' = {}", notation(g, *e));
        let rates: Vec<String> = self.running.iter().map(rate).collect();
        if rates.is_empty() {
            return String::new();
        }
        format!(
            "Running on uniformly: {}; deviations and eigenvalues are those of the other coordinates as the model defines them, and in axes that turn otherwise they may be others\n",
            rates.join(", ")
        )
    }

    /// What is said where no parameter is left in.
    fn of_numbers(&self, why: Numbers) -> String {
        let of = |p: &Parameter| Some(format!("{} = {}", p.name, self.graph().text(p.value?)));
        let values: Vec<String> = self.system.parameters.iter().filter_map(of).collect();
        let reason = match why {
            Numbers::Asked => "",
            Numbers::TooLarge => "The linear equations in symbols are too large to be printed.\n",
            Numbers::SteadyThere => {
                "The motion is steady at these values of the parameters, and not at all others.\n"
            }
        };
        match values.as_slice() {
            [] => format!("{reason}Exact numbers: the model has no parameters"),
            own => format!("{reason}Numbers, exact for {}", own.join(", ")),
        }
    }

    fn polynomial_text(&self) -> String {
        let g = self.graph();
        let Some(polynomial) = &self.question.polynomial else {
            return self.without_polynomial();
        };
        let mut text = String::from("\nCharacteristic polynomial");
        match polynomial.zeros {
            0 => {}
            1 => text.push_str(", without the zero of the family of steady motions"),
            n => {
                let _ = write!(
                    text,
                    ", without the {n} zeros of the family of steady motions"
                );
            }
        }
        text.push_str(":\n");
        let shifted = polynomial.further_zeros;
        let coefficients = self.coefficients().unwrap_or_default();
        for (power, &e) in coefficients.iter().enumerate().rev() {
            let _ = writeln!(text, "  λ^{}: {}", power + shifted, shown(g, e));
        }
        let factors = &self.question.spectrum.factors;
        if factors.len() > 1 || factors.iter().any(|(_, power)| *power > 1) {
            let factor = |(f, power): &(Vec<Expr>, u32)| {
                let symbol = g.intern_symbol("λ", 0);
                let written = notation(g, expression(g, symbol, f));
                match power {
                    1 => format!("({written})"),
                    power => format!("({written})^{power}"),
                }
            };
            let list: Vec<String> = factors.iter().map(factor).collect();
            let _ = writeln!(text, "  its factors: {}", list.join(" "));
        }
        text
    }

    /// Why there is no exact polynomial.
    fn without_polynomial(&self) -> String {
        let n = self.question.linear.variables.len();
        let known = format!("\nNo exact characteristic polynomial: with symbols or roots it is made of at most {LARGEST} variables, of rational numbers of at most {LARGEST_IN_NUMBERS}, and here are {n}.");
        let hint = if n <= LARGEST_IN_NUMBERS && self.numbers.is_none() {
            " `--numbers` puts in the values of all parameters."
        } else {
            ""
        };
        format!("{known}{hint}\n")
    }

    fn eigenvalues_text(&self) -> String {
        let mut text = match (self.question.over, self.stated()) {
            (Some(symbol), Some(value)) => format!(
                "\nEigenvalues at {} = {value}:\n",
                self.graph().symbol_text(symbol)
            ),
            _ => "\nEigenvalues:\n".into(),
        };
        match self.eigenvalues_at(self.stated_exactly()) {
            Some(list) => eigenvalues(&list).iter().for_each(|l| {
                let _ = writeln!(text, "  {l}");
            }),
            None => text.push_str("  not computed: a parameter has no value, or E is singular\n"),
        }
        text
    }

    /// Stability over the range as text, with a table of eigenvalues.
    pub fn ranges_text(&self) -> String {
        let mut text = self.heading();
        let Some(range) = &self.range else {
            text.push_str(&self.polynomial_text());
            text.push_str(&self.eigenvalues_text());
            text.push_str(&self.place_text());
            text.push_str("\nWhat is proved of the stability of motions that the model names: `chetaev study --claims stability`; over a range of a parameter: `--over NAME=FROM:TO`.\n");
            return text;
        };
        let name = &range.name;
        text.push('\n');
        match &self.ranges {
            None => {
                let _ = writeln!(
                    text,
                    "The boundaries of stability in {name} were not enclosed."
                );
            }
            Some(ranges) => {
                for (region, is_absent) in ranges.regions.iter().zip(&self.absent) {
                    let place = match self.question.place_in(region) {
                        _ if *is_absent => "no such motion: what it states is not real, or not what the model assumes",
                        Place::Left if self.question.linear.family > 0 => "stable: all eigenvalues but the zeros of the family are left of the axis",
                        Place::Left => "stable: all eigenvalues are left of the axis",
                        Place::OnAxis => self.on_axis(),
                        Place::Right => "unstable: an eigenvalue is right of the axis",
                        Place::NotLeft => "not decided: two eigenvalues are opposite, or one is zero, for all values",
                    };
                    let _ = writeln!(
                        text,
                        "{} < {name} < {}: {place}",
                        decimal(&region.low),
                        decimal(&region.high)
                    );
                }
                for boundary in &ranges.boundaries {
                    let _ = writeln!(
                        text,
                        "{}: {}",
                        boundary.root.place_of(name),
                        self.crossing(boundary)
                    );
                    let said = self.first_lyapunov(boundary).map(|found| match found {
                        Ok(own) => crate::follow::hopf(own.frequency, own.coefficient),
                        Err(why) => why.to_string(),
                    });
                    if let Some(said) = said {
                        let _ = writeln!(text, "  {said}");
                    }
                }
            }
        }
        let _ = writeln!(text, "\nEigenvalues");
        for (value, list) in self.table(range) {
            let list = list.map_or_else(|| vec!["no such motion".into()], |own| eigenvalues(&own));
            let _ = writeln!(text, "  {name} = {value:<8}  {}", list.join("  "));
        }
        text
    }

    /// Whether eigenvalues on the axis have as many eigenvectors as their multiplicity, for general values of the parameter; `None` where that was not
    /// decided.
    pub(super) fn is_semisimple(&self) -> Option<bool> {
        defects(self.graph(), &self.question, None).map(|list| list.is_empty())
    }

    /// What is said of linear motions where no eigenvalue is right of the axis, for general values of the parameter.
    fn on_axis(&self) -> &'static str {
        match self.is_semisimple() {
            Some(true) => "no eigenvalue right of the axis, those on it semisimple: linear motions stay bounded",
            Some(false) => "no eigenvalue right of the axis, but one on it has fewer eigenvectors than its multiplicity: linear motions grow as a power of the time, but perhaps at single values",
            None => "no eigenvalue right of the axis; whether those on it are semisimple was not decided",
        }
    }

    /// Where the eigenvalues lie at the values that the model states, decided exactly; nothing where it was not.
    fn place_text(&self) -> String {
        let g = self.graph();
        let stated = self.stated_exactly();
        let at = stated.and_then(|e| g.as_number(e).cloned());
        if self.question.over.is_some() && at.is_none() {
            return String::new();
        }
        let said = match self.question.place_at(g, at.as_ref()) {
            Some(Place::Left) if self.question.linear.family > 0 => "All eigenvalues but the zeros of the family lie left of the axis, exactly.",
            Some(Place::Left) => "All eigenvalues lie left of the axis, exactly: the motion is asymptotically stable.",
            Some(Place::OnAxis) => "No eigenvalue lies right of the axis, and some lie on it, exactly: the linear equations alone do not decide.",
            Some(Place::Right) => "An eigenvalue lies right of the axis, exactly: the motion is unstable.",
            Some(Place::NotLeft) | None => return String::new(),
        };
        format!("\n{said}\n")
    }

    fn crossing(&self, boundary: &Boundary) -> &'static str {
        match boundary.crossing {
            Crossing::Zero => "an eigenvalue passes through zero",
            Crossing::ZeroTouching => {
                "an eigenvalue is zero there, and on both sides the stability is the same"
            }
            Crossing::Pair => "a pair of eigenvalues passes the imaginary axis",
            Crossing::Pairs => "several pairs of eigenvalues are on the imaginary axis at once",
            Crossing::Collision => "two pairs of eigenvalues meet",
            Crossing::Infinity => "an eigenvalue goes to infinity",
            Crossing::Singular => {
                "the mass matrix is singular there: the equations determine no accelerations"
            }
            Crossing::Touching => {
                "two eigenvalues are opposite, and nothing is said of that value alone"
            }
        }
    }
}

/// The eigenvalues that have fewer modes than their multiplicity, off the axis, and on it where nothing was said of those.
fn blocks(modes: &[Mode], with_axis: bool) -> String {
    let decimals = decimals_of(modes);
    let size = |(re, im): (f64, f64)| re.hypot(im);
    let largest = modes.iter().map(|own| size(own.eigenvalue));
    let largest = largest.fold(0.0, f64::max);
    let mut text = String::new();
    for own in modes.chunk_by(|a, b| a.eigenvalue == b.eigenvalue) {
        let Mode {
            eigenvalue,
            multiplicity,
            ..
        } = own[0];
        let is_asked = with_axis || eigenvalue.0.abs() > ON_AXIS * largest;
        if is_asked && own.len() < multiplicity {
            let vectors = if own.len() == 1 {
                "eigenvector"
            } else {
                "eigenvectors"
            };
            let _ = writeln!(
                text,
                "A Jordan block: the eigenvalue {} has multiplicity {multiplicity} and {} {vectors}",
                decimals.complex(eigenvalue),
                own.len()
            );
        }
    }
    text
}

/// Real parts that are smaller in parts of the largest eigenvalue are rounding.
const ON_AXIS: f64 = 1e-9;

fn decimals_of(modes: &[Mode]) -> Decimals {
    let are_enclosed = modes.iter().all(|own| own.is_enclosed);
    Decimals::of(modes.iter().map(|own| own.eigenvalue)).exact_if(are_enclosed)
}

fn eigenvalues(own: &Eigenvalues) -> Vec<String> {
    let decimals = Decimals::of(own.values.iter().copied()).exact_if(own.are_enclosed);
    own.values.iter().map(|l| decimals.complex(*l)).collect()
}

fn complex(list: &[(f64, f64)]) -> Vec<String> {
    let decimals = Decimals::of(list.iter().copied());
    list.iter().map(|own| decimals.complex(*own)).collect()
}

/// Of more positions and velocities those that are zero are not named.
const MOST_ZEROS: usize = 32;

/// An output as the numerator of a quotient: a name as it is, all else in parentheses.
fn as_factor(output: &str) -> String {
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
    if output.chars().all(is_name) {
        output.into()
    } else {
        format!("({output})")
    }
}

/// The longest exact entry that is shown as it is.
const LONGEST: usize = 24;

/// An exact entry; where it is long, in decimal numbers, as a polynomial in the only symbol that occurs.
fn shown(g: &Graph, e: Expr) -> String {
    let exact = notation(g, e);
    if exact.len() <= LONGEST {
        return exact;
    }
    match g.symbols_in(&[e]).as_slice() {
        [] => value(g, e, &|_| None).map_or(exact, |value| format!("{value}")),
        only @ [_] => decimal_polynomial(g, e, only).unwrap_or(exact),
        _ => exact,
    }
}

/// The eigenvalues whose modes no input reaches, or no output shows, in numbers.
fn unreached_text(a: &[Vec<f64>], b: &[Vec<f64>], what: &str) -> String {
    let list = unreached(a, b).unwrap_or_default();
    let decimals = Decimals::of(
        list.iter()
            .map(|own| (own.eigenvalue.re, own.eigenvalue.im)),
    );
    let eigenvalue = |own: &Unreached| decimals.complex((own.eigenvalue.re, own.eigenvalue.im));
    let (whole, some): (Vec<Unreached>, Vec<Unreached>) =
        list.into_iter().partition(|own| own.count >= own.modes);
    let mut text = String::new();
    if !whole.is_empty() {
        let whole: Vec<String> = whole.iter().map(eigenvalue).collect();
        let _ = writeln!(
            text,
            "  the modes with the eigenvalues {} are not {what}",
            whole.join(", ")
        );
    }
    for own in &some {
        let _ = writeln!(
            text,
            "  of the {} independent modes with the eigenvalue {} {} {} not {what}",
            own.modes,
            eigenvalue(own),
            own.count,
            if own.count == 1 { "is" } else { "are" }
        );
    }
    text
}

/// The transpose of a matrix with so many columns.
fn transposed(rows: &[Vec<f64>], columns: usize) -> Vec<Vec<f64>> {
    let column = |c: usize| rows.iter().map(|row| row[c]).collect();
    (0..columns).map(column).collect()
}

/// A matrix in columns.
fn matrix(g: &Graph, name: &str, rows: &[Vec<Expr>]) -> String {
    let entries: Vec<Vec<String>> = rows
        .iter()
        .map(|row| row.iter().map(|&e| shown(g, e)).collect())
        .collect();
    let columns = entries.first().map_or(0, Vec::len);
    let width = |c: usize| {
        entries
            .iter()
            .map(|row| row[c].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for (r, row) in entries.iter().enumerate() {
        let head = if r == 0 {
            format!("  {name} = ")
        } else {
            " ".repeat(name.len() + 5)
        };
        let cells: Vec<String> = row
            .iter()
            .zip(&widths)
            .map(|(cell, w)| format!("{cell:>w$}", w = *w))
            .collect();
        let _ = writeln!(text, "{head}[{}]", cells.join("  "));
    }
    text
}
