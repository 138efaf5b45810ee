//! Trees, and what is none.

use articulated_fluid::ModelError;

use crate::{assert_refused, parse, refusal};

#[test]
fn joints_that_do_not_fit_are_refused() {
    assert_refused(&[
        (
            "child = \"tail-1\"",
            "child = \"tail-3\"",
            "f.toml:27:1: joint.child: no body is named \"tail-3\"; \
             expected one of head, tail-1, tail_2",
        ),
        (
            "parent = \"head\"\nchild = \"tail-1\"",
            "parent = \"nose\"\nchild = \"tail-1\"",
            "f.toml:26:1: joint.parent: no body is named \"nose\"; \
             expected one of head, tail-1, tail_2",
        ),
        (
            "parent = \"head\"\nchild = \"tail-1\"",
            "parent = \"tail-1\"\nchild = \"tail-1\"",
            "f.toml:27:1: joint.child: \"tail-1\" hangs on itself; \
             expected another body than the parent",
        ),
        (
            "child = \"tail-1\"",
            "child = \"tail_2\"",
            "f.toml:27:1: joint.child: the child of the joint in line 22 already; \
             expected one joint for each body but the first",
        ),
        (
            "[[joint]]\nparent = \"head\"\nchild = \"tail-1\"\nat_parent = [1, 0, 0]\n\
             at_child = [-2, 0, 0.5]\n",
            "",
            "f.toml:14:1: body.name: \"tail-1\" is the child of no joint; \
             expected a [[joint]] with child = \"tail-1\"",
        ),
    ]);
}

/// Balls of these names, listed as here, and joints from the first to the second body of each pair.
fn tree(names: &str, joints: &str) -> String {
    let bodies = names
        .chars()
        .map(|name| format!("[[body]]\nname = '{name}'\nsemi_axes = [1, 1, 1]\n"));
    let joints = joints.split_whitespace().map(|pair| {
        let (parent, child) = pair.split_at(1);
        format!(
            "[[joint]]\nparent = '{parent}'\nchild = '{child}'\n\
             at_parent = [1, 0, 0]\nat_child = [-1, 0, 0]\n"
        )
    });
    let (bodies, joints): (String, String) = (bodies.collect(), joints.collect());
    format!("fluid.density = 1\n{bodies}{joints}")
}

#[test]
fn any_body_hangs_on_any_listed_before() {
    for (names, joints) in [("abcd", "ab bc cd"), ("abcd", "cd ab ac"), ("a", "")] {
        let scene = parse(&tree(names, joints));
        assert_eq!(scene.joints.len() + 1, names.len());
        assert!(scene.joints.iter().all(|joint| joint.parent < joint.child));
    }
}

/// Stiffnesses go with the joints, in whatever order these are listed.
#[test]
fn a_model_has_the_stiffness_of_each_joint() {
    let mut scene = parse(&tree("abcd", "cd ab ac"));
    let free = scene.model().expect("a model");
    for (joint, stiffness) in scene.joints.iter_mut().zip([3.0, 1.0, 2.0]) {
        joint.mobility.stiffness = stiffness;
    }
    // Of b, c and d.
    let elastic = free.clone().with_stiffness(&[1.0, 2.0, 3.0]);
    assert_eq!(scene.model(), elastic);
    scene
        .joints
        .iter_mut()
        .for_each(|joint| joint.mobility.stiffness = 0.0);
    assert_eq!(scene.model(), Ok(free));
    scene.joints[0].mobility.stiffness = f64::NAN;
    let refused = scene.model().expect_err("no spring");
    assert!(matches!(refused, ModelError::Stiffness { body: 3, .. }));
}

#[test]
fn joints_that_make_no_tree_are_refused() {
    for (names, joints, expected) in [
        (
            "abc",
            "ac cb",
            "17:1: joint.parent: \"b\" hangs on \"c\", which is listed after it; list \"c\" first",
        ),
        (
            "abc",
            "cb bc",
            "12:1: joint.parent: \"c\", \"b\" hang on each other in a cycle; \
             hang one of them on \"a\" or on a body that hangs on it",
        ),
        (
            "abcde",
            "ae bc cd db",
            "33:1: joint.parent: \"d\", \"c\", \"b\" hang on each other in a cycle; \
             hang one of them on \"a\" or on a body that hangs on it",
        ),
        // The first joint out of order leads to a cycle of which it is no part.
        (
            "abcd",
            "db cd dc",
            "15:1: joint.parent: \"b\" hangs on \"d\", which is listed after it; list \"d\" first",
        ),
        (
            "abc",
            "ab cb",
            "18:1: joint.child: the child of the joint in line 13 already; \
             expected one joint for each body but the first",
        ),
        (
            "abc",
            "ab",
            "9:1: body.name: \"c\" is the child of no joint; expected a [[joint]] with child = \"c\"",
        ),
        (
            "abc",
            "ab ca",
            "18:1: joint.child: \"a\" is the first body, on which the others hang; \
             expected the name of a body other than the first",
        ),
    ] {
        let message = refusal(&tree(names, joints)).to_string();
        assert_eq!(message, format!("f.toml:{expected}"), "{names}: {joints}");
    }
}

#[test]
fn a_thousand_names_do_not_make_a_long_message() {
    let bodies = (0..1000).map(|i| format!("[[body]]\nname = 'b{i}'\nsemi_axes = [1, 1, 1]\n"));
    let text = format!("fluid.density = 1\n{}", bodies.collect::<String>());
    let message = refusal(&format!("{text}[[joint]]\nparent = 'a'\nchild = 'b1'")).to_string();
    assert!(message.len() < 300, "{message}");
}
