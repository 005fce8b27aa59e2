// Reader of glTF 2.0. Every size, offset and index is checked before use.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/meshes/hull_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {
namespace {

using GltfJson = nlohmann::json;

/// Limits of the JSON. An exporter's files have about ten levels, and ten values a node.
constexpr int max_json_levels = 32;
constexpr std::size_t max_json_values = 200'000;

// OpenGL's constants, which glTF uses.
constexpr std::uint64_t component_unsigned_byte = 5121, component_unsigned_short = 5123,
                        component_unsigned_int = 5125, component_float = 5126, mode_triangles = 4;

std::span<const unsigned char> unsigned_bytes(std::string_view text) {
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

std::uint32_t little_endian_word_at(std::string_view bytes, std::size_t offset) {
    return little_endian<std::uint32_t>(unsigned_bytes(bytes.substr(offset, 4)));
}

/// Decodes base64 (RFC 4648). Returns none for other characters.
std::optional<std::string> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos) return {};
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 255);
    }
    return bytes;
}

/// Replaces each %41 by its character. Returns none for an invalid one.
std::optional<std::string> decode_percent(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        unsigned value = 0;
        const std::string_view digits = uri.substr(i + 1, 2);
        if (digits.size() < 2 ||
            std::from_chars(digits.data(), digits.data() + 2, value, 16).ptr != digits.data() + 2)
            return {};
        text += static_cast<char>(value);
        i += 2;
    }
    return text;
}

/// Returns true for a relative path that stays in its folder or below.
bool is_inside(const std::string& path) {
    if (path.empty() || path.find_first_of(std::string_view(":\\\0", 3)) != std::string::npos) return false;
    const std::filesystem::path relative = path_of(path);
    for (const auto& element : relative)
        if (element == path_of("..")) return false;
    return relative.is_relative();
}

/// An object of the file, and its name in messages.
struct Element {
    const GltfJson& json;
    std::string name;
};

/// Elements of an accessor.
struct Elements {
    std::string_view bytes;  ///< from the first element
    std::size_t count = 0, stride = 0;
    std::uint64_t component = 0;

    template <class Number>
    Number at(std::size_t element, std::size_t index = 0) const {
        return little_endian<Number>(
            unsigned_bytes(bytes.substr(element * stride + index * sizeof(Number), sizeof(Number))));
    }
    std::uint32_t index_at(std::size_t element) const {
        if (component == component_unsigned_byte) return at<std::uint8_t>(element);
        if (component == component_unsigned_short) return at<std::uint16_t>(element);
        return at<std::uint32_t>(element);
    }
};

class GltfReader {
   public:
    GltfReader(const std::filesystem::path& file, std::string_view bytes)
        : file_(file), name_(file.string()), root_{json_, "glTF"} {
        parse(bytes.starts_with("glTF") ? json_chunk(bytes) : bytes);
    }

    HullFile read() {
        const GltfJson& asset = member(root_, "asset");
        const GltfJson& version = member({asset, "asset"}, "version");
        if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2."))
            reject("asset.version is " + version.dump().substr(0, 40) + ", expected 2.0");
        if (const auto required = root_.json.find("extensionsRequired"); required != root_.json.end())
            reject("extensionsRequired is " + required->dump().substr(0, 80) +
                   ", expected a file without extensions");
        const Element scene = element("scenes", whole(root_, "scene", 0));
        std::vector<std::pair<std::uint64_t, glm::dmat4>> remaining;
        append_nodes(scene, "nodes", glm::dmat4(1), remaining);
        while (!remaining.empty()) {
            const auto [number, parent] = remaining.back();
            remaining.pop_back();
            take_node(element("nodes", number), parent, remaining);
        }
        if (hull_.triangles.empty()) reject("the scene has no triangles");
        return std::move(hull_);
    }

   private:
    [[noreturn]] void reject(const std::string& reason) const { throw InputError(name_ + ": " + reason); }

    /// Returns the JSON of a binary file, and keeps its binary chunk.
    std::string_view json_chunk(std::string_view bytes) {
        const auto chunk = [&](std::string_view type) -> std::string_view {
            if (bytes.size() < 8 || bytes.substr(4, 4) != type) return {};
            const std::size_t size = little_endian_word_at(bytes, 0);
            if (size > bytes.size() - 8) reject("a chunk has fewer bytes than it states");
            const std::string_view content = bytes.substr(8, size);
            bytes.remove_prefix(8 + size);
            return content;
        };
        if (bytes.size() < 12 || little_endian_word_at(bytes, 4) != 2 ||
            little_endian_word_at(bytes, 8) > bytes.size())
            reject("the header is that of another version or of a longer file, expected binary glTF 2.0");
        bytes = bytes.substr(0, little_endian_word_at(bytes, 8));
        bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 12));
        const std::string_view json = chunk("JSON");
        if (json.empty()) reject("the first chunk is not JSON");
        binary_chunk_ = chunk(std::string_view("BIN\0", 4));
        return json;
    }

    void parse(std::string_view text) {
        std::size_t values = 0;
        const auto limit = [&](int depth, GltfJson::parse_event_t, GltfJson&) {
            if (depth > max_json_levels) reject("JSON has more than " + number_text(max_json_levels) + " levels");
            if (++values > max_json_values) reject("JSON has more than " + number_text(max_json_values) + " values");
            return true;
        };
        try {
            json_ = GltfJson::parse(text, limit);
        } catch (const GltfJson::parse_error& error) {
            reject("JSON is invalid at byte " + number_text(error.byte));
        } catch (const GltfJson::exception&) {
            reject("JSON has a number that is too large");
        }
        if (!json_.is_object()) reject("JSON is no object");
    }

    const GltfJson& member(const Element& object, const char* key) const {
        if (!object.json.is_object()) reject(object.name + " is no object");
        const auto found = object.json.find(key);
        if (found == object.json.end()) reject(object.name + "." + key + " is missing");
        return *found;
    }
    bool has(const Element& object, const char* key) const {
        return object.json.is_object() && object.json.contains(key);
    }

    std::uint64_t whole(const Element& object, const char* key) const {
        return as_whole(member(object, key), object.name + "." + key);
    }
    std::uint64_t whole(const Element& object, const char* key, std::uint64_t absent) const {
        return has(object, key) ? whole(object, key) : absent;
    }
    std::uint64_t as_whole(const GltfJson& value, const std::string& name) const {
        constexpr std::uint64_t largest = 0xffffffff;
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > largest)
            reject(name + " is " + value.dump().substr(0, 40) + ", expected a whole number");
        return value.get<std::uint64_t>();
    }

    const GltfJson& array(const Element& object, const char* key) const {
        const GltfJson& list = member(object, key);
        if (!list.is_array()) reject(object.name + "." + key + " is no array");
        return list;
    }

    /// Returns an element of one of the file's arrays.
    Element element(const char* list_name, std::uint64_t number) const {
        const GltfJson& list = array(root_, list_name);
        const std::string name = std::string(list_name) + "[" + number_text(number) + "]";
        if (number >= list.size()) reject(name + " does not exist");
        return {list[static_cast<std::size_t>(number)], name};
    }

    /// Returns numbers of a node, or `absent`.
    template <std::size_t Count>
    std::array<double, Count> numbers(const Element& object, const char* key,
                                      std::array<double, Count> absent) const {
        if (!has(object, key)) return absent;
        const GltfJson& list = array(object, key);
        bool is_valid = list.size() == Count;
        for (std::size_t i = 0; i < Count && is_valid; ++i) {
            is_valid = list[i].is_number();
            if (is_valid) absent[i] = list[i].template get<double>();
        }
        if (!is_valid) reject(object.name + "." + key + " is no list of " + number_text(Count) + " numbers");
        return absent;
    }

    glm::dmat4 transform_of(const Element& node) const {
        constexpr std::array<double, 16> identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        const std::array<double, 16> columns = numbers<16>(node, "matrix", identity);
        glm::dmat4 matrix(1);
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = columns[static_cast<std::size_t>(i)];
        const auto move = numbers<3>(node, "translation", {0, 0, 0}), size = numbers<3>(node, "scale", {1, 1, 1});
        const auto turn = numbers<4>(node, "rotation", {0, 0, 0, 1});
        const glm::dquat rotation(turn[3], turn[0], turn[1], turn[2]);
        if (!(glm::dot(rotation, rotation) > 0)) reject(node.name + ".rotation is zero, expected a unit quaternion");
        matrix = glm::translate(matrix, glm::dvec3(move[0], move[1], move[2]));
        matrix *= glm::mat4_cast(glm::normalize(rotation));
        return glm::scale(matrix, glm::dvec3(size[0], size[1], size[2]));
    }

    void append_nodes(const Element& object, const char* key, const glm::dmat4& parent,
                      std::vector<std::pair<std::uint64_t, glm::dmat4>>& nodes) {
        if (!has(object, key)) return;
        visited_.resize(array(root_, "nodes").size());
        for (const GltfJson& value : array(object, key)) {
            const std::uint64_t number = as_whole(value, object.name + "." + key);
            const Element node = element("nodes", number);
            if (visited_[static_cast<std::size_t>(number)]) reject(node.name + " has two parents, expected a tree");
            visited_[static_cast<std::size_t>(number)] = true;
            nodes.emplace_back(number, parent);
        }
    }

    void take_node(const Element& node, const glm::dmat4& parent,
                   std::vector<std::pair<std::uint64_t, glm::dmat4>>& remaining) {
        const glm::dmat4 world = parent * transform_of(node);
        append_nodes(node, "children", world, remaining);
        if (!has(node, "mesh")) return;
        if (has(node, "skin")) reject(node.name + " has a skin, expected a rigid mesh");
        const Element mesh = element("meshes", whole(node, "mesh"));
        std::size_t number = 0;
        for (const GltfJson& primitive : array(mesh, "primitives"))
            take_primitive({primitive, mesh.name + ".primitives[" + number_text(number++) + "]"}, world);
    }

    void take_primitive(const Element& primitive, const glm::dmat4& world) {
        if (const std::uint64_t mode = whole(primitive, "mode", mode_triangles); mode != mode_triangles)
            reject(primitive.name + ".mode is " + number_text(mode) + ", expected 4, triangles");
        const GltfJson& attributes = member(primitive, "attributes");
        const Elements positions =
            elements(whole({attributes, primitive.name + ".attributes"}, "POSITION"), "VEC3", {component_float});
        std::optional<Elements> indices;
        if (has(primitive, "indices"))
            indices = elements(whole(primitive, "indices"), "SCALAR",
                               {component_unsigned_byte, component_unsigned_short, component_unsigned_int});
        const std::size_t corners = indices ? indices->count : positions.count;
        if (corners % 3 != 0)
            reject(primitive.name + " has " + number_text(corners) + " corners, expected triangles");
        if (corners / 3 > HullMesh::max_triangles - hull_.triangles.size())
            reject("the hull has more than " + number_text(HullMesh::max_triangles) + " triangles");
        const bool is_mirrored = glm::determinant(glm::dmat3(world)) < 0;  // reverses the winding
        std::map<std::uint32_t, std::uint32_t> vertices;                   // of the hull, by index
        for (std::size_t corner = 0; corner < corners; corner += 3) {
            HullMesh::Triangle triangle;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t index =
                    indices ? indices->index_at(corner + i) : static_cast<std::uint32_t>(corner + i);
                if (index >= positions.count)
                    reject(primitive.name + " has index " + number_text(index) + ", expected less than " +
                           number_text(positions.count));
                const auto [place, is_new] =
                    vertices.try_emplace(index, static_cast<std::uint32_t>(hull_.vertices.size()));
                if (is_new) {
                    const glm::dvec4 at(positions.at<float>(index, 0), positions.at<float>(index, 1),
                                        positions.at<float>(index, 2), 1);
                    hull_.vertices.emplace_back(world * at);
                }
                triangle[i] = place->second;
            }
            if (is_mirrored) std::swap(triangle[1], triangle[2]);
            hull_.triangles.push_back(triangle);
        }
    }

    Elements elements(std::uint64_t number, std::string_view type, std::initializer_list<std::uint64_t> components) {
        const Element accessor = element("accessors", number);
        if (has(accessor, "sparse")) reject(accessor.name + " is sparse, expected values in a buffer");
        if (member(accessor, "type") != GltfJson(type)) reject(accessor.name + ".type is not " + std::string(type));
        Elements values;
        values.component = whole(accessor, "componentType");
        if (std::find(components.begin(), components.end(), values.component) == components.end())
            reject(accessor.name + ".componentType is " + number_text(values.component) +
                   ", expected float for positions, and unsigned integers for indices");
        const std::uint64_t count = whole(accessor, "count"), offset = whole(accessor, "byteOffset", 0);
        const std::uint64_t component_bytes = values.component == component_unsigned_byte    ? 1
                                              : values.component == component_unsigned_short ? 2
                                                                                             : 4;
        const std::uint64_t bytes = component_bytes * (type == "VEC3" ? 3 : 1);

        const Element view = element("bufferViews", whole(accessor, "bufferView"));
        const std::uint64_t stride = whole(view, "byteStride", bytes);
        if (stride < bytes || stride > 252)
            reject(view.name + ".byteStride " + number_text(stride) + " is out of range [" + number_text(bytes) +
                   ", 252]");
        const std::uint64_t view_offset = whole(view, "byteOffset", 0), view_bytes = whole(view, "byteLength");
        const std::string_view buffer = buffer_bytes(whole(view, "buffer"));
        if (view_offset + view_bytes > buffer.size()) reject(view.name + " reaches past the end of its buffer");
        if (count == 0 || offset + (count - 1) * stride + bytes > view_bytes)
            reject(accessor.name + " is empty or reaches past the end of " + view.name);
        values.bytes = buffer.substr(static_cast<std::size_t>(view_offset + offset));
        values.count = static_cast<std::size_t>(count);
        values.stride = static_cast<std::size_t>(stride);
        return values;
    }

    std::string_view buffer_bytes(std::uint64_t number) {
        if (const auto read = buffers_.find(number); read != buffers_.end()) return read->second;
        const Element buffer = element("buffers", number);
        const std::uint64_t bytes = whole(buffer, "byteLength");
        std::string content;
        if (has(buffer, "uri"))
            content = content_of(buffer);
        else if (number == 0)
            content = binary_chunk_;
        if (content.size() < bytes)
            reject(buffer.name + " has " + number_text(content.size()) + " bytes, expected " + number_text(bytes));
        buffers_bytes_ += content.size();
        if (buffers_bytes_ > HullFile::max_buffer_bytes)
            reject("the buffers have more than " + number_text(HullFile::max_buffer_bytes >> 20) + " MiB");
        return buffers_.emplace(number, std::move(content)).first->second;
    }

    std::string content_of(const Element& buffer) const {
        const GltfJson& uri = member(buffer, "uri");
        if (!uri.is_string()) reject(buffer.name + ".uri is no text");
        const std::string& text = uri.get_ref<const std::string&>();
        if (text.starts_with("data:")) {
            constexpr std::string_view begin = ";base64,";
            const std::size_t at = text.find(begin);
            auto content = at == std::string::npos ? std::optional<std::string>()
                                                   : decode_base64(std::string_view(text).substr(at + begin.size()));
            if (!content) reject(buffer.name + ".uri is a data URI, but not in base64");
            return std::move(*content);
        }
        const std::optional<std::string> path = decode_percent(text);
        if (!path || !is_inside(*path) || leads_elsewhere(*path))
            reject(buffer.name + ".uri is " + text.substr(0, 80) + ", expected a file in the folder of " + name_);
        return InputFile(name_ + ": " + buffer.name + ".uri", file_.parent_path() / *path, "a file of the buffer")
            .read_all(HullFile::max_bytes);
    }

    /// Returns true if links lead out of the folder, or to a pipe or device, whose reading may never
    /// end. InputFile names the reason for a file that does not exist.
    bool leads_elsewhere(const std::string& path) const {
        std::error_code error;
        const std::filesystem::path folder = std::filesystem::canonical(file_.parent_path() / ".", error);
        const std::filesystem::path buffer = std::filesystem::canonical(file_.parent_path() / path, error);
        if (error) return false;
        const bool is_below =
            std::mismatch(folder.begin(), folder.end(), buffer.begin(), buffer.end()).first == folder.end();
        return !is_below || !std::filesystem::is_regular_file(buffer, error);
    }

    const std::filesystem::path& file_;
    std::string name_;
    GltfJson json_;
    Element root_;
    std::string_view binary_chunk_;
    std::map<std::uint64_t, std::string> buffers_;  ///< those that were read
    std::size_t buffers_bytes_ = 0;
    std::vector<bool> visited_;  ///< nodes
    HullFile hull_;
};

}  // namespace

HullFile parse_gltf_hull(const std::filesystem::path& file, std::string_view bytes) {
    return GltfReader(file, bytes).read();
}

}  // namespace pelagic::tools
