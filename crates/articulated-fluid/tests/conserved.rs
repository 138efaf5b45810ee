//! What the continuous flow keeps, the places of joints and centres, and the same state on $SE(3) \times SO(3)^n$.

mod common;

use articulated_fluid::{Configuration, OnSe3};
use common::*;
use dvi::{DiscreteLagrangian, State};
use lie::{Jet, RealGroup, SE3, SO3, Vec3, VectorSpace};
use proptest::prelude::*;

/// $\frac12 \langle \mu, \xi \rangle$, $p_x$ and $x \times p_x + \sum_i R_i p_i$ along the flow.
fn kept(sample: &Sample) -> [J; 7] {
    let (g, mu) = flow(sample);
    let (xi, _) = velocity_and_force::<J>(&sample.model, &g, &mu);
    let pairs = mu.coordinates().into_iter().zip(xi.coordinates());
    let twice = pairs.fold(J::constant(0.0), |sum, (p, x)| sum + p * x);
    let (px, orbital) = (mu.1.vec3(), g.1.vec3().cross(mu.1.vec3()));
    let spins = g.2.iter().zip(mu.2.iter()).map(|(r, p)| r.rotate(p.vec3()));
    let angular = spins.fold(orbital + g.0.rotate(mu.0.vec3()), |sum, spin| sum + spin);
    let ([a, b, c], [d, e, f]) = (px.0, angular.0);
    [twice * J::constant(0.5), a, b, c, d, e, f]
}

/// The centres $x$, then $x + R_0 d_{0i} - R_i d_{i0}$, over any dual numbers.
fn centres(sample: &Sample, g: &Configuration<J>) -> Vec<Vec3<J>> {
    let tails = sample.joints.iter().zip(g.2.iter()).map(|(joint, r)| {
        g.1.vec3() + g.0.rotate(joint.at_parent.lift()) - r.rotate(joint.at_child.lift())
    });
    core::iter::once(g.1.vec3()).chain(tails).collect()
}

/// (1) and (2), each in its body's frame.
fn centre_velocities(sample: &Sample) -> Vec<Vec3> {
    let Sample { joints, g, xi, .. } = sample;
    let (omega0, v) = (xi.0.vec3(), xi.1.vec3());
    let tails = joints.iter().zip(g.2.iter().zip(xi.2.iter()));
    let tails = tails.map(|(joint, (r, omega))| {
        let at_joint = v - g.0.rotate(joint.at_parent.hat() * omega0);
        r.inverse_rotate(at_joint) + joint.at_child.hat() * omega.vec3()
    });
    core::iter::once(g.0.inverse_rotate(v))
        .chain(tails)
        .collect()
}

fn attitudes(g: &Configuration) -> Vec<SO3> {
    core::iter::once(g.0).chain(g.2.iter().copied()).collect()
}

fn state(sample: &Sample) -> State<Configuration> {
    let (g, mu) = (sample.g.clone(), sample.mu());
    State { t: 0.25, g, mu }
}

fn flat(points: &[Vec3]) -> Vec<f64> {
    points.iter().flat_map(|point| point.0).collect()
}

proptest! {
    #[test]
    fn the_flow_keeps_energy_and_momenta(sample in any_sample()) {
        let kept = kept(&sample);
        // Rounding of forces and velocities up to 1e2, times the condition of the inertia.
        assert_close(&kept.map(|x| x.partial(0)), &[0.0; 7], 1e-12);
        let found = sample.model.conserved(&state(&sample)).expect("the model's state");
        let found = [&[found.energy][..], &found.linear.0, &found.angular.0].concat();
        assert_close(&found, &kept.map(|x| x.value()), 1e-13);
    }

    #[test]
    fn the_energy_is_that_of_the_moving_centres(sample in any_sample()) {
        let (state, bodies) = (state(&sample), &sample.bodies);
        let xi = sample.model.velocity(&state).expect("the model's state");
        // Rounding times the condition of the inertia.
        assert_close(&xi.coordinates(), &sample.xi.coordinates(), 1e-12);
        let rates = core::iter::once(&sample.xi.0).chain(sample.xi.2.iter());
        let moving = bodies.iter().zip(centre_velocities(&sample)).zip(rates);
        let energy: f64 = moving
            .map(|((body, v), w)| (v.dot(body.mass * v) + w.vec3().dot(body.inertia * w.vec3())) / 2.0)
            .sum();
        let kept = sample.model.conserved(&state).expect("the model's state");
        assert_close(&[kept.energy], &[energy], 1e-12);
    }

    #[test]
    fn both_bodies_of_a_joint_meet_in_it(sample in any_sample()) {
        let Sample { model, joints, g, .. } = &sample;
        let centres: Vec<_> = model.centre_positions(g);
        let at: Vec<_> = model.joint_positions(g);
        prop_assert_eq!((centres.len(), at.len()), (joints.len() + 1, joints.len()));
        prop_assert_eq!(centres[0], g.1.vec3());
        let r = attitudes(g);
        let (mut of_head, mut of_tails) = (vec![], vec![]);
        for (i, joint) in joints.iter().enumerate() {
            of_head.push(centres[0] + r[0].rotate(joint.at_parent));
            of_tails.push(centres[i + 1] + r[i + 1].rotate(joint.at_child));
        }
        // Rounding of lengths up to 10.
        assert_close(&flat(&at), &flat(&of_head), 1e-14);
        assert_close(&flat(&at), &flat(&of_tails), 1e-14);
    }

    #[test]
    fn the_velocities_of_the_centres_are_the_printed_ones(sample in any_sample()) {
        let (g, _) = flow(&sample);
        let path = centres(&sample, &g);
        let here: Vec<f64> = path.iter().flat_map(|c| c.0.map(|x| x.value())).collect();
        let found: Vec<_> = sample.model.centre_positions(&sample.g);
        // Rounding of lengths up to 10.
        assert_close(&flat(&found), &here, 1e-14);
        let slopes: Vec<f64> = path.iter().flat_map(|c| c.0.map(|x| x.partial(0))).collect();
        let printed = centre_velocities(&sample).into_iter().zip(attitudes(&sample.g));
        let printed: Vec<_> = printed.map(|(v, r)| r.rotate(v)).collect();
        // The flow's velocity solves (10): rounding times the condition.
        assert_close(&slopes, &flat(&printed), 1e-12);
    }

    #[test]
    fn the_state_on_se3_is_the_same_state(sample in any_sample()) {
        let direct = state(&sample);
        let back = OnSe3::to_direct(&OnSe3::from_direct(&direct));
        prop_assert_eq!(&back.g, &direct.g);
        prop_assert_eq!(back.t, direct.t);
        // Rounding of a rotation and its inverse, of momenta up to 1e2.
        assert_close(&back.mu.coordinates(), &direct.mu.coordinates(), 1e-13);
    }

    #[test]
    fn the_discrete_lagrangian_on_se3_is_the_same_function(sample in any_sample()) {
        const H: f64 = 0.1;
        let Sample { model, g, f, .. } = &sample;
        let direct = DiscreteLagrangian::value::<f64>(model, g, f, H);
        let on_se3 = |translation: Vec3| {
            let g = (SE3::new(g.0, g.1.vec3()), g.2.clone());
            let f = (SE3::new(f.0, translation), f.2.clone());
            let end = lie::LieGroup::compose(&g, &f).0.translation;
            (OnSe3(model.clone()).value::<f64>(&g, &f, H), end)
        };
        let (value, end) = on_se3(g.0.inverse_rotate(f.1.vec3()));
        // Rounding of a quadratic form up to 1e3.
        assert_close(&[value], &[direct], 3e-12);
        assert_close(&end.0, &(g.1.vec3() + f.1.vec3()).0, 1e-14);
        let lifted = OnSe3(model.clone()).value::<J>(
            &(SE3::new(g.0, g.1.vec3()), g.2.clone()).lift(),
            &(SE3::new(f.0, g.0.inverse_rotate(f.1.vec3())), f.2.clone()).lift(),
            J::constant(H),
        );
        assert_close(&[lifted.value()], &[value], 3e-12);
    }
}
