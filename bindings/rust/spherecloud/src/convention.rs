//! Poses as OpenXR, Unity, ROS, COLMAP and TUM state them.
use core::ptr::null;

use spherecloud_sys as sys;

use crate::error::check;
use crate::{Convention, Result, Rigid};

/// Poses are seven numbers in the convention's own order. `world_from_map` says where the map lies in the other
/// system's world, and is right-handed even where that system is not. `None` is the map's own frame, for
/// [`Convention::Colmap`] and [`Convention::Tum`] alone.
///
/// Errors: [`Status::Argument`](crate::Status::Argument) for what is not finite or beyond a limit, and
/// [`Status::Unsupported`](crate::Status::Unsupported) for a convention that the library does not know.
impl Convention {
    /// `world_from_map` of a gravity-aligned world with the map's origin. `up_map` points upwards in the map's frame,
    /// at any length but 0.
    pub fn make_world(self, up_map: [f64; 3]) -> Result<Rigid> {
        rigid(|world_from_map, message| unsafe {
            sys::sphc_convention_make_world(self.raw(), &up_map, world_from_map, message)
        })
    }

    /// A camera's pose to the other system: world_from_camera, but for COLMAP.
    pub fn write_camera(self, world_from_map: Option<&Rigid>, camera_from_map: &Rigid) -> Result<[f64; 7]> {
        let world = world_from_map.map_or(null(), Rigid::as_raw);
        numbers(|pose, message| unsafe {
            sys::sphc_convention_write_camera(self.raw(), world, camera_from_map.as_raw(), pose, message)
        })
    }

    /// `camera_from_map` of a camera's pose in the other system. To read a pose in a world that is no map, such as
    /// that of odometry, give the identity; what comes out is camera_from_world.
    pub fn read_camera(self, world_from_map: Option<&Rigid>, pose: &[f64; 7]) -> Result<Rigid> {
        let world = world_from_map.map_or(null(), Rigid::as_raw);
        rigid(|camera_from_map, message| unsafe {
            sys::sphc_convention_read_camera(self.raw(), world, pose, camera_from_map, message)
        })
    }

    /// The map's pose in the other system's world.
    pub fn write_map(self, world_from_map: &Rigid) -> Result<[f64; 7]> {
        numbers(|pose, message| unsafe {
            sys::sphc_convention_write_map(self.raw(), world_from_map.as_raw(), pose, message)
        })
    }

    /// `world_from_map` of the map's pose in the other system's world.
    pub fn read_map(self, pose: &[f64; 7]) -> Result<Rigid> {
        rigid(|world_from_map, message| unsafe {
            sys::sphc_convention_read_map(self.raw(), pose, world_from_map, message)
        })
    }
}

fn rigid(call: impl FnOnce(*mut sys::sphc_rigid, *mut sys::sphc_message) -> sys::sphc_status) -> Result<Rigid> {
    let mut made = Rigid::IDENTITY;
    check(|message| call(made.as_raw_mut(), message))?;
    Ok(made)
}

fn numbers(call: impl FnOnce(*mut [f64; 7], *mut sys::sphc_message) -> sys::sphc_status) -> Result<[f64; 7]> {
    let mut pose = [0.0; 7];
    check(|message| call(&mut pose, message))?;
    Ok(pose)
}
