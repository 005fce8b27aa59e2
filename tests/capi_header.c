/* The header is C99, pedantic: that this compiles is the test. */
#include <pelagic/pelagic.h>

pelagic_status make_a_sea(pelagic_ocean** ocean);

pelagic_status make_a_sea(pelagic_ocean** ocean) {
    pelagic_sea sea = {.struct_size = sizeof sea};
    const pelagic_status status = pelagic_sea_defaults(&sea);
    return status == PELAGIC_OK ? pelagic_ocean_create(&sea, NULL, ocean) : status;
}
