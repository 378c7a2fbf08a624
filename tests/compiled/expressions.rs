//! Random expressions for the macro. Made by `generate.rs`; not to be edited.

use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct E0 { a, b, c }
    H(x, y; px, py; t) = ((if ((if (atan2((-1), (1/3)) <= t) { a } else { (1/2) }) <= b) { atan2(((t - (py^2))*max((-7/4), (1/2))), a) } else { px }) + ln_1p((((t + a)^2) + 2)))
}

hamiltonian! {
    pub struct E1 { a, b, c }
    H(x, y; px, py; t) = (((if (min((y - (1/10)), 1) < y) { ((-((if (asinh((py - b)) <= b) { 1 } else { py })*x))/(b - atanh(((pi*y)/(1 + ((pi*y)^2)))))) } else { cosh(atan(((asinh((py - b)) + a) + (max(px, c) - tanh(tanh((1/2))))))) })*(-(tanh(tanh((1/2))) + t)))*((py - (asinh((py - b)) + a))/x))
}

hamiltonian! {
    pub struct E2 { a, b, c }
    H(x, y; px, py; t) = (((if !((px - 5) == (1/2)) { (px - 5) } else { (-(ln(cosh(atan(px)))*c)) })*((x/abs(b))^2))*(t*(px*(sinh(atan((-7/4)))*exp_m1(atan((a + b)))))))
}

hamiltonian! {
    pub struct E3 { a, b, c }
    H(x, y; px, py; t) = ((abs(asin((tan(erf(((px*((if ((-px) < a) || ((b - py) <= px) { (a - py) } else { 2 }) + (1/2))) + ((px*((if ((-px) < a) || ((b - py) <= px) { (a - py) } else { 2 }) + (1/2))) + px))))/(1 + (tan(erf(((px*((if ((-px) < a) || ((b - py) <= px) { (a - py) } else { 2 }) + (1/2))) + ((px*((if ((-px) < a) || ((b - py) <= px) { (a - py) } else { 2 }) + (1/2))) + px))))^2)))))^(2/3)) + asin(cos((((exp(atan(cosh(cos((x*y)))))^(-7/5)) - ((x*y) + (abs((x + y)) + b))) + x))))
}

hamiltonian! {
    pub struct E4 { a, b, c }
    H(x, y; px, py; t) = atan2((atan2((((c*px)/(px*(c*py)))*b), pi) + (x - py)), py)
}

hamiltonian! {
    pub struct E5 { a, b, c }
    H(x, y; px, py; t) = (((max(c, (py*a)) + (abs((if (y <= py) && (((pi*y) + c) < a) { (if (pow(abs((-7/4)), tanh((y - (-7/4)))) == (-7/4)) { (if (py < 1) || ((((a^2) + (pi^2))^(5/2)) <= pi) { py } else { x }) } else { min(py, (px*t)) }) } else { y }))^(1/3)))*sinh(((((1/10) + y) - y)/(cos(cbrt(py))*a))))^2)
}

hamiltonian! {
    pub struct E6 { a, b, c }
    H(x, y; px, py; t) = (((if ((px/exp(tanh(px))) == px) { (px*(py*b)) } else { c })*asin(tanh((a - ((-1) - ((((abs(c)^(3/10))^2) + 1)^-1)))))) + (hypot(t, (981/100)) + min(hypot(((((t + y)*sin(pi))*((((x - pi)/exp(atan((pi*(((y - a) + (1 + t))*(y/((b^2) + 1))))))) - ((abs(x)^(-7/5))*5))^2))^6), 1), (((exp(((-b)*(-7/4)))^7)*cbrt((((c^2) + (b^2))^-2)))/t))))
}

hamiltonian! {
    pub struct E7 { a, b, c }
    H(x, y; px, py; t) = (if (px < c) || (((pi^2)*((1/3) + 3)) <= c) { ((5*x)*((1/3) + 3)) } else { ((5*x) - 5) })
}

hamiltonian! {
    pub struct E8 { a, b, c }
    H(x, y; px, py; t) = sinh(tanh((((if (((if (((-7/4) - (x - a)) <= py) { c } else { 5 })^2) <= x) && ((a - (1/3)) == t) { ((-exp((1 - ((x*pi)*a))))^4) } else { ((((py + py)^2) + 1)^(-3/2)) })*x) + ln_1p((((if ((a/exp(cos(x))) <= 3) { 2 } else { ((1/10) + c) }) + (t*px))*(a*py))))))
}

hamiltonian! {
    pub struct E9 { a, b, c }
    H(x, y; px, py; t) = (((((b*(981/100)) + (if (px <= px) { px } else { erf(py) })) - ((if !(((1/2)^-2) < b) { c } else { px })*(1/2))) + erfc((b - ((981/100) + b)))) + (((-x) - cos(1)) - ((3 - pi) + c)))
}

hamiltonian! {
    pub struct E10 { a, b, c }
    H(x, y; px, py; t) = ((sinh(max(x, (ln(abs(b)) - c)))^5) + (exp((if ((py*(sinh(max(x, (ln(abs(b)) - c)))^5)) < x) && (b <= t) { sinh(max(x, (ln(abs(b)) - c))) } else { pi }))^(-3/2)))
}

hamiltonian! {
    pub struct E11 { a, b, c }
    H(x, y; px, py; t) = (((if ((a*5) <= a) { sqrt((x^6)) } else { (px + a) }) - (x + b))^2)
}

hamiltonian! {
    pub struct E12 { a, b, c }
    H(x, y; px, py; t) = ((((b*py)/(((((-2) - a) - px)^2) + 1))/((atan(c)^2) + 1)) + sqrt((if (y <= y) || (t <= t) { ((pow(((2^2) + 2), sin((if ((2*(x^-1)) < c) || (erf(b) < t) { ((((if (t < x) { b } else { y })^2) + (1/4))^(5/2)) } else { y }))) + cosh(cos((a/t))))^2) } else { atanh(cos(x)) })))
}

hamiltonian! {
    pub struct E13 { a, b, c }
    H(x, y; px, py; t) = (exp((asinh((a + (2 + acos(sin(px)))))*(if ((-y) < c) && ((t + (pi/cosh(cos(b)))) < t) { asinh((a + (2 + acos(sin(px))))) } else { (acos(sin(px))^5) })))*acosh(((((c/(if ((abs((1/((b^2) + (1/4))))^(-7/5)) < c) { a } else { (1/10) }))^2) + (1^2)) + 1)))
}

hamiltonian! {
    pub struct E14 { a, b, c }
    H(x, y; px, py; t) = ((if (((exp(c)^(-3/2)) + b) < a) && (py < (y - px)) { ((-(t + atan((y - px))))^2) } else { (-1) })*((py*(if ((atan2(c, x)*(-7/4)) < a) || ((if (asinh(y) < py) { y } else { px }) < b) { y } else { (sign((px/px)) - c) })) - (erfc((((sin((1/3)) + exp_m1(atan((exp(tanh(a))^(3/2))))) + c) - 2))*y)))
}

hamiltonian! {
    pub struct E15 { a, b, c }
    H(x, y; px, py; t) = ((((t/c)*py)*(erfc(py) - (((1/2)/(py*(t + (3*a))))^6))) + (-((((y*1)/(((exp(x)^(-7/5))*x) + y)) + pi) + (x + x))))
}

hamiltonian! {
    pub struct E16 { a, b, c }
    H(x, y; px, py; t) = (ln_1p((((sinh(cos(((sqrt((((px^5)^2) + (px^2))) - pow(((py^2) + 1), tanh(py))) + c)))^2) + (1/4))^(3/2)))*max(x, (sin(ln_1p(exp(x)))^-2)))
}

hamiltonian! {
    pub struct E17 { a, b, c }
    H(x, y; px, py; t) = asinh(((1/3)*(py + (((((1/3) + y) + (1/2))*x) + y))))
}

hamiltonian! {
    pub struct E18 { a, b, c }
    H(x, y; px, py; t) = ((ln_1p(((a^2) + 1))*(py - t)) + (((abs((if !(y < x) { y } else { y }))^(-1/2)) + b) - (t + x)))
}

hamiltonian! {
    pub struct E19 { a, b, c }
    H(x, y; px, py; t) = cosh(atan(((if (t <= b) { acos((x/(1 + (x^2)))) } else { ((y*c) + py) })*hypot((b/((cosh(1)^(1/2))^3)), ((((-max(t, (b/((cosh(1)^(1/2))^3))))^2) + 1)^(-1/2))))))
}

hamiltonian! {
    pub struct E20 { a, b, c }
    H(x, y; px, py; t) = (ln(abs(exp_m1(((if !(px <= y) { (1/3) } else { (if !((b*sin(1)) <= px) { a } else { c }) }) - (b - x))))) + ((((((2 + (1/3))*py)/x)^2) + 1)^(-3/2)))
}

hamiltonian! {
    pub struct E21 { a, b, c }
    H(x, y; px, py; t) = ((((if (py == py) || (((((b^4)^2) + (1/4))^-1) <= px) { (-(-(pow(((b^2) + (a^2)), cos(c))*t))) } else { (t/exp(((((b^2) + (a^2))*(px^4))*t))) })*(py + (-erf(tan(((c*3)^5))))))^-2) + tan(sin(((-((-1)*(b + tanh(((b - (1/3))*b)))))^2))))
}

hamiltonian! {
    pub struct E22 { a, b, c }
    H(x, y; px, py; t) = (px*((acosh((((((y + px)/abs(t))^2) + (px^2)) + 1)) - a)*(acosh((((((y + px)/abs(t))^2) + (px^2)) + 1)) - a)))
}

hamiltonian! {
    pub struct E23 { a, b, c }
    H(x, y; px, py; t) = (((py*pi)/abs((py + a))) + (if ((x*t) <= y) && (tan((b^2)) < y) { px } else { py }))
}

hamiltonian! {
    pub struct E24 { a, b, c }
    H(x, y; px, py; t) = (min((px*(-7/4)), a) + (((c + y) + ((2*b) + ((((c - (1/3))^2) + (x^2))^(13/4)))) - (y^2)))
}

hamiltonian! {
    pub struct E25 { a, b, c }
    H(x, y; px, py; t) = (max(((b*(-7/4)) - a), px)*(b - ((py*(x - py))*(b*px))))
}

hamiltonian! {
    pub struct E26 { a, b, c }
    H(x, y; px, py; t) = (b + (((((t - (((ln_1p(((t^2) + (py^2))) + b) + ((b*sinh(cos(x)))/((sinh(cos((b + (abs((c - x))^-2))))^2) + 1))) - (px - c))) - max(c, c))^2) + (1/4))^(-3/2)))
}

hamiltonian! {
    pub struct E27 { a, b, c }
    H(x, y; px, py; t) = ((exp(sin((if ((t/py) <= py) && ((px + b) < py) { ((px + asinh(px))^2) } else { py }))) - tanh((if (px < (if ((t/py) <= py) && ((px + b) < py) { ((px + asinh(px))^2) } else { py })) || (atan2(((-1)*t), px) <= a) { py } else { acosh((((px^2) + (1/4)) + 1)) }))) + ((cosh((exp(b)/abs((x + x))))^-2)/((-1)^4)))
}

hamiltonian! {
    pub struct E28 { a, b, c }
    H(x, y; px, py; t) = (if ((t/t) <= c) { ((x/abs(px))/((1/2) - c)) } else { exp_m1(cos(((a - b)*pi))) })
}

hamiltonian! {
    pub struct E29 { a, b, c }
    H(x, y; px, py; t) = cos(((y - (atanh(tanh(py))*a)) - a))
}

hamiltonian! {
    pub struct E30 { a, b, c }
    H(x, y; px, py; t) = (hypot((py - py), hypot((pi/((px^2) + (pi^2))), (px - px))) + ((y*(-(y + y)))*atanh((((c*(y/y)) + a)/(1 + (((c*(y/y)) + a)^2))))))
}

hamiltonian! {
    pub struct E31 { a, b, c }
    H(x, y; px, py; t) = atanh(((abs(((erf((((-7/4)^2)*((if (max(hypot(y, c), a) <= x) { (-1) } else { max(hypot(y, c), a) })*(1/10))))*px)^7))^(5/2))/(1 + ((abs(((erf((((-7/4)^2)*((if (max(hypot(y, c), a) <= x) { (-1) } else { max(hypot(y, c), a) })*(1/10))))*px)^7))^(5/2))^2))))
}

hamiltonian! {
    pub struct E32 { a, b, c }
    H(x, y; px, py; t) = (a/(max((if (hypot(2, tan(atan(y))) < b) || ((c + a) < a) { exp(pi) } else { tanh((2/(((y*(5/a))^2) + 1))) }), py)^-2))
}

hamiltonian! {
    pub struct E33 { a, b, c }
    H(x, y; px, py; t) = ((a/(((if ((px + (-a)) <= t) { (((-a)/(if ((a*px) <= a) { pi } else { pi })) - erf((b + 3))) } else { min((px - (t/exp(t))), a) })^2) + (b^2))) + erf(min(tanh((min(max(x, (x + sinh(x))), (if ((cosh(sin((x^2)))^(-7/5)) < pi) || ((acosh((((a^2) + 1) + 1))/abs(max(x, (x + sinh(x))))) < (-7/4)) { (y^2) } else { (cosh(sin((x^2)))^(-7/5)) })) - (1*t))), sin(x))))
}

hamiltonian! {
    pub struct E34 { a, b, c }
    H(x, y; px, py; t) = hypot((if (t <= x) && ((asin(tanh(1)) + y) < c) { (abs((exp(atan(acosh((abs((t/asin(tanh(1)))) + 1))))^(-1/2)))^(2/3)) } else { (t + (py + py)) }), (((1 + a)*(5 - pi)) - (t/((x^2) + 2))))
}

hamiltonian! {
    pub struct E35 { a, b, c }
    H(x, y; px, py; t) = (((t - 5)*b) + ((if ((a + (a*x)) <= (-7/4)) && (cosh(sin(t)) <= 2) { a } else { px }) - (x*a)))
}

hamiltonian! {
    pub struct E36 { a, b, c }
    H(x, y; px, py; t) = (((((exp(((py/((py^2) + 2))/atan2(((py + abs((1/10))) - (t + py)), pi)))^(5/2))^2) + 1)^(2/3)) + (if (y <= a) { ((abs((((-7/4)/y) - (abs(max(a, x))^(2/3))))^(1/3))^-2) } else { c }))
}

hamiltonian! {
    pub struct E37 { a, b, c }
    H(x, y; px, py; t) = (((erf((((a^2) + a)*((py + (if (b < (1/10)) { (((x/c)/(abs((1/2))^(13/4)))/cosh((((y^2) + (a^2))^(-1/2)))) } else { (a - t) })) + ((((t + b)^2) + 1)^(1/3)))))^2) + (b^2))^(-4/3))
}

hamiltonian! {
    pub struct E38 { a, b, c }
    H(x, y; px, py; t) = ((-((atanh((5/(1 + (5^2)))) + pi) - t))/abs((if (sign(cbrt(px)) <= pi) || (((-1) + x) < px) { erf(c) } else { px })))
}

hamiltonian! {
    pub struct E39 { a, b, c }
    H(x, y; px, py; t) = ((atanh(tanh((-cbrt((b/((px^2) + (1/4))))))) + (py*((((py - py)^2) + 1)^(2/3)))) + min(((y - a) + b), (sqrt((ln(exp_m1(x)) + ((x - c)/(((x*1)^2) + 2))))*(x/x))))
}

hamiltonian! {
    pub struct E40 { a, b, c }
    H(x, y; px, py; t) = ((erf((acosh(((((cbrt(t)/abs((-(min(a, px) - t))))^2) + 1) + 1))/(-1)))*(1/3))/exp((x + (y + 1))))
}

hamiltonian! {
    pub struct E41 { a, b, c }
    H(x, y; px, py; t) = ((py/((y^2) + (x^2))) + (((-7/4) + ((y^2) + (x^2))) + sign((py - ((y^2) + (x^2))))))
}

hamiltonian! {
    pub struct E42 { a, b, c }
    H(x, y; px, py; t) = ((tanh((pi + (pi*a)))*(if ((atan2(pi, 2)*1) <= 3) { py } else { a })) + ((cosh(cos(sqrt((((a - (((t^3)*a)*(-t)))^2) + (1/4)))))^(3/2))*acos(tanh((((c^2) + (1^2))^(3/10))))))
}

hamiltonian! {
    pub struct E43 { a, b, c }
    H(x, y; px, py; t) = hypot((a - (if ((x + t) <= a) { acosh((((b^2) + 1) + 1)) } else { y })), atanh((((if ((acosh((((b^2) + 1) + 1))*(a/px)) < pi) || ((py/py) < y) { t } else { cos(a) }) - (pi - max(px, a)))/(1 + (((if ((acosh((((b^2) + 1) + 1))*(a/px)) < pi) || ((py/py) < y) { t } else { cos(a) }) - (pi - max(px, a)))^2)))))
}

hamiltonian! {
    pub struct E44 { a, b, c }
    H(x, y; px, py; t) = ((x - py)*py)
}

hamiltonian! {
    pub struct E45 { a, b, c }
    H(x, y; px, py; t) = (((sign(t)/cosh(atan((if !((if ((t*(-t)) <= a) { a } else { sinh(5) }) < py) { (1 - 1) } else { py })))) + ((((sign(t)/cosh(atan((if !((if ((t*(-t)) <= a) { a } else { sinh(5) }) < py) { (1 - 1) } else { py }))))*b)/abs((1/10)))*(sinh(sin(px)) + (if !(atan(py) == pi) { tan(t) } else { px })))) + (((x/(x - tan(((1/10)*y))))/cosh((atan2(tanh(y), b) + (if ((tan(((1/10)*y))*pi) <= c) && (((x - tan(((1/10)*y))) - x) <= y) { a } else { x }))))^6))
}

hamiltonian! {
    pub struct E46 { a, b, c }
    H(x, y; px, py; t) = pow(cosh(tanh(((x - a)*min(py, (if (x <= px) { py } else { x }))))), (atanh(sin((cosh(sin(((pi*c)/((if ((if (((y - c) + (1/10)) <= a) || ((((1/3) - t) - (1/3)) < pi) { (((x^2) + 1)^(1/2)) } else { c }) < px) && (y < py) { t } else { 1 })*(if (b < t) { (-x) } else { c })))))/(((((((1/2) + ((py + atan2(c, (981/100)))*(1/10)))^2) + (a^2))^(3/10))^2) + (b^2)))))*hypot(a, x)))
}

hamiltonian! {
    pub struct E47 { a, b, c }
    H(x, y; px, py; t) = ((pow(((pow(px, (px*(((tanh(c)^2) + (1/4))^(5/2))))^2) + 2), tan(px)) + cos((-(ln_1p(((acos((((abs((y*a))^(2/3))*(hypot((t - t), b) - ((px*(((tanh(c)^2) + (1/4))^(5/2))) + (px*(-7/4)))))/(1 + (((abs((y*a))^(2/3))*(hypot((t - t), b) - ((px*(((tanh(c)^2) + (1/4))^(5/2))) + (px*(-7/4)))))^2))))^2) + 2))/(a*(((-(px^-2))^3)^7))))))*(((hypot(pi, (-1))^2) + 1)^(1/3)))
}

hamiltonian! {
    pub struct E48 { a, b, c }
    H(x, y; px, py; t) = ((((b*px)*py) - c) + acosh((exp(cos((y/y))) + 1)))
}

hamiltonian! {
    pub struct E49 { a, b, c }
    H(x, y; px, py; t) = (tan(sin(asinh((((-1)/cosh(sin(px))) + sign(y))))) + ((x - pi) + py))
}

hamiltonian! {
    pub struct E50 { a, b, c }
    H(x, y; px, py; t) = ((((y^2) + 1)^(-1/2))*((if (((if (y == py) { y } else { 5 })/abs(x)) < (-7/4)) || (b <= c) { ((px - c)/5) } else { a })*((py + (c + px))/(3 - exp_m1(cos(((a + b) - (1/3))))))))
}

hamiltonian! {
    pub struct E51 { a, b, c }
    H(x, y; px, py; t) = (((-asinh((py*(-((if !(atanh((sin(t)/(1 + (sin(t)^2)))) <= c) { px } else { py })*(px + ((1/10)*px))))))) - (py - asinh((py*(-((if !(atanh((sin(t)/(1 + (sin(t)^2)))) <= c) { px } else { py })*(px + ((1/10)*px)))))))) + (x*(x - x)))
}

hamiltonian! {
    pub struct E52 { a, b, c }
    H(x, y; px, py; t) = asinh(((if ((atanh((3/(1 + (3^2)))) - py) == t) || (py <= x) { (((cbrt(cosh(sin((x/b))))^2) + 1)^(3/2)) } else { (a*py) }) + (((b^2) + 1)^-3)))
}

hamiltonian! {
    pub struct E53 { a, b, c }
    H(x, y; px, py; t) = (1*((abs(((if ((y*(c*1)) < a) { b } else { ((-7/4)*c) })*b))^(-1/2))/((((if ((y*(((a^2) + 2)^(-4/3))) < t) && ((py - (x/((t^2) + 2))) <= pi) { t } else { b })/py)^2) + (5^2))))
}

hamiltonian! {
    pub struct E54 { a, b, c }
    H(x, y; px, py; t) = (sinh(sin(ln_1p(((((-(pi*(px - (-7/4))))*py)^2) + (1/4))))) + sqrt((((abs((5 + (5*(y*((x*(-x))*((t + c)*y))))))^(-7/5))^2) + 2)))
}

hamiltonian! {
    pub struct E55 { a, b, c }
    H(x, y; px, py; t) = (((((if !(((x - a) - 3) < py) { (acos(((x*(py + t))/(1 + ((x*(py + t))^2)))) + (pi + (x*(if ((if ((y/t) < py) { c } else { (py*y) }) < py) && ((pi - (c*px)) < b) { 3 } else { c })))) } else { atan((y/t)) })*((atan((if ((if ((y/t) < py) { c } else { (py*y) }) < py) && ((pi - (c*px)) < b) { 3 } else { c })) - py) - (t - a)))^2) + 1)^(3/10))
}

hamiltonian! {
    pub struct E56 { a, b, c }
    H(x, y; px, py; t) = (acosh((exp(cos(((py*c)*(-(c/((t^2) + 1)))))) + 1)) - (t + ((abs(x)^(5/2))*py)))
}

hamiltonian! {
    pub struct E57 { a, b, c }
    H(x, y; px, py; t) = (((-7/4) + ((((tanh(px) + ((((px/(-7/4))^2) + 2)^(-4/3)))^2) + (a^2))^(-4/3))) + (cosh(atan((((y^2)*x)/(x - ((1/10) - erf((y + y)))))))^-3))
}

hamiltonian! {
    pub struct E58 { a, b, c }
    H(x, y; px, py; t) = ((cosh(cos((if (py <= c) && (hypot(y, ((1/2)*t)) <= t) { a } else { (py*(-1)) })))^(3/10))/cosh(cos((x*sin(t)))))
}

hamiltonian! {
    pub struct E59 { a, b, c }
    H(x, y; px, py; t) = erf(asinh((x - px)))
}

hamiltonian! {
    pub struct E60 { a, b, c }
    H(x, y; px, py; t) = (((((1/2) - b)/((py^2) + 1)) - (exp(tanh(((py*acosh((((px^2) + 1) + 1)))*px)))^7)) + ((((((y - ((y + c)/((c^2) + 1)))*x)*(t*a))^2) + 1)^(-7/5)))
}

hamiltonian! {
    pub struct E61 { a, b, c }
    H(x, y; px, py; t) = ((((px/x)^-3)*(sqrt(((b^2) + (1/4)))^2))^7)
}

hamiltonian! {
    pub struct E62 { a, b, c }
    H(x, y; px, py; t) = ((asin(cos((1/3)))*(-exp_m1(atan((if !(((((px + py)^2) + 1)^(-7/5)) == ((px + py)^2)) { t } else { x })))))*((t + x) + (y + c)))
}

hamiltonian! {
    pub struct E63 { a, b, c }
    H(x, y; px, py; t) = ((py*(cosh(atan(pi)) - ((c + t)*px))) + acosh(((((((asin(((acosh((abs(t) + 1)) + (981/100))/(1 + ((acosh((abs(t) + 1)) + (981/100))^2)))) - (abs(t) + 1)) + (abs(t)^-1))*y)^2) + 1) + 1)))
}

hamiltonian! {
    pub struct E64 { a, b, c }
    H(x, y; px, py; t) = exp(((y - b)*(((py*t) - b) + (5*(-1)))))
}

hamiltonian! {
    pub struct E65 { a, b, c }
    H(x, y; px, py; t) = (pi/cosh(atan((if (a < b) || (t < py) { px } else { (max((if ((y - px) <= px) { y } else { a }), b) + cosh(atan(acosh((abs(x) + 1))))) }))))
}

hamiltonian! {
    pub struct E66 { a, b, c }
    H(x, y; px, py; t) = ((py*(px/(if ((px*px) < py) || (py < a) { py } else { py }))) + acosh((cosh(tan(atan(hypot((((1/10) - (((if ((b*(1/10)) <= b) { y } else { c })*cosh(sin(1)))^6))^-3), b)))) + 1)))
}

hamiltonian! {
    pub struct E67 { a, b, c }
    H(x, y; px, py; t) = (((c*(((y*(c + c)) - 1)^6))/px)*(a*(x*x)))
}

hamiltonian! {
    pub struct E68 { a, b, c }
    H(x, y; px, py; t) = ln_1p((((y*sqrt(cosh(tanh(py))))^2) + 2))
}

hamiltonian! {
    pub struct E69 { a, b, c }
    H(x, y; px, py; t) = (atan(((py*(if ((((1^2) + (1^2))^(-1/2)) < (1/3)) || (px < b) { py } else { (((1^2) + (1^2))^(-1/2)) })) - (c - exp(tanh((a*py)))))) + (y*(((((x + exp(c))/(sinh(tanh(tan(a))) - tanh(tan(a))))^2) + 1)^(-1/2))))
}

hamiltonian! {
    pub struct E70 { a, b, c }
    H(x, y; px, py; t) = ((((b - py)/((3^2) + (a^2)))*(x*(a^2))) - cosh((-acos(sin((cosh(atan((b/((-c) + b))))^6))))))
}

hamiltonian! {
    pub struct E71 { a, b, c }
    H(x, y; px, py; t) = (((y*((a*x)^-2))*py)/a)
}

hamiltonian! {
    pub struct E72 { a, b, c }
    H(x, y; px, py; t) = (sin((if ((px*(abs(t)^-3)) <= (1/10)) { py } else { py })) + asinh((hypot(c, pi)*(y^5))))
}

hamiltonian! {
    pub struct E73 { a, b, c }
    H(x, y; px, py; t) = cbrt(min(((((((1/2)/abs((1/2)))^2) + 1)^(-7/5)) + (a*(if !(sign((abs((-1))^(-1/2))) < y) { y } else { y }))), (cbrt(pi) + (abs((exp(ln(abs(max((exp(py)^(-4/3)), ((pi + 3) - ((py + ((x + exp(py)) - c)) - pi))))))^(-1/2)))^(2/3)))))
}

hamiltonian! {
    pub struct E74 { a, b, c }
    H(x, y; px, py; t) = (((tan((hypot(a, x) + x))/((px^2) + (b^2)))^(-4/3))*sinh(hypot((pi + (c*c)), (tan((x*x)) - x))))
}

hamiltonian! {
    pub struct E75 { a, b, c }
    H(x, y; px, py; t) = ((((a*(px/a)) - py)*atan2(((px*c) - py), a)) + ((y + ((t^5) - ((1/10)/abs((x - t)))))^(3/2)))
}

hamiltonian! {
    pub struct E76 { a, b, c }
    H(x, y; px, py; t) = (t + (min((-px), cbrt(sign(((((y*x)*(1/10))*py) - py))))*((acos(cos(max(atanh((erf((((pi^2) + (a^2))^(5/2)))/(1 + (erf((((pi^2) + (a^2))^(5/2)))^2)))), (tan(sin((abs(y)^(-1/2))))/cosh(tanh(cos((c/px))))))))*a) + (px - y))))
}

hamiltonian! {
    pub struct E77 { a, b, c }
    H(x, y; px, py; t) = min(((a*a)*y), atan2(y, (abs(((pi - (y*py)) + atanh((b/(1 + (b^2))))))^-2)))
}

hamiltonian! {
    pub struct E78 { a, b, c }
    H(x, y; px, py; t) = (atan2(((c*px)*t), (px*(sqrt(abs((981/100)))*a))) + asinh((if !(atanh((y/(1 + (y^2)))) <= y) { acos(sin((((y/y) + c)*(x*x)))) } else { ((1/y)*x) })))
}

hamiltonian! {
    pub struct E79 { a, b, c }
    H(x, y; px, py; t) = ((-(b*y)) + hypot(px, max(x, (c*(px + (x*acos((atan2(px, 1)/(1 + (atan2(px, 1)^2))))))))))
}

hamiltonian! {
    pub struct E80 { a, b, c }
    H(x, y; px, py; t) = ((((c*b) + px)*(((((px^2) + (y^2))^(1/3)) - ((x - x) - y))^-2)) + sinh(py))
}

hamiltonian! {
    pub struct E81 { a, b, c }
    H(x, y; px, py; t) = (((t/abs(py)) - (c*((if (asinh((t - 1)) == b) || (pow(((c^2) + (b^2)), c) <= (-1)) { py } else { py }) - px))) + ((t*t)*cbrt((y*c))))
}

hamiltonian! {
    pub struct E82 { a, b, c }
    H(x, y; px, py; t) = (y/(ln(((((y + (a + t))/(max((a*y), y)^5))^2) + (1/4)))*(((1/2) + y) - ((erf(py)/a)*(c + px)))))
}

hamiltonian! {
    pub struct E83 { a, b, c }
    H(x, y; px, py; t) = (if ((hypot(x, t)*pi) <= x) && (px < px) { a } else { (if ((px^3) < y) { tan(sin((px + ((((y*x)^2) + (1^2))^-3)))) } else { (t*(pi*y)) }) })
}

hamiltonian! {
    pub struct E84 { a, b, c }
    H(x, y; px, py; t) = ((px + ((sqrt((((a + py)^2) + 1))^2)*py)) + (if (b <= (-1)) { cbrt(hypot(1, min(atan2((1/10), (981/100)), x))) } else { (if (c <= y) { x } else { (1/10) }) }))
}

hamiltonian! {
    pub struct E85 { a, b, c }
    H(x, y; px, py; t) = abs(cosh(sin(((if ((y*py) < a) && (((1 - a)*px) < a) { exp_m1(sin((asinh(((1/2)^(2/3))) + (a/(if !((py + pi) <= t) { asin((a/(1 + (a^2)))) } else { py }))))) } else { min((b + y), pow((((b*asinh(((1/2)^(2/3))))^2) + 1), cos(b))) }) + tanh(b)))))
}

hamiltonian! {
    pub struct E86 { a, b, c }
    H(x, y; px, py; t) = (if (5 <= px) { (hypot(px, (c*b))/abs((if ((3*(pi - c)) <= px) || (pow(((b^2) + (px^2)), c) < px) { erf(a) } else { (abs(((t + 3) + b))^(3/10)) }))) } else { (px + (5 + x)) })
}

hamiltonian! {
    pub struct E87 { a, b, c }
    H(x, y; px, py; t) = (((if ((px + py) == px) { atan2(py, b) } else { px })*sqrt(((((a - (((erf(b)^2) + 1)^-1))*py)^2) + (c^2)))) + (((exp_m1(((((abs((b*(3*x)))^(1/2))^2) + 2)^(1/2)))*(c - c))*((981/100) - x)) + cosh((pi/a))))
}

hamiltonian! {
    pub struct E88 { a, b, c }
    H(x, y; px, py; t) = (((3*(if ((a/(c - y)) == px) || (px < a) { c } else { cbrt((a*a)) })) + x) - tanh((px - (-7/4))))
}

hamiltonian! {
    pub struct E89 { a, b, c }
    H(x, y; px, py; t) = ((y*asinh(acos(tanh(t))))*(((1*erfc((t/exp((((px^2) + 2)^-2)))))*1)*b))
}

hamiltonian! {
    pub struct E90 { a, b, c }
    H(x, y; px, py; t) = ((if !(tan(tanh(py)) <= py) { (-py) } else { ((-(((abs(1)^(2/3)) - (-py)) + (cos(a) + (tanh((981/100)) + (cosh(cos(px))^-2))))) + exp((5 + py))) }) + asin(sin((b - (if ((((b^2) + (1/4))^(-1/2)) <= y) { (y*(x + x)) } else { acosh(((((abs(pi)^(3/10))^2) + 2) + 1)) })))))
}

hamiltonian! {
    pub struct E91 { a, b, c }
    H(x, y; px, py; t) = ((c - (pow(exp(px), sqrt(abs(min(t, y))))*x)) + (x/c))
}

hamiltonian! {
    pub struct E92 { a, b, c }
    H(x, y; px, py; t) = (if (max(py, (-7/4)) < b) || ((a*b) < px) { y } else { sqrt(abs(min(t, t))) })
}

hamiltonian! {
    pub struct E93 { a, b, c }
    H(x, y; px, py; t) = (hypot((-hypot((py/((px^2) + (pi^2))), px)), min((if (c < t) { ((c/pi) - a) } else { px }), px)) + (((acosh((abs(sinh((if ((a - 2) < y) { 3 } else { ((sinh(atan((pi*exp(cos(a))))) + 1) + sinh(y)) }))) + 1))*y)^2)*atanh(((-((((((x^2) + (1/4))^(13/4))^4)*exp(cos(a)))*atan2(x, (c/(max(y, (1/2))/abs((1/3)))))))/(1 + ((-((((((x^2) + (1/4))^(13/4))^4)*exp(cos(a)))*atan2(x, (c/(max(y, (1/2))/abs((1/3)))))))^2))))))
}

hamiltonian! {
    pub struct E94 { a, b, c }
    H(x, y; px, py; t) = (ln_1p(abs(max(x, x)))*(a*py))
}

hamiltonian! {
    pub struct E95 { a, b, c }
    H(x, y; px, py; t) = (if !(acosh((abs((px/((a^2) + 1))) + 1)) < x) { (2/1) } else { ((-px)^2) })
}

hamiltonian! {
    pub struct E96 { a, b, c }
    H(x, y; px, py; t) = (((t - c)/abs(((((if (((py*py) + t) <= (py*py)) { (t - c) } else { c }) + b)*c)*pi))) + ((if ((2 - (((pi^2) + 1)^(3/10))) == y) { (sign(x) + b) } else { (((erfc(b)^-3)*max(y, (if (((if (b <= a) && ((981/100) < x) { t } else { y }) + 1) <= y) { (abs(t)^(3/2)) } else { x }))) + asin(((c/hypot((1/10), c))/(1 + ((c/hypot((1/10), c))^2))))) })/(((-asin(tanh(b)))^2) + 2)))
}

hamiltonian! {
    pub struct E97 { a, b, c }
    H(x, y; px, py; t) = (((x/(((y - ((sin(py) + c)*py))^2) + 1))*(b - (((y - ((sin(py) + c)*py))^2) + 1)))^3)
}

hamiltonian! {
    pub struct E98 { a, b, c }
    H(x, y; px, py; t) = min(px, (if !(tan(sin(exp_m1(tanh((1/3))))) < x) { a } else { (c - tanh((1/3))) }))
}

hamiltonian! {
    pub struct E99 { a, b, c }
    H(x, y; px, py; t) = (exp(tanh(((px*cos((((c + py) - tanh(py)) - px)))^5))) + cbrt((((if ((x + (-1)) < x) { ((t*(-1))*x) } else { x })*(a + pi))^3)))
}

hamiltonian! {
    pub struct E100 { a, b, c }
    H(x, y; px, py; t) = tanh((if (acosh((abs((1*(-1))) + 1)) < c) { (t*y) } else { ((hypot((1/2), 2)*pi) - ((-(1/2)) + (c*(c + py)))) }))
}

hamiltonian! {
    pub struct E101 { a, b, c }
    H(x, y; px, py; t) = (((c + b) + hypot(pi, pi)) - asinh((((hypot(pi, pi)*t)*((t/(py + asinh(a))) - ln_1p(exp(tanh((b + (y*hypot(pi, pi)))))))) - atan2((py - x), (a + py)))))
}

hamiltonian! {
    pub struct E102 { a, b, c }
    H(x, y; px, py; t) = ((((((py + py) - (py + px))/((((if (acosh(((((if (px <= px) || (3 < py) { c } else { px })^2) + 2) + 1)) <= t) || ((py - (px*px)) < a) { c } else { c }) - py)^2) + (1/4))) - ((1/2) + c)) - sinh((if (asin(cos(px)) < t) || (erfc((1/10)) <= (-1)) { (if (py <= a) && (erfc(py) < (-1)) { (((1/3)*c) + ((cos(px)*c) + (if (py < px) { (px*sign(px)) } else { (py + t) }))) } else { c }) } else { ((((cos(py) + (py*((px + ((b + 5) - (a*sqrt(((1^2) + (1/4))))))^3)))^2) + 2)^(-4/3)) }))) + min((y - x), ((((-1) + a)*erf(x))*erfc(((if (t <= a) { erfc(((exp(tanh(atan2(y, b)))^(3/10))/((a + (((((-1)^2) + (3^2))^(1/2)) + 1))^2))) } else { ((exp(tanh(atan2(y, b)))^(3/10))*(b - a)) }) - (if (t <= b) { x } else { (-7/4) }))))))
}

hamiltonian! {
    pub struct E103 { a, b, c }
    H(x, y; px, py; t) = (sign(atanh((hypot((a*py), (y/((min(py, t)^2) + (a^2))))/(1 + (hypot((a*py), (y/((min(py, t)^2) + (a^2))))^2)))))^-2)
}

hamiltonian! {
    pub struct E104 { a, b, c }
    H(x, y; px, py; t) = ln_1p((((((if ((c/((3^2) + (1/4))) <= py) { (if !(sinh(atan(t)) <= x) { y } else { pi }) } else { py })*(y + (t + y)))*hypot((1/3), (x + (1/3))))^2) + 1))
}

hamiltonian! {
    pub struct E105 { a, b, c }
    H(x, y; px, py; t) = (((((tanh(c) + ((c*((t - pi) - px)) + (if !(t <= (1/3)) { px } else { c })))^2) + 1)^(2/3)) + ((((((-7/4) - a)^2) + 2)^(2/3))^6))
}

hamiltonian! {
    pub struct E106 { a, b, c }
    H(x, y; px, py; t) = (if ((atan(y)*y) <= 2) || ((sinh(c)^5) <= x) { (acosh(((((y/t)^2) + (1/4)) + 1))^2) } else { px })
}

hamiltonian! {
    pub struct E107 { a, b, c }
    H(x, y; px, py; t) = sin((y/(acosh((abs((py + (if (b <= t) { ln(((t^2) + 2)) } else { (-1) }))) + 1))*tanh((-x)))))
}

hamiltonian! {
    pub struct E108 { a, b, c }
    H(x, y; px, py; t) = (((if (1 == py) { ((((c + 1)^2) + (1/4))^(13/4)) } else { b })^7) + (((x*x)*y) - (if !(tan(cos((((t^2) + 1)^-2))) <= y) { a } else { hypot(pi, t) })))
}

hamiltonian! {
    pub struct E109 { a, b, c }
    H(x, y; px, py; t) = ((((if !((a*((1/2)*py)) < a) { erfc((if ((pow(abs(px), sin(px))*py) <= a) || (x <= b) { (if (y < (1/2)) || (c <= (981/100)) { t } else { (981/100) }) } else { t })) } else { (-(tan(b)^6)) })^2) + 2)^(5/2))
}

hamiltonian! {
    pub struct E110 { a, b, c }
    H(x, y; px, py; t) = (if (ln(abs((c/c))) < (-1)) || (pow(abs(x), acosh((abs((-1)) + 1))) <= py) { ((t*py)/((((((y^2) + (1/4))^(-7/5)) - ((if ((((c^2) + (c^2))^(-7/5)) <= y) { (t + (981/100)) } else { px })*py))^2) + (b^2))) } else { (b*max((((c^2) + (c^2))^(-7/5)), pow(abs(1), sin(c)))) })
}

hamiltonian! {
    pub struct E111 { a, b, c }
    H(x, y; px, py; t) = (((if (t <= px) { sqrt((((if !(py <= px) { 3 } else { py })^2) + (1/4))) } else { (pi*min((px - a), t)) }) + ((1 + (-1))*px)) + ((abs(((((((1/10)^2) + 1)^(-7/5)) - c)*(if (y < b) { (c + (1/3)) } else { (b^(-7/5)) })))^(1/2)) - ((1/3)/(3*y))))
}

hamiltonian! {
    pub struct E112 { a, b, c }
    H(x, y; px, py; t) = ((((pi^3) + a)/px)*(abs((a + (((c*(((pi^3) + a)/px)) + py) - (y - px))))^(3/10)))
}

hamiltonian! {
    pub struct E113 { a, b, c }
    H(x, y; px, py; t) = min((-atan2(py, py)), ((((-y)^(3/10)) + 2) + (pow(((((-y)^(3/10))^2) + (1/4)), atan((x^7)))*atan2(py, py))))
}

hamiltonian! {
    pub struct E114 { a, b, c }
    H(x, y; px, py; t) = ((abs(((px + (py - b))/((((ln(((((1/10)/(c + (5 - (1/2))))^2) + 1))^2) + 2)^(3/10))^4)))^(-3/2)) + (a + atan2(t, ((981/100)/cosh(atan(t))))))
}

hamiltonian! {
    pub struct E115 { a, b, c }
    H(x, y; px, py; t) = hypot((if (y < t) || (((1/3) + t) == (x + a)) { ((-5) - 2) } else { ((5 - px) - tan(cos((asinh(py)/cosh(cos((x + a))))))) }), py)
}

hamiltonian! {
    pub struct E116 { a, b, c }
    H(x, y; px, py; t) = ((x*x)*(pi*py))
}

hamiltonian! {
    pub struct E117 { a, b, c }
    H(x, y; px, py; t) = ((if ((py/((px^2) + 2)) < b) || (px < a) { (((1/10) - (b*c))^2) } else { (((a*b) + py) - c) }) + (((y*a)/pow(((x^2) + 1), x))*t))
}

hamiltonian! {
    pub struct E118 { a, b, c }
    H(x, y; px, py; t) = (exp(((1^3) + px))*(py + ln_1p(abs((5*x)))))
}

hamiltonian! {
    pub struct E119 { a, b, c }
    H(x, y; px, py; t) = erfc(exp_m1(sin((if (max(py, px) < y) && ((-(c - cosh(sin(((b - t)*a))))) <= t) { a } else { cos(cosh(sin(((b - t)*a)))) }))))
}

hamiltonian! {
    pub struct E120 { a, b, c }
    H(x, y; px, py; t) = ((-(((atan(py)^2) + (1/4))^(2/3))) + (tanh(atan2(atan2((erf((((((y^2) + 2)^(5/2))/((a^2) + 1)) + (-7/4)))/((x^2) + 2)), ((a^2) + 1)), acosh((((tanh((c*x))^2) + 2) + 1))))*(if !((b + (x*x)) < y) { b } else { c })))
}

hamiltonian! {
    pub struct E121 { a, b, c }
    H(x, y; px, py; t) = hypot(pow(((px^2) + (t^2)), px), (((b + y) - (-px)) + ((pi + px) - (acos((((1/10)*((1/2) + px))*c))/(-1)))))
}

hamiltonian! {
    pub struct E122 { a, b, c }
    H(x, y; px, py; t) = ((if (5 <= y) { (((px*tan((a - 2))) + b) + c) } else { y }) + (x - (c*c)))
}

hamiltonian! {
    pub struct E123 { a, b, c }
    H(x, y; px, py; t) = ((cos((-7/4)) - min(c, (((tanh(b)^2) + (px^2))^(-7/5)))) + acosh((((cbrt((tanh(((if (sign((981/100)) < y) && (asinh(b) <= c) { y } else { (y + b) }) + c)) - exp(atan(sin(c)))))^2) + 1) + 1)))
}

hamiltonian! {
    pub struct E124 { a, b, c }
    H(x, y; px, py; t) = (((asin(y) + (py^3)) + ((if (b < t) && (((-1) - py) <= (981/100)) { y } else { pi }) + ((((if (erfc(y) <= py) { x } else { b })^2) + 1)^-3)))^5)
}

hamiltonian! {
    pub struct E125 { a, b, c }
    H(x, y; px, py; t) = ln_1p((((((atan2(exp_m1(exp_m1((a*((((((y^2) + 1)^(-7/5))^2) + 1)^(-7/5))))), erfc(cosh(tanh(px))))^2) + (a^2))^-3)^2) + 2))
}

hamiltonian! {
    pub struct E126 { a, b, c }
    H(x, y; px, py; t) = ((py*(a*a)) + ((((y + (c*t))/((t^2) + 2))*(-7/4)) + (5 + y)))
}

hamiltonian! {
    pub struct E127 { a, b, c }
    H(x, y; px, py; t) = hypot((if ((x*a) < px) { (((c*y) + asin(((-(c - b))/(1 + ((-(c - b))^2))))) + (1/2)) } else { (-((py - 2) + sinh((a/abs(2))))) }), (c + tanh(min((atan(py)/((((x - c) - atan2(b, x))^2) + ((1/2)^2))), (c - b)))))
}

hamiltonian! {
    pub struct E128 { a, b, c }
    H(x, y; px, py; t) = ((if !(((((pi - t)^2) + 2)^(-7/5)) < pi) { (if (sqrt((((x - pi)^2) + (x^2))) < y) { hypot(b, b) } else { ((b - (1/10)) - (erf(px)*erfc(b))) }) } else { x })^2)
}

hamiltonian! {
    pub struct E129 { a, b, c }
    H(x, y; px, py; t) = ((((abs(((if ((py*(b + px)) <= (1/2)) { px } else { py }) + b))^(3/2)) + t) + (-abs((py + pi)))) + ln((((((-(acosh((((c^2) + (b^2)) + 1))*b)) + sign((if (((b^2)*y) < a) || ((if !(((c^2) + (b^2)) < 5) { (1/10) } else { pi }) < (-1)) { y } else { b })))*((sign(b)^(-4/3))/hypot(a, (y - (y^-3)))))^2) + ((1/2)^2))))
}

hamiltonian! {
    pub struct E130 { a, b, c }
    H(x, y; px, py; t) = (if !((-(x + px)) <= t) { (((c*3) - erfc(((x + b)^7))) - ((1/2)/cosh(ln_1p((((py + y)^2) + 2))))) } else { y })
}

hamiltonian! {
    pub struct E131 { a, b, c }
    H(x, y; px, py; t) = atan((((((y*(((t^2) + 1)^-3))^2) + (py^2))^(3/10))/cosh((pi*((1/10)^3)))))
}

hamiltonian! {
    pub struct E132 { a, b, c }
    H(x, y; px, py; t) = (tan(sin((a + (a + (b - min(5, pow(py, cos(a)))))))) + (-((((if ((x/((y^2) + 1)) < c) || ((-1) < x) { (981/100) } else { ((981/100)*b) })^2) + 1)^(-3/2))))
}

hamiltonian! {
    pub struct E133 { a, b, c }
    H(x, y; px, py; t) = (abs((((if (pi < px) || ((-(1^5)) < pi) { c } else { (((x^2) + 2)^(1/3)) }) + 1)*((px/cosh(sin((c^4))))*a)))^(1/2))
}

hamiltonian! {
    pub struct E134 { a, b, c }
    H(x, y; px, py; t) = (hypot(y, (py - c))*py)
}

hamiltonian! {
    pub struct E135 { a, b, c }
    H(x, y; px, py; t) = (((b*(if (((c*py) + b) <= (c*py)) { sign(pi) } else { py }))/abs(b)) + (ln_1p(((pow(abs(a), sin((-7/4)))^2) + 1)) + y))
}

hamiltonian! {
    pub struct E136 { a, b, c }
    H(x, y; px, py; t) = (((-y)*(x*py)) - (x^(3/10)))
}

hamiltonian! {
    pub struct E137 { a, b, c }
    H(x, y; px, py; t) = (exp_m1(cos(((((-1)*(-1))/px)*ln(((c*t) - a)))))*y)
}

hamiltonian! {
    pub struct E138 { a, b, c }
    H(x, y; px, py; t) = ((((pow(abs(py), c)^4)*((tanh(sin(((py + t)^3))) + tanh(atan2((px*b), sqrt((((px*py)^2) + 1))))) - (c + b)))^-3) + tanh((((x*2)/exp(tanh((cbrt((c - b))/erfc((2/(((x + t)^2) + (1/4)))))))) - x)))
}

hamiltonian! {
    pub struct E139 { a, b, c }
    H(x, y; px, py; t) = ln(((atanh((((((x^2) + (1/4))^(-1/2))*(((cos((if (y < t) && (abs(px) < y) { 2 } else { b })) - (b^-1)) - py)*c))/(1 + (((((x^2) + (1/4))^(-1/2))*(((cos((if (y < t) && (abs(px) < y) { 2 } else { b })) - (b^-1)) - py)*c))^2))))^2) + (a^2)))
}

hamiltonian! {
    pub struct E140 { a, b, c }
    H(x, y; px, py; t) = (atan(((exp(((((a*(t - (y - c)))^2) + 1)^(-1/2)))*pow(((b^2) + 1), py))*((tanh(exp(tanh(py)))/exp(cos(px)))*(if !(((1/10)*(1/10)) < py) { x } else { px }))))^2)
}

hamiltonian! {
    pub struct E141 { a, b, c }
    H(x, y; px, py; t) = ((-(((t*(a - py)) + a)/((b^2) + 2))) + ((erf(x) + b)*((c*y) + ((c + ln_1p(((((sinh(b)^4) + a)^2) + 1)))*x))))
}

hamiltonian! {
    pub struct E142 { a, b, c }
    H(x, y; px, py; t) = (atanh(tanh((c*(cosh(((-(if (acosh(((((c/(((1/10)^2) + 1))^2) + (1/4)) + 1)) < b) { 1 } else { (5 + (if (cosh(atan((b*py))) < b) || ((c - y) < px) { py } else { ln(((cosh(exp(tanh((-7/4))))^2) + (px^2))) })) })) + cbrt((-(if (pi < t) { a } else { (py/((c^2) + (1/4))) })))))^(-4/3)))))*(((-(if (pi < t) { a } else { (py/((c^2) + (1/4))) })) + y) + px))
}

hamiltonian! {
    pub struct E143 { a, b, c }
    H(x, y; px, py; t) = (((a*px) - y)*(py + ((py*(px + 1)) + (-(c^3)))))
}

hamiltonian! {
    pub struct E144 { a, b, c }
    H(x, y; px, py; t) = (((if !((-7/4) <= c) { exp_m1(atan(tanh((if (((if (b < px) { (981/100) } else { b })*c) <= px) || (t < py) { px } else { b })))) } else { (1/10) }) + (sqrt(((t^2) + 2)) + px)) + (cos(sin((x + (t + (sqrt(((a^2) + 1)) - ((((1/3)^2) + 2)^(3/10)))))))/(c - pi)))
}

hamiltonian! {
    pub struct E145 { a, b, c }
    H(x, y; px, py; t) = (a - ((if ((y + c) <= py) || ((((y + c) + py) + px) < px) { x } else { py })^2))
}

hamiltonian! {
    pub struct E146 { a, b, c }
    H(x, y; px, py; t) = (-((if !((b*(if (2 <= y) { 3 } else { px })) <= y) { a } else { x }) - (ln(exp(pi)) - (-(exp_m1(py) + c)))))
}

hamiltonian! {
    pub struct E147 { a, b, c }
    H(x, y; px, py; t) = (erf((-((c*((atanh(((c^-3)/(1 + ((c^-3)^2))))*py)*((c*py)^2))) + (exp(atan((min(b, a) + c)))*exp(tanh((((abs((b/exp(tanh((a/px)))))^(-1/2))*b) + atan(((a*atan2(c, a))^2))))))))) + (if ((x*(x + y)) < 5) { exp_m1(sin(pow(((b^2) + (1/4)), cos(((x*t)/(abs(ln_1p(((x^2) + 2)))^(2/3))))))) } else { (((if ((x + (1/3)) <= t) || (min(t, (if !((b - y) <= a) { t } else { y })) <= 1) { (981/100) } else { atanh(cos(c)) }) + (-y)) + (y + (y/((x^2) + 2)))) }))
}

hamiltonian! {
    pub struct E148 { a, b, c }
    H(x, y; px, py; t) = acosh(((((abs((if !(y <= (981/100)) { acos(sin(c)) } else { c })) + (ln(((if ((x^-2) < 5) { (a*(if !(c < a) { (1/2) } else { x })) } else { b })*((y/((a^2) + 1)) + (c/exp(1)))))*(((py*py)*atan2(2, (x - y))) + (if !((3^5) <= t) { (t + b) } else { py }))))^2) + 2) + 1))
}

hamiltonian! {
    pub struct E149 { a, b, c }
    H(x, y; px, py; t) = atan(ln_1p(((sign(atanh(sin(hypot(hypot(a, acos(tanh(((((a^2) + 1)^(3/2)) - c)))), min(acos((tanh((pi^7))/(1 + (tanh((pi^7))^2)))), ((x*(a - c)) - (px/y)))))))^2) + 2)))
}

hamiltonian! {
    pub struct E150 { a, b, c }
    H(x, y; px, py; t) = (((-(if ((if !(acosh((abs(a) + 1)) <= py) { b } else { (b - (1/3)) }) < py) { atanh(cos((min(t, 3)^-2))) } else { (((((-py)/px)/((py*asin((atanh(cos((min(t, 3)^-2)))/(1 + (atanh(cos((min(t, 3)^-2)))^2)))))*pi))/(981/100))^7) })) + (erf(pi)^-2)) + (((x*(c/(-1))) + b)^6))
}

hamiltonian! {
    pub struct E151 { a, b, c }
    H(x, y; px, py; t) = (((x + b) + (abs(((1/3)*b))^-1))*((asinh(px)*px)*abs(py)))
}

hamiltonian! {
    pub struct E152 { a, b, c }
    H(x, y; px, py; t) = (((((px^2) + (a^2))^(5/2)) + (exp_m1(sin((y - (cosh(x)*py)))) - a))/abs(cos((a^2))))
}

hamiltonian! {
    pub struct E153 { a, b, c }
    H(x, y; px, py; t) = (cosh(sin(((((px/c) - abs((-7/4))) + asin((py/(1 + (py^2))))) - px))) + exp_m1(sin(cbrt(cos((pi + ((hypot(a, x) + (1/2))*(a - (y + b)))))))))
}

hamiltonian! {
    pub struct E154 { a, b, c }
    H(x, y; px, py; t) = (x*(if (cbrt((((5^2) + (1/4))^(-4/3))) <= x) && (((1 + c) + t) < px) { py } else { (pi*pi) }))
}

hamiltonian! {
    pub struct E155 { a, b, c }
    H(x, y; px, py; t) = ln((((y/(a - erfc(((((((a/x)*(py*a)) + erfc(t))^2) + 1)^(2/3)))))^2) + 2))
}

hamiltonian! {
    pub struct E156 { a, b, c }
    H(x, y; px, py; t) = (sqrt(((((-(px/((t^2) + (1/4))))^2)^2) + 1)) + (3*acos(((asin((if (x < x) || (sign(((-7/4) + b)) <= t) { ((b*x)/(x - pi)) } else { (if (t <= y) && ((y*t) <= y) { x } else { acosh((cosh(tanh(ln(((y^2) + 2)))) + 1)) }) })) + pi)/(1 + ((asin((if (x < x) || (sign(((-7/4) + b)) <= t) { ((b*x)/(x - pi)) } else { (if (t <= y) && ((y*t) <= y) { x } else { acosh((cosh(tanh(ln(((y^2) + 2)))) + 1)) }) })) + pi)^2))))))
}

hamiltonian! {
    pub struct E157 { a, b, c }
    H(x, y; px, py; t) = sinh((if !(((a + (-1))/py) <= (981/100)) { x } else { (min(((if ((px*(-1)) < x) || (py <= t) { a } else { px })*py), ((px*(-1)) + y)) + (a*((abs(c)^-2)*py))) }))
}

hamiltonian! {
    pub struct E158 { a, b, c }
    H(x, y; px, py; t) = (min((981/100), c) - (if ((b + y) <= c) || (y <= py) { c } else { sign(t) }))
}

hamiltonian! {
    pub struct E159 { a, b, c }
    H(x, y; px, py; t) = (tanh((exp_m1(atan(exp((px + (b + py))))) + px)) + cos(ln(((tan(tanh((x + pi)))^2) + (1/4)))))
}

hamiltonian! {
    pub struct E160 { a, b, c }
    H(x, y; px, py; t) = ((((if (a == py) { a } else { y })/(((((t + (1/2))^5) + y)^2) + 1)) + (b*y)) + (py + c))
}

hamiltonian! {
    pub struct E161 { a, b, c }
    H(x, y; px, py; t) = (if !((((y^2) + (1/4))^-2) <= 3) { (y*(((y - a) + b) - b)) } else { (c + (sin((py*t))*b)) })
}

hamiltonian! {
    pub struct E162 { a, b, c }
    H(x, y; px, py; t) = (((-((px - b)*a)) - ((py - tan((c - 2))) + (if ((px + py) <= px) && (a < t) { (px - b) } else { c }))) + pow(abs(cos(b)), cos(min(exp_m1(atan((-cos(b)))), ((max(acos((t/(1 + (t^2)))), (c + y))^2) - ((b/exp((((max(acos((t/(1 + (t^2)))), (c + y))^2) + c) - (-1)))) - y))))))
}

hamiltonian! {
    pub struct E163 { a, b, c }
    H(x, y; px, py; t) = exp_m1(sin(((c - (cbrt((x/((py^2) + 2))) + b))^-1)))
}

hamiltonian! {
    pub struct E164 { a, b, c }
    H(x, y; px, py; t) = hypot((asinh(x)/exp(atan(c))), px)
}

hamiltonian! {
    pub struct E165 { a, b, c }
    H(x, y; px, py; t) = ((cosh(py)*(abs(cos(((t*px)*(abs(((t*t)*(981/100)))^(1/2)))))^(-1/2))) + ((x - y) + (-7/4)))
}

hamiltonian! {
    pub struct E166 { a, b, c }
    H(x, y; px, py; t) = ((py - y)*((((-7/4)*(abs(((((acos((x/(1 + (x^2)))) - (y + 2))^2) + (1/4))^-1))^(1/2)))*x)/py))
}

hamiltonian! {
    pub struct E167 { a, b, c }
    H(x, y; px, py; t) = ((if ((sin(px)*a) < x) { a } else { (c*3) })*y)
}

hamiltonian! {
    pub struct E168 { a, b, c }
    H(x, y; px, py; t) = (((py + sinh(px))/exp(tanh(c))) + (((t*y)/((t*(1/10))/(((c + acos(sin(x)))^2) + (t^2))))*((y/a) + (t - t))))
}

hamiltonian! {
    pub struct E169 { a, b, c }
    H(x, y; px, py; t) = (cosh(tanh((((erf((-erfc(min((ln(((acos(c)^2) + (c^2)))/(((if (cbrt((if (((((-1)^2) + (c^2))^-1) <= py) && (x <= (1/3)) { px } else { 5 })) < py) && ((((-7/4)*y) + a) == y) { ((1/10) + (sin((pi + c)) + y)) } else { t })^2) + 1)), (pi^2)))))^2) + 2)^(-7/5))))/cosh((((c^2) - y) - y)))
}

hamiltonian! {
    pub struct E170 { a, b, c }
    H(x, y; px, py; t) = ((c*pow(((py^2) + ((981/100)^2)), b)) + ((-(-((y*(c*pow(((py^2) + ((981/100)^2)), b)))/cosh(y)))) + exp_m1(cos((((c^2) + (x^2))^(-1/2))))))
}

hamiltonian! {
    pub struct E171 { a, b, c }
    H(x, y; px, py; t) = (((abs(asin((pow(((exp(atan(asinh(((1/3)*px))))^2) + (1/4)), (((((py*((py + ((((5^2) + ((1/10)^2))^(-3/2))*b)) - px))^2) + 1)^(-4/3)) + (b - (b*b))))/(1 + (pow(((exp(atan(asinh(((1/3)*px))))^2) + (1/4)), (((((py*((py + ((((5^2) + ((1/10)^2))^(-3/2))*b)) - px))^2) + 1)^(-4/3)) + (b - (b*b))))^2)))))^(2/3))^2) + ((t*x) - 2))
}

hamiltonian! {
    pub struct E172 { a, b, c }
    H(x, y; px, py; t) = ((py - (y + b))*(if !(a < c) { (if (c <= t) || ((t - (t/((y^2) + (py^2)))) == px) { py } else { 1 }) } else { 1 }))
}

hamiltonian! {
    pub struct E173 { a, b, c }
    H(x, y; px, py; t) = ((y - tan(c))*(min(py, x) - (y*erfc(sign((a + hypot(t, t)))))))
}

hamiltonian! {
    pub struct E174 { a, b, c }
    H(x, y; px, py; t) = (abs(((atanh(((-px)/(1 + ((-px)^2))))*py)*(px + py))) + sin((((acosh((abs(((((x*((b/((c^2) + (c^2)))/((t^2) + ((1/10)^2))))^2) + 1)^(-3/2))) + 1))^2) + (a^2))^(3/2))))
}

hamiltonian! {
    pub struct E175 { a, b, c }
    H(x, y; px, py; t) = ((if (x < b) && (x < (1/3)) { c } else { x }) - (if !(((pi + 1) + py) <= c) { acos((((if !(erfc(c) == b) { erfc((tanh(pow((((-(cosh((py*(1/10)))^2))^2) + 1), tanh(pi))) + px)) } else { t })/(((c + ((1/2) + 1)) + c) - ((c + (py + (-sign(a)))) + (y*x))))/(1 + (((if !(erfc(c) == b) { erfc((tanh(pow((((-(cosh((py*(1/10)))^2))^2) + 1), tanh(pi))) + px)) } else { t })/(((c + ((1/2) + 1)) + c) - ((c + (py + (-sign(a)))) + (y*x))))^2)))) } else { ((x + x)/abs(((1/10) + b))) }))
}

hamiltonian! {
    pub struct E176 { a, b, c }
    H(x, y; px, py; t) = (((((abs(py)^(3/10))*x)^2) + (c^2))^(-4/3))
}

hamiltonian! {
    pub struct E177 { a, b, c }
    H(x, y; px, py; t) = ((((t - (py*py)) + py) + cos((sqrt(abs(c))/abs(((1/2) - px))))) + ((-7/4) + erfc(((-x) + acos((cosh(sin((x*((((((-7/4) - (-7/4)) + (-7/4)) - b) + x) - (1/10)))))^(1/3)))))))
}

hamiltonian! {
    pub struct E178 { a, b, c }
    H(x, y; px, py; t) = (((c^4)*c) - ((-pow(abs(y), atan(c)))/cosh(sin(((py^6)*(pi/(((1/10)^2) + 1)))))))
}

hamiltonian! {
    pub struct E179 { a, b, c }
    H(x, y; px, py; t) = min((if (y <= py) && (((if !((2 + pi) <= b) { b } else { a }) + 2) < t) { atan2((3*2), y) } else { (ln(abs(b))/b) }), (t + b))
}

hamiltonian! {
    pub struct E180 { a, b, c }
    H(x, y; px, py; t) = (asinh(((atan2(a, cosh((px - a))) + (((py + py)*b)*ln((((if (py < px) { (1/10) } else { (1/10) })^2) + 1)))) + min((a - acos((((1/2) - px)/(1 + (((1/2) - px)^2))))), (py*c)))) + (cosh(((1/3) + x)) - ((y*(x + ((((981/100)*(-1)) + a)/((y^2) + 1))))^-1)))
}

hamiltonian! {
    pub struct E181 { a, b, c }
    H(x, y; px, py; t) = (((c*((a - py) + x))*exp(pi))*pow(exp(cos((y*py))), sin((c + py))))
}

hamiltonian! {
    pub struct E182 { a, b, c }
    H(x, y; px, py; t) = min((if (((1/2)/(1/2)) < b) && (px <= px) { py } else { 2 }), sign((if ((c + b) < x) || (((2/(((1/10)^2) + 2))*py) <= (-7/4)) { tan(tanh((if ((y + (px + a)) <= x) { a } else { y }))) } else { cosh(sin((py - t))) })))
}

hamiltonian! {
    pub struct E183 { a, b, c }
    H(x, y; px, py; t) = ((erf(sin((cos(b) - exp(((c/(py^-1))*px)))))*(cosh(((((a - c)^2) + (1/4))^(1/2)))^-2)) + (-((y*(acosh((abs(y) + 1)) + (y/y))) + (-7/4))))
}

hamiltonian! {
    pub struct E184 { a, b, c }
    H(x, y; px, py; t) = min((a - (pi*(2*((c*x) + py)))), exp_m1(tanh((1/10))))
}

hamiltonian! {
    pub struct E185 { a, b, c }
    H(x, y; px, py; t) = ((((c + (((((c*((1/3) + x)) - a)/((asinh(((-(1/2)) + b))^2) + 1))*py)*atan2((py - (1/3)), px)))^2) + (1/4))^(-7/5))
}

hamiltonian! {
    pub struct E186 { a, b, c }
    H(x, y; px, py; t) = (tan(tanh((exp(tanh(tan(px)))*((if !((-(px + c)) < c) { (b + t) } else { (b + t) }) - py)))) + ((c - c) - sin((x*y))))
}

hamiltonian! {
    pub struct E187 { a, b, c }
    H(x, y; px, py; t) = ((((pi - t) + a) - (if (((py*b)^3) <= b) { tan(c) } else { (if (((abs((1/2))^(-7/5)) + a) < x) && (((abs((1/2))^(-7/5)) + a) <= b) { c } else { px }) })) - a)
}

hamiltonian! {
    pub struct E188 { a, b, c }
    H(x, y; px, py; t) = (cbrt(cbrt(atanh((b/(1 + (b^2))))))*pow(cosh(atan((py + x))), (-((px/py)^2))))
}

hamiltonian! {
    pub struct E189 { a, b, c }
    H(x, y; px, py; t) = (sign((-((((-((((py*px) - (c/cosh(atan(pi)))) - cosh(b))*b))^2) + 1)^(2/3)))) + max(cosh(cos(ln_1p(((y^2) + 2)))), (x + b)))
}

hamiltonian! {
    pub struct E190 { a, b, c }
    H(x, y; px, py; t) = ((y*1)*sin(((c*b) + py)))
}

hamiltonian! {
    pub struct E191 { a, b, c }
    H(x, y; px, py; t) = (abs(((((atanh(((py*b)/(1 + ((py*b)^2)))) + ((x*atan2((px*a), py))^2))^2) + (x^2))^(-7/5)))^(13/4))
}

hamiltonian! {
    pub struct E192 { a, b, c }
    H(x, y; px, py; t) = ((cos(pow(((3^2) + 2), b)) - (((a/(-7/4))/((((b - a)*py)^2) + (1/4)))^5)) + ((abs(((x*((t + t) - (2^5)))^2))^(-1/2)) - x))
}

hamiltonian! {
    pub struct E193 { a, b, c }
    H(x, y; px, py; t) = (((b/cosh(tanh(a))) + atan2((sin((px/((atan2(b, px)^2) + 2)))^7), (c*hypot(py, y)))) + (t*3))
}

hamiltonian! {
    pub struct E194 { a, b, c }
    H(x, y; px, py; t) = atan2((b - py), x)
}

hamiltonian! {
    pub struct E195 { a, b, c }
    H(x, y; px, py; t) = ((-(if (((((1*py)^2) + ((1*py)^2))^(-3/2)) < a) && (atan(t) <= px) { (px - (((if ((if (asin(b) < px) { py } else { c }) < a) && (ln_1p(abs((1/10))) <= pi) { px } else { ((if (sign(cbrt(py)) <= px) { py } else { px })/px) }) + a) - 5)) } else { px })) + ((1*y)*((2 + (abs((a + x))^(3/2)))*(x + (pi + y)))))
}

hamiltonian! {
    pub struct E196 { a, b, c }
    H(x, y; px, py; t) = (-(max((min((t + y), 5) + min((t + y), 5)), (x + (t^6)))*(px*b)))
}

hamiltonian! {
    pub struct E197 { a, b, c }
    H(x, y; px, py; t) = cos((if (px < x) { atan2(px, px) } else { (a^-3) }))
}

hamiltonian! {
    pub struct E198 { a, b, c }
    H(x, y; px, py; t) = (((py/((5^2) + 2)) + ((((pi*t)/c)*px)*(if ((if ((py + cos(b)) < py) && ((atan(a) + a) < t) { px } else { (if !(((if ((px^2) <= py) || ((px - t) <= pi) { px } else { py })^6) <= py) { a } else { py }) }) < px) && ((-c) <= t) { tanh((px - (1/2))) } else { b }))) + tanh((y - ((((y + asin((b*x))) + x)^5)*y))))
}

hamiltonian! {
    pub struct E199 { a, b, c }
    H(x, y; px, py; t) = (((ln_1p(cosh(tanh(a))) - t) - (((((if (y == x) { max(((x/c) - y), px) } else { (if (tanh(a) <= a) && ((((atan(x)^2) + (1/4))^(13/4)) < a) { b } else { (981/100) }) })^2) + (1/4))^(2/3))*(((x*py)*(px*(y + px)))^3)))^6)
}

hamiltonian! {
    pub struct E200 { a, b, c }
    H(x, y; px, py; t) = sinh(tanh((if ((pi/((t^2) + (1/4))) < px) { (b + ((t/((b^2) + 1)) + x)) } else { (t/tanh(px)) })))
}

hamiltonian! {
    pub struct E201 { a, b, c }
    H(x, y; px, py; t) = ((((sin((px + (py^7))) + c) + (if (py <= 5) { (atanh(sin(5)) - (-1)) } else { tan(px) })) + c) + (asinh((ln_1p(abs(abs((cbrt(tanh((y/((y + (1/3)) + atanh(min(y, y))))))^6))))^2))*(ln(((x^2) + 1))/((((acos(hypot(y, t))*(sign((cbrt((y/(((-(hypot(y, t)*min((a + pi), (pi - 3))))^2) + (x^2))))*y))/(((y + b)^2) + (((x^2) + 1)^2))))^-3)^2) + 2))))
}

hamiltonian! {
    pub struct E202 { a, b, c }
    H(x, y; px, py; t) = ((((1/2) + (b - b)) + px)/(((if ((if (b < pi) && (((-1)*min((1/10), c)) <= px) { c } else { y }) <= px) && ((((if (b < pi) && (((-1)*min((1/10), c)) <= px) { c } else { y }) - py)^6) < py) { min((tan(hypot((if (c < t) || (c < b) { px } else { (-1) }), b)) - (5*((1 + x)^-2))), b) } else { py })^2) + (a^2)))
}

hamiltonian! {
    pub struct E203 { a, b, c }
    H(x, y; px, py; t) = ((((if (cos(atan(pi)) < x) { ((((a/(((pi + c)^2) + 1))^2) + (px^2))^(-3/2)) } else { (-(x*c)) })^5)^6)^5)
}

hamiltonian! {
    pub struct E204 { a, b, c }
    H(x, y; px, py; t) = (min(b, (exp(atan(cbrt((px + c))))^(3/10))) + (-((sinh(sin(3)) - (if (a <= t) && ((t*x) <= (1/10)) { (b - x) } else { (atan(b) - sign(x)) }))^(2/3))))
}

hamiltonian! {
    pub struct E205 { a, b, c }
    H(x, y; px, py; t) = ((abs((py + atanh(cos(c))))^(-3/2))*y)
}

hamiltonian! {
    pub struct E206 { a, b, c }
    H(x, y; px, py; t) = (-tanh(((((exp_m1(tanh(((atan((1 + py))*(-a))^2))) + y)^2) + 1)^(13/4))))
}

hamiltonian! {
    pub struct E207 { a, b, c }
    H(x, y; px, py; t) = (sqrt(abs((-((((1/10)^2) + (1/py))*sqrt(((atan2((-1), max(c, (981/100)))^2) + (1/4))))))) + ((((ln((((exp(sin((1/3)))/abs(b))^2) + (1/4)))*(c + (((hypot(y, y)^2) + 2)^(13/4))))^2) + 1)^(3/2)))
}

hamiltonian! {
    pub struct E208 { a, b, c }
    H(x, y; px, py; t) = (atan2((t - (if !((x*b) < 1) { b } else { (x*b) })), (-((1/2)*py)))*(b/cosh((if ((t - (if (b <= b) { x } else { b })) < b) { (1/2) } else { ((pi*t) + b) }))))
}

hamiltonian! {
    pub struct E209 { a, b, c }
    H(x, y; px, py; t) = (((if ((a - pi) == y) { (-erfc((c - (y*y)))) } else { (-b) })*((py/atan(y)) - (y - b)))^2)
}

hamiltonian! {
    pub struct E210 { a, b, c }
    H(x, y; px, py; t) = (sqrt(abs((if (a <= px) && ((py + px) <= py) { tan(tanh((py*py))) } else { sign((3*(((a - px) + (1*(py^-3)))*a))) }))) + (sin(max((t + x), (abs(abs((abs(sin((t/y)))^(3/10))))^(2/3))))^2))
}

hamiltonian! {
    pub struct E211 { a, b, c }
    H(x, y; px, py; t) = (abs(((px^5) + atanh((((px*b) + ((2 + (b + y)) - c))/(1 + (((px*b) + ((2 + (b + y)) - c))^2))))))^(2/3))
}

hamiltonian! {
    pub struct E212 { a, b, c }
    H(x, y; px, py; t) = atanh(((((981/100)^2) - abs((1/2)))*((tanh((((((1/3)*x)^2) + 1)^(2/3))) + px)/((y^2) + 2))))
}

hamiltonian! {
    pub struct E213 { a, b, c }
    H(x, y; px, py; t) = (((c + (t*px)) + pow((((py + (b/px))^2) + (b^2)), cos(erf((px + px))))) + (if !(ln_1p((c^3)) <= (1/2)) { tan(cos((if (y < b) { (5 + (((1/10)/((b^2) + 2)) + c)) } else { (if (c <= 5) { (((a^2) + (pi^2))^(13/4)) } else { x }) }))) } else { atan2(((b^2) - x), a) }))
}

hamiltonian! {
    pub struct E214 { a, b, c }
    H(x, y; px, py; t) = (if ((a/((x^2) + 2)) < py) { asin(cos((1/2))) } else { py })
}

hamiltonian! {
    pub struct E215 { a, b, c }
    H(x, y; px, py; t) = ((((max(atan2((t/c), t), (1/2))^2) + 2)^(2/3))/((((if (b <= y) || ((t^6) < px) { a } else { t }) - pi)^2) + (1/4)))
}

hamiltonian! {
    pub struct E216 { a, b, c }
    H(x, y; px, py; t) = ((ln_1p((erfc(acos(cos(((px + px) - (if (exp((px + px)) < py) && (atanh(tanh((-(-1)))) < px) { ((b/pi)^6) } else { acosh((cosh(cos((t/(((px - py)^2) + 2)))) + 1)) })))))*t))^5) + (c/exp(atan((-min((exp_m1(b)/(((b*x)^2) + (1/4))), cosh(sin(x))))))))
}

hamiltonian! {
    pub struct E217 { a, b, c }
    H(x, y; px, py; t) = ((-((x + y) + t))/abs(atan2(c, atanh(tanh(((abs(((((((abs(((((x - (if (y <= t) { c } else { b })) + (px - x))*(((ln((((if (py <= 1) { x } else { x })^2) + 1))^2) + (x^2))^(13/4)))*2))^(3/2))^2) + (b^2))^(3/10))^5)*c))*5) + a))))))
}

hamiltonian! {
    pub struct E218 { a, b, c }
    H(x, y; px, py; t) = cbrt((((y - t) - px)*erfc(((5 + pi) - px))))
}

hamiltonian! {
    pub struct E219 { a, b, c }
    H(x, y; px, py; t) = ((tan(sin(py))^2) + sign((y + y)))
}

hamiltonian! {
    pub struct E220 { a, b, c }
    H(x, y; px, py; t) = (erfc(cosh(tanh((cosh(px)^(1/2)))))*(exp(atan(erf(x)))^(5/2)))
}

hamiltonian! {
    pub struct E221 { a, b, c }
    H(x, y; px, py; t) = ((if (((t^6) + (t^6)) < y) || ((b - x) < px) { abs(x) } else { ((((a^2) + (x^2))^(1/3))*(((c^2) + 1)^-1)) })*((((c^2) + 2)^(3/2)) - t))
}

hamiltonian! {
    pub struct E222 { a, b, c }
    H(x, y; px, py; t) = (((-(-(px + (1/10)))) + (((((px*(1/10))/((exp_m1((((((-(px + (1/10)))*(1/2))^2) + (a^2))^(2/3)))^2) + 1))^2) + (pi^2))^(5/2))) + ((if (cbrt(x) <= cbrt(x)) || ((c/(t/2)) <= a) { (if !(max(x, (c*y)) == b) { t } else { y }) } else { y }) - (a*c)))
}

hamiltonian! {
    pub struct E223 { a, b, c }
    H(x, y; px, py; t) = (((t - y) + ((py*5)/cosh(atan(asin((b/(1 + (b^2))))))))^4)
}

hamiltonian! {
    pub struct E224 { a, b, c }
    H(x, y; px, py; t) = ((x*b) + (if ((if (((-pi)/b) <= px) { (x*b) } else { (y*px) }) <= t) && ((b - pi) < c) { 5 } else { c }))
}

hamiltonian! {
    pub struct E225 { a, b, c }
    H(x, y; px, py; t) = (((ln_1p((((exp_m1(atan((t*cosh(sin((px*pi)))))) - sin((exp_m1((py + (t - a)))^5)))^2) + (1/4)))*px)*(asin((px/(1 + (px^2))))*b)) + ((a*((-1) + b))/((max(y, tan(tanh(a)))^2) + 1)))
}

hamiltonian! {
    pub struct E226 { a, b, c }
    H(x, y; px, py; t) = ((a/(((a - erf(((((((a^2) + 2)^(5/2))*(3 + px))/x)*hypot((a^6), (a^2)))))^2) + (1/4)))^2)
}

hamiltonian! {
    pub struct E227 { a, b, c }
    H(x, y; px, py; t) = (((pi + t)/abs((py*exp(atan(y)))))*atan2(((x + sin((c + exp(atan(y))))) + px), (if (((2*py) - pi) <= 2) && (x < c) { (t/abs((-7/4))) } else { tanh((ln(((px^2) + (y^2))) + sin((c + exp(atan(y)))))) })))
}

hamiltonian! {
    pub struct E228 { a, b, c }
    H(x, y; px, py; t) = ((((py*px)*sin(sinh(tanh(px)))) + sqrt((((atan2(px, (t^4))*b)^2) + (1/4)))) + (erfc((t*ln(((atanh(sin((3*1)))^2) + 1))))/pi))
}

hamiltonian! {
    pub struct E229 { a, b, c }
    H(x, y; px, py; t) = max((c - c), ((y*(1/10))*(c*pow((((b + a)^2) + 1), px))))
}

hamiltonian! {
    pub struct E230 { a, b, c }
    H(x, y; px, py; t) = (if (((a - 3)^3) < px) { (if !((((-1)*y)^7) < (a - 3)) { (((t^2) + (1/4))^(3/10)) } else { y }) } else { (((c*(erf(py) - a))^6)*t) })
}

hamiltonian! {
    pub struct E231 { a, b, c }
    H(x, y; px, py; t) = (((((min((px/a), (min((t*(abs(t)^(-7/5))), a)*(-1))) - asinh((sqrt(((sqrt(erfc(exp(sin(((((py*sqrt(exp(tanh(px))))^2) + (1/4))^(13/4))))))^2) + (py^2))) + px)))^2) + 2)^(1/3)) + ((((c + ((pi - (1/3)) + (-1)))^3)*b) - (sin(y)*(if ((y - x) <= y) || (b <= x) { (b^-3) } else { ln_1p(abs((abs(tan(tanh((max(asinh(a), (max(((c + ((pi - (1/3)) + (-1)))^3), ((x + x) - (-t))) - b))^6))))^-2))) }))))
}

hamiltonian! {
    pub struct E232 { a, b, c }
    H(x, y; px, py; t) = tanh((atan(atanh(tanh(((t*a)*y))))/((((a^2) + 1)^(-3/2)) + ln_1p(abs(py)))))
}

hamiltonian! {
    pub struct E233 { a, b, c }
    H(x, y; px, py; t) = (tan(y) + ((((sqrt(cosh((ln(cosh(tanh((y + c))))*b))) - py)^2) + 2)^(-3/2)))
}

hamiltonian! {
    pub struct E234 { a, b, c }
    H(x, y; px, py; t) = (acos(sin(atan((abs((c - (px - (-1))))^(3/10))))) + (erfc((b - t))*sqrt((((y + 3)^2) + 2))))
}

hamiltonian! {
    pub struct E235 { a, b, c }
    H(x, y; px, py; t) = sin(pow((((-(((pi/exp(x))*max(hypot(pow(((acos(sin((if !(min(t, a) <= a) { pi } else { y })))^2) + (pi^2)), cos((exp_m1(cos((py - t)))*(-cos(py))))), tanh(((-1) - (-1)))), 2))^(5/2)))^2) + (1/4)), sin((y/px))))
}

hamiltonian! {
    pub struct E236 { a, b, c }
    H(x, y; px, py; t) = tanh(((py/abs((if (b < py) && ((x + (t + pi)) < c) { (t - py) } else { y }))) + ((a + px)/(((px - sign(pi))^2) + 1))))
}

hamiltonian! {
    pub struct E237 { a, b, c }
    H(x, y; px, py; t) = ((((asin((((px*asinh(asin((px/(1 + (px^2))))))*(a/px))/(1 + (((px*asinh(asin((px/(1 + (px^2))))))*(a/px))^2))))*a)*((((pi - py)*py)*((py + px) + py))/cosh((ln((((py + py)^2) + 1))/(if (py <= pi) && ((b^2) == b) { (sign((1/2))*px) } else { a })))))^4) + (if ((y*y) < pi) || ((1/3) < t) { ((pi - (if (((((c*pi)^2) + (1/4))^(2/3)) <= b) && (((t - (1/4))/x) == y) { y } else { x }))/(acos((x/(1 + (x^2))))*1)) } else { b }))
}

hamiltonian! {
    pub struct E238 { a, b, c }
    H(x, y; px, py; t) = (abs((ln_1p(cosh(atan((-(y + atan(((if (((((1^2) + (px^2))^(-4/3))^7) < ((1^2) + (px^2))) { min((1/3), (1/2)) } else { (y*(px^2)) }) - (-tanh((py - 3))))))))))/((((((x*c)^2) + ((px^2)^2))^(-3/2))^2) + 1)))^(3/2))
}

hamiltonian! {
    pub struct E239 { a, b, c }
    H(x, y; px, py; t) = tanh((((((acosh(((((y^-3)^2) + (px^2)) + 1)) - (t + t))^2) + (1/4))^(1/3)) - (px*sqrt(cosh(sin(y))))))
}

hamiltonian! {
    pub struct E240 { a, b, c }
    H(x, y; px, py; t) = (sign(((((((t + t) - ((px/atan((b - a)))*px))*pow(abs(((t + a)^4)), tanh((b/a))))^2) + 2)^(-3/2))) + (if ((cosh(sin(y))^(-7/5)) <= pi) && ((abs(x)^(-3/2)) <= t) { (b + t) } else { (-1) }))
}

hamiltonian! {
    pub struct E241 { a, b, c }
    H(x, y; px, py; t) = ((-(px*(1/10))) + ((((((-7/4) + t)^4) - px) - (t/x))*y))
}

hamiltonian! {
    pub struct E242 { a, b, c }
    H(x, y; px, py; t) = (((max(erfc(((-(py*cos(b))) + y)), (pow(cosh(sin(px)), x)^-1))^2) + 1)^(1/2))
}

hamiltonian! {
    pub struct E243 { a, b, c }
    H(x, y; px, py; t) = ((if ((if (t <= pi) { t } else { (px + px) }) <= c) { ((b - b) + (5^-2)) } else { (exp_m1(sin(py)) - py) }) + (if (a < y) || ((t/((abs((-1))^2) + (y^2))) == y) { asin(tanh((sqrt(((y^2) + 1))/cosh(atan(a))))) } else { asin(cos(pow(abs(b), tanh(max(x, b))))) }))
}

hamiltonian! {
    pub struct E244 { a, b, c }
    H(x, y; px, py; t) = pow(((asinh(cos(t))^2) + (1/4)), cos((asinh(cos(t))/((px^3)/y))))
}

hamiltonian! {
    pub struct E245 { a, b, c }
    H(x, y; px, py; t) = ((5/pi) + ((t*(tan(cos((y*t))) - ((b*3) + (x/t))))*(pi*px)))
}

hamiltonian! {
    pub struct E246 { a, b, c }
    H(x, y; px, py; t) = (((1/2) - cbrt(((a*3) - (((px*(a*3)) + px)*(atanh((abs(py)^(-3/2))) + a))))) + (abs(((((b*b)*(exp(((((x - y)^2) + 2)^(1/3)))^-1))^2) + (((((a*pi)*y) + y) - asinh((-1))) - min(exp(sin((1/10))), ((b*b)*(-7/4))))))^(-1/2)))
}

hamiltonian! {
    pub struct E247 { a, b, c }
    H(x, y; px, py; t) = cos((abs((-((-(-cos((abs(y)^(3/10)))))/(((sinh(cos(px))*a)^2) + 2))))^(-3/2)))
}

hamiltonian! {
    pub struct E248 { a, b, c }
    H(x, y; px, py; t) = ((y - (px*3))*((3 - (1/10)) + pow(((px^2) + 2), sin(c))))
}

hamiltonian! {
    pub struct E249 { a, b, c }
    H(x, y; px, py; t) = (tanh(((cos(px) + (cosh((px*c))*t))/(((ln_1p(((b^2) + 1))^2) + 2)^(1/2)))) + (((acosh((abs(((if ((-x) < (981/100)) || (acosh((abs((if ((pi + exp(sin((981/100)))) < pi) { x } else { (-7/4) })) + 1)) <= x) { (a - c) } else { atan2(x, ((-7/4)*t)) })/(exp(sin((981/100))) - 1))) + 1))^2) + 2)^(5/2)))
}

hamiltonian! {
    pub struct E250 { a, b, c }
    H(x, y; px, py; t) = ((asinh((y^3)) - (3*((py/b)*py)))/((((x*((a*sinh(b))/2))*((cosh((abs(sin(hypot(t, py)))^(3/10)))/(((((((b*(-(px + (((((t - c)^2) + 1)^-3)*cosh(pow((981/100), py))))))/cosh(c))^2) + (c^2))^(3/2))^2) + 2)) + (-1)))^2) + (1/4)))
}

hamiltonian! {
    pub struct E251 { a, b, c }
    H(x, y; px, py; t) = ((asin((max(x, px)/(1 + (max(x, px)^2)))) + (((px*(1 + (max(x, px)^2))) + min((1/10), (1/10)))*t))/(t + (max(x, px)^2)))
}

hamiltonian! {
    pub struct E252 { a, b, c }
    H(x, y; px, py; t) = (((981/100) - (((((py*(981/100)) + b)*c) + (((px - 2) + (min(c, a) - (abs(ln(abs((-5))))^(13/4))))^5)) + min((px - (a^7)), 3))) + ((asin(sin(((1/3)/a)))^4) - (x - (asin(sin(((1/3)/a)))^4))))
}

hamiltonian! {
    pub struct E253 { a, b, c }
    H(x, y; px, py; t) = (-((if !(((b*px)^5) <= py) { c } else { ((px - (abs((x*(981/100)))^(1/3)))*y) })^7))
}

hamiltonian! {
    pub struct E254 { a, b, c }
    H(x, y; px, py; t) = ((atanh((acosh((abs(max(((py - x)/exp_m1(atan((c - px)))), ((c - px) - b))) + 1))/(1 + (acosh((abs(max(((py - x)/exp_m1(atan((c - px)))), ((c - px) - b))) + 1))^2))))/(exp_m1(atan((c - px)))*cbrt(atanh((hypot(b, px)/(1 + (hypot(b, px)^2)))))))*(1/2))
}

hamiltonian! {
    pub struct E255 { a, b, c }
    H(x, y; px, py; t) = ((if (((((a*a)^2) + (1/4))^(3/10)) < b) && (asinh(py) < px) { ((c + c)*(py + (c + c))) } else { max((981/100), py) }) + pow(abs((((t/y) - c)/exp(tanh((1/2))))), (sqrt(cosh((cos(tanh((t - (981/100)))) - x))) + (a/b))))
}

super::list! {
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
