//! An ellipsoid in a perfect fluid, on $SE(3)$.

use std::f64::consts::PI;

use articulated_fluid::Ellipsoid;
use dvi::{Context, Lagrangian, System};
use lie::{SE3, Scalar, Tangent};

use super::{NamedSymmetry, Problem, ProblemError, Steady, checked, finite, left, positive, right};

/// Kirchhoff's ellipsoid, $L = \frac12 \sum_i J_i \omega_i^2 + \frac12 \sum_i M_i v_i^2$: total inertias and masses, the
/// body's and the fluid's, in the principal axes.
///
/// The fluid is without friction and circulation, at rest at infinity; no weight and no buoyancy.
/// Source: H. Lamb, *Hydrodynamics*, 6th ed. (1932), §§ 121–126.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kirchhoff {
    inertias: [f64; 3],
    masses: [f64; 3],
}

impl System for Kirchhoff {
    type Group = SE3;
}

impl Lagrangian for Kirchhoff {
    fn value<S: Scalar>(&self, _: Context<S>, _: &SE3<S>, xi: &Tangent<6, S>) -> S {
        let factors = self.inertias.iter().chain(&self.masses);
        let terms = factors.zip(xi.0).map(|(&i, x)| S::from_f64(i) * x * x);
        terms.fold(S::zero(), |sum, term| sum + term) * S::from_f64(0.5)
    }
}

impl Kirchhoff {
    /// The `body`, uniform and of mass `mass`, kg, in a fluid of density `density`, kg/m³.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`].
    pub fn new(body: &Ellipsoid, mass: f64, density: f64) -> Result<Self, ProblemError> {
        positive("mass", mass)?;
        positive("density of the fluid", density)?;
        let (dry, wet) = (body.dry_inertia(mass), body.added_inertia(density));
        let added = body.added_mass(density);
        Ok(Self {
            inertias: [0, 1, 2].map(|i| dry[i] + wet[i]),
            masses: added.map(|added| mass + added),
        })
    }

    /// The total inertias $J_i$, kg m².
    pub fn inertias(&self) -> [f64; 3] {
        self.inertias
    }

    /// The total masses $M_i$, kg.
    pub fn masses(&self) -> [f64; 3] {
        self.masses
    }

    /// The steady motion from `pose` along the principal axis `axis`: translation with `speed`, m/s, and rotation about
    /// the same axis with `spin`, rad/s.
    ///
    /// # Errors
    /// [`ProblemError::NoSuchAxis`]; [`ProblemError::NoPeriod`] at rest.
    pub fn steady(
        self,
        pose: SE3,
        axis: usize,
        speed: f64,
        spin: f64,
    ) -> Result<Problem<Self, Steady<SE3>>, ProblemError> {
        finite("speed or spin", &[speed, spin])?;
        let (mass, inertia) = self.along(axis)?;
        // A time in which it moves by its radius of gyration, where it does not turn.
        let time = match (speed.abs(), spin.abs()) {
            (0.0, 0.0) => return Err(ProblemError::NoPeriod),
            (speed, 0.0) => (inertia / mass).sqrt() / speed,
            (_, spin) => 2.0 * PI / spin,
        };
        let mut velocity = Tangent::zero();
        velocity[axis] = spin;
        velocity[3 + axis] = speed;
        let start = checked(self.state(0.0, pose, &velocity)?)?;
        Ok(Problem {
            name: "Kirchhoff's ellipsoid",
            lagrangian: self,
            start: start.clone(),
            exact: Steady { start, velocity },
            time,
            symmetries: self.symmetries(),
        })
    }

    /// The rate, 1/s, at which small perturbations of the pure translation along `axis` with `speed`, m/s, grow.
    ///
    /// With $V$ along axis $i$, Kirchhoff's equations linearised about it fall into two pairs, for $j \ne i$ and the
    /// third axis $k$. In the impulse $\delta p_j$ and the moment of impulse $\delta\pi_k$ they are $\delta\dot p_j = \mp M_i V \delta\pi_k / J_k$,
    /// $\delta\dot\pi_k = \pm V (M_i / M_j - 1)\ \delta p_j$, so that
    /// $$ \delta\ddot p_j = \lambda_j^2\ \delta p_j, \qquad \lambda_j^2 = V^2 \frac{M_i (M_j - M_i)}{M_j J_k}. $$
    /// The rate is the larger $\lambda_j$, and zero where both squares are not positive. Only the translation along the
    /// axis of the largest total mass, broadside on, is stable (Lamb, § 124).
    ///
    /// # Errors
    /// [`ProblemError::NoSuchAxis`].
    pub fn growth_rate(&self, axis: usize, speed: f64) -> Result<f64, ProblemError> {
        finite("speed", &[speed])?;
        let (mass, _) = self.along(axis)?;
        let square = |j: usize| {
            let k = 3 - axis - j;
            mass * (self.masses[j] - mass) / (self.masses[j] * self.inertias[k])
        };
        let squares = (0..3).filter(|&j| j != axis).map(square);
        Ok(squares.fold(0.0, f64::max).sqrt() * speed.abs())
    }

    fn along(&self, axis: usize) -> Result<(f64, f64), ProblemError> {
        match (self.masses.get(axis), self.inertias.get(axis)) {
            (Some(&mass), Some(&inertia)) => Ok((mass, inertia)),
            _ => Err(ProblemError::NoSuchAxis { axis }),
        }
    }

    /// Motions of space, and turns about an axis of revolution.
    fn symmetries(&self) -> Vec<NamedSymmetry<Tangent<6>>> {
        const SPACE: [&str; 6] = [
            "moment of impulse about x",
            "moment of impulse about y",
            "moment of impulse about z",
            "impulse along x",
            "impulse along y",
            "impulse along z",
        ];
        const BODY: [&str; 3] = [
            "moment of impulse about the body's x",
            "moment of impulse about the body's y",
            "moment of impulse about the body's z",
        ];
        let unit = |i: usize| {
            let mut zeta = Tangent::zero();
            zeta[i] = 1.0;
            zeta
        };
        let space = SPACE
            .into_iter()
            .enumerate()
            .map(|(i, name)| left(name, unit(i)));
        let round = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            self.masses[j] == self.masses[k] && self.inertias[j] == self.inertias[k]
        };
        let body = BODY.into_iter().enumerate().filter(|&(i, _)| round(i));
        space
            .chain(body.map(|(i, name)| right(name, unit(i))))
            .collect()
    }
}
