//! Pictures of whole fires on a device with nothing optional: the flame stands over its wick, keeps its colours, is the
//! same every time, and lets things stand in front of it, inside it and behind it.

mod fires;
mod light;
mod support;
mod surroundings;
