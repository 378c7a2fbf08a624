//! The picture of an orbit: its coordinates over the time.
//!
//! Input: a table whose first columns are the time and the coordinates. Output: the text of an SVG file. Invariant: each row
//! whose numbers are finite is a point of a curve, at its place between the ends of the axes.

use hamiltonian_core::Table;
use std::fmt::Write;

/// The size of the picture, and the rectangle of its axes: left, top, right, bottom.
const SIZE: [f64; 2] = [800.0, 450.0];
const AXES: [f64; 4] = [80.0, 20.0, 780.0, 400.0];

/// The colours of curves, one after the other (M. Okabe, K. Ito, Color universal design, 2008).
const COLOURS: [&str; 6] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];

/// The numbers of an axis.
struct Scale {
    from: f64,
    to: f64,
}

impl Scale {
    /// The range of numbers; around one number, a range of the length 1.
    fn of(numbers: impl Iterator<Item = f64>) -> Scale {
        let finite = numbers.filter(|number| number.is_finite());
        let range = finite.fold(None, |range: Option<[f64; 2]>, number| {
            let [from, to] = range.unwrap_or([number; 2]);
            Some([from.min(number), to.max(number)])
        });
        match range.unwrap_or([0.0; 2]) {
            [from, to] if from < to => Scale { from, to },
            [one, _] => Scale {
                from: one - 0.5,
                to: one + 0.5,
            },
        }
    }

    /// The place of a number between the two ends.
    fn place(&self, number: f64, [first, last]: [f64; 2]) -> f64 {
        first + (number - self.from) / (self.to - self.from) * (last - first)
    }

    /// Round numbers inside, each with its text.
    fn ticks(&self) -> Vec<(f64, String)> {
        let rough = (self.to - self.from) / 5.0;
        let power = rough.log10().floor();
        let unit = 10_f64.powf(power);
        let step = [1.0, 2.0, 5.0].into_iter().find(|of| of * unit >= rough);
        let step = step.unwrap_or(10.0) * unit;
        let digits = (-step.log10().floor()).clamp(0.0, 17.0) as usize;
        let first = (self.from / step).ceil();
        let count = ((self.to / step).floor() - first).clamp(0.0, 10.0) as usize;
        let all = (0..=count).map(|k| (first + k as f64) * step);
        all.map(|number| match number.abs().max(step) {
            size if (1e-4..1e6).contains(&size) => (number, format!("{number:.digits$}")),
            _ => (number, format!("{number:.2e}")),
        })
        .collect()
    }
}

/// Draws the coordinates, which are the columns behind the first one.
pub(super) fn picture(table: &Table, coordinates: usize) -> String {
    let curves = 1..=coordinates;
    let time = Scale::of(table.iter().map(|row| row[0]));
    let values = Scale::of(table.iter().flat_map(|row| &row[curves.clone()]).copied());
    let [left, top, right, bottom] = AXES;
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"14\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    // Writing to a text does not fail.
    for (number, text) in time.ticks() {
        let x = time.place(number, [left, right]);
        let (end, under) = (bottom + 6.0, bottom + 22.0);
        let _ = writeln!(
            svg,
            "<path d=\"M{x:.2} {bottom}V{end}\" stroke=\"black\"/><text x=\"{x:.2}\" y=\"{under}\" \
             text-anchor=\"middle\">{text}</text>"
        );
    }
    for (number, text) in values.ticks() {
        let y = values.place(number, [bottom, top]);
        let (end, before, middle) = (left - 6.0, left - 10.0, y + 5.0);
        let _ = writeln!(
            svg,
            "<path d=\"M{left} {y:.2}H{end}\" stroke=\"black\"/><text x=\"{before}\" y=\"{middle:.2}\" \
             text-anchor=\"end\">{text}</text>"
        );
    }
    let (middle, under) = ((left + right) / 2.0, height - 8.0);
    let clock = &table.columns()[0];
    let _ = writeln!(
        svg,
        "<text x=\"{middle}\" y=\"{under}\" text-anchor=\"middle\" font-style=\"italic\">{clock}</text>"
    );
    for (number, curve) in curves.enumerate() {
        let colour = COLOURS[number % COLOURS.len()];
        let mut pen = 'M';
        let mut path = String::new();
        for row in table.iter() {
            if !(row[0].is_finite() && row[curve].is_finite()) {
                pen = 'M';
                continue;
            }
            let x = time.place(row[0], [left, right]);
            let y = values.place(row[curve], [bottom, top]);
            let _ = write!(path, "{pen}{x:.2} {y:.2}");
            pen = 'L';
        }
        let name = &table.columns()[curve];
        let (x, y) = (right - 8.0, top + 18.0 * (number + 1) as f64);
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\"><title>{name}</title></path>"
        );
        // A picture has room for a few names.
        if number < 2 * COLOURS.len() {
            let _ = writeln!(
                svg,
                "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" fill=\"{colour}\">{name}</text>"
            );
        }
    }
    let (across, down) = (right - left, bottom - top);
    let _ = writeln!(
        svg,
        "<rect x=\"{left}\" y=\"{top}\" width=\"{across}\" height=\"{down}\" fill=\"none\" stroke=\"black\"/>\n</svg>"
    );
    svg
}
