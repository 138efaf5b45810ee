//! The joints of a scene: a tree with the first body as its root.

use toml::Spanned;

use super::bodies::Names;
use super::description::SceneJoint;
use super::error::SceneError;
use super::raw::{Node, RawJoint};
use super::source::{Source, quote};
use super::values::{array, not_negative_or_zero};

/// The joints between the bodies of these `names`.
pub(super) fn check(
    raw: &[Node<RawJoint>],
    names: &Names,
    source: &Source,
) -> Result<Vec<SceneJoint>, SceneError> {
    let joint = |node| joint(node, names, source);
    let joints = raw.iter().map(joint).collect::<Result<Vec<_>, _>>()?;
    let parents = parents(raw, &joints, names, source)?;
    for (node, joint) in raw.iter().zip(&joints) {
        if joint.parent > joint.child {
            return Err(out_of_order(node, joint, &parents, names, source));
        }
    }
    every_other_body_hangs(&parents, names, source)?;
    Ok(joints)
}

fn joint(node: &Node<RawJoint>, names: &Names, source: &Source) -> Result<SceneJoint, SceneError> {
    let raw = &node.get_ref().0;
    let parent_name = source.require(node, "parent", &raw.parent)?;
    let child_name = source.require(node, "child", &raw.child)?;
    let parent = index(parent_name, names, source)?;
    let child = index(child_name, names, source)?;
    let (span, text) = (child_name.span(), child_name.get_ref());
    if parent == child {
        let message = format!("{text:?} hangs on itself; expected another body than the parent");
        return Err(source.fail(span, &message));
    }
    if child == 0 {
        let what = format!("{text:?} is the first body, on which the others hang");
        return Err(source.wrong(span, &what));
    }
    Ok(SceneJoint {
        parent,
        child,
        at_parent: array(source.require(node, "at_parent", &raw.at_parent)?, source)?,
        at_child: array(source.require(node, "at_child", &raw.at_child)?, source)?,
        stiffness: not_negative_or_zero(raw.stiffness.as_ref(), source)?,
    })
}

fn index(name: &Spanned<String>, names: &Names, source: &Source) -> Result<usize, SceneError> {
    let found = names.index.get(name.get_ref().as_str());
    found.copied().ok_or_else(|| {
        let known: Vec<&str> = names.listed.iter().map(|n| n.get_ref().as_str()).collect();
        let known = quote(&known.join(", "));
        let message = format!(
            "no body is named {:?}; expected one of {known}",
            name.get_ref()
        );
        source.fail(name.span(), &message)
    })
}

/// The parent of each body that is the child of a joint, and of no other.
fn parents(
    raw: &[Node<RawJoint>],
    joints: &[SceneJoint],
    names: &Names,
    source: &Source,
) -> Result<Vec<Option<usize>>, SceneError> {
    let mut above: Vec<Option<usize>> = vec![None; names.listed.len()];
    for (index, joint) in joints.iter().enumerate() {
        if let Some(earlier) = above[joint.child].replace(index) {
            let line = source.line(child_span(&raw[earlier]));
            let what = format!("the child of the joint in line {line} already");
            let message = format!("{what}; expected one joint for each body but the first");
            return Err(source.fail(child_span(&raw[index]), &message));
        }
    }
    let parent = |index: usize| joints[index].parent;
    Ok(above.into_iter().map(|index| index.map(parent)).collect())
}

fn child_span(node: &Node<RawJoint>) -> std::ops::Range<usize> {
    let child = node.get_ref().0.child.as_ref();
    child.map_or_else(|| node.span(), Spanned::span)
}

/// The error that a child is listed before its parent, which no order mends in a cycle.
fn out_of_order(
    node: &Node<RawJoint>,
    joint: &SceneJoint,
    parents: &[Option<usize>],
    names: &Names,
    source: &Source,
) -> SceneError {
    let upwards = std::iter::successors(Some(joint.parent), |body| parents[*body]);
    let chain: Vec<usize> = upwards.take(parents.len()).collect();
    let message = match chain.iter().position(|body| *body == joint.child) {
        Some(end) => cycle(&chain[..=end], names),
        None => {
            let [parent, child] =
                [joint.parent, joint.child].map(|body| names.listed[body].get_ref());
            format!(
                "{child:?} hangs on {parent:?}, which is listed after it; list {parent:?} first"
            )
        }
    };
    let parent = node.get_ref().0.parent.as_ref();
    source.fail(parent.map_or_else(|| node.span(), Spanned::span), &message)
}

fn cycle(bodies: &[usize], names: &Names) -> String {
    let name = |body: &usize| format!("{:?}", names.listed[*body].get_ref());
    let listed: Vec<String> = bodies.iter().map(name).collect();
    let (listed, root) = (quote(&listed.join(", ")), name(&0));
    format!(
        "{listed} hang on each other in a cycle; hang one of them on {root} or on a body that hangs on it"
    )
}

fn every_other_body_hangs(
    parents: &[Option<usize>],
    names: &Names,
    source: &Source,
) -> Result<(), SceneError> {
    let bodies = names.listed.iter().zip(parents).skip(1);
    match bodies.into_iter().find(|(_, parent)| parent.is_none()) {
        None => Ok(()),
        Some((name, _)) => {
            let text = name.get_ref();
            let message = format!(
                "{text:?} is the child of no joint; expected a [[joint]] with child = {text:?}"
            );
            Err(source.fail(name.span(), &message))
        }
    }
}
