//! Lyapunov's first method (Lyapunov 1892), and the theorem of Lyapunov and Malkin on families of steady motions (Malkin 1952).

use crate::about::About;
use crate::evidence::unstable;
use crate::question::Place;
use crate::theorem::{Answer, Instability, Method};
use dashu_ratio::RBig;

/// Eigenvalues decide where one lies right of the axis, or all but those of the family lie left of it.
pub(crate) struct FirstApproximation;

impl Method for FirstApproximation {
    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        match place {
            Place::Right => {
                let found = unstable(about, at);
                Answer::Unstable(Instability {
                    quantity: found.quantity,
                    bounds: found.residual,
                    why: found.detail,
                })
            }
            Place::Left if about.question.linear.family > 0 && about.expansion.has_corner() => {
                Answer::Open("the theorem of Lyapunov and Malkin asks for smooth equations, and these have a corner at the motion".into())
            }
            Place::Left => Answer::Stable(match about.question.linear.family {
                0 => "by Lyapunov's first method: all eigenvalues lie left of the axis, and the motion is asymptotically stable".into(),
                n => format!("by the theorem of Lyapunov and Malkin: all eigenvalues but the {n} of the family of steady motions lie left of the axis, so that the motion is stable and its neighbours tend to members of the family"),
            }),
            Place::OnAxis | Place::NotLeft => Answer::NotApplicable,
        }
    }
}
