//! Depth images on the colour image.
use crate::session::{rig, steps};
use spherecloud::{Aligned, AlignedPixel, Aligner, AlignerConfig, Format, Image, Status};

#[test]
fn depth_lies_on_the_colour_image() {
    let step = &steps()[0];
    let image = Image::from_u16(Format::Depth16, 200, 160, &step.depth).unwrap();
    let mut aligner = Aligner::new(&AlignerConfig::new(rig())).unwrap();
    let (mut depth, mut mask) = (vec![0; 320 * 240], vec![0; 320 * 240]);
    aligner.process(&image, &mut Aligned { depth: Some(&mut depth), mask: Some(&mut mask), confidence: None }).unwrap();
    let has_depth =
        |value: u8| [AlignedPixel::Measured, AlignedPixel::Filled].contains(&AlignedPixel::from_raw(value.into()));
    assert!(mask.iter().zip(&depth).all(|(&pixel, &depth)| has_depth(pixel) == (depth > 0)));
    assert!(depth.iter().filter(|&&depth| depth > 0).count() > 320 * 240 / 2);
    aligner.process(&image, &mut Aligned::default()).unwrap();
}

#[test]
fn what_does_not_fit_is_refused() {
    let step = &steps()[0];
    let image = Image::from_u16(Format::Depth16, 200, 160, &step.depth).unwrap();
    let mut aligner = Aligner::new(&AlignerConfig::new(rig())).unwrap();
    let mut small = vec![0; 320 * 240 - 1];
    let error = aligner.process(&image, &mut Aligned { mask: Some(&mut small), ..Aligned::default() }).unwrap_err();
    assert_eq!(error.status(), Status::Argument);
    assert!(error.message().contains("mask"));
    let turned = Image::from_u16(Format::Depth16, 160, 200, &step.depth).unwrap();
    assert_eq!(aligner.process(&turned, &mut Aligned::default()).unwrap_err().status(), Status::Image);
    let mut config = AlignerConfig::new(rig());
    config.depth_min_m = f64::NAN;
    assert_eq!(Aligner::new(&config).unwrap_err().status(), Status::Argument);
}
