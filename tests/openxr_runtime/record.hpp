// The data that the stand-in received, for a test to read afterwards.
#pragma once

#include <openxr/openxr.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pelagic::openxr_stand_in {

struct Record {
    struct Frame {
        XrTime display_time_ns = 0;
        bool should_render = false;
        std::uint32_t layers = 0;
    };
    /// An eye of the last frame that had a layer.
    struct Eye {
        XrPosef pose{},
            /// in LOCAL: returned by xrLocateViews() for this time, and submitted in the layer
            submitted_pose{};
        XrFovf fov{}, submitted_fov{};
        int width = 0, height = 0;
        std::vector<std::uint8_t> rgb;  ///< as submitted, the upper row first
    };
    std::vector<std::string> states;  ///< of the session, in order
    /// "xrBeginFrame: -37", or a GL error at the end of a frame
    std::vector<std::string> refusals;
    std::vector<Frame> frames;
    XrTime last_display_time_ns = 0;
    std::array<Eye, 2> eyes;

    /// Writes record.json, left.ppm and right.ppm into PELAGIC_STAND_IN_FOLDER, if it is set.
    void write() const;
};

}  // namespace pelagic::openxr_stand_in
