//! What is refused.

use chetaev_import::{import, ImportError};

#[test]
fn what_is_no_robot_is_refused_with_a_reason() {
    let nested = "<a>".repeat(300);
    for (text, word) in [
        ("", "root"),
        ("<robot", "root node"),
        ("<html/>", "`<html>` begins no description"),
        ("<robot name=\"r\"/>", "no body"),
        ("<mujoco/>", "no body"),
        (
            "<!DOCTYPE r [<!ENTITY a \"b\">]><robot name=\"&a;\"><link name=\"l\"/></robot>",
            "DTD",
        ),
        (nested.as_str(), "deep"),
        (
            "<robot><link name=\"l\"><inertial><mass value=\"heavy\"/></inertial></link></robot>",
            "`value` of <mass> must be a number, not \"heavy\"",
        ),
        (
            "<robot><link name=\"l\"><inertial><mass value=\"inf\"/></inertial></link></robot>",
            "must be a number",
        ),
        (
            "<robot><link name=\"l\"/><joint name=\"j\" type=\"fixed\"><parent link=\"l\"/><child link=\"k\"/></joint></robot>",
            "link `k`",
        ),
        ("<robot><link/></robot>", "<link> has no `name`"),
    ] {
        let problem = import(text).expect_err(text).to_string();
        assert!(problem.to_lowercase().contains(&word.to_lowercase()), "`{word}` is missing in: {problem}");
    }
    let large = " ".repeat((16 << 20) + 1);
    assert!(matches!(import(&large), Err(ImportError::TooLarge(_))));
}

/// A sign of order in a value opens no element.
#[test]
fn many_elements_beside_each_other_are_not_deep() {
    let links: String = (0..400)
        .map(|i| format!("<link name=\"a{i}\" about=\"1 > 0\"/>"))
        .collect();
    let found = import(&format!("<robot name=\"flat\">{links}</robot>"));
    assert!(found.is_ok(), "{found:?}");
}
