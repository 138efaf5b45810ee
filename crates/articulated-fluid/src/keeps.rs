//! What acts on a scene beside inertia, and what its motion keeps: as a user reads it.

use lie::Vec3;

use crate::scene::Scene;
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
        let bodies = |acts: fn(&crate::scene::SceneBody) -> bool| {
            let named = self.bodies.iter().filter(|body| acts(body));
            named.map(|body| &body.name[..]).collect::<Vec<_>>()
        };
        let joints = |acts: fn(&crate::scene::Mobility) -> bool| {
            let named = self.on_joints().filter(|(.., on)| acts(on));
            named.map(|(_, name, _)| name).collect::<Vec<_>>()
        };
        let weight = model.gravity().map(|_| "weight".to_owned());
        let loads = [
            ("spring in", joints(|on| on.stiffness > 0.0)),
            ("drive in", joints(|on| on.kind.is_driven())),
            ("damper in", joints(|on| on.load.damping > 0.0)),
            ("torque in", joints(|on| on.load.torque.is_some())),
            ("servo in", joints(|on| on.load.servo.is_some())),
            (
                "drag on",
                bodies(|body| body.drag.is_some_and(|drag| drag.acts())),
            ),
            ("thrust on", bodies(|body| body.thrust.is_some())),
        ];
        let acting = loads.into_iter().filter(|(_, names)| !names.is_empty());
        let told = acting.map(|(what, names)| format!("{what} {}", few(&names)));
        weight.into_iter().chain(told).collect()
    }
}

/// The first of the names.
fn few(names: &[&str]) -> String {
    const FEW: usize = 4;
    match names.len() > FEW {
        true => format!("{} and {} more", names[..FEW].join(", "), names.len() - FEW),
        false => names.join(", "),
    }
}
