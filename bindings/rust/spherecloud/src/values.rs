//! What the generated enums and flags are made by.

/// An enum of the C interface. A newer library may answer what this version has no name for: that is `Unknown`.
macro_rules! open_enum {
    ($(#[$about:meta])* $name:ident, $namer:path { $($(#[$said:meta])* $variant:ident = $value:path,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum $name {
            $($(#[$said])* $variant,)*
            /// A value of a newer library.
            Unknown(i32),
        }

        impl $name {
            /// The value of the C interface.
            pub const fn raw(self) -> i32 {
                match self {
                    $(Self::$variant => $value,)*
                    Self::Unknown(value) => value,
                }
            }

            /// Of a value of the C interface.
            pub const fn from_raw(value: i32) -> Self {
                match value {
                    $($value => Self::$variant,)*
                    unknown => Self::Unknown(unknown),
                }
            }

            /// Its name in the C interface, as logs and documentation have it.
            pub fn name(self) -> &'static str {
                // SAFETY: functions that end in _name give terminated text of static storage for every value.
                unsafe { crate::error::text_of($namer(self.raw())) }
            }
        }
    };
}

/// Bits of the C interface. Bits of a newer library are kept.
macro_rules! flags {
    ($(#[$about:meta])* $name:ident { $($(#[$said:meta])* $flag:ident = $value:path,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
        #[repr(transparent)]
        pub struct $name(u32);

        impl $name {
            $($(#[$said])* pub const $flag: Self = Self($value);)*

            /// The bits of the C interface.
            pub const fn bits(self) -> u32 {
                self.0
            }

            /// Of bits of the C interface.
            pub const fn from_bits(bits: u32) -> Self {
                Self(bits)
            }

            /// Is nothing set?
            pub const fn is_empty(self) -> bool {
                self.0 == 0
            }

            /// Is all of `other` set?
            pub const fn contains(self, other: Self) -> bool {
                self.0 & other.0 == other.0
            }
        }

        impl core::ops::BitOr for $name {
            type Output = Self;
            fn bitor(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }
        }

        impl core::fmt::Debug for $name {
            fn fmt(&self, to: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let mut names = to.debug_set();
                let mut unknown = self.0;
                $(if self.contains(Self::$flag) {
                    names.entry(&format_args!(stringify!($flag)));
                    unknown &= !Self::$flag.0;
                })*
                if unknown != 0 {
                    names.entry(&format_args!("{:#x}", unknown));
                }
                names.finish()
            }
        }
    };
}

pub(crate) use {flags, open_enum};
