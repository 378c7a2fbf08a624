//! A table of numbers beside what they are known to be; an example fails where they differ.

use std::error::Error;

/// Numbers to compare, in the order they are to be printed.
#[derive(Default)]
pub struct Checks {
    rows: Vec<Row>,
}

struct Row {
    what: String,
    found: f64,
    known: f64,
    within: f64,
}

impl Checks {
    /// Notes that `found` should be `known` to within `within`.
    pub fn compare(&mut self, what: impl Into<String>, found: f64, known: f64, within: f64) {
        let what = what.into();
        self.rows.push(Row {
            what,
            found,
            known,
            within,
        });
    }

    /// Prints the table.
    ///
    /// # Errors
    /// A number that is not the known one; a NaN never is.
    pub fn finish(self) -> Result<(), Box<dyn Error>> {
        println!(
            "\n{:<46} {:>18} {:>18} {:>10} {:>9}",
            "check", "found", "known", "difference", "allowed"
        );
        let mut failed = Vec::new();
        for row in &self.rows {
            let difference = (row.found - row.known).abs();
            println!(
                "{:<46} {:>18} {:>18} {:>10.1e} {:>9.0e}",
                row.what,
                number(row.found),
                number(row.known),
                difference,
                row.within
            );
            if difference.is_nan() || difference > row.within {
                failed.push(row.what.as_str());
            }
        }
        if failed.is_empty() {
            Ok(())
        } else {
            Err(format!("not as known: {}", failed.join(", ")).into())
        }
    }
}

/// Twelve decimals where they say something.
fn number(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else if x.abs() < 1e-4 || x.abs() >= 1e5 {
        format!("{x:.6e}")
    } else {
        format!("{x:.12}")
    }
}
