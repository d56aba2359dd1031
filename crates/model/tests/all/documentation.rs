//! Every example of the page on the model file is a model, as it stands or laid over the first one.

use std::collections::BTreeMap;

use chetaev_model::load;

const PAGE: &str = include_str!("../../../../docs/model-file.md");

fn examples() -> Vec<&'static str> {
    PAGE.split("```toml\n")
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .collect()
}

#[test]
fn every_example_is_a_model() {
    let examples = examples();
    assert!(examples.len() > 15);
    let base = examples[0].to_owned();
    let files = BTreeMap::from([("base.toml".to_owned(), base)]);
    for example in examples {
        // A fragment belongs to the first example; what has coordinates of its own stands alone.
        let alone = example.contains("coordinates = [\"x\"")
            && (example.contains("lagrangian =") || example.contains("[lagrangian]"));
        let alone = alone
            || ["include", "[lagrangian]", "[particles", "[bodies]"]
                .iter()
                .any(|part| example.contains(part));
        let text = if alone {
            example.to_owned()
        } else {
            format!("include = \"base.toml\"\n{example}")
        };
        let loaded = load("page.toml", &text, &files, &[]);
        assert!(loaded.model.is_some(), "{example}\n{}", loaded.diagnostics);
        // The first example states no units, so a fragment that states some gives warnings.
        let other = loaded
            .diagnostics
            .list
            .iter()
            .filter(|d| d.code != "missing-unit")
            .count();
        assert_eq!(other, 0, "{example}\n{}", loaded.diagnostics);
    }
}

#[test]
fn the_number_of_links_can_be_set() {
    let trailer = examples()
        .into_iter()
        .find(|example| example.contains("\"trailer\""))
        .unwrap_or("");
    let set = [("n".to_owned(), "5".to_owned())];
    let loaded = load("trailer.toml", trailer, &BTreeMap::new(), &set);
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
    assert_eq!((model.n(), model.constraints.len()), (8, 6));
    assert_eq!(model.drawing.map(|drawing| drawing.elements.len()), Some(5));
}
