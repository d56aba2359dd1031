//! Writes a page with everything a page can hold: the Chaplygin sleigh from its closed form, and
//! a rolling disc to look at in space.
//!
//! `cargo run -p chetaev-report --example demo -- OUT.html [sleigh|disc|long|empty]`

mod disc;
mod long;
mod sleigh;

use chetaev_report::{render, Report};

fn main() -> std::io::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| "report.html".into());
    let report = match arguments.next().as_deref() {
        Some("disc") => disc::report(),
        Some("long") => long::report(),
        Some("empty") => Report {
            title: "Empty".into(),
            ..Report::default()
        },
        _ => sleigh::report(),
    };
    std::fs::write(path, render(&report))
}
