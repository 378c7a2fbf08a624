//! Order and chaos of Hénon–Heiles at one energy: MEGNO of a sheet of starts.
//!
//! At H = 1/8 the section x = 0 is divided between islands of regular orbits and a chaotic sea (M. Hénon and C.
//! Heiles, Astronomical Journal 69, 73, 1964; `henon_heiles` draws orbits of both). MEGNO measures how fast
//! neighbouring orbits separate (P. M. Cincotta, C. Simó, Astronomy and Astrophysics Supplement Series 147, 205,
//! 2000): in the islands it tends to 2, in the sea it grows like λt/2, where λ is about 0.047.
//!
//! `-- N` computes about N starts, 4000 by default; 1 000 000 take minutes. Ctrl-C ends it. The map is written to
//! `target/chaos_map/map.svg`.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// The Hénon–Heiles system.
    pub struct HenonHeiles {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3
}

const ENERGY: f64 = 0.125;
const STEP: f64 = 0.125;
/// To t = 1000.
const STEPS: u64 = 8_000;
/// A value above those of regular orbits at that time.
const CHAOTIC: f64 = 4.0;

/// The start with x = 0 and p_x > 0 at a point of the section, if the energy allows one.
fn start(y: f64, p_y: f64) -> Option<StateOf<HenonHeiles>> {
    let square = 2.0 * ENERGY - p_y * p_y - y * y + 2.0 / 3.0 * y * y * y;
    (square > 0.0 && y < 1.0).then(|| State::new([0.0, y], [square.sqrt(), p_y]))
}

/// MEGNO of each start.
fn map(starts: &[StateOf<HenonHeiles>], stop: &AtomicBool) -> Result<Vec<f64>, Error> {
    let member = |member: Member| (HenonHeiles {}, starts[member.index].clone());
    let all = Lyapunov::new(starts.len(), member, BlanesMoan4, STEP)
        .with_steps(STEPS)
        .with_interval(16)
        .reproducible()
        .with_cancel(stop)
        .with_progress(|done, of| eprint!("\r{done} of {of} starts"))
        .megno()?;
    eprintln!();
    all.into_iter().collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))?;

    let starts = std::env::args().nth(1).and_then(|n| n.parse().ok());
    let starts: f64 = starts.unwrap_or(4_000.0);
    // The section fills about 0.59 of this rectangle, which is symmetric in p_y.
    let (left, right, top) = (-0.45, 0.75, 0.5);
    let spacing = ((right - left) * 2.0 * top * 0.59 / starts).sqrt();
    let columns = ((right - left) / spacing) as usize;
    let rows = (top / spacing) as usize;
    let mut places = Vec::new();
    for column in 0..columns {
        for row in 0..2 * rows {
            let y = left + (column as f64 + 0.5) * spacing;
            let p_y = (row as f64 + 0.5 - rows as f64) * spacing;
            places.extend(start(y, p_y).map(|state| (y, p_y, state)));
        }
    }
    // One in an island, and a chaotic one of C. Skokos, T. Bountis, C. Antonopoulos, Physica D 231 (2007) 30.
    let regular = start(0.1, 0.0).ok_or("inside the section")?;
    let chaotic = start(-0.016, 0.0).ok_or("inside the section")?;
    let mut states = vec![regular.clone(), chaotic.clone()];
    states.extend(places.iter().map(|(_, _, state)| state.clone()));
    let found = map(&states, &stop)?;

    let mut checks = Checks::default();
    checks.compare("MEGNO of a regular orbit, t = 1000", found[0], 2.0, 0.1);
    let mut tangent = Tangent::new(&HenonHeiles {}, BlanesMoan4, chaotic.clone(), STEP, 1)?;
    let growth = tangent.lyapunov(STEPS, 16)?[0] * STEP * STEPS as f64 / 2.0;
    checks.compare(
        "MEGNO of a chaotic orbit by λt/2",
        found[1] / growth,
        1.0,
        0.25,
    );
    let alone = megno(&HenonHeiles {}, BlanesMoan4, chaotic, STEP, STEPS, 16)?;
    checks.compare("the same alone", found[1], alone, 0.0);

    // Reflected in x and run backwards, the orbit of (y, p_y) is that of (y, −p_y).
    let found = &found[2..];
    let share = |half: f64| {
        let in_half = places
            .iter()
            .zip(found)
            .filter(|(place, _)| place.1 * half > 0.0);
        let (chaotic, all) = in_half.fold((0.0, 0.0), |(chaotic, all), (_, megno)| {
            (chaotic + f64::from(u8::from(*megno > CHAOTIC)), all + 1.0)
        });
        chaotic / all
    };
    checks.compare(
        "chaotic share for p_y > 0 and p_y < 0",
        share(1.0),
        share(-1.0),
        0.03,
    );

    // Each start fills its cell.
    let dots = (spacing / 0.0015).ceil() as usize;
    let class = |name: &str, from: f64, to: f64| Curve {
        name: name.into(),
        points: (places.iter().zip(found))
            .filter(|(_, megno)| (from..to).contains(*megno))
            .flat_map(|((y, p_y, _), _)| {
                let shift = |k: usize| spacing * ((k as f64 + 0.5) / dots as f64 - 0.5);
                (0..dots * dots).map(move |k| (y + shift(k / dots), p_y + shift(k % dots)))
            })
            .collect(),
    };
    Figure {
        title: "Hénon and Heiles at H = 1/8: MEGNO at t = 1000".into(),
        x: "y".into(),
        y: "p_y".into(),
        equal: true,
        dots: true,
        legend_right: true,
        curves: vec![
            class("MEGNO < 4", f64::NEG_INFINITY, CHAOTIC),
            class("4 to 20", CHAOTIC, 20.0),
            class("MEGNO > 20", 20.0, f64::INFINITY),
        ],
        ..Default::default()
    }
    .write("target/chaos_map/map.svg")?;
    println!("Written to target/chaos_map/map.svg");
    checks.finish()
}
