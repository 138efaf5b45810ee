//! The paper's scene against its check vectors and against itself.

use approx::assert_abs_diff_eq;
use dvi::Variational;
use lgvi::{dvi, lie};
use lie::{Mat3, Vec3};

use crate::common::{attitude_error, paper, reference, run};

#[test]
fn conserved_quantities_at_the_start() {
    let (model, start) = paper();
    let kept = model.conserved(&start).unwrap();
    assert_abs_diff_eq!(kept.energy, 9.203817003436, epsilon = 5e-13);
    assert_abs_diff_eq!(
        kept.angular,
        Vec3([0.2696, 14.3401241, 51.545892]),
        epsilon = 5e-8
    );
    assert_abs_diff_eq!(
        kept.linear,
        Vec3([0.0, -1.1316e-4, -6.0e-5]),
        epsilon = 5e-15
    );
}

#[test]
fn the_continuous_model_meets_the_check_vectors() {
    let at = reference(1.0);
    assert_abs_diff_eq!(
        at.g.1[0].vec3(),
        Vec3([-0.19314199126, -0.46673482317, -0.59976967738]),
        epsilon = 1e-9
    );
    let expected = Mat3([
        [0.89633885138, -0.41972917690, 0.14284285622],
        [0.43583642020, 0.89326597603, -0.11010227474],
        [-0.08138352623, 0.16094506558, 0.98360226084],
    ]);
    assert_abs_diff_eq!(*at.g.0[0].matrix(), expected, epsilon = 1e-9);
    let at = reference(10.0);
    assert_abs_diff_eq!(
        at.g.1[0].vec3(),
        Vec3([0.6272676785, 0.2612177644, 0.9992651000]),
        epsilon = 1e-9
    );
    let expected = Mat3([
        [-0.6904711660, -0.6153964703, 0.3801798959],
        [0.7195183392, -0.6383909395, 0.2734051352],
        [0.0744508457, 0.4623247697, 0.8835795826],
    ]);
    assert_abs_diff_eq!(*at.g.0[0].matrix(), expected, epsilon = 1e-9);
}

#[test]
fn the_method_is_of_order_one() {
    let (model, start) = paper();
    let end = reference(10.0);
    let integrator = || Variational::new(model.clone());
    let error = |steps| attitude_error(&run(integrator(), &start, 10.0, steps), &end);
    let errors = [2_000, 5_000, 10_000].map(error);
    for (error, expected) in errors.iter().zip([5.33e-2, 2.14e-2, 1.07e-2]) {
        assert!((error / expected - 1.0).abs() < 0.03, "{errors:?}");
    }
    let order = (errors[0] / errors[2]).ln() / 5.0_f64.ln();
    assert!((order - 1.0).abs() < 0.03, "{errors:?}");
}
