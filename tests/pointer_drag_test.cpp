// Determines which pointer movements count as a drag, for every order of events within one frame.
#include <gtest/gtest.h>

#include "pelagic/viewer/pointer_drag.hpp"

namespace pelagic {
namespace {

using viewer::PointerDrag;

TEST(PointerDrag, MovementBeforeThePressInTheSameFrameDoesNotCount) {
    PointerDrag drag;
    drag.move_to({10, 20});
    drag.clear();
    drag.move_to({400, 300});
    drag.set_button(true);
    EXPECT_EQ(drag.moved_px(), glm::dvec2(0, 0));
    drag.move_to({403, 299});
    EXPECT_EQ(drag.moved_px(), glm::dvec2(3, -1));
}

TEST(PointerDrag, MovementAfterTheReleaseInTheSameFrameDoesNotCount) {
    PointerDrag drag;
    drag.move_to({0, 0});
    drag.set_button(true);
    drag.move_to({5, 0});
    drag.set_button(false);
    drag.move_to({500, 500});
    EXPECT_EQ(drag.moved_px(), glm::dvec2(5, 0));
}

TEST(PointerDrag, FramesOfADragSumUpToItsLength) {
    PointerDrag drag;
    drag.move_to({100, 100});
    drag.set_button(true);
    glm::dvec2 sum{};
    for (int frame = 1; frame <= 10; ++frame) {
        drag.clear();
        drag.move_to({100 + 3 * frame, 100 - 2 * frame});
        sum += drag.moved_px();
    }
    EXPECT_EQ(sum, glm::dvec2(30, -20));
}

TEST(PointerDrag, PositionOfTheFirstEventIsNoMovement) {
    PointerDrag drag;
    drag.set_button(true);
    drag.move_to({640, 480});
    EXPECT_EQ(drag.moved_px(), glm::dvec2(0, 0));
}

}  // namespace
}  // namespace pelagic
