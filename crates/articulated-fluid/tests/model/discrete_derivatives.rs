//! The derivatives (29)–(33) of the discrete Lagrangian (22) against dual numbers, differences and invariance.

use articulated_fluid::Configuration;
use dvi::System;
use lie::{JET_DIRECTIONS, Jet, LieGroup, SO3, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::common::*;

const H: f64 = 1e-3;

/// The numbers that a momentum over the duals is made of: value, then derivatives, of each coordinate.
fn numbers(mu: &Momentum<J>) -> Vec<f64> {
    let one =
        |x: J| core::iter::once(x.value()).chain((0..JET_DIRECTIONS).map(move |d| x.partial(d)));
    mu.coordinates().into_iter().flat_map(one).collect()
}

/// The size of what the sums of (29)–(33) are made of, times $h$: the rounding is relative to it.
fn scale(sample: &Sample) -> f64 {
    let turns = sample.f.0.iter().map(|f| f.minus_identity().frobenius());
    30.0 * turns.fold(sample.f.1[0].vec3().norm(), f64::max)
}

/// The size of the weights' and the elastic joints' part, times $h$: forces times lengths, and potentials.
fn weighs(sample: &Sample) -> f64 {
    let (gravity, masses) = sample.weights();
    let sizes = masses.iter().zip(sample.centres(&sample.g));
    let weight = gravity.norm() * sizes.map(|(m, x)| m.abs() * (1.0 + x.norm())).sum::<f64>();
    H * H * (weight + elastic(sample))
}

/// The most that the potential of the elastic joints can be.
fn elastic(sample: &Sample) -> f64 {
    2.0 * sample.stiffnesses.iter().sum::<f64>()
}

proptest! {
    #[test]
    fn the_closed_form_is_the_derivative_by_dual_numbers(sample in any_sample()) {
        let Sample { model, g, f, .. } = &sample;
        let (closed, jets) = (closed(model, g, f, H), by_jets(model, g, f, H));
        // In d_f the duals cancel off-diagonal terms up to 30, however small the displacement is.
        // d_g has no such terms, and is quadratic in a small displacement: relative accuracy in both.
        let (size, weighs) = (scale(&sample), weighs(&sample));
        let small = size * size.min(1.0) + weighs;
        assert_close(&closed.d_f.coordinates(), &jets.d_f.coordinates(), 1e-14 * (1.0 + size) / H);
        assert_close(&closed.d_g.coordinates(), &jets.d_g.coordinates(), 4e-15 * small / H);
    }

    #[test]
    fn the_closed_form_is_the_derivative_by_differences(sample in any_sample()) {
        /// The step of the difference: truncation 1e-10, rounding 1e-16 / 1e-5, both times a size up to 3e3.
        const STEP: f64 = 1e-5;
        const TOLERANCE: f64 = 3e-8;
        let Sample { model, g, f, .. } = &sample;
        let value = |g: &Configuration, f: &Configuration| action(model, g, f, 1.0);
        let derivatives = closed(model, g, f, 1.0);
        let dim = derivatives.d_f.dim();
        let mut differences = [vec![], vec![]];
        for i in 0..dim {
            let mut step = g.zero_algebra();
            let mut moved = |g: &Configuration, size: f64| {
                step.set(i, size);
                g.compose(&LieGroup::exp(&step))
            };
            let f_side = value(g, &moved(f, STEP)) - value(g, &moved(f, -STEP));
            let g_side = value(&moved(g, STEP), f) - value(&moved(g, -STEP), f);
            differences[0].push(f_side / (2.0 * STEP));
            differences[1].push(g_side / (2.0 * STEP));
        }
        assert_close(&derivatives.d_f.coordinates(), &differences[0], TOLERANCE);
        assert_close(&derivatives.d_g.coordinates(), &differences[1], TOLERANCE);
    }

    #[test]
    fn the_closed_form_holds_over_dual_numbers(sample in any_sample(), h in 0.5..2.0_f64) {
        let Sample { model, g, f, .. } = &sample;
        let h = J::variable(h, 5);
        for first in (0..g.zero_dual().dim()).step_by(JET_DIRECTIONS) {
            let (g, f) = (moved(g, first), moved(f, first));
            let (closed, jets) = (closed(model, &g, &f, h), by_jets(model, &g, &f, h));
            // Rounding of second derivatives of a size up to 1e3.
            assert_close(&numbers(&closed.d_f), &numbers(&jets.d_f), 1e-12);
            assert_close(&numbers(&closed.d_g), &numbers(&jets.d_g), 1e-12);
        }
    }

    #[test]
    fn the_position_enters_by_the_weight_alone(sample in any_sample(), x in vector(1e6)) {
        let Sample { model, g, f, .. } = &sample;
        let elsewhere = (g.0.clone(), alone(x), none());
        let (here, there) = (closed(model, g, f, H), closed(model, &elsewhere, f, H));
        prop_assert_eq!(here.d_f, there.d_f);
        prop_assert_eq!(&here.d_g, &there.d_g);
        let value = |g| action(model, g, f, H);
        if sample.floats() {
            prop_assert_eq!(here.d_g.1[0].vec3(), Vec3::zero());
            prop_assert_eq!(value(g), value(&elsewhere));
        }
        let force = sample.force();
        assert_close(&here.d_g.1[0].0, &(force * H).0, 1e-15 * H * force.norm());
        // Rounding of forces times the way, and of what cancels in the value.
        let work = force.dot(x - g.1[0].vec3()) * H;
        let size = value(g).abs() + H * (force.norm() * x.norm() + elastic(&sample));
        assert_close(&[value(&elsewhere) - value(g)], &[work], 1e-15 * size);
        let cyclic = if sample.floats() { translation(sample.bodies.len()) } else { 0..0 };
        prop_assert_eq!(System::cyclic(model), cyclic);
    }

    #[test]
    fn a_rotation_of_the_whole_system_and_of_gravity_changes_nothing(sample in any_sample(), q in attitude()) {
        let Sample { model, g, f, .. } = &sample;
        let whole = |r: &SO3| q.compose(r);
        let rotated = (g.0.iter().map(whole).collect(), alone(q.rotate(g.1[0].vec3())), none());
        let carried = (f.0.clone(), alone(q.rotate(f.1[0].vec3())), none());
        let mut turned = sample.clone();
        if let Some((gravity, _)) = &mut turned.weight {
            *gravity = q.rotate(*gravity);
        }
        let before = action(model, g, f, H);
        let after = action(&turned.rebuilt().model, &rotated, &carried, H);
        // Rounding of a quadratic form.
        let (size, weighs) = (scale(&sample), weighs(&sample));
        let tolerance = (1e-16 * size * size + 1e-15 * weighs) / H;
        assert_close(&[after], &[before], tolerance);
        // Its derivative at the identity: the moments on all attitudes balance those of the displaced momentum and the weights.
        let derivatives = closed(model, g, f, H);
        let moments = g.0.iter().zip(derivatives.d_g.0.iter()).map(|(r, d)| r.rotate(d.vec3()));
        let pulled = g.1[0].vec3().cross(derivatives.d_g.1[0].vec3());
        let moment = moments.fold(pulled, |sum, m| sum + m);
        let displaced = f.1[0].vec3().cross(derivatives.d_f.1[0].vec3());
        assert_close(&moment.0, &(sample.moment() * H - displaced).0, tolerance);
    }
}
