#include "pelagic/floating/floating_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic {
namespace {

struct SavedHeader {
    std::uint64_t format;
    std::uint64_t checksum;  ///< XXH3 of all that follows it
    std::uint64_t count, next_number, has_wakes;
};
constexpr std::uint64_t saved_format = 0x33'594f'4248'4c50;  // "PLHBOY3"
constexpr std::size_t checked_from = offsetof(SavedHeader, count);

/// Before the numbers of each body.
struct SavedBody {
    std::uint64_t number, digest;
    std::uint64_t source, cells;  ///< of the wake; 0 without one
};

template <class Use>
void for_each_number(glm::dvec3& v, Use use) {
    use(v.x), use(v.y), use(v.z);
}

template <class Use>
void for_each_number(HullForce& force, Use use) {
    for_each_number(force.force_n, use);
    for_each_number(force.torque_nm, use);
}

/// Calls use(double&) for all values of a hull, in a fixed order.
template <class Use>
void for_each_number(FloatingHull& floating, Use use) {
    HullState& state = floating.state;
    for_each_number(state.position_m, use);
    use(state.orientation.w), use(state.orientation.x), use(state.orientation.y), use(state.orientation.z);
    for_each_number(state.velocity_mps, use);
    for_each_number(state.angular_velocity_radps, use);
    use(state.water_velocity_y_mps);
    for_each_number(state.water_rotation_radps, use);
    use(state.submersion);
    double has_previous_step = state.has_previous_step;
    use(has_previous_step);
    state.has_previous_step = has_previous_step != 0;
    for_each_number(floating.inputs.force, use);
    for_each_number(floating.inputs.wind_mps, use);
    HullLoads& loads = floating.loads;
    for (HullForce* force : {&loads.pressure, &loads.added_mass, &loads.drag, &loads.slamming})
        for_each_number(*force, use);
    use(loads.displaced_m3), use(loads.submersion);
    use(loads.water_height_m), use(loads.water_slope_x), use(loads.water_slope_z);
    for (glm::dvec3* v : {&loads.water_velocity_mps, &loads.water_rotation_radps, &loads.water_acceleration_mps2})
        for_each_number(*v, use);
    for (HullMatrix* matrix : {&loads.mass, &loads.stiffness})
        for (auto& row : *matrix)
            for (double& value : row) use(value);
}

template <class Value>
void append(std::vector<std::uint8_t>& bytes, const Value& value) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
}

}  // namespace

/// Reads saved values one after the other.
struct FloatingBodies::Reader {
    std::span<const std::uint8_t> rest;

    template <class Value>
    Value next() {
        if (rest.size() < sizeof(Value)) throw_size();
        Value value;
        std::memcpy(&value, rest.data(), sizeof value);
        rest = rest.subspan(sizeof value);
        return value;
    }
    template <class Number>
    void operator()(Number& number) {
        number = next<Number>();
        if (!std::isfinite(number)) throw std::invalid_argument("a saved body has a number that is not finite");
    }
    [[noreturn]] static void throw_size() {
        throw std::invalid_argument(
            "the saved bodies have a wrong size, expected as many bytes as their counts give");
    }
};

template <class Use>
void FloatingBodies::for_each_number(HullWake& wake, Use use) {
    use(wake.afloat_s_);
    double tick = static_cast<double>(wake.tick_);
    use(tick);
    wake.tick_ = static_cast<std::int64_t>(std::clamp(tick, -0x1p52, 0x1p52));
    pelagic::for_each_number(wake.hull_m_, use);
    pelagic::for_each_number(wake.pressure_m_, use);
    for (PressureFootprint* footprint : {&wake.next_, &wake.acted_[0], &wake.acted_[1], &wake.acted_[2]}) {
        use(footprint->x_m), use(footprint->z_m), use(footprint->forward_x), use(footprint->forward_z);
        use(footprint->velocity_x_mps), use(footprint->velocity_z_mps);
        for (float& depth : footprint->depth_m) use(depth);
    }
}

FloatingBodies::FloatingBodies(std::shared_ptr<Executor> executor, DynamicWaves* waves)
    : waves_(waves), jobs_(std::move(executor)) {}

FloatingBodies::~FloatingBodies() = default;

const FloatingBodies::Kind& FloatingBodies::kind_of(std::shared_ptr<const Hull> hull) {
    const std::uint64_t digest = hull->digest();
    const auto known =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) { return kind.digest == digest; });
    if (known != kinds_.end()) return *known;
    Kind kind{.hull = std::move(hull), .digest = digest, .wake = {}};
    if (waves_) kind.wake = HullWake(*waves_, *kind.hull);
    return kinds_.emplace_back(std::move(kind));
}

std::size_t FloatingBodies::index_of(std::uint32_t number) const {
    const auto at = std::lower_bound(bodies_.begin(), bodies_.end(), number,
                                     [](const Body& body, std::uint32_t wanted) { return body.number < wanted; });
    if (at == bodies_.end() || at->number != number)
        throw std::invalid_argument(invalid_value_message("number", number, "that of a body"));
    return static_cast<std::size_t>(at - bodies_.begin());
}

std::uint32_t FloatingBodies::add(std::shared_ptr<const Hull> hull, const HullState& state) {
    if (!hull) throw std::invalid_argument("hull is null, expected a hull");
    require(Hull::check(state));
    const Kind& kind = kind_of(std::move(hull));
    FloatingHull floating{.hull = kind.hull.get(), .state = state};
    const auto make_room = [](auto& vector) {
        if (vector.size() == vector.capacity()) vector.reserve(2 * vector.size() + 4);
    };
    make_room(bodies_);
    make_room(hulls_);
    std::unique_ptr<HullWake> wake;
    if (waves_) {
        wake = std::make_unique<HullWake>(*kind.wake);
        wake->launch(state);
        floating.inputs.wake = wake.get();
    }
    bodies_.push_back({next_number_, &kind, std::move(wake)});
    hulls_.push_back(floating);
    return next_number_++;
}

void FloatingBodies::remove(std::uint32_t number) {
    const auto at = std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& b) { return b.number == number; });
    if (at == bodies_.end()) return;
    if (at->wake) waves_->remove_source(at->wake->source_);
    hulls_.erase(hulls_.begin() + (at - bodies_.begin()));
    bodies_.erase(at);
}

void FloatingBodies::clear() {
    for (const Body& body : bodies_)
        if (body.wake) waves_->remove_source(body.wake->source_);
    bodies_.clear();
    hulls_.clear();
}

const Hull& FloatingBodies::hull(std::uint32_t number) const { return *hulls_[index_of(number)].hull; }
const HullState& FloatingBodies::state(std::uint32_t number) const { return hulls_[index_of(number)].state; }
const HullInputs& FloatingBodies::inputs(std::uint32_t number) const { return hulls_[index_of(number)].inputs; }
const HullLoads& FloatingBodies::loads(std::uint32_t number) const { return hulls_[index_of(number)].loads; }

void FloatingBodies::set_state(std::uint32_t number, const HullState& state) {
    const std::size_t i = index_of(number);
    require(Hull::check(state));
    hulls_[i].state = state;
}

void FloatingBodies::set_inputs(std::uint32_t number, const HullInputs& inputs) {
    const std::size_t i = index_of(number);
    require(Hull::check(inputs));
    hulls_[i].inputs = inputs;
    hulls_[i].inputs.wake = bodies_[i].wake.get();
}

void FloatingBodies::press(const Frame& frame, double tick_s) {
    HullWake::check_step(tick_s);
    if (!waves_) return;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        bodies_[i].wake->press(frame, hulls_[i].state, hulls_[i].loads, tick_s);
}

bool FloatingBodies::step(const SurfaceQuery& water, double step_s) {
    Hull::check_step(water, step_s);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (const std::string reason = Hull::check(hulls_[i].state); !reason.empty())
            throw std::invalid_argument("body " + std::to_string(bodies_[i].number) + ": " + reason);
    return jobs_.step(water, hulls_, step_s);
}

std::vector<std::uint8_t> FloatingBodies::save_state() const {
    SavedHeader header{saved_format, 0, bodies_.size(), next_number_, waves_ != nullptr};
    std::vector<std::uint8_t> bytes(sizeof header);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Body& body = bodies_[i];
        SavedBody saved{body.number, body.kind->digest, 0, 0};
        if (body.wake) saved.source = body.wake->source_, saved.cells = body.wake->plan_.low_m.size();
        append(bytes, saved);
        const auto put = [&](const auto& number) { append(bytes, number); };
        FloatingHull floating = hulls_[i];
        pelagic::for_each_number(floating, put);
        if (body.wake) for_each_number(*body.wake, put);
    }
    std::memcpy(bytes.data(), &header, sizeof header);
    header.checksum = XXH3_64bits(bytes.data() + checked_from, bytes.size() - checked_from);
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

FloatingBodies::Body FloatingBodies::read_body(Reader& from, std::uint32_t last_number,
                                               FloatingHull& floating) const {
    const auto saved = from.next<SavedBody>();
    if (saved.number <= last_number || saved.number > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(
            invalid_value_message("a saved body's number", saved.number, "more than the preceding number"));
    const std::string name = "saved body " + std::to_string(saved.number);
    const auto kind =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& known) { return known.digest == saved.digest; });
    if (kind == kinds_.end())
        throw std::invalid_argument(name + " has an unknown hull, expected one that was added to these bodies");
    Body body{static_cast<std::uint32_t>(saved.number), &*kind, {}};
    floating.hull = kind->hull.get();
    pelagic::for_each_number(floating, std::ref(from));
    for (const std::string& reason : {Hull::check(floating.state), Hull::check(floating.inputs)})
        if (!reason.empty()) throw std::invalid_argument(name + ": " + reason);
    if (!waves_) return body;
    body.wake = std::make_unique<HullWake>(*kind->wake);
    if (const std::size_t cells = body.wake->plan_.low_m.size(); saved.cells != cells)
        throw std::invalid_argument(name + "'s wake has " + number_text(saved.cells) + " cells, expected " +
                                    number_text(cells) + " as on these dynamic waves");
    body.wake->source_ = static_cast<std::uint32_t>(saved.source);
    floating.inputs.wake = body.wake.get();
    for_each_number(*body.wake, std::ref(from));
    for (const PressureFootprint* footprint :
         {&body.wake->next_, &body.wake->acted_[0], &body.wake->acted_[1], &body.wake->acted_[2]})
        if (const std::string reason = check(*footprint); !reason.empty())
            throw std::invalid_argument(name + ": " + reason);
    return body;
}

void FloatingBodies::restore_state(std::span<const std::uint8_t> saved) {
    Reader from{saved};
    const auto header = from.next<SavedHeader>();
    if (header.format != saved_format)
        throw std::invalid_argument("the saved bodies have another format, expected what save_state() returned");
    if (header.checksum != XXH3_64bits(saved.data() + checked_from, saved.size() - checked_from))
        throw std::invalid_argument("the saved bodies are damaged, expected the bytes that save_state() returned");
    if ((header.has_wakes != 0) != (waves_ != nullptr))
        throw std::invalid_argument(waves_ ? "the saved bodies have no wakes, expected bodies with wakes"
                                           : "the saved bodies have wakes, expected bodies without wakes");
    if (header.next_number < 1 || header.next_number > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(invalid_value_message("the next number", header.next_number, "[1, 2^32)"));
    if (header.count > from.rest.size() / sizeof(SavedBody)) Reader::throw_size();
    std::vector<Body> bodies;
    std::vector<FloatingHull> hulls;
    std::uint32_t last_number = 0;
    for (std::uint64_t i = 0; i < header.count; ++i) {
        FloatingHull floating;
        bodies.push_back(read_body(from, last_number, floating));
        hulls.push_back(floating);
        last_number = bodies.back().number;
    }
    if (!from.rest.empty()) Reader::throw_size();
    if (last_number >= header.next_number)
        throw std::invalid_argument(
            invalid_value_message("the next number", header.next_number, "more than that of each body"));
    bodies_.swap(bodies);
    hulls_.swap(hulls);
    next_number_ = static_cast<std::uint32_t>(header.next_number);
}

}  // namespace pelagic
