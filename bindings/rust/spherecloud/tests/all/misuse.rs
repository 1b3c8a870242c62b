//! What is wrong is an error that says what, and never a crash.
use crate::session::{config, golden, localizer, map, rig, steps, MAP_ID};
use spherecloud::{
    Camera, Config, Error, Features, Format, Frame, Image, Localizer, Map, Outcome, Parameter, RigCamera,
    RigDepthCamera, Rigid, Status, View,
};

fn refused<T: std::fmt::Debug>(answer: Result<T, Error>, status: Status, word: &str) {
    let error = answer.unwrap_err();
    assert_eq!(error.status(), status, "{error}");
    assert!(error.message().contains(word), "{error}");
    assert!(error.to_string().ends_with(&format!("[{}]", status.name())), "{error}");
}

#[test]
fn files_that_are_not_there_say_why() {
    use std::error::Error as _;
    let error = Map::open("/nowhere/room.sphc").unwrap_err();
    let source = error.source().expect("a source").downcast_ref::<std::io::Error>().expect("of the file");
    assert_eq!(source.kind(), std::io::ErrorKind::NotFound);
    assert_eq!(error, error.clone());
    assert!(error.clone().source().is_some());
    assert!(Map::from_bytes(&[]).unwrap_err().source().is_none());
}

#[test]
fn maps_that_are_none() {
    let file = golden("room.sphc");
    refused(Map::from_bytes(&file[..file.len() / 2]), Status::MapFormat, "");
    refused(Map::from_bytes(&[]), Status::MapFormat, "");
    refused(Map::from_bytes(&[0; 4096]), Status::MapFormat, "");
    let mut flipped = file.clone();
    flipped[file.len() / 2] ^= 1;
    refused(Map::from_bytes(&flipped), Status::MapChecksum, "");
    refused(Map::open("/nowhere/room.sphc"), Status::Device, "/nowhere/room.sphc");
    refused(Map::open("/"), Status::Device, "/");
    let shifted = [&[0], &file[..]].concat();
    let odd = if shifted.as_ptr() as usize % 8 == 7 { &shifted[2..] } else { &shifted[1..] };
    refused(Map::borrow(odd), Status::MemoryAlignment, "8");
}

#[test]
fn configs_that_are_none() {
    let mut made = config();
    made.rig.color_from_depth.t_m[0] = f64::NAN;
    refused(Localizer::new(&made), Status::Argument, "color_from_depth");
    refused(made.rig.check(), Status::Argument, "color_from_depth");
    let mut made = config();
    made.max_keypoints = 0;
    refused(Localizer::new(&made), Status::Argument, "max_keypoints");
    refused(Features::new(&made), Status::Argument, "max_keypoints");
    assert_eq!(made.memory_piece(0).unwrap_err().status(), Status::Argument);
    refused(Camera::pinhole(0, 0, [0.0; 4]).check(), Status::Argument, "width");
    let eight =
        (0..8).fold(config(), |config, _| config.with_camera(RigCamera::new(rig().color_camera, Rigid::IDENTITY)));
    refused(Localizer::new(&eight), Status::Argument, "8 further cameras");
    let second = RigDepthCamera::new(rig().depth_camera, Rigid::IDENTITY);
    let three = config().with_depth_camera(second).with_depth_camera(second);
    refused(Localizer::new(&three), Status::Argument, "2 further depth cameras");
}

#[test]
fn images_that_do_not_fit() {
    let bytes = [0; 320 * 240];
    refused(Image::new(Format::Gray8, 320, 241, &bytes), Status::Image, "76800");
    refused(Image::new(Format::Gray8, 320, 240, &bytes[1..]), Status::Image, "76799");
    refused(Image::new(Format::Gray8, 320, 0, &bytes), Status::Image, "x 0");
    refused(Image::with_stride(Format::Gray8, 320, 240, 319, &bytes), Status::Image, "319");
    refused(Image::with_stride(Format::Gray8, 320, 240, u32::MAX, &bytes), Status::Image, "76800");
    refused(Image::new(Format::Unknown(99), 320, 240, &bytes), Status::Image, "SPHC_FORMAT_?");
    refused(Image::new(Format::Gray10p, 3, 3, &bytes), Status::Image, "rows of 3 pixels");
    refused(Image::from_u16(Format::Gray8, 2, 2, &[0; 4]), Status::Image, "2 bytes");
    // The last row may end with its last pixel.
    refused(Image::with_stride(Format::Gray8, 300, 240, 320, &bytes[..320 * 239 + 299]), Status::Image, "76779");
    assert!(Image::with_stride(Format::Gray8, 300, 240, 320, &bytes[..320 * 239 + 300]).is_ok());

    let (step, mut localizer) = (&steps()[0], localizer());
    let mut frame = step.frame();
    frame.color = Some(Image::new(Format::Gray8, 240, 320, &step.color).unwrap());
    refused(localizer.process(&frame), Status::Image, "color");
    frame.color = None;
    refused(localizer.process(&frame), Status::Image, "color");
    let mut frame = step.frame();
    frame.depth = Some(Image::new(Format::Gray8, 200, 160, &step.color).unwrap());
    refused(localizer.process(&frame), Status::Image, "depth");
    assert_eq!(localizer.process(&step.frame()).unwrap().outcome, Outcome::Localized, "it goes on");
}

#[test]
fn images_at_a_stride_and_at_odd_addresses() {
    let (step, mut localizer) = (&steps()[0], localizer());
    let wide: Vec<u8> = step.color.chunks(320).flat_map(|row| [row, &[255; 13]].concat()).collect();
    let mut frame = step.frame();
    frame.color = Some(Image::with_stride(Format::Gray8, 320, 240, 333, &wide).unwrap());
    let found = localizer.process(&frame).unwrap();
    assert_eq!(found.inliers, crate::session::number::<u32>(&step.row, "inliers"));

    let bytes: Vec<u8> = [0].into_iter().chain(step.depth.iter().flat_map(|depth| depth.to_ne_bytes())).collect();
    let odd = if bytes.as_ptr() as usize % 2 == 1 { &bytes[..200 * 160 * 2] } else { &bytes[1..] };
    frame.depth = Some(Image::new(Format::Depth16, 200, 160, odd).unwrap());
    if let Err(error) = localizer.process(&frame) {
        assert_eq!(error.status(), Status::Image);
    }
}

#[test]
fn priors_views_and_arrays() {
    let (step, mut localizer) = (&steps()[8], localizer());
    let mut frame = step.frame();
    frame.prior.as_mut().unwrap().up.as_mut().unwrap().sigma_rad = f64::NAN;
    refused(localizer.process(&frame), Status::Argument, "up_sigma_rad");
    let mut frame = step.frame();
    let eight = [View::none(); 8];
    frame.views = &eight;
    refused(localizer.process(&frame), Status::Argument, "8 views");
    frame.views = &eight[..1];
    refused(localizer.process(&frame), Status::Argument, "view");
}

#[test]
fn maps_of_a_localizer() {
    let mut config = config();
    config.max_maps = 1;
    let mut localizer = Localizer::new(&config).unwrap();
    refused(localizer.remove_map(3), Status::Argument, "3");
    localizer.set_map(1, &map()).unwrap();
    localizer.set_map(1, &map()).unwrap();
    refused(localizer.set_map(2, &map()), Status::Capacity, "max_maps");
    refused(localizer.set_map_transform(1, &Rigid::IDENTITY, -1.0, 0.0), Status::Argument, "sigma");
    localizer.set_map_transform(1, &Rigid::IDENTITY, 0.01, 0.01).unwrap();
    localizer.clear_map_transform(1).unwrap();
    localizer.remove_map(1).unwrap();
    assert_eq!(localizer.map_count(), 0);
    assert_eq!(localizer.process(&steps()[0].frame()).unwrap().pose, None);

    config.color_band = spherecloud::Band::Infrared;
    refused(Localizer::new(&config).unwrap().set_map(MAP_ID, &map()), Status::Argument, "band");
}

#[test]
fn parameters_and_bias() {
    let (mut localizer, steps) = (localizer(), steps());
    let range = Parameter::MinInliers.range().unwrap();
    assert!(range.whole && range.lowest <= range.initial && range.initial <= range.highest);
    assert_eq!(localizer.parameter(Parameter::MinInliers).unwrap(), range.initial);
    localizer.set_parameter(Parameter::MinInliers, range.initial + 1.0).unwrap();
    assert_eq!(localizer.parameter(Parameter::MinInliers).unwrap(), range.initial + 1.0);
    refused(localizer.set_parameter(Parameter::MaxRatio, f64::NAN), Status::Argument, "");
    refused(localizer.set_parameter(Parameter::Unknown(99), 1.0), Status::Unsupported, "");
    refused(Parameter::Unknown(99).range(), Status::Unsupported, "");

    let mut learnt = localizer.process(&steps[0].frame()).unwrap().depth;
    localizer.set_depth_bias(&learnt).unwrap();
    learnt.offset_m = f64::INFINITY;
    refused(localizer.set_depth_bias(&learnt), Status::Argument, "");
}

#[test]
fn features_that_are_none() {
    let step = &steps()[0];
    let (mut localizer, mut features) = (localizer(), Features::new(&config()).unwrap());
    refused(features.get(), Status::State, "no frame");
    let (mut extractor, mut locator) = localizer.split();
    refused(locator.locate(&step.frame(), &features), Status::State, "");
    extractor.extract(&step.frame(), &mut features).unwrap();
    refused(locator.locate(&steps()[1].frame(), &features), Status::Argument, "time");
    let mut small = Config::new(rig());
    small.max_keypoints = 64;
    let mut others = Features::new(&small).unwrap();
    refused(extractor.extract(&Frame::of_color(0, step.frame().color.unwrap()), &mut others), Status::Argument, "");
}

#[test]
fn the_library_is_the_one_that_was_asked_for() {
    spherecloud::check_library().unwrap();
    assert_eq!(spherecloud::library_version().split('.').count(), 3);
}

#[test]
fn names_are_those_of_the_interface() {
    assert_eq!(Status::Argument.name(), "SPHC_E_ARGUMENT");
    assert_eq!(Status::from_raw(-77).name(), "SPHC_?");
    assert_eq!(Format::BayerGrbg12p.name(), "SPHC_FORMAT_BAYER_GRBG12P");
    let faults = spherecloud::Faults::from_bits(1 << 31) | spherecloud::Faults::MIRRORED;
    assert_eq!(format!("{faults:?}"), "{MIRRORED, 0x80000000}");
}
