//! What numbers the command line accepts.

/// Smallest and largest side of a picture in pixels.
pub const SIDE_PX: std::ops::RangeInclusive<u32> = 16..=8192;
/// Fewest and most frames of a run.
pub const FRAMES: std::ops::RangeInclusive<u32> = 1..=100_000;
/// Lowest and highest rate in frames per second.
pub const FPS: std::ops::RangeInclusive<f64> = 1.0..=1000.0;
/// Shortest and longest time in seconds that is simulated before the first frame.
pub const WARMUP_S: std::ops::RangeInclusive<f64> = 0.0..=600.0;

pub(crate) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let wrong = || format!("a size is written WIDTHxHEIGHT, such as 960x720, not \"{text}\"");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wrong)?;
    let size = [width.parse::<u32>().map_err(|_| wrong())?, height.parse::<u32>().map_err(|_| wrong())?];
    if size.iter().all(|side| SIDE_PX.contains(side)) {
        Ok(size)
    } else {
        Err(format!("a size is 16x16 to 8192x8192, not {text}"))
    }
}

pub(crate) fn parse_frames(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(frames) if FRAMES.contains(&frames) => Ok(frames),
        _ => Err("the number of frames is 1 to 100000".into()),
    }
}

fn parse_number(text: &str, range: &std::ops::RangeInclusive<f64>, what: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if range.contains(&value) => Ok(value),
        _ => Err(format!("{what} is {} to {}", range.start(), range.end())),
    }
}

pub(crate) fn parse_fps(text: &str) -> Result<f64, String> {
    parse_number(text, &FPS, "the number of frames per second")
}

pub(crate) fn parse_warmup(text: &str) -> Result<f64, String> {
    parse_number(text, &WARMUP_S, "the warm-up in seconds")
}

pub(crate) fn parse_exit_after(text: &str) -> Result<f64, String> {
    parse_number(text, &(0.0..=86_400.0), "the time in seconds")
}
