//! The macro behind the list of outputs: two enumerations and the one place
//! where their members are told apart.

/// A line an output: its documentation, its file, its name in Rust, and the
/// quantities that its file defines.
macro_rules! registry {
    ($($(#[$doc:meta])* $file:ident: $function:ident { $($quantity:ident),* })*) => {
        /// A function that can be generated.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Function {
            $($(#[$doc])* $function,)*
        }

        /// A quantity that a function returns.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Quantity {
            $($(
                #[doc = concat!("Of [`Function::", stringify!($function), "`].")]
                $quantity,
            )*)*
        }

        impl Function {
            /// Every function, in the order of generated files.
            pub const ALL: [Function; [$(Function::$function),*].len()] = [$(Function::$function),*];

            pub(in crate::outputs) fn definition(self) -> &'static function::Definition {
                match self {
                    $(Function::$function => &$file::FUNCTION,)*
                }
            }
        }

        impl Quantity {
            /// Every quantity, in the order of the functions that define them.
            pub const ALL: &[Quantity] = &[$($(Quantity::$quantity,)*)*];

            pub(in crate::outputs) fn facts(self) -> &'static quantity::Facts {
                match self {
                    $($(Quantity::$quantity => &<$file::$quantity as formula::Formula>::FACTS,)*)*
                }
            }

            /// Its entries by a textbook formulation, flat, row by row.
            pub fn written<S: $crate::scalar::Divide>(self, at: &Written<'_, S>) -> ::alloc::vec::Vec<S> {
                match self {
                    $($(Quantity::$quantity => <$file::$quantity as formula::Formula>::written(at),)*)*
                }
            }

            /// Its entries by the chain formulas, over the chain's joints; `None`
            /// if these do not give it.
            pub fn regrouped<S: $crate::scalar::Divide>(
                self,
                at: &Regrouped<'_, S>,
            ) -> ::core::option::Option<::alloc::vec::Vec<S>> {
                match self {
                    $($(Quantity::$quantity => <$file::$quantity as formula::Formula>::regrouped(at),)*)*
                }
            }

            /// Whether it exists only where D has an inverse.
            pub fn inverts_inertia(self) -> bool {
                match self {
                    $($(Quantity::$quantity => <$file::$quantity as formula::Formula>::INVERTS_INERTIA,)*)*
                }
            }

            /// What vanishes if these entries over all joints are its own, by an
            /// equation that it solves; nothing if it solves none.
            pub fn residual<S: $crate::scalar::Divide>(
                self,
                at: &Written<'_, S>,
                values: &[S],
            ) -> ::alloc::vec::Vec<S> {
                match self {
                    $($(Quantity::$quantity => <$file::$quantity as formula::Formula>::residual(at, values),)*)*
                }
            }

            /// Its entries by the generic runtime.
            ///
            /// # Errors
            /// A vector of another length than the arm has joints.
            pub fn runtime<T: $crate::reference::Float>(
                self,
                runtime: &$crate::reference::Reference<T>,
                at: &$crate::reference::JointVectors<T>,
            ) -> ::core::result::Result<::alloc::vec::Vec<T>, $crate::reference::WrongLength> {
                match self {
                    $($(Quantity::$quantity => <$file::$quantity as formula::Formula>::runtime(runtime, at),)*)*
                }
            }
        }
    };
}
