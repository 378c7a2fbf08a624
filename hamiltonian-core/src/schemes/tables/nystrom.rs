//! Tables of Nyström type: one piece is V(q, t), the other is autonomous and at most quadratic in p.
//!
//! Input: the digits as published, polished by `scripts/coefficients.py`. Output: tables of order 4
//! to 8. Invariant: the conditions of Nyström methods hold up to the order. On other splittings,
//! and with the two pieces exchanged, those of order 6 and 8 have order 4, so what composes them asks
//! for [`Nystrom`](crate::Nystrom); the piece that is first in the paper is first.

use super::{Class, Coefficients, First, mirrored, palindrome};
use crate::schemes::author::Weight;

/// Blanes and Moan's SRKN₆ᵇ, order 4 with 6 stages, kick first.
///
/// It has order 4 on any splitting, because the conditions are the same up to order 4. Its errors
/// are small on its class.
pub const SRKN_6B: Coefficients<6> = Coefficients {
    name: "SRKN6b",
    order: 4,
    class: Class::QuadraticKinetic { first: First::Kick },
    stages: palindrome([
        Weight(0.0829844064174053, -1.072285300905915e-18),
        Weight(0.16231455076686618, -1.0557678762454317e-17),
        Weight(0.233995250731502, -1.3596951883300789e-17),
        Weight(0.370877414979578, 9.360885340356617e-18),
        Weight(-0.40993371990192645, -2.1202111951623382e-17),
        Weight(0.059762097006575, 2.373673038391644e-18),
    ]),
    source: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142, 313 (2002), doi:10.1016/S0377-0427(01)00492-7",
};

/// Blanes and Moan's SRKN₁₁ᵇ, order 6 with 11 stages, kick first.
pub const SRKN_11B: Coefficients<11> = Coefficients {
    name: "SRKN11b",
    order: 6,
    class: Class::QuadraticKinetic { first: First::Kick },
    stages: palindrome([
        Weight(0.04146499851826288, -1.450709068373452e-20),
        Weight(0.08176477742800825, -4.463916392005488e-18),
        Weight(0.116363894490058, -3.561294697192352e-18),
        Weight(0.1741899033095, 1.1762381404878398e-17),
        Weight(-0.2141960954136528, -6.751658501092158e-18),
        Weight(0.087146882788236, 7.934724621918576e-19),
        Weight(-0.011892898486655628, 6.031366632865998e-19),
        Weight(-0.2344388625754197, -8.419222228644755e-18),
        Weight(0.222927475154732, 8.952814398071496e-18),
        Weight(0.13428139764119565, 4.445989193166362e-18),
        Weight(0.10238852714573539, -6.816642163929839e-18),
    ]),
    source: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142, 313 (2002), doi:10.1016/S0377-0427(01)00492-7",
};

/// Blanes and Moan's SRKN₁₄ᵃ, order 6 with 14 stages, drift first.
pub const SRKN_14A: Coefficients<14> = Coefficients {
    name: "SRKN14a",
    order: 6,
    class: Class::QuadraticKinetic {
        first: First::Drift,
    },
    stages: palindrome([
        Weight(0.03785931984061219, 2.1523542464919696e-18),
        Weight(0.05385983278385128, 1.7556623804104413e-18),
        Weight(0.048775800318585, 2.4039203253778397e-19),
        Weight(0.135207369686421, 2.70990057833842e-18),
        Weight(-0.1610752579529798, 8.882190541246783e-18),
        Weight(0.104540892120091, -2.9591923944281007e-18),
        Weight(0.2097005109513554, -9.297487156652859e-18),
        Weight(-0.204785822176643, 1.2015873068776273e-17),
        Weight(0.07464136265923131, 6.655390742682784e-18),
        Weight(0.06911976450913, -2.2501812350128605e-18),
        Weight(0.037297935860408096, -1.8042111977452257e-18),
        Weight(0.291269757886391, 2.1359366124670488e-17),
        Weight(-0.3000640010149015, 2.1186641515629096e-17),
        Weight(0.103652534528448, 1.8033458882200646e-18),
    ]),
    source: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142, 313 (2002), doi:10.1016/S0377-0427(01)00492-7",
};

/// Order 8 with 19 kicks, drift first, by Blanes, Casas and Escorihuela-Tomàs.
pub const BLANES_CASAS_ESCORIHUELA_8: Coefficients<19> = Coefficients {
    name: "Blanes–Casas–Escorihuela 8",
    order: 8,
    class: Class::QuadraticKinetic {
        first: First::Drift,
    },
    stages: mirrored([
        Weight(0.0505805, -4.600764214046865e-19),
        Weight(0.12947860656053672, 6.4276715354445976e-18),
        Weight(0.149999, 6.551204023707992e-18),
        Weight(0.22225726009267113, 1.0611284465796636e-17),
        Weight(-0.055179551077161555, -2.134081634465186e-18),
        Weight(-0.05775148933251472, -2.54934212773982e-19),
        Weight(0.42375589883533793, 2.1806860786456853e-17),
        Weight(-0.05783122621039249, -3.4032624216646962e-18),
        Weight(-0.21349535358465904, -5.836534946048438e-18),
        Weight(0.10308729743717536, -3.0120644092472035e-18),
        Weight(-0.06807697745740326, 2.9816692660558355e-18),
        Weight(-0.14081961255409076, -1.2032045878484747e-17),
        Weight(0.22791705697401343, 3.7243632343645155e-18),
        Weight(0.023446260349282627, 5.254531844840147e-19),
        Weight(-0.2353736193810589, 6.266975395103994e-18),
        Weight(0.1348545173566841, -9.381893419628029e-18),
        Weight(0.387413869179878, 2.4631157082802295e-17),
        Weight(0.02879738210737793, 1.3289144676211377e-18),
        Weight(-0.16754082348894667, 4.918508348591882e-18),
        Weight(0.22896200838654018, 4.503965569090087e-18),
    ]),
    source: "S. Blanes, F. Casas, A. Escorihuela-Tomàs, Appl. Numer. Math. 182, 14 (2022), arXiv:2202.01541, doi:10.1016/j.apnum.2022.07.010",
};
