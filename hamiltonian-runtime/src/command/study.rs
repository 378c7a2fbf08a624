//! The text of a file: a definition, and the lines that say how it runs.
//!
//! Input: the text. Output: [`Study`]. Invariant: every word is known and every value a number, a list or a name; whether they
//! fit the definition is asked later.

use super::places::Word;
use crate::Diagnostic;
use std::ops::Range;

/// A number, or a list of values.
#[derive(Debug, Clone)]
pub(super) enum Number {
    One(f64),
    List(Vec<Number>),
}

/// A name with its value.
#[derive(Debug, Clone)]
pub(super) struct Assignment<'a> {
    pub name: Word<'a>,
    pub word: Word<'a>,
    pub value: Number,
}

/// How steps are made.
#[derive(Debug, Clone)]
pub(super) enum Stepping<'a> {
    Tolerance(f64),
    Scheme(Word<'a>, f64),
}

/// A file.
#[derive(Debug)]
pub(super) struct Study<'a> {
    pub file: &'a str,
    pub definition: &'a str,
    /// `with`: parameters and sizes.
    pub with: Vec<Assignment<'a>>,
    /// `start`: coordinates and momenta.
    pub start: Vec<Assignment<'a>>,
    /// The word `run`, for errors of the whole.
    pub run: Word<'a>,
    /// The name of the time of the run: `t`, or `s` of another time.
    pub clock: Word<'a>,
    /// The first and the last time.
    pub times: Range<f64>,
    /// The time between two rows.
    pub every: f64,
    pub steps: Stepping<'a>,
    /// `write`: the files of the table.
    pub write: Vec<Word<'a>>,
    /// `events`: the files of their table.
    pub events: Vec<Word<'a>>,
}

/// The lines below `---`, in their order.
#[derive(Default)]
struct Lines<'a> {
    with: Vec<Word<'a>>,
    start: Vec<Word<'a>>,
    run: Vec<(Word<'a>, Vec<Word<'a>>)>,
    write: Vec<Word<'a>>,
    events: Vec<Word<'a>>,
}

/// Reads a file.
pub(super) fn read<'a>(text: &'a str, file: &'a str) -> Result<Study<'a>, Box<Diagnostic>> {
    let mut lines = Lines::default();
    let mut definition = None;
    let mut from = 0;
    let mut last = Word::line("", 1, file);
    for (number, whole) in text.split_inclusive('\n').enumerate() {
        let line = whole.trim_end_matches(['\n', '\r']);
        let word = Word::line(line, number + 1, file);
        if definition.is_none() {
            if line.trim() == "---" {
                definition = Some(&text[..from]);
            }
        } else {
            statement(word, &mut lines)?;
        }
        from += whole.len();
        last = word;
    }
    let Some(definition) = definition else {
        let help = "write the line `---` below the definition, and then `start` and `run`";
        return Err(last.error("the file does not say how the definition runs", help));
    };
    let run = match lines.run.as_slice() {
        [one] => one,
        [] => {
            let help = "write `run t = 0..100, every = 0.1, tolerance = 1e-10`";
            return Err(last.error("there is no line `run`", help));
        }
        [_, second, ..] => {
            let help = "a file has one run";
            return Err(second.0.error("`run` is there twice", help));
        }
    };
    let ((clock, times), every, steps) = run_line(run)?;
    let settings = |words: &[Word<'a>]| {
        let settings: Result<Vec<Assignment<'a>>, _> = words.iter().map(setting).collect();
        let settings = settings?;
        for (at, one) in settings.iter().enumerate() {
            if settings[..at]
                .iter()
                .any(|known| known.name.text == one.name.text)
            {
                let message = format!("`{}` has two values", one.name.text);
                return Err(one.name.error(message, "give it one"));
            }
        }
        Ok(settings)
    };
    Ok(Study {
        file,
        definition,
        with: settings(&lines.with)?,
        start: settings(&lines.start)?,
        run: run.0,
        clock,
        times,
        every,
        steps,
        write: lines.write,
        events: lines.events,
    })
}

/// Sorts a line by its first word.
fn statement<'a>(line: Word<'a>, lines: &mut Lines<'a>) -> Result<(), Box<Diagnostic>> {
    const HELP: &str = "a line begins with `with`, `start`, `run`, `write` or `events`";
    let line = match line.split("//") {
        Some((before, _)) => before,
        None => line.part(0, line.text.len()),
    };
    if line.text.is_empty() {
        return Ok(());
    }
    let end = line
        .text
        .find(char::is_whitespace)
        .unwrap_or(line.text.len());
    let (first, rest) = (line.part(0, end), line.part(end, line.text.len()).list());
    match first.text {
        "with" => lines.with.extend(rest),
        "start" => lines.start.extend(rest),
        "run" => lines.run.push((first, rest)),
        "write" => lines.write.extend(rest),
        "events" => lines.events.extend(rest),
        other => return Err(first.error(format!("unknown word `{other}`"), HELP)),
    }
    Ok(())
}

/// `name = value`, not read yet.
fn named<'a>(word: &Word<'a>) -> Result<(Word<'a>, Word<'a>), Box<Diagnostic>> {
    match word.split("=") {
        Some((name, value)) if !name.text.is_empty() && !value.text.is_empty() => Ok((name, value)),
        _ => Err(word.error("expected a name and its value", "write `name = value`")),
    }
}

fn setting<'a>(word: &Word<'a>) -> Result<Assignment<'a>, Box<Diagnostic>> {
    let (name, word) = named(word)?;
    let value = number(&word)?;
    Ok(Assignment { name, word, value })
}

/// A number, or a list in brackets.
fn number(word: &Word) -> Result<Number, Box<Diagnostic>> {
    match word
        .text
        .strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'))
    {
        Some(_) => {
            let inside = word.part(1, word.text.len() - 1).list();
            let numbers: Result<_, _> = inside.iter().map(number).collect();
            Ok(Number::List(numbers?))
        }
        None => single(word).map(Number::One),
    }
}

fn single(word: &Word) -> Result<f64, Box<Diagnostic>> {
    // What Rust reads as a number beside digits, `inf` and `nan`, is none here.
    let is_written = word
        .text
        .starts_with(|sign: char| sign.is_ascii_digit() || "+-.".contains(sign));
    match word.text.parse::<f64>() {
        Ok(number) if is_written && number.is_finite() => Ok(number),
        _ => Err(word.error(
            format!("`{}` is not a number", word.text),
            "write a number such as `0.5` or `1e-3`, or a list `[1, 2]`",
        )),
    }
}

fn positive(word: &Word) -> Result<f64, Box<Diagnostic>> {
    match single(word)? {
        number if number > 0.0 => Ok(number),
        _ => Err(word.error(
            "expected a positive number",
            "the sign follows from the times of `run`",
        )),
    }
}

/// The time of a run, with its name.
type Times<'a> = (Word<'a>, Range<f64>);

/// The times, the time between rows and the steps of a run.
fn run_line<'a>(
    (run, words): &(Word<'a>, Vec<Word<'a>>),
) -> Result<(Times<'a>, f64, Stepping<'a>), Box<Diagnostic>> {
    let (mut times, mut every, mut tolerance, mut scheme, mut step) =
        (None, None, None, None, None);
    for word in words {
        let (name, value) = named(word)?;
        let is_twice = match name.text {
            "t" | "s" => times.replace((name, range(&value)?)).is_some(),
            "every" => every.replace(positive(&value)?).is_some(),
            "tolerance" => tolerance.replace(positive(&value)?).is_some(),
            "scheme" => scheme.replace(value).is_some(),
            "step" => step.replace(positive(&value)?).is_some(),
            other => {
                let help = "`run` has `t`, `every`, and either `tolerance`, or `scheme` and `step`";
                return Err(name.error(format!("unknown name `{other}`"), help));
            }
        };
        if is_twice {
            return Err(name.error(format!("`{}` has two values", name.text), "give it one"));
        }
    }
    let missing = |what: &str, help: &str| run.error(format!("`run` has no {what}"), help);
    let times = times.ok_or_else(|| missing("times", "write `t = 0..100`"))?;
    let every = every.ok_or_else(|| missing("time between two rows", "write `every = 0.1`"))?;
    let steps = match (tolerance, scheme, step) {
        (Some(tolerance), None, None) => Stepping::Tolerance(tolerance),
        (None, Some(scheme), Some(step)) => Stepping::Scheme(scheme, step),
        (Some(_), ..) => {
            let help = "with a tolerance, scheme and steps follow from it";
            return Err(run.error("`run` has a tolerance and a scheme or a step", help));
        }
        (None, Some(_), None) => return Err(missing("step", "write `step = 0.1`")),
        (None, None, Some(_)) => return Err(missing("scheme", "write `scheme = GaussNystrom8`")),
        (None, None, None) => {
            let help = "write `tolerance = 1e-10`, or `scheme = GaussNystrom8, step = 0.1`";
            return Err(missing("tolerance and no scheme", help));
        }
    };
    Ok((times, every, steps))
}

/// `a..b`
fn range(word: &Word) -> Result<Range<f64>, Box<Diagnostic>> {
    let Some((a, b)) = word.split("..") else {
        return Err(word.error("expected the first and the last time", "write `t = 0..100`"));
    };
    let (from, to) = (single(&a)?, single(&b)?);
    match from == to {
        true => Err(word.error("the run ends where it begins", "write another last time")),
        false => Ok(from..to),
    }
}
