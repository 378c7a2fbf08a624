//! Placing every node in the block where it is computed: its binding time, its loop, its order.
//!
//! Input: requests (expressions to return and to store) over nodes as `share` left them. Output:
//! [`Program`]. Invariant: a node stands in the outermost loop it can be computed in; all work of
//! one binding time over one loop shares one nest; a node that needs a finished sum stands in a later nest over
//! the same loop, where the body is computed again.

mod instruct;

use crate::dag::{Dag, Dependence, Kind, Map, Node, Numbers, Stage};
use crate::hoist::Hoisted;
use crate::index::{Domain, Index};
use crate::list::IntoList;
use crate::op::Op;
use crate::program::{Function, Instruction, Loop, Program, Purpose, Step, Target, Update, Value};
use crate::programs::factor::count_uses;
use crate::sort::Arrange;
use instruct::fused_terms;

/// Coordinates and momenta.
const SPACE: Dependence = Dependence(Dependence::Q.0 | Dependence::P.0);

/// An element of an output and what is put there, in every iteration of the value's loop.
#[derive(Clone, Debug)]
pub struct Store {
    /// The output.
    pub target: Target,
    /// The element.
    pub row: Index,
    /// Its column, for rank-2 parameters.
    pub column: Option<Index>,
    /// The number stored there.
    pub value: Node,
    /// True if it is added to what is there.
    pub add: bool,
}

/// The work of a function.
#[derive(Clone, Debug)]
pub struct Request {
    /// Its purpose.
    pub purpose: Purpose,
    /// The expressions it returns.
    pub results: Vec<Node>,
    /// The elements it stores.
    pub stores: Vec<Store>,
    /// Outputs to be set to 0 first.
    pub cleared: Vec<Target>,
    /// The loop in which all that moves is computed and stored: its iterations read what those
    /// before them wrote.
    pub pinned: Option<Domain>,
}

impl Request {
    /// All expressions of the request.
    #[must_use]
    pub fn roots(&self) -> Vec<Node> {
        self.results
            .iter()
            .copied()
            .chain(self.stores.iter().map(|s| s.value))
            .into_list()
    }
    /// Puts other expressions in their places, in the order of [`Request::roots`].
    pub fn replace_roots(&mut self, roots: &[Node]) {
        let (results, stores) = roots.split_at(self.results.len());
        self.results.copy_from_slice(results);
        for (store, value) in self.stores.iter_mut().zip(stores) {
            store.value = *value;
        }
    }
}

/// The expressions of parameters alone that the requests read.
#[must_use]
pub fn prepared(dag: &Dag, requests: &[Request]) -> Vec<Node> {
    let mut wanted = Vec::new();
    for request in requests {
        let (coefficients, mut direct) = frontier(dag, &request.roots(), Stage::Evaluation);
        wanted.append(&mut direct);
        wanted.append(&mut frontier(dag, &coefficients, Stage::Coefficient).1);
    }
    wanted.arrange();
    wanted.dedup();
    wanted
}

/// Schedules the functions: first what is [`prepared`] for all of them, where the second of each two
/// expressions is computed for the first, then each one's coefficient stage, then its evaluation.
#[must_use]
pub fn schedule(
    dag: &Dag,
    requests: &[Request],
    (wanted, images): (&[Node], &[Node]),
    hoisted: Vec<Hoisted>,
) -> Program {
    let mut program = Program::default();
    let nothing = Numbers::new(dag);
    let fill = |(hoisted, number): (&Hoisted, u16)| Store {
        target: Target::Hoisted(number),
        row: Index::of_loop(hoisted.domain),
        column: None,
        value: hoisted.value,
        add: false,
    };
    let fills: Vec<Store> = hoisted.iter().zip(0..).map(fill).into_list();
    let (prepare, computed) = stage(
        dag,
        &mut program,
        Stage::Parameters,
        images,
        &fills,
        None,
        nothing.clone(),
    );
    program.prepare = prepare;
    program.hoisted = hoisted;
    // Only what is wanted is handed on, not what it was computed from.
    let mut prepared = nothing;
    for (&node, &image) in wanted.iter().zip(images) {
        let value = value_of(&computed, image);
        prepared.set(node, value.0);
        if !program.prepared.contains(&value) {
            program.prepared.push(value);
        }
    }
    for request in requests {
        let (coefficients, _) = frontier(dag, &request.roots(), Stage::Evaluation);
        let (coefficient, carried) = stage(
            dag,
            &mut program,
            Stage::Coefficient,
            &coefficients,
            &[],
            None,
            prepared.clone(),
        );
        let (evaluation, values) = stage(
            dag,
            &mut program,
            Stage::Evaluation,
            &request.results,
            &request.stores,
            request.pinned,
            carried,
        );
        let results = request.results.iter();
        let results = results.map(|n| value_of(&values, *n)).into_list();
        program.functions.push(Function {
            purpose: request.purpose,
            coefficient,
            evaluation,
            cleared: request.cleared.clone(),
            results,
        });
    }
    program
}

/// The stage that computes a node needed in `now`: numbers stand where they are used, other
/// constants are prepared, and nothing that depends on a loop is carried over.
fn stage_of(dag: &Dag, node: Node, now: Stage) -> Stage {
    if !dag.variables(node).is_empty() || matches!(dag.kind(node), Kind::Constant(_) | Kind::Pi) {
        return now;
    }
    dag.stage(node).max(Stage::Parameters)
}

/// The nodes of the coefficient stage and of preparation that the roots need in stage `now`.
fn frontier(dag: &Dag, roots: &[Node], now: Stage) -> (Vec<Node>, Vec<Node>) {
    let is_later = |node: &Node| stage_of(dag, *node, now) == now;
    let mut known = dag.reached(roots, &mut |node, ahead| {
        if is_later(&node) {
            dag.for_children(node, |child| ahead.add(child));
        }
    });
    known.retain(|node| !is_later(node));
    let is_coefficient = |node: &Node| stage_of(dag, *node, now) == Stage::Coefficient;
    known.into_iter().partition(is_coefficient)
}

/// The block of one stage, and the values known after it.
fn stage(
    dag: &Dag,
    program: &mut Program,
    stage: Stage,
    wanted: &[Node],
    stores: &[Store],
    pinned: Option<Domain>,
    carried: Numbers,
) -> (Vec<Step>, Numbers) {
    let roots: Vec<Node> = wanted
        .iter()
        .copied()
        .chain(stores.iter().map(|s| s.value))
        .into_list();
    let uses = count_uses(dag, &roots, &dag.reachable(&roots));
    let mut placer = Placer {
        dag,
        program,
        uses: &uses,
        stage,
        known: carried,
        scopes: Vec::new(),
        open: Vec::new(),
        pinned,
    };
    let stores: Vec<&Store> = stores.iter().into_list();
    let steps = placer.block(None, wanted, &stores);
    (steps, placer.known)
}

/// The value of a node that is computed.
fn value_of(known: &Numbers, node: Node) -> Value {
    let found = known.get(node);
    found.map_or(Value::NONE, Value)
}

pub(crate) struct Placer<'a> {
    pub(crate) dag: &'a Dag,
    program: &'a mut Program,
    /// The number of uses of each node in this stage's expressions.
    uses: &'a Numbers,
    stage: Stage,
    /// The values of what is computed, by earlier stages and in the open blocks.
    known: Numbers,
    /// The nodes computed in each of the open blocks, outermost first.
    scopes: Vec<Vec<Node>>,
    open: Vec<Option<Domain>>,
    /// The loop in which all that moves is computed.
    pinned: Option<Domain>,
}

impl Placer<'_> {
    fn stage_of(&self, node: Node) -> Stage {
        stage_of(self.dag, node, self.stage)
    }

    fn new_value(&mut self, instruction: Instruction) -> Value {
        self.program.instructions.push(instruction);
        Value(self.program.instructions.len() as u32 - 1)
    }

    /// The value of a node that is already computed.
    pub(crate) fn value(&self, node: Node) -> Value {
        value_of(&self.known, node)
    }

    /// Appends an instruction to a block.
    pub(crate) fn push(&mut self, steps: &mut Vec<Step>, instruction: Instruction) -> Value {
        let value = self.new_value(instruction);
        steps.push(Step::Let(value));
        value
    }

    /// The loop a node is computed in.
    fn home(&self, node: Node) -> Option<Domain> {
        match self.pinned {
            Some(_) if self.dag.dependence(node).on(SPACE) => self.pinned,
            _ => self.dag.home(node),
        }
    }

    fn home_of(&self, store: &Store) -> Option<Domain> {
        if self.pinned.is_some() {
            return self.pinned;
        }
        let indices = std::iter::once(&store.row).chain(&store.column);
        let set = self.dag.variables(store.value);
        let set = indices.fold(set, |set, index| set | index.variables());
        self.dag.deepest(set)
    }

    /// The steps that compute `wanted` and make `stores` inside loop `here`; it opens a scope
    /// in which their values can be looked up and which the caller closes.
    fn block(&mut self, here: Option<Domain>, wanted: &[Node], stores: &[&Store]) -> Vec<Step> {
        self.scopes.push(Vec::new());
        self.open.push(here);
        let needed = self.needed(wanted, stores);
        let mut level = Numbers::new(self.dag);
        let mut nests: Vec<LoopWork> = Vec::new();
        let mut last = 0;
        for &node in &needed {
            let mut own = 0;
            self.dag
                .for_children(node, |child| own = own.max(level.get(child).unwrap_or(0)));
            if self.home(node) == here
                && let Kind::Reduce(domain, _) = self.dag.kind(node)
            {
                own += 1;
                LoopWork::at(&mut nests, own, *domain).sums.push(node);
            }
            last = last.max(own);
            level.set(node, own);
        }
        let mut own_stores: Vec<(u32, &Store)> = Vec::new();
        for &store in stores {
            let own = level.get(store.value).unwrap_or(0);
            let home = self.home_of(store);
            if home == here {
                own_stores.push((own, store));
            } else {
                let path = self.dag.path(home);
                let Some(&next) = path.iter().find(|d| !self.open.contains(&Some(**d))) else {
                    continue;
                };
                LoopWork::at(&mut nests, own + 1, next).stores.push(store);
                last = last.max(own + 1);
            }
        }
        let fused = self.fused(here, &needed, wanted, stores);
        let mut steps = Vec::new();
        for now in 0..=last {
            for nest in nests.iter().filter(|n| n.level == now) {
                let step = self.nest(nest);
                steps.push(Step::Loop(step));
            }
            for &node in &needed {
                let is_now = level.get(node) == Some(now);
                if is_now && self.home(node) == here && !fused.contains_key(&node) {
                    self.compute(&mut steps, node, &level);
                }
            }
            for (_, store) in own_stores.iter().filter(|(l, _)| *l == now) {
                self.store(&mut steps, store, &fused);
            }
        }
        self.open.pop();
        steps
    }

    /// The nodes of this stage not yet computed that the wanted ones need, bottom-up.
    fn needed(&self, wanted: &[Node], stores: &[&Store]) -> Vec<Node> {
        let stored = stores.iter().map(|store| store.value);
        let roots: Vec<Node> = wanted.iter().copied().chain(stored).into_list();
        let is_needed = |node: Node| !self.is_computed(node) && self.stage_of(node) == self.stage;
        let mut needed = self.dag.reached(&roots, &mut |node, ahead| {
            if is_needed(node) {
                self.dag.for_children(node, |child| ahead.add(child));
            }
        });
        needed.retain(|node| is_needed(*node));
        needed
    }

    fn nest(&mut self, nest: &LoopWork) -> Loop {
        let range = self.dag.range(nest.domain).clone();
        let mut accumulators = Vec::new();
        for &sum in &nest.sums {
            let value = self.new_value(Instruction::Accumulator);
            accumulators.push(value);
            self.define(sum, value);
        }
        let bodies: Vec<Node> = nest
            .sums
            .iter()
            .map(|sum| match self.dag.kind(*sum) {
                Kind::Reduce(_, body) => *body,
                _ => *sum,
            })
            .into_list();
        let mut body = self.block(Some(nest.domain), &bodies, &nest.stores);
        for (accumulator, term) in accumulators.iter().zip(&bodies) {
            let term = self.value(*term);
            body.push(Step::Accumulate(*accumulator, term));
        }
        for node in self.scopes.pop().expect("a block opened its scope") {
            self.known.unset(node);
        }
        Loop {
            domain: nest.domain,
            start: range.start,
            end: range.end,
            accumulators,
            body,
        }
    }

    /// Products that become part of one fused instruction of their only user.
    fn fused(
        &self,
        here: Option<Domain>,
        needed: &[Node],
        wanted: &[Node],
        stores: &[&Store],
    ) -> Map<Node, ()> {
        let mut fused: Map<Node, ()> = Map::default();
        let open = |node: Node| self.stage_of(node) == self.stage && self.home(node) == here;
        let can_fuse = |node: Node| open(node) && self.can_fuse(node);
        for &node in needed {
            if open(node)
                && let Kind::Sum(c, terms) = self.dag.kind(node)
            {
                fused.extend(fused_terms(c, terms, &can_fuse).map(|term| (term, ())));
            }
        }
        for store in stores {
            if store.add
                && open(store.value)
                && self.home_of(store) == here
                && (self.can_fuse(store.value) || self.is_negative_once(store.value))
            {
                fused.insert(store.value, ());
            }
        }
        let wanted: Map<Node, ()> = wanted.iter().map(|node| (*node, ())).collect();
        fused.retain(|node| !wanted.contains_key(node));
        fused
    }

    /// Returns true if a node is a product without divisors, used once.
    pub(crate) fn can_fuse(&self, node: Node) -> bool {
        match self.dag.kind(node) {
            Kind::Product(_, factors) => {
                self.uses.get(node) == Some(1)
                    && factors.iter().all(|(_, n)| *n > 0)
                    && factors.iter().map(|(_, n)| n).sum::<i32>() > 1
            }
            _ => false,
        }
    }

    /// Returns true if a node is a negative product, used once.
    fn is_negative_once(&self, node: Node) -> bool {
        matches!(self.dag.kind(node), Kind::Product(k, _) if k.is_negative())
            && self.uses.get(node) == Some(1)
    }

    /// Returns true if a node's value can be looked up.
    pub(crate) fn is_computed(&self, node: Node) -> bool {
        self.known.has(node)
    }

    /// Computes a node whose children are computed; `needed` are the nodes of the block.
    fn compute(&mut self, steps: &mut Vec<Step>, node: Node, needed: &Numbers) {
        if self.is_computed(node) {
            return;
        }
        let partner = match self.dag.kind(node) {
            Kind::Call(Op::Sin, x) => self.dag.known(&Kind::Call(Op::Cos, x.clone())),
            Kind::Call(Op::Cos, x) => self.dag.known(&Kind::Call(Op::Sin, x.clone())),
            _ => None,
        };
        let value = match (self.dag.kind(node).clone(), partner) {
            (Kind::Call(op, x), Some(partner)) if needed.has(partner) => {
                let angle = self.value(x[0]);
                let sin = self.push(steps, Instruction::PairedSin(angle));
                let cos = self.push(steps, Instruction::PairedCos(sin));
                let (own, other) = if op == Op::Sin {
                    (sin, cos)
                } else {
                    (cos, sin)
                };
                self.define(partner, other);
                own
            }
            (kind, _) => self.instruct(steps, node, &kind),
        };
        self.define(node, value);
    }

    /// Notes a node's value in the innermost block.
    fn define(&mut self, node: Node, value: Value) {
        assert!(!self.known.has(node), "{node:?} is computed twice");
        self.known.set(node, value.0);
        if let Some(scope) = self.scopes.last_mut() {
            scope.push(node);
        }
    }

    fn store(&mut self, steps: &mut Vec<Step>, store: &Store, fused: &Map<Node, ()>) {
        let update = match self.dag.kind(store.value) {
            Kind::Product(k, factors) if fused.contains_key(&store.value) => {
                let negative = k.is_negative();
                if self.can_fuse(store.value) {
                    let (_, (a, b)) = self.split_product(steps, store.value);
                    if negative {
                        Update::SubProduct(a, b)
                    } else {
                        Update::AddProduct(a, b)
                    }
                } else {
                    let (k, factors) = (k.abs(), factors.clone());
                    Update::Sub(self.product(steps, &k, &factors))
                }
            }
            _ if store.add => Update::Add(self.value(store.value)),
            _ => Update::Set(self.value(store.value)),
        };
        steps.push(Step::Store(
            store.target,
            store.row.clone(),
            store.column.clone(),
            update,
        ));
    }
}

/// The work of one level over one loop.
struct LoopWork<'a> {
    level: u32,
    domain: Domain,
    sums: Vec<Node>,
    stores: Vec<&'a Store>,
}

impl<'a> LoopWork<'a> {
    fn at<'n>(
        nests: &'n mut Vec<LoopWork<'a>>,
        level: u32,
        domain: Domain,
    ) -> &'n mut LoopWork<'a> {
        let is_asked = |nest: &LoopWork| (nest.level, nest.domain) == (level, domain);
        let at = nests.iter().position(is_asked).unwrap_or(nests.len());
        if at == nests.len() {
            nests.push(LoopWork {
                level,
                domain,
                sums: Vec::new(),
                stores: Vec::new(),
            });
        }
        &mut nests[at]
    }
}
