// Buffers of a height field that jobs compute row by row: dynamic waves and shores.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

struct HeightFieldBuffers {
    /// \param items  number of work items; each stores the lowest and highest of its heights
    void allocate(std::size_t texels, std::size_t items, const Allocator& memory) {
        height = AlignedBuffer<float>(texels, memory);
        vertical_velocity = AlignedBuffer<float>(texels, memory);
        foam = AlignedBuffer<std::uint8_t>(texels, memory);
        lowest.resize(items);
        highest.resize(items);
    }
    float min_height() const { return *std::min_element(lowest.begin(), lowest.end()); }
    float max_height() const { return *std::max_element(highest.begin(), highest.end()); }
    std::size_t bytes() const {
        return height.bytes() + vertical_velocity.bytes() + foam.bytes() +
               (lowest.size() + highest.size()) * sizeof(float);
    }

    AlignedBuffer<float> height, vertical_velocity;
    AlignedBuffer<std::uint8_t> foam;
    std::vector<float> lowest, highest;  ///< by work item
};

}  // namespace pelagic
