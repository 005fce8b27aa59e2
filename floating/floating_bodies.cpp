#include "pelagic/floating/floating_bodies.hpp"

#include <algorithm>
#include <array>
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

#include "pelagic/floating/given_coefficients.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/water_query.hpp"

namespace pelagic {
namespace {

struct SavedHeader {
    std::uint64_t format;
    std::uint64_t checksum;  ///< XXH3 of all that follows it
    std::uint64_t count, next_number, has_wakes;
};
constexpr std::uint64_t saved_format = 0x34'594f'4248'4c50;  // "PLHBOY4"
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

/// Calls use(double&) for all values of a hull, in a fixed order.
template <class Use>
void FloatingBodies::for_each_number(Motion& motion, Use use) {
    const auto each = [&](auto& value) { pelagic::for_each_number(value, use); };
    HullState& state = motion.state;
    each(state.position_m);
    use(state.orientation.w), use(state.orientation.x), use(state.orientation.y), use(state.orientation.z);
    each(state.velocity_mps);
    each(state.angular_velocity_radps);
    use(state.wake_velocity_y_mps);
    each(state.wake_rotation_radps);
    use(state.submersion);
    double has_previous_step = state.has_previous_step;
    use(has_previous_step);
    state.has_previous_step = has_previous_step != 0;
    each(motion.inputs.force);
    each(motion.inputs.wind_mps);
    HullLoads& loads = motion.loads;
    for (HullForce* force : {&loads.pressure, &loads.added_mass, &loads.drag, &loads.slamming}) each(*force);
    use(loads.displaced_m3), use(loads.submersion);
    use(loads.water_height_m), use(loads.water_slope_x), use(loads.water_slope_z);
    for (glm::dvec3* v : {&loads.water_velocity_mps, &loads.water_rotation_radps, &loads.water_acceleration_mps2})
        each(*v);
    for (HullMatrix* matrix : {&loads.mass, &loads.stiffness})
        for (auto& row : *matrix)
            for (double& value : row) use(value);
}

/// Calls use(double&) for the values of a hull with given coefficients that others do not have.
template <class Use>
void FloatingBodies::for_each_of_radiation(Motion& motion, Use use) {
    for (auto* const values : {&motion.state.radiation.rate, &motion.state.radiation.sum})
        for (Vector6& velocity : *values)
            for (double& value : velocity) use(value);
    pelagic::for_each_number(motion.loads.radiation, use);
}

/// \throws std::invalid_argument  if there is no room for another body with given coefficients
void FloatingBodies::require_few(std::span<const Body> bodies) {
    const auto count = std::count_if(bodies.begin(), bodies.end(),
                                     [](const Body& body) { return body.kind->hull.coefficients() != nullptr; });
    if (count >= max_given)
        throw std::invalid_argument("the set has " + std::to_string(count) +
                                    " bodies with given coefficients, expected at most " + std::to_string(max_given));
}

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

/// The jobs of a step, and what they work on.
struct FloatingBodies::Jobs {
    static constexpr std::size_t count = 64;

    void run(std::size_t job) {
        const std::size_t bodies_a_job = (bodies.size() + count - 1) / count;
        const std::size_t end = std::min((job + 1) * bodies_a_job, bodies.size());
        std::vector<Hull::Moving>& moving = hulls[job];
        moving.clear();
        for (std::size_t i = job * bodies_a_job; i < end; ++i)
            moving.push_back({bodies[i].kind->hull, bodies[i].state, bodies[i].inputs, bodies[i].loads});
        if (!moving.empty()) Hull::advance(*water, moving, step_s, workspaces[job]);
    }

    const WaterKinematics* water = nullptr;
    std::span<Body> bodies;
    double step_s = 0;
    std::array<HullWorkspace, count> workspaces;
    std::array<std::vector<Hull::Moving>, count> hulls;
    SeaForces sea_forces;
    std::shared_ptr<Executor> executor;
    JobGraph graph;
    std::unique_ptr<GraphRun> graph_run;
};

FloatingBodies::FloatingBodies(std::shared_ptr<Executor> executor, DynamicWaves* waves)
    : waves_(waves), jobs_(new Jobs) {
    if (!executor) throw std::invalid_argument("executor is null, expected an executor");
    jobs_->executor = std::move(executor);
    jobs_->graph.add(
        {.name = "hulls", .count = Jobs::count, .body = [jobs = jobs_.get()](std::size_t begin, std::size_t end) {
             for (std::size_t job = begin; job < end; ++job) jobs->run(job);
         }});
    jobs_->graph_run = jobs_->executor->prepare(jobs_->graph);
}

FloatingBodies::~FloatingBodies() = default;

FloatingBodies::Kind::Kind(const Hull& of, std::uint64_t its_digest, DynamicWaves* waves)
    : hull(of), digest(its_digest) {
    if (waves) wake = HullWake(*waves, hull);
}

std::size_t FloatingBodies::index_of(std::uint32_t number) const {
    const auto at = std::lower_bound(bodies_.begin(), bodies_.end(), number,
                                     [](const Body& body, std::uint32_t wanted) { return body.number < wanted; });
    if (at == bodies_.end() || at->number != number)
        throw std::invalid_argument(invalid_value_message("number", number, "that of a body"));
    return static_cast<std::size_t>(at - bodies_.begin());
}

std::uint32_t FloatingBodies::add(const Hull& hull, const HullState& state) {
    require(Hull::check(state));
    if (hull.coefficients()) require_few(bodies_);
    const std::uint64_t digest = hull.digest();
    const auto known =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) { return kind.digest == digest; });
    const Kind& kind = known != kinds_.end() ? *known : kinds_.emplace_back(hull, digest, waves_);
    if (bodies_.size() == bodies_.capacity()) bodies_.reserve(2 * bodies_.size() + 4);
    Body body{{.state = state}, next_number_, &kind, {}};
    if (waves_) {
        body.wake = std::make_unique<HullWake>(*kind.wake);
        body.wake->launch(state);
        body.inputs.wake = body.wake.get();
    }
    bodies_.push_back(std::move(body));
    return next_number_++;
}

void FloatingBodies::remove(std::uint32_t number) {
    const auto at = std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& b) { return b.number == number; });
    if (at == bodies_.end()) return;
    if (at->wake) waves_->remove_source(at->wake->source_);
    bodies_.erase(at);
}

void FloatingBodies::clear() {
    for (const Body& body : bodies_)
        if (body.wake) waves_->remove_source(body.wake->source_);
    bodies_.clear();
}

const Hull& FloatingBodies::hull(std::uint32_t number) const { return body_of(number).kind->hull; }
const HullState& FloatingBodies::state(std::uint32_t number) const { return body_of(number).state; }
const HullInputs& FloatingBodies::inputs(std::uint32_t number) const { return body_of(number).inputs; }
const HullLoads& FloatingBodies::loads(std::uint32_t number) const { return body_of(number).loads; }

void FloatingBodies::set_state(std::uint32_t number, const HullState& state) {
    Body& body = bodies_[index_of(number)];
    require(Hull::check(state));
    body.state = state;
}

void FloatingBodies::set_inputs(std::uint32_t number, const HullInputs& inputs) {
    Body& body = bodies_[index_of(number)];
    require(Hull::check(inputs));
    body.inputs = inputs;
    body.inputs.wake = body.wake.get();
    body.inputs.diffraction = nullptr;  // step() sets it
}

void FloatingBodies::shift(double x_m, double z_m) {
    const auto moved = [&](HullState state) {
        state.position_m += glm::dvec3(x_m, 0, z_m);
        return state;
    };
    for (const Body& body : bodies_)
        if (const std::string reason = Hull::check(moved(body.state)); !reason.empty())
            throw std::invalid_argument("body " + std::to_string(body.number) + ": " + reason);
    for (Body& body : bodies_) {
        body.state = moved(body.state);
        if (body.wake) body.wake->shift(x_m, z_m);
    }
}

void FloatingBodies::press(const Frame& frame, double tick_s) {
    HullWake::check_tick(tick_s);
    if (!waves_) return;
    for (Body& body : bodies_) body.wake->press(frame, body.state, body.loads, tick_s);
}

bool FloatingBodies::step(const Frame& frame, double step_s) { return step(WaterQuery(frame), step_s); }

bool FloatingBodies::step(const WaterKinematics& water, double step_s) {
    for (const Body& body : bodies_) Hull::check_step(water, body.inputs, step_s);
    for (const Body& body : bodies_)
        if (const std::string reason = Hull::check(body.state); !reason.empty())
            throw std::invalid_argument("body " + std::to_string(body.number) + ": " + reason);
    for (Body& body : bodies_)
        if (body.kind->hull.diffraction()) body.inputs.diffraction = &jobs_->sea_forces.on(body.kind->hull, water);
    jobs_->water = &water;
    jobs_->bodies = bodies_;
    jobs_->step_s = step_s;
    jobs_->graph_run->run();
    return Hull::Steps(step_s).are_all;
}

std::vector<std::uint8_t> FloatingBodies::save_state() const {
    SavedHeader header{saved_format, 0, bodies_.size(), next_number_, waves_ != nullptr};
    std::vector<std::uint8_t> bytes(sizeof header);
    for (const Body& body : bodies_) {
        SavedBody saved{body.number, body.kind->digest, 0, 0};
        if (body.wake) saved.source = body.wake->source_, saved.cells = body.wake->plan_.low_m.size();
        append(bytes, saved);
        const auto put = [&](const auto& number) { append(bytes, number); };
        Motion motion = body;
        for_each_number(motion, put);
        if (body.kind->hull.coefficients()) for_each_of_radiation(motion, put);
        if (body.wake) for_each_number(*body.wake, put);
    }
    std::memcpy(bytes.data(), &header, sizeof header);
    header.checksum = XXH3_64bits(bytes.data() + checked_from, bytes.size() - checked_from);
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

FloatingBodies::Body FloatingBodies::read_body(Reader& from, std::uint32_t last_number) const {
    const auto saved = from.next<SavedBody>();
    if (saved.number <= last_number || saved.number > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(
            invalid_value_message("a saved body's number", saved.number, "more than the preceding number"));
    const std::string name = "saved body " + std::to_string(saved.number);
    const auto kind =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& known) { return known.digest == saved.digest; });
    if (kind == kinds_.end())
        throw std::invalid_argument(name + " has an unknown hull, expected one that was added to these bodies");
    Body body{{}, static_cast<std::uint32_t>(saved.number), &*kind, {}};
    for_each_number(body, std::ref(from));
    if (kind->hull.coefficients()) for_each_of_radiation(body, std::ref(from));
    for (const std::string& reason : {Hull::check(body.state), Hull::check(body.inputs)})
        if (!reason.empty()) throw std::invalid_argument(name + ": " + reason);
    if (!waves_) return body;
    body.wake = std::make_unique<HullWake>(*kind->wake);
    if (const std::size_t cells = body.wake->plan_.low_m.size(); saved.cells != cells)
        throw std::invalid_argument(name + "'s wake has " + number_text(saved.cells) + " cells, expected " +
                                    number_text(cells) + " as on these dynamic waves");
    body.wake->source_ = static_cast<std::uint32_t>(saved.source);
    body.inputs.wake = body.wake.get();
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
    std::uint32_t last_number = 0;
    for (std::uint64_t i = 0; i < header.count; ++i) {
        Body body = read_body(from, last_number);
        if (body.kind->hull.coefficients()) require_few(bodies);
        bodies.push_back(std::move(body));
        last_number = bodies.back().number;
    }
    if (!from.rest.empty()) Reader::throw_size();
    if (last_number >= header.next_number)
        throw std::invalid_argument(
            invalid_value_message("the next number", header.next_number, "more than that of each body"));
    bodies_.swap(bodies);
    next_number_ = static_cast<std::uint32_t>(header.next_number);
}

}  // namespace pelagic
