#include "pelagic/gl/water/caustics.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec2.hpp>
#include <stdexcept>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::gl {
namespace {

constexpr double water_index = 1.333;
constexpr int caustics_side = Caustics::side;
/// Number of samples of a cell's light along each axis. They are half a texel apart and still
/// overlap when the cell is stretched by a factor of four.
constexpr int subsamples = 2;
// Light is counted in integers, so that the sum does not depend on the order in which threads add.
// A sample of mean light is 256 x 32 x 32, so a texel overflows at 4096 times the mean.
constexpr float light_unit = 256;
constexpr int weight_steps = 32;
/// Maximum radius of the blur, texels.
constexpr int max_blur_radius = 10;

/// Minimum y of the direction to the sun. For a lower sun, waves would shadow each other, but
/// hardly any light enters the water then.
constexpr float lowest_sun = 0.1f;

glm::vec3 as_high_as_needed(glm::vec3 sun) {
    if (sun.y >= lowest_sun) return sun;
    const glm::vec2 level(sun.x, sun.z);
    const float length = glm::length(level);
    const glm::vec2 ahead = length > 1e-6f ? level / length : glm::vec2(1, 0);
    const float across = std::sqrt(1 - lowest_sun * lowest_sun);
    return {ahead.x * across, lowest_sun, ahead.y * across};
}

/// Refracts sunlight from air into water by Snell's law.
/// \param sun  unit vector towards the sun
glm::vec3 refracted(glm::vec3 sun, glm::vec3 normal) {
    constexpr auto eta = static_cast<float>(1 / water_index);
    const float cosine = std::max(glm::dot(sun, normal), 0.f);
    const float in_water = std::sqrt(1 - eta * eta * (1 - cosine * cosine));
    return -eta * sun + (eta * cosine - in_water) * normal;
}

std::size_t index_of(int i, int j) {
    return static_cast<std::size_t>(j & (caustics_side - 1)) * caustics_side +
           static_cast<std::size_t>(i & (caustics_side - 1));
}

/// Returns the cascade whose focal depth is nearest depth_m, measured by their ratio.
const Cascade& cascade_for(const Frame& frame, double depth_m) {
    const auto off_by = [&](const Cascade& cascade) { return std::abs(std::log(focus_of(cascade) / depth_m)); };
    const Cascade* best = &frame.cascades[0];
    for (const Cascade& cascade : frame.cascades)
        if (off_by(cascade) < off_by(*best)) best = &cascade;
    return *best;
}

/// Returns the root mean square distance, per axis and in texels, by which waves shorter than the
/// cascade's displace light on the plane. A slope deflects a ray by (1 - 1/n) of its angle.
double blur_of(const Frame& frame, const Cascade& cascade, double depth_m) {
    double variance = frame.statistics.unresolved_slopes.total();
    for (const Cascade* finer = &cascade + 1; finer < frame.cascades.data() + frame.cascades.size(); ++finer)
        variance += finer->slope_variance;
    return depth_m * (1 - 1 / water_index) * std::sqrt(0.5 * variance) / (cascade.grid.side_m / caustics_side);
}

}  // namespace

std::string check(const CausticsOptions& options) {
    if (!(options.depth_m >= 0.001 && options.depth_m <= 1000))
        return invalid_value_message("depth_m", options.depth_m, "[0.001, 1000]");
    if (!(std::abs(glm::length(options.sun) - 1) < 1e-3f))
        return invalid_value_message("sun", glm::length(options.sun), "a unit vector");
    return {};
}

double focus_of(const Cascade& cascade) {
    const int n = cascade.resolution();
    const double texel = cascade.texel_m();
    const int step = std::max(n / 64, 1);
    double squares = 0;
    int count = 0;
    for (int j = 0; j < n; j += step)
        for (int i = 0; i < n; i += step) {
            const auto at = [&](int x, int z) {
                return static_cast<double>(cascade.height.at((x + n) % n, (z + n) % n));
            };
            const double sum =
                (at(i + 1, j) + at(i - 1, j) + at(i, j + 1) + at(i, j - 1) - 4 * at(i, j)) / (texel * texel);
            squares += sum * sum;
            ++count;
        }
    const double curvature = std::sqrt(squares / count);
    return water_index / ((water_index - 1) * 1.5 * std::max(curvature, 1e-9));
}

double caustics_depth_m(const SeaFloor& floor, double sea_depth_m) {
    constexpr double deepest_m = 12, usual_m = 8;
    if (floor.is_even()) return sea_depth_m <= deepest_m ? std::max(sea_depth_m, 0.2) : usual_m;
    std::vector<float> depths;
    for (const float height : floor.heights_m)
        if (height < -0.5f && height > -deepest_m) depths.push_back(-height);
    if (depths.empty()) return usual_m;
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return static_cast<double>(*middle);
}

// Stages, in order:
//
//   caustics surface         resamples the cascade on a grid of `side` texels along its own axes
//   caustics rays            intersects each corner's ray with the plane
//   caustics splat           adds the light of the cells to the texels
//   caustics rows, columns   blur
//   caustics mips            normalises and generates the mips
struct CausticsBaker::State {
    static constexpr std::size_t cells = std::size_t{caustics_side} * caustics_side;

    explicit State(const std::shared_ptr<Executor>& executor) : counts(cells) {
        surface.resize(cells);
        target.resize(cells);
        plain.resize(cells);
        blurred.resize(cells);
        const auto each_row = [](auto body) {
            return [body](std::size_t begin, std::size_t end) {
                for (std::size_t row = begin; row < end; ++row) body(static_cast<int>(row));
            };
        };
        const StageId grid =
            graph.add({"caustics surface", caustics_side, 16, {}, each_row([this](int j) { sample_row(j); })});
        const StageId rays =
            graph.add({"caustics rays", caustics_side, 16, {grid}, each_row([this](int j) { refract_row(j); })});
        const StageId splat =
            graph.add({"caustics splat", caustics_side, 16, {rays}, each_row([this](int j) { splat_row(j); })});
        const StageId rows =
            graph.add({"caustics rows", caustics_side, 16, {splat}, each_row([this](int j) { blur_row(j); })});
        const StageId columns =
            graph.add({"caustics columns", caustics_side, 16, {rows}, each_row([this](int j) { blur_columns(j); })});
        graph.add({"caustics mips", 1, 1, {columns}, [this](auto, auto) { pack(); }});
        run = executor->prepare(graph);
    }

    void begin(const Frame& frame, const CausticsOptions& options) {
        making.options = options;
        const Cascade& chosen = cascade_for(frame, options.depth_m);
        cascade = chosen;
        making.grid = cascade.grid;
        const glm::vec3 sun = as_high_as_needed(options.sun);
        const auto c = static_cast<float>(cascade.grid.cosine), s = static_cast<float>(cascade.grid.sine);
        sun_in_cascade = {c * sun.x + s * sun.z, sun.y, c * sun.z - s * sun.x};
        const double sigma = std::min(blur_of(frame, chosen, options.depth_m), max_blur_radius / 2.5);
        float sum = 0;
        for (int i = -max_blur_radius; i <= max_blur_radius; ++i) {
            const double offset = i / std::max(sigma, 0.3);  // 0.3 texels: no visible blur
            sum += kernel[static_cast<std::size_t>(i + max_blur_radius)] =
                static_cast<float>(std::exp(-0.5 * offset * offset));
        }
        for (float& weight : kernel) weight /= sum;
        for (std::atomic<std::uint32_t>& count : counts) count.store(0, std::memory_order_relaxed);
        in_flight = true;
    }

    /// Resamples row j of the grid: interpolates if the cascade has fewer texels, and skips texels
    /// if it has more.
    void sample_row(int j) {
        const int n = cascade.resolution();
        std::vector<float> rows[6];
        const double z = static_cast<double>(j) * n / caustics_side;
        const int upper = static_cast<int>(z);
        const auto fraction_z = static_cast<float>(z - upper);
        const PlaneView* const planes[] = {&cascade.dx, &cascade.height, &cascade.dz};
        for (std::size_t plane = 0; plane < 3; ++plane)
            for (std::size_t k = 0; k < 2; ++k) {
                rows[2 * plane + k].resize(static_cast<std::size_t>(n));
                planes[plane]->copy_row((upper + static_cast<int>(k)) % n, rows[2 * plane + k].data());
            }
        const auto c = static_cast<float>(cascade.grid.cosine), s = static_cast<float>(cascade.grid.sine);
        for (int i = 0; i < caustics_side; ++i) {
            const double x = static_cast<double>(i) * n / caustics_side;
            const auto left = static_cast<std::size_t>(x), right = (left + 1) % static_cast<std::size_t>(n);
            const auto fraction_x = static_cast<float>(x - std::floor(x));
            const auto at = [&](std::size_t plane) {
                const std::vector<float>&a = rows[2 * plane], &b = rows[2 * plane + 1];
                return std::lerp(std::lerp(a[left], a[right], fraction_x), std::lerp(b[left], b[right], fraction_x),
                                 fraction_z);
            };
            const float dx = at(0), dz = at(2);
            surface[index_of(i, j)] = {c * dx + s * dz, at(1), c * dz - s * dx};
        }
    }

    /// Computes, for row j, where rays meet the plane relative to rays through flat water, and the
    /// light that enters each cell, which is proportional to its area projected along the sun's
    /// rays.
    void refract_row(int j) {
        const auto step = static_cast<float>(cascade.grid.side_m / caustics_side);
        const auto depth = static_cast<float>(making.options.depth_m);
        const glm::vec3 flat = refracted(sun_in_cascade, {0, 1, 0});
        for (int i = 0; i < caustics_side; ++i) {
            const auto at = [&](int x, int z) { return surface[index_of(x, z)]; };
            const glm::vec3 along = glm::vec3(2 * step, 0, 0) + at(i + 1, j) - at(i - 1, j);
            const glm::vec3 across = glm::vec3(0, 0, 2 * step) + at(i, j + 1) - at(i, j - 1);
            glm::vec3 normal = glm::cross(across, along);
            // Where the surface overturns, a level normal is used.
            normal = normal.y > 0 ? glm::normalize(normal) : glm::vec3(0, 1, 0);
            const glm::vec3 ray = refracted(sun_in_cascade, normal);
            const glm::vec3 here = at(i, j);
            const glm::vec2 moved = glm::vec2(here.x, here.z) +
                                    glm::vec2(ray.x, ray.z) * ((depth + here.y) / std::max(-ray.y, 0.1f)) -
                                    glm::vec2(flat.x, flat.z) * (depth / -flat.y);
            // Twice the cell's area, as the cross product of its diagonals, projected along the
            // sun's rays.
            const glm::vec3 down = glm::vec3(step, 0, step) + at(i + 1, j + 1) - here;
            const glm::vec3 up = glm::vec3(step, 0, -step) + at(i + 1, j) - at(i, j + 1);
            const float area =
                0.5f * glm::dot(glm::cross(down, up), sun_in_cascade) / (sun_in_cascade.y * step * step);
            target[index_of(i, j)] = {moved / step, std::clamp(area, 0.f, 8.f)};
        }
    }

    void splat_row(int j) {
        for (int i = 0; i < caustics_side; ++i) {
            const glm::vec3 a = target[index_of(i, j)], b = target[index_of(i + 1, j)];
            const glm::vec3 c = target[index_of(i, j + 1)], d = target[index_of(i + 1, j + 1)];
            const auto light = static_cast<std::uint32_t>(std::lround(light_unit * a.z));
            for (int y = 0; y < subsamples; ++y)
                for (int x = 0; x < subsamples; ++x) {
                    const float u = (static_cast<float>(x) + 0.5f) / subsamples,
                                v = (static_cast<float>(y) + 0.5f) / subsamples;
                    const glm::vec2 moved =
                        glm::mix(glm::mix(glm::vec2(a), glm::vec2(b), u), glm::mix(glm::vec2(c), glm::vec2(d), u), v);
                    add_light(glm::vec2(static_cast<float>(i) + u, static_cast<float>(j) + v) + moved, light);
                }
        }
    }

    /// Distributes light among the four nearest texels with integer bilinear weights.
    void add_light(glm::vec2 at, std::uint32_t light) {
        // Texel centres are at half-integer coordinates.
        const auto steps = [](float value) {
            return static_cast<int>(std::floor((value - 0.5f) * weight_steps + 0.5f));
        };
        const int x = steps(at.x), y = steps(at.y);
        const int i = x >> 5, j = y >> 5;
        const auto right = static_cast<std::uint32_t>(x & 31), lower = static_cast<std::uint32_t>(y & 31);
        const auto add = [&](int column, int row, std::uint32_t weight) {
            counts[index_of(column, row)].fetch_add(light * weight, std::memory_order_relaxed);
        };
        add(i, j, (32 - right) * (32 - lower));
        add(i + 1, j, right * (32 - lower));
        add(i, j + 1, (32 - right) * lower);
        add(i + 1, j + 1, right * lower);
    }

    void blur_row(int j) {
        for (int i = 0; i < caustics_side; ++i) {
            float sum = 0;
            for (int k = -max_blur_radius; k <= max_blur_radius; ++k)
                sum += kernel[static_cast<std::size_t>(k + max_blur_radius)] *
                       static_cast<float>(counts[index_of(i + k, j)]);
            plain[index_of(i, j)] = sum;
        }
    }

    void blur_columns(int j) {
        for (int i = 0; i < caustics_side; ++i) {
            float sum = 0;
            for (int k = -max_blur_radius; k <= max_blur_radius; ++k)
                sum += kernel[static_cast<std::size_t>(k + max_blur_radius)] * plain[index_of(i, j + k)];
            blurred[index_of(i, j)] = sum;
        }
    }

    /// Divides by the mean light, which differs slightly from 1 where the surface folds, and
    /// generates the mips.
    void pack() {
        std::uint64_t all = 0;
        for (const std::uint32_t count : counts) all += count;
        const double mean = static_cast<double>(all) / (static_cast<double>(caustics_side) * caustics_side);
        making.light =
            mean / (subsamples * subsamples * static_cast<double>(light_unit) * weight_steps * weight_steps);
        making.halves.clear();
        std::vector<float> level(blurred.size());
        for (std::size_t i = 0; i < level.size(); ++i) level[i] = static_cast<float>(blurred[i] / mean);
        for (int width = caustics_side;; width /= 2) {
            for (const float value : level) making.halves.push_back(glm::packHalf1x16(value));
            if (width == 1) break;
            const int half = width / 2;
            std::vector<float> coarser;
            for (int j = 0; j < half; ++j)
                for (int i = 0; i < half; ++i) {
                    const float* const first = &level[static_cast<std::size_t>(2 * j) * width + 2 * i];
                    coarser.push_back(0.25f * (first[0] + first[1] + first[width] + first[width + 1]));
                }
            level = std::move(coarser);
        }
    }

    Caustics making, made;
    Cascade cascade;
    glm::vec3 sun_in_cascade{0, 1, 0};
    std::array<float, 2 * max_blur_radius + 1> kernel{};
    std::vector<glm::vec3> surface;  ///< displacement along, up, across
    /// xy: texels from the corner to the point where its ray meets the plane; z: light of the cell.
    std::vector<glm::vec3> target;
    std::vector<std::atomic<std::uint32_t>> counts;
    std::vector<float> plain, blurred;
    bool in_flight = false;
    JobGraph graph;
    // Declared last: its destructor waits for jobs that use the other members.
    std::unique_ptr<GraphRun> run;
};

CausticsBaker::CausticsBaker(std::shared_ptr<Executor> executor) : state_(new State(executor)) {}
CausticsBaker::~CausticsBaker() = default;

void CausticsBaker::schedule(const Frame& frame, const CausticsOptions& options) {
    assert(!state_->in_flight && "complete() the caustics in flight first");
    require(check(options));
    if (!frame.cascades.front().height.data)
        throw std::invalid_argument("caustics cannot be combined with an ocean without planes");
    state_->begin(frame, options);
    state_->run->schedule();
}

bool CausticsBaker::is_done() const { return state_->run->is_done(); }

const Caustics& CausticsBaker::complete() {
    if (state_->in_flight) {
        state_->run->complete();
        std::swap(state_->making, state_->made);
    }
    state_->in_flight = false;
    return state_->made;
}

}  // namespace pelagic::gl
