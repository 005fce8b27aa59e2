// Hull files of random bytes: a mesh whose triangles have vertices, or a one-line error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pelagic/tests/fuzz/fuzz.hpp"
#include "pelagic/tools/meshes/hull_file.hpp"
#include "pelagic/tools/text/errors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pelagic::tools;
    using pelagic::must;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const bool is_obj = size > 0 && data[0] != '{' && data[0] != 'g';
    try {
        const HullFile hull = is_obj ? parse_obj_hull("hull", bytes) : parse_gltf_hull("hull", bytes);
        must(!hull.triangles.empty() && hull.triangles.size() <= pelagic::HullMesh::max_triangles);
        for (const auto& triangle : hull.triangles)
            for (const std::uint32_t vertex : triangle) must(vertex < hull.vertices.size());
        pelagic::HullMesh::check(hull.vertices, hull.triangles);
    } catch (const InputError& error) {
        const std::string_view what = error.what();
        must(what.starts_with("hull") && what.find('\n') == std::string_view::npos);
    }
    return 0;
}
