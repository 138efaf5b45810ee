//! Accelerations of a robot in a vacuum at random states, as JSON: what `tools/urdf/compare.py` compares with Pinocchio's.
//!
//! `cargo run --release -p lgvi-urdf --example accelerations -- robot.urdf free|world [STATES]`

use std::env;
use std::error::Error;

use articulated_fluid::scene::{Mobility, StartVelocity};
use articulated_fluid::{ArticulatedBody, Configuration, JointKind, Scene};
use dvi::{Context, ContinuousSystem, State};
use lie::{DualNumber, Jet, LieGroup, RealGroup, VectorSpace};
use urdf::{Base, Options, load};

type Dual = DualNumber<f64>;

/// Numbers between -1 and 1, the same in each run (D. E. Knuth's constants).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> [f64; 3] {
        [self.number(), self.number(), self.number()]
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let (file, base, states) = match &arguments[..] {
        [file, base] => (file, base, 100),
        [file, base, states] => (file, base, states.parse()?),
        _ => return Err("give a URDF, free or world, and how many states".into()),
    };
    let base = match &base[..] {
        "free" => Base::Free,
        _ => Base::World,
    };
    let options = Options {
        base: Some(base),
        ..Options::default()
    };
    let mut scene = load(file.as_ref(), &options)?.scene;
    let (names, dampings): (Vec<_>, Vec<_>) = hinges(&mut scene)
        .map(|(name, hinge)| (name.to_owned(), hinge.load.damping))
        .unzip();
    println!(
        "{{\"joints\": {names:?}, \"dampings\": {dampings:?}, \"centre\": {:?}, \"states\": [",
        scene.position
    );
    let mut random = Random(20);
    for index in 0..states {
        let comma = if index > 0 { "," } else { "" };
        println!("{comma}{}", sample(&mut scene, &mut random)?);
    }
    println!("]}}");
    Ok(())
}

/// The hinges in the order of the model.
fn hinges(scene: &mut Scene) -> impl Iterator<Item = (&str, &mut Mobility)> {
    scene.joints.sort_by_key(|joint| joint.child);
    let mount = scene.mount.iter_mut();
    let mount = mount.map(|mount| (&mount.name[..], &mut mount.mobility));
    let joints = scene.joints.iter_mut();
    let all = mount.chain(joints.map(|joint| (&joint.name[..], &mut joint.mobility)));
    all.filter(|(_, mobility)| matches!(mobility.kind, JointKind::Hinge(_)))
}

/// A random state, and the accelerations there.
fn sample(scene: &mut Scene, random: &mut Random) -> Result<String, Box<dyn Error>> {
    let (mut angles, mut rates) = (vec![], vec![]);
    for (_, hinge) in hinges(scene) {
        (hinge.angle, hinge.rate) = (3.0 * random.number(), 2.0 * random.number());
        angles.push(hinge.angle);
        rates.push(hinge.rate);
    }
    let [x, y, z] = random.vector();
    let w = random.number();
    let length = (w * w + x * x + y * y + z * z).sqrt();
    let (omega, velocity) = (random.vector(), random.vector());
    let mut told = String::new();
    if scene.mount.is_none() {
        let head = &mut scene.bodies[0];
        head.attitude = [w, x, y, z].map(|x| x / length);
        head.angular_velocity = omega;
        told = format!(
            "\"quaternion\": {:?}, \"omega\": {omega:?}, \"velocity\": {velocity:?}, ",
            head.attitude
        );
        scene.velocity = StartVelocity::Given(velocity);
    }
    let accelerations = accelerations(&scene.model()?, &scene.initial_state()?);
    Ok(format!(
        "{{{told}\"angles\": {angles:?}, \"rates\": {rates:?}, \"accelerations\": {accelerations:?}}}"
    ))
}

/// The derivative of the velocity along the motion: of the attitude's, the position's, then the hinges'.
fn accelerations(model: &ArticulatedBody, State { g, mu, .. }: &State<Configuration>) -> Vec<f64> {
    let (mut xi, mut tau) = (g.zero_algebra(), g.zero_dual());
    let at = Context::new(0.0, &[]);
    model.velocity_and_force::<f64>(at, g, mu, &mut Default::default(), &mut xi, &mut tau);
    let mut mu_dot = Configuration::coadjoint_bracket(&xi, mu);
    mu_dot.add_scaled(1.0, &tau);

    // To first order in the time, which is the dual numbers' first direction.
    let first =
        |value, slope: f64| Dual::constant(value) + Dual::variable(0.0, 0) * Dual::constant(slope);
    let lifted = g.lift::<Dual>();
    let (mut step, mut momentum) = (lifted.zero_algebra(), lifted.zero_dual());
    for i in 0..xi.dim() {
        step.set(i, first(0.0, xi.get(i)));
        momentum.set(i, first(mu.get(i), mu_dot.get(i)));
    }
    let moved = lifted.compose(&LieGroup::cayley(&step));
    let (mut xi, mut tau) = (lifted.zero_algebra(), lifted.zero_dual());
    let at = Context::new(first(0.0, 1.0), &[]);
    model.velocity_and_force::<Dual>(
        at,
        &moved,
        &momentum,
        &mut Default::default(),
        &mut xi,
        &mut tau,
    );
    (0..xi.dim()).map(|i| xi.get(i).partial(0)).collect()
}
