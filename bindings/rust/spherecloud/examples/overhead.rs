//! What `bindings/overhead/overhead.c` does, through this crate: a line in, a line with processor times out.
//!
//!     cargo run --release --example overhead -- FOLDER
use spherecloud::{Camera, Config, Format, Frame, Image, Localizer, Map, Rig, Rigid};
use std::{env, error::Error, fs, io::BufRead, path::Path};

const FRAMES: usize = 10;
const PREDICTIONS: i64 = 1000;
const THREAD_CPU_TIME: i32 = 3;

extern "C" {
    fn clock_gettime(clock: i32, now: *mut [i64; 2]) -> i32;
}

/// Of this thread alone, in nanoseconds.
fn used_ns() -> i64 {
    let mut now = [0; 2];
    // SAFETY: on 64-bit Linux a timespec is two of these.
    unsafe { clock_gettime(THREAD_CPU_TIME, &mut now) };
    now[0] * 1_000_000_000 + now[1]
}

fn config() -> Config<'static> {
    let color = Camera::pinhole(320, 240, [250.0, 250.0, 160.0, 120.0]);
    let depth = Camera::pinhole(200, 160, [140.0, 140.0, 100.0, 80.0]);
    Config::new(Rig::new(color, depth, Rigid { t_m: [0.04, 0.0, 0.0], ..Rigid::IDENTITY }))
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

fn play(localizer: &mut Localizer, images: &[Images]) -> Result<Vec<String>, Box<dyn Error>> {
    let (mut times, mut time_ns) = (vec![], 0);
    localizer.reset();
    for (i, (color, depth)) in images.iter().enumerate() {
        let before = used_ns();
        time_ns = 1_000_000_000 + 33_000_000 * i as i64;
        let color = Image::new(Format::Gray8, 320, 240, color)?;
        let depth = Image::new(Format::Depth16, 200, 160, depth)?;
        localizer.process(&Frame::new(time_ns, color, time_ns, depth))?;
        times.push((used_ns() - before).to_string());
    }
    let before = used_ns();
    for i in 0..PREDICTIONS {
        localizer.predict(time_ns + i)?;
    }
    times.push(((used_ns() - before) / PREDICTIONS).to_string());
    Ok(times)
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = env::args().nth(1).ok_or("which folder has the session?")?;
    let images = images(folder.as_ref())?;
    let mut localizer = Localizer::new(&config())?;
    localizer.set_map(0, &Map::open(Path::new(&folder).join("room.sphc"))?)?;
    for line in std::io::stdin().lock().lines() {
        line?;
        println!("{}", play(&mut localizer, &images)?.join(" "));
    }
    Ok(())
}
