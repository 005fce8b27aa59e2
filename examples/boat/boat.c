/* The boats of main.cpp through the C interface: three boats in a storm, which make waves and float
 * on those of each other.
 *
 *   boat_c [SECONDS] > motion.csv */
#include <math.h>
#include <pelagic/pelagic.h>
#include <stdio.h>
#include <stdlib.h>

enum { SECTIONS = 10, RING = 6, VERTICES = (SECTIONS + 1) * RING, TRIANGLES = 2 * SECTIONS * RING + 2 * (RING - 2) };
static const double tick_s = 1.0 / 60;
static const double pi = 3.14159265358979323846;

static int failed(pelagic_status status) {
    if (status != PELAGIC_OK) fprintf(stderr, "boat_c: %s\n", pelagic_last_error());
    return status != PELAGIC_OK;
}

typedef struct boat {
    const char* name;
    double length_m, beam_m, height_m, mass_kg;
    double centre_of_mass_m[3]; /* 0: the centre of the mesh's volume */
    double height_at_rest_m;
    uint32_t number;
} boat;

static void set_triangle(uint32_t** to, uint32_t a, uint32_t b, uint32_t c) {
    *(*to)++ = a;
    *(*to)++ = b;
    *(*to)++ = c;
}

/* A boat with a keel at y = 0, chines, gunwales and a cambered deck, narrower towards the bow. An
 * application reads its own mesh instead. */
static pelagic_status make_hull(const boat* of, pelagic_hull** hull) {
    static const double y[RING] = {0, 0.4, 1, 1.05, 1, 0.4}, z[RING] = {0, 0.75, 1, 0, -1, -0.75};
    double vertices[3 * VERTICES], *at = vertices;
    uint32_t triangles[3 * TRIANGLES], *to = triangles;
    const uint32_t bow = RING * SECTIONS;
    pelagic_hull_mesh mesh = pelagic_hull_mesh_make();
    pelagic_hull_options options = pelagic_hull_options_make();
    uint32_t i, j;
    for (i = 0; i <= SECTIONS; ++i)
        for (j = 0; j < RING; ++j) {
            const double along = (double)i / SECTIONS;
            *at++ = of->length_m * (along - 0.5);
            *at++ = of->height_m * y[j];
            *at++ = of->beam_m / 2 * (1 - 0.8 * along * along) * z[j];
        }
    for (i = 0; i < SECTIONS; ++i)
        for (j = 0; j < RING; ++j) {
            const uint32_t a = RING * i + j, b = RING * i + (j + 1) % RING;
            set_triangle(&to, a, a + RING, b);
            set_triangle(&to, b, a + RING, b + RING);
        }
    for (j = 1; j + 1 < RING; ++j) {
        set_triangle(&to, 0, j, j + 1);
        set_triangle(&to, bow, bow + j + 1, bow + j);
    }
    mesh.vertex_count = VERTICES;
    mesh.vertices_m = vertices;
    mesh.triangle_count = TRIANGLES;
    mesh.triangles = triangles;
    options.mass_kg = of->mass_kg;
    options.skeg_m2 = of->length_m * of->length_m / 100;
    options.skeg_x_m = -of->length_m * 2 / 5;
    if (of->centre_of_mass_m[1] != 0) options.centre_of_mass_m = of->centre_of_mass_m;
    return pelagic_hull_create(&mesh, &options, hull);
}

static int add_boat(pelagic_bodies* bodies, boat* of, double z_m) {
    pelagic_hull* hull;
    pelagic_hull_info info;
    pelagic_hull_state state;
    int result;
    if (failed(make_hull(of, &hull))) return 1;
    result = failed(pelagic_hull_describe(hull, &info)) || failed(pelagic_hull_at_rest(hull, 0, z_m, 0, &state)) ||
             failed(pelagic_bodies_add(bodies, hull, &state, &of->number));
    of->height_at_rest_m = info.height_m;
    pelagic_hull_destroy(hull); /* the bodies keep it */
    return result;
}

static int print(const pelagic_bodies* bodies, const boat* of, double time_s) {
    pelagic_hull_state state;
    const double* q = state.orientation;
    double pitch_rad, roll_rad;
    if (failed(pelagic_bodies_get_state(bodies, of->number, &state))) return 1;
    pitch_rad = asin(2 * (q[0] * q[1] + q[3] * q[2]));
    roll_rad = atan2(-2 * (q[1] * q[2] - q[3] * q[0]), 1 - 2 * (q[0] * q[0] + q[2] * q[2]));
    printf("%.3f,%s,%.3f,%.2f,%.2f\n", time_s, of->name, state.position_m[1] - of->height_at_rest_m,
           pitch_rad * 180 / pi, roll_rad * 180 / pi);
    return 0;
}

static int sail(pelagic_ocean* ocean, pelagic_bodies* bodies, int ticks) {
    boat boats[3] = {{.name = "dinghy", .length_m = 4, .beam_m = 1.7, .height_m = 0.8, .mass_kg = 350},
                     {"yacht", 12, 4, 2.5, 14000, {-1, 1, 0}, 0, 0},
                     {"ship", 60, 14, 9, 1200000, {-5, 4, 0}, 0, 0}};
    pelagic_dynamic_waves* waves;
    pelagic_frame frame;
    pelagic_hull_state yacht;
    int tick, i;
    for (i = 0; i < 3; ++i)
        if (add_boat(bodies, &boats[i], 20 * i)) return 1;
    puts("time_s,boat,heave_m,pitch_deg,roll_deg");
    if (failed(pelagic_ocean_dynamic_waves(ocean, &waves)) || failed(pelagic_ocean_schedule(ocean, 0))) return 1;
    for (tick = 1; tick <= ticks; ++tick) {
        if (failed(pelagic_ocean_complete(ocean, &frame)) || failed(pelagic_bodies_press(bodies, tick_s)) ||
            failed(pelagic_bodies_get_state(bodies, boats[1].number, &yacht)) ||
            failed(pelagic_dynamic_waves_set_center(waves, yacht.position_m[0], yacht.position_m[2])) ||
            failed(pelagic_ocean_schedule(ocean, tick * tick_s)) || failed(pelagic_bodies_step(bodies, tick_s, NULL)))
            return 1;
        for (i = 0; i < 3; ++i)
            if (print(bodies, &boats[i], tick * tick_s)) return 1;
    }
    return 0;
}

int main(int argc, char** argv) {
    const double seconds = argc < 2 ? 60 : atof(argv[1]);
    pelagic_sea storm = pelagic_sea_make();
    pelagic_dynamic_waves_options waves = pelagic_dynamic_waves_options_make();
    pelagic_ocean_options options = pelagic_ocean_options_make();
    pelagic_bodies_options with_wakes = pelagic_bodies_options_make();
    pelagic_ocean* ocean = NULL;
    pelagic_bodies* bodies = NULL;
    int result;
    if (!(seconds >= 1 && seconds <= 3600)) {
        fprintf(stderr, "boat_c: SECONDS is %s, expected a number from 1 to 3600\n", argv[1]);
        return 2;
    }
    if (failed(pelagic_sea_preset("storm", &storm))) return 1;
    waves.resolution = 512; /* 12 texels along the dinghy, and room for the ship */
    waves.side_m = 160;
    waves.border_m = 20;
    options.queries = options.depth = 1;
    options.dynamic_waves = &waves;
    with_wakes.wakes = 1;
    result = failed(pelagic_ocean_create(&storm, &options, &ocean)) ||
             failed(pelagic_bodies_create(ocean, &with_wakes, &bodies)) ||
             sail(ocean, bodies, (int)lround(seconds / tick_s));
    pelagic_bodies_destroy(bodies);
    pelagic_ocean_destroy(ocean);
    return result;
}
