// Functions that are common to all systems. The others are in output_folder_posix.cpp and
// output_folder_windows.cpp.
#include "pelagic/tools/files/output_folder.hpp"

#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {

std::string part_name(const std::string& name) { return "." + name + ".part"; }

void OutputFolder::write(const std::string& name, std::span<const std::byte> bytes) const {
    write(name, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void OutputFolder::write(const std::string& name, std::string_view text) const {
    write(name, [&](const Take& take) { take(text); });
}

bool OutputFolder::read(const std::string& name, const std::function<bool(std::string_view)>& take) const {
    const Descriptor file = open_for_reading(name);
    if (!file.is_open()) return false;
    std::string piece(std::size_t{1} << 18, '\0');
    for (;;) {
        const std::size_t got = read_some(name, file, piece);
        if (got == 0 || !take(std::string_view(piece).substr(0, got))) return true;
    }
}

std::optional<std::string> OutputFolder::read_text(const std::string& name, std::size_t max) const {
    std::string text;
    const bool is_there = read(name, [&](std::string_view piece) {
        text += piece.substr(0, max + 1 - text.size());
        return text.size() <= max;
    });
    return is_there ? std::optional(std::move(text)) : std::nullopt;
}

OutputFile::OutputFile(const std::filesystem::path& file)
    : folder_(OutputFolder::of(file)), name_(file.filename().string()) {
    if (name_.empty()) throw FileError("can't write " + file.string() + ": it names a folder, expected a file");
    folder_.check_writable(name_);
}

void OutputFile::write(std::span<const std::byte> bytes) const {
    folder_.write(name_, bytes);
    folder_.sync();
}

void OutputFile::write(std::string_view text) const { write(std::as_bytes(std::span(text))); }

std::optional<OutputFile> file_for(const char* option, const std::optional<std::string>& file) {
    if (!file) return {};
    if (file->empty()) throw InputError(std::string(option) + " is empty, expected a file to write to");
    return std::optional<OutputFile>(std::in_place, path_of(*file));
}

}  // namespace pelagic::tools
