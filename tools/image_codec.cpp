#include "pelagic/tools/image_codec.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <string_view>

#include "pelagic/tools/errors.hpp"

namespace pelagic::tools {
namespace {

/// Relative to the tool itself, so that a build tree and an installed one can be moved: no search path, by which another
/// library of that name could be found.
std::filesystem::path library_path() {
    std::error_code error;
    const std::filesystem::path tool = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) throw FileError("can't find the tool's own folder: /proc/self/exe: " + error.message());
    return (tool.parent_path() / PELAGIC_MODULE_FOLDER / "pelagic_images.so").lexically_normal();
}

const ImageCodec& opened() {
    const std::filesystem::path file = library_path();
    const auto refuse = [&](const std::string& reason) {
        throw FileError("can't load " + file.string() + ", which writes images: " + reason);
    };
    // Never closed: OpenImageIO's threads and static objects live to the end.
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) refuse(::dlerror());
    const auto* codec = static_cast<const ImageCodec*>(::dlsym(library, "pelagic_image_codec"));
    if (!codec) refuse("it holds no pelagic_image_codec");
    if (std::string_view(codec->version) != PELAGIC_VERSION)
        refuse("it is of version " + std::string(codec->version) + ", needs " PELAGIC_VERSION);
    return *codec;
}

}  // namespace

const ImageCodec& image_codec() {
    static const ImageCodec& codec = opened();
    return codec;
}

}  // namespace pelagic::tools
