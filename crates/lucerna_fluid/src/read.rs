//! What a caller reads: samples, figures and the raw arrays.

use glam::Vec3;

use crate::fluid::Fluid;
use crate::sides::Sides;

impl Fluid {
    /// Velocity at a point, m/s, trilinear between the faces. Outside the box, the value at the
    /// nearest place inside; along periodic axes the box repeats.
    #[must_use]
    pub fn velocity(&self, point: Vec3) -> Vec3 {
        let at = self.grid.cells_from_point(point);
        let [u, v, w] = &self.state.velocity;
        Vec3::from_array([u, v, w].map(|field| field.sample_in(&self.grid, at)))
    }

    /// Temperature above ambient at a point, K, trilinear between the cells' centres. Outside
    /// the box, the value at the nearest place inside; along periodic axes the box repeats.
    #[must_use]
    pub fn temperature(&self, point: Vec3) -> f32 {
        self.state.temperature.sample_in(&self.grid, self.grid.cells_from_point(point))
    }

    /// Number of cells along x, y and z.
    #[must_use]
    pub fn cells(&self) -> [usize; 3] {
        self.grid.cells
    }

    /// Low corner of the box, m.
    #[must_use]
    pub fn origin(&self) -> Vec3 {
        self.grid.origin
    }

    /// Edges of the box, m.
    #[must_use]
    pub fn size_m(&self) -> Vec3 {
        self.grid.size_m
    }

    /// Edges of a cell, m.
    #[must_use]
    pub fn cell_size_m(&self) -> Vec3 {
        Vec3::from_array(self.grid.cell_m)
    }

    /// What the six sides do.
    #[must_use]
    pub fn sides(&self) -> Sides {
        self.sides
    }

    /// Velocity of the air outside, m/s.
    #[must_use]
    pub fn wind(&self) -> Vec3 {
        self.settings.wind_m_s
    }

    /// Temperature of the air around, K.
    #[must_use]
    pub fn ambient_k(&self) -> f32 {
        self.settings.ambient_k
    }

    /// Greatest speed through a face after the last step, m/s.
    #[must_use]
    pub fn max_speed_m_s(&self) -> f32 {
        self.max_speed_m_s
    }

    /// Velocities through the faces, m/s: x component with `[nx + 1, ny, nz]` values, y with
    /// `[nx, ny + 1, nz]`, z with `[nx, ny, nz + 1]`; x fastest.
    #[must_use]
    pub fn face_velocities(&self) -> [&[f32]; 3] {
        self.state.velocity.each_ref().map(|field| field.data.as_slice())
    }

    /// Temperatures above ambient at the cells' centres, K; x fastest.
    #[must_use]
    pub fn temperatures(&self) -> &[f32] {
        &self.state.temperature.data
    }

    /// Velocity potential of the last projection at the cells' centres, m²/s: pressure times
    /// step over density; x fastest.
    #[must_use]
    pub fn potential(&self) -> &[f32] {
        &self.state.potential
    }

    /// FNV-1a hash of the bits of velocity, temperature and scalars: equal states, equal hashes.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        let mut hash = Fnv::default();
        let [u, v, w] = &self.state.velocity;
        let fields = [u, v, w, &self.state.temperature].into_iter().flat_map(|field| &field.data);
        for value in fields.chain(self.state.packs.iter().flatten().flatten()) {
            hash.add(&value.to_bits().to_le_bytes());
        }
        hash.0
    }
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits.
pub(crate) struct Fnv(pub(crate) u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}
