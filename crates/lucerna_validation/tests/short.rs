//! The short form of the experiments: what it prints is what `lucerna validate` tells.

use std::ops::ControlFlow;

use lucerna_validation::{Allowed, EXPERIMENTS, Effort, Entry, Experiment, Outcome, ValidationError, page, table};

#[test]
fn fire_obeys_what_its_short_form_can_tell() {
    for experiment in EXPERIMENTS.iter().filter(|experiment| experiment.short.is_some()) {
        let outcome = experiment.run(Effort::Short, &mut |_| ControlFlow::Continue(())).unwrap();
        print!("{}", table(&Entry { experiment, outcome: &outcome }));
        assert!(outcome.cells > 0 && outcome.cell_steps > 0 && !outcome.figures.is_empty(), "{}", experiment.name);
        // Grids are too coarse for the laws themselves: no figure may be far from them.
        for figure in outcome.figures.iter().filter(|figure| figure.allowed != Allowed::Any) {
            assert!((figure.found / figure.published - 1.0).abs() < 0.4, "{}: {figure:?}", experiment.name);
        }
    }
}

#[test]
fn experiments_can_be_stopped_and_tell_how_far_they_are() {
    let experiment = Experiment::named("rising_wave").unwrap();
    let mut shares = Vec::new();
    let stopped = experiment.run(Effort::Short, &mut |share| {
        shares.push(share);
        if share < 0.4 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert!(matches!(stopped, Err(ValidationError::Stopped { name: "rising_wave" })));
    assert!(shares.len() > 2 && shares[0] == 0.0 && shares.is_sorted() && shares.iter().all(|share| *share < 1.0));
}

#[test]
fn the_same_experiment_finds_the_same_twice_and_its_page_tells_it() {
    let experiment = Experiment::named("rising_wave").unwrap();
    let run = || experiment.run(Effort::Short, &mut |_| ControlFlow::Continue(())).unwrap();
    let (outcome, again) = (run(), run());
    assert!(outcome.holds(), "{:?}", outcome.figures);
    assert_eq!(outcome.figures, again.figures);
    let text = page(&[Entry { experiment, outcome: &outcome }], "plots");
    for figure in &outcome.figures {
        assert!(text.contains(&format!("| {} | {} |", figure.what, figure.found())), "{text}");
    }
    assert!(text.contains("](plots/rising_wave.svg)") && text.contains("emergent"));
    let kept = Outcome::from_record(&outcome.record()).unwrap();
    assert_eq!(page(&[Entry { experiment, outcome: &kept }], "plots"), text);
    assert!(Outcome::from_record("(figures: 3)").is_err());
}
