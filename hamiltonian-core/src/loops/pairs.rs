//! Sums over the pairs of a triangle, tile by tile, on one thread or several.
//!
//! Input: a loop whose row i changes elements i and, for each of its columns j, elements j. Output: those
//! changes. Invariant: the order in which tiles change an element depends on the number of rows alone. One thread
//! takes rows of tiles in order. Several threads take antidiagonals in order; they share the tiles of each, no two of
//! which reach the same element.

use crate::loops::slabs::on_two_threads;
use crate::systems::system::Arithmetic;
use core::ops::Range;
use hamiltonian_lanes::Real;

/// The least number of rows of a triangle that is computed in tiles.
pub const TILED: usize = 4096;

/// The number of rows and of columns of a tile. Its elements stay in the first-level cache.
const TILE: usize = 512;

/// The columns that a row has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Triangle {
    /// Those before it.
    Below,
    /// Those after it.
    Above,
}

/// A row of a tile.
#[derive(Debug)]
pub struct TileRow<'a, T, const C: usize> {
    /// Its number.
    pub number: usize,
    /// Its columns in this tile.
    pub columns: Range<usize>,
    /// True in exactly one tile of the row.
    pub is_first: bool,
    /// For each array the row's own element.
    pub own: [&'a mut T; C],
    /// For each array the elements of the columns.
    pub others: [&'a mut [T]; C],
}

/// Calls `work` with the rows of a triangle, tile by tile.
#[cfg_attr(not(unoptimised), inline(always))]
pub fn pairs<T: Real, const C: usize>(
    count: usize,
    triangle: Triangle,
    arithmetic: Arithmetic,
    arrays: [&mut [T]; C],
    work: impl Fn(TileRow<'_, T, C>) + Copy + Sync,
) {
    let all = Tiles { count, triangle };
    if T::WIDENS {
        // A borrow of `work` itself would keep its captures out of registers in the caller.
        let copy = work;
        all.apart(arithmetic, arrays, &copy);
    } else {
        all.one_by_one(arrays, &work);
    }
}

/// The work on a row in a tile.
type RowBody<'a, T, const C: usize> = dyn Fn(TileRow<'_, T, C>) + Sync + 'a;

/// The elements of some blocks, in each array.
type Parts<'a, T, const C: usize> = [&'a mut [T]; C];

/// The elements before and after a place.
#[cfg_attr(not(unoptimised), inline(always))]
fn split<T, const C: usize>(mut parts: Parts<'_, T, C>, at: usize) -> [Parts<'_, T, C>; 2] {
    let mut after = parts.each_mut().map(|_| &mut [][..]);
    let mut c = 0;
    while c < C {
        (parts[c], after[c]) = core::mem::take(&mut parts[c]).split_at_mut(at);
        c += 1;
    }
    [parts, after]
}

/// The elements from a place on.
#[cfg_attr(not(unoptimised), inline(always))]
fn after<T, const C: usize>(parts: Parts<'_, T, C>, at: usize) -> Parts<'_, T, C> {
    let [_, after] = split(parts, at);
    after
}

/// The tiles of a triangle.
#[derive(Clone, Copy)]
struct Tiles {
    /// The number of rows.
    count: usize,
    triangle: Triangle,
}

impl Tiles {
    /// The number of blocks of rows.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn blocks(self) -> usize {
        self.count.div_ceil(TILE)
    }

    /// The rows of a block.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn rows(self, block: usize) -> Range<usize> {
        block * TILE..((block + 1) * TILE).min(self.count)
    }

    /// Takes all tiles, for a scalar whose loops choose the level of the CPU themselves.
    #[inline(never)]
    fn apart<T: Real, const C: usize>(
        self,
        arithmetic: Arithmetic,
        mut arrays: Parts<'_, T, C>,
        work: &RowBody<'_, T, C>,
    ) {
        if !has_threads(arithmetic) {
            return self.one_by_one(arrays, work);
        }
        let blocks = self.blocks();
        for sum in 0..2 * blocks - 1 {
            let last = sum.min(blocks - 1);
            let first = sum - last;
            let elements = self.rows(first).start..self.rows(last).end;
            let parts = arrays.each_mut().map(|array| &mut array[elements.clone()]);
            self.antidiagonal([first, last], parts, work);
        }
    }

    /// Takes rows of tiles in order.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn one_by_one<T: Real, const C: usize, W: Fn(TileRow<'_, T, C>) + ?Sized>(
        self,
        mut arrays: Parts<'_, T, C>,
        work: &W,
    ) {
        let mut row = 0;
        while row < self.blocks() {
            let (mut column, end) = match self.triangle {
                Triangle::Below => (0, row + 1),
                Triangle::Above => (row, self.blocks()),
            };
            while column < end {
                let (low, high) = (row.min(column), row.max(column));
                let begin = low * TILE;
                let parts = arrays.each_mut().map(|array| &mut array[begin..]);
                let [lows, highs] = split(parts, high * TILE - begin);
                self.tile([low, high], lows, highs, work);
                column += 1;
            }
            row += 1;
        }
    }

    /// Takes the tiles of the blocks `first + k` and `last − k`; `parts` are the elements of `first..=last`.
    fn antidiagonal<T: Real, const C: usize>(
        self,
        [first, last]: [usize; 2],
        parts: Parts<'_, T, C>,
        work: &RowBody<'_, T, C>,
    ) {
        let count = (last - first).div_ceil(2);
        let [lows, rest] = split(parts, count * TILE);
        if (last - first) % 2 == 1 {
            return self.several([first, last], count, lows, rest, work);
        }
        let middle = first + count;
        let size = self.rows(middle).len();
        let [own, highs] = split(rest, size);
        let mut diagonal = Some(split(own, 0));
        let mut others = Some((lows, highs));
        on_two_threads(
            &mut || {
                if let Some((lows, highs)) = others.take() {
                    self.several([first, last], count, lows, highs, work);
                }
            },
            &mut || {
                if let Some([none, own]) = diagonal.take() {
                    self.tile([middle; 2], none, own, work);
                }
            },
        );
    }

    /// Takes the first `count` of these tiles; `lows` are the elements of the blocks from `first` on, `highs` those
    /// of the blocks up to `last`.
    fn several<T: Real, const C: usize>(
        self,
        [first, last]: [usize; 2],
        count: usize,
        lows: Parts<'_, T, C>,
        highs: Parts<'_, T, C>,
        work: &RowBody<'_, T, C>,
    ) {
        match count {
            0 => return,
            1 => return self.tile([first, last], lows, highs, work),
            _ => {}
        }
        let half = count / 2;
        let [low_ends, lows] = split(lows, half * TILE);
        let [highs, high_ends] = split(highs, (count - half) * TILE);
        let mut ends = Some((low_ends, high_ends));
        let mut middle = Some((lows, highs));
        on_two_threads(
            &mut || {
                if let Some((lows, highs)) = ends.take() {
                    self.several([first, last], half, lows, highs, work);
                }
            },
            &mut || {
                if let Some((lows, highs)) = middle.take() {
                    let ends = [first + half, last - half];
                    self.several(ends, count - half, lows, highs, work);
                }
            },
        );
    }

    /// Takes the tile of two blocks; on the diagonal `highs` has the elements of both.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn tile<T: Real, const C: usize, W: Fn(TileRow<'_, T, C>) + ?Sized>(
        self,
        [low, high]: [usize; 2],
        mut lows: Parts<'_, T, C>,
        mut highs: Parts<'_, T, C>,
        work: &W,
    ) {
        let is_below = self.triangle == Triangle::Below;
        let is_first = low == high;
        let (rows, mut columns) = match is_below {
            true => (self.rows(high), self.rows(low)),
            false => (self.rows(low), self.rows(high)),
        };
        let mut number = rows.start;
        while number < rows.end {
            let at = number - rows.start;
            let [mut own, mut others] = if is_first {
                let [before, own] = split(highs.each_mut().map(|part| &mut **part), at);
                if is_below {
                    columns.end = number;
                    [own, before]
                } else {
                    columns.start = number + 1;
                    split(own, 1)
                }
            } else {
                let lows = lows.each_mut().map(|part| &mut **part);
                let highs = highs.each_mut().map(|part| &mut **part);
                if is_below {
                    [after(highs, at), lows]
                } else {
                    [after(lows, at), highs]
                }
            };
            work(TileRow {
                number,
                columns: columns.clone(),
                is_first,
                own: own.each_mut().map(|part| &mut part[0]),
                others: others.each_mut().map(|part| &mut **part),
            });
            number += 1;
        }
    }
}

/// Returns true on the threads of a run.
fn has_threads(arithmetic: Arithmetic) -> bool {
    #[cfg(feature = "rayon")]
    if arithmetic.threads > 1 && arithmetic.lanes {
        return rayon_core::current_thread_index().is_some();
    }
    let _ = arithmetic;
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Returns the arrays after all rows.
    fn result(
        count: usize,
        triangle: Triangle,
        threads: usize,
        work: impl Fn(TileRow<'_, f64, 2>) + Copy + Sync,
    ) -> [Vec<f64>; 2] {
        let mut arrays = [(); 2].map(|()| alloc::vec![0.0; count]);
        let arithmetic = Arithmetic {
            threads,
            ..Arithmetic::default()
        };
        let columns = arrays.each_mut().map(|array| &mut array[..]);
        pairs(count, triangle, arithmetic, columns, work);
        arrays
    }

    #[test]
    fn each_pair_is_met_once() {
        for triangle in [Triangle::Below, Triangle::Above] {
            for count in [1, TILE - 1, TILE, TILE + 1, 3 * TILE - 2] {
                let [rows, columns] = result(count, triangle, 1, |row| {
                    let TileRow { own, others, .. } = row;
                    let [met, _] = own;
                    let [_, others] = others;
                    *met += row.columns.len() as f64 + if row.is_first { 0.5 } else { 0.0 };
                    for place in &mut others[..row.columns.len()] {
                        *place += 1.0;
                    }
                });
                for (i, (met, other)) in rows.iter().zip(&columns).enumerate() {
                    let (before, after) = (i as f64, (count - 1 - i) as f64);
                    let expected = match triangle {
                        Triangle::Below => [before + 0.5, after],
                        Triangle::Above => [after + 0.5, before],
                    };
                    assert_eq!([*met, *other], expected, "{triangle:?}, {count}, row {i}");
                }
            }
        }
    }

    #[cfg(feature = "rayon")]
    #[test]
    fn threads_meet_the_tiles_of_an_element_in_the_order_of_one() {
        // No other order leaves the same number.
        let after = |x: f64, tile: usize| (x * 1.25 + tile as f64).sin();
        let work = |row: TileRow<'_, f64, 2>| {
            let TileRow { own, others, .. } = row;
            let [element, _] = own;
            let [others, _] = others;
            *element = after(*element, row.columns.start);
            // One element of each column of tiles, or the last one, stands for all.
            if let Some(first) = others[..row.columns.len()].last_mut() {
                *first = after(*first, row.number);
            }
        };
        let pool = rayon_core::ThreadPoolBuilder::new().num_threads(3).build();
        let pool = pool.expect("three threads");
        for blocks in (1..=14).chain([21, 39]) {
            for triangle in [Triangle::Below, Triangle::Above] {
                let count = blocks * TILE - blocks;
                let one = result(count, triangle, 1, work);
                let three = pool.install(|| result(count, triangle, 3, work));
                assert!(one == three, "{triangle:?}, {blocks} blocks");
            }
        }
    }
}
