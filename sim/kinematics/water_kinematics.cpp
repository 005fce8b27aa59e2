#include "pelagic/sim/water_kinematics.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {

WaterKinematics::WaterKinematics(double water_density_kgpm3, double time_s)
    : time_s_(time_s), water_density_kgpm3_(water_density_kgpm3) {
    if (!(water_density_kgpm3 >= 500 && water_density_kgpm3 <= 2000))
        throw std::invalid_argument(invalid_value_message("water_density_kgpm3", water_density_kgpm3, "[500, 2000]"));
}

void require_footprint(double footprint_m) {
    if (!(footprint_m >= 0 && std::isfinite(footprint_m)))
        throw std::invalid_argument(invalid_value_message("footprint_m", footprint_m, "0 or more"));
}

void WaterKinematics::require_valid(const WaterPoints& points, const WaterSamples& samples) const {
    const std::size_t count = points.x.size();
    const auto need = [count](const char* name, std::size_t size, const char* else_accepted) {
        if (size != count)
            throw std::invalid_argument(std::string(name) + " has " + number_text(size) + " elements, expected " +
                                        number_text(count) + else_accepted);
    };
    need("y", points.y.size(), ", as x has");
    need("z", points.z.size(), ", as x has");
    for (const auto& [name, values] :
         {std::pair("depth_m", samples.depth_m), std::pair("pressure_pa", samples.pressure_pa),
          std::pair("velocity_x_mps", samples.velocity_x_mps), std::pair("velocity_y_mps", samples.velocity_y_mps),
          std::pair("velocity_z_mps", samples.velocity_z_mps),
          std::pair("acceleration_x_mps2", samples.acceleration_x_mps2),
          std::pair("acceleration_y_mps2", samples.acceleration_y_mps2),
          std::pair("acceleration_z_mps2", samples.acceleration_z_mps2)})
        if (!values.empty()) need(name, values.size(), " or none");
    require_footprint(points.footprint_m);
    const double lowest_m = floor_m();
    for (std::size_t i = 0; i < count; ++i)
        if (points.y[i] < lowest_m && std::isfinite(points.y[i]))
            throw std::invalid_argument(invalid_value_message("y[" + number_text(i) + "]", points.y[i],
                                                              "at least " + number_text(lowest_m) + ", the sea floor"));
}

}  // namespace pelagic
