#include "pelagic/tools/encode/image_codec.hpp"

#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

/// Returns a path relative to the tool, so that a build tree or an installed tree can be moved. No
/// search path is used, which could find another library of that name.
std::filesystem::path library_path() {
    std::error_code error;
    const std::filesystem::path tool = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) throw FileError("can't find the tool's own folder: /proc/self/exe: " + error.message());
    return (tool.parent_path() / PELAGIC_MODULE_FOLDER / "pelagic_images.so").lexically_normal();
}

// Resources that OpenImageIO's dependencies need during loading, measured on Debian 12. If the
// system refuses them during loading, the process crashes or hangs, so they are requested first.
constexpr int threads_to_load = 4;
constexpr std::size_t address_space_to_load = std::size_t{448} << 20;

std::size_t usual_stack_bytes() {
    pthread_attr_t attributes;
    std::size_t bytes = 0;
    pthread_attr_init(&attributes);
    pthread_attr_getstacksize(&attributes, &bytes);
    pthread_attr_destroy(&attributes);
    return bytes;
}

/// Returns an empty text if the resources for loading are available, else the missing resource and
/// the reason.
std::string missing_resource() {
    void* reserved =
        ::mmap(nullptr, address_space_to_load, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (reserved == MAP_FAILED)
        return number_text(address_space_to_load >> 20) +
               " MiB of address space are wanted: " + std::generic_category().message(errno);
    ::munmap(reserved, address_space_to_load);
    try {
        need_threads(1 + threads_to_load, usual_stack_bytes());
    } catch (const std::system_error& error) {
        return error.what();
    }
    return {};
}

const ImageCodec& opened() {
    const std::filesystem::path file = library_path();
    const auto reject = [&](const std::string& reason) {
        throw FileError("can't load " + file.string() + ", which writes and reads images: " + reason);
    };
    if (const std::string missing = missing_resource(); !missing.empty()) reject(missing);
    // Never closed: OpenImageIO's threads and static objects live until the process ends.
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) reject(::dlerror());
    const auto* codec = static_cast<const ImageCodec*>(::dlsym(library, "pelagic_image_codec"));
    if (!codec) reject("it holds no pelagic_image_codec");
    if (std::string_view(codec->version) != PELAGIC_VERSION)
        reject("it is of version " + std::string(codec->version) + ", expected " PELAGIC_VERSION);
    return *codec;
}

}  // namespace

const ImageCodec& image_codec() {
    static const ImageCodec& codec = opened();
    return codec;
}

}  // namespace pelagic::tools
