//! Rigid transforms, cameras and the rig.
use core::ops::Mul;

use spherecloud_sys as sys;

use crate::error::check;
use crate::{CameraModel, Result};

/// Two types are one to C.
macro_rules! same_layout {
    ($ours:ty, $theirs:ty) => {
        const _: () = assert!(core::mem::size_of::<$ours>() == core::mem::size_of::<$theirs>());
        const _: () = assert!(core::mem::align_of::<$ours>() == core::mem::align_of::<$theirs>());
    };
}
pub(crate) use same_layout;

/// A rigid transform, named `target_from_source` everywhere: x_target = R(q) x_source + t.
///
/// Camera axes are OpenCV's: x right, y down, z forward. The map's frame has its origin at the centre of the sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Rigid {
    /// A unit quaternion, real part first.
    pub q_wxyz: [f64; 4],
    /// In metres.
    pub t_m: [f64; 3],
}
same_layout!(Rigid, sys::sphc_rigid);

impl Rigid {
    /// Where nothing moves.
    pub const IDENTITY: Self = Self { q_wxyz: [1.0, 0.0, 0.0, 0.0], t_m: [0.0; 3] };

    /// `a_from_b` of `b_from_a`.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let mut a_from_b = *self;
        // SAFETY: [pure]; both are of C's layout.
        unsafe { sys::sphc_rigid_inverse(self.as_raw(), a_from_b.as_raw_mut()) };
        a_from_b
    }

    /// x_b = `b_from_a` x_a, in metres.
    pub fn apply(&self, x_a: [f64; 3]) -> [f64; 3] {
        let mut x_b = [0.0; 3];
        // SAFETY: [pure].
        unsafe { sys::sphc_rigid_apply(self.as_raw(), &x_a, &mut x_b) };
        x_b
    }

    pub(crate) fn as_raw(&self) -> *const sys::sphc_rigid {
        (self as *const Self).cast()
    }

    pub(crate) fn as_raw_mut(&mut self) -> *mut sys::sphc_rigid {
        (self as *mut Self).cast()
    }

    pub(crate) fn to_raw(self) -> sys::sphc_rigid {
        sys::sphc_rigid { q_wxyz: self.q_wxyz, t_m: self.t_m }
    }

    pub(crate) fn from_raw(raw: &sys::sphc_rigid) -> Self {
        Self { q_wxyz: raw.q_wxyz, t_m: raw.t_m }
    }
}

impl Default for Rigid {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// `c_from_a = c_from_b * b_from_a`; the quaternion is normalised.
impl Mul for Rigid {
    type Output = Self;
    fn mul(self, b_from_a: Self) -> Self {
        let mut c_from_a = Self::IDENTITY;
        // SAFETY: [pure]; all are of C's layout.
        unsafe { sys::sphc_rigid_compose(self.as_raw(), b_from_a.as_raw(), c_from_a.as_raw_mut()) };
        c_from_a
    }
}

/// Intrinsics of a camera, in pixels of an image of `width` x `height`.
///
/// The centre of the top-left pixel is (0.5, 0.5): add 0.5 to a principal point of OpenCV.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Camera(sys::sphc_camera);

impl Camera {
    /// `params`: fx fy cx cy.
    pub fn pinhole(width: u32, height: u32, params: [f64; 4]) -> Self {
        Self::new(CameraModel::Pinhole, width, height, &params)
    }

    /// `params`: fx fy cx cy k1 k2 p1 p2 k3, in OpenCV's order.
    pub fn brown5(width: u32, height: u32, params: [f64; 9]) -> Self {
        Self::new(CameraModel::Brown5, width, height, &params)
    }

    /// `params`: fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6, OpenCV's rational model.
    pub fn brown8(width: u32, height: u32, params: [f64; 12]) -> Self {
        Self::new(CameraModel::Brown8, width, height, &params)
    }

    /// `params`: fx fy cx cy k1 k2 k3 k4, OpenCV's fisheye.
    pub fn kannala_brandt4(width: u32, height: u32, params: [f64; 8]) -> Self {
        Self::new(CameraModel::KannalaBrandt4, width, height, &params)
    }

    fn new(model: CameraModel, width: u32, height: u32, params: &[f64]) -> Self {
        let mut all = [0.0; 12];
        all[..params.len()].copy_from_slice(params);
        Self(sys::sphc_camera { model: model.raw(), width, height, param_count: params.len() as u32, params: all })
    }

    /// How it projects.
    pub fn model(&self) -> CameraModel {
        CameraModel::from_raw(self.0.model)
    }

    /// Of the image, in pixels.
    pub fn width(&self) -> u32 {
        self.0.width
    }

    /// Of the image, in pixels.
    pub fn height(&self) -> u32 {
        self.0.height
    }

    /// As they were given to the constructor.
    pub fn params(&self) -> &[f64] {
        &self.0.params[..self.0.param_count as usize]
    }

    /// Can it be used? The error names field, cause and cure. Whatever takes a camera asks this.
    pub fn check(&self) -> Result<()> {
        // SAFETY: [pure].
        check(|message| unsafe { sys::sphc_camera_check(&self.0, message) }).map(drop)
    }

    /// The pixel of a point in camera coordinates, in metres. `None`: it is not in front of the camera; it lies more
    /// than about 89 degrees off the axis (83 for the Brown models), or beyond the range in which the distortion is
    /// invertible; or [`Camera::check`] fails.
    pub fn project(&self, point_m: [f64; 3]) -> Option<[f64; 2]> {
        let mut pixel_px = [0.0; 2];
        // SAFETY: [pure].
        let status = unsafe { sys::sphc_camera_project(&self.0, &point_m, &mut pixel_px) };
        (status == sys::SPHC_OK).then_some(pixel_px)
    }

    /// The unit bearing of a pixel in camera coordinates. `None`: no bearing projects there, or [`Camera::check`] fails.
    pub fn unproject(&self, pixel_px: [f64; 2]) -> Option<[f64; 3]> {
        let mut bearing = [0.0; 3];
        // SAFETY: [pure].
        let status = unsafe { sys::sphc_camera_unproject(&self.0, &pixel_px, &mut bearing) };
        (status == sys::SPHC_OK).then_some(bearing)
    }

    pub(crate) fn as_raw(&self) -> *const sys::sphc_camera {
        &self.0
    }

    pub(crate) fn to_raw(self) -> sys::sphc_camera {
        self.0
    }
}

impl core::fmt::Debug for Camera {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(to, "{:?} {} x {} {:?}", self.model(), self.width(), self.height(), self.params())
    }
}

/// The colour and the depth camera of a headset.
///
/// Identity with equal cameras says that the depth image is already registered to colour.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Rig {
    /// The camera whose pose is asked for.
    pub color_camera: Camera,
    /// The time-of-flight camera.
    pub depth_camera: Camera,
    /// Where the depth camera is, seen from the colour camera.
    pub color_from_depth: Rigid,
    /// Metres in a unit of the depth image; 0.001 at first.
    pub depth_unit_m: f64,
}

impl Rig {
    /// Depth in millimetres.
    pub fn new(color_camera: Camera, depth_camera: Camera, color_from_depth: Rigid) -> Self {
        Self { color_camera, depth_camera, color_from_depth, depth_unit_m: 0.001 }
    }

    /// Can it be used? The error names field, cause and cure. Whatever takes a rig asks this.
    pub fn check(&self) -> Result<()> {
        // SAFETY: [pure].
        check(|message| unsafe { sys::sphc_rig_check(&self.to_raw(), message) }).map(drop)
    }

    pub(crate) fn to_raw(self) -> sys::sphc_rig {
        sys::sphc_rig {
            color_camera: self.color_camera.to_raw(),
            depth_camera: self.depth_camera.to_raw(),
            color_from_depth: self.color_from_depth.to_raw(),
            depth_unit_m: self.depth_unit_m,
        }
    }
}
