//! Lagrange–Euler as written, along the way to each link.

use super::*;

/// One joint of the tree as the text has it: its frame in that of the link that carries it.
pub(super) struct Joint<'s> {
    pub(super) link: &'s ChainLink<S>,
    pub(super) at: &'s JointPosition<S>,
}

impl Joint<'_> {
    pub(super) fn append(&self, m: &Columns<S>) -> Columns<S> {
        let ChainLink {
            rotation, offset, ..
        } = self.link;
        let step = match self.at {
            JointPosition::Revolute(_) => *offset,
            JointPosition::Prismatic(q) => sum(offset, &scaled(q, &self.link.axis)),
        };
        let placed = Columns {
            axes: transposed(rotation).map(|column| m.rotate(&column)),
            origin: m.apply(&step, &S::one()),
        };
        match self.at {
            JointPosition::Revolute(q) => placed.turn_z(&q.compose(&self.link.theta)),
            JointPosition::Prismatic(_) => placed,
        }
    }

    pub(super) fn derive(&self, m: &Columns<S>) -> Columns<S> {
        match self.link.kind {
            JointKind::Revolute => m.derive(JointKind::Revolute),
            JointKind::Prismatic => Columns {
                axes: three(|_| zero_vector()),
                origin: m.rotate(&self.link.axis),
            },
        }
    }
}

/// The coefficients of τ = D q̈ + h + c, armature included.
pub(super) struct LagrangeEuler {
    pub(super) inertia: Vec<Vec<S>>,
    pub(super) christoffel: Vec<Vec<Vec<S>>>,
    pub(super) gravity: Vec<S>,
}

impl LagrangeEuler {
    /// D_ik = Σ_j Tr(U_jk J_j U_jiᵀ), h_ikm = Σ_j Tr(U_jkm J_j U_jiᵀ) and c_i = −Σ_j m_j g U_ji s̃_j,
    /// over the links j that all of the joints move.
    pub(super) fn of(
        links: &[&ChainLink<S>],
        position: &[JointPosition<S>],
        gravity: &Vector<S>,
    ) -> Self {
        let n = links.len();
        let mut all = LagrangeEuler {
            inertia: zero_matrix(n),
            christoffel: vec![zero_matrix(n); n],
            gravity: zeros(n),
        };
        for (j, link) in links.iter().enumerate() {
            let mut way: Vec<usize> =
                core::iter::successors(Some(j), |&i| links[i].parent).collect();
            way.reverse();
            let pose = |derived: &[usize]| {
                way.iter().fold(Columns::identity(), |m, &i| {
                    let (link, at) = (links[i], &position[i]);
                    let joint = Joint { link, at };
                    let times = derived.iter().filter(|by| **by == i);
                    times.fold(joint.append(&m), |m, _| joint.derive(&m))
                })
            };
            for &i in &way {
                let u = pose(&[i]);
                let moved = after(&u, &link.body);
                let weight = negative(&dot(gravity, &moved.origin));
                all.gravity[i] = plus(&all.gravity[i], &weight);
                for &k in &way {
                    let entry = pose(&[k]).trace_with(&moved);
                    all.inertia[i][k] = plus(&all.inertia[i][k], &entry);
                    for &m in &way {
                        let entry = pose(&[k, m]).trace_with(&moved);
                        let h = &mut all.christoffel[i][k][m];
                        *h = plus(h, &entry);
                    }
                }
            }
            all.inertia[j][j] = plus(&all.inertia[j][j], &link.armature);
        }
        all
    }

    pub(super) fn torques(&self, qd: &[S], qdd: &[S]) -> Vec<S> {
        let inertial = product_of(&self.inertia, qdd);
        let swept = velocity_terms(&self.christoffel, qd);
        sums(&sums(&inertial, &swept), &self.gravity)
    }

    pub(super) fn coriolis(&self, qd: &[S]) -> Vec<Vec<S>> {
        let rows = self.christoffel.iter();
        rows.map(|h| product_of(h, qd).into_iter().collect())
            .collect()
    }
}

/// Returns U J with J = [[Σ, s], [sᵀ, m]].
fn after(u: &Columns<S>, body: &Body<S>) -> Columns<S> {
    let rows = body.second.rows();
    Columns {
        axes: three(|i| u.apply(&rows[i], &body.first[i])),
        origin: u.apply(&body.first, &body.mass),
    }
}
