//! The memory of objects: from the heap once, or the caller's.
use core::mem::MaybeUninit;

use spherecloud_sys as sys;

/// What an object needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryNeed {
    /// Bytes that live as long as the object.
    pub state_bytes: usize,
    /// Bytes that are used only inside a call.
    pub scratch_bytes: usize,
    /// Of both, in bytes.
    pub alignment: usize,
}

impl MemoryNeed {
    pub(crate) fn from_raw(raw: &sys::sphc_memory) -> Self {
        Self {
            state_bytes: raw.state_bytes as usize,
            scratch_bytes: raw.scratch_bytes as usize,
            alignment: raw.alignment as usize,
        }
    }

    pub(crate) const NONE: sys::sphc_memory =
        sys::sphc_memory { state_bytes: 0, scratch_bytes: 0, alignment: 0, reserved: 0 };
}

/// `N` bytes at the alignment that objects want, for those who have no heap.
///
/// ```
/// use spherecloud::{Block, MAP_BYTES_MAX};
/// let mut memory = Block::<MAP_BYTES_MAX>::new();
/// assert_eq!(memory.bytes().len(), 256);
/// ```
#[repr(C, align(64))]
pub struct Block<const N: usize>([MaybeUninit<u8>; N]);

impl<const N: usize> Block<N> {
    /// Bytes of no value yet.
    #[allow(clippy::new_without_default)]
    pub const fn new() -> Self {
        Self([MaybeUninit::uninit(); N])
    }

    /// What constructors with `_in` take.
    pub fn bytes(&mut self) -> &mut [MaybeUninit<u8>] {
        &mut self.0
    }
}

impl<const N: usize> core::fmt::Debug for Block<N> {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(to, "Block of {} bytes", N)
    }
}

/// Bytes that [`Map::borrow_in`](crate::Map::borrow_in) needs at most, in any library of this ABI.
pub const MAP_BYTES_MAX: usize = sys::SPHC_MAP_BYTES_MAX as usize;

/// Upper bounds of what localizers, features and aligners need, in any library of this ABI: for memory whose size the
/// compiler must know, such as `Block<{ bounds::localizer_state(800, 4) }>`. Of sizes of images count the largest width
/// and the largest height of all cameras but depth cameras. The macros `_BYTES_MAX` of the C header, in bytes.
pub mod bounds {
    /// State of a localizer.
    pub const fn localizer_state(max_keypoints: usize, max_maps: usize) -> usize {
        98304 + 160 * max_keypoints + 256 * max_maps
    }

    /// Scratch of a localizer.
    pub const fn localizer_scratch(max_keypoints: usize, width: usize, height: usize) -> usize {
        4194304 + 2048 * max_keypoints + 512 * (width + height) + 10 * width * height
    }

    /// Added to state and to scratch where the depth's format is not [`Depth16`](crate::Format::Depth16), or
    /// `config.amplitude_min` is set; of the depth image.
    pub const fn localizer_depth(width: usize, height: usize) -> usize {
        65536 + 2 * width * height
    }

    /// Added to state and to scratch where the rig has further cameras.
    pub const fn localizer_cameras(max_keypoints: usize, width: usize, height: usize) -> usize {
        65536 + 256 * max_keypoints + width * height
    }

    /// Added to state and to scratch where the rig has a second depth camera, beside what its own format and
    /// `amplitude_min` add by [`localizer_depth`]; of its image.
    pub const fn localizer_depth_camera(width: usize, height: usize) -> usize {
        65536 + width * height
    }

    /// Added to scratch where a frame's work is cut into `tasks` pieces.
    pub const fn localizer_parallel(max_keypoints: usize, width: usize, tasks: usize) -> usize {
        tasks * (65536 + 128 * max_keypoints + 1024 * width)
    }

    /// Features.
    pub const fn features(max_keypoints: usize, width: usize, height: usize) -> usize {
        4096 + 192 * max_keypoints + width * height
    }

    /// An aligner; of the depth image and of the colour image.
    pub const fn aligner(depth_width: usize, depth_height: usize, width: usize, height: usize) -> usize {
        65536 + 16 * (depth_width + 64) * (depth_height + 16) + 10 * (width + 64) * (height + 16)
    }
}

#[cfg(feature = "alloc")]
pub(crate) use heap::Buffer;

#[cfg(feature = "alloc")]
mod heap {
    use alloc::alloc::{alloc_zeroed, dealloc, Layout};
    use core::mem::MaybeUninit;
    use core::ptr::NonNull;

    use crate::error::error;
    use crate::{MemoryNeed, Result};

    /// Aligned bytes of the heap.
    pub(crate) struct Buffer {
        data: NonNull<MaybeUninit<u8>>,
        layout: Layout,
    }

    // SAFETY: it owns its bytes.
    unsafe impl Send for Buffer {}
    // SAFETY: as above.
    unsafe impl Sync for Buffer {}

    impl Buffer {
        /// Zeroed; fails with MEMORY_SIZE where there is no memory.
        pub(crate) fn new(bytes: usize, alignment: usize) -> Result<Self> {
            let none = || error!(MemorySize, "the heap has no {} bytes left", bytes);
            let layout = Layout::from_size_align(bytes.max(1), alignment.max(1)).map_err(|_| none())?;
            // SAFETY: the size is not 0.
            let data = NonNull::new(unsafe { alloc_zeroed(layout) }).ok_or_else(none)?;
            Ok(Self { data: data.cast(), layout })
        }

        /// State and scratch.
        pub(crate) fn pair(need: &MemoryNeed) -> Result<(Self, Self)> {
            Ok((Self::new(need.state_bytes, need.alignment)?, Self::new(need.scratch_bytes, need.alignment)?))
        }

        /// All of it, initialised.
        pub(crate) fn bytes(&mut self) -> &mut [u8] {
            // SAFETY: it was zeroed when it was made.
            unsafe { core::slice::from_raw_parts_mut(self.data.as_ptr().cast(), self.layout.size()) }
        }

        /// All of it, for an object to live in.
        pub(crate) fn room(&mut self) -> Room {
            Room { data: self.data.as_ptr(), bytes: self.layout.size() }
        }
    }

    use super::Room;

    impl Drop for Buffer {
        fn drop(&mut self) {
            // SAFETY: this layout was allocated.
            unsafe { dealloc(self.data.as_ptr().cast(), self.layout) };
        }
    }
}

/// Memory as C takes it; whoever makes an object in it keeps it as long as the object.
#[derive(Clone, Copy)]
pub(crate) struct Room {
    pub(crate) data: *mut MaybeUninit<u8>,
    pub(crate) bytes: usize,
}

impl Room {
    pub(crate) fn of(memory: &mut [MaybeUninit<u8>]) -> Self {
        Self { data: memory.as_mut_ptr(), bytes: memory.len() }
    }
}
