// C++ wrappers of the engine's values and methods: owned, typed, and looked up once.
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "pelagic/contrib/godot3/gdnative.hpp"

namespace pelagic::godot {

/// The engine's functions of this process. Set them before any other use of this header.
void set_core_api(const CoreApi* api);
const CoreApi& core_table();

template <class Result, class... Arguments>
Result call(CoreFunction<Result(Arguments...)> function, std::type_identity_t<Arguments>... arguments) {
    return reinterpret_cast<Result (*)(Arguments...)>(core_table().functions[function.number])(arguments...);
}

/// A String.
class Text {
   public:
    explicit Text(std::string_view utf8)
        : string_(call(core::string_chars_to_utf8_with_len, utf8.data(), static_cast<int>(utf8.size()))) {}
    explicit Text(const Variant& of) : string_(call(core::variant_as_string, &of)) {}
    ~Text() { call(core::string_destroy, &string_); }
    Text(const Text&) = delete;
    Text& operator=(const Text&) = delete;

    std::string utf8() const;
    const String& string() const { return string_; }
    String copied_out() const;  ///< returns a copy that the engine owns

   private:
    alignas(8) String string_;
};

/// A Variant.
class Value {
   public:
    Value() { call(core::variant_new_nil, &variant_); }
    explicit Value(bool it) { call(core::variant_new_bool, &variant_, it); }
    explicit Value(std::int64_t it) { call(core::variant_new_int, &variant_, it); }
    explicit Value(double it) { call(core::variant_new_real, &variant_, it); }
    explicit Value(const Vector3& it) { call(core::variant_new_vector3, &variant_, &it); }
    explicit Value(const Vector4& it) { call(core::variant_new_quat, &variant_, &it); }
    explicit Value(const Rid& it) { call(core::variant_new_rid, &variant_, &it); }
    explicit Value(const Dictionary& it) { call(core::variant_new_dictionary, &variant_, &it); }
    explicit Value(const Text& it) { call(core::variant_new_string, &variant_, &it.string()); }
    explicit Value(std::string_view it) : Value(Text(it)) {}
    explicit Value(const char* it) : Value(std::string_view(it)) {}
    explicit Value(const Variant& it) { call(core::variant_new_copy, &variant_, &it); }
    Value(const Value& it) : Value(it.variant_) {}
    Value& operator=(const Value&) = delete;
    ~Value() { call(core::variant_destroy, &variant_); }

    const Variant& variant() const { return variant_; }
    /// Returns a copy that the engine owns.
    Variant handed_over() const {
        Variant copy;
        call(core::variant_new_copy, &copy, &variant_);
        return copy;
    }

   protected:
    alignas(8) Variant variant_;
};

/// A NodePath.
class Path {
   public:
    explicit Path(std::string_view of) { call(core::node_path_new, &path_, &Text(of).string()); }
    /// \pre the value is a NodePath
    explicit Path(const Variant& of) : path_(call(core::variant_as_node_path, &of)) {}
    ~Path() { call(core::node_path_destroy, &path_); }
    Path(const Path&) = delete;
    Path& operator=(const Path&) = delete;

    const NodePath& path() const { return path_; }
    Value value() const {
        Variant variant;
        call(core::variant_new_node_path, &variant, &path_);
        Value copy(variant);
        call(core::variant_destroy, &variant);
        return copy;
    }

   private:
    alignas(8) NodePath path_;
};

/// A Dictionary that is filled and passed to the engine.
class Table {
   public:
    Table() { call(core::dictionary_new, &dictionary_); }
    ~Table() { call(core::dictionary_destroy, &dictionary_); }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    void set(std::string_view key, const Value& value) {
        call(core::dictionary_set, &dictionary_, &Value(key).variant(), &value.variant());
    }
    const Dictionary& dictionary() const { return dictionary_; }

   private:
    alignas(8) Dictionary dictionary_;
};

/// A Dictionary that a script passed.
class Entries {
   public:
    /// \pre the value is a Dictionary
    explicit Entries(const Variant& of) : dictionary_(call(core::variant_as_dictionary, &of)) {}
    ~Entries() { call(core::dictionary_destroy, &dictionary_); }
    Entries(const Entries&) = delete;
    Entries& operator=(const Entries&) = delete;

    /// Returns the keys as text.
    std::vector<std::string> keys() const;
    std::optional<Value> at(std::string_view key) const;

   private:
    alignas(8) Dictionary dictionary_;
};

/// The functions of each type of pool array.
template <class Element>
struct PoolFunctions;
template <>
struct PoolFunctions<std::uint8_t> {
    static constexpr auto create = core::pool_byte_array_new, destroy = core::pool_byte_array_destroy;
    static constexpr auto resize = core::pool_byte_array_resize;
    static constexpr auto write = core::pool_byte_array_write;
    static constexpr auto elements = core::pool_byte_array_write_access_ptr;
    static constexpr auto end_write = core::pool_byte_array_write_access_destroy;
    static constexpr auto to_variant = core::variant_new_pool_byte_array;
    static constexpr auto of_variant = core::variant_as_pool_byte_array;
    static constexpr auto size = core::pool_byte_array_size;
    static constexpr auto read = core::pool_byte_array_read;
    static constexpr auto read_elements = core::pool_byte_array_read_access_ptr;
    static constexpr auto end_read = core::pool_byte_array_read_access_destroy;
};
template <>
struct PoolFunctions<int> {
    static constexpr auto create = core::pool_int_array_new, destroy = core::pool_int_array_destroy;
    static constexpr auto resize = core::pool_int_array_resize;
    static constexpr auto write = core::pool_int_array_write;
    static constexpr auto elements = core::pool_int_array_write_access_ptr;
    static constexpr auto end_write = core::pool_int_array_write_access_destroy;
    static constexpr auto to_variant = core::variant_new_pool_int_array;
    static constexpr auto of_variant = core::variant_as_pool_int_array;
    static constexpr auto size = core::pool_int_array_size;
    static constexpr auto read = core::pool_int_array_read;
    static constexpr auto read_elements = core::pool_int_array_read_access_ptr;
    static constexpr auto end_read = core::pool_int_array_read_access_destroy;
};
template <>
struct PoolFunctions<float> {
    static constexpr auto create = core::pool_real_array_new, destroy = core::pool_real_array_destroy;
    static constexpr auto resize = core::pool_real_array_resize;
    static constexpr auto write = core::pool_real_array_write;
    static constexpr auto elements = core::pool_real_array_write_access_ptr;
    static constexpr auto end_write = core::pool_real_array_write_access_destroy;
    static constexpr auto to_variant = core::variant_new_pool_real_array;
    static constexpr auto of_variant = core::variant_as_pool_real_array;
    static constexpr auto size = core::pool_real_array_size;
    static constexpr auto read = core::pool_real_array_read;
    static constexpr auto read_elements = core::pool_real_array_read_access_ptr;
    static constexpr auto end_read = core::pool_real_array_read_access_destroy;
};
template <>
struct PoolFunctions<Vector3> {
    static constexpr auto create = core::pool_vector3_array_new, destroy = core::pool_vector3_array_destroy;
    static constexpr auto resize = core::pool_vector3_array_resize;
    static constexpr auto write = core::pool_vector3_array_write;
    static constexpr auto elements = core::pool_vector3_array_write_access_ptr;
    static constexpr auto end_write = core::pool_vector3_array_write_access_destroy;
    static constexpr auto to_variant = core::variant_new_pool_vector3_array;
    static constexpr auto of_variant = core::variant_as_pool_vector3_array;
    static constexpr auto size = core::pool_vector3_array_size;
    static constexpr auto read = core::pool_vector3_array_read;
    static constexpr auto read_elements = core::pool_vector3_array_read_access_ptr;
    static constexpr auto end_read = core::pool_vector3_array_read_access_destroy;
};

/// A PoolByteArray, PoolIntArray, PoolRealArray or PoolVector3Array of some elements.
template <class Element>
class Pool {
    using Functions = PoolFunctions<Element>;

   public:
    explicit Pool(std::size_t count) : count_(count) {
        call(Functions::create, &array_);
        call(Functions::resize, &array_, static_cast<int>(count));
    }
    explicit Pool(std::span<const Element> elements) : Pool(elements.size()) {
        fill([&](std::span<Element> room) {
            if (!room.empty()) std::memcpy(room.data(), elements.data(), elements.size_bytes());
        });
    }
    ~Pool() { call(Functions::destroy, &array_); }
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    template <class Fill>
    void fill(const Fill& fill_room) {
        Access* access = call(Functions::write, &array_);
        fill_room(std::span(static_cast<Element*>(call(Functions::elements, access)), count_));
        call(Functions::end_write, access);
    }
    const PoolArray& array() const { return array_; }
    Value value() const {
        Variant variant;
        call(Functions::to_variant, &variant, &array_);
        Value copy(variant);
        call(core::variant_destroy, &variant);
        return copy;
    }

   private:
    alignas(8) PoolArray array_;
    std::size_t count_;
};

/// The elements of a pool array that a script passed.
template <class Element>
class PoolElements {
    using Functions = PoolFunctions<Element>;

   public:
    /// \pre the value is a pool array of this type
    explicit PoolElements(const Variant& of)
        : array_(call(Functions::of_variant, &of)), access_(call(Functions::read, &array_)) {}
    ~PoolElements() {
        call(Functions::end_read, access_);
        call(Functions::destroy, &array_);
    }
    PoolElements(const PoolElements&) = delete;
    PoolElements& operator=(const PoolElements&) = delete;

    std::span<const Element> all() const {
        return {static_cast<const Element*>(call(Functions::read_elements, access_)),
                static_cast<std::size_t>(call(Functions::size, &array_))};
    }

   private:
    alignas(8) PoolArray array_;
    Access* access_;
};

/// A method of one of the engine's classes. Types of arguments and result are those of the engine's
/// description, with int as std::int64_t, float as double and objects as Object*. The caller owns a
/// result that is a reference: use Held.
class Method {
   public:
    Method(const char* of_class, const char* name) : class_(of_class), name_(name) {}

    template <class Result = void, class... Arguments>
    Result on(Object* object, const Arguments&... arguments) const {
        const void* pointers[sizeof...(arguments) + 1] = {pointer_to(arguments)...};
        if constexpr (std::is_void_v<Result>) {
            call(core::method_bind_ptrcall, bind(), object, pointers, nullptr);
        } else {
            // The engine writes a bool as one byte.
            alignas(8) unsigned char room[sizeof(Result) < 8 ? 8 : sizeof(Result)] = {};
            call(core::method_bind_ptrcall, bind(), object, pointers, static_cast<void*>(room));
            Result result;
            std::memcpy(&result, room, sizeof result);
            return result;
        }
    }
    /// Calls the method with any number of arguments, as scripts do.
    void with_values(Object* object, std::span<const Variant* const> arguments) const;

   private:
    template <class Argument>
    static const void* pointer_to(const Argument& argument) {
        static_assert(!std::is_same_v<Argument, int> && !std::is_same_v<Argument, float>);
        return &argument;
    }
    static const void* pointer_to(Object* const& object) { return object; }
    MethodBind* bind() const;

    const char *class_, *name_;
    mutable MethodBind* bind_ = nullptr;
};

/// A Reference: a reference-counted object.
class Held {
   public:
    Held() = default;
    /// \param object  an object whose count already includes this reference, as methods return it
    explicit Held(Object* object) : object_(object) {}
    static Held made(const char* class_name);
    ~Held() { let_go(); }
    Held(Held&& other) noexcept : object_(other.object_) { other.object_ = nullptr; }
    Held& operator=(Held&& other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    Object* object() const { return object_; }

   private:
    void let_go();
    Object* object_ = nullptr;
};

/// Returns the members of a Vector3.
Vector3 vector_of(const Variant& value);

/// Prints a line to the engine's output.
void print_line(std::string_view line);

/// Reports an invalid value: prints a line after the name of the node's class, and emits the node's
/// signal `refused` with the line.
void report_invalid(Object* node, std::string_view class_name, std::string_view line);

}  // namespace pelagic::godot
