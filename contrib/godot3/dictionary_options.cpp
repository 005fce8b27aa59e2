#include "pelagic/contrib/godot3/dictionary_options.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/message/enum_names.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/near_names.hpp"
#include "pelagic/message/numeric_field.hpp"

namespace pelagic::godot {
namespace {

using Names = std::vector<std::string>;

template <class Number>
[[noreturn]] void reject(std::string_view name, const Number& value, std::string_view accepted) {
    throw std::invalid_argument(invalid_value_message(name, value, accepted));
}

template <class Options>
void read_fields(const Entries& entries, std::span<const NumericField<Options>> fields, Options& options) {
    for (const NumericField<Options>& field : fields) {
        const std::optional<Value> value = entries.at(field.name);
        if (!value) continue;
        const VariantType type = call(core::variant_get_type, &value->variant());
        if (type != type_int && type != type_real) reject(field.name, Text(value->variant()).utf8(), field.accepted);
        const double number = call(core::variant_as_real, &value->variant());
        const bool is_whole = !std::holds_alternative<double Options::*>(field.member) &&
                              !std::holds_alternative<float Options::*>(field.member);
        if (!field.accepts(number) || (is_whole && number != std::floor(number)))
            reject(field.name, number, field.accepted);
        field.set(options, number);
    }
}

template <NamedEnum Enum>
void read_name(const Entries& entries, std::string_view key, Enum& value) {
    const std::optional<Value> entry = entries.at(key);
    if (!entry) return;
    const std::string name = Text(entry->variant()).utf8();
    const auto& names = names_of<Enum>();
    const std::optional<Enum> found = value_named<Enum>(name);
    if (!found)
        throw std::invalid_argument(invalid_value_message(key, name, list_of(names)) + nearest_hint(name, names));
    value = *found;
}

/// Throws for a key that is neither a field nor one of `others`.
template <class Options>
void require_known_keys(const Entries& entries, std::span<const NumericField<Options>> fields, const Names& others) {
    Names known = others;
    for (const NumericField<Options>& field : fields) known.emplace_back(field.name);
    for (const std::string& key : entries.keys())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw std::invalid_argument(invalid_value_message("the key", key, list_of(known)) +
                                        nearest_hint(key, known));
}

/// Reads options that have numeric fields only.
template <class Options>
Options options_of(const Variant& dictionary, std::span<const NumericField<Options>> fields) {
    const Entries entries(dictionary);
    require_known_keys(entries, fields, {});
    Options options;
    read_fields(entries, fields, options);
    return options;
}

}  // namespace

Disturbance disturbance_of(const Variant& dictionary) {
    const Entries entries(dictionary);
    require_known_keys(entries, disturbance_fields(), {"shape", "mode"});
    Disturbance disturbance;
    read_name(entries, "shape", disturbance.shape);
    read_name(entries, "mode", disturbance.mode);
    read_fields(entries, disturbance_fields(), disturbance);
    return disturbance;
}

Rain rain_of(const Variant& dictionary) { return options_of(dictionary, rain_fields()); }
SprayEmitter emitter_of(const Variant& dictionary) { return options_of(dictionary, spray_emitter_fields()); }

}  // namespace pelagic::godot
