// Runs every job of a frame once between marks, for instruction counts by instructions.py.
//
//   pelagic_count_jobs ISA SEA...    a sea is CASCADESxN, 1x256 or 3x128
//
// Names are sea/job; items are texels, and points of queries; blocks are those of all cascades.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/bench/instructions/count_marks.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tools/benchmark/stage_work.hpp"

namespace pelagic {
namespace {

struct Cascades {
    int count, resolution;
};

Cascades cascades_of(const std::string& sea) {
    Cascades cascades{};
    char rest = 0;
    if (std::sscanf(sea.c_str(), "%dx%d%c", &cascades.count, &cascades.resolution, &rest) != 2)
        throw std::invalid_argument("SEA is " + sea + ", expected cascades and their resolution, as in 3x128");
    return cascades;
}

SeaState sea_of(Cascades cascades) {
    if (cascades.count == 1) return {.resolution = cascades.resolution, .patch_size_m = 250};
    return {.cascades = cascades.count, .resolution = cascades.resolution};
}

void count_queries(const std::string& sea, const Frame& frame) {
    constexpr std::size_t points = 4096;
    std::mt19937 random(1);
    const double side_m = frame.cascades[0].grid.side_m;
    std::vector<double> x(points), z(points);
    for (std::vector<double>* const axis : {&x, &z})
        for (double& at : *axis) at = side_m * 3 * (static_cast<double>(random()) / 4294967296.0) - side_m;
    std::vector<std::vector<float>> out(4, std::vector<float>(points));
    const SurfaceQuery query(frame);
    bench::counted(sea + "/query height", points, [&] { query.sample({x, z}, {.height_m = out[0]}); });
    bench::counted(sea + "/query height, normal", points, [&] {
        query.sample({x, z}, {.height_m = out[0], .normal_x = out[1], .normal_y = out[2], .normal_z = out[3]});
    });
}

/// Counts the jobs of a sea. Jobs run again on the data of the last frame, because their work does
/// not depend on the values.
void count_jobs(const std::string& sea, Isa isa) {
    const Cascades cascades = cascades_of(sea);
    Ocean ocean(sea_of(cascades), {.executor = make_serial_executor(), .isa = isa, .queries = true});
    const double texels = static_cast<double>(cascades.count) * cascades.resolution * cascades.resolution;
    ocean.frame_at(0.5);
    std::vector<std::pair<std::string, std::vector<const Stage*>>> jobs;  // in the frame's order
    for (const Stage& stage : ocean.graph().stages()) {
        const std::string name(tools::job_of(stage.name));
        const auto is_it = [&name](const auto& job) { return job.first == name; };
        const auto known = std::find_if(jobs.begin(), jobs.end(), is_it);
        (known == jobs.end() ? jobs.emplace_back(name, std::vector<const Stage*>()) : *known)
            .second.push_back(&stage);
    }
    for (const auto& job : jobs) {
        std::size_t blocks = 0;
        for (const Stage* const stage : job.second) blocks += block_count(*stage);
        const auto run_all = [&job] {
            for (const Stage* const stage : job.second)
                for (std::size_t block = 0; block < block_count(*stage); ++block) run_block(*stage, block);
        };
        bench::counted(sea + "/" + job.first, texels, run_all, blocks);
    }
    count_queries(sea, ocean.frame_at(1));
    Ocean plain(sea_of(cascades), {.executor = make_serial_executor(), .isa = isa});
    plain.frame_at(0.5);
    plain.frame_at(0.75);
    bench::counted(sea + "/frame", texels, [&] { plain.frame_at(1); });
    Ocean textures(sea_of(cascades), {.executor = make_serial_executor(), .isa = isa, .planes = false});
    textures.frame_at(0.5);
    textures.frame_at(0.75);
    bench::counted(sea + "/textures only", texels, [&] { textures.frame_at(1); });
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    try {
        if (argc < 3)
            throw std::invalid_argument("needs an instruction set and seas: pelagic_count_jobs avx2 1x256 3x128");
        const pelagic::Isa isa = pelagic::choose_isa(pelagic::isa_named(argv[1]));
        std::printf("compiler\t%s\n", PELAGIC_COMPILER);
        for (int i = 2; i < argc; ++i) pelagic::count_jobs(argv[i], isa);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pelagic_count_jobs: %s\n", error.what());
        return 2;
    }
}
