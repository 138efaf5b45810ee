//! Random trees whose motion has a mirror plane, anywhere in space.

use articulated_fluid::planar::{PlanarBody, PlanarConfiguration, Plane};
use articulated_fluid::{ArticulatedBody, Body, Configuration, Joint};
use dvi::{Lagrangian, State};
use lie::{AlgebraOver, LieGroup, Mat3, Rn, SO2, SO3, Tangent, Vec3};
use proptest::prelude::*;

use crate::common::{alone, none, spd, stiffnesses};

/// A tree in the plane $z = 0$, body by body, each with the frame and the motion that it is given.
#[derive(Clone, Debug)]
pub struct Part {
    pub mass: Mat3,
    pub inertia: Mat3,
    /// Modulo the bodies before.
    pub parent: usize,
    pub at_parent: [f64; 2],
    pub at_child: [f64; 2],
    /// The body's frame seen from one with its third axis along the normal.
    pub frame: SO3,
    pub angle: f64,
    pub rate: f64,
    pub net_mass: f64,
    /// Of the joint to the parent.
    pub stiffness: f64,
}

#[derive(Clone, Debug)]
pub struct Flat {
    pub parts: Vec<Part>,
    /// The plane's frame in space.
    pub world: SO3,
    pub position: [f64; 3],
    pub velocity: [f64; 2],
    pub gravity: Option<[f64; 2]>,
}

fn flat(x: [f64; 2]) -> Vec3 {
    Vec3([x[0], x[1], 0.0])
}

fn about_z(angle: f64) -> SO3 {
    SO3::exp(&Tangent([0.0, 0.0, angle]))
}

impl Flat {
    pub fn model(&self) -> ArticulatedBody {
        let body = |part: &Part| {
            Body::new(
                part.frame.matrix().conjugate(part.mass),
                part.frame.matrix().conjugate(part.inertia),
            )
        };
        let bodies: Vec<Body> = self.parts.iter().map(body).collect();
        let joint = |child: usize| {
            let (part, parent) = (&self.parts[child], self.parts[child].parent % child);
            Joint {
                parent,
                child,
                at_parent: self.parts[parent].frame.rotate(flat(part.at_parent)),
                at_child: part.frame.rotate(flat(part.at_child)),
                kind: Default::default(),
            }
        };
        let joints: Vec<Joint> = (1..self.parts.len()).map(joint).collect();
        let stiffnesses: Vec<f64> = self.parts[1..].iter().map(|p| p.stiffness).collect();
        let model = ArticulatedBody::new(&bodies, &joints).expect("a model");
        let model = model.with_stiffness(&stiffnesses).expect("a model");
        let Some(gravity) = self.gravity else {
            return model;
        };
        let net: Vec<f64> = self.parts.iter().map(|part| part.net_mass).collect();
        let gravity = self.world.rotate(flat(gravity));
        model.with_gravity(gravity, &net).expect("a model")
    }

    pub fn configuration(&self) -> Configuration {
        let attitude = |part: &Part| {
            let turned = self.world.compose(&about_z(part.angle));
            turned.compose(&part.frame.inverse())
        };
        let x = self.world.rotate(Vec3(self.position));
        (self.parts.iter().map(attitude).collect(), alone(x), none())
    }

    pub fn velocity(&self) -> AlgebraOver<Configuration, f64> {
        let rate = |part: &Part| {
            let spin = part.frame.rotate(Vec3([0.0, 0.0, part.rate]));
            Tangent::from(spin)
        };
        let velocity = self.world.rotate(flat(self.velocity));
        (
            self.parts.iter().map(rate).collect(),
            alone(velocity),
            none(),
        )
    }

    pub fn state(&self) -> State<Configuration> {
        self.model()
            .state(0.0, self.configuration(), &self.velocity())
            .expect("a state")
    }

    pub fn plane(&self) -> Plane {
        Plane::find(&self.model(), &self.state()).expect("a plane")
    }

    pub fn planar(&self) -> (PlanarBody, State<PlanarConfiguration>) {
        let plane = self.plane();
        (plane.model(), plane.project(&self.state()))
    }
}

/// A rotation of the coordinate axes into each other, one of 24, exactly: two axes and their signs.
pub fn turn_of_axes(k: usize) -> SO3 {
    let (first, other, signs) = (k % 3, k / 3 % 2, [k / 6 % 2, k / 12 % 2]);
    let unit = |i: usize, sign: usize| {
        let mut x = Vec3::zero();
        x[i % 3] = 1.0 - 2.0 * sign as f64;
        x
    };
    let (x, y) = (unit(first, signs[0]), unit(first + 1 + other, signs[1]));
    SO3::from_matrix_unchecked(Mat3([x.0, y.0, x.cross(y).0]))
}

fn axes() -> impl Strategy<Value = SO3> {
    (0..24_usize).prop_map(turn_of_axes)
}

/// Block diagonal with the third axis apart.
fn mirrored() -> impl Strategy<Value = Mat3> {
    spd().prop_map(|a| {
        let [[xx, xy, _], [yx, yy, _], [_, _, zz]] = a.0;
        Mat3([[xx, xy, 0.0], [yx, yy, 0.0], [0.0, 0.0, zz]])
    })
}

fn point() -> impl Strategy<Value = [f64; 2]> {
    prop::array::uniform2(-1.5..1.5)
}

fn part() -> impl Strategy<Value = Part> {
    let motion = (-3.0..3.0, -1.0..1.0, -1.0..1.0);
    (
        mirrored(),
        mirrored(),
        0..8_usize,
        (point(), point()),
        axes(),
        motion,
    )
        .prop_map(
            |(mass, inertia, parent, (at_parent, at_child), frame, (angle, rate, net_mass))| Part {
                mass,
                inertia,
                parent,
                at_parent,
                at_child,
                frame,
                angle,
                rate,
                net_mass,
                stiffness: 0.0,
            },
        )
}

/// The same with joints of these stiffnesses: frames on an elastic one differ by a turn in the plane.
pub fn elastic(mut flat: Flat, stiffnesses: &[f64]) -> Flat {
    for (i, stiffness) in (1..flat.parts.len()).zip(stiffnesses) {
        let on = flat.parts[flat.parts[i].parent % i].frame;
        let part = &mut flat.parts[i];
        part.stiffness = *stiffness;
        if *stiffness != 0.0 {
            part.frame = on.compose(&about_z(0.7 * i as f64));
        }
    }
    flat
}

/// One to five bodies, with and without a weight, on free and elastic joints.
pub fn any_flat() -> impl Strategy<Value = Flat> {
    let position = prop::array::uniform3(-5.0..5.0);
    let parts = prop::collection::vec(part(), 1..=5);
    (
        parts,
        axes(),
        position,
        point(),
        prop::option::of(point()),
        stiffnesses(4),
    )
        .prop_map(|(parts, world, position, velocity, gravity, stiffnesses)| {
            let flat = Flat {
                parts,
                world,
                position,
                velocity,
                gravity,
            };
            elastic(flat, &stiffnesses)
        })
}

/// A displacement in the plane, up to `size` in angle and length.
pub fn displacement(bodies: usize, size: f64) -> impl Strategy<Value = PlanarConfiguration> {
    let angles = prop::collection::vec(-size..size, bodies);
    (angles, prop::array::uniform2(-size..size)).prop_map(|(angles, x)| {
        let turns = angles.into_iter().map(SO2::from_angle);
        (turns.collect(), alone(Rn(x)))
    })
}

/// A head with two tails in line along x, of ellipsoidal inertia, that beat about z.
pub fn fish() -> Flat {
    let part = |size: f64, at: f64, angle: f64, rate: f64| Part {
        mass: Mat3::diagonal([1.2, 2.2, 3.0]) * size,
        inertia: Mat3::diagonal([0.3, 0.5, 0.4]) * (size * size),
        parent: 0,
        at_parent: [at, 0.0],
        at_child: [-0.7 * at, 0.0],
        frame: SO3::identity(),
        angle,
        rate,
        net_mass: 0.0,
        stiffness: 0.0,
    };
    Flat {
        parts: vec![
            part(1.0, 0.0, 0.1, 0.2),
            part(0.5, -0.9, 0.4, 1.0),
            part(0.5, 0.9, -0.3, -0.6),
        ],
        world: SO3::identity(),
        position: [0.3, -0.2, 0.7],
        velocity: [0.4, 0.1],
        gravity: None,
    }
}

/// The same motion in another coordinate plane, the bodies in other frames.
pub fn moved(mut flat: Flat) -> Flat {
    flat.world = turn_of_axes(7);
    for (i, part) in flat.parts.iter_mut().enumerate() {
        part.frame = turn_of_axes(4 + 5 * i);
    }
    flat
}
