//! Arms, regroupings and states drawn at random.

use core::ops::Range;

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

    /// A pose as those of robots are: half of them shift alone.
    fn placement(&mut self) -> Columns<S> {
        let mut pose = Columns::identity();
        match self.below(5) {
            0 | 1 => {}
            2 => {
                let (sin, cos) = (S::zero(), S::one().neg());
                pose = pose.turn_x(&SinCosPair { sin, cos });
            }
            3 => pose = pose.turn_x(&self.angle()),
            _ => pose = pose.turn_x(&self.angle()).turn_y(&self.angle()),
        }
        pose.origin = self.vector();
        pose
    }

    fn body(&mut self) -> MomentBody<S> {
        let mut body = MomentBody::zero();
        [body.second.xx, body.second.zz] = [self.value(), self.value()];
        body.second.yy = body.second.xx;
        body.mass = self.value();
        body.first[2] = self.constant();
        // A quarter are symmetric about z.
        if self.below(4) > 0 {
            body.first = self.vector();
            let [xy, yz, xz] = self.vector();
            let [xx, yy, zz] = [(); 3].map(|()| self.value());
            body.second = Inertia::of([xx, yy, zz, xy, yz, xz]);
        }
        body
    }

    fn parent(&mut self, i: usize) -> Option<Parent> {
        let carrier = match self.below(4) {
            _ if i == 0 => return None,
            0 => (self.below(1 + i as u64) as usize).checked_sub(1),
            1 => Some(self.below(i as u64) as usize),
            _ => return None,
        };
        match carrier {
            None => Some(Parent::Base),
            Some(carrier) => (carrier + 1 < i).then_some(Parent::Row(carrier)),
        }
    }

    pub(super) fn link(&mut self, i: usize) -> Link<S> {
        let place = self.placement();
        let body = self.body();
        let theta = match self.below(2) {
            0 => self.angle(),
            _ => SinCosPair::straight(),
        };
        Link {
            parent: self.parent(i),
            kind: match self.below(4) {
                0 => JointKind::Prismatic,
                _ => JointKind::Revolute,
            },
            place: Some(place),
            theta,
            d: self.constant(),
            mass: body.mass,
            com: body.first,
            inertia: body.second,
            armature: self.constant(),
            friction: Friction {
                viscous: self.constant(),
                coulomb: None,
            },
            ..Link::still()
        }
    }

    /// An arm of modified DH whose links branch, with a frame on one of them.
    pub(super) fn arm(&mut self, count: usize) -> Arm<S> {
        let links: Vec<Link<S>> = (0..count).map(|i| self.link(i)).collect();
        let frame = NamedFrame {
            name: "tip".into(),
            joint: self.below(count.max(1) as u64) as usize,
            pose: self.placement(),
        };
        Arm {
            convention: Convention::Modified,
            gravity: self.vector(),
            base: (self.below(2) == 0).then(|| self.placement()),
            tool: None,
            floats: false,
            links,
            following: Vec::new(),
            frames: Frames {
                named: vec![frame],
                ..Frames::default()
            },
        }
    }

    /// Draws an arm on a base that floats, with a frame on that or on a link.
    pub(super) fn floating(&mut self, count: usize) -> Arm<S> {
        let limbs = self.arm(count);
        let trunk = Link {
            armature: S::zero(),
            friction: Friction::none(),
            theta: SinCosPair::straight(),
            d: S::zero(),
            ..self.link(0)
        };
        self.on(Link::of_base(trunk), limbs)
    }

    /// Puts links on six others, of which the last carries them.
    pub(super) fn on(&mut self, base: Vec<Link<S>>, limbs: Arm<S>) -> Arm<S> {
        let last = base.len() - 1;
        let limb_carriers = (0..limbs.links.len()).map(|i| limbs.carrier(i));
        let places = limb_carriers.map(|carrier| carrier.map_or(last, |i| base.len() + i));
        let carriers: Vec<usize> = places.collect();
        let mut arm = limbs.clone();
        (arm.base, arm.floats, arm.links) = (None, true, base);
        for (link, carrier) in limbs.links.into_iter().zip(carriers) {
            let parent = (carrier + 1 != arm.links.len()).then_some(Parent::Row(carrier));
            arm.links.push(Link { parent, ..link });
        }
        for frame in &mut arm.frames.named {
            frame.joint = match self.below(3) {
                0 => last,
                _ => arm.links.len() - 1,
            };
        }
        arm
    }

    /// Draws positions of an arm's joints; those of a base that floats are zero.
    pub(super) fn position_of(&mut self, arm: &Arm<S>) -> Positions {
        let (base, joints) = arm.links.split_at(arm.base_joints());
        let zero = base_position::<S>().into_iter().take(base.len());
        zero.chain(self.position(joints)).collect()
    }

    /// Columns of a regressor: bodies on half of the links.
    pub(super) fn columns(&mut self, links: Range<usize>) -> Vec<Column<S>> {
        let joints: Vec<usize> = links.filter(|_| self.below(2) == 0).collect();
        let columns = joints.into_iter().map(|joint| Column {
            joint,
            of: Probed::Body(self.body()),
        });
        columns.collect()
    }

    /// A chain in a random regrouping, changed from one that differs in one link.
    pub(super) fn chain(&mut self, skeleton: &Skeleton<S>) -> Chain<S> {
        let regrouping = self.regrouping(skeleton);
        let mut before = regrouping.clone();
        let at = self.below(skeleton.links.len().max(1) as u64) as usize;
        let mut other = self.regrouping(skeleton).links;
        if other.is_empty() {
            return Chain::new(skeleton, &regrouping);
        }
        before.links[at] = other.swap_remove(at);
        let metric = MetricChain::new(skeleton, &before);
        let changed = metric.changed(skeleton, &regrouping, at);
        changed.in_unit(&regrouping)
    }

    pub(super) fn regrouping(&mut self, skeleton: &Skeleton<S>) -> Regrouping<S> {
        let of_segment = |segment: &Segment<S>| LinkRegrouping {
            origin: match segment.link.kind {
                JointKind::Revolute => [S::zero(), S::zero(), self.constant()],
                JointKind::Prismatic => self.vector(),
            },
            mass: self.constant(),
            first: self.constant(),
            second: self.constant(),
            keep_seconds: self.below(2) == 0,
            axes: self.below(5) as i32 - 2,
        };
        let links = skeleton.links.iter().map(of_segment).collect();
        let unit = self.value();
        Regrouping {
            links,
            per_unit: S::one().div(&unit),
            unit,
        }
    }

    pub(super) fn position(&mut self, links: &[Link<S>]) -> Positions {
        let joints = links.iter().map(|link| match link.kind {
            JointKind::Revolute => JointPosition::Revolute(self.angle()),
            JointKind::Prismatic => JointPosition::Prismatic(self.value()),
        });
        joints.collect()
    }
}
