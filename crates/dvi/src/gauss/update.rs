//! The end of a step: momenta and configurations as sums, with what rounding loses carried over.

use lie::{RealGroup, VectorSpace};

use crate::numerics::sizes::Kinds;
use crate::{ContinuousSystem, State};

/// Steps between corrections of the rounding that moves the configuration off its group.
///
/// The compensated sum drifts off by rounding of the increments alone; a correction costs one rounding of the whole.
const NORMALIZE_EVERY: u64 = 1024;

/// Where the momentum in the frame of the identity is this much larger than in the body's, its sum would lose digits.
///
/// On a semidirect product $x \times p$ outweighs the rest far from the origin.
const FAR: f64 = 8.0;
/// Steps from one look at that to the next.
const LOOKS_EVERY: u32 = 8;

/// What is carried from a step to the next beside the state.
///
/// The momentum in the frame of the identity, $\mathrm{Ad}^\ast_{g_k^{-1}} \mu_k$, changes by the impulse alone. It is
/// summed with Kahan's compensation. So are the numbers of the configuration where they are sums of increments.
pub(super) struct Update<G: RealGroup> {
    /// The state that the carried numbers belong to.
    after: State<G>,
    carry: G,
    /// $\mathrm{Ad}^\ast_{g_k^{-1}} \mu_k$.
    spatial: G::Dual,
    spatial_carry: G::Dual,
    increment: G::Dual,
    steps: u64,
    known: bool,
    far: bool,
    /// Steps to the next look at that.
    looks: u32,
    kinds: Kinds,
    /// The momentum as numbers, and the largest of each kind, in the frame of the identity and in the body's.
    numbers: Vec<f64>,
    sizes: [Vec<f64>; 2],
}

impl<G: RealGroup> Update<G> {
    pub(super) fn new(g: &G) -> Self {
        let (zero, kinds) = (g.zero_dual(), Kinds::of(g));
        let after = State {
            t: 0.0,
            g: g.clone(),
            mu: zero.clone(),
        };
        Self {
            carry: g.zero_carry(),
            spatial: zero.clone(),
            spatial_carry: zero.clone(),
            increment: zero.clone(),
            steps: 0,
            known: false,
            far: false,
            looks: 0,
            numbers: vec![0.0; zero.dim()],
            sizes: [0, 1].map(|_| vec![0.0; kinds.count]),
            kinds,
            after,
        }
    }

    /// Forgets what was carried.
    pub(super) fn forget(&mut self) {
        self.known = false;
    }

    /// The state after the displacement `f` and the impulse. The impulse is in the frame of the step's start, or comes with the momentum
    /// `transported`. `None` where a number is not finite, or the system is not defined.
    pub(super) fn advance<C: ContinuousSystem<Group = G>>(
        &mut self,
        system: &C,
        state: &State<G>,
        h: f64,
        (f, impulse, transported): (&G, &G::Dual, &G::Dual),
    ) -> Option<&State<G>> {
        if !(self.known && self.after.g == state.g && self.after.mu == state.mu) {
            self.after.g.copy_from(&state.g);
            self.carry = state.g.zero_carry();
            self.begin_momentum(state);
            self.looks = 0;
        } else if self.far {
            self.begin_momentum(state);
        }
        state.g.inverse_coadjoint_into(impulse, &mut self.increment);
        self.add_increment();
        self.after.t = state.t + h;
        self.after.g.advance(f, &mut self.carry);
        self.steps += 1;
        if self.steps.is_multiple_of(NORMALIZE_EVERY) {
            self.after.g.normalize();
        }
        self.after
            .g
            .coadjoint_into(&self.spatial, &mut self.after.mu);
        if self.looks == 0 {
            self.far = self.is_far();
            self.looks = LOOKS_EVERY;
        }
        self.looks -= 1;
        if self.far {
            self.after.mu.copy_from(transported);
        }
        let State { t, g, mu } = &self.after;
        let finite = g.is_finite() && mu.max_magnitude().is_finite();
        self.known = finite && system.is_defined(*t, g);
        self.known.then_some(&self.after)
    }

    fn is_far(&mut self) -> bool {
        for (sizes, momentum) in self.sizes.iter_mut().zip([&self.spatial, &self.after.mu]) {
            momentum.write(&mut self.numbers);
            sizes.fill(0.0);
            self.kinds.raise(sizes, &self.numbers);
        }
        let [spatial, here] = &self.sizes;
        spatial.iter().zip(here).any(|(a, b)| *a > FAR * b)
    }

    fn begin_momentum(&mut self, state: &State<G>) {
        state.g.inverse_coadjoint_into(&state.mu, &mut self.spatial);
        self.spatial_carry.set_zero();
    }

    /// Kahan's sum, coordinate by coordinate.
    fn add_increment(&mut self) {
        self.spatial_carry.add_scaled(1.0, &self.increment);
        let wanted = &self.spatial_carry;
        self.increment.copy_from(&self.spatial);
        self.spatial.add_scaled(1.0, wanted);
        // What was wanted, less what the sum has grown by.
        self.spatial_carry.add_scaled(1.0, &self.increment);
        self.spatial_carry.add_scaled(-1.0, &self.spatial);
    }
}
