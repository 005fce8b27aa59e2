// C++ wrappers of Godot 4's C interface, GDExtension: the engine's functions, and values that own what they hold.
//
// Methods of the engine are called by their names, so the library depends on no hashes of methods and runs in every
// version from 4.1 on. GDEXTENSION_INTERFACE is the path of gdextension_interface.h (CMakeLists.txt).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include GDEXTENSION_INTERFACE

namespace pelagic::godot4 {

using Object = void;
using Type = GDExtensionVariantType;
inline constexpr Type type_nil = GDEXTENSION_VARIANT_TYPE_NIL, type_bool = GDEXTENSION_VARIANT_TYPE_BOOL,
                      type_int = GDEXTENSION_VARIANT_TYPE_INT, type_float = GDEXTENSION_VARIANT_TYPE_FLOAT,
                      type_string = GDEXTENSION_VARIANT_TYPE_STRING, type_vector3 = GDEXTENSION_VARIANT_TYPE_VECTOR3,
                      type_vector4 = GDEXTENSION_VARIANT_TYPE_VECTOR4, type_aabb = GDEXTENSION_VARIANT_TYPE_AABB,
                      type_transform = GDEXTENSION_VARIANT_TYPE_TRANSFORM3D,
                      type_name = GDEXTENSION_VARIANT_TYPE_STRING_NAME,
                      type_path = GDEXTENSION_VARIANT_TYPE_NODE_PATH, type_object = GDEXTENSION_VARIANT_TYPE_OBJECT,
                      type_dictionary = GDEXTENSION_VARIANT_TYPE_DICTIONARY,
                      type_array = GDEXTENSION_VARIANT_TYPE_ARRAY,
                      type_bytes = GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY,
                      type_ints = GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY,
                      type_floats = GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY,
                      type_vectors = GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY,
                      type_any = GDEXTENSION_VARIANT_TYPE_VARIANT_MAX;  ///< a Variant

// Values with known members, of engines with single precision.
struct Vector3 {
    float x, y, z;
};
struct Vector4 {
    float x, y, z, w;
};
struct Transform {  ///< Transform3D
    Vector3 row[3], origin;
};
struct Box {  ///< AABB
    Vector3 corner, size;
};

// Name in the interface, and the name of its type without "GDExtensionInterface".
#define PELAGIC_GODOT_FUNCTIONS(F)                                                      \
    F(print_error, PrintError)                                                          \
    F(variant_new_nil, VariantNewNil)                                                   \
    F(variant_new_copy, VariantNewCopy)                                                 \
    F(variant_destroy, VariantDestroy)                                                  \
    F(variant_get_type, VariantGetType)                                                 \
    F(variant_call, VariantCall)                                                        \
    F(variant_set_keyed, VariantSetKeyed)                                               \
    F(variant_get_keyed, VariantGetKeyed)                                               \
    F(get_variant_from_type_constructor, GetVariantFromTypeConstructor)                 \
    F(get_variant_to_type_constructor, GetVariantToTypeConstructor)                     \
    F(variant_get_ptr_constructor, VariantGetPtrConstructor)                            \
    F(variant_get_ptr_destructor, VariantGetPtrDestructor)                              \
    F(string_new_with_utf8_chars_and_len, StringNewWithUtf8CharsAndLen)                 \
    F(string_to_utf8_chars, StringToUtf8Chars)                                          \
    F(packed_byte_array_operator_index, PackedByteArrayOperatorIndex)                   \
    F(packed_int32_array_operator_index, PackedInt32ArrayOperatorIndex)                 \
    F(packed_float32_array_operator_index, PackedFloat32ArrayOperatorIndex)             \
    F(packed_vector3_array_operator_index, PackedVector3ArrayOperatorIndex)             \
    F(ref_set_object, RefSetObject)                                                     \
    F(global_get_singleton, GlobalGetSingleton)                                         \
    F(object_set_instance, ObjectSetInstance)                                           \
    F(classdb_construct_object, ClassdbConstructObject)                                 \
    F(classdb_register_extension_class, ClassdbRegisterExtensionClass)                  \
    F(classdb_register_extension_class_method, ClassdbRegisterExtensionClassMethod)     \
    F(classdb_register_extension_class_property, ClassdbRegisterExtensionClassProperty) \
    F(classdb_register_extension_class_signal, ClassdbRegisterExtensionClassSignal)     \
    F(classdb_unregister_extension_class, ClassdbUnregisterExtensionClass)

/// The engine's functions.
struct Engine {
#define PELAGIC_GODOT_MEMBER(name, type) GDExtensionInterface##type name = nullptr;
    PELAGIC_GODOT_FUNCTIONS(PELAGIC_GODOT_MEMBER)
#undef PELAGIC_GODOT_MEMBER
    GDExtensionClassLibraryPtr library = nullptr;

    /// Looks up all functions. Returns the name of the first that the engine lacks, or null.
    const char* load(GDExtensionInterfaceGetProcAddress get_function);
};
/// The engine of this process, from the library's initialisation to its end.
extern Engine engine;

/// A String.
class Text {
   public:
    explicit Text(std::string_view utf8) {
        engine.string_new_with_utf8_chars_and_len(&string_, utf8.data(), static_cast<GDExtensionInt>(utf8.size()));
    }
    ~Text() { engine.variant_get_ptr_destructor(type_string)(&string_); }
    Text(const Text&) = delete;
    Text& operator=(const Text&) = delete;
    void* string() { return &string_; }

   private:
    void* string_;
};

/// A StringName. Equal names have equal bytes, because the engine keeps each once.
class Name {
   public:
    explicit Name(std::string_view utf8) {
        Text text(utf8);
        const void* arguments[] = {text.string()};
        engine.variant_get_ptr_constructor(type_name, 2)(&name_, arguments);  // 2: of a String
    }
    ~Name() { engine.variant_get_ptr_destructor(type_name)(&name_); }
    Name(const Name&) = delete;
    Name& operator=(const Name&) = delete;
    void* name() { return &name_; }
    bool is(GDExtensionConstStringNamePtr other) const { return std::memcmp(&name_, other, sizeof name_) == 0; }

   private:
    void* name_;
};
/// Names that the library has used, which live until its end. The engine may load scenes on threads.
class Names {
   public:
    Name& at(std::string_view utf8) {
        const std::lock_guard lock(mutex_);
        const auto found = names_.find(utf8);
        return found == names_.end() ? names_.try_emplace(std::string(utf8), utf8).first->second : found->second;
    }
    void clear() { names_.clear(); }

   private:
    std::mutex mutex_;
    std::map<std::string, Name, std::less<>> names_;
};
extern Names kept_names;
inline Name& named(std::string_view utf8) { return kept_names.at(utf8); }

/// The element types of packed arrays.
template <class Element>
struct Packed;
template <>
struct Packed<std::uint8_t> {
    static constexpr Type type = type_bytes;
    static std::uint8_t* first(void* array) { return engine.packed_byte_array_operator_index(array, 0); }
};
template <>
struct Packed<std::int32_t> {
    static constexpr Type type = type_ints;
    static std::int32_t* first(void* array) { return engine.packed_int32_array_operator_index(array, 0); }
};
template <>
struct Packed<float> {
    static constexpr Type type = type_floats;
    static float* first(void* array) { return engine.packed_float32_array_operator_index(array, 0); }
};
template <>
struct Packed<Vector3> {
    static constexpr Type type = type_vectors;
    static Vector3* first(void* array) {
        return static_cast<Vector3*>(engine.packed_vector3_array_operator_index(array, 0));
    }
};

/// A Variant.
class Value {
   public:
    Value() { engine.variant_new_nil(variant_); }
    Value(bool it) : Value(type_bool, static_cast<GDExtensionBool>(it)) {}
    Value(int it) : Value(static_cast<std::int64_t>(it)) {}
    Value(std::int64_t it) : Value(type_int, it) {}
    Value(double it) : Value(type_float, it) {}
    Value(const Vector3& it) : Value(type_vector3, it) {}
    Value(const Vector4& it) : Value(type_vector4, it) {}
    Value(const Transform& it) : Value(type_transform, it) {}
    Value(const Box& it) : Value(type_aabb, it) {}
    Value(const char* it) : Value(std::string_view(it)) {}
    Value(std::string_view it) {
        Text text(it);
        engine.get_variant_from_type_constructor(type_string)(variant_, text.string());
    }
    Value(const std::string& it) : Value(std::string_view(it)) {}
    Value(const Value& it) { engine.variant_new_copy(variant_, it.variant_); }
    Value& operator=(const Value& it) {
        if (this == &it) return *this;
        engine.variant_destroy(variant_);
        engine.variant_new_copy(variant_, it.variant_);
        return *this;
    }
    ~Value() { engine.variant_destroy(variant_); }

    /// Copies a Variant of the engine.
    static Value of(GDExtensionConstVariantPtr variant) {
        Value value;
        engine.variant_new_copy(value.variant_, variant);  // nil needs no destruction
        return value;
    }
    /// \param typed  a value of a type, as the engine passes it to ptrcalls
    static Value of(Type type, GDExtensionConstTypePtr typed) {
        if (type == type_any) return of(typed);
        Value value;
        engine.get_variant_from_type_constructor(type)(value.variant_, const_cast<void*>(typed));
        return value;
    }
    /// An object: a reference to it, if it is counted.
    static Value object(Object* object) { return of(type_object, &object); }
    static Value made(std::string_view class_name) {
        return object(engine.classdb_construct_object(named(class_name).name()));
    }
    static Value singleton(std::string_view name) { return object(engine.global_get_singleton(named(name).name())); }
    /// The default value of a type.
    static Value empty(Type type) {
        if (type == type_nil || type == type_any || type == type_object) return {};
        Opaque typed;
        engine.variant_get_ptr_constructor(type, 0)(typed.bytes, nullptr);
        Value value = of(type, typed.bytes);
        typed.destroy(type);
        return value;
    }
    static Value path(std::string_view text) {
        Text string(text);
        const void* arguments[] = {string.string()};
        Opaque typed;
        engine.variant_get_ptr_constructor(type_path, 2)(typed.bytes, arguments);  // 2: of a String
        Value value = of(type_path, typed.bytes);
        typed.destroy(type_path);
        return value;
    }
    /// A packed array.
    template <class Element>
    static Value packed(std::span<const Element> elements) {
        constexpr Type type = Packed<Element>::type;
        Opaque array;
        {
            Value sized = empty(type);
            sized.call("resize", static_cast<std::int64_t>(elements.size()));
            engine.get_variant_to_type_constructor(type)(array.bytes, sized.variant_);
        }
        if (!elements.empty())
            std::memcpy(Packed<Element>::first(array.bytes), elements.data(), elements.size_bytes());
        Value value = of(type, array.bytes);
        array.destroy(type);
        return value;
    }
    template <class Element>
    static Value packed(const std::vector<Element>& elements) {
        return packed(std::span<const Element>(elements));
    }

    Type type() const { return engine.variant_get_type(variant_); }
    bool is_nil() const { return type() == type_nil || (type() == type_object && !object()); }  ///< or null
    bool boolean() const { return to<GDExtensionBool>(type_bool) != 0; }
    std::int64_t whole() const { return to<std::int64_t>(type_int); }
    double number() const { return to<double>(type_float); }
    Vector3 vector() const { return to<Vector3>(type_vector3); }
    Transform transform() const { return to<Transform>(type_transform); }
    Object* object() const { return type() == type_object ? to<Object*>(type_object) : nullptr; }
    std::string text() const {
        void* string;
        engine.get_variant_to_type_constructor(type_string)(&string, variant_);
        std::string utf8(static_cast<std::size_t>(engine.string_to_utf8_chars(&string, nullptr, 0)), '\0');
        engine.string_to_utf8_chars(&string, utf8.data(), static_cast<GDExtensionInt>(utf8.size()));
        engine.variant_get_ptr_destructor(type_string)(&string);
        return utf8;
    }
    template <class Element>
    std::vector<Element> elements() const {
        constexpr Type type = Packed<Element>::type;
        std::vector<Element> copy(static_cast<std::size_t>(Value(*this).call("size").whole()));
        if (copy.empty()) return copy;
        Opaque array;
        engine.get_variant_to_type_constructor(type)(array.bytes, variant_);
        std::memcpy(copy.data(), Packed<Element>::first(array.bytes), copy.size() * sizeof(Element));
        array.destroy(type);
        return copy;
    }

    /// Calls a method of the value by its name. Returns nil if that fails, which the engine does not report.
    template <class... Arguments>
    Value call(std::string_view method, const Arguments&... arguments) const {
        const std::array<Value, sizeof...(arguments)> values = {Value(arguments)...};
        std::array<GDExtensionConstVariantPtr, sizeof...(arguments) + 1> pointers{};
        for (std::size_t i = 0; i < values.size(); ++i) pointers[i] = values[i].variant_;
        Value result;
        GDExtensionCallError error{};
        engine.variant_call(variant_, named(method).name(), pointers.data(), sizeof...(arguments), result.variant_,
                            &error);
        return result;
    }
    Value at(const Value& key) const {
        Value value;
        GDExtensionBool is_valid;
        engine.variant_get_keyed(variant_, key.variant_, value.variant_, &is_valid);
        return value;
    }
    /// Sets an entry of a Dictionary.
    Value& set(const Value& key, const Value& value) {
        GDExtensionBool is_valid;
        engine.variant_set_keyed(variant_, key.variant_, value.variant_, &is_valid);
        return *this;
    }
    /// Replaces a value of a type that the engine has initialised.
    void write(Type type, GDExtensionTypePtr typed) const {
        if (type == type_object) return engine.ref_set_object(typed, object());
        if (type == type_any) {
            engine.variant_destroy(typed);
            return engine.variant_new_copy(typed, variant_);
        }
        if (const GDExtensionPtrDestructor destroy = engine.variant_get_ptr_destructor(type)) destroy(typed);
        engine.get_variant_to_type_constructor(type)(typed, variant_);
    }
    GDExtensionVariantPtr variant() const { return variant_; }

   private:
    /// Room for a value of any type but Variant and Projection.
    struct Opaque {
        alignas(8) unsigned char bytes[64];
        void destroy(Type type) {
            if (const GDExtensionPtrDestructor run = engine.variant_get_ptr_destructor(type)) run(bytes);
        }
    };
    template <class T>
    Value(Type type, T typed) {
        engine.get_variant_from_type_constructor(type)(variant_, &typed);
    }
    template <class T>
    T to(Type type) const {
        T typed;
        engine.get_variant_to_type_constructor(type)(&typed, variant_);
        return typed;
    }
    // The engine's interface has no const: its functions do not change what they read.
    alignas(8) mutable unsigned char variant_[40];  ///< 24 bytes, with double precision 40
};

}  // namespace pelagic::godot4
