//! Where there is no machine code: no value of these types exists.

use super::build::Recurrences;
use super::{Taylor, ABREAST};
use crate::evaluate::EvaluateFailure;
use crate::schedule::Single;

#[derive(Clone, Debug)]
pub(super) enum Recurring {}

#[derive(Clone, Debug)]
pub(super) enum Running {}

#[derive(Clone, Debug)]
pub(super) enum FourRunning {}

#[allow(clippy::unused_self)]
impl Recurring {
    pub(super) fn running_four(&self, _: &Taylor) -> Option<FourRunning> {
        match *self {}
    }

    pub(super) fn prepare_four(
        &self,
        _: (&Taylor, usize),
        _: &[f64],
        _: &mut FourRunning,
    ) -> Result<(), EvaluateFailure> {
        match *self {}
    }

    pub(super) fn expand_four(
        &self,
        _: &Taylor,
        _: [Option<&[f64]>; ABREAST],
        _: usize,
        _: &mut FourRunning,
    ) -> Result<[Result<(), EvaluateFailure>; ABREAST], EvaluateFailure> {
        match *self {}
    }

    pub(super) fn coefficients_of(&self, _: usize, _: usize, _: &FourRunning, _: &mut [f64]) {
        match *self {}
    }

    pub(super) fn rates_four(
        &self,
        _: &Taylor,
        _: [Option<&[f64]>; ABREAST],
        _: &mut FourRunning,
    ) -> Result<[Result<(), EvaluateFailure>; ABREAST], EvaluateFailure> {
        match *self {}
    }

    pub(super) fn rates_of(&self, _: usize, _: &FourRunning, _: &mut [f64]) {
        match *self {}
    }

    pub(super) fn finite_four(&self, _: usize, _: &FourRunning) -> [bool; ABREAST] {
        match *self {}
    }

    pub(super) fn sum_four(&self, _: usize, _: [f64; ABREAST], _: &mut FourRunning) {
        match *self {}
    }

    pub(super) fn ends_of(&self, _: usize, _: &FourRunning, _: (&mut [f64], &mut [f64])) {
        match *self {}
    }

    pub(super) fn order_of(&self, _: usize, _: usize, _: &FourRunning, _: &mut [f64]) {
        match *self {}
    }

    pub(super) fn is_same(&self, _: &Recurring) -> bool {
        match *self {}
    }

    pub(super) fn of(_: &Single, _: &[u32]) -> Option<Recurring> {
        None
    }

    pub(super) fn most() -> usize {
        0
    }

    pub(super) fn bytes(&self) -> usize {
        match *self {}
    }

    pub(super) fn running(&self) -> Running {
        match *self {}
    }

    pub(super) fn prepare(
        &self,
        _: &[f64],
        _: &[f64],
        _: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        match *self {}
    }

    pub(super) fn start(
        &self,
        _: &Recurrences,
        _: &[f64],
        _: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        match *self {}
    }

    pub(super) fn first(&self, _: usize, _: &Running) -> f64 {
        match *self {}
    }

    pub(super) fn advance(
        &self,
        _: usize,
        _: &[f64],
        _: &mut Running,
    ) -> Result<(), EvaluateFailure> {
        match *self {}
    }

    pub(super) fn output(&self, _: usize, _: usize, _: &Running) -> f64 {
        match *self {}
    }

    pub(super) fn expand(
        &self,
        _: &[f64],
        _: usize,
        _: &mut Running,
        _: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        match *self {}
    }
}
