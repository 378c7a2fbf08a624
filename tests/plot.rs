//! Pictures: what is drawn, and how large the files are.

use crate::common::systems::Pendulum;
use crate::python;
use hamiltonian::plot::{Curve, DENSE, Figure};
use hamiltonian::prelude::*;
use hamiltonian::{Error, errors::TableError};

fn recorded(start: f64, recorder: Recorder) -> Recorder {
    let start = State::new([0.0], [start]);
    let mut run = Integrator::new(&Pendulum::default(), StormerVerlet::default(), start, 0.05)
        .unwrap()
        .observe(recorder);
    run.advance(1000).unwrap();
    run.into_observer()
}

#[test]
fn one_line_draws_each_common_picture() {
    let recorder = recorded(100.0, Recorder::new().with_energy());
    let both = Figure::against_time(&recorder, ["theta", "p"]).unwrap();
    assert_eq!((both.curves.len(), both.x.as_str()), (2, "t"));
    let first: Vec<f64> = both.curves[1].points.iter().map(|point| point.1).collect();
    assert!(recorder.column("p").unwrap().eq(first));
    let svg = both.svg().unwrap();
    assert!(svg.contains(">\ntheta\n</text>") && svg.contains("<polyline"));

    let drift = Figure::energy_drift(&recorder).unwrap();
    let energy: Vec<f64> = recorder.column("H").unwrap().collect();
    let worst = energy
        .iter()
        .map(|h| (h / energy[0] - 1.0).abs())
        .fold(0.0, f64::max);
    let drawn = drift.curves[0]
        .points
        .iter()
        .map(|point| point.1)
        .fold(0.0, f64::max);
    assert!(drift.logarithmic && (drawn / worst - 1.0).abs() < 1e-9);

    for error in [
        Figure::against_time(&recorder, ["thta"]).unwrap_err(),
        Figure::phase_portrait(&recorder, "theta", "momentum").unwrap_err(),
        Figure::energy_drift(&recorded(1.0, Recorder::new())).unwrap_err(),
    ] {
        assert!(matches!(error, Error::Table(TableError::Unknown { .. })));
    }
}

/// A pendulum that turns over: the curve is cut where the angle jumps, and only there.
#[test]
fn wrapped_angles_are_not_joined_across() {
    let recorder = recorded(300.0, Recorder::new().with_wrapped("theta"));
    let portrait = Figure::phase_portrait(&recorder, "theta", "p").unwrap();
    let cuts = portrait.curves[0]
        .points
        .iter()
        .filter(|point| point.1.is_nan())
        .count();
    let theta: Vec<f64> = recorder.column("theta").unwrap().collect();
    let jumps = theta.windows(2).filter(|pair| pair[1] < pair[0]).count();
    assert!(cuts > 10, "{cuts}");
    assert_eq!(cuts, jumps);
    let plain = recorded(300.0, Recorder::new());
    let portrait = Figure::phase_portrait(&plain, "theta", "p").unwrap();
    assert!(
        portrait.curves[0]
            .points
            .iter()
            .all(|point| !point.1.is_nan())
    );
}

/// Pseudorandom points in a square: the worst case of a compression.
fn cloud(count: usize) -> Vec<(f64, f64)> {
    let mut x = 1_u64;
    let mut next = || {
        x = x
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (x >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..count).map(|_| (next(), next())).collect()
}

#[test]
fn a_dense_cloud_is_one_image() {
    let few = Figure::section("x", "y", cloud(DENSE)).svg().unwrap();
    assert_eq!(few.matches("<circle").count(), DENSE);
    assert!(!few.contains("<image"));
    let many = Figure::section("x", "y", cloud(20_000)).svg().unwrap();
    assert!(!many.contains("<circle") && !many.contains("the place of the raster"));
    assert_eq!(many.matches("<image").count(), 1);
    assert!(many.len() < 70_000, "{}", many.len());
    // Several orbits have colours of their own.
    let curves = (0..5).map(|k| Curve {
        name: format!("orbit {k}"),
        points: cloud(2_000)
            .into_iter()
            .map(|(x, y)| (x + f64::from(k), y))
            .collect(),
    });
    let orbits = Figure {
        dots: true,
        curves: curves.collect(),
        ..Figure::default()
    };
    assert_eq!(orbits.svg().unwrap().matches("<image").count(), 1);
}

/// What was drawn is what a decoder of PNG finds.
#[test]
fn the_image_has_the_points() {
    if !python::has(&["numpy"]) {
        return;
    }
    let place = std::env::temp_dir().join(format!("hamiltonian-plot-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    // A line from corner to corner, of two colours, and noise besides.
    let line = |from: f64| (0..5_000).map(move |k| from + f64::from(k) / 10_000.0);
    let curve = |name: &str, points: Vec<(f64, f64)>| Curve {
        name: name.to_string(),
        points,
    };
    let figure = Figure {
        dots: true,
        equal: true,
        curves: vec![
            curve(
                "",
                cloud(9_000).into_iter().map(|(x, y)| (x, y * x)).collect(),
            ),
            curve("", line(0.0).map(|x| (x, x)).collect()),
            curve("", line(0.5).map(|x| (x, x)).collect()),
        ],
        ..Figure::default()
    };
    figure.write(place.join("below").join("cloud.svg")).unwrap();
    let printed = python::run(
        r#"
import sys, re, base64, zlib, struct
text = open(f"{sys.argv[1]}/below/cloud.svg", encoding="utf-8").read()
data = base64.b64decode(re.search(r'base64,([^"]*)"', text)[1], validate=True)
assert data[:8] == b"\x89PNG\r\n\x1a\n"
at, chunks = 8, {}
while at < len(data):
    length, kind = struct.unpack(">I4s", data[at:at+8])
    content, crc = data[at+8:at+8+length], struct.unpack(">I", data[at+8+length:at+12+length])[0]
    assert zlib.crc32(kind + content) == crc
    chunks[kind] = content
    at += 12 + length
width, height, depth, kind = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
lines = zlib.decompress(chunks[b"IDAT"])
assert depth == 2 and kind == 3 and len(lines) == height*(1 + (width*depth + 7)//8)
def pixel(row, column):
    byte = lines[row*(len(lines)//height) + 1 + column*depth//8]
    return byte >> (8 - depth - column*depth % 8) & 3
# The square has a margin of .03 of its sides, and y goes up.
def at_point(x, y):
    return pixel(int(height*(1 - (y + .03)/1.06)), int(width*(x + .03)/1.06))
def near(x, y):
    return {at_point(x + i/900, y + j/900) for i in (-1, 0, 1) for j in (-1, 0, 1)}
on = [near(k/200, k/200) for k in range(5, 195)]
assert all(2 in found for found in on[:90]) and all(3 in found for found in on[105:])
above = {at_point(x/100, x/100 + .1) for x in range(85)}
print(abs(width - height), above, len(data) < 40_000)
"#,
        &[place.to_str().unwrap()],
    );
    std::fs::remove_dir_all(&place).unwrap();
    assert_eq!(printed, "0 {0} True\n");
}
