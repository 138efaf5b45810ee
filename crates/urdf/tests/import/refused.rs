//! What a scene does not have.

use urdf::{Base, Options, import};

const INERTIAL: &str = r#"<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"#;

/// Two links, `one` and `two`, with `joint` on the way between them.
fn robot(joint: &str) -> String {
    format!(
        r#"<robot name="r"><link name="one">{INERTIAL}</link><link name="two">{INERTIAL}</link>
        {joint}</robot>"#
    )
}

fn joint(kind: &str, more: &str) -> String {
    robot(&format!(
        r#"<joint name="knee" type="{kind}"><parent link="one"/><child link="two"/>{more}</joint>"#
    ))
}

#[track_caller]
fn refused(text: &str, options: &Options, words: &[&str]) {
    let error = import(text, options).unwrap_err().to_string();
    for word in words {
        assert!(error.contains(word), "{word:?}: {error}");
    }
}

#[test]
fn joints_of_other_kinds_are_refused_by_name() {
    let refuses = |text: &str, words: &[&str]| refused(text, &Options::default(), words);
    refuses(
        &joint("prismatic", ""),
        &["\"knee\" is prismatic", "\"fixed\""],
    );
    refuses(
        &joint("planar", ""),
        &["\"knee\" is planar", "\"floating\""],
    );
    refuses(
        &joint("floating", ""),
        &["\"knee\" is floating", "without mass"],
    );
    let mimic = r#"<mimic joint="hip" multiplier="2"/>"#;
    refuses(
        &joint("revolute", mimic),
        &["\"knee\" mimics \"hip\"", "remove its <mimic>"],
    );
    refuses(
        &joint("revolute", r#"<axis xyz="0 0 0"/>"#),
        &["\"knee\"", "axis", "not all 0"],
    );
    refuses(
        &joint("revolute", r#"<dynamics damping="-1"/>"#),
        &["\"knee\"", "damping", "-1"],
    );
    refuses(
        &joint("fixed", r#"<origin xyz="0 nan 0"/>"#),
        &["\"knee\"", "origin", "finite"],
    );
}

#[test]
fn what_is_no_tree_is_refused_by_name() {
    let refuses = |text: &str, words: &[&str]| refused(text, &Options::default(), words);
    let edge = |name: &str, parent: &str, child: &str| {
        format!(
            r#"<joint name="{name}" type="fixed"><parent link="{parent}"/><child link="{child}"/></joint>"#
        )
    };
    refuses("<robot name=\"r\"/>", &["no link"]);
    refuses("no XML", &["as a URDF"]);
    refuses(&robot(""), &["\"one\"", "\"two\"", "hang on nothing"]);
    refuses(&robot(&edge("j", "one", "three")), &["\"j\"", "\"three\""]);
    let both = edge("j", "one", "two") + &edge("k", "one", "two");
    refuses(&robot(&both), &["\"two\"", "\"j\"", "\"k\"", "loop"]);
    let around = edge("j", "one", "two") + &edge("k", "two", "one");
    refuses(&robot(&around), &["\"one\" hangs on itself"]);
    refuses(
        &robot(&edge("j", "two", "two")),
        &["\"two\" hangs on itself"],
    );
    let twice =
        format!(r#"<robot name="r"><link name="one">{INERTIAL}</link><link name="one"/></robot>"#);
    refuses(&twice, &["two links are named \"one\""]);
}

#[test]
fn masses_that_no_body_has_are_refused_by_name() {
    let link =
        |inertial: &str| format!(r#"<robot name="r"><link name="one">{inertial}</link></robot>"#);
    let given = |mass: &str, moments: [&str; 3]| {
        let [x, y, z] = moments;
        link(&format!(
            r#"<inertial><mass value="{mass}"/><inertia ixx="{x}" iyy="{y}" izz="{z}" ixy="0" ixz="0" iyz="0"/></inertial>"#
        ))
    };
    let free = Options {
        base: Some(Base::Free),
        ..Options::default()
    };
    let refuses = |text: &str, words: &[&str]| refused(text, &free, words);
    refuses(&link(""), &["\"one\" moves", "<inertial>"]);
    refuses(&given("-1", ["1"; 3]), &["\"one\"", "-1"]);
    refuses(&given("inf", ["1"; 3]), &["\"one\"", "inf"]);
    refuses(&given("1", ["1", "1", "2.1"]), &["\"one\"", "2.1"]);
    refuses(&given("1", ["0", "0", "0"]), &["\"one\"", "moments"]);
    refuses(&given("1", ["nan", "1", "1"]), &["\"one\"", "finite"]);
    refuses(&given("1e-320", ["1"; 3]), &["\"one\"", "e-320"]);
    refused(&link(""), &Options::default(), &["no link that could move"]);
    let bad = Options {
        density: -1.0,
        ..Options::default()
    };
    refused(&given("1", ["1"; 3]), &bad, &["density is -1.0"]);
    // A chain with a link of nothing in it.
    let chain = joint("revolute", "").replacen(INERTIAL, "", 2);
    refused(&chain, &free, &["\"one\" moves"]);
    let massless = joint("revolute", "").replace(
        &format!(r#"<link name="two">{INERTIAL}"#),
        r#"<link name="two">"#,
    );
    refused(&massless, &Options::default(), &["\"two\" moves"]);
}

#[test]
fn a_base_that_is_both_is_refused() {
    let text = joint("floating", "").replacen(INERTIAL, "", 1);
    assert!(import(&text, &Options::default()).is_ok());
    let held = Options {
        base: Some(Base::World),
        ..Options::default()
    };
    refused(&text, &held, &["\"knee\" is floating"]);
}

#[test]
fn a_collision_shape_without_a_size_is_refused_in_a_fluid() {
    let shape = r#"<collision><geometry><box size="1 0 1"/></geometry></collision>"#;
    let text = joint("revolute", "").replacen("</link>", &format!("{shape}</link>"), 1);
    assert!(import(&text, &Options::default()).is_ok());
    let wet = Options {
        density: 1.0,
        ..Options::default()
    };
    refused(&text, &wet, &["\"one\"", "collision shape"]);
}
