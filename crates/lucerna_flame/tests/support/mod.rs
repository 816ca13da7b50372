//! What the tests of wicks and flames share: ten shapes of wicks, air that gusts and swirls, and how well a surface
//! is formed.

#![allow(dead_code, unreachable_pub)]

pub mod health;
pub mod shapes;
