//! Every word of the page that does not come from the data. A second language is a second table.
//!
//! `{}` in an entry stands for the values that the page fills in, in their order.

use serde::Serialize;

use crate::data::{Origin, SeriesGroup, Verdict};

/// Languages a page can be written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Language {
    /// English.
    #[default]
    English,
}

impl Language {
    pub(crate) fn words(self) -> &'static Words {
        match self {
            Language::English => &ENGLISH,
        }
    }

    /// The title of the claims of a part of the theory, by the word before the dot of their ids.
    pub fn title_of_claims(self, part: &str) -> Option<&'static str> {
        look_up(self.words().groups, &part)
    }
}

/// The words of the static part of the page.
pub(crate) struct Words {
    /// BCP 47 tag.
    pub(crate) language: &'static str,
    pub(crate) contents: &'static str,
    pub(crate) skip: &'static str,
    pub(crate) theme: &'static str,
    pub(crate) notices: &'static str,
    pub(crate) no_script: &'static str,

    pub(crate) found: &'static str,

    pub(crate) system: &'static str,
    pub(crate) history: &'static str,
    pub(crate) sources: &'static str,
    pub(crate) parameters: &'static str,
    pub(crate) parameter: &'static str,
    pub(crate) value: &'static str,
    pub(crate) range: &'static str,
    pub(crate) meaning: &'static str,
    pub(crate) assumptions: &'static str,
    pub(crate) initial: &'static str,
    pub(crate) quantity: &'static str,
    pub(crate) origin: &'static str,
    pub(crate) origins: [(Origin, &'static str); 3],

    pub(crate) equations: &'static str,
    pub(crate) formulation: &'static str,
    pub(crate) where_: &'static str,
    pub(crate) proved_by: &'static str,
    pub(crate) copy_latex: &'static str,
    pub(crate) copy_all_latex: &'static str,
    pub(crate) equation_number: &'static str,

    pub(crate) claims: &'static str,
    pub(crate) claims_lead: &'static str,
    pub(crate) claim_count: &'static str,
    pub(crate) show_all: &'static str,
    pub(crate) filter: &'static str,
    pub(crate) search: &'static str,
    pub(crate) shared: &'static str,
    pub(crate) expand: &'static str,
    pub(crate) link_to_claim: &'static str,
    pub(crate) method: &'static str,
    pub(crate) computed: &'static str,
    pub(crate) on: &'static str,
    pub(crate) error_bound: &'static str,
    pub(crate) samples: &'static str,
    pub(crate) seed: &'static str,
    pub(crate) residual: &'static str,
    pub(crate) counterexample: &'static str,
    pub(crate) condition: &'static str,
    pub(crate) failing_hypothesis: &'static str,
    pub(crate) requires: &'static str,
    pub(crate) time_spent: &'static str,
    pub(crate) expected: &'static str,
    pub(crate) as_expected: &'static str,
    pub(crate) not_as_expected: &'static str,
    pub(crate) seconds: &'static str,
    pub(crate) verdicts: [(Verdict, VerdictWords); 6],
    pub(crate) groups: &'static [(&'static str, &'static str)],
    /// What a group of claims is about.
    pub(crate) leads: &'static [(&'static str, &'static str)],

    pub(crate) motion: &'static str,
    pub(crate) stopped_early: &'static str,
    pub(crate) stopped_expected: &'static str,
    pub(crate) statistics: &'static str,
    pub(crate) chart_switches: &'static str,
    pub(crate) events: &'static str,
    pub(crate) conserved: &'static str,
    pub(crate) conserved_quantity: &'static str,
    pub(crate) at_start: &'static str,
    pub(crate) largest_drift: &'static str,
    pub(crate) enforced: &'static str,
    pub(crate) unprinted: &'static str,
    pub(crate) drift_table: &'static str,
    pub(crate) largest: &'static str,
    pub(crate) tolerance: &'static str,
    pub(crate) within: &'static str,
    pub(crate) exceeded: &'static str,
    pub(crate) some_curves: &'static str,
    pub(crate) more_rows: &'static str,
    pub(crate) portraits: &'static str,
    pub(crate) portrait: &'static str,
    pub(crate) plots_hint: &'static str,
    pub(crate) full_data: &'static str,
    pub(crate) figures: &'static str,
    /// Under a drawing of two curves.
    pub(crate) both_curves: &'static str,
    pub(crate) series_groups: [(SeriesGroup, &'static str); 9],

    pub(crate) animation: &'static str,
    pub(crate) model: &'static str,
    pub(crate) model_lead: &'static str,
    pub(crate) overrides: &'static str,
    pub(crate) copy_file: &'static str,
    pub(crate) lines: &'static str,
    pub(crate) reproduce: &'static str,
    pub(crate) copy_command: &'static str,
    pub(crate) version: &'static str,
    pub(crate) made_by: &'static str,

    /// The words of the moving part of the page.
    pub(crate) script: ScriptWords,
}

/// A verdict in words.
#[derive(Clone, Copy)]
pub(crate) struct VerdictWords {
    pub(crate) name: &'static str,
    /// What the verdict means.
    pub(crate) meaning: &'static str,
}

/// The words that the script of the page needs.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct ScriptWords {
    pub(crate) play: &'static str,
    pub(crate) pause: &'static str,
    pub(crate) restart: &'static str,
    pub(crate) speed: &'static str,
    pub(crate) time: &'static str,
    pub(crate) follow: &'static str,
    pub(crate) repeat: &'static str,
    pub(crate) ghosts: &'static str,
    pub(crate) film: &'static str,
    pub(crate) reset_view: &'static str,
    pub(crate) copied: &'static str,
    pub(crate) copy_failed: &'static str,
    pub(crate) show_series: &'static str,
    pub(crate) plot_label: &'static str,
    pub(crate) tolerance: &'static str,
    pub(crate) log_scale: &'static str,
    pub(crate) identically_zero: &'static str,
    pub(crate) start: &'static str,
    pub(crate) reset_zoom: &'static str,
    pub(crate) hint_planar: &'static str,
    pub(crate) hint_spatial: &'static str,
    pub(crate) theme_light: &'static str,
    pub(crate) theme_dark: &'static str,
    pub(crate) switch_at: &'static str,
    pub(crate) collapse: &'static str,
    pub(crate) expand: &'static str,
}

/// A template with its places filled in.
pub(crate) fn fill(template: &str, values: &[&str]) -> String {
    let mut out = String::new();
    let mut values = values.iter();
    let mut parts = template.split("{}");
    out.push_str(parts.next().unwrap_or_default());
    for part in parts {
        out.push_str(values.next().copied().unwrap_or_default());
        out.push_str(part);
    }
    out
}

/// The word that a table has for a key; the tables list every key.
pub(crate) fn look_up<K: PartialEq, V: Copy>(table: &[(K, V)], key: &K) -> Option<V> {
    table.iter().find(|(k, _)| k == key).map(|(_, v)| *v)
}

static ENGLISH: Words = Words {
    language: "en",
    contents: "Contents",
    skip: "Skip to the content",
    theme: "Change between light and dark",
    notices: "Please note",
    no_script: "Plots and the animation are drawn by a script, which is switched off here.",

    found: "What was found",

    system: "The system",
    history: "History",
    sources: "Sources",
    parameters: "Parameters",
    parameter: "Parameter",
    value: "Value",
    range: "Range",
    meaning: "Meaning",
    assumptions: "Assumptions",
    initial: "Initial state",
    quantity: "Quantity",
    origin: "Origin",
    origins: [
        (Origin::Given, "given"),
        (Origin::Default, "zero unless stated"),
        (Origin::Projected, "completed by projection"),
    ],

    equations: "Equations",
    formulation: "Formulation",
    where_: "where",
    proved_by: "Evidence",
    copy_latex: "LaTeX",
    copy_all_latex: "Copy all as LaTeX",
    equation_number: "Copy equation ({}) as LaTeX",

    claims: "Claims",
    claims_lead: "Everything that was decided about this system. Open a group, and in it a line to see the evidence.",
    claim_count: "{} claims",
    show_all: "all",
    filter: "Show claims by verdict",
    search: "Search the claims",
    shared: "Of {} claims below: {}.",
    expand: "Show all evidence",
    link_to_claim: "Link to this claim",
    method: "Method",
    computed: "How it was computed",
    on: "Where it holds",
    error_bound: "Probability of error",
    samples: "Samples",
    seed: "Seed",
    residual: "Largest scaled residual",
    counterexample: "Counterexample",
    condition: "Exactly where",
    failing_hypothesis: "Hypothesis that fails",
    requires: "Rests on",
    time_spent: "Time spent",
    expected: "Expected by the model",
    as_expected: "{}, as found",
    not_as_expected: "{}, which is not what was found",
    seconds: "{} s",
    verdicts: [
        (
            Verdict::Proved,
            VerdictWords {
                name: "proved",
                meaning: "holds, with a proof",
            },
        ),
        (
            Verdict::Numerical,
            VerdictWords {
                name: "numerical",
                meaning: "holds at every sample, without a proof",
            },
        ),
        (
            Verdict::Refuted,
            VerdictWords {
                name: "refuted",
                meaning: "fails at a verified counterexample",
            },
        ),
        (
            Verdict::Conditional,
            VerdictWords {
                name: "conditional",
                meaning: "holds exactly on a stated subset",
            },
        ),
        (
            Verdict::NotApplicable,
            VerdictWords {
                name: "not applicable",
                meaning: "a hypothesis fails",
            },
        ),
        (
            Verdict::Undecided,
            VerdictWords {
                name: "undecided",
                meaning: "no answer within the budget",
            },
        ),
    ],
    groups: &[
        ("model", "The model"),
        ("formulation", "Equations of motion"),
        ("variation", "Variations of the constraints"),
        ("hamilton", "Hamilton’s principle"),
        ("energy", "Energy"),
        ("action", "Least action"),
        ("hamilton-jacobi", "Hamilton–Jacobi method"),
        ("chaplygin", "Chaplygin’s multiplier"),
        ("second-kind", "Principles of the second kind"),
        ("universal-relation", "Relations of the variations"),
        ("witness", "Numbers as a witness"),
        ("frame", "Moving frames"),
        ("cartan", "Cartan forms"),
        ("noether", "First integrals and symmetries"),
        ("distribution", "What can be reached"),
        ("liouville", "Integrability by quadratures"),
        ("measure", "Invariant measure"),
        ("functional", "Functionals"),
        ("motion", "The computed motion"),
        ("equilibrium", "States of rest"),
        ("steady", "Steady motions"),
        ("stability", "Stability"),
        ("order", "Constraints of higher order"),
        ("mass", "Variable mass"),
        ("equations", "Equations that the model states"),
    ],
    leads: &[
        ("variation", "Virtual displacements satisfy Σ ∂f/∂v δq = 0. What δv is has to be agreed upon: δv = D(δq) for all velocities (Hölder), or for the independent ones with δf = 0 (Suslov)."),
        ("hamilton", "Four forms of one principle, each with virtual δq that vanish at the ends: what stands under the integral for this system, what is substituted, and the equations that follow. Then whether the principle says that the action is stationary."),
        ("action", "The times vary too: Δq = δq + v Δt, Δv = D(Δq) − v D(Δt). At fixed energy this gives least action in the forms of Lagrange and Jacobi."),
        ("hamilton-jacobi", "With π = p + Σ κ ∂f/∂v and H₁ = Σ π v − L the equation S_t + H₁(q, S_q, t) = 0 integrates those motions that make the action stationary."),
        ("second-kind", "q and v are varied independently: with Z = L + Σ (Dq − v) ∂L/∂v the principle gives Dq = v besides the equations of motion."),
        ("universal-relation", "Where Dq = v on the true path δv cancels, and any linear relation δv = A(δq) may be imposed."),
        ("witness", "Integrals over the computed motion: numbers, independent of the proofs."),
    ],

    motion: "Motion",
    stopped_early: "The run stopped early",
    stopped_expected: "The run stopped early, as the model expects",
    statistics: "The run",
    chart_switches: "Changes of the independent velocities",
    events: "Events",
    conserved: "Integrals along the motion",
    conserved_quantity: "Integral, and what it belongs to",
    at_start: "Value at the start",
    largest_drift: "Largest drift",
    enforced: "kept by projection, no evidence",
    unprinted: "a formula that is too long to be read",
    drift_table: "Largest drift",
    largest: "Largest magnitude",
    tolerance: "Bound",
    within: "within",
    exceeded: "exceeded",
    some_curves: "The first {} of {} curves; the files with the full data have all.",
    more_rows: "and {} more",
    portraits: "Phase portraits",
    portrait: "{} against {}",
    plots_hint: "Point at a plot to read values, drag to zoom, double-click to return, click to set the time of the animation. The wheel zooms a plot after a click into it, or with Ctrl.",
    full_data: "Full data",
    figures: "Figures",
    both_curves: "Both paths, from the start that a ring marks.",
    series_groups: [
        (SeriesGroup::Coordinates, "Coordinates"),
        (SeriesGroup::Velocities, "Velocities"),
        (SeriesGroup::Accelerations, "Accelerations"),
        (SeriesGroup::Multipliers, "Multipliers and reactions"),
        (SeriesGroup::Energy, "Energy"),
        (SeriesGroup::Integrals, "Integrals"),
        (SeriesGroup::Drifts, "Drift"),
        (SeriesGroup::Errors, "Estimated error"),
        (SeriesGroup::Other, "Further quantities"),
    ],

    animation: "The motion as a moving picture",
    model: "Model file",
    model_lead: "The text this report was made from.",
    overrides: "Changed on the command line",
    copy_file: "Copy",
    lines: "{} lines",
    reproduce: "How to get this report again",
    copy_command: "Copy",
    version: "Version",
    made_by: "Made by Chetaev. This page is one file and works offline.",

    script: ScriptWords {
        play: "Play",
        pause: "Pause",
        restart: "To the beginning",
        speed: "Speed",
        time: "Time",
        follow: "Follow",
        repeat: "Repeat",
        ghosts: "Ghosts",
        film: "Film",
        reset_view: "Reset view",
        copied: "copied",
        copy_failed: "not copied",
        show_series: "Show or hide {}",
        plot_label: "Plot of {} against {}. Arrow keys move the cursor, plus and minus zoom, 0 resets.",
        tolerance: "bound",
        log_scale: "log scale",
        identically_zero: "zero throughout",
        start: "start",
        reset_zoom: "Reset zoom",
        hint_planar: "Drag to move, wheel after a click to zoom, double-click to return. Space plays, arrows step.",
        hint_spatial: "Drag to turn, with Shift to move, wheel after a click to zoom, double-click to return. Space plays, arrows step.",
        theme_light: "Light",
        theme_dark: "Dark",
        switch_at: "change of chart at {}",
        collapse: "Hide evidence",
        expand: "Show all evidence",
    },
};

#[cfg(test)]
mod tests {
    use super::{fill, look_up, ENGLISH};
    use crate::data::Verdict;

    #[test]
    fn places_are_filled_in_order() {
        assert_eq!(fill("{} against {}!", &["x", "{}"]), "x against {}!");
        assert_eq!(fill("{} and {}", &["x"]), "x and ");
    }

    #[test]
    fn every_verdict_has_its_own_word() {
        let mut names: Vec<_> = Verdict::ALL
            .iter()
            .filter_map(|verdict| look_up(&ENGLISH.verdicts, verdict))
            .map(|words| words.name)
            .collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), 6);
    }
}
