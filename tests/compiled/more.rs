//! Random expressions for the macro. Made by `generate.rs`; not to be edited.

// Not every random expression reads every parameter.
#![allow(unused_variables)]

use hamiltonian::hamiltonian;

/// The name of this file.
pub const FILE: &str = "more.rs";

/// The numbers of the expressions in it.
pub const NUMBERS: core::ops::Range<usize> = 32..256;

hamiltonian! {
    pub struct E32 { a, b, c }
    H(x, y; px, py; t) = (acosh((exp(atanh((((if (py < px) { (if (y == (1/3)) || ((y - py) <= a) { y } else { (-1) }) } else { (((-b) + (3/10)) % abs(py)) })*a)/(1 + (((if (py < px) { (if (y == (1/3)) || ((y - py) <= a) { y } else { (-1) }) } else { (((-b) + (3/10)) % abs(py)) })*a)^2))))) + 1)) + (c + atanh((((if (py < px) { (if (y == (1/3)) || ((y - py) <= a) { y } else { (-1) }) } else { (((-b) + (3/10)) % abs(py)) })*a)/(1 + (((if (py < px) { (if (y == (1/3)) || ((y - py) <= a) { y } else { (-1) }) } else { (((-b) + (3/10)) % abs(py)) })*a)^2))))))
}

hamiltonian! {
    pub struct E33 { a, b, c }
    H(x, y; px, py; t) = (((px*cos((py - (px*(a/px)))))^(3/2)) + ((((y + (tan(tanh(t)) - ((y^2)^6)))^6)*(ln_1p(abs(c))/((y^2) + (y^2)))) + (((-1)/((y^2) + 1)) + (a - atanh(((1/10)/(1 + ((1/10)^2))))))))
}

hamiltonian! {
    pub struct E34 { a, b, c }
    H(x, y; px, py; t) = (if ((px - atan2(px, t)) <= y) { ((abs((a - t)) + px) + ((3/((asin(sin(px))^2) + (py^2)))*abs(floor((c + (3/10)))))) } else { (floor((y + (3/10))) + ((py^2) - c)) })
}

hamiltonian! {
    pub struct E35 { a, b, c }
    H(x, y; px, py; t) = (if !(acos(tanh(tan(atan(x)))) <= x) { pi } else { (if ((t/py) <= y) && (((1/3)/px) < y) { (((((ln(abs(x))*py) + tan(atan(x)))^2) + (1/4))^(-3/2)) } else { exp_m1(sin((py + pi))) }) })
}

hamiltonian! {
    pub struct E36 { a, b, c }
    H(x, y; px, py; t) = (((5*pi) + ((((t - py) + max(a, py)) - (py/((atan(py)^2) + (px^2)))) + b)) + (pow(abs((if !((c - pi) <= b) { b } else { t })), a)*(((((sinh(sin(c))^3)/((y^2) + 2))^-2)*((x*t) + acos(sin(y)))) - ((c - pi) + c))))
}

hamiltonian! {
    pub struct E37 { a, b, c }
    H(x, y; px, py; t) = (pow(abs(((((c*c)^2) + 1)^(-3/2))), sin(((if ((1/10) <= px) { (b*y) } else { (1/10) }) - ((px + px) - c)))) + t)
}

hamiltonian! {
    pub struct E38 { a, b, c }
    H(x, y; px, py; t) = (atan2(x, px)*(pow(exp(sin(t)), cos(remainder((t + (3/10)), abs(1))))/(y/t)))
}

hamiltonian! {
    pub struct E39 { a, b, c }
    H(x, y; px, py; t) = ((min(t, px) - (((((min(t, px)^2) + 2)^(-7/5))^2)^5)) + (a/(max((if !(atan2(2, cosh(t)) < x) { sign(y) } else { (cosh(y) - (if ((y + a) == (y + a)) { ((-7/4)*c) } else { a })) }), (y + a))^(1/2))))
}

hamiltonian! {
    pub struct E40 { a, b, c }
    H(x, y; px, py; t) = (if ((px + (-px)) <= t) && ((px*(a^2)) < b) { ((t/(if ((a*x) <= a) { pi } else { pi })) - exp_m1(sin((b + 3)))) } else { (x/t) })
}

hamiltonian! {
    pub struct E41 { a, b, c }
    H(x, y; px, py; t) = acos((cosh(((py/(a - b))*(if (acos(sin(c)) <= 2) { (x*(py + (1/2))) } else { sqrt(((ln(abs(exp(sin(y))))^2) + 2)) })))/(1 + (cosh(((py/(a - b))*(if (acos(sin(c)) <= 2) { (x*(py + (1/2))) } else { sqrt(((ln(abs(exp(sin(y))))^2) + 2)) })))^2))))
}

hamiltonian! {
    pub struct E42 { a, b, c }
    H(x, y; px, py; t) = ((-(-((((((round((a + (3/10)))^2) + 1)^(3/10))^4)*pi) - py))) + sqrt(((((pi - b) + ((b + b)*(y - (-7/4))))^2) + 2)))
}

hamiltonian! {
    pub struct E43 { a, b, c }
    H(x, y; px, py; t) = exp(sin(hypot(asin(cos(((sin(((-((y + (3/10)) % cosh(cos(y))))^5)) + x) + (if !(ln(abs(t)) == px) { py } else { ((py*b) + b) })))), cbrt(atan(y)))))
}

hamiltonian! {
    pub struct E44 { a, b, c }
    H(x, y; px, py; t) = ln((((max(min(((px - atan(5))*b), (if !(min(pi, (if (t < py) || ((-1) <= 5) { y } else { 5 })) <= c) { tan(atan(2)) } else { (asinh(((y + tan(atan(2))) - a))^2) })), ((erf((c + t))*cos(px)) - (if (sin((a*py)) < c) { (asinh(((-1)*x))/abs((pow(((atan2(2, x)^2) + 2), atan((-1))) + (1/10)))) } else { y })))^2)^2) + 1))
}

hamiltonian! {
    pub struct E45 { a, b, c }
    H(x, y; px, py; t) = ((((((px/((c^2) + (1/4))) - c) + max((px*1), ((py/abs(px))*(if (pi <= t) { t } else { py }))))/(px/((floor((acosh((abs(px) + 1)) + (3/10)))^2) + 1)))^4) + cosh((remainder((asin(tanh((1/3))) + (3/10)), (abs((erf(atanh((min((981/100), c)/(1 + (min((981/100), c)^2)))))*(x/x)))^(-4/3)))^2)))
}

hamiltonian! {
    pub struct E46 { a, b, c }
    H(x, y; px, py; t) = ((((y*c)*(py - (1/10)))/((px*a)*hypot(pi, 2)))/((abs(y)^2) + ((981/100)^2)))
}

hamiltonian! {
    pub struct E47 { a, b, c }
    H(x, y; px, py; t) = ((erfc((a - (((t^3)*a)*(-t))))^-3)*(if (tanh((((c^2) + (1^2))^(3/10))) < px) && ((((1/2) + py)^2) < c) { x } else { (pi*pi) }))
}

hamiltonian! {
    pub struct E48 { a, b, c }
    H(x, y; px, py; t) = ((atanh(tanh((((if ((px*(a/px)) < pi) && ((px/pi) <= px) { t } else { exp_m1((px/((py^2) + (1/4)))) }) - pi)/abs(a))))*exp_m1(sin(((((-(t/cosh(px)))/t) - ((if (px < 5) && (c <= a) { ((px - (a*((-(t/cosh(px)))/t)))/((((py + t) + a)^2) + 1)) } else { (py*b) })*(atan2(c, ((py + (3/10)) % abs(py)))^2)))*(px + (floor((a + (3/10)))^-1)))))) + ((5 - (y*y)) + (b + (if (((1/2) + (-t)) <= y) && ((pi/t) < 5) { (x + 1) } else { (x/x) }))))
}

hamiltonian! {
    pub struct E49 { a, b, c }
    H(x, y; px, py; t) = (x/abs(sqrt(abs(px))))
}

hamiltonian! {
    pub struct E50 { a, b, c }
    H(x, y; px, py; t) = sign((atanh(sin(((x - (((b/exp(atan(px)))/y)*(t + a))) - exp(atan(px))))) - (if (((x + (3/10)) % abs(((1/10)*py))) < x) { remainder(((981/100) + (3/10)), ((y^2) + (x^2))) } else { (2 - ((pi - ((b + (3/10)) % ((c^2) + (1/4))))*2)) })))
}

hamiltonian! {
    pub struct E51 { a, b, c }
    H(x, y; px, py; t) = ((5*(((sqrt((((py + py)^2) + 1)) + (exp_m1(((if ((-7/4) < 1) { pi } else { (1/2) }) + px)) + ((((((ln(cosh(((if ((-7/4) < 1) { pi } else { (1/2) }) + px))) - py)^2) + 1)^(1/3))^2)/(((t*(c*px))^2) + (px^2)))))^4)^6)) + ((pi*c)/((if ((if (((y - c) + (1/10)) <= a) || ((((1/3) - t) - (1/3)) < pi) { (((x^2) + 1)^(1/2)) } else { c }) < x) && (y < y) { t } else { 1 })*(if (b < t) { (-x) } else { c }))))
}

hamiltonian! {
    pub struct E52 { a, b, c }
    H(x, y; px, py; t) = max(floor(((py + (py/(((y + y)^2) + 2))) + (3/10))), sin((sin((acosh((abs((-floor((asin((y/(1 + (y^2)))) + (3/10))))) + 1)) + (b + py)))/y)))
}

hamiltonian! {
    pub struct E53 { a, b, c }
    H(x, y; px, py; t) = (((hypot(py, (px - ((c - px) + y)))^2) + 2)^(3/10))
}

hamiltonian! {
    pub struct E54 { a, b, c }
    H(x, y; px, py; t) = ((py + (if ((t - t) < py) || (t <= t) { c } else { sign(py) })) + tanh(((abs((5/5))^(-4/3)) - ((((((x/((y^2) + (1/4))) + b)^2) + 1)^(-4/3)) - ((pi/x)^3)))))
}

hamiltonian! {
    pub struct E55 { a, b, c }
    H(x, y; px, py; t) = ((if (x <= pi) && ((if (((-1) - a) == a) || ((if (t <= 5) { px } else { x }) < (1/10)) { pi } else { t }) <= px) { pi } else { (x*x) })*((((-a) - acos((a/(1 + (a^2))))) - y)*py))
}

hamiltonian! {
    pub struct E56 { a, b, c }
    H(x, y; px, py; t) = min(erfc((atan2(x, (2 - px))*((a + pi)/y))), b)
}

hamiltonian! {
    pub struct E57 { a, b, c }
    H(x, y; px, py; t) = ((tan(sin(py))*((py - px) - py)) + ((y - t) - floor((sin((atan2((y - t), (b*y))*exp_m1((if (y <= 1) { t } else { (y - t) })))) + (3/10)))))
}

hamiltonian! {
    pub struct E58 { a, b, c }
    H(x, y; px, py; t) = ((b + ((-7/4)*c)) + ln(abs(((981/100) - ((if ((y*(((a^2) + 2)^(-4/3))) < t) { (abs(b)^(-4/3)) } else { (x/py) })/((t^2) + 2))))))
}

hamiltonian! {
    pub struct E59 { a, b, c }
    H(x, y; px, py; t) = (erfc(acosh((((((abs((((x*t) - (1/3))/((1^2) + 2)))^(-3/2))*(abs((((a + (3/10)) % pi)*(cbrt(px) - floor(((atanh(cos(b))*ln(((pi^2) + ((981/100)^2)))) + (3/10))))))^(-3/2)))^2) + 2) + 1)))^7)
}

hamiltonian! {
    pub struct E60 { a, b, c }
    H(x, y; px, py; t) = (pow((((if (((px - a) - 3) < py) { (py + ((((abs(c)^-2)^2) + (py^2))^(1/3))) } else { a })^2) + 2), sin((if ((if ((py/t) < py) { c } else { (py*py) }) < py) || (((px*t)^7) <= (-7/4)) { 3 } else { ((1/10) + py) }))) + (-(b*(if ((a - (b - y)) <= a) || (pi < b) { c } else { (((abs((x*b))^(-4/3)) - ((b + (3/10)) % (-1))) - sign(a)) }))))
}

hamiltonian! {
    pub struct E61 { a, b, c }
    H(x, y; px, py; t) = ((b + (b*a)) - ((x/((((cos(py) - c)*py)^2) + 2))*tan(a)))
}

hamiltonian! {
    pub struct E62 { a, b, c }
    H(x, y; px, py; t) = (((c + y) - py) + (-abs((((c + y)*pi)*(((981/100)*pi) - ((c + y) - py))))))
}

hamiltonian! {
    pub struct E63 { a, b, c }
    H(x, y; px, py; t) = (exp(sin(((if (((2*2)*py) <= t) { (((min(px, t)^2) + 2)^(3/2)) } else { b }) + py))) + sinh(sin(((x*(y*y)) - (if !(c < x) { t } else { x })))))
}

hamiltonian! {
    pub struct E64 { a, b, c }
    H(x, y; px, py; t) = (ln(abs(((px^2)^2))) + (((abs(x)^(-4/3))*py) + (pi*((((x^3)^2) + (1/4))^(-4/3)))))
}

hamiltonian! {
    pub struct E65 { a, b, c }
    H(x, y; px, py; t) = (if (ln_1p(exp(t)) < px) { (((((py - ((px + c)/((c^2) + 1)))*px)*((a*(y - exp(t)))*px))^2)*py) } else { ((((((((atan2(b, x)^2) + (t^2))^(13/4)) - exp_m1(sin(((((((py - ((px + c)/((c^2) + 1)))*px)*((a*(y - exp(t)))*px))^2)*py)/hypot(py, x)))))^2) + (1/4))^-1)/(((erfc(((((-asin(((((y^2)*remainder((x + (3/10)), abs(py)))*floor((py + (3/10))))/(1 + ((((y^2)*remainder((x + (3/10)), abs(py)))*floor((py + (3/10))))^2)))))^2) + 1)^(-3/2)))^6)^2) + 1)) })
}

hamiltonian! {
    pub struct E66 { a, b, c }
    H(x, y; px, py; t) = ((if !(c <= (1/2)) { erfc(erf((round((b + (3/10))) + (if !(((981/100)*(-7/4)) < py) { pi } else { b })))) } else { (c*(b*(b + (3/10)))) }) + ((b + (b + b)) + (if ((((981/100) - y)/(1/10)) == a) { (round((b + (3/10)))/cosh(c)) } else { (981/100) })))
}

hamiltonian! {
    pub struct E67 { a, b, c }
    H(x, y; px, py; t) = (((5/2) + (y - y)) + atanh(cos(((pi - (2 - 5)) - (px + y)))))
}

hamiltonian! {
    pub struct E68 { a, b, c }
    H(x, y; px, py; t) = (if ((-y) < c) && (3 <= px) { (if (a == y) && ((tanh(px)/b) < y) { (y^6) } else { (y^6) }) } else { ((1/3)/acosh((abs((tanh(px)/b)) + 1))) })
}

hamiltonian! {
    pub struct E69 { a, b, c }
    H(x, y; px, py; t) = (asin((sqrt(((sinh(((cosh(cos(((((((if ((b*py) <= b) || ((b/cosh(cos(px))) < b) { a } else { b }) + c) + sqrt(abs(((erf(((((t*(pi^6))^2) + ((-1)^2))^(-3/2)))*ln_1p(abs((if (((py - py)/(-7/4)) <= py) { 1 } else { (981/100) })))) - py))))^2) + 2)^-2)))^(-3/2)) - (((c*b)*c)*(2*(5 + px)))))^2) + (py^2)))/(1 + (sqrt(((sinh(((cosh(cos(((((((if ((b*py) <= b) || ((b/cosh(cos(px))) < b) { a } else { b }) + c) + sqrt(abs(((erf(((((t*(pi^6))^2) + ((-1)^2))^(-3/2)))*ln_1p(abs((if (((py - py)/(-7/4)) <= py) { 1 } else { (981/100) })))) - py))))^2) + 2)^-2)))^(-3/2)) - (((c*b)*c)*(2*(5 + px)))))^2) + (py^2)))^2)))) + erf((x + y)))
}

hamiltonian! {
    pub struct E70 { a, b, c }
    H(x, y; px, py; t) = (c*(if ((y - px) <= px) { px } else { (exp_m1((1/3))*(abs(tan(atan(b)))^(-1/2))) }))
}

hamiltonian! {
    pub struct E71 { a, b, c }
    H(x, y; px, py; t) = cbrt(((py*atanh((((x/(if ((x*x) < y) || (y < a) { py } else { py }))^-2)/(1 + (((x/(if ((x*x) < y) || (y < a) { py } else { py }))^-2)^2))))) - py))
}

hamiltonian! {
    pub struct E72 { a, b, c }
    H(x, y; px, py; t) = (((abs(((1/10) - ((px*c)^4)))^(-7/5))/abs(atan2(sin(((px + b)*(-(if !(cos((((1/10) - ((px*c)^4))*px)) <= (981/100)) { ((b + (-1)) + b) } else { 2 })))), (-((b/((1/10) - ((px*c)^4))) + t))))) + (y - (y/abs((if !((c - y) < (-7/4)) { pi } else { (1/3) })))))
}

hamiltonian! {
    pub struct E73 { a, b, c }
    H(x, y; px, py; t) = ln(abs((abs((if (y < c) { x } else { (((asinh((((py^2) + (1/4))^(1/2)))^2) + (1/4))^(2/3)) }))^(1/2))))
}

hamiltonian! {
    pub struct E74 { a, b, c }
    H(x, y; px, py; t) = (acos(((if (round((t + (3/10))) <= 1) || ((3 - y) <= t) { (if (a <= x) && (erfc(b) <= b) { ((a/abs(b)) - c) } else { (x/exp(py)) }) } else { ln_1p(((pow(exp(cos((abs((py/(abs(remainder((floor((a + (3/10))) + (3/10)), (((py*b)^2) + (b^2))))^(1/2))))^(-4/3)))), ((cos(((py + 2)/abs((px/b))))*((px - py)/(py*py)))^2))^2) + 2)) })/(1 + ((if (round((t + (3/10))) <= 1) || ((3 - y) <= t) { (if (a <= x) && (erfc(b) <= b) { ((a/abs(b)) - c) } else { (x/exp(py)) }) } else { ln_1p(((pow(exp(cos((abs((py/(abs(remainder((floor((a + (3/10))) + (3/10)), (((py*b)^2) + (b^2))))^(1/2))))^(-4/3)))), ((cos(((py + 2)/abs((px/b))))*((px - py)/(py*py)))^2))^2) + 2)) })^2))))*(py - ((px/b) + 5)))
}

hamiltonian! {
    pub struct E75 { a, b, c }
    H(x, y; px, py; t) = (acos(tanh((py*((((px/(px + (px + 1)))^(5/2))*(erf((-1))/((abs(py)^2) + (px^2)))) + ((1/2)*((abs(py)^2) + (px^2))))))) + (ln(((((3^7)*5)^2) + 2)) + sin(((1/2)*((if !(abs((abs((-1))^(-1/2))) < y) { y } else { y }) + x)))))
}

hamiltonian! {
    pub struct E76 { a, b, c }
    H(x, y; px, py; t) = ((t*(cosh(y)^(-7/5)))/px)
}

hamiltonian! {
    pub struct E77 { a, b, c }
    H(x, y; px, py; t) = (pow(((t^2) + 2), x)*py)
}

hamiltonian! {
    pub struct E78 { a, b, c }
    H(x, y; px, py; t) = (min(((px*py) - pi), atan(min(((py^-3)^7), (1/3)))) + (((-7/4) + b)*(cbrt((-7/4)) + (if !((y^7) < b) { a } else { y }))))
}

hamiltonian! {
    pub struct E79 { a, b, c }
    H(x, y; px, py; t) = (round(((py*x) + (3/10)))*(py - (c/b)))
}

hamiltonian! {
    pub struct E80 { a, b, c }
    H(x, y; px, py; t) = (-((round(((asin(((if !(((x + (3/10)) % (abs(a)^(5/2))) <= x) { (t^3) } else { t })/(1 + ((if !(((x + (3/10)) % (abs(a)^(5/2))) <= x) { (t^3) } else { t })^2)))) - (-(3/10))) + (3/10)))*px)*(x - 2)))
}

hamiltonian! {
    pub struct E81 { a, b, c }
    H(x, y; px, py; t) = ((px*(((b + px)*t) + asinh((981/100)))) + ((((if (tan(y) <= y) { b } else { x })*(-7/4))*(b^2))*(a/((x^2) + 1))))
}

hamiltonian! {
    pub struct E82 { a, b, c }
    H(x, y; px, py; t) = (((if ((atan(y)/cosh(2)) < a) { round((min(x, atan(y)) + (3/10))) } else { ((981/100)*(t - (if !(((y*pi)^-1) < y) { x } else { y }))) }) - (tanh((-((-py)*(((x^2) + 2)^-2)))) + atan(c))) + ((c/pi) - (a - c)))
}

hamiltonian! {
    pub struct E83 { a, b, c }
    H(x, y; px, py; t) = (erf((abs((if ((px + (y*c)) == px) || (((2 + px)^6) <= 1) { (b*(c*b)) } else { px })) + (x/cosh(cos(b)))))^3)
}

hamiltonian! {
    pub struct E84 { a, b, c }
    H(x, y; px, py; t) = (((t/abs(py)) - (c*((if (acos(sin((b - py))) == (-1)) || ((py*py) == (-1)) { pi } else { t }) - px))) + ((t*t)*atan((x*2))))
}

hamiltonian! {
    pub struct E85 { a, b, c }
    H(x, y; px, py; t) = (((((py - 3) + y)/(tanh((y + (((y + y)*t)*c))) + px))/(if ((3/a) <= px) || (c <= a) { (a/((c^2) + 2)) } else { px })) + asin(sin(((if ((1/10) <= b) { t } else { (((y^2) + 1)^(3/10)) })*((-y)^(-7/5))))))
}

hamiltonian! {
    pub struct E86 { a, b, c }
    H(x, y; px, py; t) = (((-(-7/4))/(((if ((2 + (c*(-(-7/4)))) < 2) || (b < t) { x } else { min(erf(5), t) })^2) + 2)) - (px*(if ((2 + (c*(-(-7/4)))) < 2) || (b < t) { x } else { min(erf(5), t) })))
}

hamiltonian! {
    pub struct E87 { a, b, c }
    H(x, y; px, py; t) = ((if ((b - (1/2)) < c) || ((t/t) < b) { (b/(if (sinh(cos(py)) <= py) || (t < pi) { b } else { (1/10) })) } else { (((t*py)*((py*(981/100)) - (py + (px*pi)))) + 5) }) + (if !((b + (if (a <= x) && (hypot(pi, 1) == x) { y } else { t })) <= t) { (cosh(sin((((t + (if ((981/100) < pi) || ((hypot(pi, 1) + ((981/100)*y)) < t) { b } else { pi }))*((x - max((abs((a + y))^7), asinh(a)))*(a + (if (erfc(t) < x) && ((1/2) <= x) { y } else { x })))) - (-exp_m1(cos(min(1, remainder((a + (3/10)), exp(x)))))))))^(3/10)) } else { cbrt(c) }))
}

hamiltonian! {
    pub struct E88 { a, b, c }
    H(x, y; px, py; t) = exp(cos(exp(sin((-(cbrt((y + cbrt((asin(((((px + (3/10)) % x) - (px + (3/10)))/(1 + ((((px + (3/10)) % x) - (px + (3/10)))^2))))*c)))) + ln_1p((((if ((if ((py + pi) <= t) || (c < ((px + (3/10)) % x)) { py } else { px }) <= pi) { (y*b) } else { y })^2) + 2))))))))
}

hamiltonian! {
    pub struct E89 { a, b, c }
    H(x, y; px, py; t) = acos(tanh((((x*3) + t) + (((x*3)*py) + (1/10)))))
}

hamiltonian! {
    pub struct E90 { a, b, c }
    H(x, y; px, py; t) = ((-((-(if ((sign(px) - c) < b) && (px < py) { a } else { c }))*abs(((hypot(c, c) + (min((((a^2) + 2)^(-3/2)), a) + min((1/10), px)))*(if ((atan2(py, b) - c) <= a) || (py <= t) { floor((tan(sin((1/2))) + (3/10))) } else { (a/((erfc((if ((c^3) <= min((((a^2) + 2)^(-3/2)), a)) { b } else { c })) + a) - a)) }))))) + (a + (-((a + (y + t)) - y))))
}

hamiltonian! {
    pub struct E91 { a, b, c }
    H(x, y; px, py; t) = ((((t - t)*py)^2) - (-((((-1)^2)/max((b - (if ((((b^2) + (1/4))^(-1/2)) <= y) || (px <= ((b^2) + (1/4))) { b } else { y })), (abs(pi)^(3/10)))) + (abs((((if (abs(pi) < b) { c } else { b }) - ((((px^2) + 1)^(13/4))^-1))^2))^(3/2)))))
}

hamiltonian! {
    pub struct E92 { a, b, c }
    H(x, y; px, py; t) = ((((round(((((if (py <= py) && ((abs((pi - x))^(3/2)) < py) { px } else { pi })/((tan(cos(c))^2) + 2))*round((a + (3/10)))) + (3/10))) + c)^2) + (t^2))^-2)
}

hamiltonian! {
    pub struct E93 { a, b, c }
    H(x, y; px, py; t) = (sinh(sin((if (c < t) { ((c/pi) - a) } else { px }))) + (((((cos(tanh((if ((a - 2) < y) { 3 } else { ((acos(sin((pi*asin(cos(a))))) + 1) + tan(y)) })))*b)^2) + 1)^(-3/2))*tanh((-((((((x^2) + (1/4))^(13/4))^4)*asin(cos(a)))*max(x, (c/(remainder((y + (3/10)), (1/2))/(((981/100)^2) + (1/4))))))))))
}

hamiltonian! {
    pub struct E94 { a, b, c }
    H(x, y; px, py; t) = (remainder(((if !(c <= x) { min(px, asin((t/(1 + (t^2))))) } else { min(py, abs((((t^2) + 1)^-3))) }) + (3/10)), (((c/py)^2) + 1)) + x)
}

hamiltonian! {
    pub struct E95 { a, b, c }
    H(x, y; px, py; t) = ((tan(atan(cbrt(((3 + b)*(a/cosh((((px - (a + px)) + c) + c)))))))/((max(x, ((x - (if (tan(cos((px/((a^2) + 1)))) < a) { x } else { t }))*((((1/2)^2) + (x^2))^-2)))^2) + (1/4)))^6)
}

hamiltonian! {
    pub struct E96 { a, b, c }
    H(x, y; px, py; t) = (((b*py) + (b*py)) + (3*hypot(x, pi)))
}

hamiltonian! {
    pub struct E97 { a, b, c }
    H(x, y; px, py; t) = round(((sin(sqrt(abs((if ((b*px) < x) && ((t*py) < y) { (-1) } else { (a*5) }))))/((pow(abs(b), ((pi/acos(tanh(c)))*a))^2) + (px^2))) + (3/10)))
}

hamiltonian! {
    pub struct E98 { a, b, c }
    H(x, y; px, py; t) = (if (pi <= px) && (sqrt((((((y^2) + 2)^(-4/3))^2) + (1/4))) == x) { ((-7/4) + t) } else { (y + a) })
}

hamiltonian! {
    pub struct E99 { a, b, c }
    H(x, y; px, py; t) = ((cbrt(((ln_1p((((((py*(b + px)) + (3/10)) % py)^2) + (px^2)))^7)/(((((((1/10)^2) + 2)^(-7/5)) - 1)^2) + 1)))^2) + (-round((abs(max(((y*(y^2)) - (b + sinh(x))), (x*c))) + (3/10)))))
}

hamiltonian! {
    pub struct E100 { a, b, c }
    H(x, y; px, py; t) = ((-acos(((((y + y) + y) + px)/(1 + ((((y + y) + y) + px)^2))))) - ((-1) + c))
}

hamiltonian! {
    pub struct E101 { a, b, c }
    H(x, y; px, py; t) = (((round(((abs(x)*(1/3)) + (3/10)))*((((-7/4) + hypot((1/10), px)) - sinh(atan((c + (1/10)))))*5)) - ((y*a) - ln_1p(((pi^2) + 1))))^2)
}

hamiltonian! {
    pub struct E102 { a, b, c }
    H(x, y; px, py; t) = ((((hypot(abs(atan2(px, py)), ((py^-1)*t))*(c^-2)) + (((-(if ((px - py) < c) || (px <= px) { (a^-3) } else { px })) + (px*atan2(c, px)))*py))*px) + (sinh(tanh((exp_m1(tanh(x)) - ((((if (((1/2)*c) <= (1/10)) || ((y*2) <= c) { exp_m1(tanh(x)) } else { b })^2) + 2)^(3/2))))) - ((t - y)/((y^2) + 2))))
}

hamiltonian! {
    pub struct E103 { a, b, c }
    H(x, y; px, py; t) = ((c/abs(min(ln(abs(t)), (px*(c - y)))))*round(((px/(((-1) + a)*cbrt(x))) + (3/10))))
}

hamiltonian! {
    pub struct E104 { a, b, c }
    H(x, y; px, py; t) = (if !(t < py) { ln_1p(abs((((pi^2) + atan2(x, (-1))) - b))) } else { (ln_1p(abs((((pi^2) + atan2(x, (-1))) - b)))*y) })
}

hamiltonian! {
    pub struct E105 { a, b, c }
    H(x, y; px, py; t) = (atan2((a*((py/b)*py)), atan(a)) + (-((y/c) + (a*y))))
}

hamiltonian! {
    pub struct E106 { a, b, c }
    H(x, y; px, py; t) = cbrt((x + atan2(c, py)))
}

hamiltonian! {
    pub struct E107 { a, b, c }
    H(x, y; px, py; t) = ((a - px) + (((if (c <= px) && (((y + (3/10)) % abs(c)) == px) { erf((pi*px)) } else { hypot(x, b) }) + (3/10)) % (-7/4)))
}

hamiltonian! {
    pub struct E108 { a, b, c }
    H(x, y; px, py; t) = ((-(b + ((((if !(c <= c) { px } else { py })^4) - (erf(py)*erfc((atanh(cos(((if !(c <= c) { px } else { py })/(abs(((1/2)/(1/2)))^(-1/2)))))^2))))^(1/2)))) + (if (x < x) { (((if ((-(x + y)) <= 2) { b } else { (y - (1/10)) })/(((sign(y)^2) + 1)^(3/2)))^-1) } else { (x + (((sign(y)^2) + 1)^(3/2))) }))
}

hamiltonian! {
    pub struct E109 { a, b, c }
    H(x, y; px, py; t) = (atan((py + (if (b <= t) { acos((t/(1 + (t^2)))) } else { (1/2) })))*tan(cos((1/x))))
}

hamiltonian! {
    pub struct E110 { a, b, c }
    H(x, y; px, py; t) = (if (1 == py) || (cos(py) <= t) { (abs((c + (pi*px)))^(3/2)) } else { (x + px) })
}

hamiltonian! {
    pub struct E111 { a, b, c }
    H(x, y; px, py; t) = (atan((if (t < py) && ((b + py) <= c) { (exp_m1(t)*t) } else { (if (py < py) && ((py*b) == px) { ((((pi - (if ((py + 2) <= 2) { (py + 2) } else { px })) + (pi - (if ((py + 2) <= 2) { (py + 2) } else { px }))) + (3/10)) % (cosh(atan(sign((if (a <= b) || ((c/cosh(tanh((px/((py^2) + 1))))) < cosh(tanh((px/((py^2) + 1))))) { (exp_m1(cos((px + b))) + (py*cosh(cos(px)))) } else { (abs((py + py))^(3/10)) }))))^(1/3))) } else { (((981/100) + b) + py) }) })) + sin(((if ((max(x, x)*b) <= y) { (y^2) } else { x })/(-t))))
}

hamiltonian! {
    pub struct E112 { a, b, c }
    H(x, y; px, py; t) = atanh(cos(((if ((px + b) < px) { acosh((exp(pi) + 1)) } else { a })*((c + y)*(-1)))))
}

hamiltonian! {
    pub struct E113 { a, b, c }
    H(x, y; px, py; t) = (a + (x/cosh(atan((((py + (3/10)) % c) - t)))))
}

hamiltonian! {
    pub struct E114 { a, b, c }
    H(x, y; px, py; t) = (((py + pi)/pi) + (floor(((1/3) + (3/10)))*2))
}

hamiltonian! {
    pub struct E115 { a, b, c }
    H(x, y; px, py; t) = (x*asinh((exp(cos(px))*(((a/px)*2)*y))))
}

hamiltonian! {
    pub struct E116 { a, b, c }
    H(x, y; px, py; t) = (((((y + ((a + (3/10)) % (py + py)))*py)^2) + 1)^(13/4))
}

hamiltonian! {
    pub struct E117 { a, b, c }
    H(x, y; px, py; t) = ((px + (t + pi)) + (b/(((-b)^2) + 1)))
}

hamiltonian! {
    pub struct E118 { a, b, c }
    H(x, y; px, py; t) = ((py + (1/3))*min((((-1) + py) + y), (x - (1/3))))
}

hamiltonian! {
    pub struct E119 { a, b, c }
    H(x, y; px, py; t) = ((((t*(t*y)) + (3/10)) % abs((hypot(y, px)/((y^2) + 2))))*(((y^2)/5)/(abs((if ((y/((x^2) + 2)) < b) { c } else { px }))^(3/2))))
}

hamiltonian! {
    pub struct E120 { a, b, c }
    H(x, y; px, py; t) = ((asinh(py) + c) + (((t/((y^2) + (t^2)))^2)*(1/10)))
}

hamiltonian! {
    pub struct E121 { a, b, c }
    H(x, y; px, py; t) = (abs(((if ((b - x) == 5) && (b < c) { max((((1 + 1) + y)^2), (pi - (y + x))) } else { py }) + x))^(1/3))
}

hamiltonian! {
    pub struct E122 { a, b, c }
    H(x, y; px, py; t) = (((acos(((x*a)/(1 + ((x*a)^2))))*tan(atan((5 - px)))) + (y + a))^-2)
}

hamiltonian! {
    pub struct E123 { a, b, c }
    H(x, y; px, py; t) = ((asin(cos(px))*b) + ((-(x + tanh(a))) + ln_1p(x)))
}

hamiltonian! {
    pub struct E124 { a, b, c }
    H(x, y; px, py; t) = ((((erfc((y*y))^2) + 2)^(1/2))/(((if ((if (((t^4)*(1/10)) <= px) { 5 } else { b }) == x) || ((2*(1/10)) == 3) { px } else { py }) + (x - ((y*t) + y)))^3))
}

hamiltonian! {
    pub struct E125 { a, b, c }
    H(x, y; px, py; t) = sinh(atan(((((((((ln_1p(((((-7/4) + (a^3))^2) + (1/4))) + c)^(3/10))^2)*(b - y)) - (c + py))^2) + (1/4))^-2)))
}

hamiltonian! {
    pub struct E126 { a, b, c }
    H(x, y; px, py; t) = ((atanh(sin(cosh(tanh((abs((py + b))*exp(tanh(a)))))))*((if ((exp(atan(py))^-1) <= (-1)) { py } else { a }) + (-7/4))) + sin((x - ((x - 3)/(-7/4)))))
}

hamiltonian! {
    pub struct E127 { a, b, c }
    H(x, y; px, py; t) = sin(erfc((((if ((x*(c/((y^2) + (a^2)))) < x) { a } else { x }) + (y*((981/100)/px)))*(exp_m1(sin(exp_m1(cos((((-7/4)*acos((py/(1 + (py^2)))))*(a + (981/100))))))) - (ln(((pi^2) + 2)) + (py + b))))))
}

hamiltonian! {
    pub struct E128 { a, b, c }
    H(x, y; px, py; t) = (erf((3*x))/abs(sinh(atan(atan((if (round((round(((1/10) + (3/10))) + (3/10))) <= (981/100)) && (remainder((((3/10) - c) + (3/10)), pi) <= y) { py } else { (x + (erf((3*x)) - b)) }))))))
}

hamiltonian! {
    pub struct E129 { a, b, c }
    H(x, y; px, py; t) = ((-(py + ((((px + pi) + py)*(if !((py - 5) < py) { py } else { (py + atanh((px/(1 + (px^2))))) }))^7))) + min(y, (((abs(t)^-1)*y) + ((abs(t)^-1)*y))))
}

hamiltonian! {
    pub struct E130 { a, b, c }
    H(x, y; px, py; t) = (((round((((((if (sin((1/2)) <= 3) || ((if ((2 - b) <= py) || ((pi + (c - 3)) < b) { y } else { py }) < y) { a } else { a })^2) + 1)^(-4/3)) + (3/10)))/((x^2) + (1/4)))*px)*(if ((b*cos(b)) <= (3/10)) || (((1/2) - b) <= x) { (px - t) } else { 1 }))
}

hamiltonian! {
    pub struct E131 { a, b, c }
    H(x, y; px, py; t) = (-atan2((pi + remainder((x + (3/10)), abs(py))), (((a^2) + (px - y)) - (if (y <= py) && (((b^2) - b) <= py) { (b - (-7/4)) } else { b }))))
}

hamiltonian! {
    pub struct E132 { a, b, c }
    H(x, y; px, py; t) = (atan2((((px^2) + 1)^-3), (ln(abs(px)) + erf(px))) + (t*exp(t)))
}

hamiltonian! {
    pub struct E133 { a, b, c }
    H(x, y; px, py; t) = ((a - t)*sinh(((if !(sign(b) <= py) { 2 } else { erfc(((c*px) - ((px^2)/abs(sign(b))))) }) + y)))
}

hamiltonian! {
    pub struct E134 { a, b, c }
    H(x, y; px, py; t) = (((((if !(y <= c) { ((atan2((t/1), (1/2)) + (a - x))*(1/3)) } else { a })*(ln(((py^2) + (1/4))) - acosh((exp(cos(max((((y^2) + (x^2))^(-1/2)), (y*b)))) + 1))))^2) + (1/4))^(1/2))
}

hamiltonian! {
    pub struct E135 { a, b, c }
    H(x, y; px, py; t) = ((sqrt((((-((if (py <= b) || (((b + py) - py) <= c) { b } else { b }) - py))^2) + ((-7/4)^2)))*(pi + (981/100))) + (x*cbrt((sign(((((-atan((y + pi)))^2) + 2)^(-4/3))) + (c + t)))))
}

hamiltonian! {
    pub struct E136 { a, b, c }
    H(x, y; px, py; t) = ((((if ((y^-3) <= b) || ((c^2) < 5) { (1/2) } else { cbrt((px*c)) }) + (3/10)) % (((exp(tanh(((b - a) - c)))^(3/10))^2) + 2))*(c^2))
}

hamiltonian! {
    pub struct E137 { a, b, c }
    H(x, y; px, py; t) = (((((abs(((y*(-1))^-1))^(-3/2)) + (erfc(py)*abs(((((py^2) + (px^2))^-3)/px))))^2) + (py^2))^(-1/2))
}

hamiltonian! {
    pub struct E138 { a, b, c }
    H(x, y; px, py; t) = ((if ((-(px + px)) <= t) { ((t - (3*tan(b))) - (b - py)) } else { 3 }) + ((((if ((((y^2) + 2)^(-3/2)) < b) && (ln_1p(cosh((b + pow(abs((pi + ((c - x)^-1))), sin(1))))) < (1/2)) { (x - (a - a)) } else { pow(abs((pi + ((c - x)^-1))), sin(1)) })^2) + (a^2))^(-1/2)))
}

hamiltonian! {
    pub struct E139 { a, b, c }
    H(x, y; px, py; t) = (max(acosh((abs((py - (b*(b + t)))) + 1)), b)/y)
}

hamiltonian! {
    pub struct E140 { a, b, c }
    H(x, y; px, py; t) = (py + (y*(((1/10) + (py/(a - x)))/(((a/x)^2) + 1))))
}

hamiltonian! {
    pub struct E141 { a, b, c }
    H(x, y; px, py; t) = (acos(sin(((round((a + (3/10))) - exp_m1(a))/abs(tan(sin((a + (exp_m1(a) + (b - py))))))))) + (y + (-(y + (1/10)))))
}

hamiltonian! {
    pub struct E142 { a, b, c }
    H(x, y; px, py; t) = sin(((px - ((((x^2) + 2)^(1/3)) - ((x^2) + 2))) - ((-(1^5))^-3)))
}

hamiltonian! {
    pub struct E143 { a, b, c }
    H(x, y; px, py; t) = (abs((px/((((sin(((t*px) + floor((max(y, px) + (3/10)))))/abs(py)) - (t - y))^2) + (a^2))))^(-7/5))
}

hamiltonian! {
    pub struct E144 { a, b, c }
    H(x, y; px, py; t) = (exp(tanh((asinh((b/(((py^5) + (3/10)) % hypot(a, (px + (981/100))))))*asinh((b/(((py^5) + (3/10)) % hypot(a, (px + (981/100))))))))) + ((1/3) - ((1/3) - (x - (1/3)))))
}

hamiltonian! {
    pub struct E145 { a, b, c }
    H(x, y; px, py; t) = ((py + ((((py - (x + (b*(x^4))))^2) + 1)^-3))*((pi*y)*b))
}

hamiltonian! {
    pub struct E146 { a, b, c }
    H(x, y; px, py; t) = floor(((((min(py, (if ((if (cosh(sin(sqrt(((x^2) + (1/4))))) <= x) { (y + c) } else { t }) == x) || ((((1/10)*(-7/4)) + t) <= (1/10)) { b } else { ((x*py)*(1/4)) }))^2) + (1/4))^(-1/2)) + (3/10)))
}

hamiltonian! {
    pub struct E147 { a, b, c }
    H(x, y; px, py; t) = (min(floor(((((exp((px*px)) + (3/10)) % px)*(py*5)) + (3/10))), b) + tanh(((x/((((x*(y - (((x^2) + 1)^(-4/3))))*(1/2))^2) + (y^2))) + (y + (1/2)))))
}

hamiltonian! {
    pub struct E148 { a, b, c }
    H(x, y; px, py; t) = sqrt(exp((erfc(((if (atan(pi) < y) { x } else { (cos(px) + (-1)) })^7))*(-((((px^7)^2) + 1)^(1/2))))))
}

hamiltonian! {
    pub struct E149 { a, b, c }
    H(x, y; px, py; t) = max((if (x < x) { floor(((((pi - b) - t) + (b*(2 + py))) + (3/10))) } else { (981/100) }), b)
}

hamiltonian! {
    pub struct E150 { a, b, c }
    H(x, y; px, py; t) = (((py + py)*(py + b)) + (pi*(((pi*(x/x)) + atan2(erf((a*c)), (((-1) + b)^3)))^6)))
}

hamiltonian! {
    pub struct E151 { a, b, c }
    H(x, y; px, py; t) = (acos((((-py)*(b^2))/(1 + (((-py)*(b^2))^2))))*acos((cos(exp_m1(y))/(1 + (cos(exp_m1(y))^2)))))
}

hamiltonian! {
    pub struct E152 { a, b, c }
    H(x, y; px, py; t) = ((a + (((sinh(((pi*a) + sign(py))) + (((x - (981/100))*(px - py))^-1))*(((pi*a)*py) - b))/px))^2)
}

hamiltonian! {
    pub struct E153 { a, b, c }
    H(x, y; px, py; t) = (((((if ((-7/4) < py) && (px < py) { py } else { t })^2) + 2)^(1/3)) + round((((-((if (atan2((abs(b)^(1/3)), abs(b)) == a) || (atanh(cos((3 - x))) < y) { t } else { ((-1)*t) })/(a*x))) - (((x - (x + c)) + (3/10)) % exp(t))) + (3/10))))
}

hamiltonian! {
    pub struct E154 { a, b, c }
    H(x, y; px, py; t) = (if !(atanh(tanh(px)) < 1) { tanh(px) } else { max((if (((3 + c) - py) < py) { (b - (if (c < y) || ((px - x) < x) { 1 } else { tanh(px) })) } else { b }), (ln_1p((a - (if (px <= c) && (a < px) { x } else { a })))^2)) })
}

hamiltonian! {
    pub struct E155 { a, b, c }
    H(x, y; px, py; t) = (exp(((py/a)*x)) + ((((b*(if (floor(((b*py) + (3/10))) <= 2) { c } else { (981/100) }))^2) + 1)^(1/3)))
}

hamiltonian! {
    pub struct E156 { a, b, c }
    H(x, y; px, py; t) = ((remainder((((5*pi)*t) + (3/10)), cosh(atan2(pi, py)))*py) + ln((((((if ((1/3) < x) && (((c^-3)*b) < 3) { (-x) } else { pi }) + y) + round((((if ((1/3) < x) && (((c^-3)*b) < 3) { (-x) } else { pi })*(-x)) + (3/10))))^2) + (1/4))))
}

hamiltonian! {
    pub struct E157 { a, b, c }
    H(x, y; px, py; t) = ((((acos(((((-1) + b) + (abs(asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2)))))^(-1/2)))/(1 + ((((-1) + b) + (abs(asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2)))))^(-1/2)))^2))))^2) + 1)^(-1/2))/((acos((((acos((asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2))))/(1 + (asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2))))^2))))*((((((if ((((acos(((((-1) + b) + (abs(asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2)))))^(-1/2)))/(1 + ((((-1) + b) + (abs(asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2)))))^(-1/2)))^2))))^2) + 1)*(px + y)) < 5) { c } else { a })^2) + (1/4))^(1/2))/((pi^2) + 1)) + t))^6)/(1 + (((acos((asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2))))/(1 + (asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2))))^2))))*((((((if ((((acos(((((-1) + b) + (abs(asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2)))))^(-1/2)))/(1 + ((((-1) + b) + (abs(asin((((a*max(c, a))^2)/(1 + (((a*max(c, a))^2)^2)))))^(-1/2)))^2))))^2) + 1)*(px + y)) < 5) { c } else { a })^2) + (1/4))^(1/2))/((pi^2) + 1)) + t))^6)^2))))^2) + (x^2)))
}

hamiltonian! {
    pub struct E158 { a, b, c }
    H(x, y; px, py; t) = erfc(acosh(((((cosh(cos((((((erf(b) - (ln(((b^2) + (c^2)))*y))^4) + (3/10)) % ((pi^2) + 1))/exp(tanh(px)))))^-1)^2) + 1) + 1)))
}

hamiltonian! {
    pub struct E159 { a, b, c }
    H(x, y; px, py; t) = ((t + (((cos(((acos((remainder((pi + (3/10)), abs(py))/(1 + (remainder((pi + (3/10)), abs(py))^2)))) + px) + b))^2) + 2)^-3)) + (a*(if !(c < a) { (1/2) } else { (1/2) })))
}

hamiltonian! {
    pub struct E160 { a, b, c }
    H(x, y; px, py; t) = acosh((abs((((981/100)*atan(a))/exp((-(min(y, a) - py))))) + 1))
}

hamiltonian! {
    pub struct E161 { a, b, c }
    H(x, y; px, py; t) = cos((min(((if (y <= x) || (y <= c) { y } else { py })*((2*b)^2)), (px/c))/ln_1p((((((px + py) + x)^2)^2) + (1/4)))))
}

hamiltonian! {
    pub struct E162 { a, b, c }
    H(x, y; px, py; t) = ((-(asin((max(py, pi)/(1 + (max(py, pi)^2))))/cosh(py))) + (cbrt(((((3 + exp(((1/10)^2))) + (3/10)) % y)^6))^2))
}

hamiltonian! {
    pub struct E163 { a, b, c }
    H(x, y; px, py; t) = (((((-pow((((((b/t) + b) + erfc(((981/100)*((b/t) + b))))^2) + (b^2)), (tan(tanh(abs(((1/10) - py))))*cbrt((((c + c) + (3/10)) % (py - x))))))^2) + (px^2))^(-1/2))^5)
}

hamiltonian! {
    pub struct E164 { a, b, c }
    H(x, y; px, py; t) = ((((py - px) + px)^6) - max((px + (y*(px - round((1 + (3/10)))))), 5))
}

hamiltonian! {
    pub struct E165 { a, b, c }
    H(x, y; px, py; t) = (((5^4) + (py + (py^(-4/3)))) + hypot((y + y), ((((t*t) + y) - (cosh(t)*((1/2) - 1)))*(c^4))))
}

hamiltonian! {
    pub struct E166 { a, b, c }
    H(x, y; px, py; t) = (cbrt(c)*((c + (((if (min((y + b), a) < 5) { t } else { (1/3) })*exp(cos((px*py)))) - pi))*(y - b)))
}

hamiltonian! {
    pub struct E167 { a, b, c }
    H(x, y; px, py; t) = max(((((1/3)^(3/2))/exp(((1/3)^(3/2)))) + y), ((abs(py)^(3/2))/atanh(tanh(((b^2) + a)))))
}

hamiltonian! {
    pub struct E168 { a, b, c }
    H(x, y; px, py; t) = (((if (asin((py/(1 + (py^2)))) <= (1 + (py^2))) || (py <= px) { (py - sqrt(((b^2) + 2))) } else { (erfc((c - sinh(cos((981/100)))))*(1/2)) })/(((sinh(cos((981/100))) + exp_m1((-7/4)))^2) + 2)) + asinh(hypot(asin(cos(exp_m1(atan((pow((((abs(x)^(3/10))^2) + 1), atan(1)) + pi))))), ((((sqrt(((a^2) + 1))*x) + ((x + 1)^3)) + ln_1p((((floor(((cosh((if (((-y)*y) == a) && (acosh(((((c^4)^2) + 2) + 1)) < x) { sign((a/abs(y))) } else { x }))^(13/4)) + (3/10)))^2) + (b^2))^(-7/5)))) + (asin((x/(1 + (x^2))))*((atan((pow((((abs(x)^(3/10))^2) + 1), atan(1)) + pi)) - t) + x))))))
}

hamiltonian! {
    pub struct E169 { a, b, c }
    H(x, y; px, py; t) = (abs((((px^2) + (x^2))^(-1/2)))^(3/2))
}

hamiltonian! {
    pub struct E170 { a, b, c }
    H(x, y; px, py; t) = cosh(sin((asin((((a/x)*px)/(1 + (((a/x)*px)^2)))) + cos(atan(((((a*((981/100)^2))^7) - t) + ((erf(py)^5)*sqrt(((t^2) + (t^2))))))))))
}

hamiltonian! {
    pub struct E171 { a, b, c }
    H(x, y; px, py; t) = (exp_m1(tanh(((abs((py*(3*px)))^-2) - (if (cbrt(t) <= c) || (b <= t) { tanh((px/(((1/10)^2) + 1))) } else { ((1/3) - pi) })))) + ((y*x)*(if !(t < a) { (((asin(tanh(((-(1/2)) + (1/2))))^2) + 2)^-2) } else { x })))
}

hamiltonian! {
    pub struct E172 { a, b, c }
    H(x, y; px, py; t) = cos(erf(max(px, y)))
}

hamiltonian! {
    pub struct E173 { a, b, c }
    H(x, y; px, py; t) = (((if (px == (981/100)) || (abs((b + c)) == px) { c } else { b })/x)*c)
}

hamiltonian! {
    pub struct E174 { a, b, c }
    H(x, y; px, py; t) = ((round((((a*a)/abs((sinh(sin(b)) - a))) + (3/10)))/(((((a*a)/abs((sinh(sin(b)) - a))) + py)^2) + 2)) + (-((y + y)^4)))
}

hamiltonian! {
    pub struct E175 { a, b, c }
    H(x, y; px, py; t) = ((min(x, ((((5^2) + (px^2))^-3) + (-a))) + (3/10)) % (((t*a)^2) + 2))
}

hamiltonian! {
    pub struct E176 { a, b, c }
    H(x, y; px, py; t) = (cosh((x + 1)) + (py*(((x^2) + 2)^-3)))
}

hamiltonian! {
    pub struct E177 { a, b, c }
    H(x, y; px, py; t) = (atanh(((px + ln_1p((((((if ((c*(1/2)) < 5) || (((c - 5)^4) <= b) { sign((b/pi)) } else { (t*px) }) + px) - ((py/pi)/px))^2) + (py^2))))/(1 + ((px + ln_1p((((((if ((c*(1/2)) < 5) || (((c - 5)^4) <= b) { sign((b/pi)) } else { (t*px) }) + px) - ((py/pi)/px))^2) + (py^2))))^2)))) + ln_1p(cosh((if !(cbrt(a) < t) { (a - b) } else { (if ((abs((x*a))^(-4/3)) <= x) || ((y - x) <= x) { a } else { (if ((a*1) < x) || ((abs((c*(-7/4)))^-2) <= t) { a } else { y }) }) }))))
}

hamiltonian! {
    pub struct E178 { a, b, c }
    H(x, y; px, py; t) = ((((pi*(py + (b/abs(x))))^2) + 1)^(13/4))
}

hamiltonian! {
    pub struct E179 { a, b, c }
    H(x, y; px, py; t) = atanh(sin(erfc((exp(tanh((ln(cosh((if ((5 + 5) < x) { px } else { c }))) + b)))^(-7/5)))))
}

hamiltonian! {
    pub struct E180 { a, b, c }
    H(x, y; px, py; t) = ((py - (if (px < py) || (((5*c) - c) < b) { (t/(pi/((((c*a)^3)^2) + 2))) } else { py })) + (((-(((2 - c)/(((if ((y*pi) == (1/10)) && ((if (acosh((cosh(sin(a)) + 1)) < c) && (((b + pi) - y) < x) { (x + (1/3)) } else { pi }) < x) { pi } else { atanh(sin(((y*(1/10)) + (-pi)))) })^2) + (x^2))) - (sign(((pi + pi) + (b^4))) + a)))^5) + (cos(y) + b)))
}

hamiltonian! {
    pub struct E181 { a, b, c }
    H(x, y; px, py; t) = ((floor((sin(((b*exp_m1(atan(px)))*((-px) + y))) + (3/10))) + sinh(sin(((round(((y*c) + (3/10))) + (3/10)) % (((b + ((-px) + y))^2) + (1/4)))))) - (if (1 < y) { 2 } else { ((((((((c - ((exp(atan(px))^(13/4)) - exp(atan(px))))^5)^2) + (sinh(sin(((round(((y*c) + (3/10))) + (3/10)) % (((b + ((-px) + y))^2) + (1/4)))))^2))^(-4/3))^2) + 1)^(-4/3)) }))
}

hamiltonian! {
    pub struct E182 { a, b, c }
    H(x, y; px, py; t) = (t + (b*sinh(atan(tanh(((if ((x + (a + a)) <= t) && (ln(((((1/2)/b)^2) + 1)) <= a) { atan2(y, t) } else { px })/py))))))
}

hamiltonian! {
    pub struct E183 { a, b, c }
    H(x, y; px, py; t) = (atan2(erf((if (((((-1)^2) + ((-1)^2))^-1) <= py) || ((px - t) <= px) { ((py*t) + erf(t)) } else { ((3*t)*a) })), ((acos((erf((if (max(pi, px) == py) || ((((atanh((a/(1 + (a^2))))^2) + (b^2))^-3) <= t) { px } else { py }))/(1 + (erf((if (max(pi, px) == py) || ((((atanh((a/(1 + (a^2))))^2) + (b^2))^-3) <= t) { px } else { py }))^2))))*atanh((c/(1 + (c^2))))) + (((py/px)*((remainder((py + (3/10)), b) - (981/100))*(sin(2)*px))) + (-1)))) + (ln(abs(((atan2((a*((y + c) - b)), (a - 2)) + ln_1p(abs(((5*acos(sin(((y*y) - c))))*(t + pi)))))*(((1/10) + b)/abs(sqrt((((((abs((x - atan2((a*((y + c) - b)), (a - 2))))^2) + (1/4))^(-3/2))^2) + (b^2))))))))*(((1/10)*(a + c))*x)))
}

hamiltonian! {
    pub struct E184 { a, b, c }
    H(x, y; px, py; t) = atan2((x - ((min(c, (t - (t/((y^2) + (py^2)))))^2) + x)), (tan(atan((((((t - max(t, (a/cosh(cos(c))))) - a)^2) + (1/4))^(1/3))))/exp(cos(floor(((t - (t/((y^2) + (py^2)))) + (3/10)))))))
}

hamiltonian! {
    pub struct E185 { a, b, c }
    H(x, y; px, py; t) = (if (b <= pi) { c } else { (abs((y*erf(((y - ln_1p(((c^2) + (1/4))))*((py/cosh(tanh(x))) + y)))))^-2) })
}

hamiltonian! {
    pub struct E186 { a, b, c }
    H(x, y; px, py; t) = ((((a*erf((px*tan(2))))*(sqrt((((exp(atan((erf((px*tan(2))) - sinh(atan(cos(tanh(px)))))))^(1/2))^2) + 2))*t))/(-1)) + atanh(((sqrt((((if (a <= y) { t } else { (if (b < t) { a } else { b }) })^2) + (1^2))) - ((((b*y) + c)^5) + pow(abs(t), cos((b*y)))))/(1 + ((sqrt((((if (a <= y) { t } else { (if (b < t) { a } else { b }) })^2) + (1^2))) - ((((b*y) + c)^5) + pow(abs(t), cos((b*y)))))^2)))))
}

hamiltonian! {
    pub struct E187 { a, b, c }
    H(x, y; px, py; t) = ((((erf((if (x < b) && (((if ((t*t) <= px) && (sinh(tanh(py)) == ((py/((x^2) + (1/4))) + c)) { 5 } else { c })/((px^2) + 2)) == x) { (((py/((x^2) + (1/4))) + c)^6) } else { (1/3) }))^2) + 1)^-1) - (abs(min(t, (t*((c + ((1/2) + 1)) + c)))) - (-1)))
}

hamiltonian! {
    pub struct E188 { a, b, c }
    H(x, y; px, py; t) = ((tanh(px) + remainder(((1/3) + (3/10)), asinh(1)))*(y/(if !(sign((x - b)) < x) { a } else { pi })))
}

hamiltonian! {
    pub struct E189 { a, b, c }
    H(x, y; px, py; t) = ((((1/2) + a) - round(((py + ((py^4)*px)) + (3/10)))) + erf(exp_m1(atan(((b*b)*hypot((a - a), x))))))
}

hamiltonian! {
    pub struct E190 { a, b, c }
    H(x, y; px, py; t) = ln_1p(cosh((erf((b^3)) - (((y + py)/(1/3)) - ((abs(b)*pi) - a)))))
}

hamiltonian! {
    pub struct E191 { a, b, c }
    H(x, y; px, py; t) = cosh(sqrt(((abs((abs((sign((min((1 - (py^3)), pi) + (py*1))) + sinh(sin(((min((1 - (py^3)), pi) - (c*a)) + (x*((((-x)^2) + 2)^-1)))))))^(3/10)))^2) + (c^2))))
}

hamiltonian! {
    pub struct E192 { a, b, c }
    H(x, y; px, py; t) = (((py + py)*a) + ((if ((y + pi) <= b) || ((x*(b^7)) < a) { (atan2(y, x)/exp(x)) } else { b }) + (atanh(cos((exp(cos(t)) + c))) + ((-7/4)*(abs(a)^(3/2))))))
}

hamiltonian! {
    pub struct E193 { a, b, c }
    H(x, y; px, py; t) = ((if (b < x) { max((abs(x)^(3/10)), py) } else { py })^2)
}

hamiltonian! {
    pub struct E194 { a, b, c }
    H(x, y; px, py; t) = ((y*(x*pi)) - (cos(px)*x))
}

hamiltonian! {
    pub struct E195 { a, b, c }
    H(x, y; px, py; t) = ((t*((t*px) - (cos((c*px))/((py^2) + (px^2))))) + erfc(((a^7)*min(c, x))))
}

hamiltonian! {
    pub struct E196 { a, b, c }
    H(x, y; px, py; t) = (abs((if (round(((pi - px) + (3/10))) < t) { sin(x) } else { b })) - ((((erfc(px)*exp_m1(sin(((x/((3^2) + (t^2)))^2))))^2) + (a^2))^-1))
}

hamiltonian! {
    pub struct E197 { a, b, c }
    H(x, y; px, py; t) = (((if ((if ((y/(x*x)) < a) && ((((1/10)/abs(px))*t) <= 5) { x } else { (y/(x*x)) }) < c) { c } else { y }) + (3/10)) % (abs(sin(px))^-3))
}

hamiltonian! {
    pub struct E198 { a, b, c }
    H(x, y; px, py; t) = ((if ((py^2) <= t) && ((3*((1/2)/abs(c))) <= py) { ((b - 3) - a) } else { (py + c) }) + (if !(((c^5)*b) < a) { (1/2) } else { ((pi*(2*x)) + ((x - y)*sinh(tanh((1/10))))) }))
}

hamiltonian! {
    pub struct E199 { a, b, c }
    H(x, y; px, py; t) = (cosh(((((((y - (3*(1/3)))/x)*py)*(((-(b^-3)) + py)^-1))^2) + py))^(13/4))
}

hamiltonian! {
    pub struct E200 { a, b, c }
    H(x, y; px, py; t) = ((pi + (((if !((if (remainder((b + (3/10)), t) <= 1) { (-c) } else { py }) < py) { b } else { (3/10) })/((x^2) + (1/4)))^-1)) + (sinh(sin((if (((a + t)*a) < y) { (c - px) } else { (-1) })))*max(pi, (1/10))))
}

hamiltonian! {
    pub struct E201 { a, b, c }
    H(x, y; px, py; t) = ((-pow(exp(tanh(asin(((min(1, t)*a)/(1 + ((min(1, t)*a)^2)))))), px)) + (if (exp_m1(tanh(x)) < b) || ((t*pow(2, cos(x))) < (-1)) { (((t*a) + x) + (-((y*a) + (if (cbrt(c) <= b) { y } else { (cosh(cos(x))^(5/2)) })))) } else { (cosh(atan(((y/((x^2) + 1)) + min(3, (if (sin(c) < a) && (erf(x) < (cosh(cos(x))^(5/2))) { atan2(a, a) } else { x })))))^(5/2)) }))
}

hamiltonian! {
    pub struct E202 { a, b, c }
    H(x, y; px, py; t) = sqrt(((cos(((y/cosh(cos((py + x)))) + py))^2) + 2))
}

hamiltonian! {
    pub struct E203 { a, b, c }
    H(x, y; px, py; t) = (((px*a)*x)*py)
}

hamiltonian! {
    pub struct E204 { a, b, c }
    H(x, y; px, py; t) = (pow((((((1*(1/3))^3)/(((-(py*(((1/3)*(((pi/px)/abs(((1*(1/3))^3)))/1)) - ((pi/px)^6))))^2) + 1))^2) + 1), b) + (((x + (3/10)) % abs((if !(b <= x) { (-1) } else { x }))) - (if !((x*(b*t)) <= b) { y } else { x })))
}

hamiltonian! {
    pub struct E205 { a, b, c }
    H(x, y; px, py; t) = ((a + ((erfc((pi/py)) + remainder((3 + (3/10)), b)) - pi))/(((a/(((a*((2 - b) + y))^2) + 1))/(a - (y + c)))^5))
}

hamiltonian! {
    pub struct E206 { a, b, c }
    H(x, y; px, py; t) = (x/(((atan((if !(((py/y)^4) < px) { (1/2) } else { ((((py/y)^4)/((x^2) + (px^2)))*(abs((-1))^(5/2))) }))*min(py, (x + t)))^2) + (1/4)))
}

hamiltonian! {
    pub struct E207 { a, b, c }
    H(x, y; px, py; t) = (((b - (c*atan(b))) + (acosh((abs(px) + 1))/(((a^2) + 2)^(-3/2)))) + (((b*(1/2))*c)/((exp(((5 + t)*(1/3)))^(-3/2))^2)))
}

hamiltonian! {
    pub struct E208 { a, b, c }
    H(x, y; px, py; t) = (sinh(((exp(sin((x*(if (((y^5) + y) < pi) { c } else { b }))))^(-4/3))*(px + atan((b*(pi + (t^7)))))))^2)
}

hamiltonian! {
    pub struct E209 { a, b, c }
    H(x, y; px, py; t) = (if (((if ((c^2) <= a) { (c^2) } else { (-7/4) }) + (if ((c^2) <= a) { (c^2) } else { (-7/4) })) < ((if ((c^2) <= a) { (c^2) } else { (-7/4) }) + (if ((c^2) <= a) { (c^2) } else { (-7/4) }))) { ((y*(if ((c^2) <= a) { (c^2) } else { (-7/4) }))*(px*(px/x))) } else { hypot(((((y*(if ((c^2) <= a) { (c^2) } else { (-7/4) }))*(px*(px/x)))^2)*cosh(((x + px) - t))), px) })
}

hamiltonian! {
    pub struct E210 { a, b, c }
    H(x, y; px, py; t) = ((((if (((b^7) - 1) < py) { (c*c) } else { (c + max(b, (if !((if (acosh((((pi^2) + (5^2)) + 1)) < px) { py } else { c }) < py) { px } else { pi }))) })/exp(atan((px + (((c^2) + 1)^-1)))))/abs(py)) + max(y, ((acosh(((((y - (-1))^2) + 1) + 1)) + t) + ((abs((((y^2) + (1/4))^(5/2)))^(-3/2)) + (y - (-1))))))
}

hamiltonian! {
    pub struct E211 { a, b, c }
    H(x, y; px, py; t) = ((t^-2)*((x*((1*px)^(-1/2))) + py))
}

hamiltonian! {
    pub struct E212 { a, b, c }
    H(x, y; px, py; t) = (((abs(((t + c) - ((1/10)*px)))^(13/4))^-2)*((px - py) - pow((((-(((-1) + ln_1p(((exp(cos(t))^2) + 2)))*erfc(px)))^2) + 1), sin(((((exp(sin(floor((((1/10)*hypot(px, ((x - (px - py)) - c))) + (3/10)))))^(-1/2))^2) + 1)^(-4/3))))))
}

hamiltonian! {
    pub struct E213 { a, b, c }
    H(x, y; px, py; t) = ((((pi*t)/((-(exp(px)*pow(((py^2) + 1), sin(py))))/(((1 + sin(py))^2) + 2)))*((if ((px^2) <= py) { px } else { (max(px, ((py*cos((((1 + sin(py))^2) + 2))) - ((abs(((a + px)^-1))^(-4/3))/b)))*ln(abs(py))) })^2)) + ((if (y < y) && (exp(atan((1/2))) < y) { (pi + (abs(sin(((if !((t + hypot(c, t)) <= c) { b } else { x }) - (x - x))))^(-3/2))) } else { (t/5) }) - (1/10)))
}

hamiltonian! {
    pub struct E214 { a, b, c }
    H(x, y; px, py; t) = ((y - y) + ((((if !((py*(if ((py - t) <= b) { pi } else { pi })) <= pi) { (((sqrt(exp(x))^2) + (t^2))^(1/3)) } else { ((t*y)/(max(py, (py*(if ((py - t) <= b) { pi } else { pi })))*px)) })^2) + 1)^(3/2)))
}

hamiltonian! {
    pub struct E215 { a, b, c }
    H(x, y; px, py; t) = (remainder((t + (3/10)), px)*erf((min((py*(y - px)), (a/y)) - ((3/10) + x))))
}

hamiltonian! {
    pub struct E216 { a, b, c }
    H(x, y; px, py; t) = (floor(((exp(((((-((py + t) + (abs((-1))^(13/4))))^2) + 1)^-3)) + ((b + t)*((1/2)/c))) + (3/10))) + (((y + (1/3)) + a)/x))
}

hamiltonian! {
    pub struct E217 { a, b, c }
    H(x, y; px, py; t) = (acosh((((max(py, t)^2) + (1/4)) + 1))*((exp(cos((sqrt(exp(y))*x)))^(3/10))/cosh(atan(((((((abs(3)^-3)^2) + 2)^(3/2)) + (3/10)) % ((py^2) + (pi^2)))))))
}

hamiltonian! {
    pub struct E218 { a, b, c }
    H(x, y; px, py; t) = (((x + (if ((1 + x) <= px) || (b <= (1/10)) { c } else { px }))/b) + (2/py))
}

hamiltonian! {
    pub struct E219 { a, b, c }
    H(x, y; px, py; t) = ((((-1) + (pi^-1)) + cosh(atan(py))) + (-((c*a)*(sin(t)^6))))
}

hamiltonian! {
    pub struct E220 { a, b, c }
    H(x, y; px, py; t) = ((((ln_1p(abs(((if (t <= px) { x } else { px }) + b)))^2) + 1)^(-1/2)) - py)
}

hamiltonian! {
    pub struct E221 { a, b, c }
    H(x, y; px, py; t) = (if ((y*c) < (1/3)) && (b <= pi) { (cbrt((if (2 < py) && ((px - c) < 3) { 5 } else { py })) - (a*(((((1/10)*remainder(((c + t) + (3/10)), atan2(px, 1)))*((t - a) - x)) - py) + (((-cos((a^4)))^-3)*t)))) } else { atan((py + (1/3))) })
}

hamiltonian! {
    pub struct E222 { a, b, c }
    H(x, y; px, py; t) = ((cos(py) - ((1/3) + (px*atan((py*1))))) + (atan2(tan((c/x)), ((((x*(c/x))^2) + (1/4))^(1/3)))/((abs((c*atan2((t + (5*y)), atan(x))))^2) + 2)))
}

hamiltonian! {
    pub struct E223 { a, b, c }
    H(x, y; px, py; t) = ((abs(asinh((((px*(y + y))/(cbrt((b*(1/2))) + (y + c)))/(((py/(t*y)) - t) - px))))^(-3/2)) + (floor((ln(abs(2)) + (3/10))) - remainder((y + (3/10)), cosh(atan(c)))))
}

hamiltonian! {
    pub struct E224 { a, b, c }
    H(x, y; px, py; t) = ((acos(cos(((t - t)*(1/10))))/cos((pi + 5))) + (if ((1*((1/2) - py)) <= c) { ((cos(t) - x)/py) } else { b }))
}

hamiltonian! {
    pub struct E225 { a, b, c }
    H(x, y; px, py; t) = ((acosh((abs(((((px + (3/10)) % px)*remainder((px + (3/10)), (px + py)))*(px + (3/10)))) + 1)) - hypot(b, px)) + atan((x*sqrt(exp(sin(((atanh(tanh(t))*((1/(1/10)) - c))^-1)))))))
}

hamiltonian! {
    pub struct E226 { a, b, c }
    H(x, y; px, py; t) = (exp(sin(abs((round((round(((981/100) + (3/10))) + (3/10)))/((((if (b <= y) || ((t^6) < px) { a } else { ((981/100) + (3/10)) }) - pi)^2) + (1/4))))))^(1/3))
}

hamiltonian! {
    pub struct E227 { a, b, c }
    H(x, y; px, py; t) = ((t*t) - (hypot(2, x) - sqrt((((if (erf((-(-1))) < py) || ((((-1) - y)/5) < a) { (t*c) } else { ((-1)*(-7/4)) })^2) + (a^2)))))
}

hamiltonian! {
    pub struct E228 { a, b, c }
    H(x, y; px, py; t) = ((-(t*(py + 2))) + (if (min(a, (t + t)) <= 1) { asinh(a) } else { ((if (((-7/4)/erfc(c)) < t) { (1/3) } else { c })/(1/3)) }))
}

hamiltonian! {
    pub struct E229 { a, b, c }
    H(x, y; px, py; t) = (atanh(sin((if ((c*(x + x)) < (x + x)) && ((x - (if (x <= t) { c } else { b })) < x) { y } else { (((px^2) + 1)^(5/2)) }))) + (t*(((if (x <= t) { c } else { b }) + (3/10)) % ((t^2) + (1/4)))))
}

hamiltonian! {
    pub struct E230 { a, b, c }
    H(x, y; px, py; t) = ((((x + x) - t)*b)*remainder((py + (3/10)), (c/y)))
}

hamiltonian! {
    pub struct E231 { a, b, c }
    H(x, y; px, py; t) = ((((if !((py*(((py^2) + 2)^(-7/5))) < px) { c } else { c }) - t)*min(((if (((px + px)^2) <= py) { py } else { ((px + px)^2) }) + px), (((((c^2) + 2)^-3)*px)/((py^2) + 1)))) + (t + erfc((min(x, (981/100)) + min((981/100), ((981/100) - y))))))
}

hamiltonian! {
    pub struct E232 { a, b, c }
    H(x, y; px, py; t) = (if (a < py) && (asin(sin(t)) < a) { ((t + b)*((pi*1)*py)) } else { ((remainder((px + (3/10)), (x - (if ((b + cbrt(py)) < a) || (asin(((py^5)/(1 + ((py^5)^2)))) <= pi) { px } else { x })))*c) + ((t + b)*((pi*1)*py))) })
}

hamiltonian! {
    pub struct E233 { a, b, c }
    H(x, y; px, py; t) = ((x*b) + (if ((if (((-pi)/b) <= px) { (x*b) } else { (y*px) }) <= t) && ((b - pi) < c) { 5 } else { c }))
}

hamiltonian! {
    pub struct E234 { a, b, c }
    H(x, y; px, py; t) = (round((((1 - (((1/10)/(((1/10)^2) + 2))*((1/2)^5))) + (-atan2((1/2), ((((abs((if ((5/((pi^2) + 2)) < px) || (ln_1p(((((1/3) + py)^2) + (px^2))) <= pi) { ((c*(-1))^6) } else { (abs((-((((((-1)^2) + 1)^(1/2))*b) + t)))^(-1/2)) }))^(-7/5))^2) + (1/4))^(-1/2))))) + (3/10))) + tanh(atanh(cos((cbrt(ln_1p(cosh((x*(x*x)))))^5)))))
}

hamiltonian! {
    pub struct E235 { a, b, c }
    H(x, y; px, py; t) = (-max(ln_1p(abs(cbrt((min(((atan((((((y + y) + (3/10)) % y) + remainder((pi + (3/10)), ((a^2) + (1/4)))) + round(((atanh(cos(1)) + x) + (3/10))))) - pi) + (if (px < pi) { (((px*(a^2))*tan((atan(5)/((2^2) + 2)))) - 1) } else { (3 + px) })), ((b - (abs(c)^(-3/2))) + ((cbrt(px)*pi) - b)))^-3)))), (if ((1 + (c - py)) == (981/100)) && (tanh((px^2)) < 5) { py } else { (pi + t) })))
}

hamiltonian! {
    pub struct E236 { a, b, c }
    H(x, y; px, py; t) = ((y*((y*y) + px))^6)
}

hamiltonian! {
    pub struct E237 { a, b, c }
    H(x, y; px, py; t) = (remainder(((py*(-(a - (-7/4)))) + (3/10)), exp(sin((cos((py + px))*(if (2 < b) { (a/py) } else { px }))))) + (x*((a + x) + (-(x*acosh((((((5 - a)*(981/100))^2) + 1) + 1)))))))
}

hamiltonian! {
    pub struct E238 { a, b, c }
    H(x, y; px, py; t) = (acosh(((((pi + (if (a <= t) && ((((y^2) + (1/4))^(3/10)) <= t) { t } else { px }))*c) + (((-1) - a) - c)) + 1))/((y^2) + 1))
}

hamiltonian! {
    pub struct E239 { a, b, c }
    H(x, y; px, py; t) = (sign((abs((((abs(pi)^-1)/abs((abs(pi) - py)))*(y*1)))^(13/4))) - exp_m1((((px + px)*py)*(((abs(pi)^-1)/abs((abs(pi) - py)))*(y*1)))))
}

hamiltonian! {
    pub struct E240 { a, b, c }
    H(x, y; px, py; t) = ((py*((py/a)/exp(px))) + ((-((a + (-1))/(((((c + x)^2) + (1/4))^(3/10))*(y + y)))) - (y/(1/2))))
}

hamiltonian! {
    pub struct E241 { a, b, c }
    H(x, y; px, py; t) = pow(abs(cbrt(round(((pi - (c + (px*b))) + (3/10))))), tanh(((-1)*(x*b))))
}

hamiltonian! {
    pub struct E242 { a, b, c }
    H(x, y; px, py; t) = (sin(c)*(-(exp_m1(sin(atanh((max(sin(c), c)/(1 + (max(sin(c), c)^2)))))) + (py + (if (((c*x)*py) < px) && (atanh(tanh((c^6))) < b) { x } else { (-1) })))))
}

hamiltonian! {
    pub struct E243 { a, b, c }
    H(x, y; px, py; t) = (sqrt(cosh(cos((if ((abs(px)^(-1/2)) <= py) { (ln_1p((((py - acos(((-7/4)/(1 + ((-7/4)^2)))))^2) + (1/4)))*((cosh((-((-7/4)/(1 + ((-7/4)^2))))) - (py/exp(atan(tanh((((py - acos(((-7/4)/(1 + ((-7/4)^2)))))^2)*a))))))^2)) } else { (if (cbrt(((-1) - a)) == (-1)) { ((1/3) + px) } else { ((((py/pi)^2) + (1/4))^(13/4)) }) })))) + acos(((exp(tanh(y)) + (x/((((1*exp(tanh(y))) + (t*y))^2) + 2)))/(1 + ((exp(tanh(y)) + (x/((((1*exp(tanh(y))) + (t*y))^2) + 2)))^2)))))
}

hamiltonian! {
    pub struct E244 { a, b, c }
    H(x, y; px, py; t) = remainder((((cosh(atan(py))^(3/10)) - ((-(t*x))^2)) + (3/10)), cosh(sin(floor(((((px/cosh(atan(t))) - (-(t*x))) - py) + (3/10))))))
}

hamiltonian! {
    pub struct E245 { a, b, c }
    H(x, y; px, py; t) = (((py/x) + (if ((cosh(tanh(x))^(1/3)) < y) && ((tanh(x) - (if ((c*(1/10)) < t) { x } else { a })) < y) { t } else { ((x/abs(erfc(b)))*((-7/4)/a)) }))^2)
}

hamiltonian! {
    pub struct E246 { a, b, c }
    H(x, y; px, py; t) = (pow((((px^2)^2) + 2), (-(t/((1^2) + (px^2))))) + (abs(abs(y))^(-7/5)))
}

hamiltonian! {
    pub struct E247 { a, b, c }
    H(x, y; px, py; t) = (((acos(cosh((a + (((b*(1/3))^2)*y))))/min((1/2), (-1)))^3) + (abs((if ((981/100) <= a) || ((b/cosh(sin(y))) <= pi) { (px + x) } else { py }))^(13/4)))
}

hamiltonian! {
    pub struct E248 { a, b, c }
    H(x, y; px, py; t) = (x*((t - py)*remainder((t + (3/10)), c)))
}

hamiltonian! {
    pub struct E249 { a, b, c }
    H(x, y; px, py; t) = (((cosh((c^2))^(13/4)) + ((sign(hypot((a - (b*px)), ((-(px*acosh((abs(a) + 1)))) + py)))*(px - py))*cosh(cos(((t/px) + ln(((px^2) + 2))))))) + ((-t) + y))
}

hamiltonian! {
    pub struct E250 { a, b, c }
    H(x, y; px, py; t) = (((atan(b) - ((min((if !((t - py) <= pi) { t } else { y }), ((1/3) + py))*a) + tan((t^6)))) + py)^-1)
}

hamiltonian! {
    pub struct E251 { a, b, c }
    H(x, y; px, py; t) = (-((((((if ((abs(a)^(1/2)) == a) { t } else { py }) + (x^2))*pow(abs(x), sin((exp_m1(3) - py))))^2) + 1)^(3/2)))
}

hamiltonian! {
    pub struct E252 { a, b, c }
    H(x, y; px, py; t) = ((if (t <= px) && (a == pi) { (((2 + t) + 1)^2) } else { (((2 + t) + 1) - t) }) + (((a + a)/(cosh((-(-(t*y))))^(2/3))) + ((((cosh((-(-(t*y))))/y)^2) + (1/4))^(-1/2))))
}

hamiltonian! {
    pub struct E253 { a, b, c }
    H(x, y; px, py; t) = ((if (b == 2) { (2 - t) } else { cbrt((-y)) })/exp(sin((if (min(b, px) < (981/100)) && (sin((-px)) <= c) { (px/cosh(cos((1/2)))) } else { (c/exp(tanh(t))) }))))
}

hamiltonian! {
    pub struct E254 { a, b, c }
    H(x, y; px, py; t) = (((if (t <= py) && (5 <= 5) { (if ((1^-3) == y) && ((((1/10)*c) - t) < 5) { 1 } else { px }) } else { (acos(cos((px + (if ((1^-3) == y) && ((((1/10)*c) - t) < 5) { 1 } else { px })))) + ((-7/4)^-1)) }) + (((px + px)/exp(((b*1)/pi))) + c))*(b - x))
}

hamiltonian! {
    pub struct E255 { a, b, c }
    H(x, y; px, py; t) = ((atanh(((sin(((asinh((py/px))^-1) + (b*ln_1p(((c^2) + (c^2))))))/px)/(1 + ((sin(((asinh((py/px))^-1) + (b*ln_1p(((c^2) + (c^2))))))/px)^2)))) - (-7/4)) + (if (atan2(b, b) < x) { y } else { (x*y) }))
}

crate::compiled::list! {
    32 E32 any
    33 E33 separable
    34 E34 any
    35 E35 any
    36 E36 separable
    37 E37 any
    38 E38 any
    39 E39 separable
    40 E40 any
    41 E41 any
    42 E42 separable
    43 E43 any
    44 E44 any
    45 E45 separable
    46 E46 any
    47 E47 any
    48 E48 separable
    49 E49 any
    50 E50 any
    51 E51 separable
    52 E52 any
    53 E53 any
    54 E54 separable
    55 E55 any
    56 E56 any
    57 E57 separable
    58 E58 any
    59 E59 any
    60 E60 separable
    61 E61 any
    62 E62 any
    63 E63 separable
    64 E64 any
    65 E65 any
    66 E66 separable
    67 E67 any
    68 E68 any
    69 E69 separable
    70 E70 any
    71 E71 any
    72 E72 separable
    73 E73 any
    74 E74 any
    75 E75 separable
    76 E76 any
    77 E77 any
    78 E78 separable
    79 E79 any
    80 E80 any
    81 E81 separable
    82 E82 any
    83 E83 any
    84 E84 separable
    85 E85 any
    86 E86 any
    87 E87 separable
    88 E88 any
    89 E89 any
    90 E90 separable
    91 E91 any
    92 E92 any
    93 E93 separable
    94 E94 any
    95 E95 any
    96 E96 separable
    97 E97 any
    98 E98 any
    99 E99 separable
    100 E100 any
    101 E101 any
    102 E102 separable
    103 E103 any
    104 E104 any
    105 E105 separable
    106 E106 any
    107 E107 any
    108 E108 separable
    109 E109 any
    110 E110 any
    111 E111 separable
    112 E112 any
    113 E113 any
    114 E114 separable
    115 E115 any
    116 E116 any
    117 E117 separable
    118 E118 any
    119 E119 any
    120 E120 separable
    121 E121 any
    122 E122 any
    123 E123 separable
    124 E124 any
    125 E125 any
    126 E126 separable
    127 E127 any
    128 E128 any
    129 E129 separable
    130 E130 any
    131 E131 any
    132 E132 separable
    133 E133 any
    134 E134 any
    135 E135 separable
    136 E136 any
    137 E137 any
    138 E138 separable
    139 E139 any
    140 E140 any
    141 E141 separable
    142 E142 any
    143 E143 any
    144 E144 separable
    145 E145 any
    146 E146 any
    147 E147 separable
    148 E148 any
    149 E149 any
    150 E150 separable
    151 E151 any
    152 E152 any
    153 E153 separable
    154 E154 any
    155 E155 any
    156 E156 separable
    157 E157 any
    158 E158 any
    159 E159 separable
    160 E160 any
    161 E161 any
    162 E162 separable
    163 E163 any
    164 E164 any
    165 E165 separable
    166 E166 any
    167 E167 any
    168 E168 separable
    169 E169 any
    170 E170 any
    171 E171 separable
    172 E172 any
    173 E173 any
    174 E174 separable
    175 E175 any
    176 E176 any
    177 E177 separable
    178 E178 any
    179 E179 any
    180 E180 separable
    181 E181 any
    182 E182 any
    183 E183 separable
    184 E184 any
    185 E185 any
    186 E186 separable
    187 E187 any
    188 E188 any
    189 E189 separable
    190 E190 any
    191 E191 any
    192 E192 separable
    193 E193 any
    194 E194 any
    195 E195 separable
    196 E196 any
    197 E197 any
    198 E198 separable
    199 E199 any
    200 E200 any
    201 E201 separable
    202 E202 any
    203 E203 any
    204 E204 separable
    205 E205 any
    206 E206 any
    207 E207 separable
    208 E208 any
    209 E209 any
    210 E210 separable
    211 E211 any
    212 E212 any
    213 E213 separable
    214 E214 any
    215 E215 any
    216 E216 separable
    217 E217 any
    218 E218 any
    219 E219 separable
    220 E220 any
    221 E221 any
    222 E222 separable
    223 E223 any
    224 E224 any
    225 E225 separable
    226 E226 any
    227 E227 any
    228 E228 separable
    229 E229 any
    230 E230 any
    231 E231 separable
    232 E232 any
    233 E233 any
    234 E234 separable
    235 E235 any
    236 E236 any
    237 E237 separable
    238 E238 any
    239 E239 any
    240 E240 separable
    241 E241 any
    242 E242 any
    243 E243 separable
    244 E244 any
    245 E245 any
    246 E246 separable
    247 E247 any
    248 E248 any
    249 E249 separable
    250 E250 any
    251 E251 any
    252 E252 separable
    253 E253 any
    254 E254 any
    255 E255 separable
}
