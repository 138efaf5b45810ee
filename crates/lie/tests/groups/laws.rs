//! Every group here against the public law suite, in double and single precision.

use core::f64::consts::PI;

use lie::laws::{self, LawError};
use lie::{LieGroup, Power, R3, Rn, SE2, SE3, SO2, SO3, Scalar, Tangent, VectorSpace};
use proptest::prelude::*;

/// Lengths of the example velocities: zero, tiny, generic, and close to a half turn on both sides.
const LENGTHS: [f64; 7] = [0.0, 1e-8, 1e-4, 0.7, 1.9, PI - 1e-6, PI - 1e-3];
/// Directions, of unit length in the first three coordinates.
const DIRECTIONS: [[f64; 6]; 2] = [
    [0.6, 0.0, -0.8, 0.3, -1.2, 0.4],
    [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0, 1.0, 2.0, -0.5],
];

/// Velocities of the shape of `zero`, filled from the examples with the coordinates in rotation.
fn velocities<V: VectorSpace>(zero: &V) -> Vec<V> {
    let fill = |length: f64, direction: &[f64; 6]| {
        let mut xi = zero.clone();
        for i in 0..xi.dim() {
            let block = 1.0 / (1 + i / 6) as f64;
            xi.set(i, V::Scalar::from_f64(length * direction[i % 6] * block));
        }
        xi
    };
    LENGTHS
        .iter()
        .zip(DIRECTIONS.iter().cycle())
        .map(|(l, d)| fill(*l, d))
        .collect()
}

fn prove<G: LieGroup<WithScalar<<G as LieGroup>::Scalar> = G>>(shape: &G) {
    let velocities = velocities(&shape.zero_algebra());
    let elements: Vec<G> = velocities.iter().map(G::exp).collect();
    let report = laws::check(&elements, &velocities).unwrap_or_else(|e| panic!("{e}"));
    assert!(report.comparisons > 1000, "{report:?}");
    // Tolerances are worth something while the groups here come close to them, and safe while not too close.
    assert!(report.worst < 0.5, "{report:?}");
}

macro_rules! prove {
    ($test:ident, $scalar:ty: $($name:ident: $shape:expr;)+) => { $(
        mod $name {
            use super::*;
            #[test]
            fn $test() {
                type S = $scalar;
                prove(&$shape);
            }
        }
    )+ };
}

prove! { in_double_precision, f64:
    so3: SO3::<S>::identity();
    se3: SE3::<S>::identity();
    so2: SO2::<S>::identity();
    se2: SE2::<S>::identity();
    r3: R3::<S>::identity();
    r7: Rn::<7, S>::identity();
    pair: (SO3::<S>::identity(), R3::<S>::identity());
    fish: (SO3::<S>::identity(), R3::<S>::identity(), [SO3::<S>::identity(); 2]);
    quadruple: (SE3::<S>::identity(), SO3::<S>::identity(), R3::<S>::identity(), SO3::<S>::identity());
    array: [SE3::<S>::identity(); 3];
    power: Power::new(vec![SO3::<S>::identity(); 4]);
    planar: (SE2::<S>::identity(), SO2::<S>::identity(), [SO2::<S>::identity(); 2]);
    chain: (SE2::<S>::identity(), Power::new(vec![SO2::<S>::identity(); 3]));
    paper: (SE3::<S>::identity(), Power::new(vec![SO3::<S>::identity(); 2]));
}

/// Every group, and each kind of product once: their formulas are those of double precision.
mod single {
    use super::*;

    prove! { in_single_precision, f32:
        so3: SO3::<S>::identity();
        se3: SE3::<S>::identity();
        so2: SO2::<S>::identity();
        se2: SE2::<S>::identity();
        r3: R3::<S>::identity();
        planar: (SE2::<S>::identity(), [SO2::<S>::identity(); 2]);
        power: Power::new(vec![SO3::<S>::identity(); 2]);
    }
}

fn velocity<const N: usize>() -> impl Strategy<Value = Tangent<N>> {
    proptest::array::uniform(-1.7..1.7).prop_map(Tangent)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn so3_anywhere(a in velocity::<3>(), b in velocity::<3>(), c in velocity::<3>()) {
        laws::check(&[SO3::exp(&a), SO3::exp(&b)], &[a, b, c])?;
    }

    #[test]
    fn se3_anywhere(a in velocity::<6>(), b in velocity::<6>(), c in velocity::<6>()) {
        laws::check(&[SE3::exp(&a), SE3::exp(&b)], &[a, b, c])?;
    }

    #[test]
    fn power_anywhere(a in velocity::<3>(), b in velocity::<3>(), c in velocity::<3>()) {
        let (xi, eta) = (Power::new(vec![a, b]), Power::new(vec![c, a]));
        laws::check(&[Power::<SO3>::exp(&xi)], &[xi, eta])?;
    }
}

#[test]
fn no_examples_do_not_pass() {
    let zero = Tangent::<3>::zero();
    let none = laws::check::<SO3>(&[], &[]);
    assert!(matches!(none, Err(LawError::NoExamples { .. })), "{none:?}");
    let trivial = laws::check(&[SO3::<f64>::identity()], &[Tangent([1.0, 0.0, 0.0])]);
    assert!(
        matches!(trivial, Err(LawError::NoExamples { .. })),
        "{trivial:?}"
    );
    let still = laws::check(&[SO3::exp(&Tangent([1.0, 0.0, 0.0]))], &[zero]);
    assert!(
        matches!(still, Err(LawError::NoExamples { .. })),
        "{still:?}"
    );
    let empty = Power::<SO3>::new(vec![]);
    let nothing = laws::check(&[empty], &[Power::new(vec![])]);
    assert!(
        matches!(nothing, Err(LawError::NoExamples { .. })),
        "{nothing:?}"
    );
}
