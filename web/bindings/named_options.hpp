// Options by name, read from JavaScript objects such as {windSpeedMps: 9, preset: "rough"}. Names
// and ranges are those of the C++ tables of fields, in camelCase.
#pragma once

#include <emscripten/val.h>

#include <cmath>
#include <exception>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic::web {

/// Replaces each name in a text by its camelCase: "wind_speed_mps" becomes "windSpeedMps".
std::string camel_case(std::string_view text);

/// Returns a JavaScript value as text for messages: 9, "rough", NaN, null, an array.
std::string text_of(const emscripten::val& value);

bool is_number(const emscripten::val& value);
/// Returns false for null and arrays.
bool is_object(const emscripten::val& value);
/// Returns the own enumerable property names of an object.
std::vector<std::string> keys_of(const emscripten::val& object);

// The readers throw std::invalid_argument for any other value, with a message that names the
// option, its value and what is accepted.

/// Reads true or false.
bool flag_of(const std::string& name, const emscripten::val& value);

/// Reads a number for which `accepts` returns true.
double number_of(std::string_view name, const emscripten::val& value, bool (*accepts)(double),
                 std::string_view accepted);

/// Reads one of the words. The message contains the nearest of them.
std::string word_of(std::string_view name, const emscripten::val& value, const std::vector<std::string>& words);

/// Throws std::invalid_argument for an unknown option. The message contains the nearest known one.
[[noreturn]] void reject_name(const std::string& name, std::span<const std::string> known);

/// Returns whether a field holds whole numbers.
template <class Options>
bool is_whole(const NumericField<Options>& field) {
    return !std::holds_alternative<float Options::*>(field.member) &&
           !std::holds_alternative<double Options::*>(field.member);
}

/// Reads a number into a field.
/// \param name  of the option, for messages
template <class Options>
void set_field(Options& options, const NumericField<Options>& field, const std::string& name,
               const emscripten::val& value) {
    const std::string accepted = camel_case(field.accepted);
    if (!is_number(value))
        throw std::invalid_argument(invalid_value_message(name, text_of(value), "a number: " + accepted));
    const double number = value.as<double>();
    if (!field.accepts(number) || (is_whole(field) && std::trunc(number) != number))
        throw std::invalid_argument(invalid_value_message(name, text_of(value), accepted));
    field.set(options, number);
}

/// Returns a row of an option table: {name, default, accepted, words}.
emscripten::val option_row(const std::string& name, const std::string& default_word,
                           const std::vector<std::string>& words);

/// Returns a row of an option table: {name, default, accepted, least, most}.
template <class Options>
emscripten::val option_row(const NumericField<Options>& field) {
    static const Options defaults{};
    emscripten::val row = emscripten::val::object();
    row.set("name", camel_case(field.name));
    row.set("default", field.value_in(defaults));
    row.set("accepted", camel_case(field.accepted));
    row.set("least", field.min);
    row.set("most", field.max);
    return row;
}

/// Returns `sea` with the options of an object: first its `preset`, then the others in any order. A
/// preset changes the cascades, depth, loop period and seed only where it does not have the
/// defaults.
///
/// \param options  an object, or undefined for `sea` itself
/// \param others   names of further options, which the caller reads
/// \throws std::invalid_argument for an unknown option, a wrong type and what check() rejects;
///     one line that names the option, its value and what is accepted
SeaState sea_with(const SeaState& sea, const emscripten::val& options, std::span<const std::string_view> others = {});

/// Returns an object of every option of the sea.
emscripten::val options_of(const SeaState& sea);

/// Returns an array with a row for each option of a sea.
emscripten::val sea_option_table();

/// Returns an array of {name, summary, sea}, the mildest sea first.
emscripten::val preset_table();

/// Returns {value} with the result of `work`, or {error} with the message of its exception. A C++
/// exception does not reach JavaScript as an Error; package/module.js makes one of the message.
template <class Work>
emscripten::val answer_of(Work work) {
    emscripten::val answer = emscripten::val::object();
    try {
        answer.set("value", work());
    } catch (const std::bad_alloc&) {
        answer.set("error", "out of memory: fewer or smaller cascades take less");
    } catch (const std::exception& error) {
        answer.set("error", std::string(error.what()));
    }
    return answer;
}

}  // namespace pelagic::web
