//! Definitions as text: their terms and factors, in another order or with other names.

use crate::tree::Random;

/// The terms of a sum, each with its sign.
pub fn terms(h: &str) -> Vec<String> {
    let (mut terms, mut depth) = (Vec::new(), 0);
    let mut now = String::from("+ ");
    for c in h.chars() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            '+' | '-' if depth == 0 && now.trim_end().len() > 1 => {
                terms.push(now.trim_end().to_owned());
                now.clear();
            }
            '-' if depth == 0 => now.clear(),
            _ => {}
        }
        now.push(c);
    }
    terms.push(now);
    terms
}

/// The place of the bracket that closes the one at the start.
fn inside(text: &str) -> usize {
    let mut depth = 0;
    let closing = text.char_indices().find(|(_, c)| {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        depth == 0
    });
    closing.expect("brackets are closed").0
}

/// A term, its sign first, with its factors and divisors in another order; so too inside of brackets and sums.
pub fn with_factors(term: &str, random: &mut Random) -> String {
    if term.contains("if ") {
        return term.to_owned();
    }
    let (sign, product) = term.split_at(1);
    let (mut factors, mut depth) = (vec![('*', String::new())], 0);
    for c in product.trim().chars() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        match (c, factors.last_mut()) {
            ('*' | '/', _) if depth == 0 => factors.push((c, String::new())),
            (_, Some((_, factor))) => factor.push(c),
            (_, None) => unreachable!("there is a first one"),
        }
    }
    for (_, factor) in &mut factors {
        let is_sum = factor.starts_with("sum(");
        let opening = if is_sum {
            factor.find('{')
        } else {
            factor.find('(')
        };
        let Some(start) = opening.filter(|start| is_sum || *start == 0) else {
            continue;
        };
        let end = start + inside(&factor[start..]);
        let inner = terms(factor[start + 1..end].trim());
        let inner: Vec<String> = inner.iter().map(|t| with_factors(t, random)).collect();
        let (head, tail) = (&factor[..=start], &factor[end..]);
        *factor = format!("{head} 0 {} {tail}", inner.join(" "));
    }
    shuffle(&mut factors, random);
    let mut text = format!("{sign} ");
    for (at, (operator, factor)) in factors.iter().enumerate() {
        match (at, operator) {
            (0, '*') => text += factor.trim(),
            (0, _) => text += &format!("1/{}", factor.trim()),
            _ => text += &format!("{operator}{}", factor.trim()),
        }
    }
    text
}

/// Text with other words.
pub fn replaced(text: &str, names: &[(String, String)]) -> String {
    let mut out = String::new();
    let mut word = String::new();
    for c in text.chars().chain([' ']) {
        if c.is_alphanumeric() || c == '_' {
            word.push(c);
            continue;
        }
        let new = names.iter().find(|(old, _)| *old == word);
        out.push_str(new.map_or(&word, |(_, new)| new));
        word.clear();
        out.push(c);
    }
    out.trim_end().to_owned()
}

pub fn shuffle<T>(list: &mut [T], random: &mut Random) {
    for at in (1..list.len()).rev() {
        list.swap(at, random.below(at + 1));
    }
}
