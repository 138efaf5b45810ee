//! What the joints of a scene leave free: kinds, angles at the start, springs and motions.

use lie::{SO3, Vec3};

use super::entry::{Table, Value};
use super::error::SceneError;
use super::keys::below;
use super::laws::{self, Gait};
use crate::error::ModelError;
use crate::joints::{Hinge, JointKind};
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

/// How a scene tells a kind of joint.
struct Kind {
    /// Its [type](crate::joints::WORDS).
    word: &'static str,
    /// The keys of a free one that not all kinds have, without those of [loads](JointLoad::PARTS).
    keys: &'static [&'static str],
    /// Whether a free one may have loads.
    is_loaded: bool,
    /// The keys of one that moves as told; none where it cannot.
    driven: Option<&'static [&'static str]>,
    read: fn(&Table, SO3, &Drive) -> Result<JointKind, SceneError>,
}

/// The kinds of joints, the default first.
const KINDS: &[Kind] = &[
    Kind {
        word: "ball",
        keys: &["stiffness"],
        is_loaded: true,
        driven: Some(&["rest"]),
        read: ball,
    },
    Kind {
        word: "hinge",
        keys: &["axis", "rest", "angle", "rate", "rest_angle", "stiffness"],
        is_loaded: true,
        driven: Some(&["axis", "rest"]),
        read: hinge,
    },
    Kind {
        word: "fixed",
        keys: &["rest"],
        is_loaded: false,
        driven: None,
        read: |_, rest, _| Ok(JointKind::fixed(rest)),
    },
];

/// What moves a joint as told: its own motion, or a gait.
struct Drive<'a> {
    motion: Option<Value<'a>>,
    gait: Option<&'a Gait<'a>>,
}

impl Drive<'_> {
    fn is_none(&self) -> bool {
        self.motion.is_none() && self.gait.is_none()
    }
}

impl Kind {
    /// Its keys that not all joints have.
    fn keys(&self, is_driven: bool) -> Vec<&'static str> {
        if is_driven {
            return self.driven.unwrap_or_default().to_vec();
        }
        let loads = JointLoad::PARTS.iter().filter(|_| self.is_loaded);
        let loads = loads.map(|part| part.key);
        self.keys.iter().copied().chain(loads).collect()
    }

    /// Refuses the keys that only other joints have.
    fn refuse_others(&self, table: &Table, is_driven: bool) -> Result<(), SceneError> {
        let own = self.keys(is_driven);
        let of_some = |key: &&str| KINDS.iter().any(|kind| kind.keys(false).contains(key));
        let mut others = below("joint").filter(|key| of_some(key) && !own.contains(key));
        let Some(other) = others.find_map(|key| table.get(key)) else {
            return Ok(());
        };
        let word = self.word;
        let joint = match (self.driven, is_driven) {
            (None, _) => format!("a {word} joint"),
            (_, true) => format!("a {word} joint that moves as told"),
            (_, false) => format!("a free {word} joint"),
        };
        let keys = own.join(", ");
        Err(other.fail(&format!("{joint} does not have it; it may have {keys}")))
    }

    /// Why it does not move as told.
    fn does_not_move(&self) -> String {
        let moving = KINDS.iter().filter(|kind| kind.driven.is_some());
        let moving: Vec<_> = moving.map(|kind| format!("{:?}", kind.word)).collect();
        let (word, moving) = (self.word, moving.join(" or "));
        format!("a {word} joint does not move; expected type {moving} with a motion")
    }
}

/// Reads the joint in `table`, which may have the motion of a gait.
pub(super) fn read(table: &Table, gait: Option<&Gait>) -> Result<Mobility, SceneError> {
    let motion = table.get("motion");
    if let (Some(motion), Some(gait)) = (&motion, gait) {
        let line = gait.line;
        let what = format!("given together with the gait in line {line}; expected one of them");
        return Err(motion.fail(&what));
    }
    let drive = Drive { motion, gait };
    let (kind, is_driven) = (kind(table, &drive)?, !drive.is_none());
    kind.refuse_others(table, is_driven)?;
    let rest = SO3::from_quaternion(table.read("rest", [1.0, 0.0, 0.0, 0.0], Value::attitude)?);
    let kind = (kind.read)(table, rest, &drive)?;
    Ok(Mobility {
        angle: table.read("angle", 0.0, Value::finite)?,
        rate: table.read("rate", 0.0, Value::finite)?,
        stiffness: table.read("stiffness", 0.0, Value::not_negative)?,
        load: JointLoad::read(table, &kind)?,
        kind,
    })
}

/// The kind of a joint that may be driven so.
fn kind(table: &Table, drive: &Drive) -> Result<&'static Kind, SceneError> {
    let given = table.get("type");
    let word = given.as_ref().map_or(Ok(KINDS[0].word), Value::text)?;
    let Some(kind) = KINDS.iter().find(|kind| kind.word == word) else {
        return Err(given.map_or_else(|| table.fail("type"), |value| value.unknown_word(word)));
    };
    if kind.driven.is_some() || drive.is_none() {
        return Ok(kind);
    }
    let (value, what) = (
        drive.motion.as_ref().or(given.as_ref()),
        kind.does_not_move(),
    );
    Err(value.map_or_else(|| table.fail(&what), |value| value.fail(&what)))
}

fn ball(table: &Table, rest: SO3, drive: &Drive) -> Result<JointKind, SceneError> {
    match drive.is_none() {
        true => Ok(JointKind::Ball),
        false => Ok(JointKind::Prescribed(Motion::Ball {
            rest,
            turn: laws::of_joint::<3>(table, drive.gait)?,
        })),
    }
}

fn hinge(table: &Table, rest: SO3, drive: &Drive) -> Result<JointKind, SceneError> {
    let value = table.require("axis")?;
    let axis: [f64; 3] = value.array()?;
    let largest = axis.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 {
        return Err(value.wrong("has length 0"));
    }
    // Brought to size one first: squares overflow and underflow.
    let mut hinge = Hinge::new(Vec3(axis.map(|x| x / largest)), rest);
    if drive.is_none() {
        hinge.rest_angle = table.read("rest_angle", 0.0, Value::finite)?;
        return Ok(JointKind::Hinge(hinge));
    }
    Ok(JointKind::Prescribed(Motion::Hinge {
        axis: hinge.axis,
        rest,
        angle: laws::of_joint::<1>(table, drive.gait)?,
    }))
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

#[cfg(test)]
mod tests {
    use super::KINDS;
    use crate::joints::WORDS;

    /// The words that are told are those that are read.
    #[test]
    fn every_kind_of_joint_has_its_word() {
        let told: Vec<&str> = WORDS[0].split('"').skip(1).step_by(2).collect();
        let read: Vec<&str> = KINDS.iter().map(|kind| kind.word).collect();
        assert_eq!(told, read);
    }
}
