// Hulls, read from JavaScript objects such as {vertices, triangles, massKg: 4080, xM: 5}.
#pragma once

#include <emscripten/val.h>

#include <glm/vec3.hpp>
#include <optional>

#include "pelagic/web/bindings/moored_hull.hpp"

namespace pelagic::web {

/// Converts an array [x, y, z].
glm::dvec3 vector_of(const emscripten::val& numbers);

/// Returns the hull of an object, or none for null. Names and ranges are those of floating/hull.hpp,
/// in camelCase, besides those of mesh and mooring. Throws std::invalid_argument, one line that names
/// the option, its value and what is accepted.
std::optional<MooredHull> hull_with(const emscripten::val& options);

}  // namespace pelagic::web
