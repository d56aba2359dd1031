//! Why there are no linear equations about a motion.

use chetaev_mechanics::characteristics::CharacteristicsError;

/// Why there is no linearization.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinearizationError {
    /// Constraints of higher order.
    #[error("steady motions are defined for constraints on velocities; this system has constraints of order {order}")]
    OrderTooHigh {
        /// m.
        order: u32,
    },
    /// A mass changes.
    #[error("a mass of this system changes along the motion, so that no motion is steady; linear equations, orbits and sensitivities are those of masses that stay")]
    MassesMove,
    /// The time occurs.
    #[error("the equations contain the time explicitly, and steady motions are looked for where they do not; `chetaev linearize --along` takes the motion from the initial state")]
    NotAutonomous,
    /// No independent velocities.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// The position of a coordinate on which the equations depend is missing.
    #[error("the motion `{motion}` does not say where `{coordinate}` is, and the equations of motion depend on it")]
    PositionMissing {
        /// The motion.
        motion: String,
        /// The coordinate.
        coordinate: String,
    },
    /// Guesses, and no steady motion near them that is known exactly.
    #[error("no steady motion was found exactly near the guesses of the motion `{motion}`: {why}; `chetaev follow --about {motion}` finds one in numbers")]
    NotFound {
        /// The motion.
        motion: String,
        /// Why.
        why: String,
    },
    /// The velocities that are not given cannot be solved for.
    #[error("the constraints do not allow the velocities of the motion `{motion}`")]
    VelocitiesNotDetermined {
        /// The motion.
        motion: String,
    },
    /// Something is divided by zero, whatever the motion.
    #[error("the equations of motion have no value: they are divided by {divisor}, which is zero at the values of the parameters")]
    NotDefined {
        /// By what.
        divisor: String,
    },
    /// A position or a velocity that is no real number.
    #[error("there is no motion `{motion}`: {value} is not real")]
    NotReal {
        /// The motion.
        motion: String,
        /// What is stated of it.
        value: String,
    },
    /// A finite constraint does not hold.
    #[error("the motion `{motion}` is not admissible: the constraint `{constraint}` is off by {residual}")]
    NotAdmissible {
        /// The motion.
        motion: String,
        /// The constraint.
        constraint: String,
        /// Left side minus right side.
        residual: String,
        /// Lower and upper bound of it, where it is a number.
        enclosure: Option<(String, String)>,
    },
    /// Something that the model assumes does not hold.
    #[error(
        "the motion `{motion}` is outside of what the model assumes: `{assumption}` does not hold"
    )]
    NotAssumed {
        /// The motion.
        motion: String,
        /// The assumption, as the model states it.
        assumption: String,
        /// Lower and upper bound of its smaller side minus its larger side, where that is not zero.
        enclosure: Option<(String, String)>,
    },
    /// The constraints do not determine the accelerations.
    #[error("at the motion `{motion}` the gradients of the constraints depend on each other, so that nothing is said of its neighbours: it is a singular place of the constraints")]
    Singular {
        /// The motion.
        motion: String,
    },
    /// What the model states has a corner or a jump there.
    #[error("at the motion `{motion}` the equations have a corner or a jump, that of `{corner}`: there are no linear equations")]
    NotSmooth {
        /// The motion.
        motion: String,
        /// What has it.
        corner: String,
    },
    /// Something may change that should be constant.
    #[error("whether the motion `{motion}` is steady was not decided: {quantity} has the rate {rate}, which was neither proved to vanish nor enclosed apart from zero")]
    Open {
        /// The motion.
        motion: String,
        /// A coordinate or a quasi-velocity.
        quantity: String,
        /// Its rate.
        rate: String,
    },
    /// Something changes that should be constant.
    #[error("the motion `{motion}` is not steady: {quantity} has the rate {rate}")]
    NotSteady {
        /// The motion.
        motion: String,
        /// A coordinate or a quasi-velocity.
        quantity: String,
        /// Its rate; the force on a quasi-velocity where the mass matrix is singular.
        rate: String,
        /// Lower and upper bound of it, where it is a number.
        enclosure: Option<(String, String)>,
    },
}
