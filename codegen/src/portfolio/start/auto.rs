//! The chain formulas in the regrouping that is cheapest, with the recursion's values
//! at hand.

use dalembert_model::equations::Formulation;
use dalembert_model::outputs::RuntimeParameter;

use super::{Approach, Problem};
use crate::function::Function;
use crate::portfolio::tune::Tuned;
use crate::portfolio::{Form, Source, has_shoulder, regrouped, textbook, tuned, unmoved};
use crate::simplify::WaySource;

/// What is dearer than the cheapest by more than one part in so many before any search
/// is not searched from.
const NEAR: u64 = 8;

pub(super) fn approaches(problem: &Problem<'_>) -> Vec<Approach> {
    let Problem {
        scene_robot,
        function,
        ..
    } = *problem;
    if function == Function::Load {
        let mut definition = textbook(scene_robot, function, Formulation::NewtonEulerLink);
        definition.source = Source::Definition;
        return vec![Approach::of(definition)];
    }
    let mut quantities = function.quantities().iter();
    match quantities.any(|quantity| quantity.is_regrouped()) {
        true => by_chain(problem),
        false => by_textbook(problem),
    }
}

/// Returns what the chain formulas do not give: from the recursion or Lagrange–Euler, whichever
/// is cheaper, and from forms that turn fewer axes or see levers in the joints' axes, each with
/// Lagrange–Euler's values and those of products of axes at hand. These are small, and what is
/// dearer by itself often ends lower: all are searched from.
fn by_textbook(problem: &Problem<'_>) -> Vec<Approach> {
    let textbook = |form| textbook(problem.scene_robot, problem.function, form);
    let recursion = textbook(Formulation::NewtonEulerLink);
    let products = textbook(Formulation::LagrangeEuler);
    let printed = textbook(Formulation::NewtonEulerLinkAsPrinted);
    let helpers = vec![products.graph.clone(), printed.graph.clone()];
    let mut others = vec![
        printed,
        textbook(Formulation::Dalembert),
        textbook(Formulation::NewtonEulerBase),
    ];
    others.retain(|variant| variant.graph != recursion.graph);
    others.dedup_by(|second, first| second.graph == first.graph);
    let others = others.into_iter().map(|variant| Approach {
        others: helpers.clone(),
        ..Approach::of(variant)
    });
    let both = Approach {
        tuned: None,
        variants: vec![recursion, products],
        others: Vec::new(),
    };
    [both].into_iter().chain(others).collect()
}

/// Returns the chain formulas in all of their forms, and C by the h_ikm alone: that is cheapest
/// in another regrouping, and a search that starts there may end lower.
fn by_chain(problem: &Problem<'_>) -> Vec<Approach> {
    let Problem {
        scene_robot,
        function,
        effort,
        without,
        limit,
        from,
        watch,
    } = *problem;
    let has_shoulder = has_shoulder(scene_robot, function);
    let all = function.forms().into_iter();
    let mut families = vec![
        all.filter(|form| has_shoulder || !form.shoulder)
            .collect::<Vec<Form>>(),
    ];
    let symbols = families[0].iter().copied().filter(|form| !form.flows);
    let symbols: Vec<Form> = symbols.collect();
    if symbols.len() < families[0].len() {
        families.push(symbols);
    }
    let tuned = families.iter().map(|forms| match without {
        Some(WaySource::Regrouping) => unmoved(scene_robot, function, forms),
        _ => tuned(scene_robot, function, forms, effort, limit, from, watch),
    });
    let near = near(tuned.collect(), |tuned: &Tuned| tuned.price);
    let approach = |(index, tuned): (usize, Tuned)| {
        // Seen in other axes the hand has hardly a value in common.
        let forms = families[index].iter().copied();
        let forms: Vec<Form> = match without {
            Some(WaySource::Forms) => vec![tuned.form],
            _ => forms.filter(|form| form.hand == tuned.form.hand).collect(),
        };
        let mut variants = regrouped(scene_robot, function, &forms, &tuned.regrouping);
        if without == Some(WaySource::Axes) {
            variants.truncate(forms.len());
        }
        // The textbook recursion gives D column by column and h_ikm by polarisation, with
        // n² of work a link or more: no match.
        let mut quantities = function.quantities().iter();
        // It has no load, but a body in the hand.
        let is_loaded = scene_robot.takes(function, RuntimeParameter::Payload);
        if !is_loaded && quantities.all(|quantity| quantity.starts_from_recursion()) {
            variants.push(textbook(
                scene_robot,
                function,
                Formulation::NewtonEulerLink,
            ));
        }
        Approach {
            tuned: Some(tuned),
            variants,
            others: Vec::new(),
        }
    };
    near.into_iter().map(approach).collect()
}

/// Returns what is about as cheap as the cheapest, each with its index.
fn near<T>(all: Vec<T>, price: impl Fn(&T) -> u64) -> Vec<(usize, T)> {
    let least = all.iter().map(&price).min().unwrap_or(0);
    let most = least.saturating_add(least / NEAR);
    let all = all.into_iter().enumerate();
    all.filter(|(_, one)| price(one) <= most).collect()
}
