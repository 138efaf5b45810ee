//! What a stroke costs: its length, and the work of the joints.

use crate::chain::Chain;
use crate::error::GaitError;
use crate::formulas::Evaluator;
use crate::stroke::{Fourier, Stroke};

/// What the joints spend along a stroke without momentum or loads: the integral of a density over a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// The length $\int \sqrt{\dot q^T G \dot q}\,dt$ in the metric $G = M_{qq} - M_{qg} \mathbb{I}^{-1} M_{gq}$, m √kg: it does not depend on how
    /// fast the stroke is done.
    Length,
    /// The positive work $\sum_j \int \max(0, \tau_j \cdot \dot q_j)\,dt$ over the joints, J: no joint gets back what another one gives.
    Work,
}

impl Effort {
    fn density(self, chain: &Chain) -> &[Evaluator; 2] {
        match self {
            Self::Length => &chain.formulas().speed,
            Self::Work => &chain.formulas().power,
        }
    }

    /// The effort of a stroke, by the trapezoidal rule at `samples` times. What is smooth converges faster than any power; where a
    /// power changes its sign, or all rates vanish, the rule is of order 2.
    ///
    /// # Errors
    /// [`GaitError::Shape`].
    pub fn of(self, chain: &Chain, stroke: &dyn Stroke, samples: usize) -> Result<f64, GaitError> {
        let h = stroke.period() / samples as f64;
        let [density, _] = self.density(chain);
        let mut sum = 0.0;
        let points = chain.states(stroke, (0..samples).map(|i| i as f64 * h));
        density.at_each(&points, &mut |_, out| sum += h * out[0])?;
        Ok(sum)
    }

    /// The same with its gradient in the coefficients: exactly that of this sum.
    ///
    /// # Errors
    /// [`GaitError::Shape`].
    pub fn with_gradient(
        self,
        chain: &Chain,
        stroke: &Fourier,
        samples: usize,
    ) -> Result<(f64, Vec<f64>), GaitError> {
        let h = stroke.period() / samples as f64;
        let (dim, of_one) = (chain.dim(), stroke.of_one());
        let [_, density] = self.density(chain);
        let (mut sum, mut gradient) = (0.0, vec![0.0; dim * of_one]);
        let points = chain.states(stroke, (0..samples).map(|i| i as f64 * h));
        density.at_each(&points, &mut |i, out| {
            let bases = [0, 1, 2].map(|k| stroke.basis(i as f64 * h, k));
            sum += h * out[0];
            // Where nothing moves, the length has a corner, and 0 is one of its slopes.
            let slopes = out[1..]
                .iter()
                .map(|slope| if out[0] == 0.0 { 0.0 } else { *slope });
            for (index, slope) in slopes.enumerate() {
                let own = &mut gradient[(index % dim) * of_one..][..of_one];
                let basis = own.iter_mut().zip(&bases[index / dim]);
                basis.for_each(|(sum, phi)| *sum += h * slope * phi);
            }
        })?;
        Ok((sum, gradient))
    }
}
