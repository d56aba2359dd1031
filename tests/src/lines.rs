//! How many lines a person writes for a model of bodies, and how many it may be.

/// Lines have at most so many characters.
pub const LONGEST: usize = 110;

/// The models of `gallery/bodies` with the most lines that each may have.
pub const MOST: &[(&str, usize)] = &[
    ("falling-rolling-disc", 8),
    ("chaplygin-sleigh", 8),
    ("snakeboard", 14),
    ("roller-racer", 12),
    ("differential-drive", 14),
    ("trailer", 14),
    ("whipple-bicycle", 30),
    ("rattleback", 12),
    ("chaplygin-sphere", 8),
    ("tippe-top", 12),
    ("unicycle", 14),
    ("mecanum", 20),
    ("four-bar", 12),
    ("slider-crank", 12),
    ("chain", 10),
    ("gyroscope", 12),
    ("ball-in-bowl", 10),
    ("four-bar-hinges", 12),
    ("bricard", 20),
    ("spherical-robot", 20),
    ("stewart-platform", 30),
    ("double-wishbone", 30),
    ("wheel-set", 12),
];

/// The lines of a model that count: neither empty nor a comment, and not those of `[expect]`.
pub fn lines(text: &str) -> Vec<&str> {
    let mut is_expected = false;
    let mut counted = Vec::new();
    for line in text.lines().map(str::trim_end) {
        let code = line.trim_start();
        if code.starts_with('[') {
            is_expected = code.starts_with("[expect");
        }
        if !code.is_empty() && !code.starts_with('#') && !is_expected {
            counted.push(line);
        }
    }
    counted
}
