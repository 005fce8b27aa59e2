/* The frame loop of a game without rendering: completes a frame, schedules the next, queries
 * heights, and reads the cascades. */
#include <pelagic/pelagic.h>
#include <stdio.h>

static int failed(pelagic_status status) {
    if (status != PELAGIC_OK) fprintf(stderr, "c_application: %s\n", pelagic_last_error());
    return status != PELAGIC_OK;
}

/* A renderer uploads each cascade's textures here: displacement_rgba16f, and all levels of
 * slopes_rgba8 and moments_rgba8. */
static int draw(const pelagic_ocean* ocean, const pelagic_frame* frame) {
    int32_t i;
    for (i = 0; i < frame->cascade_count; ++i) {
        pelagic_cascade cascade;
        if (failed(pelagic_ocean_cascade(ocean, i, &cascade))) return 1;
        printf(" %g", cascade.side_m);
    }
    printf(" m\n");
    return 0;
}

static int run(pelagic_ocean* ocean) {
    const double x[3] = {10, 20, 30}, z[3] = {5, 5, 5};
    float heights[3];
    pelagic_points buoys = pelagic_points_make();
    pelagic_samples wanted = pelagic_samples_make();
    pelagic_frame frame;
    uint64_t hash;
    int n;

    buoys.count = 3;
    buoys.x = x;
    buoys.z = z;
    wanted.height_m = heights;
    if (failed(pelagic_ocean_schedule(ocean, 0))) return 1;
    for (n = 1; n <= 5; ++n) {
        /* Completes the frame that was scheduled one frame ago. */
        if (failed(pelagic_ocean_complete(ocean, &frame))) return 1;
        /* Computed while this frame is drawn. */
        if (failed(pelagic_ocean_schedule(ocean, n / 90.0))) return 1;
        if (failed(pelagic_ocean_query(ocean, &buoys, &wanted))) return 1;
        if (failed(pelagic_ocean_frame_hash(ocean, frame.number, PELAGIC_HASH_FRAME, &hash))) return 1;
        printf("%.4f s: hash %016llx, buoys at %.3f %.3f %.3f m, cascades of", frame.time_s, (unsigned long long)hash,
               heights[0], heights[1], heights[2]);
        if (draw(ocean, &frame)) return 1;
    }
    return 0;
}

int main(void) {
    pelagic_sea sea = pelagic_sea_make();
    pelagic_ocean_options options = pelagic_ocean_options_make();
    pelagic_ocean* ocean;
    int result;

    sea.wind_speed_mps = 9;
    options.queries = 1;
    if (failed(pelagic_ocean_create(&sea, &options, &ocean))) return 1;
    result = run(ocean);
    pelagic_ocean_destroy(ocean); /* waits for the frame in flight */
    return result;
}
