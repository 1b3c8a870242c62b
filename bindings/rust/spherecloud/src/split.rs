//! The two halves of a frame, on two threads.
use core::marker::PhantomData;
use core::ops::Deref;

use spherecloud_sys as sys;

use crate::{Features, Frame, Localization, Localizer, Map, Result, Rigid};

pub(crate) fn split<'l, 'a>(localizer: &'l mut Localizer<'a>) -> (Extractor<'l>, Locator<'l, 'a>) {
    (Extractor { raw: localizer.raw(), _localizer: PhantomData }, Locator { localizer })
}

/// The half that looks at images; of [`Localizer::split`].
#[derive(Debug)]
pub struct Extractor<'l> {
    raw: *mut sys::sphc_localizer,
    _localizer: PhantomData<&'l mut sys::sphc_localizer>,
}

// SAFETY: no call depends on the thread; it runs beside those of the locator, and of nothing else, for the localizer is
// borrowed.
unsafe impl Send for Extractor<'_> {}

impl Extractor<'_> {
    /// Fills features by the images of a frame: its colour image, its views, its time and its deadline, which bounds
    /// this call alone. The images may go afterwards.
    ///
    /// Errors: [`Status::Argument`](crate::Status::Argument) where the features were made for another config, among
    /// others; [`Status::Image`](crate::Status::Image). The features stay what they were.
    pub fn extract(&mut self, frame: &Frame<'_>, features: &mut Features<'_>) -> Result<()> {
        let raw = self.raw;
        // SAFETY: [exclusive] with other extractions, by &mut, and with calls of the features, by &mut.
        features.done(|features| frame.with_raw(|frame| unsafe { sys::sphc_localizer_extract(raw, frame, features) }))
    }
}

/// The half that finds poses; of [`Localizer::split`]. What only reads the localizer it does too.
#[derive(Debug)]
pub struct Locator<'l, 'a> {
    // Nobody gets it as &mut: who could put another one there could end what the extractor uses.
    localizer: &'l mut Localizer<'a>,
}

impl<'a> Locator<'_, 'a> {
    /// As [`Localizer::process`], from the features of the frame on; the same result, to the last bit but for times.
    /// The frame's colour image is not looked at: [`Frame::of_depth`] is enough.
    ///
    /// Errors: also [`Status::Argument`](crate::Status::Argument) where the features have another time than the frame,
    /// and [`Status::State`](crate::Status::State) where they are of no frame yet.
    pub fn locate(&mut self, frame: &Frame<'_>, features: &Features<'_>) -> Result<Localization> {
        let (raw, features) = (self.localizer.raw(), features.raw());
        // SAFETY: [exclusive] but for the extractor, by &mut.
        self.localizer.answer(|result| {
            frame.with_raw(|frame| unsafe { sys::sphc_localizer_locate(raw, frame, features, result) })
        })
    }

    /// As [`Localizer::set_map`].
    pub fn set_map(&mut self, map_id: u32, map: &Map<'a>) -> Result<()> {
        self.localizer.set_map(map_id, map)
    }

    /// As [`Localizer::remove_map`].
    pub fn remove_map(&mut self, map_id: u32) -> Result<()> {
        self.localizer.remove_map(map_id)
    }

    /// As [`Localizer::set_map_transform`].
    pub fn set_map_transform(
        &mut self,
        map_id: u32,
        common_from_map: &Rigid,
        rotation_sigma_rad: f64,
        translation_sigma_m: f64,
    ) -> Result<()> {
        self.localizer.set_map_transform(map_id, common_from_map, rotation_sigma_rad, translation_sigma_m)
    }

    /// As [`Localizer::reset`].
    pub fn reset(&mut self) {
        self.localizer.reset()
    }
}

impl<'a> Deref for Locator<'_, 'a> {
    type Target = Localizer<'a>;
    fn deref(&self) -> &Localizer<'a> {
        self.localizer
    }
}
