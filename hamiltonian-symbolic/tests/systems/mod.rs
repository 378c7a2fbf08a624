//! Systems with sums, of every form of loop there is.

mod instance;

pub use instance::{Instance, Place, at};

/// A system: signature, parameters, H; its number of terms grows like `N^order`.
pub struct System {
    pub name: &'static str,
    pub signature: &'static str,
    pub parameters: &'static str,
    pub h: &'static str,
    pub order: u32,
}

pub const TODA: System = System {
    name: "Toda ring",
    signature: "q[N]; p[N]",
    parameters: "",
    h: "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }",
    order: 1,
};
pub const GRAVITY: System = System {
    name: "gravity",
    signature: "q[N][3]; p[N][3]",
    parameters: "G m[N]",
    h: "sum(i in 0..N) { (p[i][0]^2 + p[i][1]^2 + p[i][2]^2)/(2*m[i]) }
        - G*sum(i in 0..N, j in 0..i) { m[i]*m[j]
        / sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2 + (q[i][2] - q[j][2])^2) }",
    order: 2,
};
pub const SQUARE_ROOT: System = System {
    name: "root of a sum",
    signature: "q[N]; p[N]",
    parameters: "",
    h: "sqrt(1 + sum(i in 0..N) { p[i]^2 }) + sum(i in 0..N) { cos(q[i]) }",
    order: 1,
};

pub const SYSTEMS: &[System] = &[
    TODA,
    GRAVITY,
    SQUARE_ROOT,
    System {
        name: "a sum in the branch of a condition",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2*if i < 2 { sum(j in 0..N) { q[j]^2 } } else { 1 + q[i] } }",
        order: 2,
    },
    System {
        name: "a root of a sum in the branch of a condition",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { if q[i] > 0 { p[i]^2*sqrt(1 + sum(j in 0..N) { q[j]^2*p[i]^2 + q[j]^4 }) }
            else { p[i]^2 } }",
        order: 2,
    },
    System {
        name: "the larger of an element and a sum",
        signature: "q[N]; p[N]",
        parameters: "m[N]",
        h: "sum(i in 0..N) { p[i]^2*max(q[i], sum(j in 0..N) { m[j]*q[j]*p[j]^2 }) }",
        order: 2,
    },
    System {
        name: "triangles in branches, and branches in them",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2*if q[i] > 0 { sum(j in 0..i + 1) { sin(q[j]*p[i]) } } else { q[i] } }
            + sum(i in 0..N, j in 0..i) { if q[i] < q[j] { sum(k in 0..N, l in 0..k) { q[k]*p[l]*q[j] } }
            else { min(p[i], sum(k in 0..i) { if p[k] > 0 { q[k]^2*p[j] } else { sum(l in 0..N) { q[l]^3 } } }) } }",
        order: 4,
    },
    System {
        name: "open chain",
        signature: "q[N]; p[N]",
        parameters: "k m[N]",
        h: "sum(i in 0..N) { p[i]^2/(2*m[i]) }
            + sum(i in 0..N-1) { k*(q[i + 1] - q[i])^2/2 + (q[i] - q[i + 1])^4/4 }",
        order: 1,
    },
    System {
        name: "FPUT",
        signature: "x[N]; y[N]",
        parameters: "alpha beta",
        h: "sum(i in 0..N) { y[i]^2/2 } + sum(i in 0..N) { (x[(i + 1) % N] - x[i])^2/2
            + alpha*(x[(i + 1) % N] - x[i])^3/3 + beta*(x[(i + 1) % N] - x[i])^4/4 }",
        order: 1,
    },
    System {
        name: "mean field",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N) { cos(q[i]) }^2/(2*N)
            + exp(sum(i in 0..N) { sin(q[i]) }/N)",
        order: 1,
    },
    System {
        name: "loop variables as reals",
        signature: "q[N]; p[N]",
        parameters: "a",
        h: "sum(i in 0..N) { (i + 1)*q[i]^2/2 + p[i]^2/(2 + i*N) + sin(a*i)*q[i] }
            + sum(i in 1..N+1, j in i..N+1) { q[i - 1]/(i + j) }",
        order: 2,
    },
    System {
        name: "inner sums on their own",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2 + sin(q[i])*sum(j in 0..N) { q[j]^2 }
            + exp(q[i]*sum(j in 0..N) { p[j] }/N^2) }",
        order: 2,
    },
    System {
        name: "joint sums",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N, j in 0..N) { cos(q[i] - q[j]) } + sum(i in 0..N, j in i..N) { q[i]*q[j]*p[j] }",
        order: 2,
    },
    System {
        name: "offsets",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { sin(q[(i - 1) % N])*p[(i + 2) % N] } + sum(i in 0..N-2) { q[i]*q[i + 1]*q[i + 2] }
            + sum(i in 1..N) { p[i]*p[i - 1]^2 } + sum(i in 0..N) { q[N - 1 - i]*p[i] }",
        order: 1,
    },
    System {
        name: "constant bodies",
        signature: "q[N]; p[N]",
        parameters: "a",
        h: "sum(i in 0..N) { 3 }*q[0]^2 + sum(i in 0..N, j in 0..i) { 1 }*p[0]^2
            + sum(i in 0..N, j in 0..i) { q[i] } + sum(i in 0..N) { a*q[0] + a^2 } + sum(i in 0..N) { i }*p[0]
            + sum(i in N..N) { q[i] } + sum(i in 3..1) { q[i] }",
        order: 2,
    },
    System {
        name: "matrix",
        signature: "q[N]; p[N]",
        parameters: "M[N][N] V[N][N]",
        h: "sum(i in 0..N) { p[i]*sum(j in 0..N) { M[i][j]*p[j] } }/2
            + sum(i in 0..N, j in 0..N) { cos(q[i])*V[i][j]*q[j] }",
        order: 2,
    },
    System {
        name: "three axes",
        signature: "q[N]; p[N]",
        parameters: "w[N][2][N]",
        h: "sum(i in 0..N, j in 0..2, k in 0..N) { w[i][j][k]*q[i]*p[k]^2 + w[(i + 1) % N][1 - j][k]^2*cos(q[k]) }
            + sum(i in 1..N, k in 0..N) { w[i - 1][1][(k - 1) % N]/w[i][0][k]*q[i]^3 }",
        order: 2,
    },
    System {
        name: "conditions",
        signature: "q[N]; p[N]",
        parameters: "k",
        h: "sum(i in 0..N) { if q[i] > 0 && i > 0 { k*q[i]^1.5 } else { p[i]^2*exp(-q[i]) }
            + abs(q[i] - p[i]) + min(q[i], p[i]^2) }
            + sum(i in 0..N, j in 0..i) { if (q[i] - q[j])^2 < 1 { ln((q[i] - q[j])^2) } else { 0 } }",
        order: 2,
    },
    System {
        name: "mixed shapes and time",
        signature: "q[N], s, r[N][2]; p[N], u, w[N][2]; t",
        parameters: "a",
        h: "u^2/2 + s*sum(i in 0..N) { p[i]^2*exp(-a*t) } + cos(t)*sum(i in 0..N) { q[i]*s }
            + sum(i in 0..N) { r[i][0]*w[i][1] - r[i][1]*w[i][0]/(1 + q[i]^2) }",
        order: 1,
    },
    System {
        name: "functions of inner sums",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { ln(1 + sum(j in 0..N) { (q[i] - q[j])^2 }) + p[i]^2/2 }
            + sum(i in 0..N) { sqrt(1 + sum(j in 0..i) { exp(q[j] - q[i]) }) }",
        order: 2,
    },
    System {
        name: "quotients of sums",
        signature: "q[N]; p[N]",
        parameters: "m[N]",
        h: "sum(i in 0..N) { m[i]*q[i] }^2/sum(i in 0..N) { m[i] } + sum(i in 0..N) { p[i]^2/m[i] }
            /sqrt(sum(i in 0..N) { m[i]^2 }) + sin(sum(i in 0..N) { p[i]*sum(j in 0..i) { m[j] } })",
        order: 2,
    },
    System {
        name: "three indices",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "sum(i in 0..N) { p[i]^2/2 } + sum(i in 0..N, j in 0..i, k in 0..j) {
            1/(1 + (q[i] - q[j])^2*(q[j] - q[k])^2) }/N^2",
        order: 3,
    },
    System {
        name: "single elements",
        signature: "q[N]; p[N]",
        parameters: "",
        h: "p[0]^2/2 + cos(q[0] - q[N - 1]) + q[0]*sum(i in 0..N) { sin(q[i] - q[0]) }",
        order: 1,
    },
];
