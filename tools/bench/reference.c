/* The scheme of hydro1d as a C programmer would write it for one column: one fused loop over nodes and one over zones, in
   blocks that stay in the first-level cache, every law inlined into its loop. A yardstick for `hydro1d bench`, not part of
   the solver. A pressure (rectangular in time) on the left, a wall on the right. Build with
   cc -O3 -march=native -ffast-math -fPIC -shared. */

#include <math.h>
#include <stdint.h>
#ifdef __SSE2__
#include <immintrin.h>
#endif

#define BLOCK 512
#define INLINE static inline __attribute__((always_inline))

enum { EPPH, EPPH_TANGENT, RPH, TABLE, IDEAL_GAS, POWER };

typedef struct { /* one layer; all of it doubles and 64-bit integers, as hydro1d/benchmarks/reference.py fills it */
    int64_t law, first, zones, points;
    double size, density, linear, smooth_linear, quadratic;
    double modulus, yield_strain, plateau, densification, least_unloading;
    double hardening_strain, slowness, locks;
    double a, b, c, d; /* the law's own */
    const double *strains, *stresses, *slopes;
} Layer;

typedef struct {
    double time, last_step, free_step, next_step, stop, cfl;
    double peak, duration;
    double work, viscous_work, top_stress, top_left, top_right, top_strain;
} Ledger;

INLINE double larger(double a, double b) { return a > b ? a : b; }
INLINE double smaller(double a, double b) { return a < b ? a : b; }

/* Stress and tangent of the first loading. */
INLINE void loading(const int64_t law, const Layer *m, double strain, double *stress, double *tangent) {
    if (law == RPH) {
        double inverse = 1.0 / (1.0 - strain), scale = m->a * inverse * inverse;
        int elastic = strain <= m->yield_strain;
        *stress = elastic ? m->modulus * strain : m->plateau + scale * strain;
        *tangent = elastic ? m->modulus : scale * (1.0 + strain) * inverse;
    } else if (law == TABLE) {
        int64_t low = 0, high = m->points;
        while (high - low > 1) {
            int64_t middle = (low + high) / 2;
            if (strain >= m->strains[middle]) low = middle; else high = middle;
        }
        *stress = m->stresses[low] + m->slopes[low] * (strain - m->strains[low]);
        *tangent = m->slopes[low];
    } else if (law == POWER) { /* a hardening, b exponent, c strain at yield */
        double over = larger(strain - m->c, 0.0), power = pow(over, m->b - 1.0);
        int elastic = strain <= m->c;
        *stress = elastic ? m->modulus * strain : m->plateau + m->a * over * power;
        *tangent = elastic ? m->modulus : m->b * m->a * power;
    } else {
        double over = larger(strain - m->densification, 0.0), extra, slope;
        if (law == EPPH) { /* a shock slope */
            double inverse = 1.0 / (over + m->densification - m->yield_strain);
            extra = m->density * (over / m->a) * (over / m->a) * inverse;
            slope = (2.0 * m->density / (m->a * m->a) * over - extra) * inverse;
        } else { /* a σP β, b angle per strain, c angle left, d tangent at densification */
            double t = tan(0.5 * 3.14159265358979323846 - m->c + m->b * over);
            extra = m->a * (t - m->d);
            slope = m->a * m->b * (1.0 + t * t);
        }
        *stress = smaller(m->modulus * strain, m->plateau) + (over > 0.0 ? extra : 0.0);
        *tangent = over > 0.0 ? slope : (strain <= m->yield_strain ? m->modulus : 0.0);
    }
}

INLINE void zone_loop(const int64_t law, const Layer *given, int64_t first, int64_t last, double step, double kick,
                      const double *restrict v, const double *restrict w, const double *restrict u,
                      const double *restrict settled, double *restrict e, double *restrict f, double *restrict top,
                      double *out) {
    const Layer own = *given, *m = &own; /* no store can change a copy, so its members stay in registers */
    const double per_size = 1.0 / m->size, per_density = 1.0 / m->density, work = per_size * per_density;
    double most_stiff = out[0], most_speed = out[1], most_stress = out[2], most_strain = out[3], power = 0.0;
    for (int64_t i = first; i < last; i++) {
        double jump = v[i + 1] - v[i + 2], before = w[i + 1] - w[i + 2];
        double strain = (u[i] - u[i + 1]) * per_size, largest = larger(top[i], strain);
        double energy = e[i] + 0.5 * kick * work * f[i] * (before + jump);
        e[i] = energy;
        double stress, tangent, stiffness, room;
        int smooth = 1;
        if (law == IDEAL_GAS) { /* a gamma; the energy is what was settled and what was gained since */
            double inverse = 1.0 / (1.0 - strain);
            double now = settled[i] + energy + 0.5 * step * work * f[i] * jump;
            stress = (m->a - 1.0) * m->density * inverse * now;
            stiffness = tangent = m->a * stress * inverse;
        } else {
            loading(law, m, largest, &stress, &tangent);
            smooth = largest <= m->yield_strain;
            stiffness = smooth ? m->modulus : larger(m->least_unloading, tangent);
            stress = larger(stress - stiffness * (largest - strain), 0.0);
        }
        double left = v[i] - v[i + 1], right = v[i + 2] - v[i + 3];
        double both = larger(left, 0.0) * larger(right, 0.0), span = left + right;
        double shared = smaller(both * span / (span * span - 2.0 * both + 1e-300), larger(jump, 0.0));
        double closing = larger(jump, 0.0) - (smooth ? shared : 0.0);
        room = 1.0 - strain;
        if (law == IDEAL_GAS) {
            room *= 8.0 / (m->a + 1.0);
        } else {
            double beyond = smaller(m->hardening_strain, closing * m->slowness + 1e-30);
            double locked = larger(m->densification - strain, 0.0) + beyond;
            room = smaller(room, m->locks > 0.0 ? locked : 1.0);
        }
        double crowding = m->quadratic * closing / room;
        double speed = (smooth ? m->smooth_linear : m->linear) * sqrt(tangent * per_density) + crowding;
        int parted = law != IDEAL_GAS && stress <= 0.0; /* an open gap that closes feels nothing */
        double viscosity = parted ? 0.0 : m->density * closing * speed;
        top[i] = largest;
        f[i] = stress + viscosity;
        power += viscosity * (1.5 * jump - 0.5 * before);
        most_stiff = larger(most_stiff, stiffness);
        most_speed = larger(most_speed, speed + crowding);
        most_stress = larger(most_stress, stress);
        most_strain = larger(most_strain, strain);
    }
    out[0] = most_stiff, out[1] = most_speed, out[2] = most_stress, out[3] = most_strain, out[4] += power;
}

#define LOOP(NAME) \
    static __attribute__((noinline)) void loop_##NAME( \
        const Layer *m, int64_t first, int64_t last, double step, double kick, const double *restrict v, \
        const double *restrict w, const double *restrict u, const double *restrict settled, double *restrict e, \
        double *restrict f, double *restrict top, double *out) { \
        zone_loop(NAME, m, first, last, step, kick, v, w, u, settled, e, f, top, out); \
    }
LOOP(EPPH) LOOP(EPPH_TANGENT) LOOP(RPH) LOOP(TABLE) LOOP(IDEAL_GAS) LOOP(POWER)

typedef void (*Loop)(const Layer *, int64_t, int64_t, double, double, const double *, const double *, const double *,
                     const double *, double *, double *, double *, double *);
static const Loop loops[] = {loop_EPPH, loop_EPPH_TANGENT, loop_RPH, loop_TABLE, loop_IDEAL_GAS, loop_POWER};

static __attribute__((noinline)) void node_loop(int64_t first, int64_t last, double step, double kick,
                                                double *restrict v, const double *restrict w, double *restrict u,
                                                const double *restrict f, const double *restrict im) {
    for (int64_t i = first; i < last; i++) {
        v[i + 1] = w[i + 1] + kick * (f[i - 1] - f[i]) * im[i];
        u[i] += step * v[i + 1];
    }
}

static double pressure(const Ledger *g, double time) { return time < g->duration ? g->peak : 0.0; }

/* `steps` steps. Velocities (node i at i + 1, ghosts at the ends) are in `v` before and after; `w` is room to work in;
   `e` is the energy gained since `settled`. */
void march(Ledger *g, const Layer *layers, int64_t layer_count, int64_t zones, int64_t steps, double *v, double *w,
           double *u, const double *settled, double *e, double *f, double *top, const double *mass, const double *im) {
#ifdef __SSE2__
    unsigned int control = _mm_getcsr();
    _mm_setcsr(control | 0x8040); /* numbers below 1e-308 count as zero: they are slow */
#endif
    double *after = w, *before = v;
    for (int64_t taken = 0; taken < steps; taken++) {
        double step = smaller(g->next_step, 1.1 * g->free_step), left = g->stop - g->time;
        g->free_step = step;
        if (step >= left) step = left; else if (2.0 * step > left) step = 0.5 * left;
        double kick = 0.5 * (g->last_step + step), last_step = g->last_step;

        double push = (pressure(g, g->time - 0.25 * last_step) * last_step + pressure(g, g->time + 0.25 * step) * step) /
                      (last_step + step);
        after[1] = before[1] + kick * (push - f[0]) / mass[0];
        g->work += push * 0.5 * (before[1] + after[1]) * kick;
        after[zones + 1] = 0.0;
        u[0] += step * after[1];

        double stable = INFINITY, strain = 0.0;
        int64_t node = 1;
        for (int64_t k = 0; k < layer_count; k++) {
            const Layer *m = layers + k;
            double out[5] = {0.0, 0.0, g->top_stress, g->top_strain, 0.0};
            for (int64_t start = m->first; start < m->first + m->zones; start += BLOCK) {
                int64_t end = start + BLOCK < m->first + m->zones ? start + BLOCK : m->first + m->zones;
                int64_t ahead = end + 2 < zones ? end + 2 : zones;
                node_loop(node, ahead, step, kick, after, before, u, f, im);
                if (ahead > node) node = ahead;
                after[0] = after[2], after[zones + 2] = after[zones];
                loops[m->law](m, start, end, step, kick, after, before, u, settled, e, f, top, out);
            }
            double d = out[1];
            stable = smaller(stable, m->size / (sqrt(out[0] / m->density + d * d) + d));
            g->top_stress = out[2], strain = larger(strain, out[3]);
            g->viscous_work += out[4] * step;
        }
        g->top_strain = larger(g->top_strain, strain);
        double *swap = before;
        before = after, after = swap;
        g->time = step >= left ? g->stop : g->time + step;
        g->last_step = step;
        g->next_step = g->cfl * stable;
        g->top_left = larger(g->top_left, f[0]), g->top_right = larger(g->top_right, f[zones - 1]);
    }
    if (before != v)
        for (int64_t i = 0; i < zones + 3; i++) v[i] = before[i];
#ifdef __SSE2__
    _mm_setcsr(control);
#endif
}
