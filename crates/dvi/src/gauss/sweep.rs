//! One sweep over the stages of a step: where they are, what the system says there, what that adds up to.

use lie::{AlgebraOver, DualOver, LieGroup, Over, RealGroup, Retraction, Scalar, VectorSpace};

use super::tableau::{Split, Tableau};
use crate::ContinuousSystem;

/// One stage: the chart's coordinates $(c_i, \pi_i)$, the state $(g_i, \mu_i)$ they stand for, and the rates there.
pub(super) struct Stage<G: RealGroup, S: Scalar> {
    /// $c_i$ with $g_i = g_k \tau(c_i)$.
    pub(super) c: AlgebraOver<G, S>,
    /// $\pi_i$, the momentum conjugate to $c_i$.
    pub(super) pi: DualOver<G, S>,
    /// $f_i = \tau(c_i)$.
    pub(super) f: Over<G, S>,
    /// $g_i = g_k f_i$.
    pub(super) g: Over<G, S>,
    /// $\mu_i = (\mathrm d\tau_{c_i}^{-1})^\ast \pi_i$.
    pub(super) mu: DualOver<G, S>,
    /// The velocity $\xi_i$.
    pub(super) xi: AlgebraOver<G, S>,
    /// The force $\tau_i$.
    pub(super) tau: DualOver<G, S>,
    /// $\dot c_i = \mathrm d\tau_{c_i}^{-1} \xi_i$.
    pub(super) c_dot: AlgebraOver<G, S>,
    /// $\dot\pi_i = (\mathrm d\tau_{c_i})^\ast \tau_i - \partial_c \langle \pi_i, \mathrm d\tau_c^{-1} \xi_i \rangle$.
    pub(super) pi_dot: DualOver<G, S>,
    /// $\mathrm{Ad}^\ast_{f_i^{-1}} \tau_i$: the force in the frame of the step's start.
    pub(super) force: DualOver<G, S>,
}

impl<G: RealGroup, S: Scalar> Stage<G, S> {
    fn new(g: &Over<G, S>) -> Self {
        Self {
            c: g.zero_algebra(),
            pi: g.zero_dual(),
            f: g.clone(),
            g: g.clone(),
            mu: g.zero_dual(),
            xi: g.zero_algebra(),
            tau: g.zero_dual(),
            c_dot: g.zero_algebra(),
            pi_dot: g.zero_dual(),
            force: g.zero_dual(),
        }
    }

    /// $\dot c$, $\dot\pi$ and the force from the velocity and the force of the system.
    #[inline(always)]
    pub(super) fn rates<R: Retraction>(&mut self) {
        let rates = (&mut self.c_dot, &mut self.pi_dot, &mut self.force);
        Over::<G, S>::chart_rates_into::<R>(
            (&self.c, &self.pi, &self.f),
            (&self.xi, &self.tau),
            rates,
        );
    }
}

/// The stages of a step and its end.
pub(super) struct Sweep<C: ContinuousSystem, S: Scalar> {
    pub(super) stages: Vec<Stage<C::Group, S>>,
    /// $c_1 = h \sum_j b_j \dot c_j$, the displacement of the whole step in the chart.
    pub(super) c: AlgebraOver<C::Group, S>,
    /// $f_k = \tau(c_1)$.
    pub(super) f: Over<C::Group, S>,
    /// $P - \mu_k = h \sum_i b_i \mathrm{Ad}^\ast_{f_i^{-1}} \tau_i$: the impulse of the step, in the frame of its start.
    pub(super) impulse: DualOver<C::Group, S>,
    /// $P$.
    pub(super) momentum: DualOver<C::Group, S>,
    /// $\mu_{k+1} = \mathrm{Ad}^\ast_{f_k} P$.
    pub(super) mu: DualOver<C::Group, S>,
    /// $\pi_1 = (\mathrm d\tau_{c_1})^\ast \mu_{k+1}$.
    pi: DualOver<C::Group, S>,
    /// A change of the force, at every stage; zero but for variations.
    pub(super) extra_force: DualOver<C::Group, S>,
    next_c: AlgebraOver<C::Group, S>,
    next_pi: DualOver<C::Group, S>,
    workspace: C::Workspace<S>,
}

impl<C: ContinuousSystem, S: Scalar> Sweep<C, S> {
    pub(super) fn new(system: &C, stages: usize, g: &Over<C::Group, S>) -> Self {
        Self {
            stages: (0..stages).map(|_| Stage::new(g)).collect(),
            c: g.zero_algebra(),
            f: g.clone(),
            impulse: g.zero_dual(),
            momentum: g.zero_dual(),
            mu: g.zero_dual(),
            pi: g.zero_dual(),
            extra_force: g.zero_dual(),
            next_c: g.zero_algebra(),
            next_pi: g.zero_dual(),
            workspace: system.workspace::<S>(g),
        }
    }

    /// The stages' places from the rates and a given $\pi_0$: $c_i = h \sum_j a_{ij} \dot c_j$ and $\pi_i = \pi_0 + h \sum_j a_{ij} \dot\pi_j$.
    #[inline(always)]
    pub(super) fn place_from(&mut self, tableau: &Tableau, h: S, start: &DualOver<C::Group, S>) {
        for i in 0..self.stages.len() {
            self.place_coordinates(tableau, i, h);
            let (stages, row) = (&self.stages, &tableau.forward[i]);
            combine(&mut self.next_pi, h, row, |j| &stages[j].pi_dot);
            self.next_pi.add_scaled(S::one(), start);
            core::mem::swap(&mut self.stages[i].pi, &mut self.next_pi);
        }
    }

    /// The $\pi_0$ that the step's end asks for, $\pi_1 - h \sum_j b_j \dot\pi_j$, into `start`; and the step's end.
    #[inline(always)]
    pub(super) fn end_to_start<R: Retraction>(
        &mut self,
        tableau: &Tableau,
        h: S,
        start: &mut DualOver<C::Group, S>,
    ) {
        self.end::<R>(tableau, h);
        let stages = &self.stages;
        combine(start, -h, &tableau.weights, |j| &stages[j].pi_dot);
        start.add_scaled(S::one(), &self.pi);
    }

    /// The step's end and the stages' places from the rates and from $P$:
    /// $c_i = h \sum_j a_{ij} \dot c_j$ and $\pi_i = \pi_1 - h \sum_j (b_j - a_{ij}) \dot\pi_j$.
    #[inline(always)]
    pub(super) fn place<R: Retraction>(&mut self, tableau: &Tableau, h: S) {
        self.end::<R>(tableau, h);
        for i in 0..self.stages.len() {
            self.place_coordinates(tableau, i, h);
            let (stages, row) = (&self.stages, &tableau.backward[i]);
            combine(&mut self.next_pi, -h, row, |j| &stages[j].pi_dot);
            self.next_pi.add_scaled(S::one(), &self.pi);
            core::mem::swap(&mut self.stages[i].pi, &mut self.next_pi);
        }
    }

    /// $c_i = h \sum_j a_{ij} \dot c_j$.
    #[inline(always)]
    pub(super) fn place_coordinates(&mut self, tableau: &Tableau, i: usize, h: S) {
        let (stages, row) = (&self.stages, &tableau.forward[i]);
        combine(&mut self.next_c, h, row, |j| &stages[j].c_dot);
        core::mem::swap(&mut self.stages[i].c, &mut self.next_c);
    }

    /// The step's end from the rates and from $P$.
    #[inline(always)]
    pub(super) fn end<R: Retraction>(&mut self, tableau: &Tableau, h: S) {
        let stages = &self.stages;
        combine(&mut self.c, h, &tableau.weights, |j| &stages[j].c_dot);
        Over::<C::Group, S>::chart_leave_into::<R>(
            &self.c,
            &self.momentum,
            (&mut self.f, &mut self.mu, &mut self.pi),
        );
    }

    /// The rates at the stages' places; all stages in one call, and none needs another.
    #[inline(always)]
    pub(super) fn evaluate<R: Retraction>(
        &mut self,
        system: &C,
        tableau: &Tableau,
        (t, h): (S, S),
        g: &Over<C::Group, S>,
    ) {
        for (stage, node) in self.stages.iter_mut().zip(&tableau.nodes) {
            Over::<C::Group, S>::chart_enter_into::<R>(
                &stage.c,
                &stage.pi,
                (&mut stage.f, &mut stage.mu),
            );
            g.compose_into(&stage.f, &mut stage.g);
            let (xi, tau) = (&mut stage.xi, &mut stage.tau);
            let t = t + h * S::from_f64(*node);
            system.velocity_and_force(t, &stage.g, &stage.mu, &mut self.workspace, xi, tau);
            stage.tau.add_scaled(S::one(), &self.extra_force);
            stage.rates::<R>();
        }
    }

    /// $P$ from the forces.
    #[inline(always)]
    pub(super) fn gather(&mut self, tableau: &Tableau, mu: &DualOver<C::Group, S>, h: S) {
        let stages = &self.stages;
        combine(&mut self.impulse, h, &tableau.weights, |j| &stages[j].force);
        self.momentum.set_sum(mu, S::one(), &self.impulse);
    }

    /// The rates at one state, for a step that has no step before it.
    pub(super) fn rates_at(
        &mut self,
        system: &C,
        t: S,
        g: &Over<C::Group, S>,
        mu: &DualOver<C::Group, S>,
    ) {
        let [first, rest @ ..] = &mut self.stages[..] else {
            return;
        };
        let (xi, tau) = (&mut first.xi, &mut first.tau);
        system.velocity_and_force(t, g, mu, &mut self.workspace, xi, tau);
        for stage in rest {
            stage.xi.copy_from(&first.xi);
            stage.tau.copy_from(&first.tau);
        }
    }
}

/// $h \sum_j w_j v_j$; the factor $h$ last, since a rounded $h w_j$ would be another method.
#[inline(always)]
pub(super) fn combine<'a, V: VectorSpace + 'a>(
    out: &mut V,
    h: V::Scalar,
    weights: &[Split],
    values: impl Fn(usize) -> &'a V,
) {
    out.set_zero();
    for (j, weight) in weights.iter().enumerate() {
        out.add_scaled(V::Scalar::from_f64(weight.low), values(j));
    }
    for (j, weight) in weights.iter().enumerate() {
        out.add_scaled(V::Scalar::from_f64(weight.high), values(j));
    }
    out.scale(h);
}

/// The same with plain weights, for guesses.
#[inline(always)]
pub(super) fn combine_plain<'a, V: VectorSpace + 'a>(
    out: &mut V,
    h: V::Scalar,
    weights: &[f64],
    values: impl Fn(usize) -> &'a V,
) {
    out.set_zero();
    for (j, weight) in weights.iter().enumerate() {
        out.add_scaled(V::Scalar::from_f64(*weight), values(j));
    }
    out.scale(h);
}
