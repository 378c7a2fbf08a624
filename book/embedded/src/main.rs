//! A pendulum on a processor without an operating system.
//!
//! It has what the library needs there: an allocator, and the functions that a linker wants.

#![no_std]
#![no_main]

use core::alloc::{GlobalAlloc, Layout};
use core::panic::PanicInfo;
use core::sync::atomic::{AtomicUsize, Ordering};
use hamiltonian::prelude::*;

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum { l = 1.0, g = 9.81 }
    H(theta; p) = p^2/(2*l^2) - g*l*cos(theta);
    event hanging = theta
}

fn swing() -> Result<f64, Error> {
    let start = State::new([0.5], [0.0]);
    let mut run = Integrator::new(&Pendulum::default(), BlanesMoan4, start, 1e-2)?
        .observe((EnergyDrift::new(), Events::new([Event::named("hanging")])));
    run.advance(1_000)?;
    let (energy, events) = run.observer();
    Ok(energy.max_relative() + events.count("hanging") as f64)
}

#[unsafe(no_mangle)]
extern "C" fn _start() -> ! {
    let _ = core::hint::black_box(swing());
    loop {}
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}

/// Memory that is given away once.
struct Arena {
    used: AtomicUsize,
}

const SIZE: usize = 1 << 16;
static mut MEMORY: [u64; SIZE / 8] = [0; SIZE / 8];

#[global_allocator]
static ARENA: Arena = Arena {
    used: AtomicUsize::new(0),
};

// SAFETY: each call gets bytes of its own, inside the memory, at a place with the alignment that it asks for.
unsafe impl GlobalAlloc for Arena {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let memory = &raw mut MEMORY as *mut u8;
        let align = layout.align().max(8);
        let size = layout.size() + align;
        let used = self.used.fetch_add(size, Ordering::Relaxed);
        if used + size > SIZE {
            return core::ptr::null_mut();
        }
        let place = memory.wrapping_add(used);
        place.wrapping_add(place.align_offset(align))
    }
    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}
