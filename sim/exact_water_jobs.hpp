// Large batches of points in exact water, spread over an executor.
#pragma once

#include <memory>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/exact_water.hpp"

namespace pelagic {

/// Samples exact water on an executor. One thread at a time may use an object.
class ExactWaterJobs {
   public:
    /// \throws std::invalid_argument  if the executor is null
    explicit ExactWaterJobs(std::shared_ptr<Executor> executor);
    ~ExactWaterJobs();
    ExactWaterJobs(const ExactWaterJobs&) = delete;
    ExactWaterJobs& operator=(const ExactWaterJobs&) = delete;

    /// Equals water.sample(points, samples), with bit-identical results.
    /// \throws std::invalid_argument  what that throws
    void sample(const ExactWater& water, const WaterPoints& points, const WaterSamples& samples);
    /// Equals water.sample_surface(points, samples), with bit-identical results.
    /// \throws std::invalid_argument  what that throws
    void sample_surface(const ExactWater& water, const SurfacePoints& points, const SurfaceSamples& samples);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
