#include "pelagic/web/bindings/hull_options.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/web/bindings/named_options.hpp"

namespace pelagic::web {
namespace {

using emscripten::val;

bool is_finite(double number) { return std::isfinite(number); }

HullMesh mesh_of(const val& options) {
    for (const char* name : {"vertices", "triangles"})
        if (options[name].isUndefined() || options[name].isNull())
            throw std::invalid_argument(std::string("hull has no ") + name + ", expected an array of numbers");
    const auto numbers = emscripten::convertJSArrayToNumberVector<double>(options["vertices"]);
    const auto indices = emscripten::convertJSArrayToNumberVector<std::uint32_t>(options["triangles"]);
    std::vector<glm::dvec3> vertices;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        vertices.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    std::vector<HullMesh::Triangle> triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    return HullMesh(vertices, triangles);
}

/// Returns the target of a number of the mooring, or null.
double* number_of_mooring(Mooring& mooring, const std::string& name) {
    return name == "xM"               ? &mooring.x_m
           : name == "zM"             ? &mooring.z_m
           : name == "headingRad"     ? &mooring.heading_rad
           : name == "mooringPeriodS" ? &mooring.period_s
                                      : nullptr;
}

void set_number(HullOptions& hull, const std::string& name, const val& value) {
    std::vector<std::string> known = {"vertices", "triangles", "centreOfMassM", "xM", "zM", "headingRad",
                                      "mooringPeriodS"};
    for (const NumericField<HullOptions>& field : hull_fields()) {
        known.push_back(camel_case(field.name));
        if (known.back() == name) return set_field(hull, field, name, value);
    }
    reject_name(name, known);
}

}  // namespace

glm::dvec3 vector_of(const val& numbers) {
    return {numbers[0].as<double>(), numbers[1].as<double>(), numbers[2].as<double>()};
}

std::optional<MooredHull> hull_with(const val& options) {
    if (options.isNull()) return {};
    if (!is_object(options))
        throw std::invalid_argument(invalid_value_message("hull", text_of(options), "an object or null"));
    HullOptions hull;
    Mooring mooring;
    for (const std::string& name : keys_of(options)) {
        const val value = options[name.c_str()];
        if (name == "vertices" || name == "triangles") continue;
        if (name == "centreOfMassM")
            hull.centre_of_mass_m = vector_of(value);
        else if (double* number = number_of_mooring(mooring, name))
            *number = number_of(name, value, is_finite, "a finite number");
        else
            set_number(hull, name, value);
    }
    return MooredHull(Hull(mesh_of(options), hull), mooring);
}

}  // namespace pelagic::web
