// Options as a page gives them, an object {windSpeedMps: 9, preset: "rough"}: names and ranges are those of sea_state_fields(),
// in JavaScript's spelling.
#pragma once

#include <emscripten/val.h>

#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic::web {

/// "wind_speed_mps" as "windSpeedMps", wherever such a name stands in the text.
std::string camel_case(std::string_view text);

/// A value as somebody would write it: 9, "rough", NaN, null, [1,2]. For messages.
std::string text_of(const emscripten::val& value);

/// An option that is on or off. Throws std::invalid_argument of anything else: "queries is 1, expected true or false".
bool flag_of(const std::string& name, const emscripten::val& value);

/// A number of which `accepts` says yes; else std::invalid_argument: "timeS is NaN, expected a finite number".
double number_of(std::string_view name, const emscripten::val& value, bool (*accepts)(double),
                 std::string_view accepted);

/// One of those words; else std::invalid_argument, with the nearest one.
std::string word_of(std::string_view name, const emscripten::val& value, const std::vector<std::string>& words);

/// What the object says about the sea, on top of `sea`: `preset` first, whatever the order, then the others. Of a preset, what belongs
/// to the cascades stays as `sea` has it, where the preset leaves it to the library.
///
/// \param options  an object, or undefined: nothing
/// \param others   names that the object may have, too, and whoever calls reads
/// Throws std::invalid_argument, one line that names the option, the value and what is accepted, of unknown names, wrong types and
/// what check() refuses.
SeaState sea_with(const SeaState& sea, const emscripten::val& options, std::span<const std::string_view> others = {});

/// The other way round: an object of every option of the sea.
emscripten::val options_of(const SeaState& sea);

/// An array with an object for each option of the sea: name, default, accepted in words, for numbers also least and most, for words all of them.
emscripten::val sea_option_table();

/// An array of {name, summary, sea}, the mildest first.
emscripten::val preset_table();

/// {value} of what `work` returns, or {error} with the one line of what it throws: an exception of C++ doesn't reach JavaScript as
/// an Error, so package/module.js makes one of that line.
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
