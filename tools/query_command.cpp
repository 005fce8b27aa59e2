#include "pelagic/tools/query_command.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/option_text.hpp"
#include "pelagic/tools/points_file.hpp"

namespace pelagic::tools {
namespace {

constexpr double latest_time_s = 1e9;  // as `export --start`

/// The shortest digits that read back as the same number.
template <class Number>
void append(std::string& line, Number value) {
    std::array<char, 32> text;
    if (!line.empty()) line += ',';
    line.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

}  // namespace

void QueryFlags::add_to(CLI::App& app) {
    app.add_option("--points", points_, "where to look: lines x,z in metres; a first line x,z is skipped")
        ->type_name("FILE.csv");
    app.add_option("--time", time_, "in seconds; [-1e9, 1e9], default 0")->type_name("NUMBER");
    sea_.add_to(app);
    compute_.add_to(app);
    app.footer(
        "Prints x,z,height,nx,ny,nz,vx,vy,vz,jacobian,error_m,converged: metres, metres a second, the normal as a\n"
        "unit vector, how far the sampled point is from the one asked for, and whether that is within a millimetre.");
}

void QueryFlags::run() const {
    const ResolvedSea sea = sea_.resolve();
    const ComputeOptions compute = compute_.resolve();
    const std::optional<double> time_s = parse_number(time_.value_or("0"));
    if (!time_s || *time_s < -latest_time_s || *time_s > latest_time_s)
        throw bad_value("--time", *time_, "seconds in [-1e9, 1e9]");
    if (!points_ || points_->empty()) throw InputError("--points is missing, needs a CSV file of lines x,z");
    const PointList points = read_points(*points_);

    const auto executor = make_default_executor(compute.threads);
    Ocean ocean(sea.sea, {.executor = executor, .isa = compute.isa, .queries = true, .velocities = true});
    const SurfaceQuery query(ocean.frame_at(*time_s));
    const std::size_t count = points.x.size();
    std::array<std::vector<float>, 9> out;
    for (std::vector<float>& values : out) values.resize(count);
    auto& [height, nx, ny, nz, vx, vy, vz, jacobian, error_m] = out;
    std::vector<std::uint8_t> converged(count);
    SurfaceQueryJobs(executor).sample(query, {points.x, points.z},
                                      {.height_m = height,
                                       .normal_x = nx,
                                       .normal_y = ny,
                                       .normal_z = nz,
                                       .jacobian = jacobian,
                                       .velocity_x_mps = vx,
                                       .velocity_y_mps = vy,
                                       .velocity_z_mps = vz,
                                       .error_m = error_m,
                                       .converged = converged});

    std::printf("x,z,height,nx,ny,nz,vx,vy,vz,jacobian,error_m,converged\n");
    std::string line;
    for (std::size_t i = 0; i < count; ++i) {
        line.clear();
        append(line, points.x[i]);
        append(line, points.z[i]);
        for (const std::vector<float>& values : out) append(line, values[i]);
        std::printf("%s,%d\n", line.c_str(), converged[i]);
    }
}

}  // namespace pelagic::tools
