//! The localizer.
use core::marker::PhantomData;
use core::mem::{size_of, zeroed, MaybeUninit};
use core::ptr::{null, null_mut, NonNull};

use spherecloud_sys as sys;

use crate::error::{check, check_with, error, text_of};
use crate::hooks::panics;
use crate::memory::Room;
use crate::{
    Config, DepthBias, Frame, Hypothesis, Localization, Map, Observation, Parameter, Prediction, Result, Rigid, Status,
};

#[cfg(feature = "alloc")]
use {
    crate::map::View,
    crate::memory::Buffer,
    alloc::{sync::Arc, vec::Vec},
};

/// Says where the colour camera is in its maps.
///
/// It is made once, with all of its memory; no frame takes more. `'a` is how long everything is borrowed that it was
/// given and does not own: memory of [`Localizer::new_in`], bytes of [`Map::borrow`], callbacks that are references.
/// Where nothing is borrowed that is `'static`.
///
/// One thread at a time uses it, and it may move between threads:
///
/// ```compile_fail,E0277
/// fn shared<T: Sync>() {}
/// shared::<spherecloud::Localizer<'static>>();
/// ```
pub struct Localizer<'a> {
    raw: NonNull<sys::sphc_localizer>,
    // Maps with their ids, as far as they own something.
    #[cfg(feature = "alloc")]
    maps: Vec<(u32, Arc<View>)>,
    #[cfg(feature = "alloc")]
    _memory: Option<(Buffer, Buffer)>,
    // Its callbacks; of the rest nothing is used.
    _config: Config<'a>,
    _borrowed: PhantomData<&'a mut [u8]>,
}

// SAFETY: no call depends on the thread, and what it has of others (maps, callbacks, memory) is Send.
unsafe impl Send for Localizer<'_> {}

impl<'a> Localizer<'a> {
    /// Takes its memory from the heap, here and never again. It has no map yet.
    ///
    /// Errors: [`Status::Argument`] where the config is not valid, [`Status::MemorySize`], [`Status::Unsupported`].
    #[cfg(feature = "alloc")]
    pub fn new(config: &Config<'a>) -> Result<Self> {
        let (mut state, mut scratch) = Buffer::pair(&config.localizer_memory()?)?;
        let mut made = Self::made(config, state.room(), scratch.room())?;
        made.maps.reserve_exact(config.max_maps as usize + 1);
        made._memory = Some((state, scratch));
        Ok(made)
    }

    /// The same in memory of the caller's, as much of each as [`Config::localizer_memory`] says and aligned so.
    /// [`Block`](crate::Block) is aligned well.
    ///
    /// Errors: also [`Status::MemoryAlignment`].
    pub fn new_in(
        config: &Config<'a>,
        state: &'a mut [MaybeUninit<u8>],
        scratch: &'a mut [MaybeUninit<u8>],
    ) -> Result<Self> {
        Self::made(config, Room::of(state), Room::of(scratch))
    }

    fn made(config: &Config<'a>, state: Room, scratch: Room) -> Result<Self> {
        let mut raw = null_mut();
        // SAFETY: both are of that many bytes, do not overlap, and live as long as the localizer.
        config.with_raw(|config| {
            check(|message| unsafe {
                let (state_data, scratch_data) = (state.data.cast(), scratch.data.cast());
                sys::sphc_localizer_init(
                    state_data,
                    state.bytes,
                    scratch_data,
                    scratch.bytes,
                    config,
                    &mut raw,
                    message,
                )
            })
        })??;
        panics::go_on();
        let none = || error!(Internal, "the library made no localizer");
        Ok(Self {
            raw: NonNull::new(raw).ok_or_else(none)?,
            #[cfg(feature = "alloc")]
            maps: Vec::new(),
            #[cfg(feature = "alloc")]
            _memory: None,
            _config: config.clone(),
            _borrowed: PhantomData,
        })
    }

    /// Gives it a map under an id of the caller's, or replaces the one of that id by a newer release of the same place.
    /// It keeps a handle until the map is replaced or removed.
    ///
    /// Errors: [`Status::Argument`] where the map's band is not that of the config, among others;
    /// [`Status::Capacity`] where `config.max_maps` are there.
    pub fn set_map(&mut self, map_id: u32, map: &Map<'a>) -> Result<()> {
        // Kept before the call, for a callback's panic may follow it.
        #[cfg(feature = "alloc")]
        let before = self.maps.len();
        #[cfg(feature = "alloc")]
        self.maps.extend(map.keep().map(|view| (map_id, view)));
        // SAFETY: [exclusive], by &mut; the view lives by the handle that is kept, or for 'a.
        let status = unsafe { sys::sphc_localizer_set_map(self.raw.as_ptr(), map_id, map.raw()) };
        #[cfg(feature = "alloc")]
        if status < 0 {
            self.maps.truncate(before);
        } else if let Some(replaced) = self.maps[..before].iter().position(|(id, _)| *id == map_id) {
            self.maps.swap_remove(replaced);
        }
        self.done(status)
    }

    /// Takes a map away; what was tracked in it is forgotten. Errors: [`Status::Argument`] where there is none.
    pub fn remove_map(&mut self, map_id: u32) -> Result<()> {
        // SAFETY: [exclusive], by &mut.
        self.done(unsafe { sys::sphc_localizer_remove_map(self.raw.as_ptr(), map_id) })?;
        #[cfg(feature = "alloc")]
        self.maps.retain(|(id, _)| *id != map_id);
        Ok(())
    }

    /// Says where a map lies in a frame that several maps share, with its errors, 1 sigma an axis: 0 to 0.5 rad about
    /// the map's origin, 0 to 100 m. A camera that leaves a map is then expected in the others that have a transform.
    pub fn set_map_transform(
        &mut self,
        map_id: u32,
        common_from_map: &Rigid,
        rotation_sigma_rad: f64,
        translation_sigma_m: f64,
    ) -> Result<()> {
        let (rotation, translation) = (rotation_sigma_rad, translation_sigma_m);
        let common = common_from_map.as_raw();
        // SAFETY: [exclusive], by &mut.
        self.done(unsafe {
            sys::sphc_localizer_set_map_transform(self.raw.as_ptr(), map_id, common, rotation, translation)
        })
    }

    /// Takes a map's transform away.
    pub fn clear_map_transform(&mut self, map_id: u32) -> Result<()> {
        // SAFETY: [exclusive], by &mut.
        self.done(unsafe { sys::sphc_localizer_set_map_transform(self.raw.as_ptr(), map_id, null(), 0.0, 0.0) })
    }

    /// How many maps it has.
    pub fn map_count(&self) -> u32 {
        // SAFETY: [exclusive], for it is not Sync.
        unsafe { sys::sphc_localizer_map_count(self.raw.as_ptr()) }
    }

    /// Where was the colour camera? That no pose was found is an answer and no error: [`Localization::outcome`] says
    /// why. Takes no memory and calls nothing but the config's callbacks.
    ///
    /// Errors: [`Status::Argument`] and [`Status::Image`], where the frame does not fit the config; the next one may.
    pub fn process(&mut self, frame: &Frame<'_>) -> Result<Localization> {
        let raw = self.raw.as_ptr();
        // SAFETY: [exclusive], by &mut.
        self.answer(|result| frame.with_raw(|frame| unsafe { sys::sphc_localizer_process(raw, frame, result) }))
    }

    /// The two halves of a frame, for two threads: while one locates a frame, the other may extract the features of the
    /// next.
    ///
    /// ```no_run
    /// # use spherecloud::*;
    /// # fn two_at_once(localizer: &mut Localizer<'_>, next: &Frame<'_>, frame: &Frame<'_>,
    /// #                found: &Features<'_>, features: &mut Features<'_>) -> Result<()> {
    /// let (mut extractor, mut locator) = localizer.split();
    /// std::thread::scope(|scope| {
    ///     let extracted = scope.spawn(move || extractor.extract(next, features));
    ///     let located = locator.locate(frame, found)?;
    ///     println!("{:?}", located.pose);
    ///     extracted.join().unwrap()
    /// })
    /// # }
    /// ```
    ///
    /// A frame cannot be processed meanwhile:
    ///
    /// ```compile_fail,E0499
    /// # use spherecloud::*;
    /// # fn fails(localizer: &mut Localizer<'_>, frame: &Frame<'_>, features: &mut Features<'_>) -> Result<()> {
    /// let (mut extractor, locator) = localizer.split();
    /// localizer.process(frame)?;
    /// extractor.extract(frame, features)
    /// # }
    /// ```
    pub fn split(&mut self) -> (crate::Extractor<'_>, crate::Locator<'_, 'a>) {
        crate::split::split(self)
    }

    /// Where the camera is at `time_ns`, in the time of frames: after the last pose, or up to 100 ms before it (where
    /// odometry goes on from it: before the last frame).
    /// `None`: there is no pose within the second before, or the mode is [`Mode::Single`](crate::Mode::Single).
    pub fn predict(&self, time_ns: i64) -> Result<Option<Prediction>> {
        // SAFETY: all zero is a value of it. [exclusive], for it is not Sync.
        let mut raw: sys::sphc_localizer_prediction = unsafe { zeroed() };
        raw.struct_size = size_of::<sys::sphc_localizer_prediction>() as u32;
        let status = unsafe { sys::sphc_localizer_predict(self.raw.as_ptr(), time_ns, &mut raw) };
        let told = check_with(status, || "")?;
        Ok((told == Status::Ok).then(|| Prediction::from_raw(&raw)))
    }

    /// What became of the keypoints of the last frame.
    #[cfg(feature = "alloc")]
    pub fn observations(&self) -> Result<Vec<Observation>> {
        let count = self.observations_into(&mut [])?;
        let mut made = alloc::vec![Observation::default(); count];
        self.observations_into(&mut made)?;
        Ok(made)
    }

    /// Copies as many as there is room for, and says how many there are.
    pub fn observations_into(&self, observations: &mut [Observation]) -> Result<usize> {
        let stride = size_of::<sys::sphc_localizer_observation>() as u32;
        let (to, capacity) = (observations.as_mut_ptr().cast(), observations.len() as u32);
        let mut count = 0;
        // SAFETY: [exclusive], for it is not Sync; the layouts are the same, and any bits are a value.
        let status = unsafe { sys::sphc_localizer_observations(self.raw.as_ptr(), to, stride, capacity, &mut count) };
        check_with(status, || self.message())?;
        Ok(count as usize)
    }

    /// The poses that the last frame may have, those of most gain first; 8 at most. Where the outcome is
    /// [`Outcome::Uncertain`](crate::Outcome::Uncertain), a program that knows more than the frame shows can tell
    /// which is right.
    pub fn hypotheses(&self) -> Result<impl Iterator<Item = Hypothesis>> {
        const MOST: usize = sys::SPHC_HYPOTHESES_MAX as usize;
        let stride = size_of::<sys::sphc_localizer_hypothesis>() as u32;
        // SAFETY: all zero is a value of it. [exclusive], for it is not Sync.
        let mut raw: [sys::sphc_localizer_hypothesis; MOST] = unsafe { zeroed() };
        let mut count = 0;
        let status = unsafe {
            sys::sphc_localizer_hypotheses(self.raw.as_ptr(), raw.as_mut_ptr(), stride, MOST as u32, &mut count)
        };
        check_with(status, || self.message())?;
        Ok(raw.into_iter().take(count as usize).map(Hypothesis::from_raw))
    }

    /// Sets what drives the search, from the next frame on. Errors: [`Status::Argument`] out of the range,
    /// [`Status::Unsupported`] where the library has no such parameter.
    pub fn set_parameter(&mut self, parameter: Parameter, value: f64) -> Result<()> {
        // SAFETY: [exclusive], by &mut.
        self.done(unsafe { sys::sphc_localizer_set_parameter(self.raw.as_ptr(), parameter.raw(), value) })
    }

    /// What drives the search.
    pub fn parameter(&self, parameter: Parameter) -> Result<f64> {
        let mut value = 0.0;
        // SAFETY: [exclusive], for it is not Sync.
        let status = unsafe { sys::sphc_localizer_get_parameter(self.raw.as_ptr(), parameter.raw(), &mut value) };
        check_with(status, || "")?;
        Ok(value)
    }

    /// Tells what is known of the depth sensor from before, such as [`Localization::depth`] of the last frame before
    /// the power was cut. Errors: [`Status::Argument`] where it cannot be one of this config.
    pub fn set_depth_bias(&mut self, depth: &DepthBias) -> Result<()> {
        // SAFETY: [exclusive], by &mut.
        self.done(unsafe { sys::sphc_localizer_set_depth_bias(self.raw.as_ptr(), depth.as_raw()) })
    }

    /// Forgets where the camera was, as after a long pause; what was learnt of the depth sensor stays.
    pub fn reset(&mut self) {
        // SAFETY: [exclusive], by &mut.
        unsafe { sys::sphc_localizer_reset(self.raw.as_ptr()) };
    }

    pub(crate) fn raw(&self) -> *mut sys::sphc_localizer {
        self.raw.as_ptr()
    }

    /// Gives `call` room for a result and reads it.
    pub(crate) fn answer(
        &mut self,
        call: impl FnOnce(*mut sys::sphc_localizer_result) -> Result<sys::sphc_status>,
    ) -> Result<Localization> {
        // SAFETY: all zero is a value of it.
        let mut raw: sys::sphc_localizer_result = unsafe { zeroed() };
        raw.struct_size = size_of::<sys::sphc_localizer_result>() as u32;
        self.done(call(&mut raw)?)?;
        Ok(Localization::from_raw(&raw))
    }

    fn done(&mut self, status: sys::sphc_status) -> Result<()> {
        panics::go_on();
        check_with(status, || self.message()).map(drop)
    }

    fn message(&self) -> &str {
        // SAFETY: [exclusive], for it is not Sync; it is read before the next call.
        unsafe { text_of(sys::sphc_localizer_message(self.raw.as_ptr())) }
    }
}

impl Drop for Localizer<'_> {
    fn drop(&mut self) {
        let mut raw = self.raw.as_ptr();
        // SAFETY: nothing else uses it; memory, maps and callbacks go afterwards.
        unsafe { sys::sphc_localizer_fini(&mut raw) };
    }
}

impl core::fmt::Debug for Localizer<'_> {
    fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(to, "Localizer with {} maps", self.map_count())
    }
}

/// What a parameter is where it was not set, and may be set to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ParameterRange {
    /// Are only whole numbers taken?
    pub whole: bool,
    /// Where it was not set.
    pub initial: f64,
    /// The least.
    pub lowest: f64,
    /// The most.
    pub highest: f64,
}

impl Parameter {
    /// What it may be. Errors: [`Status::Unsupported`] where the library has no such parameter.
    pub fn range(self) -> Result<ParameterRange> {
        let struct_size = size_of::<sys::sphc_localizer_parameter_range>() as u32;
        let mut raw =
            sys::sphc_localizer_parameter_range { struct_size, whole: 0, initial: 0.0, lowest: 0.0, highest: 0.0 };
        // SAFETY: [pure].
        check_with(unsafe { sys::sphc_localizer_get_parameter_range(self.raw(), &mut raw) }, || "")?;
        let sys::sphc_localizer_parameter_range { whole, initial, lowest, highest, .. } = raw;
        Ok(ParameterRange { whole: whole != 0, initial, lowest, highest })
    }
}
