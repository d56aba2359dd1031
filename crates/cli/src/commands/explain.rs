//! `chetaev explain`.

use super::error;
use crate::arguments::Explain as Arguments;
use crate::{terminal, DONE, INPUT};
use chetaev::study::explanation;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let wanted = arguments.claim.as_deref();
    let found = if arguments.json {
        let data = explanation::data(wanted);
        data.map(|data| {
            format!(
                "{}\n",
                serde_json::to_string_pretty(&data).unwrap_or_default()
            )
        })
    } else {
        explanation::text(wanted)
    };
    match found {
        Ok(text) => {
            terminal::out(&text);
            DONE
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}
