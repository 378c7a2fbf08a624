//! MathML of formulas in LaTeX.
//!
//! Input: LaTeX as this module's printer writes it. Output: MathML Core (W3C, 2023), which browsers draw without
//! scripts and fonts. Invariant: tags are closed and characters escaped, so the output is well-formed XML. LaTeX
//! that the printer does not write has no translation.

use std::fmt::Write as _;

/// Groups inside groups, at most: what is deeper is no formula that people read.
const DEPTH: usize = 64;

/// The children of a `math` element for a formula in LaTeX without dollar signs; `None` where a command is
/// unknown, a group does not end, or groups are nested more than 64 deep.
///
/// ```
/// use hamiltonian_symbolic::print::mathml;
///
/// assert_eq!(
///     mathml(r"\frac{p^{2}}{2}").unwrap(),
///     "<mfrac><msup><mi>p</mi><mn>2</mn></msup><mn>2</mn></mfrac>",
/// );
/// assert_eq!(mathml(r"\unknown"), None);
/// ```
#[must_use]
pub fn mathml(latex: &str) -> Option<String> {
    let mut reader = TexReader {
        rest: latex,
        depth: 0,
    };
    let row = reader.row(Token::End)?;
    Some(row.concat())
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Token<'t> {
    /// `\name`, or a backslash and one character.
    Command(&'t str),
    Digits(&'t str),
    Char(char),
    End,
}

struct TexReader<'t> {
    rest: &'t str,
    depth: usize,
}

/// The kind of an element, which decides the place of its scripts and the space before it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ScriptBase {
    /// A sign or a space.
    Sign,
    /// A letter, a number, a fraction or parentheses.
    Plain,
    /// A name of several letters.
    Word,
    /// Scripts stand below and above.
    Sum,
    /// An argument follows.
    Function,
}

impl ScriptBase {
    /// Returns true if a thin space stands between two elements: before a function, as in TeX, and beside a
    /// word, which would run into its neighbour.
    fn is_apart_from(self, next: ScriptBase) -> bool {
        matches!(
            (self, next),
            (
                ScriptBase::Plain | ScriptBase::Word,
                ScriptBase::Function | ScriptBase::Word
            ) | (ScriptBase::Word, ScriptBase::Plain)
        )
    }
}

const THIN_SPACE: &str = "<mspace width=\"0.17em\"></mspace>";

impl<'t> TexReader<'t> {
    fn token(&mut self) -> Token<'t> {
        self.rest = self.rest.trim_start();
        let mut chars = self.rest.chars();
        let Some(first) = chars.next() else {
            return Token::End;
        };
        let until = |rest: &'t str, stop: fn(char) -> bool| {
            let at = rest.find(stop).unwrap_or(rest.len());
            rest.split_at(at)
        };
        if first == '\\' {
            let after = chars.as_str();
            let (mut name, mut rest) = until(after, |c| !c.is_ascii_alphabetic());
            if name.is_empty() {
                let width = after.chars().next().map_or(0, char::len_utf8);
                (name, rest) = after.split_at(width);
            }
            self.rest = rest;
            return Token::Command(name);
        }
        if first.is_ascii_digit() {
            let (digits, rest) = until(self.rest, |c| !c.is_ascii_digit() && c != '.');
            self.rest = rest;
            return Token::Digits(digits);
        }
        self.rest = chars.as_str();
        Token::Char(first)
    }

    fn peek(&self) -> Token<'t> {
        TexReader { ..*self }.token()
    }

    fn expect(&mut self, token: Token<'_>) -> Option<()> {
        (self.token() == token).then_some(())
    }

    /// Elements up to this token, which is taken.
    fn row(&mut self, end: Token<'_>) -> Option<Vec<String>> {
        self.row_to(&[end]).map(|(row, _)| row)
    }

    /// Elements up to one of these tokens, and the token, which is taken.
    fn row_to(&mut self, ends: &[Token<'_>]) -> Option<(Vec<String>, Token<'t>)> {
        if self.depth == DEPTH {
            return None;
        }
        self.depth += 1;
        let (mut row, mut before) = (Vec::new(), ScriptBase::Sign);
        let end = loop {
            let token = self.token();
            if ends.contains(&token) {
                break token;
            }
            let (element, base) = self.element(token)?;
            if before.is_apart_from(base) {
                row.push(THIN_SPACE.to_owned());
            }
            before = base;
            row.push(self.scripts(element, base)?);
            if base == ScriptBase::Function {
                row.push("<mo>\u{2061}</mo>".to_owned());
            }
        };
        self.depth -= 1;
        Some((row, end))
    }

    /// `{…}` as one element.
    fn group(&mut self) -> Option<String> {
        self.expect(Token::Char('{'))?;
        self.row(Token::Char('}')).map(one)
    }

    /// `{…}` as it stands.
    fn words(&mut self) -> Option<&'t str> {
        self.expect(Token::Char('{'))?;
        let (words, rest) = self.rest.split_once('}')?;
        self.rest = rest;
        Some(words)
    }

    /// An element with what stands below and above it.
    fn scripts(&mut self, element: String, base: ScriptBase) -> Option<String> {
        let (mut below, mut above) = (None, None);
        loop {
            match self.peek() {
                Token::Char('_') if below.is_none() => {
                    self.token();
                    below = Some(self.group()?);
                }
                Token::Char('^') if above.is_none() => {
                    self.token();
                    above = Some(self.group()?);
                }
                Token::Char('\'') if above.is_none() => {
                    let mut primes = String::new();
                    while self.peek() == Token::Char('\'') {
                        self.token();
                        primes.push('′');
                    }
                    above = Some(format!("<mo>{primes}</mo>"));
                }
                _ => break,
            }
        }
        let tags = match base {
            ScriptBase::Sum => ["munder", "mover", "munderover"],
            _ => ["msub", "msup", "msubsup"],
        };
        let (tag, scripts) = match (below, above) {
            (None, None) => return Some(element),
            (Some(below), None) => (tags[0], below),
            (None, Some(above)) => (tags[1], above),
            (Some(below), Some(above)) => (tags[2], below + &above),
        };
        Some(format!("<{tag}>{element}{scripts}</{tag}>"))
    }

    fn element(&mut self, token: Token<'t>) -> Option<(String, ScriptBase)> {
        let plain = |element: String| Some((element, ScriptBase::Plain));
        match token {
            Token::Digits(digits) => plain(format!("<mn>{digits}</mn>")),
            Token::Char('{') => plain(one(self.row(Token::Char('}'))?)),
            Token::Char('-') => Some(("<mo>−</mo>".to_owned(), ScriptBase::Sign)),
            Token::Char(c) if c.is_alphabetic() => plain(format!("<mi>{c}</mi>")),
            // A row of their own: parentheses stretch to what is in their row.
            Token::Char('(') => plain(fenced('(', &self.row(Token::Char(')'))?, ')')),
            Token::Char('[') => plain(fenced('[', &self.row(Token::Char(']'))?, ']')),
            Token::Char(c) if "+=/,|!<>:;".contains(c) => Some((
                format!("<mo>{}</mo>", escaped(&c.to_string())),
                ScriptBase::Sign,
            )),
            Token::Command(name) => self.command(name),
            Token::Char(_) | Token::End => None,
        }
    }

    fn command(&mut self, name: &str) -> Option<(String, ScriptBase)> {
        let element = match name {
            "frac" => {
                let (above, below) = (self.group()?, self.group()?);
                format!("<mfrac>{above}{below}</mfrac>")
            }
            "sqrt" if self.peek() == Token::Char('[') => {
                self.token();
                let index = one(self.row(Token::Char(']'))?);
                format!("<mroot>{}{index}</mroot>", self.group()?)
            }
            "sqrt" => format!("<msqrt>{}</msqrt>", self.group()?),
            "left" => {
                let Token::Char(open) = self.token() else {
                    return None;
                };
                let inner = self.row(Token::Command("right"))?;
                let Token::Char(close) = self.token() else {
                    return None;
                };
                fenced(open, &inner, close)
            }
            "begin" => self.cases()?,
            "mathrm" => {
                let word = escaped(&self.words()?.replace('\\', ""));
                let base = match word.chars().nth(1) {
                    Some(_) => ScriptBase::Word,
                    None => ScriptBase::Plain,
                };
                return Some((format!("<mi mathvariant=\"normal\">{word}</mi>"), base));
            }
            "text" => {
                let text = escaped(self.words()?).replace(' ', "\u{a0}");
                return Some((format!("<mtext>{text}</mtext>"), ScriptBase::Sign));
            }
            "operatorname" => {
                let word = escaped(self.words()?);
                return Some((format!("<mi>{word}</mi>"), ScriptBase::Function));
            }
            "sum" => return Some(("<mo>∑</mo>".to_owned(), ScriptBase::Sum)),
            "," => return Some((THIN_SPACE.to_owned(), ScriptBase::Sign)),
            "quad" => {
                return Some((
                    "<mspace width=\"1em\"></mspace>".to_owned(),
                    ScriptBase::Sign,
                ));
            }
            _ if FUNCTIONS.contains(&name) => {
                return Some((format!("<mi>{name}</mi>"), ScriptBase::Function));
            }
            _ => match SIGNS.iter().find(|(known, _)| *known == name) {
                Some((_, sign)) => return Some((format!("<mo>{sign}</mo>"), ScriptBase::Sign)),
                None => {
                    let (_, letter) = LETTERS.iter().find(|(known, _)| *known == name)?;
                    format!("<mi>{letter}</mi>")
                }
            },
        };
        Some((element, ScriptBase::Plain))
    }

    /// A table of values and conditions.
    fn cases(&mut self) -> Option<String> {
        if self.words()? != "cases" {
            return None;
        }
        let mut table = String::new();
        loop {
            let value = self.row(Token::Char('&'))?.concat();
            let ends = [Token::Command("\\"), Token::Command("end")];
            let (condition, end) = self.row_to(&ends)?;
            let condition = condition.concat();
            let _ = write!(table, "<mtr><mtd>{value}</mtd><mtd>{condition}</mtd></mtr>");
            if end == Token::Command("end") {
                break;
            }
        }
        let table = format!("<mrow><mo>{{</mo><mtable>{table}</mtable></mrow>");
        (self.words()? == "cases").then_some(table)
    }
}

/// Elements between parentheses or bars.
fn fenced(open: char, inner: &[String], close: char) -> String {
    let [open, close] = [open, close].map(|c| escaped(&c.to_string()));
    format!(
        "<mrow><mo>{open}</mo>{}<mo>{close}</mo></mrow>",
        inner.concat()
    )
}

/// Several elements as one.
fn one(row: Vec<String>) -> String {
    match row.as_slice() {
        [element] => element.clone(),
        _ => format!("<mrow>{}</mrow>", row.concat()),
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

const FUNCTIONS: &[&str] = &[
    "sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln", "min",
    "max",
];

const SIGNS: &[(&str, &str)] = &[
    ("cdot", "⋅"),
    ("le", "≤"),
    ("ge", "≥"),
    ("ne", "≠"),
    ("lnot", "¬"),
    ("land", "∧"),
    ("lor", "∨"),
    ("dots", "…"),
    ("bmod", "mod"),
    ("lfloor", "⌊"),
    ("rfloor", "⌋"),
    ("partial", "∂"),
];

const LETTERS: &[(&str, &str)] = &[
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("iota", "ι"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("upsilon", "υ"),
    ("phi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Xi", "Ξ"),
    ("Pi", "Π"),
    ("Sigma", "Σ"),
    ("Upsilon", "Υ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
];
