//! Random robots, and what they are by hand.

use std::fmt::Write;

use lie::{Mat3, Vec3};
use proptest::prelude::*;

/// A link with the joint that carries it; the first has none that counts.
#[derive(Clone, Debug)]
pub struct Link {
    pub parent: usize,
    pub kind: &'static str,
    pub origin: Origin,
    pub axis: [f64; 3],
    pub damping: f64,
    pub mass: f64,
    pub centre: Origin,
    /// Of the uniform ellipsoid that has the inertia, m.
    pub semi_axes: [f64; 3],
}

#[derive(Clone, Copy, Debug)]
pub struct Origin {
    pub xyz: [f64; 3],
    pub rpy: [f64; 3],
}

/// A frame in the world.
#[derive(Clone, Copy)]
pub struct Frame {
    pub turn: Mat3,
    pub at: Vec3,
}

impl Origin {
    pub fn frame(&self) -> Frame {
        let [r, p, y] = self.rpy;
        let (sr, cr, sp, cp, sy, cy) = (r.sin(), r.cos(), p.sin(), p.cos(), y.sin(), y.cos());
        let turn = Mat3([
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]);
        let at = Vec3(self.xyz);
        Frame { turn, at }
    }

    pub fn xml(&self) -> String {
        let [[x, y, z], [r, p, w]] = [self.xyz, self.rpy];
        format!(r#"<origin xyz="{x:?} {y:?} {z:?}" rpy="{r:?} {p:?} {w:?}"/>"#)
    }
}

impl Frame {
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            turn: self.turn * inner.turn,
            at: self.at + self.turn * inner.at,
        }
    }
}

impl Link {
    fn moments(&self) -> [f64; 3] {
        let [a, b, c] = self.semi_axes.map(|x| x * x);
        [b + c, c + a, a + b].map(|sum| sum * self.mass / 5.0)
    }
}

pub fn origin() -> impl Strategy<Value = Origin> {
    let three = |most: f64| [-most..most, -most..most, -most..most];
    // Those of most joints are along the axes.
    let turn = prop_oneof![
        three(3.0),
        Just([0.0; 3]),
        Just([std::f64::consts::FRAC_PI_2, 0.0, 0.0])
    ];
    (three(0.5), turn).prop_map(|(xyz, rpy)| Origin { xyz, rpy })
}

fn link() -> impl Strategy<Value = (prop::sample::Index, Link)> {
    let kind = prop::sample::select(vec!["revolute", "continuous", "spherical", "fixed"]);
    let axis = [-1.0..1.0, -1.0..1.0, 0.1..1.0];
    let size = [0.05..0.5, 0.05..0.5, 0.05..0.5];
    let inertia = (prop::bool::ANY, 0.1..5.0, origin(), size);
    let joint = (kind, origin(), axis, prop_oneof![Just(0.0), 0.0..1.0]);
    (any::<prop::sample::Index>(), joint, inertia).prop_map(
        |(above, (kind, origin, axis, damping), (has_mass, mass, centre, semi_axes))| {
            // What moves has a mass.
            let mass = if has_mass || kind != "fixed" {
                mass
            } else {
                0.0
            };
            let parent = 0;
            let link = Link {
                parent,
                kind,
                origin,
                axis,
                damping,
                mass,
                centre,
                semi_axes,
            };
            (above, link)
        },
    )
}

/// Robots with a free base that has a mass.
pub fn robot() -> impl Strategy<Value = Vec<Link>> {
    prop::collection::vec(link(), 1..9).prop_map(|links| {
        let links = links.into_iter().enumerate();
        let mut links: Vec<Link> = links
            .map(|(i, (above, link))| Link {
                parent: above.index(i.max(1)),
                ..link
            })
            .collect();
        links[0].mass = links[0].mass.max(0.1);
        links
    })
}

/// The URDF, its links named `l0`, `l1`, ... and the joint above `l1` named `j1`; `more` goes in as it is.
pub fn xml(links: &[Link], more: &str) -> String {
    let mut text = format!("<robot name=\"random\">{more}\n");
    for (i, link) in links.iter().enumerate() {
        let ([x, y, z], mass) = (link.moments(), link.mass);
        let inertia =
            format!(r#"<inertia ixx="{x:?}" iyy="{y:?}" izz="{z:?}" ixy="0" ixz="0" iyz="0"/>"#);
        let inertial = format!(
            r#"<inertial>{}<mass value="{mass:?}"/>{inertia}</inertial>"#,
            link.centre.xml()
        );
        writeln!(text, r#"<link name="l{i}">{inertial}</link>"#).unwrap();
    }
    for (i, link) in links.iter().enumerate().skip(1) {
        let Link {
            parent,
            kind,
            axis: [x, y, z],
            damping,
            ..
        } = link;
        let joint = format!(
            r#"<parent link="l{parent}"/><child link="l{i}"/><axis xyz="{x:?} {y:?} {z:?}"/>"#
        );
        let dynamics = format!(
            r#"<dynamics damping="{damping:?}"/><limit effort="1" velocity="1" lower="-1" upper="1"/>"#
        );
        let origin = link.origin.xml();
        writeln!(
            text,
            r#"<joint name="j{i}" type="{kind}">{origin}{joint}{dynamics}</joint>"#
        )
        .unwrap();
    }
    text + "</robot>"
}

/// The frames of the links in the zero pose; the first stands in `base`.
pub fn frames(links: &[Link], base: Frame) -> Vec<Frame> {
    let mut frames: Vec<Frame> = vec![base];
    for link in &links[1..] {
        frames.push(frames[link.parent].then(&link.origin.frame()));
    }
    frames
}

/// Mass, mass centre and inertia about it, in the world.
pub fn totals(links: &[Link], frames: &[Frame]) -> (f64, Vec3, Mat3) {
    let placed = links.iter().zip(frames).map(|(link, frame)| {
        let frame = frame.then(&link.centre.frame());
        let inertia = frame.turn * Mat3::diagonal(link.moments()) * frame.turn.transpose();
        (link.mass, frame.at, inertia)
    });
    sum(&placed.collect::<Vec<_>>())
}

/// By the second moments about the origin, so that no mass centre is needed on the way.
pub fn sum(parts: &[(f64, Vec3, Mat3)]) -> (f64, Vec3, Mat3) {
    let steiner = |m: f64, r: Vec3| (r.hat() * r.hat()) * -m;
    let (mut mass, mut moment, mut about) = (0.0, Vec3::zero(), Mat3::zero());
    for (m, at, inertia) in parts {
        mass += m;
        moment += *at * *m;
        about += *inertia + steiner(*m, *at);
    }
    let centre = moment * (1.0 / mass);
    (mass, centre, about - steiner(mass, centre))
}
