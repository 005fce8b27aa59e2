#include "pelagic/contrib/godot3/engine.hpp"

#include <array>

namespace pelagic::godot {
namespace {

const CoreApi* the_core_api = nullptr;

}  // namespace

void set_core_api(const CoreApi* api) { the_core_api = api; }
const CoreApi& core_table() { return *the_core_api; }

std::string Text::utf8() const {
    CharString bytes = call(core::string_utf8, &string_);
    std::string text = call(core::char_string_get_data, &bytes);
    call(core::char_string_destroy, &bytes);
    return text;
}

String Text::copied_out() const {
    const std::string text = utf8();
    return call(core::string_chars_to_utf8_with_len, text.data(), static_cast<int>(text.size()));
}

std::vector<std::string> Entries::keys() const {
    Array keys = call(core::dictionary_keys, &dictionary_);
    std::vector<std::string> names;
    for (int i = 0; i < call(core::array_size, &keys); ++i) {
        Variant key = call(core::array_get, &keys, i);
        names.push_back(Text(key).utf8());
        call(core::variant_destroy, &key);
    }
    call(core::array_destroy, &keys);
    return names;
}

std::optional<Value> Entries::at(std::string_view key) const {
    const Value name(key);
    if (!call(core::dictionary_has, &dictionary_, &name.variant())) return {};
    Variant value = call(core::dictionary_get, &dictionary_, &name.variant());
    std::optional<Value> copy(std::in_place, value);
    call(core::variant_destroy, &value);
    return copy;
}

MethodBind* Method::bind() const {
    if (!bind_) bind_ = call(core::method_bind_get_method, class_, name_);
    return bind_;
}

void Method::with_values(Object* object, std::span<const Variant* const> arguments) const {
    CallError error;
    Variant result = call(core::method_bind_call, bind(), object, const_cast<const Variant**>(arguments.data()),
                          static_cast<int>(arguments.size()), &error);
    call(core::variant_destroy, &result);
}

Held Held::made(const char* class_name) {
    static const Method init_ref("Reference", "init_ref");
    Object* object = call(core::get_class_constructor, class_name)();
    init_ref.on<bool>(object);
    return Held(object);
}

void Held::let_go() {
    static const Method unreference("Reference", "unreference");
    if (object_ && unreference.on<bool>(object_)) call(core::object_destroy, object_);
    object_ = nullptr;
}

Vector3 vector_of(const Variant& value) {
    const Vector3Bytes bytes = call(core::variant_as_vector3, &value);
    Vector3 vector;
    std::memcpy(&vector, &bytes, sizeof vector);
    return vector;
}

void print_line(std::string_view line) { call(core::print, &Text(line).string()); }

void report_invalid(Object* node, std::string_view class_name, std::string_view line) {
    static const Method emit_signal("Object", "emit_signal");
    print_line(std::string(class_name) + ": " + std::string(line));
    const Value name("refused"), text(line);
    emit_signal.with_values(node, std::array{&name.variant(), &text.variant()});
}

}  // namespace pelagic::godot
