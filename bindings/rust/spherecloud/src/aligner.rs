//! A whole depth image, seen from the colour camera.
use core::marker::PhantomData;
use core::mem::{size_of, zeroed, MaybeUninit};
use core::ptr::{null_mut, NonNull};

use spherecloud_sys as sys;

use crate::error::{check, check_with, error, text_of};
use crate::memory::Room;
use crate::{check_library, Format, Image, MemoryNeed, Result, Rig};

#[cfg(feature = "alloc")]
use crate::memory::Buffer;

/// What an aligner is made of. [`AlignerConfig::new`] has the defaults.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct AlignerConfig {
    /// Of the images to align.
    pub depth_format: Format,
    /// The colour and the depth camera.
    pub rig: Rig,
    /// Measurements below are ignored.
    pub depth_min_m: f64,
    /// Measurements above are ignored.
    pub depth_max_m: f64,
    /// Noise of the depth sensor, 1 sigma: sigma(z) = depth_sigma_m + depth_sigma_per_m2 z^2; for the confidence.
    pub depth_sigma_m: f64,
    /// As above.
    pub depth_sigma_per_m2: f64,
    /// Metres in a unit of the aligned image; 0: `rig.depth_unit_m`.
    pub aligned_unit_m: f64,
}

impl AlignerConfig {
    /// The library's defaults for a rig.
    pub fn new(rig: Rig) -> Self {
        // SAFETY: all zero is a value of it; the call is [pure], and the size is right.
        let mut raw: sys::sphc_aligner_config = unsafe { zeroed() };
        unsafe { sys::sphc_aligner_config_init(&mut raw, size_of::<sys::sphc_aligner_config>()) };
        Self {
            depth_format: Format::Depth16,
            rig,
            depth_min_m: raw.depth_min_m,
            depth_max_m: raw.depth_max_m,
            depth_sigma_m: raw.depth_sigma_m,
            depth_sigma_per_m2: raw.depth_sigma_per_m2,
            aligned_unit_m: raw.aligned_unit_m,
        }
    }

    /// What an aligner of this config needs, for [`Aligner::new_in`].
    pub fn memory(&self) -> Result<MemoryNeed> {
        check_library()?;
        let mut need = MemoryNeed::NONE;
        // SAFETY: [pure].
        check(|message| unsafe { sys::sphc_aligner_memory(&self.to_raw(), &mut need, message) })?;
        Ok(MemoryNeed::from_raw(&need))
    }

    fn to_raw(&self) -> sys::sphc_aligner_config {
        sys::sphc_aligner_config {
            struct_size: size_of::<sys::sphc_aligner_config>() as u32,
            depth_format: self.depth_format.raw(),
            rig: self.rig.to_raw(),
            depth_min_m: self.depth_min_m,
            depth_max_m: self.depth_max_m,
            depth_sigma_m: self.depth_sigma_m,
            depth_sigma_per_m2: self.depth_sigma_per_m2,
            aligned_unit_m: self.aligned_unit_m,
        }
    }
}

/// Where an aligned image goes: slices of the colour camera's size, rows without a gap. What is `None` is not made.
#[derive(Debug, Default)]
pub struct Aligned<'d> {
    /// z in the colour camera's frame, in `aligned_unit_m`; 0: none.
    pub depth: Option<&'d mut [u16]>,
    /// Values of [`AlignedPixel`](crate::AlignedPixel).
    pub mask: Option<&'d mut [u8]>,
    /// 255 for an exact depth, 128 for a relative error of 1 % (1 sigma), 51 for 2 %; 0 where there is no depth.
    pub confidence: Option<&'d mut [u8]>,
}

/// Lays depth images on the colour image.
pub struct Aligner<'a> {
    raw: NonNull<sys::sphc_aligner>,
    width: u32,
    height: u32,
    #[cfg(feature = "alloc")]
    _memory: Option<Buffer>,
    _borrowed: PhantomData<&'a mut [u8]>,
}

// SAFETY: no call depends on the thread.
unsafe impl Send for Aligner<'_> {}

impl<'a> Aligner<'a> {
    /// Takes its memory from the heap, here and never again.
    #[cfg(feature = "alloc")]
    pub fn new(config: &AlignerConfig) -> Result<Self> {
        let need = config.memory()?;
        let mut memory = Buffer::new(need.state_bytes, need.alignment)?;
        let mut made = Self::made(config, memory.room())?;
        made._memory = Some(memory);
        Ok(made)
    }

    /// The same in memory of the caller's, as much as [`AlignerConfig::memory`] says and aligned so.
    pub fn new_in(config: &AlignerConfig, memory: &'a mut [MaybeUninit<u8>]) -> Result<Self> {
        Self::made(config, Room::of(memory))
    }

    fn made(config: &AlignerConfig, memory: Room) -> Result<Self> {
        check_library()?;
        let (told, mut raw) = (config.to_raw(), null_mut());
        // SAFETY: the memory is of that many bytes and lives as long as the aligner.
        check(|message| unsafe { sys::sphc_aligner_init(memory.data.cast(), memory.bytes, &told, &mut raw, message) })?;
        let none = || error!(Internal, "the library made no aligner");
        Ok(Self {
            raw: NonNull::new(raw).ok_or_else(none)?,
            width: told.rig.color_camera.width,
            height: told.rig.color_camera.height,
            #[cfg(feature = "alloc")]
            _memory: None,
            _borrowed: PhantomData,
        })
    }

    /// Aligns one depth image. The same image gives the same bytes on every machine. Takes no memory.
    ///
    /// Errors: [`Status::Image`](crate::Status::Image) where the image does not fit the config,
    /// [`Status::Argument`](crate::Status::Argument) where a slice is too small; the next one may do.
    pub fn process(&mut self, depth: &Image<'_>, aligned: &mut Aligned<'_>) -> Result<()> {
        let told = sys::sphc_aligned {
            struct_size: size_of::<sys::sphc_aligned>() as u32,
            depth_stride_bytes: 2 * self.width,
            mask_stride_bytes: self.width,
            confidence_stride_bytes: self.width,
            depth: self.room("depth", &mut aligned.depth)?,
            mask: self.room("mask", &mut aligned.mask)?,
            confidence: self.room("confidence", &mut aligned.confidence)?,
        };
        // SAFETY: [exclusive], by &mut; each slice holds an image of that stride.
        let status = unsafe { sys::sphc_aligner_process(self.raw.as_ptr(), &depth.to_raw(), &told) };
        // SAFETY: the same; it is read before the next call.
        check_with(status, || unsafe { text_of(sys::sphc_aligner_message(self.raw.as_ptr())) }).map(drop)
    }

    fn room<T>(&self, name: &str, slice: &mut Option<&mut [T]>) -> Result<*mut T> {
        let needed = self.width as usize * self.height as usize;
        match slice {
            None => Ok(null_mut()),
            Some(slice) if slice.len() >= needed => Ok(slice.as_mut_ptr()),
            Some(slice) => {
                Err(error!(Argument, "aligned.{} has room for {} pixels, needs {}", name, slice.len(), needed))
            }
        }
    }
}

impl Drop for Aligner<'_> {
    fn drop(&mut self) {
        let mut raw = self.raw.as_ptr();
        // SAFETY: nothing else uses it; its memory goes afterwards.
        unsafe { sys::sphc_aligner_fini(&mut raw) };
    }
}

impl core::fmt::Debug for Aligner<'_> {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(to, "Aligner to {} x {}", self.width, self.height)
    }
}
