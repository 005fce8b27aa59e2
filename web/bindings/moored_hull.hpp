// A hull at anchor that floats by forces, one step for each frame.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>

#include "pelagic/floating/hull.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::web {

/// A place in the sea, and the springs that hold a hull there.
struct Mooring {
    double x_m = 0, z_m = 0, heading_rad = 0;
    /// Period of the hull's motion along the surface, and of yaw; 0: the hull is not held.
    double period_s = 0;
};

class MooredHull {
   public:
    MooredHull(Hull hull, const Mooring& mooring);

    /// Advances to the frame of a time. Where the last frame is more than a second away, and at first,
    /// the hull is put on the frame's surface: its pose is a function of the frame alone then.
    /// \param frame  with queries, velocities of the water and depth
    void follow(const Frame& frame, double time_s);
    /// Forgets the last frame, because the sea is another one.
    void release() { time_s_.reset(); }

    const Hull& hull() const { return hull_; }
    const HullState& state() const { return state_; }
    /// Returns the matrix from the axes of the mesh to the world.
    glm::dmat4 world_from_mesh() const;

   private:
    void put_on(const WaterQuery& water);
    HullForce pull() const;

    Hull hull_;
    Mooring mooring_;
    HullState state_;
    HullWorkspace workspace_;
    std::optional<double> time_s_;  ///< of the last frame
};

}  // namespace pelagic::web
