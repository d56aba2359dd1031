//! What the literature says of the gallery's motions: closed forms and numbers, each with where it is derived.
//! The numbers stand in the README of the model as well; a test compares both.

/// A closed form that holds along a whole run.
#[derive(Clone, Copy, Debug)]
pub struct ClosedForm {
    /// `NAME/FILE.toml`.
    pub file: &'static str,
    /// Followed along the run.
    pub expression: &'static str,
    /// What it equals, in parameters, t and coordinates.
    pub formula: &'static str,
    /// Largest difference allowed.
    pub tolerance: f64,
}

const fn form(
    file: &'static str,
    expression: &'static str,
    formula: &'static str,
    tolerance: f64,
) -> ClosedForm {
    ClosedForm {
        file,
        expression,
        formula,
        tolerance,
    }
}

/// Closed forms. Tolerances are a hundred times the tolerance of the run, more where an error grows with the time.
pub const CLOSED_FORMS: &[ClosedForm] = &[
    // Hamel 1949: the reaction is constant, the horizontal speed falls uniformly.
    form("appell-hamel/model.toml", "lambda_cone", "m g/(1 + rho^2)", 1e-9),
    form("appell-hamel/model.toml", "z", "rho (s0 t - g rho t^2/(2 (1 + rho^2)))", 1e-9),
    form("appell-hamel/model.toml", "x sin(al)", "y cos(al)", 1e-9),
    form("appell-hamel/to-rest.toml", "s", "s0 - g rho t/(1 + rho^2)", 1e-7),
    // Caratheodory 1933; the heading is a gudermannian, the reaction the lateral acceleration of the mass centre.
    form("chaplygin-sleigh/model.toml", "v", "V tanh(k t)", 1e-8),
    form("chaplygin-sleigh/model.toml", "phi'", "W/cosh(k t)", 1e-8),
    form("chaplygin-sleigh/model.toml", "phi", "W/k (2 atan(exp(k t)) - pi/2)", 1e-8),
    form("chaplygin-sleigh/model.toml", "lambda_blade", "m J/(J + m a^2) V W tanh(k t)/cosh(k t)", 1e-7),
    // Newton's law for the lower mass of the double pendulum: its weight and the tension along the lower rod only.
    form(
        "double-pendulum/model.toml",
        "cos(b) (l a'' cos(a) - l a'^2 sin(a) + l b'' cos(b) - l b'^2 sin(b)) + sin(b) (l a'' sin(a) + l a'^2 cos(a) + l b'' sin(b) + l b'^2 cos(b))",
        "-g sin(b)",
        1e-8,
    ),
    // O'Reilly 1996: steady rolling.
    form("falling-rolling-disc/steady.toml", "theta", "th", 1e-7),
    form("falling-rolling-disc/steady.toml", "phi", "Om t", 1e-7),
    form("falling-rolling-disc/steady.toml", "W2", "-2.87758821834298", 1e-7),
    // The moment equation about the heading of a thin homogeneous disc (O'Reilly 1996).
    form(
        "falling-rolling-disc/model.toml",
        "5 theta'' - 4 g/r sin(theta) - 6 W2 W3 + W3^2 tan(theta)",
        "0",
        1e-6,
    ),
    // Theory of constraints of order m, worked examples (Qiao): circle, central field, jerk along the acceleration.
    form("prescribed-curvature/model.toml", "x - y'/(gamma v)", "0", 1e-9),
    form("prescribed-curvature/model.toml", "y + x'/(gamma v)", "1/gamma", 1e-9),
    form("prescribed-curvature/model.toml", "lambda_bend", "m (gamma v + g x'/v^2)", 1e-7),
    form("fixed-acceleration/model.toml", "lambda_push", "(m - k r/alpha)/2", 1e-9),
    form("fixed-acceleration/model.toml", "x y' - y x'", "v0", 1e-9),
    form("fixed-acceleration/model.toml", "(x'^2 + y'^2)/2 + alpha r", "v0^2/2 + alpha", 1e-9),
    form("fixed-acceleration/circle.toml", "x", "cos(v0 t)", 1e-8),
    form("fixed-acceleration/circle.toml", "y", "sin(v0 t)", 1e-8),
    form("fixed-jerk/model.toml", "x''", "0.6 (1 + j t)", 1e-10),
    form("fixed-jerk/model.toml", "x", "1 + t/2 + 0.3 (t^2 + j t^3/3)", 1e-10),
    form("fixed-jerk/stop.toml", "y", "t + 0.4 (t^2 - j t^3/3)", 1e-9),
    form("third-order-linear/model.toml", "x + y", "1 + t + (2 l0 - gamma) t^2/2", 1e-9),
    form("third-order-linear/model.toml", "x - y", "cos(sqrt(gamma) t) - sin(sqrt(gamma) t)/sqrt(gamma)", 1e-9),
    form("third-order-linear/model.toml", "lambda_sum", "l0 + gamma (x + y - 1)/2", 1e-9),
    form("knife-edge-order-2/model.toml", "slip", "c", 1e-9),
    form("knife-edge-order-2/model.toml", "u", "u0 - c W t", 1e-9),
    form("knife-edge-order-3/model.toml", "slip", "c + d t", 1e-9),
    form("knife-edge-order-3/model.toml", "u", "u0 - W (c t + d t^2/2)", 1e-9),
    // Klein and Sommerfeld 1910; Whittaker 1937.
    form("heavy-top/model.toml", "A phi' sin(theta)^2 + C W3 cos(theta)", "1.5", 1e-9),
    form("heavy-top/model.toml", "C W3", "3", 1e-9),
    form("heavy-top/steady.toml", "phi", "0.430953484266974 t", 1e-8),
    form("heavy-top/steady.toml", "theta", "th", 1e-8),
    // Meshchersky 1897: nothing pushes, and the pendulum does not notice that it leaks.
    form("leaking-pendulum/model.toml", "l theta''", "-g sin(theta)", 1e-9),
    form("leaking-pendulum/model.toml", "l^2 theta'^2/2 - g l cos(theta)", "3.26592037322197", 1e-9),
    // Galileo's principle, from the skate at rest.
    form("moving-knife-edge/model.toml", "x", "gs/(2 W^2) sin(W t)^2", 1e-8),
    form("moving-knife-edge/model.toml", "y", "-gs/(4 W^2) sin(2 W t)", 1e-8),
    form("moving-knife-edge/lift.toml", "lambda_floor", "m g", 1e-8),
    form("moving-knife-edge/lift.toml", "lambda_floor y'", "1030.05", 1e-8),
    // Rosenberg 1977; Bates and Sniatycki 1993.
    form("particle-y-dx/model.toml", "x", "(c/u) (asinh(y0 + u t) - asinh(y0))", 1e-8),
    form("particle-y-dx/model.toml", "z", "(c/u) (sqrt(1 + (y0 + u t)^2) - sqrt(1 + y0^2))", 1e-8),
    form("particle-y-dx/model.toml", "x' sqrt(1 + y^2)", "0.861626369141521", 1e-9),
    form("particle-y-dx/model.toml", "lambda_rolling", "m x' y'/(1 + y^2)", 1e-9),
    // Pesce 2003: mist at rest, a mass that depends on the way.
    form("raindrop/model.toml", "x''", "(g/7) (1 + 6/(1 + s x)^7)", 1e-9),
    form("raindrop/model.toml", "x'^2", "(2 g/(7 s)) ((1 + s x)^7 - 1)/(1 + s x)^6", 1e-8),
    // Gravity as on Appell's particle, and Tsiolkovsky's logarithm along the slope.
    form("rocket-on-appells-constraint/model.toml", "lambda_cone", "m g/(1 + a^2)", 1e-9),
    form("rocket-on-appells-constraint/model.toml", "s", "s0 - g a t/(1 + a^2) + (c/sqrt(1 + a^2)) log(m0/m)", 1e-9),
    form("rocket-on-appells-constraint/model.toml", "x sin(al)", "y cos(al)", 1e-9),
    // The law of momentum: what is picked up at rest brings none, what runs out takes its own.
    form("sand-cart/model.toml", "load", "L0 exp(-k t)", 1e-9),
    form("sand-cart/model.toml", "(m0 + b t + load) x''", "F - b x'", 1e-9),
    // Bloch 2003: the coin; the redundant multipliers give the same force.
    form("vertical-rolling-disc/model.toml", "x", "(R w/O) sin(O t)", 1e-8),
    form("vertical-rolling-disc/model.toml", "y", "(R w/O) (1 - cos(O t))", 1e-8),
    form("vertical-rolling-disc/model.toml", "lambda_along_x", "-m R w O sin(phi)", 1e-8),
    form("vertical-rolling-disc/model.toml", "lambda_along_y", "m R w O cos(phi)", 1e-8),
    form("redundant-constraints/model.toml", "x", "(R w/O) sin(O t)", 1e-8),
    form("redundant-constraints/model.toml", "y", "(R w/O) (1 - cos(O t))", 1e-8),
    form(
        "redundant-constraints/model.toml",
        "lambda_along_x + cos(phi) lambda_forward - sin(phi) lambda_sideways",
        "-m R w O sin(O t)",
        1e-8,
    ),
    // Krishnaprasad and Tsakiris 2001.
    form(
        "roller-racer/model.toml",
        "1/2 m (x'^2 + y'^2) + 1/2 J1 theta'^2 + 1/2 J2 (theta' + phi')^2",
        "0.44234193452223",
        1e-9,
    ),
    // Arnold, Kozlov, Neishtadt 2006.
    form("skate-incline/model.toml", "x", "gs/(2 W^2) sin(W t)^2", 1e-8),
    form("skate-incline/model.toml", "y", "gs/(2 W^2) (W t - sin(2 W t)/2)", 1e-8),
    form("skate-incline/model.toml", "lambda_blade", "-2 m gs sin(W t)", 1e-8),
    // Neimark and Fufaev 1972.
    form("skate-level/model.toml", "x", "u0/W sin(W t)", 1e-8),
    form("skate-level/model.toml", "y", "u0/W (1 - cos(W t))", 1e-8),
    form("skate-level/model.toml", "lambda_blade", "-3.12", 1e-8),
    // The momentum equation of the snakeboard integrated (Ostrowski et al. 1994, Bloch et al. 1996).
    form(
        "snakeboard/model.toml",
        "x' cos(theta) + y' sin(theta)",
        "v0 sqrt((1 + kap tan(ph0)^2)/(1 + kap tan(ph0 + w t)^2))",
        1e-8,
    ),
    form("snakeboard/model.toml", "psi' + theta'", "0.934448906951502", 1e-8),
    form("snakeboard/driven.toml", "phi", "ph0 + tf (cos(W t) - 1)/(2 Jw W^2)", 1e-8),
    // Earnshaw 1844: the center runs round a circle at the rate p.
    form("sphere-on-turntable/model.toml", "x", "x0 + (vx sin(p t) + vy (cos(p t) - 1))/p", 1e-8),
    form("sphere-on-turntable/model.toml", "y", "(vy sin(p t) + vx (1 - cos(p t)))/p", 1e-8),
    // No torque acts on the car.
    form("trailer/model.toml", "theta_0", "W t", 1e-8),
    form("trailer/model-8.toml", "theta_0", "W t", 1e-8),
];

/// A number at a time, as it stands in the README of the model's folder.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// `NAME/FILE.toml`.
    pub file: &'static str,
    /// Followed.
    pub expression: &'static str,
    /// When.
    pub t: f64,
    /// As the README writes it.
    pub value: &'static str,
    /// Largest difference allowed.
    pub tolerance: f64,
}

const fn number(
    file: &'static str,
    expression: &'static str,
    t: f64,
    value: &'static str,
    tolerance: f64,
) -> Number {
    Number {
        file,
        expression,
        t,
        value,
        tolerance,
    }
}

/// Numbers; those without a closed form come from integrations by other programs, at two tolerances each.
pub const NUMBERS: &[Number] = &[
    number(
        "prescribed-curvature/model.toml",
        "y",
        1.77919556895971,
        "0",
        1e-8,
    ),
    number(
        "radial-acceleration/model.toml",
        "x",
        1.0,
        "2.98009605064369",
        1e-9,
    ),
    number(
        "radial-acceleration/model.toml",
        "y",
        1.0,
        "-1.4271860761853",
        1e-9,
    ),
    number(
        "radial-acceleration-polar/model.toml",
        "x",
        1.0,
        "2.98009605064369",
        1e-9,
    ),
    number(
        "radial-acceleration-polar/model.toml",
        "y",
        1.0,
        "-1.4271860761853",
        1e-9,
    ),
    number(
        "appell-hamel/model.toml",
        "z",
        1.0,
        "2.58694630872483",
        1e-9,
    ),
    number(
        "appell-hamel/model.toml",
        "1/2 m (x'^2 + y'^2 + z'^2) + m g z",
        1.0,
        "34.866",
        1e-8,
    ),
    number(
        "chaplygin-sleigh/model.toml",
        "v",
        2.0,
        "1.14439780299939",
        1e-8,
    ),
    number(
        "chaplygin-sleigh/model.toml",
        "phi'",
        2.0,
        "0.656755358163483",
        1e-8,
    ),
    number(
        "chaplygin-sleigh/model.toml",
        "1/2 (m v^2 + (J + m a^2) phi'^2)",
        2.0,
        "1.08871875",
        1e-8,
    ),
    number(
        "chaplygin-sleigh/model.toml",
        "phi",
        40.0,
        "3.60485493856563",
        1e-8,
    ),
    number(
        "double-pendulum/model.toml",
        "a",
        3.0,
        "0.143110406669",
        1e-8,
    ),
    number(
        "double-pendulum/model.toml",
        "b",
        3.0,
        "0.226581806026",
        1e-8,
    ),
    number(
        "double-pendulum/model.toml",
        "1/2 m (x1'^2 + y1'^2) + 1/2 m (x2'^2 + y2'^2) + m g y1 + m g y2",
        10.0,
        "-19.2098161732775",
        1e-8,
    ),
    number(
        "falling-rolling-disc/model.toml",
        "theta",
        4.0,
        "0.489816967852",
        1e-7,
    ),
    number(
        "falling-rolling-disc/model.toml",
        "x",
        4.0,
        "-1.21273305194",
        1e-7,
    ),
    number(
        "falling-rolling-disc/model.toml",
        "y",
        4.0,
        "-2.36159953795",
        1e-7,
    ),
    number(
        "falling-rolling-disc/model.toml",
        "1/2 m (cx'^2 + cy'^2 + cz'^2) + 1/2 A (W1^2 + W3^2) + 1/2 Cc W2^2 + m g cz",
        4.0,
        "12.3398997641889",
        1e-8,
    ),
    number(
        "heavy-top/model.toml",
        "1/2 A (theta'^2 + phi'^2 sin(theta)^2) + 1/2 C W3^2 + mgl cos(theta)",
        8.0,
        "9.6",
        1e-9,
    ),
    number(
        "particle-y-dx/model.toml",
        "x",
        3.0,
        "1.27616682827466",
        1e-8,
    ),
    number(
        "particle-y-dx/model.toml",
        "z",
        3.0,
        "2.15854686398839",
        1e-8,
    ),
    number(
        "redundant-constraints/model.toml",
        "x",
        4.0,
        "-0.223532398559141",
        1e-8,
    ),
    number(
        "redundant-constraints/model.toml",
        "y",
        4.0,
        "0.0318637706797072",
        1e-8,
    ),
    number(
        "roller-racer/model.toml",
        "theta",
        5.0,
        "-2.24031041641",
        1e-8,
    ),
    number(
        "roller-racer/model.toml",
        "phi",
        5.0,
        "-3.32792205372",
        1e-8,
    ),
    number("roller-racer/model.toml", "x", 5.0, "2.43083432014", 1e-8),
    number("roller-racer/model.toml", "y", 5.0, "-0.705379331408", 1e-8),
    number(
        "skate-incline/model.toml",
        "x",
        4.0,
        "0.923659323921437",
        1e-8,
    ),
    number(
        "skate-incline/model.toml",
        "y",
        10.0,
        "14.9333973665801",
        1e-8,
    ),
    number(
        "skate-incline/model.toml",
        "lambda_blade",
        4.0,
        "8.48116469491347",
        1e-8,
    ),
    number(
        "skate-incline/model.toml",
        "gs/(2 W)",
        0.0,
        "1.53846153846154",
        1e-13,
    ),
    number(
        "skate-level/model.toml",
        "u/phi'",
        10.0,
        "1.53846153846154",
        1e-8,
    ),
    number("snakeboard/model.toml", "v", 4.0, "0.652731400319858", 1e-8),
    number(
        "snakeboard/model.toml",
        "1/2 m (x'^2 + y'^2) + 1/2 m l^2 theta'^2 + 1/2 Jr psi'^2 + Jr psi' theta' + Jw phi'^2",
        4.0,
        "2.03956756005353",
        1e-8,
    ),
    number("snakeboard/model.toml", "x", 4.0, "0.690127496872", 1e-8),
    number("snakeboard/model.toml", "y", 4.0, "0.761357404833", 1e-8),
    number(
        "snakeboard/driven.toml",
        "phi",
        4.0,
        "0.0653008797183316",
        1e-8,
    ),
    number(
        "sphere-on-turntable/model.toml",
        "x",
        0.9,
        "0.631359281210713",
        1e-8,
    ),
    number(
        "sphere-on-turntable/model.toml",
        "y",
        0.9,
        "-0.149532334424944",
        1e-8,
    ),
    number(
        "sphere-on-turntable/model.toml",
        "1/2 m (x'^2 + y'^2) + 1/2 kap m r^2 (Wx^2 + Wy^2 + Wz^2) - Om moment",
        0.9,
        "0.412",
        1e-8,
    ),
    number(
        "vertical-rolling-disc/model.toml",
        "x",
        1.0,
        "0.797995989283244",
        1e-8,
    ),
    number(
        "vertical-rolling-disc/model.toml",
        "y",
        1.0,
        "0.743410238665838",
        1e-8,
    ),
];
