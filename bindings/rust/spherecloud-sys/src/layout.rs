//! Sizes, alignments and offsets are those that the C compiler found, on the machine that the test is compiled for.
extern crate std;

macro_rules! layout {
    ($($name:ident: $bytes:literal bytes at $alignment:literal { $($field:ident: $offset:literal),* })*) => {
        $(const _: () = assert!(core::mem::size_of::<$name>() == $bytes);
        const _: () = assert!(core::mem::align_of::<$name>() == $alignment);)*

        #[test]
        fn offsets_are_those_of_c() {
            $(let made = core::mem::MaybeUninit::<$name>::uninit();
            let start = made.as_ptr();
            $(
                // SAFETY: the address of a field is taken; nothing is read.
                let field = unsafe { core::ptr::addr_of!((*start).$field) } as usize;
                assert_eq!(field - start as usize, $offset, concat!(stringify!($name), ".", stringify!($field)));
            )*)*
        }
    };
}

#[rustfmt::skip]
#[path = "layouts.rs"]
mod layouts;
