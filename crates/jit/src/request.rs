//! The request for a robot's functions.

use std::path::PathBuf;

use dalembert_codegen::{Asked, LimbLayout, Request, ScalarType, SinCos, Watch};
use dalembert_model::read::Reading;

use crate::error::Error;

/// The place where plans and compiled requests are kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Cache {
    /// In the user's folder for caches, or in that of `DALEMBERT_CACHE`.
    #[default]
    User,
    /// In a folder of the caller's.
    At(PathBuf),
    /// Nowhere.
    Off,
}

/// The options of loading a robot: the chain of a URDF, and the code that is asked for.
#[derive(Clone, Debug, Default)]
pub struct Load {
    /// The chain to take of a URDF, and what of it stays where it is.
    pub urdf: dalembert_import::Options,
    /// The options, by the names that command and macro have for them, such as
    /// `"outputs: gravity, inertia; scalar: f64, f32"`. By default the scalar is the scene's or f64,
    /// and sines are those of `dalembert-sines` unless a scene has a tolerance. With fused products
    /// results are not those of other machines.
    pub asked: Asked,
    /// The place where the work is kept.
    pub cache: Cache,
    /// The observer of a long search.
    pub watch: Watch,
}

impl Load {
    pub(crate) fn request(&self, reading: &Reading) -> Result<Request, Error> {
        let scalars = [ScalarType::F64];
        let Reading {
            robot,
            outputs,
            scenes,
            ..
        } = reading;
        let mut request = Request::parse(&self.asked, &scalars, robot, outputs, scenes)?;
        let scene = request.scene.as_ref();
        let has_tolerance = scene.is_some_and(|scene| scene.tolerance.is_some());
        if request.sincos == SinCos::Auto && !has_tolerance {
            request.sincos = SinCos::Together;
        }
        if request.limbs == LimbLayout::Lanes {
            let why = "limbs: functions in memory have vectors of states: leave `limbs` out";
            return Err(Error::input(why));
        }
        request.limbs = LimbLayout::Apart;
        request.watch = self.watch.clone();
        request.work = Request::work_while_compiling(request.effort);
        Ok(request)
    }
}
