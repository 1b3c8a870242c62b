//! From a map and a frame to a pose: plays a session that lies in a folder as bare images.
//!
//!     cargo run --example first_pose -- FOLDER
use spherecloud::{Camera, Config, Format, Frame, Image, Localizer, Map, Rig, Rigid};
use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env::args().nth(1).ok_or("which folder has the session?")?);
    let color_camera = Camera::pinhole(320, 240, [250.0, 250.0, 160.0, 120.0]);
    let depth_camera = Camera::pinhole(200, 160, [140.0, 140.0, 100.0, 80.0]);
    let color_from_depth = Rigid { t_m: [0.04, 0.0, 0.0], ..Rigid::IDENTITY };
    let mut localizer = Localizer::new(&Config::new(Rig::new(color_camera, depth_camera, color_from_depth)))?;
    localizer.set_map(0, &Map::open(folder.join("room.sphc"))?)?;
    for i in 0..10 {
        let color = fs::read(folder.join(format!("color_{i:02}.gray8")))?;
        let depth = fs::read(folder.join(format!("depth_{i:02}.depth16")))?;
        let color = Image::new(Format::Gray8, 320, 240, &color)?;
        let depth = Image::new(Format::Depth16, 200, 160, &depth)?;
        let time_ns = 33_000_000 * i;
        let found = localizer.process(&Frame::new(time_ns, color, time_ns, depth))?;
        match found.pose {
            Some(pose) => println!("frame {i}: {:?}, {:.3} sure", pose.camera_from_map.t_m, pose.confidence),
            None => println!("frame {i}: {:?}, {:?}", found.outcome, found.hints),
        }
    }
    Ok(())
}
