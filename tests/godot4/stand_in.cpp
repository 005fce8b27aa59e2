// A stand-in for Godot 4: values, objects and a scene tree behind the functions of gdextension_interface.h that the
// extension uses. It loads the library as the engine does, and drives its classes.
//
// usage: stand_in LIBRARY CYCLES [GODOT_4_0|MISSING_FUNCTION]
//
// The engine's rules that it checks: each value is destroyed once, arrays are copied on write, references are counted,
// methods exist (docs.godotengine.org/en/4.1/classes, class_node3d.html and so on) and properties have registered
// setters and getters. It ends with 1 and a line for a value that is left over after a cycle.
#include <dlfcn.h>
#include <malloc.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include GDEXTENSION_INTERFACE

namespace {

[[noreturn]] void fail(const std::string& why) {
    std::printf("stand_in: %s\n", why.c_str());
    std::exit(1);
}
void need(bool holds, const std::string& what) {
    if (!holds) fail("not so: " + what);
}

long live = 0;  // values of the engine
struct Counted {
    Counted() { ++live; }
    Counted(const Counted&) { ++live; }
    ~Counted() { --live; }
    int references = 1;
};
struct String : Counted {
    std::string text;
};
struct Interned : Counted {
    std::string text;
};
struct Var;
struct Buffer : Counted {
    std::vector<unsigned char> bytes;
};
struct List;
struct Table;
struct Thing;

/// A Variant of 24 bytes. Value types are in place, others shared.
struct Var {
    std::int32_t type = 0, unused = 0;
    union {
        bool boolean;
        std::int64_t whole;
        double number;
        float floats[4];
        String* string;
        Interned* name;
        List* list;
        Table* table;
        Buffer* buffer;
        Thing* thing;
    };
    Var() : whole(0) { floats[2] = floats[3] = 0; }
    Var(const Var& it);
    Var& operator=(const Var& it) {
        if (this != &it) this->~Var(), new (this) Var(it);
        return *this;
    }
    ~Var();
};
static_assert(sizeof(Var) == 24);
struct List : Counted {
    std::vector<Var> all;
};
struct Table : Counted {
    std::vector<std::pair<Var, Var>> all;
};

constexpr int t_nil = GDEXTENSION_VARIANT_TYPE_NIL, t_bool = GDEXTENSION_VARIANT_TYPE_BOOL,
              t_int = GDEXTENSION_VARIANT_TYPE_INT, t_float = GDEXTENSION_VARIANT_TYPE_FLOAT,
              t_string = GDEXTENSION_VARIANT_TYPE_STRING, t_vector3 = GDEXTENSION_VARIANT_TYPE_VECTOR3,
              t_vector4 = GDEXTENSION_VARIANT_TYPE_VECTOR4, t_box = GDEXTENSION_VARIANT_TYPE_AABB,
              t_transform = GDEXTENSION_VARIANT_TYPE_TRANSFORM3D, t_name = GDEXTENSION_VARIANT_TYPE_STRING_NAME,
              t_path = GDEXTENSION_VARIANT_TYPE_NODE_PATH, t_object = GDEXTENSION_VARIANT_TYPE_OBJECT,
              t_table = GDEXTENSION_VARIANT_TYPE_DICTIONARY, t_list = GDEXTENSION_VARIANT_TYPE_ARRAY,
              t_bytes = GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY,
              t_ints = GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY,
              t_floats = GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY,
              t_vectors = GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY;

std::size_t element_bytes(int type) { return type == t_bytes ? 1 : type == t_vectors ? 12 : 4; }
bool is_packed(int type) { return type == t_bytes || type == t_ints || type == t_floats || type == t_vectors; }
bool is_boxed(int type) { return type == t_box || type == t_transform; }  // in a buffer
std::size_t boxed_bytes(int type) { return type == t_box ? 24 : 48; }

/// An object of a class of the engine, and behind it perhaps one of the extension.
struct Thing : Counted {
    std::string class_name, extension_class;
    GDExtensionClassInstancePtr instance = nullptr;
    bool is_counted = false, is_in_tree = false;
    Thing* parent = nullptr;
    std::vector<Thing*> children;
    std::string name;
    std::array<float, 12> pose = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    std::map<std::string, Var> values;
    std::vector<std::string> refused;
};

template <class T>
void release(T* it) {
    need(it->references > 0, "a value is destroyed once");
    if (--it->references == 0) delete it;
}
Var::Var(const Var& it) {
    std::memcpy(static_cast<void*>(this), &it, sizeof it);
    if (type == t_string || type == t_path)
        ++string->references;
    else if (type == t_name)
        ++name->references;
    else if (type == t_list)
        ++list->references;
    else if (type == t_table)
        ++table->references;
    else if (is_packed(type) || is_boxed(type))
        ++buffer->references;
    else if (type == t_object && thing && thing->is_counted)
        ++thing->references;
}
std::map<std::string, Interned*> interned;
void release_name(Interned* it) {
    if (it->references == 1) interned.erase(it->text);
    release(it);
}
Var::~Var() {
    if (type == t_string || type == t_path)
        release(string);
    else if (type == t_name)
        release_name(name);
    else if (type == t_list)
        release(list);
    else if (type == t_table)
        release(table);
    else if (is_packed(type) || is_boxed(type))
        release(buffer);
    else if (type == t_object && thing && thing->is_counted)
        release(thing);
    type = t_nil;
}

String* string_of(std::string text) {
    auto* made = new String;
    made->text = std::move(text);
    return made;
}
Interned* name_of(const std::string& text) {
    const auto found = interned.find(text);
    if (found != interned.end()) return ++found->second->references, found->second;
    auto* made = new Interned;
    made->text = text;
    return interned[text] = made;
}
const std::string& text_of(GDExtensionConstStringNamePtr name) {
    return (*static_cast<Interned* const*>(name))->text;
}

Var made(bool it) {
    Var v;
    v.type = t_bool, v.boolean = it;
    return v;
}
Var made(std::int64_t it) {
    Var v;
    v.type = t_int, v.whole = it;
    return v;
}
Var made(double it) {
    Var v;
    v.type = t_float, v.number = it;
    return v;
}
Var made(const std::string& it, int type = t_string) {
    Var v;
    v.type = type, v.string = string_of(it);
    return v;
}
Var made(const char* it) { return made(std::string(it)); }
Var vector(float x, float y, float z) {
    Var v;
    v.type = t_vector3, v.floats[0] = x, v.floats[1] = y, v.floats[2] = z;
    return v;
}
Var of_thing(Thing* it) {
    Var v;
    v.type = t_object, v.thing = it;
    if (it && it->is_counted) ++it->references;
    return v;
}
Var buffer_of(int type, const void* bytes, std::size_t size) {
    Var v;
    v.type = type, v.buffer = new Buffer;
    v.buffer->bytes.assign(static_cast<const unsigned char*>(bytes), static_cast<const unsigned char*>(bytes) + size);
    return v;
}
Var list_of(const std::vector<Var>& all) {
    Var v;
    v.type = t_list, v.list = new List;
    v.list->all = all;
    return v;
}
std::string text(const Var& v) {
    if (v.type == t_string || v.type == t_path) return v.string->text;
    if (v.type == t_name) return v.name->text;
    if (v.type == t_int) return std::to_string(v.whole);
    if (v.type == t_float) return std::to_string(v.number);
    return v.type == t_nil ? "<null>" : "<value>";
}
double number(const Var& v) {
    return v.type == t_float  ? v.number
           : v.type == t_int  ? static_cast<double>(v.whole)
           : v.type == t_bool ? v.boolean
                              : 0.0;
}
bool is_equal(const Var& a, const Var& b) {
    return a.type == t_int ? b.type == t_int && a.whole == b.whole : text(a) == text(b);
}
Var entry(const Var& table, const std::string& key) {
    for (const auto& [k, v] : table.table->all)
        if (text(k) == key) return v;
    fail("no key " + key);
}
template <class T>
std::vector<T> elements(const Var& v) {
    std::vector<T> all(v.buffer->bytes.size() / sizeof(T));
    std::memcpy(all.data(), v.buffer->bytes.data(), v.buffer->bytes.size());
    return all;
}

// ---- values

struct PackedArray {  // of 16 bytes
    void* proxy;
    Buffer* buffer;
};

template <int type>
void from_type(GDExtensionUninitializedVariantPtr to, GDExtensionTypePtr from) {
    Var& v = *new (to) Var;
    v.type = type;
    if (type == t_bool)
        v.boolean = *static_cast<GDExtensionBool*>(from) != 0;
    else if (type == t_int || type == t_float)
        std::memcpy(&v.whole, from, 8);
    else if (type == t_vector3 || type == t_vector4)
        std::memcpy(v.floats, from, type == t_vector3 ? 12 : 16);
    else if (is_boxed(type))
        v.buffer = new Buffer, v.buffer->bytes.assign(static_cast<unsigned char*>(from),
                                                      static_cast<unsigned char*>(from) + boxed_bytes(type));
    else if (type == t_string || type == t_path)
        v.string = string_of((*static_cast<String**>(from))->text);
    else if (type == t_name)
        v.name = name_of((*static_cast<Interned**>(from))->text);
    else if (type == t_table)
        ++(v.table = *static_cast<Table**>(from))->references;
    else if (type == t_list)
        ++(v.list = *static_cast<List**>(from))->references;
    else if (is_packed(type))
        ++(v.buffer = static_cast<PackedArray*>(from)->buffer)->references;
    else if (type == t_object) {
        v.thing = *static_cast<Thing**>(from);
        // As RefCounted::init_ref(): the first Variant takes the reference of the construction.
        if (v.thing && v.thing->is_counted && !v.thing->values.count("init_ref"))
            v.thing->values["init_ref"];
        else if (v.thing && v.thing->is_counted)
            ++v.thing->references;
    }
}
template <int type>
void to_type(GDExtensionUninitializedTypePtr to, GDExtensionVariantPtr from) {
    const Var& v = *static_cast<Var*>(from);
    if (type == t_bool)
        *static_cast<GDExtensionBool*>(to) = v.type == t_bool ? v.boolean : number(v) != 0;
    else if (type == t_int)
        *static_cast<std::int64_t*>(to) = static_cast<std::int64_t>(number(v));
    else if (type == t_float)
        *static_cast<double*>(to) = number(v);
    else if (type == t_vector3 || type == t_vector4) {
        float zeros[4] = {};
        std::memcpy(to, v.type == type ? v.floats : zeros, type == t_vector3 ? 12 : 16);
    } else if (is_boxed(type)) {
        need(v.type == type, "a conversion to Transform3D or AABB is from one");
        std::memcpy(to, v.buffer->bytes.data(), boxed_bytes(type));
    } else if (type == t_string || type == t_path)
        *static_cast<String**>(to) = string_of(text(v));
    else if (type == t_name)
        *static_cast<Interned**>(to) = name_of(text(v));
    else if (type == t_object)
        *static_cast<Thing**>(to) = v.type == t_object ? v.thing : nullptr;
    else if (type == t_table || type == t_list) {
        need(v.type == type, "a conversion to Dictionary or Array is from one");
        if (type == t_table)
            ++(*static_cast<Table**>(to) = v.table)->references;
        else
            ++(*static_cast<List**>(to) = v.list)->references;
    } else if (is_packed(type)) {
        auto& array = *static_cast<PackedArray*>(to);
        array.proxy = nullptr;
        if (v.type == type)
            ++(array.buffer = v.buffer)->references;
        else
            array.buffer = new Buffer;
    }
}
template <int type>
void destroy(GDExtensionTypePtr it) {
    if (type == t_string || type == t_path)
        release(*static_cast<String**>(it));
    else if (type == t_name)
        release_name(*static_cast<Interned**>(it));
    else if (type == t_table)
        release(*static_cast<Table**>(it));
    else if (type == t_list)
        release(*static_cast<List**>(it));
    else if (is_packed(type))
        release(static_cast<PackedArray*>(it)->buffer);
}
template <int type>
void construct(GDExtensionUninitializedTypePtr to, const GDExtensionConstTypePtr*) {
    if (type == t_bool)
        *static_cast<GDExtensionBool*>(to) = 0;
    else if (type == t_int || type == t_float)
        std::memset(to, 0, 8);
    else if (type == t_string || type == t_path)
        *static_cast<String**>(to) = string_of("");
    else if (type == t_name)
        *static_cast<Interned**>(to) = name_of("");
    else if (type == t_table)
        *static_cast<Table**>(to) = new Table;
    else if (type == t_list)
        *static_cast<List**>(to) = new List;
    else if (is_packed(type))
        static_cast<PackedArray*>(to)->buffer = new Buffer;
    else
        std::memset(to, 0, is_boxed(type) ? boxed_bytes(type) : 16);
}
void path_of_string(GDExtensionUninitializedTypePtr to, const GDExtensionConstTypePtr* from) {
    *static_cast<String**>(to) = string_of((*static_cast<String* const*>(from[0]))->text);
}
void name_of_string(GDExtensionUninitializedTypePtr to, const GDExtensionConstTypePtr* from) {
    *static_cast<Interned**>(to) = name_of((*static_cast<String* const*>(from[0]))->text);
}

#define TYPES(F)                                                                                                  \
    F(t_bool)                                                                                                     \
    F(t_int)                                                                                                      \
    F(t_float)                                                                                                    \
    F(t_string)                                                                                                   \
    F(t_vector3)                                                                                                  \
    F(t_vector4)                                                                                                  \
    F(t_box) F(t_transform) F(t_name) F(t_path) F(t_object) F(t_table) F(t_list) F(t_bytes) F(t_ints) F(t_floats) \
        F(t_vectors)
GDExtensionVariantFromTypeConstructorFunc from_type_constructor(GDExtensionVariantType type) {
#define CASE(t) \
    if (static_cast<int>(type) == t) return from_type<t>;
    TYPES(CASE)
#undef CASE
    fail("a type that the stand-in lacks");
}
GDExtensionTypeFromVariantConstructorFunc to_type_constructor(GDExtensionVariantType type) {
#define CASE(t) \
    if (static_cast<int>(type) == t) return to_type<t>;
    TYPES(CASE)
#undef CASE
    fail("a type that the stand-in lacks");
}
GDExtensionPtrConstructor constructor(GDExtensionVariantType type, std::int32_t number) {
    if (number == 2) return static_cast<int>(type) == t_path ? path_of_string : name_of_string;
    need(number == 0, "constructors 0 and 2");
#define CASE(t) \
    if (static_cast<int>(type) == t) return construct<t>;
    TYPES(CASE)
#undef CASE
    fail("a type that the stand-in lacks");
}
GDExtensionPtrDestructor destructor(GDExtensionVariantType type) {
    if (static_cast<int>(type) < t_name && static_cast<int>(type) != t_string) return nullptr;
    if (static_cast<int>(type) == t_object) return nullptr;
#define CASE(t) \
    if (static_cast<int>(type) == t) return destroy<t>;
    TYPES(CASE)
#undef CASE
    fail("a type that the stand-in lacks");
}

unsigned char* first_byte(GDExtensionTypePtr array, GDExtensionInt index, std::size_t size) {
    Buffer*& buffer = static_cast<PackedArray*>(array)->buffer;
    if (buffer->references > 1) {  // copied on write
        auto* own = new Buffer;
        own->bytes = buffer->bytes;
        --buffer->references;
        buffer = own;
    }
    need(index >= 0 && static_cast<std::size_t>(index + 1) * size <= buffer->bytes.size(),
         "an index within the array");
    return buffer->bytes.data() + static_cast<std::size_t>(index) * size;
}

// ---- classes

struct Registered {
    std::string parent;
    GDExtensionClassCreationInfo info;
    std::map<std::string, GDExtensionClassMethodInfo> methods;
    std::map<std::string, std::array<std::string, 2>> properties;  // setter and getter
    std::map<std::string, int> types;                              // of the properties
    std::vector<std::string> signals_;
};
std::map<std::string, Registered> classes;
int library_token;
std::vector<std::string> errors;
Thing* root = nullptr;
Thing* engine_singleton = nullptr;
bool is_editor = false;
Thing* camera = nullptr;

bool is_reference(const std::string& class_name) {
    return class_name == "Image" || class_name == "ArrayMesh" || class_name == "Texture2DArray" ||
           class_name == "ShaderMaterial";
}
Thing* construct_thing(const std::string& class_name) {
    need(is_reference(class_name) || class_name == "Node3D" || class_name == "MeshInstance3D" ||
             class_name == "Camera3D",
         "the engine has the class " + class_name);
    auto* it = new Thing;
    it->class_name = class_name;
    it->is_counted = is_reference(class_name);
    return it;
}
Thing* node_at(Thing* from, const std::string& path) {
    if (path == "..") return from->parent;
    Thing* at = from;
    std::string rest = path;
    while (!rest.empty() && at) {
        const std::size_t slash = rest.find('/');
        const std::string part = rest.substr(0, slash);
        rest = slash == std::string::npos ? "" : rest.substr(slash + 1);
        if (part == "..")
            at = at->parent;
        else {
            Thing* found = nullptr;
            for (Thing* child : at->children)
                if (child->name == part) found = child;
            at = found;
        }
    }
    return at;
}

Var call_engine(Thing& it, const std::string& method, const std::vector<Var>& given) {
    const auto arguments = [&](std::size_t count) {
        need(given.size() == count, method + " has " + std::to_string(count) + " arguments");
    };
    const bool is_node = !it.is_counted;
    // Object
    if (method == "emit_signal") {
        need(text(given[0]) == "refused", "the signal is refused");
        it.refused.push_back(text(given[1]));
        return {};
    }
    // Node
    if (is_node && method == "is_inside_tree") return arguments(0), made(it.is_in_tree);
    if (is_node && method == "get_node_or_null") {
        arguments(1);
        need(given[0].type == t_path, "the path is a NodePath");
        return of_thing(node_at(&it, text(given[0])));
    }
    if (is_node && method == "set_process_priority") return arguments(1), Var();
    if (is_node && method == "get_viewport") return arguments(0), of_thing(root);
    if (&it == root && method == "get_camera_3d") return arguments(0), of_thing(camera);
    if (it.class_name == "Engine" && method == "is_editor_hint") return arguments(0), made(is_editor);
    // Node3D
    if (is_node && method == "is_visible_in_tree") return arguments(0), made(true);
    if (is_node && method == "set_as_top_level") return arguments(1), Var();
    if (is_node && method == "get_global_transform") return arguments(0), buffer_of(t_transform, it.pose.data(), 48);
    if (is_node && method == "set_global_transform") {
        arguments(1);
        need(given[0].type == t_transform, "the transform is a Transform3D");
        std::memcpy(it.pose.data(), given[0].buffer->bytes.data(), 48);
        return {};
    }
    // MeshInstance3D and GeometryInstance3D
    if (it.class_name == "MeshInstance3D") {
        if (method == "set_mesh" || method == "set_custom_aabb" || method == "set_cast_shadows_setting")
            return arguments(1), it.values[method.substr(4)] = given[0], Var();
        if (method == "get_material_override") return arguments(0), it.values["material_override"];
    }
    if (it.class_name == "ShaderMaterial" && method == "set_shader_parameter")
        return arguments(2), it.values[text(given[0])] = given[1], Var();
    if (it.class_name == "ArrayMesh") {
        if (method == "add_surface_from_arrays") {
            arguments(2);
            need(number(given[0]) == 3 && given[1].list->all.size() == 13, "triangles, and 13 arrays");
            return it.values["arrays"] = given[1], Var();
        }
        if (method == "get_surface_count") return arguments(0), made(std::int64_t{it.values.count("arrays") ? 1 : 0});
        if (method == "surface_get_primitive_type") return arguments(1), made(std::int64_t{3});
        if (method == "surface_get_arrays") return arguments(1), it.values["arrays"];
    }
    if (it.class_name == "Image") {
        if (method == "set_data") {
            arguments(5);
            const auto side = static_cast<std::size_t>(number(given[0]));
            const std::size_t texel = number(given[3]) == 15 ? 8 : 4;
            need(number(given[3]) == 15 || number(given[3]) == 5, "the format is RGBAH or RGBA8");
            const std::size_t texels = given[2].boolean ? (4 * side * side - 1) / 3 : side * side;
            need(given[4].type == t_bytes && given[4].buffer->bytes.size() == texel * texels,
                 "an image has the bytes of its format");
            return it.values["data"] = given[4], Var();
        }
        if (method == "generate_mipmaps") return arguments(0), Var();
    }
    if (it.class_name == "Texture2DArray") {
        if (method == "create_from_images") return arguments(1), it.values["images"] = given[0], Var();
        if (method == "update_layer") {
            arguments(2);
            need(number(given[1]) < static_cast<double>(it.values["images"].list->all.size()), "the layer exists");
            return it.values["images"].list->all[static_cast<std::size_t>(number(given[1]))] = given[0], Var();
        }
    }
    fail("the engine's class " + it.class_name + " has no method " + method);
}

Var call_method(Thing& it, const std::string& method, const std::vector<Var>& arguments, bool by_pointers = false);

Var call_value(Var& self, const std::string& method, const std::vector<Var>& arguments) {
    if (self.type == t_object) {
        need(self.thing != nullptr, method + " of an object");
        return call_engine(*self.thing, method, arguments);
    }
    if (is_packed(self.type) && method == "size")
        return made(static_cast<std::int64_t>(self.buffer->bytes.size() / element_bytes(self.type)));
    if (is_packed(self.type) && method == "resize") {
        need(self.buffer->references == 1, "a new array is not shared");
        return self.buffer->bytes.resize(static_cast<std::size_t>(arguments[0].whole) * element_bytes(self.type)),
               Var();
    }
    if (self.type == t_list && method == "size") return made(static_cast<std::int64_t>(self.list->all.size()));
    if (self.type == t_list && method == "resize")
        return self.list->all.resize(static_cast<std::size_t>(arguments[0].whole)), Var();
    if (self.type == t_list && method == "append") return self.list->all.push_back(arguments[0]), Var();
    if (self.type == t_table && method == "keys") {
        std::vector<Var> keys;
        for (const auto& [key, value] : self.table->all) keys.push_back(key);
        return list_of(keys);
    }
    if (self.type == t_nil && method == "size") return made(std::int64_t{0});
    fail("a value of type " + std::to_string(self.type) + " has no method " + method);
}

// ---- the interface

void print_error(const char* text, const char*, const char*, std::int32_t, GDExtensionBool) {
    errors.push_back(text);
}
void variant_new_nil(GDExtensionUninitializedVariantPtr to) { new (to) Var; }
void variant_new_copy(GDExtensionUninitializedVariantPtr to, GDExtensionConstVariantPtr from) {
    new (to) Var(*static_cast<const Var*>(from));
}
void variant_destroy(GDExtensionVariantPtr it) { static_cast<Var*>(it)->~Var(); }
GDExtensionVariantType variant_get_type(GDExtensionConstVariantPtr it) {
    return static_cast<GDExtensionVariantType>(static_cast<const Var*>(it)->type);
}
void variant_call(GDExtensionVariantPtr self, GDExtensionConstStringNamePtr method,
                  const GDExtensionConstVariantPtr* arguments, GDExtensionInt count,
                  GDExtensionUninitializedVariantPtr result, GDExtensionCallError* error) {
    std::vector<Var> all;
    for (GDExtensionInt i = 0; i < count; ++i) all.push_back(*static_cast<const Var*>(arguments[i]));
    const Var returned = call_value(*static_cast<Var*>(self), text_of(method), all);
    error->error = GDEXTENSION_CALL_OK;
    new (result) Var(returned);
}
void variant_set_keyed(GDExtensionVariantPtr self, GDExtensionConstVariantPtr key, GDExtensionConstVariantPtr value,
                       GDExtensionBool* is_valid) {
    Var& it = *static_cast<Var*>(self);
    const Var &at = *static_cast<const Var*>(key), &to = *static_cast<const Var*>(value);
    *is_valid = 1;
    if (it.type == t_list) return void(it.list->all.at(static_cast<std::size_t>(at.whole)) = to);
    need(it.type == t_table, "a Dictionary or an Array");
    for (auto& [k, v] : it.table->all)
        if (is_equal(k, at)) return void(v = to);
    it.table->all.emplace_back(at, to);
}
void variant_get_keyed(GDExtensionConstVariantPtr self, GDExtensionConstVariantPtr key,
                       GDExtensionUninitializedVariantPtr result, GDExtensionBool* is_valid) {
    const Var &it = *static_cast<const Var*>(self), &at = *static_cast<const Var*>(key);
    *is_valid = 1;
    if (it.type == t_list) return void(new (result) Var(it.list->all.at(static_cast<std::size_t>(at.whole))));
    need(it.type == t_table, "a Dictionary or an Array");
    for (const auto& [k, v] : it.table->all)
        if (is_equal(k, at)) return void(new (result) Var(v));
    *is_valid = 0;
    new (result) Var;
}
void string_new(GDExtensionUninitializedStringPtr to, const char* text, GDExtensionInt size) {
    *static_cast<String**>(to) = string_of(std::string(text, static_cast<std::size_t>(size)));
}
GDExtensionInt string_to_utf8(GDExtensionConstStringPtr from, char* text, GDExtensionInt room) {
    const std::string& all = (*static_cast<String* const*>(from))->text;
    if (text) std::memcpy(text, all.data(), std::min(static_cast<std::size_t>(room), all.size()));
    return static_cast<GDExtensionInt>(all.size());
}
std::uint8_t* bytes_index(GDExtensionTypePtr it, GDExtensionInt i) { return first_byte(it, i, 1); }
std::int32_t* ints_index(GDExtensionTypePtr it, GDExtensionInt i) {
    return reinterpret_cast<std::int32_t*>(first_byte(it, i, 4));
}
float* floats_index(GDExtensionTypePtr it, GDExtensionInt i) {
    return reinterpret_cast<float*>(first_byte(it, i, 4));
}
GDExtensionTypePtr vectors_index(GDExtensionTypePtr it, GDExtensionInt i) { return first_byte(it, i, 12); }
void ref_set_object(GDExtensionRefPtr ref, GDExtensionObjectPtr object) {
    auto& at = *static_cast<Thing**>(ref);
    if (object) ++static_cast<Thing*>(object)->references;
    if (at) release(at);
    at = static_cast<Thing*>(object);
}
GDExtensionObjectPtr global_get_singleton(GDExtensionConstStringNamePtr name) {
    need(text_of(name) == "Engine", "the singleton is Engine");
    return engine_singleton;
}
void object_set_instance(GDExtensionObjectPtr object, GDExtensionConstStringNamePtr name,
                         GDExtensionClassInstancePtr instance) {
    static_cast<Thing*>(object)->extension_class = text_of(name);
    static_cast<Thing*>(object)->instance = instance;
}
GDExtensionObjectPtr construct_object(GDExtensionConstStringNamePtr name) { return construct_thing(text_of(name)); }
void register_class(GDExtensionClassLibraryPtr library, GDExtensionConstStringNamePtr name,
                    GDExtensionConstStringNamePtr parent, const GDExtensionClassCreationInfo* info) {
    need(library == &library_token, "the library is its own");
    classes[text_of(name)] = {text_of(parent), *info, {}, {}, {}, {}};
}
void register_method(GDExtensionClassLibraryPtr, GDExtensionConstStringNamePtr name,
                     const GDExtensionClassMethodInfo* info) {
    Registered& of = classes.at(text_of(name));
    GDExtensionClassMethodInfo kept = *info;
    std::vector<int> types;
    for (std::uint32_t i = 0; i < info->argument_count; ++i) types.push_back(info->arguments_info[i].type);
    kept.return_value_metadata = {};
    of.types["call " + text_of(info->name)] =
        info->has_return_value ? static_cast<int>(info->return_value_info->type) : -1;
    for (std::size_t i = 0; i < types.size(); ++i)
        of.types["argument " + std::to_string(i) + " " + text_of(info->name)] = types[i];
    need(!of.methods.count(text_of(info->name)), "a method is registered once");
    of.methods[text_of(info->name)] = kept;
}
void register_property(GDExtensionClassLibraryPtr, GDExtensionConstStringNamePtr name,
                       const GDExtensionPropertyInfo* info, GDExtensionConstStringNamePtr setter,
                       GDExtensionConstStringNamePtr getter) {
    Registered& of = classes.at(text_of(name));
    const std::string property = text_of(info->name);
    need(of.methods.count(text_of(setter)) && of.methods.count(text_of(getter)),
         "setter and getter of " + property + " are registered");
    need(of.methods[text_of(setter)].argument_count == 1 && of.methods[text_of(getter)].argument_count == 0,
         "a setter has one argument");
    need(of.types["call " + text_of(getter)] == static_cast<int>(info->type),
         "the getter returns the type of " + property);
    need(!of.properties.count(property), "a property is registered once");
    of.properties[property] = {text_of(setter), text_of(getter)};
    of.types[property] = static_cast<int>(info->type);
}
void register_signal(GDExtensionClassLibraryPtr, GDExtensionConstStringNamePtr name,
                     GDExtensionConstStringNamePtr which, const GDExtensionPropertyInfo*, GDExtensionInt count) {
    need(count == 1, "the signal has one argument");
    classes.at(text_of(name)).signals_.push_back(text_of(which));
}
void unregister_class(GDExtensionClassLibraryPtr, GDExtensionConstStringNamePtr name) {
    need(classes.erase(text_of(name)) == 1, "a registered class is unregistered");
}

std::string missing_function;
GDExtensionInterfaceFunctionPtr function_named(const char* name) {
    // Each type is that of the published header: an assignment of another does not compile.
#define ENTRY(published, type, own)                                           \
    if (std::strcmp(name, published) == 0 && missing_function != published) { \
        const GDExtensionInterface##type function = own;                      \
        return reinterpret_cast<GDExtensionInterfaceFunctionPtr>(function);   \
    }
    ENTRY("print_error", PrintError, print_error)
    ENTRY("variant_new_nil", VariantNewNil, variant_new_nil)
    ENTRY("variant_new_copy", VariantNewCopy, variant_new_copy)
    ENTRY("variant_destroy", VariantDestroy, variant_destroy)
    ENTRY("variant_get_type", VariantGetType, variant_get_type)
    ENTRY("variant_call", VariantCall, variant_call)
    ENTRY("variant_set_keyed", VariantSetKeyed, variant_set_keyed)
    ENTRY("variant_get_keyed", VariantGetKeyed, variant_get_keyed)
    ENTRY("get_variant_from_type_constructor", GetVariantFromTypeConstructor, from_type_constructor)
    ENTRY("get_variant_to_type_constructor", GetVariantToTypeConstructor, to_type_constructor)
    ENTRY("variant_get_ptr_constructor", VariantGetPtrConstructor, constructor)
    ENTRY("variant_get_ptr_destructor", VariantGetPtrDestructor, destructor)
    ENTRY("string_new_with_utf8_chars_and_len", StringNewWithUtf8CharsAndLen, string_new)
    ENTRY("string_to_utf8_chars", StringToUtf8Chars, string_to_utf8)
    ENTRY("packed_byte_array_operator_index", PackedByteArrayOperatorIndex, bytes_index)
    ENTRY("packed_int32_array_operator_index", PackedInt32ArrayOperatorIndex, ints_index)
    ENTRY("packed_float32_array_operator_index", PackedFloat32ArrayOperatorIndex, floats_index)
    ENTRY("packed_vector3_array_operator_index", PackedVector3ArrayOperatorIndex, vectors_index)
    ENTRY("ref_set_object", RefSetObject, ref_set_object)
    ENTRY("global_get_singleton", GlobalGetSingleton, global_get_singleton)
    ENTRY("object_set_instance", ObjectSetInstance, object_set_instance)
    ENTRY("classdb_construct_object", ClassdbConstructObject, construct_object)
    ENTRY("classdb_register_extension_class", ClassdbRegisterExtensionClass, register_class)
    ENTRY("classdb_register_extension_class_method", ClassdbRegisterExtensionClassMethod, register_method)
    ENTRY("classdb_register_extension_class_property", ClassdbRegisterExtensionClassProperty, register_property)
    ENTRY("classdb_register_extension_class_signal", ClassdbRegisterExtensionClassSignal, register_signal)
    ENTRY("classdb_unregister_extension_class", ClassdbUnregisterExtensionClass, unregister_class)
#undef ENTRY
    return nullptr;
}

// ---- a script

Var call_method(Thing& it, const std::string& method, const std::vector<Var>& arguments, bool by_pointers) {
    Registered& of = classes.at(it.extension_class);
    const auto found = of.methods.find(method);
    need(found != of.methods.end(), it.extension_class + " has " + method);
    const GDExtensionClassMethodInfo& info = found->second;
    Var result;
    if (!by_pointers) {
        std::vector<GDExtensionConstVariantPtr> pointers;
        for (const Var& argument : arguments) pointers.push_back(&argument);
        GDExtensionCallError error{};
        info.call_func(info.method_userdata, it.instance, pointers.data(),
                       static_cast<GDExtensionInt>(pointers.size()), &result, &error);
        if (error.error != GDEXTENSION_CALL_OK) return made("error " + std::to_string(error.error));
        return result;
    }
    // As Object::validated_call(): arguments and result are values of their types.
    std::vector<std::array<unsigned char, 64>> typed(arguments.size());
    std::vector<GDExtensionConstTypePtr> pointers;
    std::vector<Var> kept = arguments;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const int type = of.types.at("argument " + std::to_string(i) + " " + method);
        if (type == t_nil)
            pointers.push_back(&kept[i]);
        else
            to_type_constructor(static_cast<GDExtensionVariantType>(type))(typed[i].data(), &kept[i]),
                pointers.push_back(typed[i].data());
    }
    const int type = of.types.at("call " + method);
    std::array<unsigned char, 64> returned{};
    if (type > 0 && type != t_object)
        constructor(static_cast<GDExtensionVariantType>(type), 0)(returned.data(), nullptr);
    info.ptrcall_func(info.method_userdata, it.instance, pointers.data(),
                      type < 0        ? nullptr
                      : type == t_nil ? static_cast<void*>(&result)
                                      : returned.data());
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const int argument = of.types.at("argument " + std::to_string(i) + " " + method);
        if (const auto free = argument == t_nil ? nullptr : destructor(static_cast<GDExtensionVariantType>(argument)))
            free(typed[i].data());
    }
    if (type == t_object) {
        result.type = t_object;
        std::memcpy(&result.thing, returned.data(), sizeof result.thing);  // with its reference
    } else if (type > 0) {
        from_type_constructor(static_cast<GDExtensionVariantType>(type))(&result, returned.data());
        if (const auto free = destructor(static_cast<GDExtensionVariantType>(type))) free(returned.data());
    }
    return result;
}
void set(Thing& it, const std::string& property, const Var& value, bool by_pointers = false) {
    const auto& found = classes.at(it.extension_class).properties;
    need(found.count(property), it.extension_class + " has the property " + property);
    call_method(it, found.at(property)[0], {value}, by_pointers);
}
Var get(Thing& it, const std::string& property, bool by_pointers = false) {
    return call_method(it, classes.at(it.extension_class).properties.at(property)[1], {}, by_pointers);
}
void run_virtual(Thing& it, const std::string& method, double seconds) {
    if (it.extension_class.empty()) return;
    const GDExtensionClassCreationInfo& info = classes.at(it.extension_class).info;
    Interned* name = name_of(method);
    const GDExtensionClassCallVirtual function = info.get_virtual_func(info.class_userdata, &name);
    release_name(name);
    const GDExtensionConstTypePtr arguments[] = {&seconds};
    if (function) function(it.instance, arguments, nullptr);
}
Thing* instantiate(const std::string& class_name, const std::string& name) {
    const GDExtensionClassCreationInfo& info = classes.at(class_name).info;
    auto* it = static_cast<Thing*>(info.create_instance_func(info.class_userdata));
    need(it->instance && it->extension_class == class_name && it->class_name == classes.at(class_name).parent,
         class_name + " has an instance");
    it->name = name;
    return it;
}
void add_child(Thing* parent, Thing* child) {
    parent->children.push_back(child);
    child->parent = parent;
    child->is_in_tree = true;
    run_virtual(*child, "_enter_tree", 0);
}
void queue_free(Thing* it) {
    for (Thing* child : std::vector<Thing*>(it->children)) queue_free(child);
    run_virtual(*it, "_exit_tree", 0);
    it->is_in_tree = false;
    if (it->parent) std::erase(it->parent->children, it);
    if (!it->extension_class.empty()) {
        const GDExtensionClassCreationInfo& info = classes.at(it->extension_class).info;
        info.free_instance_func(info.class_userdata, it->instance);
    }
    delete it;
}
Var dictionary(const std::vector<std::pair<std::string, Var>>& all) {
    Var v;
    v.type = t_table, v.table = new Table;
    for (const auto& [key, value] : all) v.table->all.emplace_back(made(key), value);
    return v;
}
Var vectors(const std::vector<std::array<float, 3>>& all) {
    return buffer_of(t_vectors, all.data(), 12 * all.size());
}

/// A closed box with the engine's clockwise faces.
Var box_mesh(float x, float y, float z) {
    std::vector<std::array<float, 3>> corners;
    for (const float a : {-x, x})
        for (const float b : {-y, y})
            for (const float c : {-z, z}) corners.push_back({a / 2, b / 2, c / 2});
    const int faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                              {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    std::vector<std::int32_t> numbers;
    for (const auto& [a, b, c] : faces) numbers.insert(numbers.end(), {a, c, b});
    std::vector<Var> arrays(13);
    arrays[0] = vectors(corners);
    arrays[12] = buffer_of(t_ints, numbers.data(), 4 * numbers.size());
    Thing* mesh = construct_thing("ArrayMesh");
    Var value;
    from_type<t_object>(&value, &mesh);
    mesh->values["arrays"] = list_of(arrays);
    return value;
}

/// Every edge of the mesh but those of its border belongs to two triangles, once in each direction, and the triangles
/// have the area of the square. Each has its front above.
void need_watertight(const Var& arrays, double side_m) {
    const auto vertices = elements<std::array<float, 3>>(arrays.list->all[0]);
    const auto numbers = elements<std::int32_t>(arrays.list->all[12]);
    std::map<std::pair<int, int>, int> edges;
    double area = 0;
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
        const auto &a = vertices.at(static_cast<std::size_t>(numbers[i])),
                   &b = vertices.at(static_cast<std::size_t>(numbers[i + 1])),
                   &c = vertices.at(static_cast<std::size_t>(numbers[i + 2]));
        const double twice = double(b[0] - a[0]) * double(c[2] - a[2]) - double(b[2] - a[2]) * double(c[0] - a[0]);
        need(twice > 0, "each triangle is clockwise as seen from above");
        area += twice / 2;
        for (std::size_t k = 0; k < 3; ++k)
            need(++edges[{numbers[i + k], numbers[i + (k + 1) % 3]}] == 1, "an edge has one triangle on a side");
    }
    const double far = 20 * side_m;  // of the skirt
    need(std::fabs(area - far * far) < 1e-6 * far * far, "the triangles cover the square once");
    std::size_t border = 0;
    for (const auto& [edge, count] : edges) {
        if (edges.count({edge.second, edge.first})) continue;
        ++border;
        const auto &a = vertices.at(static_cast<std::size_t>(edge.first)),
                   &b = vertices.at(static_cast<std::size_t>(edge.second));
        for (const auto& at : {a, b})
            need(std::max(std::fabs(at[0]), std::fabs(at[2])) > 0.49 * far,
                 "the only open edges are those of the border");
    }
    need(border > 0, "the mesh has a border");
}

double of_half(std::uint16_t half) {
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    const double size = exponent ? std::ldexp(1024 + mantissa, exponent - 25) : std::ldexp(mantissa, -24);
    return half & 0x8000 ? -size : size;
}

/// What sea.gdshader's vertex() computes at mip 0 from the material's uniforms and textures lies on the surface that
/// height_at() returns. Half floats have 11 bits: heights of up to 2 m are exact to 0.5 mm, and so are displacements.
void need_drawn_surface(Thing& ocean, Thing& sea, Thing& material) {
    const std::vector<Var>& images = material.values.at("displacement").thing->values.at("images").list->all;
    for (const std::array<double, 2> rest : {std::array{0.0, 0.0}, {3.3, -7.1}, {-20.4, 11.9}, {5.0, 30.2}}) {
        std::array<double, 3> moved{};
        for (std::size_t cascade = 0; cascade < images.size(); ++cascade) {
            const auto texels = elements<std::uint16_t>(images[cascade].thing->values.at("data"));
            const int n = static_cast<int>(std::lround(std::sqrt(static_cast<double>(texels.size()) / 4)));
            const float* const place = material.values.at("cascade_place_" + std::to_string(cascade)).floats;
            // Texture coordinates less half a texel, in texels.
            const double u = (double{place[0]} + double{place[2]} * rest[0] + double{place[3]} * rest[1]) * n - 0.5;
            const double v = (double{place[1]} + double{place[2]} * rest[1] - double{place[3]} * rest[0]) * n - 0.5;
            const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
            for (const auto& [column, row, weight] : {std::tuple{i, j, (i + 1 - u) * (j + 1 - v)},
                                                      {i + 1, j, (u - i) * (j + 1 - v)},
                                                      {i, j + 1, (i + 1 - u) * (v - j)},
                                                      {i + 1, j + 1, (u - i) * (v - j)}})
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const int at = ((row % n + n) % n * n + (column % n + n) % n) * 4;
                    moved[axis] += weight * of_half(texels[static_cast<std::size_t>(at) + axis]);
                }
        }
        const double x = double{sea.pose[9]} + rest[0] + moved[0], z = double{sea.pose[11]} + rest[1] + moved[2];
        const double height = double{sea.pose[10]} + moved[1];
        const double queried =
            number(call_method(ocean, "height_at", {vector(static_cast<float>(x), 0, static_cast<float>(z))}));
        if (!(std::fabs(height - queried) < 2e-3))
            fail("the drawn height is " + std::to_string(height) + ", the queried one " + std::to_string(queried));
    }
}

void run(const char* library_file, int cycle, int cycles) {
    void* const library = dlopen(library_file, RTLD_NOW | RTLD_LOCAL);
    if (!library) fail(std::string("cannot load the library: ") + dlerror());
    const auto entry_point =
        reinterpret_cast<GDExtensionInitializationFunction>(dlsym(library, "pelagic_godot4_init"));
    need(entry_point != nullptr, "the library has pelagic_godot4_init");
    GDExtensionInitialization initialization{};
    if (!entry_point(function_named, &library_token, &initialization)) fail("the library refused");
    need(initialization.minimum_initialization_level == GDEXTENSION_INITIALIZATION_SCENE,
         "the classes are those of scenes");
    for (int level = 0; level <= 3; ++level)
        initialization.initialize(initialization.userdata, static_cast<GDExtensionInitializationLevel>(level));
    need(classes.size() == 4, "four classes");
    const bool is_last = cycle + 1 == cycles;
    if (is_last)
        for (const auto& [name, of] : classes)
            std::printf("class %s %s %zu properties\n", name.c_str(), of.parent.c_str(), of.properties.size());

    engine_singleton = new Thing;
    engine_singleton->class_name = "Engine";
    root = new Thing;
    root->class_name = "Window";
    root->is_in_tree = true;
    camera = construct_thing("Camera3D");
    add_child(root, camera);
    camera->pose[9] = 100, camera->pose[10] = 5, camera->pose[11] = -30;

    Thing* ocean = instantiate("PelagicOcean", "ocean");
    set(*ocean, "preset", made("moderate"));
    // The last cycle's results are compared with those of the library; the others have small seas and few steps.
    if (!is_last) set(*ocean, "resolution", made(std::int64_t{32}));
    set(*ocean, "threads", made(std::int64_t{1}));
    set(*ocean, "time_s", made(12.34), true);
    add_child(root, ocean);
    const std::string hash = text(call_method(*ocean, "hash", {}));
    const Var place = vector(10, 0, 20);
    const double height = number(call_method(*ocean, "height_at", {place})),
                 typed = number(call_method(*ocean, "height_at", {place}, true));
    need(height == typed, "both kinds of calls give one height");
    const Var answers = call_method(*ocean, "query", {vectors({{10, 0, 20}, {-3, 0, 4000}})}, cycle % 2 == 1);
    const auto heights = elements<float>(entry(answers, "height"));
    need(heights.size() == 2 && double{heights[0]} == height, "query and height_at agree");
    need(entry(answers, "normal").buffer->bytes.size() == 24, "a normal for each place");
    const Var hit = call_method(*ocean, "first_hit", {vector(10, 50, 20), vector(0, -1, 0), made(200.0)});
    need(entry(hit, "hit").boolean && std::fabs(number(entry(hit, "distance")) - (50 - height)) < 1e-3,
         "a ray from above hits the surface");
    if (is_last) std::printf("hash %s\nheight %.9g\n", hash.c_str(), height);

    // Invalid values: one line each, and no change.
    errors.clear();
    set(*ocean, "wind_speed_mps", made(-3.0));
    set(*ocean, "resolution", made(std::int64_t{100}), true);
    set(*ocean, "preset", made("calmest"));
    set(*ocean, "spectrum", made("swell"));
    set(*ocean, "time_s", made(std::nan("")));
    call_method(*ocean, "add_impulse", {dictionary({{"x_m", made(1.0)}})});
    call_method(*ocean, "sample_water", {vectors({{0, -1, 0}})});
    need(errors.size() == 7 && ocean->refused.size() == 7, "seven lines and signals");
    if (is_last)
        for (const std::string& line : errors) std::printf("refused %s\n", line.c_str());
    need(number(get(*ocean, "wind_speed_mps")) == 12 && text(get(*ocean, "spectrum")) == "jonswap",
         "refused values change nothing");
    need(text(call_method(*ocean, "height_at", {})) == "error 4" &&
             text(call_method(*ocean, "height_at", {made("north")})) == "error 2",
         "calls with other arguments are errors of the engine");
    need(text(call_method(*ocean, "hash", {})) == hash, "the sea is as before");

    // Every property takes the value that it has.
    for (const auto& [name, of] : classes) {
        Thing* it = instantiate(name, "any");
        errors.clear();
        for (const auto& [property, methods] : of.properties)
            for (const bool by_pointers : {false, true}) {
                const Var value = get(*it, property, by_pointers);
                need(value.type == of.types.at(property) || of.types.at(property) == t_nil ||
                         of.types.at(property) == t_object,
                     property + " has its type");
                set(*it, property, value, by_pointers);
            }
        for (const std::string& line : errors) std::printf("%s\n", line.c_str());
        need(errors.empty(), "defaults are valid");
        queue_free(it);
    }

    // Dynamic waves, depth, and a hull with a wake.
    set(*ocean, "preset", made("custom"));
    set(*ocean, "wind_direction_deg", made(30.0));
    need(number(get(*ocean, "wind_direction_deg")) == 30, "degrees are as they were set");
    set(*ocean, "resolution", made(std::int64_t{32}));
    set(*ocean, "depth", made(true), true);
    set(*ocean, "dynamic_waves", made(true));
    set(*ocean, "dynamic_waves_resolution", made(std::int64_t{64}));
    set(*ocean, "playing", made(false));
    const std::int64_t source =
        call_method(
            *ocean, "add_source",
            {dictionary(
                {{"shape", made("hull")}, {"x_m", made(3.0)}, {"height_m", made(-0.2)}, {"length_m", made(2.0)}})})
            .whole;
    call_method(*ocean, "remove_source", {made(source)});
    errors.clear();
    call_method(*ocean, "add_source", {dictionary({{"speed", made(3.0)}})});
    call_method(*ocean, "set_rain", {dictionary({{"drops_per_m2_s", made(1.0)}})}, true);
    need(errors.size() == 1, "an unknown key is refused");
    if (is_last) std::printf("refused %s\n", errors[0].c_str());

    Thing* hull = instantiate("PelagicHull", "hull");
    add_child(ocean, hull);
    const Var mesh = box_mesh(4, 1, 2);
    set(*hull, "mesh", mesh, true);
    need(get(*hull, "mesh", true).thing == mesh.thing, "the mesh is kept");
    set(*hull, "mass_kg", made(0.3 * 8 * 1025));
    set(*hull, "centre_of_mass_m", vector(0, -0.25f, 0));
    set(*hull, "force_n", vector(500, 0, 0));
    errors.clear();
    for (int tick = 0; tick < (is_last ? 60 : 6); ++tick) {
        set(*ocean, "time_s", made(tick / 60.0));
        need(call_method(*hull, "step", {made(1 / 60.0)}, tick % 2 == 0).boolean, "a step is whole");
    }
    need(errors.empty(), "the steps have no errors");
    const Var info = call_method(*hull, "info", {}), state = call_method(*hull, "state", {});
    // A box of 0.3 of its volume: the draught is 0.3 of its height of 1 m.
    need(std::fabs(number(entry(info, "draught_m")) - 0.3) < 1e-9, "the draught of a box");
    need(number(entry(state, "displaced_m3")) > 1, "the hull displaces water");
    const Var saved = call_method(*hull, "save_state", {}), at = entry(state, "position_m");
    call_method(*hull, "step", {made(0.5)});
    call_method(*hull, "restore_state", {saved});
    need(std::memcmp(entry(call_method(*hull, "state", {}), "position_m").floats, at.floats, 12) == 0,
         "a restored hull is where it was");
    const float* const position = at.floats;
    if (is_last)
        std::printf("hull %.9g %.9g %.9g\nwaves %s\n", double{position[0]}, double{position[1]}, double{position[2]},
                    text(call_method(*ocean, "dynamic_waves_hash", {})).c_str());
    call_method(*hull, "shift", {made(10.0), made(0.0)});
    call_method(*ocean, "set_origin", {made(-10.0), made(0.0)});

    // A buoy and the mesh, in frames of the engine.
    Thing* buoy = instantiate("PelagicBuoy", "buoy");
    set(*buoy, "tilts", made(true));
    add_child(ocean, buoy);
    buoy->pose[9] = 7;
    Thing* sea = instantiate("PelagicMesh", "sea");
    set(*sea, "quality", made("low"));
    Thing* material = construct_thing("ShaderMaterial");
    from_type<t_object>(&sea->values["material_override"], &material);
    add_child(ocean, sea);
    set(*ocean, "playing", made(true));
    for (int frame = 0; frame < 3; ++frame)
        for (Thing* node : {ocean, buoy, sea}) run_virtual(*node, "_process", 1 / 60.0);
    run_virtual(*hull, "_physics_process", 1 / 60.0);
    need(double{buoy->pose[10]} == number(call_method(*ocean, "height_at", {vector(7, 0, 0)})),
         "the buoy is on the surface");
    need(sea->pose[9] == 104 || std::fabs(sea->pose[9] - 100) <= 8, "the mesh is at the camera");
    for (const char* texture : {"displacement", "slopes", "moments", "snapshots"})
        need(material->values[texture].type == t_object, std::string("the material has ") + texture);
    const Var drawn = sea->values["mesh"].thing->values["arrays"];
    const Var arrays = call_method(*sea, "surface_arrays", {}, true);
    need(arrays.list->all.size() == 13, "the arrays of a surface");
    if (is_last) need_watertight(drawn, 2048), need_watertight(arrays, 2048);
    if (is_last)
        for (const auto& [name, value] : material->values)
            if (name != "init_ref") std::printf("uniform %s\n", name.c_str());
    need(errors.empty(), "the frames have no errors");

    // A plane beach, whose depth is linear, and spray.
    Thing* beach = instantiate("PelagicOcean", "beach");
    std::vector<float> floor;
    for (int z = 0; z < 32; ++z)
        for (int x = 0; x < 32; ++x) floor.push_back(-20 + 1.25f * static_cast<float>(x));
    set(*beach, "shore_heights_m", buffer_of(t_floats, floor.data(), 4 * floor.size()), true);
    set(*beach, "shore_columns", made(std::int64_t{32}));
    set(*beach, "shore_rows", made(std::int64_t{32}));
    set(*beach, "shore_metres_per_sample", made(8.0));
    set(*beach, "shore_resolution", made(std::int64_t{64}));
    set(*beach, "resolution", made(std::int64_t{32}));
    set(*beach, "spray", made(true));
    const Var shallow = call_method(*beach, "query", {vectors({{40, 0, 100}, {60, 0, 100}})});
    const auto depths = elements<float>(entry(shallow, "depth"));
    // In texels of 4 m that the floor's 8 m are whole multiples of.
    need(std::fabs(depths[0] - 13.75f) < 0.05f && std::fabs(depths[1] - 10.625f) < 0.05f,
         "the depth of a plane beach");
    call_method(*beach, "set_spray_center", {vector(40, 0, 100)});
    call_method(*beach, "emit_spray",
                {dictionary({{"count", made(std::int64_t{7})}, {"y_m", made(5.0)}, {"x_m", made(40.0)}})});
    set(*beach, "time_s", made(0.1));
    need(elements<float>(entry(call_method(*beach, "droplets", {}, true), "radius")).size() >= 7,
         "droplets of the emitter");
    call_method(*beach, "restore_spray", {call_method(*beach, "save_spray", {}, true)});
    for (const std::string& line : errors) std::printf("%s\n", line.c_str());
    need(errors.empty(), "the beach has no errors");
    queue_free(beach);

    // The drawn surface, with a sea level, a current and another origin.
    Thing* plain = instantiate("PelagicOcean", "plain");
    add_child(root, plain);
    for (const auto& [property, value] : {std::pair{"wind_speed_mps", 8.0},
                                          {"sea_level_m", 1.5},
                                          {"current_x_mps", 0.5},
                                          {"current_z_mps", -0.25},
                                          {"time_s", 20.0},
                                          {"resolution", 64.0}})
        set(*plain, property, made(value));
    set(*plain, "playing", made(false));
    call_method(*plain, "set_origin", {made(30.0), made(-7.0)});
    Thing* drawing = instantiate("PelagicMesh", "drawing");
    set(*drawing, "quality", made("low"));
    Thing* paint = construct_thing("ShaderMaterial");
    from_type<t_object>(&drawing->values["material_override"], &paint);
    add_child(plain, drawing);
    for (const double time_s : {20.0, 21.5}) {
        set(*plain, "time_s", made(time_s));
        run_virtual(*drawing, "_process", 1 / 60.0);
        need_drawn_surface(*plain, *drawing, *paint);
    }

    // A hull whose ocean is freed first, and a buoy without an ocean: one line, not one a frame.
    Thing* alone = instantiate("PelagicBuoy", "alone");
    add_child(root, alone);
    for (int frame = 0; frame < 3; ++frame) run_virtual(*alone, "_process", 1 / 60.0);
    need(alone->refused.size() == 1, "a reason is reported once");
    if (is_last) std::printf("refused PelagicBuoy: %s\n", alone->refused[0].c_str());
    is_editor = true;
    errors.clear();
    Thing* edited = instantiate("PelagicBuoy", "edited");
    add_child(root, edited);
    run_virtual(*edited, "_process", 1 / 60.0);
    need(errors.empty() && edited->refused.empty(), "the editor runs no node");
    is_editor = false;
    queue_free(root);
    root = nullptr;
    delete engine_singleton;
    for (int level = 3; level >= 0; --level)
        initialization.deinitialize(initialization.userdata, static_cast<GDExtensionInitializationLevel>(level));
    need(classes.empty(), "all classes are unregistered");
    dlclose(library);
}

}  // namespace

int main(int count, char** arguments) {
    const int cycles = std::atoi(arguments[2]);
    const std::string option = count > 3 ? arguments[3] : "";
    if (option == "GODOT_4_0") {
        // The engine passes a struct that begins with its version.
        static const std::uint32_t version[64] = {4, 0, 3};
        void* const library = dlopen(arguments[1], RTLD_NOW);
        if (!library) fail(dlerror());
        GDExtensionInitialization initialization{};
        const auto entry_point =
            reinterpret_cast<GDExtensionInitializationFunction>(dlsym(library, "pelagic_godot4_init"));
        return entry_point(reinterpret_cast<GDExtensionInterfaceGetProcAddress>(const_cast<std::uint32_t*>(version)),
                           &library_token, &initialization)
                   ? 0
                   : 1;
    }
    missing_function = option;
    std::size_t settled = 0;
    for (int cycle = 0; cycle < cycles; ++cycle) {
        run(arguments[1], cycle, cycles);
        if (live != 0) fail(std::to_string(live) + " values are left over");
        // Allocators and thread pools keep memory of the first cycles.
        if (cycle == 9) settled = mallinfo2().uordblks;
    }
    if (cycles > 10)
        std::printf("grown %ld bytes\n", static_cast<long>(mallinfo2().uordblks) - static_cast<long>(settled));
    return 0;
}
