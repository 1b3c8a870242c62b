//! Log, clock and threads of the caller's.
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use crate::session::{config, localizer_of, steps};
use spherecloud::{Cuts, Localizer, LogLevel, Outcome, Tasks};

#[test]
fn lines_of_the_log() {
    let lines = Arc::new(Mutex::new(Vec::new()));
    let kept = lines.clone();
    let log = move |level: LogLevel, text: &str| kept.lock().unwrap().push((level, text.to_string()));
    let mut localizer = localizer_of(&config().with_log(LogLevel::Debug, Arc::new(log)));
    localizer.process(&steps()[0].frame()).unwrap();
    let lines = lines.lock().unwrap();
    assert!(lines.iter().any(|(level, text)| *level == LogLevel::Debug && !text.is_empty()), "{lines:?}");
}

#[test]
fn a_clock_that_is_borrowed() {
    let time_ns = AtomicI64::new(0);
    let clock = || time_ns.fetch_add(1_000_000, Ordering::Relaxed);
    let mut localizer = localizer_of(&config().with_clock(&clock));
    let found = localizer.process(&steps()[0].frame()).unwrap();
    assert!(time_ns.load(Ordering::Relaxed) > 0);
    assert_eq!(found.times.features_us % 1000, 0);
}

#[test]
fn a_deadline_cuts() {
    let (mut localizer, steps) = (localizer_of(&config()), steps());
    let mut frame = steps[0].frame();
    frame.deadline = Some(Duration::from_micros(1));
    let found = localizer.process(&frame).unwrap();
    assert_ne!(found.cuts, Cuts::default());
    assert_eq!((found.outcome, found.pose), (Outcome::Deadline, None));
    frame = steps[1].frame();
    frame.deadline = Some(Duration::from_secs(1_000_000));
    assert_eq!(localizer.process(&frame).unwrap().cuts, Cuts::default());
}

fn poses(config: &spherecloud::Config<'_>) -> Vec<Option<spherecloud::Pose>> {
    let mut localizer = localizer_of(config);
    steps().iter().map(|step| localizer.process(&step.frame()).unwrap().pose).collect()
}

#[test]
fn threads_find_the_same() {
    let (calls, pieces) = (AtomicU32::new(0), AtomicU32::new(0));
    let pool = |tasks: &Tasks| {
        calls.fetch_add(1, Ordering::Relaxed);
        pieces.fetch_add(tasks.count(), Ordering::Relaxed);
        thread::scope(|scope| {
            scope.spawn(|| tasks.work());
            tasks.work();
        });
    };
    let idle = |_: &Tasks| ();
    let alone = poses(&config());
    assert_eq!(poses(&config().with_parallel(3, &pool)), alone);
    assert_eq!(poses(&config().with_parallel(3, &idle)), alone, "what is left runs on the calling thread");
    let (calls, pieces) = (calls.into_inner(), pieces.into_inner());
    assert!(calls > 0 && pieces > calls);
}

fn panic_of(localizer: &mut Localizer<'_>) -> &'static str {
    let step = &steps()[0];
    let panic = catch_unwind(AssertUnwindSafe(|| localizer.process(&step.frame()))).unwrap_err();
    panic.downcast_ref::<&str>().unwrap()
}

#[test]
fn panics_go_on_behind_the_call() {
    let is_armed = AtomicBool::new(false);
    let log = |_: LogLevel, _: &str| assert!(!is_armed.load(Ordering::Relaxed), "of the log");
    let mut localizer = localizer_of(&config().with_log(LogLevel::Debug, &log));
    is_armed.store(true, Ordering::Relaxed);
    assert_eq!(panic_of(&mut localizer), "of the log");
    is_armed.store(false, Ordering::Relaxed);
    assert!(localizer.process(&steps()[1].frame()).unwrap().pose.is_some(), "it goes on");

    let pool = |_: &Tasks| panic!("of the pool");
    assert_eq!(panic_of(&mut localizer_of(&config().with_parallel(2, &pool))), "of the pool");
    let clock = || -> i64 { panic!("of the clock") };
    assert_eq!(panic_of(&mut localizer_of(&config().with_clock(&clock))), "of the clock");
}

#[test]
fn callbacks_live_as_long_as_the_localizer() {
    struct Counted(Arc<AtomicU32>);
    impl Drop for Counted {
        fn drop(&mut self) {
            self.0.fetch_add(1, Ordering::Relaxed);
        }
    }
    impl spherecloud::Clock for Counted {
        fn now_ns(&self) -> i64 {
            1
        }
    }
    let dropped = Arc::new(AtomicU32::new(0));
    let config = config().with_clock(Arc::new(Counted(dropped.clone())));
    let localizer = localizer_of(&config);
    drop(config);
    assert_eq!(dropped.load(Ordering::Relaxed), 0);
    drop(localizer);
    assert_eq!(dropped.load(Ordering::Relaxed), 1);
}
