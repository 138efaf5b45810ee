//! Names that a scene does not have.

use urdf::{Base, Note, Options, import};

const INERTIAL: &str = r#"<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"#;

/// A chain of links with these names, as XML has them, on joints with those.
fn chain(links: &[&str], joints: &[&str]) -> String {
    let link = |name: &&str| format!(r#"<link name="{name}">{INERTIAL}</link>"#);
    let joint = |(name, pair): (&&str, &[&str])| {
        let [parent, child] = [pair[0], pair[1]];
        format!(
            r#"<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/></joint>"#
        )
    };
    let links_text: String = links.iter().map(link).collect();
    let joints_text: String = joints.iter().zip(links.windows(2)).map(joint).collect();
    format!(
        "<robot name=\"a &quot;robot&quot; \\ of&#10;two lines\">{links_text}{joints_text}</robot>"
    )
}

fn renamed(from: &str, to: &str) -> Note {
    let [from, to] = [from, to].map(str::to_owned);
    Note::Renamed { from, to }
}

#[test]
fn names_are_kept_where_a_scene_may_have_them() {
    let links = ["left/arm.1", "a b", "a_b", "caf\u{e9}", "&quot;q&quot;"];
    let joints = ["base", "j.1/x", "j", "j"];
    let options = Options {
        base: Some(Base::World),
        ..Options::default()
    };
    let imported = import(&chain(&links, &joints), &options).unwrap();
    let scene = &imported.scene;
    let names: Vec<&str> = scene.bodies.iter().map(|body| &body.name[..]).collect();
    assert_eq!(names, ["left/arm.1", "a_b", "a_b_", "caf_", "_q_"]);
    let names: Vec<&str> = scene.joints.iter().map(|joint| &joint.name[..]).collect();
    assert_eq!(names, ["base", "j.1/x", "j", "j_"]);
    let expected = [
        renamed("a b", "a_b"),
        renamed("a_b", "a_b_"),
        renamed("caf\u{e9}", "caf_"),
        renamed("\"q\"", "_q_"),
        renamed("j", "j_"),
    ];
    assert_eq!(imported.notes, expected);
    let title = scene.title.as_deref().unwrap();
    assert!(title.starts_with("a \"robot\" \\ of"), "{title}");
}

#[test]
fn a_link_that_is_named_world_and_has_a_mass_is_held() {
    let imported = import(&chain(&["world", "arm"], &["j"]), &Options::default()).unwrap();
    assert!(imported.scene.mount.is_some());
    assert_eq!(imported.scene.bodies[0].name, "world_");
    let free = Options {
        base: Some(Base::Free),
        ..Options::default()
    };
    let imported = import(&chain(&["world", "arm"], &["j"]), &free).unwrap();
    assert!(imported.scene.mount.is_none());
}
