//! What can be wrong with a frame.

/// Why a frame could not be prepared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The picture has no pixels, or more than the device takes.
    #[error("the picture is {width} x {height} pixels: both must be 1 to {limit}")]
    Size {
        /// Width asked for.
        width: u32,
        /// Height asked for.
        height: u32,
        /// Largest side the device takes.
        limit: u32,
    },
    /// A field of the look is out of range.
    #[error("look.{field} is {value}: must be {allowed}")]
    Look {
        /// The field.
        field: &'static str,
        /// Its value.
        value: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A field of the camera is out of range.
    #[error("camera.{field} is {value}: must be {allowed}")]
    Camera {
        /// The field.
        field: &'static str,
        /// Its value.
        value: f32,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The parts of the frame do not fit together.
    #[error("frame.{field} {problem}")]
    Frame {
        /// The field.
        field: &'static str,
        /// What is wrong with it.
        problem: String,
    },
    /// The GPU did not answer in time.
    #[error("the GPU did not answer within {seconds} s")]
    Timeout {
        /// How long was waited.
        seconds: u64,
    },
}
