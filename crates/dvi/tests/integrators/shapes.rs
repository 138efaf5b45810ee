//! Velocities that do not fit their configuration.

use dvi::{Context, Lagrangian, ShapeError, System};
use lie::{AlgebraOver, LieGroup, Over, Power, Rn, Scalar, Tangent, VectorSpace};

/// Two rows of particles of 2 kg, as many as the configuration has, with two in the first row at most.
struct Rows;

type Group = (Power<Rn<1>>, Power<Rn<1>>);

impl System for Rows {
    type Group = Group;

    fn fits(&self, (a, _): &Group) -> bool {
        a.len() <= 2
    }
}

impl Lagrangian for Rows {
    fn value<S: Scalar>(
        &self,
        _: Context<S>,
        _: &Over<Group, S>,
        (a, b): &AlgebraOver<Group, S>,
    ) -> S {
        let squares = a.iter().chain(b.iter()).map(|v| v[0] * v[0]);
        squares.fold(S::zero(), |sum, square| sum + square)
    }
}

type Velocity = <Group as LieGroup>::Algebra;

fn configuration([a, b]: [usize; 2]) -> Group {
    let row = |n: usize| (0..n).map(|i| Rn([i as f64])).collect();
    (row(a), row(b))
}

fn velocity([a, b]: [usize; 2]) -> Velocity {
    let row = |n: usize| (0..n).map(|i| Tangent([1.0 + i as f64])).collect();
    (row(a), row(b))
}

/// All sizes up to three against all: also rows of as many particles in all, but not each.
#[test]
fn a_velocity_of_another_shape_is_refused_and_no_other() {
    let sizes = || (0..4).flat_map(|a| (0..4).map(move |b| [a, b]));
    for of_g in sizes() {
        for of_xi in sizes() {
            let (g, xi) = (configuration(of_g), velocity(of_xi));
            let expected = match (of_g[0] <= 2, of_g == of_xi) {
                (false, _) => Some(ShapeError::Configuration),
                (true, false) => Some(ShapeError::Velocity {
                    expected: of_g[0] + of_g[1],
                    found: of_xi[0] + of_xi[1],
                }),
                (true, true) => None,
            };
            let state = Rows.state(0.5, g.clone(), &xi);
            assert_eq!(state.as_ref().err().copied(), expected);
            assert_eq!(Rows.legendre(0.5, &g, &xi).err(), expected);
            assert_eq!(Rows.energy(0.5, &g, &xi).err(), expected);
            if let Ok(state) = state {
                let twice: Vec<_> = xi.coordinates().iter().map(|v| 2.0 * v).collect();
                assert_eq!(state.mu.coordinates(), twice);
                assert_eq!((state.t, state.g), (0.5, g));
            }
        }
    }
}

#[test]
fn the_message_says_what_to_do() {
    let refused = Rows.state(0.0, configuration([1, 2]), &velocity([1, 1]));
    assert_eq!(
        refused.unwrap_err().to_string(),
        "the velocity does not have the configuration's shape (3 coordinates, found 2); \
         make it of `g.zero_algebra()`"
    );
}
