/* Pelagic for C and for whatever can call C: an open sea on CPU jobs and SIMD.
 *
 *   pelagic_sea sea = {.struct_size = sizeof sea};
 *   pelagic_frame frame = {.struct_size = sizeof frame};
 *   pelagic_ocean* ocean;
 *   pelagic_sea_defaults(&sea);
 *   sea.wind_speed_mps = 9;
 *   if (pelagic_ocean_create(&sea, NULL, &ocean) != PELAGIC_OK) die(pelagic_last_error());
 *   pelagic_ocean_schedule(ocean, 0);
 *   for (t = 0; drawing; t += 1.0 / 90) {
 *       pelagic_ocean_complete(ocean, &frame);           // the frame scheduled last
 *       pelagic_ocean_schedule(ocean, t + 1.0 / 90);     // the next is computed while this one is drawn
 *       for (i = 0; i < frame.cascade_count; ++i) {
 *           pelagic_cascade cascade = {.struct_size = sizeof cascade};
 *           pelagic_ocean_cascade(ocean, i, &cascade);         // of the frame completed last
 *           upload(cascade.displacement_rgba16f, cascade.slopes_rgba8, cascade.moments_rgba8);
 *       }
 *   }
 *   pelagic_ocean_destroy(ocean);
 *
 * The sea is the one of the C++ interface, bit for bit.
 *
 * Conventions. SI units, named in each field; right-handed, +y up, rest level y = 0; angles in radians; time in seconds.
 *
 * Errors. Every function that can fail returns a pelagic_status. Unless that is PELAGIC_OK, nothing was written through the
 * other arguments (but a handle that was not created is NULL), nothing has changed, and pelagic_last_error() has one line.
 * No exception crosses this interface. A NULL handle, or a NULL pointer that is not said to be optional, is
 * PELAGIC_INVALID_ARGUMENT. A handle that was destroyed, or a pointer to less memory than stated, can't be found out:
 * undefined.
 *
 * Structs. Each begins with struct_size, which the caller sets to sizeof before any call. Later versions add fields at
 * the end only, never into padding, and any size from that of a struct's first version to 4096 bytes is taken. Of an older, smaller
 * struct what is missing counts as 0 and is not written; of a newer, larger one what this library doesn't know has to be 0
 * where it is read, which tells that the application can do without it, and is set to 0 where it is written. Any other size is
 * PELAGIC_INVALID_ARGUMENT, and so is anything but 0 in a reserved field that the library reads.
 *
 * Threads. One thread at a time uses an ocean, and different oceans may be used side by side. Exceptions are the queries
 * (pelagic_ocean_query, _first_hit): any number of threads at once, also while that one thread schedules and completes
 * frames. An executor may be shared by oceans on any threads.
 *
 * Ownership. The caller destroys what pelagic_..._create made, in any order: an ocean keeps its executor alive. What a
 * pelagic_frame points to belongs to the ocean. Strings that are returned live as long as the library, but for the one of
 * pelagic_last_error().
 *
 * No allocation is made by schedule, poll, complete and queries after an ocean's first frame, unless its weather changes or more
 * is said of dynamic waves than ever before. What is as large as a frame
 * or a spectrum comes from pelagic_ocean_options.allocate, if that is there. */
#ifndef PELAGIC_PELAGIC_H
#define PELAGIC_PELAGIC_H

#include <stddef.h>
#include <stdint.h>

/* What the shared library exports. PELAGIC_STATIC is for applications that link libpelagic.a; PELAGIC_BUILDING is Pelagic's own. */
#if defined(PELAGIC_STATIC)
#define PELAGIC_API
#elif defined(_WIN32) || defined(__CYGWIN__)
#if defined(PELAGIC_BUILDING)
#define PELAGIC_API __declspec(dllexport)
#else
#define PELAGIC_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define PELAGIC_API __attribute__((visibility("default")))
#else
#define PELAGIC_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define PELAGIC_VERSION_MAJOR 0
#define PELAGIC_VERSION_MINOR 1
#define PELAGIC_VERSION_PATCH 0

/* The library's version, which may be later than the header's: major * 10000 + minor * 100 + patch. */
PELAGIC_API uint32_t pelagic_version(void);

typedef int32_t pelagic_status;
enum {
    PELAGIC_OK = 0,
    PELAGIC_INVALID_ARGUMENT = 1, /* a value, handle, size or pointer that can't be used; the message names it */
    PELAGIC_WRONG_ORDER = 2,      /* not now: for instance a second schedule without complete. Nothing has changed */
    PELAGIC_OUT_OF_MEMORY = 3,
    PELAGIC_SYSTEM_ERROR = 4,   /* the system has no more threads to give */
    PELAGIC_INTERNAL_ERROR = 5, /* a mistake of Pelagic's: please report the message */
    PELAGIC_APPLICATION_ERROR = 6      /* a callback of the application threw, or returned too early; the message says which */
};

/* Why the last call on this thread that failed did so: one line, "wind_speed_mps is -3, needs (0, 60]", less than 300 bytes
 * of UTF-8 without control characters. Empty before the first failure; success leaves it as it is. Valid until the next
 * failure on this thread. */
PELAGIC_API const char* pelagic_last_error(void);

/* Told of each failure, on the thread of the call that is about to return it; `message` is pelagic_last_error(). May call
 * Pelagic, but for what it is told of; what it throws is dropped. */
typedef void (*pelagic_error_callback)(void* user, pelagic_status status, const char* message);

/* One for the process, whatever thread fails; NULL for none, as at first. Calls that are under way may still use the one
 * before. */
PELAGIC_API void pelagic_set_error_callback(pelagic_error_callback callback, void* user);

/* ---- The sea ---------------------------------------------------------------------------------------------------- */

enum {
    PELAGIC_SPECTRUM_PHILLIPS_PAPER = 0,
    PELAGIC_SPECTRUM_PHILLIPS = 1,
    PELAGIC_SPECTRUM_PIERSON_MOSKOWITZ = 2,
    PELAGIC_SPECTRUM_JONSWAP = 3
};

enum {
    PELAGIC_WAVES_SPECTRUM = 0,
    PELAGIC_WAVES_ANALYTIC = 1,
    PELAGIC_WAVES_POND = 2
};

enum {
    PELAGIC_SPREADING_PAPER = 0,
    PELAGIC_SPREADING_COSINE_2S = 1,
    PELAGIC_SPREADING_HASSELMANN = 2,
    PELAGIC_SPREADING_DONELAN_BANNER = 3
};

/* What sea is wanted. Two machines with the same values and the same Pelagic have the same sea at the same time. */
typedef struct pelagic_sea {
    uint32_t struct_size;
    int32_t spectrum;      /* PELAGIC_SPECTRUM_... */
    int32_t resolution;    /* N, texels along a cascade; a power of two, 16 to 2048. 0: 128, with a patch_size_m 256 */
    uint32_t seed;         /* which sea of this kind */
    double patch_size_m;   /* the side of the one cascade; [0.001, 1e6]. 0: sides chosen from the sea */
    double wind_speed_mps; /* mean wind 10 m above the sea; (0, 60] */
    double wind_direction_rad; /* where the wind blows towards, from +x towards +z; [-2 pi, 2 pi] */
    double fetch_m;            /* how far the wind has blown over water (jonswap), 17,000 U10^2/g counts at most; (0, 2e6] */
    double depth_m;            /* waves over 0.6 of it break; [0.01, 11000] */
    double choppiness;         /* 0 gives a height field; [0, 1] */
    double roughness;     /* of the water between texels, for the smoothness channel; [0, 1], or -1: from the wind */
    double short_wave_cutoff;   /* 0 keeps small waves, 1 removes those below a quarter of the peak's; [0, 1] */
    double wind_alignment;     /* with 0 a third of the energy runs against the wind, with 1 a hundredth; [0, 1] */
    double loop_period_s; /* T, the sea repeats exactly after this time; [0.1, 86400] */
    /* Newer than the fields above. */
    int32_t spreading;          /* PELAGIC_SPREADING_...; the spectrum phillips-paper takes no other than paper */
    uint32_t reserved;          /* 0 */
    double swell_height_m;      /* significant height of waves from elsewhere; 0: none; [0, 30] */
    double swell_period_s;      /* at which their spectrum peaks; 0: 12, else [1, 40] */
    double swell_direction_rad; /* where they run towards, as wind_direction_rad */
    double swell_spread_rad;    /* standard deviation of their directions; 0: 15 degrees, else [pi/180, 4 pi/9] */
    /* How many cascades hold the waves, each a band of them; 1 to 4. 0: chosen, four, or one where patch_size_m is set, where the
     * resolution is 16 or the spectrum phillips-paper. More than one takes no patch_size_m. An application whose struct ends before
     * it has one cascade. */
    int32_t cascades;
    uint32_t reserved_1; /* 0 */
    /* Which waves: PELAGIC_WAVES_... A pond (pond) is one cascade. What follows is of the others than a spectrum, which alone
     * has spectrum, spreading, fetch_m, depth_m, short_wave_cutoff, wind_alignment, swell and seed. */
    int32_t waves;
    int32_t wave_count;     /* waves, or octaves of a pond; 1 to 64. 0: 16 or 24 */
    double longest_wave_m;  /* [0.02, 1000]. 0: 120, of a pond 1.2 */
    double shortest_wave_m; /* [0.01, 1000]. 0: a sixtieth of the longest, of a pond a 45th */
    double wave_strength;   /* 0 calm, 1 moderate, 2 intense, morphed in between; [0, 2] */
    double wave_height_m;   /* significant height; (0, 30]. 0: what the strength makes */
    double wave_drag;       /* how far a pond's long waves move its short ones; [0, 1] */
} pelagic_sea;

/* Sets every field but struct_size: resolution, patch_size_m and cascades to 0, which is chosen. An application whose struct ends before
 * `cascades` draws one cascade only and gets one: 256 texels on 250 m. */
PELAGIC_API pelagic_status pelagic_sea_defaults(pelagic_sea* sea);

/* The same for a sea state: "calm", "lake", "swell", "moderate", "rough" or "storm", or the open sea of a force of wind,
 * "beaufort-0" to "beaufort-12". The one cascade of an older application has 256 texels on a quarter of the side that the coarsest of the
 * sea's cascades would have. */
PELAGIC_API pelagic_status pelagic_sea_preset(const char* name, pelagic_sea* sea);

/* PELAGIC_OK if an ocean could be made of it, else the message names the first bad field. */
PELAGIC_API pelagic_status pelagic_sea_check(const pelagic_sea* sea);

/* Heights, periods and directions of a sea. `expected` is the mean over all seeds of the waves that the cascades hold; `drawn` is of the waves
 * that this seed drew, the mean over a loop. 0 where a sea has no such figure. */
typedef struct pelagic_statistics {
    uint32_t struct_size;
    uint32_t reserved;
    double expected_wave_height_m; /* significant, 4 sqrt(variance) */
    double drawn_wave_height_m;
    double model_wave_height_m;    /* of all waves that the options ask for; 0 for phillips-paper, which has no scale */
    double expected_peak_period_s; /* where the frequency spectrum peaks */
    double drawn_peak_period_s;    /* Young 1995; of a sea with a swell that of the higher peak's part */
    double peak_wavelength_m;
    double expected_tm01_s; /* m0 / m1, m_n = integral f^n S(f) df */
    double drawn_tm01_s;
    double expected_tm02_s; /* sqrt(m0 / m2), also the mean period of upward zero crossings */
    double drawn_tm02_s;
    double expected_direction_rad; /* where waves run towards, from +x towards +z, (-pi, pi] */
    double drawn_direction_rad;
    double expected_spread_rad; /* directional spread, [0, sqrt(2)] */
    double drawn_spread_rad;
    double slope_variance_along_wind; /* expected, of all cascades */
    double slope_variance_across_wind;
    double expected_convergence_variance; /* of Dx,x + Dz,z */
    double drawn_convergence_variance;
    double wind_sea_height_m;        /* expected; this and the next three of a spectrum with a swell */
    double wind_sea_peak_period_s;   /* expected */
    double swell_height_m;           /* expected */
    double swell_peak_period_s;      /* expected */
    double drawn_wind_sea_peak_period_s; /* likewise */
    double drawn_swell_peak_period_s;
    double effective_fetch_m; /* jonswap: the fetch that counts, at most 17,000 U10^2 / g */
    double repeats_after_m;   /* side of the coarsest cascade, after which the sea's long waves repeat */
} pelagic_statistics;

/* Sums over the spectrum of a sea: as long as creating an ocean of it takes. Thread-safe. PELAGIC_INVALID_ARGUMENT as
 * pelagic_sea_check(). */
PELAGIC_API pelagic_status pelagic_sea_statistics(const pelagic_sea* sea, pelagic_statistics* statistics);

/* ---- Where jobs run --------------------------------------------------------------------------------------------- */

enum {
    PELAGIC_EXECUTOR_DEFAULT = 0, /* oneTBB where the library was built with it, else threads */
    PELAGIC_EXECUTOR_SERIAL = 1,  /* no threads: complete() does the work */
    PELAGIC_EXECUTOR_THREADS = 2, /* a pool of its own */
    PELAGIC_EXECUTOR_TBB = 3,     /* PELAGIC_INVALID_ARGUMENT if built without */
    PELAGIC_EXECUTOR_APPLICATION = 4     /* the application's job system, through the callbacks below */
};

/* Calls job(work, i) once for each i in [0, count), on any threads, side by side or not, and returns when all are done.
 * Called several times a frame, from complete() or from a submitted task. Jobs need 512 KiB of stack, and
 * 1 MiB for N = 2048 (exact figures: docs/architecture.md, Memory); one that finds less takes a thread of its own, which is
 * slow. If it throws, or returns while jobs are left, those are done by Pelagic, and complete() returns
 * PELAGIC_APPLICATION_ERROR; that frame or sea is lost, the ocean is not. A job that is called twice, or after its loop has
 * returned, does nothing, as long as the ocean is there. */
typedef void (*pelagic_parallel_for)(void* user, size_t count, void (*job)(void* work, size_t index), void* work);

/* Calls task(work) once, on some other thread, soon; returns at once. A task may be called late, even after the ocean is
 * gone; called twice or never it does no harm. If this throws, complete() returns PELAGIC_APPLICATION_ERROR as above. */
typedef void (*pelagic_submit)(void* user, void (*task)(void* work), void* work);

typedef struct pelagic_executor_options {
    uint32_t struct_size;
    int32_t kind; /* PELAGIC_EXECUTOR_... */
    /* Most threads at work on a frame, the completing one included; 1 leaves all work to complete(). 0: one per core (for
     * threads with a mask, one per core of the mask; for an application, 1). [0, 1024] */
    int32_t threads;
    uint32_t reserved; /* 0 */
    /* PELAGIC_EXECUTOR_THREADS on Linux, Android and Windows: bit i allows CPU i to the pool's threads; 0 allows all. */
    uint64_t cpu_mask;
    pelagic_parallel_for parallel_for; /* PELAGIC_EXECUTOR_APPLICATION: must be there */
    pelagic_submit submit;             /* optional: without it complete() begins the work */
    void* user;                        /* handed to both; outlives every ocean of this executor */
} pelagic_executor_options;

typedef struct pelagic_executor pelagic_executor;

PELAGIC_API pelagic_status pelagic_executor_create(const pelagic_executor_options* options,
                                                   pelagic_executor** executor);

/* Oceans that use it keep what they need of it. NULL is ignored. */
PELAGIC_API void pelagic_executor_destroy(pelagic_executor* executor);

/* ---- The ocean -------------------------------------------------------------------------------------------------- */

/* `bytes`, more than 0, at a multiple of `alignment`, a power of two; NULL if there are none, which the call that needed them
 * returns as PELAGIC_OUT_OF_MEMORY. Called on the thread that creates an ocean or schedules another sea of it. */
typedef void* (*pelagic_allocate)(void* user, size_t bytes, size_t alignment);

/* Takes back what pelagic_allocate gave, with the same figures; on the thread that destroys an ocean, or schedules or
 * completes another sea. Must not throw. */
typedef void (*pelagic_release)(void* user, void* memory, size_t bytes, size_t alignment);

typedef struct pelagic_ocean_options {
    uint32_t struct_size;
    int32_t queries; /* not 0: frames can be asked about any point; N^2 / 8 bytes a cascade of a frame */
    int32_t
        velocities;    /* not 0: frames have velocities; 12 N^2 bytes a cascade of a frame, about twice the transforms */
    uint32_t reserved; /* 0 */
    const pelagic_executor* executor; /* NULL: PELAGIC_EXECUTOR_DEFAULT */
    const char* isa;          /* "sse4.2", "avx2", "avx512" or "neon"; NULL: PELAGIC_ISA, else the strongest */
    double query_tolerance_m; /* largest error of a converged point; 0: 0.001, else [1e-6, 1000] */
    /* Newer than the fields above. Both or neither; NULL: operator new. For spectra, planes, textures and maps, which is all that grows with
     * N^2. Tables, handles and graphs, some 100 KB, and what executors need, threads and oneTBB, come from operator new. */
    pelagic_allocate allocate;
    pelagic_release release;
    void* memory_user; /* handed to both; outlives the ocean */
    /* Newer still. */
    int32_t slopes;    /* not 0: a frame of one cascade has slopes and moments too; those of several always do */
    int32_t gradients; /* not 0: cascades of several have a gradient chain of their own too; those of one always do */
    /* Newer still. Not 0: frames remember foam. What breaks lasts for 2.9 seconds, fades and drifts. A frame then takes a tenth to a
     * fifth longer, one of a tick, ten times a second, another half or more, and a jump in time, which computes 29 ticks, as long as
     * ten to twenty frames. 5 N^2 bytes a cascade. With 0 the half floats hold only what breaks at that very moment. */
    int32_t foam;
    uint32_t reserved_1; /* 0 */
    /* Newer still. Dynamic waves beside the waves of the wind, see below; NULL: none. Read before the call returns. */
    const struct pelagic_dynamic_waves_options* dynamic_waves;
    /* Newer still. A floor that waves feel, see below; NULL: none. Read before the call returns. */
    const struct pelagic_shore_options* shore;
    /* Newer still. Waves that are added to those of the wind, in this order, see below; none of another ocean. The ocean keeps what it
     * needs of them. */
    size_t input_count;
    struct pelagic_input* const* inputs; /* `input_count` of them; may be NULL if that is 0 */
} pelagic_ocean_options;

typedef struct pelagic_ocean pelagic_ocean;

/* Bakes the spectrum. `options` may be NULL: all 0. */
PELAGIC_API pelagic_status pelagic_ocean_create(const pelagic_sea* sea, const pelagic_ocean_options* options,
                                                pelagic_ocean** ocean);

/* Waits for work in flight. No query may be under way. NULL is ignored. */
PELAGIC_API void pelagic_ocean_destroy(pelagic_ocean* ocean);

typedef struct pelagic_ocean_info {
    uint32_t struct_size;
    int32_t resolution; /* N, of each cascade */
    int32_t threads;    /* most that work on a frame */
    uint32_t reserved;
    uint64_t memory_bytes; /* all that the ocean allocated, two frames and the spectrum included */
    const char* isa;
    const char* executor; /* "serial", "thread", "tbb" or "application" */
    /* Newer than the fields above. */
    int32_t cascade_count; /* of every frame */
    uint32_t reserved_1;
} pelagic_ocean_info;

PELAGIC_API pelagic_status pelagic_ocean_describe(const pelagic_ocean* ocean, pelagic_ocean_info* info);

/* ---- Frames ----------------------------------------------------------------------------------------------------- */

/* A square of floats in blocks of a few columns: texel (i, j), column i and row j, is
 * data[i / block_columns * block_stride + j * row_stride + i % block_columns]; strides are in floats. The number of
 * columns in a block depends on the instruction set. */
typedef struct pelagic_plane {
    const float* data; /* NULL: the ocean was made without it */
    int32_t resolution;
    int32_t block_columns;
    ptrdiff_t row_stride;
    ptrdiff_t block_stride;
} pelagic_plane;

/* Extremes of displacements, for culling boxes. Those of a cascade are exact; those of a frame are the sums of its cascades', exact
 * for one and upper bounds for several, whose extremes need not meet. */
typedef struct pelagic_bounds {
    float height_min_m;
    float height_max_m;
    float horizontal_x_max_m; /* largest |Dx| */
    float horizontal_z_max_m; /* largest |Dz| */
} pelagic_bounds;

/* A frame is a stack of cascades, the coarsest first, and shows the first of them itself: all there is where cascade_count is 1. Then
 * texel (i, j) rests at x = i L / N, z = j L / N and is drawn at (x + Dx, height, z + Dz); metres. Where there are more, see
 * pelagic_cascade. */
typedef struct pelagic_frame {
    uint32_t struct_size;
    int32_t resolution; /* N */
    double time_s;
    double patch_size_m; /* L, the first cascade's side */
    pelagic_plane dx, height, dz;
    pelagic_plane velocity_x, velocity_y, velocity_z; /* metres a second; with pelagic_ocean_options.velocities */
    /* N^2 texels of four IEEE half floats, Dx, height, Dz and foam (0 none to 1 covered): rows are tight, 8 N bytes.
     * The layout of GL_RGBA16F with GL_HALF_FLOAT and of VK_FORMAT_R16G16B16A16_SFLOAT. */
    const uint16_t* displacement_rgba16f;
    /* A chain of gradient_levels levels of N, N / 2, ..., 1 texels a side, rows tight, 4 bytes a texel: normal x, normal
     * z, Jacobian, smoothness. GL_RGBA8, VK_FORMAT_R8G8B8A8_UNORM. Level m begins gradient_offset[m] texels in. NULL and
     * no levels in a frame of several cascades, unless pelagic_ocean_options.gradients. */
    const uint32_t* gradient_rgba8;
    int32_t gradient_levels;
    uint32_t gradient_offset[12];
    pelagic_bounds bounds; /* of all cascades together */
    /* Newer than the fields above. */
    uint32_t reserved_1; /* padding in the first version */
    int32_t cascade_count;
    /* GGX's alpha of the water between texels, in [0, 1]: its square is the mean square of the slopes that no cascade holds.
     * Smoothness is 1 - sqrt(roughness). */
    float roughness;
    /* Newer still. How fast foam drifts over the sea, in the world's axes: with the wind and with the waves. */
    double foam_drift_x_mps, foam_drift_z_mps;
} pelagic_frame;

/* One square of waves, which repeats over the whole sea along its own two axes. The cascades of a frame add: the water that rests
 * at (x, z) is drawn at (x + Dx, height, z + Dz), each the sum of what the cascades hold there.
 *
 * Places. L being side_m and N the resolution, texel (i, j), column i and row j, rests at
 *
 *   x = (cosine i - sine j) L / N,  z = (sine i + cosine j) L / N.
 *
 * So (x, z) lies at column u N and row v N, both modulo N, with
 *
 *   u = (cosine x + sine z) / L,  v = (cosine z - sine x) / L;
 *
 * in a texture that repeats and whose texels' centres are half a texel in, at (u + 0.5 / N, v + 0.5 / N), whatever the level.
 * What the texels hold is in the world's axes, whatever the turn.
 *
 * Slopes. Normals and Jacobians of a sum are no sums of normals and Jacobians, but derivatives add, and filters and levels may
 * come before it. Two chains like gradient_rgba8 hold them, four bytes a texel from the lowest up:
 *
 *   slopes_rgba8   h_x, h_z, D_xx, D_zz         (byte - 128) / 127 * slope_range each
 *   moments_rgba8  D_xz                         the same
 *                  var_xx, var_zz               byte / 255 * variance_range
 *                  cov_xz                       (byte - 128) / 127 * variance_range
 *
 * A texture has byte / 255. h_x is the height's derivative along x at rest, D_xz those of Dx along z and of Dz along x, which
 * are equal. The variances are of h_x and h_z within a texel, for roughness (LEAN mapping, Olano and Baker 2010): GGX's alpha^2
 * is var_xx + var_zz + pelagic_frame.roughness^2. With the sums of each over the cascades, the Jacobian J and a normal of any length are
 *
 *   J = (1 + D_xx) (1 + D_zz) - D_xz^2,  n = (h_z D_xz - h_x (1 + D_zz), J, h_x D_xz - h_z (1 + D_xx)).
 *
 * Foam of the stack is at a point the largest of the cascades'. */
typedef struct pelagic_cascade {
    uint32_t struct_size;
    int32_t resolution; /* N */
    double side_m;      /* L */
    /* Of the turn of the cascade's axes against the world's, from +x towards +z; 1 and 0: not turned. */
    double cosine, sine;
    /* As in pelagic_frame, of this cascade alone. */
    pelagic_plane dx, height, dz;
    pelagic_plane velocity_x, velocity_y, velocity_z;
    const uint16_t* displacement_rgba16f;
    const uint32_t* gradient_rgba8;
    /* NULL in a frame of one cascade, unless pelagic_ocean_options.slopes. */
    const uint32_t *slopes_rgba8, *moments_rgba8;
    float slope_range, variance_range;
    int32_t levels;            /* of each of the chains, if it is there */
    uint32_t level_offset[12]; /* level m of any of them begins so many texels in */
    pelagic_bounds bounds;
    /* Water of the Jacobian J of the cascade alone makes foam of 1/2 + (whitecap_jacobian - J) / whitecap_ramp, within 0 and 1: as much
     * of it, in the mean over time and while it lasts, as whitecaps cover in that wind, cascades together. -10 where the cascade makes
     * none. */
    float whitecap_jacobian;
    /* Newer than the fields above. A fourth chain of `levels` levels, a byte a texel, 0 none to 255 covered: GL_R8,
     * VK_FORMAT_R8_UNORM. As a part of 1 it is the fourth of the half floats. NULL without pelagic_ocean_options.foam. */
    const uint8_t* foam_r8;
    float whitecap_ramp; /* above 0 */
    uint32_t reserved_1;
} pelagic_cascade;

/* Starts the frame at time_s and returns at once. Any finite time, in any order: a frame is a pure function of the sea and
 * the time, and time_s + n * loop_period_s gives the same bits. A small frame (N up to 64), and any without threads,
 * is computed in complete(). Waits for queries that began before the last complete(), because it needs the memory of the
 * frame that they read. PELAGIC_WRONG_ORDER if a frame is in flight. */
PELAGIC_API pelagic_status pelagic_ocean_schedule(pelagic_ocean* ocean, double time_s);

/* Where pelagic_ocean_schedule_into writes the textures of a cascade: memory of the application's own, a mapped pixel buffer for instance.
 * Pointers may be NULL: that map is in the frame then. Each byte is written once, in rows of whole registers, and none is read,
 * so memory may be write-combined. For a frame of several cascades there is an array of them, as of pelagic_frame_buffers. */
typedef struct pelagic_texture_targets {
    uint32_t struct_size;
    uint32_t cascade_count;            /* of the first struct: the frame's cascades, 0 for one; of the others 0 */
    uint16_t* displacement_rgba16f; /* 4 N^2 in tight rows, at a multiple of 64 bytes */
    /* Level m: (N >> m)^2 texels in tight rows, at a multiple of 4 bytes. All levels of a map, or none. */
    uint32_t* gradient_rgba8[12];
    uint32_t *slopes_rgba8[12], *moments_rgba8[12];
} pelagic_texture_targets;

/* pelagic_ocean_schedule, with textures in memory of the application's, which must stay until complete() returns. In the frame and
 * its cascades what is written there is NULL, and pelagic_ocean_hash tells nothing of it. PELAGIC_INVALID_ARGUMENT for parts that
 * the ocean was made without. */
PELAGIC_API pelagic_status pelagic_ocean_schedule_into(pelagic_ocean* ocean, double time_s,
                                                       const pelagic_texture_targets* targets);

/* *is_ready becomes 1 if complete() would not wait for other threads, else 0: also 1 if no frame is in flight. Never blocks.
 * Do not spin on it: threads that others keep busy may leave the work to complete(). */
PELAGIC_API pelagic_status pelagic_ocean_poll(const pelagic_ocean* ocean, int32_t* is_ready);

/* Waits for the frame in flight, helping, and hands it out. What `frame` points to stays valid while the next frame is
 * computed: until the second schedule from now, or destroy. PELAGIC_WRONG_ORDER if no frame is in flight. A frame is lost,
 * and another one may be scheduled, after PELAGIC_APPLICATION_ERROR, and after PELAGIC_SYSTEM_ERROR if a job needed a thread with
 * more stack and there was none. */
PELAGIC_API pelagic_status pelagic_ocean_complete(pelagic_ocean* ocean, pelagic_frame* frame);

/* One cascade of the frame completed last, the coarsest being 0; what it points to is valid as long as that frame is. Also while
 * the next frame is computed. PELAGIC_INVALID_ARGUMENT if `index` is not less than the frame's cascade_count;
 * PELAGIC_WRONG_ORDER before the first frame. */
PELAGIC_API pelagic_status pelagic_ocean_cascade(const pelagic_ocean* ocean, int32_t index, pelagic_cascade* cascade);

/* Where pelagic_ocean_copy and pelagic_ocean_frame_at write a cascade. Pointers may be NULL: not wanted. Counts are exact, of
 * elements. Rows are tight, texel (i, j) at j N + i. For a frame of several cascades there is an array of them, one for each cascade,
 * all of the struct_size of the first, which says how many there are. */
typedef struct pelagic_frame_buffers {
    uint32_t struct_size;
    uint32_t cascade_count; /* of the first struct: the frame's cascades, 0 for one; of the others 0 */
    size_t plane_count;  /* N^2, the length of each of these */
    float *dx, *height, *dz;
    float *velocity_x, *velocity_y, *velocity_z;
    size_t rgba16f_count; /* 4 N^2 */
    uint16_t* displacement_rgba16f;
    size_t rgba8_count; /* texels of the chain: (4 N^2 - 1) / 3 */
    uint32_t* gradient_rgba8;
    /* Newer than the fields above. */
    size_t slopes_count; /* as rgba8_count, the length of each of these */
    uint32_t *slopes_rgba8, *moments_rgba8;
    size_t foam_count; /* as rgba8_count */
    uint8_t* foam_r8;
} pelagic_frame_buffers;

/* Copies the frame completed last: planes in tight rows, whatever blocks they are computed in, and all levels. Also while the
 * next frame is computed. PELAGIC_INVALID_ARGUMENT for parts that the ocean was made without. PELAGIC_WRONG_ORDER before the
 * first frame. */
PELAGIC_API pelagic_status pelagic_ocean_copy(const pelagic_ocean* ocean, const pelagic_frame_buffers* buffers);

/* Computes the frame of time_s into the caller's memory, synchronously; for servers and replays. Views and queries of the
 * frame completed last are not touched; before there is one, it is this frame that queries, cascade, copy and hash
 * tell of.
 * `bounds` may be NULL. PELAGIC_WRONG_ORDER as for schedule. */
PELAGIC_API pelagic_status pelagic_ocean_frame_at(pelagic_ocean* ocean, double time_s,
                                                  const pelagic_frame_buffers* buffers, pelagic_bounds* bounds);

/* The 64-bit hash of all outputs of the frame completed last: two machines that agree on it have the same sea.
 * PELAGIC_WRONG_ORDER before the first frame. */
PELAGIC_API pelagic_status pelagic_ocean_hash(const pelagic_ocean* ocean, uint64_t* hash);

/* The same of the foam of its cascades, which pelagic_ocean_hash leaves out. PELAGIC_INVALID_ARGUMENT without
 * pelagic_ocean_options.foam. */
PELAGIC_API pelagic_status pelagic_ocean_foam_hash(const pelagic_ocean* ocean, uint64_t* hash);

/* What frames remember, for an application that wants to go on from there without the warm-up of a jump in time: writes it to `bytes`,
 * which has room for `room` of them, and how many there are to *count. With `bytes` NULL only the count: N^2 a cascade and some, or
 * 0 before the first frame and without pelagic_ocean_options.foam. PELAGIC_INVALID_ARGUMENT if there is less room;
 * PELAGIC_WRONG_ORDER if a frame is in flight. */
PELAGIC_API pelagic_status pelagic_ocean_save_history(const pelagic_ocean* ocean, uint8_t* bytes, size_t room,
                                                      size_t* count);

/* Takes that up, in an ocean of the same sea, on any machine of the same byte order; none of them forgets. Frames are what they
 * would be without. PELAGIC_INVALID_ARGUMENT if such an ocean can't have saved it; PELAGIC_WRONG_ORDER if a frame is in flight. */
PELAGIC_API pelagic_status pelagic_ocean_restore_history(pelagic_ocean* ocean, const uint8_t* bytes, size_t count);

/* ---- Another sea ------------------------------------------------------------------------------------------------ */

/* Starts to bake another sea beside the current one; frames go on with the old one. The resolution and the number of cascades
 * must stay.
 * PELAGIC_WRONG_ORDER if one is being baked. */
PELAGIC_API pelagic_status pelagic_ocean_schedule_sea(pelagic_ocean* ocean, const pelagic_sea* sea);

/* As pelagic_ocean_poll: 1 also if no sea is being baked. */
PELAGIC_API pelagic_status pelagic_ocean_poll_sea(const pelagic_ocean* ocean, int32_t* is_ready);

/* Frames scheduled from now on show it; waits for its spectrum. PELAGIC_WRONG_ORDER if none is being baked or a frame is
 * in flight. After PELAGIC_APPLICATION_ERROR the old sea stays. */
PELAGIC_API pelagic_status pelagic_ocean_complete_sea(pelagic_ocean* ocean);

/* ---- Weather ---------------------------------------------------------------------------------------------------- */

/* The sea turns into another one: each wave's energy goes over from one to the other, smoothly, and a frame stays a pure
 * function of the weather and the time, in any order. */
typedef struct pelagic_change {
    uint32_t struct_size;
    uint32_t reserved;      /* 0 */
    const pelagic_sea* sea; /* that there is afterwards; read before the call returns */
    double from_s;          /* when it begins, not before the one before it is over */
    double over_s;          /* how long it takes; (0, 1e9] */
    /* Its swell comes from so far away, [1e3, 2e7], long waves first by their group velocities, each within over_s of its own; 0:
     * all waves change together. */
    double swell_from_m;
} pelagic_change;

/* Seas with times. All have the same number and kind of cascades, resolution, depth_m, loop_period_s and seed. */
typedef struct pelagic_forecast {
    uint32_t struct_size;
    uint32_t change_count;
    const pelagic_sea* first; /* before the first change */
    const pelagic_change*
        changes; /* change_count of them, in order, all of the first one's struct_size; NULL where there are none */
    /* Cascades are laid out for waves with peaks up to this long, and later changes can bring no longer ones; 0: the longest peak of
     * these seas, or (0, 1e5]. Without meaning with a patch_size_m. */
    double largest_peak_m;
} pelagic_forecast;

/* pelagic_ocean_create() with changes to come. Later seas are baked beside frames, before frames need them; a frame waits for one
 * that is not done, after a jump in time. */
PELAGIC_API pelagic_status pelagic_ocean_create_forecast(const pelagic_forecast* forecast,
                                                         const pelagic_ocean_options* options, pelagic_ocean** ocean);

/* One more change, which is baked beside frames from now on; a frame may be in flight. The ocean remembers the last two:
 * frames of times before them have the oldest sea that is left. PELAGIC_WRONG_ORDER between pelagic_ocean_schedule_sea and
 * pelagic_ocean_complete_sea, which makes an end of all changes. */
PELAGIC_API pelagic_status pelagic_ocean_schedule_change(pelagic_ocean* ocean, const pelagic_change* change);

/* ---- Dynamic waves ----------------------------------------------------------------------------------------- */

enum {
    PELAGIC_DYNAMIC_WAVES_SPECTRAL = 0, /* each wave goes on by its own phase: wakes as deep or shallow water has them */
    PELAGIC_DYNAMIC_WAVES_VERLET = 1    /* one speed for all waves, for ponds and rings; (speed / (ticks_per_s texel))^2 <= 0.4 */
};

/* Queries, bounds and frames of an ocean include its dynamic waves. They advance in ticks of their own, whatever the frames are:
 * equal commands between frames of equal times give bit-identical waves on every machine. */
typedef struct pelagic_dynamic_waves_options {
    uint32_t struct_size;
    int32_t step;        /* PELAGIC_DYNAMIC_WAVES_... */
    int32_t resolution;  /* N, texels along a side; 64, 128, 256, 512 or 1024 */
    int32_t ticks_per_s; /* [10, 240] */
    double side_m;         /* [1, 10000] */
    double border_m;       /* of each side, where waves end; 0: none, waves come round, else [0.001, side_m / 4] */
    double depth_m;        /* spectral; [0.01, 11000] */
    double viscosity_m2ps; /* spectral: of eddies; amplitudes of the wave number k lose 2 k^2 of it a second; [0, 1] */
    double wave_speed_mps; /* Verlet; (0, 1000] */
    double decay_per_s;    /* of amplitudes; [0, 10] */
    double foam_height_m;  /* water that stands higher turns white; [0.001, 100] */
} pelagic_dynamic_waves_options;

/* Sets every field but struct_size: spectral, 256 texels on 64 m, 60 ticks a second. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_defaults(pelagic_dynamic_waves_options* options);

enum {
    PELAGIC_SHAPE_GAUSS = 0, /* height_m exp(-(r / radius_m)^2) */
    PELAGIC_SHAPE_HULL = 1   /* height_m sqrt(1 - (along / length_m)^2 - (across / radius_m)^2), below 0 where it floats */
};

enum {
    PELAGIC_DISTURBANCE_PRESSURE = 0, /* by the weight of the shape's own water: at rest the surface becomes the shape */
    PELAGIC_DISTURBANCE_RELAXATION = 1,  /* towards the shape, at a rate: a bounded bulge */
    PELAGIC_DISTURBANCE_IMPULSE = 2    /* the shape is added at once: a drop, a stone */
};

/* A push at the water: once, or as a source that lasts. */
typedef struct pelagic_disturbance {
    uint32_t struct_size;
    int32_t shape;     /* PELAGIC_SHAPE_... */
    int32_t mode;      /* PELAGIC_DISTURBANCE_... */
    uint32_t reserved; /* 0 */
    double x_m, z_m;     /* in the world; [-1e8, 1e8] */
    double radius_m;     /* of a hull half its beam; [0.001, 1000] */
    double length_m;     /* of a hull half its length; [0.001, 1000] */
    double heading_rad;  /* of a hull's length, from +x towards +z; [-2 pi, 2 pi] */
    double height_m;     /* [-100, 100] */
    double rate_per_s;   /* of a relaxation; (0, 1000] */
    double velocity_x_mps, velocity_z_mps; /* how a source moves until it is set anew; [-1000, 1000] */
} pelagic_disturbance;

/* Sets every field but struct_size: a pressure of 0 m at the origin, radius and length 1 m, rate 10. */
PELAGIC_API pelagic_status pelagic_disturbance_defaults(pelagic_disturbance* disturbance);

/* Dynamic waves: those that an application makes, on a grid around a point. Commands take effect at the next advance, or at
 * the next schedule of the ocean that owns the waves, in their order, whether or not a frame is in flight. One thread at a time
 * calls these functions. */
typedef struct pelagic_dynamic_waves pelagic_dynamic_waves;

typedef struct pelagic_dynamic_waves_resources {
    uint32_t struct_size;
    uint32_t reserved;                /* 0 */
    const pelagic_executor* executor; /* NULL: PELAGIC_EXECUTOR_DEFAULT */
    const char* isa;                  /* as pelagic_ocean_options.isa */
    pelagic_allocate allocate;        /* both or neither; NULL: operator new */
    pelagic_release release;
    void* memory_user; /* handed to both; outlives the waves */
} pelagic_dynamic_waves_resources;

/* Makes waves without an ocean. `resources` may be NULL: all 0. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_create(const pelagic_dynamic_waves_options* options,
                                                        const pelagic_dynamic_waves_resources* resources,
                                                        pelagic_dynamic_waves** waves);

/* NULL is ignored, and so are the waves of an ocean. */
PELAGIC_API void pelagic_dynamic_waves_destroy(pelagic_dynamic_waves* waves);

/* Returns the waves of pelagic_ocean_options.dynamic_waves, which the ocean owns and advances. PELAGIC_INVALID_ARGUMENT
 * without that option. */
PELAGIC_API pelagic_status pelagic_ocean_dynamic_waves(pelagic_ocean* ocean, pelagic_dynamic_waves** waves);

/* Acts once, in the next tick. At most 4096 of them wait for a tick. While time stands still, in advances to a time that is not
 * later than the one before, they do not accumulate: only those of the last such advance that has any wait. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_add_impulse(pelagic_dynamic_waves* waves,
                                                             const pelagic_disturbance* disturbance);

/* Acts in every tick, moving at its velocity, until it is removed; at most 4096 sources at once. A number is used once;
 * setting or removing a source that does not exist does nothing. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_add_source(pelagic_dynamic_waves* waves, const pelagic_disturbance* source,
                                                            uint32_t* number);
PELAGIC_API pelagic_status pelagic_dynamic_waves_set_source(pelagic_dynamic_waves* waves, uint32_t number,
                                                            const pelagic_disturbance* source);
PELAGIC_API pelagic_status pelagic_dynamic_waves_remove_source(pelagic_dynamic_waves* waves, uint32_t number);

/* Moves the grid's centre to within half a texel of the point; [-1e8, 1e8]. Texels that enter the grid are flat. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_set_center(pelagic_dynamic_waves* waves, double x_m, double z_m);

/* Rain: each drop digs a crater with a rim of as much water around it, height_m (q - 1) e^-q with q = (r / radius_m)^2. Which drops
 * fall follows from the seed, the tick and the place in the world alone. */
typedef struct pelagic_rain {
    uint32_t struct_size;
    uint32_t seed;
    double drops_per_m2_s; /* on the mean; 0: no rain. At most as many as put 16 on a texel in a tick */
    double radius_m;       /* [0.001, side_m / 16]; what is narrower than a texel is drawn a texel wide, and flatter */
    double height_m;       /* how deep a crater is; [-10, 10] */
} pelagic_rain;

/* Sets every field but struct_size: no rain, drops of 0.25 m and 0.02 m, seed 1. */
PELAGIC_API pelagic_status pelagic_rain_defaults(pelagic_rain* rain);

/* Sets the rain from the next tick on. It is part of the saved state. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_set_rain(pelagic_dynamic_waves* waves, const pelagic_rain* rain);

/* Computes the ticks up to a time. A time before the last one leaves the waves as they are, and a jump ahead computes half a second at
 * most. PELAGIC_WRONG_ORDER for the waves of an ocean, whose frames advance them. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_advance(pelagic_dynamic_waves* waves, double time_s);

/* What adds to the cascades where water is drawn, at x = rest x + Dx, z alike. Texel (i, j) of the world's grid stands at
 * x = i texel_m, z = j texel_m, in column i mod N of row j mod N; the grid has first_x <= i < first_x + N. */
typedef struct pelagic_dynamic_waves_view {
    uint32_t struct_size;
    int32_t resolution; /* N, a power of two */
    int64_t first_x, first_z;
    double texel_m;
    const float* height_m; /* N^2, 0 at the grid's edges */
    const float* vertical_velocity_mps; /* N^2: its vertical velocity at the frame's moment; what is added at once brings none */
    const uint8_t* foam;   /* N^2 */
    float height_min_m, height_max_m;
} pelagic_dynamic_waves_view;

/* Returns the waves of the last advance, or of the ocean's frame completed last. The pointers are valid until the second advance or
 * schedule from now. PELAGIC_WRONG_ORDER before the first. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_get_view(const pelagic_dynamic_waves* waves,
                                                          pelagic_dynamic_waves_view* view);

/* The 64-bit hash of the view, which pelagic_ocean_hash leaves out. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_hash(const pelagic_dynamic_waves* waves, uint64_t* hash);

/* Writes all that ticks to come depend on, sources included, but for commands since the last advance; as
 * pelagic_ocean_save_history. 17 N^2 bytes and some. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_save_state(const pelagic_dynamic_waves* waves, uint8_t* bytes, size_t room,
                                                            size_t* count);

/* Continues from a saved state with equal options, of any machine of the same byte order. Drops commands since the last advance.
 * PELAGIC_INVALID_ARGUMENT if the options differ or the bytes are damaged; PELAGIC_WRONG_ORDER if a frame is in flight. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_restore_state(pelagic_dynamic_waves* waves, const uint8_t* bytes,
                                                               size_t count);

/* ---- Shores ----------------------------------------------------------------------------------------------------- */

/* A floor that waves feel, which may rise above the water as a beach or an island. Within its rectangle long waves are slowed, turned
 * and raised by the depth, break, and don't come behind land but round it; queries and bounds have them. Beyond it the floor continues as
 * its nearest edge has it: dry ground stays dry, and the sea is open where it is deep enough for its waves. Of a sea of several cascades
 * that never changes. */
typedef struct pelagic_shore_options {
    uint32_t struct_size;
    int32_t columns, rows;  /* samples of the floor along x and z; 2 to 4096 */
    int32_t resolution;     /* texels along the longer side of what frames show; 64, 128, 256, 512 or 1024 */
    const float* heights_m; /* columns * rows, above rest, [-11000, 9000]; sample (i, j) is element j * columns + i. Read before the
                             * call returns */
    double corner_x_m, corner_z_m; /* where sample (0, 0) stands; [-1e8, 1e8] */
    double metres_a_sample;        /* between neighbours; [0.001, 10000] */
    double fade_m;  /* along the edges, where the coarsest cascade gives way; 0: an eighth of the shorter side; at most half of it */
    double swash_m; /* waves reach so high on dry sand at most; [0, 10] */
} pelagic_shore_options;

/* Sets every field but struct_size: no samples, 1 m between them, 256 texels, a swash of 0.25 m. */
PELAGIC_API pelagic_status pelagic_shore_defaults(pelagic_shore_options* options);

/* Where water is drawn at a place of the rectangle, cascade t counts with its part there and height_m adds to the sum. Texel (i, j) stands
 * at x_m + i texel_m, z_m + j texel_m, in element j * columns + i. Between texels height_m and vertical_velocity_mps are cubic (Keys 1981, the 4 x 4
 * texels around; those of the edge again beyond it), all else is bilinear. Beyond the rectangle depths and parts are those of the nearest
 * place of its edge, and the height is 0, as on the edge. */
typedef struct pelagic_shore_surface {
    uint32_t struct_size;
    int32_t columns, rows;
    float parts_change_per_m; /* no part differs by more between places a metre apart */
    double texel_m;
    double x_m, z_m;
    const float* depth_m;        /* of still water; below 0 on land */
    const uint32_t* parts_rgba8; /* of cascade t in byte t from the lowest up, 255 for 1 */
    const float* height_m;
    const float* vertical_velocity_mps; /* vertical velocity */
    const float* reach_m;  /* how high the waves that are passing reach: sand below it is wet */
    const uint8_t* foam;   /* of waves that break */
    float height_min_m, height_max_m; /* bounds of the height, between texels too */
    const float* potential_m2ps;      /* its gradient is the horizontal velocity of these waves at the surface, linear theory */
} pelagic_shore_surface;

/* Of the frame completed last; what it points to is valid as long as that frame is. PELAGIC_WRONG_ORDER before the first frame,
 * PELAGIC_INVALID_ARGUMENT without pelagic_ocean_options.shore. */
PELAGIC_API pelagic_status pelagic_ocean_shore(const pelagic_ocean* ocean, pelagic_shore_surface* surface);

/* The 64-bit hash of all that pelagic_ocean_shore tells of the frame completed last, which pelagic_ocean_hash leaves out. */
PELAGIC_API pelagic_status pelagic_ocean_shore_hash(const pelagic_ocean* ocean, uint64_t* hash);

/* ---- Waves that the application adds ----------------------------------------------------------------------------------- */

/* Waves in the cascades themselves, so that all that is made of cascades has them: normals, bounds, foam, queries, textures. They repeat
 * with their cascade. What pelagic_ocean_hash says is then of the application's sea; of one without inputs it is as ever. An input belongs to one
 * ocean. It is set on the thread that calls the ocean's functions, and what it is then counts from the next schedule on. */
typedef struct pelagic_input pelagic_input;

/* A batch of Gerstner waves in deep water. Each goes to the nearest place of the grid of the cascade that takes waves of its length,
 * with a whole number of periods in a loop. */
typedef struct pelagic_waves {
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    size_t count;      /* at most 64; 0 adds nothing */
    const double* amplitude_m;   /* `count` of each; [0, 100] */
    const double* wavelength_m;  /* [0.01, 1000] */
    const double* direction_rad; /* where it runs towards, from +x towards +z; [-2 pi, 2 pi] */
    const double* phase_rad;     /* at x = z = t = 0, a crest where it is 0; NULL: all 0 */
    double choppiness; /* 1: water goes round in circles, 0: a height field; [0, 1]. The sum of 2 pi amplitude / length is at most 0.4 */
} pelagic_waves;

PELAGIC_API pelagic_status pelagic_input_create_waves(const pelagic_waves* waves, pelagic_input** input);
PELAGIC_API pelagic_status pelagic_input_set_waves(pelagic_input* input, const pelagic_waves* waves);

/* Rings that run from a place, in the cascade that takes waves of their length:
 * amplitude (1 - (r / reach)^2)^2 sqrt(L / 2 / q) cos(2 pi ((q - L / 2) / L - f t) + phase), q^2 = r^2 + (L / 2)^2. */
typedef struct pelagic_ripple {
    uint32_t struct_size;
    uint32_t reserved;   /* 0 */
    double x_m, z_m;     /* [-1e8, 1e8] */
    double wavelength_m; /* [0.01, 1000] */
    double amplitude_m;  /* in the middle; [0, 100], and at most wavelength_m / (2 pi) */
    double reach_m;      /* no water beyond it moves; 0 and more than half of the cascade's side: that; [0, 1e5] */
    double phase_rad;    /* [-2 pi, 2 pi] */
} pelagic_ripple;

PELAGIC_API pelagic_status pelagic_input_create_ripple(const pelagic_ripple* ripple, pelagic_input** input);
PELAGIC_API pelagic_status pelagic_input_set_ripple(pelagic_input* input, const pelagic_ripple* ripple);

/* Some rows of a cascade at a moment: column i of row first_row + j is at j N + i. Floats are 0 before, and what is left there is added to
 * the cascade, metres and metres a second in the world's axes; all are finite and at most 1000. Places as pelagic_cascade says. */
typedef struct pelagic_input_rows {
    uint32_t struct_size;
    int32_t cascade; /* 0 is the coarsest */
    double time_s;
    double loop_period_s;
    uint32_t loop_turns; /* where in the loop that is, in parts of 2^32: whoever uses no other time has the same bits in every loop */
    int32_t is_tick;     /* of foam that lasts, at a time before the frame's */
    double side_m, cosine, sine;
    int32_t resolution; /* N */
    int32_t first_row, row_count;
    uint32_t reserved;
    float *dx, *height, *dz;
    float *velocity_x, *velocity_y, *velocity_z; /* NULL without velocities, and in ticks */
} pelagic_input_rows;

/* Called from any thread, for several rows and cascades at once. If it throws, complete() returns PELAGIC_APPLICATION_ERROR, and if it
 * leaves a value that can't be, PELAGIC_INVALID_ARGUMENT; that frame is lost, the ocean is not. */
typedef void (*pelagic_add_rows)(void* user, const pelagic_input_rows* rows);

typedef struct pelagic_input_callback {
    uint32_t struct_size;
    uint32_t cascades; /* bit i: cascade i; 0: all */
    pelagic_add_rows add;
    void* user;           /* handed to it; outlives the ocean */
    double largest_slope; /* that it adds to a cascade, or slopes_rgba8 stops at its range's end; [0, 100] */
} pelagic_input_callback;

PELAGIC_API pelagic_status pelagic_input_create_callback(const pelagic_input_callback* callback, pelagic_input** input);

/* The ocean that has it keeps what it needs. NULL is ignored. */
PELAGIC_API void pelagic_input_destroy(pelagic_input* input);

/* ---- Queries ---------------------------------------------------------------------------------------------------- */

/* How a query reads the frame between texels. */
enum {
    PELAGIC_INTERPOLATION_LINEAR = 0, /* the surface that a GPU draws */
    PELAGIC_INTERPOLATION_CUBIC = 1   /* for measurements: keeps the heights and slopes of short waves; 2 to 4 times the work */
};

/* World positions in metres, as far away as you like: the sea repeats in double precision. A position that is no number
 * has no sample: its error is infinite and it is not converged. */
typedef struct pelagic_points {
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    size_t count;
    const double *x, *z; /* `count` of each; may be NULL if that is 0 */
    /* Newer than the fields above. */
    int32_t interpolation; /* PELAGIC_INTERPOLATION_...; foam is linear in both */
    uint32_t reserved_1;   /* 0 */
} pelagic_points;

/* What to tell: arrays as long as the points, or NULL. None overlaps another or the points. */
typedef struct pelagic_samples {
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    float* height_m;
    float *normal_x, *normal_y, *normal_z; /* unit normal of the displaced surface */
    float* jacobian;                       /* 1 at rest, small at sharp crests, negative where overturned */
    float *velocity_x_mps, *velocity_y_mps, *velocity_z_mps; /* of the water there; with the velocities option */
    float* error_m;                                          /* how far horizontally of the point the sample is drawn */
    uint8_t* converged;                                      /* 1 if that is within the tolerance */
    /* Newer than the fields above. How much of the water is white, 0 to 1; with the foam option. */
    float* foam;
} pelagic_samples;

/* Asks the frame completed last; of intersections over one another the highest counts. Any thread, any number
 * at once; allocates nothing, never waits. The bits depend on the frame, the point, the tolerance and the interpolation alone.
 * PELAGIC_INVALID_ARGUMENT if the ocean has no queries, or no velocities or foam and they are wanted; PELAGIC_WRONG_ORDER before
 * the first frame. */
PELAGIC_API pelagic_status pelagic_ocean_query(const pelagic_ocean* ocean, const pelagic_points* points,
                                               const pelagic_samples* samples);

typedef struct pelagic_ray {
    uint32_t struct_size;
    uint32_t reserved;   /* 0 */
    double origin_m[3];  /* x, y, z; [-1e9, 1e9] */
    double direction[3]; /* its length doesn't matter; [1e-100, 1e100] */
    double reach_m;      /* how far to look; 0 to 1e6 texels of the coarsest cascade, which are L / N each */
} pelagic_ray;

typedef struct pelagic_hit {
    uint32_t struct_size;
    int32_t is_hit;     /* 0: no water within reach, and the rest is 0 */
    int32_t from_below; /* the ray comes out of the water */
    float normal[3];    /* of the surface there, whichever side is hit */
    double distance_m;
    double position_m[3];
} pelagic_hit;

/* The first place where the ray passes through the surface. Threads and errors as pelagic_ocean_query. */
PELAGIC_API pelagic_status pelagic_ocean_first_hit(const pelagic_ocean* ocean, const pelagic_ray* ray,
                                                   pelagic_hit* hit);

#ifdef __cplusplus
}
#endif

#endif
