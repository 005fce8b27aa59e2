#include "pelagic/tools/files/zstd.hpp"

#include <stdexcept>
#include <string>

#include "pelagic/tools/text/errors.hpp"

#ifdef PELAGIC_HAS_ZSTD
#include <zstd.h>
#endif

namespace pelagic::tools {

#ifdef PELAGIC_HAS_ZSTD

bool has_zstd() { return true; }

std::vector<unsigned char> zstd_frame(std::span<const unsigned char> bytes) {
    std::vector<unsigned char> frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size =
        ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT);
    if (ZSTD_isError(size)) throw FileError(std::string("libzstd can't compress: ") + ZSTD_getErrorName(size));
    frame.resize(size);
    return frame;
}

std::vector<unsigned char> zstd_content(std::span<const unsigned char> frame, std::size_t size) {
    std::vector<unsigned char> bytes(size);
    const std::size_t got = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
    if (ZSTD_isError(got))
        throw std::runtime_error(std::string("libzstd can't decompress: ") + ZSTD_getErrorName(got));
    if (got != size) throw std::runtime_error("its Zstandard frame is too short");
    return bytes;
}

#else

bool has_zstd() { return false; }

std::vector<unsigned char> zstd_content(std::span<const unsigned char>, std::size_t) {
    throw FileError("this pelagic was built without libzstd, which decompresses KTX2");
}

std::vector<unsigned char> zstd_frame(std::span<const unsigned char>) {
    throw FileError("this pelagic was built without libzstd, which compresses KTX2");
}

#endif

}  // namespace pelagic::tools
