//! Features are read, put in elsewhere, and found to be the same.
use crate::session::{config, localizer, steps};
use spherecloud::{extractor_id, FeatureSet, Features, Frame, Status};

#[test]
fn features_of_other_hardware() {
    let (mut localizer, step) = (localizer(), &steps()[0]);
    let frame = step.frame();
    let (mut found, mut put) = (Features::new(&config()).unwrap(), Features::new(&config()).unwrap());
    localizer.split().0.extract(&frame, &mut found).unwrap();
    let set = found.get().unwrap();
    assert_eq!((set.extractor, set.cameras), (extractor_id(), None));
    assert!(set.keypoints.windows(2).all(|two| two[0].response >= two[1].response));
    put.set(&Frame::of_color(frame.color_time_ns, frame.color.unwrap()), &set).unwrap();

    let expected = localizer.split().1.locate(&frame, &found).unwrap();
    let located = crate::session::localizer().split().1.locate(&frame, &put).unwrap();
    assert_eq!(located.pose.unwrap().camera_from_map, expected.pose.unwrap().camera_from_map);
    assert_eq!(located.times.features_us, 0);

    let lacking = FeatureSet { descriptors: &set.descriptors[1..], ..set };
    assert_eq!(put.set(&frame, &lacking).unwrap_err().status(), Status::Argument);
    let foreign = FeatureSet { extractor: 99, ..set };
    assert_eq!(put.set(&frame, &foreign).unwrap_err().status(), Status::MapExtractor);
    let mut wrong = set.keypoints.to_vec();
    wrong[0].x_px = f32::NAN;
    let error = put.set(&frame, &FeatureSet { keypoints: &wrong, ..set }).unwrap_err();
    assert_eq!(error.status(), Status::Argument);
    assert_eq!(put.get().unwrap().keypoints, set.keypoints, "they stay what they were");
}

#[test]
fn a_rig_of_two_cameras() {
    let steps = steps();
    let rig = crate::session::rig();
    let further = spherecloud::RigCamera::new(rig.color_camera, spherecloud::Rigid::IDENTITY);
    let config = config().with_camera(further);
    let mut localizer = crate::session::localizer_of(&config);
    for (step, has_view) in steps.iter().zip([true, false, true]) {
        let mut frame = step.frame();
        let shown = spherecloud::View::new(frame.color_time_ns, frame.color.unwrap());
        let views = [if has_view { shown } else { spherecloud::View::none() }];
        frame.views = &views;
        let found = localizer.process(&frame).unwrap();
        assert!(found.pose.is_some(), "{found:?}");
        let further = localizer.observations().unwrap().iter().filter(|seen| seen.camera == 1).count();
        assert_eq!(further > 0, has_view);
    }
}
