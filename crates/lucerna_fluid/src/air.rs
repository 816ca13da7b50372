//! What air is: constants, and its density.

/// Pressure of the air around, Pa: one standard atmosphere.
pub const AIR_PRESSURE_PA: f32 = 101_325.0;

/// Gas constant of dry air, J/(kg K): 8.314462 J/(mol K) over 28.965 g/mol.
pub const AIR_GAS_CONSTANT_J_KG_K: f32 = 287.05;

/// Heat capacity of air at constant pressure, J/(kg K), at room temperature. It is taken as the
/// same at all temperatures; at 1500 K that of air is a fifth higher.
pub const AIR_HEAT_CAPACITY_J_KG_K: f32 = 1005.0;

/// Density of air at a temperature in K, above 0: `p / (R T)`, 1.204 kg/m³ at 293.15 K.
#[must_use]
pub fn air_density_kg_m3(kelvin: f32) -> f32 {
    AIR_PRESSURE_PA / (AIR_GAS_CONSTANT_J_KG_K * kelvin)
}
