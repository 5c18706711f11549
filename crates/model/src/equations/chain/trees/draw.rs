//! Trees, regroupings and states drawn at random.

use super::*;

pub(super) struct Draw(pub(super) Points);

impl Draw {
    fn below(&mut self, count: u64) -> u64 {
        self.0.bits() % count
    }

    pub(super) fn value(&mut self) -> S {
        Sparse::Value(self.0.field())
    }

    /// A third of all constants of robots are zero.
    fn constant(&mut self) -> S {
        match self.below(3) {
            0 => S::zero(),
            _ => self.value(),
        }
    }

    fn vector(&mut self) -> Vector<S> {
        three(|_| ()).map(|()| self.constant())
    }

    pub(super) fn values(&mut self, count: usize) -> Vec<S> {
        (0..count).map(|_| self.value()).collect()
    }

    pub(super) fn angle(&mut self) -> SinCosPair<S> {
        let (sin, cos) = self.0.circle();
        let [sin, cos] = [sin, cos].map(Sparse::Value);
        SinCosPair { sin, cos }
    }

    fn rotation(&mut self) -> Rotation<S> {
        let mut half = identity();
        [half[1][1], half[2][2]] = [S::one().neg(), S::one().neg()];
        match self.below(5) {
            0 | 1 => identity(),
            2 => half,
            3 => turn(&self.angle(), ABOUT_X),
            _ => product(&turn(&self.angle(), ABOUT_X), &turn(&self.angle(), ABOUT_Y)),
        }
    }

    fn body(&mut self) -> Body<S> {
        let mut second = Inertia::symmetric(|_, _| S::zero());
        let [xx, zz] = [self.value(), self.value()];
        second = Inertia {
            xx,
            yy: xx,
            zz,
            ..second
        };
        let mut body = Body {
            mass: self.value(),
            first: [S::zero(), S::zero(), self.constant()],
            second,
        };
        // A quarter are symmetric about z.
        if self.below(4) > 0 {
            body.first = self.vector();
            let [xy, yz, xz] = self.vector();
            let [xx, yy, zz] = [(); 3].map(|()| self.value());
            body.second = Inertia::of([xx, yy, zz, xy, yz, xz]);
        }
        body
    }

    fn segment(&mut self, i: usize) -> Segment<S> {
        let parent = match self.below(4) {
            _ if i == 0 => None,
            0 => (self.below(1 + i as u64) as usize).checked_sub(1),
            1 => Some(self.below(i as u64) as usize),
            _ => Some(i - 1),
        };
        let slides = self.below(4) == 0;
        let (sin, cos) = self.0.circle();
        let slope = [Sparse::Value(sin), S::zero(), Sparse::Value(cos)];
        let axis = match self.below(2) {
            0 if slides => slope,
            _ => unit_z(),
        };
        let theta = match self.below(2) {
            0 if !slides => self.angle(),
            _ => SinCosPair::straight(),
        };
        let probes = match self.below(2) {
            0 => Vec::new(),
            _ => vec![Probe {
                column: i,
                of: Probed::Body(self.body()),
            }],
        };
        let link = ChainLink {
            parent,
            kind: match slides {
                true => JointKind::Prismatic,
                false => JointKind::Revolute,
            },
            rotation: match slides {
                true => identity(),
                false => self.rotation(),
            },
            offset: self.vector(),
            axis,
            theta,
            body: self.body(),
            probes,
            free: zero_vector(),
            armature: self.constant(),
            friction: Friction {
                viscous: self.constant(),
                coulomb: None,
            },
            spins_freely: false,
            axes: 0,
        };
        Segment {
            joint: i,
            d: self.constant(),
            dh: (identity(), zero_vector()),
            link,
        }
    }

    pub(super) fn skeleton(&mut self, count: usize, floats: bool) -> Skeleton<S> {
        Skeleton {
            gravity: self.vector(),
            base: floats.then(|| self.body()),
            links: (0..count).map(|i| self.segment(i)).collect(),
            columns: count,
        }
    }

    pub(super) fn regrouping(&mut self, skeleton: &Skeleton<S>) -> Regrouping<S> {
        let links = skeleton.links.iter().map(|segment| LinkRegrouping {
            origin: match segment.link.kind {
                JointKind::Revolute => [S::zero(), S::zero(), self.constant()],
                JointKind::Prismatic => self.vector(),
            },
            mass: self.constant(),
            first: self.constant(),
            second: self.constant(),
            keep_seconds: self.below(2) == 0,
            axes: self.below(5) as i32 - 2,
        });
        let links = links.collect();
        let unit = self.value();
        Regrouping {
            links,
            per_unit: S::one().div(&unit),
            unit,
        }
    }

    pub(super) fn position(&mut self, skeleton: &Skeleton<S>) -> Position {
        let joints = skeleton
            .links
            .iter()
            .map(|segment| match segment.link.kind {
                JointKind::Revolute => JointPosition::Revolute(self.angle()),
                JointKind::Prismatic => JointPosition::Prismatic(self.value()),
            });
        joints.collect()
    }
}
