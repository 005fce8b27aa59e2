/* The test is that this file compiles as pedantic C99. */
#include <pelagic/pelagic.h>

#include "pelagic/tests/capi_cascade_sum.h"

pelagic_status make_a_sea(pelagic_ocean** ocean);
double jacobian_at(const pelagic_ocean* ocean, int32_t cascade_count, double x, double z);

pelagic_status make_a_sea(pelagic_ocean** ocean) {
    const pelagic_sea sea = pelagic_sea_make();
    return pelagic_ocean_create(&sea, NULL, ocean);
}

double jacobian_at(const pelagic_ocean* ocean, int32_t cascade_count, double x, double z) {
    double sum[8] = {0}, normal[3];
    for (int32_t i = 0; i < cascade_count; ++i) {
        pelagic_cascade cascade;
        if (pelagic_ocean_cascade(ocean, i, &cascade) != PELAGIC_OK) return 0;
        add_slopes(&cascade, x, z, sum);
    }
    normal_of_slopes(sum, normal);
    return normal[1];
}
