//! `chetaev completions`.

use crate::arguments::{Arguments as Root, Completions as Arguments};
use crate::{terminal, DONE};
use clap::CommandFactory;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let mut script = Vec::new();
    clap_complete::generate(
        arguments.shell,
        &mut Root::command(),
        "chetaev",
        &mut script,
    );
    terminal::out(&String::from_utf8_lossy(&script));
    DONE
}
