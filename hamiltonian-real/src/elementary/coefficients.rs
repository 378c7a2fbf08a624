//! Constants and coefficients of the elementary functions.
//!
//! Input: nothing. Output: tables, the lowest power first, each with its formula and the largest
//! error of that formula relative to the function. Invariant: only `scripts/fit_functions.py`
//! writes this file.

#![allow(
    clippy::approx_constant,
    reason = "printed with all others by the fitting script"
)]

/// In units of 2^−20: the guess for x^(−1/3) has errors of at most 0.034.
pub(crate) const CUBE_ROOT_OFFSET: u64 = 1430188272;
/// 2/π.
pub(crate) const TWO_OVER_PI: f64 = 0.6366197723675814;
/// π/2 to 33 bits: its product with 20 bits is exact.
pub(crate) const HALF_PI_1: f64 = 1.5707963267341256;
/// 33 bits of π/2 less the above.
pub(crate) const HALF_PI_2: f64 = 6.077100506303966e-11;
/// 33 bits of the rest.
pub(crate) const HALF_PI_3: f64 = 2.0222662487111665e-21;
/// The rest of π/2.
pub(crate) const HALF_PI_4: f64 = 8.4784276603689e-32;
/// π/2 rounded.
pub(crate) const HALF_PI_HIGH: f64 = 1.5707963267948966;
/// π/2 less the above.
pub(crate) const HALF_PI_LOW: f64 = 6.123233995736766e-17;
/// HALF_PI_LOW to 33 bits: its product with 20 bits is exact.
pub(crate) const HALF_PI_LOW_HEAD: f64 = 6.12323399538461e-17;
/// π/2 less HALF_PI_HIGH and the above.
pub(crate) const HALF_PI_TAIL: f64 = 3.5215598651832e-27;
/// π/4 to 33 bits: its product with 20 bits is exact.
pub(crate) const QUARTER_PI_HEAD: f64 = 0.7853981633670628;
/// π/4 less the above.
pub(crate) const QUARTER_PI_REST: f64 = 3.038550253253096e-11;
/// tan(π/8) = √2 − 1.
pub(crate) const ROOT_2_LESS_1: f64 = 0.41421356237309503;
/// 1/ln 2.
pub(crate) const LOG2_E: f64 = 1.4426950408889634;
/// ln 2 to 42 bits: its product with 11 bits is exact.
pub(crate) const LN_2_HIGH: f64 = 0.6931471805598903;
/// ln 2 less the above.
pub(crate) const LN_2_LOW: f64 = 5.497923018708371e-14;
/// ⅔ less its double.
pub(crate) const TWO_THIRDS_LOW: f64 = 3.700743415417188e-17;
/// sin r = r + r·z·P(z), z = r² ≤ (π/4)², to 2^−58.0.
pub(crate) const SINE: [f64; 6] = [
    -0.16666666666666632,
    0.008333333333322486,
    -0.00019841269829853024,
    2.755731370480564e-6,
    -2.5050759821329947e-8,
    1.589688072014063e-10,
];
/// cos r = 1 − z/2 + z²·P(z), z = r² ≤ (π/4)², to 2^−63.9.
pub(crate) const COSINE: [f64; 6] = [
    0.041666666666666595,
    -0.001388888888887334,
    2.48015872889996e-5,
    -2.755731421604353e-7,
    2.0875705227806275e-9,
    -1.1358739033170155e-11,
];
/// cosh r = 1 + z·P(z), z = r² ≤ (ln 2/2)², to 2^−70.0.
pub(crate) const EXP_EVEN: [f64; 6] = [
    0.5,
    0.041666666666666685,
    0.0013888888888873283,
    2.480158734919645e-5,
    2.755725183500282e-7,
    2.092176059859757e-9,
];
/// cosh r = 1 + z·P(z), z = r² ≤ (ln 2/2)², to 2^−58.0.
pub(crate) const EXP_EVEN_SHORT: [f64; 5] = [
    0.5000000000000013,
    0.04166666666651049,
    0.001388888894833465,
    2.4801488554180583e-5,
    2.7631780679667304e-7,
];
/// sinh r = r + r·z·P(z), z = r² ≤ (ln 2/2)², to 2^−61.7.
pub(crate) const EXP_ODD: [f64; 5] = [
    0.16666666666666677,
    0.008333333333321386,
    0.00019841269886807943,
    2.7557243476249456e-6,
    2.5109303478076894e-8,
];
/// The least 1 + f of a logarithm; the greatest is below its double.
pub(crate) const LOGARITHM_LEAST: f64 = 0.69;
/// ln((1 + s)/(1 − s)) = 2s + s·z·P(z), z = s² ≤ 0.184², to 2^−57.9.
pub(crate) const LOGARITHM: [f64; 7] = [
    0.6666666666666842,
    0.39999999998675156,
    0.28571428910038243,
    0.22222181256099593,
    0.1818446235911894,
    0.15291268835226754,
    0.15020915694183903,
];
/// ln((1 + s)/(1 − s)) = 2s + ⅔s·z + s·z²·P(z), z = s² ≤ 0.184², to 2^−76.7.
pub(crate) const LOGARITHM_TAIL: [f64; 9] = [
    0.4,
    0.28571428571427004,
    0.22222222222651847,
    0.18181818119917242,
    0.1538462065261813,
    0.1333305506314141,
    0.11773906706853349,
    0.10342033056541033,
    0.11540599330414454,
];
/// atan t = t + t·z·P(z), z = t² ≤ (√2 − 1)², to 2^−59.5.
pub(crate) const ARC_TANGENT: [f64; 11] = [
    -0.333333333333332,
    0.19999999999953816,
    -0.14285714280219833,
    0.11111110784623952,
    -0.09090897790927628,
    0.07692060796360341,
    -0.06663110512450246,
    0.05847935016973674,
    -0.050395039730006544,
    0.03806944206030249,
    -0.017912349942518467,
];
/// asin s = s + s·z·P(z), z = s² ≤ ¼, to 2^−59.8.
pub(crate) const ARC_SINE: [f64; 13] = [
    0.16666666666666763,
    0.07499999999970128,
    0.044642857175260175,
    0.030381942676398967,
    0.022372215877727274,
    0.017351595952639562,
    0.013981013659620298,
    0.011397329160268524,
    0.010789136539525538,
    0.003672825926943438,
    0.021789203906755206,
    -0.021114816380681686,
    0.03270104680321582,
];
/// erf x = x + x·P(z), z = x² ≤ ⅝², to 2^−56.2.
pub(crate) const ERROR: [f64; 10] = [
    0.12837916709551256,
    -0.3761263890318315,
    0.11283791670912624,
    -0.02686617063339001,
    0.005223977460462173,
    -0.0008548313744618117,
    0.00012054686118490383,
    -1.4906313631842601e-5,
    1.6116371632312815e-6,
    -1.2964786745893994e-7,
];
/// The lowest coefficient of the next.
pub(crate) const ERROR_COMPLEMENT_HIGH: f64 = 1.2329951186255526;
/// Its second word.
pub(crate) const ERROR_COMPLEMENT_LOW: f64 = -4.4876710498646635e-17;
/// (1 + 2x)·exp(x²)·erfc x = c + t·P(t), t = (x − 4)/(x + 4), ⅝ ≤ x ≤ 27.3, to 2^−57.9.
pub(crate) const ERROR_COMPLEMENT: [f64; 21] = [
    -0.13962111684056247,
    0.01537965210261942,
    0.06809705425468734,
    -0.10103906603627888,
    0.0937328349985807,
    -0.06633036581298996,
    0.037167515532894616,
    -0.016197734045934678,
    0.005031970028162431,
    -0.0007577733941137841,
    -0.00019925702700096125,
    0.0001506222594205327,
    -2.439781097372008e-5,
    -1.1224103530000514e-5,
    5.705872129971641e-6,
    2.985464964664252e-7,
    -8.185454583094923e-7,
    6.792373585078885e-8,
    1.0242438325618092e-7,
    -1.2563292537947351e-8,
    -9.344498635856787e-9,
];
