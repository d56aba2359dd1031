//! Taylor coefficients of a program along a motion: the recurrences of its instructions.
//!
//! The coefficients are normalized: `x(s) = Σ_j x_[j] s^j`, `x_[j] = x⁽ʲ⁾/j!`. Given the coefficients of the variables
//! up to order j, [`Taylor`] computes those of all values up to order j, one order per call, so that a caller who
//! knows x' as an output finds the series of a solution of x' = F(x) from `x_[j+1] = F_[j]/(j + 1)`.
//!
//! Orders above 0 follow from the recurrences of Moore 1966 and Griewank & Walther 2008, ch. 13 (see `recurrence`): a product or a function costs O(j), a sum or a product with what is constant O(1). A
//! linear system is factorized once, at order 0; every further order costs one solution of it, with the right-hand
//! side less the convolutions of those entries of the matrix that vary:
//!
//! ```text
//! A_[0] x_[j] = b_[j] − Σ_{i=1..j} A_[i] x_[j−i]
//! ```
//!
//! Where the processor allows, order 0 is native code and so are the recurrences (`machine`); elsewhere both are
//! interpreted, with series stored contiguously by order, those that are convolved also in reverse, so that each
//! convolution is a dot product of two contiguous slices. The back ends agree to rounding: on the motions of the gallery
//! within 64 units in the last place of the largest coefficient that a series of the radius found can have, for each order
//! (`tests/series.rs` of the workspace). Nothing is allocated after the workspace is made.

#[cfg(all(unix, target_arch = "x86_64"))]
mod abreast;
mod build;
mod double_double;
mod functions;
#[cfg(all(unix, target_arch = "x86_64"))]
mod machine;
#[cfg(not(all(unix, target_arch = "x86_64")))]
#[path = "no_machine.rs"]
mod machine;
mod recurrence;
mod side;
mod solve;
#[cfg(all(unix, target_arch = "x86_64"))]
mod writer;
#[cfg(all(unix, target_arch = "x86_64"))]
mod zero;

use crate::backend::VARIABLE;
use crate::decode::Code;
use crate::evaluate::EvaluateFailure;
use crate::interpret::{check_length, State};
use crate::program::{Layout, Program};
use crate::schedule;
use crate::verify::VerifyError;
use build::Recurrences;
pub use double_double::PreciseTaylor;
use machine::{FourRunning, Recurring, Running};
use recurrence::Order;

/// The Taylor recurrences of a program.
///
/// ```
/// use chetaev_compile::{Lowering, Taylor};
/// use chetaev_symbolic::Graph;
///
/// // x' = x², x(0) = 1/2: x_[j] = 2^(−j−1).
/// let g = Graph::new();
/// let x = g.intern_symbol("x", 0);
/// let rate = g.powi(g.symbol_expr(x), 2);
/// let taylor = Taylor::new(&Lowering::new(&g).variables(&[x]).output("rate", &[rate]).lower()?)?;
/// let mut workspace = taylor.workspace(10);
/// taylor.prepare(&[], &mut workspace)?;
/// taylor.start(&[0.5], &mut workspace)?;
/// for j in 1..=10 {
///     let coefficient = taylor.output(0, &workspace) / f64::from(j);
///     assert_eq!(coefficient, 0.5f64.powi(j + 1));
///     taylor.advance(&[coefficient], &mut workspace)?;
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Taylor {
    code: Code,
    recurrences: Recurrences,
    outputs: Vec<u32>,
    /// Machine code for orders above 0, where there is any.
    machine: Option<Recurring>,
}

/// How many motions go side by side.
pub const ABREAST: usize = 4;

/// Storage for the series of four motions side by side, each with its own parameters.
#[derive(Clone, Debug)]
pub struct Abreast {
    running: FourRunning,
}

/// Storage for series, one for each thread.
#[derive(Clone, Debug)]
pub struct TaylorWorkspace {
    /// Values of order 0, and the factorized matrices.
    state: State<f64>,
    /// By register: the coefficient of the order last computed.
    now: Vec<f64>,
    series: Series,
    /// The order last computed.
    order: usize,
    started: bool,
    solution: Vec<f64>,
    running: Option<Running>,
}

/// Series of those values that are convolved: `stride` numbers each.
#[derive(Clone, Debug)]
struct Series<S = f64> {
    values: Vec<S>,
    stride: usize,
}

impl<S> Series<S> {
    /// Coefficients `from..to` of a series stored forward.
    #[inline(always)]
    fn forward(&self, slot: u32, from: usize, to: usize) -> &[S] {
        let start = slot as usize * self.stride;
        &self.values[start + from..start + to]
    }

    /// Coefficients from `high` down to `low` of a series stored in reverse.
    #[inline(always)]
    fn reverse(&self, slot: u32, high: usize, low: usize) -> &[S] {
        let end = (slot as usize + 1) * self.stride;
        &self.values[end - 1 - high..end - low]
    }
}

impl Taylor {
    /// The recurrences of `program`.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed; one made by [`Lowering`](crate::Lowering) is.
    pub fn new(program: &Program) -> Result<Taylor, VerifyError> {
        let is_off = std::env::var_os(VARIABLE).is_some_and(|value| value == "interpreter");
        Taylor::choose(program, !is_off)
    }

    /// The recurrences of `program` by the interpreter, on every machine.
    ///
    /// # Errors
    /// As [`new`](Taylor::new).
    pub fn interpreter(program: &Program) -> Result<Taylor, VerifyError> {
        Taylor::choose(program, false)
    }

    fn choose(program: &Program, is_native_allowed: bool) -> Result<Taylor, VerifyError> {
        program.verify()?;
        let may_be_native = is_native_allowed && cfg!(all(unix, target_arch = "x86_64"));
        // Runs are for the interpreter.
        let single = match may_be_native {
            true => schedule::Single::of(program),
            false => schedule::Single::of(&schedule::in_runs(program)),
        };
        let (recurrences, registers) = Recurrences::of(&single);
        let outputs = single.groups.iter().flat_map(|group| &group.registers);
        let outputs: Vec<u32> = outputs.map(|register| register.0).collect();
        let machine = match may_be_native {
            true => Recurring::of(&single, &outputs),
            false => None,
        };
        if may_be_native && machine.is_none() {
            return Taylor::choose(program, false);
        }
        let schedule::Single {
            mut program,
            groups,
            ..
        } = single;
        // Every value has a register of its own, also those of the prologue.
        let mut layout = Layout {
            hoisted: 0,
            temporaries: 0,
            ..program.layout
        };
        layout.temporaries = registers - layout.len();
        program.layout = layout;
        let groups = groups.into_iter().map(|group| crate::program::OutputGroup {
            name: group.name,
            registers: group.registers,
            end: group.end,
        });
        program.outputs = groups.collect();
        Ok(Taylor {
            machine,
            outputs,
            code: Code::of(program),
            recurrences,
        })
    }

    /// Bytes of machine code; `None` where the recurrences are interpreted.
    pub fn code_size(&self) -> Option<usize> {
        self.machine.as_ref().map(Recurring::bytes)
    }

    /// Storage for series up to the given order.
    pub fn workspace(&self, order: usize) -> TaylorWorkspace {
        let stride = order + 1;
        let program = &self.code.program;
        let sizes = program.matrices.iter().map(|matrix| matrix.size);
        let machine = self.machine.as_ref().filter(|_| order <= Recurring::most());
        TaylorWorkspace {
            running: machine.map(Recurring::running),
            state: State::new(program),
            now: vec![0.0; program.layout.len()],
            series: Series {
                values: vec![0.0; self.recurrences.slots * stride],
                stride,
            },
            order: 0,
            started: false,
            solution: vec![0.0; 2 * sizes.max().unwrap_or(0)],
        }
    }

    /// Sets the parameters; needed before the first series, also without parameters.
    ///
    /// # Errors
    /// [`EvaluateFailure`] for a wrong length, and for a singular matrix that depends on parameters only.
    pub fn prepare(
        &self,
        parameters: &[f64],
        workspace: &mut TaylorWorkspace,
    ) -> Result<(), EvaluateFailure> {
        workspace.started = false;
        workspace.state.prepare(&self.code, parameters)?;
        workspace.state.is_prepared = workspace.state.failures.is_empty();
        workspace.state.first_failure()?;
        match (&self.machine, &mut workspace.running) {
            (Some(machine), Some(running)) => {
                machine.prepare(parameters, &workspace.state.file, running)
            }
            _ => Ok(()),
        }
    }

    /// Order 0: all values at the state `variables`, and the factorizations.
    ///
    /// # Errors
    /// [`EvaluateFailure`]: a singular matrix, a wrong length, or [`NotAnalytic`](EvaluateFailure::NotAnalytic) where
    /// a function has no Taylor series.
    pub fn start(
        &self,
        variables: &[f64],
        workspace: &mut TaylorWorkspace,
    ) -> Result<(), EvaluateFailure> {
        workspace.started = false;
        let groups = self.code.program.outputs.len();
        let state = &mut workspace.state;
        state.check_variables(&self.code.program, variables)?;
        workspace.order = 0;
        if let (Some(machine), Some(running)) = (&self.machine, &mut workspace.running) {
            machine.start(&self.recurrences, variables, running)?;
            workspace.started = true;
            return Ok(());
        }
        // Outputs are read from the registers afterwards: every value has one of its own.
        state.compute(&self.code, groups, variables, &mut [], |_, _| {});
        state.first_failure()?;
        self.recurrences.seed(&mut state.file)?;
        workspace.started = true;
        workspace.now.copy_from_slice(&state.file);
        self.recurrences
            .keep_all(&state.file, &mut workspace.series);
        Ok(())
    }

    /// The next order of all values, from the coefficients of that order of the variables.
    ///
    /// # Errors
    /// [`EvaluateFailure::NotPrepared`] before a successful [`start`](Taylor::start) or beyond the order of the
    /// workspace, and [`EvaluateFailure::Length`].
    pub fn advance(
        &self,
        variables: &[f64],
        workspace: &mut TaylorWorkspace,
    ) -> Result<(), EvaluateFailure> {
        let layout = &self.code.program.layout;
        check_length("variables", layout.variables, variables.len())?;
        if !workspace.started || workspace.order + 1 >= workspace.series.stride {
            return Err(EvaluateFailure::NotPrepared);
        }
        workspace.order += 1;
        if let (Some(machine), Some(running)) = (&self.machine, &mut workspace.running) {
            return machine.advance(workspace.order, variables, running);
        }
        workspace.now[layout.variable_range()].copy_from_slice(variables);
        let state = &workspace.state;
        let order = Order {
            j: workspace.order,
            zero: &state.file,
            now: &mut workspace.now,
            series: &mut workspace.series,
        };
        let solve = |matrix: usize, b: &[f64], x: &mut [f64]| {
            state.factored[matrix].solve(|i, _| b[i], x);
        };
        self.recurrences
            .advance(order, &solve, &mut workspace.solution);
        Ok(())
    }

    /// The coefficient of output number `index`, counted over all groups, of the order last computed.
    #[inline]
    pub fn output(&self, index: usize, workspace: &TaylorWorkspace) -> f64 {
        let register = self.outputs[index] as usize;
        if let (Some(machine), Some(running)) = (&self.machine, &workspace.running) {
            return match workspace.order {
                0 => machine.first(index, running),
                order => machine.output(index, order, running),
            };
        }
        if workspace.order > 0 && self.recurrences.is_constant[register] {
            0.0
        } else {
            workspace.now[register]
        }
    }

    /// The series of a motion whose first variable is the time and whose outputs are the rates of the other variables, in
    /// this order: writes their coefficients of orders 0 to `order`, one order after the other.
    ///
    /// # Errors
    /// As [`start`](Taylor::start) and [`advance`](Taylor::advance); [`EvaluateFailure::Length`] where there are not as many
    /// outputs, or `coefficients` has another length.
    pub fn expand(
        &self,
        variables: &[f64],
        order: usize,
        workspace: &mut TaylorWorkspace,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let m = self.outputs.len();
        check_length("outputs", self.code.program.layout.variables, m + 1)?;
        check_length("coefficients", (order + 1) * m, coefficients.len())?;
        self.start(variables, workspace)?;
        if order > workspace.capacity() {
            return Err(EvaluateFailure::NotPrepared);
        }
        if let (Some(machine), Some(running)) = (&self.machine, &mut workspace.running) {
            return machine.expand(variables, order, running, coefficients);
        }
        coefficients[..m].copy_from_slice(&variables[1..]);
        let mut inputs = variables.to_vec();
        for j in 1..=order {
            for (k, input) in inputs[1..].iter_mut().enumerate() {
                *input = self.output(k, workspace) / j as f64;
            }
            coefficients[j * m..(j + 1) * m].copy_from_slice(&inputs[1..]);
            if j < order {
                inputs[0] = if j == 1 { 1.0 } else { 0.0 };
                self.advance(&inputs, workspace)?;
            }
        }
        Ok(())
    }

    /// Storage for four motions side by side; `None` where there is no machine code for them.
    pub fn abreast(&self) -> Option<Abreast> {
        let running = self.machine.as_ref()?.running_four(self)?;
        Some(Abreast { running })
    }

    /// Sets the parameters of motion `lane` of four; needed for each before its first series.
    ///
    /// # Errors
    /// As [`prepare`](Taylor::prepare); [`EvaluateFailure::NotPrepared`] where the storage is of another program.
    pub fn prepare_abreast(
        &self,
        lane: usize,
        parameters: &[f64],
        abreast: &mut Abreast,
    ) -> Result<(), EvaluateFailure> {
        match &self.machine {
            Some(machine) if lane < ABREAST => {
                machine.prepare_four((self, lane), parameters, &mut abreast.running)
            }
            _ => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// The series of up to four motions, as [`expand`](Taylor::expand) makes those of one, with the same bits; what became of
    /// each. They are read by [`coefficients`](Taylor::coefficients).
    ///
    /// # Errors
    /// What all have in common: a wrong length, or an order beyond [`Taylor::most`].
    pub fn expand_abreast(
        &self,
        motions: [Option<&[f64]>; ABREAST],
        order: usize,
        abreast: &mut Abreast,
    ) -> Result<[Result<(), EvaluateFailure>; ABREAST], EvaluateFailure> {
        match &self.machine {
            Some(machine) => machine.expand_four(self, motions, order, &mut abreast.running),
            None => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Writes orders 1 to `order` of motion `lane` of the last [`expand_abreast`](Taylor::expand_abreast) into `coefficients`,
    /// behind those of order 0.
    ///
    /// # Errors
    /// [`EvaluateFailure::Length`].
    pub fn coefficients(
        &self,
        lane: usize,
        order: usize,
        abreast: &Abreast,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let needed = (order + 1) * self.outputs.len();
        check_length("coefficients", needed, coefficients.len())?;
        match &self.machine {
            Some(machine) if lane < ABREAST && order <= Recurring::most() => {
                machine.coefficients_of(lane, order, &abreast.running, coefficients);
                Ok(())
            }
            _ => Err(EvaluateFailure::NotPrepared),
        }
    }

    /// Whether the other runs the same machine code, as copies of one do.
    pub fn is_same_code(&self, other: &Taylor) -> bool {
        match (&self.machine, &other.machine) {
            (Some(machine), Some(other)) => machine.is_same(other),
            _ => false,
        }
    }

    /// The highest order of [`expand_abreast`](Taylor::expand_abreast).
    pub fn most() -> usize {
        Recurring::most()
    }

    /// Number of outputs of all groups together.
    pub fn output_count(&self) -> usize {
        self.outputs.len()
    }

    /// Number of instructions that cost a dot product per order, and of all others above order 0.
    pub fn counts(&self) -> (usize, usize) {
        self.recurrences.counts()
    }
}

impl TaylorWorkspace {
    /// The highest order that has room.
    pub fn capacity(&self) -> usize {
        self.series.stride - 1
    }
}
