// The instance, and the properties of the system.
#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "pelagic/tests/openxr_runtime/past_validation.hpp"
#include "pelagic/tests/openxr_runtime/runtime.hpp"

namespace pelagic::openxr_stand_in {
namespace {

constexpr const char* known_extensions[] = {XR_KHR_OPENGL_ES_ENABLE_EXTENSION_NAME, XR_MNDX_EGL_ENABLE_EXTENSION_NAME,
                                            extension_for_layer};

std::uint32_t recommended_side() {
    const char* side = std::getenv("PELAGIC_STAND_IN_EYE");
    return side ? static_cast<std::uint32_t>(std::atoi(side)) : 96;
}

bool is_stereo(XrViewConfigurationType type) { return type == XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO; }

/// Checks that instance and system are valid.
XrResult check(const char* call, XrInstance instance, XrSystemId system) {
    if (!find(instance)) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (system != the_system) return reject(call, XR_ERROR_SYSTEM_INVALID);
    return XR_SUCCESS;
}

XrResult check(const char* call, XrInstance instance, XrSystemId system, XrViewConfigurationType type) {
    if (const XrResult result = check(call, instance, system); result != XR_SUCCESS) return result;
    return is_stereo(type) ? XR_SUCCESS : reject(call, XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
}

}  // namespace

std::mutex& mutex() {
    static std::mutex one;
    return one;
}

std::unique_ptr<Instance>& the_instance() {
    static std::unique_ptr<Instance> one;
    return one;
}

Instance* find(XrInstance handle) {
    Instance* instance = the_instance().get();
    return reinterpret_cast<Instance*>(handle) == instance ? instance : nullptr;
}

XrResult reject(const char* call, XrResult why) {
    if (Instance* instance = the_instance().get())
        instance->record.refusals.push_back(std::string(call) + ": " + std::to_string(why));
    return why;
}

XrResult wanted_message(const char* call) {
    const char* wanted = std::getenv("PELAGIC_STAND_IN_REFUSES");
    const std::size_t length = std::strlen(call);
    if (!wanted || std::strncmp(wanted, call, length) != 0 || wanted[length] != ':') return XR_SUCCESS;
    return static_cast<XrResult>(std::atoi(wanted + length + 1));
}

XrResult EnumerateInstanceExtensionProperties(const char* layer, std::uint32_t capacity, std::uint32_t* count,
                                              XrExtensionProperties* to) {
    constexpr const char* call = "xrEnumerateInstanceExtensionProperties";
    const std::lock_guard lock(mutex());
    if (layer) return reject(call, XR_ERROR_API_LAYER_NOT_PRESENT);
    std::vector<XrExtensionProperties> list;
    for (const char* name : known_extensions) {
        XrExtensionProperties properties{XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 1};
        std::strncpy(properties.extensionName, name, XR_MAX_EXTENSION_NAME_SIZE - 1);
        list.push_back(properties);
    }
    return hand_out<XrExtensionProperties>(call, list, capacity, count, to);
}

XrResult CreateInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
    constexpr const char* call = "xrCreateInstance";
    const std::lock_guard lock(mutex());
    if (const XrResult wanted = wanted_message(call); wanted != XR_SUCCESS) return wanted;
    if (!is(info, XR_TYPE_INSTANCE_CREATE_INFO) || !instance) return XR_ERROR_VALIDATION_FAILURE;
    if (the_instance()) return reject(call, XR_ERROR_LIMIT_REACHED);
    if (info->applicationInfo.applicationName[0] == '\0') return XR_ERROR_NAME_INVALID;
    if (XR_VERSION_MAJOR(info->applicationInfo.apiVersion) != 1 ||
        XR_VERSION_MINOR(info->applicationInfo.apiVersion) != 0)
        return XR_ERROR_API_VERSION_UNSUPPORTED;
    auto made = std::make_unique<Instance>();
    for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
        const std::string_view name = info->enabledExtensionNames[i];
        if (std::ranges::find(known_extensions, name, [](const char* known) { return std::string_view(known); }) ==
            std::end(known_extensions))
            return XR_ERROR_EXTENSION_NOT_PRESENT;
        made->extensions.emplace_back(name);
    }
    *instance = reinterpret_cast<XrInstance>(made.get());
    the_instance() = std::move(made);
    return XR_SUCCESS;
}

XrResult DestroyInstance(XrInstance instance) {
    const std::lock_guard lock(mutex());
    if (!find(instance)) return reject("xrDestroyInstance", XR_ERROR_HANDLE_INVALID);
    the_instance()->record.write();
    the_instance().reset();
    return XR_SUCCESS;
}

XrResult GetInstanceProperties(XrInstance instance, XrInstanceProperties* properties) {
    constexpr const char* call = "xrGetInstanceProperties";
    const std::lock_guard lock(mutex());
    if (!find(instance)) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(properties, XR_TYPE_INSTANCE_PROPERTIES)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    properties->runtimeVersion = XR_MAKE_VERSION(0, 1, 0);
    std::strncpy(properties->runtimeName, "stand-in for tests", XR_MAX_RUNTIME_NAME_SIZE);
    return XR_SUCCESS;
}

XrResult ResultToString(XrInstance instance, XrResult value, char buffer[XR_MAX_RESULT_STRING_SIZE]) {
    const std::lock_guard lock(mutex());
    if (!find(instance)) return reject("xrResultToString", XR_ERROR_HANDLE_INVALID);
    switch (value) {
#define PELAGIC_STAND_IN_NAME(name, number) \
    case name: std::strncpy(buffer, #name, XR_MAX_RESULT_STRING_SIZE); return XR_SUCCESS;
        XR_LIST_ENUM_XrResult(PELAGIC_STAND_IN_NAME)
#undef PELAGIC_STAND_IN_NAME
    }
    std::snprintf(buffer, XR_MAX_RESULT_STRING_SIZE, "XR_UNKNOWN_%s_%d", value < 0 ? "FAILURE" : "SUCCESS", value);
    return XR_SUCCESS;
}

XrResult StructureTypeToString(XrInstance instance, XrStructureType value, char buffer[XR_MAX_STRUCTURE_NAME_SIZE]) {
    const std::lock_guard lock(mutex());
    if (!find(instance)) return reject("xrStructureTypeToString", XR_ERROR_HANDLE_INVALID);
    switch (value) {
#define PELAGIC_STAND_IN_NAME(name, number) \
    case name: std::strncpy(buffer, #name, XR_MAX_STRUCTURE_NAME_SIZE); return XR_SUCCESS;
        XR_LIST_ENUM_XrStructureType(PELAGIC_STAND_IN_NAME)
#undef PELAGIC_STAND_IN_NAME
    }
    std::snprintf(buffer, XR_MAX_STRUCTURE_NAME_SIZE, "XR_UNKNOWN_STRUCTURE_TYPE_%d", value);
    return XR_SUCCESS;
}

XrResult PollEvent(XrInstance handle, XrEventDataBuffer* event) {
    constexpr const char* call = "xrPollEvent";
    const std::lock_guard lock(mutex());
    Instance* instance = find(handle);
    if (!instance) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(event, XR_TYPE_EVENT_DATA_BUFFER)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (instance->events.empty()) return XR_EVENT_UNAVAILABLE;
    *event = instance->events.front();
    instance->events.pop_front();
    return XR_SUCCESS;
}

XrResult GetSystem(XrInstance instance, const XrSystemGetInfo* info, XrSystemId* system) {
    constexpr const char* call = "xrGetSystem";
    const std::lock_guard lock(mutex());
    if (const XrResult wanted = wanted_message(call); wanted != XR_SUCCESS) return reject(call, wanted);
    if (!find(instance)) return reject(call, XR_ERROR_HANDLE_INVALID);
    if (!is(info, XR_TYPE_SYSTEM_GET_INFO) || !system) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY)
        return reject(call, XR_ERROR_FORM_FACTOR_UNSUPPORTED);
    *system = the_system;
    return XR_SUCCESS;
}

XrResult GetSystemProperties(XrInstance instance, XrSystemId system, XrSystemProperties* properties) {
    constexpr const char* call = "xrGetSystemProperties";
    const std::lock_guard lock(mutex());
    if (const XrResult result = check(call, instance, system); result != XR_SUCCESS) return result;
    if (!is(properties, XR_TYPE_SYSTEM_PROPERTIES)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    properties->systemId = system;
    properties->vendorId = 0;
    std::strncpy(properties->systemName, "stand-in for tests", XR_MAX_SYSTEM_NAME_SIZE);
    properties->graphicsProperties = {largest_side, largest_side, XR_MIN_COMPOSITION_LAYERS_SUPPORTED};
    properties->trackingProperties = {XR_TRUE, XR_TRUE};
    return XR_SUCCESS;
}

XrResult EnumerateEnvironmentBlendModes(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                        std::uint32_t capacity, std::uint32_t* count, XrEnvironmentBlendMode* to) {
    constexpr const char* call = "xrEnumerateEnvironmentBlendModes";
    const std::lock_guard lock(mutex());
    if (const XrResult result = check(call, instance, system, type); result != XR_SUCCESS) return result;
    const XrEnvironmentBlendMode modes[] = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE};
    return hand_out<XrEnvironmentBlendMode>(call, modes, capacity, count, to);
}

XrResult EnumerateViewConfigurations(XrInstance instance, XrSystemId system, std::uint32_t capacity,
                                     std::uint32_t* count, XrViewConfigurationType* to) {
    constexpr const char* call = "xrEnumerateViewConfigurations";
    const std::lock_guard lock(mutex());
    if (const XrResult result = check(call, instance, system); result != XR_SUCCESS) return result;
    const XrViewConfigurationType types[] = {XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
    return hand_out<XrViewConfigurationType>(call, types, capacity, count, to);
}

XrResult GetViewConfigurationProperties(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                        XrViewConfigurationProperties* properties) {
    constexpr const char* call = "xrGetViewConfigurationProperties";
    const std::lock_guard lock(mutex());
    if (const XrResult result = check(call, instance, system, type); result != XR_SUCCESS) return result;
    if (!is(properties, XR_TYPE_VIEW_CONFIGURATION_PROPERTIES)) return reject(call, XR_ERROR_VALIDATION_FAILURE);
    properties->viewConfigurationType = type;
    properties->fovMutable = XR_FALSE;
    return XR_SUCCESS;
}

XrResult EnumerateViewConfigurationViews(XrInstance instance, XrSystemId system, XrViewConfigurationType type,
                                         std::uint32_t capacity, std::uint32_t* count, XrViewConfigurationView* to) {
    constexpr const char* call = "xrEnumerateViewConfigurationViews";
    const std::lock_guard lock(mutex());
    if (const XrResult result = check(call, instance, system, type); result != XR_SUCCESS) return result;
    const std::uint32_t side = recommended_side();
    const XrViewConfigurationView view{
        XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, side, largest_side, side, largest_side, 1, 1};
    const XrViewConfigurationView both[views] = {view, view};
    return hand_out<XrViewConfigurationView>(call, both, capacity, count, to);
}

XrResult GetOpenGLESGraphicsRequirementsKHR(XrInstance instance, XrSystemId system,
                                            XrGraphicsRequirementsOpenGLESKHR* requirements) {
    constexpr const char* call = "xrGetOpenGLESGraphicsRequirementsKHR";
    const std::lock_guard lock(mutex());
    if (const XrResult result = check(call, instance, system); result != XR_SUCCESS) return result;
    if (!is(requirements, XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_ES_KHR))
        return reject(call, XR_ERROR_VALIDATION_FAILURE);
    requirements->minApiVersionSupported = XR_MAKE_VERSION(3, 0, 0);
    requirements->maxApiVersionSupported = XR_MAKE_VERSION(3, 2, 0);
    the_instance()->told_graphics_requirements = true;
    return XR_SUCCESS;
}

}  // namespace pelagic::openxr_stand_in
