//! The shadow of a rotating black hole before a chequered sky, traced by ensembles of rays.
//!
//! Input: the spin, the inclination of the camera, numbers of pixels. Output: their colours, and the largest
//! |H| of the rays relative to the sum of its terms; H is 0 along light. Coordinates of Boyer and Lindquist, units with
//! G = c = M = 1. As H is 0, it may have any factor > 0: with this one, steps are in proportion to r, and short near the
//! axis and the horizon.

use hamiltonian::View;
use hamiltonian::prelude::*;
use std::cell::RefCell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::ControlFlow;

hamiltonian! {
    /// Light round a black hole; L is the angular momentum about its axis, the energy is 1.
    pub struct Light { a = 0.9 }
    let Delta = r^2 - 2*r + a^2;
    let s = sin(theta)^2;
    let radial = (r^2 + a^2 - a*L)^2;
    let rate = 1/(2*r^3*(s + 0.02));
    H(r, theta, phi; p_r, p_theta, L) = rate*(s*(Delta*(Delta*p_r^2 + p_theta^2) - radial) + Delta*(L - a*s)^2);
    monitor size = rate*(s*(Delta*(Delta*p_r^2 + p_theta^2) + radial) + Delta*(L - a*s)^2)
}

/// The distance of the camera.
const FAR: f64 = 100.0;
/// The width of the picture.
const WIDTH: f64 = 20.0;
/// The size of a step, about that of ln r.
const STEP: f64 = 0.1;
/// The most steps of a ray; those that stay longer are within a pixel of the shadow's edge.
const STEPS: u64 = 1024;

thread_local! {
    static COLOURS: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// The start of the ray of a pixel at (alpha, beta) of the picture (J. M. Bardeen, in *Black Holes*, Les Houches 1972).
fn ray(a: f64, inclination: f64, alpha: f64, beta: f64) -> StateOf<Light> {
    let sin = inclination.sin();
    let momentum = -alpha * sin;
    let delta = FAR * FAR - 2.0 * FAR + a * a;
    let along = FAR * FAR + a * a - a * momentum;
    let across = momentum / sin - a * sin;
    // H = 0 gives p_r; the ray goes inwards.
    let square = (along * along / delta - beta * beta - across * across) / delta;
    let p_r = -square.max(0.0).sqrt();
    State::new([FAR, inclination, 0.0], [p_r, beta, momentum])
}

/// The colour of the sky in a direction: a chequerboard, lighter above the equator.
fn sky(theta: f64, phi: f64) -> [u8; 3] {
    let (theta, phi) = match theta.rem_euclid(2.0 * PI) {
        theta if theta > PI => (2.0 * PI - theta, phi + PI),
        theta => (theta, phi),
    };
    let is_even = ((theta / PI * 12.0).floor() + (phi / PI * 12.0).floor()) % 2.0 == 0.0;
    match (is_even, theta < FRAC_PI_2) {
        (true, true) => [242, 201, 120],
        (false, true) => [120, 74, 40],
        (true, false) => [150, 190, 230],
        (false, false) => [38, 66, 110],
    }
}

/// Traces some pixels, counted row by row, of a square picture with so many pixels a side. Returns the largest |H| of
/// their rays beside the size of its terms; NaN if the numbers are refused. The colours are at [`colours`].
#[unsafe(no_mangle)]
pub extern "C" fn trace(a: f64, inclination: f64, side: u32, first: u32, count: u32) -> f64 {
    let pixel = WIDTH / f64::from(side);
    let place = |k: u32| (f64::from(k) + 0.5) * pixel - WIDTH / 2.0;
    let horizon = 1.0 + (1.0 - a * a).sqrt();
    let inner = 1.01 * horizon;
    let outer = 1.01 * FAR;
    let start = |member: Member| {
        let number = first + member.index as u32;
        let (alpha, beta) = (place(number % side), -place(number / side));
        (Light { a }, ray(a, inclination, alpha, beta))
    };
    let swarm = Ensemble::new(count as usize, start, Gauss::<2>::default(), STEP);
    let Ok(swarm) = swarm else { return f64::NAN };
    let ends = move |_: Member| {
        watch(
            move |view: &View<'_, f64, Light>| match (inner..outer).contains(&view.state.q[0]) {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            },
        )
    };
    let mut swarm = swarm.with_threads(1).observe(ends);
    swarm.advance(STEPS);
    let system = Light { a };
    let mut worst: f64 = 0.0;
    let colours: Vec<u8> = swarm
        .states()
        .flat_map(|state| {
            let [red, green, blue] = match state {
                Ok(state) if state.q[0] > 2.0 * inner => {
                    worst = worst.max((system.energy(&state) / system.size(&state)).abs());
                    sky(state.q[1], state.q[2])
                }
                _ => [0, 0, 0],
            };
            [red, green, blue, 255]
        })
        .collect();
    COLOURS.set(colours);
    worst
}

/// The address of the colours of the last pixels: red, green, blue, opacity, a byte each.
#[unsafe(no_mangle)]
pub extern "C" fn colours() -> *const u8 {
    COLOURS.with_borrow(Vec::as_ptr)
}
