//! The binding plays the golden session, keeps its promises, and refuses what it should.
mod aligner;
mod conventions;
mod depth_cameras;
mod features;
mod golden;
#[cfg(not(windows))] // whose variables of a thread ask for heap themselves
mod heap;
mod hooks;
mod lifetimes;
mod memory;
mod misuse;
mod session;
