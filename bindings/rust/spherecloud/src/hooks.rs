//! What the library calls: a log, a clock, threads.
use core::ffi::c_void;
use core::marker::PhantomData;
use core::sync::atomic::{AtomicU32, Ordering};

use spherecloud_sys as sys;

use crate::error::text_of;
use crate::LogLevel;

#[cfg(feature = "alloc")]
use alloc::sync::Arc;

/// Takes the lines of the log, on the thread of the call that says them.
///
/// Closures do it: `|level: LogLevel, text: &str| eprintln!("{level:?}: {text}")`.
pub trait Log: Send + Sync {
    /// One line, without its end.
    fn log(&self, level: LogLevel, text: &str);
}

impl<F: Fn(LogLevel, &str) + Send + Sync> Log for F {
    fn log(&self, level: LogLevel, text: &str) {
        self(level, text)
    }
}

/// A monotonic clock, for times of stages and for deadlines. Threads of [`Parallel`] read it too.
pub trait Clock: Send + Sync {
    /// Nanoseconds since any moment.
    fn now_ns(&self) -> i64;
}

impl<F: Fn() -> i64 + Send + Sync> Clock for F {
    fn now_ns(&self) -> i64 {
        self()
    }
}

/// Threads of the caller's, on which the pieces of a frame's work run.
///
/// A frame calls it once to a few dozen times, so it should hand work to threads that wait for it.
pub trait Parallel: Send + Sync {
    /// Calls [`Tasks::work`] on as many threads as are free, and returns when they are done. What is left then runs on
    /// the calling thread, so it is no error to do nothing.
    fn run(&self, tasks: &Tasks);
}

impl<F: Fn(&Tasks) + Send + Sync> Parallel for F {
    fn run(&self, tasks: &Tasks) {
        self(tasks)
    }
}

/// Pieces of a frame's work. Each runs once, whoever takes it.
#[derive(Debug)]
pub struct Tasks {
    next: AtomicU32,
    count: u32,
    task: unsafe extern "C" fn(*mut c_void, u32),
    data: *mut c_void,
}

// SAFETY: the pieces may run at the same time on any threads; the counter gives out each once.
unsafe impl Sync for Tasks {}

impl Tasks {
    /// How many there are.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Takes pieces and runs them, until none is left.
    pub fn work(&self) {
        self.finish();
        panics::go_on();
    }

    /// The same between two calls of C, which no panic may cross.
    fn finish(&self) {
        loop {
            let index = self.next.fetch_add(1, Ordering::Relaxed);
            if index >= self.count {
                return self.next.store(self.count, Ordering::Relaxed);
            }
            // SAFETY: the index is one of the count, and is given out once.
            unsafe { (self.task)(self.data, index) };
        }
    }
}

/// A borrowed log, clock or pool, or an owned one in an `Arc`.
#[derive(Clone, Debug)]
pub struct Shared<'a, T>(Owner<'a, T>);

#[derive(Clone, Debug)]
enum Owner<'a, T> {
    Borrowed(&'a T),
    #[cfg(feature = "alloc")]
    Owned(Arc<T>),
}

impl<'a, T> From<&'a T> for Shared<'a, T> {
    fn from(borrowed: &'a T) -> Self {
        Self(Owner::Borrowed(borrowed))
    }
}

#[cfg(feature = "alloc")]
impl<T> From<Arc<T>> for Shared<'_, T> {
    fn from(owned: Arc<T>) -> Self {
        Self(Owner::Owned(owned))
    }
}

/// A function for C, with the object that it is for.
#[derive(Clone)]
pub(crate) struct Hook<'a, F> {
    pub(crate) call: F,
    user: *const c_void,
    #[cfg(feature = "alloc")]
    _owned: Option<Arc<dyn Send + Sync + 'a>>,
    _borrowed: PhantomData<&'a ()>,
}

// SAFETY: the object is Send and Sync, as the traits above want.
unsafe impl<F> Send for Hook<'_, F> {}
// SAFETY: as above.
unsafe impl<F> Sync for Hook<'_, F> {}

impl<'a, F> Hook<'a, F> {
    pub(crate) fn new<T: Send + Sync + 'a>(call: F, object: Shared<'a, T>) -> Self {
        let user: *const T = match &object.0 {
            Owner::Borrowed(borrowed) => *borrowed,
            #[cfg(feature = "alloc")]
            Owner::Owned(owned) => Arc::as_ptr(owned),
        };
        Self {
            call,
            user: user.cast(),
            #[cfg(feature = "alloc")]
            _owned: match object.0 {
                Owner::Borrowed(_) => None,
                Owner::Owned(owned) => Some(owned),
            },
            _borrowed: PhantomData,
        }
    }

    pub(crate) fn user(&self) -> *mut c_void {
        self.user as *mut c_void
    }
}

impl<F> core::fmt::Debug for Hook<'_, F> {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        to.write_str("a callback")
    }
}

pub(crate) type LogFn = unsafe extern "C" fn(*mut c_void, sys::sphc_log_level, *const sys::c_char, usize);
pub(crate) type ClockFn = unsafe extern "C" fn(*mut c_void) -> i64;
pub(crate) type ParallelFn = unsafe extern "C" fn(*mut c_void, u32, sys::sphc_task_fn, *mut c_void);

// SAFETY of the three: `user` is the T of the hook beside which the function was given to C, and lives with it.

pub(crate) unsafe extern "C" fn log<T: Log>(
    user: *mut c_void,
    level: sys::sphc_log_level,
    text: *const sys::c_char,
    _length: usize,
) {
    let log = &*(user as *const T);
    panics::guard((), || log.log(LogLevel::from_raw(level), text_of(text)));
}

pub(crate) unsafe extern "C" fn clock<T: Clock>(user: *mut c_void) -> i64 {
    let clock = &*(user as *const T);
    panics::guard(0, || clock.now_ns())
}

pub(crate) unsafe extern "C" fn parallel<T: Parallel>(
    user: *mut c_void,
    count: u32,
    task: sys::sphc_task_fn,
    data: *mut c_void,
) {
    let pool = &*(user as *const T);
    if let Some(task) = task {
        let tasks = Tasks { next: AtomicU32::new(0), count, task, data };
        panics::guard((), || pool.run(&tasks));
        tasks.finish();
    }
}

/// The clock of the standard library.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug)]
pub struct MonotonicClock(std::time::Instant);

#[cfg(feature = "std")]
impl MonotonicClock {
    /// Counts from now.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self(std::time::Instant::now())
    }
}

#[cfg(feature = "std")]
impl Clock for MonotonicClock {
    fn now_ns(&self) -> i64 {
        self.0.elapsed().as_nanos() as i64
    }
}

/// Panics wait on the thread on which they came up until the call of C is over.
#[cfg(feature = "std")]
pub(crate) mod panics {
    use std::any::Any;
    use std::cell::Cell;
    use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};

    std::thread_local! {
        static FIRST: Cell<Option<Box<dyn Any + Send>>> = Cell::new(None);
    }

    pub(crate) fn guard<R>(otherwise: R, call: impl FnOnce() -> R) -> R {
        match catch_unwind(AssertUnwindSafe(call)) {
            Ok(answer) => answer,
            Err(panic) => {
                FIRST.with(|first| first.set(Some(first.take().unwrap_or(panic))));
                otherwise
            }
        }
    }

    /// Panics with what was caught.
    pub(crate) fn go_on() {
        if let Some(panic) = FIRST.with(Cell::take) {
            resume_unwind(panic);
        }
    }
}

/// A panic ends the program, for it must not cross C.
#[cfg(not(feature = "std"))]
pub(crate) mod panics {
    struct Abort;

    impl Drop for Abort {
        fn drop(&mut self) {
            panic!("a callback of spherecloud panicked");
        }
    }

    pub(crate) fn guard<R>(_otherwise: R, call: impl FnOnce() -> R) -> R {
        let abort = Abort;
        let answer = call();
        core::mem::forget(abort);
        answer
    }

    pub(crate) fn go_on() {}
}
