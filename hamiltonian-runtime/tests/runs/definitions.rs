//! Definitions, each compiled and as a text.
//!
//! Input: nothing. Output: for each a module with the type of the system and `TEXT`.

/// A compiled definition `$name`, and its text.
macro_rules! both {
    ($name:ident: $($definition:tt)*) => {
        pub mod $name {
            use hamiltonian::prelude::*;
            hamiltonian! { $($definition)* }
            pub const TEXT: &str = stringify!($($definition)*);
        }
    };
}

both!(pendulum: pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 } H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta));
both!(henon: pub struct Henon { lambda = 1.0 }
    H(x, y; px, py) = (px^2 + py^2)/2 + (x^2 + y^2)/2 + lambda*(x^2*y - y^3/3));
both!(product: pub struct Product {} H(q; p) = (q^2 + 1)*(p^2 + 1)/2);
both!(driven: pub struct Driven { a = 0.3, omega = 2.0 } H(q; p; t) = p^2/2 + q^4/4 - a*q*cos(omega*t));
both!(chain: pub struct Chain { n: usize, k = 1.0, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + k*(exp(q[(i + 1) % n] - q[i]) - 1) });
both!(bodies: pub struct Bodies { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) });
both!(damped: pub struct Damped { gamma = 0.1 }
    H(q; p) = p^2/2 - cos(q); force(q; p) = -gamma*p*abs(p));
both!(dragged: pub struct Dragged { gamma = 0.1, k = 1.5 }
    H(x, y; u, v) = (u^2 + v^2)/2 + k*(x^2 + y^4)/2; force(x, y; u, v) = [-gamma*x*u + y, -gamma*v]);
both!(slowed: pub struct Slowed { gamma = 0.1 }
    H(x, y; u, v) = u^2/2 + v^2/2 + x^2/2; force(x, y; u, v) = [-gamma*u, -gamma*(1 + y^2)*v]);
both!(turned: pub struct Turned { b = 0.7, gamma = 0.1 }
    H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2; force(x, y; u, v) = [b*v - gamma*u + x*y, -b*x*u - gamma*v]);
both!(whirled: pub struct Whirled { gamma = 0.1 }
    H(x, y; u, v) = (x^2 + 1)*(u^2 + 1)/2 + v^2/2 + y^2/2; force(x, y; u, v) = [-gamma*u*abs(u), -gamma*x*v]);
both!(sliding: pub struct Sliding { n: usize, u: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + q[i]^2/2 + q[i]^4/4 }; force(q; p) = -dot(u, p)*u);
both!(mean: pub struct Mean { n: usize }
    H(q[n], x; p[n], y) = (x^2 + 1)*(y^2 + 1)/2 + sum(i in 0..n) { p[i]^2/2 }
        + sum(i in 0..n, j in 0..n) { cos(q[i] - q[j]) }/n);
both!(tabulated: pub struct Tabulated { V: fn(r), W: fn(x, y), k = 0.3 }
    H(x, y; u, v) = (u^2 + v^2)/2 + V(x)*(1 + y^2) + k*W(x, y));
both!(cloud: pub struct Cloud { n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + sum(i in 0..n, j in 0..i) { 1/(1 + (q[i] - q[j])^2) });
both!(switched: pub struct Switched { k = 3.0 }
    H(x, y; u, v) = (u^2 + v^2)/2 + if x > y { k*(x - y)^2/2 } else { sqrt(1 + (x - y)^2) } + atan2(y, 2 + x));
both!(shifted: pub struct Shifted { n: usize, g = 0.7 }
    H(q[n]; p[n]) = g*sum(i in 1..n) { q[i]*p[i - 1] });
both!(between: pub struct Between { n: usize, g = 0.7 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + g*sum(i in 1..n) { q[i]*p[i - 1] } + g*q[0]*p[n - 1]/2
        + q[n - 1]^2*p[n - 1]/4);
both!(innermost: pub struct Innermost { n: usize, g = 0.7 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + q[i]^2/2 } + g*sum(i in 1..n) { q[i]*p[i - 1] - q[i - 1]*p[i] } + sum(i in 0..n) { q[i]^4 });
both!(outermost: pub struct Outermost { n: usize, g = 0.7 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 + q[i]^4 } + g*sum(i in 1..n) { q[i]*p[i - 1] };
    split { Sweep = g*sum(i in 1..n) { q[i]*p[i - 1] }; T = sum(i in 0..n) { p[i]^2/2 }; V = sum(i in 0..n) { q[i]^4 } });
both!(coupled: pub struct Coupled { a = 1.1, b = 2.3, k = 0.4 }
    H(x, y, z; u, v, w) = (u^2 + a*v^2 + b*w^2)/2 + (x^2 + 2*y^2 + 3*z^2)/2 + k*(x*y + y*z + x*w - z*u) + y + u*v/3);
both!(trapped: pub struct Trapped { a = 1.1, b = 2.3, k = 0.4 }
    H(x, y, z; u, v, w) = (u^2 + a*v^2 + b*w^2)/2 + (x^2 + 2*y^2 + 3*z^2)/2 + k*(x*y + y*z + x*w - z*u) + y + u*v/3 + x^4 + y^2*z^2);
