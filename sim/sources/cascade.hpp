// One patch of waves: its buffers, and the stages that turn a spectrum into textures.
//
//   spectrum (on demand) -> evolve+rows -> columns+finalize -> gradients+mipmaps -> mipmaps tail
//
// Beside the gradients, if wanted: evolve+rows and columns+finalize once more for velocities, and folds -> folds tail.
//
// Stages that can hand each other their data while it is in a near cache are one job. Everything between spectrum and
// outputs lives on the stack or in the outputs themselves, of which there are two slots: one frame is computed while
// the host still draws the one before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/sources/fft_plan.hpp"
#include "pelagic/sim/sources/packed_spectrum.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/surface/fold_map.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// What a cascade's frames hold beside the sea.
struct CascadeExtras {
    bool folds = false;
    bool velocities = false;
    HostMemory memory = {};  ///< for everything whose size grows with N^2
};

class Cascade {
   public:
    Cascade(const SeaState& sea, Isa isa, CascadeExtras extras = {});
    Cascade(const Cascade&) = delete;  // stages point into it
    Cascade& operator=(const Cascade&) = delete;

    /// Adds the stages of a frame, or the one stage of a spectrum; the cascade outlives the graph's runs.
    void add_frame_stages(JobGraph& graph);
    void add_spectrum_stage(JobGraph& graph);

    /// What the next run of the frame's stages makes. \pre none is in flight
    void begin_frame(double time_s);
    /// The frame of the last run.
    const Frame& end_frame();
    /// Gives the slot of the last frame to the next one, so that the one before it is not written over yet.
    void drop_frame() { back_ = 1 - back_; }

    /// What the next run of the spectrum's stage bakes; adopt_spectrum() makes it the sea of the
    /// frames to come. A cascade has no waves before the first one.
    void begin_spectrum(const SeaState& sea);
    void adopt_spectrum();
    void drop_spectrum() { bake_.reset(); }  ///< keeps the sea as it is

    const SeaState& sea() const { return sea_; }
    std::size_t bytes() const;

   private:
    /// The outputs of one frame.
    struct Slot {
        Slot(int resolution, std::size_t lanes, const CascadeExtras& extras);
        std::size_t bytes() const {
            return surface.bytes() + rgba16f.bytes() + rgba8.bytes() + velocity.bytes() +
                   (folds ? folds->bytes() : 0);
        }

        AlignedBuffer<float> surface;   ///< lines at first, see wave_blocks.hpp
        AlignedBuffer<float> velocity;  ///< the same for the derivative in time, if wanted
        std::optional<FoldMap> folds;
        AlignedBuffer<std::uint16_t> rgba16f;
        AlignedBuffer<std::uint32_t> rgba8;
        Frame frame;
    };

    void add_fold_stages(JobGraph& graph, StageId surface_done);
    void add_velocity_stages(JobGraph& graph);

    Slot& back() { return slots_[back_]; }
    void spectrum(std::size_t line);
    EvolveRowsJob evolve_rows_job(std::size_t line_block, float* lines);
    void columns_finalize(std::size_t number, float* surface, PartBounds& bounds);
    void gradients_mipmaps(std::size_t tile);
    void mipmaps_tail();

    SeaState sea_;
    SeaFigures figures_;
    Isa isa_;
    const Kernels& kernels_;
    CascadeExtras extras_;
    FftPlan plan_;
    FftTables fft_;

    PackedSpectrum spectrum_;

    /// A spectrum being baked.
    struct Bake {
        SeaState sea;
        WaveSpectrum model;
        PackedSpectrum spectrum;
        std::vector<LineFigures> lines;
    };
    std::optional<Bake> bake_;

    MipAverages mip_averages_;
    std::vector<PartBounds> part_bounds_;      ///< of each pair of column blocks
    std::vector<PartBounds> velocity_bounds_;  ///< the same of velocities; nobody reads them

    std::array<Slot, 2> slots_;
    std::size_t back_ = 0;
    LoopFraction fraction_;
};

}  // namespace pelagic
