//! Where two figures of any kind touch.
//!
//! One of them is given by a function F that grows outwards, the other by points x(u) with as many parameters u as it has dimensions: none for a
//! point, one for a rim or a rail, two for a surface. They touch where F(x(u)) = 0 and ∂F(x(u))/∂u = 0: the points coincide and the
//! normals are opposite (D. J. Montana, The kinematics of contact and grasp, 1988; W. Johnson, Contact kinematics, in Multibody dynamics, 2007).
//! With k parameters these are k + 1 finite constraints and k coordinates of contact. Where F is of second degree in a parameter, as of a
//! cone on a straight rail, the parameter is solved for and neither is needed. A thickness around a rim, a rail or a point (a tyre, the head of a
//! rail) is laid around the other figure, whose parallel figure is touched.
//!
//! The constraints ∂F/∂u = 0 exert nothing: their multipliers κ satisfy ∂²F/∂u² κ = 0.

use chetaev_symbolic::{Expr, Symbol};

use super::algebra::{Algebra, Vector};
use super::figures::{Curved, Figure, Found, Held};
use super::grounds::{Ground, Line};
use super::lowering::{FrameId, Lowering};
use super::sections::word;
use super::shapes::Outline;
use super::tree::ContactStated;
use crate::diagnostic::Diagnostic;
use crate::source::Place;
use crate::text::Text;

/// Where a frame stands in another one: its origin, and the axes of the other one in its own.
#[derive(Clone, Copy)]
struct Pose {
    position: Vector,
    rows: [Vector; 3],
}

impl Pose {
    /// A vector of the other frame along the axes of this one.
    fn inward(&self, a: &Algebra, v: Vector) -> Vector {
        let parts = [0, 1, 2].map(|i| a.times(v[i], self.rows[i]));
        a.plus(parts[0], a.plus(parts[1], parts[2]))
    }

    /// A vector of this frame along the axes of the other one.
    fn outward(&self, a: &Algebra, v: Vector) -> Vector {
        self.rows.map(|row| a.dot(row, v))
    }

    /// A point of this frame, seen from the other one.
    fn point(&self, a: &Algebra, v: Vector) -> Vector {
        a.plus(self.position, self.outward(a, v))
    }

    fn all(&self) -> Vec<Expr> {
        let rows = self.rows.iter().flatten();
        self.position.iter().chain(rows).copied().collect()
    }

    /// The force and the torque about its origin, along its own axes, by which a function of it acts on this frame.
    fn wrench(&self, a: &Algebra, function: Expr) -> [Vector; 2] {
        let symbols: Vec<Symbol> = self
            .all()
            .iter()
            .filter_map(|e| a.graph.as_symbol(*e))
            .collect();
        let slopes = a.graph.gradient(function, &symbols);
        let of = |from: usize| -> Vector { [slopes[from], slopes[from + 1], slopes[from + 2]] };
        let by_rows = [of(3), of(6), of(9)];
        // The axis k of this frame moves by ω × its direction.
        let mut torque = a.zero();
        for k in 0..3 {
            let axis = self.rows.map(|row| row[k]);
            torque = a.plus(torque, a.cross(axis, by_rows.map(|row| row[k])));
        }
        [self.inward(a, of(0)), self.inward(a, torque)]
    }
}

/// A parameter of a figure while it is derived, and what it is called where it stays a coordinate.
struct Parameter {
    symbol: Symbol,
    name: Text,
    unit: &'static str,
}

/// Which of the two is given by a function.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Body,
    Ground,
}

/// Two figures, in the symbols of a pose and of parameters.
struct Meeting {
    side: Side,
    /// The function of three variables, and these.
    function: Expr,
    variables: [Symbol; 3],
    /// Where the point of the other figure is, for the function.
    argument: Vector,
    parameters: Vec<Parameter>,
    /// The direction of a rail, in the frame of the ground.
    rail: Option<Vector>,
    /// What is laid around the other figure: the point of contact is so far from its point.
    around: Option<Expr>,
}

/// What a parameter is in the model: a coordinate, or a function of the others.
struct Settled {
    symbol: Expr,
    value: Expr,
}

impl<'r> Lowering<'r> {
    /// Where a figure of a body and the ground touch; nothing where the two do not touch in a point, which is reported.
    pub(crate) fn tangent(
        &mut self,
        contact: &ContactStated<'r>,
        figure: &Figure,
        [plane, body]: [FrameId; 2],
        ground: &Ground,
    ) -> Option<Curved> {
        let (axes, middle) =
            self.still_axes(body, figure, |axis| figure.is_turned_into_itself(axis));
        let place = contact.object.place;
        let pose = Pose {
            position: self.position(plane, axes),
            rows: self.axes(plane, axes),
        };
        let free = self.free_pose();
        let meeting = match self.meeting(contact, figure, middle, ground, &free) {
            Ok(meeting) => meeting,
            Err(why) => {
                let problem = Diagnostic::error("not-allowed-here", place, why.message);
                self.problems.push(problem.hint(why.hint));
                return None;
            }
        };
        Some(self.met(
            contact,
            figure,
            &meeting,
            [free, pose],
            [plane, axes, body],
            middle,
        ))
    }

    /// A pose of symbols, which nobody can name.
    fn free_pose(&self) -> Pose {
        let own = |what: &str, i: usize| self.algebra.symbol(&format!("contact {what} {i}"));
        Pose {
            position: [0, 1, 2].map(|i| own("place", i)),
            rows: [0, 1, 2].map(|i| [0, 1, 2].map(|k| own("axes", 3 * i + k))),
        }
    }

    fn free_symbol(&self, name: &str) -> Option<(Expr, Symbol)> {
        let own = self.algebra.symbol(&format!("contact {name}"));
        Some((own, self.algebra.graph.as_symbol(own)?))
    }
}

/// Why two figures do not touch in a point, or are not known to.
struct Unfit {
    message: String,
    hint: &'static str,
}

impl<'r> Lowering<'r> {
    fn meeting(
        &mut self,
        contact: &ContactStated<'r>,
        figure: &Figure,
        middle: Vector,
        ground: &Ground,
        pose: &Pose,
    ) -> Result<Meeting, Unfit> {
        let words = contact.object.words();
        let unfit = |hint| {
            Unfit {
            message: format!("{words}: what touches and what is touched do not meet in a point that could be found"),
            hint,
        }
        };
        let by_ground = self.lay(contact, figure, middle, ground, pose);
        if let Some(meeting) = by_ground {
            return Ok(meeting);
        }
        let on_plane = matches!(ground, Ground::Plane) && figure.outline == Outline::Tapered;
        if on_plane {
            return Err(unfit("a cone or cylinder touches a plane along a line"));
        }
        let wrapped = self.wrap(contact, figure, middle, ground, pose);
        wrapped.ok_or_else(|| {
            unfit(match (figure.outline, ground) {
                (Outline::Rim, Ground::Line { .. }) => "two lines: give the rail the `radius` of its head, or the wheel a `taper`",
                (Outline::None, Ground::Line { .. }) => "a point on a line is tied by two constraints: state a joint, or the constraints themselves",
                (Outline::Stated | Outline::Ellipsoid, Ground::Line { .. }) => "leave out the `radius` of the rail: the figure parallel to this one has no equation",
                _ => "state the surface by its `height`, or the body by another figure",
            })
        })
    }

    /// A point or a rim of the body on ground that is given by a function.
    fn lay(
        &mut self,
        contact: &ContactStated<'r>,
        figure: &Figure,
        middle: Vector,
        ground: &Ground,
        pose: &Pose,
    ) -> Option<Meeting> {
        let tube = match figure.outline {
            Outline::None | Outline::Rim => None,
            Outline::Torus => figure.lengths.get(1).copied(),
            _ => return None,
        };
        let variables = self.variables()?;
        let at = variables.map(|symbol| self.algebra.graph.symbol_expr(symbol));
        let function = self.height_above(ground, at, tube)?;
        let mut parameters = Vec::new();
        let mut point = middle;
        if figure.outline != Outline::None {
            let round = match ground {
                Ground::Round {
                    is_sphere: true,
                    figure: own,
                    ..
                } => Some(self.rim_towards(
                    figure,
                    pose.inward(&self.algebra, pose.point(&self.algebra, middle)),
                    own.is_inside,
                )),
                _ => None,
            };
            let round = match round {
                Some(round) => round,
                None => {
                    let (angle, symbol) = self.free_symbol("angle")?;
                    parameters.push(Parameter {
                        symbol,
                        name: word(
                            format!("{}_angle", contact.object.name()),
                            contact.object.place,
                        ),
                        unit: "rad",
                    });
                    self.rim_at(figure, angle)
                }
            };
            point = self.algebra.plus(middle, round);
        }
        Some(Meeting {
            side: Side::Ground,
            function,
            variables,
            argument: pose.point(&self.algebra, point),
            parameters,
            rail: None,
            around: tube,
        })
    }

    /// The point of a rim that is nearest to a middle, or farthest where it is inside; `away` points from there to the middle of the rim.
    fn rim_towards(&self, figure: &Figure, away: Vector, is_inside: bool) -> Vector {
        let a = &self.algebra;
        let mut flat = away;
        flat[figure.axis] = a.graph.zero();
        let share = a
            .graph
            .div(figure.radius(), a.graph.sqrt(a.dot(flat, flat)));
        let out = a.times(share, flat);
        if is_inside {
            out
        } else {
            a.minus(a.zero(), out)
        }
    }

    /// The point of a rim at an angle, which is its lowest at 0 where the axes are those of the ground.
    fn rim_at(&self, figure: &Figure, angle: Expr) -> Vector {
        let a = &self.algebra;
        let first = if figure.axis == self.up.axis {
            (figure.axis + 1) % 3
        } else {
            self.up.axis
        };
        let second = 3 - figure.axis - first;
        let mut round = a.zero();
        round[first] = a.graph.mul(&[figure.radius(), a.graph.cos(angle)]);
        if first == self.up.axis && !self.up.is_backward {
            round[first] = a.graph.neg(round[first]);
        }
        round[second] = a.graph.mul(&[figure.radius(), a.graph.sin(angle)]);
        round
    }

    fn variables(&self) -> Option<[Symbol; 3]> {
        let all = [0, 1, 2].map(|i| self.free_symbol(&format!("at {i}")).map(|own| own.1));
        let [Some(x), Some(y), Some(z)] = all else {
            return None;
        };
        Some([x, y, z])
    }

    /// A function of a point that vanishes on the ground with `more` laid around it and grows towards the bodies.
    fn height_above(&mut self, ground: &Ground, at: Vector, more: Option<Expr>) -> Option<Expr> {
        let level = self.level();
        let up = self.up_vector();
        let a = &self.algebra;
        Some(match ground {
            Ground::Round { away, figure, .. } => {
                let reach = figure.reach(a, more.unwrap_or(a.graph.zero()));
                figure.height(a, away(a, figure, at), reach)
            }
            Ground::Heights {
                height, variables, ..
            } if more.is_none() => {
                let own = variables.map(|symbol| a.graph.symbol_expr(symbol));
                let pairs = [(own[0], at[level[0]]), (own[1], at[level[1]])];
                a.graph
                    .sub(a.dot(up, at), a.graph.substitute(*height, &pairs))
            }
            Ground::Equation { value, variables } if more.is_none() => {
                let own = variables.map(|symbol| a.graph.symbol_expr(symbol));
                let pairs: Vec<(Expr, Expr)> = own.into_iter().zip(at).collect();
                a.graph.substitute(*value, &pairs)
            }
            _ => return None,
        })
    }

    /// A body that is given by a function, around points of the ground.
    fn wrap(
        &mut self,
        contact: &ContactStated<'r>,
        figure: &Figure,
        middle: Vector,
        ground: &Ground,
        pose: &Pose,
    ) -> Option<Meeting> {
        let around = match ground {
            Ground::Line { head, .. } => *head,
            _ => None,
        };
        let variables = self.variables()?;
        let at = variables.map(|symbol| self.algebra.graph.symbol_expr(symbol));
        let function = figure.outside(&self.algebra, at, around)?;
        let center = pose.point(&self.algebra, middle);
        let (parameters, points) = self.points_of(contact, ground, center)?;
        let a = &self.algebra;
        let rail = match (ground, parameters.first()) {
            (Ground::Line { .. }, Some(own)) => Some(points.map(|e| a.graph.diff(e, own.symbol))),
            _ => None,
        };
        let apart = a.minus(points, pose.position);
        Some(Meeting {
            side: Side::Body,
            function,
            variables,
            argument: a.minus(pose.inward(a, apart), middle),
            parameters,
            rail,
            around,
        })
    }

    /// The points of the ground by their parameters; those along straight lines are counted from the middle of the body.
    fn points_of(
        &mut self,
        contact: &ContactStated<'r>,
        ground: &Ground,
        center: Vector,
    ) -> Option<(Vec<Parameter>, Vector)> {
        let object = &contact.object;
        let own = |end: &str| word(format!("{}_{end}", object.name()), object.place);
        let [(u, u_symbol), (w, w_symbol)] =
            [self.free_symbol("first")?, self.free_symbol("second")?];
        let parameter = |symbol, name, unit| Parameter { symbol, name, unit };
        let (level, up) = (self.level(), self.up_vector());
        let a = &self.algebra;
        let beside = |axis: usize, along: Expr| a.graph.add(&[center[axis], along]);
        Some(match ground {
            Ground::Plane => {
                let mut point = a.zero();
                point[level[0]] = beside(level[0], u);
                point[level[1]] = beside(level[1], w);
                let all = vec![
                    parameter(u_symbol, own("u"), "m"),
                    parameter(w_symbol, own("w"), "m"),
                ];
                (all, point)
            }
            Ground::Line {
                line: Line::Straight { at, axis },
                ..
            } => {
                let mut point = *at;
                point[*axis] = beside(*axis, u);
                (vec![parameter(u_symbol, own("u"), "m")], point)
            }
            Ground::Line {
                line:
                    Line::Curve {
                        points,
                        variable,
                        name,
                    },
                ..
            } => {
                let pairs = [(a.graph.symbol_expr(*variable), u)];
                let point = points.map(|e| a.graph.substitute(e, &pairs));
                // What is a component of the curve itself is a length.
                let is_length = point.iter().any(|e| {
                    let slope = a.graph.diff(*e, u_symbol);
                    !a.graph.is_zero(slope) && a.graph.as_number(slope).is_some()
                });
                let unit = if is_length { "m" } else { "rad" };
                (vec![parameter(u_symbol, name.clone(), unit)], point)
            }
            Ground::Heights {
                height,
                variables,
                names,
            } => {
                let [first, second] = variables.map(|symbol| a.graph.symbol_expr(symbol));
                let height = a.graph.substitute(*height, &[(first, u), (second, w)]);
                let mut point = a.times(height, up);
                point[level[0]] = u;
                point[level[1]] = w;
                let [first, second] = names.clone();
                let all = vec![
                    parameter(u_symbol, first, "m"),
                    parameter(w_symbol, second, "m"),
                ];
                (all, point)
            }
            Ground::Round {
                figure, is_sphere, ..
            } => {
                let (sin, cos) = (a.graph.sin(u), a.graph.cos(u));
                let lowest = |out: Vector| {
                    if figure.is_inside {
                        a.minus(a.zero(), out)
                    } else {
                        out
                    }
                };
                let radius = |v: Vector| a.times(figure.radius, v);
                if *is_sphere {
                    let (sin_w, cos_w) = (a.graph.sin(w), a.graph.cos(w));
                    let mut out = a.times(a.graph.mul(&[cos, cos_w]), lowest(up));
                    out[level[0]] = a.graph.mul(&[sin, cos_w]);
                    out[level[1]] = sin_w;
                    let all = vec![
                        parameter(u_symbol, own("u"), "rad"),
                        parameter(w_symbol, own("w"), "rad"),
                    ];
                    (all, radius(out))
                } else {
                    let axis = figure.axis;
                    let first = if axis == self.up.axis {
                        a.unit(level[0])
                    } else {
                        lowest(up)
                    };
                    let second = if axis == self.up.axis {
                        a.unit(level[1])
                    } else {
                        a.unit(3 - axis - self.up.axis)
                    };
                    let mut point = radius(a.plus(a.times(cos, first), a.times(sin, second)));
                    point[axis] = beside(axis, w);
                    let all = vec![
                        parameter(u_symbol, own("angle"), "rad"),
                        parameter(w_symbol, own("w"), "m"),
                    ];
                    (all, point)
                }
            }
            Ground::Equation { .. } => return None,
        })
    }

    // ---- what follows for the contact

    fn met(
        &mut self,
        contact: &ContactStated<'r>,
        figure: &Figure,
        meeting: &Meeting,
        [free, pose]: [Pose; 2],
        [plane, axes, body]: [FrameId; 3],
        middle: Vector,
    ) -> Curved {
        let object = &contact.object;
        let (name, place) = (object.name().to_owned(), object.place);
        let (solved, open) = self.solve_parameters(meeting);
        let mut actual: Vec<(Expr, Expr)> = free.all().into_iter().zip(pose.all()).collect();
        for parameter in &open {
            let about = format!("point of contact of {}", object.words());
            let own = self.coordinate(&parameter.name, parameter.unit, about);
            actual.push((self.algebra.graph.symbol_expr(parameter.symbol), own));
        }
        for own in solved.iter().rev() {
            let value = self.algebra.graph.substitute(own.value, &actual);
            let value = self.name(&format!("{name}_contact"), value, place);
            actual.push((own.symbol, value));
        }
        let graph = &self.algebra.graph;
        let at = meeting.argument.map(|e| graph.substitute(e, &actual));
        let at = self.name_vector(&format!("{name}_at"), at, place);
        let graph = &self.algebra.graph;
        let variables = meeting.variables.map(|symbol| graph.symbol_expr(symbol));
        let here: Vec<(Expr, Expr)> = variables.into_iter().zip(at).collect();
        let gradient = graph.gradient(meeting.function, &meeting.variables);
        let slopes: Vector = std::array::from_fn(|i| graph.substitute(gradient[i], &here));
        let height = graph.substitute(meeting.function, &here);
        let a = &self.algebra;
        // From the ground to the body, along the axes of the body.
        let outward = match meeting.side {
            Side::Body => a.minus(a.zero(), slopes),
            Side::Ground => pose.inward(a, slopes),
        };
        let steep = a.graph.sqrt(a.dot(outward, outward));
        let steep = self.name(&format!("{name}_steepness"), steep, place);
        let normal = outward.map(|e| self.algebra.graph.div(e, steep));
        let normal = self.name_vector(&format!("{name}_normal"), normal, place);
        let a = &self.algebra;
        let around = meeting.around.unwrap_or(a.graph.zero());
        let point = match meeting.side {
            Side::Body => a.plus(a.plus(middle, at), a.times(around, normal)),
            Side::Ground => {
                let own = pose.inward(a, a.minus(at, pose.position));
                a.minus(own, a.times(around, normal))
            }
        };
        let rail = meeting
            .rail
            .map(|v| pose.inward(a, v.map(|e| a.graph.substitute(e, &actual))));
        let directions = self.tangents(figure, rail, normal, &pose);
        let found = self.slipping([plane, axes, body], middle, point, directions);
        let mut held = vec![Held {
            end: "touch",
            vanishes: height,
            force: outward,
            torque: self.algebra.zero(),
        }];
        for (parameter, end) in open.iter().zip(["opposite_1", "opposite_2"]) {
            let opposite = self.opposite(meeting, parameter, &solved);
            let a = &self.algebra;
            let [force, torque] = free
                .wrench(a, opposite)
                .map(|v| v.map(|e| a.graph.substitute(e, &actual)));
            held.push(Held {
                end,
                vanishes: a.graph.substitute(opposite, &actual),
                force,
                torque: a.minus(torque, a.cross(point, force)),
            });
        }
        self.shared(Curved { found, held }, &name, place)
    }

    /// What is written more than once has a name.
    fn shared(&mut self, curved: Curved, name: &str, place: Place) -> Curved {
        let Curved { found, held } = curved;
        let mut vectors = vec![found.velocities, found.point];
        vectors.extend(found.directions);
        vectors.extend(held.iter().flat_map(|own| [own.force, own.torque]));
        let mut all: Vec<Expr> = vectors.concat();
        all.extend(held.iter().map(|own| own.vanishes));
        let all = self.share(&format!("{name}_part"), &all, place);
        let mut all = all.into_iter();
        let mut next = |usual: Expr| all.next().unwrap_or(usual);
        let mut vector = |usual: Vector| usual.map(&mut next);
        let found = Found {
            velocities: vector(found.velocities),
            point: vector(found.point),
            directions: found.directions.map(&mut vector),
            ..found
        };
        let mut held: Vec<Held> = held
            .into_iter()
            .map(|own| Held {
                force: vector(own.force),
                torque: vector(own.torque),
                ..own
            })
            .collect();
        for own in &mut held {
            own.vanishes = next(own.vanishes);
        }
        Curved { found, held }
    }

    /// Parameters in which the function is of second degree are solved for, one after the other; the others stay.
    fn solve_parameters<'m>(&self, meeting: &'m Meeting) -> (Vec<Settled>, Vec<&'m Parameter>) {
        let graph = &self.algebra.graph;
        let mut value = self.along(meeting);
        let (mut solved, mut open) = (Vec::new(), Vec::new());
        for parameter in &meeting.parameters {
            let own = parameter.symbol;
            let slope = graph.diff(value, own);
            let bend = graph.diff(slope, own);
            if graph.is_zero(bend) || !graph.is_free_of(bend, &|symbol| symbol == own) {
                open.push(parameter);
                continue;
            }
            let symbol = graph.symbol_expr(own);
            let at_zero = graph.substitute(slope, &[(symbol, graph.zero())]);
            let stationary = graph.neg(graph.div(at_zero, bend));
            value = graph.substitute(value, &[(symbol, stationary)]);
            solved.push(Settled {
                symbol,
                value: stationary,
            });
        }
        (solved, open)
    }

    /// The function at the point of the other figure.
    fn along(&self, meeting: &Meeting) -> Expr {
        let graph = &self.algebra.graph;
        let variables = meeting.variables.map(|symbol| graph.symbol_expr(symbol));
        let pairs: Vec<(Expr, Expr)> = variables.into_iter().zip(meeting.argument).collect();
        graph.substitute(meeting.function, &pairs)
    }

    /// The derivative of the function by a parameter, with those that are solved for put in.
    fn opposite(&self, meeting: &Meeting, parameter: &Parameter, solved: &[Settled]) -> Expr {
        let graph = &self.algebra.graph;
        let mut slope = graph.diff(self.along(meeting), parameter.symbol);
        for own in solved {
            slope = graph.substitute(slope, &[(own.symbol, own.value)]);
        }
        slope
    }

    /// Unit tangents along and across: of the rail, of the rim, of the blade, else the level axes turned into the tangent plane.
    fn tangents(
        &self,
        figure: &Figure,
        rail: Option<Vector>,
        normal: Vector,
        pose: &Pose,
    ) -> [Vector; 3] {
        let a = &self.algebra;
        let unit = |v: Vector| {
            let length = a.graph.sqrt(a.dot(v, v));
            v.map(|e| a.graph.div(e, length))
        };
        let forward = match (rail, figure.outline) {
            (Some(rail), _) => unit(rail),
            (None, Outline::Rim | Outline::Torus | Outline::Tapered) => {
                unit(a.cross(a.unit(figure.axis), normal))
            }
            (None, Outline::None) => {
                let side = unit(a.cross(normal, a.unit(figure.axis)));
                a.cross(side, normal)
            }
            _ => {
                let [forward, _] = self.level_tangents(pose.outward(a, normal));
                pose.inward(a, forward)
            }
        };
        [forward, a.cross(normal, forward), normal]
    }

    /// The velocity of the point that touches against the ground; all along the axes of the body that do not spin.
    fn slipping(
        &mut self,
        [plane, axes, body]: [FrameId; 3],
        middle: Vector,
        point: Vector,
        directions: [Vector; 3],
    ) -> Found {
        let rates = self.rates(plane, axes);
        let turning = self.omega_in(plane, axes, body);
        let a = &self.algebra;
        let carried = a.plus(rates.velocity, a.cross(rates.omega, middle));
        let slip = a.plus(carried, a.cross(turning, a.minus(point, middle)));
        let [forward, side, normal] = directions;
        Found {
            velocities: [
                a.dot(slip, forward),
                a.dot(slip, side),
                a.dot(turning, normal),
            ],
            height: a.graph.zero(),
            axes,
            point,
            directions,
        }
    }
}
