//! What a localizer is made of.
use core::mem::{size_of, zeroed};
use core::ptr::{null, null_mut};

use spherecloud_sys as sys;

use crate::error::{check, check_library, check_with, error, text_of};
use crate::hooks::{self, Clock, ClockFn, Hook, Log, LogFn, Parallel, ParallelFn, Shared};
use crate::{Band, Camera, Format, LogLevel, MemoryNeed, Mode, Result, Rig, Rigid, Status};

/// Describes the headset. [`Config::new`] has the defaults; what differs is set in its fields.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Config<'a> {
    /// Of all cameras together; the strongest are kept. 64 to 4096.
    pub max_keypoints: u32,
    /// That the localizer has at once. 1 to 64.
    pub max_maps: u32,
    /// Do frames follow each other?
    pub mode: Mode,
    /// The same seed, maps, config and frames give the same bytes in the results.
    pub seed: u64,
    /// The colour and the depth camera.
    pub rig: Rig,
    /// Measurements below are ignored.
    pub depth_min_m: f64,
    /// Measurements above are ignored.
    pub depth_max_m: f64,
    /// Noise of the depth sensor, 1 sigma: sigma(z) = depth_sigma_m + depth_sigma_per_m2 z^2.
    pub depth_sigma_m: f64,
    /// As above.
    pub depth_sigma_per_m2: f64,
    /// Noise of a keypoint's position, 1 sigma.
    pub pixel_sigma_px: f64,
    /// Error of a map point across its direction, 1 sigma.
    pub map_sigma_m: f64,
    /// Depth around which the bias turns: true z = z + offset + slope (z - mid). 0: the geometric mean of
    /// `depth_min_m` and `depth_max_m`.
    pub depth_mid_m: f64,
    /// 1 sigma of the bias' offset before the first frame; this and the slope's 0: there is no bias, and nothing is
    /// learnt. One of them alone is refused.
    pub depth_offset_sigma_m: f64,
    /// 1 sigma of the bias' slope before the first frame.
    pub depth_slope_sigma: f64,
    /// Of [`Frame::depth`](crate::Frame::depth).
    pub depth_format: Format,
    /// Measurements whose pixel in [`Frame::amplitude`](crate::Frame::amplitude) is below are ignored. 0: no
    /// amplitude is looked at.
    pub amplitude_min: u32,
    /// What the cameras see; maps of another band are refused.
    pub color_band: Band,
    /// Of a rolling shutter: from a row's exposure to that of the row below. 0: all at once.
    pub color_row_time_ns: i64,
    cameras: [RigCamera; FURTHER_CAMERAS],
    camera_count: usize,
    depth_cameras: [RigDepthCamera; FURTHER_DEPTH_CAMERAS],
    depth_camera_count: usize,
    log: Option<(LogLevel, Hook<'a, LogFn>)>,
    clock: Option<Hook<'a, ClockFn>>,
    parallel: Option<(u32, Hook<'a, ParallelFn>)>,
}

/// A camera of a rig beside the colour camera: grey or colour, of any model and size, looking anywhere.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct RigCamera {
    /// Its intrinsics.
    pub camera: Camera,
    /// Where it is, seen from the colour camera.
    pub color_from_camera: Rigid,
    /// As [`Config::color_row_time_ns`].
    pub row_time_ns: i64,
}

impl RigCamera {
    /// With a global shutter.
    pub fn new(camera: Camera, color_from_camera: Rigid) -> Self {
        Self { camera, color_from_camera, row_time_ns: 0 }
    }

    fn to_raw(self) -> sys::sphc_localizer_camera {
        sys::sphc_localizer_camera {
            struct_size: size_of::<sys::sphc_localizer_camera>() as u32,
            reserved: 0,
            camera: self.camera.to_raw(),
            color_from_camera: self.color_from_camera.to_raw(),
            row_time_ns: self.row_time_ns,
        }
    }
}

/// A depth camera of a rig beside the one in [`Config::rig`].
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct RigDepthCamera {
    /// Of its image.
    pub format: Format,
    /// Its intrinsics.
    pub camera: Camera,
    /// Where it is, seen from the colour camera.
    pub color_from_depth: Rigid,
    /// Metres per unit of its image.
    pub unit_m: f64,
    /// Measurements below are ignored.
    pub min_m: f64,
    /// Measurements above are ignored.
    pub max_m: f64,
    /// Its noise, 1 sigma: sigma(z) = sigma_m + sigma_per_m2 z^2.
    pub sigma_m: f64,
    /// As above.
    pub sigma_per_m2: f64,
    /// How it is off against the depth camera in [`Config::rig`]: z of that one = z + offset + slope (z - depth_mid_m).
    /// 1 sigma of the offset before the first frame; it is learnt where both measure what the colour camera sees. This
    /// and the slope's 0: they measure alike.
    pub offset_sigma_m: f64,
    /// 1 sigma of that slope before the first frame.
    pub slope_sigma: f64,
    /// Measurements whose pixel in [`DepthView::amplitude`](crate::DepthView::amplitude) is below are ignored. 0: no
    /// amplitude is looked at.
    pub amplitude_min: u32,
}

impl RigDepthCamera {
    /// The library's defaults: those of the config for range, noise and bias, and millimetres.
    pub fn new(camera: Camera, color_from_depth: Rigid) -> Self {
        let size = size_of::<sys::sphc_localizer_depth_camera>();
        // SAFETY: all zero is a value of it; the call is [pure], and the size is right.
        let mut raw: sys::sphc_localizer_depth_camera = unsafe { zeroed() };
        unsafe { sys::sphc_localizer_depth_camera_init(&mut raw, size) };
        Self {
            format: Format::Depth16,
            camera,
            color_from_depth,
            unit_m: raw.unit_m,
            min_m: raw.min_m,
            max_m: raw.max_m,
            sigma_m: raw.sigma_m,
            sigma_per_m2: raw.sigma_per_m2,
            offset_sigma_m: raw.offset_sigma_m,
            slope_sigma: raw.slope_sigma,
            amplitude_min: raw.amplitude_min,
        }
    }

    fn to_raw(self) -> sys::sphc_localizer_depth_camera {
        sys::sphc_localizer_depth_camera {
            struct_size: size_of::<sys::sphc_localizer_depth_camera>() as u32,
            format: self.format.raw(),
            camera: self.camera.to_raw(),
            color_from_depth: self.color_from_depth.to_raw(),
            unit_m: self.unit_m,
            min_m: self.min_m,
            max_m: self.max_m,
            sigma_m: self.sigma_m,
            sigma_per_m2: self.sigma_per_m2,
            offset_sigma_m: self.offset_sigma_m,
            slope_sigma: self.slope_sigma,
            amplitude_min: self.amplitude_min,
            reserved: 0,
        }
    }
}

/// Cameras of a rig beside the colour camera, at most.
pub(crate) const FURTHER_CAMERAS: usize = sys::SPHC_CAMERAS_MAX as usize - 1;
/// Depth cameras of a rig beside the one in [`Config::rig`], at most.
pub(crate) const FURTHER_DEPTH_CAMERAS: usize = sys::SPHC_DEPTH_CAMERAS_MAX as usize - 1;

/// A piece of a localizer's memory, for an account of its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryPiece {
    /// Such as "features.pyramid".
    pub name: &'static str,
    /// How many.
    pub bytes: u64,
    /// Is it in the scratch memory, or else in the state?
    pub is_scratch: bool,
}

impl<'a> Config<'a> {
    /// The library's defaults for a rig. With the feature `std` its clock is a [`MonotonicClock`](hooks::MonotonicClock),
    /// otherwise there is none.
    pub fn new(rig: Rig) -> Self {
        // SAFETY: all zero is a value of it; the call is [pure], and the size is right.
        let mut raw: sys::sphc_localizer_config = unsafe { zeroed() };
        unsafe { sys::sphc_localizer_config_init(&mut raw, size_of::<sys::sphc_localizer_config>()) };
        let made = Self {
            max_keypoints: raw.max_keypoints,
            max_maps: raw.max_maps,
            mode: Mode::from_raw(raw.mode),
            seed: raw.seed,
            rig,
            depth_min_m: raw.depth_min_m,
            depth_max_m: raw.depth_max_m,
            depth_sigma_m: raw.depth_sigma_m,
            depth_sigma_per_m2: raw.depth_sigma_per_m2,
            pixel_sigma_px: raw.pixel_sigma_px,
            map_sigma_m: raw.map_sigma_m,
            depth_mid_m: raw.depth_mid_m,
            depth_offset_sigma_m: raw.depth_offset_sigma_m,
            depth_slope_sigma: raw.depth_slope_sigma,
            depth_format: Format::Depth16,
            amplitude_min: raw.amplitude_min,
            color_band: Band::from_raw(raw.color_band),
            cameras: [RigCamera::new(rig.color_camera, Rigid::IDENTITY); FURTHER_CAMERAS],
            camera_count: 0,
            depth_cameras: [RigDepthCamera::new(rig.depth_camera, Rigid::IDENTITY); FURTHER_DEPTH_CAMERAS],
            depth_camera_count: 0,
            color_row_time_ns: raw.color_row_time_ns,
            log: None,
            clock: None,
            parallel: None,
        };
        #[cfg(feature = "std")]
        let made = made.with_clock(alloc::sync::Arc::new(hooks::MonotonicClock::new()));
        made
    }

    /// Adds a camera to the rig; with more than 7, no localizer can be made.
    #[must_use]
    pub fn with_camera(mut self, camera: RigCamera) -> Self {
        if let Some(free) = self.cameras.get_mut(self.camera_count) {
            *free = camera;
        }
        self.camera_count += 1;
        self
    }

    /// Adds a depth camera to the rig; with more than 1, no localizer can be made.
    #[must_use]
    pub fn with_depth_camera(mut self, camera: RigDepthCamera) -> Self {
        if let Some(free) = self.depth_cameras.get_mut(self.depth_camera_count) {
            *free = camera;
        }
        self.depth_camera_count += 1;
        self
    }

    /// Says lines of the log that matter as much as `level`, or more. `log` is a reference or an `Arc`.
    #[must_use]
    pub fn with_log<T: Log + 'a>(mut self, level: LogLevel, log: impl Into<Shared<'a, T>>) -> Self {
        self.log = Some((level, Hook::new(hooks::log::<T> as LogFn, log.into())));
        self
    }

    /// Reads another clock: without one, times of stages are 0, and frames have no deadline. `clock` is a reference or
    /// an `Arc`.
    #[must_use]
    pub fn with_clock<T: Clock + 'a>(mut self, clock: impl Into<Shared<'a, T>>) -> Self {
        self.clock = Some(Hook::new(hooks::clock::<T> as ClockFn, clock.into()));
        self
    }

    /// Cuts a frame's work into `tasks` pieces at most, 1 to 8, and runs them on threads of `pool`: the results are the
    /// same bytes. `pool` is a reference or an `Arc`.
    #[must_use]
    pub fn with_parallel<T: Parallel + 'a>(mut self, tasks: u32, pool: impl Into<Shared<'a, T>>) -> Self {
        self.parallel = Some((tasks, Hook::new(hooks::parallel::<T> as ParallelFn, pool.into())));
        self
    }

    /// What a localizer of this config needs, for [`Localizer::new_in`](crate::Localizer::new_in).
    pub fn localizer_memory(&self) -> Result<MemoryNeed> {
        let mut need = MemoryNeed::NONE;
        // SAFETY: [pure].
        self.with_raw(|raw| check(|message| unsafe { sys::sphc_localizer_memory(raw, &mut need, message) }))??;
        Ok(MemoryNeed::from_raw(&need))
    }

    /// What features of this config need, for [`Features::new_in`](crate::Features::new_in).
    pub fn features_memory(&self) -> Result<MemoryNeed> {
        let mut need = MemoryNeed::NONE;
        // SAFETY: [pure].
        self.with_raw(|raw| check(|message| unsafe { sys::sphc_features_memory(raw, &mut need, message) }))??;
        Ok(MemoryNeed::from_raw(&need))
    }

    /// The pieces of a localizer's memory; the first is 0, and `None` comes behind the last.
    pub fn memory_piece(&self, index: u32) -> Result<Option<MemoryPiece>> {
        let mut piece = sys::sphc_memory_piece { name: null(), bytes: 0, scratch: 0, reserved: 0 };
        // SAFETY: [pure].
        let status = self.with_raw(|raw| unsafe { sys::sphc_localizer_memory_piece(raw, index, &mut piece) })?;
        let told = check_with(status, || "the config is not valid; Config::localizer_memory says why")?;
        // SAFETY: names are static storage.
        let name = unsafe { text_of(piece.name) };
        Ok((told == Status::Ok).then_some(MemoryPiece { name, bytes: piece.bytes, is_scratch: piece.scratch != 0 }))
    }

    /// Lends the config to C, where that is the library that this crate was made for.
    pub(crate) fn with_raw<R>(&self, call: impl FnOnce(&sys::sphc_localizer_config) -> R) -> Result<R> {
        check_library()?;
        if self.camera_count > FURTHER_CAMERAS {
            return Err(error!(
                Argument,
                "the rig has {} further cameras, {} is the most", self.camera_count, FURTHER_CAMERAS
            ));
        }
        if self.depth_camera_count > FURTHER_DEPTH_CAMERAS {
            return Err(error!(
                Argument,
                "the rig has {} further depth cameras, {} is the most", self.depth_camera_count, FURTHER_DEPTH_CAMERAS
            ));
        }
        let cameras = self.cameras.map(RigCamera::to_raw);
        let depth_cameras = self.depth_cameras.map(RigDepthCamera::to_raw);
        let raw = sys::sphc_localizer_config {
            struct_size: size_of::<sys::sphc_localizer_config>() as u32,
            max_keypoints: self.max_keypoints,
            max_maps: self.max_maps,
            mode: self.mode.raw(),
            seed: self.seed,
            rig: self.rig.to_raw(),
            depth_min_m: self.depth_min_m,
            depth_max_m: self.depth_max_m,
            depth_sigma_m: self.depth_sigma_m,
            depth_sigma_per_m2: self.depth_sigma_per_m2,
            pixel_sigma_px: self.pixel_sigma_px,
            map_sigma_m: self.map_sigma_m,
            depth_mid_m: self.depth_mid_m,
            depth_offset_sigma_m: self.depth_offset_sigma_m,
            depth_slope_sigma: self.depth_slope_sigma,
            log: self.log.as_ref().map(|(_, hook)| hook.call),
            log_user: self.log.as_ref().map_or(null_mut(), |(_, hook)| hook.user()),
            log_level: self.log.as_ref().map_or(sys::SPHC_LOG_ERROR, |(level, _)| level.raw()),
            reserved: 0,
            clock: self.clock.as_ref().map(|hook| hook.call),
            clock_user: self.clock.as_ref().map_or(null_mut(), Hook::user),
            depth_format: self.depth_format.raw(),
            amplitude_min: self.amplitude_min,
            color_band: self.color_band.raw(),
            reserved2: 0,
            cameras: if self.camera_count == 0 { null() } else { cameras.as_ptr() },
            camera_count: self.camera_count as u32,
            reserved3: 0,
            color_row_time_ns: self.color_row_time_ns,
            parallel: self.parallel.as_ref().map(|(_, hook)| hook.call),
            parallel_user: self.parallel.as_ref().map_or(null_mut(), |(_, hook)| hook.user()),
            parallel_tasks: self.parallel.as_ref().map_or(0, |(tasks, _)| *tasks),
            reserved4: 0,
            depth_cameras: if self.depth_camera_count == 0 { null() } else { depth_cameras.as_ptr() },
            depth_camera_count: self.depth_camera_count as u32,
            reserved5: 0,
        };
        Ok(call(&raw))
    }
}
