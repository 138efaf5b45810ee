//! What loads cost: the chain on balls, without and with each of them on every body or joint.

use std::sync::Arc;

use articulated_fluid::motion::Sinusoid;
use articulated_fluid::{
    ArticulatedBody, Body, BodyLoad, Drag, Joint, JointKind, JointLoad, ModelError, Motion, Servo,
    Thrust, Torque,
};
use dvi::{Gauss, Variational};
use lie::{Mat3, SO3, Vec3};

/// A name, and a load put on every body or joint.
type Load = (
    &'static str,
    fn(ArticulatedBody) -> Result<ArticulatedBody, ModelError>,
);

/// A row for each load, for a chain of `n` bodies.
pub fn by_loads(n: usize) -> Result<(), Box<dyn std::error::Error>> {
    let loads: [Load; 9] = [
        ("none", Ok),
        ("weight", weight),
        ("spring", springs),
        ("damper", |tree| {
            in_joints(
                tree,
                JointLoad {
                    damping: 0.1,
                    ..JointLoad::default()
                },
            )
        }),
        ("torque", |tree| {
            in_joints(
                tree,
                JointLoad {
                    torque: Some(torque()),
                    ..JointLoad::default()
                },
            )
        }),
        ("servo", |tree| {
            in_joints(
                tree,
                JointLoad {
                    servo: Some(servo()),
                    ..JointLoad::default()
                },
            )
        }),
        ("drag", |tree| on_bodies(tree, &[drag()])),
        ("thrust", |tree| on_bodies(tree, &[thrust()])),
        ("all", all),
    ];
    println!(
        "{n} bodies, ns a body | {:>10} {:>8} {:>8}",
        "evaluation", "lgvi", "gauss-4"
    );
    for (name, load) in loads {
        let (model, start) = super::chain(n, |_| JointKind::Ball)?;
        row(name, (load(model)?, &start))?;
    }
    let (model, start) = super::chain(n, |_| JointKind::Ball)?;
    row("coupled", (coupled(&model)?, &start))
}

fn row(
    name: &str,
    (model, start): (ArticulatedBody, &super::Start),
) -> Result<(), Box<dyn std::error::Error>> {
    let n = model.bodies().len();
    let evaluation = super::evaluation(&model, start);
    let lgvi = super::step(Variational::new(model.clone()), start)?;
    let gauss = super::step(Gauss::new::<4>(model), start)?;
    let [evaluation, lgvi, gauss] = [evaluation, lgvi, gauss].map(|t| 1e9 * t / n as f64);
    println!("{name:>20} | {evaluation:>10.1} {lgvi:>8.1} {gauss:>8.1}");
    Ok(())
}

fn joints(tree: &ArticulatedBody) -> usize {
    tree.joints().len()
}

fn law(amplitude: [f64; 3]) -> Arc<Sinusoid<3>> {
    Arc::new(Sinusoid {
        amplitude,
        frequency: 1.0,
        ..Sinusoid::constant([0.0; 3])
    })
}

fn torque() -> Torque {
    Torque::Ball(law([0.01, 0.02, 0.03]))
}

fn servo() -> Servo {
    let (rest, turn) = (SO3::identity(), law([0.0, 0.01, 0.02]));
    Servo {
        stiffness: 0.3,
        damping: 0.1,
        target: Motion::Ball { rest, turn },
    }
}

fn in_joints(tree: ArticulatedBody, load: JointLoad) -> Result<ArticulatedBody, ModelError> {
    let loads = vec![load; joints(&tree)];
    tree.with_joint_loads(&loads)
}

fn springs(tree: ArticulatedBody) -> Result<ArticulatedBody, ModelError> {
    let stiffnesses = vec![0.3; joints(&tree)];
    tree.with_stiffness(&stiffnesses)
}

fn weight(tree: ArticulatedBody) -> Result<ArticulatedBody, ModelError> {
    let net = vec![0.01; tree.bodies().len()];
    tree.with_gravity(Vec3([0.0, 0.0, -9.81]), &net)
}

fn on_bodies(tree: ArticulatedBody, loads: &[BodyLoad]) -> Result<ArticulatedBody, ModelError> {
    let bodies = 0..tree.bodies().len();
    let all = bodies.flat_map(|i| loads.iter().map(move |load| (i, load.clone())));
    tree.with_loads_on_bodies(&all.collect::<Vec<_>>())
}

fn drag() -> BodyLoad {
    BodyLoad::Drag(Drag {
        linear: [0.1, 0.5, 0.5],
        quadratic: [0.2, 4.0, 2.5],
        angular_linear: [0.01, 0.1, 0.1],
        smooth_below: 0.01,
        ..Drag::default()
    })
}

fn thrust() -> BodyLoad {
    BodyLoad::Thrust(Thrust {
        force: law([0.01, 0.0, 0.02]),
        at: Vec3([-1.0, 0.1, 0.0]),
    })
}

fn all(tree: ArticulatedBody) -> Result<ArticulatedBody, ModelError> {
    let tree = springs(weight(on_bodies(tree, &[drag(), thrust()])?)?)?;
    let load = JointLoad {
        damping: 0.1,
        torque: Some(torque()),
        servo: Some(servo()),
    };
    in_joints(tree, load)
}

/// The same bodies with coupled inertia.
fn coupled(tree: &ArticulatedBody) -> Result<ArticulatedBody, ModelError> {
    let coupling = Mat3::diagonal([0.01, -0.02, 0.015]);
    let bodies: Vec<Body> = tree
        .bodies()
        .map(|body| Body { coupling, ..body })
        .collect();
    ArticulatedBody::new(&bodies, &tree.joints().collect::<Vec<Joint>>())
}
