/* Stable fluids in three dimensions the classic way, as the yardstick of against_stam.rs:
 * velocity and density at cell centres, implicit diffusion and two projections a step by 20
 * Gauss-Seidel sweeps in the order of the cells, semi-Lagrangian advection with a straight
 * trace. After J. Stam, "Real-Time Fluid Dynamics for Games", GDC 2003, widened to 3D.
 *
 * Arguments: cells per axis, number of steps. Prints the shortest step in milliseconds, then
 * the greatest velocity, which keeps the work from being optimised away. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SWEEPS 20

static int n;
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

static void relax(int mirrored, float *x, const float *x0, float a, float c) {
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        EACH_CELL {
            size_t p = AT(i, j, k);
            float around = x[p - 1] + x[p + 1] + x[p - row] + x[p + row] + x[p - plane] + x[p + plane];
            x[p] = (x0[p] + a * around) / c;
        }
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

static void advect(int mirrored, float *d, const float *d0, const float *u, const float *v, const float *w, float dt) {
    float step = dt * (float)n;
    EACH_CELL {
        size_t p = AT(i, j, k);
        float x = clamp_to_box((float)i - step * u[p]);
        float y = clamp_to_box((float)j - step * v[p]);
        float z = clamp_to_box((float)k - step * w[p]);
        int x0 = (int)x, y0 = (int)y, z0 = (int)z;
        float fx = x - (float)x0, fy = y - (float)y0, fz = z - (float)z0;
        const float *q = d0 + AT(x0, y0, z0);
        float c00 = q[0] + fx * (q[1] - q[0]);
        float c10 = q[row] + fx * (q[row + 1] - q[row]);
        float c01 = q[plane] + fx * (q[plane + 1] - q[plane]);
        float c11 = q[plane + row] + fx * (q[plane + row + 1] - q[plane + row]);
        float near_ = c00 + fy * (c10 - c00), far_ = c01 + fy * (c11 - c01);
        d[p] = near_ + fz * (far_ - near_);
    }
    set_sides(mirrored, d);
}

static void project(float *u, float *v, float *w, float *p, float *divergence) {
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
    if (count < 3) return 2;
    n = atoi(arguments[1]);
    int steps = atoi(arguments[2]);
    if (n < 2 || n > 256) return 2;
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
        EACH_CELL v[AT(i, j, k)] += dt * d[AT(i, j, k)];
        diffuse(1, u0, u, viscosity, dt);
        diffuse(2, v0, v, viscosity, dt);
        diffuse(3, w0, w, viscosity, dt);
        project(u0, v0, w0, u, v);
        advect(1, u, u0, u0, v0, w0, dt);
        advect(2, v, v0, u0, v0, w0, dt);
        advect(3, w, w0, u0, v0, w0, dt);
        project(u, v, w, u0, v0);
        diffuse(0, d0, d, viscosity, dt);
        advect(0, d, d0, u, v, w, dt);
        float taken = (float)(now_ms() - start);
        if (taken < best) best = taken;
    }
    float fastest = 0.0f;
    for (size_t p = 0; p < total; p++) fastest = fmaxf(fastest, fabsf(v[p]));
    printf("%.6f %.4f\n", (double)best, (double)fastest);
    free(arrays);
    return 0;
}
