//! The command line: a thin shell over the library, and the only crate that touches files, clock and terminal.

mod arguments;
mod commands;
mod files;
mod progress;
mod terminal;

use arguments::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

/// Everything as asked.
const DONE: u8 = 0;
/// An expectation of the model is not met, or a verification disagrees.
const UNMET: u8 = 1;
/// The input is wrong.
const INPUT: u8 = 2;
/// The run stopped early or was interrupted.
const STOPPED: u8 = 3;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if let Err(problem) = chetaev::compile::wish() {
        commands::error(problem);
        return ExitCode::from(INPUT);
    }
    let status = match arguments.command {
        Command::Study(a) => commands::study::run(&a),
        Command::Derive(a) => commands::as_a_whole(|| commands::derive::run(&a)),
        Command::Principles(a) => commands::principles::run(&a),
        Command::Simulate(a) => commands::simulate::run(&a),
        Command::Plot(a) => commands::plot::run(&a),
        Command::Film(a) => commands::plot::film(&a),
        Command::Steady(a) => commands::stability::find(&a),
        Command::Linearize(a) => commands::stability::linearize(&a),
        Command::Stability(a) => commands::stability::run(&a),
        Command::Follow(a) => commands::as_a_whole(|| commands::follow::run(&a)),
        Command::Sweep(a) => commands::sweep::run(&a),
        Command::Check(a) => commands::as_a_whole(|| commands::check::run(&a)),
        Command::Explain(a) => commands::explain::run(&a),
        Command::Verify(a) => commands::verify::run(&a),
        Command::New(a) => commands::new::run(&a),
        Command::Import(a) => commands::import::run(&a),
        Command::Gallery(a) => commands::gallery::run(&a),
        Command::Completions(a) => commands::completions::run(&a),
    };
    match terminal::failure() {
        None => ExitCode::from(status),
        Some(why) => {
            terminal::err(&format!(
                "error: standard output could not be written whole: {why}"
            ));
            ExitCode::from(status.max(INPUT))
        }
    }
}
