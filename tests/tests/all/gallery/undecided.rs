//! What the studies of the gallery leave undecided, and why.

/// Claims that may stay undecided, with the reason that the study itself must give.
pub(super) const UNDECIDED: &[(&str, &str, &str)] = &[
    (
        "snakeboard/driven.toml",
        "steady.motions",
        "contain the time explicitly",
    ),
    (
        "snakeboard/driven.toml",
        "equilibrium.states",
        "contain the time explicitly",
    ),
    (
        "moving-frame/model.toml",
        "steady.motions",
        "contain the time explicitly",
    ),
    (
        "moving-frame/model.toml",
        "equilibrium.states",
        "contain the time explicitly",
    ),
    // Where Euler's angles are no coordinates, where the gradients of constraints depend on each other, or where a constraint has none, the system
    // may rest all the same.
    (
        "appell-hamel/model.toml",
        "steady.motions",
        "nothing is said where",
    ),
    (
        "appell-hamel/to-rest.toml",
        "steady.motions",
        "nothing is said where",
    ),
    (
        "chaplygin-sphere/model.toml",
        "equilibrium.states",
        "nothing is said where sin(theta) vanishes",
    ),
    (
        "snakeboard/model.toml",
        "equilibrium.states",
        "nothing is said where cos(phi) vanishes",
    ),
    (
        "snakeboard/model.toml",
        "steady.motions",
        "nothing is said where cos(phi) vanishes",
    ),
    (
        "trailer/model.toml",
        "equilibrium.states",
        "nothing is said where a function of",
    ),
    // At rest Appell's constraint and that of constant speed have no gradient; masses that change are no state of rest; what is too large for a
    // quarter of a second is left to `chetaev steady`.
    (
        "appell-hamel/model.toml",
        "equilibrium.states",
        "not defined there",
    ),
    (
        "appell-hamel/to-rest.toml",
        "equilibrium.states",
        "not defined there",
    ),
    (
        "isokinetic-particle/model.toml",
        "equilibrium.states",
        "not defined there",
    ),
    (
        "rocket-on-appells-constraint/burnt-out.toml",
        "equilibrium.states",
        "not defined there",
    ),
    (
        "rocket-on-appells-constraint/model.toml",
        "equilibrium.states",
        "not defined there",
    ),
    (
        "chaplygin-sphere/model.toml",
        "steady.motions",
        "not solved within the work",
    ),
    (
        "rattleback/model.toml",
        "equilibrium.states",
        "not solved within the work",
    ),
    (
        "rattleback/model.toml",
        "steady.motions",
        "not solved within the work",
    ),
    (
        "trailer/model.toml",
        "steady.motions",
        "not solved within the work",
    ),
    ("trailer/model-8.toml", "equilibrium.states", "too large"),
    ("trailer/model-8.toml", "steady.motions", "too large"),
    (
        "whipple-bicycle/general.toml",
        "equilibrium.states",
        "not solved within the work",
    ),
    (
        "whipple-bicycle/general.toml",
        "steady.motions",
        "too large",
    ),
    (
        "whipple-bicycle/model.toml",
        "equilibrium.states",
        "not solved within the work",
    ),
    ("whipple-bicycle/model.toml", "steady.motions", "too large"),
    (
        "leaking-pendulum/model.toml",
        "equilibrium.states",
        "a mass of this system changes",
    ),
    (
        "leaking-pendulum/model.toml",
        "steady.motions",
        "a mass of this system changes",
    ),
    (
        "sand-cart/model.toml",
        "equilibrium.states",
        "a mass of this system changes",
    ),
    (
        "sand-cart/model.toml",
        "steady.motions",
        "a mass of this system changes",
    ),
    // With absolute headings the direction of driving is a zero eigenvalue with a Jordan chain.
    (
        "trailer/model.toml",
        "stability.asymptotic#driving",
        "an eigenvalue is zero and belongs to no family",
    ),
    (
        "trailer/model.toml",
        "stability.nonlinear#driving",
        "eigenvalues lie on the axis",
    ),
    (
        "trailer/model-8.toml",
        "stability.asymptotic#driving",
        "an eigenvalue is zero and belongs to no family",
    ),
    (
        "trailer/model-8.toml",
        "stability.nonlinear#driving",
        "eigenvalues lie on the axis",
    ),
    // Polynomials in t and uniform rotations are integrated exactly by a method of order 8: no error, hence no order.
    (
        "appell-hamel/model.toml",
        "motion.method-order",
        "too simple",
    ),
    (
        "appell-hamel/to-rest.toml",
        "motion.method-order",
        "too simple",
    ),
    (
        "falling-rolling-disc/steady.toml",
        "motion.method-order",
        "too simple",
    ),
    ("heavy-top/steady.toml", "motion.method-order", "too simple"),
    ("sand-cart/model.toml", "motion.method-order", "too simple"),
    (
        "moving-knife-edge/lift.toml",
        "motion.method-order",
        "too simple",
    ),
    // The eighth derivatives of eight nested chains.
    (
        "trailer/model-8.toml",
        "formulation.vakonomic-coincides#inclusion",
        "grow too large",
    ),
    (
        "trailer/model-8.toml",
        "hamilton-jacobi.applicable",
        "grow too large",
    ),
    // The minor of the velocities chosen is small all the time.
    (
        "trailer/model-8.toml",
        "witness.first-variation#voronets",
        "the velocities taken as independent",
    ),
    (
        "trailer/model-8.toml",
        "witness.first-variation#suslov",
        "the velocities taken as independent",
    ),
    (
        "trailer/model-8.toml",
        "witness.universal-relation#suslov",
        "the velocities taken as independent",
    ),
    // The axis rests at a double root of its momentum.
    (
        "heavy-top/steady.toml",
        "witness.hamilton-jacobi#separated",
        "no value along the motion",
    ),
    // H₁ is not even in the momenta.
    (
        "moving-knife-edge/lift.toml",
        "witness.hamilton-jacobi#separated",
        "no quadratures were written",
    ),
    // The stem turns over, and velocities that the operator divides by vanish again and again.
    (
        "tippe-top/model.toml",
        "witness.universal-relation#vujanovic",
        "on which the operator has no pole",
    ),
    // An index belongs to a κ, not to the curve.
    ("appell-hamel/model.toml", "witness.index", "not unique"),
    ("appell-hamel/to-rest.toml", "witness.index", "not unique"),
    // An integral with √(1 + a²), which is no rational function of the parameters.
    (
        "rocket-on-appells-constraint/model.toml",
        "noether.family",
        "whose coefficients were not found",
    ),
    (
        "rocket-on-appells-constraint/burnt-out.toml",
        "noether.family",
        "whose coefficients were not found",
    ),
    // A fifth of a second, a few steps: the bicycle falls.
    (
        "whipple-bicycle/general.toml",
        "motion.method-order",
        "too short",
    ),
    // The sphere v·v = c² has no velocities in closed form that hold on all of it.
    (
        "isokinetic-particle/model.toml",
        "liouville.integrable",
        "the dependent velocities stay implicit",
    ),
    // Integrals outside the families searched, or none: for the disc they are hypergeometric, and the double pendulum is chaotic.
    (
        "ball-in-cylinder/model.toml",
        "liouville.integrable",
        "missing; the invariant measure is known",
    ),
    (
        "double-pendulum/model.toml",
        "liouville.integrable",
        "missing; the invariant measure is known",
    ),
    (
        "falling-rolling-disc/model.toml",
        "liouville.integrable",
        "missing; the invariant measure is known",
    ),
    (
        "falling-rolling-disc/steady.toml",
        "liouville.integrable",
        "missing; the invariant measure is known",
    ),
    // The shaken pendulum is chaotic.
    (
        "kapitza-pendulum/model.toml",
        "liouville.integrable",
        "missing; the invariant measure is known",
    ),
    (
        "pendulum-particle/model.toml",
        "liouville.integrable",
        "missing; the invariant measure is known",
    ),
    (
        "sphere-on-turntable/model.toml",
        "liouville.integrable",
        "missing; the invariant measure is known",
    ),
    // Neither enough integrals nor a measure in the families searched.
    (
        "rattleback/model.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    (
        "suslov/model.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    (
        "trailer/model-8.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    (
        "trailer/model.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    (
        "tippe-top/model.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    (
        "watt-governor/model.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    (
        "whipple-bicycle/general.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    (
        "whipple-bicycle/model.toml",
        "liouville.integrable",
        "an invariant measure of the reduced motion is not known",
    ),
    // The divergence of the governor is constant: densities with the speed of the shaft are not excluded.
    (
        "watt-governor/model.toml",
        "measure.invariant",
        "no density depends on the coordinates only",
    ),
    // Gravity moves the bicycle from rest, and no steady motion of one quasi-velocity is known: densities with velocities stay.
    (
        "whipple-bicycle/general.toml",
        "measure.invariant",
        "densities that contain velocities are not excluded",
    ),
    (
        "whipple-bicycle/model.toml",
        "measure.invariant",
        "densities that contain velocities are not excluded",
    ),
    // The measure is refuted.
    (
        "roller-racer/model.toml",
        "liouville.integrable",
        "no invariant measure of the reduced motion is known",
    ),
    // Gravity moves all momenta; the search for axes and directions is over candidates.
    (
        "pendulum-particle/cartesian.toml",
        "noether.moving-axis",
        "none of",
    ),
    (
        "pendulum-particle/model.toml",
        "noether.moving-axis",
        "none of",
    ),
    // The same.
    (
        "pendulum-particle/cartesian.toml",
        "noether.moving-direction",
        "none of",
    ),
    (
        "pendulum-particle/model.toml",
        "noether.moving-direction",
        "none of",
    ),
    // Brackets and derivatives along eight nested chains.
    (
        "trailer/model-8.toml",
        "hamilton.stationary",
        "grow too large",
    ),
    // The same.
    ("trailer/model-8.toml", "distribution.growth", "than 20000"),
];
