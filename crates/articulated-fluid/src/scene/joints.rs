//! The joints of a scene: a tree with the first body as its root.

use super::bodies::Names;
use super::description::SceneJoint;
use super::entry::{Table, Value};
use super::error::SceneError;
use super::source::quote;

/// A joint, and where it names its bodies.
struct Named<'a> {
    joint: SceneJoint,
    parent: Value<'a>,
    child: Value<'a>,
}

/// The joints between the bodies of these `names`.
pub(super) fn check(tables: &[Table], names: &Names) -> Result<Vec<SceneJoint>, SceneError> {
    let joints = tables.iter().map(|table| joint(table, names));
    let joints = joints.collect::<Result<Vec<_>, _>>()?;
    let parents = parents(&joints, names)?;
    if let Some(named) = joints
        .iter()
        .find(|named| named.joint.parent > named.joint.child)
    {
        return Err(out_of_order(named, &parents, names));
    }
    every_other_body_hangs(&parents, names)?;
    Ok(joints.into_iter().map(|named| named.joint).collect())
}

fn joint<'a>(table: &Table<'a>, names: &Names) -> Result<Named<'a>, SceneError> {
    let (parent_name, child_name) = (table.require("parent")?, table.require("child")?);
    let (parent, child) = (index(&parent_name, names)?, index(&child_name, names)?);
    let text = child_name.text()?;
    if parent == child {
        let message = format!("{text:?} hangs on itself; expected another body than the parent");
        return Err(child_name.fail(&message));
    }
    if child == 0 {
        let what = format!("{text:?} is the first body, on which the others hang");
        return Err(child_name.wrong(&what));
    }
    let joint = SceneJoint {
        parent,
        child,
        at_parent: table.require("at_parent")?.array()?,
        at_child: table.require("at_child")?.array()?,
        stiffness: table.read("stiffness", 0.0, Value::not_negative)?,
    };
    Ok(Named {
        joint,
        parent: parent_name,
        child: child_name,
    })
}

fn index(name: &Value, names: &Names) -> Result<usize, SceneError> {
    let text = name.text()?;
    names.index.get(text).copied().ok_or_else(|| {
        let known: Vec<&str> = names.listed.iter().map(|name| name.text).collect();
        let known = quote(&known.join(", "));
        name.fail(&format!(
            "no body is named {text:?}; expected one of {known}"
        ))
    })
}

/// The parent of each body that is the child of a joint, and of no other.
fn parents(joints: &[Named], names: &Names) -> Result<Vec<Option<usize>>, SceneError> {
    let mut above: Vec<Option<&Named>> = vec![None; names.listed.len()];
    for named in joints {
        if let Some(earlier) = above[named.joint.child].replace(named) {
            let line = earlier.child.line();
            let what = format!("the child of the joint in line {line} already");
            let message = format!("{what}; expected one joint for each body but the first");
            return Err(named.child.fail(&message));
        }
    }
    let parent = |named: Option<&Named>| named.map(|named| named.joint.parent);
    Ok(above.into_iter().map(parent).collect())
}

/// The error that a child is listed before its parent, which no order mends in a cycle.
fn out_of_order(named: &Named, parents: &[Option<usize>], names: &Names) -> SceneError {
    let joint = &named.joint;
    let upwards = std::iter::successors(Some(joint.parent), |body| parents[*body]);
    let chain: Vec<usize> = upwards.take(parents.len()).collect();
    let message = match chain.iter().position(|body| *body == joint.child) {
        Some(end) => cycle(&chain[..=end], names),
        None => {
            let [parent, child] = [joint.parent, joint.child].map(|body| names.listed[body].text);
            format!(
                "{child:?} hangs on {parent:?}, which is listed after it; list {parent:?} first"
            )
        }
    };
    named.parent.fail(&message)
}

fn cycle(bodies: &[usize], names: &Names) -> String {
    let name = |body: &usize| format!("{:?}", names.listed[*body].text);
    let listed: Vec<String> = bodies.iter().map(name).collect();
    let (listed, root) = (quote(&listed.join(", ")), name(&0));
    format!(
        "{listed} hang on each other in a cycle; hang one of them on {root} or on a body that hangs on it"
    )
}

fn every_other_body_hangs(parents: &[Option<usize>], names: &Names) -> Result<(), SceneError> {
    let mut bodies = names.listed.iter().zip(parents).skip(1);
    match bodies.find(|(_, parent)| parent.is_none()) {
        None => Ok(()),
        Some((name, _)) => {
            let text = name.text;
            let message = format!(
                "{text:?} is the child of no joint; expected a [[joint]] with child = {text:?}"
            );
            Err(name.value.fail(&message))
        }
    }
}
