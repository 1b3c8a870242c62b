//! Memory of the caller's, and how much.
use std::mem::MaybeUninit;

use crate::session::{config, golden, number, steps, MAP_ID};
use spherecloud::{bounds, Block, Features, Localizer, Map, Status, MAP_BYTES_MAX};

/// So many bytes of the heap, aligned to 64.
fn aligned(room: &mut Vec<MaybeUninit<u8>>, bytes: usize) -> &mut [MaybeUninit<u8>] {
    room.resize(bytes + 64, MaybeUninit::uninit());
    let from = room.as_ptr().align_offset(64);
    &mut room[from..from + bytes]
}

#[test]
fn all_memory_is_the_callers() {
    let (config, step) = (config(), &steps()[0]);
    let (mut file, mut state, mut scratch, mut room) = (vec![], vec![], vec![], vec![]);
    let file = aligned(&mut file, golden("room.sphc").len());
    file.iter_mut().zip(golden("room.sphc")).for_each(|(to, from)| *to = MaybeUninit::new(from));
    // SAFETY: all of it was written.
    let file = unsafe { std::slice::from_raw_parts(file.as_ptr().cast(), file.len()) };
    let mut view = Block::<MAP_BYTES_MAX>::new();
    let need = config.localizer_memory().unwrap();
    let (state, scratch) = (aligned(&mut state, need.state_bytes), aligned(&mut scratch, need.scratch_bytes));
    assert!(need.alignment <= std::mem::align_of_val(&view));

    let map = Map::borrow_in(view.bytes(), file).unwrap();
    let mut localizer = Localizer::new_in(&config, state, scratch).unwrap();
    localizer.set_map(MAP_ID, &map).unwrap();
    let found = localizer.process(&step.frame()).unwrap();
    assert_eq!(found.inliers, number::<u32>(&step.row, "inliers"));
    let room = aligned(&mut room, config.features_memory().unwrap().state_bytes);
    let mut features = Features::new_in(&config, room).unwrap();
    localizer.split().0.extract(&step.frame(), &mut features).unwrap();
    assert_eq!(features.get().unwrap().keypoints.len(), found.keypoints as usize);
}

#[test]
fn too_little_memory_is_refused() {
    let config = config();
    let need = config.localizer_memory().unwrap();
    let (mut state, mut scratch) = (vec![], vec![]);
    let (state, scratch) = (aligned(&mut state, need.state_bytes), aligned(&mut scratch, need.scratch_bytes));
    let refused = Localizer::new_in(&config, &mut state[1..], scratch);
    assert!([Status::MemorySize, Status::MemoryAlignment].contains(&refused.unwrap_err().status()));
    let last = need.state_bytes - 1;
    let refused = Localizer::new_in(&config, &mut state[..last], scratch);
    assert_eq!(refused.unwrap_err().status(), Status::MemorySize);
    let mut little = Block::<8>::new();
    assert_eq!(Map::borrow_in(little.bytes(), &[]).unwrap_err().status(), Status::MemorySize);
    assert_eq!(Features::new_in(&config, little.bytes()).unwrap_err().status(), Status::MemorySize);
}

#[test]
fn bounds_hold() {
    let mut config = config();
    let need = config.localizer_memory().unwrap();
    assert!(need.state_bytes <= bounds::localizer_state(400, config.max_maps as usize));
    assert!(need.scratch_bytes <= bounds::localizer_scratch(400, 320, 240));
    assert!(config.features_memory().unwrap().state_bytes <= bounds::features(400, 320, 240));

    let aligner = spherecloud::AlignerConfig::new(config.rig).memory().unwrap();
    assert!(aligner.state_bytes <= bounds::aligner(200, 160, 320, 240));

    let alone = (need.state_bytes, need.scratch_bytes);
    let second = spherecloud::RigDepthCamera::new(config.rig.depth_camera, config.rig.color_from_depth);
    let both = config.clone().with_depth_camera(second).localizer_memory().unwrap();
    assert!(both.state_bytes + both.scratch_bytes > alone.0 + alone.1);
    assert!(both.state_bytes <= alone.0 + bounds::localizer_depth_camera(200, 160));
    assert!(both.scratch_bytes <= alone.1 + bounds::localizer_depth_camera(200, 160));
    config.depth_format = spherecloud::Format::Range16;
    let need = config.localizer_memory().unwrap();
    assert!(need.state_bytes + need.scratch_bytes > alone.0 + alone.1);
    assert!(need.state_bytes <= alone.0 + bounds::localizer_depth(200, 160));
    assert!(need.scratch_bytes <= alone.1 + bounds::localizer_depth(200, 160));
}

#[test]
fn the_account_of_the_memory() {
    let config = config();
    let need = config.localizer_memory().unwrap();
    let pieces: Vec<_> = (0..).map_while(|index| config.memory_piece(index).unwrap()).collect();
    let bytes =
        |of_scratch| pieces.iter().filter(|piece| piece.is_scratch == of_scratch).map(|piece| piece.bytes).sum::<u64>();
    assert!(pieces.iter().all(|piece| !piece.name.is_empty()));
    assert!(bytes(false) > 0 && bytes(false) <= need.state_bytes as u64);
    assert!(bytes(true) > need.scratch_bytes as u64 / 4);
}
