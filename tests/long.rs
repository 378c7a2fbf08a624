//! Long straight lines: H of hundreds of terms is cut into pieces that hand values, and
//! conditions, to each other.

use hamiltonian::prelude::*;
use hamiltonian::{
    Dual,
    schemes::author::{Dynamics, VectorField},
};

macro_rules! long {
    ($($k:tt)*) => {
        hamiltonian! {
            /// Two hundred waves, each with a step that others share.
            pub struct Waves { a = 0.5 }
            H(x, y; u, v) = u^2/2 + v^2/2 $(+ a*sin($k*x + u)*cos($k*y) + if $k*x < 200*y { x*v } else { y*u^2 })*
        }
        fn by_hand(a: f64, x: f64, y: f64, u: f64, v: f64) -> f64 {
            let mut sum = u * u / 2.0 + v * v / 2.0;
            $(
                sum += a * ($k as f64 * x + u).sin() * ($k as f64 * y).cos();
                sum += if $k as f64 * x < 200.0 * y { x * v } else { y * u * u };
            )*
            sum
        }
    };
}

long!(
    1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30
    31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57
    58 59 60 61 62 63 64 65 66 67 68 69 70 71 72 73 74 75 76 77 78 79 80 81 82 83 84
    85 86 87 88 89 90 91 92 93 94 95 96 97 98 99 100 101 102 103 104 105 106 107 108
    109 110 111 112 113 114 115 116 117 118 119 120 121 122 123 124 125 126 127 128
    129 130 131 132 133 134 135 136 137 138 139 140 141 142 143 144 145 146 147 148
    149 150 151 152 153 154 155 156 157 158 159 160 161 162 163 164 165 166 167 168
    169 170 171 172 173 174 175 176 177 178 179 180 181 182 183 184 185 186 187 188
    189 190 191 192 193 194 195 196 197 198 199 200
);

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-11 * (1.0 + a.abs()), "{a} is not {b}");
}

#[test]
fn pieces_make_the_whole() {
    let waves = Waves::default();
    let (x, y, u, v) = (0.3, 0.2, -0.7, 0.4);
    let state = State::new([x, y], [u, v]);
    close(waves.energy(&state), by_hand(0.5, x, y, u, v));
    let gradient = waves.gradient(&state);
    let dual = |at: usize| {
        let lift = |k: usize, value: f64| Dual {
            eps: f64::from(u8::from(k == at)),
            ..Dual::fixed(value)
        };
        let state = State::over([lift(0, x), lift(1, y)], [lift(2, u), lift(3, v)]);
        waves.energy(&state).eps
    };
    close(gradient.q[0], dual(0));
    close(gradient.q[1], dual(1));
    close(gradient.p[0], dual(2));
    close(gradient.p[1], dual(3));
}

#[test]
fn what_is_made_from_the_gradient_agrees_with_it() {
    let waves = Waves::default();
    let state = State::new([0.3, 0.2], [-0.7, 0.4]);
    let gradient = waves.gradient(&state);
    let prepared = System::prepare::<f64>(&waves);
    let (mut q, mut p) = (state.q, state.p);
    prepared.gradient_q(0.0, &state.q, &state.p, &mut q);
    prepared.gradient_p(0.0, &state.q, &state.p, &mut p);
    assert_eq!((q, p), (gradient.q, gradient.p));
    let (mut q, mut p) = (state.q, state.p);
    prepared
        .field(0.125)
        .add(0.0, &state.q, &state.p, &mut q, &mut p);
    assert_eq!(q, state.q + gradient.p * 0.125);
    assert_eq!(p, state.p - gradient.q * 0.125);
}
