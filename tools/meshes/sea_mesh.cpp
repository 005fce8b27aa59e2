#include "pelagic/tools/meshes/sea_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <tuple>
#include <vector>

#include "pelagic/quadtree/patch_mesh.hpp"
#include "pelagic/quadtree/patch_vertex.hpp"
#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

/// From the coarsest level to the finest: dark blue to yellow, as in the colour map viridis, which
/// is also legible in grey.
constexpr std::array<const char*, 9> level_colours = {"#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187",
                                                      "#4ac16d", "#a0da39", "#d0e11c", "#fde725"};

constexpr double plan_side = 1000;  ///< side of the square in SVG units

template <class... Values>
std::string plan_text(const char* format, Values... values) {
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

using PatchKey = std::tuple<int, int, int>;
PatchKey key(const PatchInstance& patch) { return {patch.level, patch.corner_x, patch.corner_z}; }

/// Returns the polygon of the plane y = 0 that a view sees in the square: the square clipped by the
/// view's planes.
std::vector<glm::dvec2> footprint(const Frustum& view, glm::dvec2 low, glm::dvec2 high) {
    std::vector<glm::dvec2> polygon = {low, {high.x, low.y}, high, {low.x, high.y}}, cut;
    for (const glm::dvec4& plane : view.planes) {
        const auto inside = [&](glm::dvec2 p) { return plane.x * p.x + plane.z * p.y + plane.w; };
        cut.clear();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const glm::dvec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
            const double da = inside(a), db = inside(b);
            if (da >= 0) cut.push_back(a);
            if ((da >= 0) != (db >= 0)) cut.push_back(a + (b - a) * (da / (da - db)));
        }
        polygon.swap(cut);
    }
    return polygon;
}

}  // namespace

std::size_t cascades_shown_by(double step_m, std::span<const CascadePlan> plans) {
    const auto is_shown = [&](const CascadePlan& plan) {
        return 3 * plan.grid.side_m / plan.resolution >= 2 * step_m;
    };
    std::size_t count = 1;
    while (count < plans.size() && is_shown(plans[count])) ++count;
    return count;
}

glm::vec2 texture_coordinates_of(const Cascade& coarsest, glm::dvec2 rest) {
    const CascadeGrid::Vector place = coarsest.grid.in_cascade(rest.x, rest.y);
    const double side_m = coarsest.grid.side_m;
    const double half_m = coarsest.texel_m() / 2;  // from a texel's corner to its centre
    return glm::dvec2((place.along + half_m) / side_m, 1 - (place.across + half_m) / side_m);
}

Mesh mesh_of(const Frame& frame, const SeaPatch& patch) {
    Frame shown = frame;
    shown.cascades = frame.cascades.first(patch.cascades);
    const auto drawn = [&](glm::dvec2 rest) {
        const Displacement d = displacement_of(shown, rest.x, rest.y);
        return glm::dvec3(rest.x + d.dx, d.height, rest.y + d.dz);
    };
    const double reach_m = std::max(patch.side_m / patch.steps, shown.cascades.back().texel_m());
    const FoamSampler foam(frame);

    const auto row = static_cast<std::uint32_t>(patch.steps) + 1;
    Mesh mesh;
    mesh.corners = 4;
    mesh.positions.reserve(std::size_t{row} * row);
    mesh.normals.reserve(std::size_t{row} * row);
    mesh.texture_coordinates.reserve(std::size_t{row} * row);
    mesh.faces.reserve(std::size_t{row - 1} * (row - 1) * mesh.corners);
    for (int j = 0; j <= patch.steps; ++j) {
        for (int i = 0; i <= patch.steps; ++i) {
            const glm::dvec2 rest(i * patch.side_m / patch.steps, j * patch.side_m / patch.steps);
            mesh.positions.push_back(drawn(rest));
            mesh.normals.emplace_back(normal_at(rest, reach_m, drawn));
            mesh.texture_coordinates.push_back(texture_coordinates_of(frame.cascades.front(), rest));
            if (foam.has_foam()) mesh.foam.push_back(foam.at(rest.x, rest.y));
        }
    }
    for (std::uint32_t j = 0; j + 1 < row; ++j)
        for (std::uint32_t i = 0; i + 1 < row; ++i)
            for (const std::uint32_t corner :
                 {j * row + i, (j + 1) * row + i, (j + 1) * row + i + 1, j * row + i + 1})
                mesh.faces.push_back(corner);
    return mesh;
}

Mesh mesh_of(const DrawList& list, const Frame& frame) {
    const QuadtreeGrid& grid = list.grid;
    const PatchMesh patch_mesh(grid.vertices);
    const auto displacement = [&](glm::dvec2 rest) {
        const Displacement d = displacement_of(frame, rest.x, rest.y);
        return glm::dvec3(d.dx, d.height, d.dz);
    };
    // The displaced position without morphing, which is equal for every patch that shares the
    // vertex.
    const auto drawn = [&](glm::dvec2 rest) {
        const double fade = border_fade(grid, rest);
        return glm::dvec3(rest.x, 0, rest.y) + (fade > 0 ? displacement(rest) * fade : glm::dvec3(0));
    };
    const FoamSampler foam(frame);
    Mesh mesh;
    std::vector<std::uint32_t> number_of(patch_mesh.positions.size());
    for (const DrawBatch& batch : list.batches) {
        const PatchMesh::Range range = patch_mesh.ranges[batch.stitches];
        const auto first = patch_mesh.indices.begin() + range.first;
        std::vector<bool> is_used(patch_mesh.positions.size(), false);  // stitching skips vertices
        std::for_each(first, first + range.count, [&](std::uint16_t index) { is_used[index] = true; });
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            const PatchInstance& patch = list.instances[i];
            for (std::size_t v = 0; v < patch_mesh.positions.size(); ++v) {
                if (!is_used[v]) continue;
                number_of[v] = static_cast<std::uint32_t>(mesh.positions.size());
                const PatchMesh::Vertex at = patch_mesh.positions[v];
                const glm::dvec2 rest = rest_position(grid, patch, at.i, at.j);
                mesh.positions.push_back(patch_vertex(grid, patch, at.i, at.j, displacement));
                mesh.normals.emplace_back(normal_at(rest, frame.cascades[0].texel_m(), drawn));
                mesh.texture_coordinates.push_back(texture_coordinates_of(frame.cascades[0], rest));
                if (foam.has_foam())
                    mesh.foam.push_back(static_cast<float>(double{foam.at(rest.x, rest.y)} * border_fade(grid, rest)));
            }
            for (auto index = first; index != first + range.count; ++index) mesh.faces.push_back(number_of[*index]);
        }
    }
    return mesh;
}

std::string plan_as_svg(const DrawList& drawn, const DrawList& all, std::span<const Frustum> views,
                        glm::dvec3 viewer_m) {
    const QuadtreeGrid& grid = drawn.grid;
    const glm::dvec2 low = glm::dvec2(grid.corner) * grid.step_m, high = low + grid.size_m();
    const double scale = plan_side / grid.size_m();
    const auto to_plan = [&](glm::dvec2 p) { return (p - low) * scale; };

    std::string svg = plan_text(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-20 -20 %g %g\" font-family=\"sans-serif\" "
        "font-size=\"18\">\n<rect x=\"-20\" y=\"-20\" width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
        plan_side + 300, plan_side + 40);

    std::set<PatchKey> is_drawn;
    for (const PatchInstance& patch : drawn.instances) is_drawn.insert(key(patch));
    for (const PatchInstance& patch : all.instances) {
        const glm::dvec2 corner = to_plan(rest_position(grid, patch, 0, 0));
        const double side = grid.patch_size_m(patch.level) * scale;
        svg += plan_text(
            "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\" fill-opacity=\"%s\" "
            "stroke=\"black\" stroke-width=\"0.7\"/>\n",
            corner.x, corner.y, side, side, level_colours[patch.level], is_drawn.contains(key(patch)) ? "1" : "0.18");
    }
    for (const Frustum& view : views) {
        const std::vector<glm::dvec2> seen = footprint(view, low, high);
        if (seen.empty()) continue;
        svg += "<polygon points=\"";
        for (const glm::dvec2 p : seen) svg += plan_text("%.2f,%.2f ", to_plan(p).x, to_plan(p).y);
        svg += "\" fill=\"none\" stroke=\"#d62728\" stroke-width=\"3\"/>\n";
    }
    const glm::dvec2 viewer = to_plan({viewer_m.x, viewer_m.z});
    if (viewer.x >= 0 && viewer.y >= 0 && viewer.x <= plan_side && viewer.y <= plan_side)
        svg += plan_text(
            "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"6\" fill=\"#d62728\" stroke=\"white\" stroke-width=\"2\"/>\n",
            viewer.x, viewer.y);

    double y = 20;
    const double x = plan_side + 20;
    const auto text = [&](const std::string& words) {
        svg += plan_text("<text x=\"%g\" y=\"%g\">%s</text>\n", x, y, words.c_str());
        y += 30;
    };
    text(number_text(grid.size_m()) + " m, x right, z down");
    for (int level = 0; level <= grid.deepest_level; ++level) {
        const auto at = static_cast<std::size_t>(level);
        if (all.statistics.patches_by_level[at] == 0) continue;
        svg += plan_text("<rect x=\"%g\" y=\"%g\" width=\"18\" height=\"18\" fill=\"%s\"/>\n", x, y - 15,
                         level_colours[at]);
        svg += plan_text("<text x=\"%g\" y=\"%g\">level %d: %u of %u</text>\n", x + 26, y, level,
                         drawn.statistics.patches_by_level[at], all.statistics.patches_by_level[at]);
        y += 30;
    }
    if (!views.empty()) text("red: seen at y = 0");
    return svg + "</svg>\n";
}

}  // namespace pelagic::tools
