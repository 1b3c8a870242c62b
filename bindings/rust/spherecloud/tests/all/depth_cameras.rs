//! A second depth camera of a rig, and the first as it is in a frame.
use crate::session::{config, localizer, localizer_of, rig, steps, Step};
use spherecloud::{Config, DepthView, Format, Image, RigDepthCamera, Status};

fn second() -> RigDepthCamera {
    RigDepthCamera::new(rig().depth_camera, rig().color_from_depth)
}

fn both(camera: RigDepthCamera) -> Config<'static> {
    config().with_depth_camera(camera)
}

fn of_the_first(step: &Step) -> DepthView<'_> {
    let frame = step.frame();
    DepthView::new(frame.depth_time_ns, frame.depth.unwrap())
}

#[test]
fn the_second_sees_where_the_first_is_blind() {
    let (step, blind) = (&steps()[0], [0; 200 * 160]);
    let mut localizer = localizer_of(&both(second()));
    let mut told = of_the_first(step);
    (told.camera, told.color_from_depth) = (Some(rig().depth_camera), Some(rig().color_from_depth));
    let views = [told, DepthView::none()];
    let mut frame = step.frame();
    frame.depth = Some(Image::from_u16(Format::Depth16, 200, 160, &blind).unwrap());
    for (view, is_found) in [(&views[..1], true), (&views[1..], false)] {
        frame.depth_views = view;
        assert_eq!(localizer.process(&frame).unwrap().pose.is_some(), is_found);
    }
}

#[test]
fn views_that_do_not_fit() {
    let (step, mut localizer) = (&steps()[0], localizer_of(&both(second())));
    let mut camera = second();
    camera.amplitude_min = 10;
    let mut of_amplitude = localizer_of(&both(camera));
    let small = Image::from_u16(Format::Depth16, 200, 159, &step.depth[..200 * 159]).unwrap();
    let (narrow, good) = ([DepthView::new(0, small)], [of_the_first(step); 2]);
    let refused = |views, localizer: &mut spherecloud::Localizer, status, words| {
        let mut frame = step.frame();
        frame.depth_views = views;
        let error = localizer.process(&frame).unwrap_err();
        assert_eq!(error.status(), status, "{error}");
        assert!(error.message().contains(words), "{error}");
    };
    refused(&narrow, &mut localizer, Status::Image, "159");
    refused(&[], &mut localizer, Status::Argument, "frame.depth_view_count is 0");
    refused(&good, &mut localizer, Status::Argument, "2 depth views");
    refused(&good[..1], &mut of_amplitude, Status::Image, "amplitude");
    refused(&good[..1], &mut crate::session::localizer(), Status::Argument, "config.depth_camera_count is 0");
}

#[test]
fn the_first_as_it_is_in_a_frame() {
    let (step, mut other) = (&steps()[0], localizer());
    let mut frame = step.frame();
    let plain = localizer().process(&frame).unwrap().pose;
    frame.depth_camera = Some(rig().depth_camera);
    assert_eq!(other.process(&frame).unwrap().pose, plain);
    frame.depth_camera = Some(rig().color_camera);
    assert!(other.process(&frame).unwrap_err().message().contains("frame.depth_camera"));
}
