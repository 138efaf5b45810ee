//! The discrete Legendre transforms.

use lie::LieGroup;

use super::context::Context;
use super::discrete::{Derivatives, DiscreteLagrangian};

/// $\mathbb F^+ L_d (g_k, f_k) = \mathsf T_e^\ast \mathsf L_{f_k} \cdot \mathbf D_{f_k} L_d$: the momentum $\mu_{k+1}$, (44)–(46), of a step from `t`.
pub fn legendre_plus<L: DiscreteLagrangian>(
    lagrangian: &L,
    t: f64,
    g: &L::Group,
    f: &L::Group,
    h: f64,
) -> <L::Group as LieGroup>::Dual {
    derivatives(lagrangian, t, g, f, h).d_f
}

/// $\mathbb F^- L_d (g_k, f_k) = -\mathsf T_e^\ast \mathsf L_{g_k} \cdot \mathbf D_{g_k} L_d + \mathrm{Ad}^\ast_{f_k^{-1}} \left(\mathsf T_e^\ast \mathsf L_{f_k} \cdot \mathbf D_{f_k} L_d\right)$: the momentum $\mu_k$, (39)–(41), of a step from `t`.
pub fn legendre_minus<L: DiscreteLagrangian>(
    lagrangian: &L,
    t: f64,
    g: &L::Group,
    f: &L::Group,
    h: f64,
) -> <L::Group as LieGroup>::Dual {
    use lie::VectorSpace;
    let derivatives = derivatives(lagrangian, t, g, f, h);
    let mut mu = f.inverse().coadjoint(&derivatives.d_f);
    mu.add_scaled(-1.0, &derivatives.d_g);
    mu
}

fn derivatives<L: DiscreteLagrangian>(
    lagrangian: &L,
    t: f64,
    g: &L::Group,
    f: &L::Group,
    h: f64,
) -> Derivatives<L::Group, f64> {
    let mut out = Derivatives::new(g);
    let (at, mut work) = (Context::new(t, lagrangian.parameters()), Default::default());
    out.find(lagrangian, at, (g, f), h, &mut work);
    out
}
