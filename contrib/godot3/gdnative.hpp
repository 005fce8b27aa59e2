// Declarations of Godot 3.2's C interface GDNative that this library uses. No package provides its
// headers, so these declarations follow the engine's description (gdnative_api.json).
//
// The engine provides one table of functions, whose order is fixed within a major version; later
// versions append further tables. A function is therefore identified by its index in the table and
// its type.
#pragma once

#include <cstdint>

namespace pelagic::godot {

// Opaque values of the engine with the engine's sizes. They are plain bytes without alignment, as
// the engine declares them: its structs have that layout, and it passes some by value. A class, or
// floats instead of bytes, would be passed in other registers.
struct Variant {
    std::uint8_t bytes[24];
};
struct String {
    std::uint8_t bytes[8];
};
struct CharString {
    std::uint8_t bytes[8];
};
struct Array {
    std::uint8_t bytes[8];
};
struct Dictionary {
    std::uint8_t bytes[8];
};
struct PoolArray {  // PoolByteArray, PoolIntArray, PoolRealArray, PoolVector3Array
    std::uint8_t bytes[8];
};
struct Rid {
    std::uint8_t bytes[8];
};
struct NodePath {
    std::uint8_t bytes[8];
};
struct Vector3Bytes {
    std::uint8_t bytes[12];
};
struct Access;      // to the elements of a pool array
struct Object;      // of any class
struct MethodBind;  // a method of a class

// Values with known members, which are passed by pointer only.
struct Vector2 {
    float x, y;
};
struct Vector3 {
    float x, y, z;
};
struct Vector4 {  // Quat
    float x, y, z, w;
};
struct Basis {
    Vector3 row[3];
};
struct Transform {
    Basis basis;
    Vector3 origin;
};
struct Box {  // AABB
    Vector3 corner, size;
};

enum VariantType : int {
    type_nil = 0,
    type_bool = 1,
    type_int = 2,
    type_real = 3,
    type_string = 4,
    type_vector3 = 7,
    type_node_path = 15,
    type_object = 17,
    type_dictionary = 18,
    type_pool_byte_array = 20,
    type_pool_int_array = 21,
    type_pool_real_array = 22,
    type_pool_vector3_array = 25
};

struct CallError {
    int error, argument, expected;
};

using Function = void (*)();
struct ApiVersion {
    unsigned major, minor;
};
/// The beginning of every table.
struct ApiTable {
    unsigned type;  ///< 0 core, 1 NativeScript
    ApiVersion version;
    const ApiTable* next;
};
inline constexpr unsigned nativescript_api = 1;
inline constexpr int core_functions = 744;
struct CoreApi {
    ApiTable table;
    unsigned extension_count;
    const ApiTable** extensions;
    Function functions[core_functions];
};

/// A function of the table.
template <class Signature>
struct CoreFunction {
    int number;
};

namespace core {

inline constexpr CoreFunction<void(PoolArray*)> pool_byte_array_new{155}, pool_int_array_new{171},
    pool_real_array_new{187}, pool_vector3_array_new{235};
inline constexpr CoreFunction<void(PoolArray*, int)> pool_byte_array_resize{164}, pool_int_array_resize{180},
    pool_real_array_resize{196}, pool_vector3_array_resize{244};
inline constexpr CoreFunction<Access*(PoolArray*)> pool_byte_array_write{166}, pool_int_array_write{182},
    pool_real_array_write{198}, pool_vector3_array_write{246};
inline constexpr CoreFunction<void(PoolArray*)> pool_byte_array_destroy{170}, pool_int_array_destroy{186},
    pool_real_array_destroy{202}, pool_vector3_array_destroy{250};
inline constexpr CoreFunction<void*(const Access*)> pool_byte_array_write_access_ptr{296},
    pool_int_array_write_access_ptr{300}, pool_real_array_write_access_ptr{304},
    pool_vector3_array_write_access_ptr{316};
inline constexpr CoreFunction<void(Access*)> pool_byte_array_write_access_destroy{298},
    pool_int_array_write_access_destroy{302}, pool_real_array_write_access_destroy{306},
    pool_vector3_array_write_access_destroy{318};
inline constexpr CoreFunction<Access*(const PoolArray*)> pool_byte_array_read{165}, pool_int_array_read{181},
    pool_real_array_read{197}, pool_vector3_array_read{245};
inline constexpr CoreFunction<int(const PoolArray*)> pool_byte_array_size{169}, pool_int_array_size{185},
    pool_real_array_size{201}, pool_vector3_array_size{249};
inline constexpr CoreFunction<const void*(const Access*)> pool_byte_array_read_access_ptr{268},
    pool_int_array_read_access_ptr{272}, pool_real_array_read_access_ptr{276},
    pool_vector3_array_read_access_ptr{288};
inline constexpr CoreFunction<void(Access*)> pool_byte_array_read_access_destroy{270},
    pool_int_array_read_access_destroy{274}, pool_real_array_read_access_destroy{278},
    pool_vector3_array_read_access_destroy{290};

inline constexpr CoreFunction<void(Array*)> array_new{323}, array_destroy{361};
inline constexpr CoreFunction<void(Array*, const Variant*)> array_append{336};
inline constexpr CoreFunction<int(const Array*)> array_size{356};
inline constexpr CoreFunction<Variant(const Array*, int)> array_get{333};
inline constexpr CoreFunction<void(Dictionary*)> dictionary_new{362}, dictionary_destroy{364};
inline constexpr CoreFunction<void(Dictionary*, const Variant*, const Variant*)> dictionary_set{375};
inline constexpr CoreFunction<bool(const Dictionary*, const Variant*)> dictionary_has{368};
inline constexpr CoreFunction<Variant(const Dictionary*, const Variant*)> dictionary_get{374};
inline constexpr CoreFunction<Array(const Dictionary*)> dictionary_keys{372};
inline constexpr CoreFunction<void(NodePath*, const String*)> node_path_new{381};
inline constexpr CoreFunction<void(NodePath*)> node_path_destroy{383};

inline constexpr CoreFunction<VariantType(const Variant*)> variant_get_type{507};
inline constexpr CoreFunction<void(Variant*, const Variant*)> variant_new_copy{508};
inline constexpr CoreFunction<void(Variant*)> variant_new_nil{509}, variant_destroy{570};
inline constexpr CoreFunction<void(Variant*, bool)> variant_new_bool{510};
inline constexpr CoreFunction<void(Variant*, std::int64_t)> variant_new_int{512};
inline constexpr CoreFunction<void(Variant*, double)> variant_new_real{513};
inline constexpr CoreFunction<void(Variant*, const String*)> variant_new_string{514};
inline constexpr CoreFunction<void(Variant*, const Vector3*)> variant_new_vector3{517};
inline constexpr CoreFunction<void(Variant*, const Vector4*)> variant_new_quat{520};
inline constexpr CoreFunction<void(Variant*, const NodePath*)> variant_new_node_path{525};
inline constexpr CoreFunction<void(Variant*, const Rid*)> variant_new_rid{526};
inline constexpr CoreFunction<void(Variant*, const Dictionary*)> variant_new_dictionary{528};
inline constexpr CoreFunction<void(Variant*, const PoolArray*)> variant_new_pool_byte_array{530},
    variant_new_pool_int_array{531}, variant_new_pool_real_array{532}, variant_new_pool_vector3_array{535};
inline constexpr CoreFunction<bool(const Variant*)> variant_as_bool{537};
inline constexpr CoreFunction<double(const Variant*)> variant_as_real{540};
inline constexpr CoreFunction<String(const Variant*)> variant_as_string{541};
inline constexpr CoreFunction<Vector3Bytes(const Variant*)> variant_as_vector3{544};
inline constexpr CoreFunction<NodePath(const Variant*)> variant_as_node_path{552};
inline constexpr CoreFunction<Object*(const Variant*)> variant_as_object{554};
inline constexpr CoreFunction<Dictionary(const Variant*)> variant_as_dictionary{555};
inline constexpr CoreFunction<PoolArray(const Variant*)> variant_as_pool_byte_array{557},
    variant_as_pool_int_array{558}, variant_as_pool_real_array{559}, variant_as_pool_vector3_array{562};

inline constexpr CoreFunction<const char*(const CharString*)> char_string_get_data{572};
inline constexpr CoreFunction<void(CharString*)> char_string_destroy{573};
inline constexpr CoreFunction<CharString(const String*)> string_utf8{678};
inline constexpr CoreFunction<String(const char*, int)> string_chars_to_utf8_with_len{682};
inline constexpr CoreFunction<void(String*)> string_destroy{721};

inline constexpr CoreFunction<void(Object*)> object_destroy{730};
inline constexpr CoreFunction<Object*(const char*)> global_get_singleton{731};
inline constexpr CoreFunction<MethodBind*(const char*, const char*)> method_bind_get_method{732};
inline constexpr CoreFunction<void(MethodBind*, Object*, const void**, void*)> method_bind_ptrcall{733};
inline constexpr CoreFunction<Variant(MethodBind*, Object*, const Variant**, int, CallError*)> method_bind_call{734};
using Constructor = Object* (*)();
inline constexpr CoreFunction<Constructor(const char*)> get_class_constructor{735};
inline constexpr CoreFunction<void(const String*)> print{743};

}  // namespace core

// ---- NativeScript: classes of a library ------------------------------------------------------

/// A callback, its user data, and the function that frees the user data.
struct CreateFunction {
    void* (*call)(Object* self, void* data);
    void* data;
    void (*free)(void*);
};
struct DestroyFunction {
    void (*call)(Object* self, void* data, void* instance);
    void* data;
    void (*free)(void*);
};
struct MethodFunction {
    Variant (*call)(Object* self, void* data, void* instance, int count, Variant** arguments);
    void* data;
    void (*free)(void*);
};
struct SetFunction {
    void (*call)(Object* self, void* data, void* instance, Variant* value);
    void* data;
    void (*free)(void*);
};
struct GetFunction {
    Variant (*call)(Object* self, void* data, void* instance);
    void* data;
    void (*free)(void*);
};

enum PropertyHint : int { hint_none = 0, hint_range = 1, hint_exp_range = 2, hint_enum = 3, hint_resource_type = 17 };
inline constexpr int usage_default = 7;

struct PropertyAttributes {
    int remote_set;  // 0: never
    int type;        // VariantType
    PropertyHint hint;
    String hint_text;
    int usage;
    Variant default_value;
};
struct SignalArgument {
    String name;
    int type;
    PropertyHint hint;
    String hint_text;
    int usage;
    Variant default_value;
};
struct Signal {
    String name;
    int argument_count;
    SignalArgument* arguments;
    int default_count;
    Variant* defaults;
};
struct MethodAttributes {
    int remote_call;  // 0: never
};

struct NativeScriptApi {
    ApiTable table;
    void (*register_class)(void* library, const char* name, const char* base, CreateFunction, DestroyFunction);
    void (*register_tool_class)(void* library, const char* name, const char* base, CreateFunction, DestroyFunction);
    void (*register_method)(void* library, const char* type, const char* name, MethodAttributes, MethodFunction);
    void (*register_property)(void* library, const char* type, const char* name, PropertyAttributes*, SetFunction,
                              GetFunction);
    void (*register_signal)(void* library, const char* type, const Signal*);
    void* (*get_userdata)(Object* instance);
};

/// The argument of godot_gdnative_init().
struct InitOptions {
    bool in_editor;
    std::uint64_t core_hash, editor_hash, no_hash;
    void (*report_version_mismatch)(const Object* library, const char* what, ApiVersion want, ApiVersion have);
    void (*report_loading_error)(const Object* library, const char* what);
    Object* library;
    const CoreApi* api;
    const String* library_path;
};

}  // namespace pelagic::godot
