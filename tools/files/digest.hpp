// Bytes in 16 hexadecimal digits, as records name them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace pelagic::tools {

std::string hex_text(std::uint64_t value);

/// XXH3 of bytes that come piece by piece.
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

/// XXH3 of the bytes.
std::string digest_of(std::string_view bytes);

}  // namespace pelagic::tools
