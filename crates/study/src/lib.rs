//! A question asked of a model: run, compare, collect verdicts, render.
