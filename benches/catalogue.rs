//! Every scheme of the catalogue in lanes, on every level of this CPU, against scalar runs.
//!
//! `cargo bench --bench catalogue` prints, for each scheme and level, how many times a scalar run an
//! ensemble is on one thread, fused and reproducible; with `-- --check` it fails below the ratios of
//! [`least`]. Before anything is timed, all members of reproducible ensembles are compared with single runs:
//! the same bits. A scheme of the catalogue that is not here fails too. With a name, `-- Gauss`, it does the
//! schemes whose entry begins with it.

use std::time::Instant;

use hamiltonian::Vector;
use hamiltonian::lanes::Cpu;
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::{Observed, catalogue};
use hamiltonian::schemes::{
    Aba104, Aba864, BlanesCasasEscorihuela8, BlanesCasasMurua8, CheapProcessed4, Compensated,
    ConsecutiveSubTrajectories, DiscreteGradient, IntersectingSubTrajectories, KahanLi6,
    McLachlan8, MidpointProjected, Mixed, MomentumVariational, Pihajoki, Processed4, Processed6,
    Ruth3, Saba2, Saba3, SecondPoint, Semiexplicit, SofroniouSpaletta8, SofroniouSpaletta10,
    Srkn6b, Srkn11b, Srkn14a, Suzuki4, SymplecticEuler, Tao, TwoStepMidpoint, Variational,
    WisdomHolman3, WisdomHolman5, WisdomHolman7, WisdomHolman11, WisdomHolman17, Yoshida4,
    Yoshida6,
};

hamiltonian! {
    /// Hénon–Heiles.
    pub struct HenonHeiles {}
    H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

hamiltonian! {
    /// Not separable, with exact flows.
    pub struct Mixture {}
    H(q; p) = (q^2 + 1)*(p^2 + 1)/2
}

hamiltonian! {
    /// Kepler's problem, to be slowed by its distance.
    pub struct Kepler {}
    H(x, y; u, v) = (u^2 + v^2)/2 - 1/sqrt(x^2 + y^2);
    monitor r = sqrt(x^2 + y^2)
}

/// Two of the widest packs: rounds are so short that other programs seldom interrupt all of them.
const MEMBERS: usize = 160;
/// So many that what a member costs at its start and end, as much as some tens of cheap steps, is spread over them.
const STEPS: u64 = 400;

/// The ratio that a scheme must reach on a level: less if its steps iterate or divide.
fn least(name: &str, cpu: Cpu) -> f64 {
    let iterates = [
        "Gauss",
        "ImplicitMidpoint",
        "Variational",
        "MomentumVariational",
        "DiscreteGradient",
        "MidpointProjected",
        "Semiexplicit",
        "TransformedVerlet",
    ];
    match cpu {
        Cpu::Avx2 | Cpu::Avx512 if iterates.iter().any(|start| name.starts_with(start)) => 1.2,
        Cpu::Avx2 | Cpu::Avx512 => 2.0,
        _ => 0.0,
    }
}

fn henon_heiles(member: Member) -> (HenonHeiles, StateOf<HenonHeiles>) {
    let at = member.index as f64 / MEMBERS as f64;
    (HenonHeiles {}, State::new([0.2 * at, 0.1], [0.1, 0.3 * at]))
}

fn mixture(member: Member) -> (Mixture, StateOf<Mixture>) {
    let at = member.index as f64 / MEMBERS as f64;
    (Mixture {}, State::new([at], [0.5 - at]))
}

/// Kepler's problem in even steps of the distance.
type Slowed = TimeTransformed<Kepler, Observed<Kepler>>;

fn slowed(member: Member) -> (Slowed, StateOf<Slowed>) {
    let at = member.index as f64 / MEMBERS as f64;
    let system = TimeTransformed::by(Kepler {}, "r").expect("it is declared");
    let start = State::new([0.5 + 0.5 * at, 0.0], [0.1, 1.2]);
    let start = system.start(&start).expect("r is positive");
    (system, start)
}

struct Bench {
    check: bool,
    only: Option<String>,
    /// The entries of the schemes that were here.
    seen: Vec<String>,
    failed: bool,
}

impl Bench {
    fn time<S, M>(&mut self, make: fn(Member) -> (S, StateOf<S>), scheme: M)
    where
        S: System,
        M: Scheme<S>,
    {
        let name = scheme.entry().to_string();
        self.seen.push(name.clone());
        if self
            .only
            .as_ref()
            .is_some_and(|only| !name.starts_with(only))
        {
            return;
        }
        let h = 0.03125;
        let alone = |index: usize| {
            let (system, start) = make(Member::new(index, 0));
            Integrator::new(&system, scheme.clone(), start, h)
                .expect("a good start")
                .with_lanes(false)
        };
        let mut singles: Vec<_> = (0..16).map(alone).collect();
        let ends: Vec<_> = (0..MEMBERS)
            .map(|index| alone(index).advance(STEPS).expect("finite").clone())
            .collect();
        let best = Cpu::best();
        for cpu in [Cpu::Sse2, Cpu::Avx2, Cpu::Avx512] {
            if cpu > best {
                continue;
            }
            Cpu::limit_to(cpu);
            let swarm = || {
                Ensemble::new(MEMBERS, make, scheme.clone(), h)
                    .expect("members")
                    .with_threads(1)
            };
            let (mut fast, mut exact) = (swarm(), swarm().reproducible());
            fast.advance(STEPS);
            exact.advance(STEPS);
            for ((index, end), expected) in exact.states().enumerate().zip(&ends) {
                let end = end.expect("finite");
                assert_eq!(end.t.to_bits(), expected.t.to_bits());
                let pairs = end.q.components().zip(expected.q.components());
                for (found, expected) in
                    pairs.chain(end.p.components().zip(expected.p.components()))
                {
                    assert_eq!(
                        found.to_bits(),
                        expected.to_bits(),
                        "{name} on {cpu:?}, member {index}"
                    );
                }
            }
            // Nanoseconds a step of one member: the least of many short rounds.
            let mut times = [f64::INFINITY; 3];
            for _ in 0..12 {
                let begin = Instant::now();
                for run in &mut singles {
                    run.advance(STEPS).expect("finite");
                }
                let steps = (singles.len() as u64 * STEPS) as f64;
                times[0] = times[0].min(begin.elapsed().as_secs_f64() * 1e9 / steps);
                let steps = (MEMBERS as u64 * STEPS) as f64;
                let begin = Instant::now();
                fast.advance(STEPS);
                times[1] = times[1].min(begin.elapsed().as_secs_f64() * 1e9 / steps);
                let begin = Instant::now();
                exact.advance(STEPS);
                times[2] = times[2].min(begin.elapsed().as_secs_f64() * 1e9 / steps);
            }
            let [single, fused, unfused] = times;
            let (ratio, due) = (single / fused, least(&name, cpu));
            let verdict = if ratio < due { "  BELOW" } else { "" };
            println!(
                "{name:<48} {cpu:?}: {single:>8.2} ns alone, {ratio:>6.2} ×, reproducible {:>6.2} ×{verdict}",
                single / unfused
            );
            self.failed |= self.check && ratio < due;
        }
        Cpu::limit_to(best);
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut bench = Bench {
        check: arguments.iter().any(|argument| argument == "--check"),
        only: arguments
            .into_iter()
            .find(|argument| !argument.starts_with("--")),
        seen: Vec::new(),
        failed: false,
    };
    macro_rules! all {
        ($make:ident: $($scheme:expr,)*) => { $(bench.time($make, $scheme);)* };
    }
    all! { mixture:
        RungeKutta4, Strang, Ruth3, Yoshida4, Suzuki4, BlanesMoan4, Yoshida6, KahanLi6, BlanesMoan6,
        McLachlan8, KahanLi8, SofroniouSpaletta8, SofroniouSpaletta10, Saba2, Saba3, Saba4, Aba104, Aba864,
        Aba1064, Processed4::default(), Processed6::default(), BlanesCasasMurua8::default(),
        CheapProcessed4::default(),
        WisdomHolman3::default(), WisdomHolman5::default(), WisdomHolman7::default(), WisdomHolman11::default(),
        WisdomHolman17::default(), Pihajoki::CoordinateFirst, Pihajoki::MomentumFirst,
        TwoStepMidpoint::default().with_second_point(SecondPoint::Equal), TwoStepMidpoint::default().with_second_point(SecondPoint::HalfEuler),
        TwoStepMidpoint::default().with_second_point(SecondPoint::SecondOrder), ConsecutiveSubTrajectories::default().with_second_point(SecondPoint::Equal),
        ConsecutiveSubTrajectories::default().with_second_point(SecondPoint::HalfEuler),
        ConsecutiveSubTrajectories::default().with_second_point(SecondPoint::SecondOrder),
        IntersectingSubTrajectories::default().with_second_point(SecondPoint::Equal), IntersectingSubTrajectories::default().with_second_point(SecondPoint::HalfEuler),
        IntersectingSubTrajectories::default().with_second_point(SecondPoint::SecondOrder), ImplicitMidpoint::default(),
        Tao::default(), Mixed::<Strang>::default(), MidpointProjected::<Strang>::default(),
        Semiexplicit::<Strang>::default(),
    }
    all! { henon_heiles:
        StormerVerlet::KickDriftKick, StormerVerlet::DriftKickDrift, SymplecticEuler::KickDrift,
        SymplecticEuler::DriftKick, Srkn6b, Srkn11b, Srkn14a, BlanesCasasEscorihuela8, Compensated(Strang),
        GaussNystrom::<2>::default(), Gauss::<2>::default(), Gauss::<4>::default(),
        Variational::<1, 2>::lobatto(), Variational::<2, 2>::lobatto(), MomentumVariational::<2>::default(),
        DiscreteGradient::default(),
    }
    all! { slowed:
        TransformedVerlet::default(),
    }
    for entry in catalogue() {
        let name = entry.to_string();
        if !bench.seen.contains(&name) {
            println!("{name:<48} is not in this bench");
            bench.failed = true;
        }
    }
    std::process::exit(i32::from(bench.failed));
}
