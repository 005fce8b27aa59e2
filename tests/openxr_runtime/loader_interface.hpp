// The structures that the OpenXR loader and a runtime exchange first, by the chapter "Loader
// Runtime Negotiation" of the specification. Debian's headers are for applications and lack these
// two structures.
#pragma once

#include <openxr/openxr.h>

#include <cstddef>
#include <cstdint>

namespace pelagic::openxr_stand_in {

constexpr std::uint32_t loader_info_structure = 1, runtime_request_structure = 3;
constexpr std::uint32_t interface_version = 1;  ///< of both structures and of the negotiation

struct LoaderInfo {
    std::uint32_t structure;
    std::uint32_t structure_version;
    std::size_t structure_size;
    std::uint32_t min_interface_version, max_interface_version;
    XrVersion min_api_version, max_api_version;
};

struct RuntimeRequest {
    std::uint32_t structure;
    std::uint32_t structure_version;
    std::size_t structure_size;
    std::uint32_t interface_version;
    XrVersion api_version;
    PFN_xrGetInstanceProcAddr get_instance_proc_addr;
};

}  // namespace pelagic::openxr_stand_in
