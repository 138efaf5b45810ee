//! Time laws: derivatives against differences, splines through their points, and tables that end.

use articulated_fluid::motion::{Ends, Law, Sinusoid, Spline};
use articulated_fluid::{JointKind, Scene};
use lie::{Jet, SO3, Scalar, Vec3};
use proptest::prelude::*;

type J = <f64 as Scalar>::Jet;

fn differences(law: &dyn Law<1>, t: f64) -> Result<(), TestCaseError> {
    const STEP: f64 = 1e-5;
    for k in 0..4 {
        let at = |t: f64| law.derivative(t, k)[0];
        let slope = (at(t + STEP) - at(t - STEP)) / (2.0 * STEP);
        let told = law.derivative(t, k + 1)[0];
        let size = 1.0 + told.abs() + law.derivative(t, k + 3)[0].abs();
        // Truncation, 1e-10 of the third derivative, and rounding over the step.
        prop_assert!(
            (slope - told).abs() < 1e-9 * size * (1.0 + at(t).abs()),
            "{k} at {t}: {slope} {told}"
        );
    }
    Ok(())
}

proptest! {
    #[test]
    fn derivatives_of_a_sinusoid_are_those_of_differences(x in prop::array::uniform6(-1.0..1.0_f64), s in 0.05..0.95_f64) {
        let law = Sinusoid {
            bias: [x[0]],
            amplitude: [x[1]],
            frequency: 0.3 * x[2],
            phase: [x[3]],
            harmonics: vec![[[x[4]], [x[5]]], [[x[5]], [x[4]]]],
            ramp: 2.0,
        };
        differences(&law, 2.0 * s)?;
        differences(&law, 3.0 + s)?;
        let [y] = J::variable(2.0 * s, 0).smooth(&|t, k| law.derivative(t, k));
        prop_assert_eq!([y.value(), y.partial(0)], [law.derivative(2.0 * s, 0)[0], law.derivative(2.0 * s, 1)[0]]);
    }

    #[test]
    fn a_spline_goes_through_its_points_with_a_continuous_curvature(values in prop::collection::vec(-1.0..1.0_f64, 5..9), widths in prop::collection::vec(0.2..1.0_f64, 9), repeats in any::<bool>()) {
        let mut points: Vec<(f64, [f64; 1])> = vec![];
        let mut t = 0.3;
        for (value, width) in values.iter().zip(widths) {
            points.push((t, [*value]));
            t += width;
        }
        let ends = if repeats { Ends::Periodic } else { Ends::Natural };
        if repeats {
            points.push((t, points[0].1));
        }
        let spline = Spline::new(&points, ends).expect("a spline");
        for (t, value) in &points {
            prop_assert!((spline.derivative(*t, 0)[0] - value[0]).abs() < 1e-12);
            for k in 0..3 {
                let [before, after] = [-1e-9, 1e-9].map(|d| spline.derivative(t + d, k)[0]);
                let steep = spline.derivative(t + 1e-9, k + 1)[0].abs() + spline.derivative(t - 1e-9, k + 1)[0].abs();
                prop_assert!((after - before).abs() < 1e-8 * (1.0 + steep), "{k} at {t}: {before} {after}");
            }
        }
        let first = spline.span()[0];
        let width = spline.span()[1] - first;
        if repeats {
            let (here, there) = (spline.derivative(first + 0.1, 0)[0], spline.derivative(first + 0.1 + 3.0 * width, 0)[0]);
            prop_assert!((here - there).abs() < 1e-12 * (1.0 + spline.derivative(first + 0.1, 1)[0].abs()) * 10.0);
        } else {
            prop_assert_eq!(spline.told(), spline.span());
        }
    }
}

#[test]
fn a_hinge_without_an_axis_is_no_model() {
    use articulated_fluid::{ArticulatedBody, Body, Joint, ModelError};
    let body = Body::new(lie::Mat3::identity(), lie::Mat3::identity());
    let kind = JointKind::hinge(Vec3::zero(), SO3::identity());
    let joint = Joint::new([0, 1], [Vec3::zero(); 2], kind);
    let refused = ArticulatedBody::new(&[body; 2], &[joint]).expect_err("no axis");
    assert_eq!(refused, ModelError::Hinge { body: 1 });
}

#[test]
fn the_smallest_model_starts_without_momentum_too() {
    let text = "
        gravity = [0, 0, -9.81]
        fluid.density = 0
        start.momentum = 'zero'
        body = [{ name = 'a', mass = 1, inertia = [1, 2, 2] }, { name = 'b', mass = 2, inertia = [1, 1.5, 2], joint_rate = [0.3, -1, 2] }]
        joint = [{ parent = 'a', child = 'b', at_parent = [0.5, 0.1, 0], at_child = [-0.4, 0, 0.2] }]
    ";
    let scene = Scene::parse(text, "fall.toml").expect("a scene");
    let smallest = scene.smallest().expect("a model");
    let kept = smallest.model.conserved(&smallest.start).expect("finite");
    // Rounding of momenta of about 1 kg m²/s.
    assert!(kept.angular.norm() < 1e-14, "{kept:?}");
}

#[test]
fn storage_of_one_tree_is_not_taken_for_another_s() {
    use articulated_fluid::Evaluation;
    let scene = |angle: f64| {
        let text = format!(
            "
            fluid.density = 0
            body = [{{ name = 'a', mass = 1, inertia = [1, 2, 2] }}, {{ name = 'b', mass = 2, inertia = [1, 1.5, 2] }}]
            joint = [{{ parent = 'a', child = 'b', at_parent = [0.5, 0.1, 0], at_child = [-0.4, 0, 0.2], type = 'hinge', axis = [0, 0, 1],
              motion = {{ bias = {angle}, amplitude = 1, frequency = 1 }} }}]
            "
        );
        Scene::parse(&text, "one.toml").expect("a scene")
    };
    let mut work = Evaluation::default();
    for angle in [0.3, 1.2, 0.3] {
        let scene = scene(angle);
        let (model, state) = (
            scene.model().expect("a model"),
            scene.initial_state().expect("a state"),
        );
        let (mut xi, fresh) = (
            model.velocity(&state).expect("a state"),
            model.conserved(&state),
        );
        assert_eq!(model.conserved_in(&state, &mut work, &mut xi), fresh);
    }
}
