#include "pelagic/tools/encode/codec_library.hpp"

#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/encode/exr_codec.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

/// A library that exports a table of functions, whose first member is `const char* version`.
struct CodecLibrary {
    const char* file;   ///< without a folder
    const char* use;    ///< completes "FILE, which ..." in messages
    const char* table;  ///< name of the exported table
    /// Threads and bytes of address space that the dependencies need during loading, measured on
    /// Debian 12. If the system refuses them then, the process may crash or hang, so they are
    /// requested first.
    int threads;
    std::size_t address_space;
};

constexpr CodecLibrary image_library = {.file = "pelagic_images.so",
                                        .use = "writes and reads images",
                                        .table = "pelagic_image_codec",
                                        .threads = 4,
                                        .address_space = std::size_t{448} << 20};
constexpr CodecLibrary exr_library = {.file = "pelagic_exr.so",
                                      .use = "writes EXR files",
                                      .table = "pelagic_exr_codec",
                                      .threads = 0,
                                      .address_space = std::size_t{16} << 20};

/// Returns a path relative to the tool, so that a build tree or an installed tree can be moved. No
/// search path is used, which could find another library of that name.
std::filesystem::path path_of(const CodecLibrary& library) {
    std::error_code error;
    const std::filesystem::path tool = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) throw FileError("can't find the tool's own folder: /proc/self/exe: " + error.message());
    return (tool.parent_path() / PELAGIC_MODULE_FOLDER / library.file).lexically_normal();
}

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
std::string missing_resource(const CodecLibrary& library) {
    void* reserved =
        ::mmap(nullptr, library.address_space, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (reserved == MAP_FAILED)
        return number_text(library.address_space >> 20) +
               " MiB of address space are wanted: " + std::generic_category().message(errno);
    ::munmap(reserved, library.address_space);
    try {
        if (library.threads > 0) need_threads(1 + library.threads, usual_stack_bytes());
    } catch (const std::system_error& error) {
        return error.what();
    }
    return {};
}

/// Loads the library and returns its table. Throws FileError that names the file.
const void* load_table(const CodecLibrary& library) {
    const std::filesystem::path file = path_of(library);
    const auto reject = [&](const std::string& reason) {
        throw FileError("can't load " + file.string() + ", which " + library.use + ": " + reason);
    };
    if (const std::string missing = missing_resource(library); !missing.empty()) reject(missing);
    // Never closed: threads and static objects of dependencies live until the process ends.
    void* opened = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!opened) reject(::dlerror());
    const void* table = ::dlsym(opened, library.table);
    if (!table) reject(std::string("it holds no ") + library.table);
    const char* version = *static_cast<const char* const*>(table);
    if (std::string_view(version) != PELAGIC_VERSION)
        reject("it is of version " + std::string(version) + ", expected " PELAGIC_VERSION);
    return table;
}

}  // namespace

const ImageCodec& image_codec() {
    static const auto& codec = *static_cast<const ImageCodec*>(load_table(image_library));
    return codec;
}

const ExrCodec& exr_codec() {
    static const auto& codec = *static_cast<const ExrCodec*>(load_table(exr_library));
    return codec;
}

void keep_dependencies_single_threaded() { ::setenv("OPENBLAS_NUM_THREADS", "1", 0); }

}  // namespace pelagic::tools
