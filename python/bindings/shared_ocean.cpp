#include "pelagic/python/bindings/shared_ocean.hpp"

#include <cmath>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic::python {
namespace {

void need_finite(double time_s) {
    if (!std::isfinite(time_s))
        throw std::invalid_argument(invalid_value_message("time_s", time_s, "a finite number"));
}

}  // namespace

SharedOcean::SharedOcean(const Forecast& forecast, const OceanOptions& options)
    : executor_(options.executor),
      ocean_(std::make_unique<Ocean>(forecast, options)),
      repeat_length_m_(pelagic::repeat_length_m(forecast.first)),
      has_velocities_(options.velocities),
      has_foam_(options.foam || options.dynamic_waves || options.shore),
      has_dynamic_waves_(options.dynamic_waves.has_value()),
      has_spray_(options.spray.has_value()) {}

void SharedOcean::need_open_now() const {
    if (is_closed_) throw std::invalid_argument("the ocean is closed");
}

Ocean& SharedOcean::opened() const {
    need_open_now();
    return *ocean_;
}

void SharedOcean::begin(double time_s) {
    {
        std::unique_lock lock(state_);
        need_open_now();
        if (in_flight_) throw WrongOrder("a frame is in flight; call complete() first");
        need_finite(time_s);
        const std::uint64_t next = scheduled_ + 1;
        Use& use = use_of(next);
        if (use.views > 0)
            throw MemoryInUse(
                "an array of the frame of " + number_text(times_s_[next % 2]) +
                " s is still in use, and the next frame needs its memory: drop the array, or keep a copy() of it");
        scheduled_ = next;  // from here on no new reader of the old frame is accepted
        times_s_[next % 2] = time_s;
        readers_left_.wait(lock, [&] { return use.readers == 0; });
        in_flight_ = true;
    }
    try {
        ocean_->schedule(time_s);
    } catch (...) {
        in_flight_ = false;
        throw;
    }
}

NumberedFrame SharedOcean::end() {
    {
        const std::lock_guard lock(state_);
        need_open_now();
        if (!in_flight_) throw WrongOrder("no frame is in flight; call schedule() first");
        in_flight_ = false;  // also if complete() throws
    }
    return {ocean_->complete(), scheduled_};
}

void SharedOcean::schedule(double time_s) {
    const std::lock_guard turn(turn_);
    begin(time_s);
}

NumberedFrame SharedOcean::complete() {
    const std::lock_guard turn(turn_);
    return end();
}

NumberedFrame SharedOcean::frame_at(double time_s) {
    const std::lock_guard turn(turn_);
    begin(time_s);
    return end();
}

void SharedOcean::frames_at(std::span<const double> times_s,
                            const std::function<void(std::size_t, const Frame&)>& use) {
    const std::lock_guard turn(turn_);
    if (times_s.empty()) return;
    begin(times_s[0]);
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        const NumberedFrame made = end();
        const bool is_last = i + 1 == times_s.size();
        if (!is_last) begin(times_s[i + 1]);
        try {
            use(i, made.frame);
        } catch (...) {
            if (!is_last) end();
            throw;
        }
    }
}

bool SharedOcean::is_ready() {
    const std::lock_guard turn(turn_);
    return opened().is_ready();
}

void SharedOcean::schedule_sea(const SeaChange& change) {
    const std::lock_guard turn(turn_);
    opened().schedule_sea(change);
}

void SharedOcean::set_water_frame(const WaterFrame& water) {
    const std::lock_guard turn(turn_);
    opened().set_water_frame(water);
}

void SharedOcean::use(const std::function<void(Ocean&)>& with) {
    const std::lock_guard turn(turn_);
    with(opened());
}

void SharedOcean::use_between_frames(const std::function<void(Ocean&)>& with) {
    const std::lock_guard turn(turn_);
    need_open_now();
    if (in_flight_) throw WrongOrder("a frame is in flight; call complete() first");
    with(opened());
}

void SharedOcean::alter_input(const std::function<void()>& change) {
    const std::lock_guard turn(turn_);
    change();
}

SharedOcean::Facts SharedOcean::facts() {
    const std::lock_guard turn(turn_);
    const Ocean& ocean = opened();
    return {ocean.sea(),           ocean.resolution(),   ocean.executor().thread_limit(),
            ocean.cascade_count(), ocean.memory_bytes(), ocean.isa(),
            repeat_length_m_,      has_velocities_,      has_foam_};
}

void SharedOcean::close() {
    const std::lock_guard turn(turn_);
    std::unique_ptr<Ocean> last;
    {
        std::unique_lock lock(state_);
        is_closed_ = true;
        readers_left_.wait(lock, [&] { return uses_[0].readers + uses_[1].readers == 0; });
        idle_jobs_.clear();
        if (uses_[0].views + uses_[1].views == 0) last = std::move(ocean_);
    }
}

bool SharedOcean::is_closed() {
    const std::lock_guard lock(state_);
    return is_closed_;
}

void SharedOcean::need_open() {
    const std::lock_guard lock(state_);
    need_open_now();
}

bool SharedOcean::is_alive(std::uint64_t number) {
    const std::lock_guard lock(state_);
    return !is_closed_ && scheduled_ < number + 2;
}

void SharedOcean::need_alive(std::uint64_t number) const {
    need_open_now();
    if (scheduled_ >= number + 2)
        throw StaleFrame(
            "the frame's memory holds a later one: a frame lasts until the second schedule() or frame_at() after its "
            "own");
}

SharedOcean::Reader::Reader(std::shared_ptr<SharedOcean> ocean, std::uint64_t number)
    : ocean_(std::move(ocean)), number_(number) {
    const std::lock_guard lock(ocean_->state_);
    ocean_->need_alive(number_);
    ++ocean_->use_of(number_).readers;
}

SharedOcean::Reader::~Reader() {
    const std::lock_guard lock(ocean_->state_);
    if (--ocean_->use_of(number_).readers == 0) ocean_->readers_left_.notify_all();
}

SharedOcean::View::View(std::shared_ptr<SharedOcean> ocean, std::uint64_t number)
    : ocean_(std::move(ocean)), number_(number) {
    const std::lock_guard lock(ocean_->state_);
    ocean_->need_alive(number_);
    ++ocean_->use_of(number_).views;
}

SharedOcean::View::~View() {
    std::unique_ptr<Ocean> last;
    const std::lock_guard lock(ocean_->state_);
    --ocean_->use_of(number_).views;
    if (ocean_->is_closed_ && ocean_->uses_[0].views + ocean_->uses_[1].views == 0) last = std::move(ocean_->ocean_);
}

void SharedOcean::sample(const SurfaceQuery& query, const SurfacePoints& points, const SurfaceSamples& samples) {
    std::unique_ptr<SurfaceQueryJobs> jobs;
    {
        const std::lock_guard lock(state_);
        if (!idle_jobs_.empty()) {
            jobs = std::move(idle_jobs_.back());
            idle_jobs_.pop_back();
        }
    }
    if (!jobs) jobs = std::make_unique<SurfaceQueryJobs>(executor_);
    jobs->sample(query, points, samples);
    const std::lock_guard lock(state_);
    idle_jobs_.push_back(std::move(jobs));
}

}  // namespace pelagic::python
