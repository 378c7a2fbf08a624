//! Values on a lattice as colours.
//!
//! Input: values on a lattice and the ranges of both axes, [`Field`]. Output: an image in an SVG. Invariant: values
//! that are not finite have no colour.

use super::raster::element;
use crate::Lattice;
use std::ops::Range;

/// Values on a lattice with two axes, drawn as colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// The range of x that the columns share.
    pub x: Range<f64>,
    /// The range of y that the rows share.
    pub y: Range<f64>,
    /// The values; those that are not finite are left out.
    pub values: Lattice<f64, 2>,
}

/// The number of colours.
const COLOURS: usize = 41;

/// The colours of the least, the middle and the largest value, told apart by people who see colours differently
/// too.
const ENDS: [[f64; 3]; 3] = [
    [0.0, 90.0, 181.0],
    [247.0, 247.0, 247.0],
    [220.0, 50.0, 32.0],
];

impl Field {
    /// The least and the largest value; 0 lies in their middle if there are values of both signs.
    pub(super) fn ends(&self) -> Range<f64> {
        let values = self
            .values
            .as_slice()
            .iter()
            .filter(|value| value.is_finite());
        let (least, most) = values.fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(least, most), value| (value.min(least), value.max(most)),
        );
        match least < 0.0 && most > 0.0 {
            true => -most.max(-least)..most.max(-least),
            false => least..most,
        }
    }

    /// The colour of a number from 0 to 1.
    pub(super) fn colour(at: f64) -> [u8; 3] {
        let (first, part) = match at < 0.5 {
            true => (0, 2.0 * at),
            false => (1, 2.0 * at - 1.0),
        };
        let mix = |k: usize| ENDS[first][k] + part * (ENDS[first + 1][k] - ENDS[first][k]);
        [0, 1, 2].map(|k| mix(k).round() as u8)
    }

    /// The element of an SVG, at a place and of a size in the units of the drawing.
    pub(super) fn element(&self, corner: [i32; 2], size: [i32; 2]) -> String {
        let ends = self.ends();
        let last = COLOURS as f64 - 1.0;
        let span = (ends.end - ends.start).max(f64::MIN_POSITIVE);
        let pixel = |value: &f64| match value.is_finite() {
            true => ((value - ends.start) / span * last).round() as u8 + 1,
            false => 0,
        };
        let [_, columns] = self.values.extents();
        // The first row is at the bottom.
        let rows = self.values.as_slice().chunks(columns.max(1)).rev();
        let pixels: Vec<u8> = rows.flatten().map(pixel).collect();
        let palette: Vec<_> = (0..COLOURS)
            .map(|k| Field::colour(k as f64 / last))
            .collect();
        element(corner, size, columns, &pixels, &palette)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Figure;

    fn field<const N: usize>(values: [[f64; N]; 2]) -> Field {
        let values = Lattice::from_fn([2, N], |[i, j]| values[i][j]);
        Field {
            x: 0.0..1.0,
            y: 0.0..1.0,
            values,
        }
    }

    #[test]
    fn values_of_both_signs_have_colours_about_0() {
        assert_eq!(field([[-1.0, 3.0], [0.5, f64::NAN]]).ends(), -3.0..3.0);
        assert_eq!(field([[1.0, 3.0], [0.5, f64::INFINITY]]).ends(), 0.5..3.0);
        let colours = [0.0, 0.5, 1.0].map(Field::colour);
        assert_eq!(colours, ENDS.map(|colour| colour.map(|part| part as u8)));
    }

    #[test]
    fn a_field_of_no_or_one_value_is_drawn() {
        let nan = f64::NAN;
        let fields = [
            field([[]; 2]),
            field([[nan; 3]; 2]),
            field([[2.0]; 2]),
            field([[0.0, nan]; 2]),
        ];
        for (field, labels) in fields.into_iter().zip([0, 0, 3, 3]) {
            let values = format!("{:?}", field.values);
            let drawn = Figure::field(field.x, field.y, field.values).svg();
            let text = drawn.expect("a drawing");
            assert!(text.contains("data:image/png;base64,"), "{values}");
            assert!(!text.contains("inf") && !text.contains("NaN"), "{values}");
            let boxes = text.matches("width=\"192\"").count();
            assert_eq!(boxes, labels, "{values}");
        }
    }
}
