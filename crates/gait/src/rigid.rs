//! The inertia of bodies that move as one.

use lie::{Cotangent, Mat3, Scalar, Sym3, Tangent, Vec3};

/// The inertia about the origin of a frame: $P = M v + K \omega$ and $L = K^T v + J \omega$.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rigid<S> {
    mass: Sym3<S>,
    coupling: Mat3<S>,
    inertia: Sym3<S>,
}

impl<S: Scalar> Rigid<S> {
    /// A body's $M, C, J$ about its mass centre, turned by `c` and moved to `r`:
    /// $K = C - M \hat r$ and $J_0 = J + \hat r C + (\hat r C)^T - \hat r M \hat r$.
    pub(crate) fn of([m, coupling, j]: [&Mat3; 3], c: &Mat3<S>, r: Vec3<S>) -> Self {
        let mass = Sym3::upper(&m.lift()).turned(c);
        let own = c.conjugate(coupling.lift());
        let moved = r.hat() * own;
        let swept = mass.times_hat(r);
        Self {
            mass,
            coupling: own - swept,
            inertia: Sym3::upper(&j.lift()).turned(c) + Sym3::upper(&(moved + moved.transpose()))
                - Sym3::hat_times(r, &swept),
        }
    }

    /// Lets what hangs on it move along.
    pub(crate) fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.coupling += other.coupling;
        self.inertia += other.inertia;
    }

    /// $(L, P)$ of the velocity $(\omega, v)$.
    pub(crate) fn momentum(&self, xi: &Tangent<6, S>) -> Cotangent<6, S> {
        let (w, v) = xi.split();
        let angular = self.coupling.transpose_mul(v) + self.inertia * w;
        (angular, self.mass * v + self.coupling * w).into()
    }

    /// The velocity of a momentum, by $J - K^T M^{-1} K$.
    pub(crate) fn velocity(&self) -> impl Fn(&Cotangent<6, S>) -> Tangent<6, S> {
        let (mass, k) = (self.mass.ldl(), self.coupling);
        let columns = [0, 1, 2].map(|j| mass.solve(Vec3([0, 1, 2].map(|i| k[(i, j)]))));
        // The transpose of M^-1 K, row by row.
        let solved = Mat3(columns.map(|column| column.0));
        let own = self.inertia - Sym3::upper(&(solved * k));
        let turn = own.ldl();
        move |momentum| {
            let (angular, linear) = momentum.split();
            let w = turn.solve(angular - solved * linear);
            (w, mass.solve(linear - k * w)).into()
        }
    }
}

impl Rigid<f64> {
    /// $\sqrt{\mathrm{tr} J / \mathrm{tr} M}$ about the origin.
    pub(crate) fn gyration(&self) -> f64 {
        (self.inertia.matrix().trace() / self.mass.matrix().trace()).sqrt()
    }
}
