//! What a kind of joint is.

/// One motion of a joint, along or about an axis of the joint: 0, 1, 2; backwards where the sign is negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Motion {
    pub(crate) freedom: Freedom,
    pub(crate) axis: usize,
    pub(crate) is_backward: bool,
    /// The end of the coordinate's name where the user gives none.
    pub(crate) word: &'static str,
}

/// Along or about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Freedom {
    /// Along the axis.
    Slide,
    /// About the axis.
    Turn,
}

impl Motion {
    pub(crate) const fn slide(axis: usize, word: &'static str) -> Self {
        Motion {
            freedom: Freedom::Slide,
            axis,
            is_backward: false,
            word,
        }
    }

    pub(crate) const fn turn(axis: usize, word: &'static str) -> Self {
        Motion {
            freedom: Freedom::Turn,
            axis,
            is_backward: false,
            word,
        }
    }

    /// About or along the same axis, backwards where `is_backward` says so.
    pub(crate) const fn directed(self, is_backward: bool) -> Self {
        Motion {
            is_backward,
            ..self
        }
    }
}

/// Which axes the user states for a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// None.
    None,
    /// One, by `axis`.
    One,
    /// A sequence, by `sequence`, of this many axes.
    Sequence(usize),
}

/// An axis of a joint as it is stated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Direction {
    pub(crate) axis: usize,
    pub(crate) is_backward: bool,
}

/// A kind of joint.
pub(crate) struct Joint {
    /// Its word in the model file.
    pub(crate) word: &'static str,
    /// What it is, for menus.
    pub(crate) says: &'static str,
    /// Which axes are stated.
    pub(crate) axes: Axes,
    /// The axes where none is stated; `up` stands for the vertical of a joint that lies flat.
    pub(crate) usual: &'static str,
    /// Its motions, the first one next to the parent, from the axes.
    pub(crate) motions: fn(&[Direction]) -> Vec<Motion>,
}

/// Words of the turns of a sequence: by axis where each occurs once, else after Euler.
pub(super) fn turns(axes: &[Direction]) -> Vec<Motion> {
    const OF_EULER: [&str; 3] = ["precession", "nutation", "rotation"];
    const BY_AXIS: [&str; 3] = ["lean", "pitch", "yaw"];
    let is_repeated = axes.len() == 3 && axes[0].axis == axes[2].axis;
    axes.iter()
        .zip(OF_EULER)
        .map(|(own, euler)| {
            let word = if is_repeated {
                euler
            } else {
                BY_AXIS[own.axis]
            };
            Motion::turn(own.axis, word).directed(own.is_backward)
        })
        .collect()
}
