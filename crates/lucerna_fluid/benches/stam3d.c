/* Stable fluids in three dimensions, written plainly, as the yardstick of against_stam.
 *
 * Mode 0, the full step: velocity and density at cell centres, implicit diffusion of all four
 * and two projections, each by 20 Gauss-Seidel sweeps in the order of the cells, semi-Lagrangian
 * advection with a straight trace. After J. Stam, "Real-Time Fluid Dynamics for Games", GDC
 * 2003, widened to 3D.
 * Mode 1: the same with red-black sweeps, whose cells do not wait for one another.
 * Mode 2, the lean step: no diffusion, one trace for velocity and density together, one
 * projection of 20 red-black sweeps.
 * Mode 3, as mode 0 with the six neighbours summed in Stam's order. There the one that has just
 * been written comes first, so that each cell waits for the one before through all additions,
 * which takes more than half as long again; mode 0 takes it last.
 *
 * x is the innermost loop and the fastest index.
 *
 * Arguments: mode, cells per axis, number of steps. Prints the shortest step in milliseconds,
 * then the greatest velocity, which keeps the work from being optimised away. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SWEEPS 20

enum { FULL, RED_BLACK, LEAN, AS_PRINTED };

static int mode, n;
static size_t row, plane, total;

#define AT(i, j, k) ((size_t)(i) + row * (size_t)(j) + plane * (size_t)(k))
#define EACH_CELL                        \
    for (int k = 1; k <= n; k++)         \
        for (int j = 1; j <= n; j++)     \
            for (int i = 1; i <= n; i++)

/* The layer of cells around the box. `mirrored` is the axis (1, 2, 3) whose sign turns. */
static void set_sides(int mirrored, float *x) {
    float sx = mirrored == 1 ? -1.0f : 1.0f;
    float sy = mirrored == 2 ? -1.0f : 1.0f;
    float sz = mirrored == 3 ? -1.0f : 1.0f;
    for (int a = 1; a <= n; a++) {
        for (int b = 1; b <= n; b++) {
            x[AT(0, b, a)] = sx * x[AT(1, b, a)];
            x[AT(n + 1, b, a)] = sx * x[AT(n, b, a)];
            x[AT(b, 0, a)] = sy * x[AT(b, 1, a)];
            x[AT(b, n + 1, a)] = sy * x[AT(b, n, a)];
            x[AT(b, a, 0)] = sz * x[AT(b, a, 1)];
            x[AT(b, a, n + 1)] = sz * x[AT(b, a, n)];
        }
    }
}

static void relax_in_order(float *x, const float *x0, float a, float c) {
    EACH_CELL {
        size_t p = AT(i, j, k);
        float around = x[p + 1] + x[p - row] + x[p + row] + x[p - plane] + x[p + plane] + x[p - 1];
        x[p] = (x0[p] + a * around) / c;
    }
}

static void relax_as_printed(float *x, const float *x0, float a, float c) {
    EACH_CELL {
        size_t p = AT(i, j, k);
        float around = x[p - 1] + x[p + 1] + x[p - row] + x[p + row] + x[p - plane] + x[p + plane];
        x[p] = (x0[p] + a * around) / c;
    }
}

static void relax_red_black(float *restrict x, const float *restrict x0, float a, float c) {
    float share = 1.0f / c;
    for (int colour = 0; colour < 2; colour++)
        for (int k = 1; k <= n; k++)
            for (int j = 1; j <= n; j++)
                for (int i = 1 + ((j + k + colour) & 1); i <= n; i += 2) {
                    size_t p = AT(i, j, k);
                    float around = x[p - 1] + x[p + 1] + x[p - row] + x[p + row] + x[p - plane] + x[p + plane];
                    x[p] = (x0[p] + a * around) * share;
                }
}

static void relax(int mirrored, float *x, const float *x0, float a, float c) {
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        if (mode == FULL)
            relax_in_order(x, x0, a, c);
        else if (mode == AS_PRINTED)
            relax_as_printed(x, x0, a, c);
        else
            relax_red_black(x, x0, a, c);
        set_sides(mirrored, x);
    }
}

static void diffuse(int mirrored, float *x, const float *x0, float rate, float dt) {
    float a = dt * rate * (float)n * (float)n;
    relax(mirrored, x, x0, a, 1.0f + 6.0f * a);
}

static float clamp_to_box(float x) {
    float high = (float)n + 0.5f;
    return x < 0.5f ? 0.5f : x > high ? high : x;
}

static float sample(const float *q, float fx, float fy, float fz) {
    float c00 = q[0] + fx * (q[1] - q[0]);
    float c10 = q[row] + fx * (q[row + 1] - q[row]);
    float c01 = q[plane] + fx * (q[plane + 1] - q[plane]);
    float c11 = q[plane + row] + fx * (q[plane + row + 1] - q[plane + row]);
    float near_ = c00 + fy * (c10 - c00), far_ = c01 + fy * (c11 - c01);
    return near_ + fz * (far_ - near_);
}

/* Carries `fields` fields along one trace. */
static void advect(int fields, float *const *d, float *const *d0, const float *u, const float *v, const float *w,
                   float dt) {
    float step = dt * (float)n;
    EACH_CELL {
        size_t p = AT(i, j, k);
        float x = clamp_to_box((float)i - step * u[p]);
        float y = clamp_to_box((float)j - step * v[p]);
        float z = clamp_to_box((float)k - step * w[p]);
        int x0 = (int)x, y0 = (int)y, z0 = (int)z;
        size_t from = AT(x0, y0, z0);
        for (int field = 0; field < fields; field++)
            d[field][p] = sample(d0[field] + from, x - (float)x0, y - (float)y0, z - (float)z0);
    }
}

static void advect_one(int mirrored, float *d, float *d0, const float *u, const float *v, const float *w, float dt) {
    advect(1, &d, &d0, u, v, w, dt);
    set_sides(mirrored, d);
}

static void project(float *restrict u, float *restrict v, float *restrict w, float *restrict p,
                    float *restrict divergence) {
    float h = 1.0f / (float)n;
    EACH_CELL {
        size_t c = AT(i, j, k);
        divergence[c] = -0.5f * h * (u[c + 1] - u[c - 1] + v[c + row] - v[c - row] + w[c + plane] - w[c - plane]);
        p[c] = 0.0f;
    }
    set_sides(0, divergence);
    set_sides(0, p);
    relax(0, p, divergence, 1.0f, 6.0f);
    EACH_CELL {
        size_t c = AT(i, j, k);
        u[c] -= 0.5f * (p[c + 1] - p[c - 1]) / h;
        v[c] -= 0.5f * (p[c + row] - p[c - row]) / h;
        w[c] -= 0.5f * (p[c + plane] - p[c - plane]) / h;
    }
    set_sides(1, u);
    set_sides(2, v);
    set_sides(3, w);
}

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

int main(int count, char **arguments) {
    if (count < 4) return 2;
    mode = atoi(arguments[1]);
    n = atoi(arguments[2]);
    int steps = atoi(arguments[3]);
    if (mode < FULL || mode > AS_PRINTED || n < 2 || n > 256) return 2;
    row = (size_t)n + 2;
    plane = row * row;
    total = plane * row;
    float *arrays = calloc(8 * total, sizeof(float));
    if (!arrays) return 1;
    float *u = arrays, *v = u + total, *w = v + total, *d = w + total;
    float *u0 = d + total, *v0 = u0 + total, *w0 = v0 + total, *d0 = w0 + total;
    float dt = 1.0f / 60.0f, viscosity = 1.5e-5f, best = 1e30f;
    int middle = (n + 1) / 2, low = 1 + n / 10;
    for (int step = 0; step < steps; step++) {
        double start = now_ms();
        /* Sources: a hot spot near the floor, and buoyancy. */
        d[AT(middle, low, middle)] += 100.0f * dt;
        if (mode == LEAN) {
            float *to[4] = {u0, v0, w0, d0}, *from[4] = {u, v, w, d};
            advect(4, to, from, u, v, w, dt);
            EACH_CELL v0[AT(i, j, k)] += dt * d0[AT(i, j, k)];
            set_sides(1, u0);
            set_sides(2, v0);
            set_sides(3, w0);
            set_sides(0, d0);
            project(u0, v0, w0, u, v); /* The old velocity serves as working space. */
            for (int field = 0; field < 4; field++) {
                float *other = to[field];
                to[field] = from[field];
                from[field] = other;
            }
            u = from[0], v = from[1], w = from[2], d = from[3];
            u0 = to[0], v0 = to[1], w0 = to[2], d0 = to[3];
        } else {
            EACH_CELL v[AT(i, j, k)] += dt * d[AT(i, j, k)];
            diffuse(1, u0, u, viscosity, dt);
            diffuse(2, v0, v, viscosity, dt);
            diffuse(3, w0, w, viscosity, dt);
            project(u0, v0, w0, u, v);
            advect_one(1, u, u0, u0, v0, w0, dt);
            advect_one(2, v, v0, u0, v0, w0, dt);
            advect_one(3, w, w0, u0, v0, w0, dt);
            project(u, v, w, u0, v0);
            diffuse(0, d0, d, viscosity, dt);
            advect_one(0, d, d0, u, v, w, dt);
        }
        float taken = (float)(now_ms() - start);
        if (taken < best) best = taken;
    }
    float fastest = 0.0f;
    for (size_t p = 0; p < total; p++) fastest = fmaxf(fastest, fabsf(v[p]));
    printf("%.6f %.4f\n", (double)best, (double)fastest);
    free(arrays);
    return 0;
}
