// Reads a sea.json of random bytes as the record of an earlier export.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pelagic/tests/fuzz/fuzzed_record.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    pelagic::read_back(pelagic::tools::parse_sea_json, {reinterpret_cast<const char*>(data), size});
    return 0;
}
