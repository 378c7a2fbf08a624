//! Random expressions for the macro. Made by `generate.rs`; not to be edited.

// Not every random expression reads every parameter.
#![allow(unused_variables)]

use hamiltonian::hamiltonian;

/// The name of this file.
pub const FILE: &str = "expressions.rs";

/// The numbers of the expressions in it.
pub const NUMBERS: core::ops::Range<usize> = 0..32;

hamiltonian! {
    pub struct E0 { a, b, c }
    H(x, y; px, py; t) = ((if ((if (max((-1), (1/3)) <= t) { a } else { (1/2) }) <= b) { hypot(((t - (py^2))*max((-7/4), (1/2))), a) } else { px }) + round(((a*y) + (3/10))))
}

hamiltonian! {
    pub struct E1 { a, b, c }
    H(x, y; px, py; t) = (((if (min((y - (1/10)), 1) < y) || ((min(a, b) + (1/2)) < c) { ((-((if (ln_1p(abs(atan2(b, y))) <= b) { (1/10) } else { min((y - (1/10)), 1) })*min((y - (1/10)), 1)))/(if (c <= pi) && (ln(abs(a)) < px) { (b*c) } else { (if ((a + (b - px)) < t) || (asin(((y*py)/(1 + ((y*py)^2)))) <= (1/10)) { a } else { (1/2) }) })) } else { (((cos(((py - (1/3)) - a)) + (2*pi)) + c)^6) })*((-t) - c))*cosh(tanh(hypot((981/100), (1/3)))))
}

hamiltonian! {
    pub struct E2 { a, b, c }
    H(x, y; px, py; t) = ((if !((x*x) == px) { ((2 + x)/((2/((((px + acosh((((x^2) + 1) + 1))) - tan(x))^2) + (a^2)))*(if (((b*a) + pi) == c) || (x <= c) { (2^2) } else { (-7/4) }))) } else { ((atanh((asin((((x*t) + (if ((-x) < a) { (a - py) } else { (5 + 2) }))/(1 + (((x*t) + (if ((-x) < a) { (a - py) } else { (5 + 2) }))^2))))/(1 + (asin((((x*t) + (if ((-x) < a) { (a - py) } else { (5 + 2) }))/(1 + (((x*t) + (if ((-x) < a) { (a - py) } else { (5 + 2) }))^2))))^2))))^2)*(acos(cos(((exp((y*((t/((y^2) + (px^2))) + (y - px))))^(-7/5)) + (sinh(cos(((c + x)^4)))/c))))*(-remainder(((-7/4) + (3/10)), t)))) }) + a)
}

hamiltonian! {
    pub struct E3 { a, b, c }
    H(x, y; px, py; t) = ((((1/3)*((((1/3) - b) - max((1/2), tanh(((1/2) - (-7/4))))) + 3))*(((((py^2) + (1/4))^(1/3)) - (px/(1/2))) - cosh(asin((min(c, pi)/(1 + (min(c, pi)^2))))))) + tan(((exp(cos(a)) - atanh((t/(1 + (t^2)))))*(max(y, atan((exp(cos(a))^-3))) + (((max(y, atan((exp(cos(a))^-3)))^2) + (1/4))^(-1/2))))))
}

hamiltonian! {
    pub struct E4 { a, b, c }
    H(x, y; px, py; t) = ((c*y) - (exp(atan((5/cosh((y*py)))))^(1/2)))
}

hamiltonian! {
    pub struct E5 { a, b, c }
    H(x, y; px, py; t) = (((abs((cos((asin(((y^4)/(1 + ((y^4)^2)))) - (((t*py) + (3/10)) % c)))*((abs(sqrt(((max((3/10), acos(tanh(x)))^2) + (1/4))))^(-1/2))*(py*px))))^(3/10))/3) + tanh(a))
}

hamiltonian! {
    pub struct E6 { a, b, c }
    H(x, y; px, py; t) = ((((px + px)*py) - min(hypot(((px + px)*py), px), (-1))) + ((((x/x) + (if (ln_1p(exp(atan(ln(abs(a))))) < atan(ln(abs(a)))) { y } else { 1 }))*exp_m1(atan(acos(((1 + atan(ln(abs(a))))/(1 + ((1 + atan(ln(abs(a))))^2))))))) - atan2(y, (x*t))))
}

hamiltonian! {
    pub struct E7 { a, b, c }
    H(x, y; px, py; t) = (((((1/10) + y) - ((abs(y)*abs(y))*a))/exp((pow(exp(py), tanh((px*y)))^3)))/((y^2) + 1))
}

hamiltonian! {
    pub struct E8 { a, b, c }
    H(x, y; px, py; t) = ln((((exp(atan(((((-1) - (-1)) + a) - (((t*cosh((acosh((((t^2) + (c^2)) + 1)) + py))) + ((if ((a + c) <= t) || (b < px) { (py*a) } else { 3 })*t)) + (((t + py)*acos((t/(1 + (t^2)))))*(y + (((((((pi*(pi*py))^2) + (1/4))^(3/2))^2) + (1/4))^(-4/3))))))))^(-7/5))^2) + (1/4)))
}

hamiltonian! {
    pub struct E9 { a, b, c }
    H(x, y; px, py; t) = (((b/(cosh(erfc(t))^-2))*((a - px)/abs(((((a^2) + 1)^(-4/3)) - py)))) + ((((max((-1), t)^4) - (sinh(cos(exp_m1(tanh(b)))) + ((1/3) + ((x + b)*cosh(((abs((((x + b)*(1/3))*b))^-3)^5))))))*b) - (if ((981/100) < y) && (sign(x) <= x) { a } else { x })))
}

hamiltonian! {
    pub struct E10 { a, b, c }
    H(x, y; px, py; t) = ((if (erfc(x) <= px) && ((b + b) < t) { x } else { px }) + sign((atan2(tanh(c), 2) - floor((3 + (3/10))))))
}

hamiltonian! {
    pub struct E11 { a, b, c }
    H(x, y; px, py; t) = ((2*(-7/4))*(((y/(((t^2) + (py^2))^-3)) + acos((a/(1 + (a^2))))) + 2))
}

hamiltonian! {
    pub struct E12 { a, b, c }
    H(x, y; px, py; t) = (((cosh((abs((((1/3) - (px*px))*(px - remainder((px + (3/10)), py))))^(3/2)))^(-4/3))*((t - py)*pi)) + (acos(cos((-(a*(((if ((((tanh(a)^2) + (tanh(a)^2))^(3/10)) <= x) && (x < y) { (b^5) } else { x })*y) + (pi + 1))))))^-1))
}

hamiltonian! {
    pub struct E13 { a, b, c }
    H(x, y; px, py; t) = ((-((((((((x + (if !(((if (((-7/4) - (x - a)) <= py) { c } else { 5 })^2) <= x) { 5 } else { x }))*(981/100))*x)^2) + (a^2))^(5/2)) + asinh(a)) + ((if (((-7/4) - (x - a)) <= py) { c } else { 5 })^2)))*t)
}

hamiltonian! {
    pub struct E14 { a, b, c }
    H(x, y; px, py; t) = exp_m1(((((((-px)^7)*t)*sign((1/10)))/((pow((((px - acosh((((pi^2) + (((-px)^7)^2)) + 1)))^2) + 2), ((px + y)^5))^2) + (pi^2)))*(((((-px)^7)*t)*sign((1/10)))*sin(((-1)*3)))))
}

hamiltonian! {
    pub struct E15 { a, b, c }
    H(x, y; px, py; t) = ((if ((c/((t^2) + 1)) < b) { a } else { ((-7/4)*py) }) + (-(asinh(((1/(981/100)) + ((remainder((x + (3/10)), ((1^2) + 2))/a) + (((y + pi)*atan2(x, 3))*(x + (3/10)))))) + round((t + (3/10))))))
}

hamiltonian! {
    pub struct E16 { a, b, c }
    H(x, y; px, py; t) = ((b/((tan(x)^2) + (px^2)))*(t/(-c)))
}

hamiltonian! {
    pub struct E17 { a, b, c }
    H(x, y; px, py; t) = (-((a + (-(atan2(px, 2)*((x - b)*(a/((t^2) + (y^2)))))))*(((((if !((c/c) <= x) { y } else { ((1/3) - (1/3)) })^2) + (a^2))^(-3/2)) - ((py*((((if !((c/c) <= x) { y } else { ((1/3) - (1/3)) })^2) + (a^2))^(-3/2)))^2))))
}

hamiltonian! {
    pub struct E18 { a, b, c }
    H(x, y; px, py; t) = (erfc(((px - (-(-1)))*t)) + tanh(((exp(sin((-(((min(x, ((-((a + pi) + y)) + ((b - x)/((pi^2) + 1))))^2) + 2)^(2/3))))) + (2 + 3)) + erfc(ln(abs((((((y*t) - (981/100))*(if (y < x) || (t <= x) { (if (((3 + (3/10)) % (((pi^2) + 1)^(5/2))) < x) || ((c*(t + x)) == b) { (if ((pi + cosh((3/10))) < x) || (sinh(pow(((x^2) + 2), b)) < y) { x } else { c }) } else { hypot(3, 1) }) } else { (t*(if (tan(x) <= a) && ((cosh(atan(t))^(-1/2)) <= y) { floor((cos((t/c)) + (3/10))) } else { atan(x) })) }))*x) + tanh(((1/3)*((y*y)*x))))))))))
}

hamiltonian! {
    pub struct E19 { a, b, c }
    H(x, y; px, py; t) = floor(((((((abs((((-t)*acos((t/(1 + (t^2))))) + (-(if (c <= t) && (((-t)*acos((t/(1 + (t^2))))) < a) { y } else { (1/10) }))))^-2)^2) + 2)^(-3/2)) - hypot(px, (sqrt((((pow(exp(x), pi)*py)^2) + 2))/exp(((1/2) + x))))) + (3/10)))
}

hamiltonian! {
    pub struct E20 { a, b, c }
    H(x, y; px, py; t) = (((px/a) + y) + ((max(b, (x^6)) + (px + 1))^4))
}

hamiltonian! {
    pub struct E21 { a, b, c }
    H(x, y; px, py; t) = ((if (((-py) + c) < c) && ((t + py) <= a) { (cosh(atan((pow(((py^2) + 2), cos(px)) + py)))^(-3/2)) } else { (remainder((t + (3/10)), (((1/10)^2) + 2))*px) }) + (((y + (y*pi))*(1/2)) - (cosh(atan(((if (((exp(c)^(-3/2)) + b) < a) && (y <= b) { ((y + (y*pi))^3) } else { t })*((((-1)^2) + 1)^(-1/2)))))^(1/2))))
}

hamiltonian! {
    pub struct E22 { a, b, c }
    H(x, y; px, py; t) = ((((t - (if ((py*(py^7)) == (1/3)) { y } else { py })) - (3*atanh((py/(1 + (py^2))))))/((((1/3) + (py/(1 + (py^2))))^2) + 2))*(((-7/4) + y)*(1/3)))
}

hamiltonian! {
    pub struct E23 { a, b, c }
    H(x, y; px, py; t) = (if (((y*x)*x) == 3) && ((t + px) < (((3 + (-7/4))^2) + 1)) { floor(((-(x*c)) + (3/10))) } else { erf((((((3 + (-7/4))^2) + 1)^(-4/3)) + t)) })
}

hamiltonian! {
    pub struct E24 { a, b, c }
    H(x, y; px, py; t) = ((min(px, a)*tan(asinh(t))) + (sinh(cos((t + b)))/y))
}

hamiltonian! {
    pub struct E25 { a, b, c }
    H(x, y; px, py; t) = (((y + t) + (if (1 < t) || (c < py) { (if (ln(abs((if !(y < x) { y } else { y }))) <= x) { b } else { px }) } else { x })) - tan(cos(((if ((((b^2) + (pi^2))^(1/3)) <= px) && (((c*px)*a) <= px) { px } else { (1/2) }) + (y - acos((c/(1 + (c^2)))))))))
}

hamiltonian! {
    pub struct E26 { a, b, c }
    H(x, y; px, py; t) = ln_1p((((((a/((y + a) - (b*pi)))^-3) + (py - ((981/100)*(1/3))))^2) + ((-1)^2)))
}

hamiltonian! {
    pub struct E27 { a, b, c }
    H(x, y; px, py; t) = ((c + (tanh((px*py))/cosh(cos(((abs((5/px))^(2/3))*(a*(b + py))))))) + ((b*x)*(((b^5)/(x*min(2, (exp(pi)^-3)))) + x)))
}

hamiltonian! {
    pub struct E28 { a, b, c }
    H(x, y; px, py; t) = (((-(c + py))/((x - pi)/((x^2) + 1))) + (1/3))
}

hamiltonian! {
    pub struct E29 { a, b, c }
    H(x, y; px, py; t) = min((((y^2) - (exp(1) + x)) + atan(max((b - pi), px))), ((pi + pi)/t))
}

hamiltonian! {
    pub struct E30 { a, b, c }
    H(x, y; px, py; t) = ((-(min(b, c)*(b - ((1/10)*px)))) + ((abs(((-x) + floor((ln_1p(abs(erfc((round((c + (3/10))) - (1/10))))) + (3/10)))))^(2/3))^5))
}

hamiltonian! {
    pub struct E31 { a, b, c }
    H(x, y; px, py; t) = ((b + exp_m1(cos((if (atan((y + py)) <= 5) && (c <= y) { (if (max(c, c) <= t) { floor((px + (3/10))) } else { c }) } else { atanh(((py - 5)/(1 + ((py - 5)^2)))) }))))/((atan(sin(x))^2) + 1))
}

crate::compiled::list! {
    0 E0 separable
    1 E1 any
    2 E2 any
    3 E3 separable
    4 E4 any
    5 E5 any
    6 E6 separable
    7 E7 any
    8 E8 any
    9 E9 separable
    10 E10 any
    11 E11 any
    12 E12 separable
    13 E13 any
    14 E14 any
    15 E15 separable
    16 E16 any
    17 E17 any
    18 E18 separable
    19 E19 any
    20 E20 any
    21 E21 separable
    22 E22 any
    23 E23 any
    24 E24 separable
    25 E25 any
    26 E26 any
    27 E27 separable
    28 E28 any
    29 E29 any
    30 E30 separable
    31 E31 any
}
