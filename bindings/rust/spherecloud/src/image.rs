//! Borrowed images.
use core::ffi::c_void;
use core::marker::PhantomData;
use core::mem::{size_of, size_of_val};

use spherecloud_sys as sys;

use crate::error::{bytes_of, error};
use crate::{Format, Result};

/// Pixels of the caller's, borrowed, of which no byte is copied.
///
/// The constructors check that the slice holds all rows, so that the library never reads beyond it. They fail with
/// [`Status::Image`](crate::Status::Image). Does the image fit the config? The call that takes it says so.
#[derive(Clone, Copy)]
pub struct Image<'a> {
    raw: sys::sphc_image,
    _data: PhantomData<&'a [u8]>,
}

// SAFETY: it is a shared slice.
unsafe impl Send for Image<'_> {}
// SAFETY: as above.
unsafe impl Sync for Image<'_> {}

impl<'a> Image<'a> {
    /// Rows without a gap; [`Image::with_stride`] has the rest.
    pub fn new(format: Format, width: u32, height: u32, data: &'a [u8]) -> Result<Self> {
        Self::of(format, width, height, format.row_bytes(width), bytes_of(data), data.len())
    }

    /// `stride_bytes` from a row to the next. `data` begins with the top-left pixel, of the first plane where there
    /// are several, and may end with the last pixel. Planes behind the first are not read.
    pub fn with_stride(format: Format, width: u32, height: u32, stride_bytes: u32, data: &'a [u8]) -> Result<Self> {
        Self::of(format, width, height, stride_bytes, bytes_of(data), data.len())
    }

    /// Rows without a gap of a format of 16 bits, such as [`Format::Depth16`].
    pub fn from_u16(format: Format, width: u32, height: u32, data: &'a [u16]) -> Result<Self> {
        Self::typed(format, width, height, data)
    }

    /// Rows without a gap of a format of floats, such as [`Format::DepthF32`].
    pub fn from_f32(format: Format, width: u32, height: u32, data: &'a [f32]) -> Result<Self> {
        Self::typed(format, width, height, data)
    }

    fn typed<T>(format: Format, width: u32, height: u32, data: &'a [T]) -> Result<Self> {
        if format.bytes() as usize != size_of::<T>() {
            return Err(error!(
                Image,
                "{} is no format of {} bytes a pixel; give bytes",
                format.name(),
                size_of::<T>()
            ));
        }
        Self::of(format, width, height, format.row_bytes(width), bytes_of(data), size_of_val(data))
    }

    fn of(format: Format, width: u32, height: u32, stride: u32, data: *const c_void, bytes: usize) -> Result<Self> {
        let (row, name) = (format.row_bytes(width), format.name());
        if width == 0 || height == 0 {
            return Err(error!(Image, "an image of {} x {} pixels has none; give 1 or more of each", width, height));
        }
        if row == 0 {
            return Err(error!(
                Image,
                "format {} ({}) has no rows of {} pixels; give a format that the library knows, and a width that its \
                 pixels share bytes by",
                format.raw(),
                name,
                width
            ));
        }
        if stride < row {
            return Err(error!(
                Image,
                "the stride is {} bytes, but {} pixels {} take {}; give that or more", stride, width, name, row
            ));
        }
        let needed = u64::from(height - 1) * u64::from(stride) + u64::from(row);
        if (bytes as u64) < needed {
            return Err(error!(Image, "the slice has {} bytes, {} x {} needs {}", bytes, width, height, needed));
        }
        let raw = sys::sphc_image { data, width, height, stride_bytes: stride, format: format.raw() };
        Ok(Self { raw, _data: PhantomData })
    }

    /// In pixels.
    pub fn width(&self) -> u32 {
        self.raw.width
    }

    /// In pixels.
    pub fn height(&self) -> u32 {
        self.raw.height
    }

    /// How its pixels lie.
    pub fn format(&self) -> Format {
        Format::from_raw(self.raw.format)
    }

    pub(crate) fn to_raw(self) -> sys::sphc_image {
        self.raw
    }

    /// What is not there: the library says so where it is needed.
    pub(crate) fn none() -> sys::sphc_image {
        sys::sphc_image { data: core::ptr::null(), width: 0, height: 0, stride_bytes: 0, format: 0 }
    }
}

impl core::fmt::Debug for Image<'_> {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(to, "{:?} {} x {}", self.format(), self.width(), self.height())
    }
}

impl Format {
    /// Bytes of a pixel; 0 for a format that the library does not know, or whose pixels share bytes.
    pub fn bytes(self) -> u32 {
        // SAFETY: [pure].
        unsafe { sys::sphc_format_bytes(self.raw()) }
    }

    /// Bytes of a row of so many pixels, the least stride; 0 for a width that the format cannot have.
    pub fn row_bytes(self, width: u32) -> u32 {
        // SAFETY: [pure].
        unsafe { sys::sphc_format_row_bytes(self.raw(), width) }
    }
}
