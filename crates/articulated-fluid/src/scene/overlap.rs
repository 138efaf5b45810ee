//! Ellipsoids that overlap at the start, most often by a wrong sign in a joint.

use std::fmt;

use lie::{Mat3, SO3, Vec3};

use super::{Scene, SceneBody};

/// Ellipsoids closer than this to touching, relative to the distance of their centres, only touch.
const TOUCHING: f64 = 1e-9;

/// Halvings of the interval of the contact function's maximum, at which the function is flat.
const HALVINGS: usize = 50;

/// Two bodies of a [`Scene`] whose ellipsoids overlap in the initial configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlap {
    /// Their indices in [`Scene::bodies`], ascending.
    pub bodies: [usize; 2],
    /// Their names.
    pub names: [String; 2],
    /// How far they must be moved apart along the line of their centres until they touch, m; for coinciding centres, where
    /// there is no such line, the sum of the smallest semi-axes.
    pub depth: f64,
}

impl fmt::Display for Overlap {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = &self.names;
        // Two digits, as Rust has no format of significant ones.
        let depth = format!("{:.1e}", self.depth);
        let depth: f64 = depth.parse().unwrap_or(self.depth);
        write!(
            formatter,
            "bodies {a:?} and {b:?} overlap by {depth:?} m along the line of their centres; \
             check the signs of the joint's points"
        )
    }
}

/// A body's ellipsoid in the reference frame.
struct Placed {
    body: usize,
    centre: Vec3,
    rotation: Mat3,
    semi_axes: Vec3,
    /// Radius of the sphere around it.
    radius: f64,
}

impl Scene {
    /// The pairs of bodies that overlap in the initial configuration, ascending; only of bodies with
    /// [semi-axes](SceneBody::semi_axes).
    ///
    /// ```
    /// use articulated_fluid::Scene;
    ///
    /// let text = "
    ///     fluid.density = 1000
    ///     body = [{ name = 'a', semi_axes = [3, 1, 1] }, { name = 'b', semi_axes = [2, 1, 1] }]
    ///     joint = [{ parent = 'a', child = 'b', at_parent = [3, 0, 0], at_child = [2, 0, 0] }]
    /// ";
    /// let overlaps = Scene::parse(text, "boat.toml")?.overlaps();
    /// assert_eq!(
    ///     overlaps[0].to_string(),
    ///     "bodies \"a\" and \"b\" overlap by 4.0 m along the line of their centres; \
    ///      check the signs of the joint's points"
    /// );
    /// # Ok::<(), articulated_fluid::SceneError>(())
    /// ```
    pub fn overlaps(&self) -> Vec<Overlap> {
        let placed = self.placed();
        let mut overlaps: Vec<_> = candidates(&placed)
            .into_iter()
            .filter_map(|(a, b)| self.overlap(a, b))
            .collect();
        overlaps.sort_by_key(|overlap| overlap.bodies);
        overlaps
    }

    fn overlap(&self, a: &Placed, b: &Placed) -> Option<Overlap> {
        let (a, b) = if a.body < b.body { (a, b) } else { (b, a) };
        let bodies = [a.body, b.body];
        Some(Overlap {
            bodies,
            names: bodies.map(|body| self.bodies[body].name.clone()),
            depth: depth(a, b)?,
        })
    }

    /// The ellipsoids, about the first body's mass centre: where that is does not matter.
    fn placed(&self) -> Vec<Placed> {
        let mut above = vec![None; self.bodies.len()];
        for joint in &self.joints {
            if let Some(above) = above.get_mut(joint.child) {
                *above = Some(joint);
            }
        }
        let mut frames: Vec<(Mat3, Vec3)> = Vec::with_capacity(self.bodies.len());
        for (body, joint) in self.bodies.iter().zip(above) {
            let rotation = *SO3::from_quaternion(body.attitude).matrix();
            let on_parent = joint.and_then(|joint| {
                let (turned, centre) = frames.get(joint.parent)?;
                Some(*centre + *turned * Vec3(joint.at_parent) - rotation * Vec3(joint.at_child))
            });
            frames.push((rotation, on_parent.unwrap_or(Vec3::zero())));
        }
        let bodies = self.bodies.iter().zip(frames).enumerate();
        bodies
            .filter_map(|(index, (body, frame))| Placed::new(index, body, frame))
            .collect()
    }
}

impl Placed {
    fn new(body: usize, scene_body: &SceneBody, (rotation, centre): (Mat3, Vec3)) -> Option<Self> {
        let semi_axes = scene_body.semi_axes?;
        centre.is_finite().then(|| Self {
            body,
            centre,
            rotation,
            semi_axes: Vec3(semi_axes),
            radius: semi_axes.into_iter().fold(0.0, f64::max),
        })
    }

    fn smallest(&self) -> f64 {
        self.semi_axes.0.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// $R \, \mathrm{diag}(a_i^2) R^T$ in units of `length`.
    fn squared(&self, length: f64) -> Mat3 {
        let squares = self.semi_axes.0.map(|a| (a / length).powi(2));
        self.rotation.conjugate(Mat3::diagonal(squares))
    }
}

/// The pairs of ellipsoids whose spheres overlap: sorted and swept along the axis on which all extend most.
fn candidates(placed: &[Placed]) -> Vec<(&Placed, &Placed)> {
    let low = |p: &Placed, axis: usize| p.centre[axis] - p.radius;
    let high = |p: &Placed, axis: usize| p.centre[axis] + p.radius;
    let extent = |axis: &usize| {
        let bottom = placed
            .iter()
            .map(|p| low(p, *axis))
            .fold(f64::INFINITY, f64::min);
        let top = placed
            .iter()
            .map(|p| high(p, *axis))
            .fold(f64::NEG_INFINITY, f64::max);
        top - bottom
    };
    let axis = (0..3)
        .max_by(|a, b| extent(a).total_cmp(&extent(b)))
        .unwrap_or(0);
    let mut sorted: Vec<&Placed> = placed.iter().collect();
    sorted.sort_by(|a, b| low(a, axis).total_cmp(&low(b, axis)));
    let mut pairs = Vec::new();
    for (index, a) in sorted.iter().enumerate() {
        let rest = sorted[index + 1..].iter();
        let beside = rest.take_while(|b| low(b, axis) < high(a, axis));
        let close = beside.filter(|b| (a.centre - b.centre).norm() < a.radius + b.radius);
        pairs.extend(close.map(|b| (*a, *b)));
    }
    pairs
}

/// How deep two ellipsoids overlap, m; `None` where they do not.
fn depth(a: &Placed, b: &Placed) -> Option<f64> {
    let line = b.centre - a.centre;
    let distance = line.norm();
    let length = a.radius.max(b.radius);
    let direction = line * (1.0 / distance);
    if !direction.is_finite() {
        return Some(a.smallest() + b.smallest());
    }
    let contact = contact(a.squared(length), b.squared(length), direction);
    let touching = length / contact.sqrt();
    let overlap = touching.is_finite() && distance < touching * (1.0 - TOUCHING);
    overlap.then_some(touching - distance)
}

/// The contact function of J. W. Perram and M. S. Wertheim (1985) for ellipsoids at distance 1 in the `direction` $u$,
/// $\max_\lambda \lambda (1 - \lambda) u^T G^{-1} u$ with $G = (1 - \lambda) A + \lambda B$: the square of the distance over
/// the one at which they touch. The maximum of this concave function is where its derivative vanishes.
fn contact(a: Mat3, b: Mat3, direction: Vec3) -> f64 {
    let (mut low, mut high, mut largest) = (0.0, 1.0, 0.0_f64);
    for _ in 0..HALVINGS {
        let lambda = 0.5 * (low + high);
        let weight = lambda * (1.0 - lambda);
        let x = (a * (1.0 - lambda) + b * lambda).inverse() * direction;
        let form = direction.dot(x);
        largest = largest.max(weight * form);
        let slope = (1.0 - 2.0 * lambda) * form - weight * x.dot((b - a) * x);
        if slope > 0.0 {
            low = lambda;
        } else {
            high = lambda;
        }
    }
    largest
}
