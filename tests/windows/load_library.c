/* A C application that loads pelagic.dll at run time, computes the golden frames of the default
 * sea, and unloads it, twice. Prints each frame as "default@TIME HASH" after every load.
 *
 * usage: load_library PELAGIC.DLL */
#include <pelagic/pelagic.h>
#include <stdio.h>
#include <windows.h>

/* The called functions, with the types of the header. */
#define FUNCTIONS(DO)                                                                                        \
    DO(pelagic_last_error) DO(pelagic_executor_create) DO(pelagic_executor_destroy) DO(pelagic_ocean_create) \
    DO(pelagic_ocean_destroy) DO(pelagic_ocean_schedule) DO(pelagic_ocean_complete) \
    DO(pelagic_ocean_frame_hash)

typedef struct {
#define MEMBER(name) __typeof__(&name) name;
    FUNCTIONS(MEMBER)
} pelagic_functions;

static int find_functions(HMODULE library, pelagic_functions* functions) {
#define FIND(name)                                                                \
    functions->name = (__typeof__(&name))(void*)GetProcAddress(library, #name);   \
    if (!functions->name) return fprintf(stderr, "no %s\n", #name), 0;
    FUNCTIONS(FIND)
    return 1;
}

static int print_frames(const pelagic_functions* pelagic, pelagic_ocean* ocean) {
    const double times_s[] = {0, 12.34};
    for (int i = 0; i < 2; ++i) {
        pelagic_frame frame;
        uint64_t hash;
        if (pelagic->pelagic_ocean_schedule(ocean, times_s[i]) != PELAGIC_OK ||
            pelagic->pelagic_ocean_complete(ocean, &frame) != PELAGIC_OK ||
            pelagic->pelagic_ocean_frame_hash(ocean, frame.number, PELAGIC_HASH_FRAME, &hash) != PELAGIC_OK)
            return 0;
        printf("default@%g %llx\n", times_s[i], (unsigned long long)hash);
    }
    return 1;
}

static int use_once(const char* file) {
    HMODULE library = LoadLibraryA(file);
    if (!library) return fprintf(stderr, "can't load %s: error %lu\n", file, GetLastError()), 0;
    pelagic_functions pelagic;
    if (!find_functions(library, &pelagic)) return 0;

    const pelagic_sea sea = pelagic_sea_make();
    pelagic_executor_options pool = pelagic_executor_options_make();
    pelagic_ocean_options options = pelagic_ocean_options_make();
    pelagic_executor* executor = NULL;
    pelagic_ocean* ocean = NULL;
    pool.kind = PELAGIC_EXECUTOR_THREADS;
    pool.threads = 3;
    int done = pelagic.pelagic_executor_create(&pool, &executor) == PELAGIC_OK;
    options.executor = executor;
    done = done && pelagic.pelagic_ocean_create(&sea, &options, &ocean) == PELAGIC_OK && print_frames(&pelagic, ocean);
    if (!done) fprintf(stderr, "%s\n", pelagic.pelagic_last_error());
    pelagic.pelagic_ocean_destroy(ocean);
    pelagic.pelagic_executor_destroy(executor);

    FreeLibrary(library);
    if (GetModuleHandleA("pelagic.dll")) return fprintf(stderr, "pelagic.dll stays loaded\n"), 0;
    return done;
}

int main(int argc, char** argv) {
    if (argc != 2) return fprintf(stderr, "usage: load_library PELAGIC.DLL\n"), 2;
    return use_once(argv[1]) && use_once(argv[1]) ? 0 : 1;
}
