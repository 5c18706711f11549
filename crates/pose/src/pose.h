/* The pose of a base that floats, for C99 and CUDA. Velocities and steps are six numbers, linear
 * over angular. The text of dalembert-pose in Rust is the same, with its bounds of the error, and
 * returns the same bits where the compiler contracts nothing (-ffp-contract=off).
 *
 * #define POSE_REAL float before it is included computes in single precision. */
#ifndef DALEMBERT_POSE_H
#define DALEMBERT_POSE_H

#ifndef POSE_REAL
#define POSE_REAL double
#endif
#ifdef __CUDACC__
#define POSE_FUNCTION static inline __host__ __device__
#else
#define POSE_FUNCTION static inline
#endif

/* A rotation from the base's axes to those of the world. Libraries differ in the order of the four:
 * Pinocchio, ROS and SciPy write x, y, z, w, and MuJoCo, Drake and Eigen's constructor w, x, y, z. */
typedef struct {
    POSE_REAL x, y, z, w;
} pose_quaternion;

/* A base's pose: its origin in world axes in m, and its orientation. */
typedef struct {
    POSE_REAL position[3];
    pose_quaternion orientation;
} pose_base;

/* Axes and point of a velocity or acceleration, other than the base's axes and origin. */
typedef enum {
    POSE_MIXED, /* world axes at the base's origin: Pinocchio's LOCAL_WORLD_ALIGNED */
    POSE_WORLD, /* world axes at the world's origin: Pinocchio's WORLD */
    POSE_SPLIT  /* linear in world axes, angular in the base's: a free joint of MuJoCo */
} pose_axes;

POSE_FUNCTION pose_quaternion pose_from_xyzw(const POSE_REAL q[4]) {
    const pose_quaternion r = {q[0], q[1], q[2], q[3]};
    return r;
}

POSE_FUNCTION pose_quaternion pose_from_wxyz(const POSE_REAL q[4]) {
    const pose_quaternion r = {q[1], q[2], q[3], q[0]};
    return r;
}

POSE_FUNCTION void pose_to_xyzw(const pose_quaternion *r, POSE_REAL q[4]) {
    q[0] = r->x, q[1] = r->y, q[2] = r->z, q[3] = r->w;
}

POSE_FUNCTION void pose_to_wxyz(const pose_quaternion *r, POSE_REAL q[4]) {
    q[0] = r->w, q[1] = r->x, q[2] = r->y, q[3] = r->z;
}

POSE_FUNCTION void pose_cross_(const POSE_REAL a[3], const POSE_REAL b[3], POSE_REAL c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

POSE_FUNCTION POSE_REAL pose_squared_(pose_quaternion q) {
    return q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
}

/* p + 2 (w u x p + u x (u x p)) / |q|^2 */
POSE_FUNCTION void pose_turned_(pose_quaternion q, POSE_REAL w, const POSE_REAL p[3],
                                POSE_REAL result[3]) {
    const POSE_REAL u[3] = {q.x, q.y, q.z};
    const POSE_REAL scale = (POSE_REAL)2 / pose_squared_(q);
    POSE_REAL first[3], second[3];
    pose_cross_(u, p, first);
    pose_cross_(u, first, second);
    for (int i = 0; i < 3; i++) {
        result[i] = p[i] + scale * (w * first[i] + second[i]);
    }
}

/* A vector of the base's axes in world axes. The quaternion's length may be any but zero. */
POSE_FUNCTION void pose_rotate(const pose_quaternion *q, const POSE_REAL in_base[3],
                               POSE_REAL in_world[3]) {
    pose_turned_(*q, q->w, in_base, in_world);
}

/* A vector of world axes in the base's axes: of the world's gravity, {0, 0, -9.81} where z points
 * upward, it is the argument g of generated functions. */
POSE_FUNCTION void pose_rotate_back(const pose_quaternion *q, const POSE_REAL in_world[3],
                                    POSE_REAL in_base[3]) {
    pose_turned_(*q, -q->w, in_world, in_base);
}

/* The rotation by b, then by a. */
POSE_FUNCTION pose_quaternion pose_after(pose_quaternion a, pose_quaternion b) {
    const POSE_REAL u[3] = {a.x, a.y, a.z}, v[3] = {b.x, b.y, b.z};
    POSE_REAL c[3], xyz[3];
    pose_cross_(u, v, c);
    for (int i = 0; i < 3; i++) {
        xyz[i] = (a.w * v[i] + b.w * u[i]) + c[i];
    }
    const pose_quaternion r = {xyz[0], xyz[1], xyz[2],
                               a.w * b.w - (u[0] * v[0] + u[1] * v[1] + u[2] * v[2])};
    return r;
}

/* It takes a length 1 + e to 1 - e^2/2. */
POSE_FUNCTION pose_quaternion pose_nearly_unit_(pose_quaternion q) {
    const POSE_REAL k = (POSE_REAL)2 / ((POSE_REAL)1 + pose_squared_(q));
    const pose_quaternion r = {k * q.x, k * q.y, k * q.z, k * q.w};
    return r;
}

/* 1 - x/((n+1)(n+2)) (1 - x/((n+3)(n+4)) (1 - ...)) */
POSE_FUNCTION POSE_REAL pose_series_(POSE_REAL x, int n) {
    POSE_REAL sum = 1;
    for (int k = 13; k >= 0; k--) {
        sum = (POSE_REAL)1 - x / (POSE_REAL)((n + 2 * k + 1) * (n + 2 * k + 2)) * sum;
    }
    return sum;
}

/* The pose after a step in the base's axes, a velocity times a time, in m over rad: the exponential
 * map of SE(3). Up to half a turn each entry of the orientation errs by less than 4 u, and each of the
 * position by less than 16 u of the longest of position and step (u = 2^-53 of double). */
POSE_FUNCTION pose_base pose_integrate(const pose_base *from, const POSE_REAL step[6]) {
    const POSE_REAL *linear = step, *turn = step + 3;
    const POSE_REAL square = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2];
    const POSE_REAL quarter = square / (POSE_REAL)4;
    const POSE_REAL cosine = pose_series_(quarter, 0);
    const POSE_REAL sine = pose_series_(quarter, 1) / (POSE_REAL)2;
    const POSE_REAL rest = pose_series_(square, 3) / (POSE_REAL)6;
    const POSE_REAL bend = (POSE_REAL)2 * sine * sine;
    POSE_REAL once[3], twice[3], travel[3], away[3];
    pose_cross_(turn, linear, once);
    pose_cross_(turn, once, twice);
    for (int i = 0; i < 3; i++) {
        travel[i] = linear[i] + (bend * once[i] + rest * twice[i]);
    }
    pose_rotate(&from->orientation, travel, away);
    const pose_quaternion by = {sine * turn[0], sine * turn[1], sine * turn[2], cosine};
    pose_base to;
    for (int i = 0; i < 3; i++) {
        to.position[i] = from->position[i] + away[i];
    }
    to.orientation = pose_nearly_unit_(pose_after(from->orientation, by));
    return to;
}

/* The step in the axes of the first pose that leads to the second, the shorter way round, in m over
 * rad: the logarithm of SE(3), and the inverse of pose_integrate. The orientations have length 1
 * within 1e-8. Each entry of the turn errs by less than 16 u rad, and each of the linear part by less than
 * 32 u of the longest position. */
POSE_FUNCTION void pose_difference(const pose_base *from, const pose_base *to, POSE_REAL step[6]) {
    const pose_quaternion q = from->orientation, back = {-q.x, -q.y, -q.z, q.w};
    pose_quaternion between = pose_nearly_unit_(pose_after(back, to->orientation));
    if (between.w < 0) {
        between.x = -between.x, between.y = -between.y, between.z = -between.z;
        between.w = -between.w;
    }
    const POSE_REAL k = (POSE_REAL)1 / ((POSE_REAL)1 + between.w);
    const POSE_REAL u[3] = {k * between.x, k * between.y, k * between.z};
    const POSE_REAL x = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    /* Gauss's continued fraction of atan. */
    POSE_REAL over = 47, under = 1;
    for (int n = 22; n >= 1; n--) {
        const POSE_REAL next = (POSE_REAL)(2 * n + 1) * over + (POSE_REAL)((n + 1) * (n + 1)) * x * under;
        under = over;
        over = next;
    }
    const POSE_REAL whole = over + x * under, angle = over / whole, rest = under / whole;
    POSE_REAL difference[3], away[3], once[3], twice[3];
    for (int i = 0; i < 3; i++) {
        difference[i] = to->position[i] - from->position[i];
    }
    pose_rotate_back(&q, difference, away);
    pose_cross_(u, away, once);
    pose_cross_(u, once, twice);
    for (int i = 0; i < 3; i++) {
        step[i] = (away[i] - (POSE_REAL)2 * angle * once[i]) + (angle + rest) * twice[i];
        step[3 + i] = (POSE_REAL)4 * angle * u[i];
    }
}

/* The velocity (v, w) of the base, which generated functions take, in other axes. */
POSE_FUNCTION void pose_velocity_in(const pose_base *pose, pose_axes axes,
                                    const POSE_REAL velocity[6], POSE_REAL result[6]) {
    POSE_REAL linear[3], angular[3] = {velocity[3], velocity[4], velocity[5]}, lever[3] = {0, 0, 0};
    pose_rotate(&pose->orientation, velocity, linear);
    if (axes != POSE_SPLIT) {
        pose_rotate(&pose->orientation, velocity + 3, angular);
    }
    if (axes == POSE_WORLD) {
        pose_cross_(pose->position, angular, lever);
    }
    for (int i = 0; i < 3; i++) {
        result[i] = linear[i] + lever[i];
        result[3 + i] = angular[i];
    }
}

/* The velocity in the base's axes from that in other axes. */
POSE_FUNCTION void pose_velocity_from(const pose_base *pose, pose_axes axes,
                                      const POSE_REAL velocity[6], POSE_REAL result[6]) {
    const POSE_REAL angular[3] = {velocity[3], velocity[4], velocity[5]};
    POSE_REAL linear[3], lever[3] = {0, 0, 0}, turned[3] = {angular[0], angular[1], angular[2]};
    if (axes == POSE_WORLD) {
        pose_cross_(pose->position, angular, lever);
    }
    for (int i = 0; i < 3; i++) {
        linear[i] = velocity[i] - lever[i];
    }
    if (axes != POSE_SPLIT) {
        pose_rotate_back(&pose->orientation, angular, turned);
    }
    pose_rotate_back(&pose->orientation, linear, result);
    for (int i = 0; i < 3; i++) {
        result[3 + i] = turned[i];
    }
}

/* w x v where the point moves with the base; at the world's origin the two parts of it cancel. */
POSE_FUNCTION void pose_turning_(pose_axes axes, const POSE_REAL velocity[6], POSE_REAL result[3]) {
    result[0] = result[1] = result[2] = 0;
    if (axes != POSE_WORLD) {
        pose_cross_(velocity + 3, velocity, result);
    }
}

/* The rate of the velocity in other axes from the rate of (v, w) in the base's axes, and (v, w). It is
 * not a rotation: in mixed axes the linear part is R (dv/dt + w x v). */
POSE_FUNCTION void pose_acceleration_in(const pose_base *pose, pose_axes axes,
                                        const POSE_REAL velocity[6],
                                        const POSE_REAL acceleration[6], POSE_REAL result[6]) {
    POSE_REAL turning[3], whole[6];
    pose_turning_(axes, velocity, turning);
    for (int i = 0; i < 3; i++) {
        whole[i] = acceleration[i] + turning[i];
        whole[3 + i] = acceleration[3 + i];
    }
    pose_velocity_in(pose, axes, whole, result);
}

/* The rate of (v, w) in the base's axes from that of the velocity in other axes, and (v, w). */
POSE_FUNCTION void pose_acceleration_from(const pose_base *pose, pose_axes axes,
                                          const POSE_REAL velocity[6],
                                          const POSE_REAL acceleration[6], POSE_REAL result[6]) {
    POSE_REAL turning[3], whole[6];
    pose_turning_(axes, velocity, turning);
    pose_velocity_from(pose, axes, acceleration, whole);
    for (int i = 0; i < 3; i++) {
        result[i] = whole[i] - turning[i];
        result[3 + i] = whole[3 + i];
    }
}

#endif
