//! Systems that are split unaided, and those that are not.

/// A system, and the pieces it is split into, outermost first.
pub struct Found {
    pub signature: &'static str,
    pub parameters: &'static str,
    pub h: &'static str,
    pub pieces: &'static [&'static str],
}

/// A system without a splitting into exact flows, and the term that has none.
pub struct Refused {
    pub signature: &'static str,
    pub parameters: &'static str,
    pub h: &'static str,
    pub term: &'static str,
}

pub const FOUND: &[Found] = &[
    Found {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "A B C m",
        h: "((pf - pp*cos(th))*sin(ps)/sin(th) + pt*cos(ps))^2/(2*A) + ((pf - pp*cos(th))*cos(ps)/sin(th) - pt*sin(ps))^2/(2*B) + pp^2/(2*C) + m*sin(th)*sin(ps)",
        pieces: &[
            "((pf - pp*cos(th))*sin(ps)/sin(th) + pt*cos(ps))^2/(2*A) + m*sin(th)*sin(ps)",
            "((pf - pp*cos(th))*cos(ps)/sin(th) - pt*sin(ps))^2/(2*B)",
            "pp^2/(2*C)",
        ],
    },
    Found {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "A B C m",
        h: "((pf - pp*cos(th))*sin(ps) + pt*sin(th)*cos(ps))^2/(2*A*sin(th)^2) + ((pf - pp*cos(th))*cos(ps) - pt*sin(th)*sin(ps))^2/(2*B*sin(th)^2) + pp^2/(2*C) + m*cos(th)",
        pieces: &[
            "((pf - pp*cos(th))*sin(ps) + pt*sin(th)*cos(ps))^2/(2*A*sin(th)^2)",
            "((pf - pp*cos(th))*cos(ps) - pt*sin(th)*sin(ps))^2/(2*B*sin(th)^2)",
            "pp^2/(2*C) + m*cos(th)",
        ],
    },
    Found {
        signature: "q; p",
        parameters: "",
        h: "0.5*(q^2 + 1)*(p^2 + 1)",
        pieces: &["p^2/2 + 0.5", "0.5*p^2*q^2 + q^2/2"],
    },
    Found {
        signature: "r, th; pr, pt",
        parameters: "E L",
        h: "(1 - 2/r)*pr^2/2 + pt^2/(2*r^2) - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(th)^2)",
        pieces: &[
            "pr^2/2 + pt^2/(2*r^2) + L^2/(2*r^2*sin(th)^2)",
            "-E^2/(2*(1 - 2/r))",
            "-pr^2/r",
        ],
    },
    Found {
        signature: "r, th; pr, pt",
        parameters: "E L B",
        h: "(1 - 2/r)*pr^2/2 + pt^2/(2*r^2) - E^2/(2*(1 - 2/r)) + (L - B*r^2*sin(th)^2/2)^2/(2*r^2*sin(th)^2)",
        pieces: &[
            "pr^2/2 + pt^2/(2*r^2)",
            "-E^2/(2*(1 - 2/r)) + (L - 0.5*B*r^2*sin(th)^2)^2/(2*r^2*sin(th)^2)",
            "-pr^2/r",
        ],
    },
    Found {
        signature: "r, th; pr, pt",
        parameters: "a",
        h: "pr^2/2 + pt^2/(2*r^2) + r^2/2 + a*r^3*sin(3*th)/3",
        pieces: &["pr^2/2 + pt^2/(2*r^2)", "r^2/2 + a*r^3*sin(3*th)/3"],
    },
    Found {
        signature: "x, y; px, py",
        parameters: "B",
        h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2",
        pieces: &["(px + 0.5*B*y)^2/2 + (py - 0.5*B*x)^2/2"],
    },
    Found {
        signature: "x, y; px, py",
        parameters: "B",
        h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2 + x^4",
        pieces: &["(py - 0.5*B*x)^2/2 + x^4", "(px + 0.5*B*y)^2/2"],
    },
    Found {
        signature: "x, y, z; px, py, pz",
        parameters: "mu",
        h: "(px^2 + py^2 + pz^2)/2 - mu*(x*py - y*px)/(x^2 + y^2 + z^2)^(3/2) + mu^2*(x^2 + y^2)/(2*(x^2 + y^2 + z^2)^3)",
        pieces: &[
            "px^2/2 + py^2/2 + pz^2/2",
            "-mu*(x*py - y*px)/sqrt(x^2 + y^2 + z^2)^3 + mu^2*(x^2 + y^2)/(2*(x^2 + y^2 + z^2)^3)",
        ],
    },
    Found {
        signature: "x, y, z; px, py, pz",
        parameters: "",
        h: "((px + y/(x^2+y^2+z^2)^(3/2))^2 + (py - x/(x^2 + y^2+z^2)^(3/2))^2 + pz^2)/2",
        pieces: &[
            "px^2/2 + py^2/2 + pz^2/2",
            "px*y/sqrt(x^2 + y^2 + z^2)^3 + y^2/(2*(x^2 + y^2 + z^2)^3) - py*x/sqrt(x^2 + y^2 + z^2)^3 + x^2/(2*(x^2 + y^2 + z^2)^3)",
        ],
    },
    Found {
        signature: "r, z, f; pr, pz, pf",
        parameters: "",
        h: "(pr^2 + pz^2)/2 + (pf/r - r/sqrt(r^2 + z^2)^3)^2/2",
        pieces: &["pr^2/2 + pz^2/2", "(pf/r - r/sqrt(r^2 + z^2)^3)^2/2"],
    },
    Found {
        signature: "x, y, z; px, py, pz",
        parameters: "",
        h: "(px - y^2*z)^2/2 + (py - x*z^2)^2/2 + (pz - x^2*y)^2/2",
        pieces: &["(py - x*z^2)^2/2", "(pz - x^2*y)^2/2", "(px - y^2*z)^2/2"],
    },
    Found {
        signature: "l, g; L, G",
        parameters: "A B C",
        h: "(G^2 - L^2)*(sin(l)^2/A + cos(l)^2/B)/2 + L^2/(2*C)",
        pieces: &[
            "(G^2 - L^2)*cos(l)^2/(2*B)",
            "(G^2 - L^2)*sin(l)^2/(2*A)",
            "L^2/(2*C)",
        ],
    },
    Found {
        signature: "x, y; px, py",
        parameters: "m",
        h: "(px^2 + py^2)/2 - x*py + y*px - (1 - m)/sqrt((x + m)^2 + y^2) - m/sqrt((x - 1 + m)^2 + y^2)",
        pieces: &[
            "px^2/2 + py^2/2 - x*py + y*px",
            "-(1 - m)/sqrt((x + m)^2 + y^2) - m/sqrt((x + m - 1)^2 + y^2)",
        ],
    },
    Found {
        signature: "r, th; pr, pt",
        parameters: "a E L",
        h: "(r^2 - 2*r + a^2)*pr^2/2 + pt^2/2 + (a*E*sin(th) - L/sin(th))^2/2 - ((r^2 + a^2)*E - a*L)^2/(2*(r^2 - 2*r + a^2)) + (r^2 + a^2*cos(th)^2)/2",
        pieces: &[
            "(a*E*sin(th) - L/sin(th))^2/2 - ((r^2 + a^2)*E - a*L)^2/(2*(r^2 - 2*r + a^2)) + r^2/2 + 0.5*a^2*cos(th)^2",
            "0.5*(r^2 - 2*r + a^2)*pr^2 + pt^2/2",
        ],
    },
    Found {
        signature: "a, b; z, w",
        parameters: "J D",
        h: "J*sqrt(1 - z^2)*sqrt(1 - w^2)*cos(a)*cos(b) + J*sqrt(1 - z^2)*sqrt(1 - w^2)*sin(a)*sin(b) + D*z*w",
        pieces: &[
            "J*sqrt(1 - z^2)*sqrt(1 - w^2)*sin(a)*sin(b)",
            "D*z*w",
            "J*sqrt(1 - z^2)*sqrt(1 - w^2)*cos(a)*cos(b)",
        ],
    },
    Found {
        signature: "x, y; px, py",
        parameters: "B",
        h: "sqrt(1 + (px + B*y/2)^2 + (py - B*x/2)^2) + x^3*y",
        pieces: &["x^3*y", "sqrt((px + 0.5*B*y)^2 + (py - 0.5*B*x)^2 + 1)"],
    },
    Found {
        signature: "x, y, z; px, py, pz",
        parameters: "B",
        h: "(px^2 + py^2 + pz^2)/2 + B*(x*py - y*px)/2 + 1/sqrt(x^2 + y^2 + z^2)",
        pieces: &[
            "px^2/2 + py^2/2 + pz^2/2 + 0.5*B*x*py - 0.5*B*y*px",
            "1/sqrt(x^2 + y^2 + z^2)",
        ],
    },
    Found {
        signature: "th, f, s; pt, pf, ps",
        parameters: "A C m",
        h: "pt^2/(2*A) + (pf - ps*cos(th))^2/(2*A*sin(th)^2) + ps^2/(2*C) + m*cos(th)",
        pieces: &[
            "(pf - ps*cos(th))^2/(2*A*sin(th)^2) + m*cos(th)",
            "pt^2/(2*A) + ps^2/(2*C)",
        ],
    },
    Found {
        signature: "q; p; t",
        parameters: "",
        h: "0.5*(q^2 + 1)*(p^2 + 1) + q*cos(t)",
        pieces: &["q^2/2 + p^2/2 + q*cos(t) + 0.5", "0.5*q^2*p^2"],
    },
];

pub const REFUSED: &[Refused] = &[
    Refused {
        signature: "q; p",
        parameters: "",
        h: "p^2/(2*(1 + q^2))",
        term: "p^2/(2*(q^2 + 1))",
    },
    Refused {
        signature: "x, f; px, pf",
        parameters: "",
        h: "(px^2/2 + pf^2 - px*pf*cos(f))/(1 + sin(f)^2) + cos(f)",
        term: "(px^2/2 + pf^2 - px*pf*cos(f))/(sin(f)^2 + 1)",
    },
    Refused {
        signature: "q; p",
        parameters: "",
        h: "sqrt((q^2 + 1)*(p^2 + 1))",
        term: "sqrt((q^2 + 1)*(p^2 + 1))",
    },
    Refused {
        signature: "a, b; u, v",
        parameters: "",
        h: "(u^2 + 2*v^2 - 2*u*v*cos(a - b))/(2*(1 + sin(a - b)^2)) - 2*cos(a) - cos(b)",
        term: "(u^2 + 2*v^2 - 2*u*v*cos(a - b))/(2*(sin(a - b)^2 + 1))",
    },
    Refused {
        signature: "r, th; pr, pt",
        parameters: "a",
        h: "(r^2 - 2*r + a^2)*pr^2/(2*(r^2 + a^2*cos(th)^2)) + pt^2/(2*(r^2 + a^2*cos(th)^2))",
        term: "(r^2 - 2*r + a^2)*pr^2/(2*(r^2 + a^2*cos(th)^2))",
    },
    Refused {
        signature: "x, y; px, py",
        parameters: "",
        h: "sqrt(1 + (px + y^2)^2 + (py - x^2)^2)",
        term: "sqrt((px + y^2)^2 + (py - x^2)^2 + 1)",
    },
    // The dipole's field, relativistic.
    Refused {
        signature: "x, y, z; px, py, pz",
        parameters: "m",
        h: "sqrt(1 + (px + m*y/(x^2 + y^2 + z^2)^(3/2))^2 + (py - m*x/(x^2 + y^2 + z^2)^(3/2))^2 + pz^2)",
        term: "sqrt((px + m*y/sqrt(x^2 + y^2 + z^2)^3)^2 + (py - m*x/sqrt(x^2 + y^2 + z^2)^3)^2 + pz^2 + 1)",
    },
    // Two bodies as one in an effective metric (A. Buonanno, T. Damour, Phys. Rev. D 59 (1999) 084006).
    Refused {
        signature: "r, f; pr, L",
        parameters: "n",
        h: "sqrt(1 + 2*n*(sqrt((1 - 2/r + 2*n/r^3)*(1 + L^2/r^2 + (1 - 2/r + 2*n/r^3)*pr^2/(1 - 6*n/r^2))) - 1))/n",
        term: "sqrt(2*n*(sqrt((1 - 2/r + 2*n/r^3)*(L^2/r^2 + (1 - 2/r + 2*n/r^3)*pr^2/(1 - 6*n/r^2) + 1)) - 1) + 1)/n",
    },
    // Vortices with a period in x, and with one in y too, as long as they are near in y.
    Refused {
        signature: "x1, x2, x3; y1, y2, y3",
        parameters: "",
        h: "-ln(cosh(y1 - y2) - cos(x1 - x2)) - ln(cosh(y1 - y3) - cos(x1 - x3)) - ln(cosh(y2 - y3) - cos(x2 - x3))",
        term: "-ln(cosh(y1 - y2) - cos(x1 - x2))",
    },
    Refused {
        signature: "x1, x2; y1, y2",
        parameters: "",
        h: "(y1 - y2)^2/6 - ln(cosh(y1 - y2) - cos(x1 - x2)) - ln(cosh(y1 - y2 - 6) - cos(x1 - x2)) - ln(cosh(y1 - y2 + 6) - cos(x1 - x2))",
        term: "-ln(cosh(y1 - y2) - cos(x1 - x2))",
    },
    // A geodesic flow of two dimensions.
    Refused {
        signature: "x, y; px, py",
        parameters: "",
        h: "px^2/(2 + cos(x)*sin(y)) + sin(x + y)*px*py/3 + (3 + cos(x*y))*py^2/2",
        term: "px^2/(cos(x)*sin(y) + 2)",
    },
];
