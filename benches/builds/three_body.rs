//! The restricted three-body problem: a symmetric orbit by shooting, from the event y = 0 and a tangent map.

use hamiltonian::prelude::*;
use hamiltonian::analysis::monodromy;

hamiltonian! {
    pub struct ThreeBody { mu = 0.012277471 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y
        - (1 - mu)/hypot(x + mu, y) - mu/hypot(x - (1 - mu), y);
    event axis = y
}

fn main() -> Result<(), Error> {
    let system = ThreeBody::default();
    let scheme = Gauss::<6>::default;
    // Half an orbit from the axis to the axis; p_x there is to be 0.
    let half = |p_y: f64| -> Result<(f64, f64), Error> {
        let start = State::new([0.5, 0.0], [0.0, p_y]);
        let mut run = Integrator::new(&system, scheme(), start, 1e-2)?
            .observe(Events::new([Event::named("axis").with_end_after(2)]));
        run.advance(1_000)?;
        let located = run.observer().located();
        Ok(located
            .last()
            .map_or((f64::NAN, f64::NAN), |last| (last.state.t, last.state.p[0])))
    };
    let (mut low, mut high) = (1.0, 1.2);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let same = (half(low)?.1 > 0.0) == (half(middle)?.1 > 0.0);
        if same { low = middle } else { high = middle }
    }
    let (t, _) = half(low)?;
    let start = State::new([0.5, 0.0], [0.0, low]);
    let map = monodromy(&system, scheme(), start, 2.0 * t / 1_000.0, 1_000)?;
    println!(
        "p_y = {low:.9}, half a period {t:.6}, trace {:.3}",
        map.trace()
    );
    Ok(())
}
