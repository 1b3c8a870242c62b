//! What goes into a localizer.
use core::mem::{size_of, zeroed};
use core::ptr::null;
use core::time::Duration;

use spherecloud_sys as sys;

use crate::config::{FURTHER_CAMERAS, FURTHER_DEPTH_CAMERAS};
use crate::error::error;
use crate::{Camera, Image, Result, Rigid};

/// A colour and a depth image taken at about the same time; everything is borrowed, for the call alone.
///
/// ```compile_fail,E0505
/// # use spherecloud::*;
/// # fn fails(localizer: &mut Localizer<'_>) -> Result<()> {
/// let (pixels, depth) = (vec![0u8; 320 * 240], vec![0u16; 200 * 160]);
/// let color = Image::new(Format::Gray8, 320, 240, &pixels)?;
/// let frame = Frame::new(0, color, 0, Image::from_u16(Format::Depth16, 200, 160, &depth)?);
/// drop(pixels);
/// localizer.process(&frame)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Frame<'a> {
    /// The caller's own number; comes back in the result.
    pub sequence: u32,
    /// Mid-exposure; the pose is that of the colour camera at this time.
    pub color_time_ns: i64,
    /// Mid-exposure of the depth image.
    pub depth_time_ns: i64,
    /// Any format that is not of depth, at the size in `config.rig.color_camera`.
    pub color: Option<Image<'a>>,
    /// Of `config.depth_format`, at the size in `config.rig.depth_camera`.
    pub depth: Option<Image<'a>>,
    /// What is known before the frame is looked at, but for what earlier frames told.
    pub prior: Option<Prior>,
    /// The frame is to be answered so long after the call began, with the best pose so far. Needs a clock, and counts
    /// in its time.
    pub deadline: Option<Duration>,
    /// How much of its own light the depth sensor saw in each pixel: grey, at the depth image's size. Needed where
    /// `config.amplitude_min` is set.
    pub amplitude: Option<Image<'a>>,
    /// One for each camera that [`Config::with_camera`](crate::Config::with_camera) added, in their order.
    pub views: &'a [View<'a>],
    /// As it is in this frame, with heat or focus, if it differs from the config's. The size stays.
    pub color_camera: Option<Camera>,
    /// As it is in this frame, if it differs from the config's.
    pub color_from_depth: Option<Rigid>,
    /// As it is in this frame, with heat or focus, if it differs from the config's. The size stays. Of a range format,
    /// cosines stay those of the config's.
    pub depth_camera: Option<Camera>,
    /// One for each camera that [`Config::with_depth_camera`](crate::Config::with_depth_camera) added, in their order.
    pub depth_views: &'a [DepthView<'a>],
}

/// The image of a further camera.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct View<'a> {
    /// Mid-exposure.
    pub time_ns: i64,
    /// Any format that is not of depth. `None`: the camera has no image in this frame.
    pub image: Option<Image<'a>>,
    /// As it is in this frame, if it differs from the config's. The size stays.
    pub camera: Option<Camera>,
    /// As it is in this frame, if it differs from the config's.
    pub color_from_camera: Option<Rigid>,
}

/// The image of a further depth camera.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct DepthView<'a> {
    /// Mid-exposure.
    pub time_ns: i64,
    /// Of the camera's format and size. `None`: the camera has no image in this frame.
    pub depth: Option<Image<'a>>,
    /// As [`Frame::amplitude`]. Needed with every depth image where the camera's `amplitude_min` is set.
    pub amplitude: Option<Image<'a>>,
    /// As it is in this frame, if it differs from the config's. The size stays.
    pub camera: Option<Camera>,
    /// As it is in this frame, if it differs from the config's.
    pub color_from_depth: Option<Rigid>,
}

/// What is known of a pose before its frame is looked at.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct Prior {
    /// The map whose frame `pose` and `up` are in.
    pub map_id: u32,
    /// Where the camera should be.
    pub pose: Option<PosePrior>,
    /// The vertical, from an inertial sensor.
    pub up: Option<UpPrior>,
    /// The device's own dead reckoning; used in [`Mode::Tracking`](crate::Mode::Tracking).
    pub odometry: Option<Odometry>,
}

impl Prior {
    /// Of a map's frame; its parts are then set one by one: `let mut prior = Prior::in_map(7); prior.up = Some(up);`.
    pub fn in_map(map_id: u32) -> Self {
        Self { map_id, ..Self::default() }
    }
}

/// Where the camera should be: the map points that should be in view are looked at first.
#[derive(Clone, Copy, Debug)]
pub struct PosePrior {
    /// The pose.
    pub camera_from_map: Rigid,
    /// 1 sigma an axis; 1e-6 to 3.2.
    pub rotation_sigma_rad: f64,
    /// 1 sigma an axis, of the camera's centre; 1e-6 to 1000.
    pub translation_sigma_m: f64,
}

/// One direction in two frames; neither need be a unit vector.
#[derive(Clone, Copy, Debug)]
pub struct UpPrior {
    /// Upwards in the camera's frame.
    pub up_camera: [f64; 3],
    /// Upwards in the map's frame.
    pub up_map: [f64; 3],
    /// 1 sigma an axis; 1e-4 to 0.5.
    pub sigma_rad: f64,
}

/// Dead reckoning at the frame's `color_time_ns`, in a frame of its own that may drift.
#[derive(Clone, Copy, Debug)]
pub struct Odometry {
    /// The pose.
    pub odometry_from_camera: Rigid,
    /// 1 sigma an axis, of the step from the frame before; 1e-6 to 1.
    pub rotation_sigma_rad: f64,
    /// The same; 1e-6 to 10.
    pub translation_sigma_m: f64,
}

impl<'a> Frame<'a> {
    /// Two images and when they were taken.
    pub fn new(color_time_ns: i64, color: Image<'a>, depth_time_ns: i64, depth: Image<'a>) -> Self {
        Self { color: Some(color), ..Self::of_depth(color_time_ns, depth_time_ns, depth) }
    }

    /// What [`Extractor::extract`](crate::Extractor::extract) and [`Features::set`](crate::Features::set) look at.
    pub fn of_color(color_time_ns: i64, color: Image<'a>) -> Self {
        Self { color: Some(color), ..Self::at(color_time_ns) }
    }

    /// What [`Locator::locate`](crate::Locator::locate) looks at: the colour image may be gone by then.
    pub fn of_depth(color_time_ns: i64, depth_time_ns: i64, depth: Image<'a>) -> Self {
        Self { depth_time_ns, depth: Some(depth), ..Self::at(color_time_ns) }
    }

    fn at(color_time_ns: i64) -> Self {
        Self {
            sequence: 0,
            color_time_ns,
            depth_time_ns: color_time_ns,
            color: None,
            depth: None,
            prior: None,
            deadline: None,
            amplitude: None,
            views: &[],
            color_camera: None,
            color_from_depth: None,
            depth_camera: None,
            depth_views: &[],
        }
    }

    /// Lends the frame to C.
    pub(crate) fn with_raw<R>(&self, call: impl FnOnce(&sys::sphc_localizer_frame) -> R) -> Result<R> {
        if self.views.len() > FURTHER_CAMERAS {
            return Err(error!(Argument, "the frame has {} views, {} is the most", self.views.len(), FURTHER_CAMERAS));
        }
        if self.depth_views.len() > FURTHER_DEPTH_CAMERAS {
            let (has, most) = (self.depth_views.len(), FURTHER_DEPTH_CAMERAS);
            return Err(error!(Argument, "the frame has {} depth views, {} is the most", has, most));
        }
        let mut views = [View::none().lend(); FURTHER_CAMERAS];
        views.iter_mut().zip(self.views).for_each(|(raw, view)| *raw = view.lend());
        let mut depth_views = [DepthView::none().lend(); FURTHER_DEPTH_CAMERAS];
        depth_views.iter_mut().zip(self.depth_views).for_each(|(raw, view)| *raw = view.lend());
        let prior = self.prior.as_ref().map(Prior::lend);
        let raw = sys::sphc_localizer_frame {
            struct_size: size_of::<sys::sphc_localizer_frame>() as u32,
            sequence: self.sequence,
            color_time_ns: self.color_time_ns,
            depth_time_ns: self.depth_time_ns,
            color: self.color.map_or(Image::none(), Image::to_raw),
            depth: self.depth.map_or(Image::none(), Image::to_raw),
            prior: prior.as_ref().map_or(null(), |prior| prior),
            // 0 is none to C, and a deadline that is over is one.
            deadline_us: self.deadline.map_or(0, |left| left.as_micros().clamp(1, u32::MAX.into()) as u32),
            reserved: 0,
            reserved2: 0,
            amplitude: self.amplitude.map_or(Image::none(), Image::to_raw),
            views: if self.views.is_empty() { null() } else { views.as_ptr() },
            view_count: self.views.len() as u32,
            reserved3: 0,
            color_camera: self.color_camera.as_ref().map_or(null(), Camera::as_raw),
            color_from_depth: self.color_from_depth.as_ref().map_or(null(), Rigid::as_raw),
            depth_camera: self.depth_camera.as_ref().map_or(null(), Camera::as_raw),
            depth_views: if self.depth_views.is_empty() { null() } else { depth_views.as_ptr() },
            depth_view_count: self.depth_views.len() as u32,
            reserved4: 0,
        };
        Ok(call(&raw))
    }
}

impl<'a> View<'a> {
    /// An image, with the camera as it is in the config.
    pub fn new(time_ns: i64, image: Image<'a>) -> Self {
        Self { time_ns, image: Some(image), camera: None, color_from_camera: None }
    }

    /// The camera has no image in this frame.
    pub fn none() -> Self {
        Self { time_ns: 0, image: None, camera: None, color_from_camera: None }
    }

    /// It points into the view.
    fn lend(&self) -> sys::sphc_localizer_view {
        sys::sphc_localizer_view {
            struct_size: size_of::<sys::sphc_localizer_view>() as u32,
            reserved: 0,
            time_ns: self.time_ns,
            image: self.image.map_or(Image::none(), Image::to_raw),
            camera: self.camera.as_ref().map_or(null(), Camera::as_raw),
            color_from_camera: self.color_from_camera.as_ref().map_or(null(), Rigid::as_raw),
        }
    }
}

impl<'a> DepthView<'a> {
    /// An image, with the camera as it is in the config.
    pub fn new(time_ns: i64, depth: Image<'a>) -> Self {
        Self { time_ns, depth: Some(depth), ..Self::none() }
    }

    /// The camera has no image in this frame.
    pub fn none() -> Self {
        Self { time_ns: 0, depth: None, amplitude: None, camera: None, color_from_depth: None }
    }

    /// It points into the view.
    fn lend(&self) -> sys::sphc_localizer_depth_view {
        sys::sphc_localizer_depth_view {
            struct_size: size_of::<sys::sphc_localizer_depth_view>() as u32,
            reserved: 0,
            time_ns: self.time_ns,
            depth: self.depth.map_or(Image::none(), Image::to_raw),
            amplitude: self.amplitude.map_or(Image::none(), Image::to_raw),
            camera: self.camera.as_ref().map_or(null(), Camera::as_raw),
            color_from_depth: self.color_from_depth.as_ref().map_or(null(), Rigid::as_raw),
        }
    }
}

impl Prior {
    fn lend(&self) -> sys::sphc_localizer_prior {
        // SAFETY: all zero is a value of it, and says nothing.
        let mut raw: sys::sphc_localizer_prior = unsafe { zeroed() };
        raw.struct_size = size_of::<sys::sphc_localizer_prior>() as u32;
        raw.map_id = self.map_id;
        raw.camera_from_map = Rigid::IDENTITY.to_raw();
        raw.odometry_from_camera = Rigid::IDENTITY.to_raw();
        if let Some(pose) = &self.pose {
            raw.flags |= sys::SPHC_PRIOR_POSE;
            raw.camera_from_map = pose.camera_from_map.to_raw();
            raw.rotation_sigma_rad = pose.rotation_sigma_rad;
            raw.translation_sigma_m = pose.translation_sigma_m;
        }
        if let Some(up) = &self.up {
            raw.flags |= sys::SPHC_PRIOR_UP;
            raw.up_camera = up.up_camera;
            raw.up_map = up.up_map;
            raw.up_sigma_rad = up.sigma_rad;
        }
        if let Some(odometry) = &self.odometry {
            raw.flags |= sys::SPHC_PRIOR_ODOMETRY;
            raw.odometry_from_camera = odometry.odometry_from_camera.to_raw();
            raw.odometry_rotation_sigma_rad = odometry.rotation_sigma_rad;
            raw.odometry_translation_sigma_m = odometry.translation_sigma_m;
        }
        raw
    }
}
