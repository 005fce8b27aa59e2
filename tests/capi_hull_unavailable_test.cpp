// In a library without GLM every function of hulls reports how to get them.
#include <gtest/gtest.h>

#include "pelagic/pelagic.h"

namespace {

TEST(CInterfaceHullUnavailable, EachFunctionReportsIt) {
    auto* hull = reinterpret_cast<pelagic_hull*>(8);
    auto* bodies = reinterpret_cast<pelagic_bodies*>(8);
    EXPECT_EQ(pelagic_hull_create(nullptr, nullptr, &hull), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(hull, nullptr);
    EXPECT_EQ(pelagic_bodies_create(nullptr, nullptr, &bodies), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(bodies, nullptr);
    pelagic_hull_destroy(hull);
    pelagic_bodies_destroy(bodies);
    for (const pelagic_status status :
         {pelagic_hull_describe(nullptr, nullptr),
          pelagic_hull_at_rest(nullptr, 0, 0, 0, nullptr),
          pelagic_hull_compute_loads(nullptr, nullptr, nullptr, 0, nullptr, nullptr),
          pelagic_hull_accelerate(nullptr, nullptr, nullptr, 0, nullptr, nullptr),
          pelagic_bodies_add(nullptr, nullptr, nullptr, nullptr), pelagic_bodies_remove(nullptr, 0),
          pelagic_bodies_set_inputs(nullptr, 0, nullptr), pelagic_bodies_set_state(nullptr, 0, nullptr),
          pelagic_bodies_get_state(nullptr, 0, nullptr), pelagic_bodies_get_loads(nullptr, 0, nullptr),
          pelagic_bodies_press(nullptr, 0), pelagic_bodies_step(nullptr, 0, nullptr),
          pelagic_bodies_save_state(nullptr, nullptr, 0, nullptr),
          pelagic_bodies_restore_state(nullptr, nullptr, 0)}) {
        EXPECT_EQ(status, PELAGIC_INVALID_ARGUMENT);
        EXPECT_STREQ(pelagic_last_error(), "hulls are unavailable, expected a library built with PELAGIC_FLOATING");
    }
}

}  // namespace
