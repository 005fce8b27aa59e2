/* A C application that opens the shared library at run time, computes frames with the default
 * executor, and closes the library: eight times, each in its own process, which must exit normally.
 * oneTBB's threads end later than its last arena, so their code must stay loaded.
 *
 * usage: application_that_unloads LIBRARY */
#include <dlfcn.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "pelagic/capi/pelagic.h"

static int compute_and_unload(const char* path) {
    const pelagic_sea sea = pelagic_sea_make();
    const pelagic_ocean_options options = pelagic_ocean_options_make();
    pelagic_frame frame;
    pelagic_ocean* ocean = NULL;
    int i;
    void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    /* The conversion that POSIX specifies for functions returned by dlsym(). */
#define IMPORTED(name) \
    __typeof__(&name) name##_; \
    *(void**)&name##_ = dlsym(library, #name)
    IMPORTED(pelagic_ocean_create);
    IMPORTED(pelagic_ocean_schedule);
    IMPORTED(pelagic_ocean_complete);
    IMPORTED(pelagic_ocean_destroy);
    if (pelagic_ocean_create_(&sea, &options, &ocean) != PELAGIC_OK) return 1;
    for (i = 0; i < 100; ++i)
        if (pelagic_ocean_schedule_(ocean, i / 90.0) != PELAGIC_OK ||
            pelagic_ocean_complete_(ocean, &frame) != PELAGIC_OK)
            return 1;
    pelagic_ocean_destroy_(ocean);
    if (dlclose(library) != 0) return 1;
    usleep(20000); /* time for threads to end */
    return 0;
}

int main(int count, char** arguments) {
    int run, failed = 0;
    if (count != 2) return 2;
    for (run = 0; run < 8; ++run) {
        int status = 0;
        const pid_t child = fork();
        if (child == 0) return compute_and_unload(arguments[1]);
        if (child < 0 || waitpid(child, &status, 0) != child) return 1;
        if (status == 0) continue;
        ++failed;
        if (WIFSIGNALED(status)) printf("run %d ended by signal %d\n", run, WTERMSIG(status));
    }
    printf("%d of 8 runs failed\n", failed);
    return failed != 0;
}
