//! Tables for any splitting, and for compositions of any one-step map.
//!
//! Input: the digits as published, polished by `scripts/coefficients.py`. Output: the tables of
//! order 3 to 10. Invariant: every condition of a composition of a map and its adjoint holds up to
//! the order, for any map.

use super::{Class, Coefficients, palindrome, strokes, symmetric};
use crate::schemes::author::Weight;

/// Ruth's scheme of order 3 with three stages, the smallest number; not symmetric.
///
/// Kick first in the paper: b = (7/24, 3/4, −1/24), a = (2/3, −2/3, 1); of order 3 in either order.
pub const RUTH_3: Coefficients<3> = Coefficients {
    name: "Ruth 3",
    order: 3,
    class: Class::General,
    stages: strokes([
        Weight(0.2916666666666667, -1.850371707708594e-17),
        Weight(0.6666666666666666, 3.700743415417188e-17),
        Weight(0.75, 0.0),
        Weight(-0.6666666666666666, -3.700743415417188e-17),
        Weight(-0.041666666666666664, -2.3129646346357427e-18),
        Weight(1.0, 0.0),
    ]),
    source: "R. D. Ruth, IEEE Trans. Nucl. Sci. 30, 2669 (1983), doi:10.1109/TNS.1983.4332919",
};

/// The triple jump of order 4, the scheme of Forest and Ruth: γ₁ = 1/(2 − 2^(1/3)), γ₂ = 1 − 2γ₁.
///
/// Its weights are large, and so are its errors: [`SUZUKI_4`] and [`BLANES_MOAN_4`] are more
/// accurate at equal cost.
pub const YOSHIDA_4: Coefficients<3> = Coefficients {
    name: "Yoshida 4",
    order: 4,
    class: Class::General,
    stages: symmetric([
        Weight(1.3512071919596575, 8.42741775545176e-17),
        Weight(-1.7024143839193153, 5.349624981599612e-17),
    ]),
    source: "H. Yoshida, Phys. Lett. A 150, 262 (1990), doi:10.1016/0375-9601(90)90092-3; E. Forest, R. D. Ruth, Physica D 43, 105 (1990), doi:10.1016/0167-2789(90)90019-L",
};

/// Suzuki's composition of order 4: γ₁ = γ₂ = 1/(4 − 4^(1/3)), γ₃ = 1 − 4γ₁.
pub const SUZUKI_4: Coefficients<5> = Coefficients {
    name: "Suzuki 4",
    order: 4,
    class: Class::General,
    stages: symmetric([
        Weight(0.4144907717943757, 2.5197374150855977e-17),
        Weight(0.4144907717943757, 2.5197374150855977e-17),
        Weight(-0.657963087177503, 1.023280585909174e-17),
    ]),
    source: "M. Suzuki, Phys. Lett. A 146, 319 (1990), doi:10.1016/0375-9601(90)90962-N",
};

/// Blanes and Moan's S6, order 4 with 6 stages.
pub const BLANES_MOAN_4: Coefficients<6> = Coefficients {
    name: "Blanes–Moan S6",
    order: 4,
    class: Class::General,
    stages: palindrome([
        Weight(0.07920369643119565, -1.926370564726105e-18),
        Weight(0.13031141018216638, 3.1649512859005182e-18),
        Weight(0.2228614958676077, -6.938243130207411e-19),
        Weight(-0.36671326904742574, 2.801873746584123e-18),
        Weight(0.3246481886897062, 1.4738514583950746e-17),
        Weight(0.1096884778767498, -4.207356930874085e-18),
    ]),
    source: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142, 313 (2002), doi:10.1016/S0377-0427(01)00492-7",
};

/// Blanes and Moan's S10, order 6 with 10 stages.
pub const BLANES_MOAN_6: Coefficients<10> = Coefficients {
    name: "Blanes–Moan S10",
    order: 6,
    class: Class::General,
    stages: palindrome([
        Weight(0.05026276440039252, 1.4476661901398686e-18),
        Weight(0.0985536835006505, -3.498842697733288e-18),
        Weight(0.31496061692769484, 5.387883140921476e-18),
        Weight(-0.447346482695478, -1.740707537464914e-18),
        Weight(0.49242637248987586, -1.8602997895823546e-17),
        Weight(-0.42511876779769114, 2.2594239460097586e-17),
        Weight(0.23706391397812088, -4.263097351777765e-18),
        Weight(0.19560248860005222, -1.0021111692825364e-17),
        Weight(0.34635818985072847, 4.25444482463886e-18),
        Weight(-0.36276277925434613, -2.49637034408014e-18),
    ]),
    source: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142, 313 (2002), doi:10.1016/S0377-0427(01)00492-7",
};

/// Yoshida's solution A of order 6 with 7 stages, the smallest number.
pub const YOSHIDA_6: Coefficients<7> = Coefficients {
    name: "Yoshida 6",
    order: 6,
    class: Class::General,
    stages: symmetric([
        Weight(0.7845136104775573, -3.5563524748377886e-17),
        Weight(0.23557321335935813, 3.570263965698029e-18),
        Weight(-1.177679984178871, -2.0335583675283312e-17),
        Weight(1.3151863206839112, 4.9146537684668507e-17),
    ]),
    source: "H. Yoshida, Phys. Lett. A 150, 262 (1990), solution A, doi:10.1016/0375-9601(90)90092-3",
};

/// Kahan and Li's composition of order 6 with 9 stages.
pub const KAHAN_LI_6: Coefficients<9> = Coefficients {
    name: "Kahan–Li 6",
    order: 6,
    class: Class::General,
    stages: symmetric([
        Weight(0.3921614440073141, 1.9826094701446433e-17),
        Weight(0.33259913678935943, 9.998816861580819e-18),
        Weight(-0.7062461725576393, -3.081725796864275e-17),
        Weight(0.0822135962935508, 5.551218882438316e-18),
        Weight(0.79854399093483, -9.117744953645643e-18),
    ]),
    source: "W. Kahan, R.-C. Li, Math. Comp. 66, 1089 (1997), doi:10.1090/S0025-5718-97-00873-9",
};

/// The composition of order 8 with 15 stages, the smallest number, found by Suzuki and Umeno and by
/// McLachlan.
///
/// As printed it has Σγ³ = −3.4e-15; here all its numbers are polished.
pub const MCLACHLAN_8: Coefficients<15> = Coefficients {
    name: "McLachlan 8",
    order: 8,
    class: Class::General,
    stages: symmetric([
        Weight(0.741670364350613, -5.148655304931061e-19),
        Weight(-0.4091008258000316, 3.8036097257781035e-18),
        Weight(0.1907547102962384, -8.968542237625456e-18),
        Weight(-0.5738624711160822, -2.6626178221869147e-17),
        Weight(0.2990641813036559, 5.6129646959270855e-18),
        Weight(0.33462491824529816, 1.9697115983221028e-17),
        Weight(0.3152930923967666, -1.994874881186706e-17),
        Weight(-0.7968879393529164, -1.6218624374007235e-18),
    ]),
    source: "R. I. McLachlan, SIAM J. Sci. Comput. 16, 151 (1995), doi:10.1137/0916010; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2006, section V.3.2, doi:10.1007/3-540-30666-8",
};

/// Kahan and Li's composition of order 8 with 17 stages.
pub const KAHAN_LI_8: Coefficients<17> = Coefficients {
    name: "Kahan–Li 8",
    order: 8,
    class: Class::General,
    stages: symmetric([
        Weight(0.13020248308889007, 1.116092648139644e-17),
        Weight(0.5611629817751084, 1.3032594119661872e-17),
        Weight(-0.38947496264484727, -1.9606416555400348e-17),
        Weight(0.1588419065551556, 7.801358338911188e-18),
        Weight(-0.39590389413323757, -1.1269790433608293e-17),
        Weight(0.1845396409783157, -3.9144420278062145e-18),
        Weight(0.25837438768632204, 9.40031880108943e-18),
        Weight(0.2950117236093103, 2.6483903318022958e-17),
        Weight(-0.6055085338300346, 4.4845398377981585e-17),
    ]),
    source: "W. Kahan, R.-C. Li, Math. Comp. 66, 1089 (1997), doi:10.1090/S0025-5718-97-00873-9",
};

/// Sofroniou and Spaletta's composition of order 8 with 21 stages.
pub const SOFRONIOU_SPALETTA_8: Coefficients<21> = Coefficients {
    name: "Sofroniou–Spaletta 8",
    order: 8,
    class: Class::General,
    stages: symmetric([
        Weight(0.10647728984550031, 6.845541886003224e-18),
        Weight(0.10837408645835726, 6.892324821644982e-19),
        Weight(0.35337821052654345, -2.1695378247100082e-17),
        Weight(-0.23341414023165083, 7.594418906545166e-18),
        Weight(-0.2444526679152884, 2.973481211429214e-19),
        Weight(0.11317848435755633, 5.514010809029823e-18),
        Weight(0.1189290562500035, 5.28389249308059e-18),
        Weight(0.12603912321825989, -3.892054941470889e-18),
        Weight(0.12581718736176042, -6.125153138596297e-18),
        Weight(0.11699135019217642, 2.997670888667258e-19),
        Weight(-0.38263596012643664, -1.7378826534960274e-17),
    ]),
    source: "M. Sofroniou, G. Spaletta, Optim. Methods Softw. 20, 597 (2005), doi:10.1080/10556780500140664",
};

/// Sofroniou and Spaletta's composition of order 10 with 35 stages.
pub const SOFRONIOU_SPALETTA_10: Coefficients<35> = Coefficients {
    name: "Sofroniou–Spaletta 10",
    order: 10,
    class: Class::General,
    stages: symmetric([
        Weight(0.07879572252168641, 4.37856306120002e-18),
        Weight(0.3130961034151085, 1.0155656902367276e-17),
        Weight(0.027918383235078066, -1.9588702490262553e-20),
        Weight(-0.22959284159390708, -1.2019548631571379e-17),
        Weight(0.13096206107716488, -1.3146875601313318e-17),
        Weight(-0.2697334056545107, -9.292846834466853e-18),
        Weight(0.07497334315589144, -8.294709988255942e-19),
        Weight(0.1119934239998102, 3.315063244244453e-18),
        Weight(0.36613344954622673, 2.0972992791507338e-17),
        Weight(-0.3991056301360359, -4.105091391760349e-18),
        Weight(0.10308739852747108, -1.426477958183094e-19),
        Weight(0.41143087395589023, 7.23408574658642e-18),
        Weight(-0.0048663605831352616, -1.9975821349100886e-19),
        Weight(-0.3920333537086399, -8.609231761858698e-18),
        Weight(0.05194250296244965, -2.2247727335547566e-18),
        Weight(0.050665090759924494, 2.0456071349122702e-18),
        Weight(0.049674370639729876, 3.4007127004819606e-18),
        Weight(0.049317735759594535, 3.3784725956319968e-18),
    ]),
    source: "M. Sofroniou, G. Spaletta, Optim. Methods Softw. 20, 597 (2005), doi:10.1080/10556780500140664",
};
