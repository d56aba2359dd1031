//! The workbench for analytical mechanics with nonholonomic constraints.
