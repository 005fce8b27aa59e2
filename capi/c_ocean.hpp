// Definition of pelagic_ocean: an Ocean, the state of its calls, and the frame that queries read.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pelagic/capi/c_dynamic_waves.hpp"
#include "pelagic/capi/idle_jobs.hpp"
#include "pelagic/pelagic.h"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/water_jobs.hpp"

namespace pelagic::capi {

/// The frame completed last and the preceding one, for readers on any number of threads.
///
/// A reader increments the count of a slot and then checks that the slot still has its frame. So
/// after a slot has lost its frame, a count of 0 means that no reader will use it. Readers never
/// wait.
class QueryFrames {
    struct Slot {
        Frame frame;
        std::optional<SurfaceQuery> query;      ///< of `frame`, if the ocean can be queried
        std::atomic<std::uint64_t> number = 0;  ///< of `frame`; 0: none
        std::atomic<std::uint32_t> readers = 0;
    };

   public:
    /// Prevents a frame from being overwritten during its lifetime.
    class Reader {
       public:
        /// \param number  of the frame; 0: the frame completed last
        explicit Reader(QueryFrames& frames, std::uint64_t number = 0);
        ~Reader() { leave(); }
        Reader(const Reader&) = delete;
        Reader& operator=(const Reader&) = delete;
        /// Returns null before the first frame, and if the frame's memory was reused.
        const Frame* frame() const { return slot_ ? &slot_->frame : nullptr; }
        /// As frame(); \pre the ocean can be queried
        const SurfaceQuery* query() const { return slot_ ? &*slot_->query : nullptr; }

       private:
        void enter_current(QueryFrames& frames);
        void leave();
        Slot* slot_ = nullptr;
    };

    /// Makes a frame the current one and returns its number. \pre wait_for_old_readers() since the
    /// last call
    std::uint64_t set_current(const Frame& frame, const std::optional<SurfaceQuery>& query);

    /// Takes the frame before the current one from readers, and waits until none reads it, so that
    /// its memory may be overwritten.
    void wait_for_old_readers();

   private:
    std::array<Slot, 2> slots_;
    std::size_t newest_ = 0;                ///< index, for the thread that completes frames
    std::uint64_t count_ = 0;               ///< of frames so far, for that thread
    std::atomic<Slot*> current_ = nullptr;  ///< slot, for readers
};

}  // namespace pelagic::capi

struct pelagic_ocean {
    pelagic_ocean(const pelagic::Forecast& forecast, pelagic::OceanOptions options, double tolerance_m)
        : executor(options.executor),
          ocean(forecast, options),
          has_spray(options.spray.has_value()),
          query_tolerance_m(tolerance_m) {
        if (options.dynamic_waves) dynamic_waves = {nullptr, &ocean.dynamic_waves(), this};
    }

    std::shared_ptr<pelagic::Executor> executor;
    pelagic::Ocean ocean;
    pelagic_dynamic_waves dynamic_waves;
    /// Objects that use the ocean hold it weakly, and so detect that it is destroyed.
    std::shared_ptr<pelagic_ocean> alive{this, [](pelagic_ocean*) {}};
    bool has_spray;
    double query_tolerance_m;
    bool frame_in_flight = false;
    double scheduled_s = 0;  ///< time of the frame scheduled last
    bool sea_in_flight = false;
    bool has_completed = false;             ///< by complete(), not only by frame_at()
    const pelagic::Frame* current = nullptr;  ///< frame that queries, cascade, copy and hash read
    mutable pelagic::capi::QueryFrames query_frames;
    mutable pelagic::capi::IdleJobs<pelagic::SurfaceQueryJobs> idle_queries;
    mutable pelagic::capi::IdleJobs<pelagic::WaterJobs> idle_water;
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

/// Starts a frame. Throws WrongOrder if a frame is in flight, and std::invalid_argument.
void schedule_frame(pelagic_ocean& ocean, double time_s);
/// Completes the frame in flight, which becomes the current one. Returns its number. Throws WrongOrder
/// without such a frame, and what Ocean::complete() throws, after which no frame is in flight.
std::uint64_t complete_frame(pelagic_ocean& ocean);
/// Describes the current frame, whose number complete_frame() returned.
pelagic_frame c_frame_of(const pelagic_ocean& ocean, std::uint64_t number);

/// Throw WrongOrder.
void need_no_frame_in_flight(const pelagic_ocean& ocean);
void need_frame(const pelagic_ocean& ocean);
/// Throw WrongOrder before the first frame, and if the memory of frame `number` was reused.
const Frame& needed_frame(const QueryFrames::Reader& reader, std::uint64_t number = 0);
/// Also throws std::invalid_argument without queries.
const SurfaceQuery& needed_query(const pelagic_ocean& ocean, const QueryFrames::Reader& reader,
                                 std::uint64_t number = 0);
/// Returns the options of a query, of which a tolerance of 0 is the ocean's. Throws std::invalid_argument.
SurfaceQueryOptions query_options_of(const pelagic_ocean& ocean, double tolerance_m, std::int32_t interpolation);
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
