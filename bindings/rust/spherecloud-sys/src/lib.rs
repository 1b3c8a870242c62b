//! The C interface of the SphereCloud SDK as it is: `spherecloud.h`, word for word.
//!
//! Names, layouts and meanings are those of the header, whose comments stand beside everything; of each function its
//! thread class too. The crate [`spherecloud`](https://docs.rs/spherecloud) makes safe Rust of it, and is what
//! programs should use.
//!
//! The library is found at build time: in the folder `SPHERECLOUD_LIB_DIR`, or else by `pkg-config spherecloud`. The
//! feature `static` links `libspherecloud.a`.
#![no_std]
#![allow(non_camel_case_types)]

/// `char` of C; `core::ffi::c_char` is younger than the oldest compiler that is supported.
#[cfg(any(target_arch = "x86", target_arch = "x86_64", target_vendor = "apple", windows))]
pub type c_char = i8;
/// `char` of C; `core::ffi::c_char` is younger than the oldest compiler that is supported.
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_vendor = "apple", windows)))]
pub type c_char = u8;

#[rustfmt::skip]
mod raw;
pub use raw::*;

#[cfg(test)]
mod layout;
