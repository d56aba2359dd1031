//! Every part of the catalogue of claims has a title in the report.

use chetaev_report::Language;
use chetaev_study::registry;

#[test]
fn every_part_of_the_catalogue_has_a_title() {
    let registry = registry();
    let parts = registry.claims().iter().map(|claim| claim.id());
    for id in parts {
        let part = id.split('.').next().unwrap_or(id);
        let title = Language::English.title_of_claims(part);
        assert!(title.is_some(), "{id}");
    }
}
