#include "pelagic/tools/preview/shaded_sea.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "pelagic/sim/query/foam_sampler.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/tools/preview/cascade_levels.hpp"
#include "pelagic/tools/preview/sea_light.hpp"

namespace pelagic::tools {
namespace {

/// Samples of a pixel along each axis.
constexpr int fineness = 2;
/// Extension of the grid of reference points beyond the image, because displacement moves points
/// across its edges.
constexpr float margin_aside = 1.3f, margin_below = 1.5f;
// 40 and 12 degrees.
constexpr double vertical_view_turns = 40. / 360, down_turns = 12. / 360;
/// Angle of the view to the wind's origin (25 degrees) and of the sun to the view (20 degrees),
/// both to the right; the sun's elevation (30 degrees).
constexpr double view_aside_turns = 25. / 360, sun_aside_turns = 20. / 360, sun_up_turns = 30. / 360;
/// Distances in peak wavelengths: of the last row of reference points, and at which haze halves the
/// contrast.
constexpr float farthest = 120, hazy = 50;

/// Returns the horizontal unit vector of an azimuth. det::SineCosine keeps it bit-identical on
/// every machine.
glm::vec3 horizontal(const det::SineCosine& azimuth) {
    return {static_cast<float>(azimuth.cosine), 0, static_cast<float>(azimuth.sine)};
}

}  // namespace

struct ShadedSea::State {
    struct View {
        glm::vec3 eye{0}, forward{0}, right{0}, up{0};
        float tangent = 0;  ///< tangent of half the vertical field of view
        float aspect = 1;

        /// Returns the direction of an image position, of length 1 along `forward`.
        /// \param at  -1 to 1 in the image, x to the right, y up
        glm::vec3 ray(glm::vec2 at) const { return forward + tangent * (aspect * at.x * right + at.y * up); }

        struct Seen {
            glm::vec2 at;
            float depth;
        };
        Seen seen(const glm::vec3& point) const {
            const glm::vec3 away = point - eye;
            const float depth = glm::dot(away, forward);
            const float scale = 1 / (tangent * depth);
            return {{glm::dot(away, right) * scale / aspect, glm::dot(away, up) * scale}, depth};
        }
    };

    /// A reference point at its displaced position.
    struct GridPoint {
        glm::vec2 pixel{0};  ///< in samples from the upper left corner
        /// Infinite for points behind the eye, which are not drawn.
        float depth = std::numeric_limits<float>::infinity();
        glm::vec3 light{0};
    };

    /// Vertical extent of one row of reference points in the image. A band of the image skips rows
    /// outside of it.
    struct Extent {
        float top = std::numeric_limits<float>::infinity(), bottom = -std::numeric_limits<float>::infinity();
    };

    State(const SeaState& sea, int width, int height, std::shared_ptr<Executor> executor_to_use);

    void place_row(std::size_t row);
    GridPoint point_at(const glm::vec2& at) const;
    void draw_band(std::size_t band);
    void draw_quad(std::size_t row, std::size_t column, int first_line, int end_line);
    void resolve_line(std::size_t line);

    static constexpr int lines_a_band = 16;

    int width, height, columns, rows;
    float wavelength_m, wave_height_m;
    View view;
    glm::vec3 to_sun{0};
    float horizon_at = 0;  ///< vertical image position of the farthest row, see View::ray()

    Frame frame;
    float hidden_slope_variance = 0;
    std::vector<CascadeLevels> cascades;
    std::optional<FoamSampler> foam;  ///< of the frame that is drawn
    std::vector<GridPoint> grid;
    std::vector<Extent> extents;
    std::vector<glm::vec3> samples;
    std::vector<float> depths;
    std::vector<std::uint8_t> pixels;

    std::shared_ptr<Executor> executor;
    JobGraph graph;
    std::unique_ptr<GraphRun> run;
};

ShadedSea::State::State(const SeaState& sea, int image_width, int image_height,
                        std::shared_ptr<Executor> executor_to_use)
    : width(image_width), height(image_height), executor(std::move(executor_to_use)) {
    assert(width >= 2 && height >= 2);
    const ExpectedWaves waves = expected_waves(sea);
    wave_height_m = static_cast<float>(std::max(waves.significant_wave_height_m, 1e-3));
    wavelength_m = static_cast<float>(std::max(waves.peak_wavelength_m, 1e-2));
    const double wind_turns = sea.wind_direction_rad / two_pi;
    const auto ahead = horizontal(det::sine_cosine_of_turns(wind_turns + 0.5 + view_aside_turns));
    const det::SineCosine down = det::sine_cosine_of_turns(down_turns),
                          half_view = det::sine_cosine_of_turns(vertical_view_turns / 2);
    const auto cosine = static_cast<float>(down.cosine), sine = static_cast<float>(down.sine);
    view.eye = {0, 0.1f * wavelength_m + 1.1f * wave_height_m, 0};
    view.forward = {cosine * ahead.x, -sine, cosine * ahead.z};
    view.right = {-ahead.z, 0, ahead.x};
    view.up = glm::cross(view.right, view.forward);
    view.tangent = static_cast<float>(half_view.sine / half_view.cosine);
    view.aspect = static_cast<float>(width) / static_cast<float>(height);
    horizon_at = view.seen(view.eye + farthest * wavelength_m * ahead - glm::vec3(0, view.eye.y, 0)).at.y;
    const det::SineCosine sun_up = det::sine_cosine_of_turns(sun_up_turns);
    to_sun = static_cast<float>(sun_up.cosine) *
             horizontal(det::sine_cosine_of_turns(wind_turns + 0.5 + view_aside_turns + sun_aside_turns));
    to_sun.y = static_cast<float>(sun_up.sine);

    columns = static_cast<int>(margin_aside * static_cast<float>(width));
    rows = static_cast<int>(margin_below * static_cast<float>(height));
    grid.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    extents.resize(static_cast<std::size_t>(rows));
    const auto sample_count =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * fineness * fineness;
    samples.resize(sample_count);
    depths.resize(sample_count);
    pixels.resize(sample_count / (fineness * fineness) * 4);

    const auto bands = static_cast<std::size_t>((height * fineness + lines_a_band - 1) / lines_a_band);
    const StageId placed = graph.add({.name = "reference points",
                                      .count = extents.size(),
                                      .batch = 8,
                                      .body = [this](std::size_t begin, std::size_t end) {
                                          for (std::size_t row = begin; row < end; ++row) place_row(row);
                                      }});
    const StageId drawn = graph.add({.name = "surface",
                                     .count = bands,
                                     .waits_for = {placed},
                                     .body = [this](std::size_t begin, std::size_t end) {
                                         for (std::size_t band = begin; band < end; ++band) draw_band(band);
                                     }});
    graph.add({.name = "pixels",
               .count = static_cast<std::size_t>(height),
               .batch = 16,
               .waits_for = {drawn},
               .body = [this](std::size_t begin, std::size_t end) {
                   for (std::size_t line = begin; line < end; ++line) resolve_line(line);
               }});
    run = executor->prepare(graph);
}

void ShadedSea::State::place_row(std::size_t row) {
    Extent extent;
    const float down = static_cast<float>(row) / static_cast<float>(rows - 1);
    const float y = horizon_at + down * ((1 - 2 * margin_below) - horizon_at);
    for (int column = 0; column < columns; ++column) {
        const float aside = 2 * static_cast<float>(column) / static_cast<float>(columns - 1) - 1;
        GridPoint& point = grid[row * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
        point = point_at({margin_aside * aside, y});
        if (std::isinf(point.depth)) continue;
        extent.top = std::min(extent.top, point.pixel.y);
        extent.bottom = std::max(extent.bottom, point.pixel.y);
    }
    extents[row] = extent;
}

auto ShadedSea::State::point_at(const glm::vec2& at) const -> GridPoint {
    const glm::vec3 ray = view.ray(at);
    const glm::vec3 rest = view.eye + view.eye.y / -ray.y * ray;
    const float distance = glm::length(rest - view.eye);
    const float pixel_m = 2 * view.tangent / static_cast<float>(height) * distance;
    // The footprint of a pixel is longer than wide. The geometric mean of both balances aliasing
    // and blur.
    const float footprint_m = pixel_m * std::sqrt(distance / view.eye.y);

    glm::vec3 place = rest;
    SurfaceSlopes slopes;
    for (const CascadeLevels& cascade : cascades) {
        const CascadeSample sample =
            cascade.at(static_cast<double>(rest.x), static_cast<double>(rest.z), footprint_m);
        place += sample.displacement;
        slopes += sample.slopes;
    }
    const View::Seen seen = view.seen(place);
    GridPoint point;
    if (seen.depth <= 0.01f * view.eye.y) return point;
    point.pixel = {0.5f * (1 + seen.at.x) * static_cast<float>(fineness * width),
                   0.5f * (1 - seen.at.y) * static_cast<float>(fineness * height)};
    point.depth = seen.depth;
    const SurfaceNormal normal = normal_of(slopes);
    // An overturned surface shows its lower side, with foam.
    const glm::vec3 upward(normal.x, std::max(normal.y, 0.05), normal.z);
    point.light = water_light(
        {.normal = glm::normalize(upward),
         .to_eye = glm::normalize(view.eye - place),
         .slope_variance = hidden_slope_variance + 0.5f * static_cast<float>(slopes.var_xx + slopes.var_zz),
         .foam = foam->at(static_cast<double>(rest.x), static_cast<double>(rest.z)),
         .height = place.y / wave_height_m,
         .distance = distance / (hazy * wavelength_m)},
        to_sun);
    return point;
}

void ShadedSea::State::draw_band(std::size_t band) {
    const int first = static_cast<int>(band) * lines_a_band, end = std::min(first + lines_a_band, height * fineness);
    const auto line_samples = static_cast<std::size_t>(width * fineness);
    for (int line = first; line < end; ++line) {
        const float y = 1 - (2 * static_cast<float>(line) + 1) / static_cast<float>(height * fineness);
        for (std::size_t i = 0; i < line_samples; ++i) {
            const float x = (2 * static_cast<float>(i) + 1) / static_cast<float>(line_samples) - 1;
            const std::size_t sample = static_cast<std::size_t>(line) * line_samples + i;
            samples[sample] = sky_light(glm::normalize(view.ray({x, y})), to_sun);
            depths[sample] = std::numeric_limits<float>::infinity();
        }
    }
    for (std::size_t row = 0; row + 1 < extents.size(); ++row) {
        const float top = std::min(extents[row].top, extents[row + 1].top);
        const float bottom = std::max(extents[row].bottom, extents[row + 1].bottom);
        if (bottom < static_cast<float>(first) || top > static_cast<float>(end)) continue;
        for (std::size_t column = 0; column + 1 < static_cast<std::size_t>(columns); ++column)
            draw_quad(row, column, first, end);
    }
}

/// Draws two triangles. A sample is covered if its centre is inside a triangle or on its edge, so
/// that no gaps occur.
void ShadedSea::State::draw_quad(std::size_t row, std::size_t column, int first_line, int end_line) {
    const GridPoint* const upper = &grid[row * static_cast<std::size_t>(columns) + column];
    const GridPoint* const lower = upper + columns;
    const int samples_a_line = width * fineness;
    const auto triangle = [&](const GridPoint& a, const GridPoint& b, const GridPoint& c) {
        const float doubled_area =
            (b.pixel.x - a.pixel.x) * (c.pixel.y - a.pixel.y) - (b.pixel.y - a.pixel.y) * (c.pixel.x - a.pixel.x);
        if (doubled_area == 0) return;
        const int left = std::max(0, static_cast<int>(std::floor(std::min({a.pixel.x, b.pixel.x, c.pixel.x}))));
        const int right = std::min(samples_a_line - 1, static_cast<int>(std::max({a.pixel.x, b.pixel.x, c.pixel.x})));
        const int top =
            std::max(first_line, static_cast<int>(std::floor(std::min({a.pixel.y, b.pixel.y, c.pixel.y}))));
        const int bottom = std::min(end_line - 1, static_cast<int>(std::max({a.pixel.y, b.pixel.y, c.pixel.y})));
        for (int line = top; line <= bottom; ++line)
            for (int i = left; i <= right; ++i) {
                const glm::vec2 at(static_cast<float>(i) + 0.5f, static_cast<float>(line) + 0.5f);
                const auto weight = [&](const GridPoint& from, const GridPoint& to) {
                    return ((to.pixel.x - from.pixel.x) * (at.y - from.pixel.y) -
                            (to.pixel.y - from.pixel.y) * (at.x - from.pixel.x)) /
                           doubled_area;
                };
                const float of_a = weight(b, c), of_b = weight(c, a), of_c = weight(a, b);
                if (of_a < 0 || of_b < 0 || of_c < 0) continue;
                const float depth = of_a * a.depth + of_b * b.depth + of_c * c.depth;
                const auto sample = static_cast<std::size_t>(line * samples_a_line + i);
                if (depth >= depths[sample]) continue;
                depths[sample] = depth;
                samples[sample] = of_a * a.light + of_b * b.light + of_c * c.light;
            }
    };
    for (const GridPoint* point : {upper, upper + 1, lower, lower + 1})
        if (std::isinf(point->depth)) return;
    triangle(upper[0], upper[1], lower[0]);
    triangle(lower[0], upper[1], lower[1]);
}

void ShadedSea::State::resolve_line(std::size_t line) {
    const auto samples_a_line = static_cast<std::size_t>(width) * fineness;
    for (std::size_t i = 0; i < static_cast<std::size_t>(width); ++i) {
        glm::ivec3 sum(0);
        for (std::size_t y = 0; y < fineness; ++y)
            for (std::size_t x = 0; x < fineness; ++x)
                sum += glm::ivec3(screen_colour(samples[(line * fineness + y) * samples_a_line + i * fineness + x]));
        std::uint8_t* const pixel = &pixels[4 * (line * static_cast<std::size_t>(width) + i)];
        constexpr int all = fineness * fineness;
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = static_cast<std::uint8_t>((sum[channel] + all / 2) / all);
        pixel[3] = 255;
    }
}

ShadedSea::ShadedSea(const SeaState& sea, int width, int height, std::shared_ptr<Executor> executor)
    : state_(std::make_unique<State>(sea, width, height, std::move(executor))) {}
ShadedSea::~ShadedSea() = default;

int ShadedSea::width() const { return state_->width; }
int ShadedSea::height() const { return state_->height; }

const std::vector<std::uint8_t>& ShadedSea::draw(const Frame& frame) {
    state_->hidden_slope_variance = static_cast<float>(frame.statistics.unresolved_slopes.total() / 2);
    state_->cascades.resize(frame.cascades.size());
    for (std::size_t cascade = 0; cascade < frame.cascades.size(); ++cascade)
        state_->cascades[cascade].take(frame.cascades[cascade]);
    state_->foam.emplace(frame);
    state_->run->schedule();
    state_->run->complete();
    return state_->pixels;
}

}  // namespace pelagic::tools
