//! Random scenes.

use articulated_fluid::Ellipsoid;
use articulated_fluid::Scene;
use articulated_fluid::scene::{Mobility, SceneBody, SceneJoint, StartVelocity};
use lie::{LieGroup, SO3, Tangent, Vec3};
use rand::rngs::SmallRng;
use rand::{RngExt, SeedableRng};

/// Bodies of a scene, at most.
const BODIES: usize = 6;

/// Scene number `case`: a tree of one to six ellipsoids, some dry, some light, some under gravity or on springs, some in a plane.
pub fn scene(seed: u64, case: u64) -> Scene {
    let mut random = Random(SmallRng::seed_from_u64(
        seed.wrapping_mul(0x9e37_79b9).wrapping_add(case),
    ));
    let count = random.0.random_range(1..=BODIES);
    let density = if random.chance(0.4) { 0.0 } else { 1000.0 };
    let gravity = if random.chance(0.3) {
        random.vector(9.81)
    } else {
        Vec3::zero()
    };
    let stiffness = if random.chance(0.3) { 1.0 } else { 0.0 };
    let bodies: Vec<SceneBody> = (0..count).map(|i| random.body(i, density)).collect();
    let joints = (1..count).map(|child| {
        let parent = random.0.random_range(0..child);
        let reach = |body: &SceneBody| body.semi_axes().map_or(1.0, |axes| axes[0]);
        SceneJoint {
            name: bodies[child].name.clone(),
            parent,
            child,
            at_parent: random.vector(1.5 * reach(&bodies[parent])).0,
            at_child: random.vector(1.5 * reach(&bodies[child])).0,
            mobility: Mobility {
                stiffness: stiffness * random.between(0.0, 1.0) * bodies[child].total_inertia[0][0],
                ..Mobility::default()
            },
        }
    });
    let joints = joints.collect();
    Scene {
        gravity: gravity.0,
        density,
        bodies,
        mount: None,
        joints,
        position: random.vector(2.0).0,
        velocity: StartVelocity::Given(random.vector(0.5).0),
        ..empty()
    }
}

/// A scene with nothing in it; the keys that only a file has are as if it had none.
fn empty() -> Scene {
    Scene::parse(articulated_fluid::scene::EXAMPLE, "example.toml").expect("the example is a scene")
}

struct Random(SmallRng);

impl Random {
    fn chance(&mut self, p: f64) -> bool {
        self.0.random_bool(p)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    fn vector(&mut self, size: f64) -> Vec3 {
        Vec3([0; 3].map(|_| self.between(-size, size)))
    }

    /// A body of 0.1 m to 1 m, of its own mass or lighter by up to a thousand times.
    fn body(&mut self, index: usize, density: f64) -> SceneBody {
        let axes = [0; 3].map(|_| self.between(0.1, 0.5));
        let shape = Ellipsoid::new(axes).expect("semi-axes are positive");
        let lightness = if self.chance(0.2) { 1e-3 } else { 1.0 };
        let own = shape.volume() * 1000.0 * lightness;
        let mass = if density > 0.0 && self.chance(0.5) {
            shape.neutral_mass(density)
        } else {
            own
        };
        let attitude: SO3 = SO3::exp(&Tangent(self.vector(1.7).0));
        SceneBody {
            attitude: attitude.to_quaternion(),
            angular_velocity: self.vector(1.0).0,
            ..SceneBody::ellipsoid(&format!("body-{index}"), &shape, mass, density)
        }
    }
}
