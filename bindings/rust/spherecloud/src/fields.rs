//! Every field goes where it belongs, to C and back: each has a value of its own.
use core::mem::zeroed;
use core::time::Duration;
use std::slice;

use spherecloud_sys as sys;

use crate::*;

fn camera(width: u32) -> Camera {
    Camera::pinhole(width, 100, [1.0; 4])
}

fn at(x_m: f64) -> Rigid {
    Rigid { t_m: [x_m, 0.0, 0.0], ..Rigid::IDENTITY }
}

#[test]
fn of_a_result() {
    // SAFETY: numbers of 32 bits and floats of 64 have any bits as values.
    let mut raw: sys::sphc_localizer_result = unsafe { zeroed() };
    let words = core::mem::size_of_val(&raw) / 4;
    let all = unsafe { slice::from_raw_parts_mut((&mut raw as *mut sys::sphc_localizer_result).cast::<u32>(), words) };
    (0..).zip(all).for_each(|(i, word)| *word = 1000 + i);
    raw.outcome = sys::SPHC_OUTCOME_LOCALIZED;
    let found = Localization::from_raw(&raw);
    let pose = found.pose.unwrap();

    assert_eq!((found.sequence, found.time_ns, found.outcome), (raw.sequence, raw.time_ns, Outcome::Localized));
    assert_eq!(
        (pose.camera_from_map.q_wxyz, pose.camera_from_map.t_m),
        (raw.camera_from_map.q_wxyz, raw.camera_from_map.t_m)
    );
    assert_eq!((pose.covariance, pose.confidence), (raw.covariance, raw.confidence));
    assert_eq!((found.map_id, found.state.raw()), (Some(raw.map_id), raw.state));
    assert_eq!((found.keypoints, found.lifted, found.matches), (raw.keypoints, raw.lifted, raw.matches));
    assert_eq!((found.inliers, found.iterations, found.frames), (raw.inliers, raw.iterations, raw.frames));
    assert_eq!((found.faults.bits(), found.cuts.bits(), found.hints.bits()), (raw.faults, raw.cuts, raw.hints));
    assert_eq!((found.events.bits(), found.jump_m, found.jump_rad), (raw.events, raw.jump_m, raw.jump_rad));
    assert!(found.guided);
    assert_eq!((found.times.features_us, found.times.align_us), (raw.features_us, raw.align_us));
    assert_eq!((found.times.match_us, found.times.pose_us), (raw.match_us, raw.pose_us));
    assert_eq!(
        (found.depth.mid_m, found.depth.offset_m, found.depth.slope),
        (raw.depth.mid_m, raw.depth.offset_m, raw.depth.slope)
    );
    assert_eq!(
        (found.depth.offset_sigma_m, found.depth.slope_sigma),
        (raw.depth.offset_sigma_m, raw.depth.slope_sigma)
    );
    assert_eq!((found.depth.correlation, found.depth.noise_scale), (raw.depth.correlation, raw.depth.noise_scale));

    raw.outcome = 99;
    raw.map_id = sys::SPHC_MAP_NONE;
    let none = Localization::from_raw(&raw);
    assert_eq!((none.outcome, none.pose, none.map_id), (Outcome::Unknown(99), None, None));
}

#[test]
fn of_a_frame() {
    let (bytes, widths) = ([0; 100 * 100 * 2], [90, 91, 92, 93, 94, 95]);
    let [color, depth, amplitude, seen, deep, bright] =
        widths.map(|width| Image::new(Format::Gray8, width, 100, &bytes).unwrap());
    let view = View { camera: Some(camera(20)), color_from_camera: Some(at(7.0)), ..View::new(5, seen) };
    let views = [view, View::none()];
    let depth_views = [DepthView {
        amplitude: Some(bright),
        camera: Some(camera(22)),
        color_from_depth: Some(at(9.0)),
        ..DepthView::new(10, deep)
    }];
    let mut frame = Frame::new(2, color, 3, depth);
    frame.depth_camera = Some(camera(23));
    frame.depth_views = &depth_views;
    frame.sequence = 1;
    frame.amplitude = Some(amplitude);
    frame.deadline = Some(Duration::from_micros(4));
    frame.views = &views;
    frame.color_camera = Some(camera(21));
    frame.color_from_depth = Some(at(8.0));
    frame.prior = Some(Prior {
        map_id: 6,
        pose: Some(PosePrior { camera_from_map: at(1.0), rotation_sigma_rad: 2.0, translation_sigma_m: 3.0 }),
        up: Some(UpPrior { up_camera: [4.0; 3], up_map: [5.0; 3], sigma_rad: 6.0 }),
        odometry: Some(Odometry { odometry_from_camera: at(7.0), rotation_sigma_rad: 8.0, translation_sigma_m: 9.0 }),
    });
    // SAFETY: what it points to lives during the call.
    let seen = |raw: &sys::sphc_localizer_frame| unsafe {
        assert_eq!((raw.sequence, raw.color_time_ns, raw.depth_time_ns, raw.deadline_us), (1, 2, 3, 4));
        assert_eq!([raw.color.width, raw.depth.width, raw.amplitude.width], widths[..3]);
        assert_eq!(((*raw.color_camera).width, (*raw.color_from_depth).t_m[0]), (21, 8.0));
        let views = slice::from_raw_parts(raw.views, raw.view_count as usize);
        assert_eq!((views[0].time_ns, views[0].image.width, views.len()), (5, 93, 2));
        assert_eq!(((*views[0].camera).width, (*views[0].color_from_camera).t_m[0]), (20, 7.0));
        assert!(views[1].image.data.is_null() && views[1].camera.is_null() && views[1].color_from_camera.is_null());
        let (second, count) = (&*raw.depth_views, raw.depth_view_count);
        assert_eq!((second.time_ns, second.depth.width, second.amplitude.width, count), (10, 94, 95, 1));
        assert_eq!(((*second.camera).width, (*second.color_from_depth).t_m[0]), (22, 9.0));
        assert_eq!((*raw.depth_camera).width, 23);
        let prior = &*raw.prior;
        assert_eq!((prior.flags, prior.map_id), (7, 6));
        assert_eq!((prior.camera_from_map.t_m[0], prior.odometry_from_camera.t_m[0]), (1.0, 7.0));
        assert_eq!((prior.rotation_sigma_rad, prior.translation_sigma_m, prior.up_sigma_rad), (2.0, 3.0, 6.0));
        assert_eq!((prior.up_camera[0], prior.up_map[0]), (4.0, 5.0));
        assert_eq!((prior.odometry_rotation_sigma_rad, prior.odometry_translation_sigma_m), (8.0, 9.0));
    };
    frame.with_raw(seen).unwrap();
}

fn depth_camera() -> RigDepthCamera {
    RigDepthCamera {
        format: Format::Range16,
        camera: camera(33),
        color_from_depth: at(0.3),
        unit_m: 20.0,
        min_m: 21.0,
        max_m: 22.0,
        sigma_m: 23.0,
        sigma_per_m2: 24.0,
        offset_sigma_m: 25.0,
        slope_sigma: 26.0,
        amplitude_min: 27,
    }
}

#[test]
fn of_a_depth_camera_the_library_has_defaults() {
    let (config, made) =
        (Config::new(Rig::new(camera(30), camera(31), at(0.1))), RigDepthCamera::new(camera(1), at(0.1)));
    assert_eq!((made.format, made.unit_m, made.amplitude_min), (Format::Depth16, 0.001, 0));
    assert_eq!((made.min_m, made.max_m), (config.depth_min_m, config.depth_max_m));
    assert_eq!((made.sigma_m, made.sigma_per_m2), (config.depth_sigma_m, config.depth_sigma_per_m2));
    assert_eq!((made.offset_sigma_m, made.slope_sigma), (config.depth_offset_sigma_m, config.depth_slope_sigma));
}

#[test]
fn of_a_config() {
    let mut config = Config::new(Rig::new(camera(30), camera(31), at(0.1)))
        .with_camera(RigCamera { row_time_ns: 11, ..RigCamera::new(camera(32), at(0.2)) })
        .with_depth_camera(depth_camera());
    (config.max_keypoints, config.max_maps, config.mode, config.seed) = (1, 2, Mode::Single, 3);
    (config.depth_min_m, config.depth_max_m, config.depth_mid_m) = (4.0, 5.0, 6.0);
    (config.depth_sigma_m, config.depth_sigma_per_m2) = (7.0, 8.0);
    (config.pixel_sigma_px, config.map_sigma_m) = (9.0, 10.0);
    (config.depth_offset_sigma_m, config.depth_slope_sigma) = (11.0, 12.0);
    (config.depth_format, config.amplitude_min, config.color_band) = (Format::RangeF32, 13, Band::Infrared);
    config.color_row_time_ns = 14;
    // SAFETY: what it points to lives during the call.
    let seen = |raw: &sys::sphc_localizer_config| unsafe {
        assert_eq!((raw.max_keypoints, raw.max_maps, raw.mode, raw.seed), (1, 2, sys::SPHC_MODE_SINGLE, 3));
        assert_eq!((raw.depth_min_m, raw.depth_max_m, raw.depth_mid_m), (4.0, 5.0, 6.0));
        assert_eq!((raw.depth_sigma_m, raw.depth_sigma_per_m2), (7.0, 8.0));
        assert_eq!((raw.pixel_sigma_px, raw.map_sigma_m), (9.0, 10.0));
        assert_eq!((raw.depth_offset_sigma_m, raw.depth_slope_sigma), (11.0, 12.0));
        let (format, band) = (sys::SPHC_FORMAT_RANGE_F32, sys::SPHC_BAND_INFRARED);
        assert_eq!(
            (raw.depth_format, raw.amplitude_min, raw.color_band, raw.color_row_time_ns),
            (format, 13, band, 14)
        );
        assert_eq!((raw.rig.color_camera.width, raw.rig.depth_camera.width), (30, 31));
        assert_eq!((raw.rig.color_from_depth.t_m[0], raw.rig.depth_unit_m), (0.1, 0.001));
        let further = &*raw.cameras;
        assert_eq!((raw.camera_count, further.camera.width, further.row_time_ns), (1, 32, 11));
        assert_eq!(further.color_from_camera.t_m[0], 0.2);
        let second = &*raw.depth_cameras;
        assert_eq!((raw.depth_camera_count, second.camera.width, second.color_from_depth.t_m[0]), (1, 33, 0.3));
        assert_eq!((second.format, second.unit_m, second.amplitude_min), (sys::SPHC_FORMAT_RANGE16, 20.0, 27));
        assert_eq!((second.min_m, second.max_m, second.sigma_m, second.sigma_per_m2), (21.0, 22.0, 23.0, 24.0));
        assert_eq!((second.offset_sigma_m, second.slope_sigma), (25.0, 26.0));
    };
    config.with_raw(seen).unwrap();
}
