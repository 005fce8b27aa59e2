// Files that are whole or not there: written beside their name, then renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace pelagic::tools {

/// The name that a file has while it is written: ".NAME.part" in the same folder.
std::filesystem::path part_name(const std::filesystem::path& file);

/// Writes the bytes and renames. Throws FileError, "can't write FILE: reason", and leaves no part behind.
void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& file, std::string_view text);

/// Throws what write_whole_file() would for want of a folder or a permission, without touching the file: for what is
/// only written after long work.
void check_writable(const std::filesystem::path& file);

/// Adds a line to a file, which is created if it is missing. Throws FileError likewise.
void append_line(const std::filesystem::path& file, std::string_view line);

}  // namespace pelagic::tools
