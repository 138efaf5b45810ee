//! What the continuous flow keeps, the places of joints and centres, and the same state on $SE(3) \times SO(3)^n$.

use articulated_fluid::Configuration;
use dvi::DiscreteLagrangian;
use lie::{Jet, Power, RealGroup, SE3, Vec3, VectorSpace};
use proptest::prelude::*;

use crate::common::*;
use crate::on_se3::OnSe3;

/// $\frac12 \langle \mu, \xi \rangle + U$, $p_x$ and $x \times p_x + \sum_i R_i p_i$ along the flow.
fn along_the_flow(sample: &Sample) -> [J; 7] {
    let (g, mu) = flow(sample);
    let (xi, _) = velocity_and_force::<J>(&sample.model, &g, &mu);
    let pairs = mu.coordinates().into_iter().zip(xi.coordinates());
    let twice = pairs.fold(J::constant(0.0), |sum, (p, x)| sum + p * x);
    let (x, px) = (g.1[0].vec3(), mu.1[0].vec3());
    let spins = g.0.iter().zip(mu.0.iter()).map(|(r, p)| r.rotate(p.vec3()));
    let angular = spins.fold(x.cross(px), |sum, spin| sum + spin);
    let ([a, b, c], [d, e, f]) = (px.0, angular.0);
    let energy = twice * J::constant(0.5) + sample.potential(&g);
    [energy, a, b, c, d, e, f]
}

fn flat(points: &[Vec3]) -> Vec<f64> {
    points.iter().flat_map(|point| point.0).collect()
}

proptest! {
    #[test]
    fn the_flow_keeps_energy_and_momenta_but_for_the_weight(sample in any_sample()) {
        let found = along_the_flow(&sample);
        let rates = found.map(|x| x.partial(0));
        let (force, moment) = (sample.force(), sample.moment());
        // Rounding of forces and velocities up to 1e2, times the condition of the inertia.
        assert_close(&rates, &[&[0.0][..], &force.0, &moment.0].concat(), 1e-12);
        let vertical = Vec3([rates[4], rates[5], rates[6]]).dot(sample.weights().0);
        assert_close(&[vertical], &[0.0], 1e-12);
        let kept = sample.model.conserved(&sample.state()).expect("the model's state");
        let kept = [&[kept.energy][..], &kept.linear.0, &kept.angular.0].concat();
        assert_close(&kept, &found.map(|x| x.value()), 1e-13);
    }

    #[test]
    fn the_energy_is_that_of_the_moving_centres(sample in any_sample()) {
        let (state, bodies) = (sample.state(), &sample.bodies);
        let xi = sample.model.velocity(&state).expect("the model's state");
        // Rounding times the condition of the inertia.
        assert_close(&xi.coordinates(), &sample.xi.coordinates(), 1e-12);
        let moving = bodies.iter().zip(sample.centre_velocities()).zip(sample.g.0.iter());
        let kinetic: f64 = moving
            .zip(sample.xi.0.iter())
            .map(|(((body, v), r), w)| (r.inverse_rotate(v), w.vec3(), body))
            .map(|(v, w, body)| (v.dot(body.mass * v) + w.dot(body.inertia * w)) / 2.0)
            .sum();
        let kept = sample.model.conserved(&state).expect("the model's state");
        assert_close(&[kept.energy], &[kinetic + sample.potential(&sample.g)], 1e-12);
    }

    #[test]
    fn both_bodies_of_a_joint_meet_in_it(sample in any_sample()) {
        let Sample { model, joints, g, .. } = &sample;
        let centres: Vec<_> = model.centre_positions(0.0, g).expect("a state");
        let at: Vec<_> = model.joint_positions(0.0, g).expect("a state");
        prop_assert_eq!((centres.len(), at.len()), (joints.len() + 1, joints.len()));
        prop_assert_eq!(centres[0], g.1[0].vec3());
        let on = |body: usize, point: Vec3| centres[body] + g.0[body].rotate(point);
        let of_parents: Vec<_> = joints.iter().map(|j| on(j.parent, j.at_parent)).collect();
        let of_children: Vec<_> = joints.iter().map(|j| on(j.child, j.at_child)).collect();
        // Rounding of lengths up to 20.
        assert_close(&flat(&at), &flat(&of_parents), 2e-14);
        assert_close(&flat(&at), &flat(&of_children), 2e-14);
    }

    #[test]
    fn the_velocities_of_the_centres_are_the_slopes_of_their_paths(sample in any_sample()) {
        let (g, _) = flow(&sample);
        let path = sample.centres(&g);
        let here: Vec<f64> = path.iter().flat_map(|c| c.0.map(|x| x.value())).collect();
        let found: Vec<_> = sample.model.centre_positions(0.0, &sample.g).expect("a state");
        // Rounding of lengths up to 20.
        assert_close(&flat(&found), &here, 2e-14);
        let slopes: Vec<f64> = path.iter().flat_map(|c| c.0.map(|x| x.partial(0))).collect();
        // The flow's velocity solves (10): rounding times the condition.
        assert_close(&slopes, &flat(&sample.centre_velocities()), 1e-12);
    }

    #[test]
    fn the_state_on_se3_is_the_same_state(sample in any_sample()) {
        let direct = sample.state();
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
        let direct = action(model, g, f, H);
        let pose = |g: &Configuration, x: Vec3| (SE3::new(g.0[0], x), Power::new(g.0[1..].to_vec()));
        let on_se3 = |translation: Vec3| {
            let (g, f) = (pose(g, g.1[0].vec3()), pose(f, translation));
            let end = lie::LieGroup::compose(&g, &f).0.translation;
            (OnSe3(model.clone()).value::<f64>(at_zero(), &g, &f, H), end)
        };
        let (x, dx) = (g.1[0].vec3(), f.1[0].vec3());
        let back = g.0[0].inverse_rotate(dx);
        let (value, end) = on_se3(back);
        // Rounding of a quadratic form up to 1e3.
        assert_close(&[value], &[direct], 3e-12);
        assert_close(&end.0, &(x + dx).0, 1e-14);
        let lifted = OnSe3(model.clone()).value::<J>(
            at_zero(),
            &pose(g, x).lift(),
            &pose(f, back).lift(),
            J::constant(H),
        );
        assert_close(&[lifted.value()], &[value], 3e-12);
    }
}
