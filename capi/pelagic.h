/* C interface of Pelagic: FFT ocean waves on the CPU, multithreaded and vectorised.
 *
 *   pelagic_sea sea = pelagic_sea_make();
 *   pelagic_frame frame;
 *   pelagic_ocean* ocean;
 *   sea.wind_speed_mps = 9;
 *   if (pelagic_ocean_create(&sea, NULL, &ocean) != PELAGIC_OK) die(pelagic_last_error());
 *   pelagic_ocean_schedule(ocean, 0);
 *   for (t = 0; drawing; t += 1.0 / 90) {
 *       pelagic_ocean_complete(ocean, &frame);        // the frame scheduled last
 *       pelagic_ocean_schedule(ocean, t + 1.0 / 90);  // computes the next frame during drawing
 *       for (i = 0; i < frame.cascade_count; ++i) {
 *           pelagic_cascade cascade;
 *           pelagic_ocean_cascade(ocean, i, &cascade);  // of the frame completed last
 *           upload(cascade.displacement_rgba16f, cascade.slopes_rgba8, cascade.moments_rgba8);
 *       }
 *   }
 *   pelagic_ocean_destroy(ocean);
 *
 * Results are bit-identical to those of the C++ interface.
 *
 * Conventions. SI units, named in each field; right-handed axes, +y up, rest level y = 0; radians. Ranges of values
 * stand in brackets; x_m and z_m of functions are in [-1e8, 1e8]. Hashes have 64 bits: equal ones on two machines
 * mean bit-identical results.
 *
 * Errors. Every function that can fail returns a pelagic_status. Unless it is PELAGIC_OK, the function has changed no
 * object and written nothing but NULL for a handle that could not be created, and pelagic_last_error() describes the
 * error. No exception crosses this interface. The comments of functions leave out these errors:
 *   PELAGIC_INVALID_ARGUMENT for a NULL handle, a NULL pointer that is not described as optional, a value out of
 *     range, and what the ocean was created without: queries, velocities, foam, textures, dynamic waves, a shore or
 *     spray.
 *   PELAGIC_WRONG_ORDER before the first frame, from functions that need the frame completed last.
 *   PELAGIC_OUT_OF_MEMORY and PELAGIC_INTERNAL_ERROR. From functions that create executors, oceans, dynamic waves and
 *     bodies also PELAGIC_SYSTEM_ERROR if the system cannot create the threads, and PELAGIC_APPLICATION_ERROR if a
 *     callback of the executor fails.
 * A destroyed handle, or a pointer to less memory than stated, cannot be detected: the behaviour is undefined.
 * Destroy functions accept NULL.
 *
 * Structs. Those that the library reads begin with struct_size. A function with the struct's name and _make returns
 * one with its struct_size and all defaults; fields that it does not name are 0. Options that may be NULL then have
 * their defaults. Later versions 1.x may add fields at the end. Sizes from that of the struct's first version to 4096
 * bytes are accepted; any other size gives PELAGIC_INVALID_ARGUMENT. In a larger struct, of an application built with
 * a newer header, the fields that the library does not define must be 0. Structs that the library writes, and those
 * inside other structs, have no struct_size: versions 1.x do not change them. Compare structs by their fields,
 * because padding has no value.
 *
 * Threads. Functions whose first argument is a handle are called by one thread at a time for each object, unless
 * their comment says otherwise; an ocean, its dynamic waves and its inputs count as one object. All other functions
 * may be called by any number of threads at once. So may those with "Threads: any", also while another thread calls
 * other functions of the object. Oceans on different threads may share an executor.
 *
 * Lifetime. The caller destroys what a pelagic_..._create function made, in any order: an ocean keeps its executor
 * alive. Memory that a pelagic_frame points to belongs to the ocean. Returned strings live as long as the library,
 * except that of pelagic_last_error().
 *
 * Saved states. A function that saves writes `count`, the number of bytes, and the state to `bytes`, unless that is
 * NULL. PELAGIC_INVALID_ARGUMENT: `room`, the size of `bytes`, is too small. States are restored on any machine of
 * equal byte order. PELAGIC_INVALID_ARGUMENT: they are damaged. PELAGIC_WRONG_ORDER: a frame is in flight, for states
 * of an ocean and its dynamic waves.
 *
 * Memory. After an ocean's first frame, schedule, poll, complete and queries allocate nothing. The exceptions are
 * changes of the forecast, and a larger number of commands for dynamic waves than in any earlier frame. Memory of the
 * size of a frame or a spectrum comes from pelagic_ocean_options.allocate, if set.
 *
 * Functions of pointer types below, such as pelagic_parallel_for, are written by the application. */
#ifndef PELAGIC_PELAGIC_H
#define PELAGIC_PELAGIC_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Marks what the shared library exports. Applications that link libpelagic.a define PELAGIC_STATIC. Only Pelagic's
 * own build defines PELAGIC_BUILDING. */
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

/* Marks functions that may change in any version. Versions 1.x keep all others: an application runs with the library
 * of its header's version and with every later 1.x. */
#define PELAGIC_EXPERIMENTAL PELAGIC_API

/* Defines a struct without struct_size, with 0 in its fields. */
#define PELAGIC_RECORD(type, name) \
    type name;                     \
    memset(&name, 0, sizeof name)
/* Defines a struct with its struct_size, and 0 in its other fields; or returns it. */
#define PELAGIC_ZEROS(type, name)  \
    PELAGIC_RECORD(type, name);    \
    name.struct_size = (uint32_t)sizeof name
#define PELAGIC_MAKE(type)      \
    PELAGIC_ZEROS(type, zeros); \
    return zeros

#ifdef __cplusplus
extern "C" {
#endif

#define PELAGIC_VERSION_MAJOR 1
#define PELAGIC_VERSION_MINOR 0
#define PELAGIC_VERSION_PATCH 0

/* Returns the library's version, major * 10000 + minor * 100 + patch, which may be later than the header's. */
PELAGIC_API uint32_t pelagic_version(void);

typedef int32_t pelagic_status;
enum {
    PELAGIC_OK = 0,
    /* Unusable value, handle, size or pointer; the message names it. */
    PELAGIC_INVALID_ARGUMENT = 1,
    PELAGIC_WRONG_ORDER = 2, /* for instance a second schedule without complete */
    PELAGIC_OUT_OF_MEMORY = 3,
    PELAGIC_SYSTEM_ERROR = 4,     /* the system cannot create another thread */
    PELAGIC_INTERNAL_ERROR = 5,   /* a bug in Pelagic: please report the message */
    PELAGIC_APPLICATION_ERROR = 6 /* a callback threw or returned too early; the message names it */
};

/* Returns the message of the last call that failed on this thread: "wind_speed_mps -3 is out of range (0, 60]". It is
 * one line of UTF-8 without control characters, less than 300 bytes, and empty before the first failure. It stays
 * valid until the next failure on this thread. */
PELAGIC_API const char* pelagic_last_error(void);

/* Receives each failure with its message, on the thread of the call that is about to return it, and the pointer given
 * to pelagic_set_error_callback(). The callback may call Pelagic, except the function whose failure it receives.
 * Pelagic catches and ignores what the callback throws. */
typedef void (*pelagic_error_callback)(void* user, pelagic_status status, const char* message);

/* Sets the error callback of the process, which receives the failures of all threads; NULL for none, as at the start.
 * Calls in progress may still use the previous callback. */
PELAGIC_API void pelagic_set_error_callback(pelagic_error_callback callback, void* user);

/* ---- The sea --------------------------------------------------------------------------------- */

/* generated from schema/sea.toml: c-enumerations */
enum { PELAGIC_WAVES_SPECTRUM = 0, PELAGIC_WAVES_ANALYTIC = 1, PELAGIC_WAVES_POND = 2, PELAGIC_WAVES_REGULAR = 3 };

enum {
    PELAGIC_SPECTRUM_PHILLIPS_PAPER = 0,    /* scaled as in VR Ocean, without a swell */
    PELAGIC_SPECTRUM_PHILLIPS = 1,          /* Phillips' shape with a physical height */
    PELAGIC_SPECTRUM_PIERSON_MOSKOWITZ = 2, /* a fully developed sea; no fetch */
    PELAGIC_SPECTRUM_JONSWAP = 3,           /* a sea that grows with the fetch */
    /* No wind sea: only the swell and systems; the wind still sets roughness, drift, and foam on waves that it
     * can raise. */
    PELAGIC_SPECTRUM_NONE = 4
};

enum {
    PELAGIC_SPREADING_PAPER = 0,         /* VR Ocean, by wind_alignment */
    PELAGIC_SPREADING_COSINE_2S = 1,     /* measured, Longuet-Higgins et al. 1963 */
    PELAGIC_SPREADING_HASSELMANN = 2,    /* measured, Hasselmann et al. 1980 */
    PELAGIC_SPREADING_DONELAN_BANNER = 3 /* measured, Donelan et al. 1985 and Banner 1990 */
};
/* end of generated */

/* A wave system: waves of one spectrum and one spreading. Zeros are not valid. */
/* generated from schema/wave_system.toml: c-struct */
typedef struct pelagic_wave_system {
    /* PELAGIC_SPECTRUM_...; spectrum: jonswap, pierson-moskowitz or phillips. By height, pierson-moskowitz is
     * jonswap with gamma 1. */
    int32_t spectrum;
    /* PELAGIC_SPREADING_...; directional spreading, where spread_rad is 0. Hasselmann's and cosine-2s depend on
     * the wind; by height and period it is the wind that raises such waves in JONSWAP's growth. */
    int32_t spreading;
    double wind_speed_mps; /* U10 of the wind of the system; (0, 60] */
    double fetch_m;        /* distance that it has blown over water (jonswap); (0, 2e6] */
    /* Significant wave height, Hm0; (0, 30]. 0: by the wind and peak_period_s. With peak_period_s, the system has
     * both at any depth. Of one alone, the other follows as of the wind sea. */
    double height_m;
    double peak_period_s; /* peak period; [1, 40]. 0: by the wind and height_m */
    /* Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap); [1, 10]. */
    double peak_enhancement;
    double direction_rad; /* direction that the waves run towards, from +x towards +z; [-2 pi, 2 pi] */
    double spread_rad;    /* standard deviation of the directions; [pi/180, 4 pi/9]. 0: by spreading */
} pelagic_wave_system;
static inline pelagic_wave_system pelagic_wave_system_make(void) {
    PELAGIC_RECORD(pelagic_wave_system, system); system.spectrum = PELAGIC_SPECTRUM_JONSWAP;
    system.spreading = PELAGIC_SPREADING_DONELAN_BANNER; system.wind_speed_mps = 12; system.fetch_m = 100e3;
    system.peak_enhancement = 3.3; return system;
}
/* end of generated */

/* A sea state. Equal values and the same version of Pelagic give bit-identical seas on all machines. */
/* generated from schema/sea.toml: c-struct */
typedef struct pelagic_sea {
    uint32_t struct_size;
    /* PELAGIC_WAVES_...; wave model. Only a spectrum uses spectrum, spreading, fetch_m, peak_period_s, lean,
     * short_wave_cutoff, wind_alignment, the swell, systems and seed, and only a spectrum and a regular wave
     * depth_m. Only the other models use wave_count and the options after it but wave_height_m and systems. All
     * models use the wind, whose direction is that of their waves. */
    int32_t waves;
    int32_t spectrum; /* PELAGIC_SPECTRUM_...; wave spectrum */
    /* PELAGIC_SPREADING_...; directional spreading. The spectrum phillips-paper always has paper, and refuses
     * cosine-2s and hasselmann. */
    int32_t spreading;
    /* Number of cascades, each a band of wavelengths; 1, 2, 3 or 4. 0: four, or one if patch_size_m is set, the
     * resolution is 16 or the model has only one. More than one excludes patch_size_m. */
    int32_t cascades;
    /* N, texels along a side of each cascade; a power of two from 16 to 2048. 0: 128, or 256 if patch_size_m is
     * set. */
    int32_t resolution;
    uint32_t seed; /* seed of the random phases and amplitudes */
    /* Number of analytic waves or of pond octaves; 1 to 64. 0: 16 analytic waves, 24 pond octaves. */
    int32_t wave_count;
    /* Order of Stokes' expansion of a regular wave; 1 or 2. 2 adds the second harmonic that choppiness does not
     * make. */
    int32_t order;
    int32_t system_count; /* number of systems; 0 to 8 */
    /* L, the side of the only cascade, after which the sea repeats; [0.001, 1e6]. 0: sides derived from the sea. */
    double patch_size_m;
    double wind_speed_mps;     /* U10, mean wind speed 10 m above the sea; (0, 60] */
    double wind_direction_rad; /* direction that the wind blows towards, from +x towards +z; [-2 pi, 2 pi] */
    /* Distance that the wind has blown over water (jonswap), of which at most 17,000 U10^2 / g has an effect;
     * (0, 2e6]. Excludes wave_height_m and peak_period_s. */
    double fetch_m;
    /* Peak period of the wind sea (jonswap, pierson-moskowitz); [1, 40]. 0: by wave_height_m and the wind. With
     * wave_height_m, the wind sea has that height and period at any depth. Of one alone, the other follows from
     * JONSWAP's growth in this wind with the fetch eliminated; of pierson-moskowitz, from its peak. */
    double peak_period_s;
    /* Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap); [1, 10]. */
    double peak_enhancement;
    /* Depth of the water, which slows and lowers long waves; [0.01, 11000]. Waves higher than 0.6 of it break. */
    double depth_m;
    double choppiness; /* scale of horizontal displacements; [0, 1]. 0 gives a height field */
    /* Forward displacement of crests of the wind sea, as a fraction of the displacement that sharpens them;
     * [0, 0.6]. -1: 0 up to 3 m/s, 0.42 at 10 m/s, 0.52 at 20 m/s; 0 for phillips-paper. It makes fronts steeper
     * than backs. A swell and systems do not lean. */
    double lean;
    /* GGX roughness of unresolved waves, for the smoothness channel; [0, 1]. -1: from the slopes that the
     * cascades do not resolve in this wind. */
    double roughness;
    /* 0 keeps short waves, 1 removes waves shorter than a quarter of the peak wavelength; [0, 1]. */
    double short_wave_cutoff;
    /* Alignment of waves with the wind, alpha of equations 6 to 9, for the spreading paper; [0, 1]. With 0 a
     * third of the energy runs against the wind and little across it; with 1 a hundredth runs against it. */
    double wind_alignment;
    /* Significant wave height of a swell, in addition to the waves of the wind; [0, 30]. 0: no swell. */
    double swell_height_m;
    double swell_period_s;      /* peak period of the swell; [1, 40] */
    double swell_direction_rad; /* direction that the swell runs towards, as wind_direction_rad; [-2 pi, 2 pi] */
    /* Standard deviation of the swell's directions; [pi/180, 4 pi/9]. 15 degrees by default. */
    double swell_spread_rad;
    /* T, the period after which the sea repeats exactly; [0.1, 86400]. Waves keep their frequency within 1 / (2
     * T): in short loops groups of waves move in steps. */
    double loop_period_s;
    /* Longest wavelength of an analytic sea or a pond; [0.02, 1000]. 0: 120, of a pond 1.2. */
    double longest_wave_m;
    /* Shortest wavelength, at most the longest; [0.01, 1000]. 0: the longest / 60, of a pond / 45. */
    double shortest_wave_m;
    /* Strength of analytic waves: 0 calm, 1 moderate, 2 intense, interpolated between; [0, 2]. */
    double wave_strength;
    /* Significant wave height of the wind sea (jonswap, pierson-moskowitz), of an analytic sea or of a pond;
     * (0, 30]. 0: from the wind, of analytic waves from wave_strength, of a pond 0.017 longest_wave_m. */
    double wave_height_m;
    double wave_drag;        /* horizontal drag of a pond's short waves by its long ones; [0, 1] */
    double regular_height_m; /* height of a regular wave from trough to crest; (0, 60] */
    double regular_period_s; /* period of a regular wave; [0.2, 60]. loop_period_s is a whole number of them */
    /* Wave systems, in addition to the waves of the wind and the swell; at most 8. */
    pelagic_wave_system systems[8];
} pelagic_sea;
static inline pelagic_sea pelagic_sea_make(void) {
    PELAGIC_ZEROS(pelagic_sea, sea); sea.spectrum = PELAGIC_SPECTRUM_JONSWAP;
    sea.spreading = PELAGIC_SPREADING_DONELAN_BANNER; sea.seed = 1; sea.order = 1; sea.wind_speed_mps = 12;
    sea.fetch_m = 100e3; sea.peak_enhancement = 3.3; sea.depth_m = 4000; sea.choppiness = 0.8; sea.lean = -1;
    sea.roughness = -1; sea.wind_alignment = 0.5; sea.swell_period_s = 12;
    sea.swell_spread_rad = 0.26179938779914943; sea.loop_period_s = 3600; sea.wave_strength = 1;
    sea.wave_drag = 0.38; sea.regular_height_m = 2; sea.regular_period_s = 8; return sea;
}
/* end of generated */

/* Sets every field but struct_size to those of a preset.
 * name: "calm", "lake", "swell", "moderate", "rough", "storm", "pond", "analytic-calm", "analytic-moderate" or
 *   "analytic-intense", or "beaufort-0" to "beaufort-12". */
PELAGIC_API pelagic_status pelagic_sea_preset(const char* name, pelagic_sea* sea);

/* Writes name and summary, one line each, of a preset; `index` counts from 0, the mildest. Beaufort's are last. */
PELAGIC_API pelagic_status pelagic_preset_at(int32_t index, const char** name, const char** summary);

/* Checks the values of a sea.
 * Errors: PELAGIC_INVALID_ARGUMENT if no ocean can be made of it; the message names the first invalid field. */
PELAGIC_API pelagic_status pelagic_sea_check(const pelagic_sea* sea);

/* One wave system: expected values and realised ones as in pelagic_statistics. All 0 if the sea lacks it. */
typedef struct pelagic_system_statistics {
    double expected_wave_height_m, realised_wave_height_m;
    double expected_peak_period_s, realised_peak_period_s;
    double expected_direction_rad, realised_direction_rad;
    double expected_spread_rad, realised_spread_rad;
} pelagic_system_statistics;

/* Heights, periods and directions of a sea. Fields that begin with `expected` are means over all seeds, of the waves
 * that the cascades hold. Fields that begin with `realised` belong to the waves of this seed, as a mean over a loop.
 * A value that a sea does not have is 0. */
typedef struct pelagic_statistics {
    double expected_wave_height_m, realised_wave_height_m; /* significant wave height, 4 sqrt(variance) */
    double model_wave_height_m; /* of all waves of the model; 0 for phillips-paper, which has no scale */
    /* Period of the maximum of the frequency spectrum. Realised: Young 1995; with a swell that of the system with the
     * higher peak. */
    double expected_peak_period_s, realised_peak_period_s;
    double peak_wavelength_m;
    double expected_tm01_s, realised_tm01_s; /* m0 / m1, m_n = integral f^n S(f) df */
    double expected_tm02_s, realised_tm02_s; /* sqrt(m0 / m2), also the mean period of upward zero crossings */
    /* Direction waves run towards, from +x to +z; (-pi, pi]. */
    double expected_direction_rad, realised_direction_rad;
    double expected_spread_rad, realised_spread_rad; /* directional spread; [0, sqrt(2)] */
    double slope_variance_along_wind, slope_variance_across_wind;         /* expected, of all cascades */
    double expected_convergence_variance, realised_convergence_variance; /* of Dx,x + Dz,z */
    /* Of a sea of several systems; systems are those of pelagic_sea. */
    pelagic_system_statistics wind_sea, swell, systems[8];
    double effective_fetch_m; /* jonswap: the fetch that has an effect, at most 17,000 U10^2 / g */
    double repeats_after_m;   /* side of the coarsest cascade, the period of the longest waves */
    int32_t system_count;     /* number of systems; 0 to 8 */
} pelagic_statistics;

/* Computes statistics of a sea that pelagic_sea_check() accepts, which takes as long as creating an ocean of it. */
PELAGIC_API pelagic_status pelagic_sea_statistics(const pelagic_sea* sea, pelagic_statistics* statistics);

/* Computes the spectrum of the model, integrated over all directions and regardless of the cascades. It is 0 for
 * analytic waves and ponds, whose spectra are lines.
 * at: `count` frequencies in Hz or, if `is_by_wave_number` is not 0, wave numbers in rad/m; (0, 1e9).
 * energy: receives `count` values, in m^2/Hz or m^3. */
PELAGIC_API pelagic_status pelagic_sea_spectrum(const pelagic_sea* sea, int32_t is_by_wave_number, const double* at,
                                                size_t count, double* energy);

/* Checks options as the functions that take them do; rain later also against its grid. `type` is the struct's name:
 * "pelagic_" and "dynamic_waves_options", "disturbance", "rain", "ripple", "waves" (each alone), "shore_options",
 * "spray_options" or "spray_emitter". The message names the first invalid field. */
PELAGIC_API pelagic_status pelagic_options_check(const char* type, const void* options);

/* ---- Executors ------------------------------------------------------------------------------- */

enum {
    PELAGIC_EXECUTOR_DEFAULT = 0,    /* oneTBB if the library was built with it, else threads */
    PELAGIC_EXECUTOR_SERIAL = 1,     /* no threads: complete() does the work */
    PELAGIC_EXECUTOR_THREADS = 2,    /* a thread pool of the executor */
    PELAGIC_EXECUTOR_TBB = 3,        /* PELAGIC_INVALID_ARGUMENT if built without oneTBB */
    PELAGIC_EXECUTOR_APPLICATION = 4 /* the application's job system, through callbacks */
};

/* Calls job(work, i) once for each i in [0, count), on any threads, concurrently or not, and returns after all calls
 * have returned. Pelagic calls it several times a frame, from complete() or from a submitted task. Jobs need 512 KiB
 * of stack, and 1 MiB for N = 2048. A job that finds less runs on a thread created for it, which is slow.
 * Errors: if the function throws, or returns before all jobs are done, Pelagic runs the remaining jobs and complete()
 *   returns PELAGIC_APPLICATION_ERROR. That frame or sea is lost; the ocean remains usable. A job that is called
 *   twice, or after the function has returned, does nothing as long as the ocean exists. */
typedef void (*pelagic_parallel_for)(void* user, size_t count, void (*job)(void* work, size_t index), void* work);

/* Schedules one call of task(work) on another thread and returns immediately. A task may run late, even after the
 * ocean was destroyed. A task that never runs, or runs twice, does no harm.
 * Errors: if the function throws, as for pelagic_parallel_for. */
typedef void (*pelagic_submit)(void* user, void (*task)(void* work), void* work);

typedef struct pelagic_executor_options {
    uint32_t struct_size;
    int32_t kind; /* PELAGIC_EXECUTOR_... */
    /* Maximum number of threads that work on a frame, the completing thread included; [0, 1024]. With 1 complete()
     * does all work. 0, or more: one per CPU that the calling thread may use by its affinity and its process's quota;
     * of PELAGIC_EXECUTOR_THREADS with a mask, of these the CPUs of the mask. PELAGIC_EXECUTOR_APPLICATION: 0 is 1,
     * and no number is too large. */
    int32_t threads;
    /* For PELAGIC_EXECUTOR_THREADS on Linux, Android and Windows: bit i lets its threads run on CPU i; 0: all. */
    uint64_t cpu_mask;
    pelagic_parallel_for parallel_for; /* required by PELAGIC_EXECUTOR_APPLICATION */
    pelagic_submit submit;             /* may be NULL: work then begins in complete() */
    void* user;                        /* passed to both; must outlive all oceans of this executor */
} pelagic_executor_options;
static inline pelagic_executor_options pelagic_executor_options_make(void) { PELAGIC_MAKE(pelagic_executor_options); }

typedef struct pelagic_executor pelagic_executor;

/* Creates an executor, which may serve several oceans.
 * Errors: PELAGIC_INVALID_ARGUMENT for an unavailable kind, and a mask without PELAGIC_EXECUTOR_THREADS. */
PELAGIC_API pelagic_status pelagic_executor_create(const pelagic_executor_options* options,
                                                   pelagic_executor** executor);

/* Releases the handle. Oceans that use the executor keep it alive. */
PELAGIC_API void pelagic_executor_destroy(pelagic_executor* executor);

/* Sets how long threads look for work before they sleep. 0 saves battery; then frames take longer. Has no effect on
 * executors without threads of their own.
 * us: microseconds; [0, 1000]; 20 at first. Threads: any. */
PELAGIC_API pelagic_status pelagic_executor_set_spin_us(pelagic_executor* executor, int32_t us);

/* ---- The ocean ------------------------------------------------------------------------------- */

/* Allocates memory. Must return `bytes` bytes (more than 0) at a multiple of `alignment` (a power of two), or NULL.
 * Errors: if it returns NULL, the call that needed the memory returns PELAGIC_OUT_OF_MEMORY.
 * Threads: called on the thread that creates an ocean or schedules another sea of it. */
typedef void* (*pelagic_allocate)(void* user, size_t bytes, size_t alignment);

/* Releases what pelagic_allocate returned, with equal `bytes` and `alignment`. Must not throw.
 * Threads: called on the thread that destroys an ocean, or schedules or completes another sea. */
typedef void (*pelagic_release)(void* user, void* memory, size_t bytes, size_t alignment);

/* Textures that each cascade has or not. DEFAULT depends on the sea and the other options. */
/* generated from schema/ocean.toml: c-enumerations */
enum { PELAGIC_TEXTURES_DEFAULT = 0, PELAGIC_TEXTURES_ON = 1, PELAGIC_TEXTURES_OFF = 2 };

enum { PELAGIC_VELOCITIES_NONE = 0, PELAGIC_VELOCITIES_DRAWN = 1, PELAGIC_VELOCITIES_WATER = 2 };
/* end of generated */

/* generated from schema/ocean.toml: c-struct */
typedef struct pelagic_ocean_options {
    uint32_t struct_size;
    /* Nonzero enables pelagic_ocean_query and _first_hit; N^2 / 8 bytes for each cascade of a frame. */
    int32_t queries;
    /* PELAGIC_VELOCITIES_...; velocities of frames and queries. Drawn: the derivatives of the drawn displacement
     * in time, in planes of 12 N^2 bytes for each cascade of a frame, with about twice as many transforms. Water:
     * the water's own at the surface by linear theory, for queries, with a quarter of the transforms more; waves
     * shorter than four texels are left out. */
    int32_t velocities;
    /* Nonzero adds pressure and velocity below the surface, which hulls need. 8 N^2 bytes for each cascade of a
     * frame, and about a quarter of its time. Waves of a pond do not decrease with depth and move no water. */
    int32_t depth;
    /* PELAGIC_TEXTURES_...; gradients of each cascade: normals, Jacobian and smoothness. By default a sea with
     * cascades 1 has them, and an ocean whose slopes are off. Slopes and gradients cannot both be off. */
    int32_t gradients;
    /* PELAGIC_TEXTURES_...; slopes and moments of each cascade, which add over cascades. By default all oceans
     * have them but those of a sea with cascades 1 that have gradients and no foam. Foam needs them. */
    int32_t slopes;
    /* Nonzero enables foam of breaking waves, which drifts and fades over 2.8 seconds. A frame with a tick (five
     * a second) takes about twice as long. A jump in time computes 16 ticks, which take as long as ten to twenty
     * frames. 49 N^2 bytes for each cascade. */
    int32_t foam;
    /* Nonzero leaves textures and bounds of frames, and no planes. This moves fewer bytes and takes about 12 N^2
     * bytes less for each cascade; the textures are bit-identical. Cannot be combined with queries, velocities,
     * dynamic waves, a shore, spray or wave inputs. */
    int32_t textures_only;
    const pelagic_executor* executor; /* NULL: PELAGIC_EXECUTOR_DEFAULT */
    /* "sse4.2", "avx2", "avx512" or "neon"; NULL: environment variable PELAGIC_ISA, else the widest of the CPU. */
    const char* isa;
    /* Dynamic waves, which are added to the cascades; NULL: none. Read before the call returns. */
    const struct pelagic_dynamic_waves_options* dynamic_waves;
    /* A sea floor that refracts waves; NULL: none. Read before the call returns. */
    const struct pelagic_shore_options* shore;
    /* Spray of breaking crests and emitters; NULL: none. Read before the call returns. A frame with a tick
     * (eleven a second) computes the displacement once more. 3.8 MB. */
    const struct pelagic_spray_options* spray;
    size_t input_count; /* number of `inputs` */
    /* Wave inputs, `input_count` handles, which are added to the waves of the wind in this order; may be NULL if
     * that is 0. None may belong to another ocean. The ocean keeps what it needs of them. */
    struct pelagic_input* const* inputs;
    /* Allocator of spectra, planes, textures and maps, which is all memory that grows with N^2. Both functions or
     * neither; NULL: operator new. Tables, handles and graphs (some 100 KB) and what executors need, threads and
     * oneTBB, come from operator new. */
    pelagic_allocate allocate;
    pelagic_release release;  /* frees what `allocate` returned */
    void* memory_user;        /* passed to both; must outlive the ocean */
    double query_tolerance_m; /* largest error of a converged point; [1e-6, 1000]. 0: 0.001 */
} pelagic_ocean_options;
static inline pelagic_ocean_options pelagic_ocean_options_make(void) { PELAGIC_MAKE(pelagic_ocean_options); }
/* end of generated */

/* Returns the name of an instruction set for pelagic_ocean_options.isa, or NULL; `index` counts from 0, the narrowest
 * that the CPU supports. */
PELAGIC_API const char* pelagic_isa_at(int32_t index);

typedef struct pelagic_ocean pelagic_ocean;

/* Creates an ocean of a sea that pelagic_sea_check() accepts, and computes its spectrum; options may be NULL. */
PELAGIC_API pelagic_status pelagic_ocean_create(const pelagic_sea* sea, const pelagic_ocean_options* options,
                                                pelagic_ocean** ocean);

/* Waits for work in flight and destroys the ocean. No query may be in progress.
 * Lifetime: pointers of its frames and the handle of its dynamic waves become invalid. */
PELAGIC_API void pelagic_ocean_destroy(pelagic_ocean* ocean);

/* A sea level, for instance of a tide, and a uniform current, which carries the water. Queries and commands of
 * dynamic waves use positions in the world. Frames, their hashes and views are in the water's frame, whose origin
 * lies at (current_x_mps t - origin x, sea_level_m, current_z_mps t - origin z) in the world, with the origin of
 * pelagic_ocean_set_origin(). */
/* generated from schema/water_frame.toml: c-struct */
typedef struct pelagic_water_frame {
    uint32_t struct_size;
    double sea_level_m;   /* height of still water; [-1000, 1000] */
    double current_x_mps; /* velocity of the water along x; [-10, 10] */
    double current_z_mps; /* velocity of the water along z; [-10, 10] */
} pelagic_water_frame;
static inline pelagic_water_frame pelagic_water_frame_make(void) { PELAGIC_MAKE(pelagic_water_frame); }
/* end of generated */

/* Sets the sea level and the current of frames that are scheduled from now on, and the current of the ocean's dynamic
 * waves. All are 0 at first. The current has flowed since t = 0: to change it moves the sea by the change times t.
 * Errors: PELAGIC_INVALID_ARGUMENT for any value but 0 with pelagic_ocean_options.shore. */
PELAGIC_API pelagic_status pelagic_ocean_set_water_frame(pelagic_ocean* ocean, const pelagic_water_frame* water);

/* Shifts the world's origin to a position of the world as it was before any shift, each in [-1e8, 1e8]. It counts for
 * frames that are scheduled from now on, for commands of dynamic waves and for spray; commands that wait keep their
 * places. A position in the old coordinates plus the old origin minus the new one is that in the new ones:
 * pelagic_bodies_shift() moves bodies. Textures, hashes and a shore's place stay. */
PELAGIC_API pelagic_status pelagic_ocean_set_origin(pelagic_ocean* ocean, double x_m, double z_m);

typedef struct pelagic_ocean_info {
    uint64_t memory_bytes; /* all memory of the ocean, two frames and the spectrum included */
    const char* isa;
    const char* executor;  /* "serial", "thread", "tbb" or "application" */
    int32_t resolution;    /* N, of each cascade */
    int32_t cascade_count; /* of every frame */
    int32_t threads;       /* maximum number of threads that work on a frame */
} pelagic_ocean_info;

/* Writes the properties of an ocean. */
PELAGIC_API pelagic_status pelagic_ocean_describe(const pelagic_ocean* ocean, pelagic_ocean_info* info);

/* ---- Frames ---------------------------------------------------------------------------------- */

/* A square array of floats in blocks of a few columns. Texel (i, j), column i and row j, is
 * data[i / block_columns * block_stride + j * row_stride + i % block_columns]; strides are in floats. The number of
 * columns in a block depends on the instruction set. */
typedef struct pelagic_plane {
    const float* data; /* NULL if the ocean was made without this plane */
    int32_t resolution, block_columns;
    ptrdiff_t row_stride, block_stride;
} pelagic_plane;

/* Extremes of displacements, for culling boxes. Those of a cascade are exact. Those of a frame are the sums over its
 * cascades, whose extremes need not coincide: upper bounds, exact if cascade_count is 1. */
typedef struct pelagic_bounds {
    float height_min_m, height_max_m;
    float horizontal_x_max_m, horizontal_z_max_m; /* largest |Dx| and |Dz| */
} pelagic_bounds;

/* A frame, which is a stack of cascades, the coarsest first. The planes and textures here are those of the first
 * cascade, which is the whole frame if cascade_count is 1. Texel (i, j) then has the undisplaced position
 * x = i L / N, z = j L / N and is drawn at (x + Dx, height, z + Dz), in metres. With more cascades, see
 * pelagic_cascade. */
typedef struct pelagic_frame {
    int32_t resolution; /* N */
    int32_t cascade_count;
    double time_s;
    double patch_size_m; /* L, the first cascade's side */
    pelagic_plane dx, height, dz;
    pelagic_plane velocity_x, velocity_y, velocity_z; /* in m/s; with PELAGIC_VELOCITIES_DRAWN */
    /* N^2 texels of four IEEE half floats in tight rows of 8 N bytes: Dx, height, Dz, 0. The layout is that of
     * GL_RGBA16F with GL_HALF_FLOAT and of VK_FORMAT_R16G16B16A16_SFLOAT. NULL if written to texture targets. */
    const uint16_t* displacement_rgba16f;
    /* A mipmap chain of gradient_levels levels of N, N / 2, ..., 1 texels a side, in tight rows of 4 bytes a texel:
     * normal x, normal z, Jacobian, smoothness. GL_RGBA8, VK_FORMAT_R8G8B8A8_UNORM. Level m begins at texel
     * gradient_offset[m]. NULL and no levels if absent, see pelagic_cascade. */
    const uint32_t* gradient_rgba8;
    double foam_drift_x_mps, foam_drift_z_mps; /* drift velocity of foam, by wind and waves; world's axes */
    int32_t gradient_levels;
    uint32_t gradient_offset[12];
    pelagic_bounds bounds; /* of the sum of all cascades */
    /* GGX's alpha of unresolved waves, in [0, 1]: its square is the mean square of the slopes that no cascade holds.
     * Smoothness is 1 - sqrt(roughness). */
    float roughness;
    float foam_level;   /* see pelagic_cascade; 1000 without foam, and if the sea has no whitecaps */
    float foam_age[16]; /* 1 and more: the snapshot has no effect */
    uint64_t number;      /* of the frame, for pelagic_points.frame; from 1 on */
    double wave_height_m; /* significant wave height, mean over all seeds */
    /* Droplets of emitters, then those of crests, each with the newest first, at most 8192; NULL without
     * pelagic_ocean_options.spray. Droplets below the water are not removed. */
    const struct pelagic_droplet* droplets;
    size_t droplet_count;
} pelagic_frame;

/* A cascade: a wavelength band and its square domain, which repeats along its own two axes. The displacements of a
 * frame are the sums over its cascades: the water with the undisplaced position (x, z) is drawn at
 * (x + Dx, height, z + Dz).
 *
 * Positions. L being side_m and N the resolution, texel (i, j), column i and row j, has the undisplaced position
 *   x = (cosine i - sine j) L / N,  z = (sine i + cosine j) L / N.
 * So (x, z) lies at column u N and row v N, both modulo N, with
 *   u = (cosine x + sine z) / L,  v = (cosine z - sine x) / L.
 * In a repeating texture, whose texel centres are half a texel in, the texture coordinate is
 * (u + 0.5 / N, v + 0.5 / N) at every level. Texels hold values in the world's axes, whatever the rotation.
 *
 * Slopes. The normal and Jacobian of a sum of cascades are not the sums of theirs, but the derivatives are. Filtering
 * and mipmaps may be applied before the sum. Two chains like gradient_rgba8 hold derivatives, four bytes a texel from
 * the lowest up:
 *   slopes_rgba8   h_x, h_z, D_xx, D_zz         (byte - 128) / 127 * slope_range each
 *   moments_rgba8  D_xz                         (byte - 128) / 127 * slope_range
 *                  var_xx, var_zz               byte / 255 * variance_range
 *                  cov_xz                       (byte - 128) / 127 * variance_range
 * A texture sample returns byte / 255. h_x is the derivative of the height along x at the undisplaced position. D_xz
 * is the derivative of Dx along z, which equals that of Dz along x. The variances are those of h_x and h_z within a
 * texel, for roughness (LEAN mapping, Olano and Baker 2010): GGX's alpha^2 is
 * var_xx + var_zz + pelagic_frame.roughness^2. With each quantity summed over the cascades, the Jacobian J and an
 * unnormalised normal n are
 *   J = (1 + D_xx) (1 + D_zz) - D_xz^2,
 *   n = (h_z D_xz - h_x (1 + D_zz), J, h_x D_xz - h_z (1 + D_xx)).
 *
 * Water breaks where the sum of the cascades does. A byte b of compression is q = -3 + 8 b / 255:
 * b = compression_r8[texel] now, and b = byte s % 4 (from the lowest) of a texel of snapshots_rgba8[s / 4] for
 * snapshot s of 16. Let S_s be the sum over the cascades of the q of snapshot s, and S that of the q now. The foam at
 * a position is the largest of
 *   clamp(1/2 + (S - foam_level) / 0.3, 0, 1)  and
 *   clamp(1/2 + (S_s - foam_level) / 0.3, 0, 1) - foam_age[s],
 * where foam_level and foam_age are members of pelagic_frame. Snapshots drift: water at texel (i, j) has those of
 * texel (i - drift_columns, j - drift_rows). Images 0 and 1 hold every second snapshot, enough for a cheap reader. */
typedef struct pelagic_cascade {
    int32_t resolution; /* N */
    int32_t levels;     /* number of levels of each chain that is not NULL */
    double side_m;      /* L */
    /* Of the angle by which the cascade's axes are rotated from +x to +z; 1 and 0: not rotated. */
    double cosine, sine;
    /* Planes and textures as in pelagic_frame, of this cascade alone. */
    pelagic_plane dx, height, dz;
    pelagic_plane velocity_x, velocity_y, velocity_z;
    const uint16_t* displacement_rgba16f;
    const uint32_t* gradient_rgba8;
    const uint32_t *slopes_rgba8, *moments_rgba8; /* NULL without pelagic_ocean_options.slopes */
    /* N^2 bytes in tight rows, and four chains of `levels` levels. NULL without pelagic_ocean_options.foam, and for a
     * cascade that makes no foam. */
    const uint8_t* compression_r8;
    const uint32_t* snapshots_rgba8[4];
    /* Differs whenever an image differs, in all oceans of the process. One changes about five times a second. */
    uint64_t snapshots_version[4];
    double drift_columns, drift_rows; /* texels, [0, N) */
    uint32_t level_offset[12];        /* first texel of level m in each chain */
    pelagic_bounds bounds;
    float slope_range, variance_range;
    /* The compression of slopes_rgba8: q over -(D_xx + D_zz + front_x h_x + front_z h_z) of this cascade, and the
     * front, which all cascades share. */
    float compression_scale, compression_front_x, compression_front_z;
} pelagic_cascade;

/* Starts a frame and returns immediately.
 * time_s: any finite time, in any order. A frame is a pure function of the sea and the time, and
 *   time_s + n * loop_period_s gives a bit-identical frame.
 * A frame with N up to 64, and any frame of an executor without threads, is computed in complete(). The call waits
 * for queries that began before the last complete(), because it overwrites the frame that they read.
 * Errors: PELAGIC_WRONG_ORDER if a frame is in flight. */
PELAGIC_API pelagic_status pelagic_ocean_schedule(pelagic_ocean* ocean, double time_s);

/* Memory of the application, for instance a mapped pixel buffer, that receives the textures of a cascade: an array of
 * cascade_count structs, as for pelagic_frame_buffers. A texture whose pointer is NULL is part of the frame. Each
 * byte is written once, in rows of whole registers, and never read, so the memory may be write-combined. */
typedef struct pelagic_texture_targets {
    uint32_t struct_size;
    uint32_t cascade_count;         /* first struct: cascades of the frame, 0 for one; other structs: 0 */
    uint16_t* displacement_rgba16f; /* 4 N^2 in tight rows, at a multiple of 64 bytes */
    /* Level m: (N >> m)^2 texels in tight rows, at a multiple of 4 bytes. All levels of a chain, or none. */
    uint32_t* gradient_rgba8[12];
    uint32_t *slopes_rgba8[12], *moments_rgba8[12];
} pelagic_texture_targets;
static inline pelagic_texture_targets pelagic_texture_targets_make(void) { PELAGIC_MAKE(pelagic_texture_targets); }

/* Starts a frame as pelagic_ocean_schedule(), with textures in memory of the application, which must stay valid until
 * complete() returns. In the frame and its cascades the pointers of these textures are NULL, and hashes leave the
 * textures out. */
PELAGIC_API pelagic_status pelagic_ocean_schedule_into(pelagic_ocean* ocean, double time_s,
                                                       const pelagic_texture_targets* targets);

/* Writes 1 if complete() would not wait for other threads or no frame is in flight, else 0. Never blocks. Do not spin
 * on it: if other work occupies the threads, complete() may have to do the work. */
PELAGIC_API pelagic_status pelagic_ocean_poll(const pelagic_ocean* ocean, int32_t* is_ready);

/* Completes the frame in flight and writes its description. The calling thread takes part in the work.
 * Errors: PELAGIC_WRONG_ORDER if no frame is in flight. The frame is lost, and another may be scheduled, after three
 *   errors: PELAGIC_INVALID_ARGUMENT if a wave input wrote a value out of range; PELAGIC_APPLICATION_ERROR if a
 *   callback failed; PELAGIC_SYSTEM_ERROR if a job needed a thread with a larger stack and the system had none.
 * Lifetime: what `frame` points to stays valid until the second schedule from now, or until pelagic_ocean_destroy().
 *   So it remains valid while the next frame is computed. */
PELAGIC_API pelagic_status pelagic_ocean_complete(pelagic_ocean* ocean, pelagic_frame* frame);

/* Writes the description of a cascade, [0, cascade_count), of the frame completed last, also while the next frame is
 * computed. What it points to is valid as long as the frame's pointers. */
PELAGIC_API pelagic_status pelagic_ocean_cascade(const pelagic_ocean* ocean, int32_t index, pelagic_cascade* cascade);

/* Memory that receives the planes and textures of a cascade. A NULL pointer leaves that array out. Counts are exact,
 * in elements. Rows are tight: texel (i, j) is element j N + i. A frame needs an array of these structs, one for each
 * cascade. All have the struct_size of the first, whose cascade_count is their number. */
typedef struct pelagic_frame_buffers {
    uint32_t struct_size;
    uint32_t cascade_count; /* first struct: cascades of the frame, 0 for one; other structs: 0 */
    size_t plane_count;     /* N^2, the length of each plane */
    float *dx, *height, *dz;
    float *velocity_x, *velocity_y, *velocity_z;
    size_t rgba16f_count; /* 4 N^2 */
    uint16_t* displacement_rgba16f;
    size_t rgba8_count; /* texels of the chain: (4 N^2 - 1) / 3 */
    uint32_t* gradient_rgba8;
    size_t slopes_count; /* the length of each of the two chains, equal to rgba8_count */
    uint32_t *slopes_rgba8, *moments_rgba8;
} pelagic_frame_buffers;
static inline pelagic_frame_buffers pelagic_frame_buffers_make(void) { PELAGIC_MAKE(pelagic_frame_buffers); }

/* Copies the frame completed last, also while the next is computed: planes in tight rows, chains with all levels. */
PELAGIC_API pelagic_status pelagic_ocean_copy(const pelagic_ocean* ocean, const pelagic_frame_buffers* buffers);

/* Computes a frame synchronously and writes it to the caller's memory, and its bounds unless NULL; for servers and
 * replays. The frame completed last stays valid, and queries continue to read it. Before the first
 * pelagic_ocean_complete(), queries, cascade, copy and hash read the frame computed here.
 * Errors: as pelagic_ocean_schedule() and pelagic_ocean_complete(). */
PELAGIC_API pelagic_status pelagic_ocean_frame_at(pelagic_ocean* ocean, double time_s,
                                                  const pelagic_frame_buffers* buffers, pelagic_bounds* bounds);

/* What a hash of a frame covers. FRAME: all outputs but velocities and what the others cover; it differs between
 * frames with and without planes. */
enum {
    PELAGIC_HASH_FRAME = 0, PELAGIC_HASH_FOAM = 1, PELAGIC_HASH_DYNAMIC_WAVES = 2, PELAGIC_HASH_SHORE = 3,
    PELAGIC_HASH_SPRAY = 4
};

/* Computes the hash of kind PELAGIC_HASH_... of a frame; `frame` as pelagic_points.frame. Threads: any. */
PELAGIC_API pelagic_status pelagic_ocean_frame_hash(const pelagic_ocean* ocean, uint64_t frame, int32_t kind,
                                                    uint64_t* hash);

/* ---- Another sea ----------------------------------------------------------------------------- */

/* Starts to compute the spectrum of another sea; a frame may be in flight. Frames show the current sea until
 * pelagic_ocean_complete_sea().
 * sea: must have the ocean's resolution, number of cascades and kind of waves (pond or not).
 * Errors: PELAGIC_INVALID_ARGUMENT for an invalid or incompatible sea, and for an ocean with a shore;
 *   PELAGIC_WRONG_ORDER if another sea is being computed. */
PELAGIC_API pelagic_status pelagic_ocean_schedule_sea(pelagic_ocean* ocean, const pelagic_sea* sea);

/* Writes 1 if pelagic_ocean_complete_sea() would not wait or no sea is being computed, else 0. Never blocks. */
PELAGIC_API pelagic_status pelagic_ocean_poll_sea(const pelagic_ocean* ocean, int32_t* is_ready);

/* Waits for the spectrum and makes the new sea current, for frames scheduled from now on. Discards all changes of the
 * forecast.
 * Errors: PELAGIC_WRONG_ORDER if no sea is being computed or a frame is in flight; PELAGIC_APPLICATION_ERROR if a
 *   callback failed: the old sea remains current. */
PELAGIC_API pelagic_status pelagic_ocean_complete_sea(pelagic_ocean* ocean);

/* ---- Forecasts ------------------------------------------------------------------------------- */

/* A sea-state transition. The energy of each wave changes smoothly from one sea to the next, and a frame remains a
 * pure function of the forecast and the time, in any order. */
typedef struct pelagic_change {
    uint32_t struct_size;
    const pelagic_sea* sea; /* the sea after the transition; read before the call returns */
    double from_s;          /* start; not before the end of the preceding change */
    double over_s;          /* duration; (0, 1e9] */
    /* Distance to the origin of the swell; [1e3, 2e7], or 0: all waves change together. Long waves arrive first, by
     * their group velocities, and each changes over over_s. */
    double swell_from_m;
} pelagic_change;
static inline pelagic_change pelagic_change_make(void) { PELAGIC_MAKE(pelagic_change); }

/* A sea and its transitions. All seas have equal numbers and kinds of cascades, resolution, depth_m, loop_period_s
 * and seed. */
typedef struct pelagic_forecast {
    uint32_t struct_size;
    uint32_t change_count;
    const pelagic_sea* first; /* the sea before the first change */
    /* change_count structs in order of time, all of the struct_size of the first; NULL if there are none. */
    const pelagic_change* changes;
    /* Longest peak wavelength that the cascades can hold, which limits later changes; (0, 1e5]. 0: the longest of
     * these seas. Ignored if patch_size_m is set. */
    double largest_peak_m;
} pelagic_forecast;
static inline pelagic_forecast pelagic_forecast_make(void) { PELAGIC_MAKE(pelagic_forecast); }

/* Creates an ocean with a forecast; options may be NULL. The spectra of later seas are computed together with frames,
 * before frames need them. After a jump in time a frame may wait for one. */
PELAGIC_API pelagic_status pelagic_ocean_create_forecast(const pelagic_forecast* forecast,
                                                         const pelagic_ocean_options* options, pelagic_ocean** ocean);

/* Writes the sea of the frame completed last, which lies between two seas during a change. */
PELAGIC_API pelagic_status pelagic_ocean_sea(const pelagic_ocean* ocean, pelagic_sea* sea);

/* Writes warnings about the first sea, and about cascades that largest_peak_m makes too coarse, as lines and a final
 * 0. Takes as long as creating an ocean. `text` may be NULL; `room` is its size; `count` receives the bytes. */
PELAGIC_API pelagic_status pelagic_forecast_warnings(const pelagic_forecast* forecast, char* text, size_t room,
                                                     size_t* count);

/* Appends a change to the forecast, whose spectrum is computed together with frames from now on; a frame may be in
 * flight. The call takes about 2 ms. The ocean keeps the last two changes: frames of earlier times show the oldest
 * sea that it has. A change from before the frame that was scheduled last starts at that frame's time, so that the
 * water does not jump; pelagic_ocean_frame_at() with a frame completed before does not count. That time differs
 * between peers: schedule changes that begin after every peer's frame.
 * Errors: PELAGIC_INVALID_ARGUMENT for an invalid change, and for an ocean with a shore; PELAGIC_WRONG_ORDER between
 *   pelagic_ocean_schedule_sea() and pelagic_ocean_complete_sea(). */
PELAGIC_API pelagic_status pelagic_ocean_schedule_change(pelagic_ocean* ocean, const pelagic_change* change);

/* ---- Dynamic waves --------------------------------------------------------------------------- */

/* generated from schema/dynamic_waves.toml: c-enumerations */
enum {
    /* Advances each wave by its own phase: the exact dispersion of deep or shallow water, stable at any length of
     * a tick; wakes have Kelvin's angle. */
    PELAGIC_DYNAMIC_WAVES_SPECTRAL = 0,
    /* h' = h + d^2 (h - h_before) + d c lap h, d = e^(-decay dt), c = (speed dt / dx)^2 <= 0.4: one speed for all
     * waves, for ponds and rings. */
    PELAGIC_DYNAMIC_WAVES_VERLET = 1
};
/* end of generated */

/* Frames, bounds and queries of an ocean include its dynamic waves. The waves advance in ticks of a fixed length.
 * Equal commands between frames of equal times give bit-identical waves on every machine. */
/* generated from schema/dynamic_waves.toml: c-struct */
typedef struct pelagic_dynamic_waves_options {
    uint32_t struct_size;
    int32_t step;        /* PELAGIC_DYNAMIC_WAVES_...; how a tick advances the waves */
    int32_t resolution;  /* N, texels along a side; 64, 128, 256, 512 or 1024 */
    int32_t ticks_per_s; /* ticks of the simulation a second; [10, 240] */
    double side_m;       /* side of the grid; [1, 10000] */
    /* Width of the absorbing border along each side; [0.001, side_m / 4]. 0: no border, and waves wrap around. */
    double border_m;
    double depth_m; /* depth of the water (spectral); [0.01, 11000] */
    /* Eddy viscosity nu, which damps amplitudes at the rate 2 nu k^2 (spectral); [0, 1]. */
    double viscosity_m2ps;
    /* Speed of all waves, with (speed / (ticks_per_s texel))^2 at most 0.4 (verlet); (0, 1000]. */
    double wave_speed_mps;
    double decay_per_s;   /* decay rate of amplitudes; [0, 10] */
    double foam_height_m; /* foam begins above this height and is full at twice it; [0.001, 100] */
} pelagic_dynamic_waves_options;
static inline pelagic_dynamic_waves_options pelagic_dynamic_waves_options_make(void) {
    PELAGIC_ZEROS(pelagic_dynamic_waves_options, options); options.resolution = 256; options.ticks_per_s = 60;
    options.side_m = 64; options.border_m = 12; options.depth_m = 1e4; options.viscosity_m2ps = 2e-3;
    options.wave_speed_mps = 3; options.decay_per_s = 0.01; options.foam_height_m = 0.2; return options;
}
/* end of generated */

/* generated from schema/disturbance.toml: c-enumerations */
enum {
    PELAGIC_SHAPE_GAUSS = 0, /* height_m exp(-(r / radius_m)^2), cut off at 3 radii */
    /* height_m sqrt(1 - (along / length_m)^2 - (across / radius_m)^2) within that ellipse; height_m of a floating
     * hull is below 0. */
    PELAGIC_SHAPE_HULL = 1
};

enum {
    /* A pressure, or suction, equal to the weight of the shape's water: at rest the surface becomes the shape and
     * stays so, and a moving one leaves the waves of a moving pressure (Havelock 1908). The volume of the water
     * is constant. */
    PELAGIC_DISTURBANCE_PRESSURE = 0,
    /* The surface approaches the shape: a tick removes the fraction 1 - e^(-rate tick) of the difference, times
     * the shape over its height. The bulge is bounded, and its volume is added to the water. */
    PELAGIC_DISTURBANCE_RELAXATION = 1,
    PELAGIC_DISTURBANCE_IMPULSE = 2, /* the shape is added to the surface at once: a drop, a stone */
    /* Adds the foam that waves as high as the shape have, and no waves: water that a hull or a propeller breaks. */
    PELAGIC_DISTURBANCE_FOAM = 3
};
/* end of generated */

/* A disturbance of the water: an impulse, or a source that acts in every tick. */
/* generated from schema/disturbance.toml: c-struct */
typedef struct pelagic_disturbance {
    uint32_t struct_size;
    int32_t shape;                         /* PELAGIC_SHAPE_...; shape */
    int32_t mode;                          /* PELAGIC_DISTURBANCE_...; what the shape does to the water */
    double x_m, z_m;                       /* initial position in the world; [-1e8, 1e8] */
    double radius_m;                       /* radius, of a hull half its beam; [0.001, 1000] */
    double length_m;                       /* half the length of a hull; [0.001, 1000] */
    double heading_rad;                    /* direction of a hull's length, from +x towards +z; [-2 pi, 2 pi] */
    double height_m;                       /* height of the shape, below 0 for a floating hull; [-100, 100] */
    double rate_per_s;                     /* rate of a relaxation; (0, 1000] */
    double velocity_x_mps, velocity_z_mps; /* velocity of a source until it is replaced; [-1000, 1000] */
} pelagic_disturbance;
static inline pelagic_disturbance pelagic_disturbance_make(void) {
    PELAGIC_ZEROS(pelagic_disturbance, disturbance); disturbance.radius_m = 1; disturbance.length_m = 1;
    disturbance.rate_per_s = 10; return disturbance;
}
/* end of generated */

/* Dynamic waves: wakes, ripples and splashes on a grid around a point that the application sets. Commands are
 * add_impulse, add_source, set_source, remove_source, set_center and set_rain. They take effect in the order of the
 * calls, at the next pelagic_dynamic_waves_advance(). For the waves of an ocean that is its next schedule, whether or
 * not a frame is in flight. */
typedef struct pelagic_dynamic_waves pelagic_dynamic_waves;

typedef struct pelagic_dynamic_waves_resources {
    uint32_t struct_size;
    const pelagic_executor* executor; /* NULL: PELAGIC_EXECUTOR_DEFAULT */
    const char* isa;                  /* as pelagic_ocean_options.isa */
    pelagic_allocate allocate;        /* both functions or neither; NULL: operator new */
    pelagic_release release;
    void* memory_user; /* passed to both; must outlive the waves */
} pelagic_dynamic_waves_resources;
static inline pelagic_dynamic_waves_resources pelagic_dynamic_waves_resources_make(void) {
    PELAGIC_MAKE(pelagic_dynamic_waves_resources);
}

/* Creates dynamic waves without an ocean; resources may be NULL. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_create(const pelagic_dynamic_waves_options* options,
                                                        const pelagic_dynamic_waves_resources* resources,
                                                        pelagic_dynamic_waves** waves);

/* Waits for work in flight and destroys what pelagic_dynamic_waves_create() made. Ignores the waves of an ocean. */
PELAGIC_API void pelagic_dynamic_waves_destroy(pelagic_dynamic_waves* waves);

/* Returns the waves of pelagic_ocean_options.dynamic_waves, which the ocean owns and advances with its frames. */
PELAGIC_API pelagic_status pelagic_ocean_dynamic_waves(pelagic_ocean* ocean, pelagic_dynamic_waves** waves);

/* Enqueues a disturbance that acts once, in the next tick. At most 4096 impulses may wait for a tick. Impulses before
 * an advance to a time that is not later than the one before are provisional: the next such advance with impulses
 * replaces them. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_add_impulse(pelagic_dynamic_waves* waves,
                                                             const pelagic_disturbance* disturbance);

/* Adds a source, which acts in every tick and moves at its velocity, until it is removed. At most 4096 sources may
 * exist at once. `number` receives the source's number, which is never reused. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_add_source(pelagic_dynamic_waves* waves,
                                                            const pelagic_disturbance* source, uint32_t* number);

/* Replaces a source from the next tick on. Does nothing if no source has that number. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_set_source(pelagic_dynamic_waves* waves, uint32_t number,
                                                            const pelagic_disturbance* source);

/* Removes a source. Does nothing if no source has that number. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_remove_source(pelagic_dynamic_waves* waves, uint32_t number);

/* Moves the grid's centre to within half a texel of a point. Texels that enter the grid are flat. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_set_center(pelagic_dynamic_waves* waves, double x_m, double z_m);

/* Sets the current, each component in [-10, 10], which carries the grid. Positions and velocities of commands are
 * then in the world, and those of views in the water's frame. Set the centre again to keep the grid at a point. A
 * saved state does not include it. pelagic_ocean_set_water_frame() sets the current of an ocean's waves. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_set_current(pelagic_dynamic_waves* waves, double x_mps,
                                                             double z_mps);

/* Rain. Each drop adds a crater and a rim of equal volume, height_m (q - 1) e^-q with q = (r / radius_m)^2. The drops
 * depend only on the seed, the tick and the position in the world. */
/* generated from schema/rain.toml: c-struct */
typedef struct pelagic_rain {
    uint32_t struct_size;
    uint32_t seed; /* seed of the drops */
    /* Mean number of drops, at most the value that puts 16 on a texel in a tick; a finite number. 0: no rain. */
    double drops_per_m2_s;
    /* Radius of the crater at the rest level; [0.001, side_m / 16]. A crater narrower than a texel is a texel
     * wide on the grid, flatter and with equal volume. */
    double radius_m;
    double height_m; /* depth of a crater; [-10, 10] */
} pelagic_rain;
static inline pelagic_rain pelagic_rain_make(void) {
    PELAGIC_ZEROS(pelagic_rain, rain); rain.seed = 1; rain.radius_m = 0.25; rain.height_m = 0.02; return rain;
}
/* end of generated */

/* Sets the rain from the next tick on. Saved states include it. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_set_rain(pelagic_dynamic_waves* waves, const pelagic_rain* rain);

/* Computes the ticks up to a finite time. A time before that of the last call computes no tick, and later ticks are
 * counted from it. A jump ahead computes the ticks of at most half a second.
 * Errors: PELAGIC_WRONG_ORDER for the waves of an ocean, whose frames advance them. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_advance(pelagic_dynamic_waves* waves, double time_s);

/* The grid of dynamic waves, whose height adds to that of the cascades at the drawn position, x = undisplaced x + Dx
 * and z alike.
 *
 * Texel (i, j) of the world's grid has the position x = i texel_m, z = j texel_m. It is in column i mod N of row j
 * mod N. The grid has first_x <= i < first_x + N, first_z <= j < first_z + N. */
typedef struct pelagic_dynamic_waves_view {
    int64_t first_x, first_z;
    double texel_m;
    const float* height_m; /* N^2, 0 at the grid's edges */
    /* N^2 vertical velocities at the frame's time. Impulses have no initial velocity. */
    const float* vertical_velocity_mps;
    const uint8_t* foam; /* N^2 */
    int32_t resolution;  /* N, a power of two */
    float height_min_m, height_max_m;
} pelagic_dynamic_waves_view;

/* Writes a description of the waves of the last advance, or of the ocean's frame completed last.
 * Errors: PELAGIC_WRONG_ORDER before the first advance or frame.
 * Lifetime: the pointers are valid until the second advance or schedule from now. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_get_view(const pelagic_dynamic_waves* waves,
                                                          pelagic_dynamic_waves_view* view);

/* Computes the hash of the view, with the errors of pelagic_dynamic_waves_get_view(). */
PELAGIC_API pelagic_status pelagic_dynamic_waves_hash(const pelagic_dynamic_waves* waves, uint64_t* hash);

/* Saves all that later ticks depend on, sources included, except commands since the last advance; about 17 N^2
 * bytes. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_save_state(const pelagic_dynamic_waves* waves, uint8_t* bytes,
                                                            size_t room, size_t* count);

/* Restores a state, which must have been saved with equal options. Discards commands since the last advance. */
PELAGIC_API pelagic_status pelagic_dynamic_waves_restore_state(pelagic_dynamic_waves* waves, const uint8_t* bytes,
                                                               size_t count);

/* ---- Spray ----------------------------------------------------------------------------------- */

/* Droplets that leave breaking crests near a centre, and droplets of emitters. Each stands for a clump of drops.
 * Droplets of crests are a function of the sea, the time in the loop and the centre, on every machine. Those of
 * emitters are state, which can be saved. */
/* generated from schema/spray_options.toml: c-struct */
typedef struct pelagic_spray_options {
    uint32_t struct_size;
    uint32_t seed;  /* seed of the droplets */
    double reach_m; /* spray leaves crests within this distance of the centre; [10, 200] */
    double amount;  /* factor on the number of droplets of crests; [0, 10] */
} pelagic_spray_options;
static inline pelagic_spray_options pelagic_spray_options_make(void) {
    PELAGIC_ZEROS(pelagic_spray_options, options); options.seed = 1; options.reach_m = 80; options.amount = 1;
    return options;
}
/* end of generated */

/* Droplets that leave a ball at once, for instance at the bow of a ship; in the world. */
/* generated from schema/spray_emitter.toml: c-struct */
typedef struct pelagic_spray_emitter {
    uint32_t struct_size;
    int32_t count;                                         /* number of droplets; [0, 8192] */
    double time_s;                                         /* time at which they leave; [-1e9, 1e9] */
    double x_m, y_m, z_m;                                  /* centre of the ball; [-1e8, 1e8] */
    double extent_m;                                       /* radius of the ball; [0, 100] */
    double velocity_x_mps, velocity_y_mps, velocity_z_mps; /* mean velocity; [-100, 100] */
    double spread_mps;                                     /* largest deviation from the mean velocity; [0, 100] */
    double radius_m;                                       /* radius of a droplet as it leaves; [0.001, 1] */
    double drop_mm;                                        /* diameter of drops, which sets the drag; [0.1, 5] */
} pelagic_spray_emitter;
static inline pelagic_spray_emitter pelagic_spray_emitter_make(void) {
    PELAGIC_ZEROS(pelagic_spray_emitter, emitter); emitter.count = 1; emitter.radius_m = 0.05;
    emitter.drop_mm = 1; return emitter;
}
/* end of generated */

/* Sets the centre of the spray of crests, usually the camera, in the world. It takes effect at the next schedule, for
 * the ticks computed from then on. It is the origin at first. */
PELAGIC_API pelagic_status pelagic_ocean_set_spray_center(pelagic_ocean* ocean, double x_m, double z_m);

/* Adds droplets of emitters to frames that are scheduled from now on. The ocean keeps them for jumps in time; of more
 * than 8192, it discards the oldest.
 * emitters: `count` structs of one struct_size, of at most 8192 droplets together; may be NULL if `count` is 0. */
PELAGIC_API pelagic_status pelagic_ocean_emit(pelagic_ocean* ocean, const pelagic_spray_emitter* emitters,
                                              size_t count);

/* A droplet of pelagic_frame.droplets, in the world. */
typedef struct pelagic_droplet {
    double position_m[3];
    float velocity_mps[3];
    float radius_m;
    float opacity; /* at the middle of the droplet, [0, 1] */
    float age_s;   /* since it left the water, [0, 1.5) */
} pelagic_droplet;

/* Saves the droplets of emitters; at most 918 KB. */
PELAGIC_API pelagic_status pelagic_ocean_save_spray(const pelagic_ocean* ocean, uint8_t* bytes, size_t room,
                                                    size_t* count);

/* Replaces the droplets of emitters. */
PELAGIC_API pelagic_status pelagic_ocean_restore_spray(pelagic_ocean* ocean, const uint8_t* bytes, size_t count);

/* ---- Shores ---------------------------------------------------------------------------------- */

/* A sea floor, which may rise above the water as a beach or an island. Within its rectangle the depth slows, refracts
 * and shoals long waves, and they break. Waves reach the lee of land only by refraction. Queries and bounds include
 * the effects.
 *
 * Beyond the rectangle the floor continues as at its nearest edge: dry ground stays dry, and the sea is open where it
 * is deep enough for its waves. The sea must have at least two cascades and cannot change. */
typedef struct pelagic_shore_options {
    uint32_t struct_size;
    /* generated from schema/shore.toml: c-members */
    int32_t columns;    /* samples of the floor along x; 2 to 4096 */
    int32_t rows;       /* samples of the floor along z; 2 to 4096 */
    int32_t resolution; /* texels along the longer side of the shore; 64, 128, 256, 512 or 1024 */
    /* Heights above the rest level, columns * rows of them, [-11000, 9000]; sample (i, j) is element j * columns
     * + i. Read before the call returns. */
    const float* heights_m;
    double corner_x_m, corner_z_m; /* position of the first sample; [-1e8, 1e8] */
    double metres_per_sample;      /* distance of neighbouring samples; [0.001, 10000] */
    /* Width of the strip along the edges over which the coarsest cascade fades into waves over the floor;
     * [0, half the field's shorter side]. 0: an eighth of the shorter side. */
    double fade_m;
    /* Maximum height above still water that waves reach on dry sand, with the set-up; [0, 10]. 0: the height that
     * 2 % of the waves reach by Stockdon et al. 2006, from the sea's significant wave height and peak period and
     * the median slope at the waterline. Waves in the water do not depend on it. */
    double swash_m;
    /* end of generated */
} pelagic_shore_options;
/* generated from schema/shore.toml: c-make */
static inline pelagic_shore_options pelagic_shore_options_make(void) {
    PELAGIC_ZEROS(pelagic_shore_options, options); options.resolution = 256; options.metres_per_sample = 1;
    return options;
}
/* end of generated */

/* The waves at a shore. At a drawn position in the rectangle, each cascade is multiplied by its weight there and
 * height_m is added to the sum. Texel (i, j) has the position x_m + i texel_m, z_m + j texel_m and is element
 * j * columns + i.
 *
 * Between texels height_m and vertical_velocity_mps are cubic (Keys 1981, 4 x 4 texels; those of the edge are
 * repeated beyond it); all else is bilinear. Beyond the rectangle, depths and weights are those of the nearest
 * position on its edge, and the height is 0, as on the edge. */
typedef struct pelagic_shore_surface {
    int32_t columns, rows;
    double texel_m;
    double x_m, z_m;
    const float* depth_m;          /* of still water; below 0 on land */
    const uint32_t* weights_rgba8; /* weight of cascade t in byte t from the lowest up, 255 for 1 */
    const float* height_m;
    const float* vertical_velocity_mps;
    const float* reach_m; /* envelope of the crests of the passing waves: sand below it is wet */
    const uint8_t* foam;  /* of breaking waves */
    /* Velocity potential: its gradient is the horizontal velocity of these waves at the surface, by linear theory. */
    const float* potential_m2ps;
    float height_min_m, height_max_m; /* bounds of the height, between texels too */
    float weights_change_per_m;       /* largest change of a weight between positions a metre apart */
} pelagic_shore_surface;

/* Writes a description of the shore of the frame completed last, with pointers valid as long as the frame's. */
PELAGIC_API pelagic_status pelagic_ocean_shore(const pelagic_ocean* ocean, pelagic_shore_surface* surface);

/* ---- Wave inputs ----------------------------------------------------------------------------- */

/* A wave input, which adds waves to the cascades themselves. So normals, bounds, foam, queries and textures include
 * them, and they repeat with their cascade. They change PELAGIC_HASH_FRAME. An input belongs to one ocean. Its
 * values take effect at the next schedule. PELAGIC_INVALID_ARGUMENT: a set function of another kind of input. */
typedef struct pelagic_input pelagic_input;

/* A batch of Gerstner waves in deep water. Each wave is moved to the nearest grid point of the cascade that holds
 * waves of its length, and has a whole number of periods in a loop. */
typedef struct pelagic_waves {
    uint32_t struct_size;
    size_t count;                /* number of waves; at most 64, and 0 adds nothing */
    const double* amplitude_m;   /* `count` values, as in the arrays below; [0, 100] */
    const double* wavelength_m;  /* [0.01, 1000] */
    const double* direction_rad; /* direction the wave runs towards, from +x to +z; [-2 pi, 2 pi] */
    const double* phase_rad;     /* at x = z = t = 0, where 0 is a crest; NULL: all 0 */
    /* 1: water moves in circles, 0: a height field; [0, 1]. The sum of 2 pi amplitude / wavelength is at most 0.4. */
    double choppiness;
} pelagic_waves;
static inline pelagic_waves pelagic_waves_make(void) {
    PELAGIC_ZEROS(pelagic_waves, waves); waves.choppiness = 1; return waves;
}

/* Creates an input of Gerstner waves. */
PELAGIC_API pelagic_status pelagic_input_create_waves(const pelagic_waves* waves, pelagic_input** input);

/* Replaces the waves of an input of Gerstner waves from the next schedule on. */
PELAGIC_API pelagic_status pelagic_input_set_waves(pelagic_input* input, const pelagic_waves* waves);

/* Rings that run outwards from a point, in the cascade that holds waves of their length L. The height is, with
 * q^2 = r^2 + (L / 2)^2,
 *   amplitude (1 - (r / reach)^2)^2 sqrt(L / 2 / q) cos(2 pi ((q - L / 2) / L - f t) + phase). */
/* generated from schema/ripple.toml: c-struct */
typedef struct pelagic_ripple {
    uint32_t struct_size;
    double x_m, z_m;     /* centre; [-1e8, 1e8] */
    double wavelength_m; /* wavelength; [0.01, 1000] */
    double amplitude_m;  /* amplitude at the centre, at most wavelength_m / (2 pi), a slope of 1; [0, 100] */
    /* Radius R beyond which the rings are 0; [0, 1e5]. 0 or more than half of the cascade's side: half of that
     * side. */
    double reach_m;
    double phase_rad; /* phase at the centre at t = 0, where 0 is a crest; [-2 pi, 2 pi] */
} pelagic_ripple;
static inline pelagic_ripple pelagic_ripple_make(void) {
    PELAGIC_ZEROS(pelagic_ripple, ripple); ripple.wavelength_m = 1; return ripple;
}
/* end of generated */

/* Creates an input of rings. */
PELAGIC_API pelagic_status pelagic_input_create_ripple(const pelagic_ripple* ripple, pelagic_input** input);

/* Replaces the rings of an input of rings from the next schedule on. */
PELAGIC_API pelagic_status pelagic_input_set_ripple(pelagic_input* input, const pelagic_ripple* ripple);

/* Rows of a cascade at a time: column i of row first_row + j is element j N + i. All floats are 0 before the call.
 * The values that the callback writes are added to the cascade, in metres and metres a second along the world's axes.
 * They must be finite and at most 1000 in magnitude. pelagic_cascade gives the undisplaced positions of texels. */
typedef struct pelagic_input_rows {
    double time_s, loop_period_s;
    double side_m, cosine, sine;
    float *dx, *height, *dz;
    float *velocity_x, *velocity_y, *velocity_z; /* NULL without velocities, and in ticks */
    int32_t cascade;                             /* 0 is the coarsest */
    int32_t resolution;                          /* N */
    int32_t first_row, row_count;
    /* Position in the loop, in units of 2^-32 of it. An input that uses only this is bit-identical in every loop. */
    uint32_t loop_turns;
    int32_t is_tick; /* 1: a tick of foam accumulation, at a time before the frame's */
} pelagic_input_rows;

/* Writes the waves of some rows.
 * Errors: if the function throws, complete() returns PELAGIC_APPLICATION_ERROR; if it writes a value out of range,
 *   PELAGIC_INVALID_ARGUMENT. That frame is lost; the ocean remains usable.
 * Threads: called from any thread, for several rows and cascades at once. */
typedef void (*pelagic_add_rows)(void* user, const pelagic_input_rows* rows);

typedef struct pelagic_input_callback {
    uint32_t struct_size;
    uint32_t cascades; /* bit i: cascade i; 0: all */
    pelagic_add_rows add;
    void* user; /* passed to `add`; must outlive the ocean */
    /* Largest slope that the callback adds to a cascade; [0, 100]. Larger ones are clamped in slopes_rgba8. */
    double largest_slope;
} pelagic_input_callback;
static inline pelagic_input_callback pelagic_input_callback_make(void) { PELAGIC_MAKE(pelagic_input_callback); }

/* Creates an input that calls a function of the application. */
PELAGIC_API pelagic_status pelagic_input_create_callback(const pelagic_input_callback* callback,
                                                         pelagic_input** input);

/* Releases the handle. An ocean that uses the input keeps what it needs. */
PELAGIC_API void pelagic_input_destroy(pelagic_input* input);

/* ---- Queries --------------------------------------------------------------------------------- */

/* Interpolation between texels. */
enum {
    /* The surface that a GPU draws. */
    PELAGIC_INTERPOLATION_LINEAR = 0,
    /* For measurements: keeps the heights and slopes of short waves; 2 to 4 times the work. */
    PELAGIC_INTERPOLATION_CUBIC = 1
};

/* Positions in the world, in metres, at any distance from the origin: the sea repeats in double precision. A position
 * that is not finite has no sample: its error is infinite, it is not converged, and its other results are the quiet
 * NaN 0x7fc00000. */
typedef struct pelagic_points {
    uint32_t struct_size;
    int32_t interpolation; /* PELAGIC_INTERPOLATION_...; foam is linear in both */
    /* Nonzero: the executor's threads take part if there are more than 512 points. The call then waits for them,
     * and may allocate. */
    int32_t parallel;
    /* pelagic_frame.number of a frame, which can be read until the second schedule after its own; 0: the frame
     * completed last. */
    uint64_t frame;
    double tolerance_m; /* as pelagic_ocean_options.query_tolerance_m; 0: that of the ocean */
    /* Leaves out waves shorter than about this length, as pelagic_water_points.footprint_m; at least 0. Above 0 the
     * ocean needs pelagic_ocean_options.depth. Velocities are then the water's own, and the Jacobian is 1. */
    double footprint_m;
    size_t count;
    const double *x, *z; /* `count` values each; may be NULL if that is 0 */
} pelagic_points;
static inline pelagic_points pelagic_points_make(void) { PELAGIC_MAKE(pelagic_points); }

/* Arrays that receive the results, each as long as the points. A NULL pointer leaves a result out. No array may
 * overlap another or the points. */
typedef struct pelagic_samples {
    uint32_t struct_size;
    float* height_m;
    float *normal_x, *normal_y, *normal_z; /* unit normal of the displaced surface */
    float* jacobian;                       /* 1 at rest, small at sharp crests, negative where overturned */
    /* Velocity of the water at the position; with pelagic_ocean_options.velocities. */
    float *velocity_x_mps, *velocity_y_mps, *velocity_z_mps;
    float* error_m;     /* horizontal distance from the point to the sample's drawn position */
    uint8_t* converged; /* 1 if the error is within the tolerance */
    /* Fraction covered by foam, 0 to 1; with pelagic_ocean_options.foam, dynamic_waves or shore. */
    float* foam;
} pelagic_samples;
static inline pelagic_samples pelagic_samples_make(void) { PELAGIC_MAKE(pelagic_samples); }

/* Samples the surface of a frame. If the surface intersects itself above a position, the highest intersection is
 * returned. Results depend only on the frame, the point, the tolerance and the interpolation.
 * Errors: PELAGIC_WRONG_ORDER also for a frame whose memory has been reused.
 * Threads: any. Unless `parallel` is set, the call allocates nothing and never waits. */
PELAGIC_API pelagic_status pelagic_ocean_query(const pelagic_ocean* ocean, const pelagic_points* points,
                                               const pelagic_samples* samples);

/* Computes a frame at each of some times and samples it, as pelagic_ocean_schedule(), _complete() and _query(). The
 * next frame is computed during the queries of one. Between calls for the pieces of a long series the application may
 * show progress or stop.
 * times_s: `time_count` times, as pelagic_ocean_schedule() has them.
 * next_s: time of a frame that is in flight when the call returns, and with which the next piece begins; NULL: none.
 * points: `frame` is 0.
 * samples: arrays of time_count * points->count elements, time by time.
 * frame: receives the description of the last frame; may be NULL.
 * Errors: as those functions, after which no frame is in flight; PELAGIC_WRONG_ORDER if a frame of another time than
 *   the first is in flight, which remains. */
PELAGIC_API pelagic_status pelagic_ocean_query_series(pelagic_ocean* ocean, const double* times_s, size_t time_count,
                                                      const double* next_s, const pelagic_points* points,
                                                      const pelagic_samples* samples, pelagic_frame* frame);

/* Samples the water at undisplaced positions of the water's frame, each in [-1e9, 1e9], for meshes that move with it.
 * points: only count, x, z and frame are used.
 * displacement_m, velocity_mps: receive x, y and z of each point, with dynamic waves and a shore; may be NULL.
 * foam: receives a value for each point, as pelagic_samples.foam; may be NULL.
 * Errors: also with textures_only; PELAGIC_WRONG_ORDER as pelagic_ocean_query().
 * Threads: any. The call allocates nothing and never waits. */
PELAGIC_API pelagic_status pelagic_ocean_sample_undisplaced(const pelagic_ocean* ocean, const pelagic_points* points,
                                                            double* displacement_m, float* velocity_mps, float* foam);

typedef struct pelagic_ray {
    uint32_t struct_size;
    double origin_m[3];  /* x, y, z; [-1e9, 1e9] */
    double direction[3]; /* of any length in [1e-100, 1e100] */
    uint64_t frame;      /* as pelagic_points.frame */
    double tolerance_m;  /* as pelagic_points.tolerance_m */
    double reach_m;      /* maximum distance; 0 to 1e6 texels of the coarsest cascade, of L / N metres each */
} pelagic_ray;
static inline pelagic_ray pelagic_ray_make(void) { PELAGIC_MAKE(pelagic_ray); }

typedef struct pelagic_hit {
    int32_t is_hit;     /* 0: no intersection within reach_m, and the other fields are 0 */
    int32_t from_below; /* 1: the ray leaves the water */
    double distance_m;
    double position_m[3];
    float normal[3]; /* upper normal of the surface, whichever side is hit */
} pelagic_hit;

/* Finds the first hit of a ray on a frame's surface. The call allocates nothing and never waits. Threads: any. */
PELAGIC_API pelagic_status pelagic_ocean_first_hit(const pelagic_ocean* ocean, const pelagic_ray* ray,
                                                   pelagic_hit* hit);

/* Positions in the world, in metres: y is up, and not below the sea floor. */
typedef struct pelagic_water_points {
    uint32_t struct_size;
    /* Nonzero: the executor's threads take part if there are more than 16 points. The call may then allocate. */
    int32_t parallel;
    int32_t interpolation; /* PELAGIC_INTERPOLATION_...; of the surface */
    uint64_t frame;        /* as pelagic_points.frame */
    double tolerance_m;    /* as pelagic_points.tolerance_m */
    /* Leaves out waves shorter than about this length; at least 0. Exact water leaves out exactly these. In a frame,
     * pressure keeps 90 % or more of waves of twice the footprint, and 14 % or less of waves of half of it, if these
     * are in a cascade with texels of at most an eighth of the footprint; velocities do with texels of a sixteenth. */
    double footprint_m;
    double water_density_kgpm3; /* [500, 2000]; 0: 1025 */
    size_t count;
    const double *x, *y, *z; /* `count` values each; may be NULL if that is 0 */
} pelagic_water_points;
static inline pelagic_water_points pelagic_water_points_make(void) { PELAGIC_MAKE(pelagic_water_points); }

/* Arrays that receive the results, each as long as the points. A NULL pointer leaves a result out. No array may
 * overlap another or the points. Results at positions that are not finite are the quiet NaN 0x7fc00000. Above the
 * surface the pressure is 0, and velocity and acceleration are those at the surface. */
typedef struct pelagic_water_samples {
    uint32_t struct_size;
    float* depth_m;     /* below the surface above the point; negative in the air */
    float* pressure_pa; /* above that of the air */
    /* The water's own velocity, not scaled by choppiness. */
    float *velocity_x_mps, *velocity_y_mps, *velocity_z_mps;
    float *acceleration_x_mps2, *acceleration_y_mps2, *acceleration_z_mps2;
} pelagic_water_samples;
static inline pelagic_water_samples pelagic_water_samples_make(void) { PELAGIC_MAKE(pelagic_water_samples); }

/* Samples the water of a frame; with pelagic_ocean_options.queries and depth. The depth is that below the surface of
 * pelagic_ocean_query(). docs/queries.md has the accuracy.
 * Errors: PELAGIC_INVALID_ARGUMENT also for a point below the sea floor; PELAGIC_WRONG_ORDER as
 *   pelagic_ocean_query().
 * Threads: any. Unless `parallel` is set, the call allocates nothing and never waits. */
PELAGIC_API pelagic_status pelagic_ocean_sample_water(const pelagic_ocean* ocean, const pelagic_water_points* points,
                                                      const pelagic_water_samples* samples);

/* ---- Exact water ----------------------------------------------------------------------------- */

/* The exact sum over the waves of a sea, without frames, for servers and tests: surface, pressure, velocity and
 * acceleration of the water at any position and depth, by linear theory at fixed positions. The waves are those of
 * an ocean's frames, before displacement. A sample takes some 25 microseconds for four cascades of 128. */
/* generated from schema/exact_water.toml: c-struct */
typedef struct pelagic_exact_water_options {
    uint32_t struct_size;
    double water_density_kgpm3;             /* density of the water; [500, 2000] */
    const pelagic_water_frame* water_frame; /* sea level and current; NULL: 0. Read before the call returns */
    /* Computes the waves, and samples of many points; NULL: the calling thread. */
    const pelagic_executor* executor;
    const char* isa; /* as pelagic_ocean_options.isa */
} pelagic_exact_water_options;
static inline pelagic_exact_water_options pelagic_exact_water_options_make(void) {
    PELAGIC_ZEROS(pelagic_exact_water_options, options); options.water_density_kgpm3 = 1025; return options;
}
/* end of generated */

typedef struct pelagic_exact_water pelagic_exact_water;

/* Computes the waves of a sea that pelagic_sea_check() accepts, and moves them to the time 0; options may be NULL.
 * Errors: PELAGIC_INVALID_ARGUMENT also for a pond. */
PELAGIC_API pelagic_status pelagic_exact_water_create(const pelagic_sea* sea,
                                                      const pelagic_exact_water_options* options,
                                                      pelagic_exact_water** water);

/* Destroys the water. No sample may be in progress. */
PELAGIC_API void pelagic_exact_water_destroy(pelagic_exact_water* water);

/* Moves the water to a time, which is finite. It takes about as long as a sample, and allocates nothing. */
PELAGIC_API pelagic_status pelagic_exact_water_set_time(pelagic_exact_water* water, double time_s);

/* Shifts the world's origin, as pelagic_ocean_set_origin(), for samples from now on. */
PELAGIC_API pelagic_status pelagic_exact_water_set_origin(pelagic_exact_water* water, double x_m, double z_m);

/* Samples the water at the points, of which only count, x, y, z and parallel are used.
 * Errors: PELAGIC_INVALID_ARGUMENT also for a point below the sea floor.
 * Threads: any, except during pelagic_exact_water_set_time() and pelagic_exact_water_set_origin(). */
PELAGIC_API pelagic_status pelagic_exact_water_sample(const pelagic_exact_water* water,
                                                      const pelagic_water_points* points,
                                                      const pelagic_water_samples* samples);

/* Samples the surface, which is not displaced: the Jacobian is 1, and the error 0.
 * points: only count, x, z and parallel are used. samples: without foam.
 * Threads: any, except during pelagic_exact_water_set_time() and pelagic_exact_water_set_origin(). */
PELAGIC_API pelagic_status pelagic_exact_water_sample_surface(const pelagic_exact_water* water,
                                                              const pelagic_points* points,
                                                              const pelagic_samples* samples);

/* ---- Hulls ----------------------------------------------------------------------------------- */

/* Forces of water and air on rigid hulls, from their triangle meshes; docs/floating.md has the model. Oceans need
 * pelagic_ocean_options.queries and depth. In a library that was built without PELAGIC_FLOATING, functions of
 * this section return PELAGIC_INVALID_ARGUMENT. Hulls and floating bodies are experimental. */

/* The outer surface of a hull: closed, with triangles wound counter-clockwise as seen from outside. An open boat is
 * closed by its deck, or by a lid at the gunwale. Axes: x forward, y up, z to starboard. Vertices at equal positions
 * are merged, and triangles without an area are left out. */
typedef struct pelagic_hull_mesh {
    uint32_t struct_size;
    size_t vertex_count;
    const double* vertices_m;  /* x, y and z of each vertex; [-1000, 1000] */
    size_t triangle_count;     /* [4, 4096] */
    const uint32_t* triangles; /* numbers of the three vertices of each triangle */
} pelagic_hull_mesh;
static inline pelagic_hull_mesh pelagic_hull_mesh_make(void) { PELAGIC_MAKE(pelagic_hull_mesh); }

typedef struct pelagic_hull_options {
    uint32_t struct_size;
    /* generated from schema/hull.toml: c-members */
    double mass_kg; /* mass, which has no default; [1e-6, 1e10] */
    /* Three coordinates in the axes of the mesh; NULL: the centre of its volume. */
    const double* centre_of_mass_m;
    /* Three moments of inertia about the axes through the centre of mass, [1e-15, 1e16]; NULL: those of a body
     * that fills the mesh evenly. */
    const double* inertia_kgm2;
    /* Added mass at rest, a symmetric and positive semi-definite matrix of 6 x 6 numbers by rows: surge, heave,
     * sway (along x, y, z of the hull), roll, yaw, pitch (about x, y, z). NULL: that of the Lewis forms of the
     * hull's sections. */
    const double* added_mass;
    /* Text of WAMIT's file .1, which Capytaine writes: added mass and damping instead of those of the hull's
     * sections. Its origin is that of the mesh, raised or lowered to the water's surface; ULEN is 1 m. Excludes
     * added_mass and heave_damping. NULL: none. Such hulls move in pelagic_bodies only, at most 8 of them. */
    const char* radiation_text;
    /* Text of WAMIT's file .3: forces of waves, with radiation_text, instead of the pressure of undisturbed
     * waves. They are unavailable on a shore, in a pond and while the sea changes. NULL: none. */
    const char* excitation_text;
    /* Fraction of critical damping of heave, for pitch too; 0: by the waves that Lewis sections make; [0, 0.999]. */
    double heave_damping;
    double roll_damping;         /* fraction of critical damping of roll at |GM|; [0, 0.999] */
    double pressure_coefficient; /* drag of advancing faces; [0, 10] */
    /* Drag of retreating faces; with pressure_coefficient 0.7 the drag is that of a cube, 1.05 (Hoerner 1965);
     * [0, 10]. */
    double suction_coefficient;
    double friction_coefficient; /* friction along faces; ITTC 1957 at a Reynolds number of 3e6; [0, 1] */
    double air_coefficient;      /* drag of faces above the water; [0, 10] */
    double water_density_kgpm3;  /* density of the water; [500, 2000] */
    double air_density_kgpm3;    /* density of the air; [0, 10] */
    /* Lateral area of a skeg, keel or fin in the middle plane, which keeps the course of a hull under thrust;
     * [0, 1e4]. 0: none. */
    double skeg_m2;
    double skeg_x_m, skeg_y_m; /* middle of the skeg in the axes of the mesh; [-1000, 1000] */
    /* end of generated */
} pelagic_hull_options;
/* generated from schema/hull.toml: c-make */
static inline pelagic_hull_options pelagic_hull_options_make(void) {
    PELAGIC_ZEROS(pelagic_hull_options, options); options.roll_damping = 0.05;
    options.pressure_coefficient = 0.7; options.suction_coefficient = 0.35;
    options.friction_coefficient = 4e-3; options.air_coefficient = 1; options.water_density_kgpm3 = 1025;
    options.air_density_kgpm3 = 1.225; return options;
}
/* end of generated */

/* The mesh, mass and coefficients of hulls of one kind. */
typedef struct pelagic_hull pelagic_hull;

/* Creates a hull. Mesh and options are read before the call returns.
 * Errors: PELAGIC_INVALID_ARGUMENT for a mesh that is open, wound inwards, without volume or too large. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_hull_create(const pelagic_hull_mesh* mesh,
                                                        const pelagic_hull_options* options, pelagic_hull** hull);

/* Releases the handle. Bodies that use the hull keep what they need. */
PELAGIC_EXPERIMENTAL void pelagic_hull_destroy(pelagic_hull* hull);

/* Properties of a hull, in the axes of its mesh. Those from draught_m on are of the hull upright at rest in still
 * water, and 0 if it is heavier than its volume of water. */
typedef struct pelagic_hull_info {
    double volume_m3;
    double centre_m[3];                /* of the volume */
    double minimum_m[3], maximum_m[3]; /* bounds of the mesh */
    double mass_kg, centre_of_mass_m[3];
    double draught_m;             /* of the lowest vertex */
    double height_m;              /* of the centre of mass above the water */
    double waterplane_m2;         /* area of the section at the water's surface */
    double roll_gm_m, pitch_gm_m; /* metacentric heights */
    /* Of mesh, mass and coefficients: hulls of equal digests move bit-identically. */
    uint64_t digest;
    int32_t floats;                       /* 1: it floats, 0: it sinks */
    int32_t vertex_count, triangle_count; /* of the merged mesh */
} pelagic_hull_info;

/* Writes the properties of a hull. Threads: any. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_hull_describe(const pelagic_hull* hull, pelagic_hull_info* info);

/* A rigid body in the world's axes, and what the water's forces depend on of the preceding step. The library reads
 * and writes it; it has no struct_size. */
typedef struct pelagic_hull_state {
    double position_m[3];             /* of the centre of mass; [-1e8, 1e8] */
    double orientation[4];            /* unit quaternion x, y, z, w: world from hull */
    double velocity_mps[3];           /* of the centre of mass; [-1e4, 1e4] */
    double angular_velocity_radps[3]; /* [-1e4, 1e4] */
    /* Of the preceding step: vertical velocity and rotation of the dynamic waves at the hull, and fraction of added
     * mass. */
    double wake_velocity_y_mps;
    double wake_rotation_radps[3];
    double submersion;         /* [0, 1] */
    int32_t has_previous_step; /* 0: no acceleration of dynamic waves and no slamming */
} pelagic_hull_state;

/* Writes the state of a hull that is upright and at rest in still water. The mesh's origin is at the position minus
 * the rotated centre_of_mass_m of pelagic_hull_info.
 * heading_rad: angle of the hull's x axis, from +x to +z; finite.
 * Threads: any. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_hull_at_rest(const pelagic_hull* hull, double x_m, double z_m,
                                                         double heading_rad, pelagic_hull_state* state);

/* A force and its torque about the centre of mass, in the world's axes. */
typedef struct pelagic_hull_force {
    double force_n[3], torque_nm[3];
} pelagic_hull_force;

/* What else acts on a hull: engines, tow lines and contacts; [-1e15, 1e15] each. */
typedef struct pelagic_hull_inputs {
    uint32_t struct_size;
    pelagic_hull_force force;
    double wind_mps[3]; /* [-1000, 1000] */
} pelagic_hull_inputs;
static inline pelagic_hull_inputs pelagic_hull_inputs_make(void) { PELAGIC_MAKE(pelagic_hull_inputs); }

/* Forces of water and air. The total leaves out weight, inputs and the force of added mass that opposes acceleration,
 * -A du/dt. */
typedef struct pelagic_hull_loads {
    pelagic_hull_force total;
    pelagic_hull_force pressure;   /* of the water's weight and acceleration */
    pelagic_hull_force added_mass; /* A times the acceleration of the water */
    pelagic_hull_force drag;       /* drag, radiation damping and air */
    pelagic_hull_force slamming;
    double displaced_m3;
    double submersion; /* displaced over floating volume, at most 1 */
    /* The plane through the surface at the hull: its height at the centre of mass, and slopes. */
    double water_height_m, water_slope_x, water_slope_z;
    double water_velocity_mps[3]; /* mean at the hull */
    double water_acceleration_mps2[3];
} pelagic_hull_loads;

/* Computes the loads of a state in the water of the frame completed last, and stores in the state what the next call
 * depends on. For a physics engine that integrates positions: it sets pose and velocities and applies the total.
 * step_s: time between calls, at least 0. Drag is that of an implicit step, so that explicit integrators are stable.
 * inputs: only the wind is used; NULL: no wind.
 * Threads: one thread per hull; also while another thread calls functions of the ocean. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_hull_compute_loads(pelagic_hull* hull, const pelagic_ocean* ocean,
                                                               pelagic_hull_state* state, double step_s,
                                                               const pelagic_hull_inputs* inputs,
                                                               pelagic_hull_loads* loads);

/* Computes the loads as pelagic_hull_compute_loads(), and the velocities of the state after a step under them, the
 * weight and the inputs, with mass and added mass. For a physics engine without added mass: it sets the body's
 * velocities to the result.
 * inputs, loads: may be NULL.
 * Threads: as pelagic_hull_compute_loads(). */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_hull_accelerate(pelagic_hull* hull, const pelagic_ocean* ocean,
                                                            pelagic_hull_state* state, double step_s,
                                                            const pelagic_hull_inputs* inputs,
                                                            pelagic_hull_loads* loads);

/* ---- Floating bodies ------------------------------------------------------------------------- */

/* A set of hulls that float in the water of an ocean. With wakes they press on its dynamic waves, and float on the
 * waves of others. A tick is:
 *   pelagic_ocean_complete(ocean, &frame);
 *   pelagic_bodies_press(bodies, tick_s);
 *   pelagic_ocean_schedule(ocean, next_s);
 *   pelagic_bodies_step(bodies, tick_s, NULL);  // during the computation of the next frame
 * With wakes, functions that enqueue commands (add, remove, press, destroy) are called by the thread that calls the
 * ocean's. Functions return PELAGIC_INVALID_ARGUMENT for an unknown number of a body, after the ocean is destroyed,
 * and in a library that was built without PELAGIC_FLOATING. */
typedef struct pelagic_bodies pelagic_bodies;

typedef struct pelagic_bodies_options {
    uint32_t struct_size;
    int32_t wakes;                    /* Nonzero: with wakes, which need pelagic_ocean_options.dynamic_waves */
    const pelagic_executor* executor; /* of the steps; NULL: PELAGIC_EXECUTOR_DEFAULT */
} pelagic_bodies_options;
static inline pelagic_bodies_options pelagic_bodies_options_make(void) { PELAGIC_MAKE(pelagic_bodies_options); }

/* Creates an empty set; options may be NULL. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_create(pelagic_ocean* ocean, const pelagic_bodies_options* options,
                                                          pelagic_bodies** bodies);

/* Destroys a set, and removes its pressures from the dynamic waves. */
PELAGIC_EXPERIMENTAL void pelagic_bodies_destroy(pelagic_bodies* bodies);

/* Adds a body without inputs. The set keeps the hull, also for pelagic_bodies_restore_state() after the body is
 * removed. `number` receives the number of the body, which is never reused.
 * Errors: PELAGIC_INVALID_ARGUMENT with wakes for a hull longer than 1000 m and for too many sources of waves. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_add(pelagic_bodies* bodies, const pelagic_hull* hull,
                                                       const pelagic_hull_state* state, uint32_t* number);

/* Removes a body. Does nothing if no body has that number. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_remove(pelagic_bodies* bodies, uint32_t number);

/* Sets force and wind of the steps from now on. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_set_inputs(pelagic_bodies* bodies, uint32_t number,
                                                              const pelagic_hull_inputs* inputs);

/* Replaces the state of a body. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_set_state(pelagic_bodies* bodies, uint32_t number,
                                                             const pelagic_hull_state* state);

/* Writes the state of a body. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_get_state(const pelagic_bodies* bodies, uint32_t number,
                                                             pelagic_hull_state* state);

/* Writes the loads of a body in the last step, all 0 before the first. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_get_loads(const pelagic_bodies* bodies, uint32_t number,
                                                             pelagic_hull_loads* loads);

/* Moves all bodies and their wakes, after a shift of the world's origin (pelagic_ocean_set_origin) by (-x_m, -z_m).
 * Call it when the first frame with the new origin is complete, before that frame's press and step.
 * Errors: PELAGIC_INVALID_ARGUMENT if a body would be out of range; nothing is changed then. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_shift(pelagic_bodies* bodies, double x_m, double z_m);

/* Moves the pressures of wakes to the bodies. Does nothing without wakes. Call it once a frame, between
 * pelagic_ocean_complete() and pelagic_ocean_schedule().
 * tick_s: time since the last call; 0 changes nothing. Frames may be any time apart.
 * Errors: PELAGIC_WRONG_ORDER before the first frame and if a frame is in flight. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_press(pelagic_bodies* bodies, double tick_s);

/* Advances all bodies by a step in the water of the frame completed last, on the executor's threads. Results do not
 * depend on the number of threads. Allocates nothing once the set has stepped with as many vertices.
 * step_s: at least 0. More than 0.1, after a hitch of the application, is divided into equal steps, and more than 1
 *   counts as 1.
 * is_all: receives 1 if the bodies have advanced by all of step_s, else 0; may be NULL.
 * Errors: PELAGIC_INVALID_ARGUMENT for a body that has moved out of range, whose number the message has;
 *   PELAGIC_APPLICATION_ERROR if a callback of the executor fails, after which the bodies have advanced.
 * Threads: one thread per object; also while another thread calls functions of the ocean. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_step(pelagic_bodies* bodies, double step_s,
                                                        int32_t* is_all);

/* Saves all that later steps depend on, inputs and wakes included: 1,300 bytes a body, and with wakes 12 for each
 * texel under it. Call it with pelagic_dynamic_waves_save_state(), before the first command after a frame. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_save_state(const pelagic_bodies* bodies, uint8_t* bytes,
                                                              size_t room, size_t* count);

/* Restores a saved state. With wakes, restore the dynamic waves first. A frame of the saved time, scheduled without
 * commands, shows the water of that time again.
 * Errors: PELAGIC_INVALID_ARGUMENT if the set never had a saved hull, or the dynamic waves have other options. */
PELAGIC_EXPERIMENTAL pelagic_status pelagic_bodies_restore_state(pelagic_bodies* bodies, const uint8_t* bytes,
                                                                 size_t count);

#ifdef __cplusplus
}
#endif

#undef PELAGIC_ZEROS
#undef PELAGIC_MAKE
#endif
