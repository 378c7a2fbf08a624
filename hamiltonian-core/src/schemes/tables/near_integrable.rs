//! Tables for a small piece B: H = A + εB, with A first.
//!
//! Input: the digits as published, polished by `scripts/coefficients.py`. Output: the tables
//! SABA and ABA. Invariant: the terms of the error with ε, ε², … start at the powers of h that the
//! class names.

use super::{Class, Coefficients, mirrored};
use crate::schemes::author::Weight;

/// Störmer–Verlet in this notation: error O(εh² + ε²h²).
pub const SABA_1: Coefficients<1> = Coefficients {
    name: "SABA1",
    order: 2,
    class: Class::NearIntegrable { orders: &[2, 2] },
    stages: mirrored([Weight(0.5, 0.0), Weight(1.0, 0.0)]),
    source: "J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80, 39 (2001), doi:10.1023/A:1012098603882",
};

/// Gauss' nodes for A: error O(εh⁴ + ε²h²).
pub const SABA_2: Coefficients<2> = Coefficients {
    name: "SABA2",
    order: 2,
    class: Class::NearIntegrable { orders: &[4, 2] },
    stages: mirrored([
        Weight(0.2113248654051871, 1.1030435245950743e-17),
        Weight(0.5, 0.0),
        Weight(0.5773502691896257, 3.3450280739356345e-17),
    ]),
    source: "J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80, 39 (2001), doi:10.1023/A:1012098603882",
};

/// Gauss' nodes for A: error O(εh⁶ + ε²h²).
pub const SABA_3: Coefficients<3> = Coefficients {
    name: "SABA3",
    order: 2,
    class: Class::NearIntegrable { orders: &[6, 2] },
    stages: mirrored([
        Weight(0.11270166537925831, -2.5675694035077516e-19),
        Weight(0.2777777777777778, -1.2335811384723961e-17),
        Weight(0.3872983346207417, -1.3621030867463682e-17),
        Weight(0.4444444444444444, 2.4671622769447922e-17),
    ]),
    source: "J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80, 39 (2001), doi:10.1023/A:1012098603882",
};

/// Gauss' nodes for A: error O(εh⁸ + ε²h²).
pub const SABA_4: Coefficients<4> = Coefficients {
    name: "SABA4",
    order: 2,
    class: Class::NearIntegrable { orders: &[8, 2] },
    stages: mirrored([
        Weight(0.06943184420297371, -1.3430706493351195e-18),
        Weight(0.17392742256872692, 3.830168194374721e-18),
        Weight(0.26057763400459816, -2.4025902041459696e-18),
        Weight(0.32607257743127305, 2.3925407421254193e-17),
        Weight(0.33998104358485626, 7.491321706962178e-18),
    ]),
    source: "J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80, 39 (2001), doi:10.1023/A:1012098603882",
};

/// Error O(εh¹⁰ + ε²h⁴).
pub const ABA_104: Coefficients<7> = Coefficients {
    name: "ABA(10,4)",
    order: 4,
    class: Class::NearIntegrable { orders: &[10, 4] },
    stages: mirrored([
        Weight(0.047067100645972505, 8.721704494099554e-19),
        Weight(0.11888191736819702, 1.786490760389843e-18),
        Weight(0.1847569354170881, 9.618233750548365e-18),
        Weight(0.24105046055150156, 4.931129869237873e-18),
        Weight(0.2827060056798362, -1.9983959561554032e-17),
        Weight(-0.2732866667053238, 4.7233166703692495e-18),
        Weight(-0.01453004174289682, 8.1993798171167605e-19),
        Weight(0.8267085775712505, -5.0637450215622844e-17),
    ]),
    source: "S. Blanes, F. Casas, A. Farrés, J. Laskar, J. Makazaga, A. Murua, Appl. Numer. Math. 68, 58 (2013), doi:10.1016/j.apnum.2013.01.003",
};

/// Error O(εh⁸ + ε²h⁶ + ε³h⁴).
pub const ABA_864: Coefficients<7> = Coefficients {
    name: "ABA(8,6,4)",
    order: 4,
    class: Class::NearIntegrable { orders: &[8, 6, 4] },
    stages: mirrored([
        Weight(0.07113342649822312, 2.6359775707815623e-18),
        Weight(0.18308368747219722, 1.2369803916738935e-18),
        Weight(0.2411534279566401, -5.265318639681603e-18),
        Weight(0.31078285989857485, 2.1450981759438652e-17),
        Weight(0.5214117617728148, 3.447384700639811e-18),
        Weight(-0.0265646185119588, -7.792741145892746e-19),
        Weight(-0.333698616227678, -1.4695831439554227e-17),
        Weight(0.06539614228237342, -2.1840126496031725e-18),
    ]),
    source: "S. Blanes, F. Casas, A. Farrés, J. Laskar, J. Makazaga, A. Murua, Appl. Numer. Math. 68, 58 (2013), doi:10.1016/j.apnum.2013.01.003",
};

/// Error O(εh¹⁰ + ε²h⁶ + ε³h⁴).
pub const ABA_1064: Coefficients<8> = Coefficients {
    name: "ABA(10,6,4)",
    order: 4,
    class: Class::NearIntegrable {
        orders: &[10, 6, 4],
    },
    stages: mirrored([
        Weight(0.038094497422412193, 1.957833714009241e-18),
        Weight(0.09585888083707521, 2.374151986960853e-18),
        Weight(0.14529871611691375, -1.5902451824204543e-18),
        Weight(0.20444615314299877, 9.612101811843056e-18),
        Weight(0.20762769572554124, 1.1513933629912792e-17),
        Weight(0.2170703479789911, -5.5151797278789466e-18),
        Weight(0.43590970365152615, 1.1151572706138471e-17),
        Weight(-0.017375381959065093, 4.678198329822662e-19),
        Weight(-0.6538612258327867, 9.444961495977724e-18),
    ]),
    source: "S. Blanes, F. Casas, A. Farrés, J. Laskar, J. Makazaga, A. Murua, Appl. Numer. Math. 68, 58 (2013), doi:10.1016/j.apnum.2013.01.003",
};
