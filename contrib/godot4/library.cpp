// The entry point of the library: initialisation and registration of its classes.
#include <cstdio>
#include <cstring>

#include "pelagic/contrib/godot4/buoy.hpp"
#include "pelagic/contrib/godot4/hull.hpp"
#include "pelagic/contrib/godot4/ocean.hpp"
#include "pelagic/contrib/godot4/sea_mesh.hpp"

namespace pelagic::godot4 {
namespace {

NodeClass* const* classes() {
    static NodeClass* const all[] = {&Ocean::description(), &Hull::description(), &Buoy::description(),
                                     &SeaMesh::description(), nullptr};
    return all;
}

void initialize(void*, GDExtensionInitializationLevel level) {
    if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
    for (NodeClass* const* of = classes(); *of; ++of) (*of)->register_class();
}

void deinitialize(void*, GDExtensionInitializationLevel level) {
    if (level != GDEXTENSION_INITIALIZATION_SCENE) return;
    for (NodeClass* const* of = classes(); *of; ++of) (*of)->unregister_class();
    kept_names.clear();
    engine = {};
}

/// Godot 4.0 passes a struct that begins with its version, instead of a function.
bool is_godot_4_0(GDExtensionInterfaceGetProcAddress get_function) {
    std::uint32_t version[2];
    std::memcpy(version, reinterpret_cast<const void*>(get_function), sizeof version);
    return version[0] == 4 && version[1] == 0;
}

}  // namespace
}  // namespace pelagic::godot4

extern "C" __attribute__((visibility("default"))) GDExtensionBool pelagic_godot4_init(
    GDExtensionInterfaceGetProcAddress get_function, GDExtensionClassLibraryPtr library,
    GDExtensionInitialization* initialization) {
    using namespace pelagic::godot4;
    const auto refuse_to_load = [](const char* why, const char* which) {
        std::fprintf(stderr, "Pelagic: %s%s\n", which, why);
        return GDExtensionBool{0};
    };
    if (is_godot_4_0(get_function)) return refuse_to_load("the engine is Godot 4.0, expected 4.1 or later", "");
    if (const char* const missing = engine.load(get_function))
        return refuse_to_load(" is not in the engine's interface, expected Godot 4.1 or later", missing);
    engine.library = library;
    initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
    initialization->userdata = nullptr;
    initialization->initialize = initialize;
    initialization->deinitialize = deinitialize;
    return 1;
}
