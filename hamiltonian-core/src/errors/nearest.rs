//! The known name nearest to a misspelt one.

use alloc::vec::Vec;

/// The candidate nearest to `name`: equal except for case, or at most one edit per three letters
/// away. The first of equally near ones.
pub(super) fn nearest<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let letters: Vec<char> = name.to_lowercase().chars().collect();
    let allowed = (letters.len() / 3).max(1);
    candidates
        .into_iter()
        .map(|candidate| (edits(&letters, candidate), candidate))
        .filter(|(distance, _)| *distance <= allowed && *distance < letters.len())
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Levenshtein's distance: insertions, deletions and replacements between two words, case ignored.
fn edits(a: &[char], b: &str) -> usize {
    let mut row: Vec<usize> = (0..=a.len()).collect();
    for (i, letter) in b.chars().flat_map(char::to_lowercase).enumerate() {
        let mut corner = core::mem::replace(&mut row[0], i + 1);
        for (j, other) in a.iter().enumerate() {
            let replaced = corner + usize::from(letter != *other);
            corner = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(corner + 1);
        }
    }
    row[a.len()]
}
