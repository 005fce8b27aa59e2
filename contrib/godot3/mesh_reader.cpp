#include "pelagic/contrib/godot3/mesh_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/contrib/godot3/close_seams.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::godot {
namespace {

// Constants of Mesh.
constexpr int vertex_array = 0, index_array = 8;
constexpr std::int64_t primitive_triangles = 4;

const Method is_class("Object", "is_class");
const Method get_surface_count("Mesh", "get_surface_count"), surface_get_arrays("Mesh", "surface_get_arrays");
const Method surface_get_primitive_type("ArrayMesh", "surface_get_primitive_type");

bool is_a(Object* object, const char* class_name) { return is_class.on<bool>(object, Text(class_name).string()); }

/// The arrays of a surface.
class Surface {
   public:
    Surface(Object* mesh, std::int64_t number) : arrays_(surface_get_arrays.on<Array>(mesh, number)) {}
    ~Surface() { call(core::array_destroy, &arrays_); }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// Returns an array, or nil if the surface has none of that number.
    Value array(int number) const {
        if (number >= call(core::array_size, &arrays_)) return Value();
        Variant variant = call(core::array_get, &arrays_, number);
        Value copy(variant);
        call(core::variant_destroy, &variant);
        return copy;
    }

   private:
    alignas(8) Array arrays_;
};

VariantType type_of(const Value& value) { return call(core::variant_get_type, &value.variant()); }

struct Corners {
    std::vector<glm::dvec3> vertices_m;
    std::vector<std::uint32_t> numbers;  ///< of the vertices, three for each triangle
};

void append(const Surface& surface, Corners& corners) {
    const std::size_t first = corners.vertices_m.size();
    const Value vertices = surface.array(vertex_array), indices = surface.array(index_array);
    if (type_of(vertices) != type_pool_vector3_array) return;
    const PoolElements<Vector3> positions(vertices.variant());
    for (const Vector3& at : positions.all()) corners.vertices_m.emplace_back(at.x, at.y, at.z);
    const auto append_number = [&](std::size_t number) {
        corners.numbers.push_back(static_cast<std::uint32_t>(first + number));
    };
    if (type_of(indices) == type_pool_int_array) {
        const PoolElements<int> elements(indices.variant());
        for (const int number : elements.all()) append_number(static_cast<std::size_t>(number));
    } else {
        for (std::size_t i = 0; i < positions.all().size(); ++i) append_number(i);
    }
}

}  // namespace

HullMesh hull_mesh_of(const Variant& mesh) {
    Object* const object = call(core::variant_as_object, &mesh);
    if (!object || !is_a(object, "Mesh"))
        throw std::invalid_argument(invalid_value_message("mesh", Text(mesh).utf8(), "a Mesh"));
    const auto surfaces = get_surface_count.on<std::int64_t>(object);
    const bool has_types = is_a(object, "ArrayMesh");
    Corners corners;
    for (std::int64_t i = 0; i < surfaces; ++i) {
        const std::size_t before = corners.numbers.size();
        const bool is_right =
            !has_types || surface_get_primitive_type.on<std::int64_t>(object, i) == primitive_triangles;
        if (is_right) append(Surface(object, i), corners);
        if (!is_right || (corners.numbers.size() - before) % 3 != 0)
            throw std::invalid_argument("surface " + std::to_string(i) +
                                        " of the mesh has other primitives, expected PRIMITIVE_TRIANGLES");
    }
    const std::vector<std::uint32_t>& numbers = corners.numbers;
    require(HullMesh::check_counts(corners.vertices_m.size(), numbers.size() / 3));
    std::vector<HullMesh::Triangle> triangles;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        triangles.push_back({numbers[i], numbers[i + 2], numbers[i + 1]});
    close_seams(corners.vertices_m);
    return HullMesh(corners.vertices_m, triangles);
}

}  // namespace pelagic::godot
