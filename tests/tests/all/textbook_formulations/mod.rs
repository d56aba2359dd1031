//! The textbook systems in the formulations in which their books treat them: what `derive` prints is the text reviewed here,
//! and is proved equal to the book's own equations.
//!
//! Sources are keys of docs/references.bib. A book's equation is multiplied by what the formulation multiplies it with (a
//! mass, mostly), so that the difference of both has to vanish identically.

mod canonical;
mod lagrangian;
mod quasi_velocities;

const MOTION: &str = "equations of motion";
const OBJECTS: &str = "objects";
const EXTREMUM: &str = "equations of the extremum";
const NIELSEN: &str = "equations with multipliers";
const REDUCED: &str = "equations on the constraint manifold";
const FIELD_GROUP: &str = "components of X ⌟ Ω along dq";

/// A pendulum in Cartesian coordinates.
const ROD: &str = r#"
name = "rod"
coordinates = ["x", "y"]
parameters = { m = 1.2, l = 0.5, g = 9.81 }
assumptions = ["m > 0", "l > 0"]
[particles.bob]
mass = "m"
position = ["x", "y"]
force = [0, "-m g"]
[constraints]
rod = "x^2 + y^2 = l^2"
[quasi_velocities]
w = "(x y' - y x')/l^2"
[initial]
y = "-l"
"#;

/// A skate of two particles on an incline, S1 of the notes with J = m l²: the blade is midway between them.
const SKATE_OF_PARTICLES: &str = r#"
name = "skate-of-particles"
coordinates = ["x", "y", "phi"]
parameters = { m = 1.2, l = 0.5, gs = 4 }
assumptions = ["m > 0", "l > 0"]
[particles.front]
mass = "m/2"
position = ["x + l cos(phi)", "y + l sin(phi)"]
force = ["m gs/2", 0]
[particles.rear]
mass = "m/2"
position = ["x - l cos(phi)", "y - l sin(phi)"]
force = ["m gs/2", 0]
[constraints]
blade = "x' sin(phi) = y' cos(phi)"
[quasi_velocities]
u = "x' cos(phi) + y' sin(phi)"
w = "phi'"
"#;

/// A free particle in polar coordinates.
const POLAR: &str = r#"
name = "polar-particle"
coordinates = ["r", "theta"]
parameters = { m = 1.2 }
assumptions = ["m > 0", "r > 0"]
[particles.point]
mass = "m"
position = ["r cos(theta)", "r sin(theta)"]
"#;

/// A charge in a uniform magnetic field, mass 1.
const FIELD: &str = r#"
name = "charge-in-a-field"
coordinates = ["x", "y"]
parameters = { B = 1.5 }
[lagrangian]
L = "1/2 (x'^2 + y'^2) + 1/2 B (x y' - y x')"
"#;
