// Definition of pelagic_ocean: an Ocean, the state of its calls, and the frame that queries read.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pelagic/capi/c_dynamic_waves.hpp"
#include "pelagic/pelagic.h"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::capi {

/// The frame completed last, for queries on any number of threads, and the preceding one while
/// queries read it.
///
/// A reader increments the count of the current slot and then checks that the slot is still
/// current. So after another slot has become current, a count of 0 means that no reader will use
/// the old slot. Readers never wait.
class QueryFrames {
    struct Slot {
        std::optional<SurfaceQuery> query;
        std::atomic<std::uint32_t> readers = 0;
    };

   public:
    /// Prevents the current frame from being overwritten during its lifetime.
    class Reader {
       public:
        explicit Reader(QueryFrames& frames);
        ~Reader() { leave(); }
        Reader(const Reader&) = delete;
        Reader& operator=(const Reader&) = delete;
        /// Returns null before the first frame.
        const SurfaceQuery* query() const { return slot_ ? &*slot_->query : nullptr; }

       private:
        void leave();
        Slot* slot_ = nullptr;
    };

    /// Makes a frame the current one. \pre wait_for_old_readers() since the last call
    void set_current(const SurfaceQuery& query);

    /// Waits until no query reads the frame before the current one, so that its memory may be
    /// overwritten.
    void wait_for_old_readers();

   private:
    std::array<Slot, 2> slots_;
    std::size_t newest_ = 0;                ///< index, for the thread that completes frames
    std::atomic<Slot*> current_ = nullptr;  ///< slot, for readers
};

}  // namespace pelagic::capi

struct pelagic_ocean {
    pelagic_ocean(const pelagic::Forecast& forecast, pelagic::OceanOptions options, double tolerance_m)
        : ocean(forecast, options), has_spray(options.spray.has_value()), query_tolerance_m(tolerance_m) {
        if (options.dynamic_waves) dynamic_waves = {nullptr, &ocean.dynamic_waves(), this};
    }

    pelagic::Ocean ocean;
    pelagic_dynamic_waves dynamic_waves;
    /// Objects that use the ocean hold it weakly, and so detect that it is destroyed.
    std::shared_ptr<pelagic_ocean> alive{this, [](pelagic_ocean*) {}};
    bool has_spray;
    double query_tolerance_m;
    bool frame_in_flight = false;
    bool sea_in_flight = false;
    bool has_completed = false;             ///< by complete(), not only by frame_at()
    const pelagic::Frame* current = nullptr;  ///< frame that queries, cascade, copy and hash read
    mutable pelagic::capi::QueryFrames query_frames;
};

namespace pelagic::capi {

/// Convert structs of the application. Throw std::invalid_argument for null, a wrong struct_size and
/// invalid values. ocean_options_of() and emitter_of() have structs that read_struct() has read, and
/// check() checks the values of emitters and water frames.
OceanOptions ocean_options_of(const pelagic_ocean_options& options);
ShoreOptions shore_options_of(const pelagic_shore_options* options);
SprayOptions spray_options_of(const pelagic_spray_options* options);
SprayEmitter emitter_of(const pelagic_spray_emitter& emitter);
WaterFrame water_frame_of(const pelagic_water_frame* water);

/// Throw WrongOrder.
void need_no_frame_in_flight(const pelagic_ocean& ocean);
void need_frame(const pelagic_ocean& ocean);
/// Returns the reader's query. Throws std::invalid_argument without queries, and WrongOrder before
/// the first frame.
const SurfaceQuery& needed_query(const pelagic_ocean& ocean, const QueryFrames::Reader& reader);
/// Convert options; null gives no instruction set and operator new. Throw std::invalid_argument for
/// an unknown name, and if only one function is set.
std::optional<Isa> isa_of(const char* name);
Allocator allocator_of(pelagic_allocate allocate, pelagic_release release, void* user);
/// Writes saved data to `bytes`, unless null, and its size to *count. Throws std::invalid_argument
/// if `room` is too small.
void write_saved(const std::vector<std::uint8_t>& saved, std::uint8_t* bytes, std::size_t room, std::size_t* count);

/// Creates an ocean. Throws std::invalid_argument for a wrong struct_size and an invalid option.
pelagic_ocean* new_ocean(const Forecast& forecast, const pelagic_ocean_options* options);

}  // namespace pelagic::capi
