//! Tables of processed splittings: a kernel, and the processor π around all its steps.
//!
//! Input: the digits as published or found by `scripts/kernels.py`, polished by `scripts/coefficients.py`.
//! Output: the tables of order 4 to 8, the correctors of Strang's splitting, a cheap post-processor. Invariant:
//! π⁻¹, kernel and π one after the other satisfy the conditions of the class; the durations of π sum to zero.

use super::{Class, Coefficients, near_integrable::SABA_1, palindrome, symmetric};
use crate::schemes::author::{Durations, Weight};

/// A kernel of `K` stages and a processor of `P`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Processing<const K: usize, const P: usize> {
    /// The name of the scheme in the field.
    pub name: &'static str,
    /// The order of the whole.
    pub order: u32,
    /// The splittings it is for.
    pub class: Class,
    /// The durations of the stages of the kernel.
    pub kernel: [Durations; K],
    /// The durations of the stages of π, which is applied to observed states.
    pub processor: [Durations; P],
    /// Author, journal or book, year, DOI.
    pub source: &'static str,
}

/// Order 4 with 5 stages: the least error modulo conjugation that was found.
pub const PROCESSED_4: Processing<5, 12> = Processing {
    name: "Processed 4",
    order: 4,
    class: Class::General,
    kernel: palindrome([
        Weight(0.18942387299348393, 2.8481856722282826e-18),
        Weight(0.22664306546899612, -4.3786200384420226e-18),
        Weight(0.15009666048894943, -9.679591813094472e-18),
        Weight(0.29792623322758816, -2.4972268202488753e-17),
        Weight(-0.3640898321790176, -1.9328856849460863e-17),
    ]),
    processor: twice([
        Weight(-0.03381636923401766, -1.681574752101369e-18),
        Weight(0.41079318130411496, -2.6819503737351623e-18),
        Weight(-0.39058390449081315, -3.430418968491722e-19),
        Weight(-0.2265228565118507, -4.628720415166754e-18),
        Weight(-0.09543418099840181, 3.01196651020291e-18),
        Weight(-0.1786572773459443, 4.203229080485471e-18),
        Weight(0.10672492980681786, 1.3204204418434528e-18),
        Weight(0.21633009791857474, -3.021125073028088e-18),
        Weight(-0.2208364123696032, -8.902943917019001e-18),
        Weight(0.04470258039852269, -2.717300230924593e-18),
        Weight(0.2889941120436627, -2.7561574767440192e-17),
        Weight(0.0783060994789379, -5.569641933618102e-18),
    ]),
    source: "kernel and processor by scripts/kernels.py, after S. Blanes, F. Casas, A. Murua, SIAM J. Sci. Comput. 27, 1817 (2006), doi:10.1137/030601223",
};

/// ρ of [`PROCESSED_4`]: the mean of ρ(h) and ρ(−h) is π up to O(h⁵).
pub const MEAN_4: Coefficients<3> = Coefficients {
    name: "Processed 4, cheap post-processor",
    order: 4,
    class: Class::General,
    stages: pairs([
        Weight(0.11205668817065838, 5.825840820242514e-18),
        Weight(-0.29800962370394685, -3.2063224867774246e-18),
        Weight(-0.08628892551533836, 3.927585551402205e-18),
        Weight(0.01131929217039982, -3.652389357487664e-19),
        Weight(0.260922568878227, -1.1386035377048948e-17),
        Weight(0.0, 0.0),
    ]),
    source: "by scripts/coefficients.py, after S. Blanes, F. Casas, A. Murua, SIAM J. Numer. Anal. 42, 531 (2004), doi:10.1137/S0036142902417029",
};

/// Order 6 with 8 stages: the least error modulo conjugation that was found.
pub const PROCESSED_6: Processing<8, 24> = Processing {
    name: "Processed 6",
    order: 6,
    class: Class::General,
    kernel: palindrome([
        Weight(0.4123534447103464, 2.116075406143475e-17),
        Weight(-0.398845563984167, -8.309093733033455e-18),
        Weight(0.1797604917202067, 5.689508997602388e-18),
        Weight(-0.29777475418183097, -1.4209159698509473e-17),
        Weight(0.16146025161046204, 1.178488670601383e-17),
        Weight(0.14360883079017303, -9.890098169489646e-19),
        Weight(0.15677272536138287, 2.6460620312718675e-19),
        Weight(0.14266457397342688, 1.2363082895942653e-17),
    ]),
    processor: twice([
        Weight(0.19942106668526377, -3.3501262303616385e-19),
        Weight(-0.24520512908358788, -4.549016418455518e-18),
        Weight(0.3731282513951695, 2.5408715402591043e-17),
        Weight(-0.33972887794068746, -2.962317138517392e-18),
        Weight(0.05856291430363041, -3.1153535479370476e-18),
        Weight(-0.07944300914711097, 1.1687148546843673e-18),
        Weight(-0.25185517486609116, -1.774399434143561e-18),
        Weight(0.14460461604440666, -4.165933307231171e-18),
        Weight(0.3940476382806521, 1.8647785310112463e-17),
        Weight(-0.3903824878114566, 2.436031784636725e-17),
        Weight(-0.29599850408171746, 1.744460706540849e-18),
        Weight(0.328875740041771, 2.539916914065618e-17),
        Weight(0.0961158829694107, -4.195212247213931e-18),
        Weight(0.2994991469787901, 1.6054594358138274e-18),
        Weight(-0.14069383219797005, -2.085263175831642e-18),
        Weight(0.21113373316350098, -6.340974591876147e-19),
        Weight(0.4176605668616825, 6.788578060805647e-18),
        Weight(-0.41734517723591424, 4.207037882006262e-18),
        Weight(-0.30272739416337124, 1.338469122587365e-17),
        Weight(-0.34239466006050373, 4.809741272038081e-19),
        Weight(-0.20884973485118516, -7.654676930178539e-19),
        Weight(0.21245708590670062, 1.099759222614199e-17),
        Weight(0.3067974846170819, 5.224518967588665e-18),
        Weight(-0.027680145808464365, -3.4419272734483924e-19),
    ]),
    source: "kernel and processor by scripts/kernels.py, after S. Blanes, F. Casas, A. Murua, SIAM J. Sci. Comput. 27, 1817 (2006), doi:10.1137/030601223",
};

/// Blanes, Casas and Murua's composition of symmetric maps, order 8 with 13 stages.
pub const BLANES_CASAS_MURUA_8: Processing<13, 20> = Processing {
    name: "Blanes–Casas–Murua 8",
    order: 8,
    class: Class::General,
    kernel: symmetric([
        Weight(0.168, -1.0436096431476472e-17),
        Weight(0.16800000000000034, -1.3000843638825713e-17),
        Weight(0.5855505308055623, 4.9271500701919755e-17),
        Weight(-0.4600904575168717, 1.609580708050064e-17),
        Weight(0.17286314872973063, 2.670328335206215e-18),
        Weight(0.179664539695039, -1.0558375025539135e-17),
        Weight(-0.6279755234269212, -1.2573490812312748e-17),
    ]),
    processor: twice_symmetric([
        Weight(-0.543415765371656, 3.4332659146457447e-17),
        Weight(0.598212975943381, -7.405313484888854e-18),
        Weight(0.236885952363384, -2.9652007106051314e-19),
        Weight(-0.511744926116413, -2.076658346413751e-17),
        Weight(0.162324207599241, 1.1702149336997536e-17),
        Weight(0.5883511890038488, -4.2555010993935263e-17),
        Weight(0.333987768164597, -2.0881245725831832e-17),
        Weight(-0.33718896735433823, 1.444530762405714e-17),
        Weight(-0.008488123494574425, 7.231923685695069e-19),
        Weight(-0.51892431073747, 4.6805131241202366e-18),
    ]),
    source: "S. Blanes, F. Casas, A. Murua, SIAM J. Sci. Comput. 27, 1817 (2006), doi:10.1137/030601223",
};

/// Wisdom's corrector of order 3 of Strang's splitting: error O(εh⁴ + ε²h²).
pub const WISDOM_HOLMAN_3: Processing<1, 2> = Processing {
    name: "Wisdom–Holman, corrector 3",
    order: 2,
    class: Class::NearIntegrable { orders: &[4, 2] },
    kernel: SABA_1.stages,
    processor: pairs([
        Weight(0.4183300132670378, -7.343560760187747e-18),
        Weight(-0.36852882121143804, 1.1825510286170323e-18),
        Weight(-0.4681312053226375, 1.3504570491758463e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
    ]),
    source: "J. Wisdom, Astron. J. 131, 2294 (2006), doi:10.1086/500829",
};

/// Wisdom's corrector of order 5 of Strang's splitting: error O(εh⁶ + ε²h²).
pub const WISDOM_HOLMAN_5: Processing<1, 4> = Processing {
    name: "Wisdom–Holman, corrector 5",
    order: 2,
    class: Class::NearIntegrable { orders: &[6, 2] },
    kernel: SABA_1.stages,
    processor: pairs([
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(-0.8532604238859421, 1.6740791430899066e-17),
        Weight(-0.820059629182209, 1.2633451609851924e-17),
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
        Weight(-0.3353280265077049, -2.924788792430111e-18),
        Weight(-0.5013320000263707, 1.7611910312805606e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
    ]),
    source: "J. Wisdom, Astron. J. 131, 2294 (2006), doi:10.1086/500829",
};

/// Wisdom's corrector of order 7 of Strang's splitting: error O(εh⁸ + ε²h²).
pub const WISDOM_HOLMAN_7: Processing<1, 6> = Processing {
    name: "Wisdom–Holman, corrector 7",
    order: 2,
    class: Class::NearIntegrable { orders: &[8, 2] },
    kernel: SABA_1.stages,
    processor: pairs([
        Weight(1.2549900398011133, -2.2030682280563244e-17),
        Weight(-1.250004677515729, 6.720658643853571e-17),
        Weight(-1.2599754020864977, -2.3145221877409216e-17),
        Weight(1.2549900398011133, -2.2030682280563244e-17),
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(-0.8732018730274798, -5.294052273847511e-17),
        Weight(-0.8001181800406713, -2.870753668328955e-17),
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
        Weight(-0.3104012150807828, 9.101270724008727e-19),
        Weight(-0.5262588114532928, 1.3776994447974624e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
    ]),
    source: "J. Wisdom, Astron. J. 131, 2294 (2006), doi:10.1086/500829",
};

/// Wisdom's corrector of order 11 of Strang's splitting: error O(εh¹² + ε²h²).
pub const WISDOM_HOLMAN_11: Processing<1, 10> = Processing {
    name: "Wisdom–Holman, corrector 11",
    order: 2,
    class: Class::NearIntegrable { orders: &[12, 2] },
    kernel: SABA_1.stages,
    processor: pairs([
        Weight(2.091650066335189, -3.6717803800938736e-17),
        Weight(-2.0912428347422316, -1.7252475077013086e-16),
        Weight(-2.0920572979281458, -1.9812885147805428e-16),
        Weight(2.091650066335189, -3.6717803800938736e-17),
        Weight(1.6733200530681511, -2.937424304075099e-17),
        Weight(-1.67801749612661, -5.821850015277075e-17),
        Weight(-1.668622610009692, -1.0507761869075858e-16),
        Weight(1.6733200530681511, -2.937424304075099e-17),
        Weight(1.2549900398011133, -2.2030682280563244e-17),
        Weight(-1.2303718826170735, 1.0187538324143903e-16),
        Weight(-1.2796081969851532, -5.781401868031256e-17),
        Weight(1.2549900398011133, -2.2030682280563244e-17),
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(-0.9129032538966528, -1.5818494944167763e-17),
        Weight(-0.7604167991714983, 4.519273798491875e-17),
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
        Weight(-0.2731432237693523, -2.0019003831610528e-18),
        Weight(-0.5635168027647233, 1.6689021903536547e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
    ]),
    source: "J. Wisdom, Astron. J. 131, 2294 (2006), doi:10.1086/500829",
};

/// Wisdom's corrector of order 17 of Strang's splitting: error O(εh¹⁸ + ε²h²).
pub const WISDOM_HOLMAN_17: Processing<1, 16> = Processing {
    name: "Wisdom–Holman, corrector 17",
    order: 2,
    class: Class::NearIntegrable { orders: &[18, 2] },
    kernel: SABA_1.stages,
    processor: pairs([
        Weight(3.3466401061363023, -5.874848608150198e-17),
        Weight(-3.3466487756193968, -9.043565546934697e-17),
        Weight(-3.3466314366532077, 2.0793262763235094e-16),
        Weight(3.3466401061363023, -5.874848608150198e-17),
        Weight(2.9283100928692645, -5.1404925321314234e-17),
        Weight(-2.9281572201588086, 9.148625877126343e-17),
        Weight(-2.9284629655797203, 1.1323591871365043e-17),
        Weight(2.9283100928692645, -5.1404925321314234e-17),
        Weight(2.5099800796022267, -4.406136456112649e-17),
        Weight(-2.511252079263743, -5.4797539886843915e-17),
        Weight(-2.5087080799407104, 1.429202690090969e-16),
        Weight(2.5099800796022267, -4.406136456112649e-17),
        Weight(2.091650066335189, -3.6717803800938736e-17),
        Weight(-2.0850235509213126, -9.82318042053082e-17),
        Weight(-2.098276581749065, 1.7166741180718568e-16),
        Weight(2.091650066335189, -3.6717803800938736e-17),
        Weight(1.6733200530681511, -2.937424304075099e-17),
        Weight(-1.6974635747128357, 3.186433621016561e-17),
        Weight(-1.6491765314234665, 2.688414987133637e-17),
        Weight(1.6733200530681511, -2.937424304075099e-17),
        Weight(1.2549900398011133, -2.2030682280563244e-17),
        Weight(-1.1901456420716863, 1.1025479455415366e-16),
        Weight(-1.3198344375305404, -6.619342999302717e-17),
        Weight(1.2549900398011133, -2.2030682280563244e-17),
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(-0.9670457536868313, -1.3323413544318492e-17),
        Weight(-0.7062742993813198, 4.269765658506948e-17),
        Weight(0.8366600265340756, -1.4687121520375495e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
        Weight(-0.23221780572418585, -7.269692073873194e-18),
        Weight(-0.6044422208098897, 4.97123892098776e-17),
        Weight(0.4183300132670378, -7.343560760187747e-18),
    ]),
    source: "J. Wisdom, Astron. J. 131, 2294 (2006), doi:10.1086/500829",
};

/// d₁ u₁ d₂ u₂ … of the stages.
const fn pairs<const N: usize, const S: usize>(durations: [Weight; N]) -> [Durations; S] {
    assert!(N == 2 * S, "a stage has two durations");
    let mut stages = [(Weight(0.0, 0.0), Weight(0.0, 0.0)); S];
    let mut i = 0;
    while i < S {
        stages[i] = (durations[2 * i], durations[2 * i + 1]);
        i += 1;
    }
    stages
}

/// d₁ u₁ d₂ u₂ … of the stages, then the same stages with −h.
const fn twice<const S: usize>(durations: [Weight; S]) -> [Durations; S] {
    let mut stages = [(Weight(0.0, 0.0), Weight(0.0, 0.0)); S];
    let mut i = 0;
    while i < S {
        let (down, up) = (durations[2 * i % S], durations[(2 * i + 1) % S]);
        stages[i] = if 2 * i < S {
            (down, up)
        } else {
            (down.negated(), up.negated())
        };
        i += 1;
    }
    stages
}

/// Steps γ₁h, γ₂h, … of a symmetric map, then steps −γ₁h, −γ₂h, ….
const fn twice_symmetric<const N: usize, const S: usize>(gammas: [Weight; N]) -> [Durations; S] {
    assert!(S == 2 * N, "each step is made with h and with −h");
    let mut stages = [(Weight(0.0, 0.0), Weight(0.0, 0.0)); S];
    let mut i = 0;
    while i < N {
        let half = gammas[i].half();
        stages[i] = (half, half);
        stages[N + i] = (half.negated(), half.negated());
        i += 1;
    }
    stages
}
