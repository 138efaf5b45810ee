//! Newton's method on the sweep, for steps too long for its iteration; and the derivative of a solved step.

use lie::{Batch, Jet, LieGroup, Retraction, Scalar, VectorSpace};

use super::sweep::{End, Sweep};
use super::tableau::Tableau;
use crate::numerics::duals::{add_constant, for_each_chunk, in_duals, lift, seeded, set_columns};
use crate::numerics::large::Large;
use crate::numerics::sizes::{Kinds, Weights};
use crate::variation::Varied;
use crate::{ContinuousSystem, State, Variation};

type J = <f64 as Scalar>::Jet;

/// The unknowns of a step, $X = (\dot c_1, \dot\pi_1, \dots, \dot c_s, \dot\pi_s, P)$, as the fixed point of the sweep:
/// $X = \Phi(X; g, \mu)$. Holds $1 - \Phi'$, from dual numbers.
pub(super) struct SweepNewton<C: ContinuousSystem> {
    matrix: Large,
    /// The step size of the matrix; zero where there is none.
    h: f64,
    /// The iterate.
    pub(super) x: Vec<f64>,
    /// $X - \Phi(X)$, then the correction.
    correction: Vec<f64>,
    sweep: Sweep<C, J>,
    weights: Option<Weights>,
    /// The largest velocities, rates of momenta and momenta of each kind.
    sizes: [Vec<f64>; 3],
    /// The kind of each coordinate.
    kind_of: Vec<usize>,
    unknowns: Vec<J>,
    varied: Varied<C::Group>,
    /// Of the system, for the matrices so far; see [`StepReport::evaluations`](crate::StepReport::evaluations).
    pub(super) evaluations: u32,
}

impl<C: ContinuousSystem> SweepNewton<C> {
    /// How many unknowns there are for vectors of `dim` coordinates.
    pub(super) fn unknowns(tableau: &Tableau, dim: usize) -> usize {
        dim * (2 * tableau.nodes.len() + 1)
    }

    pub(super) fn new(tableau: &Tableau, g: &C::Group) -> Self {
        let kinds = Kinds::of(g);
        let mut kind_of = vec![0; g.zero_dual().dim()];
        for (run, kind) in &kinds.runs {
            kind_of[run.clone()].fill(*kind);
        }
        let dim = Self::unknowns(tableau, kind_of.len());
        let varied = Varied::new(g);
        Self {
            matrix: Large::new(dim),
            h: 0.0,
            x: vec![0.0; dim],
            correction: vec![0.0; dim],
            sweep: Sweep::new(tableau, &varied.g),
            weights: None,
            sizes: [0, 1, 2].map(|_| vec![0.0; kinds.count]),
            kind_of,
            unknowns: vec![J::constant(0.0); dim],
            varied,
            evaluations: 0,
        }
    }

    /// Takes over what brings the kinds of coordinates to one unit.
    pub(super) fn weigh(&mut self, weights: Option<&Weights>) {
        if self.weights.is_none() {
            self.weights = weights.cloned();
        }
    }

    /// Whether there is a matrix for steps of size `h`.
    pub(super) fn fits(&self, h: f64) -> bool {
        self.h == h
    }

    pub(super) fn forget(&mut self) {
        self.h = 0.0;
    }

    /// The Newton correction at the iterate, whose image the sweep has found.
    pub(super) fn linearise<S: Batch<Item = f64>>(&mut self, image: &Sweep<C, S>) {
        image.write(&mut self.correction);
        for (entry, x) in self.correction.iter_mut().zip(&self.x) {
            *entry = x - *entry;
        }
        self.solve();
    }

    /// Moves the iterate by a multiple of the correction.
    pub(super) fn correct(&mut self, part: f64) {
        for (x, delta) in self.x.iter_mut().zip(&self.correction) {
            *x -= part * delta;
        }
    }

    /// Factorises $1 - \Phi'$ at the iterate.
    pub(super) fn renew<R: Retraction>(&mut self, system: &C, state: &State<C::Group>, h: f64) {
        self.set_state(system, state);
        self.sweep.extra_force = None;
        let dim = self.x.len();
        let stages = (dim / self.kind_of.len().max(1) - 1) / 2;
        let evaluations = in_duals(dim).wrapping_mul(stages as u32);
        self.evaluations = self.evaluations.wrapping_add(evaluations);
        for_each_chunk(dim, |first| {
            for (i, (unknown, x)) in self.unknowns.iter_mut().zip(&self.x).enumerate() {
                *unknown = seeded(*x, i, first);
            }
            self.map::<R>(system, state.t, h);
            set_columns(self.matrix.columns_mut(first), |row, direction| {
                let unit = f64::from(u8::from(row == first + direction));
                unit - self.unknowns[row].partial(direction)
            });
        });
        self.factorise();
        self.h = h;
    }

    /// With what the unknowns are of each kind for their units.
    fn factorise(&mut self) {
        let Self {
            matrix,
            x,
            sweep,
            weights,
            sizes,
            kind_of,
            ..
        } = self;
        let dim = kind_of.len();
        let last = x.len() / dim - 1;
        let which = |part: usize| if part == last { 2 } else { part % 2 };
        sizes.iter_mut().for_each(|sizes| sizes.fill(0.0));
        for (part, numbers) in x.chunks_exact(dim).enumerate() {
            sweep.kinds.raise(&mut sizes[which(part)], numbers);
        }
        // A kind that does not move has no size but beside the others.
        let [velocities, momenta @ ..] = sizes;
        if let Some(weights) = weights {
            weights.velocities.fill(velocities);
            momenta
                .iter_mut()
                .for_each(|sizes| weights.momenta.fill(sizes));
        }
        let size = |i: usize| sizes[which(i / dim)][kind_of[i % dim]];
        matrix.factorise(size);
    }

    /// Whether the branch of solutions from $h = 0$, where the matrix is the identity, has turned before the iterate: its matrix is singular
    /// where it turns.
    pub(super) fn has_turned<R: Retraction>(
        &mut self,
        system: &C,
        state: &State<C::Group>,
        h: f64,
    ) -> bool {
        self.renew::<R>(system, state, h);
        self.matrix.turns_over()
    }

    fn set_state(&mut self, system: &C, state: &State<C::Group>) {
        lift(
            system.parameters(),
            J::constant,
            &mut self.varied.parameters,
        );
        C::Group::convert_into::<f64, J>(&state.g, J::constant, &mut self.varied.g);
        self.varied.mu.set_zero();
        add_constant(&mut self.varied.mu, &state.mu);
    }

    /// Sets the unknowns to the iterate, not differentiated.
    fn start_from_iterate(&mut self) {
        for (unknown, x) in self.unknowns.iter_mut().zip(&self.x) {
            *unknown = J::constant(*x);
        }
    }

    /// $\Phi$ on the unknowns.
    fn map<R: Retraction>(&mut self, system: &C, t: f64, h: f64) {
        let (t, h) = (J::constant(t), J::constant(h));
        self.sweep.set_parameters(&self.varied.parameters);
        self.sweep.start_at(&self.varied.g);
        self.sweep.read(&self.unknowns);
        self.sweep.run_from_end::<R>(system, (t, h));
        self.sweep.gather(&self.varied.mu, h);
        self.sweep.write(&mut self.unknowns);
    }

    /// Solves $(1 - \Phi') \delta = $ `correction`, in place.
    fn solve(&mut self) {
        self.matrix.solve(&mut self.correction);
    }

    /// Carries variations of `state` over a solved step, by the implicit-function rule.
    pub(super) fn carry<R: Retraction, S: Batch<Item = f64>>(
        &mut self,
        system: &C,
        (state, h): (&State<C::Group>, f64),
        solved: &Sweep<C, S>,
        variations: &mut [Variation<C::Group>],
    ) {
        solved.write(&mut self.x);
        self.renew::<R>(system, state, h);
        for chunk in variations.chunks_mut(lie::JET_DIRECTIONS) {
            self.varied.enter((system.parameters(), state), chunk);
            self.sweep.extra_force = Some(self.varied.force.clone());
            self.start_from_iterate();
            self.map::<R>(system, state.t, h);
            let images = self.unknowns.clone();
            self.start_from_iterate();
            for direction in 0..chunk.len() {
                for (entry, image) in self.correction.iter_mut().zip(&images) {
                    *entry = image.partial(direction);
                }
                self.solve();
                for (unknown, slope) in self.unknowns.iter_mut().zip(&self.correction) {
                    *unknown += J::variable(0.0, direction).times(*slope);
                }
            }
            self.sweep.read(&self.unknowns);
            self.sweep.end::<R>(J::constant(h));
            let End { f, mu, .. } = &self.sweep.end;
            self.varied.leave(f, mu, chunk);
        }
    }
}
