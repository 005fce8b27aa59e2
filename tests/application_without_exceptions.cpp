// A C++ application compiled with -fno-exceptions and -fno-rtti that uses the C interface: errors
// are status codes with a message of one line. It prints the hashes of two golden frames.
#include <pelagic/pelagic.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>

#if defined(__cpp_exceptions) || defined(__cpp_rtti)
#error "this application is to be compiled with -fno-exceptions and -fno-rtti"
#endif

namespace {

bool print_frames(pelagic_ocean* ocean) {
    const double times_s[] = {0, 12.34};
    for (const double time_s : times_s) {
        pelagic_frame frame = {};
        std::uint64_t hash = 0;
        if (pelagic_ocean_schedule(ocean, time_s) != PELAGIC_OK ||
            pelagic_ocean_complete(ocean, &frame) != PELAGIC_OK ||
            pelagic_ocean_frame_hash(ocean, frame.number, PELAGIC_HASH_FRAME, &hash) != PELAGIC_OK)
            return false;
        std::printf("default@%g %" PRIx64 "\n", time_s, hash);
    }
    return true;
}

}  // namespace

int main() {
    auto sea = pelagic_sea_make();
    pelagic_ocean* ocean = nullptr;
    sea.wind_speed_mps = -1;
    if (pelagic_ocean_create(&sea, nullptr, &ocean) != PELAGIC_INVALID_ARGUMENT ||
        std::strncmp(pelagic_last_error(), "wind_speed_mps -1", 17) != 0)
        return 1;
    sea = pelagic_sea_make();
    const bool done = pelagic_ocean_create(&sea, nullptr, &ocean) == PELAGIC_OK && print_frames(ocean);
    if (!done) std::fprintf(stderr, "%s\n", pelagic_last_error());
    pelagic_ocean_destroy(ocean);
    return done ? 0 : 1;
}
