//! What the joints of a scene leave free: kinds, angles at the start, springs and motions.

use lie::{SO3, Vec3};

use super::entry::{Table, Value};
use super::error::SceneError;
use super::laws::{self, Gait};
use super::loads;
use crate::error::ModelError;
use crate::joints::JointKind;
use crate::loads::JointLoad;
use crate::motion::{Motion, Sinusoid};
use crate::tree::ArticulatedBody;

/// What a joint leaves free, where that starts, and the spring against it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mobility {
    /// What it leaves free.
    pub kind: JointKind,
    /// The angle of a hinge at the start, rad.
    pub angle: f64,
    /// Its rate at the start, rad/s.
    pub rate: f64,
    /// Stiffness $k \ge 0$; 0 for a free joint. Of a ball against turns from where both bodies' frames are aligned, N m; of a hinge N m/rad.
    pub stiffness: f64,
    /// What acts in it beside.
    pub load: JointLoad,
}

impl Mobility {
    /// Whether it is an angle.
    pub(crate) fn is_hinge(&self) -> bool {
        matches!(self.kind, JointKind::Hinge(_))
    }

    /// The model with what acts in its joints, of which these are all.
    pub(crate) fn load<'a>(
        all: impl Iterator<Item = &'a Self>,
        model: ArticulatedBody,
    ) -> Result<ArticulatedBody, ModelError> {
        let of = |mobility: &Self| (mobility.stiffness, mobility.load.clone());
        let (stiffnesses, loads): (Vec<f64>, Vec<JointLoad>) = all.map(of).unzip();
        let model = model.with_stiffness(&stiffnesses)?;
        model.with_joint_loads(&loads)
    }
}

/// Keys of a joint that only some kinds have.
const OF_KINDS: [&str; 9] = [
    "axis",
    "rest",
    "angle",
    "rate",
    "rest_angle",
    "stiffness",
    "damping",
    "torque",
    "servo",
];

/// Reads the joint in `table`, which may have the motion of a gait.
pub(super) fn read(table: &Table, gait: Option<&Gait>) -> Result<Mobility, SceneError> {
    let motion = table.get("motion");
    if let (Some(motion), Some(gait)) = (&motion, gait) {
        let line = gait.line;
        let what = format!("given together with the gait in line {line}; expected one of them");
        return Err(motion.fail(&what));
    }
    let driven = motion.is_some() || gait.is_some();
    let kind = table.get("type");
    let word = kind.as_ref().map_or(Ok("ball"), Value::text)?;
    let allowed: &[&str] = match (word, driven) {
        ("ball", false) => &["stiffness", "damping", "torque", "servo"],
        ("hinge", false) => &OF_KINDS,
        ("hinge", true) => &["axis", "rest"],
        ("ball", true) | ("fixed", false) => &["rest"],
        ("fixed", true) => {
            let value = motion.as_ref().or(kind.as_ref());
            let what =
                "a fixed joint does not move; expected type \"ball\" or \"hinge\" with a motion";
            return Err(value.map_or_else(|| table.fail(what), |value| value.fail(what)));
        }
        _ => return Err(kind.map_or_else(|| table.fail("type"), |kind| kind.unknown_word(word))),
    };
    refuse_others(table, (word, driven), allowed)?;
    let rest = SO3::from_quaternion(table.read("rest", [1.0, 0.0, 0.0, 0.0], Value::attitude)?);
    let kind = match word {
        "hinge" => hinge(table, rest, gait)?,
        "ball" if driven => JointKind::Prescribed(Motion::Ball {
            rest,
            turn: laws::of_joint::<3>(table, gait)?,
        }),
        "fixed" => JointKind::fixed(rest),
        _ => JointKind::Ball,
    };
    Ok(Mobility {
        angle: table.read("angle", 0.0, Value::finite)?,
        rate: table.read("rate", 0.0, Value::finite)?,
        stiffness: table.read("stiffness", 0.0, Value::not_negative)?,
        load: loads::in_joint(table, &kind)?,
        kind,
    })
}

fn hinge(table: &Table, rest: SO3, gait: Option<&Gait>) -> Result<JointKind, SceneError> {
    let value = table.require("axis")?;
    let axis: [f64; 3] = value.array()?;
    let largest = axis.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 {
        return Err(value.wrong("has length 0"));
    }
    // Brought to size one first: squares overflow and underflow.
    let kind = JointKind::hinge(Vec3(axis.map(|x| x / largest)), rest);
    let JointKind::Hinge(mut hinge) = kind else {
        return Ok(kind);
    };
    if table.get("motion").is_none() && gait.is_none() {
        hinge.rest_angle = table.read("rest_angle", 0.0, Value::finite)?;
        return Ok(JointKind::Hinge(hinge));
    }
    Ok(JointKind::Prescribed(Motion::Hinge {
        axis: hinge.axis,
        rest,
        angle: laws::of_joint::<1>(table, gait)?,
    }))
}

/// Refuses the keys that a joint of this kind does not have.
fn refuse_others(
    table: &Table,
    (word, driven): (&str, bool),
    allowed: &[&str],
) -> Result<(), SceneError> {
    let mut others = OF_KINDS.iter().filter(|key| !allowed.contains(key));
    let Some(other) = others.find_map(|key| table.get(key)) else {
        return Ok(());
    };
    let article = match (word, driven) {
        ("fixed", _) => "a fixed joint".to_owned(),
        (word, true) => format!("a {word} joint that moves as told"),
        (word, false) => format!("a free {word} joint"),
    };
    let keys = match allowed {
        [] => "none of these keys".to_owned(),
        keys => keys.join(", "),
    };
    Err(other.fail(&format!("{article} does not have it; it may have {keys}")))
}

/// The place of a joint to the world.
pub(super) fn place(table: &Table) -> Result<Sinusoid<3>, SceneError> {
    let at: [f64; 3] = table.require("at_parent")?.array()?;
    let Some(value) = table.get("place") else {
        return Ok(Sinusoid::constant(at));
    };
    let mut law = laws::sinusoid::<3>(&value.table()?)?;
    law.bias = [0, 1, 2].map(|i| law.bias[i] + at[i]);
    Ok(law)
}
