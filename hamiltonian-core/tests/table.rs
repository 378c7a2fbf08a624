//! Tables: columns by name, and the files they are written to.

use crate::common::python;
use crate::common::systems::*;
use hamiltonian_core::prelude::*;
use hamiltonian_core::{Error, Table, errors::TableError};
use std::io::{self, ErrorKind, Write};

/// A run of 2000 steps, all of them recorded.
fn recorded(recorder: Recorder) -> Recorder {
    let start = State::new([0.7], [0.0]);
    let mut run = Integrator::new(&pendulum(true), StormerVerlet::default(), start, 0.01)
        .unwrap()
        .observe(recorder);
    run.advance(2000).unwrap();
    run.into_observer()
}

/// A writer that counts calls and fails after so many bytes.
struct Counted {
    calls: usize,
    room: usize,
}

impl Write for Counted {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.calls += 1;
        if self.room < bytes.len() {
            return Err(io::Error::new(ErrorKind::StorageFull, "no room is left"));
        }
        self.room -= bytes.len();
        Ok(bytes.len())
    }
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn files_are_written_in_few_calls_and_failures_keep_their_kind() {
    let recorder = recorded(Recorder::new());
    assert_eq!((recorder.rows(), recorder.columns().len()), (2001, 4));
    type Writer = fn(&Table, &mut Counted) -> Result<(), Error>;
    let writers: [Writer; 2] = [
        |table, to| table.write_csv(to),
        |table, to| table.write_npy(to),
    ];
    for write in writers {
        let mut to = Counted {
            calls: 0,
            room: usize::MAX,
        };
        write(&recorder, &mut to).unwrap();
        let bytes = usize::MAX - to.room;
        assert!(bytes > 60_000, "{bytes}");
        assert!(to.calls <= bytes / 60_000 + 1, "{} for {bytes}", to.calls);
        let mut full = Counted {
            calls: 0,
            room: bytes - 1,
        };
        let error = write(&recorder, &mut full).unwrap_err();
        assert!(matches!(
            error,
            Error::Io {
                kind: ErrorKind::StorageFull,
                ..
            }
        ));
        assert_eq!(error.to_string(), "no room is left");
    }
}

/// The parts of a `.npy` file: the literal, and the bytes of the records.
fn npy(table: &Table) -> (String, Vec<u8>) {
    let mut bytes = Vec::new();
    table.write_npy(&mut bytes).unwrap();
    assert_eq!(&bytes[..6], b"\x93NUMPY");
    let (length, before) = match bytes[6] {
        1 => (u16::from_le_bytes([bytes[8], bytes[9]]) as usize, 10),
        _ => {
            let four = [bytes[8], bytes[9], bytes[10], bytes[11]];
            (u32::from_le_bytes(four) as usize, 12)
        }
    };
    assert_eq!((before + length) % 64, 0);
    let (header, records) = bytes[before..].split_at(length);
    (
        String::from_utf8(header.to_vec()).unwrap(),
        records.to_vec(),
    )
}

#[test]
fn npy_reads_back_to_the_same_bits() {
    let recorder = recorded(Recorder::new().with_energy());
    let (header, records) = npy(&recorder);
    assert_eq!(
        header.trim_end(),
        "{'descr': [('t', '<f8'), ('theta', '<f8'), ('p', '<f8'), ('height', '<f8'), \
         ('H', '<f8'), ], 'fortran_order': False, 'shape': (2001,), }"
    );
    let read: Vec<u64> = (records.as_chunks::<8>().0.iter())
        .map(|word| u64::from_le_bytes(*word))
        .collect();
    let rows: Vec<u64> = (recorder.iter().flatten())
        .map(|value| value.to_bits())
        .collect();
    assert_eq!(read, rows);
}

#[test]
fn an_index_is_written_in_whole_numbers() {
    let mut table = Table::with_index("member", ["x"]).unwrap();
    for row in [[3.0, 0.5], [3.0, f64::NAN], [1e15, -1e300]] {
        table.push(&row).unwrap();
    }
    let mut csv = Vec::new();
    table.write_csv(&mut csv).unwrap();
    let csv = String::from_utf8(csv).unwrap();
    assert_eq!(csv, "member,x\n3,0.5\n3,NaN\n1000000000000000,-1e300\n");
    let (header, records) = npy(&table);
    assert!(header.starts_with("{'descr': [('member', '<i8'), ('x', '<f8'), ]"));
    assert_eq!(&records[32..40], &1_000_000_000_000_000_i64.to_le_bytes());
    let members: Vec<f64> = table.column("member").unwrap().collect();
    assert_eq!(members, [3.0, 3.0, 1e15]);
    assert!(table.has_index());
    for wrong in [0.5, f64::NAN, f64::INFINITY, 1e16] {
        let error = table.push(&[wrong, 0.0]).unwrap_err();
        assert!(matches!(error, Error::Table(TableError::Index { .. })));
    }
    assert_eq!(table.rows(), 3);
}

#[test]
fn bad_names_and_rows_are_refused() {
    let error = |outcome: Result<_, Error>| outcome.map(|_: Table| ()).unwrap_err().to_string();
    assert_eq!(
        error(Table::new(["a", "b", "a"])),
        "two columns have the name `a`\nhelp: give each column a name of its own"
    );
    assert_eq!(
        error(Table::with_index("b", ["a", "b"])),
        "two columns have the name `b`\nhelp: give each column a name of its own"
    );
    let mut table = Table::new(["t", "theta", "angular_momentum[2]"]).unwrap();
    assert_eq!(
        table.push(&[1.0]).unwrap_err().to_string(),
        "a row has 1 values, and the table 3 columns"
    );
    for (name, help) in [
        ("thta", "did you mean `theta`?"),
        ("angular_momentum[1]", "did you mean `angular_momentum[2]`?"),
        ("x", "the columns are `t`, `theta`, `angular_momentum[2]`"),
    ] {
        assert_eq!(
            table.wrap(name).unwrap_err().to_string(),
            format!("there is no column `{name}`\nhelp: {help}")
        );
        assert!(table.column(name).is_none());
    }
}

#[test]
fn selected_columns_are_those_of_the_full_table() {
    let full = recorded(Recorder::new().with_energy());
    let some = recorded(Recorder::of(["height", "H", "t"]));
    assert_eq!(some.columns(), ["height", "H", "t"]);
    for name in some.columns() {
        assert!(some.column(name).unwrap().eq(full.column(name).unwrap()));
    }
    assert_eq!(
        recorded(Recorder::of(["p"]).with_energy()).columns(),
        ["p", "H"]
    );
    // The name of an array stands for its elements.
    let start = State::new(vec![0.1, 0.2], vec![0.0, 0.3]);
    let chain = Integrator::new(&Chain { n: 2 }, StormerVerlet::default(), start, 0.1).unwrap();
    let run = chain.observe(Recorder::of(["p", "q[1]"]));
    assert_eq!(run.observer().columns(), ["p[0]", "p[1]", "q[1]"]);
    assert_eq!(run.observer().row(0), Some(&[0.0, 0.3, 0.2][..]));
}

#[test]
fn an_unknown_column_is_the_error_of_the_run() {
    let start = || State::new([0.7], [0.0]);
    for (recorder, place) in [
        (Recorder::of(["t", "hight"]), "hight"),
        (Recorder::new().with_wrapped("hight"), "hight"),
    ] {
        let mut run = Integrator::new(&pendulum(true), StormerVerlet::default(), start(), 0.01)
            .unwrap()
            .observe((EnergyDrift::new(), every(2, recorder)));
        let error = run.advance(3).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!("there is no column `{place}`\nhelp: did you mean `height`?")
        );
        assert_eq!(run.steps(), 0);
    }
}

/// A pendulum that turns over, whose angle grows beyond all bounds.
#[test]
fn angles_are_wrapped_by_name() {
    let turning = |recorder| {
        let start = State::new([0.0], [500.0]);
        let mut run = Integrator::new(&pendulum(true), StormerVerlet::default(), start, 0.01)
            .unwrap()
            .observe(recorder);
        run.advance(5_000).unwrap();
        run.into_observer()
    };
    let plain = turning(Recorder::new());
    let wrapped = turning(Recorder::new().with_wrapped("theta"));
    let mut table = plain.clone().into_table();
    table.wrap("theta").unwrap();
    assert_eq!(*wrapped, table);
    let pi = std::f64::consts::PI;
    let mut turns = 0.0_f64;
    for (angle, inside) in plain
        .column("theta")
        .unwrap()
        .zip(table.column("theta").unwrap())
    {
        assert!(-pi < inside && inside <= pi);
        let difference = (angle - inside) / (2.0 * pi);
        // Angles up to 10³ have this rounding, and 2π in f64 another.
        assert!((difference - difference.round()).abs() < 1e-13, "{angle}");
        if angle.abs() <= pi {
            assert_eq!(angle.to_bits(), inside.to_bits());
        }
        turns = turns.max(difference);
    }
    assert!(turns > 10.0, "{turns}");
    assert!(plain.column("p").unwrap().eq(table.column("p").unwrap()));
}

#[test]
fn numpy_and_pandas_read_both_files() {
    if !python::has(&["numpy", "pandas"]) {
        return;
    }
    let recorder = recorded(Recorder::new());
    let mut odd = Table::with_index("member", ["it's", "a, \"b\"", "ħ\\"]).unwrap();
    odd.push(&[7.0, 0.1, f64::NAN, f64::INFINITY]).unwrap();
    let place = std::env::temp_dir().join(format!("hamiltonian-table-{}", std::process::id()));
    std::fs::create_dir_all(&place).unwrap();
    for (name, table) in [("run", &*recorder), ("odd", &odd)] {
        for (ending, npy) in [("csv", false), ("npy", true)] {
            let file = std::fs::File::create(place.join(format!("{name}.{ending}"))).unwrap();
            match npy {
                true => table.write_npy(file).unwrap(),
                false => table.write_csv(file).unwrap(),
            }
        }
    }
    let printed = python::run(
        "import sys, numpy as np, pandas as pd\n\
         for name in ['run', 'odd']:\n\
        \x20   a = pd.DataFrame(np.load(f'{sys.argv[1]}/{name}.npy'))\n\
        \x20   b = pd.read_csv(f'{sys.argv[1]}/{name}.csv')\n\
        \x20   pd.testing.assert_frame_equal(a, b, check_exact=True)\n\
        \x20   print(a.shape, list(a.columns), repr(float(a.iloc[-1, 1])))\n",
        &[place.to_str().unwrap()],
    );
    std::fs::remove_dir_all(&place).unwrap();
    let last = recorder.row(2000).unwrap()[1];
    assert_eq!(
        printed,
        format!(
            "(2001, 4) ['t', 'theta', 'p', 'height'] {last:?}\n\
             (1, 4) ['member', \"it's\", 'a, \"b\"', 'ħ\\\\'] 0.1\n"
        )
    );
}
