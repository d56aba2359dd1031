//! What the variational principles say of a system.
