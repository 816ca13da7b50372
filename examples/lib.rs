//! The examples of Lucerna: `cargo run --release --example candle`, `torch` or `campfire`.
//!
//! Each opens a built-in scene, changes a few things in code and shows the result in a window. All of them understand
//! `--headless --frames N --fps F --size WxH --seed S --out PATH --report FILE.json` and what `--help` lists besides.
