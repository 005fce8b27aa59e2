// Reading of JavaScript objects into structs of options.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/web/bindings/named_options.hpp"

namespace pelagic::web {

template <NamedEnum Enum>
std::vector<std::string> words_of() {
    return {names_of<Enum>().begin(), names_of<Enum>().end()};
}

/// Throws std::invalid_argument(prefix + reason) if the reason is not empty.
inline void require_valid(const std::string& prefix, const std::string& reason) {
    if (!reason.empty()) require(prefix + camel_case(reason));
}

/// Reads the options of an object, and at last checks that there are no others.
class ObjectReader {
   public:
    /// \param name    of the object, for messages
    /// \param prefix  of the names of its options, for messages
    ObjectReader(const std::string& name, std::string prefix, const emscripten::val& object)
        : prefix_(std::move(prefix)), object_(object) {
        if (!is_object(object))
            throw std::invalid_argument(invalid_value_message(name, text_of(object), "an object"));
    }

    /// Returns undefined for an absent option.
    emscripten::val take(const std::string& name) {
        known_.push_back(prefix_ + name);
        return object_[name];
    }

    template <class Options>
    void take_fields(Options& options, std::span<const NumericField<Options>> fields) {
        for (const NumericField<Options>& field : fields) {
            const std::string name = camel_case(field.name);
            const emscripten::val value = take(name);
            if (!value.isUndefined()) set_field(options, field, prefix_ + name, value);
        }
    }

    /// \param words  in the order of the enumerators
    template <class Enum>
    void take_word(Enum& option, const std::string& name) {
        const emscripten::val value = take(name);
        if (!value.isUndefined()) option = *value_named<Enum>(word_of(prefix_ + name, value, words_of<Enum>()));
    }

    /// Throws std::invalid_argument if the object has an option that was not taken.
    void end() const {
        for (const std::string& key : keys_of(object_)) {
            const std::string name = prefix_ + key;
            if (std::find(known_.begin(), known_.end(), name) == known_.end()) reject_name(name, known_);
        }
    }

   private:
    std::string prefix_;
    const emscripten::val& object_;
    std::vector<std::string> known_;
};

}  // namespace pelagic::web
