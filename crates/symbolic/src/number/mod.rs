//! Numbers: exact rationals, prime fields, balls.
