//! What the program writes when it is asked rightly.

use crate::place::{Place, SMALL};
use serde_json::Value;
use std::fs::{self, File};
use std::path::Path;

#[test]
fn a_bare_call_lists_scenes_presets_and_commands() {
    let place = Place::new("overview");
    let overview = place.succeed("");
    for word in ["candle", "torch", "campfire", "paper", "draft", "fine", "render", "view", "export"] {
        assert!(overview.contains(word), "{word} is not in: {overview}");
    }
    assert!(place.succeed("--version").starts_with("lucerna "));
    let help = place.succeed("render --help");
    for option in ["--preset", "--seed", "--shading", "--layers", "--frames", "--fps", "--size", "--out", "--report"] {
        assert!(help.contains(option), "{option} is not in: {help}");
    }
}

#[test]
fn a_picture_an_animation_and_a_folder_are_written() {
    let place = Place::new("written");
    for scene in ["candle", "torch", "campfire"] {
        let said = place.succeed(&format!("render {scene} --size 96x72 --warmup 1 --out {scene}.png"));
        assert_eq!(said, format!("wrote {scene}.png (96x72)\n"));
        let (size, rgb) = read_png(&place.path(&format!("{scene}.png")));
        assert_eq!(size, (96, 72));
        assert!(rgb.iter().any(|&channel| channel > 128), "{scene} is dark");
    }
    // Without --out, a picture of the scene's name.
    assert_eq!(place.succeed("render candle --size 48x32 --warmup 0"), "wrote candle.png (48x32)\n");
    assert_eq!(read_png(&place.path("candle.png")).0, (48, 32));

    let said = place.succeed("render torch --size 64x48 --warmup 1 --frames 7 --fps 25 --out torch.gif");
    assert_eq!(said, "wrote torch.gif (7 frames, 64x48)\n");
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::Indexed);
    let mut decoder = options.read_info(File::open(place.path("torch.gif")).expect("a file")).expect("a GIF");
    assert_eq!((decoder.width(), decoder.height()), (64, 48));
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame of the GIF") {
        delays.push(frame.delay);
    }
    assert_eq!(delays, [4; 7], "hundredths of a second between frames");

    let said = place.succeed(&format!("render torch {SMALL} --frames 3 --out frames"));
    assert_eq!(said, "wrote 3 pictures to frames (48x32)\n");
    let mut names: Vec<String> = fs::read_dir(place.path("frames"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, ["frame_00000.png", "frame_00001.png", "frame_00002.png"]);
    let frames: Vec<_> = names.iter().map(|name| read_png(&place.path("frames").join(name))).collect();
    assert!(frames.iter().all(|(size, _)| *size == (48, 32)));
    assert!(frames[0].1 != frames[1].1 && frames[1].1 != frames[2].1, "the fire stands still");
}

#[test]
fn flames_are_exported_without_a_graphics_device() {
    let place = Place::new("exported");
    place.write_scene("", "");
    let export = |options: &str| {
        let line = format!("export scene.ron --warmup 0.2 --frames 2 --fps 20 {options}");
        // No driver is found there.
        let run = place.run_with(&line, &[("VK_DRIVER_FILES", "none"), ("VK_ICD_FILENAMES", "none")]);
        assert!(run.code == Some(0) && run.complaints.is_empty(), "`lucerna {line}`: {run:?}");
        run.out
    };
    let names = |folder: &str| {
        let entries = fs::read_dir(place.path(folder)).expect("a folder");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name")).collect();
        names.sort();
        names
    };
    let said = export("--out all --format obj --nets --lights");
    let meshes_and_nets = "wrote 2 meshes to all\nwrote 2 files of control nets to all\n";
    let tables = "wrote all/lights.csv (2 frames)\nwrote all/flames.csv (2 frames)\n";
    assert_eq!(said, [meshes_and_nets, tables].concat());
    let meshes = ["flames_00000.obj", "flames_00001.obj"];
    let others = ["lights.csv", "nets_00000.json", "nets_00001.json"];
    assert_eq!(names("all"), [&["flames.csv"], &meshes[..], &others].concat());
    let read = |name: &str| fs::read_to_string(place.path("all").join(name)).expect(name);
    assert!(read(meshes[0]).contains("g flame_0") && read(meshes[0]) != read(meshes[1]));
    // 0.2 s of warm-up, then the first frame's 1/20 s, in steps of 1/60 s.
    let net: Value = serde_json::from_str(&read("nets_00000.json")).expect("JSON");
    assert!((net["time_s"].as_f64().expect("a time") - 0.25).abs() < 1e-6, "{net}");
    for table in ["lights.csv", "flames.csv"] {
        assert!(read(table).lines().last().expect("a row").starts_with("0.3"), "{table}");
    }

    assert_eq!(export("--out one"), "wrote one/flames.glb (2 frames)\n");
    assert_eq!(names("one"), ["flames.glb"]);
    assert!(fs::read(place.path("one/flames.glb")).expect("a file").starts_with(b"glTF"));
}

#[test]
fn a_report_says_what_was_drawn_and_how_long_it_took() {
    let place = Place::new("report");
    let options = "--size 48x32 --warmup 0.5 --frames 4 --fps 20 --seed 11 --layers 3";
    let said = place.succeed(&format!("render torch {options} --report report.json"));
    assert_eq!(said, "wrote report.json\n", "a report alone draws no picture into a file");
    let report = place.report();
    assert_eq!(report["scene"], "Torch");
    assert_eq!(report["preset"], Value::Null);
    assert_eq!((&report["seed"], &report["frames"], &report["animation_fps"]), (&11.into(), &4.into(), &20.0.into()));
    assert_eq!(report["size"], serde_json::json!([48, 32]));
    assert_eq!((&report["shading"], &report["layers_peeled"]), (&"volume".into(), &3.into()));
    assert!(report["adapter"].as_str().is_some_and(|name| !name.is_empty()), "{report:#}");
    let hash = report["state_hash"].as_str().expect("a hash");
    assert!(hash.len() == 16 && hash.bytes().all(|digit| digit.is_ascii_hexdigit()), "{hash}");
    for count in ["triangles", "layers", "steps", "frames_counted"] {
        assert!(report[count].as_u64().is_some_and(|n| n > 0), "{count}: {report:#}");
    }
    // 0.5 s and four frames of 1/20 s in steps of 1/60 s.
    assert_eq!((&report["steps"], &report["dropped_steps"]), (&42.into(), &0.into()));
    assert!(report["open_intervals"].is_u64(), "{report:#}");
    assert!(report["divergence_max"].as_f64().is_some_and(|d| (0.0..1e-3).contains(&d)), "{report:#}");
    let stages =
        ["fluid", "skeletons", "nurbs", "upload", "surfaces", "shadows", "opaque", "peel", "glow", "compose", "frame"];
    assert_eq!(report["stages_ms"].as_object().map(serde_json::Map::len), Some(stages.len()));
    let ms = |stage: &str, which: &str| report["stages_ms"][stage][which].as_f64().expect("milliseconds");
    for stage in stages {
        assert!(0.0 < ms(stage, "median") && ms(stage, "median") <= ms(stage, "p95"), "{stage}: {report:#}");
    }
    let fps = report["fps"].as_f64().expect("frames per second");
    assert!((fps * ms("frame", "median") / 1000.0 - 1.0).abs() < 0.01, "{report:#}");

    let light = report["luminance"].as_array().expect("a number for each frame");
    assert!(light.len() == 4 && light.iter().all(|mean| mean.as_f64().is_some_and(|mean| mean > 0.0)), "{light:?}");

    place.succeed(&format!("render candle {SMALL} --shading shell --preset paper --report report.json --out both.png"));
    let report = place.report();
    assert_eq!((&report["shading"], &report["preset"]), (&"shell".into(), &"paper".into()));
    assert_eq!(read_png(&place.path("both.png")).0, (48, 32));
}

#[test]
fn the_light_in_the_report_is_that_of_the_picture() {
    let place = Place::new("light");
    // So dark that no pixel is cut off, and not tone mapped.
    place.write_scene("seed: 4,", "seed: 4, look: (tone_map: none, exposure_stops: -1.0),");
    place.succeed("render scene.ron --size 64x48 --warmup 0.3 --report report.json --out light.png");
    let linear = |byte: u8| {
        let x = f64::from(byte) / 255.0;
        if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    };
    let (_, rgb) = read_png(&place.path("light.png"));
    let luminance = |pixel: &[u8]| 0.2126 * linear(pixel[0]) + 0.7152 * linear(pixel[1]) + 0.0722 * linear(pixel[2]);
    let of_picture = 2.0 * rgb.chunks_exact(3).map(luminance).sum::<f64>() / (64.0 * 48.0);
    let measured = place.report()["luminance"][0].as_f64().expect("a number");
    println!("{measured} in the report, {of_picture} in the picture");
    assert!(measured > 1e-4 && (of_picture / measured - 1.0).abs() < 0.03, "{measured} {of_picture}");
}

#[test]
fn the_same_seed_is_the_same_fire_on_any_number_of_threads() {
    let place = Place::new("threads");
    let burn = |seed: u64, threads: &str| {
        let line =
            format!("render torch --size 48x32 --warmup 1 --frames 2 --seed {seed} --report report.json --out t.png");
        let run = place.run_with(&line, &[("RAYON_NUM_THREADS", threads)]);
        assert_eq!(run.code, Some(0), "{run:?}");
        (place.report()["state_hash"].clone(), read_png(&place.path("t.png")).1)
    };
    let one = burn(5, "1");
    for threads in ["2", "7"] {
        assert!(burn(5, threads) == one, "{threads} threads are not one");
    }
    let other = burn(6, "2");
    assert!(other.0 != one.0 && other.1 != one.1, "another seed is the same fire");
}

fn read_png(path: &Path) -> ((u32, u32), Vec<u8>) {
    let file = std::io::BufReader::new(File::open(path).expect("a picture"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut rgb = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut rgb).expect("its pixels");
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    ((info.width, info.height), rgb)
}
