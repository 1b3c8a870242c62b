//! What a frame takes of the heap: nothing.
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use crate::session::{localizer, steps};

thread_local!(static ALLOCATED: Cell<usize> = const { Cell::new(0) });

/// Counts what a thread takes of the heap.
struct Counting;

// SAFETY: the system's allocator does it.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATED.with(|count| count.set(count.get() + 1));
        System.alloc(layout)
    }
    unsafe fn dealloc(&self, data: *mut u8, layout: Layout) {
        System.dealloc(data, layout)
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn frames_take_no_memory() {
    let (mut localizer, steps) = (localizer(), steps());
    let before = ALLOCATED.with(Cell::get);
    for step in &steps {
        localizer.process(&step_frame(step)).unwrap();
        localizer.predict(0).unwrap();
    }
    assert_eq!(ALLOCATED.with(Cell::get), before);
}

/// Without looking rows up by name, which takes memory.
fn step_frame(step: &crate::session::Step) -> spherecloud::Frame<'_> {
    let color = spherecloud::Image::new(spherecloud::Format::Gray8, 320, 240, &step.color).unwrap();
    let depth = spherecloud::Image::from_u16(spherecloud::Format::Depth16, 200, 160, &step.depth).unwrap();
    spherecloud::Frame::new(0, color, 0, depth)
}
