//! The schemes by name.
//!
//! Input: a name. Output: the scheme, or the name nearest to it. Invariant: every scheme of core's
//! catalogue is here by its name and variant, but for those that need another type of system; splittings, Nyström and
//! processed schemes are values of one type each.

use crate::by_table::{ByTable, Moves};
use crate::erased::AnyScheme;
use crate::error::RunError;
use crate::in_frame::InFrame;
use crate::many::Many;
use crate::system::RuntimeSystem;
use crate::weights::{Named, Table, Weights};
use hamiltonian_core::Scheme;
use hamiltonian_core::schemes::author::{Entry, Listed, Splitting};
use hamiltonian_core::schemes::{self as core, SecondPoint};
use hamiltonian_language::names::nearest;
use std::sync::LazyLock;

/// A scheme, with the name by which runs take it.
///
/// ```
/// use hamiltonian_runtime::schemes;
///
/// let eighth = schemes().filter(|scheme| scheme.entry.order == 8);
/// assert!(eighth.map(|scheme| scheme.name).any(|name| name == "Gauss4"));
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct NamedScheme {
    /// The name: `StormerVerlet`, `Gauss8`, `MidpointProjected(BlanesMoan6)`.
    pub name: String,
    /// Its order, the structure that it requires, the form that it preserves, its source.
    pub entry: Entry,
    /// True if [`Swarm`](crate::Swarm) takes it too.
    pub in_ensembles: bool,
}

/// All schemes that a [`Run`](crate::Run) takes by name, each with its facts.
///
/// A name may have spaces, and Rust's brackets: `Gauss::<8>` is `Gauss8`, and `StormerVerlet (drift-kick-drift)` is
/// `StormerVerlet(drift-kick-drift)`. Of a scheme with settings, the name alone is that of the default.
pub fn schemes() -> impl Iterator<Item = NamedScheme> {
    ALL.iter().map(|(name, scheme)| NamedScheme {
        name: name.clone(),
        entry: scheme.entry(),
        in_ensembles: matches!(scheme, Known::Many(_)),
    })
}

/// The schemes by their types, of which those of splittings are tables. With `true`, a step is compiled once; with `false`,
/// the loop over steps is that of the scheme.
macro_rules! known {
    ($($type:ident: $of:ty, $once:literal;)+) => {
        /// A scheme.
        enum Known {
            $($type($of),)+
        }

        impl Known {
            fn entry(&self) -> Entry {
                match self {
                    $(Known::$type(scheme) => scheme.entry(),)+
                }
            }

            fn any(&self) -> AnyScheme {
                match self {
                    $(Known::$type(scheme) => AnyScheme::new::<$once>(scheme.clone()),)+
                }
            }
        }
    };
}

known! {
    Many: Many, false;
    Processed: InFrame<core::Processed<Weights, Weights>>, false;
    CheapProcessed: InFrame<core::CheapProcessed<Weights, Weights, Weights>>, false;
    Compensated: core::Compensated<Weights>, true;
    MidpointProjected: core::MidpointProjected<Weights>, true;
    Mixed: core::Mixed<Weights>, true;
    Semiexplicit: core::Semiexplicit<Weights>, true;
    RungeKutta4: core::RungeKutta4, true;
    Gauss2: core::Gauss<2>, false;
    Gauss8: core::Gauss<8>, false;
    GaussNystrom4: core::GaussNystrom<4>, false;
    GaussNystrom8: core::GaussNystrom<8>, false;
    Line: core::Variational<1, 2>, false;
    Parabola: core::Variational<2, 2>, false;
    Momentum: core::MomentumVariational<2>, false;
    DiscreteGradient: core::DiscreteGradient, true;
    Tao: core::Tao, true;
    Pihajoki: core::Pihajoki, true;
    TwoStep: core::TwoStepMidpoint, false;
    Consecutive: core::ConsecutiveSubTrajectories, true;
    Intersecting: core::IntersectingSubTrajectories, true;
}

/// The name without spaces and without the signs of Rust's generics.
fn plain(name: &str) -> String {
    name.replace([' ', '<', '>', ':'], "")
}

static ALL: LazyLock<Vec<(String, Known)>> = LazyLock::new(all);

/// All schemes, those of a kind together.
fn all() -> Vec<(String, Known)> {
    let mut all = Vec::new();
    // The table of a splitting, which stays in memory as the list does.
    fn weights<W: Splitting>(scheme: &W) -> Weights {
        Weights(Box::leak(Box::new(Table::of(scheme))))
    }
    let mut add = |known: Known| all.push((plain(&known.entry().to_string()), known));
    let mut on_copies = Vec::new();
    macro_rules! tables {
        ($($moves:ident: $($scheme:expr),+;)+) => {
            $($(
                let table = weights(&$scheme);
                add(Known::Many(Many::Table(ByTable { weights: table, moves: Moves::$moves })));
                if Moves::$moves == Moves::Pieces && table.0.is_general() {
                    on_copies.push(table);
                }
            )+)+
        };
    }
    tables! {
        KickUnlessItJumps: Named(core::StormerVerlet::KickDriftKick, core::Strang);
        DriftUnlessItJumps: Named(core::StormerVerlet::DriftKickDrift, core::Strang);
        Drift: core::SymplecticEuler::KickDrift, core::SymplecticEuler::DriftKick;
        Pieces: core::Strang, core::Ruth3, core::Yoshida4, core::Suzuki4, core::BlanesMoan4, core::Yoshida6, core::KahanLi6,
            core::BlanesMoan6, core::McLachlan8, core::KahanLi8, core::SofroniouSpaletta8, core::SofroniouSpaletta10,
            core::Saba2, core::Saba3, core::Saba4, core::Aba104, core::Aba864, core::Aba1064;
        NystromKick: core::Srkn6b, core::Srkn11b;
        NystromDrift: core::Srkn14a, core::BlanesCasasEscorihuela8;
    }
    macro_rules! processed {
        ($($scheme:ident),+) => {$(
            let scheme = core::$scheme::default();
            let [kernel, processor] = [weights(scheme.kernel()), weights(scheme.processor())];
            let scheme = core::Processed::new(kernel, processor);
            add(Known::Processed(InFrame { scheme, kernel }));
        )+};
    }
    processed!(Processed4, Processed6, BlanesCasasMurua8);
    processed!(
        WisdomHolman3,
        WisdomHolman5,
        WisdomHolman7,
        WisdomHolman11,
        WisdomHolman17
    );
    let cheap = core::CheapProcessed4::default();
    let [kernel, processor] = [
        weights(cheap.processed().kernel()),
        weights(cheap.processed().processor()),
    ];
    let scheme = core::CheapProcessed::new(
        core::Processed::new(kernel, processor),
        weights(cheap.mean_of()),
    );
    add(Known::CheapProcessed(InFrame { scheme, kernel }));
    add(Known::Many(Many::ImplicitMidpoint(
        core::ImplicitMidpoint::default(),
    )));
    add(Known::RungeKutta4(core::RungeKutta4));
    add(Known::Line(core::Variational::lobatto()));
    add(Known::Parabola(core::Variational::lobatto()));
    add(Known::DiscreteGradient(core::DiscreteGradient::default()));
    add(Known::Tao(core::Tao::default()));
    add(Known::Pihajoki(core::Pihajoki::CoordinateFirst));
    add(Known::Pihajoki(core::Pihajoki::MomentumFirst));
    for second in [
        SecondPoint::SecondOrder,
        SecondPoint::HalfEuler,
        SecondPoint::Equal,
    ] {
        add(Known::TwoStep(
            core::TwoStepMidpoint::default().with_second_point(second),
        ));
        add(Known::Consecutive(
            core::ConsecutiveSubTrajectories::default().with_second_point(second),
        ));
        add(Known::Intersecting(
            core::IntersectingSubTrajectories::default().with_second_point(second),
        ));
    }
    for table in &on_copies {
        add(Known::Compensated(core::Compensated(*table)));
        add(Known::MidpointProjected(core::MidpointProjected(*table)));
        add(Known::Mixed(core::Mixed::new(*table)));
        add(Known::Semiexplicit(core::Semiexplicit::new(*table)));
    }
    macro_rules! staged {
        ($($known:expr, $scheme:ident<$stages:literal>;)+) => {$(
            let scheme = core::$scheme::<$stages>::default();
            all.push((format!("{}{}", scheme.entry().name, $stages), $known(scheme)));
        )+};
    }
    staged! {
        Known::Gauss2, Gauss<2>;
        |scheme| Known::Many(Many::Gauss4(scheme)), Gauss<4>;
        Known::Gauss8, Gauss<8>;
        Known::GaussNystrom4, GaussNystrom<4>;
        Known::GaussNystrom8, GaussNystrom<8>;
        Known::Momentum, MomentumVariational<2>;
    }
    all
}

/// A name without the setting.
fn head(name: &str) -> &str {
    name.split('(').next().unwrap_or(name)
}

/// The scheme of a name: with its setting, or the first one of the name alone.
fn known(name: &str) -> Result<&'static (String, Known), RunError> {
    let asked = plain(name);
    let exact = ALL.iter().find(|(known, _)| *known == asked);
    let of_default = |known: &str| head(known) == asked;
    let found = exact.or_else(|| ALL.iter().find(|(known, _)| of_default(known)));
    found.ok_or_else(|| {
        // With their settings, and without them.
        let names = ALL.iter().flat_map(|(known, _)| [&**known, head(known)]);
        RunError::UnknownScheme {
            name: name.to_owned(),
            nearest: nearest(&asked, names).map(str::to_owned),
        }
    })
}

/// The scheme of a name, for single runs.
pub(crate) fn any(name: &str) -> Result<AnyScheme, RunError> {
    Ok(known(name)?.1.any())
}

/// The scheme of a name, for ensembles.
pub(crate) fn many(name: &str) -> Result<Many, RunError> {
    match known(name)? {
        (_, Known::Many(scheme)) => Ok(scheme.clone()),
        (name, _) => Err(RunError::SingleRuns { name: name.clone() }),
    }
}

/// The scheme of a name, for what takes a scheme with its type: `Lyapunov`, an `Ensemble` with observers, a `Sweep`. It is one
/// that [`Swarm`](crate::Swarm) takes.
///
/// ```
/// use hamiltonian::prelude::*;
/// use hamiltonian_runtime::{Definition, Values, scheme_of_members};
///
/// let spring = Definition::parse("H(x; p) = p^2/2 + x^2/2", "spring.txt")?.system(Values::new())?;
/// let start = |member: Member| (spring.clone(), State::new(vec![1.0 + member.index as f64], vec![0.0]));
/// let all = Lyapunov::new(8, start, scheme_of_members("BlanesMoan4")?, 0.1).with_steps(1000).collect()?;
/// assert!(all.into_iter().all(|rates| rates.is_ok_and(|rates| rates[0].abs() < 1e-2)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RunError::UnknownScheme`] and [`RunError::SingleRuns`].
pub fn scheme_of_members(name: &str) -> Result<impl Scheme<RuntimeSystem> + use<>, RunError> {
    many(name)
}
