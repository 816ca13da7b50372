//! What a caller changes: settings, and what is added to the air.

mod add;
mod settings;
