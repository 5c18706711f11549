//! Why there is no such bundle.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

use crate::outputs::Function;

/// Why there is no such bundle.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BundleError {
    /// The mistake.
    pub message: String,
    /// The likely fix.
    pub help: String,
    /// The word that names no output, if this is what is wrong.
    pub unknown: Option<String>,
}

impl BundleError {
    pub(in crate::outputs) fn new(message: String, help: impl Into<String>) -> BundleError {
        BundleError {
            message,
            help: help.into(),
            unknown: None,
        }
    }

    pub(in crate::outputs) fn of_unknown(word: &str) -> BundleError {
        let error = match word {
            "" => {
                let message = "expected an output".to_string();
                BundleError::new(message, "write its name, such as `gravity`")
            }
            word => {
                let message = format!("unknown output `{word}`");
                BundleError::new(message, "a bundle is NAME = OUTPUT + OUTPUT")
            }
        };
        BundleError {
            unknown: Some(word.to_string()),
            ..error
        }
    }

    /// Returns the error where these functions are known beside the outputs: a word that is the
    /// name of a bundle among them is that.
    #[must_use]
    pub fn among(self, functions: &[Function]) -> BundleError {
        let word = self.unknown.as_deref();
        let is_it = |function: &&Function| {
            matches!(function, Function::Bundle(_)) && word == Some(function.name())
        };
        let Some(bundle) = functions.iter().find(is_it) else {
            return self;
        };
        let parts: Vec<&str> = bundle.parts().iter().map(|part| part.name()).collect();
        let help = format!(
            "bundles do not nest: write its parts, {}",
            parts.join(" + ")
        );
        BundleError::new(format!("`{bundle}` is a bundle itself"), help)
    }
}

impl fmt::Display for BundleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message, self.help)
    }
}

impl core::error::Error for BundleError {}
