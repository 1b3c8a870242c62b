//! The golden session, as tests/bindings/write_golden.c wrote it.
use std::collections::HashMap;
use std::env;
use std::fs;
use std::path::PathBuf;

use spherecloud::{Camera, Config, Format, Frame, Image, Localizer, Map, Prior, Rig, Rigid, UpPrior};

/// A row of a CSV file: its fields by name.
pub type Row = HashMap<String, String>;

pub fn rows(text: &str) -> Vec<Row> {
    let mut lines = text.lines().map(|line| line.split(','));
    let names: Vec<&str> = lines.next().expect("a row of names").collect();
    lines
        .map(|fields| names.iter().zip(fields).map(|(name, field)| (name.to_string(), field.to_string())).collect())
        .collect()
}

pub fn number<T: std::str::FromStr>(row: &Row, name: &str) -> T
where
    T::Err: std::fmt::Debug,
{
    row[name].parse().unwrap_or_else(|why| panic!("{name} is {}: {why:?}", row[name]))
}

pub fn numbers<const N: usize>(row: &Row, names: [&str; N]) -> [f64; N] {
    names.map(|name| number(row, name))
}

pub fn folder() -> PathBuf {
    env::var_os("SPHERECLOUD_GOLDEN").expect("SPHERECLOUD_GOLDEN is the folder of the golden session").into()
}

pub fn golden(name: &str) -> Vec<u8> {
    let path = folder().join(name);
    fs::read(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

fn table(name: &str) -> Vec<Row> {
    rows(&String::from_utf8(golden(name)).unwrap())
}

pub const MAP_ID: u32 = 7;

pub fn map() -> Map<'static> {
    Map::open(folder().join("room.sphc")).unwrap()
}

fn camera(row: &Row) -> Camera {
    Camera::pinhole(number(row, "width"), number(row, "height"), numbers(row, ["fx", "fy", "cx", "cy"]))
}

pub fn rig() -> Rig {
    let cameras = table("cameras.csv");
    let x_m = table("config.csv").iter().find(|row| row["field"] == "color_from_depth_x_m").unwrap()["value"].parse();
    let color_from_depth = Rigid { t_m: [x_m.unwrap(), 0.0, 0.0], ..Rigid::IDENTITY };
    Rig::new(camera(&cameras[0]), camera(&cameras[1]), color_from_depth)
}

pub fn config() -> Config<'static> {
    let told: HashMap<String, f64> =
        table("config.csv").iter().map(|row| (row["field"].clone(), number(row, "value"))).collect();
    let mut config = Config::new(rig());
    config.max_keypoints = told["max_keypoints"] as u32;
    config.depth_sigma_m = told["depth_sigma_m"];
    assert_eq!(told["map_id"] as u32, MAP_ID);
    config
}

pub fn localizer() -> Localizer<'static> {
    localizer_of(&config())
}

pub fn localizer_of<'a>(config: &Config<'a>) -> Localizer<'a> {
    let mut localizer = Localizer::new(config).unwrap();
    localizer.set_map(MAP_ID, &map()).unwrap();
    localizer
}

/// A frame, and what C found in it.
pub struct Step {
    pub row: Row,
    pub color: Vec<u8>,
    pub depth: Vec<u16>,
}

impl Step {
    pub fn frame(&self) -> Frame<'_> {
        let color = Image::new(Format::Gray8, 320, 240, &self.color).unwrap();
        let depth = Image::from_u16(Format::Depth16, 200, 160, &self.depth).unwrap();
        let times = (number(&self.row, "color_time_ns"), number(&self.row, "depth_time_ns"));
        let mut frame = Frame::new(times.0, color, times.1, depth);
        frame.sequence = number(&self.row, "sequence");
        frame.prior = (self.row["has_up"] == "1").then(|| self.prior());
        frame
    }

    fn prior(&self) -> Prior {
        let up = [0.0, -1.0, 0.0];
        let mut prior = Prior::default();
        prior.map_id = MAP_ID;
        prior.up = Some(UpPrior { up_camera: up, up_map: up, sigma_rad: number(&self.row, "up_sigma_rad") });
        prior
    }
}

pub fn steps() -> Vec<Step> {
    let depth_of = |bytes: Vec<u8>| bytes.chunks_exact(2).map(|two| u16::from_ne_bytes([two[0], two[1]])).collect();
    let made = table("session.csv").into_iter().map(|row| Step {
        color: golden(&row["color_file"]),
        depth: depth_of(golden(&row["depth_file"])),
        row,
    });
    made.collect()
}
