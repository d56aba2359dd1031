//! A participant of the benchmark: answers on standard output what it is asked on standard input.

use std::process::ExitCode;

fn main() -> ExitCode {
    let input = std::io::stdin().lock();
    match chetaev_bench::serve(input, std::io::stdout().lock()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(_) => ExitCode::FAILURE,
    }
}
