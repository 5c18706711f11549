//! All outputs: what each reads and returns.

use std::sync::LazyLock;

use super::given::LOADING;
use super::setting::Setting;
use crate::program::{ARGUMENTS, argument};

/// Every function, its arguments in order, and its results: the field in a struct, what it is where
/// that is another word, and the lengths of its axes. `n` is the coordinates, `j` the joints, `l` ten
/// a body, `b` the base parameters, `k` a block a limb.
const TABLE: &str = "
    inverse_dynamics: q qd qdd -> tau[n]
    gravity: q -> c[n]
    inertia: q -> d[nn]
    coriolis: q qd -> h[n]
    manipulator_equation: q qd -> d[nn] h[n] c[n]
    dynamic_coefficients: q -> d[nn] h=symbols[nnn] c[n]
    kinetic_energy: q qd -> kinetic[]
    potential_energy: q -> potential[]
    momentum: q qd -> p[n] ct_qd[n]
    coriolis_matrix: q qd -> c_matrix[nn]
    dalembert_terms: q qd -> d_rot[nn] d_tran[nn] h_rot[n] h_tran[n] c[n]
    forward_kinematics: q -> pose[34]
    link_poses: q -> poses[j34]
    jacobian: q -> jacobian[6n]
    jacobian_rate: q qd -> jacobian_rate[6]
    reaction_wrenches: q qd qdd -> wrenches[j6]
    inverse_dynamics_derivatives: q qd qdd -> dtau_dq[nn] dtau_dqd[nn] d[nn]
    passivity: q qd v a -> tau=passivity[n]
    forward_dynamics: q qd tau -> qdd[n]
    inertia_inverse: q -> d_inv[nn]
    forward_dynamics_derivatives: q qd tau -> dqdd_dq[nn] dqdd_dqd[nn] dqdd_dtau=d_inv[nn]
    regressor: q qd qdd -> y=y_base[nb]
    full_regressor: q qd qdd -> y[nl]
    passivity_regressor: q qd v a -> y=y_passivity[nb]
    momentum_observer: q qd -> p[n] drift[n]
    inverse_dynamics_with_wrench: q qd qdd wrench -> tau=tau_wrench[n]
    forward_dynamics_with_wrench: q qd tau wrench -> qdd=qdd_wrench[n]
    contact_wrench: q tau damping -> contact_wrench[6]
    operational_inertia_inverse: q -> operational_inertia_inverse=mobility[66]
    operational_inertia: q damping -> operational_inertia[66]
    consistent_inverse: q damping -> consistent_inverse[n6]
    operational_bias: q qd damping -> operational_bias[6]
    null_space_projector: q damping -> null_space[nn]
    centre_of_mass: q -> com[3]
    centroidal_momentum_matrix: q -> centroidal_momentum_matrix[6n]
    centroidal_bias: q qd -> centroidal_bias[6]
    joint_torques_free: q qd qdd -> tau=tau_free[n] base_acceleration[6]
    inertia_blocks: q -> base=d_base[66] coupling=d_coupling[6j] limbs=d_limbs[k]
    contact_jacobians: q -> contact_jacobians[3n]
    contact_bias: q qd -> contact_bias[3]
    contact_forward_dynamics: q qd tau damping -> qdd=qdd_held[n] forces[3]
    inverse_dynamics_second_derivatives: q qd qdd multiplier ->
        d2tau_dq_dq[nn] d2tau_dq_dqd[nn] d2tau_dqd_dqd[nn] d2tau_dqdd_dq[nn]
    forward_dynamics_second_derivatives: q qd tau multiplier ->
        d2qdd_dq_dq[nn] d2qdd_dq_dqd[nn] d2qdd_dqd_dqd[nn] d2qdd_dtau_dq[nn]
";

const MOVES: &str = "jacobian jacobian_rate contact_wrench mobility operational_inertia \
    consistent_inverse operational_bias null_space";

/// A result of a function.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The name of the field of the struct.
    pub name: String,
    pub(super) quantity: &'static str,
    /// The lengths of its axes, a character each.
    pub axes: &'static str,
    pub(super) view: View,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct View {
    /// Its name; of points in contact all names, with commas between.
    pub(super) frame: String,
    /// `local`, `world` or neither.
    pub(super) axes: String,
    /// The components, of six; none for all.
    pub(super) rows: Vec<usize>,
}

/// A function that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// The places of its arguments among all.
    pub arguments: Vec<usize>,
    /// Its results, in order.
    pub fields: Vec<Field>,
}

/// The numbers that lengths follow from.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// The joints that move by themselves.
    pub joints: usize,
    /// Those, and six of a base that floats.
    pub coordinates: usize,
    /// The links, and a base that floats.
    pub bodies: usize,
    /// The links whose bodies are arguments.
    pub argument_bodies: usize,
    /// The rows of the table.
    pub table: usize,
}

/// Returns the length of an axis.
pub fn length(axis: char, sizes: Sizes) -> usize {
    match axis {
        'j' => sizes.joints,
        'n' => sizes.coordinates,
        'l' => 10 * sizes.bodies,
        'p' => 10,
        'k' => 10 * sizes.argument_bodies,
        't' => sizes.table,
        digit => digit.to_digit(10).unwrap_or(0) as usize,
    }
}

fn ensure(holds: bool) -> Option<()> {
    holds.then_some(())
}

impl Field {
    /// Reads a result as the table has it: `h=symbols[nnn]`.
    fn read(word: &'static str) -> Option<Field> {
        let (names, axes) = word.strip_suffix(']')?.split_once('[')?;
        let (name, is) = names.split_once('=').unwrap_or((names, names));
        Some(Field {
            name: name.to_owned(),
            quantity: is,
            axes,
            view: View::default(),
        })
    }

    /// Returns the result of the table at a frame, given as `camera:local:x_y`.
    fn at(mut self, text: &str) -> Option<Field> {
        const COMPONENTS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
        let mut words = text.split(':');
        let mut view = View {
            frame: words.next()?.to_owned(),
            ..View::default()
        };
        for word in words {
            match word {
                "local" | "world" if view.axes.is_empty() => view.axes = word.to_owned(),
                "linear" => view.rows.extend(0..3),
                "angular" => view.rows.extend(3..6),
                list => {
                    let place = |name| COMPONENTS.iter().position(|component| *component == name);
                    let rows = list.split('_').map(place).collect::<Option<Vec<usize>>>()?;
                    view.rows.extend(rows);
                }
            }
        }
        ensure(view.rows.is_sorted_by(|a, b| a < b))?;
        // A pose has no axes of motion, and of what acts at a frame all six components are given.
        let has_no_axes = self.quantity == "pose" || self.is_of_contact();
        let is_whole = self.acts() || has_no_axes && view.axes.is_empty();
        ensure(self.moves() || view.rows.is_empty() && is_whole)?;
        let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let is_name = |name: &str| !name.is_empty() && name.chars().all(is_letter);
        let mut names = view.frame.split(',');
        let is_one = !view.frame.contains(',') || self.is_of_contact();
        ensure(is_one && names.all(is_name))?;
        self.name = format!("{}_{}", self.name, text.replace([':', ','], "_"));
        self.view = view;
        Some(self)
    }

    fn moves(&self) -> bool {
        MOVES.split_whitespace().any(|word| word == self.quantity)
    }

    fn acts(&self) -> bool {
        ["tau_wrench", "qdd_wrench"].contains(&self.quantity)
    }

    /// Returns how many points are in contact.
    pub(super) fn points(&self) -> usize {
        match self.is_of_contact() {
            true => self.view.frame.split(',').count(),
            false => 0,
        }
    }

    fn is_of_contact(&self) -> bool {
        ["contact_jacobians", "contact_bias", "qdd_held", "forces"].contains(&self.quantity)
    }

    /// Returns true if it is of the hand, or of frames that have names.
    pub(super) fn is_of_frame(&self) -> bool {
        self.moves() || self.acts() || self.is_of_contact() || self.quantity == "pose"
    }

    /// Returns true if it takes the inverse of a matrix; all others exist at every state.
    pub(crate) fn divides(&self) -> bool {
        const INVERSES: &str = "qdd d_inv dqdd_dq dqdd_dqd qdd_wrench contact_wrench mobility \
            operational_inertia consistent_inverse operational_bias null_space tau_free \
            base_acceleration qdd_held forces d2qdd_dq_dq d2qdd_dq_dqd d2qdd_dqd_dqd d2qdd_dtau_dq";
        let mut words = INVERSES.split_whitespace();
        words.any(|word| word == self.quantity)
    }

    /// Returns true if it is of a fixed base alone, or of one that floats alone.
    pub(super) fn is_of_base(&self, floats: bool) -> bool {
        let words = match floats {
            true => "tau_free base_acceleration d_base d_coupling d_limbs",
            false => "symbols d_rot d_tran h_rot h_tran",
        };
        !floats && self.quantity.starts_with("d2")
            || words.split(' ').any(|word| word == self.quantity)
    }

    /// A torque of each joint, D of each two, or a coefficient of each three.
    pub(crate) fn is_measured(&self) -> bool {
        let known = "tau c h h_rot h_tran d d_rot d_tran symbols";
        known.split(' ').any(|word| word == self.quantity)
    }

    /// Returns the lengths of its axes, `base` being the number of base parameters.
    pub fn lengths(&self, setting: &Setting, base: usize) -> Vec<usize> {
        let of = |axis: char| match axis {
            'n' => setting.rows.len(),
            'j' => setting.joint_rows().len(),
            'b' => base,
            'k' => setting.blocks().len(),
            '3' if self.is_of_contact() => 3 * self.points(),
            '6' if !self.view.rows.is_empty() => self.view.rows.len(),
            axis => length(axis, setting.sizes()),
        };
        self.axes.chars().map(of).collect()
    }
}

static FUNCTIONS: LazyLock<Vec<Function>> = LazyLock::new(read);

/// Returns all functions.
pub fn functions() -> &'static [Function] {
    &FUNCTIONS
}

fn read() -> Vec<Function> {
    let mut functions: Vec<Function> = Vec::new();
    for word in TABLE.split_whitespace() {
        if let Some(name) = word.strip_suffix(':') {
            functions.push(Function {
                name: name.to_owned(),
                arguments: Vec::new(),
                fields: Vec::new(),
            });
        } else if let Some(last) = functions.last_mut() {
            last.arguments.extend(argument(word));
            last.fields.extend(Field::read(word));
        }
    }
    functions
}

impl Function {
    /// Returns the function of a name with these results: that of the table, one of it at a frame
    /// (`jacobian@camera:local`), or several of them as one, each by its name in the table.
    ///
    /// # Errors
    /// The first result that is not of the table, or a known name with other results.
    pub fn named(name: &str, arguments: &[String], results: &[String]) -> Result<Function, String> {
        let functions = functions();
        let place =
            |name: &String| argument(name).ok_or_else(|| format!("there is no argument `{name}`"));
        let arguments: Vec<usize> = arguments.iter().map(place).collect::<Result<_, _>>()?;
        if !arguments.is_sorted_by(|one, next| one < next) {
            return Err("its arguments are in another order".into());
        }
        // A load is of bodies and drives; other arguments are those of the table, or in place of numbers.
        let mut taken = match results {
            [] => LOADING.map(argument).to_vec(),
            _ => vec![argument("g"), argument("load")],
        };
        let mut of = |result: &String| {
            let (function, rest) = result.split_once('.')?;
            let (field, view) = match rest.split_once('@') {
                Some((field, view)) => (field, Some(view)),
                None => (rest, None),
            };
            let entry = functions.iter().find(|entry| entry.name == function)?;
            taken.extend(entry.arguments.iter().copied().map(Some));
            let mut fields = entry.fields.iter();
            let field = fields.find(|candidate| candidate.name == field)?;
            view.map_or(Some(field.clone()), |view| field.clone().at(view))
        };
        let mut names = results.iter().collect::<Vec<_>>();
        names.sort();
        if let Some(twice) = names.windows(2).find(|two| two[0] == two[1]) {
            return Err(format!("the result `{}` is there twice", twice[0]));
        }
        let field_of =
            |result: &String| of(result).ok_or_else(|| format!("there is no result `{result}`"));
        let fields: Vec<Field> = results.iter().map(field_of).collect::<Result<_, _>>()?;
        let is_needless = |argument: &&usize| !taken.contains(&Some(**argument));
        if let Some(other) = arguments.iter().find(is_needless) {
            let name = ARGUMENTS[*other].0;
            return Err(format!("no result of it takes `{name}`"));
        }
        let is_same = |function: &Function| {
            let word = |field: &Field| field.quantity;
            let has_frame = fields.iter().any(|field| !field.view.frame.is_empty());
            has_frame && fields.iter().map(word).eq(function.fields.iter().map(word))
        };
        let is_other = |function: &Function| match name.strip_prefix(function.name.as_str()) {
            Some("") => function.fields != fields,
            // A function and a frame: their names are its name.
            Some(rest) if is_same(function) => {
                let mut pairs = fields.iter().zip(&function.fields);
                pairs.any(|(field, original)| field.name != format!("{}{rest}", original.name))
            }
            _ => false,
        };
        match functions.iter().any(is_other) {
            true => Err(format!("`{name}` has other results")),
            false => Ok(Function {
                name: name.to_owned(),
                arguments,
                fields,
            }),
        }
    }

    /// Returns the name of the constant that has the values of its base parameters, if it is over
    /// some.
    pub fn parameters(&self) -> Option<&'static str> {
        let mut fields = self.fields.iter();
        fields.find_map(|field| match field.quantity {
            "y_base" => Some("BASE_PARAMETERS"),
            "y_passivity" => Some("PASSIVITY_PARAMETERS"),
            _ => None,
        })
    }
}
