// The entry point by which the loader finds the runtime's functions.
#include <string_view>

#include "pelagic/tests/openxr_runtime/loader_interface.hpp"
#include "pelagic/tests/openxr_runtime/runtime.hpp"

namespace pelagic::openxr_stand_in {
namespace {

struct Named {
    std::string_view name;
    PFN_xrVoidFunction function;
};

XrResult get_instance_proc_addr(XrInstance instance, const char* name, PFN_xrVoidFunction* function) {
    static const Named functions[] = {
        {"xrGetInstanceProcAddr", reinterpret_cast<PFN_xrVoidFunction>(&get_instance_proc_addr)},
#define PELAGIC_STAND_IN_NAMED(function) {"xr" #function, reinterpret_cast<PFN_xrVoidFunction>(&function)},
        PELAGIC_STAND_IN_FUNCTIONS(PELAGIC_STAND_IN_NAMED)
#undef PELAGIC_STAND_IN_NAMED
    };
    if (!name || !function) return XR_ERROR_VALIDATION_FAILURE;
    *function = nullptr;
    const std::string_view wanted = name;
    const bool needs_no_instance = wanted == "xrEnumerateInstanceExtensionProperties" || wanted == "xrCreateInstance";
    if (!needs_no_instance && instance == XR_NULL_HANDLE) return XR_ERROR_HANDLE_INVALID;
    for (const Named& candidate : functions)
        if (candidate.name == wanted) *function = candidate.function;
    return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace
}  // namespace pelagic::openxr_stand_in

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(
    const pelagic::openxr_stand_in::LoaderInfo* loader, pelagic::openxr_stand_in::RuntimeRequest* request) {
    using namespace pelagic::openxr_stand_in;
    constexpr XrVersion api_version = XR_MAKE_VERSION(1, 0, 0);
    const bool is_understood =
        loader && request && loader->structure == loader_info_structure &&
        loader->structure_version == interface_version && loader->structure_size == sizeof *loader &&
        request->structure == runtime_request_structure && request->structure_version == interface_version &&
        request->structure_size == sizeof *request && loader->min_interface_version <= interface_version &&
        loader->max_interface_version >= interface_version && loader->min_api_version <= api_version &&
        loader->max_api_version >= api_version;
    if (!is_understood) return XR_ERROR_INITIALIZATION_FAILED;
    request->interface_version = interface_version;
    request->api_version = api_version;
    request->get_instance_proc_addr = get_instance_proc_addr;
    return XR_SUCCESS;
}
