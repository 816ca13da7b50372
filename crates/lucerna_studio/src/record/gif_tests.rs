//! What comes out of a GIF is what went in, nearly.

use super::gif::GifRecorder;
use super::tests::tempdir;
use std::fs::File;

const SIZE: [u32; 2] = [64, 48];

/// A warm blob that wanders over a dark gradient.
fn frame(time: u32) -> Vec<u8> {
    let mut rgb = Vec::new();
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let (dx, dy) = (x as f32 - 20.0 - time as f32, y as f32 - 24.0);
            let glow = (-(dx * dx + dy * dy) / 60.0).exp();
            rgb.extend([255.0, 140.0, 30.0].map(|channel: f32| (channel * glow + y as f32 * 0.3) as u8));
        }
    }
    rgb
}

fn write(name: &str, fps: f64, frames: &[Vec<u8>]) -> std::path::PathBuf {
    let path = tempdir(name).join("a.gif");
    let mut recorder = GifRecorder::new(&path, SIZE, fps).unwrap();
    for frame in frames {
        recorder.push(frame).unwrap();
    }
    recorder.finish().unwrap();
    path
}

/// Plays a GIF: every frame's canvas and its time in hundredths of a second.
fn play(path: &std::path::Path) -> Vec<(Vec<u8>, u16)> {
    let mut decoder = gif::DecodeOptions::new().read_info(File::open(path).unwrap()).unwrap();
    assert_eq!([u32::from(decoder.width()), u32::from(decoder.height())], SIZE);
    let palette = decoder.global_palette().unwrap().to_vec();
    assert!(palette.len() <= 256 * 3);
    let mut canvas = vec![0; (SIZE[0] * SIZE[1] * 3) as usize];
    let mut played = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let width = usize::from(frame.width);
        for (at, &index) in frame.buffer.iter().enumerate() {
            if Some(index) != frame.transparent {
                let (x, y) = (at % width + usize::from(frame.left), at / width + usize::from(frame.top));
                let to = (y * SIZE[0] as usize + x) * 3;
                canvas[to..to + 3].copy_from_slice(&palette[usize::from(index) * 3..][..3]);
            }
        }
        played.push((canvas.clone(), frame.delay));
    }
    played
}

#[test]
fn animations_come_back() {
    let frames: Vec<Vec<u8>> = (0..12).map(frame).collect();
    let played = play(&write("gif", 20.0, &frames));
    assert_eq!(played.len(), 12);
    for ((canvas, delay), original) in played.iter().zip(&frames) {
        assert_eq!(*delay, 5);
        let error: f64 = canvas.iter().zip(original).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
        assert!(error / (canvas.len() as f64) < 3.0, "mean error {}", error / canvas.len() as f64);
    }
}

#[test]
fn delays_add_up_where_a_frame_is_no_whole_hundredth() {
    let frames: Vec<Vec<u8>> = (0..31).map(|_| frame(0)).collect();
    let played = play(&write("gif_delay", 30.0, &frames));
    assert_eq!(played.iter().take(30).map(|(_, delay)| u32::from(*delay)).sum::<u32>(), 100);
}

#[test]
fn frames_that_stay_the_same_cost_next_to_nothing() {
    let still: Vec<Vec<u8>> = (0..50).map(|_| frame(3)).collect();
    let one = std::fs::metadata(write("gif_one", 20.0, &still[..1])).unwrap().len();
    let fifty = std::fs::metadata(write("gif_fifty", 20.0, &still)).unwrap().len();
    assert!(fifty < one + 50 * 40, "{one} and {fifty} bytes");
}

#[test]
fn rates_that_viewers_do_not_show_are_refused() {
    assert!(GifRecorder::new(std::path::Path::new("a.gif"), SIZE, 60.0).is_err());
}
