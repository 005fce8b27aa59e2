// A frame in Python, and a cascade of a frame.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/python/bindings/shared_ocean.hpp"

namespace pelagic::python {

struct FrameHandle {
    std::shared_ptr<SharedOcean> ocean;
    std::uint64_t number;
    /// its spans and their cascades belong to the ocean: valid only with a Reader or a View
    Frame frame;

    std::unique_ptr<SharedOcean::Reader> read() const { return std::make_unique<SharedOcean::Reader>(ocean, number); }
};

using FramePointer = std::shared_ptr<FrameHandle>;

struct CascadeHandle {
    FramePointer of;
    std::size_t index;

    /// \pre a Reader or a View exists
    const Cascade& cascade() const { return of->frame.cascades[index]; }
};

/// Throws std::invalid_argument if the frame has no foam.
void need_foam(const Frame& frame);
/// Throws std::invalid_argument if the frame has no planes.
void need_planes(const Frame& frame);

using Shape = std::vector<pybind11::ssize_t>;

/// Returns a read-only array of `data`, which keeps the ocean's memory unchanged until the last
/// array that shares it is destroyed.
pybind11::array view_of(const FrameHandle& handle, const pybind11::dtype& type, Shape shape, const void* data);

using FrameClass = pybind11::class_<FrameHandle, std::shared_ptr<FrameHandle>>;

/// Adds the classes Frame, Cascade and Bounds. add_queries() adds the queries of a frame.
FrameClass add_frame_classes(pybind11::module_& module);
void add_queries(FrameClass& frame);

using OceanClass = pybind11::class_<SharedOcean, std::shared_ptr<SharedOcean>>;
void add_series(OceanClass& ocean);
void add_reference_points(FrameClass& frame);  ///< sample_undisplaced

}  // namespace pelagic::python
