//! Ellipsoids that overlap at the start, most often by a wrong sign in a joint.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::ControlFlow;

use lie::{Mat3, SO3, Vec3};

use super::description::{Scene, SceneBody};

/// Ellipsoids closer than this to touching, relative to the distance of their centres, only touch.
const TOUCHING: f64 = 1e-9;

/// Halvings of the interval of the contact function's maximum, at which the function is flat.
const HALVINGS: usize = 50;

/// Sweeps of Jacobi's rotations: they converge quadratically.
const SWEEPS: usize = 8;

/// So many pairs of close bodies are looked at in any scene, and so many for each body of a large one: what closely packed bodies
/// have. Beyond, as where all bodies are in one place, the search would take the square of their number.
const PAIRS: usize = 1 << 19;
const PAIRS_OF_A_BODY: usize = 16;

/// The overlaps of a [`Scene`].
#[derive(Clone, Debug, PartialEq)]
pub struct Overlaps {
    /// The first of those found, ascending by the bodies.
    pub first: Vec<Overlap>,
    /// How many more were found.
    pub more: usize,
    /// Whether all pairs were looked at: else there may be still more.
    pub is_complete: bool,
}

impl Overlaps {
    /// In words, what is beyond the [first](Self::first) ones; `None` where nothing is.
    pub fn rest(&self) -> Option<String> {
        match (self.more, self.is_complete) {
            (0, true) => None,
            (more, true) => Some(format!("{more} more pairs of bodies overlap")),
            (more, false) => Some(format!(
                "{more} more pairs of bodies overlap, or still more"
            )),
        }
    }
}

/// Two bodies of a [`Scene`] whose ellipsoids overlap in the initial configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlap {
    /// Their indices in [`Scene::bodies`], ascending.
    pub bodies: [usize; 2],
    /// Their names.
    pub names: [String; 2],
    /// How far they must be moved apart along the line of their centres until they touch, m. Where the centres coincide
    /// there is no such line, and this is the sum of the smallest semi-axes.
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
    /// The bodies that overlap in the initial configuration, of those with [semi-axes](SceneBody::semi_axes): the `most` first pairs,
    /// and how many more.
    ///
    /// Time and memory are in proportion to the bodies, however many pairs overlap.
    ///
    /// ```
    /// use articulated_fluid::Scene;
    ///
    /// let text = "
    ///     fluid.density = 1000
    ///     body = [{ name = 'a', semi_axes = [3, 1, 1] }, { name = 'b', semi_axes = [2, 1, 1] }]
    ///     joint = [{ parent = 'a', child = 'b', at_parent = [3, 0, 0], at_child = [2, 0, 0] }]
    /// ";
    /// let overlaps = Scene::parse(text, "boat.toml")?.overlaps(10);
    /// assert_eq!(
    ///     overlaps.first[0].to_string(),
    ///     "bodies \"a\" and \"b\" overlap by 4.0 m along the line of their centres; \
    ///      check the signs of the joint's points"
    /// );
    /// assert_eq!((overlaps.more, overlaps.rest()), (0, None));
    /// # Ok::<(), articulated_fluid::SceneError>(())
    /// ```
    pub fn overlaps(&self, most: usize) -> Overlaps {
        let placed = self.placed();
        let (mut first, mut count) = (BTreeMap::new(), 0);
        let mut left = PAIRS.max(PAIRS_OF_A_BODY.saturating_mul(placed.len()));
        let searched = for_close_pairs(&placed, |a, b| {
            if left == 0 {
                return ControlFlow::Break(());
            }
            left -= 1;
            let (a, b) = if a.body < b.body { (a, b) } else { (b, a) };
            if let Some(depth) = depth(a, b) {
                count += 1;
                first.insert([a.body, b.body], depth);
                if first.len() > most {
                    first.pop_last();
                }
            }
            ControlFlow::Continue(())
        });
        Overlaps {
            more: count - first.len(),
            is_complete: searched.is_continue(),
            first: first.into_iter().map(|pair| self.overlap(pair)).collect(),
        }
    }

    fn overlap(&self, (bodies, depth): ([usize; 2], f64)) -> Overlap {
        Overlap {
            bodies,
            names: bodies.map(|body| self.bodies[body].name.clone()),
            depth,
        }
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
        let semi_axes = scene_body.semi_axes()?;
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
}

/// Calls `look` with the pairs of ellipsoids whose spheres overlap, until it breaks: sorted and swept along the axis on which all
/// extend most.
fn for_close_pairs(
    placed: &[Placed],
    mut look: impl FnMut(&Placed, &Placed) -> ControlFlow<()>,
) -> ControlFlow<()> {
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
    for (index, a) in sorted.iter().enumerate() {
        let rest = sorted[index + 1..].iter();
        let beside = rest.take_while(|b| low(b, axis) < high(a, axis));
        let mut close = beside.filter(|b| (a.centre - b.centre).norm() < a.radius + b.radius);
        close.try_for_each(|b| look(a, b))?;
    }
    ControlFlow::Continue(())
}

/// How deep two ellipsoids overlap, m; `None` where they do not.
fn depth(a: &Placed, b: &Placed) -> Option<f64> {
    let line = b.centre - a.centre;
    let distance = line.norm();
    let direction = line * (1.0 / distance);
    if !direction.is_finite() {
        return Some(a.smallest() + b.smallest());
    }
    let (semi_axes, direction) = seen_from(a, b, direction);
    // A bound of the contact function from below is one of the touching distance from above.
    let apart = (distance * distance).recip();
    let touching = 1.0 / contact(semi_axes, direction, apart).sqrt();
    let overlap = touching.is_finite() && distance < touching * (1.0 - TOUCHING);
    overlap.then_some(touching - distance)
}

/// In the frame in which the ellipsoid `a` is the unit sphere and the axes of `b` are the frame's: the semi-axes of `b`, and
/// the `direction`.
///
/// By Jacobi's rotations of the rows of $L$, $B = L L^T$: of slender ellipsoids $B$ itself would lose the short axes.
fn seen_from(a: &Placed, b: &Placed, direction: Vec3) -> ([f64; 3], [f64; 3]) {
    let turned = a.rotation.transpose() * b.rotation;
    let along = a.rotation.transpose_mul(direction);
    let row =
        |i: usize| Vec3([0, 1, 2].map(|j| turned[(i, j)] * (b.semi_axes[j] / a.semi_axes[i])));
    let mut rows = [0, 1, 2].map(row);
    let mut along = [0, 1, 2].map(|i| along[i] / a.semi_axes[i]);
    for (p, q) in [(0, 1), (0, 2), (1, 2)].repeat(SWEEPS) {
        if let Some((cos, sin)) = turn(rows[p], rows[q]) {
            (rows[p], rows[q]) = (rows[p] * cos - rows[q] * sin, rows[p] * sin + rows[q] * cos);
            (along[p], along[q]) = (
                along[p] * cos - along[q] * sin,
                along[p] * sin + along[q] * cos,
            );
        }
    }
    (rows.map(Vec3::norm), along)
}

/// Cosine and sine of the rotation that makes two rows orthogonal; `None` where they are.
fn turn(x: Vec3, y: Vec3) -> Option<(f64, f64)> {
    let product = x.dot(y);
    if product.abs() <= f64::EPSILON * x.norm() * y.norm() {
        return None;
    }
    let cot = (y.norm_squared() - x.norm_squared()) / (2.0 * product);
    let tan = cot.signum() / (cot.abs() + cot.hypot(1.0));
    let cos = 1.0 / tan.hypot(1.0);
    Some((cos, cos * tan))
}

/// The contact function of J. W. Perram and M. S. Wertheim (1985) for ellipsoids at distance 1 in the direction $u$,
/// $\max_\lambda \lambda (1 - \lambda) u^T ((1 - \lambda) A + \lambda B)^{-1} u$. It is the square of the distance over the one at
/// which they touch.
///
/// With $A = 1$, $B = \mathrm{diag}(\sigma_i^2)$ and $s = 1 / \lambda - 1$ it is
/// $\max_s \sum_i u_i^2 / ((1 + s) (1 + \sigma_i^2 / s))$, each term with its maximum at $\sigma_i$. The maximum of the sum is
/// between them, where the derivative vanishes: there is one, as the function of $\lambda$ is concave.
///
/// It ends early where the function exceeds `enough`.
fn contact(semi_axes: [f64; 3], direction: [f64; 3], enough: f64) -> f64 {
    let mut low = semi_axes.into_iter().fold(f64::INFINITY, f64::min);
    let mut high = semi_axes.into_iter().fold(0.0, f64::max);
    let mut largest = 0.0_f64;
    for _ in 0..HALVINGS {
        // The geometric mean, as the axes may be of any sizes.
        let s = low.sqrt() * high.sqrt();
        let (mut sum, mut slope) = (0.0, 0.0);
        for (sigma, u) in semi_axes.into_iter().zip(direction) {
            let ratio = sigma / s;
            let term = u / (1.0 + s) * (u / (1.0 + sigma * ratio));
            sum += term;
            slope += term * (ratio * ratio - 1.0) / (1.0 + sigma * ratio);
        }
        largest = largest.max(sum);
        if largest > enough {
            break;
        }
        if slope > 0.0 {
            low = s;
        } else {
            high = s;
        }
    }
    largest
}
