//! Random expressions for the macro. Made by `generate.rs`; not to be edited.

use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct E0 { a, b, c }
    H(x, y; px, py; t) = ((if ((if (atan2((-1), (1/3)) <= t) { a } else { (1/2) }) <= b) { atan2(((t - (py^2))*max((-7/4), (1/2))), a) } else { px }) + ln((((t + a)^2) + 2)))
}

hamiltonian! {
    pub struct E1 { a, b, c }
    H(x, y; px, py; t) = (((if (min((y - (1/10)), 1) < y) && ((-((if (acos((py - b)) <= x) { b } else { y })*y)) < x) { ((-((if (acos((py - b)) <= x) { b } else { y })*y))/((min(acos((py/(1 + (py^2)))), (py/((1^2) + (1^2))))^2) + 1)) } else { ((atan2(px, (a/(1/2)))^5)/(abs(((y*py) + (py - b)))^(1/2))) })*sqrt(((((((min(acos((py/(1 + (py^2)))), (py/((1^2) + (1^2))))^2)^2) + 1)^-2)^2) + 2)))*(py - ((py^2)/(-7/4))))
}

hamiltonian! {
    pub struct E2 { a, b, c }
    H(x, y; px, py; t) = (-((py*exp(cos(tanh((((y^2) + (((a^2) + (a^2))^-1))^5))))) + (((exp(atan(t))^(5/2))/cosh((((pow(b, cos(py))^2) + (1/4))^-3)))/(px + (2/abs(px))))))
}

hamiltonian! {
    pub struct E3 { a, b, c }
    H(x, y; px, py; t) = ((((if !((px - 5) == (1/2)) { (px - 5) } else { (-(acosh((cosh(atan(px)) + 1))*c)) })*((px/abs(b))^2))*(t*(px*(sign((-7/4))*(if (((-b) + px) == b) || ((a*(px - c)) <= 3) { (pi + c) } else { pi }))))) + (cosh((cosh(cos(5)) + c))*((((1/2)^-1)*(y*(x + t))) + (b^4))))
}

hamiltonian! {
    pub struct E4 { a, b, c }
    H(x, y; px, py; t) = (min(((c*y) - c), (5/(((5*sinh(tanh(ln(exp(atan(py))))))^2) + 1))) + pi)
}

hamiltonian! {
    pub struct E5 { a, b, c }
    H(x, y; px, py; t) = (abs((acosh((abs((sin((atan2(b, x)^-3)) - ((c*px)/py))) + 1))*(((c*px)/py)*py)))^(1/2))
}

hamiltonian! {
    pub struct E6 { a, b, c }
    H(x, y; px, py; t) = (cos((if ((((1/3)*(1/3)) - px) < pi) { (tanh(((981/100) - c))/((b^2) + (1/4))) } else { (-1) })) + (max(c, c) + (if (((c*y)*y) <= y) || (sinh(a) <= x) { atan(y) } else { (-7/4) })))
}

hamiltonian! {
    pub struct E7 { a, b, c }
    H(x, y; px, py; t) = (((((if (cbrt((981/100)) == px) || (sin((pi/exp(atan(sign((981/100)))))) < b) { sign((981/100)) } else { y })/((((b + c)*sinh(((a - t)^2)))^2) + (pi^2)))^2) + (1/4))^(-1/2))
}

hamiltonian! {
    pub struct E8 { a, b, c }
    H(x, y; px, py; t) = (((y - a) + (1 + t))*(cos((-(py*px)))/((((abs(x)^(-7/5))*5)^2) + (1^2))))
}

hamiltonian! {
    pub struct E9 { a, b, c }
    H(x, y; px, py; t) = (((if ((max(pi, 3) - pi) == 3) || (((pi^2)*asinh(5)) <= c) { (if !((981/100) < py) { (cosh(((((-(px^2))^2) + 1)^(-1/2)))^(-7/5)) } else { (px - py) }) } else { asinh(5) })/exp(atan(a))) + tanh((2 - ln_1p((pow(abs((((1/abs((1/10))) + t) + a)), sin(y)) + (if ((-7/4) <= b) { 1 } else { 1 }))))))
}

hamiltonian! {
    pub struct E10 { a, b, c }
    H(x, y; px, py; t) = (((if (b < y) || (px <= py) { ((((px - b) - ((((1/2)^2) + (1/4))^(3/10)))^-3)^5) } else { (3 + py) }) - (py + pi))^7)
}

hamiltonian! {
    pub struct E11 { a, b, c }
    H(x, y; px, py; t) = (((((py/py)^2) + (b^2))^(5/2)) + (-cosh(cos((if ((((tanh((py/py))^2) + (((((py/py)^2) + (b^2))^(5/2))^2))^(3/10)) <= x) || (y <= 1) { (b^5) } else { (px + cosh((1/2))) })))))
}

hamiltonian! {
    pub struct E12 { a, b, c }
    H(x, y; px, py; t) = ((cos((py/tanh((((c - py) + (t*px))*b))))/(((t + a)^2) + (t^2))) + (y - (tan(sin((((-7/4)^3)*x)))*cos(y))))
}

hamiltonian! {
    pub struct E13 { a, b, c }
    H(x, y; px, py; t) = (-(atan((((px*(c + c))*((2 - py)/a)) - (px*(asin(sin(y)) + b)))) + (if ((abs(t)^(-4/3)) == 3) { x } else { t })))
}

hamiltonian! {
    pub struct E14 { a, b, c }
    H(x, y; px, py; t) = (b/((x - atan(py)) - exp_m1(ln_1p(((hypot(a, (a + a))^2) + 2)))))
}

hamiltonian! {
    pub struct E15 { a, b, c }
    H(x, y; px, py; t) = (cos((py - (b^4))) + min((if (y <= b) { cosh(sin((c - ((-1) - (c^7))))) } else { x }), atanh((acos(((x - b)/(1 + ((x - b)^2))))/(1 + (acos(((x - b)/(1 + ((x - b)^2))))^2))))))
}

hamiltonian! {
    pub struct E16 { a, b, c }
    H(x, y; px, py; t) = (sqrt(abs((cos((asin(cos((y + max(y, (-7/4))))) + (((x*asin(cos((y + max(y, (-7/4))))))*ln_1p(exp(cos(c))))^4)))*px))) - sin(((tanh(((y/b)*y)) + ((1/3) - y)) + pow(cosh(t), (3 + x)))))
}

hamiltonian! {
    pub struct E17 { a, b, c }
    H(x, y; px, py; t) = ((cosh(cos(tanh((((((-(cos((x + ln_1p(((c^2) + (1/4)))))^4)) - py)^2) + (1/4))^(1/2)))))^(3/10))^4)
}

hamiltonian! {
    pub struct E18 { a, b, c }
    H(x, y; px, py; t) = (hypot((abs((((py*(px - py))^6) - py)) + c), acos((a/(1 + (a^2))))) + acosh((abs((x*(exp(tanh((hypot(acos((((t*(x*x)) + x)/(1 + (((t*(x*x)) + x)^2)))), (pow(abs((pi*((y - x)/pi))), tanh((t/(981/100))))*c))^-1)))^(1/2)))) + 1)))
}

hamiltonian! {
    pub struct E19 { a, b, c }
    H(x, y; px, py; t) = (hypot(b, ((x*((1 + x) + (x + py)))^2)) + y)
}

hamiltonian! {
    pub struct E20 { a, b, c }
    H(x, y; px, py; t) = (if ((y + y) < c) || ((if (((b*acosh(((((px/exp((x*(3*px))))^2) + 2) + 1)))*pi) <= a) && (tan((1/10)) == pi) { acosh((((a^2) + (a^2)) + 1)) } else { (1/10) }) < t) { hypot((-7/4), a) } else { (b*acosh(((((px/exp((x*(3*px))))^2) + 2) + 1))) })
}

hamiltonian! {
    pub struct E21 { a, b, c }
    H(x, y; px, py; t) = ((max(((-px)*a), ((((981/100) - pow(((b^2) + 1), atan(((981/100)/c))))*(py*py))^2))^3) + ((3/c) - x))
}

hamiltonian! {
    pub struct E22 { a, b, c }
    H(x, y; px, py; t) = hypot(((((1/3)*((c*a) + a))*((((1/2) + x) - y) + x)) - (if (sqrt(((tan(cos(b))^2) + (x^2))) < b) && (3 < c) { px } else { (sin((((1/10)^5) + (b*b)))*(t - py)) })), c)
}

hamiltonian! {
    pub struct E23 { a, b, c }
    H(x, y; px, py; t) = (-hypot((px/x), ((b*x)*y)))
}

hamiltonian! {
    pub struct E24 { a, b, c }
    H(x, y; px, py; t) = ((((if (((px/((a^2) + (1/4)))^3) < (1/10)) && (sinh((py - c)) < sinh((py - c))) { (1/10) } else { max(b, ((-pi)/((tanh(py)^2) + 2))) })*((t - (sqrt(((a^2) + 2))*(if (((px/((a^2) + (1/4)))^3) < (1/10)) && (sinh((py - c)) < sinh((py - c))) { (1/10) } else { max(b, ((-pi)/((tanh(py)^2) + 2))) })))*(py + pi)))^2) + ((b - exp(((pi + pi)/t)))*y))
}

hamiltonian! {
    pub struct E25 { a, b, c }
    H(x, y; px, py; t) = ((((if ((a*5) <= t) && (a < ((-((((-tan(cos(y)))^2) + 2)^(-4/3)))/(((a + x)^2) + (1/4)))) { (t/(px*a)) } else { ((-((((-tan(cos(y)))^2) + 2)^(-4/3)))/(((a + x)^2) + (1/4))) })^2) + ((-1)^2))^-2)
}

hamiltonian! {
    pub struct E26 { a, b, c }
    H(x, y; px, py; t) = ((x + (sqrt((((1/2)^2) + (t^2)))*c)) - ((px*(5*3))/y))
}

hamiltonian! {
    pub struct E27 { a, b, c }
    H(x, y; px, py; t) = (((t - t) - ((py - a)*((((py^2) + py) - 5)^-3))) + ((pi + ((((c^2) + (a^2))^(1/3)) + asin((t/(1 + (t^2)))))) + (if (((-7/4) + atan(pi)) < a) || ((y*(y/((y^2) + 1))) <= pi) { t } else { sign(tanh((x*y))) })))
}

hamiltonian! {
    pub struct E28 { a, b, c }
    H(x, y; px, py; t) = ((asin(cos((-1))) + sqrt(abs((a/px)))) + atanh((((((px*x)^2) + (1/4))^(-1/2))/(1 + (((((px*x)^2) + (1/4))^(-1/2))^2)))))
}

hamiltonian! {
    pub struct E29 { a, b, c }
    H(x, y; px, py; t) = ((((px*t)*x) - (px/abs((c + t))))^4)
}

hamiltonian! {
    pub struct E30 { a, b, c }
    H(x, y; px, py; t) = (max((c*(px*py)), (b/abs(((1/3)*px)))) + (ln_1p(y) - t))
}

hamiltonian! {
    pub struct E31 { a, b, c }
    H(x, y; px, py; t) = atanh((atan((if (px < px) { acos(((tanh(((2 - c) - ((-1)*t)))/x)/(1 + ((tanh(((2 - c) - ((-1)*t)))/x)^2)))) } else { max(b, py) }))/(1 + (atan((if (px < px) { acos(((tanh(((2 - c) - ((-1)*t)))/x)/(1 + ((tanh(((2 - c) - ((-1)*t)))/x)^2)))) } else { max(b, py) }))^2))))
}

hamiltonian! {
    pub struct E32 { a, b, c }
    H(x, y; px, py; t) = (if (((1/10) - px) <= 2) || (((b^-1) - c) < px) { acosh((exp(cos((((y^2) + 2)^-3))) + 1)) } else { ((((((b - a)*py)^2) + (py^2))^(1/3))*(cbrt(1)*b)) })
}

hamiltonian! {
    pub struct E33 { a, b, c }
    H(x, y; px, py; t) = (((if ((cosh(exp_m1(tanh((-7/4))))^(-7/5)) <= c) || ((b*(px^2)) < (1/2)) { max(a, px) } else { (c*b) }) + ((cosh(exp_m1(tanh((-7/4))))*c) + (t + (a^3)))) + (x - (pi*sign(((-7/4)*pi)))))
}

hamiltonian! {
    pub struct E34 { a, b, c }
    H(x, y; px, py; t) = (((((if (pi < c) && ((3 + (if (c <= t) || ((-1) < x) { b } else { pi })) <= (1/10)) { 5 } else { pi })^2) + (px^2))^(5/2))*y)
}

hamiltonian! {
    pub struct E35 { a, b, c }
    H(x, y; px, py; t) = (if (atan((abs(t)^(-7/5))) < abs(t)) { (if (((5 - t)^-1) <= px) && ((2*x) == t) { (1 + (b*1)) } else { atan(max((pi^7), b)) }) } else { (b - acos(((atan(max((pi^7), b)) - py)/(1 + ((atan(max((pi^7), b)) - py)^2))))) })
}

hamiltonian! {
    pub struct E36 { a, b, c }
    H(x, y; px, py; t) = (((if (asinh((px - pi)) < py) || ((px^3) < px) { py } else { px })*a) + ln(abs(acosh((((asin(cos((pi - (abs(((-7/4) - c))^(-1/2)))))^2) + 1) + 1)))))
}

hamiltonian! {
    pub struct E37 { a, b, c }
    H(x, y; px, py; t) = ((-(a/px))*(exp(sin(sin((asin((t - b))*(y*px)))))^(1/2)))
}

hamiltonian! {
    pub struct E38 { a, b, c }
    H(x, y; px, py; t) = ((x*a)/exp(((((((x*a) + ln_1p(((py^2) + (a^2)))) + (-1))^2) + (c^2))^-1)))
}

hamiltonian! {
    pub struct E39 { a, b, c }
    H(x, y; px, py; t) = (ln_1p(((sqrt(((px^2) + 2))^2) + 2)) + (((1/2) + (acos(sin((if (y <= t) || ((b^4) < c) { (c + y) } else { atanh(sin((981/100))) }))) + y))*(-(-(1 - x)))))
}

hamiltonian! {
    pub struct E40 { a, b, c }
    H(x, y; px, py; t) = tan(((cosh(sin(t))/2) - ((min(px, y) - (py*(-7/4)))*c)))
}

hamiltonian! {
    pub struct E41 { a, b, c }
    H(x, y; px, py; t) = pow(abs(((cbrt((py/pi))/y) - px)), sin((t/((asin(sin((cbrt((py/pi))/y)))^2) + (1/4)))))
}

hamiltonian! {
    pub struct E42 { a, b, c }
    H(x, y; px, py; t) = ((((a^2) - (if ((((py^2) + 1)^-1) <= c) || ((px*(a^2)) < 1) { py } else { (((pi*px) + (-7/4))*a) }))^2) + sin(((if (((t*b) - t) < 2) && (((981/100)*t) < a) { (b*b) } else { ((981/100)*t) })*(y + x))))
}

hamiltonian! {
    pub struct E43 { a, b, c }
    H(x, y; px, py; t) = (sign(py)/((((((((-(max(py, y) - b))/((a^2) + 2)) + ((c*2)*x)) - ((px*(981/100))/((((c*2)*x)^2) + 1))) + ((ln_1p(((b^2) + 1))*x) - py))^2) + 2)^(-1/2)))
}

hamiltonian! {
    pub struct E44 { a, b, c }
    H(x, y; px, py; t) = min(min(2, x), sinh(tanh((((c + pi)*(py - y))^-1))))
}

hamiltonian! {
    pub struct E45 { a, b, c }
    H(x, y; px, py; t) = (cosh(cos(((px/(px + (px - c))) - asinh((t - c))))) + (if ((x - x) <= x) { sqrt(abs((tanh((y + sinh((5*(if (sinh((pi^2)) <= c) || (acos((exp(cos(t))/(1 + (exp(cos(t))^2)))) < c) { (1/3) } else { x })))))/y))) } else { ((x + (pi^2)) - a) }))
}

hamiltonian! {
    pub struct E46 { a, b, c }
    H(x, y; px, py; t) = (((x + t)*((((c^2) + 1)^-2)*((px*a) - (c^2)))) - t)
}

hamiltonian! {
    pub struct E47 { a, b, c }
    H(x, y; px, py; t) = (asin(tanh(((((1/2) - (if (((981/100)*y) < 3) || ((x/y) == pi) { b } else { py }))*(((981/100)*a)*t)) - y))) + ((if !((3*y) <= a) { (981/100) } else { ((c + x) - (1/10)) })*ln_1p((((y + b)^2) + 2))))
}

hamiltonian! {
    pub struct E48 { a, b, c }
    H(x, y; px, py; t) = ((-(t*(((sin(b)*c) + px)/abs((-px))))) + (((if !((x + t) <= a) { x } else { pi }) + a) - (asinh(2)*((if ((x*(a/x)) < pi) || ((y/y) < y) { t } else { tanh(a) }) - (pi - max(x, a))))))
}

hamiltonian! {
    pub struct E49 { a, b, c }
    H(x, y; px, py; t) = (tanh((x*atan2(py, (if ((x/py) <= (981/100)) || (((-7/4) + py) < a) { (981/100) } else { b })))) + (if (sin(y) == pi) || ((abs(t)/(1/2)) <= (-1)) { c } else { asinh((x - x)) }))
}

hamiltonian! {
    pub struct E50 { a, b, c }
    H(x, y; px, py; t) = sqrt((((exp(tanh(((pi*c)/(((py*b)^2) + (1/4)))))/(y*py))^2) + 1))
}

hamiltonian! {
    pub struct E51 { a, b, c }
    H(x, y; px, py; t) = ((((px*t)*1) - (((px^2) + (1/4))^(-4/3))) + (if (t < y) { atan2(((981/100) + (1/10)), c) } else { y }))
}

hamiltonian! {
    pub struct E52 { a, b, c }
    H(x, y; px, py; t) = ((((((y - py)*c)/((x^2) + 2))^2) + (1/4))^(1/2))
}

hamiltonian! {
    pub struct E53 { a, b, c }
    H(x, y; px, py; t) = pow(abs((if !(asinh(y) <= y) { max((b/abs(px)), pow(abs(c), min(y, 1))) } else { cos(((((((-1)*((1/10)/(1/10)))/((((1/10) - abs(px))^2) + 2))*(b + (981/100))) + (px + ((t + b) - 2)))^2)) })), tanh(((ln(((((abs((py^5))^(-4/3)) - (2/abs(2)))^2) + 1))*hypot(ln(abs(((b/abs(px))*px))), cosh(c)))^-2)))
}

hamiltonian! {
    pub struct E54 { a, b, c }
    H(x, y; px, py; t) = (cos((((a/cos((((acos(((py/py)/(1 + ((py/py)^2))))*(py*b))^2)*(acos(((py/py)/(1 + ((py/py)^2))))*(py*b))))) + (exp((cosh(atan((t - a)))^(-7/5)))^(-1/2)))^6)) + ((((((t + t) - t) + atan2((if ((t - t) < y) { c } else { (1/10) }), c))^2) + 2)^(-1/2)))
}

hamiltonian! {
    pub struct E55 { a, b, c }
    H(x, y; px, py; t) = ((-(px - cbrt((-7/4))))*ln((((sinh(atan((-(abs((((if (y < py) || (py < c) { (-1) } else { py })^2)^3))^(-3/2))))) - x)^2) + 2)))
}

hamiltonian! {
    pub struct E56 { a, b, c }
    H(x, y; px, py; t) = abs(((cosh((((((-7/4)/(-7/4))*((-7/4)/(-7/4)))*(-b)) - (y + ((1/2)*py))))^(1/3)) + pow(((cos(sign(((if ((sqrt(cosh(3)) - t) == b) && (y < x) { asinh(sin(1)) } else { (b*1) }) + (((-7/4)*py)*x))))^2) + 2), atan(a))))
}

hamiltonian! {
    pub struct E57 { a, b, c }
    H(x, y; px, py; t) = (((py/((((1/10) - py)^2) + 2))/(a + t)) + ((abs(((1/2)*(981/100)))^(-1/2)) + ln_1p(((pi^2) + 2))))
}

hamiltonian! {
    pub struct E58 { a, b, c }
    H(x, y; px, py; t) = abs(((((a - (t - py))^-1)*(((((x/cosh(px)) - ((a - (t - py)) + b))^2) + 2)^(-3/2)))^2))
}

hamiltonian! {
    pub struct E59 { a, b, c }
    H(x, y; px, py; t) = min(((cos(c) - min(a, sqrt(((px^2) + (x^2)))))/(-(acosh((((t^2) + (sqrt(((px^2) + (x^2)))^2)) + 1))/pow(cosh(cos(3)), sin(b))))), y)
}

hamiltonian! {
    pub struct E60 { a, b, c }
    H(x, y; px, py; t) = ((abs(asinh(asinh(cosh((px*sin(t))))))*((1/10)*atan2(exp(tanh(((exp_m1((py*px))^2)^5))), py))) + acosh((abs((((t*pi) - x)*x)) + 1)))
}

hamiltonian! {
    pub struct E61 { a, b, c }
    H(x, y; px, py; t) = sqrt((((asin(((x*(py + t))/(1 + ((x*(py + t))^2)))) + (pi + (x*(if ((if ((y/t) < py) { c } else { (py*y) }) < py) && ((pi - (3*px)) < b) { 3 } else { c }))))^2) + (1/4)))
}

hamiltonian! {
    pub struct E62 { a, b, c }
    H(x, y; px, py; t) = hypot((y - py), ln(abs((b + (min(px, x)*x)))))
}

hamiltonian! {
    pub struct E63 { a, b, c }
    H(x, y; px, py; t) = ((atan2(2, ((b/b)*py))*2) + ((((pi^3)*(abs(3)^(1/3))) - (exp(sin(x))^(-1/2)))^3))
}

hamiltonian! {
    pub struct E64 { a, b, c }
    H(x, y; px, py; t) = min((c^7), ((y + (c*a))*hypot(py, t)))
}

hamiltonian! {
    pub struct E65 { a, b, c }
    H(x, y; px, py; t) = (abs((if !((a/y) < c) { (t - x) } else { (((-hypot(py, c))*((-7/4)*ln_1p(((b^2) + (1/4)))))*(px + px)) }))^(2/3))
}

hamiltonian! {
    pub struct E66 { a, b, c }
    H(x, y; px, py; t) = (cosh((-py)) + ((atanh(((x - b)/(1 + ((x - b)^2))))/y) + y))
}

hamiltonian! {
    pub struct E67 { a, b, c }
    H(x, y; px, py; t) = (((abs((((a - x)*(((a^2) + ((-7/4)^2))^(-7/5)))/((t^2) + (b^2))))^(3/10))*((t*px) + (py + py)))^6)
}

hamiltonian! {
    pub struct E68 { a, b, c }
    H(x, y; px, py; t) = ln_1p(((((((ln(abs((((((y*px) + sqrt(a))^2) + (1/4))^(2/3)))) + ((((y*px) + sqrt(a))^2) - (5/(((((y*px) + sqrt(a))^2) + (1/4))^(2/3)))))^2) + 2)^-1)^2) + 1))
}

hamiltonian! {
    pub struct E69 { a, b, c }
    H(x, y; px, py; t) = (((b*(-py))*pow(abs((if ((py + (-7/4)) < 5) { (a - py) } else { py })), atan(sign((((acosh((((3^2) + 1) + 1))^2) + 2)^-3))))) + (((b - a) + (((x*x) + a) + c)) + (-1)))
}

hamiltonian! {
    pub struct E70 { a, b, c }
    H(x, y; px, py; t) = acosh((exp(tanh(abs((abs((acosh((((((py + y) - a)^2) + 1) + 1))^5))^(1/3))))) + 1))
}

hamiltonian! {
    pub struct E71 { a, b, c }
    H(x, y; px, py; t) = ((px^6) + max((if ((y - px) <= px) && (px < x) { ln(abs(y)) } else { b }), ((3/(py + t)) + ((3/(py + t)) + ((if ((c + c) <= b) && (atanh(sin(y)) < x) { (1/10) } else { x }) - (-7/4))))))
}

hamiltonian! {
    pub struct E72 { a, b, c }
    H(x, y; px, py; t) = ((max(sin(px), b)^2) + (if ((x*c) < y) { min(max(tanh((y*x)), b), y) } else { (if (cosh(sin((if ((if ((y + b) <= c) || (sin(y) <= x) { b } else { sin(y) }) <= c) && ((((x*c)^2) + c) == x) { (y*x) } else { y }))) <= a) || ((a^-1) < a) { x } else { acosh(((((if ((if (((-7/4) + cos(5)) == b) { t } else { (if ((((b^2) + (1/4))^(5/2)) <= y) && ((b*(x/exp(atan((((x*c)^2) + c))))) < 1) { pi } else { y }) }) <= y) { (a*y) } else { y })^2) + 1) + 1)) }) }))
}

hamiltonian! {
    pub struct E73 { a, b, c }
    H(x, y; px, py; t) = (acosh((abs(atan((x*c))) + 1))*ln(cosh(((y*1) - (((px/y) + (py + pi))*px)))))
}

hamiltonian! {
    pub struct E74 { a, b, c }
    H(x, y; px, py; t) = (3 + ((3*acosh((abs((if (sqrt(abs(t)) <= b) && (max((x/exp(py)), pi) == b) { t } else { (a/exp(tanh(x))) })) + 1)))*(3*acosh((abs((if (sqrt(abs(t)) <= b) && (max((x/exp(py)), pi) == b) { t } else { (a/exp(tanh(x))) })) + 1)))))
}

hamiltonian! {
    pub struct E75 { a, b, c }
    H(x, y; px, py; t) = (((((1/3)^2) - (((1/3)^2)*exp_m1((1/3))))*py) + ln(exp(tanh((((cosh((hypot((x + c), (t*x)) + ((((t*x) - 1)^6) - (x*y))))^-3)^2)*(y*(x*c)))))))
}

hamiltonian! {
    pub struct E76 { a, b, c }
    H(x, y; px, py; t) = ((((abs(py)^(3/10))/((-1) - a))/abs((a/abs(x)))) + ((if ((1/3) <= b) { px } else { y }) + px))
}

hamiltonian! {
    pub struct E77 { a, b, c }
    H(x, y; px, py; t) = ((t*(cosh(y)^(-7/5)))/px)
}

hamiltonian! {
    pub struct E78 { a, b, c }
    H(x, y; px, py; t) = ((min(t, px)*b) + atan(max(t, ((y*pi)*ln_1p(((x^2) + 2))))))
}

hamiltonian! {
    pub struct E79 { a, b, c }
    H(x, y; px, py; t) = (if (tanh(x) <= x) { ((x + px)*py) } else { ((b*(cosh(atan((981/100)))^(-4/3)))/hypot((px/((c^2) + 2)), c)) })
}

hamiltonian! {
    pub struct E80 { a, b, c }
    H(x, y; px, py; t) = ((acosh((exp(acosh(((((t + x)^2) + (1/4)) + 1))) + 1)) - px)^2)
}

hamiltonian! {
    pub struct E81 { a, b, c }
    H(x, y; px, py; t) = (atan((cosh(sin(exp(cos((((((px/px)^2) + 2)^-3)/abs(((px + pow(((hypot(cbrt(a), atan2(c, t))^2) + 2), a)) + 2))))))) - py)) + min((a*(cos((a^5)) - y)), tanh(y)))
}

hamiltonian! {
    pub struct E82 { a, b, c }
    H(x, y; px, py; t) = ((if (px <= b) && ((pi + 5) < y) { a } else { (-y) })*y)
}

hamiltonian! {
    pub struct E83 { a, b, c }
    H(x, y; px, py; t) = (max(x, ((c*a)*py))*((((-((1/2)*3))^2) + (1/4))^(-7/5)))
}

hamiltonian! {
    pub struct E84 { a, b, c }
    H(x, y; px, py; t) = ((((px + ((t*px)*py)) - ((b*px) - px))*((t - c) + asinh((exp((px*(-py))) + (if ((px - pi) < (t - c)) { t } else { (if !(((py*pi)^-1) < py) { px } else { pi }) }))))) + (c + ((c/pi) - (a - c))))
}

hamiltonian! {
    pub struct E85 { a, b, c }
    H(x, y; px, py; t) = (x - asin((((((x*px)^2) + (x^2))^(-1/2))/(1 + (((((x*px)^2) + (x^2))^(-1/2))^2)))))
}

hamiltonian! {
    pub struct E86 { a, b, c }
    H(x, y; px, py; t) = ((((-1)*y)/py) + ((t + c)/cosh(atan(atanh((t/(1 + (t^2))))))))
}

hamiltonian! {
    pub struct E87 { a, b, c }
    H(x, y; px, py; t) = (ln((((1 - ((((py*(-1)) + pi) - t)*(c + c)))^2) + (b^2))) + exp_m1(sin(((acosh((((c^2) + 1) + 1)) + cbrt(sqrt((((atan(c)*(-7/4))^2) + 2))))*(((y*sqrt(abs(b))) + (y*5)) + cosh(tanh((pi + b))))))))
}

hamiltonian! {
    pub struct E88 { a, b, c }
    H(x, y; px, py; t) = asin(((c*(if ((b - (1/2)) < c) || ((1/3) < t) { x } else { (if ((t/((c^2) + ((-1)^2))) == py) && ((981/100) <= pi) { (1/3) } else { c }) }))/(1 + ((c*(if ((b - (1/2)) < c) || ((1/3) < t) { x } else { (if ((t/((c^2) + ((-1)^2))) == py) && ((981/100) <= pi) { (1/3) } else { c }) }))^2))))
}

hamiltonian! {
    pub struct E89 { a, b, c }
    H(x, y; px, py; t) = atan2((y + (1/3)), ((px + x) + cos(5)))
}

hamiltonian! {
    pub struct E90 { a, b, c }
    H(x, y; px, py; t) = (((px + ((((px*px)^2) + (1^2))^-3))*((((((tanh((t + (if ((981/100) < pi) || ((pi + ((981/100)*py)) < (px + ((((px*px)^2) + (1^2))^-3))) { b } else { pi })))*((px - (pi + ((981/100)*py)))*pi)) + 5)*(-((c/((px^2) + (1/4)))^2)))^2) + (1/4))^(1/3))) + min((-tan(hypot(1, min(atan2((if (sinh(cos(1)) < y) { x } else { (1/10) }), a), (((1/2)*x) - c))))), (x*y)))
}

hamiltonian! {
    pub struct E91 { a, b, c }
    H(x, y; px, py; t) = ((y*(-(-px))) + px)
}

hamiltonian! {
    pub struct E92 { a, b, c }
    H(x, y; px, py; t) = (((if ((t/cosh((((px^2) + 2)^(-1/2)))) <= (-1)) { (1/2) } else { abs(px) })*max(y, (-7/4)))^-1)
}

hamiltonian! {
    pub struct E93 { a, b, c }
    H(x, y; px, py; t) = (((px/(a*(1/10))) - (-((b - c)*hypot((b - b), (px + (5 + px)))))) + (if (cosh(atan(y)) < t) || (pi < y) { t } else { (b*y) }))
}

hamiltonian! {
    pub struct E94 { a, b, c }
    H(x, y; px, py; t) = ((5/py)*(((pi^-3) + (y - 1))*y))
}

hamiltonian! {
    pub struct E95 { a, b, c }
    H(x, y; px, py; t) = (if ((((-1)*b)^5) < a) || (((px + 5)*y) < 1) { ((t*((3/((y^2) + 2)) + b)) + (-7/4)) } else { px })
}

hamiltonian! {
    pub struct E96 { a, b, c }
    H(x, y; px, py; t) = (exp(sin(tan(sin((sinh(((t*(5 + pi))*(((3 - pi) - py) + tanh((c/abs((if (sign((1/2)) <= pi) && (1 <= py) { (px - py) } else { (b + (-1)) })))))))*((-a)/(py + px))))))) + (((if (cos(t) < y) { (y + cos(t)) } else { t })^5)*cbrt((y*y))))
}

hamiltonian! {
    pub struct E97 { a, b, c }
    H(x, y; px, py; t) = (py - (sin(pow(((((-x) + tan(atan(py)))^2) + 2), tanh((a*a))))/(-a)))
}

hamiltonian! {
    pub struct E98 { a, b, c }
    H(x, y; px, py; t) = ((x*(min(t, x) + (x + px))) + sign((abs(t)^(13/4))))
}

hamiltonian! {
    pub struct E99 { a, b, c }
    H(x, y; px, py; t) = (((b*py)*((((px - b)^2) + (1/4))^-1)) + (asinh(((x - (-7/4)) + ((1/2)*acos(((y*5)/(1 + ((y*5)^2))))))) - (max((3 - x), x) + t)))
}

hamiltonian! {
    pub struct E100 { a, b, c }
    H(x, y; px, py; t) = (if (y <= py) { ((1/3)*pi) } else { (abs((1/2))*(5 + (1/3))) })
}

hamiltonian! {
    pub struct E101 { a, b, c }
    H(x, y; px, py; t) = abs(((((y^2) + ((1/3)^2))^(3/10))*cbrt(((t + py)*(atanh((b/(1 + (b^2))))^2)))))
}

hamiltonian! {
    pub struct E102 { a, b, c }
    H(x, y; px, py; t) = (((tanh((if (asinh((py + a)) < px) { (3*py) } else { (sign(b)/(((px + py)^2) + 1)) })) - 1)*pow(c, tanh((3 - b)))) + ((if (exp(t) <= t) { (x + y) } else { ((x*pi)*asinh(atanh(cos((x*x))))) }) + y))
}

hamiltonian! {
    pub struct E103 { a, b, c }
    H(x, y; px, py; t) = ((((-7/4) + cbrt((a - (a*(1/10)))))*(cbrt((a - (a*(1/10))))/a))*(if ((2 - (((pi^2) + 1)^(3/10))) == py) { a } else { y }))
}

hamiltonian! {
    pub struct E104 { a, b, c }
    H(x, y; px, py; t) = (((x - (-(abs((py - (1/10))) + cosh(tanh(abs((py - (1/10))))))))/(a*sinh(((pi - (abs((py - (1/10))) + cosh(tanh(abs((py - (1/10)))))))*(x - 5)))))^2)
}

hamiltonian! {
    pub struct E105 { a, b, c }
    H(x, y; px, py; t) = (((((px^-2)*py) + (px*(py - c))) + t) + min((((1/3)*a)*(x + (981/100))), ((y*b)*c)))
}

hamiltonian! {
    pub struct E106 { a, b, c }
    H(x, y; px, py; t) = ((if (tan(pi) == x) { (if (pi <= px) && (y < t) { (1/10) } else { (x^3) }) } else { y })*((if ((x*tan(pi)) < y) && (py < px) { (-1) } else { sign((px^5)) }) + (if ((x + (-1)) < x) || ((px*(b*x)) < px) { y } else { (acosh((abs((a^-3)) + 1))*((c*px) - ((-1) - tan(pi)))) })))
}

hamiltonian! {
    pub struct E107 { a, b, c }
    H(x, y; px, py; t) = (if (hypot((2*pi), t) < y) && (ln((((abs(b)^(2/3))^2) + (1/4))) < (1/10)) { ((((-7/4) - t)*sign(px)) - (3*5)) } else { (((b^4) - (x^2)) + a) })
}

hamiltonian! {
    pub struct E108 { a, b, c }
    H(x, y; px, py; t) = ((((py + c)*py)*px) + ((if ((if ((y*(c*x)) <= pi) && ((((-1)/((y^2) + 1)) + x) <= (1/2)) { c } else { ln(exp((981/100))) }) < a) { t } else { (t*x) }) + (((((y + y)/abs(((c - a)^4)))^2) + 1)^(-1/2))))
}

hamiltonian! {
    pub struct E109 { a, b, c }
    H(x, y; px, py; t) = hypot((x^7), (((hypot(c, x)*py)*((-1) - (hypot(c, x)*py))) - sqrt(cosh(((py*(b + (y*x)))^-1)))))
}

hamiltonian! {
    pub struct E110 { a, b, c }
    H(x, y; px, py; t) = tanh((-sinh(cos((y*sign(tanh(exp(atan(ln(cosh(sin((((((c*(t*x))/((if (1 < c) || (((a*px) + t) < x) { (py + y) } else { t }) - (a*(if (hypot(a, (y + (1/3))) < c) { x } else { y }))))^2) + (1/4))^(5/2))))))))))))))
}

hamiltonian! {
    pub struct E111 { a, b, c }
    H(x, y; px, py; t) = (((asinh(px)*(px/(1/10))) + (exp(((a + py) + ln_1p(t)))^(5/2))) + ((c/abs(hypot(atan(t), (min(atan(t), c) + y))))*sqrt(abs((x/(((-1) + a)*ln(abs(x))))))))
}

hamiltonian! {
    pub struct E112 { a, b, c }
    H(x, y; px, py; t) = max((if (px < a) && (x <= px) { px } else { (-1) }), (px/5))
}

hamiltonian! {
    pub struct E113 { a, b, c }
    H(x, y; px, py; t) = (if (py < (1/3)) { asinh(px) } else { (exp(cos((x/((((1/3) + py)^2) + (px^2)))))^(3/10)) })
}

hamiltonian! {
    pub struct E114 { a, b, c }
    H(x, y; px, py; t) = ((max(c, t) + py) + (sin(x)^(13/4)))
}

hamiltonian! {
    pub struct E115 { a, b, c }
    H(x, y; px, py; t) = (((((cos(ln_1p(px)) + (px + y)) - a)^2) + (px^2))^(-4/3))
}

hamiltonian! {
    pub struct E116 { a, b, c }
    H(x, y; px, py; t) = (if !((-(x + py)) <= 2) { b } else { (((((b^2) + (1/4))^(1/2)) + t) - (t - t)) })
}

hamiltonian! {
    pub struct E117 { a, b, c }
    H(x, y; px, py; t) = (max((-b), atanh(((((py + px) + (min(t, (py + px))/((py^2) + 2)))^6)/(1 + ((((py + px) + (min(t, (py + px))/((py^2) + 2)))^6)^2))))) + (cbrt(exp_m1(((if (1 == y) && ((1/10) < x) { (((y + (b + b)) + (1/10))^7) } else { ((y*acos(cos(b))) + y) })^4)))/pow(abs(x), sin((y + (if !(tanh((((t^2) + 1)^-2)) <= y) { y } else { acosh((((t^2) + (t^2)) + 1)) }))))))
}

hamiltonian! {
    pub struct E118 { a, b, c }
    H(x, y; px, py; t) = asinh((abs(((((((if !(a <= b) { (cbrt((c*py)) + abs((py*cbrt(a)))) } else { x })^5)^2) + (1/4))^(1/3)) - (-1)))^(3/2)))
}

hamiltonian! {
    pub struct E119 { a, b, c }
    H(x, y; px, py; t) = ((hypot((py - (1/2)), min(3, pi))*(sqrt((((if (ln_1p(((1^2) + 2)) < c) { ((a - px)/px) } else { x })^2) + 2))*(1/3)))^7)
}

hamiltonian! {
    pub struct E120 { a, b, c }
    H(x, y; px, py; t) = (tanh(((-py)^4)) + (((a - sin(b)) + (y*x))*((c/c)/c)))
}

hamiltonian! {
    pub struct E121 { a, b, c }
    H(x, y; px, py; t) = (max((t + (t*t)), cos(a)) - (if !(y <= t) { 3 } else { py }))
}

hamiltonian! {
    pub struct E122 { a, b, c }
    H(x, y; px, py; t) = (acos(sin((y*((if (py == b) { a } else { (b/b) })*a)))) - (2 - y))
}

hamiltonian! {
    pub struct E123 { a, b, c }
    H(x, y; px, py; t) = (((px - hypot(a, (-b)))^2) + (pow(cosh(sin(hypot(c, 1))), atan(c))^2))
}

hamiltonian! {
    pub struct E124 { a, b, c }
    H(x, y; px, py; t) = min((-atan2(py, py)), ((((-y)^(3/10)) + 2) + (pow(((((-y)^(3/10))^2) + (1/4)), atan((x^7)))*atan2(py, py))))
}

hamiltonian! {
    pub struct E125 { a, b, c }
    H(x, y; px, py; t) = hypot((if (y < t) && (px < (-1)) { ((-5) - 2) } else { ((5 - px) - exp(atan((atan(pi)/sin(py))))) }), x)
}

hamiltonian! {
    pub struct E126 { a, b, c }
    H(x, y; px, py; t) = (((cos(px)*t) + pi) + (sign(y) + b))
}

hamiltonian! {
    pub struct E127 { a, b, c }
    H(x, y; px, py; t) = ((hypot(t, a) - hypot(t, a)) + (pow(exp((x/((((t/((c - t)^-3))^2) + (1/4))^(3/10)))), px) - (hypot(t, t)*(y - sqrt(((a^2) + 2))))))
}

hamiltonian! {
    pub struct E128 { a, b, c }
    H(x, y; px, py; t) = ((x*cosh(sin(((if (b <= 1) || (5 < x) { (t + pi) } else { (-7/4) })*py)))) + (exp(atan(tan(py)))*5))
}

hamiltonian! {
    pub struct E129 { a, b, c }
    H(x, y; px, py; t) = ((-((py*(-(1/2))) + ((py*c) - (py*t)))) + tan((sinh((abs(((ln_1p(((exp_m1(((1/10) + (x - 3)))^2) + (t^2)))*(-((if (a < t) || ((abs(x)^(2/3)) <= ln_1p(((exp_m1(((1/10) + (x - 3)))^2) + (t^2)))) { b } else { 1 })*y)))/(((if ((-y) <= x) || ((a*a) < a) { a } else { t })^2) + 1)))^(5/2))) + acosh(((((sinh(min(b, x))^2)^2) + 2) + 1)))))
}

hamiltonian! {
    pub struct E130 { a, b, c }
    H(x, y; px, py; t) = (pow(((y^2) + 1), x) + ((b/(((x - px)^2) + 1)) + (1/2)))
}

hamiltonian! {
    pub struct E131 { a, b, c }
    H(x, y; px, py; t) = (if (abs((py*x)) <= px) { ((((if ((x^6) < (-7/4)) { ln(((sign(py)^2) + 1)) } else { ((if (tan(tanh((981/100))) < y) && (acosh((((a^2) + (c^2)) + 1)) <= 5) { (1/3) } else { (-b) }) + ln_1p(((ln_1p(((c^2) + 2))^2) + 1))) }) - ((sign(py)^2) + 1))^-2)^6) } else { sin(exp((pi*py))) })
}

hamiltonian! {
    pub struct E132 { a, b, c }
    H(x, y; px, py; t) = ((sqrt(((acos(((pi/((acosh((((b^2) + 1) + 1))^2) + (((b^2) + 1)^2)))/(1 + ((pi/((acosh((((b^2) + 1) + 1))^2) + (((b^2) + 1)^2)))^2))))^2) + 1))*px) + sinh(tanh(((abs(c) + (-b)) + (if !((y^5) < y) { y } else { acos(((((c - x)*x)*t)/(1 + ((((c - x)*x)*t)^2)))) })))))
}

hamiltonian! {
    pub struct E133 { a, b, c }
    H(x, y; px, py; t) = asinh(atan(sinh(((b/((c^2) + 1)) + ((py/x)*(((asinh((((((pi + (c - c))*(y - b))^2) + 1)^(-4/3)))^2) + (1/4))^-2))))))
}

hamiltonian! {
    pub struct E134 { a, b, c }
    H(x, y; px, py; t) = ((if (b < x) && ((-7/4) == px) { x } else { px })*y)
}

hamiltonian! {
    pub struct E135 { a, b, c }
    H(x, y; px, py; t) = (((a - (pi*a)) + (cos(py) - (1/3))) + tan(atan(sin((asinh((abs(c)^(-4/3))) - y)))))
}

hamiltonian! {
    pub struct E136 { a, b, c }
    H(x, y; px, py; t) = (pi - (c + asin((min((exp_m1((((x - c) - py) + exp(cos(((if !(max(y, px) < c) { abs(b) } else { (1/2) }) + ((b*5)^-2))))))/(y - (3 - px))), 1)/(1 + (min((exp_m1((((x - c) - py) + exp(cos(((if !(max(y, px) < c) { abs(b) } else { (1/2) }) + ((b*5)^-2))))))/(y - (3 - px))), 1)^2))))))
}

hamiltonian! {
    pub struct E137 { a, b, c }
    H(x, y; px, py; t) = ((px + py)*y)
}

hamiltonian! {
    pub struct E138 { a, b, c }
    H(x, y; px, py; t) = (ln_1p(abs((if ((abs((if (((((pi - t)^2) + 2)^(-7/5)) < pi) && (cbrt(px) < pi) { b } else { (1/2) }))^(5/2)) < t) || (((a^4)*pi) == (if ((-((pi - t)^2)) <= b) && ((-b) <= (-1)) { pi } else { t })) { atanh((((px*(py^6)) + (if ((-((pi - t)^2)) <= b) && ((-b) <= (-1)) { pi } else { t }))/(1 + (((px*(py^6)) + (if ((-((pi - t)^2)) <= b) && ((-b) <= (-1)) { pi } else { t }))^2)))) } else { ((b + py) - py) }))) + (-(acosh(((((-ln(cosh(tanh(sin(abs((-acos((x + y)))))))))^2) + (x^2)) + 1)) + (if !(t <= b) { sin(((1/3) + (sinh(sin(b))*b))) } else { b }))))
}

hamiltonian! {
    pub struct E139 { a, b, c }
    H(x, y; px, py; t) = sin((if !((px*(px/b)) < t) { (y*b) } else { (if ((y^-3) <= b) || (cos(sinh(tanh(c))) <= 5) { (1/2) } else { x }) }))
}

hamiltonian! {
    pub struct E140 { a, b, c }
    H(x, y; px, py; t) = (((((cosh(cos(((1/2) + t)))^(2/3)) - t)*(sinh(y) - (abs(a)^(-3/2)))) - (y*exp(t))) + (((((y - (px + ((a*py) - b)))^2) + 2)^(3/10))/px))
}

hamiltonian! {
    pub struct E141 { a, b, c }
    H(x, y; px, py; t) = (asinh((((t + (c*a))*(pi^6)) + ((((t + (c*a))*(pi^6))*c) - (abs(px)^(-7/5))))) + (hypot(tanh(b), (((tan(sin(c)) - (pi + t))^7) - (x/(1/2))))^-3))
}

hamiltonian! {
    pub struct E142 { a, b, c }
    H(x, y; px, py; t) = (py/acosh(((((y*(-c))^2) + 1) + 1)))
}

hamiltonian! {
    pub struct E143 { a, b, c }
    H(x, y; px, py; t) = acosh((cosh(sin(((acos((a/(1 + (a^2))))/exp(tanh(px))) - (exp_m1(sin(y))*c)))) + 1))
}

hamiltonian! {
    pub struct E144 { a, b, c }
    H(x, y; px, py; t) = ((((py/(1/10))*a) - ((if (pi < px) { c } else { px }) + c)) + (if !(b < b) { (max(c, x)*(x - x)) } else { (abs(((t*x) + y))^-1) }))
}

hamiltonian! {
    pub struct E145 { a, b, c }
    H(x, y; px, py; t) = ((px*((-((x*py)*(x^(3/10))))*a))^3)
}

hamiltonian! {
    pub struct E146 { a, b, c }
    H(x, y; px, py; t) = (atanh(sin((((py + ((py + (981/100)) + ((-7/4) - (py + (981/100))))) + (if ((if !((py^2) < py) { (((px^2) + (1/4))^-1) } else { b }) < b) { px } else { (px/abs(b)) }))*y))) + ((if ((if !((py^2) < py) { (((px^2) + (1/4))^-1) } else { b }) < b) { px } else { (px/abs(b)) })/abs(y)))
}

hamiltonian! {
    pub struct E147 { a, b, c }
    H(x, y; px, py; t) = ((((asin(((1/10)/(1 + ((1/10)^2))))*(t + pi))*(px + py))*((cbrt(pow(((b^2) + 1), py)) + ((sqrt(abs((py + py)))/cosh(sin(c)))*(t + t)))^2)) + atanh((((c*a) + (if (x < x) || ((b^2) <= x) { cbrt(pi) } else { (-((b - t)/abs((b*x)))) }))/(1 + (((c*a) + (if (x < x) || ((b^2) <= x) { cbrt(pi) } else { (-((b - t)/abs((b*x)))) }))^2)))))
}

hamiltonian! {
    pub struct E148 { a, b, c }
    H(x, y; px, py; t) = max((((sqrt(acos(((t/(((py/abs(b))^2) + 2))/(1 + ((t/(((py/abs(b))^2) + 2))^2)))))^2) + 2)^(3/10)), tanh((a + y)))
}

hamiltonian! {
    pub struct E149 { a, b, c }
    H(x, y; px, py; t) = ((((t + y)*atanh(((x + t)/(1 + ((x + t)^2))))) + (((c + t) + c)*y)) - (if ((if (a <= a) || (t <= pi) { t } else { t }) <= py) && ((py/abs(t)) < y) { atan2((b*(t - 1)), 5) } else { b }))
}

hamiltonian! {
    pub struct E150 { a, b, c }
    H(x, y; px, py; t) = (((3 + tanh(((-7/4) + px))) - a) + ((y + sinh(x))*(pi + 5)))
}

hamiltonian! {
    pub struct E151 { a, b, c }
    H(x, y; px, py; t) = (if (x <= 2) { ((if (((b - y)*py) < a) { abs((2*y)) } else { c })*atan(((((((b + (b/x))^-1)/((py^2) + 2))^2) + 2)^(1/2)))) } else { (1/2) })
}

hamiltonian! {
    pub struct E152 { a, b, c }
    H(x, y; px, py; t) = (if (ln_1p((((b*py)^2) + 2)) <= c) || (((x*y)*py) <= py) { (py/(-1)) } else { (if !((b*(if (2 <= y) { 3 } else { px })) <= y) { a } else { x }) })
}

hamiltonian! {
    pub struct E153 { a, b, c }
    H(x, y; px, py; t) = (atanh((exp((((if ((1/3) < px) { py } else { (1/3) }) + py) + (py + (b*b))))/(1 + (exp((((if ((1/3) < px) { py } else { (1/3) }) + py) + (py + (b*b))))^2)))) + (if (acosh(((((t + (1/3))^2) + (1/4)) + 1)) == b) && (y < x) { c } else { (((ln_1p((((5 + ((b/((x^2) + 2)) + (a*atan2((a - x), (1/3)))))^2) + ((981/100)^2)))^2) + 1)^(-1/2)) }))
}

hamiltonian! {
    pub struct E154 { a, b, c }
    H(x, y; px, py; t) = (if !((x + (1/3)) <= t) { cosh(cos((exp(tanh((pow(px, sin(px))/exp(cos((asin((sqrt(cosh(asin(cos(c))))/(1 + (sqrt(cosh(asin(cos(c))))^2))))^2))))))^(2/3)))) } else { y })
}

hamiltonian! {
    pub struct E155 { a, b, c }
    H(x, y; px, py; t) = ((if ((x^-2) < 5) { ((a + (c - y))*(-(py*(t/exp(t))))) } else { pi })*((abs(x)^-1)^5))
}

hamiltonian! {
    pub struct E156 { a, b, c }
    H(x, y; px, py; t) = ((b/exp((exp(py)^7))) + (((c - c)*t) + (max(x, t) + ((if (atan2(t, asin((c/(1 + (c^2))))) <= x) && ((x*(x + b)) < y) { atan2(t, asin((c/(1 + (c^2))))) } else { c }) + sin(x)))))
}

hamiltonian! {
    pub struct E157 { a, b, c }
    H(x, y; px, py; t) = hypot(py, min(asin((((((tanh(acos(sin((cbrt(px)^-2))))^2) + (pi^2))^(1/3)) - y)/(1 + (((((tanh(acos(sin((cbrt(px)^-2))))^2) + (pi^2))^(1/3)) - y)^2)))), (py - x)))
}

hamiltonian! {
    pub struct E158 { a, b, c }
    H(x, y; px, py; t) = (((b*max((1/10), y)) + ((-pow((((abs(px)^(3/10))^2) + 1), tanh(t)))^2))*tanh((acosh((((2^2) + 1) + 1))*acos((pi*((c - px)^2))))))
}

hamiltonian! {
    pub struct E159 { a, b, c }
    H(x, y; px, py; t) = ((((-1) - py)/abs((((((py + c)^3)*(py + c)) - (py + c))/(((py^2) + 1)^(-3/2))))) + tanh(sinh((1/10))))
}

hamiltonian! {
    pub struct E160 { a, b, c }
    H(x, y; px, py; t) = (exp((1 + exp(tanh((b/a))))) + (y*px))
}

hamiltonian! {
    pub struct E161 { a, b, c }
    H(x, y; px, py; t) = (-(((((((y + y) + (((py/exp(cos((px + (px - x))))) - px)^(-1/2)))*acosh((abs(cos(max(atanh(((1/10)/(1 + ((1/10)^2)))), a))) + 1)))^2) + 1)^-3) + x))
}

hamiltonian! {
    pub struct E162 { a, b, c }
    H(x, y; px, py; t) = ((((((hypot(sqrt(abs((((atan2((py*a), px)^2) + 1)^(-3/2)))), px)^2) + (a^2))^(5/2))^2)/abs(atan((tan(((981/100) + px)) - (ln(exp(pi))*(atan2((py*a), px)^2)))))) + sin(((((x/c) - acosh(((((-7/4)^2) + 1) + 1))) + (a - b)) - x)))
}

hamiltonian! {
    pub struct E163 { a, b, c }
    H(x, y; px, py; t) = (if (t <= t) && (x == a) { asinh((py/((pi^2) + (1/4)))) } else { ((pi^2) + (if ((px + px) < py) || ((exp(cos(t)) + px) == a) { t } else { t })) })
}

hamiltonian! {
    pub struct E164 { a, b, c }
    H(x, y; px, py; t) = (asin((((a/x)*px)/(1 + (((a/x)*px)^2)))) + sin(sqrt(((2^2) + 1))))
}

hamiltonian! {
    pub struct E165 { a, b, c }
    H(x, y; px, py; t) = ((((-(px/(exp(sin((py + 5))) + (abs((b*(1/2)))*exp(tanh(b))))))^7) - py) + exp_m1(atan(sin((max(a, acosh((abs((pi*(atan(cos(a)) - (-1)))) + 1))) - t)))))
}

hamiltonian! {
    pub struct E166 { a, b, c }
    H(x, y; px, py; t) = ((((tanh((py/px)) + a) + (pow(((((py*c)^2)^2) + 2), t) + y))^2)^5)
}

hamiltonian! {
    pub struct E167 { a, b, c }
    H(x, y; px, py; t) = cbrt((((x + t)*((b + b)*((if !(exp((y - x)) < c) { (1/3) } else { px })*t)))*b))
}

hamiltonian! {
    pub struct E168 { a, b, c }
    H(x, y; px, py; t) = (((px - c)*px) + (cosh(sin((((if ((a + x) < (1/10)) && (x <= pi) { a } else { y }) + (((1 - (-1))/abs(2))/b))*(a - 2)))) - ((y^3) + ln_1p(abs(b)))))
}

hamiltonian! {
    pub struct E169 { a, b, c }
    H(x, y; px, py; t) = (if !(5 < py) { (if (((((if (b < t) || (((-1)*(-1)) <= y) { y } else { (1/3) })^2) + (b^2))^(1/2)) <= px) { (sqrt(abs((if ((px^6) <= a) && (((px^6) + tanh(py)) <= (if (b < t) || (((-1)*(-1)) <= y) { y } else { (1/3) })) { (1/3) } else { a })))*sinh(tanh(((-1) + py)))) } else { ((((-(x + x)) - px)/(((((-1)*(-1)) - b)^2) + (1/4)))^7) }) } else { acosh((cosh(sin(pow(abs((if ((abs((t*x))^(-3/2)) < 1) { ((if (b < t) || (((-1)*(-1)) <= y) { y } else { (1/3) }) + c) } else { (if ((a - (a + y)) < a) { sin(py) } else { a }) })), atan(c)))) + 1)) })
}

hamiltonian! {
    pub struct E170 { a, b, c }
    H(x, y; px, py; t) = exp_m1(sin((-((b/((hypot(b, (-c))^2) + (1/4))) - ((((((y^-2)*py)^-1)^2) + 1)^(2/3))))))
}

hamiltonian! {
    pub struct E171 { a, b, c }
    H(x, y; px, py; t) = ((((if ((py*px) <= c) { py } else { (if !(sin((px + px)) <= pi) { px } else { b }) })^5) + (tanh((b*(atanh(tanh(px))^-2))) + pi)) + (y*(((3^5) + (t + (981/100)))/(ln_1p(abs((((cos((((y*a)*cbrt(t))*3))^2) + 1)^(-1/2))))*(if ((-x) <= 1) { 3 } else { y })))))
}

hamiltonian! {
    pub struct E172 { a, b, c }
    H(x, y; px, py; t) = (abs(((exp_m1(y) - asinh((if !(atan2((a + a), t) <= py) { a } else { exp_m1(sin(((py*b)^4))) })))^(1/3)))^(5/2))
}

hamiltonian! {
    pub struct E173 { a, b, c }
    H(x, y; px, py; t) = (tan(cos(((((abs(px)^(-1/2))^2) + (1/4))^(2/3))))*cbrt(min((5/c), ((pi*y)^2))))
}

hamiltonian! {
    pub struct E174 { a, b, c }
    H(x, y; px, py; t) = ((cbrt((if !(px <= a) { (py*((c + b) + px)) } else { (-py) })) + (c + px)) + cbrt(((if ((x + (a + a)) <= t) { max(y, (x + y)) } else { (1/10) })/((if ((y - c) == y) { c } else { (b*x) }) - (-7/4)))))
}

hamiltonian! {
    pub struct E175 { a, b, c }
    H(x, y; px, py; t) = ((px + exp_m1(tanh(max((if !((b + c) < c) { px } else { cbrt(3) }), (if (tan(cos((5*a))) <= y) { x } else { px }))))) + ((1*py)*(c^5)))
}

hamiltonian! {
    pub struct E176 { a, b, c }
    H(x, y; px, py; t) = (((if (c <= t) || (sin((px - 3)) < c) { tan(pow(((c^2) + 1), sin(y))) } else { 3 }) - ((pow((((t + x)^2) + 1), cos(a)) - (x - ln_1p(((a^2) + 2)))) - py))/(((((-((atan(min(py, a)) + 2) - py)) + pi)^2)^2) + 2))
}

hamiltonian! {
    pub struct E177 { a, b, c }
    H(x, y; px, py; t) = ((((if (abs(sinh(atan(px))) < c) && ((px + px) <= px) { py } else { (px + px) })*(sinh(atan(px)) - py))*((cbrt(px) - (a + py)) - (py - t))) + ln_1p(abs(((((a^2) + (1/4))^(-7/5))^-2))))
}

hamiltonian! {
    pub struct E178 { a, b, c }
    H(x, y; px, py; t) = ln(abs(((x^-3) - ((px*b)/((abs((c*t))^2) + ((1/10)^2))))))
}

hamiltonian! {
    pub struct E179 { a, b, c }
    H(x, y; px, py; t) = (if (x < b) { c } else { ((py/((x^2) + (1/4))) + c) })
}

hamiltonian! {
    pub struct E180 { a, b, c }
    H(x, y; px, py; t) = (asin((asinh((px*(px + ((a*b)*cbrt((pow(cosh(atan((py + b))), atan((-((py/((px^2) + 2)) + px))))^3))))))/(1 + (asinh((px*(px + ((a*b)*cbrt((pow(cosh(atan((py + b))), atan((-((py/((px^2) + 2)) + px))))^3))))))^2)))) + (if (y <= y) { (a + b) } else { asinh(x) }))
}

hamiltonian! {
    pub struct E181 { a, b, c }
    H(x, y; px, py; t) = ((if ((if (((-7/4) + c) <= py) || (x <= (-7/4)) { (2*a) } else { a }) <= x) || (t <= c) { (if !(pow(((py^2) + 1), (a*px)) < a) { y } else { x }) } else { py })/sin(min(c, t)))
}

hamiltonian! {
    pub struct E182 { a, b, c }
    H(x, y; px, py; t) = (sinh(atan((x - (px*(y^4)))))*(-py))
}

hamiltonian! {
    pub struct E183 { a, b, c }
    H(x, y; px, py; t) = ((((b*b)*py)^6) + (((x*a) + a)/(ln_1p((((abs((-max(y, sign((y + (y*pi))))))^(2/3))^2) + (1/4))) - ((x - pi) + (y/((a^2) + (y^2)))))))
}

hamiltonian! {
    pub struct E184 { a, b, c }
    H(x, y; px, py; t) = ((y - (x + b)) - (pow(((py^2) + (x^2)), sin((sinh(atan((x*sqrt(abs(t)))))*abs(t)))) - (if !(px <= (-1)) { ((-1) + py) } else { (y*(c*t)) })))
}

hamiltonian! {
    pub struct E185 { a, b, c }
    H(x, y; px, py; t) = hypot(b, (if ((y + py) < px) { px } else { ((((py/((a^2) + 2)) + (py^-2)) + (t*2)) + (atan(t) + py)) }))
}

hamiltonian! {
    pub struct E186 { a, b, c }
    H(x, y; px, py; t) = (((((tan((if !(b < px) { max((abs(px)^(3/10)), py) } else { (abs(cbrt((py*py)))^3) }))^2) + (cosh(atanh(sin(((1/10) + px))))^2)) + py) + py) + ((b/(1/3)) - (y - min(((tanh(((1/2) - x))^6) - ((1/3)*(x - b))), y))))
}

hamiltonian! {
    pub struct E187 { a, b, c }
    H(x, y; px, py; t) = (if ((a/(if (x <= py) { x } else { b })) == c) { (c*t) } else { px })
}

hamiltonian! {
    pub struct E188 { a, b, c }
    H(x, y; px, py; t) = (atanh((a/(1 + (a^2)))) + ((-(if (asin(tanh((if ((cosh(py) + b) <= a) { x } else { py }))) < (1/3)) || ((-a) < py) { (abs(3)^(5/2)) } else { (((x + ln(abs(x))) + acos(tanh((a/acos((y/(1 + (y^2))))))))^2) })) - ((if ((a/((x^2) + 1)) <= c) || (exp_m1((px*c)) < x) { 2 } else { hypot(px, ((((-1)/(((t + b)^2) + (y^2)))^2)^2)) })^-1)))
}

hamiltonian! {
    pub struct E189 { a, b, c }
    H(x, y; px, py; t) = (((py + a)/(((((t^2) + 2)^(-4/3))^2) + (1/4))) + (y/(((((cos((1/2))^-3)^2) + (c^2))^(5/2))^6)))
}

hamiltonian! {
    pub struct E190 { a, b, c }
    H(x, y; px, py; t) = (abs((if ((c*x) <= py) { acos(cos(((y*x) - (y*x)))) } else { py }))^(-4/3))
}

hamiltonian! {
    pub struct E191 { a, b, c }
    H(x, y; px, py; t) = (((if ((1/10) <= y) && (t <= 5) { t } else { 2 }) + (cos(c)*t)) + (if (((pi + 5)^3) < a) && ((y*a) < c) { px } else { c }))
}

hamiltonian! {
    pub struct E192 { a, b, c }
    H(x, y; px, py; t) = ((if (atan2(b, t) <= c) { ((1/10) + px) } else { ((1/10) + px) }) + (if (x <= c) { sqrt(((y^2) + (1/4))) } else { c }))
}

hamiltonian! {
    pub struct E193 { a, b, c }
    H(x, y; px, py; t) = ((py/((-7/4)/((((-hypot(y, a))*(py*1))^2) + 1))) + px)
}

hamiltonian! {
    pub struct E194 { a, b, c }
    H(x, y; px, py; t) = ((((if (tan(tanh(px)) < b) { py } else { (tan(tanh(px)) + t) })*px) - (-((ln(abs(b))*px) + t)))*(((-max(a, (t/py)))^2)*y))
}

hamiltonian! {
    pub struct E195 { a, b, c }
    H(x, y; px, py; t) = ((3/((ln((((abs(min(sign((py + px)), px))^-2)^2) + 2))^2) + 2)) + ((((abs(y)^(5/2)) + c)/t) + sign(((x*pi) + (2 + (x + y))))))
}

hamiltonian! {
    pub struct E196 { a, b, c }
    H(x, y; px, py; t) = (((py*x) - (c/cosh(atan(pi)))) - c)
}

hamiltonian! {
    pub struct E197 { a, b, c }
    H(x, y; px, py; t) = (-(if (hypot((((t^2) + 2)^(13/4)), t) < (1/10)) && (b < y) { (py/(t^-2)) } else { sqrt((((sin(t) - tanh(((981/100)*py)))^2) + (t^2))) }))
}

hamiltonian! {
    pub struct E198 { a, b, c }
    H(x, y; px, py; t) = (hypot((if (((1/3)/((b^2) + (1/4))) < px) { (1/3) } else { c }), 2) + (if (x < x) { (b - (x - b)) } else { (if (((y/y)^4) < x) { (1/2) } else { t }) }))
}

hamiltonian! {
    pub struct E199 { a, b, c }
    H(x, y; px, py; t) = ((px - b)*((px - y) - ((c*b)/(1/2))))
}

hamiltonian! {
    pub struct E200 { a, b, c }
    H(x, y; px, py; t) = pow(((c^2) + ((-7/4)^2)), (t - (((c/(atan(t) + (a/((c^2) + (y^2))))) - py) - exp_m1(a))))
}

hamiltonian! {
    pub struct E201 { a, b, c }
    H(x, y; px, py; t) = (min(((((pow((((cbrt((c + (-7/4)))*((981/100) + px))^2) + 2), cos(py))^2) + (t^2))^(13/4))*(abs((abs(b)^(3/10)))^(13/4))), a) + ((y + min(y, (if ((if (sin(pi) < b) { y } else { y }) < y) && (x < (-7/4)) { c } else { pi }))) + tan(ln_1p(((ln_1p(abs(((((sqrt(abs((x*c)))^2) + 1)^-2) + ((t^-1)*sign(t)))))^2) + 2)))))
}

hamiltonian! {
    pub struct E202 { a, b, c }
    H(x, y; px, py; t) = (x*min(((if (px <= x) && ((x + c) == t) { (exp(cos(y))^(-3/2)) } else { px }) + (y - (x*((1*px)^(-1/2))))), (if (px < x) || (3 <= b) { t } else { x })))
}

hamiltonian! {
    pub struct E203 { a, b, c }
    H(x, y; px, py; t) = (((((-(px*(a + a)))/(x*y))^2)*(((if ((if ((-7/4) <= (-7/4)) || (abs(c) < px) { (c + b) } else { (-1) }) <= py) && (b <= py) { py } else { b }) + a) + ((hypot(a, a)^5)/(py*py))))^2)
}

hamiltonian! {
    pub struct E204 { a, b, c }
    H(x, y; px, py; t) = (((if (py < py) && (b < b) { (pi + (exp(cos((((((py*t)/((b^2) + (1/4)))^2) + (px^2))^(-1/2))))^(3/10))) } else { (px - px) }) - c) + (cosh(cos(min(t, (pi*t))))^(3/2)))
}

hamiltonian! {
    pub struct E205 { a, b, c }
    H(x, y; px, py; t) = hypot((x*py), (((y + px)^3)*(y/abs(x))))
}

hamiltonian! {
    pub struct E206 { a, b, c }
    H(x, y; px, py; t) = (if ((y/px) <= py) && (x < c) { ((1/2) - y) } else { ((max((py^(-3/2)), t)*(abs(px)^(13/4))) + ln_1p(cosh(atan2((exp_m1(tanh((px - (t*(y/cosh(sin(px)))))))*((1/2) + x)), max(acos((abs(py)/(1 + (abs(py)^2)))), py))))) })
}

hamiltonian! {
    pub struct E207 { a, b, c }
    H(x, y; px, py; t) = ((acosh(((((px/((((if (px <= py) { a } else { px }) + (t*t))^2) + 1))^2) + (1/4)) + 1)) + py) + (acosh((abs((y - (((y^2) + 2)^(-1/2)))) + 1))/((a + y)/sinh((exp_m1(sin(y))*3)))))
}

hamiltonian! {
    pub struct E208 { a, b, c }
    H(x, y; px, py; t) = ((pi/(y*py))*((-a) - hypot(3, (t + px))))
}

hamiltonian! {
    pub struct E209 { a, b, c }
    H(x, y; px, py; t) = cbrt((((b/abs(b)) + (-px))*x))
}

hamiltonian! {
    pub struct E210 { a, b, c }
    H(x, y; px, py; t) = (exp_m1((a/(3/cosh(((3*py) - acos(sin(sqrt(abs((1/10)))))))))) + max(atanh((((-((c*a)*x))^6)/(1 + (((-((c*a)*x))^6)^2)))), t))
}

hamiltonian! {
    pub struct E211 { a, b, c }
    H(x, y; px, py; t) = ((tan(ln_1p(exp((((-1)*b)*(y*tanh((px*(x + y))))))))^3) - (pow((((tanh(3) - (py*b))^2) + (t^2)), cos(px))^2))
}

hamiltonian! {
    pub struct E212 { a, b, c }
    H(x, y; px, py; t) = ((sign((x + c))*cos((px + 1)))*((a*max(x, py)) - ((981/100)*y)))
}

hamiltonian! {
    pub struct E213 { a, b, c }
    H(x, y; px, py; t) = ((((pi*atan(px))*pow(((atan(px)^2) + 2), (exp(sin(a))^(13/4)))) + px) + cosh(sin((asin((atan2((y + sign((b*(if (y == b) && ((a^3) <= x) { b } else { y })))), x)/(1 + (atan2((y + sign((b*(if (y == b) && ((a^3) <= x) { b } else { y })))), x)^2))))*sin((y/c))))))
}

hamiltonian! {
    pub struct E214 { a, b, c }
    H(x, y; px, py; t) = (((if !(b <= x) { c } else { t })^2)*(py + c))
}

hamiltonian! {
    pub struct E215 { a, b, c }
    H(x, y; px, py; t) = (sin(px)/(cbrt((a + y))*((sinh(tanh((if (y < (-7/4)) || (((-px) - t) < a) { (-7/4) } else { (c*(t - (-7/4))) }))) - max(t, t))*((sqrt(((a^2) + 2))^6) - ((x*hypot(y, y))*1)))))
}

hamiltonian! {
    pub struct E216 { a, b, c }
    H(x, y; px, py; t) = ((atanh((px/(1 + (px^2))))*(px + ((px*b) + (px - (t/b))))) + (((if ((abs(y)^(-1/2)) == (981/100)) { a } else { x }) - (y*(y*(((((1/3)*x)^2) + 1)^(2/3))))) + x))
}

hamiltonian! {
    pub struct E217 { a, b, c }
    H(x, y; px, py; t) = (((x^2) + c)/((if (t == (1/10)) || ((b*pi) < px) { px } else { exp_m1(atan(((if (cosh((c^3)) <= (1/2)) && (x <= ((x^2) + c)) { py } else { (3 + (y - b)) }) + ((a*(b - c)) + (1/3))))) })*(((c + px) + min(max(cosh((c^3)), a), px))^4)))
}

hamiltonian! {
    pub struct E218 { a, b, c }
    H(x, y; px, py; t) = (((((sign(((-1) + px))^2) + (1/4))^(3/10))*abs(py))*((py*min(((1/10) + (-1)), (y + a)))/((if ((a/((x^2) + 2)) < py) { sinh(cos((1/2))) } else { a }) - (sqrt(cosh(cos((-(py - (1/10))))))*px))))
}

hamiltonian! {
    pub struct E219 { a, b, c }
    H(x, y; px, py; t) = ((abs(((py + (px^4))*(px/(py - (1/3)))))^(3/2)) + (if (sign(y) < sign(y)) || (exp((c^-2)) <= (1/10)) { (((((y + (pi - t))^2) + 1)^-3) + (min(2, x) - b)) } else { (((b*c) - (if ((y*c) <= c) || ((((-1) - y)/5) < a) { (-1) } else { (-7/4) })) + ((a*c)/(-(((-1) - y)/5)))) }))
}

hamiltonian! {
    pub struct E220 { a, b, c }
    H(x, y; px, py; t) = (((max(((if ((px + (((t^2) + 1)^(-4/3))) < y) || ((-7/4) < b) { (-px) } else { 3 })*((-t)*(c + pi))), (((((b*(1/3))^2) + (1/4))^-3)*((c*b) - hypot(x, 2))))^2) + 1)^(-3/2))
}

hamiltonian! {
    pub struct E221 { a, b, c }
    H(x, y; px, py; t) = ((if !(((y + (1/2))*t) < (1/2)) { ((y + (1/2))*t) } else { ((((if (5 <= a) { asin(((x^2)/(1 + ((x^2)^2)))) } else { asin(tanh(((y + a) + y))) })^2) + (1/4))^(-7/5)) })*(((if (5 <= a) { asin(((x^2)/(1 + ((x^2)^2)))) } else { asin(tanh(((y + a) + y))) }) - (px - 5)) - t))
}

hamiltonian! {
    pub struct E222 { a, b, c }
    H(x, y; px, py; t) = (atanh((cbrt(((b + py)*px))/(1 + (cbrt(((b + py)*px))^2)))) + ((2 + (2 + y))*t))
}

hamiltonian! {
    pub struct E223 { a, b, c }
    H(x, y; px, py; t) = ((x + (exp(tanh(x))^-3))/asin(cos((((if !((py*(((py^2) + 2)^(-7/5))) < px) { c } else { c }) - (((max((1/10), (if (((px + px)^2) <= py) { y } else { py }))^2) + (a^2))^(-7/5)))*b))))
}

hamiltonian! {
    pub struct E224 { a, b, c }
    H(x, y; px, py; t) = ((ln_1p(exp(tanh(x)))*((((if ((px - px) < c) || (((px - px) + 3) < y) { b } else { px })^2)*(x + ((-x)/abs(c))))*((-7/4)/exp(px))))*py)
}

hamiltonian! {
    pub struct E225 { a, b, c }
    H(x, y; px, py; t) = (atan2(((1/2)*(py - exp(atan(2)))), ((ln_1p(cbrt(py)) - (if (a < py) || (pi <= 1) { c } else { (t + b) }))^(3/2))) + pow((((ln(((y^2) + 1))/(((y^5)^2) + 2))^2) + (1/4)), tanh(min((x*y), (atan2(y, t)*cbrt((y*1)))))))
}

hamiltonian! {
    pub struct E226 { a, b, c }
    H(x, y; px, py; t) = ln((-(if (a < c) || ((if (ln_1p((t - x)) <= x) || (((-pi)/b) <= px) { (px + px) } else { 3 }) < a) { min(((-7/4) + (abs((3/(((c^6)^2) + (1/4))))^(3/10))), (py + a)) } else { b })))
}

hamiltonian! {
    pub struct E227 { a, b, c }
    H(x, y; px, py; t) = (((if !((a^6) <= py) { pi } else { b }) - x)^-3)
}

hamiltonian! {
    pub struct E228 { a, b, c }
    H(x, y; px, py; t) = (acosh((cosh(cos((pow(abs(px), px)^-3))) + 1)) + (acosh((((((x/abs(t)) + ((((if (c <= x) { t } else { y })^2) + 1)^(1/2)))^2) + 1) + 1))*(y^-3)))
}

hamiltonian! {
    pub struct E229 { a, b, c }
    H(x, y; px, py; t) = ((b - y)*atan2(max((((pi^2) + 1)^(2/3)), (x*((py/(y*b)) + (px + py)))), (-7/4)))
}

hamiltonian! {
    pub struct E230 { a, b, c }
    H(x, y; px, py; t) = (((x/px)*cosh(sin(atanh(cos(1)))))*pi)
}

hamiltonian! {
    pub struct E231 { a, b, c }
    H(x, y; px, py; t) = (((abs((((c + 3)/px) - px))^(1/2))*((cosh(sin(ln_1p(((5^2) + (1/4)))))^-1)^2)) + (((y*x) + t)*b))
}

hamiltonian! {
    pub struct E232 { a, b, c }
    H(x, y; px, py; t) = (if (2 < pi) { (-1) } else { ((if (t <= 2) && (tanh(x) == pi) { x } else { x })*py) })
}

hamiltonian! {
    pub struct E233 { a, b, c }
    H(x, y; px, py; t) = cbrt((((((((pi*min(((t*pi) - 2), exp(tanh(py))))^6)^2) + (py^2))^-3)^2) + (if (cbrt((c/a)) <= (t*pi)) { x } else { (pi - ((t - t)^7)) })))
}

hamiltonian! {
    pub struct E234 { a, b, c }
    H(x, y; px, py; t) = ((tan(tanh((abs((t + asin(tanh((px*b)))))^-3))) + (b + px)) + cosh(cbrt((b*(if ((b*x) <= x) { x } else { y })))))
}

hamiltonian! {
    pub struct E235 { a, b, c }
    H(x, y; px, py; t) = atan2(cosh(tanh(sinh(cos((pi - (c + (px*b))))))), (x*(pi - y)))
}

hamiltonian! {
    pub struct E236 { a, b, c }
    H(x, y; px, py; t) = (((-y)*max(y, b)) + (if ((t + cosh(py)) < 3) { (if !((3*(py + px)) <= py) { (1/2) } else { (x^2) }) } else { sinh((y - (-px))) }))
}

hamiltonian! {
    pub struct E237 { a, b, c }
    H(x, y; px, py; t) = (min(cos(((py^6) - (px + ln(exp(px))))), (abs(cos(sqrt(((py^2) + (pi^2)))))^(1/2))) + (ln_1p(cosh(cos((atanh(((x + y)/(1 + ((x + y)^2)))) + c)))) - (x/cosh(atan(t)))))
}

hamiltonian! {
    pub struct E238 { a, b, c }
    H(x, y; px, py; t) = abs((((((-(((py/x) + py)^(1/2))) + ((py + t)^6))^2) + (1/4))^(-4/3)))
}

hamiltonian! {
    pub struct E239 { a, b, c }
    H(x, y; px, py; t) = exp(cosh((((-b)/cosh(t))*((((-b)/cosh(t))^6)/(y*((((if ((x - (y + y)) < x) { y } else { y })^4) + (1*(1/2))) + ((((a*(981/100))*1) + (py + b)) - tanh(px))))))))
}

hamiltonian! {
    pub struct E240 { a, b, c }
    H(x, y; px, py; t) = (((pi/abs(((pi - (if (((((c*pi)^2) + (1/4))^(2/3)) <= b) && (((t - ((c*pi)^2))/px) == py) { py } else { px }))/abs(c)))) + t) + tan((((((pi + (cosh((-(y + y)))/y)) - (t - ((((cosh(tanh((if (c < a) { x } else { (1/3) })))^2) + (y^2))^(3/10))^2)))*(-7/4))*cos(((-t)*((1/3) + pi)))) - (x*c))))
}

hamiltonian! {
    pub struct E241 { a, b, c }
    H(x, y; px, py; t) = (((px - (sign(((t/x) + y)) + (px - b)))^2)*((px*px) + 5))
}

hamiltonian! {
    pub struct E242 { a, b, c }
    H(x, y; px, py; t) = ln(cosh((((if ((t*t) < y) || ((y + (if !((t - py) <= pi) { t } else { y })) <= y) { asinh(py) } else { x }) - (cbrt(sinh(atan(((((tan(sin(py))/(((y - a)^2) + 2))^2) + (t^2))^(3/2))))) + x)) + ((((c/exp(sin((y + py)))) - (b + y)) + acos((b/(1 + (b^2))))) + x))))
}

hamiltonian! {
    pub struct E243 { a, b, c }
    H(x, y; px, py; t) = (((((1 - 1) - 1) + (abs(sin((abs(t)^(-4/3))))^(-7/5))) + hypot(px, px)) + ln_1p(((((((-(cosh(sin((1 - x)))^-3))^2) + 1)^(-1/2))^2) + 1)))
}

hamiltonian! {
    pub struct E244 { a, b, c }
    H(x, y; px, py; t) = ((1/2)*(if !(t <= py) { (if ((1^-3) == y) && ((((1/10)*c) - py) < 5) { 1 } else { px }) } else { 2 }))
}

hamiltonian! {
    pub struct E245 { a, b, c }
    H(x, y; px, py; t) = sin(((cosh(cos(py)) + ((((y*max(py, c))^2) + (1/4))^(3/2)))/cos((b*c))))
}

hamiltonian! {
    pub struct E246 { a, b, c }
    H(x, y; px, py; t) = (((((((a^2) + (1/4))^(-3/2)) + pi) + sqrt(((px^2) + 1)))*(py + (c + pi))) + exp(((pi*x)/cosh(cos((y + b))))))
}

hamiltonian! {
    pub struct E247 { a, b, c }
    H(x, y; px, py; t) = ((((b - c)*((((a + x)^2) + 2)^(2/3)))*min((if !(((-7/4)*pi) <= t) { x } else { px }), ((cosh(sin(3))^(1/2)) + py))) + 3)
}

hamiltonian! {
    pub struct E248 { a, b, c }
    H(x, y; px, py; t) = hypot(((pow(((t^2) + 2), tanh(b)) + ((abs((1/10))^(-7/5))*((ln_1p(cosh((if !(py <= (t^2)) { (if ((b/abs(1)) == py) && (b <= (1/3)) { a } else { b }) } else { (1/2) })))/((5^2) + 2)) + t)))/(((if (cbrt((c - a)) == pi) || ((1 + x) < y) { (asinh(pi)*exp(((((b^2) + 1)^(-3/2)) + y))) } else { c })^2) + (1/4))), x)
}

hamiltonian! {
    pub struct E249 { a, b, c }
    H(x, y; px, py; t) = (((pi*b) - acosh((exp((px/(((b + ((-1) - t))*a) + py))) + 1))) + (if (y <= 3) { x } else { (x + hypot(x, y)) }))
}

hamiltonian! {
    pub struct E250 { a, b, c }
    H(x, y; px, py; t) = ((if ((x/exp(cos(b))) <= pi) && ((atan2(c, (if (sign(x) <= a) { (cosh(cos(asin(sin(acos((py/(1 + (py^2))))))))^(2/3)) } else { ((abs(hypot(c, x))^-2) + hypot(c, x)) }))/t) <= 3) { (atan2(c, (if (sign(x) <= a) { (cosh(cos(asin(sin(acos((py/(1 + (py^2))))))))^(2/3)) } else { ((abs(hypot(c, x))^-2) + hypot(c, x)) })) - (1/3)) } else { (c + cbrt((-a))) })*a)
}

hamiltonian! {
    pub struct E251 { a, b, c }
    H(x, y; px, py; t) = sinh(cos((abs((((y + py)*(((px^2) + 2)^(1/3))) + atan((b*px))))^(-1/2))))
}

hamiltonian! {
    pub struct E252 { a, b, c }
    H(x, y; px, py; t) = (ln_1p(abs((px - (max(px, px)*(-7/4))))) + (x/((-((atanh((x/(1 + (x^2))))*asinh(3)) - (x - cosh(t))))^(1/3))))
}

hamiltonian! {
    pub struct E253 { a, b, c }
    H(x, y; px, py; t) = (((2 - c) - ((x/abs(ln_1p(exp(cos(py))))) + y)) - (px/(x + py)))
}

hamiltonian! {
    pub struct E254 { a, b, c }
    H(x, y; px, py; t) = ((a*a)*(if (y < px) && (2 < py) { (if ((y - px) == t) || (atan(py) < a) { c } else { (px*1) }) } else { (c*((((1/2)^2) + 1)^(2/3))) }))
}

hamiltonian! {
    pub struct E255 { a, b, c }
    H(x, y; px, py; t) = (max((atan(asin(tanh(hypot((b^-1), atan((t^2)))))) + a), abs(cos(py))) + abs(tanh((if (b == y) || ((x*pi) < t) { (1/2) } else { y }))))
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
