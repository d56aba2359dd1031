//! The page as a reader meets it, in headless Chromium: it complains of nothing, asks for
//! nothing, shows its formulas and plots, and answers the hand.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a step that fails fails the test"
)]

mod attack;
mod chromium;
#[path = "../../../examples/demo/disc.rs"]
mod disc;
#[path = "../../../examples/demo/long.rs"]
mod long;
mod names;
#[path = "../../../examples/demo/sleigh.rs"]
mod sleigh;

use chetaev_report::data::{Album, Animation, Formula, Map, Outline, Shown, Table, Tint};
use chetaev_report::{render, Report};
use chromium::{Page, View};

/// A digest of what the animation shows.
const PICTURE: &str = "document.querySelector('#animation canvas').toDataURL()";

fn open(report: &Report) -> Page {
    Page::open(&render(report), &View::default())
}

fn assert_quiet(page: &mut Page) {
    let complaints = page.complaints();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn formulas_and_plots_are_drawn_and_nothing_is_asked_for() {
    let report = sleigh::report();
    let mut page = open(&report);
    page.evaluate("document.querySelectorAll('details').forEach(openUp)");
    page.settle();
    let formulas = page.number("document.querySelectorAll('.equation .formula:has(math)').length");
    let expected: usize = report.sections.iter().map(|s| s.equations.len()).sum();
    assert_eq!(formulas, expected as f64);
    let flat = page.number(
        "[...document.querySelectorAll('math')].filter((m) => {
           const box = m.getBoundingClientRect(); return box.width < 3 || box.height < 6; }).length",
    );
    assert_eq!(flat, 0.0, "formulas without extent");
    // A fraction is higher than a line: MathML is typeset, not shown as a row of letters.
    assert!(page.holds(
        "document.querySelector('mfrac').getBoundingClientRect().height
           > 1.5 * document.querySelector('.equation mfrac mi').getBoundingClientRect().height"
    ));
    // Coordinates, velocities and rates by unit, multipliers, energy, drifts; portraits; figure.
    assert_eq!(
        page.number("document.querySelectorAll('.plot').length"),
        10.0
    );
    let empty = page.number(
        "[...document.querySelectorAll('.plot')].filter((plot) =>
           ![...plot.querySelectorAll('path.curve')].every((path) =>
             path.getAttribute('d').length > 20 && path.getBBox().width > 50)).length",
    );
    assert_eq!(empty, 0.0, "plots without curves");
    assert!(page.holds("!/NaN|undefined|Infinity/.test(document.querySelector('main').innerHTML.split('<script')[0])"));
    assert_quiet(&mut page);
}

#[test]
fn the_slider_moves_the_drawing_and_the_cursors() {
    let mut page = open(&sleigh::report());
    let before = page.text(PICTURE);
    page.evaluate("document.querySelector('[data-plot=\"0\"]').scrollIntoView()");
    page.settle();
    let cursor = "document.querySelector('[data-plot=\"0\"] .cursor').getAttribute('x1')";
    let value = "document.querySelector('[data-plot=\"0\"] button .reading').textContent";
    let (place, reading) = (page.text(cursor), page.text(value));
    page.evaluate(
        "{ const slider = document.querySelector('#time-slider');
           slider.value = 6; slider.dispatchEvent(new Event('input')); }",
    );
    page.settle();
    assert_ne!(page.text(PICTURE), before);
    assert_ne!(page.text(cursor), place);
    assert_ne!(page.text(value), reading);
    // Back at the beginning the picture is the same: it depends on the time alone.
    page.evaluate(
        "{ const slider = document.querySelector('#time-slider');
           slider.value = 0; slider.dispatchEvent(new Event('input')); }",
    );
    page.settle();
    assert_eq!(page.text(PICTURE), before);
    assert_quiet(&mut page);
}

#[test]
fn the_animation_plays_and_keys_step_it() {
    let view = View {
        still: false,
        ..View::default()
    };
    let mut page = Page::open(&render(&sleigh::report()), &view);
    // It starts by itself where the reader does not prefer stillness.
    page.wait_until("clock.time > 0.2");
    page.evaluate("document.querySelector('.play').click()");
    let stopped = page.number("clock.time");
    page.settle();
    assert_eq!(page.number("clock.time"), stopped);
    page.evaluate(
        "document.querySelector('#animation canvas').dispatchEvent(
           new KeyboardEvent('keydown', { key: 'End' }))",
    );
    assert_eq!(page.number("clock.time"), 12.0);
    assert_quiet(&mut page);

    let mut page = open(&sleigh::report());
    page.settle();
    assert_eq!(
        page.number("clock.time"),
        0.0,
        "moves although stillness is preferred"
    );
}

#[test]
fn plots_answer_the_mouse() {
    let mut page = open(&sleigh::report());
    let plot = "[data-plot=\"0\"] svg";
    page.evaluate(&format!(
        "document.querySelector('{plot}').scrollIntoView({{block: 'center'}})"
    ));
    page.settle();
    let position = "document.querySelector('[data-plot=\"0\"] .position').textContent";
    assert_eq!(page.text(position), "");
    page.mouse("mouseMoved", plot, [0.5, 0.5], 0);
    assert!(page.text(position).starts_with("t = "));
    // The event of the run stands in every drawing over the time, with its sentence.
    let event = "document.querySelector('[data-plot=\"0\"] line.event title').textContent";
    assert!(page.text(event).starts_with("event `across`"));

    // Half of a run of 12 s: the middle of the plot, but for the margin of the axis.
    let hovered = page.number("timePlots[0].hovered");
    assert!((5.0..7.0).contains(&hovered), "{hovered}");

    let span = "timePlots.map((plot) => plot.view.x[1] - plot.view.x[0])";
    let widths =
        |page: &mut Page| -> Vec<f64> { serde_json::from_value(page.evaluate(span)).unwrap() };
    assert!(widths(&mut page).iter().all(|width| *width == 12.0));
    page.drag(plot, [0.4, 0.5], [0.6, 0.5]);
    assert!(widths(&mut page)
        .iter()
        .all(|width| (1.5..4.0).contains(width)));
    assert!(page.holds("document.querySelector('[data-plot=\"0\"]').matches('.zoomed')"));
    for clicks in [1, 2] {
        page.mouse("mousePressed", plot, [0.5, 0.5], clicks);
        page.mouse("mouseReleased", plot, [0.5, 0.5], clicks);
    }
    assert!(widths(&mut page).iter().all(|width| *width == 12.0));

    // A click sets the time of the animation; a name switches its curve.
    page.mouse("mousePressed", plot, [0.9, 0.5], 1);
    page.mouse("mouseReleased", plot, [0.9, 0.5], 1);
    assert!(page.number("clock.time") > 9.0);
    page.evaluate("document.querySelector('[data-plot=\"0\"] .legend button').click()");
    assert_eq!(
        page.text("document.querySelector('[data-plot=\"0\"] path.curve').getAttribute('d')"),
        ""
    );
    assert_quiet(&mut page);
}

#[test]
fn a_spatial_picture_turns() {
    let mut page = open(&disc::report());
    let before = page.text(PICTURE);
    page.drag("#animation canvas", [0.4, 0.5], [0.6, 0.6]);
    assert_ne!(page.text(PICTURE), before);
    for clicks in [1, 2] {
        page.mouse("mousePressed", "#animation canvas", [0.5, 0.5], clicks);
        page.mouse("mouseReleased", "#animation canvas", [0.5, 0.5], clicks);
    }
    assert_eq!(page.text(PICTURE), before);
    assert_quiet(&mut page);
}

#[test]
fn claims_open_filter_and_are_found_by_their_id() {
    let mut page = open(&sleigh::report());
    page.evaluate("location.hash = '#formulation.equivalent%23maggi'");
    page.wait_until("document.getElementById('formulation.equivalent#maggi').open");
    page.evaluate("document.querySelector('[data-filter=refuted]').click()");
    let shown = "[...document.querySelectorAll('.claim')].filter((c) => c.checkVisibility()).map((c) => c.id).join()";
    assert_eq!(page.text(shown), "model.constraints-integrable#weak");
    page.evaluate("document.querySelector('[data-filter=\"\"]').click()");
    page.evaluate("document.querySelector('#expand-claims').click()");
    assert!(page.holds("[...document.querySelectorAll('.claim')].every((c) => c.open)"));
    // Every verdict is a word, not a color alone.
    assert!(page.holds(
        "[...document.querySelectorAll('.claim .chip')].every((c) => c.innerText.trim().length > 5)"
    ));
    assert_quiet(&mut page);
}

#[test]
fn what_was_found_stands_before_the_plots_and_leads_to_its_evidence() {
    let mut page = open(&sleigh::report());
    let order = "[...document.querySelectorAll('main > section')].map((s) => s.id).join()";
    assert_eq!(
        page.text(order),
        "found,motion,equations,system,claims,figures,model"
    );
    assert_eq!(
        page.text("document.querySelector('dl.found dd sub').textContent"),
        "blade"
    );
    page.evaluate("document.querySelector('dl.found dt a').click()");
    page.wait_until("document.getElementById('energy.integral').open");
    assert!(page.holds("document.querySelector('#energy\\\\.integral .evidence dl') !== null"));
    assert_quiet(&mut page);
}

#[test]
fn groups_of_claims_are_folded_named_in_the_contents_and_searched() {
    let mut page = open(&sleigh::report());
    assert!(page.holds("[...document.querySelectorAll('.claim-group')].every((g) => !g.open)"));
    let unnamed = "[...document.querySelectorAll('.claim-group')].filter((g) => !document.querySelector(`nav a[href='#${g.id}']`)).length";
    assert_eq!(page.number(unnamed), 0.0);
    // What is folded is no part of the page; the search looks into it.
    assert!(page.holds("document.querySelectorAll('.claim .evidence').length === 0"));
    page.evaluate(
        "{ const search = document.querySelector('#search');
           search.value = 'smooth MEASURE'; search.dispatchEvent(new Event('input')); }",
    );
    let shown = "[...document.querySelectorAll('.claim')].filter((c) => c.checkVisibility()).map((c) => c.id).join()";
    assert_eq!(page.text(shown), "measure.invariant");
    page.evaluate(
        "{ const search = document.querySelector('#search');
           search.value = ''; search.dispatchEvent(new Event('input')); }",
    );
    assert_eq!(
        page.number("document.querySelectorAll('.claim[hidden]').length"),
        0.0
    );
    assert_quiet(&mut page);
}

#[test]
fn a_system_of_equations_is_copied_in_one_go() {
    let mut page = open(&sleigh::report());
    page.evaluate("document.querySelectorAll('details').forEach(openUp)");
    let copied = "asLatex(document.querySelector('.copy-all').closest('.equations'))";
    let latex = page.text(copied);
    assert!(latex.starts_with("\\begin{align}\n  "), "{latex}");
    assert!(latex.ends_with("\n\\end{align}\n"), "{latex}");
    let lines = latex.matches(" &= ").count();
    assert!(
        lines > 1 && latex.matches("\\\\\n").count() + 1 >= lines,
        "{latex}"
    );
}

#[test]
fn no_text_breaks_out_of_its_place() {
    let report = attack::report();
    let mut page = open(&report);
    page.settle();
    assert!(page.holds("window.attacked === undefined"));
    assert_eq!(page.number("document.scripts.length"), 2.0);
    assert_eq!(page.number("document.images.length"), 0.0);
    assert!(page.holds("document.title.includes('<script>')"));
    assert!(page.holds("document.querySelector('h1').textContent.includes('<img src=x')"));
    // What is not a number leaves a gap, and the rest is drawn.
    assert!(page
        .holds("document.querySelector('path.curve').getAttribute('d').match(/M/g).length >= 2"));
    assert_quiet(&mut page);
}

#[test]
fn the_policy_of_the_page_stops_what_is_not_its_own() {
    // Markup that did get in must not act: put into the finished page, past every escape.
    let html = render(&sleigh::report()).replace(
        "</main>",
        "<img src=x onerror='window.attacked = 1'><script>window.attacked = 2</script></main>",
    );
    let mut page = Page::open(&html, &View::default());
    page.settle();
    assert!(page.holds("window.attacked === undefined"));
    assert!(!page.complaints().is_empty());
}

#[test]
fn a_phone_shows_the_page_without_scrolling_sideways() {
    let view = View {
        width: 390,
        dark: true,
        ..View::default()
    };
    let mut report = sleigh::report();
    let unbreakable = Formula {
        mathml: Some(format!("<mi>{}</mi>", "omega".repeat(20))),
        ..Formula::default()
    };
    report.sections[0].equations[0].formula = unbreakable;
    let mut page = Page::open(&render(&report), &view);
    assert_eq!(page.number("document.documentElement.scrollWidth"), 390.0);
    // What cannot be broken scrolls within itself, and the keyboard can reach it.
    assert!(page.holds(
        "[...document.querySelectorAll('.formula')].some((f) => f.scrollWidth > f.clientWidth && f.tabIndex === 0)"
    ));
    let color = "getComputedStyle(document.body).backgroundColor";
    let dark = page.text(color);
    page.evaluate("document.querySelector('#theme').click()");
    assert_ne!(page.text(color), dark);
    assert_quiet(&mut page);
}

#[test]
fn paper_shows_all_evidence() {
    let mut page = open(&sleigh::report());
    page.evaluate(
        "addEventListener('beforeprint', () => setTimeout(() => 0));
         addEventListener('beforeprint', () => { window.closed_ = document.querySelectorAll('details:not([open])').length; })",
    );
    assert!(page.print() > 20_000);
    assert_eq!(page.number("window.closed_"), 0.0);
    // Afterwards the screen is as before.
    assert!(page.number("document.querySelectorAll('details:not([open])').length") > 0.0);
    assert_quiet(&mut page);
}

#[test]
fn an_empty_report_is_a_page() {
    let report = Report {
        title: "Nothing".into(),
        ..Report::default()
    };
    let mut page = open(&report);
    assert_eq!(
        page.number("document.querySelectorAll('figure, canvas, svg').length"),
        0.0
    );
    assert_eq!(
        page.number("document.querySelectorAll('main section').length"),
        0.0
    );
    assert_quiet(&mut page);
}

#[test]
fn a_hundred_thousand_samples_are_drawn_with_what_the_screen_can_show() {
    let mut page = open(&long::report());
    let longest = page.number(
        "Math.max(...[...document.querySelectorAll('[data-plot=\"0\"] path.curve')]
           .map((path) => path.getAttribute('d').length))",
    );
    assert!((1_000.0..60_000.0).contains(&longest), "{longest}");
    // Nothing of the extremes is lost: in each column of the screen the line reaches the lowest
    // and the highest sample, which are found here from all samples.
    let lost = page.number(
        "(() => {
           const [plot] = timePlots;
           const [curve] = plot.curves;
           const columns = new Map();
           curve.x.forEach((x, i) => {
             const [key, y] = [Math.floor(plot.toX(x)), plot.toY(curve.y[i])];
             const column = columns.get(key) ?? [y, y];
             columns.set(key, [Math.min(column[0], y), Math.max(column[1], y)]);
           });
           const points = [...curve.path.getAttribute('d').matchAll(/[ML]([^ ]+) ([^LM]+)/g)]
             .map(([, x, y]) => [Number(x), Number(y)]);
           const reaches = (key, y) => points.some((p) =>
             p[0] > key - 0.5 && p[0] < key + 1.5 && Math.abs(p[1] - y) < 0.6);
           return [...columns].filter(([key, ends]) => !ends.every((y) => reaches(key, y))).length;
         })()",
    );
    assert_eq!(lost, 0.0, "columns without their extremes");
    assert_quiet(&mut page);
}

#[test]
fn long_equations_break_between_terms_on_every_width() {
    for width in [1200, 390] {
        let view = View {
            width,
            ..View::default()
        };
        let mut page = Page::open(&render(&names::report()), &view);
        let overflow = "[...document.querySelectorAll('.formula')].filter((f) => f.scrollWidth > f.clientWidth + 1).length";
        assert_eq!(page.number(overflow), 0.0, "at {width}");
        let lines = page.number(
            "new Set([...document.querySelectorAll('.formula math')].map((m) => Math.round(m.getBoundingClientRect().bottom / 8))).size",
        );
        assert!(lines > 1.0, "one line at {width}");
        assert_quiet(&mut page);
    }
}

#[test]
fn names_are_set_as_mathematics_in_legends_and_axes() {
    let mut page = open(&names::report());
    let legend = "[...document.querySelectorAll('.legend button')].map((b) => b.innerHTML).join()";
    let legends = page.text(legend);
    assert!(legends.contains("<i>φ\u{307}</i>"), "{legends}");
    assert!(legends.contains("<i>λ</i><sub>blade</sub>"), "{legends}");
    assert!(!page.holds("document.querySelector('main').innerText.includes('_{')"));
    assert_quiet(&mut page);
}

#[test]
fn a_drift_is_judged_by_its_claim_and_curves_on_each_other_can_be_told_apart() {
    let mut page = open(&names::report());
    let verdicts =
        "[...document.querySelectorAll('#motion td .chip')].map((c) => c.className).join()";
    assert_eq!(page.text(verdicts), "chip numerical,chip refuted");
    assert!(page.holds(
        "document.querySelector('#claims .detail').textContent.includes('3.9 × 10⁻⁹, bound 10⁻⁸')"
    ));
    let dashes = "new Set([...document.querySelector('[data-plot=\"2\"]').querySelectorAll('svg[role] path.curve')].map((p) => getComputedStyle(p).strokeDasharray)).size";
    assert_eq!(page.number(dashes), 2.0);
    assert_quiet(&mut page);
}

/// Moving pictures under a table: each has a time of its own, the reader chooses one and plays it, and the animation of the motion stands.
#[test]
fn modes_are_chosen_and_played() {
    let mut report = sleigh::report();
    let animation = report.animation.clone().unwrap();
    let mut other = animation.clone();
    other.elements.truncate(1);
    let shown = |name: &str, animation: Animation| Shown {
        name: format!("{name} <b>"),
        explanation: format!("This is {name}."),
        animation,
    };
    report.tables.push(Table {
        id: "steady".into(),
        title: "Steady motions".into(),
        figures: vec![report.figures[0].clone()],
        maps: vec![Map {
            title: "Regions".into(),
            horizontal: ("v".into(), 0.0, 2.0),
            vertical: ("c".into(), 0.0, 1.0),
            columns: 2,
            values: vec![f64::NAN, 1.0, f64::NAN, 3.0],
            absent: Some("stable".into()),
            outlines: vec![Outline {
                name: "a pair passes".into(),
                tint: Tint::Red,
                points: vec![(1.0, 0.0), (1.0, 1.0)],
            }],
            is_unscaled: true,
            ..Map::default()
        }],
        album: Some(Album {
            title: "Modes".into(),
            choice: "Mode".into(),
            pictures: vec![shown("weave", animation), shown("capsize", other)],
            ..Album::default()
        }),
        ..Table::default()
    });
    let mut page = open(&report);
    page.evaluate("document.querySelector('#steady').scrollIntoView()");
    page.settle();
    let options =
        "[...document.querySelectorAll('.album .choice option')].map((o) => o.textContent).join()";
    assert_eq!(page.text(options), "weave <b>,capsize <b>");
    let said = "document.querySelector('.album .hint').textContent";
    assert_eq!(page.text(said), "This is weave.");
    let picture = "document.querySelector('.album canvas').toDataURL()";
    let (before, main) = (page.text(picture), page.number("clock.time"));
    page.evaluate("document.querySelector('.album .play').click()");
    page.wait_until("Number(document.querySelector('.album input[type=range]').value) > 0.2");
    assert_ne!(page.text(picture), before);
    assert_eq!(
        page.number("clock.time"),
        main,
        "the animation of the motion moves"
    );
    page.evaluate(
        "{ const choice = document.querySelector('.album .choice select');
           choice.value = '1'; choice.dispatchEvent(new Event('change')); }",
    );
    assert_eq!(page.text(said), "This is capsize.");
    assert_eq!(
        page.number("document.querySelectorAll('.album canvas').length"),
        1.0
    );
    // It goes on with the other picture, from its beginning.
    page.wait_until(
        "document.querySelector('.album .play').getAttribute('aria-label') === words.pause",
    );
    // The figure stands in the section, and the map has its curve in the middle and its words.
    assert!(page.holds("document.querySelector('#steady .plot path.curve') !== null"));
    let curve = page.text("document.querySelector('.map polyline').getAttribute('points')");
    let across: Vec<&str> = curve.split([' ', ',']).collect();
    assert_eq!((across[0], across[2]), ("292.0", "292.0"), "{curve}");
    assert_eq!(
        page.text("document.querySelector('.map .outlines').textContent"),
        "stablea pair passes"
    );
    assert_eq!(
        page.number("document.querySelectorAll('.map g rect').length"),
        4.0
    );
    assert_quiet(&mut page);
}
