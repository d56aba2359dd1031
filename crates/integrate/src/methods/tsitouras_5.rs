//! The pair of orders 5(4) of Tsitouras with its free dense output of order 4.
//!
//! Source: Tsitouras 2011, Comput. Math. Appl. 62, 770–775, table 1 and the interpolant after it. The interpolant
//! meets value and slope at both ends, so only its quartic part needs weights: the leading coefficients of the
//! polynomials b_i(θ) of the paper.

// The source gives up to twenty digits; they are kept so that the table can be compared with it.
#![allow(clippy::excessive_precision)]

use super::explicit_runge_kutta::{ErrorEstimate, ExplicitRungeKutta, Tableau};
use crate::method::MethodCard;

/// Tsitouras 5(4), seven stages, the last of which is the first of the next step.
pub static TSITOURAS_5: ExplicitRungeKutta = ExplicitRungeKutta {
    card: MethodCard {
        name: "tsitouras-5",
        title: "Tsitouras 5(4), explicit Runge–Kutta of order 5",
        order: 5,
        dense_order: 4,
        adaptive: true,
        least_tolerance: 100.0 * f64::EPSILON,
        needs_series: false,
        source: "Tsitouras 2011",
    },
    tableau: Tableau {
        c: &[0.0, 0.161, 0.327, 0.9, 0.9800255409045097, 1.0, 1.0],
        a: &[
            &[],
            &[(0, 0.161)],
            &[(0, -0.008480655492356989), (1, 0.335480655492357)],
            &[
                (0, 2.8971530571054935),
                (1, -6.359448489975075),
                (2, 4.3622954328695815),
            ],
            &[
                (0, 5.325864828439257),
                (1, -11.748883564062828),
                (2, 7.4955393428898365),
                (3, -0.09249506636175525),
            ],
            &[
                (0, 5.86145544294642),
                (1, -12.92096931784711),
                (2, 8.159367898576159),
                (3, -0.071584973281401),
                (4, -0.028269050394068383),
            ],
        ],
        b: &[
            (0, 0.09646076681806523),
            (1, 0.01),
            (2, 0.4798896504144996),
            (3, 1.379008574103742),
            (4, -3.290069515436081),
            (5, 2.324710524099774),
        ],
        error: ErrorEstimate::Embedded(&[
            (0, -0.00178001105222577714),
            (1, -0.0008164344596567469),
            (2, 0.007880878010261995),
            (3, -0.1447110071732629),
            (4, 0.5823571654525552),
            (5, -0.45808210592918697),
            (6, 1.0 / 66.0),
        ]),
        q: 5.0,
        extra: &[],
        dense: &[&[
            (0, -1.0530884977290216),
            (1, 0.1017),
            (2, 2.490627285651252793),
            (3, -16.54810288924490272),
            (4, 47.37952196281928122),
            (5, -34.87065786149660974),
            (6, 2.5),
        ]],
        stability_bound: 3.3,
    },
};
