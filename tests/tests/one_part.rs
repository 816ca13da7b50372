//! Each part stands alone: who wants only the solver, the surfaces, the scene format or the renderer builds nothing of
//! the others.

use std::process::Command;

/// Parts that must not bring a graphics device or a window.
const WITHOUT_GRAPHICS: [&str; 5] =
    ["lucerna_fluid", "lucerna_nurbs", "lucerna_flame", "lucerna_scene", "lucerna_frame"];
const GRAPHICS: [&str; 9] =
    ["wgpu", "wgpu-core", "wgpu-hal", "wgpu-types", "naga", "eframe", "egui", "winit", "lucerna_render"];

/// The names of all crates that are built with a package, itself first; `None` where there is no cargo.
fn built_with(package: &str, more: &[&str]) -> Option<Vec<String>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let asked = ["tree", "-p", package, "-e", "normal", "--prefix", "none", "--offline", "--locked"];
    let output = Command::new(cargo).current_dir(env!("CARGO_MANIFEST_DIR")).args(asked).args(more).output();
    let Ok(output) = output else {
        eprintln!("skipped: there is no cargo here");
        return None;
    };
    let (text, problem) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "cargo tree -p {package}: {problem}");
    let names: Vec<String> =
        text.lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect();
    assert_eq!(names.first().map(String::as_str), Some(package), "cargo tree -p {package}: {text}");
    Some(names)
}

#[track_caller]
fn assert_without(package: &str, more: &[&str], unwanted: &[&str]) {
    let Some(names) = built_with(package, more) else { return };
    let found: Vec<&String> = names.iter().filter(|name| unwanted.contains(&name.as_str())).collect();
    assert!(found.is_empty(), "{package} brings {found:?}");
}

#[test]
fn what_simulates_builds_without_graphics() {
    for package in WITHOUT_GRAPHICS {
        assert_without(package, &["--all-features"], &GRAPHICS);
    }
    assert_without("lucerna", &["--no-default-features"], &GRAPHICS);
}

#[test]
fn the_solver_and_the_surfaces_know_no_fire() {
    for package in ["lucerna_fluid", "lucerna_nurbs"] {
        let Some(names) = built_with(package, &["--all-features"]) else { return };
        let own: Vec<&String> = names.iter().skip(1).filter(|name| name.starts_with("lucerna")).collect();
        assert!(own.is_empty(), "{package} brings {own:?}");
    }
}

#[test]
fn the_renderer_knows_no_simulation_and_no_window() {
    let unwanted =
        ["lucerna_fluid", "lucerna_nurbs", "lucerna_flame", "lucerna_scene", "lucerna", "eframe", "egui", "winit"];
    assert_without("lucerna_render", &["--all-features"], &unwanted);
    // The test can fail: the whole does bring them.
    let Some(names) = built_with("lucerna", &[]) else { return };
    for part in ["wgpu", "lucerna_render", "lucerna_fluid"] {
        assert!(names.iter().any(|name| name == part), "{part} is not among {names:?}");
    }
}
