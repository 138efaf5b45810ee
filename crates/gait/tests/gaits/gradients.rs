//! Gradients of a stroke against central differences.

use articulated_fluid::Scene;
use gait::{Chain, Effort, Fourier, net_with_gradient};
use lie::{LieGroup, VectorSpace};
use proptest::prelude::*;

use crate::swimmers::trees;

const PARTS: usize = 24;

fn strokes() -> impl Strategy<Value = (Scene, Fourier)> {
    (trees(), 1..4_usize).prop_flat_map(|(scene, order)| {
        let count = Chain::new(&scene).expect("a chain").dim() * (2 * order + 1);
        let coefficients = prop::collection::vec(-0.4..0.4, count);
        coefficients.prop_map(move |coefficients| {
            (
                scene.clone(),
                Fourier::new(1.3, order, coefficients).expect("a stroke"),
            )
        })
    })
}

fn moved(stroke: &Fourier, k: usize, by: f64) -> Fourier {
    let mut coefficients = stroke.coefficients().to_vec();
    coefficients[k] += by;
    Fourier::new(1.3, stroke.order(), coefficients).expect("a stroke")
}

/// The step of central differences whose truncation and rounding are both about 1e-10.
const STEP: f64 = 1e-5;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    #[test]
    fn the_net_motion_changes_as_its_gradient_says((scene, stroke) in strokes(), pick in 0..1000_usize) {
        let chain = Chain::new(&scene).expect("a chain");
        let k = pick % stroke.coefficients().len();
        let (g, gradient) = net_with_gradient(&chain, &stroke, PARTS).expect("a motion");
        let end = |by: f64| net_with_gradient(&chain, &moved(&stroke, k, by), PARTS).expect("a motion").0;
        let chart = |by: f64| g.inverse().compose(&end(by)).log().expect("a small motion");
        let mut difference = chart(STEP) - chart(-STEP);
        difference.scale(0.5 / STEP);
        let apart = (difference - gradient[k]).max_magnitude();
        prop_assert!(apart < 1e-8 * (1.0 + gradient[k].max_magnitude()), "{difference:?} {:?}", gradient[k]);
    }

    #[test]
    fn efforts_change_as_their_gradients_say((scene, stroke) in strokes(), pick in 0..1000_usize) {
        let chain = Chain::new(&scene).expect("a chain");
        let k = pick % stroke.coefficients().len();
        for effort in [Effort::Length, Effort::Work] {
            let (value, gradient) = effort.with_gradient(&chain, &stroke, PARTS).expect("an effort");
            let at = |by: f64| effort.of(&chain, &moved(&stroke, k, by), PARTS).expect("an effort");
            prop_assert!((value - at(0.0)).abs() < 1e-12 * (1.0 + value));
            let difference = (at(STEP) - at(-STEP)) * (0.5 / STEP);
            prop_assert!((difference - gradient[k]).abs() < 1e-7 * (1.0 + gradient[k].abs()), "{effort:?}: {difference} {}", gradient[k]);
        }
    }
}
