//! A constrained system, the registry of claims, and the equations of motion that follow.
