//! States, parameters, functions with data, tables and saved runs, written and read by serde: `cargo test --features serde --test serde`.

use hamiltonian::prelude::*;
use hamiltonian::{Gradient, Table};
use serde_json::{from_str, json, to_value};

hamiltonian! {
    /// Literal sizes.
    pub struct Springs { k = 2.0, m: [2] = [1.0, 2.0], K: [2][2] = [[2, -1], [-1, 2]], w: [2][1][3] }
    H(q[2]; p[2]) = sum(i in 0..2) { p[i]^2/(2*m[i]) } + k*dot(q, K*q)/2
        + sum(i in 0..2, j in 0..3) { w[i][0][j] }
}

hamiltonian! {
    /// A const generic.
    pub struct Bodies<const N: usize> { m: [N] }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m[i]) + norm_squared(q[i])/2 }
}

hamiltonian! {
    /// Sizes set at run time.
    pub struct Crystal { n: usize, a = 1.0, m: [n], K: [n][n], w: [n][2][n] }
    H(u[n][8]; p[n][8]) = sum(i in 0..n, j in 0..8) { p[i][j]^2/(2*m[i]) + a*u[i][j]^2/2 }
        + sum(i in 0..n, j in 0..n) { K[i][j]*w[i][1][j]*u[i][0]*u[j][0] }
}

hamiltonian! {
    /// Mixed shapes; an index that depends on the size.
    pub struct Cart { n: usize, c = 1.0 }
    H(x, r[3], z[n]; p_x, p_r[3], p_z[n]) = p_x^2/2 + norm_squared(p_r)/2 + norm_squared(p_z)/2 + c*z[2]*x
        + norm_squared(r)/2
}

hamiltonian! {
    /// No parameters.
    pub struct Plain {}
    H = p^2/2 - cos(q)
}

hamiltonian! {
    /// A function with data.
    pub struct Well { m = 1.0, V: fn(x) }
    H(x; p) = p^2/(2*m) + V(x)
}

/// The message of an error.
fn refused<X: serde_core::de::DeserializeOwned>(text: &str) -> String {
    match from_str::<X>(text) {
        Ok(_) => panic!("`{text}` is accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn parameters_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let springs =
        Springs::new([[[1.0, 2.0, 3.0]], [[4.0, 5.0, 6.0]]]).with_K([[1.0, 2.0], [3.0, 4.0]]);
    let text = json!({
        "k": 2.0, "m": [1.0, 2.0], "K": [[1.0, 2.0], [3.0, 4.0]], "w": [[[1.0, 2.0, 3.0]], [[4.0, 5.0, 6.0]]],
    });
    assert_eq!(to_value(&springs)?, text);
    let back: Springs = from_str(&text.to_string())?;
    assert_eq!(
        (back.k, back.m, back.K, back.w),
        (springs.k, springs.m, springs.K, springs.w)
    );

    let bodies: Bodies<2> = from_str(r#"{"m": [1.0, 2.0]}"#)?;
    assert_eq!(bodies.m.as_slice(), [1.0, 2.0]);
    assert_eq!(to_value(Plain {})?, json!({}));
    let _: Plain = from_str("{}")?;

    let crystal = Crystal::new(
        2,
        [1.0, 2.0],
        [[1.0, 2.0], [3.0, 4.0]],
        [[[1.0, 2.0], [3.0, 4.0]]; 2],
    )?;
    let text = to_value(&crystal)?;
    assert_eq!(text["K"], json!([[1.0, 2.0], [3.0, 4.0]]));
    let back: Crystal = serde_json::from_value(text)?;
    let start = State::new(
        [[0.5; 8], [0.25; 8]].map(Vec::from).to_vec(),
        vec![vec![1.0; 8]; 2],
    );
    assert_eq!(back.energy(&start), crystal.energy(&start));
    Ok(())
}

#[test]
fn parameters_are_checked() {
    let w = r#""w": [[[1.0, 2.0, 3.0]], [[4.0, 5.0, 6.0]]]"#;
    let springs = |fields: &str| refused::<Springs>(&format!("{{{fields}, {w}}}"));
    let short = springs(r#""k": 1.0, "m": [1.0], "K": [[1.0, 2.0], [3.0, 4.0]]"#);
    assert!(
        short.starts_with("`m` must have 2 components, found 1"),
        "{short}"
    );
    let uneven = springs(r#""k": 1.0, "m": [1.0, 2.0], "K": [[1.0, 2.0], [3.0]]"#);
    assert!(
        uneven.starts_with("`K[1]` must have 2 elements, found 1"),
        "{uneven}"
    );
    let missing = springs(r#""k": 1.0, "K": [[1.0, 2.0], [3.0, 4.0]]"#);
    assert!(missing.starts_with("missing field `m`"), "{missing}");
    let unknown = springs(r#""mass": 1.0"#);
    assert!(
        unknown.starts_with("unknown field `mass`, expected one of `k`, `m`, `K`, `w`"),
        "{unknown}"
    );
    let twice = springs(r#""k": 1.0, "k": 2.0"#);
    assert!(twice.starts_with("duplicate field `k`"), "{twice}");
    let axes = refused::<Springs>(
        r#"{"k": 1.0, "m": [1.0, 2.0], "K": [[1.0, 2.0], [3.0, 4.0]], "w": [[[1.0, 2.0]], [[4.0, 5.0]]]}"#,
    );
    assert!(
        axes.starts_with("axis 2 of `w` must have the extent 3, found 2"),
        "{axes}"
    );

    // As by `new`: arrays of other sizes, and indices out of range.
    let crystal = r#"{"n": 3, "a": 1.0, "m": [1.0, 2.0], "K": [[1.0, 2.0], [3.0, 4.0]], "w": []}"#;
    let error = refused::<Crystal>(crystal);
    assert!(
        error.starts_with("`m` must have 3 components, found 2"),
        "{error}"
    );
    let error = refused::<Cart>(r#"{"n": 2, "c": 1.0}"#);
    assert!(error.contains("`z[2]`"), "{error}");
    let error = refused::<Cart>(r#"{"n": 18446744073709551615, "c": 1.0}"#);
    assert!(error.contains("memory"), "{error}");
}

#[test]
fn states_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let plane = State::new([0.5, 1.0], [0.0, 2.0]).at(3.0);
    assert_eq!(
        to_value(&plane)?,
        json!({"t": 3.0, "q": [0.5, 1.0], "p": [0.0, 2.0]})
    );
    assert_eq!(
        from_str::<StateOf<Springs>>(&json!(plane).to_string())?,
        plane
    );

    let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    let bodies = State::new(rows, rows);
    assert_eq!(to_value(&bodies)?["q"], json!(rows));
    assert_eq!(
        from_str::<StateOf<Bodies<2>>>(&json!(bodies).to_string())?,
        bodies
    );

    let lists = vec![vec![0.5; 8]; 2];
    let field = State::new(lists.clone(), lists);
    assert_eq!(
        from_str::<StateOf<Crystal>>(&json!(field).to_string())?,
        field
    );

    let vector = || CartVector::new(0.5, [1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]);
    let cart = State::new(vector(), vector());
    let q = json!({"x": 0.5, "r": [1.0, 2.0, 3.0], "z": [4.0, 5.0, 6.0]});
    assert_eq!(to_value(&cart)?["q"], q);
    assert_eq!(from_str::<StateOf<Cart>>(&json!(cart).to_string())?, cart);

    let system = Cart::new(3)?;
    let gradient = system.gradient(&cart);
    let back: Gradient<CartVector<f64>> = from_str(&json!(gradient).to_string())?;
    assert_eq!(back, gradient);

    // Formats without names have the fields in order.
    let back: StateOf<Springs> = from_str("[3.0, [0.5, 1.0], [0.0, 2.0]]")?;
    assert_eq!(back, plane);
    Ok(())
}

#[test]
fn states_are_checked() {
    let short = refused::<StateOf<Springs>>(r#"{"t": 0.0, "q": [1.0], "p": [1.0, 2.0]}"#);
    assert!(
        short.starts_with("`q` must have 2 components, found 1"),
        "{short}"
    );
    let row =
        refused::<StateOf<Bodies<2>>>(r#"{"t": 0.0, "q": [[1.0, 2.0], [1.0, 2.0]], "p": []}"#);
    assert!(
        row.starts_with("`q[0]` must have 3 elements, found 2"),
        "{row}"
    );
    let halves =
        refused::<StateOf<Crystal>>(r#"{"t": 0.0, "q": [[1.0], [2.0]], "p": [[1.0, 2.0]]}"#);
    assert!(
        halves.starts_with("axis 0 of `p` must have the extent 2, found 1"),
        "{halves}"
    );
    let uneven =
        refused::<StateOf<Crystal>>(r#"{"t": 0.0, "q": [[1.0], [2.0, 3.0]], "p": [[1.0, 2.0]]}"#);
    assert!(
        uneven.starts_with("`q[1]` must have 1 elements, found 2"),
        "{uneven}"
    );
    let mixed = refused::<StateOf<Cart>>(
        r#"{"t": 0.0, "q": {"x": 0.5, "r": [1.0], "z": []}, "p": {"x": 0.5, "r": [1.0], "z": []}}"#,
    );
    assert!(
        mixed.starts_with("`r` must have 3 components, found 1"),
        "{mixed}"
    );
    let missing = refused::<StateOf<Springs>>("[3.0, [0.5, 1.0]]");
    assert!(missing.starts_with("missing field `p`"), "{missing}");
}

#[test]
fn tables_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let mut table = Table::with_index("member", ["theta"])?;
    table.push(&[0.0, 0.25])?;
    table.push(&[1.0, 0.5])?;
    let text =
        json!({"columns": ["member", "theta"], "index": true, "rows": [[0.0, 0.25], [1.0, 0.5]]});
    assert_eq!(to_value(&table)?, text);
    assert_eq!(from_str::<Table>(&text.to_string())?, table);
    for wrong in [
        r#"{"columns": ["t", "t"], "index": false, "rows": []}"#,
        r#"{"columns": ["t", "q"], "index": false, "rows": [[1.0]]}"#,
        r#"{"columns": ["t"], "index": true, "rows": [[0.5]]}"#,
        r#"{"columns": [], "index": true, "rows": [[]]}"#,
    ] {
        refused::<Table>(wrong);
    }
    Ok(())
}

#[test]
fn splines_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let (knots, values) = ([0.0, 1.0, 2.5, 3.0], [0.1, 1.0, -1.0, 0.1]);
    let splines = [
        (Spline::natural(&knots, &values)?, false, json!(null)),
        (
            Spline::clamped(&knots, &values, [0.3, -0.7])?,
            false,
            json!([0.3, -0.7]),
        ),
        (Spline::periodic(&knots, &values)?, true, json!(null)),
    ];
    let mut fingerprints = vec![];
    for (spline, periodic, slopes) in splines {
        let text =
            json!({"knots": knots, "values": values, "periodic": periodic, "slopes": slopes});
        assert_eq!(to_value(&spline)?, text);
        let back: Spline = from_str(&text.to_string())?;
        for x in [0.0, 0.73, 1.0, 2.9, 3.0] {
            assert_eq!(back.value([x]), spline.value([x]));
        }
        assert_eq!(back.fingerprint(), spline.fingerprint());
        fingerprints.push(back.fingerprint());

        // As a parameter.
        let well = Well::new(spline);
        let back: Well<Spline> = from_str(&to_value(&well)?.to_string())?;
        assert_eq!((back.m, back.V.value([0.5])), (1.0, well.V.value([0.5])));
    }
    fingerprints.sort_unstable();
    fingerprints.dedup();
    assert_eq!(fingerprints.len(), 3);
    Ok(())
}

#[test]
fn splines_are_checked() {
    let spline = |fields: &str| refused::<Spline>(&format!("{{{fields}}}"));
    for (fields, message) in [
        (
            r#""knots": [0, 1], "values": [0], "periodic": false, "slopes": null"#,
            "2 knots have 1 values",
        ),
        (
            r#""knots": [], "values": [], "periodic": false, "slopes": null"#,
            "0 knots are too few: at least 2 are needed",
        ),
        (
            r#""knots": [0, 1, 2], "values": [0, 1, 0], "periodic": true, "slopes": null"#,
            "3 knots are too few: at least 4 are needed",
        ),
        (
            r#""knots": [0, 0], "values": [0, 1], "periodic": false, "slopes": null"#,
            "knot 1 is 0, and must be above knot 0, which is 0",
        ),
        (
            r#""knots": [0, 1, 2, 3], "values": [0, 1, 2, 3], "periodic": true, "slopes": null"#,
            "a periodic function begins and ends with the same value",
        ),
        (
            r#""knots": [0, 1, 2, 3], "values": [0, 1, 2, 0], "periodic": true, "slopes": [0, 0]"#,
            "a periodic spline has no `slopes`",
        ),
        (
            r#""knots": [0, 1], "values": [0, 1], "periodic": false"#,
            "missing field `slopes`",
        ),
    ] {
        let error = spline(fields);
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn grids_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let rows = [
        [0.1, 1.0, 2.0],
        [3.0, 0.5, -1.0],
        [2.0, 0.25, 1.5],
        [1.0; 3],
    ];
    let (origin, spacing) = ([-1.0, 0.5], [0.5, 0.25]);
    for (grid, periodic) in [
        (Grid::natural(origin, spacing, &rows)?, false),
        (Grid::periodic(origin, spacing, &rows)?, true),
    ] {
        let text =
            json!({"origin": origin, "spacing": spacing, "rows": rows, "periodic": periodic});
        assert_eq!(to_value(&grid)?, text);
        let back: Grid = from_str(&text.to_string())?;
        for at in [[-1.0, 0.5], [-0.3, 0.8], [0.2, 1.0]] {
            assert_eq!(back.value(at), grid.value(at));
            assert!(grid.value(at).is_finite());
        }
        assert_eq!(back.fingerprint(), grid.fingerprint());
    }
    Ok(())
}

#[test]
fn grids_are_checked() {
    for (fields, message) in [
        (
            r#""spacing": [1, 1], "rows": [[0, 1], [0]]"#,
            "2 knots have 1 values",
        ),
        (
            r#""spacing": [1, 1], "rows": [[], []]"#,
            "0 knots are too few",
        ),
        (r#""spacing": [1, 1], "rows": []"#, "0 knots are too few"),
        (
            r#""spacing": [1, -1], "rows": [[0, 1], [2, 3]]"#,
            "spacing 1 is -1, and must be positive",
        ),
        (
            r#""spacing": [1], "rows": [[0, 1], [2, 3]]"#,
            "invalid length 1",
        ),
    ] {
        let error = refused::<Grid>(&format!(
            r#"{{"origin": [0, 0], "periodic": false, {fields}}}"#
        ));
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn saved_runs_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let start = State::new([0.5], [0.25]);
    let mut run = Integrator::new(&Plain {}, StormerVerlet::default(), start, 0.125)?
        .observe(EnergyDrift::new());
    run.advance(10)?;
    let saved = run.checkpoint();
    let text = to_value(&saved)?;
    assert_eq!(text, json!(saved.to_bytes()));
    let back: Checkpoint = from_str(&text.to_string())?;
    assert_eq!(back, saved);
    let mut again =
        Integrator::resume(&Plain {}, StormerVerlet::default(), back)?.observe(EnergyDrift::new());
    run.advance(10)?;
    again.advance(10)?;
    assert_eq!(again.state(), run.state());

    // Each changed byte is found: by the first words or by the checksum.
    let bytes = saved.to_bytes();
    for at in 0..bytes.len() {
        let mut bytes = bytes.clone();
        bytes[at] ^= 1;
        refused::<Checkpoint>(&json!(bytes).to_string());
    }
    for text in ["[]", "[72, 65]", "[256]", "\"HAMILTON\"", "{}"] {
        refused::<Checkpoint>(text);
    }
    let damaged = refused::<Checkpoint>(&json!(bytes[..bytes.len() - 8]).to_string());
    assert!(
        damaged.starts_with("the saved run is damaged: its checksum is wrong"),
        "{damaged}"
    );
    Ok(())
}
