//! Flames that stand near each other become one.

use lucerna_fluid::Vec3;

use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, METHANE, Plan};

pub(crate) const MERGING: Experiment = Experiment {
    name: "merging",
    title: "Two flames of 10 kW beside each other",
    law: "they are one from about three times their spacing upwards",
    source: "a rule of thumb; the height of merged flames of burners: M. A. Delichatsios, A Correlation for the Flame Height \
             in 'Group' Fires, Fire and Materials 31, 2007",
    origin: Origin::Emergent,
    measures: "Height above which the mean temperature midway between them is that above the burners or higher, over the \
               spacing of their middles.",
    short: None,
    long: "burners of 0.1 m, cells of 2.5 cm, box of 0.8 x 1.2 x 0.6 m, 2 to 7 s",
    burn,
};

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    const CELL_M: f32 = 0.025;
    const CELLS: [usize; 3] = [32, 48, 24];
    let dt_s = 0.005;
    let gaps = [0.2_f32];
    let mut lines = Vec::new();
    for (at, gap) in gaps.into_iter().enumerate() {
        run.part(at, gaps.len());
        let plan = Plan {
            at_m: vec![-0.5 * gap, 0.5 * gap],
            ..Plan::new(METHANE, 20.0, Burner::Round { diameter: 0.1 }, CELL_M, CELLS)
        };
        let mut fire = plan.light()?;
        let feet = [fire.feet[0], fire.feet[1]];
        let middle = 0.5 * (feet[0] + feet[1]);
        let mut sums = vec![(0.0_f64, 0.0_f64); CELLS[1]];
        let height = |j: usize| (j as f32 + 0.5) * CELL_M;
        let [start, end] = [2.0, 7.0].map(|time: f32| (time / dt_s) as usize);
        run.steps(&mut fire.air, dt_s, end, |step, air, _| {
            if step < start || step % 2 != 0 {
                return;
            }
            for (j, sum) in sums.iter_mut().enumerate() {
                let up = height(j) * Vec3::Y;
                sum.0 += f64::from(air.temperature(middle + up));
                sum.1 += 0.5 * f64::from(air.temperature(feet[0] + up) + air.temperature(feet[1] + up));
            }
        })?;
        let ratios: Vec<f64> = sums.iter().map(|(middle, above)| middle / above.max(1.0e-9)).collect();
        // Above the last height at which the middle is cooler.
        let merged = ratios.iter().rposition(|ratio| *ratio < 1.0).map_or(0, |j| j + 1);
        let found = if merged < CELLS[1] { f64::from(height(merged) / gap) } else { f64::NAN };
        let what = format!("merged {gap} m apart, heights over spacings");
        run.figure(Figure::new(what, "", 3.0, found, Allowed::Any));
        let points = ratios.iter().enumerate().map(|(j, ratio)| (f64::from(height(j) / gap), *ratio)).collect();
        lines.push(Series { name: format!("{gap} m apart"), mark: Mark::Line, points });
    }
    run.chart(Chart {
        title: "Midway between two flames".into(),
        x: Axis::linear("height over spacing"),
        y: Axis::linear("excess temperature, over that above the burners"),
        series: lines,
    });
    Ok(())
}
