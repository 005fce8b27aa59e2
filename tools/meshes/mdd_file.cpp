#include "pelagic/tools/meshes/mdd_file.hpp"

#include <cstdint>

namespace pelagic::tools {

void append_mdd_header(Bytes& bytes, std::span<const float> times_s, std::size_t points) {
    append_big_endian(bytes, static_cast<std::int32_t>(times_s.size()));
    append_big_endian(bytes, static_cast<std::int32_t>(points));
    for (const float time_s : times_s) append_big_endian(bytes, time_s);
}

void append_mdd_frame(Bytes& bytes, const Mesh& mesh) {
    for (const glm::vec3 position : mesh.positions)
        for (const float metres : {position.x, position.y, position.z}) append_big_endian(bytes, metres);
}

}  // namespace pelagic::tools
