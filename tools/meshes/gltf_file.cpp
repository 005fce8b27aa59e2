#include "pelagic/tools/meshes/gltf_file.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pelagic::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

// OpenGL's constants, which glTF uses.
constexpr int a_byte = 5120, an_unsigned_byte = 5121, an_unsigned_int = 5125, a_float = 5126;
constexpr int array_buffer = 34962, element_array_buffer = 34963;

const char* type_of(std::size_t width) {
    constexpr const char* names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return names[width - 1];
}

void append(std::vector<float>& numbers, const glm::vec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); }

/// Returns the components of `to` - `from`.
template <class Vector>
std::vector<float> differences(const std::vector<Vector>& from, const std::vector<Vector>& to) {
    std::vector<float> numbers;
    for (std::size_t v = 0; v < to.size(); ++v) append(numbers, glm::vec3(to[v]) - glm::vec3(from[v]));
    return numbers;
}

/// Quantises a number from [-1, 1] to a signed byte, rounded to nearest.
std::int8_t signed_byte_of(float number) {
    const float scaled = number * 127;
    return static_cast<std::int8_t>(scaled < 0 ? scaled - 0.5f : scaled + 0.5f);
}

/// Returns a dielectric material with the roughness of water seen from near. With foam, the base
/// colour is foam's, because vertex colours can only darken it. Without foam, it is the dark blue
/// of deep water.
OrderedJson water(bool has_foam) {
    const OrderedJson colour = has_foam ? OrderedJson{0.85, 0.88, 0.9, 1} : OrderedJson{0.004, 0.022, 0.035, 1};
    return {{"name", "water"},
            {"pbrMetallicRoughness", {{"baseColorFactor", colour}, {"metallicFactor", 0}, {"roughnessFactor", 0.15}}},
            {"doubleSided", true}};
}

template <class Content>
void append_chunk(Bytes& file, std::string_view type, const Content& bytes) {
    append_little_endian(file, static_cast<std::uint32_t>(bytes.size()));
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), bytes.begin(), bytes.end());
}

}  // namespace

GlbFile::GlbFile(const Mesh& first, std::size_t frames) : first_(first) {
    buffer_.reserve(buffer_bytes(first.positions.size(), first.face_count() * (first.corners - 2), frames));
    std::vector<float> positions, normals, texture_coordinates;
    for (const glm::vec3 position : first.positions) append(positions, position);
    for (const glm::vec3& normal : first.normals) append(normals, normal);
    for (const glm::vec2& uv : first.texture_coordinates)
        // glTF's v starts at the upper edge.
        texture_coordinates.insert(texture_coordinates.end(), {uv.x, 1 - uv.y});
    attributes_ = {{"POSITION", add_floats(positions, 3, Bounds::min_and_max)},
                   {"NORMAL", add_floats(normals, 3, Bounds::none)},
                   {"TEXCOORD_0", add_floats(texture_coordinates, 2, Bounds::none)}};
    if (first.foam.empty()) return;
    std::vector<std::uint8_t> greys;
    for (const float foam : first.foam) greys.push_back(grey_of(foam));
    attributes_["COLOR_0"] = add_greys<std::uint8_t>(greys);
    attributes_["_FOAM"] = add_floats(first.foam, 1, Bounds::none);
}

void GlbFile::add(const Mesh& mesh) {
    assert(mesh.positions.size() == first_.positions.size() && mesh.foam.size() == first_.foam.size());
    OrderedJson target = {
        {"POSITION", add_floats(differences(first_.positions, mesh.positions), 3, Bounds::min_and_max)},
        {"NORMAL", add_floats(differences(first_.normals, mesh.normals), 3, Bounds::none)}};
    if (!mesh.foam.empty()) {
        std::vector<std::int8_t> greys;
        for (std::size_t v = 0; v < mesh.foam.size(); ++v)
            greys.push_back(signed_byte_of(mesh.foam[v] - first_.foam[v]));
        target["COLOR_0"] = add_greys<std::int8_t>(greys);
    }
    targets_.push_back(target);
}

Bytes GlbFile::finish(double fps, bool closes) {
    const std::size_t indices = add_triangles();
    OrderedJson primitive = {{"attributes", attributes_}, {"indices", indices}, {"material", 0}};
    OrderedJson mesh = {{"name", "sea"}};
    if (!targets_.empty()) {
        primitive["targets"] = targets_;
        mesh["weights"] = std::vector<int>(targets_.size(), 0);
    }
    mesh["primitives"] = OrderedJson::array({primitive});
    OrderedJson json = {{"asset", {{"version", "2.0"}, {"generator", "Pelagic " PELAGIC_VERSION}}},
                        {"scene", 0},
                        {"scenes", {{{"nodes", {0}}}}},
                        {"nodes", {{{"name", "sea"}, {"mesh", 0}}}},
                        {"meshes", OrderedJson::array({mesh})},
                        {"materials", OrderedJson::array({water(!first_.foam.empty())})}};
    if (!targets_.empty()) json["animations"] = OrderedJson::array({animation(fps, closes)});
    json["accessors"] = accessors_;
    json["bufferViews"] = views_;
    json["buffers"] = {{{"byteLength", buffer_.size()}}};

    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t size = 12 + 8 + text.size() + 8 + buffer_.size();
    Bytes file = {'g', 'l', 'T', 'F'};
    file.reserve(size);
    append_little_endian(file, std::uint32_t{2});  // the version
    append_little_endian(file, static_cast<std::uint32_t>(size));
    append_chunk(file, "JSON", text);
    append_chunk(file, std::string_view("BIN\0", 4), buffer_);
    return file;
}

OrderedJson GlbFile::animation(double fps, bool closes) {
    const std::size_t targets = targets_.size(), keys = targets + 1 + (closes ? 1 : 0);
    std::vector<float> times_s, weights(keys * targets, 0);
    for (std::size_t key = 0; key < keys; ++key) {
        times_s.push_back(static_cast<float>(static_cast<double>(key) / fps));
        // The first frame has no target.
        if (key > 0 && key <= targets) weights[key * targets + key - 1] = 1;
    }
    const std::size_t input = add_floats(times_s, 1, Bounds::min_and_max);
    const std::size_t output = add_floats(weights, 1, Bounds::none);
    // Times and weights are not vertex data.
    for (const std::size_t accessor : {input, output}) views_[accessor].erase("target");
    return {{"name", "waves"},
            {"samplers", {{{"input", input}, {"interpolation", "LINEAR"}, {"output", output}}}},
            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}};
}

std::size_t GlbFile::add_accessor(std::size_t begin, std::size_t count, const char* type, int component) {
    views_.push_back({{"buffer", 0},
                      {"byteOffset", begin},
                      {"byteLength", buffer_.size() - begin},
                      {"target", component == an_unsigned_int ? element_array_buffer : array_buffer}});
    accessors_.push_back(
        {{"bufferView", views_.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors_.size() - 1;
}

std::size_t GlbFile::add_floats(std::span<const float> numbers, std::size_t width, Bounds bounds) {
    const std::size_t begin = buffer_.size();
    for (const float number : numbers) append_little_endian(buffer_, number);
    const std::size_t accessor = add_accessor(begin, numbers.size() / width, type_of(width), a_float);
    if (bounds == Bounds::none) return accessor;
    std::vector<float> min(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(width)), max = min;
    for (std::size_t at = 0; at < numbers.size(); ++at) {
        min[at % width] = std::min(min[at % width], numbers[at]);
        max[at % width] = std::max(max[at % width], numbers[at]);
    }
    accessors_[accessor]["min"] = min;
    accessors_[accessor]["max"] = max;
    return accessor;
}

template <class Byte>
std::size_t GlbFile::add_greys(std::span<const Byte> greys) {
    constexpr bool is_difference = std::is_signed_v<Byte>;
    const std::size_t begin = buffer_.size();
    for (const Byte grey : greys) {
        for (int colour = 0; colour < 3; ++colour) append_little_endian(buffer_, grey);
        append_little_endian(buffer_, is_difference ? Byte{0} : static_cast<Byte>(255));  // opaque
    }
    const std::size_t accessor = add_accessor(begin, greys.size(), "VEC4", is_difference ? a_byte : an_unsigned_byte);
    accessors_[accessor]["normalized"] = true;
    return accessor;
}

std::size_t GlbFile::add_triangles() {
    const std::size_t begin = buffer_.size();
    for (std::size_t at = 0; at < first_.faces.size(); at += first_.corners)
        for (std::size_t third = 2; third < first_.corners; ++third)
            for (const std::size_t corner : {std::size_t{0}, third - 1, third})
                append_little_endian(buffer_, first_.faces[at + corner]);
    return add_accessor(begin, (buffer_.size() - begin) / 4, "SCALAR", an_unsigned_int);
}

std::size_t GlbFile::buffer_bytes(std::size_t vertices, std::size_t triangles, std::size_t frames) {
    const std::size_t first = vertices * (12 + 12 + 8 + 4 + 4), target = vertices * (12 + 12 + 4);
    const std::size_t keys = frames + 1;
    return first + triangles * 12 + (frames - 1) * target + keys * 4 + keys * (frames - 1) * 4;
}

}  // namespace pelagic::tools
