//! The macro behind the list of outputs: two enumerations and the one place
//! where their members are told apart. What comes along with others, and is not
//! asked for by itself, stands behind `beside them`.

/// A row an output: its documentation, its name and its name in Rust, the file of the quantities
/// that are its own, a line for the documentation of generated code, and what differs from
/// [`Definition::of`](function::Definition::of).
macro_rules! registry {
    (
        $(
            $(#[$doc:meta])* $name:ident: $function:ident { $($file:ident: $($quantity:ident),+)? }
            $summary:literal $(, $field:ident: $value:expr)*;
        )*
        ; beside them:
        $(
            $(#[$along_doc:meta])* $along_name:ident: $along:ident { $along_file:ident: $part:ident }
            $along_summary:literal;
        )*
    ) => {
        /// A function that can be generated.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Function {
            $($(#[$doc])* $function,)*
            $($(#[$along_doc])* $along,)*
            /// Several of these in one, by a name of the user's.
            Bundle(bundle::Bundle),
            /// One of these at a frame.
            At(at::FunctionAt),
        }

        /// A quantity that a function returns.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Quantity {
            $($($(
                #[doc = concat!("Of [`Function::", stringify!($function), "`].")]
                $quantity,
            )+)?)*
            $(
                #[doc = concat!("Of [`Function::", stringify!($along), "`].")]
                $part,
            )*
            /// One of these at a frame.
            At(at::QuantityAt),
        }

        impl Function {
            /// Every function that can be asked for by its name alone, in the order of
            /// generated files: bundles have theirs from the user.
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
                    $(Function::$along => const {
                        &function::Definition::of(
                            stringify!($along_name),
                            stringify!($along),
                            $along_summary,
                            &[Quantity::$part],
                        )
                    },)*
                    Function::Bundle(bundle) => bundle.definition(),
                    Function::At(at) => at.definition(),
                }
            }
        }

        impl Quantity {
            /// Every quantity of a function that can be asked for, in the order of these.
            pub const ALL: &[Quantity] = &[$($($(Quantity::$quantity,)+)?)*];

            pub(in crate::outputs) fn facts(self) -> &'static quantity::Facts {
                match self {
                    $($($(Quantity::$quantity => &<$file::$quantity as formula::Formula>::FACTS,)+)?)*
                    $(Quantity::$part => &<$along_file::$part as formula::Formula>::FACTS,)*
                    Quantity::At(at) => at.facts(),
                }
            }

            /// Returns the function that defines it, of the hand, where others may return it too.
            pub fn function(self) -> Function {
                match self {
                    $($($(Quantity::$quantity => Function::$function,)+)?)*
                    $(Quantity::$part => Function::$along,)*
                    Quantity::At(at) => at.quantity().function(),
                }
            }

            /// Returns its entries by a textbook formulation, flat, row by row.
            pub fn written<S: $crate::scalar::Divide>(self, at: &Written<'_, S>) -> ::alloc::vec::Vec<S> {
                match self {
                    $($($(Quantity::$quantity => <$file::$quantity as formula::Formula>::written(at),)+)?)*
                    $(Quantity::$part => <$along_file::$part as formula::Formula>::written(at),)*
                    Quantity::At(own) => own.written(at),
                }
            }

            /// Returns its entries by the chain formulas, over the chain's joints; `None`
            /// if these do not give it.
            pub fn regrouped<S: $crate::scalar::Divide>(
                self,
                at: &Regrouped<'_, S>,
            ) -> ::core::option::Option<::alloc::vec::Vec<S>> {
                match self {
                    $($($(Quantity::$quantity => <$file::$quantity as formula::Formula>::regrouped(at),)+)?)*
                    $(Quantity::$part => <$along_file::$part as formula::Formula>::regrouped(at),)*
                    Quantity::At(own) => own.regrouped(at),
                }
            }

            /// Returns whether it exists only where D has an inverse.
            pub fn inverts_inertia(self) -> bool {
                match self {
                    $($($(Quantity::$quantity => <$file::$quantity as formula::Formula>::INVERTS_INERTIA,)+)?)*
                    $(Quantity::$part => <$along_file::$part as formula::Formula>::INVERTS_INERTIA,)*
                    Quantity::At(own) => own.quantity().inverts_inertia(),
                }
            }

            /// Returns what vanishes if these entries over all joints are its
            /// own, by an equation that it solves; nothing if it solves none.
            pub fn residual<S: $crate::scalar::Divide>(
                self,
                at: &Written<'_, S>,
                values: &[S],
            ) -> ::alloc::vec::Vec<S> {
                match self {
                    $($($(Quantity::$quantity => <$file::$quantity as formula::Formula>::residual(at, values),)+)?)*
                    $(Quantity::$part => <$along_file::$part as formula::Formula>::residual(at, values),)*
                    Quantity::At(own) => own.residual(at, values),
                }
            }

            /// Returns the symmetric matrix that it inverts beside D, row by row; nothing if it
            /// inverts no other.
            pub fn divisor<S: $crate::scalar::Divide>(self, at: &Written<'_, S>) -> ::alloc::vec::Vec<S> {
                match self {
                    $($($(Quantity::$quantity => <$file::$quantity as formula::Formula>::divisor(at),)+)?)*
                    $(Quantity::$part => <$along_file::$part as formula::Formula>::divisor(at),)*
                    Quantity::At(own) => own.divisor(at),
                }
            }

            /// Returns its place among all of them; none of one at a frame.
            pub fn index(self) -> ::core::option::Option<usize> {
                Quantity::ALL.iter().position(|quantity| *quantity == self)
            }
        }
    };
}
