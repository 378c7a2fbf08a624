//! Names of the elements of coordinates.
//!
//! Input: a group of coordinates. Output: the name of each element with its place.

use crate::variables::Coordinates;

/// The names of all elements, the last index fastest, with their places.
pub(crate) fn elements(name: &str, of: &Coordinates) -> Vec<(String, usize)> {
    let mut names = vec![name.to_owned()];
    for extent in of.extents() {
        let with = |name: &String| {
            let name = name.clone();
            (0..*extent).map(move |index| format!("{name}[{index}]"))
        };
        names = names.iter().flat_map(with).collect();
    }
    names.into_iter().zip(of.places()).collect()
}
