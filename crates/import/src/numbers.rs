//! Vectors, rotations, and numbers as a person writes them.

use std::f64::consts::PI;

/// Three components.
pub(crate) type Vector = [f64; 3];

/// A rotation by rows: from the axes of a frame to those of the one before it.
pub(crate) type Rotation = [Vector; 3];

/// No rotation.
pub(crate) const STILL: Rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Descriptions give right angles with a few digits; nearer than this an angle is the multiple of π/12.
const NEAR: f64 = 1e-5;

/// Turns one after the other, about the axes 0, 1, 2 of the frame that turns.
pub(crate) fn turned(turns: &[(usize, f64)]) -> Rotation {
    turns.iter().fold(STILL, |own, (axis, angle)| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let (sin, cos) = angle.sin_cos();
        own.map(|row| {
            let mut next = row;
            next[i] = cos * row[i] + sin * row[j];
            next[j] = cos * row[j] - sin * row[i];
            next
        })
    })
}

/// The rotation of a unit quaternion, real part first; that of any length is meant in its direction.
pub(crate) fn of_quaternion(q: [f64; 4]) -> Rotation {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length == 0.0 {
        return STILL;
    }
    let [w, x, y, z] = q.map(|c| c / length);
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

/// The angles about z, y, x, one after the other, that make a rotation.
pub(crate) fn angles(rotation: &Rotation) -> [f64; 3] {
    let sine = (-rotation[2][0]).clamp(-1.0, 1.0);
    let flat = rotation[0][0].hypot(rotation[1][0]);
    if flat < NEAR {
        // The first and the third turn about one axis: the whole angle is the first.
        let about = (-rotation[0][1]).atan2(rotation[1][1]);
        return [about, sine.atan2(flat), 0.0];
    }
    [
        rotation[1][0].atan2(rotation[0][0]),
        sine.atan2(flat),
        rotation[2][1].atan2(rotation[2][2]),
    ]
}

/// v in the axes before the rotation.
pub(crate) fn image(rotation: &Rotation, v: Vector) -> Vector {
    rotation.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// One rotation after another: v in the axes before both.
pub(crate) fn after(first: &Rotation, second: &Rotation) -> Rotation {
    let columns = transposed(second);
    first.map(|row| columns.map(|column| (0..3).map(|i| row[i] * column[i]).sum()))
}

/// The rotation backwards.
pub(crate) fn transposed(rotation: &Rotation) -> Rotation {
    std::array::from_fn(|i| std::array::from_fn(|j| rotation[j][i]))
}

/// The coordinate axis that a direction is, 0, 1 or 2, and whether it points backwards.
pub(crate) fn coordinate_axis(v: Vector) -> Option<(usize, bool)> {
    let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let axis = (0..3).find(|&i| v[i].abs() >= size * (1.0 - NEAR * NEAR) && size > 0.0)?;
    Some((axis, v[axis] < 0.0))
}

/// The turns about z and y that bring the third axis into a direction.
pub(crate) fn towards(v: Vector) -> [f64; 2] {
    [v[1].atan2(v[0]), v[0].hypot(v[1]).atan2(v[2])]
}

/// A number in the fewest digits that read back as it, without the rounding of sines.
pub(crate) fn decimal(x: f64) -> String {
    let rounded = format!("{x:.12}").parse::<f64>().unwrap_or(x);
    let near = if (x - rounded).abs() <= 4.0 * f64::EPSILON * x.abs() || x.abs() < 1e-14 {
        rounded
    } else {
        x
    };
    if near == 0.0 {
        return "0".to_owned();
    }
    format!("{near:?}").trim_end_matches(".0").to_owned()
}

/// An angle as TOML: a multiple of π/12 exactly, as a text.
pub(crate) fn angle(x: f64) -> String {
    let twelfths = (x * 12.0 / PI).round();
    if twelfths == 0.0 && x.abs() < NEAR {
        return "0".to_owned();
    }
    if twelfths == 0.0 || (x - twelfths * PI / 12.0).abs() >= NEAR || twelfths.abs() > 48.0 {
        return decimal(x);
    }
    let common = (1..=12)
        .rev()
        .find(|n| twelfths % f64::from(*n) == 0.0 && 12 % n == 0);
    let common = common.unwrap_or(1);
    let (above, below) = (twelfths / f64::from(common), 12 / common);
    let above = match above {
        1.0 => "pi".to_owned(),
        -1.0 => "-pi".to_owned(),
        above => format!("{above} pi"),
    };
    match below {
        1 => format!("\"{above}\""),
        below => format!("\"{above}/{below}\""),
    }
}

/// Whether an angle is written as a multiple of π although it was given by other digits.
pub(crate) fn is_rounded(x: f64) -> bool {
    let exact = (x * 12.0 / PI).round() * PI / 12.0;
    angle(x).contains("pi") && (x - exact).abs() > 1e-12
}
