//! The macro behind the list of outputs: two enumerations and the one place where their members are
//! told apart. `load` comes along with others, and is not asked for by itself.

/// A row an output: its name and its name in Rust, the file of the quantities that are its own,
/// a line for its documentation, here and in generated code, and what differs from
/// [`Definition::of`](function::Definition::of).
macro_rules! registry {
    (
        $(
            $name:ident: $function:ident { $($file:ident: $($quantity:ident),+)? }
            $summary:literal $(, $field:ident: $value:expr)*;
        )*
    ) => {
        /// A function that can be generated: one of the list, several in one, or one at a frame.
        ///
        /// ```
        /// use dalembert_model::outputs::Function;
        ///
        /// let torques = Function::parse("inverse_dynamics")?;
        /// assert_eq!(torques, Function::InverseDynamics);
        /// assert_eq!(Function::parse("torque=inverse_dynamics+gravity")?.name(), "torque");
        /// # Ok::<(), dalembert_model::diagnostic::Diagnostic>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Function {
            $(#[doc = $summary] $function,)*
            /// The regrouped parameters of the arm with a payload.
            Load,
            /// Several of these in one, by a name of the user's.
            Bundle(NamedFunction),
            /// One of these at a frame.
            At(NamedFunction),
        }

        /// A quantity that a function returns.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Quantity {
            $($($(
                #[doc = concat!("Of [`Function::", stringify!($function), "`].")]
                $quantity,
            )+)?)*
            /// The result of [`Function::Load`].
            Load,
            /// One of these at a frame.
            At(at::QuantityAt),
        }

        impl Function {
            /// Every function that can be asked for by its name alone, in the order of files.
            pub const ALL: [Function; [$(Function::$function),*].len()] = [$(Function::$function),*];

            pub(in crate::outputs) fn definition(self) -> &'static function::Definition {
                match self {
                    $(Function::$function => const {
                        &function::Definition {
                            $($field: $value,)*
                            ..function::Definition::of(
                                stringify!($name),
                                stringify!($function),
                                $summary,
                                &[$($(Quantity::$quantity),+)?],
                            )
                        }
                    },)*
                    Function::Load => const {
                        &function::Definition::of(
                            "load",
                            "Load",
                            "Load: the regrouped parameters of its arguments, once for each set of them.",
                            &[Quantity::Load],
                        )
                    },
                    Function::Bundle(made) | Function::At(made) => made.0,
                }
            }
        }

        impl Quantity {
            /// Every quantity of a function that can be asked for, in the order of these.
            pub const ALL: &[Quantity] = &[$($($(Quantity::$quantity,)+)?)*];

            /// Returns its facts.
            pub fn facts(self) -> &'static quantity::Facts {
                match self {
                    $($($(Quantity::$quantity => &$file::$quantity::FACTS,)+)?)*
                    Quantity::Load => &argument::Load::FACTS,
                    Quantity::At(at) => at.facts(),
                }
            }

            /// Returns the function that defines it, of the hand, where others may return it too.
            pub fn function(self) -> Function {
                match self {
                    $($($(Quantity::$quantity => Function::$function,)+)?)*
                    Quantity::Load => Function::Load,
                    Quantity::At(at) => at.quantity().function(),
                }
            }

            /// Returns its entries by a textbook formulation, flat, row by row.
            pub fn written<S: Divide>(self, at: &Written<'_, S>) -> Vec<S> {
                match self {
                    $($($(Quantity::$quantity => $file::$quantity::written(at),)+)?)*
                    Quantity::Load => argument::Load::written(at),
                    Quantity::At(framed) => framed.of_frame(at, |quantity, at| quantity.written(at)),
                }
            }

            /// Returns its entries over the chain's joints by its formulas, if these give it.
            pub fn regrouped<S: Divide>(self, at: &Regrouped<'_, S>) -> Option<Vec<S>> {
                match self {
                    $($($(Quantity::$quantity => $file::$quantity::regrouped(at),)+)?)*
                    Quantity::Load => argument::Load::regrouped(at),
                    Quantity::At(framed) => framed.regrouped(at),
                }
            }

            /// Returns the residuals of the equation that these entries over all joints solve, if any.
            pub fn residual<S: Divide>(self, at: &Written<'_, S>, values: &[S]) -> Vec<S> {
                match self {
                    $($($(Quantity::$quantity => $file::$quantity::residual(at, values),)+)?)*
                    Quantity::Load => argument::Load::residual(at, values),
                    Quantity::At(framed) => framed.of_frame(at, |quantity, at| quantity.residual(at, values)),
                }
            }

            /// Returns the symmetric matrix that it inverts beside D, if any, row by row.
            pub fn divisor<S: Divide>(self, at: &Written<'_, S>) -> Vec<S> {
                match self {
                    $($($(Quantity::$quantity => $file::$quantity::divisor(at),)+)?)*
                    Quantity::Load => argument::Load::divisor(at),
                    Quantity::At(framed) => framed.of_frame(at, |quantity, at| quantity.divisor(at)),
                }
            }

            /// Returns its place among all of them; none of one at a frame.
            pub fn index(self) -> Option<usize> {
                Quantity::ALL.iter().position(|quantity| *quantity == self)
            }
        }
    };
}
