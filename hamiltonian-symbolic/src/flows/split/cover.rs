//! The ways to make H of pieces that have flows.
//!
//! Input: the units of H. Output: candidates, each a list of [`Block`]s. Invariant: the blocks of a
//! candidate are disjoint and hold every unit; each has a flow; at most [`BLOCKS`] are tried.

use crate::dag::{Map, Node};
use crate::flows::solve::rows::is_quadratic;
use crate::flows::solve::units::{Unit, Units};
use crate::flows::solve::{exponential, flow};
use crate::flows::space::{Set, Space, TERMS};
use crate::model::Flow;

/// The most blocks of which a flow is sought.
const BLOCKS: usize = 64;
/// The most ways to cover the hard units.
const COVERS: usize = 60;
/// The most hard units all of whose subsets are tried.
const SUBSETS: usize = 5;

/// Some units that have a flow together.
#[derive(Clone)]
pub(crate) struct Block {
    /// Their sum.
    pub(crate) node: Node,
    /// The units.
    units: u64,
    pub(crate) flow: Flow,
}

struct Search<'a> {
    space: &'a mut Space,
    units: &'a [Unit],
    tried: Map<u64, Option<Flow>>,
    blocks: Vec<Block>,
}

impl Search<'_> {
    fn sum(&mut self, mask: u64) -> Node {
        let nodes: Vec<Node> = self.of(mask).map(|unit| unit.node).collect();
        self.space.dag().add(&nodes)
    }
    fn of(&self, mask: u64) -> impl Iterator<Item = &Unit> {
        let units = self.units.iter().enumerate();
        units
            .filter(move |(at, _)| mask >> at & 1 == 1)
            .map(|(_, unit)| unit)
    }
    fn block(&mut self, mask: u64) -> Option<Block> {
        let node = self.sum(mask);
        let known = match self.tried.get(&mask) {
            Some(known) => known.clone(),
            None if self.tried.len() >= BLOCKS => None,
            None => {
                let c = self.space.dag().coefficient();
                let found = flow(self.space, node, c);
                let found = found.or_else(|| exponential(self.space, node));
                self.tried.insert(mask, found.clone());
                found
            }
        };
        known.map(|flow| Block {
            node,
            units: mask,
            flow,
        })
    }
    /// Tries a block and keeps it.
    fn keep(&mut self, mask: u64) {
        let is_known = self.blocks.iter().any(|block| block.units == mask);
        let block = if is_known { None } else { self.block(mask) };
        self.blocks.extend(block);
    }
    fn mask(&mut self, mut is: impl FnMut(&mut Space, &Unit) -> bool) -> u64 {
        let mut mask = 0;
        for (at, unit) in self.units.iter().enumerate() {
            if is(self.space, unit) {
                mask |= 1 << at;
            }
        }
        mask
    }
}

const COORDINATES: Set = 0x5555_5555_5555_5555;

/// The candidates, fewest pieces first, or a term without a flow.
pub(crate) fn candidates(space: &mut Space, units: &Units) -> Result<Vec<Vec<Block>>, Node> {
    if units.units.len() > TERMS {
        space.has_more_terms = true;
        return Err(units.units[0].source);
    }
    let mut search = Search {
        space,
        units: &units.units,
        tried: Map::default(),
        blocks: Vec::new(),
    };
    let hard = search.mask(|_, unit| unit.is_hard);
    let all = (1 << units.units.len()) - 1;
    if let Some(whole) = search.block(all) {
        return Ok(vec![vec![whole]]);
    }
    hard_blocks(&mut search, hard, all & !hard);
    let covers = covers(&search.blocks, hard);
    if covers.is_empty() {
        let bad = units.units.iter().enumerate().find(|(at, unit)| {
            unit.is_hard && !search.blocks.iter().any(|block| block.units >> at & 1 == 1)
        });
        let bad = bad.map_or(units.units[0], |(_, unit)| *unit);
        return Err(bad.source);
    }
    let easy = easy_blocks(&mut search, all & !hard);
    let mut found = Vec::new();
    for cover in &covers {
        let used = cover.iter().fold(0, |mask, block| mask | block.units);
        let more = easy.iter().filter(|block| block.units & used == 0);
        for extra in std::iter::once(None).chain(more.map(Some)) {
            let mut pieces = cover.clone();
            pieces.extend(extra.cloned());
            let left = all & !used & !extra.map_or(0, |block| block.units);
            pieces.extend(linear_pieces(&mut search, left));
            found.push(pieces);
        }
    }
    found.sort_by_key(Vec::len);
    Ok(found)
}

/// Blocks with hard units, by themselves and with easy ones.
fn hard_blocks(search: &mut Search, hard: u64, easy: u64) {
    let pool = |search: &mut Search, sides: (bool, bool)| {
        search.mask(|space, unit| {
            let set = space.set(unit.node);
            !unit.is_hard && (set & COORDINATES != 0, set & !COORDINATES != 0) == sides
        })
    };
    let (v, t, mixed) = (
        pool(search, (true, false)),
        pool(search, (false, true)),
        pool(search, (true, true)),
    );
    let mut offers: Vec<u64> = vec![v, t, mixed, v | mixed, t | mixed, easy];
    let singles = (0..64).map(|at| 1 << at).filter(|mask| easy & mask != 0);
    offers.extend(singles);
    let numbers: Vec<u64> = (0..64)
        .map(|at| 1 << at)
        .filter(|m| hard & m != 0)
        .collect();
    let mut subsets: Vec<u64> = numbers.clone();
    if numbers.len() <= SUBSETS {
        let larger = 1u64..1 << numbers.len();
        let mut larger: Vec<u64> = larger.filter(|set| set.count_ones() > 1).collect();
        larger.sort_by_key(|set| set.count_ones());
        let as_units = |set: u64| {
            let chosen = numbers
                .iter()
                .enumerate()
                .filter(move |(at, _)| set >> at & 1 == 1);
            chosen.fold(0, |mask, (_, bit)| mask | bit)
        };
        subsets.extend(larger.into_iter().map(as_units));
    } else {
        for (at, a) in numbers.iter().enumerate() {
            subsets.extend(numbers[at + 1..].iter().map(|b| a | b));
        }
        subsets.push(hard);
    }
    // Alone first, so that the limit meets refinements.
    for &subset in &subsets {
        search.keep(subset);
    }
    for &subset in &subsets {
        for &offer in &offers {
            search.keep(subset | offer);
        }
    }
}

/// Disjoint blocks that hold all hard units.
fn covers(blocks: &[Block], hard: u64) -> Vec<Vec<Block>> {
    fn extend(
        blocks: &[Block],
        left: u64,
        used: u64,
        now: &mut Vec<Block>,
        all: &mut Vec<Vec<Block>>,
    ) {
        if all.len() >= COVERS {
            return;
        }
        if left == 0 {
            all.push(now.clone());
            return;
        }
        let first = 1 << left.trailing_zeros();
        for block in blocks {
            if block.units & first != 0 && block.units & used == 0 {
                now.push(block.clone());
                extend(blocks, left & !block.units, used | block.units, now, all);
                now.pop();
            }
        }
    }
    let mut all = Vec::new();
    extend(blocks, hard, 0, &mut Vec::new(), &mut all);
    all
}

/// Blocks of easy units that a row takes together: quadratic forms, of all pairs and of one;
/// p² with all that is divided by r².
fn easy_blocks(search: &mut Search, easy: u64) -> Vec<Block> {
    let mut masks = Vec::new();
    let quadratic = search.mask(|space, unit| !unit.is_hard && is_quadratic(space, unit.node));
    masks.push(quadratic);
    for pair in 0..search.space.pairs.len() {
        let own: Set = 3 << (2 * pair);
        let here = search.mask(|space, unit| space.set(unit.node) & !own == 0);
        masks.push(here & quadratic);
        masks.push(here & easy);
        let (r, _) = search.space.pairs[pair];
        let momentum: Set = 2 << (2 * pair);
        let flight = search.mask(|space, unit| {
            let set = space.set(unit.node);
            if unit.is_hard || set == momentum {
                return set == momentum;
            }
            if set & own != own & COORDINATES {
                return false;
            }
            let slope = space.d(unit.node, r);
            let slope = space.dag().mul(&[r, slope]);
            space.ratio(slope, unit.node) == Some(-2)
        });
        masks.push(flight);
    }
    let mut found: Vec<Block> = Vec::new();
    for mask in masks {
        let is_known = found.iter().any(|block| block.units == mask);
        if mask.count_ones() > 1
            && !is_known
            && let Some(block) = search.block(mask)
            && !block.flow.rows.is_empty()
        {
            found.push(block);
        }
    }
    found
}

/// Easy units as few pieces in which no conjugate pair meets.
fn linear_pieces(search: &mut Search, easy: u64) -> Vec<Block> {
    let mut numbers: Vec<usize> = (0..search.units.len())
        .filter(|at| easy >> at & 1 == 1)
        .collect();
    let order = |set: Set| match (set & COORDINATES != 0, set & !COORDINATES != 0) {
        (false, _) => 0,
        (_, false) => 1,
        _ => 2,
    };
    let units = search.units;
    numbers.sort_by_key(|at| order(search.space.set(units[*at].node)));
    let mut colours: Vec<(u64, Set)> = Vec::new();
    for at in numbers {
        let set = search.space.set(units[at].node);
        let fits = |both: Set| both & both >> 1 & COORDINATES == 0;
        match colours.iter_mut().find(|(_, known)| fits(*known | set)) {
            Some(colour) => {
                colour.0 |= 1 << at;
                colour.1 |= set;
            }
            None => colours.push((1 << at, set)),
        }
    }
    let blocks = colours.into_iter().filter_map(|(mask, _)| {
        let node = search.sum(mask);
        let c = search.space.dag().coefficient();
        let flow = flow(search.space, node, c)?;
        Some(Block {
            node,
            units: mask,
            flow,
        })
    });
    blocks.collect()
}
