//! Frames inside a step of Gauss collocation, without further steps.

use articulated_fluid::Configuration;
use dvi::{Path, State};
use lie::{Mat3, R3, Rn, SO3, VectorSpace};

/// A step that was taken, with its stages.
///
/// Between them goes the polynomial through start, stages and end: of the configuration's numbers, with rotations brought back to the group,
/// and of the momenta. The $S$ stages are exact to $O(h^{S+1})$, and so is what lies between; the ends are those of the method, of order $2S$.
pub(crate) struct Dense {
    /// The steps before it.
    before: u64,
    /// Start, stages and end.
    states: Vec<State<Configuration>>,
}

impl Dense {
    pub(crate) fn new(before: u64, path: Path<Configuration>) -> Self {
        let states = path.states().to_vec();
        Self { before, states }
    }

    /// Whether it is the step after so many.
    pub(crate) fn is_after(&self, steps: u64) -> bool {
        self.before == steps
    }

    /// The state at a time inside the step.
    pub(crate) fn at(&self, t: f64) -> State<Configuration> {
        let weights = self.weights(t);
        let mut state = self.states[0].clone();
        state.t = t;
        let (turns, places, hinges) = &mut state.g;
        for (k, turn) in turns.iter_mut().enumerate() {
            let mut matrix = Mat3::zero();
            self.each(&weights, |weight, at| {
                matrix += *at.g.0[k].matrix() * weight
            });
            *turn = orthogonal(matrix);
        }
        for (k, place) in places.iter_mut().enumerate() {
            *place = R3::identity();
            self.each(&weights, |weight, at| add(place, weight, &at.g.1[k]));
        }
        for (k, hinge) in hinges.iter_mut().enumerate() {
            *hinge = Rn::identity();
            self.each(&weights, |weight, at| add(hinge, weight, &at.g.2[k]));
        }
        state.mu.set_zero();
        self.each(&weights, |weight, at| state.mu.add_scaled(weight, &at.mu));
        state
    }

    fn each(&self, weights: &[f64], mut with: impl FnMut(f64, &State<Configuration>)) {
        let pairs = weights.iter().zip(&self.states);
        pairs.for_each(|(weight, state)| with(*weight, state));
    }

    /// Those of the polynomial through all states (J. L. Lagrange).
    fn weights(&self, t: f64) -> Vec<f64> {
        let times = || self.states.iter().map(|state| state.t).enumerate();
        let weight = |(i, own): (usize, f64)| {
            let others = times().filter(|(j, _)| *j != i);
            others
                .map(|(_, other)| (t - other) / (own - other))
                .product()
        };
        times().map(weight).collect()
    }
}

fn add<const N: usize>(x: &mut Rn<N>, weight: f64, y: &Rn<N>) {
    x.0.iter_mut().zip(y.0).for_each(|(x, y)| *x += weight * y);
}

/// The rotation nearest to a matrix that is nearly one.
fn orthogonal(matrix: Mat3) -> SO3 {
    use lie::LieGroup;
    /// Each squares what is left of the error.
    const STEPS: usize = 4;
    let mut turn = SO3::from_matrix_unchecked(matrix);
    (0..STEPS).for_each(|_| turn.normalize());
    turn
}
