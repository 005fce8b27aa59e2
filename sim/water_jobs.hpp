// Large batches of points in the water, spread over an executor.
#pragma once

#include <memory>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/exact_water.hpp"

namespace pelagic {

/// Samples water on an executor. One thread at a time may use an object.
class WaterJobs {
   public:
    /// \throws std::invalid_argument  if the executor is null
    explicit WaterJobs(std::shared_ptr<Executor> executor);
    ~WaterJobs();
    WaterJobs(const WaterJobs&) = delete;
    WaterJobs& operator=(const WaterJobs&) = delete;

    /// Equals water.sample(points, samples), with bit-identical results.
    /// \throws std::invalid_argument  what that throws
    void sample(const WaterKinematics& water, const WaterPoints& points, const WaterSamples& samples);
    /// Equals water.sample_surface(points, samples), with bit-identical results.
    /// \throws std::invalid_argument  what that throws
    void sample_surface(const ExactWater& water, const SurfacePoints& points, const SurfaceSamples& samples);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
