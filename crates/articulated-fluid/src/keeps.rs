//! What acts on a scene beside inertia, and what its motion keeps: as a user reads it.

use lie::Vec3;

use crate::loads::JointLoad;
use crate::loads::on_bodies::BodyLoad;
use crate::scene::{Mobility, Scene};
use crate::tree::ArticulatedBody;

impl ArticulatedBody {
    /// What every motion keeps, in words.
    pub(crate) fn keeps(&self) -> Vec<&'static str> {
        let floats = self.net_weight() == Vec3::zero();
        let weight = self.loads.weight.as_ref();
        let is_balanced = weight.is_none_or(|weight| weight.is_balanced());
        let energy = match self.keeps_energy() {
            true => "energy",
            false => "energy less work",
        };
        let symplectic = (!self.has_forces()).then_some("symplectic form");
        let linear = match (self.keeps_momentum(), floats) {
            (false, _) => None,
            (true, true) => Some("linear momentum"),
            (true, false) => Some("linear momentum less the weight's impulse"),
        };
        let angular = match (self.keeps_momentum(), is_balanced) {
            (false, _) => None,
            (true, true) => Some("angular momentum"),
            (true, false) => Some("angular momentum about the vertical"),
        };
        let kept = [Some(energy), symplectic, linear, angular];
        kept.into_iter().flatten().collect()
    }
}

impl Scene {
    /// What acts, each with what it acts on.
    pub(crate) fn acts(&self, model: &ArticulatedBody) -> Vec<String> {
        let weight = model.gravity().map(|_| "weight".to_owned());
        let in_joints = |what: &str, acts: &dyn Fn(&Mobility) -> bool| {
            let named = self.on_joints().filter(|(.., on)| acts(on));
            told(&format!("{what} in"), named.map(|(_, name, _)| name))
        };
        let springs = in_joints("spring", &|on| on.stiffness > 0.0);
        let drives = in_joints("drive", &|on| on.kind.is_driven());
        let parts = JointLoad::PARTS.iter();
        let parts = parts.filter_map(|part| in_joints(part.name, &|on| (part.acts)(&on.load)));
        let on_bodies = BodyLoad::names().filter_map(|load| {
            let named = self.bodies.iter().filter(|body| body.has_load(load));
            told(&format!("{load} on"), named.map(|body| &body.name[..]))
        });
        let first = [weight, springs, drives].into_iter().flatten();
        first.chain(parts).chain(on_bodies).collect()
    }
}

/// What acts, and the first of the names of what it acts on; none where it acts on nothing.
fn told<'a>(what: &str, names: impl Iterator<Item = &'a str>) -> Option<String> {
    const FEW: usize = 4;
    let names: Vec<&str> = names.collect();
    let few = names[..names.len().min(FEW)].join(", ");
    match names.len() {
        0 => None,
        n if n > FEW => Some(format!("{what} {few} and {} more", n - FEW)),
        _ => Some(format!("{what} {few}")),
    }
}
