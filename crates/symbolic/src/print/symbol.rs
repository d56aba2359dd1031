//! A symbol as a person states it in LaTeX, `\dot\theta`: read, so that every output shows it and none is broken by it.
//!
//! Read are letters, digits, Greek letters, accents, `\mathrm` and its like around words, and sub- and superscripts, all of which MathML
//! shows as well.

use crate::syntax::names::greek_letter;

/// A symbol that was read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StatedSymbol {
    marks: Vec<Mark>,
}

/// A part of a symbol.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Mark {
    Letter(char),
    Digit(char),
    /// A command of LaTeX, and its sign.
    Sign(&'static str, char),
    /// A style and a word in it.
    Word(&'static str, String),
    /// An accent over a part.
    Accent(&'static str, Box<StatedSymbol>),
    /// What stands above, or below, the part before it.
    Script(char, Box<StatedSymbol>),
    Group(Box<StatedSymbol>),
}

/// Variants of letters, and signs that stand beside them.
const SIGNS: &[(&str, char)] = &[
    ("varphi", 'φ'),
    ("varepsilon", 'ε'),
    ("vartheta", 'ϑ'),
    ("varrho", 'ϱ'),
    ("varpi", 'ϖ'),
    ("varsigma", 'ς'),
    ("ell", 'ℓ'),
    ("hbar", 'ℏ'),
    ("imath", 'ı'),
    ("jmath", 'ȷ'),
    ("ast", '*'),
    ("star", '⋆'),
    ("prime", '′'),
    ("parallel", '∥'),
    ("perp", '⊥'),
    ("infty", '∞'),
    ("circ", '∘'),
    ("dagger", '†'),
];

/// Accents of LaTeX, and the signs of MathML.
const ACCENTS: &[(&str, &str)] = &[
    ("dot", "\u{2d9}"),
    ("ddot", "\u{a8}"),
    ("hat", "^"),
    ("tilde", "~"),
    ("bar", "¯"),
    ("vec", "→"),
    ("widehat", "^"),
    ("widetilde", "~"),
    ("overline", "¯"),
];

/// Styles of words.
const STYLES: &[&str] = &[
    "mathrm",
    "text",
    "mathit",
    "mathbf",
    "boldsymbol",
    "mathcal",
];

/// Why a symbol is not read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SymbolError {
    /// Nothing is written.
    #[error("there is no symbol")]
    Empty,
    /// A brace without its partner.
    #[error("`{0}` closes nothing")]
    ClosesNothing(char),
    /// A brace that stays open.
    #[error("a brace is not closed")]
    Open,
    /// A pair of braces with nothing in it.
    #[error("a pair of braces is empty")]
    EmptyGroup,
    /// Groups within each other.
    #[error("there are more than {DEEPEST} groups within each other")]
    TooDeep,
    /// A script without a symbol before it, or the second of its kind.
    #[error("`{0}` has no symbol of its own before it")]
    ScriptAlone(char),
    /// The end in place of a symbol.
    #[error("it ends where a symbol was to follow")]
    Ends,
    /// A sign that is none of a symbol.
    #[error("`{0}` is not read in a symbol")]
    Sign(char),
    /// A command that is none of a symbol.
    #[error("the command `\\{0}` is not read in a symbol")]
    Command(String),
    /// A style without a word.
    #[error("`\\{0}` has a word in braces behind it, of letters and digits")]
    Word(&'static str),
}

/// Groups within groups more than these are not read.
const DEEPEST: usize = 8;

impl StatedSymbol {
    /// Reads a symbol.
    ///
    /// # Errors
    /// [`SymbolError`], which says what is not read.
    pub fn read(text: &str) -> Result<StatedSymbol, SymbolError> {
        let mut reader = Reader {
            signs: text.trim().chars().collect(),
            at: 0,
        };
        let symbol = reader.row(0)?;
        match (reader.next(), symbol.marks.is_empty()) {
            (Some(sign), _) => Err(SymbolError::ClosesNothing(sign)),
            (None, true) => Err(SymbolError::Empty),
            (None, false) => Ok(symbol),
        }
    }

    /// Whether something stands where an exponent would.
    pub(crate) fn is_raised(&self) -> bool {
        self.marks
            .iter()
            .any(|mark| matches!(mark, Mark::Script('^', _) | Mark::Sign("prime", _)))
    }

    /// In LaTeX.
    pub(crate) fn latex(&self) -> String {
        let mut out = String::new();
        for mark in &self.marks {
            match mark {
                Mark::Letter(own) | Mark::Digit(own) => out.push(*own),
                Mark::Sign("prime", _) => out.push('\''),
                Mark::Sign(command, _) => out.push_str(&format!("\\{command} ")),
                Mark::Word(style, word) => out.push_str(&format!("\\{style}{{{word}}}")),
                Mark::Accent(command, own) => {
                    out.push_str(&format!("\\{command}{{{}}}", own.latex()));
                }
                Mark::Script(sign, own) => out.push_str(&format!("{sign}{{{}}}", own.latex())),
                Mark::Group(own) => out.push_str(&format!("{{{}}}", own.latex())),
            }
        }
        out.trim_end().to_owned()
    }

    /// In MathML, one element.
    pub(crate) fn mathml(&self) -> String {
        let mut parts: Vec<String> = Vec::new();
        let mut at = 0;
        while let Some(mark) = self.marks.get(at) {
            let own = match mark {
                Mark::Letter(own) | Mark::Sign(_, own) => format!("<mi>{own}</mi>"),
                Mark::Digit(own) => format!("<mn>{own}</mn>"),
                Mark::Word(_, word) => format!("<mi mathvariant=\"normal\">{word}</mi>"),
                Mark::Accent(command, own) => {
                    let known = ACCENTS.iter().find(|(name, _)| name == command);
                    let sign = known.map_or("", |(_, sign)| sign);
                    format!("<mover>{}<mo>{sign}</mo></mover>", own.mathml())
                }
                Mark::Group(own) => own.mathml(),
                // The reader begins no row with a script.
                Mark::Script(..) => String::new(),
            };
            at += 1;
            let mut scripts = [None, None];
            while let Some(Mark::Script(sign, own)) = self.marks.get(at) {
                scripts[usize::from(*sign == '^')] = Some(own.mathml());
                at += 1;
            }
            parts.push(match scripts {
                [None, None] => own,
                [Some(below), None] => format!("<msub>{own}{below}</msub>"),
                [None, Some(above)] => format!("<msup>{own}{above}</msup>"),
                [Some(below), Some(above)] => format!("<msubsup>{own}{below}{above}</msubsup>"),
            });
        }
        match parts.as_slice() {
            [only] => only.clone(),
            many => format!("<mrow>{}</mrow>", many.concat()),
        }
    }
}

struct Reader {
    signs: Vec<char>,
    at: usize,
}

impl Reader {
    fn next(&self) -> Option<char> {
        self.signs.get(self.at).copied()
    }

    fn skip_blanks(&mut self) {
        while self.next().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
    }

    /// Marks up to a closing brace or the end.
    fn row(&mut self, depth: usize) -> Result<StatedSymbol, SymbolError> {
        if depth > DEEPEST {
            return Err(SymbolError::TooDeep);
        }
        let mut marks: Vec<Mark> = Vec::new();
        loop {
            self.skip_blanks();
            match self.next() {
                None | Some('}') => return Ok(StatedSymbol { marks }),
                Some('\'') => {
                    self.at += 1;
                    marks.push(Mark::Sign("prime", '′'));
                }
                Some(sign @ ('_' | '^')) => {
                    self.at += 1;
                    self.script(sign, &mut marks, depth)?;
                }
                Some(_) => marks.push(self.mark(depth)?),
            }
        }
    }

    /// A sub- or superscript of the mark before it; each of them once.
    fn script(
        &mut self,
        sign: char,
        marks: &mut Vec<Mark>,
        depth: usize,
    ) -> Result<(), SymbolError> {
        let before = marks.iter().rev();
        let mut scripts = before.take_while(|mark| matches!(mark, Mark::Script(..)));
        let is_twice = scripts.any(|mark| matches!(mark, Mark::Script(own, _) if *own == sign));
        if is_twice || marks.is_empty() {
            return Err(SymbolError::ScriptAlone(sign));
        }
        self.skip_blanks();
        let own = self.mark(depth)?;
        let own = match own {
            Mark::Group(own) => own,
            mark => Box::new(StatedSymbol { marks: vec![mark] }),
        };
        marks.push(Mark::Script(sign, own));
        Ok(())
    }

    /// One letter, digit, command or group.
    fn mark(&mut self, depth: usize) -> Result<Mark, SymbolError> {
        let Some(sign) = self.next() else {
            return Err(SymbolError::Ends);
        };
        self.at += 1;
        match sign {
            '\\' => self.command(depth),
            '{' => Ok(Mark::Group(Box::new(self.group(depth)?))),
            '*' => Ok(Mark::Sign("ast", '*')),
            sign if sign.is_ascii_digit() => Ok(Mark::Digit(sign)),
            sign if sign.is_ascii_alphabetic() => Ok(Mark::Letter(sign)),
            sign => Err(SymbolError::Sign(sign)),
        }
    }

    /// What is in braces, the first of which was read.
    fn group(&mut self, depth: usize) -> Result<StatedSymbol, SymbolError> {
        let own = self.row(depth + 1)?;
        match self.next() {
            Some('}') if !own.marks.is_empty() => {
                self.at += 1;
                Ok(own)
            }
            Some('}') => Err(SymbolError::EmptyGroup),
            _ => Err(SymbolError::Open),
        }
    }

    fn command(&mut self, depth: usize) -> Result<Mark, SymbolError> {
        let begin = self.at;
        while self.next().is_some_and(|sign| sign.is_ascii_alphabetic()) {
            self.at += 1;
        }
        let name: String = self.signs[begin..self.at].iter().collect();
        if let Some(&(command, sign)) = SIGNS.iter().find(|(own, _)| *own == name) {
            return Ok(Mark::Sign(command, sign));
        }
        if let Some((command, sign)) = greek(&name) {
            return Ok(Mark::Sign(command, sign));
        }
        self.skip_blanks();
        if let Some(&(command, _)) = ACCENTS.iter().find(|(own, _)| *own == name) {
            let own = match self.mark(depth)? {
                Mark::Group(own) => own,
                mark => Box::new(StatedSymbol { marks: vec![mark] }),
            };
            return Ok(Mark::Accent(command, own));
        }
        match STYLES.iter().find(|own| **own == name) {
            Some(style) => self.word(style),
            None => Err(SymbolError::Command(name)),
        }
    }

    /// Letters and digits in braces.
    fn word(&mut self, style: &'static str) -> Result<Mark, SymbolError> {
        let end = self.signs[self.at..].iter().position(|sign| *sign == '}');
        let inside = match (self.next(), end) {
            (Some('{'), Some(end)) => self.signs[self.at + 1..self.at + end].to_vec(),
            _ => return Err(SymbolError::Word(style)),
        };
        self.at += inside.len() + 2;
        let is_word = |sign: &char| sign.is_ascii_alphanumeric() || *sign == ' ';
        if inside.is_empty() || !inside.iter().all(is_word) {
            return Err(SymbolError::Word(style));
        }
        Ok(Mark::Word(style, inside.into_iter().collect()))
    }
}

/// Greek letters that LaTeX has commands for.
fn greek(name: &str) -> Option<(&'static str, char)> {
    const NAMES: &[&str] = &[
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
        "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi",
        "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon", "Phi", "Psi",
        "Omega",
    ];
    let own = NAMES.iter().find(|own| **own == name)?;
    let sign = if *own == "pi" {
        Some('π')
    } else {
        greek_letter(own)
    };
    Some((own, sign?))
}

#[cfg(test)]
mod tests {
    use super::StatedSymbol;

    #[test]
    fn what_is_read_is_shown_in_latex_and_mathml() {
        for (text, latex, mathml) in [
            (
                r"\dot\theta",
                r"\dot{\theta}",
                "<mover><mi>θ</mi><mo>\u{2d9}</mo></mover>",
            ),
            ("C_c", "C_{c}", "<msub><mi>C</mi><mi>c</mi></msub>"),
            (
                r"\omega_{\mathrm{max}}^2",
                r"\omega _{\mathrm{max}}^{2}",
                "<msubsup><mi>ω</mi><mi mathvariant=\"normal\">max</mi><mn>2</mn></msubsup>",
            ),
            ("x'", "x'", "<mrow><mi>x</mi><mi>′</mi></mrow>"),
        ] {
            let own = StatedSymbol::read(text).unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!(own.latex(), latex, "{text}");
            assert_eq!(own.mathml(), mathml, "{text}");
        }
    }

    #[test]
    fn what_would_break_an_output_is_refused() {
        for (text, word) in [
            (r"\input{x}", "`\\input`"),
            ("x_", "ends"),
            ("_x", "before it"),
            ("x_1_2", "before it"),
            ("{x", "not closed"),
            ("x}", "closes nothing"),
            ("$x$", "`$`"),
            ("<b>", "`<`"),
            (r"\mathrm{a$}", "letters and digits"),
            ("", "no symbol"),
            ("{{{{{{{{{{x}}}}}}}}}}", "more than 8"),
        ] {
            let why = StatedSymbol::read(text).unwrap_err().to_string();
            assert!(why.contains(word), "{text}: {why}");
        }
    }
}
