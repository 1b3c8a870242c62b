//! Maps.
use core::marker::PhantomData;
use core::mem::{size_of, zeroed, MaybeUninit};
use core::ptr::{null_mut, NonNull};

use spherecloud_sys as sys;

use crate::error::{bytes_of, check, error};
use crate::memory::Room;
use crate::{check_library, Band, Result};

#[cfg(feature = "alloc")]
use {crate::memory::Buffer, crate::MemoryNeed, alloc::sync::Arc};

/// A handle to a map: an immutable view of a map file.
///
/// Handles are small. A clone is another handle to the same view, which ends with the last of them. A
/// [`Localizer`](crate::Localizer) keeps a handle of its own to each map that it has, so a program may drop its own at
/// any time. `'a` is how long the bytes are borrowed that the handle does not own: `'static` for [`Map::open`] and
/// [`Map::from_bytes`].
///
/// Any thread may use it at any time.
#[derive(Clone)]
pub struct Map<'a> {
    raw: NonNull<sys::sphc_map>,
    // None only where the view lies in memory of the caller's.
    #[cfg(feature = "alloc")]
    owned: Option<Arc<View>>,
    _borrowed: PhantomData<&'a [u8]>,
}

// SAFETY: what is called on a view is [shared], and it ends with its last handle.
unsafe impl Send for Map<'_> {}
// SAFETY: as above.
unsafe impl Sync for Map<'_> {}

/// What is known of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct MapInfo {
    /// Of the file.
    pub format_version: u32,
    /// Real and fake points together; the file does not tell them apart.
    pub point_count: u32,
    /// The id of the keypoint extractor that described the points.
    pub extractor: u32,
    /// Length of the file.
    pub file_bytes: u64,
    /// The name of this release, by what it holds.
    pub map_id: [u8; 16],
    /// Of the images that it was made of.
    pub band: Band,
}

impl<'a> Map<'a> {
    /// Views `file` without a copy. Its first byte is aligned to 8 bytes. Takes a little memory for the view.
    ///
    /// Errors: as of [`Map::open`] but for the reading, and
    /// [`Status::MemoryAlignment`](crate::Status::MemoryAlignment).
    #[cfg(feature = "alloc")]
    pub fn borrow(file: &'a [u8]) -> Result<Self> {
        Self::shared(View::new(None, file)?)
    }

    /// The same in memory of the caller's, of [`MAP_BYTES_MAX`](crate::MAP_BYTES_MAX) bytes in a
    /// [`Block`](crate::Block); takes none of its own.
    ///
    /// The bytes outlive every localizer that has the map:
    ///
    /// ```compile_fail,E0597
    /// # use spherecloud::*;
    /// # fn fails(config: &Config<'static>) -> Result<()> {
    /// let mut localizer = Localizer::new(config)?;
    /// let mut memory = Block::<MAP_BYTES_MAX>::new();
    /// let file = vec![0; 1000];
    /// localizer.set_map(0, &Map::borrow_in(memory.bytes(), &file)?)
    /// # }
    /// ```
    pub fn borrow_in(memory: &'a mut [MaybeUninit<u8>], file: &'a [u8]) -> Result<Self> {
        // The view is never ended: that frees nothing, and nobody can reach it once 'a is over.
        let raw = init(Room::of(memory), file)?;
        Ok(Self {
            raw,
            #[cfg(feature = "alloc")]
            owned: None,
            _borrowed: PhantomData,
        })
    }

    #[cfg(feature = "alloc")]
    fn shared(view: View) -> Result<Self> {
        Ok(Self { raw: view.raw, owned: Some(Arc::new(view)), _borrowed: PhantomData })
    }

    /// What is known of it.
    pub fn info(&self) -> MapInfo {
        // SAFETY: all zero is a value of it, and the size is set before the call, which is [shared].
        let mut raw: sys::sphc_map_info = unsafe { zeroed() };
        raw.struct_size = size_of::<sys::sphc_map_info>() as u32;
        unsafe { sys::sphc_map_get_info(self.raw.as_ptr(), &mut raw) };
        MapInfo {
            format_version: raw.format_version,
            point_count: raw.point_count,
            extractor: raw.extractor,
            file_bytes: raw.file_bytes,
            map_id: raw.map_id,
            band: Band::from_raw(raw.band),
        }
    }

    /// The unit direction of a point from the sphere's centre, in the map's frame. `None` where there is no such point;
    /// the first is 0.
    pub fn direction(&self, point_index: u32) -> Option<[f64; 3]> {
        let mut direction = [0.0; 3];
        // SAFETY: [shared]; the view lives as long as its handle.
        let status = unsafe { sys::sphc_map_direction(self.raw.as_ptr(), point_index, &mut direction) };
        (status == sys::SPHC_OK).then_some(direction)
    }

    pub(crate) fn raw(&self) -> *const sys::sphc_map {
        self.raw.as_ptr()
    }

    /// What must live while C has the view; null where `'a` sees to it.
    #[cfg(feature = "alloc")]
    pub(crate) fn keep(&self) -> Option<Arc<View>> {
        self.owned.clone()
    }
}

#[cfg(feature = "alloc")]
impl Map<'static> {
    /// Views a copy of `file`, at any alignment.
    pub fn from_bytes(file: &[u8]) -> Result<Self> {
        let mut copy = Buffer::new(file.len(), FILE_ALIGNMENT)?;
        copy.bytes()[..file.len()].copy_from_slice(file);
        Self::owning(copy, file.len())
    }

    /// Reads a file, checks all of it, and views it.
    ///
    /// Errors: [`Status::Device`](crate::Status::Device) where the file cannot be read, with the
    /// `std::io::Error` as source;
    /// [`Status::MapFormat`](crate::Status::MapFormat), [`Status::MapVersion`](crate::Status::MapVersion),
    /// [`Status::MapChecksum`](crate::Status::MapChecksum) and [`Status::MapExtractor`](crate::Status::MapExtractor)
    /// where it is no map for this library.
    #[cfg(feature = "std")]
    pub fn open(path: impl AsRef<std::path::Path>) -> Result<Self> {
        let path = path.as_ref();
        let read = || -> std::io::Result<(Result<Buffer>, usize)> {
            let mut file = std::fs::File::open(path)?;
            let bytes = file.metadata()?.len() as usize;
            let mut buffer = Buffer::new(bytes, FILE_ALIGNMENT);
            if let Ok(buffer) = &mut buffer {
                std::io::Read::read_exact(&mut file, &mut buffer.bytes()[..bytes])?;
            }
            Ok((buffer, bytes))
        };
        let (buffer, bytes) =
            read().map_err(|why| error!(Device, "cannot read the map {}: {}", path.display(), why).because(why))?;
        Self::owning(buffer?, bytes)
    }

    fn owning(mut file: Buffer, bytes: usize) -> Result<Self> {
        // SAFETY: the view owns the buffer, whose bytes do not move.
        let seen = unsafe { core::slice::from_raw_parts(file.bytes().as_ptr(), bytes) };
        Self::shared(View::new(Some(file), seen)?)
    }
}

impl core::fmt::Debug for Map<'_> {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Debug::fmt(&self.info(), to)
    }
}

/// As wide as what reads it.
#[cfg(feature = "alloc")]
const FILE_ALIGNMENT: usize = 64;

/// A view with its memory, and its file where it owns one.
#[cfg(feature = "alloc")]
pub(crate) struct View {
    raw: NonNull<sys::sphc_map>,
    _memory: Buffer,
    _file: Option<Buffer>,
}

// SAFETY: as of Map.
#[cfg(feature = "alloc")]
unsafe impl Send for View {}
// SAFETY: as of Map.
#[cfg(feature = "alloc")]
unsafe impl Sync for View {}

#[cfg(feature = "alloc")]
impl View {
    fn new(owned: Option<Buffer>, file: &[u8]) -> Result<Self> {
        let mut need = MemoryNeed::NONE;
        check_library()?;
        // SAFETY: [pure].
        check(|_| unsafe { sys::sphc_map_memory(&mut need) })?;
        let need = MemoryNeed::from_raw(&need);
        let mut memory = Buffer::new(need.state_bytes, need.alignment)?;
        Ok(Self { raw: init(memory.room(), file)?, _memory: memory, _file: owned })
    }
}

#[cfg(feature = "alloc")]
impl Drop for View {
    fn drop(&mut self) {
        let mut raw = self.raw.as_ptr();
        // SAFETY: the last handle is gone, so nothing uses the view.
        unsafe { sys::sphc_map_fini(&mut raw) };
    }
}

fn init(memory: Room, file: &[u8]) -> Result<NonNull<sys::sphc_map>> {
    check_library()?;
    let mut map = null_mut();
    // SAFETY: both are of that many bytes, and whoever called keeps them as long as the view.
    check(|message| unsafe {
        sys::sphc_map_init(memory.data.cast(), memory.bytes, bytes_of(file), file.len(), &mut map, message)
    })?;
    NonNull::new(map).ok_or_else(|| error!(Internal, "the library made no map"))
}

/// The id of this library's keypoint extractor; a map whose points another one described is refused.
pub fn extractor_id() -> u32 {
    // SAFETY: [pure].
    unsafe { sys::sphc_extractor_id() }
}
