//! Where is a headset's camera in a map that holds no 3D geometry?
//!
//! A colour image and a time-of-flight depth image go in, and the pose of the colour camera comes out, relative to a map
//! that was built beforehand. This crate is the safe face of the C interface of the SphereCloud SDK.
//!
//! ```no_run
//! use spherecloud::*;
//!
//! # fn frame_of_cameras() -> (Vec<u8>, Vec<u16>, i64) { (vec![], vec![], 0) }
//! fn main() -> Result<()> {
//!     let color = Camera::pinhole(640, 480, [500.0, 500.0, 320.0, 240.0]);
//!     let depth = Camera::pinhole(320, 240, [210.0, 210.0, 160.0, 120.0]);
//!     let mut localizer = Localizer::new(&Config::new(Rig::new(color, depth, Rigid::IDENTITY)))?;
//!     localizer.set_map(0, &Map::open("room.sphc")?)?;
//!     loop {
//!         let (pixels, depths, time_ns) = frame_of_cameras();
//!         let color = Image::new(Format::Gray8, 640, 480, &pixels)?;
//!         let depth = Image::from_u16(Format::Depth16, 320, 240, &depths)?;
//!         let found = localizer.process(&Frame::new(time_ns, color, time_ns, depth))?;
//!         println!("{:?}: {:?}", found.outcome, found.pose);
//!     }
//! }
//! ```
//!
//! # Frames and units
//!
//! `target_from_source` everywhere: x_target = R(q) x_source + t. Camera axes are OpenCV's: x right, y down, z forward.
//! Metres, nanoseconds, radians and pixels; the name says which. The centre of the top-left pixel is (0.5, 0.5).
//!
//! # Threads
//!
//! [`Map`] and [`Features`] are `Send` and `Sync`; [`Localizer`] and [`Aligner`] are `Send`. Functions without an object
//! may run anywhere. The library starts no thread and takes no lock.
//!
//! # Without the standard library
//!
//! The feature `std` is on by default. With `alloc` alone, objects take their memory from the heap, once, when they are
//! made. Without both, memory is handed in: constructors that end in `_in`, and [`Block`]. `static` links the static
//! library, for programs without a loader.
#![cfg_attr(not(feature = "std"), no_std)]
#![warn(missing_docs, missing_debug_implementations, unreachable_pub)]
// Without a heap an error holds its text itself.
#![cfg_attr(not(feature = "alloc"), allow(clippy::result_large_err))]

#[cfg(feature = "alloc")]
extern crate alloc;

mod aligner;
mod config;
mod convention;
#[rustfmt::skip]
mod enums;
mod error;
mod features;
#[cfg(all(test, feature = "std"))]
mod fields;
mod frame;
mod geometry;
mod hooks;
mod image;
mod localizer;
mod map;
mod memory;
mod result;
mod split;
mod values;

pub use aligner::{Aligned, Aligner, AlignerConfig};
pub use config::{Config, MemoryPiece, RigCamera, RigDepthCamera};
pub use enums::*;
pub use error::{check_library, library_version, Error, Result};
pub use features::{FeatureSet, Features, Keypoint, DESCRIPTOR_BYTES};
pub use frame::{DepthView, Frame, Odometry, PosePrior, Prior, UpPrior, View};
pub use geometry::{Camera, Rig, Rigid};
#[cfg(feature = "std")]
pub use hooks::MonotonicClock;
pub use hooks::{Clock, Log, Parallel, Shared, Tasks};
pub use image::Image;
pub use localizer::{Localizer, ParameterRange};
pub use map::{extractor_id, Map, MapInfo};
pub use memory::{bounds, Block, MemoryNeed, MAP_BYTES_MAX};
pub use result::{DepthBias, Hypothesis, Localization, Observation, Pose, Prediction, StageTimes};
pub use split::{Extractor, Locator};

/// The lines of the pages are compiled too.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
#[doc = include_str!("../../../../docs/rust.md")]
pub struct Pages;
