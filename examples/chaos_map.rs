//! Order and chaos of Hénon–Heiles at one energy: the Lyapunov exponents of a sheet of starts.
//!
//! At H = 1/8 the section x = 0 is divided between islands of regular orbits and a chaotic sea (M. Hénon and
//! C. Heiles, Astronomical Journal 69, 73, 1964; `henon_heiles` draws orbits of both). Here every start of
//! the section is asked how fast its neighbours leave: in the sea λ is about 0.047, in the islands what is
//! left of it falls like (ln t)/t.
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
/// Between the exponents of regular and of chaotic orbits at that time.
const CHAOTIC: f64 = 0.02;

/// The start with x = 0 and p_x > 0 at a place of the section, where there is one.
fn start(y: f64, p_y: f64) -> Option<StateOf<HenonHeiles>> {
    let square = 2.0 * ENERGY - p_y * p_y - y * y + 2.0 / 3.0 * y * y * y;
    (square > 0.0 && y < 1.0).then(|| State::new([0.0, y], [square.sqrt(), p_y]))
}

/// The exponent of each start.
fn exponents(starts: &[StateOf<HenonHeiles>], stop: &AtomicBool) -> Result<Vec<f64>, Error> {
    let member = |member: Member| (HenonHeiles {}, starts[member.index].clone());
    let all = Lyapunov::new(starts.len(), member, BlanesMoan4, STEP)
        .steps(STEPS)
        .every(16)
        .reproducible()
        .cancel(stop)
        .progress(|done, of| eprint!("\r{done} of {of} starts"))
        .collect()?;
    eprintln!();
    all.into_iter().map(|rates| Ok(rates?[0])).collect()
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
    // Two orbits of C. Skokos, T. Bountis, C. Antonopoulos, Physica D 231 (2007) 30.
    let regular = start(0.558, 0.0).ok_or("inside the section")?;
    let chaotic = start(-0.016, 0.0).ok_or("inside the section")?;
    let mut states = vec![regular.clone(), chaotic.clone()];
    states.extend(places.iter().map(|(_, _, state)| state.clone()));
    let rates = exponents(&states, &stop)?;

    let mut checks = Checks::default();
    checks.compare("λ of a regular orbit, t = 1000", rates[0], 0.0, 0.01);
    checks.compare("λ of a chaotic orbit, t = 1000", rates[1], 0.047, 0.01);
    let mut alone = Tangent::new(&HenonHeiles {}, BlanesMoan4, chaotic, STEP, 1)?;
    let single = alone.lyapunov(STEPS, 16)?[0];
    checks.compare("the same alone", rates[1], single, 0.0);

    // Reflected in x and run backwards, the orbit of (y, p_y) is that of (y, −p_y).
    let rates = &rates[2..];
    let share = |half: f64| {
        let in_half = places
            .iter()
            .zip(rates)
            .filter(|(place, _)| place.1 * half > 0.0);
        let (chaotic, all) = in_half.fold((0.0, 0.0), |(chaotic, all), (_, rate)| {
            (chaotic + f64::from(u8::from(*rate > CHAOTIC)), all + 1.0)
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
        points: (places.iter().zip(rates))
            .filter(|(_, rate)| (from..to).contains(*rate))
            .flat_map(|((y, p_y, _), _)| {
                let shift = |k: usize| spacing * ((k as f64 + 0.5) / dots as f64 - 0.5);
                (0..dots * dots).map(move |k| (y + shift(k / dots), p_y + shift(k % dots)))
            })
            .collect(),
    };
    Figure {
        title: "Hénon and Heiles at H = 1/8: Lyapunov exponents over t = 1000".into(),
        x: "y".into(),
        y: "p_y".into(),
        equal: true,
        dots: true,
        legend_right: true,
        curves: vec![
            class("λ < 0.02", f64::NEG_INFINITY, CHAOTIC),
            class("0.02 to 0.04", CHAOTIC, 0.04),
            class("λ > 0.04", 0.04, f64::INFINITY),
        ],
        ..Default::default()
    }
    .write("target/chaos_map/map.svg")?;
    println!("Written to target/chaos_map/map.svg");
    checks.finish()
}
