// What a pelagic_ocean is: an Ocean, whether it is in order, and the frame that may be asked.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "pelagic/capi/c_dynamic_waves.hpp"
#include "pelagic/pelagic.h"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::capi {

/// The frame that complete() handed out last, for any number of threads, and the one before as long as somebody asks it.
///
/// A reader counts himself in at the current slot and looks again whether it still is. So whoever makes another one
/// current and then sees nobody at the old one knows that nobody will come. Readers never wait.
class QueryFrames {
    struct Slot {
        std::optional<SurfaceQuery> query;
        std::atomic<std::uint32_t> readers = 0;
    };

   public:
    /// Keeps the current frame from being written over while it lives.
    class Reader {
       public:
        explicit Reader(QueryFrames& frames);
        ~Reader() { leave(); }
        Reader(const Reader&) = delete;
        Reader& operator=(const Reader&) = delete;
        /// None before the first frame.
        const SurfaceQuery* query() const { return slot_ ? &*slot_->query : nullptr; }

       private:
        void leave();
        Slot* slot_ = nullptr;
    };

    /// Makes a frame the current one. \pre wait_for_old_readers() since the last time
    void show(const SurfaceQuery& query);

    /// Returns when nobody reads the frame before the current one any more, so that its memory may be written.
    void wait_for_old_readers();

   private:
    std::array<Slot, 2> slots_;
    std::size_t newest_ = 0;                ///< for the thread that completes frames
    std::atomic<Slot*> current_ = nullptr;  ///< the same for readers
};

}  // namespace pelagic::capi

struct pelagic_ocean {
    pelagic_ocean(const pelagic::Forecast& forecast, pelagic::OceanOptions options, double tolerance_m)
        : ocean(forecast, options),
          has_queries(options.queries),
          contents{.velocities = options.velocities,
                   .gradients = options.gradients || ocean.cascade_count() == 1,
                   .slopes = options.slopes || ocean.cascade_count() > 1,
                   .foam = options.foam},
          query_tolerance_m(tolerance_m) {
        if (options.dynamic_waves) dynamic_waves = {nullptr, &ocean.dynamic_waves(), this};
    }

    pelagic::Ocean ocean;
    pelagic_dynamic_waves dynamic_waves;
    bool has_queries;
    pelagic::FrameContents contents;  ///< of every frame
    double query_tolerance_m;
    bool frame_in_flight = false;
    bool sea_in_flight = false;
    bool has_completed = false;             ///< by complete(), not by frame_at() alone
    const pelagic::Frame* shown = nullptr;  ///< what queries, cascade, copy and hash tell of
    mutable pelagic::capi::QueryFrames asked;
};

namespace pelagic::capi {

ShoreOptions shore_options_of(const pelagic_shore_options* options);

/// What a call that needs them throws.
void need_no_frame_in_flight(const pelagic_ocean& ocean);
void need_frame(const pelagic_ocean& ocean);
/// What options name; none and operator new for null. Throw std::invalid_argument for an unknown name, and for one function of two.
std::optional<Isa> isa_of(const char* name);
Allocator allocator_of(pelagic_allocate allocate, pelagic_release release, void* user);
/// What the save functions share: writes to `bytes`, unless they are null, and how many there are to *count.
void write_saved(const std::vector<std::uint8_t>& saved, std::uint8_t* bytes, std::size_t room, std::size_t* count);

/// Throws std::invalid_argument for a wrong struct_size and for what can't be.
pelagic_ocean* new_ocean(const Forecast& forecast, const pelagic_ocean_options* options);

}  // namespace pelagic::capi
