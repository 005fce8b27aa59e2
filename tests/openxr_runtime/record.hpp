// What the stand-in was given, for a test to read afterwards.
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
            submitted_pose{};  ///< in LOCAL: as xrLocateViews() has it for that time, and as the layer has it
        XrFovf fov{}, submitted_fov{};
        int width = 0, height = 0;
        std::vector<std::uint8_t> rgb;  ///< as it was handed over, the upper row first
    };
    std::vector<std::string> states;    ///< of the session, in order
    std::vector<std::string> refusals;  ///< "xrBeginFrame: -37", or a GL error by the end of a frame
    std::vector<Frame> frames;
    XrTime last_display_time_ns = 0;
    std::array<Eye, 2> eyes;

    /// record.json, left.ppm and right.ppm into PELAGIC_STAND_IN_FOLDER, if that is set.
    void write() const;
};

}  // namespace pelagic::openxr_stand_in
