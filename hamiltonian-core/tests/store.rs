//! Stores: chunks that are there whole or not at all, and read by other programs.

#[cfg(unix)]
mod kills;

use crate::common::python;
use hamiltonian_core::{
    Error, Real,
    errors::StoreError,
    results::{ChunkData, Layout, Rows, Store},
};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A directory that goes when it is dropped.
struct Place(PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        let name = format!("hamiltonian-store-{name}-{}", std::process::id());
        let place = Place(std::env::temp_dir().join(name));
        let _ = std::fs::remove_dir_all(&place.0);
        std::fs::create_dir_all(&place.0).unwrap();
        place
    }
    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn layout(rows: Rows) -> Layout {
    Layout {
        rows,
        chunk: 4,
        failures: vec!["domain".to_string(), "solver".to_string()],
        attributes: vec![
            ("hamiltonian".to_string(), "p^2/2 - \"cos\"(θ)\n".into()),
            ("step".to_string(), 0.01.into()),
            ("seed".to_string(), u64::MAX.into()),
            ("reproducible".to_string(), true.into()),
        ],
        ..Layout::new(10, ["theta", "drift[0]"])
    }
}

fn at() -> Rows {
    Rows::At {
        name: "at".to_string(),
        values: vec![0.5, 1.0, 2.0],
    }
}

/// Results that are a function of the member: member 6 has failed and has no rows.
fn data(layout: &Layout, chunk: u64) -> ChunkData {
    let members: Vec<u64> = layout.members_of(chunk).collect();
    let failed = |member: u64| member == 6;
    let rows_of = |member: u64| match &layout.rows {
        Rows::One => 1,
        Rows::At { values, .. } => values.len() as u64,
        Rows::Any if failed(member) => 0,
        Rows::Any => member % 4,
    };
    let value = |column: f64, member: u64, row: u64| match failed(member) {
        true => f64::NAN,
        false => Real::sin(member as f64 + column) + row as f64,
    };
    let rows = || (members.iter()).flat_map(|m| (0..rows_of(*m)).map(|row| (*m, row)));
    let column = |column: f64| rows().map(|(m, row)| value(column, m, row)).collect();
    ChunkData {
        columns: vec![column(0.0), column(0.25)],
        member: match layout.rows {
            Rows::Any => rows().map(|(member, _)| member).collect(),
            _ => Vec::new(),
        },
        status: members
            .iter()
            .map(|m| if failed(*m) { 4 } else { 1 })
            .collect(),
        time: members.iter().map(|m| *m as f64 / 8.0).collect(),
        steps: members.iter().map(|m| m * 1_000_000_007).collect(),
        hashes: [chunk + 17, u64::MAX - chunk],
    }
}

/// Every file below a directory with its bytes, and empty directories without.
fn tree(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut left = vec![root.to_path_buf()];
    while let Some(directory) = left.pop() {
        let entries: Vec<_> = std::fs::read_dir(&directory).unwrap().collect();
        if entries.is_empty() {
            found.insert(
                directory.strip_prefix(root).unwrap().to_path_buf(),
                Vec::new(),
            );
        }
        for entry in entries {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => left.push(path),
                false => {
                    let bytes = std::fs::read(&path).unwrap();
                    found.insert(path.strip_prefix(root).unwrap().to_path_buf(), bytes);
                }
            }
        }
    }
    found
}

/// Equal, a NaN with itself too.
fn assert_same(read: &ChunkData, written: &ChunkData) {
    let bits = |data: &ChunkData| -> Vec<Vec<u64>> {
        let columns = data.columns.iter().chain([&data.time]);
        columns
            .map(|c| c.iter().map(|v| v.to_bits()).collect())
            .collect()
    };
    assert_eq!(bits(read), bits(written));
    let rest = |data: &ChunkData| {
        let ChunkData {
            member,
            status,
            steps,
            hashes,
            ..
        } = data.clone();
        (member, status, steps, hashes)
    };
    assert_eq!(rest(read), rest(written));
}

#[test]
fn chunks_are_read_as_they_were_written() {
    let place = Place::new("read");
    for (number, rows) in [Rows::One, at(), Rows::Any].into_iter().enumerate() {
        let layout = layout(rows);
        let path = place.path(&format!("deep/below/{number}.zarr"));
        let store = Store::open_or_create(&path, &layout).unwrap();
        assert_eq!(
            store.completeness().unwrap().to_string(),
            "3 of 3 chunks are missing: 0 to 2"
        );
        assert_eq!(store.read(1).unwrap(), None);
        store.write(1, &data(&layout, 1)).unwrap();
        assert!(store.present(1).unwrap() && !store.present(0).unwrap());
        let after = store.completeness().unwrap();
        assert_eq!(after.to_string(), "2 of 3 chunks are missing: 0, 2");
        // Others open it meanwhile, and write what is missing in any order.
        let again = Store::open_or_create(&path, &layout).unwrap();
        for chunk in [2, 0] {
            again.write(chunk, &data(&layout, chunk)).unwrap();
        }
        for chunk in 0..3 {
            assert_same(&store.read(chunk).unwrap().unwrap(), &data(&layout, chunk));
        }
        assert_eq!(
            store.completeness().unwrap().to_string(),
            "complete (3 chunks)"
        );
        // A chunk that is present stays as it is.
        let before = tree(&path);
        let mut other = data(&layout, 0);
        other.time[0] = 7.0;
        store.write(0, &other).unwrap();
        assert_eq!(tree(&path), before);
        // The order in which chunks were written is not seen.
        let twin = place.path(&format!("twin-{number}.zarr"));
        let straight = Store::open_or_create(&twin, &layout).unwrap();
        for chunk in 0..3 {
            straight.write(chunk, &data(&layout, chunk)).unwrap();
        }
        assert!(straight.completeness().unwrap().is_complete());
        assert_eq!(tree(&twin), before);
    }
}

#[test]
fn a_store_of_another_sweep_is_refused() {
    let place = Place::new("other");
    let path = place.path("sweep.zarr");
    let first = layout(Rows::One);
    let store = Store::open_or_create(&path, &first).unwrap();
    let refused = |other: &Layout| match Store::open_or_create(&path, other).unwrap_err() {
        Error::Store(StoreError::Other { saved, given, .. }) => (saved, given),
        error => panic!("{error}"),
    };
    let pair = |saved: &str, given: &str| (Box::from(saved), Box::from(given));
    let mut other = first.clone();
    other.attributes[1].1 = 0.02.into();
    assert_eq!(refused(&other), pair("\"step\": 0.01", "\"step\": 0.02"));
    let other = Layout {
        members: 11,
        ..first.clone()
    };
    assert_eq!(refused(&other), pair("\"members\": 10", "\"members\": 11"));
    let other = Layout {
        chunk: 5,
        ..first.clone()
    };
    assert_eq!(refused(&other), pair("\"chunk\": 4", "\"chunk\": 5"));
    let mut other = first.clone();
    other.columns[1] = "drift".to_string();
    assert_eq!(refused(&other), pair("\"drift[0]\": {", "\"drift\": {"));
    let mut other = first.clone();
    other.failures.pop();
    assert!(refused(&other).0.contains("flag_values"));
    assert_eq!(&*refused(&layout(at())).0, "\"theta\": {");
    // The members of a chunk are told by their hash.
    store.write(0, &data(&first, 0)).unwrap();
    store.check_first(0, 17).unwrap();
    let error = store.check_first(0, 18).unwrap_err();
    assert!(matches!(
        error,
        Error::Store(StoreError::Members { chunk: 0, .. })
    ));
    // A directory of something else.
    let foreign = place.path("documents");
    std::fs::create_dir(&foreign).unwrap();
    std::fs::write(foreign.join("thesis.tex"), "").unwrap();
    let error = Store::open_or_create(&foreign, &first).unwrap_err();
    let Error::Store(StoreError::Foreign { path, entry, .. }) = error else {
        panic!("{error}");
    };
    assert_eq!(
        (&*path, &*entry),
        (&*foreign.display().to_string(), "thesis.tex")
    );
    assert_eq!(tree(&foreign).len(), 1);
    // A file in the place of a directory.
    let file = place.path("file");
    std::fs::write(&file, "").unwrap();
    let error = Store::open_or_create(&file, &first).unwrap_err();
    assert!(
        matches!(error, Error::Store(StoreError::File { .. })),
        "{error}"
    );
}

#[test]
fn bad_layouts_and_data_are_refused() {
    let place = Place::new("bad");
    let path = place.path("sweep.zarr");
    let good = layout(Rows::One);
    let refused = |layout: Layout| {
        let error = Store::open_or_create(&path, &layout).unwrap_err();
        assert!(
            matches!(error, Error::Store(StoreError::Layout { .. })),
            "{error}"
        );
        assert!(!path.exists());
        error.to_string()
    };
    refused(Layout {
        members: 0,
        ..good.clone()
    });
    refused(Layout {
        chunk: 0,
        ..good.clone()
    });
    for name in [
        "status", "time", "", ".", "..", "a/b", "a\\b", "__x", "a\nb", "theta",
    ] {
        let mut other = good.clone();
        other.columns[1] = name.to_string();
        assert!(refused(other).contains("\nhelp: "));
    }
    let rows = Rows::At {
        name: "theta".to_string(),
        values: vec![1.0],
    };
    assert!(refused(layout(rows)).starts_with("two columns have the name `theta`"));

    let store = Store::open_or_create(&path, &good).unwrap();
    let before = tree(&path);
    let spoil: [fn(&mut ChunkData); 6] = [
        |data| data.status.truncate(1),
        |data| data.time.push(0.0),
        |data| data.steps.clear(),
        |data| data.columns[1].truncate(2),
        |data| data.columns.truncate(1),
        |data| data.member.push(4),
    ];
    for spoil in spoil {
        let mut spoilt = data(&good, 1);
        spoil(&mut spoilt);
        let error = store.write(1, &spoilt).unwrap_err();
        assert!(
            matches!(error, Error::Store(StoreError::Shape { .. })),
            "{error}"
        );
    }
    let error = store.write(3, &data(&good, 2)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "there is no chunk 3: the layout has 3, and the last is chunk 2"
    );
    assert_eq!(tree(&path), before);

    let any = layout(Rows::Any);
    let store = Store::open_or_create(place.path("any.zarr"), &any).unwrap();
    let mut outside = data(&any, 1);
    *outside.member.last_mut().unwrap() = 8;
    assert_eq!(
        store.write(1, &outside).unwrap_err().to_string(),
        "member 8 is not of chunk 1\nhelp: give the rows of its members, in their order"
    );
    let mut turned = data(&any, 1);
    turned.member.reverse();
    assert!(
        store
            .write(1, &turned)
            .unwrap_err()
            .to_string()
            .contains("order of members")
    );
    // A file that was cut off.
    store.write(1, &data(&any, 1)).unwrap();
    let file = place.path("any.zarr/steps/c/1");
    std::fs::write(&file, [0; 31]).unwrap();
    match store.read(1).unwrap_err() {
        Error::Store(StoreError::Damaged {
            path,
            found: 31,
            expected: 32,
            ..
        }) => {
            assert_eq!(&*path, file.display().to_string());
        }
        error => panic!("{error}"),
    }
}

/// Leftovers of a killed process at each place where it can be killed: before each rename.
#[test]
fn a_chunk_without_its_status_is_written_again() {
    let place = Place::new("leftovers");
    for (number, rows) in [Rows::One, at(), Rows::Any].into_iter().enumerate() {
        let layout = layout(rows);
        let whole = place.path(&format!("whole-{number}.zarr"));
        let store = Store::open_or_create(&whole, &layout).unwrap();
        for chunk in 0..3 {
            store.write(chunk, &data(&layout, chunk)).unwrap();
        }
        store.completeness().unwrap();
        let expected = tree(&whole);
        for (removed, _) in expected.iter() {
            // A process writes the metadata of the group after all other metadata, and before chunks;
            // the status of a chunk after all its files.
            let chunk_file = removed.iter().any(|part| part == "c") && !removed.starts_with("at");
            let status = chunk_file.then(|| {
                let chunk = match removed.starts_with("rows") {
                    true => removed.iter().nth(1),
                    false => removed.iter().nth(2),
                };
                Path::new("status/c").join(chunk.unwrap())
            });
            if removed.starts_with("rows") && removed.iter().count() > 2 {
                continue; // a directory that appears by one rename
            }
            std::fs::remove_file(whole.join(removed)).unwrap();
            match status {
                Some(status) => drop(std::fs::remove_file(whole.join(status))),
                None => drop(std::fs::remove_file(whole.join("zarr.json"))),
            }
            let parts = whole.join("status/parts");
            std::fs::create_dir_all(&parts).unwrap();
            std::fs::write(parts.join("0123-4"), "half a f").unwrap();
            let again = Store::open_or_create(&whole, &layout).unwrap();
            for chunk in 0..3 {
                again.write(chunk, &data(&layout, chunk)).unwrap();
            }
            assert!(again.completeness().unwrap().is_complete());
            assert_eq!(tree(&whole), expected, "without {}", removed.display());
        }
    }
}

/// A file system of a few pages, in a process with mounts of its own: it fills, is given room, and the
/// store goes on.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_typed_error() {
    const DISK: &str = "HAMILTONIAN_FULL_DISK";
    let layout = layout(Rows::One);
    if let Some(disk) = std::env::var_os(DISK) {
        let disk = PathBuf::from(disk);
        std::fs::write(disk.join("ballast"), [0; 65_536]).unwrap();
        let path = disk.join("sweep.zarr");
        let store = Store::open_or_create(&path, &layout).unwrap();
        let is_full = |error: &Error| matches!(error, Error::Store(StoreError::Full { path: of, .. }) if **of == *path.display().to_string());
        let (mut chunk, mut failures) = (0, 0);
        while chunk < layout.chunks() {
            match store.write(chunk, &data(&layout, chunk)) {
                Ok(()) => chunk += 1,
                Err(error) => {
                    assert!(is_full(&error), "{error}");
                    assert!(!store.present(chunk).unwrap());
                    failures += 1;
                    std::fs::remove_file(disk.join("ballast")).unwrap();
                }
            }
        }
        assert_eq!(failures, 1);
        for chunk in 0..layout.chunks() {
            assert_same(&store.read(chunk).unwrap().unwrap(), &data(&layout, chunk));
        }
        println!("it was full");
        return;
    }
    let place = Place::new("full");
    // Metadata and two chunks fit beside the ballast; small files take a page each.
    let script = "mount -t tmpfs -o size=140k none \"$1\" && exec \"$0\" --nocapture --exact \
                  store::a_full_disk_is_a_typed_error";
    let output = std::process::Command::new("unshare")
        .args(["--map-root-user", "--mount", "sh", "-c", script])
        .arg(std::env::current_exe().unwrap())
        .arg(&place.0)
        .env(DISK, &place.0)
        .output();
    let Ok(output) = output else {
        eprintln!("SKIPPED: there is no `unshare`");
        return;
    };
    let (printed, errors) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    if !printed.contains("running 1 test") {
        eprintln!("SKIPPED: a process may not mount here: {errors}");
        return;
    }
    assert!(printed.contains("it was full"), "{printed}{errors}");
}

#[test]
fn zarr_and_xarray_open_it() {
    if !python::has(&["zarr", "xarray"]) {
        return;
    }
    let place = Place::new("python");
    let names = ["one", "at", "any"];
    for (name, rows) in names.into_iter().zip([Rows::One, at(), Rows::Any]) {
        let layout = layout(rows);
        let store = Store::open_or_create(place.path(name), &layout).unwrap();
        // Chunk 1 is missing.
        for chunk in [0, 2] {
            store.write(chunk, &data(&layout, chunk)).unwrap();
        }
    }
    let printed = python::run(
        r#"
import sys, math, numpy as np, xarray as xr, zarr
def opened(name):
    # Warnings are errors here. The root of groups of rows, which appear one by one, has no consolidated
    # metadata: xarray would warn of that.
    consolidated = False if name == "any" else None
    return xr.open_zarr(f"{sys.argv[1]}/{name}", consolidated=consolidated)
def expected(column, member, row=0):
    return math.nan if 4 <= member < 8 else math.sin(member + column) + row
for name in ["one", "at", "any"]:
    ds = opened(name)
    assert ds.attrs["hamiltonian"] == 'p^2/2 - "cos"(θ)\n', ds.attrs
    assert ds.attrs["step"] == 0.01 and ds.attrs["seed"] == 2**64 - 1
    assert ds.attrs["reproducible"] is True and ds.attrs["members"] == 10
    assert ds.status.values.tolist() == [1]*4 + [0]*4 + [1]*2
    assert ds.status.attrs["flag_meanings"] == "missing ended stopped_by_event domain solver"
    np.testing.assert_array_equal(ds.time.values, [m/8 if m//4 != 1 else math.nan for m in range(10)])
    assert ds.steps.values.tolist() == [m*1000000007 if m//4 != 1 else 0 for m in range(10)]
    assert ds.members_hash.values.tolist() == [[17, 2**64 - 1], [0, 0], [19, 2**64 - 3]]
    tree = zarr.open_group(f"{sys.argv[1]}/{name}", mode="r")
    print(name, sorted(ds.sizes.items()), sorted(tree.keys()))
one, at = opened("one"), opened("at")
for column, name in [(0.0, "theta"), (0.25, "drift[0]")]:
    np.testing.assert_allclose(one[name].values, [expected(column, m) for m in range(10)], rtol=1e-15)
    values = [[expected(column, m, row) for row in range(3)] for m in range(10)]
    np.testing.assert_allclose(at[name].values, values, rtol=1e-15)
print(float(at.theta.sel(at=2.0, member=3)) - float(one.theta[3]))
assert opened("any")["count"].values.tolist() == [0, 1, 2, 3] + [0]*4 + [0, 1]
rows = xr.concat([opened(f"any/rows/{k}") for k in [0, 2]], dim="row")
assert rows.member.values.tolist() == [1, 2, 2, 3, 3, 3, 9]
np.testing.assert_allclose(rows.theta.values,
    [expected(0, m, row) for m, row in [(1,0), (2,0), (2,1), (3,0), (3,1), (3,2), (9,0)]], rtol=1e-15)
"#,
        &[place.0.to_str().unwrap()],
    );
    assert_eq!(
        printed,
        "one [('chunk', 3), ('first_and_all', 2), ('member', 10)] \
         ['drift[0]', 'members_hash', 'status', 'steps', 'theta', 'time']\n\
         at [('at', 3), ('chunk', 3), ('first_and_all', 2), ('member', 10)] \
         ['at', 'drift[0]', 'members_hash', 'status', 'steps', 'theta', 'time']\n\
         any [('chunk', 3), ('first_and_all', 2), ('member', 10)] \
         ['count', 'members_hash', 'rows', 'status', 'steps', 'time']\n\
         2.0\n"
    );
}
