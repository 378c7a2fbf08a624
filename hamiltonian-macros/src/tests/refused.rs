//! Definitions that are refused, their errors marked, and the words of the errors.

/// The source, every error between `⟦` and `⟧`, and the texts of the errors in their order.
#[rustfmt::skip]
pub(super) const CASES: &[(&str, &str)] = &[
    (
        r##"H = p^2/2 + ⟦2q⟧"##,
        r##"`2q` is not a product
help: write `2*q`"##,
    ),
    (
        r##"H = p^2/⟦2m⟧"##,
        r##"`2m` is not a product
help: write `(2*m)` to divide by the product, `2*m` to multiply by `m` afterwards"##,
    ),
    (
        r##"H = ⟦2sin⟧(q) + p^2"##,
        r##"`2sin` is not a product
help: write `2*sin(…)`"##,
    ),
    (
        r##"H = p^2*⟦.5⟧"##,
        r##"`.5` does not begin with a digit
help: write `0.5`"##,
    ),
    (
        r##"H = ⟦1.0f64⟧*p^2 + ⟦2u32⟧*q"##,
        r##"`1.0f64` has a type, but numbers are exact here and have none
help: write `1.0`
`2u32` has a type, but numbers are exact here and have none
help: write `2`"##,
    ),
    (
        r##"H = ⟦0x1F⟧*p^2"##,
        r##"`0x1F` is not a decimal number
help: write `31`"##,
    ),
    (
        r##"H = ⟦1e400⟧*p^2"##,
        r##"`1e400` is larger than any f64
help: write a number up to 1.7e308"##,
    ),
    (
        r##"H = ⟦1e-400⟧*p^2"##,
        r##"`1e-400` is smaller than any f64 but not 0
help: write `0`, or a number from 1e-323"##,
    ),
    (
        r##"H = ⟦"two"⟧*p^2"##,
        r##""two" is not a number
help: write a decimal number"##,
    ),
    (
        r##"H = ⟦1e99999999999999999999⟧*p^2"##,
        r##"`1e99999999999999999999` does not fit an f64
help: write a number between 1e-323 and 1.7e308"##,
    ),
    (
        r##"H = p⟦**⟧2/2 + q⟦**⟧2/2"##,
        r##"`**` is not an operator
help: write `^` for a power
`**` is not an operator
help: write `^` for a power"##,
    ),
    (
        r##"H = p ⟦q⟧ + p^2"##,
        r##"an operator is missing between `p` and `q`
help: write `p*q`"##,
    ),
    (
        r##"H = 2 ⟦p⟧ + p^2"##,
        r##"an operator is missing between `2` and `p`
help: write `2*p`"##,
    ),
    (
        r##"H = 2⟦(⟧q + 1) + p^2"##,
        r##"an operator is missing between `2` and `(…)`
help: write `2*(…)`"##,
    ),
    (
        r##"H = (q)⟦(⟧p)"##,
        r##"an operator is missing before `(`
help: write `*` between the factors of a product"##,
    ),
    (
        r##"H = ⟦q·p⟧ + p^2"##,
        r##"`q·p` is one name to Rust: `·` is a letter
help: write `q*p`"##,
    ),
    (
        r##"H = q ⟦==⟧ p"##,
        r##"`==` makes a condition where a number is due
help: write `if a == b { … } else { … }`"##,
    ),
    (
        r##"H = p^2 ⟦&⟧ q"##,
        r##"`&` is not an operator
help: write `&&` between conditions"##,
    ),
    (
        r##"H = p^2 ⟦+⟧"##,
        r##"a value is missing after `+`
help: write one, or remove what waits for it"##,
    ),
    (
        r##"H = p^2 + ⟦*⟧ q"##,
        r##"expected a number, a name or `(`, found `*`
help: write a value on each side of an operator"##,
    ),
    (
        r##"H = ⟦-⟧"##,
        r##"a value is missing after `-`
help: write one, or remove what waits for it"##,
    ),
    (
        r##"H = p^2*(q ⟦+⟧ )"##,
        r##"a value is missing after `+`
help: write one, or remove what waits for it"##,
    ),
    (
        r##"H = ⟦()⟧"##,
        r##"there is nothing inside
help: write a value"##,
    ),
    (
        r##"H = ⟦{⟧p^2}"##,
        r##"braces do not group
help: write `( … )`; braces hold the body of a `sum` and the branches of an `if`"##,
    ),
    (
        r##"H = p^2 + ⟦|⟧q|"##,
        r##"bars do not mean the absolute value
help: write `abs(x)`"##,
    ),
    (
        r##"H = p^2 + ⟦&⟧q"##,
        r##"references mean nothing here: names are captured by value
help: leave out the `&`"##,
    ),
    (
        r##"H = (q⟦,⟧ p)"##,
        r##"a list is not a value
help: write `[a, b]` for a vector"##,
    ),
    (
        r##"H = p^2 + q⟦!⟧"##,
        r##"`!` stands before a condition
help: there is no factorial; write the number"##,
    ),
    (
        r##"H = p^2/2 + V ⟦=⟧ 3"##,
        r##"a second `=` in one statement
help: write `;` between statements, `==` to compare in a condition"##,
    ),
    (
        r##"H = p^2 + 3 ⟦%⟧ 2"##,
        r##"`%` stands only in an index
help: write `q[(i + 1) % N]` to go round; elsewhere there is no remainder"##,
    ),
    (
        r##"H = if 0 < q ⟦<⟧ 1 { p^2 } else { 0 }"##,
        r##"comparisons do not chain
help: write `a < b && b < c`"##,
    ),
    (
        r##"H = ⟦q.sin()⟧ + ⟦p.powi(2)⟧"##,
        r##"`q.sin(…)`: a function stands before its argument
help: write `sin(q)`
`p.powi(…)`: a function stands before its argument
help: write `p^2`"##,
    ),
    (
        r##"H = p^2/⟦self.m⟧"##,
        r##"`self.m`: fields are not captured
help: bind it before the macro, `let m = self.m;`, and write `m`"##,
    ),
    (
        r##"H = p^2 + ⟦q.0⟧"##,
        r##"`.0` after a value means nothing
help: write `q[0]` for a component"##,
    ),
    (
        r##"H = p^2*⟦std::f64::consts::PI⟧"##,
        r##"a path is not a value here
help: write `pi`"##,
    ),
    (
        r##"H = p^2 + ⟦std::cmp::max⟧(q, p)"##,
        r##"a path is not a value here
help: write `max`"##,
    ),
    (
        r##"H = p^2 + ⟦_⟧ + ⟦r#type⟧"##,
        r##"`_` is not a name
help: give it a name
the raw identifier `r#type` cannot be a name
help: choose another name, such as `type_`"##,
    ),
    (
        r##"H = p^2 + ⟦for⟧"##,
        r##"`for` is a keyword of Rust and not a value
help: choose another name"##,
    ),
    (
        r##"H = p^2 + ⟦sin⟧(q, 1)"##,
        r##"`sin` takes 1 argument, not 2
help: write `sin(x)`"##,
    ),
    (
        r##"H = p^2 + ⟦sin⟧"##,
        r##"`sin` is a function and no value by itself
help: write `sin(x)`"##,
    ),
    (
        r##"H = p^2 + ⟦sin⟧()"##,
        r##"`sin` takes 1 argument, not 0
help: write `sin(x)`"##,
    ),
    (
        r##"H = p^2 + ⟦log⟧(q) + ⟦arctan⟧(q) + ⟦log10⟧(q)"##,
        r##"unknown function `log`
help: write `ln(x)`
unknown function `arctan`
help: write `atan(x)`
unknown function `log10`
help: write `ln(x)/ln(10)`"##,
    ),
    (
        r##"H = p^2 + ⟦foo⟧(q)"##,
        r##"unknown function `foo`
help: define it, `let foo(x) = …;`, or write `foo*(…)` for a product"##,
    ),
    (
        r##"H = p^2 + ⟦sine⟧(q)"##,
        r##"unknown function `sine`
help: the nearest known function is `sin`"##,
    ),
    (
        r##"H = p^2 + ⟦q⟧(1)"##,
        r##"`q` is a coordinate, not a function
help: write `q*(…)` for a product"##,
    ),
    (
        r##"H = p^2 + ⟦pi⟧(2) + ⟦H⟧(q)"##,
        r##"`pi` is a constant, not a function
help: write `pi*(…)` for a product
`H` is a value here, not a function
help: write `H`"##,
    ),
    (
        r##"H = p^2 + ⟦t⟧*q"##,
        r##"`t` is not declared
help: declare it: `H(q; p; t)`"##,
    ),
    (
        r##"H(theta; p) = p^2 + ⟦t⟧*theta"##,
        r##"`t` is not declared
help: declare it: `H(theta; p; t)`"##,
    ),
    (
        r##"H = p^2 + ⟦ds⟧"##,
        r##"`ds` is a word of the language and not a value
help: it stands in a statement of its own: `dt = (…)*ds`"##,
    ),
    (
        r##"H = p^2 + ⟦H⟧"##,
        r##"`H` is defined by itself
help: H depends on coordinates, momenta, time and parameters"##,
    ),
    (
        r##"H = p^2 + ⟦event⟧"##,
        r##"`event` begins a statement and is not a value
help: choose another name, or write it as a statement of its own"##,
    ),
    (
        r##"H = p^2 + ⟦atan2⟧(q)"##,
        r##"`atan2` takes 2 arguments, not 1
help: write `atan2(y, x)`"##,
    ),
    (
        r##""##,
        r##"there is no Hamiltonian here
help: write `H = p^2/2 + q^2/2`"##,
    ),
    (
        r##"⟦x⟧"##,
        r##"expected a statement, found `x`
help: write `H = …` before the expression"##,
    ),
    (
        r##"⟦V⟧ = q^2"##,
        r##"`V` is not declared by anything
help: write `let V = …`"##,
    ),
    (
        r##"⟦h⟧ = p^2"##,
        r##"`h` does not begin a statement
help: write `H`"##,
    ),
    (
        r##"H ⟦==⟧ p^2"##,
        r##"expected `=` after `H`, found `==`
help: write `H = …`"##,
    ),
    (
        r##"H ⟦+=⟧ p^2"##,
        r##"expected `=` after `H`, found `+=`
help: write `H = …`"##,
    ),
    (
        r##"⟦H⟧"##,
        r##"expected `=` after `H`, found the end
help: write `H = …`"##,
    ),
    (
        r##"H ⟦=⟧"##,
        r##"an expression is missing after `=`
help: write one"##,
    ),
    (
        r##"H = p^2;⟦;⟧ let a = 1"##,
        r##"a statement is missing before this `;`
help: remove the `;`"##,
    ),
    (
        r##"H = p^2⟦,⟧ let a = 1"##,
        r##"statements are separated by `;`
help: write `;` instead of `,`"##,
    ),
    (
        r##"H = p^2 ⟦let⟧ a = 1"##,
        r##"a `;` is missing before `let`
help: statements are separated by `;`"##,
    ),
    (
        r##"let V = q^2 ⟦H⟧ = p^2 + V"##,
        r##"a `;` is missing before `H`
help: statements are separated by `;`"##,
    ),
    (
        r##"H = p^2; ⟦H⟧ = q^2"##,
        r##"`H` is defined twice
help: keep one definition; parts of it are named by `let`"##,
    ),
    (
        r##"H = p^2; ⟦L⟧(q; v) = v^2"##,
        r##"both `H` and `L` are given
help: keep one: the other follows from it"##,
    ),
    (
        r##"⟦L⟧ = v^2"##,
        r##"a Lagrangian names its coordinates and velocities
help: write `L(q; v) = …`"##,
    ),
    (
        r##"⟦let⟧ a = 1"##,
        r##"the Hamiltonian is missing
help: write `H(q; p) = …` among the statements"##,
    ),
    (
        r##"let a = ⟦a⟧ + 1; H = p^2 + a"##,
        r##"`a` is defined by itself
help: a `let` uses only what stands above it"##,
    ),
    (
        r##"let a = ⟦b⟧; let b = 1; H = p^2 + a"##,
        r##"`b` is used above its definition
help: move the definition of `b` above this statement"##,
    ),
    (
        r##"let f(x) = ⟦g⟧(x); let g(x) = f(x); H = p^2 + f(q)"##,
        r##"`g` is used above its definition
help: move the definition of `g` above this statement"##,
    ),
    (
        r##"let f(x) = ⟦f⟧(x - 1); H = p^2 + f(q)"##,
        r##"`f` is defined by itself
help: a `let` uses only what stands above it"##,
    ),
    (
        r##"let a = ⟦H⟧; H = p^2 + a"##,
        r##"`H` is used above its definition
help: move this statement below the definition of `H`"##,
    ),
    (
        r##"let f⟦()⟧ = 1; H = p^2"##,
        r##"a function without arguments
help: write `let f = …`"##,
    ),
    (
        r##"let f(x, ⟦x⟧) = x; H = p^2 + f(q, q)"##,
        r##"the argument `x` stands twice
help: give each argument a name of its own"##,
    ),
    (
        r##"let f(x) = x*y2; H = p^2 + ⟦f⟧"##,
        r##"`f` is a function and no value by itself
help: write `f(x)`"##,
    ),
    (
        r##"let f(x) = x; H = p^2 + ⟦f⟧(q, 1)"##,
        r##"`f` takes 1 argument, not 2
help: write `f(x)`"##,
    ),
    (
        r##"let ⟦mut⟧ a = 1; H = p^2"##,
        r##"nothing changes here
help: write `let name = …` without `mut`"##,
    ),
    (
        r##"let a⟦:⟧ f64 = 1; H = p^2"##,
        r##"values have no declared type here
help: write `let a = …`"##,
    ),
    (
        r##"let ⟦sin⟧ = 1; H = p^2"##,
        r##"`sin` is a function of the language and cannot be redeclared
help: choose another name"##,
    ),
    (
        r##"let ⟦pi⟧ = 3; H = p^2"##,
        r##"`pi` is a constant of the language and cannot be redeclared
help: choose another name"##,
    ),
    (
        r##"let ⟦q⟧ = 3; H = p^2"##,
        r##"the name `q` is used twice: it is a coordinate already
help: choose another name"##,
    ),
    (
        r##"let ⟦type⟧ = 3; H = p^2"##,
        r##"`type` is a keyword of Rust and cannot be a name
help: choose another name"##,
    ),
    (
        r##"⟦let⟧ H = 3; H = p^2"##,
        r##"`H` stands without `let`
help: write `H = …`"##,
    ),
    (
        r##"let a = q ⟦>⟧ 1; H = p^2*a"##,
        r##"`>` makes a condition where a number is due
help: write `if a > b { … } else { … }`"##,
    ),
    (
        r##"⟦const⟧ a = 1; H = p^2"##,
        r##"`const` declares nothing here
help: write `let name = …`"##,
    ),
    (
        r##"⟦5⟧ + 3"##,
        r##"expected a statement, found `5`
help: write `H(q; p) = …`, `let name = …`, `invariant name = …` or another statement"##,
    ),
    (
        r##"⟦monitr⟧ e = 1; H = p^2"##,
        r##"`monitr` does not begin a statement
help: write `monitor`"##,
    ),
    (
        r##"invariant e⟦;⟧ H = p^2"##,
        r##"expected `=` after `invariant e`, found `;`
help: write `invariant e = …`"##,
    ),
    (
        r##"⟦#[assume]⟧ monitor e = p; H = p^2"##,
        r##"`#[assume]` says nothing of `monitor`
help: write it before an `invariant` or a `split`"##,
    ),
    (
        r##"⟦#[cold]⟧ H = p^2"##,
        r##"`#[cold]` means nothing on a statement
help: remove it; docs and, on invariants and splits, `#[assume]` are possible"##,
    ),
    (
        r##"⟦#[max_ops = 3]⟧ H = p^2"##,
        r##"`#[max_ops]` belongs to a type
help: write it before `struct`"##,
    ),
    (
        r##"invariant e = H on ⟦q⟧ = 1; H = p^2"##,
        r##"expected `H` after `on`, found `q`
help: write `on H = …`"##,
    ),
    (
        r##"invariant e = H on H = ⟦[1, 2]⟧; H = p^2"##,
        r##"the energy of a shell is a scalar, but this is a vector `[2]`
help: write `norm_squared(…)`, `dot(a, b)` or a component"##,
    ),
    (
        r##"monitor e = q ⟦on⟧ H = 1; H = p^2"##,
        r##"`on` names the shell of an invariant
help: write `invariant name = e on H = …`"##,
    ),
    (
        r##"event e = q ⟦>⟧ 1; H = p^2"##,
        r##"`>` makes a condition where a number is due
help: write `if a > b { … } else { … }`"##,
    ),
    (
        r##"event e = ⟦[q, p]⟧; H = p^2"##,
        r##"an event is a scalar, but this is a vector `[2]`
help: write `norm_squared(…)`, `dot(a, b)` or a component"##,
    ),
    (
        r##"monitor a = q; monitor ⟦a⟧ = p; H = p^2"##,
        r##"the name `a` is used twice: an observable has it already
help: choose another name"##,
    ),
    (
        r##"monitor ⟦energy⟧ = p^2; H = p^2"##,
        r##"`energy` is a method of every system already
help: choose another name"##,
    ),
    (
        r##"⟦split⟧ A; H = p^2"##,
        r##"`split` needs its pieces in braces
help: write `split { A = …; B = … }`"##,
    ),
    (
        r##"⟦split⟧ { A = p^2 }; H = p^2"##,
        r##"`split` needs two pieces or more
help: write `split { A = …; B = … }`"##,
    ),
    (
        r##"split { A = p^2; ⟦A⟧ = q }; H = p^2 + q"##,
        r##"the piece `A` stands twice
help: give each piece a name of its own"##,
    ),
    (
        r##"split { A = p^2; B = ⟦[q, q]⟧ }; H = p^2 + q"##,
        r##"the piece `B` is a scalar, but this is a vector `[2]`
help: write `norm_squared(…)`, `dot(a, b)` or a component"##,
    ),
    (
        r##"split { A = p^2; B = q }; ⟦split⟧ { A = p^2; B = q }; H = p^2 + q"##,
        r##"`split` stands twice
help: keep one"##,
    ),
    (
        r##"⟦force⟧ = -p; H = p^2"##,
        r##"a force names the coordinates and momenta it acts on
help: write `force(q; p) = …`"##,
    ),
    (
        r##"force⟦(x; p)⟧ = -p; H = p^2"##,
        r##"a force acts on the coordinates and momenta of the definition
help: write `force(q; p)`"##,
    ),
    (
        r##"force(q; p) = ⟦[1, 2]⟧; H = p^2"##,
        r##"the force on `p` is a scalar, not a vector `[2]`
help: give it the shape of the momentum it acts on"##,
    ),
    (
        r##"H(x, y; p_x, p_y) = p_x^2 + p_y^2; force(x, y; p_x, p_y) = ⟦-x⟧"##,
        r##"a force has one component for each of the 2 momenta
help: write `[f_x, f_y]`"##,
    ),
    (
        r##"H(x, y; p_x, p_y) = p_x^2 + p_y^2; force(x, y; p_x, p_y) = ⟦[-x, -y, 0]⟧"##,
        r##"3 components of force act on 2 momenta
help: write one for each momentum, in their order"##,
    ),
    (
        r##"H(x[2]; y[2]) = norm_squared(y); force(x; y) = ⟦-x[0]⟧"##,
        r##"the force on `y` is a vector `[2]`, not a scalar
help: give it the shape of the momentum it acts on"##,
    ),
    (
        r##"force(q; p) = -p; ⟦force⟧(q; p) = -p; H = p^2"##,
        r##"`force` stands twice
help: keep one"##,
    ),
    (
        r##"dt = ⟦q⟧; H = p^2"##,
        r##"the new time is not a factor of the right side
help: write `dt = (…)*ds`, with `ds` as the last factor"##,
    ),
    (
        r##"dt = ⟦q*ds*p⟧; H = p^2"##,
        r##"the new time is not a factor of the right side
help: write `dt = (…)*ds`, with `ds` as the last factor"##,
    ),
    (
        r##"dt = q*ds; ⟦dt⟧ = q*ds; H = p^2"##,
        r##"`dt` stands twice
help: keep one"##,
    ),
    (
        r##"dt = ⟦[q, q]⟧*ds; H = p^2"##,
        r##"the factor of `ds` is a scalar, but this is a vector `[2]`
help: write `norm_squared(…)`, `dot(a, b)` or a component"##,
    ),
    (
        r##"coordinates ⟦polar⟧; H = p^2"##,
        r##"the coordinates that `polar` replaces are missing
help: write `coordinates polar(x, y)`, `spherical(x, y, z)`, `jacobi(q, m)` or `heliocentric(q, m)`"##,
    ),
    (
        r##"coordinates ⟦polar⟧(q); H = p^2"##,
        r##"`polar` replaces 2 coordinates, not 1
help: write `polar(x, y)`"##,
    ),
    (
        r##"coordinates polar(⟦x⟧, y); H = p^2"##,
        r##"`x` is not a coordinate
help: the coordinates are `q`"##,
    ),
    (
        r##"coordinates ⟦polr⟧(q); H = p^2"##,
        r##"unknown coordinates `polr`
help: write `polar`"##,
    ),
    (
        r##"coordinates ⟦cylindrical⟧(q); H = p^2"##,
        r##"unknown coordinates `cylindrical`
help: known are `polar`, `spherical`, `jacobi`, `heliocentric`"##,
    ),
    (
        r##"coordinates ⟦jacobi⟧(q); H = p^2"##,
        r##"`jacobi` needs positions and masses
help: write `coordinates jacobi(q, m)` with positions `[n][3]` and masses `[n]`"##,
    ),
    (
        r##"coordinates jacobi(q, ⟦p⟧); H = p^2"##,
        r##"`p` is not a parameter
help: write `coordinates jacobi(q, m)` with positions `[n][3]` and masses `[n]`"##,
    ),
    (
        r##"coordinates polar(q, ⟦q⟧); H = p^2"##,
        r##"the coordinate `q` stands twice
help: write `polar(x, y)`"##,
    ),
    (
        r##"fn ⟦f⟧ = g; H = p^2"##,
        r##"the arguments of `f` are missing
help: write `fn name(x) = value, (derivative)`, with paths of Rust functions"##,
    ),
    (
        r##"fn f(x) = a::b ⟦c⟧, (d); H = p^2 + f(q)"##,
        r##"`a :: b c` is not the path of a Rust function
help: write `fn name(x) = value, (derivative)`, with paths of Rust functions"##,
    ),
    (
        r##"fn f(x) = g⟦;⟧ H = p^2"##,
        r##"expected the partial derivatives in parentheses, found `;`
help: write `fn name(x) = value, (derivative)`, with paths of Rust functions"##,
    ),
    (
        r##"fn f(x) = g, ⟦()⟧; H = p^2"##,
        r##"`f` takes 1 argument, but 0 partial derivatives are given
help: write one for each argument, in their order"##,
    ),
    (
        r##"fn f(x, y) = g, (gx, gy), ⟦(gxx)⟧; H = p^2"##,
        r##"`f` takes 2 arguments, so it has 3 second partials, not 1
help: write the upper triangle row by row: `(xx, xy, yy)` for two arguments"##,
    ),
    (
        r##"fn f(x) = ⟦3⟧, (gx); H = p^2"##,
        r##"expected the path of a Rust function, found `3`
help: write `fn name(x) = value, (derivative)`, with paths of Rust functions"##,
    ),
    (
        r##"H⟦(q)⟧ = q"##,
        r##"the signature names no momenta
help: write `H(q; p)`"##,
    ),
    (
        r##"H⟦(x, y, p_x, p_y)⟧ = p_x^2"##,
        r##"the signature names no momenta
help: write `H(x, y; p_x, p_y)`"##,
    ),
    (
        r##"H⟦(q; )⟧ = q"##,
        r##"the signature names no momenta
help: write `H(q; p)`"##,
    ),
    (
        r##"H⟦()⟧ = 1"##,
        r##"the signature names no coordinates
help: write `H(q; p)`"##,
    ),
    (
        r##"H⟦(; p)⟧ = p"##,
        r##"the signature names no coordinates
help: write `H(q; p)`"##,
    ),
    (
        r##"H(x, ⟦y⟧; p_x) = p_x^2"##,
        r##"the coordinate `y` has no momentum
help: write `H(x, y; p_x, p_y)`"##,
    ),
    (
        r##"H(x; p_x, ⟦p_y⟧) = p_x^2"##,
        r##"the momentum `p_y` has no coordinate
help: write as many coordinates before the `;` as after it: `H(x, y; …)`"##,
    ),
    (
        r##"H⟦(q; p; )⟧ = p^2"##,
        r##"the signature ends in `;` but names no time
help: write `H(q; p; t)`, or remove the `;`"##,
    ),
    (
        r##"H(q; p; ⟦t⟧, s) = p^2"##,
        r##"time is one scalar
help: write `H(q; p; t)`"##,
    ),
    (
        r##"H(q; p; t; ⟦s⟧) = p^2"##,
        r##"nothing follows time in a signature
help: write `H(q; p; t)`"##,
    ),
    (
        r##"H(q; ⟦q⟧) = q"##,
        r##"the name `q` is used twice: it is a coordinate already
help: choose another name"##,
    ),
    (
        r##"H(q; p; ⟦q⟧) = p"##,
        r##"the name `q` is used twice: it is a coordinate already
help: choose another name"##,
    ),
    (
        r##"H(q[2]; ⟦p⟧) = p"##,
        r##"`p` is a scalar, but its coordinate `q` is a vector `[2]`
help: write `p[2]`"##,
    ),
    (
        r##"H(q[2]; ⟦p⟧[3]) = norm(p)"##,
        r##"`p` is a vector `[3]`, but its coordinate `q` is a vector `[2]`
help: write `p[2]`"##,
    ),
    (
        r##"H(q[⟦0⟧]; p[0]) = 1"##,
        r##"`0` is not a size
help: write a whole number from 1"##,
    ),
    (
        r##"H(q[⟦N⟧]; p[N]) = norm(p)"##,
        r##"unknown size `N`
help: write a number; named sizes need the item form, `struct Name<const N: usize>`"##,
    ),
    (
        r##"H(q[2][3]⟦[4]⟧; p) = 1"##,
        r##"arrays have at most two extents
help: write `[n][3]`, or several arrays"##,
    ),
    (
        r##"H(q[2⟦,⟧ 3]; p[2, 3]) = 1"##,
        r##"each extent has brackets of its own
help: write `[n][3]`"##,
    ),
    (
        r##"H(q[2 ⟦+⟧ 1]; p[3]) = norm(p)"##,
        r##"a size is a number or a name, not an expression
help: write a number or the name of a size: `[3]`, `[N]`"##,
    ),
    (
        r##"H(q⟦[]⟧; p[]) = 1"##,
        r##"a size is missing
help: write a number or the name of a size: `[3]`, `[N]`"##,
    ),
    (
        r##"H(⟦sin⟧; p) = p^2"##,
        r##"`sin` is a function of the language and cannot be redeclared
help: choose another name"##,
    ),
    (
        r##"H(q ⟦p⟧) = p^2"##,
        r##"expected `,` or `;`, found `p`
help: write `H(q; p)`"##,
    ),
    (
        r##"⟦H⟧ = q^2"##,
        r##"`H` depends on no momentum: `p` does not occur
help: nothing would move: write a kinetic energy, such as `p^2/2`"##,
    ),
    (
        r##"⟦H⟧ = x^2 + v^2"##,
        r##"`H` depends on no momentum: `p` does not occur
help: `x` is taken from the scope around; name the momenta in the signature: `H(x; p_x) = …`"##,
    ),
    (
        r##"⟦L⟧(q; v) = q"##,
        r##"`L` depends on no velocity: `v` does not occur
help: nothing would move: write a kinetic energy, such as `v^2/2`"##,
    ),
    (
        r##"L(q; v) = v^2 + ⟦p_q⟧"##,
        r##"`p_q` is a momentum, which `L` itself defines
help: write the velocity `v`"##,
    ),
    (
        r##"L(q; v) = v^2 + ⟦H⟧"##,
        r##"`H` follows from `L` and cannot define it
help: write it in terms of coordinates and velocities"##,
    ),
    (
        r##"L(q, ⟦r⟧; v) = v^2"##,
        r##"the coordinate `r` has no velocity
help: write `L(q, r; v, v_r)`"##,
    ),
    (
        r##"⟦H⟧ = 1"##,
        r##"`H` depends on no momentum: `p` does not occur
help: nothing would move: write a kinetic energy, such as `p^2/2`"##,
    ),
    (
        r##"H(q[3]; p[3]) = ⟦p⟧"##,
        r##"`H` is a scalar, but this is a vector `[3]`
help: write `norm_squared(p)` or a component, `p[0]`"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm(p) ⟦+⟧ q"##,
        r##"a scalar cannot be added to a vector `[3]`
help: write a component, `q[i]`, or a length, `norm(q)`"##,
    ),
    (
        r##"H(q[3]; p[3]) = p⟦*⟧q"##,
        r##"a vector `[3]` times a vector `[3]` has no meaning
help: write `dot(p, q)` or `cross(p, q)`"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm(p*q[0] ⟦-⟧ 1)"##,
        r##"a scalar cannot be subtracted from a vector `[3]`
help: write a component, or a length, `norm(…)`"##,
    ),
    (
        r##"H(q[3]; p[3]) = p⟦^⟧2"##,
        r##"a vector `[3]` has no powers
help: write `norm_squared(p)`, or the power of a component, `p[i]^2`"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm(p)⟦^⟧q"##,
        r##"the exponent is a vector `[3]`
help: write a scalar exponent"##,
    ),
    (
        r##"H(q[3]; p[3]) = 1⟦/⟧p"##,
        r##"nothing can be divided by a vector `[3]`
help: divide by a component, `p[i]`, or by its length, `norm(p)`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sin(⟦q⟧) + abs(⟦p⟧)"##,
        r##"`sin` takes scalars, but `q` is a vector `[3]`
help: write a component, or `sum(i in 0..3) { sin(q[i]) }`
`abs` takes scalars, but `p` is a vector `[3]`
help: write `norm(…)` for the length of a vector"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm(⟦p[0]⟧) + dot(⟦q[0]⟧, p) + norm_squared(⟦q[1]⟧)"##,
        r##"`norm` takes vectors, but this is a scalar
help: write `abs(…)`
`dot` takes vectors, but this is a scalar
help: write a product, `a*b`
`norm_squared` takes vectors, but this is a scalar
help: write `(…)^2`"##,
    ),
    (
        r##"H(q[3], r[2]; p[3], s[2]) = ⟦dot⟧(p, s)"##,
        r##"`dot` needs vectors of equal extent, but these are a vector `[3]` and a vector `[2]`
help: both need the same number of components"##,
    ),
    (
        r##"H(q[2]; p[2]) = norm(cross(⟦q⟧, p))"##,
        r##"`cross` needs vectors `[3]`, but this is a vector `[2]`
help: in the plane write `q[0]*p[1] - q[1]*p[0]`"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm([⟦q⟧, ⟦p⟧])"##,
        r##"the components of a vector are scalars, but this is a vector `[3]`
help: write each component: `[q[0], q[1], …]`
the components of a vector are scalars, but this is a vector `[3]`
help: write each component: `[p[0], p[1], …]`"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm(p) + norm(⟦[]⟧)"##,
        r##"a vector without components
help: write `[a, b, c]`"##,
    ),
    (
        r##"H(q[4][3]; p[4][3]) = norm_squared(⟦p⟧)"##,
        r##"`norm_squared` takes vectors, but `p` is a matrix `[4][3]`
help: write a row, `p[i]`, inside `sum(i in 0..4) { … }`"##,
    ),
    (
        r##"H(q[4][3]; p[4][3]) = norm(q⟦*⟧p[0])"##,
        r##"only a matrix parameter multiplies a vector
help: write its components: `[dot(q[0], v), dot(q[1], v), …]`"##,
    ),
    (
        r##"H = p⟦[⟧0]"##,
        r##"`p` is a scalar and has no components
help: declare it with its extent: `H(q[N]; p[N])`"##,
    ),
    (
        r##"H = p^2 + m⟦[⟧0]"##,
        r##"`m` is a scalar and has no components
help: captured names are scalars: write a parameter `name: [N]` in item form"##,
    ),
    (
        r##"H = p^2 + (q*2)⟦[⟧0]"##,
        r##"a scalar has no components
help: remove the index"##,
    ),
    (
        r##"H(q[3]; p[3]) = p[⟦3⟧]"##,
        r##"this index reaches 3, but the extent is 3
help: indices run from 0 to 2"##,
    ),
    (
        r##"H(q[3]; p[3]) = p[⟦-1⟧]"##,
        r##"this index reaches -1, but indices begin at 0
help: indices run from 0 to 2"##,
    ),
    (
        r##"H(q[3]; p[3]) = p[⟦q[0]⟧]"##,
        r##"indices and ranges are sums of whole multiples of loop variables and sizes
help: write indices such as `i`, `i + 1`, `2*i + j`, `N - 1 - i`, `(i + 1) % N`"##,
    ),
    (
        r##"H(q[3]; p[3]) = p[⟦1.5⟧]"##,
        r##"indices and ranges are sums of whole multiples of loop variables and sizes
help: write indices such as `i`, `i + 1`, `2*i + j`, `N - 1 - i`, `(i + 1) % N`"##,
    ),
    (
        r##"H(q[3]; p[3]) = p⟦[]⟧"##,
        r##"an index is missing
help: write `p[i]`"##,
    ),
    (
        r##"H(q[3]; p[3]) = p[0⟦,⟧ 1]"##,
        r##"each index has brackets of its own
help: write `p[i][j]`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[⟦i + 1⟧] }"##,
        r##"this index reaches 3, but the extent is 3
help: indices run from 0 to 2: change the range of the loop, or go round by `% 3`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[⟦i - 1⟧] }"##,
        r##"this index reaches -1, but indices begin at 0
help: indices run from 0 to 2: change the range of the loop, or go round by `% 3`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..4) { p[⟦i⟧] }"##,
        r##"this index reaches 3, but the extent is 3
help: indices run from 0 to 2: change the range of the loop, or go round by `% 3`"##,
    ),
    (
        r##"struct A<const N: usize> {}
            H(q[N]; p[N]) = sum(i in 0..N, j in i + 1..N) { p[j]*q[⟦i + 1⟧] }"##,
        r##"this index reaches N, but the extent is N
help: indices run from 0 to N - 1: change the range of the loop, or go round by `% N`; it counts wherever its own loops run, even where a loop inside is empty"##,
    ),
    (
        r##"H = p^2 + sum(i in ⟦-2⟧..3) { q^2*i }"##,
        r##"this range begins at -2, but ranges begin at 0 or above
help: write `i in 0..5`, and `(i - 2)` for `i`"##,
    ),
    (
        r##"H(q[9]; p[9]) = norm_squared(p) + sum(i in 1..9, j in ⟦i - 3⟧..i) { q[i]*j }"##,
        r##"this range begins at -2, but ranges begin at 0 or above
help: write `j in 0..3`, and `(i - 3 + j)` for `j`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[⟦i*i⟧] }"##,
        r##"indices and ranges are sums of whole multiples of loop variables and sizes
help: write indices such as `i`, `i + 1`, `2*i + j`, `N - 1 - i`, `(i + 1) % N`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[(i + 1) % ⟦4⟧] }"##,
        r##"this index reaches 3, but the extent is 3
help: write `% 3`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[i + 1 ⟦%⟧ 3] }"##,
        r##"`%` binds like `*`: here it is not the last thing done
help: write `p[(i + 1) % N]`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[i % ⟦i⟧] }"##,
        r##"the right side of `%` is not a size
help: write `% N` with a size or a number"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[i] } + q[⟦i⟧]"##,
        r##"`i` is a loop variable and means nothing outside its `sum`
help: write it inside the braces of the `sum`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(⟦q⟧ in 0..3) { p[q] }"##,
        r##"`q` is used twice: it is a coordinate already
help: choose another loop variable"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3, ⟦i⟧ in 0..3) { p[i] }"##,
        r##"`i` is used twice: it is a loop variable around this one already
help: choose another loop variable"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..⟦q[0]⟧) { p[i] }"##,
        r##"indices and ranges are sums of whole multiples of loop variables and sizes
help: write indices such as `i`, `i + 1`, `2*i + j`, `N - 1 - i`, `(i + 1) % N`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(⟦p⟧)"##,
        r##"expected a loop variable and its range
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H(q[3]; p[3]) = ⟦sum(i in 0..3)⟧ p[i]"##,
        r##"the body of a `sum` stands in braces
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0⟦..=⟧2) { p[i] }"##,
        r##"ranges exclude their end
help: write `..n + 1` to include `n`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in ⟦3⟧) { p[i] }"##,
        r##"expected `..` in a range, found the end
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i ⟦in⟧ ..3) { p[i] }"##,
        r##"the range does not say where it begins
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum⟦()⟧ { p[0] }"##,
        r##"`sum` needs a loop variable and its range
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { ⟦let⟧ a = 1; p[i] }"##,
        r##"`let` does not stand inside an expression
help: write it as a statement of its own: `let name = …;`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) ⟦{ }⟧"##,
        r##"there is nothing inside
help: write one value"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { p[i] ⟦>⟧ 1 }"##,
        r##"`>` makes a condition where a number is due
help: write `if a > b { … } else { … }`"##,
    ),
    (
        r##"H(x, ⟦p_x⟧; y, p_y) = p_x^2 + p_y^2"##,
        r##"`p_x` stands among the coordinates, but has the name of the momentum of `x`
help: coordinates first, then momenta: `H(x, y; p_x, p_y)`"##,
    ),
    (
        r##"H(q1[3], ⟦p1⟧[3], theta; q2[3], p2[3], p_theta) = p1[0]^2"##,
        r##"`p1` stands among the coordinates, but has the name of the momentum of `q1`
help: coordinates first, then momenta: `H(q1, theta, q2; p1, p2, p_theta)`"##,
    ),
    (
        r##"H(⟦px⟧, ⟦py⟧; x, y) = px^2 + py^2"##,
        r##"`px` stands among the coordinates, but has the name of the momentum of `x`
help: coordinates first, then momenta: `H(x, y; px, py)`
`py` stands among the coordinates, but has the name of the momentum of `y`
help: coordinates first, then momenta: `H(x, y; px, py)`"##,
    ),
    (
        r##"L(x, ⟦v_x⟧; y, v_y) = v_x^2 + v_y^2"##,
        r##"`v_x` stands among the coordinates, but has the name of the velocity of `x`
help: coordinates first, then velocities: `L(x, y; v_x, v_y)`"##,
    ),
    (
        r##"H(x, ⟦px⟧; y, z) = px^2 + y^2"##,
        r##"`px` stands among the coordinates, but has the name of the momentum of `x`
help: coordinates come first, momenta after the `;`"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm_squared(p) + sum(i in ⟦3..0⟧) { q[i] }"##,
        r##"the range `3..0` ends before it starts
help: write the smaller one first, as in `0..3`; the end is not included"##,
    ),
    (
        r##"struct A<const N: usize> {} H(q[N]; p[N]) = norm_squared(p) + sum(i in ⟦N..N - 1⟧) { q[i] }"##,
        r##"the range `N..N - 1` ends before it starts
help: write the smaller one first, as in `N - 1..N`; the end is not included"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { ⟦bracket⟧(p[i], q[0]) }"##,
        r##"`bracket` does not stand inside a `sum`
help: take the bracket of the whole sums: `bracket(sum(…) { … }, b)`"##,
    ),
    (
        r##"H = if ⟦q⟧ { p } else { 0 }"##,
        r##"a scalar stands where a condition is due
help: compare it: `x > 0`"##,
    ),
    (
        r##"H = ⟦if⟧ q > 0 { p }"##,
        r##"`if` without `else`: a value is due either way
help: write `if c { a } else { b }`"##,
    ),
    (
        r##"H = if q > 0 ⟦p⟧ else 0"##,
        r##"expected `{` after the condition, found `p`
help: write `if c { a } else { b }`"##,
    ),
    (
        r##"H = if q ⟦=⟧ 0 { p } else { 0 }"##,
        r##"`=` does not compare
help: write `==` in a condition"##,
    ),
    (
        r##"H = ⟦if⟧ { p } else { 0 }"##,
        r##"the condition of `if` is missing
help: write `if c { a } else { b }`"##,
    ),
    (
        r##"H = p + ⟦else⟧"##,
        r##"`else` without `if`
help: write `if c { a } else { b }`"##,
    ),
    (
        r##"H = if q > 0 { p } else { q ⟦>⟧ 1 }"##,
        r##"`>` makes a condition where a number is due
help: write `if a > b { … } else { … }`"##,
    ),
    (
        r##"H = ⟦if⟧ q > 0 { [p, p] } else { p }"##,
        r##"the branches of `if` differ: a vector `[2]` and a scalar
help: both branches need the same shape"##,
    ),
    (
        r##"H = p + (q ⟦>⟧ 0)"##,
        r##"`>` makes a condition where a number is due
help: write `if a > b { … } else { … }`"##,
    ),
    (
        r##"H = !⟦p⟧"##,
        r##"a scalar stands where a condition is due
help: compare it: `x > 0`"##,
    ),
    (
        r##"H = if q > 0 && ⟦p⟧ { p } else { 0 }"##,
        r##"a scalar stands where a condition is due
help: compare it: `x > 0`"##,
    ),
    (
        r##"H(q[3]; p[3]) = if q ⟦>⟧ p { p[0] } else { 0 }"##,
        r##"a vector `[3]` cannot be compared with a vector `[3]`
help: compare scalars, such as `norm(a)`"##,
    ),
    (
        r##"struct ⟦A⟧ {}"##,
        r##"`A` has no Hamiltonian: nothing follows the braces
help: write `H(q; p) = …` after the closing brace"##,
    ),
    (
        r##"pub struct ⟦A⟧ { m = 1.0 }"##,
        r##"`A` has no Hamiltonian: nothing follows the braces
help: write `H(q; p) = …` after the closing brace"##,
    ),
    (
        r##"pub struct A⟦;⟧ H = p^2"##,
        r##"expected `{` and the parameters of `A`, found `;`
help: write `struct A {}` if it has no parameters"##,
    ),
    (
        r##"pub ⟦enum⟧ A {} H = p^2"##,
        r##"expected `struct`, found `enum`
help: write `pub struct Name { m = 1.0 }` and the statements after it"##,
    ),
    (
        r##"pub struct A⟦(⟧f64); H = p^2"##,
        r##"expected `{` and the parameters of `A`, found `(`
help: write `struct A {}` if it has no parameters"##,
    ),
    (
        r##"pub struct A<⟦T⟧> {} H = p^2"##,
        r##"expected `const`, found `T`
help: only sizes stand between `<` and `>`: write `<const N: usize>`"##,
    ),
    (
        r##"pub struct A<const ⟦N⟧: i32> {} H = p^2"##,
        r##"the size `N` is not declared as `usize`
help: write `const N: usize`"##,
    ),
    (
        r##"pub struct A<const N: usize ⟦=⟧ 3> {} H = p^2"##,
        r##"sizes have no default
help: write `const N: usize`"##,
    ),
    (
        r##"pub struct A { m: ⟦f64⟧, l: ⟦f64⟧ = 1.0 } H = p^2/m"##,
        r##"`m` has no type of its own: `f64` is neither `usize` nor an array
help: write `m` for a scalar, `m = 1.0` for one with a default, `m: [N]` for an array
`l` has no type of its own: `f64` is neither `usize` nor an array
help: write `l` for a scalar, `l = 1.0` for one with a default, `l: [N]` for an array"##,
    ),
    (
        r##"pub struct A { ⟦pub⟧ m = 1.0 } H = p^2/m"##,
        r##"parameters are as visible as their struct
help: remove `pub`"##,
    ),
    (
        r##"pub struct A { m = 1.0⟦;⟧ l = 2.0 } H = p^2/m"##,
        r##"parameters are separated by `,`
help: write `,` instead of `;`"##,
    ),
    (
        r##"pub struct A { m = 1⟦/⟧2, l = ⟦x⟧, k = ⟦1.0f32⟧ } H = p^2/m"##,
        r##"a default is a number, not an expression
help: write its value as one number, such as `0.5`
expected a number as the default of `l`, found `x`
help: write `l = 1.0`, or `l` for a parameter without default
`1.0f32` has a type, but numbers are exact here and have none
help: write `1.0`"##,
    ),
    (
        r##"pub struct A { m = 1.0, ⟦m⟧ = 2.0 } H = p^2/m"##,
        r##"the name `m` is used twice: it is a parameter already
help: choose another name"##,
    ),
    (
        r##"pub struct A { q = 1.0, ⟦sin⟧ = 2.0, ⟦H⟧ = 3 } H = p^2"##,
        r##"`sin` is a function of the language and cannot be redeclared
help: choose another name
`H` is the Hamiltonian and cannot be redeclared
help: choose another name"##,
    ),
    (
        r##"pub struct A { n: usize ⟦=⟧ 3, m: [n] ⟦=⟧ 1 } H = p^2"##,
        r##"only scalars have a default
help: remove it and give the value to `new`
only scalars have a default
help: remove it and give the value to `new`"##,
    ),
    (
        r##"pub struct A { m: [⟦k⟧] } H = p^2"##,
        r##"unknown size `k`
help: declare it: `struct A<const k: usize>`, or `k: usize` among the parameters"##,
    ),
    (
        r##"pub struct A { k = 1, m: [⟦k⟧] } H = p^2"##,
        r##"`k` is a parameter, not a size
help: declare it as a size: `k: usize`"##,
    ),
    (
        r##"pub struct A { m: [f64⟦;⟧ 3], r: [3⟦,⟧ 3] } H = p^2"##,
        r##"numbers have no type here
help: write `[3]`, not `[f64; 3]`
each extent has brackets of its own
help: write `[n][3]`"##,
    ),
    (
        r##"pub struct A { ⟦#[cfg(test)]⟧ m = 1 } H = p^2"##,
        r##"a parameter cannot depend on the configuration: H does not
help: write two definitions and choose between them by `#[cfg(…)]`"##,
    ),
    (
        r##"pub struct A { mass = 1.0 } H = p^2/(2*⟦mas⟧) + mas"##,
        r##"unknown name `mas`
help: the nearest known name is `mass`"##,
    ),
    (
        r##"pub struct A {} H(q[3]; p[3]) = norm_squared(p) + sum(i in 0..2*⟦m⟧) { q[0] } + q[1 - ⟦n⟧]"##,
        r##"unknown name `m`
help: declare it as a size: `m: usize` among the parameters of `A`
unknown name `n`
help: declare it as a size: `n: usize` among the parameters of `A`"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm_squared(p) + q[⟦1e21⟧] + sum(i in 0..⟦9223372036854775808⟧) { q[0] }
            + q[0*⟦99999999999999999999⟧]"##,
        r##"this number is too large for an index or a range
help: write one up to 9223372036854775807
this number is too large for an index or a range
help: write one up to 9223372036854775807
this number is too large for an index or a range
help: write one up to 9223372036854775807"##,
    ),
    (
        r##"pub struct A { mass = 1.0 } H = p^2/(2*⟦k⟧)"##,
        r##"unknown name `k`
help: declare it: a parameter of `A`, such as `k = 1.0`, or `let k = …;`"##,
    ),
    (
        r##"pub struct A {} H(x; p_x) = ⟦p⟧^2"##,
        r##"unknown name `p`
help: the nearest known name is `p_x`"##,
    ),
    (
        r##"pub struct A {} H = ⟦PI⟧*p^2"##,
        r##"unknown name `PI`
help: write `pi`"##,
    ),
    (
        r##"pub struct A {} H = p^2/⟦a.b⟧"##,
        r##"`a.b`: fields are not captured
help: make it a parameter of its own and write `b`"##,
    ),
    (
        r##"pub struct A {} H = p^2*⟦std::f64::consts::E⟧"##,
        r##"a path is not a value here
help: declare a Rust function by `fn name(x) = path, (path)`, a constant as a parameter"##,
    ),
    (
        r##"⟦#[max_ops = many]⟧ pub struct A {} H = p^2"##,
        r##"`max_ops` takes a number of operations
help: write `#[max_ops = 40]`"##,
    ),
    (
        r##"#[max_ops = 4] ⟦#[max_ops = 4]⟧ pub struct A {} H = p^2"##,
        r##"`max_ops` stands twice
help: keep one"##,
    ),
    (
        r##"pub struct A<const N: usize> {} H(q[N]; p[N]) = sum(i in 0..N) { p[i] + q[⟦i + 1⟧] }"##,
        r##"this index reaches N, but the extent is N
help: indices run from 0 to N - 1: change the range of the loop, or go round by `% N`"##,
    ),
    (
        r##"pub struct A<const N: usize> {} H(q[N]; p[N]) = sum(i in 0..N + 1) { p[⟦i⟧] }"##,
        r##"this index reaches N, but the extent is N
help: indices run from 0 to N - 1: change the range of the loop, or go round by `% N`"##,
    ),
    (
        r##"pub struct A<const N: usize> {} H(q[N][⟦N⟧]; p[N][N]) = norm(p[0])"##,
        r##"the last extent of `q` is not a number
help: write a number there: `q[n][3]`"##,
    ),
    (
        r##"pub struct A<const N: usize> {} H(q[⟦n⟧]; p[n]) = norm(p)"##,
        r##"unknown size `n`
help: the nearest size is `N`"##,
    ),
    (
        r##"pub struct A<const N: usize> {} H(q[N]; p[N]) = norm(p); monitor all = ⟦p⟧"##,
        r##"a monitor is a scalar or a vector of known extent, but this is a vector `[N]`
help: write one component, or `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"pub struct A<const N: usize> { m: [N] } H(q[N]; p[N]) = norm(p)⟦/⟧m"##,
        r##"nothing can be divided by a vector `[N]`
help: divide by a component, `m[i]`, or by its length, `norm(m)`"##,
    ),
    (
        r##"pub struct A<const N: usize> { M: [N][N], v: [3] } H(q[N]; p[N]) = norm(M⟦*⟧v) + norm(p⟦*⟧M)"##,
        r##"a matrix `[N][N]` times a vector `[3]` has no meaning
help: a matrix parameter `[r][c]` multiplies a vector `[c]` from the left
a vector `[N]` times a matrix `[N][N]` has no meaning
help: write the matrix on the left: `M*p`"##,
    ),
    (
        r##"pub struct A {} ⟦;⟧ H = p^2"##,
        r##"a statement is missing before this `;`
help: remove the `;`"##,
    ),
    (
        r##"pub struct A { m } ⟦pi⟧ = 3"##,
        r##"`pi` does not begin a statement
help: write `H(q; p) = …`, `let name = …`, `invariant name = …` or another statement"##,
    ),
    (
        r##"⟦//! inner⟧
H = p^2"##,
        r##"inner docs and attributes have nothing to stand in
help: write `///` or `#[…]` before what they describe"##,
    ),
    (
        r##"pub struct A { m ⟦=⟧ } H = p^2"##,
        r##"expected a number as the default of `m`, found the end
help: write `m = 1.0`, or `m` for a parameter without default"##,
    ),
    (
        r##"H = ⟦2q⟧ + ⟦3p⟧ + ⟦.5⟧"##,
        r##"`2q` is not a product
help: write `2*q`
`3p` is not a product
help: write `3*p`
`.5` does not begin with a digit
help: write `0.5`"##,
    ),
    (
        r##"H = p^2 + ⟦a.b⟧ + ⟦c.sin()⟧"##,
        r##"`a.b`: fields are not captured
help: bind it before the macro, `let b = a.b;`, and write `b`
`c.sin(…)`: a function stands before its argument
help: write `sin(c)`"##,
    ),
    (
        r##"let a = ⟦2q⟧; let b = p ⟦q⟧; H = p^2"##,
        r##"`2q` is not a product
help: write `2*q`
an operator is missing between `p` and `q`
help: write `p*q`"##,
    ),
    (
        r##"H = p^2 + (q + (p - (⟦2q⟧)))"##,
        r##"`2q` is not a product
help: write `2*q`"##,
    ),
    (
        r##"struct A { m } H = p^2/m + ⟦qq⟧; monitor e = ⟦pp⟧ + ⟦mm⟧; event f = ⟦sin⟧(q, 1)"##,
        r##"unknown name `qq`
help: the nearest known name is `q`
unknown name `pp`
help: the nearest known name is `p`
unknown name `mm`
help: the nearest known name is `m`
`sin` takes 1 argument, not 2
help: write `sin(x)`"##,
    ),
    (
        r##"H(t; p; ⟦t⟧) = p^2"##,
        r##"the name `t` is used twice: it is a coordinate already
help: choose another name"##,
    ),
    (
        r##"struct A { q } ⟦H⟧ = p^2"##,
        r##"`H = …` is short for `H(q; p) = …`, but `q` is a parameter already
help: name the coordinates: `H(x; p_x) = …`"##,
    ),
    (
        r##"struct A { n: usize } H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2 } ⟦+⟧ n^2*p"##,
        r##"a scalar cannot be added to a vector `[n]`
help: write a component, or a length, `norm(…)`"##,
    ),
    (
        r##"struct A { r } let ⟦r⟧ = 1; H = p^2"##,
        r##"the name `r` is used twice: it is a parameter already
help: choose another name"##,
    ),
    (
        r##"let x(r) = r; let ⟦x⟧ = 1; H = p^2"##,
        r##"the name `x` is used twice: it is a function already
help: choose another name"##,
    ),
    (
        r##"let f(r) = ⟦sin⟧(r, 1); H = p^2 + f(q) + f(p)"##,
        r##"`sin` takes 1 argument, not 2
help: write `sin(x)`"##,
    ),
    (
        r##"let f(v) = norm(⟦v⟧); H = p^2 + f(q) + f(p)"##,
        r##"`norm` takes vectors, but `v` is a scalar
help: write `abs(…)`"##,
    ),
    (
        r##"let f(i) = q[⟦i⟧]; H(q[3]; p[3]) = norm(p) + f(3) + sum(i in 0..3) { f(i) + f(i + 1) }"##,
        r##"this index reaches 3, but the extent is 3
help: indices run from 0 to 2"##,
    ),
    (
        r##"let v = [1, 2, 3]; H = p^2 ⟦+⟧ v"##,
        r##"a scalar cannot be added to a vector `[3]`
help: write a component, `v[i]`, or a length, `norm(v)`"##,
    ),
    (
        r##"struct A {} L(q; v) = v^2; monitor m = ⟦vv⟧"##,
        r##"unknown name `vv`
help: the nearest known name is `v`"##,
    ),
    (
        r##"H = p^2 ⟦invariant⟧ e = H"##,
        r##"a `;` is missing before `invariant`
help: statements are separated by `;`"##,
    ),
    (
        r##"H = p^2 ⟦V⟧ = q^2"##,
        r##"a `;` is missing before `V`
help: write `; let V` if it is a statement of its own"##,
    ),
    (
        r##"split { A = p^2⟦,⟧ B = q }; H = p^2 + q"##,
        r##"statements are separated by `;`
help: write `;` instead of `,`"##,
    ),
    (
        r##"H = p^2 + sum(i in 0..3, j in 0..⟦k⟧) { i*j }"##,
        r##"`k` is a captured value, not a size
help: write a number; sizes need the item form, with `k: usize`"##,
    ),
    (
        r##"H = p^2 + cross([1, 2, 3], ⟦[1, 2]⟧)"##,
        r##"`cross` needs vectors `[3]`, but this is a vector `[2]`
help: in the plane write `a[0]*b[1] - a[1]*b[0]`"##,
    ),
    (
        r##"H = p^2; ⟦bracket⟧(q, p)"##,
        r##"`bracket` does not begin a statement
help: write `H(q; p) = …`, `let name = …`, `invariant name = …` or another statement"##,
    ),
    (
        r##"H = ⟦bracket⟧(q, p, 1) + p^2"##,
        r##"`bracket` takes 2 arguments, not 3
help: write `bracket(a, b)`"##,
    ),
    (
        r##"H = p^2 + -⟦>⟧ q"##,
        r##"expected a number, a name or `(`, found `>`
help: write a value on each side of an operator"##,
    ),
    (
        r##"H = p^2 ⟦=⟧> q"##,
        r##"a second `=` in one statement
help: write `;` between statements, `==` to compare in a condition"##,
    ),
    (
        r##"H ⟦:=⟧ p^2"##,
        r##"expected `=` after `H`, found `:=`
help: write `H = …`"##,
    ),
    (
        r##"pub struct A { m = 1 } H = p^2/m; monitor ⟦p⟧ = q; monitor ⟦m⟧ = q; monitor n = q"##,
        r##"the name `p` is used twice: it is a momentum already
help: choose another name
the name `m` is used twice: it is a parameter already
help: choose another name"##,
    ),
    (
        r##"H = p^2 + (q > 0 ⟦?⟧ q : -q)"##,
        r##"`?` does not choose between values
help: write `if c { a } else { b }`"##,
    ),
    (
        r##"H = p^2 + ⟦Math.cos(q)⟧"##,
        r##"`Math.cos(…)`: a function stands before its argument
help: write `cos(q)`"##,
    ),
    (
        r##"H = p^2 + ⟦Math.pow(q, 2)⟧ + ⟦Math.atan2(p, q)⟧"##,
        r##"`Math.pow(…)`: a function stands before its argument
help: write `q^n`
`Math.atan2(…)`: a function stands before its argument
help: write `atan2(p, …)`"##,
    ),
    (
        r##"let d⟦[k]⟧ = q[k]; H(q[3]; p[3]) = norm_squared(p)*d[0]"##,
        r##"a `let` is no array: what depends on an index is a function of it
help: write `let d(k) = …`, and `d(k)` where it is used"##,
    ),
    (
        r##"pub struct A {} L(q; v) = v^2/2 - q^2; monitor e = ⟦p⟧*q"##,
        r##"unknown name `p`
help: the momenta of this Lagrangian are `p_q`"##,
    ),
    (
        r##"pub struct A {} H = p^2; monitor e = p*q; monitor f = ⟦e⟧^2"##,
        r##"unknown name `e`
help: what `monitor e` declares no other statement reads; write its formula as a `let` above both"##,
    ),
    (
        r##"H = ⟦'a'⟧ + p^2"##,
        r##"'a' is not a number
help: write a decimal number"##,
    ),
    (
        r##"H = p^2 ⟦@⟧ q"##,
        r##"expected an operator or `;`, found `@`
help: remove it"##,
    ),
    (
        r##"struct A { m: [⟦N⟧] } H = p^2"##,
        r##"unknown size `N`
help: declare it: `struct A<const N: usize>`, or `N: usize` among the parameters"##,
    ),
    (
        r##"struct A<const N: usize, const ⟦N⟧: usize> {} H = p^2"##,
        r##"the name `N` is used twice: it is a size already
help: choose another name"##,
    ),
    (
        r##"struct A<const N: usize> { ⟦N⟧ = 1 } H = p^2"##,
        r##"the name `N` is used twice: it is a size already
help: choose another name"##,
    ),
    (
        r##"struct A<⟦'⟧a> {} H = p^2"##,
        r##"expected `const`, found `'`
help: only sizes stand between `<` and `>`: write `<const N: usize>`"##,
    ),
    (
        r##"struct A {} ⟦where⟧ H = p^2"##,
        r##"`where` does not begin a statement
help: write `H(q; p) = …`, `let name = …`, `invariant name = …` or another statement"##,
    ),
    (
        r##"struct ⟦Self⟧ {} H = p^2"##,
        r##"`Self` is a keyword of Rust and cannot be a name
help: choose another name"##,
    ),
    (
        r##"struct A { m = -1, k = --2, l = ⟦-⟧ } H = p^2*m*k"##,
        r##"expected a number as the default of `l`, found the end
help: write `l = 1.0`, or `l` for a parameter without default"##,
    ),
    (
        r##"struct A { m: ⟦Vec⟧<f64> } H = p^2"##,
        r##"`m` has no type of its own: `Vec` is neither `usize` nor an array
help: write `m` for a scalar, `m = 1.0` for one with a default, `m: [N]` for an array"##,
    ),
    (
        r##"struct A { m: ⟦[]⟧ } H = p^2"##,
        r##"a size is missing
help: write a number or the name of a size: `[3]`, `[N]`"##,
    ),
    (
        r##"struct A { ⟦3⟧ } H = p^2"##,
        r##"expected the name of a parameter, found `3`
help: write `name = 1.0`, `name`, `name: usize` or `name: [N]`"##,
    ),
    (
        r##"struct A { m ⟦k⟧ } H = p^2"##,
        r##"expected `,` after `m`, found `k`
help: write `name = 1.0`, `name`, `name: usize` or `name: [N]`"##,
    ),
    (
        r##"L⟦(q)⟧ = 1"##,
        r##"the signature names no velocities
help: write `L(q; v)`"##,
    ),
    (
        r##"L(q; v; t; ⟦s⟧) = v^2"##,
        r##"nothing follows time in a signature
help: write `L(q; v; t)`"##,
    ),
    (
        r##"force⟦(q; p; t)⟧ = -p; H = p^2"##,
        r##"a force acts on the coordinates and momenta of the definition
help: write `force(q; p)`"##,
    ),
    (
        r##"force⟦(q; p; s)⟧ = -p; H(q; p; t) = p^2"##,
        r##"a force acts on the coordinates and momenta of the definition
help: write `force(q; p; t)`"##,
    ),
    (
        r##"event ⟦energy⟧ = q; H = p^2"##,
        r##"`energy` is a method of every system already
help: choose another name"##,
    ),
    (
        r##"monitor ⟦sin⟧ = q; H = p^2"##,
        r##"`sin` is a function of the language and cannot be redeclared
help: choose another name"##,
    ),
    (
        r##"invariant a = q; monitor ⟦a⟧ = p; H = p^2"##,
        r##"the name `a` is used twice: an observable has it already
help: choose another name"##,
    ),
    (
        r##"coordinates polar(x⟦[⟧0]); H = p^2"##,
        r##"expected `,` or `)`, found `[`
help: write `coordinates polar(x, y)`, `spherical(x, y, z)`, `jacobi(q, m)` or `heliocentric(q, m)`"##,
    ),
    (
        r##"coordinates ⟦spherical⟧(x, y); H(x, y; u, v) = u^2 + v^2"##,
        r##"`spherical` replaces 3 coordinates, not 2
help: write `spherical(x, y, z)`"##,
    ),
    (
        r##"coordinates heliocentric(q, ⟦m⟧); H(q[3]; p[3]) = norm(p)"##,
        r##"`m` is not a parameter
help: write `coordinates heliocentric(q, m)` with positions `[n][3]` and masses `[n]`"##,
    ),
    (
        r##"H(q[3]; p[3]) = q[0]⟦[⟧1] + norm(p)"##,
        r##"a scalar has no components
help: remove the index"##,
    ),
    (
        r##"H(q[3][2]; p[3][2]) = norm(q[0]) + norm(⟦p[0][1]⟧) + p[⟦3⟧][0] + p[0][⟦2⟧]"##,
        r##"`norm` takes vectors, but this is a scalar
help: write `abs(…)`
this index reaches 3, but the extent is 3
help: indices run from 0 to 2
this index reaches 2, but the extent is 2
help: indices run from 0 to 1"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm(q[0⟦.⟧.2])"##,
        r##"a range does not stand here
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3) { sum(⟦i⟧ in 0..2) { q[i] } } + norm(p)"##,
        r##"`i` is used twice: it is a loop variable around this one already
help: choose another loop variable"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(⟦sin⟧ in 0..3) { q[0] } + norm(p)"##,
        r##"`sin` is a function of the language and cannot be redeclared
help: choose another name"##,
    ),
    (
        r##"H(q[3]; p[3]) = sum(i in 0..3⟦;⟧ j in 0..3) { q[i] } + norm(p)"##,
        r##"expected `,` or `)` after a range, found `;`
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H(q[3]; p[3]) = ⟦sum(i in 0..3)⟧ (p[i])"##,
        r##"the body of a `sum` stands in braces
help: write `sum(i in 0..N) { … }`"##,
    ),
    (
        r##"H = p^2; let f(x) = ⟦g⟧(x) + y"##,
        r##"unknown function `g`
help: define it, `let g(x) = …;`, or write `g*(…)` for a product"##,
    ),
    (
        r##"H = ⟦max⟧(q) + ⟦min⟧(q, p, 1) + ⟦pow⟧(p) + ⟦hypot⟧(p)"##,
        r##"`max` takes 2 arguments, not 1
help: write `max(x, y)`
`min` takes 2 arguments, not 3
help: write `min(x, y)`
`pow` takes 2 arguments, not 1
help: write `pow(x, y)`
`hypot` takes 2 arguments, not 1
help: write `hypot(x, y)`"##,
    ),
    (
        r##"H = p^2⟦^⟧"##,
        r##"a value is missing after `^`
help: write one, or remove what waits for it"##,
    ),
    (
        r##"H = p^2 + sin ⟦q⟧"##,
        r##"`sin` needs parentheses around its argument
help: write `sin(q)`"##,
    ),
    (
        r##"H = p^2 + ⟦sin^2⟧ (q) + sin ⟦2⟧*q"##,
        r##"`sin^2` is not a function: the power stands after the argument
help: write `sin(x)^2`
`sin` needs parentheses around its argument
help: write `sin(2)`"##,
    ),
    (
        r##"H = p^2 + ⟦sin^2⟧(q)/2 + ⟦cos^(2)⟧"##,
        r##"`sin^2` is not a function: the power stands after the argument
help: write `sin(x)^2`
`cos^n` is not a function: the power stands after the argument
help: write `cos(x)^n`"##,
    ),
    (
        r##"let ⟦force⟧ = q; let ⟦sum⟧ = q; H = p^2 + force + sum*q"##,
        r##"`force` is a word of the language and cannot be redeclared
help: choose another name
`sum` is a word of the language and cannot be redeclared
help: choose another name"##,
    ),
    (
        r##"struct A {} H = p^2 + ⟦type⟧*q"##,
        r##"`type` is a keyword of Rust and not a value
help: choose another name"##,
    ),
    (
        r##"H = p^2 + ⟦sqr⟧(q)"##,
        r##"unknown function `sqr`
help: write `x^2`"##,
    ),
    (
        r##"H(q[4]; p[4]) = norm(cross(⟦q⟧, p))"##,
        r##"`cross` needs vectors `[3]`, but this is a vector `[4]`
help: a vector product is one of space"##,
    ),
    (
        r##"H(q[3]; p[3]) = norm(p) + norm_squared(q⟦^⟧2) + dot(q, q)⟦/⟧p"##,
        r##"a vector `[3]` has no powers
help: write `norm_squared(q)`, or the power of a component, `q[i]^2`
nothing can be divided by a vector `[3]`
help: divide by a component, `p[i]`, or by its length, `norm(p)`"##,
    ),
    (
        r##"⟦fn⟧ H(q, p) { p^2 }; let f(x) = x; fn g(x) ⟦{⟧ x }; H = p^2"##,
        r##"`H` stands without `fn`
help: write `H(q; p) = …`
a function of the language has no body in braces
help: write `let g(…) = …`"##,
    ),
    (
        r##"H⟦[⟧q; p] = p^2; H ⟦=>⟧ p^2; H(x⟦:⟧ f64; p) = p^2"##,
        r##"expected `=` after `H`, found `[`
help: write `H(q; p) = …`
expected `=` after `H`, found `=>`
help: write `H = …`
coordinates and momenta have no type here
help: write a name, or `q[3]` for an array"##,
    ),
    (
        r##"H(q; p, ⟦t⟧) = p^2"##,
        r##"the momentum `t` has no coordinate
help: write time after a `;`: `H(q; p; t)`"##,
    ),
    (
        r##"H = p^2/2 ⟦where⟧ m = 1"##,
        r##"`where` is a keyword of Rust and means nothing here
help: name values above, `let name = …;`"##,
    ),
    (
        r##"H = p^2 ⟦as⟧ f64; let a = ⟦for⟧ i in 0..3 { q }; let b = ⟦match⟧ q { _ => 1 }; let c = ⟦true⟧ + q"##,
        r##"`as` is a keyword of Rust and means nothing here
help: leave it out: numbers have no type
`for` is a keyword of Rust and not a value
help: write `sum(i in 0..N) { … }` to add terms
`match` is a keyword of Rust and not a value
help: write `if c { a } else { b }`
`true` is a keyword of Rust and not a value
help: choose another name"##,
    ),
    (
        r##"H = Σ(i ⟦in⟧ 0..3) { p }; let a = ⟦1.5.2⟧"##,
        r##"a loop variable does not stand here
help: write `sum(i in 0..N) { … }`
`1.5.2` is not a number
help: write a decimal number"##,
    ),
    (
        r##"H = ⟦p.pow(2)⟧ + ⟦q.sqr()⟧ + ⟦q.atan2(p)⟧ + ⟦f64::sin⟧(q)"##,
        r##"`p.pow(…)`: a function stands before its argument
help: write `p^2`
`q.sqr(…)`: a function stands before its argument
help: write `q^2`
`q.atan2(…)`: a function stands before its argument
help: write `atan2(q, x)`
a path is not a value here
help: write `sin`"##,
    ),
];
