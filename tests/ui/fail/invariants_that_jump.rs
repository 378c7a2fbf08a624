use hamiltonian::prelude::*;

hamiltonian! {
    pub struct Steps {}
    H(q; p; t) = p^2/2 + q^2/2;
    invariant side = sign(q);
    invariant step = if q > 0 { 1 } else { 2 };
    invariant phase = atan2(q, p) - t;
    invariant late = if t > 1 { 1 } else { 2 }
}

hamiltonian! {
    /// A step of the potential: what it takes from the momentum is in no derivative.
    pub struct Step {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + if x > 0.5 { 2 } else { 0 };
    invariant momentum = p_x
}

// Branches that meet are no jump.
hamiltonian! {
    pub struct OneSided { k = 1.0 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + if x > 0 { k*x^2/2 } else { 0 };
    invariant along = p_y;
    invariant energy_across = p_x^2/2 + if x > 0 { k*x^2/2 } else { 0 }
}

fn main() {}
