//! What the bodies of a scene look like, and how they hang together.

use articulated_fluid::scene::{Form, Mobility, SceneBody};
use articulated_fluid::{JointKind, Motion, Scene};
use lie::Vec3;
use serde::Serialize;

use crate::colours::colours;

/// A body as it is drawn, and the joint that it hangs on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Solid {
    pub(crate) name: String,
    /// Semi-axes along the body's $x, y, z$, m.
    pub(crate) axes: [f64; 3],
    /// sRGB, 0 to 1.
    pub(crate) colour: [f64; 3],
    /// The parent's number; none of the first body.
    pub(crate) parent: Option<usize>,
    pub(crate) joint: Option<Joint>,
}

/// A joint to the parent, or to the world.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Joint {
    pub(crate) name: String,
    /// From the parent's mass centre, in the parent's frame, m; of the world, nothing.
    pub(crate) at_parent: [f64; 3],
    /// From the body's mass centre, in its frame, m.
    pub(crate) at_child: [f64; 3],
    /// Of a hinge, in the body's frame.
    pub(crate) axis: Option<[f64; 3]>,
    /// Whether it is no weld.
    pub(crate) moves: bool,
}

/// The bodies of a scene, in its order.
pub(crate) fn solids(scene: &Scene) -> Vec<Solid> {
    let mut parents = vec![None; scene.bodies.len()];
    let mut joints: Vec<Option<Joint>> = vec![None; scene.bodies.len()];
    if let Some(mount) = &scene.mount {
        joints[0] = Some(Joint::new(
            &mount.name,
            [[0.0; 3], mount.at_child],
            &mount.mobility,
        ));
    }
    for joint in &scene.joints {
        parents[joint.child] = Some(joint.parent);
        let points = [joint.at_parent, joint.at_child];
        joints[joint.child] = Some(Joint::new(&joint.name, points, &joint.mobility));
    }
    let reaches = reaches(scene);
    let colours = colours(&parents);
    let bodies = scene.bodies.iter().enumerate();
    bodies
        .map(|(i, body)| Solid {
            name: body.name.clone(),
            axes: axes(body, reaches[i]),
            colour: colours[i],
            parent: parents[i],
            joint: joints[i].clone(),
        })
        .collect()
}

impl Joint {
    fn new(name: &str, [at_parent, at_child]: [[f64; 3]; 2], mobility: &Mobility) -> Self {
        let axis = match &mobility.kind {
            JointKind::Hinge(hinge) => Some(hinge.axis.0),
            JointKind::Prescribed(Motion::Hinge { axis, .. }) => Some(axis.0),
            _ => None,
        };
        Self {
            name: name.to_owned(),
            at_parent,
            at_child,
            axis,
            moves: !matches!(mobility.kind, JointKind::Prescribed(Motion::Fixed(_))),
        }
    }
}

/// How far from each body's mass centre its farthest joint is, m.
fn reaches(scene: &Scene) -> Vec<f64> {
    let mut reaches = vec![0.0_f64; scene.bodies.len()];
    let mut reach = |body: usize, at: [f64; 3]| reaches[body] = reaches[body].max(Vec3(at).norm());
    if let Some(mount) = &scene.mount {
        reach(0, mount.at_child);
    }
    for joint in &scene.joints {
        reach(joint.parent, joint.at_parent);
        reach(joint.child, joint.at_child);
    }
    reaches
}

/// The semi-axes that a scene gives. Else those of the uniform ellipsoid with the body's moments of inertia, its own where they are known,
/// $a_x^2 = \frac{5}{2m} (J_y + J_z - J_x)$. It is made smaller where it would reach beyond the joints.
fn axes(body: &SceneBody, reach: f64) -> [f64; 3] {
    if let Some(axes) = body.semi_axes() {
        return axes;
    }
    let total = || [0, 1, 2].map(|i| body.total_mass[i][i]).iter().sum::<f64>() / 3.0;
    let (mass, inertia) = match body.form {
        Form::Given {
            mass: Some(mass),
            inertia: Some(inertia),
            ..
        } => (mass, inertia),
        _ => (total(), body.total_inertia),
    };
    let [x, y, z] = [0, 1, 2].map(|i| inertia[i][i]);
    let squares = [y + z - x, z + x - y, x + y - z].map(|square| square * 2.5 / mass);
    let largest = squares.into_iter().fold(0.0, f64::max).sqrt();
    // What the fluid adds can leave nothing of an axis.
    let axes = squares.map(|square| square.max(0.0).sqrt().max(0.1 * largest));
    match reach > 0.0 && largest > reach {
        true => axes.map(|axis| axis * reach / largest),
        false => axes,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat body that the fluid makes heavy to move across, and to turn.
    #[test]
    fn what_the_fluid_adds_does_not_change_how_a_body_is_drawn() {
        let text = |density: f64, added: &str| {
            format!(
                "fluid.density = {density}\nbody = [{{ name = 'a', mass = 1, inertia = [0.1, 0.2, 0.25], {added} }}]"
            )
        };
        let axes = |text: &str| solids(&Scene::parse(text, "s.toml").unwrap())[0].axes;
        let wet = text(
            1.0,
            "added_mass = [0.1, 0.2, 5], added_inertia = [0.3, 0.9, 0], volume = 1",
        );
        assert_eq!(axes(&text(0.0, "")), axes(&wet));
    }

    #[test]
    fn a_body_without_a_shape_is_drawn_as_long_as_its_joints_ask_for() {
        let text = "
            fluid.density = 0
            body = [
              { name = 'a', mass = 1, inertia = [0.01, 0.0833, 0.0833] },
              { name = 'b', mass = 1, inertia = [0.2, 0.2, 0.2] },
            ]
            joint = [{ parent = 'a', child = 'b', at_parent = [0.5, 0, 0], at_child = [-2, 0, 0] }]
        ";
        let solids = solids(&Scene::parse(text, "s.toml").unwrap());
        assert_eq!(solids[0].axes[0], 0.5);
        assert!(solids[0].axes[1] < 0.15 && solids[0].axes[1] > 0.1);
        // A uniform ball of J = 2/5 m r^2.
        assert!(
            solids[1]
                .axes
                .iter()
                .all(|axis| (axis - 0.5_f64.sqrt()).abs() < 1e-15)
        );
    }
}
