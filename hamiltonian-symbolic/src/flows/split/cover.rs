//! The ways to make H of pieces that have flows.
//!
//! Input: the units of H. Output: candidates, each a list of [`SolvedSum`]s. Invariant: the sums of a
//! candidate are disjoint and hold every unit; each has a flow; at most [`SUMS`] sums of units are
//! tested for a flow, and at most [`COVERS`] covers are kept.

use crate::dag::{Map, Node};
use crate::flows::limits::{COUPLED, COVERS, Limit, SUMS, TERMS};
use crate::flows::solve::forms::is_quadratic;
use crate::flows::solve::units::{Unit, Units};
use crate::flows::solve::{exponential, flow};
use crate::flows::space::{Space, Variable, Variables};
use crate::list::IntoList;
use crate::model::NamedMotion;
use crate::set::{Member, Set};
use crate::sort::Arrange;
use std::cmp::Reverse;

/// A unit by its place in the list of all.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct UnitNumber(usize);

impl Member for UnitNumber {
    fn number(self) -> u32 {
        self.0 as u32
    }
    fn numbered(number: u32) -> UnitNumber {
        UnitNumber(number as usize)
    }
}

/// A set of units.
type UnitSet = Set<UnitNumber>;

/// Some units that have a flow together.
#[derive(Clone)]
pub(crate) struct SolvedSum {
    /// Their sum.
    pub(crate) node: Node,
    /// The units.
    units: UnitSet,
    pub(crate) flow: NamedMotion,
}

struct Search<'a> {
    space: &'a mut Space,
    /// The units, in an order that follows from H alone.
    units: &'a [Unit],
    /// The places of the units in the order in which they are written.
    places: &'a [usize],
    /// The sums of which a flow was sought.
    tried: Map<UnitSet, Option<SolvedSum>>,
    sums: Vec<SolvedSum>,
    /// Sums whose search for a flow ended at a limit.
    ended: Vec<UnitSet>,
    /// The units of sums past the limit, of which no flow was sought.
    skipped: UnitSet,
    /// True if sums of coupled units were left out.
    has_many_coupled: bool,
}

impl Search<'_> {
    /// The sum of some units, in the order in which they are written.
    fn sum(&mut self, mask: UnitSet) -> Node {
        let mut numbers: Vec<UnitNumber> = mask.members().into_list();
        numbers.arrange_by_key(|UnitNumber(at)| self.places[*at]);
        let nodes = numbers.iter().map(|UnitNumber(at)| self.units[*at].node);
        let nodes: Vec<Node> = nodes.into_list();
        self.space.dag().add(&nodes)
    }
    fn solve(&mut self, mask: UnitSet) -> Option<SolvedSum> {
        if let Some(known) = self.tried.get(&mask) {
            return known.clone();
        }
        // More terms cost more.
        if self.ended.iter().any(|less| less.is_within(mask)) {
            return None;
        }
        if self.tried.len() >= SUMS {
            self.skipped |= mask;
            return None;
        }
        let node = self.sum(mask);
        let c = self.space.dag().coefficient();
        let found = flow(self.space, node, c).or_else(|| exponential(self.space, node));
        if found.is_none() && self.space.ends_at(node) {
            self.ended.push(mask);
        }
        let solved = found.map(|flow| SolvedSum {
            node,
            units: mask,
            flow,
        });
        self.tried.insert(mask, solved.clone());
        solved
    }
    /// Tries a sum and keeps it.
    fn keep(&mut self, mask: UnitSet) {
        let is_known = self.sums.iter().any(|solved| solved.units == mask);
        let solved = if is_known { None } else { self.solve(mask) };
        self.sums.extend(solved);
    }
    fn mask(&mut self, mut is: impl FnMut(&mut Space, &Unit) -> bool) -> UnitSet {
        let numbers = (0..self.units.len()).map(UnitNumber);
        numbers
            .filter(|UnitNumber(at)| is(self.space, &self.units[*at]))
            .collect()
    }
}

/// The candidates, fewest pieces first, or a term without a flow.
pub(crate) fn candidates(space: &mut Space, units: &Units) -> Result<Vec<Vec<SolvedSum>>, Node> {
    if units.units.len() > TERMS {
        let first = units.units[0].source;
        space.meets(Limit::Terms, first);
        return Err(first);
    }
    let nodes: Vec<Node> = units.units.iter().map(|unit| unit.node).into_list();
    let places = space.in_order(&nodes);
    let ordered: Vec<Unit> = places.iter().map(|at| units.units[*at]).into_list();
    let mut search = Search {
        space,
        units: &ordered,
        places: &places,
        tried: Map::default(),
        sums: Vec::new(),
        ended: Vec::new(),
        skipped: UnitSet::default(),
        has_many_coupled: false,
    };
    let coupled = search.mask(|_, unit| unit.is_coupled);
    let all: UnitSet = (0..units.units.len()).map(UnitNumber).collect();
    if let Some(whole) = search.solve(all) {
        return Ok(vec![vec![whole]]);
    }
    coupled_sums(&mut search, coupled, all.without(coupled));
    let mut covers = covers(&search.sums, coupled);
    if covers.len() == COVERS {
        // If there are too many, those of few sums are kept.
        search
            .sums
            .arrange_by_key(|solved| Reverse(solved.units.len()));
        covers = self::covers(&search.sums, coupled);
    }
    if covers.is_empty() {
        // The first that is in no sum; of overlapping sums, the first that is none by itself.
        let sums = &search.sums;
        let is_bad = |at: usize, alone: bool| {
            let own = UnitNumber(at);
            let is_in =
                |solved: &SolvedSum| solved.units.has(own) && !(alone && solved.units.len() > 1);
            ordered[at].is_coupled && !sums.iter().any(is_in)
        };
        let bad = [false, true].into_iter().find_map(|alone| {
            let bad = (0..ordered.len()).filter(|at| is_bad(*at, alone));
            bad.min_by_key(|at| places[*at])
        });
        let bad = bad.unwrap_or(0);
        let limit = match () {
            () if search.skipped.has(UnitNumber(bad)) => Some(Limit::Sums),
            () => search.has_many_coupled.then_some(Limit::Coupled),
        };
        let source = ordered[bad].source;
        if let Some(limit) = limit
            && !space.ends_at(ordered[bad].node)
        {
            space.meets(limit, source);
        }
        return Err(source);
    }
    let uncoupled = uncoupled_sums(&mut search, all.without(coupled));
    let mut found = Vec::new();
    for cover in &covers {
        let used = union(cover);
        let more = uncoupled.iter().filter(|solved| !solved.units.meets(used));
        for extra in std::iter::once(None).chain(more.map(Some)) {
            let mut pieces = cover.clone();
            pieces.extend(extra.cloned());
            let left = all.without(union(&pieces));
            pieces.extend(linear_pieces(&mut search, left));
            found.push(pieces);
        }
    }
    found.arrange_by_key(Vec::len);
    Ok(found)
}

/// All units of some sums.
fn union(sums: &[SolvedSum]) -> UnitSet {
    let units = sums.iter().map(|solved| solved.units);
    units.fold(UnitSet::default(), |all, units| all | units)
}

/// Sums of coupled units, without and with uncoupled ones.
fn coupled_sums(search: &mut Search, coupled: UnitSet, uncoupled: UnitSet) {
    let pool = |search: &mut Search, sides: (bool, bool)| {
        search.mask(|space, unit| !unit.is_coupled && space.set(unit.node).sides() == sides)
    };
    let (v, t, mixed) = (
        pool(search, (true, false)),
        pool(search, (false, true)),
        pool(search, (true, true)),
    );
    let mut offers: Vec<UnitSet> = vec![v, t, mixed, v | mixed, t | mixed, uncoupled];
    offers.extend(uncoupled.members().map(UnitSet::of));
    let numbers: Vec<UnitNumber> = coupled.members().into_list();
    let mut subsets: Vec<UnitSet> = coupled.members().map(UnitSet::of).into_list();
    if numbers.len() <= COUPLED {
        let chosen = |choice: usize| {
            let all = numbers.iter().enumerate();
            let chosen = all.filter(move |(at, _)| choice >> at & 1 == 1);
            chosen.map(|(_, number)| *number).collect()
        };
        let mut larger: Vec<UnitSet> = (1..1 << numbers.len()).map(chosen).collect();
        larger.retain(|mask| mask.len() > 1);
        larger.arrange_by_key(|mask| mask.len());
        subsets.extend(larger);
    } else {
        search.has_many_coupled = true;
        subsets.push(coupled);
        for (at, a) in numbers.iter().enumerate() {
            subsets.extend(
                numbers[at + 1..]
                    .iter()
                    .map(|b| UnitSet::of(*a) | UnitSet::of(*b)),
            );
        }
    }
    // Alone first: the limit then cuts off refinements only.
    for &subset in &subsets {
        search.keep(subset);
    }
    for &subset in &subsets {
        for &offer in &offers {
            search.keep(subset | offer);
        }
    }
}

/// Disjoint sums that hold all coupled units.
fn covers(sums: &[SolvedSum], coupled: UnitSet) -> Vec<Vec<SolvedSum>> {
    fn extend(
        sums: &[SolvedSum],
        left: UnitSet,
        used: UnitSet,
        now: &mut Vec<SolvedSum>,
        all: &mut Vec<Vec<SolvedSum>>,
    ) {
        if all.len() >= COVERS {
            return;
        }
        let Some(first) = left.members().next() else {
            all.push(now.clone());
            return;
        };
        for solved in sums {
            if solved.units.has(first) && !solved.units.meets(used) {
                now.push(solved.clone());
                extend(
                    sums,
                    left.without(solved.units),
                    used | solved.units,
                    now,
                    all,
                );
                now.pop();
            }
        }
    }
    let mut all = Vec::new();
    extend(sums, coupled, UnitSet::default(), &mut Vec::new(), &mut all);
    all
}

/// Sums of uncoupled units that a form takes together: quadratic forms, of all pairs and of one;
/// p² with all that is divided by r².
fn uncoupled_sums(search: &mut Search, uncoupled: UnitSet) -> Vec<SolvedSum> {
    let mut masks = Vec::new();
    let quadratic = search.mask(|space, unit| {
        !unit.is_coupled && space.proves(|space| is_quadratic(space, unit.node))
    });
    masks.push(quadratic);
    for pair in 0..search.space.pairs.len() {
        let [coordinate, momentum] = Variable::pair(pair).map(Variables::of);
        let own = coordinate | momentum;
        let here = search.mask(|space, unit| space.set(unit.node).is_within(own));
        masks.push(here & quadratic);
        masks.push(here & uncoupled);
        let (r, _) = search.space.pairs[pair];
        let flight = search.mask(|space, unit| {
            let set = space.set(unit.node);
            if unit.is_coupled || set == momentum {
                return set == momentum;
            }
            if set & own != coordinate {
                return false;
            }
            space.proves(|space| {
                let slope = space.d(unit.node, r);
                let slope = space.dag().mul(&[r, slope]);
                space.ratio(slope, unit.node) == Some(-2)
            })
        });
        masks.push(flight);
    }
    let mut found: Vec<SolvedSum> = Vec::new();
    for mask in masks {
        let is_known = found.iter().any(|solved| solved.units == mask);
        if mask.len() > 1
            && !is_known
            && let Some(solved) = search.solve(mask)
            && !solved.flow.forms.is_empty()
        {
            found.push(solved);
        }
    }
    found
}

/// Uncoupled units as few pieces in which no conjugate pair meets.
fn linear_pieces(search: &mut Search, uncoupled: UnitSet) -> Vec<SolvedSum> {
    let mut numbers: Vec<UnitNumber> = uncoupled.members().into_list();
    let order = |set: Variables| match set.sides() {
        (false, _) => 0,
        (_, false) => 1,
        _ => 2,
    };
    let units = search.units;
    numbers.arrange_by_key(|at| order(search.space.set(units[at.0].node)));
    let mut colours: Vec<(UnitSet, Variables)> = Vec::new();
    for at in numbers {
        let set = search.space.set(units[at.0].node);
        let fits = |both: Variables| both.whole_pairs().is_empty();
        match colours.iter_mut().find(|(_, known)| fits(*known | set)) {
            Some(colour) => {
                colour.0 |= UnitSet::of(at);
                colour.1 |= set;
            }
            None => colours.push((UnitSet::of(at), set)),
        }
    }
    let sums = colours.into_iter().filter_map(|(mask, _)| {
        let node = search.sum(mask);
        let c = search.space.dag().coefficient();
        let flow = flow(search.space, node, c)?;
        Some(SolvedSum {
            node,
            units: mask,
            flow,
        })
    });
    sums.into_list()
}
