//! What a function's search starts from.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::Regrouping;
use dalembert_model::number::Exact;
use dalembert_model::outputs::RuntimeParameter;

use crate::function::Function;
use crate::portfolio::tune::Tuned;
use crate::portfolio::{self, Limit, Source, Variant};
use crate::scene::Setting;
use crate::simplify::Effort;
use crate::watch::FunctionWatch;

/// Which formulation a function starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Start {
    /// The cheapest, with the others' values at hand.
    #[default]
    Auto,
    /// As [`Start::Auto`], where the sines and cosines of angle sums of
    /// parallel joints may be evaluated instead of formed: fewer operations,
    /// a pair more, and an error of |q| u in the sum.
    AngleSums,
    /// One only.
    Only(Formulation),
}

impl Start {
    /// The choices of the command line and the macro.
    pub const NAMES: [&'static str; 5] = [
        "auto",
        "angle_sums",
        "lagrange_euler",
        "dalembert",
        "newton_euler",
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Start::Auto => "auto",
            Start::AngleSums => "angle_sums",
            Start::Only(formulation) => Source::Textbook(formulation).name(),
        }
    }

    /// The choice of a name.
    pub fn from_name(name: &str) -> Option<Start> {
        Some(match name {
            "auto" => Start::Auto,
            "angle_sums" => Start::AngleSums,
            "lagrange_euler" => Start::Only(Formulation::LagrangeEuler),
            "dalembert" => Start::Only(Formulation::Dalembert),
            "newton_euler" => Start::Only(Formulation::NewtonEulerLink),
            _ => return None,
        })
    }

    /// The graphs to start from.
    pub(crate) fn variants(
        self,
        setting: &Setting,
        function: Function,
        effort: Effort,
        limit: Option<Limit<'_>>,
        from: &[Regrouping<Exact>],
        watch: Option<FunctionWatch<'_>>,
    ) -> (Option<Tuned>, Vec<Variant>) {
        match self {
            Start::Only(formulation) => {
                let variant = portfolio::textbook(setting, function, formulation);
                (None, vec![variant])
            }
            Start::Auto | Start::AngleSums if function == Function::Load => {
                let mut definition =
                    portfolio::textbook(setting, function, Formulation::NewtonEulerLink);
                definition.source = Source::Definition;
                (None, vec![definition])
            }
            Start::Auto | Start::AngleSums => {
                let mut quantities = function.quantities().iter();
                if !quantities.any(|quantity| quantity.is_regrouped()) {
                    let forms = [Formulation::NewtonEulerLink, Formulation::LagrangeEuler];
                    let variants = forms.map(|f| portfolio::textbook(setting, function, f));
                    return (None, variants.into());
                }
                let tuned = portfolio::tuned(setting, function, effort, limit, from, watch);
                let mut variants = portfolio::regrouped(setting, function, &tuned.regrouping);
                // The textbook recursion gives D column by column and h_ikm
                // by polarisation, with n² of work a link or more: no match.
                let mut quantities = function.quantities().iter();
                // It has no load, but a body in the hand.
                let is_loaded = setting.takes(function, RuntimeParameter::Payload);
                if !is_loaded && quantities.all(|quantity| quantity.starts_from_recursion()) {
                    let recursion = Formulation::NewtonEulerLink;
                    variants.push(portfolio::textbook(setting, function, recursion));
                }
                (Some(tuned), variants)
            }
        }
    }
}
