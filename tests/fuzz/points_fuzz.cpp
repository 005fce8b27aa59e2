// Points files of random bytes, in reads of random lengths: the points equal those of another
// reader, or a one-line error is thrown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "pelagic/tests/fuzz/fuzz.hpp"
#include "pelagic/tools/query/points_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace {

void check_block(const pelagic::tools::PointReader& reader, const pelagic::tools::PointBlock& block) {
    pelagic::must(block.size() > 0 && block.z.size() == block.size() && block.row_ends.size() == block.size());
    std::vector<std::string_view> cells;
    for (std::size_t i = 0; i < block.size(); ++i) {
        pelagic::must(std::fabs(block.x[i]) <= 1e15 && std::fabs(block.z[i]) <= 1e15);
        pelagic::must(block.row(i).find('\n') == std::string_view::npos);
        pelagic::tools::split_cells(block.row(i), cells);
        pelagic::must(cells.size() == reader.columns().size());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    // The first byte sets the number of bytes of a read and the number of points of a block.
    const std::size_t step = 1 + data[0] % 16, max_points = 1 + data[0] / 16;
    std::size_t at = 1;
    pelagic::tools::PointReader reader("points.csv", [&](std::span<char> bytes) {
        std::size_t count = size - at < step ? size - at : step;
        if (bytes.size() < count) count = bytes.size();
        std::memcpy(bytes.data(), data + at, count);
        at += count;
        return count;
    });
    try {
        pelagic::tools::PointBlock block;
        while (reader.read_block(block, max_points)) check_block(reader, block);
    } catch (const pelagic::tools::InputError& error) {
        pelagic::must_be_a_line_about("points.csv", error.what());
    }
    return 0;
}
