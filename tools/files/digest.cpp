#include "pelagic/tools/files/digest.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstdio>

namespace pelagic::tools {

std::string hex_text(std::uint64_t value) {
    std::array<char, 17> text;
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
    return text.data();
}

struct Digest::State {
    XXH3_state_t xxh3;
};

void Digest::Delete::operator()(State* state) const { delete state; }

Digest::Digest() : state_(new State) { XXH3_64bits_reset(&state_->xxh3); }

void Digest::add(std::string_view bytes) { XXH3_64bits_update(&state_->xxh3, bytes.data(), bytes.size()); }

std::string Digest::text() const { return hex_text(XXH3_64bits_digest(&state_->xxh3)); }

std::string digest_of(std::string_view bytes) { return hex_text(XXH3_64bits(bytes.data(), bytes.size())); }

}  // namespace pelagic::tools
