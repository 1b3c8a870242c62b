//! A failure, with the library's words.
use core::ffi::c_void;
use core::fmt::{self, Write};

use spherecloud_sys as sys;

use crate::Status;

/// Why a call failed: a status to decide by, and a message with cause and cure to read.
///
/// Without the feature `alloc` it holds its text itself. Where a file could not be read, `source()` is the
/// `std::io::Error`, which does not count when errors are compared.
#[derive(Clone, PartialEq, Eq)]
pub struct Error(Held);

#[cfg(feature = "alloc")]
type Held = alloc::boxed::Box<Told>;
#[cfg(not(feature = "alloc"))]
type Held = Told;

/// What can fail.
pub type Result<T> = core::result::Result<T, Error>;

#[derive(Clone)]
struct Told {
    status: Status,
    length: u8,
    text: [u8; sys::SPHC_MESSAGE_BYTES as usize - 1],
    #[cfg(feature = "std")]
    source: Option<std::sync::Arc<std::io::Error>>,
}

impl PartialEq for Told {
    fn eq(&self, other: &Self) -> bool {
        (self.status, self.length, self.text) == (other.status, other.length, other.text)
    }
}

impl Eq for Told {}

impl Error {
    /// What kind of failure it is; never [`Status::Ok`].
    pub fn status(&self) -> Status {
        self.0.status
    }

    /// Cause and cure in English; the status' name where the library had no more to say.
    pub fn message(&self) -> &str {
        match self.0.length {
            0 => self.0.status.name(),
            length => core::str::from_utf8(&self.0.text[..length.into()]).unwrap_or_default(),
        }
    }

    pub(crate) fn new(status: Status, message: fmt::Arguments<'_>) -> Self {
        let mut told = Told {
            status,
            length: 0,
            text: [0; sys::SPHC_MESSAGE_BYTES as usize - 1],
            #[cfg(feature = "std")]
            source: None,
        };
        // What does not fit is left out.
        let _ = told.write_fmt(message);
        Self(Held::from(told))
    }

    #[cfg(feature = "std")]
    pub(crate) fn because(mut self, source: std::io::Error) -> Self {
        self.0.source = Some(std::sync::Arc::new(source));
        self
    }
}

impl Write for Told {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        for one in more.chars() {
            let from = usize::from(self.length);
            let to = from + one.len_utf8();
            one.encode_utf8(self.text.get_mut(from..to).ok_or(fmt::Error)?);
            self.length = to as u8;
        }
        Ok(())
    }
}

impl fmt::Display for Error {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(to, "{} [{}]", self.message(), self.status().name())
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, to)
    }
}

#[cfg(feature = "std")]
impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.0.source.as_deref().map(|source| source as _)
    }
}

/// A failure of this crate's own.
macro_rules! error {
    ($status:ident, $($text:tt)+) => {
        $crate::Error::new($crate::Status::$status, format_args!($($text)+))
    };
}
pub(crate) use error;

/// Text of the library up to its zero byte; "" for null and for bytes that are not UTF-8.
///
/// # Safety
/// `text` is null, or terminated and unchanged for as long as the answer is used.
pub(crate) unsafe fn text_of<'a>(text: *const sys::c_char) -> &'a str {
    if text.is_null() {
        return "";
    }
    let bytes = text.cast::<u8>();
    let mut length = 0;
    while *bytes.add(length) != 0 {
        length += 1;
    }
    core::str::from_utf8(core::slice::from_raw_parts(bytes, length)).unwrap_or_default()
}

/// A failure whose message `message` asks for; what is no failure comes back.
pub(crate) fn check_with<'a>(status: sys::sphc_status, message: impl FnOnce() -> &'a str) -> Result<Status> {
    let told = Status::from_raw(status);
    if status < 0 {
        return Err(Error::new(told, format_args!("{}", message())));
    }
    Ok(told)
}

/// Calls a function that takes room for a message.
pub(crate) fn check(call: impl FnOnce(*mut sys::sphc_message) -> sys::sphc_status) -> Result<Status> {
    let mut message = sys::sphc_message { text: [0; sys::SPHC_MESSAGE_BYTES as usize] };
    let status = call(&mut message);
    // SAFETY: messages are always terminated.
    check_with(status, || unsafe { text_of(message.text.as_ptr()) })
}

/// Fails unless the library is one that this crate was made for.
///
/// Every object asks this when it is made, so that a wrong library is a clear error. The ABI must be the same.
pub fn check_library() -> Result<()> {
    // SAFETY: [pure], no arguments.
    check_version(unsafe { sys::sphc_abi() }, library_version())
}

fn check_version(abi: u32, version: &str) -> Result<()> {
    if abi == sys::SPHC_ABI {
        return Ok(());
    }
    let (ours, our_abi) = (sys::VERSION, sys::SPHC_ABI);
    Err(error!(
        Unsupported,
        "the library is version {} with ABI {}, this crate is for {} with ABI {}; use those of one release",
        version,
        abi,
        ours,
        our_abi
    ))
}

/// The version of the library that runs: "major.minor.patch".
pub fn library_version() -> &'static str {
    // SAFETY: [pure], static storage.
    unsafe { text_of(sys::sphc_version_string()) }
}

/// A slice as C takes it.
pub(crate) fn bytes_of<T>(slice: &[T]) -> *const c_void {
    slice.as_ptr().cast()
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use alloc::string::ToString;

    use super::*;

    #[test]
    fn libraries_of_other_versions_are_refused() {
        assert!(check_version(sys::SPHC_ABI, sys::VERSION).is_ok());
        assert!(check_version(sys::SPHC_ABI, "1.99.0").is_ok());
        assert!(check_version(0, sys::VERSION).is_err());
        let error = check_version(7, "7.1.0").unwrap_err();
        assert_eq!(error.status(), Status::Unsupported);
        assert!(error.message().contains("version 7.1.0 with ABI 7"), "{}", error);
    }

    #[test]
    fn long_messages_end_between_characters() {
        let error = error!(Device, "{:\u{e9}<400}", "");
        assert_eq!(error.message().len(), 254);
        assert!(error.to_string().ends_with("\u{e9} [SPHC_E_DEVICE]"));
        assert_eq!(error!(Device, "").message(), "SPHC_E_DEVICE");
    }
}
