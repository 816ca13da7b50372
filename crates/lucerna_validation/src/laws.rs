//! The laws, one a file.

pub(crate) mod candles;
pub(crate) mod heights;
pub(crate) mod line_fire;
pub(crate) mod mccaffrey;
pub(crate) mod merging;
pub(crate) mod puffing;
pub(crate) mod radiation;
pub(crate) mod rising_wave;
pub(crate) mod wind;
