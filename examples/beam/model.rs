//! The Lagrangian.
//!
//! The strain between neighbours is $\epsilon = \mathrm{cay}^{-1}(g_i^{-1} g_{i+1}) / \ell - e$: torsion and bending, extension and shear.
//! Only the value is written. The integrators record it once and differentiate what was recorded.

use lgvi::dvi::{Context, Lagrangian, System};
use lgvi::lie::{Cayley, LieGroup, Power, SE3, Scalar, Tangent};

/// A beam of rubber, 2 cm thick.
#[derive(Clone, Copy)]
pub struct Beam {
    /// The distance of its nodes, m.
    pub piece: f64,
    /// The torque at its end, N m, about the third axis of the last node; of a beam that is clamped before its first node.
    pub bends: Option<[f64; 1]>,
}

/// kg/m.
const MASS: f64 = 0.44;
/// kg m, about the axes of a node; the first is along the beam.
const INERTIA: [f64; 3] = [2.9e-5, 1.45e-5, 1.45e-5];
/// Against torsion and bending, N m²; against extension and shear, N.
pub const STIFFNESS: [f64; 6] = [8.9e-3, 1.3e-2, 1.3e-2, 400.0, 133.0, 133.0];

impl System for Beam {
    type Group = Power<SE3>;

    fn parameters(&self) -> &[f64] {
        self.bends.as_ref().map_or(&[], |torque| torque)
    }
}

impl Lagrangian for Beam {
    fn value<S: Scalar>(&self, _: Context<S>, g: &Power<SE3<S>>, xi: &Power<Tangent<6, S>>) -> S {
        let masses = self.masses();
        let kinetic = xi
            .iter()
            .flat_map(|xi| (0..6).map(|k| (xi[k] * xi[k]).times(masses[k])));
        let clamp = self.bends.map(|_| (SE3::identity(), g[0]));
        let pairs = g.windows(2).map(|pair| (pair[0], pair[1]));
        let elastic = pairs.chain(clamp).map(|(a, b)| self.elastic(&a, &b));
        let sum = |sum: S, term: S| sum + term;
        (kinetic.fold(S::zero(), sum) - elastic.fold(S::zero(), sum)).times(0.5)
    }
}

impl Beam {
    /// Of a node: moments of inertia, and three times the mass.
    pub fn masses(&self) -> [f64; 6] {
        let rod = MASS * self.piece.powi(3) / 12.0;
        let [along, across, _] = INERTIA.map(|j| j * self.piece);
        let mass = MASS * self.piece;
        [along, across + rod, across + rod, mass, mass, mass]
    }

    /// $g_i^{-1} g_{i+1}$; the difference first, for far from the origin a product of the two would lose digits.
    #[inline(always)]
    pub fn apart<S: Scalar>(&self, a: &SE3<S>, b: &SE3<S>) -> SE3<S> {
        let along = b.translation - a.translation;
        SE3::new(
            a.rotation.inverse().compose(&b.rotation),
            a.rotation.inverse_rotate(along),
        )
    }

    /// Twice the energy of the strain between two nodes.
    fn elastic<S: Scalar>(&self, a: &SE3<S>, b: &SE3<S>) -> S {
        // Outside the chart, a bend by half a turn, there is no energy.
        let strain = self.apart(a, b).retract_inverse::<Cayley>();
        let strain = strain.map_or(Tangent([S::from_f64(f64::NAN); 6]), |c| {
            c * S::from_f64(1.0 / self.piece)
        });
        (0..6).fold(S::zero(), |sum, k| {
            let straight = if k == 3 { S::one() } else { S::zero() };
            let strain = strain[k] - straight;
            sum + (strain * strain).times(STIFFNESS[k] * self.piece)
        })
    }
}
