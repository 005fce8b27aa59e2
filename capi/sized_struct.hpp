// Structs that begin with their size: those of applications that were built with a newer header are
// larger than the library's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/capi/c_status.hpp"
#include "pelagic/message/enum_names.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/pelagic.h"

namespace pelagic::capi {

/// A larger struct_size is taken for an uninitialised one.
inline constexpr std::uint32_t max_struct_bytes = 4096;

/// Returns the application's struct_size. Throws std::invalid_argument for null and an invalid
/// size.
template <class T>
std::size_t struct_bytes(const T* pointer, const char* name) {
    const std::uint32_t bytes = needed(pointer, name).struct_size;
    if (bytes < sizeof(T) || bytes > max_struct_bytes)
        reject(invalid_value_message(std::string(name) + ".struct_size", bytes,
                                     number_text(sizeof(T)) + ", the size of the struct"));
    return bytes;
}

/// Reads the application's struct. Throws std::invalid_argument as struct_bytes(), and for fields
/// that the library does not define, unless they are 0.
template <class T>
T read_struct(const T* pointer, const char* name) {
    const std::size_t bytes = struct_bytes(pointer, name);
    const auto* const all = reinterpret_cast<const unsigned char*>(pointer);
    if (std::any_of(all + sizeof(T), all + bytes, [](unsigned char byte) { return byte != 0; }))
        reject(std::string(name) + " sets fields of a later version, expected 0 there");
    return *pointer;
}

/// Returns the value of an enumeration. Throws std::invalid_argument for a number that it does not have.
template <NamedEnum Enum>
Enum enum_of(std::int32_t value, std::string_view prefix, std::string_view name, std::string_view accepted) {
    if (value < 0 || static_cast<std::size_t>(value) >= names_of<Enum>().size())
        reject(invalid_value_message(std::string(prefix) + std::string(name), value, accepted));
    return static_cast<Enum>(value);
}

/// Calls read(struct, name) for each struct of an array, in order. All have the struct_size of the
/// first. Throws std::invalid_argument for null and a wrong struct_size. \pre count > 0
template <class T, class Read>
void read_structs(const T* first, std::size_t count, const std::string& name, Read read) {
    const std::size_t bytes = struct_bytes(first, name.c_str());
    if (count > 1 && bytes % alignof(T) != 0)
        reject(
            invalid_value_message(name + ".struct_size", bytes, number_text(sizeof(T)) + ", the size of the struct"));
    for (std::size_t i = 0; i < count; ++i) {
        const std::string element = name + "[" + number_text(i) + "]";
        const auto* const at = reinterpret_cast<const T*>(reinterpret_cast<const unsigned char*>(first) + i * bytes);
        if (at->struct_size != bytes)
            reject(invalid_value_message(element + ".struct_size", at->struct_size,
                                         number_text(bytes) + ", as the first's"));
        read(read_struct(at, element.c_str()), element);
    }
}

/// Returns the records of a fixed array of C. Throws std::invalid_argument for a count that is not in
/// it: "system_count is 9, expected 0 to 8".
/// \param read    as wave_system_of(): from a record, and the prefix of its names in messages
template <class Record, std::size_t max, class Read>
auto records_of(const Record (&from)[max], std::int32_t count, std::string_view prefix, std::string_view name,
                Read read) {
    const std::string list = std::string(prefix).append(name), element = list.substr(0, list.size() - 1);
    if (count < 0 || static_cast<std::size_t>(count) > max)
        reject(invalid_value_message(element + "_count", count, "0 to " + number_text(max)));
    std::vector<decltype(read(from[0], prefix))> to;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        to.push_back(read(from[i], list + "[" + number_text(i) + "]."));
    return to;
}

/// Writes records to a fixed array of C and returns their number.
/// \pre it has room for them
template <class Records, class Record, std::size_t max, class Write>
std::int32_t write_records(const Records& from, Record (&to)[max], Write write) {
    std::transform(from.begin(), from.end(), to, write);
    return static_cast<std::int32_t>(from.size());
}

/// Writes the application's struct except struct_size. Fields that the library does not define
/// become 0. \pre struct_bytes() accepted it
template <class T>
void write_struct(T ours, T* pointer) {
    const std::size_t bytes = ours.struct_size = pointer->struct_size;
    *pointer = ours;
    std::memset(reinterpret_cast<unsigned char*>(pointer) + sizeof ours, 0, bytes - sizeof ours);
}

}  // namespace pelagic::capi
