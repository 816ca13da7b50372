//! A run that writes flames for other programs: steps the world and exports, without a graphics device.

use crate::cli::{ExportArgs, FormatArg};
use crate::headless::slices;
use crate::progress::Progress;
use crate::record::check_file;
use anyhow::{Context, Result};
use lucerna::World;
use lucerna::export::{ExportError, FlameTable, GlbSequence, LightTable, write_nets, write_obj};
use lucerna::scene::LoadedScene;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Runs an export and says in words what was written, one line for each kind of file.
pub fn run(scene: LoadedScene, args: &ExportArgs) -> Result<Vec<String>> {
    let mut files = Files::new(args)?;
    let mut world = World::new(scene)?;
    let mut progress = Progress::new("warming up", (args.warmup * 1e3) as u64);
    advance(&mut world, args.warmup, |time_s| progress.set((time_s * 1e3) as u64))?;
    let mut progress = Progress::new("frame", u64::from(args.frames));
    for frame in 0..args.frames {
        advance(&mut world, 1.0 / args.fps, |_| {})?;
        files.push(frame, &world)?;
        progress.set(u64::from(frame) + 1);
    }
    drop(progress);
    files.finish(args.frames)
}

/// Steps the world so that no step is dropped; `done` is told the time in seconds that is done.
fn advance(world: &mut World, time_s: f64, mut done: impl FnMut(f64)) -> Result<()> {
    let slices = slices(time_s, f64::from(world.scene().scene.air.time_step_s));
    let dt_s = time_s / f64::from(slices);
    for slice in 1..=slices {
        world.step(dt_s as f32)?;
        done(f64::from(slice) * dt_s);
    }
    Ok(())
}

/// The files of an export; what has one file for all frames is open.
struct Files<'a> {
    args: &'a ExportArgs,
    gltf: Option<(PathBuf, GlbSequence)>,
    lights: Option<(PathBuf, LightTable<BufWriter<File>>)>,
    flames: Option<(PathBuf, FlameTable<BufWriter<File>>)>,
}

impl<'a> Files<'a> {
    /// Makes the folder, and fails before any work is done where a file cannot be written.
    fn new(args: &'a ExportArgs) -> Result<Self> {
        let folder = &args.out;
        fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
        let mut files = Self { args, gltf: None, lights: None, flames: None };
        match args.format {
            FormatArg::Obj => check_file(&files.numbered("flames", 0, "obj"))?,
            FormatArg::Gltf => {
                let path = folder.join("flames.glb");
                check_file(&path)?;
                files.gltf = Some((path, GlbSequence::new(args.fps)?));
            }
        }
        if args.nets {
            check_file(&files.numbered("nets", 0, "json"))?;
        }
        if args.lights {
            let path = folder.join("lights.csv");
            let table = File::create(&path).map_err(ExportError::from);
            let table = table.and_then(|file| LightTable::new(BufWriter::new(file))).with_context(|| cannot(&path))?;
            files.lights = Some((path, table));
            let path = folder.join("flames.csv");
            let table = File::create(&path).map_err(ExportError::from);
            let table = table.and_then(|file| FlameTable::new(BufWriter::new(file))).with_context(|| cannot(&path))?;
            files.flames = Some((path, table));
        }
        Ok(files)
    }

    fn numbered(&self, stem: &str, frame: u32, extension: &str) -> PathBuf {
        self.args.out.join(format!("{stem}_{frame:05}.{extension}"))
    }

    fn push(&mut self, frame: u32, world: &World) -> Result<()> {
        match &mut self.gltf {
            Some((path, sequence)) => sequence.push(&world.frame()).with_context(|| cannot(path))?,
            None => write(&self.numbered("flames", frame, "obj"), |out| write_obj(&world.frame(), out))?,
        }
        if self.args.nets {
            write(&self.numbered("nets", frame, "json"), |out| write_nets(world.flames(), out))?;
        }
        if let Some((path, table)) = &mut self.lights {
            table.push(world.flames()).with_context(|| cannot(path))?;
        }
        if let Some((path, table)) = &mut self.flames {
            table.push(world.flames()).with_context(|| cannot(path))?;
        }
        Ok(())
    }

    fn finish(self, frames: u32) -> Result<Vec<String>> {
        let folder = self.args.out.display();
        let mut written = Vec::new();
        match self.gltf {
            Some((path, sequence)) => {
                write(&path, |out| sequence.finish(out))?;
                written.push(format!("wrote {} ({frames} frames)", path.display()));
            }
            None => written.push(format!("wrote {frames} meshes to {folder}")),
        }
        if self.args.nets {
            written.push(format!("wrote {frames} files of control nets to {folder}"));
        }
        if let Some((path, table)) = self.lights {
            table.finish().with_context(|| cannot(&path))?;
            written.push(format!("wrote {} ({frames} frames)", path.display()));
        }
        if let Some((path, table)) = self.flames {
            table.finish().with_context(|| cannot(&path))?;
            written.push(format!("wrote {} ({frames} frames)", path.display()));
        }
        Ok(written)
    }
}

/// Writes a file as a whole.
fn write(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<(), ExportError>) -> Result<()> {
    let mut out = BufWriter::new(File::create(path).with_context(|| cannot(path))?);
    write(&mut out).with_context(|| cannot(path))?;
    out.flush().with_context(|| cannot(path))
}

fn cannot(path: &Path) -> String {
    format!("cannot write {}", path.display())
}
