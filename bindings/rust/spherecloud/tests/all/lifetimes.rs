//! Order of dropping, threads, and what may cross them.
use std::sync::Arc;
use std::thread;

use crate::session::{config, golden, localizer, localizer_of, map, steps, MAP_ID};
use spherecloud::{Aligner, Config, Error, Extractor, Features, Image, Localizer, Locator, Map, Outcome};

fn send<T: Send>() {}
fn sync<T: Sync>() {}

#[test]
fn thread_classes() {
    send::<Map<'static>>();
    sync::<Map<'static>>();
    send::<Features<'static>>();
    sync::<Features<'static>>();
    send::<Localizer<'static>>();
    send::<Aligner<'static>>();
    send::<Extractor<'static>>();
    send::<Locator<'static, 'static>>();
    send::<Config<'static>>();
    sync::<Config<'static>>();
    send::<Image<'static>>();
    sync::<Image<'static>>();
    send::<Error>();
}

/// Whether a type is Sync, asked where the answer may be no.
macro_rules! is_sync {
    ($type:ty) => {{
        #[allow(dead_code)]
        trait Otherwise {
            const IS_SYNC: bool = false;
        }
        struct Asked<T>(std::marker::PhantomData<T>);
        impl<T> Otherwise for Asked<T> {}
        #[allow(dead_code)]
        impl<T: Sync> Asked<T> {
            const IS_SYNC: bool = true;
        }
        <Asked<$type>>::IS_SYNC
    }};
}

#[test]
fn what_is_exclusive_is_not_sync() {
    assert!(is_sync!(Map<'static>));
    assert!(!is_sync!(Localizer<'static>));
    assert!(!is_sync!(Aligner<'static>));
    assert!(!is_sync!(Extractor<'static>));
    assert!(!is_sync!(Locator<'static, 'static>));
}

#[test]
fn a_map_lives_as_long_as_a_localizer_has_it() {
    let (mut localizer, steps) = (Localizer::new(&config()).unwrap(), steps());
    let map = map();
    localizer.set_map(MAP_ID, &map).unwrap();
    drop(map);
    assert_eq!(localizer.process(&steps[0].frame()).unwrap().outcome, Outcome::Localized);
    localizer.set_map(MAP_ID, &Map::from_bytes(&golden("room.sphc")).unwrap()).unwrap();
    assert_eq!(localizer.process(&steps[1].frame()).unwrap().outcome, Outcome::Localized);
    localizer.remove_map(MAP_ID).unwrap();
    assert_eq!(localizer.process(&steps[2].frame()).unwrap().pose, None);
}

#[test]
fn maps_come_and_go() {
    let mut config = config();
    config.max_maps = 3;
    let (mut localizer, step) = (Localizer::new(&config).unwrap(), &steps()[0]);
    for id in [1, 2, 1, 3, 1, 2] {
        localizer.set_map(id, &map()).unwrap();
    }
    assert!(localizer.set_map(4, &map()).is_err());
    for left in [3, 2, 1] {
        localizer.reset();
        let found = localizer.process(&step.frame()).unwrap();
        assert!(found.keypoints > 0 && localizer.map_count() == left);
        localizer.remove_map(left).unwrap();
    }
    assert_eq!(localizer.map_count(), 0);
}

#[test]
fn a_view_ends_with_its_last_handle() {
    let first = map();
    let (second, info) = (first.clone(), first.info());
    drop(first);
    assert_eq!(second.info(), info);
    let direction = second.direction(0).unwrap();
    assert!((direction.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-6);
    assert_eq!(second.direction(info.point_count), None);
}

#[test]
fn a_moved_localizer_goes_on() {
    let steps = steps();
    let mut localizer = localizer();
    localizer.process(&steps[0].frame()).unwrap();
    let boxed = Box::new(localizer);
    let state = thread::spawn(move || {
        let mut moved = *boxed;
        moved.process(&steps[1].frame()).unwrap().state
    });
    assert_eq!(state.join().unwrap(), spherecloud::State::Tracking);
}

#[test]
fn localizers_in_threads_share_a_map() {
    let (map, steps, config) = (map(), Arc::new(steps()), config());
    let run = || {
        let mut localizer = Localizer::new(&config).unwrap();
        localizer.set_map(MAP_ID, &map).unwrap();
        let poses = steps.iter().map(|step| localizer.process(&step.frame()).unwrap().pose);
        poses.collect::<Vec<_>>()
    };
    let alone = run();
    thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(run)).collect();
        threads.into_iter().for_each(|thread| assert_eq!(thread.join().unwrap(), alone));
    });
}

#[test]
fn one_thread_extracts_while_another_locates() {
    let steps = steps();
    let mut alone = localizer();
    let expected: Vec<_> = steps.iter().map(|step| alone.process(&step.frame()).unwrap().pose).collect();

    let mut localizer = localizer_of(&config());
    let mut two = [Features::new(&config()).unwrap(), Features::new(&config()).unwrap()];
    localizer.split().0.extract(&steps[0].frame(), &mut two[0]).unwrap();
    for (i, step) in steps.iter().enumerate() {
        let [first, second] = &mut two;
        let (filled, free) = if i % 2 == 0 { (first, second) } else { (second, first) };
        let (mut extractor, mut locator) = localizer.split();
        thread::scope(|scope| {
            if let Some(next) = steps.get(i + 1) {
                scope.spawn(move || extractor.extract(&next.frame(), free).unwrap());
            }
            assert_eq!(locator.locate(&step.frame(), filled).unwrap().pose, expected[i]);
        });
    }
}

#[test]
fn a_map_borrows_its_bytes() {
    let file = golden("room.sphc");
    let words: Vec<u64> = file
        .chunks(8)
        .map(|eight| {
            let mut whole = [0; 8];
            whole[..eight.len()].copy_from_slice(eight);
            u64::from_ne_bytes(whole)
        })
        .collect();
    // SAFETY: the same bytes, aligned to 8.
    let aligned = unsafe { std::slice::from_raw_parts(words.as_ptr().cast::<u8>(), file.len()) };
    let map = Map::borrow(aligned).unwrap();
    let mut localizer = Localizer::new(&config()).unwrap();
    localizer.set_map(MAP_ID, &map).unwrap();
    drop(map);
    assert_eq!(localizer.process(&steps()[0].frame()).unwrap().outcome, Outcome::Localized);
}
