// Entry points of the library: initialisation and registration of its classes.
#include "pelagic/contrib/godot3/hull_methods.hpp"
#include "pelagic/contrib/godot3/hull_node.hpp"
#include "pelagic/contrib/godot3/hull_properties.hpp"
#include "pelagic/contrib/godot3/ocean_methods.hpp"
#include "pelagic/contrib/godot3/ocean_node.hpp"
#include "pelagic/contrib/godot3/properties.hpp"
#include "pelagic/contrib/godot3/script_class.hpp"

namespace pelagic::godot {
namespace {

const NativeScriptApi* nativescript = nullptr;

}  // namespace
}  // namespace pelagic::godot

#define PELAGIC_GODOT_EXPORT extern "C" __attribute__((visibility("default")))

PELAGIC_GODOT_EXPORT void godot_gdnative_init(pelagic::godot::InitOptions* options) {
    using namespace pelagic::godot;
    const ApiVersion have = options->api->table.version;
    if (have.major != 1) return options->report_version_mismatch(options->library, "Core", {1, 0}, have);
    set_core_api(options->api);
    for (unsigned i = 0; i < options->api->extension_count; ++i)
        if (options->api->extensions[i]->type == nativescript_api)
            nativescript = reinterpret_cast<const NativeScriptApi*>(options->api->extensions[i]);
}

PELAGIC_GODOT_EXPORT void godot_gdnative_terminate(void*) {}

PELAGIC_GODOT_EXPORT void godot_nativescript_init(void* library) {
    using namespace pelagic::godot;
    if (!nativescript) return;  // godot_gdnative_init() has reported the reason
    register_node<OceanNode>(*nativescript, library, OceanNode::class_name, properties(), ocean_methods());
    register_node<HullNode>(*nativescript, library, HullNode::class_name, hull_properties(), hull_methods());
}
