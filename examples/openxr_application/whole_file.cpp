#include "whole_file.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace openxr_application {

void write_whole_file(const std::filesystem::path& file, std::string_view bytes) {
    const std::filesystem::path part = file.string() + ".part";
    std::ofstream to(part, std::ios::binary);
    to << bytes;
    to.close();
    std::error_code error;
    if (to) std::filesystem::rename(part, file, error);
    if (to && !error) return;
    std::filesystem::remove(part, error);
    throw std::runtime_error(file.string() + " can't be written");
}

}  // namespace openxr_application
