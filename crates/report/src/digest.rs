//! SHA-256 in base64, for the content security policy of the page: only the style sheet and the
//! script that this crate wrote are in force, whatever else may have got into the page.

use base64::prelude::{Engine, BASE64_STANDARD};
use sha2::{Digest, Sha256};

/// `'sha256-…'`, the source expression that admits an inline script or style of this content
/// (Content Security Policy level 3, section 2.3.1).
pub(crate) fn source_expression(content: &str) -> String {
    format!(
        "'sha256-{}'",
        BASE64_STANDARD.encode(Sha256::digest(content))
    )
}

#[cfg(test)]
mod tests {
    use super::source_expression;

    /// The example of a script that is admitted by its digest in Content Security Policy level 2.
    #[test]
    fn published_source_expression() {
        assert_eq!(
            source_expression("alert('Hello, world.');"),
            "'sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng='"
        );
    }
}
