// Waves over the floor of a shore (shore.hpp), frame by frame, and how much of each cascade there is.
//
// Baked once, on jobs: each long wave's way over the floor (refraction.hpp) as a complex amplitude a texel; what comes of the cascades' own
// waves; how much of all of them together stands at a depth. A frame turns the amplitudes by a phase a wave and adds them up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/shore/refraction.hpp"
#include "pelagic/sim/shore/sea_bed.hpp"
#include "pelagic/sim/shore/shore_waves.hpp"
#include "pelagic/sim/shore_surface.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/simd/allocator.hpp"

namespace pelagic {

class ShoreSource {
   public:
    /// Height over depth of a wave that breaks on an even slope, at most (McCowan 1894).
    static constexpr double breaking_height_over_depth = 0.78;
    /// Of all waves at a place together: standard deviation over depth, at most, Hrms = 0.42 d where Hrms^2 is 8 variances (Thornton and
    /// Guza 1983), so Hm0 is at most 0.6 d; and the height of a crest above still water over depth. Such waves are Rayleigh distributed, so
    /// the first alone would let one crest of 20,000 be higher than 0.66 d.
    static constexpr double deviation_over_depth = 0.42 / 2.8284271247461903, crest_over_depth = 0.66;

    /// \pre check(options), check(sea) and check(options, sea) are empty; plans are those of the sea's cascades
    ShoreSource(const ShoreOptions& options, const SeaState& sea, const std::vector<CascadePlan>& plans,
                const Kernels& kernels, const Allocator& memory = {});
    ShoreSource(const ShoreSource&) = delete;  // stages point into it
    ShoreSource& operator=(const ShoreSource&) = delete;

    /// To be run once, before all frames.
    void add_bake_stages(JobGraph& graph);
    void end_bake();

    void add_frame_stage(JobGraph& graph);
    /// Makes room for the next frame, before anything of it can fail; drop_frame() gives it back.
    void turn() { back_ = 1 - back_; }
    /// \pre turn() for this frame
    void begin_frame(double time_s);
    /// Of the last run. Valid until the second begin_frame() from then.
    ShoreSurface end_frame();
    void drop_frame() { turn(); }

    const std::vector<ShoreWave>& waves() const { return waves_; }
    std::size_t bytes() const;

   private:
    void bake_wave(std::size_t number);
    void bake_shelter(std::size_t number);
    void bake_limits(const Refraction& wave, double omega);
    void bake_parts(std::size_t row);
    void bake_breaking();
    void bake_heights(std::size_t row);
    /// Of the long waves, m^2: the sum of each wave's; and the mean over the loop, where waves of one harmonic interfere.
    struct Variance {
        double of_all, here;
    };
    std::size_t place_of(std::size_t texel, std::size_t wave) const;  ///< of its two numbers in amplitudes_
    Variance variance_of_waves(std::size_t texel) const;
    /// Of still water, and as deep as the swash is high where it is shallower.
    double wave_depth_m(std::size_t texel) const;
    void rows(std::size_t item);
    /// 0 at the rectangle's edges, 1 inside.
    double inside(std::size_t texel) const;

    SeaBed bed_;
    SeaState sea_;
    double fade_m_, swash_m_;
    const Kernels& kernels_;
    std::vector<ShoreWave> waves_;

    AlignedBuffer<float> amplitudes_;  ///< as ShoreRowsJob::waves
    std::vector<std::uint8_t> has_waves_;
    AlignedBuffer<float> highest_envelope_, breaking_envelope_, sharpness_, depth_;
    AlignedBuffer<std::uint32_t> parts_;
    float parts_change_per_m_ = 0;

    /// While it is baked.
    struct Bake {
        std::vector<ShoreWave> ways;                   ///< along which shorter waves come
        std::vector<std::vector<float>> shelters;      ///< energy that comes along each, by texel
        std::vector<std::vector<double>> depth_parts;  ///< of each cascade but the coarsest, by depth
        double deepest_m;
        std::vector<double> variances;          ///< of each cascade, m^2
        std::vector<std::vector<float>> parts;  ///< of each cascade, by texel, before waves break
        std::unique_ptr<Refraction> main_way;   ///< of the wave in the middle of the energy; none without waves
        std::vector<double> deviation_m;        ///< of all waves, by texel, before they break
        std::vector<double> attenuation;        ///< of the long waves' amplitudes by breaking, by texel
    };
    std::unique_ptr<Bake> bake_;

    struct Slot {
        AlignedBuffer<float> height, vertical_velocity, potential, reach;
        AlignedBuffer<std::uint8_t> foam;
        std::vector<float> lowest, highest;
    };
    std::array<Slot, 2> slots_;
    std::size_t back_ = 0;
    std::vector<ShoreRowsJob::Moment> moments_;
};

}  // namespace pelagic
