//! Verified, flat robot dynamics generated for one arm.
#![no_std]
