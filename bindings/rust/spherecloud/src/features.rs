//! What a colour image shows, between the two halves of a frame.
use core::marker::PhantomData;
use core::mem::{size_of, zeroed, MaybeUninit};
use core::ptr::{null, null_mut, NonNull};

use spherecloud_sys as sys;

use crate::error::{check, check_with, error, text_of};
use crate::geometry::same_layout;
use crate::hooks::panics;
use crate::memory::Room;
use crate::{Config, Frame, Result};

#[cfg(feature = "alloc")]
use crate::memory::Buffer;

/// Bytes of a descriptor.
pub const DESCRIPTOR_BYTES: usize = sys::SPHC_DESCRIPTOR_BYTES as usize;

/// Where a feature lies in the image of its camera, x right, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Keypoint {
    /// 0 to the image's width.
    pub x_px: f32,
    /// 0 to the image's height.
    pub y_px: f32,
    /// Standard deviation of the Gaussian at which it was found; above 0, 8192 at most.
    pub scale_px: f32,
    /// Of the dominant gradient, from x to y; -7 to 7.
    pub angle_rad: f32,
    /// |difference of Gaussians| there, grey levels in 0 to 1; 0 to 1.
    pub response: f32,
}
same_layout!(Keypoint, sys::sphc_keypoint);

/// Keypoints with their descriptors, the strongest response first.
#[derive(Clone, Copy, Debug)]
pub struct FeatureSet<'f> {
    /// The extractor that described them: [`extractor_id`](crate::extractor_id), as that of all maps.
    pub extractor: u32,
    /// Where they are.
    pub keypoints: &'f [Keypoint],
    /// Of each keypoint.
    pub descriptors: &'f [[u8; DESCRIPTOR_BYTES]],
    /// Of each keypoint: 0 the colour camera, i the i-th further camera. `None`: all of the colour camera.
    pub cameras: Option<&'f [u8]>,
}

/// Room for the features of a frame; filled, located and filled again.
///
/// Several localizers may locate the same features at the same time.
pub struct Features<'a> {
    raw: NonNull<sys::sphc_features>,
    #[cfg(feature = "alloc")]
    _memory: Option<Buffer>,
    _borrowed: PhantomData<&'a mut [u8]>,
}

// SAFETY: no call depends on the thread.
unsafe impl Send for Features<'_> {}
// SAFETY: what is called with & is [shared].
unsafe impl Sync for Features<'_> {}

impl<'a> Features<'a> {
    /// For localizers of this config. Takes its memory from the heap, here and never again.
    #[cfg(feature = "alloc")]
    pub fn new(config: &Config<'_>) -> Result<Self> {
        let need = config.features_memory()?;
        let mut memory = Buffer::new(need.state_bytes, need.alignment)?;
        let mut made = Self::made(config, memory.room())?;
        made._memory = Some(memory);
        Ok(made)
    }

    /// The same in memory of the caller's, as much as [`Config::features_memory`] says and aligned so.
    pub fn new_in(config: &Config<'_>, memory: &'a mut [MaybeUninit<u8>]) -> Result<Self> {
        Self::made(config, Room::of(memory))
    }

    fn made(config: &Config<'_>, memory: Room) -> Result<Self> {
        let mut raw = null_mut();
        // SAFETY: the memory is of that many bytes and lives as long as the features.
        config.with_raw(|config| {
            check(|message| unsafe {
                sys::sphc_features_init(memory.data.cast(), memory.bytes, config, &mut raw, message)
            })
        })??;
        let none = || error!(Internal, "the library made no features");
        Ok(Self {
            raw: NonNull::new(raw).ok_or_else(none)?,
            #[cfg(feature = "alloc")]
            _memory: None,
            _borrowed: PhantomData,
        })
    }

    /// Puts features in that other hardware found. Of `frame` the colour image and its time are read, for faults and
    /// hints. Everything is copied.
    ///
    /// Errors: [`Status::Argument`](crate::Status::Argument) where lengths differ, or a keypoint is beyond the limits
    /// or stronger than the one before it; [`Status::Capacity`](crate::Status::Capacity) for more than
    /// `config.max_keypoints`; [`Status::MapExtractor`](crate::Status::MapExtractor) for those of another extractor;
    /// [`Status::Image`](crate::Status::Image). The features stay what they were.
    pub fn set(&mut self, frame: &Frame<'_>, set: &FeatureSet<'_>) -> Result<()> {
        let count = set.keypoints.len();
        if set.descriptors.len() != count || set.cameras.map_or(false, |cameras| cameras.len() != count) {
            return Err(error!(Argument, "there are {} keypoints and {} descriptors", count, set.descriptors.len()));
        }
        let arrays = sys::sphc_features_arrays {
            struct_size: size_of::<sys::sphc_features_arrays>() as u32,
            extractor: set.extractor,
            count: count as u32,
            keypoint_stride_bytes: size_of::<Keypoint>() as u32,
            descriptor_stride_bytes: DESCRIPTOR_BYTES as u32,
            reserved: 0,
            keypoints: set.keypoints.as_ptr().cast(),
            descriptors: set.descriptors.as_ptr().cast(),
            cameras: set.cameras.map_or(null(), <[u8]>::as_ptr),
        };
        // SAFETY: [exclusive], by &mut; the arrays have so many elements.
        self.done(|raw| frame.with_raw(|frame| unsafe { sys::sphc_features_set(raw, frame, &arrays) }))
    }

    /// Reads them in place. Errors: [`Status::State`](crate::Status::State) where they are of no frame yet.
    pub fn get(&self) -> Result<FeatureSet<'_>> {
        // SAFETY: all zero is a value of it; the call is [shared].
        let mut arrays: sys::sphc_features_arrays = unsafe { zeroed() };
        arrays.struct_size = size_of::<sys::sphc_features_arrays>() as u32;
        check_with(unsafe { sys::sphc_features_get(self.raw.as_ptr(), &mut arrays) }, || {
            "the features are of no frame yet; extract or set them first"
        })?;
        if arrays.keypoint_stride_bytes as usize != size_of::<Keypoint>()
            || arrays.descriptor_stride_bytes as usize != DESCRIPTOR_BYTES
        {
            return Err(error!(Unsupported, "the library's features have gaps between them"));
        }
        let count = arrays.count as usize;
        // SAFETY: they have so many elements, and stay until the next call with &mut.
        unsafe {
            Ok(FeatureSet {
                extractor: arrays.extractor,
                keypoints: slice(arrays.keypoints.cast(), count),
                descriptors: slice(arrays.descriptors.cast(), count),
                cameras: (!arrays.cameras.is_null()).then(|| slice(arrays.cameras, count)),
            })
        }
    }

    pub(crate) fn raw(&self) -> *const sys::sphc_features {
        self.raw.as_ptr()
    }

    /// Fills them by `call`.
    pub(crate) fn done(
        &mut self,
        call: impl FnOnce(*mut sys::sphc_features) -> Result<sys::sphc_status>,
    ) -> Result<()> {
        let status = call(self.raw.as_ptr())?;
        panics::go_on();
        // SAFETY: [exclusive], by &mut; it is read before the next call.
        check_with(status, || unsafe { text_of(sys::sphc_features_message(self.raw.as_ptr())) }).map(drop)
    }
}

/// A slice of C, which may have null where it has no elements.
unsafe fn slice<'f, T>(from: *const T, count: usize) -> &'f [T] {
    match count {
        0 => &[],
        _ => core::slice::from_raw_parts(from, count),
    }
}

impl Drop for Features<'_> {
    fn drop(&mut self) {
        let mut raw = self.raw.as_ptr();
        // SAFETY: nothing else uses them; their memory goes afterwards.
        unsafe { sys::sphc_features_fini(&mut raw) };
    }
}

impl core::fmt::Debug for Features<'_> {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(to, "{} features", self.get().map_or(0, |set| set.keypoints.len()))
    }
}
