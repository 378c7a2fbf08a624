//! A process that writes chunks is killed a hundred times, and always goes on.

use super::*;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const PLACE: &str = "HAMILTONIAN_KILLED_STORE";

fn large(rows: Rows) -> Layout {
    Layout {
        members: 120,
        chunk: 1,
        ..layout(rows)
    }
}

/// Writes what is missing, the chunks of half k of 2.
fn go_on(path: &Path, half: u64, rows: Rows) {
    let layout = large(rows);
    let store = Store::open_or_create(path, &layout).unwrap();
    for chunk in (half..layout.chunks()).step_by(2) {
        if !store.present(chunk).unwrap() {
            store.write(chunk, &data(&layout, chunk)).unwrap();
        }
    }
}

/// The process that is killed.
#[test]
fn writes_a_store_that_is_named() {
    let Ok(path) = std::env::var(PLACE) else {
        return;
    };
    std::thread::scope(|scope| {
        for half in [0, 1] {
            let path = Path::new(&path);
            scope.spawn(move || go_on(path, half, rows_of(path)));
        }
    });
}

fn rows_of(path: &Path) -> Rows {
    match path.to_string_lossy().contains("any") {
        true => Rows::Any,
        false => Rows::One,
    }
}

#[test]
fn a_hundred_kills_lose_and_double_nothing() {
    let place = Place::new("kills");
    for name in ["one", "any"] {
        let path = place.path(name);
        let layout = large(rows_of(&path));
        let calm = place.path(&format!("calm-{name}"));
        go_on(&calm, 0, rows_of(&path));
        go_on(&calm, 1, rows_of(&path));
        assert!(
            Store::open_or_create(&calm, &layout)
                .unwrap()
                .completeness()
                .unwrap()
                .is_complete()
        );
        let calm = tree(&calm);
        let present = || {
            let chunks = std::fs::read_dir(path.join("status/c"));
            chunks.map_or(0, Iterator::count)
        };
        let (mut killed, mut in_creation) = (0_u64, 0);
        while killed < 50 {
            if present() as u64 == layout.chunks() {
                // It was faster than the kills: once more from the beginning.
                std::fs::remove_dir_all(&path).unwrap();
            }
            let before = present();
            let mut child = Command::new(std::env::current_exe().unwrap())
                .args(["--exact", "store::kills::writes_a_store_that_is_named"])
                .env(PLACE, &path)
                .stdout(Stdio::null())
                .spawn()
                .unwrap();
            // At different places in the creation of the store, then in chunks.
            let appears = |name: &str| path.join(name).exists();
            let begun = Instant::now();
            while child.try_wait().unwrap().is_none() && begun.elapsed() < Duration::from_secs(60) {
                let due = match killed {
                    0 => appears(""),
                    1 => appears("status/parts"),
                    2 => appears("time/zarr.json"),
                    3 => appears("status/zarr.json"),
                    4 => appears("zarr.json"),
                    _ => present() > before,
                };
                if due {
                    break;
                }
            }
            // Not always at the moment when a file has appeared.
            std::thread::sleep(Duration::from_micros(killed * 37));
            child.kill().unwrap();
            child.wait().unwrap();
            killed += 1;
            in_creation += u32::from(!appears("zarr.json"));
            // What counts as present is whole.
            if appears("zarr.json") {
                let store = Store::open_or_create(&path, &layout).unwrap();
                for chunk in 0..layout.chunks() {
                    if let Some(read) = store.read(chunk).unwrap() {
                        assert_same(&read, &data(&layout, chunk));
                    }
                }
            }
        }
        eprintln!("{name}: 50 kills, {in_creation} of them before there was a store");
        go_on(&path, 0, rows_of(&path));
        go_on(&path, 1, rows_of(&path));
        let store = Store::open_or_create(&path, &layout).unwrap();
        assert!(store.completeness().unwrap().is_complete());
        assert!(tree(&path) == calm, "another store after {killed} kills");
    }
}
