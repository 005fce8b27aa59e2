// Waves over the floor of a shore (shore.hpp), and the weight of each cascade there.
//
// Jobs bake once, by texel: each refracted long wave (refraction.hpp) as a complex amplitude; the
// weights of the cascades; and the attenuation of all waves together by breaking. A frame rotates
// the amplitudes by one phase for each wave, and adds them.
//
// A weight w scales the heights of a cascade and its level L (Cascade::level_m), but the mean that L
// removes is w^2 L. The shore's height contains the difference (w^2 - w) L, which fades to 0 at the
// edges of the rectangle, as its waves do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/double_buffer.hpp"
#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/height_field_buffers.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/shore/refraction.hpp"
#include "pelagic/sim/shore/sea_bed.hpp"
#include "pelagic/sim/shore/shore_waves.hpp"
#include "pelagic/sim/shore_surface.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/allocator.hpp"

namespace pelagic {

class ShoreSource final : public FramePart {
   public:
    /// Upper bound of the height of a single wave divided by the depth, on a uniform slope (McCowan
    /// 1894).
    static constexpr double breaking_height_over_depth = 0.78;
    /// Upper bounds for the sum of all waves, divided by the depth d: its standard deviation, and
    /// the height of a crest above still water. The first follows from Hrms = 0.42 d, where Hrms^2
    /// is 8 variances (Thornton and Guza 1983), so Hm0 is at most 0.6 d. Such waves are Rayleigh
    /// distributed: without the second bound, one crest in 20,000 would be higher than 0.66 d.
    static constexpr double deviation_over_depth = 0.42 / 2.8284271247461903, crest_over_depth = 0.66;

    /// Bakes the waves. Throws what the executor throws.
    /// \param at_ticks  whether ticks compute the shore, for a later part that reads it
    /// \pre check(options), check(sea) and check(options, sea) are empty; plans are those of the
    /// sea's cascades
    ShoreSource(const ShoreOptions& options, const SeaState& sea, const std::vector<CascadePlan>& plans,
                const Kernels& kernels, Executor& executor, const Allocator& memory = {}, bool at_ticks = false);

    /// Returns the shore that the next run computes, without its bounds: a tick's, until the frame's
    /// stage replaces it.
    ShoreSurface of_pass() const;

    /// Adds the stage that computes a pass's waves. At a tick the first cascade's stage includes it.
    void add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) override;
    void swap_buffers() override { slots_.swap(); }
    void begin(const PassMoment& at) override;
    void end(Frame& frame) override;
    void drop() override { slots_.swap(); }
    const char* fixes_sea() const override { return "shore"; }
    std::size_t bytes() const override;

   private:
    void add_bake_stages(JobGraph& graph);
    void end_bake();
    void bake_wave(std::size_t number);
    void bake_shelter(std::size_t number);
    void bake_limits(const Refraction& wave, double omega);
    void bake_weights(std::size_t row);
    void bake_breaking();
    void bake_heights(std::size_t row);
    /// Variance of the long waves, m^2.
    struct Variance {
        double of_all;  ///< sum of the waves' variances
        double here;    ///< mean over the loop, with interference of waves of one harmonic
    };
    /// Returns the index in amplitudes_ of a wave's real part; the imaginary part is group_texels
    /// later.
    std::size_t amplitude_offset(std::size_t texel, std::size_t wave) const;
    Variance variance_of_waves(std::size_t texel) const;
    /// Returns the largest height of waves on sand, above still water.
    double highest_on_sand_m(std::size_t texel) const;
    /// Returns the upper bound of the standard deviation of all waves, in water and on sand.
    double max_deviation_m(std::size_t texel) const;
    void rows(Pass pass, std::size_t item);
    void set_levels(std::span<const Cascade> cascades);
    /// Returns the fade weight: 0 at the rectangle's edges, 1 beyond fade_m from them.
    double inside(std::size_t texel) const;

    SeaBed bed_;
    SeaState sea_;
    double fade_m_;
    double swash_m_ = 0;    ///< largest run-up
    int swash_texels_ = 0;  ///< its largest distance from the water
    const Kernels& kernels_;
    std::vector<ShoreWave> waves_;

    AlignedBuffer<float> amplitudes_;  ///< laid out as ShoreRowsJob::waves
    std::vector<std::uint8_t> has_waves_;
    AlignedBuffer<float> highest_envelope_, breaking_envelope_, sharpness_, depth_;
    AlignedBuffer<float> level_;  ///< of the sea, from the first pass on
    bool has_levels_ = false;
    AlignedBuffer<std::uint32_t> weights_;
    float weights_change_per_m_ = 0;

    /// Data of the bake stages.
    /// Memory of a job that computes waves, which continues to be used by later jobs.
    struct Workspace {
        explicit Workspace(const SeaBed& bed) : refraction(bed) {}
        Refraction refraction;
        std::vector<double> phase, height;  ///< with those of waves that run up on sand
    };
    std::unique_ptr<Workspace> take_workspace();
    void return_workspace(std::unique_ptr<Workspace>);

    struct Bake {
        std::mutex mutex;  ///< of workspaces
        std::vector<std::unique_ptr<Workspace>> workspaces;
        /// Directions of short waves, for the shelter of land.
        std::vector<ShoreWave> shelter_waves;
        /// Fraction of the energy that arrives from each direction, by texel.
        std::vector<std::vector<float>> shelters;
        /// DepthAttenuation of each cascade except the coarsest, by depth.
        std::vector<std::vector<double>> depth_attenuations;
        double deepest_m;
        /// Cross-fade of the waves with the coarsest cascade, by texel: the squared weights of
        /// both, and so the energies, add up to one.
        std::vector<double> fade;
        std::vector<double> variances;  ///< of each cascade, m^2
        /// Weight of each cascade by texel, before breaking.
        std::vector<std::vector<float>> weights;
        /// That of the wave at the median of the energy; null without waves.
        std::unique_ptr<Workspace> main_wave;
        std::vector<double> deviation_m;  ///< of all waves by texel, before breaking
        std::vector<double> attenuation;  ///< of the long waves' amplitudes by breaking, by texel
    };
    std::unique_ptr<Bake> bake_;

    struct Slot : HeightFieldBuffers {
        AlignedBuffer<float> potential, reach;
    };
    DoubleBuffer<Slot> slots_;
    OfEachPass<std::vector<ShoreRowsJob::Moment>> moments_;
    bool at_ticks_;
    bool is_idle_ = false;  ///< the tick needs no shore
};

}  // namespace pelagic
