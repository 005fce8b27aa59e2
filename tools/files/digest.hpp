// XXH3 digests as 16 hexadecimal digits, as records contain them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace pelagic::tools {

std::string hex_text(std::uint64_t value);

/// Computes the XXH3 of bytes that are added piece by piece.
class Digest {
   public:
    Digest();
    void add(std::string_view bytes);
    std::string text() const;

   private:
    struct State;
    struct Delete {
        void operator()(State* state) const;
    };
    std::unique_ptr<State, Delete> state_;
};

/// Returns the XXH3 of the bytes.
std::string digest_of(std::string_view bytes);

}  // namespace pelagic::tools
