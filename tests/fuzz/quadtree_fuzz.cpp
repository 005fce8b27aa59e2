// Options, viewers and views of random bytes: the result is a valid draw list or a one-line error.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pelagic/quadtree/selection.hpp"
#include "pelagic/tests/fuzz/fuzz.hpp"

namespace {

class Bytes : public pelagic::FuzzBytes {
   public:
    using FuzzBytes::FuzzBytes;

    /// Returns mostly 0 to 254, sometimes any 31 bits.
    int whole() {
        const auto byte = take<std::uint8_t>();
        return byte == 255 ? take<std::int32_t>() / 2 : byte;
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    pelagic::QuadtreeOptions options{.size_m = bytes.number(256, 8192),
                                     .vertices = bytes.whole(),
                                     .lod_scale = bytes.number(0.75, 8),
                                     .cull_scale = bytes.number(1, 4)};
    if (const int limit = bytes.whole() - 2; limit != 0) options.batch_limit = limit;
    const bool is_usable = pelagic::check(options).empty();
    try {
        pelagic::Selection selection(options);
        pelagic::must(is_usable);
        for (int frame = 0; frame < 3; ++frame) {
            const glm::dvec3 viewer(bytes.number(-1e4, 1e4), bytes.number(-10, 1e3), bytes.number(-1e4, 1e4));
            std::vector<glm::dmat4> views(bytes.take<std::uint8_t>() % 3, glm::dmat4(1));
            for (glm::dmat4& view : views)
                for (int i = 0; i < 16; ++i) view[i / 4][i % 4] = bytes.number(-2, 2);
            const pelagic::DrawList& list = selection.select({.viewer_m = viewer, .views = views});
            std::size_t drawn = 0;
            for (const pelagic::DrawBatch& batch : list.batches) {
                pelagic::must(batch.stitches < 16 && batch.count > 0 && batch.first == drawn);
                pelagic::must(!options.batch_limit || batch.count <= static_cast<std::uint32_t>(*options.batch_limit));
                drawn += batch.count;
            }
            pelagic::must(drawn == list.instances.size());
        }
    } catch (const std::invalid_argument& error) {
        const std::string_view what = error.what();
        pelagic::must(!what.empty() && what.size() < 300 && what.find('\n') == std::string_view::npos);
    }
    return 0;
}
