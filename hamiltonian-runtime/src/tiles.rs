//! Sums over the pairs of a triangle, tile by tile.
//!
//! Input: a loop over at least 4096 rows. Output: loops over rows of tiles, tiles, rows and columns. Invariant: the order of
//! the engine's interpreter and of compiled code on one thread, so that the bits are the same.

use crate::flatten::{Builder, Kind};
use crate::nests::Bounds;
use crate::op::Form;
use hamiltonian_symbolic::index::Domain;
use hamiltonian_symbolic::pairs::{self, Pairs, TILE, Triangle};
use hamiltonian_symbolic::program::{Loop, Step};

/// The loops over rows of tiles and over tiles have no variable in a program.
const NO_VARIABLE: Domain = Domain(u32::MAX);

/// `constant + factor·(variable of the loop of a depth)`
fn form(constant: i64, level: usize, factor: i64) -> Form {
    Form {
        constant,
        terms: vec![(level as u8, factor)],
    }
}

impl Builder<'_> {
    /// The pairs of an outermost loop, if it is computed in tiles.
    pub(crate) fn pairs<'a>(&self, of: &'a Loop, rows: i64) -> Option<Pairs<'a>> {
        let is_large = rows >= pairs::LEAST as i64;
        let may_tile = is_large && self.loops.is_empty() && self.kind != Kind::InPlace;
        let pairs = may_tile.then(|| pairs::pairs(of, self.setting.program));
        pairs.flatten()
    }

    /// The loops over the tiles of a triangle of so many rows.
    pub(crate) fn tiles(&mut self, outer: &Loop, pairs: &Pairs, rows: i64) -> Result<(), String> {
        let tile = TILE as i64;
        let count = rows.div_euclid(tile) + i64::from(rows.rem_euclid(tile) > 0);
        let number = |constant| Form {
            constant,
            terms: Vec::new(),
        };
        // Depths 0 and 1 are those of rows of tiles and of tiles, 2 that of rows.
        let of_row = Bounds {
            start: form(0, 0, tile),
            end: form(tile, 0, tile),
            most: Some(rows),
        };
        let all = Bounds {
            start: form(0, 1, tile),
            end: form(tile, 1, tile),
            most: Some(rows),
        };
        let rows_of_tiles = Bounds {
            start: number(0),
            end: number(count),
            most: None,
        };
        self.around(NO_VARIABLE, rows_of_tiles, |builder| {
            // The tile on the diagonal, in a loop of one, so that depths are those of the others.
            let diagonal = |builder: &mut Builder<'_>| {
                let columns = match pairs.triangle {
                    Triangle::Below => Bounds {
                        start: form(0, 0, tile),
                        end: form(0, 2, 1),
                        most: None,
                    },
                    Triangle::Above => Bounds {
                        start: form(1, 2, 1),
                        end: form(tile, 0, tile),
                        most: Some(rows),
                    },
                };
                let one = Bounds {
                    start: number(0),
                    end: number(1),
                    most: None,
                };
                builder.around(NO_VARIABLE, one, |builder| {
                    builder.tile(outer, pairs, &of_row, &columns, true)
                })
            };
            let others = match pairs.triangle {
                Triangle::Below => Bounds {
                    start: number(0),
                    end: form(0, 0, 1),
                    most: None,
                },
                Triangle::Above => Bounds {
                    start: form(1, 0, 1),
                    end: number(count),
                    most: None,
                },
            };
            if pairs.triangle == Triangle::Above {
                diagonal(builder)?;
            }
            builder.around(NO_VARIABLE, others, |builder| {
                builder.tile(outer, pairs, &of_row, &all, false)
            })?;
            if pairs.triangle == Triangle::Below {
                diagonal(builder)?;
            }
            Ok(())
        })
    }

    /// The rows of a tile; the first tile of a row makes the stores that a row makes once.
    fn tile(
        &mut self,
        outer: &Loop,
        pairs: &Pairs,
        rows: &Bounds,
        columns: &Bounds,
        is_first: bool,
    ) -> Result<(), String> {
        self.around(outer.domain, rows.clone(), |builder| {
            for (at, step) in outer.body.iter().enumerate() {
                match step {
                    // A part of a sum is one of trees, however short.
                    Step::Loop(inner) => builder.ranged(inner, columns.clone(), 0)?,
                    _ if !is_first && pairs.once.contains(&at) => {}
                    step => builder.steps(std::slice::from_ref(step))?,
                }
            }
            Ok(())
        })
    }
}
