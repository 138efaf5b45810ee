//! The joints of a scene: a star with the first body in the middle.

use toml::Spanned;

use super::SceneJoint;
use super::error::SceneError;
use super::raw::{Node, RawJoint};
use super::source::Source;
use super::values::array;

/// The joints between the bodies of these `names`.
pub(super) fn check(
    raw: &[Node<RawJoint>],
    names: &[&Spanned<String>],
    source: &Source,
) -> Result<Vec<SceneJoint>, SceneError> {
    let mut lines: Vec<Option<usize>> = vec![None; names.len()];
    let mut joints = Vec::with_capacity(raw.len());
    for node in raw {
        let joint = joint(node, names, source)?;
        claim(node, &mut lines[joint.child], source)?;
        joints.push(joint);
    }
    every_tail_hangs(names, &lines, source)?;
    Ok(joints)
}

fn joint(
    node: &Node<RawJoint>,
    names: &[&Spanned<String>],
    source: &Source,
) -> Result<SceneJoint, SceneError> {
    let raw = &node.get_ref().0;
    let parent_name = source.require(node, "parent", &raw.parent)?;
    let child_name = source.require(node, "child", &raw.child)?;
    let parent = index(parent_name, names, source)?;
    let child = index(child_name, names, source)?;
    if parent != 0 {
        let what = "a tail on a tail, i.e. a tree, is not supported by this version";
        return Err(source.fail(
            parent_name.span(),
            &format!("{what}; expected the first body, {:?}", names[0].get_ref()),
        ));
    }
    if child == 0 {
        let what = format!(
            "{:?} is the first body, on which the others hang",
            child_name.get_ref()
        );
        return Err(source.wrong(child_name.span(), &what));
    }
    Ok(SceneJoint {
        parent,
        child,
        at_parent: array(source.require(node, "at_parent", &raw.at_parent)?, source)?,
        at_child: array(source.require(node, "at_child", &raw.at_child)?, source)?,
    })
}

fn index(
    name: &Spanned<String>,
    names: &[&Spanned<String>],
    source: &Source,
) -> Result<usize, SceneError> {
    names
        .iter()
        .position(|known| known.get_ref() == name.get_ref())
        .ok_or_else(|| {
            let known: Vec<&str> = names.iter().map(|n| n.get_ref().as_str()).collect();
            let what = format!("no body is named {:?}", name.get_ref());
            let message = format!("{what}; expected one of {}", known.join(", "));
            source.fail(name.span(), &message)
        })
}

/// Notes the joint of a child that has none yet.
fn claim(
    node: &Node<RawJoint>,
    line: &mut Option<usize>,
    source: &Source,
) -> Result<(), SceneError> {
    let child = node.get_ref().0.child.as_ref();
    let span = child.map_or_else(|| node.span(), Spanned::span);
    match line.replace(source.line(span.clone())) {
        None => Ok(()),
        Some(earlier) => {
            let what = format!("the child of the joint in line {earlier} already");
            Err(source.fail(
                span,
                &format!("{what}; expected one joint for each body but the first"),
            ))
        }
    }
}

fn every_tail_hangs(
    names: &[&Spanned<String>],
    lines: &[Option<usize>],
    source: &Source,
) -> Result<(), SceneError> {
    for (name, line) in names.iter().zip(lines).skip(1) {
        if line.is_none() {
            let text = name.get_ref();
            let message = format!(
                "{text:?} is the child of no joint; expected a [[joint]] with child = {text:?}"
            );
            return Err(source.fail(name.span(), &message));
        }
    }
    Ok(())
}
