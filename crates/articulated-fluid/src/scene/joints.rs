//! The joints of a scene: a tree with the first body as its root.

use std::collections::HashMap;

use super::bodies::{Names, WORLD, is_name};
use super::description::{SceneJoint, SceneMount};
use super::entry::{Table, Value};
use super::error::SceneError;
use super::laws::{self, Gaits};
use super::mobility;
use super::source::quote;

/// A joint, and where it names its bodies.
struct Named<'a> {
    joint: SceneJoint,
    parent: Value<'a>,
    child: Value<'a>,
}

/// What is told of the joints apart from their tables.
struct Told<'a, 'b> {
    names: &'b Names<'a>,
    gaits: Gaits<'a>,
}

/// The joints between the bodies of these `names`, the one of the first body to the world apart.
pub(super) fn check<'a>(
    tables: &[Table<'a>],
    gaits: &[Table<'a>],
    names: &Names<'a>,
) -> Result<(Option<SceneMount>, Vec<SceneJoint>), SceneError> {
    let own: Vec<&str> = tables.iter().map(name).collect::<Result<_, _>>()?;
    unique(tables, &own)?;
    let gaits = laws::gaits(gaits, &own)?;
    let told = Told { names, gaits };
    let mounts = |table: &Table| table.get("parent").is_some_and(|p| p.word() == Some(WORLD));
    let mut mount = None;
    for table in tables.iter().filter(|table| mounts(table)) {
        if mount.is_some() {
            let what = "the first body is on the world already; expected one joint for each body";
            return Err(table.require("parent")?.fail(what));
        }
        mount = Some(on_world(table, &told)?);
    }
    let others = tables.iter().filter(|table| !mounts(table));
    let joints = others.map(|table| joint(table, &told));
    let joints = joints.collect::<Result<Vec<_>, _>>()?;
    let parents = parents(&joints, names)?;
    if let Some(named) = joints
        .iter()
        .find(|named| named.joint.parent > named.joint.child)
    {
        return Err(out_of_order(named, &parents, names));
    }
    every_other_body_hangs(&parents, names)?;
    Ok((mount, joints.into_iter().map(|named| named.joint).collect()))
}

/// A joint's own name, or its child's.
fn name<'a>(table: &Table<'a>) -> Result<&'a str, SceneError> {
    match table.get("name") {
        Some(name) => name.text(),
        None => table.require("child")?.text(),
    }
}

/// Refuses two joints of one name; those of one child are refused as such.
fn unique(tables: &[Table], names: &[&str]) -> Result<(), SceneError> {
    let mut seen: HashMap<&str, bool> = HashMap::new();
    for (table, name) in tables.iter().zip(names) {
        let own = table.get("name");
        if let Some(value) = &own
            && !is_name(name)
        {
            return Err(value.wrong(&format!("is {name:?}")));
        }
        let is_own = own.is_some();
        if let Some(other) = seen.insert(name, is_own)
            && (other || is_own)
        {
            let value = own.map_or_else(|| table.require("child"), Ok)?;
            let what = format!("{name:?} is the name of another joint; expected another name");
            return Err(value.fail(&what));
        }
    }
    Ok(())
}

/// The joint of the first body to the world.
fn on_world(table: &Table, told: &Told) -> Result<SceneMount, SceneError> {
    let child = table.require("child")?;
    if index(&child, told.names)? != 0 {
        let first = told.names.listed[0].text;
        let what = format!("only the first body may hang on the world; expected {first:?}");
        return Err(child.fail(&what));
    }
    let name = name(table)?;
    Ok(SceneMount {
        name: name.to_owned(),
        place: mobility::place(table)?,
        at_child: table.require("at_child")?.array()?,
        mobility: mobility::read(table, told.gaits.get(name))?,
    })
}

fn joint<'a>(table: &Table<'a>, told: &Told) -> Result<Named<'a>, SceneError> {
    let names = told.names;
    let (parent_name, child_name) = (table.require("parent")?, table.require("child")?);
    if child_name.word() == Some(WORLD) {
        let what = "the world hangs on nothing; expected it as the parent of the first body";
        return Err(child_name.fail(what));
    }
    if let Some(place) = table.get("place") {
        return Err(
            place.fail("only a joint to the world has a place; expected parent = \"world\"")
        );
    }
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
    let name = name(table)?;
    let joint = SceneJoint {
        name: name.to_owned(),
        parent,
        child,
        at_parent: table.require("at_parent")?.array()?,
        at_child: table.require("at_child")?.array()?,
        mobility: mobility::read(table, told.gaits.get(name))?,
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
