//! What placed sources do in a step.

use crate::air::{AIR_GAS_CONSTANT_J_KG_K, AIR_HEAT_CAPACITY_J_KG_K, AIR_PRESSURE_PA, air_density_kg_m3};
use crate::field::Field;
use crate::grid::Grid;
use crate::limits::{MAX_ACCELERATION_M_S2, MAX_EXPANSION_PER_S, MAX_TEMPERATURE_K};
use crate::scalars::{MAX_SCALAR, Pack};
use crate::sides::Side;

use super::place::{Entry, Placed};

/// Greatest rate of warming and of growth that sources reach, per second.
const MAX_RATE: f64 = 1.0e7;

/// The air that heat and mass go into.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Air {
    pub(crate) ambient_k: f32,
    pub(crate) lowest_k: f32,
    /// Whether its density falls with its temperature; otherwise it is that of ambient air.
    pub(crate) is_thinned_by_heat: bool,
    pub(crate) cell_volume_m3: f64,
}

impl Air {
    pub(crate) fn ambient_density_kg_m3(self) -> f32 {
        air_density_kg_m3(self.ambient_k)
    }

    /// Heat that warms a cell of ambient air by a kelvin, kJ.
    pub(crate) fn kilojoules_per_k(self) -> f64 {
        1.0e-3 * self.cell_volume_m3 * f64::from(self.ambient_density_kg_m3() * AIR_HEAT_CAPACITY_J_KG_K)
    }

    /// Density at a temperature above ambient, kg/m³.
    #[inline(always)]
    pub(crate) fn density_kg_m3(self, kelvin: f32) -> f32 {
        air_density_kg_m3(if self.is_thinned_by_heat { self.ambient_k + kelvin } else { self.ambient_k })
    }

    /// Temperature above ambient after heat of `kw_m3` for `dt_s`. Where the density is constant,
    /// `dT = q dt / (rho c_p)`. Where it is not, the heat in a volume is told by
    /// `f = dT / (T_a + dT)`, which grows by `q dt / (rho_a c_p T_a) = q dt R / (p c_p)`.
    #[inline(always)]
    pub(crate) fn heated(self, kelvin: f32, kw_m3: f64, dt_s: f32) -> f32 {
        let joules_m3 = 1.0e3 * kw_m3 * f64::from(dt_s);
        let share =
            (joules_m3 * f64::from(AIR_GAS_CONSTANT_J_KG_K / AIR_PRESSURE_PA / AIR_HEAT_CAPACITY_J_KG_K)) as f32;
        let kelvin = if self.is_thinned_by_heat {
            kelvin_from_share(share_from_kelvin(kelvin, self.ambient_k) + share, self.ambient_k)
        } else {
            kelvin + share * self.ambient_k
        };
        kelvin.max(self.lowest_k).min(MAX_TEMPERATURE_K)
    }
}

/// `1 - rho / rho_a = dT / (T_a + dT)`: what is missing of the density of ambient air, and at the
/// same time the heat in a volume over that of as much ambient air.
#[inline(always)]
pub(crate) fn share_from_kelvin(kelvin: f32, ambient_k: f32) -> f32 {
    kelvin / (ambient_k + kelvin)
}

/// Inverse of [`share_from_kelvin`], up to the highest temperature.
#[inline(always)]
pub(crate) fn kelvin_from_share(share: f32, ambient_k: f32) -> f32 {
    let most = MAX_TEMPERATURE_K / (ambient_k + MAX_TEMPERATURE_K);
    let share = if share < most { share } else { most };
    ambient_k * share / (1.0 - share)
}

/// How much of the way to its goal a coupled value goes.
fn coupled(per_s: f32, share: f32, dt_s: f32) -> f32 {
    -(-per_s * share * dt_s).exp_m1()
}

impl Placed {
    /// Whether any source lets gas in or makes it expand.
    pub(crate) fn expands(&self) -> bool {
        self.iter().any(|Entry { source, .. }| source.expansion_per_s != 0.0 || source.inflow_m3_s != 0.0)
    }

    /// Adds up expansion, 1/s by cell.
    pub(crate) fn add_expansion(&self, air: Air, expansion: &mut [f32]) {
        for Entry { source, voxels, .. } in self.iter() {
            let each = f64::from(source.inflow_m3_s) / (voxels.total * air.cell_volume_m3);
            let rate = (f64::from(source.expansion_per_s) + each) as f32;
            if rate != 0.0 {
                for (cell, share) in &voxels.cells {
                    let value = &mut expansion[*cell as usize];
                    *value = (*value + rate * share).clamp(-MAX_EXPANSION_PER_S, MAX_EXPANSION_PER_S);
                }
            }
        }
    }

    /// Warms and draws temperatures.
    pub(crate) fn heat(&self, air: Air, kelvin: &mut [f32], dt_s: f32) {
        for Entry { source, voxels, .. } in self.iter() {
            let kw_m3 = f64::from(source.heat_kw) / (voxels.total * air.cell_volume_m3);
            if kw_m3 != 0.0 {
                for (cell, share) in &voxels.cells {
                    let value = &mut kelvin[*cell as usize];
                    *value = air.heated(*value, kw_m3 * f64::from(*share), dt_s);
                }
            }
            if source.kelvin_per_s != 0.0 {
                for (cell, share) in &voxels.cells {
                    let value = &mut kelvin[*cell as usize];
                    *value = (*value + dt_s * source.kelvin_per_s * share).max(air.lowest_k).min(MAX_TEMPERATURE_K);
                }
            }
            if let Some(couple) = source.temperature {
                let goal = couple.value.max(air.lowest_k);
                for (cell, share) in &voxels.cells {
                    let value = &mut kelvin[*cell as usize];
                    *value += coupled(couple.per_s, *share, dt_s) * (goal - *value);
                }
            }
        }
    }

    /// Adds to scalars and draws them. Where heat thins the air, scalars are densities over the
    /// density of ambient air here.
    pub(crate) fn feed(&self, air: Air, kelvin: &[f32], packs: &mut [Pack], dt_s: f32) {
        for Entry { source, voxels, .. } in self.iter() {
            for scalar in &source.scalars {
                let (pack, at) = scalar.scalar.slot();
                let Some(pack) = packs.get_mut(pack) else { continue };
                let mass_m3 = voxels.total * air.cell_volume_m3 * f64::from(air.ambient_density_kg_m3());
                let by_mass = f64::from(scalar.kg_s) / mass_m3;
                for (cell, share) in &voxels.cells {
                    let value = &mut pack[*cell as usize][at];
                    let weight = if air.is_thinned_by_heat {
                        air.ambient_k / (air.ambient_k + kelvin[*cell as usize])
                    } else {
                        1.0
                    };
                    let rate = f64::from(*share) * (by_mass + f64::from(scalar.per_s * weight));
                    let more = dt_s * rate.clamp(-MAX_RATE, MAX_RATE) as f32;
                    *value = (*value + more).clamp(-MAX_SCALAR, MAX_SCALAR);
                    if let Some(couple) = scalar.couple {
                        *value += coupled(couple.per_s, *share, dt_s) * (weight * couple.value - *value);
                    }
                }
            }
        }
    }

    /// Accelerates and draws velocities. Each face of a cell takes half of what acts on it.
    pub(crate) fn push(&self, grid: &Grid, air: Air, kelvin: &[f32], velocity: &mut [Field; 3], dt_s: f32) {
        for Entry { source, voxels, .. } in self.iter() {
            let force = source.force_n.as_dvec3() / (voxels.total * air.cell_volume_m3);
            for (axis, field) in velocity.iter_mut().enumerate() {
                let (per_mass, per_volume) = (source.acceleration_m_s2[axis], force[axis]);
                let couple = source.velocity.filter(|couple| couple.per_s > 0.0);
                if per_mass == 0.0 && per_volume == 0.0 && couple.is_none() {
                    continue;
                }
                for (cell, share) in &voxels.cells {
                    let by_force = per_volume / f64::from(air.density_kg_m3(kelvin[*cell as usize]));
                    let most = f64::from(MAX_ACCELERATION_M_S2);
                    let acceleration = (f64::from(per_mass) + by_force).clamp(-most, most) as f32;
                    for face in faces(grid, axis, *cell as usize) {
                        let value = &mut field.data[face];
                        *value += 0.5 * dt_s * share * acceleration;
                        if let Some(couple) = couple {
                            // Two halves of the exponent, from the cells on either side.
                            *value += coupled(couple.per_s, 0.5 * share, dt_s) * (couple.value[axis] - *value);
                        }
                    }
                }
            }
        }
    }
}

/// The faces across `axis` below and above a cell. Of a periodic pair it is the one at the low end.
#[inline(always)]
pub(crate) fn faces(grid: &Grid, axis: usize, cell: usize) -> [usize; 2] {
    let [nx, ny, _] = grid.cells;
    let at = [cell % nx, cell / nx % ny, cell / grid.plane()];
    let counts = grid.face_counts(axis);
    let strides = [1, counts[0], counts[0] * counts[1]];
    let low = at[0] + strides[1] * at[1] + strides[2] * at[2];
    let is_last = at[axis] + 1 == grid.cells[axis];
    let wraps = is_last && grid.sides[axis][1] == Side::Periodic;
    let high = if wraps { low - at[axis] * strides[axis] } else { low + strides[axis] };
    [low, high]
}
