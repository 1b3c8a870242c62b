//! What this crate costs a frame: the same frames through it and through the C interface, in turns.
//!
//!     cargo run --release --example overhead -- FOLDER [ROUNDS]
//!
//! FOLDER has the golden session. Both localizers see each frame, the one and then the other first; of each, medians of
//! all frames are compared. The C interface is called as a C program calls it: on structs that are made beforehand,
//! without a clock. The crate's side makes images, frame and result each time, and has its default clock.
use spherecloud::{Camera, Config, Format, Frame, Image, Localizer, Map, Rig, Rigid};
use spherecloud_sys as sys;
use std::alloc::{alloc_zeroed, Layout};
use std::time::{Duration, Instant};
use std::{env, error::Error, fs, mem, path::Path, ptr};

const FRAMES: usize = 10;

fn config() -> Config<'static> {
    let color = Camera::pinhole(320, 240, [250.0, 250.0, 160.0, 120.0]);
    let depth = Camera::pinhole(200, 160, [140.0, 140.0, 100.0, 80.0]);
    let mut config = Config::new(Rig::new(color, depth, Rigid { t_m: [0.04, 0.0, 0.0], ..Rigid::IDENTITY }));
    config.max_keypoints = 400;
    config.depth_sigma_m = 0.002;
    config
}

fn raw_camera(width: u32, height: u32, focal_px: f64) -> sys::sphc_camera {
    let mut params = [0.0; 12];
    params[..4].copy_from_slice(&[focal_px, focal_px, width as f64 / 2.0, height as f64 / 2.0]);
    sys::sphc_camera { model: sys::SPHC_CAMERA_PINHOLE, width, height, param_count: 4, params }
}

fn room(bytes: u64) -> *mut core::ffi::c_void {
    // SAFETY: the size is not 0.
    unsafe { alloc_zeroed(Layout::from_size_align(bytes as usize, 64).unwrap()).cast() }
}

/// A localizer of C, which lives as long as the program.
unsafe fn raw_localizer(file: &[u8]) -> *mut sys::sphc_localizer {
    let (mut config, mut need): (sys::sphc_localizer_config, sys::sphc_memory) = mem::zeroed();
    sys::sphc_localizer_config_init(&mut config, mem::size_of_val(&config));
    config.rig.color_camera = raw_camera(320, 240, 250.0);
    config.rig.depth_camera = raw_camera(200, 160, 140.0);
    config.rig.color_from_depth.t_m[0] = 0.04;
    config.max_keypoints = 400;
    config.depth_sigma_m = 0.002;
    let (mut map, mut made, copy) = (ptr::null_mut(), ptr::null_mut(), room(file.len() as u64));
    ptr::copy_nonoverlapping(file.as_ptr(), copy.cast(), file.len());
    assert_eq!(sys::sphc_map_init(room(256), 256, copy, file.len(), &mut map, ptr::null_mut()), 0);
    assert_eq!(sys::sphc_localizer_memory(&config, &mut need, ptr::null_mut()), 0);
    let (state, scratch) = (need.state_bytes, need.scratch_bytes);
    let (state_bytes, scratch_bytes) = (state as usize, scratch as usize);
    let no_message = ptr::null_mut();
    sys::sphc_localizer_init(room(state), state_bytes, room(scratch), scratch_bytes, &config, &mut made, no_message);
    assert_eq!(sys::sphc_localizer_set_map(made, 0, map), 0);
    made
}

fn raw_frame(time_ns: i64, color: &[u8], depth: &[u8]) -> sys::sphc_localizer_frame {
    let image = |data: &[u8], width, height, stride_bytes, format| sys::sphc_image {
        data: data.as_ptr().cast(),
        width,
        height,
        stride_bytes,
        format,
    };
    // SAFETY: all zero is a value of it.
    let mut frame: sys::sphc_localizer_frame = unsafe { mem::zeroed() };
    frame.struct_size = mem::size_of_val(&frame) as u32;
    (frame.color_time_ns, frame.depth_time_ns) = (time_ns, time_ns);
    frame.color = image(color, 320, 240, 320, sys::SPHC_FORMAT_GRAY8);
    frame.depth = image(depth, 200, 160, 400, sys::SPHC_FORMAT_DEPTH16);
    frame
}

fn timed<R>(times: &mut Vec<Duration>, call: impl FnOnce() -> R) -> R {
    let begin = Instant::now();
    let answer = call();
    times.push(begin.elapsed());
    answer
}

/// Colour and depth, byte for byte.
type Images = (Vec<u8>, Vec<u8>);

fn images(folder: &Path) -> std::io::Result<Vec<Images>> {
    let read = |i| {
        let color = fs::read(folder.join(format!("color_{i:02}.gray8")))?;
        Ok((color, fs::read(folder.join(format!("depth_{i:02}.depth16")))?))
    };
    (0..FRAMES).map(read).collect()
}

fn median<T: Copy + PartialOrd>(mut of: Vec<T>) -> T {
    of.sort_by(|a, b| a.partial_cmp(b).unwrap());
    of[of.len() / 2]
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args().nth(1).ok_or("which folder has the session?")?;
    let rounds: usize = env::args().nth(2).map_or(Ok(100), |text| text.parse())?;
    let (images, file) = (images(folder.as_ref())?, fs::read(Path::new(&folder).join("room.sphc"))?);
    let mut localizer = Localizer::new(&config())?;
    localizer.set_map(0, &Map::from_bytes(&file)?)?;
    // SAFETY: as in C.
    let raw = unsafe { raw_localizer(&file) };
    let mut result: sys::sphc_localizer_result = unsafe { mem::zeroed() };
    result.struct_size = mem::size_of_val(&result) as u32;

    let (mut of_c, mut of_rust) = (vec![], vec![]);
    for round in 0..rounds {
        for (i, (color, depth)) in images.iter().enumerate() {
            let time_ns = (round * 100 + i) as i64 * 33_000_000;
            let frame = raw_frame(time_ns, color, depth);
            let mut c = || timed(&mut of_c, || unsafe { sys::sphc_localizer_process(raw, &frame, &mut result) });
            let mut rust = || {
                timed(&mut of_rust, || {
                    let color = Image::new(Format::Gray8, 320, 240, color)?;
                    let depth = Image::new(Format::Depth16, 200, 160, depth)?;
                    localizer.process(&Frame::new(time_ns, color, time_ns, depth))
                })
            };
            let (status, found) = if (round + i) % 2 == 0 {
                (c(), rust())
            } else {
                let found = rust();
                (c(), found)
            };
            let pose = found?.pose.map(|pose| pose.camera_from_map.t_m);
            assert_eq!(pose, (status == 0).then_some(result.camera_from_map.t_m), "both find the same");
        }
    }
    let frames = of_c.len();
    let more_us = of_rust.iter().zip(&of_c).map(|(rust, c)| (rust.as_secs_f64() - c.as_secs_f64()) * 1e6).collect();
    let (c, rust) = (median(of_c), median(of_rust));
    println!("{frames} frames each, medians: C {c:?}, Rust {rust:?}");
    println!("ratio {:.4}", rust.as_secs_f64() / c.as_secs_f64());
    println!("difference within a frame, median: {:.1} us", median::<f64>(more_us));
    Ok(())
}
