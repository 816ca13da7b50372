//! How high a flame is, from the air: where its heat is released, how often burning gas reaches a height, and where the
//! axis has cooled.

use lucerna_fluid::{AIR_GAS_CONSTANT_J_KG_K, AIR_PRESSURE_PA, Fluid, ScalarId, Vec3};

/// Gas burns that holds fuel enough to warm it by this much more, K.
const BURNING_K: f32 = 100.0;
/// Mean excess on the axis at the mean height of a flame, K: about 500 (G. Heskestad, *Fire Plumes, Flame Height, and Air
/// Entrainment*, SFPE Handbook).
const TIP_K: f64 = 500.0;

/// Watches a fire, and sums up what its height is found from.
pub(crate) struct FlameHeight {
    fuel: ScalarId,
    /// Mass fraction of fuel from which on gas burns.
    least: f32,
    kg_s: f64,
    foot: Vec3,
    /// By height: fuel that passes upwards, kg/s; looks with burning gas; excess temperature on the axis, K.
    passing: Vec<f64>,
    burning: Vec<u32>,
    kelvin: Vec<f64>,
    /// Mean fuel by place, kg/m³ in all: x moments of the burning gas.
    looks: u32,
    cell_m: f64,
    /// Highest burning gas at each look, m.
    pub(crate) tips_m: Vec<f64>,
}

/// Heights by each measure, m above the burner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heights {
    /// Below it 95 % of the heat is released.
    pub(crate) released_95_m: f64,
    /// Below it 99 % of the heat is released.
    pub(crate) released_99_m: f64,
    /// Burning gas is above it half of the time.
    pub(crate) half_of_time_m: f64,
    /// The axis is 500 K above ambient on average.
    pub(crate) kelvin_500_m: f64,
}

impl FlameHeight {
    /// A fire of so much fuel (kg/s, kJ/kg) over a place on the floor.
    pub(crate) fn new(air: &Fluid, fuel: ScalarId, kg_s: f32, heat_kj_kg: f32, foot: Vec3) -> Self {
        let rows = air.cells()[1];
        Self {
            fuel,
            least: BURNING_K * 1.005 / heat_kj_kg,
            kg_s: f64::from(kg_s),
            foot,
            passing: vec![0.0; rows],
            burning: vec![0; rows],
            kelvin: vec![0.0; rows],
            looks: 0,
            cell_m: f64::from(air.cell_size_m().y),
            tips_m: Vec::new(),
        }
    }

    /// Looks at the fire.
    pub(crate) fn look(&mut self, air: &Fluid) {
        let [nx, ny, nz] = air.cells();
        let [_, up, _] = air.face_velocities();
        let temperatures = air.temperatures();
        let ambient = air.ambient_k();
        let area = f64::from(air.cell_size_m().x * air.cell_size_m().z);
        let mut tip = 0;
        let fuel: Vec<f32> = air.scalar_values(self.fuel).collect();
        for j in 0..ny {
            let (mut passing, mut is_burning) = (0.0_f64, false);
            for k in 0..nz {
                for i in 0..nx {
                    let low = i + nx * (j + ny * k);
                    is_burning |= fuel[low] >= self.least;
                    // What passes the upper face comes from below where the air rises.
                    let speed = up[i + nx * (j + 1 + (ny + 1) * k)];
                    let from = if speed > 0.0 || j + 1 == ny { low } else { low + nx };
                    if fuel[from] > 0.0 {
                        let density = AIR_PRESSURE_PA / (AIR_GAS_CONSTANT_J_KG_K * (ambient + temperatures[from]));
                        passing += f64::from(density * fuel[from] * speed);
                    }
                }
            }
            self.passing[j] += passing * area;
            self.burning[j] += u32::from(is_burning);
            if is_burning {
                tip = j + 1;
            }
            let height = (j as f32 + 0.5) * self.cell_m as f32;
            self.kelvin[j] += f64::from(air.temperature(self.foot + height * Vec3::Y));
        }
        self.tips_m.push(tip as f64 * self.cell_m);
        self.looks += 1;
    }

    /// What was seen on average.
    pub(crate) fn heights(&self) -> Heights {
        let looks = f64::from(self.looks);
        // Heights of the faces above the rows; fuel that has not passed has burnt below.
        let left: Vec<f64> = self.passing.iter().map(|passing| passing / looks / self.kg_s).collect();
        let burning: Vec<f64> = self.burning.iter().map(|count| f64::from(*count) / looks).collect();
        let kelvin: Vec<f64> = self.kelvin.iter().map(|kelvin| kelvin / looks).collect();
        Heights {
            released_95_m: self.falls_below(&left, 0.05, 1.0),
            released_99_m: self.falls_below(&left, 0.01, 1.0),
            half_of_time_m: self.falls_below(&burning, 0.5, 1.0),
            kelvin_500_m: self.falls_below(&kelvin, TIP_K, 0.5),
        }
    }

    /// Mean excess temperature on the axis by height above the floor, m and K.
    pub(crate) fn axis_kelvin(&self) -> Vec<(f64, f64)> {
        let looks = f64::from(self.looks);
        let rows = self.kelvin.iter().enumerate();
        rows.map(|(j, kelvin)| ((j as f64 + 0.5) * self.cell_m, kelvin / looks)).collect()
    }

    /// Share of the heat that is released within each row.
    pub(crate) fn release_by_row(&self) -> Vec<(f64, f64)> {
        let looks = f64::from(self.looks);
        let mut below = 1.0;
        let rows = self.passing.iter().enumerate().map(|(j, passing)| {
            let left = (passing / looks / self.kg_s).min(1.0);
            let released = below - left;
            below = left;
            ((j as f64 + 0.5) * self.cell_m, released)
        });
        rows.collect()
    }

    /// The greatest height at which values, `offset` cells up in their rows, fall below a limit: straight between rows.
    fn falls_below(&self, values: &[f64], limit: f64, offset: f64) -> f64 {
        let Some(last) = values.iter().rposition(|value| *value >= limit) else { return 0.0 };
        let Some(next) = values.get(last + 1) else { return f64::INFINITY };
        (last as f64 + offset + (values[last] - limit) / (values[last] - next)) * self.cell_m
    }
}
